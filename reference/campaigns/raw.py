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
from common import Failures, answers, arguments, batches, conclude
from exact import Solutions, TooLarge
from raw_compare import compare
from raw_problems import FORMS, orientation

LISTED = ["--max-solutions", "5000"]
OPTIONS = {"plain": LISTED, "any": [*LISTED, "--any"], "found2": [*LISTED, "--max-found", "2"], "count": ["--count-only"],
           "unique": [*LISTED, "--uniqueness"], "nodes": [*LISTED, "--max-nodes", "3"]}


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
    made = [(index, *raw_generate.problem(options.seed, index)) for index in range(first, first + count)]
    known = [truth(problem) for _, _, problem in made]
    total, failures = Counter(), Failures(options.failures)
    total["problems"] += count
    total["skipped"] += sum(exact is None for exact in known)
    for name, flags in OPTIONS.items():
        for (index, family, problem), exact, answer in zip(made, known, answers([p for _, _, p in made], flags)):
            if exact is None and not isinstance(answer, str):
                continue
            total["comparisons"] += 1
            fault = f"crash: {answer}" if isinstance(answer, str) else compare(problem, exact, answer, name, total)
            if fault is None:
                continue
            total["failures"] += 1
            kind = fault.split(":")[0]
            total[f"failure: {name} {problem['type']} {kind}"] += 1
            command = " ".join(["slideway modes", *flags, "--format json FILE"])
            failures.write(f"raw-{options.seed}-{index}-{problem['type']}-{family}-{name}", {".json": json.dumps(problem) + "\n"}, command,
                           answer if isinstance(answer, str) else json.dumps(answer), fault)
    return total


def main():
    options = arguments(__doc__.splitlines()[0], 17000).parse_args()
    conclude(partial(work, options), batches(options, 200), options.jobs,
             lambda t: f"{t['failures']} of {t['comparisons']} comparisons of {t['problems']} raw problems fail "
                       f"({t['skipped']} problems beyond the oracle, {t['no radius']} solutions without a radius, "
                       f"{t['left open']} answers left open near a boundary).")


if __name__ == "__main__":
    main()
