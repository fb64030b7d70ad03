//! The command line of slideway: arguments, files, colours; everything else is the library's.

mod arguments;
mod commands;
mod diagnostics;
mod failure;
mod faulty_input;
mod files;
mod halt;
mod input;
mod metadata;
mod outcome;
mod output;
mod picture;
mod pixels;
mod threads;
mod time_series;
mod watch;

use anstream::ColorChoice;
use arguments::{Arguments, Command};
use clap::builder::Styles;
use clap::{CommandFactory, Parser};
use failure::Failure;
use outcome::Outcome;
use output::{Look, Output, complain};
use slideway::printable;
use std::borrow::Cow;
use std::io::{self, Write};
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

/// Says what is wrong with the arguments, or the help or version that they ask for, and ends the program.
///
/// A complaint quotes arguments as they are. If one of them is not printable, it is told without colours, so
/// that whatever is still in it comes from the arguments.
fn explain(error: &clap::Error) -> ! {
    let is_printable =
        |word: std::ffi::OsString| matches!(printable::line(&word.to_string_lossy()), Cow::Borrowed(_));
    if !error.use_stderr() {
        let printed = error.print().and_then(|()| io::stdout().flush());
        let told = Output::standard(Look { color: ColorChoice::Auto, verbose: false })
            .told(printed)
            .map(|()| Outcome::Done);
        let outcome = told.unwrap_or_else(|failure| refuse(&failure, ColorChoice::Auto));
        std::process::exit(i32::from(outcome as u8));
    }
    if std::env::args_os().all(is_printable) {
        error.exit();
    }
    let plain = Arguments::command().styles(Styles::plain()).try_get_matches().err();
    let text = plain.map_or_else(String::new, |plain| plain.render().ansi().to_string());
    complain(printable::lines(&text).trim_end(), ColorChoice::Never);
    std::process::exit(error.exit_code());
}

fn refuse(failure: &Failure, color: ColorChoice) -> Outcome {
    complain(&failure.to_string(), color);
    failure.outcome()
}
