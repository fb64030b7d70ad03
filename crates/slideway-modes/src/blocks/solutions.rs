//! Solutions in the terms of the problem.

use std::cmp::Ordering;

use super::problem::BlockProblem;
use super::result::BlockSolution;
use super::sector::length;
use super::zero::Zero;
use crate::interval::Interval;
use crate::problem::ContactState;
use crate::solutions::GapShare;

/// A zero as a solution.
pub(super) fn solution(problem: &BlockProblem, zero: &Zero) -> BlockSolution {
    let contacts = problem.contacts();
    let in_gap = |contact: usize| zero.states[contact] == Some(ContactState::Gap);
    let state = |contact: usize| {
        let computed =
            if zero.point[contact] >= 0.0 { ContactState::Positive } else { ContactState::Negative };
        zero.states[contact].unwrap_or(computed)
    };
    let force = |contact: usize| if in_gap(contact) { 0.0 } else { zero.point[contact] };
    let share = |contact| GapShare { contact, lambda: zero.point[contact].clamp(0.0, 1.0) };
    let forces: Vec<f64> = (0..contacts).map(force).collect();
    let reaction = |hinge: usize| problem.rows_of_hinge(hinge).map(|row| zero.point[row]);
    let reactions: Vec<[f64; 2]> = (0..problem.hinges()).map(reaction).collect();
    let may_vanish = |row: usize| zero.enclosure[row].contains(0.0);
    let distance = |(value, centre): (&Interval, &f64)| (*value - Interval::point(*centre)).magnitude();
    BlockSolution {
        states: (0..contacts).map(state).collect(),
        magnitudes: forces
            .iter()
            .map(|force| force.abs())
            .chain(reactions.iter().map(|&at| length(at)))
            .collect(),
        forces,
        gaps: (0..contacts).filter(|&contact| in_gap(contact)).map(share).collect(),
        on_boundary: (0..contacts).filter(|&contact| !in_gap(contact) && may_vanish(contact)).collect(),
        unloaded: (0..problem.hinges())
            .filter(|&hinge| problem.rows_of_hinge(hinge).into_iter().all(may_vanish))
            .collect(),
        reactions,
        orientation: zero.determinant,
        radius: zero.enclosure.iter().zip(&zero.point).map(distance).fold(0.0, f64::max),
        enclosure: zero.enclosure.clone(),
    }
}

/// The order of a list: by states, then by forces and reactions.
pub(super) fn order(one: &BlockSolution, other: &BlockSolution) -> Ordering {
    let values = |solution: &BlockSolution| -> Vec<f64> {
        solution.forces.iter().chain(solution.reactions.as_flattened()).copied().collect()
    };
    let compare = |(one, other): (f64, f64)| one.total_cmp(&other);
    let by_values = || values(one).into_iter().zip(values(other)).map(compare).find(|order| order.is_ne());
    one.states.cmp(&other.states).then_with(|| by_values().unwrap_or(Ordering::Equal))
}
