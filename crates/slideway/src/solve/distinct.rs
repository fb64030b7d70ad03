//! Solutions that differ in nothing that can be observed are one.

use crate::report;

/// Forces and accelerations that differ by less than this multiple of the greatest are the same.
pub(super) const SAME_STATE: f64 = 1e-11;

/// Merges states of the same forces and accelerations, which differ only in how a preload is shared between
/// faces where that has no effect; those that are among `known` already are left out.
pub(super) fn distinct(states: Vec<report::Solution>, known: &[report::Solution]) -> Vec<report::Solution> {
    let mut distinct: Vec<report::Solution> = Vec::new();
    for state in states {
        if known.iter().any(|other| is_same(&state, other)) {
            continue;
        }
        match distinct.iter_mut().find(|other| is_same(&state, other)) {
            Some(other) => other.patterns.extend(state.patterns),
            None => distinct.push(state),
        }
    }
    distinct
}

/// Whether two lists of numbers of one kind agree to rounding, against the greatest of them.
pub(super) fn agree(a: &[f64], b: &[f64]) -> bool {
    let scale = a.iter().chain(b).map(|value| value.abs()).fold(0.0, f64::max);
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME_STATE * scale)
}

/// Whether two solutions agree in every force and acceleration, to rounding.
fn is_same(one: &report::Solution, other: &report::Solution) -> bool {
    let forces = |solution: &report::Solution| -> Vec<f64> {
        let contacts = solution.contacts.iter().flat_map(|c| [c.normal_force, c.friction_force]);
        contacts.chain(solution.hinges.iter().flat_map(|hinge| hinge.force)).collect()
    };
    let couples = |solution: &report::Solution| -> Vec<f64> {
        let couples = solution.contacts.iter().filter_map(|contact| contact.couple);
        couples.chain(solution.drives.iter().map(|drive| drive.effort)).collect()
    };
    let accelerations = |solution: &report::Solution| -> Vec<f64> {
        let angular = solution.bodies.iter().map(|body| body.angular_acceleration);
        angular.chain(solution.bodies.iter().flat_map(|body| body.acceleration)).collect()
    };
    one.signs == other.signs
        && agree(&forces(one), &forces(other))
        && agree(&couples(one), &couples(other))
        && agree(&accelerations(one), &accelerations(other))
}
