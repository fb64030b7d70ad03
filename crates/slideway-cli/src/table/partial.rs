//! A table on its way: `FILE.partial` holds what is done, `FILE.partial.state` what is needed to go on.

use super::{Encoder, npz};
use crate::arguments::TableFormat;
use crate::failure::Failure;
use crc32fast::Hasher;
use serde::{Deserialize, Serialize};
use slideway::sweep::SweepState;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Version of the layout of the state.
const SCHEMA: &str = "slideway/sweep-state/1";
/// Endings of the files beside the table: its rows, the last state, the next one until it is whole.
const PARTIAL: &str = ".partial";
const STATE: &str = ".partial.state";
const NEXT_STATE: &str = ".partial.state.new";
/// Ending of a Parquet file until it is whole.
#[cfg(feature = "parquet")]
const CONVERTED: &str = ".partial.converted";
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
    pub(crate) state: SweepState,
}

impl PartialFile {
    /// Begins a table at the state `start`, or goes on with it.
    ///
    /// # Errors
    /// If an unfinished one is in the way or missing, belongs to another command, or cannot be read or written.
    pub(crate) fn open(
        target: &Path,
        encoder: Encoder,
        (resume, overwrite): (bool, bool),
        start: SweepState,
    ) -> Result<Continued, Failure> {
        let path = beside(target, PARTIAL);
        if resume {
            return Self::reopen(target, encoder, overwrite);
        }
        if path.exists() && !overwrite {
            return Err(Failure::Unfinished { path });
        }
        // An old state must not be taken for that of the new table.
        remove(&beside(target, STATE))?;
        let options = OpenOptions::new().read(true).write(true).create(true).truncate(true).open(&path);
        let file = options.map_err(|error| cannot_write(&path, error))?;
        let target = target.to_owned();
        let rows = Hasher::new();
        let mut file = Self { target, overwrite, file, encoder, bytes: 0, rows, kept_at: Instant::now() };
        match file.begin(&start) {
            Ok(()) => Ok(Continued { file, state: start }),
            Err(error) => {
                // There is nothing in it that would be worth to go on with.
                let _ = fs::remove_file(&path);
                Err(cannot_write(&path, error))
            }
        }
    }

    /// Writes what stands before the rows. From here on there is always a state to go on from.
    fn begin(&mut self, start: &SweepState) -> io::Result<()> {
        let head = self.encoder.head();
        self.file.write_all(&head)?;
        self.bytes = head.len() as u64;
        self.keep_state(start)
    }

    fn reopen(target: &Path, encoder: Encoder, overwrite: bool) -> Result<Continued, Failure> {
        let (path, state_path) = (beside(target, PARTIAL), beside(target, STATE));
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
        Ok(Continued { file, state: kept.state })
    }

    /// Where the unfinished table is.
    pub(crate) fn path(&self) -> PathBuf {
        beside(&self.target, PARTIAL)
    }

    /// Adds rows that belong to a state.
    ///
    /// # Errors
    /// If they cannot be written.
    pub(crate) fn add(&mut self, rows: &[Vec<u8>], state: &SweepState) -> Result<(), Failure> {
        for rows in rows {
            self.file.write_all(rows).map_err(|error| self.cannot_go_on(error))?;
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
        self.keep_state(state).map_err(|error| self.cannot_go_on(error))
    }

    fn keep_state(&mut self, state: &SweepState) -> io::Result<()> {
        let kept = Kept {
            schema: SCHEMA.to_owned(),
            program: super::Metadata::program(),
            command: self.encoder.metadata.command.clone(),
            model: self.encoder.metadata.model.clone(),
            bytes: self.bytes,
            crc: self.rows.clone().finalize(),
            state: state.clone(),
        };
        let text = serde_json::to_vec(&kept)?;
        // The old state stays until the new one is whole.
        let next = beside(&self.target, NEXT_STATE);
        let written = fs::write(&next, text).and_then(|()| fs::rename(&next, beside(&self.target, STATE)));
        if written.is_err() {
            let _ = fs::remove_file(&next);
        }
        self.kept_at = Instant::now();
        written
    }

    /// Completes the table and gives it its name. `go_on` is told which part is done, and breaks to leave it unfinished.
    ///
    /// # Errors
    /// If it cannot be written, or a file of that name has appeared meanwhile.
    pub(crate) fn complete(
        &mut self,
        go_on: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, Failure> {
        let finished = match self.finish(go_on).map_err(|error| self.cannot_go_on(error))? {
            ControlFlow::Continue(finished) => finished,
            ControlFlow::Break(()) => return Ok(ControlFlow::Break(())),
        };
        if self.target.exists() && !self.overwrite {
            return Err(Failure::OutputExists { path: self.target.clone() });
        }
        fs::rename(&finished, &self.target).map_err(|error| cannot_write(&self.target, error))?;
        remove(&self.path())?;
        remove(&beside(&self.target, STATE))?;
        Ok(ControlFlow::Continue(()))
    }

    /// Where the whole table is; what stands there is on the disk.
    fn finish(
        &mut self,
        go_on: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> io::Result<ControlFlow<(), PathBuf>> {
        if go_on(0.0).is_break() {
            return Ok(ControlFlow::Break(()));
        }
        match self.encoder.format {
            TableFormat::Csv => {}
            TableFormat::Npz => {
                let Encoder { layout, metadata, .. } = &self.encoder;
                npz::finish(&mut self.file, layout, metadata, (self.bytes, &self.rows))?;
            }
            #[cfg(feature = "parquet")]
            TableFormat::Parquet => return self.convert(go_on),
        }
        self.file.sync_all()?;
        Ok(ControlFlow::Continue(self.path()))
    }

    /// Makes a Parquet file of the records: its end tells of all that comes before, so that rows cannot be added to it.
    #[cfg(feature = "parquet")]
    fn convert(&self, go_on: &mut dyn FnMut(f64) -> ControlFlow<()>) -> io::Result<ControlFlow<(), PathBuf>> {
        let path = beside(&self.target, CONVERTED);
        let Encoder { layout, metadata, .. } = &self.encoder;
        let records = (&self.file, self.bytes);
        let converted = File::create(&path).and_then(|file| {
            let flow = super::parquet::convert(records, (layout, metadata), &file, go_on)?;
            file.sync_all()?;
            Ok(flow)
        });
        if !matches!(converted, Ok(ControlFlow::Continue(()))) {
            let _ = fs::remove_file(&path);
        }
        Ok(match converted? {
            ControlFlow::Continue(()) => ControlFlow::Continue(path),
            ControlFlow::Break(()) => ControlFlow::Break(()),
        })
    }

    fn cannot_go_on(&self, error: io::Error) -> Failure {
        Failure::CannotGoOn { path: self.path(), error }
    }
}

/// The path with something behind its name.
fn beside(target: &Path, ending: &str) -> PathBuf {
    let mut name = target.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

/// Removes a file if it is there.
fn remove(path: &Path) -> Result<(), Failure> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(cannot_write(path, error)),
        _ => Ok(()),
    }
}

fn cannot_write(path: &Path, error: io::Error) -> Failure {
    Failure::CannotWrite { path: path.to_owned(), error }
}
