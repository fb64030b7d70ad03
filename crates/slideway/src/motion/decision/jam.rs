//! Dynamic jamming: the impulse that stops a mechanism that has no admissible acceleration (theory, section
//! 8).

use super::assessment::Assessment;
use super::impulse::{AT_REST, Impulses};
use super::instant::Instant;
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::influence::ContactFriction;
use crate::mechanism::Mechanism;
use crate::motion::moving::energy::kinetic;
use crate::pattern::{JointPhase, Phase};
use nalgebra::DVector;

/// The effect of an impulse that ends a jam.
#[derive(Debug, Clone)]
pub struct Impulse {
    /// The joint that wedges; its tangential impulse is a reaction.
    pub(crate) wedged: JointId,
    /// The sliding joints without velocity afterwards: those that stopped first, and those that were at rest
    /// and stay at rest.
    pub at_rest: Vec<JointId>,
    /// Impulse of the normal force of each contact, with its sign (N s).
    pub normal_impulses: Vec<f64>,
    /// Impulse of the friction of each contact, positive along -u on the block (N s).
    pub friction_impulses: Vec<ContactFriction>,
    /// The mechanism afterwards: the same positions, new velocities.
    pub after: Configuration,
    /// Velocity of each sliding joint afterwards (m/s), exactly zero where it has stopped.
    pub sliding_velocities: Vec<f64>,
    /// Kinetic energy before minus kinetic energy afterwards (J).
    pub energy_lost: f64,
    /// The least slack of the inequalities, as a fraction of the greatest impulse of the state.
    pub(crate) margin: f64,
}

/// All impulses that can end a jam.
#[derive(Debug, Clone)]
pub enum Jam {
    /// These impulses, the one with the greatest margin first.
    Stops(Vec<Impulse>),
    /// No impulse is consistent: whichever joint wedges, its friction would be insufficient, or a guided
    /// slider would tip.
    NoImpulse {
        /// The number of patterns for which a linear program was not solved.
        unsolved: usize,
    },
    /// No joint with friction slides, so nothing can jam dynamically. A mechanism at rest that cannot be
    /// started is held by self-locking, which is a different phenomenon.
    AtRest,
}

/// The impulses that can act when joints slide but no acceleration is admissible: dynamic jamming.
///
/// Reactions grow without bound for a short time, until the first sliding velocity reaches zero. They do so
/// because some joint `j` wedges: for every sliding joint, the mode problem of impulses, without loads and
/// preloads, is solved as if this joint stopped:
///
/// ```text
/// M dv - G^T Lambda - B U - sum_k W_k Phi_k = 0      G dv = 0      C dv = 0      jump of the sliding velocity of j = -ds_j
/// Phi_k = mu_k |Lambda_k| s_k of the joints that go on sliding
/// 0 <= Phi_k s_k <= mu_static_k |Lambda_k| of joint j
/// ```
///
/// If another sliding velocity would reverse first, the impulse is scaled back so that it ends where that
/// velocity is zero. Joints at rest either stay at rest within static friction or are set in motion against
/// kinetic friction. With one degree of freedom, everything stops. The distribution between the contacts of
/// joint `j` is indeterminate; the one with the greatest margin is reported. This function does not check
/// whether the mechanism is jammed: it is if [`successors`](super::successors) is empty. Afterwards, ask for
/// the successors again, with the joints that have stopped; if there are none, the mechanism is still jammed.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, and more states than
/// are tried.
pub fn jam(mechanism: &Mechanism, configuration: &Configuration) -> Result<Jam, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    let impulses = Impulses::new(&instant);
    let velocities = impulses.velocities();
    let slides = |joint: &usize| instant.joints[*joint].has_friction && velocities[*joint] != 0.0;
    let moving: Vec<usize> = (0..velocities.len()).filter(slides).collect();
    if moving.is_empty() {
        return Ok(Jam::AtRest);
    }
    let search = ImpulseSearch { configuration, impulses: &impulses, velocities: &velocities };
    let mut found = ImpulsesFound::default();
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
struct ImpulsesFound {
    impulses: Vec<Impulse>,
    unsolved: usize,
}

struct ImpulseSearch<'s> {
    configuration: &'s Configuration,
    impulses: &'s Impulses<'s>,
    /// The sliding velocities (m/s), exactly zero where they are only rounding.
    velocities: &'s [f64],
}

impl ImpulseSearch<'_> {
    /// Looks for impulses in which this joint wedges.
    fn stop(&self, joint: usize, found: &mut ImpulsesFound) -> Result<(), Faults> {
        let groups = &self.impulses.instant.groups;
        let Some(group) = groups.iter().find(|group| group.joints.contains(&joint)) else {
            return Ok(());
        };
        let velocity = self.velocities[joint];
        let stopped = vec![false; self.velocities.len()];
        let mut jumps = vec![0.0; self.velocities.len()];
        jumps[joint] = -velocity;
        let mut question = self.impulses.question(&jumps, &stopped);
        question.opposes = Some((joint, velocity.signum()));
        let mut options: Vec<Vec<JointPhase>> = (0..self.velocities.len())
            .map(|joint| self.impulses.options(joint, self.velocities[joint]))
            .collect();
        options[joint] = vec![JointPhase::Sticking];
        let admissible = self.impulses.admissible(&question, &options, group)?;
        found.unsolved += admissible.unsolved;
        found.impulses.extend(admissible.list.iter().filter_map(|state| self.impulse(joint, state)));
        Ok(())
    }

    /// The impulse of an admissible state, up to where the first sliding velocity reaches zero; `None` if a
    /// joint that was at rest would slide in the direction of its friction.
    fn impulse(&self, joint: usize, state: &Assessment) -> Option<Impulse> {
        let instant = self.impulses.instant;
        let whole = self.impulses.frictions(state);
        let jumps = instant.influence.of_friction(&whole);
        let part = self.part(&state.phase, &jumps)?;
        let jumps = jumps * part;
        let sliding_velocities: Vec<f64> =
            (0..self.velocities.len()).map(|joint| self.sliding_after(joint, &state.phase, &jumps)).collect();
        let rest = instant.joints.iter().zip(&sliding_velocities).filter(|(_, after)| **after == 0.0);
        let after = self.impulses.moved(self.configuration, &jumps);
        let normals = state.forces.normal.iter().enumerate();
        Some(Impulse {
            wedged: instant.joints[joint].id,
            at_rest: rest.map(|(joint, _)| joint.id).collect(),
            normal_impulses: normals.map(|(k, normal)| normal * self.impulses.unit(k) * part).collect(),
            friction_impulses: whole.into_iter().map(|friction| friction.times(part)).collect(),
            energy_lost: kinetic(instant.mechanism, self.configuration) - kinetic(instant.mechanism, &after),
            after,
            sliding_velocities,
            margin: state.least(),
        })
    }

    /// The fraction of an impulse after which the first sliding velocity is zero; `None` if a joint that was
    /// at rest would slide the other way.
    fn part(&self, phase: &Phase, jumps: &DVector<f64>) -> Option<f64> {
        let mut part = 1.0_f64;
        for (index, joint) in self.impulses.instant.joints.iter().enumerate() {
            let JointPhase::Sliding(sign) = phase.joints[index] else { continue };
            let jump = sign * joint.row.change(jumps);
            if !joint.has_friction || jump >= -AT_REST * self.impulses.speed {
                continue;
            }
            if self.velocities[index] == 0.0 {
                return None;
            }
            part = part.min(joint.velocity.abs() / -jump);
        }
        Some(part)
    }

    /// Sliding velocity of a joint afterwards, exactly zero where it has stopped.
    fn sliding_after(&self, joint: usize, phase: &Phase, jumps: &DVector<f64>) -> f64 {
        let sticks = phase.joints[joint] == JointPhase::Sticking && self.velocities[joint] == 0.0;
        let joint = &self.impulses.instant.joints[joint];
        if sticks { 0.0 } else { self.impulses.without_rounding(joint.velocity + joint.row.change(jumps)) }
    }
}
