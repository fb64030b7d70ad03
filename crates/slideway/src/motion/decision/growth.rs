//! Whether a phase that starts at one of its bounds moves away from it, by short steps along its own motion.

use super::assessment::{Assessment, Decisive, Slack, assess_group};
use super::instant::Instant;
use super::outputs::Group;
use super::state::state;
use super::system::{Question, Subject};
use super::{BOUNDARY, PhaseBound, Standing};
use crate::configuration::{Configuration, Pose, Velocity};
use crate::fault::Faults;
use crate::ids::{ContactId, JointId};
use crate::mechanism::{Mechanism, body_of};
use crate::motion::moving::equations::independent;
use crate::motion::moving::resolution::Resolution;
use crate::pattern::Phase;
use nalgebra::{DVector, Vector2};

/// Length of a step, as a fraction of the time in which the motion can change.
const STEP: f64 = 1e-4;
/// Rates of slacks below this, per unit of that time, count as zero: they are accurate to about 1e-8.
const NO_RATE: f64 = 1e-6;
/// Second derivatives of slacks below this count as zero: they are accurate to about 1e-4.
const NO_CURVATURE: f64 = 2e-3;
/// A rate beyond this, per unit of that time, is decided by one step: second derivatives, which one step
/// counts as rates, are of order one in that unit, and would have to be 200 times that.
const CLEAR_RATE: f64 = 1e-2;

/// Accelerations of bodies and coordinates.
struct Accelerations {
    bodies: DVector<f64>,
    coordinates: Vec<f64>,
}

/// Why a phase does not last.
#[derive(Default)]
pub(super) struct Ended {
    /// The bounds that it violates at once; none if its equations contradict each other a little later.
    pub(super) violated: Vec<Decisive>,
    /// The joints and hinges with friction that this concerns, with all on which their motion depends.
    pub(super) members: Vec<usize>,
}

/// How a phase stands to its bounds; otherwise why it does not last.
///
/// The time in which the motion can change is that in which accelerations or velocities carry the mechanism
/// through its own length, or that over which four samples show what the loads do.
///
/// Slacks within [`BOUNDARY`] of zero are judged by their derivatives along the motion of the phase. Where
/// all rates are clear, the difference over one step suffices. Otherwise one-sided differences over two steps
/// are used: with constant accelerations, which give rates as well as any, and by Heun's method where a rate
/// is zero and the curvature is needed. Bodies that have nothing to do with one another are judged each in their own time.
pub(super) fn standing(
    configuration: &Configuration,
    (instant, question, assessment): (&Instant<'_>, &Question<'_>, &Assessment),
) -> Result<Standing, Ended> {
    let at_bounds = |slacks: &[Slack]| -> Vec<Decisive> {
        slacks.iter().filter(|slack| slack.value <= BOUNDARY).map(|slack| slack.subject).collect()
    };
    let limits = |subjects: &[Decisive]| -> Vec<PhaseBound> {
        subjects.iter().map(|&subject| limit(instant, subject)).collect()
    };
    let bounds = at_bounds(&assessment.slacks);
    if bounds.is_empty() && !assessment.redundant {
        return Ok(Standing::Inside);
    }
    let (mut ended, mut constant) = (Ended::default(), Vec::new());
    for part in Part::all(instant.mechanism) {
        let slacks = part.slacks(instant, &assessment.slacks);
        let own = at_bounds(&slacks);
        if own.is_empty() && !assessment.redundant {
            continue;
        }
        let step = STEP * part.time_scale(instant, configuration);
        let start = (configuration, accelerations(instant, assessment));
        let flow = Flow { instant, phase: &assessment.phase, stopped: question.stopped, part: &part };
        match flow.judged(start, step, Bounds { slacks: &slacks }) {
            Ok(Later::Lasts(judged)) if judged.violated.is_empty() => constant.extend(judged.constant),
            Ok(Later::Lasts(judged)) => {
                ended.violated.extend(judged.violated);
                ended.members.extend(part.members(instant));
            }
            Ok(Later::Ends) => {
                return Err(Ended { violated: Vec::new(), members: part.members(instant).collect() });
            }
            Ok(Later::Unsolved) | Err(_) => constant.extend(own),
        }
    }
    if !ended.members.is_empty() {
        return Err(ended);
    }
    Ok(if bounds.is_empty() {
        Standing::Inside
    } else if constant.is_empty() {
        Standing::Leaves(limits(&bounds))
    } else {
        Standing::Undecided(limits(&constant))
    })
}

/// The slacks of a phase, some of which are zero.
#[derive(Clone, Copy)]
struct Bounds<'b> {
    slacks: &'b [Slack],
}

/// How slacks that are zero develop.
#[derive(Default)]
struct Judged {
    /// Those that decrease.
    violated: Vec<Decisive>,
    /// Those that are known neither to increase nor to decrease.
    constant: Vec<Decisive>,
    /// Whether a curvature is decisive.
    wants_curvature: bool,
}

impl Bounds<'_> {
    /// The slacks that are zero, by their places.
    fn at_zero(self) -> impl Iterator<Item = (usize, Slack)> {
        self.slacks.iter().copied().enumerate().filter(|(_, slack)| slack.value <= BOUNDARY)
    }

    /// Judges by the difference over one step; `None` if a rate is not clear.
    fn after_one(self, first: &[Slack]) -> Option<Judged> {
        let mut judged = Judged::default();
        for (index, now) in self.at_zero() {
            let later = first.get(index).filter(|slack| slack.subject == now.subject)?;
            let rate = (later.value - now.value) / STEP;
            if rate < -CLEAR_RATE {
                judged.violated.push(now.subject);
            } else if rate <= CLEAR_RATE {
                return None;
            }
        }
        Some(judged)
    }

    /// Judges by one-sided differences over two steps.
    fn after_two(self, [first, second]: [&[Slack]; 2]) -> Judged {
        let mut judged = Judged::default();
        for (index, now) in self.at_zero() {
            let at = |later: &[Slack]| {
                later.get(index).filter(|slack| slack.subject == now.subject).map(|slack| slack.value)
            };
            let (Some(first), Some(second)) = (at(first), at(second)) else {
                judged.constant.push(now.subject);
                continue;
            };
            let rate = (-3.0 * now.value + 4.0 * first - second) / (2.0 * STEP);
            let curvature = (now.value - 2.0 * first + second) / (STEP * STEP);
            judged.wants_curvature |= rate.abs() <= NO_RATE;
            if rate < -NO_RATE || (rate <= NO_RATE && curvature < -NO_CURVATURE) {
                judged.violated.push(now.subject);
            } else if rate <= NO_RATE && curvature <= NO_CURVATURE {
                judged.constant.push(now.subject);
            }
        }
        judged
    }
}

fn limit(instant: &Instant<'_>, subject: Decisive) -> PhaseBound {
    match subject {
        Decisive::One(Subject::Pressure(k)) => PhaseBound::NormalForce(ContactId(k)),
        Decisive::One(Subject::Share(k)) => PhaseBound::PreloadShare(ContactId(k)),
        Decisive::One(Subject::Couple(k)) => PhaseBound::Couple(ContactId(k)),
        Decisive::One(Subject::Friction(_) | Subject::Circle(_)) | Decisive::Open(_) => PhaseBound::Sticking,
        Decisive::One(Subject::Gap(joint)) => PhaseBound::Gap(instant.id_of(joint).unwrap_or(JointId(joint))),
        Decisive::One(Subject::Slip(joint)) => {
            PhaseBound::Slip(instant.id_of(joint).unwrap_or(JointId(joint)))
        }
    }
}

/// The shortest time ahead (s) that steps can resolve from now.
fn least_step(configuration: &Configuration) -> f64 {
    f64::EPSILON / STEP.powi(2) * configuration.time.abs()
}

/// Bodies that have nothing to do with others.
struct Part {
    /// For each body whether it is one of them.
    bodies: Vec<bool>,
}

impl Part {
    /// Those of a mechanism.
    fn all(mechanism: &Mechanism) -> impl Iterator<Item = Self> {
        let numbers = independent(mechanism);
        let is_one = |number: &usize| numbers.contains(number);
        let parts: Vec<usize> = (0..numbers.len()).filter(is_one).collect();
        parts
            .into_iter()
            .map(move |part| Self { bodies: numbers.iter().map(|number| *number == part).collect() })
    }

    /// Whether one of the sliding joints and hinges with friction belongs to it.
    fn has(&self, instant: &Instant<'_>, number: usize) -> bool {
        let body = instant.id_of(number).and_then(|joint| body_of(instant.mechanism, joint));
        body.is_some_and(|body| self.bodies[body.index()])
    }

    fn members(&self, instant: &Instant<'_>) -> impl Iterator<Item = usize> {
        (0..instant.rubbing()).filter(|number| self.has(instant, *number))
    }

    fn groups<'i>(&self, instant: &'i Instant<'_>) -> impl Iterator<Item = &'i Group> {
        let joints = instant.joints.len();
        instant
            .groups
            .iter()
            .filter(move |group| group.members(joints).any(|number| self.has(instant, number)))
    }

    /// Its own of these slacks.
    fn slacks(&self, instant: &Instant<'_>, all: &[Slack]) -> Vec<Slack> {
        let member = |slack: &Slack| match slack.subject {
            Decisive::One(Subject::Slip(number) | Subject::Gap(number)) | Decisive::Open(number) => {
                Some(number)
            }
            Decisive::One(Subject::Circle(hinge)) => Some(instant.number_of(hinge)),
            Decisive::One(
                Subject::Pressure(k) | Subject::Share(k) | Subject::Couple(k) | Subject::Friction(k),
            ) => instant.joint_of(k),
        };
        let is_own = |slack: &&Slack| member(slack).is_some_and(|number| self.has(instant, number));
        all.iter().filter(is_own).copied().collect()
    }

    /// The time in which accelerations or velocities carry them through the length of the mechanism, or over which samples
    /// show what the loads do (s).
    fn time_scale(&self, instant: &Instant<'_>, configuration: &Configuration) -> f64 {
        let length = instant.units.length;
        let velocities = configuration.velocities.iter().zip(&self.bodies).filter(|(_, counts)| **counts);
        let speeds = velocities.map(|(v, _)| v.linear.norm().max(v.angular.abs() * length));
        let speed = speeds.fold(0.0, f64::max);
        let accelerations = self.members(instant).map(|number| instant.units_of_rubbing(number).acceleration);
        let by_forces = (length / accelerations.fold(0.0, f64::max)).sqrt();
        let scale = by_forces.min(if speed > 0.0 { length / speed } else { f64::INFINITY });
        let resolution = Resolution::of_bodies(instant.mechanism, |body| self.bodies[body]);
        resolution.step(configuration, (|_| 0.0, 0.0), [scale, least_step(configuration)])
    }
}

/// The motion of a phase.
struct Flow<'f> {
    instant: &'f Instant<'f>,
    phase: &'f Phase,
    stopped: &'f [bool],
    /// What moves; other bodies stay where they are.
    part: &'f Part,
}

/// What happens to a phase along its own motion.
enum Later<T> {
    Lasts(T),
    /// Its equations contradict each other.
    Ends,
    /// A linear program was not solved.
    Unsolved,
}

impl<T> Later<T> {
    fn and_then<U>(self, next: impl FnOnce(T) -> Result<Later<U>, Faults>) -> Result<Later<U>, Faults> {
        match self {
            Self::Lasts(found) => next(found),
            Self::Ends => Ok(Later::Ends),
            Self::Unsolved => Ok(Later::Unsolved),
        }
    }
}

impl Flow<'_> {
    /// How slacks that are zero develop.
    fn judged(
        &self,
        (from, start): (&Configuration, Accelerations),
        step: f64,
        bounds: Bounds<'_>,
    ) -> Result<Later<Judged>, Faults> {
        // Errors are of second order in the step, because the differences for rates remove them.
        let after = |time: f64| self.at(&self.advanced(from, &start, &start, time));
        after(step)?.and_then(|(_, first)| {
            if let Some(judged) = bounds.after_one(&first) {
                return Ok(Later::Lasts(judged));
            }
            after(2.0 * step)?.and_then(|(_, second)| {
                let judged = bounds.after_two([&first, &second]);
                if judged.wants_curvature {
                    self.curved((from, &start), step, bounds)
                } else {
                    Ok(Later::Lasts(judged))
                }
            })
        })
    }

    /// The same with errors of third order, which preserve curvatures.
    fn curved(
        &self,
        (from, start): (&Configuration, &Accelerations),
        step: f64,
        bounds: Bounds<'_>,
    ) -> Result<Later<Judged>, Faults> {
        self.step(from, start, step)?.and_then(|(next, start, first)| {
            self.step(&next, &start, step)?
                .and_then(|(_, _, second)| Ok(Later::Lasts(bounds.after_two([&first, &second]))))
        })
    }

    /// A step of Heun's method: the configuration after it, its accelerations and slacks.
    fn step(
        &self,
        from: &Configuration,
        start: &Accelerations,
        step: f64,
    ) -> Result<Later<(Configuration, Accelerations, Vec<Slack>)>, Faults> {
        self.at(&self.advanced(from, start, start, step))?.and_then(|(end, _)| {
            let corrected = self.advanced(from, start, &end, step);
            self.at(&corrected)?
                .and_then(|(accelerations, slacks)| Ok(Later::Lasts((corrected, accelerations, slacks))))
        })
    }

    fn at(&self, configuration: &Configuration) -> Result<Later<(Accelerations, Vec<Slack>)>, Faults> {
        let instant = self.instant.later(configuration)?;
        let question = instant.question(self.stopped, Some(self.phase));
        let mut assessment = Assessment::nothing(self.phase);
        for group in self.part.groups(&instant) {
            match assess_group(&instant, &question, (self.phase, group), f64::INFINITY) {
                Ok(Some(found)) => assessment = assessment.with(group, &found),
                Ok(None) => return Ok(Later::Ends),
                Err(_) => return Ok(Later::Unsolved),
            }
        }
        Ok(Later::Lasts((accelerations(&instant, &assessment), assessment.slacks)))
    }

    /// The configuration after a step in which accelerations vary linearly in time from `start` to `end`.
    fn advanced(
        &self,
        from: &Configuration,
        start: &Accelerations,
        end: &Accelerations,
        step: f64,
    ) -> Configuration {
        let way = |velocity: f64, a: f64, b: f64| step * (velocity + step * (2.0 * a + b) / 6.0);
        let gain = |a: f64, b: f64| step * f64::midpoint(a, b);
        let part = |accelerations: &Accelerations, body: usize| -> [f64; 3] {
            [0, 1, 2].map(|axis| accelerations.bodies[3 * body + axis])
        };
        let pose = |(body, (pose, velocity)): (usize, (&Pose, &Velocity))| {
            if !self.part.bodies[body] {
                return *pose;
            }
            let ([ax, ay, at], [bx, by, bt]) = (part(start, body), part(end, body));
            let moved = Vector2::new(way(velocity.linear.x, ax, bx), way(velocity.linear.y, ay, by));
            Pose::new(pose.position + moved, pose.angle() + way(velocity.angular, at, bt))
        };
        let velocity = |(body, velocity): (usize, &Velocity)| {
            let ([ax, ay, at], [bx, by, bt]) = (part(start, body), part(end, body));
            let linear = velocity.linear + Vector2::new(gain(ax, bx), gain(ay, by));
            Velocity { linear, angular: velocity.angular + gain(at, bt) }
        };
        let coordinates = from.coordinates.iter().zip(&from.rates);
        let both = start.coordinates.iter().zip(&end.coordinates);
        Configuration {
            poses: from.poses.iter().zip(&from.velocities).enumerate().map(pose).collect(),
            velocities: from.velocities.iter().enumerate().map(velocity).collect(),
            coordinates: coordinates
                .zip(both.clone())
                .map(|((q, qd), (a, b))| q + way(*qd, *a, *b))
                .collect(),
            rates: from.rates.iter().zip(both).map(|(qd, (a, b))| qd + gain(*a, *b)).collect(),
            time: from.time + step,
            steps: from.steps,
            pieces: from.pieces.clone(),
        }
    }
}

fn accelerations(instant: &Instant<'_>, assessment: &Assessment) -> Accelerations {
    let state = state(instant, assessment);
    let bodies = state.unknowns.rows(0, 3 * instant.mechanism.bodies.len()).into_owned();
    Accelerations { bodies, coordinates: state.coordinate_accelerations }
}
