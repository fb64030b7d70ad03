"""Whether a random mechanism can stay at rest: friction within its limits at every contact, by rational linear programs."""
import math
import sys
from fractions import Fraction
from itertools import product

from common import ROOT
from mechanism_make import contacts
from newton_euler import Equations, along

sys.path.insert(0, str(ROOT / "reference" / "proofs"))

from rationals import linear_program  # noqa: E402: in the folder of the checker's test

NEAR = 1e-6             # a mechanism that this change of all friction brings to slip is left out
GRID = 10 ** 9          # entries are rounded to such fractions: far less than NEAR


def reaches(m):
    """Whether this oracle knows the law of every contact: no rough hinges, redundant rails or preloads at two places."""
    plain = all(not j.pin and not (any(j.preload) and j.height) and j.preload[0] == j.preload[1] for j in m.joints)
    return plain and not m.family.startswith("rails")


class Rest(Equations):
    """The mechanism without its rates and drives."""

    def velocity(self):
        return {name: (0.0, 0.0, 0.0) for name in self.names}


def holds(m, f, load):
    """True, False, or None if it is on the edge."""
    easy, hard = (any(feasible(Rest(m, f * factor, load), sides) for sides in product((1, -1), repeat=sum(len(contacts(j)) for j in m.joints)))
                  for factor in (1 + NEAR, 1 - NEAR))
    return True if hard else None if easy else False


def feasible(eq, sides):
    """Whether forces with these signs balance the loads. Unknowns that may have both signs are differences of two."""
    size, columns, limits = 3 * len(eq.names), [], []

    def both_signs(column):
        columns.extend([column, {row: -x for row, x in column.items()}])
        return len(columns) - 2
    for j in eq.m.joints:
        if j.kind == "hinge":
            both_signs(eq.both(j, j.at, (1.0, 0.0)))
            both_signs(eq.both(j, j.at, (0.0, 1.0)))
    for (j, _, s), side in zip(eq.contacts, sides):
        normal = (-side * math.sin(j.angle), side * math.cos(j.angle))
        columns.append(eq.both(j, along(j, s), normal))
        pressed = len(columns) - 1
        rubbing = both_signs(eq.friction(j, s, side, True))
        limits.append((rubbing, pressed, eq.f * j.mu[0 if side > 0 else 1], j.preload[0]))
        if j.kind == "guided_slider":
            couple = both_signs(eq.both(j, along(j, s), (0.0, 0.0), 1.0))
            limits.append((couple, pressed, j.length / 2, 0.0))
    right = [-x for x in eq.applied()]
    # mu N + F_0 - (F+ + F-) = slack: the parts of F may be as small as their difference.
    for unknown, pressed, factor, constant in limits:
        row = len(right)
        right.append(-constant)
        columns[pressed][row] = factor
        columns[unknown][row] = columns[unknown + 1][row] = -1.0
        columns.append({row: -1.0})
    exact = [[Fraction(round(column.get(i, 0.0) * GRID), GRID) for i in range(len(right))] for column in columns]
    load = [Fraction(round(x * GRID), GRID) for x in right]
    assert size <= len(right)
    return linear_program(exact, load, [0] * len(exact))[0] != "empty"
