//! The friction of every contact in a state, eq. (2).

use crate::influence::ContactFriction;
use crate::mechanism::Mechanism;
use crate::model::PreloadLine;
use crate::modes::ContactState;
use nalgebra::DVector;

/// The friction of every contact, split by the face where it acts; `shares` has the share of the positive
/// face of each contact in its gap.
pub(crate) fn friction(
    mechanism: &Mechanism,
    velocity_signs: &DVector<f64>,
    pattern: &[ContactState],
    normal_force: &DVector<f64>,
    shares: &[Option<f64>],
) -> Vec<ContactFriction> {
    let one = |k: usize| {
        let contact = &mechanism.contacts[k];
        let sign = velocity_signs[k];
        // Share of the friction at the face of positive normal force.
        let share = match (pattern[k], shares[k]) {
            (ContactState::Gap, share) => share.unwrap_or(0.5),
            (ContactState::Positive, _) => 1.0,
            (ContactState::Negative, _) => 0.0,
        };
        let mu = share * contact.mu[0] + (1.0 - share) * contact.mu[1];
        let pressure = mu * normal_force[k].abs() * sign;
        let preload = [share * contact.preload[0] * sign, (1.0 - share) * contact.preload[1] * sign];
        let preload = match contact.preload_line {
            PreloadLine::Pressed => preload,
            PreloadLine::Centre => [f64::midpoint(preload[0], preload[1]); 2],
        };
        ContactFriction {
            positive_face: share * pressure + preload[0],
            negative_face: (1.0 - share) * pressure + preload[1],
        }
    };
    (0..pattern.len()).map(one).collect()
}
