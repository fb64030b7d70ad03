//! Accelerations and reactions of a phase.

use super::assessment::{Assessment, system_of};
use super::instant::Instant;
use super::system::Question;
use crate::influence::ContactFriction;
use crate::kinetics::Layout;
use crate::motion::{JointPhase, Phase};
use nalgebra::DVector;

/// Accelerations and reactions of a mechanism in a phase.
#[derive(Debug, Clone, PartialEq)]
pub struct PhaseState {
    /// All unknowns of the kinetic equations: accelerations, reactions, efforts of the drives.
    pub unknowns: DVector<f64>,
    /// Where they stand.
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
    /// Number of reactions that statics leaves open; those of greatest margin are told. Zero where no joint sticks,
    /// unless the mode is singular (D = 0).
    pub indeterminate: usize,
    /// How much friction is left to the joints that stick, see [`sticking_margin`](super::sticking_margin); nothing
    /// where none sticks.
    pub margin: Option<f64>,
    /// The least slack of everything that bounds the phase, likewise in units of the greatest force or acceleration;
    /// negative if the phase is not admissible.
    pub least_slack: f64,
}

/// What a phase does to a mechanism.
pub(super) fn state(
    instant: &Instant<'_>,
    question: &Question<'_>,
    assessment: &Assessment,
) -> Option<PhaseState> {
    let system = system_of(instant, question, assessment)?;
    let unit = instant.units.force;
    let scaled = |friction: ContactFriction| ContactFriction {
        positive_face: friction.positive_face * unit,
        negative_face: friction.negative_face * unit,
    };
    let frictions: Vec<ContactFriction> =
        system.frictions(&assessment.open).into_iter().map(scaled).collect();
    let unknowns = instant.influence.unknowns(&frictions);
    let sliding = instant.joints.iter().zip(&assessment.phase.joints);
    let acceleration = |(joint, phase): (&super::instant::SlidingJoint, &JointPhase)| match phase {
        JointPhase::Sticking => 0.0,
        JointPhase::Sliding(_) => joint.row.acceleration(&unknowns),
    };
    Some(PhaseState {
        coordinate_accelerations: instant.equations.coordinate_accelerations(&unknowns),
        sliding_accelerations: sliding.map(acceleration).collect(),
        normal_forces: system.normal_forces(&assessment.open).into_iter().map(|n| n * unit).collect(),
        frictions,
        shares: system.shares(&assessment.open),
        indeterminate: assessment.open.len(),
        margin: assessment.margin.is_finite().then_some(assessment.margin),
        least_slack: assessment.least(),
        layout: instant.influence.layout().clone(),
        unknowns,
    })
}

/// Whether two phases are the same but for the sides of contacts that stick and the signs of joints without friction,
/// which have no effect.
pub(super) fn is_same_phase(instant: &Instant<'_>, one: &Phase, other: &Phase) -> bool {
    let joints = one.joints.iter().zip(&other.joints).zip(&instant.joints);
    let same_joints = joints.map(|((a, b), joint)| {
        a == b || (!joint.has_friction && matches!((a, b), (JointPhase::Sliding(_), JointPhase::Sliding(_))))
    });
    let contacts = one.contacts.iter().zip(&other.contacts).enumerate();
    let same_contacts = contacts.map(|(k, (a, b))| {
        let joint = instant.joint_of(k);
        a == b || joint.is_some_and(|joint| one.joints[joint] == JointPhase::Sticking)
    });
    one.contacts.len() == other.contacts.len() && same_joints.chain(same_contacts).all(|same| same)
}
