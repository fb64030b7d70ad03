#!/usr/bin/env python3
"""All solutions of block problems with two hinges, by resultants: writes block-problems.toml.

    python3 -m venv venv && venv/bin/pip install sympy
    venv/bin/python reference/block_problems.py > reference/block-problems.toml

Problems x = b + H w, w_j = |x_j|, of s contacts (blocks of one) and two hinges (blocks of two), with rational data. For each
pattern of sides the normal forces w_1..w_s = sigma x follow from linear equations as functions of the lengths u, v of
both reactions. What is left are two quadrics |x_3|^2 = u^2, |x_4|^2 = v^2 in u and v. Their resultant in u is a polynomial in v
with rational coefficients; its real roots are isolated exactly and refined to 30 digits. The u that belongs to v is the common
root. Solutions have u, v >= 0 and w >= 0 on their sides. Written without slideway.
"""

import itertools
import random

import sympy as sp

DIGITS = 30
u, v = sp.symbols("u v")


def planted():
    rows = [["-3/2", "1/10", "1/20"], ["1/20", "6/5", "-1/20"], ["0", "3/10", "1/10"],
            ["-1/20", "1/20", "5/4"], ["1/10", "0", "7/20"]]
    b = ["1", "-1", "1/5", "-11/10", "1/4"]
    return [sp.Rational(x) for x in b], sp.Matrix([[sp.Rational(x) for x in row] for row in rows])


def drawn(generator, s):
    """Random coefficients in hundredths; each block opposes its load, so that there are many solutions."""
    number = lambda size: sp.Rational(generator.randint(-size, size), 100)
    rows = s + 4
    b = [number(100) for _ in range(rows)]
    H = sp.Matrix(rows, s + 2, lambda i, j: number(15))
    for j in range(s + 2):
        own = [j] if j < s else [2 * j - s, 2 * j - s + 1]
        size = sp.Rational(generator.randint(105, 170), 100)
        length = sp.sqrt(sum(b[i] ** 2 for i in own))
        for i in own:
            H[i, j] -= sp.Rational(round(100 * float(size * b[i] / length)), 100)
    return b, H


def residual(b, H, s, x):
    w = [abs(x[k]) for k in range(s)] + [sp.sqrt(x[s] ** 2 + x[s + 1] ** 2), sp.sqrt(x[s + 2] ** 2 + x[s + 3] ** 2)]
    return max(abs(x[i] - b[i] - sum(H[i, j] * w[j] for j in range(s + 2))) for i in range(s + 4))


def jacobian(H, s, x, w):
    J = sp.eye(s + 4)
    for j in range(s + 2):
        for i in [j] if j < s else [2 * j - s, 2 * j - s + 1]:
            for row in range(s + 4):
                J[row, i] -= H[row, j] * x[i] / w[j]
    return J


def solve(b, H, s):
    found = []
    for sides in itertools.product([1, -1], repeat=s):
        contact = sp.Matrix(s, s, lambda i, j: (sides[i] if i == j else 0) - H[i, j])
        right = sp.Matrix(s, 1, lambda i, _: b[i] + H[i, s] * u + H[i, s + 1] * v)
        normal = list(contact.LUsolve(right)) if s else []
        lengths = [sp.expand(w) for w in normal] + [u, v]
        x = [sp.expand(b[i] + sum(H[i, j] * lengths[j] for j in range(s + 2))) for i in range(s + 4)]
        first = sp.Poly(sp.expand(x[s] ** 2 + x[s + 1] ** 2 - u ** 2), u, v)
        second = sp.Poly(sp.expand(x[s + 2] ** 2 + x[s + 3] ** 2 - v ** 2), u, v)
        eliminated = sp.Poly(sp.resultant(first.as_expr(), second.as_expr(), u), v)
        for root in sp.real_roots(eliminated):
            length = sp.N(root, 3 * DIGITS)
            if length < 0:
                continue
            candidates = sp.Poly(first.as_expr().subs(v, length), u).nroots(n=2 * DIGITS, maxsteps=500)
            for other in candidates:
                if abs(sp.im(other)) > 1e-20 or sp.re(other) < 0:
                    continue
                at = {u: sp.re(other), v: length}
                if abs(second.as_expr().subs(at)) > sp.Float(10) ** -DIGITS:
                    continue
                w = [sp.N(part.subs(at), DIGITS) for part in lengths]
                if any(part < 0 for part in w[:s]):
                    continue
                values = [sp.N(part.subs(at), DIGITS) for part in x]
                assert residual(b, H, s, values) < 1e-20
                found.append((w, sp.N(jacobian(H, s, values, w).det(), DIGITS)))
    return found


def write(name, s, b, H):
    print(f'\n[[problem]]\nname = "{name}"\ns = {s}')
    print(f"b = {[float(part) for part in b]}")
    print(f"H = {[[float(part) for part in H.row(i)] for i in range(H.rows)]}")
    print("solutions = [ # w, det(I - H D)")
    for w, det in solve(b, H, s):
        numbers = ", ".join(str(sp.N(part, 17)) for part in w)
        print(f"  {{ w = [{numbers}], det = {sp.N(det, 10)} }},")
    print("]")


def main():
    print("# Block problems x = b + H w, w_j = |x_j|: s contacts (blocks of one), then two hinges (blocks of two).")
    print("# Written by block_problems.py. The data are decimal fractions; programs round them.")
    write("planted_8", 1, *planted())
    generator = random.Random(1)
    for s, count in [(0, 4), (1, 3), (2, 3)]:
        for at in range(count):
            write(f"drawn_{s}_{at + 1}", s, *drawn(generator, s))


main()
