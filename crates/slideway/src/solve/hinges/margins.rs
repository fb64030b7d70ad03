//! How far friction may grow before a solution with friction in hinges ends.

use super::super::stages::Stages;
use super::branches::GrowingFriction;
use crate::enclosure::TurningHinge;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::modes::SearchOptions;
use crate::modes::blocks::{self, BlockSolution};
use crate::modes::branches::{BranchOptions, Instance, NoInstance, branches, end_of};
use crate::modes::existence::{EndCause, ModeEnd};
use crate::progress::Work;
use crate::report::{ModeEndCause, ModeMargin, Proof};
use std::ops::ControlFlow;

/// Friction that is greater than this many times that of the model counts as infinite.
const INFINITY: f64 = 1e6;
/// The logarithm of the factor is followed in parts as long as this.
const PART: f64 = 0.5;
/// How far beyond an end it is asked whether any solution is left, as a logarithm.
const BEYOND: f64 = 1e-6;
/// The most nodes of the search there.
const NODES: u64 = 2_000;
/// The most ends of branches that are passed on the way to locking.
const BRANCHES: usize = 64;
/// Even steps of friction that falls.
const FALLING: usize = 40;

/// The branches of a mechanism as all its friction grows.
pub(super) struct Growth<'a> {
    friction: GrowingFriction<'a>,
    mechanism: &'a Mechanism,
}

impl<'a> Growth<'a> {
    /// # Errors
    /// Guides that share a load.
    pub(super) fn new(stages: &'a Stages, hinges: &'a [TurningHinge]) -> Result<Self, Faults> {
        Ok(Self { friction: GrowingFriction::new(stages, hinges)?, mechanism: &stages.mechanism })
    }

    /// The problem with this logarithm of the factor.
    fn at(&self, logarithm: f64) -> Result<Instance, NoInstance> {
        self.friction.at(logarithm.exp()).map_err(|_| NoInstance::Other)
    }

    /// The factor by which all friction may grow before a solution ends, and what ends it; none if that is not found.
    pub(super) fn margin(&self, solution: &BlockSolution) -> Option<ModeMargin> {
        let end = end_of(&|at| self.at(at), (solution, 0.0), INFINITY.ln(), PART)?.end;
        if end.cause == EndCause::NotFollowed {
            return None;
        }
        let ends_with = match end.cause {
            EndCause::Range | EndCause::NoProblem => ModeEndCause::Nothing,
            ref cause => ModeEndCause::new(cause, *cause == EndCause::Singular && self.nothing_is_left(&end)),
        };
        let names = |contacts: &[usize]| -> Vec<String> {
            contacts.iter().map(|&k| self.mechanism.contacts[k].name.to_string()).collect()
        };
        let contacts = match &end.cause {
            EndCause::SideChange(contacts) | EndCause::GapCloses(contacts) => names(contacts),
            _ => Vec::new(),
        };
        let factor = (ends_with != ModeEndCause::Nothing).then(|| end.at.exp());
        Some(ModeMargin { factor, ends_with, contacts })
    }

    /// Whether it is proven that there is no solution just beyond an end.
    fn nothing_is_left(&self, end: &ModeEnd) -> bool {
        self.solutions(end.at + BEYOND).is_some_and(|solutions| solutions.is_empty())
    }

    /// All solutions with this logarithm of the factor; none if their list is not proven complete.
    fn solutions(&self, logarithm: f64) -> Option<Vec<BlockSolution>> {
        let options = SearchOptions { nodes: NODES, ..SearchOptions::default() };
        let instance = self.at(logarithm).ok()?;
        let result = blocks::search(&instance.problem, &options, &mut |_| ControlFlow::Continue(()));
        (result.complete == Proof::Proven).then_some(result.solutions)
    }

    /// The factor by which friction may grow before there is neither a solution nor a preload-gap state, infinite if
    /// there always is one; where there is none as it is, the factor to which friction has to fall.
    fn locking(&self, work: Work<'_>) -> Option<f64> {
        let (mut at, mut end) = (0.0, None);
        for _ in 0..BRANCHES {
            let solutions = self.solutions(at)?;
            let ends = solutions
                .iter()
                .map(|solution| Some(end_of(&|at| self.at(at), (solution, at), INFINITY.ln(), PART)?.end.at));
            let last = ends.collect::<Option<Vec<f64>>>()?.into_iter().fold(at, f64::max);
            if last >= INFINITY.ln() {
                return Some(f64::INFINITY);
            }
            if last <= at {
                return Some(end.map_or_else(|| self.falling(work), f64::exp));
            }
            end = Some(last);
            at = last + BEYOND;
        }
        None
    }

    /// The greatest factor up to that of the model with a solution, as far as even steps show it.
    fn falling(&self, work: Work<'_>) -> f64 {
        let options = BranchOptions {
            range: [0.0, 1.0],
            values: FALLING,
            further: Vec::new(),
            greatest_normal_force: None,
            search: SearchOptions { nodes: NODES, ..SearchOptions::default() },
        };
        let family = |factor: f64| self.friction.at(factor).map_err(|_| NoInstance::Other);
        let found = branches(&family, &options, work).branches;
        found.iter().map(|branch| branch.to.end.at).fold(0.0, f64::max)
    }
}

/// The factor by which all friction may grow before there is neither a solution nor a preload-gap state, infinite if
/// there always is one; where there is none as it is, the factor to which it has to fall. None if that was not found.
///
/// # Errors
/// Guides that share a load.
pub(crate) fn locking_factor(
    stages: &Stages,
    hinges: &[TurningHinge],
    work: Work<'_>,
) -> Result<Option<f64>, Faults> {
    Ok(Growth::new(stages, hinges)?.locking(work))
}
