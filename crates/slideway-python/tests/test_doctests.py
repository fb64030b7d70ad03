"""Examples in the documentation run: those of the docstrings, and those of the book."""

from __future__ import annotations

import doctest
import importlib
import inspect
import pkgutil
import re
from pathlib import Path

import pytest
from conftest import WORKSPACE

import slideway
import slideway.dask
from slideway import _mixins
from slideway._answer import Record, Report

OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
MODULES = ["slideway", *(f"slideway.{module.name}" for module in pkgutil.iter_modules(slideway.__path__))]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name), optionflags=OPTIONS).failed == 0


def test_the_examples_of_classes_of_the_extension_are_found() -> None:
    found = {test.name for test in doctest.DocTestFinder().find(slideway) if test.examples}
    assert {"slideway", "slideway.Mechanism", "slideway.Mechanism.block_slider"} <= found


def documented() -> dict[str, object]:
    """Every public function, and every public method of public classes."""
    found: dict[str, object] = {}
    modules = [slideway, slideway.modes, slideway.plotting, slideway.dask]
    for module in modules:
        for name in module.__all__:
            thing = getattr(module, name)
            if inspect.isclass(thing):
                found |= methods(thing)
            elif inspect.isroutine(thing):
                found[f"{module.__name__}.{name}"] = thing
    for base in filter(inspect.isclass, [Record, Report, *vars(_mixins).values()]):
        found |= methods(base)
    return found


def methods(base: type) -> dict[str, object]:
    names = [name for name in vars(base) if not name.startswith("_")]
    found = {f"{base.__name__}.{name}": getattr(base, name) for name in names}
    return {name: thing for name, thing in found.items() if inspect.isroutine(thing)}


@pytest.mark.parametrize("name", documented())
def test_documentation_is_whole(name: str) -> None:
    """What is taken, what comes back, and an example; properties and attributes say what they are in one sentence."""
    thing = documented()[name]
    text = inspect.getdoc(thing) or ""
    arguments = [argument for argument in inspect.signature(thing).parameters if argument not in ("self", "options")]
    assert not arguments or "Parameters\n----------\n" in text
    named = re.findall(r"^\*{0,2}(\w+(?:, \w+)*)(?: : .*)?$", text, re.MULTILINE)
    assert set(arguments) <= {one for names in named for one in names.split(", ")}
    assert "Returns\n-------\n" in text or ".save" in name
    assert "Examples\n--------\n" in text and re.search(">>> |See `", text)


def test_the_page_of_the_book(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (WORKSPACE / "docs" / "src" / "python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks and all(block.startswith(">>> ") for block in blocks)
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "python.md", None, 0)
    assert doctest.DocTestRunner(optionflags=OPTIONS).run(test).failed == 0
