//! The files of one command: what it reads and what it writes. No file is written that is also read, or written
//! twice.
//!
//! Files are told apart by their identity, not by their names: a file has several names by hard links, symbolic
//! links, and paths that lead to it in different ways.

use crate::arguments::Destination;
use crate::failure::Failure;
use crate::input;
use crate::output::Output;
use crate::places::{followed, is_regular};
use slideway_tables::{FileIdentity, PARTIAL, beside};
use std::ffi::OsString;
use std::fs;
use std::io;
#[cfg(unix)]
use std::os::fd::AsFd;
use std::path::{Path, PathBuf};

/// The files of one command.
pub(crate) struct Files<'o> {
    output: &'o Output,
    destination: &'o Destination,
    inputs: Vec<(PathBuf, Place)>,
    outputs: Vec<Place>,
}

impl<'o> Files<'o> {
    /// Of a command that reads a file, or standard input for `-`, and whose answer goes to the destination.
    pub(crate) fn new(output: &'o Output, destination: &'o Destination, input: Option<&Path>) -> Self {
        let place = |path: &Path| (path.to_owned(), Place::of_input(path));
        Self { output, destination, inputs: input.into_iter().map(place).collect(), outputs: Vec::new() }
    }

    /// Where the answer goes: standard output unless there is a file for it.
    ///
    /// # Errors
    /// As [`Files::beside`].
    pub(crate) fn answer(&mut self) -> Result<Output, Failure> {
        match self.destination.file() {
            Some(path) => self.beside(path),
            None => self.standard(),
        }
    }

    /// A further file that is written; whether it can be is seen later.
    ///
    /// # Errors
    /// If it is one of the files that are read, or another one that is written.
    pub(crate) fn claim(&mut self, path: &Path) -> Result<(), Failure> {
        self.write(path, Place::of(path))
    }

    /// Standard output, which may be a file, too.
    ///
    /// # Errors
    /// If it is one of the files that are read, or another one that is written.
    pub(crate) fn standard(&mut self) -> Result<Output, Failure> {
        self.write(Path::new("standard output"), Place::of_stream(&io::stdout()))?;
        Ok(Output::standard(self.output.look()))
    }

    /// A further file that is written.
    ///
    /// # Errors
    /// If it is one of the files that are read, or another one that is written; if it exists and must not be
    /// overwritten, or is a folder, or in none: better said before the work than after it.
    pub(crate) fn beside(&mut self, path: &Path) -> Result<Output, Failure> {
        self.claim(path)?;
        be_possible(path)?;
        if !self.destination.force && is_regular(path) {
            return Err(Failure::OutputExists { path: path.to_owned() });
        }
        Ok(Output::file(self.output.look(), path, self.destination.force))
    }

    /// A further file that is read.
    ///
    /// # Errors
    /// If it is one of those that are written.
    #[cfg(feature = "parquet")]
    pub(crate) fn read(&mut self, path: &Path) -> Result<(), Failure> {
        let place = Place::of_input(path);
        if self.outputs.iter().any(|output| output.takes_the_place_of(&place)) {
            return Err(Failure::OverwritesInput { name: input::name(path) });
        }
        self.inputs.push((path.to_owned(), place));
        Ok(())
    }

    fn write(&mut self, path: &Path, place: Place) -> Result<(), Failure> {
        if let Some((input, _)) = self.inputs.iter().find(|(_, input)| place.takes_the_place_of(input)) {
            return Err(Failure::OverwritesInput { name: input::name(input) });
        }
        let clashes = |other: &Place| place.takes_the_place_of(other) || other.takes_the_place_of(&place);
        if self.outputs.iter().any(clashes) {
            return Err(Failure::SameOutput { path: path.to_owned() });
        }
        self.outputs.push(place);
        Ok(())
    }
}

/// The identity of a regular file, whether it exists or not; empty for devices and pipes, in which nothing is
/// lost.
#[derive(Default)]
struct Place {
    /// If it exists.
    file: Option<FileIdentity>,
    /// The folder in which it is or will be, and its name there.
    name: Option<(FileIdentity, OsString)>,
}

impl Place {
    fn of(path: &Path) -> Self {
        if path.exists() && !is_regular(path) {
            return Self::default();
        }
        let target = followed(path);
        let folder = target.parent().and_then(FileIdentity::of);
        Self { file: FileIdentity::of(path), name: folder.zip(target.file_name().map(OsString::from)) }
    }

    fn of_input(path: &Path) -> Self {
        if path == Path::new("-") {
            return Self::of_stream(&io::stdin());
        }
        Self::of(path)
    }

    /// A file that is a standard stream.
    #[cfg(unix)]
    fn of_stream(stream: &impl AsFd) -> Self {
        let file = stream.as_fd().try_clone_to_owned().ok().map(fs::File::from);
        Self { file: file.and_then(|file| FileIdentity::of_file(&file, Path::new(""))), name: None }
    }

    #[cfg(not(unix))]
    fn of_stream<S>(_: &S) -> Self {
        Self::default()
    }

    /// Whether it is another file, or what is kept beside it while it is unfinished is.
    fn takes_the_place_of(&self, other: &Self) -> bool {
        if self.file.is_some() && self.file == other.file {
            return true;
        }
        let (Some((folder, name)), Some((other_folder, other_name))) = (&self.name, &other.name) else {
            return false;
        };
        let unfinished = beside(Path::new(name), PARTIAL);
        let begins =
            |start: &Path| other_name.as_encoded_bytes().starts_with(start.as_os_str().as_encoded_bytes());
        folder == other_folder && (name == other_name || begins(&unfinished))
    }
}

/// Refuses folders, and files in what is no folder.
fn be_possible(path: &Path) -> Result<(), Failure> {
    let failure = |error| Err(Failure::CannotWrite { path: path.to_owned(), error });
    if path.is_dir() {
        return failure(io::ErrorKind::IsADirectory.into());
    }
    match followed(path).parent().map(fs::metadata) {
        _ if path.exists() => Ok(()),
        Some(Ok(folder)) if !folder.is_dir() => failure(io::ErrorKind::NotADirectory.into()),
        Some(Err(error)) => failure(error),
        _ => Ok(()),
    }
}
