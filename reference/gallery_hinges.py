#!/usr/bin/env python3
"""Reference numbers for the gallery models with friction in pins, by free-body balances written out by hand.

    python3 reference/gallery_hinges.py        # writes reference/gallery-hinges.toml; standard library only

Every mechanism here is massless and driven, so that statics of each body gives its forces. A link with two pins carries
a force that is tangent to the friction circles at its ends. What is left is one equation for one unknown: a quadratic one
for the bell crank, linear ones for the treadle, and where a pivot carries the sum of two forces, as in the quick-return mechanism
and in the clamp, one that a bisection or an iteration solves. No mode problem, no influence coefficients, no search.

Signs: angles counter-clockwise, a couple on a body counter-clockwise. Friction of a hinge on its first body is
-r |R| sgn(omega_first - omega_second) with r = rho mu / sqrt(1 + mu^2).
"""
import math
from pathlib import Path

HERE = Path(__file__).resolve().parent


def circle(rho, mu):
    """The radius of the friction circle of a loose pin."""
    return rho * mu / math.sqrt(1 + mu * mu)


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def turned(v, angle):
    c, s = math.cos(angle), math.sin(angle)
    return (c * v[0] - s * v[1], s * v[0] + c * v[1])


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1])


def sign(x):
    return (x > 0) - (x < 0)


def bell_crank(sense, pin=0.025, mu=0.2, a=0.08, b=0.05, load=1000.0):
    """Push P of a P = b Q + sense r sqrt(P^2 + Q^2): raising the load (sense 1) or letting it back (-1)."""
    r = circle(pin, mu)
    return load * (a * b + sense * r * math.sqrt(a * a + b * b - r * r)) / (a * a - r * r)


def link_force(ends, spins, radii):
    """Unit force that a massless link carries, as tension: for both signs of it, its direction from the first end to the
    second. spins are those of the link against what each end is pinned to."""
    along = minus(ends[1], ends[0])
    length = math.hypot(*along)
    unit = (along[0] / length, along[1] / length)
    # force F on the second end, -F on the first: l |F| sin(theta) + M_A + M_B = 0, M = -r |F| sgn(spin)
    theta = math.asin(sum(r * sign(w) for r, w in zip(radii, spins)) / length)
    return {1: turned(unit, theta), -1: turned(unit, math.pi - theta)}


def treadle(phi, sense=1):
    """Efforts on the pedal for the resistance T of the crank: a list, empty where it locks."""
    a, l, b, pivot, mu, moment = 0.04, 0.18, 0.1, (0.15, -0.12), 0.15, 2.0
    shaft, pin = circle(0.012, mu), circle(0.008, mu)
    at = lambda angle: closed(angle, a, l, b, pivot)
    crank_pin, pedal_pin = at(phi)
    # spins by differences of positions, as only their signs matter
    step = 1e-6
    before, after = at(phi - step), at(phi + step)
    angle = lambda places: math.atan2(*reversed(minus(places[1], places[0])))
    swing = lambda places: math.atan2(*reversed(minus(places[1], pivot)))
    coupler = sense * (angle(after) - angle(before)) / (2 * step)
    pedal = sense * (swing(after) - swing(before)) / (2 * step)
    crank = float(sense)
    spins = (coupler - crank, coupler - pedal)
    found = []
    for force in link_force((crank_pin, pedal_pin), spins, (pin, pin)).values():
        # on the crank at A: +|F| force and the couple r_A |F| sgn(coupler - crank); at O -r_O |F| sgn(crank)
        lever = cross(crank_pin, force) + pin * sign(spins[0]) - shaft * sign(crank)
        size = moment / lever
        if size <= 0:
            continue
        # on the pedal at B: -|F| force and the couple r_B |F| sgn(coupler - pedal); at C -r_C |F| sgn(pedal)
        back = cross(minus(pedal_pin, pivot), (-force[0], -force[1]))
        found.append(-size * (back + pin * sign(spins[1]) - pin * sign(pedal)))
    return found


def closed(phi, a, l, b, pivot):
    """Crank pin and pedal pin of the treadle."""
    first = (a * math.cos(phi), a * math.sin(phi))
    e = minus(pivot, first)
    d = math.hypot(*e)
    t = (d * d + l * l - b * b) / (2 * d)
    s = math.sqrt(l * l - t * t)
    return first, (first[0] + (t * e[0] - s * e[1]) / d, first[1] + (t * e[1] + s * e[0]) / d)


def locked_treadle(sense=1, steps=3600):
    """The ranges of the crank angle (deg, from 0 to 360) in which nothing turns the crank."""
    edges = []
    is_locked = lambda degrees: not treadle(math.radians(degrees), sense)
    for step in range(steps):
        low, high = 360.0 * step / steps, 360.0 * (step + 1) / steps
        was = is_locked(low)
        if was == is_locked(high):
            continue
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if is_locked(middle) == was else (low, middle)
        edges.append(0.5 * (low + high))
    return edges


def quick_return(phi, sense=1):
    """Torque on the crank against the cutting force; the angle of the crank from x."""
    r, d, l, mu_pin, mu, cut = 0.05, 0.12, 0.26, 0.12, 0.1, 600.0
    shaft, pin, pivot = (circle(rho, mu_pin) for rho in (0.015, 0.010, 0.015))
    place = (r * math.cos(phi), d + r * math.sin(phi))
    s = math.hypot(*place)
    along = (place[0] / s, place[1] / s)
    normal = (-along[1], along[0])
    velocity = (-r * math.sin(phi) * sense, r * math.cos(phi) * sense)
    arm = (place[0] * velocity[1] - place[1] * velocity[0]) / (s * s)
    slip = velocity[0] * along[0] + velocity[1] * along[1]  # of the die against the arm, which turns about C
    crank = float(sense)

    def on_arm(push):
        """What the die puts on the arm for the normal force `push` on the die along n."""
        rub = mu * abs(push) * sign(slip)
        return (-push * normal[0] + rub * along[0], -push * normal[1] + rub * along[1])

    def unbalanced(push):
        """Moment on the arm about its pivot. The die is balanced: its pin's couple goes on to the arm."""
        force = on_arm(push)
        tool = (cut, 0.0)
        carried = math.hypot(force[0] + tool[0], force[1] + tool[1])
        end = (l * along[0], l * along[1])
        couple = -pin * math.hypot(*force) * sign(arm - crank)
        return cross(place, force) + couple + cross(end, tool) - pivot * carried * sign(arm)

    low, high = -1e6, 1e6
    at_low = unbalanced(low)
    assert at_low * unbalanced(high) < 0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if unbalanced(middle) * at_low > 0 else (low, middle)
    push = 0.5 * (low + high)
    # what the crank puts on the die is what the die puts on the arm
    force = on_arm(push)
    size = math.hypot(*force)
    # both contacts of the die stay pressed on one side: its couple is less than half its length times its force
    assert pin * size < 0.5 * 0.04 * abs(push)
    # on the crank at A: -force, and the couple of the die's pin against it
    lever = (r * math.cos(phi), r * math.sin(phi))
    moment = cross(lever, (-force[0], -force[1])) + pin * size * sign(arm - crank) - shaft * size * sign(crank)
    return -moment


def clamp(phi, sense, mu=0.1):
    """Force of the hand (along x at the handle's end); the handle turns with `sense` at the angle phi."""
    a, l, handle, plunger, mu_pin, load = 0.04, 0.09, 0.15, 0.05, 0.15, 2000.0
    r = circle(0.008, mu_pin)
    place = (a * math.cos(phi), a * math.sin(phi))
    end = (place[0] + math.sqrt(l * l - place[1] ** 2), 0.0)
    lean = -math.asin(place[1] / l)
    link = -sense * a * math.cos(phi) / (l * math.cos(lean))
    spins = (link - sense, link)
    # compression: the force on the plunger points away from the handle
    force = link_force((place, end), spins, (r, r))[-1]
    force = (-force[0], -force[1])
    # the plunger moves along +x when the handle closes (sense < 0); friction mu (|N_1| + |N_2|) of both ends of its guide,
    # whose difference carries the couple of its pin: N_1 + N_2 = force across, (N_1 - N_2) L/2 = r |F|
    rub = mu * max(abs(force[1]), 2 * r / plunger) * -sense
    size = load / (force[0] - rub)
    # on the handle at A: -|F| force and the couple of the link's pin; at H the hand, (P, 0); at O -r |R| sgn(sense), where R
    # carries both. H x (P, 0) = -H_y P
    push = (-size * force[0], -size * force[1])
    moment = cross(place, push) + size * r * sign(spins[0])
    hand = 0.0
    for _ in range(200):
        hand = (moment - r * math.hypot(push[0] + hand, push[1]) * sense) / (handle * math.cos(phi))
    return hand


def holding_angle():
    """Up to which angle the clamp holds by itself: psi of the theory of hinges, section 6."""
    a, l = 0.04, 0.09
    r = circle(0.008, 0.15)
    psi = math.asin(2 * r / l) + math.asin(2 * r / a)
    return math.degrees(math.atan2(l * math.sin(psi), a + l * math.cos(psi)))


def main():
    lines = [
        "# Reference numbers for the gallery models with friction in pins, from free-body balances written out by hand. Made by",
        "# reference/gallery_hinges.py; do not edit by hand. SI units, angles in degrees. sense: of the coordinate's rate.",
    ]
    case = lambda name, **values: lines.extend(
        ["", f"[[{name}]]"] + [f"{key} = {value!r}" for key, value in values.items()]
    )
    for pin in (0.025, 0.1, 0.2):
        for sense in (1, -1):
            case("bell_crank", pin=pin, sense=sense, effort=bell_crank(sense, pin))
    for degrees in (30, 60, 100, 150, 250, 300):
        case("four_bar", phi=degrees, efforts=treadle(math.radians(degrees)))
    case("four_bar_locked", edges=locked_treadle())
    for degrees in (20, 45, 80, 110, 150, 165):
        for sense in (1, -1):
            case("quick_return", phi=degrees, sense=sense, effort=quick_return(math.radians(degrees), sense))
    for degrees in (2, 5, 10, 30):
        for sense in (-1, 1):
            case("clamp", phi=degrees, sense=sense, effort=clamp(math.radians(degrees), sense))
    case("clamp_holds", phi=holding_angle())
    (HERE / "gallery-hinges.toml").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
