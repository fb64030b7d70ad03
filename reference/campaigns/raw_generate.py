"""Random raw problems: integers with ties, sparse, singular, of great scales, nearly degenerate, decimal, fractions, and of structure."""
import random
from fractions import Fraction
from math import isfinite

KINDS = ["lcp", "hlcp", "ave", "mlcp", "mcp", "game", "modes", "block_ave"]
FAMILIES = ["integer", "sparse", "singular", "dense", "scaled", "tiny", "extreme", "decimal", "fractions", "chain", "copositive", "large"]
FREE_MOST = 3


class Maker:
    def __init__(self, rng, family):
        self.rng, self.family = rng, family

    def entry(self):
        rng = self.rng
        if self.family == "dense":
            return rng.gauss(0, 1)
        if self.family == "sparse":
            return rng.choice([0, 0, 0, 0, 1, -1, 2])
        if self.family == "scaled":
            return rng.choice([0, 1, -1, 2, -3]) * 10.0 ** rng.choice([0, 0, 3, -3, 8, -8, 16, -16])
        if self.family == "extreme":
            return rng.choice([0, 0, 1, -1, 2, -3]) * rng.choice([1.0, 1.0, 1.0, 1e300, 1e-300, 1e308, 1e-308, 5e-324, 1e154])
        if self.family == "tiny":
            return rng.choice([0, 1, -1, 2, -1, 1, 5e-324, -5e-324, 1e-9, 1 + 1e-9, 1 - 2.0 ** -53, -1 - 2.0 ** -52])
        if self.family == "decimal":
            return rng.randint(-9, 9) / rng.choice([10, 10, 3, 7])
        if self.family == "fractions":
            return Fraction(rng.randint(-4, 4), rng.choice([1, 1, 2, 3, 3, 7]))
        return rng.randint(-2, 2) if self.family != "copositive" else rng.randint(0, 2)

    def dense(self, rows, columns):
        return [[self.entry() for _ in range(columns)] for _ in range(rows)]

    def square(self, n):
        rng = self.rng
        if self.family == "singular" and n > 1:
            r = rng.randint(0, n - 1)
            left, right = self.dense(n, r), self.dense(r, n)
            if rng.random() < 0.3:
                right = [[left[i][k] for i in range(n)] for k in range(r)]
            return [[sum(left[i][k] * right[k][j] for k in range(r)) for j in range(n)] for i in range(n)]
        rows = self.dense(n, n)
        if self.family == "chain":          # each unknown depends on those before it, in a random order
            order = rng.sample(range(n), n)
            rows = [[rows[i][j] if order[j] <= order[i] and (i == j or rng.random() < 0.5) else 0 for j in range(n)] for i in range(n)]
        if self.family == "large" and rng.random() < 0.7:
            share = rng.choice([0.0, 0.2, 0.5])
            rows = [[rows[i][j] if i == j or rng.random() < share else 0 for j in range(n)] for i in range(n)]
        if rng.random() < 0.15:             # symmetric
            rows = [[rows[max(i, j)][min(i, j)] for j in range(n)] for i in range(n)]
        if rng.random() < 0.2:              # a strong diagonal
            for i in range(n):
                rows[i][i] = sum(map(abs, rows[i])) + rng.choice([0, 1])
        return rows

    def size(self):
        return self.rng.randint(6, 9) if self.family == "large" else self.rng.choice([1, 2, 2, 3, 3, 4, 4, 5])

    def vector(self, n):
        return [self.entry() for _ in range(n)]

    def pairs(self, n):
        """Two vectors, neither negative, of which one vanishes at each place, sometimes both."""
        first, second = [0] * n, [0] * n
        for k in range(n):
            value = abs(self.entry())
            (first if self.rng.random() < 0.5 else second)[k] = value
        return first, second

    def planted(self):
        return self.rng.random() < 0.6


def times(rows, x):
    return [float(sum(a * b for a, b in zip(row, x))) if any(isinstance(a, float) for a in row) else sum(a * b for a, b in zip(row, x))
            for row in rows]


def lcp(make):
    n = make.size()
    m, q = make.square(n), make.vector(n)
    if make.planted():
        z, w = make.pairs(n)
        q = [a - b for a, b in zip(w, times(m, z))]
    return {"type": "lcp", "M": m, "q": q}


def hlcp(make):
    n = make.size()
    a, b, q = make.square(n), make.square(n), make.vector(n)
    if make.planted():
        w, z = make.pairs(n)
        q = [x - y for x, y in zip(times(a, w), times(b, z))]
    return {"type": "hlcp", "A": a, "B": b, "q": q}


def ave(make):
    n = make.size()
    a, b, right = make.square(n), make.square(n), make.vector(n)
    if make.rng.random() < 0.3:
        a = [[float(i == j) for j in range(n)] for i in range(n)]
    if make.planted():
        x = make.vector(n)
        right = [y + z for y, z in zip(times(a, x), times(b, [abs(v) for v in x]))]
    return {"type": "ave", "A": a, "B": b, "b": right}


def mlcp(make):
    m = make.size()
    n = make.rng.randint(0, FREE_MOST)
    whole = make.square(n + m)
    p = {"type": "mlcp", "A": [row[:n] for row in whole[:n]], "C": [row[n:] for row in whole[:n]],
         "D": [row[:n] for row in whole[n:]], "B": [row[n:] for row in whole[n:]]}
    right = make.vector(n + m)
    if make.planted():
        z, w = make.pairs(m)
        u = make.vector(n)
        value = times(whole, u + z)
        right = [-x for x in value[:n]] + [b - a for a, b in zip(value[n:], w)]
    p["a"], p["b"] = right[:n], right[n:]
    return p


def mcp(make):
    rng = make.rng
    n = min(make.size(), 5 if make.family != "large" else 6)
    p = {"type": "mcp", "M": make.square(n), "q": make.vector(n), "l": [], "u": []}
    great = rng.choice([1e20, 1e16, 1e9, 1e30]) if rng.random() < 0.2 else None
    for _ in range(n):
        lo = rng.choice([None, 0, 0, -1, make.entry()])
        hi = rng.choice([None, 0, 1, 2, make.entry()])
        if great and rng.random() < 0.7:
            lo = -great if lo is None else lo
            hi = great if hi is None else hi
        if lo is not None and hi is not None and lo > hi:
            lo, hi = hi, lo
        p["l"].append(lo)
        p["u"].append(hi)
    return p


def game(make):
    most = 3 if make.family == "extreme" else 4
    m, n = make.rng.randint(1, most), make.rng.randint(1, most)
    p = {"type": "game", "A": make.dense(m, n), "B": make.dense(m, n)}
    if make.rng.random() < 0.2:
        del p["B"]
    return p


def modes(make):
    n = min(make.size(), 5 if make.family != "large" else 7)
    plus, minus = make.square(n), make.square(n)
    if make.rng.random() < 0.5:             # columns of contacts: they differ from a unit vector by friction
        plus = [[float(i == j) + x for j, x in enumerate(row)] for i, row in enumerate(plus)]
        minus = [[-float(i == j) + x for j, x in enumerate(row)] for i, row in enumerate(minus)]
    right = make.vector(n)
    if make.planted():
        x, y = make.pairs(n)
        right = [a + b for a, b in zip(times(plus, x), times(minus, y))]
    p = {"type": "modes", "columns_positive": plus, "columns_negative": minus, "right_hand_side": right}
    if make.rng.random() < 0.4 and n <= 5:
        columns = make.rng.sample(range(n), make.rng.randint(1, n))
        for name in ("jumps_positive", "jumps_negative"):
            p[name] = [[make.entry() if j in columns else 0 for j in range(n)] for _ in range(n)]
    return p


def block_ave(make):
    """One block of two components among single ones: `block_oracle` solves these exactly."""
    rng = make.rng
    blocks = [1] * rng.randint(0, 3)
    blocks.insert(rng.randint(0, len(blocks)), 2 if rng.random() < 0.85 else 1)
    n, m = sum(blocks), len(blocks)
    p = {"type": "block_ave", "blocks": blocks, "B": make.dense(n, m), "b": make.vector(n)}
    if rng.random() < 0.3:
        p["A"] = [[x + 5 * (i == j) for j, x in enumerate(row)] for i, row in enumerate(make.dense(n, n))]
    return p


def finite(value):
    """Whether no sum or product on the way was too great for a number of a file."""
    if isinstance(value, (dict, list)):
        return all(map(finite, value.values() if isinstance(value, dict) else value))
    return not isinstance(value, float) or isfinite(value)


def written(value, fractions):
    """Fractions as texts or as the nearest numbers."""
    if isinstance(value, dict):
        return {name: written(x, fractions) for name, x in value.items()}
    if isinstance(value, list):
        return [written(x, fractions) for x in value]
    if not isinstance(value, Fraction):
        return value
    return int(value) if value.denominator == 1 else str(value) if fractions else float(value)


def problem(seed, index, fractions=False):
    """The problem with this number, the same whatever was made before; with fractions as texts if the program reads them."""
    rng = random.Random(f"{seed}/{index}")
    kind = KINDS[index % len(KINDS)]
    while True:
        make = Maker(rng, rng.choice(FAMILIES))
        made = globals()[kind](make)
        if finite(made):
            return make.family, written(made, fractions)
