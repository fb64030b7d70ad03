//! All states of one point after another, without the proof for the exact mechanism: for sweeps, maps and tables.

use super::super::mode_problem::ProblemData;
use super::spin::{Spins, spins};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::influence::HingeState;
use crate::kinetics::Accuracy;
use crate::mechanism::Mechanism;
use crate::modes::blocks::{
    BlockProblem, BlockSolution, only_solution, search_all_or_nothing, unique_for_every_load,
};
use crate::modes::certificate::Sign;
use crate::modes::screen::SLACK;
use crate::modes::{ContactState, Proof, SearchOptions, Side};
use crate::problem::TurningHinge;
use crate::progress::Callback;

/// A solution with friction in hinges, inside of its contact mode.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BlockState {
    pub(crate) pattern: Vec<ContactState>,
    /// With their signs (N).
    pub(crate) normal_forces: Vec<f64>,
    /// The hinges that rub.
    pub(crate) hinges: Vec<HingeState>,
    /// Whether the determinant of the mode is negative: `det(I - H D)` times all signs.
    pub(crate) negative_determinant: bool,
}

/// The last solution that was the only one, from which the next one is sought.
#[derive(Debug, Clone, Default)]
pub(crate) struct LastSolution(Vec<f64>);

/// All solutions of a mechanism with friction in hinges; none where a careful answer is needed: near a boundary, with
/// preload gaps, where something is not decided, or if a hinge never turns.
///
/// Where the norms of the blocks show that there is exactly one solution, that is sought from the last one.
///
/// # Errors
/// Hinges with friction that do not turn; numbers beyond the range of floating point.
pub(crate) fn block_states(
    (data, configuration): (ProblemData<'_>, &Configuration),
    accuracy: Accuracy,
    last: &mut LastSolution,
    progress: &mut Callback<'_>,
) -> Result<Option<Vec<BlockState>>, Faults> {
    if !data.mechanism.excess.is_empty() {
        return Ok(None);
    }
    let Spins { turning, standing } = spins(data.mechanism, configuration, data.influence)?;
    if !standing.is_empty() {
        return Ok(None);
    }
    let problem = data.block_problem(&turning)?;
    let slack = SLACK.max(accuracy.part);
    let telling = Telling { mechanism: data.mechanism, problem: &problem, turning: &turning, slack };
    if let Some(only) = only_solution(&problem, Some(&last.0)) {
        let state = telling.only(&only.point, &only.errors);
        last.0 = only.point;
        return Ok(state.map(|state| vec![state]));
    }
    let unique = unique_for_every_load(&problem);
    let found = search_all_or_nothing(&problem, unique, &SearchOptions::default(), progress);
    if found.complete != Proof::Proven {
        return Ok(None);
    }
    Ok(found.solutions.iter().map(|solution| telling.one_of_several(solution)).collect())
}

/// From the numbers of a block problem to states.
struct Telling<'t> {
    mechanism: &'t Mechanism,
    problem: &'t BlockProblem,
    turning: &'t [TurningHinge],
    /// Forces below this part of the terms that they are made of are in doubt.
    slack: f64,
}

impl Telling<'_> {
    /// The only solution; none if a side is in doubt. `det(I - H D)` is positive.
    fn only(&self, point: &[f64], errors: &[f64]) -> Option<BlockState> {
        let contacts = self.problem.contacts();
        let (forces, reactions) = point.split_at(contacts);
        let reactions: Vec<[f64; 2]> = reactions.as_chunks().0.to_vec();
        let state = |k: usize| {
            let certain = forces[k].abs() > errors[k] + self.doubt(k, forces, &reactions);
            let is_known = certain || self.mechanism.is_part_of_end(k);
            is_known.then_some(if forces[k] < 0.0 { ContactState::Negative } else { ContactState::Positive })
        };
        let pattern: Vec<ContactState> = (0..contacts).map(state).collect::<Option<_>>()?;
        Some(self.state(pattern, forces, &reactions, false))
    }

    /// One of the solutions that a search has found; none if something about it is in doubt.
    fn one_of_several(&self, solution: &BlockSolution) -> Option<BlockState> {
        let is_part = |k: usize| self.mechanism.is_part_of_end(k);
        let is_inside = solution.on_boundary.iter().all(|&k| is_part(k));
        let certain = solution.gaps.is_empty() && is_inside && solution.unloaded.is_empty();
        let large = |k: usize| {
            is_part(k) || solution.forces[k].abs() > self.doubt(k, &solution.forces, &solution.reactions)
        };
        let is_negative = match solution.orientation? {
            Sign::Positive => false,
            Sign::Negative => true,
            Sign::Zero => return None,
        };
        let certain = certain && (0..self.problem.contacts()).all(large);
        certain
            .then(|| self.state(solution.states.clone(), &solution.forces, &solution.reactions, is_negative))
    }

    /// What rounding of the mechanism's numbers may leave of a normal force: a part of the terms of which it is the sum.
    fn doubt(&self, row: usize, forces: &[f64], reactions: &[[f64; 2]]) -> f64 {
        let magnitudes = forces.iter().map(|force| force.abs());
        let magnitudes = magnitudes.chain(reactions.iter().map(|[x, y]| x.hypot(*y)));
        let response = Side::BOTH.map(|side| self.problem.response(side).centre());
        let term = |(column, magnitude): (usize, f64)| {
            response[0][(row, column)].abs().max(response[1][(row, column)].abs()) * magnitude
        };
        let load = self.problem.load().centre()[(row, 0)].abs();
        self.slack * (load + magnitudes.enumerate().map(term).sum::<f64>())
    }

    fn state(
        &self,
        pattern: Vec<ContactState>,
        forces: &[f64],
        reactions: &[[f64; 2]],
        oriented_negative: bool,
    ) -> BlockState {
        let negative = pattern.iter().filter(|state| **state == ContactState::Negative).count();
        BlockState {
            normal_forces: forces.to_vec(),
            hinges: hinge_states(self.mechanism, self.turning, reactions),
            negative_determinant: oriented_negative ^ (negative % 2 == 1),
            pattern,
        }
    }
}

/// The forces and friction couples of hinges.
pub(super) fn hinge_states(
    mechanism: &Mechanism,
    hinges: &[TurningHinge],
    forces: &[[f64; 2]],
) -> Vec<HingeState> {
    let one = |(hinge, force): (&TurningHinge, &[f64; 2])| {
        let radius = mechanism.friction_circles[hinge.circle].radius;
        let couple = -hinge.sense * radius * force[0].hypot(force[1]);
        HingeState { circle: hinge.circle, joint: hinge.joint, force: *force, couple }
    };
    hinges.iter().zip(forces).map(one).collect()
}
