//! The impulses of an impact.

use super::{AfterImpact, Blow, Change, Collision, Hit, Impact, hits, outcome};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::modes::Side;
use crate::motion::decision::assessment::Assessment;
use crate::motion::decision::impulse::Impulses;
use crate::motion::decision::instant::Instant;
use crate::motion::decision::jam::{Impulse, Jam, jam_within};
use crate::motion::decision::outputs::Group;
use crate::motion::decision::parts::SAME;
use crate::motion::moving::energy::kinetic;
use crate::pattern::{ContactPhase, JointPhase};
use crate::progress::Work;

/// The impact of joints, each group of joints that act on one another by itself, in work that may end: then it comes to
/// nothing.
///
/// # Errors
/// As [`impact`](super::impact).
pub(in crate::motion) fn impact_within(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stops: &[(JointId, f64)],
    work: Work<'_>,
) -> Result<Impact, Faults> {
    mechanism.check_no_one_sided("an impact on an end stop")?;
    let instant = Instant::new(mechanism, configuration)?;
    let velocities = Impulses::new(&instant, work).velocities();
    let joints: Vec<JointId> = instant.joints.iter().map(|joint| joint.id).collect();
    let hits = hits(stops, &joints, &velocities);
    let mut found = Impact { after: configuration.clone(), blows: Vec::new() };
    for group in &instant.groups {
        let hits: Vec<Hit> = hits.iter().copied().filter(|hit| group.joints.contains(&hit.joint)).collect();
        if hits.is_empty() {
            continue;
        }
        let size = instant.influence.frictionless.len();
        let mut of_group = vec![0.0; velocities.len()];
        group.members(joints.len()).for_each(|number| of_group[number] = velocities[number]);
        let collision = Collision::new(mechanism, &hits, &of_group, size);
        let before = &found.after;
        let course = outcome(collision, |collision, unsolved| {
            let instant = touching(&instant, collision);
            let impulses = Impulses::new(&instant, work);
            collision.outcome(&Pushed { impulses: &impulses, group, before, collision }, unsolved)
        })?;
        let after = Impulses::new(&instant, work).moved(&found.after, &course.jumps);
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

pub(super) struct Pushed<'s> {
    impulses: &'s Impulses<'s>,
    group: &'s Group,
    /// The mechanism before the impact.
    before: &'s Configuration,
    collision: &'s Collision<'s>,
}

impl Pushed<'_> {
    /// Whether friction or a stop acts while a velocity is zero.
    pub(super) fn rubs(&self, number: usize) -> bool {
        self.impulses.instant.may_stick(number)
    }

    /// The whole change from these velocities to the targets of the joints that are pushed; `None` if none is admissible. What
    /// was not decided is counted.
    ///
    /// # Errors
    /// More states than are tried, or several changes.
    pub(super) fn change(
        &self,
        velocities: &[f64],
        targets: &[(usize, f64)],
        unsolved: &mut usize,
    ) -> Result<Option<Change>, Faults> {
        let Some(state) = self.state(velocities, targets, unsolved)? else { return Ok(None) };
        let jumps = self.impulses.jumps(&state);
        let change = |(number, phase): (usize, JointPhase)| match phase {
            JointPhase::Sticking => 0.0,
            JointPhase::Sliding(_) => self.impulses.instant.change(number, &jumps),
        };
        let velocities = state.phase.joints_and_hinges().enumerate().map(change).collect();
        let impulses = targets.iter().map(|(joint, _)| self.push(&state, *joint)).collect();
        Ok(Some(Change { velocities, jumps, impulses }))
    }

    /// The change by which friction wedges the mechanism where no stop can push, until a velocity reaches zero.
    ///
    /// # Errors
    /// More states than are tried.
    pub(super) fn wedged(&self, course: &AfterImpact) -> Result<Option<Change>, Faults> {
        let instant = self.impulses.instant;
        let Instant { mechanism, joints, .. } = instant;
        let configuration = self.impulses.moved(self.before, &course.jumps);
        let rests = |number: usize| course.velocities[number] == 0.0;
        let found = jam_within(mechanism, &configuration, (&rests, self.impulses.work))?;
        let Jam::Stops(all) = found else { return Ok(None) };
        let of_group = |impulse: &Impulse| {
            self.group.members(joints.len()).any(|number| instant.id_of(number) == Some(impulse.wedged))
        };
        let impulse = all.into_iter().find(of_group);
        Ok(impulse.map(|impulse| {
            let mut velocities = vec![0.0; course.velocities.len()];
            for number in self.group.members(joints.len()) {
                velocities[number] = impulse.velocities[number] - course.velocities[number];
            }
            Change { velocities, jumps: impulse.jumps, impulses: vec![0.0; self.collision.pushing().count()] }
        }))
    }

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
        if !self.group.hinges.is_empty() {
            return self.only(found.list);
        }
        let better =
            |best: Assessment, other: Assessment| if other.least() > best.least() { other } else { best };
        Ok(found.list.into_iter().reduce(better))
    }

    /// The state in which most stays at rest.
    ///
    /// # Errors
    /// There are several, with different velocities afterwards.
    fn only(&self, mut states: Vec<Assessment>) -> Result<Option<Assessment>, Faults> {
        let stays = |state: &Assessment| {
            let members = self.group.members(self.impulses.instant.joints.len());
            members.filter(|number| state.phase.of(*number) == JointPhase::Sticking).count()
        };
        let most = states.iter().map(stays).max();
        states.retain(|state| Some(stays(state)) == most);
        let bodies = 3 * self.impulses.instant.mechanism.bodies.len();
        let jumps = |state: &Assessment| self.impulses.jumps(state).rows(0, bodies).into_owned();
        let mut states = states.into_iter();
        let Some(first) = states.next() else { return Ok(None) };
        let found = jumps(&first);
        if states.any(|other| (jumps(&other) - &found).amax() > SAME * found.amax()) {
            return Err(self.collision.several());
        }
        Ok(Some(first))
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
