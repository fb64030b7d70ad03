"""What arguments can be."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, TypedDict

import numpy as np
from numpy.typing import NDArray

Number = float | np.floating[Any] | np.integer[Any]
"""A number of Python or of NumPy."""

Value = Number | str
"""A number in SI units, or a text with a unit or an expression of parameters, such as `"75 deg"`."""

Pair = Sequence[Value] | NDArray[np.floating]
"""Two values, such as a place of the drawing (m)."""

Range = Sequence[Value] | NDArray[np.floating]
"""The two ends of a range."""

ThemeName = Literal["light", "dark"]
QuantityName = Literal["normal-force", "friction", "acceleration", "effort"]
UnitsName = Literal["as-typed", "SI", "mm", "in"]
DrivesAtRest = Literal["release", "hold"]
MarginAgainst = Literal["locking", "self-locking", "hold"]
ColourBy = Literal["solutions", "modes", "margin", "jam", "motion", "effort", "hold"]
SamplingName = Literal["random", "halton"]
Preference = Literal["rule", "sliding"]
ImpactLaw = Literal["course", "moreau"]

Progress = Callable[[float | None, int, str], object]
"""What is told of the progress of work: the fraction that is done, if it is known, and how many of what were done."""

End = tuple[str, Pair]
"""An end of a spring or damper: a body, and a place of the drawing that moves with it."""


class BySide(TypedDict):
    """A value for either sign of the normal force."""

    plus: Value
    """For positive normal force."""
    minus: Value
    """For negative normal force."""


class ContactValues(TypedDict, total=False):
    """What differs at one contact of a block."""

    mu: Value | BySide
    """Coefficient of kinetic friction."""
    mu_static: Value
    """Coefficient of static friction."""
    preload: Value | BySide
    """Friction at zero normal force (N)."""
    stiffness: Value
    """Stiffness of the guide (N/m)."""
    play: Value
    """Total play between the two faces (m)."""
    misalignment: Value
    """How far the guide's line is displaced there (m)."""
    pad: Pair
    """Length and width of the area in contact (m)."""
    carried_by_guide: bool
    """The contact stays at a place of the guide."""
    centred_preload: bool
    """The preload's friction acts on the centre line."""


class SupportValues(ContactValues):
    """A further contact of a block."""

    at: Value
    """How far from the middle of the block, in the direction of `along` (m)."""


class Quantity(float):
    """A number in SI units that knows its unit.

    >>> length = Quantity(0.45, "m")
    >>> length, 2 * length
    (0.45 m, 0.9)
    """

    unit: str
    """Its unit; empty for a pure number."""

    def __new__(cls, value: float, unit: str = "") -> Quantity:
        quantity = super().__new__(cls, value)
        quantity.unit = unit
        return quantity

    def __reduce__(self) -> tuple[type[Quantity], tuple[float, str]]:
        return Quantity, (float(self), self.unit)

    def __repr__(self) -> str:
        return f"{float(self)!r} {self.unit}".rstrip()

    __str__ = __repr__


def quantities(entries: Iterable[tuple[str, float, str]]) -> dict[str, Quantity]:
    """Values by their names."""
    return {name: Quantity(value, unit) for name, value, unit in entries}
