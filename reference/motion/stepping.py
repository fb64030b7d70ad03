"""Random bodies that fall, strike, slide, stick and tip on faces: slideway against a time-stepping simulator of its own.

    python stepping.py PROGRAM [NUMBER] [FIRST]

Each system is one or two rigid bodies, hinged to one another or not, with friction in that hinge or without, with corners that may touch
a floor and a wall, at random places and velocities. The simulator knows nothing of events: Moreau's midpoint rule (Moreau 1988; Jean 1999) in the coordinates x, y
and angle of every body, hinges as constraints. In each step every touching corner is open, sticks or slides, and every hinge with friction sticks or turns, with a couple
of its radius times the magnitude of its force; the state is the one of the previous step if it still holds, else all are tried. It converges with the first order to the motion by Moreau's law: an impact
comes up to a step too late, which costs up to a step's way, in either direction. So the same system is run with steps of h and h/2.
Places at the end must agree within WAYS of the ways h v with the greatest velocity v of a body, and over all systems the differences from
slideway must fall with h. Where both steps themselves are farther apart than a hundredth of a metre, the motion hangs on the order of its
impacts, and nothing is compared.
"""

from __future__ import annotations

import itertools
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

GRAVITY = 9.81
DURATION = 0.5
STEPS = (10_000, 20_000)
WAYS = 30
# Faces: a point, the direction in which they hold, and the name of their points in the model.
FACES = {"floor": (np.array([0.0, 0.0]), np.array([0.0, 1.0])), "wall": (np.array([-1.0, 0.0]), np.array([1.0, 0.0]))}


def turned(angle: float, vector: np.ndarray) -> np.ndarray:
    cos, sin = math.cos(angle), math.sin(angle)
    return np.array([cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1]])


class System:
    """Bodies (mass, inertia), corners (body, place, face, mu, restitution) and hinges (body, place, body, place, friction radius)."""

    def __init__(self, bodies, corners, hinges, places, rates):
        self.bodies, self.corners, self.hinges = bodies, corners, hinges
        self.places, self.rates = np.array(places, float), np.array(rates, float)
        self.inverse = np.array([1.0 / value for mass, inertia in bodies for value in (mass, mass, inertia)])
        self.gravity = np.array([value for _ in bodies for value in (0.0, -GRAVITY, 0.0)])

    def row(self, places, body, local, direction):
        arm = turned(places[3 * body + 2], local)
        row = np.zeros(len(places))
        row[3 * body : 3 * body + 2] = direction
        row[3 * body + 2] = arm[0] * direction[1] - arm[1] * direction[0]
        return row

    def gap(self, places, corner):
        body, local, face, _, _ = corner
        origin, normal = FACES[face]
        return normal @ (places[3 * body : 3 * body + 2] + turned(places[3 * body + 2], local) - origin)

    def hinge_rows(self, places):
        axes = (np.array([1.0, 0.0]), np.array([0.0, 1.0]))
        rows = [
            self.row(places, one, at, axis) - self.row(places, other, there, axis)
            for one, at, other, there, _ in self.hinges
            for axis in axes
        ]
        return np.array(rows).reshape(-1, len(places))

    def apart(self, places):
        def end(body, local):
            return places[3 * body : 3 * body + 2] + turned(places[3 * body + 2], local)

        return np.array([end(a, at) - end(b, there) for a, at, b, there, _ in self.hinges]).reshape(-1)

    def turn_row(self, hinge):
        """The rate of the first body of a hinge against the second."""
        row = np.zeros(len(self.places))
        row[3 * hinge[0] + 2], row[3 * hinge[2] + 2] = 1.0, -1.0
        return row

    def run(self, steps: int):
        """The places and rates at the end."""
        length = DURATION / steps
        places, rates, before = self.places.copy(), self.rates.copy(), {}
        self.fastest = 0.0
        for _ in range(steps):
            self.fastest = max(self.fastest, abs(rates).max())
            middle = places + length / 2 * rates
            touching = [k for k, corner in enumerate(self.corners) if self.gap(middle, corner) <= 0.0]
            rates, before = self.velocities(middle, rates, touching, before, length)
            places = middle + length / 2 * rates
            if self.hinges:
                rows = self.hinge_rows(places)
                weights = rows * self.inverse
                places = places - weights.T @ np.linalg.solve(weights @ rows.T, self.apart(places))
        return places, rates

    def velocities(self, places, rates, touching, before, length):
        """The velocities after a step, and the state of each corner that touches in it."""
        free = rates + length * self.gravity
        hinges = self.hinge_rows(places)
        rows = []
        for k in touching:
            body, local, face, _, _ = self.corners[k]
            normal = FACES[face][1]
            rows.append((self.row(places, body, local, normal), self.row(places, body, local, np.array([normal[1], -normal[0]]))))
        rough = [number for number, hinge in enumerate(self.hinges) if hinge[4] > 0.0]
        names = [*touching, *(("hinge", number) for number in rough)]
        guess = tuple(before.get(name, "open" if name in touching else "stick") for name in names)
        choices = [("open", "stick", "left", "right")] * len(touching) + [("stick", "left", "right")] * len(rough)
        for state in itertools.chain([guess], itertools.product(*choices)):
            corners = [(self.corners[k], *row) for k, row in zip(touching, rows)]
            turning = dict(zip(rough, state[len(touching) :]))
            found = self.with_directions((rates, free), (hinges, turning), corners, state[: len(touching)])
            if found is not None:
                return found, dict(zip(names, state))
        raise ArithmeticError("no state")

    def with_directions(self, velocities, hinges, touching, state):
        """The velocities of a state: the directions of the forces of hinges that turn are those of the solution."""
        rows, turning = hinges
        directions = {number: np.zeros(2) for number, does in turning.items() if does != "stick"}
        for _ in range(50):
            found = self.attempt(velocities, (rows, turning, directions), touching, state)
            if found is None:
                return None
            after, forces = found
            new = {number: forces[2 * number : 2 * number + 2] for number in directions}
            new = {number: force / max(np.linalg.norm(force), 1e-300) for number, force in new.items()}
            if all(abs(new[number] - directions[number]).max() < 1e-12 for number in new):
                return after if self.is_allowed(velocities, (rows, turning), touching, (state, after, forces)) else None
            directions = new
        return None

    def attempt(self, velocities, hinges, touching, state):
        """The velocities and impulses with these equations; nothing if they are singular."""
        rates, free = velocities
        rows, turning, directions = hinges
        equations, forces, wanted = [*rows], [*rows], [0.0] * len(rows)
        for number, direction in directions.items():
            lever = self.hinges[number][4] * (1.0 if turning[number] == "left" else -1.0)
            for axis in range(2):
                forces[2 * number + axis] = rows[2 * number + axis] + lever * direction[axis] * self.turn_row(self.hinges[number])
        for (corner, normal, tangent), does in zip(touching, state):
            if does == "open":
                continue
            equations.append(normal)
            wanted.append(-corner[4] * min(normal @ rates, 0.0))
            if does == "stick":
                forces += [normal, tangent]
                equations.append(tangent)
                wanted.append(0.0)
            else:
                forces.append(normal + (corner[3] if does == "left" else -corner[3]) * tangent)
        for number in (number for number, does in turning.items() if does == "stick"):
            equations.append(self.turn_row(self.hinges[number]))
            forces.append(equations[-1])
            wanted.append(0.0)
        if not equations:
            return free, np.zeros(0)
        left, columns = np.array(equations), np.array(forces)
        matrix = (left * self.inverse) @ columns.T
        if np.linalg.cond(matrix) > 1e12:
            return None
        impulses = np.linalg.solve(matrix, np.array(wanted) - left @ free)
        return free + self.inverse * (columns.T @ impulses), impulses

    def is_allowed(self, velocities, hinges, touching, found):
        """Whether no law is contradicted."""
        rates, (rows, turning), (state, after, impulses) = velocities[0], hinges, found
        place, little = len(rows), 1e-10
        for (corner, normal, tangent), does in zip(touching, state):
            if does == "open":
                if normal @ after < -corner[4] * min(normal @ rates, 0.0) - little:
                    return False
                continue
            if impulses[place] < -little:
                return False
            if does == "stick":
                if abs(impulses[place + 1]) > corner[3] * impulses[place] + little:
                    return False
                place += 2
            else:
                if tangent @ after * (-1.0 if does == "left" else 1.0) < -little:
                    return False
                place += 1
        for number, does in turning.items():
            if does == "stick":
                if abs(impulses[place]) > self.hinges[number][4] * np.linalg.norm(impulses[2 * number : 2 * number + 2]) + little:
                    return False
                place += 1
            elif self.turn_row(self.hinges[number]) @ after * (-1.0 if does == "left" else 1.0) < -little:
                return False
        return True

    def model(self) -> str:
        """The same system as a model of slideway."""
        text = f'gravity = {GRAVITY}\n[points]\nfloor_a = [-50, 0]\nfloor_b = [50, 0]\nwall_a = [-1, 50]\nwall_b = [-1, -50]\n'
        ends = {"floor": '["floor_a", "floor_b"]', "wall": '["wall_a", "wall_b"]'}
        for body in range(len(self.bodies)):
            text += "C{} = [{!r}, {!r}]\n".format(body, *map(float, self.places[3 * body : 3 * body + 2]))
        point = lambda body, local: self.places[3 * body : 3 * body + 2] + turned(self.places[3 * body + 2], local)
        for k, (body, local, *_) in enumerate(self.corners):
            text += "P{} = [{!r}, {!r}]\n".format(k, *map(float, point(body, local)))
        for k, (one, at, *_) in enumerate(self.hinges):
            text += "H{} = [{!r}, {!r}]\n".format(k, *map(float, point(one, at)))
        for body, (mass, inertia) in enumerate(self.bodies):
            own = [f"P{k}" for k, corner in enumerate(self.corners) if corner[0] == body]
            own += [f"H{k}" for k, hinge in enumerate(self.hinges) if body in (hinge[0], hinge[2])] + [f"C{body}"]
            points = ", ".join(f'"{name}"' for name in dict.fromkeys(own))
            text += f'[bodies.b{body}]\npoints = [{points}]\nmass = {mass!r}\nmoment_of_inertia = {inertia!r}\ncentre_of_mass = "C{body}"\n'
        for k, (body, _, face, mu, restitution) in enumerate(self.corners):
            text += f'[joints.c{k}]\ntype = "corner_on_face"\nblock = "b{body}"\nat = "P{k}"\nface = {ends[face]}\n'
            text += f"mu = {mu!r}\nrestitution = {restitution!r}\nclosed = false\n"
        for k, (one, _, other, _, radius) in enumerate(self.hinges):
            text += f'[joints.h{k}]\ntype = "hinge"\nbetween = ["b{one}.H{k}", "b{other}.H{k}"]\nfriction_radius = {radius!r}\n'
        for body in range(len(self.bodies)):
            held = any(body == hinge[2] for hinge in self.hinges)
            vx, vy, spin = map(float, self.rates[3 * body : 3 * body + 3])
            if not held:
                text += f'[coordinates.x{body}]\nx = "b{body}.C{body}"\nrate = {vx!r}\n'
                text += f'[coordinates.y{body}]\ny = "b{body}.C{body}"\nrate = {vy!r}\n'
            text += f'[coordinates.turn{body}]\nrotation = "b{body}"\nrate = {spin!r}\n'
        return text


def random_system(number: int) -> System:
    """One system of each kind in turn: a box, a rod at a wall, a box with an arm, every other one on a rough pin."""
    draw = random.Random(number)
    mu = lambda: round(draw.uniform(0.1, 0.7), 3)
    restitution = draw.choice([0.0, 0.0, 0.3])
    kind = number % 3
    angle = draw.uniform(-0.6, 0.6)
    if kind == 1:
        half = draw.uniform(0.3, 0.5)
        place = [-1 + half * math.cos(1.0 + angle / 3) + 0.05, half * math.sin(1.0 + angle / 3) + 0.05, 0.0]
        along = np.array([math.cos(2.14 - angle / 3), math.sin(2.14 - angle / 3)])
        corners = [(0, half * along, face, mu(), restitution) for face in ("wall", "floor")]
        corners += [(0, -half * along, "floor", mu(), restitution)]
        mass = draw.uniform(0.5, 2.0)
        rates = [draw.uniform(-1, 1), draw.uniform(-1, 0), draw.uniform(-1, 1)]
        return System([(mass, mass * half**2 / 3)], corners, [], place, rates)
    width, height = draw.uniform(0.1, 0.3), draw.uniform(0.1, 0.3)
    locals_ = [turned(angle, np.array([sx * width, sy * height])) for sx in (-1, 1) for sy in (-1, 1)]
    low = -min(local[1] for local in locals_)
    corners = [(0, local, "floor", mu(), restitution) for local in locals_]
    mass = draw.uniform(1.0, 3.0)
    bodies = [(mass, mass * (width**2 + height**2) / 3)]
    places, rates = [0.0, low + 0.1, 0.0], [draw.uniform(-2, 2), draw.uniform(-1, 1), draw.uniform(-3, 3)]
    if kind == 0:
        return System(bodies, corners, [], places, rates)
    # An arm on the centre of the box, up and not long enough to reach the floor.
    arm, lean = 0.8 * min(width, height), draw.uniform(-1, 1)
    local = -arm * np.array([math.sin(lean), math.cos(lean)])
    spin = draw.uniform(-5, 5)
    bodies.append((draw.uniform(0.3, 1.0), 0.002))
    places += [-local[0], low + 0.1 - local[1], 0.0]
    rates += [rates[0] + spin * local[1], rates[1] - spin * local[0], rates[2] + spin]
    # The arm's centre moves as the hinge does and turns about it.
    whole = rates[2] + spin
    rates[3:6] = [rates[0] + whole * local[1], rates[1] - whole * local[0], whole]
    radius = draw.uniform(0.005, 0.05) if number % 2 == 0 else 0.0
    return System(bodies, corners, [(0, np.zeros(2), 1, local, radius)], places, rates)


def by_slideway(program: str, system: System):
    """The coordinates and rates at the end; nothing, and its words, where the motion ends before."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "model.toml"
        file.write_text(system.model())
        command = [program, "simulate", str(file), "--until", f"{DURATION}s", "--impacts", "moreau", "--format", "json"]
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    if not done.stdout:
        return None, done.stderr.strip().splitlines()[0]
    report = json.loads(done.stdout)
    if report["end"]["kind"] not in ("finished",):
        return None, report["end"].get("words", report["end"]["kind"])
    return report, ""


def main() -> None:
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 30
    first = int(sys.argv[3]) if len(sys.argv) > 3 else 0
    agree = differ = sensitive = ended = impacts = 0
    errors = []
    for number in range(first, first + count):
        system = random_system(number)
        report, why = by_slideway(program, system)
        if report is None:
            ended += 1
            print(f"{number}: not compared: {why}")
            continue
        coarse, fine = (np.concatenate(system.run(steps)) for steps in STEPS)
        found = end_of(report, system)
        impacts += sum(event_lands(event) for event in report["events"])
        places = 3 * len(system.bodies)
        apart = abs(coarse - fine)[:places].max()
        before, off = (abs(found - one)[:places].max() for one in (coarse, fine))
        if apart > 0.01:
            sensitive += 1
            print(f"{number}: depends on the step: {apart:.1e} between both, {off:.1e} from slideway")
            continue
        errors.append((before, off))
        if off <= WAYS * DURATION / STEPS[1] * system.fastest:
            agree += 1
        else:
            differ += 1
            print(f"{number}: differs by {off:.1e} m, both steps by {apart:.1e}")
    means = [sum(of_step) / max(len(errors), 1) for of_step in zip(*errors)] or [0.0, 0.0]
    print(f"{agree} agree, {differ} differ, {sensitive} depend on the step, {ended} not compared; {impacts} impacts")
    print(f"mean difference {means[0]:.1e} m with the step h, {means[1]:.1e} m with h/2; greatest {max((off for _, off in errors), default=0.0):.1e} m")
    sys.exit(differ > 0)


def event_lands(event) -> bool:
    return any(cause["kind"] == "lands" for cause in event["causes"])


def end_of(report, system: System):
    """Places and rates of the bodies at the end of a report."""
    values = {one["name"]: one for one in report["last"]}
    places, rates = np.zeros(3 * len(system.bodies)), np.zeros(3 * len(system.bodies))
    for body in range(len(system.bodies)):
        turn = values[f"turn{body}"]
        if f"x{body}" in values:
            for axis, name in enumerate((f"x{body}", f"y{body}")):
                places[3 * body + axis] = system.places[3 * body + axis] + values[name]["value"]
                rates[3 * body + axis] = values[name]["rate"]
        places[3 * body + 2], rates[3 * body + 2] = turn["value"], turn["rate"]
    for one, at, other, there, _ in system.hinges:
        here = places[3 * one : 3 * one + 2] + turned(places[3 * one + 2], at)
        arm = turned(places[3 * other + 2], there)
        places[3 * other : 3 * other + 2] = here - arm
    return np.concatenate([places, rates])


if __name__ == "__main__":
    main()
