"""What type checkers see: stubs that are those of the extension, and annotations without a fault."""

from __future__ import annotations

import inspect
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

import pytest

import slideway
from slideway import _values, modes

HERE = Path(__file__).resolve().parent


def test_stubs_are_those_of_the_extension() -> None:
    assert shutil.which("cargo"), "Cargo builds what the stubs are made of"
    tool = HERE.parent / "tools" / "generate_stubs.py"
    done = subprocess.run([sys.executable, tool, "--check"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("checked", [["-p", "slideway"], [str(HERE / "typed_examples.py")]])
def test_annotations(checked: list[str]) -> None:
    command = [sys.executable, "-m", "mypy", "--config-file", str(HERE.parent / "pyproject.toml"), *checked]
    done = subprocess.run(command, cwd=HERE, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_examples_run_as_well() -> None:
    names: dict[str, object] = {}
    exec((HERE / "typed_examples.py").read_text(), names)
    assert names["column"] is not None


def test_signatures_show_their_defaults() -> None:
    """Not `...`, as those do whose default is not a plain number or word."""
    for base in (slideway.Model, slideway.Mechanism):
        for name in vars(base):
            thing = getattr(base, name)
            if callable(thing) and not name.startswith("_"):
                defaults = [one.default for one in inspect.signature(thing).parameters.values()]
                assert Ellipsis not in defaults, name


def test_functions_of_matrices_show_the_keywords_of_every_search() -> None:
    keywords = "max_solutions: 'int' = 100, max_nodes: 'int | None' = None, max_found: 'int | None' = None"
    keywords += ", uniqueness: 'bool' = False, time_limit: 'float | None' = None, progress: 'Progress | None' = None"
    for name in modes.__all__:
        assert keywords in str(inspect.signature(getattr(modes, name)))


def test_words_of_choices_are_those_that_are_taken() -> None:
    model = slideway.Model.gallery("drawer")
    asked: dict[str, tuple[object, Callable[[Any], object]]] = {
        "quantity": (_values.QuantityName, lambda word: model.limits(mu=(0, 1), quantity=word)),
        "units": (_values.UnitsName, lambda word: model.with_(units=word)),
        "drives": (_values.DrivesAtRest, lambda word: model.hold(drives=word)),
        "colour_by": (_values.ColourBy, lambda word: model.map(mu=(0, 1), L=(0.3, 0.4), size=(2, 2), colour_by=word)),
        "sampling": (_values.SamplingName, lambda word: model.sweep(samples=2, mu="0.1..0.2", sampling=word)),
        "impacts": (_values.ImpactLaw, lambda word: model.simulate(0.01, impacts=word)),
        "prefer": (_values.Preference, lambda word: model.simulate(0.01, prefer=word)),
        "theme": (_values.ThemeName, lambda word: model.draw(theme=word)),
    }
    for name, (words, ask) in asked.items():
        for word in get_args(words):
            ask(word)
        with pytest.raises(ValueError) as refused:
            ask("other")
        assert str(refused.value).startswith(f"{name} must be ")
        assert set(re.findall("'([^']*)'", str(refused.value))) == set(get_args(words))
