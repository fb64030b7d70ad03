"""What all answers can do."""

from __future__ import annotations

import json
import re
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

    _absent: ClassVar[Mapping[str, object]] = {}
    """Values of attributes that are absent in the JSON output."""

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> object:
            if name in self._absent:
                return self._absent[name]
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)

    def to_dict(self) -> dict[str, Any]:
        """The same as dictionaries, lists, numbers and texts.

        Returns
        -------
        dict

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").solve().solutions[0].drives[0].to_dict()["name"]
        'push'
        """
        return {name.rstrip("_"): _plain(value) for name, value in vars(self).items() if not name.startswith("_")}

    def __dir__(self) -> list[str]:
        """All fields, made or not: what completion by Tab shows."""
        return sorted({*super().__dir__(), *self.__dataclass_fields__})  # type: ignore[attr-defined]

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

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> object:
            # The attributes are made when one of them is first asked for.
            if not name.startswith("_"):
                made = {} if self._is_part else self._answer.fields()
                self.__dict__.update({**self._absent, **self.__dict__, **made})
                if name in self.__dict__:
                    return self.__dict__[name]
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}", name=name, obj=self)

    @property
    def _is_part(self) -> bool:
        """Whether it is a part of another answer, whose text and JSON output have it."""
        return "_answer" not in self.__dict__

    @property
    def answer(self) -> str:
        """The answer as one would say it to a colleague, in a sentence or a few."""
        return "" if self._is_part else self._answer.answer()

    def text(self, *, verbose: bool = False, color: bool = False) -> str:
        """The answer in words and tables, as the command line shows it.

        Parameters
        ----------
        verbose : bool, default False
            With how it is known: signs, determinants, methods.
        color : bool, default False
            With colours for a terminal.

        Returns
        -------
        str

        Examples
        --------
        >>> import slideway
        >>> print(slideway.Model.gallery("drawer").solve().text().splitlines()[0])
        A drawer pushed off-centre
        """
        if self._is_part:
            raise TypeError(f"this {type(self).__name__} is a part of another answer, which has the text")
        return self._answer.text(color, verbose)

    def to_json(self) -> str:
        """The JSON output of the command line.

        Returns
        -------
        str

        Examples
        --------
        >>> import json, slideway
        >>> json.loads(slideway.Model.gallery("drawer").solve().to_json())["status"]
        'one'
        """
        return json.dumps(self.to_dict()) if self._is_part else self._answer.json()

    def to_dict(self) -> dict[str, Any]:
        """The JSON output as dictionaries and lists.

        Returns
        -------
        dict

        Examples
        --------
        >>> import slideway
        >>> slideway.Model.gallery("drawer").solve().to_dict()["status"]
        'one'
        """
        if self._is_part:
            return super().to_dict()
        data: dict[str, Any] = json.loads(self.to_json())
        return data

    def __str__(self) -> str:
        return repr(self) if self._is_part else self.text()

    def __repr__(self) -> str:
        return f"<slideway.{type(self).__name__}: {self._headline()}>"

    def _headline(self) -> str:
        """What the answer is about, and the first line of what it says."""
        if self._is_part:
            return "a part of another answer"
        parts = [part.strip().splitlines() for part in self.text().split("\n\n")]
        title, *others = [part[0].strip().rstrip(".") for part in parts if part]
        sentence = re.split(r"\. (?=[A-Z])", " ".join(self.answer.split()))[0].rstrip(".")
        said = sentence or (others[0] if others else "")
        return said if said.startswith(title) else f"{title}: {said}"

    def __getstate__(self) -> dict[str, Any]:
        getattr(self, "schema")  # noqa: B009  (makes all attributes)
        attributes = {name: value for name, value in self.__dict__.items() if name != "_answer"}
        if self._is_part:
            return attributes
        return attributes | {"_answer": Kept((self.text(), self.text(verbose=True)), self.to_json(), self._kept())}

    def _kept(self) -> dict[str, Any]:
        """What is kept besides texts when it is pickled."""
        return {}

    def __setstate__(self, state: Mapping[str, Any]) -> None:
        self.__dict__.update(state)


class Kept:
    """What is kept of an answer that was pickled: its texts, and of a map what it shows, but no pictures."""

    def __init__(self, texts: tuple[str, str], json: str, more: Mapping[str, Any]) -> None:
        self._texts = texts
        self._json = json
        self._more = more

    def answer(self) -> str:
        said: str = json.loads(self._json).get("answer", "")
        return said

    def text(self, color: bool, verbose: bool = False) -> str:
        return self._texts[verbose]

    def json(self) -> str:
        return self._json

    def pixels(self) -> Any:
        return self._kept("pixels")

    def drawn_map(self, theme: str) -> Any:
        drawn = self._kept("drawn_map")
        if theme not in drawn:
            raise ValueError(f"theme must be 'light' or 'dark', not {theme!r}")
        return drawn[theme]

    def _kept(self, name: str) -> Any:
        if name not in self._more:
            raise self._nothing(name)
        return self._more[name]

    def _nothing(self, name: str) -> AttributeError:
        return AttributeError("an answer that was pickled has no pictures: ask the model again", name=name, obj=self)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        raise self._nothing(name)
