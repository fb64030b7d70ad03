#!/usr/bin/env python3
"""Compares gallery-frictionless.toml with the multibody code Exudyn (three coordinates per body, joints as constraints).

    python3 -m venv venv && venv/bin/pip install -r reference/requirements.txt
    venv/bin/python reference/check_with_exudyn.py

Each mechanism is built from rigid bodies, revolute and prismatic joints and loads, started in the position and with
the velocities of the case, and integrated over a few very short steps (trapezoidal rule, constraints on
velocity level).
The accelerations of all bodies and the joint forces (Exudyn's multipliers) are extrapolated to the start from three step sizes.
Parameters are read from the model files, positions and velocities are written here anew; nothing is shared
with gallery_frictionless.py but its output.

Obtained agreement (Exudyn 1.13.6, all 22 cases of slider-crank, sleeve-on-arm, elliptic-trammel, scotch-yoke and
telescopic-boom, largest difference over the largest value): linear and angular accelerations and forces, including front and
rear of every block slider and the sign of every hinge force, within 5e-7, what the extrapolation allows; the boom, whose
accelerations are constant, within 1e-13.
"""
import math
import tomllib
from pathlib import Path

import exudyn as exu
import exudyn.itemInterface as ei
import numpy as np

HERE = Path(__file__).resolve().parent
UNITS = {"mm": 1e-3, "kN": 1e3, "deg": math.pi / 180}


def value(text):
    number, _, unit = str(text).partition(" ")
    return float(number) * UNITS.get(unit, 1.0)


class World:
    def __init__(self):
        self.sc = exu.SystemContainer()
        self.mbs = self.sc.AddSystem()
        self.ground = self.mbs.AddObject(ei.ObjectGround())
        self.place, self.obj, self.joints = {}, {"ground": self.ground}, {}
        self.names = []

    def body(self, name, m, inertia, pos, angle, vel, omega):
        node = self.mbs.AddNode(ei.NodeRigidBody2D(referenceCoordinates=[*pos, angle], initialVelocities=[*vel, omega]))
        self.obj[name] = self.mbs.AddObject(ei.ObjectRigidBody2D(mass=m, inertia=inertia, nodeNumber=node))
        self.place[name] = (np.array(pos), angle)
        self.names.append(name)

    def marker(self, body, point):
        if body == "ground":
            local = np.array(point, float)
        else:
            pos, a = self.place[body]
            d = np.array(point, float) - pos
            local = np.array([math.cos(a) * d[0] + math.sin(a) * d[1], -math.sin(a) * d[0] + math.cos(a) * d[1]])
        return self.mbs.AddMarker(ei.MarkerBodyRigid(bodyNumber=self.obj[body], localPosition=[*local, 0]))

    def direction(self, body, w):
        a = 0 if body == "ground" else self.place[body][1]
        return [math.cos(a) * w[0] + math.sin(a) * w[1], -math.sin(a) * w[0] + math.cos(a) * w[1], 0]

    def hinge(self, name, first, second, point):
        self.joints[name] = self.mbs.AddObject(
            ei.ObjectJointRevolute2D(markerNumbers=[self.marker(first, point), self.marker(second, point)]))

    def slide(self, name, block, guide, at, u, rotation):
        """The block's point stays on a line of the guide; marker 1 carries the normal, so it is the guide."""
        n = (-u[1], u[0])
        self.joints[name] = self.mbs.AddObject(ei.ObjectJointPrismatic2D(
            markerNumbers=[self.marker(block, at), self.marker(guide, at)], axisMarker0=self.direction(block, u),
            normalMarker1=self.direction(guide, n), constrainRotation=rotation))

    def force(self, body, point, f):
        self.mbs.AddLoad(ei.LoadForceVector(markerNumber=self.marker(body, point), loadVector=[*f, 0]))

    def torque(self, body, moment):
        self.mbs.AddLoad(ei.LoadTorqueVector(markerNumber=self.marker(body, self.place[body][0]), loadVector=[0, 0, moment]))

    def run(self, h):
        """Accelerations of all bodies and joint multipliers at the end of a short time."""
        self.mbs.Assemble()
        s = exu.SimulationSettings()
        t = s.timeIntegration
        t.numberOfSteps, t.endTime = 4, 4 * h
        t.generalizedAlpha.useIndex2Constraints = True
        t.generalizedAlpha.useNewmark = True
        t.generalizedAlpha.computeInitialAccelerations = True
        t.newton.relativeTolerance, t.newton.absoluteTolerance = 1e-12, 1e-12
        s.solution.file.write = False
        t.verboseMode = 0
        s.show.statistics = False
        self.mbs.SolveDynamic(s)
        acc = np.array(self.mbs.systemData.GetODE2Coordinates_tt())
        multipliers = np.array(self.mbs.systemData.GetAECoordinates())
        return np.concatenate([acc, multipliers])

    def start_values(self, h):
        """Extrapolated to time zero: {body: [ax, ay, alpha]} and {joint: its two multipliers}."""
        # Second-order polynomial in the end time through 4h, 2h, h.
        x1, x2, x4 = self.run(h), self.run(2 * h), self.run(4 * h)
        x = (8 * x1 - 6 * x2 + x4) / 3
        acc = {n: x[3 * i: 3 * i + 3] for i, n in enumerate(self.names)}
        rest = x[3 * len(self.names):]
        return acc, {n: rest[2 * i: 2 * i + 2] for i, n in enumerate(self.joints)}


def unit(a):
    return np.array([math.cos(a), math.sin(a)])


def rot90(w):
    return np.array([-w[1], w[0]])


# Each function returns the world and, from multipliers, the reactions. With marker 0 on the first body (hinge) or block
# (slide), the hinge force on the first body is +lambda, N is +lambda_0, and the moment on the block about `at` is -lambda_1.

def ends(lam, length):
    """front and rear of a block slider with its `at` point in the middle of both contacts."""
    return (lam[0] / 2 - lam[1] / length, lam[0] / 2 + lam[1] / length)


def slider_crank(p, at, rate):
    phi, om = at.get("phi", p["phi_drawn"]), rate.get("phi", p["omega"])
    r, l, g = p["r"], p["l"], np.array([0, -p["g"]])
    A, vA = r * unit(phi), om * r * rot90(unit(phi))
    sn, cs = -A[1] / l, math.sqrt(1 - (A[1] / l) ** 2)
    om_rod = -vA[1] / (l * cs)
    B = A + l * np.array([cs, sn])
    vB = vA + om_rod * l * np.array([-sn, cs])
    w = World()
    w.body("crank", p["m_crank"], p["m_crank"] * (1.5 * r) ** 2 / 2, (0, 0), phi, (0, 0), om)
    w.body("rod", p["m_rod"], p["m_rod"] * l**2 / 12, (A + B) / 2, math.atan2(sn, cs), (vA + vB) / 2, om_rod)
    w.body("piston", p["m_piston"], p["m_piston"] * (p["skirt"] ** 2 + p["bore"] ** 2) / 12, B, 0, (vB[0], 0), 0)
    for b in w.names:
        w.force(b, w.place[b][0], p["m_" + b] * g)
    w.force("piston", B, (p["gas"], 0))
    w.torque("crank", p["T"])
    w.hinge("O", "crank", "ground", (0, 0))
    w.hinge("A", "rod", "crank", A)
    w.hinge("B", "piston", "rod", B)
    w.slide("cylinder", "piston", "ground", B, (1, 0), True)
    return w, lambda x: {"cylinder": ends(x["cylinder"], p["skirt"]), "O": x["O"], "A": x["A"], "B": x["B"]}, 2e-6


def sleeve_on_arm(p, at, rate):
    phi, om = at.get("phi", p["phi_drawn"]), rate.get("phi", p["omega"])
    s, v = at.get("s", p["s_drawn"]), rate.get("s", p["v"])
    u = unit(phi)
    n = rot90(u)
    g = np.array([0, -p["g"]])
    S = s * u + p["e"] * n
    w = World()
    w.body("arm", p["m_arm"], p["m_arm"] * p["l"] ** 2 / 12, p["l"] / 2 * u, phi, om * p["l"] / 2 * n, om)
    w.body("sleeve", p["m_sleeve"], p["m_sleeve"] * (p["L"] ** 2 + 0.06**2) / 12, S, phi, om * rot90(S) + v * u, om)
    for b in w.names:
        w.force(b, w.place[b][0], p["m_" + b] * g)
    w.torque("arm", p["T"])
    w.hinge("O", "arm", "ground", (0, 0))
    w.slide("sleeve", "sleeve", "arm", s * u, u, True)
    return w, lambda x: {"sleeve": ends(x["sleeve"], p["L"]), "O": x["O"]}, 2e-5


def elliptic_trammel(p, at, rate):
    th, om = at.get("theta", math.pi - p["theta_drawn"]), rate.get("theta", -p["omega"])
    l = p["l"]
    B, A = np.array([0, l * math.sin(th)]), np.array([-l * math.cos(th), 0])
    G = (A + B) / 2
    w = World()
    w.body("rod", p["m"], p["m"] * l**2 / 12, G, th, om * np.array([l / 2 * math.sin(th), l / 2 * math.cos(th)]), om)
    w.force("rod", G, (0, -p["m"] * p["g"]))
    w.slide("horizontal", "rod", "ground", A, (1, 0), False)
    w.slide("vertical", "rod", "ground", B, (0, 1), False)
    return w, lambda x: {"horizontal": x["horizontal"][:1], "vertical": x["vertical"][:1]}, 1e-5


def scotch_yoke(p, at, rate):
    phi, om = at.get("phi", p["phi_drawn"]), rate.get("phi", p["omega"])
    r, g = p["r"], np.array([0, -p["g"]])
    pin = r * unit(phi)
    slot = np.array([pin[0], 0])
    guide = slot + [p["offset"], 0]
    w = World()
    w.body("crank", p["m_crank"], p["m_crank"] * (1.25 * r) ** 2 / 2, (0, 0), phi, (0, 0), om)
    w.body("yoke", p["m_yoke"], p["m_yoke"] * (0.04**2 + 0.14**2) / 12, slot, 0, (-om * pin[1], 0), 0)
    for b in w.names:
        w.force(b, w.place[b][0], p["m_" + b] * g)
    w.force("yoke", guide, (-p["Q"], 0))
    w.torque("crank", p["T"])
    w.hinge("O", "crank", "ground", (0, 0))
    w.slide("pin", "crank", "yoke", pin, (0, 1), False)
    w.slide("yoke", "yoke", "ground", guide, (1, 0), True)
    return w, lambda x: {"pin": x["pin"][:1], "yoke": ends(x["yoke"], p["L"]), "O": x["O"]}, 2e-6


def telescopic_boom(p, at, rate):
    u = unit(p["beta"])
    w = World()
    shift = speed = 0.0
    middles, tails, lengths = [], [], []
    for i in range(3):
        k = f"s_{i + 1}"
        mouth = i * (p["length"] - p["overlap"]) + shift      # front contact of joint i, on the guide
        shift += at.get(k, 0.0)
        speed += rate.get(k, p["v"])
        tail = i * p["length"] - (i + 1) * p["overlap"] + shift
        w.body(f"stage_{i + 1}", p["m"], p["m"] * p["length"] ** 2 / 12, (tail + p["length"] / 2) * u, p["beta"], speed * u, 0)
        w.force(f"stage_{i + 1}", w.place[f"stage_{i + 1}"][0], (0, -p["m"] * p["g"]))
        w.force(f"stage_{i + 1}", tail * u, p["F"] * u)
        if i:
            w.force(f"stage_{i}", tail * u, -p["F"] * u)
        middles.append((mouth + tail) / 2)
        lengths.append(mouth - tail)
    w.force("stage_3", (tail + p["length"]) * u, (0, -p["W"]))
    for i in range(3):
        w.slide(f"slide_{i + 1}", f"stage_{i + 1}", f"stage_{i}" if i else "ground", middles[i] * u, u, True)
    return w, lambda x: {n: ends(x[n], d) for n, d in zip(x, lengths)}, 1e-4


MODELS = {
    "slider-crank": slider_crank, "sleeve-on-arm": sleeve_on_arm, "elliptic-trammel": elliptic_trammel,
    "scotch-yoke": scotch_yoke, "telescopic-boom": telescopic_boom,
}


def main():
    print("Exudyn", exu.__version__, "- relative differences of linear and angular accelerations and of forces")
    worst = 0.0
    reference = tomllib.loads((HERE / "gallery-frictionless.toml").read_text())["case"]
    for case in reference:
        if case["model"] not in MODELS:
            continue
        texts = tomllib.loads((HERE.parent / "models" / (case["model"] + ".toml")).read_text())["parameters"]
        p = {k: value(case["set"].get(k, v)) for k, v in texts.items()}
        at = {k: value(v) for k, v in case.get("at", {}).items()}
        rate = {k: value(v) for k, v in case.get("rate", {}).items()}
        w, reactions, h = MODELS[case["model"]](p, at, rate)
        acc, lam = w.start_values(h)
        lam = reactions(lam)
        a = np.array([acc[n] for n in case["bodies"]])
        b = np.array(list(case["bodies"].values()))
        forces = {**{k: [v] for k, v in case["normal_forces"].items()}, **case["hinges"]}
        f_ref, f = [], []
        for name, v in forces.items():
            joint, _, end = name.partition(".")
            got = lam[joint] if not end else [lam[joint][0 if end == "front" else 1]]
            f_ref.extend(v)
            f.extend(got)
        f, f_ref = np.array(f), np.array(f_ref)
        # Largest difference over the largest value, apart for linear and angular accelerations and forces.
        errors = [
            abs(x - y).max() / abs(y).max() if y.any() else abs(x - y).max()
            for x, y in ((a[:, :2], b[:, :2]), (a[:, 2], b[:, 2]), (f, f_ref))
        ]
        worst = max(worst, *errors)
        shown = ", ".join(f"{e:.0e}" for e in errors)
        print(f"{case['model']:17s} at {case.get('at', {})} rate {case.get('rate', {})}: {shown}")
    print(f"largest relative difference {worst:.1e}")
    assert worst < 1e-6


if __name__ == "__main__":
    main()
