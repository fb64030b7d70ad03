"""Writes `python/slideway/_slideway.pyi`: what the extension has, for type checkers, from its own description of itself.

    python tools/generate_stubs.py            writes it
    python tools/generate_stubs.py --check    fails if it is not what the extension says

It needs maturin, and Cargo to build the extension.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
OUTPUT = HERE / "python" / "slideway" / "_slideway.pyi"
# What annotations of the sources name, which maturin does not know of.
IMPORTS = """from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Final, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _motion, _sweep, reports
from ._values import BySide, ContactValues, End, Pair, Progress, Range, Value
"""
# Simpler types for the same, and what containers hold, which maturin does not tell.
SIMPLER = {
    "SupportsFloat | SupportsIndex": "float",
    "SupportsIndex": "int",
    "SupportsGetItem[int, ": "Sequence[",
    "-> dict:": "-> dict[str, Any]:",
    "-> tuple:": "-> tuple[str, ...]:",
}


def made() -> str:
    """The stubs as maturin makes them."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "maturin", "generate-stubs", "--quiet", "--locked", "--out", folder]
        subprocess.run(command, cwd=HERE, check=True)
        return (Path(folder) / "slideway" / "_slideway.pyi").read_text()


def signature(line: str) -> str:
    """A line with annotations as they are meant: those in quotation marks are the sources' own."""
    line = re.sub(r'(?<=: )"([^"]*)"(?=[,) =])|(?<=-> )"([^"]*)"(?=:)', lambda found: found[1] or found[2], line)
    for long, short in SIMPLER.items():
        line = line.replace(long, short)
    if "all_branches: int | None = None" not in line:
        return line
    # With this argument the answer is of another type.
    one = line.replace("all_branches: int | None = None", "all_branches: None = None")
    tree = line.replace("all_branches: int | None = None", "all_branches: int")
    tree = tree.replace("-> _motion.Motion:", "-> reports.TreeReport: ...")
    return f"    @overload\n{tree}\n    @overload\n{one}"


def written() -> str:
    text = re.sub(r"(?m)^from .* import .*\n", "", made())
    lines = [signature(line) if re.match(r"\s*def ", line) else line for line in text.splitlines()]
    text = "\n".join(lines) + "\n"
    _, head, rest = text.split('"""\n', 2)
    note = "Written by `tools/generate_stubs.py`; not to be edited."
    return f'"""\n{head}\n{note}\n"""\n\n{IMPORTS}{rest}'


def main() -> None:
    text = written()
    if "--check" in sys.argv:
        if OUTPUT.read_text() != text:
            raise SystemExit(f"{OUTPUT.name} is not what the extension says: run tools/generate_stubs.py")
        return
    OUTPUT.write_text(text)


main()
