//! Mechanisms with friction in hinges: which phases can follow, how long hinges stick (theory of hinges, section 9).
//!
//! The magnitudes of hinge forces enter, so that the forces of a pattern are not linear in friction, and a pattern may
//! have several solutions. All states of the joints and hinges at rest are tried that their accelerations can have over
//! the motions of the mechanism, with all sides of the contacts, by the same programs as at rest; their solutions are
//! those in which the motion can go on. The solution that is followed is one of them, known by the forces of its hinges.

use super::joints::touched_stop;
use super::rules::{Continuation, Continuations, EventInstant, Hold, Outlook, Resting};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::ContactId;
use crate::kinetics::{KineticEquations, SlidingRow};
use crate::mechanism::Mechanism;
use crate::modes::Side;
use crate::motion::moving::amounts::Amounts;
use crate::motion::moving::equations::Equations;
use crate::motion::moving::magnitudes::Magnitudes;
use crate::motion::moving::switching::Switching;
use crate::motion::moving::watch::{Watch, Watched};
use crate::pattern::phase::sliding_joints;
use crate::pattern::{ContactPhase, HingePhase, JointPhase, Phase, direction};
use crate::report::Verdict;
use crate::standstill::{MotionState, Pattern, Setup, motion_states, sticking_slack};
use nalgebra::DVector;

/// Accelerations that differ by less than this part of the greatest are the same.
pub(super) const SAME: f64 = 1e-6;
/// Forces of hinges that differ by less than this part of the greatest are the same.
const SAME_FORCE: f64 = 1e-6;
/// What is watched is at its boundary below this part of its unit.
const BOUNDARY: f64 = 1e-7;
/// What changes by less than this part of its unit a little later stays what it is, ...
const STAYS: f64 = 1e-10;
/// ... and a velocity that is greater than this begins.
const MOVES: f64 = 1e-13;
/// Parts of the time in which the mechanism moves through its own size after which a phase is looked at again.
const LATER: [f64; 3] = [1e-4, 1e-3, 1e-2];

/// A mechanism at an instant, with the friction at its sliding speeds, and the signs of the velocities of its sliding
/// joints and hinges with friction: 0 where they have to stick, nothing where the acceleration decides.
///
/// # Errors
/// Whatever [`KineticEquations::new`] refuses, and friction without a value.
pub(super) fn setup(
    mechanism: &Mechanism,
    configuration: &Configuration,
    (signs, rounding): (&[Option<f64>], f64),
) -> Result<Setup, Faults> {
    mechanism.check_no_press_fit("what follows in time")?;
    mechanism.check_no_one_sided("what follows in time")?;
    mechanism.check_determinate("what follows in time")?;
    let equations = KineticEquations::new(mechanism, configuration)?;
    let mut at_speeds = mechanism.clone();
    for k in (0..mechanism.contacts.len()).filter(|&k| mechanism.contacts[k].depends_on_speed()) {
        let speed = equations.contacts[k].sliding_velocity.abs();
        at_speeds.contacts[k].mu =
            mechanism.friction_of(ContactId(k), speed, configuration.pieces.as_deref())?;
    }
    let force = super::scale_of_forces(mechanism, configuration, &|_| true).max(rounding);
    let mut setup = Setup::in_motion(at_speeds, configuration, (signs, force))?;
    let sliders = sliding_joints(mechanism).into_iter().filter_map(|joint| mechanism.slider(joint));
    setup.stops = sliders.map(|slider| touched_stop(mechanism, configuration, slider)).collect();
    Ok(setup)
}

/// The velocities of the sliding joints, then of the hinges with friction (m/s, rad/s).
pub(in crate::motion) fn relative_velocities(
    mechanism: &Mechanism,
    configuration: &Configuration,
) -> Vec<f64> {
    let sliders = sliding_joints(mechanism).into_iter().filter_map(|joint| mechanism.slider(joint));
    let sliding = sliders.map(|slider| configuration.sliding(mechanism, slider).1);
    let turning = mechanism.friction_circles.iter().map(|circle| {
        mechanism.hinge(circle.joint).map_or(0.0, |[first, second]| {
            configuration.angular_velocity(first.frame) - configuration.angular_velocity(second.frame)
        })
    });
    sliding.chain(turning).collect()
}

/// The phases that can follow at an instant, in order of preference: those in which more stays stuck, and more sticks; the
/// present one; one that continues it; those that are not unattainable.
///
/// # Errors
/// As [`setup`], and more states than are tried.
pub(super) fn continuations(event: &EventInstant<'_>) -> Result<Continuations, Faults> {
    let EventInstant { mechanism, configuration, signs, spins, previous, .. } = *event;
    let signs = signs.iter().chain(spins).map(|sign| Some(*sign).filter(|sign| *sign != 0.0));
    let signs: Vec<Option<f64>> = signs.collect();
    let setup = setup(mechanism, configuration, (&signs, event.greatest_rounding()))?;
    let (found, undecided) = motion_states(&setup, event.work)?;
    let mut candidates: Vec<Candidate> = Vec::new();
    for state in found {
        let phase = phase_of(&setup, state);
        let Some(candidate) = Candidate::new(event, phase)? else { continue };
        if !candidates.iter().any(|other| other.is_same(&candidate, mechanism)) {
            candidates.push(candidate);
        }
    }
    let present = previous.and_then(|phase| Candidate::at(event, phase.clone()));
    for candidate in &mut candidates {
        candidate.continues = present.as_ref().is_some_and(|present| present.accelerates_like(candidate));
    }
    candidates.sort_by_key(|candidate| candidate.rank(previous));
    let one = |candidate: Candidate| Continuation {
        verdict: if candidate.orientation < 0.0 { Verdict::Unattainable } else { Verdict::NotComputed },
        continues: candidate.continues,
        phase: candidate.phase,
    };
    Ok(Continuations { list: candidates.into_iter().map(one).collect(), left_out: undecided > 0 })
}

/// The phase of a state. A joint without friction always slides, unless its stop holds it.
fn phase_of(setup: &Setup, state: MotionState) -> Phase {
    let slides = |(slider, phase): (usize, &JointPhase)| {
        let is_free = !setup.rubs(slider) && setup.stops[slider] == 0.0;
        if is_free && *phase == JointPhase::Sticking { JointPhase::Sliding(1.0) } else { *phase }
    };
    let hinges = state.pattern.hinges.iter().zip(state.forces);
    Phase {
        joints: state.pattern.joints.iter().enumerate().map(slides).collect(),
        contacts: state.pattern.contacts,
        hinges: hinges.map(|(state, force)| HingePhase { state: *state, force }).collect(),
    }
}

/// A phase that may follow.
struct Candidate {
    phase: Phase,
    accelerations: Vec<f64>,
    /// The sign of the determinant, beside that without friction.
    orientation: f64,
    continues: bool,
}

impl Candidate {
    /// A phase, unless its equations have no solution, or something at its boundary does not move away from it.
    ///
    /// # Errors
    /// As [`setup`].
    fn new(event: &EventInstant<'_>, phase: Phase) -> Result<Option<Self>, Faults> {
        let Some(candidate) = Self::at(event, phase) else { return Ok(None) };
        let phase = &candidate.phase;
        let turns = phase.hinges.iter().any(|hinge| hinge.state != JointPhase::Sticking);
        let sticks = !(turns && phase.sticks())
            || sticking_margin(event.mechanism, event.configuration, phase)? >= -BOUNDARY;
        Ok((sticks && lasts(event, phase)).then_some(candidate))
    }

    /// A phase with its accelerations.
    fn at(event: &EventInstant<'_>, mut phase: Phase) -> Option<Self> {
        let equations = entered(event.mechanism, event.configuration, &phase)?;
        for (index, hinge) in phase.hinges.iter_mut().enumerate() {
            hinge.force = equations.hinge_force(index)?;
        }
        let accelerations = equations.accelerations().to_vec();
        let (smooth, pressed) = (frictionless(event.mechanism), without_gaps(&phase));
        let without_friction = entered(&smooth, event.configuration, &pressed)?.determinant();
        let orientation = equations.determinant().sign() * without_friction.sign();
        Some(Self { phase, accelerations, orientation, continues: false })
    }

    /// Whether two differ in nothing but the sides of contacts that stick.
    fn is_same(&self, other: &Self, mechanism: &Mechanism) -> bool {
        let forces = |phase: &Phase| phase.hinges.iter().flat_map(|hinge| hinge.force).collect::<Vec<f64>>();
        self.phase.joints_and_hinges().eq(other.phase.joints_and_hinges())
            && self.phase.pattern(mechanism) == other.phase.pattern(mechanism)
            && self.accelerates_like(other)
            && (self.phase.is_at_rest() || near(&forces(&self.phase), &forces(&other.phase), SAME_FORCE))
    }

    fn accelerates_like(&self, other: &Self) -> bool {
        near(&self.accelerations, &other.accelerations, SAME)
    }

    /// Less is preferred.
    fn rank(&self, previous: Option<&Phase>) -> [usize; 5] {
        let sticking = |phase: &Phase| {
            phase.joints_and_hinges().map(|joint| joint == JointPhase::Sticking).collect::<Vec<_>>()
        };
        let now = sticking(&self.phase);
        let before = previous.map_or_else(|| vec![false; now.len()], sticking);
        let leaves = before.iter().zip(&now).filter(|(before, now)| **before && !**now).count();
        let slides = now.iter().filter(|sticks| !**sticks).count();
        let changes = !previous.is_some_and(|previous| self.continues && previous.has_states_of(&self.phase));
        let last = [changes, !self.continues, self.orientation < 0.0].map(usize::from);
        [leaves, slides, last[0], last[1], last[2]]
    }
}

pub(super) fn near(one: &[f64], other: &[f64], part: f64) -> bool {
    let greatest = one.iter().chain(other).fold(0.0_f64, |greatest, value| greatest.max(value.abs()));
    one.iter().zip(other).all(|(one, other)| (one - other).abs() <= part * greatest)
}

/// The mechanism without friction.
pub(super) fn frictionless(mechanism: &Mechanism) -> Mechanism {
    let mut smooth = mechanism.clone();
    for contact in &mut smooth.contacts {
        (contact.mu, contact.preload, contact.law) = ([0.0; 2], [0.0; 2], [None; 2]);
    }
    smooth.friction_circles.iter_mut().for_each(|circle| circle.radius = 0.0);
    smooth
}

/// A phase of a mechanism without friction: no preload leaves a gap there, and no side matters.
fn without_gaps(phase: &Phase) -> Phase {
    Phase { contacts: vec![ContactPhase::Pressed(Side::Positive); phase.contacts.len()], ..phase.clone() }
}

/// The equations of a phase at an instant, if they have a solution.
fn entered<'m>(
    mechanism: &'m Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Option<Equations<'m>> {
    let mut equations = Equations::new(mechanism, configuration);
    equations.follow(phase.hinges.iter().map(|hinge| hinge.force));
    let state = equations.state_of(configuration);
    equations.enter(phase, configuration.time, &state).ok()?;
    Some(equations)
}

/// Whether everything that is watched in a phase is within its bounds, and what is at its boundary moves away from it, which
/// is looked at a little later in its own motion; what stays at its boundary may last. Where velocities that begin are
/// too small to be told from rounding, which they are under loads that grow slowly, it is looked at later still.
fn lasts(event: &EventInstant<'_>, phase: &Phase) -> bool {
    let EventInstant { mechanism, configuration, .. } = *event;
    let Some(bounds) = WatchedPhase::new(event, phase) else { return false };
    let (equations, units) = (&bounds.equations, &bounds.units);
    let values = bounds.values();
    let begins = |watched: &Watched| match *watched {
        Watched::Velocity(joint, _) => event.signs[joint] == 0.0,
        Watched::Spin(hinge, _) => event.spins[hinge] == 0.0,
        _ => false,
    };
    if values.iter().any(|(_, value)| *value < -BOUNDARY) {
        return false;
    }
    let at_boundary = |(watched, value): &&(Watched, f64)| {
        if is_speed(watched) { begins(watched) } else { *value <= BOUNDARY }
    };
    let at_boundary: Vec<&(Watched, f64)> = values.iter().filter(at_boundary).collect();
    let sticks_amid_motion = phase.sticks() && !phase.is_at_rest();
    if at_boundary.is_empty() && !sticks_amid_motion {
        return true;
    }
    let stuck = |equations: &Equations<'_>| stuck_velocities(equations, phase, units);
    let stuck_before = stuck(equations);
    for part in LATER {
        let Some(mut equations) = entered(mechanism, configuration, phase) else { return false };
        if later(&mut equations, configuration, part * units.time).is_none() {
            return false;
        }
        if stuck(&equations).iter().zip(&stuck_before).any(|(now, before)| (now - before).abs() > MOVES) {
            return false;
        }
        let changes = at_boundary.iter().map(|(watched, before)| {
            let least = if begins(watched) { MOVES } else { STAYS };
            (begins(watched), (bounds.value(*watched, &equations) - before) / least)
        });
        let changes: Vec<(bool, f64)> = changes.collect();
        if changes.iter().any(|(_, change)| *change < -1.0) {
            return false;
        }
        let is_told = part > LATER[0] || !sticks_amid_motion;
        if is_told && changes.iter().all(|(begins, change)| !begins || *change > 1.0) {
            return true;
        }
    }
    false
}

fn is_speed(watched: &Watched) -> bool {
    matches!(watched, Watched::Velocity(..) | Watched::Spin(..))
}

/// What bounds a phase at an instant.
struct WatchedPhase<'p> {
    phase: &'p Phase,
    equations: Equations<'p>,
    watch: Watch<'p>,
    units: Units,
}

impl<'p> WatchedPhase<'p> {
    /// Nothing where the equations of the phase have no solution.
    fn new(event: &EventInstant<'p>, phase: &'p Phase) -> Option<Self> {
        let equations = entered(event.mechanism, event.configuration, phase)?;
        let switching = Switching::new(event.mechanism, event.configuration);
        let mut watch = Watch::new(&[], None, Magnitudes::default());
        watch.begin(phase, &equations, &switching);
        let units = Units::of(&equations);
        Some(Self { phase, equations, watch, units })
    }

    /// The value of one with the equations a little later, in its unit.
    fn value(&self, watched: Watched, equations: &Equations<'_>) -> f64 {
        let value = self.watch.value(watched, self.phase, equations);
        value.map_or(f64::NEG_INFINITY, |value| value / self.units.of_watched(watched))
    }

    /// All, with their values.
    fn values(&self) -> Vec<(Watched, f64)> {
        let bounds = self.watch.list.iter().copied().filter(|watched| Units::counts(*watched));
        bounds.map(|watched| (watched, self.value(watched, &self.equations))).collect()
    }
}

/// Whether nothing happens at an instant: nothing has just stopped or reversed, and the present phase is at no boundary.
///
/// # Errors
/// As [`setup`].
pub(super) fn is_undisturbed(event: &EventInstant<'_>) -> Result<bool, Faults> {
    let Some(phase) = event.previous else { return Ok(false) };
    let signs = event.signs.iter().chain(event.spins);
    let sliders =
        sliding_joints(event.mechanism).into_iter().filter_map(|joint| event.mechanism.slider(joint));
    let rubs = sliders.map(|slider| {
        let mut contacts = slider.contacts.iter().map(|k| &event.mechanism.contacts[k.index()]);
        contacts.any(|contact| !contact.is_frictionless() || contact.mu_static != [0.0; 2])
    });
    let rubs = rubs.chain(event.spins.iter().map(|_| true));
    let mut states = phase.joints_and_hinges().zip(signs).zip(rubs);
    if states.any(|((state, sign), rubs)| rubs && state.sign() != *sign) {
        return Ok(false);
    }
    let bounds = WatchedPhase::new(event, phase);
    let inside = bounds.is_some_and(|bounds| {
        bounds.values().iter().all(|(watched, value)| is_speed(watched) || *value > BOUNDARY)
    });
    Ok(inside
        && (!phase.sticks() || sticking_margin(event.mechanism, event.configuration, phase)? > BOUNDARY))
}

/// The velocities of what sticks in a phase: one that no equation holds, since no motion moves it at once, goes on at a
/// dead centre.
fn stuck_velocities(equations: &Equations<'_>, phase: &Phase, units: &Units) -> Vec<f64> {
    let sliding = equations.sliders.iter().zip(&phase.joints).filter_map(|(joint, state)| {
        let slider = equations.mechanism.slider(*joint).filter(|_| *state == JointPhase::Sticking)?;
        Some(equations.contacts[slider.contacts[0].index()].sliding_velocity / units.velocity)
    });
    let turning = phase.hinges.iter().enumerate().filter(|(_, hinge)| hinge.state == JointPhase::Sticking);
    sliding.chain(turning.map(|(hinge, _)| equations.spin(hinge) * units.length / units.velocity)).collect()
}

/// Takes equations a little further in their own motion, by one step of Heun's method; nothing where they have no solution
/// there.
fn later(equations: &mut Equations<'_>, configuration: &Configuration, step: f64) -> Option<()> {
    let mut state = equations.state_of(configuration);
    let bodies = 3 * equations.mechanism.bodies.len();
    let before = equations.accelerations().to_vec();
    for index in 0..bodies {
        state[index] += step * (state[bodies + index] + step / 2.0 * before[index]);
    }
    let start: Vec<f64> = state[bodies..2 * bodies].to_vec();
    let rates = |accelerations: &dyn Fn(usize) -> f64, state: &mut [f64]| {
        for index in 0..bodies {
            state[bodies + index] = start[index] + step * accelerations(index);
        }
    };
    rates(&|index| before[index], &mut state);
    equations.evaluate(configuration.time + step, &state).ok()?;
    let after = equations.accelerations().to_vec();
    rates(&|index| f64::midpoint(before[index], after[index]), &mut state);
    equations.evaluate(configuration.time + step, &state).ok()
}

/// Units in which what is watched is of order one.
struct Units {
    force: f64,
    length: f64,
    velocity: f64,
    time: f64,
}

impl Units {
    fn of(equations: &Equations<'_>) -> Self {
        let (mechanism, configuration) = (equations.mechanism, &equations.configuration);
        let length = mechanism.size;
        let speeds = configuration.velocities.iter().map(|v| v.linear.amax().max(v.angular.abs() * length));
        let accelerations = equations.accelerations().chunks_exact(3);
        let acceleration = accelerations
            .fold(0.0_f64, |a, body| a.max(body[0].abs()).max(body[1].abs()).max(body[2].abs() * length));
        let force = super::scale_of_forces(mechanism, configuration, &|_| true);
        let masses =
            mechanism.bodies.iter().map(|body| body.mass.max(body.moment_of_inertia / length.powi(2)));
        let mass = masses.fold(0.0, f64::max);
        let acceleration = if mass > 0.0 { acceleration.max(force / mass) } else { acceleration };
        let velocity = speeds.fold((acceleration * length).sqrt(), f64::max);
        let velocity = if velocity > 0.0 { velocity } else { 1.0 };
        Self { force, length, velocity, time: length / velocity }
    }

    /// Whether it bounds a phase at its beginning, as far as the equations of the phase tell.
    fn counts(watched: Watched) -> bool {
        matches!(
            watched,
            Watched::NormalForce(_)
                | Watched::Share(..)
                | Watched::Between(..)
                | Watched::Velocity(..)
                | Watched::Spin(..)
                | Watched::Couple(_)
                | Watched::Circles
        )
    }

    fn of_watched(&self, watched: Watched) -> f64 {
        match watched {
            Watched::Velocity(..) => self.velocity,
            Watched::Spin(..) => self.velocity / self.length,
            Watched::Couple(_) | Watched::Circles => self.force * self.length,
            Watched::NormalForce(_) | Watched::Between(..) => self.force,
            _ => 1.0,
        }
    }
}

/// The sliding accelerations (m/s^2) in a phase; nothing where its equations have no solution.
pub(super) fn sliding_accelerations(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Option<Vec<f64>> {
    let equations = entered(mechanism, configuration, phase)?;
    let accelerations = DVector::from_column_slice(equations.accelerations());
    let sliders = equations.sliders.iter().filter_map(|joint| mechanism.slider(*joint));
    let rows = sliders.map(|slider| SlidingRow::new(mechanism, configuration, slider));
    Some(rows.map(|row| row.acceleration(&accelerations)).collect())
}

/// By how much what sticks in a phase stays within its bounds; -1 where it cannot stick, or where that was not decided.
///
/// # Errors
/// As [`setup`].
pub(super) fn sticking_margin(
    mechanism: &Mechanism,
    configuration: &Configuration,
    phase: &Phase,
) -> Result<f64, Faults> {
    let signs: Vec<Option<f64>> = phase.joints_and_hinges().map(|joint| Some(joint.sign())).collect();
    let setup = setup(mechanism, configuration, (&signs, 0.0))?;
    let pattern = Pattern {
        joints: phase.joints.clone(),
        hinges: phase.hinges.iter().map(|hinge| hinge.state).collect(),
        contacts: phase.contacts.clone(),
    };
    let directions: Vec<[f64; 2]> = phase.hinges.iter().map(|hinge| direction(hinge.force)).collect();
    Ok(sticking_slack(&setup, &pattern, &directions).unwrap_or(super::sticking::NONE))
}

/// Bodies that stand still under loads that do not change with time: nothing changes for them.
pub(super) fn hold<'m>(
    mechanism: &'m Mechanism,
    configuration: &Configuration,
    resting: Resting<'_>,
) -> Option<Box<dyn Hold + 'm>> {
    let amounts = Amounts::new(mechanism, configuration, resting.bodies);
    if amounts.units().next().is_some() {
        return None;
    }
    Some(Box::new(Forever))
}

struct Forever;

impl Hold for Forever {
    fn outlook(&mut self, [_, until]: [f64; 2]) -> Result<Outlook, Faults> {
        Ok(Outlook { proven: until, slips: false })
    }

    fn margin(&mut self, _: f64) -> Result<f64, Faults> {
        Ok(1.0)
    }
}
