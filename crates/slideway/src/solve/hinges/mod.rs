//! Solutions with friction in hinges: the block mode problem, and what its solutions are in the mechanism (theory of
//! hinges).

mod branches;
mod found;
mod margins;
mod spin;
mod states;
mod uncertainty;

pub(crate) use spin::HingedData;
pub(crate) use states::{HingedState, LastSolution, hinged_states};

pub(crate) use branches::{block_instance, turning_hinges, unknowns_of};

use super::SolveOptions;
use super::answer::Answer;
use super::mode_problem::{none_stands, overflow, preload_columns, without_rounding};
use super::stages::Stages;
use super::{sharing, standing};
use crate::configuration::Configuration;
use crate::enclosure::{
    BlockCoefficients, BlockNumbers, TurningHinge, UncertainParameters, enclosed_block_problem,
    enclosed_while,
};
use crate::fault::{Faults, MOST_CONTACTS};
use crate::ids::JointId;
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::{Contact, Mechanism};
use crate::model::{Model, ParameterRange};
use crate::modes::BySide;
use crate::modes::blocks::{self, BlockProblem};
use crate::progress::{Callback, as_far_as_wanted};
use crate::report::{MarginsMissing, SolveReport};
use crate::sharing::{NO_STRESS, shared_load};
use branches::GrowingFriction;
pub(crate) use found::directions;
use found::{BlocksFound, HingedAnswer};
use margins::Growth;
pub(crate) use margins::{factors_with_one_solution, locking_factor};
use nalgebra::{DMatrix, DVector};
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
        return standing::of_hinge(stages, equations, *hinge);
    }
    none_stands(mechanism, &stages.standing)?;
    let problem = block_problem(stages.hinged(), &turning)?;
    let enclosed = enclosed_while(progress, |work| {
        enclosed_block_problem(model, uncertain, (mechanism, configuration), &turning, work)
    });
    let enclosed_outputs = enclosed.as_ref().ok().map(|enclosed| &enclosed.outputs);
    let answer = Answer {
        enclosed: enclosed_outputs,
        shared: stages.shared_load()?,
        elasticity: stages.elasticity()?,
        ..Answer::determinate(stages, equations)
    };
    let searched = enclosed.as_ref().map_or(&problem, |enclosed| &enclosed.problem);
    let result = blocks::search(searched, &options.search, progress);
    let found = BlocksFound { result: &result, rounded: enclosed.as_ref().err(), most: options.most };
    let without_friction = || Ok::<_, Faults>(GrowingFriction::new(stages, &turning)?.at(0.0)?.problem);
    let frictionless = answer.shared.is_some().then(without_friction).transpose()?;
    let answer =
        HingedAnswer { answer, problem: &problem, frictionless: frictionless.as_ref(), hinges: &turning };
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
        margins_missing: options.margins.then_some(MarginsMissing::FrictionInHinges),
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
    block_problem(stages.hinged(), &turning)
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

fn block_problem(data: HingedData<'_>, hinges: &[TurningHinge]) -> Result<BlockProblem, Faults> {
    exact_problem(block_coefficients(data, hinges, &[])?.numbers())
}

fn exact_problem(BlockNumbers { response, jumps, load }: BlockNumbers<f64>) -> Result<BlockProblem, Faults> {
    BlockProblem::new(response, jumps, load).map_err(|_| overflow())
}

/// The coefficients of the block mode problem in floating point, with these unknowns below its rows.
///
/// # Errors
/// Nothing says how redundant guides share their load.
pub(super) fn block_coefficients(
    data: HingedData<'_>,
    hinges: &[TurningHinge],
    below: &[usize],
) -> Result<BlockCoefficients<f64>, Faults> {
    let HingedData { mechanism, influence, velocity_signs, .. } = data;
    let joints: Vec<JointId> = hinges.iter().map(|hinge| hinge.joint).collect();
    let own = influence.block_rows(&joints);
    let rows = [&own, below].concat();
    let eta = without_rounding(mechanism, answers(influence, &own));
    let [positive, negative] = answers(influence, below);
    let eta =
        BySide { positive: stacked(&eta.positive, &positive), negative: stacked(&eta.negative, &negative) };
    let [mu, preload] = friction_of_contacts(&mechanism.contacts, &|_| true);
    Ok(BlockCoefficients {
        eta_preload: preload_columns(mechanism, &eta),
        eta,
        mu,
        preload,
        velocity_signs: velocity_signs.clone(),
        couples: DMatrix::from_fn(rows.len(), hinges.len(), |row, hinge| {
            influence.couples[hinges[hinge].circle][rows[row]]
        }),
        leverage: DVector::from_fn(hinges.len(), |hinge, _| {
            let TurningHinge { circle, sense, .. } = hinges[hinge];
            -mechanism.friction_circles[circle].radius * sense
        }),
        frictionless: DVector::from_fn(rows.len(), |row, _| influence.frictionless[rows[row]]),
        shared: shared_load(mechanism, stresses_in(influence, &rows))?,
    })
}

/// The contributions of a unit friction force of each contact to these unknowns, at either face.
fn answers(influence: &Influence, rows: &[usize]) -> [DMatrix<f64>; 2] {
    let columns = &influence.columns;
    [0, 1].map(|side| DMatrix::from_fn(rows.len(), columns.len(), |row, k| columns[k][side][rows[row]]))
}

/// The self-stresses in these unknowns.
fn stresses_in(influence: &Influence, rows: &[usize]) -> DMatrix<f64> {
    let stresses = &influence.self_stresses;
    DMatrix::from_fn(rows.len(), stresses.len(), |row, stress| {
        let force = stresses[stress][rows[row]];
        if force.abs() <= NO_STRESS { 0.0 } else { force }
    })
}

/// Two matrices of as many columns, one below the other.
fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let mut both = above.clone().resize_vertically(above.nrows() + below.nrows(), 0.0);
    both.rows_mut(above.nrows(), below.nrows()).copy_from(below);
    both
}

/// The friction coefficients and the preloads of contacts, zero where they have no part.
pub(crate) fn friction_of_contacts(
    contacts: &[Contact],
    has_part: &dyn Fn(usize) -> bool,
) -> [BySide<DVector<f64>>; 2] {
    let of = |value: fn(&Contact) -> [f64; 2]| {
        let side = |side: usize| {
            DVector::from_fn(contacts.len(), |k, _| if has_part(k) { value(&contacts[k])[side] } else { 0.0 })
        };
        BySide { positive: side(0), negative: side(1) }
    };
    [of(|contact| contact.mu), of(|contact| contact.preload)]
}
