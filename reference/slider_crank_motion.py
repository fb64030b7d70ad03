#!/usr/bin/env python3
"""Motion of two slider-cranks over many turns, integrated apart from slideway: writes slider-crank-motion.toml for that of the
gallery, clearance-crank-motion.toml for that of the tutorial (docs/src/examples/clearance-crank.toml).

    python3 -m venv venv && venv/bin/pip install numpy scipy
    venv/bin/python reference/slider_crank_motion.py > reference/slider-crank-motion.toml
    venv/bin/python reference/slider_crank_motion.py clearance > reference/clearance-crank-motion.toml

The engine coasts: no gas force, no torque on the crank. One coordinate, the crank angle phi; sin(beta) = r sin(phi)/l.
Newton's and Euler's equations of crank, rod and piston are linear in phi'', the forces A on the rod at the crank pin and B on
the piston at the wrist pin. Moments about the wrist pin give, with friction at the pressed faces y = -sign(N) h/2 and
sliding direction s,

    N_front - N_rear = (h mu s/L) (N_front + N_rear),

so both normal forces have the sign of their sum N while h mu < L (0.133 here): the piston lies flat, and its friction is
mu |N| s. The sign of N is the one that agrees with itself. Integrated with DOP853 (relative tolerance 1e-13) from event to event: N = 0 and the
dead centres, where s changes.
"""
import math
import sys

import numpy as np
from scipy.integrate import solve_ivp

g = 9.81
if sys.argv[1:] == ["clearance"]:
    # docs/src/examples/clearance-crank.toml; e is the distance of the crank's centre of mass, i_crank is about its bearing
    r, l, skirt, bore, mu, e = 0.153, 0.306, 0.1, 0.05, 0.01, 0.0765
    m_crank, m_rod, m_piston = 0.038, 0.038, 0.076
    i_crank, i_rod = 7.4e-5 + m_crank * e**2, 5.9e-4
    PHI, OMEGA, TIMES = 0.0, 150.0, [0.01, 0.02, 0.05, 0.1, 0.2, 0.5]
    WHAT = "the slider-crank of the tutorial"
else:
    # models/slider-crank.toml
    r, l, skirt, bore, mu, e = 0.05, 0.18, 0.06, 0.08, 0.1, 0.0
    m_crank, m_rod, m_piston = 2.0, 0.6, 0.8
    i_crank, i_rod = m_crank * (1.5 * r) ** 2 / 2, m_rod * l**2 / 12
    PHI, OMEGA, TIMES = math.radians(60), 100.0, [0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]
    WHAT = "the gallery's slider-crank with gas = 0, T = 0"
END = TIMES[-1]
assert bore * mu < skirt


def kinematics(phi, omega):
    """Accelerations of B (x) and of the rod's middle and angle as [coefficient of phi'', rest]; velocity of B."""
    beta = math.asin(r * math.sin(phi) / l)  # the rod's angle is -beta
    beta_1 = r * math.cos(phi) / (l * math.cos(beta))  # d beta/d phi
    # l cos(beta) beta'' = r cos(phi) phi'' - r sin(phi) phi'^2 + l sin(beta) beta'^2
    db = np.array([beta_1, (-r * math.sin(phi) * omega**2 + l * math.sin(beta) * (beta_1 * omega) ** 2) / (l * math.cos(beta))])
    ax = np.array([-r * math.sin(phi), -r * math.cos(phi) * omega**2])
    ay = np.array([r * math.cos(phi), -r * math.sin(phi) * omega**2])
    # B = A + l (cos(beta), -sin(beta)); the middle of the rod lies half way
    lx = -l * math.sin(beta) * db + np.array([0, -l * math.cos(beta) * (beta_1 * omega) ** 2])
    xb = ax + lx
    velocity = (-r * math.sin(phi) - l * math.sin(beta) * beta_1) * omega
    return beta, xb, (ax + lx / 2, ay / 2), -db, velocity


def forces(phi, omega, s, sign):
    """phi'' and the sum N of the piston's normal forces, if N has this sign."""
    beta, xb, (sx, sy), alpha, _ = kinematics(phi, omega)
    cb, sb, cp, sp = math.cos(beta), math.sin(beta), math.cos(phi), math.sin(phi)
    # unknowns phi'', A_x, A_y (on the rod at the crank pin), B_x, B_y (on the piston), N
    rows = [
        ([m_piston * xb[0], 0, 0, -1, 0, mu * sign * s], -m_piston * xb[1]),
        ([0, 0, 0, 0, 1, 1], m_piston * g),
        ([m_rod * sx[0], -1, 0, 1, 0, 0], -m_rod * sx[1]),
        ([m_rod * sy[0], 0, -1, 0, 1, 0], -m_rod * sy[1] - m_rod * g),
        # moments about the middle of the rod: A at (-cb, sb) l/2, -B at (cb, -sb) l/2
        ([i_rod * alpha[0], l / 2 * sb, l / 2 * cb, l / 2 * sb, l / 2 * cb, 0], -i_rod * alpha[1]),
        ([i_crank, -r * sp, r * cp, 0, 0, 0], -m_crank * g * e * cp),
    ]
    solution = np.linalg.solve(np.array([row for row, _ in rows]), np.array([right for _, right in rows]))
    return solution[0], solution[5]


def energy(phi, omega):
    beta, _, _, _, velocity = kinematics(phi, omega)
    beta_1 = r * math.cos(phi) / (l * math.cos(beta))
    vx = (-r * math.sin(phi) * omega + velocity) / 2
    vy = r * math.cos(phi) * omega / 2
    kinetic = (i_crank * omega**2 + m_piston * velocity**2 + m_rod * (vx**2 + vy**2) + i_rod * (beta_1 * omega) ** 2) / 2
    return kinetic + (m_rod * r / 2 + m_crank * e) * g * math.sin(phi)


def run(times):
    t, state, out, events = 0.0, np.array([PHI, OMEGA]), [], []
    s = math.copysign(1.0, kinematics(*state)[4])
    sign = next(q for q in (1.0, -1.0) if q * forces(*state, s, q)[1] > 0)
    while t < END:
        reversal = lambda _, y: kinematics(*y)[4]
        change = lambda _, y: forces(*y, s, sign)[1]
        reversal.terminal, change.terminal = True, True
        reversal.direction, change.direction = -s, -sign
        done = solve_ivp(lambda _, y: [y[1], forces(*y, s, sign)[0]], (t, END), state, method="DOP853", rtol=1e-13,
                         atol=1e-13, events=(reversal, change), dense_output=True)
        out += [(q, *done.sol(q)) for q in times if t < q <= done.t[-1]]
        t, state = done.t[-1], done.y[:, -1]
        if done.status == 1:
            if len(done.t_events[0]):
                events.append((t, "reverses"))
                s = -s
            else:
                events.append((t, "changes side"))
                sign = -sign
            # N stays continuous through a change of side; at a reversal its sign is found anew.
            acceptable = [q for q in (sign, -sign) if q * forces(*state, s, q)[1] > -1e-9]
            assert acceptable, (t, state)
            if len(done.t_events[0]):
                sign = acceptable[0]
    return out, events


if __name__ == "__main__":
    samples, events = run(TIMES)
    print(f"# Written by slider_crank_motion.py, which says how: {WHAT}.")
    print("# Agreement of runs with relative tolerances 1e-13 and 1e-11 is the accuracy to be expected.")
    print(f"turns = {samples[-1][1] / (2 * math.pi):.3f}")
    print(f"reversals = {sum(word == 'reverses' for _, word in events)}")
    print(f"side_changes = {sum(word == 'changes side' for _, word in events)}")
    print("first_events = [" + ", ".join(f'[{t:.12f}, "{word}"]' for t, word in events[:6]) + "]")
    for t, phi, omega in samples:
        print(f"\n[[sample]]\ntime = {t}\nphi = {phi:.12f}\nomega = {omega:.12f}\nenergy = {energy(phi, omega):.12f}")
