//! Dynamic jamming: the impulse that stops a mechanism which has no admissible acceleration (theory, section 8).

use super::assessment::{Assessment, PRESSED, assess_group};
use super::instant::Instant;
use super::outputs::{Group, Outputs};
use super::successors::combinations;
use super::system::Question;
use super::{BOUNDARY, MOST_STATES};
use crate::configuration::{Configuration, Velocity};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::JointId;
use crate::influence::ContactFriction;
use crate::mechanism::Mechanism;
use crate::motion::energy::kinetic;
use crate::motion::{ContactPhase, JointPhase, Phase};
use nalgebra::{DVector, Vector2};

/// Sliding velocities below this multiple of the greatest are zero.
pub(super) const AT_REST: f64 = 1e-9;

/// What an impulse that ends a jam does.
#[derive(Debug, Clone)]
pub struct Impulse {
    /// The joint that wedges; its tangential impulse is a reaction.
    pub wedged: JointId,
    /// The sliding joints without velocity afterwards: those that stopped first, and those that were at rest and stay so.
    pub at_rest: Vec<JointId>,
    /// The sides at which the contacts are pressed during the impulse.
    pub sides: Vec<ContactPhase>,
    /// Impulse of the normal force of each contact, with its sign (N s).
    pub normal_impulses: Vec<f64>,
    /// Impulse of the friction of each contact, positive along -u on the block (N s).
    pub friction_impulses: Vec<ContactFriction>,
    /// The mechanism afterwards: the same positions, new velocities.
    pub after: Configuration,
    /// Velocity of each sliding joint afterwards (m/s), exactly zero where it has stopped.
    pub sliding_velocities: Vec<f64>,
    /// Kinetic energy before less kinetic energy afterwards (J).
    pub energy_lost: f64,
    /// The least slack of the inequalities, as a part of the greatest impulse of the state.
    pub margin: f64,
}

/// All impulses that can end a jam.
#[derive(Debug, Clone)]
pub enum Jam {
    /// These impulses, the one with the greatest margin first.
    Stops(Vec<Impulse>),
    /// No impulse is consistent: whichever joint wedges, its friction would not be great enough, or a guided slider would
    /// tip.
    NoImpulse {
        /// Patterns of which a linear program was not solved.
        unsolved: usize,
    },
    /// No joint with friction slides: nothing can jam dynamically. A mechanism at rest that cannot be started is held
    /// by self-locking, which is another thing.
    AtRest,
}

/// The impulses that can act when there is no admissible acceleration though joints slide: dynamic jamming.
///
/// Reactions grow beyond all bounds for a short time, until the first sliding velocity reaches zero. They do so because
/// some joint `j` wedges: for every joint that slides the mode problem of impulses is solved, without loads and preloads,
/// as if it stopped:
///
/// ```text
/// M dv - G^T Lambda - B U - sum_k W_k Phi_k = 0      G dv = 0      C dv = 0      jump of the sliding velocity of j = -ds_j
/// Phi_k = mu_k |Lambda_k| s_k of the joints that go on sliding
/// 0 <= Phi_k s_k <= mu_static_k |Lambda_k| of joint j
/// ```
///
/// If another sliding velocity would reverse before that, the impulse ends where it is zero, in proportion. Joints that
/// were at rest stay so within static friction, or are set going against kinetic friction. With one degree of freedom
/// everything stops. The distribution between the contacts of joint `j` is indeterminate; the one with the greatest
/// margin is told. Whether the mechanism is jammed is not asked: that is an empty list of
/// [`successors`](super::successors). Afterwards ask for them again, with the joints that have stopped; if there are
/// none, it is still jammed.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, more states than are tried.
pub fn jam(mechanism: &Mechanism, configuration: &Configuration) -> Result<Jam, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    let speed = instant.joints.iter().map(|joint| joint.velocity.abs()).fold(0.0, f64::max);
    let moves = |joint: &usize| {
        let joint = &instant.joints[*joint];
        joint.has_friction && joint.velocity.abs() > AT_REST * speed
    };
    let moving: Vec<usize> = (0..instant.joints.len()).filter(moves).collect();
    if moving.is_empty() {
        return Ok(Jam::AtRest);
    }
    let outputs = instant.impulse_outputs();
    let search = Search { configuration, instant: &instant, outputs: &outputs, speed };
    let mut found = Found::default();
    for &joint in &moving {
        search.stop(joint, &mut found)?;
    }
    if found.impulses.is_empty() {
        return Ok(Jam::NoImpulse { unsolved: found.unsolved });
    }
    found.impulses.sort_by(|one, other| other.margin.total_cmp(&one.margin));
    Ok(Jam::Stops(found.impulses))
}

#[derive(Default)]
struct Found {
    impulses: Vec<Impulse>,
    unsolved: usize,
}

struct Search<'s> {
    configuration: &'s Configuration,
    instant: &'s Instant<'s>,
    outputs: &'s Outputs,
    speed: f64,
}

impl Search<'_> {
    /// Looks for impulses in which this joint wedges.
    fn stop(&self, joint: usize, found: &mut Found) -> Result<(), Faults> {
        let stopped = vec![false; self.instant.joints.len()];
        let velocity = self.instant.joints[joint].velocity;
        let mut wanted = vec![0.0; self.instant.joints.len()];
        wanted[joint] = -velocity / (self.instant.joints[joint].units.acceleration * self.time());
        let question = Question {
            outputs: self.outputs,
            wanted,
            has_preload: false,
            sides: vec![PRESSED.to_vec(); self.outputs.columns[0].ncols()],
            stopped: &stopped,
            opposes: Some((joint, velocity.signum())),
        };
        let Some(group) = self.instant.groups.iter().find(|group| group.joints.contains(&joint)) else {
            return Ok(());
        };
        for phase in self.patterns(joint, group)? {
            let of = (&phase, group);
            match assess_group(self.instant, &question, of, (BOUNDARY, f64::INFINITY)) {
                Err(_) => found.unsolved += 1,
                Ok(Some(assessment)) if assessment.least() >= -BOUNDARY => {
                    found.impulses.extend(self.impulse(joint, &assessment));
                }
                Ok(_) => {}
            }
        }
        Ok(())
    }

    /// The time in which the unit of acceleration gives the greatest sliding velocity (s).
    fn time(&self) -> f64 {
        self.speed / self.instant.units.acceleration
    }

    /// States of the other joints of a group, with all sides of the contacts that slide; the others remain as they are.
    fn patterns(&self, stopping: usize, group: &Group) -> Result<Vec<Phase>, Faults> {
        let joint_options = |joint: usize| {
            let mut options = self.options(joint, stopping);
            options.truncate(if group.joints.contains(&joint) { 3 } else { 1 });
            options
        };
        let joints: Vec<Vec<JointPhase>> = (0..self.instant.joints.len()).map(joint_options).collect();
        let contacts: Vec<usize> = (0..self.outputs.columns[0].ncols()).collect();
        let sides = group.contacts.iter().map(|_| 2);
        let counts = joints.iter().map(Vec::len).chain(sides);
        let states = counts.fold(1_u64, |product, count| product.saturating_mul(count as u64));
        if states > MOST_STATES {
            return Err(Fault::general(FaultKind::TooManyStates { states, limit: MOST_STATES }).into());
        }
        let mut all = Vec::new();
        for joints in combinations(&joints) {
            let sides = |k: &usize| {
                let mut pressed = PRESSED.to_vec();
                let sticks =
                    self.instant.joint_of(*k).is_some_and(|joint| joints[joint] == JointPhase::Sticking);
                if sticks || !group.contacts.contains(k) {
                    pressed.truncate(1);
                }
                pressed
            };
            let options: Vec<Vec<ContactPhase>> = contacts.iter().map(sides).collect();
            let phases = combinations(&options).into_iter();
            all.extend(phases.map(|contacts| Phase { joints: joints.clone(), contacts }));
        }
        Ok(all)
    }

    fn options(&self, joint: usize, stopping: usize) -> Vec<JointPhase> {
        let SlidingState { moves, sign, has_friction } = self.sliding(joint);
        if joint == stopping {
            vec![JointPhase::Sticking]
        } else if moves || !has_friction {
            vec![JointPhase::Sliding(sign)]
        } else {
            vec![JointPhase::Sticking, JointPhase::Sliding(1.0), JointPhase::Sliding(-1.0)]
        }
    }

    fn sliding(&self, joint: usize) -> SlidingState {
        let joint = &self.instant.joints[joint];
        SlidingState {
            moves: joint.velocity.abs() > AT_REST * self.speed,
            sign: if joint.velocity < 0.0 { -1.0 } else { 1.0 },
            has_friction: joint.has_friction,
        }
    }

    /// The impulse of an admissible state, as far as the first sliding velocity reaches zero; nothing if a joint that was
    /// at rest would slide against its friction's sense.
    fn impulse(&self, joint: usize, assessment: &Assessment) -> Option<Impulse> {
        let unit = |k: usize| self.instant.units_of(k).force * self.time();
        let frictions = assessment.forces.frictions.iter().enumerate();
        let whole: Vec<ContactFriction> = frictions.map(|(k, friction)| friction.times(unit(k))).collect();
        let jumps = self.instant.influence.of_friction(&whole);
        let part = self.part(&assessment.phase, &jumps)?;
        let jumps = jumps * part;
        let sliding_velocities: Vec<f64> = (0..self.instant.joints.len())
            .map(|joint| self.sliding_after(joint, &assessment.phase, &jumps))
            .collect();
        let rest = self.instant.joints.iter().zip(&sliding_velocities).filter(|(_, after)| **after == 0.0);
        let after = self.after(&jumps);
        let normals = assessment.forces.normal.iter().enumerate();
        Some(Impulse {
            wedged: self.instant.joints[joint].id,
            at_rest: rest.map(|(joint, _)| joint.id).collect(),
            sides: assessment.phase.contacts.clone(),
            normal_impulses: normals.map(|(k, normal)| normal * unit(k) * part).collect(),
            friction_impulses: whole.into_iter().map(|friction| friction.times(part)).collect(),
            energy_lost: kinetic(self.instant.mechanism, self.configuration)
                - kinetic(self.instant.mechanism, &after),
            after,
            sliding_velocities,
            margin: assessment.least(),
        })
    }

    /// The part of an impulse after which the first sliding velocity is zero; nothing if a joint that was at rest would
    /// slide the other way.
    fn part(&self, phase: &Phase, jumps: &DVector<f64>) -> Option<f64> {
        let mut part = 1.0_f64;
        for (index, joint) in self.instant.joints.iter().enumerate() {
            let JointPhase::Sliding(sign) = phase.joints[index] else { continue };
            let jump = sign * joint.row.change(jumps);
            if !joint.has_friction || jump >= -AT_REST * self.speed {
                continue;
            }
            if !self.sliding(index).moves {
                return None;
            }
            part = part.min(joint.velocity.abs() / -jump);
        }
        Some(part)
    }

    /// Sliding velocity of a joint afterwards, exactly zero where it has stopped.
    fn sliding_after(&self, joint: usize, phase: &Phase, jumps: &DVector<f64>) -> f64 {
        let sticks = phase.joints[joint] == JointPhase::Sticking && !self.sliding(joint).moves;
        let joint = &self.instant.joints[joint];
        let after = joint.velocity + joint.row.change(jumps);
        if sticks || after.abs() <= AT_REST * self.speed { 0.0 } else { after }
    }

    /// The configuration with these jumps of the velocities; what is left of a velocity by rounding is zero.
    fn after(&self, jumps: &DVector<f64>) -> Configuration {
        let mut after = self.configuration.clone();
        for (body, velocity) in after.velocities.iter_mut().enumerate() {
            let [x, y, turn] = [0, 1, 2].map(|axis| jumps[3 * body + axis]);
            *velocity = Velocity {
                linear: Vector2::new(sum(velocity.linear.x, x), sum(velocity.linear.y, y)),
                angular: sum(velocity.angular, turn),
            };
        }
        let rates = self.instant.equations.coordinate_jumps(jumps);
        for (rate, jump) in after.rates.iter_mut().zip(rates) {
            *rate = sum(*rate, jump);
        }
        after
    }
}

struct SlidingState {
    moves: bool,
    sign: f64,
    has_friction: bool,
}

/// A sum that is exactly zero where its terms cancel within rounding.
fn sum(velocity: f64, jump: f64) -> f64 {
    let sum = velocity + jump;
    if sum.abs() <= AT_REST * velocity.abs() { 0.0 } else { sum }
}
