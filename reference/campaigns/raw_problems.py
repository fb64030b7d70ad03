"""Raw problems as slots of `exact`, and the numbers that slideway reports of them."""
from fractions import Fraction

from exact import Alternative, Slot

ZERO, ONE = Fraction(0), Fraction(1)


ROUNDED = False                        # whether the program takes a text such as "2/3" as the nearest floating-point number


def number(entry):
    """The number of a file: floating-point numbers as they are, texts as fractions."""
    return Fraction(float(Fraction(entry))) if ROUNDED and isinstance(entry, str) else Fraction(entry)


def matrix(rows):
    return [[number(x) for x in row] for row in rows]


def column(rows, j, sign=1):
    return [sign * row[j] for row in rows]


def unit(n, k, sign=1):
    return [Fraction(sign if i == k else 0) for i in range(n)]


def pair(first, second):
    """Two variables, neither negative, one of them zero."""
    return Slot((Alternative(first, None, ZERO, None, 0), Alternative(second, None, ZERO, None, 1)), ((None, ZERO), (ZERO, None)))


def free(first):
    return Slot((Alternative(first, None, None, None, 0),), ((None,),))


def lcp(p):
    m, q = matrix(p["M"]), [number(x) for x in p["q"]]
    n = len(q)
    return [pair(column(m, k, -1), unit(n, k)) for k in range(n)], q


def hlcp(p):
    a, b, q = matrix(p["A"]), matrix(p["B"]), [number(x) for x in p["q"]]
    return [pair(column(b, k, -1), column(a, k)) for k in range(len(q))], q


def ave(p):
    a, b, right = matrix(p["A"]), matrix(p["B"]), [number(x) for x in p["b"]]
    n = len(right)
    plus = [[a[i][j] + b[i][j] for j in range(n)] for i in range(n)]
    minus = [[b[i][j] - a[i][j] for j in range(n)] for i in range(n)]
    return [pair(column(plus, k), column(minus, k)) for k in range(n)], right


def mlcp(p):
    a, b, c, d = (matrix(p[name]) for name in "ABCD")
    n, m = len(p["a"]), len(p["b"])
    whole = [a[i] + c[i] for i in range(n)] + [d[i] + b[i] for i in range(m)]
    slots = [free(column(whole, k, -1)) for k in range(n)]
    slots += [pair(column(whole, n + k, -1), unit(n + m, n + k)) for k in range(m)]
    return slots, [number(x) for x in p["a"] + p["b"]]


def mcp(p):
    m, q = matrix(p["M"]), [number(x) for x in p["q"]]
    n, slots = len(q), []
    for k in range(n):
        lo, hi = (None if x is None else number(x) for x in (p["l"][k], p["u"][k]))
        z, w = column(m, k, -1), unit(n, k)

        def at(bound, low, high):
            return Alternative(w, [bound * x for x in z], low, high, 1), (bound, None)

        if lo is not None and lo == hi:
            choices = [at(lo, None, None)]
        else:
            choices = [(Alternative(z, None, lo, hi, 0), (None, ZERO))]
            choices += [at(lo, ZERO, None)] if lo is not None else []
            choices += [at(hi, None, ZERO)] if hi is not None else []
        slots.append(Slot(tuple(c[0] for c in choices), tuple(c[1] for c in choices)))
    return slots, q


def game(p):
    a = matrix(p["A"])
    b = matrix(p["B"]) if "B" in p else [[-x for x in row] for row in a]
    m, n = len(a), len(a[0])
    size = m + n + 2
    # Rows: v1 - (A y)_i - s_i = 0, v2 - (B^T x)_j - t_j = 0, sum x = 1, sum y = 1.
    slots = [pair([ZERO] * m + [-x for x in b[i]] + [ONE, ZERO], unit(size, i, -1)) for i in range(m)]
    slots += [pair(column(a, j, -1) + [ZERO] * n + [ZERO, ONE], unit(size, m + j, -1)) for j in range(n)]
    slots += [free([ONE] * m + [ZERO] * (n + 2)), free([ZERO] * m + [ONE] * n + [ZERO, ZERO])]
    return slots, [ZERO] * (m + n) + [ONE, ONE]


def modes(p):
    plus, minus = matrix(p["columns_positive"]), matrix(p["columns_negative"])
    right = [number(x) for x in p["right_hand_side"]]
    n = len(right)
    zero = [[0] * n] * n
    jump_plus, jump_minus = matrix(p.get("jumps_positive", zero)), matrix(p.get("jumps_negative", zero))
    slots = []
    for k in range(n):
        up, down = column(jump_plus, k), column(jump_minus, k)
        if up == down:
            shift = [-x for x in up] if any(up) else None
            slots.append(Slot((Alternative(column(plus, k), shift, ZERO, None, 0), Alternative(column(minus, k), shift, ZERO, None, 1)),
                              ((None, ZERO, ONE), (ZERO, None, ONE))))
            continue
        between = [y - x for x, y in zip(up, down)]
        slots.append(Slot((Alternative(column(plus, k), [-x for x in up], ZERO, None, 0),
                           Alternative(column(minus, k), [-x for x in down], ZERO, None, 1),
                           Alternative(between, [-x for x in down], ZERO, ONE, 2)),
                          ((None, ZERO, ONE), (ZERO, None, ZERO), (ZERO, ZERO, None))))
    return slots, right


FORMS = {"lcp": lcp, "hlcp": hlcp, "ave": ave, "mlcp": mlcp, "mcp": mcp, "game": game, "modes": modes}


def orientation(slots):
    """Signs of the alternatives: of P-matrices and their kin, all determinants times these have one sign."""
    return [(1, -1, -1)[:len(s.alternatives)] for s in slots]


def has_jumps(problem):
    return problem["type"] == "modes" and problem.get("jumps_positive") != problem.get("jumps_negative")


def names(problem):
    """The reported numbers in order, [(name, index)], and for every unknown the positions of its own numbers among them."""
    kind = problem["type"]
    if kind == "mlcp":
        n, m = len(problem["a"]), len(problem["b"])
        listed = [("u", k) for k in range(n)] + [(name, k) for k in range(m) for name in "zw"]
        return listed, [[k] for k in range(n)] + [[n + 2 * k, n + 2 * k + 1] for k in range(m)]
    if kind == "game":
        m, n = len(problem["A"]), len(problem["A"][0])
        listed = [("x", k) for k in range(m)] + [("y", k) for k in range(n)] + [("payoff_1", None), ("payoff_2", None)]
        return listed, [[k] for k in range(m + n)]
    both = {"ave": "x", "block_ave": "x", "modes": ("normal_forces", "y")}.get(kind, "zw")
    right = problem.get("q") or problem.get("b") or problem.get("right_hand_side")
    listed = [(name, k) for k in range(len(right)) for name in both]
    return listed, [list(range(k * len(both), (k + 1) * len(both))) for k in range(len(right))]


def reported(problem, lifted):
    """The reported numbers of a lifted vector, in the order of `names`."""
    kind = problem["type"]
    if kind == "ave":
        return [p - m for p, m in lifted]
    if kind == "modes":
        return [x for slot in lifted for x in (slot[0] - slot[1], slot[0] + slot[1])]
    if kind == "game":
        return [slot[0] for slot in lifted]
    return [x for slot in lifted for x in slot]


def signs(problem, lifted):
    """The sign of every unknown, None where it may be either of two."""
    found = []
    for k, slot in enumerate(lifted):
        if problem["type"] == "mcp":
            z, lo, hi = slot[0], problem["l"][k], problem["u"][k]
            low, high = lo is not None and z == number(lo), hi is not None and z == number(hi)
            found.append(None if low and high else -1 if low else 1 if high else 0)
        elif len(slot) == 1:
            found.append((slot[0] > 0) - (slot[0] < 0))
        else:
            found.append(1 if slot[0] > 0 else -1 if slot[1] > 0 else 0)
    return found[:-2] if problem["type"] == "game" else found
