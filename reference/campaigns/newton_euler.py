"""All solutions of a random mechanism by the equations of every body and of every joint, for each pattern of signs by itself.

Nothing is eliminated: the unknowns are the accelerations of all bodies, all forces, and the deflections of a carriage on rails.
Accelerations of joints are second coefficients of Taylor polynomials in time. Floating-point numbers; `doubtful` tells where a
pattern is too near to its boundary for them. One hinge may be rough: a quadratic for each pattern.
"""
import math
from itertools import product

from mechanism_make import contacts

NEAR = 1e-6


class Taylor:
    """A polynomial in time up to its square."""

    def __init__(self, *coefficients):
        self.c = (*coefficients, 0.0, 0.0)[:3]

    def __add__(self, other):
        return Taylor(*(x + y for x, y in zip(self.c, other.c)))

    def __sub__(self, other):
        return Taylor(*(x - y for x, y in zip(self.c, other.c)))

    def __mul__(self, other):
        a, b = self.c, other.c
        return Taylor(a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[0] * b[2] + a[1] * b[1] + a[2] * b[0])


def turned(x, y, omega):
    """The vector turned by the angle omega t."""
    cos, sin = Taylor(1.0, 0.0, -omega * omega / 2), Taylor(0.0, omega)
    return Taylor(x) * cos - Taylor(y) * sin, Taylor(x) * sin + Taylor(y) * cos


class Motion:
    """Places of material points over time, for velocities (x, y, angle) of each body and no accelerations."""

    def __init__(self, mechanism, velocities):
        self.m, self.v = mechanism, velocities

    def spin(self, body):
        return 0.0 if body == "ground" else self.v[body][2]

    def point(self, body, at):
        if body == "ground":
            return Taylor(at[0]), Taylor(at[1])
        centre, (vx, vy, omega) = self.m.bodies[body][2], self.v[body]
        x, y = turned(at[0] - centre[0], at[1] - centre[1], omega)
        return x + Taylor(centre[0], vx), y + Taylor(centre[1], vy)


def along(j, s):
    return (j.at[0] + s * math.cos(j.angle), j.at[1] + s * math.sin(j.angle))


def conditions(m, motion):
    """What vanishes at all times, as polynomials; of redundant rails only those of the first."""
    found, redundant = [], m.family.startswith("rails")
    for j in m.joints:
        if redundant and j.name == "r":
            continue
        if j.kind == "hinge":
            a, b = motion.point(j.block, j.at), motion.point(j.guide, j.at)
            found += [a[0] - b[0], a[1] - b[1]]
            continue
        carried = j.carried if j.kind == "block_slider" else ("block",)
        for (_, s), by in zip(contacts(j), carried):
            point, line = (j.block, j.guide) if by == "block" else (j.guide, j.block)
            place, origin = motion.point(point, along(j, s)), motion.point(line, along(j, -0.3))
            normal = turned(-math.sin(j.angle), math.cos(j.angle), motion.spin(line))
            found.append(normal[0] * (place[0] - origin[0]) + normal[1] * (place[1] - origin[1]))
        if j.kind == "guided_slider":
            found.append(Taylor(0.0, motion.spin(j.block) - motion.spin(j.guide)))
    return found


def coordinate(m, motion, kind, of):
    """A coordinate over time."""
    if kind == "rotation":
        return Taylor(0.0, motion.spin(of))
    j = m.joint(of)
    # A point of the block against the guide's frame: the one that is not carried by the guide has the same component along it.
    place, origin = motion.point(j.block, j.at), motion.point(j.guide, j.at)
    tangent = turned(math.cos(j.angle), math.sin(j.angle), motion.spin(j.guide))
    return tangent[0] * (place[0] - origin[0]) + tangent[1] * (place[1] - origin[1])


def solve_linear(rows, right):
    """The solution; "none" if the equations contradict each other; None if they may have more than one."""
    a = []
    for row, r in zip(rows, right):
        size = max(map(abs, row))
        a.append([x / size for x in row] + [r / size] if size else [0.0] * len(row) + [r])
    n = len(rows[0])
    scale = [max(abs(row[k]) for row in a) or 1.0 for k in range(n)]
    a = [[x / s for x, s in zip(row, scale)] + row[n:] for row in a]
    done, pivots = 0, []
    for k in range(n):
        p = max(range(done, n), key=lambda i: abs(a[i][k]), default=None)
        if p is None or abs(a[p][k]) < 1e-9:
            continue
        a[done], a[p] = a[p], a[done]
        for i in range(n):
            factor = a[i][k] / a[done][k]
            if i != done and factor:
                a[i] = [x - factor * y for x, y in zip(a[i], a[done])]
        pivots.append(k)
        done += 1
    if done < n:
        size = max(abs(row[n]) for row in a) or 1.0
        return "none" if any(abs(row[n]) > 1e-6 * size for row in a[done:]) else None
    return [a[k][n] / a[k][k] / scale[k] for k in range(n)]


class Equations:
    """The linear equations of a mechanism but for the friction: a table of columns by the name of their unknown."""

    def __init__(self, m, f, load):
        self.m, self.f, self.load = m, f, load
        self.names = list(m.bodies)
        self.velocities = self.velocity()
        self.contacts = [(j, name, s) for j in m.joints for name, s in contacts(j)]
        self.redundant = m.family.startswith("rails")

    def unit_motions(self):
        for k in range(3 * len(self.names)):
            yield Motion(self.m, {name: tuple(1.0 if 3 * i + c == k else 0.0 for c in range(3)) for i, name in enumerate(self.names)})

    def velocity(self):
        def first(motion):
            return [p.c[1] for p in conditions(self.m, motion)] + [coordinate(self.m, motion, kind, of).c[1]
                                                                    for _, kind, of, _ in self.m.coordinates]
        columns = [first(motion) for motion in self.unit_motions()]
        rates = [rate for *_, rate in self.m.coordinates]
        right = [0.0] * (len(columns[0]) - len(rates)) + rates
        assert len(right) == len(columns), "the mechanism has not as many coordinates as degrees of freedom"
        v = solve_linear([list(row) for row in zip(*columns)], right)
        if not isinstance(v, list):
            raise ArithmeticError("a singular position")
        return {name: tuple(v[3 * i:3 * i + 3]) for i, name in enumerate(self.names)}

    def wrench(self, body, at, force, couple=0.0):
        """{row: entry} of a force on a body."""
        if body == "ground":
            return {}
        centre = self.m.bodies[body][2]
        i = 3 * self.names.index(body)
        return {i: force[0], i + 1: force[1], i + 2: (at[0] - centre[0]) * force[1] - (at[1] - centre[1]) * force[0] + couple}

    def both(self, j, at, force, couple=0.0):
        column = self.wrench(j.block, at, force, couple)
        for row, x in self.wrench(j.guide, at, (-force[0], -force[1]), -couple).items():
            column[row] = column.get(row, 0.0) + x
        return column

    def sliding(self, j, s):
        motion = Motion(self.m, self.velocities)
        a, b = motion.point(j.block, along(j, s)), motion.point(j.guide, along(j, s))
        return sum((p - q).c[1] * t for p, q, t in zip(a, b, (math.cos(j.angle), math.sin(j.angle))))

    def applied(self):
        total = [0.0] * (3 * len(self.names))

        def add(column):
            for row, x in column.items():
                total[row] += x
        motion = Motion(self.m, self.velocities)
        for name, (mass, _, centre) in self.m.bodies.items():
            add(self.wrench(name, centre, (0.0, -mass * self.m.gravity)))
        for body, at, (x, y) in self.m.forces:
            add(self.wrench(body, at, (x * self.load, y * self.load)))
        for body, moment in self.m.torques:
            add(self.wrench(body, self.m.bodies[body][2], (0.0, 0.0), moment * self.load))
        for body, at, end, stiffness, free, damping in self.m.springs:
            dx, dy = end[0] - at[0], end[1] - at[1]
            length = math.hypot(dx, dy)
            place = motion.point(body, at)
            rate = -(dx * place[0].c[1] + dy * place[1].c[1]) / length
            pull = stiffness * (length - free) + damping * rate
            add(self.wrench(body, at, (pull * dx / length, pull * dy / length)))
        return total

    def friction(self, j, s, side, magnitude_line):
        """The column of a unit friction force with the pressed face of that side, or on the centre line (0)."""
        sign = math.copysign(1.0, self.sliding(j, s))           # at rest either sign is meant
        height = -j.height if j.around else j.height
        x, y = along(j, s)
        offset = -side * height / 2 if magnitude_line else 0.0
        at = (x - offset * math.sin(j.angle), y + offset * math.cos(j.angle))
        return self.both(j, at, (-sign * math.cos(j.angle), -sign * math.sin(j.angle)))


def jumps(j):
    return any(j.preload) and (j.preload[0] != j.preload[1] or (j.height != 0.0 and not j.centre))


def solutions(m, f, load):
    """(list of solutions, list of gap states, list of rejected ones, doubtful): each a dict of forces and accelerations."""
    eq = Equations(m, f, load)
    kinds = []
    for j, _, _ in eq.contacts:
        kinds.append((1, -1, 0) if jumps(j) or eq.redundant and j.play else (1, -1))
    found, between, rejected, doubtful = [], [], [], False
    for pattern in product(*kinds):
        for verdict, solution in one_pattern(eq, pattern):
            if verdict == "doubtful":
                doubtful = True
            elif verdict == "tips":
                rejected.append(solution)
            elif verdict == "holds":
                (between if 0 in pattern and not eq.redundant else found).append(solution)
    return found, between, rejected, doubtful


def one_pattern(eq, pattern):
    """[(verdict, solution)] of a pattern; its verdict is "doubtful" if its equations are singular."""
    m, bodies = eq.m, len(eq.names)
    names, columns = [], []
    right = eq.applied()
    size = 3 * bodies

    def unknown(name, column):
        names.append(name)
        columns.append(dict(column))
    inertia = [x for mass, moment, _ in m.bodies.values() for x in (mass, mass, moment)]
    for k in range(size):
        unknown(("a", k), {k: -inertia[k]})
    for j in m.joints:
        if j.kind == "hinge":
            unknown(("R", j.name, 0), eq.both(j, j.at, (1.0, 0.0)))
            unknown(("R", j.name, 1), eq.both(j, j.at, (0.0, 1.0)))
    for (j, name, s), side in zip(eq.contacts, pattern):
        normal = (-math.sin(j.angle), math.cos(j.angle))
        column = eq.both(j, along(j, s), normal)
        plus, minus = j.preload
        line = not j.centre
        if side:
            mu = eq.f * j.mu[0 if side > 0 else 1]
            add(column, eq.friction(j, s, side, True), mu * side)
            add_right(right, eq.friction(j, s, side, line), plus if side > 0 else minus)
            unknown(("N", name), column)
        elif not eq.redundant:          # between the faces: the share of the preload's friction at the face of N > 0
            column = {}
            add(column, eq.friction(j, s, 1, line), plus)
            add(column, eq.friction(j, s, -1, line), -minus)
            add_right(right, eq.friction(j, s, -1, line), minus)
            unknown(("share", name), column)
        if j.kind == "guided_slider":
            unknown(("C", name), eq.both(j, along(j, s), (0.0, 0.0), 1.0))
    if m.drive:
        _, _, body, at, angle = m.drive
        unknown(("effort",), eq.wrench(body, at, (math.cos(angle), math.sin(angle))) if at else
                eq.wrench(body, m.bodies[body][2], (0.0, 0.0), 1.0))
    right = [-x for x in right]
    rows = [[column.get(i, 0.0) for column in columns] for i in range(size)]
    kinematics(eq, names, rows, right)
    if eq.redundant:
        deflections(eq, pattern, names, rows, right)
    if len(rows) != len(rows[0]):
        return []
    x = solve_linear(rows, right)
    rough = [j for j in m.joints if j.pin]
    if not isinstance(x, list):
        return [] if x == "none" and not rough else [("doubtful", None)]
    if not rough:
        return [judge(eq, pattern, dict(zip(names, x)))]
    return with_pin(eq, pattern, names, rows, right, x, *rough)


def with_pin(eq, pattern, names, rows, right, x, j):
    """The same with one rough hinge: its couple has the magnitude r |R|, and R depends linearly on it."""
    turning = eq.velocities[j.block][2] - (0.0 if j.guide == "ground" else eq.velocities[j.guide][2])
    if turning == 0.0:
        return [("doubtful", None)]
    circle = j.pin[0] * math.sin(math.atan(eq.f * j.pin[1]))
    other = list(right)
    for row, entry in eq.both(j, j.at, (0.0, 0.0), -math.copysign(circle, turning)).items():
        other[row] -= entry
    y = solve_linear(rows, other)
    places = [names.index(("R", j.name, k)) for k in (0, 1)]
    change = [b - a for a, b in zip(x, y)]
    # |R_0 + m R_1| = m
    a = sum(change[k] ** 2 for k in places) - 1
    b, c = 2 * sum(x[k] * change[k] for k in places), sum(x[k] ** 2 for k in places)
    square = b * b - 4 * a * c
    if abs(a) < NEAR or abs(square) < NEAR * (b * b + abs(a * c)):
        return [("doubtful", None)]
    roots = [(-b + sign * math.sqrt(square)) / (2 * a) for sign in (1, -1)] if square > 0 else []
    return [judge(eq, pattern, dict(zip(names, (p + m * q for p, q in zip(x, change))))) for m in roots if m >= 0]


def add(column, other, factor):
    for row, x in other.items():
        column[row] = column.get(row, 0.0) + factor * x


def add_right(right, column, factor):
    for row, x in column.items():
        right[row] += factor * x


def kinematics(eq, names, rows, right):
    m, here = eq.m, Motion(eq.m, eq.velocities)
    units = list(eq.unit_motions())

    def require(function, value):
        rows.append([0.0] * len(names))
        for k, motion in enumerate(units):
            rows[-1][k] = function(motion).c[1]
        right.append(value - 2 * function(here).c[2])
    for i in range(len(conditions(m, here))):
        require(lambda motion, i=i: conditions(m, motion)[i], 0.0)
    if m.drive:
        _, kind, of, _ = next(c for c in m.coordinates if c[0] == m.drive[0])
        require(lambda motion: coordinate(m, motion, kind, of), m.drive[1])


def deflections(eq, pattern, names, rows, right):
    """The law of each contact, in the displacement and tilt of the carriage: two more unknowns."""
    for row in rows:
        row += [0.0, 0.0]
    names += [("y",), ("tilt",)]
    rigid = all(j.stiffness is None for j in eq.m.joints)
    equal = rigid and all(not j.play for j in eq.m.joints)
    for (j, name, s), side in zip(eq.contacts, pattern):
        if side == 0:
            continue
        row = [0.0] * len(names)
        row[-2], row[-1] = 1e-4, 1e-4 * (j.at[0] + s)
        if not rigid or equal:
            row[names.index(("N", name))] = 1e-3 if equal else 1 / j.stiffness
        rows.append(row)
        right.append(-side * j.play / 2 + line_offset(j, s))


def line_offset(j, s):
    return j.misalignment if s > 0 else 0.0


def judge(eq, pattern, x):
    normal = {name: x.get(("N", name), 0.0) for _, name, _ in eq.contacts}
    scale = max([abs(v) for k, v in x.items() if k[0] in "RN"] + [abs(v) for v in eq.applied()]) or 1.0
    verdict = "holds"
    for (j, name, s), side in zip(eq.contacts, pattern):
        if side:
            verdict = worst(verdict, side * normal[name] / scale)
        elif eq.redundant:
            d = 1e-4 * (x[("y",)] + (j.at[0] + s) * x[("tilt",)]) - line_offset(j, s)
            verdict = worst(verdict, (j.play / 2 - abs(d)) / (j.play or 1.0))
        else:
            verdict = worst(verdict, min(x[("share", name)], 1 - x[("share", name)]))
    if verdict == "holds":
        for j, name, _ in eq.contacts:
            couple = abs(x.get(("C", name), 0.0))
            room = abs(normal[name]) * j.length / 2 - couple
            if ("C", name) in x and worst("holds", room / (scale * j.length)) != "holds":
                verdict = "doubtful" if worst("holds", room / (scale * j.length)) == "doubtful" else "tips"
    accelerations = [x[("a", k)] for k in range(3 * len(eq.names))]
    return verdict, {"pattern": "".join("0+-"[side] for side in pattern), "normal": list(normal.values()), "acceleration": accelerations,
                     "effort": x.get(("effort",))}


def worst(verdict, room):
    if verdict == "no" or room < -NEAR:
        return "no"
    return "doubtful" if verdict == "doubtful" or room < NEAR else "holds"
