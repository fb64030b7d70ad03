#!/usr/bin/env python3
"""Mechanisms of hinges.toml whose hinges and guides are springs: writes elastic-hinges.toml.

    python3 -m venv venv && venv/bin/pip install numpy scipy
    venv/bin/python reference/elastic_hinges.py > reference/elastic-hinges.toml

Written without slideway: Newton's and Euler's equations of every body with finite rotations. Each hinge is a spring and a damper
in both directions, each contact one across its guide, all of stiffness K:

    R = -K d - C d',     N = -K g - C g',     C = 2 D sqrt(K m),

with the displacement d of the pin and g of the contact across its guide, and the mass m of the bar. Nothing is rigid, so every
state has exactly one answer: there is no choice among the solutions of the rigid mechanism. Friction is Coulomb's: the couple
of a hinge is -r |R| against the sense of its rotation, the force of a contact -mu |N| against its sliding. Bodies without mass
get SMALL times that of the bar.

About each solution of the rigid mechanism the springs begin with its forces times 1 - PART and 1 + PART, at the velocities of the
rigid mechanism. Told is the solution on which the forces settle, by its number, or "stops": a sliding velocity or a spin changes
its sign first.
"""
import pathlib
import tomllib

import numpy as np
from scipy.integrate import solve_ivp

# Cases with several solutions. Without bar_block_2: of its determinants, 0.1 and -0.02, the small masses move the second solution by
# a fifth.
CASES = ["pendulum_2", "bar_block_3"]
K = 1e9
D = 1.0
SMALL = 1e-3
PART = 0.01
UNTIL = 1e-3
RTOL = 1e-6
# Forces that come within this of those of a solution settle on it.
NEAR = 0.03


def turned(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def across(vector):
    return np.array([-vector[1], vector[0]])


class Elastic:
    """A case with springs; the state has the poses of the bodies, then their velocities."""

    def __init__(self, case):
        self.case = case
        self.bodies = [body["name"] for body in case["bodies"]]
        self.mass = max(body["m"] for body in case["bodies"])
        inertia = max(body["J"] for body in case["bodies"])
        self.inertia = np.array(
            [value for body in case["bodies"] for value in [body["m"] or SMALL * self.mass] * 2 + [body["J"] or SMALL * inertia]]
        )
        self.hinges = case.get("hinges", [])
        self.contacts = case.get("contacts", [])
        self.pose = np.array([value for body in case["bodies"] for value in body["pose"]])
        self.velocity = np.array([value for body in case["bodies"] for value in body["vel"]])

    def point(self, body, at, pose, velocity):
        """Place and velocity of a point that a body carries."""
        if body == "ground":
            return np.array(at), np.zeros(2)
        first = 3 * self.bodies.index(body)
        arm = turned(pose[first + 2]) @ np.array(at)
        return pose[first : first + 2] + arm, velocity[first : first + 2] + velocity[first + 2] * across(arm)

    def spin(self, body, velocity):
        return 0.0 if body == "ground" else velocity[3 * self.bodies.index(body) + 2]

    def push(self, loads, body, at, pose, force, couple=0.0):
        """Adds a force at a place, and a couple, to the loads of a body."""
        if body == "ground":
            return
        first = 3 * self.bodies.index(body)
        arm = at - pose[first : first + 2]
        loads[first : first + 3] += [force[0], force[1], arm[0] * force[1] - arm[1] * force[0] + couple]

    def gaps(self, pose, velocity):
        """Displacements across the joints, with their rates: two of each hinge, one of each contact."""
        gaps, rates = [], []
        for hinge in self.hinges:
            one, its = self.point(hinge["a"], hinge["pa"], pose, velocity)
            other, others = self.point(hinge["b"], hinge["pb"], pose, velocity)
            gaps += list(other - one)
            rates += list(others - its)
        for contact in self.contacts:
            place, its = self.point(contact["block"], contact["P"], pose, velocity)
            normal = turned(contact["angle"])[:, 1]
            gaps.append(normal @ (place - contact["O"]))
            rates.append(normal @ its)
        return np.array(gaps), np.array(rates)

    def motions(self, velocity, pose):
        """Spins of hinges and sliding velocities of contacts."""
        spins = [self.spin(hinge["b"], velocity) - self.spin(hinge["a"], velocity) for hinge in self.hinges]
        slides = [turned(c["angle"])[:, 0] @ self.point(c["block"], c["P"], pose, velocity)[1] for c in self.contacts]
        return np.array(spins + slides)

    def forces(self, pose, velocity):
        gaps, rates = self.gaps(pose, velocity)
        return -K * gaps - 2 * D * np.sqrt(K * self.mass) * rates

    def accelerations(self, pose, velocity, senses):
        """`senses`: of the hinges, then of the contacts; they change at the end of a run only."""
        loads = np.zeros(len(pose))
        for place, body in enumerate(self.case["bodies"]):
            loads[3 * place : 3 * place + 2] += body["m"] * np.array(self.case["gravity"])
        for force in self.case.get("forces", []):
            at = self.point(force["body"], force["at"], pose, velocity)[0]
            self.push(loads, force["body"], at, pose, force["F"], force["torque"])
        reaction = self.forces(pose, velocity)
        for place, hinge in enumerate(self.hinges):
            force = reaction[2 * place : 2 * place + 2]
            couple = -senses[place] * hinge["r"] * np.hypot(*force)
            for body, at, sign in [(hinge["b"], hinge["pb"], 1), (hinge["a"], hinge["pa"], -1)]:
                self.push(loads, body, self.point(body, at, pose, velocity)[0], pose, sign * force, sign * couple)
        for place, contact in enumerate(self.contacts):
            force = reaction[2 * len(self.hinges) + place]
            along, normal = turned(contact["angle"]).T
            friction = -senses[len(self.hinges) + place] * contact["mu"] * abs(force) * along
            at = self.point(contact["block"], contact["P"], pose, velocity)[0] - np.sign(force) * contact["half_height"] * normal
            self.push(loads, contact["block"], at, pose, force * normal + friction)
        return loads / self.inertia

    def begin(self, forces):
        """The pose nearest to that of the rigid mechanism in which the springs have these forces."""
        pose = self.pose.copy()
        for _ in range(20):
            gaps, _ = self.gaps(pose, self.velocity)
            slopes = np.array([self.gaps(pose, unit)[1] for unit in np.eye(len(pose))]).T
            pose = pose + np.linalg.pinv(slopes) @ (-forces / K - gaps)
        return pose

    def follow(self, forces):
        """Where the forces end that begin so: their values, and whether a joint stopped."""
        size = len(self.pose)
        start = self.begin(forces)
        senses = np.sign(self.motions(self.velocity, self.pose))

        def slope(_, state):
            return np.concatenate([state[size:], self.accelerations(state[:size], state[size:], senses)])

        stops = [
            lambda _, state, k=k: senses[k] * self.motions(state[size:], state[:size])[k] for k in range(len(senses))
        ]
        for stop in stops:
            stop.terminal, stop.direction = True, -1
        # Displacements make forces by the stiffness, their rates by the damping.
        force = self.mass * np.hypot(*self.case["gravity"])
        errors = np.repeat(RTOL * force / np.array([K, np.sqrt(K * self.mass)]), size)
        run = solve_ivp(
            slope, (0, UNTIL), np.concatenate([start, self.velocity]), "Radau", rtol=RTOL, atol=errors, events=stops
        )
        state = run.y[:, -1]
        return self.forces(state[:size], state[size:]), run.status == 1


def main():
    folder = pathlib.Path(__file__).parent
    cases = {case["name"]: case for case in tomllib.loads((folder / "hinges.toml").read_text())["case"]}
    print("# Written by elastic_hinges.py: for each solution, where the forces settle that begin a little below and above it.")
    for case in map(cases.get, CASES):
        elastic = Elastic(case)
        known = [np.concatenate([np.ravel(one["R"]), one["N"]]) for one in case["solution"]]
        ends = []
        for solution in known:
            pair = []
            for factor in [1 - PART, 1 + PART]:
                forces, stopped = elastic.follow(factor * solution)
                away = [np.linalg.norm(forces - one) / np.linalg.norm(one) for one in known]
                nearest = int(np.argmin(away))
                pair.append("stops" if stopped else nearest + 1 if away[nearest] < NEAR else "elsewhere")
            ends.append(pair)
        words = ", ".join("[" + ", ".join(f'"{end}"' for end in pair) + "]" for pair in ends)
        print(f"\n[[case]]\nname = \"{case['name']}\"\nsettles_on = [{words}]")


if __name__ == "__main__":
    main()
