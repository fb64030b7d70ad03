//! `slideway modes`

use crate::arguments::{ModesArguments, ModesFormat, SearchArguments};
use crate::failure::Failure;
use crate::input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::{Watch, outcome};
use slideway::Report;
use slideway::raw_problem::{Listing, RawFault, RawProblem, SIZE_LIMIT, solve_with, to_npz};
use std::time::Instant;

/// Finds and writes all solutions of a problem given by its matrices.
pub(crate) fn modes(arguments: &ModesArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = output.to(&arguments.destination, Some(&arguments.file))?;
    // A large file takes its part of the time.
    let begun = Instant::now();
    let problem = read(arguments)?;
    let SearchArguments { max_solutions, time, .. } = &arguments.search;
    let mut watch = Watch::since(begun, time.time_limit);
    let options = arguments.search.options();
    let listing = Listing { most: *max_solutions, all_faces: arguments.all_faces };
    let mut report = solve_with(&problem, &options, listing, &mut |progress| watch.look(progress))
        .expect("shapes and values are checked where the problem is read");
    if arguments.uniqueness {
        report.every_right_hand_side =
            problem.every_right_hand_side(&mut |progress| watch.look(progress)).ok();
    }
    let halt = watch.finish();
    match arguments.format() {
        ModesFormat::Text => output.write(&report.text(output.style()))?,
        ModesFormat::Json => output.write(&report.json())?,
        ModesFormat::Npz => output.write_bytes(&to_npz(&report))?,
    }
    Ok(outcome(halt, report.status.into()))
}

fn read(arguments: &ModesArguments) -> Result<RawProblem, Failure> {
    let path = arguments.file.as_path();
    let bytes = input::read_bytes(path, SIZE_LIMIT).map_err(|failure| match failure {
        Failure::NotFound { path, .. } => Failure::NoProblem { path },
        other => other,
    })?;
    let problem = match bytes {
        Some(bytes) => RawProblem::from_bytes(&bytes),
        None => Err(RawFault::TooLarge { limit: SIZE_LIMIT }.into()),
    };
    problem.map_err(|faults| Failure::Problem { name: input::name(path), faults })
}
