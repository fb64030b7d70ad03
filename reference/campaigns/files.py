#!/usr/bin/env python3
"""Attacks on the files of slideway: nothing is lost, nothing is followed.

Every attack prepares a folder and, beside it, files that no command may touch; runs one command; and compares all that
is there afterwards, byte for byte, with what was there before. It expects exit codes, names that may appear or
change, and that neither the terminal nor a table is given invisible characters.

    python3 reference/campaigns/files.py [--seed N] [--only TEXT] [--failures FILE]

Python's standard library only. The program is target/debug/slideway, or what SLIDEWAY names. Attacks with a full or
read-only disk need a file system of their own, which only root can mount; otherwise they are skipped, and the last
line says so.
"""
import argparse
import json
import os
import random
import resource
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unicodedata
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SLIDEWAY = os.environ.get("SLIDEWAY", str(ROOT / "target/debug/slideway"))
MODEL = (ROOT / "models/drawer.toml").read_bytes()
MOTION = (ROOT / "models/frictional-oscillator.toml").read_bytes()
DRAWING = (ROOT / "docs/src/examples/bracket.dxf").read_bytes()
LCP = json.dumps({"type": "lcp", "M": [[2, 1], [1, 2]], "q": [-1, -1]}).encode()
MCP = json.dumps({"type": "mcp", "M": [[2]], "q": [-1], "l": [-3], "u": [3]}).encode()
INPUTS = {"m.toml": MODEL, "o.toml": MOTION, "d.dxf": DRAWING, "p.json": LCP, "b.json": MCP}
VICTIM = b"this belongs to someone else\n"
SWEEP = "sweep m.toml --vary mu=0..1:5"
# Long enough that a sweep of an optimised program can be interrupted.
LONG = "sweep m.toml --vary mu=0..1:200001 --no-breakpoints"
# Unicode's Default_Ignorable_Code_Point where its general category does not say it.
FILLERS = "\u115f\u1160\u3164\uffa0\u034f\u17b4\u17b5"


def is_hidden(character):
    return character not in "\n\t" and (
        unicodedata.category(character) in ("Cc", "Cf", "Zl", "Zp") or character in FILLERS)


def tree(folder):
    """Name -> what is there, for everything below a folder."""
    found = {}
    for at, folders, files in os.walk(folder):
        for name in folders + files:
            path = Path(at, name)
            kind = path.lstat().st_mode
            if stat.S_ISLNK(kind):
                found[str(path.relative_to(folder))] = ("link", os.readlink(path))
            elif stat.S_ISREG(kind):
                found[str(path.relative_to(folder))] = ("file", path.read_bytes())
            else:
                found[str(path.relative_to(folder))] = ("other", stat.S_IFMT(kind))
    return found


class Campaign:
    def __init__(self, options):
        self.random = random.Random(options.seed)
        self.only = options.only
        self.attacks, self.failures, self.skipped = 0, [], []
        self.top = Path(tempfile.mkdtemp(prefix="slideway-files-"))

    def folder(self, files=INPUTS, at=None):
        """A folder for one attack, `work`, beside `outside`, which no command may touch."""
        base = Path(tempfile.mkdtemp(dir=at or self.top))
        (base / "work").mkdir()
        (base / "outside").mkdir()
        (base / "outside/victim").write_bytes(VICTIM)
        for name, content in files.items():
            path = base / "work" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return base

    def run(self, base, words, **streams):
        words = words.split(" ") if isinstance(words, str) else words
        streams.setdefault("stdin", subprocess.DEVNULL)
        streams.setdefault("stdout", subprocess.PIPE)
        # A busy machine makes a command slow, but takes none of its processor time.
        limited = {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_CPU, (20, 20)), "timeout": 600}
        try:
            done = subprocess.run([SLIDEWAY, *words], cwd=base / "work", stderr=subprocess.PIPE, **limited, **streams)
        except subprocess.TimeoutExpired:
            return "hangs", b"", b""
        return done.returncode, done.stdout or b"", done.stderr

    def attack(self, name, base, words, codes, may_change=(), may_vanish=(), check=None, **streams):
        """Runs a command; `codes` are the exit codes that it may have, `may_change` names in `work` that may appear or
        change if it is not 2, `may_vanish` those that may be removed. `check(base, code)` says what else is wrong."""
        if self.only not in name:
            shutil.rmtree(base, ignore_errors=True)
            return
        self.attacks += 1
        before = tree(base)
        code, out, err = self.run(base, words, **streams)
        after = tree(base)
        wrong = []
        if code not in codes:
            wrong.append(f"exit code {code} instead of {codes}")
        if b"panicked" in err:
            wrong.append("a panic")
        for text in (out, err):
            hidden = {f"U+{ord(c):04X}" for c in text.decode(errors="replace") if is_hidden(c)}
            if hidden:
                wrong.append(f"raw {sorted(hidden)}")
        allowed = {os.path.normpath(f"work/{other}") for other in may_change} if code != 2 else set()
        vanishing = {f"work/{other}" for other in may_vanish}
        for path in sorted(before.keys() | after.keys()):
            if before.get(path) == after.get(path) or path in allowed:
                continue
            if path in vanishing and path not in after:
                continue
            happened = "is new" if path not in before else "is gone" if path not in after else "has changed"
            wrong.append(f"{path} {happened}")
        if check and not wrong:
            wrong += check(base, code) or []
        if wrong:
            told = words if isinstance(words, str) else " ".join(map(repr, words))
            text = f"{name}: slideway {told}\n  " + "\n  ".join(wrong) + f"\n  {err.decode(errors='replace').strip()}"
            print(text)
            self.failures.append(text)
        shutil.rmtree(base, ignore_errors=True)

    # Inputs and outputs of one command

    def over_inputs(self):
        """Each output of each command at its input, by every kind of name: refused, with --force, too."""
        for words, source in [
            ("solve IN -o OUT", "m.toml"), ("solve IN --proof OUT", "m.toml"), ("check IN -o OUT", "m.toml"),
            ("hold IN -o OUT", "m.toml"), ("drive IN -o OUT", "m.toml"), ("report IN -o OUT", "m.html"),
            ("size IN --vary mu --margin 1.5 -o OUT", "m.toml"), ("limits IN --vary mu=0..1 -o OUT", "m.toml"),
            ("limits IN --vary mu=0..1 --plot OUT", "m.svg"), ("drive IN --vary mu=0..1 --plot OUT", "m.svg"),
            ("map IN --x mu=0..1 --y a=0..1m --size 4x4 -o OUT", "m.svg"), ("draw IN -o OUT", "m.png"),
            (SWEEP.replace("m.toml", "IN") + " -o OUT", "m.csv"),
            (SWEEP.replace("m.toml", "IN") + " -o OUT", "m.npz"),
            (SWEEP.replace("m.toml", "IN") + " -o t.csv --plot OUT", "m.svg"),
            ("simulate IN --until 0.1s -o OUT", "o.csv"), ("simulate IN --until 0.1s --plot OUT", "o.svg"),
            ("simulate IN --until 0.1s --animate OUT", "o.gif"), ("modes IN -o OUT", "p.json"),
            ("modes IN --proof OUT", "p.json"), ("modes IN --proof OUT", "b.json"), ("import IN -o OUT", "d.dxf"),
        ]:
            for alias in ["same", "dotted", "absolute", "link", "link of link", "hard link", "folder link"]:
                content = INPUTS.get(Path(source).with_suffix(".toml").name, INPUTS.get(source))
                base = self.folder({source: content})
                out = self.alias(base, source, alias)
                told = [{"IN": source, "OUT": out}.get(word, word) for word in words.split(" ")] + ["--force"]
                self.attack(f"over input, {alias}", base, told, [2])
        # Where the checker of proofs does not read the problem, FILE.json has an equivalent one.
        for words, source in [("solve IN --proof x", "m.toml"), ("modes IN --proof x", "b.json")]:
            for alias in ["same", "link", "hard link"]:
                base = self.folder({"x.json": INPUTS[source]})
                given = "x.json" if alias == "same" else self.alias(base, "x.json", alias)
                told = words.replace("IN", given)
                self.attack(f"over input by FILE.json, {alias}", base, told + " --force", [2])
        for ending in [".partial", ".partial.state", ".partial.state.new", ".partial.converted"]:
            base = self.folder({"t.csv" + ending: MODEL})
            self.attack("input at a temporary name", base, f"sweep t.csv{ending} --vary mu=0..1:5 -o ./t.csv --force", [2])
        self.over_streams()

    def over_streams(self):
        base = self.folder()
        with open(base / "work/m.toml", "rb") as source:
            self.attack("over standard input", base, "solve - -o m.toml --force", [2], stdin=source)
        for words, source in [("solve m.toml", "m.toml"), ("import d.dxf", "d.dxf"), ("modes p.json", "p.json"),
                              ("modes p.json --stream", "p.json"), ("modes p.json --json-lines", "p.json"),
                              ("simulate o.toml --until 0.1s", "o.toml"), (SWEEP, "m.toml")]:
            base = self.folder()
            with open(base / "work" / source, "ab") as target:
                self.attack("appended to the input", base, words, [2], stdout=target)

    def alias(self, base, name, alias):
        """Another name of a file in `work`."""
        work = base / "work"
        if alias == "same":
            return name
        if alias == "dotted":
            return f"../work/./{name}"
        if alias == "absolute":
            return str(work / name)
        other = f"other{Path(name).suffix}"
        if alias == "folder link":
            (work / "here").symlink_to(".")
            return f"here/{name}"
        if alias == "hard link":
            os.link(work / name, work / other)
        elif alias == "link of link":
            (work / "between").symlink_to(name)
            (work / other).symlink_to("between")
        else:
            (work / other).symlink_to(name)
        return other

    def two_outputs(self):
        """Two outputs of one command at one file, which exists or not: refused, with --force, too."""
        for words, first in [
            ("solve m.toml -o ONE --proof TWO", "x.txt"), ("solve m.toml --proof TWO -o ONE", "x.json"),
            ("modes p.json -o ONE --proof TWO", "x.json"), ("modes b.json -o ONE --proof TWO", "x.json"),
            ("limits m.toml --vary mu=0..1 -o ONE --plot TWO", "x.svg"),
            ("drive m.toml --vary mu=0..1 -o ONE --plot TWO", "x.svg"),
            ("size m.toml --vary mu --margin 1.5 -o ONE --plot TWO", "x.svg"),
            ("simulate o.toml --until 0.1s --plot ONE --animate TWO", "x.svg"),
            (SWEEP + " --format csv -o ONE --plot TWO", "x.svg"),
        ]:
            for alias in ["same", "dotted", "absolute", "link", "hard link", "folder link"]:
                base = self.folder()
                if alias == "hard link":
                    (base / "work" / first).write_bytes(VICTIM)
                second = self.alias(base, first, alias)
                told = words.replace("ONE", first).replace("TWO", second)
                self.attack(f"two outputs, {alias}", base, told + " --force", [2])
        for words in ["solve m.toml -o x.json --proof x", "modes b.json -o ./x.json --proof x",
                      SWEEP + " -o t.csv --plot t.csv.partial.svg", SWEEP + " -o t.npz --plot t.npz.partial.state.png",
                      "simulate o.toml --until 0.1s -o t.csv --plot t.csv.partial.svg"]:
            self.attack("two outputs by FILE.json or FILE.partial", self.folder(), words + " --force", [2])
        for words in ["limits m.toml --vary mu=0..1 --plot x.svg", "solve m.toml --proof x.svg"]:
            base = self.folder()
            with open(base / "work/x.svg", "wb") as target:
                self.attack("two outputs, one on standard output", base, words + " --force", [2], stdout=target)

    # Links and other things at the names of temporary files

    def planted(self):
        reference = {}
        for format in ["csv", "npz"]:
            base = self.folder()
            self.run(base, f"{SWEEP} -o t.{format}")
            reference[format] = (base / f"work/t.{format}").read_bytes()
            shutil.rmtree(base)
        for format in reference:
            for ending in [".partial", ".partial.state", ".partial.state.new", ".partial.converted"]:
                for kind in ["link", "dangling", "hard link", "folder", "pipe", "link to folder"]:
                    for option in ["", " --force", " --resume"]:
                        base = self.folder()
                        name = f"t.{format}{ending}"
                        self.plant(base, name, kind)
                        target = f"t.{format}"
                        expected = reference[format]

                        def is_whole(base, code, target=target, expected=expected):
                            path = base / "work" / target
                            if (code == 0) != path.exists():
                                return [f"exit code {code}, and {target} exists: {path.exists()}"]
                            return [] if code or path.read_bytes() == expected else ["another table"]

                        self.attack(f"{kind} at {name}{option}", base, f"{SWEEP} -o {target}{option}", [0, 2],
                                    [target], [name], is_whole)
        for kind in ["link", "dangling", "folder", "hard link"]:
            base = self.folder()
            self.plant(base, "x.txt", kind)
            # A link at the very name of an output is followed, but nothing is overwritten without --force.
            codes, changing = ([0, 1], ["../outside/new"]) if kind == "dangling" else ([2], [])
            self.attack(f"{kind} as output", base, "hold m.toml -o x.txt", codes, changing)

    def plant(self, base, name, kind):
        path = base / "work" / name
        if kind == "link":
            path.symlink_to("../outside/victim")
        elif kind == "dangling":
            path.symlink_to("../outside/new")
        elif kind == "hard link":
            os.link(base / "outside/victim", path)
        elif kind == "folder":
            path.mkdir()
        elif kind == "pipe":
            os.mkfifo(path)
        else:
            path.symlink_to("../outside")

    # Sweeps that were killed, and whose partial files were altered

    def altered(self):
        """After a kill and an alteration a sweep is continued into the whole table, or refused: never anything else."""
        for format in ["csv", "npz"]:
            base = self.folder()
            self.run(base, f"{LONG} -o t.{format}")
            expected = (base / f"work/t.{format}").read_bytes()
            shutil.rmtree(base)
            for number in range(30):
                base = self.killed(format, number)
                what = self.alter(base / f"work/t.{format}.partial", number)
                partial = [f"t.{format}.partial", f"t.{format}.partial.state"]

                def is_whole(base, code, target=f"t.{format}", expected=expected, what=what):
                    path = base / "work" / target
                    if code == 2 and what == "nothing":
                        return ["an unchanged partial file is refused"]
                    if (code == 0) != path.exists():
                        return [f"exit code {code}, and {target} exists: {path.exists()}"]
                    return [] if code or path.read_bytes() == expected else ["another table"]

                name = f"killed sweep, {format}, {what}"
                self.attack(name, base, f"{LONG} -o t.{format} --resume", [0, 2], [f"t.{format}", *partial],
                            [*partial, f"t.{format}.partial.state.new"], is_whole)

    def killed(self, format, number):
        """A folder with what an ended sweep leaves: killed at any time, or interrupted, and then it keeps all it has."""
        for wait in (0.02 * 1.3**step for step in range(20)):
            base = self.folder()
            words = [SLIDEWAY, *LONG.split(" "), "-o", f"t.{format}"]
            with subprocess.Popen(words, cwd=base / "work", stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  stdin=subprocess.DEVNULL) as child:
                time.sleep(wait * (0.5 + self.random.random()))
                child.send_signal(signal.SIGINT if number % 2 else signal.SIGKILL)
            work = base / "work"
            if (work / f"t.{format}.partial.state").exists() and (work / f"t.{format}.partial").stat().st_size:
                return base
            shutil.rmtree(base)
        raise RuntimeError("no sweep could be interrupted")

    def alter(self, partial, number):
        state = Path(str(partial) + ".state")
        kind = ["nothing", "cut", "longer", "byte", "emptied", "state cut", "state byte", "state gone", "head"][number % 9]
        content = partial.read_bytes()
        at = self.random.randrange(len(content))
        if kind == "cut":
            partial.write_bytes(content[:at])
        elif kind == "longer":
            partial.write_bytes(content + self.random.randbytes(1 + number))
        elif kind in ("byte", "head"):
            at = at % 40 if kind == "head" else at
            partial.write_bytes(content[:at] + bytes([content[at] ^ 1 << self.random.randrange(8)]) + content[at + 1:])
        elif kind == "emptied":
            partial.write_bytes(b"")
        elif kind == "state gone":
            state.unlink()
        elif kind.startswith("state"):
            text = state.read_bytes()
            at = self.random.randrange(len(text))
            state.write_bytes(text[:at] if kind == "state cut" else text[:at] + bytes([text[at] ^ 1]) + text[at + 1:])
        return kind

    # Full and read-only disks

    WRITERS = [
        ("hold m.toml -o FILE", "x.txt"), ("solve m.toml -o FILE", "x.txt"), ("solve m.toml --format json -o FILE", "x.json"),
        ("check m.toml -o FILE", "x.txt"), ("report m.toml -o FILE", "x.html"), ("draw m.toml -o FILE", "x.svg"),
        ("draw m.toml -o FILE", "x.png"), ("limits m.toml --vary mu=0..1 --plot FILE", "x.svg"),
        ("map m.toml --x mu=0..1 --y a=0..1m --size 4x4 -o FILE", "x.svg"), (SWEEP + " -o FILE", "x.csv"),
        (SWEEP + " -o FILE", "x.npz"), ("simulate o.toml --until 0.1s -o FILE", "x.csv"),
        ("simulate o.toml --until 0.1s --animate FILE", "x.html"), ("modes p.json -o FILE", "x.json"),
        ("modes p.json --proof FILE", "x"), ("modes b.json --proof FILE", "x"), ("import d.dxf -o FILE", "x.toml"),
        ("models drawer -o FILE", "x.toml"), ("new drawer -o FILE", "x.toml"),
    ]

    def disks(self):
        if os.geteuid() != 0:
            self.skipped.append("full and read-only disks, which only root can mount")
            return
        mount = self.top / "disk"
        mount.mkdir()
        if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "none", mount], stderr=subprocess.DEVNULL).returncode:
            self.skipped.append("full and read-only disks: no file system can be mounted here")
            return
        try:
            for words, name in self.WRITERS:
                for free in [0, 4096, 8192]:
                    self.on_a_full_disk(mount, words, name, free)
            self.emptied(mount)
            subprocess.run(["mount", "-o", "remount,ro", mount], check=True)
            for words, name in self.WRITERS:
                base = self.folder()
                self.attack("read-only disk", base, words.replace("FILE", f"{mount}/{name}"), [2],
                            check=lambda *_: self.rest_of(mount))
        finally:
            subprocess.run(["umount", mount], check=False)

    @staticmethod
    def emptied(mount):
        for path in mount.iterdir():
            path.unlink()

    @staticmethod
    def rest_of(mount):
        return [f"{path.name} is left on the disk" for path in mount.iterdir() if path.name != "filling"]

    def on_a_full_disk(self, mount, words, name, free):
        """What is written is whole or not there; an old file stays what it was."""
        self.emptied(mount)
        is_old = self.random.random() < 0.5
        if is_old:
            (mount / name).write_bytes(VICTIM)
            free = max(free - 4096, 0)
        with open(mount / "filling", "wb") as filling:
            size = os.statvfs(mount)
            filling.write(b"0" * max(size.f_bavail * size.f_bsize - free, 0))

        def is_whole_or_not_there(_, code):
            wrong = []
            for path in mount.iterdir():
                # The rows of a sweep are kept, to be continued.
                kept = ".partial" in path.name and "sweep" in words
                if path.name.startswith(name) and not kept and path.name != "filling":
                    is_same = path.read_bytes() == VICTIM
                    if path.name == name and is_old and is_same:
                        continue
                    if code == 2 and not path.name == f"{name}.json" or not path.stat().st_size:
                        wrong.append(f"{path.name} is left with {path.stat().st_size} bytes, exit code {code}")
                elif path.name != "filling" and not kept:
                    wrong.append(f"{path.name} is left on the disk")
            return wrong

        told = words.replace("FILE", f"{mount}/{name}") + (" --force" if is_old else "")
        self.attack(f"full disk, {free} bytes free", self.folder(), told, [0, 1, 2], check=is_whole_or_not_there)

    def devices(self):
        """Nothing that cannot be written is said to be done."""
        if not os.path.exists("/dev/full"):
            self.skipped.append("/dev/full, which is not there")
            return
        for words in ["--version", "--help", "-h", "help", "help questions", "help solve", "questions", "schema", "models",
                      "models drawer", "completions bash", "solve m.toml", "solve --help", "check m.toml", "hold m.toml",
                      "limits m.toml --vary mu=0..1", "drive m.toml", "draw m.toml", SWEEP, "modes p.json",
                      "modes p.json --stream", "modes p.json --json-lines", "modes p.json --format npz", "import d.dxf",
                      "simulate o.toml --until 0.1s", "new --list", "new drawer --help", "new drawer -o -",
                      "size m.toml --vary mu --margin 1.5"]:
            with open("/dev/full", "wb") as full:
                self.attack("standard output is full", self.folder(), words, [2], stdout=full)
        for words, name in self.WRITERS:
            if name.endswith((".txt", ".json", ".html")) and "animate" not in words:
                told = words.replace("FILE", "/dev/full")
                self.attack("output is /dev/full", self.folder(), told if "report" not in told else "report m.toml", [2, 0])
        for words in ["solve m.toml", "nonsense", "solve none.toml"]:
            self.attack("standard error is closed", self.folder(), words, [0, 2])

    # Names, and folders that are none

    def names(self):
        evil = ["q\x1b]0;x\x07", "a\nb", "c\x9b2J", "d\u202egnp", "e\u3164", "f\u115f\u1160\uffa0", "g\u200b", "h\x7f\r"]
        for name in evil:
            for words, source, ending in [
                ("solve IN", "m.toml", ".toml"), ("solve m.toml --proof OUT", None, ""), ("modes IN --proof OUT", "p.json", ".json"),
                ("modes b.json --proof OUT", None, ""), ("hold m.toml -o OUT", None, ".txt"), (SWEEP + " -o OUT", None, ".csv"),
                ("hold m.toml -o none/OUT", None, ".txt"), ("import IN", "d.dxf", ".dxf"), ("report IN", "m.toml", ".toml"),
                ("new drawer -o OUT", None, ".toml"), ("solve OUT", None, ".toml"), ("modes OUT", None, ".json"),
                ("simulate o.toml --until 0.1s -o OUT", None, ".csv"), ("models OUT", None, ""), ("OUT", None, ""),
                ("hold m.toml --OUT", None, ""), ("sweep IN --vary mu=0..1:3", "m.toml", ".toml"),
            ]:
                base = self.folder()
                if source:
                    (base / "work" / (name + ending)).write_bytes(INPUTS[source])
                given, out = name + ending, (name + ".out" if "IN" in words else name + ending)
                told = [word.replace("IN", given).replace("OUT", out) for word in words.split(" ")]
                self.attack(f"name {ascii(name)}", base, told, [0, 1, 2], [out, out + ".json"])
            model = MODEL.replace(b"mu", ("mu" + name.split("\x1b")[0].split("\n")[0]).encode())
            base = self.folder({"m.toml": model})
            self.attack(f"name in a model {ascii(name)}", base, SWEEP.replace("mu=", f"mu{name}="), [0, 2])
            drawing = DRAWING.replace(b"bracket", name.replace("\n", "").replace("\r", "").encode())
            self.attack(f"name of a layer {ascii(name)}", self.folder({"d.dxf": drawing}), "import d.dxf", [0, 2])

    def places(self):
        for words, name in self.WRITERS:
            for place in ["none/", "m.toml/"]:
                told = words.replace("FILE", place + name)
                self.attack("no such folder", self.folder(), told, [2])
            base = self.folder()
            (base / "work" / name).mkdir()
            self.attack("a folder as output", base, words.replace("FILE", name) + " --force", [2])
            base = self.folder()
            (base / "work" / name).write_bytes(VICTIM)
            self.attack("an output that exists", base, words.replace("FILE", name), [2])
        for words in ["man m.toml", "man none/man"]:
            self.attack("no folder for manual pages", self.folder(), words, [2])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="attacks whose names contain this text")
    parser.add_argument("--failures", type=Path, help="file for the failures, in words")
    options = parser.parse_args()
    campaign = Campaign(options)
    try:
        for part in [campaign.over_inputs, campaign.two_outputs, campaign.planted, campaign.altered, campaign.disks,
                     campaign.devices, campaign.names, campaign.places]:
            part()
    finally:
        shutil.rmtree(campaign.top, ignore_errors=True)
    if options.failures and campaign.failures:
        options.failures.write_text("\n\n".join(campaign.failures) + "\n")
    skipped = "".join(f"; skipped: {what}" for what in campaign.skipped)
    print(f"{campaign.attacks} attacks, {len(campaign.failures)} failures, seed {options.seed}{skipped}")
    sys.exit(1 if campaign.failures else 0)


if __name__ == "__main__":
    main()
