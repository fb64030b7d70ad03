"""Packages that parts of slideway need, and that are not installed with it."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def needs(what: str, *packages: str) -> Iterator[None]:
    """Imports within it that fail say what to install."""
    try:
        yield
    except ModuleNotFoundError as error:
        install = shlex.join(["pip", "install", *packages])
        raise ModuleNotFoundError(f"{what}: {install}", name=error.name) from error
