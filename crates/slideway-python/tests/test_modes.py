"""Problems given by matrices, against every pattern tried in NumPy, and what arrays can be."""

from __future__ import annotations

import inspect
import itertools
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from slideway import modes

Matrix = np.ndarray[Any, Any]
# Distance from which a sign is beyond doubt for matrices whose entries are whole numbers up to 9.
SURE = 1e-9

small = st.integers(-9, 9).map(float)


@st.composite
def problems(draw: Any, matrices: int) -> tuple[Matrix, ...]:
    """Square matrices, and a vector, of whole numbers."""
    size = draw(st.integers(1, 5))
    return (*(draw(arrays(np.float64, (size, size), elements=small)) for _ in range(matrices)),
            draw(arrays(np.float64, size, elements=small)))


def enumerated(columns: Any, size: int, right: Matrix) -> list[Matrix] | None:
    """The values `y >= 0` of all patterns of signs for which `columns(signs) y = right`, with their signs; None if one
    is singular or on a boundary, where counts are a matter of definition."""
    found = []
    for signs in itertools.product((1.0, -1.0), repeat=size):
        matrix = columns(np.array(signs))
        if abs(np.linalg.det(matrix)) < SURE:
            return None
        y = np.linalg.solve(matrix, right)
        if np.abs(y).min() < SURE:
            return None
        if (y > 0).all():
            found.append(np.array(signs) * y)
    return found


def same(found: list[Matrix], wanted: list[Matrix]) -> None:
    assert len(found) == len(wanted)
    for one in wanted:
        assert min(np.abs(one - other).max() for other in found) < 1e-6 * (1 + np.abs(one).max())


@settings(max_examples=300, deadline=None)
@given(problems(2))
def test_absolute_value_equations_by_every_pattern(problem: tuple[Matrix, ...]) -> None:
    a, b, right = problem
    wanted = enumerated(lambda signs: (a + b * signs) * signs, len(right), right)
    if wanted is None:
        return
    # With x = s y, |x| = y: (A D(s) + B) y = b.
    wanted = enumerated(lambda signs: a * signs + b, len(right), right)
    answer = modes.solve(a, b, right)
    if wanted is not None:
        assert answer.complete == "proven"
        same([solution.x for solution in answer], wanted)


@settings(max_examples=300, deadline=None)
@given(problems(1))
def test_complementarity_problems_by_every_pattern(problem: tuple[Matrix, ...]) -> None:
    m, q = problem
    size = len(q)
    identity = np.eye(size)
    # w - M z = q: of each pair, w is chosen (+) or z (-).
    wanted = enumerated(lambda signs: np.where(signs > 0, identity, -m), size, q)
    answer = modes.lcp(m, q)
    if wanted is not None:
        assert answer.complete == "proven"
        same([solution.z for solution in answer], [np.maximum(-one, 0.0) for one in wanted])
    for solution in answer:
        assert solution.w == pytest.approx(m @ solution.z + q, abs=1e-8 * (1 + np.abs(m).sum()))


@settings(max_examples=200, deadline=None)
@given(problems(2))
def test_horizontal_complementarity_problems_by_every_pattern(problem: tuple[Matrix, ...]) -> None:
    a, b, q = problem
    wanted = enumerated(lambda signs: np.where(signs > 0, a, -b), len(q), q)
    answer = modes.hlcp(a, b, q)
    if wanted is not None:
        assert answer.complete == "proven"
        same([solution.z for solution in answer], [np.maximum(-one, 0.0) for one in wanted])


def test_bounds_can_be_infinite() -> None:
    none = float("inf")
    m, q = np.array([[1.0, 2.0], [2.0, 1.0]]), np.array([-1.0, -1.0])
    answer = modes.mcp(m, q, [0.0, 0.0], [none, none])
    same([solution.z for solution in answer], [solution.z for solution in modes.lcp(m, q)])
    free = modes.mcp(m, q, [-none, -none], np.array([none, none]))
    same([solution.z for solution in free], [np.linalg.solve(m, -q)])
    with pytest.raises(ValueError, match="lower bound 2 is above the upper bound 1"):
        modes.mcp(m, q, [0.0, 2.0], [none, 1.0])


def test_what_arrays_can_be() -> None:
    m, q = np.array([[1.0, 2.0], [2.0, 1.0]]), np.array([-1.0, -1.0])
    wanted = modes.lcp(m, q)
    assert wanted.complete == "proven" and len(wanted) == 3
    big = np.zeros((4, 4))
    big[::2, ::2] = m
    for other in (m.tolist(), m.astype(np.float32), m.astype(np.int8), np.asfortranarray(m), big[::2, ::2], m[::-1][::-1]):
        assert modes.lcp(other, q).to_json() == wanted.to_json()
    assert modes.lcp(m, (-1, -1)).to_json() == wanted.to_json()


@pytest.mark.parametrize(
    ("m", "q", "error"),
    [
        ([[1.0, 2.0]], [1.0], ValueError),
        ([[1.0]], [1.0, 2.0], ValueError),
        ([1.0], [1.0], ValueError),
        ([[[1.0]]], [1.0], ValueError),
        ([[np.nan]], [1.0], ValueError),
        ([[np.inf]], [1.0], ValueError),
        ([[1.0]], [np.nan], ValueError),
        ([[1.0, 2.0], [3.0]], [1.0, 1.0], ValueError),
        ([], [], ValueError),
        (np.zeros((0, 0)), np.zeros(0), ValueError),
        ([[1j]], [1.0], TypeError),
        ([["a"]], [1.0], TypeError),
        ([[None]], [1.0], TypeError),
        (None, [1.0], TypeError),
        ("M", [1.0], TypeError),
        ([[True]], [1.0], TypeError),
        (np.array([["2020-01-01"]], dtype="datetime64[D]"), [1.0], TypeError),
    ],
)
def test_bad_arrays(m: Any, q: Any, error: type[Exception]) -> None:
    with pytest.raises(error, match="M|q|the problem is empty"):
        modes.lcp(m, q)


def test_unknown_options() -> None:
    with pytest.raises(TypeError, match="most"):
        modes.lcp([[1.0]], [1.0], most=3)


def test_an_array_that_changes_meanwhile_is_a_copy() -> None:
    m, q = np.array([[1.0, 2.0], [2.0, 1.0]]), np.array([-1.0, -1.0])

    def change(*_: object) -> None:
        m[:] = np.nan

    wanted = modes.lcp(m, q).to_json()
    assert modes.lcp(m, q, progress=change).to_json() == wanted


@pytest.mark.parametrize("kind", modes.__all__)
def test_signatures_name_all_options(kind: str) -> None:
    parameters = inspect.signature(getattr(modes, kind)).parameters
    assert not any(parameter.kind is parameter.VAR_KEYWORD for parameter in parameters.values())
    options = ["max_solutions", "max_nodes", "max_found", "uniqueness", "time_limit", "progress"]
    assert [name for name in parameters if name in options] == options
