"""Runs slideway and the rival codes on an instance. Each returns a dictionary; solutions are texts of + and -."""
import json
import subprocess
import time

import highspy
import numpy as np

# A bound of all unknowns where none is known, as a multiple of the largest entry of the right-hand side.
GENEROUS = 1000.0
# Bounds that are proven are widened: with bounds within 1e-13 of the solution HiGHS found that there is none.
WIDER = 1.01
# Tolerance of HiGHS for rows, bounds and whole numbers.
TOLERANCE = 1e-9
# Patterns in one call of numpy.linalg.solve.
BATCH = 4096


def signs(values):
    """The pattern of signed unknowns, with 0 on a boundary."""
    return "".join("+" if value > 0 else "-" if value < 0 else "0" for value in values)


def pattern(bits, size):
    """The pattern of a number whose bit k is set where unknown k is negative."""
    return "".join("-" if bits >> k & 1 else "+" for k in range(size))


def _json_of(command, environment, timeout=None):
    output = subprocess.run(
        [str(word) for word in command], check=True, capture_output=True, text=True, env=environment, timeout=timeout
    )
    return json.loads(output.stdout)


def slideway(program, path, time_limit, listed, environment):
    """The search; lists so many solutions at most."""
    command = [program, "solve", "--time-limit", time_limit, "--listed", listed, path]
    result = _json_of(command, environment)
    result["patterns"] = [signs(values) for values in result["search"].pop("solutions")]
    return result


def lcp_enum(program, instance, folder, listed, environment, timeout=None):
    """Siconos' lcp_enum on the problem as an LCP."""
    m, q = instance.complementarity()
    path = folder / f"{instance.name}.lcp"
    _write(path, instance.size, m, q)
    result = _json_of([program, path, int(listed)], environment, timeout)
    if result["solutions"] is not None:
        result["patterns"] = [signs(values) for values in result["solutions"]]
        result["points"] = [signs(beyond(values, result["tolerance"])) for values in result["solutions"]]
    return result


def beyond(values, tolerance):
    """The values, with zero for those within a tolerance, relative to the largest one and to 1."""
    values = np.asarray(values)
    return np.where(abs(values) > tolerance * max(1.0, abs(values).max()), values, 0.0)


def lu_lapack(program, instance, folder, most, environment):
    """One compiled call of LAPACK's dgesv for each of the first `most` patterns."""
    path = folder / f"{instance.name}.modes"
    _write(path, instance.size, *instance.columns())
    result = _json_of([program, path, most], environment)
    result["all"] = result["patterns"] == 2**instance.size
    result["per_pattern"] = result["seconds"] / result["patterns"]
    result["all_seconds"] = result["per_pattern"] * 2**instance.size
    result["patterns"] = [pattern(bits, instance.size) for bits in result["solutions"]]
    return result


def _write(path, size, *arrays):
    with open(path, "wb") as file:
        file.write(np.int64(size).tobytes())
        for array in arrays:
            file.write(np.asarray(array, dtype=np.float64).tobytes(order="F"))


def lu_numpy(instance, most):
    """numpy.linalg.solve on stacks of the matrices of the first `most` patterns."""
    positive, negative, load = instance.columns()
    size, found = instance.size, []
    patterns = min(most, 2**size)
    start = time.perf_counter()
    for first in range(0, patterns, BATCH):
        bits = np.arange(first, min(first + BATCH, patterns))
        minus = (bits[:, None] >> np.arange(size) & 1).astype(bool)
        matrices = np.where(minus[:, None, :], negative, positive)
        y = np.linalg.solve(matrices, np.broadcast_to(load[:, None], (len(bits), size, 1)))[..., 0]
        found.extend(bits[y.min(axis=1) >= -1e-9 * abs(y).max(axis=1)].tolist())
    seconds = time.perf_counter() - start
    return {
        "seconds": seconds,
        "all": patterns == 2**size,
        "per_pattern": seconds / patterns,
        "all_seconds": seconds / patterns * 2**size,
        "patterns": [pattern(bits, size) for bits in found],
    }


def highs(instance, bounds, time_limit):
    """All solutions by mixed-integer programming: a binary variable for each sign, a cut for each pattern found.

    C+ y+ + C- y- = b, 0 <= y+ <= U s, 0 <= y- <= U (1 - s), s binary. U are `bounds` of all solutions if there are any,
    else a generous number, with which solutions with a larger unknown would be missed. Every pattern that HiGHS
    returns is solved by LU: within its tolerances HiGHS also returns patterns that have no solution ("spurious").
    """
    positive, negative, load = instance.columns()
    size = instance.size
    largest = WIDER * np.array(bounds) if bounds else np.full(size, GENEROUS * (abs(load).max() or 1.0))
    solver = _model(positive, negative, load, largest)
    start, found, points, spurious, outcome, first = time.perf_counter(), [], [], 0, "time limit", None
    while (left := time_limit - (time.perf_counter() - start)) > 0:
        # HiGHS' clock goes on from run to run.
        solver.setOptionValue("time_limit", solver.getRunTime() + left)
        solver.run()
        status = solver.getModelStatus()
        if status == highspy.HighsModelStatus.kInfeasible:
            outcome = "complete"
            break
        if status != highspy.HighsModelStatus.kOptimal:
            outcome = "time limit" if status == highspy.HighsModelStatus.kTimeLimit else str(status)
            break
        values = np.array(solver.getSolution().col_value)
        up = values[2 * size :] > 0.5
        y = _solution_of(np.where(up, positive, negative), load, np.where(up, values[:size], values[size : 2 * size]))
        first = first or time.perf_counter() - start
        if y is not None:
            found.append("".join("+" if each else "-" for each in up))
            points.append(signs(beyond(np.where(up, y, -y), 100 * TOLERANCE)))
        else:
            spurious += 1
        # Some sign differs: sum over s = 1 of (1 - s) plus sum over s = 0 of s is at least 1.
        values = np.where(up, -1.0, 1.0)
        solver.addRow(1.0 - up.sum(), highspy.kHighsInf, size, np.arange(2 * size, 3 * size, dtype=np.int32), values)
    return {
        "seconds": time.perf_counter() - start,
        "outcome": outcome,
        "first_seconds": first,
        "patterns": found,
        "points": points,
        "spurious": spurious,
        "bound": "propagation" if bounds else "generous",
    }


def _solution_of(matrix, load, near):
    """The y >= 0 of a pattern; for a singular matrix, the given one if it solves the equations; else none."""
    try:
        y = np.linalg.solve(matrix, load)
    except np.linalg.LinAlgError:
        solves = abs(matrix @ near - load).max() <= 1e-6 * max(1.0, abs(load).max())
        return near if solves else None
    return y if y.min() >= -1e-9 * abs(y).max() else None


def _model(positive, negative, load, largest):
    size = len(load)
    solver = highspy.Highs()
    for option, value in (
        ("output_flag", False),
        ("threads", 1),
        ("primal_feasibility_tolerance", TOLERANCE),
        ("mip_feasibility_tolerance", TOLERANCE),
    ):
        solver.setOptionValue(option, value)
    upper = np.concatenate([largest, largest, np.ones(size)])
    solver.addVars(3 * size, np.zeros(3 * size), upper)
    indices = np.arange(2 * size, 3 * size, dtype=np.int32)
    solver.changeColsIntegrality(size, indices, np.full(size, highspy.HighsVarType.kInteger))
    columns = np.hstack([positive, negative])
    for row, value in zip(columns, load):
        at = np.flatnonzero(row).astype(np.int32)
        solver.addRow(value, value, len(at), at, row[at])
    infinity = highspy.kHighsInf
    for k in range(size):
        solver.addRow(-infinity, 0.0, 2, np.array([k, 2 * size + k], np.int32), np.array([1.0, -largest[k]]))
        solver.addRow(-infinity, largest[k], 2, np.array([size + k, 2 * size + k], np.int32), np.array([1.0, largest[k]]))
    return solver
