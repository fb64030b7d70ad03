"""Whatever is passed: an exception that says what is wrong, never a crash or a panic."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import slideway
from slideway import Mechanism, Model, modes

ALLOWED = (ValueError, TypeError, KeyError, OverflowError, TimeoutError, MemoryError)
assert issubclass(slideway.ModelError, ValueError)

DRAWER = Model.gallery("drawer")

numbers = st.one_of(
    st.floats(), st.integers(), st.sampled_from([0, 1, -1, 10**400, 5e-324, 1e308, math.nan, math.inf, -math.inf])
)
texts = st.one_of(
    st.text(max_size=12),
    st.sampled_from(["25 mm", "75 deg", "mu", "2*L", "1/0", "sqrt(-1)", "1e999", "nan", "(", "drawer", "guide", "x"]),
)
things = st.one_of(
    numbers,
    texts,
    st.none(),
    st.booleans(),
    st.binary(max_size=4),
    st.complex_numbers(),
    st.builds(object),
    st.sampled_from([np.nan, np.float32(1), np.array([1.0, 2.0]), np.array([[1.0]]), np.datetime64("2020"), slice(1)]),
    st.lists(st.one_of(numbers, texts, st.none()), max_size=4),
    st.lists(st.lists(numbers, max_size=3), max_size=3),
    st.tuples(texts, st.tuples(numbers, numbers)),
    st.dictionaries(texts, st.one_of(numbers, texts), max_size=3),
)
names = st.one_of(
    st.sampled_from(["mu", "L", "x", "friction", "mass", "at", "length", "front", "drawer", "margin", "load", "vary"]),
    st.text(max_size=5),
)


def tried(call: Any, arguments: Any, named: dict[str, Any]) -> None:
    try:
        answer = call(*arguments, **named)
        str(answer)
        repr(answer)
    except ALLOWED as error:
        assert str(error) or error.args


def public(of: type) -> list[str]:
    """The public methods of a class, and its operators that take arguments."""
    return sorted(name for name in dir(of) if not name.startswith("_") and callable(getattr(of, name)))


# What bounds the work of each question.
BOUNDS: dict[str, dict[str, Any]] = {
    "map": {"size": (2, 2), "time_limit": 0.5},
    "simulate": {"max_steps": 50, "max_events": 10, "time_limit": 0.5},
    "sweep": {"time_limit": 0.5},
    "solve": {"time_limit": 0.5},
    "limits": {"time_limit": 0.5},
    "hold": {"time_limit": 0.5},
    "rest_limits": {"time_limit": 0.5},
    "size": {"time_limit": 0.5},
    "drive": {"time_limit": 0.5},
}
SETTINGS = settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))


@pytest.mark.parametrize("method", [name for name in public(Model) if name not in ("load", "draw")])
@SETTINGS
@given(st.lists(things, max_size=4), st.dictionaries(names, things, max_size=3))
def test_methods_of_models(method: str, arguments: list[Any], named: dict[str, Any]) -> None:
    tried(getattr(DRAWER, method), arguments, BOUNDS.get(method, {}) | named)


@pytest.mark.parametrize("method", ["solve", "limits", "hold", "size", "drive", "map", "simulate", "sweep", "with_"])
@SETTINGS
@given(st.data())
def test_single_arguments_of_models(method: str, data: st.DataObject) -> None:
    """Each argument for itself, everything else being sound."""
    sound: dict[str, tuple[tuple[Any, ...], dict[str, Any]]] = {
        "solve": ((), {"max_solutions": 3, "max_nodes": 9, "max_found": 3, "margins": False}),
        "limits": (("mu", 0, 1), {"max_reaction": 100.0, "effort": 10, "quantity": "friction"}),
        "hold": (("gravity",), {"vary": "mu", "drives": "hold"}),
        "size": (("mu", 0.1, 1), {"margin": 2, "against": "locking", "load": None}),
        "drive": (("mu", (0, 1)), {"rows": 2}),
        "map": ((), {"mu": (0, 1), "L": (0.3, 0.5), "colour_by": "solutions", "probe": 1}),
        "simulate": ((0.01,), {"mode": None, "branches": [1], "tolerance": 1e-6, "longest_step": 0.1}),
        "sweep": ((), {"mu": [0.1, 0.2], "seed": 1, "samples": None, "sampling": "random"}),
        "with_": ((), {"mu": 0.1, "at": {"x": 0}, "rate": {"x": 1}, "time": 0, "units": "SI"}),
    }
    arguments, named = sound[method]
    named = BOUNDS.get(method, {}) | named
    place = data.draw(st.integers(0, len(arguments) + len(named) - 1))
    thing = data.draw(things)
    changed = [thing if index == place else given for index, given in enumerate(arguments)]
    keys = list(named)
    if place >= len(arguments):
        named[keys[place - len(arguments)]] = thing
    tried(getattr(DRAWER, method), changed, named)


@pytest.mark.parametrize("method", public(Mechanism))
@SETTINGS
@given(st.lists(things, max_size=4), st.dictionaries(names, things, max_size=3))
def test_methods_of_mechanisms(method: str, arguments: list[Any], named: dict[str, Any]) -> None:
    mechanism = Mechanism()
    mechanism.body("drawer", mass=1)
    tried(getattr(mechanism, method), arguments, named)
    tried(mechanism.build, (), {})


@SETTINGS
@given(things, things, things, things, st.dictionaries(names, things, max_size=2))
def test_block_sliders(at: Any, length: Any, mu: Any, front: Any, values: dict[str, Any]) -> None:
    mechanism = Mechanism()
    mechanism.body("drawer", mass=1, inertia=1, centre=(0, 0))
    named = {"at": at, "length": length, "mu": mu, "front": front, "rear": values}
    tried(mechanism.block_slider, ("rail", "drawer", "ground"), named)
    tried(mechanism.build, (), {})


@pytest.mark.parametrize("kind", modes.__all__)
@SETTINGS
@given(st.lists(things, min_size=2, max_size=4), st.dictionaries(names, things, max_size=1))
def test_problems_given_by_matrices(kind: str, arguments: list[Any], named: dict[str, Any]) -> None:
    tried(getattr(modes, kind), arguments, {"time_limit": 0.5} | named)


@SETTINGS
@given(st.text(max_size=200))
def test_texts_of_models(text: str) -> None:
    tried(Model.parse, (text,), {})


@SETTINGS
@given(st.integers(0, len(DRAWER.text)), st.integers(0, 40), st.text(max_size=8))
def test_damaged_models(start: int, count: int, text: str) -> None:
    tried(Model.parse, (DRAWER.text[:start] + text + DRAWER.text[start + count :],), {})


@SETTINGS
@given(things, things)
def test_motions(first: Any, second: Any) -> None:
    motion = DRAWER.simulate(0.01)
    tried(motion.table, (first,), {})
    tried(motion.table, (), {"times": second})
    tried(motion.sol, (first,), {})


@pytest.mark.parametrize("limit", [0, -1, math.nan, -math.inf, 1e400 * 0, "1", [1]])
def test_time_limits(limit: Any) -> None:
    with pytest.raises((ValueError, TypeError), match="time_limit"):
        DRAWER.solve(time_limit=limit)


def test_huge_sizes() -> None:
    for call in (
        lambda: DRAWER.map(mu=(0, 1), L=(0.3, 0.5), size=(10**9, 10**9)),
        lambda: DRAWER.map(mu=(0, 1), L=(0.3, 0.5), size=(2**70, 1)),
        lambda: DRAWER.sweep(mu="0..1:1000000000000", time_limit=0.2),
        lambda: DRAWER.drive("mu", (0, 1), rows=10**12),
        lambda: DRAWER.simulate(0.01).table(1e-300),
    ):
        with pytest.raises(ALLOWED):
            call()
