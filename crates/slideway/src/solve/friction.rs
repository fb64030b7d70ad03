//! The friction of every contact in a state, eq. (2).

use crate::influence::ContactFriction;
use crate::law::positive_share;
use crate::mechanism::Mechanism;
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
        let share = positive_share(pattern[k], shares[k]);
        let [positive_face, negative_face] = contact.sliding(velocity_signs[k], share, normal_force[k].abs());
        ContactFriction { positive_face, negative_face }
    };
    (0..pattern.len()).map(one).collect()
}
