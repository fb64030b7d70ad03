//! Contacts that may lift off, at an instant: each set of those that touch is tried as open, with the mechanism as it
//! touches then.
//!
//! ```text
//! closed   N_k >= 0, acceleration of the gap = 0         apart   N_k = 0, acceleration of the gap >= 0
//! ```
//!
//! What is apart has no rows, so that all other states are those of a mechanism without it; that its gap does not close is one
//! more inequality of that mechanism. Where a normal force has just vanished, both it and the acceleration of the gap are
//! zero, and how these go on decides.

use super::elastic::verdict_on;
use super::impulse::AT_REST;
use super::jam::{Jam, jam_within};
use super::joints::TOUCHES;
use super::parts::SAME;
use super::rules::{Continuation, Continuations, EventInstant, HaltingImpulse};
use super::sticking::phase_state;
use super::successors::{Successor, Successors};
use super::{DeterminedForces, MOST_STATES, PhaseBound, Standing};
use crate::configuration::{Configuration, Mobility, Velocity};
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::motion::moving::connected::{connected, parts_of_contacts};
use crate::pattern::{ContactPhase, JointPhase, Phase};
use crate::report::Verdict;
use nalgebra::DVector;
use std::cmp::Reverse;
use std::rc::Rc;

/// Below this part of the velocity of the least flight a gap does not open.
const LITTLE_FLIGHT: f64 = 1e-3;

/// A mechanism of which some contacts that may lift off are open.
pub(super) struct Touching<'m> {
    pub(super) whole: &'m Mechanism,
    open: Vec<usize>,
    /// The contacts that are left, by their numbers in the whole.
    kept: Vec<usize>,
    /// The mechanism as it touches.
    pub(super) mechanism: Mechanism,
}

impl<'m> Touching<'m> {
    /// The mechanism while the contacts that are apart and some of those that touch are open.
    pub(super) fn new(whole: &'m Mechanism, apart: &[usize], left: &[usize]) -> Self {
        let mut open = [apart, left].concat();
        open.sort_unstable();
        let kept = (0..whole.contacts.len()).filter(|k| !open.contains(k)).collect();
        Self { mechanism: whole.touching(&open, |k| left.contains(&k)), whole, open, kept }
    }

    /// The mechanism in a phase.
    pub(super) fn in_phase(whole: &'m Mechanism, phase: &Phase) -> Self {
        Self::new(whole, &phase.open(whole), &[])
    }

    /// Returns its part of a phase of the whole mechanism.
    pub(super) fn part_of(&self, phase: &Phase) -> Phase {
        Phase { contacts: self.kept.iter().map(|&k| phase.contacts[k]).collect(), ..phase.clone() }
    }

    /// The number in the whole of a contact that is left.
    pub(super) fn number(&self, contact: ContactId) -> usize {
        self.kept[contact.index()]
    }

    /// A list of values, one for each contact that is left, for all contacts.
    pub(super) fn of_all<T: Copy>(&self, values: &[T], open: T) -> Vec<T> {
        let mut all = vec![open; self.whole.contacts.len()];
        self.kept.iter().zip(values).for_each(|(&k, value)| all[k] = *value);
        all
    }

    /// Which of the sliding joints do not touch at all.
    fn is_apart(&self) -> Vec<bool> {
        self.mechanism.sliders().map(|(_, slider)| slider.contacts.is_empty()).collect()
    }

    /// A phase of it as one of the whole mechanism.
    fn whole(&self, phase: &Phase) -> Phase {
        let mut whole =
            Phase { contacts: self.of_all(&phase.contacts, ContactPhase::PreloadGap), ..phase.clone() };
        for (joint, apart) in whole.joints.iter_mut().zip(self.is_apart()) {
            if apart {
                *joint = JointPhase::Sliding(1.0);
            }
        }
        whole
    }

    /// Returns whether the rows of the contacts that are left depend on one another. Whatever they do together, they do without
    /// one of these as well, whose gap does not change: each way to share what they carry is a mean of ways without one.
    pub(super) fn is_redundant(&self, configuration: &Configuration) -> bool {
        Mobility::of(&self.mechanism, configuration).excess() > self.mechanism.excess.rows.len()
    }

    /// The phases of it in which the mechanism can go on; none where contacts that are left out do as well.
    fn successors(&self, event: &EventInstant<'_>) -> Result<Successors, Faults> {
        let apart = self.is_apart();
        let signs: Vec<f64> =
            event.signs.iter().zip(apart).map(|(sign, apart)| if apart { 1.0 } else { *sign }).collect();
        let previous = event.previous.filter(|phase| phase.open(self.whole) == self.open);
        let previous = previous.map(|phase| self.part_of(phase));
        let place = |contact: &ContactId| self.kept.iter().position(|&k| k == contact.index()).map(ContactId);
        let zero: Vec<ContactId> = match &previous {
            Some(_) => event.zero.iter().filter_map(place).collect(),
            None => Vec::new(),
        };
        let event = EventInstant {
            mechanism: &self.mechanism,
            signs: &signs,
            zero: &zero,
            previous: previous.as_ref(),
            ..*event
        };
        match super::successors::continuations(&event) {
            Err(_) if self.is_redundant(event.configuration) => {
                Ok(Successors { complete: true, ..Successors::default() })
            }
            found => found,
        }
    }
}

/// A phase that can follow, with what its place in the order depends on.
struct Candidate {
    continuation: Continuation,
    /// Joints that stick on, and joints that stick.
    sticking: [usize; 2],
    /// True if only rounding keeps what has vanished from going on to fall.
    is_over: bool,
    is_present: bool,
    open: usize,
}

/// The phases in which a mechanism can go on some of whose contacts may lift off, in the order of
/// [`successors`](super::successors()).
///
/// # Errors
/// As [`successors`](super::successors()), for each set of contacts that touch.
pub(super) fn continuations(event: &EventInstant<'_>) -> Result<Continuations, Faults> {
    let mechanism = event.mechanism;
    let (apart, sets) = sets_of_open(event)?;
    let before = accelerations_before(event)?;
    let mut found = Continuations::default();
    let mut candidates: Vec<(Candidate, Rc<Touching<'_>>, Phase)> = Vec::new();
    for left in sets {
        if event.work.is_over() {
            break;
        }
        let touching = Rc::new(Touching::new(mechanism, &apart, &left));
        let successors = touching.successors(event)?;
        found.left_out |= !successors.complete || !successors.unsolved.is_empty();
        for successor in successors.list {
            let candidate = candidate(event, (&touching, &successor, left.len()), before.as_ref());
            candidates.push((candidate, Rc::clone(&touching), successor.phase));
        }
    }
    if candidates.len() > 1 {
        for (candidate, touching, phase) in &mut candidates {
            if candidate.continuation.verdict == Verdict::NotComputed {
                candidate.continuation.verdict = verdict_on(&touching.mechanism, event.configuration, phase);
            }
        }
    }
    candidates.sort_by_key(|(candidate, ..)| {
        let Candidate { continuation, sticking, is_over, is_present, open } = candidate;
        let is_threshold = continuation.verdict == Verdict::Unattainable;
        (sticking.map(Reverse), *is_over, is_threshold, !is_present, !continuation.continues, *open)
    });
    found.list = candidates.into_iter().map(|(candidate, ..)| candidate.continuation).collect();
    Ok(found)
}

/// The guided sliders that would tip in one of the sets of contacts that may be open.
///
/// # Errors
/// As [`continuations`].
pub(super) fn tipping(event: &EventInstant<'_>) -> Result<Vec<JointId>, Faults> {
    let mut joints = Vec::new();
    let (apart, sets) = sets_of_open(event)?;
    for left in sets {
        let found = Touching::new(event.mechanism, &apart, &left).successors(event)?;
        joints.extend(found.tipping.into_iter().flat_map(|tipping| tipping.joints));
    }
    Ok(joints)
}

/// The impulse without collision that ends a jam: of those with the fewest contacts that it lifts off, that with the greatest
/// margin.
///
/// # Errors
/// As [`jam`](super::jam()), for each set of contacts that touch.
pub(super) fn jam(event: &EventInstant<'_>) -> Result<Option<HaltingImpulse>, Faults> {
    let rests = |number: usize| event.sign_of(number) == 0.0;
    let (apart, sets) = sets_of_open(event)?;
    for left in sets {
        let touching = Touching::new(event.mechanism, &apart, &left);
        let found = match jam_within(&touching.mechanism, event.configuration, (&rests, event.work)) {
            Err(_) if touching.is_redundant(event.configuration) => continue,
            found => found?,
        };
        let Jam::Stops(impulses) = found else { continue };
        return Ok(impulses.into_iter().next().map(HaltingImpulse::from));
    }
    Ok(None)
}

/// The contacts that are apart at an instant, and the sets of those that touch which may be open, too.
///
/// # Errors
/// More contacts touch than all sets are tried of; no free bodies.
fn sets_of_open(event: &EventInstant<'_>) -> Result<(Vec<usize>, Vec<Vec<usize>>), Faults> {
    let EventInstant { mechanism, configuration, previous, .. } = *event;
    let speed = |v: &Velocity| v.linear.amax().max(v.angular.abs() * mechanism.size);
    let fastest = configuration.velocities.iter().map(speed).fold(0.0, f64::max);
    let least = least_flights(mechanism, configuration)?;
    let is_apart = |contact: &ContactId| {
        let [gap, rate] = configuration.gap(mechanism, *contact);
        let little = (AT_REST * fastest).max(LITTLE_FLIGHT * least[contact.index()]);
        let was_closed = previous.is_some_and(|phase| !phase.is_open(mechanism, contact.index()));
        !was_closed && (gap > TOUCHES * mechanism.size || rate > little)
    };
    let (apart, touching): (Vec<ContactId>, Vec<ContactId>) = mechanism.one_sided().partition(is_apart);
    let numbers = |contacts: Vec<ContactId>| contacts.into_iter().map(ContactId::index).collect::<Vec<_>>();
    Ok((numbers(apart), subsets(&numbers(touching))?))
}

/// For each contact the velocity `u` with which it leaves its face for a flight that rounding of places hides, `u^2/(2 a) = d` with
/// the least length `d` and the greatest acceleration `a`, without contacts that may lift off, of the bodies that are connected with
/// its own (m/s).
///
/// # Errors
/// As [`KineticEquations::new`].
pub(super) fn least_flights(
    mechanism: &Mechanism,
    configuration: &Configuration,
) -> Result<Vec<f64>, Faults> {
    let all: Vec<usize> = mechanism.one_sided().map(ContactId::index).collect();
    let free = mechanism.without_contacts(&all);
    let unknowns = KineticEquations::new(&free, configuration)?.frictionless();
    let bodies = unknowns.rows(0, mechanism.accelerations());
    let in_metres = |(index, value): (usize, &f64)| {
        value.abs() * if mechanism.is_rotation(index) { mechanism.size } else { 1.0 }
    };
    let parts = connected(mechanism);
    let flight = |part: Option<usize>| {
        let own = bodies
            .iter()
            .enumerate()
            .filter(|(index, _)| Some(parts[mechanism.body_of_acceleration(*index)]) == part);
        let greatest = own.map(in_metres).fold(0.0, f64::max);
        (2.0 * greatest * TOUCHES * mechanism.size).sqrt()
    };
    Ok(parts_of_contacts(mechanism).into_iter().map(flight).collect())
}

/// All sets of some of these, the empty one first.
///
/// # Errors
/// There are more than are tried.
pub(super) fn subsets(of: &[usize]) -> Result<Vec<Vec<usize>>, Faults> {
    let states = of.iter().fold(1_u64, |states, _| states.saturating_mul(2));
    if states > MOST_STATES {
        return Err(Fault::general(FaultKind::TooManyStates { states, limit: MOST_STATES }).into());
    }
    let chosen = |set: u64| of.iter().enumerate().filter(move |(at, _)| set >> at & 1 == 1).map(|(_, k)| *k);
    Ok((0..states).map(|set| chosen(set).collect()).collect())
}

/// The accelerations of all bodies in the phase that has ended, at its end.
fn accelerations_before(event: &EventInstant<'_>) -> Result<Option<DVector<f64>>, Faults> {
    let EventInstant { mechanism, configuration, previous, .. } = *event;
    let Some(previous) = previous else { return Ok(None) };
    let touching = Touching::in_phase(mechanism, previous);
    let state = phase_state(&touching.mechanism, configuration, &touching.part_of(previous))?;
    Ok(state.map(|state| of_bodies(mechanism, &state.unknowns)))
}

fn of_bodies(mechanism: &Mechanism, unknowns: &DVector<f64>) -> DVector<f64> {
    unknowns.rows(0, mechanism.accelerations()).into_owned()
}

fn candidate(
    event: &EventInstant<'_>,
    (touching, successor, open): (&Touching<'_>, &Successor, usize),
    before: Option<&DVector<f64>>,
) -> Candidate {
    let phase = touching.whole(&successor.phase);
    let sticks = |phase: &Phase, number: usize| phase.joints[number] == JointPhase::Sticking;
    let stuck = || (0..phase.joints.len()).filter(|&number| sticks(&phase, number));
    let stayed = stuck().filter(|&number| event.previous.is_some_and(|before| sticks(before, number)));
    let now = of_bodies(event.mechanism, &successor.state.unknowns);
    let continues = before.is_some_and(|before| (&now - before).amax() <= SAME * before.amax());
    let undecided = matches!(&successor.standing, Standing::Undecided(bounds)
        if bounds.iter().any(|bound| matches!(bound, PhaseBound::NormalForce(_))));
    Candidate {
        sticking: [stayed.count(), stuck().count()],
        is_over: successor.is_present && undecided && !event.zero.is_empty(),
        is_present: successor.is_present,
        open,
        continuation: Continuation {
            phase,
            verdict: successor.attainability.verdict,
            continues,
            impulse: None,
        },
    }
}

/// The forces that statics determines in a phase, in the mechanism as it touches; zero where contacts are open.
///
/// # Errors
/// As [`determined_forces`](super::determined_forces).
pub(super) fn determined_forces(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Result<DeterminedForces, Faults> {
    let touching = Touching::in_phase(mechanism, phase);
    let part = touching.part_of(phase);
    let forces = super::determined_forces(&touching.mechanism, configuration, &part)?;
    Ok(DeterminedForces { contacts: touching.of_all(&forces.contacts, [Some(0.0); 2]), ..forces })
}
