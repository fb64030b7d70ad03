//! Where blocks lie in the play of their guides.
//!
//! Guides that share a load have a play, a misalignment and deflections of their own: all of them are magnified
//! alike, so that a looser guide is seen to be looser. The play of all other guides does not count for forces:
//! they are given one that can be seen.

use super::ContactStates;
use super::View;
use super::looks::Look;
use super::sheet::nice;
use super::sliders;
use slideway::configuration::Configuration;
use slideway::ids::ContactId;
use slideway::mechanism::{Attachment, Mechanism, Slider, rot90};
use slideway::model::CarriedBy;
use slideway::units::Unit;

/// Greatest rotation (rad) and displacement (drawing units) that a contact mode gives a body.
const GREATEST_ROTATION: f64 = 0.25;
const GREATEST_DISPLACEMENT: f64 = 60.0;
/// The greatest play, misalignment or deflection of guides that share a load is drawn so large at most.
const SEEN: f64 = 10.0;
/// By how much the block of such a guide may miss its place, as rotations that are drawn are not small.
const MISSED: f64 = 1.0;

/// The data that decide where the blocks lie in their guides.
pub(super) struct Play<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) configuration: &'a Configuration,
    pub(super) states: &'a ContactStates,
    pub(super) view: &'a View,
    pub(super) looks: &'a [Look],
}

/// A mechanism with its blocks displaced in their guides.
pub(super) struct Displaced {
    pub(super) configuration: Configuration,
    /// Part of the full play that guides have where their own does not count: less where levers magnify it.
    pub(super) part: f64,
    /// By how much the play, the misalignment and the deflections of guides that share their load are magnified;
    /// none without such guides.
    pub(super) magnification: Option<f64>,
}

impl ContactStates {
    /// Whether it is known how the contacts of a joint are displaced.
    pub(super) fn has_deflections(&self, slider: &Slider) -> bool {
        let state = |contact: &ContactId| self.contacts.get(contact.index());
        slider.contacts.iter().filter_map(state).any(|state| state.deflection.is_some())
    }

    /// By how much the block of such a joint is displaced against the line of its guide at a contact, towards +n
    /// (m): where the contact takes no part in sharing the load, it lies on its rigid face.
    pub(super) fn deflection(&self, mechanism: &Mechanism, contact: ContactId) -> f64 {
        let state = self.contacts.get(contact.index()).copied().unwrap_or_default();
        let play = mechanism.contacts[contact.index()].play;
        state.deflection.unwrap_or(-0.5 * play * state.side)
    }
}

impl Play<'_> {
    /// The full play at every contact whose own does not count, in drawing units.
    pub(super) fn gaps(&self) -> impl Iterator<Item = f64> {
        (0..self.mechanism.contacts.len()).map(|index| {
            let contact = ContactId(index);
            // Play across the drawing says nothing of a normal that leans out of it.
            if self.sharing(contact).is_some() || self.mechanism.contacts[index].lean.is_some() {
                return 0.0;
            }
            let joint = self.mechanism.contacts[index].joint;
            let look = self.looks[joint.index()];
            sliders::gap(self.mechanism, (joint, look), self.configuration, self.view)
        })
    }

    /// The joint of a contact, if it is drawn with its own play.
    fn sharing(&self, contact: ContactId) -> Option<&Slider> {
        let joint = self.mechanism.contacts[contact.index()].joint;
        let slider = self.mechanism.slider(joint).filter(|_| self.looks[joint.index()].has_play())?;
        self.states.has_deflections(slider).then_some(slider)
    }

    /// The configuration with play; none where the state is singular.
    pub(super) fn displaced(&self) -> Option<Displaced> {
        let greatest = self.greatest();
        [1.0, 0.7, 0.5, 0.3, 0.15, 0.05].into_iter().find_map(|part| {
            let magnification =
                greatest.map(|greatest| nice(part * SEEN / (self.view.scale * greatest), &Unit::default()));
            let wanted = self.displacements(part, magnification.unwrap_or(1.0));
            let configuration = self.configuration.displaced(self.mechanism, &wanted)?;
            let is_fine = self.is_near(&configuration) && self.fits(&configuration, &wanted);
            is_fine.then_some(Displaced { configuration, part, magnification })
        })
    }

    /// The greatest half play, misalignment or deflection of guides that share a load (m), if there are any.
    fn greatest(&self) -> Option<f64> {
        let contacts = (0..self.mechanism.contacts.len()).map(ContactId);
        contacts
            .filter(|contact| self.sharing(*contact).is_some())
            .map(|id| {
                let contact = &self.mechanism.contacts[id.index()];
                let deflection = self.states.deflection(self.mechanism, id);
                (0.5 * contact.play).max(contact.misalignment.abs()).max(deflection.abs())
            })
            .reduce(f64::max)
    }

    /// By how much each contact is displaced from the middle of its guide as the model has it (m).
    fn displacements(&self, part: f64, magnification: f64) -> Vec<f64> {
        let gaps = self.gaps().enumerate();
        gaps.map(|(index, gap)| {
            let contact = ContactId(index);
            if self.sharing(contact).is_none() {
                return -part * self.states.side(index) * gap / self.view.scale;
            }
            let misalignment = self.mechanism.contacts[index].misalignment;
            magnification * (misalignment + self.states.deflection(self.mechanism, contact))
        })
        .collect()
    }

    fn is_near(&self, moved: &Configuration) -> bool {
        moved.poses.iter().zip(&self.configuration.poses).all(|(new, old)| {
            (new.angle() - old.angle()).abs() < GREATEST_ROTATION
                && (new.position - old.position).norm() * self.view.scale < GREATEST_DISPLACEMENT
        })
    }

    /// Whether the blocks of all guides that share a load lie where they should: some of their contacts follow
    /// from the others.
    fn fits(&self, moved: &Configuration, wanted: &[f64]) -> bool {
        wanted.iter().enumerate().all(|(index, wanted)| {
            let contact = ContactId(index);
            self.sharing(contact).is_none_or(|slider| {
                let missed = self.displacement(moved, slider, contact) - wanted;
                missed.abs() * self.view.scale < MISSED
            })
        })
    }

    /// By how much a contact is displaced from the middle of its guide (m).
    fn displacement(&self, moved: &Configuration, slider: &Slider, contact: ContactId) -> f64 {
        let place = moved.contact(self.mechanism, contact).point;
        let across = |frame, point| {
            let middle = moved.position(self.mechanism, &Attachment::new(frame, slider.at));
            rot90(moved.direction(frame, slider.tangent)).dot(&(point - middle))
        };
        match self.mechanism.contacts[contact.index()].carried_by {
            CarriedBy::Block => across(slider.guide, place),
            CarriedBy::Guide => -across(slider.block, place),
        }
    }
}
