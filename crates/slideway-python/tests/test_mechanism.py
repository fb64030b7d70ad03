"""Mechanisms that are put together in code."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

from slideway import GROUND, Mechanism, Model, ModelError


def drawer() -> Mechanism:
    m = Mechanism("Drawer", gravity=9.81, time="0 s")
    m.parameter("mu", 0.3)
    body = m.body("drawer", mass=2.0, centre=(0, 0.1), inertia=0.05, outline=[(0, 0), (1, 0), (1, 1)])
    rail = m.block_slider("rail", body, GROUND, at=(0, 0), length="400 mm", mu="mu")
    m.force("push", body, at=(-0.2, 0.15), components=(20, 0))
    m.slide("x", rail, rate=1.0)
    return m


def test_a_drawer_by_moments() -> None:
    m = Mechanism()
    body = m.body("drawer", mass=2.0, centre=(0, 0.1), inertia=0.05)
    rail = m.block_slider("rail", body, GROUND, at=(0, 0), length=0.4, mu=0.3)
    m.force("push", body, at=(-0.2, 0.15), components=(20, 0))
    m.slide("x", rail, rate=1.0)
    (solution,) = m.build().solve()
    # Moments about the middle of the rail, with N_f + N_r = 0: the push has the lever 0.15 m, inertia 0.1 m.
    front = solution.normal_forces[0]
    friction = 0.3 * 2.0 * abs(front)
    assert front * 0.4 == pytest.approx(20.0 * 0.15 - 0.1 * (20.0 - friction), abs=1e-12)


def test_the_example_of_klepp_is_the_model_of_the_gallery() -> None:
    angle = np.radians(80.0)
    top = (np.cos(angle), np.sin(angle))
    middle = (top[0] / 2, top[1] / 2)
    m = Mechanism("A bar sliding in two horizontal slots", gravity=9.81)
    mu_1 = m.parameter("mu_1", 0.5)
    bar = m.body("bar", mass=1, bar=((0, 0), top))
    block = m.body("lower_block", massless=True)
    upper = m.pin_in_slot("upper", bar, GROUND, at=top, mu=mu_1)
    preload = {"mu": 0.1, "preload": 9.81}
    m.block_slider("lower", block, GROUND, at=(0, 0), length=0.2, height=0.1, front=preload, rear={"mu": 0.1})
    m.hinge("A", bar, block, at=(0, 0))
    m.spring("spring", (GROUND, (middle[0] - 2, middle[1])), (bar, middle), stiffness=0)
    m.damper("damper", (GROUND, (middle[0] - 2, middle[1])), (bar, middle), damping="0 N s/m")
    m.slide("q", upper, rate=1)
    own, gallery = m.build().solve(), Model.gallery("klepp-2002").solve()
    assert len(own) == len(gallery) == 3
    for one, other in zip(own, gallery):
        assert one.normal_forces == pytest.approx(other.normal_forces, rel=1e-9)
        assert one.friction_forces == pytest.approx(other.friction_forces, rel=1e-9)


def bar_on_pads(**pads: Any) -> Mechanism:
    """A bar 0.6 m long on two pads and others, pushed down and pulled at a handle."""
    m = Mechanism()
    bar = m.body("bar", mass=5, centre=(0, 0), inertia=0.2)
    guide = m.block_slider("guide", bar, GROUND, at=(0, 0), length=0.6, mu=0, play="0.2 mm", stiffness=1e5, **pads)
    m.force("down", bar, at=(0.1, 0), components=(30, -40))
    m.slide("s", guide, rate=0.3)
    return m


def test_pads_that_share_a_load() -> None:
    (two,) = bar_on_pads().build().solve()
    # Moments about either end: 40 N at 0.4 m of 0.6 m.
    assert two.normal_forces == pytest.approx([40 * 0.4 / 0.6, 40 * 0.2 / 0.6])
    assert [contact.deflection for contact in two.contacts] == [None, None]
    # The line of the guide is lower at the pad between by more than its load could press it: it is open, and lies on
    # the straight line between the ends, which are pressed through half their play and their stiffness.
    pads = {"middle": {"at": 0.1, "misalignment": "-1 mm", "play": "3 mm"}}
    (three,) = bar_on_pads(supports=pads).build().solve()
    assert three.pattern == "++0"
    assert three.normal_forces == pytest.approx([*two.normal_forces, 0.0])
    ends = [-1e-4 - force / 1e5 for force in two.normal_forces]
    straight = ends[0] * 4 / 6 + ends[1] * 2 / 6
    assert [contact.deflection for contact in three.contacts] == pytest.approx([*ends, straight + 1e-3])
    report = bar_on_pads(supports=pads, rear={"play": 0, "stiffness": 2e5}).build().solve()
    assert report.sharing is not None
    assert report.sharing.groups == (("guide.front", "guide.rear", "guide.middle"),)
    assert report.solutions[0].contacts[1].deflection == pytest.approx(-two.normal_forces[1] / 2e5)


def test_everything_there_is() -> None:
    m = Mechanism("All", gravity=(0, -9.81))
    arm = m.body("arm", mass="1 kg", centre=np.array([0.5, 0.0]), rectangle=[1, "10 mm"])
    wheel = m.body("wheel", mass=1, centre=(0, 2), disc=0.2)
    sleeve = m.body("sleeve", mass=0.5, centre=(0.5, 0), inertia=0.01)
    assert m.hinge("pivot", arm, GROUND, at=(0, 0)) == "pivot"
    m.hinge("axle", wheel, "ground", (0, 2))
    by_side = {"plus": 0.1, "minus": 0.2}
    slider = m.guided_slider(
        "guide", sleeve, arm, at=(0.5, 0), length=0.1, along=0, height=0.02, around=True, travel=(-0.4, 0.4),
        restitution=0.5, mu=by_side, mu_static=0.3, preload={"plus": 1, "minus": 2}, centred_preload=True,
        stiffness=1e6, pad=(0.1, 0.02),
    )
    m.force("pull", sleeve, at=(0.5, 0), magnitude=5, direction="30 deg", turning=True, reaction=arm)
    m.torque("motor", arm, "2 N m", reaction=wheel)
    m.spring("spring", (arm, (1, 0)), (GROUND, (1, 1)), stiffness=10, free_length=0.9)
    m.torsional_spring("clock", wheel, GROUND, stiffness=2, free_angle="10 deg")
    m.torsional_damper("brake", wheel, GROUND, damping=0.1)
    m.rotation("phi", arm, rate="1 rad/s", value=0.1, drawn_at=0)
    psi = m.rotation("psi", wheel, relative_to=GROUND)
    m.slide("s", slider, drawn_at=0.5, value="0.45 m", rate=0.1)
    m.drive_by_torque("hand", psi, wheel, acceleration=1, reaction=arm)
    model = m.build()
    assert model.coordinates == ["phi", "psi", "s"]
    assert model.check().sound
    assert Model.parse(m.to_toml()) == model
    text = m.to_toml()
    for said in ("fit = \"around\"", "plus = 0.1", "minus = 2", "restitution = 0.5", "frame = \"body\"", "preload_line"):
        assert said in text


def test_a_drive_by_force() -> None:
    m = Mechanism()
    block = m.body("block", mass=2, centre=(0, 0), inertia=0.1)
    rail = m.block_slider("rail", block, GROUND, at=(0, 0), length=0.4, mu=0.0)
    x = m.slide("x", rail, rate=1)
    m.drive_by_force("push", x, block, at=(0, 0), direction=0, acceleration=3)
    (solution,) = m.build().solve()
    assert solution.efforts == pytest.approx([6.0])


@pytest.mark.parametrize(
    ("add", "message"),
    [
        (lambda m: m.hinge("h", "drawr", GROUND, at=(0, 0)), "argument first: there is no body named `drawr`"),
        (lambda m: m.hinge("h", GROUND, "gruond", at=(0, 0)), "argument second: there is no body named `gruond`"),
        (lambda m: m.slide("y", "rial"), "argument slider: there is no sliding joint named `rial`"),
        (lambda m: m.drive_by_torque("d", "y", "drawer"), "argument coordinate: there is no coordinate named `y`"),
        (lambda m: m.torque("t", "drawer", 1, reaction="x"), "argument reaction: there is no body named `x`"),
        (lambda m: m.rotation("r", "drawer", relative_to="x"), "argument relative_to: there is no body named `x`"),
    ],
)
def test_unknown_names_have_suggestions(add: Any, message: str) -> None:
    m = drawer()
    before = m.to_toml()
    with pytest.raises(ModelError) as caught:
        add(m)
    assert str(caught.value).startswith(message)
    assert caught.value.faults[0].hint
    assert m.to_toml() == before


@pytest.mark.parametrize(
    ("add", "error", "message"),
    [
        (lambda m: m.body("drawer", mass=1), ValueError, "there is a body named \"drawer\" already"),
        (lambda m: m.slide("x", "rail"), ValueError, "there is a coordinate named \"x\" already"),
        (lambda m: m.body("b", mass=float("nan")), ValueError, "mass must be"),
        (lambda m: m.body("b", mass=float("inf")), ValueError, "mass must be"),
        (lambda m: m.body("b", mass=True), TypeError, "mass must be"),
        (lambda m: m.body("b", mass=[1]), TypeError, "mass must be"),
        (lambda m: m.body("b", mass=10**400), TypeError, "mass must be"),
        (lambda m: m.body("b", centre=(1, 2, 3)), ValueError, "centre must be two values, not 3"),
        (lambda m: m.body("b", centre=1), TypeError, "centre must be a sequence"),
        (lambda m: m.body("b", centre="ab"), TypeError, "centre must be a sequence"),
        (lambda m: m.body("b", outline=[(0, 0), (1,)]), ValueError, "outline must be two values, not 1"),
        (lambda m: m.body(3), TypeError, "name"),
        (lambda m: m.body("b", weight=3), TypeError, "weight"),
        (lambda m: m.spring("s", "drawer", (GROUND, (0, 0)), stiffness=1), TypeError, "first must be"),
        (lambda m: m.spring("s", (3, (0, 0)), (GROUND, (0, 0)), stiffness=1), TypeError, "first must begin"),
        (lambda m: slider(m, mu={"plus": 1}), ValueError, "mu by side must have"),
        (lambda m: slider(m, mu={"plus": 1, "minus": None}), TypeError, "mu\\[\"minus\"\\] must be"),
        (lambda m: slider(m, front={"mue": 1}), ValueError, "front has no \"mue\"; did you mean \"mu\""),
        (lambda m: slider(m, front={"mu": np.nan}), ValueError, "front\\[\"mu\"\\] must be"),
        (lambda m: slider(m, supports=[0.1]), TypeError, "supports must be a mapping of mappings"),
        (lambda m: slider(m, supports={"a": 0.1}), TypeError, "supports must be a mapping of mappings"),
        (lambda m: slider(m, supports={"a": {}}), ValueError, "supports\\[\"a\"\\] must have \"at\""),
        (lambda m: slider(m, supports={"a": {"at": 0, "paly": 0}}), ValueError, "did you mean \"play\""),
        (lambda m: slider(m, front={"at": 0}), ValueError, "front has no \"at\""),
        (lambda m: slider(m, rear={"carried_by_guide": 1}), TypeError, "must be True or False"),
        (lambda m: slider(m, rear=3), TypeError, "rear must be a mapping"),
        (lambda m: slider(m, rear={3: 3}), TypeError, "the keys of rear must be texts"),
        (lambda m: Mechanism(gravity=np.nan), ValueError, "gravity must be"),
        (lambda m: Mechanism(gravity=(1, 2, 3)), ValueError, "gravity must be two"),
        (lambda m: Mechanism(3), TypeError, "title"),
    ],
)
def test_bad_arguments_are_named_and_change_nothing(add: Any, error: type[Exception], message: str) -> None:
    m = drawer()
    before = m.to_toml()
    with pytest.raises(error, match=message):
        add(m)
    assert m.to_toml() == before
    assert m.build().solve().status == "one"


def slider(m: Mechanism, **given: Any) -> str:
    return m.block_slider("other", "drawer", GROUND, at=(0, 0), length=1, **given)


def test_what_is_missing_is_told_all_at_once() -> None:
    m = Mechanism()
    m.body("drawer")
    m.block_slider("rail", "drawer", GROUND, at=(0, 0), length="2 kg")
    with pytest.raises(ModelError) as caught:
        m.build()
    assert len(caught.value.faults) >= 3
    lines = m.to_toml().splitlines()
    for fault in caught.value.faults:
        assert fault.line is None or fault.line <= len(lines)


def test_copies_are_their_own() -> None:
    m = drawer()
    for other in (copy.copy(m), copy.deepcopy(m)):
        other.body("second", mass=1)
        assert "second" not in m.to_toml() and "second" in other.to_toml()
    assert repr(m) == (
        "<slideway.Mechanism: parameter mu, body drawer, joint rail, load push, coordinate x>"
    )
    assert repr(Mechanism()) == "<slideway.Mechanism: empty>"


def test_a_pickled_mechanism_goes_on() -> None:
    m = drawer()
    for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
        again = pickle.loads(pickle.dumps(m, protocol))
        assert again.to_toml() == m.to_toml() and repr(again) == repr(m)
    assert again.build().with_(mu=0.2) == m.build().with_(mu=0.2)
    for each in (m, again):
        each.force("second", "drawer", at=(0, 0), components=("mu * 1 N", 0))
        each.drive_by_force("drive", "x", "drawer", at=(0, 0), direction=0)
        with pytest.raises(ValueError, match="there is a joint named \"rail\" already"):
            slider_named(each, "rail")
    assert again.to_toml() == m.to_toml() and "second" in m.to_toml()
    with pytest.raises(ValueError, match="no mechanism that this version of slideway has pickled"):
        Mechanism._restore("{}")


def slider_named(m: Mechanism, name: str) -> str:
    return m.block_slider(name, "drawer", GROUND, at=(0, 0), length=1)


def test_names_are_written_safely() -> None:
    m = Mechanism('a "quoted"\n\x1b title')
    m.body('odd "name"]\n[bodies.x', mass=1)
    with pytest.raises(ModelError) as caught:
        m.build()
    assert "\x1b" not in str(caught.value)


def test_a_loose_guide_bounces_between_its_faces() -> None:
    m = Mechanism()
    m.body("drawer", mass=1, centre=(0, 0), inertia=1)
    m.block_slider("rail", "drawer", GROUND, at=(0, 0), length=0.4, mu=0.2, play="1 mm", loose=0.5)
    m.guided_slider("guide", "drawer", GROUND, at=(0, 0), length=0.4, mu=0.2, play="1 mm", loose=0)
    m.pin_in_slot("pin", "drawer", GROUND, at=(0, 0), mu=0.2, play="1 mm", loose=0.25)
    text = m.to_toml()
    assert text.count("loose = true") == 3
    restitutions = [float(line.split("=")[1]) for line in text.splitlines() if line.startswith("restitution")]
    assert restitutions == [0.5, 0, 0.25]
