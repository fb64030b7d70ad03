"""What the campaigns share: running slideway on many problems at once, files of failures, and the counts at the end."""
import argparse
import json
import multiprocessing
import os
import subprocess
import sys
import tempfile
from collections import Counter
from functools import partial
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SLIDEWAY = os.environ.get("SLIDEWAY", str(ROOT / "target/debug/slideway"))


def arguments(description, count):
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=count)
    parser.add_argument("--first", type=int, default=0, help="number of the first case (with --count 1: one case again)")
    parser.add_argument("--failures", type=Path, default=Path("failures"), help="folder for failing cases")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    return parser


class Failures:
    """Writes each failing case: its input files, and in a text file the command, what comes and what is true."""

    def __init__(self, folder):
        self.folder = folder

    def write(self, name, files, command, comes, true):
        self.folder.mkdir(parents=True, exist_ok=True)
        for suffix, text in files.items():
            (self.folder / f"{name}{suffix}").write_text(text)
        (self.folder / f"{name}.txt").write_text(f"{command}\n\nWhat comes:\n{comes}\n\nWhat is true:\n{true}\n")


def run(args, text="", timeout=240):
    """(exit code, output, errors) of slideway; the exit code is "hangs" if it does not end in time."""
    try:
        done = subprocess.run([SLIDEWAY, *map(str, args)], input=text, capture_output=True, text=True, timeout=timeout)
    except subprocess.TimeoutExpired:
        return "hangs", "", f"did not end within {timeout} s"
    return done.returncode, done.stdout, done.stderr


def answers(problems, options, each=30):
    """The answer of `modes --json-lines` to every problem: an object, or a text that tells how the program failed on it."""
    lines = "".join(json.dumps(p) + "\n" for p in problems)
    code, out, err = run(["modes", "--json-lines", "--threads", "1", "--time-limit", f"{each}s", *options], lines,
                         60 + 2 * each + 3 * len(problems))
    found = out.splitlines()
    if code in (0, 2) and len(found) == len(problems) and "panicked" not in err:
        return [json.loads(line) for line in found]
    if len(problems) == 1:
        return [f"exit code {code}, {len(found)} lines\n{err.strip()[:2000]}"]
    half = len(problems) // 2
    return answers(problems[:half], options, each) + answers(problems[half:], options, each)


def streamed(problem, options):
    """The answer of `modes --stream`, put together from its lines, or a text that tells how the program failed."""
    code, out, err = run(["modes", "-", "--stream", *options], json.dumps(problem))
    lines = [json.loads(line) for line in out.splitlines()]
    if code not in (0, 1, 3) or not lines or "conclusion" not in lines[-1] or lines[-1]["conclusion"]["lines"] != len(lines) - 1:
        return f"exit code {code}, {len(lines)} lines\n{err.strip()[:2000]}"
    answer = dict(lines.pop()["conclusion"])
    whole = [line for number, line in enumerate(lines, 1) if number not in answer["part_of_others"]]
    for name, key in (("solutions", "solution"), ("gap_states", "gap_state"), ("continua", "continuum")):
        answer[name] = [line[key] for line in whole if key in line]
    return answer


def conclude(work, options, size, sentence):
    """Run `work(options, (first, count))` on batches of this size in `options.jobs` processes, add up their counters, print
    `sentence(total)`, exit 1 on failures."""
    end, total = options.first + options.count, Counter()
    batches = [(first, min(size, end - first)) for first in range(options.first, end, size)]
    if options.jobs == 1:
        for batch in batches:
            total.update(work(options, batch))
    else:
        with multiprocessing.Pool(options.jobs) as pool:
            for counter in pool.imap_unordered(partial(work, options), batches):
                total.update(counter)
    print(sentence(total))
    for name, number in sorted(total.items()):
        if name.startswith("failure: "):
            print(f"  {number} {name.removeprefix('failure: ')}")
    sys.exit(1 if total["failures"] else 0)


def scratch():
    return tempfile.TemporaryDirectory(prefix="slideway-campaign-")
