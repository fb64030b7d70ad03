#!/usr/bin/env python3
"""Stick-slip with friction that falls with the sliding speed, integrated apart from slideway: writes stribeck-belt.toml.

    python3 -m venv venv && venv/bin/pip install numpy scipy
    venv/bin/python reference/stribeck_belt.py > reference/stribeck-belt.toml

The gallery's stick-slip, a block of 1 kg on a belt, held by a spring of 100 N/m, with

    mu(r) = 0.25 + 0.15 exp(-(r/r_s)^2) + 0.1 r/(1 m/s),    r_s = 0.1 m/s,    r = |V - x'|

in place of its constant coefficient, and static friction mu(0) = 0.4. One coordinate:

    slides:  m x'' = -k x + m g mu(r) sign(V - x')      until x' = V
    sticks:  x' = V                                     until k x = 0.4 m g

Integrated with DOP853 (relative tolerance 1e-13) from event to event. The block begins at rest where the spring has no force.
"""
import math

from scipy.integrate import solve_ivp

M, K, G, MU_STATIC, END = 1.0, 100.0, 9.81, 0.4, 4.0


def mu(r):
    return 0.25 + 0.15 * math.exp(-((r / 0.1) ** 2)) + 0.1 * r


def run(belt, times):
    t, x, velocity, events, samples = 0.0, 0.0, 0.0, [], []
    while t < END:
        # The block is slower than the belt, whose friction takes it along.
        done = solve_ivp(
            lambda _, y: [y[1], -K / M * y[0] + G * mu(abs(belt - y[1]))],
            (t, END),
            [x, velocity],
            method="DOP853",
            rtol=1e-13,
            atol=1e-15,
            max_step=0.01,
            events=stops(belt, t),
            dense_output=True,
        )
        samples += [(q, *done.sol(q)) for q in times if t < q <= done.t[-1]]
        t, (x, velocity) = done.t[-1], done.y[:, -1]
        if done.status != 1:
            break
        events.append((t, "sticks"))
        assert abs(K * x) < MU_STATIC * M * G
        slips = t + (MU_STATIC * M * G / K - x) / belt
        samples += [(q, x + belt * (q - t), belt) for q in times if t < q <= min(slips, END)]
        if slips >= END:
            break
        t, x, velocity = slips, MU_STATIC * M * G / K, belt
        events.append((t, "slips"))
    return events, samples


def stops(belt, start):
    """The velocity of the belt is reached from below; just after a slip the block has it still."""

    def reaches(t, y):
        return y[1] - belt if t > start + 1e-3 else -1.0

    reaches.terminal, reaches.direction = True, 1
    return reaches


if __name__ == "__main__":
    print("# Written by stribeck_belt.py, which says how.")
    for belt in (0.05, 0.2):
        events, samples = run(belt, [0.5, 1.0, 2.0, 3.0, 4.0])
        print(f"\n[[run]]\nbelt = {belt}")
        print("events = [" + ", ".join(f'[{t:.12f}, "{word}"]' for t, word in events) + "]")
        print("samples = [" + ", ".join(f"[{t}, {x:.13f}, {v:.12f}]" for t, x, v in samples) + "]")
