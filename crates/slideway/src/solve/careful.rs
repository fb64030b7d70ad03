//! A single state of a sweep in which elimination alone decides too little.

use super::answer::Answer;
use super::found::Found;
use super::mode_problem::{mode_problem, overflow};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::modes::certificate::IntervalModeProblem;
use crate::modes::{SearchOptions, search};
use crate::progress::Callback;
use crate::report::{Report, finite};
use nalgebra::DVector;

/// How well the numbers of a mode problem are known, as a part of each: rounding of the stages before. Well below what
/// makes a jump (1e-12).
const KNOWN_TO: f64 = 2e-13;
/// The most states of each kind that are listed.
const MOST_STATES: usize = 1000;

/// The answer of [`super::solve`] for stages that are at hand, but with bounds of rounding that are assumed, not proven;
/// without margins. The callback is that of the search.
///
/// # Errors
/// A fault if a number is beyond the range of floating point.
pub(crate) fn careful_report(
    mechanism: &Mechanism,
    configuration: &Configuration,
    equations: &KineticEquations,
    (influence, velocity_signs): (&Influence, &DVector<f64>),
    progress: &mut Callback<'_>,
) -> Result<Report, Faults> {
    let problem = mode_problem(mechanism, influence, velocity_signs)?;
    let jumps = problem.jumps_of_contacts();
    let problem = IntervalModeProblem::widened(&problem, KNOWN_TO).map_err(|_| overflow())?;
    let result = search(&problem, &SearchOptions::default(), progress);
    let answer =
        Answer { mechanism, configuration, equations, influence, velocity_signs, jumps, enclosed: None };
    finite(answer.report(&Found { result: &result, rounded: None, most: MOST_STATES })?)
}
