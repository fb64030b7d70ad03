//! `slideway modes --stream`: each solution in a line as soon as it is certain.

use super::read;
use crate::arguments::ModesArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::{Watch, outcome};
use slideway::Report;
use slideway::raw_problem::{RawLine, solve_streaming};
use std::io;
use std::ops::ControlFlow;
use std::time::Instant;

/// Writes what is found, and at last what is known then. A reader that goes away ends the search.
pub(super) fn stream(arguments: &ModesArguments, output: &Output) -> Result<Outcome, Failure> {
    let begun = Instant::now();
    let output = Files::new(output, &arguments.destination, Some(&arguments.file)).answer()?;
    let problem = read(arguments)?;
    let mut stream = output.stream()?;
    let mut watch = Watch::beside_rows(arguments.time_limit());
    let mut written = Ok(());
    let mut write = |line: &RawLine| {
        written = stream.write_all(line.json_line().as_bytes()).and_then(|()| stream.flush());
        if written.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    };
    let progress = &mut |progress: &_| watch.look(progress);
    let mut conclusion =
        solve_streaming(&problem, &arguments.options(), arguments.most_listed(), progress, &mut write)
            .expect("shapes and values are checked where the problem is read");
    if arguments.uniqueness {
        conclusion.report.every_right_hand_side = problem.every_right_hand_side(progress).ok();
    }
    let status = conclusion.report.status;
    conclusion.seconds = Some(begun.elapsed().as_secs_f64());
    if write(&RawLine::Conclusion(Box::new(conclusion))).is_break()
        && let Err(error) = written
        && error.kind() != io::ErrorKind::BrokenPipe
    {
        return Err(output.failure(error));
    }
    Ok(outcome(watch.finish(), status.into()))
}
