#!/usr/bin/env python3
"""Tries the closed-form claims of README.md by brute force. Standard library only: python3 reference/check_claims.py

Every pattern of signs of the normal forces is solved as a linear system written for that mechanism alone.
"""
import itertools
import math


def solve(a, b):
    n = len(b)
    m = [row[:] + [x] for row, x in zip(a, b)]
    for i in range(n):
        k = max(range(i, n), key=lambda r: abs(m[r][i]))
        if abs(m[k][i]) < 1e-13:
            return None
        m[i], m[k] = m[k], m[i]
        for r in range(n):
            if r != i:
                f = m[r][i] / m[i][i]
                m[r] = [x - f * y for x, y in zip(m[r], m[i])]
    return [m[i][n] / m[i][i] for i in range(n)]


def drawer(mu, L=0.4, a=0.3, h=0.0, Q=20.0):
    """All solutions (push, front, rear); moving along +x."""
    found = []
    for sf, sr in itertools.product((1, -1), repeat=2):
        # unknown: V, Nf, Nr. Friction mu s N along -x at y = -s h/2: moment about the middle  -(-s h/2)(-mu s N) = -mu h N/2.
        rows = [[1, -mu * sf, -mu * sr], [0, 1, 1], [-a, L / 2 - mu * h / 2, -L / 2 - mu * h / 2]]
        x = solve(rows, [Q, 0, 0])
        if x and x[1] * sf >= -1e-12 and x[2] * sr >= -1e-12:
            found.append(x)
    return found


def cam(mu, phi=math.radians(30), A=0.05, B=0.08, d=0.012, Q=200.0):
    """All solutions (V, Nf, Nr), moving upwards; N along +x on the stem, pressed face at x = -sign(N) d/2."""
    found = []
    for sf, sr in itertools.product((1, -1), repeat=2):
        # Friction (0, -mu s N) at x = -s d/2: moment x fy = mu N d/2. Force (N, 0) at height y: moment -y N.
        rows = [
            [math.sin(phi), 1, 1],
            [math.cos(phi), -mu * sf, -mu * sr],
            [0, -(A + B) + mu * d / 2, -A + mu * d / 2],
        ]
        x = solve(rows, [0, Q, 0])
        if x and x[1] * sf >= -1e-12 and x[2] * sr >= -1e-12:
            found.append(x)
    return found


def bracket_holds(x, mu, B=0.1524, d=0.03):
    """W = 1. Frictions 1/2 + e (bottom) and 1/2 - e (top), both ways of tipping, |friction| <= mu N: an interval of e."""
    for way in (1, -1):
        # Bottom contact at x = way d/2, top at -way d/2; about the centre: way N B + way d e = x.
        lo, hi = -math.inf, math.inf
        n0, n1 = way * x / B, -d / B
        for c0, c1 in ((0.5, 1), (-0.5, -1), (0.5, -1), (-0.5, 1), (0, 0)):      # mu N - (c0 + c1 e) >= 0
            k0, k1 = mu * n0 - c0, mu * n1 - c1
            if abs(k1) < 1e-15:
                if k0 < 0:
                    lo, hi = 1, 0
            elif k1 > 0:
                lo = max(lo, -k0 / k1)
            else:
                hi = min(hi, -k0 / k1)
        if lo <= hi:
            return True
    return False


def painleve(mu, s, P1, P2, phi=math.radians(30), m1=1.0, m2=1.0, mu_lower=0.0):
    """All solutions (a, N, R): N on the upper slider, R the thrust of the rod on it."""
    found = []
    for sg in (1, -1):
        c, n = math.cos(phi), math.sin(phi)
        # m1 a - R c + mu s |N| = P1,  N + R n = 0,  m2 a + R c + mu_lower s |R n| = P2 with |R n| = |N|
        x = solve([[m1, mu * s * sg, -c], [0, 1, n], [m2, mu_lower * s * sg, c]], [P1, 0, P2])
        if x and x[1] * sg >= 0:
            found.append(x)
    return found


def main():
    for h in (0.0, 0.5):
        for a in (0.3, 0.25, 0.7):
            limit = 0.4 / (2 * a)
            for f in (0.2, 0.9, 0.999999, 1.000001, 1.5, 4):
                found = drawer(f * limit, a=a, h=h)
                assert len(found) == (f < 1), (h, a, f, found)
                if found:
                    assert abs(found[0][0] * (1 - 2 * a * f * limit / 0.4) / 20 - 1) < 1e-9
    print("drawer: one solution below mu = L/(2a), none above, whatever h")

    for phi, d, A, B in ((30, 0.012, 0.05, 0.08), (30, 0.0, 0.05, 0.08), (50, 0.02, 0.03, 0.1), (12, 0.01, 0.2, 0.05)):
        t, k = math.tan(math.radians(phi)), 2 * A + B
        # mu t (k - mu d) = B, the smaller root
        limit = 2 * B / (t * k + math.sqrt((t * k) ** 2 - 4 * t * d * B)) if d else B / (t * k)
        for f in (0.2, 0.9, 0.999999, 1.000001, 1.1):
            assert len(cam(f * limit, math.radians(phi), A, B, d)) == (f < 1), (phi, d, f)
        print(f"cam follower phi={phi} d={d}: jams at mu = {limit:.8f}")

    for mu in (0.1, 0.25, 0.6):
        limit = 0.1524 / (2 * mu)
        assert not bracket_holds(limit * 0.999999, mu) and bracket_holds(limit * 1.000001, mu)
    assert all(bracket_holds(x / 100, 0.6, B=0.1, d=0.2) for x in range(-30, 31))
    assert not bracket_holds(0.05, 0.6, B=0.1, d=0.16)
    print("bracket: holds from x = B/(2 mu_static) on; at any x if mu_static d > B")

    for phi, m1, m2, ml in ((30, 1, 1, 0), (60, 1, 1, 0), (40, 2, 0.7, 0), (40, 2, 0.7, 0.2)):
        phi = math.radians(phi)
        limit = ((m1 + m2) / math.tan(phi) + m1 * ml) / m2
        for s in (1, -1):
            for P1, P2 in ((0, 10), (10, 0)):
                K = m2 * P1 - m1 * P2
                for f in (0.3, 0.999999, 1.000001, 3):
                    expected = 1 if f < 1 else (2 if K * s > 0 else 0)
                    got = len(painleve(f * limit, s, P1, P2, phi, m1, m2, ml))
                    assert got == expected, (phi, s, P1, P2, f, got)
        print(f"Painleve-Klein phi={math.degrees(phi):.0f}: limit mu = {limit:.8f}")
    for s in (1, -1):
        print(f"  as in the file, mu = 4, direction {s:+d}:", [f"a={x[0]:.8f} N={x[1]:.8f}" for x in painleve(4, s, 0, 10)])


if __name__ == "__main__":
    main()
