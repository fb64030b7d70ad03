"""What classes of `slideway.reports` have beside the fields of the JSON output. A class here is a base of the class of
the same name there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, Generic, SupportsIndex, TypeVar, overload

import numpy as np
from numpy.typing import NDArray

from . import _display, plotting
from ._slideway import frozen_array

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from . import reports
    from ._slideway import Answer


EMPTY: NDArray[np.float64] = frozen_array([])
"""An array that is absent in the JSON output."""


One = TypeVar("One")
# Lines of the representation of a solution at most.
LINES = 10


class Solution:
    """Arrays of a solution, and a representation that fits a screen."""

    pattern: str
    joints: tuple[reports.JointMode, ...]
    contacts: tuple[reports.Contact, ...]
    accelerations: tuple[reports.CoordinateAcceleration, ...]
    drives: tuple[reports.Drive, ...]

    @property
    def normal_forces(self) -> NDArray[np.float64]:
        """The normal force of each contact, with its sign (N)."""
        return frozen_array([contact.normal_force for contact in self.contacts])

    @property
    def friction_forces(self) -> NDArray[np.float64]:
        """The friction force of each contact, positive against positive sliding (N)."""
        return frozen_array([contact.friction_force for contact in self.contacts])

    @property
    def efforts(self) -> NDArray[np.float64]:
        """The effort of each drive (N or N m)."""
        return frozen_array([drive.effort for drive in self.drives])

    def __repr__(self) -> str:
        """Ten lines at most: the mode, and the forces; `to_dict()` has all there is."""
        rows = [f"{joint.name}: {joint.mode}" for joint in self.joints]
        rows += [
            f"{contact.name}: normal force {contact.normal_force:.5g} N, friction {contact.friction_force:.5g} N"
            for contact in self.contacts
        ]
        rows += [f"{drive.name}: effort {drive.effort:.5g} {drive.unit}" for drive in self.drives]
        room = LINES - 2
        if len(rows) > room:
            rows[room - 1 :] = [f"... {len(rows) - room + 1} more"]
        lines = "".join(f"\n  {row}" for row in rows)
        signs = f", signs {' '.join(self.pattern)}" if self.pattern else ""
        return f"<slideway.Solution{signs}{lines}\n  all of it: to_dict()>"


class _Solutions(Generic[One]):
    """An answer that is a sequence of its solutions."""

    if TYPE_CHECKING:
        solutions: tuple[One, ...]

    @overload
    def __getitem__(self, index: SupportsIndex) -> One: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[One, ...]: ...
    def __getitem__(self, index: SupportsIndex | slice) -> One | tuple[One, ...]:
        return self.solutions[index]

    def __iter__(self) -> Iterator[One]:
        return iter(self.solutions)

    def __len__(self) -> int:
        return len(self.solutions)

    def __bool__(self) -> bool:
        return True


class _Plot:
    """An answer that has a plot."""

    _answer: Answer
    conclusion: tuple[str, ...]

    def plot(
        self, ax: Any = None, *, legend: plotting.LegendPlace | None = None, theme: plotting.ThemeName = "light"
    ) -> Any:
        """Draws the plot with matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; an array of them if there are several panels. Default: the Axes of a new figure.
        legend : bool or "outside", optional
            Whether there is a legend within the Axes, or below them. Default: below the Axes of a new figure, within
            given ones.
        theme : {"light", "dark"}

        Returns
        -------
        Axes or array of Axes

        Examples
        --------
        >>> import slideway
        >>> ax = slideway.Model.gallery("drawer").limits("mu", 0, 1).plot()   # doctest: +SKIP
        """
        plot = self._answer.plot()
        return plotting.plot_figure(plot.figure(), plot.drawn, ax, legend=legend, theme=theme)

    def _repr_html_(self) -> str:
        return _display.plot_html(self._answer, self.conclusion)


class LimitsReport(_Plot):
    """Limits have a plot."""

    def _repr_html_(self) -> str:
        return _display.limits_html(self._answer)


class SizeReport(_Plot):
    """A design has a plot."""


class DriveReport(_Plot):
    """Efforts over what is varied have a plot."""

    course: reports.Course | None

    def plot(
        self, ax: Any = None, *, legend: plotting.LegendPlace | None = None, theme: plotting.ThemeName = "light"
    ) -> Any:
        """Draws the efforts over what is varied with matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; an array of them if there are several panels. Default: the Axes of a new figure.
        legend : bool or "outside", optional
            Whether there is a legend within the Axes, or below them. Default: below the Axes of a new figure, within
            given ones.
        theme : {"light", "dark"}

        Returns
        -------
        Axes or array of Axes

        Raises
        ------
        ValueError
            Nothing was varied.

        Examples
        --------
        >>> import slideway
        >>> ax = slideway.Model.gallery("drawer").drive("mu", (0, 0.6)).plot()   # doctest: +SKIP
        """
        if self.course is None:
            raise ValueError("there is nothing to plot: ask with a range, such as model.drive(\"mu\", (0, 1))")
        return super().plot(ax, legend=legend, theme=theme)

    def _repr_html_(self) -> str:
        return super()._repr_html_() if self.course else _display.text_html(self._answer)


class MapReport:
    """A map has a plot, and pixels."""

    _answer: Answer
    x: reports.MapAxis
    y: reports.MapAxis
    guarantee: str

    def pixels(self) -> NDArray[np.intp]:
        """The class of each pixel, an index into `classes`.

        Returns
        -------
        array of int
            A row for each row of the map from the bottom, a column for each of its columns from the left.

        Examples
        --------
        >>> import slideway
        >>> plane = slideway.Model.gallery("drawer").map(mu=(0, 1), L=("0.3 m", "0.5 m"), size=(4, 3))
        >>> plane.pixels().shape
        (3, 4)
        """
        return np.array(self._answer.pixels(), dtype=np.intp).reshape(self.y.pixels, self.x.pixels)

    def _kept(self) -> dict[str, Any]:
        drawn = {theme: self._answer.drawn_map(theme) for theme in ("light", "dark")}
        return {"pixels": self.pixels(), "drawn_map": drawn}

    def plot(
        self,
        ax: Axes | None = None,
        *,
        legend: plotting.LegendPlace | None = None,
        theme: plotting.ThemeName = "light",
    ) -> Axes:
        """Draws the map with matplotlib.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw. Default: the Axes of a new figure.
        legend : bool or "outside", optional
            Whether there is a legend within the Axes, or beside them. Default: beside the Axes of a new figure, within
            given ones.
        theme : {"light", "dark"}

        Returns
        -------
        Axes

        Examples
        --------
        >>> import slideway
        >>> plane = slideway.Model.gallery("drawer").map(mu=(0, 1), L=("0.3 m", "0.5 m"), size=(4, 3))
        >>> ax = plane.plot()   # doctest: +SKIP
        """
        return plotting.plot_map(self._answer.drawn_map(theme), self.pixels(), ax, legend=legend, theme=theme)

    def _repr_html_(self) -> str:
        return _display.plot_html(self._answer, [self.guarantee])


class _Drawn:
    """An answer in words that is shown beside the mechanism."""

    _answer: Answer

    def _repr_html_(self) -> str:
        return _display.drawn_html(self._answer)


class CheckReport(_Drawn):
    """What a model is, is shown with the mechanism."""


class HoldReport(_Drawn):
    """What holds is shown with the mechanism."""


class RestLimitsReport(_Drawn):
    """Limits of rest are shown with the mechanism."""


class TreeReport(_Drawn):
    """All motions are shown with the mechanism."""


class SolveReport(_Solutions["reports.Solution"]):
    """A solve report is a sequence of its solutions."""

    _answer: Answer

    def draw(self, solution: int | None = None, *, theme: plotting.ThemeName = "light") -> _display.Drawing:
        """A drawing of the mechanism with the forces of its solutions.

        Parameters
        ----------
        solution : int, optional
            Which solution, from 1. Default: all of them.
        theme : {"light", "dark"}

        Returns
        -------
        Drawing

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").solve().draw()
        <slideway.Drawing: A drawer pushed off-centre>
        """
        return _display.Drawing(self._answer.drawing(theme, solution))

    def _repr_html_(self) -> str:
        return _display.solve_html(self._answer, len(self.solutions))


class RawReport(_Solutions["reports.RawSolution"]):
    """A raw report is a sequence of its solutions."""

    _answer: Answer

    def _repr_html_(self) -> str:
        return _display.text_html(self._answer)
