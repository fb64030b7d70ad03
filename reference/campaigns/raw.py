#!/usr/bin/env python3
"""Raw problems against exact brute force: every answer of `slideway modes` to random problems, with several options.

    python3 reference/campaigns/raw.py --seed 1 --count 17000 --failures /tmp/failures

A comparison is one problem with one set of options. Standard library only.
"""
import json
from collections import Counter
from functools import partial

import block_oracle
import raw_generate
import raw_problems
from common import Failures, answers, arguments, conclude, streamed
from exact import Solutions, TooLarge
from raw_compare import compare
from raw_problems import FORMS, orientation

LISTED = ["--max-solutions", "5000"]
OPTIONS = {"plain": LISTED, "any": [*LISTED, "--any"], "found2": [*LISTED, "--max-found", "2"], "count": ["--count-only"],
           "unique": [*LISTED, "--uniqueness"], "nodes": [*LISTED, "--max-nodes", "3"]}
STREAMED = 25           # of so many problems one is streamed, by a process of its own


def fractions_read():
    """How the program takes a text such as "2/3": "exactly", "rounded", or "not at all"."""
    (answer,) = answers([{"type": "lcp", "M": [["1/3", 1], [1, 3]], "q": [-1, -3]}], [])     # singular, if it is 1/3
    return "not at all" if "faults" in answer else "exactly" if answer["status"] == "continuum" else "rounded"


def truth(problem):
    """All solutions in exact arithmetic, or None if the oracle does not reach the problem."""
    if problem["type"] == "block_ave":
        return block_oracle.solutions(problem)
    slots, right = FORMS[problem["type"]](problem)
    try:
        return Solutions(slots, right, orientation(slots))
    except TooLarge:
        return None


def work(options, batch):
    first, count = batch
    raw_problems.ROUNDED = options.fractions == "rounded"
    made = [(index, *raw_generate.problem(options.seed, index, options.fractions != "not at all")) for index in range(first, first + count)]
    known = [truth(problem) for _, _, problem in made]
    total, failures = Counter(), Failures(options.failures)
    total["problems"] += count
    total["skipped"] += sum(exact is None for exact in known)
    tell = partial(judge, options, total, failures)
    for name, flags in OPTIONS.items():
        for case, exact, answer in zip(made, known, answers([p for _, _, p in made], flags)):
            tell(case, exact, name, flags, answer)
    for case, exact in list(zip(made, known))[::STREAMED]:
        tell(case, exact, "stream", ["--stream"], streamed(case[2], []))
    return total


def judge(options, total, failures, case, exact, name, flags, answer):
    """Counts a comparison, and writes it down if it fails."""
    index, family, problem = case
    if exact is None and not isinstance(answer, str):
        return
    total["comparisons"] += 1
    fault = f"crash: {answer}" if isinstance(answer, str) else compare(problem, exact, answer, name, total)
    if fault is None:
        return
    total["failures"] += 1
    total[f"failure: {name} {problem['type']} {fault.split(':')[0]}"] += 1
    command = " ".join(["slideway modes", *flags, *([] if name == "stream" else ["--format json"]), "FILE"])
    failures.write(f"raw-{options.seed}-{index}-{problem['type']}-{family}-{name}", {".json": json.dumps(problem) + "\n"}, command,
                   answer if isinstance(answer, str) else json.dumps(answer), fault)


def main():
    options = arguments(__doc__.splitlines()[0], 17000).parse_args()
    options.fractions = fractions_read()
    conclude(work, options, 200,
             lambda t: f"{t['failures']} of {t['comparisons']} comparisons of {t['problems']} raw problems fail "
                       f"({t['skipped']} problems beyond the oracle, {t['no radius']} solutions without a radius, "
                       f"{t['wide blocks']} of blocks with wide bounds, "
                       f"{t['left open']} answers left open near a boundary; fractions as texts are read {options.fractions}).")


if __name__ == "__main__":
    main()
