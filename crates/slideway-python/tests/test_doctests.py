"""Examples in the documentation run: those of the docstrings, and those of the book."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest
from conftest import WORKSPACE

import slideway

OPTIONS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
MODULES = ["slideway", *(f"slideway.{module.name}" for module in pkgutil.iter_modules(slideway.__path__))]


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name), optionflags=OPTIONS).failed == 0


def test_the_examples_of_classes_of_the_extension_are_found() -> None:
    found = {test.name for test in doctest.DocTestFinder().find(slideway) if test.examples}
    assert {"slideway", "slideway.Mechanism", "slideway.Mechanism.block_slider"} <= found


def test_the_page_of_the_book(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    text = (WORKSPACE / "docs" / "src" / "python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks and all(block.startswith(">>> ") for block in blocks)
    test = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "python.md", None, 0)
    assert doctest.DocTestRunner(optionflags=OPTIONS).run(test).failed == 0
