//! The impulses of an impact with friction in hinges: the block mode problem of impulses, in which the jumps of the joints that
//! are pushed have rows of their own, whose multipliers are the impulses of their stops.

use super::{AfterImpact, Blow, Change, Collision, Impact, Pushed, hits, outcome};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::motion::decision::BOUNDARY;
use crate::motion::decision::halting::halting_impulse;
use crate::motion::decision::hinged::{SAME, near, relative_velocities, setup};
use crate::motion::decision::impulse::{AT_REST, jumped};
use crate::motion::decision::rules::EventInstant;
use crate::motion::moving::energy::kinetic;
use crate::pattern::phase::sliding_joints;
use crate::pattern::{JointPhase, direction};
use crate::progress::Work;
use crate::standstill::{KnownMotion, MotionState, Setup, motion_states, whole_slack};
use nalgebra::DVector;

/// The impact of joints; all joints and hinges count as acting on one another.
///
/// # Errors
/// As [`impact`](super::impact).
pub(super) fn impact(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stops: &[(JointId, f64)],
) -> Result<Impact, Faults> {
    let velocities = velocities_in_sizes(mechanism, configuration);
    let hits = hits(stops, &sliding_joints(mechanism), &velocities);
    let mut found = Impact { after: configuration.clone(), blows: Vec::new() };
    if hits.is_empty() {
        return Ok(found);
    }
    let signs: Vec<Option<f64>> =
        velocities.iter().map(|velocity| Some(sign_of(*velocity)).filter(|sign| *sign != 0.0)).collect();
    let setup = setup(mechanism, configuration, (&signs, 0.0))?;
    let size = 3 * mechanism.bodies.len();
    let collision = Collision::new(mechanism, &hits, &velocities, size);
    let course = outcome(collision, |collision, unsolved| {
        collision.outcome(&Hinged { setup: touching(&setup, collision), configuration, collision }, unsolved)
    })?;
    found.after = jumped(configuration, course.jumps.as_slice(), 1.0);
    found.after.measure(mechanism);
    let energy_lost = kinetic(mechanism, configuration) - kinetic(mechanism, &found.after);
    let stops = hits.iter().map(|hit| hit.id).zip(course.impulses).collect();
    found.blows.push(Blow { stops, energy_lost });
    Ok(found)
}

/// The velocities of the sliding joints (m/s), then of the hinges with friction, in sizes of the mechanism; exactly zero where
/// they are only rounding.
fn velocities_in_sizes(mechanism: &Mechanism, configuration: &Configuration) -> Vec<f64> {
    let sliders = sliding_joints(mechanism).len();
    let velocities = relative_velocities(mechanism, configuration).into_iter().enumerate();
    let in_sizes = |(joint, velocity)| if joint < sliders { velocity } else { velocity * mechanism.size };
    let velocities: Vec<f64> = velocities.map(in_sizes).collect();
    let greatest = velocities.iter().fold(0.0_f64, |greatest, velocity| greatest.max(velocity.abs()));
    let without_rounding = |velocity: f64| if velocity.abs() <= AT_REST * greatest { 0.0 } else { velocity };
    velocities.into_iter().map(without_rounding).collect()
}

/// 1, -1, or 0 where there is none.
fn sign_of(velocity: f64) -> f64 {
    if velocity == 0.0 { 0.0 } else { velocity.signum() }
}

/// The instant at which those of the joints whose stops push touch them.
fn touching(setup: &Setup, collision: &Collision<'_>) -> Setup {
    let mut touching = setup.clone();
    for (hit, pushes) in collision.hits.iter().zip(&collision.pushes) {
        touching.stops[hit.joint] = if *pushes { collision.velocities[hit.joint].signum() } else { 0.0 };
    }
    collision.upright.iter().for_each(|joint| touching.sliders[*joint].couple = None);
    touching
}

struct Hinged<'c> {
    setup: Setup,
    /// The mechanism before the impact.
    configuration: &'c Configuration,
    collision: &'c Collision<'c>,
}

impl Pushed for Hinged<'_> {
    fn rubs(&self, joint: usize) -> bool {
        joint >= self.setup.sliders.len() || self.setup.stops[joint] != 0.0 || self.setup.rubs(joint)
    }

    fn change(
        &self,
        velocities: &[f64],
        targets: &[(usize, f64)],
        unsolved: &mut usize,
    ) -> Result<Option<Change>, Faults> {
        let known = (0..velocities.len()).map(|joint| self.known(joint, velocities[joint], targets));
        let impulses = self.setup.impulsive(known.collect());
        let (states, undecided) = motion_states(&impulses, Work::undisturbed())?;
        *unsolved += undecided;
        let stays = |state: &MotionState| {
            let joints = state.pattern.joints.iter().chain(&state.pattern.hinges);
            joints.filter(|joint| **joint == JointPhase::Sticking).count()
        };
        let admissible = states.iter().filter(|state| is_admissible(&impulses, state));
        let changes = admissible.map(|state| (stays(state), self.change_of(state, targets)));
        let mut changes: Vec<(usize, Change)> =
            changes.filter(|(_, change)| self.reaches(change, velocities, targets)).collect();
        let most = changes.iter().map(|(stays, _)| *stays).max();
        changes.retain(|(stays, _)| Some(*stays) == most);
        let differs = |other: &(usize, Change)| !changes[0].1.is_near(&other.1);
        if changes.iter().any(differs) {
            return Err(self.collision.several());
        }
        Ok(changes.into_iter().next().map(|(_, change)| change))
    }

    fn wedged(&self, course: &AfterImpact) -> Result<Option<Change>, Faults> {
        let mechanism = self.collision.mechanism;
        let before = jumped(self.configuration, course.jumps.as_slice(), 1.0);
        let signs: Vec<f64> = course.velocities.iter().map(|velocity| sign_of(*velocity)).collect();
        let (signs, spins) = signs.split_at(self.setup.sliders.len());
        let event = EventInstant { spins, ..EventInstant::new((mechanism, &before), signs, None) };
        let Some(impulse) = halting_impulse(&event)? else { return Ok(None) };
        let components = |configuration: &Configuration| -> Vec<f64> {
            configuration.velocities.iter().flat_map(|v| [v.linear.x, v.linear.y, v.angular]).collect()
        };
        let after = Configuration { velocities: impulse.velocities, ..before.clone() };
        let jumps = DVector::from_vec(components(&after)) - DVector::from_vec(components(&before));
        let velocities = velocities_in_sizes(mechanism, &after).into_iter().zip(&course.velocities);
        Ok(Some(Change {
            velocities: velocities.map(|(after, before)| after - before).collect(),
            jumps,
            impulses: vec![0.0; self.collision.pushing().count()],
        }))
    }
}

impl Hinged<'_> {
    /// What is known of a joint or hinge with this velocity. Without friction nothing holds it.
    fn known(&self, joint: usize, velocity: f64, targets: &[(usize, f64)]) -> KnownMotion {
        let sign = (velocity != 0.0).then(|| velocity.signum());
        match targets.iter().find(|(pushed, _)| *pushed == joint) {
            Some((_, target)) => KnownMotion {
                sign: sign.or(Some(if *target == 0.0 { -self.setup.stops[joint] } else { target.signum() })),
                acceleration: velocity - target,
                pushed: true,
            },
            None if self.rubs(joint) => KnownMotion { sign, ..KnownMotion::default() },
            None => KnownMotion { sign: sign.or(Some(1.0)), ..KnownMotion::default() },
        }
    }

    fn change_of(&self, state: &MotionState, targets: &[(usize, f64)]) -> Change {
        let jumps = DVector::from_column_slice(&state.accelerations);
        let joints = state.pattern.joints.iter().chain(&state.pattern.hinges).enumerate();
        let change = |(joint, phase): (usize, &JointPhase)| match phase {
            JointPhase::Sticking => 0.0,
            JointPhase::Sliding(_) => {
                let in_sizes = if joint < self.setup.sliders.len() { 1.0 } else { self.setup.units.length };
                (self.setup.row(joint) * &jumps)[0] * in_sizes
            }
        };
        let velocities = joints.map(change).collect();
        let impulses = targets.iter().map(|(joint, _)| state.pushes[*joint]).collect();
        Change { velocities, jumps, impulses }
    }

    /// Whether all joints that are pushed reach their targets: two that the joints of the mechanism couple may not be able to.
    fn reaches(&self, change: &Change, velocities: &[f64], targets: &[(usize, f64)]) -> bool {
        targets.iter().all(|&(joint, target)| {
            let error = velocities[joint] + change.velocities[joint] - target;
            self.collision.without_rounding(error) == 0.0
        })
    }
}

impl Change {
    fn is_near(&self, other: &Self) -> bool {
        near(self.jumps.as_slice(), other.jumps.as_slice(), SAME)
    }
}

/// Whether all impulses of a state are within their bounds: stops push, what sticks does so within static friction, and what
/// begins to move does so against its friction.
fn is_admissible(impulses: &Setup, state: &MotionState) -> bool {
    let directions: Vec<[f64; 2]> = state.forces.iter().map(|force| direction(*force)).collect();
    let slack = whole_slack(impulses, &state.pattern, &directions);
    slack.is_some_and(|slack| slack >= -BOUNDARY)
}
