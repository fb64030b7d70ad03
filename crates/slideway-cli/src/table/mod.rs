//! Tables of a sweep: rows as they come, in files that can be continued.

mod csv;
pub(crate) mod npz;
#[cfg(feature = "parquet")]
pub(crate) mod parquet;
mod partial;
mod record;

pub(crate) use partial::{Continued, PartialFile, unfinished};

use crate::arguments::TableFormat;
use crate::input::Input;
use slideway::printable;
use slideway::sweep::{Rows, Sweep};
use std::ffi::{OsStr, OsString};

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

/// The command as it may be given again, on one line.
fn command(arguments: impl Iterator<Item = OsString>) -> String {
    let kept = arguments.skip(1).filter(|word| !LEFT_OUT.iter().any(|left_out| word == left_out));
    kept.fold("slideway".to_owned(), |command, word| format!("{command} {}", quoted(&word)))
}

/// A word as a shell takes it: plain, in quotes, or, if it is not printable or no UTF-8, byte by byte where it has to be.
fn quoted(word: &OsStr) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+%@".contains(c);
    match word.to_str() {
        Some(text) if !text.is_empty() && text.chars().all(plain) => text.to_owned(),
        Some(text) if printable::line(text) == text => format!("'{}'", text.replace('\'', "'\\''")),
        _ => {
            let bytes = word.as_encoded_bytes().iter().map(|byte| match byte {
                b'\n' => "\\n".to_owned(),
                b'\'' | b'\\' => format!("\\{}", char::from(*byte)),
                b' '..=b'~' => char::from(*byte).to_string(),
                other => format!("\\{other:03o}"),
            });
            format!("$'{}'", bytes.collect::<String>())
        }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_stays_on_one_line() {
        let words =
            ["slideway", "sweep", "it's.toml", "a\nb'\u{1b}]0;\u{9b}.toml", "--force", "--vary", "mu=0..1"];
        let told = command(words.into_iter().map(OsString::from));
        assert_eq!(told, r"slideway sweep 'it'\''s.toml' $'a\nb\'\033]0;\302\233.toml' --vary mu=0..1");
    }
}
