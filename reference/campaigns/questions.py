"""The same point asked in every question: `solve`, `sweep`, `map`, `limits`, `drive`, `hold`, `check`, `simulate`, `report`."""
import csv
import html
import io
import json
import re
from collections import Counter
from functools import partial

from common import run

RESTS = {"rests": {"holds", "holds_until_pushed", "may_hold"}, "rests_or_moves": {"holds_or_slips"}, "neither": {"neither"},
         "moves_on": {"moves", "does_not_hold"}, "moves_back": {"moves", "does_not_hold"}, "moves": {"moves", "does_not_hold"}}


def near(first, second, relative):
    """Whether two lists are equal, relative to the greatest number in them."""
    if len(first) != len(second):
        return False
    scale = max(map(abs, [*first, *second]), default=0.0)
    return all(abs(a - b) <= relative * scale for a, b in zip(first, second))


def in_motion(solution, pattern, names):
    """A pattern of `solve` as `simulate` writes it for these contacts: what has lifted off, or is apart, is open, and what sticks has no side."""
    sticking = {joint["name"] for joint in solution["joints"] if re.search(r"\b(sticks|rolls)\b", joint["mode"])}

    def sign_of(contact, sign):
        if contact.get("gap_acceleration"):
            return "0"
        return "=" if contact["name"].split(".")[0] in sticking else sign

    signs = {contact["name"]: sign_of(contact, sign) for contact, sign in zip(solution["contacts"], pattern)}
    return "".join(signs.get(name, "0") for name in names)


def matched(first, second, relative=1e-7):
    """Whether two lists of lists are the same in some order."""
    rest = list(second)
    for a in first:
        match = next((b for b in rest if near(a, b, relative)), None)
        if match is None:
            return False
        rest.remove(match)
    return not rest


class Asked:
    def __init__(self, file, name, interval, values, settings, rng, rests):
        self.file, self.name, self.interval, self.values, self.settings, self.rng = file, name, interval, values, settings, rng
        self.solved, self.faults = [], []
        self.rests = rests          # whether it can rest, of the factors on friction and loads; None if that is not known

    def setting(self, value):
        return ["--set", f"{self.name}={value!r}"]

    def command(self, question, value=None, *options):
        return [question, self.file, *self.settings, *(self.setting(value) if value is not None else []), *options]

    def fault(self, kind, command, comes, true):
        self.faults.append((kind, command, comes if isinstance(comes, str) else json.dumps(comes)[:6000], true))

    def json(self, command, allowed=(0, 1, 3)):
        """The report, or None where the question is refused; anything else than an error of the model is a fault."""
        code, out, err = run([*command, "--format", "json"] if "--output" not in command else command)
        if code in allowed and "panicked" not in err:
            return json.loads(out) if out.strip() else {}
        if code != 2 or "panicked" in err:
            self.fault(f"{command[0]}: crash", command, f"exit code {code}\n{err[-3000:]}", "an answer")
        return None

    def all(self, total):
        for value in self.values:
            answer = self.json(self.command("solve", value))
            self.solved.append(answer)
            total["points"] += 1
            total["refused"] += answer is None
            if answer:
                self.consistent(value, answer)
        if any(self.solved):
            chosen = self.rng.choice([i for i, a in enumerate(self.solved) if a])
            questions = [self.sweep, self.map, self.limits, lambda: self.hold(chosen, total)]
            questions += [partial(ask, chosen) for ask in (self.check, self.drive, self.simulate, self.margin, self.backwards)]
            if self.rng.random() < 0.2:
                questions.append(partial(self.report, chosen))
            total["comparisons"] += len(questions)
            for question in questions:
                question()
        return self.faults

    def consistent(self, value, answer):
        """What `solve` says of one point, in itself."""
        count, gaps = int(answer["count"]), int(answer["gap_state_count"])
        continua, status = len(answer["continua"]), answer["status"]
        true = ("continuum" if continua else "several" if count > 1 else "one" if count else "preload_gap" if gaps else None)
        if true and status != true or status == "none" and (count or gaps or continua) or len(answer["solutions"]) != count:
            self.fault("solve: status", self.command("solve", value), answer, f"status {true}")
        if answer["complete"] != "proven" and not answer["undecided_modes"] and not answer["open"]:
            self.fault("solve: open", self.command("solve", value), answer, "what is open is said")
        for solution in answer["solutions"] + answer["preload_gap_states"]:
            if solution["residual"] > 1e-9:
                self.fault("solve: residual", self.command("solve", value), solution, "equilibrium of every body")

    def delicate(self, answer):
        """On a boundary, or undecided within rounding: other questions, which do not certify, may say otherwise."""
        listed = answer["solutions"] + answer["preload_gap_states"]
        return bool(answer["undecided_modes"]) or answer["status"] == "unknown" or any(s["on_boundary"] for s in listed)

    def sweep(self):
        values = ",".join(map(repr, self.values))
        command = self.command("sweep", None, "--vary", f"{self.name}={values}", "--no-breakpoints", "--format", "csv")
        code, out, err = run(command)
        if code not in (0, 1, 3) or "panicked" in err:
            self.fault("sweep: crash", command, f"exit code {code}\n{err[-3000:]}", "a table")
            return
        rows = list(csv.DictReader(io.StringIO("".join(line + "\n" for line in out.splitlines() if not line.startswith("#")))))
        for i, answer in enumerate(self.solved):
            mine = [row for row in rows if row["point"] == str(i)]
            if answer is None:
                if mine and mine[0]["status"] in ("one", "several", "none", "continuum"):
                    self.fault("sweep: refused point", command, mine, f"solve refuses {self.name} = {self.values[i]}")
                continue
            self.table(command, mine, answer)

    def table(self, command, rows, answer):
        first = rows[0]
        true = [answer["status"], answer["count"], answer["gap_state_count"], str(len(answer["rejected"]))]
        comes = [first["status"], first["solutions"], first["gap_states"], first["rejected"]]
        if comes != true:
            self.fault("sweep: counts", command, rows, f"solve: {true}")
            return
        for kind, listed in (("solution", answer["solutions"]), ("preload_gap", answer["preload_gap_states"])):
            table = [row for row in rows
                     if row["kind"] == kind or kind == "solution" and row["kind"] == "boundary"]
            forces = [[float(v) for k, v in row.items() if k.startswith(("normal_force.", "effort.")) and v] for row in table]
            expected = [[c["normal_force"] for c in s["contacts"]] + [d["effort"] for d in s["drives"]] for s in listed]
            if len(listed) <= 100 and not matched(expected, forces):
                self.fault(f"sweep: {kind}", command, rows, f"solve: {expected}")

    def map(self):
        low, high = self.interval
        output = self.file.with_name("map.json")
        other = next(iter(self.others()), None)
        if other is None:
            return
        command = self.command("map", None, "--x", f"{self.name}={low!r}..{high!r}", "--y", other, "--size", f"{len(self.values)}x1",
                               "--probe", "1", "--force", "--output", output)
        if self.json(command) is None:
            return
        report = json.loads(output.read_text())
        classes = [c for number, pixels in report["rows"][0] for c in [report["classes"][number]] * pixels]
        for value, answer, found in zip(self.values, self.solved, classes):
            if answer is None or self.delicate(answer):
                continue
            meaning, status = found["meaning"], answer["status"]
            none = "tips" if answer["rejected"] else "locked"
            true = {"continuum": {"kind": "continuum"}, "none": {"kind": none}}.get(status) or {
                "kind": "solutions", "solutions": int(answer["count"]), "preload_gap_states": int(answer["gap_state_count"])}
            if any(meaning.get(k) != v for k, v in true.items()):
                self.fault("map: class", command, report, f"solve at {self.name} = {value!r}: {status}, {true}")
                return

    def others(self):
        """A second quantity whose range has the model's value in the middle."""
        if "\nP = 1.0\n" in self.file.read_text():
            yield "P=0.5..1.5" if self.name == "f" else "f=0.5..1.5"

    def limits(self):
        low, high = self.interval
        command = self.command("limits", None, "--vary", f"{self.name}={low!r}..{high!r}")
        report = self.json(command)
        if not report:
            return
        for value, answer in zip(self.values, self.solved):
            if answer is None or self.delicate(answer):
                continue
            inside = [p for p in report["counts"] if p["from"] + 1e-3 * (high - low) < value < p["to"] - 1e-3 * (high - low)]
            if not inside:
                continue
            piece, at = inside[0], f"solve at {self.name} = {value!r}"
            if answer["status"] == "continuum":
                words = " ".join(report["conclusion"])
                if piece["solutions"] == 0 and "nfinite" not in words and "continu" not in words:
                    self.fault("limits: continuum", command, report, f"{at}: infinitely many solutions")
                    return
                continue
            true = [int(answer["count"]), int(answer["gap_state_count"])]
            if piece["solutions"] is not None and [piece["solutions"], piece["preload_gap_states"]] != true:
                self.fault("limits: counts", command, report, f"{at}: {true}")
                return
            if "starts" in piece:       # contacts at rest: their ways to start are told in words, as many as counted
                if len(piece["starts"]) != true[0]:
                    self.fault("limits: starts", command, report, f"{at}: {true}")
                    return
                continue
            margin = 1e-3 * (high - low)
            modes = {m["pattern"] for m in report["modes"] if m["from"] + margin < value < m["to"] - margin}
            edge = {m["pattern"] for m in report["modes"] if abs(m["from"] - value) <= margin or abs(m["to"] - value) <= margin}
            listed = {s["pattern"] for s in answer["solutions"] + answer["preload_gap_states"]}
            if modes - edge != listed - edge:
                self.fault("limits: modes", command, report, f"{at}: {sorted(listed)}")
                return

    def check(self, i):
        command = self.command("check", self.values[i])
        report, answer = self.json(command), self.solved[i]
        if not report:
            return
        degrees = report["mobility"]["degrees_of_freedom"]
        if not report["sound"] or degrees != answer["model"]["degrees_of_freedom"]:
            self.fault("check: soundness", command, report,
                       f"solve answers, with {answer['model']['degrees_of_freedom']} degrees of freedom")
        if answer["solutions"]:
            speeds = [c["sliding_velocity"] for c in answer["solutions"][0]["contacts"]]
            if not near(speeds, [c["sliding_velocity"] for c in report["contacts"]], 1e-12):
                self.fault("check: speeds", command, report, f"solve: {speeds}")

    def drive(self, i):
        answer = self.solved[i]
        if not answer["model"]["drives"]:
            return
        command = self.command("drive", self.values[i])
        report = self.json(command)
        if not report:
            return
        mine = next((d for d in report["directions"] if d["direction"] == "model"), None)
        if mine is None or self.delicate(answer):
            return
        listed = answer["solutions"] + answer["preload_gap_states"]
        if mine["status"] != answer["status"]:
            self.fault("drive: status", command, report, f"solve: {answer['status']}")
        elif not matched([[d["effort"] for d in s["drives"]] for s in listed], [s["efforts"] for s in mine["solutions"]]):
            self.fault("drive: efforts", command, report, f"solve: {[s['drives'] for s in listed]}")
        elif Counter(s["pattern"] for s in listed) != Counter(s["pattern"] for s in mine["solutions"]):
            self.fault("drive: modes", command, report, f"solve: {[s['pattern'] for s in listed]}")

    def backwards(self, i):
        """The opposite direction of `drive` is `solve` with opposite rates."""
        answer, command = self.solved[i], self.command("drive", self.values[i])
        if not answer["model"]["drives"]:
            return
        report = self.json(command)
        rates = [option for c in answer["state"] for option in ("--rate", f"{c['name']}={-c['rate']!r}")]
        other = self.json(self.command("solve", self.values[i], *rates))
        mine = next((d for d in (report or {}).get("directions", []) if d["direction"] == "reversed"), None)
        if mine is None or not other or self.delicate(other):
            return
        efforts = [[d["effort"] for d in s["drives"]] for s in other["solutions"] + other["preload_gap_states"]]
        if mine["status"] != other["status"] or not matched(efforts, [s["efforts"] for s in mine["solutions"]]):
            self.fault("drive: backwards", command, report, f"solve {' '.join(rates)}: {other['status']}, {efforts}")

    def margin(self, i):
        """Where another number of solutions begins, as all friction grows, `solve` finds another number."""
        answer = self.solved[i]
        factor = (answer.get("margins") or {}).get("another_count")
        if self.name != "f" or not factor or factor > 30 or self.delicate(answer):
            return
        counts = []
        for near_it in (1 - 1e-4, 1 + 1e-4):
            other = self.json(self.command("solve", self.values[i] * factor * near_it))
            if not other or self.delicate(other):
                return
            counts.append([other["count"], other["gap_state_count"], bool(other["continua"]), len(other["rejected"])])
        if counts[0][:3] != [answer["count"], answer["gap_state_count"], bool(answer["continua"])] or counts[1] == counts[0]:
            self.fault("solve: margin", self.command("solve", self.values[i]), answer,
                       f"solutions, gap states, continua, rejected before and after: {counts}")

    def hold(self, i, total):
        answer, command = self.solved[i], self.command("hold", self.values[i])
        report = self.json(command)
        said = RESTS.get(answer.get("from_rest"))
        if report and said and report["verdict"] not in said:
            self.fault("hold: verdict", command, report, f"solve: from_rest {answer['from_rest']}")
        if not report or self.rests is None or report["verdict"] in ("may_hold", "does_not_hold"):
            return
        rests = self.rests(*((self.values[i], 1.0) if self.name == "f" else (1.0, self.values[i])))
        total["rest"] += rests is not None
        if rests is not None and rests != report["holds"]:
            self.fault("hold: rest", command, report, f"by linear programs it {'can' if rests else 'cannot'} rest")

    def simulate(self, i):
        """The first event of a motion has the modes of `solve`, and its first instant the acceleration."""
        step, answer = 1e-6, self.solved[i]
        command = self.command("simulate", self.values[i], "--until", f"{step!r} s", "--step", f"{step!r} s")
        report = self.json(command)
        if not report or self.delicate(answer) or answer["status"] in ("continuum", "unknown"):
            return
        listed = answer["solutions"] + answer["preload_gap_states"]
        if not listed:
            causes = [cause["kind"] for event in report["events"] for cause in event["causes"]]
            if report["end"]["kind"] == "finished" and "jams" not in causes and answer["status"] == "none":
                self.fault("simulate: goes on", command, report, f"solve: {answer['status']}")
            return
        # Where no joint has friction nothing begins: the first phase has the mode.
        first = report["events"][0] if report["events"] else {"causes": [], "branches": [], **report["phases"][0]}
        if any(cause["kind"] == "jams" for cause in first["causes"]):
            self.fault("simulate: no start", command, report, f"solve: {answer['status']}")
            return
        names = report["contacts"]
        contacts = len(names)          # behind them the mode has the directions in which rough hinges turn
        modes = [b["mode"][:contacts] for b in first["branches"]] or [first["mode"][:contacts]]
        allowed = {in_motion(s, p, names) for s in listed for p in s["patterns"]}
        told = Counter(in_motion(s, s["pattern"], names) for s in listed)
        if len(first["branches"]) > 1 and Counter(modes) != told or not set(modes) <= allowed:
            self.fault("simulate: modes", command, report, f"solve: {[s['pattern'] for s in listed]}")
            return
        if report["stop"] == report["until"] and len(report["events"]) <= 1:
            rates = [(b["rate"] - a["rate"]) / step for a, b in zip(report["initial"], report["last"])]
            taken = next((b["mode"] for b in first["branches"] if b["taken"]), first["mode"])[:contacts]
            true = [c["acceleration"] for s in listed if taken in {in_motion(s, p, names) for p in s["patterns"]} for c in s["coordinates"]]
            # The motion is as exact as its tolerance, over a short step.
            room = report["tolerance"] / step * max(map(abs, [*true, *(a["rate"] for a in report["initial"])]), default=0.0)
            if len(true) == len(rates) and any(abs(a - b) > room for a, b in zip(rates, true)):
                self.fault("simulate: acceleration", command, report, f"solve: {true}, motion: {rates}")

    def report(self, i):
        answer, output = self.solved[i], self.file.with_name("page.html")
        command = self.command("report", self.values[i], "--force", "--output", output)
        if self.json(command) is None:
            return
        page = output.read_text()
        shown = re.search('class="answer"><strong>(.*?)</strong>', page, re.DOTALL)
        said = " ".join(html.unescape(shown[1]).split()) if shown else ""
        if not said or not " ".join(answer["answer"].split()).startswith(said):
            self.fault("report: words", command, said, f"solve: {answer['answer']}")
        if answer["status"] == "continuum" and "friction locks" in page:
            self.fault("report: locks", command, page[:3000], "infinitely many solutions, no lock")
