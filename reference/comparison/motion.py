#!/usr/bin/env python3
"""Motion of a slider-crank whose piston rubs: slideway beside Exudyn, a general multibody code with a user force.

    python3 -m venv venv && venv/bin/pip install exudyn numpy
    cargo build --release
    venv/bin/python reference/comparison/motion.py        writes the table of "Motion" in docs/src/comparison.md

Both codes start from the same state (models/slider-crank.toml with gas = 0, T = 0) and are compared at t = 0.2 s with
reference/slider-crank-motion.toml, an independent integration with a relative tolerance of 1e-13. Exudyn has no joint whose
friction depends on the load, so that mu |N| comes from a user function in Python that reads the constraint's force;
its integrator is the generalized-alpha method with fixed steps. slideway is run as a program; what it takes to start and
to read the model is measured by itself and not counted. Nothing is installed here.
"""
import json
import math
import os
import subprocess
import sys
import time
import tomllib
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
END = 0.2
R, L, SKIRT, BORE, MU, G = 0.05, 0.18, 0.06, 0.08, 0.1, 9.81
M_CRANK, M_ROD, M_PISTON = 2.0, 0.6, 0.8
I_CRANK = M_CRANK * (1.5 * R) ** 2 / 2
I_ROD = M_ROD * L * L / 12
I_PISTON = M_PISTON * (SKIRT**2 + BORE**2) / 12
PHI, OMEGA = math.radians(60), 100.0


def reference():
    table = tomllib.loads((TOP / "reference/slider-crank-motion.toml").read_text())
    return next(sample["phi"] for sample in table["sample"] if sample["time"] == END)


def exudyn(step):
    """Crank angle at the end, and seconds it took."""
    import exudyn as exu
    import exudyn.itemInterface as ei
    import numpy as np

    container = exu.SystemContainer()
    mbs = container.AddSystem()
    ground = mbs.AddObject(ei.ObjectGround())
    beta = math.asin(R * math.sin(PHI) / L)
    turning = R * math.cos(PHI) / (L * math.cos(beta)) * OMEGA
    a = np.array([R * math.cos(PHI), R * math.sin(PHI)])
    b = a + L * np.array([math.cos(beta), -math.sin(beta)])
    v_a = OMEGA * np.array([-a[1], a[0]])
    v_b = v_a - turning * L * np.array([math.sin(beta), math.cos(beta)])

    def body(mass, inertia, place, angle, velocity, rate):
        node = mbs.AddNode(ei.NodeRigidBody2D(referenceCoordinates=[*place, angle], initialVelocities=[*velocity, rate]))
        return node, mbs.AddObject(ei.ObjectRigidBody2D(mass=mass, inertia=inertia, nodeNumber=node))

    n_crank, crank = body(M_CRANK, I_CRANK, [0, 0], PHI, [0, 0], OMEGA)
    _, rod = body(M_ROD, I_ROD, (a + b) / 2, -beta, (v_a + v_b) / 2, -turning)
    n_piston, piston = body(M_PISTON, I_PISTON, b, 0, v_b, 0)

    def marker(item, place):
        return mbs.AddMarker(ei.MarkerBodyRigid(bodyNumber=item, localPosition=[*place, 0]))

    for first, second in [
        (marker(crank, [0, 0]), marker(ground, [0, 0])),
        (marker(rod, [-L / 2, 0]), marker(crank, [R, 0])),
        (marker(piston, [0, 0]), marker(rod, [L / 2, 0])),
    ]:
        mbs.AddObject(ei.ObjectJointRevolute2D(markerNumbers=[first, second]))
    origin = mbs.AddNode(ei.NodePointGround())
    fixed = mbs.AddMarker(ei.MarkerNodeCoordinate(nodeNumber=origin, coordinate=0))
    guide = [
        mbs.AddObject(
            ei.ObjectConnectorCoordinate(
                markerNumbers=[fixed, mbs.AddMarker(ei.MarkerNodeCoordinate(nodeNumber=n_piston, coordinate=k))]
            )
        )
        for k in (1, 2)
    ]
    for item in (rod, piston):
        mass = mbs.AddMarker(ei.MarkerBodyMass(bodyNumber=item))
        mbs.AddLoad(ei.LoadMassProportional(markerNumber=mass, loadVector=[0, -G, 0]))

    def friction(mbs, _time, _load):
        normal = mbs.GetObjectOutput(guide[0], exu.OutputVariableType.Force)
        velocity = mbs.GetNodeOutput(n_piston, exu.OutputVariableType.Velocity)[0]
        return [-MU * abs(normal) * (1 if velocity > 0 else -1), 0, 0]

    mbs.AddLoad(
        ei.LoadForceVector(markerNumber=marker(piston, [0, 0]), loadVector=[0, 0, 0], loadVectorUserFunction=friction)
    )
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.timeIntegration.numberOfSteps = round(END / step)
    settings.timeIntegration.endTime = END
    settings.timeIntegration.verboseMode = 0
    settings.solutionSettings.writeSolutionToFile = False
    settings.timeIntegration.newton.useModifiedNewton = True
    settings.timeIntegration.generalizedAlpha.spectralRadius = 0.9
    start = time.perf_counter()
    try:
        mbs.SolveDynamic(settings)
    except Exception:  # Newton's method does not converge
        return None, None
    taken = time.perf_counter() - start
    return mbs.GetNodeOutput(n_crank, exu.OutputVariableType.Coordinates)[2] + PHI, taken


def slideway(tolerance, until):
    """Crank angle at the end, and seconds it took; the best of five."""
    program = os.environ.get("SLIDEWAY", TOP / "target/release/slideway")
    command = [program, "simulate", TOP / "models/slider-crank.toml", "--set", "gas=0 N", "--set", "T=0 N m"]
    command += ["--until", f"{until!r} s", "--tolerance", repr(tolerance), "--longest-step", "2 ms", "--format", "json"]
    best = math.inf
    for _ in range(5):
        start = time.perf_counter()
        run = subprocess.run(command, check=True, capture_output=True, text=True)
        best = min(best, time.perf_counter() - start)
    last = json.loads(run.stdout)["last"]
    return next(coordinate["value"] for coordinate in last if coordinate["name"] == "phi"), best


def main():
    expected = reference()
    rows = []
    _, idle = slideway(1e-8, 1e-9)
    for tolerance in (1e-4, 1e-6, 1e-8, 1e-10):
        phi, taken = slideway(tolerance, END)
        rows.append((f"slideway, tolerance {tolerance:.0e}", abs(phi - expected), END / max(taken - idle, 1e-4)))
    try:
        for step in (1e-4, 5e-5, 2e-5, 1e-5, 5e-6):
            phi, taken = exudyn(step)
            name = f"Exudyn, step {step:.0e} s"
            rows.append((name, *((None, None) if phi is None else (abs(phi - expected), END / taken))))
    except ImportError:
        print("Exudyn is not installed: see the top of this script", file=sys.stderr)
        return 1
    lines = [
        "| code | error of the crank angle at 0.2 s (rad) | simulated seconds for a second |",
        "|---|---:|---:|",
    ]
    for name, error, speed in rows:
        told = ("does not converge", "") if error is None else (f"{error:.1e}", f"{speed:.2g}")
        lines.append(f"| {name} | {told[0]} | {told[1]} |")
    page = TOP / "docs/src/comparison.md"
    before, rest = page.read_text().split(lines[0] + "\n")
    after = rest[rest.index("\n\n") :]
    page.write_text(before + "\n".join(lines) + after)
    return 0


if __name__ == "__main__":
    sys.exit(main())
