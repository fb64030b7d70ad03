"""Maps with matplotlib."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _slideway
from ._plot_style import (
    HATCHES,
    INCH,
    MAP_HEIGHT,
    MAP_LEGEND,
    MAP_WIDTHS,
    MARGIN,
    POINT,
    SMALL,
    TEXT,
    WIDTH,
    LegendPlace,
    ThemeName,
    named,
    plain,
    pyplot,
    styled,
    wrapped,
)

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes

    from . import reports


def plot_map(
    shown: reports.DrawnMap,
    pixels: np.ndarray[Any, Any],
    ax: Axes | None = None,
    *,
    legend: LegendPlace | None = None,
    theme: ThemeName = "light",
) -> Axes:
    """Draws a map, as `plot()` of a map does.

    Parameters
    ----------
    shown : reports.DrawnMap
        The map in words and colours.
    pixels : array of int
        The class of each pixel, a row for each row of the map from the bottom.
    ax : Axes, optional
        Where to draw; the figure keeps its size and its layout. Default: the Axes of a new figure of pyplot.
    legend : bool or "outside", optional
        Whether there is a legend within the Axes, or beside them. Default: beside the Axes of a new figure, within given
        ones. `ax.get_legend_handles_labels()` has its entries in any case.
    theme : {"light", "dark"}

    Returns
    -------
    Axes

    Examples
    --------
    See `slideway.reports.MapReport.plot`.
    """
    colours = _slideway.theme(theme)
    place: LegendPlace = ("outside" if ax is None else True) if legend is None else legend
    if ax is None:
        rows, columns = pixels.shape
        width = float(np.clip(MAP_HEIGHT * columns / rows, *MAP_WIDTHS))
        size = ((width + 420.0) * INCH, (MAP_HEIGHT + 100.0) * INCH)
        new, ax = pyplot().subplots(figsize=size, layout="constrained", facecolor=colours.background)
        new.get_layout_engine().set(w_pad=MARGIN * INCH, h_pad=MARGIN * INCH)
    assert ax is not None
    styled(ax, colours)
    _fill(shown, pixels, ax, colours)
    if shown.model is not None:
        _cross(ax, shown.model, colours)
    ax.set_xlabel(named(shown.x), color=colours.ink, fontsize=TEXT * POINT)
    ax.set_ylabel(named(shown.y), color=colours.ink, fontsize=TEXT * POINT)
    _map_legend(shown, ax, colours, place)
    lines = [*wrapped(shown.title, WIDTH, TEXT), *wrapped(shown.subtitle, WIDTH, TEXT)]
    title = plain("\n".join(lines))
    ax.set_title(title, loc="left", color=colours.ink, fontsize=TEXT * POINT, fontweight="bold")
    return ax


def _ranges(shown: reports.DrawnMap) -> tuple[tuple[float, float], tuple[float, float]]:
    assert shown.x.range is not None and shown.y.range is not None
    return shown.x.range, shown.y.range


def _fill(shown: reports.DrawnMap, pixels: np.ndarray[Any, Any], ax: Axes, theme: reports.Theme) -> None:
    """Colours and hatches of the classes."""
    from matplotlib.colors import to_rgb
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    x, y = _ranges(shown)
    colours = np.array([to_rgb(each.fill) for each in shown.classes])
    ax.imshow(colours[pixels], origin="lower", extent=(*x, *y), aspect="auto", interpolation="nearest")
    edges = [np.linspace(*range_, count + 1) for range_, count in ((x, pixels.shape[1]), (y, pixels.shape[0]))]
    for index, each in enumerate(shown.classes):
        if each.hatching is None:
            continue
        boxes = []
        for row, inside in enumerate(pixels == index):
            (ends,) = np.nonzero(np.diff(np.concatenate([[0], inside.astype(np.int8), [0]])))
            for left, right in zip(edges[0][ends[::2]], edges[0][ends[1::2]], strict=True):
                bottom, top = edges[1][row : row + 2]
                boxes.append([(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)])
        paths = Path.make_compound_path(*map(Path, boxes))
        patch = PathPatch(paths, facecolor="none", edgecolor=theme.ink, hatch=HATCHES[each.hatching], linewidth=0.0)
        patch.set_alpha(0.35)
        ax.add_patch(patch)


def _cross(ax: Axes, place: tuple[float, float], theme: reports.Theme) -> None:
    """A cross at the values of the model."""
    for colour, width in [(theme.background, 4.5), (theme.ink, 2.0)]:
        ax.plot(*place, marker="x", markersize=10 * POINT, color=colour, markeredgewidth=width * POINT)


def _map_legend(shown: reports.DrawnMap, ax: Axes, theme: reports.Theme, place: LegendPlace) -> None:
    """The legend within a map or beside it; its entries are artists of the Axes, which draw nothing there."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Rectangle

    def sample(**look: Any) -> Artist:
        return Rectangle((0.0, 0.0), 0.0, 0.0, **look)

    entries: list[tuple[Artist, str]] = []
    for each in shown.classes:
        hatch = HATCHES[each.hatching] if each.hatching else None
        entries.append((sample(facecolor=each.fill, edgecolor=theme.muted, hatch=hatch, linewidth=POINT), each.text))
    if shown.model is not None:
        cross = Line2D([], [], linestyle="none", marker="x", markersize=10 * POINT, color=theme.ink, markeredgewidth=1.5)
        entries.append((cross, "the model"))
    entries += [(sample(alpha=0.0), mode) for mode in shown.modes]
    for handle, text in entries:
        handle.set_label(plain("\n".join(textwrap.wrap(text, MAP_LEGEND))))
        ax.add_artist(handle)
    if place is False:
        return
    where: dict[str, Any] = {"loc": "upper right", "facecolor": theme.background, "edgecolor": theme.muted}
    if place == "outside":
        where = {"loc": "upper left", "bbox_to_anchor": (1.02, 1.0), "borderaxespad": 0.0, "frameon": False}
    box = ax.legend(
        handles=[handle for handle, _ in entries],
        fontsize=SMALL * POINT, labelcolor=theme.ink, handlelength=1.7, **where,
    )
    box.set_in_layout(place == "outside")
