"""The command line and Python give the same bytes."""

from __future__ import annotations

import itertools
import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pytest
from conftest import DIMENSIONS, MODELS, QUESTIONS, WORKSPACE, Program

import slideway


def test_every_model_has_a_dimension() -> None:
    assert sorted(DIMENSIONS) == MODELS


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("name", MODELS)
def test_same_json(program: Program, name: str, question: str) -> None:
    asked = QUESTIONS[question]
    model = slideway.Model.gallery(name)
    said, complaint = program.json(asked.command(name), model.text)
    try:
        answer = asked.ask(model, name).to_json()
    except slideway.ModelError as error:
        assert said == ""
        for fault in error.faults:
            assert fault.message in complaint
    else:
        assert answer == said


@pytest.mark.parametrize(
    ("options", "changes"),
    [
        (["--set", "mu=0.5", "--rate", "x=-1 m/s"], {"mu": 0.5, "rate": {"x": "-1 m/s"}}),
        (["--set", "L=450 mm", "--at", "x=0.05"], {"L": "450 mm", "at": {"x": 0.05}}),
        (["--set", "mu=2/3*L/a", "--units", "mm"], {"mu": "2/3*L/a", "units": "mm"}),
        (["--time", "2 s", "--units", "SI"], {"time": "2 s", "units": "SI"}),
    ],
)
def test_same_json_with_settings(program: Program, options: list[str], changes: dict[str, Any]) -> None:
    model = slideway.Model.gallery("drawer")
    changed = model.with_(**changes)
    said, _ = program.json(["solve", *options], model.text)
    assert changed.solve().to_json() == said
    said, _ = program.json(["limits", "--vary", "mu=0..1", *options], model.text)
    assert changed.limits("mu", 0, 1).to_json() == said


PROBLEMS: dict[str, dict[str, Any]] = {
    "solve": {"A": [[2.0, -1.0], [0.5, 1.0]], "B": [[0.5, 1.5], [-1.0, 2.0]], "b": [1.0, -3.0]},
    "lcp": {"M": [[1.0, 2.0], [2.0, 1.0]], "q": [-1.0, -1.0]},
    "hlcp": {"A": [[1.0, 0.5], [0.0, 1.0]], "B": [[2.0, 0.0], [1.0, 3.0]], "q": [1.0, -2.0]},
    "mlcp": {
        "A": [[0.0]], "B": [[1.0, 0.0], [0.0, 1.0]], "C": [[1.0, 1.0]], "D": [[-1.0], [-1.0]], "a": [-1.0], "b": [-2.0, 0.0]
    },
    "mcp": {"M": [[1.0, 2.0], [2.0, 1.0]], "q": [-1.0, -1.0], "l": [0.0, -1.0], "u": [3.0, 0.1]},
    "mode_problem": {
        "columns_positive": [[1.0, 0.2], [0.3, 1.0]],
        "columns_negative": [[1.0, -0.2], [-0.3, 1.0]],
        "right_hand_side": [1.0, -2.0],
    },
}


@pytest.mark.parametrize("kind", PROBLEMS)
@pytest.mark.parametrize("uniqueness", [False, True])
def test_same_json_of_problems_given_by_matrices(program: Program, kind: str, uniqueness: bool) -> None:
    problem = PROBLEMS[kind]
    options = ["--uniqueness"] if uniqueness else []
    said, complaint = program.json(["modes", *options], json.dumps(problem), "problem.json")
    answer = getattr(slideway.modes, kind)(*problem.values(), uniqueness=uniqueness)
    assert answer.to_json() == said, complaint


@pytest.mark.parametrize("problem", [
    {"A": [[3, 3], [2, 5], [0, 6]], "B": [[3, 3], [2, 6], [3, 1]]},
    {"A": [[0.0, 1.0, -1.0], [-1.0, 0.0, 1.0], [1.0, -1.0, 0.0]]},
])
def test_same_json_of_games(program: Program, problem: dict[str, Any]) -> None:
    said, complaint = program.json(["modes"], json.dumps({"type": "game", **problem}), "problem.json")
    answer = slideway.modes.game(**problem)
    assert answer.to_json() == said, complaint
    assert all(solution.x.sum() == pytest.approx(1) for solution in answer)


# The JSON output says all that words are made of: each model and each of these questions once is enough.
@pytest.mark.parametrize(
    ("name", "question"), list(zip(MODELS, itertools.cycle(["solve", "limits", "hold", "drive", "simulate"])))
)
def test_same_words(program: Program, name: str, question: str) -> None:
    asked = QUESTIONS[question]
    model = slideway.Model.gallery(name)
    said, complaints = program.run(asked.command(name), model.text)
    try:
        answer = asked.ask(model, name)
    except slideway.ModelError as error:
        assert said == "" and all(fault.message in complaints for fault in error.faults)
    else:
        assert str(answer).strip() == said.strip()


def test_colours_only_if_wanted() -> None:
    answer = slideway.Model.gallery("drawer").solve()
    assert "\x1b" not in answer.text()
    assert re.sub(r"\x1b\[[0-9;]*m", "", answer.text(color=True)) == answer.text()
    assert answer.text(color=True) != answer.text()


@pytest.mark.parametrize("name", slideway.templates())
def test_same_model_of_a_template(program: Program, name: str) -> None:
    written, complaints = program.run_in_folder(["new", name, "--output", "-"])
    assert slideway.Model.template(name).text == written, complaints


def test_a_template_with_sizes(program: Program) -> None:
    written, _ = program.run_in_folder(["new", "drawer", "--L", "500 mm", "--mu", "0.2", "--output", "-"])
    assert slideway.Model.template("drawer", L="500 mm", mu=0.2).text == written
    with pytest.raises(slideway.ModelError) as caught:
        slideway.Model.template("drawer", L=0.5, b="1 m")
    assert {fault.argument for fault in caught.value.faults} == {"b"}
    with pytest.raises(KeyError, match="drawer"):
        slideway.Model.template("drawre")


DRAWINGS = sorted((WORKSPACE / "crates" / "slideway" / "tests").rglob("*.dxf"))


@pytest.mark.parametrize("drawing", DRAWINGS, ids=lambda path: path.stem)
def test_same_model_of_a_drawing(program: Program, drawing: Path) -> None:
    assert DRAWINGS
    written, complaints = program.run_in_folder(["import", str(drawing), "--unit", "mm"])
    try:
        assert slideway.import_dxf(drawing, unit="mm") == written
    except ValueError as error:
        assert str(error) in complaints


def test_a_drawing_without_a_unit(tmp_path: Path) -> None:
    path = tmp_path / "crank.dxf"
    path.write_text("\n".join("0 SECTION 2 ENTITIES 0 CIRCLE 8 crank 10 0 20 0 40 60 0 ENDSEC 0 EOF".split()))
    with pytest.raises(ValueError, match='for instance with `unit="mm"`'):
        slideway.import_dxf(path)
    with pytest.raises(ValueError, match="mm"):
        slideway.import_dxf(path, unit="miles")


def test_same_page(program: Program) -> None:
    """But for the command and the name of the file, of which Python knows nothing."""
    unchanged = slideway.Model.gallery("klepp-2002")
    model = unchanged.with_(F_20=0)
    options = ["--set", "F_20=0", "--vary", "mu_1=0..0.8", "--vary", "friction", "--output", "page.html"]
    _, complaints = program.run(["report", *options], unchanged.text)
    written = (program.folder / "page.html").read_text()
    page = model.report(mu_1=(0, 0.8), friction=None)
    told = re.compile("<p class=\"quiet\">Report made by .*?</p>|<p>[^<]*, changed by</p>")
    assert told.sub("", page.html) == told.sub("", written), complaints
    assert "Model.report" in page.html and "klepp" in page._repr_html_()


def test_same_table(program: Program) -> None:
    model = slideway.Model.gallery("drawer")
    program.run(["sweep", "--vary", "mu=0..1:41", "--output", "sweep.npz"], model.text)
    with np.load(program.folder / "sweep.npz") as file:
        rows = file["rows"]
    table = model.sweep(mu="0..1:41", breakpoints=True).to_numpy()
    assert table.dtype == rows.dtype
    assert table.tobytes() == rows.tobytes()
    assert not table.flags.writeable


def test_columns_and_records() -> None:
    """Data frames and NumPy have the same table. It jams from mu = L / (2 a) = 2/3 on: there the forces are missing."""
    sweep = slideway.Model.gallery("drawer").sweep(mu=np.linspace(0, 1, 41))
    table = np.asarray(sweep)
    frame = pyarrow.table(sweep)
    assert frame.column_names == sweep.columns == list(table.dtype.names or ())
    for name in sweep.columns:
        found, wanted = frame[name], table[name]
        if wanted.dtype.kind == "S":
            assert [word or "" for word in found.to_pylist()] == sweep[name].tolist(), name
        elif name == "branch":
            assert np.array_equal(found.fill_null(0).to_numpy(), wanted)
        else:
            assert np.array_equal(found.to_numpy(), wanted, equal_nan=wanted.dtype.kind == "f"), name
    assert frame["normal_force.guide.front"].null_count == 14
