//! Which file a path means.

use std::fs::{self, File, Metadata};
use std::path::Path;

/// The identity of a file, which all paths that lead to it share, hard and symbolic links included: device
/// and number of the file, or its path without links where the system gives no numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileIdentity(Identity);

#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = std::path::PathBuf;

impl FileIdentity {
    /// Of the file or folder to which a path leads; links are followed. None if there is none.
    pub fn of(path: &Path) -> Option<Self> {
        Self::found(path, &fs::metadata(path).ok()?)
    }

    /// Of a regular file that has this name itself; none if there is a link, or something else, or nothing.
    pub(crate) fn at_name(path: &Path) -> Option<Self> {
        let metadata = fs::symlink_metadata(path).ok()?;
        if metadata.is_file() { Self::found(path, &metadata) } else { None }
    }

    /// Of an open file, which was opened by this path, if it is a regular file.
    pub fn of_file(file: &File, path: &Path) -> Option<Self> {
        let metadata = file.metadata().ok()?;
        if metadata.is_file() { Self::found(path, &metadata) } else { None }
    }

    #[cfg(unix)]
    #[expect(clippy::unnecessary_wraps, reason = "other systems may not tell")]
    fn found(_: &Path, metadata: &Metadata) -> Option<Self> {
        use std::os::unix::fs::MetadataExt;
        Some(Self((metadata.dev(), metadata.ino())))
    }

    #[cfg(not(unix))]
    fn found(path: &Path, _: &Metadata) -> Option<Self> {
        fs::canonicalize(path).ok().map(Self)
    }
}
