#!/usr/bin/env python3
"""Proof files of random raw problems: the checker accepts each, and no changed one that lists anything but all solutions.

    python3 reference/campaigns/proofs.py --seed 1 --count 2000 --failures /tmp/failures

Every proof is changed in three ways: numbers and lines at random, cells dropped and leaves exchanged, and it is offered for another
problem of the same family. Whether what an accepted one lists is true is decided by the oracle of `reference/proofs`, which tries
every pattern and knows no proof. Standard library only.
"""
import json
import math
import random
import sys
from collections import Counter
from pathlib import Path

import raw_generate
from common import ROOT, Failures, arguments, conclude, run, scratch
from exact import Solutions, TooLarge
from raw_problems import FORMS, has_jumps

sys.path.insert(0, str(ROOT / "reference" / "proofs"))

from problems import Equations  # noqa: E402: in the folder of the checker's test
from test_check_proof import changed, check, check_proof, is_true  # noqa: E402

ORACLE = 5          # contacts up to which the oracle of the proofs is quick


def proof_of(problem, folder):
    """(problem that the checker reads, its data, proof) or a text that tells why there is none."""
    file, proof = folder / "problem.json", folder / "proof.txt"
    equivalent = folder / "proof.txt.json"
    equivalent.unlink(missing_ok=True)
    file.write_text(json.dumps(problem))
    code, out, err = run(["modes", file, "--proof", proof, "--force", "--format", "json", "--max-solutions", "5000", "--time-limit", "20s"])
    if code not in (0, 1):
        return f"exit code {code}: {err.strip()[-300:]}"
    read = equivalent if equivalent.exists() else file
    return json.loads(read.read_text()), check_proof.read_problem(read), proof.read_text()


def leaves_changed(text, rng):
    """Cells dropped with their leaves, leaves exchanged, or the leaf of a cell in place of another."""
    lines = text.splitlines()
    leaves = [at for at, line in enumerate(lines) if line.split()[:1] in (["f"], ["z"], ["c"], ["x"], ["l"])]
    cells = [at for at, line in enumerate(lines) if line.startswith("cell")]
    if cells and rng.random() < 0.5:
        number = rng.randrange(len(cells))
        if rng.random() < 0.5:
            del lines[cells[number]]
            renumber = {f"c {i}": f"c {i - 1 if i > number else max(0, number - 1)}" for i in range(len(cells))}
            lines = [renumber.get(line, line) for line in lines]
        else:
            fields = lines[cells[number]].split()
            fields[rng.randrange(1, len(fields)) if len(fields) > 1 else 0] = str(rng.randrange(12))
            lines[cells[number]] = " ".join(fields)
    elif len(leaves) > 1:
        one, other = rng.sample(leaves, 2)
        lines[one], lines[other] = lines[other], lines[one]
    elif leaves:
        del lines[leaves[0]]
    return "\n".join(lines) + "\n"


def sibling(problem, rng):
    """A problem of the same family in which one number is another."""
    other = json.loads(json.dumps(problem))
    names = [name for name in other if isinstance(other[name], list) and other[name]]
    row = other[rng.choice(names)]
    if isinstance(row[0], list):
        row = rng.choice(row)
    at = rng.randrange(len(row))
    doubled = row[at] * 2 if math.isfinite(row[at] * 2) else row[at] / 2
    row[at] = rng.choice([-row[at] or 1, row[at] + 1, doubled or -1, 0 if row[at] else 1])
    return other


def read(problem, folder):
    path = folder / "sibling.json"
    path.write_text(json.dumps(problem))
    return check_proof.read_problem(path)


def one_problem(index, options, folder, total, fail):
    rng = random.Random(f"proof {options.seed}/{index}")
    family, problem = raw_generate.problem(options.seed, index)
    if problem["type"] == "block_ave":
        return                                  # not linear: no proof file
    found = proof_of(problem, folder)
    if isinstance(found, str):
        if problem["type"] == "ave" and "overflows" in found:
            total["refused"] += 1           # A + B or A - B has no numbers: said before the search
            return None
        total["without a proof"] += 1
        return fail("no proof", problem, found, "a proof of the whole list, or that there will be none before the search")
    read_problem, data, text = found
    total["proofs"] += 1
    tree = check(data, text)
    if tree is None:
        return fail("refused", read_problem, text, "a proof that the checker accepts")
    small = len(data[2]) <= ORACLE
    equations = Equations(read_problem) if small else None
    truth = equations.truth() if small else None
    if small and not is_true(tree, equations, truth):
        return fail("untrue", read_problem, text, f"supports of the solutions: {sorted(map(sorted, truth))}")
    if problem["type"] in ("lcp", "hlcp", "ave", "modes") and not has_jumps(problem):
        fault = other_count(problem, tree)
        if fault:
            return fail("count", read_problem, text, fault)
    if not small:
        return None
    for kind, other_problem, mutant in mutants(read_problem, text, rng):
        total["mutants"] += 1
        same = other_problem is read_problem
        accepted = check(data if same else read(other_problem, folder), mutant)
        if accepted is None:
            continue
        other = equations if same else Equations(other_problem)
        if is_true(accepted, other, truth if same else other.truth()):
            total["accepted and true"] += 1
            continue
        fail(f"false mutant, {kind}", other_problem, mutant, f"not true; the proof was\n{text}")
    return None


def mutants(problem, text, rng):
    yield "numbers", problem, changed(text, rng)
    yield "leaves", problem, leaves_changed(text, rng)
    yield "another problem", sibling(problem, rng), text


def other_count(problem, tree):
    """Whether the proof lists as many sets as there are in exact arithmetic."""
    try:
        exact = Solutions(*FORMS[problem["type"]](problem))
    except TooLarge:
        return None
    if tree.products or not all(cell.exact for cell in tree.cells):
        return None             # sets that may be part of others
    true, comes = len(exact.points) + len(exact.continua), tree.count() - tree.parts_of_others()
    return None if comes == true else f"{true} sets of solutions, the proof lists {comes}"


def work(options, batch):
    total, failures = Counter(), Failures(options.failures)
    with scratch() as name:
        for index in range(batch[0], batch[0] + batch[1]):
            def fail(kind, problem, comes, true):
                total["failures"] += 1
                total[f"failure: {kind}"] += 1
                failures.write(f"proof-{options.seed}-{index}-{kind.replace(' ', '-').replace(',', '')}",
                               {".json": json.dumps(problem) + "\n", ".proof": comes}, "check_proof.py FILE.json FILE.proof", comes, true)
            one_problem(index, options, Path(name), total, fail)
    return total


def main():
    options = arguments(__doc__.splitlines()[0], 2000).parse_args()
    options.count = -(-options.count * 8 // 7)      # every eighth problem has no proof
    conclude(work, options, 25,
             lambda t: f"{t['failures']} failures: {t['proofs']} proofs checked, {t['without a proof']} problems without one, "
                       f"{t['mutants']} changed proofs tried, {t['accepted and true']} of them accepted because they are true as well.")


if __name__ == "__main__":
    main()
