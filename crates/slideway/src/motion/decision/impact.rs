//! Impacts on end stops: the impulses of the stops, with friction impulses at all sliding joints.

use super::MOST_STATES;
use super::assessment::Assessment;
use super::impulse::{AT_REST, Impulses};
use super::instant::Instant;
use super::outputs::Group;
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::modes::Side;
use crate::motion::moving::energy::kinetic;
use crate::pattern::{ContactPhase, JointPhase};
use nalgebra::DVector;

/// The effect of an impact on end stops.
#[derive(Debug, Clone)]
pub struct Impact {
    /// The mechanism afterwards: the same positions, new velocities.
    pub after: Configuration,
    /// The blows, one for each set of joints that act on one another; they are independent.
    pub blows: Vec<Blow>,
}

/// The impact of joints that act on one another.
#[derive(Debug, Clone)]
pub struct Blow {
    /// The joints, each with the impulse with which its stop pushes (N s).
    pub stops: Vec<(JointId, f64)>,
    /// Kinetic energy before minus kinetic energy afterwards (J).
    pub energy_lost: f64,
}

/// The impact of sliding joints that move towards end stops, each with Newton's coefficient of restitution
/// `e`: its sliding velocity changes from `v` to `-e v`.
///
/// A stop pushes along the centre line of the guide, between block and guide, with an impulse `P` that grows
/// during the impact (E. J. Routh, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV). Loads
/// and preloads are negligible; meanwhile velocities change according to
///
/// ```text
/// M v' - G^T Lambda' - B U' - sum_k W_k Phi_k' = sum_i W_stop,i P_i'      G v' = 0      C v' = 0      P_i' >= 0
/// Phi_k' = mu_k |Lambda_k'| s_k of joints that slide,    |Phi_k'| <= mu_static_k |Lambda_k'| of those at rest that stay so
/// ```
///
/// which is the mode problem of impulses. It is constant until a sliding velocity reaches zero, and is then
/// decided anew. A joint slides first against its stop and then away from it, so its friction reverses within
/// the impact. If there are several possible answers, the one with the greatest margin is used. Coefficients
/// of friction are those at the velocities before the impact.
///
/// Stops that are reached together act together: the velocities `v_i` towards them change to `-e_i v_i` in
/// proportion. A stop may also exert no impulse, if the others move its joint away from it at least as fast:
/// `P_i >= 0` and `-w_i >= e_i v_i` for the velocity `w_i` afterwards are complementary (J. J. Moreau).
/// Without friction this is a linear complementarity problem with a unique outcome, which removes a kinetic
/// energy of `sum_i P_i (1 - e_i) v_i/2`. All choices of the stops that push are tried.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, more states than are
/// tried, an impact in which friction leaves the stops no impulse, and one with several possible outcomes.
pub fn impact(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stops: &[(JointId, f64)],
) -> Result<Impact, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    let place = |id: JointId| instant.joints.iter().position(|joint| joint.id == id);
    let hits = stops.iter().filter_map(|&(id, restitution)| Some(Hit { joint: place(id)?, restitution }));
    // A joint that rests at its stop stays or leaves like any joint at rest.
    let velocities = Impulses::new(&instant).velocities();
    let hits: Vec<Hit> = hits.filter(|hit| velocities[hit.joint] != 0.0).collect();
    let mut found = Impact { after: configuration.clone(), blows: Vec::new() };
    for group in &instant.groups {
        let hits: Vec<Hit> = hits.iter().copied().filter(|hit| group.joints.contains(&hit.joint)).collect();
        if hits.is_empty() {
            continue;
        }
        let AfterImpact { jumps, impulses, .. } = outcome(&instant, group, &hits)?;
        let after = Impulses::new(&instant).moved(&found.after, &jumps);
        let stops = hits.iter().map(|hit| instant.joints[hit.joint].id).zip(impulses).collect();
        let energy_lost = kinetic(mechanism, &found.after) - kinetic(mechanism, &after);
        found.blows.push(Blow { stops, energy_lost });
        found.after = after;
    }
    Ok(found)
}

/// A joint that has reached its stop.
#[derive(Debug, Clone, Copy)]
struct Hit {
    joint: usize,
    restitution: f64,
}

/// The progress of an impact.
#[derive(Debug, Clone)]
struct AfterImpact {
    /// The sliding velocities (m/s), exactly zero where a joint has stopped.
    velocities: Vec<f64>,
    /// The jumps of all velocities.
    jumps: DVector<f64>,
    /// Of the stops (N s).
    impulses: Vec<f64>,
}

/// The unique outcome of an impact in a group.
///
/// # Errors
/// There is no outcome, or there are several.
fn outcome(instant: &Instant<'_>, group: &Group, hits: &[Hit]) -> Result<AfterImpact, Faults> {
    let joints = || {
        hits.iter().map(|hit| instant.mechanism.joints[instant.joints[hit.joint].id.index()].name.to_string())
    };
    let choices = hits.iter().fold(1_u64, |choices, _| choices.saturating_mul(2));
    if choices > MOST_STATES {
        let kind = FaultKind::TooManyStates { states: choices, limit: MOST_STATES };
        return Err(Fault::general(kind).into());
    }
    let mut found: Option<AfterImpact> = None;
    let mut unsolved = 0;
    // All stops together are tried first.
    for choice in (1..choices).rev() {
        let pushes: Vec<bool> = (0..hits.len()).map(|hit| choice >> hit & 1 == 1).collect();
        let instant = touching(instant, hits, &pushes);
        let impulses = Impulses::new(&instant);
        let process = Process { impulses: &impulses, group, hits, pushes: &pushes };
        let Some(other) = process.outcome(&mut unsolved)? else { continue };
        let differs = |found: &AfterImpact| {
            let velocities = found.velocities.iter().zip(&other.velocities);
            velocities.into_iter().any(|(one, other)| impulses.without_rounding(one - other) != 0.0)
        };
        if found.as_ref().is_some_and(differs) {
            return Err(Fault::general(FaultKind::SeveralImpacts { joints: joints().collect() }).into());
        }
        found.get_or_insert(other);
    }
    let joints = joints().collect();
    let kind =
        if unsolved > 0 { FaultKind::UnsolvedImpact { joints } } else { FaultKind::ImpactWedges { joints } };
    found.ok_or_else(|| Fault::general(kind).into())
}

/// The instant at which the joints whose stops push touch them.
fn touching<'m>(instant: &Instant<'m>, hits: &[Hit], pushes: &[bool]) -> Instant<'m> {
    let mut instant = instant.clone();
    for (hit, pushes) in hits.iter().zip(pushes) {
        let joint = &mut instant.joints[hit.joint];
        joint.stop = if *pushes { joint.velocity.signum() } else { 0.0 };
        joint.has_friction |= *pushes;
    }
    instant
}

struct Process<'s> {
    impulses: &'s Impulses<'s>,
    group: &'s Group,
    hits: &'s [Hit],
    /// For each, whether its stop pushes.
    pushes: &'s [bool],
}

impl Process<'_> {
    /// The outcome of the impact; `None` unless exactly these stops can push.
    fn outcome(&self, unsolved: &mut usize) -> Result<Option<AfterImpact>, Faults> {
        let instant = self.impulses.instant;
        let mut course = AfterImpact {
            velocities: self.impulses.velocities(),
            jumps: DVector::zeros(instant.influence.frictionless.len()),
            impulses: vec![0.0; self.hits.len()],
        };
        let before = course.velocities.clone();
        let pushed = self.hits.iter().zip(self.pushes).filter(|(_, pushes)| **pushes);
        let target = |(hit, _): (&Hit, _)| (hit.joint, -hit.restitution * before[hit.joint]);
        if !self.follow(&mut course, &pushed.map(target).collect::<Vec<_>>(), unsolved)? {
            return Ok(None);
        }
        let leaves = |hit: &Hit| {
            let (before, after) = (before[hit.joint], course.velocities[hit.joint]);
            -before.signum() * after >= hit.restitution * before.abs() - AT_REST * self.impulses.speed
        };
        Ok(self.hits.iter().all(leaves).then_some(course))
    }

    /// Follows an impact until the joints have reached their velocities, in proportion; `false` if no impulse
    /// leads there. Every part except the last brings another joint to rest.
    fn follow(
        &self,
        course: &mut AfterImpact,
        targets: &[(usize, f64)],
        unsolved: &mut usize,
    ) -> Result<bool, Faults> {
        let mut parts = 0..=4 * course.velocities.len();
        while targets.iter().any(|(joint, target)| course.velocities[*joint] != *target) {
            course.velocities.iter_mut().for_each(|v| *v = self.impulses.without_rounding(*v));
            let Some(state) = self.state(&course.velocities, targets, unsolved)? else { return Ok(false) };
            if parts.next().is_none() {
                return Ok(false);
            }
            let jumps = self.impulses.instant.influence.of_friction(&self.impulses.frictions(&state));
            let changes = self.changes(&state, &jumps);
            let (part, stops) = self.until_one_stops(&course.velocities, &changes, targets);
            course
                .velocities
                .iter_mut()
                .zip(&changes)
                .for_each(|(velocity, change)| *velocity += part * change);
            match stops {
                Some(other) => course.velocities[other] = 0.0,
                None => targets.iter().for_each(|(joint, target)| course.velocities[*joint] = *target),
            }
            course.jumps += jumps * part;
            for (impulse, hit) in course.impulses.iter_mut().zip(self.hits) {
                *impulse += part * self.push(&state, hit.joint);
            }
        }
        Ok(true)
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
            let sign = if stopped[joint] { away } else { velocities[joint].signum() };
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

    /// The change of every sliding velocity; exactly zero where the joint sticks.
    fn changes(&self, state: &Assessment, jumps: &DVector<f64>) -> Vec<f64> {
        let joints = self.impulses.instant.joints.iter().zip(&state.phase.joints);
        joints
            .map(|(joint, phase)| match phase {
                JointPhase::Sticking => 0.0,
                JointPhase::Sliding(_) => joint.row.change(jumps),
            })
            .collect()
    }

    /// The fraction of the change until another joint stops, and which joint; the whole if none does.
    fn until_one_stops(
        &self,
        velocities: &[f64],
        changes: &[f64],
        targets: &[(usize, f64)],
    ) -> (f64, Option<usize>) {
        let mut first = (1.0, None);
        for (joint, (velocity, change)) in velocities.iter().zip(changes).enumerate() {
            let part = -velocity / change;
            let rubs = self.impulses.instant.joints[joint].has_friction;
            let ends_there = targets.contains(&(joint, 0.0));
            if !ends_there && rubs && *velocity != 0.0 && part >= 0.0 && part < first.0 {
                first = (part, Some(joint));
            }
        }
        first
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
