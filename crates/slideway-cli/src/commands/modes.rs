//! `slideway modes`

mod batch;

use crate::arguments::{ModesArguments, ModesFormat};
use crate::failure::Failure;
use crate::input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::{Watch, outcome};
use slideway::Report;
use slideway::progress::Callback;
use slideway::raw_problem::{RawFault, RawProblem, RawReport, SIZE_LIMIT, solve_with, to_npz};
use std::time::Instant;

/// Finds and writes all solutions of a problem given by its matrices.
pub(crate) fn modes(arguments: &ModesArguments, output: &Output) -> Result<Outcome, Failure> {
    if arguments.json_lines {
        return batch::batch(arguments, output);
    }
    let output = output.to(&arguments.destination, Some(&arguments.file))?;
    // A large file takes its part of the time.
    let begun = Instant::now();
    let problem = read(arguments)?;
    let mut watch = Watch::since(begun, arguments.time_limit());
    let report = answer(&problem, arguments, &mut |progress| watch.look(progress));
    let halt = watch.finish();
    match arguments.format() {
        ModesFormat::Text => output.write(&report.text(output.style()))?,
        ModesFormat::Json => output.write(&report.json())?,
        ModesFormat::Npz => output.write_bytes(&to_npz(&report))?,
    }
    Ok(outcome(halt, report.status.into()))
}

/// The answer to a problem.
fn answer(problem: &RawProblem, arguments: &ModesArguments, progress: &mut Callback<'_>) -> RawReport {
    let mut report = solve_with(problem, &arguments.options(), arguments.listing(), progress)
        .expect("shapes and values are checked where the problem is read");
    if arguments.uniqueness {
        report.every_right_hand_side = problem.every_right_hand_side(progress).ok();
    }
    report
}

fn read(arguments: &ModesArguments) -> Result<RawProblem, Failure> {
    let path = arguments.file.as_path();
    let bytes = input::read_bytes(path, SIZE_LIMIT).map_err(no_problem)?;
    let problem = match bytes {
        Some(bytes) => RawProblem::from_bytes(&bytes),
        None => Err(RawFault::TooLarge { limit: SIZE_LIMIT }.into()),
    };
    problem.map_err(|faults| Failure::Problem { name: input::name(path), faults })
}

/// What is told of a file that does not exist.
fn no_problem(failure: Failure) -> Failure {
    match failure {
        Failure::NotFound { path, .. } => Failure::NoProblem { path },
        other => other,
    }
}
