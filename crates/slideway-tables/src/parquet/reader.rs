//! Rows from the file of a shard.

use super::records::columns;
use crate::Layout;
use crate::record::{Field, FieldKind, Meaning, fields};
use ::parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use ::parquet::data_type::{ByteArray, DataType};
use ::parquet::errors::ParquetError;
use ::parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use slideway::report::Verdict;
use slideway::sweep::{Breakpoint, PointStatus, RowHead, RowKind, Rows, Sweep};
use std::fs::File;
use std::mem;

/// Reads rows, group by group.
pub(crate) struct ShardReader<'s> {
    reader: SerializedFileReader<File>,
    sweep: &'s Sweep,
    fields: Vec<Field>,
    next: usize,
    /// Rows of the last point so far: more of them may follow.
    pending: Rows,
}

/// Builds the error of a file that does not hold what it should.
fn unexpected() -> ParquetError {
    ParquetError::General("unexpected columns or values".to_owned())
}

impl<'s> ShardReader<'s> {
    /// Reads the file of a shard of a sweep, with these columns.
    ///
    /// # Errors
    /// If it cannot be read, or has other columns.
    pub(crate) fn new(file: File, sweep: &'s Sweep, layout: &Layout) -> Result<Self, ParquetError> {
        let reader = SerializedFileReader::new(file)?;
        let fields = fields(layout);
        let schema = reader.metadata().file_metadata().schema_descr();
        let found = schema.columns().iter().map(|column| column.name());
        if !found.eq(columns(&fields, layout).iter().map(|column| column.name.as_str())) {
            return Err(unexpected());
        }
        let width = layout.varied.len() + layout.numbers.len();
        Ok(Self {
            reader,
            sweep,
            fields,
            next: 0,
            pending: Rows::new(layout.contacts, layout.varied.len(), width),
        })
    }

    /// The next rows, all of each point; none at the end.
    ///
    /// # Errors
    /// If they cannot be read, or are none.
    pub(crate) fn rows(&mut self) -> Result<Option<Rows>, ParquetError> {
        while self.next < self.reader.num_row_groups() {
            self.read()?;
            let is_last = self.next == self.reader.num_row_groups();
            let point = self.pending.heads.last().map(|head| head.point);
            let whole = self.pending.heads.partition_point(|head| is_last || Some(head.point) < point);
            if whole > 0 {
                return Ok(Some(first(&mut self.pending, whole)));
            }
        }
        Ok(None)
    }

    /// Appends the next group to what is pending.
    fn read(&mut self) -> Result<(), ParquetError> {
        let group = self.reader.get_row_group(self.next)?;
        self.next += 1;
        let rows = &mut self.pending;
        let start = rows.len();
        let count = usize::try_from(group.metadata().num_rows()).map_err(|_| unexpected())?;
        rows.heads.resize(start + count, HEAD);
        rows.numbers.resize((start + count) * rows.width, f64::NAN);
        rows.patterns.resize((start + count) * rows.contacts, b' ');
        for (index, field) in self.fields.iter().enumerate() {
            read_column((&*group, index), field, rows, start)?;
        }
        for head in &mut rows.heads[start..] {
            head.inserted = head.breakpoint != Breakpoint::No && self.sweep.is_inserted(head.point);
        }
        Ok(())
    }
}

/// A row of which nothing is known yet.
const HEAD: RowHead = RowHead::of_point(0, PointStatus::Unknown);

/// Takes the first rows away from the others, and counts their points.
fn first(rows: &mut Rows, count: usize) -> Rows {
    let mut others = Rows::new(rows.contacts, rows.varied, rows.width);
    others.heads = rows.heads.split_off(count);
    others.numbers = rows.numbers.split_off(count * rows.width);
    others.patterns = rows.patterns.split_off(count * rows.contacts);
    let mut first = mem::replace(rows, others);
    first.points = first.heads.chunk_by(|one, other| one.point == other.point).count() as u64;
    first
}

/// Puts the values of a column into rows, from this one on.
fn read_column(
    (group, index): (&dyn RowGroupReader, usize),
    field: &Field,
    rows: &mut Rows,
    start: usize,
) -> Result<(), ParquetError> {
    let count = rows.len() - start;
    let width = rows.width;
    let heads = &mut rows.heads[start..];
    match (group.get_column_reader(index)?, field.kind) {
        (ColumnReader::Int64ColumnReader(column), FieldKind::Point) => {
            for (head, point) in heads.iter_mut().zip(values(column, count)?) {
                head.point = point.ok_or_else(unexpected)?.cast_unsigned();
            }
        }
        (ColumnReader::Int32ColumnReader(column), FieldKind::Count) => {
            for (head, count) in heads.iter_mut().zip(values(column, count)?) {
                let count = count.ok_or_else(unexpected)?.cast_unsigned();
                match field.meaning {
                    Meaning::Solutions => head.solutions = count,
                    Meaning::GapStates => head.gap_states = count,
                    _ => head.rejected = count,
                }
            }
        }
        (ColumnReader::DoubleColumnReader(column), FieldKind::Number) => {
            let Meaning::Number(at) = field.meaning else { return Err(unexpected()) };
            let cells = rows.numbers[start * width + at..].iter_mut().step_by(width);
            for (cell, number) in cells.zip(values(column, count)?) {
                *cell = number.unwrap_or(f64::NAN);
            }
        }
        (ColumnReader::ByteArrayColumnReader(column), FieldKind::Word(_)) => {
            for (row, word) in values(column, count)?.into_iter().enumerate() {
                let word = word.as_ref().map_or(&b""[..], ByteArray::data);
                put_word(rows, start + row, field.meaning, word).ok_or_else(unexpected)?;
            }
        }
        _ => return Err(unexpected()),
    }
    Ok(())
}

/// Puts a word into a row; nothing if it is none that belongs there.
fn put_word(rows: &mut Rows, row: usize, meaning: Meaning, word: &[u8]) -> Option<()> {
    let head = &mut rows.heads[row];
    let text = str::from_utf8(word).ok()?;
    match meaning {
        Meaning::Breakpoint => head.breakpoint = Breakpoint::of_word(text)?,
        Meaning::Status => head.status = PointStatus::of_word(text)?,
        Meaning::Kind => head.kind = RowKind::of_word(text)?,
        Meaning::Attainability => head.verdict = Verdict::of_word(text)?,
        Meaning::DeterminantSign => {
            head.negative_determinant = match word {
                b"-" => Some(true),
                b"+" => Some(false),
                _ => None,
            }
        }
        Meaning::Pattern if word.is_empty() => {}
        Meaning::Pattern if word.len() == rows.contacts => {
            rows.patterns[row * rows.contacts..][..rows.contacts].copy_from_slice(word);
        }
        _ => return None,
    }
    Some(())
}

/// The values of a column, so many; none where they are null.
fn values<T: DataType>(
    mut column: ColumnReaderImpl<T>,
    count: usize,
) -> Result<Vec<Option<T::T>>, ParquetError> {
    let (mut present, mut levels) = (Vec::new(), Vec::new());
    while present.len().max(levels.len()) < count {
        let (records, ..) = column.read_records(count, Some(&mut levels), None, &mut present)?;
        if records == 0 {
            return Err(unexpected());
        }
    }
    // Without definition levels no value is null.
    if levels.is_empty() {
        return Ok(present.into_iter().map(Some).collect());
    }
    let mut present = present.into_iter();
    Ok(levels.into_iter().map(|level| if level > 0 { present.next() } else { None }).collect())
}
