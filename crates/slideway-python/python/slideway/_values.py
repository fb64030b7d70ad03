"""What arguments can be."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypedDict

import numpy as np
from numpy.typing import NDArray

Value = float | str
"""A number in SI units, or a text with a unit or an expression of parameters, such as `"75 deg"`."""

Pair = Sequence[Value] | NDArray[np.floating]
"""Two values, such as a place of the drawing (m)."""

Range = Sequence[Value]
"""The two ends of a range."""

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
