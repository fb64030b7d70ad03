"""How long calls from Python take, against the command line and a script in NumPy.

    python benches/calls.py target/release/slideway

Prints the least processor time of several runs of each, which depends less than the time on the clock on what else the
machine does; for sweeps, whose runs alternate with those of the command line, both. Needs an optimised build of both, and
polars.
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
RUNS = 5
HERE = Path(__file__).resolve()


def processor(who: int) -> float:
    """The processor time of this process or of those that it has started (s)."""
    used = resource.getrusage(who)
    return used.ru_utime + used.ru_stime


def least(work: Callable[[], object], runs: int = RUNS) -> float:
    """The least processor time of this thread in some runs (s)."""
    times = []
    for _ in range(runs):
        start = time.thread_time()
        work()
        times.append(time.thread_time() - start)
    return min(times)


def once(work: Callable[[], object], who: int) -> tuple[float, float]:
    """The processor time of a run, and its time on the clock (s)."""
    start = processor(who), time.perf_counter()
    work()
    return processor(who) - start[0], time.perf_counter() - start[1]


def calls() -> None:
    drawer = slideway.Model.gallery("drawer")
    solve = least(lambda: [drawer.solve(margins=False) for _ in range(1000)]) / 1000
    print(f"drawer.solve(margins=False): {1e6 * solve:.1f} us")
    check = least(lambda: [drawer.with_() for _ in range(1000)]) / 1000
    print(f"drawer.with_(), which does next to nothing: {1e6 * check:.1f} us")
    first = least(lambda: [drawer.solve(margins=False).solutions for _ in range(1000)]) / 1000
    print(f"... and making its attributes: {1e6 * (first - solve):.1f} us")
    loop = least(lambda: [drawer.with_(mu=mu).solve(margins=False) for mu in np.linspace(0.1, 0.6, 10_000)], 1)
    print(f"10,000 times drawer.with_(mu=x).solve(margins=False): {loop:.2f} s")


def sweeps(program: str, folder: str) -> None:
    klepp = slideway.Model.gallery("klepp-2002")
    values = np.linspace(0.0, 0.8, POINTS)
    model = Path(folder, "klepp-2002.toml")
    model.write_text(klepp.text)
    command = [program, "sweep", str(model), "--vary", f"mu_1=0..0.8:{POINTS}", "--no-breakpoints", "--force"]
    command += ["--output", str(Path(folder, "all.npz"))]
    frames, files = [], []
    for _ in range(RUNS):
        frames.append(once(lambda: klepp.sweep(mu_1=values).to_polars(), resource.RUSAGE_SELF))
        files.append(once(lambda: subprocess.run(command, check=True, capture_output=True), resource.RUSAGE_CHILDREN))
    (frame, frame_clock), (file, file_clock) = ([min(times) for times in zip(*runs)] for runs in (frames, files))
    print(f"{POINTS} points into a frame of polars: {frame:.2f} s, on the clock {frame_clock:.2f} s")
    print(f"the same by the command line into .npz: {file:.2f} s, on the clock {file_clock:.2f} s")
    print(f"    ratio {frame / file:.2f}, on the clock {frame_clock / file_clock:.2f}")


def main() -> None:
    calls()
    with tempfile.TemporaryDirectory() as folder:
        sweeps(sys.argv[1], folder)
    numpy = [sys.executable, str(HERE.parents[3] / "reference/comparison/sweep_numpy.py"), str(POINTS)]
    subprocess.run(numpy, check=True)


main()
