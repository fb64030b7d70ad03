"""Plots with matplotlib, styled as the pictures of the book.

What a plot shows is said by the library, once for all that draw it: this module puts it on Axes. `plot()` of an answer is
the usual way to it; `plot_figure` draws plain data of `slideway.reports.Figure`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _slideway
from ._map_plot import plot_map
from ._plot_style import (
    BAND,
    BETWEEN,
    CURVE,
    DASH,
    DASHES,
    FRAME_WIDTH,
    HATCHES,
    INCH,
    LEGENDS,
    LETTER,
    MARGIN,
    MARKERS,
    POINT,
    ROW,
    SINGLE_HEIGHT,
    SMALL,
    STACKED_HEIGHT,
    TEXT,
    TITLE,
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
    from matplotlib.container import Container

    from . import reports

__all__ = ["LegendPlace", "ThemeName", "plot_figure", "plot_map"]

Drawn = Callable[[float, float], "list[reports.DrawnPanel]"]


def plot_figure(
    figure: reports.Figure,
    drawn: Drawn,
    ax: Axes | Sequence[Axes] | np.ndarray[Any, Any] | None = None,
    *,
    legend: LegendPlace | None = None,
    theme: ThemeName = "light",
) -> Any:
    """Draws a figure, as `plot()` of an answer does.

    Parameters
    ----------
    figure : reports.Figure
        The plot as plain data.
    drawn : callable
        Gives what its panels show in frames of a given width and height (px).
    ax : Axes, optional
        Where to draw; an array of them if there are several panels. Their figure keeps its size and its layout.
        Default: the Axes of a new figure of pyplot.
    legend : bool or "outside", optional
        Whether there is a legend within the Axes, or below them. Default: below the Axes of a new figure, within given
        ones. `ax.get_legend_handles_labels()` has its entries in any case.
    theme : {"light", "dark"}

    Returns
    -------
    Axes or array of Axes

    Examples
    --------
    See `slideway.reports.LimitsReport.plot`.
    """
    colours = _slideway.theme(theme)
    count = len(figure.panels)
    height = SINGLE_HEIGHT if count == 1 else STACKED_HEIGHT
    if ax is not None:
        given = np.atleast_1d(np.asarray(ax, dtype=object)).ravel()
        if len(given) != count:
            raise ValueError(f"ax must be {'one Axes' if count == 1 else f'{count} Axes'} for this plot, not {len(given)}")
        for index, axes in enumerate(given):
            box = axes.get_window_extent()
            scale = axes.figure.dpi * INCH
            size = (box.width / scale, box.height / scale)
            panel = figure.panels[index]
            _Painter(figure, panel, drawn(*size)[index], axes, colours, size).paint(panel.title, legend is None or legend)
        return given[0] if count == 1 else given
    new, grid = pyplot().subplots(count, 1, squeeze=False, layout="constrained", facecolor=colours.background)
    new.set_size_inches(WIDTH * INCH, count * height * INCH)
    new.get_layout_engine().set(w_pad=MARGIN * INCH, h_pad=MARGIN * INCH)
    size = (FRAME_WIDTH, height)
    panels = zip(figure.panels, drawn(*size), grid[:, 0], strict=True)
    painters = [_Painter(figure, *each, colours, size) for each in panels]
    place: LegendPlace = "outside" if legend is None else legend
    needed = sum(painter.paint(painter.panel.title, place) for painter in painters)
    lines = wrapped(figure.title, WIDTH, TITLE)
    painters[0].heading(lines, wrapped(figure.subtitle, WIDTH, SMALL))
    needed += painters[0].above
    new.set_size_inches(WIDTH * INCH, (needed + count * (height + 2 * MARGIN)) * INCH)
    return grid[0, 0] if count == 1 else grid[:, 0]


class _Painter:
    """One panel on its Axes."""

    def __init__(
        self,
        figure: reports.Figure,
        panel: reports.Panel,
        drawn: reports.DrawnPanel,
        ax: Axes,
        theme: reports.Theme,
        size: tuple[float, float],
    ) -> None:
        self.figure, self.panel, self.drawn, self.ax, self.theme = figure, panel, drawn, ax, theme
        self.size = size
        """Width and height of the frame (px)."""
        self.above = 0.0
        """What is above the frame already (px)."""

    def paint(self, title: str, legend: LegendPlace) -> float:
        """Draws everything, and returns the height of what is above and below the frame (px)."""
        styled(self.ax, self.theme)
        self._axes()
        self._zones()
        self._bars()
        self._lines()
        self._ends()
        self._flags()
        self._bands()
        below = 62.0 + self._legend(legend)
        if title:
            self.ax.set_title(
                plain(title), loc="left", color=self.theme.ink, fontsize=TEXT * POINT, fontweight="bold",
                pad=(self.above + 6.0) * POINT,
            )
            self.above += 1.6 * TEXT + 6.0
        return below + self.above

    def heading(self, title: list[str], subtitle: list[str]) -> None:
        """Headlines above the panel."""
        for lines, size, weight in [(subtitle, SMALL, "normal"), (title, TITLE, "bold")]:
            if lines:
                self.ax.annotate(
                    plain("\n".join(lines)), (0.0, 1.0), xycoords="axes fraction",
                    xytext=(0.0, (self.above + 8.0) * POINT), textcoords="offset points", ha="left", va="bottom",
                    color=self.theme.ink, fontsize=size * POINT, fontweight=weight, annotation_clip=False,
                )
                self.above += 1.35 * size * len(lines) + 8.0

    def _axes(self) -> None:
        from matplotlib.ticker import MaxNLocator

        ax, theme = self.ax, self.theme
        width, height = self.size
        for axis, range_, which, room in [
            (self.panel.x, self.drawn.x, ax.xaxis, width / BETWEEN[0]),
            (self.panel.y, self.drawn.y, ax.yaxis, height / BETWEEN[1]),
        ]:
            steps = [1, 1.5, 3, 4.5, 6, 9, 10] if axis.unit == "deg" else [1, 2, 5, 10]
            if axis.logarithmic and range_[0] > 0.0:
                (ax.set_xscale if which is ax.xaxis else ax.set_yscale)("log")
            else:
                which.set_major_locator(MaxNLocator(nbins=max(3, int(room)), steps=steps))
        ax.set_xlim(*self.drawn.x)
        ax.set_ylim(*self.drawn.y)
        ax.set_xlabel(named(self.panel.x), color=theme.ink, fontsize=TEXT * POINT)
        ax.set_ylabel(named(self.panel.y), color=theme.ink, fontsize=TEXT * POINT)
        ax.grid(visible=True, color=theme.muted, alpha=0.3, linewidth=POINT, zorder=0.6)
        if self.drawn.y[0] < 0.0 < self.drawn.y[1]:
            ax.axhline(0.0, color=theme.ink, alpha=0.6, linewidth=POINT, zorder=0.7)

    def _zones(self) -> None:
        for zone in self.panel.zones:
            self.ax.axvspan(zone.from_, zone.to, zorder=0.5, **self._hatched(zone.hatching))

    def _hatched(self, hatching: str) -> dict[str, Any]:
        """The look of a hatched area."""
        from matplotlib.colors import to_rgba

        back = 0.0 if hatching == "dotted" else 0.10
        return {
            "facecolor": to_rgba(self.theme.muted, back),
            "edgecolor": to_rgba(self.theme.ink, 0.35),
            "hatch": HATCHES[hatching],
            "linewidth": 0.0,
        }

    def _bars(self) -> None:
        for bar in self.panel.bars:
            (left, right), (bottom, top) = bar.sides, bar.ends
            self.ax.bar(
                left, top - bottom, right - left, bottom, align="edge", color=self._series(bar.colour),
                edgecolor=self.theme.background, linewidth=POINT,
            )

    def _series(self, colour: int) -> str:
        return self.theme.series[colour % len(self.theme.series)]

    def _colour(self, branch: int) -> str:
        return self._series(self.figure.branches[branch].colour)

    def _lines(self) -> None:
        from matplotlib.markers import MarkerStyle

        for line in self.drawn.lines:
            x, y = line.points.T
            branches = [self.figure.branches[branch] for branch in line.branches]
            for style in _strokes([(branch.colour, branch.stroke) for branch in branches]):
                self.ax.plot(x, y, color=self._series(style.colour), linestyle=style.dashes, linewidth=CURVE * POINT)
        for line in self.drawn.lines:
            colour = self._colour(line.branches[0])
            if len(line.markers):
                self.ax.plot(*line.markers.T, linestyle="none", zorder=3, **self._marker(line.quantity, colour))
            for arrow in line.arrows:
                head = MarkerStyle(">").rotated(deg=arrow.angle)
                self.ax.plot(*arrow.at, marker=head, markersize=8 * POINT, color=colour, zorder=3)

    def _marker(self, quantity: int, colour: str) -> dict[str, Any]:
        """The marker of a quantity."""
        is_open = quantity // len(MARKERS) % 2 == 0
        return {
            "marker": MARKERS[quantity % len(MARKERS)],
            "markersize": 8.4 * POINT,
            "markerfacecolor": self.theme.background if is_open else colour,
            "markeredgecolor": colour,
            "markeredgewidth": 1.6 * POINT,
        }

    def _ends(self) -> None:
        """Ends of branches, arrowheads where curves leave the frame, marked points."""
        for curve in self.panel.curves:
            for end, point in zip(curve.ends, curve.points[[0, -1]] if len(curve.points) else (), strict=False):
                if end == "marked":
                    colour = self._colour(curve.branch)
                    self.ax.plot(*point, "o", markersize=6.4 * POINT, color=colour, zorder=3)
        for exit_ in self.drawn.exits:
            self.ax.plot(*exit_.at, zorder=4, clip_on=False, **_cut(self._colour(exit_.branch), exit_.upwards))
        for marked in self.panel.points:
            self.ax.plot(*marked.at, linestyle="none", zorder=5, **self._point(marked.kind))

    def _point(self, kind: str) -> dict[str, Any]:
        """The look of a marked point."""
        ink, paper = self.theme.ink, self.theme.background
        if kind in ("jam", "model"):
            colour = self.theme.warning if kind == "jam" else ink
            return {"marker": "x", "markersize": 10 * POINT, "color": colour, "markeredgewidth": 3.2 * POINT}
        marker, face = {"start": ("o", paper), "stop": ("s", ink), "end": ("^", paper)}[kind]
        return {
            "marker": marker, "markersize": 9 * POINT, "markerfacecolor": face, "markeredgecolor": ink,
            "markeredgewidth": 2 * POINT,
        }

    def _flags(self) -> None:
        """Vertical lines with labels above the frame."""
        ax, theme = self.ax, self.theme
        width = self.drawn.x[1] - self.drawn.x[0]
        for flag in self.drawn.flags:
            dashes = (0.0, (10 / 1.5, 3 / 1.5, 2 / 1.5, 3 / 1.5)) if flag.asymptote else (0.0, (2.0, 3.0))
            ax.axvline(flag.at, color=theme.ink, linestyle=dashes, linewidth=(1.5 if flag.asymptote else 1.0) * POINT)
            is_right = flag.left > self.size[0] * (flag.at - self.drawn.x[0]) / width
            side = ("left", 4.0) if is_right else ("right", -4.0)
            align, aside = side if flag.beside else ("right", 0.0)
            place = (flag.at if flag.beside else self.drawn.x[1], 1.0)
            ax.annotate(
                plain(flag.label), place, xycoords=("data", "axes fraction"),
                xytext=(aside * POINT, (4.0 + ROW * flag.row) * POINT), textcoords="offset points", ha=align, va="bottom",
                color=theme.ink, fontsize=SMALL * POINT, annotation_clip=False,
            )
            if flag.row:
                # The line up to its label.
                ax.annotate(
                    "", (flag.at, 1.0), xycoords=("data", "axes fraction"),
                    xytext=(0.0, (4.0 + ROW * flag.row) * POINT), textcoords="offset points", annotation_clip=False,
                    arrowprops={"arrowstyle": "-", "color": theme.ink, "linestyle": dashes, "linewidth": POINT,
                                "shrinkA": 0.0, "shrinkB": 0.0},
                )
        rows = max((flag.row + 1 for flag in self.drawn.flags), default=0)
        self.above = ROW * rows + (4.0 if rows else 0.0)

    def _bands(self) -> None:
        """Coloured stretches below the frame."""
        if not self.panel.bands:
            return
        from matplotlib.lines import Line2D
        from matplotlib.transforms import ScaledTranslation

        down = ScaledTranslation(0.0, -(3.0 + BAND / 2) * INCH, self.ax.figure.dpi_scale_trans)
        below = self.ax.get_xaxis_transform() + down
        least, greatest = self.drawn.x
        for band in self.panel.bands:
            ends = (max(band.from_, least), min(band.to, greatest))
            if ends[0] < ends[1]:
                line = Line2D(
                    ends, (0.0, 0.0), transform=below, color=self._series(band.colour), linewidth=BAND * POINT,
                    solid_capstyle="butt", clip_on=False, gid="band",
                )
                self.ax.add_artist(line)
        self.ax.tick_params(axis="x", length=0.0, pad=(BAND + 7.0) * POINT)

    def _legend(self, place: LegendPlace) -> float:
        """The legend within the panel or below it; returns its height below (px)."""
        from matplotlib.legend_handler import HandlerTuple
        from matplotlib.transforms import ScaledTranslation

        # Curves first, then points, then all else.
        entries = [entry for kinds in LEGENDS for entry in self.drawn.legend if entry.sample["kind"] in kinds]
        width = self.size[0]
        texts = [plain("\n".join(wrapped(entry.text, max(width - 60.0, 200.0), SMALL))) for entry in entries]
        handles = [self._handle(entry.sample, text) for entry, text in zip(entries, texts, strict=True)]
        if place is False or not entries:
            return 0.0
        look: dict[str, Any] = {
            "fontsize": SMALL * POINT, "labelcolor": self.theme.ink, "handlelength": 2.9,
            "handler_map": {tuple: HandlerTuple(ndivide=1, pad=0.0)},
        }
        if place is True:
            look |= {"facecolor": self.theme.background, "edgecolor": self.theme.muted, "loc": "best"}
            # What lies within the Axes needs no room beside them.
            self.ax.legend(handles, texts, **look).set_in_layout(False)
            return 0.0
        below = 62.0 if self.panel.bands else 48.0
        down = ScaledTranslation(0.0, -below * INCH, self.ax.figure.dpi_scale_trans)
        look |= {
            "loc": "upper left", "bbox_to_anchor": (0.0, 0.0), "bbox_transform": self.ax.transAxes + down,
            "borderaxespad": 0.0, "borderpad": 0.0, "columnspacing": 1.5, "frameon": False,
        }
        longest = max(len(line) for text in texts for line in text.split("\n"))
        columns = max(1, min(len(texts), int(width / (longest * LETTER * SMALL + 60.0))))
        box = self.ax.legend(handles, texts, ncols=columns, **look).get_window_extent()
        return below - 48.0 + float(box.height) / (self.ax.figure.dpi * INCH)

    def _handle(self, sample: Any, text: str) -> Artist | Container:
        """An entry of the legend as an artist of the Axes with its label, which draws nothing there."""
        from matplotlib.container import Container

        handle = self._sample(sample)
        if isinstance(handle, tuple):
            several = Container(handle, label=text)
            self.ax.add_container(several)
            return several
        handle.set_label(text)
        return self.ax.add_artist(handle)

    def _sample(self, sample: Any) -> Artist | tuple[Artist, ...]:
        """What stands in the legend beside a text."""
        from matplotlib.lines import Line2D
        from matplotlib.patches import Rectangle

        ink = self.theme.ink
        match sample["kind"], sample.get("value"):
            case "curve", (colour, stroke):
                strokes = _strokes([(colour, stroke)])
            case "several", colours:
                strokes = _strokes([(colour, "solid") for colour in colours])
            case "marker", quantity:
                return Line2D([], [], linestyle="none", **self._marker(quantity, ink))
            case "hatched", hatching:
                return Rectangle((0.0, 0.0), 0.0, 0.0, **self._hatched(hatching))
            case "filled", colour:
                return Rectangle((0.0, 0.0), 0.0, 0.0, facecolor=self._series(colour), linewidth=0.0)
            case "end", _:
                return Line2D([], [], linestyle="none", marker="o", markersize=6.4 * POINT, color=ink)
            case "point", kind:
                return Line2D([], [], linestyle="none", **self._point(kind))
            case _:
                return Line2D([], [], linestyle="none", marker="^", markersize=9 * POINT, color=ink)
        lines = tuple(
            Line2D([], [], color=self._series(style.colour), linestyle=style.dashes, linewidth=CURVE * POINT)
            for style in strokes
        )
        return lines[0] if len(lines) == 1 else lines


class _Stroke(NamedTuple):
    colour: int
    dashes: Any


def _strokes(branches: Sequence[tuple[int, str]]) -> list[_Stroke]:
    """The strokes of a line; one that stands for several branches has dashes of all their colours."""
    if len(branches) == 1:
        ((colour, stroke),) = branches
        return [_Stroke(colour, DASHES[stroke])]
    rest = DASH * (len(branches) - 1)
    shared = [_Stroke(colour, (-DASH * index, (DASH, rest))) for index, (colour, _) in enumerate(branches)]
    # The first colour lies beneath those of the others.
    return [_Stroke(shared[0].colour, "-"), *shared[1:]]


def _cut(colour: str, upwards: bool) -> dict[str, Any]:
    """The look of an arrowhead where a curve leaves the frame."""
    from matplotlib.markers import CARETDOWN, CARETUP

    return {
        "marker": CARETUP if upwards else CARETDOWN,
        "markersize": 9 * POINT,
        "color": colour,
        "linestyle": "none",
        "markeredgewidth": 0.0,
    }
