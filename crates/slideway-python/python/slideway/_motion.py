"""A motion in time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _display, plotting

if TYPE_CHECKING:
    from . import _slideway, reports


class Motion:
    """A motion in time. `t`, `y` and `events` are as those of `scipy.integrate.solve_ivp`; `report` has all else.

    >>> import slideway
    >>> motion = slideway.Model.gallery("frictional-oscillator").simulate(3.0)
    >>> motion.y.shape == (2, len(motion.t))
    True
    """

    def __init__(self, motion: _slideway.Motion, report: reports.SimulateReport) -> None:
        self._motion = motion
        self.report = report
        """The report: events, phases, how it ends, energy."""
        self.t: NDArray[np.float64] = motion.times()
        """The times of the steps of the solver (s), events included."""

    @property
    def y(self) -> NDArray[np.float64]:
        """One row for each coordinate, then one for each rate; a column for each time of `t`."""
        return self._motion.states(self.t.tolist())

    def sol(self, t: ArrayLike) -> NDArray[np.float64]:
        """The same at other times, between which is interpolated as the solver does it. Times outside of the motion
        are NaN."""
        if np.ndim(t) > 1:
            raise ValueError("t must be a time or a list of times")
        times = np.atleast_1d(np.asarray(t, dtype=np.float64))
        inside = (times >= self.t[0]) & (times <= self.t[-1])
        states = np.full((len(self.coordinates) * 2, len(times)), np.nan)
        states[:, inside] = self._motion.states(times[inside].tolist())
        return states[:, 0] if np.ndim(t) == 0 else states

    @property
    def coordinates(self) -> list[str]:
        """The names of the coordinates, in the order of the rows of `y`."""
        return [state.name for state in self.report.initial]

    @property
    def events(self) -> tuple[reports.EventReport, ...]:
        """What happened, in chronological order."""
        return self.report.events

    @property
    def status(self) -> reports.EndKind:
        """Why it ends."""
        return self.report.end.kind

    def table(self, step: float | None = None, *, times: Sequence[float] | None = None) -> dict[str, NDArray[Any]]:
        """All quantities as arrays by their names: coordinates, rates, accelerations, forces, energies, and the
        contact mode. At the steps of the solver, in even steps (s), or at these times."""
        wanted = self._motion.times(step) if times is None else np.asarray(times, dtype=np.float64)
        series = self._motion.table(wanted.tolist())
        table: dict[str, NDArray[Any]] = {column.name: column.values for column in series.columns}
        table["mode"] = np.array(series.modes)
        return table

    def plot(
        self, ax: Any = None, *, phase_portrait: bool = False, theme: plotting.ThemeName = "light"
    ) -> Any:
        """Draws coordinates, normal forces with the contact modes, and energies over time, or with `phase_portrait` the
        rate of each coordinate over its value, on Axes of matplotlib, or on those of a new figure, and returns them: the
        Axes, or an array of them if there are several panels."""
        figure = self._motion.plotted(phase_portrait)

        def drawn(width: float, height: float) -> list[reports.DrawnPanel]:
            return self._motion.drawn(phase_portrait, width, height)

        return plotting.plot_figure(figure, drawn, ax, theme=theme)

    def animate(
        self, *, slow_motion: float | None = None, theme: plotting.ThemeName = "light"
    ) -> _display.Animation:
        """The mechanism moving, with the contact mode at each time: it plays in a notebook, and
        `animate().save("motion.html")` writes a page. `slow_motion` is how many times longer it takes than the motion;
        by default what makes it easy to watch."""
        return _display.Animation(self._motion.animation(theme, slow_motion), self.report._headline())

    def _repr_html_(self) -> str:
        return _display.motion_html(self)

    def text(self, *, all_events: bool = False, color: bool = False) -> str:
        """The log of the motion, as the command line shows it."""
        return self._motion.text_with_all_events(color) if all_events else self.report.text(color=color)

    def to_json(self) -> str:
        """The JSON output of the command line."""
        return self.report.to_json()

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return f"<slideway.Motion: {len(self.events)} events, until {self.t[-1]:g} s, {self.status}>"
