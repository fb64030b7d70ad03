//! A table on its way: `FILE.partial` holds what is done, `FILE.partial.state` what is needed to go on.

use super::{Encoder, npz};
use crate::arguments::TableFormat;
use crate::failure::Failure;
use crc32fast::Hasher;
use serde::{Deserialize, Serialize};
use slideway::sweep::SweepState;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Version of the layout of the state.
const SCHEMA: &str = "slideway/sweep-state/1";
/// Time between two states.
const BETWEEN: Duration = Duration::from_secs(2);

/// What is kept beside an unfinished table.
#[derive(Debug, Serialize, Deserialize)]
struct Kept {
    schema: String,
    program: String,
    command: String,
    model: String,
    /// Bytes of the table that belong to the state.
    bytes: u64,
    /// Checksum of the rows among them.
    crc: u32,
    state: SweepState,
}

/// A table on its way.
pub(crate) struct PartialFile {
    target: PathBuf,
    overwrite: bool,
    file: File,
    encoder: Encoder,
    bytes: u64,
    rows: Hasher,
    kept_at: Instant,
}

/// Where a sweep goes on.
pub(crate) struct Continued {
    pub(crate) file: PartialFile,
    /// None at the beginning.
    pub(crate) state: Option<SweepState>,
}

impl PartialFile {
    /// Begins a table, or goes on with it.
    ///
    /// # Errors
    /// If an unfinished one is in the way or missing, belongs to another command, or cannot be read or written.
    pub(crate) fn open(
        target: &Path,
        encoder: Encoder,
        (resume, overwrite): (bool, bool),
    ) -> Result<Continued, Failure> {
        let path = beside(target, ".partial");
        if resume {
            return Self::reopen(target, encoder, overwrite);
        }
        if path.exists() && !overwrite {
            return Err(Failure::Unfinished { path });
        }
        // An old state must not be taken for that of the new table.
        let old = beside(target, ".partial.state");
        if old.exists() {
            fs::remove_file(&old).map_err(|error| cannot_write(&old, error))?;
        }
        let options = OpenOptions::new().read(true).write(true).create(true).truncate(true).open(&path);
        let mut file = options.map_err(|error| cannot_write(&path, error))?;
        let head = encoder.head();
        file.write_all(&head).map_err(|error| cannot_write(&path, error))?;
        let file = Self {
            target: target.to_owned(),
            overwrite,
            file,
            encoder,
            bytes: head.len() as u64,
            rows: Hasher::new(),
            kept_at: Instant::now(),
        };
        Ok(Continued { file, state: None })
    }

    fn reopen(target: &Path, encoder: Encoder, overwrite: bool) -> Result<Continued, Failure> {
        let (path, state_path) = (beside(target, ".partial"), beside(target, ".partial.state"));
        let nothing = || Failure::NothingToResume { path: path.clone() };
        let text = fs::read(&state_path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => nothing(),
            _ => Failure::CannotRead { path: state_path.clone(), error },
        })?;
        let kept: Kept = serde_json::from_slice(&text).map_err(|_| nothing())?;
        let same = kept.schema == SCHEMA
            && kept.program == super::Metadata::program()
            && kept.command == encoder.metadata.command
            && kept.model == encoder.metadata.model;
        if !same {
            return Err(Failure::AnotherSweep { path, command: kept.command });
        }
        let mut file = OpenOptions::new()
            .read(true)
            .write(true)
            .open(&path)
            .map_err(|error| Failure::CannotRead { path: path.clone(), error })?;
        let length = file.metadata().map_err(|error| cannot_write(&path, error))?.len();
        if length < kept.bytes {
            return Err(nothing());
        }
        // What was written behind the last state is computed again.
        let end = SeekFrom::Start(kept.bytes);
        file.set_len(kept.bytes).and_then(|()| file.seek(end)).map_err(|error| cannot_write(&path, error))?;
        let head = encoder.head().len() as u64;
        let file = Self {
            target: target.to_owned(),
            overwrite,
            file,
            encoder,
            bytes: kept.bytes,
            rows: Hasher::new_with_initial_len(kept.crc, kept.bytes - head),
            kept_at: Instant::now(),
        };
        Ok(Continued { file, state: Some(kept.state) })
    }

    /// Where the unfinished table is.
    pub(crate) fn path(&self) -> PathBuf {
        beside(&self.target, ".partial")
    }

    /// Adds rows that belong to a state.
    ///
    /// # Errors
    /// If they cannot be written.
    pub(crate) fn add(&mut self, rows: &[Vec<u8>], state: &SweepState) -> Result<(), Failure> {
        for rows in rows {
            self.file.write_all(rows).map_err(|error| self.cannot_write(error))?;
            if self.encoder.format == TableFormat::Npz {
                self.rows.update(rows);
            }
            self.bytes += rows.len() as u64;
        }
        if self.kept_at.elapsed() >= BETWEEN {
            self.keep(state)?;
        }
        Ok(())
    }

    /// Keeps all that is needed to go on from here.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn keep(&mut self, state: &SweepState) -> Result<(), Failure> {
        let kept = Kept {
            schema: SCHEMA.to_owned(),
            program: super::Metadata::program(),
            command: self.encoder.metadata.command.clone(),
            model: self.encoder.metadata.model.clone(),
            bytes: self.bytes,
            crc: self.rows.clone().finalize(),
            state: state.clone(),
        };
        let path = beside(&self.target, ".partial.state");
        let text = serde_json::to_vec(&kept).map_err(|error| cannot_write(&path, error.into()))?;
        // The old state stays until the new one is whole.
        let next = beside(&self.target, ".partial.state.new");
        fs::write(&next, text).map_err(|error| cannot_write(&next, error))?;
        fs::rename(&next, &path).map_err(|error| cannot_write(&path, error))?;
        self.kept_at = Instant::now();
        Ok(())
    }

    /// Completes the table and gives it its name.
    ///
    /// # Errors
    /// If it cannot be written, or a file of that name has appeared meanwhile.
    pub(crate) fn complete(mut self) -> Result<(), Failure> {
        let path = self.path();
        match self.encoder.format {
            TableFormat::Csv => {}
            TableFormat::Npz => {
                let Encoder { layout, metadata, .. } = &self.encoder;
                npz::finish(&mut self.file, layout, metadata, (self.bytes, &self.rows))
                    .map_err(|error| cannot_write(&path, error))?;
            }
        }
        // What stands under the final name is on the disk.
        self.file.sync_all().map_err(|error| cannot_write(&path, error))?;
        if self.target.exists() && !self.overwrite {
            return Err(Failure::OutputExists { path: self.target });
        }
        fs::rename(&path, &self.target).map_err(|error| cannot_write(&self.target, error))?;
        let state = beside(&self.target, ".partial.state");
        match fs::remove_file(&state) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(cannot_write(&state, error)),
            _ => Ok(()),
        }
    }

    fn cannot_write(&self, error: io::Error) -> Failure {
        cannot_write(&self.path(), error)
    }
}

/// The path with something behind its name.
fn beside(target: &Path, ending: &str) -> PathBuf {
    let mut name = target.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

fn cannot_write(path: &Path, error: io::Error) -> Failure {
    Failure::CannotWrite { path: path.to_owned(), error }
}
