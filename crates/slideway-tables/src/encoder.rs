//! Rows as bytes, in each form.

use crate::{Layout, Metadata, Part, TableFormat, csv, npz, record};
use slideway::sweep::Rows;
#[cfg(feature = "parquet")]
use {
    crate::ShardedSweep,
    slideway::sweep::{Shard, Sweep},
};

/// Rows as bytes, to be written one after the other.
#[derive(Debug, Clone)]
pub struct Encoder {
    pub(crate) format: TableFormat,
    pub(crate) layout: Layout,
    pub(crate) metadata: Metadata,
    /// If the table is a shard.
    pub(crate) part: Option<Part>,
}

impl Encoder {
    /// For tables of this form, with these columns, that tell this of themselves.
    pub fn new(format: TableFormat, layout: Layout, metadata: Metadata) -> Self {
        Self { format, layout, metadata, part: None }
    }

    /// For a shard of a sweep, which is `whole`.
    #[cfg(feature = "parquet")]
    pub(crate) fn shard(sharded: &ShardedSweep, whole: &Sweep, shard: Shard) -> Self {
        let options = &sharded.options;
        let layout = Layout::of(&whole.shard(shard), options.points.dimensions(), options.attainability);
        let part = Some(Part::new(sharded, whole, shard));
        Self { part, ..Self::new(TableFormat::Parquet, layout, sharded.metadata.clone()) }
    }

    /// The form of the tables.
    pub fn format(&self) -> TableFormat {
        self.format
    }

    /// The bytes that stand before the rows.
    pub fn head(&self) -> Vec<u8> {
        match self.format {
            TableFormat::Csv => csv::head(&self.layout, &self.metadata),
            TableFormat::Npz => npz::head(&self.layout),
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => Vec::new(),
        }
    }

    /// The bytes of rows.
    pub fn rows(&self, rows: &Rows) -> Vec<u8> {
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
    use crate::{Continued, PartialFile, Resume};
    use slideway::sweep::{GridAxis, Sweep, SweepOptions};
    use std::fs;
    use std::io::Read;
    use std::ops::ControlFlow;
    use std::path::Path;

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
        let formats = TableFormat::ALL;
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
                let opened = PartialFile::open(&path, encoder.clone(), (Resume::No, false), sweep.start());
                let Continued { mut file, state } = opened.expect("a file");
                file.add(&[encoder.rows(&rows)], &state).expect("room");
                let flow = file.complete(&state, &mut |_| ControlFlow::Continue(())).expect("room");
                assert!(flow.is_continue());
                assert_eq!(cells(format, &path, &layout), expected, "{format:?}");
            }
        }
    }
}
