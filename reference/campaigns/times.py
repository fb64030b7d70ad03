"""How long each question on each gallery model takes, in processor time, and how far beyond a time limit it goes.

Every question over every parameter, coordinate, load and drive of the model; without a limit, and within one (`--limit`). Prints what takes more
than `--most` seconds, and what goes more than the limit itself beyond the limit. With `--hostile` only questions over ranges are asked, whose
ends are numbers that nobody would write. Further models may be named.
"""
import json
import os
import random
import re
import resource
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from common import ROOT, SLIDEWAY, arguments
from gallery_points import parameters

# Subnormal and huge, next to each other and far apart, across zero, around 1.
HOSTILE = [
    "1.6578092e-316..5.776622002767455e-275", "5e-324..1e-323", "0..5e-324", "-5e-324..5e-324", "0..1e-308", "1e-310..1e-300", "1e-200..1e-160",
    "0..1e-160", "1e-20..1e20", "1e15..1e17", "1e16..10000000000000002", "1e100..1e150", "1e300..1.7e308", "-1.7e308..1.7e308", "-1e-300..1e300",
    "-1e155..1e155", "1..1.0000000000000002", "0.9999999999999998..1.0000000000000004", "0..1.7e308", "-3..-2", "-1e-9..1e9",
]


def sections(text, kind):
    return re.findall(rf"^\[{kind}\.(\w+)\]", text, re.M)


def ranges(text):
    """{name: a range around its value} of the parameters, and of all friction."""
    around = {name: f"{number / 2!r}{unit}..{1.5 * number!r}{unit}" for name, (number, unit) in parameters(text).items() if number}
    return {"friction": "0.5..1.5", **around}


def questions(file, folder):
    """(command, whether it takes `--time-limit`)"""
    text = file.read_text()
    picture = ["--force", "--output", folder / "page.html"]
    yield ["check", file], False
    yield ["solve", file], True
    yield ["report", file, *picture], True
    yield ["simulate", file, "--until", "1s"], True
    loads = [*sections(text, "loads"), *sections(text, "drives"), "gravity"]
    for options in [[], *(["--load", load] for load in loads)]:
        yield ["hold", file, *options], True
    yield ["drive", file], True
    around = ranges(text)
    for name in [*around, *sections(text, "coordinates")]:
        for question in ("limits", "size", "drive"):
            yield [question, file, "--vary", name], True
        yield ["limits", file, "--both-directions", "--vary", name], True
        yield ["hold", file, "--vary", name], True
    for name, values in around.items():
        yield ["sweep", file, "--vary", f"{name}={values}:100", "--format", "csv"], True
    axes = [f"{name}={values}" for name, values in around.items()]
    for x, y in zip(axes, axes[1:]):
        yield ["map", file, "--x", x, "--y", y, "--force", "--output", folder / "map.svg"], True


def hostile_questions(file, folder, rng):
    """As `questions`, over hostile ranges."""
    text = file.read_text()
    names = [*ranges(text), *sections(text, "coordinates")]
    over = [
        ["limits", file, "--vary"], ["limits", file, "--both-directions", "--vary"], ["size", file, "--vary"], ["drive", file, "--vary"],
        ["hold", file, "--vary"], ["sweep", file, "--format", "csv", "--vary"],
    ]
    for name in names:
        for words in over:
            steps = ":100" if words[0] == "sweep" else ""
            yield [*words, f"{name}={rng.choice(HOSTILE)}{steps}"], True
    for x, y in zip(names, names[1:]):
        picture = ["--force", "--output", folder / "map.svg"]
        yield ["map", file, "--x", f"{x}={rng.choice(HOSTILE)}", "--y", f"{y}={rng.choice(HOSTILE)}", *picture], True


def taken(command, most):
    """(exit code, processor time, time, stderr)"""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    process = subprocess.Popen([SLIDEWAY, *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    try:
        _, errors = process.communicate(timeout=most)
        code = process.returncode
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGKILL)
        _, errors = process.communicate()
        code = "killed"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return code, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.monotonic() - start, errors


def main():
    parser = arguments(__doc__.splitlines()[0], 0)
    parser.add_argument("--most", type=float, default=1.0, help="report what takes more than so many seconds")
    parser.add_argument("--limit", type=float, default=0.2, help="time limit (s)")
    parser.add_argument("--hostile", action="store_true", help="ranges that nobody would write, chosen by --seed")
    parser.add_argument("models", nargs="*", type=Path)
    options = parser.parse_args()
    models = options.models or sorted((ROOT / "models").glob("*.toml"))
    os.environ["RAYON_NUM_THREADS"] = "1"
    counts = {"questions": 0, "refused": 0, "slow": 0, "beyond the limit": 0}
    with tempfile.TemporaryDirectory() as folder:
        for file in models:
            place = Path(folder)
            asked = hostile_questions(file, place, random.Random(f"{file.name} {options.seed}")) if options.hostile else questions(file, place)
            for command, limited in asked:
                words = " ".join(map(str, command)).replace(str(ROOT) + "/", "").replace(folder, "")
                code, processor, _, errors = taken(command, 30)
                counts["questions"] += 1
                counts["refused"] += code == 2
                if code not in (0, 1, 2, 3, "killed"):
                    print(f"exit code {code}: {words}\n{errors[-500:]}", flush=True)
                if processor > options.most:
                    counts["slow"] += 1
                    print(f"{processor:6.2f} s  {words}", flush=True)
                if limited and processor > options.limit:
                    _, beyond, _, _ = taken([*command, "--time-limit", f"{options.limit}s"], 30)
                    if beyond > 2 * options.limit:
                        counts["beyond the limit"] += 1
                        print(f"{beyond:6.2f} s of {processor:.2f} s, limit {options.limit} s: {words}", flush=True)
    print(json.dumps(counts))


if __name__ == "__main__":
    main()
