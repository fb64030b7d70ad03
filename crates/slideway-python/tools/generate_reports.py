"""Writes `python/slideway/reports.py`: a frozen class for each type of the reports, with the documentation of its
fields, from the sources of the Rust crates. What a report consists of is said once, there.

    python tools/generate_reports.py            writes it
    python tools/generate_reports.py --check    fails if it is not what the sources say
"""

from __future__ import annotations

import keyword
import re
import sys
import textwrap
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent.parent
CRATES = HERE.parent
OUTPUT = HERE / "python" / "slideway" / "reports.py"
MIXINS = HERE / "python" / "slideway" / "_mixins.py"
SOURCES = [
    CRATES / "slideway" / "src",
    CRATES / "slideway-modes" / "src",
    CRATES / "slideway-pictures" / "src",
]

# Reports that a question has for its answer; the others are reached from them.
ROOTS = [
    "CheckReport",
    "SolveReport",
    "LimitsReport",
    "RestLimitsReport",
    "HoldReport",
    "SizeReport",
    "DriveReport",
    "MapReport",
    "SimulateReport",
    "TreeReport",
    "RawReport",
    "Tally",
    "WarningReport",
    "Figure",
    "DrawnPanel",
    "DrawnMap",
    "Theme",
]
# Of these, those that no question has for its answer.
PLAIN = ("Tally", "WarningReport", "Figure", "DrawnPanel", "DrawnMap", "Theme")

ITEM = re.compile(
    r"(?P<docs>(?:^///.*\n)*)(?P<attributes>(?:^#\[[^\n]*\]\n|^#\[expect\([\s\S]*?\)\]\n)*)"
    r"^pub (?P<kind>struct|enum) (?P<name>\w+)(?:<[^>]*>)? \{\n(?P<body>[\s\S]*?)^\}",
    re.MULTILINE,
)
# Enumerations that have a word each in tables, and the kinds of others, are declared within macros (choice.rs).
WORDED = re.compile(r"^(?:worded|kinds)! \{\n([\s\S]*?)^\}\n", re.MULTILINE)
SIMPLE = {"f64": "float", "bool": "bool", "String": "str", "str": "str", "Arc<str>": "str"}
ARRAYS = {"Vec<f64>": "array", "Vec<Option<f64>>": "array", "Vec<[f64; 2]>": "pairs"}
INTEGERS = {f"{sign}{size}" for sign in "iu" for size in ("8", "16", "32", "64", "128", "size")}


@dataclass
class Field:
    name: str
    type: str
    docs: str
    default: str | None = None


@dataclass
class Item:
    """A struct with its fields, or an enum with what it is in JSON."""

    name: str
    docs: str
    path: Path
    fields: list[Field] = field(default_factory=list)
    words: list[tuple[str, str]] = field(default_factory=list)
    variants: list[Field] = field(default_factory=list)
    """For an enum that is not a word: the fields of all its variants."""
    flattened: list[str] = field(default_factory=list)
    """Items whose fields are among its own."""
    mapping: bool = False
    """Whether it is a mapping in Python: an enum with values, but for one whose fields are another item's."""
    or_word: bool = False
    """Whether such a mapping can be a word in its place."""


def snake(name: str) -> str:
    return re.sub(r"(?<!^)(?=[A-Z])", "_", name).lower()


RENAMED = {
    "snake_case": snake,
    "lowercase": str.lower,
    "UPPERCASE": str.upper,
    "kebab-case": lambda name: snake(name).replace("_", "-"),
}


def attribute(text: str, key: str) -> str | None:
    found = re.search(rf'#\[serde\([^\]]*\b{key} = "([^"]*)"', text)
    return found and found[1]


def plain(docs: str) -> str:
    """Documentation without the marks of rustdoc's links."""
    text = "\n".join(line.removeprefix("///").removeprefix(" ") for line in map(str.strip, docs.splitlines()))
    text = re.split(r"\n\s*```", text)[0]
    text = re.sub(r"\[(`?[^\]`]+`?)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"\[`([^\]]+)`\]", r"`\1`", text)
    text = re.sub(r"`(?:crate|super|Self)(?:::\w+)*::(\w+)(?:\(\))?`", r"`\1`", text)
    text = text.replace("`None`", "None").replace("`None`", "None")
    return text.strip()


def parts(body: str) -> list[tuple[str, str, str]]:
    """The members of an item: documentation, attributes, and the text of each."""
    found, docs, attributes, text, depth = [], "", "", "", 0
    for line in body.splitlines():
        bare = line.strip()
        if not text and bare.startswith("///"):
            docs += bare + "\n"
        elif not text and bare.startswith("#["):
            attributes += bare + "\n"
        elif bare:
            text += bare + " "
            depth += bare.count("{") + bare.count("(") - bare.count("}") - bare.count(")")
            if depth == 0 and bare.endswith(","):
                found.append((docs, attributes, text.strip().rstrip(",")))
                docs, attributes, text = "", "", ""
    return found


def read() -> dict[str, Item]:
    items: dict[str, Item] = {}
    for source in SOURCES:
        for path in sorted(source.rglob("*.rs")):
            text = WORDED.sub(lambda within: textwrap.dedent(within[1]), path.read_text())
            for match in ITEM.finditer(text):
                if re.search(r"derive\([^)]*\bSerialize\b", match["attributes"]):
                    item = struct(match, path) if match["kind"] == "struct" else enum(match, path)
                    if item.name not in items or "report" in str(path):
                        items[item.name] = item
    return items


def struct(match: re.Match[str], path: Path) -> Item:
    item = Item(match["name"], plain(match["docs"]), path.relative_to(CRATES))
    for docs, attributes, text in parts(match["body"]):
        if "serde(skip)" in attributes:
            continue
        name, type_ = re.sub(r"^pub(\([^)]*\))? ", "", text).split(":", 1)
        name = attribute(attributes, "rename") or name.strip()
        if "flatten" in attributes:
            item.flattened.append(type_.strip().removeprefix("Option<").removesuffix(">"))
            continue
        skipped = attribute(attributes, "skip_serializing_if")
        default = None
        if skipped:
            default = {"Option": "None", "Vec": "()", "std": "False", "String": '""'}[skipped.split("::")[0]]
        item.fields.append(Field(name, type_.strip(), plain(docs), default))
    return item


def enum(match: re.Match[str], path: Path) -> Item:
    item = Item(match["name"], plain(match["docs"]), path.relative_to(CRATES))
    style = RENAMED[attribute(match["attributes"], "rename_all") or "snake_case"]
    if not attribute(match["attributes"], "rename_all"):
        style = str
    members = parts(match["body"])
    if any("(" in text or "{" in text for _, _, text in members):
        item.mapping = True
        # A variant without values is its word.
        tagged = re.search(r"#\[serde\([^\]]*\b(tag|untagged)\b", match["attributes"])
        item.or_word = not tagged and any("(" not in text and "{" not in text for _, _, text in members)
        item.variants = variants(match["body"])
        return item
    for docs, attributes, text in members:
        item.words.append((attribute(attributes, "rename") or style(text.split(" =")[0]), plain(docs)))
    return item


def variants(body: str) -> list[Field]:
    """The named fields of all variants of an enum; each may be absent."""
    found = {}
    for docs, name, type_ in re.findall(r"((?: +///.*\n)+)(?: +#\[.*\n)*        (\w+): (.*),\n", body):
        optional = type_ if type_.startswith("Option<") else f"Option<{type_}>"
        found.setdefault(name, Field(name, optional, plain(docs), "None"))
    return list(found.values())


def split(text: str) -> list[str]:
    """The parts of a list of types."""
    found, depth, start = [], 0, 0
    for index, letter in enumerate(text):
        depth += (letter in "<([") - (letter in ">)]")
        if letter == "," and depth == 0:
            found.append(text[start:index].strip())
            start = index + 1
    return [*found, text[start:].strip()]


class Types:
    """Types of Rust as those of Python; notes which items they need."""

    def __init__(self, items: dict[str, Item]) -> None:
        self.items = items
        self.needed: list[str] = []

    def of(self, text: str) -> str:
        text = re.sub(r"&'?\w* ?", "", text).strip()
        if text in SIMPLE:
            return SIMPLE[text]
        if text in INTEGERS:
            return "int"
        outer = re.fullmatch(r"(\w+)<(.*)>", text)
        if text in ARRAYS:
            return "NDArray[np.float64]"
        if outer and outer[1] in ("Option", "Vec", "Box", "Arc"):
            inner = self.of(outer[2])
            return {"Option": f"{inner} | None", "Vec": f"tuple[{inner}, ...]"}.get(outer[1], inner)
        if outer and outer[1] in ("BTreeMap", "HashMap"):
            key, value = split(outer[2])
            return f"Mapping[{self.of(key)}, {self.of(value)}]"
        array = re.fullmatch(r"\[(.*)(?:; (\d+))?\]", text)
        if array and ";" in text:
            inner, count = text[1:-1].rsplit(";", 1)
            if count.strip().isdigit() and int(count) <= 3:
                return f"tuple[{', '.join([self.of(inner)] * int(count))}]"
            return f"tuple[{self.of(inner)}, ...]"
        if text.startswith("("):
            return f"tuple[{', '.join(self.of(part) for part in split(text[1:-1]))}]"
        if text.endswith("Id"):
            return "int"
        if text not in self.items:
            raise SystemExit(f"no type of Python is known for `{text}`")
        if text not in self.needed:
            self.needed.append(text)
        item = self.items[text]
        mapping = "Mapping[str, Any] | str" if item.or_word else "Mapping[str, Any]"
        return mapping if item.mapping else text


HEAD = '''"""Answers as plain data: frozen classes whose attributes are those of the JSON output, in SI units unless said otherwise.

Written from the sources of the Rust crates by `tools/generate_reports.py`; not to be edited.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from . import _mixins
from ._answer import Record, Report

__all__ = {names}
'''


def documented(docs: str, indent: str) -> str:
    text = re.sub(r"(?<!\n)\n(?!\n|- )", " ", docs.replace("\\", "\\\\"))
    wrapped: list[str] = []
    for line in text.splitlines() or [""]:
        wrapped.extend(textwrap.wrap(line, 110 - len(indent)) or [""])
    if wrapped[-1].endswith('"'):
        wrapped[-1] += " "
    return f'{indent}"""' + f"\n{indent}".join(wrapped).replace(f"\n{indent}\n", "\n\n") + '"""\n'


def written() -> str:
    items = read()
    types = Types(items)
    types.needed = [*ROOTS]
    mixins = set(re.findall(r"^class (\w+)", MIXINS.read_text(), re.MULTILINE))
    texts: dict[str, str] = {}
    while missing := [name for name in types.needed if name not in texts]:
        for name in missing:
            item = items[name]
            texts[name] = words(item) if not item.fields else data(item, types, mixins)
    names = [name for name in types.needed if not items[name].mapping]
    listed = "[\n" + "".join(f'    "{name}",\n' for name in sorted(names)) + "]"
    literals = [texts[name] for name in sorted(names) if not items[name].fields]
    classes = [texts[name] for name in sorted(names) if items[name].fields]
    return HEAD.replace("{names}", listed) + "\n" + "\n".join(literals) + "\n\n" + "\n\n".join(classes) + hints(types)


def hints(types: Types) -> str:
    """What cannot be seen of a value alone: lists of numbers, and items with the fields of others, by class and field."""
    text = "\n\nHINTS: Final[Mapping[str, Mapping[str, str]]] = {\n"
    for name in sorted(types.needed):
        fields = {}
        for member in types.items[name].fields:
            inner = re.sub(r"Option<|Vec<|>", "", member.type)
            if member.type.startswith("Vec<") and member.type[4:-1] in ARRAYS:
                fields[member.name] = "arrays"
                continue
            array = ARRAYS.get(member.type.removeprefix("Option<").removesuffix(">") if "Option<Vec" in member.type else member.type)
            if array:
                fields[member.name] = array
            elif inner in types.items and types.items[inner].flattened:
                fields[member.name] = inner
        if types.items[name].flattened:
            of = types.items[types.items[name].flattened[0]]
            fields |= {member.name: "array" for member in of.variants if "Vec<" in member.type}
        if fields:
            text += f'    "{name}": {{' + ", ".join(f'"{key}": "{value}"' for key, value in fields.items()) + "},\n"
    return text + "}\n" + documented("Lists of numbers that are arrays, and classes whose name serialization does not tell, by class and field.", "")


def words(item: Item) -> str:
    if item.mapping:
        return ""
    listed = ", ".join(f'"{word}"' for word, _ in item.words)
    docs = item.docs + "\n\n" + "\n".join(f'- `"{word}"`: {docs}' for word, docs in item.words)
    text = f"{item.name} = Literal[{listed}]"
    if len(text) > 110:
        text = f"{item.name} = Literal[\n" + "".join(f'    "{word}",\n' for word, _ in item.words) + "]"
    return f"{text}\n{documented(docs, '')}"


def data(item: Item, types: Types, mixins: set[str]) -> str:
    bases = [f"_mixins.{item.name}"] if item.name in mixins else []
    is_report = item.name in ROOTS and item.name not in PLAIN
    bases.append("Report" if is_report else "Record")
    head = f"class {item.name}({', '.join(bases)}):"
    shown = ", repr=False" if is_report or item.name == "Solution" else ""
    lines = [f"@dataclass(frozen=True, eq=False, kw_only=True{shown})\n{head}\n", documented(item.docs, "    "), "\n"]
    flattened = [member for other in item.flattened for member in types.items[other].variants]
    members = item.fields + flattened
    absent = [member for member in members if member.default and (is_report or absence(member) != member.default)]
    if absent:
        # Class attributes would hide that those of a report are not made yet, and cannot be arrays.
        absent = ", ".join(f'"{member.name}": {absence(member)}' for member in absent)
        lines.append(f"    _absent = {{{absent}}}\n\n")
    for member in members:
        name = member.name + "_" if keyword.iskeyword(member.name) else member.name
        type_ = types.of(member.type)
        if member.default == "None" and not type_.endswith("None"):
            type_ += " | None"
        default = f" = {member.default}" if member.default and not is_report else ""
        if default and absence(member) != member.default:
            default = f" = field(default_factory=lambda: {absence(member)})"
        lines.append(f"    {name}: {type_}{default}\n" + documented(member.docs, "    "))
    return "".join(lines)


def absence(member: Field) -> str | None:
    """What an attribute is whose field is absent."""
    return "_mixins.EMPTY" if member.type in ARRAYS and member.default == "()" else member.default


def main() -> None:
    text = written()
    if "--check" in sys.argv:
        if OUTPUT.read_text() != text:
            raise SystemExit(f"{OUTPUT.name} is not what the sources say: run tools/generate_reports.py")
        return
    OUTPUT.write_text(text)


main()
