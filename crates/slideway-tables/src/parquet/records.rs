//! Parquet files from records.

use super::{Column, ColumnKind, GROUP, MANIFEST, ParquetTable, Values, seal};
use crate::record::{Field, FieldKind, fields};
use crate::{Encoder, Layout, Manifest};
use ::parquet::data_type::ByteArray;
use slideway::report::defined;
use slideway::sweep::Tally;
use std::array;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::ops::ControlFlow;

/// Makes a Parquet file of so many bytes of records, sealed if it is a shard, which comes to `tally`. `go_on`
/// receives the fraction that is done, and breaks to end the work early.
///
/// # Errors
/// If a file cannot be read or written.
pub(crate) fn convert(
    (mut records, bytes): (&File, u64),
    (encoder, tally): (&Encoder, &Tally),
    sink: &File,
    go_on: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> io::Result<ControlFlow<()>> {
    let Encoder { layout, metadata, part, .. } = encoder;
    let fields = fields(layout);
    let columns = columns(&fields, layout);
    let mut table = match part {
        None => ParquetTable::new(sink, &columns, metadata)?,
        Some(part) => {
            let manifest = Manifest { part: part.clone(), tally: tally.clone() };
            let more = [(MANIFEST, serde_json::to_string(&manifest)?), seal::placeholder()];
            ParquetTable::new_with(sink, &columns, metadata, more)?
        }
    };
    let record: usize = fields.iter().map(|field| field.kind.size()).sum();
    records.seek(SeekFrom::Start(0))?;
    let mut left = bytes;
    while left > 0 {
        if go_on(1.0 - left as f64 / bytes as f64).is_break() {
            return Ok(ControlFlow::Break(()));
        }
        let size = left.min((record * GROUP) as u64);
        let mut group = Vec::new();
        records.take(size).read_to_end(&mut group)?;
        if group.len() as u64 != size {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        let group = Group { records: group.into(), record };
        let mut offset = 0;
        table.add(fields.iter().map(|field| {
            let start = offset;
            offset += field.kind.size();
            group.values(field.kind, start)
        }))?;
        left -= size;
    }
    table.finish()?;
    if part.is_some() {
        seal::seal(sink)?;
    }
    Ok(ControlFlow::Continue(()))
}

/// The columns of fields.
pub(super) fn columns(fields: &[Field], layout: &Layout) -> Vec<Column> {
    let numbers = || layout.varied.iter().chain(&layout.numbers);
    let column = |field: &Field| Column {
        name: field.name.clone(),
        kind: match field.kind {
            FieldKind::Point => ColumnKind::Unsigned64,
            FieldKind::Count => ColumnKind::Unsigned32 { nullable: false },
            FieldKind::Branch => ColumnKind::Unsigned32 { nullable: true },
            FieldKind::Number => ColumnKind::Number,
            FieldKind::Word(_) => ColumnKind::Word,
        },
        unit: numbers().find(|(name, _)| *name == field.name).map_or("", |(_, unit)| unit),
    };
    fields.iter().map(column).collect()
}

/// Records, and the bytes of each.
struct Group {
    records: ByteArray,
    record: usize,
}

impl Group {
    /// Returns the values of the field that begins at this byte of each record.
    fn values(&self, kind: FieldKind, start: usize) -> Values {
        match kind {
            FieldKind::Point => Values::Unsigned64(self.fields(start).map(u64::from_le_bytes).collect()),
            FieldKind::Count => {
                Values::Unsigned32(self.fields(start).map(|bytes| Some(u32::from_le_bytes(bytes))).collect())
            }
            FieldKind::Branch => {
                let branches = self.fields(start).map(u32::from_le_bytes);
                Values::Unsigned32(branches.map(|branch| (branch > 0).then_some(branch)).collect())
            }
            FieldKind::Number => {
                let numbers = self.fields(start).map(f64::from_le_bytes);
                Values::Number(numbers.map(defined).collect())
            }
            FieldKind::Word(size) => Values::Word(self.words(start, size).collect()),
        }
    }

    /// The bytes of a field in each record.
    fn fields<const SIZE: usize>(&self, start: usize) -> impl Iterator<Item = [u8; SIZE]> {
        let records = self.records.data().chunks_exact(self.record);
        records.map(move |record| array::from_fn(|index| record[start + index]))
    }

    /// The word of each record; nothing where it is empty.
    fn words(&self, start: usize, size: usize) -> impl Iterator<Item = Option<ByteArray>> {
        let records = self.records.data().chunks_exact(self.record);
        records.enumerate().map(move |(row, record)| {
            let length = record[start..start + size].iter().take_while(|byte| **byte != 0).count();
            (length > 0).then(|| self.records.slice(row * self.record + start, length))
        })
    }
}
