//! Records as Apache Arrow: what data frames of other programs take without text between.

use crate::Layout;
use crate::record::{Field, FieldKind, fields};
use ::arrow_array::{
    ArrayRef, Float64Array, RecordBatch, RecordBatchReader, StringArray, UInt32Array, UInt64Array,
};
use ::arrow_schema::{ArrowError, DataType, Field as Column, Schema, SchemaRef};
use rayon::prelude::*;
use std::array;
use std::collections::HashMap;
use std::sync::Arc;

/// Rows of a batch.
const BATCH: usize = 1 << 18;

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
        let columns = columns.into_par_iter().map(|(kind, start)| column(records, size, (kind, start)));
        RecordBatch::try_new(self.schema.clone(), columns.collect())
    }
}

/// One column of records of this size, whose field begins at `start`.
fn column(records: &[u8], size: usize, (kind, start): (FieldKind, usize)) -> ArrayRef {
    match kind {
        FieldKind::Point => {
            Arc::new(UInt64Array::from_iter_values(numbers(records, size, start).map(u64::from_le_bytes)))
        }
        FieldKind::Count => {
            Arc::new(UInt32Array::from_iter_values(numbers(records, size, start).map(u32::from_le_bytes)))
        }
        FieldKind::Branch => {
            let branches = numbers(records, size, start).map(u32::from_le_bytes);
            Arc::new(branches.map(|branch| (branch > 0).then_some(branch)).collect::<UInt32Array>())
        }
        FieldKind::Number => {
            let numbers = numbers(records, size, start).map(f64::from_le_bytes);
            Arc::new(numbers.map(|number| (!number.is_nan()).then_some(number)).collect::<Float64Array>())
        }
        FieldKind::Word(length) => {
            let words = records.chunks_exact(size).map(|record| {
                let word = &record[start..start + length];
                let end = word.iter().position(|byte| *byte == 0).unwrap_or(length);
                std::str::from_utf8(&word[..end]).ok().filter(|word| !word.is_empty())
            });
            Arc::new(words.collect::<StringArray>())
        }
    }
}

/// The bytes of a field in each record.
fn numbers<const SIZE: usize>(
    records: &[u8],
    record: usize,
    start: usize,
) -> impl Iterator<Item = [u8; SIZE]> {
    records.chunks_exact(record).map(move |record| array::from_fn(|index| record[start + index]))
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
