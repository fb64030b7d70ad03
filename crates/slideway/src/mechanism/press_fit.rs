//! The faces of press fits, each a contact of its own: both together are one place of the guide.

use super::{Contact, Mechanism, Slider};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::ContactId;
use crate::interval::{Interval, Real};
use crate::model::place_of;
use crate::modes::ContactState;

impl<T> Contact<T> {
    /// Its name, of the face of a press fit that of both: "joint.front" of "joint.front.plus".
    pub fn place(&self) -> &str {
        place_of(&self.name, self.face.is_some())
    }

    /// Whether it is the negative face of a press fit, which is at the place of the positive one.
    pub fn is_second_face(&self) -> bool {
        self.face.is_some_and(|face| !face.is_positive)
    }
}

impl<T> Mechanism<T> {
    /// One contact for each place: of a press fit the positive face.
    pub fn places(&self) -> impl Iterator<Item = ContactId> + '_ {
        (0..self.contacts.len()).filter(|&k| !self.contacts[k].is_second_face()).map(ContactId)
    }

    /// The places of a sliding joint.
    pub fn places_of<'s>(&'s self, slider: &'s Slider<T>) -> impl Iterator<Item = ContactId> + 's {
        let contacts = slider.contacts.iter().copied();
        contacts.filter(|contact| !self.contacts[contact.index()].is_second_face())
    }

    /// The faces of each press fit, the positive one first.
    pub fn press_fits(&self) -> Vec<[usize; 2]> {
        let positive = |k: usize| self.contacts[k].face.filter(|face| face.is_positive);
        (0..self.contacts.len()).filter_map(|k| Some([k, positive(k)?.other.index()])).collect()
    }
}

impl<T> Mechanism<T> {
    /// Whether guides share their load, beyond the two faces of each press fit.
    pub fn is_redundant(&self) -> bool {
        self.excess.contacts.len() > self.press_fits().len() || !self.excess.rows.is_empty()
    }
}

impl<T: Real> Mechanism<T> {
    /// Two contacts stand for a press fit, and one for a fit with play.
    ///
    /// # Errors
    /// Play of another sign than that for which the model has its contacts.
    pub(super) fn check_signs_of_play(&self) -> Result<(), Faults> {
        let mut faults = Faults::default();
        for contact in &self.contacts {
            let fits = match contact.face {
                Some(_) => contact.play.upper() <= 0.0,
                None => contact.play.lower() >= 0.0,
            };
            if !fits {
                let kind = FaultKind::PlayChangesSign { contact: contact.place().to_owned() };
                faults.push(Fault::new(kind, self.joints[contact.joint.index()].place.clone()));
            }
        }
        faults.or(())
    }
}

impl Mechanism {
    /// The half of both faces' overlap (m), by which the guide's line is displaced for a face of a press fit; 0 for
    /// others.
    pub(crate) fn interference(&self, contact: usize) -> f64 {
        let Contact { face, play, .. } = &self.contacts[contact];
        face.map_or(0.0, |face| if face.is_positive { -play / 2.0 } else { play / 2.0 })
    }

    /// Turns forces as the mode problem has them into those of the faces of press fits: where both are in one state, one
    /// face carries the `sum` of both forces, and the other one, which is open, `nothing`.
    pub(crate) fn put_at_faces<V: Copy>(
        &self,
        states: &[ContactState],
        forces: &mut [V],
        nothing: V,
        sum: impl Fn(V, V) -> V,
    ) {
        for [positive, negative] in self.press_fits() {
            let (open, pressed) = match [states[positive], states[negative]] {
                [ContactState::Positive, ContactState::Positive] => (negative, positive),
                [ContactState::Negative, ContactState::Negative] => (positive, negative),
                _ => continue,
            };
            forces[pressed] = sum(forces[pressed], forces[open]);
            forces[open] = nothing;
        }
    }

    /// The same for forces (N).
    pub(crate) fn forces_at_faces(&self, states: &[ContactState], mut forces: Vec<f64>) -> Vec<f64> {
        self.put_at_faces(states, &mut forces, 0.0, |one, other| one + other);
        forces
    }

    /// The same for bounds of forces (N).
    pub(crate) fn bounds_at_faces(
        &self,
        states: &[ContactState],
        mut bounds: Vec<Interval>,
    ) -> Vec<[f64; 2]> {
        self.put_at_faces(states, &mut bounds, Interval::ZERO, |one, other| one + other);
        bounds.iter().map(|bounds| [bounds.lower(), bounds.upper()]).collect()
    }

    /// Refuses press fits, for what is not known of them.
    ///
    /// # Errors
    /// A fault that names them, if there are some.
    pub(crate) fn check_no_press_fit(&self, question: &'static str) -> Result<(), Faults> {
        let fits: Vec<&Contact> = self.contacts.iter().filter(|contact| contact.is_second_face()).collect();
        let Some(first) = fits.first() else { return Ok(()) };
        let contacts = fits.iter().map(|contact| contact.place().to_owned()).collect();
        let place = self.joints[first.joint.index()].place.clone();
        Err(Fault::new(FaultKind::PressFit { question, contacts }, place).into())
    }
}
