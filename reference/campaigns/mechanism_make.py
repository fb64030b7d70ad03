"""Random planar mechanisms in the state of their drawing, as data and as model files. SI units throughout.

Every coefficient of friction has the factor `f`, every applied force and torque the factor `P`: both are parameters of the model.
"""
import math
import random
from dataclasses import dataclass, field


@dataclass
class Joint:
    name: str
    kind: str                   # hinge, block_slider, guided_slider, pin_in_slot
    block: str                  # of a hinge: the first body
    guide: str                  # "ground" or a body
    at: tuple
    angle: float = 0.0
    length: float = 0.0
    height: float = 0.0
    around: bool = False
    mu: tuple = (0.0, 0.0)      # where the normal force is positive, negative
    preload: tuple = (0.0, 0.0)
    centre: bool = False        # line of the preload
    carried: tuple = ("block", "block")     # front, rear
    play: float = 0.0
    stiffness: float = None
    misalignment: float = 0.0   # of the front
    pin: tuple = None           # radius and coefficient of a rough hinge


@dataclass
class Mechanism:
    family: str
    gravity: float
    bodies: dict = field(default_factory=dict)      # name: (mass, moment of inertia, centre)
    joints: list = field(default_factory=list)
    forces: list = field(default_factory=list)      # (body, place, components)
    torques: list = field(default_factory=list)     # (body, moment)
    springs: list = field(default_factory=list)     # (body, place, place on ground, stiffness, free length, damping)
    coordinates: list = field(default_factory=list) # (name, "slide" or "rotation", of, rate)
    drive: tuple = None         # (coordinate, acceleration, body, place or None, angle or None): a force, or a torque

    def joint(self, name):
        return next(j for j in self.joints if j.name == name)


def contacts(joint):
    """Names and places along the guide, from the middle, of the contacts of a joint."""
    if joint.kind == "hinge":
        return []
    if joint.kind == "block_slider":
        return [(f"{joint.name}.front", joint.length / 2), (f"{joint.name}.rear", -joint.length / 2)]
    return [(joint.name, 0.0)]


class Maker:
    def __init__(self, rng):
        self.rng = rng

    def number(self, low, high):
        return float(f"{self.rng.uniform(low, high):.5g}")

    def either(self, low, high):
        return self.rng.choice([-1, 1]) * self.number(low, high)

    def place(self, spread=0.4):
        return (self.number(-spread, spread), self.number(-spread, spread))

    def body(self, m, name, centre=None):
        mass = self.number(0.3, 4)
        m.bodies[name] = (mass, float(f"{mass * self.rng.uniform(0.004, 0.08):.4g}"), centre or self.place())

    def faces(self, least, most):
        first = self.number(least, most)
        return (first, self.number(least, most)) if self.rng.random() < 0.1 else (first, first)

    def slider(self, name, kind, block, guide="ground", at=None, angle=None):
        rng = self.rng
        j = Joint(name, kind, block, guide, at or self.place(0.3),
                  angle if angle is not None else rng.choice([0.0, self.number(-1.5, 1.5), self.number(-3, 3)]))
        j.mu = self.faces(0, rng.choice([0.3, 0.8, 1.5])) if rng.random() < 0.93 else (0.0, 0.0)
        if kind != "pin_in_slot":
            j.length = self.number(0.1, 0.6)
            j.height = rng.choice([0.0, self.number(0.02, 0.4)])
            j.around = rng.random() < 0.3
        if rng.random() < 0.3:
            j.preload = self.faces(0.5, 15)
            j.centre = kind != "pin_in_slot" and rng.random() < 0.4
        if kind == "block_slider" and rng.random() < 0.25:
            j.carried = rng.choice([("guide", "block"), ("block", "guide"), ("guide", "guide")])
        return j

    def loads(self, m, count):
        for _ in range(count):
            name = self.rng.choice(list(m.bodies))
            if self.rng.random() < 0.75:
                m.forces.append((name, self.place(0.6), (self.either(0.5, 30), self.either(0.5, 30))))
            else:
                m.torques.append((name, self.either(0.2, 5)))
        if self.rng.random() < 0.3:
            name, place = self.rng.choice(list(m.bodies)), self.place(0.5)
            m.springs.append((name, place, (place[0] + self.either(0.3, 0.8), place[1] + self.either(0.3, 0.8)), self.number(5, 200),
                              self.number(0.1, 0.9), self.rng.choice([0.0, self.number(0.5, 10)])))

    def pins(self, m):
        """Makes one hinge rough, seldom more."""
        hinges = [j for j in m.joints if j.kind == "hinge"]
        if hinges and self.rng.random() < 0.35:
            m.family += " with rough pins"
            for j in self.rng.sample(hinges, 1 if self.rng.random() < 0.8 else len(hinges)):
                j.pin = (self.number(0.004, self.rng.choice([0.02, 0.1])), self.number(0.05, 0.6))

    def finish(self, m):
        self.pins(m)
        self.loads(m, self.rng.randint(1, 3))
        if self.rng.random() < 0.35:
            name, kind, of, _ = m.coordinates[0]
            acceleration = self.rng.choice([0.0, self.either(0.2, 3)])
            if kind == "slide":
                j = m.joint(of)
                m.drive = (name, acceleration, j.block, self.place(0.5), float(f"{j.angle + self.rng.uniform(-0.7, 0.7):.6g}"))
            else:
                m.drive = (name, acceleration, of, None, None)
        return m


def sliding_body(make, m):
    make.body(m, "a")
    m.joints = [make.slider("j", make.rng.choice(["block_slider", "block_slider", "guided_slider"]), "a")]
    m.coordinates = [("q", "slide", "j", make.either(0.05, 2))]


def trammel(make, m):
    make.body(m, "a")
    m.joints = [make.slider("j", "pin_in_slot", "a", at=(0.0, 0.0), angle=make.number(-0.6, 0.6)),
                make.slider("k", "pin_in_slot", "a", at=(make.number(0.2, 0.6), make.either(0.2, 0.6)), angle=make.number(0.9, 2.2))]
    m.coordinates = [("q", "slide", "j", make.either(0.05, 2))]


def bar_in_slots(make, m):
    top = (make.number(0.05, 0.5), make.number(0.3, 0.8))
    make.body(m, "a", (top[0] / 2, top[1] / 2))
    make.body(m, "b", (0.0, 0.0))
    m.joints = [make.slider("j", "block_slider", "b", at=(0.0, 0.0), angle=make.number(-0.2, 0.2)),
                Joint("h", "hinge", "a", "b", (0.0, 0.0)),
                make.slider("k", "pin_in_slot", "a", at=top, angle=make.number(-0.4, 0.4))]
    m.coordinates = [("q", "slide", "j", make.either(0.05, 2))]


def cart(make, m):
    make.body(m, "a")
    make.body(m, "b")
    m.joints = [make.slider("j", make.rng.choice(["block_slider", "guided_slider"]), "a"),
                make.slider("k", make.rng.choice(["block_slider", "guided_slider"]), "b", "a")]
    m.coordinates = [("q", "slide", "j", make.either(0.05, 2)), ("s", "slide", "k", make.either(0.05, 2))]


def slider_crank(make, m):
    phi, r = make.number(0.3, 2.8), make.number(0.08, 0.2)
    pin = (r * math.cos(phi), r * math.sin(phi))
    end = (pin[0] + make.number(0.35, 0.7), make.number(-0.05, 0.05))
    make.body(m, "c", (0.0, 0.0))
    make.body(m, "r", ((pin[0] + end[0]) / 2, (pin[1] + end[1]) / 2))
    make.body(m, "p", (end[0] + make.number(0, 0.1), end[1]))
    m.joints = [Joint("O", "hinge", "c", "ground", (0.0, 0.0)), Joint("A", "hinge", "c", "r", pin), Joint("B", "hinge", "r", "p", end),
                make.slider("j", make.rng.choice(["block_slider", "guided_slider"]), "p", at=end, angle=make.number(-0.2, 0.2))]
    m.coordinates = [("q", "rotation", "c", make.either(0.5, 8))]


def yoke(make, m):
    phi, r = make.number(0.4, 2.7), make.number(0.08, 0.2)
    pin = (r * math.cos(phi), r * math.sin(phi))
    make.body(m, "c", (0.0, 0.0))
    make.body(m, "y", (pin[0] + make.number(0, 0.2), make.number(-0.1, 0.1)))
    middle = (pin[0] + make.number(0.1, 0.4), 0.0)
    m.joints = [Joint("O", "hinge", "c", "ground", (0.0, 0.0)),
                make.slider("k", "pin_in_slot", "c", "y", at=pin, angle=make.number(1.2, 1.9)),
                make.slider("j", make.rng.choice(["block_slider", "guided_slider"]), "y", at=middle, angle=0.0)]
    m.coordinates = [("q", "rotation", "c", make.either(0.5, 8))]


def arm(make, m):
    angle = make.number(-1.5, 1.5)
    at = (0.4 * math.cos(angle), 0.4 * math.sin(angle))
    make.body(m, "a", (0.1, 0.05))
    make.body(m, "s", (at[0] + make.number(-0.1, 0.1), at[1] + make.number(-0.1, 0.1)))
    m.joints = [Joint("O", "hinge", "a", "ground", (0.0, 0.0)),
                make.slider("j", make.rng.choice(["block_slider", "guided_slider"]), "s", "a", at=at, angle=angle)]
    m.coordinates = [("q", "rotation", "a", make.either(0.3, 6)), ("s", "slide", "j", make.either(0.1, 2))]


def rails(make, m):
    """A carriage on two parallel rails: what presses is decided by play and stiffness."""
    rng = make.rng
    make.body(m, "a")
    gap, mu = make.number(0.1, 0.8), make.faces(0, 0.9)
    law = rng.choice(["equal", "stiff", "stiff", "rigid", "rigid equal"])
    length = make.number(0.1, 0.6)
    play, height = make.number(1e-5, 5e-4), rng.choice([0.0, make.number(0.02, 0.2)])
    for name, side in (("l", 0.5), ("r", -0.5)):
        j = Joint(name, "block_slider", "a", "ground", (rng.choice([0.0, make.number(-0.1, 0.1)]), side * gap), 0.0, length, height)
        j.mu = mu if rng.random() < 0.7 else make.faces(0, 0.9)
        if law == "stiff":
            j.stiffness = make.number(2e4, 2e6)
            j.play = rng.choice([0.0, play, make.number(1e-5, 5e-4)])
            j.misalignment = rng.choice([0.0, 0.0, make.either(1e-6, 1e-4)])
        elif law == "rigid":
            j.play = make.number(1e-5, 5e-4)
        elif law == "rigid equal":
            j.play = play
        m.joints.append(j)
    m.family = f"rails, {law}"
    m.coordinates = [("q", "slide", "l", make.either(0.05, 1))]


FAMILIES = [sliding_body, trammel, bar_in_slots, cart, slider_crank, yoke, arm, rails, rails]


def mechanism(seed, index):
    rng = random.Random(f"mechanism {seed}/{index}")
    build = FAMILIES[index % len(FAMILIES)]
    make = Maker(rng)
    m = Mechanism(build.__name__, rng.choice([0.0, 9.81, 9.81]))
    build(make, m)
    return make.finish(m)


def pair(values, factor=""):
    """A number, or one for each face."""
    first, second = (f'"{v!r}{factor}"' if factor else repr(v) for v in values)
    return first if values[0] == values[1] else f"{{ plus = {first}, minus = {second} }}"


def place(p):
    return f"[{p[0]!r}, {p[1]!r}]"


def toml(m):
    """The model file."""
    points, owned = {}, {name: [] for name in m.bodies}

    def point(body, at):
        name = f"p{len(points)}"
        points[name] = at
        if body != "ground":
            owned[body].append(name)
        return f"{body}.{name}"

    rest = []
    for j in m.joints:
        rest.append(f"\n[joints.{j.name}]\ntype = \"{j.kind}\"")
        if j.kind == "hinge":
            shared = point(j.block, j.at).split(".")[1]
            if j.guide != "ground":
                owned[j.guide].append(shared)
            rest.append(f'between = ["{j.block}.{shared}", "{j.guide}.{shared}"]')
            if j.pin:
                rest.append(f'radius = {j.pin[0]!r}\nmu = "{j.pin[1]!r}*f"')
            continue
        rest.append(f'block = "{j.block}"\nguide = "{j.guide}"\nat = {place(j.at)}\nalong = {j.angle!r}\nmu = {pair(j.mu, "*f")}')
        if j.kind != "pin_in_slot":
            rest.append(f"length = {j.length!r}\nheight = {j.height!r}\nfit = \"{'around' if j.around else 'inside'}\"")
        if any(j.preload):
            rest.append(f"preload = {pair(j.preload)}")
            if j.kind != "pin_in_slot":
                rest.append(f"preload_line = \"{'centre' if j.centre else 'pressed'}\"")
        if j.play:
            rest.append(f"play = {j.play!r}")
        if j.stiffness:
            rest.append(f"stiffness = {j.stiffness!r}")
        ends = {"front": [], "rear": []}
        for end, by in zip(ends, j.carried):
            if by == "guide":
                ends[end].append('carried_by = "guide"')
        if j.misalignment:
            ends["front"].append(f"misalignment = {j.misalignment!r}")
        rest += [f"{end} = {{ {', '.join(keys)} }}" for end, keys in ends.items() if keys]
    for i, (body, at, (x, y)) in enumerate(m.forces):
        rest.append(f'\n[loads.force{i}]\ntype = "force"\nat = "{point(body, at)}"\ncomponents = ["{x!r}*P", "{y!r}*P"]')
    for i, (body, moment) in enumerate(m.torques):
        rest.append(f'\n[loads.torque{i}]\ntype = "torque"\nbody = "{body}"\nmoment = "{moment!r}*P"')
    for i, (body, at, end, stiffness, free, damping) in enumerate(m.springs):
        between = f'between = ["{point(body, at)}", "{point("ground", end)}"]'
        rest.append(f'\n[loads.spring{i}]\ntype = "spring"\n{between}\nstiffness = {stiffness!r}\nfree_length = {free!r}')
        if damping:
            rest.append(f'\n[loads.damper{i}]\ntype = "damper"\n{between}\ndamping = {damping!r}')
    for name, kind, of, rate in m.coordinates:
        rest.append(f'\n[coordinates.{name}]\n{kind} = "{of}"\nrate = {rate!r}')
    if m.drive:
        name, acceleration, body, at, angle = m.drive
        effort = f'torque = {{ body = "{body}" }}' if at is None else f'force = {{ at = "{point(body, at)}", direction = {angle!r} }}'
        rest.append(f'\n[drives.d]\ncoordinate = "{name}"\nacceleration = {acceleration!r}\n{effort}')
    head = [f'title = "{m.family}"']
    if m.gravity:
        head.append(f"gravity = {m.gravity!r}")
    head.append("\n[parameters]\nf = 1.0\nP = 1.0\n\n[points]")
    head += [f"{name} = {place(at)}" for name, at in points.items()]
    for name, (mass, inertia, centre) in m.bodies.items():
        head.append(f"\n[bodies.{name}]\npoints = {owned[name]}\nmass = {mass!r}")
        head.append(f"moment_of_inertia = {inertia!r}\ncentre_of_mass = {place(centre)}")
    return "\n".join(head + rest) + "\n"
