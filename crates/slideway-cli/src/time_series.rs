//! Time series as files.

use crate::failure::Failure;
use slideway::motion::Series;
use slideway_tables::Metadata;
use slideway_tables::npz::{archive, number_array, text_array};
#[cfg(feature = "parquet")]
use slideway_tables::parquet::{Column, ColumnKind, GROUP, ParquetTable, Values};
#[cfg(feature = "parquet")]
use std::io;
use std::path::Path;

/// The form of a time series, by the ending of its file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SeriesFormat {
    /// Comma-separated values.
    Csv,
    /// A NumPy archive.
    Npz,
    /// Within the report.
    Json,
    /// A Parquet file.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl SeriesFormat {
    /// The endings of files.
    #[cfg(not(feature = "parquet"))]
    pub(crate) const ENDINGS: [&str; 3] = [".csv", ".npz", ".json"];
    /// The endings of files.
    #[cfg(feature = "parquet")]
    pub(crate) const ENDINGS: [&str; 4] = [".csv", ".npz", ".json", ".parquet"];

    /// The form that the ending says.
    ///
    /// # Errors
    /// Another ending, or one that the program was built without.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase).as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("npz") => Ok(Self::Npz),
            Some("json") => Ok(Self::Json),
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Self::Parquet),
            #[cfg(not(feature = "parquet"))]
            Some("parquet") => Err(Failure::WithoutParquet),
            _ => Err(Failure::SeriesFormat { path: path.to_owned(), known: &Self::ENDINGS }),
        }
    }
}

/// One nullable column for each quantity, and `mode`, in groups of rows.
///
/// # Errors
/// If the library refuses the columns.
#[cfg(feature = "parquet")]
pub(crate) fn to_parquet(series: &Series, metadata: &Metadata) -> io::Result<Vec<u8>> {
    let numbers = series.columns.iter().map(|column| Column {
        name: column.name.clone(),
        kind: ColumnKind::Number,
        unit: column.unit,
    });
    let mode = Column { name: "mode".to_owned(), kind: ColumnKind::Word, unit: "" };
    let columns: Vec<Column> = numbers.chain([mode]).collect();
    let mut bytes = Vec::new();
    let mut table = ParquetTable::new(&mut bytes, &columns, metadata)?;
    for start in (0..series.modes.len()).step_by(GROUP) {
        let rows = start..series.modes.len().min(start + GROUP);
        let modes = series.modes[rows.clone()].iter().map(|mode| Some(mode.as_bytes().to_vec().into()));
        let numbers =
            series.columns.iter().map(|column| Values::Number(column.values[rows.clone()].to_vec()));
        table.add(numbers.chain([Values::Word(modes.collect())]))?;
    }
    table.finish()?;
    Ok(bytes)
}

/// One array for each column, NaN where a quantity is not defined; `mode`, `units` in the order of the
/// columns, and what the archive tells of itself.
pub(crate) fn to_npz(series: &Series, metadata: &Metadata) -> Vec<u8> {
    let numbers = series.columns.iter().map(|column| {
        let values = column.values.iter().map(|value| value.unwrap_or(f64::NAN));
        (column.name.clone(), number_array(values))
    });
    let modes: Vec<&str> = series.modes.iter().map(String::as_str).collect();
    let units: Vec<&str> = series.columns.iter().map(|column| column.unit).collect();
    let program = Metadata::program();
    let texts = [
        ("mode", text_array(&modes, false)),
        ("units", text_array(&units, false)),
        ("model", text_array(&[&metadata.model], true)),
        ("command", text_array(&[&metadata.command], true)),
        ("program", text_array(&[&program], true)),
    ];
    let texts = texts.map(|(name, array)| (name.to_owned(), array));
    archive(&numbers.chain(texts).collect::<Vec<_>>())
}
