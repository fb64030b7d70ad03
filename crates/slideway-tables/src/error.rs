//! Why a table cannot be written or continued.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a table cannot be written or continued. Nothing unfinished has got the name of a table.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "each variant says what its values mean")]
pub enum TableError {
    /// A table of that name exists.
    #[error("`{}` already exists", path.display())]
    Exists { path: PathBuf },
    /// An unfinished table is where a new one would be written.
    #[error("there is an unfinished sweep: `{}`", path.display())]
    Unfinished { path: PathBuf },
    /// Another program writes the unfinished table.
    #[error("another sweep is writing `{}`", path.display())]
    InUse { path: PathBuf },
    /// An unfinished table is not what was written.
    #[error("`{}` was changed since the sweep was interrupted", path.display())]
    Damaged { path: PathBuf },
    /// There is no unfinished table.
    #[error("there is no sweep to resume: `{}` is missing", path.display())]
    NothingToResume { path: PathBuf },
    /// The unfinished table is that of another sweep, which this command made.
    #[error("`{}` belongs to another sweep: `{command}`", path.display())]
    AnotherSweep { path: PathBuf, command: String },
    /// A file cannot be read.
    #[error("`{}` cannot be read: {}", path.display(), Reason(error))]
    CannotRead { path: PathBuf, error: io::Error },
    /// A file cannot be written.
    #[error("`{}` cannot be written: {}", path.display(), Reason(error))]
    CannotWrite { path: PathBuf, error: io::Error },
    /// An unfinished table cannot be written any further; what is finished is kept.
    #[error("`{}` cannot be written: {}", path.display(), Reason(error))]
    CannotGoOn { path: PathBuf, error: io::Error },
}

impl TableError {
    /// That this file cannot be read.
    pub(crate) fn reading(path: &Path, error: io::Error) -> Self {
        Self::CannotRead { path: path.to_owned(), error }
    }

    /// That this file cannot be written.
    pub(crate) fn writing(path: &Path, error: io::Error) -> Self {
        Self::CannotWrite { path: path.to_owned(), error }
    }
}

/// What the system says, without its error number: "no space left on device".
pub struct Reason<'e>(pub &'e io::Error);

impl fmt::Display for Reason<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.0.to_string();
        let end = text.find(" (os error").unwrap_or(text.len());
        formatter.write_str(&text[..end].to_lowercase())
    }
}
