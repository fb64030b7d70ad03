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
    """A motion in time. `t`, `y` and `sol` are as those of `scipy.integrate.solve_ivp`; `report` has all else.

    Two things differ from it: `events` has whatever happened in its order, with time, causes and what follows, in the place
    of `t_events` and `y_events`; and `status` is a word, such as `"finished"`, in the place of a number. A motion that was
    pickled keeps its steps, table and report; it has no pictures, and no states between its steps.

    >>> import slideway
    >>> motion = slideway.Model.gallery("frictional-oscillator").simulate(3.0)
    >>> motion.y.shape == (2, len(motion.t))
    True
    """

    def __init__(self, motion: _slideway.Motion, report: reports.SimulateReport) -> None:
        self._motion: Any = motion
        self.report = report
        """The report: events, phases, how it ends, energy."""
        self.t: NDArray[np.float64] = motion.times()
        """The times of the steps of the solver (s), events included."""

    @property
    def y(self) -> NDArray[np.float64]:
        """One row for each coordinate, then one for each rate; a column for each time of `t`."""
        states: NDArray[np.float64] = self._motion.states(self.t.tolist())
        return states

    def sol(self, t: ArrayLike) -> NDArray[np.float64]:
        """The state at any times, as the solver interpolates it.

        Parameters
        ----------
        t : float or array
            Times (s).

        Returns
        -------
        array
            The coordinates, then their rates; a column for each time if `t` is an array. NaN outside of the motion.

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").simulate("0.1 s").sol([0.0, 0.05])     # driven with 0.1 m/s
        array([[0.   , 0.005],
               [0.1  , 0.1  ]])
        """
        if np.ndim(t) > 1:
            raise ValueError("t must be a time or a list of times")
        times = np.atleast_1d(_real("t", t))
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
        """All quantities as arrays by their names: coordinates, rates, accelerations, forces, energies, contact mode.

        Parameters
        ----------
        step : float, optional
            Even steps of time (s). Default: the steps of the solver.
        times : list of float, optional
            The times instead (s), within the motion.

        Returns
        -------
        dict of array

        Raises
        ------
        ValueError
            A step that is not positive, or times outside of the motion.

        Examples
        --------
        >>> import slideway
        >>> table = slideway.Model.gallery("drawer").simulate("0.1 s").table(times=[0.0, 0.05])
        >>> table["x"], table["mode"]
        (array([0.   , 0.005]), array(['+-', '+-'], dtype='<U2'))
        """
        if times is None:
            wanted = self.t if step is None else self._motion.times(step)
        else:
            wanted = _real("times", times)
            if wanted.ndim != 1:
                raise ValueError("times must be a list of times")
            if not np.all((wanted >= self.t[0]) & (wanted <= self.t[-1])):
                raise ValueError(f"times must be from {self.t[0]:g} to {self.t[-1]:g} s")
        series = self._motion.table(wanted.tolist())
        table: dict[str, NDArray[Any]] = {column.name: column.values for column in series.columns}
        table["mode"] = np.array(series.modes)
        return table

    def plot(
        self,
        ax: Any = None,
        *,
        phase_portrait: bool = False,
        legend: plotting.LegendPlace | None = None,
        theme: plotting.ThemeName = "light",
    ) -> Any:
        """Draws the motion with matplotlib.

        Parameters
        ----------
        ax : array of Axes, optional
            Where to draw. Default: the Axes of a new figure.
        phase_portrait : bool, default False
            The rate of each coordinate over its value, instead of coordinates, normal forces with the contact modes, and
            energies over time.
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
        >>> axes = slideway.Model.gallery("frictional-oscillator").simulate(3).plot()   # doctest: +SKIP
        """
        plot = self._motion.plot(phase_portrait)
        return plotting.plot_figure(plot.figure(), plot.drawn, ax, legend=legend, theme=theme)

    def animate(
        self, *, slow_motion: float | None = None, theme: plotting.ThemeName = "light"
    ) -> _display.Animation:
        """The mechanism moving, with the contact mode at each time.

        Parameters
        ----------
        slow_motion : float, optional
            How many times longer it takes than the motion. Default: what makes it easy to watch.
        theme : {"light", "dark"}

        Returns
        -------
        Animation
            It plays in a notebook; `save("motion.html")` writes a page.

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").simulate("0.1 s").animate()
        <slideway.Animation: A drawer pushed off-centre: ...>
        """
        return _display.Animation(self._motion.animation(theme, slow_motion), self.report._headline())

    def _repr_html_(self) -> str:
        return _display.words_html(self.text()) if isinstance(self._motion, Kept) else _display.motion_html(self)

    def text(self, *, all_events: bool = False, color: bool = False) -> str:
        """The log of the motion, as the command line shows it.

        Parameters
        ----------
        all_events : bool, default False
            Whether to list all events instead of the first and last ones.
        color : bool, default False
            With colours for a terminal.

        Returns
        -------
        str

        Examples
        --------
        >>> import slideway
        >>> print(slideway.Model.gallery("drawer").simulate("0.1 s").text().splitlines()[0])
        A drawer pushed off-centre
        """
        return self._motion.text_with_all_events(color) if all_events else self.report.text(color=color)

    def to_json(self) -> str:
        """The JSON output of the command line.

        Returns
        -------
        str

        Examples
        --------
        >>> import json, slideway
        >>> json.loads(slideway.Model.gallery("drawer").simulate("0.1 s").to_json())["end"]["kind"]
        'finished'
        """
        return self.report.to_json()

    def __str__(self) -> str:
        return self.text()

    def __getstate__(self) -> dict[str, Any]:
        kept = Kept(self.t, self.y, self._motion.table(self.t.tolist()), self.text(all_events=True))
        return {**self.__dict__, "_motion": kept}

    def __repr__(self) -> str:
        return f"<slideway.Motion: {len(self.events)} events, until {self.t[-1]:g} s, {self.status}>"


def _real(name: str, given: ArrayLike) -> NDArray[np.float64]:
    """Numbers of an argument; complex ones would lose their imaginary parts."""
    if np.iscomplexobj(given):
        raise TypeError(f"{name} must be real, not complex")
    return np.asarray(given, dtype=np.float64)


class Kept:
    """What is kept of a motion that was pickled: states and table at its steps, and the log with all events."""

    def __init__(self, t: NDArray[np.float64], y: NDArray[np.float64], series: reports.Series, text: str) -> None:
        self._t, self._y, self._series, self._text = t, y, series, text

    def _steps(self, times: Sequence[float]) -> NDArray[np.intp]:
        """The steps at these times."""
        steps = np.minimum(np.searchsorted(self._t, times), len(self._t) - 1)
        if not np.array_equal(self._t[steps], times):
            raise ValueError("a motion that was pickled has its steps only, `t`: ask the model again")
        return steps

    def states(self, times: Sequence[float]) -> NDArray[np.float64]:
        if len(times) == len(self._t) and np.array_equal(self._t, times):
            return self._y
        states: NDArray[np.float64] = self._y[:, self._steps(times)]
        return states

    def table(self, times: Sequence[float]) -> reports.Series:
        if not np.array_equal(self._t, times):
            raise ValueError("a motion that was pickled has the table of its steps only: ask the model again")
        return self._series

    def text_with_all_events(self, color: bool) -> str:
        return self._text

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        raise AttributeError("a motion that was pickled has no pictures: ask the model again", name=name, obj=self)
