"""Sweeps over a cluster, with Dask.

A sweep is cut into shards, as `slideway sweep --shard` cuts it: chunks that take seconds, so that Dask's share of the
time is small. Each is a task of its own; one whose worker dies is computed again by another.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import __version__
from ._needs import needs
from ._slideway import Model

with needs("slideway.dask needs Dask", "dask[dataframe]", "distributed", "pandas", "pyarrow"):
    import dask.dataframe as dd
    import pandas
    import pyarrow
    import pyarrow.parquet

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["sweep"]

# About how long a point of a mechanism with a few contacts takes on one core (s).
_POINT = 5e-5
_RETRIES = 3


def sweep(
    model: Model,
    client: Client,
    *,
    output: str | Path | None = None,
    shards: int | None = None,
    chunk_seconds: float = 5.0,
    options: Mapping[str, Any] | None = None,
    **values: Any,
) -> dd.DataFrame:
    """All solutions at every point of a sweep, computed by the workers of a cluster.

    Parameters
    ----------
    model : Model
    client : distributed.Client
    output : str or path, optional
        A folder that all workers reach: each shard becomes a Parquet file there, with the rows and the name that
        `slideway sweep --shard` gives it. Shards that are there already are left as they are, so that an interrupted
        sweep goes on, and one that is done is not computed again. Without it the rows stay in the memory of the workers,
        as long as a frame needs them.
    shards : int, optional
        How many shards. By default as many as the folder has of them already; else as many as let each take about
        `chunk_seconds` if a point takes 50 microseconds, so that the same question has the same shards.
    chunk_seconds : float, default 5
        See `shards` (s).
    options : dict, optional
        Options of `Model.sweep`: `samples`, `seed`, `attainability` ...
    **values : array, list or str
        What is varied, as for `Model.sweep`.

    Returns
    -------
    dask.dataframe.DataFrame
        The rows, a partition for each shard. They have no numbers of branches, which only the whole sweep can give:
        `slideway.merge(output)` does.

    Raises
    ------
    ModelError
        The model or the axes make no sense: once, before anything is sent.
    ValueError
        The folder has shards of another number than `shards`.
    RuntimeError
        The workers have another version of slideway.

    Examples
    --------
    >>> from distributed import Client                                          # doctest: +SKIP
    >>> with Client() as client:                                                # doctest: +SKIP
    ...     frame = slideway.dask.sweep(model, client, mu=np.linspace(0, 1, 10**7))
    ...     frame.groupby("status").size().compute()
    """
    _compare_versions(client)
    question = dict(options or {}) | values
    meta = _frame(pyarrow.table(model.sweep(**question, shard=(1, 1 << 31))))
    folder = None if output is None else str(Path(output).absolute())
    shards = _number(None if folder is None else Path(folder), shards, _shards(question, chunk_seconds))
    parts = list(range(1, shards + 1))
    # Arrays are sent once, not with each task; as a task, so that they are there again if their worker dies.
    held = client.submit(_held, model, question)
    name = f"slideway-sweep-{str(held.key)[-16:]}-{shards}" + ("" if folder is None else "-files")
    futures = [
        client.submit(_part, held, (part, shards), folder, key=f"{name}-{part}", retries=_RETRIES, pure=True)
        for part in parts
    ]
    if folder is None:
        frame: dd.DataFrame = dd.from_delayed(futures, meta=meta, verify_meta=False)
        return frame
    paths = client.gather(futures)
    written: dd.DataFrame = dd.from_map(_read, paths, meta=meta)
    return written


def _compare_versions(client: Client) -> None:
    """Workers of another version might give other rows."""
    others = {worker: found for worker, found in client.run(_version).items() if found != __version__}
    if others:
        told = ", ".join(f"{worker} has {found}" for worker, found in sorted(others.items()))
        raise RuntimeError(f"this is slideway {__version__}, but {told}")


def _version() -> str:
    import slideway

    return slideway.__version__


def _number(folder: Path | None, wanted: int | None, usual: int) -> int:
    """How many shards: those of which the folder has some, whatever would be usual."""
    if wanted is not None and wanted < 1:
        raise ValueError(f"shards must be at least 1, not {wanted}")
    names = [path.name for path in folder.iterdir()] if folder is not None and folder.is_dir() else []
    found = {int(match[1]) for name in names if (match := re.match(r"shard-\d+-of-(\d+)\.parquet", name))}
    if not found:
        return usual if wanted is None else wanted
    there = " and ".join(map(str, sorted(found)))
    if len(found) > 1:
        raise ValueError(f"{folder} has shards of sweeps in {there} shards: take a folder for each")
    if wanted is not None and found != {wanted}:
        message = f"{folder} has shards of a sweep in {there} shards, but shards is {wanted}"
        raise ValueError(f"{message}: leave it out to go on, or take another folder")
    return found.pop()


def _shards(question: Mapping[str, Any], chunk_seconds: float) -> int:
    """How many shards let each take about so many seconds: the question alone says, so that it is asked again alike."""
    if not (chunk_seconds > 0.0 and math.isfinite(chunk_seconds)):
        raise ValueError(f"chunk_seconds must be a positive number, not {chunk_seconds}")
    points = _points(question)
    return max(1, min(points, round(points * _POINT / chunk_seconds)))


def _points(question: Mapping[str, Any]) -> int:
    """How many points a sweep has, without those that are inserted where modes end."""
    if question.get("samples") is not None:
        return int(question["samples"])
    options = ("samples", "sampling", "seed", "breakpoints", "attainability", "all_columns", "time_limit", "progress")
    points = 1
    for name, values in question.items():
        if name in options:
            continue
        if isinstance(values, str):
            # "0..1:101", or values apart from each other by commas.
            steps = re.search(r":\s*(\d+)\s*$", values)
            points *= int(steps[1]) if steps else values.count(",") + 1
        else:
            points *= np.size(values)
    return points


def _held(model: Model, question: Mapping[str, Any]) -> tuple[Model, Mapping[str, Any]]:
    """A task: what all others need."""
    return model, question


def _part(held: tuple[Model, Mapping[str, Any]], shard: tuple[int, int], folder: str | None) -> pandas.DataFrame | str:
    """A task: a shard as rows, or as the path of its file."""
    model, question = held
    if folder is not None:
        return str(model.write_shard(folder, shard, **question))
    return _frame(pyarrow.table(model.sweep(**question, shard=shard)))


def _read(path: str) -> pandas.DataFrame:
    return _frame(pyarrow.parquet.read_table(path))


def _frame(table: pyarrow.Table) -> pandas.DataFrame:
    """Words as Dask has them, whether the rows come from memory or from a file."""
    words = {pyarrow.string(): pandas.StringDtype("pyarrow")}
    return table.to_pandas(types_mapper=words.get)

