//! Tables as Parquet files: columns that are compressed by themselves, in groups of rows. What is absent is
//! null.
//!
//! Words are dictionary-encoded. Parquet itself has no place for the unit of a column, so units stand in the
//! metadata of the file. (The format: <https://parquet.apache.org/docs/file-format/>.)

mod reader;
mod records;
pub(crate) mod seal;

pub(crate) use reader::ShardReader;
pub(crate) use records::convert;

use crate::Metadata;
use ::parquet::basic::{Compression, LogicalType, Repetition, Type as PhysicalType};
use ::parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int32Type, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::{EnabledStatistics, WriterProperties};
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::{ColumnPath, Type};
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::Arc;

/// Rows of a group: as many as fit easily into memory.
pub const GROUP: usize = 1 << 17;

/// Entries of the metadata of files: the command that made it, the text of the model, the program with its
/// version, and what a shard tells of itself.
pub(crate) const COMMAND: &str = "slideway.command";
pub(crate) const MODEL: &str = "slideway.model";
pub(crate) const PROGRAM: &str = "slideway.program";
pub(crate) const MANIFEST: &str = "slideway.shard";

/// A column of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// The type of its values.
    pub kind: ColumnKind,
    /// Empty for what has none.
    pub unit: &'static str,
}

/// The type of the values of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ColumnKind {
    /// Integers of 64 bits, none of them absent.
    Unsigned64,
    /// Integers of 32 bits.
    Unsigned32 {
        /// Whether some are absent.
        nullable: bool,
    },
    /// Numbers.
    Number,
    /// Words.
    Word,
}

/// The values of a column within a group of rows.
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Of [`ColumnKind::Unsigned64`].
    Unsigned64(Vec<u64>),
    /// Of [`ColumnKind::Unsigned32`].
    Unsigned32(Vec<Option<u32>>),
    /// Of [`ColumnKind::Number`].
    Number(Vec<Option<f64>>),
    /// Of [`ColumnKind::Word`].
    Word(Vec<Option<ByteArray>>),
}

/// A Parquet file that is being written.
pub struct ParquetTable<W: Write + Send> {
    writer: SerializedFileWriter<W>,
}

impl<W: Write + Send> ParquetTable<W> {
    /// Begins a table with these columns.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn new(sink: W, columns: &[Column], metadata: &Metadata) -> io::Result<Self> {
        Self::new_with(sink, columns, metadata, [])
    }

    /// [`Self::new`] with more entries of the metadata of the file, behind the others.
    fn new_with<const MORE: usize>(
        sink: W,
        columns: &[Column],
        metadata: &Metadata,
        more: [(&'static str, String); MORE],
    ) -> io::Result<Self> {
        let fields: Result<Vec<_>, _> = columns.iter().map(|column| field(column).map(Arc::new)).collect();
        let schema = fields
            .and_then(|fields| Type::group_type_builder("slideway").with_fields(fields).build())
            .map_err(failure)?;
        let properties = properties(columns, metadata, more);
        let writer = SerializedFileWriter::new(sink, Arc::new(schema), Arc::new(properties));
        Ok(Self { writer: writer.map_err(failure)? })
    }

    /// Adds a group of rows, given by the values of each column.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn add(&mut self, columns: impl Iterator<Item = Values>) -> io::Result<()> {
        let add = || {
            let mut group = self.writer.next_row_group()?;
            for values in columns {
                if let Some(column) = group.next_column()? {
                    write(column, values)?;
                }
            }
            group.close().map(|_| ())
        };
        add().map_err(failure)
    }

    /// Writes what stands at the end.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn finish(mut self) -> io::Result<()> {
        self.writer.finish().map(|_| ()).map_err(failure)
    }
}

/// A column as the schema tells of it.
fn field(column: &Column) -> Result<Type, ParquetError> {
    let unsigned = |bit_width| Some(LogicalType::integer(bit_width, false));
    let (physical, logical, nullable) = match column.kind {
        ColumnKind::Unsigned64 => (PhysicalType::INT64, unsigned(64), false),
        ColumnKind::Unsigned32 { nullable } => (PhysicalType::INT32, unsigned(32), nullable),
        ColumnKind::Number => (PhysicalType::DOUBLE, None, true),
        ColumnKind::Word => (PhysicalType::BYTE_ARRAY, Some(LogicalType::String), true),
    };
    let repetition = if nullable { Repetition::OPTIONAL } else { Repetition::REQUIRED };
    Type::primitive_type_builder(&column.name, physical)
        .with_logical_type(logical)
        .with_repetition(repetition)
        .build()
}

/// Encodings, and what the file tells of itself.
fn properties<const MORE: usize>(
    columns: &[Column],
    metadata: &Metadata,
    more: [(&'static str, String); MORE],
) -> WriterProperties {
    let units: BTreeMap<&str, &str> = columns
        .iter()
        .filter(|column| !column.unit.is_empty())
        .map(|column| (column.name.as_str(), column.unit))
        .collect();
    let units = serde_json::json!(units).to_string();
    let program = Metadata::program();
    let texts = [
        (COMMAND, metadata.command.clone()),
        (MODEL, metadata.model.clone()),
        (PROGRAM, program.clone()),
        ("slideway.units", units),
    ];
    let texts = texts.into_iter().chain(more).map(|(key, text)| KeyValue::new(key.to_owned(), text));
    let mut properties = WriterProperties::builder()
        .set_created_by(program)
        .set_key_value_metadata(Some(texts.collect()))
        .set_compression(Compression::SNAPPY)
        .set_statistics_enabled(EnabledStatistics::Chunk)
        .set_max_row_group_row_count(None);
    // Numbers seldom repeat; a dictionary of them is tried in vain.
    for column in columns.iter().filter(|column| column.kind == ColumnKind::Number) {
        let path = ColumnPath::new(vec![column.name.clone()]);
        properties = properties.set_column_dictionary_enabled(path, false);
    }
    properties.build()
}

/// Writes the values of a column.
fn write(column: SerializedColumnWriter<'_>, values: Values) -> Result<(), ParquetError> {
    match values {
        Values::Unsigned64(values) => {
            write_as::<Int64Type>(column, values.into_iter().map(|value| Some(value.cast_signed())))
        }
        Values::Unsigned32(values) => {
            write_as::<Int32Type>(column, values.into_iter().map(|value| value.map(u32::cast_signed)))
        }
        Values::Number(values) => write_as::<DoubleType>(column, values.into_iter()),
        Values::Word(values) => write_as::<ByteArrayType>(column, values.into_iter()),
    }
}

fn write_as<T: DataType>(
    mut column: SerializedColumnWriter<'_>,
    values: impl ExactSizeIterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let mut present = Vec::with_capacity(values.len());
    // The definition level of the format: 1 where there is a value, 0 where it is null.
    let mut levels = Vec::with_capacity(values.len());
    for value in values {
        levels.push(i16::from(value.is_some()));
        present.extend(value);
    }
    column.typed::<T>().write_batch(&present, Some(&levels), None)?;
    column.close()
}

/// Returns the error of the system, if it was one; otherwise wraps the error.
fn failure(error: ParquetError) -> io::Error {
    match error {
        ParquetError::External(error) => match error.downcast::<io::Error>() {
            Ok(error) => *error,
            Err(error) => io::Error::other(error),
        },
        error => io::Error::other(error),
    }
}
