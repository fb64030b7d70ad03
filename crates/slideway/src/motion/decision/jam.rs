//! Dynamic jamming: the impulse that stops a mechanism that has no admissible acceleration (theory, section
//! 8).

use super::assessment::Assessment;
use super::impulse::{AT_REST, Impulses};
use super::instant::Instant;
use super::outputs::Group;
use super::rules::HaltingImpulse;
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::influence::ContactFriction;
use crate::mechanism::Mechanism;
use crate::motion::moving::energy::kinetic;
use crate::pattern::{JointPhase, Phase};
use crate::progress::Work;
use nalgebra::DVector;

/// The effect of an impulse that ends a jam.
#[derive(Debug, Clone)]
pub struct Impulse {
    /// The joint or hinge with friction that wedges; its tangential impulse, or its couple, is a reaction.
    pub(crate) wedged: JointId,
    /// The sliding joints and hinges with friction without velocity afterwards: those that stopped first, and those that were at rest
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
    /// The jumps of all unknowns.
    pub(super) jumps: DVector<f64>,
}

impl From<Impulse> for HaltingImpulse {
    fn from(impulse: Impulse) -> Self {
        Self { velocities: impulse.after.velocities, energy_lost: impulse.energy_lost }
    }
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
    jam_within(mechanism, configuration, (&|_| false, Work::undisturbed()))
}

/// The impulses of [`jam`], where some of the sliding joints and hinges with friction are known to be at rest whatever rounding
/// leaves of their velocities, in work that may end: then some are missing.
///
/// # Errors
/// As [`jam`].
pub(super) fn jam_within(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (rests, work): (&dyn Fn(usize) -> bool, Work<'_>),
) -> Result<Jam, Faults> {
    let instant = Instant::new(mechanism, configuration)?;
    let impulses = Impulses::new(&instant, work);
    let mut velocities = impulses.velocities();
    velocities
        .iter_mut()
        .enumerate()
        .filter(|(number, _)| rests(*number))
        .for_each(|(_, velocity)| *velocity = 0.0);
    let slides = |number: &usize| instant.may_stick(*number) && velocities[*number] != 0.0;
    let moving: Vec<usize> = (0..velocities.len()).filter(slides).collect();
    if moving.is_empty() {
        return Ok(Jam::AtRest);
    }
    let search = ImpulseSearch { configuration, impulses: &impulses, velocities: &velocities };
    let mut found = ImpulsesFound::default();
    for number in &moving {
        search.stop(std::slice::from_ref(number), &mut found)?;
    }
    let rough = if found.impulses.is_empty() { &instant.groups[..] } else { &[] };
    for group in rough.iter().filter(|group| !group.hinges.is_empty()) {
        let all: Vec<usize> =
            group.members(instant.joints.len()).filter(|number| moving.contains(number)).collect();
        if all.len() > 1 {
            search.stop(&all, &mut found)?;
        }
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
    /// The velocities of the sliding joints and hinges with friction (m/s), exactly zero where they are only rounding.
    velocities: &'s [f64],
}

impl ImpulseSearch<'_> {
    /// Looks for impulses in which this joint or hinge wedges, or these of a group together.
    fn stop(&self, wedged: &[usize], found: &mut ImpulsesFound) -> Result<(), Faults> {
        let instant = self.impulses.instant;
        // What is driven goes on: its impulse would move nothing, and so nothing moves it.
        if !wedged.iter().all(|number| instant.is_movable(*number, &[])) {
            return Ok(());
        }
        let Instant { groups, joints, .. } = instant;
        let is_of = |group: &&Group| group.members(joints.len()).any(|number| number == wedged[0]);
        let Some(group) = groups.iter().find(is_of) else { return Ok(()) };
        let stopped = vec![false; self.velocities.len()];
        let mut jumps = vec![0.0; self.velocities.len()];
        wedged.iter().for_each(|number| jumps[*number] = -self.velocities[*number]);
        let mut question = self.impulses.question(&jumps, &stopped);
        if let [number] = wedged {
            question.opposes = Some((*number, self.velocities[*number].signum()));
        }
        let mut options: Vec<Vec<JointPhase>> = (0..self.velocities.len())
            .map(|joint| self.impulses.options(joint, self.velocities[joint]))
            .collect();
        wedged.iter().for_each(|number| options[*number] = vec![JointPhase::Sticking]);
        let admissible = self.impulses.admissible(&question, &options, group)?;
        found.unsolved += admissible.unsolved;
        found.impulses.extend(admissible.list.iter().filter_map(|state| self.impulse(wedged[0], state)));
        Ok(())
    }

    /// The impulse of an admissible state, up to where the first sliding velocity reaches zero; `None` if a
    /// joint that was at rest would slide in the direction of its friction.
    fn impulse(&self, wedged: usize, state: &Assessment) -> Option<Impulse> {
        let instant = self.impulses.instant;
        let whole = self.impulses.frictions(state);
        let jumps = self.impulses.jumps(state);
        let part = self.part(&state.phase, &jumps)?;
        let jumps = jumps * part;
        let velocities: Vec<f64> =
            (0..self.velocities.len()).map(|number| self.after(number, &state.phase, &jumps)).collect();
        let rest = (0..velocities.len()).filter(|number| velocities[*number] == 0.0);
        let after = self.impulses.moved(self.configuration, &jumps);
        let normals = state.forces.normal.iter().enumerate();
        Some(Impulse {
            wedged: instant.id_of(wedged)?,
            at_rest: rest.filter_map(|number| instant.id_of(number)).collect(),
            normal_impulses: normals.map(|(k, normal)| normal * self.impulses.unit(k) * part).collect(),
            friction_impulses: whole.into_iter().map(|friction| friction.times(part)).collect(),
            energy_lost: kinetic(instant.mechanism, self.configuration) - kinetic(instant.mechanism, &after),
            after,
            sliding_velocities: velocities[..instant.joints.len()].to_vec(),
            margin: state.least(),
            jumps,
        })
    }

    /// The fraction of an impulse after which the first sliding velocity is zero; `None` if a joint that was
    /// at rest would slide the other way.
    fn part(&self, phase: &Phase, jumps: &DVector<f64>) -> Option<f64> {
        let mut part = 1.0_f64;
        let instant = self.impulses.instant;
        for (number, velocity) in self.velocities.iter().enumerate() {
            let JointPhase::Sliding(sign) = phase.of(number) else { continue };
            let jump = sign * instant.change(number, jumps);
            if !instant.may_stick(number) || jump >= -AT_REST * self.impulses.speeds[number] {
                continue;
            }
            if *velocity == 0.0 {
                return None;
            }
            part = part.min(instant.velocity(number).abs() / -jump);
        }
        Some(part)
    }

    /// Velocity of a joint or hinge afterwards, exactly zero where it has stopped.
    fn after(&self, number: usize, phase: &Phase, jumps: &DVector<f64>) -> f64 {
        let instant = self.impulses.instant;
        if phase.of(number) == JointPhase::Sticking && self.velocities[number] == 0.0 {
            return 0.0;
        }
        self.impulses.without_rounding(number, instant.velocity(number) + instant.change(number, jumps))
    }
}
