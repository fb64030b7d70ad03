//! What every sliding joint, contact and hinge with friction does while the motion is smooth.

use crate::ids::JointId;
use crate::mechanism::{Mechanism, Slider};
use crate::modes::Side;

/// What every sliding joint, contact and hinge with friction does between two events.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// One for each sliding joint, in the order of the mechanism's joints.
    pub joints: Vec<JointPhase>,
    /// One for each contact, in the order of the mechanism's contacts.
    pub contacts: Vec<ContactPhase>,
    /// One for each hinge with friction, in the order of the mechanism's friction circles.
    pub hinges: Vec<HingePhase>,
}

impl Phase {
    /// One character for each contact: `+` or `-` for the sign of its normal force, `0` in its preload gap or open,
    /// `=` where its joint sticks; then one for each hinge with friction: `+` or `-` for the sign of the angular
    /// velocity of its first body against the second, `=` where it sticks.
    pub fn pattern(&self, mechanism: &Mechanism) -> String {
        let sliders = sliding_joints(mechanism);
        let sticks = |k: usize| {
            let joint = sliders.iter().position(|joint| *joint == mechanism.contacts[k].joint);
            joint.is_some_and(|joint| self.joints[joint] == JointPhase::Sticking)
        };
        let sign = |k: usize| {
            if sticks(k) && !self.is_open(mechanism, k) { '=' } else { self.contacts[k].symbol() }
        };
        // A motion has further contacts behind those of the state: what was apart in it.
        let contacts = 0..self.contacts.len().min(mechanism.contacts.len());
        contacts.map(sign).chain(self.hinges.iter().map(|hinge| hinge.state.symbol())).collect()
    }

    /// Returns whether a contact that may lift off is open.
    pub(crate) fn is_open(&self, mechanism: &Mechanism, contact: usize) -> bool {
        mechanism.contacts[contact].opens && self.contacts[contact] == ContactPhase::PreloadGap
    }

    /// The contacts that may lift off and are open, by their numbers.
    pub(crate) fn open(&self, mechanism: &Mechanism) -> Vec<usize> {
        (0..self.contacts.len()).filter(|&k| self.is_open(mechanism, k)).collect()
    }

    /// Whether every joint, contact and hinge does what it does in another phase.
    pub(crate) fn has_states_of(&self, other: &Self) -> bool {
        self.contacts == other.contacts && self.joints_and_hinges().eq(other.joints_and_hinges())
    }

    /// Whether something touches or is hinged with friction, and none of that slides or turns: what is apart does neither.
    pub(crate) fn is_at_rest(&self, mechanism: &Mechanism) -> bool {
        let touches = |slider: &Slider| {
            slider.contacts.is_empty() || slider.contacts.iter().any(|k| !self.is_open(mechanism, k.index()))
        };
        let sliders = mechanism.sliders().zip(&self.joints).filter(|((_, slider), _)| touches(slider));
        let hinges = self.hinges.iter().map(|hinge| hinge.state);
        let mut all = sliders.map(|(_, state)| *state).chain(hinges).peekable();
        all.peek().is_some() && all.all(|state| state == JointPhase::Sticking)
    }

    /// Whether something sticks.
    pub(crate) fn sticks(&self) -> bool {
        self.joints_and_hinges().any(|joint| joint == JointPhase::Sticking)
    }

    /// What one of the sliding joints and hinges with friction does.
    pub(crate) fn of(&self, number: usize) -> JointPhase {
        self.joints.get(number).copied().unwrap_or_else(|| self.hinges[number - self.joints.len()].state)
    }

    /// Lets one of the sliding joints and hinges with friction do something.
    pub(crate) fn set(&mut self, number: usize, does: JointPhase) {
        match number.checked_sub(self.joints.len()) {
            None => self.joints[number] = does,
            Some(hinge) => self.hinges[hinge].state = does,
        }
    }

    /// What the sliding joints do, then the hinges with friction.
    pub(crate) fn joints_and_hinges(&self) -> impl Iterator<Item = JointPhase> {
        self.joints.iter().copied().chain(self.hinges.iter().map(|hinge| hinge.state))
    }
}

/// What a hinge with friction does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HingePhase {
    /// Whether it turns, with the sign of the angular velocity of its first body against the second, or sticks.
    pub state: JointPhase,
    /// Its force on the first body where the phase begins (N): of several solutions in which everything else is the same
    /// it says which one is meant.
    pub force: [f64; 2],
}

/// What a sliding joint does, or a hinge with friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointPhase {
    /// It slides or turns: kinetic friction acts against the velocity, whose sign is given (1 or -1).
    Sliding(f64),
    /// It sticks: no relative velocity, friction is a reaction.
    Sticking,
}

impl JointPhase {
    /// What a joint does whose velocity has this sign, or none.
    pub(crate) fn of_sign(sign: f64) -> Self {
        if sign == 0.0 { Self::Sticking } else { Self::Sliding(sign) }
    }

    /// The sign of the velocity: 1, -1, or 0 where it sticks.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Sliding(sign) => sign,
            Self::Sticking => 0.0,
        }
    }

    fn symbol(self) -> char {
        match self {
            Self::Sliding(sign) if sign < 0.0 => '-',
            Self::Sliding(_) => '+',
            Self::Sticking => '=',
        }
    }
}

/// What a contact does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactPhase {
    /// The block is pressed against this side.
    Pressed(Side),
    /// N = 0, and the friction of the preload acts between the faces (theory, section 3: preload gap). Of
    /// redundant guides, the contact is open (section 10), and of contacts that may lift off (section 12).
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

    /// What a contact that may lift off does while it is closed.
    pub(crate) const CLOSED: &'static [Self] = &[Self::Pressed(Side::Positive)];

    const POSITIVE_FACE: [Self; 2] = [Self::Pressed(Side::Positive), Self::PreloadGap];
    const ALL: [Self; 3] = [Self::Pressed(Side::Positive), Self::Pressed(Side::Negative), Self::PreloadGap];
}

/// The sliding joints of a mechanism, in their order.
pub(crate) fn sliding_joints(mechanism: &Mechanism) -> Vec<JointId> {
    mechanism.sliders().map(|(joint, _)| joint).collect()
}
