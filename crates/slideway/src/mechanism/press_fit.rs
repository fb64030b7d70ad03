//! The faces of press fits, each a contact of its own: both together are one place of the guide.

use super::{Contact, JointKind, Mechanism, Slider};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::ContactId;
use crate::interval::{Interval, Real};
use crate::model::{SliderKind, place_of};
use crate::modes::ContactState;

impl<T: Real> Contact<T> {
    /// Half of what both faces of a press fit overlap (m), by which the line of the guide is displaced towards `+n` for
    /// the positive face and against it for the negative one; 0 for other contacts.
    pub(crate) fn interference(&self) -> T {
        self.face.map_or(T::zero(), |face| self.play / T::exactly(if face.is_positive { -2.0 } else { 2.0 }))
    }
}

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

impl<T> Slider<T> {
    /// Whether its block cannot turn against the guide.
    pub(crate) fn is_guided(&self) -> bool {
        self.kind == SliderKind::Guided
    }
}

impl<T> Mechanism<T> {
    /// The names of the guided sliders with these numbers, which follow the order of the joints, each once.
    pub(crate) fn guided_sliders(&self, numbers: &[usize]) -> Vec<String> {
        let guided = self.joints.iter().filter(|joint| match &joint.kind {
            JointKind::Slider(slider) => slider.is_guided(),
            JointKind::Hinge(_) => false,
        });
        let names: Vec<&str> = guided.map(|joint| &*joint.name).collect();
        let is_meant = |(number, _): &(usize, &&str)| numbers.contains(number);
        names.iter().enumerate().filter(is_meant).map(|(_, name)| (*name).to_owned()).collect()
    }

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
        self.put_out_of_open(states, forces, nothing);
    }

    /// Turns forces (N) of the mode problem into those of the faces of press fits.
    pub(crate) fn forces_at_faces(&self, states: &[ContactState], mut forces: Vec<f64>) -> Vec<f64> {
        self.put_at_faces(states, &mut forces, 0.0, |one, other| one + other);
        forces
    }

    /// Turns bounds of forces (N) of the mode problem into those of the faces of press fits.
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
