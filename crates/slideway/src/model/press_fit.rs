//! Press fits: where the play is negative both faces of a guide are pressed, and each is a contact of its own.

use super::{Contact, JointKind, Model, Setting, Slider};
use crate::fault::{Faults, Source};
use crate::ids::FormulaId;
use std::sync::Arc;

/// A face of a press fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Face<I> {
    /// Whether it is the one that is pressed when the normal force is positive.
    pub is_positive: bool,
    /// The other face, in a model among the contacts of its joint.
    pub other: I,
}

impl Model {
    /// Makes two contacts of each that has negative play, its faces, and one of those that have no longer:
    /// "joint.front.plus" in the place of "joint.front", and "joint.front.minus" behind the contacts of all places.
    pub(super) fn split_press_fits(&mut self, values: &[Option<f64>]) {
        let value = |id: FormulaId| values.get(id.index()).copied().flatten();
        self.split(&|contact| contact.play.and_then(value).is_some_and(|play| play < 0.0));
    }

    fn split(&mut self, is_press_fit: &dyn Fn(&Contact) -> bool) {
        for joint in &mut self.joints {
            if let JointKind::Slider(slider) = &mut joint.kind {
                slider.join_faces();
                slider.split_faces(is_press_fit);
            }
        }
    }

    /// [`Self::with`] as values of quantities that are varied, each with the argument that says so; for all of
    /// them the contacts are those of this model. [`Mechanism::new`](crate::mechanism::Mechanism::new) refuses
    /// play of another sign.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn varied_with(&self, values: &[(Setting, Arc<str>)]) -> Result<Self, Faults> {
        let changes = values.iter().map(|(setting, text)| (setting, Source::Argument(text.clone())));
        let mut model = self.changed(changes, &[])?;
        let fits = |model: &Self| -> Vec<String> {
            let faces = model.contacts().filter(|contact| contact.face.is_some());
            faces.map(|contact| contact.place().to_owned()).collect()
        };
        let own = fits(self);
        if own != fits(&model) {
            model.split(&|contact| own.iter().any(|place| **place == *contact.name));
        }
        Ok(model)
    }
}

impl Slider {
    fn join_faces(&mut self) {
        self.contacts.retain(|contact| contact.face.is_none_or(|face| face.is_positive));
        for contact in &mut self.contacts {
            contact.name = Arc::from(contact.place());
            contact.face = None;
        }
    }

    fn split_faces(&mut self, is_press_fit: &dyn Fn(&Contact) -> bool) {
        for place in 0..self.contacts.len() {
            if !is_press_fit(&self.contacts[place]) {
                continue;
            }
            let (other, whole) = (self.contacts.len(), self.contacts[place].clone());
            let face = |end: &str, is_positive: bool, other: usize| Contact {
                name: format!("{}.{end}", whole.name).into(),
                face: Some(Face { is_positive, other }),
                ..whole.clone()
            };
            self.contacts.push(face("minus", false, place));
            self.contacts[place] = face("plus", true, other);
        }
    }
}

impl Contact {
    /// Its name, of the face of a press fit that of both: "joint.front" of "joint.front.plus".
    pub(crate) fn place(&self) -> &str {
        place_of(&self.name, self.face.is_some())
    }
}

/// The name of the place of a contact, which names of faces have in front of them.
pub(crate) fn place_of(name: &str, is_face: bool) -> &str {
    name.rsplit_once('.').filter(|_| is_face).map_or(name, |(place, _)| place)
}
