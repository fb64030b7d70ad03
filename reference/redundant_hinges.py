#!/usr/bin/env python3
"""All solutions of random redundant mechanisms with rubbing hinges, by brute force: writes redundant-hinges.toml.

    python3 reference/redundant_hinges.py > reference/redundant-hinges.toml
    python3 reference/redundant_hinges.py COUNT target/release/slideway      # compares COUNT mechanisms with `slideway solve`

A carriage slides along x on two parallel rails, or on one with a third pad. Each face of a contact yields (stiffness k), has
play or interference, and may be misaligned; one or two pendulums hang on the carriage, in a row or side by side, by pins
with friction circles. Written without slideway, from Newton's and Euler's laws for each body (unknowns: accelerations, the
normal forces of both faces of all contacts, hinge forces, and the small deflection y, theta of the carriage):

- A contact at (x, y) is displaced by d = y + theta x - e. It presses with N+ = -(delta + d) k at one face, or with
  N- = -(delta - d) k at the other, or is open; a press fit presses at both faces, or at one. Friction at each face is
  -s mu N, in the line of the face.
- Trammels: see there.
- The couple of a pin is -sgn(omega) r |R|.

For each pattern of open faces all forces are affine in the lengths w of the hinge forces. What is left are the quadrics
|R_j(w)|^2 = w_j^2: one quadratic equation for one pin; for two pins the resultant, a polynomial of degree four. Each root is
kept if it satisfies every equation and every inequality. All patterns are tried.
"""

import itertools
import json
import random
import subprocess
import sys
import tempfile

import numpy as np

GRAVITY = 9.81
# Roots whose inequalities are this close to their ends are too near to a change of mode to compare counts.
CLEAR = 1e-7


def drawn(generator):
    """A random case."""
    if generator.random() < 0.25:
        return drawn_trammel(generator)
    number = lambda low, high: round(generator.uniform(low, high), 4)
    length = number(0.2, 0.6)
    kind = generator.choice(["rails", "rails", "pads", "press", "rigid"])
    mu = number(0.05, 0.3) if generator.random() < 0.5 else number(0.3, 1.2)
    rails = []
    for lateral in [number(0.1, 0.4), -number(0.1, 0.4)][: 1 if kind == "pads" or (kind == "press" and generator.random() < 0.5) else 2]:
        height = generator.choice([0.0, number(0.02, 0.15), -number(0.02, 0.15)])
        places = [length / 2, -length / 2] + ([number(-0.3, 0.3) * length] if kind == "pads" else [])
        rail = {"y": lateral, "height": height, "mu": mu, "contacts": []}
        for place in places:
            play = generator.choice([0.0, number(0.05, 0.4)])
            if kind == "press" and lateral > 0 and generator.random() < 0.7:
                play = -number(0.05, 0.4)
            out = number(-0.1, 0.1)
            if kind == "rigid":
                play, out = number(0.05, 0.4), 0.2 * out  # within the play, so that it can be assembled
            rail["contacts"].append({
                "x": place, "play": round(1e-3 * play, 7), "e": round(1e-3 * generator.choice([0.0, out]), 7),
                "k": None if kind == "rigid" else 1e3 * number(20, 200),
            })
        rails.append(rail)
    pins = generator.choice([1, 2])
    big = generator.choice([0.05, 0.3, 0.8])
    pendulums = []
    for at in range(pins):
        pendulums.append({
            "on": generator.choice([-1, 0]) if at else -1,
            "at": [number(-0.3, 0.3), number(-0.2, 0.2)],
            "c": [number(-0.3, 0.3), number(-0.3, 0.3)],
            "tip": [number(-0.3, 0.3), number(-0.3, 0.3)],
            "mass": number(0.5, 3.0), "inertia": number(0.005, 0.1), "omega": number(1, 6) * generator.choice([-1, 1]),
            "radius": number(0.1, 1.0) * big * 0.3,
        })
    return {
        "length": length, "rails": rails, "pendulums": pendulums, "mass": number(1, 8), "inertia": number(0.05, 0.5),
        "force": [number(-40, 40), number(-60, 60)], "where": [number(-0.3, 0.3), number(-0.3, 0.3)],
        "rate": generator.choice([-1, 1]) * 0.4, "kind": kind,
    }


def model(case):
    """The model file of a case."""
    if case["kind"] == "trammel":
        return model_of_trammel(case)
    text = ["gravity = 9.81", "[points]", "middle = [0, 0]", f"where = {case['where']}"]
    bodies, joints, names = [], [], []
    for index, rail in enumerate(case["rails"]):
        text.append(f"rail{index} = [0, {rail['y']}]")
        names.append(f'"rail{index}"')
    places = []
    for index, bar in enumerate(case["pendulums"]):
        base = np.zeros(2) if bar["on"] < 0 else places[bar["on"]]["pin"]
        pin = np.array(bar["at"]) if bar["on"] < 0 else places[bar["on"]]["tip"]
        centre, tip = pin + bar["c"], pin + bar["tip"]
        places.append({"pin": pin, "tip": tip, "centre": centre, "base": base})
        for name, place in [("P", pin), ("C", centre), ("T", tip)]:
            text.append(f"{name}{index} = [{place[0]:.4f}, {place[1]:.4f}]")
        if bar["on"] < 0:
            names.append(f'"P{index}"')
        bodies += [f"[bodies.bar{index}]", f'points = ["P{index}", "C{index}", "T{index}"]', f"mass = {bar['mass']}",
                   f"moment_of_inertia = {bar['inertia']}", f'centre_of_mass = "C{index}"']
        on = f"carriage.P{index}" if bar["on"] < 0 else f"bar{bar['on']}.T{bar['on']}"
        joints += [f"[joints.pin{index}]", 'type = "hinge"', f'between = ["bar{index}.P{index}", "{on}"]',
                   f"friction_radius = {bar['radius']}", f"[coordinates.q{index}]", f'rotation = "bar{index}"',
                   f"rate = {bar['omega']}"]
    text += ["[bodies.carriage]", f'points = ["middle", "where", {", ".join(names)}]', f"mass = {case['mass']}",
             f"moment_of_inertia = {case['inertia']}", 'centre_of_mass = "middle"']
    for index, rail in enumerate(case["rails"]):
        text += [f"[joints.slide{index}]", 'type = "block_slider"', 'block = "carriage"', f'at = "rail{index}"',
                 'along = "0 deg"', f"length = {case['length']}", f"mu = {rail['mu']}"]
        if rail["height"]:
            text += [f"height = {abs(rail['height'])}"] + (['fit = "around"'] if rail["height"] < 0 else [])
        table = lambda c: ", ".join([f"play = {c['play']!r}", f"misalignment = {c['e']!r}"]
                                    + ([f"stiffness = {c['k']}"] if c["k"] else []))
        for name, contact in zip(["front", "rear"], rail["contacts"]):
            text.append(f"{name} = {{ {table(contact)} }}")
        for contact in rail["contacts"][2:]:
            text.append(f"supports = {{ third = {{ at = {contact['x']!r}, {table(contact)} }} }}")
    text += ["[loads.force]", 'type = "force"', 'at = "carriage.where"', f"components = {case['force']}",
             "[coordinates.x]", 'slide = "slide0"', f"rate = {case['rate']}"]
    return "\n".join(text + bodies + joints) + "\n"


def faces_of(case):
    """Of each contact in the order of the model the possible sets of pressed faces (1: N > 0, -1: N < 0)."""
    sets = []
    for rail in case["rails"]:
        for contact in rail["contacts"]:
            if contact["play"] < 0:
                sets.append([(1, -1), (1,), (-1,)])
            elif contact["play"] > 0:
                sets.append([(1,), (-1,), ()])
            else:
                sets.append([(1,), (-1,)])
    return sets


class Pattern:
    """The equations of one pattern: unknowns are affine in the lengths w of the hinge forces."""

    def __init__(self, case, pattern):
        self.case, self.pattern = case, pattern
        self.contacts = [(rail, contact) for rail in case["rails"] for contact in rail["contacts"]]
        self.forces = [(at, face) for at, faces in enumerate(pattern) for face in faces]
        self.bars = len(case["pendulums"])
        # a_x, then x, y and angular accelerations of each bar, hinge forces on the bar, faces, y, theta
        self.first_force = 1 + 3 * self.bars + 2 * self.bars
        self.size = self.first_force + len(self.forces) + 2
        self.rows, self.right = [], []
        self.carriage()
        self.pendulums()
        self.laws()

    def row(self, entries, right):
        """`right` is a number, then what a unit length of each hinge force adds."""
        row = np.zeros(self.size)
        for at, value in entries:
            row[at] += value
        self.rows.append(row)
        self.right.append(right)

    def reaction(self, bar):
        return [1 + 3 * self.bars + 2 * bar + axis for axis in (0, 1)]

    def places(self):
        pins, tips = [], []
        for bar in self.case["pendulums"]:
            pin = np.array(bar["at"]) if bar["on"] < 0 else tips[bar["on"]]
            pins.append(pin)
            tips.append(pin + bar["tip"])
        return pins

    def couple(self, bar):
        """The couple on a bar by its pin, per length of the hinge force."""
        data = self.case["pendulums"][bar]
        relative = data["omega"] - (0.0 if data["on"] < 0 else self.case["pendulums"][data["on"]]["omega"])
        return -np.sign(relative) * data["radius"]

    def carriage(self):
        case = self.case
        sense, zero = np.sign(case["rate"]), [0.0] * (1 + self.bars)
        x, y, moment = [(0, case["mass"])], [], []
        right = [zero.copy() for _ in range(3)]
        (fx, fy), (px, py) = case["force"], case["where"]
        right[0][0] += fx
        right[1][0] += fy - case["mass"] * GRAVITY
        right[2][0] += px * fy - py * fx
        for index, (at, face) in enumerate(self.forces):
            rail, contact = self.contacts[at]
            unknown = self.first_force + index  # the size of the force, which acts in the sense of the face
            line = rail["y"] - face * rail["height"] / 2
            friction = -sense * rail["mu"]
            x.append((unknown, -friction))
            y.append((unknown, -float(face)))
            moment.append((unknown, -(face * contact["x"] - line * friction)))
        for bar, pin in enumerate(self.places()):
            if case["pendulums"][bar]["on"] >= 0:
                continue
            rx, ry = self.reaction(bar)
            x.append((rx, 1.0))
            y.append((ry, 1.0))
            moment += [(ry, pin[0]), (rx, -pin[1])]
            right[2][1 + bar] -= self.couple(bar)
        for entries, constant in zip([x, y, moment], right):
            self.row(entries, constant)

    def pendulums(self):
        case, pins = self.case, self.places()
        for bar, data in enumerate(case["pendulums"]):
            ax, ay, alpha = (1 + 3 * bar + part for part in range(3))
            (rx, ry), (cx, cy) = self.reaction(bar), data["c"]
            none = [0.0] * (1 + self.bars)
            x, y, moment = [(ax, data["mass"]), (rx, -1.0)], [(ay, data["mass"]), (ry, -1.0)], []
            # about the mass centre, which is at (cx, cy) from the pin
            moment = [(alpha, data["inertia"]), (ry, cx), (rx, -cy)]
            right = [none.copy() for _ in range(3)]
            right[1][0] -= data["mass"] * GRAVITY
            right[2][1 + bar] += self.couple(bar)
            for other, child in enumerate(case["pendulums"]):
                if child["on"] == bar:
                    ox, oy = self.reaction(other)
                    arm = pins[other] - (pins[bar] + data["c"])
                    x.append((ox, 1.0))
                    y.append((oy, 1.0))
                    moment += [(oy, arm[0]), (ox, -arm[1])]
                    right[2][1 + other] -= self.couple(other)
            for entries, constant in zip([x, y, moment], right):
                self.row(entries, constant)
            # a_centre = a_pin + alpha x c - omega^2 c; a_pin is that of the carriage, or of the tip of the other bar
            for axis, (own, turn) in enumerate([(ax, -cy), (ay, cx)]):
                entries = [(own, 1.0), (alpha, -turn)]
                constant = -data["omega"] ** 2 * data["c"][axis]
                if data["on"] < 0:
                    entries += [(0, -1.0)] if axis == 0 else []
                else:
                    parent = case["pendulums"][data["on"]]
                    arm = np.array(parent["tip"]) - np.array(parent["c"])
                    first = 1 + 3 * data["on"]
                    entries += [(first + axis, -1.0), (first + 2, arm[1] if axis == 0 else -arm[0])]
                    constant -= parent["omega"] ** 2 * arm[axis]
                self.row(entries, [constant] + [0.0] * self.bars)

    def laws(self):
        """A pressed face: -face d = delta + N / k, d = y + theta x - e."""
        for index, (at, face) in enumerate(self.forces):
            _, contact = self.contacts[at]
            flexibility = 1 / contact["k"] if contact["k"] else 0.0
            entries = [(self.first_force + index, flexibility), (self.size - 2, face), (self.size - 1, face * contact["x"])]
            self.row(entries, [face * contact["e"] - contact["play"] / 2] + [0.0] * self.bars)

    def displacement(self, at, z):
        _, contact = self.contacts[at]
        return z[-2] + z[-1] * contact["x"] - contact["e"]

    def affine(self):
        """All unknowns: without couples, then what a unit length of each hinge force adds; None if they are not determined."""
        matrix, right = np.array(self.rows), np.array(self.right)
        scale = np.abs(matrix).max(axis=1)
        if (scale == 0).any():
            return None
        matrix, right = matrix / scale[:, None], right / scale[:, None]
        columns = np.abs(matrix).max(axis=0)
        if (columns == 0).any():
            return None
        matrix = matrix / columns
        if np.linalg.cond(matrix) > 1e12:
            return None
        return np.linalg.solve(matrix, right) / columns[:, None]

    def roots(self, all_):
        """The lengths of the hinge forces."""
        polynomials = []
        for bar in range(self.bars):
            parts = all_[self.reaction(bar)]
            # sum of squares minus w_bar^2 as a quadric: matrix of 1, w_1, w_2
            quadric = parts.T @ parts
            quadric[1 + bar, 1 + bar] -= 1.0
            polynomials.append(quadric)
        if self.bars == 1:
            q = polynomials[0]
            return [[w.real] for w in np.roots([q[1, 1], 2 * q[0, 1], q[0, 0]]) if abs(w.imag) < 1e-9 * (1 + abs(w))]
        poly = np.polynomial.polynomial
        def in_first(q):
            """Coefficients of 1, u, u^2, each a polynomial in v."""
            return [np.array([q[0, 0], 2 * q[0, 2], q[2, 2]]), np.array([2 * q[0, 1], 2 * q[1, 2]]), np.array([q[1, 1]])]
        (a0, a1, a2), (c0, c1, c2) = map(in_first, polynomials)
        cross = lambda one, other, three, four: poly.polysub(poly.polymul(one, other), poly.polymul(three, four))
        resultant = poly.polysub(poly.polymul(cross(a2, c0, a0, c2), cross(a2, c0, a0, c2)),
                                 poly.polymul(cross(a2, c1, a1, c2), cross(a1, c0, a0, c1)))
        found = []
        for v in poly.polyroots(resultant):
            if abs(v.imag) > 1e-6 * (1 + abs(v)):
                continue
            for u in np.roots([part for part in [poly.polyval(v.real, one) for one in (a2, a1, a0)]]):
                if abs(u.imag) > 1e-4 * (1 + abs(u)):
                    continue
                w = self.polished(polynomials, np.array([u.real, v.real]))
                if w is not None and all(np.abs(w - other).max() > 1e-8 * (1 + np.abs(w).max()) for other in found):
                    found.append(w)
        return found

    @staticmethod
    def polished(quadrics, w):
        """Newton's method for both quadrics; None if it does not converge."""
        for _ in range(60):
            z = np.array([1.0, *w])
            values = np.array([z @ q @ z for q in quadrics])
            slopes = np.array([2 * (q @ z)[1:] for q in quadrics])
            if abs(np.linalg.det(slopes)) == 0.0:
                return None
            step = np.linalg.solve(slopes, values)
            w = w - step
            if np.abs(step).max() <= 1e-14 * (1e-3 + np.abs(w).max()):
                return w
        return None

    def solutions(self):
        """Normal forces, acceleration and hinge forces of all solutions; and whether one is near a border. None if the
        forces are not determined: rigid faces of more contacts than statics needs, or fewer than it needs."""
        all_ = self.affine()
        if all_ is None:
            return [], False
        kept, doubtful = [], False
        for w in self.roots(all_):
            z = all_ @ np.array([1.0, *w])
            forces = range(self.first_force, self.first_force + len(self.forces))
            size = max(np.abs(z[1 + 3 * self.bars:forces.stop]).max(), 1.0)
            margins = list(np.array(w) / size) + list(z[forces] / size)
            for at, faces in enumerate(self.pattern):
                _, contact = self.contacts[at]
                d = self.displacement(at, z)
                half = contact["play"] / 2
                unit = abs(half) + 1e-5
                margins += [(half + face * d) / unit for face in (1, -1) if face not in faces and contact["play"] != 0]
            least = min(margins)
            doubtful |= abs(least) < CLEAR
            if least > 0:
                normal = np.zeros(len(self.pattern))
                for index, (at, face) in enumerate(self.forces):
                    normal[at] += face * z[self.first_force + index]
                kept.append({"N": list(normal), "acceleration": z[0],
                             "R": [list(z[self.reaction(bar)]) for bar in range(self.bars)]})
        return kept, doubtful


class Trammel(Pattern):
    """A bar whose ends slide in crossed slots while a crank guides its middle: one of these three is in excess, and the
    self-stress passes through the pins of the crank, both of which turn. The crank is driven at a constant rate.

    Unknowns: the torque, six numbers without meaning, the forces of the pins on the bar and on the crank, faces, and the
    small turn psi of the bar about its middle, which displaces its ends by `l cos(theta) psi` and `l sin(theta) psi` along
    the normals +y and -x of the slots.
    """

    def carriage(self):
        case, w = self.case, 2 * self.case["rate"]
        self.bars, self.first_force = 2, 11
        self.size = self.first_force + len(self.forces) + 1
        l, theta, rate, mu = case["l"], case["theta"], case["rate"], case["mu"]
        direction = np.array([np.cos(theta), np.sin(theta)])
        for unused in range(1, 7):
            self.row([(unused, 1.0)], [0.0] * 3)
        ends = [np.array([l * direction[0], -l * direction[1]]), np.array([-l * direction[0], l * direction[1]])]
        slides = [np.array([-np.sin(theta) * rate, 0.0]), np.array([0.0, np.cos(theta) * rate])]
        normals = [np.array([0.0, 1.0]), np.array([-1.0, 0.0])]
        (mx, my), (ox, oy) = self.reaction(0), self.reaction(1)
        # the bar: at its middle, which is its mass centre
        force = [[(mx, 1.0)], [(my, 1.0)]]
        moment = []
        for index, (at, face) in enumerate(self.forces):
            along = face * normals[at] - mu * np.sign(slides[at].sum()) * np.abs(np.sign(slides[at]))
            for axis in (0, 1):
                force[axis].append((self.first_force + index, along[axis]))
            moment.append((self.first_force + index, ends[at][0] * along[1] - ends[at][1] * along[0]))
        inertia = -case["mass"] * rate**2 * l * direction
        self.row(force[0], [inertia[0], 0.0, 0.0])
        self.row(force[1], [inertia[1] + case["mass"] * GRAVITY, 0.0, 0.0])
        # the bar turns by -rate, the crank by rate: the couple on the bar has the sense of rate
        self.row(moment, [0.0, -np.sign(w) * case["radii"][0], 0.0])
        # the massless crank, about its pin on ground
        self.row([(mx, -1.0), (ox, 1.0)], [0.0] * 3)
        self.row([(my, -1.0), (oy, 1.0)], [0.0] * 3)
        arm = l * direction
        self.row([(0, 1.0), (my, -arm[0]), (mx, arm[1])],
                 [0.0, np.sign(w) * case["radii"][0], np.sign(rate) * case["radii"][1]])

    def pendulums(self):
        pass

    def laws(self):
        for index, (at, face) in enumerate(self.forces):
            _, contact = self.contacts[at]
            entries = [(self.first_force + index, 1 / contact["k"]), (self.size - 1, face * self.arm(at))]
            self.row(entries, [face * contact["e"] - contact["play"] / 2] + [0.0] * 2)

    def arm(self, at):
        return self.case["l"] * (np.cos, np.sin)[at](self.case["theta"])

    def displacement(self, at, z):
        return self.arm(at) * z[-1] - self.contacts[at][1]["e"]


def drawn_trammel(generator):
    number = lambda low, high: round(generator.uniform(low, high), 4)
    contact = lambda: {"play": round(1e-3 * generator.choice([0.0, number(0.05, 0.4)]), 7),
                       "e": round(1e-3 * generator.choice([0.0, number(-0.3, 0.3)]), 7), "k": 1e3 * number(5, 200)}
    mu = number(0.05, 1.5)
    size = generator.choice([0.02, 0.1, 0.3])
    return {"kind": "trammel", "l": number(0.1, 0.4), "theta": number(0.2, 1.3), "rate": number(1, 6) * generator.choice([-1, 1]),
            "mu": mu, "mass": number(0.5, 4), "radii": [number(0.1, 1) * size, number(0.1, 1) * size], "pendulums": [],
            "rails": [{"contacts": [contact()]}, {"contacts": [contact()]}]}


def model_of_trammel(case):
    l, theta = case["l"], case["theta"]
    x, y = float(l * np.cos(theta)), float(l * np.sin(theta))
    text = f"""gravity = 9.81
[points]
O = [0, 0]
M = [{x!r}, {y!r}]
A = [{2 * x!r}, 0]
B = [0, {2 * y!r}]
[bodies.carriage]
points = ["M", "A", "B"]
mass = {case["mass"]}
moment_of_inertia = 0.1
centre_of_mass = "M"
[bodies.crank]
points = ["O", "M"]
massless = true
[joints.middle]
type = "hinge"
between = ["carriage.M", "crank.M"]
friction_radius = {case["radii"][0]}
[joints.shaft]
type = "hinge"
between = ["crank.O", "ground.O"]
friction_radius = {case["radii"][1]}
"""
    for name, angle, rail in zip("AB", (0, 90), case["rails"]):
        contact = rail["contacts"][0]
        text += f"""[joints.slot{name}]
type = "pin_in_slot"
block = "carriage"
guide = "ground"
along = "{angle} deg"
at = "{name}"
mu = {case["mu"]}
play = {contact["play"]!r}
misalignment = {contact["e"]!r}
stiffness = {contact["k"]}
"""
    return text + f"""[coordinates.theta]
rotation = "crank"
rate = {case["rate"]}
[drives.motor]
coordinate = "theta"
acceleration = 0
torque = {{ body = "crank" }}
"""


def solve(case):
    """All solutions; and whether one is near a border of its mode."""
    found, doubtful = [], False
    for pattern in itertools.product(*faces_of(case)):
        kind = Trammel if case["kind"] == "trammel" else Pattern
        kept, near = kind(case, pattern).solutions()
        found += kept
        doubtful |= near
    return sorted(found, key=lambda one: one["acceleration"]), doubtful


def by_slideway(program, case):
    with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
        file.write(model(case))
        file.flush()
        done = subprocess.run([program, "solve", file.name, "--format", "json"], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1) or not done.stdout:
        return None, done.stderr
    return json.loads(done.stdout), done.stderr


def compare(count, program):
    generator = random.Random(2026)
    tally = {"same": 0, "unproven": 0, "doubtful": 0, "refused": 0, "wrong": 0}
    numbers = {}
    drawn_ = 0
    while tally["same"] + tally["wrong"] + tally["unproven"] < count:
        drawn_ += 1
        case = drawn(generator)
        expected, doubtful = solve(case)
        if doubtful:
            tally["doubtful"] += 1
            continue
        report, error = by_slideway(program, case)
        if report is None:
            errors = [line for line in error.splitlines() if line.startswith("error")]
            print(f"{drawn_} ({case['kind']}): refused: {errors}, expected: {len(expected)}")
            tally["refused"] += 1
            continue
        key = (case["kind"], len(expected))
        numbers[key] = numbers.get(key, 0) + 1
        found = sorted(value(one, case) for one in report["solutions"])
        wanted = sorted(one["acceleration"] for one in expected)
        size = max([1.0] + [abs(value) for value in wanted])
        is_same = len(found) == len(wanted) and all(abs(a - b) < 1e-6 * size for a, b in zip(found, wanted))
        proven = report["complete"] == "proven"
        if is_same and proven:
            tally["same"] += 1
        elif not proven:
            tally["unproven"] += 1
            print(f"{drawn_} ({case['kind']}): not proven: {report['open']}, {len(found)} of {len(wanted)}")
        else:
            tally["wrong"] += 1
            print(f"{drawn_} ({case['kind']}): {found} instead of {wanted}")
    print(tally)
    print("solutions:", dict(sorted(numbers.items())))


def value(solution, case):
    """The acceleration of a carriage, or the torque of a trammel."""
    if case["kind"] == "trammel":
        return solution["drives"][0]["effort"]
    return next(body["acceleration"][0] for body in solution["bodies"] if body["name"] == "carriage")


def write(count):
    generator = random.Random(2026)
    print("# Carriages on redundant rails with rubbing pendulums: model files, and all their solutions.")
    print("# Written by redundant_hinges.py, by brute force over all signs and directions. Half of them have none or several.")
    left = {True: count // 2, False: count - count // 2}
    while any(left.values()):
        case = drawn(generator)
        expected, doubtful = solve(case)
        if doubtful or not left[len(expected) == 1]:
            continue
        left[len(expected) == 1] -= 1
        print(f"\n[[case]]\nkind = \"{case['kind']}\"\nmodel = '''\n{model(case)}'''\nsolutions = [")
        for one in expected:
            normal = ", ".join(f"{value:.12g}" for value in one["N"])
            hinges = ", ".join("[" + ", ".join(f"{value:.12g}" for value in force) + "]" for force in one["R"])
            print(f"  {{ acceleration = {one['acceleration']:.12g}, N = [{normal}], R = [{hinges}] }},")
        print("]")


if __name__ == "__main__":
    if len(sys.argv) == 3:
        compare(int(sys.argv[1]), sys.argv[2])
    else:
        write(20)
