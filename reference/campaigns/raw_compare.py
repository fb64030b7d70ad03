"""An answer of `slideway modes` beside the exact solutions."""
from fractions import Fraction
from itertools import product

from exact import echelon
from raw_problems import has_jumps, names, number, reported, signs

GREATEST, LEAST = Fraction(1.7976931348623157e308), Fraction(2.2250738585072014e-308)
RELATIVE = Fraction(1, 10 ** 9)


def compare(problem, exact, answer, option, total):
    """What is wrong with the answer, "kind: details", or None."""
    if "faults" in answer:
        allowed = {"block_ave": "too close", "ave": "overflows"}.get(problem["type"])
        return None if allowed and allowed in str(answer["faults"]) else f"refused: {answer['faults']}"
    if option == "unique":
        fault = uniqueness(problem, exact, answer)
        if fault:
            return fault
    if has_jumps(problem) and (exact.continua or duplicates(problem, exact.points)):
        return existence(exact, answer)
    total["left open"] += problem["type"] == "block_ave" and answer["complete"] != "proven" and not answer["partial"]
    if problem["type"] == "block_ave" and exact.delicate and answer["complete"] != "proven":
        return points_fault(problem, exact.points, answer["solutions"], total, False)
    whole = not answer["partial"]
    if option in ("any", "found2", "nodes") and not whole:
        return part(problem, exact, answer, option, total)
    if answer["complete"] != "proven":
        return f"not proven: {answer['open']}"
    fault = counts(problem, exact, answer)
    # A stream tells sets with free unknowns in pieces.
    told = option == "count" or option == "stream" and exact.continua
    return fault or (None if told else lists(problem, exact, answer, total) or hint(problem, answer))


def duplicates(problem, points):
    shown = [tuple(reported(problem, p)) for p in points]
    return len(set(shown)) < len(shown)


def existence(exact, answer):
    if (answer["status"] == "none") != exact.empty() and answer["status"] != "unknown":
        return f"status: {answer['status']}, exactly {len(exact.points)} points and {len(exact.continua)} sets"
    return None


def gaps(problem, points):
    """(solutions, states in gaps)"""
    if not has_jumps(problem):
        return points, []
    between = [any(0 < slot[2] < 1 and slot[:2] == (0, 0) for slot in p) for p in points]
    return [p for p, b in zip(points, between) if not b], [p for p, b in zip(points, between) if b]


def counts(problem, exact, answer):
    solutions, between = gaps(problem, exact.points)
    true = {"count": len(solutions), "gap_state_count": len(between), "continuum_count": len(exact.continua)}
    comes = {name: int(answer[name]) for name in true}
    if comes != true:
        return f"counts: {comes}, exactly {true}; points {[shown(problem, p) for p in exact.points]}"
    status = ("continuum" if exact.continua else "several" if len(solutions) > 1 else "one" if solutions
              else "preload_gap" if between else "none")
    return None if answer["status"] == status else f"status: {answer['status']}, exactly {status}"


def shown(problem, lifted):
    return [str(x) if len(str(x)) < 40 else float_or_text(x) for x in reported(problem, lifted)]


def float_or_text(x):
    try:
        return repr(float(x))
    except OverflowError:
        return "beyond the range"


def flat(problem, solution):
    return [solution[name] if k is None else solution[name][k] for name, k in names(problem)[0]]


def beyond(problem, solution):
    # A payoff has the index 0 there.
    return {(x["name"], None if x["name"].startswith("payoff") else x.get("index")): x["value"]
            for x in solution.get("beyond_range", [])}


def value_fault(value, true, radius, text):
    """Why a reported number is not the exact one, or None."""
    if value is None:
        if LEAST <= abs(true) <= GREATEST or true == 0:
            return "no number is shown, but there is one"
        return None if text and text_holds(text, true) else f"beyond the range: {text}"
    if abs(Fraction(value) - true) > radius:
        return f"{value!r}, farther than {float(radius):.3g}"
    return None


def nearest(text):
    """The value in a text such as "1.5e310", "more than 1.7e308" or "between 0 and 2.2e-308": of a bound, the bound."""
    return Fraction(text.split()[-1])


def text_holds(text, true):
    bound = nearest(text)
    if text.startswith("more than"):
        return true > bound
    if text.startswith("less than"):
        return true < bound
    if text.startswith("between"):
        low, high = sorted([Fraction(text.split()[1]), bound])
        return low < true < high
    return abs(bound - true) <= abs(true) / 10 ** 14


def solution_fault(problem, point, solution, total):
    true, comes, texts = reported(problem, point), flat(problem, solution), beyond(problem, solution)
    largest = max(map(abs, true), default=Fraction(0))
    if solution.get("enclosure_radius") is None:
        total["no radius"] += 1
        radius = largest * RELATIVE
    else:
        radius = Fraction(solution["enclosure_radius"])
        inside = max([abs(x) for x in true if abs(x) <= GREATEST], default=Fraction(0))
        is_wide = radius > inside * RELATIVE + Fraction(5e-324)
        # Roots of blocks are not rational: their bounds are as wide as rounding makes them.
        total["wide blocks"] += is_wide and problem["type"] == "block_ave"
        if is_wide and problem["type"] != "block_ave":
            return f"wide: radius {float(radius):.3g}, exactly {shown(problem, point)}"
    for (name, k), value, x in zip(names(problem)[0], comes, true):
        fault = value_fault(value, x, radius, texts.get((name, k)))
        if fault:
            return f"value: {name}[{k}] {fault}, exactly {shown(problem, point)}"
    for k, (sign, x) in enumerate(zip(solution["signs"], signs(problem, point))):
        # A component of a block that may be zero within its radius has the sign 0.
        is_open = problem["type"] == "block_ave" and sign == 0 and abs(true[k]) <= radius
        if x is not None and sign != x and not is_open:
            return f"sign: of unknown {k} {sign}, exactly {x}, {shown(problem, point)}"
    return None


def distances(problem, point, solution):
    """How many signs of a solution are not those of a point, and how far its numbers are from there, relative to their size, the
    farthest first."""
    texts, far = beyond(problem, solution), []
    other = sum(x is not None and sign != x for sign, x in zip(solution["signs"], signs(problem, point)))
    for item, value, x in zip(names(problem)[0], flat(problem, solution), reported(problem, point)):
        value = Fraction(value) if value is not None else nearest(texts[item]) if item in texts else None
        if value is not None and (value or x):
            far.append(abs(value - x) / max(abs(x), abs(value)))
    return other, sorted(far, reverse=True)


def points_fault(problem, points, listed, total, all_of_them=True):
    rest = list(points)
    for solution in listed:
        if not rest:
            return f"invented: {flat(problem, solution)}"
        near = min(rest, key=lambda p: distances(problem, p, solution))
        rest.remove(near)
        fault = solution_fault(problem, near, solution, total)
        if fault:
            return fault
    return f"lost: {[shown(problem, p) for p in rest]}" if rest and all_of_them else None


def lists(problem, exact, answer, total):
    solutions, between = gaps(problem, exact.points)
    fault = points_fault(problem, solutions, answer["solutions"], total)
    if fault or between and (fault := points_fault(problem, between, answer["gap_states"], total)):
        return fault
    rest = [Shape(problem, found) for _, found in exact.continua]
    for continuum in answer["continua"]:
        if any("dimension" in p or p["vertex_count"] > len(p["vertices"]) for p in continuum["parts"]):
            return None                      # told without all its ends
        ends, rays = expand(problem, continuum)
        reasons = [shape.fault(ends, rays, continuum["pattern"]) for shape in rest]
        if None not in reasons:
            kind = "pattern" if any(r.startswith("pattern") for r in reasons) else "continuum"
            return f"{kind}: {reasons} {continuum}"
        rest.pop(reasons.index(None))
    return None


def part(problem, exact, answer, option, total):
    """An answer that is not the whole: everything in it must be true, and something in it if there is anything."""
    found = answer["solutions"] or answer["continua"] or answer["gap_states"]
    if answer["status"] == "none" and not exact.empty():
        return "status: none, but there is a solution"
    if option == "nodes":
        pass
    elif not found:
        return f"nothing found: {answer['status']}, exactly {len(exact.points)} points and {len(exact.continua)} sets"
    if exact.continua and problem["type"] in ("mlcp", "mcp") or has_jumps(problem):
        return None        # points of pieces in which no free unknown changes sign
    corners = [p for _, f in exact.continua for p in f.vertices]
    points = list(dict.fromkeys(exact.points + corners))
    return points_fault(problem, points, answer["solutions"], total, False)


def hint(problem, answer):
    """What is wrong with the solution within rounding that is given where there is none (criterion of Oettli and Prager)."""
    given = answer.get("within_rounding")
    if not given or given["answer"] != "solution" or problem["type"] not in ("lcp", "hlcp"):
        return None
    relative = Fraction(given["relative"])
    n = len(problem["q"])
    if None in given["z"] + given["w"]:
        return None                     # beyond the range of numbers
    z, w = ([Fraction(x) for x in given[name]] for name in "zw")
    for i in range(n):
        ones = [[float(i == j) for j in range(n)], problem["M"][i]] if problem["type"] == "lcp" else [problem["A"][i], problem["B"][i]]
        left, right = ([number(x) for x in row] for row in ones)
        off = sum(a * x for a, x in zip(left, w)) - sum(b * x for b, x in zip(right, z)) - number(problem["q"][i])
        room = sum(abs(b * x) for b, x in zip(right, z)) + abs(number(problem["q"][i]))
        room += sum(abs(a * x) for a, x in zip(left, w))        # what is printed is rounded
        if abs(off) > 2 * relative * room:
            return f"hint: equation {i} is off by {float(off):.3g}, allowed {float(relative * room):.3g}"
    pairs = any(x * y for x, y in zip(z, w)) or min(z + w) < 0
    return "hint: it is not complementary" if pairs else None


def expand(problem, continuum):
    """Ends and directions of a product of parts, as vectors of all reported numbers."""
    listed, own = names(problem)
    place = {item: i for i, item in enumerate(listed)}

    def spread(p, table):
        vector = {}
        for name, values in table.items():
            if not isinstance(values, list):
                vector[place[name, None]] = values
                continue
            unknowns = [i for i in p["indices"] if any(listed[j][0] == name for j in own[i])]
            for i, value in zip(unknowns, values):
                vector[next(j for j in own[i] if listed[j][0] == name)] = value
        return vector

    ends = [{}]
    for p in continuum["parts"]:
        ends = [{**a, **spread(p, b)} for a, b in product(ends, p["vertices"])]
    rays = [spread(p, table) for p in continuum["parts"] for table in p["directions"]]
    return ([[v.get(i, "missing") for i in range(len(listed))] for v in ends],
            [[v.get(i, 0.0) for i in range(len(listed))] for v in rays])


class Shape:
    """A maximal set of solutions in reported numbers."""

    def __init__(self, problem, found):
        self.problem, self.found = problem, found
        self.ends = [reported(problem, v) for v in found.vertices]
        self.rays = [reported(problem, v) for v in found.rays]
        self.lines, self.pivots = echelon([reported(problem, v) for v in found.lines]) if found.lines else ([], [])
        self.scale = max((abs(x) for v in self.ends for x in v), default=Fraction(0))

    def reduce(self, vector):
        vector = [Fraction(x) for x in vector]
        for line, pivot in zip(self.lines, self.pivots):
            factor = vector[pivot]
            if factor:
                vector = [x - factor * y for x, y in zip(vector, line)]
        return vector

    def fault(self, ends, rays, pattern):
        if any(x == "missing" for v in ends for x in v):
            return "a number is missing"
        if any(x is None for v in ends + rays for x in v):
            # Of lines and directions, numbers beyond the range are not compared.
            fault = None if self.lines or len(ends) != len(self.ends) else same(self.ends, ends, self.scale)
            return f"ends {fault}" if fault else None
        fault = same([self.reduce(v) for v in self.ends], [self.reduce(v) for v in ends], self.scale)
        if fault:
            return f"ends {fault}"
        size = [max(map(abs, map(Fraction, v))) for v in rays]
        if any(s == 0 for s in size):
            return "a direction is zero"
        comes = [normal(self.reduce([Fraction(x) / s for x in v])) for v, s in zip(rays, size)]
        along = [v for v in comes if v is None]
        if len(along) < len(self.lines) + (1 if self.lines else 0):
            return "lines are missing"
        fault = same([normal(self.reduce(v)) for v in self.rays], [v for v in comes if v is not None], Fraction(1))
        return f"directions {fault}" if fault else self.pattern_fault(pattern)

    def pattern_fault(self, pattern):
        """A sign says that the unknown has it somewhere in the set, and never the other one."""
        generators = self.found.vertices + self.found.rays + self.found.lines
        for k, sign in enumerate(pattern):
            here = [v[k] for v in generators]
            if self.problem["type"] == "mcp" or len(here[0]) == 1 and self.problem["type"] != "mlcp":
                continue
            first, second = any(q[0] for q in here), len(here[0]) > 1 and any(q[1] for q in here)
            if len(here[0]) == 1:
                true = "*" if any(v[k][0] for v in self.found.lines) else None
            else:
                true = "+" if first else "-" if second else "0"
            if true and sign != true:
                return f"pattern {pattern}, exactly {true} at {k}"
        return None


def normal(vector):
    size = max(map(abs, vector))
    return None if size < RELATIVE else [x / size for x in vector]


def same(true, comes, scale):
    def close(exact, x):
        if x is None:
            return abs(exact) > GREATEST or 0 < abs(exact) < LEAST
        return abs(exact - Fraction(x)) <= RELATIVE * abs(exact) + scale / 10 ** 12

    taken = {}              # which of the numbers that come each true one is

    def place(at, seen):
        """Whether there is a true one for these, if those before may move."""
        for i, t in enumerate(true):
            if i not in seen and all(map(close, t, comes[at])):
                seen.add(i)
                if i not in taken or place(taken[i], seen):
                    taken[i] = at
                    return True
        return False

    for at, v in enumerate(comes):
        if not place(at, set()):
            return f"{[x and float_or_text(x) for x in v]} is none of the {len(true)}"
    rest = [t for i, t in enumerate(true) if i not in taken]
    return f"without {[[float_or_text(x) for x in v] for v in rest]}" if rest else None


def uniqueness(problem, exact, answer):
    said = answer.get("every_right_hand_side")
    if problem["type"] in ("game", "block_ave") or has_jumps(problem):
        return None
    if said is None:
        return "uniqueness: no answer"
    one = exact.determinants in ({1}, {-1})
    if (said["answer"] == "one") != one or said["answer"] in ("in_doubt", "not_computed", "jumps"):
        return f"uniqueness: {said}, exactly {'one' if one else 'not one'}, determinants {exact.determinants}"
    return "uniqueness: singular, but no determinant vanishes" if said["answer"] == "singular" and 0 not in exact.determinants else None
