//! What every sliding joint and contact does while the motion is smooth.

use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::modes::Side;

/// What every sliding joint and contact does between two events.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// One for each sliding joint, in the order of the mechanism's joints.
    pub joints: Vec<JointPhase>,
    /// One for each contact, in the order of the mechanism's contacts.
    pub contacts: Vec<ContactPhase>,
}

impl Phase {
    /// One character for each contact: `+` or `-` for the sign of its normal force, `0` in its preload gap,
    /// `=` where its joint sticks.
    pub fn pattern(&self, mechanism: &Mechanism) -> String {
        let sliders = sliding_joints(mechanism);
        let contacts = mechanism.contacts.iter().zip(&self.contacts);
        let sign = |(contact, phase): (&crate::mechanism::Contact, &ContactPhase)| {
            let joint = sliders.iter().position(|joint| *joint == contact.joint);
            if joint.is_some_and(|joint| self.joints[joint] == JointPhase::Sticking) {
                '='
            } else {
                phase.symbol()
            }
        };
        contacts.map(sign).collect()
    }
}

/// What a sliding joint does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointPhase {
    /// It slides: kinetic friction acts against the velocity, whose sign is given (1 or -1).
    Sliding(f64),
    /// It sticks: no relative velocity along the guide, friction is a reaction.
    Sticking,
}

/// What a contact does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactPhase {
    /// The block is pressed against this side.
    Pressed(Side),
    /// N = 0, and the friction of the preload acts between the faces (theory, section 3: preload gap). Of
    /// redundant guides, the contact is open (section 10).
    PreloadGap,
}

impl ContactPhase {
    /// `+` or `-` for the sign of the normal force, `0` between the faces.
    pub(crate) fn symbol(self) -> char {
        match self {
            Self::Pressed(Side::Positive) => '+',
            Self::Pressed(Side::Negative) => '-',
            Self::PreloadGap => '0',
        }
    }

    /// What a contact may do, which may be between its faces or not.
    pub(crate) fn options(between_faces: bool) -> &'static [Self] {
        if between_faces { &Self::ALL } else { &Self::ALL[..2] }
    }

    /// What a face of a press fit may do: it is pressed, or open.
    pub(crate) fn options_of_face(is_positive: bool) -> &'static [Self] {
        if is_positive { &Self::POSITIVE_FACE } else { &Self::ALL[1..] }
    }

    const POSITIVE_FACE: [Self; 2] = [Self::Pressed(Side::Positive), Self::PreloadGap];
    const ALL: [Self; 3] = [Self::Pressed(Side::Positive), Self::Pressed(Side::Negative), Self::PreloadGap];
}

/// The sliding joints of a mechanism, in their order.
pub(crate) fn sliding_joints(mechanism: &Mechanism) -> Vec<JointId> {
    let joints = (0..mechanism.joints.len()).map(JointId);
    joints.filter(|joint| mechanism.slider(*joint).is_some()).collect()
}
