//! The command line of slideway: arguments, files, colours; everything else is the library's.

#![forbid(unsafe_code)]

mod arguments;
mod columns;
mod commands;
mod diagnostics;
mod explain;
mod failure;
mod faulty_input;
mod files;
mod halt;
mod input;
mod metadata;
mod outcome;
mod output;
mod own_file;
mod picture;
mod pixels;
mod places;
mod threads;
mod time_series;
mod watch;

use anstream::ColorChoice;
use arguments::{Arguments, Command};
use clap::{CommandFactory, Parser};
use explain::explain;
use failure::Failure;
use outcome::Outcome;
use output::{Look, Output, complain};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = Arguments::try_parse().unwrap_or_else(|error| explain(&error));
    let color = arguments.color.into();
    threads::bound(color);
    let outcome = run(&arguments.command, &Output::standard(Look { color, verbose: arguments.verbose }));
    outcome.unwrap_or_else(|failure| refuse(&failure, color)).into()
}

fn run(command: &Command, output: &Output) -> Result<Outcome, Failure> {
    match command {
        Command::New(arguments) => commands::new(arguments, output),
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
        Command::Import(arguments) => commands::import(arguments, output),
        Command::Questions => commands::questions(output),
        Command::Schema => commands::schema(output),
        Command::Completions { shell } => commands::completions(*shell, Arguments::command(), output),
        Command::Man { folder } => commands::man(folder, Arguments::command()),
    }
}

fn refuse(failure: &Failure, color: ColorChoice) -> Outcome {
    complain(&failure.to_string(), color);
    failure.outcome()
}
