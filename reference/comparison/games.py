"""All extreme equilibria of random bimatrix games by slideway, by lrsnash, and by Gambit if it is installed.

    python3 reference/comparison/games.py target/release/slideway [GAMES]

Payoffs are small integers, so that most games are degenerate. The extreme equilibria are the pairs of vertices of the
maximal sets that slideway lists; lrsnash (Debian: lrslib) and Gambit (PyPI: pygambit) list them in rational numbers.
"""

from __future__ import annotations

import json
import random
import subprocess
import sys
import tempfile
import time
from fractions import Fraction
from typing import Any

try:
    import pygambit
except ImportError:
    pygambit = None

Matrix = list[list[int]]
# Probabilities are fractions of small integers: two that differ, differ by more than this denominator tells.
LARGEST_DENOMINATOR = 100_000


def games(count: int) -> list[tuple[Matrix, Matrix]]:
    """Random games of up to five strategies each, with a fixed seed."""
    numbers = random.Random(18)
    drawn = []
    for _ in range(count):
        rows, columns, most = numbers.randint(1, 5), numbers.randint(1, 5), numbers.choice([1, 2, 3, 9])
        draw = lambda: [[numbers.randint(0, most) for _ in range(columns)] for _ in range(rows)]  # noqa: E731
        drawn.append((draw(), draw()))
    return drawn


def exact(strategy: list[float]) -> tuple[Fraction, ...]:
    return tuple(Fraction(value).limit_denominator(LARGEST_DENOMINATOR) for value in strategy)


def of_slideway(answer: dict[str, Any]) -> set[tuple[Any, Any]]:
    assert answer["complete"] == "proven", answer
    found = {(exact(one["x"]), exact(one["y"])) for one in answer["solutions"]}
    for continuum in answer["continua"]:
        rows, columns = continuum["parts"]
        found |= {(exact(x["x"]), exact(y["y"])) for x in rows["vertices"] for y in columns["vertices"]}
    return found


def by_slideway(program: str, drawn: list[tuple[Matrix, Matrix]]) -> list[set[tuple[Any, Any]]]:
    lines = "".join(json.dumps({"type": "game", "A": a, "B": b}) + "\n" for a, b in drawn)
    options = ["modes", "-", "--json-lines", "--max-solutions", "100000"]
    run = subprocess.run([program, *options], input=lines, capture_output=True, text=True, check=True)
    return [of_slideway(json.loads(line)) for line in run.stdout.splitlines()]


def by_lrsnash(a: Matrix, b: Matrix) -> set[tuple[Any, Any]]:
    """lrsnash writes strategies of player 2, and then those of player 1 beside each of which all of them are equilibria."""
    matrix = lambda rows: "\n".join(" ".join(map(str, row)) for row in rows)  # noqa: E731
    with tempfile.NamedTemporaryFile("w", suffix=".game") as file:
        file.write(f"{len(a)} {len(a[0])}\n\n{matrix(a)}\n\n{matrix(b)}\n")
        file.flush()
        printed = subprocess.run(["lrsnash", file.name], capture_output=True, text=True, check=True).stdout
    found, columns, rows_told = set(), [], False
    for line in printed.splitlines():
        words = line.split()
        if words[:1] == ["2"]:
            columns, rows_told = ([] if rows_told else columns) + [tuple(map(Fraction, words[1:-1]))], False
        elif words[:1] == ["1"]:
            rows_told = True
            found |= {(tuple(map(Fraction, words[1:-1])), y) for y in columns}
    return found


def by_gambit(a: Matrix, b: Matrix) -> set[tuple[Any, Any]]:
    game = pygambit.Game.from_arrays(a, b)
    found = set()
    for profile in pygambit.nash.enummixed_solve(game, rational=True).equilibria:
        x, y = ([Fraction(int(profile[s].numerator), int(profile[s].denominator)) for s in p.strategies] for p in game.players)
        found.add((tuple(x), tuple(y)))
    return found


def main() -> None:
    program, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    drawn = games(count)
    begun = time.perf_counter()
    answers = by_slideway(program, drawn)
    print(f"slideway: {count} games in {time.perf_counter() - begun:.2f} s")
    others = {"lrsnash": by_lrsnash} | ({"Gambit": by_gambit} if pygambit else {})
    for name, solve in others.items():
        begun = time.perf_counter()
        told = [solve(a, b) for a, b in drawn]
        different = [game for game, own, other in zip(drawn, answers, told, strict=True) if own != other]
        seconds = time.perf_counter() - begun
        print(f"{name}: {sum(map(len, told))} extreme equilibria in {seconds:.1f} s, {len(different)} games differ {different[:1]}")


if __name__ == "__main__":
    main()
