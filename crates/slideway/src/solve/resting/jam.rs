//! The impulse that acts where a mechanism jams with contacts that may lift off (theory, section 12): velocities jump without a
//! collision, until what wedges has stopped.
//!
//! Loads do not count. With velocities `v` in place of accelerations and impulses in place of forces, contacts that may lift off
//! have the states of contacts at rest: each joint of them sticks, slips one way or the other, or opens, afterwards,
//!
//! ```text
//! M (v^+ - v) = impulses        |T| <= mu_static N,  v_t^+ = 0      T = mu N s,  s v_t^+ >= 0      N = T = 0,  g'^+ >= 0
//! ```
//!
//! while what else slides goes on in its sense. All patterns with something that sticks are tried, as without any the only
//! impulse is none.

use super::patterns::{System, lighter_mass};
use super::{Resting, RestingJoint, Start, joints_of};
use crate::configuration::{Configuration, unit};
use crate::ids::{ContactId, JointId};
use crate::kinetics::{KineticEquations, SlidingRow};
use crate::mechanism::{Mechanism, Slider};
use crate::report::{ContactImpulse, CoordinateState, JamImpulse};
use crate::solve::answer::Answer;
use crate::solve::stages::Stages;
use nalgebra::{DVector, Vector2};

/// More patterns of states are not tried.
const MOST_PATTERNS: u64 = 1 << 12;

/// All impulses that can act at a jam, if contacts that may lift off slide and none is at rest; none as well where guides share a
/// load or could tip, and where it is not known of all patterns of states that they have none.
pub(in crate::solve) fn impulses(stages: &Stages, equations: &KineticEquations) -> Option<Vec<JamImpulse>> {
    let Stages { mechanism, standing, .. } = stages;
    let opens: Vec<ContactId> = mechanism.one_sided().collect();
    if opens.is_empty() || !standing.is_empty() || !mechanism.excess.is_empty() {
        return None;
    }
    let mut stages = stages.clone();
    stages.influence.frictionless.fill(0.0);
    stages.mechanism.contacts.iter_mut().for_each(|contact| contact.preload = [0.0; 2]);
    opens.iter().for_each(|contact| stages.velocity_signs[contact.index()] = 0.0);
    let velocity = |contact: ContactId| stages.configuration.contact(mechanism, contact).sliding_velocity;
    let joints = joints_of(&stages, &opens, |_, contact| velocity(contact));
    let greatest = |joint: &RestingJoint| joint.before.abs() * lighter_mass(mechanism, joint.joint);
    let impulse = joints.iter().map(greatest).fold(0.0, f64::max);
    if impulse == 0.0 {
        return None;
    }
    let others = others(&stages);
    let answer = Answer::determinate(&stages, equations);
    if answer.guided_sliders().next().is_some() {
        return None;
    }
    Jam { resting: Resting::new(&answer, joints, impulse), others }.impulses()
}

/// The velocities of the other sliding joints with friction, each with its row and its sign.
fn others(stages: &Stages) -> Vec<(SlidingRow, f64)> {
    let Stages { mechanism, configuration, velocity_signs, .. } = stages;
    let of_joint = |(_, slider): (JointId, &Slider)| {
        let first = *slider.contacts.first()?;
        let sign = velocity_signs[first.index()];
        let velocity = configuration.contact(mechanism, first).sliding_velocity;
        let rubs = slider.contacts.iter().any(|contact| mechanism.contacts[contact.index()].may_hold());
        (sign != 0.0 && rubs).then(|| (SlidingRow::new(mechanism, configuration, slider), velocity))
    };
    mechanism.sliders().filter_map(of_joint).collect()
}

/// The impulse of a pattern is not known.
struct NotTried;

struct Jam<'a> {
    /// With velocities in place of accelerations, and impulses in place of forces.
    resting: Resting<'a>,
    others: Vec<(SlidingRow, f64)>,
}

impl Jam<'_> {
    /// The impulses of all patterns; none if there are too many, or if there is no impulse and some patterns are not tried.
    fn impulses(&self) -> Option<Vec<JamImpulse>> {
        let patterns = self.resting.patterns(MOST_PATTERNS).ok()?;
        let sticks = |start: &Option<Start>| *start == Some(Start::Sticks);
        let wedged = patterns.into_iter().filter(|pattern| pattern.starts.iter().any(sticks));
        let systems = wedged.map(|pattern| self.resting.system(pattern, self.resting.answer.mechanism));
        let (mut found, mut are_all_tried) = (Vec::new(), true);
        for system in systems {
            match self.impulse(&system) {
                Ok(impulse) => found.extend(impulse),
                Err(NotTried) => are_all_tried = false,
            }
        }
        (are_all_tried || !found.is_empty()).then_some(found)
    }

    /// The impulse of a pattern, if all of its inequalities hold.
    ///
    /// # Errors
    /// Its equations leave impulses open, or something else that rubs would reverse.
    fn impulse(&self, system: &System) -> Result<Option<JamImpulse>, NotTried> {
        let resting = &self.resting;
        let Answer { mechanism, configuration, influence, .. } = *resting.answer;
        let Some(set) = resting.equations(system) else { return Ok(None) };
        if set.dimension() > 0 {
            return Err(NotTried);
        }
        let unknowns = set.particular() * resting.force;
        if resting.least_slack(&unknowns, &resting.slacks(system, &set)).is_none() {
            return Ok(None);
        }
        let point = resting.point(system, &unknowns);
        let frictions = resting.answer.friction(&point.state());
        let jumps = influence.unknowns(&frictions, &point.normal_force);
        let goes_on = |(row, velocity): &(SlidingRow, f64)| (velocity + row.change(&jumps)) * velocity >= 0.0;
        if !self.others.iter().all(goes_on) {
            return Err(NotTried);
        }
        let force =
            |k: usize, force: f64| if resting.is_open(&system.pattern, k) { 0.0 } else { force + 0.0 };
        let contact = |(k, contact): (usize, &crate::mechanism::Contact)| ContactImpulse {
            name: contact.name.to_string(),
            normal_impulse: force(k, point.normal_force[k]),
            friction_impulse: force(k, frictions[k].total()),
        };
        let rates = configuration.rates.iter().zip(resting.answer.equations.coordinate_jumps(&jumps));
        let coordinates = mechanism.coordinates.iter().zip(&configuration.coordinates).zip(rates);
        Ok(Some(JamImpulse {
            joints: resting.words(&point),
            contacts: mechanism.contacts.iter().enumerate().map(contact).collect(),
            coordinates: coordinates
                .map(|((coordinate, value), (rate, jump))| CoordinateState {
                    name: coordinate.name.to_string(),
                    unit: unit(&coordinate.kind),
                    value: *value,
                    rate: rate + jump,
                })
                .collect(),
            energy_lost: energy_lost(mechanism, configuration, &jumps),
        }))
    }
}

/// The kinetic energy that a jump of the velocities of all bodies takes (J): `-sum (v + dv/2).(M dv)`.
fn energy_lost(mechanism: &Mechanism, configuration: &Configuration, jumps: &DVector<f64>) -> f64 {
    let of_body = |(index, body): (usize, &crate::mechanism::Body)| {
        let velocity = configuration.velocities[index];
        let jump = Vector2::new(jumps[3 * index], jumps[3 * index + 1]);
        let turn = jumps[3 * index + 2];
        body.mass * jump.dot(&(velocity.linear + jump / 2.0))
            + body.moment_of_inertia * turn * (velocity.angular + turn / 2.0)
    };
    -mechanism.bodies.iter().enumerate().map(of_body).sum::<f64>()
}
