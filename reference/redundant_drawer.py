#!/usr/bin/env python3
"""Redundant guides by simulation with stiff springs, apart from slideway: writes redundant-simulated.toml.

    python3 -m venv venv && venv/bin/pip install numpy scipy
    venv/bin/python reference/redundant_drawer.py > reference/redundant-simulated.toml

The cases of redundant.toml with one body: a drawer on two rails, a carriage, a stage on three pads. The body is free in the
plane (x, y, angle: a finite rotation). At each contact, a point P of the body, both faces of the guide are springs and dampers,
whose distance from P along the guide's normal n follows from the play 2 delta and the misalignment e:

    d = n . (P - O) - e        penetrations  p+ = -(d + delta),   p- = d - delta
    N = max(0, p/f + c dp/dt)  where p > 0,  else 0               one for each face

Friction mu N acts at the face, h/2 beside P, and F0 at P, both against the sliding velocity v as tanh(v / 1 mm/s). A drive keeps
the velocity of the body along x. Rigid faces get f = 1e-6 m/N, which leaves the loose rail open. The body starts in the drawing, where nothing touches that has
play, at its listed velocity, and is integrated (SciPy's Radau, relative tolerance 1e-7) until it has settled: the last quarter
of the time changes no normal force by more than 1e-6 of the greatest. The file has what it settled on.

Of drawer_left_rail_tight the unattainable solution is the threshold to jamming: the body starts from 0.95 and 1.05 of its tilt.
It "returns" if it settles on the other solution, and "jams" if a normal force exceeds a hundred times those listed.
"""

import sys
import tomllib
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

REGULAR = 1e-3  # m/s: velocity over which friction changes its sign
DAMPING = 0.5  # of the critical one of the whole mass on one face
RIGID = 1e-6  # m/N
SETTLED = 1e-6


class Body:
    """The moving body of a case, with its contacts, load and drive."""

    def __init__(self, case):
        (body,) = case["bodies"]
        self.mass, self.moment = body["m"], body["J"]
        self.velocity = np.array(body["velocity"])
        self.gravity = np.array(case["gravity"])
        self.contacts, self.forces, self.drives = case["contacts"], case["forces"], case["drives"]

    def place(self, pose, local):
        sine, cosine = np.sin(pose[2]), np.cos(pose[2])
        return pose[:2] + [cosine * local[0] - sine * local[1], sine * local[0] + cosine * local[1]]

    def faces(self, contact, pose, rates):
        """Normal forces at both faces, the point in space and its velocity along the guide."""
        normal = np.array([-np.sin(contact["angle"]), np.cos(contact["angle"])])
        point = self.place(pose, contact["P"])
        arm = point - pose[:2]
        velocity = rates[:2] + rates[2] * np.array([-arm[1], arm[0]])
        deflection = normal @ (point - contact["O"]) - contact["e"]
        approach = normal @ velocity
        compliance = max(contact["f"], RIGID)
        damper = DAMPING * 2 * np.sqrt(self.mass / compliance)
        pressed = [-(deflection + contact["delta"]), deflection - contact["delta"]]
        forces = [
            max(0.0, depth / compliance + damper * rate) if depth > 0 else 0.0
            for depth, rate in zip(pressed, (-approach, approach))
        ]
        along = np.array([normal[1], -normal[0]])
        return forces, point, normal, along, along @ velocity

    def wrench(self, pose, rates):
        """Force and moment about the centre of mass without the drives, and all normal forces."""
        total = np.array([*(self.mass * self.gravity), 0.0])
        normals = []

        def add(force, at):
            arm = at - pose[:2]
            total[:] += [force[0], force[1], arm[0] * force[1] - arm[1] * force[0]]

        for contact in self.contacts:
            (plus, minus), point, normal, along, sliding = self.faces(contact, pose, rates)
            sign = np.tanh(sliding / REGULAR)
            add((plus - minus) * normal, point)
            for force, side in ((plus, -1.0), (minus, 1.0)):
                add(-contact["mu"] * force * sign * along, point + side * contact["h"] / 2 * normal)
            add(-contact["F0"] * sign * along, point)
            normals.append(plus - minus)
        for load in self.forces:
            add(np.array(load["force"]), self.place(pose, load["at"]))
        return total, np.array(normals)

    def motion(self, state):
        """Accelerations, normal forces and the force of the drive, which lets the body not accelerate along x."""
        pose, rates = state[:3], state[3:]
        total, normals = self.wrench(pose, rates)
        push = 0.0
        for drive in self.drives:
            assert drive["direction"] == [1.0, 0.0] and drive["acceleration"] == 0.0
            push = -total[0]
            arm = self.place(pose, drive["at"]) - pose[:2]
            total += [push, 0.0, -arm[1] * push]
        return total / [self.mass, self.mass, self.moment], normals, push

    def run(self, tilt, end, bound=np.inf):
        """The states from this tilt on; ends where a normal force passes the bound."""
        start = np.array([0.0, 0.0, tilt, *self.velocity])
        beyond = lambda _, state: np.abs(self.motion(state)[1]).max() - bound
        beyond.terminal = True
        return solve_ivp(
            lambda _, state: np.concatenate([state[3:], self.motion(state)[0]]),
            (0.0, end),
            start,
            method="Radau",
            rtol=1e-7,
            atol=1e-12,
            events=beyond if np.isfinite(bound) else None,
            dense_output=True,
        )

    def settled(self, tilt=0.0, end=1.5):
        """Normal forces, acceleration along x and force of the drive once nothing changes any more."""
        states = self.run(tilt, end)
        assert states.success, states.message
        normals = np.array([self.motion(states.sol(t))[1] for t in np.linspace(0.75 * end, end, 50)])
        change = np.ptp(normals, axis=0).max() / np.abs(normals).max()
        assert change < SETTLED, f"still moving: {change}"
        acceleration, normal, push = self.motion(states.sol(end))
        return normal, acceleration[0], push


def listed(values):
    return "[" + ", ".join(f"{value:.6g}" for value in values) + "]"


def write(case):
    body = Body(case)
    normal, acceleration, push = body.settled()
    print(f'\n[[settled]]\ncase = "{case["name"]}"\nnormal = {listed(normal)}')
    print(f"effort = {push:.6g}" if body.drives else f"acceleration = {acceleration:.6g}")
    one = [np.array(s["N_plus"]) - np.array(s["N_minus"]) for s in case["solutions"]]
    apart = min(np.abs(normal - other).max() / np.abs(other).max() for other in one)
    print(f"{case['name']}: {apart:.1e} from a listed solution", file=sys.stderr)


def threshold(case):
    body = Body(case)
    (wedged,) = [s for s in case["solutions"] if s["verdict"] == "unattainable"]
    tilt = (wedged["d"][0] - wedged["d"][2]) / (case["contacts"][0]["P"][0] - case["contacts"][2]["P"][0])
    bound = 100 * max(wedged["N_plus"])
    for part in (0.95, 1.05):
        states = body.run(part * tilt, 3.0, bound)
        if states.status == 1:
            outcome = "jams"
        else:
            outcome = "returns"
            normal, _, push = body.settled(part * tilt)
            (other,) = [s for s in case["solutions"] if s["verdict"] == "attainable"]
            expected = np.array(other["N_plus"]) - np.array(other["N_minus"])
            assert np.abs(normal - expected).max() < 0.01 * np.abs(expected).max()
        print(f'\n[[threshold]]\ncase = "{case["name"]}"\nof_tilt = {part}\noutcome = "{outcome}"')


def main():
    path = Path(__file__).with_name("redundant.toml")
    cases = tomllib.loads(path.read_text())["case"]
    print("# Written by redundant_drawer.py, which says how. SI units; contacts in the order of redundant.toml.")
    for case in cases:
        if len(case["bodies"]) == 1:
            write(case)
    threshold(next(case for case in cases if case["name"] == "drawer_left_rail_tight"))


main()
