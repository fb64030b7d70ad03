"""The instances of the comparison: families of problems with fixed seeds, as arrays that `slideway modes` reads."""
import json
import math
import subprocess
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Instance:
    """One problem: its family, its number of unknowns and its arrays as in a file."""

    family: str
    size: int
    arrays: dict = field(repr=False, compare=False)

    @property
    def name(self):
        """The name of its file, without the ending."""
        return f"{self.family}-{self.size}"

    def columns(self):
        """C+, C-, b of C+ max(x, 0) + C- max(-x, 0) = b; the signed unknown of an LCP is z - w."""
        arrays = self.arrays
        if "M" in arrays:
            return -arrays["M"], np.eye(self.size), arrays["q"]
        if "A" in arrays:
            return arrays["A"] + arrays["B"], arrays["B"] - arrays["A"], arrays["b"]
        return arrays["columns_positive"], arrays["columns_negative"], arrays["right_hand_side"]

    def complementarity(self):
        """M and q of the same problem as an LCP. For others than an LCP: M = -C-^-1 C+, q = C-^-1 b, which rounds."""
        if "M" in self.arrays:
            return self.arrays["M"], self.arrays["q"]
        positive, negative, load = self.columns()
        return -np.linalg.solve(negative, positive), np.linalg.solve(negative, load)

    def save(self, folder):
        """Writes the .npz file that all programs' numbers come from and returns its path."""
        path = folder / f"{self.name}.npz"
        np.savez_compressed(path, **self.arrays)
        return path


def _random(family, size):
    """A generator that depends on the family and the size alone."""
    return np.random.default_rng([sum(family.encode()), size])


def random_lcp(family, size):
    """M and q uniform in [-1, 1]."""
    random = _random(family, size)
    return Instance(family, size, {"M": random.uniform(-1, 1, (size, size)), "q": random.uniform(-1, 1, size)})


def planted_lcp(family, size):
    """M uniform in [-1, 1], q such that a random x with z = max(x, 0), w = max(-x, 0) is a solution."""
    random = _random(family, size)
    m = random.uniform(-1, 1, (size, size))
    x = random.uniform(-1, 1, size)
    return Instance(family, size, {"M": m, "q": np.maximum(-x, 0) - m @ np.maximum(x, 0)})


def _planted_ave(family, size, b, random):
    x = random.uniform(-1, 1, size)
    return Instance(family, size, {"A": np.eye(size), "B": -b, "b": x - b @ abs(x)})


def planted_ave(mu):
    """x - B|x| = c with B = mu sqrt(3/n) U(-1, 1) and a planted solution; rho(B) is about mu."""

    def make(family, size):
        random = _random(family, size)
        return _planted_ave(family, size, mu * math.sqrt(3 / size) * random.uniform(-1, 1, (size, size)), random)

    return make


def independent_blocks(family, size):
    """As planted_ave with mu = 1, in blocks of ten unknowns that do not depend on one another."""
    random = _random(family, size)
    block = np.arange(size) // 10
    b = np.where(block[:, None] == block, math.sqrt(0.3) * random.uniform(-1, 1, (size, size)), 0)
    return _planted_ave(family, size, b, random)


def chained_blocks(family, size):
    """Blocks of ten with coupling of strength 0.5; each acts on the first unknown of the next. Two column versions."""
    random = _random(family, size)
    row, column = np.indices((size, size))
    own = row // 10 == column // 10
    next_one = (row // 10 == column // 10 + 1) & (row % 10 == 0)

    def columns(sign):
        values = random.uniform(-1, 1, (size, size))
        return sign * np.eye(size) + np.where(own, 0.5 * math.sqrt(0.3) * values, np.where(next_one, 0.3 * values, 0))

    return _modes(family, size, columns(1), columns(-1), random.uniform(-1, 1, size))


def low_rank(family, size):
    """A diagonal and a coupling of rank 2; two column versions."""
    random = _random(family, size)
    left = random.uniform(-1, 1, (size, 2))

    def columns(sign):
        right = 2 / math.sqrt(size) * random.uniform(-1, 1, (2, size))
        return np.diag(sign + 0.3 * random.uniform(-1, 1, size)) + left @ right

    return _modes(family, size, columns(1), columns(-1), random.uniform(-1, 1, size))


def _modes(family, size, positive, negative, load):
    arrays = {"columns_positive": positive, "columns_negative": negative, "right_hand_side": load}
    return Instance(family, size, arrays)


def ones(q):
    """M of ones and q constant. q = 0: only z = 0; q = -1: the simplex sum z = 1."""

    def make(family, size):
        return Instance(family, size, {"M": np.ones((size, size)), "q": np.full(size, float(q))})

    return make


# Unknowns of a contact with friction: normal force, friction to both sides, sliding speed.
OF_CONTACT = 4


def pile(family, size):
    """Boxes on one another, each on both corners of its base; Stewart and Trinkle (1996), mu = 1/2, horizontal loads of 1/8.

    Eight unknowns for each box. Everything rests: one cell of dimension 3 for each box, with 8 vertices for each.
    """
    boxes = size // (2 * OF_CONTACT)
    contacts = 2 * boxes
    normal, tangential = np.zeros((2, contacts, 3 * boxes))
    for contact in range(contacts):
        above, x = contact // 2, (-1, 1)[contact % 2]
        for body, sign, y in ((above, 1, -0.5), (above - 1, -1, 0.5)):
            if body >= 0:
                normal[contact, 3 * body : 3 * body + 3] = sign * np.array([0, 1, x])
                tangential[contact, 3 * body : 3 * body + 3] = sign * np.array([1, 0, -y])
    mobility = np.diag(np.tile([1.0, 1.0, 2.0], boxes))
    free = np.tile([0.125, -1.0, 0.0], boxes)
    m, q = np.zeros((size, size)), np.zeros(size)
    directions = np.stack([normal, tangential, -tangential, np.zeros_like(normal)], axis=1).reshape(size, -1)
    m += directions @ mobility @ directions.T
    q += directions @ free
    for first in range(0, size, OF_CONTACT):
        m[first + 1 : first + 3, first + 3] = 1
        m[first + 3, first : first + 3] = 0.5, -1, -1
    return Instance(family, size, {"M": m, "q": q})


def market(family, size):
    """Activities x and prices p: c + D x - A'p >= 0, x >= 0; A x + E p - d >= 0, p >= 0; a solution is planted.

    D is diagonal with some zeros, E positive semidefinite of half the rank: all solutions form one convex set.
    """
    random = _random(family, size)
    half = size // 2
    technology, demand = random.integers(-4, 5, (half, half)), random.integers(-4, 5, (half, half // 2))
    costs = np.diag(np.maximum(random.integers(-4, 5, half), 0))
    m = np.block([[costs, -technology.T], [technology, demand @ demand.T]]).astype(float)
    x = random.integers(-4, 5, size).astype(float)
    return Instance(family, size, {"M": m, "q": np.maximum(-x, 0) - m @ np.maximum(x, 0)})


def subset_sum(family, size):
    """Which of size - 2 weights up to 10^5 have the same sum as a planted subset of them.

    w_k = a_k - z_k: each z_k is 0 or a_k. Two rows, w = sum z - t - u and w' = t - sum z - u', need sum z = t.
    """
    random = _random(family, size)
    items = size - 2
    weights = random.integers(1, 100_001, items).astype(float)
    target = weights[random.random(items) < 0.5].sum()
    m = -np.eye(size)
    m[items, :items], m[items + 1, :items] = 1, -1
    return Instance(family, size, {"M": m, "q": np.concatenate([weights, [-target, target]])})


def boom(program):
    """The gallery's telescopic boom, retracting with mu = 0.4; two contacts for each stage."""

    def make(family, size):
        command = [program, "boom", str(size // 2), "mu=0.4", "v=-0.1 m/s"]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        arrays = {key: np.array(value) for key, value in json.loads(text).items() if key != "type"}
        assert not any(arrays[key].any() for key in ("jumps_positive", "jumps_negative")), "the boom has no preload"
        return Instance(family, size, {key: value for key, value in arrays.items() if not key.startswith("jumps")})

    return make


@dataclass(frozen=True)
class Family:
    """How instances of a family are made, which sizes are compared, and which are tried for the largest one."""

    words: str
    make: callable
    sizes: tuple
    quick: tuple
    ladder: tuple
    # Whether solutions form continua or coincide, so that sign patterns do not tell them apart.
    by_cells: bool = False


def families(program):
    """All families by name. `program` is the Rust example that knows the models of the gallery."""
    small_steps = tuple(range(16, 204, 4))
    large_steps = (100, 200, 400, 700, 1000, 1400, 2000)
    result = {
        "lcp": Family("LCP, *M*, *q* uniform in [−1, 1]", random_lcp, (12, 16, 20, 24), (12, 16), small_steps),
        "lcp-planted": Family("the same with a planted solution", planted_lcp, (12, 40), (12,), small_steps),
    }
    for mu, sizes, steps in (
        (0.3, (12, 24, 40, 200), large_steps),
        (1, (12, 24, 40), small_steps),
        (1.5, (12, 24), small_steps),
        (3, (12, 16, 24), small_steps),
    ):
        words = f"*x* − *B*\\|*x*\\| = *c* with *B* = {mu} √(3/*n*) U(−1, 1), planted"
        result[f"ave-{mu}"] = Family(words, planted_ave(mu), sizes, (12,) if mu != 0.3 else (12, 200), steps)
    result |= {
        "blocks": Family("independent blocks of ten (*μ* = 1)", independent_blocks, (20, 1000), (20,), large_steps),
        "chain": Family("a chain of blocks of ten", chained_blocks, (20, 1000), (20,), large_steps),
        "low-rank": Family("coupling of rank 2", low_rank, (16, 300), (16,), large_steps),
        "boom": Family(
            "telescopic boom, retracting, *μ* = 0.4", boom(program), (6, 16, 100), (6,), (50, 100, 200, 400)
        ),
    }
    steps = tuple(range(4, 84, 4))
    boxes = tuple(range(8, 88, 8))
    result |= {
        "degenerate-point": Family("*M* of ones, *q* = 0", ones(0), (12, 20, 40), (12,), steps, True),
        "degenerate-simplex": Family("*M* of ones, *q* = −1", ones(-1), (12, 20, 40), (12,), steps, True),
        "degenerate-pile": Family("boxes on one another, with friction", pile, (8, 16, 24), (8, 16), boxes, True),
        "monotone": Family("market equilibrium", market, (20, 40, 60), (12, 20), tuple(range(12, 204, 8)), True),
        "chained": Family("subset sum", subset_sum, (14, 18, 22), (14, 18), tuple(range(10, 44, 4)), True),
    }
    return result
