//! Where answers and complaints go: standard output, a file that is written whole or not at all, standard
//! error.

use crate::arguments::{CheckFormat, Destination};
use crate::failure::Failure;
use crate::paths::followed;
use anstream::{AutoStream, ColorChoice};
use slideway::report::{Report, Style};
use slideway_tables::{PARTIAL, beside};
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// Where the answer of a command goes.
#[derive(Debug)]
pub(crate) struct Output {
    color: ColorChoice,
    file: Option<OutputFile>,
}

#[derive(Debug)]
struct OutputFile {
    path: PathBuf,
    overwrite: bool,
}

impl Output {
    /// Standard output.
    pub(crate) fn standard(color: ColorChoice) -> Self {
        Self { color, file: None }
    }

    /// Where the arguments want it, which is not where `input` is read from.
    ///
    /// # Errors
    /// If it would take the place of the input, or the file exists and must not be overwritten: better said
    /// before the work than after it.
    pub(crate) fn to(&self, destination: &Destination, input: Option<&Path>) -> Result<Self, Failure> {
        if let (Some(input), Some(file)) = (input, destination.file())
            && takes_the_place_of(&file, input)
        {
            return Err(Failure::OverwritesInput { path: input.to_owned() });
        }
        let file = destination
            .output
            .as_ref()
            .filter(|path| path.as_os_str() != "-")
            .map(|path| OutputFile { path: path.clone(), overwrite: destination.force });
        if let Some(file) = &file
            && !file.overwrite
            && is_regular(&file.path)
        {
            return Err(Failure::OutputExists { path: file.path.clone() });
        }
        Ok(Self { color: self.color, file })
    }

    /// The file it goes to; a link is followed.
    pub(crate) fn path(&self) -> Option<PathBuf> {
        self.file.as_ref().map(|file| followed(&file.path))
    }

    /// From now on it goes beside the file, to `FILE.partial`, unless it goes to a device or a pipe; gives
    /// that path.
    pub(crate) fn be_partial(&mut self) -> Option<PathBuf> {
        let file = self.file.as_mut().filter(|file| !file.path.exists() || is_regular(&file.path))?;
        *file = OutputFile { path: beside(&followed(&file.path), PARTIAL), overwrite: true };
        Some(file.path.clone())
    }

    /// When to use colours.
    pub(crate) fn color(&self) -> ColorChoice {
        self.color
    }

    /// Whether text that accompanies the answer, on a standard stream, may use colours.
    pub(crate) fn style_of_text(&self) -> Style {
        Self::standard(self.color).style()
    }

    /// Standard output, or a device or pipe, for an answer that is written bit by bit.
    ///
    /// # Errors
    /// If it cannot be opened.
    pub(crate) fn stream(&self) -> Result<Box<dyn Write + Send>, Failure> {
        let Some(file) = &self.file else { return Ok(Box::new(io::stdout())) };
        let opened = fs::OpenOptions::new().write(true).open(&file.path);
        opened.map(|file| Box::new(file) as Box<dyn Write + Send>).map_err(|error| self.failure(error))
    }

    /// That the stream cannot be written.
    pub(crate) fn failure(&self, error: io::Error) -> Failure {
        match &self.file {
            Some(file) => Failure::CannotWrite { path: file.path.clone(), error },
            None => Failure::StandardOutput { error },
        }
    }

    /// Whether text that goes there may use colours.
    pub(crate) fn style(&self) -> Style {
        let choice = match self.color {
            ColorChoice::Auto => AutoStream::choice(&io::stdout()),
            choice => choice,
        };
        if self.file.is_none() && choice != ColorChoice::Never { Style::Colour } else { Style::Plain }
    }

    /// Writes an answer that is no text.
    ///
    /// # Errors
    /// If it cannot be written, or would go to a terminal.
    pub(crate) fn write_bytes(&self, bytes: &[u8]) -> Result<(), Failure> {
        if let Some(file) = &self.file {
            return file.write(bytes);
        }
        let mut stream = io::stdout().lock();
        if stream.is_terminal() {
            return Err(Failure::BinaryOnTerminal);
        }
        match stream.write_all(bytes).and_then(|()| stream.flush()) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::StandardOutput { error }),
            _ => Ok(()),
        }
    }

    /// Writes a report in the form that is asked for.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub(crate) fn tell(&self, report: &impl Report, format: CheckFormat) -> Result<(), Failure> {
        self.write(&match format {
            CheckFormat::Text => report.text(self.style()),
            CheckFormat::Json => report.json(),
        })
    }

    /// Writes the answer. A reader that goes away early (`| head`) has seen all it wanted.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn write(&self, text: &str) -> Result<(), Failure> {
        if let Some(file) = &self.file {
            return file.write(text.as_bytes());
        }
        let mut stream = AutoStream::new(io::stdout(), self.color).lock();
        match stream.write_all(text.as_bytes()).and_then(|()| stream.flush()) {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::StandardOutput { error }),
            _ => Ok(()),
        }
    }
}

impl OutputFile {
    /// Through a temporary file in the same directory that is renamed; devices and pipes are written
    /// directly.
    fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let failure = |error| Failure::CannotWrite { path: self.path.clone(), error };
        if self.path.exists() && !is_regular(&self.path) {
            return match fs::write(&self.path, bytes) {
                Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(failure(error)),
                _ => Ok(()),
            };
        }
        // A link is followed: its target is replaced, not the link.
        let target = followed(&self.path);
        let directory = match target.parent() {
            Some(parent) if parent != Path::new("") => parent,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".slideway-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As any new file: all rights but those that the umask takes.
            let mode = fs::metadata(&target).map_or(0o666, |metadata| metadata.permissions().mode());
            builder.permissions(fs::Permissions::from_mode(mode));
        }
        let mut file = builder.tempfile_in(directory).map_err(failure)?;
        file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(failure)?;
        let written = if self.overwrite { file.persist(&target) } else { file.persist_noclobber(&target) };
        match written {
            Ok(_) => Ok(()),
            Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => {
                Err(Failure::OutputExists { path: self.path.clone() })
            }
            Err(error) => Err(failure(error.error)),
        }
    }
}

/// Whether a file, or what is kept beside it while it is unfinished, has the place of an input.
fn takes_the_place_of(file: &Path, input: &Path) -> bool {
    let Ok(input) = input.canonicalize() else { return false };
    let unfinished = beside(file, PARTIAL);
    input == file
        || input.as_os_str().as_encoded_bytes().starts_with(unfinished.as_os_str().as_encoded_bytes())
}

fn is_regular(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|metadata| metadata.is_file())
}

/// Writes a message to standard error; if that is closed there is nobody to tell.
pub(crate) fn complain(message: &str, color: ColorChoice) {
    let mut stream = AutoStream::new(io::stderr(), color).lock();
    let _ = writeln!(stream, "{message}");
}

/// One line on standard error that is written over and over, if that is a terminal.
#[derive(Debug)]
pub(crate) struct ProgressLine {
    on_terminal: bool,
    written: bool,
}

impl ProgressLine {
    /// Nothing is written yet.
    pub(crate) fn new() -> Self {
        Self { on_terminal: io::stderr().is_terminal(), written: false }
    }

    /// Nothing is written from now on.
    pub(crate) fn hush(&mut self) {
        self.on_terminal = false;
    }

    /// Puts this in the place of what stood there.
    pub(crate) fn show(&mut self, text: &str) {
        if self.on_terminal {
            let _ = write!(io::stderr(), "\r\x1b[K{text}");
            self.written = true;
        }
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        if self.written {
            clear_progress();
        }
    }
}

/// Takes the line of progress away.
pub(crate) fn clear_progress() {
    if io::stderr().is_terminal() {
        let _ = write!(io::stderr(), "\r\x1b[K");
    }
}
