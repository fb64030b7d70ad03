#!/usr/bin/env python3
"""Klepp's bar between spring and damper on guides that are springs: writes elastic-guides.toml.

    python3 -m venv venv && venv/bin/pip install numpy scipy
    venv/bin/python reference/elastic_guides.py > reference/elastic-guides.toml

Written without slideway: Newton's and Euler's equations of the bar about its mass centre. Each of the three contacts is a spring
and a damper across the guide, which push and pull,

    N_k = -K g_k - C g_k',     C = sqrt(K m),

with the displacement g_k of the contact across its guide. Across the guides nothing is rigid, so every state has exactly one
answer, whatever the friction: there is no choice between modes of contact. Along the guides the friction is
Coulomb's without smoothing: a joint that slides in the direction s has F_k = -mu_k |N_k| s, one that sticks
F_k = -mu_k |N_k| s with one s between -1 and 1 for all contacts of the joint that keeps it at rest (Filippov's
solution of s = sign of the sliding velocity). Zeros of sliding velocities and of 1 - |s| are events, after which every
combination is tried; exactly one must agree with itself.

Unknowns: x and K y of A, K a of the bar's angle 80 deg + a, K b of the block's angle, and the rates of the first three. The
block has no mass, so b' follows from its balance of moments: with the lever w_k = x_k - mu_k s h/2 of contact k about A

    sum w_k N_k = 0,     N_k = n_k - C x_k b',     n_k = -K (y + x_k b) - C y'.

The tilt b of the block is taken as small. Integrated with Radau's method of order 5 from event to event.
"""
import itertools
import math
import sys

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

# models/klepp-2002-spring.toml
ALPHA, M, G, L, B, H, K_SPRING, DAMPER, FREQUENCY = math.radians(80), 1.0, 9.81, 1.0, 0.2, 0.1, 100.0, 1.0, 5.0
MU_LOWER = (0.1, 0.1)
ENDS = (B / 2, -B / 2)
INERTIA = M * L**2 / 12
SIN, COS = math.sin(ALPHA), math.cos(ALPHA)
WALL = (L / 2 * COS - 2 * L, L / 2 * SIN)
FREE = 2 * L
RTOL = 1e-10


class Guides:
    """The mechanism with one stiffness (N/m), one friction coefficient of the upper slot and one force."""

    def __init__(self, stiffness, mu, force, at_lower_end):
        self.k, self.mu, self.force = stiffness, mu, force
        self.lever = 0.0 if at_lower_end else L / 2
        self.c = math.sqrt(stiffness * M)

    def scales(self):
        """Errors that are permitted of x, K y, K a, K b, x', y', a'."""
        force, rate = M * G, M * G / math.sqrt(self.k * M)
        return RTOL * np.array([1.0, force, force, force, 1.0, rate, rate])

    def start(self, normal, rate=1.0):
        """The state with these normal forces, the bar sliding with this velocity."""
        upper, front, rear = normal
        y, b = -(front + rear) / 2, -(front - rear) / B
        # g_1 = y + l (sin(alpha + a) - sin(alpha))
        a = math.asin(SIN + (-upper - y) / self.k / L) - ALPHA
        return np.array([0.0, y, self.k * a, b, rate, 0.0, 0.0])

    def rigid(self, signs, s=1.0):
        """Normal forces at the start with rigid guides that are pressed to these sides, sliding in the direction s: y'' = a'' = 0."""
        state = self.start((0.0, 0.0, 0.0), s)

        def unbalanced(normal):
            upper, front, rear = normal
            friction = -s * self.mu * signs[0] * upper, -s * sum(m * q * n for m, q, n in zip(MU_LOWER, signs[1:], normal[1:]))
            self_upper, self.upper_force = self.upper_force, lambda _: upper
            _, ay, turn = self.accelerations(0.0, state, *friction, front + rear)
            self.upper_force = self_upper
            return np.array([ay, turn, sum((end - m * s * H / 2) * n for end, m, n in zip(ENDS, MU_LOWER, normal[1:]))])

        base = unbalanced(np.zeros(3))
        return np.linalg.solve(np.array([unbalanced(unit) - base for unit in np.eye(3)]).T, -base)

    def place(self, state):
        x, y, a, b = state[0], state[1] / self.k, state[2] / self.k, state[3] / self.k
        return x, y, a, b, math.sin(ALPHA + a), math.cos(ALPHA + a)

    def velocities(self, state):
        """Sliding velocities of the upper and of the lower joint."""
        _, _, _, _, sin, _ = self.place(state)
        return state[4] - L * sin * state[6], state[4]

    def upper_force(self, state):
        _, y, a, _, _, cos = self.place(state)
        gap = y + L * 2 * math.cos(ALPHA + a / 2) * math.sin(a / 2)
        return -self.k * gap - self.c * (state[5] + L * cos * state[6])

    def lower_forces(self, state, s):
        """Normal forces of the block's ends, and b'."""
        bare = [-state[1] - end * state[3] - self.c * state[5] for end in ENDS]
        levers = [end - mu * s * H / 2 for end, mu in zip(ENDS, MU_LOWER)]
        turning = sum(w * n for w, n in zip(levers, bare)) / (self.c * sum(w * e for w, e in zip(levers, ENDS)))
        return [n - self.c * end * turning for n, end in zip(bare, ENDS)], turning

    def normal(self, state, s):
        return [self.upper_force(state), *self.lower_forces(state, s[1])[0]]

    def accelerations(self, t, state, upper, lower, across):
        """x'', y'', a'' with these frictions of the joints and this sum of the block's normal forces."""
        x, y, _, _, sin, cos = self.place(state)
        turning = state[6]
        to_s = np.array([x + L / 2 * cos - WALL[0], y + L / 2 * sin - WALL[1]])
        velocity = np.array([state[4] - L / 2 * sin * turning, state[5] + L / 2 * cos * turning])
        length = math.hypot(*to_s)
        unit = to_s / length
        tension = K_SPRING * (length - FREE) + DAMPER * unit @ velocity
        push = self.force * math.sin(2 * math.pi * FREQUENCY * t)
        n_1 = self.upper_force(state)
        # accelerations of S; moments about S with B at +l/2 and A at -l/2 along the bar
        sx = (upper + lower + push - tension * unit[0]) / M
        sy = (n_1 + across - M * G - tension * unit[1]) / M
        moment = L / 2 * (cos * n_1 - sin * upper) - L / 2 * (cos * across - sin * lower)
        # the push acts at S (lever l/2 from A) or at A
        moment += (L / 2 - self.lever) * sin * push
        turn = moment / INERTIA
        ax = sx + L / 2 * sin * turn + L / 2 * cos * turning**2
        ay = sy - L / 2 * cos * turn + L / 2 * sin * turning**2
        return np.array([ax, ay, turn])

    def limits(self, state, s_lower):
        """Greatest friction of the upper and of the lower joint."""
        ends, _ = self.lower_forces(state, s_lower)
        return self.mu * abs(self.upper_force(state)), sum(mu * abs(n) for mu, n in zip(MU_LOWER, ends))

    def shares(self, t, state, mode):
        """s of the joints: the direction, or for a joint that sticks what keeps it at rest."""
        if 0 not in mode:
            return [float(s) for s in mode]
        _, _, _, _, sin, cos = self.place(state)
        # The sum of the block's normal forces does not depend on s, as its ends are equally far from A.
        across = sum(self.lower_forces(state, 0.0)[0])
        sliding = [float(s) for s in mode]
        frictions = [-f * s for f, s in zip(self.limits(state, sliding[1]), sliding)]

        def rest(upper, lower):
            ax, _, turn = self.accelerations(t, state, upper, lower, across)
            return np.array([ax - L * sin * turn - L * cos * state[6] ** 2, ax])

        base = rest(*frictions)
        stuck = [i for i in (0, 1) if mode[i] == 0]
        unit = np.array([rest(*(f + (j == i) for j, f in enumerate(frictions))) - base for i in stuck]).T
        held = np.linalg.solve(unit[stuck], -base[stuck])
        for i, force in zip(stuck, held):
            frictions[i] += force
        shares = sliding
        if mode[0] == 0:
            shares[0] = -frictions[0] / self.limits(state, 0.0)[0]
        if mode[1] == 0:
            # F = -s sum mu_k |N_k(s)|; what N_k owes to s is small
            s = 0.0
            for _ in range(60):
                new = -frictions[1] / self.limits(state, s)[1]
                if abs(new - s) < 1e-14:
                    break
                s = new
            shares[1] = new
        return shares

    def rates(self, t, state, mode):
        shares = self.shares(t, state, mode)
        ends, tilting = self.lower_forces(state, shares[1])
        limits = self.mu * abs(self.upper_force(state)), sum(mu * abs(n) for mu, n in zip(MU_LOWER, ends))
        acceleration = self.accelerations(t, state, -limits[0] * shares[0], -limits[1] * shares[1], sum(ends))
        return np.array([state[4], self.k * state[5], self.k * state[6], self.k * tilting, *acceleration])

    def sliding_accelerations(self, t, state, mode):
        ax, _, turn = self.rates(t, state, mode)[4:]
        _, _, _, _, sin, cos = self.place(state)
        return ax - L * sin * turn - L * cos * state[6] ** 2, ax

    def following(self, t, state, mode, stopped):
        """The one mode in which the joints that are at rest, and are not known to leave it, go on."""
        found = []
        for choice in itertools.product(*[(1, -1, 0) if joint in stopped else (mode[joint],) for joint in (0, 1)]):
            shares = self.shares(t, state, choice)
            accelerations = self.sliding_accelerations(t, state, choice)
            if all(abs(shares[j]) <= 1 if choice[j] == 0 else choice[j] * accelerations[j] > 0 for j in stopped):
                found.append(choice)
        assert len(found) == 1, (t, mode, stopped, found)
        return found[0]

    def run(self, state, duration, longest):
        """Pieces of the motion from a sliding start, each a solution with its mode, and the times at which modes begin."""
        mode = tuple(int(math.copysign(1, velocity)) for velocity in self.velocities(state))
        t, pieces, changes = 0.0, [], [(0.0, mode)]
        while t < duration:
            events = []
            for joint in (0, 1):
                if mode[joint] == 0:
                    for bound in (1, -1):
                        leaves = lambda t, y, j=joint, q=bound: 1 - q * self.shares(t, y, mode)[j]
                        leaves.terminal, leaves.direction, leaves.joint, leaves.towards = True, -1, joint, bound
                        events.append(leaves)
                else:
                    stops = lambda _, y, j=joint: self.velocities(y)[j]
                    stops.terminal, stops.direction, stops.joint = True, -mode[joint], joint
                    events.append(stops)
            done = solve_ivp(lambda t, y: self.rates(t, y, mode), (t, duration), state, method="Radau", rtol=RTOL,
                             atol=self.scales(), events=events, dense_output=True, first_step=1e-6 / math.sqrt(self.k), max_step=longest)
            assert done.status >= 0, done.message
            pieces.append((t, done.t[-1], done.sol, mode))
            t, state = done.t[-1], done.y[:, -1]
            if done.status == 1:
                happened = [event for event, times in zip(events, done.t_events) if len(times)]
                leaving = {event.joint: event.towards for event in happened if mode[event.joint] == 0}
                at_rest = [j for j in (0, 1) if mode[j] == 0 or any(event.joint == j for event in happened)]
                state = self.settled(state, at_rest)
                mode = tuple(leaving.get(j, mode[j]) for j in (0, 1))
                mode = self.following(t, state, mode, set(at_rest) - set(leaving))
                changes.append((t, mode))
        return pieces, changes

    def settled(self, state, stopped):
        """The state with sliding velocities of exactly zero where joints have stopped."""
        state = state.copy()
        _, _, _, _, sin, _ = self.place(state)
        if stopped == [0, 1]:
            state[4] = state[6] = 0.0
        elif stopped == [1]:
            state[4] = 0.0
        elif stopped == [0]:
            state[6] = state[4] / (L * sin)
        return state

    def at(self, pieces, time):
        for begin, end, solution, mode in pieces:
            if begin <= time <= end:
                state = solution(time)
                return state, self.normal(state, self.shares(time, state, mode))
        raise ValueError(time)


def zeros_of_normal_forces(guides, pieces):
    """Where the sliding bar's contacts change side, as (time, contact)."""
    found = []
    for begin, end, solution, mode in pieces:
        normal = lambda t: guides.normal(solution(t), guides.shares(t, solution(t), mode))
        times = np.linspace(begin, end, 400)
        values = np.array([normal(t) for t in times])
        for contact in range(3):
            for i in np.nonzero(values[:-1, contact] * values[1:, contact] < 0)[0]:
                found.append((brentq(lambda t: normal(t)[contact], times[i], times[i + 1], xtol=1e-14), contact))
    return sorted(found)


def write(name, guides, start, until, times, zeros=False):
    """One motion as an entry of the file: changes of the lower joint, samples, and changes of side if they are wanted."""
    # Between its steps the solution is of order 3 only.
    pieces, changes = guides.run(start, until, 2e-4 if zeros else math.inf)
    lower = [(t, mode[1]) for t, mode in changes]
    lower = [change for i, change in enumerate(lower) if i == 0 or change[1] != lower[i - 1][1]]
    print(f'\n[[run]]\nscenario = "{name}"\nstiffness = {guides.k:.0e}')
    print("lower = [" + ", ".join(f"[{t:.12f}, {s}]" for t, s in lower) + "]")
    if zeros:
        print("zeros = [" + ", ".join(f"[{t:.12f}, {k}]" for t, k in zeros_of_normal_forces(guides, pieces)) + "]")
    for t in times:
        state, normal = guides.at(pieces, t)
        numbers = ", ".join(f"{n:.9f}" for n in normal)
        print(f"[[run.sample]]\ntime = {t}\nx = {state[0]:.12f}\nrate = {state[4]:.10f}\nnormal = [{numbers}]")
    sys.stdout.flush()


def scenarios(k):
    """All motions with this stiffness of the guides."""
    onward = (1, 1, 1)
    guides = Guides(k, 0.2, 40.0, False)
    write("to and fro", guides, guides.start(guides.rigid(onward)), 0.6, (0.05, 0.1, 0.14, 0.2, 0.3, 0.4, 0.5, 0.56))
    guides = Guides(k, 0.2, 20.0, True)
    write("force below", guides, guides.start(guides.rigid(onward)), 0.12, (0.02, 0.05, 0.09, 0.1, 0.11, 0.115), zeros=True)
    guides = Guides(k, 0.2, 1.8, False)
    write("stick and slip", guides, guides.start(guides.rigid(onward), 0.03), 0.5, (0.02, 0.1, 0.2, 0.3, 0.4, 0.5))
    guides = Guides(k, 0.5, 40.0, False)
    attainable, threshold = guides.rigid(onward), guides.rigid((-1, 1, 1))
    write("several solutions", guides, guides.start(attainable), 0.4, (0.05, 0.1, 0.14, 0.18, 0.25, 0.3, 0.4))
    write("sent to the left", guides, guides.start(attainable, -1.0), 0.05, (0.05,))
    guides = Guides(k, 0.5, 0.0, False)
    for name, part in (("beside the threshold, inside", 0.2), ("beside the threshold, outside", -0.2)):
        write(name, guides, guides.start(threshold + part * (attainable - threshold)), 0.05, (0.03, 0.05))
    guides = Guides(k, 0.35, 40.0, False)
    write("wedge or slide", guides, guides.start(guides.rigid(onward)), 0.3, (0.1, 0.2, 0.25, 0.3))


if __name__ == "__main__":
    print("# Written by elastic_guides.py, which says how. SI units; `lower` and `zeros` are [time, direction] and [time, contact].")
    for stiffness in (1e5, 1e6, 1e7, 1e8):
        scenarios(stiffness)
