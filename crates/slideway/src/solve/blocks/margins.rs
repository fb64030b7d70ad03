//! How far friction may grow before a solution with friction in hinges ends.

use super::super::margins::mode_margin;
use super::super::stages::Stages;
use super::branches::GrowingFriction;
use super::spin::{Spins, spins};
use crate::enclosure::EnclosedBlockProblem;
use crate::fault::Faults;
use crate::interval::Interval;
use crate::mechanism::Mechanism;
use crate::modes::SearchOptions;
use crate::modes::blocks::{self, BlockProblem, BlockSolution, UniqueForEveryLoad, unique_for_every_load};
use crate::modes::branches::{BranchOptions, Instance, NoInstance, branches, end_of, keeps_bounds};
use crate::modes::existence::{EndCause, ModeEnd};
use crate::problem::{TurningHinge, rougher};
use crate::progress::Work;
use crate::report::{ModeMargin, Proof};

/// Friction that is greater than this many times that of the model counts as infinite.
const INFINITY: f64 = 1e6;
/// The logarithm of the factor is followed in parts as long as this.
const PART: f64 = 2.0;
/// How far beyond an end it is asked whether any solution is left, as a logarithm.
const BEYOND: f64 = 1e-6;
/// Steps of this length aside from where all solutions are sought, such as exactly at an end.
const ASIDE: [f64; 3] = [0.0, 1.0, 30.0];
/// The most nodes of the search there.
const NODES: u64 = 2_000;
/// The most ends of branches that are passed on the way to locking.
const BRANCHES: usize = 64;
/// Even steps of friction that falls.
const FALLING: usize = 40;
/// How often the range of the logarithm of the factor is halved in search of the one up to which there is one solution.
const HALVINGS: usize = 18;

/// A number of solutions.
enum Number {
    /// One.
    One(Box<BlockSolution>),
    /// None, or several.
    Another,
}

/// The branches of a mechanism as all its friction grows.
pub(super) struct Growth<'a> {
    friction: GrowingFriction,
    mechanism: &'a Mechanism,
    /// Once it is over there are no more problems: nothing is found then.
    work: Work<'a>,
}

impl<'a> Growth<'a> {
    /// # Errors
    /// Nothing says how redundant guides share their load.
    pub(super) fn new(stages: &'a Stages, hinges: &[TurningHinge], work: Work<'a>) -> Result<Self, Faults> {
        Ok(Self { friction: GrowingFriction::new(stages, hinges)?, mechanism: &stages.mechanism, work })
    }

    /// The problem with this logarithm of the factor.
    fn at(&self, logarithm: f64) -> Result<Instance, NoInstance> {
        self.at_factor(logarithm.exp())
    }

    fn at_factor(&self, factor: f64) -> Result<Instance, NoInstance> {
        if self.work.is_over() {
            return Err(NoInstance::Other);
        }
        self.friction.at(factor).map_err(|_| NoInstance::Other)
    }

    /// The factor by which all friction may grow before a solution ends, and what ends it; none if that is not found.
    pub(super) fn margin(&self, solution: &BlockSolution) -> Option<ModeMargin> {
        let end = end_of(&|at| self.at(at), (solution, 0.0), INFINITY.ln(), PART)?.end;
        if end.cause == EndCause::NotFollowed {
            return None;
        }
        let nothing_is_left = end.cause == EndCause::Singular && self.nothing_is_left(&end);
        let at = match end.cause {
            EndCause::Range | EndCause::NoProblem => f64::INFINITY,
            _ => end.at.exp(),
        };
        Some(mode_margin(self.mechanism, (&solution.states, &ModeEnd { at, ..end }), nothing_is_left))
    }

    /// Whether it is proven that there is no solution just beyond an end.
    fn nothing_is_left(&self, end: &ModeEnd) -> bool {
        self.solutions(end.at + BEYOND).is_some_and(|solutions| solutions.is_empty())
    }

    /// All solutions with this logarithm of the factor; none if their list is not proven complete.
    fn solutions(&self, logarithm: f64) -> Option<Vec<BlockSolution>> {
        let options = SearchOptions { nodes: NODES, ..SearchOptions::default() };
        let problem = &self.at(logarithm).ok()?.problem;
        let unique = unique_for_every_load(problem);
        let result = blocks::search_all_or_nothing(problem, unique, &options, &mut |_| self.work.flow());
        (result.complete == Proof::Proven).then_some(result.solutions)
    }

    /// How many solutions there are with this logarithm of the factor, or a little aside where that is not decided; none
    /// if it is not decided there either.
    fn number(&self, logarithm: f64, aside: f64) -> Option<Number> {
        ASIDE.iter().find_map(|steps| self.number_at(logarithm + aside * steps))
    }

    fn number_at(&self, logarithm: f64) -> Option<Number> {
        let mut solutions = self.solutions(logarithm)?;
        let instance = self.at(logarithm).ok()?;
        let open = &self.mechanism.excess.open;
        solutions.retain(|solution| open.is_solution(&solution.states) && keeps_bounds(&instance, solution));
        let last = solutions.pop().filter(|_| solutions.is_empty());
        Some(last.map_or(Number::Another, |last| Number::One(Box::new(last))))
    }

    /// Whether every load has exactly one solution up to this logarithm of the factor: what proves it grows with
    /// friction, but for press fits, whose open faces are no friction.
    fn is_unique(&self, logarithm: f64) -> bool {
        self.mechanism.press_fits().is_empty()
            && self.at(logarithm).is_ok_and(|instance| {
                instance.bounds.is_empty() && self.unique_as_friction_grows(&instance.problem)
            })
    }

    /// Why every load has exactly one solution, by what grows with friction: the scaled norm of guides that share a load
    /// does not.
    fn unique_as_friction_grows(&self, problem: &BlockProblem) -> bool {
        match unique_for_every_load(problem) {
            Some(UniqueForEveryLoad::ScaledNorm) => self.mechanism.excess.is_empty(),
            why => why.is_some(),
        }
    }

    /// A factor of all friction above 1 up to which every load has exactly one solution, rounded down; none if that does
    /// not show.
    fn unique_until(&self) -> Option<f64> {
        let [mut unique, mut open] = [0.0, INFINITY.ln()];
        if !self.is_unique(unique) {
            return None;
        }
        if self.is_unique(open) {
            return Some(INFINITY);
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(unique, open);
            *(if self.is_unique(middle) { &mut unique } else { &mut open }) = middle;
        }
        Some(rounded_down(unique.exp())).filter(|factor| *factor > 1.0)
    }

    /// A factor of all friction above 1 up to which every load is proven to have exactly one solution in the exact
    /// mechanism; none if it is not proven. What proves it grows with friction, so that it holds below, too.
    pub(super) fn unique_at_least(&self, enclosed: &EnclosedBlockProblem) -> Option<f64> {
        let factor = self.unique_until()?;
        let rougher = rougher(&enclosed.coefficients, &enclosed.hinges, Interval::point(factor));
        let rougher = rougher.numbers().problem()?;
        self.unique_as_friction_grows(&rougher).then_some(factor)
    }

    /// The number of solutions at the second of two logarithms of the factor, or in between if it is another one there,
    /// reached from the only one at the first; none if that is not decided.
    fn number_beyond(&self, mut only: Box<BlockSolution>, [from, to]: [f64; 2]) -> Option<Number> {
        let mut at = from;
        for _ in 0..BRANCHES {
            at = end_of(&|at| self.at(at), (&only, at), to, PART)?.end.at + BEYOND;
            if at >= to {
                return self.number(to, -BEYOND);
            }
            match self.number(at, BEYOND)? {
                Number::One(next) => only = next,
                Number::Another => return Some(Number::Another),
            }
        }
        None
    }

    /// How many of these growing factors come before another number of solutions than one; none if that is not
    /// decided.
    fn with_one_solution(&self, factors: &[f64]) -> Option<usize> {
        let at: Vec<f64> = factors.iter().map(|factor| factor.ln()).collect();
        let first = at.iter().rposition(|&at| self.is_unique(at)).unwrap_or(0);
        let mut number = self.number(at[first], -BEYOND)?;
        for next in first + 1..at.len() {
            let Number::One(only) = number else { return Some(next - 1) };
            number = self.number_beyond(only, [at[next - 1], at[next]])?;
        }
        Some(if matches!(number, Number::One(_)) { at.len() } else { at.len() - 1 })
    }

    /// The factor by which friction may grow before there is neither a solution nor a preload-gap state, infinite if
    /// there always is one; where there is none as it is, the factor to which friction has to fall.
    fn locking(&self) -> Option<f64> {
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
                return Some(end.map_or_else(|| self.falling(), f64::exp));
            }
            end = Some(last);
            at = last + BEYOND;
        }
        None
    }

    /// The greatest factor up to that of the model with a solution, as far as even steps show it.
    fn falling(&self) -> f64 {
        let options = BranchOptions {
            range: [0.0, 1.0],
            values: FALLING,
            further: Vec::new(),
            greatest_normal_force: None,
            search: SearchOptions { nodes: NODES, ..SearchOptions::default() },
        };
        let found = branches(&|factor| self.at_factor(factor), &options, self.work).branches;
        found.iter().map(|branch| branch.to.end.at).fold(0.0, f64::max)
    }
}

/// A number of at least 1, rounded down to four significant digits, or to a whole number.
fn rounded_down(number: f64) -> f64 {
    let scale = [1e3, 1e2, 1e1].into_iter().find(|scale| number * scale < 1e4).unwrap_or(1.0);
    (number * scale).floor() / scale
}

/// How many of these growing factors of all friction come before another number of solutions than one: the only solution is
/// followed, and all are sought at the factors. None if that is not decided, or a hinge never turns.
///
/// # Errors
/// Hinges with friction that do not turn now; nothing says how redundant guides share their load.
pub(crate) fn factors_with_one_solution(
    stages: &Stages,
    factors: &[f64],
    work: Work<'_>,
) -> Result<Option<usize>, Faults> {
    let Spins { turning, standing } = spins(&stages.mechanism, &stages.configuration, &stages.influence)?;
    if !standing.is_empty() {
        return Ok(None);
    }
    Ok(Growth::new(stages, &turning, work)?.with_one_solution(factors))
}

/// The factor by which all friction may grow before there is neither a solution nor a preload-gap state, infinite if
/// there always is one; where there is none as it is, the factor to which it has to fall. None if that was not found.
///
/// # Errors
/// Nothing says how redundant guides share their load.
pub(crate) fn locking_factor(
    stages: &Stages,
    hinges: &[TurningHinge],
    work: Work<'_>,
) -> Result<Option<f64>, Faults> {
    Ok(Growth::new(stages, hinges, work)?.locking())
}
