//! `slideway solve`

use super::proof::ProofFiles;
use crate::arguments::{Format, SolveArguments};
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::{Watch, outcome};
use slideway::Report;
use slideway::fault::{FaultKind, Faults, NoSliding};
use slideway::solve::{SolveOptions, exact_mode_problem, solve_with};

/// Finds and writes all solutions of a model.
pub(crate) fn solve(arguments: &SolveArguments, output: &Output) -> Result<Outcome, Failure> {
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
    let output = files.answer()?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model_within_bounds()?;
    let search = &arguments.search;
    let options = SolveOptions::default().search(search.options()).most(search.max_solutions);
    let proof = arguments.proof.as_deref();
    let proof = proof.map(|path| ProofFiles::new(path, false, &mut files)).transpose()?;
    let problem = proof.as_ref().map(|_| exact_mode_problem(&model)).transpose();
    let problem = problem.map_err(|faults| without_proof(faults, &input))?;
    let mut watch = Watch::new(arguments.search.time.time_limit);
    let report = solve_with(&model, &options, &mut |progress| watch.look(progress));
    let report = report.map_err(|faults| match watch.halt() {
        // The positions are not known, without which there is nothing to tell.
        Some(halt) if faults.sorted().iter().any(|fault| fault.kind == FaultKind::WorkEnded) => {
            Failure::Halted { halt, path: None }
        }
        _ => input.refused(faults),
    })?;
    output.write(&match arguments.format {
        Format::Text => report.text(output.style()),
        Format::Json => report.json(),
        Format::Csv => report.csv(),
    })?;
    if let Some((proof, problem)) = proof.zip(problem) {
        proof.write(&problem, &arguments.model.file, &search.options(), &mut watch)?;
    }
    Ok(outcome(watch.finish(), report.status.into()))
}

/// The failure of a problem of which no proof is written.
fn without_proof(faults: Faults, input: &Input) -> Failure {
    let reason = faults.sorted().iter().find_map(|fault| match &fault.kind {
        FaultKind::FrictionInHinges { hinges } => {
            Some(format!("{} are hinges with friction", hinges.join(", ")))
        }
        FaultKind::ZeroSlidingVelocity { contacts, why: NoSliding::Starts | NoSliding::Stands } => {
            Some(format!(
                "for contacts at rest ({}) there is one only if static and kinetic friction are equal, without preload and height, \
                 and sticking leaves no force undetermined; without `--proof` their states are listed, in floating point",
                contacts.join(", ")
            ))
        }
        _ => None,
    });
    match reason {
        Some(reason) => Failure::NoProof { reason },
        None => input.refused(faults),
    }
}
