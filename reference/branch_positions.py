"""Positions of crates/slideway/tests/mechanisms/branch.toml on the assembly branch of its drawing.

Independent of slideway: four equations in the unknowns (x, y, angle) of b0 and the angle of b1, which turns about its
hinge; Newton's method in 20,000 equal steps of the coordinate, so that neighbouring states differ by less than 1e-3.
Prints q0, the poses (centre of mass, angle) of b0 and b1, and the determinant of the four equations.
"""

import tomllib
from pathlib import Path

import numpy as np

MODEL = Path(__file__).parent.parent / "crates/slideway/tests/mechanisms/branch.toml"
WANTED = [-0.0265, -0.0615, -0.117, -0.1217, -0.1256]
STEPS = 20_000

model = tomllib.loads(MODEL.read_text())
joints = model["joints"]
pivot = np.array(model["points"]["p0"])
centres = [np.array(model["bodies"][name]["centre_of_mass"]) for name in ("b0", "b1")]


def turned(angle, vector):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


def rot90(v):
    return np.array([-v[1], v[0]])


def residual(z, q):
    origin, guide, arm = z[:2], z[2], z[3]
    on_b0 = lambda p: origin + turned(guide, p - centres[0])
    on_b1 = lambda p: pivot + turned(arm, p - pivot)
    rows = []
    for name, block in (("s0", lambda p: p), ("s1", on_b1), ("s3", on_b1)):
        joint = joints[name]
        at = np.array(joint["at"])
        tangent = turned(guide, [np.cos(joint["along"]), np.sin(joint["along"])])
        between = block(at) - on_b0(at)
        rows.append(rot90(tangent) @ between)
    return np.array([*rows, tangent @ between - q])


def jacobian(z, q):
    # Complex steps: exact to rounding.
    step = 1e-30
    return np.array([residual(z + 1j * step * e, q).imag / step for e in np.eye(4)]).T


def newton(z, q):
    for _ in range(4):
        z = z - np.linalg.solve(jacobian(z, q), residual(z, q))
    return z


z, q = np.array([*centres[0], 0.0, 0.0]), 0.0
for wanted in WANTED:
    count = max(1, int(STEPS * abs(wanted - q) / abs(WANTED[-1])))
    for value in np.linspace(q, wanted, count + 1)[1:]:
        before, z = z, newton(z, value)
        assert np.abs(z - before).max() < 1e-3, value
    q = wanted
    b1 = pivot + turned(z[3], centres[1] - pivot)
    print(q, *(f"{number:.12f}" for number in (*z[:3], *b1, z[3])), f"{np.linalg.det(jacobian(z, q)):.4f}")
