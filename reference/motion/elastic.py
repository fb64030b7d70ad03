"""A block on an inclined guide of a cart, with springs and dampers across both guides: writes elastic.json.

    python elastic.py

A cart of `families.py` without heights. At 0.735 s the cart stops while the block rests on it, and with rigid guides two phases can follow: both joints stick, or the
cart goes on in the other direction at once. On elastic guides the normal forces are known from the state,

    N_k = -K g_k - C g_k',        C = d sqrt(K m),

and so is what friction can hold, mu_static (|N_front| + |N_rear|): there is nothing to choose. Friction along the guides is Coulomb's without
smoothing. Radau's method of order 5, from event to event.
"""

import itertools
import json
import math
import random
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

from families import Cart, rounded
from simulator import Simulator

HERE = Path(__file__).parent
MEMBER = 33
UNTIL = 1.0
RTOL = 1e-9


class Elastic(Simulator):
    def __init__(self, mechanism, stiffness, damping):
        super().__init__(mechanism)
        self.k = stiffness
        self.c = damping * math.sqrt(stiffness * min(body.mass for body in mechanism.bodies))

    def normal_forces(self, q, v):
        """Of every slider (N_front, N_rear)."""
        found = []
        for slider in self.m.sliders:
            u, n, ends, turning = self.slider_frame(q, v, slider)
            along = np.array([math.cos(slider.angle), math.sin(slider.angle)])
            across = np.array([-along[1], along[0]])
            line = across @ self.local(slider.guide, slider.at)
            found.append([-self.k * (n @ r - line) - self.c * (n @ rate - turning * (u @ r)) for _, r, rate in ends])
        return np.array(found)

    def response(self, t, q, v, signs):
        """Accelerations, sliding accelerations, and the friction that holds each slider whose sign is 0."""
        group = self.groups[0]
        rows, _ = self.rows(q, v, group)
        masses = self.masses(group)
        load = self.applied(t, q, v).ravel()
        normal = self.normal_forces(q, v)
        for j, slider in enumerate(self.m.sliders):
            for (gap, _, centre, _, _), force in zip(rows[j], normal[j]):
                load = load + force * gap - signs[j] * slider.mu * abs(force) * centre
        held = [j for j, s in enumerate(signs) if s == 0]
        a, holding = load / masses, dict.fromkeys(range(len(signs)), 0.0)
        if held:
            w = np.array([rows[j][0][2] for j in held])
            bias = np.array([rows[j][0][3] for j in held])
            forces = np.linalg.solve((w / masses) @ w.T, w @ a - bias)
            a = a - (w.T @ forces) / masses
            holding.update(zip(held, forces))
        slides = [rows[j][0][2] @ a - rows[j][0][3] for j in range(len(signs))]
        return a, slides, holding, normal

    def pressed(self, q, v):
        """Places in which the guides have the normal forces of rigid ones, all joints sliding as they do."""
        signs = np.sign(self.sliding(q, v)[1])
        group = self.groups[0]
        rows, force = self.rows(q, v, group), self.applied(0.0, q, v).ravel()
        for sides in itertools.product((1, -1), repeat=2 * len(signs)):
            state = {j: (int(s), *sides[2 * j : 2 * j + 2]) for j, s in enumerate(signs)}
            _, found = self.solve(rows, force, self.masses(group), state)
            if all(side * force > 0 for j in state for side, force in zip(state[j][1:], found[j][:2])):
                break
        gaps = np.array([row for j in state for row in (rows[0][j][0][0], rows[0][j][1][0])])
        wanted = np.array([-force / self.k for j in state for force in found[j][:2]])
        return q + np.linalg.lstsq(gaps, wanted)[0].reshape(-1, 3)

    def room_left(self, normal, holding, j):
        return self.m.sliders[j].mu_static * np.abs(normal[j]).sum() - abs(holding[j])

    def following(self, t, q, v, signs, rest):
        """What agrees with itself, with the most joints that stick."""
        found = []
        for choice in itertools.product(*[(0, 1, -1) if j in rest else (signs[j],) for j in range(len(signs))]):
            _, slides, holding, normal = self.response(t, q, v, choice)
            if all(self.room_left(normal, holding, j) > 0 if choice[j] == 0 else choice[j] * slides[j] > 0 for j in rest):
                found.append(choice)
        most = max(choice.count(0) for choice in found)
        best = [choice for choice in found if choice.count(0) == most]
        assert len(best) == 1, (t, found)
        return best[0], len(found)

    def follow(self, q, v, until):
        """Changes of every slider, place and rate at the end, and how often several choices agreed with themselves."""
        t, y = 0.0, np.array([q, v]).ravel()
        signs = tuple(int(np.sign(x)) if abs(x) > 1e-12 else 0 for x in self.sliding(q, v)[1])
        signs, several = self.following(t, q, v, signs, [j for j, s in enumerate(signs) if s == 0])
        several, log = several - 1, [[[0.0, s]] for s in signs]
        while t < until:
            events = []
            for j, s in enumerate(signs):

                def event(t, y, j=j, s=s, signs=signs):
                    q, v = y.reshape(2, self.n, 3)
                    if s:
                        return s * self.sliding(q, v)[1][j]
                    _, _, holding, normal = self.response(t, q, v, signs)
                    return self.room_left(normal, holding, j)

                event.terminal, event.direction = True, -1
                events.append(event)

            def rates(t, y, signs=signs):
                q, v = y.reshape(2, self.n, 3)
                return np.concatenate([v.ravel(), self.response(t, q, v, signs)[0]])

            scale = self.m.force_scale / self.k
            place = [1e-3 * scale] * (3 * self.n)
            rate = [1e-3 * scale * math.sqrt(self.k)] * (3 * self.n)
            done = solve_ivp(
                rates, (t, until), y, method="Radau", rtol=RTOL, atol=RTOL * 1e3 * np.array(place + rate), events=events, max_step=0.01
            )
            assert done.status >= 0, done.message
            t, y = done.t[-1], done.y[:, -1]
            if done.status == 0:
                break
            happened = [j for j, times in enumerate(done.t_events) if len(times)]
            q, v = y.reshape(2, self.n, 3)
            rest = [j for j, s in enumerate(signs) if s == 0 or j in happened]
            v = self.stopped(q, v, rest)
            y = np.array([q, v]).ravel()
            slipping = [j for j in happened if signs[j] == 0]
            before, signs = signs, tuple(0 if j in rest else s for j, s in enumerate(signs))
            if slipping:
                # at its limit: it slides where the friction that held it does not reach
                _, _, holding, _ = self.response(t, q, v, before)
                signs = tuple(int(np.sign(holding[j])) if j in slipping else s for j, s in enumerate(signs))
                rest = [j for j in rest if j not in slipping]
            signs, count = self.following(t, q, v, signs, rest)
            several += count - 1
            for j, s in enumerate(signs):
                if s != log[j][-1][1]:
                    log[j].append([t, s])
        q, v = y.reshape(2, self.n, 3)
        places, speeds = self.sliding(q, v)
        return log, places, speeds, several

    def stopped(self, q, v, rest):
        """Velocities with joints at rest, the nearest in the norm of the masses."""
        if not rest:
            return v
        rows, _ = self.rows(q, v, self.groups[0])
        w, inverse = np.array([rows[j][0][2] for j in rest]), 1 / self.masses(self.groups[0])
        # sliding velocity = centre row times velocities
        x = v.ravel()
        return (x - inverse * (w.T @ np.linalg.solve((w * inverse) @ w.T, w @ x))).reshape(-1, 3)


def main():
    parameters = rounded(Cart(1).numbers(random.Random(f"cart-1 {MEMBER}"))) | {"h": 0.0, "h_a": 0.0}
    mechanism = Cart(1).mechanism(parameters)
    q = np.array([[*body.place, 0.0] for body in mechanism.bodies])
    v = np.array(Cart(1).rates(parameters), dtype=float)
    runs = []
    for damping, stiffness in itertools.product((1.0, 6.0), (1e5, 3e5, 1e6)):
        elastic = Elastic(mechanism, stiffness, damping)
        log, places, speeds, several = elastic.follow(elastic.pressed(q, v), v, UNTIL)
        run = {"damping": damping, "stiffness": stiffness, "several": several, "joints": [[[float(t), s] for t, s in entries] for entries in log]}
        runs.append(run | {"last": [[float(x), float(rate)] for x, rate in zip(places, speeds)]})
        print(json.dumps(runs[-1]), flush=True)
    lines = ",\n".join(json.dumps(run) for run in runs)
    head = json.dumps({"model": "cart-1", "until": UNTIL, "parameters": parameters})[:-1]
    (HERE / "elastic.json").write_text(f'{head}, "runs": [\n{lines}\n]}}\n')


if __name__ == "__main__":
    main()
