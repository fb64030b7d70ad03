//! Why a table cannot be written or continued.

use crate::Metadata;
use slideway::fault::Faults;
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
    /// A link, a folder, a device or a pipe is where an unfinished table would be kept.
    #[error("`{}` is no regular file, and an unfinished table would be kept there", path.display())]
    NoFile { path: PathBuf },
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
    /// The file of a shard is not what was written, or was never one.
    #[error("`{}` is damaged, or no shard that slideway has written", path.display())]
    ShardDamaged { path: PathBuf },
    /// The file of a shard was written by another version of the program.
    #[error("`{}` was written by {program}; this is {}", path.display(), Metadata::program())]
    ShardOfVersion { path: PathBuf, program: String },
    /// The file of a shard is in the way that belongs to another sweep, which this command made.
    #[error("`{}` belongs to another sweep ({difference}): `{command}`", path.display())]
    ShardOfAnotherSweep { path: PathBuf, command: String, difference: Difference },
    /// Two shards do not belong together.
    #[error("`{}` and `{}` belong to different sweeps ({difference})", paths[0].display(), paths[1].display())]
    ShardsDiffer { paths: [PathBuf; 2], difference: Difference },
    /// There is no shard in a folder.
    #[error("there are no shards of a sweep in `{}`", folder.display())]
    NoShards { folder: PathBuf },
    /// Shards are missing: their numbers as ranges.
    #[error("of {of} shards in `{}` are missing: {missing}", folder.display())]
    ShardsMissing { folder: PathBuf, missing: String, of: u32 },
    /// The model of shards is refused.
    #[error("the model in `{}` is refused: {faults}", path.display())]
    Refused { path: PathBuf, faults: Faults },
}

/// In what two sweeps differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Difference {
    /// The text of the model.
    Model,
    /// The changes of the model.
    Settings,
    /// The quantities that are varied or computed.
    Options,
    /// How many shards there are, or which one it is.
    Shard,
    /// The exact ends of modes that are inserted: other machines may compute them with another last digit.
    Breakpoints,
}

impl fmt::Display for Difference {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Model => "another model",
            Self::Settings => "other settings of the model",
            Self::Options => "other points or columns",
            Self::Shard => "another shard, or another number of shards",
            Self::Breakpoints => "other exact ends of modes, as if computed on another kind of machine",
        })
    }
}

impl TableError {
    /// Builds the error of a file that cannot be read.
    pub(crate) fn reading(path: &Path, error: io::Error) -> Self {
        Self::CannotRead { path: path.to_owned(), error }
    }

    /// Builds the error of a file that cannot be written.
    pub(crate) fn writing(path: &Path, error: io::Error) -> Self {
        Self::CannotWrite { path: path.to_owned(), error }
    }
}

/// The message of the system, without its error number: "no space left on device".
pub struct Reason<'e>(pub &'e io::Error);

impl fmt::Display for Reason<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.0.to_string();
        let end = text.find(" (os error").unwrap_or(text.len());
        formatter.write_str(&text[..end].to_lowercase())
    }
}
