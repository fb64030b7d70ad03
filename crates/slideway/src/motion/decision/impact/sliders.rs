//! The impulses of an impact without friction in hinges.

use super::{AfterImpact, Blow, Change, Collision, Hit, Impact, Pushed, hits, outcome};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::modes::Side;
use crate::motion::decision::assessment::Assessment;
use crate::motion::decision::impulse::Impulses;
use crate::motion::decision::instant::Instant;
use crate::motion::decision::jam::{Impulse, Jam, jam};
use crate::motion::decision::outputs::Group;
use crate::motion::moving::energy::kinetic;
use crate::pattern::{ContactPhase, JointPhase};

/// The impact of joints, each group of joints that act on one another by itself.
///
/// # Errors
/// As [`impact`](super::impact).
pub(super) fn impact(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stops: &[(JointId, f64)],
) -> Result<Impact, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    let velocities = Impulses::new(&instant).velocities();
    let joints: Vec<JointId> = instant.joints.iter().map(|joint| joint.id).collect();
    let hits = hits(stops, &joints, &velocities);
    let mut found = Impact { after: configuration.clone(), blows: Vec::new() };
    for group in &instant.groups {
        let hits: Vec<Hit> = hits.iter().copied().filter(|hit| group.joints.contains(&hit.joint)).collect();
        if hits.is_empty() {
            continue;
        }
        let size = instant.influence.frictionless.len();
        let collision = Collision::new(mechanism, &hits, &velocities, size);
        let before = &found.after;
        let course = outcome(collision, |collision, unsolved| {
            let instant = touching(&instant, collision);
            let impulses = Impulses::new(&instant);
            collision.outcome(&Sliders { impulses: &impulses, group, before, collision }, unsolved)
        })?;
        let after = Impulses::new(&instant).moved(&found.after, &course.jumps);
        let stops = hits.iter().map(|hit| hit.id).zip(course.impulses).collect();
        let energy_lost = kinetic(mechanism, &found.after) - kinetic(mechanism, &after);
        found.blows.push(Blow { stops, energy_lost });
        found.after = after;
    }
    Ok(found)
}

/// The instant at which the joints whose stops push touch them.
fn touching<'m>(instant: &Instant<'m>, collision: &Collision<'_>) -> Instant<'m> {
    let mut instant = instant.clone();
    for (hit, pushes) in collision.hits.iter().zip(&collision.pushes) {
        let joint = &mut instant.joints[hit.joint];
        joint.stop = if *pushes { joint.velocity.signum() } else { 0.0 };
        joint.has_friction |= *pushes;
    }
    collision.upright.iter().for_each(|joint| instant.joints[*joint].couple = None);
    instant
}

struct Sliders<'s> {
    impulses: &'s Impulses<'s>,
    group: &'s Group,
    /// The mechanism before the impact.
    before: &'s Configuration,
    collision: &'s Collision<'s>,
}

impl Pushed for Sliders<'_> {
    fn rubs(&self, joint: usize) -> bool {
        self.impulses.instant.joints[joint].has_friction
    }

    fn change(
        &self,
        velocities: &[f64],
        targets: &[(usize, f64)],
        unsolved: &mut usize,
    ) -> Result<Option<Change>, Faults> {
        let Some(state) = self.state(velocities, targets, unsolved)? else { return Ok(None) };
        let jumps = self.impulses.instant.influence.of_friction(&self.impulses.frictions(&state));
        let joints = self.impulses.instant.joints.iter().zip(&state.phase.joints);
        let change =
            |(joint, phase): (&crate::motion::decision::joints::SlidingJoint, &JointPhase)| match phase {
                JointPhase::Sticking => 0.0,
                JointPhase::Sliding(_) => joint.row.change(&jumps),
            };
        let velocities = joints.map(change).collect();
        let impulses = targets.iter().map(|(joint, _)| self.push(&state, *joint)).collect();
        Ok(Some(Change { velocities, jumps, impulses }))
    }

    fn wedged(&self, course: &AfterImpact) -> Result<Option<Change>, Faults> {
        let Instant { mechanism, influence, joints, .. } = self.impulses.instant;
        let configuration = self.impulses.moved(self.before, &course.jumps);
        let Jam::Stops(all) = jam(mechanism, &configuration)? else { return Ok(None) };
        let of_group =
            |impulse: &Impulse| self.group.joints.iter().any(|joint| joints[*joint].id == impulse.wedged);
        let impulse = all.into_iter().find(of_group);
        Ok(impulse.map(|impulse| {
            let velocities = impulse.sliding_velocities.iter().zip(&course.velocities);
            Change {
                velocities: velocities.map(|(after, before)| after - before).collect(),
                jumps: influence.of_friction(&impulse.friction_impulses),
                impulses: vec![0.0; self.collision.pushing().count()],
            }
        }))
    }
}

impl Sliders<'_> {
    /// The state in which the whole change from these sliding velocities to the targets could take place;
    /// `None` if none is admissible.
    fn state(
        &self,
        velocities: &[f64],
        targets: &[(usize, f64)],
        unsolved: &mut usize,
    ) -> Result<Option<Assessment>, Faults> {
        let stopped: Vec<bool> = velocities.iter().map(|velocity| *velocity == 0.0).collect();
        let mut jumps = vec![0.0; velocities.len()];
        let mut options: Vec<Vec<JointPhase>> =
            (0..velocities.len()).map(|joint| self.impulses.options(joint, velocities[joint])).collect();
        for &(joint, target) in targets {
            jumps[joint] = target - velocities[joint];
            let away = -self.impulses.instant.joints[joint].stop;
            let moves = [velocities[joint], jumps[joint]].into_iter().find(|change| *change != 0.0);
            let sign = moves.unwrap_or(away).signum();
            options[joint] = vec![JointPhase::Sliding(sign)];
        }
        let mut question = self.impulses.question(&jumps, &stopped);
        question.pushed = targets.iter().map(|(joint, _)| *joint).collect();
        let found = self.impulses.admissible(&question, &options, self.group)?;
        *unsolved += found.unsolved;
        let better =
            |best: Assessment, other: Assessment| if other.least() > best.least() { other } else { best };
        Ok(found.list.into_iter().reduce(better))
    }

    /// The impulse with which the stop of a joint pushes in a state (N s): half of it acts at the
    /// face that is not pressed, where nothing else acts.
    fn push(&self, state: &Assessment, joint: usize) -> f64 {
        let joint = &self.impulses.instant.joints[joint];
        let k = joint.contacts[0];
        let friction = self.impulses.frictions(state)[k];
        let half = match state.phase.contacts[k] {
            ContactPhase::Pressed(Side::Positive) => friction.negative_face,
            _ => friction.positive_face,
        };
        2.0 * joint.stop * half
    }
}
