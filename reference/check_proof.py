#!/usr/bin/env python3
"""Checks a proof that the listed cells are all solutions of a problem given by matrices.

    python3 reference/check_proof.py PROBLEM.json PROOF.txt

Plain Python 3.11 in exact arithmetic; nothing of slideway. The page docs/src/proofs.md of the book describes the format
and says why each step proves what it claims. `-` as PROOF reads standard input. Exit code 0: verified; 1: a step of the
proof fails; 2: a file cannot be read.
"""

import json
import math
import re
import sys
from collections import Counter
from fractions import Fraction
from itertools import chain
from operator import mul

# The matrices of each type, and its vector.
TYPES = {
    "lcp": (["M"], "q"),
    "ave": (["A", "B"], "b"),
    "hlcp": (["A", "B"], "q"),
    "modes": (["columns_positive", "columns_negative"], "right_hand_side"),
}
JUMPS = ["jumps_positive", "jumps_negative"]
LARGEST_EXPONENT = 4000
# Of digests.
PRIME, BASE = 2**61 - 1, 0x1234_5678_9ABC_DEF1


class Unreadable(Exception):
    """Something that is not a problem."""


class Fails(Exception):
    """A step that does not prove what it claims."""


def require(condition, reason, error=Fails):
    if not condition:
        raise error(reason)


# The problem ----------------------------------------------------------------------------------------------------------


def read_problem(path):
    """Columns and jumps of both sides, and the right-hand side, as fractions: exactly the doubles of a file."""
    with open(path, encoding="utf-8") as file:
        entries = json.load(file, object_pairs_hook=tuple, parse_int=float, parse_constant=str)
    data = dict(entries) if isinstance(entries, tuple) else {}
    require(data and len(data) == len(entries), "the problem is not an object of different names", Unreadable)
    kinds = [kind for kind, (matrices, vector) in TYPES.items() if data.get("type", kind) == kind and
             set(data) - {"type"} - ({*JUMPS} if kind == "modes" else set()) == {*matrices, vector}]
    require(kinds, "type and names of the arrays belong to no known problem", Unreadable)
    matrices, vector = TYPES[kinds[0]]
    right = data[vector] if isinstance(data[vector], list) else []
    size = len(right)
    right = numbers([row[0] if isinstance(row, list) and len(row) == 1 else row for row in right], size)
    given = [matrix(data[name], size) for name in matrices]
    zero, unit = ([[int(row == column) * one for row in range(size)] for column in range(size)] for one in (0, 1))
    jumps = [matrix(data.get(name), size) for name in JUMPS] if {*JUMPS} & set(data) else [zero, zero]
    if kinds[0] == "ave":
        given = combined(given[0], given[1], 1), combined(given[1], given[0], -1)
    elif kinds[0] != "modes":
        given = combined(zero, given[-1], -1), unit if kinds[0] == "lcp" else given[0]
    return given, jumps, right


def numbers(row, size):
    fits = size and isinstance(row, list) and len(row) == size
    # Fractions are rounded once, to the nearest double.
    row = [float(Fraction(x)) if isinstance(x, str) and re.fullmatch("-?[0-9]+/[0-9]*[1-9][0-9]*", x) else x for x in row] if fits else row
    require(fits and all(type(entry) is float and math.isfinite(entry) for entry in row),
            "an array has the wrong shape, or an entry that is not a number", Unreadable)
    return list(map(Fraction, row))


def matrix(rows, size):
    """The columns of a matrix."""
    numbers([0.0] * len(rows) if isinstance(rows, list) else rows, size)
    return list(map(list, zip(*(numbers(row, size) for row in rows))))


def combined(one, other, sign):
    return [[x + sign * y for x, y in zip(*columns)] for columns in zip(one, other)]


def digest(sides, jumps, right):
    """All numbers of a problem as the digits of one in a large base, modulo a prime: what a proof says it is about."""
    value = len(right)
    for number in chain(*(column for side in (*sides, *jumps) for column in side), right):
        number = Fraction(number)
        value = (value * BASE + number.numerator * pow(number.denominator, -1, PRIME)) % PRIME
    return value


class Problem:
    """C y = b in integers: column j is 2^shift_j C_j, for the unknown scale y_j / 2^shift_j; `right` is scale b."""

    def __init__(self, size, jumps, columns, shifts, right, scale):
        self.size, self.jumps, self.columns, self.shifts = size, jumps, columns, shifts
        self.right, self.scale = right, scale
        self.row_of = [*range(size), *jumps]
        self.contact_of = [*range(size), *range(size), *(contact for contact in jumps for _ in range(2))]
        self.pairs = [(contact, size + contact) for contact in range(size)]
        # The columns that leave in each state of a contact.
        self.states = [{"+": {size + contact}, "-": {contact}} for contact in range(size)]
        for share, contact in zip(range(2 * size, len(columns), 2), jumps):
            self.pairs += [(contact, share + 1), (size + contact, share)]
            self.states[contact] = {"+": {size + contact, share + 1}, "-": {contact, share},
                                    "0": {contact, size + contact}}

    @staticmethod
    def of(sides, jumps, right, exponents):
        """The whole problem; equation i is multiplied by 2^exponent_i."""
        size = len(right)
        with_jump = [contact for contact in range(size) if jumps[0][contact] != jumps[1][contact]]
        for contact in set(range(size)) - set(with_jump):
            right = list(map(sum, zip(right, jumps[0][contact])))
        columns = [column + [0] * len(with_jump) for side in sides for column in side]
        for index, contact in enumerate(with_jump):
            share = [int(index == other) for other in range(len(with_jump))]
            columns += [[-entry for entry in side[contact]] + share for side in jumps]
        rows = size + len(with_jump)
        require(len(exponents) <= rows, "more exponents than equations")
        factors = [Fraction(2) ** exponent for exponent in exponents] + [1] * (rows - len(exponents))
        scaled = [integers(map(mul, column, factors)) for column in (*columns, right + [1] * len(with_jump))]
        (*columns, right), (*shifts, load) = zip(*scaled)
        return Problem(size, with_jump, columns, shifts, right, 2**load)

    def is_complementary(self, columns):
        return not any(one in columns and other in columns for one, other in self.pairs)


def integers(entries):
    """Numbers m / 2^k as integers times 2^-shift."""
    entries = list(map(Fraction, entries))
    shift = max(entry.denominator.bit_length() - 1 for entry in entries)
    return [int(entry * 2**shift) for entry in entries], shift


def sparse_first(chosen, columns):
    """Different columns in an order in which few entries fill up while they are eliminated."""
    return sorted({*chosen}, key=lambda j: (sum(map(bool, columns[j])), j))


def reduced(columns, right, rows=None):
    """Elimination without fractions (Bareiss 1968) of some rows of the equations.

    The pivot columns, the rows with the right-hand side last, and the positive pivot that the first rows share.
    """
    rows = range(len(right)) if rows is None else rows
    rows = [row for row in ([column[i] for column in columns] + [right[i]] for i in rows) if any(row)]
    width, pivots, last = len(columns) + 1, [], 1
    for column in range(width - 1):
        rank = len(pivots)
        at = min((at for at in range(rank, len(rows)) if rows[at][column]),
                 key=lambda at: abs(rows[at][column]), default=None)
        if at is None:
            continue
        rows[rank], rows[at] = rows[at], rows[rank]
        pivot_row, pivot = rows[rank][column:], rows[rank][column]
        for other in range(rank + 1, len(rows)):
            row = rows[other][column:]
            if row[0] or pivot != last:
                rows[other][column:] = [(pivot * x - row[0] * y) // last for x, y in zip(row, pivot_row)]
        pivots.append(column)
        last = pivot
    free = sorted({*range(width)} - {*pivots})
    for at in reversed(range(len(pivots))):
        above, row = rows[at], [0] * width
        row[pivots[at]] = last
        for j in free:
            known = sum(above[pivots[other]] * rows[other][j] for other in range(at + 1, len(pivots)))
            row[j] = (last * above[j] - known) // above[pivots[at]]
        rows[at] = row
    return pivots, rows if last > 0 else [[-x for x in row] for row in rows], abs(last)


def is_semidefinite(rows):
    """Whether a symmetric matrix of integers is positive semidefinite: L D L' without fractions."""
    last = 1
    while rows:
        (pivot, *pivot_row), *rest = rows
        if pivot < 0 or pivot == 0 and any(pivot_row):
            return False
        rows = [row if pivot == 0 else [(pivot * x - first * y) // last for x, y in zip(row, pivot_row)]
                for first, *row in rest]
        last = pivot or last
    return True


# The proof ------------------------------------------------------------------------------------------------------------


class Cell:
    """A cell: its columns, those that are known to be positive somewhere in it, and its dimension: exactly, or at most.

    `support` are the columns that are positive somewhere, or all columns where this is not known.
    """

    def __init__(self, problem, columns, generators):
        require(problem.is_complementary(columns), "the cell has a forbidden pair")
        self.columns, self.positive = frozenset(columns), set()
        for at, generator in enumerate(generators or [columns]):
            require(self.columns.issuperset(generator), "a point or direction has columns that the cell does not have")
            self.add(problem, sparse_first(generator, problem.columns), at == 0)
        independent = columns
        if generators:
            order = sparse_first(columns, problem.columns)
            independent = reduced([problem.columns[j] for j in order], problem.right)[0]
        self.dimension = len(self.columns) - len({*independent})
        self.exact = self.dimension == 0 or self.positive == self.columns
        self.support = frozenset(self.positive) if self.exact else self.columns

    def add(self, problem, columns, is_first):
        """A point, or a direction, that is determined by some columns."""
        pivots, rows, _ = reduced([problem.columns[j] for j in columns], problem.right)
        rank = len(pivots)
        if rank == len(columns):
            require(not any(row[-1] for row in rows[rank:]), "the point does not exist")
            require(all(row[-1] >= 0 for row in rows[:rank]), "the point has a negative entry")
            self.positive |= {j for j, row in zip(columns, rows) if row[-1]}
        else:
            require(not is_first, "the columns of the first point depend on each other")
            require(rank == len(columns) - 1, "the columns depend on each other in several ways")
            free = next(at for at in range(len(columns)) if at not in pivots)
            require(all(row[free] < 0 for row in rows[:rank]), "the direction is not positive")
            self.positive |= set(columns)


class Lines:
    """The lines of a proof, as numbers and fields, and how many nodes have been closed or divided."""

    def __init__(self, file):
        self.number, self.nodes, self.fields = 0, 0, self.read(file)

    def read(self, file):
        for self.number, line in enumerate(file, 1):
            if (fields := line.split()) and not fields[0].startswith("#"):
                yield fields

    def next(self):
        fields = next(self.fields, None)
        require(fields, "the proof ends before every node is closed")
        return fields


class Tree:
    """A proof for one problem. A node is its allowed columns, and columns and right-hand side of its equations: those
    of the problem, and for each half-space another equation and the column of its slack."""

    def __init__(self, problem, lines, allowed):
        self.problem, self.lines, self.width, self.root = problem, lines, len(problem.columns), frozenset(allowed)
        self.cells, self.products, self.forms, self.vectors = [], [], [], []

    def verify(self):
        """Reads steps until every node is closed. Each step returns the nodes that take the place of its node."""
        steps = {"cell": self.cell, "g": self.form, "f": self.farkas, "z": self.zero, "l": self.stored,
                 "x": self.solve, "c": self.close, "b": self.branch, "e": self.either, "s": self.split,
                 "m": self.monotone, "p": self.product}
        open_nodes = [(self.root, self.problem.columns, self.problem.right)]
        while open_nodes:
            name, *fields = self.lines.next()
            require(name in steps, f"there is no step `{name}`")
            try:
                following = steps[name](fields, *open_nodes.pop())
            except ValueError:
                raise Fails("a field is missing, or is not an integer") from None
            self.lines.nodes += len(following) != 1
            open_nodes.extend(reversed(following))
        return self

    def cell(self, fields, *node):
        columns, *generators = [[number(field, self.problem.columns) for field in part] for part in parted(fields)]
        require(self.root.issuperset(columns), "the cell has a column that the root of the proof does not allow")
        self.cells.append(Cell(self.problem, columns, generators))
        return [node]

    def form(self, fields, *node):
        require(len(fields) <= self.width, "the form has too many entries")
        self.forms.append(list(map(int, fields)))
        return [node]

    def weigh(self, fields, allowed, columns, right):
        """The allowed columns with v . C_j < 0, and v . b; the vector is kept for `l`."""
        vector = list(map(int, fields))
        require(len(vector) <= len(right), "the vector has too many entries")
        if len(vector) <= len(self.problem.right):
            self.vectors.append(" ".join(fields))
        products = [(j, sum(map(mul, vector, columns[j]))) for j in allowed]
        require(all(product <= 0 for _, product in products), "the product with an allowed column is positive")
        return {j for j, product in products if product}, sum(map(mul, vector, right))

    def farkas(self, fields, *node):
        require(self.weigh(fields, *node)[1] > 0, "the product with the right-hand side is not positive")
        return []

    def zero(self, fields, allowed, *equations):
        negative, load = self.weigh(fields, allowed, *equations)
        require(load == 0, "the product with the right-hand side is not zero")
        return [(allowed - negative, *equations)]

    def stored(self, fields, allowed, *equations):
        index = number(only(fields), self.vectors)
        if isinstance(self.vectors[index], str):
            vector = list(map(int, self.vectors[index].split()))
            products = [sum(map(mul, vector, column)) for column in self.problem.columns]
            signs = [{j for j, product in enumerate(products) if sign * product > 0} for sign in (1, -1)]
            self.vectors[index] = *signs, sum(map(mul, vector, self.problem.right))
        # v . b was found to be positive or zero when the vector was stored.
        positive, negative, load = self.vectors[index]
        require(not positive & allowed, "the product with an allowed column is positive")
        return [] if load else [(allowed - negative, *equations)]

    def solve(self, fields, allowed, columns, right):
        require(not fields, "`x` stands alone")
        for *entries, load in reduced([columns[j] for j in sparse_first(allowed, columns)], right)[1]:
            if load and all(entry * load <= 0 for entry in entries):
                return []
        raise Fails("no equation contradicts the signs of the unknowns")

    def close(self, fields, allowed, *_):
        cell = self.cells[number(only(fields), self.cells)]
        require(self.real(allowed) <= cell.columns, "an allowed column is not in the cell")
        return []

    def branch(self, fields, allowed, *equations):
        contact, *order = fields
        states = self.problem.states[number(contact, self.problem.states)]
        order = only(order) if order else "".join(states)
        require(sorted(order) == sorted(states), "these are not the states of the contact")
        return [(allowed - states[state], *equations) for state in order]

    def either(self, fields, allowed, *equations):
        pair = [number(field, self.problem.columns) for field in fields]
        require({tuple(pair), tuple(pair[::-1])} & set(self.problem.pairs), "this is not a forbidden pair")
        return [(allowed - {column}, *equations) for column in pair]

    def split(self, fields, allowed, columns, right):
        limit, *weights = map(int, fields)
        require(len(weights) <= len(self.forms), "there are not so many forms")
        row = [0] * len(columns)
        for weight, form in zip(weights, self.forms):
            for column, entry in enumerate(form):
                row[column] += weight * entry << self.problem.shifts[column]
        return [(allowed | {len(columns)},
                 [[*column, sign * entry] for column, entry in zip(columns, row)] + [[0] * len(right) + [1]],
                 [*right, sign * limit * self.problem.scale]) for sign in (1, -1)]

    def monotone(self, fields, allowed, *equations):
        index, *weights = fields
        problem, cell = self.problem, self.cells[number(index, self.cells)]
        weights = list(map(int, weights)) or [1] * len(problem.pairs)
        require(len(weights) <= len(problem.pairs) and min(weights) >= 0, "the weights do not fit")
        require(cell.positive <= allowed, "the cell has a point outside of the node")
        weighted = [(weight << problem.shifts[one] + problem.shifts[other], one, other)
                    for weight, (one, other) in zip(weights, problem.pairs) if weight]
        form = restricted_form(problem, self.real(allowed), weighted)
        require(is_semidefinite(form), "the form has a negative direction")
        leaving = {b for _, one, other in weighted for a, b in ((one, other), (other, one)) if a in cell.positive}
        return [(allowed - leaving, *equations)]

    def product(self, fields, allowed, *_):
        problem, allowed = self.problem, self.real(allowed)
        groups = [[number(field, problem.states) for field in group] for group in parted(fields)]
        group_of = {contact: index for index, group in enumerate(groups) for contact in group}
        require(len(group_of) == sum(map(len, groups)) and all(groups), "the groups are not disjoint")
        for j in allowed:
            group = group_of.get(problem.contact_of[j])
            reached = {group_of.get(problem.row_of[row]) for row, entry in enumerate(problem.columns[j]) if entry}
            require(group is None or reached <= {group}, "a group acts on other equations")
        rest = sparse_first((j for j in allowed if problem.contact_of[j] not in group_of), problem.columns)
        rows = [row for row, contact in enumerate(problem.row_of) if contact not in group_of]
        pivots, rows, factor = reduced([problem.columns[j] for j in rest], problem.right, rows)
        require(len(pivots) == len(rest), "the other contacts are not determined")
        values = {j: row[-1] for j, row in zip(rest, rows) if row[-1]}
        require(not any(row[-1] for row in rows[len(rest):]) and min(values.values(), default=1) > 0
                and problem.is_complementary(values), "what the other contacts determine is not a solution")
        right = [factor * entry for entry in problem.right]
        for j, value in values.items():
            right = [entry - value * other for entry, other in zip(right, problem.columns[j])]
        parts = [self.part(group, allowed, right, factor * problem.scale) for group in groups]
        self.products.append((values.keys(), parts))
        return []

    def part(self, contacts, allowed, right, scale):
        """The proof of one group, with the given right-hand side of all equations."""
        problem = self.problem
        jumps = [at for at, contact in enumerate(contacts) if contact in problem.jumps]
        indices = [problem.jumps.index(contacts[at]) for at in jumps]
        rows = contacts + [problem.size + index for index in indices]
        columns = contacts + [problem.size + contact for contact in contacts]
        columns += [2 * (problem.size + index) + share for index in indices for share in (0, 1)]
        right = [right[row] for row in rows]
        common = math.gcd(scale, *right)
        part = Problem(len(contacts), jumps, [[problem.columns[j][row] for row in rows] for j in columns],
                       [problem.shifts[j] for j in columns], [entry // common for entry in right], scale // common)
        return columns, Tree(part, self.lines, (at for at, j in enumerate(columns) if j in allowed)).verify()

    def real(self, allowed):
        """The allowed columns of the problem, without slacks."""
        return frozenset(j for j in allowed if j < self.width)

    def count(self):
        """How many sets are listed: cells, and combinations of those of independent groups."""
        return len(self.cells) + sum(math.prod(part.count() for _, part in parts) for _, parts in self.products)

    def parts_of_others(self):
        """How many cells are part of another one, or the same as an earlier one."""
        greater = [cell for cell in self.cells if cell.dimension]
        inside = [any(cell.support <= other.columns and cell.support != other.support for other in greater)
                  for cell in self.cells]
        return len(self.cells) - len({cell.support for cell, known in zip(self.cells, inside) if not known})


def restricted_form(problem, allowed, weighted):
    """The matrix of the sum of weight u_j u_k in a basis of the solutions of C u = 0 in the allowed columns."""
    allowed = sparse_first(allowed, problem.columns)
    pivots, rows, pivot = reduced([problem.columns[j] for j in allowed], problem.right)
    free = [at for at in range(len(allowed)) if at not in set(pivots)]
    basis = {allowed[at]: [-row[other] for other in free] for at, row in zip(pivots, rows)}
    basis |= {allowed[at]: [pivot * (at == other) for other in free] for at in free}
    form = [[0] * len(free) for _ in free]
    for weight, *pair in weighted:
        for one, other in (pair, pair[::-1]) if basis.keys() >= {*pair} else ():
            for row, factor in zip(form, basis[one]):
                row[:] = [entry + weight * factor * x for entry, x in zip(row, basis[other])] if factor else row
    return form


def number(field, items):
    """The number of one of the items."""
    require(field.isdecimal() and int(field) < len(items), f"`{field}` is not a number below {len(items)}")
    return int(field)


def only(fields):
    require(len(fields) == 1, "one field too many or too few")
    return fields[0]


def parted(fields):
    """The fields between the slashes."""
    return [part.split() for part in " ".join(fields).split("/")]


def read_proof(problem_data, lines):
    """The tree of a proof that belongs to the problem, with all of its steps verified."""
    require(lines.next() == ["slideway", "proof", "1"], "this is not a proof of version 1")
    sizes, (name, *exponents) = lines.next(), lines.next()
    if name == "digest":
        require(exponents == [str(digest(*problem_data))], "the proof is about another problem")
        name, *exponents = lines.next()
    if name != "rows":
        lines.fields, exponents = chain([[name, *exponents]], lines.fields), []
    require(all(abs(int(exponent)) <= LARGEST_EXPONENT for exponent in exponents), "an exponent is too large")
    problem = Problem.of(*problem_data, list(map(int, exponents)))
    require(sizes == ["problem", str(problem.size), str(len(problem.jumps))], "the proof is about another problem")
    tree = Tree(problem, lines, range(len(problem.columns))).verify()
    require(next(lines.fields, None) is None, "something follows after the last node")
    return tree


def report(tree, nodes):
    """What has been verified, in words."""
    count, kind = tree.count(), "set" if tree.products else "cell"
    yield f"verified: the {count} listed {kind}s are all solutions" if count > 1 \
        else f"verified: the listed {kind} is the set of all solutions" if count else "verified: there is no solution"
    for (dimension, certain), count in sorted(Counter((cell.dimension, cell.exact) for cell in tree.cells).items()):
        yield f"  cells of dimension {dimension}{'' if certain else ' or less'}: {count}"
    if tree.products:
        yield f"  products of cells of independent groups: {count - len(tree.cells)}"
    if count := tree.parts_of_others():
        yield f"  cells that are part of others: {count}"
    yield f"  nodes: {nodes}"


def main(arguments):
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    sys.set_int_max_str_digits(0)
    sys.setrecursionlimit(100_000)
    try:
        problem_data = read_problem(arguments[0])
        with sys.stdin if arguments[1] == "-" else open(arguments[1], encoding="ascii") as file:
            lines = Lines(file)
            print(*report(read_proof(problem_data, lines), lines.nodes), sep="\n")
    except Fails as error:
        print(f"not verified: line {lines.number}: {error}")
        return 1
    except (OSError, ValueError, Unreadable) as error:
        print(f"cannot be read: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
