"""What classes of `slideway.reports` have beside the fields of the JSON output. A class here is a base of the class of
the same name there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from . import reports


def _frozen(numbers: list[float]) -> NDArray[np.float64]:
    array = np.array(numbers, dtype=np.float64)
    array.setflags(write=False)
    return array


EMPTY = _frozen([])
"""An array that is absent in the JSON output."""


class Solution:
    """Arrays of a solution."""

    contacts: tuple[reports.Contact, ...]
    accelerations: tuple[reports.CoordinateAcceleration, ...]
    drives: tuple[reports.Drive, ...]

    @property
    def normal_forces(self) -> NDArray[np.float64]:
        """The normal force of each contact, with its sign (N)."""
        return _frozen([contact.normal_force for contact in self.contacts])

    @property
    def friction_forces(self) -> NDArray[np.float64]:
        """The friction force of each contact, positive against positive sliding (N)."""
        return _frozen([contact.friction_force for contact in self.contacts])

    @property
    def efforts(self) -> NDArray[np.float64]:
        """The effort of each drive (N or N m)."""
        return _frozen([drive.effort for drive in self.drives])


class SolveReport:
    """A solve report is iterable over its solutions."""

    solutions: tuple[reports.Solution, ...]

    def __iter__(self) -> Iterator[reports.Solution]:
        return iter(self.solutions)

    def __len__(self) -> int:
        return len(self.solutions)

    def __bool__(self) -> bool:
        return True


class RawReport:
    """A raw report is iterable over its solutions."""

    solutions: tuple[reports.RawSolution, ...]

    def __iter__(self) -> Iterator[reports.RawSolution]:
        return iter(self.solutions)

    def __len__(self) -> int:
        return len(self.solutions)

    def __bool__(self) -> bool:
        return True

