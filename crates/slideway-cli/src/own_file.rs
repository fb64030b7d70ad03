//! Pictures and pages in files that are named after their model: on a terminal they would be of no use.

use crate::arguments::Destination;
use crate::failure::Failure;
use crate::files::Files;
use crate::output::{Output, wrote};
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Where a picture or page goes.
pub(crate) struct Document {
    /// Its file, or standard output.
    pub(crate) output: Output,
    /// The name of its file, if nobody has named it.
    own: Option<PathBuf>,
    open: bool,
}

impl Document {
    /// The file that is named, else standard output; on a terminal, and if it is to be opened, a new file that has the
    /// name of the model with this ending.
    ///
    /// # Errors
    /// As [`Files::answer`], and if standard output is to be opened.
    pub(crate) fn new(
        files: &mut Files<'_>,
        destination: &Destination,
        (model, ending): (&Path, &str),
        open: bool,
    ) -> Result<Self, Failure> {
        let needs_name = destination.output.is_none() && (open || io::stdout().is_terminal());
        let own = needs_name.then(|| free_name(model, ending, destination.force));
        let output = match &own {
            Some(path) => files.beside(path)?,
            None => files.answer()?,
        };
        if open && output.path().is_none() {
            return Err(Failure::NothingToOpen);
        }
        Ok(Self { output, own, open })
    }

    /// Says which file was written, on a terminal and if nobody has named it, and opens it if it is to be.
    ///
    /// # Errors
    /// If no program opens it.
    pub(crate) fn finish(self, standard: &Output) -> Result<(), Failure> {
        match &self.own {
            Some(own) => standard.write(&wrote(own))?,
            None => self.output.announce()?,
        }
        match self.output.path() {
            Some(path) if self.open => open(&path),
            _ => Ok(()),
        }
    }
}

/// NAME with this ending, NAME-2, NAME-3 and so on: the first that does not exist. The name is that of the model, the
/// folder the present one.
pub(crate) fn free_name(model: &Path, ending: &str, overwrite: bool) -> PathBuf {
    let stem =
        model.file_stem().and_then(|stem| stem.to_str()).filter(|stem| *stem != "-").unwrap_or("model");
    let first = PathBuf::from(format!("{stem}{ending}"));
    if overwrite || !first.exists() {
        return first;
    }
    let mut further = (2_u64..).map(|number| PathBuf::from(format!("{stem}-{number}{ending}")));
    further.find(|path| !path.exists()).unwrap_or(first)
}

/// Shows a file in the program that the system has for its kind.
fn open(path: &Path) -> Result<(), Failure> {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("cmd", &["/C", "start", ""])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(arguments).arg(path).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        _ => Err(Failure::CannotOpen { path: path.to_owned(), program: program.to_owned() }),
    }
}
