"""Compares the motions of FAMILY.json with those of slideway.

    python compare.py SLIDEWAY FAMILY.json [--tolerance 1e-10] ...

SLIDEWAY is the program. What differs is told model by model; further arguments go to `slideway simulate`.
"""

import json
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent


def simulated(program, model, motion, extra):
    settings = [x for name, value in motion["parameters"].items() for x in ("--set", f"{name}={value!r}")]
    command = [program, "simulate", str(model), "--until", f"{motion['until']!r}s", "--format", "json", *settings, *extra]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    except subprocess.TimeoutExpired:
        return None, "more than a minute"
    if not done.stdout:
        return None, f"exit code {done.returncode}: {done.stderr[:300]}"
    return json.loads(done.stdout), None


def joints(report):
    """Of each sliding joint the times at which it changes, and its states."""
    lists = [[] for _ in report["phases"][0]["sliding"]]
    for phase in report["phases"]:
        mode = phase["mode"]
        per = len(mode) // len(lists)
        for j, entries in enumerate(lists):
            sliding, sides = phase["sliding"][j], mode[j * per : (j + 1) * per]
            word = "=" if sliding == 0 else "<>"[sliding > 0] + sides
            if not entries or entries[-1][1] != word:
                entries.append([phase["from"], word])
    return lists


def differences(motion, report):
    """What differs in words, and the greatest differences of times, places and rates."""
    found = joints(report)
    end = report["end"]
    if end["kind"] != "finished":
        return f"expected {motion['joints']}: {end['words']}", None
    for j, (expected, entries) in enumerate(zip(motion["joints"], found)):
        for i, (e, f) in enumerate(zip(expected, entries)):
            if e[1] != f[1] or abs(e[0] - f[0]) > 1e-6:
                return f"joint {j}, change {i}: expected {e}, found {f}", None
        if len(expected) != len(entries):
            i = min(len(expected), len(entries))
            return f"joint {j}: expected {expected[i - 1 : i + 2]}, found {entries[i - 1 : i + 2]}", None
    times = [abs(e[0] - f[0]) for a, b in zip(motion["joints"], found) for e, f in zip(a, b)]
    places = [abs(e[0] - f["value"]) for e, f in zip(motion["last"], report["last"])]
    rates = [abs(e[1] - f["rate"]) for e, f in zip(motion["last"], report["last"])]
    return None, (max(times), max(places), max(rates))


def main(program, file, extra):
    data = json.loads(Path(file).read_text())
    worst, agree, changes, left_out = [0.0, 0.0, 0.0], 0, 0, 0
    for motion in data["motions"]:
        if "left_out" in motion:
            left_out += 1
            continue
        report, error = simulated(program, HERE / "models" / f"{data['model']}.toml", motion, extra)
        what, numbers = (error, None) if error else differences(motion, report)
        if what:
            print(f"{Path(file).name} {motion['seed']}: {what}", flush=True)
            continue
        agree += 1
        changes += sum(len(entries) for entries in motion["joints"])
        worst = [max(pair) for pair in zip(worst, numbers)]
    print(f"{Path(file).name}: {agree} of {len(data['motions'])} agree ({left_out} left out), {changes} changes; "
          f"greatest differences {worst[0]:.1e} s, {worst[1]:.1e} m, {worst[2]:.1e} m/s", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3:])
