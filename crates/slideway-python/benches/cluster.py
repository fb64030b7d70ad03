"""What Dask costs: a sweep in shards on a cluster of one process, against the same shards one after the other.

    python benches/cluster.py

Both on one thread of work, into files, and once more with the rows in memory: what Dask adds, and what frames of pandas
add.
"""

from __future__ import annotations

import os
import tempfile
import time
from pathlib import Path

os.environ["RAYON_NUM_THREADS"] = "1"

from distributed import Client, LocalCluster

import slideway
import slideway.dask

SHARDS = 4
VALUES = {"phi": "-80 deg..80 deg:1000001"}
MODEL = "slider-crank"


def main() -> None:
    model = slideway.Model.gallery(MODEL)
    start = time.perf_counter()
    for shard in range(1, SHARDS + 1):
        model.sweep(**VALUES, shard=(shard, SHARDS))
    rows = time.perf_counter() - start
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as other:
        start = time.perf_counter()
        for shard in range(1, SHARDS + 1):
            model.write_shard(folder, (shard, SHARDS), **VALUES)
        plain = time.perf_counter() - start
        print(f"{SHARDS} shards one after the other: {rows:.2f} s as rows, {plain:.2f} s into files")
        with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=":0") as cluster:
            with Client(cluster) as client:
                start = time.perf_counter()
                slideway.dask.sweep(model, client, shards=SHARDS, output=other, **VALUES)
                files = time.perf_counter() - start
                start = time.perf_counter()
                frame = slideway.dask.sweep(model, client, shards=SHARDS, **VALUES)
                frame.map_partitions(len).compute()
                frames = time.perf_counter() - start
        same = [path.read_bytes() == Path(other, path.name).read_bytes() for path in Path(folder).iterdir()]
        assert len(same) == SHARDS and all(same)
    print(f"by Dask into files: {files:.2f} s, {100 * (files / plain - 1):.1f} % more")
    print(f"by Dask as frames of pandas: {frames:.2f} s, {100 * (frames / rows - 1):.1f} % more")


if __name__ == "__main__":
    main()
