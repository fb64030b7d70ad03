"""The friction sweep of the paper's example with vectorised NumPy, as the rival of `slideway sweep`.

Klepp (2002), section 6, without preload and moving to the right: mu_1 goes from 0 to 0.8, mu_2 = mu_3 = 0.1. The influence
coefficients are closed forms; every sign pattern is one batch of 3 x 3 systems for all points. Only the computation is
timed: the normal forces of all solutions at every point.

    python3 reference/comparison/sweep_numpy.py [POINTS] [TABLE.npz]

With a table of `slideway sweep models/klepp-2002.toml --set F_20=0 --vary mu_1=0..0.8:POINTS --no-breakpoints` the normal
forces of both are compared.
"""

import itertools
import sys
import time

import numpy as np

TANGENT = np.tan(np.radians(80.0))
WEIGHT = 9.81
# Without friction the bar is in free motion along the slots: N_1 = m g / 2, which the lower block carries as m g / 2 in all,
# shared equally by its two contacts.
FRICTIONLESS = WEIGHT * np.array([0.5, 0.25, 0.25])
MU = np.array([0.0, 0.1, 0.1])


def influence(side):
    """eta_jk for friction at the faces of one side: closed forms for alpha = 80 degrees, b/l = 0.2, h/l = 0.1."""
    arm = 0.25 * side
    return np.array(
        [
            [-TANGENT / 2, TANGENT / 2, TANGENT / 2],
            [TANGENT / 4, arm - TANGENT / 4, arm - TANGENT / 4],
            [TANGENT / 4, -arm - TANGENT / 4, -arm - TANGENT / 4],
        ]
    )


def sweep(mu_1):
    """For every sign pattern: at which points it has a solution, and its normal forces there."""
    eta = {side: influence(side) for side in (1.0, -1.0)}
    solutions = []
    for sigma in itertools.product((1.0, -1.0), repeat=3):
        columns = np.empty((len(mu_1), 3, 3))
        for k, side in enumerate(sigma):
            mu = mu_1 if k == 0 else MU[k]
            columns[:, :, k] = -np.multiply.outer(np.broadcast_to(mu, mu_1.shape), eta[side][:, k])
            columns[:, k, k] += side
        y = np.linalg.solve(columns, np.broadcast_to(FRICTIONLESS[:, None], (len(mu_1), 3, 1)))[:, :, 0]
        exists = (y >= 0).all(axis=1)
        solutions.append((sigma, np.flatnonzero(exists), y[exists] * sigma))
    return solutions


def compare(solutions, mu_1, path):
    rows = np.load(path)["rows"]
    names = ["normal_force.upper", "normal_force.lower.front", "normal_force.lower.rear"]
    worst = 0.0
    count = 0
    for sigma, at, forces in solutions:
        pattern = "".join("+" if side > 0 else "-" for side in sigma).encode()
        same = rows[rows["pattern"] == pattern]
        assert np.array_equal(same["point"], at), f"{pattern} exists at other points"
        if len(at):
            ours = np.stack([same[name] for name in names], axis=1)
            worst = max(worst, np.max(np.abs(ours - forces) / np.abs(forces).max(axis=1)[:, None]))
        count += len(at)
    assert count == len(rows), f"{len(rows)} rows, but {count} solutions"
    print(f"{count} solutions agree, greatest relative difference {worst:.1e}")


def main():
    points = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    mu_1 = 0.8 * np.arange(points) / (points - 1)
    times = []
    for _ in range(3):
        # Processor time: other programs do not count. With OMP_NUM_THREADS=1 that is the time on one processor.
        start = time.process_time()
        solutions = sweep(mu_1)
        times.append(time.process_time() - start)
    print(f"NumPy {np.__version__}: {points} points in {min(times):.3f} s of processor time, {1e9 * min(times) / points:.0f} ns per point")
    if len(sys.argv) > 2:
        compare(solutions, mu_1, sys.argv[2])


if __name__ == "__main__":
    main()
