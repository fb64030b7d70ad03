#!/usr/bin/env python3
"""A cart on a rough rail and a body on a rough pin of it, integrated apart from slideway: writes break-away.toml.

    python3 reference/break_away.py > reference/break-away.toml       (standard library, half a minute)

Cart M at (x, 0) on a level rail, body (m, I about its centre) on a pin at the cart's centre, its centre at d from the pin,
turned by theta from the drawing. The pin's force R and couple C = -r |R| sgn(omega) act on the body, their opposites on the
cart; F pushes the cart, T turns the body against the cart:

    m (x'' , 0) + m (theta'' rot90(d) - omega^2 d) = R - m g e_y         I theta'' = -d x R + C + T
    M x'' = -R_x + F - mu N s                                            N = M g + R_y

At rest friction takes what it needs: |R_x - F| <= mu_s N, |C| <= r |R|. Each state is integrated by Runge-Kutta's method of order
4 in steps of 20 us, |R| by fixed points; events are found by bisection of the step, and decided by trying rest first.
"""
import math

G = 9.81
STEP = 2e-5


class Run:
    def __init__(self, name, d, inertia, r, mus, omega, end, force=0.0, torque=0.0, masses=(1.0, 1.0)):
        self.name, self.d, self.inertia, self.r, self.end = name, d, inertia, r, end
        (self.mu, self.mu_static), (self.force, self.torque) = mus, (force, torque)
        self.cart, self.body = masses
        self.start = [0.0, 0.0, 0.0, omega]

    def solve(self, t, state, mode):
        """x'', theta'', R, the rail's friction, N and the pin's couple in a mode (signs of sliding and turning, 0 at rest)."""
        slides, turns = mode
        _, theta, _, omega = state
        c, s = math.cos(theta), math.sin(theta)
        dx, dy = c * self.d[0] - s * self.d[1], s * self.d[0] + c * self.d[1]
        force, torque, m = self.force * t, self.torque * t, self.body
        size, normal = m * G, (self.cart + m) * G
        for _ in range(200):
            couple, friction = -self.r * size * turns, -self.mu * normal * slides
            # R = m (x'' - theta'' dy - omega^2 dx, theta'' dx - omega^2 dy + g) in the two equations for x'' and theta''
            # M x'' + R_x = force + friction,   I theta'' + dx R_y - dy R_x = couple + torque
            a11, a12, b1 = self.cart + m, -m * dy, force + friction + m * omega**2 * dx
            a21, a22 = -m * dy, self.inertia + m * (dx * dx + dy * dy)
            b2 = couple + torque - m * G * dx
            if not slides and not turns:
                a, alpha = 0.0, 0.0
            elif not slides:
                a, alpha = 0.0, b2 / a22
            elif not turns:
                a, alpha = b1 / a11, 0.0
            else:
                det = a11 * a22 - a12 * a21
                a, alpha = (b1 * a22 - a12 * b2) / det, (a11 * b2 - a21 * b1) / det
            rx = m * (a - alpha * dy - omega**2 * dx)
            ry = m * (alpha * dx - omega**2 * dy + G)
            before = (size, normal)
            size, normal = math.hypot(rx, ry), self.cart * G + ry
            if abs(size - before[0]) + abs(normal - before[1]) < 1e-14 * (size + normal):
                break
        if not slides:
            friction = self.cart * a + rx - force
        if not turns:
            couple = self.inertia * alpha + dx * ry - dy * rx - torque
        return a, alpha, size, friction, normal, couple

    def room(self, t, state, mode):
        """What must not be negative: how far each is from its bound."""
        _, _, size, friction, normal, couple = self.solve(t, state, mode)
        rail = mode[0] * state[2] if mode[0] else self.mu_static * normal - abs(friction)
        pin = mode[1] * state[3] if mode[1] else self.r * size - abs(couple)
        return rail, pin

    def step(self, t, state, mode, h):
        def rate(t, y):
            a, alpha, *_ = self.solve(t, y, mode)
            return [y[2], y[3], a, alpha]

        def moved(y, k, h):
            return [u + h * v for u, v in zip(y, k)]

        k1 = rate(t, state)
        k2 = rate(t + h / 2, moved(state, k1, h / 2))
        k3 = rate(t + h / 2, moved(state, k2, h / 2))
        k4 = rate(t + h, moved(state, k3, h))
        return [y + h / 6 * (a + 2 * b + 2 * c + d) for y, a, b, c, d in zip(state, k1, k2, k3, k4)]

    def after(self, t, state, mode, which):
        """The mode after the bound of one of the two was reached."""
        mode = list(mode)
        if mode[which]:
            state[2 + which] = 0.0
            mode[which] = 0
            if self.room(t, state, mode)[which] >= 0:
                return mode, "sticks"
        else:
            mode[which] = 0
        solved = self.solve(t, state, mode)
        mode[which] = -1 if solved[3 if which == 0 else 5] > 0 else 1
        return mode, "right" if mode[which] > 0 else "left"

    def run(self):
        t, state, events = 0.0, list(self.start), []
        mode = [0, (state[3] > 0) - (state[3] < 0)]
        if not mode[1] and self.room(t, state, mode)[1] < 0:
            mode = self.after(t, state, mode, 1)[0]
        just = None
        while t < self.end:
            h = min(STEP, self.end - t)
            new = self.step(t, state, mode, h)
            room = self.room(t + h, new, mode)
            low, high = 0.0, h
            # Just after something has begun to move its velocity is rounding.
            if min(room) >= 0 or (just is not None and abs(room[just]) < 1e-13):
                t, state, just = t + h, new, None
                continue
            while high - low > 1e-14:
                middle = (low + high) / 2
                room = self.room(t + middle, self.step(t, state, mode, middle), mode)
                low, high = (middle, high) if min(room) >= 0 else (low, middle)
            state = self.step(t, state, mode, high)
            t += high
            room = self.room(t, state, mode)
            just = 0 if room[0] < room[1] else 1
            mode, what = self.after(t, state, mode, just)
            events.append((t, ("rail", "pin")[just], what))
        return events, state


RUNS = [
    Run("falls", (0.5, 0.0), 0.0, 1e-3, (0.3, 0.3), -0.01, 0.5),
    Run("falls, static friction 1.1 times the kinetic", (0.5, 0.0), 0.0, 1e-3, (0.3, 0.33), -0.01, 0.5),
    Run("pushed", (0.03, -0.5), 0.02, 0.05, (0.3, 0.3), 0.0, 1.5, force=6.0),
    Run("turned", (0.03, -0.5), 0.02, 0.05, (0.3, 0.3), 0.0, 1.5, torque=2.0),
]

print("# Written by break_away.py, which says how.")
for run in RUNS:
    events, state = run.run()
    print(f"\n[[run]]\nname = \"{run.name}\"")
    print("events = [" + ", ".join(f'[{t:.12f}, "{what}", "{does}"]' for t, what, does in events) + "]")
    print(f"end = [{run.end}, " + ", ".join(f"{value:.12f}" for value in state) + "]")
