"""How long each question on each gallery model takes, in processor time, and how far beyond a time limit it goes.

Every question over every parameter, coordinate, load and drive of the model; without a limit, and within one (`--limit`). Prints what takes more
than `--most` seconds, and what goes more than the limit itself beyond the limit. Further models may be named.
"""
import json
import os
import re
import resource
import signal
import subprocess
import tempfile
import time
from pathlib import Path

from common import ROOT, SLIDEWAY, arguments
from gallery_points import parameters


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
    parser.add_argument("models", nargs="*", type=Path)
    options = parser.parse_args()
    models = options.models or sorted((ROOT / "models").glob("*.toml"))
    os.environ["RAYON_NUM_THREADS"] = "1"
    counts = {"questions": 0, "refused": 0, "slow": 0, "beyond the limit": 0}
    with tempfile.TemporaryDirectory() as folder:
        for file in models:
            for command, limited in questions(file, Path(folder)):
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
