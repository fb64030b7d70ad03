//! Rows as columns of Apache Arrow: what data frames of other programs take without text between.
//!
//! [`columns`] makes columns of some rows in any thread, [`ArrowTable`] puts them together in the order of the rows, so
//! that they are made while other threads still compute. Its records are those of a NumPy file.

use crate::Layout;
use crate::record::{Field, FieldKind, Meaning, fields};
use ::arrow_array::builder::{ArrayBuilder, Float64Builder, StringBuilder, UInt32Builder, UInt64Builder};
use ::arrow_array::cast::AsArray;
use ::arrow_array::types::{Float64Type, UInt32Type, UInt64Type};
use ::arrow_array::{Array, ArrayRef, RecordBatch, RecordBatchIterator, RecordBatchReader};
use ::arrow_schema::{ArrowError, DataType, Field as Column, Schema, SchemaRef};
use rayon::prelude::*;
use slideway::report::defined;
use slideway::sweep::{RowHead, Rows};
use std::collections::HashMap;
use std::mem;
use std::sync::Arc;

/// Rows of a batch, about: room for so many is made at once.
const BATCH: usize = 1 << 18;

/// Records that are written at a time: these stay in the cache of a processor until every column is in them.
const TILE: usize = 512;

/// The columns of a table; those of numbers have their `unit` as metadata.
pub fn schema(layout: &Layout) -> SchemaRef {
    let units: HashMap<&str, &str> =
        layout.varied.iter().chain(&layout.numbers).map(|(name, unit)| (name.as_str(), *unit)).collect();
    let column = |field: &Field| {
        let (kind, nullable) = match field.kind {
            FieldKind::Point => (DataType::UInt64, false),
            FieldKind::Count => (DataType::UInt32, false),
            FieldKind::Branch => (DataType::UInt32, true),
            FieldKind::Number => (DataType::Float64, true),
            FieldKind::Word(_) => (DataType::Utf8, true),
        };
        let column = Column::new(&field.name, kind, nullable);
        match units.get(&*field.name) {
            Some(unit) => column.with_metadata(HashMap::from([("unit".to_owned(), (*unit).to_owned())])),
            None => column,
        }
    };
    Arc::new(Schema::new(fields(layout).iter().map(column).collect::<Vec<_>>()))
}

/// The columns of rows, for [`ArrowTable::append`].
pub fn columns(layout: &Layout, rows: &Rows) -> Vec<ArrayRef> {
    fields(layout).iter().map(|field| column(field, rows)).collect()
}

/// Builds one column of rows.
fn column(field: &Field, rows: &Rows) -> ArrayRef {
    let heads = rows.heads.iter();
    let room = (rows.len(), rows.len() * field.kind.size());
    match field.meaning {
        Meaning::Point => {
            let mut points = UInt64Builder::with_capacity(rows.len());
            points.extend(heads.map(|head| Some(head.point)));
            Arc::new(points.finish())
        }
        Meaning::Number(at) => {
            let mut numbers = Float64Builder::with_capacity(rows.len());
            numbers.extend(rows.numbers.iter().skip(at).step_by(rows.width).map(|number| defined(*number)));
            Arc::new(numbers.finish())
        }
        Meaning::Solutions => counts(rows, |head| Some(head.solutions)),
        Meaning::GapStates => counts(rows, |head| Some(head.gap_states)),
        Meaning::Rejected => counts(rows, |head| Some(head.rejected)),
        Meaning::Branch => counts(rows, |head| (head.branch > 0).then_some(head.branch)),
        Meaning::Breakpoint => words(room, heads.map(|head| head.breakpoint.word())),
        Meaning::Status => words(room, heads.map(|head| head.status.word())),
        Meaning::Kind => words(room, heads.map(|head| head.kind.word())),
        Meaning::Attainability => words(room, heads.map(|head| head.verdict.word())),
        Meaning::DeterminantSign => words(room, heads.map(RowHead::determinant_sign)),
        Meaning::Pattern => {
            let pattern = |row| std::str::from_utf8(rows.pattern(row).trim_ascii()).unwrap_or_default();
            words(room, (0..rows.len()).map(pattern))
        }
    }
}

fn counts(rows: &Rows, count: impl Fn(&RowHead) -> Option<u32>) -> ArrayRef {
    let mut counts = UInt32Builder::with_capacity(rows.len());
    counts.extend(rows.heads.iter().map(count));
    Arc::new(counts.finish())
}

/// So many words with so many bytes at most; nothing in place of an empty one.
fn words<'w>((count, bytes): (usize, usize), words: impl Iterator<Item = &'w str>) -> ArrayRef {
    let mut column = StringBuilder::with_capacity(count, bytes);
    column.extend(words.map(|word| (!word.is_empty()).then_some(word)));
    Arc::new(column.finish())
}

/// A column that is being put together.
#[derive(Debug)]
enum Growing {
    Points(UInt64Builder),
    Counts(UInt32Builder),
    Numbers(Float64Builder),
    Words(StringBuilder),
}

impl Growing {
    /// With room for so many rows.
    fn new(kind: FieldKind, rows: usize) -> Self {
        match kind {
            FieldKind::Point => Self::Points(UInt64Builder::with_capacity(rows)),
            FieldKind::Count | FieldKind::Branch => Self::Counts(UInt32Builder::with_capacity(rows)),
            FieldKind::Number => Self::Numbers(Float64Builder::with_capacity(rows)),
            FieldKind::Word(length) => Self::Words(StringBuilder::with_capacity(rows, rows * length)),
        }
    }

    fn append(&mut self, column: &dyn Array) -> Result<(), ArrowError> {
        match self {
            Self::Points(builder) => builder.append_array(column.as_primitive::<UInt64Type>()),
            Self::Counts(builder) => builder.append_array(column.as_primitive::<UInt32Type>()),
            Self::Numbers(builder) => builder.append_array(column.as_primitive::<Float64Type>()),
            Self::Words(builder) => builder.append_array(column.as_string::<i32>())?,
        }
        Ok(())
    }

    fn builder(&mut self) -> &mut dyn ArrayBuilder {
        match self {
            Self::Points(builder) => builder,
            Self::Counts(builder) => builder,
            Self::Numbers(builder) => builder,
            Self::Words(builder) => builder,
        }
    }
}

/// A table in columns.
#[derive(Debug)]
pub struct ArrowTable {
    fields: Vec<Field>,
    schema: SchemaRef,
    /// Rows for which room is made.
    room: usize,
    /// The columns of the batch that is not complete; nothing if it has no rows.
    growing: Vec<Growing>,
    batches: Vec<RecordBatch>,
}

impl ArrowTable {
    /// A table without rows, of so many points.
    pub fn new(layout: &Layout, points: u64) -> Self {
        let room = usize::try_from(points).map_or(BATCH, |points| points.min(BATCH));
        let (growing, batches) = (Vec::new(), Vec::new());
        Self { fields: fields(layout), schema: schema(layout), room, growing, batches }
    }

    /// Appends rows, by their [`columns`].
    ///
    /// # Errors
    /// If the words of a column become too long for Arrow.
    pub fn append(&mut self, columns: &[ArrayRef]) -> Result<(), ArrowError> {
        let more = columns.first().map_or(0, Array::len);
        let rows = self.growing.first_mut().map_or(0, |points| points.builder().len());
        // Beyond its room, a column would be copied.
        if rows + more > BATCH {
            self.complete()?;
        }
        if self.growing.is_empty() {
            self.growing = self.fields.iter().map(|field| Growing::new(field.kind, self.room)).collect();
        }
        self.growing.iter_mut().zip(columns).try_for_each(|(growing, column)| growing.append(column))
    }

    /// Completes a batch: [`Self::reader`] and [`Self::records`] have the rows that were appended before.
    ///
    /// # Errors
    /// None, if the columns of all rows were of this layout.
    pub fn complete(&mut self) -> Result<(), ArrowError> {
        let mut whole = mem::take(&mut self.growing);
        if !whole.is_empty() {
            let columns = whole.iter_mut().map(|column| column.builder().finish()).collect();
            self.batches.push(RecordBatch::try_new(self.schema.clone(), columns)?);
        }
        Ok(())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.batches.iter().map(RecordBatch::num_rows).sum()
    }

    /// The rows in batches, which share the memory of the table.
    pub fn reader(&self) -> impl RecordBatchReader + Send + 'static {
        let batches: Vec<_> = self.batches.iter().cloned().map(Ok).collect();
        RecordBatchIterator::new(batches, self.schema.clone())
    }

    /// The rows as records: the elements of a NumPy array whose fields are [`Layout::fields`].
    pub fn records(&self) -> Vec<u8> {
        let size: usize = self.fields.iter().map(|field| field.kind.size()).sum();
        let mut records = vec![0; self.rows() * size];
        let mut rest = &mut records[..];
        for batch in &self.batches {
            let (own, others) = rest.split_at_mut(batch.num_rows() * size);
            rest = others;
            own.par_chunks_mut(TILE * size).enumerate().for_each(|(tile, records)| {
                let mut start = 0;
                for (field, column) in self.fields.iter().zip(batch.columns()) {
                    let column = column.slice(tile * TILE, records.len() / size);
                    fill(
                        records.chunks_exact_mut(size).map(|record| &mut record[start..]),
                        field.kind,
                        &column,
                    );
                    start += field.kind.size();
                }
            });
        }
        records
    }
}

/// Writes a column into the records of its rows, each from the byte on at which the field begins.
fn fill<'r>(records: impl Iterator<Item = &'r mut [u8]>, kind: FieldKind, column: &dyn Array) {
    match kind {
        FieldKind::Point => {
            let points = column.as_primitive::<UInt64Type>().values().iter();
            write(records, points.map(|point| point.to_le_bytes()));
        }
        FieldKind::Count | FieldKind::Branch => {
            let counts = column.as_primitive::<UInt32Type>().iter();
            write(records, counts.map(|count| count.unwrap_or(0).to_le_bytes()));
        }
        FieldKind::Number => {
            let numbers = column.as_primitive::<Float64Type>().iter();
            write(records, numbers.map(|number| number.unwrap_or(f64::NAN).to_le_bytes()));
        }
        FieldKind::Word(_) => write(records, column.as_string::<i32>().iter().map(Option::unwrap_or_default)),
    }
}

fn write<'r, B: AsRef<[u8]>>(records: impl Iterator<Item = &'r mut [u8]>, values: impl Iterator<Item = B>) {
    for (record, value) in records.zip(values) {
        let value = value.as_ref();
        record[..value.len()].copy_from_slice(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record;
    use slideway::model::Model;
    use slideway::sweep::{GridAxis, Sweep, SweepOptions};
    use std::ops::ControlFlow;

    /// Of a sweep with numbers that are missing, branches that end, and every column.
    #[test]
    fn columns_hold_what_records_hold() {
        let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
        let model = Model::parse(text).expect("a model");
        let axis = GridAxis::linear("mu_1", 0.0, 2.0, 2001);
        let options = SweepOptions::grid([axis]).attainability(true).all_columns(true);
        let sweep = Sweep::new(&model, &options).expect("a sweep");
        let layout = Layout::of(&sweep, 1, true);
        let (mut table, mut expected) = (ArrowTable::new(&layout, sweep.points()), Vec::new());
        let encode = |rows: &Rows| (columns(&layout, rows), record::rows(&layout, rows));
        sweep.run(&mut sweep.start(), &encode, &mut |parts, _| {
            for (columns, records) in parts {
                table.append(&columns).expect("columns of the layout");
                table.complete().expect("columns of the layout");
                expected.extend(records);
            }
            ControlFlow::Continue(())
        });
        let has_nothing = |batch: &RecordBatch| batch.columns().iter().any(|column| column.null_count() > 0);
        assert!(table.batches.len() > 1 && table.batches.iter().any(has_nothing));
        assert_eq!(table.rows() * layout.record(), expected.len());
        assert!(table.records() == expected);
        assert_eq!(
            table.reader().map(|batch| batch.expect("a batch").num_rows()).sum::<usize>(),
            table.rows()
        );
    }
}
