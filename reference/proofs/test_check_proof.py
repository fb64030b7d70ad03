#!/usr/bin/env python3
"""Tests check_proof.py: correct proofs are accepted, and nothing false is, however a proof is changed.

    python3 reference/proofs/test_check_proof.py [PROBLEMS] [MUTANTS] [SEED]

A small prover (branch and bound with rational linear programs) writes proofs for random problems with up to four
contacts that use every step of the format. An oracle that knows no proof tries all complementary sets of columns.
Then every proof is changed at random: tokens and lines are altered, deleted, exchanged, repeated; and the prover writes
others in which it takes steps without asking whether they apply. Such a proof may be accepted, but only if what it lists is
true, by the oracle: all listed sets are solutions, and those that close nodes are all solutions.
"""

import io
import itertools
import json
import random
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

from problems import Equations, random_problem
from prover import proof_of
from rationals import rank

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "reference"))

import check_proof  # noqa: E402: the checker is in the folder above


class Tree(check_proof.Tree):
    """A tree that knows which of its cells close a node."""

    def close(self, fields, *node):
        following = super().close(fields, *node)
        self.used = getattr(self, "used", set()) | {int(fields[0])}
        return following


check_proof.Tree = Tree


def listed(tree, columns, only_used):
    """The columns of every listed set, or of those that close nodes; `columns` are the tree's in the whole problem."""
    for number, cell in enumerate(tree.cells):
        if not only_used or number in getattr(tree, "used", ()):
            yield {columns[j] for j in cell.columns}
    for others, parts in tree.products:
        sets = [list(listed(part, [columns[j] for j in chosen], only_used)) for chosen, part in parts]
        for combination in itertools.product(*sets):
            yield {columns[j] for j in others}.union(*combination)


def check(problem_data, text):
    """The tree of a proof, or `None` if it is refused."""
    try:
        return check_proof.read_proof(problem_data, check_proof.Lines(io.StringIO(text)))
    except (check_proof.Fails, check_proof.Unreadable, ValueError):
        return None


def is_true(tree, equations, truth):
    """Whether the listed sets are complementary and not empty, those that close nodes contain all solutions, and cells
    have the stated dimensions."""
    sets, used = (list(listed(tree, range(len(equations.columns)), only_used)) for only_used in (False, True))
    for columns in sets:
        if not equations.complementary(columns) or equations.support(columns) is None:
            return False
    for cell in tree.cells:
        if cell.exact:
            support = equations.support(cell.columns)
            chosen = [equations.columns[j] for j in support]
            if support != cell.support or cell.dimension != len(chosen) - rank(chosen):
                return False
    return all(any(support <= columns for columns in used) for support in truth)


def changed(text, rng):
    """The proof with one to three random changes."""
    lines = [line.split() for line in text.splitlines()]
    for _ in range(rng.choice([1, 1, 1, 2, 3])):
        if not lines:
            break
        at = rng.randrange(len(lines))
        line = lines[at]
        match rng.randrange(10):
            case 0: del lines[at]
            case 1: lines.insert(at, list(rng.choice(lines)))
            case 2:
                other = rng.randrange(len(lines))
                lines[at], lines[other] = lines[other], lines[at]
            case 3 if line: line[rng.randrange(len(line))] = rng.choice(rng.choice(lines) or ["0"])
            case 4 if line: del line[rng.randrange(len(line))]
            case 5 if line: line.insert(rng.randrange(len(line) + 1), str(rng.randint(-3, 9)))
            case 6 if line: line[0] = rng.choice(["f", "z", "l", "x", "c", "b", "e", "s", "m", "p", "cell", "g"])
            case 7: del lines[at:at + rng.randint(1, 4)]
            case 8:
                # A cell with one more column, and the same points.
                cells = [line for line in lines if line[:1] == ["cell"]]
                if cells:
                    line = rng.choice(cells)
                    line[:] = line if "/" in line else [*line, "/", *line[1:]]
                    line.insert(1, str(rng.randint(0, 9)))
            case _ if line:
                where = rng.randrange(len(line))
                number = line[where].lstrip("-")
                line[where] = str(int(line[where]) + rng.choice([-1, 1, 2])) if number.isdecimal() else "/"
    return "\n".join(map(" ".join, lines)) + "\n"


def run(*arguments):
    """Exit code and output of the checker as a program."""
    done = subprocess.run([sys.executable, check_proof.__file__, *map(str, arguments)], capture_output=True, text=True)
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout


def check_examples():
    """The proofs of the book are accepted, and what the book says about them is printed."""
    page = (ROOT / "docs/src/proofs.md").read_text(encoding="utf-8")
    blocks = [block.split("```")[0] for block in page.split("```text\n")[1:]]
    examples = [at for at, block in enumerate(blocks) if block.startswith("slideway proof 1\nproblem 2")]
    problems = ["docs/src/examples/species.json", "crates/slideway-cli/tests/raw/good/ray.json"]
    with tempfile.TemporaryDirectory() as folder:
        for problem, at in zip(problems, examples, strict=True):
            proof = Path(folder) / "proof.txt"
            proof.write_text(blocks[at])
            assert run(ROOT / problem, proof) == (0, blocks[at + 1]), problem


def check_refusals():
    """Every condition of the checker has a proof that only it refuses: `refused.txt` gives reason, problem and proof."""
    blocks = (Path(__file__).parent / "refused.txt").read_text(encoding="utf-8").split("\n\n")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.json"
        for block in blocks:
            reason, problem, proof = block.split("\n", 2)
            path.write_text(problem)
            try:
                check_proof.read_proof(check_proof.read_problem(path), check_proof.Lines(io.StringIO(proof)))
            except check_proof.Fails as refusal:
                assert str(refusal) == reason, (block, refusal)
            else:
                raise AssertionError(block)


def check_files():
    """Files that are no problems are refused, and those that slideway reads are read as it reads them."""
    proof = "slideway proof 1\nproblem 1 0\ncell 0\nb 0\nc 0\nf -1\n"
    texts = {
        '{"type": "lcp", "M": [[1]], "q": [-1]}': 0, '{"M": [[1]], "q": [[-1.0]]}': 0,
        # Integers are rounded to doubles, too: w = 2^53 z - (2^53 + 1) has the solution z = 1.
        '{"M": [[9007199254740992]], "q": [-9007199254740993]}': 0,
        '{"M": [[1]], "q": [1]}': 1, '{"M": [[0]], "q": [-1]}': 1,
        '{"M": [[1]], "q": [-1], "M": [[1]]}': 2, '{"M": [[1]], "q": [NaN]}': 2, '{"M": [[1]], "q": [1e999]}': 2,
        '{"M": [[1]], "q": [true]}': 2, '{"M": [[1]], "q": ["-1"]}': 2, '{"M": [[1, 2]], "q": [-1]}': 2,
        '{"M": [[1], [2]], "q": [-1]}': 2, '{"M": [1], "q": [-1]}': 2, '{"M": [], "q": []}': 2, '{"M": 1, "q": -1}': 2,
        '{"type": "ave", "M": [[1]], "q": [-1]}': 2, '{"M": [[1]], "q": [-1], "r": [1]}': 2, '{"M": [[1]]}': 2,
        "[]": 2, "1": 2, "": 2, "{}": 2, '[["M", [[1]]], ["q", [-1]]]': 2, '{"M": {"0": [1]}, "q": [-1]}': 2,
    }
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        (path / "proof.txt").write_text(proof)
        for text, code in texts.items():
            (path / "problem.json").write_text(text)
            assert run(path / "problem.json", path / "proof.txt")[0] == code, text
        assert run(path / "problem.json", path / "absent.txt")[0] == 2


def check_half_spaces(rng, mutants):
    """A proof by slideway for coupling of low rank is accepted; changed, only if it lists the same points. It is that of
    16 contacts of `cargo bench -p slideway-modes --bench nodes -- --prove "low rank 2 of 16"`."""
    folder = Path(__file__).parent
    problem_data = check_proof.read_problem(folder / "low_rank.json")
    text = (folder / "low_rank.txt").read_text(encoding="ascii")
    def points(tree):
        return {frozenset(cell.positive) for cell in tree.cells}
    expected = points(check(problem_data, text))
    assert sum(line.startswith("s ") for line in text.splitlines()) > 5
    for _ in range(mutants):
        other = changed(text, rng)
        tree = check(problem_data, other)
        assert tree is None or points(tree) == expected, other
    # Neither half of a split may be forgotten: without any one of them, nodes or steps are left over.
    lines = text.splitlines(keepends=True)
    for at in [at for at, line in enumerate(lines) if line.startswith("s ")]:
        assert check(problem_data, "".join(lines[:at] + lines[at + 1:])) is None, lines[at]


def main(problems=200, mutants=25, seed=1):
    check_examples()
    check_refusals()
    check_files()
    if problems:
        check_half_spaces(random.Random(seed), mutants)
    rng = random.Random(seed)
    steps, outcomes = Counter(), Counter()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "problem.json"
        for number in range(problems):
            data = random_problem(rng)
            path.write_text(json.dumps(data))
            problem_data = check_proof.read_problem(path)
            equations = Equations(data)
            truth = equations.truth()
            exponents = [rng.randint(-3, 3) for _ in equations.right] if rng.random() < 0.3 else []
            text = proof_of(equations, exponents, rng)
            if number % 2:
                head, size, rest = text.split("\n", 2)
                text = f"{head}\n{size}\ndigest {check_proof.digest(*problem_data)}\n{rest}"
            tree = check(problem_data, text)
            assert tree is not None and is_true(tree, equations, truth), (data, text)
            steps.update(line.split()[0] for line in text.splitlines()[2:])
            wrong = (changed(text, rng) if at % 3 else proof_of(equations, exponents, rng, rng.choice([0.05, 0.2]))
                     for at in range(mutants))
            for other in wrong:
                tree = check(problem_data, other)
                outcomes["refused" if tree is None else "accepted and true"] += 1
                assert tree is None or is_true(tree, equations, truth), (data, other)
    missing = set("f z l x c b e s m p cell g rows digest".split()) - set(steps)
    print(f"{problems} proofs accepted: " + ", ".join(f"{step} {count}" for step, count in sorted(steps.items())))
    print(f"{outcomes.total()} changed or careless proofs: "
          + ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items())))
    return f"no proof has a step {missing}" if missing and problems >= 200 else 0


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))
