"""Sweeps over several processes: the union of what they compute is one run, whatever happens to them."""

from __future__ import annotations

import os
import pickle
import signal
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pyarrow.parquet
import pytest
import slideway
import slideway.dask
from distributed import Client, LocalCluster

MODEL = slideway.Model.gallery("klepp-2002")
VALUES = {"mu_1": np.linspace(0.0, 0.8, 4001)}


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
        with Client(cluster) as client:
            yield client


def assert_same(frame: pandas.DataFrame, whole: slideway.Sweep) -> None:
    """Bit for bit, but for the numbers of branches, which parts cannot have."""
    for name in set(frame.columns) & set(whole.columns):
        found, wanted = frame[name], whole[name]
        if wanted.dtype.kind == "f":
            assert np.array_equal(found.to_numpy(float).view(np.uint64), wanted.view(np.uint64)), name
        elif wanted.dtype.kind == "U":
            assert np.array_equal(found.fillna("").to_numpy(str), wanted), name
        else:
            assert np.array_equal(found.to_numpy(), wanted), name


def test_union_of_parts_is_one_run(client: Client) -> None:
    frame = slideway.dask.sweep(MODEL, client, shards=7, **VALUES)
    assert frame.npartitions == 7
    assert_same(frame.compute(), MODEL.sweep(**VALUES))


def test_samples_do_not_depend_on_parts(client: Client) -> None:
    options = {"samples": 2000, "seed": 7}
    frame = slideway.dask.sweep(MODEL, client, shards=3, options=options, mu_1="normal(0.4, 0.1)")
    assert_same(frame.compute(), MODEL.sweep(**options, mu_1="normal(0.4, 0.1)"))


def test_files_are_merged_to_one_run(client: Client, tmp_path: Path) -> None:
    frame = slideway.dask.sweep(MODEL, client, output=tmp_path, shards=5, **VALUES)
    whole = MODEL.sweep(**VALUES)
    assert_same(frame.compute(), whole)
    assert slideway.merge(tmp_path).to_numpy().tobytes() == whole.to_numpy().tobytes()


def test_parts_tell_the_command_line_that_asks_for_the_same(tmp_path: Path) -> None:
    """Which then writes the same bytes: crates/slideway-cli/tests/shards.rs."""
    model = pickle.loads(pickle.dumps(slideway.Model.gallery("drawer"))).with_(mu=0.3, a="250 mm")

    def told(**values: Any) -> str:
        part = model.write_shard(tmp_path / "results", (1, 1), **values)
        metadata = pyarrow.parquet.read_metadata(part).metadata
        part.unlink()
        return metadata[b"slideway.command"].decode()

    start = "slideway sweep drawer.toml --set mu=0.3 --set 'a=250 mm' "
    assert told(L=np.array([0.3, 0.4])) == start + "--vary L=0.3,0.4 --no-breakpoints"
    assert told(L="0.3..0.4:3", breakpoints=True) == start + "--vary L=0.3..0.4:3"
    assert told(L=["300 mm"], mu=[0.1, 0.2], attainability=True) == (
        start + "--vary 'L=300 mm' --vary mu=0.1,0.2 --attainability"
    )
    assert told(samples=3, L="uniform(0.3, 0.4)") == start + "--vary 'L=uniform(0.3, 0.4)' --samples 3"
    assert told(L=["min(0.3, 0.4)", 0.5]) == start + "--vary 'L=min(0.3, 0.4),0.5' --no-breakpoints"
    # No argument of a program has room for so many.
    assert told(L=np.linspace(0.3, 0.4, 20_001)) == "slideway for Python: Model.write_shard"


def test_parts_that_are_there_are_kept(client: Client, tmp_path: Path) -> None:
    first = MODEL.write_shard(tmp_path, (2, 5), **VALUES)
    before = first.stat().st_mtime_ns
    slideway.dask.sweep(MODEL, client, output=tmp_path, shards=5, **VALUES)
    assert first.stat().st_mtime_ns == before
    assert len(list(tmp_path.iterdir())) == 5


def test_a_worker_that_dies_costs_nothing() -> None:
    values = {"mu_1": "0..0.8:400001"}
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as cluster:
        with Client(cluster) as client:
            process = next(iter(client.run(os.getpid).values()))
            frame = slideway.dask.sweep(MODEL, client, shards=8, **values)
            os.kill(process, signal.SIGKILL)
            points = frame["point"].compute()
    assert points.nunique() == 400001
    assert len(points) == len(MODEL.sweep(**values))


def test_faults_are_raised_once_before_anything_is_sent(client: Client) -> None:
    with pytest.raises(slideway.ModelError) as raised:
        slideway.dask.sweep(MODEL, client, shards=100, mu_l=[0.1])
    assert len(raised.value.faults) == 1
    assert "mu_1" in str(raised.value)


def test_versions_are_compared(client: Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(slideway.dask, "__version__", "0.0.1")
    with pytest.raises(RuntimeError, match="this is slideway 0.0.1, but tcp"):
        slideway.dask.sweep(MODEL, client, **VALUES)


def test_the_number_of_parts_follows_the_question_alone(client: Client) -> None:
    few = slideway.dask._shards(VALUES, 5.0)
    many = slideway.dask._shards({"mu_1": "0..0.8:1000000001"}, 5.0)
    assert few == 1 < 10 < many
    sizes: list[tuple[dict[str, Any], int]] = [
        (VALUES, 4001),
        ({"mu_1": "0..0.8:801", "F_20": "0, 1, 2"}, 2403),
        ({"mu_1": [0.1, 0.2], "attainability": True}, 2),
        ({"mu_1": 0.1}, 1),
        ({"mu_1": "normal(0.4, 0.1)", "samples": 2000}, 2000),
    ]
    for question, points in sizes:
        assert slideway.dask._points(question) == points
        assert MODEL.sweep(**question).tally.points == points
    with pytest.raises(ValueError, match="chunk_seconds"):
        slideway.dask.sweep(MODEL, client, chunk_seconds=0.0, **VALUES)


def test_three_identical_calls_compute_once(client: Client, tmp_path: Path) -> None:
    def written() -> dict[str, int]:
        return {path.name: path.stat().st_mtime_ns for path in tmp_path.iterdir()}

    frames = [slideway.dask.sweep(MODEL, client, output=tmp_path, chunk_seconds=0.05, **VALUES)]
    before = written()
    assert len(before) == frames[0].npartitions == 4
    frames += [slideway.dask.sweep(MODEL, client, output=tmp_path, chunk_seconds=0.05, **VALUES) for _ in range(2)]
    assert written() == before
    assert_same(frames[2].compute(), MODEL.sweep(**VALUES))
    # Whatever would be usual: the folder says.
    assert slideway.dask.sweep(MODEL, client, output=tmp_path, **VALUES).npartitions == 4
    assert written() == before


def test_another_number_of_parts_is_refused(client: Client, tmp_path: Path) -> None:
    MODEL.write_shard(tmp_path, (2, 5), **VALUES)
    with pytest.raises(ValueError, match="in 5 shards, but shards is 7: leave it out"):
        slideway.dask.sweep(MODEL, client, output=tmp_path, shards=7, **VALUES)
    assert len(list(tmp_path.iterdir())) == 1
    assert slideway.dask.sweep(MODEL, client, output=tmp_path, **VALUES).npartitions == 5
    assert slideway.merge(tmp_path).to_numpy().tobytes() == MODEL.sweep(**VALUES).to_numpy().tobytes()
    MODEL.write_shard(tmp_path, (1, 7), **VALUES)
    with pytest.raises(ValueError, match="in 5 and 7 shards: take a folder for each"):
        slideway.dask.sweep(MODEL, client, output=tmp_path, **VALUES)
    with pytest.raises(OSError, match="belong to different sweeps"):
        slideway.merge(tmp_path)
    with pytest.raises(ValueError, match="shards must be at least 1, not 0"):
        slideway.dask.sweep(MODEL, client, shards=0, **VALUES)


def test_work_is_told_of_and_ended(client: Client) -> None:
    begun = time.perf_counter()
    with pytest.raises(TimeoutError):
        MODEL.sweep(mu_1="0..0.8:20000001", time_limit=0.2)
    assert time.perf_counter() - begun < 5.0
