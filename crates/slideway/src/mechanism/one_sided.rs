//! Contacts that may lift off: what is open in a state is not there.

use super::{Attachment, Contact, Joint, JointKind, Mechanism, Slider};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use crate::interval::Real;
use crate::model::{Round, SliderKind};
use crate::modes::ContactState;

impl<T: Real> Slider<T> {
    /// Returns whether the block is a disc: a pin whose friction acts at its rim, at half its height.
    pub fn is_disc(&self) -> bool {
        self.kind == SliderKind::Pin && !self.height.is_zero()
    }

    /// Radius of a disc; zero of other blocks.
    pub(crate) fn rim(&self) -> T {
        if self.is_disc() { self.height / T::exactly(2.0) } else { T::zero() }
    }

    /// The centre of the round face of its guide.
    pub fn centre_of(&self, round: &Round<T>) -> Attachment<T> {
        Attachment { frame: self.guide, position: round.centre.into(), z: self.z }
    }
}

impl<T: Real> Mechanism<T> {
    /// Returns whether some contacts may lift off.
    pub(crate) fn has_one_sided(&self) -> bool {
        self.contacts.iter().any(|contact| contact.opens)
    }

    /// Returns whether a joint lies on a face in the drawing that it may leave with all of its contacts, or is apart from it.
    pub fn may_lift_off(&self, slider: &Slider<T>) -> bool {
        let mut contacts = slider.contacts.iter().map(|contact| &self.contacts[contact.index()]);
        let leaves = |contact: &Contact<T>| contact.opens && contact.lean.is_none();
        !slider.apart.is_empty() || (!slider.contacts.is_empty() && contacts.all(leaves))
    }

    /// Returns the same of a joint; `false` of one that does not slide.
    pub(crate) fn leaves_its_face(&self, joint: JointId) -> bool {
        self.slider(joint).is_some_and(|slider| self.may_lift_off(slider))
    }

    /// The joints that do not slip in the state.
    pub(crate) fn sticking(&self) -> impl Iterator<Item = (JointId, &Slider<T>)> {
        self.sliders().filter(|(_, slider)| slider.sticks)
    }

    /// The contacts that may lift off.
    pub(crate) fn one_sided(&self) -> impl Iterator<Item = ContactId> + '_ {
        (0..self.contacts.len()).filter(|&k| self.contacts[k].opens).map(ContactId)
    }

    /// The contacts that lift off in a state of the mode problem.
    pub(crate) fn opening<'s>(&'s self, states: &'s [ContactState]) -> impl Iterator<Item = usize> + 's {
        self.one_sided().map(ContactId::index).filter(|&k| states[k] == ContactState::Negative)
    }

    /// Whether a contact that may lift off is closed in a state of the mode problem; none of other contacts.
    pub(crate) fn is_closed(&self, states: &[ContactState], contact: usize) -> Option<bool> {
        self.contacts[contact].opens.then(|| states[contact] != ContactState::Negative)
    }

    /// The joints that tip in a state of the mode problem: some of their corners have left their face, others stay there.
    pub(crate) fn tipped(&self, states: &[ContactState]) -> Vec<String> {
        self.tipped_where(|k| self.is_closed(states, k))
    }

    /// The same, where `is_closed` says whether a contact that may lift off is closed; none of other contacts.
    pub(crate) fn tipped_where(&self, is_closed: impl Fn(usize) -> Option<bool>) -> Vec<String> {
        let tips = |(joint, slider): (JointId, &Slider<T>)| {
            let closed: Vec<bool> = slider.contacts.iter().filter_map(|k| is_closed(k.index())).collect();
            let tips = closed.contains(&true) && closed.contains(&false);
            tips.then(|| self.joints[joint.index()].name.to_string())
        };
        self.sliders().filter_map(tips).collect()
    }

    /// Returns whether something may tip: a guided slider, or a block that may lift off one of its corners.
    pub(crate) fn may_tip(&self) -> bool {
        self.sliders().any(|(_, slider)| {
            let opens = slider.contacts.iter().filter(|contact| self.contacts[contact.index()].opens);
            slider.is_guided() || opens.count() > 1
        })
    }

    /// Takes `nothing` for the forces of the contacts that lift off.
    pub(crate) fn put_out_of_open<V: Copy>(&self, states: &[ContactState], forces: &mut [V], nothing: V) {
        self.opening(states).for_each(|k| forces[k] = nothing);
    }
}

/// A block may be off the line through both ends of its face by this part of the size of the mechanism, for rounding.
const ON_FACE: f64 = 1e-9;

impl Mechanism {
    /// Lets the joints that do not slip in the state move as the others. Other joint equations, which are before theirs, keep
    /// their numbers.
    pub(crate) fn let_slip(&mut self) {
        for joint in &mut self.joints {
            if let JointKind::Slider(slider) = &mut joint.kind {
                slider.sticks = false;
            }
        }
    }

    /// The mechanism with the contacts that are apart, too, behind all others: what moves may touch with any of them.
    pub(crate) fn with_all_contacts(&self) -> Self {
        let mut whole = self.clone();
        for joint in &mut whole.joints {
            let JointKind::Slider(slider) = &mut joint.kind else { continue };
            let apart = std::mem::take(&mut slider.apart);
            // The overlap of a block is that of its first two contacts.
            if apart.is_empty() {
                continue;
            }
            for contact in apart {
                slider.contacts.push(ContactId(whole.contacts.len()));
                whole.contacts.push(contact);
            }
            // The front one first.
            let offset = |contact: &ContactId| whole.contacts[contact.index()].offset;
            slider.contacts.sort_by(|one, other| offset(other).total_cmp(&offset(one)));
        }
        whole
    }

    /// The mechanism while these contacts are open, in their order: those that still touch are apart from their faces in it, the
    /// others are not there, and a block that is left with one corner touches with that.
    pub(crate) fn touching(&self, open: &[usize], touch: impl Fn(usize) -> bool) -> Self {
        let mut left = self.without_contacts(open);
        for &k in open.iter().filter(|&&k| touch(k)) {
            let contact = &self.contacts[k];
            if let JointKind::Slider(slider) = &mut left.joints[contact.joint.index()].kind {
                slider.apart.push(contact.clone());
            }
        }
        for joint in &mut left.joints {
            let JointKind::Slider(slider) = &mut joint.kind else { continue };
            let [corner] = slider.contacts[..] else { continue };
            if !left.contacts[corner.index()].opens {
                continue;
            }
            let moved = std::mem::replace(&mut left.contacts[corner.index()].offset, 0.0);
            slider.apart.iter_mut().for_each(|contact| contact.offset -= moved);
            slider.at += slider.tangent * moved;
            slider.travel = None;
            slider.kind = SliderKind::Pin;
        }
        left
    }

    /// Refuses blocks that are not on their faces in the drawing, given how far each is off.
    ///
    /// # Errors
    /// A fault for each of them.
    pub(super) fn check_on_faces(&self, off: impl Iterator<Item = (JointId, f64)>) -> Result<(), Faults> {
        let mut faults = Faults::default();
        for (joint, off) in off.filter(|(_, off)| off.abs() > ON_FACE * self.size) {
            let joint = &self.joints[joint.index()];
            let kind = FaultKind::OffFace {
                contact: joint.name.to_string(),
                gap: self.units.of("m").show(off.abs()),
            };
            faults.push(Fault::new(kind, joint.place.clone()));
        }
        faults.or(())
    }
}

impl<T: Real> Mechanism<T> {
    /// Refuses contacts that may lift off and take part in a self-stress, as nothing says what they carry while they slide.
    ///
    /// # Errors
    /// A fault that names them.
    pub(crate) fn check_one_sided_in_excess(&self) -> Result<(), Faults> {
        let shares: Vec<ContactId> =
            self.one_sided().filter(|contact| self.excess.shares(*contact)).collect();
        let in_space = self.space.is_some();
        self.refuse(&shares, |contacts| FaultKind::OneSidedInExcess { contacts, in_space })
    }

    /// Refuses contacts that may lift off, for what is not known of them.
    ///
    /// # Errors
    /// A fault that names them, if there are some.
    pub(crate) fn check_no_one_sided(&self, question: &'static str) -> Result<(), Faults> {
        let contacts: Vec<ContactId> = self.one_sided().collect();
        self.refuse(&contacts, |contacts| FaultKind::OneSided { question, contacts })?;
        let is_apart = |joint: &&Joint<T>| match &joint.kind {
            JointKind::Slider(slider) => !slider.apart.is_empty(),
            JointKind::Hinge(_) => false,
        };
        let apart: Vec<&Joint<T>> = self.joints.iter().filter(is_apart).collect();
        let Some(first) = apart.first() else { return Ok(()) };
        let contacts = apart.iter().map(|joint| joint.name.to_string()).collect();
        Err(Fault::new(FaultKind::OneSided { question, contacts }, first.place.clone()).into())
    }

    fn refuse(
        &self,
        contacts: &[ContactId],
        kind: impl FnOnce(Vec<String>) -> FaultKind,
    ) -> Result<(), Faults> {
        let Some(first) = contacts.first() else { return Ok(()) };
        let contact = |id: &ContactId| &self.contacts[id.index()];
        let names = contacts.iter().map(|id| contact(id).name.to_string()).collect();
        let place = self.joints[contact(first).joint.index()].place.clone();
        Err(Fault::new(kind(names), place).into())
    }

    /// The mechanism without these contacts, in their order: what is left of it when they are open. Joints keep
    /// their numbers.
    pub(crate) fn without_contacts(&self, open: &[usize]) -> Self {
        let mut left = self.clone();
        let kept: Vec<usize> = (0..self.contacts.len()).filter(|k| !open.contains(k)).collect();
        let place = |contact: ContactId| kept.iter().position(|&k| k == contact.index()).map(ContactId);
        left.contacts = kept.iter().map(|&k| self.contacts[k].clone()).collect();
        let faces = left.contacts.iter_mut().filter_map(|Contact { face, .. }| face.as_mut());
        faces.for_each(|face| face.other = place(face.other).unwrap_or(face.other));
        for joint in &mut left.joints {
            if let JointKind::Slider(slider) = &mut joint.kind {
                slider.contacts = slider.contacts.iter().filter_map(|contact| place(*contact)).collect();
            }
        }
        for end in left.friction_circles.iter_mut().filter_map(|circle| circle.end.as_mut()) {
            *end = end.map(|contact| place(contact).unwrap_or(contact));
        }
        // Of no self-stress is a contact that may lift off a part.
        left.excess.contacts = self.excess.contacts.iter().filter_map(|contact| place(*contact)).collect();
        left.excess.open = self.excess.open.of_contacts(&kept);
        left
    }
}
