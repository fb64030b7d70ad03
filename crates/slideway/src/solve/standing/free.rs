//! Friction forces and couples of what stands still.

use super::super::state::Held;
use crate::ids::ContactId;
use crate::influence::{ContactFriction, HingeState, Influence};
use crate::mechanism::{Contact, Mechanism};
use crate::model::PreloadLine;
use crate::modes::Side;
use crate::pattern::face;
use crate::problem::TurningHinge;
use nalgebra::DVector;

/// A friction force or couple that may be anything within a limit.
#[derive(Debug, Clone, Copy)]
pub(super) enum Free {
    /// The couple on the first body of a hinge: `|M| <= r |R|`.
    Hinge(TurningHinge),
    /// A force at the pressed face of a contact, which its pressure holds.
    Face(usize),
    /// A force in the middle between both faces, which a preload on the centre line holds.
    Middle(usize),
}

impl Free {
    /// Those of a contact.
    pub(super) fn of_contact(mechanism: &Mechanism, ContactId(k): ContactId) -> Vec<Self> {
        let contact = &mechanism.contacts[k];
        let is_central = contact.preload_line == PreloadLine::Centre && contact.preload != [0.0; 2];
        if is_central { vec![Self::Face(k), Self::Middle(k)] } else { vec![Self::Face(k)] }
    }

    /// What a unit of it adds to all unknowns.
    pub(super) fn unit(self, influence: &Influence, sides: &[Side]) -> DVector<f64> {
        match self {
            Self::Hinge(hinge) => influence.couples[hinge.circle].clone(),
            Self::Face(k) => influence.columns[k][face(sides[k])].clone(),
            Self::Middle(k) => {
                let [positive, negative] = &influence.columns[k];
                (positive + negative) / 2.0
            }
        }
    }

    /// The contact, and the limit of the force by its pressure and without: `|T| <= mu |N| + F_0`; none for a hinge.
    pub(super) fn limit(self, mechanism: &Mechanism, sides: &[Side]) -> Option<(usize, [f64; 2])> {
        let limits = |k: usize| {
            let Contact { preload_line, mu_static, preload, .. } = &mechanism.contacts[k];
            let side = face(sides[k]);
            preload_line.limits_at_rest(mu_static[side], preload[side])
        };
        match self {
            Self::Hinge(_) => None,
            Self::Face(k) => Some((k, limits(k)[0])),
            Self::Middle(k) => Some((k, limits(k)[1])),
        }
    }

    /// A force of a contact as friction, by the face where it acts; none for a hinge.
    pub(super) fn held(self, force: f64, sides: &[Side]) -> Option<Held> {
        let (contact, friction) = match self {
            Self::Hinge(_) => return None,
            Self::Face(k) if sides[k] == Side::Positive => (k, [force, 0.0]),
            Self::Face(k) => (k, [0.0, force]),
            Self::Middle(k) => (k, [force / 2.0; 2]),
        };
        let [positive_face, negative_face] = friction;
        Some(Held { contact, friction: ContactFriction { positive_face, negative_face } })
    }

    /// The contact or the hinge that stands, and the unit of its friction.
    pub(super) fn name_and_unit(self, mechanism: &Mechanism) -> (&str, &'static str) {
        match self {
            Self::Hinge(hinge) => (&mechanism.joints[hinge.joint.index()].name, "N m"),
            Self::Face(k) | Self::Middle(k) => (&mechanism.contacts[k].name, "N"),
        }
    }

    /// A hinge with this force and couple on its first body; none for a contact.
    pub(super) fn hinge(self, force: [f64; 2], couple: f64) -> Option<HingeState> {
        let Self::Hinge(TurningHinge { circle, joint, .. }) = self else { return None };
        Some(HingeState { circle, joint, force, couple })
    }
}
