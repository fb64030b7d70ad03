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

/// A word as a shell takes it: plain, in quotes, or, if it is not printable or no UTF-8, byte by byte where
/// it has to be.
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
    use clap::ValueEnum;
    use slideway::sweep::{GridAxis, SweepOptions};
    use std::fs;
    use std::io::Read;
    use std::ops::ControlFlow;
    use std::path::Path;

    #[test]
    fn a_command_stays_on_one_line() {
        let words =
            ["slideway", "sweep", "it's.toml", "a\nb'\u{1b}]0;\u{9b}.toml", "--force", "--vary", "mu=0..1"];
        let told = command(words.into_iter().map(OsString::from));
        assert_eq!(told, r"slideway sweep 'it'\''s.toml' $'a\nb\'\033]0;\302\233.toml' --vary mu=0..1");
    }

    /// The rows of a sweep of the drawer, with these in place of some of its numbers.
    fn rows_with(wrong: [f64; 3]) -> (Sweep, Layout, Rows) {
        let text = slideway::gallery::find("drawer").expect("in the gallery").text;
        let model = slideway::model::Model::parse(text).expect("a model");
        let sweep =
            Sweep::new(&model, &SweepOptions::grid([GridAxis::linear("mu", 0.1, 0.5, 5)])).expect("a sweep");
        let mut all = Vec::new();
        sweep.run(&mut sweep.start(), &Rows::clone, &mut |parts, _| {
            all.extend(parts);
            ControlFlow::Continue(())
        });
        let mut rows = all.swap_remove(0);
        let (width, last) = (rows.width, rows.len() - 1);
        // The varied quantity, a number of a state, and the last cell.
        for (at, value) in [0, width + 1, last * width + width - 1].into_iter().zip(wrong) {
            assert!(rows.numbers[at].is_finite());
            rows.numbers[at] = value;
        }
        let layout = Layout::of(&sweep, rows.varied, false);
        (sweep, layout, rows)
    }

    /// The cells with numbers of a table, row by row; nothing where a cell says that there is none.
    fn cells(format: TableFormat, path: &Path, layout: &Layout) -> Vec<Option<f64>> {
        match format {
            TableFormat::Csv => csv_cells(&fs::read_to_string(path).expect("a table"), layout),
            TableFormat::Npz => {
                let mut archive =
                    zip::ZipArchive::new(fs::File::open(path).expect("a table")).expect("an archive");
                let mut array = Vec::new();
                archive.by_name("rows.npy").expect("rows").read_to_end(&mut array).expect("whole");
                let header = u32::from_le_bytes(array[8..12].try_into().expect("4 bytes"));
                npz_cells(&array[12 + header as usize..], layout)
            }
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => {
                use ::parquet::file::reader::{FileReader, SerializedFileReader};
                use ::parquet::record::Field;
                let reader =
                    SerializedFileReader::new(fs::File::open(path).expect("a table")).expect("Parquet");
                let rows = reader.get_row_iter(None).expect("rows").map(|row| row.expect("a row"));
                let names: Vec<&str> =
                    layout.varied.iter().chain(&layout.numbers).map(|(name, _)| name.as_str()).collect();
                let cells = rows.flat_map(|row| {
                    let columns: Vec<(String, Field)> = row.into_columns();
                    let numbers = columns.into_iter().filter(|(name, _)| names.contains(&name.as_str()));
                    numbers
                        .map(|(_, field)| if let Field::Double(value) = field { Some(value) } else { None })
                        .collect::<Vec<_>>()
                });
                cells.collect()
            }
        }
    }

    fn csv_cells(text: &str, layout: &Layout) -> Vec<Option<f64>> {
        let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
        let numbers = |line: &str| {
            let cells: Vec<&str> = line.split(',').collect();
            let (varied, others) =
                (&cells[1..=layout.varied.len()], &cells[cells.len() - layout.numbers.len()..]);
            let number = |cell: &&str| (!cell.is_empty()).then(|| cell.parse().expect("a number"));
            varied.iter().chain(others).map(number).collect::<Vec<_>>()
        };
        lines.flat_map(numbers).collect()
    }

    /// In records not a number stands where there is none.
    fn npz_cells(records: &[u8], layout: &Layout) -> Vec<Option<f64>> {
        let mut cells = Vec::new();
        for mut record in records.chunks_exact(record::size(layout)) {
            for field in record::fields(layout) {
                let (bytes, rest) = record.split_at(field.kind.size());
                record = rest;
                if field.kind == record::FieldKind::Number {
                    let value = f64::from_le_bytes(bytes.try_into().expect("8 bytes"));
                    cells.push((!value.is_nan()).then_some(value));
                }
            }
        }
        cells
    }

    #[test]
    fn what_is_not_finite_is_an_empty_cell_in_every_file() {
        let formats: &[TableFormat] = TableFormat::value_variants();
        for wrong in
            [[f64::INFINITY, f64::NEG_INFINITY, f64::NAN], [f64::NAN, f64::INFINITY, f64::NEG_INFINITY]]
        {
            let (sweep, layout, rows) = rows_with(wrong);
            let finite = |value: &f64| value.is_finite().then_some(*value);
            let expected: Vec<Option<f64>> = rows.numbers.iter().map(finite).collect();
            assert!(expected.iter().filter(|cell| cell.is_none()).count() >= 3);
            for &format in formats {
                let folder = tempfile::tempdir().expect("a folder");
                let path = folder.path().join("table");
                let metadata = Metadata { command: String::new(), model: String::new() };
                let encoder = Encoder::new(format, layout.clone(), metadata);
                let opened = PartialFile::open(&path, encoder.clone(), (false, false), sweep.start());
                let Continued { mut file, state } = opened.expect("a file");
                file.add(&[encoder.rows(&rows)], &state).expect("room");
                let flow = file.complete(&mut |_| ControlFlow::Continue(())).expect("room");
                assert!(flow.is_continue());
                assert_eq!(cells(format, &path, &layout), expected, "{format:?}");
            }
        }
    }
}
