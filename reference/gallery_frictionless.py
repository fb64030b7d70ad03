#!/usr/bin/env python3
"""Frictionless reference numbers for the gallery (models/*.toml), by a formulation of their own.

    python3 -m venv venv && venv/bin/pip install -r reference/requirements.txt
    venv/bin/python reference/gallery_frictionless.py        # writes reference/gallery-frictionless.toml

Accelerations come from Lagrange's equations in minimal coordinates: for every mechanism the positions are
written as functions of its coordinates by hand, T and V follow, SymPy differentiates, mpmath evaluates with 50 digits.
No constraint Jacobian, no multipliers. The reactions then come from free-body balances of each body, written out
and solved by hand. At the end every body's three balance equations are summed up once more from its full list
of forces, including those equations that were not needed for the reactions; they must vanish to 1e-40. Those
left over tie the reactions to Lagrange's accelerations.

Conventions: u is the `along` direction of a sliding joint, n = u turned by +90 degrees. N acts on the block along +n, its
opposite on the guide. front is the contact at the +u end, rear the one at the -u end. A guided slider has
N at its `at` point and a couple C on the block, counter-clockwise. A hinge force acts on the first-named body.
A drive's value is the magnitude of its force along its direction.

The parameters below are copied from the model files; the script stops if a file says something else.
"""
import sys
import tomllib
from pathlib import Path

import mpmath as mp
import sympy as sp

HERE = Path(__file__).resolve().parent
MODELS = HERE.parent / "models"
DIGITS = 50
mp.mp.dps = DIGITS
TOLERANCE = mp.mpf(10) ** -40

UNITS = {
    "": 1, "m": 1, "mm": sp.Rational(1, 1000), "kg": 1, "N": 1, "kN": 1000, "N m": 1, "m/s": 1, "m/s^2": 1, "rad/s": 1,
    "N/m": 1, "N s/m": 1, "deg": sp.pi / 180,
}


def value(text, names=None):
    """An exact number from a text such as '150 deg' or '0.2*l'."""
    text = str(text).strip()
    number, _, unit = text.partition(" ")
    try:
        return sp.Rational(number) * UNITS[unit.strip()]
    except (TypeError, ValueError):
        return sp.nsimplify(sp.sympify(text, locals=dict(names or {})), rational=True)


def parameters(texts, overrides):
    p = {}
    for name in {**texts}:
        p[name] = value(overrides.get(name, texts[name]), p)
    unknown = set(overrides) - set(texts)
    assert not unknown, unknown
    return p


def number(expr):
    return sp.N(expr, DIGITS + 10)


def vec(*components):
    return sp.Matrix(components)


def rot90(w):
    return vec(-w[1], w[0])


def unit(angle):
    return vec(sp.cos(angle), sp.sin(angle))


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


class Body:
    """A body by its mass, central moment of inertia, and the position of its mass centre and its angle in terms of q."""

    def __init__(self, mass, inertia, centre, angle):
        self.mass, self.inertia, self.centre, self.angle = sp.sympify(mass), sp.sympify(inertia), centre, sp.sympify(angle)


class Lagrange:
    """d/dt dT/dv - dT/dq + dV/dq = Q in the minimal coordinates q; v and w are the first and second derivatives."""

    def __init__(self, names):
        self.names = names
        self.q = sp.symbols(["q_" + n for n in names], real=True)
        self.v = sp.symbols(["v_" + n for n in names], real=True)
        self.w = sp.symbols(["w_" + n for n in names], real=True)

    def ddt(self, e):
        f = lambda x: sum(sp.diff(x, q) * v + sp.diff(x, v) * w for q, v, w in zip(self.q, self.v, self.w))
        return e.applyfunc(f) if isinstance(e, sp.MatrixBase) else f(e)

    def setup(self, bodies, gravity, extra_potential, state):
        """Fixes the state {name: (value, rate)} and forms the left-hand side of the equations."""
        self.bodies = bodies
        T = V = sp.Integer(0)
        for b in bodies.values():
            c, phi = self.ddt(b.centre), self.ddt(b.angle)
            T += b.mass * c.dot(c) / 2 + b.inertia * phi**2 / 2
            V += b.mass * gravity * b.centre[1]
        V += extra_potential
        self.lhs = [self.ddt(sp.diff(T, v)) - sp.diff(T, q) + sp.diff(V, q) for q, v in zip(self.q, self.v)]
        self.state = {q: state[n][0] for q, n in zip(self.q, self.names)}
        self.state |= {v: state[n][1] for v, n in zip(self.v, self.names)}

    def power(self, point, force):
        """Generalized forces of a force that acts at a point whose position is given in terms of q."""
        return [sum(sp.diff(point[i], q) * force[i] for i in range(2)) for q in self.q]

    def solve(self, generalized_forces):
        """The accelerations; generalized_forces is a list of lists, one entry per coordinate each."""
        residual = [number((l - sum(f[i] for f in generalized_forces)).subs(self.state)) for i, l in enumerate(self.lhs)]
        n = len(self.w)
        zero = {w: 0 for w in self.w}
        M = mp.matrix(n, n)
        b = mp.matrix(n, 1)
        for i in range(n):
            b[i] = -mp.mpf(sp.N(residual[i].subs(zero), DIGITS))
            for j in range(n):
                M[i, j] = mp.mpf(sp.N(sp.diff(residual[i], self.w[j]), DIGITS))
        w = mp.lu_solve(M, b)
        return self.accept([w[i] for i in range(n)])

    def accept(self, w):
        for s, x in zip(self.w, w):
            self.state[s] = sp.Float(str(x), DIGITS + 5) if not isinstance(x, int) else x
        self.w_value = w
        return w

    def at(self, e):
        """Numbers of an expression or vector in the state."""
        if isinstance(e, sp.MatrixBase):
            return e.applyfunc(self.at)
        return number(sp.sympify(e).subs(self.state))

    def accelerations(self):
        """Of each body: [ax, ay, alpha]."""
        out = {}
        for name, b in self.bodies.items():
            c = self.at(self.ddt(self.ddt(b.centre)))
            out[name] = [c[0], c[1], self.at(self.ddt(self.ddt(b.angle)))]
        return out


class FreeBodies:
    """Collects all forces and couples of every body and checks the three balance equations of each."""

    def __init__(self, system):
        self.s = system
        self.f = {name: vec(0, 0) for name in system.bodies}
        self.m = {name: sp.Integer(0) for name in system.bodies}

    def force(self, body, point, force, opposite_on=None):
        for name, sign in ((body, 1), (opposite_on, -1)):
            if name is not None and name != "ground":
                self.f[name] += sign * force
                self.m[name] += sign * cross(point - self.s.at(self.s.bodies[name].centre), force)

    def couple(self, body, moment):
        self.m[body] += moment

    def weight(self, g):
        for name, b in self.s.bodies.items():
            self.f[name] += vec(0, -b.mass * g)

    def check(self):
        worst = mp.mpf(0)
        for name, (ax, ay, alpha) in self.s.accelerations().items():
            b = self.s.bodies[name]
            residuals = [
                number(b.mass * ax - self.f[name][0]), number(b.mass * ay - self.f[name][1]), number(b.inertia * alpha - self.m[name]),
            ]
            for r in residuals:
                worst = max(worst, abs(mp.mpf(r)))
        assert worst < TOLERANCE, f"balance violated by {mp.nstr(worst, 5)}"
        return worst


def bar_inertia(m, length):
    return m * length**2 / 12


def rectangle_inertia(m, w, h):
    return m * (w**2 + h**2) / 12


def disc_inertia(m, r):
    return m * r**2 / 2


# ------------------------------------------------------------------------------------------------ slider-crank

SLIDER_CRANK = dict(
    r="50 mm", l="180 mm", m_crank="2 kg", m_rod="0.6 kg", m_piston="0.8 kg", skirt="60 mm", bore="80 mm", mu="0.1", gas="-1 kN",
    T="20 N m", g="9.81 m/s^2", phi_drawn="60 deg", omega="100 rad/s",
)


def slider_crank(p, at, rate):
    S = Lagrange(["phi"])
    (phi,) = S.q
    r, l, g = p["r"], p["l"], p["g"]
    psi = -sp.asin(r * sp.sin(phi) / l)                      # inclination of the rod, A to B
    A = r * unit(phi)
    B = vec(r * sp.cos(phi) + sp.sqrt(l**2 - (r * sp.sin(phi)) ** 2), 0)
    bodies = {
        "crank": Body(p["m_crank"], disc_inertia(p["m_crank"], sp.Rational(3, 2) * r), vec(0, 0), phi),
        "rod": Body(p["m_rod"], bar_inertia(p["m_rod"], l), (A + B) / 2, psi),
        "piston": Body(p["m_piston"], rectangle_inertia(p["m_piston"], p["skirt"], p["bore"]), B, 0),
    }
    S.setup(bodies, g, 0, {"phi": (at.get("phi", p["phi_drawn"]), rate.get("phi", p["omega"]))})
    gas = vec(p["gas"], 0)
    S.solve([S.power(B, gas), [p["T"]]])
    a = S.accelerations()
    A, B = S.at(A), S.at(B)
    m_p, m_r, m_c = p["m_piston"], p["m_rod"], p["m_crank"]
    G = (A + B) / 2
    # Piston along x: HBx + gas = m ax.
    HBx = m_p * a["piston"][0] - p["gas"]
    # Rod along x: HAx - HBx = m ax.
    HAx = m_r * a["rod"][0] + HBx
    # Rod, moments about A:  (G - A) x m (a_G + g j) + I alpha = (B - A) x (-HB), unknown HBy.
    lhs = cross(G - A, m_r * vec(a["rod"][0], a["rod"][1] + g)) + bodies["rod"].inertia * a["rod"][2]
    d = B - A
    HBy = -(lhs - d[1] * HBx) / d[0]
    # Rod along y: HAy - HBy - m g = m ay.
    HAy = m_r * (a["rod"][1] + g) + HBy
    # Crank, mass centre at rest: HO - HA - m g = 0.
    HO = vec(HAx, HAy + m_c * g)
    # Piston along y: N + HBy - m g = 0; moments about B: the two ends bear equally.
    N = m_p * g - HBy
    front = rear = N / 2
    F = FreeBodies(S)
    F.weight(g)
    half = vec(p["skirt"] / 2, 0)
    F.force("piston", B + half, vec(0, front))
    F.force("piston", B - half, vec(0, rear))
    F.force("piston", B, vec(HBx, HBy), "rod")
    F.force("rod", A, vec(HAx, HAy), "crank")
    F.force("crank", vec(0, 0), HO)
    F.force("piston", B, gas)
    F.couple("crank", p["T"])
    return S, F, dict(
        normal_forces={"cylinder.front": front, "cylinder.rear": rear},
        hinges={"O": HO, "A": vec(HAx, HAy), "B": vec(HBx, HBy)},
    )


# ---------------------------------------------------------------------------------------------- sleeve-on-arm

SLEEVE = dict(
    phi_drawn="25 deg", s_drawn="0.3 m", l="0.8 m", m_arm="1.2 kg", m_sleeve="0.7 kg", L="80 mm", d="20 mm", e="30 mm", mu="0.2",
    T="6 N m", g="9.81 m/s^2", omega="3 rad/s", v="0.4 m/s",
)


def sleeve_on_arm(p, at, rate):
    S = Lagrange(["phi", "s"])
    phi, s = S.q
    g, L, e = p["g"], p["L"], p["e"]
    u = unit(phi)
    n = rot90(u)
    bodies = {
        "arm": Body(p["m_arm"], bar_inertia(p["m_arm"], p["l"]), p["l"] / 2 * u, phi),
        "sleeve": Body(p["m_sleeve"], rectangle_inertia(p["m_sleeve"], L, value("60 mm")), s * u + e * n, phi),
    }
    S.setup(bodies, g, 0, {
        "phi": (at.get("phi", p["phi_drawn"]), rate.get("phi", p["omega"])),
        "s": (at.get("s", p["s_drawn"]), rate.get("s", p["v"])),
    })
    S.solve([[p["T"], 0]])
    a = S.accelerations()
    C = S.at(s * u)
    u, n = S.at(u), S.at(n)
    # Sleeve across the arm: (front + rear) = m (a_S - g_vector) . n; about S: (front - rear) L/2 = I alpha.
    total = p["m_sleeve"] * vec(a["sleeve"][0], a["sleeve"][1] + g).dot(n)
    difference = 2 * bodies["sleeve"].inertia * a["sleeve"][2] / L
    front, rear = (total + difference) / 2, (total - difference) / 2
    # Arm: HO - (front + rear) n - m g j = m a.
    HO = p["m_arm"] * vec(a["arm"][0], a["arm"][1] + g) + total * n
    F = FreeBodies(S)
    F.weight(g)
    F.force("sleeve", C + L / 2 * u, front * n, "arm")
    F.force("sleeve", C - L / 2 * u, rear * n, "arm")
    F.force("arm", vec(0, 0), HO)
    F.couple("arm", p["T"])
    return S, F, dict(normal_forces={"sleeve.front": front, "sleeve.rear": rear}, hinges={"O": HO})


# -------------------------------------------------------------------------------------------- elliptic-trammel

TRAMMEL = dict(l="0.5 m", m="2 kg", mu="0.2", g="9.81 m/s^2", theta_drawn="55 deg", omega="-1 rad/s")


def elliptic_trammel(p, at, rate):
    # The coordinate is the direction of A to B, 180 deg - theta_drawn in the drawing; counter-clockwise is positive.
    S = Lagrange(["theta"])
    (theta,) = S.q
    l, m, g = p["l"], p["m"], p["g"]
    A = vec(-l * sp.cos(theta), 0)
    B = vec(0, l * sp.sin(theta))
    S.setup({"rod": Body(m, bar_inertia(m, l), (A + B) / 2, theta)}, g, 0,
            {"theta": (at.get("theta", sp.pi - p["theta_drawn"]), rate.get("theta", -p["omega"]))})
    S.solve([])
    ax, ay, _ = S.accelerations()["rod"]
    # Horizontal slot: u = +x, n = +y. Vertical slot: u = +y, n = -x.
    horizontal = m * (ay + g)
    vertical = -m * ax
    F = FreeBodies(S)
    F.weight(g)
    F.force("rod", S.at(A), vec(0, horizontal))
    F.force("rod", S.at(B), vec(-vertical, 0))
    return S, F, dict(normal_forces={"horizontal": horizontal, "vertical": vertical})


# ------------------------------------------------------------------------------------------------- scotch-yoke

YOKE = dict(
    r="40 mm", m_crank="1.5 kg", m_yoke="1 kg", L="120 mm", h="30 mm", offset="100 mm", mu_pin="0.1", mu_yoke="0.15", Q="100 N",
    T="8 N m", g="9.81 m/s^2", phi_drawn="40 deg", omega="20 rad/s",
)


def scotch_yoke(p, at, rate):
    S = Lagrange(["phi"])
    (phi,) = S.q
    r, g, L, offset = p["r"], p["g"], p["L"], p["offset"]
    slot = vec(r * sp.cos(phi), 0)
    bodies = {
        "crank": Body(p["m_crank"], disc_inertia(p["m_crank"], sp.Rational(5, 4) * r), vec(0, 0), phi),
        "yoke": Body(p["m_yoke"], rectangle_inertia(p["m_yoke"], value("40 mm"), value("140 mm")), slot, 0),
    }
    S.setup(bodies, g, 0, {"phi": (at.get("phi", p["phi_drawn"]), rate.get("phi", p["omega"]))})
    guide = slot + vec(offset, 0)
    load = vec(-p["Q"], 0)
    S.solve([S.power(guide, load), [p["T"]]])
    a = S.accelerations()
    pin, slot, guide = S.at(r * unit(phi)), S.at(slot), S.at(guide)
    # Slot: u = +y, n = -x, N on the crank; the yoke gets +N along x:  N - Q = m ax.
    N = p["m_yoke"] * a["yoke"][0] + p["Q"]
    # Yoke along y: front + rear = m g; about the slot: front (offset + L/2) + rear (offset - L/2) - N pin_y = 0.
    total = p["m_yoke"] * g
    front = (N * pin[1] - total * (offset - L / 2)) / L
    rear = total - front
    HO = vec(N, p["m_crank"] * g)                              # crank at rest: HO - N i - m g j = 0
    F = FreeBodies(S)
    F.weight(g)
    F.force("crank", pin, vec(-N, 0), "yoke")
    F.force("crank", vec(0, 0), HO)
    F.force("yoke", guide + vec(L / 2, 0), vec(0, front))
    F.force("yoke", guide - vec(L / 2, 0), vec(0, rear))
    F.force("yoke", guide, load)
    F.couple("crank", p["T"])
    return S, F, dict(normal_forces={"pin": N, "yoke.front": front, "yoke.rear": rear}, hinges={"O": HO})


# --------------------------------------------------------------------------------------------- telescopic-boom

BOOM = dict(
    beta="20 deg", length="2 m", overlap="0.6 m", height="0.15 m", m="20 kg", W="300 N", F="400 N", mu="0.1", g="9.81 m/s^2",
    v="0.1 m/s",
)


def telescopic_boom(p, at, rate):
    names = ["s_1", "s_2", "s_3"]
    S = Lagrange(names)
    m, g, length, overlap, W, force = (p[k] for k in ("m", "g", "length", "overlap", "W", "F"))
    u = unit(p["beta"])
    n = rot90(u)
    # Distances along the boom from the mouth of the frame.
    shift = [sum(S.q[: i + 1]) for i in range(3)]
    tail = [i * length - (i + 1) * overlap + shift[i] for i in range(3)]
    tip = [t + length for t in tail]
    mouth = [sp.Integer(0), tip[0], tip[1]]                    # front contact of each joint
    bodies = {f"stage_{i + 1}": Body(m, bar_inertia(m, length), (tail[i] + length / 2) * u, 0) for i in range(3)}
    S.setup(bodies, g, 0, {k: (at.get(k, sp.Integer(0)), rate.get(k, p["v"])) for k in names})
    forces = [S.power(tip[2] * u, vec(0, -W))]
    for i in range(3):
        forces.append(S.power(tail[i] * u, force * u))
        if i > 0:
            # The opposite force acts on the stage before, at its material point that is at tail[i] now:
            # it moves with shift[i - 1].
            forces.append(S.power(shift[i - 1] * u, -force * u))
    S.solve(forces)
    S.accelerations()
    tail, tip, mouth = ([S.at(x) for x in xs] for xs in (tail, tip, mouth))
    u, n = S.at(u), S.at(n)
    weight_n = m * g * S.at(sp.cos(p["beta"]))
    # From the tip inwards; across the boom nothing accelerates. `acting` lists (place, force along n) on the stage.
    acting = [(tip[2], -W * S.at(sp.cos(p["beta"])))]
    normal = {}
    for i in (2, 1, 0):
        acting.append((tail[i] + length / 2, -weight_n))
        total = -sum(f for _, f in acting)                    # front + rear
        about_rear = -sum((x - tail[i]) * f for x, f in acting)
        front = about_rear / (mouth[i] - tail[i])
        rear = total - front
        normal[i] = (front, rear)
        acting = [(mouth[i], -front), (tail[i], -rear)]       # what the stage before receives
    F = FreeBodies(S)
    F.weight(g)
    out = {}
    for i in range(3):
        block, guide = f"stage_{i + 1}", (f"stage_{i}" if i else "ground")
        front, rear = normal[i]
        F.force(block, mouth[i] * u, front * n, guide)
        F.force(block, tail[i] * u, rear * n, guide)
        F.force(block, tail[i] * u, force * u, guide)
        out[f"slide_{i + 1}.front"], out[f"slide_{i + 1}.rear"] = front, rear
    F.force("stage_3", tip[2] * u, vec(0, -W))
    return S, F, dict(normal_forces=out)


# ----------------------------------------------------------------------------------------------------- drawer

DRAWER = dict(L="0.4 m", a="0.3 m", h="0 m", mu="0.3", Q="20 N", m="5 kg", v="0.1 m/s")


def drawer(p, at, rate):
    S = Lagrange(["x"])
    (x,) = S.q
    L, a, m, Q = p["L"], p["a"], p["m"], p["Q"]
    middle, handle = vec(x, 0), vec(x - L / 2, a)
    S.setup({"drawer": Body(m, rectangle_inertia(m, value("0.45 m"), value("0.7 m")), middle, 0)}, 0, 0,
            {"x": (at.get("x", sp.Integer(0)), rate.get("x", p["v"]))})
    S.accept([0])
    # Driven: Lagrange's equation gives the push V, for it does work V dx:  m w + Q = V with w = 0.
    push = S.at(S.lhs[0] - S.power(middle, vec(-Q, 0))[0]) / S.power(handle, vec(1, 0))[0]
    middle, handle = S.at(middle), S.at(handle)
    # Rear contact at the mouth, -L/2 in the frame; front contact with the drawer, at middle + L/2.
    front_at, rear_at = middle + vec(L / 2, 0), vec(-L / 2, 0)
    # front + rear = 0; about the middle: front L/2 + rear (rear_at - middle) - a V = 0.
    front = a * push / (front_at[0] - rear_at[0])
    rear = -front
    F = FreeBodies(S)
    F.force("drawer", front_at, vec(0, front))
    F.force("drawer", rear_at, vec(0, rear))
    F.force("drawer", handle, vec(push, 0))
    F.force("drawer", middle, vec(-Q, 0))
    return S, F, dict(normal_forces={"guide.front": front, "guide.rear": rear}, drives={"push": push})


# ----------------------------------------------------------------------------------------------- cam-follower

CAM = dict(phi="30 deg", B="80 mm", A="50 mm", d="12 mm", mu="0.15", Q="200 N", m="0.5 kg", v="0.2 m/s")


def cam_follower(p, at, rate):
    S = Lagrange(["lift"])
    (y,) = S.q
    A, B, Q, m = p["A"], p["B"], p["Q"], p["m"]
    length = A + B + value("40 mm")
    foot, top = vec(0, y), vec(0, y + length)
    S.setup({"stem": Body(m, bar_inertia(m, length), (foot + top) / 2, 0)}, 0, 0,
            {"lift": (at.get("lift", sp.Integer(0)), rate.get("lift", p["v"]))})
    S.accept([0])
    direction = unit(sp.pi / 2 - p["phi"])
    cam = S.at(S.lhs[0] - S.power(top, vec(0, -Q))[0]) / S.at(S.power(foot, direction)[0])
    foot, top, direction = S.at(foot), S.at(top), S.at(direction)
    # The bushing is the block: u = +y, n = -x, N on the bushing, so the stem gets +N along x.
    # front + rear + V sin(phi) = 0; about the rear contact: front B = V sin(phi) (rear_at - foot).
    front_at, rear_at = vec(0, A + B), vec(0, A)
    side = cam * direction[0]
    front = side * (rear_at[1] - foot[1]) / B
    rear = -side - front
    F = FreeBodies(S)
    F.force("stem", front_at, vec(front, 0))
    F.force("stem", rear_at, vec(rear, 0))
    F.force("stem", foot, cam * direction)
    F.force("stem", top, vec(0, -Q))
    return S, F, dict(normal_forces={"bushing.front": front, "bushing.rear": rear}, drives={"cam": cam})


# ------------------------------------------------------------------------------------------------- klepp-2002

KLEPP = dict(
    alpha="80 deg", m="1 kg", g="9.81 m/s^2", l="1 m", b="0.2*l", h="0.1*l", mu_1="0.5", mu_2="0.1", mu_3="0.1", F_10="0 N",
    F_20="m*g", F_30="0 N", P="0 N", k="0 N/m", c="0 N s/m", direction="1",
)


def klepp(p, at, rate):
    S = Lagrange(["q"])
    (q,) = S.q
    m, g, l, b = p["m"], p["g"], p["l"], p["b"]
    bar = l * unit(p["alpha"])
    A = vec(q, 0)
    G = A + bar / 2
    bodies = {"bar": Body(m, bar_inertia(m, l), G, 0), "lower_block": Body(0, 0, A, 0)}
    S.setup(bodies, g, p["k"] * q**2 / 2,                      # spring: horizontal, undeformed at q = 0
            {"q": (at.get("q", sp.Integer(0)), rate.get("q", p["direction"]))})
    load = vec(p["P"], 0)
    damper = vec(-p["c"] * S.v[0], 0)
    S.solve([S.power(G, load), S.power(G, damper)])
    A, G, bar = S.at(A), S.at(G), S.at(bar)
    spring = S.at(vec(-p["k"] * q, 0))
    damper = S.at(damper)
    # The massless block: H acts on the bar, -H on the block: Hx = 0, front + rear = Hy; about A: front = rear.
    # Bar, about its mass centre: (N1 - Hy) l/2 cos(alpha) + Hx l/2 sin(alpha) = 0; along y: N1 + Hy = m g.
    Hx = sp.Integer(0)
    N1 = Hy = m * g / 2
    front = rear = Hy / 2
    F = FreeBodies(S)
    F.weight(g)
    F.force("bar", A + bar, vec(0, N1))
    F.force("bar", A, vec(Hx, Hy), "lower_block")
    F.force("lower_block", A + vec(b / 2, 0), vec(0, front))
    F.force("lower_block", A - vec(b / 2, 0), vec(0, rear))
    F.force("bar", G, load + spring + damper)
    return S, F, dict(normal_forces={"upper": N1, "lower.front": front, "lower.rear": rear}, hinges={"A": vec(Hx, Hy)})


# --------------------------------------------------------------------------------------------- painleve-klein

PAINLEVE = dict(
    phi="30 deg", l="0.4 m", m_1="1 kg", m_2="1 kg", mu="0.5", mu_lower="0", P_1="0 N", P_2="10 N", direction="1",
)


def painleve_klein(p, at, rate):
    S = Lagrange(["x"])
    (x,) = S.q
    l, m1, m2 = p["l"], p["m_1"], p["m_2"]
    A = vec(x, 0)
    B = A + l * unit(p["phi"])
    w, h = value("60 mm"), value("20 mm")
    bodies = {
        "upper_slider": Body(m1, rectangle_inertia(m1, w, h), B, 0),
        "lower_slider": Body(m2, rectangle_inertia(m2, w, h), A, 0),
        "rod": Body(0, 0, (A + B) / 2, 0),
    }
    S.setup(bodies, 0, 0, {"x": (at.get("x", sp.Integer(0)), rate.get("x", p["direction"]))})
    f1, f2 = vec(p["P_1"], 0), vec(p["P_2"], 0)
    S.solve([S.power(B, f1), S.power(A, f2)])
    a = S.accelerations()["lower_slider"][0]
    A, B = S.at(A), S.at(B)
    # Lower slider: m2 a = P2 - HAx. The massless rod bears only along its axis: HA = -HB = HAx (1, tan(phi)).
    HAx = p["P_2"] - m2 * a
    HA = vec(HAx, HAx * S.at(sp.tan(p["phi"])))
    HB = -HA
    upper, lower = HB[1], HA[1]                                # N + (-H) = 0 across both guides
    F = FreeBodies(S)
    F.force("rod", A, HA, "lower_slider")
    F.force("rod", B, HB, "upper_slider")
    F.force("upper_slider", B, vec(0, upper))
    F.force("lower_slider", A, vec(0, lower))
    F.force("upper_slider", B, f1)
    F.force("lower_slider", A, f2)
    # The hinges sit at the `at` points, the sliders do not turn: no couple is left.
    return S, F, dict(normal_forces={"upper": upper, "lower": lower}, couples={"upper": sp.Integer(0), "lower": sp.Integer(0)},
                      hinges={"A": HA, "B": HB})


# ------------------------------------------------------------------------------------------------------- cases

NO_MU = {"mu": "0"}
NO_YOKE = {"mu_pin": "0", "mu_yoke": "0"}
NO_KLEPP = {"mu_1": "0", "mu_2": "0", "mu_3": "0", "F_20": "0"}
CASES = [
    # model, function, parameters, set, at, rate
    ("slider-crank", slider_crank, SLIDER_CRANK, [
        (NO_MU, {}, {}),
        (NO_MU, {"phi": "150 deg"}, {}),
        (NO_MU, {"phi": "150 deg"}, {"phi": "40"}),
        (NO_MU, {"phi": "-75 deg"}, {"phi": "-60"}),
        (NO_MU | {"gas": "-250 N", "T": "-3 N m", "l": "120 mm"}, {"phi": "235 deg"}, {"phi": "12.5"}),
    ]),
    ("sleeve-on-arm", sleeve_on_arm, SLEEVE, [
        (NO_MU, {}, {}),
        (NO_MU, {}, {"phi": "6", "s": "0.5"}),
        (NO_MU, {"phi": "70 deg", "s": "0.45"}, {"phi": "6", "s": "0.5"}),
        (NO_MU, {"phi": "-160 deg", "s": "0.62"}, {"phi": "-4.5", "s": "-1.25"}),
        (NO_MU | {"e": "-45 mm", "T": "0", "m_sleeve": "1.9 kg"}, {"phi": "110 deg"}, {"phi": "2", "s": "-0.75"}),
    ]),
    ("elliptic-trammel", elliptic_trammel, TRAMMEL, [
        (NO_MU, {}, {}),
        (NO_MU, {}, {"theta": "-2"}),
        (NO_MU, {"theta": "100 deg"}, {"theta": "3.5"}),
        (NO_MU, {"theta": "160 deg"}, {"theta": "-5"}),
        (NO_MU | {"theta_drawn": "35 deg", "omega": "2.5"}, {}, {}),
    ]),
    ("scotch-yoke", scotch_yoke, YOKE, [
        (NO_YOKE, {}, {}),
        (NO_YOKE, {"phi": "120 deg"}, {}),
        (NO_YOKE, {"phi": "250 deg"}, {"phi": "-35"}),
        (NO_YOKE | {"Q": "-30 N", "T": "-2 N m"}, {"phi": "10 deg"}, {"phi": "50"}),
    ]),
    ("telescopic-boom", telescopic_boom, BOOM, [
        (NO_MU, {}, {}),
        (NO_MU, {"s_1": "0.2", "s_2": "0.1", "s_3": "0.3"}, {"s_1": "0.3", "s_2": "-0.2", "s_3": "0.05"}),
        (NO_MU | {"beta": "-15 deg", "F": "150 N", "W": "1 kN"}, {"s_1": "-0.1", "s_2": "0.25", "s_3": "0.4"}, {"s_3": "-0.1"}),
    ]),
    ("drawer", drawer, DRAWER, [
        (NO_MU, {}, {}),
        (NO_MU, {"x": "0.15"}, {"x": "0.25"}),
        (NO_MU | {"h": "0.5 m", "a": "-0.2 m", "Q": "35 N"}, {"x": "-0.1"}, {"x": "-0.1"}),
    ]),
    ("cam-follower", cam_follower, CAM, [
        (NO_MU, {}, {}),
        (NO_MU, {"lift": "0.02"}, {"lift": "-0.3"}),
        (NO_MU | {"phi": "-20 deg", "Q": "120 N"}, {"lift": "0.035"}, {}),
    ]),
    ("klepp-2002", klepp, KLEPP, [
        (NO_KLEPP, {}, {}),
        (NO_KLEPP | {"P": "5 N", "k": "40 N/m", "c": "3 N s/m"}, {"q": "0.1"}, {"q": "-0.5"}),
        (NO_KLEPP | {"alpha": "110 deg", "P": "-7 N", "c": "3 N s/m"}, {}, {"q": "2"}),
    ]),
    ("painleve-klein", painleve_klein, PAINLEVE, [
        (NO_MU, {}, {}),
        (NO_MU | {"P_1": "-4 N", "m_2": "2.5 kg", "phi": "55 deg"}, {"x": "0.2"}, {"x": "-0.6"}),
    ]),
]


def check_against_file(model, texts):
    path = MODELS / f"{model}.toml"
    if not path.exists():
        return
    found = {k: str(v) for k, v in tomllib.loads(path.read_text())["parameters"].items()}
    assert found == texts, f"{path.name} has other parameters: {set(found.items()) ^ set(texts.items())}"


def shown(x):
    x = mp.mpf(sp.N(x, DIGITS)) if not isinstance(x, mp.mpf) else x
    return "0.0" if abs(x) < mp.mpf(10) ** -30 else repr(float(x))


def key(name):
    return name if all(c.isalnum() or c in "_-" for c in name) else f'"{name}"'


def table(d, form):
    return "{ " + ", ".join(f"{key(k)} = {form(v)}" for k, v in d.items()) + " }" if d else "{}"


def text(v):
    return f'"{v}"'


def array(v):
    return "[" + ", ".join(shown(x) for x in v) + "]"


HEADER = f"""\
# Frictionless reference numbers for the gallery: accelerations from Lagrange's equations in minimal coordinates,
# reactions from hand-written free-body balances. Made by reference/gallery_frictionless.py with SymPy {sp.__version__},
# mpmath {mp.__version__} ({DIGITS} digits, rounded to the nearest double); do not edit by hand. All values in SI units.
#
# bodies: [ax, ay, alpha] of the mass centre. hinges: [fx, fy] on the first-named body. drives: magnitude along the
# direction of the drive. set, at, rate: the texts after --set, --at, --rate; a number without unit is in SI units, and
# what is not named keeps the value of the model file.
#
# bracket-on-pole has no case here: its only body is massless, so the motion along the pole lacks inertia and, without
# friction and with a load along that motion, no finite acceleration exists (the forward problem is singular), and the
# file has no drive. Massless bodies elsewhere (lower_block, rod) only translate, so their acceleration holds for any point.
"""


def main():
    out = [HEADER]
    count, worst = 0, mp.mpf(0)
    for model, function, texts, states in CASES:
        check_against_file(model, texts)
        for overrides, at, rate in states:
            S, F, reactions = function(
                parameters(texts, overrides), {k: value(v) for k, v in at.items()}, {k: value(v) for k, v in rate.items()}
            )
            worst = max(worst, F.check())
            count += 1
            lines = ["[[case]]", f'model = "{model}"', f"set = {table(overrides, text)}"]
            if at:
                lines.append(f"at = {table(at, text)}")
            if rate:
                lines.append(f"rate = {table(rate, text)}")
            lines.append(f"coordinates = {table(dict(zip(S.names, S.w_value)), shown)}")
            lines.append(f"bodies = {table(S.accelerations(), array)}")
            for name, form in (("normal_forces", shown), ("couples", shown), ("hinges", array), ("drives", shown)):
                lines.append(f"{name} = {table(reactions.get(name, {}), form)}")
            lines.append('source = "Lagrange\'s equations in minimal coordinates (SymPy), reactions by free-body balances"')
            out.append("\n".join(lines) + "\n")
            print(model, at, rate, "ok", file=sys.stderr)
    target = HERE / "gallery-frictionless.toml"
    target.write_text("\n".join(out))
    tomllib.loads(target.read_text())
    print(f"{count} cases, largest residual of a balance equation {mp.nstr(worst, 3)}")


if __name__ == "__main__":
    main()
