"""What all answers can do."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

if TYPE_CHECKING:
    from ._slideway import Answer


def _same(left: object, right: object) -> bool:
    if isinstance(left, np.ndarray) and isinstance(right, np.ndarray):
        return np.array_equal(left, right, equal_nan=True)
    if isinstance(left, tuple) and isinstance(right, tuple):
        return len(left) == len(right) and all(map(_same, left, right))
    return bool(left == right)


def _plain(value: object) -> object:
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, Record):
        return value.to_dict()
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    return value


class Record:
    """Plain data: frozen, with equality."""

    def to_dict(self) -> dict[str, Any]:
        """The same as dictionaries, lists, numbers and texts."""
        return {name.rstrip("_"): _plain(value) for name, value in vars(self).items() if not name.startswith("_")}

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        names = self.__dataclass_fields__  # type: ignore[attr-defined]
        return all(_same(getattr(self, name), getattr(other, name)) for name in names)

    def __hash__(self) -> int:
        names = self.__dataclass_fields__  # type: ignore[attr-defined]
        values = (getattr(self, name) for name in names)
        return hash((type(self), *(value for value in values if isinstance(value, (str, int, float)))))


class Report(Record):
    """An answer: its attributes are those of the JSON output. `print(answer)` shows what the command line shows."""

    _answer: Answer
    _absent: ClassVar[Mapping[str, object]] = {}

    def __getattr__(self, name: str) -> Any:
        # The attributes are made when one of them is first asked for.
        if name.startswith("_") or name not in self.__dataclass_fields__:  # type: ignore[attr-defined]
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)
        self.__dict__.update(self._absent)
        self.__dict__.update(self._answer.fields())
        return self.__dict__[name]

    def text(self, *, color: bool = False) -> str:
        """The answer in words and tables, as the command line shows it."""
        return self._answer.text(color)

    def to_json(self) -> str:
        """The JSON output of the command line."""
        return self._answer.json()

    def to_dict(self) -> dict[str, Any]:
        """The JSON output as dictionaries and lists."""
        data: dict[str, Any] = json.loads(self.to_json())
        return data

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return f"<slideway.{type(self).__name__}: {self._headline()}>"

    def _headline(self) -> str:
        """A line that says what the answer is."""
        lines = [line.strip() for line in self.text().splitlines()]
        return next((line for line in lines if line), "")

    def __getstate__(self) -> dict[str, Any]:
        schema = self.schema  # noqa: F841  (makes all attributes)
        attributes = {name: value for name, value in self.__dict__.items() if name != "_answer"}
        return attributes | {"_answer": Kept(self.text(), self.to_json())}

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        self.__dict__.update(state)


class Kept:
    """What is kept of an answer that was pickled: its texts, no pictures."""

    def __init__(self, text: str, json: str) -> None:
        self._text = text
        self._json = json

    def text(self, color: bool) -> str:
        return self._text

    def json(self) -> str:
        return self._json

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        raise AttributeError("an answer that was pickled has no pictures: ask the model again", name=name, obj=self)
