#!/usr/bin/env python3
"""Runs the commands of the corpus, and stores what each answers; compares two stores.

    python3 reference/corpus/run.py make target/release/slideway before.jsonl
    python3 reference/corpus/run.py compare before.jsonl after.jsonl

A store has a line for each command: its exit code, what it printed or wrote (JSON as such, other text by lines), its errors. A
command that does not end within the limit has the exit code "over its limit". Standard library only.
"""
import argparse
import json
import re
import resource
import signal
import subprocess
import sys
import tempfile
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path

from commands import ROOT, every_command

# Seconds of the processor for a command; that it needs more is an outcome, too.
LIMIT = 30
# Seconds on the clock, which others on the machine may use up.
PATIENCE = 600
# Beyond this the numbers differ, not only their rounding.
ROUNDING = 1e-9
SHOWN = 6
# What differs between two runs of one program.
MASKED = {"seconds"}
LINKS = ["models", "docs", "crates", "reference"]
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def make(options):
    program = Path(options.program).resolve()
    folders = defaultdict(list)
    for command in every_command():
        folders[command.folder or command.name].append(command)
    # Commands of one folder may need those before them.
    wanted = [commands for commands in folders.values() if any(re.search(options.only, command.name) for command in commands)]
    with ThreadPoolExecutor(options.jobs) as pool, tempfile.TemporaryDirectory(prefix="slideway-corpus-") as place:
        # Helps print the name by which the program was called.
        named = Path(place, "slideway")
        named.symlink_to(program)
        results = [result for part in pool.map(lambda commands: run_in_folder(named, commands), wanted) for result in part]
    results.sort(key=lambda result: result["command"])
    options.store.write_text("".join(json.dumps(result) + "\n" for result in results))
    late = sum(result["exit"] == "over its limit" for result in results)
    print(f"{len(results)} commands, {late} over their limit of {LIMIT} s, to {options.store}")


def run_in_folder(program, commands):
    with tempfile.TemporaryDirectory(prefix="slideway-corpus-") as folder:
        for name in LINKS:
            Path(folder, name).symlink_to(ROOT / name)
        return [run(program, command, Path(folder)) for command in commands]


def run(program, command, folder):
    streams = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen([program, *command.words], cwd=folder, **streams) as process:
        resource.prlimit(process.pid, resource.RLIMIT_CPU, (LIMIT, LIMIT + 1))
        output, errors = process.communicate(command.text.encode(), PATIENCE)
    if process.returncode == -signal.SIGXCPU:
        return {"command": command.name, "exit": "over its limit"}
    written = folder / output_file(command.words)
    if written.is_file():
        output += written.read_bytes()
    return {"command": command.name, "exit": process.returncode, "output": read(output), "errors": read(errors)}


def output_file(words):
    named = [after for word, after in zip(words, words[1:]) if word in ("-o", "--output")]
    return named[0] if named else "no file"


def read(output):
    """JSON, or JSON lines, or lines; of other files a digest."""
    try:
        text = output.decode()
    except UnicodeDecodeError:
        return sha256(output).hexdigest()
    for parsed in [json.loads, lambda text: [json.loads(line) for line in text.splitlines()]]:
        try:
            return masked(parsed(text))
        except ValueError:
            pass
    return text.splitlines()


def masked(value):
    if isinstance(value, dict):
        return {key: "masked" if key in MASKED else masked(inner) for key, inner in value.items()}
    return [masked(inner) for inner in value] if isinstance(value, list) else value


# Comparing

def compare(options):
    before, after = load(options.before, options.only), load(options.after, options.only)
    lists = {"only in the first": before.keys() - after.keys(), "only in the second": after.keys() - before.keys()}
    differing, rounded = 0, 0
    for name in sorted(before.keys() & after.keys()):
        found = list(differences(before[name], after[name], ""))
        small = all(size <= ROUNDING for _, _, _, size in found)
        differing += bool(found) and not small
        rounded += bool(found) and small
        if found and (not small or options.rounding):
            tell(name, found)
    for text, names in lists.items():
        for name in sorted(names):
            print(f"{text}: {name}")
    print(f"{len(before.keys() & after.keys())} commands: {differing} differ, {rounded} only within {ROUNDING:g}; "
          + ", ".join(f"{len(names)} {text}" for text, names in lists.items()))
    sys.exit(1 if differing or any(lists.values()) else 0)


def load(store, only):
    results = {result.pop("command"): result for result in map(json.loads, store.read_text().splitlines())}
    return {name: result for name, result in results.items() if re.search(only, name)}


def tell(name, found):
    print(name)
    for path, first, second, size in sorted(found, key=lambda one: -one[3])[:SHOWN]:
        print(f"    {path}: {short(first)} -> {short(second)}" + (f"   ({size:.1e})" if size < float("inf") else ""))
    if len(found) > SHOWN:
        print(f"    and {len(found) - SHOWN} others")


def short(value):
    text = json.dumps(value)
    return text if len(text) < 90 else text[:87] + "..."


def differences(first, second, path):
    """(path, first, second, relative difference) of what differs; of what is no number the difference is infinite."""
    if isinstance(first, dict) and isinstance(second, dict):
        for key in first.keys() | second.keys():
            yield from differences(first.get(key, "absent"), second.get(key, "absent"), f"{path}.{key}")
    elif isinstance(first, list) and isinstance(second, list) and len(first) == len(second):
        for index, pair in enumerate(zip(first, second)):
            yield from differences(*pair, f"{path}[{index}]")
    elif isinstance(first, str) and isinstance(second, str) and NUMBER.sub("#", first) == NUMBER.sub("#", second):
        sizes = [relative(float(a), float(b)) for a, b in zip(NUMBER.findall(first), NUMBER.findall(second)) if a != b]
        if first != second:
            yield path, first, second, max(sizes, default=float("inf"))
    elif is_number(first) and is_number(second):
        if first != second:
            yield path, first, second, relative(first, second)
    elif first != second:
        yield path, first, second, float("inf")


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def relative(first, second):
    return abs(first - second) / max(abs(first), abs(second)) if first != second else 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    actions = parser.add_subparsers(required=True)
    maker = actions.add_parser("make", help="run all commands with a program, and store what they answer")
    maker.add_argument("program")
    maker.add_argument("store", type=Path)
    maker.add_argument("--jobs", type=int, default=2)
    maker.set_defaults(action=make)
    comparer = actions.add_parser("compare", help="print what differs between two stores")
    comparer.add_argument("before", type=Path)
    comparer.add_argument("after", type=Path)
    comparer.add_argument("--rounding", action="store_true", help=f"also print what differs only within {ROUNDING:g}")
    comparer.set_defaults(action=compare)
    for action in (maker, comparer):
        action.add_argument("--only", default="", help="commands that match this regular expression")
    options = parser.parse_args()
    options.action(options)


if __name__ == "__main__":
    main()
