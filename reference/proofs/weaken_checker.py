#!/usr/bin/env python3
"""Tests the test of check_proof.py: without any one of its conditions, the checker has to fail the test.

    python3 reference/proofs/weaken_checker.py [PROBLEMS] [MUTANTS] [SEED]

Every `require` of the checker is removed in turn, and of those with several conditions each condition. The changed checker
is written to a temporary folder and put to the test of `test_check_proof.py` with the same arguments. Printed are the conditions
whose absence the test does not notice; the exit code is 1 if there are any.
"""

import ast
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent
CHECKER = HERE.parent / "check_proof.py"
# The test with the checker of the temporary folder in place of the true one.
TEST = """
import sys
sys.path[:0] = sys.argv[1:3]
import check_proof, test_check_proof
sys.exit(test_check_proof.main(*map(int, sys.argv[3:])))
"""


def conditions(tree):
    """Each condition of each `require`, as its call and its place among those joined by `and`."""
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Name) and call.func.id == "require":
            yield from ((call, at) for at in range(len(joined(call.args[0]))))


def joined(condition):
    return condition.values if isinstance(condition, ast.BoolOp) and isinstance(condition.op, ast.And) else [condition]


def weakened(source, number):
    """The checker without one condition, with its line and its text."""
    tree = ast.parse(source)
    call, at = list(conditions(tree))[number]
    parts = joined(call.args[0])
    line, text = parts[at].lineno, ast.unparse(parts[at])
    rest = parts[:at] + parts[at + 1:]
    call.args[0] = ast.BoolOp(ast.And(), rest) if len(rest) > 1 else rest[0] if rest else ast.Constant(True)
    return ast.unparse(ast.fix_missing_locations(tree)), line, text


def is_noticed(source, arguments):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "check_proof.py").write_text(source, encoding="utf-8")
        command = [sys.executable, "-c", TEST, folder, str(HERE), *arguments]
        return subprocess.run(command, capture_output=True).returncode != 0


def main(*arguments):
    source = CHECKER.read_text(encoding="utf-8")
    cases = [weakened(source, number) for number in range(len(list(conditions(ast.parse(source)))))]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        noticed = list(pool.map(lambda case: is_noticed(case[0], arguments), cases))
    for (_, line, text), is_seen in zip(cases, noticed):
        if not is_seen:
            print(f"not noticed: line {line}: {text}")
    print(f"{sum(noticed)} of {len(cases)} conditions are noticed when they are missing")
    return 0 if all(noticed) else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
