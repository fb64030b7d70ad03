"""Measures all codes on all instances; called by compare.py in the environment that it made."""
import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import instances
import rivals
import table

# Every pattern is listed for so many unknowns at most; beyond, no code that tries them all is run.
MOST_TRIED = 24
# HiGHS is not tried where there are more solutions than this: it needs one cut and one run for each.
MOST_CUTS = 1000
# lcp_enum lists its solutions for so many unknowns at most.
MOST_LISTED = 16


def log(text):
    """Tells how far the run is."""
    print(f"{time.strftime('%H:%M:%S')}  {text}", file=sys.stderr, flush=True)


class Run:
    """One run: where things are, and how long they may take."""

    def __init__(self, arguments):
        self.folder = arguments.folder
        self.program = str(arguments.slideway)
        self.limit = arguments.limit
        self.pattern_limit = arguments.pattern_limit
        self.threads = str(arguments.threads)
        self.environment = os.environ | {"RAYON_NUM_THREADS": self.threads, "OPENBLAS_NUM_THREADS": self.threads}
        self.slow_families = set()
        # Seconds per pattern and size of lcp_enum and LU, for extrapolation.
        self.last = None

    def measure(self, instance):
        """All codes on one instance."""
        log(instance.name)
        path = instance.save(self.folder)
        result = {"family": instance.family, "size": instance.size}
        own = rivals.slideway(self.program, path, self.limit, MOST_CUTS, self.environment)
        result["slideway"] = own
        if instance.size <= MOST_TRIED:
            result |= self.every_pattern(instance)
        result["highs"] = self.mixed_integer(instance, own)
        result["disagreements"] = disagreements(result)
        return result

    def measure_cells(self, instance):
        """The codes that do not need regular matrices, on an instance whose solutions patterns do not tell apart."""
        log(instance.name)
        path = instance.save(self.folder)
        own = rivals.slideway(self.program, path, self.limit, MOST_CUTS, self.environment)
        result = {"family": instance.family, "size": instance.size, "slideway": own}
        if instance.size <= MOST_TRIED:
            try:
                listed = instance.size <= MOST_LISTED
                program = self.folder / "lcp_enum"
                found = rivals.lcp_enum(program, instance, self.folder, listed, self.environment, self.pattern_limit)
                result["lcp_enum"] = found
            except subprocess.TimeoutExpired:
                result["lcp_enum"] = None
        result["highs"] = self.mixed_integer(instance, own)
        result["disagreements"] = outside_cells(result)
        return result

    def every_pattern(self, instance):
        """The codes that try every pattern, or a part of them from which the time of all is extrapolated."""
        size = instance.size
        sample = 2 ** min(size, 14)
        lapack = rivals.lu_lapack(self.folder / "lu_patterns", instance, self.folder, sample, self.environment)
        most = 2**size if lapack["per_pattern"] * 2**size <= self.pattern_limit else sample
        if most > sample:
            lapack = rivals.lu_lapack(self.folder / "lu_patterns", instance, self.folder, most, self.environment)
        numpy = rivals.lu_numpy(instance, sample)
        if sample < most and numpy["per_pattern"] * 2**size <= self.pattern_limit:
            numpy = rivals.lu_numpy(instance, most)
        return {"lu_lapack": lapack, "lu_numpy": numpy, "lcp_enum": self.siconos(instance, lapack)}

    def siconos(self, instance, lapack):
        """lcp_enum, or its time extrapolated with the growth of a dgesv from the last size that was run."""
        size = instance.size
        if self.last is not None:
            per_pattern, of_lapack = self.last
            expected = per_pattern * lapack["per_pattern"] / of_lapack
            if expected * 2**size > self.pattern_limit:
                return {"per_pattern": expected, "all": False, "all_seconds": expected * 2**size}
        found = rivals.lcp_enum(self.folder / "lcp_enum", instance, self.folder, size <= 20, self.environment)
        found |= {"per_pattern": found["seconds"] / 2**size, "all": True}
        self.last = found["per_pattern"], lapack["per_pattern"]
        return found

    def mixed_integer(self, instance, own):
        """HiGHS, unless a smaller instance of the family took too long already."""
        if instance.family in self.slow_families:
            return {"outcome": "not tried: a smaller one exceeded the limit"}
        if int(own["search"]["count"]) > MOST_CUTS:
            return {"outcome": "not tried: too many solutions"}
        found = rivals.highs(instance, own["bounds"], self.limit)
        if found["outcome"] != "complete":
            self.slow_families.add(instance.family)
        return found

    def largest(self, name, family, limit):
        """The sizes of a family in order until one takes longer than the limit."""
        steps = []
        for size in family.ladder:
            path = family.make(name, size).save(self.folder)
            own = rivals.slideway(self.program, path, limit, 0, self.environment)
            path.unlink()
            search = own["search"]
            steps.append({"size": size, "seconds": search["seconds"], "outcome": search["outcome"]})
            log(f"largest {name}: {size} in {search['seconds']:.2f} s, {search['outcome']}")
            if not search["complete"]:
                break
        return steps


def disagreements(result):
    """Where the solution sets of two codes differ, in words. Patterns are compared."""
    own = result["slideway"]
    ours = set(own["patterns"])
    search = own["search"]
    if not search["complete"] or len(ours) != int(search["count"]):
        return []
    found = []
    others = {}
    for name in ("lu_lapack", "lu_numpy", "lcp_enum"):
        each = result.get(name)
        if each and each["all"] and "patterns" in each:
            others[name] = each["patterns"]
    if result["highs"]["outcome"] == "complete":
        others["highs"] = result["highs"]["patterns"]
    for name, patterns in others.items():
        missing, additional = ours - set(patterns), set(patterns) - ours
        if missing or additional or len(patterns) != len(set(patterns)):
            found.append(f"{name}: without {sorted(missing)}, with {sorted(additional)}, {len(patterns)} listed")
    if result.get("lcp_enum", {}).get("count", len(ours)) != len(ours):
        found.append(f"lcp_enum counts {result['lcp_enum']['count']}")
    return found


def outside_cells(result):
    """Solutions of other codes that are in none of the search's cells, in words."""
    search = result["slideway"]["search"]
    if not search["complete"] or len(search["cells"]) == MOST_CUTS:
        return []
    found = []
    for name, points in (
        ("lcp_enum", (result.get("lcp_enum") or {}).get("points", [])),
        ("highs", result["highs"].get("points", [])),
    ):
        within = lambda point, cell: all(sign in ("0", of_cell) for sign, of_cell in zip(point, cell))
        outside = [point for point in points if not any(within(point, cell) for cell in search["cells"])]
        if outside:
            found.append(f"{name}: in no cell: {sorted(set(outside))}")
    return found


def parse_arguments():
    """The arguments that compare.py gives."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, required=True, help="for files of the run; holds the compiled rivals")
    parser.add_argument("--slideway", type=Path, required=True, help="the compiled Rust example `compare`")
    parser.add_argument("--output", type=Path, required=True, help="the Markdown file to write")
    parser.add_argument("--versions", required=True, help="JSON object of names and versions")
    parser.add_argument("--limit", type=float, required=True, help="seconds for a search or an enumeration by HiGHS")
    parser.add_argument("--pattern-limit", type=float, required=True, help="seconds for trying every pattern")
    parser.add_argument("--ladder-limit", type=float, required=True, help="seconds for the largest instance")
    parser.add_argument("--threads", type=int, required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--families", nargs="*", default=[""])
    return parser.parse_args()


def main():
    """Runs everything and writes the tables."""
    arguments = parse_arguments()
    run = Run(arguments)
    wanted = lambda name: any(name.startswith(word) for word in arguments.families)
    families = {name: family for name, family in instances.families(run.program).items() if wanted(name)}
    load = os.getloadavg()[0]
    start = time.perf_counter()
    results, largest = [], {}
    for name, family in families.items():
        for size in family.quick if arguments.quick else family.sizes:
            measure = run.measure_cells if family.by_cells else run.measure
            results.append(measure(family.make(name, size)))
            for text in results[-1]["disagreements"]:
                log(f"DISAGREEMENT {name} {size}: {text}")
    for name, family in families.items():
        largest[name] = run.largest(name, family, arguments.ladder_limit)
    data = {
        "versions": json.loads(arguments.versions),
        "threads": arguments.threads,
        "load": load,
        "seconds": time.perf_counter() - start,
        "quick": arguments.quick,
        "limit": arguments.limit,
        "ladder_limit": arguments.ladder_limit,
        "results": results,
        "largest": largest,
    }
    (arguments.folder / "results.json").write_text(json.dumps(data, indent=1))
    arguments.output.write_text(table.markdown(data, families))
    log(f"done in {data['seconds'] / 60:.1f} minutes; wrote {arguments.output.name}")


if __name__ == "__main__":
    main()
