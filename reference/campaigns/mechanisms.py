#!/usr/bin/env python3
"""Random mechanisms: all questions give the same answer at the same point, and that of equations written for each body by themselves.

    python3 reference/campaigns/mechanisms.py --seed 1 --count 10000 --failures /tmp/failures

A point is a mechanism with one value of a factor on its friction or on its loads; four points share a sweep, a map and limits. Every third
mechanism is a model of the gallery with changed parameters, for which the questions are compared with each other. Standard library only.
"""
import json
import random
from collections import Counter
from functools import partial
from pathlib import Path

import gallery_points
import mechanism_make
import newton_euler
import questions
import rest_oracle
from common import Failures, arguments, conclude, scratch

POINTS = 4


def subject(seed, index):
    """(model text, name of what is varied, range, options of the command line, mechanism or None)"""
    rng = random.Random(f"point {seed}/{index}")
    if index % 3 == 2:
        return gallery_points.subject(rng)
    m = mechanism_make.mechanism(seed, index)
    name, interval = ("f", (0.0, rng.choice([0.5, 1.0, 2.0, 3.0]))) if rng.random() < 0.7 else ("P", (-2.0, rng.choice([1.0, 3.0])))
    return mechanism_make.toml(m), name, interval, [], m


def work(options, batch):
    total, failures = Counter(), Failures(options.failures)
    with scratch() as folder:
        for index in range(batch[0], batch[0] + batch[1]):
            text, name, (low, high), settings, mechanism = subject(options.seed, index)
            file = Path(folder) / "model.toml"
            file.write_text(text)
            values = [low + (i + 0.5) * (high - low) / POINTS for i in range(POINTS)]
            rests = partial(rest_oracle.holds, mechanism) if mechanism and rest_oracle.reaches(mechanism) else None
            asked = questions.Asked(file, name, (low, high), values, settings, random.Random(index), rests)
            faults = asked.all(total)
            if mechanism is not None:
                faults += against_equations(mechanism, values, asked, total)
            for kind, command, comes, true in faults:
                total["failures"] += 1
                total[f"failure: {kind}"] += 1
                shown = " ".join(["slideway", *map(str, command)]).replace(str(file), "FILE")
                case = f"mechanism-{options.seed}-{index}-{kind.replace(': ', '-').replace(' ', '-')}"
                failures.write(case, {".toml": text}, shown, comes, true)
            total["mechanisms"] += 1
    return total


def against_equations(m, values, asked, total):
    """`solve` against newton_euler."""
    faults = []
    if sum(j.pin is not None for j in m.joints) > 1:
        return faults
    for value, answer in zip(values, asked.solved):
        if answer is None:
            continue
        f, load = (value, 1.0) if asked.name == "f" else (1.0, value)
        found, between, rejected, doubtful = newton_euler.solutions(m, f, load)
        if doubtful:
            total["doubtful"] += 1
            continue
        total["determinate"] += 1
        true = {"count": len(found), "gap_state_count": len(between), "rejected": len(rejected)}
        comes = {"count": int(answer["count"]), "gap_state_count": int(answer["gap_state_count"]), "rejected": len(answer["rejected"])}
        command = asked.command("solve", value)
        if comes != true:
            faults.append(("equations: counts", command, comes, f"{true} {[s['pattern'] for s in found + between]}"))
            continue
        for solution in found + between:
            listed = answer["solutions"] + answer["preload_gap_states"]
            if not any(same(m, solution, other) for other in listed):
                faults.append(("equations: forces", command, json.dumps(listed), solution))
                break
    return faults


def same(m, solution, listed):
    forces = [c["normal_force"] for c in listed["contacts"]]
    efforts = [d["effort"] for d in listed["drives"]]
    accelerations = {b["name"]: [*b["acceleration"], b["angular_acceleration"]] for b in listed["bodies"]}
    rest = [] if solution["effort"] is None else [solution["effort"]]
    # What vanishes is small beside the forces, and beside what they do to the lightest body.
    scale = max(map(abs, solution["normal"] + rest)) / min(mass for mass, *_ in m.bodies.values())
    return (questions.near(solution["normal"] + rest, forces + efforts, 1e-6)
            and questions.near(solution["acceleration"] + [scale], [x for name in m.bodies for x in accelerations[name]] + [scale], 1e-6))


def main():
    options = arguments(__doc__.splitlines()[0], 10000).parse_args()
    options.count = -(-options.count // POINTS)         # mechanisms
    conclude(work, options, 10,
             lambda t: f"{t['failures']} of {t['comparisons']} comparisons between questions fail, at {t['points']} points of "
                       f"{t['mechanisms']} mechanisms ({t['refused']} points refused); {t['determinate']} points compared with the equations "
                       f"of every body ({t['doubtful']} too near to a boundary), {t['rest']} states of rest with linear programs.")


if __name__ == "__main__":
    main()
