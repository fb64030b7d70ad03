//! From the solutions of the block mode problem back to the mechanism.

use super::super::answer::{Answer, Tipped, status};
use super::super::attainability::{attainability_with_hinges, not_computed};
use super::super::state::{State, pattern, signs};
use super::margins::Growth;
use super::states::hinge_states;
use crate::enclosure::NotEnclosed;
use crate::interval::{Interval, Real};
use crate::mechanism::Mechanism;
use crate::modes::blocks::{BlockProblem, BlockResult, BlockSolution, OpenRegion, UniqueForEveryLoad};
use crate::modes::{Certificate, ContactState};
use crate::problem::TurningHinge;
use crate::report::{Proof, SolveReport};
use nalgebra::{DMatrix, DVector};

/// A search, and whether it was one for bounds of the exact numbers.
pub(super) struct BlocksFound<'f> {
    pub(super) result: &'f BlockResult,
    /// Why the proof refers to the rounded numbers only.
    pub(super) rounded: Option<&'f NotEnclosed>,
    /// The most solutions that are listed.
    pub(super) most: usize,
}

impl BlocksFound<'_> {
    fn strategy(&self, mechanism: &Mechanism) -> String {
        let why = match self.result.unique_for_every_load {
            Some(UniqueForEveryLoad::BlockNorms) => "; a bound on norms proves one solution for every load",
            Some(UniqueForEveryLoad::ScaledNorm) => {
                "; a bound on scaled singular values proves one solution for every load"
            }
            None => "",
        };
        let place = if mechanism.has_ends() { "on round rods and at hinges" } else { "at hinges" };
        format!("the directions of the forces {place} with friction were divided into sectors{why}")
    }

    /// What keeps the list of solutions from being proven complete.
    fn open(&self) -> Vec<String> {
        let mut open: Vec<String> = self.result.open.iter().map(region_in_words).collect();
        open.extend(self.result.stopped.map(|reason| reason.to_string()));
        if open.is_empty() && self.result.complete != Proof::Proven {
            open.push("not every exclusion or outcome is proven".to_owned());
        }
        open.extend(
            self.rounded.map(|reason| format!("what is proven holds for rounded numbers only: {reason}")),
        );
        open
    }
}

/// "fold, in the modes + ? -": a region that is not decided.
fn region_in_words(region: &OpenRegion) -> String {
    let sign = |state: &Option<ContactState>| state.map_or("?".to_owned(), |state| pattern(&[state]));
    let signs: Vec<String> = region.states.iter().map(sign).collect();
    let place = if signs.is_empty() { String::new() } else { format!(" (signs {})", signs.join(" ")) };
    format!("a region is not decided: {}{place}", region.label.as_str())
}

/// An answer with friction in hinges.
pub(super) struct BlockAnswer<'a> {
    pub(super) answer: Answer<'a>,
    pub(super) problem: &'a BlockProblem,
    /// The problem without friction; none unless guides share a load or contacts may lift off, whose columns are not of
    /// friction.
    pub(super) frictionless: Option<&'a BlockProblem>,
    pub(super) hinges: &'a [TurningHinge],
}

impl BlockAnswer<'_> {
    /// The report on all solutions, with their margins of friction if what grows is given.
    pub(super) fn report(&self, found: &BlocksFound<'_>, growth: Option<&Growth<'_>>) -> SolveReport {
        let mut tipping = Tipped::default();
        let (mut solutions, mut gaps) = (Vec::new(), Vec::new());
        for solution in found.result.solutions.iter().take(found.most) {
            // Both signs of a part of a round end are one: it has no friction of its own.
            let is_whole = |contact: &&usize| !self.answer.mechanism.is_part_of_end(**contact);
            let on_boundary: Vec<usize> = solution.on_boundary.iter().filter(is_whole).copied().collect();
            let slopes = self.problem.slopes(&solution.states, &solution.reactions);
            let oriented = self.oriented(&slopes, solution);
            let signs: Vec<i8> = (0..solution.states.len())
                .map(|k| if solution.on_boundary.contains(&k) { 0 } else { signs(&solution.states)[k] })
                .collect();
            let mut shares = vec![None; solution.states.len()];
            solution.gaps.iter().for_each(|share| shares[share.contact] = Some(share.lambda));
            let state = State {
                pattern: &solution.states,
                patterns: vec![pattern(&solution.states)],
                normal_force: &DVector::from_column_slice(&solution.forces),
                shares,
                signs,
                on_boundary: !on_boundary.is_empty(),
                determinant: oriented * solution.states.iter().map(|state| state.sign()).product::<f64>(),
                certificate: &certificate(solution, &on_boundary),
                hinges: &hinge_states(self.answer.mechanism, self.hinges, &solution.reactions),
                held: &[],
            };
            let Some(mut kept) = self.answer.kept(&state, &mut tipping) else { continue };
            kept.margin = growth.and_then(|growth| growth.margin(solution));
            if !self.answer.mechanism.excess.open.is_solution(&solution.states) {
                gaps.push(kept);
                continue;
            }
            if self.frictionless.is_some() {
                kept.oriented_determinant = oriented;
            }
            kept.attainability = if on_boundary.is_empty() && solution.unloaded.is_empty() {
                let state = (self.answer.configuration, self.answer.equations);
                let forces = (solution.states.as_slice(), solution.reactions.as_slice());
                attainability_with_hinges(self.answer.data(), state, self.hinges, forces)
            } else {
                not_computed("nothing presses a contact, or a hinge with friction carries nothing")
            };
            solutions.push(kept);
        }
        let mut open = found.open();
        open.extend(tipping.unproven());
        let undecided = !found.result.open.is_empty() || found.result.stopped.is_some();
        let found_solutions = found.result.solutions.len();
        let left_out = found_solutions - found_solutions.min(found.most);
        SolveReport {
            status: status(undecided, solutions.len(), gaps.len(), 0),
            partial: found.result.stopped.is_some(),
            count: (solutions.len() + left_out).to_string(),
            gap_state_count: gaps.len().to_string(),
            strategy: found.strategy(self.answer.mechanism),
            nodes: found.result.nodes,
            solutions,
            preload_gap_states: gaps,
            rejected: tipping.rejected,
            ..self.answer.report_without_solutions(open)
        }
    }

    /// The determinant of the slopes; of guides that share a load, and contacts that may lift off, relative to that of the same contacts without friction.
    fn oriented(&self, slopes: &DMatrix<f64>, solution: &BlockSolution) -> f64 {
        let Some(frictionless) = self.frictionless else { return slopes.determinant() };
        let without = frictionless.slopes(&solution.states, &solution.reactions).determinant();
        if without == 0.0 { 0.0 } else { slopes.determinant() / without }
    }
}

/// Proven bounds of `|N_k|`, or of the shares of contacts in their gaps, then of `|R_j|`.
fn certificate(solution: &BlockSolution, on_boundary: &[usize]) -> Certificate {
    let bounds = solution.states.iter().zip(&solution.enclosure);
    let unknowns = bounds.map(|(state, bounds)| match state {
        ContactState::Gap => *bounds,
        ContactState::Positive | ContactState::Negative => bounds.abs(),
    });
    let (forces, _) = solution.enclosure[solution.states.len()..].as_chunks();
    let unknowns: Vec<Interval> = unknowns.chain(forces.iter().map(|[x, y]| x.hypot(*y))).collect();
    if on_boundary.is_empty() {
        Certificate::Proven { unknowns }
    } else {
        Certificate::Boundary { unknowns, zero: on_boundary.to_vec(), full_share: Vec::new() }
    }
}
