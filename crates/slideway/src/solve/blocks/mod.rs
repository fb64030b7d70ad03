//! Solutions of the block mode problem, whose unknowns have one component (a contact) or two (a hinge with
//! friction), and what they are in the mechanism (theory of hinges).

mod branches;
mod found;
mod margins;
mod spin;
mod states;
mod uncertainty;

pub(crate) use states::{BlockState, LastSolution, block_states};

pub(crate) use branches::{block_instance, turning_hinges, unknowns_of};

use super::SolveOptions;
use super::answer::Answer;
use super::mode_problem::none_stands;
use super::stages::Stages;
use super::{sharing, standing};
use crate::configuration::Configuration;
use crate::enclosure::{UncertainParameters, enclosed_block_problem, enclosed_while};
use crate::fault::{Faults, MOST_CONTACTS};
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::model::{Model, ParameterRange};
use crate::modes::blocks::{self, BlockProblem};
use crate::progress::{Callback, as_far_as_wanted};
use crate::report::{MarginsMissing, SolveReport};
use branches::GrowingFriction;
use found::{BlockAnswer, BlocksFound};
use margins::Growth;
pub(crate) use margins::{factors_with_one_solution, locking_factor};
pub(crate) use spin::never_turning;
use spin::{Spins, never_turn, spins};

/// All solutions of a mechanism with friction in hinges, proven for these values of the model; and what the ranges of its
/// parameters leave certain.
///
/// # Errors
/// Hinges with friction that do not turn now, or more than one that never does; numbers beyond the range
/// of floating point.
pub(super) fn solve(
    model: &Model,
    (uncertain, ranges): (&UncertainParameters, &[ParameterRange]),
    (stages, equations): (&Stages, &KineticEquations),
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<SolveReport, Faults> {
    let Stages { mechanism, configuration, influence, .. } = stages;
    let Spins { turning, standing } = accepted_spins(mechanism, configuration, influence)?;
    if let [hinge] = &standing[..] {
        mechanism.check_no_one_sided("the range of the couple of a hinge that never turns")?;
        return standing::of_hinge(stages, equations, *hinge);
    }
    none_stands(mechanism, &stages.standing)?;
    let problem = stages.data().block_problem(&turning)?;
    let enclosed = enclosed_while(progress, |work| {
        enclosed_block_problem(model, uncertain, (mechanism, configuration), &turning, work)
    });
    let outputs = enclosed.as_ref().ok().map(|enclosed| &enclosed.outputs);
    let answer = Answer::of(stages, equations, outputs)?;
    let searched = enclosed.as_ref().map_or(&problem, |enclosed| &enclosed.problem);
    let result = blocks::search(searched, &options.search, progress);
    let found = BlocksFound { result: &result, rounded: enclosed.as_ref().err(), most: options.most };
    let without_friction = || Ok::<_, Faults>(GrowingFriction::new(stages, &turning)?.at(0.0)?.problem);
    let has_other_columns = answer.shared.is_some() || mechanism.has_one_sided();
    let frictionless = has_other_columns.then(without_friction).transpose()?;
    let answer =
        BlockAnswer { answer, problem: &problem, frictionless: frictionless.as_ref(), hinges: &turning };
    let (report, _) = as_far_as_wanted(progress, |work| {
        let growth = options.margins.then(|| Growth::new(stages, &turning, work)).transpose()?;
        let unique_at_least = growth
            .as_ref()
            .filter(|_| result.unique_for_every_load.is_some())
            .and_then(|growth| growth.unique_at_least(enclosed.as_ref().ok()?));
        Ok::<_, Faults>(SolveReport { unique_at_least, ..answer.report(&found, growth.as_ref()) })
    });
    let mut report = report?;
    sharing::add(&mut report, stages, false)?;
    Ok(SolveReport {
        margins_missing: options.margins.then_some(if mechanism.has_ends() {
            MarginsMissing::FrictionOnRods
        } else {
            MarginsMissing::FrictionInHinges
        }),
        uncertainty: answer.uncertainty(model, ranges, options, progress),
        ..report
    })
}

/// The block mode problem of a model with friction in hinges, in floating point: a problem with exact numbers, which
/// differ from those of the mechanism by rounding. Blocks are the contacts, then the hinges with friction in the order of
/// the model, with their forces on the first body of each.
///
/// # Errors
/// Whatever [`solve`](crate::solve::solve) refuses.
pub fn exact_block_problem(model: &Model) -> Result<BlockProblem, Faults> {
    let mechanism = Mechanism::new(model)?;
    mechanism.check_size()?;
    let configuration = Configuration::new(&mechanism)?;
    let (stages, _) = Stages::with_equations(mechanism, configuration)?;
    let Spins { turning, standing } = spins(&stages.mechanism, &stages.configuration, &stages.influence)?;
    never_turn(&stages.mechanism, &standing)?;
    stages.data().block_problem(&turning)
}

/// Refuses friction in hinges for which there is no mode problem in this state.
///
/// # Errors
/// As for [`solve`]; none without friction in hinges.
pub(crate) fn check_hinges(
    mechanism: &Mechanism,
    configuration: &Configuration,
    influence: &Influence,
) -> Result<(), Faults> {
    if mechanism.rough_hinges().next().is_none() {
        return Ok(());
    }
    accepted_spins(mechanism, configuration, influence).map(|_| ())
}

/// The hinges with friction: all of them turn, or there is one only, which never does.
///
/// # Errors
/// Hinges that do not turn now, or never, but for that one.
fn accepted_spins(
    mechanism: &Mechanism,
    configuration: &Configuration,
    influence: &Influence,
) -> Result<Spins, Faults> {
    let spins = spins(mechanism, configuration, influence)?;
    let has_few_contacts = mechanism.contacts.len() <= MOST_CONTACTS && mechanism.excess.is_empty();
    if !(spins.standing.len() == 1 && spins.turning.is_empty() && has_few_contacts) {
        never_turn(mechanism, &spins.standing)?;
    }
    Ok(spins)
}
