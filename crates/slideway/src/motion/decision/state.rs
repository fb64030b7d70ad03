//! Accelerations and reactions of a phase.

use super::assessment::Assessment;
use super::instant::Instant;
use super::outputs::Group;
use super::parts::SAME;
use crate::influence::ContactFriction;
use crate::kinetics::Layout;
use crate::pattern::{JointPhase, Phase};
use nalgebra::DVector;

/// Accelerations and reactions of a mechanism in a phase.
#[derive(Debug, Clone, PartialEq)]
pub struct PhaseState {
    /// All unknowns of the kinetic equations: accelerations, reactions, efforts of the drives.
    pub unknowns: DVector<f64>,
    /// The layout of these unknowns.
    pub layout: Layout,
    /// Accelerations of the chosen coordinates (m/s^2, rad/s^2).
    pub coordinate_accelerations: Vec<f64>,
    /// Acceleration of each sliding joint along u (m/s^2), exactly zero where it sticks.
    pub sliding_accelerations: Vec<f64>,
    /// Normal force of each contact (N).
    pub normal_forces: Vec<f64>,
    /// Friction of each contact, positive along -u on the block (N).
    pub frictions: Vec<ContactFriction>,
    /// For each contact that slides in its preload gap, the share of the positive face.
    pub shares: Vec<Option<f64>>,
    /// Number of reactions that statics leaves open; those with the greatest margin are given. Zero if no
    /// joint sticks, unless the mode is singular (D = 0).
    pub indeterminate: usize,
    /// How much friction is left to the sticking joints, see [`sticking_margin`](super::sticking_margin);
    /// `None` if no joint sticks.
    pub margin: Option<f64>,
    /// The least slack of all bounds of the phase, also in units of the greatest force or acceleration;
    /// negative if the phase is not admissible.
    pub(crate) least_slack: f64,
}

/// The state of a mechanism in a phase.
pub(super) fn state(instant: &Instant<'_>, assessment: &Assessment) -> PhaseState {
    let forces = &assessment.forces;
    let unit = |k: usize| instant.units_of(k).force;
    let scaled = |(k, friction): (usize, &ContactFriction)| friction.times(unit(k));
    let frictions: Vec<ContactFriction> = forces.frictions.iter().enumerate().map(scaled).collect();
    let normal_forces: Vec<f64> =
        forces.normal.iter().enumerate().map(|(k, normal)| normal * unit(k)).collect();
    let mut unknowns = instant.influence.unknowns(&frictions, &DVector::from_column_slice(&normal_forces));
    for ((hinge, couple), column) in
        instant.hinges.iter().zip(&forces.couples).zip(&instant.influence.couples)
    {
        unknowns.axpy(couple * hinge.units.force * hinge.units.length, column, 1.0);
    }
    let sliding = instant.joints.iter().zip(&assessment.phase.joints);
    let acceleration = |(joint, phase): (&super::joints::SlidingJoint, &JointPhase)| match phase {
        JointPhase::Sticking => 0.0,
        JointPhase::Sliding(_) => joint.row.acceleration(&unknowns),
    };
    PhaseState {
        coordinate_accelerations: instant.equations.coordinate_accelerations(&unknowns),
        sliding_accelerations: sliding.map(acceleration).collect(),
        normal_forces,
        frictions,
        shares: forces.shares.clone(),
        indeterminate: assessment.indeterminate,
        margin: assessment.margin.is_finite().then_some(assessment.margin),
        least_slack: assessment.least(),
        layout: instant.influence.layout().clone(),
        unknowns,
    }
}

/// Whether a group does the same in two phases, apart from the sides of sticking contacts and the signs of
/// joints without friction, which have no effect. Hinges that turn have the same forces.
pub(super) fn is_same_phase(instant: &Instant<'_>, group: &Group, [one, other]: [&Phase; 2]) -> bool {
    let slides = |phase: &Phase, joint: usize| matches!(phase.joints[joint], JointPhase::Sliding(_));
    let same_joint = |joint: usize| {
        one.joints[joint] == other.joints[joint]
            || (!instant.joints[joint].has_friction && slides(one, joint) && slides(other, joint))
    };
    let same_contact = |k: usize| {
        one.contacts[k] == other.contacts[k]
            || instant.joint_of(k).is_some_and(|joint| one.joints[joint] == JointPhase::Sticking)
    };
    let same_hinge = |hinge: &usize| {
        let [one, other] = [one, other].map(|phase| phase.hinges[*hinge]);
        let apart = [0, 1].map(|part| (one.force[part] - other.force[part]).abs());
        let same = SAME * instant.hinges[*hinge].units.force;
        one.state == other.state
            && (one.state == JointPhase::Sticking || apart.iter().all(|apart| *apart <= same))
    };
    group.joints.iter().all(|joint| same_joint(*joint))
        && group.contacts.iter().all(|k| same_contact(*k))
        && group.hinges.iter().all(same_hinge)
}
