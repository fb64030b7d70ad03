//! Builds the report from the modes that were found.

use super::conclusion::{Conclusion, conclusion};
use super::found::{Elsewhere, Knowledge, Method, ModesFound};
use super::guarantee::{guarantee, is_examined, not_examined};
use super::report::{
    CountLimits, Direction, EndHingeForce, EndReaction, Known, LimitsMethod, LimitsReport, ModeLimits,
    RangeWithoutProblem, SCHEMA, SpeedLimits, VariedQuantity,
};
use super::varied::Varied;
use crate::configuration::{Configuration, unit};
use crate::fault::Faults;
use crate::mechanism::{Coordinate, Mechanism};
use crate::model::Model;
use crate::modes::ContactState;
use crate::modes::branches::Branch;
use crate::modes::existence::{CountInterval, EndCause, Limit, ModeEnd, ModeInterval};
use crate::report::{CoordinateState, JointMode, ModeEndCause, NO_DRIVE, Tipping};
use crate::solve::{joint_modes, pattern, signs, states};
use std::f64::consts::FRAC_1_SQRT_2;

impl VariedQuantity {
    pub(crate) fn new(varied: &Varied, [from, to]: [f64; 2], value: f64) -> Self {
        let (name, shown_in) = (varied.name.clone(), varied.shown_in.clone());
        Self { name, unit: varied.unit(), from, to, value, shown_in }
    }
}

/// The coordinates of a mechanism in its state, but for what is varied in a range and what depends on it.
pub(crate) fn held_state(mechanism: &Mechanism, varied: &Varied, range: [f64; 2]) -> Vec<CoordinateState> {
    let at_ends = range.map(|end| varied.model_at(end).and_then(|model| Mechanism::new(&model)).ok());
    let is_held = |(index, coordinate): &(usize, &Coordinate)| {
        let same = |other: &Mechanism| {
            let other = &other.coordinates[*index];
            (other.value, other.rate) == (coordinate.value, coordinate.rate)
        };
        *coordinate.name != *varied.name && at_ends.iter().flatten().all(same)
    };
    let held = mechanism.coordinates.iter().enumerate().filter(is_held).map(|(_, coordinate)| coordinate);
    held.map(|coordinate| CoordinateState {
        name: coordinate.name.to_string(),
        unit: unit(&coordinate.kind),
        value: coordinate.value,
        rate: coordinate.rate,
    })
    .collect()
}

impl RangeWithoutProblem {
    pub(crate) fn of(found: &ModesFound) -> Vec<Self> {
        let end = |at: f64| found.same_ends.told(at);
        let range =
            |gap: &super::found::Gap| Self { from: end(gap.from), to: end(gap.to), reason: gap.reason() };
        found.gaps.iter().map(range).collect()
    }

    /// Each with its reason.
    pub(crate) fn told(ranges: &[Self]) -> Vec<([f64; 2], &str)> {
        ranges.iter().map(|range| ([range.from, range.to], range.reason.as_str())).collect()
    }
}

/// The names of a mechanism's parts, and how its guides lie.
pub(crate) struct Naming {
    pub(crate) mechanism: Mechanism,
    configuration: Configuration,
}

impl Naming {
    /// # Errors
    /// A model that cannot be assembled in its state.
    pub(crate) fn new(model: &Model) -> Result<Self, Faults> {
        let mechanism = Mechanism::new(model)?;
        let configuration = Configuration::new(&mechanism)?;
        Ok(Self { mechanism, configuration })
    }

    fn joint_modes(&self, signs: &[i8]) -> Vec<JointMode> {
        joint_modes(&self.mechanism, &self.configuration, signs)
    }

    /// The contact modes of all joints in a pattern, in words.
    pub(crate) fn in_words(&self, pattern: &str) -> String {
        let signs = signs(&states(pattern));
        let words =
            self.joint_modes(&signs).into_iter().map(|joint| format!("{} {}", joint.name, joint.mode));
        words.collect::<Vec<_>>().join("; ")
    }

    fn contacts(&self, contacts: &[usize]) -> Vec<String> {
        contacts.iter().map(|&k| self.mechanism.contacts[k].name.to_string()).collect()
    }

    fn mode(
        &self,
        (mode, branch): (&ModeInterval, Option<&Branch>),
        speeds: &[SpeedLimits],
        found: &ModesFound,
    ) -> ModeLimits {
        let same_ends = found.same_ends;
        let end = |at: f64| finite(at).map(|at| same_ends.told(at));
        let speed = |speed: &SpeedLimits| SpeedLimits {
            from: same_ends.told(speed.from),
            to: same_ends.told(speed.to),
            ..speed.clone()
        };
        let closed = |k: usize| self.mechanism.is_closed(&mode.pattern, k);
        let [from, to] = [&mode.from, &mode.to].map(|end| self.reactions(&mode.pattern, end));
        // A block that floats within its play has no side, whichever pattern tells of it. What lifts off carries nothing, either.
        let floats = |k: usize| {
            if closed(k) == Some(false) {
                return false;
            }
            let is_unloaded = |forces: &Vec<Limit>| forces.get(k) == Some(&Limit::Finite(0.0));
            let changes_side =
                |end: &ModeEnd| matches!(&end.cause, EndCause::SideChange(at) if at.contains(&k));
            [&from, &to].into_iter().all(is_unloaded) && ![&mode.from, &mode.to].into_iter().any(changes_side)
        };
        let sign = |(k, sign): (usize, i8)| if floats(k) { 0 } else { sign };
        let signs: Vec<i8> = signs(&mode.pattern).into_iter().enumerate().map(sign).collect();
        let reaction = |(k, contact): (usize, &crate::mechanism::Contact)| {
            let ((from, from_grows), (to, to_grows)) = (limit(&from, k), limit(&to, k));
            EndReaction { contact: contact.name.to_string(), from, to, from_grows, to_grows }
        };
        ModeLimits {
            pattern: pattern(&mode.pattern),
            preload_gap: !self.mechanism.excess.open.is_solution(&mode.pattern),
            joints: self.joint_modes(&signs),
            signs,
            from: end(mode.from.at),
            to: end(mode.to.at),
            from_is: ModeEndCause::new(&mode.from.cause, found.nothing_is_left(mode.from.at, true), closed),
            to_is: ModeEndCause::new(&mode.to.cause, found.nothing_is_left(mode.to.at, false), closed),
            from_at: self.ends_at(&mode.from.cause, &found.circles, closed),
            to_at: self.ends_at(&mode.to.cause, &found.circles, closed),
            reactions: self.mechanism.contacts.iter().enumerate().map(reaction).collect(),
            orientation: branch.map(|branch| branch.orientation),
            hinge_forces: branch.map_or_else(Vec::new, |branch| self.hinge_forces(branch, &found.circles)),
            speeds: speeds.iter().map(speed).collect(),
        }
    }

    /// The normal forces at an end of a mode; none if they are not known.
    fn reactions(&self, pattern: &[ContactState], end: &ModeEnd) -> Vec<Limit> {
        let Some(mut forces) = end.normal_force.clone() else { return Vec::new() };
        self.mechanism.put_at_faces(pattern, &mut forces, Limit::Finite(0.0), |one, other| {
            match (one, other) {
                (Limit::Finite(one), Limit::Finite(other)) => Limit::Finite(one + other),
                (Limit::Finite(_), infinite) | (infinite, _) => infinite,
            }
        });
        forces
    }

    /// The contacts, guided sliders or hinges at which a mode ends.
    fn ends_at(
        &self,
        cause: &EndCause,
        circles: &[usize],
        closed: impl Fn(usize) -> Option<bool>,
    ) -> Vec<String> {
        match cause {
            EndCause::SideChange(contacts) => self.contacts(&ModeEndCause::of_those(contacts, closed)),
            EndCause::GapCloses(contacts) | EndCause::GreatestNormalForce(contacts) => {
                self.contacts(contacts)
            }
            EndCause::OutputBound(bounds) => self.mechanism.guided_sliders(bounds),
            EndCause::HingeUnloaded(hinges) => {
                hinges.iter().map(|&hinge| self.hinge(circles[hinge])).collect()
            }
            EndCause::Range
            | EndCause::Singular
            | EndCause::Fold
            | EndCause::NotFollowed
            | EndCause::Reversal
            | EndCause::NoProblem => Vec::new(),
        }
    }

    /// The name of the hinge of a friction circle.
    fn hinge(&self, circle: usize) -> String {
        self.mechanism.circle_name(circle)
    }

    /// Returns the limits of the forces of hinges with friction towards both ends of a branch.
    fn hinge_forces(&self, branch: &Branch, circles: &[usize]) -> Vec<EndHingeForce> {
        let [from, to] = [&branch.from, &branch.to].map(|end| end.hinge_force.as_deref().unwrap_or_default());
        let force = |(index, &circle): (usize, &usize)| {
            let ((from, from_grows), (to, to_grows)) = (limit(from, index), limit(to, index));
            let [from_grows, to_grows] = [from_grows != 0, to_grows != 0];
            // The magnitude of a hinge, of a collar that of its one force.
            let part = self.mechanism.friction_circles[circle].magnitude([FRAC_1_SQRT_2; 2]);
            let [from, to] = [from, to].map(|force| force.map(|force| force * part));
            EndHingeForce { hinge: self.hinge(circle), from, to, from_grows, to_grows }
        };
        circles.iter().enumerate().map(force).collect()
    }

    fn direction(&self, (found, Along { speeds, tipping }): Found<'_>) -> Direction {
        let all_examined = is_examined(found);
        let is_empty =
            |one: &CountInterval| !all_examined && !one.continuum && one.solutions + one.gap_states == 0;
        let count = |(index, ((interval, known), tipping)): (
            usize,
            ((&CountInterval, &Knowledge), &Option<Tipping>),
        )| {
            CountLimits {
                from: found.same_ends.told(interval.from),
                to: found.same_ends.told(interval.to),
                solutions: interval.solutions,
                preload_gap_states: interval.gap_states,
                continuum: interval.continuum,
                known: match known.elsewhere {
                    Elsewhere::ClosedForm | Elsewhere::Sampled(_) if is_empty(interval) => Known::Undecided,
                    Elsewhere::Nothing => Known::Proven,
                    Elsewhere::ClosedForm => Known::ClosedForm,
                    Elsewhere::Sampled(_) => Known::Sampled,
                    Elsewhere::Contradicted => Known::Undecided,
                },
                tipping: tipping.clone(),
                proven: known.proven.clone(),
                spacing: if let Elsewhere::Sampled(spacing) = known.elsewhere { Some(spacing) } else { None },
                starts: found.starts.get(index).cloned().flatten(),
            }
        };
        Direction {
            modes: found
                .existence
                .modes
                .iter()
                .enumerate()
                .zip(speeds)
                .map(|((index, mode), speeds)| self.mode((mode, found.branches.get(index)), speeds, found))
                .collect(),
            counts: found.counts.iter().zip(&found.known).zip(tipping).enumerate().map(count).collect(),
            without_mode_problem: RangeWithoutProblem::of(found),
            between_faces_at: found.between_faces.values().to_vec(),
        }
    }
}

/// Speeds and tipping along the modes of a direction.
pub(super) struct Along {
    /// For each mode what becomes of the speeds.
    pub(super) speeds: Vec<Vec<SpeedLimits>>,
    /// For each number of solutions what tips where there is none.
    pub(super) tipping: Vec<Option<Tipping>>,
}

/// The modes of a direction, and what is asked along them.
type Found<'f> = (&'f ModesFound, &'f Along);

/// The report on both directions, of which the opposite one may be absent.
pub(super) fn report(
    naming: &Naming,
    varied: &Varied,
    range: [f64; 2],
    forwards: Found<'_>,
    reversed: Option<Found<'_>>,
) -> LimitsReport {
    let (found, _) = forwards;
    let forwards = naming.direction(forwards);
    let reversed = reversed.map(|found| naming.direction(found));
    let Conclusion { summary, says_all, sentences: mut conclusion } =
        conclusion((varied, found.method), &forwards, reversed.as_ref());
    let speeds = forwards.modes.iter().flat_map(|mode| &mode.speeds);
    if speeds.filter(|speed| speed.friction_exceeds_loads).count() > 0 {
        conclusion.push(NO_DRIVE.to_owned());
    }
    let value = varied.present().unwrap_or_default();
    let mut guarantee = guarantee(found, &varied.shown_in);
    if varied.is_coordinate() {
        guarantee += " Each position was followed from the drawing by steps that are proven to stay on its assembly branch.";
    }
    LimitsReport {
        schema: SCHEMA,
        title: naming.mechanism.title.clone(),
        vary: VariedQuantity::new(varied, range, value),
        state: held_state(&naming.mechanism, varied, range),
        units: varied.model().units.clone(),
        steps_from_drawing: naming.configuration.steps_from_drawing().filter(|_| !varied.is_coordinate()),
        method: match found.method {
            Method::ClosedForm | Method::Hinge => LimitsMethod::ClosedForm,
            Method::Same { .. } => LimitsMethod::Independent,
            Method::Bracketing => LimitsMethod::Bracketing,
        },
        guarantee,
        modes: forwards.modes,
        counts: forwards.counts,
        without_mode_problem: forwards.without_mode_problem,
        between_faces_at: forwards.between_faces_at,
        reversed,
        conclusion,
        summary,
        summary_says_all: says_all,
        not_examined: not_examined(found),
    }
}

fn limit(forces: &[Limit], contact: usize) -> (Option<f64>, i8) {
    match forces.get(contact) {
        // Adding zero turns -0 into 0.
        Some(Limit::Finite(value)) => (finite(value + 0.0), 0),
        Some(Limit::Infinite(sign)) => (None, if *sign > 0.0 { 1 } else { -1 }),
        None => (None, 0),
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
