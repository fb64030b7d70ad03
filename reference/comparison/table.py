"""The results as Markdown."""


def seconds(value):
    """A time with two digits: "3.2 s", "45 ms", "12 µs"."""
    for factor, unit in ((1, "s"), (1e3, "ms"), (1e6, "µs")):
        if value * factor >= 0.95:
            break
    scaled = value * factor
    return f"{scaled:.2g} {unit}" if scaled < 99.5 else f"{scaled:.0f} {unit}"


def count(text):
    """A number of solutions; large ones as a power of ten."""
    return text if len(text) <= 6 else f"{text[0]}.{text[1]}·10<sup>{len(text) - 1}</sup>"


def rows(header, lines):
    """A Markdown table."""
    marks = ["---"] + ["---:"] * (len(header) - 1)
    return "\n".join("| " + " | ".join(line) + " |" for line in [header, marks, *lines])


def all_solutions(results):
    """Times to all solutions."""
    header = ["instance", "solutions", "search", "HiGHS", "lcp_enum", "LU, compiled", "LU, NumPy"]
    return rows(header, [_line(result) for result in results])


def _line(result):
    own = result["slideway"]
    search = own["search"]
    partial = "" if search["complete"] else " or more"
    tried = [_every(result.get(code)) for code in ("lcp_enum", "lu_lapack", "lu_numpy")]
    name = f"{result['family']} {result['size']}"
    return [name, count(search["count"]) + partial, _search(search), _highs(result["highs"]), *tried]


def by_cells(results):
    """Times of instances with continua, of monotone ones and of chains."""
    header = ["instance", "cells", "nodes", "search", "HiGHS, first solution", "HiGHS, all patterns", "lcp_enum"]
    return rows(header, [_cells_line(result) for result in results])


def _cells_line(result):
    search, highs = result["slideway"]["search"], result["highs"]
    cells = f"{len(search['cells'])}" + ("" if search["complete"] else " or more")
    first = seconds(highs["first_seconds"]) if highs.get("first_seconds") else "–"
    name = f"{result['family']} {result['size']}"
    return [name, cells, f"{search['nodes']}", _search(search), first, _highs(highs), _counted(result)]


def _counted(result):
    """Time of lcp_enum, and how many solutions it counts: one for each pattern that has any."""
    if "lcp_enum" not in result:
        return "–"
    found = result["lcp_enum"]
    return f"{seconds(found['seconds'])} ({found['count']} counted)" if found else "not finished"


def _search(search):
    if not search["complete"]:
        return f"> {seconds(search['seconds'])}"
    return seconds(search["seconds"]) + ("" if search["proven"] else " (not proven)")


def _highs(highs):
    if "seconds" not in highs:
        return "–"
    notes = []
    if highs["outcome"] == "complete":
        text = seconds(highs["seconds"])
    else:
        text = f"> {seconds(highs['seconds'])}"
        notes.append(f"{len(highs['patterns'])} found")
    if highs["bound"] == "propagation":
        notes.append("bounds proven")
    if highs["spurious"]:
        notes.append(f"{highs['spurious']} spurious")
    return f"{text} ({', '.join(notes)})" if notes else text


def _every(code):
    if code is None:
        return "–"
    if code["all"]:
        return seconds(code["seconds"])
    return f"*{seconds(code['all_seconds'])}*"


def per_pattern(results):
    """Nanoseconds for each pattern of the codes that try them all."""
    header = ["instance", "LU, compiled", "lcp_enum", "LU, NumPy"]
    lines = []
    for result in results:
        if "lu_lapack" not in result:
            continue
        measured = []
        for code in ("lu_lapack", "lcp_enum", "lu_numpy"):
            text = f"{1e9 * result[code]['per_pattern']:.0f}"
            measured.append(text if result[code]["all"] else f"*{text}*")
        lines.append([f"{result['family']} {result['size']}", *measured])
    return rows(header, lines)


def largest(steps_of, families, limit):
    """The largest instance of each family within the limit."""
    lines = []
    for name, steps in steps_of.items():
        finished = [step for step in steps if not step["outcome"].startswith("partial")]
        last = finished[-1] if finished else None
        size = f"{last['size']}" if last else "none"
        if last and len(finished) == len(steps):
            size += " (the largest tried)"
        next_one = next((str(step["size"]) for step in steps if step not in finished), "–")
        proven = "–" if not last else ("yes" if last["outcome"] == "complete: proven" else "no")
        time = seconds(last["seconds"]) if last else "–"
        lines.append([f"{name}: {families[name].words}", size, time, proven, next_one])
    return rows(["family", f"largest *n* in {limit:.0f} s", "time", "proven", "not finished"], lines)


def disagreements(results):
    """What codes disagree about, or that they do not."""
    lines = [f"- {result['family']} {result['size']}: {text}" for result in results for text in result["disagreements"]]
    return "\n".join(lines) if lines else "None: wherever two codes finished, they found the same patterns."


def markdown(data, families):
    """The whole page of results."""
    dense = [result for result in data["results"] if not families[result["family"]].by_cells]
    cells = [result for result in data["results"] if families[result["family"]].by_cells]
    machine = "\n".join(f"| {name} | {text} |" for name, text in data["versions"].items())
    quick = " with `--quick`" if data["quick"] else ""
    return f"""<!-- Written by reference/comparison/compare.py{quick}; do not edit. -->

# Tables of the comparison

How long each code took; [Comparison with other codes](../../docs/src/comparison.md) says what is compared, and how.

## The machine

| | |
|---|---|
{machine}
| threads | {data['threads']} |
| load average at the start | {data['load']:.2f} |

## Time to all solutions

Limit of the search and of HiGHS: {data['limit']:.0f} s. *Slanted*: extrapolated. –: not tried.

{all_solutions(dense)}

## Continua, monotone problems and chains

A cell is a largest set of solutions without a change of sign, perhaps a point. HiGHS and lcp_enum meet a cell once for each
pattern that has a part of it; HiGHS' patterns are those found by the limit.

{by_cells(cells)}

## Nanoseconds for each pattern

*Slanted*: measured on a part of the patterns (LU), or extrapolated from a smaller instance (lcp_enum).

{per_pattern(dense)}

## The largest instance

{largest(data['largest'], families, data['ladder_limit'])}

## Disagreements

{disagreements(data['results'])}
"""
