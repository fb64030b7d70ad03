//! What a phase makes of the equations: friction of every contact, rows of the joints that stick.

use super::{Equations, Rubbing, Sticks, Stuck};
use crate::ids::{Frame, JointId};
use crate::kinetics::{ConstraintRow, Reaction};
use crate::mechanism::{CoordinateKind, Mechanism, Slider};
use crate::pattern::{ContactPhase, JointPhase, Law, Phase};

/// A sticking joint whose row is, but for this part of it, a combination of the others is held by them
/// already.
const DEPENDENT: f64 = 1e-7;

impl Equations<'_> {
    pub(super) fn choose_friction(&mut self, phase: &Phase) {
        self.choose_turning(phase);
        for (index, joint) in self.sliders.iter().enumerate() {
            let slider = self.mechanism.slider(*joint).expect("sliding joints slide");
            for contact in &slider.contacts {
                let k = contact.index();
                let law = Law::new(self.mechanism, (k, &self.mechanism.contacts[k]), (1.0, true), [false; 2]);
                self.rubbing[k] = match (phase.joints[index], phase.contacts[k]) {
                    _ if phase.is_open(self.mechanism, k) => Rubbing::Open,
                    (JointPhase::Sticking, _) => Rubbing::Sticking,
                    (JointPhase::Sliding(sign), ContactPhase::Pressed(side)) => {
                        Rubbing::Pressed { side, sign, faces: law.kinetic(side, sign) }
                    }
                    (JointPhase::Sliding(sign), ContactPhase::PreloadGap) => {
                        let couple = self.layout.reaction(Reaction::Couple(*joint));
                        let couple = couple.filter(|_| self.mechanism.preload_changes_face(*contact));
                        let share = couple.unwrap_or(self.normal[k]);
                        Rubbing::Gap { faces: law.in_gap(sign), share }
                    }
                };
            }
        }
    }

    /// The sticking joints whose rows say something that neither the joints nor the drives nor those before
    /// say.
    pub(super) fn choose_stuck(&mut self, phase: &Phase) {
        self.stuck.clear();
        let (mechanism, size) = (self.mechanism, self.mechanism.size);
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let accelerations = mechanism.accelerations();
        // What is left of a row, of unit length, beside the rows so far; the angles are counted in sizes.
        let mut is_new = |row: &ConstraintRow| {
            let mut left = vec![0.0; accelerations];
            for &(column, value) in &row.entries {
                left[column] += if mechanism.is_rotation(column) { value / size } else { value };
            }
            let length = norm(&left);
            for _ in 0..2 {
                for known in &basis {
                    let along: f64 = known.iter().zip(&left).map(|(a, b)| a * b).sum();
                    left.iter_mut().zip(known).for_each(|(value, known)| *value -= along * known);
                }
            }
            let rest = norm(&left);
            let new = rest > DEPENDENT * length;
            if new {
                for value in &mut left {
                    *value /= rest;
                }
                basis.push(left);
            }
            new
        };
        for reaction in self.layout.reactions() {
            if self.is_without(*reaction) {
                continue;
            }
            self.row.set_constraint(mechanism, &self.configuration, &self.contacts, *reaction);
            is_new(&self.row);
        }
        for drive in &mechanism.drives {
            let kind = mechanism.coordinates[drive.coordinate.index()].kind;
            self.row.set_coordinate(mechanism, &self.configuration, kind);
            is_new(&self.row);
        }
        for what in self.sticking(phase) {
            if self.set_stuck_row(what) && is_new(&self.row) {
                self.stuck.push(Stuck { what, place: self.place_of(what) });
            }
        }
    }

    /// Returns whether a reaction is that of a contact that is open.
    pub(super) fn is_without(&self, reaction: Reaction) -> bool {
        matches!(reaction, Reaction::Normal(contact) if self.is_open(contact.index()))
    }

    /// The sliding joints that stick in a phase, then the hinges with friction that do.
    fn sticking(&self, phase: &Phase) -> Vec<Sticks> {
        let sliders = self.sliders.iter().zip(&phase.joints);
        let touches = |joint: JointId| {
            let slider = self.mechanism.slider(joint);
            slider.is_some_and(|slider| slider.contacts.iter().any(|contact| !self.is_open(contact.index())))
        };
        let sliders = sliders.filter(|(joint, state)| **state == JointPhase::Sticking && touches(**joint));
        let hinges = phase.hinges.iter().enumerate();
        let hinges = hinges.filter(|(_, hinge)| hinge.state == JointPhase::Sticking);
        let sliders = sliders.map(|(joint, _)| Sticks::Slider(*joint));
        sliders.chain(hinges.map(|(index, _)| Sticks::Hinge(index))).collect()
    }

    /// Writes the row of what does not move where something sticks; `false` if there is none.
    pub(super) fn set_stuck_row(&mut self, what: Sticks) -> bool {
        let touching = self.touching.as_deref().unwrap_or(self.mechanism);
        if let Some(disc) = disc(touching, what) {
            self.row.set_sliding(touching, &self.configuration, disc);
            return true;
        }
        let Some(kind) = self.kind_of(what) else { return false };
        self.row.set_coordinate(touching, &self.configuration, kind);
        true
    }

    /// Returns how far what sticks is from its place (m or rad); of discs, up to whole turns.
    pub(super) fn off_place(&self, stuck: &Stuck) -> f64 {
        let Some(disc) = disc(self.touching(), stuck.what) else {
            return self.place_of(stuck.what) - stuck.place;
        };
        let (place, turn) = self.configuration.slipped(self.touching(), disc);
        let off = place - stuck.place;
        turn.map_or(off, |turn| off - turn * (off / turn).round())
    }

    /// The coordinate that is held where something sticks, if it is not a disc.
    pub(super) fn kind_of(&self, what: Sticks) -> Option<CoordinateKind> {
        match what {
            Sticks::Slider(joint) => Some(CoordinateKind::Slide(joint)),
            Sticks::Hinge(hinge) => self.rotation_of(hinge).map(|(kind, _)| kind),
        }
    }

    /// The value of that coordinate (m or rad).
    pub(super) fn place_of(&self, what: Sticks) -> f64 {
        if let Some(disc) = disc(self.touching(), what) {
            return self.configuration.slipped(self.touching(), disc).0;
        }
        match self.kind_of(what) {
            Some(CoordinateKind::Slide(joint)) => {
                let slider = self.touching().slider(joint).expect("sliding joints slide");
                self.configuration.sliding(self.touching(), slider).0
            }
            Some(CoordinateKind::Rotation(body, against)) => {
                self.configuration.angle(Frame::Body(body)) - self.configuration.angle(against)
            }
            Some(CoordinateKind::Displacement(..)) | None => 0.0,
        }
    }
}

impl Equations<'_> {
    /// Sets where a joint that sticks by an equation of its own does so (m).
    pub(in crate::motion) fn hold_at(&mut self, joint: JointId, displacement: f64) {
        let stuck = self.stuck.iter_mut().filter(|stuck| stuck.what == Sticks::Slider(joint));
        stuck.for_each(|stuck| stuck.place = displacement);
    }
}

/// The disc that sticks, if it is one.
fn disc(mechanism: &Mechanism, what: Sticks) -> Option<&Slider> {
    let Sticks::Slider(joint) = what else { return None };
    mechanism.slider(joint).filter(|slider| slider.is_disc())
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|value| value * value).sum::<f64>().sqrt()
}
