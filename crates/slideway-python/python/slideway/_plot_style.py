"""What all plots with matplotlib have in common: sizes, dashes, hatches, and how texts are set."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any, Literal

from ._needs import needs
from ._values import ThemeName

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from . import reports

__all__ = ["ThemeName"]

LegendPlace = bool | Literal["outside"]

# Sizes of the pictures (px), and a pixel in inches and points.
WIDTH, SINGLE_HEIGHT, STACKED_HEIGHT = 800.0, 380.0, 300.0
FRAME_WIDTH = 700.0
MAP_HEIGHT, MAP_WIDTHS, MAP_LEGEND = 400.0, (200.0, 640.0), 48
TITLE, TEXT, SMALL, CURVE, ROW, BAND = 17.0, 14.0, 13.0, 2.2, 18.0, 12.0
INCH, POINT = 1 / 96, 72 / 96
# Distances of ticks that are aimed at, and space around everything (px).
BETWEEN = (80.0, 48.0)
MARGIN = 14.0
# Mean width of a letter as a share of its size.
LETTER = 0.56

# Dashes in widths of the line.
DASHES = {
    "solid": "-",
    "dashed": (0.0, (7 / CURVE, 3 / CURVE)),
    "dotted": (0.0, (2 / CURVE, 3 / CURVE)),
    "dash_dotted": (0.0, (9 / CURVE, 3 / CURVE, 2 / CURVE, 3 / CURVE)),
}
DASH = 9 / CURVE
HATCHES = {"rising": "///", "falling": "\\\\\\", "dotted": ".."}
MARKERS = "os^Dv"
# Samples of the parts of a legend, from top to bottom.
LEGENDS = (("curve", "several"), ("marker", "end", "point"), ("cut", "hatched", "filled"))


def pyplot() -> Any:
    """The module of matplotlib."""
    with needs("plots need matplotlib", "matplotlib"):
        from matplotlib import pyplot
    return pyplot


def wrapped(text: str, width: float, size: float) -> list[str]:
    """Lines of text of this size within a width (px)."""
    return textwrap.wrap(text, int(width / (LETTER * size)), break_long_words=False)


def named(axis: reports.Axis) -> str:
    """The name of an axis with its unit."""
    unit = axis.unit.replace("^2", "²").replace("^3", "³").replace("^4", "⁴")
    return plain(f"{axis.name} in {unit}" if unit else axis.name)


def plain(text: str) -> str:
    """Text that matplotlib does not read as a formula."""
    return text.replace("$", r"\$")


def styled(ax: Axes, theme: reports.Theme) -> None:
    """The frame and the numbers of Axes."""
    ax.set_facecolor(theme.background)
    for spine in ax.spines.values():
        spine.set(color=theme.ink, linewidth=1.2 * POINT)
    ax.tick_params(colors=theme.ink, labelsize=SMALL * POINT, length=5 * POINT, width=1.2 * POINT)
    ax.set_axisbelow(True)
