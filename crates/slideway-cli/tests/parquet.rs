//! Parquet files: the same bytes whatever the threads, read by the library that wrote them.
//! `reference/parquet/check.py` reads them with other programs; `sweep.rs` interrupts them.

#![allow(clippy::unwrap_used)]

mod command;

use command::{command, slideway};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};
use std::fs::{self, File};
use std::path::Path;

const KLEPP: [&str; 4] = ["sweep", "models/klepp-2002.toml", "--set", "F_20=0"];

fn rows(path: &Path) -> Vec<Row> {
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    reader.get_row_iter(None).unwrap().map(Result::unwrap).collect()
}

fn metadata(path: &Path, key: &str) -> String {
    let reader = SerializedFileReader::new(File::open(path).unwrap()).unwrap();
    let pairs = reader.metadata().file_metadata().key_value_metadata().unwrap();
    pairs.iter().find(|pair| pair.key == key).unwrap().value.clone().unwrap()
}

fn field<'r>(row: &'r Row, name: &str) -> &'r Field {
    row.get_column_iter().find(|(column, _)| *column == name).unwrap().1
}

/// More rows than a group has, so that the order of groups would be seen.
#[test]
fn threads_do_not_change_the_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.parquet");
    let tables = ["1", "3"].map(|threads| {
        let arguments = [&KLEPP[..], &["--vary", "mu_1=0..0.8:100001", "--force", "--output"]].concat();
        let run = command(&arguments).arg(&path).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(run.status.success());
        fs::read(&path).unwrap()
    });
    assert!(tables[0] == tables[1]);
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    assert!(reader.num_row_groups() > 1);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// The drawer jams at mu >= L / (2 a) = 2/3 (book, chapter Limits): a point beyond has a row whose state is
/// null.
#[test]
fn what_does_not_exist_is_null() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("drawer.parquet");
    let run = slideway(&[
        "sweep",
        "models/drawer.toml",
        "--vary",
        "mu=0.5,0.7",
        "--no-breakpoints",
        "--attainability",
        "--output",
        path.to_str().unwrap(),
    ]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let rows = rows(&path);
    assert_eq!(rows.len(), 2);
    assert_eq!(field(&rows[0], "status"), &Field::Str("one".to_owned()));
    assert_eq!(field(&rows[0], "branch"), &Field::UInt(1));
    assert!(matches!(field(&rows[0], "normal_force.guide.front"), Field::Double(force) if force.is_finite()));
    assert_eq!(field(&rows[1], "status"), &Field::Str("none".to_owned()));
    assert_eq!(field(&rows[1], "point"), &Field::ULong(1));
    assert_eq!(field(&rows[1], "mu"), &Field::Double(0.7));
    assert_eq!(field(&rows[1], "solutions"), &Field::UInt(0));
    let nulls = ["breakpoint", "kind", "branch", "pattern", "attainability", "normal_force.guide.front"];
    for name in nulls {
        assert_eq!(field(&rows[1], name), &Field::Null, "{name}");
    }
}

/// The motion table: while the block sticks to the belt it moves uniformly, so that friction balances the spring (100 N/m);
/// while it slides, friction is 0.25 of its weight.
#[test]
fn a_motion_is_a_table_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motion.parquet");
    let name = path.to_str().unwrap();
    let run = slideway(&[
        "simulate",
        "models/stick-slip.toml",
        "--until",
        "2s",
        "--step",
        "0.01s",
        "--output",
        name,
    ]);
    assert_eq!(run.code, 0, "{}", run.stderr);
    let rows = rows(&path);
    assert_eq!(rows.len(), 201);
    assert_eq!(field(&rows[200], "t"), &Field::Double(2.0));
    let sticking = |row: &Row| matches!(field(row, "mode"), Field::Str(mode) if mode.contains('='));
    assert!(rows.iter().any(sticking) && !rows.iter().all(sticking));
    let number = |row: &Row, name: &str| match field(row, name) {
        Field::Double(number) => *number,
        other => panic!("{name} is {other} in {row}"),
    };
    for row in &rows {
        let expected = if sticking(row) { 100.0 * number(row, "x").abs() } else { 0.25 * 9.81 };
        assert!((number(row, "sole.friction_force").abs() - expected).abs() < 1e-9, "{row}");
    }
    assert!(
        metadata(&path, "slideway.command")
            .starts_with("slideway simulate models/stick-slip.toml --until 2s")
    );
    let model = fs::read_to_string(command::top().join("models/stick-slip.toml")).unwrap();
    assert_eq!(metadata(&path, "slideway.model"), model);
    assert!(metadata(&path, "slideway.units").contains(r#""t":"s""#));
}

/// Parquet files are made at the end, so that they cannot be streamed.
#[test]
fn a_stream_is_refused() {
    let arguments = [&KLEPP[..], &["--vary", "mu_1=0..0.8:3", "--format", "parquet"]].concat();
    let run = slideway(&arguments);
    assert!(run.code == 2 && run.stderr.contains("only be written to a file"), "{}", run.stderr);
}
