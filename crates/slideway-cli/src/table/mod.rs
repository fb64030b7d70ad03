//! Tables of a sweep: rows as they come, in files that can be continued.

mod csv;
pub(crate) mod npz;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
mod partial;
mod record;

pub(crate) use partial::{Continued, PartialFile};

use crate::arguments::TableFormat;
use crate::input::Input;
use slideway::sweep::{Rows, Sweep};
use std::ffi::OsString;

/// Arguments that do not change a table.
const LEFT_OUT: [&str; 2] = ["--resume", "--force"];

/// What every table tells of itself.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Metadata {
    /// The command that made it.
    pub(crate) command: String,
    /// The text of the model.
    pub(crate) model: String,
}

impl Metadata {
    /// The command of this run and its model.
    pub(crate) fn of(input: &Input) -> Self {
        Self { command: command(std::env::args_os()), model: input.text() }
    }

    /// The program that made it.
    pub(crate) fn program() -> String {
        format!("slideway {}", env!("CARGO_PKG_VERSION"))
    }
}

/// The command as it may be given again.
fn command(arguments: impl Iterator<Item = OsString>) -> String {
    let words = arguments.skip(1).map(|word| word.to_string_lossy().into_owned());
    let kept = words.filter(|word| !LEFT_OUT.contains(&word.as_str()));
    kept.fold("slideway".to_owned(), |command, word| format!("{command} {}", quoted(&word)))
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// The columns of a table besides its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout {
    /// Names and units of the varied quantities.
    pub(crate) varied: Vec<(String, &'static str)>,
    /// Names and units of the numbers of a state.
    pub(crate) numbers: Vec<(String, &'static str)>,
    pub(crate) contacts: usize,
    /// Whether there is a column for the attainability.
    pub(crate) attainability: bool,
}

impl Layout {
    /// The columns of a sweep.
    pub(crate) fn of(sweep: &Sweep, varied: usize, attainability: bool) -> Self {
        let columns = sweep.columns().iter().map(|column| (column.name.clone(), column.unit));
        let mut varied_columns: Vec<_> = columns.collect();
        let numbers = varied_columns.split_off(varied);
        Self { varied: varied_columns, numbers, contacts: sweep.contacts().count(), attainability }
    }
}

/// Rows as bytes, to be written one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Encoder {
    format: TableFormat,
    layout: Layout,
    metadata: Metadata,
}

impl Encoder {
    pub(crate) fn new(format: TableFormat, layout: Layout, metadata: Metadata) -> Self {
        Self { format, layout, metadata }
    }

    /// What stands before the rows.
    pub(crate) fn head(&self) -> Vec<u8> {
        match self.format {
            TableFormat::Csv => csv::head(&self.layout, &self.metadata),
            TableFormat::Npz => npz::head(&self.layout),
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => Vec::new(),
        }
    }

    /// Rows.
    pub(crate) fn rows(&self, rows: &Rows) -> Vec<u8> {
        match self.format {
            TableFormat::Csv => csv::rows(&self.layout, rows),
            TableFormat::Npz => record::rows(&self.layout, rows),
            // The records that the file is made from.
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => record::rows(&self.layout, rows),
        }
    }
}
