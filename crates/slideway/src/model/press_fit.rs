//! Press fits: where the play is negative both faces of a guide are pressed, and each is a contact of its own.

use super::{Contact, JointKind, Model, Settings, Slider};
use crate::fault::{Fault, FaultKind, Faults};
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
        for joint in &mut self.joints {
            if let JointKind::Slider(slider) = &mut joint.kind {
                slider.join_faces();
                slider.split_faces(&|contact| contact.play.and_then(value).is_some_and(|play| play < 0.0));
            }
        }
    }

    /// [`Self::with`] as one value of a quantity that is varied, for all of which the contacts are the same.
    ///
    /// # Errors
    /// As there, and where play becomes negative that is not so in this model, or the other way round.
    pub(crate) fn varied_with(&self, settings: &Settings) -> Result<Self, Faults> {
        let model = self.with(settings)?;
        let fits = |model: &Self| model.contacts().map(|contact| contact.face).collect::<Vec<_>>();
        let (own, others) = (fits(self), fits(&model));
        if own == others {
            return Ok(model);
        }
        let is_fit = |contact: &&Contact| contact.face.is_some();
        let contact = self.contacts().find(is_fit).or_else(|| model.contacts().find(is_fit));
        let contact = contact.map_or_else(String::new, |contact| contact.place().to_owned());
        Err(Fault::general(FaultKind::PlayChangesSign { contact }).into())
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
