"""The commands of the corpus, by rule: every question asked of every model, every kind of raw problem, the commands of the book, refused cases."""
import json
import re
import shlex
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "reference/campaigns"))
import raw_generate  # noqa: E402

TESTS = Path("crates/slideway-cli/tests")
# Every question is asked of the gallery, most of them of other models, the first ones of models that are refused.
GALLERY = ["models/*.toml"]
MODELS = ["docs/src/examples/*.toml", "crates/slideway/templates/*.toml", "reference/motion/models/*.toml"]
REFUSED = [f"{TESTS}/bad/*.toml", f"{TESTS}/doubtful/*.toml"]
WITH_JSON = {"check", "solve", "limits", "hold", "size", "drive", "simulate", "modes"}
# Some time in which the motions of the gallery have events.
UNTIL = "300ms"
VARIED = 2
PER_KIND, PER_COMMAND = 40, 8


class Command:
    """Words after the program's name, what it reads from standard input, and the folder it runs in (commands of one folder
    run in their order)."""

    def __init__(self, words, text="", folder=None):
        self.words = [str(word) for word in words]
        self.text = text
        self.folder = folder
        self.name = shlex.join(["slideway", *self.words]) + (f" < {folder}" if text else "")


def files(*patterns):
    return sorted(path.relative_to(ROOT) for pattern in patterns for path in ROOT.glob(pattern))


def every_command():
    """All commands, each once."""
    made = [command for path in files(*GALLERY) for asked in [of_model, over_ranges] for command in asked(path)]
    made += [command for path in files(*MODELS) for command in of_model(path)]
    made += [command for path in files(*REFUSED) for command in of_refused_model(path)]
    made += raw_problems() + random_problems() + book() + of_the_program()
    return list({command.name: command for command in made}.values())


# Models

def quantities(path):
    """(name, half of its value, twice its value) of parameters that are numbers or quantities other than zero."""
    for name, value in tomllib.loads((ROOT / path).read_text()).get("parameters", {}).items():
        read = re.fullmatch(r"\s*(-?[0-9.]+(?:e-?[0-9]+)?)\s*([^-+*/(]*)", str(value))
        if read and float(read[1]) != 0 and not isinstance(value, bool):
            number, unit = float(read[1]), read[2].strip()
            yield name, f"{number / 2:.12g} {unit}".strip(), f"{number * 2:.12g} {unit}".strip()


def with_json(*words):
    return Command([*words, "--format", "json"])


def of_model(path):
    model = tomllib.loads((ROOT / path).read_text())
    yield with_json("check", path)
    yield with_json("solve", path)
    for coordinate in model.get("coordinates", {}):
        yield with_json("solve", path, "--rate", f"{coordinate}=-1")
    yield with_json("limits", path, "--vary", "friction=0..3")
    yield with_json("hold", path)
    for load in model.get("loads", {}):
        yield with_json("hold", path, "--load", load)
    yield with_json("drive", path)
    yield with_json("simulate", path, "--until", UNTIL)
    yield Command(["sweep", path, "--vary", "friction=0..3:13"])
    for name, low, high in list(quantities(path))[:1]:
        yield with_json("size", path, "--vary", f"{name}={low}..{high}", "--margin", "1.5")


def over_ranges(path):
    yield with_json("solve", path, "--set", "nonsense=1")
    yield with_json("solve", path, "--max-solutions", 1, "--max-nodes", 2)
    yield with_json("limits", path, "--vary", "friction=0..3", "--both-directions", "--effort", "0")
    yield with_json("hold", path, "--drives", "hold")
    yield with_json("simulate", path, "--until", "30ms", "--all-branches", "--max-motions", "4")
    yield Command(["sweep", path, "--vary", "friction=0..2", "--samples", 12, "--attainability", "--all-columns"])
    for name, low, high in list(quantities(path))[:VARIED]:
        wanted = f"{name}={low}..{high}"
        yield with_json("solve", path, "--set", f"{name}={high}")
        yield with_json("limits", path, "--vary", wanted)
        yield with_json("size", path, "--vary", wanted, "--max-effort", "30")
        yield with_json("hold", path, "--vary", wanted)
        yield with_json("drive", path, "--vary", wanted, "--rows", 5)
        yield Command(["sweep", path, "--vary", "friction=0..2:4", "--vary", f"{wanted}:4"])
        axes = ["--x", "friction=0..2", "--y", wanted, "--size", "12x12", "--output", "map.json"]
        for colour in ["solutions", "modes", "margin", "jam", "hold"]:
            yield Command(["map", path, *axes, "--colour-by", colour], folder=f"{path} {name} {colour}")


def of_refused_model(path):
    yield with_json("check", path)
    yield with_json("solve", path)
    yield with_json("hold", path)


# Raw problems

def raw_problems():
    good = files(f"{TESTS}/raw/good/*.json", "docs/src/examples/*.json")
    made = [with_json("modes", path, *options) for path in good
            for options in [[], ["--uniqueness"], ["--count-only"], ["--any"]]]
    made += [Command(["modes", path, "--stream"]) for path in good]
    return made + [with_json("modes", path) for path in files(f"{TESTS}/raw/bad/*", f"{TESTS}/raw/npz/*.npz")]


def random_problems():
    """Random problems of the campaigns, those of one kind in one command."""
    made = []
    for kind, name in enumerate(raw_generate.KINDS):
        numbers = range(kind, kind + len(raw_generate.KINDS) * PER_KIND, len(raw_generate.KINDS))
        for first in range(0, PER_KIND, PER_COMMAND):
            problems = [raw_generate.problem("corpus", number)[1] for number in numbers[first:first + PER_COMMAND]]
            lines = "".join(json.dumps(problem) + "\n" for problem in problems)
            made.append(Command(["modes", "--json-lines", "--uniqueness"], lines, f"{name} from {first}"))
    return made


# The book and the program itself

def book():
    """The commands of each page, in their order in one folder; those with a report as JSON."""
    made = []
    for page in files("README.md", "docs/src/*.md"):
        for line in re.findall(r"^\$ slideway (.*)$", (ROOT / page).read_text(), re.M):
            words = shlex.split(line)
            has_json = words[0] in WITH_JSON and not {"--format", "--output", "-o", "--help"} & set(words)
            made.append(Command([*words, "--format", "json"] if has_json else words, folder=str(page)))
    return made


def of_the_program():
    made = [Command(["models"]), Command(["schema"]), Command(["questions"]), Command(["new", "--list"]), Command(["nonsense"])]
    made += [Command(["new", path.stem, "--output", "-"]) for path in files("crates/slideway/templates/*.toml")]
    made += [Command(["models", path.stem]) for path in files("models/*.toml")]
    return made + [Command(["import", path]) for path in files("docs/src/examples/*.dxf")]
