"""Motions in time: what they have in common with `scipy.integrate.solve_ivp`, and their tables."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

from slideway import Model, ModelError

# The block on its spring slides until it stops: k = 250 N/m, m = 1 kg, mu = 0.2, g = 9.81 m/s^2, v_0 = 2 m/s.
OSCILLATOR = Model.gallery("frictional-oscillator")


def test_the_first_stop_of_an_oscillator_with_friction() -> None:
    # m x'' = -k x - mu m g until it stops. With u = x + mu m g / k and w = sqrt(k/m):
    # u = u_0 cos(w t) + v_0/w sin(w t), and v = 0 where tan(w t) = v_0 / (w u_0).
    rate, shift = np.sqrt(250.0), 0.2 * 9.81 / 250.0
    stop = np.arctan2(2.0, rate * shift) / rate
    motion = OSCILLATOR.simulate(0.5)
    event = next(event for event in motion.events if any(cause.kind == "stops" for cause in event.causes))
    assert event.time == pytest.approx(stop, abs=1e-8)
    times = np.linspace(0.0, stop, 20)
    expected = (shift * np.cos(rate * times)) + 2.0 / rate * np.sin(rate * times) - shift
    assert motion.sol(times)[0] == pytest.approx(expected, abs=1e-7)


def test_the_shape_of_solve_ivp() -> None:
    motion = OSCILLATOR.simulate(0.5)
    assert motion.coordinates == ["x"]
    assert motion.t[0] == 0.0 and motion.t[-1] == 0.5 and (np.diff(motion.t) >= 0).all()
    assert motion.y.shape == (2, len(motion.t))
    assert motion.y[:, 0] == pytest.approx([0.0, 2.0])
    assert motion.sol(0.1).shape == (2,) and motion.sol([0.1, 0.2]).shape == (2, 2)
    assert motion.sol(motion.t[5]) == pytest.approx(motion.y[:, 5], abs=1e-12)
    assert np.isnan(motion.sol([-1.0, 0.1, 9.0])[0]).tolist() == [True, False, True]


def test_tables() -> None:
    motion = OSCILLATOR.simulate(0.2)
    table = motion.table(0.05)
    assert next(iter(table.values())) == pytest.approx([0.0, 0.05, 0.1, 0.15, 0.2])
    assert {len(column) for column in table.values()} == {5}
    assert len(motion.table()["mode"]) == len(motion.t)
    with pytest.raises(ValueError, match="step must be positive"):
        motion.table(0.0)
    with pytest.raises(ValueError, match="step must be positive"):
        motion.table(1e-12)


def test_a_time_can_have_a_unit() -> None:
    assert OSCILLATOR.simulate("50 ms").t[-1] == 0.05


def test_nothing_to_simulate_is_a_fault() -> None:
    for until in (0, -1):
        with pytest.raises(ModelError):
            OSCILLATOR.simulate(until)


def test_motions_are_the_same_again() -> None:
    one, other = OSCILLATOR.simulate(0.2), OSCILLATOR.simulate(0.2)
    assert one.report == other.report and one.to_json() == other.to_json()
    assert np.array_equal(one.y, other.y)


def test_pages_and_plots() -> None:
    motion = OSCILLATOR.simulate(0.2)
    assert motion.text(all_events=True) and str(motion) == motion.text()
    assert repr(motion).startswith("<slideway.Motion: ")


def test_a_pickled_motion_has_its_steps() -> None:
    motion = OSCILLATOR.simulate(0.5)
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(motion))))
    assert np.array_equal(again.t, motion.t) and np.array_equal(again.y, motion.y)
    assert again.report == motion.report and again.events == motion.events and repr(again) == repr(motion)
    assert again.text(all_events=True) == motion.text(all_events=True) and again.to_json() == motion.to_json()
    table, kept = motion.table(), again.table()
    assert list(table) == list(kept) and all(np.array_equal(table[name], kept[name], equal_nan=name != "mode") for name in table)
    assert np.array_equal(again.sol(motion.t[3]), motion.y[:, 3]) and np.isnan(again.sol(9.0)).all()
    assert "<pre " in again._repr_html_()
    for ask in (lambda: again.sol(0.1234), lambda: again.table(times=[0.1234])):
        with pytest.raises(ValueError, match="its steps"):
            ask()
    with pytest.raises(AttributeError, match="ask the model again"):
        again.plot()


def test_times_of_a_table_lie_within_the_motion() -> None:
    motion = OSCILLATOR.simulate(0.2)
    for times in ([-0.1], [0.1, 0.3], [np.nan]):
        with pytest.raises(ValueError, match="times must be from 0 to 0.2 s"):
            motion.table(times=times)
