#!/usr/bin/env python3
"""Prints what can be counted of the size and the order of the code, one line for each measure, with how it is counted.

    .ci/measures.py [-v]      -v: also lists what was counted, where that is a list of files
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TEST_FILE = re.compile(r"(^|/)(tests?|test_[a-z_]+|random_numbers)(\.rs$|/)")
# Modules that know elements, laws and problems; all others are above them.
BELOW = {"model", "drawing", "mechanism", "configuration", "kinetics", "influence", "law", "problem", "gallery", "ids", "units", "fault"}
ELEMENT = re.compile(r"hinge|sharing|shared|press_fit|friction_circle|(?<!tho)rough")
# Plain data by design: what is asked, what is answered, what a model holds.
DATA = re.compile(r"/(report|options|model|fault|raw_problem/report)[^/]*(/|\.rs$)|_report\.rs$")


class Source:
    """A file of crates/*/src, with and without its tests (`#[cfg(test)]` items at the end of a file count as tests)."""

    def __init__(self, path):
        self.path = path.relative_to(ROOT / "crates")
        self.crate, self.parts = self.path.parts[0], self.path.with_suffix("").parts[2:]
        self.lines = path.read_text().splitlines()
        self.is_test = bool(TEST_FILE.search(self.path.as_posix().split("/src/")[1]))
        self.kept = [] if self.is_test else without_tests(self.lines)
        self.code = [line for line in self.kept if line.strip() and not line.strip().startswith("//")]

    def module(self):
        return self.parts[:-1] if self.parts[-1] in ("mod", "lib", "main") else self.parts


def without_tests(lines):
    """The lines outside of items below `#[cfg(test)]`, which end at the first closing bracket as far to the left."""
    kept, end = [], None
    for line in lines:
        if end is None and line.strip() == "#[cfg(test)]":
            end = line[:len(line) - len(line.lstrip())]
        elif end is None:
            kept.append(line)
        elif line in (end + "}", end + "};") or (line.startswith(end) and line.strip().endswith(";") and line[len(end)] != " "):
            end = None
    return kept


def circles(sources, name_of):
    """Groups of at least two that import one another, directly or around (strongly connected components)."""
    modules = {(source.crate, source.module()): source for source in sources}
    edges = {}
    for source in sources:
        one = name_of(source)
        for target in imported(source, modules):
            if one != name_of(target):
                edges.setdefault(one, set()).add(name_of(target))
    reach = {one: reachable(edges, one) for one in edges}
    groups = {frozenset(other for other in reach[one] if one in reach.get(other, ())) for one in edges}
    return [sorted(group) for group in groups if len(group) > 1]


def imported(source, modules):
    """The files that a file names by paths from `crate` or `super`, in `use` or elsewhere."""
    here = list(source.module())
    for path in re.findall(r"\b(?:crate|super)(?:::(?:super|[a-z_0-9]+))+", "\n".join(source.code)):
        words = path.split("::")
        at = [] if words[0] == "crate" else here[:len(here) - words.count("super")]
        at += [word for word in words if word not in ("crate", "super")]
        while at and (source.crate, tuple(at)) not in modules:
            at.pop()
        if (source.crate, tuple(at)) in modules:
            yield modules[source.crate, tuple(at)]


def reachable(edges, start):
    seen, open_ends = set(), [start]
    while open_ends:
        for target in edges.get(open_ends.pop(), ()):
            if target not in seen:
                seen.add(target)
                open_ends.append(target)
    return seen


def engines():
    """Rows of the table of engines."""
    table = (ROOT / "ARCHITECTURE.md").read_text().split("## One engine for each thing")[1].split("\n## ")[0]
    return [line.split("|")[1].strip() for line in table.splitlines() if line.startswith("| `")]


def measures(sources):
    production = [source for source in sources if not source.is_test]
    code = [line for source in production for line in source.code]
    above = [source for source in production
             if source.module()[:1] and source.module()[0] not in BELOW and source.crate != "slideway-modes"
             and any(ELEMENT.search(part) for part in source.parts)]
    public = [line for source in production if not DATA.search("/" + source.path.as_posix())
              for line in source.code if re.match(r"\s+pub [a-z_0-9]+: ", line)]
    constants = [line for line in code if re.match(r"\s*(pub(\([a-z ]+\))? )?const [A-Z_0-9]+: (&?\[)?f64", line)]
    crates = sorted({source.crate for source in sources})
    unsafe = [crate for crate in crates if any(
        re.search(r"\bunsafe (\{|fn|impl|trait|extern)|\(unsafe\(", line) for source in sources if source.crate == crate for line in source.code)]
    forbidding = [crate for crate in crates if any("#![forbid(unsafe_code)]" in source.lines for source in sources if source.crate == crate)]
    yield "lines in crates/*/src", sum(len(source.lines) for source in sources), "all of *.rs", []
    yield "lines without tests", sum(len(source.kept) for source in production), \
        "without tests/, tests.rs, test_*.rs and items below #[cfg(test)]", []
    yield "code", len(code), "of these, neither blank nor a comment", []
    yield "files named after an element", len(above), \
        f"path with {ELEMENT.pattern}, not below {', '.join(sorted(BELOW))}, not in slideway-modes; " \
        f"{sum(len(source.lines) for source in above)} lines", [source.path.as_posix() for source in above]
    yield "public fields", len(public), "`pub name:` outside of files of reports, options, models and faults", []
    yield "f64 constants", len(constants), "`const NAME: f64` or of a list of them, tests left out", []
    for text, name_of in [("modules", lambda s: f"{s.crate} {(s.module() or ('lib',))[0]}"), ("files", lambda s: s.path.as_posix())]:
        found = circles(production, name_of)
        yield f"circles between {text}", len(found), "groups that name one another by crate:: or super::", \
            [" ".join(group) for group in sorted(found)]
    yield "engines", len(engines()), "rows of the table in ARCHITECTURE.md", engines()
    yield "crates without unsafe", len(crates) - len(unsafe), f"of {len(crates)}; forbidden in {', '.join(forbidding)}", unsafe


def main():
    sources = [Source(path) for path in sorted((ROOT / "crates").glob("*/src/**/*.rs"))]
    for name, number, how, listed in measures(sources):
        print(f"{number:>8,}  {name}  ({how})")
        if "-v" in sys.argv:
            print("".join(f"            {item}\n" for item in listed), end="")


if __name__ == "__main__":
    main()
