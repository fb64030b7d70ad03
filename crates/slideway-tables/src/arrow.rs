//! Records as Apache Arrow: what data frames of other programs take without text between.

use crate::Layout;
use crate::record::{Field, FieldKind, fields};
use ::arrow_array::builder::{ArrayBuilder, Float64Builder, StringBuilder, UInt32Builder, UInt64Builder};
use ::arrow_array::{ArrayRef, RecordBatch, RecordBatchReader};
use ::arrow_schema::{ArrowError, DataType, Field as Column, Schema, SchemaRef};
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Rows of a batch.
const BATCH: usize = 1 << 18;

/// Columns that one task takes out of all records of a batch, and records that it reads at a time: these stay in the
/// cache of a processor until all of these columns have what is theirs.
const COLUMNS: usize = 8;
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

/// The records of a table as batches, each made when it is asked for.
#[derive(Debug)]
pub struct Batches {
    records: Arc<Vec<u8>>,
    fields: Vec<Field>,
    schema: SchemaRef,
    next: usize,
}

impl Batches {
    /// Of records as [`Encoder::records`](crate::Encoder::records) encodes them.
    pub fn new(layout: &Layout, records: Arc<Vec<u8>>) -> Self {
        Self { records, fields: fields(layout), schema: schema(layout), next: 0 }
    }

    fn batch(&self, rows: std::ops::Range<usize>) -> Result<RecordBatch, ArrowError> {
        let size: usize = self.fields.iter().map(|field| field.kind.size()).sum();
        let records = &self.records[rows.start * size..rows.end * size];
        let starts = self.fields.iter().scan(0, |start, field| {
            *start += field.kind.size();
            Some(*start - field.kind.size())
        });
        let columns: Vec<(FieldKind, usize)> =
            self.fields.iter().map(|field| field.kind).zip(starts).collect();
        let columns: Vec<_> =
            columns.par_chunks(COLUMNS).map(|columns| gathered(records, size, columns)).collect();
        RecordBatch::try_new(self.schema.clone(), columns.concat())
    }
}

/// Columns of records of this size, each given by what its field holds and where it begins.
fn gathered(records: &[u8], size: usize, columns: &[(FieldKind, usize)]) -> Vec<ArrayRef> {
    let rows = records.len() / size;
    let mut growing: Vec<Growing> = columns.iter().map(|(kind, _)| Growing::new(*kind, rows)).collect();
    for tile in records.chunks(TILE * size) {
        for (column, (_, start)) in growing.iter_mut().zip(columns) {
            column.extend(tile, size, *start);
        }
    }
    growing.iter_mut().map(|column| column.builder().finish()).collect()
}

/// A column that is being built.
enum Growing {
    Points(UInt64Builder),
    Counts(UInt32Builder),
    Branches(UInt32Builder),
    Numbers(Float64Builder),
    /// Words of at most so many bytes.
    Words(usize, StringBuilder),
}

impl Growing {
    fn new(kind: FieldKind, rows: usize) -> Self {
        match kind {
            FieldKind::Point => Self::Points(UInt64Builder::with_capacity(rows)),
            FieldKind::Count => Self::Counts(UInt32Builder::with_capacity(rows)),
            FieldKind::Branch => Self::Branches(UInt32Builder::with_capacity(rows)),
            FieldKind::Number => Self::Numbers(Float64Builder::with_capacity(rows)),
            FieldKind::Word(length) => Self::Words(length, StringBuilder::with_capacity(rows, rows * length)),
        }
    }

    fn builder(&mut self) -> &mut dyn ArrayBuilder {
        match self {
            Self::Points(builder) => builder,
            Self::Counts(builder) | Self::Branches(builder) => builder,
            Self::Numbers(builder) => builder,
            Self::Words(_, builder) => builder,
        }
    }

    /// Appends a field of these records.
    fn extend(&mut self, records: &[u8], size: usize, start: usize) {
        match self {
            Self::Points(builder) => {
                builder.extend(numbers(records, size, start).map(|bytes| Some(u64::from_le_bytes(bytes))));
            }
            Self::Counts(builder) => {
                builder.extend(numbers(records, size, start).map(|bytes| Some(u32::from_le_bytes(bytes))));
            }
            Self::Branches(builder) => {
                let branches = numbers(records, size, start).map(u32::from_le_bytes);
                builder.extend(branches.map(|branch| (branch > 0).then_some(branch)));
            }
            Self::Numbers(builder) => {
                let numbers = numbers(records, size, start).map(f64::from_le_bytes);
                builder.extend(numbers.map(|number| (!number.is_nan()).then_some(number)));
            }
            Self::Words(length, builder) => {
                // The same word stands in many rows, one behind the other.
                let (mut last, mut text): (&[u8], _) = (&[], None);
                for record in records.chunks_exact(size) {
                    let word = &record[start..start + *length];
                    if word != last {
                        let end = word.iter().position(|byte| *byte == 0).unwrap_or(*length);
                        text = std::str::from_utf8(&word[..end]).ok().filter(|text| !text.is_empty());
                        last = word;
                    }
                    builder.append_option(text);
                }
            }
        }
    }
}

/// The bytes of a field in each record.
fn numbers<const SIZE: usize>(
    records: &[u8],
    record: usize,
    start: usize,
) -> impl Iterator<Item = [u8; SIZE]> {
    records.chunks_exact(record).filter_map(move |record| record[start..start + SIZE].first_chunk().copied())
}

impl Iterator for Batches {
    type Item = Result<RecordBatch, ArrowError>;

    fn next(&mut self) -> Option<Self::Item> {
        let size: usize = self.fields.iter().map(|field| field.kind.size()).sum();
        let rows = self.records.len() / size;
        if self.next >= rows {
            return None;
        }
        let end = (self.next + BATCH).min(rows);
        let batch = self.batch(self.next..end);
        self.next = end;
        Some(batch)
    }
}

impl RecordBatchReader for Batches {
    fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }
}
