//! The impulse that stops a mechanism with friction in hinges that has no admissible acceleration, as [`jam`](super::jam())
//! does without.
//!
//! Some joint or hinge wedges: it stops within static friction, while the others go on sliding and turning with kinetic
//! friction, or stay at rest. If another velocity would reverse first, the impulse ends where that is zero. Where no single
//! one can wedge, all that moves wedges at once, within the static friction of each; in a mechanism of one degree of
//! freedom, in which everything stops together anyway, that is possible wherever some of it can wedge.

use super::BOUNDARY;
use super::hinged::{frictionless, relative_velocities, setup};
use super::impulse::jumped;
use super::rules::{EventInstant, HaltingImpulse};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::motion::moving::energy::kinetic;
use crate::motion::moving::equations::Equations;
use crate::pattern::{HingePhase, JointPhase, Phase, direction};
use crate::standstill::{KnownMotion, MotionState, motion_states, whole_slack};

/// The first impulse that can act; `None` if there is none.
///
/// # Errors
/// As for the phases that can follow.
pub(super) fn halting_impulse(event: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
    let EventInstant { mechanism, configuration, .. } = *event;
    let signs: Vec<f64> = event.signs.iter().chain(event.spins).copied().collect();
    let setup = setup(mechanism, configuration, (&event.known_signs(), event.greatest_rounding()))?;
    let velocities = relative_velocities(mechanism, configuration);
    let moving: Vec<usize> = (0..signs.len()).filter(|joint| signs[*joint] != 0.0).collect();
    let everything = (moving.len() > 1).then(|| moving.clone());
    for stopping in moving.iter().map(|joint| vec![*joint]).chain(everything) {
        let mut jumps = setup.signs();
        for &joint in &stopping {
            jumps[joint] = KnownMotion { sign: Some(0.0), acceleration: velocities[joint], pushed: false };
        }
        let impulses = setup.impulsive(jumps);
        let (found, _) = motion_states(&impulses, event.work)?;
        for state in found {
            let directions: Vec<[f64; 2]> = state.forces.iter().map(|force| direction(*force)).collect();
            let slack = whole_slack(&impulses, &state.pattern, &directions);
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
    let jumps = velocities.iter().zip(relative_velocities(event.mechanism, &whole)).zip(&pattern);
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
