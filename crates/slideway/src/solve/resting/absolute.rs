//! The states of joints at rest as those of a mode problem, whose search is proven (theory, section 12): two more unknowns `p`
//! and `q` for each joint that does not slide,
//!
//! ```text
//! F = (|q| - |p|)/2        p - q = 2 sum_k mu_k |N_k|        v' = rho (p^- - q^+)        N_k < 0: the gap opens
//! ```
//!
//! ```text
//! p >= 0 >= q   sticks     |F| <= mu |N|, v' = 0
//! p <= 0, q <= 0   slips forwards     F = mu |N|, v' >= 0          p >= 0, q >= 0   slips backwards     F = -mu |N|, v' <= 0
//! ```
//!
//! `p <= 0 <= q` leaves `p = q = 0`. Where all contacts of the joint are open, `p = q` is what `v'` says. Any `rho > 0` states the
//! same.

use super::patterns::lighter_mass;
use super::{Pattern, Resting, RestingJoint, Start, greatest_force, joints_of};
use crate::fault::Faults;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::modes::{ContactState, InfluenceCoefficients, ModeProblem, Side};
use crate::solve::answer::Answer;
use crate::solve::mode_problem::{none_stands, overflow};
use crate::solve::stages::Stages;
use crate::solve::standing::check_standing;
use nalgebra::DMatrix;

/// A joint at rest in the numbers of the problem.
struct AtRest {
    contacts: Vec<usize>,
    /// The acceleration of sliding by a unit of `p` or `q` (1/kg).
    rho: f64,
    /// For each side of the contacts twice their coefficients of friction; zero where they open.
    cone: [Vec<f64>; 2],
}

/// The mode problem of a mechanism of which some contacts do not slide: with the unknowns of all contacts, then `p` and `q` of each
/// joint at rest, in newtons.
///
/// # Errors
/// Static friction above kinetic friction, or friction that acts at faces of different heights, of what is at rest, which have no
/// such form; forces that are left open where all sticks, of which rounded numbers would have one; what [`check_standing`] refuses;
/// numbers beyond the range of floating point.
pub(in crate::solve) fn mode_problem(
    stages: &Stages,
    equations: &KineticEquations,
) -> Result<ModeProblem, Faults> {
    let mechanism = &stages.mechanism;
    check_standing(mechanism, &stages.standing)?;
    let joints = joints_of(stages, &stages.standing, |row, _| row.of_velocities());
    let answer = Answer::determinate(stages, equations);
    let resting = Resting::new(&answer, joints, greatest_force(&stages.influence));
    if !resting.joints.iter().all(|joint| has_one_law(mechanism, joint)) || resting.may_leave_forces_open() {
        none_stands(mechanism, &stages.standing)?;
    }
    let at_rest: Vec<AtRest> = resting.joints.iter().map(|joint| numbers(mechanism, joint)).collect();
    let rows: Vec<_> = resting.joints.into_iter().map(|joint| joint.row.into_equation()).collect();
    let coefficients = stages.data().coefficients(&[], &rows)?;
    let [positive, negative] = Side::BOTH.map(|side| columns(&coefficients, &at_rest, side));
    let size = positive.nrows();
    let [of_positive, of_negative] = {
        let jumps = coefficients.jumps();
        Side::BOTH.map(|side| scaled(jumps.get(side), &at_rest).resize(size, size, 0.0))
    };
    let load = coefficients.right_hand_side();
    let load = scaled(&DMatrix::from_columns(&[load]), &at_rest).column(0).into_owned();
    ModeProblem::new(positive, negative, of_positive, of_negative, load.resize_vertically(size, 0.0))
        .map_err(|_| overflow())
}

impl Resting<'_> {
    /// Whether the forces are not determined where all contacts are closed and all joints at rest stick: the rows of any other
    /// pattern are some of these.
    fn may_leave_forces_open(&self) -> bool {
        let pattern = Pattern {
            states: vec![ContactState::Positive; self.answer.mechanism.contacts.len()],
            starts: vec![Some(Start::Sticks); self.joints.len()],
        };
        let set = self.equations(&self.system(pattern, self.answer.mechanism));
        set.is_none_or(|set| set.dimension() > 0)
    }
}

/// Whether friction of a joint at rest acts on one line, and its bound is what it is while it slips.
fn has_one_law(mechanism: &Mechanism, joint: &RestingJoint) -> bool {
    let is_flat = |contact: usize| {
        let slider = mechanism.slider(mechanism.contacts[contact].joint);
        mechanism.contacts[contact].opens || slider.is_none_or(|slider| slider.height == 0.0)
    };
    joint.contacts.iter().all(|&k| {
        let contact = &mechanism.contacts[k];
        contact.mu == contact.mu_static && contact.preload == [0.0; 2] && is_flat(k)
    })
}

fn numbers(mechanism: &Mechanism, joint: &RestingJoint) -> AtRest {
    let twice = |face: usize| {
        let of = |&k: &usize| {
            let contact = &mechanism.contacts[k];
            if face == 1 && contact.opens { 0.0 } else { 2.0 * contact.mu[face] }
        };
        joint.contacts.iter().map(of).collect()
    };
    AtRest {
        contacts: joint.contacts.clone(),
        rho: 10.0 / lighter_mass(mechanism, joint.joint),
        cone: [twice(0), twice(1)],
    }
}

/// The columns of one side of all unknowns: rows of the contacts, of the accelerations of the joints at rest as forces, and of
/// their cones.
fn columns(coefficients: &InfluenceCoefficients, joints: &[AtRest], side: Side) -> DMatrix<f64> {
    let contacts = coefficients.contacts();
    let accelerations = contacts + joints.len();
    let size = accelerations + joints.len();
    let mut all = scaled(coefficients.columns().get(side), joints).resize(size, size, 0.0);
    let answers = scaled(&coefficients.eta.positive, joints);
    let face = usize::from(side == Side::Negative);
    for (index, joint) in joints.iter().enumerate() {
        let [p, q] = [contacts + index, accelerations + index];
        let half = answers.column(joint.contacts[0]) / 2.0;
        all.view_mut((0, p), (accelerations, 1)).copy_from(&half);
        all.view_mut((0, q), (accelerations, 1)).copy_from(&-half);
        match side {
            Side::Positive => all[(contacts + index, q)] -= 1.0,
            Side::Negative => all[(contacts + index, p)] += 1.0,
        }
        let cone = accelerations + index;
        (all[(cone, p)], all[(cone, q)]) = (side.sign(), -side.sign());
        joint.contacts.iter().zip(&joint.cone[face]).for_each(|(&k, twice)| all[(cone, k)] = -twice);
    }
    all
}

/// Rows of contacts and of accelerations, these in the unit of `p` and `q`.
fn scaled(matrix: &DMatrix<f64>, joints: &[AtRest]) -> DMatrix<f64> {
    let mut scaled = matrix.clone();
    let contacts = matrix.nrows() - joints.len();
    for (index, joint) in joints.iter().enumerate() {
        scaled.row_mut(contacts + index).unscale_mut(joint.rho);
    }
    scaled
}
