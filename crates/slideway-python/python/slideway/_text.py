"""Texts of models with what was changed in them."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Iterator, Sequence

Change = tuple[tuple[str, str, float | str], str]
"""Kind, name and value of a setting, and the unit of a value that is a number."""

# A value on its line, and a comment behind it.
_VALUE = r"""("(?:[^"\\\n]|\\.)*"|'[^'\n]*'|[^#\n]*?)([ \t]*(?:\#[^\n]*)?)$"""


def changed(text: str, changes: Sequence[Change]) -> str:
    """The text of a model in which values are changed: comments and all else stay as they are."""
    for (kind, name, value), unit in changes:
        if not isinstance(value, str):
            # A unit follows a number: "0.5 m", and "0.5/(1 s)".
            value = f"{value!r}/(1 {unit[2:]})" if unit.startswith("1/") else f"{value!r} {unit}" if unit else value
        text = _with_value(text, _path(kind, name), value)
    return text


def _path(kind: str, name: str) -> tuple[str, ...]:
    """The keys of a setting."""
    match kind:
        case "at":
            return "coordinates", name, "value"
        case "rate":
            return "coordinates", name, "rate"
        case "time":
            return ("time",)
        case _:
            return "parameters", name


def _with_value(text: str, path: tuple[str, ...], value: float | str) -> str:
    wanted = tomllib.loads(text)
    table = wanted
    for key in path[:-1]:
        table = table.setdefault(key, {})
    table[path[-1]] = value
    literal = json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)
    for candidate in _candidates(text, path, literal):
        # Whatever the form of the text: what is taken says what is wanted, and nothing else.
        try:
            if tomllib.loads(candidate) == wanted:
                return candidate
        except tomllib.TOMLDecodeError:
            continue
    raise ValueError(f"the text of the model has no place for {'.'.join(path)} = {literal}")


def _key(name: str) -> str:
    return rf"""(?:{re.escape(name)}|"{re.escape(name)}"|'{re.escape(name)}')"""


def _candidates(text: str, path: tuple[str, ...], literal: str) -> Iterator[str]:
    """The text with a value in each place that may be the right one."""
    *tables, last = path
    written = last if re.fullmatch(r"[A-Za-z0-9_-]+", last) else json.dumps(last, ensure_ascii=False)
    for found in re.finditer(rf"(?m)^([^#\n]*?{_key(last)}[ \t]*=[ \t]*){_VALUE}", text):
        comment = found[3]
        if comment.strip():
            # Comments stay in their column if there is room.
            column = len(found[2]) + len(comment) - len(comment.lstrip()) - len(literal)
            comment = " " * max(column, 1) + comment.lstrip()
        yield text[: found.start()] + found[1] + literal + comment + text[found.end() :]
    if tables:
        heading = r"[ \t]*\.[ \t]*".join(map(_key, tables))
        for found in re.finditer(rf"(?m)^[ \t]*\[[ \t]*{heading}[ \t]*\][^\n]*$", text):
            end = re.compile(r"(?m)^[ \t]*$|^[ \t]*\[|\Z").search(text, found.end() + 1)
            at = end.start() if end else len(text)
            yield f"{text[: found.end()]}\n{written} = {literal}{text[found.end() :]}"
            yield f"{text[:at]}{written} = {literal}\n{text[at:]}"
        inline = rf"({_key(last)}[ \t]*=[ \t]*)(\"[^\"\n]*\"|'[^'\n]*'|[^,}}\n]*?)(?=[ \t]*[,}}])"
        for found in re.finditer(inline, text):
            yield text[: found.start()] + found[1] + literal + text[found.end() :]
        for found in re.finditer(rf"(?m)^[ \t]*{_key(tables[-1])}[ \t]*=[ \t]*\{{[^\n]*?(?=[ \t]*\}}[^\n}}]*$)", text):
            yield f"{text[: found.end()]}, {written} = {literal}{text[found.end() :]}"
    else:
        first = re.search(r"(?m)^[ \t]*\[", text)
        at = first.start() if first else len(text)
        gap = "" if not text[:at] or text[:at].endswith("\n") else "\n"
        yield f"{text[:at]}{gap}{written} = {literal}\n{text[at:] and chr(10)}{text[at:]}"
    keys = ".".join(key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else json.dumps(key, ensure_ascii=False) for key in tables)
    yield f"{text.rstrip(chr(10))}\n\n[{keys}]\n{written} = {literal}\n"
