"""
The private half of the package; see `slideway`.

Written by `tools/generate_stubs.py`; not to be edited.
"""

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Final, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _display, _motion, _sweep, reports
from ._values import BySide, ContactValues, End, Pair, Progress, Range, Value


__all__ = ["GROUND", "Answer", "Mechanism", "Model", "Motion", "Table", "gallery_models", "hlcp", "lcp", "merge", "mode_problem", "png", "printable", "solve", "theme"]

GROUND: Final[str]
"""
The fixed frame, where the name of a body is expected.
"""

@final
class Answer:
    """
    A report, and what its pictures are made of.
    """
    def drawing(self, /, theme_name: str, solution: int | None = None, gap_state: int | None = None) -> str:
        """
        A drawing of the mechanism and its solutions, of one of them, or of one state of a preload gap, counted from
        1, as SVG.
        """
    def drawn(self, /, width: float, height: float) -> list[reports.DrawnPanel]:
        """
        What the panels of the plot show in frames of this width and height (px, of which small text has 13).
        """
    def drawn_map(self, /, theme_name: str) -> reports.DrawnMap:
        """
        A map in words and colours.
        """
    def fields(self, /) -> dict[str, object]:
        """
        The attributes of the report.
        """
    def figure(self, /) -> reports.Figure:
        """
        The plot as plain data.
        """
    def json(self, /) -> str:
        """
        The JSON output.
        """
    def parts(self, /) -> list[str]:
        """
        The answer in HTML: for solutions what they have in common, then a part for each; for limits one part.
        """
    def pixels(self, /) -> list[int]:
        """
        The classes of the pixels of a map, row by row from the bottom.
        """
    def plot_svg(self, /, theme_name: str) -> str:
        """
        The plot as SVG.
        """
    def text(self, /, color: bool) -> str:
        """
        The text output, with colours for a terminal if wanted.
        """

@final
class Mechanism:
    """
    A mechanism that is put together in code.

    It says what a model file says, with the same defaults and meaning, and `build` gives the `Model`. Bodies,
    joints and coordinates are added before others refer to them by their names, which the methods return.
    Values are numbers in SI units, or texts with a unit or an expression of parameters. Places are those of the
    drawing, in its fixed axes (m).

    Parameters
    ----------
    title : str, optional
        One line that says what the mechanism is.
    gravity : float or str or pair, optional
        Acceleration of free fall along -y, or its two components (m/s^2). Default: none.
    time : float or str, optional
        Time of the state, `t` in expressions (s). Default: 0.

    Examples
    --------
    A drawer of 2 kg in a rail, pushed beside its middle:

    >>> from slideway import GROUND, Mechanism
    >>> m = Mechanism("Drawer")
    >>> mu = m.parameter("mu", 0.3)
    >>> drawer = m.body("drawer", mass=2.0, centre=(0, 0.1), inertia=0.05)
    >>> rail = m.block_slider("rail", drawer, GROUND, at=(0, 0), length="400 mm", mu=mu)
    >>> push = m.force("push", drawer, at=(-0.2, 0.15), components=(20, 0))
    >>> x = m.slide("x", rail, rate=1.0)
    >>> model = m.build()
    >>> model.solve().status
    'one'
    >>> model.with_(mu=3).solve().status
    'none'
    """
    def __copy__(self, /) -> Mechanism: ...
    def __deepcopy__(self, /, _memo: object) -> Mechanism: ...
    def __new__(cls, /, title: str | None = None, *, gravity: Value | Pair | None = None, time: Value | None = None) -> Mechanism: ...
    def __repr__(self, /) -> str: ...
    def block_slider(self, /, name: str, block: str, guide: str, *, at: Pair, length: Value, along: Value | None = None, height: Value | None = None, around: bool = False, travel: Pair | None = None, restitution: Value | None = None, mu: Value | BySide | None = None, mu_static: Value | None = None, preload: Value | BySide | None = None, centred_preload: bool = False, stiffness: Value | None = None, pad: Pair | None = None, front: ContactValues | None = None, rear: ContactValues | None = None) -> str:
        """
        Adds a block slider: a carriage, sledge or bushing with a contact at each end.

        Parameters
        ----------
        name : str
        block, guide : str
            Its bodies; either can be `GROUND`.
        at : pair
            Middle of the block in the drawing (m).
        length : float or str
            Distance of its contacts (m).
        along : float or str
            Direction of positive sliding: the angle from the x axis (rad). Default: 0.
        height : float or str
            Distance of the two rubbing faces (m). Default: 0.
        around : bool
            The block surrounds the guide, as a sleeve its rod. Default: it is inside.
        travel : pair
            Limits of the displacement (m).
        restitution : float or str
            Stops at both ends of the travel, with this coefficient of restitution from 0 to 1.
        mu : float or str or mapping
            Coefficient of kinetic friction; `{"plus": 0.2, "minus": 0.3}` for positive and for negative normal
            force. Every contact needs one, here or in `front` and `rear`.
        mu_static : float or str
            Coefficient of static friction. Default: that of kinetic friction.
        preload : float or str or mapping
            Friction at zero normal force (N), by side as for `mu`. Default: 0.
        centred_preload : bool
            The preload's friction acts on the centre line. Default: at the pressed face.
        stiffness : float or str
            Stiffness of the guide at a contact (N/m), for attainability.
        pad : pair
            Length and width of the area in contact at a contact (m), for the bearing pressure.
        front, rear : mapping
            What differs at the end in the direction of `along`, or at the other: `mu`, `mu_static`, `preload`,
            `stiffness`, `pad`, `centred_preload`, and `carried_by_guide`, for a contact that stays at a place of
            the guide.

        Returns
        -------
        str
            The name.

        Raises
        ------
        ModelError
            There is no such body.

        Examples
        --------
        >>> import slideway
        >>> m = slideway.Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0.1))
        >>> m.block_slider("rail", drawer, slideway.GROUND, at=(0, 0), length=0.4, mu=0.2, front={"mu": 0.3})
        'rail'
        >>> m.block_slider("other", "drawr", slideway.GROUND, at=(0, 0), length=0.4, mu=0.2)
        Traceback (most recent call last):
            ...
        slideway._errors.ModelError: argument block: there is no body named `drawr`
            hint: did you mean `drawer`?
        """
    def body(self, /, name: str, *, mass: Value | None = None, inertia: Value | None = None, centre: Pair | None = None, rectangle: Pair | None = None, disc: Value | None = None, bar: Sequence[Pair] | NDArray[np.floating] | None = None, outline: Sequence[Pair] | NDArray[np.floating] | None = None, massless: bool = False) -> str:
        """
        Adds a rigid body.

        Parameters
        ----------
        name : str
        mass : float or str
            Greater than zero (kg).
        inertia : float or str
            Moment of inertia about the centre of mass (kg m^2). In its place a homogeneous shape can be given:
            `rectangle`, `disc` or `bar`.
        centre : pair
            Centre of mass in the drawing (m).
        rectangle : pair
            Width and height of a homogeneous rectangle about the centre of mass (m).
        disc : float or str
            Radius of a homogeneous disc about the centre of mass (m).
        bar : pair of pairs
            The ends of a thin bar in the drawing (m), in place of a centre of mass, too.
        outline : sequence of pairs
            The corners of a polygon in the drawing (m), at least three: what it looks like.
        massless : bool
            A body without mass.

        Returns
        -------
        str
            The name.

        Examples
        --------
        >>> import slideway
        >>> m = slideway.Mechanism()
        >>> m.body("rod", mass="0.5 kg", bar=((0, 0), (0, "200 mm")))
        'rod'
        """
    def build(self, /) -> Model:
        """
        The model.

        Returns
        -------
        Model

        Raises
        ------
        ModelError
            With everything that is wrong; lines and columns are those of `to_toml()`.
        """
    def damper(self, /, name: str, first: End, second: End, *, damping: Value) -> str:
        """
        Adds a linear damper.

        Parameters
        ----------
        name : str
        first, second : pair
            Its ends, each a body and a place of the drawing that moves with it.
        damping : float or str
            In N s/m.

        Returns
        -------
        str
            The name.
        """
    def drive_by_force(self, /, name: str, coordinate: str, body: str, *, at: Pair, direction: Value, acceleration: Value | None = None, turning: bool = False, reaction: str | None = None) -> str:
        """
        Prescribes the motion of a coordinate by an unknown force on a body.

        Parameters
        ----------
        name, coordinate, body : str
        at : pair
            Where the force acts, as a place of the drawing that moves with the body (m).
        direction : float or str
            Its angle from the x axis (rad).
        acceleration : float or str
            The prescribed acceleration of the coordinate (m/s^2 or rad/s^2). Default: 0.
        turning : bool
            The direction turns with the body. Default: it is fixed in space.
        reaction : str
            The opposite force acts on this body. Default: on none.

        Returns
        -------
        str
            The name.
        """
    def drive_by_torque(self, /, name: str, coordinate: str, body: str, *, acceleration: Value | None = None, reaction: str | None = None) -> str:
        """
        Prescribes the motion of a coordinate by an unknown torque on a body.

        Parameters
        ----------
        name, coordinate, body : str
        acceleration : float or str
            The prescribed acceleration of the coordinate (m/s^2 or rad/s^2). Default: 0.
        reaction : str
            The opposite torque acts on this body. Default: on none.

        Returns
        -------
        str
            The name.
        """
    def force(self, /, name: str, body: str, *, at: Pair, components: Pair | None = None, magnitude: Value | None = None, direction: Value | None = None, turning: bool = False, reaction: str | None = None) -> str:
        """
        Adds a force on a body.

        Parameters
        ----------
        name, body : str
        at : pair
            Where it acts, as a place of the drawing that moves with the body (m).
        components : pair
            Its components (N), or else:
        magnitude, direction : float or str
            Its magnitude (N), and its angle from the x axis (rad).
        turning : bool
            It turns with the body. Default: its direction is fixed in space.
        reaction : str
            The opposite force acts on this body at the same place. Default: on none.

        Returns
        -------
        str
            The name.
        """
    def guided_slider(self, /, name: str, block: str, guide: str, *, at: Pair, length: Value, mu: Value | BySide, along: Value | None = None, height: Value | None = None, around: bool = False, travel: Pair | None = None, restitution: Value | None = None, mu_static: Value | None = None, preload: Value | BySide | None = None, centred_preload: bool = False, stiffness: Value | None = None, pad: Pair | None = None) -> str:
        """
        Adds a guided slider: it is pressed on one side along its whole length, with one normal force and a couple.

        Parameters
        ----------
        name : str
        block, guide : str
            Its bodies; either can be `GROUND`.
        at, length, along, height, around, travel, restitution, mu, mu_static, preload, centred_preload, stiffness, pad
            As for `block_slider`; `length` is that of the pressed face.

        Returns
        -------
        str
            The name.
        """
    def hinge(self, /, name: str, first: str, second: str, at: Pair) -> str:
        """
        Adds a frictionless hinge between two bodies, or a body and `GROUND`.

        Parameters
        ----------
        name : str
        first, second : str
            Its bodies. The hinge force is counted on the first.
        at : pair
            Its place in the drawing (m).

        Returns
        -------
        str
            The name.
        """
    def parameter(self, /, name: str, value: Value) -> str:
        """
        Adds a named number, for expressions and for `Model.with_`.

        Parameters
        ----------
        name : str
        value : float or str
            Such as `0.3` or `"25 mm"`.

        Returns
        -------
        str
            The name.

        Examples
        --------
        >>> import slideway
        >>> m = slideway.Mechanism()
        >>> m.parameter("L", "400 mm")
        'L'
        """
    def pin_in_slot(self, /, name: str, pin: str, slot: str, *, at: Pair, mu: Value | BySide, along: Value | None = None, travel: Pair | None = None, restitution: Value | None = None, mu_static: Value | None = None, preload: Value | BySide | None = None, stiffness: Value | None = None, pad: Pair | None = None) -> str:
        """
        Adds a pin of the first body in a slot of the second: one contact.

        Parameters
        ----------
        name : str
        pin, slot : str
            Its bodies; either can be `GROUND`.
        at : pair
            The pin in the drawing (m).
        along, travel, restitution, mu, mu_static, preload, stiffness, pad
            As for `block_slider`; `along` is the direction of the slot.

        Returns
        -------
        str
            The name.
        """
    def rotation(self, /, name: str, body: str, *, relative_to: str | None = None, drawn_at: Value | None = None, value: Value | None = None, rate: Value | None = None) -> str:
        """
        Chooses the rotation of a body as a coordinate.

        Parameters
        ----------
        name, body : str
        relative_to : str
            The body against which it is counted. Default: ground.
        drawn_at, value : float or str
            Its values in the drawing and in the state (rad), as for `slide`.
        rate : float or str
            Its rate of change in the state (rad/s). Default: 0.

        Returns
        -------
        str
            The name.
        """
    def slide(self, /, name: str, slider: str, *, drawn_at: Value | None = None, value: Value | None = None, rate: Value | None = None) -> str:
        """
        Chooses the displacement of a block against its guide as a coordinate.

        Parameters
        ----------
        name, slider : str
        drawn_at : float or str
            Its value in the drawing (m). Default: 0.
        value : float or str
            Its value in the state (m). Default: that in the drawing.
        rate : float or str
            Its rate of change in the state (m/s). Default: 0.

        Returns
        -------
        str
            The name.
        """
    def spring(self, /, name: str, first: End, second: End, *, stiffness: Value, free_length: Value | None = None) -> str:
        """
        Adds a linear spring.

        Parameters
        ----------
        name : str
        first, second : pair
            Its ends, each a body and a place of the drawing that moves with it: `("drawer", (0, 0.1))`.
        stiffness : float or str
            In N/m.
        free_length : float or str
            Its length without force (m). Default: that in the drawing.

        Returns
        -------
        str
            The name.
        """
    def to_toml(self, /) -> str:
        """
        The model file that says the same.

        Returns
        -------
        str
            TOML, which `Model.parse` and the command line read.

        Examples
        --------
        >>> import slideway
        >>> m = slideway.Mechanism("Nothing yet", gravity=9.81)
        >>> print(m.to_toml(), end="")
        title = "Nothing yet"
        gravity = 9.81
        """
    def torque(self, /, name: str, body: str, moment: Value, *, reaction: str | None = None) -> str:
        """
        Adds a torque on a body.

        Parameters
        ----------
        name, body : str
        moment : float or str
            Counter-clockwise positive (N m).
        reaction : str
            The opposite torque acts on this body. Default: on none.

        Returns
        -------
        str
            The name.
        """
    def torsional_damper(self, /, name: str, first: str, second: str, *, damping: Value) -> str:
        """
        Adds a torsional damper between two bodies.

        Parameters
        ----------
        name, first, second : str
        damping : float or str
            In N m s per rad.

        Returns
        -------
        str
            The name.
        """
    def torsional_spring(self, /, name: str, first: str, second: str, *, stiffness: Value, free_angle: Value | None = None) -> str:
        """
        Adds a torsional spring between two bodies.

        Parameters
        ----------
        name, first, second : str
        stiffness : float or str
            In N m per rad.
        free_angle : float or str
            The rotation of the first body against the second at which it has no torque, from the drawing (rad).
            Default: 0.

        Returns
        -------
        str
            The name.
        """

@final
class Model:
    """
    A planar mechanism with dry friction, in one state: a model file and what was changed in it. It never changes;
    `with_` gives another one.
    """
    def __copy__(self, /) -> Model: ...
    def __deepcopy__(self, /, _memo: object) -> Model: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __reduce__(self, /) -> tuple[object, ...]: ...
    def __repr__(self, /) -> str: ...
    def _coordinate_texts(self, /) -> list[tuple[str, str, str]]:
        """
        The coordinates as texts: name, value and rate.
        """
    def _parameter_texts(self, /) -> list[tuple[str, str, str]]:
        """
        The parameters as texts: name, value, and the range between whose ends it is known, if it has one.
        """
    def _repr_html_(self, /) -> str:
        """
        What a notebook shows: the drawing, parameters, coordinates and warnings.
        """
    @staticmethod
    def _restore(text: str, kept_settings: Sequence[tuple[str, str, Value]], units_name: str | None) -> Model:
        """
        The model that was pickled.
        """
    def check(self, /) -> reports.CheckReport:
        """
        What the model consists of, what would keep it from being solved, and what is perhaps not meant in it.
        """
    @property
    def coordinates(self, /) -> list[str]:
        """
        The names of its coordinates.
        """
    def draw(self, /, solution: int | None = None, *, theme: str = "light") -> _display.Drawing:
        """
        A drawing of the mechanism in this state, and of one of its solutions, counted from 1, if one is asked for.

        `theme` is "light" or "dark". The drawing shows itself in a notebook; `drawing.svg` is its text, and
        `drawing.save("mechanism.svg")` or `"mechanism.png"` writes a file.
        """
    def drive(self, /, vary: str | None = None, between: Range | None = None, *, rows: int = 41, time_limit: float | None = None, progress: Progress | None = None) -> reports.DriveReport:
        """
        Which efforts the drives need against friction, and how efficient that is; with `vary`, a coordinate or
        parameter, over its range `between=(start, stop)` in so many `rows`.
        """
    @staticmethod
    def gallery(name: str) -> Model:
        """
        A model of the gallery, such as `"drawer"`; `gallery_models()` has their names.
        """
    def hold(self, /, load: str | None = None, *, vary: str | None = None, drives: str = "release", time_limit: float | None = None, progress: Progress | None = None) -> reports.HoldReport:
        """
        Whether the mechanism stays at rest, under which loads, and how it begins to move. The rates are taken as
        zero.

        With `load`, the name of a load or drive or `"gravity"`, which factors of it are held; with `vary`, from
        which value of that static friction on it is held however great it is. `drives` are "release" (absent) or
        "hold".
        """
    def limits(self, /, vary_name: str, start: Value | None = None, stop: Value | None = None, *, max_reaction: float | None = None, both_directions: bool = False, effort: int = ..., quantity: str = "normal-force", time_limit: float | None = None, progress: Progress | None = None) -> reports.LimitsReport:
        """
        For which values of a parameter, a coordinate, or of `"friction"`, the factor on all coefficients of
        friction, each contact mode exists, and how many solutions there are.

        Without `start` and `stop`, coefficients of friction and `"friction"` have a usual range. `quantity` is
        what the plot of the answer shows: "normal-force", "friction", "acceleration" or "effort".
        """
    @staticmethod
    def load(path: str | PathLike[str]) -> Model:
        """
        A model from a file.

        Raises `ModelError` with everything that is wrong with it, `OSError` if it cannot be read.
        """
    def map(self, /, *, colour_by: str = "solutions", size: tuple[int, int] | None = None, probe: int | None = None, time_limit: float | None = None, progress: Progress | None = None, **axes: Range | None) -> reports.MapReport:
        """
        A map of the plane of two quantities: `model.map(mu=(0, 1), alpha=("0 deg", "90 deg"))`, x first.

        `colour_by` is what the colours tell: "solutions", "modes", "margin", "jam", "motion" or "hold"; `size` the
        number of pixels in each direction; `probe` the distance of pixels that are looked at first.
        """
    @property
    def parameters(self, /) -> list[str]:
        """
        The names of its parameters.
        """
    @staticmethod
    def parse(text: str) -> Model:
        """
        A model from its text, in the language of model files.

        Raises `ModelError` with everything that is wrong with it.
        """
    def rest_limits(self, /, vary_name: str, start: Value, stop: Value, *, load: str | None = None, drives: str = "release", time_limit: float | None = None, progress: Progress | None = None) -> reports.RestLimitsReport:
        """
        For which values of a parameter, a coordinate or `"friction"` the mechanism can stay at rest.
        """
    @property
    def settings(self, /) -> list[str]:
        """
        What was changed in the text, such as `["mu=0.5", "at alpha=75 deg"]`.
        """
    @overload
    def simulate(self, /, until: Value, *, mode: str | None = None, branches: Sequence[int] | None = None, prefer: str = "rule", all_branches: int, tolerance: float = 1e-8, longest_step: Value | None = None, max_steps: int = 1000000, max_events: int = 100000, max_reaction: float | None = None, time_limit: float | None = None, progress: Progress | None = None) -> reports.TreeReport: ...
    @overload
    def simulate(self, /, until: Value, *, mode: str | None = None, branches: Sequence[int] | None = None, prefer: str = "rule", all_branches: None = None, tolerance: float = 1e-8, longest_step: Value | None = None, max_steps: int = 1000000, max_events: int = 100000, max_reaction: float | None = None, time_limit: float | None = None, progress: Progress | None = None) -> _motion.Motion:
        """
        The motion until a time (s), the contact mode being part of the state: a `Motion` whose `t`, `y` and
        `events` are as those of `scipy.integrate.solve_ivp`.

        `mode` is the contact mode to begin with, `branches` which of several possible modes to take at each
        decision (from 1), `prefer` the "rule" of the book or "sliding", `tolerance` the relative error of a step.
        With `all_branches` all motions are followed, at most so many: then the answer is a `TreeReport`.
        """
    def size(self, /, vary_name: str, start: Value | None = None, stop: Value | None = None, *, margin: Value | None = None, max_effort: Value | None = None, max_normal_force: Value | None = None, max_pressure: Value | None = None, min_efficiency: Value | None = None, against: str = "locking", load: str | None = None, both_directions: bool = False, time_limit: float | None = None, progress: Progress | None = None) -> reports.SizeReport:
        """
        For which values of a quantity a wanted margin against locking is met, or a limit kept: one of `margin` (a
        factor on friction), `max_effort` (N or N m), `max_normal_force` (N), `max_pressure` (Pa) and
        `min_efficiency` (from 0 to 1). Texts may have units, such as `max_effort="30 N"`.

        A margin is `against` "locking" in motion, "self-locking" at rest under `load`, or "hold", that the load
        is held. `load` is also the drive of an effort, or the contact of a normal force or pressure.
        """
    def solve(self, /, *, margins: bool = True, max_solutions: int = 100, max_nodes: int | None = None, max_found: int | None = None, time_limit: float | None = None, progress: Progress | None = None) -> reports.SolveReport:
        """
        All solutions of the equations of motion in this state, with their contact modes.

        `margins=False` leaves out by which factors friction may grow, which is most of the work. At most
        `max_solutions` are listed; all are counted. The search ends after `max_nodes` nodes or `time_limit`
        seconds; the answer is then partial.
        """
    def sweep(self, /, *, samples: int | None = None, sampling: str = "random", seed: int = 0, breakpoints: bool = False, attainability: bool = False, all_columns: bool = False, shard: tuple[int, int] | None = None, time_limit: float | None = None, progress: Progress | None = None, **values: str | ArrayLike | Sequence[Value]) -> _sweep.Sweep:
        """
        All solutions at every point of a grid, or of random samples: a table, a `Sweep`.

        Each quantity that is varied, a parameter, a coordinate, `"COORDINATE.rate"` (by `**{"x.rate": ...}`),
        `friction` (the factor on all coefficients) or `time`, has its values: an array, a list of numbers or texts
        with units, or a text such as "0..0.8:801" (evenly spaced, both ends included) or "0.01..1:50:log". The last
        one varies fastest. With `samples=N` these are distributions: "0.1..0.5", "uniform(0.1, 0.5)",
        "normal(0.3, 0.05)", "lognormal(0.3, 0.2)"; `sampling` is "random" or "halton", and the same `seed` gives the
        same samples.

        `breakpoints=True` inserts the exact ends of modes into a sweep over one quantity, `attainability=True` adds
        whether a mechanism with slightly elastic guides settles on each solution, `all_columns=True` accelerations of
        bodies and hinge forces.

        `shard=(3, 64)` computes the third of 64 parts of the points alone, which has no numbers of branches;
        `write_shard` writes it to a folder, and `slideway.dask.sweep` computes all of them on a cluster.
        """
    @property
    def text(self, /) -> str:
        """
        The text of the model, without what was changed.
        """
    @property
    def title(self, /) -> str | None:
        """
        Its title, if it has one.
        """
    def with_(self, /, *, at: Mapping[str, Value] | None = None, rate: Mapping[str, Value] | None = None, time: Value | None = None, units: str | None = None, **values: Value) -> Model:
        """
        The same model with other values: parameters and coordinates by their names, or positions (`at`) and rates
        (`rate`) of coordinates by theirs, and the time of the state. A number is in SI units; a text may have a
        unit or be an expression of parameters: `model.with_(mu=0.5, alpha="75 deg", rate={"x": "2 m/s"})`.

        `units` are those in which texts show numbers: "as-typed", "SI" or "mm".

        Raises `ModelError` for names that do not exist and values that make no sense.
        """
    def write_shard(self, /, output: str | PathLike[str], shard: tuple[int, int], *, samples: int | None = None, sampling: str = "random", seed: int = 0, breakpoints: bool = False, attainability: bool = False, all_columns: bool = False, time_limit: float | None = None, progress: Progress | None = None, **values: str | ArrayLike | Sequence[Value]) -> Path:
        """
        Computes a part of a sweep, such as `shard=(3, 64)`, the third of 64, and writes it into the folder `output`
        as a Parquet file, unless it is there: the path of the file. `slideway.merge` makes one table of all parts.
        Everything else is as for `sweep`.
        """

@final
class Motion:
    """
    A motion: private half of `slideway.Motion`.
    """
    def animation(self, /, theme_name: str, slow_motion: float | None = None) -> str:
        """
        A moving picture as a page.
        """
    def drawn(self, /, phase_portrait: bool, width: float, height: float) -> list[reports.DrawnPanel]:
        """
        What the panels of the plot show in frames of this width and height (px, of which small text has 13).
        """
    def plot_svg(self, /, theme_name: str, phase_portrait: bool) -> str:
        """
        The plot as SVG.
        """
    def plotted(self, /, phase_portrait: bool) -> reports.Figure:
        """
        The plot as plain data.
        """
    def states(self, /, times: Sequence[float]) -> NDArray[np.float64]:
        """
        Coordinates, then their rates, one row for each, at these times.
        """
    def table(self, /, times: Sequence[float]) -> reports.Series:
        """
        The table at these times.
        """
    def text_with_all_events(self, /, color: bool) -> str:
        """
        The report as text, with all events.
        """
    def times(self, /, step: float | None = None) -> NDArray[np.float64]:
        """
        The times of the steps of the solver, or those in even steps.
        """

@final
class Table:
    """
    All solutions at the points of a sweep: private half of `slideway.Sweep`.
    """
    @property
    def __array_interface__(self, /) -> dict[str, Any]:
        """
        The records as an array of NumPy, which shares their memory.
        """
    def __arrow_c_stream__(self, /, requested_schema: Any | None = None) -> object:
        """
        The table as a stream of Arrow (the Arrow `PyCapsule` interface).
        """
    @property
    def contacts(self, /) -> tuple[str, ...]:
        """
        The names of the contacts, in the order of the signs of patterns.
        """
    def plot(self, /, quantity: str, time_limit: float | None = None, progress: Any | None = None) -> Any:
        """
        The plot of a quantity along every branch, or of its distribution over samples. All points are computed
        again: the table does not hold what a plot needs.
        """
    @property
    def points(self, /) -> int:
        """
        Number of points, inserted ones included.
        """
    @property
    def rows(self, /) -> int:
        """
        Number of rows.
        """
    def tally(self, /) -> reports.Tally:
        """
        How many points came to what.
        """
    def text(self, /, color: bool) -> str:
        """
        What the sweep comes to, in words.
        """
    @property
    def units(self, /) -> dict[str, Any]:
        """
        The unit of each column that has one.
        """
    @property
    def varied(self, /) -> int:
        """
        Number of varied quantities.
        """

def gallery_models() -> dict[str, str]:
    """
    The names of the models of the gallery, each with a line that says what it is.
    """

def hlcp(a: ArrayLike, b: ArrayLike, q: ArrayLike, options: dict[str, Any]) -> reports.RawReport:
    """
    All solutions of `A w - B z = q`.
    """

def lcp(m: ArrayLike, q: ArrayLike, options: dict[str, Any]) -> reports.RawReport:
    """
    All solutions of `w = M z + q`.
    """

def merge(folder: str | PathLike[str], *, time_limit: float | None = None, progress: Progress | None = None) -> _sweep.Sweep:
    """
    One table of all shards in a folder.
    """

def mode_problem(columns_positive: ArrayLike, columns_negative: ArrayLike, right_hand_side: ArrayLike, jumps: tuple[ArrayLike, ArrayLike] | None, options: dict[str, Any]) -> reports.RawReport:
    """
    All solutions of a mode problem.
    """

def png(svg: str, scale: float) -> bytes:
    """
    A drawing as PNG, with so many pixels for each unit of the SVG.
    """

def printable(text: str) -> str:
    """
    A text with its characters that are not seen as their numbers, so that it cannot affect the page that shows it.
    """

def solve(a: ArrayLike, b: ArrayLike, right_hand_side: ArrayLike, options: dict[str, Any]) -> reports.RawReport:
    """
    All solutions of `A x + B |x| = b`.
    """

def theme(name: str) -> reports.Theme:
    """
    The colours of the theme "light" or "dark".
    """
