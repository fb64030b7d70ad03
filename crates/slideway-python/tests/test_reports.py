"""Reports: what they consist of is what their classes say; they are frozen, compared, kept."""

from __future__ import annotations

import copy
import dataclasses
import functools
import json
import pickle
import subprocess
import sys
import types
import typing
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest
from conftest import MODELS, QUESTIONS, WORKSPACE

import slideway
from slideway import Model, reports

# What annotations name.
NAMES = {**vars(typing), **vars(reports), "reports": reports, "Answer": Any}


@functools.cache
def asked(name: str, question: str) -> Any:
    """The answer, or None where the question does not concern the model."""
    return ask(name, question)


def ask(name: str, question: str) -> Any:
    """The same, asked again."""
    try:
        answer = QUESTIONS[question].ask(Model.gallery(name), name)
    except slideway.ModelError:
        return None
    return answer.report if isinstance(answer, slideway.Motion) else answer


def misfit(value: object, hint: Any, place: str) -> str | None:
    """Where a value is not what its annotation says; None if it is."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    fits = True
    within: list[tuple[object, Any, str]] = []
    if hint is Any:
        pass
    elif origin is typing.Literal:
        fits = value in arguments
    elif origin in (typing.Union, types.UnionType):
        tried = [misfit(value, one, place) for one in arguments]
        return None if None in tried else next(text for text in tried if text)
    elif origin is np.ndarray:
        fits = isinstance(value, np.ndarray) and value.dtype == np.float64 and not value.flags.writeable
    elif origin is tuple and arguments[-1] is Ellipsis:
        fits = isinstance(value, tuple)
        within = [(item, arguments[0], f"{place}[]") for item in value] if isinstance(value, tuple) else []
    elif origin is tuple:
        fits = isinstance(value, tuple) and len(value) == len(arguments)
        within = [(*pair, f"{place}[]") for pair in zip(value, arguments)] if isinstance(value, tuple) else []
    elif origin is Mapping:
        fits = isinstance(value, Mapping)
        if isinstance(value, Mapping):
            within = [(item, arguments[1], f"{place}[{key!r}]") for key, item in value.items()]
            within += [(key, arguments[0], f"key of {place}") for key in value]
    elif hint in (float, int, str, bool, type(None)):
        fits = type(value) is hint
    elif dataclasses.is_dataclass(hint):
        fits = type(value) is hint
        if fits:
            hints = typing.get_type_hints(hint, NAMES)
            names = [field.name for field in dataclasses.fields(hint)]
            has = [name for name in vars(value) if not name.startswith("_")]
            if extra := set(has) - set(names):
                return f"{place} has {sorted(extra)}, which {hint.__name__} has not"
            within = [(getattr(value, name), hints[name], f"{place}.{name}") for name in names]
    else:
        return f"{place}: nothing is known of {hint}"
    if not fits:
        return f"{place} should be {hint}, not {value!r}"
    return next((found for one in within if (found := misfit(*one))), None)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("name", MODELS)
def test_every_value_is_what_its_class_says(name: str, question: str) -> None:
    answer = asked(name, question)
    if answer is not None:
        assert answer.schema
        assert misfit(answer, type(answer), type(answer).__name__) is None


def test_every_question_has_an_answer_for_some_model() -> None:
    for question in QUESTIONS:
        assert any(asked(name, question) is not None for name in MODELS), question


def test_a_misfit_is_found() -> None:
    warning = reports.Tally(**{field.name: "x" for field in dataclasses.fields(reports.Tally)})
    assert misfit(warning, reports.Tally, "tally")


def test_problems_given_by_matrices_are_what_their_class_says() -> None:
    for answer in (
        slideway.modes.lcp([[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0], uniqueness=True),
        slideway.modes.lcp([[0.0]], [0.0], uniqueness=True),
        slideway.modes.solve([[1.0]], [[-0.5]], [1.0]),
        slideway.modes.hlcp([[1.0]], [[1.0]], [1.0]),
        slideway.modes.mode_problem([[1.0]], [[1.0]], [1.0], jumps=([[0.5]], [[-0.5]])),
    ):
        assert answer.schema
        assert misfit(answer, reports.RawReport, "RawReport") is None


def test_classes_are_those_of_the_sources() -> None:
    tool = WORKSPACE / "crates" / "slideway-python" / "tools" / "generate_reports.py"
    done = subprocess.run([sys.executable, tool, "--check"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("question", ["solve", "limits", "hold", "drive", "size for a margin", "map", "check"])
def test_attributes_are_those_of_the_json_output(question: str) -> None:
    answer = asked("drawer", question)
    data = json.loads(answer.to_json())
    assert answer.schema and answer.to_dict() == data
    assert {name.rstrip("_") for name in vars(answer) if not name.startswith("_")} | {"answer"} >= set(data)
    assert answer.answer == data["answer"] and answer.answer
    again = pickle.loads(pickle.dumps(answer))
    assert again.answer == answer.answer and again.text(verbose=True) == answer.text(verbose=True)


@pytest.mark.parametrize("question", [question for question in QUESTIONS if question != "simulate"])
def test_fields_are_listed_before_one_is_asked_for(question: str) -> None:
    listed = dir(ask("drawer", question))
    answer = asked("drawer", question)
    fields = {field.name for field in dataclasses.fields(answer)}
    assert fields | {"answer", "text", "to_json"} <= set(listed)
    assert all(hasattr(answer, name) for name in fields)


def test_answers_are_sequences_of_their_solutions() -> None:
    answer = Model.gallery("klepp-2002").solve()
    assert len(answer) == 3 and list(answer) == [answer[0], answer[1], answer[-1]]
    assert answer[1:] == answer.solutions[1:] and answer[0] is answer.solutions[0]
    with pytest.raises(IndexError):
        answer[3]
    raw = slideway.modes.lcp([[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0])
    assert len(raw) == 3 and raw[2] == list(raw)[2]


@pytest.mark.parametrize("name", MODELS)
def test_a_solution_is_shown_in_ten_lines(name: str) -> None:
    for solution in asked(name, "solve") or ():
        shown = repr(solution)
        assert 2 <= len(shown.splitlines()) <= 10
        assert shown.startswith("<slideway.Solution") and shown.endswith("all of it: to_dict()>")
        for contact in solution.contacts:
            force = f"{contact.name}: normal force {contact.normal_force:.5g} N"
            assert force in shown or len(shown.splitlines()) == 10


def test_a_pickled_map_has_its_pixels_and_plot() -> None:
    plane = Model.gallery("drawer").map(mu=(0, 1), L=("0.3 m", "0.5 m"), size=(8, 6))
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(plane))))
    assert again == plane and np.array_equal(again.pixels(), plane.pixels())
    for theme in ("light", "dark"):
        assert again._answer.drawn_map(theme) == plane._answer.drawn_map(theme)
    with pytest.raises(ValueError, match="theme"):
        again.plot(theme="blue")


def test_a_pickled_sweep_has_its_table() -> None:
    import pyarrow

    sweep = Model.gallery("klepp-2002").sweep(mu_1=np.linspace(0, 0.8, 41))
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(sweep))))
    assert again.to_numpy().tobytes() == sweep.to_numpy().tobytes()
    assert again.columns == sweep.columns and again.units == sweep.units and again.contacts == sweep.contacts
    assert again.tally == sweep.tally and str(again) == str(sweep) and repr(again) == repr(sweep)
    assert pyarrow.table(again).equals(pyarrow.table(sweep))
    with pytest.raises(ValueError, match="read-only"):
        again.to_numpy()["mu_1"][0] = 1.0
    with pytest.raises(TypeError, match="ask the model again"):
        again.plot()


@pytest.mark.parametrize("question", [question for question in QUESTIONS if question != "simulate"])
def test_equality_pickle_copy(question: str) -> None:
    answer, again = asked("drawer", question), ask("drawer", question)
    for other in (again, pickle.loads(pickle.dumps(answer)), copy.copy(answer), copy.deepcopy(answer)):
        assert other == answer and hash(other) == hash(answer)
        assert other.to_json() == answer.to_json() and str(other) == str(answer)
    assert answer != asked("screw", question)


def test_reports_are_frozen() -> None:
    answer = Model.gallery("drawer").solve()
    with pytest.raises(dataclasses.FrozenInstanceError):
        answer.status = "none"  # type: ignore[misc]
    with pytest.raises(dataclasses.FrozenInstanceError):
        answer.solutions[0].contacts[0].normal_force = 0.0  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        answer.solutions[0].normal_forces[0] = 0.0


def test_arrays_of_a_solution() -> None:
    (solution,) = Model.gallery("drawer").solve()
    # Moments about the middle of the guide: N_front L = N a' with the push P = Q + mu (|N_f| + |N_r|), see
    # reference/textbook.toml; here only that arrays and contacts say the same.
    assert solution.normal_forces.tolist() == [contact.normal_force for contact in solution.contacts]
    assert solution.friction_forces.tolist() == [contact.friction_force for contact in solution.contacts]
    assert solution.efforts.tolist() == [drive.effort for drive in solution.drives]


def test_an_attribute_that_is_not_there() -> None:
    answer = Model.gallery("drawer").solve()
    with pytest.raises(AttributeError, match="'SolveReport' object has no attribute 'solution'"):
        _ = answer.solution  # type: ignore[attr-defined]
    assert not hasattr(answer, "_missing")


def test_representations_fit_a_line() -> None:
    for question in QUESTIONS:
        for name in MODELS:
            answer = asked(name, question)
            if answer is not None:
                text = repr(answer)
                assert "\n" not in text and text.startswith(f"<slideway.{type(answer).__name__}: ")
