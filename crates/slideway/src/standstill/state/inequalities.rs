//! The inequalities of a state: friction within its limits, contacts at their sides, hinges within their friction circles,
//! and motions that begin as the pattern says.

use super::State;
use crate::ids::ContactId;
use crate::mechanism::FrictionCircle;
use crate::pattern::{AffineExpression, ContactPhase, JointPhase, Pin, Region, without_tipping};
use crate::standstill::setup::{Setup, SlidingJoint};

/// Static friction of contacts and hinges.
pub(in crate::standstill) struct StaticFriction {
    /// Coefficients of each contact and side.
    pub(in crate::standstill) mu: Vec<[f64; 2]>,
    /// Radii of the friction circles (m).
    pub(in crate::standstill) radii: Vec<f64>,
}

/// Inequalities of a state.
impl State<'_> {
    /// What the equations leave open within every inequality of the state, with this static friction.
    pub(in crate::standstill) fn region(&self, static_friction: &StaticFriction) -> Region<'static> {
        let all = (0..self.setup.sliders.len()).flat_map(|slider| self.bounds_of(slider, static_friction));
        let slacks = all.chain(self.beginning());
        let slacks = slacks.map(|slack| self.function(&slack)).collect();
        Region::new(self.solutions.dimension(), slacks).with_pins(self.pins(&static_friction.radii))
    }

    /// The inequalities of the contacts of a sliding joint, and of its couple.
    fn bounds_of(&self, slider: usize, static_friction: &StaticFriction) -> Vec<AffineExpression> {
        let SlidingJoint { contacts, couple, .. } = &self.setup.sliders[slider];
        let mut slacks = Vec::new();
        for &k in contacts {
            let bounds = self.friction[k].bounds(static_friction.mu[k], None);
            slacks.extend(bounds.into_iter().map(|(_, slack)| slack));
            let place = self.between[k].filter(|place| self.friction[k].share != Some(*place));
            if let Some(place) = place {
                slacks.push(AffineExpression::unknown(place, 1.0));
                if self.setup.mechanism.contacts[k].face.is_none() {
                    slacks.push(AffineExpression::unknown(place, -1.0).shifted(1.0));
                }
            }
        }
        if let (Some(couple), [k]) = (couple, &contacts[..]) {
            let half = couple.half_length / self.setup.units.length;
            slacks.extend(without_tipping(&self.friction[*k].pressure, &self.reaction(couple.unknown), half));
        }
        slacks
    }

    /// The accelerations of the sliding joints and hinges that begin to move, in the direction in which they do, and those of
    /// the gaps of the contacts that lift off.
    pub(in crate::standstill) fn beginning(&self) -> Vec<AffineExpression> {
        let sliders = self.pattern.joints.iter().enumerate();
        let sliders = sliders.map(|(index, joint)| (*joint, self.sliding_acceleration(index)));
        let hinges = self.pattern.hinges.iter().enumerate();
        let hinges = hinges.map(|(index, hinge)| (*hinge, self.turning_acceleration(index)));
        let moving = sliders.chain(hinges).filter(|(joint, _)| *joint != JointPhase::Sticking);
        let moving = moving.map(|(joint, acceleration)| acceleration.times(joint.sign()));
        moving.chain(self.open().map(|k| self.gap_acceleration(k))).collect()
    }

    /// The hinges with friction: those that stick within their static circles, those that turn on their kinetic ones unless
    /// equations say so.
    fn pins(&self, static_radii: &[f64]) -> Vec<Pin> {
        let circles = self.setup.mechanism.friction_circles.iter().zip(static_radii).enumerate();
        let pin = |(index, (circle, static_radius)): (usize, (&FrictionCircle, &f64))| {
            let (turning, radius) = match self.pattern.hinges[index] {
                JointPhase::Sticking => (None, *static_radius),
                JointPhase::Sliding(sign) => (Some(sign), circle.radius),
            };
            let reaction = [0, 1].map(|axis| self.function(&self.reaction(self.setup.force_of(index, axis))));
            Pin {
                reaction,
                couple: self.function(&self.friction_couple(index)),
                radius: radius / self.setup.lever(index),
                turning,
                allowance: 0.0,
            }
        };
        let sticks = |hinge: usize| self.pattern.hinges[hinge] == JointPhase::Sticking;
        circles.filter(|(hinge, _)| self.directions.is_none() || sticks(*hinge)).map(pin).collect()
    }
}

/// All combinations of sides of the contacts, of which these lift off.
pub(in crate::standstill) fn sides(setup: &Setup, open: &[usize]) -> Vec<Vec<ContactPhase>> {
    let mut all = vec![Vec::new()];
    for (k, options) in side_options(setup).into_iter().enumerate() {
        let options = if open.contains(&k) { &[ContactPhase::PreloadGap] } else { options };
        let extended = |sides: Vec<ContactPhase>| {
            options.iter().map(move |side| sides.iter().copied().chain([*side]).collect::<Vec<_>>())
        };
        all = all.into_iter().flat_map(extended).collect();
    }
    all
}

/// The sides that each contact may take. One that may lift off is closed unless it does: without a force it just touches.
pub(in crate::standstill) fn side_options(setup: &Setup) -> Vec<&'static [ContactPhase]> {
    let may_be_open = |k: usize| setup.shared.as_ref().is_some_and(|shared| shared.may_be_open(k));
    let contacts = 0..setup.mechanism.contacts.len();
    contacts
        .map(|k| match setup.mechanism.contacts[k].face {
            _ if setup.mechanism.contacts[k].opens => ContactPhase::CLOSED,
            Some(face) => ContactPhase::options_of_face(face.is_positive),
            None => ContactPhase::options(setup.mechanism.preload_jumps(ContactId(k)) || may_be_open(k)),
        })
        .collect()
}
