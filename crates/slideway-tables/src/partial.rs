//! A table on its way: `FILE.partial` holds what is done, `FILE.partial.state` what is needed to go on.
//!
//! The writer of a table has locked `FILE.partial`, and all names that begin with it are the writer's alone.
//! Checksums show whether both files are still what was written. Only regular files are written, and only new
//! ones or those that have been checked: never the target of a link of such a name.

use crate::{Encoder, FileIdentity, Metadata, Part, TableError, TableFormat, npz};
use crc32fast::Hasher;
use serde::{Deserialize, Serialize};
use slideway::sweep::SweepState;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Ending of what is not finished.
pub const PARTIAL: &str = ".partial";
/// Version of the layout of the state.
const SCHEMA: &str = "slideway/sweep-state/3";
/// Endings of further files beside the table: the last state, the next one until it is whole.
const STATE: &str = ".partial.state";
const NEXT_STATE: &str = ".partial.state.new";
/// Ending of a Parquet file until it is whole.
#[cfg(feature = "parquet")]
const CONVERTED: &str = ".partial.converted";
/// Time between two states.
const BETWEEN: Duration = Duration::from_secs(2);

/// The state of an unfinished table, kept in a file beside it.
#[derive(Debug, Serialize, Deserialize)]
struct Kept {
    schema: String,
    program: String,
    command: String,
    model: String,
    /// If the table is a shard.
    part: Option<Part>,
    /// Bytes of the table that belong to the state.
    bytes: u64,
    /// Checksum of the rows among them.
    crc: u32,
    state: SweepState,
}

/// Whether an unfinished table is continued.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Resume {
    /// A table begins; an unfinished one is in the way, or overwritten.
    No,
    /// There has to be one.
    Yes,
    /// If there is one.
    IfAny,
}

/// A table on its way.
pub struct PartialFile {
    target: PathBuf,
    overwrite: bool,
    file: File,
    encoder: Encoder,
    bytes: u64,
    rows: Hasher,
    kept_at: Instant,
}

/// Where a sweep goes on.
pub struct Continued {
    /// Where the rows go.
    pub(crate) file: PartialFile,
    /// The state with which it goes on: the part that is done.
    pub state: SweepState,
}

impl PartialFile {
    /// Begins a table at the state `start`, or goes on with it.
    ///
    /// # Errors
    /// If an unfinished one is in the way or missing, belongs to another command, or cannot be read or
    /// written.
    pub fn open(
        target: &Path,
        encoder: Encoder,
        (resume, overwrite): (Resume, bool),
        start: SweepState,
    ) -> Result<Continued, TableError> {
        let path = beside(target, PARTIAL);
        match resume {
            Resume::Yes => return Self::reopen(target, encoder, overwrite),
            Resume::IfAny if unfinished(target).is_some() => return Self::reopen(target, encoder, overwrite),
            Resume::No | Resume::IfAny => {}
        }
        // Without a state beside it there is nothing in it to go on with.
        let old = if overwrite || resume == Resume::IfAny { Old::Replaced } else { Old::Kept };
        let state = beside(target, STATE);
        be_a_file(&state)?;
        let file = locked(&path, old)?;
        // An old state must not be taken for that of the new table.
        remove(&state).map_err(|error| TableError::writing(&state, error))?;
        let target = target.to_owned();
        let rows = Hasher::new();
        let mut file = Self { target, overwrite, file, encoder, bytes: 0, rows, kept_at: Instant::now() };
        match file.begin(&start) {
            Ok(()) => Ok(Continued { file, state: start }),
            Err(error) => {
                // There is nothing in it that would be worth to go on with.
                let _ = fs::remove_file(&path);
                Err(TableError::writing(&path, error))
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

    fn reopen(target: &Path, encoder: Encoder, overwrite: bool) -> Result<Continued, TableError> {
        let (path, state_path) = (beside(target, PARTIAL), beside(target, STATE));
        let nothing = || TableError::NothingToResume { path: path.clone() };
        // Locked before the state is read: whoever still writes would change it.
        let mut file = locked(&path, Old::Continued)?;
        be_a_file(&state_path)?;
        let text = fs::read(&state_path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => nothing(),
            _ => TableError::reading(&state_path, error),
        })?;
        let damaged = |path: &Path| TableError::Damaged { path: path.to_owned() };
        let kept: Kept = unsealed(&text)
            .and_then(|text| serde_json::from_slice(text).ok())
            .ok_or_else(|| damaged(&state_path))?;
        let same = kept.schema == SCHEMA
            && kept.program == Metadata::program()
            && kept.command == encoder.metadata.command
            && kept.model == encoder.metadata.model
            && kept.part == encoder.part;
        if !same {
            return Err(TableError::AnotherSweep { path, command: kept.command });
        }
        let head = encoder.head();
        let bytes = kept.bytes.checked_sub(head.len() as u64).ok_or_else(|| damaged(&path))?;
        let rows = checksum(&mut file, head.len() as u64, bytes)
            .map_err(|error| TableError::reading(&path, error))?
            .filter(|rows| rows.clone().finalize() == kept.crc)
            .ok_or_else(|| damaged(&path))?;
        // The beginning is written again: completing an archive may have been interrupted in the middle of it.
        let repaired = file.seek(SeekFrom::Start(0)).and_then(|_| file.write_all(&head));
        let ready = repaired.and_then(|()| file.seek(SeekFrom::Start(kept.bytes)));
        ready.map_err(|error| TableError::writing(&path, error))?;
        // What was written behind the last state is computed again.
        file.set_len(kept.bytes).map_err(|error| TableError::writing(&path, error))?;
        let target = target.to_owned();
        let file =
            Self { target, overwrite, file, encoder, bytes: kept.bytes, rows, kept_at: Instant::now() };
        Ok(Continued { file, state: kept.state })
    }

    /// Returns the encoder that makes bytes of its rows.
    pub fn encoder(&self) -> &Encoder {
        &self.encoder
    }

    /// Where the unfinished table is.
    pub fn path(&self) -> PathBuf {
        beside(&self.target, PARTIAL)
    }

    /// Adds rows that belong to a state.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn add(&mut self, rows: &[Vec<u8>], state: &SweepState) -> Result<(), TableError> {
        for rows in rows {
            self.file.write_all(rows).map_err(|error| self.cannot_go_on(error))?;
            self.rows.update(rows);
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
    pub fn keep(&mut self, state: &SweepState) -> Result<(), TableError> {
        self.keep_state(state).map_err(|error| self.cannot_go_on(error))
    }

    fn keep_state(&mut self, state: &SweepState) -> io::Result<()> {
        let kept = Kept {
            schema: SCHEMA.to_owned(),
            program: Metadata::program(),
            command: self.encoder.metadata.command.clone(),
            model: self.encoder.metadata.model.clone(),
            part: self.encoder.part.clone(),
            bytes: self.bytes,
            crc: self.rows.clone().finalize(),
            state: state.clone(),
        };
        let text = sealed(serde_json::to_vec(&kept)?);
        // The old state stays until the new one is whole.
        let next = beside(&self.target, NEXT_STATE);
        let written = fresh(&next)
            .and_then(|mut file| file.write_all(&text))
            .and_then(|()| fs::rename(&next, beside(&self.target, STATE)));
        if written.is_err() {
            let _ = fs::remove_file(&next);
        }
        self.kept_at = Instant::now();
        written
    }

    /// Completes the table, which has come to this state, and gives it its name. `go_on` receives the
    /// fraction that is done, and breaks to leave the table unfinished.
    ///
    /// # Errors
    /// If it cannot be written, or a file of that name has appeared meanwhile.
    pub fn complete(
        &mut self,
        state: &SweepState,
        go_on: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, TableError> {
        let finished = match self.finish(state, go_on).map_err(|error| self.cannot_go_on(error))? {
            ControlFlow::Continue(finished) => finished,
            ControlFlow::Break(()) => return Ok(ControlFlow::Break(())),
        };
        if self.target.exists() && !self.overwrite {
            return Err(TableError::Exists { path: self.target.clone() });
        }
        fs::rename(&finished, &self.target).map_err(|error| TableError::writing(&self.target, error))?;
        // The unfinished table last of all: with it the lock goes, and another table may begin.
        let left = [Some(beside(&self.target, STATE)), Some(self.path()).filter(|path| *path != finished)];
        for path in left.into_iter().flatten() {
            remove(&path).map_err(|error| TableError::writing(&path, error))?;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Where the whole table is; what stands there is on the disk.
    fn finish(
        &mut self,
        #[cfg_attr(not(feature = "parquet"), expect(unused_variables))] state: &SweepState,
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
            TableFormat::Parquet => return self.convert(state, go_on),
        }
        self.file.sync_all()?;
        Ok(ControlFlow::Continue(self.path()))
    }

    /// Makes a Parquet file of the records: its end tells of all that comes before, so that rows cannot be
    /// added to it.
    #[cfg(feature = "parquet")]
    fn convert(
        &self,
        state: &SweepState,
        go_on: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> io::Result<ControlFlow<(), PathBuf>> {
        let path = beside(&self.target, CONVERTED);
        let records = (&self.file, self.bytes);
        let converted = fresh(&path).and_then(|file| {
            let flow = crate::parquet::convert(records, (&self.encoder, &state.tally), &file, go_on)?;
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

    fn cannot_go_on(&self, error: io::Error) -> TableError {
        TableError::CannotGoOn { path: self.path(), error }
    }
}

/// The fate of an unfinished table that is there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Old {
    /// There has to be one.
    Continued,
    /// It is in the way.
    Kept,
    Replaced,
}

/// Opens an unfinished table for this program alone: a new file, unless an old one is continued.
fn locked(path: &Path, old: Old) -> Result<File, TableError> {
    let writing = |error| TableError::writing(path, error);
    // Another program may complete it, and give it its final name, at any time before it is locked.
    for _ in 0..100 {
        if old != Old::Continued {
            match created(path) {
                Ok(file) if is_mine(&file, path)? => return Ok(file),
                Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(writing(error)),
                _ => {}
            }
        }
        be_a_file(path)?;
        let file = match OpenOptions::new().read(true).write(true).open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound && old == Old::Continued => {
                return Err(TableError::NothingToResume { path: path.to_owned() });
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            opened => opened.map_err(writing)?,
        };
        if !is_mine(&file, path)? {
            continue;
        }
        match old {
            Old::Continued => return Ok(file),
            Old::Kept => return Err(TableError::Unfinished { path: path.to_owned() }),
            // Not written over: it may have other names, too.
            Old::Replaced => remove(path).map_err(writing)?,
        }
    }
    Err(TableError::InUse { path: path.to_owned() })
}

/// Locks an open file, and says whether it is what has its name: neither has it been renamed, nor was it opened
/// through a link.
fn is_mine(file: &File, path: &Path) -> Result<bool, TableError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => return Err(TableError::InUse { path: path.to_owned() }),
        // Some network file systems have no locks; there it is left to the user.
        Err(TryLockError::Error(error)) if error.kind() != io::ErrorKind::Unsupported => {
            return Err(TableError::writing(path, error));
        }
        _ => {}
    }
    let identity = FileIdentity::of_file(file, path);
    Ok(identity.is_some() && identity == FileIdentity::at_name(path))
}

/// Refuses links, folders, devices and pipes in the place of a file.
fn be_a_file(path: &Path) -> Result<(), TableError> {
    match fs::symlink_metadata(path) {
        Ok(metadata) if !metadata.is_file() => Err(TableError::NoFile { path: path.to_owned() }),
        _ => Ok(()),
    }
}

/// A file that was not there before.
fn created(path: &Path) -> io::Result<File> {
    OpenOptions::new().read(true).write(true).create_new(true).open(path)
}

/// A new file in the place of one that an ended run has left.
fn fresh(path: &Path) -> io::Result<File> {
    remove(path)?;
    created(path)
}

/// The checksum of so many bytes of a file from a place on; none if there are not so many.
fn checksum(file: &mut File, from: u64, bytes: u64) -> io::Result<Option<Hasher>> {
    file.seek(SeekFrom::Start(from))?;
    let mut hasher = Hasher::new();
    let mut buffer = vec![0; 1 << 16];
    let mut source = file.take(bytes);
    loop {
        match source.read(&mut buffer)? {
            0 => break,
            read => hasher.update(&buffer[..read]),
        }
    }
    Ok((source.limit() == 0).then_some(hasher))
}

/// A text with a line that holds its checksum.
fn sealed(mut text: Vec<u8>) -> Vec<u8> {
    let seal = format!("\n{:08x}\n", crc32fast::hash(&text));
    text.extend_from_slice(seal.as_bytes());
    text
}

/// The text before the line with its checksum, if that is the right one.
fn unsealed(bytes: &[u8]) -> Option<&[u8]> {
    let text = &bytes[..bytes.len().checked_sub(10)?];
    (sealed(text.to_vec()) == bytes).then_some(text)
}

/// The unfinished table of a sweep that could be continued, if there is one beside this file.
pub fn unfinished(target: &Path) -> Option<PathBuf> {
    beside(target, STATE).exists().then(|| beside(target, PARTIAL))
}

/// Removes a file if it is there.
fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        removed => removed,
    }
}

/// The path with something behind its name.
pub fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    name.into()
}
