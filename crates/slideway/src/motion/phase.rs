//! What every sliding joint and contact does while the motion is smooth.

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
    /// One character for each contact: `+` or `-` for the sign of its normal force, `0` in its preload gap, `=` where its
    /// joint sticks.
    pub fn pattern(&self, mechanism: &Mechanism) -> String {
        let sliders = super::equations::sliding_joints(mechanism);
        let contacts = mechanism.contacts.iter().zip(&self.contacts);
        let sign = |(contact, phase): (&crate::mechanism::Contact, &ContactPhase)| {
            let joint = sliders.iter().position(|joint| *joint == contact.joint);
            match phase {
                _ if joint.is_some_and(|joint| self.joints[joint] == JointPhase::Sticking) => '=',
                ContactPhase::Pressed(Side::Positive) => '+',
                ContactPhase::Pressed(Side::Negative) => '-',
                ContactPhase::PreloadGap => '0',
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
    /// N = 0, and the friction of the preload acts between the faces (theory, section 3: preload gap).
    PreloadGap,
}
