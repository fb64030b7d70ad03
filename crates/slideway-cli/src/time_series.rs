//! Time series as files.

use crate::failure::Failure;
use crate::table::npz::{archive, number_array, text_array};
use slideway::motion::Series;
use std::fmt::Write;
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
}

impl SeriesFormat {
    /// The form that the ending says.
    ///
    /// # Errors
    /// Another ending.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase).as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("npz") => Ok(Self::Npz),
            Some("json") => Ok(Self::Json),
            _ => Err(Failure::SeriesFormat { path: path.to_owned() }),
        }
    }
}

/// A line of names with units, then a line for each time; what is not defined is left empty. The mode is the last column.
pub(crate) fn to_csv(series: &Series) -> String {
    let mut text = String::new();
    for column in &series.columns {
        let _ = write!(text, "{} ({}),", column.name, column.unit);
    }
    text.push_str("mode\n");
    for (row, mode) in series.modes.iter().enumerate() {
        for column in &series.columns {
            if let Some(value) = column.values[row] {
                let _ = write!(text, "{value:?}");
            }
            text.push(',');
        }
        text.push_str(mode);
        text.push('\n');
    }
    text
}

/// One array for each column, NaN where a quantity is not defined; `mode`, and `units` in the order of the columns.
pub(crate) fn to_npz(series: &Series) -> Vec<u8> {
    let numbers = series.columns.iter().map(|column| {
        let values = column.values.iter().map(|value| value.unwrap_or(f64::NAN));
        (column.name.clone(), number_array(values))
    });
    let modes: Vec<&str> = series.modes.iter().map(String::as_str).collect();
    let units: Vec<&str> = series.columns.iter().map(|column| column.unit).collect();
    let texts = [("mode", modes), ("units", units)];
    let texts = texts.map(|(name, texts)| (name.to_owned(), text_array(&texts, false)));
    archive(&numbers.chain(texts).collect::<Vec<_>>())
}
