//! The commands: each reads its input, calls the library and writes the answer.

mod check;
mod draw;
mod drive;
mod hold;
mod import;
mod limits;
mod map;
mod models;
mod modes;
mod new;
mod proof;
mod report;
mod simulate;
mod size;
mod solve;
mod sweep;

pub(crate) use check::check;
pub(crate) use draw::draw;
pub(crate) use drive::drive;
pub(crate) use hold::hold;
pub(crate) use import::import;
pub(crate) use limits::limits;
pub(crate) use map::map;
pub(crate) use models::models;
pub(crate) use modes::modes;
pub(crate) use new::new;
pub(crate) use report::report;
pub(crate) use simulate::simulate;
pub(crate) use size::size;
pub(crate) use solve::solve;
pub(crate) use sweep::sweep;

use crate::arguments::QUESTIONS;
use crate::failure::Failure;
use crate::outcome::Outcome;
use crate::output::Output;
use clap_complete::Shell;
use std::fs;
use std::io;
use std::path::Path;

/// Prints which command and which kind of model answers which question.
pub(crate) fn questions(output: &Output) -> Result<Outcome, Failure> {
    output.write(&format!("{QUESTIONS}\n"))?;
    Ok(Outcome::Done)
}

/// Prints the JSON Schema of model files.
pub(crate) fn schema(output: &Output) -> Result<Outcome, Failure> {
    output.write(&format!("{:#}\n", slideway::model::json_schema()))?;
    Ok(Outcome::Done)
}

/// Prints a completion script.
pub(crate) fn completions(
    shell: Shell,
    mut command: clap::Command,
    output: &Output,
) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut command, "slideway", &mut script);
    output.write(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Done)
}

/// Writes the manual pages of all commands to a new folder.
pub(crate) fn man(folder: &Path, command: clap::Command) -> Result<Outcome, Failure> {
    let failure = |error: io::Error| match error.kind() {
        io::ErrorKind::AlreadyExists => Failure::FolderExists { path: folder.to_owned() },
        _ => Failure::CannotWrite { path: folder.to_owned(), error },
    };
    fs::create_dir(folder).and_then(|()| clap_mangen::generate_to(command, folder)).map_err(failure)?;
    Ok(Outcome::Done)
}
