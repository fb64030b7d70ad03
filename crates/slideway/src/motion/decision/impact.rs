//! Impacts on end stops: the impulse of a stop, with friction impulses at all sliding joints.

use super::assessment::{Assessment, PRESSED, assess_group};
use super::instant::Instant;
use super::jam::AT_REST;
use super::outputs::{Group, Outputs};
use super::successors::combinations;
use super::system::Question;
use super::{BOUNDARY, MOST_STATES};
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::JointId;
use crate::influence::ContactFriction;
use crate::mechanism::Mechanism;
use crate::motion::energy::kinetic;
use crate::motion::{ContactPhase, JointPhase, Phase};
use nalgebra::{DVector, Vector2};

/// What an impact on an end stop does.
#[derive(Debug, Clone)]
pub struct Impact {
    /// The mechanism afterwards: the same positions, new velocities.
    pub after: Configuration,
    /// The impulse with which the stop pushes (N s).
    pub impulse: f64,
    /// Kinetic energy before less kinetic energy afterwards (J).
    pub energy_lost: f64,
}

/// The impact of a sliding joint that moves towards an end stop, with Newton's coefficient of restitution `e`: its sliding
/// velocity `v` becomes `-e v`.
///
/// The stop pushes along the centre line of the guide, block against guide, with an impulse `P` that grows during the
/// impact (E. J. Routh, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV). Loads and preloads are too small to count;
/// at every `P` velocities change by
///
/// ```text
/// M v' - G^T Lambda' - B U' - sum_k W_k Phi_k' = W_stop      G v' = 0      C v' = 0      ' = d/dP
/// Phi_k' = mu_k |Lambda_k'| s_k of joints that slide,    |Phi_k'| <= mu_static_k |Lambda_k'| of those at rest that stay so
/// ```
///
/// which is the mode problem of the instant with another load. It is constant until a sliding velocity reaches zero; there it
/// is decided anew. The joint itself slides against the stop first, and then away from it, so that its friction turns
/// round within the impact. Of several possible answers the one with the greatest margin is taken. Coefficients of friction
/// are those of the velocities before.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, more states than are tried, and an impact
/// in which friction leaves the stop no impulse.
pub fn impact(
    mechanism: &Mechanism,
    configuration: &Configuration,
    joint: JointId,
    restitution: f64,
) -> Result<Impact, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    let wedges = || {
        let joint = mechanism.joints[joint.index()].name.to_string();
        Faults::from(Fault::general(FaultKind::ImpactWedges { joint }))
    };
    let hit = instant.joints.iter().position(|other| other.id == joint).ok_or_else(wedges)?;
    let group = instant.groups.iter().find(|group| group.joints.contains(&hit)).ok_or_else(wedges)?;
    let before = instant.joints[hit].velocity;
    let push = -before.signum();
    let outputs = pushed(&instant, hit, push);
    let process = Process { instant: &instant, outputs: &outputs, group, hit, push };
    let velocities = instant.joints.iter().map(|joint| joint.velocity).collect();
    let mut course = Course { velocities, jumps: None, impulse: 0.0 };
    for target in [0.0, -restitution * before] {
        if !process.follow(&mut course, target)? {
            return Err(wedges());
        }
    }
    let Course { jumps, impulse, .. } = course;
    let after = jumps.map_or_else(|| configuration.clone(), |jumps| moved(&instant, configuration, &jumps));
    let energy_lost = kinetic(mechanism, configuration) - kinetic(mechanism, &after);
    Ok(Impact { after, impulse, energy_lost })
}

/// The outputs under a unit force of the stop alone, on the centre line of the guide.
fn pushed(instant: &Instant<'_>, hit: usize, push: f64) -> Outputs {
    let columns = instant.outputs.columns.clone();
    let k = instant.joints[hit].contacts[0];
    let base = (columns[0].column(k) + columns[1].column(k)) * (-push / 2.0);
    Outputs { base, columns }
}

/// What a unit of the stop's impulse does.
struct Change {
    phase: Phase,
    /// Of all unknowns.
    jumps: DVector<f64>,
}

/// How far an impact has gone.
struct Course {
    /// The sliding velocities (m/s), exactly zero where a joint has stopped.
    velocities: Vec<f64>,
    /// The jumps of all velocities so far.
    jumps: Option<DVector<f64>>,
    /// Of the stop (N s).
    impulse: f64,
}

struct Process<'s> {
    instant: &'s Instant<'s>,
    outputs: &'s Outputs,
    group: &'s Group,
    hit: usize,
    push: f64,
}

impl Process<'_> {
    /// The unit of the stop's impulse (N s).
    fn unit(&self) -> f64 {
        self.instant.units_of(self.instant.joints[self.hit].contacts[0]).force
    }

    /// Follows an impact until the joint at the stop has a velocity; `false` if no impulse leads there. Every part but the last
    /// brings another joint to rest.
    fn follow(&self, course: &mut Course, target: f64) -> Result<bool, Faults> {
        let velocities = &mut course.velocities;
        let speed = velocities.iter().fold(0.0, |speed: f64, velocity| speed.max(velocity.abs()));
        let mut parts = 0..=4 * velocities.len();
        while velocities[self.hit] != target {
            velocities.iter_mut().filter(|v| v.abs() <= AT_REST * speed).for_each(|v| *v = 0.0);
            let Some(change) = self.change(velocities)? else { return Ok(false) };
            let rates = self.sliding_rates(&change);
            let whole = (target - velocities[self.hit]) / rates[self.hit];
            if !(rates[self.hit] * self.push > 0.0 && whole.is_finite()) || parts.next().is_none() {
                return Ok(false);
            }
            let (length, stops) = self.until_one_stops(velocities, &rates, whole);
            velocities.iter_mut().zip(&rates).for_each(|(velocity, rate)| *velocity += length * rate);
            match stops {
                Some(other) => velocities[other] = 0.0,
                None => velocities[self.hit] = target,
            }
            course.impulse += length * self.unit();
            let added = change.jumps * length;
            course.jumps = Some(course.jumps.take().map_or_else(|| added.clone(), |jumps| jumps + &added));
        }
        Ok(true)
    }

    /// What a unit of the impulse does at these sliding velocities; nothing if no state is admissible.
    fn change(&self, velocities: &[f64]) -> Result<Option<Change>, Faults> {
        let stopped: Vec<bool> = velocities.iter().map(|velocity| *velocity == 0.0).collect();
        let question = Question {
            outputs: self.outputs,
            wanted: vec![0.0; velocities.len()],
            has_preload: false,
            sides: vec![PRESSED.to_vec(); self.outputs.columns[0].ncols()],
            stopped: &stopped,
            opposes: None,
        };
        let mut best: Option<Assessment> = None;
        for phase in self.phases(velocities)? {
            let of = (&phase, self.group);
            let Ok(Some(found)) = assess_group(self.instant, &question, of, (BOUNDARY, f64::INFINITY)) else {
                continue;
            };
            let is_better = best.as_ref().is_none_or(|best| found.least() > best.least());
            if found.least() >= -BOUNDARY && is_better {
                best = Some(found);
            }
        }
        Ok(best.map(|found| self.jumps(&found)))
    }

    fn jumps(&self, found: &Assessment) -> Change {
        let frictions = found.forces.frictions.iter().enumerate();
        let mut forces: Vec<ContactFriction> =
            frictions.map(|(k, friction)| friction.times(self.instant.units_of(k).force)).collect();
        let stop = &mut forces[self.instant.joints[self.hit].contacts[0]];
        stop.positive_face -= self.push * self.unit() / 2.0;
        stop.negative_face -= self.push * self.unit() / 2.0;
        Change { phase: found.phase.clone(), jumps: self.instant.influence.of_friction(&forces) }
    }

    /// How fast every sliding velocity changes; exactly not where the joint sticks.
    fn sliding_rates(&self, change: &Change) -> Vec<f64> {
        let joints = self.instant.joints.iter().zip(&change.phase.joints);
        let rate = |(joint, phase): (&super::joints::SlidingJoint, &JointPhase)| match phase {
            JointPhase::Sticking => 0.0,
            JointPhase::Sliding(_) => joint.row.change(&change.jumps),
        };
        joints.map(rate).collect()
    }

    /// How far the impulse goes until another joint stops, and which; the whole if none does.
    fn until_one_stops(&self, velocities: &[f64], rates: &[f64], whole: f64) -> (f64, Option<usize>) {
        let mut first = (whole, None);
        for (joint, (velocity, rate)) in velocities.iter().zip(rates).enumerate() {
            let length = -velocity / rate;
            let rubs = self.instant.joints[joint].has_friction;
            if joint != self.hit && rubs && *velocity != 0.0 && length >= 0.0 && length < first.0 {
                first = (length, Some(joint));
            }
        }
        first
    }

    /// All states of the group at these sliding velocities; other joints do not matter.
    fn phases(&self, velocities: &[f64]) -> Result<Vec<Phase>, Faults> {
        let joints: Vec<Vec<JointPhase>> =
            (0..velocities.len()).map(|joint| self.options(joint, velocities[joint])).collect();
        let mut all = Vec::new();
        for joints in combinations(&joints) {
            let sides = |k: usize| {
                let mut sides = PRESSED.to_vec();
                let slides =
                    self.instant.joint_of(k).is_some_and(|joint| joints[joint] != JointPhase::Sticking);
                if !slides || !self.group.contacts.contains(&k) {
                    sides.truncate(1);
                }
                sides
            };
            let options: Vec<Vec<ContactPhase>> = (0..self.outputs.columns[0].ncols()).map(sides).collect();
            let states = options.iter().fold(all.len() as u64, |n, sides| n.max(1) * sides.len() as u64);
            if states > MOST_STATES {
                return Err(Fault::general(FaultKind::TooManyStates { states, limit: MOST_STATES }).into());
            }
            let phases = combinations(&options).into_iter();
            all.extend(phases.map(|contacts| Phase { joints: joints.clone(), contacts }));
        }
        Ok(all)
    }

    fn options(&self, joint: usize, velocity: f64) -> Vec<JointPhase> {
        let rests = self.group.joints.contains(&joint) && self.instant.joints[joint].has_friction;
        if velocity != 0.0 {
            vec![JointPhase::Sliding(velocity.signum())]
        } else if joint == self.hit {
            vec![JointPhase::Sliding(self.push)]
        } else if rests {
            vec![JointPhase::Sticking, JointPhase::Sliding(1.0), JointPhase::Sliding(-1.0)]
        } else {
            vec![JointPhase::Sliding(1.0)]
        }
    }
}

/// The configuration with jumps of the velocities.
fn moved(instant: &Instant<'_>, configuration: &Configuration, jumps: &DVector<f64>) -> Configuration {
    let mut after = configuration.clone();
    for (body, velocity) in after.velocities.iter_mut().enumerate() {
        velocity.linear += Vector2::new(jumps[3 * body], jumps[3 * body + 1]);
        velocity.angular += jumps[3 * body + 2];
    }
    let rates = instant.equations.coordinate_jumps(jumps);
    after.rates.iter_mut().zip(rates).for_each(|(rate, jump)| *rate += jump);
    after
}
