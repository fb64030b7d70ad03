"""Planar rigid bodies on rough two-sided guides, from one event to the next.

Every body has its three coordinates (x, y, angle). Joints are equations on accelerations, their forces multipliers:

    M a = f + sum_k J_k^T N_k - sum_k W_k(side)^T F_k,        J a = bias

Between events each joint sticks, slides to one side or to the other, and each contact of a sliding joint presses one face: linear
equations, solved as they stand. DOP853 integrates; what ends a phase is looked for at seven places of each step and
located by integrating again from the step's beginning.

At an event all states of the joints concerned are solved, and those are kept whose inequalities hold (sides, direction of sliding,
friction of joints that stick). Where one holds with equality the state is followed for a moment and looked at there.
"""

import itertools
import math
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import DOP853
from scipy.optimize import brentq

BORDER = 1e-9  # inequalities that hold with less, in units of the model's forces, are looked at a moment later
UNBOUNDED = 1e4  # normal forces beyond so much, in units of the model's forces
AT_THE_LIMIT = 1e-11  # a load that passes the static limit by less, in units of the model's forces, is at it


class NoState(Exception):
    """No state of the joints is admissible."""


class Singular(Exception):
    """Normal forces grow without bound, or a spring has no length and no direction."""


class SeveralStates(Exception):
    """Several states are admissible, and the principle does not choose among them."""


@dataclass
class Body:
    mass: float
    inertia: float
    place: tuple


@dataclass
class BlockSlider:
    """Contacts `front` and `rear` at the ends of a block of this length; friction acts at the pressed face."""

    block: int
    guide: int | None
    at: tuple
    angle: float
    length: float
    height: float
    mu: float
    mu_static: float
    preload: float = 0.0


@dataclass
class Hinge:
    body: int
    at: tuple


@dataclass
class Force:
    """A force on a point of a body; `of_time` gives its components."""

    body: int
    at: tuple
    of_time: object


@dataclass
class Spring:
    """Spring and damper between points of two bodies (None: ground)."""

    first: int | None
    first_at: tuple
    second: int | None
    second_at: tuple
    stiffness: float
    free_length: float
    damping: float = 0.0


@dataclass
class TorsionSpring:
    body: int
    stiffness: float
    damping: float = 0.0


@dataclass
class Mechanism:
    bodies: list
    sliders: list
    forces: list
    force_scale: float
    time_scale: float
    hinges: list = field(default_factory=list)
    springs: list = field(default_factory=list)
    torsion_springs: list = field(default_factory=list)
    torques: list = field(default_factory=list)  # (body, function of time)
    gravity: float = 0.0
    jumps: object = None  # index -> time at which forces jump; forces get the index of the piece in which they are evaluated


def turned(angle, vector):
    c, s = math.cos(angle), math.sin(angle)
    return np.array([c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]])


class Simulator:
    def __init__(self, mechanism):
        self.m = mechanism
        self.n = len(mechanism.bodies)
        self.piece = 0
        self.longest_step = mechanism.time_scale / 4
        self.groups = self.find_groups()

    def find_groups(self):
        """Bodies that joints connect without ground between them, with their sliders and hinges."""
        group = list(range(self.n))
        for slider in self.m.sliders:
            if slider.guide is not None:
                old, new = group[slider.block], group[slider.guide]
                group = [new if g == old else g for g in group]
        found = []
        for g in sorted(set(group)):
            bodies = [b for b in range(self.n) if group[b] == g]
            sliders = [j for j, slider in enumerate(self.m.sliders) if group[slider.block] == g]
            hinges = [hinge for hinge in self.m.hinges if group[hinge.body] == g]
            found.append((bodies, sliders, hinges))
        return found

    # geometry

    def local(self, body, at):
        return np.array(at) - np.array(self.m.bodies[body].place if body is not None else (0.0, 0.0))

    def point(self, q, v, body, at):
        """Lever from the centre of mass, place, velocity."""
        if body is None:
            return np.zeros(2), np.array(at, dtype=float), np.zeros(2)
        lever = turned(q[body, 2], self.local(body, at))
        return lever, q[body, :2] + lever, v[body, :2] + v[body, 2] * np.array([-lever[1], lever[0]])

    def slider_frame(self, q, v, slider):
        """u, n, and of each contact: block lever, place against the guide's centre, velocity against it; the guide's turning."""
        guide_angle, turning = (q[slider.guide, 2], v[slider.guide, 2]) if slider.guide is not None else (0.0, 0.0)
        u = np.array([math.cos(slider.angle + guide_angle), math.sin(slider.angle + guide_angle)])
        n = np.array([-u[1], u[0]])
        along = np.array([math.cos(slider.angle), math.sin(slider.angle)])
        ends = []
        for end in (0.5, -0.5):
            lever, place, velocity = self.point(q, v, slider.block, np.array(slider.at) + end * slider.length * along)
            if slider.guide is None:
                ends.append((lever, place, velocity))
            else:
                ends.append((lever, place - q[slider.guide, :2], velocity - v[slider.guide, :2]))
        return u, n, ends, turning

    def sliding(self, q, v):
        """Displacement and velocity of every slider along its guide."""
        places, rates = [], []
        for slider in self.m.sliders:
            u, n, ends, turning = self.slider_frame(q, v, slider)
            _, r, rate = ends[0]
            along = np.array([math.cos(slider.angle), math.sin(slider.angle)])
            drawn = np.array(slider.at) + 0.5 * slider.length * along
            drawn = self.local(slider.guide, drawn)
            places.append(u @ r - along @ drawn)
            rates.append(u @ rate + turning * (n @ r))
        return np.array(places), np.array(rates)

    # forces

    def applied(self, t, q, v):
        f = np.zeros((self.n, 3))

        def add(body, lever, force):
            if body is not None:
                f[body, :2] += force
                f[body, 2] += lever[0] * force[1] - lever[1] * force[0]

        for i, body in enumerate(self.m.bodies):
            f[i, 1] -= body.mass * self.m.gravity
        for force in self.m.forces:
            lever, _, _ = self.point(q, v, force.body, force.at)
            add(force.body, lever, np.array(force.of_time(t, self.piece)))
        for spring in self.m.springs:
            lever, place, velocity = self.point(q, v, spring.first, spring.first_at)
            lever_2, place_2, velocity_2 = self.point(q, v, spring.second, spring.second_at)
            length = math.hypot(*(place_2 - place))
            unit = (place_2 - place) / length
            pull = spring.stiffness * (length - spring.free_length) + spring.damping * (unit @ (velocity_2 - velocity))
            add(spring.first, lever, pull * unit)
            add(spring.second, lever_2, -pull * unit)
        for body, moment in self.m.torques:
            f[body, 2] += moment(t)
        for spring in self.m.torsion_springs:
            f[spring.body, 2] -= spring.stiffness * q[spring.body, 2] + spring.damping * v[spring.body, 2]
        return f

    # one state of a group

    def rows(self, q, v, group):
        """What does not depend on the state: for every contact the row of its gap, its tangents at centre and faces, their biases."""
        bodies, sliders, hinges = group
        column = {body: 3 * i for i, body in enumerate(bodies)}
        size = 3 * len(bodies)

        def tangent(slider, u, lever, r, offset):
            """u . (velocity of the block - velocity of the guide) at an offset from the contact."""
            row = np.zeros(size)
            b = column[slider.block]
            arm = lever + offset
            row[b : b + 3] = u[0], u[1], arm[0] * u[1] - arm[1] * u[0]
            if slider.guide is not None:
                g, arm = column[slider.guide], r + offset
                row[g : g + 3] = -u[0], -u[1], -(arm[0] * u[1] - arm[1] * u[0])
            return row

        found = {}
        for j in sliders:
            slider = self.m.sliders[j]
            u, n, ends, turning = self.slider_frame(q, v, slider)
            contacts = []
            for lever, r, rate in ends:
                spin = v[slider.block, 2]
                # acceleration of the block's point is a + alpha x lever - spin^2 lever
                gap = tangent(slider, n, lever, r, np.zeros(2))
                gap_bias = 2 * turning * (u @ rate) + turning**2 * (n @ r) + spin**2 * (n @ lever)
                slide_bias = -2 * turning * (n @ rate) + turning**2 * (u @ r) + spin**2 * (u @ lever)
                centre = tangent(slider, u, lever, r, np.zeros(2))
                faces = {side: tangent(slider, u, lever, r, -side * slider.height / 2 * n) for side in (1, -1)}
                contacts.append((gap, gap_bias, centre, slide_bias, faces))
            found[j] = contacts
        fixed = []
        for hinge in hinges:
            lever, _, _ = self.point(q, v, hinge.body, hinge.at)
            for axis in (0, 1):
                row = np.zeros(size)
                b = column[hinge.body]
                row[b + axis] = 1.0
                row[b + 2] = -lever[1] if axis == 0 else lever[0]
                fixed.append((row, v[hinge.body, 2] ** 2 * lever[axis]))
        return found, fixed

    def solve(self, prepared, force, masses, state):
        """Accelerations, and of each slider (N_front, N_rear, friction that holds it, sliding acceleration).

        `state` says of each slider (s, side of front, side of rear); s = 0 sticks.
        """
        rows, fixed = prepared
        size = len(masses)
        equations, columns, biases = [], [], []
        load = force.copy()
        for row, bias in fixed:
            equations.append(row), columns.append(row), biases.append(bias)
        for j, (s, *sides) in state.items():
            slider = self.m.sliders[j]
            for (gap, gap_bias, _, _, faces), side in zip(rows[j], sides):
                equations.append(gap), biases.append(gap_bias)
                columns.append(gap - s * slider.mu * side * faces[side] if s else gap)
                if s:
                    load -= s * slider.preload * faces[side]
            if s == 0:
                _, _, centre, slide_bias, _ = rows[j][0]
                equations.append(centre), biases.append(slide_bias), columns.append(-centre)
        k = len(equations)
        matrix = np.zeros((size + k, size + k))
        matrix[:size, :size] = np.diag(masses)
        matrix[:size, size:] = -np.array(columns).T
        matrix[size:, :size] = np.array(equations)
        x = np.linalg.solve(matrix, np.concatenate([load, biases]))
        a, multipliers = x[:size], list(x[size + len(fixed) :])
        found = {}
        for j, (s, *_) in state.items():
            front, rear = multipliers.pop(0), multipliers.pop(0)
            held = multipliers.pop(0) if s == 0 else 0.0
            _, _, centre, slide_bias, _ = rows[j][0]
            found[j] = (front, rear, held, centre @ a - slide_bias)
        return a, found

    def room(self, j, front, rear, held):
        """How much is left until a slider that sticks slips: the greatest least slack over all distributions and sides.

        front, rear, held are the normal forces with all friction `held` on the centre line. If z of it acts at the front's face and
        held - z at the rear's, couples about the middle give N_front = front + c (side_f z + side_r (held - z)), c = h/(2 L), and
        N_rear = front + rear - N_front.
        """
        slider = self.m.sliders[j]
        c, mu, preload = slider.height / (2 * slider.length), slider.mu_static, slider.preload
        best = -math.inf
        for f, r in itertools.product((1, -1), repeat=2):
            # pressures p = slope z + constant
            slope, constant = c * (f - r), c * r * held
            pf = (f * slope, f * (front + constant))
            pr = (-r * slope, r * (rear - constant))
            lines = [pf, pr]
            lines += [(mu * pf[0] - q, mu * pf[1] + preload) for q in (1, -1)]
            lines += [(mu * pr[0] + q, mu * pr[1] + preload - q * held) for q in (1, -1)]
            best = max(best, highest(lines))
        return best

    def inequalities(self, t, q, v, group, state):
        """What has to be positive in this state: (kind, slider, value), and the accelerations."""
        masses, force = self.masses(group), self.applied(t, q, v)[group[0]].ravel()
        a, found = self.solve(self.rows(q, v, group), force, masses, state)
        return a, self.judged(state, found)

    def judged(self, state, found):
        values = []
        for j, (s, *sides) in state.items():
            front, rear, held, _ = found[j]
            if s == 0:
                values.append(("slips", j, self.room(j, front, rear, held) + AT_THE_LIMIT * self.m.force_scale))
            else:
                values += [("side", j, sides[0] * front), ("side", j, sides[1] * rear)]
        return values

    def masses(self, group):
        return np.array([x for b in group[0] for x in [self.m.bodies[b].mass] * 2 + [self.m.bodies[b].inertia]])

    # motion

    def rates(self, t, y, states):
        q, v = y.reshape(2, self.n, 3)
        applied = self.applied(t, q, v)
        out = np.zeros((2, self.n, 3))
        out[0] = v
        for group, state in zip(self.groups, states):
            a, _ = self.solve(self.rows(q, v, group), applied[group[0]].ravel(), self.masses(group), state)
            out[1, group[0]] = a.reshape(-1, 3)
        return out.ravel()

    def events(self, t, y, states):
        """All that has to stay positive."""
        q, v = y.reshape(2, self.n, 3)
        _, rates = self.sliding(q, v)
        values = []
        for group, state in zip(self.groups, states):
            values += self.inequalities(t, q, v, group, state)[1]
            values += [("stops", j, s * rates[j]) for j, (s, *_) in state.items() if s]
        return values

    def advance(self, t, y, until, states, rtol):
        if until == t:
            return y
        solver = DOP853(lambda t, y: self.rates(t, y, states), t, y, until, rtol=rtol, atol=rtol * 0.1, first_step=until - t)
        while solver.status == "running":
            message = solver.step()
            assert solver.status != "failed", message
        return solver.y

    def admissible(self, t, y, group_index, states, state, rest, rtol):
        """Whether a state of the group is one that can follow."""
        q, v = y.reshape(2, self.n, 3)
        group = self.groups[group_index]
        applied = self.applied(t, q, v)[group[0]].ravel()
        try:
            _, found = self.solve(self.rows(q, v, group), applied, self.masses(group), state)
        except np.linalg.LinAlgError:
            return False
        mass = min(self.m.bodies[b].mass for b in group[0])
        values = [value / self.m.force_scale for _, _, value in self.judged(state, found)]
        values += [state[j][0] * found[j][3] * mass / self.m.force_scale for j in rest if state[j][0]]
        if min(values) < -BORDER:
            return False
        if min(values) > BORDER:
            return True
        moment = 1e-4 * self.m.time_scale
        trial = [state if i == group_index else s for i, s in enumerate(states)]
        later = self.advance(t, y, t + moment, trial, rtol)
        q, v = later.reshape(2, self.n, 3)
        _, rates = self.sliding(q, v)
        values = [value for _, _, value in self.inequalities(t + moment, q, v, group, state)[1]]
        values += [state[j][0] * rates[j] for j in rest if state[j][0]]
        return min(values) > 0

    def decide(self, t, y, group_index, states, signs, before, at_limit, rtol):
        """The state that follows in a group: `signs` has 0 for sliders at rest, `before` those that stuck, `at_limit` what slips."""
        sliders = self.groups[group_index][1]
        rest = [j for j in sliders if signs[j] == 0]
        found = []
        for choice in itertools.product(*[(0, 1, -1) if j in rest else (signs[j],) for j in sliders]):
            sided = [itertools.product((1, -1), repeat=2) if s else [(1, 1)] for s in choice]
            for sides in itertools.product(*sided):
                state = {j: (s, *side) for j, s, side in zip(sliders, choice, sides)}
                if self.admissible(t, y, group_index, states, state, rest, rtol):
                    found.append(state)
        if not found:
            raise NoState(f"{t}: {[self.m.sliders[j] for j in sliders]}")
        sticking = [frozenset(j for j, state in one.items() if state[0] == 0) for one in found]
        # maximal by inclusion, those that stuck before first
        most = max(len(s & before) for s in sticking)
        kept = [i for i, s in enumerate(sticking) if len(s & before) == most]
        kept = [i for i in kept if not any(sticking[i] < sticking[k] for k in kept)]
        # of two that could let go, the one at its limit does
        kept = [i for i in kept if before - sticking[i] <= at_limit] or kept
        if len(kept) > 1:
            raise SeveralStates(f"{t}: {[found[i] for i in kept]}")
        return found[kept[0]], len(found)

    def at_rest(self, q, v, group_states):
        """Velocities on the joints' equations, sliders that stick included: the nearest in the norm of the masses."""
        v = v.copy()
        for group, state in zip(self.groups, group_states):
            rows, fixed = self.rows(q, v, group)
            equations = [row for row, _ in fixed]
            for j, (s, *_) in state.items():
                equations += [rows[j][0][0], rows[j][1][0]]
                if s == 0:
                    equations.append(rows[j][0][2])
            g, inverse = np.array(equations), 1 / self.masses(group)
            w = v[group[0]].ravel()
            w = w - inverse * (g.T @ np.linalg.solve((g * inverse) @ g.T, g @ w))
            v[group[0]] = w.reshape(-1, 3)
        return v

    def run(self, rates, until, rtol=1e-12):
        """The motion from the drawing; `rates` are the bodies' velocities. Changes of each slider's state, last state, choices."""
        q = np.array([[*body.place, 0.0] for body in self.m.bodies])
        y = np.array([q, rates]).reshape(-1)
        t, sliders = 0.0, range(len(self.m.sliders))
        _, speeds = self.sliding(*y.reshape(2, self.n, 3))
        signs = [0 if abs(x) < 1e-12 else int(math.copysign(1, x)) for x in speeds]
        states = [{j: (signs[j], 1, 1) for j in group[1]} for group in self.groups]
        self.piece, choices = 0, 0
        for g in range(len(self.groups)):
            states[g], count = self.decide(t, y, g, states, signs, frozenset(), frozenset(), rtol)
            choices += count > 1
        log = [[] for _ in sliders]
        self.note(log, t, states)
        while t < until:
            end = min(until, self.m.jumps(self.piece)) if self.m.jumps else until
            t, y, happened = self.until_event(t, y, states, end, rtol)
            if happened is None and t >= until:
                break
            q, v = y.reshape(2, self.n, 3)
            at_limit = {j for kind, j in happened or [] if kind == "slips"}
            stopped = {j for kind, j in happened or [] if kind == "stops"}
            before = frozenset(j for state in states for j, (s, *_) in state.items() if s == 0)
            signs = [0 if j in stopped or j in before else self.state_of(states, j)[0] for j in sliders]
            held = [{j: (signs[j], *one[1:]) for j, one in state.items()} for state in states]
            v = self.at_rest(q, v, held)
            y = np.array([q, v]).reshape(-1)
            if happened is None:
                self.piece += 1
                concerned = range(len(self.groups))
            else:
                concerned = [g for g, group in enumerate(self.groups) if any(j in group[1] for _, j in happened)]
            for g in concerned:
                states[g], count = self.decide(t, y, g, states, signs, before, at_limit, rtol)
                choices += count > 1
            self.note(log, t, states)
        return log, t, y, choices

    def state_of(self, states, j):
        return next(state[j] for state in states if j in state)

    def note(self, log, t, states):
        for j, entries in enumerate(log):
            s, *sides = self.state_of(states, j)
            word = "=" if s == 0 else "<>"[s > 0] + "".join("-+"[side > 0] for side in sides)
            if not entries or entries[-1][1] != word:
                entries.append((t, word))

    def until_event(self, t, y, states, end, rtol):
        """Integrates until something has to be decided, or to the end: time, state, [(kind, slider)] or None."""
        solver = DOP853(lambda t, y: self.rates(t, y, states), t, y, end, rtol=rtol, atol=rtol * 0.1, max_step=self.longest_step)
        first = True
        while solver.status == "running":
            before = solver.y.copy()
            message = solver.step()
            assert solver.status != "failed", message
            dense = solver.dense_output()
            begin, stop = solver.t_old, solver.t
            last = begin
            known = [math.inf if first else value for _, _, value in self.events(begin, before, states)]
            first, directions = False, self.directions(before)
            for part in range(1, 8):
                here = begin + (stop - begin) * part / 7
                values = self.events(here, dense(here), states)
                if any(old @ new < 0 for old, new in zip(directions, self.directions(dense(here)))):
                    raise Singular(f"{here}: a spring passes through zero length")
                if any(kind == "side" and abs(value) > UNBOUNDED * self.m.force_scale for kind, _, value in values):
                    raise Singular(f"{here}: normal forces grow without bound")
                crossed = [i for i, (_, _, value) in enumerate(values) if value <= 0 and known[i] > 0]
                if crossed:
                    return self.locate(begin, before, last, here, states, crossed, rtol)
                known, last = [value for _, _, value in values], here
        return solver.t, solver.y, None

    def directions(self, y):
        q, v = y.reshape(2, self.n, 3)
        ends = [(self.point(q, v, s.first, s.first_at)[1], self.point(q, v, s.second, s.second_at)[1]) for s in self.m.springs]
        return [second - first for first, second in ends]

    def locate(self, begin, y, last, here, states, crossed, rtol):
        """The first of these zeros, from the step's beginning."""
        found = []
        for i in crossed:
            value = lambda t, i=i: self.events(t, self.advance(begin, y, t, states, rtol), states)[i][2]
            low = value(last)
            if low <= 0:
                # it begins at zero and goes down at once
                raise NoState(f"{last}: a state that was admissible ends at once")
            found.append((brentq(value, last, here, xtol=1e-15, rtol=1e-15), i))
        first = min(time for time, _ in found)
        after = self.advance(begin, y, first, states, rtol)
        if first == begin:
            raise Singular(f"{first}: a state ends as it begins")
        values = self.events(first, after, states)
        together = [i for time, i in found if time - first < 1e-12]
        return first, after, [values[i][:2] for i in together]


def highest(lines):
    """max over z of min over lines of slope z + constant; infinity if it grows without bound."""
    rising = [line for line in lines if line[0] > 1e-15]
    falling = [line for line in lines if line[0] < -1e-15]
    level = [constant for slope, constant in lines if abs(slope) <= 1e-15]
    best = min(level, default=math.inf)
    if not rising or not falling:
        return best
    # the lower envelope of rising and falling lines meets where the least of all their crossings is
    for (a, b), (c, d) in itertools.product(rising, falling):
        best = min(best, b + a * (d - b) / (a - c))
    return best
