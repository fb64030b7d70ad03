//! The state where an event says it is: joints that have stopped, joints at their stops, velocities after
//! impulses.

use super::Smooth;
use crate::configuration::Velocity;
use crate::ids::{ContactId, JointId};
use crate::pattern::phase::{ContactPhase, JointPhase, Phase};

/// Velocities are set to zero where that changes none by more than this multiple of the tolerance, ...
const SETTLED: f64 = 100.0;
/// ... which counts as at least this.
const LEAST_TOLERANCE: f64 = 1e-10;

impl Smooth<'_, '_> {
    /// Makes the velocities of sliding joints, then hinges, that have stopped exactly zero, as an impulse on their lines
    /// would; unless that changes their part of the mechanism more than errors of steps do: at a dead centre the joint
    /// stands while the mechanism moves on.
    pub(in crate::motion) fn settle(&mut self, phase: &Phase, stopped: &[bool]) {
        if !stopped.contains(&true) {
            return;
        }
        let mut held = phase.clone();
        let hinges = held.hinges.iter_mut().map(|hinge| &mut hinge.state);
        for (joint, stopped) in held.joints.iter_mut().chain(hinges).zip(stopped) {
            if *stopped {
                *joint = JointPhase::Sticking;
            }
        }
        if self.equations.enter(&held, self.time, &self.state).is_err() {
            return;
        }
        let mut settled = self.state.clone();
        self.equations.project(&mut settled);
        let size = self.equations.mechanism.size;
        let count = self.equations.mechanism.bodies.len();
        let permitted = SETTLED * self.tolerance.max(LEAST_TOLERANCE);
        let magnitudes = &self.watch.magnitudes;
        let changes_more = |body: &usize| {
            let change = |axis: usize| {
                let place = 3 * (count + body) + axis;
                (settled[place] - self.state[place]).abs() * [1.0, 1.0, size][axis]
            };
            let limit = permitted * magnitudes.of_body(*body).velocity;
            [0, 1, 2].into_iter().any(|axis| change(axis) > limit)
        };
        let parts = magnitudes.parts();
        let kept: Vec<usize> = (0..count).filter(changes_more).map(|body| parts[body]).collect();
        for body in (0..count).filter(|body| !kept.contains(&parts[*body])) {
            for first in [3 * body, 3 * (count + body)] {
                self.state[first..first + 3].copy_from_slice(&settled[first..first + 3]);
            }
        }
        self.equations.place(self.time, &self.state);
        let sliders = self.equations.sliders.iter().zip(stopped);
        let stops = |joint: JointId| sliders.clone().any(|(slider, stopped)| *slider == joint && *stopped);
        self.switching.settle(&self.equations.configuration, &stops);
        self.equations.hold(&self.switching);
    }

    /// Brings a joint exactly to a displacement at which an event has found it, within errors of steps, as
    /// reactions would.
    pub(in crate::motion) fn put_at(&mut self, phase: &Phase, joint: JointId, displacement: f64) {
        let mut held = phase.clone();
        let sliders = self.equations.sliders.iter().zip(&mut held.joints);
        sliders.filter(|(id, _)| **id == joint).for_each(|(_, state)| *state = JointPhase::Sticking);
        if self.equations.enter(&held, self.time, &self.state).is_ok() {
            self.equations.hold_at(joint, displacement);
            self.put_in_place();
        }
    }

    /// Brings contacts that have reached their faces exactly there, within errors of steps, as reactions would.
    pub(in crate::motion) fn put_on_face(&mut self, phase: &Phase, contacts: &[ContactId]) {
        let mut closed = phase.clone();
        contacts.iter().for_each(|contact| closed.contacts[contact.index()] = ContactPhase::CLOSED[0]);
        if self.equations.enter(&closed, self.time, &self.state).is_ok() {
            self.put_in_place();
        }
    }

    /// Moves the bodies to where the equations hold.
    fn put_in_place(&mut self) {
        let mut moved = self.state.clone();
        self.equations.project(&mut moved);
        let places = 3 * self.equations.mechanism.bodies.len();
        self.state[..places].copy_from_slice(&moved[..places]);
    }

    /// Velocities after an impulse.
    pub(in crate::motion) fn set_velocities(&mut self, velocities: &[Velocity]) {
        let bodies = 3 * velocities.len();
        let rates = velocities.iter().flat_map(|v| [v.linear.x, v.linear.y, v.angular]);
        self.state[bodies..2 * bodies].iter_mut().zip(rates).for_each(|(value, rate)| *value = rate);
        self.equations.place(self.time, &self.state);
        self.switching.jump(&self.equations.configuration);
        self.equations.hold(&self.switching);
    }
}
