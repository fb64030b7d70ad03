//! The command line of slideway: arguments, files, colours; everything else is the library's.

mod arguments;
mod commands;
mod diagnostics;
mod failure;
mod input;
mod output;
mod picture;
mod pixels;
mod table;
mod threads;
mod time_series;
mod watch;

use arguments::{Arguments, Command};
use clap::{CommandFactory, Parser};
use failure::Failure;
use output::Output;
use slideway::report::Status;
use std::process::ExitCode;

/// What a command found, as its exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// There are solutions, or the command did what it was asked to do.
    Done = 0,
    /// There is no solution: friction locks the mechanism.
    NoSolution = 1,
    /// The input makes no sense.
    Refused = 2,
    /// The search was incomplete and found nothing, or time was up.
    Unknown = 3,
    /// It was interrupted.
    Interrupted = 130,
}

impl From<Status> for Outcome {
    fn from(status: Status) -> Self {
        match status {
            Status::One | Status::Several | Status::Continuum | Status::PreloadGap => Self::Done,
            Status::None => Self::NoSolution,
            Status::Unknown => Self::Unknown,
        }
    }
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        Self::from(outcome as u8)
    }
}

fn main() -> ExitCode {
    let arguments = Arguments::try_parse().unwrap_or_else(|error| arguments::explain(&error));
    let color = arguments.color.into();
    threads::bound(color);
    let outcome = run(&arguments.command, &Output::standard(color));
    outcome.unwrap_or_else(|failure| refuse(&failure, color)).into()
}

fn run(command: &Command, output: &Output) -> Result<Outcome, Failure> {
    match command {
        Command::Solve(arguments) => commands::solve(arguments, output),
        Command::Limits(arguments) => commands::limits(arguments, output),
        Command::Size(arguments) => commands::size(arguments, output),
        Command::Drive(arguments) => commands::drive(arguments, output),
        Command::Map(arguments) => commands::map(arguments, output),
        Command::Check(arguments) => commands::check(arguments, output),
        Command::Simulate(arguments) => commands::simulate(arguments, output),
        Command::Hold(arguments) => commands::hold(arguments, output),
        Command::Draw(arguments) => commands::draw(arguments, output),
        Command::Sweep(arguments) => commands::sweep(arguments, output),
        Command::Report(arguments) => commands::report(arguments, output),
        Command::Modes(arguments) => commands::modes(arguments, output),
        Command::Models(arguments) => commands::models(arguments, output),
        Command::Schema => commands::schema(output),
        Command::Completions { shell } => commands::completions(*shell, Arguments::command(), output),
    }
}

fn refuse(failure: &Failure, color: anstream::ColorChoice) -> Outcome {
    output::complain(&failure.to_string(), color);
    failure.outcome()
}
