"""How long calls from Python take, against the command line and a script in NumPy.

    python benches/calls.py target/release/slideway

Prints the least of several runs of each, and for sweeps the processor time, which depends less on what else the
machine does. Needs an optimised build of both, polars, and quiet cores.
"""

from __future__ import annotations

import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import slideway

POINTS = 1_000_000
HERE = Path(__file__).resolve()


def least(work: Callable[[], object], runs: int) -> float:
    """The least time of some runs (s)."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def processor(work: Callable[[], object], who: int = resource.RUSAGE_SELF) -> float:
    """The processor time of a run (s), of this process or of those that it starts."""
    before = resource.getrusage(who)
    work()
    after = resource.getrusage(who)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main() -> None:
    program = sys.argv[1]
    drawer = slideway.Model.gallery("drawer")
    solve = least(lambda: [drawer.solve(margins=False) for _ in range(1000)], 5) / 1000
    print(f"drawer.solve(margins=False): {1e6 * solve:.1f} us")
    check = least(lambda: [drawer.with_() for _ in range(1000)], 5) / 1000
    print(f"drawer.with_(), which does next to nothing: {1e6 * check:.1f} us")
    answer = drawer.solve()
    first = least(lambda: [drawer.solve(margins=False).solutions for _ in range(1000)], 5) / 1000
    print(f"... and making its attributes: {1e6 * (first - solve):.1f} us; {answer!r}")
    loop = least(lambda: [drawer.with_(mu=mu).solve(margins=False) for mu in np.linspace(0.1, 0.6, 10_000)], 1)
    print(f"10,000 times drawer.with_(mu=x).solve(margins=False): {loop:.2f} s")
    klepp = slideway.Model.gallery("klepp-2002")
    values = np.linspace(0.0, 0.8, POINTS)
    def to_frame() -> object:
        return klepp.sweep(mu_1=values).to_polars()

    frame, work = least(to_frame, 3), processor(to_frame)
    print(f"{POINTS} points into a frame of polars: {frame:.2f} s, {work:.2f} s of processors")
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder, "klepp-2002.toml")
        model.write_text(klepp.text)
        command = [program, "sweep", str(model), "--vary", f"mu_1=0..0.8:{POINTS}", "--no-breakpoints", "--force"]
        command += ["--output", str(Path(folder, "all.npz"))]

        def to_file() -> object:
            return subprocess.run(command, check=True, capture_output=True)

        written, work = least(to_file, 3), processor(to_file, resource.RUSAGE_CHILDREN)
    print(f"the same by the command line into .npz: {written:.2f} s, {work:.2f} s of processors")
    print(f"    ratio {frame / written:.2f}")
    without_preload = klepp.with_(F_20=0)
    alone = processor(lambda: without_preload.sweep(mu_1=values))
    numpy = [sys.executable, str(HERE.parents[3] / "reference/comparison/sweep_numpy.py"), str(POINTS)]
    print(f"the sweep of reference/comparison/sweep_numpy.py as a whole table: {alone:.2f} s of processors; by itself:")
    subprocess.run(numpy, check=True)


main()
