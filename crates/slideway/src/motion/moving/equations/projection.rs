//! How far a state is from the joints, and back.

use super::{Drift, Equations, Sticks};
use crate::ids::{ContactId, Frame};
use crate::kinetics::Reaction;
use crate::mechanism::{Attachment, JointKind};

impl Equations<'_> {
    /// Brings a state back on the joints, with the factors of the last evaluation, which was there: the
    /// corrections are those that reactions of the phase would cause. Returns how far it was away.
    pub(in crate::motion) fn project(&mut self, state: &mut [f64]) -> Drift {
        let bodies = 3 * self.mechanism.bodies.len();
        let mut drift = Drift::default();
        self.work.fill(0.0);
        for index in 0..self.row_ends.len() {
            let (gap, scale) = self.gap(index);
            drift.position = drift.position.max(gap.abs() / scale);
            let row = self.row_place(index);
            self.work[row] = -gap;
        }
        self.system.solve(&mut self.work);
        state[..bodies].iter_mut().zip(&self.work).for_each(|(value, correction)| *value += correction);
        self.work.fill(0.0);
        for index in 0..self.row_ends.len() {
            let from = if index == 0 { 0 } else { self.row_ends[index - 1] };
            let entries = &self.rows[from..self.row_ends[index]];
            let in_plane = entries.iter().filter(|(column, _)| *column < bodies);
            let rate: f64 = in_plane.map(|&(column, value)| value * state[bodies + column]).sum();
            drift.velocity = drift.velocity.max(rate.abs() / self.gap_scale(index));
            let row = self.row_place(index);
            self.work[row] = -rate;
        }
        self.system.solve(&mut self.work);
        state[bodies..2 * bodies].iter_mut().zip(&self.work).for_each(|(value, change)| *value += change);
        drift
    }

    fn row_place(&self, index: usize) -> usize {
        let reactions = self.layout.reactions().len();
        if index < reactions {
            self.layout.accelerations() + index
        } else {
            self.layout.len() + index - reactions
        }
    }

    fn gap_scale(&self, index: usize) -> f64 {
        let is_angle = match self.layout.reactions().get(index) {
            Some(reaction) => matches!(reaction, Reaction::Couple(_)),
            None => {
                matches!(self.stuck[index - self.layout.reactions().len()].what, Sticks::Hinge(_))
            }
        };
        if is_angle { 1.0 } else { self.mechanism.size }
    }

    /// By how much a scalar constraint is violated (m or rad), and the scale of that.
    fn gap(&self, index: usize) -> (f64, f64) {
        let (mechanism, configuration) = (self.mechanism, &self.configuration);
        let gap = match self.layout.reactions().get(index) {
            Some(Reaction::Hinge(joint, axis)) => match &mechanism.joints[joint.index()].kind {
                JointKind::Hinge(ends) => {
                    let [first, second] = ends.each_ref().map(|end| configuration.position(mechanism, end));
                    (first - second)[*axis]
                }
                JointKind::Slider(_) => 0.0,
            },
            Some(Reaction::Normal(contact)) => self.normal_gap(*contact),
            Some(Reaction::Couple(joint)) => mechanism
                .slider(*joint)
                .map_or(0.0, |slider| configuration.angle(slider.block) - configuration.angle(slider.guide)),
            // All places out of the plane stay as they are.
            Some(Reaction::Carried(..)) => 0.0,
            None => self.off_place(&self.stuck[index - self.layout.reactions().len()]),
        };
        (gap, self.gap_scale(index))
    }

    /// Distance of the block's line from that of the guide at a contact, along n.
    fn normal_gap(&self, contact: ContactId) -> f64 {
        let (mechanism, configuration) = (self.mechanism, &self.configuration);
        if mechanism.contacts[contact.index()].opens {
            return if self.is_open(contact.index()) {
                0.0
            } else {
                configuration.gap(mechanism, contact)[0]
            };
        }
        let joint = mechanism.contacts[contact.index()].joint;
        let Some(slider) = mechanism.slider(joint) else { return 0.0 };
        let geometry = &self.contacts[contact.index()];
        let middle = |frame: Frame| {
            let attachment = Attachment { frame, position: slider.at, z: slider.z };
            configuration.position(mechanism, &attachment)
        };
        let block = middle(slider.block);
        let at_middle = geometry.normal.dot(&(block - middle(slider.guide)));
        if slider.contacts.len() < 2 {
            return at_middle;
        }
        let turn = configuration.angle(slider.block) - configuration.angle(slider.guide);
        let cos = geometry.lean.map_or(1.0, |[cos, _]| cos);
        at_middle + geometry.tangent.dot(&(geometry.point - block)) * turn * cos
    }
}
