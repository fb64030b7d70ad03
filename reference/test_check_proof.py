#!/usr/bin/env python3
"""Tests check_proof.py: correct proofs are accepted, and nothing false is, however a proof is changed.

    python3 reference/test_check_proof.py [PROBLEMS] [MUTANTS] [SEED]

A small prover (branch and bound with rational linear programs) writes proofs for random problems with up to four
contacts that use every step of the format. An oracle that knows no proof tries all complementary sets of columns.
Then every proof is changed at random: tokens and lines are altered, deleted, exchanged, repeated; and the prover writes others
in which it takes steps without asking whether they apply. Such a proof may be accepted, but only if what it lists is true, by
the oracle: all listed sets are solutions, and those that close nodes are all solutions.
"""

import io
import itertools
import json
import math
import operator
import random
import subprocess
import sys
import tempfile
from collections import Counter
from fractions import Fraction
from pathlib import Path

import check_proof

ROOT = Path(__file__).resolve().parent.parent

# Rational linear programs -------------------------------------------------------------------------------------------


def linear_program(columns, right, cost):
    """The greatest cost . y with C y = b, y >= 0, by the simplex method with Bland's rule.

    ("empty", v) with v . C_j <= 0, v . b > 0; ("greatest", y, v) with v . C_j <= -cost_j, v . b = -greatest;
    or ("unbounded", y, u) with C u = 0, u >= 0, cost . u > 0. y and u are basic.
    """
    height, width = len(right), len(columns)
    signs = [-1 if entry < 0 else 1 for entry in right]
    table = [[signs[i] * Fraction(column[i]) for column in columns] + [Fraction(i == k) for k in range(height)]
             + [signs[i] * Fraction(right[i])] for i in range(height)]
    basis = list(range(width, width + height))

    def pivot(row, column):
        table[row] = [entry and entry / table[row][column] for entry in table[row]]
        for other in range(height):
            if other != row and table[other][column]:
                factor = table[other][column]
                table[other] = [x - factor * y if y else x for x, y in zip(table[other], table[row])]
        basis[row] = column

    def multipliers(costs):
        return [signs[k] * sum((costs[basis[i]] * table[i][width + k] for i in range(height) if costs[basis[i]]),
                               Fraction(0)) for k in range(height)]

    def improve(costs):
        while True:
            counted = [(costs[basis[i]], table[i]) for i in range(height) if costs[basis[i]]]
            gains = (costs[j] - sum(cost * row[j] for cost, row in counted if row[j]) for j in range(width))
            entering = next((j for j, gain in enumerate(gains) if gain > 0), None)
            if entering is None:
                return None
            rows = [i for i in range(height) if table[i][entering] > 0]
            if not rows:
                return entering
            row = min(rows, key=lambda i: (table[i][-1] / table[i][entering], basis[i]))
            pivot(row, entering)

    first = [0] * width + [-1] * height
    improve(first)
    if any(basis[i] >= width and table[i][-1] for i in range(height)):
        return "empty", [-entry for entry in multipliers(first)]
    for i in range(height):
        column = next((j for j in range(width) if table[i][j]), None)
        if basis[i] >= width and column is not None:
            pivot(i, column)
    costs = [Fraction(entry) for entry in cost] + [0] * height
    entering = improve(costs)
    point = {basis[i]: table[i][-1] for i in range(height) if basis[i] < width and table[i][-1]}
    if entering is None:
        return "greatest", point, [-entry for entry in multipliers(costs)]
    ray = {basis[i]: -table[i][entering] for i in range(height) if table[i][entering]} | {entering: Fraction(1)}
    return "unbounded", point, ray


def rank(rows):
    rows, found = [list(map(Fraction, row)) for row in rows], 0
    for column in range(len(rows[0]) if rows else 0):
        at = next((i for i in range(found, len(rows)) if rows[i][column]), None)
        if at is None:
            continue
        rows[found], rows[at] = rows[at], rows[found]
        for i in range(found + 1, len(rows)):
            factor = rows[i][column] / rows[found][column]
            rows[i] = [x - factor * y for x, y in zip(rows[i], rows[found])]
        found += 1
    return found


# Random problems, and what is true about them -----------------------------------------------------------------------


class Equations:
    """The equations of a problem in rational numbers, formed independently of the checker."""

    def __init__(self, data):
        size = len(data[{"lcp": "q", "hlcp": "q", "ave": "b", "modes": "right_hand_side"}[data["type"]]])
        def column(name, k, sign=1):
            return [sign * Fraction(float(row[k])) for row in data[name]]
        def unit(k):
            return [Fraction(i == k) for i in range(size)]
        def total(one, other):
            return [x + y for x, y in zip(one, other)]
        def both(k):
            match data["type"]:
                case "lcp": return column("M", k, -1), unit(k)
                case "hlcp": return column("B", k, -1), column("A", k)
                case "ave": return total(column("A", k), column("B", k)), total(column("B", k), column("A", k, -1))
            return column("columns_positive", k), column("columns_negative", k)
        right = [Fraction(float(x)) for x in data.get("q") or data.get("b") or data.get("right_hand_side")]
        pairs = [both(k) for k in range(size)]
        jumps = {k: (column("jumps_positive", k), column("jumps_negative", k)) for k in range(size)} \
            if "jumps_positive" in data else {}
        self.jumps = [k for k in jumps if jumps[k][0] != jumps[k][1]]
        for k in set(jumps) - set(self.jumps):
            right = total(right, jumps[k][0])
        added = len(self.jumps)
        self.size, self.right, self.supports = size, right + [Fraction(1)] * added, {}
        self.columns = [one + [Fraction(0)] * added for one, _ in pairs] + [two + [Fraction(0)] * added for _, two in pairs]
        for at, k in enumerate(self.jumps):
            for jump in jumps[k]:
                self.columns.append([-x for x in jump] + [Fraction(at == other) for other in range(added)])
        self.pairs = [(k, size + k) for k in range(size)]
        for at, k in enumerate(self.jumps):
            self.pairs += [(k, 2 * size + 2 * at + 1), (size + k, 2 * size + 2 * at)]

    def complementary(self, columns):
        return not any(one in columns and other in columns for one, other in self.pairs)

    def support(self, columns):
        """The columns that are positive somewhere in {y >= 0, C y = b, y = 0 elsewhere}; `None` if that is empty."""
        columns = frozenset(columns)
        if columns not in self.supports:
            self.supports[columns] = self.find_support(columns)
        return self.supports[columns]

    def find_support(self, columns):
        columns, found = sorted(columns), set()
        chosen = [self.columns[j] for j in columns]
        for at, j in enumerate(columns):
            if j not in found:
                answer = linear_program(chosen, self.right, [int(at == k) for k in range(len(columns))])
                if answer[0] == "empty":
                    return None
                found |= {columns[k] for k in answer[1]}
                if answer[0] == "unbounded":
                    found |= {columns[k] for k in answer[2]}
        return found if columns or not any(self.right) else None

    def truth(self):
        """The supports of the solutions of every pattern."""
        states = [[(k,), (self.size + k,)] for k in range(self.size)]
        for at, k in enumerate(self.jumps):
            share = 2 * self.size + 2 * at
            states[k] = [(k, share), (self.size + k, share + 1), (share, share + 1)]
        supports = [self.support(set(itertools.chain(*pattern))) for pattern in itertools.product(*states)]
        return {frozenset(found) for found in supports if found is not None}


def random_problem(rng):
    kind = rng.choice(["lcp", "ave", "hlcp", "modes", "modes", "modes", "monotone", "blocks", "chain", "far"])
    n = rng.randint(1, 4 if kind != "modes" else 3)
    most = rng.choice([1, 2, 5])
    def entry():
        return rng.randint(-most, most)
    def matrix(density=1.0):
        return [[entry() if rng.random() < density else 0 for _ in range(n)] for _ in range(n)]
    def vector():
        return [entry() for _ in range(n)]
    match kind:
        case "lcp": return {"type": "lcp", "M": matrix(), "q": vector()}
        case "ave": return {"type": "ave", "A": matrix(0.7), "B": matrix(0.7), "b": vector()}
        case "hlcp": return {"type": "hlcp", "A": matrix(), "B": matrix(), "q": vector()}
        case "far":
            # Rows of different size, and sums that are not doubles.
            def spread():
                return [[x * 10.0 ** rng.randint(-20, 20) if rng.random() < 0.3 else x * 0.1 for x in row] for row in matrix()]
            return {"type": "ave", "A": spread(), "B": spread(), "b": [x * 0.1 for x in vector()]}
        case "monotone":
            # D^-1 (G' G + a skew-symmetric matrix), which the weights D make semidefinite.
            factor, skew = matrix(0.6), matrix(0.6)
            weights = [rng.choice([1, 1, 2]) for _ in range(n)]
            m = [[sum(g[i] * g[j] for g in factor) + skew[i][j] - skew[j][i] for j in range(n)] for i in range(n)]
            return {"type": "lcp", "M": [[x / w for x in row] for row, w in zip(m, weights)], "q": vector()}
        case "blocks" | "chain":
            # Two groups that are independent, or that one contact acts on.
            n, group = rng.choice([(4, [0, 0, 1, 1]), (3, [0, 1, 1])] if kind == "blocks" else [(4, [0, 1, 2, 2]), (3, [0, 1, 2])])
    data = {"type": "modes", "columns_positive": matrix(), "columns_negative": matrix(), "right_hand_side": vector()}
    if rng.random() < 0.7 and n <= 3:
        data |= {"jumps_positive": matrix(0.5), "jumps_negative": matrix(0.5)}
    for name in set(data) - {"type", "right_hand_side"} if kind in ("blocks", "chain") else ():
        data[name] = [[x if group[i] == group[j] or kind == "chain" and j == 0 and "columns" in name else 0
                       for j, x in enumerate(row)] for i, row in enumerate(data[name])]
    return data


# The prover ---------------------------------------------------------------------------------------------------------


def whole(vector):
    """The vector as the shortest integers that are a positive multiple of it."""
    common = math.lcm(*(Fraction(entry).denominator for entry in vector))
    entries = [int(entry * common) for entry in vector]
    divisor = math.gcd(*entries) or 1
    while entries and not entries[-1]:
        entries.pop()
    return [entry // divisor for entry in entries]


class Prover:
    """Writes the proof of a problem, choosing among the possible steps at random.

    With a frequency of `lies` it takes a step without asking whether it applies, and goes on as if it did.
    """

    def __init__(self, equations, exponents, rng, lies=0.0):
        self.equations, self.exponents, self.rng, self.lies = equations, exponents, rng, lies
        self.lines, self.cells, self.known, self.vectors, self.forms = [], [], [], [], []
        self.splits_left = 2

    def system(self, node):
        """Columns and right-hand side of the node, slacks last."""
        allowed, spaces = node
        columns = []
        for j in sorted(allowed):
            own = self.equations.columns[j] if j < len(self.equations.columns) else [0] * len(self.equations.right)
            columns.append(own + [space.get(j, 0) for space in spaces])
        return columns, self.equations.right + [space[None] for space in spaces]

    def scaled(self, vector):
        rows = len(self.equations.right)
        factors = [Fraction(2) ** -e for e in self.exponents] + [1] * (rows - len(self.exponents))
        return whole([x * f for x, f in zip(vector[:rows], factors)] + vector[rows:])

    def with_vector(self, step, vector):
        entries = self.scaled(vector)
        if entries in self.vectors and self.rng.random() < 0.8:
            self.lines.append(f"l {self.vectors.index(entries)}")
            return
        self.lines.append(" ".join(map(str, [step, *entries])))
        if len(entries) <= len(self.equations.right):
            self.vectors.append(entries)

    def lying(self):
        return self.rng.random() < self.lies

    def lie(self, node):
        """Closes a node, or takes columns away, without a reason."""
        rng, height = self.rng, len(self.equations.right) + len(node[1])
        if self.vectors and rng.random() < 0.3:
            # A vector that proved something elsewhere, perhaps with another entry.
            vector = list(rng.choice(self.vectors))
            if vector and rng.random() < 0.3:
                vector[rng.randrange(len(vector))] += rng.choice([-1, 1])
        else:
            vector = [rng.choice([0, 0, 0, 1, -1, 2]) for _ in range(rng.randint(1, height))]
        match rng.randrange(6):
            case 0: self.lines.append(" ".join(map(str, ["f", *vector])))
            case 1: self.lines.append("x")
            case 2 if self.vectors: self.lines.append(f"l {rng.randrange(len(self.vectors))}")
            case 3 if self.cells: self.lines.append(f"c {rng.randrange(len(self.cells))}")
            case 4 if self.cells:
                number = rng.randrange(len(self.cells))
                self.lines.append(" ".join(map(str, ["m", number, *rng.choices([0, 1, 1], k=rng.randint(1, len(self.equations.pairs)))])))
                leaving = {b for pair in self.equations.pairs for a, b in (pair, pair[::-1]) if a in self.known[number]}
                self.prove((node[0] - leaving, node[1]))
            case _:
                self.lines.append(" ".join(map(str, ["z", *vector])))
                columns, _ = self.system(node)
                products = [sum(map(operator.mul, vector, column)) for column in columns]
                self.prove((node[0] - {j for j, product in zip(sorted(node[0]), products) if product < 0}, node[1]))

    def prove(self, node):
        if self.lying():
            return self.lie(node)
        columns, right = self.system(node)
        order = sorted(node[0])
        answer = linear_program(columns, right, [0] * len(columns))
        if answer[0] == "empty":
            if self.rng.random() < 0.5 and self.solved_is_negative(columns, right):
                self.lines.append("x")
            else:
                self.with_vector("f", answer[1])
            return
        positive = set()
        for at, j in enumerate(order):
            answer = linear_program(columns, right, [int(at == k) for k in range(len(order))])
            positive |= {order[k] for part in answer[1:3] if isinstance(part, dict) for k in part}
            if answer[0] == "greatest" and not answer[1].get(at) and j not in positive and self.rng.random() < 0.7:
                self.with_vector("z", answer[2])
                products = [sum(x * y for x, y in zip(answer[2], column)) for column in columns]
                return self.prove((node[0] - {order[k] for k, product in enumerate(products) if product}, node[1]))
        own = {j for j in positive if j < len(self.equations.columns)}
        real = {j for j in node[0] if j < len(self.equations.columns)}
        if self.equations.complementary(own) and own == real:
            return self.lines.append(f"c {self.cell(own)}")
        self.divide(node, real)

    def solved_is_negative(self, columns, right):
        """Whether the columns are independent, so that `x` applies to an infeasible node."""
        return not columns or rank(columns) == len(columns)

    def cell(self, columns):
        """The number of a cell that contains the given one, which is declared if necessary."""
        for number, cell in enumerate(self.cells):
            if columns <= cell:
                return number
        order = sorted(columns)
        chosen = [self.equations.columns[j] for j in order]
        generators = []
        for at in range(len(order)):
            answer = linear_program(chosen, self.equations.right, [int(at == k) for k in range(len(order))])
            for part in answer[1:3] if answer[0] == "unbounded" else answer[1:2]:
                # Points first; a basic point is determined by its positive columns.
                generator = sorted(order[k] for k in part)
                if part is answer[1] and generator not in generators:
                    generators.insert(0, generator)
                elif generator not in generators:
                    generators.append(generator)
        generators = generators or [[]]
        if self.lying():
            # Other columns, or the columns of another cell's points.
            order = sorted(set(order) ^ {self.rng.randrange(len(self.equations.columns))})
            self.rng.shuffle(generators)
            generators[0] = self.rng.choice([generators[0][1:], order, *self.known])
        if self.rng.random() < 0.3:
            generators = generators[:1]
        lists = [order] + ([] if generators == [order] else generators)
        self.lines.append("cell " + " / ".join(" ".join(map(str, part)) for part in lists))
        self.cells.append(columns)
        self.known.append({j for generator in generators for j in generator})
        return len(self.cells) - 1

    def divide(self, node, real):
        size, rng = self.equations.size, self.rng
        if rng.random() < 0.7 and self.monotone(node, real):
            return
        if rng.random() < 0.5 and any(self.product(node, real) for _ in range(10)):
            return
        if self.splits_left and rng.random() < 0.15:
            return self.split(node)
        violated = [pair for pair in self.equations.pairs if pair[0] in real and pair[1] in real]
        one, other = rng.choice(violated or self.equations.pairs)
        if rng.random() < 0.3:
            one, other = rng.sample(sorted(range(len(self.equations.columns))) if self.lying() else [one, other], 2)
            self.lines.append(f"e {one} {other}")
            children = [{one}, {other}]
        else:
            contact = one % size
            states = {"+": {size + contact}, "-": {contact}}
            if contact in self.equations.jumps:
                share = 2 * (size + self.equations.jumps.index(contact))
                states = {"+": {size + contact, share + 1}, "-": {contact, share}, "0": {contact, size + contact}}
            order = "".join(rng.sample(list(states), len(states)))
            plain = order in ("+-", "+-0") and rng.random() < 0.5
            self.lines.append(f"b {contact}" if plain else f"b {contact} {order}")
            children = [states[state] for state in order]
        for leaving in children:
            self.prove((node[0] - leaving, node[1]))

    def split(self, node):
        self.splits_left -= 1
        width = len(self.equations.columns)
        if not self.forms or self.rng.random() < 0.5:
            self.forms.append([self.rng.randint(-2, 2) for _ in range(width)])
            self.lines.append(" ".join(map(str, ["g", *self.forms[-1]])))
        weights = [self.rng.randint(-2, 2) for _ in self.forms]
        limit = self.rng.randint(-3, 3)
        self.lines.append(" ".join(map(str, ["s", limit, *weights])))
        space = {j: sum(w * form[j] for w, form in zip(weights, self.forms)) for j in range(width)}
        slack = width + len(node[1])
        for sign in (1, -1):
            side = {j: sign * x for j, x in space.items()} | {slack: 1, None: sign * limit}
            self.prove((node[0] | {slack}, (*node[1], side)))

    def monotone(self, node, real):
        """Tries `m` with the weights 1, and with those that make a scaled matrix semidefinite."""
        support = self.any_solution(real)
        if support is None:
            return False
        for weights in [[1] * len(self.equations.pairs)] + [
                [self.rng.choice([0, 1, 1, 2]) for _ in self.equations.pairs] for _ in range(4)]:
            if any(weights) and (self.lying() or self.is_monotone(sorted(real), weights)):
                number = self.cell(support)
                if not self.known[number] <= real and not self.lying():
                    return False
                leaving = set()
                for (one, other), weight in zip(self.equations.pairs, weights):
                    if weight:
                        leaving |= {b for a, b in ((one, other), (other, one)) if a in self.known[number]}
                if not leaving & real:
                    return False
                plain = set(weights) == {1} and self.rng.random() < 0.5
                self.lines.append(" ".join(map(str, ["m", number, *([] if plain else weights)])))
                self.prove((node[0] - leaving, node[1]))
                return True
        return False

    def any_solution(self, real):
        for count in range(len(real) + 1):
            for columns in itertools.combinations(sorted(real), count):
                if self.equations.complementary(set(columns)) and self.equations.support(columns) == set(columns):
                    return set(columns)
        return None

    def is_monotone(self, real, weights):
        """All principal minors of the form on a basis of the null space are nonnegative."""
        basis = null_space([[self.equations.columns[j][i] for j in real] for i in range(len(self.equations.right))], len(real))
        at = {j: k for k, j in enumerate(real)}
        def form(u, v):
            return sum(w * (u[at[a]] * v[at[b]] + v[at[a]] * u[at[b]]) for (a, b), w in zip(self.equations.pairs, weights)
                       if a in at and b in at)
        matrix = [[form(u, v) for v in basis] for u in basis]
        return all(determinant([[matrix[i][j] for j in chosen] for i in chosen]) >= 0
                   for count in range(1, len(basis) + 1) for chosen in itertools.combinations(range(len(basis)), count))

    def product(self, node, real):
        """Tries `p` with a random division of the contacts."""
        equations, size = self.equations, self.equations.size
        label = [self.rng.choice([0, 1, 2]) for _ in range(size)]
        groups = [[k for k in range(size) if label[k] == g] for g in (1, 2)]
        groups = [self.rng.sample(group, len(group)) for group in groups if group]
        if size == 1 or not groups or len(groups[0]) == size:
            return False
        contact_of = [*range(size), *range(size), *(k for k in equations.jumps for _ in (0, 1))]
        row_of = [*range(size), *equations.jumps]
        for j in real:
            reached = {label[row_of[i]] for i, x in enumerate(equations.columns[j]) if x}
            if label[contact_of[j]] and reached - {label[contact_of[j]]} and not self.lying():
                return False
        rest = [j for j in sorted(real) if not label[contact_of[j]]]
        rows = [i for i in range(len(row_of)) if not label[row_of[i]]]
        chosen = [[equations.columns[j][i] for i in rows] for j in rest]
        if rest and rank(chosen) < len(rest) and not self.lying():
            return False
        answer = linear_program(chosen, [equations.right[i] for i in rows], [0] * len(rest))
        if answer[0] == "empty":
            if not self.lying():
                return False
            answer = "greatest", {k: Fraction(1) for k in range(len(rest))}
        if not equations.complementary({rest[k] for k in answer[1]}) and not self.lying():
            return False
        right = list(equations.right)
        for k, value in answer[1].items():
            right = [x - value * y for x, y in zip(right, equations.columns[rest[k]])]
        self.lines.append("p " + " / ".join(" ".join(map(str, group)) for group in groups))
        for group in groups:
            part, own_rows, columns = part_of(equations, group, right)
            exponents = [(self.exponents + [0] * len(right))[i] for i in own_rows]
            prover = Prover(part, exponents, self.rng, self.lies)
            prover.prove((frozenset(at for at, j in enumerate(columns) if j in real), ()))
            self.lines += prover.lines
        return True


def part_of(equations, group, right):
    jumps = [k for k in group if k in equations.jumps]
    rows = group + [equations.size + equations.jumps.index(k) for k in jumps]
    columns = group + [equations.size + k for k in group]
    columns += [2 * (equations.size + equations.jumps.index(k)) + share for k in jumps for share in (0, 1)]
    part = object.__new__(Equations)
    part.size, part.jumps = len(group), [at for at, k in enumerate(group) if k in jumps]
    part.columns = [[equations.columns[j][i] for i in rows] for j in columns]
    part.right, part.supports = [right[i] for i in rows], {}
    part.pairs = [(k, part.size + k) for k in range(part.size)]
    for at, k in enumerate(part.jumps):
        part.pairs += [(k, 2 * part.size + 2 * at + 1), (part.size + k, 2 * part.size + 2 * at)]
    return part, rows, columns


def null_space(rows, width):
    """A basis of the u with A u = 0."""
    rows, pivots = [list(map(Fraction, row)) for row in rows], []
    for column in range(width):
        at = next((i for i in range(len(pivots), len(rows)) if rows[i][column]), None)
        if at is None:
            continue
        rows[len(pivots)], rows[at] = rows[at], rows[len(pivots)]
        row = rows[len(pivots)] = [x / rows[len(pivots)][column] for x in rows[len(pivots)]]
        for i in range(len(rows)):
            if i != len(pivots):
                rows[i] = [x - rows[i][column] * y for x, y in zip(rows[i], row)]
        pivots.append(column)
    basis = []
    for free in set(range(width)) - set(pivots):
        vector = [Fraction(j == free) for j in range(width)]
        for i, pivot in enumerate(pivots):
            vector[pivot] = -rows[i][free]
        basis.append(vector)
    return basis


def determinant(matrix):
    """By expansion: no elimination that could share a mistake with others."""
    if not matrix:
        return 1
    return sum((-1) ** j * matrix[0][j] * determinant([row[:j] + row[j + 1:] for row in matrix[1:]])
               for j in range(len(matrix)) if matrix[0][j])


# Checks -------------------------------------------------------------------------------------------------------------


class Tree(check_proof.Tree):
    """A tree that knows which of its cells close a node."""

    def close(self, fields, *node):
        following = super().close(fields, *node)
        self.used = getattr(self, "used", set()) | {int(fields[0])}
        return following


check_proof.Tree = Tree


def listed(tree, columns, only_used):
    """The columns of every listed set, or of those that close nodes, for a tree with the given columns of the whole problem."""
    for number, cell in enumerate(tree.cells):
        if not only_used or number in getattr(tree, "used", ()):
            yield {columns[j] for j in cell.columns}
    for others, parts in tree.products:
        sets = [list(listed(part, [columns[j] for j in chosen], only_used)) for chosen, part in parts]
        for combination in itertools.product(*sets):
            yield {columns[j] for j in others}.union(*combination)


def check(problem_data, text):
    """The tree of a proof, or `None` if it is refused."""
    try:
        return check_proof.read_proof(problem_data, check_proof.Lines(io.StringIO(text)))
    except (check_proof.Fails, check_proof.Unreadable, ValueError):
        return None


def is_true(tree, equations, truth):
    """Whether the listed sets are complementary and not empty, those that close nodes contain all solutions, and cells
    have the stated dimensions."""
    sets, used = (list(listed(tree, range(len(equations.columns)), only_used)) for only_used in (False, True))
    for columns in sets:
        if not equations.complementary(columns) or equations.support(columns) is None:
            return False
    for cell in tree.cells:
        if cell.exact:
            chosen = [equations.columns[j] for j in sorted(cell.columns)]
            if equations.support(cell.columns) != cell.columns or cell.dimension != len(chosen) - rank(chosen):
                return False
    return all(any(support <= columns for columns in used) for support in truth)


def changed(text, rng):
    """The proof with one to three random changes."""
    lines = [line.split() for line in text.splitlines()]
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        if not lines:
            break
        at = rng.randrange(len(lines))
        line = lines[at]
        match rng.randrange(10):
            case 0: del lines[at]
            case 1: lines.insert(at, list(rng.choice(lines)))
            case 2:
                other = rng.randrange(len(lines))
                lines[at], lines[other] = lines[other], lines[at]
            case 3 if line: line[rng.randrange(len(line))] = rng.choice(rng.choice(lines) or ["0"])
            case 4 if line: del line[rng.randrange(len(line))]
            case 5 if line: line.insert(rng.randrange(len(line) + 1), str(rng.randint(-3, 9)))
            case 6 if line: line[0] = rng.choice(["f", "z", "l", "x", "c", "b", "e", "s", "m", "p", "cell", "g"])
            case 7: del lines[at:at + rng.randint(1, 4)]
            case 8:
                # A cell with one more column, and the same points.
                cells = [line for line in lines if line[:1] == ["cell"]]
                if cells:
                    line = rng.choice(cells)
                    line[:] = line if "/" in line else [*line, "/", *line[1:]]
                    line.insert(1, str(rng.randint(0, 9)))
            case _ if line:
                where = rng.randrange(len(line))
                number = line[where].lstrip("-")
                line[where] = str(int(line[where]) + rng.choice([-1, 1, 2])) if number.isdecimal() else "/"
    return "\n".join(map(" ".join, lines)) + "\n"


def run(*arguments):
    """Exit code and output of the checker as a program."""
    done = subprocess.run([sys.executable, check_proof.__file__, *map(str, arguments)], capture_output=True, text=True)
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout


def check_examples():
    """The proofs of the book are accepted, and what the book says about them is printed."""
    page = (ROOT / "docs/src/proofs.md").read_text(encoding="utf-8")
    blocks = [block.split("```")[0] for block in page.split("```text\n")[1:]]
    examples = [at for at, block in enumerate(blocks) if block.startswith("slideway proof 1\nproblem 2")]
    problems = ["docs/src/examples/species.json", "crates/slideway-cli/tests/raw/good/ray.json"]
    with tempfile.TemporaryDirectory() as folder:
        for problem, at in zip(problems, examples, strict=True):
            proof = Path(folder) / "proof.txt"
            proof.write_text(blocks[at])
            assert run(ROOT / problem, proof) == (0, blocks[at + 1]), problem


def check_files():
    """Files that are no problems are refused, and those that slideway reads are read as it reads them."""
    proof = "slideway proof 1\nproblem 1 0\ncell 0\nb 0\nc 0\nf -1\n"
    texts = {
        '{"type": "lcp", "M": [[1]], "q": [-1]}': 0, '{"M": [[1]], "q": [[-1.0]]}': 0,
        # Integers are rounded to doubles, too: w = 2^53 z - (2^53 + 1) has the solution z = 1.
        '{"M": [[9007199254740992]], "q": [-9007199254740993]}': 0,
        '{"M": [[1]], "q": [1]}': 1, '{"M": [[0]], "q": [-1]}': 1,
        '{"M": [[1]], "q": [-1], "M": [[1]]}': 2, '{"M": [[1]], "q": [NaN]}': 2, '{"M": [[1]], "q": [1e999]}': 2,
        '{"M": [[1]], "q": [true]}': 2, '{"M": [[1]], "q": ["-1"]}': 2, '{"M": [[1, 2]], "q": [-1]}': 2,
        '{"M": [[1], [2]], "q": [-1]}': 2, '{"M": [1], "q": [-1]}': 2, '{"M": [], "q": []}': 2, '{"M": 1, "q": -1}': 2,
        '{"type": "ave", "M": [[1]], "q": [-1]}': 2, '{"M": [[1]], "q": [-1], "r": [1]}': 2, '{"M": [[1]]}': 2,
        "[]": 2, "1": 2, "": 2, "{}": 2, '[["M", [[1]]], ["q", [-1]]]': 2, '{"M": {"0": [1]}, "q": [-1]}': 2,
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        (path / "proof.txt").write_text(proof)
        for text, code in texts.items():
            (path / "problem.json").write_text(text)
            assert run(path / "problem.json", path / "proof.txt")[0] == code, text
        assert run(path / "problem.json", path / "absent.txt")[0] == 2


def proof_of(equations, exponents, rng, lies=0.0):
    prover = Prover(equations, exponents, rng, lies)
    prover.prove((frozenset(range(len(equations.columns))), ()))
    header = ["slideway proof 1", f"problem {equations.size} {len(equations.jumps)}"]
    header += [" ".join(map(str, ["rows", *exponents]))] if exponents else []
    return "\n".join(header + prover.lines) + "\n"


def main(problems=200, mutants=25, seed=1):
    check_examples()
    check_files()
    rng = random.Random(seed)
    steps, outcomes = Counter(), Counter()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.json"
        for number in range(problems):
            data = random_problem(rng)
            path.write_text(json.dumps(data))
            problem_data = check_proof.read_problem(path)
            equations = Equations(data)
            truth = equations.truth()
            exponents = [rng.randint(-3, 3) for _ in equations.right] if rng.random() < 0.3 else []
            text = proof_of(equations, exponents, rng)
            tree = check(problem_data, text)
            assert tree is not None and is_true(tree, equations, truth), (data, text)
            steps.update(line.split()[0] for line in text.splitlines()[2:])
            wrong = (changed(text, rng) if at % 3 else proof_of(equations, exponents, rng, rng.choice([0.05, 0.2]))
                     for at in range(mutants))
            for other in wrong:
                tree = check(problem_data, other)
                outcomes["refused" if tree is None else "accepted and true"] += 1
                assert tree is None or is_true(tree, equations, truth), (data, other)
    missing = set("f z l x c b e s m p cell g rows".split()) - set(steps)
    print(f"{problems} proofs accepted: " + ", ".join(f"{step} {count}" for step, count in sorted(steps.items())))
    print(f"{outcomes.total()} changed or careless proofs: "
          + ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items())))
    return f"no proof has a step {missing}" if missing and problems >= 200 else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
