"""Rational linear programs and linear algebra, for the prover and the oracle: independent of the checker."""

from fractions import Fraction


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
