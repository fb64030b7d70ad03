"""All solutions of problems given by matrices: absolute value equations, complementarity problems, games.

>>> import slideway.modes
>>> answer = slideway.modes.lcp([[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0])
>>> answer.complete
'proven'
>>> sorted(solution.z.round(4).tolist() for solution in answer)
[[0.0, 1.0], [0.3333, 0.3333], [1.0, 0.0]]
"""

from __future__ import annotations

import inspect
import operator
from collections.abc import Callable
from typing import Any, TypedDict, TypeVar, Unpack

from numpy.typing import ArrayLike

from . import _slideway, reports
from ._values import Progress

__all__ = ["block_ave", "game", "hlcp", "lcp", "mcp", "mlcp", "mode_problem", "solve"]

_Question = TypeVar("_Question", bound=Callable[..., reports.RawReport])


class Search(TypedDict, total=False):
    """What a search may cost, and what is listed: keywords of every function here."""

    max_solutions: int
    max_nodes: int | None
    max_found: int | None
    uniqueness: bool
    time_limit: float | None
    progress: Progress | None


_DEFAULTS: Search = {
    "max_solutions": 100,
    "max_nodes": None,
    "max_found": None,
    "uniqueness": False,
    "time_limit": None,
    "progress": None,
}
# Stands in the documentation of every function, before its examples.
_DOCUMENTATION = """\
Other Parameters
----------------
max_solutions : int, default 100
    How many solutions to list, perhaps none; all are counted. What is part of a continuum is not listed by itself.
max_nodes : int, optional
    After how many nodes the search ends; the answer is then partial.
max_found : int, optional
    The search of unknowns that do not depend on others ends once it has more solutions than this; the answer
    is then partial.
uniqueness : bool, default False
    Whether to decide if there is exactly one solution for every right-hand side, too.
time_limit : float, optional
    The longest that it may take (s); the answer is then partial.
progress : callable, optional
    Called with the fraction that is done (None if it is not known), a count, and what is counted.

Returns
-------
reports.RawReport
    Iterable over its solutions; `complete` says how it is known that there are no others.

Raises
------
ValueError
    Sizes that do not fit, numbers that are not finite, or a matrix that should be regular and is not.

Examples
--------
"""


def _searching(function: _Question) -> _Question:
    """The function with the keywords of `Search` in its signature and documentation."""
    signature = inspect.signature(function)
    hints = Search.__annotations__
    own = [one for one in signature.parameters.values() if one.kind is not inspect.Parameter.VAR_KEYWORD]
    searching = [
        inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=hints[name].__forward_arg__)
        for name, default in _DEFAULTS.items()
    ]
    function.__signature__ = signature.replace(parameters=[*own, *searching])  # type: ignore[attr-defined]
    text = inspect.cleandoc(function.__doc__ or "")
    function.__doc__ = text.replace("Examples\n--------\n", _DOCUMENTATION)
    return function


def _options(search: Search) -> dict[str, Any]:
    options: dict[str, Any] = {**_DEFAULTS, **search}
    if unknown := options.keys() - _DEFAULTS.keys():
        raise TypeError(f"there is no keyword argument {min(unknown)!r}; there are {', '.join(_DEFAULTS)}")
    for name in ("max_solutions", "max_nodes", "max_found"):
        count = options[name]
        if count is None and name != "max_solutions":
            continue
        try:
            options[name] = operator.index(count)
        except TypeError:
            raise TypeError(f"{name} must be a whole number, not {count!r}") from None
        if not 0 <= options[name] < 1 << 63:
            raise ValueError(f"{name} must be a whole number from 0 on, not {count}")
    return options


def _answer(kind: str, search: Search, **arrays: ArrayLike | None) -> reports.RawReport:
    return _slideway.matrices(kind, list(arrays.items()), _options(search))


@_searching
def solve(A: ArrayLike, B: ArrayLike, b: ArrayLike, **search: Unpack[Search]) -> reports.RawReport:
    """All solutions `x` of the absolute value equation `A x + B |x| = b`.

    Parameters
    ----------
    A, B : array, n by n
    b : array of n

    Examples
    --------
    >>> [solution.x.tolist() for solution in solve([[1.0]], [[-0.5]], [1.0])]
    [[2.0]]
    """
    return _answer("ave", search, A=A, B=B, b=b)


@_searching
def block_ave(
    B: ArrayLike,
    b: ArrayLike,
    blocks: ArrayLike,
    A: ArrayLike | None = None,
    **search: Unpack[Search],
) -> reports.RawReport:
    """All solutions of `A x + B |x| = b`, where `|x|` has the lengths of blocks of one or two components.

    With blocks of one it is an absolute value equation. Blocks of two are forces of hinges with friction, or whatever
    else enters by its length in the plane. There are finitely many solutions, as a rule; each is proven to exist, and
    what could not be decided is in `open`.

    Parameters
    ----------
    B : array, n by m
        A column for each block.
    b : array of n
    blocks : array of m
        How many components belong to each block, 1 or 2; `n` in all.
    A : array, n by n, optional
        A regular matrix; without it, the identity.

    Examples
    --------
    >>> answer = block_ave([[-2.0], [0.0]], [-1.0, 0.0], [2])     # x = (2, 0) |x| - (1, 0)
    >>> sorted(round(float(abs(solution.x[0])), 12) for solution in answer)
    [0.333333333333, 1.0]
    """
    return _answer("block_ave", search, A=A, B=B, b=b, blocks=blocks)


@_searching
def lcp(M: ArrayLike, q: ArrayLike, **search: Unpack[Search]) -> reports.RawReport:
    """All solutions of the linear complementarity problem `w = M z + q`, `w >= 0`, `z >= 0`, `w z = 0`.

    Parameters
    ----------
    M : array, n by n
    q : array of n

    Examples
    --------
    >>> [solution.z.tolist() for solution in lcp([[2.0]], [-1.0])]
    [[0.5]]
    """
    return _answer("lcp", search, M=M, q=q)


@_searching
def hlcp(A: ArrayLike, B: ArrayLike, q: ArrayLike, **search: Unpack[Search]) -> reports.RawReport:
    """All solutions of the horizontal linear complementarity problem `A w - B z = q`, `w >= 0`, `z >= 0`, `w z = 0`.

    Parameters
    ----------
    A, B : array, n by n
    q : array of n

    Examples
    --------
    >>> [solution.z.tolist() for solution in hlcp([[1.0]], [[2.0]], [-1.0])]
    [[0.5]]
    """
    return _answer("hlcp", search, A=A, B=B, q=q)


@_searching
def mlcp(
    A: ArrayLike,
    B: ArrayLike,
    C: ArrayLike,
    D: ArrayLike,
    a: ArrayLike,
    b: ArrayLike,
    **search: Unpack[Search],
) -> reports.RawReport:
    """All solutions of the mixed linear complementarity problem `A u + C z + a = 0`, `w = D u + B z + b`, `w >= 0`,
    `z >= 0`, `w z = 0`, in which `u` is free.

    Parameters
    ----------
    A, B, C, D : array, n by n, m by m, n by m and m by n
    a, b : array of n and of m

    Examples
    --------
    >>> answer = mlcp([[0.0]], [[1.0]], [[1.0]], [[-1.0]], [-1.0], [0.0])     # z = 1, w = z - u
    >>> [(solution.u.tolist(), solution.z.tolist()) for solution in answer]
    [([1.0], [1.0])]
    """
    return _answer("mlcp", search, A=A, B=B, C=C, D=D, a=a, b=b)


@_searching
def mcp(M: ArrayLike, q: ArrayLike, l: ArrayLike, u: ArrayLike, **search: Unpack[Search]) -> reports.RawReport:  # noqa: E741
    """All solutions of the mixed complementarity problem `w = M z + q`, `l <= z <= u`, with `w >= 0` where `z < u`, and
    `w <= 0` where `z > l`.

    Parameters
    ----------
    M : array, n by n
    q, l, u : array of n
        Bounds may be infinite.

    Examples
    --------
    >>> answer = mcp([[1.0]], [-5.0], [0.0], [3.0])
    >>> [(solution.z.tolist(), solution.w.tolist()) for solution in answer]
    [([3.0], [-2.0])]
    """
    return _answer("mcp", search, M=M, q=q, l=l, u=u)


@_searching
def game(A: ArrayLike, B: ArrayLike | None = None, **search: Unpack[Search]) -> reports.RawReport:
    """All Nash equilibria of a bimatrix game: `x` maximises `x A y`, and `y` maximises `x B y`.

    Parameters
    ----------
    A : array, m by n
        Payoffs of the first player, who chooses a row.
    B : array, m by n, optional
        Payoffs of the second player, who chooses a column; by default `-A`.

    Examples
    --------
    >>> answer = game([[2.0, 0.0], [0.0, 1.0]], [[1.0, 0.0], [0.0, 2.0]])     # battle of the sexes
    >>> [(solution.x.round(3).tolist(), round(solution.payoff_1, 3)) for solution in answer]
    [([0.667, 0.333], 0.667), ([1.0, 0.0], 2.0), ([0.0, 1.0], 1.0)]
    """
    return _answer("game", search, A=A, B=B)


@_searching
def mode_problem(
    columns_positive: ArrayLike,
    columns_negative: ArrayLike,
    right_hand_side: ArrayLike,
    *,
    jumps: tuple[ArrayLike, ArrayLike] | None = None,
    **search: Unpack[Search],
) -> reports.RawReport:
    """All solutions of a mode problem, eq. (6) of Klepp (2002).

    Parameters
    ----------
    columns_positive, columns_negative : array, n by n
        The column of each contact for positive and for negative normal force.
    right_hand_side : array of n
        (N)
    jumps : pair of arrays, optional
        The jumps of preloads for positive and for negative normal forces (N).

    Examples
    --------
    >>> answer = mode_problem([[0.5]], [[-1.5]], [1.0])     # 0.5 N = 1, or -1.5 |N| = 1
    >>> [solution.normal_forces.tolist() for solution in answer]
    [[2.0]]
    """
    positive, negative = (None, None) if jumps is None else jumps
    return _answer(
        "modes",
        search,
        columns_positive=columns_positive,
        columns_negative=columns_negative,
        right_hand_side=right_hand_side,
        jumps_positive=positive,
        jumps_negative=negative,
    )
