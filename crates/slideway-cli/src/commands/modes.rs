//! `slideway modes`

mod batch;
mod stream;

use super::proof::{ProofFiles, text_of};
use crate::arguments::{ModesArguments, ModesFormat};
use crate::failure::Failure;
use crate::files::Files;
use crate::input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::{Watch, outcome};
use slideway::Report;
use slideway::progress::Callback;
use slideway::raw_problem::{RawFault, RawKind, RawProblem, RawReport, SIZE_LIMIT, solve, to_npz};
use std::path::Path;
use std::time::Instant;

/// Finds and writes all solutions of a problem given by its matrices.
pub(crate) fn modes(arguments: &ModesArguments, output: &Output) -> Result<Outcome, Failure> {
    if arguments.json_lines {
        return batch::batch(arguments, output);
    }
    if arguments.stream {
        return stream::stream(arguments, output);
    }
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.file));
    let output = files.answer()?;
    // A large file takes its part of the time.
    let begun = Instant::now();
    let problem = read(arguments)?;
    let proof = arguments.proof.as_deref().map(|path| proof_files(&problem, path, arguments, &mut files));
    let proof = proof.transpose()?;
    let mut watch = Watch::since(begun, arguments.time_limit());
    let report = answer(&problem, arguments, &mut |progress| watch.look(progress));
    match arguments.format() {
        ModesFormat::Text => output.write(&report.text(output.style()))?,
        ModesFormat::Json => output.write(&report.json())?,
        ModesFormat::Npz => output.write_bytes(&to_npz(&report))?,
    }
    if let Some(proof) = proof {
        let exact = problem.mode_problem().expect("shapes and values are checked where the problem is read");
        proof.write(&exact, &arguments.file, &arguments.options(), &mut watch)?;
    }
    Ok(outcome(watch.finish(), report.status.into()))
}

/// Where a proof goes.
///
/// # Errors
/// If there can be none, which is better said before the search than after it.
fn proof_files(
    problem: &RawProblem,
    path: &Path,
    arguments: &ModesArguments,
    files: &mut Files<'_>,
) -> Result<ProofFiles, Failure> {
    if problem.kind() == RawKind::BlockAve {
        let reason = "it states linear equations, and lengths of blocks are no linear functions".to_owned();
        return Err(Failure::NoProof { reason });
    }
    let checker_reads = checker_reads(problem, arguments);
    if !checker_reads {
        text_of(&problem.mode_problem().expect("shapes and values are checked where the problem is read"))?;
    }
    ProofFiles::new(path, checker_reads, files)
}

/// Whether the checker of proofs reads the problem as it is given: one of its types, in a file of JSON.
fn checker_reads(problem: &RawProblem, arguments: &ModesArguments) -> bool {
    let is_npz = arguments.file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("npz"));
    let known = [RawKind::Lcp, RawKind::Ave, RawKind::Hlcp, RawKind::Modes];
    known.contains(&problem.kind()) && !is_npz && arguments.file.as_os_str() != "-"
}

/// The answer to a problem.
fn answer(problem: &RawProblem, arguments: &ModesArguments, progress: &mut Callback<'_>) -> RawReport {
    let mut report = solve(problem, &arguments.options(), arguments.most_listed(), progress)
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

/// Returns the failure of a missing problem file in place of that of a missing model file; others stay as
/// they are.
fn no_problem(failure: Failure) -> Failure {
    match failure {
        Failure::NotFound { path, .. } => Failure::NoProblem { path },
        other => other,
    }
}
