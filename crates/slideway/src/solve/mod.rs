//! The whole pipeline: all solutions of the kinetic problem of a mechanism in its state.
//!
//! ```
//! use slideway::model::{Model, Settings};
//! use slideway::report::Status;
//!
//! let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
//! let model = Model::parse(text)?;
//! let report = slideway::solve::solve(&model)?;
//! assert_eq!(report.status, Status::Several);
//! assert_eq!(report.solutions.len(), 3);
//!
//! // Moving to the left without preload it jams at this friction.
//! let settings = Settings::default().parameter("F_20", "0").parameter("direction", "-1");
//! let report = slideway::solve::solve(&model.with(&settings)?)?;
//! assert_eq!(report.status, Status::None);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```

mod answer;
mod attainability;
mod between_faces;
mod blocks;
mod continuum;
mod distinct;
mod equilibrium;
mod faces;
mod found;
mod friction;
mod from_rest;
mod locking;
mod margins;
mod mode_problem;
mod no_sliding;
mod parts;
mod resting;
mod sharing;
mod stages;
mod standing;
mod state;
mod tolerant;
mod trail;
mod uncertainty;
mod upright;
mod words;

pub(crate) use answer::joint_modes;
pub(crate) use attainability::{Closed, attainability_with_hinges};
pub(crate) use between_faces::states_between_faces;
pub use blocks::exact_block_problem;
pub(crate) use blocks::{BlockState, LastSolution, block_states, check_hinges, never_turning};
pub(crate) use blocks::{
    block_instance, factors_with_one_solution, locking_factor, turning_hinges, unknowns_of,
};
pub(crate) use friction::friction;
pub use locking::{Locking, locking};
pub(crate) use margins::{AT_ONCE, common_coefficient, last_change};
pub(crate) use mode_problem::{ProblemData, Sliding, sides, sliding_signs};
pub use mode_problem::{mode_problem, velocity_signs};
pub(crate) use parts::Parts;
pub(crate) use sharing::load_sharing;
pub(crate) use stages::Stages;
pub use stages::exact_mode_problem;
pub(crate) use standing::{check_none_stands, check_standing};
pub(crate) use state::{pattern, signs, states};
pub(crate) use tolerant::StateWithinTolerances;
pub(crate) use trail::Trail;
pub(crate) use uncertainty::{certain_counts, counted};
pub(crate) use upright::{FALLING, GROWING, Happens, Upright, distinct, guided, happens, upright};
pub(crate) use words::joint_mode;
pub use words::mode_in_words;

use crate::configuration::Configuration;
use crate::enclosure::{
    EnclosedModeProblem, NotEnclosed, UncertainParameters, enclosed_while, enclosure_within,
};
use crate::fault::Faults;
use crate::interval::Interval;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::model::{Model, ParameterRange};
use crate::modes::{SearchOptions, SearchResult, search};
use crate::one_face;
use crate::progress::{Callback, Progress};
use crate::report::{AT_THE_MIDDLE, SolveReport, Status, finite};
use answer::Answer;
use std::ops::ControlFlow;

/// What a solution may cost, and how much of it is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct SolveOptions {
    /// Limits of the search.
    pub search: SearchOptions,
    /// The most solutions, gap states and continua that are listed, each.
    pub most: usize,
    /// Whether margins of friction are computed, and what the loads do from rest once the motion has stopped.
    pub margins: bool,
}

impl Default for SolveOptions {
    /// The defaults of the search, 1000 of each kind, margins.
    fn default() -> Self {
        Self { search: SearchOptions::default(), most: 1000, margins: true }
    }
}

impl SolveOptions {
    /// With these limits of the search.
    #[must_use]
    pub fn search(mut self, search: SearchOptions) -> Self {
        self.search = search;
        self
    }

    /// With so many solutions, gap states and continua in the lists, each.
    #[must_use]
    pub fn most(mut self, most: usize) -> Self {
        self.most = most;
        self
    }

    /// Whether margins of friction are computed, and what the loads do from rest once the motion has stopped.
    #[must_use]
    pub fn margins(mut self, margins: bool) -> Self {
        self.margins = margins;
        self
    }
}

/// All solutions of the kinetic problem of a model in its state, with their contact modes.
///
/// The list is proven complete for the exact mechanism that the model describes, unless
/// [`SolveReport::complete`] says otherwise: the search holds for rigorous bounds of the influence
/// coefficients ([`crate::enclosure`]).
///
/// # Errors
/// Whatever makes no sense in the model or its state. That there is no solution is no error, but
/// [`crate::report::Status::None`].
pub fn solve(model: &Model) -> Result<SolveReport, Faults> {
    solve_with(model, &SolveOptions::default(), &mut |_| ControlFlow::Continue(()))
}

/// [`solve`] with options, and a callback that is called at every node of the search and ends it when it
/// breaks.
///
/// # Errors
/// As [`solve`].
pub fn solve_with(
    model: &Model,
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<SolveReport, Faults> {
    let mechanism = Mechanism::new(model)?;
    mechanism.check_size()?;
    let configuration = Configuration::with_progress(&mechanism, progress)?;
    let mut proceed = || progress(&Progress::of("equations", 0, 1)).is_continue();
    let (stages, equations) = Stages::with_standing_while(mechanism, configuration, &mut proceed)?;
    let mut report = answered(model, (&stages, &equations), Some(&model.ranges()?), options, progress)?;
    report.one_face_hints =
        one_face::of_solutions(model, (&stages.mechanism, &stages.configuration), &report);
    Ok(report)
}

/// [`solve_with`] in stages of the model that are there already, without margins, uncertainty and hints: one value among many, of
/// which lists of what is at rest are not proven.
///
/// # Errors
/// As [`solve`].
pub(crate) fn solve_in(
    model: &Model,
    stages: &Stages,
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<SolveReport, Faults> {
    let equations = KineticEquations::new(&stages.mechanism, &stages.configuration)?;
    answered(model, (stages, &equations), None, &options.margins(false), progress)
}

/// The answer for a model in its state, over the ranges of parameters that are known only within bounds; none are given of one value
/// among many.
fn answered(
    model: &Model,
    (stages, equations): (&Stages, &KineticEquations),
    given: Option<&[ParameterRange]>,
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<SolveReport, Faults> {
    let ranges = given.unwrap_or_default();
    let at_rest = resting::may_lift_off(&stages.mechanism, &stages.standing);
    let mut report = if stages.mechanism.rough_hinges().next().is_some() {
        blocks::solve(model, (&middle(ranges), ranges), (stages, equations), options, progress)?
    } else if at_rest {
        let at_middle = given.map(middle);
        resting::of_contacts((model, at_middle.as_ref()), (stages, equations), &options.search, progress)?
    } else if stages.standing.is_empty() {
        sliding(model, ranges, (stages, equations), options, progress)?
    } else {
        standing::of_contacts(stages, equations)?
    };
    if report.uncertainty.is_none() {
        report.open.extend(taken_at_the_middle(ranges));
    }
    report.rates_not_given = rates_not_given(model);
    if options.margins && !at_rest {
        from_rest::add(&mut report, model, progress);
    }
    report.suit_units();
    finite(report)
}

/// The answer where all contacts with friction slide, and no hinge has friction.
fn sliding(
    model: &Model,
    ranges: &[ParameterRange],
    (stages, equations): (&Stages, &KineticEquations),
    options: &SolveOptions,
    progress: &mut Callback<'_>,
) -> Result<SolveReport, Faults> {
    let enclosed = enclosed_while(progress, |work| {
        enclosure_within(model, &middle(ranges), (&stages.mechanism, &stages.configuration), work)
    });
    let (result, jumps) = searched(&enclosed, stages.data(), &options.search, progress)?;
    let outputs = enclosed.as_ref().ok().map(|enclosed| &enclosed.outputs);
    let answer = Answer { jumps, ..Answer::of(stages, equations, outputs)? };
    let rounded = enclosed.as_ref().err();
    let mut report = answer.report(&found::SearchFound { result: &result, rounded, most: options.most })?;
    sharing::add(&mut report, stages, options.margins)?;
    if options.margins {
        margins::add(&mut report, stages.data(), enclosed.as_ref().ok(), &|signs| answer.joint_modes(signs));
        if report.status == Status::None {
            report.jam_impulses = resting::jam_impulses(stages, equations);
        }
    }
    report.uncertainty = answer.uncertainty(model, ranges, options, progress);
    Ok(report)
}

/// The search for bounds of the exact numbers, else for rounded ones; and for each contact whether the
/// right-hand side jumps with its side.
///
/// # Errors
/// Numbers beyond the range of floating point.
fn searched(
    enclosed: &Result<EnclosedModeProblem, NotEnclosed>,
    data: ProblemData<'_>,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
) -> Result<(SearchResult, Vec<bool>), Faults> {
    if let Ok(enclosed) = enclosed {
        let jumps = enclosed.problem.centre().jumps_of_contacts();
        return Ok((search(&enclosed.problem, options, progress), jumps));
    }
    let problem = data.problem()?;
    Ok((search(&problem, options, progress), problem.jumps_of_contacts()))
}

/// The coordinates whose rates the model does not give.
fn rates_not_given(model: &Model) -> Vec<String> {
    let not_given = model.coordinates.iter().filter(|coordinate| coordinate.rate.is_none());
    not_given.map(|coordinate| coordinate.name.to_string()).collect()
}

/// That ranges are not followed, if there are some.
fn taken_at_the_middle(ranges: &[ParameterRange]) -> Option<String> {
    (!ranges.is_empty()).then(|| AT_THE_MIDDLE.to_owned())
}

/// The middle of each range, as the only value.
fn middle(ranges: &[ParameterRange]) -> UncertainParameters {
    let with = |all: UncertainParameters, range: &ParameterRange| {
        all.with(&range.name, Interval::point(range.middle))
    };
    ranges.iter().fold(UncertainParameters::default(), with)
}
