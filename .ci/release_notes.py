#!/usr/bin/env python3
"""Prints what CHANGELOG.md says of a release, and fails unless everything is ready for it.

    .ci/release_notes.py v0.1.0

The workspace and the Python package must have the version of the tag, and the changelog a date for it.
"""

import re
import sys
import tomllib
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent


def notes(tag: str) -> str:
    version = tag.removeprefix("v")
    workspace = tomllib.loads((TOP / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
    package = (TOP / "crates/slideway-python/python/slideway/__init__.py").read_text(encoding="utf-8")
    (python,) = re.findall(r'^__version__ = "(.*)"$', package, re.MULTILINE)
    for where, found in {"Cargo.toml": workspace, "slideway/__init__.py": python}.items():
        if found != version:
            sys.exit(f"the tag is {tag}, but {where} has version {found}")
    changelog = (TOP / "CHANGELOG.md").read_text(encoding="utf-8")
    section = re.search(rf"^## {re.escape(version)}, (.*)\n((?:(?!## ).*\n?)*)", changelog, re.MULTILINE)
    if section is None or not re.fullmatch(r"\d{4}-\d{2}-\d{2}", section[1]):
        sys.exit(f"CHANGELOG.md must begin its section with `## {version}, ` and the date, such as 2027-01-31")
    return section[2].strip()


if __name__ == "__main__":
    print(notes(*sys.argv[1:]))
