"""Families of random mechanisms: the numbers of `models/*.toml`, and the same mechanisms as bodies and joints of the simulator."""

import math

from simulator import BlockSlider, Body, Force, Hinge, Mechanism, Spring, TorsionSpring

G = 9.81


def rounded(values):
    return {name: float(f"{value:.4g}") for name, value in values.items()}


def level_block(random, b, moving):
    """A block on a level guide: loads up to some times its static friction, high enough to tip it onto opposite faces."""
    mu, length = random.uniform(0.1, 0.5), random.uniform(0.1, 0.4)
    return {
        f"m_{b}": random.uniform(0.5, 3),
        f"L_{b}": length,
        f"h_{b}": random.choice([0, random.uniform(0.1, 0.6) * length]),
        f"c_{b}": random.uniform(-0.2, 0.3) * length,
        f"p_{b}": random.uniform(-0.5, 2.5) * length,
        f"mu_{b}": mu,
        f"mus_{b}": mu * random.uniform(1.05, 1.8),
        f"v_{b}": random.choice([0, random.uniform(-1, 1)]) if moving else 0,
    }


def level_body(p, i, b):
    return (
        Body(p[f"m_{b}"], p[f"m_{b}"] * 0.01, (i, p[f"c_{b}"])),
        BlockSlider(i, None, (i, 0), 0.0, p[f"L_{b}"], p[f"h_{b}"], p[f"mu_{b}"], p[f"mus_{b}"]),
    )


class Blocks:
    """Three blocks without influence on one another."""

    name, model, coordinates = "blocks", "blocks", ["a_x", "b_x", "c_x"]

    def numbers(self, random):
        p = {}
        for b in "abc":
            one = level_block(random, b, True)
            limit = one[f"mus_{b}"] * one[f"m_{b}"] * G
            one |= {f"A_{b}": random.uniform(0.6, 3) * limit, f"B_{b}": random.uniform(-0.5, 0.5) * limit}
            p |= one | {f"w_{b}": random.uniform(2, 12), f"f_{b}": random.uniform(0, 6)}
        return p

    def mechanism(self, p):
        bodies, sliders, forces = [], [], []
        for i, b in enumerate("abc"):
            body, slider = level_body(p, i, b)
            bodies.append(body), sliders.append(slider)
            a, w, f, c = (p[f"{x}_{b}"] for x in "AwfB")
            forces.append(Force(i, (i, p[f"p_{b}"]), lambda t, _, a=a, w=w, f=f, c=c: (a * math.sin(w * t + f) + c, 0.0)))
        fastest = max(p[f"w_{b}"] for b in "abc")
        return Mechanism(bodies, sliders, forces, G * max(p[f"m_{b}"] for b in "abc"), 1 / fastest, gravity=G)

    def rates(self, p):
        return [[p[f"v_{b}"], 0, 0] for b in "abc"]

    def until(self, p):
        return 2.0


class Chain(Blocks):
    """Three blocks in a row with springs and dampers between them, pulled off their guides' lines."""

    name, model = "chain", "chain"

    def numbers(self, random):
        p = {}
        for b in "abc":
            p |= level_block(random, b, True)
            p |= {f"k_{b}": p[f"m_{b}"] * random.uniform(3, 15) ** 2, f"d_{b}": random.choice([0, random.uniform(0, 2)])}
        limit = max(p[f"mus_{b}"] * p[f"m_{b}"] * G for b in "abc")
        jumping = random.random() < 0.5
        p |= {"A": random.uniform(0.8, 4) * limit, "w": random.uniform(2, 10), "f": random.uniform(0, 6)}
        return p | {"Q": random.uniform(0.5, 3) * limit if jumping else 0, "z": random.uniform(2, 6)}

    def mechanism(self, p):
        bodies, sliders = zip(*[level_body(p, i, b) for i, b in enumerate("abc")])
        places = [(i, p[f"p_{b}"]) for i, b in enumerate("abc")]
        springs = []
        for i, b in enumerate("abc"):
            other = (i - 1, places[i - 1]) if i else (None, (-1, p["p_a"]))
            length = math.dist(places[i], other[1])
            springs.append(Spring(i, places[i], *other, p[f"k_{b}"], length, p[f"d_{b}"]))
        forces = [Force(2, places[2], lambda t, _: (p["A"] * math.sin(p["w"] * t + p["f"]), 0.0))]
        jumps = None
        if p["Q"]:
            jumps = lambda piece: (piece + 1) * math.pi / p["z"]
            forces.append(Force(0, places[0], lambda t, piece: (p["Q"] if piece % 2 == 0 else -p["Q"], 0.0)))
        fastest = max([p["w"]] + [math.sqrt(p[f"k_{b}"] / p[f"m_{b}"]) for b in "abc"])
        scale = G * max(p[f"m_{b}"] for b in "abc")
        return Mechanism(list(bodies), list(sliders), forces, scale, 1 / fastest, springs=springs, gravity=G, jumps=jumps)


class Cart:
    """One or two blocks on inclined guides of a cart that slides on a rough rail."""

    def __init__(self, count):
        self.blocks = "ab"[:count]
        self.name = self.model = f"cart-{count}"
        self.coordinates = ["x"] + [f"{b}_x" for b in self.blocks]

    def numbers(self, random):
        m, mu = random.uniform(1, 5), random.uniform(0.03, 0.2)
        p = {"m": m, "L": random.uniform(0.8, 1.5), "h": random.choice([0, random.uniform(0.05, 0.2)]), "c": random.uniform(0, 0.2)}
        p |= {"mu": mu, "mus": mu * random.uniform(1.1, 1.8), "k": m * random.uniform(2, 8) ** 2, "p": random.uniform(-0.1, 0.6)}
        total = m
        for b in self.blocks:
            one = level_block(random, b, False)
            del one[f"c_{b}"], one[f"p_{b}"]
            tilt = random.uniform(0.05, 0.7) * (1 if b == "a" else -1)
            one |= {f"e_{b}": random.uniform(-0.2, 0.4) * one[f"L_{b}"], f"q_{b}": tilt, f"r_{b}": random.uniform(0.3, 0.5)}
            p |= one | {f"k_{b}": one[f"m_{b}"] * random.uniform(6, 15) ** 2, f"v_{b}": random.choice([0, random.uniform(-0.7, 0.7)])}
            total += one[f"m_{b}"]
        p |= {"A": random.uniform(1, 5) * p["mus"] * total * G, "w": random.uniform(2, 10), "f": random.uniform(0, 6)}
        return p | {"v": random.choice([0, random.uniform(-0.7, 0.7)])}

    def mechanism(self, p):
        bodies, springs = [Body(p["m"], 0.1, (0, p["c"]))], [Spring(0, (0, p["p"]), None, (-3, p["p"]), p["k"], 3.0)]
        sliders = [BlockSlider(0, None, (0, 0), 0.0, p["L"], p["h"], p["mu"], p["mus"])]
        for i, b in enumerate(self.blocks):
            x, q, e, r = (0.3, -0.3)[i], p[f"q_{b}"], p[f"e_{b}"], p[f"r_{b}"]
            bodies.append(Body(p[f"m_{b}"], p[f"m_{b}"] * 0.01, (x - e * math.sin(q), 0.3 + e * math.cos(q))))
            sliders.append(BlockSlider(i + 1, 0, (x, 0.3), q, p[f"L_{b}"], p[f"h_{b}"], p[f"mu_{b}"], p[f"mus_{b}"]))
            springs.append(Spring(i + 1, (x, 0.3), 0, (x + r * math.cos(q), 0.3 + r * math.sin(q)), p[f"k_{b}"], r))
        forces = [Force(0, (0, p["p"]), lambda t, _: (p["A"] * math.sin(p["w"] * t + p["f"]), 0.0))]
        fastest = max([p["w"], 8.0] + [math.sqrt(p[f"k_{b}"] / p[f"m_{b}"]) for b in self.blocks])
        total = sum(body.mass for body in bodies)
        return Mechanism(bodies, sliders, forces, G * total, 1 / fastest, springs=springs, gravity=G)

    def rates(self, p):
        rates = [[p["v"], 0, 0]]
        for b in self.blocks:
            q, v = p[f"q_{b}"], p[f"v_{b}"]
            rates.append([p["v"] + v * math.cos(q), v * math.sin(q), 0])
        return rates

    def until(self, p):
        return 1.5


class Arm:
    """A sleeve on an arm that swings: centrifugal and Coriolis forces press it to one side and the other."""

    name, model, coordinates = "arm", "arm", ["phi", "s"]

    def numbers(self, random):
        mu, length = random.uniform(0.1, 0.4), random.uniform(0.1, 0.3)
        inertia, m, x = random.uniform(0.2, 0.6), random.uniform(0.5, 2), random.uniform(0.4, 0.7)
        p = {"M": random.uniform(1, 3), "J": inertia, "kt": random.uniform(10, 40), "dt": random.uniform(0, 0.5)}
        p |= {"T": random.uniform(5, 25), "w": random.uniform(2, 9), "f": random.uniform(0, 6), "o": random.uniform(-4, 4)}
        p |= {"q": random.uniform(-0.5, 0.5), "m": m, "x": x, "e": random.uniform(-0.2, 0.2) * length, "L": length}
        p |= {"h": random.choice([0, random.uniform(0.1, 0.5) * length]), "mu": mu, "mus": mu * random.uniform(1.05, 1.8)}
        return p | {"k": m * random.uniform(7, 14) ** 2, "d": random.uniform(0, 2)}

    def mechanism(self, p):
        c, s = math.cos(p["q"]), math.sin(p["q"])
        x, e = p["x"], p["e"]
        bodies = [Body(p["M"], p["J"], (0.2 * c, 0.2 * s)), Body(p["m"], p["m"] * 0.004, (x * c - e * s, x * s + e * c))]
        slider = BlockSlider(1, 0, (x * c, x * s), p["q"], p["L"], -p["h"], p["mu"], p["mus"])
        return Mechanism(
            bodies,
            [slider],
            [],
            p["m"] * G,
            1 / max(p["w"], math.sqrt(p["k"] / p["m"])),
            hinges=[Hinge(0, (0, 0))],
            springs=[Spring(1, (x * c, x * s), 0, (0, 0), p["k"], x, p["d"])],
            torsion_springs=[TorsionSpring(0, p["kt"], p["dt"])],
            torques=[(0, lambda t: p["T"] * math.sin(p["w"] * t + p["f"]))],
            gravity=G,
        )

    def rates(self, p):
        spin = lambda x, y: [-p["o"] * y, p["o"] * x, p["o"]]
        return [spin(*body.place) for body in self.mechanism(p).bodies]

    def until(self, p):
        return 2.0


INTEGRATED = [Blocks(), Chain(), Cart(1), Cart(2), Arm()]
