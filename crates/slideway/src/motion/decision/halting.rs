//! The impulse that stops a mechanism with friction in hinges that has no admissible acceleration, as [`jam`](super::jam())
//! does without.
//!
//! Some joint or hinge wedges: it stops within static friction, while the others go on sliding and turning with kinetic
//! friction, or stay at rest. If another velocity would reverse first, the impulse ends where that is zero. Where no single
//! one can wedge, all that moves wedges at once, within the static friction of each; in a mechanism of one degree of
//! freedom, in which everything stops together anyway, that is possible wherever some of it can wedge.

use super::BOUNDARY;
use super::hinged::{frictionless, setup};
use super::impulse::AT_REST;
use super::rules::{EventInstant, HaltingImpulse};
use crate::configuration::{Configuration, Velocity};
use crate::fault::Faults;
use crate::motion::moving::energy::kinetic;
use crate::motion::moving::equations::Equations;
use crate::pattern::phase::sliding_joints;
use crate::pattern::{HingePhase, JointPhase, Phase, direction};
use crate::standstill::{MotionState, motion_states, sticking_slack};
use nalgebra::Vector2;

/// The first impulse that can act; `None` if there is none.
///
/// # Errors
/// As for the phases that can follow.
pub(super) fn halting_impulse(event: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
    let EventInstant { mechanism, configuration, rounding, .. } = *event;
    let signs: Vec<f64> = event.signs.iter().chain(event.spins).copied().collect();
    let known: Vec<Option<f64>> = signs.iter().map(|sign| Some(*sign).filter(|sign| *sign != 0.0)).collect();
    let setup = setup(mechanism, configuration, (&known, rounding))?;
    let velocities = relative_velocities(event, configuration);
    let moving: Vec<usize> = (0..signs.len()).filter(|joint| signs[*joint] != 0.0).collect();
    let everything = (moving.len() > 1).then(|| moving.clone());
    for stopping in moving.iter().map(|joint| vec![*joint]).chain(everything) {
        let impulses = setup.impulsive(stopping.iter().map(|joint| (*joint, velocities[*joint])));
        let (found, _) = motion_states(&impulses)?;
        for state in found {
            let directions: Vec<[f64; 2]> = state.forces.iter().map(|force| direction(*force)).collect();
            let slack = sticking_slack(&impulses, &state.pattern, &directions);
            if slack.is_none_or(|slack| slack < -BOUNDARY) {
                continue;
            }
            if let Some(after) = stopped(event, (&signs, &velocities), &state) {
                let energy_lost = kinetic(mechanism, configuration) - kinetic(mechanism, &after);
                return Ok(Some(HaltingImpulse { velocities: after.velocities, energy_lost }));
            }
        }
    }
    Ok(None)
}

/// The velocities of the sliding joints, then of the hinges with friction (m/s, rad/s).
fn relative_velocities(event: &EventInstant<'_>, configuration: &Configuration) -> Vec<f64> {
    let mechanism = event.mechanism;
    let sliders = sliding_joints(mechanism).into_iter().filter_map(|joint| mechanism.slider(joint));
    let sliding = sliders.map(|slider| configuration.sliding(mechanism, slider).1);
    let turning = mechanism.friction_circles.iter().map(|circle| {
        mechanism.hinge(circle.joint).map_or(0.0, |[first, second]| {
            configuration.angular_velocity(first.frame) - configuration.angular_velocity(second.frame)
        })
    });
    sliding.chain(turning).collect()
}

/// The mechanism after as much of the jumps of a state as takes the first velocity to zero; `None` where something at rest
/// would begin to move against its friction.
fn stopped(
    event: &EventInstant<'_>,
    (signs, velocities): (&[f64], &[f64]),
    state: &MotionState,
) -> Option<Configuration> {
    let whole = jumped(event.configuration, &state.accelerations, 1.0);
    let pattern: Vec<JointPhase> =
        state.pattern.joints.iter().chain(&state.pattern.hinges).copied().collect();
    let reverses = |((before, after), phase): ((&f64, f64), &JointPhase)| {
        let (jump, sign) = (after - before, phase.sign());
        if sign * jump < 0.0 && sign * after < 0.0 { before.abs() / jump.abs() } else { f64::INFINITY }
    };
    let jumps = velocities.iter().zip(relative_velocities(event, &whole)).zip(&pattern);
    let zeros: Vec<f64> = jumps.map(reverses).collect();
    let part = zeros.iter().copied().fold(1.0, f64::min);
    let ends = |joint: usize| {
        let stays = pattern[joint] == JointPhase::Sticking && (part >= 1.0 || signs[joint] == 0.0);
        stays || zeros[joint] <= part
    };
    let at_rest: Vec<bool> = (0..pattern.len()).map(ends).collect();
    let after = jumped(event.configuration, &state.accelerations, part);
    signs.iter().any(|sign| *sign != 0.0).then(|| settled(event, after, state, &at_rest))
}

/// The configuration with exactly no velocity where there is none, of which the programs leave a rest within their
/// tolerance.
fn settled(
    event: &EventInstant<'_>,
    after: Configuration,
    state: &MotionState,
    at_rest: &[bool],
) -> Configuration {
    let smooth = frictionless(event.mechanism);
    let does = |rests: &bool| if *rests { JointPhase::Sticking } else { JointPhase::Sliding(1.0) };
    let (joints, hinges) = at_rest.split_at(state.pattern.joints.len());
    let phase = Phase {
        joints: joints.iter().map(does).collect(),
        contacts: state.pattern.contacts.clone(),
        hinges: hinges.iter().map(|rests| HingePhase { state: does(rests), force: [0.0; 2] }).collect(),
    };
    let mut equations = Equations::new(&smooth, &after);
    let mut values = equations.state_of(&after);
    if equations.enter(&phase, after.time, &values).is_err() {
        return after;
    }
    equations.project(&mut values);
    equations.place(after.time, &values);
    equations.configuration.clone()
}

/// The configuration with a part of the jumps of the velocities; what rounding leaves of one is zero.
fn jumped(configuration: &Configuration, jumps: &[f64], part: f64) -> Configuration {
    let mut after = configuration.clone();
    let sum = |velocity: f64, jump: f64| {
        let sum = velocity + part * jump;
        if sum.abs() <= AT_REST * velocity.abs() { 0.0 } else { sum }
    };
    for (Velocity { linear, angular }, jump) in after.velocities.iter_mut().zip(jumps.chunks_exact(3)) {
        *linear = Vector2::new(sum(linear.x, jump[0]), sum(linear.y, jump[1]));
        *angular = sum(*angular, jump[2]);
    }
    after
}
