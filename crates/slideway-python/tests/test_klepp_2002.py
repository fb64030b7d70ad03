"""The example of Klepp (2002), sections 6 and 7: every number of `reference/klepp-2002.toml`. The paper counts the
normal force of contact 3 positive downwards, the model upwards."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest
from conftest import WORKSPACE

import slideway

REFERENCE = tomllib.loads((WORKSPACE / "reference" / "klepp-2002.toml").read_text())
# The printed numbers have four decimals; some are truncated (see the tests of slideway-modes).
PRINTED = 0.6e-4
WEIGHT = 9.81


def model(case: dict[str, Any], mu_1: float) -> slideway.Model:
    given = REFERENCE["parameters"]
    preloads = {f"F_{contact}0": f"{force}*m*g" for contact, force in enumerate(case["F0"], 1)}
    return slideway.Model.gallery("klepp-2002").with_(
        alpha=f"{given['alpha_deg']} deg",
        b=f"{given['b_over_l']}*l",
        h=f"{given['h_over_l']}*l",
        mu_1=mu_1,
        mu_2=given["mu_2"],
        mu_3=given["mu_3"],
        direction=case["velocity"],
        **preloads,
    )


def reactions(solution: slideway.reports.Solution) -> np.ndarray[Any, Any]:
    """In units of m g, as the paper counts them."""
    return solution.normal_forces / WEIGHT * [1, 1, -1]


def signs(solution: slideway.reports.Solution) -> str:
    return "".join("+" if force > 0 else "-" for force in reactions(solution))


@pytest.mark.parametrize("case", REFERENCE["printed"])
def test_every_printed_number(case: dict[str, Any]) -> None:
    answer = model(case, case["mu_1"]).solve()
    assert answer.complete == "proven"
    assert len(answer) == len(case["solutions"])
    for printed in case["solutions"]:
        close = [s for s in answer if np.abs(reactions(s) - printed["N"]).max() < PRINTED]
        assert len(close) == 1
        # The direction of sliding is positive: friction forces are magnitudes.
        friction = np.abs(close[0].friction_forces) / WEIGHT
        assert friction == pytest.approx(printed["F"], abs=PRINTED)
        assert friction.sum() == pytest.approx(printed["F_total"], abs=PRINTED)


@pytest.mark.parametrize("case", REFERENCE["intervals"])
def test_every_interval(case: dict[str, Any]) -> None:
    answer = model(case, 0.1).limits("mu_1", 0, 0.8)
    found = {mode.pattern: mode for mode in answer.modes if not mode.preload_gap}
    assert len(found) == len(case["modes"])
    for wanted in case["modes"]:
        first, second, third = wanted["signs"]
        mode = found[first + second + {"+": "-", "-": "+"}[third]]
        assert mode.from_ == pytest.approx(wanted["from"], abs=1e-8)
        assert mode.to == pytest.approx(wanted["to"], abs=1e-8)
        for end in ("from_is", "to_is"):
            assert getattr(mode, end) == wanted.get(end, getattr(mode, end))


@pytest.mark.parametrize("case", REFERENCE["intervals"])
def test_modes_exist_exactly_in_their_intervals(case: dict[str, Any]) -> None:
    ends = {end for mode in case["modes"] for end in (mode["from"], mode["to"])}
    around = [value for end in sorted(ends) for value in (end - 2e-8, end + 2e-8)]
    for mu_1 in (value for value in around if 0 <= value <= 0.8):
        wanted = sorted(mode["signs"] for mode in case["modes"] if mode["from"] < mu_1 < mode["to"])
        answer = model(case, mu_1).solve(margins=False)
        assert sorted(map(signs, answer)) == wanted
        assert answer.status == {0: "none", 1: "one"}.get(len(wanted), "several")
