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


@pytest.mark.parametrize("method", [name for name in public(Model) if name not in ("load", "save", "draw")])
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


@pytest.mark.parametrize(
    ("argument", "call"),
    [
        ("solution", lambda: DRAWER.draw(-1)),
        ("solution", lambda: DRAWER.solve().draw(-1)),
        ("solution", lambda: DRAWER.draw(2)),
        ("samples", lambda: DRAWER.sweep(samples=-1, mu="0.1..0.5")),
        ("samples", lambda: DRAWER.sweep(samples=0, mu="0.1..0.5")),
        ("seed", lambda: DRAWER.sweep(samples=3, seed=-1, mu="0.1..0.5")),
        ("mu", lambda: DRAWER.sweep(mu=[])),
        ("shard", lambda: DRAWER.sweep(mu=[0.1], shard=(-1, 2))),
        ("max_solutions", lambda: DRAWER.solve(max_solutions=-1)),
        ("max_nodes", lambda: DRAWER.solve(max_nodes=-1)),
        ("max_found", lambda: DRAWER.solve(max_found=-1)),
        ("effort", lambda: DRAWER.limits(mu=(0, 1), effort=-1)),
        ("rows", lambda: DRAWER.drive(mu=(0, 1), rows=-1)),
        ("width and height in size", lambda: DRAWER.map(mu=(0, 1), L=(0.3, 0.5), size=(-1, 2))),
        ("probe", lambda: DRAWER.map(mu=(0, 1), L=(0.3, 0.5), probe=-1)),
        ("branches", lambda: DRAWER.simulate(0.1, branches=[-1])),
        ("all_branches", lambda: DRAWER.simulate(0.1, all_branches=-1)),
        ("max_steps", lambda: DRAWER.simulate(0.1, max_steps=-1)),
        ("max_events", lambda: DRAWER.simulate(0.1, max_events=-1)),
        ("times", lambda: DRAWER.simulate(0.1).table(times=[math.nan])),
        ("times", lambda: DRAWER.simulate(0.1).table(times=[0.2])),
        ("M", lambda: modes.lcp([], [])),
        ("A", lambda: modes.game(np.zeros((2, 2, 2)))),
        ("A", lambda: modes.game([])),
        ("M", lambda: modes.lcp(np.zeros((1, 1, 1)), [1.0])),
        ("max_nodes", lambda: modes.lcp([[1.0]], [1.0], max_nodes=-1)),
        ("max_solutions", lambda: modes.lcp([[1.0]], [1.0], max_solutions=-1)),
        (r"`?jumps\[1\]", lambda: modes.mode_problem([[0.5]], [[-1.5]], [1.0], jumps=([[1]], [[]]))),
    ],
)
def test_what_is_out_of_range_is_a_value_error_with_its_argument(argument: str, call: Any) -> None:
    with pytest.raises(ValueError, match=f"^{argument}"):
        call()


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    "call",
    [
        lambda: DRAWER.with_(mu=np.complex128(0.5 + 1j)),
        lambda: DRAWER.with_(mu=np.complex64(0.5)),
        lambda: DRAWER.sweep(mu=np.array([0.1 + 1j])),
        lambda: DRAWER.limits(mu=(0, np.complex128(1))),
        lambda: DRAWER.simulate(0.1).sol(np.array([0.05 + 1j])),
        lambda: DRAWER.simulate(0.1).table(times=np.array([0.05 + 1j])),
        lambda: modes.lcp([[1 + 1j]], [1.0]),
    ],
)
def test_complex_numbers_are_refused(call: Any) -> None:
    """Whatever warnings are: NumPy would only warn, and drop the imaginary part."""
    with pytest.raises(TypeError):
        call()
