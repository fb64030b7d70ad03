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
from ._values import (
    BySide,
    ColourBy,
    ContactValues,
    DrivesAtRest,
    End,
    ImpactLaw,
    MarginAgainst,
    Number,
    Pair,
    Preference,
    Progress,
    Quantity,
    QuantityName,
    Range,
    SamplingName,
    SupportValues,
    ThemeName,
    UnitsName,
    Value,
)


__all__ = ["GROUND", "Answer", "Mechanism", "Model", "Motion", "Plot", "Table", "frozen_array", "gallery_models", "import_dxf", "matrices", "merge", "png", "printable", "templates", "theme"]

GROUND: Final[str]
"""
The fixed frame, where the name of a body is expected.
"""

@final
class Answer:
    """
    A report, and what its pictures are made of.
    """
    def answer(self, /) -> str:
        """
        The answer in a sentence or a few.
        """
    def drawing(self, /, theme_name: str, solution: int | None = None, gap_state: int | None = None) -> str:
        """
        A drawing of the mechanism and its solutions, of one of them, or of one state of a preload gap, counted from
        1, as SVG.
        """
    def drawn_map(self, /, theme_name: str) -> reports.DrawnMap:
        """
        A map in words and colours.
        """
    def fields(self, /) -> dict[str, object]:
        """
        The attributes of the report.
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
    def plot(self, /) -> Plot:
        """
        The plot.
        """
    def plot_svg(self, /, theme_name: str) -> str:
        """
        The plot or the map as SVG.
        """
    def text(self, /, color: bool, verbose: bool = False) -> str:
        """
        The text output, with colours for a terminal and with how it is known if wanted.
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
    def __reduce__(self, /) -> tuple[object, ...]: ...
    def __repr__(self, /) -> str: ...
    @staticmethod
    def _restore(kept: str) -> Mechanism:
        """
        The mechanism that was pickled.
        """
    def block_slider(self, /, name: str, block: str, guide: str, *, at: Pair, length: Value, along: Value | None = None, height: Value | None = None, around: bool = False, travel: Pair | None = None, restitution: Value | None = None, mu: Value | BySide | None = None, mu_static: Value | None = None, preload: Value | BySide | None = None, centred_preload: bool = False, stiffness: Value | None = None, play: Value | None = None, loose: Value | None = None, misalignment: Value | None = None, pad: Pair | None = None, front: ContactValues | None = None, rear: ContactValues | None = None, supports: Mapping[str, SupportValues] | None = None) -> str:
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
            Stiffness of the guide at a contact (N/m), for attainability, and for how redundant contacts share a load.
        play : float or str
            Total play between the two faces (m), which counts where redundant contacts share a load; negative
            for a press fit. Default: 0.
        loose : float or str
            In a motion the block reaches each of its faces by itself, within its `play`, and bounces with this coefficient of
            restitution. Default: it follows the middle between them.
        misalignment : float or str
            How far the guide's line is displaced at a contact (m), towards positive normal force, which counts where
            redundant contacts share a load; may depend on coordinates. Default: 0.
        pad : pair
            Length and width of the area in contact at a contact (m), for the bearing pressure.
        front, rear : mapping
            What differs at the end in the direction of `along`, or at the other: `mu`, `mu_static`, `preload`,
            `stiffness`, `play`, `misalignment`, `pad`, `centred_preload`, and `carried_by_guide`, for a contact that
            stays at a place of the guide.
        supports : mapping
            Further contacts by their names, which share the load with the others, such as
            `{"middle": {"at": 0.02, "play": "0.1 mm"}}`: `at` is the distance from the middle of the block in the
            direction of `along` (m), everything else as for `front`.

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
        >>> pads = {"middle": {"at": "50 mm", "misalignment": "0.1 mm"}}
        >>> m.block_slider("tube", drawer, slideway.GROUND, at=(0, 0.2), length=0.4, mu=0.2, play="0.2 mm", supports=pads)
        'tube'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism("Drawer")
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> rail = m.block_slider("rail", drawer, GROUND, at=(0, 0), length=0.4, mu=0.2)
        >>> x = m.slide("x", rail, rate=0.1)
        >>> m.build()
        <slideway.Model: Drawer>
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> m.damper("damper", (drawer, (0, 0)), (GROUND, (1, 0)), damping="5 N s/m")
        'damper'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> rail = m.block_slider("rail", drawer, GROUND, at=(0, 0), length=0.4, mu=0.2)
        >>> x = m.slide("x", rail, rate=0.1)
        >>> m.drive_by_force("push", x, drawer, at=(-0.2, 0.1), direction=0)
        'push'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> crank = m.body("crank", mass=1, inertia=0.01, centre=(0.1, 0))
        >>> phi = m.rotation("phi", crank, rate=3)
        >>> m.drive_by_torque("motor", phi, crank)
        'motor'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> m.force("push", drawer, at=(0, 0.1), components=("20 N", 0))
        'push'
        """
    def guided_slider(self, /, name: str, block: str, guide: str, *, at: Pair, length: Value, mu: Value | BySide, along: Value | None = None, height: Value | None = None, around: bool = False, travel: Pair | None = None, restitution: Value | None = None, mu_static: Value | None = None, preload: Value | BySide | None = None, centred_preload: bool = False, stiffness: Value | None = None, play: Value | None = None, loose: Value | None = None, misalignment: Value | None = None, pad: Pair | None = None) -> str:
        """
        Adds a guided slider: it is pressed on one side along its whole length, with one normal force and a couple.

        Parameters
        ----------
        name : str
        block, guide : str
            Its bodies; either can be `GROUND`.
        at, length, along, height, around, travel, restitution, mu, mu_static, preload, centred_preload
            As for `block_slider`; `length` is that of the pressed face.
        stiffness, play, loose, misalignment, pad
            As for `block_slider`.

        Returns
        -------
        str
            The name.

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> m.guided_slider("runner", drawer, GROUND, at=(0, 0), length=0.4, mu=0.2)
        'runner'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> crank = m.body("crank", mass=1, inertia=0.01, centre=(0.1, 0))
        >>> pin = m.hinge("pin", GROUND, crank, at=(0, 0))
        >>> pin
        'pin'
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
    def pin_in_slot(self, /, name: str, pin: str, slot: str, *, at: Pair, mu: Value | BySide, along: Value | None = None, travel: Pair | None = None, restitution: Value | None = None, mu_static: Value | None = None, preload: Value | BySide | None = None, stiffness: Value | None = None, play: Value | None = None, loose: Value | None = None, misalignment: Value | None = None, pad: Pair | None = None) -> str:
        """
        Adds a pin of the first body in a slot of the second: one contact.

        Parameters
        ----------
        name : str
        pin, slot : str
            Its bodies; either can be `GROUND`.
        at : pair
            The pin in the drawing (m).
        along, travel, restitution, mu, mu_static, preload, stiffness, play, loose, misalignment, pad
            As for `block_slider`; `along` is the direction of the slot.

        Returns
        -------
        str
            The name.

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> m.pin_in_slot("slot", drawer, GROUND, at=(0, 0), mu=0.2)
        'slot'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> crank = m.body("crank", mass=1, inertia=0.01, centre=(0.1, 0))
        >>> m.rotation("phi", crank, rate="3 rad/s")
        'phi'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> rail = m.block_slider("rail", drawer, GROUND, at=(0, 0), length=0.4, mu=0.2)
        >>> m.slide("x", rail, rate="0.1 m/s")
        'x'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> m.spring("spring", (drawer, (0, 0)), (GROUND, (1, 0)), stiffness="10 N/m")
        'spring'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> drawer = m.body("drawer", mass=2, inertia=0.05, centre=(0, 0))
        >>> m.torque("twist", drawer, "3 N m")
        'twist'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> crank = m.body("crank", mass=1, inertia=0.01, centre=(0.1, 0))
        >>> m.torsional_damper("damper", GROUND, crank, damping="0.1 N m s/rad")
        'damper'
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

        Examples
        --------
        >>> from slideway import GROUND, Mechanism
        >>> m = Mechanism()
        >>> crank = m.body("crank", mass=1, inertia=0.01, centre=(0.1, 0))
        >>> m.torsional_spring("spring", GROUND, crank, stiffness="2 N m/rad")
        'spring'
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
    def _restore(text: str, kept_settings: Sequence[tuple[str, str, Value]], units_name: str | None, file: str) -> Model:
        """
        The model that was pickled.
        """
    def check(self, /) -> reports.CheckReport:
        """
        What the model consists of, what would keep it from being solved, and what is perhaps not meant in it.

        Returns
        -------
        reports.CheckReport

        Raises
        ------
        ModelError
            The mechanism cannot be assembled.

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").check().sound
        True
        """
    @property
    def coordinates(self, /) -> list[str]:
        """
        The names of its coordinates.
        """
    def draw(self, /, solution: int | None = None, *, theme: ThemeName = "light") -> _display.Drawing:
        """
        A drawing of the mechanism in this state.

        Parameters
        ----------
        solution : int, optional
            Which of its solutions to draw with its forces, from 1. Default: none.
        theme : {"light", "dark"}

        Returns
        -------
        Drawing
            It shows itself in a notebook; `drawing.svg` is its text, and `save` writes an SVG or PNG file.

        Raises
        ------
        ValueError
            There is no solution of this number.

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").draw(1)
        <slideway.Drawing: A drawer pushed off-centre>
        """
    def drive(self, /, vary: str | None = None, between: Range | None = None, *, rows: int = 41, time_limit: Number | None = None, progress: Progress | None = None, **ranges: Range | None) -> reports.DriveReport:
        """
        Which efforts the drives need against friction, and how efficient that is.

        Parameters
        ----------
        vary : str, optional
            A parameter or coordinate over whose range the efforts are wanted, in the place of `**ranges`.
        between : pair, optional
            The ends of that range. Default: a usual one.
        rows : int, default 41
            How many values of it.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.
        **ranges : pair
            What is varied by its name, with the ends of its range, such as `mu=(0, 1)`; `mu=None` for a usual range.

        Returns
        -------
        reports.DriveReport
            With a `plot()` if something is varied.

        Raises
        ------
        ModelError
            The model has no drives, a name does not exist, or the range makes no sense.

        Examples
        --------
        >>> import slideway
        >>> report = slideway.Model.gallery("drawer").drive()
        >>> report.conclusion[0]
        'push needs 36.36 N (20 N without friction): efficiency 55 %.'
        """
    @staticmethod
    def gallery(name: str) -> Model:
        """
        A model of the gallery.

        Parameters
        ----------
        name : str
            Such as `"drawer"`; `gallery_models()` has all names.

        Returns
        -------
        Model

        Raises
        ------
        KeyError
            There is none of this name.

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("wedge").coordinates
        ['x']
        """
    @overload
    def hold(self, /, load: str | None = None, *, vary: str | None = None, drives: DrivesAtRest = "release", time_limit: Number | None = None, progress: Progress | None = None) -> reports.HoldReport: ...
    @overload
    def hold(self, /, load: str | None = None, *, vary: str | None = None, drives: DrivesAtRest = "release", time_limit: Number | None = None, progress: Progress | None = None, **ranges: Range | None) -> reports.RestLimitsReport:
        """
        Whether the mechanism stays at rest, under which loads, and how it begins to move.

        Rates are taken as zero.

        Parameters
        ----------
        load : str, optional
            The name of a load or drive, or `"gravity"`: which factors of it are held?
        vary : str, optional
            A parameter, a coordinate, or `"friction"`: from which value of it on is the load held, however great it is?
        drives : {"release", "hold"}
            Whether the drives are absent, or hold their coordinates.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.
        **ranges : pair
            What is varied by its name, with the ends of its range, such as `friction=(0, 2)`: for which values of it can the
            mechanism stay at rest? This is `rest_limits`.

        Returns
        -------
        reports.HoldReport or reports.RestLimitsReport
            The latter with a range.

        Raises
        ------
        ModelError
            The name of the load does not exist, or the mechanism cannot be assembled.

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").hold().holds     # nothing but friction opposes its resistance
        False
        """
    def limits(self, /, vary_name: str | None = None, start: Value | Range | None = None, stop: Value | None = None, *, max_reaction: Number | None = None, both_directions: bool = False, effort: int = 800, quantity: QuantityName = "normal-force", time_limit: Number | None = None, progress: Progress | None = None, **ranges: Range | None) -> reports.LimitsReport:
        """
        For which values of a quantity each contact mode exists, and how many solutions there are.

        Parameters
        ----------
        vary_name : str, optional
            A parameter, a coordinate, or `"friction"`, the factor on all coefficients of friction, in the place of `**ranges`.
        start, stop : float or str, optional
            The ends of its range, or a pair of them. Default: a usual one for coefficients of friction and `"friction"`, and for what has a
            value in the model.
        max_reaction : float, optional
            The greatest normal force that counts as a solution (N): where it is exceeded a mode ends.
        both_directions : bool, default False
            Whether to find the limits of the opposite direction of motion, too.
        effort : int, default 800
            How many values are examined at most where the ends of modes are not zeros of determinants.
        quantity : {"normal-force", "friction", "acceleration", "effort"}
            What the plot of the answer shows.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.
        **ranges : pair
            What is varied by its name, with the ends of its range, such as `mu=(0, 1)`; `mu=None` for a usual range.

        Returns
        -------
        reports.LimitsReport
            With a `plot()`.

        Raises
        ------
        ModelError
            The name does not exist, or the range makes no sense.

        Examples
        --------
        >>> import slideway
        >>> limits = slideway.Model.gallery("drawer").limits(mu=(0, 1))
        >>> [(count.solutions, round(count.to, 6)) for count in limits.counts]     # locked beyond L / (2 a)
        [(1, 0.666667), (0, 1.0)]
        """
    @staticmethod
    def load(path: str | PathLike[str]) -> Model:
        """
        A model from a file.

        Parameters
        ----------
        path : str or path
            The model file.

        Returns
        -------
        Model

        Raises
        ------
        ModelError
            With everything that is wrong with it, each fault with its line and column; `filename` is the file.
        OSError
            The file cannot be read; `filename` is the file.

        Examples
        --------
        >>> import pathlib, slideway, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp(), "mine.toml")
        >>> _ = path.write_text(slideway.Model.gallery("drawer").text)
        >>> slideway.Model.load(path) == slideway.Model.gallery("drawer")
        True
        """
    def map(self, /, *, colour_by: ColourBy = "solutions", size: tuple[int, int] | None = None, probe: int | None = None, time_limit: Number | None = None, progress: Progress | None = None, **axes: Range | None) -> reports.MapReport:
        """
        A map of the plane of two quantities.

        Parameters
        ----------
        **axes : pair
            Two quantities, x first, each with the ends of its range: `mu=(0, 1), L=("0.3 m", "0.5 m")`. None stands for a
            usual range.
        colour_by : {"solutions", "modes", "margin", "jam", "motion", "effort", "hold"}
            What the colours tell.
        size : pair of int, optional
            Pixels in each direction.
        probe : int, optional
            Distance of the pixels that are looked at first (pixels).
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.

        Returns
        -------
        reports.MapReport
            With a `plot()`; `pixels()` are an array.

        Raises
        ------
        ModelError
            A name does not exist, or a range makes no sense.

        Examples
        --------
        >>> import slideway
        >>> drawer = slideway.Model.gallery("drawer")
        >>> plane = drawer.map(mu=(0, 1), L=("0.3 m", "0.5 m"), size=(4, 3))
        >>> [one.words for one in plane.classes]
        ['no solution: friction locks it', 'one solution']
        >>> plane.pixels()
        array([[1, 1, 0, 0],
               [1, 1, 1, 0],
               [1, 1, 1, 0]])
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

        Parameters
        ----------
        text : str
            What stands in a model file.

        Returns
        -------
        Model

        Raises
        ------
        ModelError
            With everything that is wrong with it, each fault with its line and column.

        Examples
        --------
        >>> import slideway
        >>> text = slideway.Model.gallery("drawer").text
        >>> slideway.Model.parse(text)
        <slideway.Model: A drawer pushed off-centre>
        """
    def report(self, /, *, time_limit: Number | None = None, progress: Progress | None = None, **ranges: Range | None) -> _display.Page:
        """
        A page with the model, its drawing, its solutions, its efforts, whether it stays at rest, and its limits.

        Parameters
        ----------
        **ranges : pair
            Quantities whose limits are wanted, each with the ends of its range: `mu=(0, 1)`. None stands for a usual range.
            Default: `friction`, the factor on all coefficients of friction.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.

        Returns
        -------
        Page
            It shows itself in a notebook; `save("report.html")` writes a file that needs no other, and prints on A4.

        Raises
        ------
        ModelError
            The mechanism cannot be assembled, or a quantity does not exist.

        Examples
        --------
        >>> import pathlib, slideway, tempfile
        >>> page = slideway.Model.gallery("drawer").report(mu=(0, 1))
        >>> path = pathlib.Path(tempfile.mkdtemp(), "drawer.html")
        >>> page.save(path)
        >>> "<h2>Model</h2>" in path.read_text()
        True
        """
    def rest_limits(self, /, vary_name: str | None = None, start: Value | Range | None = None, stop: Value | None = None, *, load: str | None = None, drives: DrivesAtRest = "release", time_limit: Number | None = None, progress: Progress | None = None, **ranges: Range | None) -> reports.RestLimitsReport:
        """
        For which values of a quantity the mechanism can stay at rest.

        Parameters
        ----------
        vary_name : str, optional
            A parameter, a coordinate, or `"friction"`, the factor on all coefficients of friction, in the place of `**ranges`.
        start, stop : float or str, optional
            The ends of its range, or a pair of them.
        load : str, optional
            The name of a load or drive, or `"gravity"`, which is to be held however great it is.
        drives : {"release", "hold"}
            Whether the drives are absent, or hold their coordinates.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.
        **ranges : pair
            What is varied by its name, with the ends of its range, such as `mu=(0, 1)`; `mu=None` for a usual range.

        Returns
        -------
        reports.RestLimitsReport

        Raises
        ------
        ModelError
            A name does not exist, or the range makes no sense.

        Examples
        --------
        >>> import slideway
        >>> wedge = slideway.Model.gallery("wedge")
        >>> len(wedge.rest_limits(friction=(0, 2)).spans) > 0
        True
        """
    def save(self, /, path: str | PathLike[str]) -> None:
        """
        Writes the text of the model, with what was changed, to a file.

        Parameters
        ----------
        path : str or path
            A file of this name is overwritten.

        Returns
        -------
        None

        Examples
        --------
        >>> import pathlib, slideway, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp(), "drawer.toml")
        >>> slideway.Model.gallery("drawer").with_(L="450 mm").save(path)
        >>> slideway.Model.load(path).values["L"]
        0.45 m
        """
    @property
    def settings(self, /) -> list[str]:
        """
        What was changed in the text, such as `["mu=0.5", "at alpha=75 deg"]`.
        """
    @overload
    def simulate(self, /, until: Value, *, mode: str | None = None, branches: Sequence[int] | None = None, prefer: Preference = "rule", impacts: ImpactLaw = "course", all_branches: int, tolerance: Number = 1e-8, longest_step: Value | None = None, max_steps: int = 1000000, max_events: int = 100000, max_reaction: Number | None = None, time_limit: Number | None = None, progress: Progress | None = None) -> reports.TreeReport: ...
    @overload
    def simulate(self, /, until: Value, *, mode: str | None = None, branches: Sequence[int] | None = None, prefer: Preference = "rule", impacts: ImpactLaw = "course", all_branches: None = None, tolerance: Number = 1e-8, longest_step: Value | None = None, max_steps: int = 1000000, max_events: int = 100000, max_reaction: Number | None = None, time_limit: Number | None = None, progress: Progress | None = None) -> _motion.Motion:
        """
        The motion until a time, the contact mode being part of the state.

        Parameters
        ----------
        until : float or str
            When it ends (s).
        mode : str, optional
            The contact mode to begin with, a sign for each contact, such as `"+ - 0"`, and for each hinge with friction.
        branches : list of int, optional
            Which of several possible modes to take at each decision, from 1.
        prefer : {"rule", "sliding"}
            Which one otherwise: that of the rule in the book, or sliding.
        impacts : {"course", "moreau"}
            What friction does in impacts on the faces of contacts that may lift off: it opposes the slip at each moment, or
            that after the impact.
        all_branches : int, optional
            Follows all motions, at most so many.
        tolerance : float, default 1e-8
            The relative error of a step.
        longest_step : float or str, optional
            The longest step of the solver (s).
        max_steps, max_events : int
            After how many steps or events it ends.
        max_reaction : float, optional
            The normal force beyond which it ends (N).
        time_limit : float, optional
            The longest that it may take (s); the answer is then partial, and says so. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.

        Returns
        -------
        Motion or reports.TreeReport
            A motion, whose `t`, `y` and `events` are as those of `scipy.integrate.solve_ivp`; with `all_branches` a tree.

        Raises
        ------
        ModelError
            The mode does not exist, or `until` is before the time of the model.
        TimeoutError
            The time was up before the position of the bodies was known.

        Examples
        --------
        >>> import slideway
        >>> motion = slideway.Model.gallery("drawer").simulate("0.1 s")
        >>> motion.sol(0.05)     # driven with 0.1 m/s
        array([0.005, 0.1  ])
        """
    def size(self, /, vary_name: str | None = None, start: Value | Range | None = None, stop: Value | None = None, *, margin: Value | None = None, max_effort: Value | None = None, max_normal_force: Value | None = None, max_pressure: Value | None = None, min_efficiency: Value | None = None, against: MarginAgainst = "locking", load: str | None = None, both_directions: bool = False, time_limit: Number | None = None, progress: Progress | None = None, **ranges: Range | None) -> reports.SizeReport:
        """
        For which values of a quantity a wanted margin against locking is met, or a limit is kept.

        Exactly one of `margin`, `max_effort`, `max_normal_force`, `max_pressure` and `min_efficiency` is given.

        Parameters
        ----------
        vary_name : str, optional
            A parameter, a coordinate, or `"friction"`, the factor on all coefficients of friction, in the place of `**ranges`.
        start, stop : float or str, optional
            The ends of its range, or a pair of them. Default: a usual one for coefficients of friction and `"friction"`, and for what has a
            value in the model.
        margin : float, optional
            The factor by which friction shall be able to grow.
        max_effort : float or str, optional
            The greatest effort of a drive (N or N m).
        max_normal_force : float or str, optional
            The greatest normal force of a contact (N).
        max_pressure : float or str, optional
            The greatest bearing pressure of a contact with a `pad` (Pa).
        min_efficiency : float or str, optional
            The least efficiency of the drives, above 0 and at most 1.
        against : {"locking", "self-locking", "hold"}
            What the margin is against: locking in motion, self-locking at rest under `load`, or that `load` is not held.
        load : str, optional
            The load of a margin at rest, the drive of `max_effort`, or the contact of `max_normal_force` and `max_pressure`
            (default: all of them).
        both_directions : bool, default False
            Whether the margin must be met in the opposite direction of motion, too.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.
        **ranges : pair
            What is varied by its name, with the ends of its range, such as `mu=(0, 1)`; `mu=None` for a usual range.

        Returns
        -------
        reports.SizeReport
            With a `plot()`; `met` has the intervals.

        Raises
        ------
        ModelError
            A name does not exist, the range makes no sense, or a limit has the wrong unit.

        Examples
        --------
        >>> import slideway
        >>> size = slideway.Model.gallery("drawer").size(L=("0.1 m", "1 m"), margin=2)
        >>> round(size.met[0].from_, 6)     # L = 2 (2 mu) a, in m
        0.36
        """
    def solve(self, /, *, margins: bool = True, max_solutions: int = 100, max_nodes: int | None = None, max_found: int | None = None, time_limit: Number | None = None, progress: Progress | None = None) -> reports.SolveReport:
        """
        All solutions of the equations of motion in this state, with their contact modes.

        Parameters
        ----------
        margins : bool, default True
            Whether to find by which factors friction may grow, which is most of the work.
        max_solutions : int, default 100
            How many solutions to list; all are counted.
        max_nodes : int, optional
            After how many nodes the search ends; the answer is then partial.
        max_found : int, optional
            The search ends once a group of contacts has so many solutions; the answer is then partial.
        time_limit : float, optional
            The longest that it may take (s); the answer is then partial, and says so. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.

        Returns
        -------
        reports.SolveReport
            Iterable over its solutions. That there is none is an answer, too: `status` is then "none".

        Raises
        ------
        ModelError
            There is no unique state to be solved, such as with a velocity of zero in a joint with friction.
        TimeoutError
            The time was up before the position of the bodies was known.

        Examples
        --------
        >>> import slideway
        >>> answer = slideway.Model.gallery("drawer").solve()
        >>> answer.status, answer.complete
        ('one', 'proven')
        >>> answer.solutions[0].normal_forces     # +- F a / L with F = Q / (1 - 2 mu a / L), in N
        array([ 27.27..., -27.27...])
        """
    def sweep(self, /, *, samples: int | None = None, sampling: SamplingName = "random", seed: int = 0, breakpoints: bool = False, attainability: bool = False, all_columns: bool = False, shard: tuple[int, int] | None = None, time_limit: Number | None = None, progress: Progress | None = None, **values: str | ArrayLike | Sequence[Value]) -> _sweep.Sweep:
        """
        All solutions at every point of a grid, or of random samples, as a table.

        Parameters
        ----------
        **values : array, list or str
            What is varied: a parameter, a coordinate, `"COORDINATE.rate"` (by `**{"x.rate": ...}`), `friction` (the factor on
            all coefficients of friction) or `time`. On a grid its values: an array or list of numbers in SI units or texts,
            or a text such as `"0..0.8:801"` (evenly spaced, both ends included) or `"0.01..1:50:log"`; the last quantity varies
            fastest. With `samples` its distribution: `"0.1..0.5"`, `"uniform(0.1, 0.5)"`, `"normal(0.3, 0.05)"` or
            `"lognormal(0.3, 0.2)"`.
        samples : int, optional
            Number of random samples; without it the points are a grid.
        sampling : {"random", "halton"}
            How samples are spread.
        seed : int, default 0
            The same seed gives the same samples.
        breakpoints : bool, default False
            Whether the exact ends of modes are inserted into a sweep over one quantity. `slideway sweep` inserts them unless
            told `--no-breakpoints`; here the rows are those of the values that are given unless asked otherwise, so that
            they stay in step with the arrays that they come from.
        attainability : bool, default False
            Whether to add a column that says whether a mechanism with slightly elastic guides settles on each solution.
        all_columns : bool, default False
            Whether to add the accelerations of all bodies and the forces of hinges.
        shard : pair of int, optional
            `(3, 64)` computes the third of 64 parts of the points alone, which has no numbers of branches. `write_shard` writes
            it to a folder, and `slideway.dask.sweep` computes all parts on a cluster.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.

        Returns
        -------
        Sweep

        Raises
        ------
        ModelError
            A name does not exist, or values make no sense.
        MemoryError
            The machine has no room for the table.

        Examples
        --------
        >>> import numpy as np, slideway
        >>> model = slideway.Model.gallery("drawer")
        >>> sweep = model.sweep(mu=np.linspace(0, 1, 11))
        >>> sweep.tally.solutions                       # locked beyond 2/3
        {0: 4, 1: 7}
        >>> model.sweep(samples=1000, mu="uniform(0, 1)").tally.points
        1000
        """
    @staticmethod
    def template(name: str, /, **sizes: Value) -> Model:
        """
        A model from a template: an everyday problem with dimensions of one's own.

        Parameters
        ----------
        name : str
            Such as `"drawer"`; `templates()` has all names.
        **sizes : float or str
            Parameters of the template, with units: `L="500 mm"`. Those that are not given stay as they are there.

        Returns
        -------
        Model
            Its `text` is a commented model file, which says the rule that is to be met, with its source.

        Raises
        ------
        KeyError
            There is none of this name.
        ModelError
            With everything that is wrong with the sizes, such as numbers without a unit and joints that do not close.

        Examples
        --------
        >>> import slideway
        >>> drawer = slideway.Model.template("drawer", L="500 mm", a="150 mm")
        >>> round(drawer.limits("mu", 0, 2).counts[0].to, 6)     # L / (2 a)
        1.666667
        """
    @property
    def text(self, /) -> str:
        """
        The text of the model, with what was changed.
        """
    @property
    def title(self, /) -> str | None:
        """
        Its title, if it has one.
        """
    @property
    def values(self, /) -> dict[str, Quantity]:
        """
        The present values of its parameters in SI units, each with its unit.
        """
    def with_(self, /, *, at: Mapping[str, Value] | None = None, rate: Mapping[str, Value] | None = None, time: Value | None = None, units: UnitsName | None = None, **values: Value) -> Model:
        """
        The same model with other values.

        Parameters
        ----------
        at : dict, optional
            Positions of coordinates by their names; needed only where a parameter has the same name.
        rate : dict, optional
            Rates of coordinates by their names (m/s or rad/s).
        time : float or str, optional
            The time of the state (s).
        units : {"as-typed", "SI", "mm", "in"}, optional
            The units in which texts show numbers.
        **values : float or str
            Parameters and coordinates by their names. A number is in SI units (rad for angles); a text may have a unit or be
            an expression of parameters.

        Returns
        -------
        Model
            A new one; this one stays as it is.

        Raises
        ------
        ModelError
            With all names that do not exist and all values that make no sense.

        Examples
        --------
        >>> import slideway
        >>> model = slideway.Model.gallery("drawer").with_(mu=0.5, L="450 mm", rate={"x": "2 m/s"})
        >>> model.settings
        ['mu=0.5', 'L=450 mm', 'rate x=2 m/s']
        """
    def write_shard(self, /, output: str | PathLike[str], shard: tuple[int, int], *, samples: int | None = None, sampling: SamplingName = "random", seed: int = 0, breakpoints: bool = False, attainability: bool = False, all_columns: bool = False, time_limit: Number | None = None, progress: Progress | None = None, **values: str | ArrayLike | Sequence[Value]) -> Path:
        """
        Computes a part of a sweep and writes it to a folder, unless it is there.

        The file is the one that `slideway sweep --shard` writes for the same sweep. As its command it names the command line that
        asks for it, with the settings first, in the order of `slideway sweep --help`; without a file of its own, a model is
        `model.toml` there. If there is none, as with a list of so many values that no command line has room for them, it says
        that Python wrote it. `slideway.merge` makes one table of all parts, whichever program wrote them.

        Parameters
        ----------
        output : str or path
            The folder; it is made if it is not there.
        shard : pair of int
            Which part: `(3, 64)` is the third of 64.
        **values : array, list or str
            What is varied: a parameter, a coordinate, `"COORDINATE.rate"` (by `**{"x.rate": ...}`), `friction` (the factor on
            all coefficients of friction) or `time`. On a grid its values: an array or list of numbers in SI units or texts,
            or a text such as `"0..0.8:801"` (evenly spaced, both ends included) or `"0.01..1:50:log"`; the last quantity varies
            fastest. With `samples` its distribution: `"0.1..0.5"`, `"uniform(0.1, 0.5)"`, `"normal(0.3, 0.05)"` or
            `"lognormal(0.3, 0.2)"`.
        samples : int, optional
            Number of random samples; without it the points are a grid.
        sampling : {"random", "halton"}
            How samples are spread.
        seed : int, default 0
            The same seed gives the same samples.
        breakpoints : bool, default False
            Whether the exact ends of modes are inserted into a sweep over one quantity. `slideway sweep` inserts them unless
            told `--no-breakpoints`; here the rows are those of the values that are given unless asked otherwise, so that
            they stay in step with the arrays that they come from.
        attainability : bool, default False
            Whether to add a column that says whether a mechanism with slightly elastic guides settles on each solution.
        all_columns : bool, default False
            Whether to add the accelerations of all bodies and the forces of hinges.
        time_limit : float, optional
            The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
        progress : callable, optional
            Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
            raises.

        Returns
        -------
        Path
            The Parquet file.

        Raises
        ------
        ModelError
            A name does not exist, or values make no sense.
        OSError
            The folder holds parts of another sweep, or cannot be written to.

        Examples
        --------
        >>> import slideway, tempfile
        >>> model, folder = slideway.Model.gallery("drawer"), tempfile.mkdtemp()
        >>> [model.write_shard(folder, (part, 2), mu="0..1:11").name for part in (1, 2)]
        ['shard-1-of-2.parquet', 'shard-2-of-2.parquet']
        >>> len(slideway.merge(folder))
        11
        """

@final
class Motion:
    """
    A motion: private half of `slideway.Motion`.
    """
    def animation(self, /, theme_name: str, slow_motion: Number | None = None) -> str:
        """
        A moving picture as a page.
        """
    def plot(self, /, phase_portrait: bool) -> Plot:
        """
        The plot over time, or in the plane of coordinate and rate.
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
    def times(self, /, step: Number | None = None) -> NDArray[np.float64]:
        """
        The times of the steps of the solver, or those in even steps.
        """

@final
class Plot:
    """
    A plot of an answer, a motion or a sweep.
    """
    def drawn(self, /, width: Number, height: Number) -> list[reports.DrawnPanel]:
        """
        What its panels show in frames of this width and height (px, of which small text has 13).
        """
    def figure(self, /) -> reports.Figure:
        """
        The plot as plain data.
        """
    def svg(self, /, theme_name: str) -> str:
        """
        The plot as SVG.
        """

@final
class Table:
    """
    All solutions at the points of a sweep: private half of `slideway.Sweep`.
    """
    @property
    def __array_interface__(self, /) -> dict[str, Any]:
        """
        The rows as records: an array of NumPy that shares their memory. They are made when they are first asked for.
        """
    def __arrow_c_stream__(self, /, requested_schema: Any | None = None) -> object:
        """
        The table as a stream of Arrow (the Arrow `PyCapsule` interface).
        """
    @property
    def columns(self, /) -> list[str]:
        """
        The names of the columns.
        """
    @property
    def contacts(self, /) -> tuple[str, ...]:
        """
        The names of the contacts, in the order of the signs of patterns.
        """
    def plot(self, /, quantity: str, time_limit: Number | None = None, progress: Any | None = None) -> Plot:
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

def frozen_array(numbers: Sequence[float]) -> NDArray[np.float64]:
    """
    A NumPy array that cannot be written to.
    """

def gallery_models() -> dict[str, str]:
    """
    The names of the models of `Model.gallery`, each with a line that says what it is.

    Returns
    -------
    dict of str

    Examples
    --------
    >>> import slideway
    >>> slideway.gallery_models()["drawer"]
    'A drawer pushed off-centre.'
    """

def import_dxf(path: str | PathLike[str], *, unit: str | None = None, title: str | None = None, time_limit: Number | None = None, progress: Progress | None = None) -> str:
    """
    The text of a model file with the outlines and points of a drawing, to be completed with joints, masses and
    coordinates.

    Each layer becomes a body: its greatest closed line is the outline, circles and points are its points, texts
    beside them their names. The layer `ground` gives points of ground. What is left out stands in comments.

    Parameters
    ----------
    path : str or path
        The drawing, a text (ASCII) DXF file.
    unit : str, optional
        Unit of length of the drawing: "in", "ft", "mm", "cm", "m", "km", "um" or "dm". Default: the one that it
        says.
    title : str, optional
        The title of the model. Default: the name of the file without its ending.
    time_limit : float, optional
        The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
    progress : callable, optional
        Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
        raises.

    Returns
    -------
    str
        The text, for a file that an editor completes and `Model.load` reads.

    Raises
    ------
    ValueError
        What keeps the drawing from being read, with its line.
    OSError
        The file cannot be read.
    TimeoutError
        The work was not done within `time_limit`.

    Examples
    --------
    >>> import pathlib, slideway, tempfile
    >>> drawing = pathlib.Path(tempfile.mkdtemp(), "crank.dxf")
    >>> lines = "0 SECTION 2 ENTITIES 0 CIRCLE 8 crank 10 0 20 0 40 60 0 ENDSEC 0 EOF"
    >>> _ = drawing.write_text("\\n".join(lines.split()))
    >>> "[bodies.crank]" in slideway.import_dxf(drawing, unit="mm")
    True
    """

def matrices(kind: str, arrays: list[tuple[str, ArrayLike | None]], options: dict[str, Any]) -> reports.RawReport:
    """
    All solutions of a problem of a type, given by its arrays with their names; those that it may lack may be None.
    """

def merge(folder: str | PathLike[str], *, time_limit: Number | None = None, progress: Progress | None = None) -> _sweep.Sweep:
    """
    One table of all parts of a sweep in a folder, with numbers of branches.

    Parameters
    ----------
    folder : str or path
        What `Model.write_shard`, `slideway.dask.sweep` or `slideway sweep --shard` wrote its parts to.
    time_limit : float, optional
        The longest that it may take (s); then `TimeoutError` is raised. Default: no limit.
    progress : callable, optional
        Called with the fraction that is done (None if it is not known), a count, and what is counted. Work ends if it
        raises.

    Returns
    -------
    Sweep

    Raises
    ------
    OSError
        Parts are missing, or do not belong together.

    Examples
    --------
    See `Model.write_shard`.
    """

def png(svg: str, scale: Number) -> bytes:
    """
    A drawing as PNG, with so many pixels for each unit of the SVG.
    """

def printable(text: str) -> str:
    """
    A text with its characters that are not seen as their numbers, so that it cannot affect the page that shows it.
    """

def templates() -> dict[str, str]:
    """
    The names of the templates of `Model.template`, each with a line that says what it is.

    Returns
    -------
    dict of str

    Examples
    --------
    >>> import slideway
    >>> "drawer" in slideway.templates()
    True
    """

def theme(name: str) -> reports.Theme:
    """
    The colours of the theme "light" or "dark".
    """
