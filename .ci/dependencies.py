"""Holds the dependencies of the program to deny.toml, and THIRD-PARTY-NOTICES to the dependencies.

    .ci/dependencies.py            says what is wrong, and fails if anything is
    .ci/dependencies.py --write    writes THIRD-PARTY-NOTICES anew, that of the program and that of the Python package

Needs Python 3.11 and cargo. Everything on which the program depends on any platform is looked at, with all features;
tests and benchmarks are held to deny.toml, too, but not told in the notices, which are for binaries.
"""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
# Of whose binaries which file tells.
NOTICES = {
    "slideway-cli": TOP / "THIRD-PARTY-NOTICES",
    "slideway-python": TOP / "crates/slideway-python/THIRD-PARTY-NOTICES",
}
FONT = TOP / "crates/slideway-pictures/fonts/LICENSE"
# As Debian collects them for its package musl.
MUSL = TOP / ".ci/musl-copyright"
HEAD = """\
Third-party notices of slideway

slideway itself is under the MIT licence or the Apache License 2.0, at your choice (LICENSE-MIT, LICENSE-APACHE). Its
binaries hold the following libraries and the glyphs of a typeface, under their own licences, whose texts stand below. They
also hold the standard library of Rust (https://www.rust-lang.org, The Rust Project Developers, MIT OR Apache-2.0).
"""


def metadata():
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--all-features"]
    return json.loads(subprocess.run(command, cwd=TOP, check=True, capture_output=True).stdout)


def is_allowed(expression, allowed):
    """Whether a licence expression (SPDX) can be met by licences that are allowed."""
    words = re.findall(r"[()]|[\w.+-]+", expression.replace("/", " OR "))
    merged = []
    for word in words:
        if merged and (word == "WITH" or merged[-1].endswith(" WITH")):
            merged[-1] += " " + word
        else:
            merged.append(word)
    known = {"(": "(", ")": ")", "OR": "or", "AND": "and"}
    return eval(" ".join(known.get(word, str(word in allowed)) for word in merged))


def problems(packages, rules):
    allowed = set(rules["licenses"]["allow"])
    registries = {f"registry+{registry}" for registry in rules["sources"]["allow-registry"]}
    banned = {entry["crate"]: entry["reason"] for entry in rules["bans"]["deny"]}
    for package in packages:
        name = f"{package['name']} {package['version']}"
        if package["name"] in banned:
            yield f"{name} is banned: {banned[package['name']]}"
        if package["source"] and package["source"] not in registries:
            yield f"{name} comes from {package['source']}"
        if not package["license"] or not is_allowed(package["license"], allowed):
            yield f"{name} has the licence {package['license']}"
        for dependency in package["dependencies"] if package["source"] is None else []:
            if dependency["req"] == "*" and dependency.get("path") is None:
                yield f"{name} takes any version of {dependency['name']}"


def shipped(data, program):
    """The packages of a program, those of its own aside."""
    nodes = {node["id"]: node for node in data["resolve"]["nodes"]}
    packages = {package["id"]: package for package in data["packages"]}
    waiting = [id for id in data["workspace_members"] if packages[id]["name"] == program]
    found = set()
    while waiting:
        id = waiting.pop()
        if id not in found:
            found.add(id)
            kinds = lambda dependency: {kind["kind"] for kind in dependency["dep_kinds"]}
            waiting += [dependency["pkg"] for dependency in nodes[id]["deps"] if None in kinds(dependency)]
    return sorted(
        (packages[id] for id in found if packages[id]["source"]),
        key=lambda package: (package["name"], package["version"]),
    )


def texts(package):
    """The licence texts of a package: that of MIT alone where it may be chosen, else all."""
    folder = Path(package["manifest_path"]).parent
    files = [file for file in sorted(folder.iterdir()) if file.is_file()]
    files = [file for file in files if re.match(r"(?i)(licen[cs]e|copying|copyright|notice|unlicense)", file.name)]
    mit = [file for file in files if "mit" in file.name.lower()]
    chosen = files
    if mit and re.search(r"\bMIT\b", package["license"]) and " AND " not in package["license"]:
        chosen = mit + [file for file in files if file.name.lower().startswith("notice")]
    return ["\n".join(line.rstrip() for line in file.read_text(errors="replace").strip().splitlines()) for file in chosen]


def notices(packages, is_static):
    told = [HEAD, ""]
    owners = {}
    for package in packages:
        name = f"{package['name']} {package['version']}"
        told.append(f"{name}: {package['license']}, {package['repository'] or 'https://crates.io'}")
        for text in texts(package):
            owners.setdefault(text, []).append(name)
    told.append("DejaVu Sans 2.37 (glyphs): Bitstream Vera and Arev licences, https://dejavu-fonts.github.io")
    owners.setdefault(FONT.read_text().strip(), []).append("DejaVu Sans 2.37")
    if is_static:
        told.append("musl (in binaries that are linked statically): MIT and others, https://musl.libc.org")
        owners.setdefault(MUSL.read_text().strip(), []).append("musl")
    for text, names in owners.items():
        told += ["", "-" * 80, ", ".join(names), "", text]
    return "\n".join(told) + "\n"


def main():
    data = metadata()
    rules = tomllib.loads((TOP / "deny.toml").read_text())
    found = list(problems(data["packages"], rules))
    for program, file in NOTICES.items():
        wanted = notices(shipped(data, program), program == "slideway-cli")
        if "--write" in sys.argv[1:]:
            file.write_text(wanted)
        elif not file.exists() or file.read_text() != wanted:
            found.append(f"{file.relative_to(TOP)} is not up to date: .ci/dependencies.py --write")
    for line in found:
        print(line, file=sys.stderr)
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
