//! The form of a table.

use std::path::Path;

/// The form of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum TableFormat {
    /// Comma-separated values, with comment lines at the top.
    Csv,
    /// A NumPy archive.
    Npz,
    /// A Parquet file.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl TableFormat {
    /// All of them.
    pub const ALL: &'static [Self] = &[
        Self::Csv,
        Self::Npz,
        #[cfg(feature = "parquet")]
        Self::Parquet,
    ];

    /// Its name, which is also the ending of its files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Npz => "npz",
            #[cfg(feature = "parquet")]
            Self::Parquet => "parquet",
        }
    }

    /// Returns a description in words.
    pub fn description(self) -> &'static str {
        match self {
            Self::Csv => "Comma-separated values, with comment lines at the top",
            Self::Npz => "A NumPy archive",
            #[cfg(feature = "parquet")]
            Self::Parquet => "A Parquet file",
        }
    }

    /// The form of this name, whatever the case of its letters; none if there is none, or this crate was
    /// built without it.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|format| name.eq_ignore_ascii_case(format.name()))
    }

    /// The form that the ending of a file tells.
    pub fn of(path: &Path) -> Option<Self> {
        Self::named(path.extension()?.to_str()?)
    }
}
