#!/usr/bin/env python3
"""Checks a proof that the listed cells are all solutions of a problem given by matrices.

    python3 reference/check_proof.py [--list] PROBLEM.json PROOF.txt

Plain Python 3.11 in exact arithmetic; nothing of slideway. The page docs/src/proofs.md of the book describes the format
and says why each step proves what it claims. `-` as PROOF reads standard input; `--list` also prints the listed cells.
Exit code 0: verified; 1: a step of the proof fails; 2: a file cannot be read.
"""

import json
import math
import sys
from collections import Counter
from fractions import Fraction
from operator import mul

# The matrices of each type, its vector, and the names of the unknowns of both sides.
TYPES = {
    "lcp": (["M"], "q", ("z", "w")),
    "ave": (["A", "B"], "b", ("x+", "x-")),
    "hlcp": (["A", "B"], "q", ("z", "w")),
    "modes": (["columns_positive", "columns_negative"], "right_hand_side", ("N+", "N-")),
}
JUMPS = ["jumps_positive", "jumps_negative"]
LARGEST_EXPONENT = 4000


class Unreadable(Exception):
    """Something that is not a problem, or not a proof of this problem."""


class Fails(Exception):
    """A step that does not prove what it claims."""


def require(condition, reason):
    if not condition:
        raise Fails(reason)


# The problem --------------------------------------------------------------------------------------------------------


def read_problem(path):
    """Type, columns of both sides, jumps of both sides, right-hand side; exactly the doubles of the file."""

    def once(entries):
        if len(dict(entries)) != len(entries):
            raise Unreadable("a name occurs twice")
        return dict(entries)

    def refused(word):
        raise Unreadable(f"{word} is not a number")

    with open(path, encoding="utf-8") as file:
        data = json.load(file, object_pairs_hook=once, parse_int=float, parse_constant=refused)
    if not isinstance(data, dict):
        raise Unreadable("the problem is not an object")
    arrays = set(data) - {"type"}
    kinds = [kind for kind, (matrices, vector, _) in TYPES.items()
             if arrays in ({*matrices, vector}, {*matrices, vector} | ({*JUMPS} if kind == "modes" else set()))]
    kinds = [kind for kind in kinds if data.get("type", kind) == kind]
    if not kinds:
        raise Unreadable("type and names of the arrays belong to no known problem")
    matrices, vector, _ = TYPES[kinds[0]]
    right = [entry[0] if isinstance(entry, list) and len(entry) == 1 else entry for entry in data[vector]]
    right = exact_rows([right], len(right))[0]
    given = [exact_columns(data[name], len(right)) for name in matrices]
    jumps = [exact_columns(data[name], len(right)) for name in JUMPS if name in data]
    return kinds[0], *sides(kinds[0], given), jumps or [[[0] * len(right)] * len(right)] * 2, right


def exact_rows(rows, size):
    for row in rows:
        if not isinstance(row, list) or len(row) != size or not all(type(entry) is float for entry in row):
            raise Unreadable("an array does not have the right shape")
        if not all(map(math.isfinite, row)):
            raise Unreadable("a number is too large")
    return [list(map(Fraction, row)) for row in rows]


def exact_columns(rows, size):
    if not isinstance(rows, list) or len(rows) != size or not size:
        raise Unreadable("an array does not have the right shape")
    return [list(column) for column in zip(*exact_rows(rows, size))]


def sides(kind, given):
    """The columns of the positive and of the negative sides."""
    def combined(one, other, sign):
        return [[x + sign * y for x, y in zip(*columns)] for columns in zip(one, other)]
    if kind == "modes":
        return given
    zero = [[0] * len(given[0])] * len(given[0])
    if kind == "ave":
        return combined(*given, 1), combined(given[1], given[0], -1)
    unit = [[int(row == column) for row in range(len(zero))] for column in range(len(zero))]
    return combined(zero, given[-1], -1), unit if kind == "lcp" else given[0]


class Problem:
    """C y = b in integers: column j is 2^shift_j C_j, for the unknown scale y_j / 2^shift_j; `right` is scale b."""

    def __init__(self, size, jumps, columns, shifts, right, scale, names):
        self.size, self.jumps, self.columns, self.shifts = size, jumps, columns, shifts
        self.right, self.scale, self.names = right, scale, names
        self.contact_of = [*range(size), *range(size), *(contact for contact in jumps for _ in range(2))]
        self.row_of = [*range(size), *jumps]
        self.rows = len(self.row_of)
        self.pairs = [(contact, size + contact) for contact in range(size)]
        # The columns that leave in each state of a contact.
        self.states = [{"+": {size + contact}, "-": {contact}} for contact in range(size)]
        for share, contact in zip(range(2 * size, len(columns), 2), jumps):
            self.pairs += [(contact, share + 1), (size + contact, share)]
            self.states[contact] = {"+": {size + contact, share + 1}, "-": {contact, share},
                                    "0": {contact, size + contact}}
        self.partners = [set() for _ in columns]
        for one, other in self.pairs:
            self.partners[one].add(other)
            self.partners[other].add(one)

    @staticmethod
    def of(kind, positive, negative, jumps, right, exponents):
        """The whole problem; equation i is multiplied by 2^exponent_i."""
        size = len(right)
        with_jump = [contact for contact in range(size) if jumps[0][contact] != jumps[1][contact]]
        if len(exponents) > size + len(with_jump):
            raise Unreadable("more exponents than equations")
        for contact in set(range(size)) - set(with_jump):
            right = list(map(sum, zip(right, jumps[0][contact])))
        columns = [column + [0] * len(with_jump) for column in (*positive, *negative)]
        for index, contact in enumerate(with_jump):
            share = [int(index == other) for other in range(len(with_jump))]
            columns += [[-entry for entry in jump[contact]] + share for jump in jumps]
        factors = [Fraction(2) ** exponent for exponent in exponents] + [1] * (size + len(with_jump))
        scaled = [integers(map(mul, column, factors)) for column in (*columns, right + [1] * len(with_jump))]
        names = [f"{name}{contact}" for name in TYPES[kind][2] for contact in range(size)]
        names += [f"{name}{contact}" for contact in with_jump for name in ("share+", "share-")]
        (*columns, right), (*shifts, load) = zip(*scaled)
        return Problem(size, with_jump, columns, shifts, right, 2**load, names)

    def is_complementary(self, columns):
        return not any(self.partners[column] & columns for column in columns)

    def equations(self, columns, rows):
        """Rows of the equations in some columns, with the right-hand side as the last entry."""
        return [[self.columns[column][row] for column in columns] + [self.right[row]] for row in rows]


def integers(entries):
    """Numbers m / 2^k as integers times 2^-shift."""
    entries = list(entries)
    shift = max(Fraction(entry).denominator.bit_length() - 1 for entry in entries)
    return [int(entry * 2**shift) for entry in entries], shift


def reduced(rows, width):
    """Gauss-Jordan elimination without fractions (Bareiss 1968) in the first columns.

    Pivot columns, rows, and the positive number that is the pivot of all the first rows.
    """
    rows, pivots, last = [row for row in rows if any(row)], [], 1
    for column in range(width):
        rank = len(pivots)
        at = min((at for at in range(rank, len(rows)) if rows[at][column]),
                 key=lambda at: abs(rows[at][column]), default=None)
        if at is None:
            continue
        rows[rank], rows[at] = rows[at], rows[rank]
        pivot_row, pivot = rows[rank], rows[rank][column]
        for other, row in enumerate(rows):
            factor = row[column]
            if other != rank and factor:
                rows[other] = [(pivot * x - factor * y) // last for x, y in zip(row, pivot_row)]
            elif other != rank and pivot != last:
                rows[other] = [pivot * x // last for x in row]
        pivots.append(column)
        last = pivot
    sign = 1 if last > 0 else -1
    return pivots, [[sign * x for x in row] for row in rows], sign * last


def is_semidefinite(matrix):
    """Whether a symmetric matrix of integers is positive semidefinite: L D L' without fractions."""
    rows, last = list(matrix), 1
    while rows:
        pivot_row, pivot = rows[0], rows[0][0]
        if pivot < 0 or pivot == 0 and any(pivot_row):
            return False
        if pivot == 0:
            rows = [row[1:] for row in rows[1:]]
        else:
            rows = [[(pivot * x - row[0] * y) // last for x, y in zip(row[1:], pivot_row[1:])] for row in rows[1:]]
            last = pivot
    return True


# The proof ----------------------------------------------------------------------------------------------------------


class Cell:
    """A cell: its columns, those that are known to be positive somewhere in it, its dimension, and a point."""

    def __init__(self, problem, columns, generators):
        self.columns = frozenset(columns)
        require(problem.is_complementary(self.columns), "the cell has a forbidden pair")
        self.positive, self.point = set(), None
        for generator in generators or [columns]:
            require(set(generator) <= self.columns, "a point or direction has columns that the cell does not have")
            self.add(problem, list(dict.fromkeys(generator)))
        rank = len(reduced(problem.equations(self.columns, range(problem.rows)), len(self.columns))[0]) \
            if len(generators) else len(self.columns)
        self.dimension, self.exact = len(self.columns) - rank, self.positive == self.columns

    def add(self, problem, columns):
        """A point, or a direction, that is determined by some columns."""
        pivots, rows, pivot = reduced(problem.equations(columns, range(problem.rows)), len(columns))
        if len(pivots) == len(columns):
            values = [row[-1] for row in rows[:len(pivots)]]
            require(not any(row[-1] for row in rows[len(pivots):]), "the point does not exist")
            require(min(values, default=0) >= 0, "the point has a negative entry")
            self.point = self.point or {
                column: Fraction(value << problem.shifts[column], pivot * problem.scale)
                for column, value in zip(columns, values)}
            self.positive |= {column for column, value in zip(columns, values) if value}
        else:
            require(self.point is not None, "the columns of the first point depend on each other")
            require(len(pivots) == len(columns) - 1, "the columns depend on each other in several ways")
            free = next(at for at in range(len(columns)) if at not in pivots)
            require(all(row[free] < 0 for row in rows[:len(pivots)]), "the direction is not positive")
            self.positive |= set(columns)


class Lines:
    """The lines of a proof as numbers and fields."""

    def __init__(self, file):
        self.file, self.number, self.nodes, self.kept = enumerate(file, 1), 0, 0, None

    def following(self):
        """The next line with a content; `None` at the end."""
        kept, self.kept = self.kept, None
        if kept:
            return kept
        for self.number, line in self.file:
            fields = line.split()
            if fields and not fields[0].startswith("#"):
                return fields[0], fields[1:]
        return None

    def next(self):
        line = self.following()
        require(line, "the proof ends before every node is closed")
        return line

    def again(self, *line):
        self.kept = line

    def end(self):
        require(not self.following(), "something follows after the last node")


class Tree:
    """A proof for one problem. A node is its allowed columns and its half-spaces: columns beyond those of the problem
    are slacks, and a half-space is the row {column: entry} of its equation, with its right-hand side under `None`."""

    def __init__(self, problem, lines):
        self.problem, self.lines = problem, lines
        self.cells, self.products, self.forms, self.vectors = [], [], [], []

    def verify(self, allowed):
        """Reads steps until every node is closed."""
        steps = {"f": self.farkas, "z": self.zero, "l": self.stored, "x": self.solve, "c": self.close,
                 "b": self.states, "e": self.either, "s": self.split, "m": self.monotone, "p": self.product,
                 "cell": self.cell, "g": self.form}
        open_nodes = [(frozenset(allowed), ())]
        while open_nodes:
            step, fields = self.lines.next()
            require(step in steps, f"there is no step `{step}`")
            following = steps[step](open_nodes.pop(), fields)
            self.lines.nodes += len(following) != 1
            open_nodes.extend(reversed(following))
        return self

    # Declarations

    def cell(self, node, fields):
        parts = " ".join(fields).split("/")
        columns, *generators = [[self.number(field, self.problem.columns) for field in part.split()] for part in parts]
        self.cells.append(Cell(self.problem, columns, generators))
        return [node]

    def form(self, node, fields):
        require(len(fields) <= len(self.problem.columns), "the form has too many entries")
        self.forms.append(list(map(int, fields)))
        return [node]

    # Steps with a vector

    def products_with(self, vector, node):
        """v . C_j of every allowed column, and v . b."""
        allowed, spaces = node
        columns, own = self.problem.columns, len(self.problem.columns)
        require(len(vector) <= self.problem.rows + len(spaces), "the vector has too many entries")
        load = sum(map(mul, vector, self.problem.right))
        if len(vector) <= self.problem.rows:
            return [(j, sum(map(mul, vector, columns[j])) if j < own else 0) for j in allowed], load
        extra = list(zip(vector[self.problem.rows:], spaces))
        products = [(j, (sum(map(mul, vector, columns[j])) if j < own else 0)
                     + sum(entry * space.get(j, 0) for entry, space in extra)) for j in allowed]
        return products, load + sum(entry * space[None] for entry, space in extra)

    def weigh(self, fields, node):
        """The columns that a vector excludes, and v . b; the vector is kept for `l`."""
        vector = list(map(int, fields))
        if len(vector) <= self.problem.rows:
            self.vectors.append(vector)
        products, load = self.products_with(vector, node)
        require(all(product <= 0 for _, product in products), "a product with an allowed column is positive")
        return {j for j, product in products if product}, load

    def farkas(self, node, fields):
        require(self.weigh(fields, node)[1] > 0, "the product with the right-hand side is not positive")
        return []

    def zero(self, node, fields):
        negative, load = self.weigh(fields, node)
        require(load == 0, "the product with the right-hand side is not zero")
        return [(node[0] - negative, node[1])]

    def stored(self, node, fields):
        index = self.only_number(fields, self.vectors)
        if isinstance(self.vectors[index], list):
            products, load = self.products_with(self.vectors[index], (range(len(self.problem.columns)), ()))
            signs = [frozenset(j for j, product in products if sign * product > 0) for sign in (1, -1)]
            self.vectors[index] = (*signs, load)
        positive, negative, load = self.vectors[index]
        require(not positive & node[0], "a product with an allowed column is positive")
        require(load >= 0, "the product with the right-hand side is negative")
        return [] if load else [(node[0] - negative, node[1])]

    # Other steps

    def solve(self, node, fields):
        require(not fields, "`x` stands alone")
        own, real = len(self.problem.columns), [j for j in node[0] if j < len(self.problem.columns)]
        slacks = [j for j in node[0] if j >= own]
        rows = [row[:-1] + [0] * len(slacks) + row[-1:] for row in self.problem.equations(real, range(self.problem.rows))]
        rows += [[space.get(j, 0) for j in real + slacks] + [space[None]] for space in node[1]]
        for *entries, load in reduced(rows, len(node[0]))[1]:
            if load and all(entry * load <= 0 for entry in entries):
                return []
        raise Fails("no equation contradicts the signs of the unknowns")

    def close(self, node, fields):
        cell = self.cells[self.only_number(fields, self.cells)]
        own = len(self.problem.columns)
        require(all(j in cell.columns for j in node[0] if j < own), "an allowed column is not in the cell")
        return []

    def states(self, node, fields):
        require(1 <= len(fields) <= 2, "a contact, and perhaps the order of its states")
        states = self.problem.states[self.number(fields[0], self.problem.states)]
        order = fields[1] if len(fields) == 2 else "".join(states)
        require(sorted(order) == sorted(states), "these are not the states of the contact")
        return [(node[0] - states[state], node[1]) for state in order]

    def either(self, node, fields):
        pair = [self.number(field, self.problem.columns) for field in fields]
        require(len(pair) == 2 and pair[1] in self.problem.partners[pair[0]], "this is not a forbidden pair")
        return [(node[0] - {column}, node[1]) for column in pair]

    def split(self, node, fields):
        limit, *weights = map(int, fields)
        require(len(weights) <= len(self.forms), "there are not so many forms")
        space = Counter()
        for weight, form in zip(weights, self.forms):
            for column, entry in enumerate(form):
                space[column] += weight * entry << self.problem.shifts[column]
        allowed, spaces = node
        slack = len(self.problem.columns) + len(spaces)
        sides = [{column: sign * entry for column, entry in space.items()}
                 | {slack: 1, None: sign * limit * self.problem.scale} for sign in (1, -1)]
        return [(allowed | {slack}, (*spaces, side)) for side in sides]

    def monotone(self, node, fields):
        problem = self.problem
        cell = self.cells[self.number(fields[0] if fields else "", self.cells)]
        weights = list(map(int, fields[1:])) or [1] * len(problem.pairs)
        require(len(weights) <= len(problem.pairs) and min(weights) >= 0, "the weights do not fit")
        allowed = sorted((j for j in node[0] if j < len(problem.columns)),
                         key=lambda j: (sum(map(bool, problem.columns[j])), j))
        require(cell.positive <= set(allowed), "the cell has a point outside of the node")
        weighted = [(pair, weight << problem.shifts[pair[0]] + problem.shifts[pair[1]])
                    for pair, weight in zip(problem.pairs, weights) if weight]
        require(is_semidefinite(restricted_form(problem, allowed, weighted)), "the form has a negative direction")
        leaving = {other for pair, _ in weighted for one, other in (pair, pair[::-1]) if one in cell.positive}
        return [(node[0] - leaving, node[1])]

    def product(self, node, fields):
        problem = self.problem
        groups = [[self.number(field, problem.states) for field in group.split()]
                  for group in " ".join(fields).split("/")]
        group_of = {contact: index for index, group in enumerate(groups) for contact in group}
        require(len(group_of) == sum(map(len, groups)) and all(groups), "the groups are not disjoint")
        allowed = [j for j in node[0] if j < len(problem.columns)]
        for j in allowed:
            group = group_of.get(problem.contact_of[j])
            require(group is None or all(group_of.get(problem.row_of[row]) == group
                    for row, entry in enumerate(problem.columns[j]) if entry), "a group acts on other equations")
        rest = [j for j in allowed if problem.contact_of[j] not in group_of]
        rows = [row for row in range(problem.rows) if problem.row_of[row] not in group_of]
        pivots, rows, factor = reduced(problem.equations(rest, rows), len(rest))
        require(len(pivots) == len(rest) and not any(row[-1] for row in rows[len(pivots):]),
                "the other contacts do not have exactly one solution")
        values = {j: row[-1] for j, row in zip(rest, rows) if row[-1]}
        require(min(values.values(), default=0) >= 0, "the solution of the other contacts has a negative entry")
        require(problem.is_complementary(values.keys()), "the solution of the other contacts has a forbidden pair")
        right = [factor * entry for entry in problem.right]
        for j, value in values.items():
            right = [entry - value * other for entry, other in zip(right, problem.columns[j])]
        parts = [self.part(group, node[0], right, factor * problem.scale) for group in groups]
        self.products.append((values, parts))
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
                       [problem.shifts[j] for j in columns], [entry // common for entry in right], scale // common,
                       [problem.names[j] for j in columns])
        return Tree(part, self.lines).verify(at for at, j in enumerate(columns) if j in allowed)

    # Fields

    def number(self, field, items):
        require(field.isdecimal() and int(field) < len(items), f"`{field}` is not a number from 0 to {len(items) - 1}")
        return int(field)

    def only_number(self, fields, items):
        require(len(fields) == 1, "one number")
        return self.number(fields[0], items)

    # What has been proven

    def dimensions(self):
        """How many listed sets have each dimension; whether it is known exactly."""
        found = Counter((cell.dimension, cell.exact) for cell in self.cells)
        for _, parts in self.products:
            product = Counter({(0, True): 1})
            for part in parts:
                combined = Counter()
                for (one, exact), count in product.items():
                    for (other, too), more in part.dimensions().items():
                        combined[one + other, exact and too] += count * more
                product = combined
            found += product
        return found

    def parts_of_others(self):
        """How many cells are certainly part of another one, or the same as an earlier one."""
        greater = [(at, cell) for at, cell in enumerate(self.cells) if cell.dimension or not cell.exact]
        known = {}
        return sum(
            known.setdefault(cell.columns, at) != at
            or any(cell.columns < other.columns for _, other in greater) for at, cell in enumerate(self.cells))

    def describe(self, indent="  "):
        """Lines about every listed set."""
        for number, cell in enumerate(self.cells):
            names = " ".join(self.problem.names[column] for column in sorted(cell.columns))
            point = ", ".join(f"{self.problem.names[column]} = {value}" for column, value in sorted(cell.point.items()))
            yield f"{indent}cell {number}: dimension {cell.dimension}, unknowns {names or 'none'}; point {point or '0'}"
        for others, parts in self.products:
            yield f"{indent}product of"
            for number, part in enumerate(parts):
                yield f"{indent}  part {number}:"
                yield from part.describe(indent + "    ")


def restricted_form(problem, allowed, weighted):
    """The matrix of the sum of weight u_j u_k on the solutions of C u = 0 in the allowed columns."""
    pivots, rows, pivot = reduced(problem.equations(allowed, range(problem.rows)), len(allowed))
    free = [at for at in range(len(allowed)) if at not in set(pivots)]
    # Every column of a basis of these solutions has `pivot` for one free unknown.
    basis = {allowed[at]: [-row[other] for other in free] for at, row in zip(pivots, rows)}
    basis |= {allowed[at]: [pivot * (at == other) for other in free] for at in free}
    matrix = [[0] * len(free) for _ in free]
    for (one, other), weight in weighted:
        if one in basis and other in basis:
            for first, second in ((basis[one], basis[other]), (basis[other], basis[one])):
                for row, factor in zip(matrix, first):
                    if factor:
                        row[:] = [entry + weight * factor * x for entry, x in zip(row, second)]
    return matrix


def read_proof(problem_data, lines):
    """The tree of a proof that belongs to the problem, with all of its steps verified."""
    require(lines.next() == ("slideway", ["proof", "1"]), "this is not a proof of version 1")
    name, sizes = lines.next()
    require(name == "problem" and len(sizes) == 2, "the number of contacts and of those with a jump is missing")
    name, exponents = lines.next()
    if name != "rows":
        lines.again(name, exponents)
        exponents = []
    exponents = list(map(int, exponents))
    require(all(abs(exponent) <= LARGEST_EXPONENT for exponent in exponents), "an exponent is too large")
    problem = Problem.of(*problem_data, exponents)
    require([problem.size, len(problem.jumps)] == list(map(int, sizes)), "the proof is about another problem")
    tree = Tree(problem, lines).verify(range(len(problem.columns)))
    lines.end()
    return tree


def report(tree, nodes, with_list):
    """What has been verified, in words."""
    dimensions = tree.dimensions()
    count = dimensions.total()
    kind = "cell" if not tree.products else "set" if count == 1 else "products of cells of independent contacts and other set"
    listed = f"the {count} listed {kind}s are" if count != 1 else f"the listed {kind} is"
    print(f"verified: {listed} all solutions" if count else "verified: there is no solution")
    for (dimension, exact), number in sorted(dimensions.items()):
        print(f"  {number} of dimension {dimension}{'' if exact else ' at most'}")
    if parts := tree.parts_of_others():
        print(f"  {parts} of the cells are part of other ones")
    print(f"  {nodes} node{'s' if nodes != 1 else ''}")
    if with_list:
        print(*tree.describe(), sep="\n")


def main(arguments):
    with_list = "--list" in arguments
    paths = [argument for argument in arguments if argument != "--list"]
    if len(paths) != 2:
        print(__doc__)
        return 2
    sys.set_int_max_str_digits(0)
    sys.setrecursionlimit(100_000)
    try:
        problem_data = read_problem(paths[0])
        with sys.stdin if paths[1] == "-" else open(paths[1], encoding="ascii") as file:
            lines = Lines(file)
            try:
                tree = read_proof(problem_data, lines)
            except (Fails, ValueError) as error:
                print(f"not verified: line {lines.number}: {error}")
                return 1
    except (OSError, ValueError, Unreadable) as error:
        print(f"cannot be read: {error}", file=sys.stderr)
        return 2
    report(tree, lines.nodes, with_list)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
