#!/usr/bin/env python3
"""Motion of the gallery's slider-crank with rough pins, integrated apart from slideway: writes pinned-slider-crank-motion.toml.

    python3 -m venv venv && venv/bin/pip install numpy
    venv/bin/python reference/pinned_slider_crank_motion.py > reference/pinned-slider-crank-motion.toml

One coordinate, the crank angle phi, as in slider_crank_motion.py. Newton's and Euler's equations of crank, rod and piston are
linear in phi'', the forces A on the rod at the crank pin, B on the piston at the wrist pin, and the normal forces N_1, N_2 at the
ends of the skirt, once the couples of the pins are known: -r |R| sgn(spin), r = rho sin(atan(mu)). Those are iterated until they
do not change: with pins so much smaller than the links each pass is a contraction. The signs of N_1, N_2 are those that agree
with themselves. Classical Runge-Kutta steps, each cut where a velocity or a normal force changes its sign.
"""
import itertools
import math

import numpy as np

from slider_crank_motion import bore as h
from slider_crank_motion import g, i_crank, i_rod, kinematics, l, m_crank, m_piston, m_rod, mu, r, skirt

MU_PIN, SHAFT, PIN = 0.1, 0.015, 0.01
R_O, R_PIN = (rho * math.sin(math.atan(MU_PIN)) for rho in (SHAFT, PIN))
GAS, TORQUE = -1000.0, 20.0
TIMES = [0.01, 0.02, 0.03, 0.05, 0.08, 0.1]
STEP = 1e-5


def rod_rate(phi, omega):
    beta = math.asin(r * math.sin(phi) / l)
    return -r * math.cos(phi) / (l * math.cos(beta)) * omega


def signs_of(phi, omega):
    """Signs of the sliding velocity and of the spins at O, A and B."""
    rod = rod_rate(phi, omega)
    return tuple(math.copysign(1.0, value) for value in (kinematics(phi, omega)[4], omega, rod - omega, -rod))


def solution(phi, omega, signs, sides):
    """phi'', N_1, N_2 and the forces at O, A and B with these signs."""
    slide, spin_o, spin_a, spin_b = signs
    beta, xb, (sx, sy), alpha, _ = kinematics(phi, omega)
    cb, sb, cp, sp = math.cos(beta), math.sin(beta), math.cos(phi), math.sin(phi)
    one, two = (mu * side * slide for side in sides)
    matrix = np.array([
        [m_piston * xb[0], 0, 0, -1, 0, one, two],
        [0, 0, 0, 0, 1, 1, 1],
        [m_rod * sx[0], -1, 0, 1, 0, 0, 0],
        [m_rod * sy[0], 0, -1, 0, 1, 0, 0],
        [i_rod * alpha[0], l / 2 * sb, l / 2 * cb, l / 2 * sb, l / 2 * cb, 0, 0],
        [i_crank, -r * sp, r * cp, 0, 0, 0, 0],
        # moments about the wrist pin: friction at y = -side h/2
        [0, 0, 0, 0, 0, skirt / 2 - h / 2 * mu * slide, -skirt / 2 - h / 2 * mu * slide],
    ])
    right = np.array([-m_piston * xb[1] + GAS, m_piston * g, -m_rod * sx[1], -m_rod * sy[1] - m_rod * g, -i_rod * alpha[1], TORQUE, 0])
    couples = np.zeros(3)
    while True:
        m_o, m_a, m_b = couples
        found = np.linalg.solve(matrix, right + np.array([0, 0, 0, 0, m_a - m_b, m_o - m_a, -m_b]))
        forces = [math.hypot(found[1], found[2] + m_crank * g), math.hypot(found[1], found[2]), math.hypot(found[3], found[4])]
        new = np.array([-R_O * forces[0] * spin_o, -R_PIN * forces[1] * spin_a, -R_PIN * forces[2] * spin_b])
        if np.max(np.abs(new - couples)) <= 1e-15 * np.max(np.abs(new)):
            return found[0], found[5], found[6], forces
        couples = new


def sides_of(phi, omega, signs):
    """The signs of the normal forces that agree with themselves."""
    fits = []
    for sides in itertools.product((1.0, -1.0), repeat=2):
        found = solution(phi, omega, signs, sides)
        if found[1] * sides[0] >= 0 and found[2] * sides[1] >= 0:
            fits.append(sides)
    assert len(fits) == 1, (phi, omega, fits)
    return fits[0]


def rates(state, pattern):
    phi, omega = state[:2]
    signs, sides = pattern
    found = solution(phi, omega, signs, sides)
    spins = (omega, rod_rate(phi, omega) - omega, -rod_rate(phi, omega))
    rubbing = sum(radius * force * abs(spin) for radius, force, spin in zip((R_O, R_PIN, R_PIN), found[3], spins))
    sliding = mu * (abs(found[1]) + abs(found[2])) * abs(kinematics(phi, omega)[4])
    return np.array([omega, found[0], rubbing, sliding])


def step(state, pattern, length):
    one = rates(state, pattern)
    two = rates(state + length / 2 * one, pattern)
    three = rates(state + length / 2 * two, pattern)
    four = rates(state + length * three, pattern)
    return state + length / 6 * (one + 2 * two + 2 * three + four)


def margin(state, pattern):
    """The least of what keeps its sign within a pattern."""
    phi, omega = state[:2]
    signs, sides = pattern
    rod = rod_rate(phi, omega)
    spins = (kinematics(phi, omega)[4], omega, rod - omega, -rod)
    found = solution(phi, omega, signs, sides)
    return min([value * sign for value, sign in zip(spins, signs)] + [found[1] * sides[0], found[2] * sides[1]])


def pattern_after(state, pattern):
    """The pattern a little later in the motion of this one."""
    phi, omega = step(state, pattern, 1e-9)[:2]
    signs = signs_of(phi, omega)
    return signs, sides_of(phi, omega, signs)


def main():
    state = np.array([math.radians(60), 100.0, 0.0, 0.0])
    signs = signs_of(*state[:2])
    pattern = (signs, sides_of(*state[:2], signs))
    time, samples, events = 0.0, [], []
    for target in TIMES:
        while time < target:
            length = min(STEP, target - time)
            end = step(state, pattern, length)
            if margin(end, pattern) < 0:
                low, high = 0.0, length
                while high - low > 1e-16 + 1e-15 * time:
                    middle = (low + high) / 2
                    if margin(step(state, pattern, middle), pattern) < 0:
                        high = middle
                    else:
                        low = middle
                    if middle in (low, high) and high - low <= 4e-17:
                        break
                state, time = step(state, pattern, high), time + high
                new = pattern_after(state, pattern)
                events.append((time, pattern, new))
                pattern = new
            else:
                state, time = end, time + length
        samples.append((target, *state))
    print("# Written by pinned_slider_crank_motion.py, which says how: models/slider-crank-with-pins.toml from its own state on.")
    print("# Steps of 1e-5 s; half of that changes no number by more than 1e-12 of it.")
    reversals = [time for time, old, new in events if old[0][0] != new[0][0]]
    turns = [time for time, old, new in events if old[0][3] != new[0][3]]
    print("# Times at which the piston reverses, and at which the wrist pin turns back.")
    print("piston_reverses = [" + ", ".join(f"{time:.12f}" for time in reversals) + "]")
    print("pin_turns_back = [" + ", ".join(f"{time:.12f}" for time in turns) + "]")
    for time, phi, omega, rubbing, sliding in samples:
        print(f"\n[[sample]]\ntime = {time}\nphi = {phi:.12f}\nomega = {omega:.11f}\npins = {rubbing:.12f}\nskirt = {sliding:.12f}")


if __name__ == "__main__":
    main()
