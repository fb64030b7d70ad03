"""Random problems given by matrices, their equations in rational numbers, and what is true about them."""

import itertools
from fractions import Fraction

from rationals import linear_program


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
        self.columns = [pair[side] + [Fraction(0)] * added for side in (0, 1) for pair in pairs]
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
                return [[x * rng.choice([0.1, 0.1, 10.0 ** rng.randint(-20, 20)]) for x in row] for row in matrix()]
            return {"type": "ave", "A": spread(), "B": spread(), "b": [x * 0.1 for x in vector()]}
        case "monotone":
            # D^-1 (G' G + a skew-symmetric matrix), which the weights D make semidefinite.
            factor, skew = matrix(0.6), matrix(0.6)
            weights = [rng.choice([1, 1, 2]) for _ in range(n)]
            m = [[sum(g[i] * g[j] for g in factor) + skew[i][j] - skew[j][i] for j in range(n)] for i in range(n)]
            return {"type": "lcp", "M": [[x / w for x in row] for row, w in zip(m, weights)], "q": vector()}
        case "blocks" | "chain":
            # Two groups that are independent, or that one contact acts on.
            group = rng.choice([[0, 0, 1, 1], [0, 1, 1]] if kind == "blocks" else [[0, 1, 2, 2], [0, 1, 2]])
            n = len(group)
    data = {"type": "modes", "columns_positive": matrix(), "columns_negative": matrix(), "right_hand_side": vector()}
    if rng.random() < 0.7 and n <= 3:
        data |= {"jumps_positive": matrix(0.5), "jumps_negative": matrix(0.5)}
    for name in set(data) - {"type", "right_hand_side"} if kind in ("blocks", "chain") else ():
        data[name] = [[x if group[i] == group[j] or kind == "chain" and j == 0 and "columns" in name else 0
                       for j, x in enumerate(row)] for i, row in enumerate(data[name])]
    return data
