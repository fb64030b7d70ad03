//! Where answers and complaints go: standard output, a file that is written whole or not at all, standard
//! error.

use crate::arguments::CheckFormat;
use crate::failure::Failure;
use crate::places::{followed, is_regular};
use anstream::{AutoStream, ColorChoice};
use slideway::printable;
use slideway::report::{Report, Style};
use slideway_tables::{PARTIAL, beside};
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};
use terminal_size::{Width, terminal_size_of};

/// Where the answer of a command goes.
#[derive(Debug)]
pub(crate) struct Output {
    look: Look,
    file: Option<OutputFile>,
}

/// How text looks, as it was asked for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Look {
    /// When to use colours.
    pub(crate) color: ColorChoice,
    /// Whether to show the details.
    pub(crate) verbose: bool,
}

#[derive(Debug)]
struct OutputFile {
    /// Its path as it was given, for messages.
    path: PathBuf,
    /// The file that is meant: links are followed.
    target: PathBuf,
    overwrite: bool,
    /// Whether it is a device or a pipe, which is written directly.
    is_stream: bool,
}

impl Output {
    /// Standard output.
    pub(crate) fn standard(look: Look) -> Self {
        Self { look, file: None }
    }

    /// A file. [`crate::files::Files`] sees to it that it may be written.
    pub(crate) fn file(look: Look, path: &Path, overwrite: bool) -> Self {
        let is_stream = path.exists() && !is_regular(path);
        Self {
            look,
            file: Some(OutputFile { path: path.to_owned(), target: followed(path), overwrite, is_stream }),
        }
    }

    /// The file it goes to; a link is followed.
    pub(crate) fn path(&self) -> Option<PathBuf> {
        self.file.as_ref().map(|file| file.target.clone())
    }

    /// From now on it goes beside the file, to `FILE.partial`, unless it goes to a device or a pipe; gives
    /// that path. A link of that name is replaced, not followed.
    pub(crate) fn be_partial(&mut self) -> Option<PathBuf> {
        let file = self.file.as_mut().filter(|file| !file.is_stream)?;
        let path = beside(&file.target, PARTIAL);
        *file = OutputFile { path: path.clone(), target: path.clone(), overwrite: true, is_stream: false };
        Some(path)
    }

    /// Says on a terminal that its file was written; elsewhere the reader is a program.
    ///
    /// # Errors
    /// As [`Output::write`].
    pub(crate) fn announce(&self) -> Result<(), Failure> {
        match &self.file {
            Some(file) if io::stdout().is_terminal() => Self::standard(self.look).write(&wrote(&file.path)),
            _ => Ok(()),
        }
    }

    /// When to use colours.
    pub(crate) fn color(&self) -> ColorChoice {
        self.look.color
    }

    /// How text looks.
    pub(crate) fn look(&self) -> Look {
        self.look
    }

    /// Whether somebody reads it as it is written.
    pub(crate) fn is_terminal(&self) -> bool {
        self.file.is_none() && io::stdout().is_terminal()
    }

    /// Whether text that accompanies the answer, on a standard stream, may use colours.
    pub(crate) fn style_of_text(&self) -> Style {
        Self::standard(self.look).style()
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

    /// Builds the failure of a stream that cannot be written.
    pub(crate) fn failure(&self, error: io::Error) -> Failure {
        match &self.file {
            Some(file) => Failure::CannotWrite { path: file.path.clone(), error },
            None => Failure::StandardOutput { error },
        }
    }

    /// Whether a stream was written. A reader that goes away early (`| head`) has seen all it wanted.
    ///
    /// # Errors
    /// If it could not be written.
    pub(crate) fn told(&self, written: io::Result<()>) -> Result<(), Failure> {
        match written {
            Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(self.failure(error)),
            _ => Ok(()),
        }
    }

    /// How text that goes there looks: as wide as the terminal is, elsewhere 100 columns.
    pub(crate) fn style(&self) -> Style {
        let choice = match self.look.color {
            ColorChoice::Auto => AutoStream::choice(&io::stdout()),
            choice => choice,
        };
        let style = Style::PLAIN.verbose(self.look.verbose);
        if self.file.is_some() {
            return style;
        }
        // Where there is no terminal, or one that does not say how wide it is, the environment may.
        let told = || std::env::var("COLUMNS").ok()?.parse().ok().filter(|columns| *columns > 0);
        let columns = terminal_size_of(io::stdout()).map(|(Width(columns), _)| columns.into()).or_else(told);
        let columns = columns.unwrap_or(style.width);
        style.colour(choice != ColorChoice::Never).width(columns)
    }

    /// Writes an answer that is no text.
    ///
    /// # Errors
    /// If it cannot be written, or would go to a terminal.
    pub(crate) fn write_bytes(&self, bytes: &[u8]) -> Result<(), Failure> {
        if let Some(file) = &self.file {
            return if file.is_stream { self.told(fs::write(&file.path, bytes)) } else { file.write(bytes) };
        }
        let mut stream = io::stdout().lock();
        if stream.is_terminal() {
            return Err(Failure::BinaryOnTerminal);
        }
        self.told(stream.write_all(bytes).and_then(|()| stream.flush()))
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

    /// Writes the answer.
    ///
    /// # Errors
    /// If it cannot be written.
    pub(crate) fn write(&self, text: &str) -> Result<(), Failure> {
        if self.file.is_some() {
            return self.write_bytes(text.as_bytes());
        }
        let mut stream = AutoStream::new(io::stdout(), self.look.color).lock();
        self.told(stream.write_all(text.as_bytes()).and_then(|()| stream.flush()))
    }
}

impl OutputFile {
    /// Through a temporary file in the same directory that is renamed.
    fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let failure = |error| Failure::CannotWrite { path: self.path.clone(), error };
        let target = &self.target;
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
            let found = fs::symlink_metadata(target).ok().filter(fs::Metadata::is_file);
            let mode = found.map_or(0o666, |metadata| metadata.permissions().mode());
            builder.permissions(fs::Permissions::from_mode(mode));
        }
        let mut file = builder.tempfile_in(directory).map_err(failure)?;
        file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(failure)?;
        let written = if self.overwrite { file.persist(target) } else { file.persist_noclobber(target) };
        match written {
            Ok(_) => Ok(()),
            Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => {
                Err(Failure::OutputExists { path: self.path.clone() })
            }
            Err(error) => Err(failure(error.error)),
        }
    }
}

/// "Wrote drawer.svg."
pub(crate) fn wrote(path: &Path) -> String {
    format!("Wrote {}.\n", printable::line(&path.display().to_string()))
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
