"""A prover that writes proofs of small problems: branch and bound with rational linear programs."""

import itertools
import math
import operator
from fractions import Fraction

from problems import part_of
from rationals import determinant, linear_program, null_space, rank


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
                weights = rng.choices([0, 1, 1], k=rng.randint(1, len(self.equations.pairs)))
                self.lines.append(" ".join(map(str, ["m", number, *weights])))
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
        rows = range(len(self.equations.right))
        basis = null_space([[self.equations.columns[j][i] for j in real] for i in rows], len(real))
        at = {j: k for k, j in enumerate(real)}
        def form(u, v):
            weighted = zip(self.equations.pairs, weights)
            return sum(w * (u[at[a]] * v[at[b]] + v[at[a]] * u[at[b]]) for (a, b), w in weighted if {a, b} <= at.keys())
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


def proof_of(equations, exponents, rng, lies=0.0):
    prover = Prover(equations, exponents, rng, lies)
    prover.prove((frozenset(range(len(equations.columns))), ()))
    header = ["slideway proof 1", f"problem {equations.size} {len(equations.jumps)}"]
    header += [" ".join(map(str, ["rows", *exponents]))] if exponents else []
    return "\n".join(header + prover.lines) + "\n"
