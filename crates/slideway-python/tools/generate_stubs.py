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
# As tests/python.rs builds the extension: so it is not built twice. The profile of pyproject.toml would take minutes.
BUILD = ["--profile", "dev", "--features", "parquet,as-in-workspace"]
# What annotations of the sources name, which maturin does not know of.
IMPORTS = """from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Final, final, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _display, _motion, _sweep, reports
from ._values import (
    BySide,
    ColourBy,
    ContactValues,
    DrivesAtRest,
    End,
    ImpactLaw,
    MarginAgainst,
    Number,
    Pair,
    Preference,
    Progress,
    Quantity,
    QuantityName,
    Range,
    SamplingName,
    SupportValues,
    ThemeName,
    UnitsName,
    Value,
)
"""
# Simpler types for the same, and what containers hold, which maturin does not tell.
SIMPLER = {
    "SupportsFloat | SupportsIndex": "Number",
    "SupportsIndex": "int",
    "SupportsGetItem[int, ": "Sequence[",
    "-> dict:": "-> dict[str, Any]:",
    "def values(self, /) -> dict[str, Any]:": "def values(self, /) -> dict[str, Quantity]:",
    "-> tuple:": "-> tuple[str, ...]:",
}
# Arguments with which an answer is of another type.
OTHER_ANSWERS = {
    "all_branches": ("int", "reports.TreeReport"),
    "output": ("str | PathLike[str]", "Path"),
}


def made() -> str:
    """The stubs as maturin makes them."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "maturin", "generate-stubs", "--quiet", "--locked", *BUILD, "--out", folder]
        subprocess.run(command, cwd=HERE, check=True)
        return (Path(folder) / "slideway" / "_slideway.pyi").read_text()


def signature(line: str) -> str:
    """A line with annotations as they are meant: those in quotation marks are the sources' own."""
    line = re.sub(r'(?<=: )"([^"]*)"(?=[,) =])|(?<=-> )"([^"]*)"(?=:)', lambda found: found[1] or found[2], line)
    for long, short in SIMPLER.items():
        line = line.replace(long, short)
    for name, (type_, answer) in OTHER_ANSWERS.items():
        if f"{name}: {type_} | None = None" in line:
            other = line.replace(f"{name}: {type_} | None = None", f"{name}: {type_}")
            other = re.sub(r"-> .*:", f"-> {answer}: ...", other)
            line = line.replace(f"{name}: {type_} | None = None", f"{name}: None = None")
            return f"    @overload\n{other}\n    @overload\n{line}"
    if line.startswith("    def hold("):
        # With a range it is `rest_limits`.
        plain = line.replace(", **ranges: Range | None", "").removesuffix(":")
        ranged = line.replace("reports.HoldReport", "reports.RestLimitsReport")
        return f"    @overload\n{plain}: ...\n    @overload\n{ranged}"
    return line


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
