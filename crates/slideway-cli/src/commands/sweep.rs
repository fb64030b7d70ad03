//! `slideway sweep`

use crate::Outcome;
use crate::arguments::{SweepArguments, TableFormat};
use crate::failure::Failure;
use crate::input::Input;
use crate::output::{Output, complain};
use crate::table::{Continued, Encoder, Layout, Metadata, PartialFile};
use crate::watch::SweepWatch;
use slideway::sweep::{Sweep, SweepState, to_text};
use std::ffi::OsString;
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Arguments that do not change the table.
const LEFT_OUT: [&str; 2] = ["--resume", "--force"];

/// Computes all solutions at every point of a grid or sample, and writes them to a table.
pub(crate) fn sweep(arguments: &SweepArguments, output: &Output) -> Result<Outcome, Failure> {
    let format = format(arguments)?;
    let destination = output.to(&arguments.destination)?;
    arguments.model.spare(&arguments.destination)?;
    let input = Input::read(&arguments.model)?;
    let model = input.model()?;
    let options = arguments.options();
    let sweep = Sweep::new(&model, &options).map_err(|faults| input.refused(faults))?;
    let metadata = Metadata { command: command(std::env::args_os()), model: input.text() };
    let layout = Layout::of(&sweep, options.vary.len(), options.attainability);
    let encoder = Encoder::new(format, layout, metadata);
    let interrupted = Arc::new(AtomicBool::new(false));
    match destination.path().filter(|path| !is_special(path)) {
        Some(path) => to_file(arguments, &sweep, (path, encoder), &interrupted, &destination),
        None if format == TableFormat::Csv => stream(&sweep, &encoder, &destination),
        None => Err(Failure::NoStream),
    }
}

/// The form of the table: what is asked for, or what the ending of the output tells.
fn format(arguments: &SweepArguments) -> Result<TableFormat, Failure> {
    let path = arguments.destination.output.as_deref().filter(|path| *path != Path::new("-"));
    let ending = path.and_then(|path| path.extension()?.to_str());
    match (arguments.format, ending) {
        (Some(format), _) => Ok(format),
        (None, Some("csv") | None) => Ok(TableFormat::Csv),
        (None, Some("npz")) => Ok(TableFormat::Npz),
        (None, Some(_)) => Err(Failure::UnknownEnding { path: path.map(Path::to_owned).unwrap_or_default() }),
    }
}

/// Whether a path exists and is no regular file: a device or a pipe, which cannot be renamed to.
fn is_special(path: &Path) -> bool {
    path.exists() && !path.is_file()
}

/// The command as it may be given again.
fn command(arguments: impl Iterator<Item = OsString>) -> String {
    let words = arguments.skip(1).map(|word| word.to_string_lossy().into_owned());
    let kept = words.filter(|word| !LEFT_OUT.contains(&word.as_str()));
    kept.fold("slideway".to_owned(), |command, word| format!("{command} {}", quoted(&word)))
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_./=:,+%@".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

fn to_file(
    arguments: &SweepArguments,
    sweep: &Sweep,
    (path, encoder): (PathBuf, Encoder),
    interrupted: &Arc<AtomicBool>,
    output: &Output,
) -> Result<Outcome, Failure> {
    let Continued { mut file, state } =
        PartialFile::open(&path, encoder.clone(), (arguments.resume, arguments.destination.force))?;
    let mut state = state.unwrap_or_else(|| sweep.start());
    let flag = Arc::clone(interrupted);
    // Without a handler an interruption ends the program at once; the last state is still there.
    let _ = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed));
    let mut watch = SweepWatch::new(state.done, sweep.points());
    let mut failure = None;
    let mut last: Option<SweepState> = None;
    sweep.run(&mut state, &|rows| encoder.rows(rows), &mut |rows, state| {
        watch.look(state.done);
        if let Err(error) = file.add(&rows, state) {
            failure = Some(error);
            return ControlFlow::Break(());
        }
        if interrupted.load(Ordering::Relaxed) && state.done < sweep.points() {
            last = Some(state.clone());
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    drop(watch);
    if let Some(failure) = failure {
        return Err(failure);
    }
    if let Some(state) = last {
        file.keep(&state)?;
        return Err(Failure::Interrupted { done: state.done, points: sweep.points(), path: file.path() });
    }
    file.complete()?;
    Output::standard(output.color()).write(&to_text(sweep, &state, output.style_of_text()))?;
    Ok(Outcome::Done)
}

/// Writes the table to standard output, or to a device or a pipe; what it comes to goes to standard error.
fn stream(sweep: &Sweep, encoder: &Encoder, output: &Output) -> Result<Outcome, Failure> {
    let mut target = output.stream()?;
    let mut result = target.write_all(&encoder.head());
    let mut state = sweep.start();
    if result.is_ok() {
        sweep.run(&mut state, &|rows| encoder.rows(rows), &mut |rows, _| {
            result = rows.iter().try_for_each(|rows| target.write_all(rows));
            if result.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
    }
    match result.and_then(|()| target.flush()) {
        // A reader that goes away early has seen all it wanted.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => return Ok(Outcome::Done),
        Err(error) => return Err(output.failure(error)),
        Ok(()) => {}
    }
    if !io::stdout().is_terminal() || output.path().is_some() {
        complain(to_text(sweep, &state, output.style_of_text()).trim_end(), output.color());
    }
    Ok(Outcome::Done)
}
