"""Reads Parquet files of slideway with DuckDB and Polars, and compares them with the CSV tables of the same commands.

    check.py SLIDEWAY

SLIDEWAY is a program that was built with the feature `parquet`. Each value has to be the same bit for bit, and null where the CSV
table is empty; types, encodings and metadata are looked at, too.
"""

import csv
import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

import duckdb
import polars

TOP = pathlib.Path(__file__).resolve().parents[2]

# The commands, without their output.
COMMANDS = [
    # Several groups of rows.
    ["sweep", "models/klepp-2002.toml", "--set", "F_20=0", "--vary", "mu_1=0..0.8:150001"],
    # Preload gaps, attainability, every column.
    ["sweep", "models/klepp-2002.toml", "--vary", "mu_1=0..0.8:81", "--attainability", "--all-columns"],
    # Points without a solution; two varied quantities; a word in the metadata that is quoted.
    ["sweep", "models/drawer.toml", "--vary", "mu=0..1:41", "--vary", "a=0..0.5:11", "--set", "L=0.4 m"],
    # Friction locks beyond a value, which is inserted.
    ["sweep", "models/drawer.toml", "--vary", "mu=0..1:41"],
    # Samples have no branches.
    ["sweep", "models/drawer.toml", "--vary", "mu=normal(0.6, 0.05)", "--samples", "2000"],
    # Positions that cannot be assembled.
    ["sweep", "models/slider-crank.toml", "--vary", "l=0.02..0.2:37", "--at", "phi=80 deg"],
    # Statics determines the friction of the block that sticks.
    ["simulate", "models/stick-slip.toml", "--until", "2s"],
    # Both slots stick in the end: how they share the load is undetermined.
    ["simulate", "models/elliptic-trammel.toml", "--until", "2s"],
    ["simulate", "models/frictional-oscillator.toml", "--until", "3s", "--step", "1ms"],
]

UNSIGNED = {"point": 64, "solutions": 32, "gap_states": 32, "rejected": 32, "branch": 32}
WORDS = {"breakpoint", "status", "kind", "pattern", "attainability", "mode"}
REQUIRED = {"point", "solutions", "gap_states", "rejected"}
ROWS_OF_A_GROUP = 131072

DUCKDB_TYPES = {"word": "VARCHAR", "number": "DOUBLE", 32: "UINTEGER", 64: "UBIGINT"}
POLARS_TYPES = {"word": polars.String, "number": polars.Float64, 32: polars.UInt32, 64: polars.UInt64}


def kind(name):
    """Bits of an unsigned integer, "word" or "number"."""
    return "word" if name in WORDS else UNSIGNED.get(name, "number")


class Expected:
    """What the CSV table of a command says."""

    def __init__(self, path):
        lines = path.read_text(encoding="utf-8").splitlines()
        self.comments = [line for line in lines if line.startswith("#")]
        header, *rows = csv.reader(line for line in lines if not line.startswith("#"))
        # Tables of motions have units in their header, those of sweeps in a comment.
        units = next((line for line in self.comments if line.startswith("# units: ")), ", ".join(header))
        units = re.findall(r"(\S+) \(([^)]*)\)", units.removeprefix("# units: "))
        self.units = {name: unit for name, unit in units if unit}
        self.names = [re.sub(r" \(.*\)$", "", name) for name in header]
        self.columns = {
            name: [value(name, row[column]) for row in rows] for column, name in enumerate(self.names)
        }
        self.rows = len(rows)


def value(name, text):
    if not text:
        return None
    return {"word": str, "number": float}.get(kind(name), int)(text)


def same(one, other):
    if isinstance(one, float) and isinstance(other, float):
        return struct.pack("<d", one) == struct.pack("<d", other)
    return type(one) is type(other) and one == other


def check_values(reader, expected, columns):
    assert list(columns) == expected.names, (reader, list(columns), expected.names)
    for name, values in columns.items():
        assert len(values) == expected.rows, (reader, name, len(values), expected.rows)
        for row, (found, wanted) in enumerate(zip(values, expected.columns[name])):
            assert same(found, wanted), f"{reader}: {name}, row {row}: {found!r} instead of {wanted!r}"


def check_with_duckdb(path, expected):
    table = duckdb.sql(f"from '{path}'")
    types = dict(zip(table.columns, map(str, table.types)))
    assert types == {name: DUCKDB_TYPES[kind(name)] for name in expected.names}, types
    check_values("DuckDB", expected, dict(zip(table.columns, zip(*table.fetchall()))))
    chunks = duckdb.sql(
        f"select path_in_schema, encodings, compression, row_group_id, row_group_num_rows from parquet_metadata('{path}')"
    ).fetchall()
    groups = {(number, rows) for *_, number, rows in chunks}
    full, rest = divmod(expected.rows, ROWS_OF_A_GROUP)
    assert sorted(groups) == list(enumerate([ROWS_OF_A_GROUP] * full + [rest] * (rest > 0))), groups
    for name, encodings, compression, *_ in chunks:
        assert compression == "SNAPPY", compression
        assert ("DICTIONARY" in encodings) == (kind(name) != "number") or kind(name) == 64, (name, encodings)
    schema = duckdb.sql(f"select name, repetition_type from parquet_schema('{path}')").fetchall()[1:]
    for name, repetition in schema:
        assert repetition == ("REQUIRED" if name in REQUIRED else "OPTIONAL"), (name, repetition)


def check_with_polars(path, expected):
    table = polars.read_parquet(path)
    types = {name: POLARS_TYPES[kind(name)] for name in expected.names}
    assert dict(table.schema) == types, table.schema
    check_values("Polars", expected, table.to_dict(as_series=False))


def check_metadata(path, command, expected):
    pairs = duckdb.sql(f"select key, value from parquet_kv_metadata('{path}')").fetchall()
    metadata = {key.decode(): value.decode() for key, value in pairs}
    keys = ["command", "model", "program", "units"]
    assert sorted(metadata) == [f"slideway.{key}" for key in keys], sorted(metadata)
    command, model, program, units = (metadata[f"slideway.{key}"] for key in keys)
    assert model == (TOP / words_of(command)[2]).read_text(encoding="utf-8")
    assert json.loads(units) == expected.units, (units, expected.units)
    if expected.comments:
        said = [line.removeprefix("# ").replace("table.csv", "table.parquet") for line in expected.comments[:2]]
        assert said == [program, command], (said, program, command)
    polars_metadata = polars.read_parquet_metadata(path)
    assert all(polars_metadata[key] == text for key, text in metadata.items())


def words_of(command):
    import shlex

    return shlex.split(command)


def run(slideway, command, output):
    done = subprocess.run([slideway, *command, "--output", output], cwd=TOP, capture_output=True, text=True)
    assert done.returncode == 0, (command, done.returncode, done.stderr)


def check(slideway, command, folder):
    table, path = folder / "table.csv", folder / "table.parquet"
    for output in (table, path):
        output.unlink(missing_ok=True)
        run(slideway, command, str(output))
    expected = Expected(table)
    assert expected.rows > 0
    check_with_duckdb(path, expected)
    check_with_polars(path, expected)
    check_metadata(path, command, expected)
    nulls = {name: values.count(None) for name, values in expected.columns.items() if None in values}
    numbers = [value for values in expected.columns.values() for value in values if isinstance(value, float)]
    assert all(map(math.isfinite, numbers))
    print(f"{' '.join(command)}: {expected.rows} rows, {path.stat().st_size} bytes, nulls in {len(nulls)} columns")
    return expected, nulls


def check_shards(slideway, command, folder):
    """The shards of a sweep, read as one table, are the table of one run, but for the branch."""
    results, table = folder / "results", folder / "whole.csv"
    run(slideway, command, str(table))
    for number in (2, 1, 3):
        run(slideway, [*command, "--shard", f"{number}/3"], str(results))
    expected = Expected(table)
    expected.names.remove("branch")
    shards = str(results / "*.parquet")
    check_values("Polars", expected, polars.read_parquet(shards).drop("determinant_sign").to_dict(as_series=False))
    rows = duckdb.sql(f"select * exclude (determinant_sign) from '{shards}' order by filename, file_row_number")
    check_values("DuckDB", expected, dict(zip(rows.columns, zip(*rows.fetchall()))))
    for number, path in enumerate(sorted(results.iterdir()), 1):
        metadata = polars.read_parquet_metadata(path)
        part = json.loads(metadata["slideway.shard"])["part"]
        points = polars.read_parquet(path)["point"].n_unique()
        assert (part["shard"], part["points"]) == (f"{number}/3", points), part
        assert re.fullmatch("[0-9a-f]{32}", metadata["slideway.checksum"]), metadata["slideway.checksum"]
    print(f"{' '.join(command)}: 3 shards, {expected.rows} rows")


def main():
    slideway = str(pathlib.Path(sys.argv[1]).resolve())
    seen = {}
    with tempfile.TemporaryDirectory() as folder:
        for command in COMMANDS:
            expected, nulls = check(slideway, command, pathlib.Path(folder))
            for name in expected.names:
                seen.setdefault(name, set()).update(set(expected.columns[name]) if kind(name) == "word" else set())
                if name in nulls:
                    seen[name].add(None)
        check_shards(slideway, COMMANDS[0], pathlib.Path(folder))
    # The commands do what they were chosen for.
    assert {"one", "several", "none", "no_position"} <= seen["status"], seen["status"]
    assert {"solution", "preload_gap", None} <= seen["kind"], seen["kind"]
    assert {"attainable", None} <= seen["attainability"], seen["attainability"]
    assert {"locking", "without_bound", "side_change", None} <= seen["breakpoint"], seen["breakpoint"]
    assert None in seen["branch"]
    assert any(None in words for name, words in seen.items() if name.endswith(".friction_force"))


if __name__ == "__main__":
    main()
