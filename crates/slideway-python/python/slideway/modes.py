"""All solutions of problems given by matrices: absolute value equations, linear complementarity problems.

>>> import slideway.modes
>>> answer = slideway.modes.lcp([[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0])
>>> answer.complete
'proven'
>>> sorted(solution.z.round(4).tolist() for solution in answer)
[[0.0, 1.0], [0.3333, 0.3333], [1.0, 0.0]]
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from numpy.typing import ArrayLike

from . import _slideway, reports

__all__ = ["hlcp", "lcp", "mode_problem", "solve"]

Progress = Callable[[float | None, int, str], object]


def _options(
    *,
    max_solutions: int = 100,
    max_nodes: int | None = None,
    max_found: int | None = None,
    all_faces: bool = False,
    uniqueness: bool = False,
    time_limit: float | None = None,
    progress: Progress | None = None,
) -> dict[str, Any]:
    return locals()


def solve(A: ArrayLike, B: ArrayLike, b: ArrayLike, **options: Any) -> reports.RawReport:
    """All solutions `x` of the absolute value equation `A x + B |x| = b`.

    At most `max_solutions` are listed, all are counted. The search ends after `max_nodes` nodes, once a group of
    unknowns has `max_found` solutions, or after `time_limit` seconds; the answer is then partial. `uniqueness=True`
    also decides whether there is exactly one solution for every `b`, and `all_faces=True` lists the parts of continua.

    >>> [solution.x.tolist() for solution in solve([[1.0]], [[-0.5]], [1.0])]
    [[2.0]]
    """
    return _slideway.solve(A, B, b, _options(**options))


def lcp(M: ArrayLike, q: ArrayLike, **options: Any) -> reports.RawReport:
    """All solutions of `w = M z + q`, `w >= 0`, `z >= 0`, `w z = 0`; options as for `solve`."""
    return _slideway.lcp(M, q, _options(**options))


def hlcp(A: ArrayLike, B: ArrayLike, q: ArrayLike, **options: Any) -> reports.RawReport:
    """All solutions of `A w - B z = q`, `w >= 0`, `z >= 0`, `w z = 0`; options as for `solve`."""
    return _slideway.hlcp(A, B, q, _options(**options))


def mode_problem(
    columns_positive: ArrayLike,
    columns_negative: ArrayLike,
    right_hand_side: ArrayLike,
    *,
    jumps: tuple[ArrayLike, ArrayLike] | None = None,
    **options: Any,
) -> reports.RawReport:
    """All solutions of a mode problem, eq. (6) of Klepp (2002): columns of each contact for either sign of its normal
    force, and the jumps of preloads; options as for `solve`."""
    return _slideway.mode_problem(columns_positive, columns_negative, right_hand_side, jumps, _options(**options))
