"""Writes rest.json, square.json, drawer.json and limit.json: motions in closed form, no integration.

    python closed_forms.py

g = 9.81 m/s^2. All blocks have no height, so that friction has no couple: with a load P at the height p above a guide of length L,
N_front = m g/2 + P p/L and N_rear = m g/2 - P p/L, and |N_front| + |N_rear| = max(m g, 2 |P| p/L).
"""

import json
import math
import random
from pathlib import Path

HERE = Path(__file__).parent
G = 9.81


def rounded(value):
    return float(f"{value:.4g}")


def word(s, front, rear):
    return "<>"[s > 0] + "".join("-+"[side > 0] for side in (front, rear))


def rest(random):
    """Five blocks: v decays with mu g - P v/(|v| m) until it stops, and |P| < mu m g keeps it; or it rests under mu m g < P < mu_s m g."""
    until, parameters, joints, last = 4.0, {}, [], []
    for b in "abcde":
        m, mu = rounded(random.uniform(0.5, 3)), rounded(random.uniform(0.1, 0.4))
        mus = rounded(mu * random.uniform(1.2, 2))
        v = rounded(random.choice([0, 1, 1, 1]) * random.uniform(0.2, 2) * random.choice([-1, 1]))
        load = random.uniform(-0.7, 0.7) * mu if v else random.uniform(mu, mus) * random.choice([-0.98, 0.98])
        load = rounded(load * m * G)
        parameters |= {f"m{b}": m, f"mu{b}": mu, f"mus{b}": mus, f"P{b}": load, f"v{b}": v}
        if v == 0:
            joints.append([[0.0, "="]])
            last.append([0.0, 0.0])
            continue
        s = math.copysign(1, v)
        deceleration = mu * G - s * load / m
        stop = abs(v) / deceleration
        joints.append([[0.0, word(s, 1, 1)]] + ([[stop, "="]] if stop < until else []))
        t = min(stop, until)
        last.append([v * t - s * deceleration * t * t / 2, v - s * deceleration * t])
    return {"until": until, "parameters": parameters, "joints": joints, "last": last}


def square(random):
    """Constant accelerations a = (P - s mu K)/m, K = max(m g, 2 |P| p/L), between jumps of P and stops; it sticks if |P| <= mu_s K."""
    m, length, mu, z = random.uniform(0.5, 3), random.uniform(0.1, 0.4), random.uniform(0.1, 0.4), random.uniform(2, 9)
    limit = mu * m * G
    p = {"m": m, "L": length, "p": random.uniform(0, 1.2) * length, "mu": mu, "mus": mu * random.uniform(1, 1.8)}
    p |= {"P0": random.uniform(-0.6, 0.6) * limit, "P1": random.uniform(0.5, 3) * limit, "z": z, "v": random.choice([0, 0.5])}
    p = {name: rounded(value) for name, value in p.items()}
    until = round(16.3 * math.pi / p["z"], 3)
    t, x, v, s, entries, piece = 0.0, 0.0, p["v"], None, [], 0
    while t < until:
        load = p["P0"] + (p["P1"] if piece % 2 == 0 else -p["P1"])
        tip = load * p["p"] / p["L"]
        weight = p["m"] * G
        pressed = max(weight, 2 * abs(tip))
        if v == 0:
            s = 0 if abs(load) <= p["mus"] * pressed else math.copysign(1, load)
        else:
            s = math.copysign(1, v)
        state = word(s, weight / 2 + tip, weight / 2 - tip) if s else "="
        if not entries or entries[-1][1] != state:
            entries.append([t, state])
        a = (load - s * p["mu"] * pressed) / p["m"] if s else 0.0
        end = min(until, (piece + 1) * math.pi / p["z"])
        stop = t - v / a if s and v * a < 0 else math.inf
        if stop < end:
            x, v, t = x - v * v / (2 * a), 0.0, stop
        else:
            x, v, t, piece = x + v * (end - t) + a * (end - t) ** 2 / 2, v + a * (end - t), end, piece + 1
    return {"until": until, "parameters": p, "joints": [entries], "last": [[x, v]]}


def drawer(random):
    """N_front = -N_rear = P e/L, so it holds while P (1 - 2 mu_s e/L) <= 2 F0; then m a = P (1 - 2 mu e/L) - 2 F0.

    Or a force D t^2 along and C t across: it holds until t = mu_s C/D; then m a = D t^2 - mu C t.
    """
    mu, length = random.uniform(0.1, 0.4), random.uniform(0.2, 0.5)
    p = {"m": random.uniform(0.5, 3), "L": length, "e": 0.0, "mu": mu, "mus": mu * random.uniform(1, 1.6), "F0": 0.0}
    p |= {"R": 0.0, "A": 0.0, "B": 0.0, "D": 0.0, "C": 0.0, "w": random.uniform(2, 8)}
    kind = random.choice("RABD")
    p[kind] = random.uniform(2, 20)
    if kind == "D":
        p["C"] = random.uniform(2, 20)
    else:
        p["e"] = random.choice([-1, 1]) * random.uniform(0.05, 0.9) * length
        p["F0"] = random.choice([0, random.uniform(0.02, 0.2) * p[kind]])
    p = {name: rounded(value) for name, value in p.items()}
    m, mu, mus, w, f0 = (p[name] for name in ("m", "mu", "mus", "w", "F0"))
    if kind == "D":
        slips = mus * p["C"] / p["D"]
        until = round(1.5 * slips, 3)
        speed = lambda t: (p["D"] * t**3 / 3 - mu * p["C"] * t**2 / 2) / m
        place = lambda t: (p["D"] * t**4 / 12 - mu * p["C"] * t**3 / 6) / m
        sides = (1, 1)
    else:
        size, leverage = p[kind], abs(p["e"]) / p["L"]
        held, part = 1 - 2 * mus * leverage, 1 - 2 * mu * leverage
        needed = 2 * f0 / held / size if held > 0 else math.inf
        if kind == "R":
            slips, until = needed, 1.5
            load, impulse, moment = lambda t: t, lambda t: t * t / 2, lambda t: t**3 / 6
        elif kind == "A":
            slips, until = math.acos(1 - needed) / w if needed < 2 else math.inf, round(math.pi / w, 3)
            load, impulse = lambda t: 1 - math.cos(w * t), lambda t: t - math.sin(w * t) / w
            moment = lambda t: t * t / 2 + math.cos(w * t) / w**2
        else:
            slips, until = math.asin(needed) / w if needed < 1 else math.inf, round(math.pi / 2 / w, 3)
            load, impulse = lambda t: math.sin(w * t), lambda t: -math.cos(w * t) / w
            moment = lambda t: -math.sin(w * t) / w**2
        speed = lambda t: (part * size * impulse(t) - 2 * f0 * t) / m
        place = lambda t: (part * size * moment(t) - f0 * t * t) / m
        sides = (p["e"], -p["e"])
    if slips >= until:
        entries, last = [[0.0, "="]], [0.0, 0.0]
    else:
        entries = ([[0.0, "="]] if slips > 0 else []) + [[slips, word(1, *sides)]]
        start = speed(slips)
        last = [place(until) - place(slips) - start * (until - slips), speed(until) - start]
    return {"until": until, "parameters": p, "joints": [entries], "last": [last]}


def limit(random):
    """m g (sin q + mu cos q sin w t) along the guide: friction mu m g cos q just holds it, at all times."""
    p = {"m": random.uniform(0.1, 50), "mu": random.uniform(0.05, 0.9), "w": random.uniform(0.5, 20)}
    if random.random() < 0.5:
        p |= {"q": random.uniform(-0.6, 0.6), "h": random.uniform(0, 0.2)}
    p = {name: rounded(value) for name, value in p.items()}
    return {"until": 5.0, "parameters": p, "joints": [[[0.0, "="]]], "last": [[0.0, 0.0]]}


FAMILIES = [(rest, 40, [f"x{b}" for b in "abcde"]), (square, 30, ["x"]), (drawer, 60, ["x"]), (limit, 100, ["x"])]


def shortened(motion):
    motion["joints"] = [[[round(t, 12), state] for t, state in entries] for entries in motion["joints"]]
    motion["last"] = [[round(x, 12), round(v, 12)] for x, v in motion["last"]]
    return motion


if __name__ == "__main__":
    for family, count, coordinates in FAMILIES:
        name = family.__name__
        motions = [{"seed": i} | shortened(family(random.Random(f"{name} {i}"))) for i in range(count)]
        lines = ",\n".join(json.dumps(motion, separators=(",", ":")) for motion in motions)
        text = f'{{"model":"{name}","coordinates":{json.dumps(coordinates)},"motions":[\n{lines}\n]}}\n'
        (HERE / f"{name}.json").write_text(text)
