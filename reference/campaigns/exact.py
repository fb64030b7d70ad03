"""All solutions of a complementarity problem, by trying every choice of an alternative in exact rational arithmetic.

A problem is a square system with slots. Each slot has alternatives: one variable of its own, with a column, bounds, and a shift of
the right-hand side,

    sum_k (column_k v_k + shift_k) = rhs,      lo_k <= v_k <= hi_k.

Every full choice is a linear system whose solutions form a polyhedron; the solutions of the problem are the union of them. Nothing
is rounded, and nothing is left out: the choices are a tree, eliminated column by column without fractions (Bareiss).
"""
from collections import namedtuple
from fractions import Fraction
from itertools import combinations
from math import lcm

Alternative = namedtuple("Alternative", "column shift lo hi quantity")
Set = namedtuple("Set", "vertices rays lines")     # lists of lifted vectors: [slot][quantity]
Slot = namedtuple("Slot", "alternatives fixed")    # fixed[i][j]: value of quantity j where alternative i is chosen; None: its variable


class TooLarge(Exception):
    """A polyhedron has too many candidates for ends to try them all."""


def integer_rows(slots, rhs):
    """Rows of integers, each times a positive number: for every slot the columns and shifts of its alternatives, then `rhs`."""
    columns = []
    for slot in slots:
        for alternative in slot.alternatives:
            columns += [alternative.column, alternative.shift or [0] * len(rhs)]
    rows = []
    for i, right in enumerate(rhs):
        row = [Fraction(column[i]) for column in columns] + [Fraction(right)]
        scale = lcm(*(entry.denominator for entry in row))
        rows.append([int(entry * scale) for entry in row])
    return rows


def choices(slots, rhs):
    """Yield (choice, determinant, values, kernel) for every choice: `values` is None if it contradicts itself, else a point of its
    affine set, and `kernel` a basis of its directions, both over the slots. The determinant has its sign, not its size."""
    size = len(rhs)
    assert len(slots) == size

    def descend(k, rows, scale, free_rows, pivots, sign, choice):
        # Each row: columns of the remaining slots, rhs, then the columns of the free variables.
        if k == size:
            yield leaf(rows, scale, free_rows, pivots, sign, choice)
            return
        width = 2 * len(slots[k].alternatives)
        for a in range(len(slots[k].alternatives)):
            right = width + 2 * sum(len(slot.alternatives) for slot in slots[k + 1:])
            shifted = rows
            if slots[k].alternatives[a].shift is not None:
                shifted = [row[:right] + [row[right] - row[2 * a + 1]] + row[right + 1:] for row in rows]
            pivot_row = next((r for r in free_rows if shifted[r][2 * a]), None)
            if pivot_row is None:
                rest = [row[width:] + [row[2 * a]] for row in shifted]
                yield from descend(k + 1, rest, scale, free_rows, pivots + [None], 0, choice + (a,))
                continue
            top, pivot = shifted[pivot_row], shifted[pivot_row][2 * a]
            tail = top[width:]
            rest = []
            for r, row in enumerate(shifted):
                factor = row[2 * a]
                if r == pivot_row:
                    rest.append(tail)
                elif factor:
                    rest.append([(pivot * x - factor * y) // scale for x, y in zip(row[width:], tail)])
                else:
                    rest.append([pivot * x // scale for x in row[width:]])
            turned = -sign if free_rows.index(pivot_row) % 2 else sign
            remaining = [r for r in free_rows if r != pivot_row]
            yield from descend(k + 1, rest, pivot, remaining, pivots + [pivot_row], turned, choice + (a,))

    def leaf(rows, scale, free_rows, pivots, sign, choice):
        determinant = sign * (1 if scale > 0 else -1)
        if any(rows[r][0] for r in free_rows):
            return choice, determinant, None, []
        values = [Fraction(0) if r is None else Fraction(rows[r][0], scale) for r in pivots]
        kernel = []
        free = [k for k, r in enumerate(pivots) if r is None]
        for j, k in enumerate(free):
            direction = [Fraction(0) if r is None else Fraction(-rows[r][1 + j], scale) for r in pivots]
            direction[k] = Fraction(1)
            kernel.append(direction)
        return choice, determinant, values, kernel

    yield from descend(0, integer_rows(slots, rhs), 1, list(range(size)), [], 1, ())


def echelon(rows):
    """Reduced row echelon form of rational rows: (rows without zero rows, pivot columns)."""
    rows = [list(row) for row in rows]
    pivots, done = [], 0
    for column in range(len(rows[0]) if rows else 0):
        pivot = next((r for r in range(done, len(rows)) if rows[r][column]), None)
        if pivot is None:
            continue
        rows[done], rows[pivot] = rows[pivot], rows[done]
        lead = rows[done][column]
        rows[done] = [x / lead for x in rows[done]]
        for r in range(len(rows)):
            if r != done and rows[r][column]:
                factor = rows[r][column]
                rows[r] = [x - factor * y for x, y in zip(rows[r], rows[done])]
        pivots.append(column)
        done += 1
    return rows[:done], pivots


def null_space(rows, width):
    """A basis of the vectors that all `rows` map to zero."""
    reduced, pivots = echelon(rows)
    basis = []
    for free in (c for c in range(width) if c not in pivots):
        vector = [Fraction(0)] * width
        vector[free] = Fraction(1)
        for row, pivot in zip(reduced, pivots):
            vector[pivot] = -row[free]
        basis.append(vector)
    return basis


def combine(coefficients, vectors, start=None):
    total = list(start) if start else [Fraction(0)] * len(vectors[0])
    for c, vector in zip(coefficients, vectors):
        if c:
            total = [x + c * y for x, y in zip(total, vector)]
    return total


def generators(point, kernel, bounds):
    """(ends, rays, lines) of { point + kernel t : lo <= value <= hi }, in the values; None if it is empty."""
    conditions = []                                   # h . t + g >= 0
    for k, (lo, hi) in enumerate(bounds):
        row = [direction[k] for direction in kernel]
        if lo is not None:
            conditions.append((row, point[k] - lo))
        if hi is not None:
            conditions.append(([-x for x in row], hi - point[k]))
    if any(g < 0 for row, g in conditions if not any(row)):
        return None
    conditions = [(row, g) for row, g in conditions if any(row)]
    lines = null_space([row for row, _ in conditions], len(kernel))
    # Without the lines: their pivot parameters are set to zero.
    reduced, fixed = echelon(lines) if lines else ([], [])
    parameters = [j for j in range(len(kernel)) if j not in fixed]
    conditions = sorted({(tuple(row[j] for j in parameters), g) for row, g in conditions})
    ends, rays = pointed(conditions, len(parameters))
    if not ends:
        return None
    chosen = [kernel[j] for j in parameters]
    return ([combine(t, chosen, point) if t else list(point) for t in ends], [combine(t, chosen) for t in rays],
            [combine(line, kernel) for line in lines])


def pointed(conditions, width, limit=20000):
    """Ends and rays of a polyhedron without lines, by trying every set of active conditions."""
    if width == 0:
        return ([()] if all(g >= 0 for _, g in conditions) else []), []
    count = 1
    for i in range(width):
        count = count * (len(conditions) - i) // (i + 1)
    if count > limit:
        raise TooLarge
    ends, rays = set(), set()
    for active in combinations(conditions, width):
        reduced, pivots = echelon([list(row) + [-g] for row, g in active])
        if pivots == list(range(width)):
            t = tuple(row[-1] for row in reduced)
            if all(sum(a * b for a, b in zip(row, t)) + g >= 0 for row, g in conditions):
                ends.add(t)
    if not ends:
        return [], []
    for active in combinations(conditions, width - 1):
        basis = null_space([list(row) for row, _ in active], width)
        if len(basis) != 1:
            continue
        for sign in (1, -1):
            direction = [sign * x for x in basis[0]]
            if all(sum(a * b for a, b in zip(row, direction)) >= 0 for row, _ in conditions):
                size = max(map(abs, direction))
                rays.add(tuple(x / size for x in direction))
    return sorted(ends), sorted(rays)


def lift(slots, choice, values, homogeneous=False):
    lifted = []
    for slot, a, value in zip(slots, choice, values):
        fixed = slot.fixed[a]
        lifted.append(tuple(value if f is None else (Fraction(0) if homogeneous else f) for f in fixed))
    return tuple(lifted)


def admits(slot, a, quantities, homogeneous=False):
    """Whether the slot's alternative holds a point with these quantities (a direction, if homogeneous)."""
    alternative = slot.alternatives[a]
    for f, value in zip(slot.fixed[a], quantities):
        if f is None:
            if alternative.lo is not None and value < (0 if homogeneous else alternative.lo):
                return False
            if alternative.hi is not None and value > (0 if homogeneous else alternative.hi):
                return False
        elif value != (0 if homogeneous else f):
            return False
    return True


def within(slots, choice, found):
    """Whether the set `found` lies in that of `choice`."""
    return (all(admits(s, a, q) for v in found.vertices for s, a, q in zip(slots, choice, v))
            and all(admits(s, a, q, True) for v in found.rays for s, a, q in zip(slots, choice, v))
            and all(admits(s, a, q, True) and admits(s, a, tuple(-x for x in q), True)
                    for v in found.lines for s, a, q in zip(slots, choice, v)))


class Solutions:
    """`points`: isolated solutions, lifted. `continua`: maximal sets of positive dimension. `determinants`: oriented signs."""

    def __init__(self, slots, rhs, oriented=None):
        self.slots = slots
        self.determinants = set()
        points, sets = {}, []
        for choice, determinant, values, kernel in choices(slots, rhs):
            if oriented:
                for a, turns in zip(choice, oriented):
                    determinant *= turns[a]
            self.determinants.add(determinant)
            if values is None:
                continue
            alternatives = [slot.alternatives[a] for slot, a in zip(slots, choice)]
            if not kernel:
                if all((x.lo is None or v >= x.lo) and (x.hi is None or v <= x.hi) for x, v in zip(alternatives, values)):
                    points.setdefault(lift(slots, choice, values), choice)
                continue
            found = generators(values, kernel, [(x.lo, x.hi) for x in alternatives])
            if found is None:
                continue
            ends, rays, lines = found
            if len(ends) == 1 and not rays and not lines:
                points.setdefault(lift(slots, choice, ends[0]), choice)
                continue
            sets.append((choice, Set([lift(slots, choice, v) for v in ends], [lift(slots, choice, v, True) for v in rays],
                                     [lift(slots, choice, v, True) for v in lines])))
        self.continua = maximal(slots, sets)
        self.points = [p for p in points if not any(within(slots, c, Set([p], [], [])) for c, _ in self.continua)]

    def empty(self):
        return not self.points and not self.continua


def maximal(slots, sets):
    """The sets that are not part of another, each once."""
    kept = []
    for choice, found in sets:
        if any(within(slots, c, found) for c, _ in kept):
            continue
        kept = [(c, f) for c, f in kept if not within(slots, choice, f)]
        kept.append((choice, found))
    return kept
