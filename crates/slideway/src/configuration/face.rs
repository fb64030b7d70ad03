//! Where a contact that may lift off is between the ends of its face.

use super::Configuration;
use crate::ids::ContactId;
use crate::mechanism::{Attachment, Contact, Mechanism, Slider};

/// Within this part of the size of the mechanism beyond its end a contact still meets its face: what the drawing puts at the end is
/// off by rounding.
const ON_END: f64 = 1e-9;

impl Configuration {
    /// How far a block may slide backwards (-1) or forwards (1) until a contact that may lift off is at an end of its face (m).
    pub(crate) fn room_on_face(
        &self,
        mechanism: &Mechanism,
        slider: &Slider,
        contact: &Contact,
        end: f64,
    ) -> f64 {
        let position = contact.position(slider);
        let [corner, line_of] = contact.frames(slider);
        let [corner_place, opposite] = [corner, line_of]
            .map(|frame| self.position(mechanism, &Attachment { frame, position, z: slider.z }));
        let along = self.direction(line_of, slider.tangent).dot(&(corner_place - opposite));
        let ([least, greatest], place) = (mechanism.ends_of_face(slider, contact), along + contact.offset);
        // A corner of the guide goes backwards along the face of a block that slides forwards.
        let is_first = (end < 0.0) == (corner == slider.block);
        if is_first { place - least } else { greatest - place }
    }

    /// Returns whether a contact that may lift off is beyond the ends of its face.
    pub(crate) fn is_beside_face(&self, mechanism: &Mechanism, slider: &Slider, contact: &Contact) -> bool {
        let room = |end| self.room_on_face(mechanism, slider, contact, end);
        room(-1.0).min(room(1.0)) < -ON_END * mechanism.size
    }

    /// Returns whether a joint is within its travel; one that may lift off if what touches is on its face.
    pub(super) fn is_within_travel(&self, mechanism: &Mechanism, slider: &Slider) -> bool {
        let contact = |id: &ContactId| &mechanism.contacts[id.index()];
        if mechanism.may_lift_off(slider) {
            return !slider.contacts.iter().any(|id| self.is_beside_face(mechanism, slider, contact(id)));
        }
        let ([lowest, highest], at_end) = (slider.limits(), ON_END * mechanism.size);
        (lowest - at_end..=highest + at_end).contains(&self.slide(mechanism, slider).displacement)
    }
}
