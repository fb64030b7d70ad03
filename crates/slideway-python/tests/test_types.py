"""What type checkers see: stubs that are those of the extension, and annotations without a fault."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

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
