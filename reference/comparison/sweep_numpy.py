"""The friction sweep of the paper's example with vectorised NumPy, as the rival of `slideway sweep`.

Klepp (2002), section 6, without preload and moving to the right: mu_1 goes from 0 to 0.8, mu_2 = mu_3 = 0.1. The influence
coefficients are closed forms; every sign pattern is one batch of 3 x 3 systems for all points. Two things are timed: the
normal forces of all solutions at every point, and these as a frame of polars with the columns of `slideway.Sweep`.

    python3 reference/comparison/sweep_numpy.py [POINTS] [TABLE.npz]

With a table of `slideway sweep models/klepp-2002.toml --set F_20=0 --vary mu_1=0..0.8:POINTS --no-breakpoints` the normal
forces of both are compared. If the Python package slideway is installed, its sweep is timed and compared, too.
"""

import itertools
import sys
import time

import numpy as np
import polars

TANGENT = np.tan(np.radians(80.0))
WEIGHT = 9.81
# Without friction the bar is in free motion along the slots: N_1 = m g / 2, which the lower block carries as m g / 2 in all,
# shared equally by its two contacts.
FRICTIONLESS = WEIGHT * np.array([0.5, 0.25, 0.25])
MU = np.array([0.0, 0.1, 0.1])
CONTACTS = ["upper", "lower.front", "lower.rear"]


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


def frame(solutions, mu_1):
    """The solutions as slideway tells them: a row for each, in the order of the points. The bar has 1 kg."""
    counts = sum(np.bincount(at, minlength=len(mu_1)) for _, at, _ in solutions)
    columns = []
    for branch, (sigma, at, forces) in enumerate((found for found in solutions if len(found[1])), 1):
        friction = np.abs(forces) * MU
        friction[:, 0] = np.abs(forces[:, 0]) * mu_1[at]
        rows = {"point": at.astype(np.uint64), "mu_1": mu_1[at]}
        rows["breakpoint"] = np.full(len(at), None)
        rows["status"] = np.where(counts[at] > 1, "several", "one")
        rows["solutions"] = counts[at].astype(np.uint32)
        rows["gap_states"] = rows["rejected"] = np.zeros(len(at), np.uint32)
        pattern = "".join("+" if side > 0 else "-" for side in sigma)
        rows["kind"] = np.full(len(at), "solution")
        rows["branch"] = np.full(len(at), branch, np.uint32)
        rows["pattern"] = np.full(len(at), pattern)
        rows |= {f"normal_force.{name}": forces[:, k] for k, name in enumerate(CONTACTS)}
        rows |= {f"friction_force.{name}": friction[:, k] for k, name in enumerate(CONTACTS)}
        rows |= {f"preload_share.{name}": np.full(len(at), np.nan) for name in CONTACTS}
        rows["acceleration.q"] = -friction.sum(axis=1)
        columns.append(rows)
    whole = {name: np.concatenate([rows[name] for rows in columns]) for name in columns[0]}
    order = np.argsort(whole["point"], kind="stable")
    words = {"breakpoint": polars.String}
    return polars.DataFrame({name: column[order] for name, column in whole.items()}, schema_overrides=words, nan_to_null=True)


def compare(solutions, mu_1, path):
    rows = np.load(path)["rows"]
    names = [f"normal_force.{name}" for name in CONTACTS]
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


def compare_frames(ours, theirs):
    """Words and counts are the same; numbers but for rounding, of the forces of the row."""
    assert ours.schema == theirs.schema, (ours.schema, theirs.schema)
    scale = theirs.select(polars.max_horizontal(*(polars.col(f"normal_force.{name}").abs() for name in CONTACTS))).to_series()
    worst = 0.0
    for name, kind in ours.schema.items():
        if kind == polars.Float64 and name != "mu_1":
            assert (ours[name].is_null() == theirs[name].is_null()).all(), name
            worst = max(worst, ((ours[name] - theirs[name]).abs() / scale).max() or 0.0)
        elif kind == polars.Float64:
            assert np.allclose(ours[name], theirs[name], rtol=1e-15, atol=0.0)
        else:
            assert ours[name].equals(theirs[name]), name
    print(f"{len(ours)} rows of {ours.width} columns agree, greatest relative difference {worst:.1e}")


def timed(what, points, work):
    """The least processor time and time on the clock of three runs. Of processor time other programs take nothing."""
    times = []
    for _ in range(3):
        start = time.process_time(), time.perf_counter()
        made = work()
        times.append((time.process_time() - start[0], time.perf_counter() - start[1]))
    processor, clock = (min(column) for column in zip(*times))
    each = 1e9 * processor / points
    print(f"{what}: {points} points in {processor:.3f} s of processor time, {each:.0f} ns per point; {clock:.3f} s on the clock")
    return made


def main():
    points = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    mu_1 = 0.8 * np.arange(points) / (points - 1)
    numpy = f"NumPy {np.__version__}"
    solutions = timed(f"{numpy}, normal forces", points, lambda: sweep(mu_1))
    ours = timed(f"{numpy}, frame of polars", points, lambda: frame(sweep(mu_1), mu_1))
    if len(sys.argv) > 2:
        compare(solutions, mu_1, sys.argv[2])
    try:
        import slideway
    except ImportError:
        return
    model = slideway.Model.gallery("klepp-2002").with_(F_20=0)
    theirs = timed("slideway, frame of polars", points, lambda: model.sweep(mu_1=mu_1).to_polars())
    compare_frames(ours, theirs)


if __name__ == "__main__":
    main()
