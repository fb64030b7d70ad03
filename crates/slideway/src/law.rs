//! The laws of contacts and guided sliders, of which no other module knows the formulas: Coulomb's law of a contact that slides
//! and of one at rest, where the friction of a preload acts, and when a guided slider tips (theory, sections 1, 3 and 8).

use crate::interval::Real;
use crate::mechanism::{Contact, Slider};
use crate::model::PreloadLine;
use crate::modes::ContactState;

/// A couple may exceed |N| L / 2 by this multiple of the greatest of its terms before a guided slider counts
/// as tipping.
pub(crate) const COUPLE_TOLERANCE: f64 = 1e-9;

/// The share of a preload's friction that belongs to the face of positive normal force: all or nothing where the contact
/// presses, `in_gap` between its faces.
pub(crate) fn positive_share(state: ContactState, in_gap: Option<f64>) -> f64 {
    match state {
        ContactState::Positive => 1.0,
        ContactState::Negative => 0.0,
        ContactState::Gap => in_gap.unwrap_or(0.5),
    }
}

impl Contact {
    /// The friction at the faces of positive and of negative normal force while the contact slides with the sign `s`,
    /// `(mu |N| + F_0) s`, eq. (2), of which the first face has this share; `pressure` is |N|.
    pub(crate) fn sliding(&self, sign: f64, share: f64, pressure: f64) -> [f64; 2] {
        let shares = [share, 1.0 - share];
        let mu = shares[0] * self.mu[0] + shares[1] * self.mu[1];
        let preload = [0, 1].map(|face| shares[face] * self.preload[face] * sign);
        let preload = self.preload_line.of_faces(preload);
        [0, 1].map(|face| shares[face] * (mu * pressure * sign) + preload[face])
    }
}

impl PreloadLine {
    /// The effect of a preload's friction, from that of the same force at the face of positive and of negative normal force:
    /// it acts at the pressed face, or in the middle between both.
    pub(crate) fn of_faces<T: Real>(self, faces: [T; 2]) -> [T; 2] {
        match self {
            Self::Pressed => faces,
            Self::Centre => [(faces[0] + faces[1]) * T::exactly(0.5); 2],
        }
    }

    /// The limits `|F| <= mu_static |N| + F_0` of a contact that presses and sticks: of the friction at its face, and of that
    /// in the middle between its faces, each as the factor of |N| and the constant.
    pub(crate) fn limits_at_rest(self, mu_static: f64, preload: f64) -> [[f64; 2]; 2] {
        match self {
            Self::Pressed => [[mu_static, preload], [0.0; 2]],
            Self::Centre => [[mu_static, 0.0], [0.0, preload]],
        }
    }
}

impl Slider {
    /// The couple beyond which a guided slider tips under a normal force, |N| L / 2.
    pub(crate) fn greatest_couple(&self, normal_force: f64) -> f64 {
        normal_force.abs() * self.length / 2.0
    }
}

/// True if a guided slider with this couple tips, where `limit` is [`Slider::greatest_couple`], and the terms of the couple
/// are of this size.
pub(crate) fn tips(couple: f64, limit: f64, size: f64) -> bool {
    couple.abs() > limit + COUPLE_TOLERANCE * size
}
