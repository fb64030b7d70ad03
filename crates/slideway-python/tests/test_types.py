"""What type checkers see: stubs that are those of the extension, and annotations without a fault."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import slideway

HERE = Path(__file__).resolve().parent


def test_stubs_are_those_of_the_extension() -> None:
    assert shutil.which("cargo"), "Cargo builds what the stubs are made of"
    tool = HERE.parent / "tools" / "generate_stubs.py"
    done = subprocess.run([sys.executable, tool, "--check"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_annotations() -> None:
    of_package = Path(slideway.__file__).parent
    command = [sys.executable, "-m", "mypy", "--config-file", str(HERE.parent / "pyproject.toml")]
    done = subprocess.run(
        [*command, str(of_package), str(HERE / "typed_examples.py")],
        cwd=of_package.parent,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_examples_run_as_well() -> None:
    names: dict[str, object] = {}
    exec((HERE / "typed_examples.py").read_text(), names)
    assert names["column"] is not None
