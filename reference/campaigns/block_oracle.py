"""All solutions of A x + B |x| = b where one block has two components and the others one: a quadratic for each choice of signs."""
from fractions import Fraction
from itertools import product
from math import isqrt

from exact import echelon, null_space
from raw_problems import matrix, number

DIGITS = 10 ** 120
SPREAD = 10 ** 9                    # numbers of more different size may leave something open
NEAR = Fraction(1, 10 ** 6)         # what is nearer to a boundary than this may be left open, but not be wrong


class BlockSolutions:
    """As `exact.Solutions`; `delicate` where two solutions merge or one lies on a boundary, which need not be proven."""

    def __init__(self, points, delicate):
        self.points, self.delicate, self.continua = points, delicate, []

    def empty(self):
        return not self.points


def root(square):
    """The square root, exact if rational, else to 120 digits beyond the integer part."""
    top, bottom = square.numerator, square.denominator
    if isqrt(top) ** 2 == top and isqrt(bottom) ** 2 == bottom:
        return Fraction(isqrt(top), isqrt(bottom))
    scale = DIGITS * bottom
    return Fraction(isqrt(square.numerator * bottom * (scale // bottom) ** 2), scale // bottom * bottom)


def equal(p, q):
    """Whether two numbers are the same but for the rounding of roots."""
    return abs(p - q) * 10 ** 60 <= max(abs(p), abs(q))


def affine(rows, right):
    """A point and a basis of the directions of the solutions of linear equations; None if there are none."""
    width = len(rows[0])
    reduced, pivots = echelon([[*row, r] for row, r in zip(rows, right)])
    if width in pivots:
        return None
    point = [Fraction(0)] * width
    for row, pivot in zip(reduced, pivots):
        point[pivot] = row[-1]
    return point, null_space([row[:-1] for row in reduced], width)


def runs_to_infinity(kernel):
    """Whether the equations without a right-hand side have a solution other than zero, or nearly."""
    if len(kernel) != 1:
        return len(kernel) > 1
    squares = [x * x for x in kernel[0]]
    signs = {x > 0 for x in kernel[0][2:] if abs(x) > NEAR * max(map(abs, kernel[0]))}
    return len(signs) < 2 and abs(squares[0] + squares[1] - squares[2]) <= NEAR * max(squares[:3])


def solutions(problem):
    """A `BlockSolutions`, or None where this oracle does not reach."""
    blocks = problem["blocks"]
    if blocks.count(2) != 1:
        return None
    n, b = len(problem["b"]), matrix(problem["B"])
    a = matrix(problem["A"]) if "A" in problem else [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    starts = [sum(blocks[:j]) for j in range(len(blocks))]
    double = blocks.index(2)
    singles = [j for j in range(len(blocks)) if j != double]
    entries = [abs(x) for x in (*(x for row in a + b for x in row), *map(number, problem["b"])) if x]
    first, points, delicate = starts[double], [], max(entries, default=1) > SPREAD * min(entries, default=1)
    for signs in product((1, -1), repeat=len(singles)):
        # Unknowns: both components, their length, and the magnitudes of the others.
        rows = [[a[i][first], a[i][first + 1], b[i][double]] + [s * a[i][starts[j]] + b[i][j] for s, j in zip(signs, singles)]
                for i in range(n)]
        found = affine(rows, [number(x) for x in problem["b"]])
        delicate |= runs_to_infinity(null_space(rows, len(rows[0])))
        if found is None:
            continue
        point, kernel = found
        if len(kernel) > 1:
            return None
        candidates = on_cone(point, kernel[0]) if kernel else [(point, False)] if point[0] ** 2 + point[1] ** 2 == point[2] ** 2 else []
        if candidates is None:
            return None
        for values, double_root in candidates:
            if min(values[2:]) < 0:
                continue
            delicate |= double_root or min(values[2:]) <= NEAR * max(map(abs, values))
            x = [None] * n
            x[first], x[first + 1] = values[0], values[1]
            for s, j, v in zip(signs, singles, values[3:]):
                x[starts[j]] = s * v
            if not any(all(equal(p, q) for p, q in zip(x, y)) for y in points):
                points.append(x)
    return BlockSolutions([tuple((v,) for v in x) for x in points], delicate)


def on_cone(point, direction):
    """[(values, double root)] with v_0^2 + v_1^2 = v_2^2 on the line; None if all of it is such."""
    form = [1, 1, -1]
    alpha = sum(f * d * d for f, d in zip(form, direction))
    beta = 2 * sum(f * d * p for f, d, p in zip(form, direction, point))
    gamma = sum(f * p * p for f, p in zip(form, point))
    if alpha == 0:
        if beta == 0:
            return None if gamma == 0 else []
        return [(at(point, direction, -gamma / beta), True)]
    square = beta * beta - 4 * alpha * gamma
    if square < 0:
        return []
    roots = {(-beta + sign * root(square)) / (2 * alpha) for sign in (1, -1)}
    near = abs(square) <= NEAR * (beta * beta + abs(alpha * gamma))
    return [(clean(point, direction, t, (alpha, beta, gamma)), near) for t in roots]


def at(point, direction, t):
    return [p + t * d for p, d in zip(point, direction)]


def clean(point, direction, t, quadratic):
    """The values at a root, those that vanish there exactly set to zero."""
    alpha, beta, gamma = quadratic
    values = at(point, direction, t)
    for k, (p, d) in enumerate(zip(point, direction)):
        if d:
            zero = -p / d
            if equal(t, zero) and alpha * zero * zero + beta * zero + gamma == 0:
                values[k] = Fraction(0)
    return values
