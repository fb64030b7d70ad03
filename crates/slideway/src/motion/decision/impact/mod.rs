//! Impacts on end stops: the impulses of the stops, with friction impulses at all sliding joints and turning hinges.
//!
//! What a stop does, and the course of an impact, are here; which impulses are possible is in `pushed.rs`. Impacts on faces are in
//! `landing.rs`.

mod landing;
mod pushed;

use super::MOST_STATES;
use super::impulse::AT_REST;
use crate::configuration::Configuration;
use crate::fault::{Fault, FaultKind, Faults};
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::model::SliderKind;
use crate::pattern::phase::sliding_joints;
use crate::progress::Work;
pub(in crate::motion) use landing::{Landing, landing};
use nalgebra::DVector;
use pushed::Pushed;
pub(in crate::motion) use pushed::impact_within;

/// The effect of an impact on end stops.
#[derive(Debug, Clone)]
pub struct Impact {
    /// The mechanism afterwards: the same positions, new velocities.
    pub(crate) after: Configuration,
    /// The blows, one for each set of joints that act on one another; they are independent.
    pub(crate) blows: Vec<Blow>,
}

/// The impact of joints that act on one another.
#[derive(Debug, Clone)]
pub struct Blow {
    /// The joints, each with the impulse with which its stop pushes (N s).
    pub(crate) stops: Vec<(JointId, f64)>,
    /// Kinetic energy before minus kinetic energy afterwards (J).
    pub(crate) energy_lost: f64,
}

/// The impact of sliding joints that move towards end stops, each with Newton's coefficient of restitution
/// `e`: its sliding velocity changes from `v` to `-e v`, or less: the impact is over at latest when the stops have
/// returned the work that they have taken, so that kinetic energy never grows.
///
/// A stop pushes along the centre line of the guide, between block and guide, with an impulse `P` that grows
/// during the impact (E. J. Routh, Dynamics of a System of Rigid Bodies, Elementary Part, chapter IV). Loads
/// and preloads are negligible; meanwhile velocities change according to
///
/// ```text
/// M v' - G^T Lambda' - B U' - sum_k W_k Phi_k' - sum_j e_j K_j' = sum_i W_stop,i P_i'      G v' = 0      C v' = 0      P_i' >= 0
/// Phi_k' = mu_k |Lambda_k'| s_k of joints that slide,    |Phi_k'| <= mu_static_k |Lambda_k'| of those at rest that stay so
/// K_j' = -r_j |R_j'| sgn(omega_j) of hinges that turn,   |K_j'| <= r_static_j |R_j'| of those at rest that stay so
/// ```
///
/// which is the mode problem of impulses. It is constant until a sliding or angular velocity reaches zero, and is then
/// decided anew. A joint slides first against its stop and then away from it, so its friction reverses within
/// the impact. If there are several possible answers, the one with the greatest margin is used; where hinges turn with
/// friction, that in which more of what is at rest stays so. Coefficients of friction are those at the velocities before the impact.
///
/// Where pushing makes a joint faster towards its stop, since friction of another turns it round, that goes on until a
/// sliding or angular velocity reaches zero. Where no impulse of the stop is possible friction wedges the mechanism, as in
/// a [`jam`](super::jam()), and what comes to rest so is not thrown back.
///
/// Stops that are reached together act together: the velocities `v_i` towards them change to `-e_i v_i` in
/// proportion. A stop may also exert no impulse, if the others move its joint away from it at least as fast:
/// `P_i >= 0` and `-w_i >= e_i v_i` for the velocity `w_i` afterwards are complementary (J. J. Moreau). Where they would return
/// more work than they have taken, all `e_i` are reduced in proportion until they return as much.
/// Without friction this is a linear complementarity problem with a unique outcome, which removes a kinetic
/// energy of `sum_i P_i (1 - e_i) v_i/2`. All choices of the stops that push are tried.
///
/// # Errors
/// Whatever [`KineticEquations::new`](crate::kinetics::KineticEquations::new) refuses, more states than are
/// tried, an impact in which friction leaves the stops no impulse, one in which a guided slider would tip, and one with several
/// possible outcomes.
pub fn impact(
    mechanism: &Mechanism,
    configuration: &Configuration,
    stops: &[(JointId, f64)],
) -> Result<Impact, Faults> {
    impact_within(mechanism, configuration, stops, Work::undisturbed())
}

/// A joint that has reached its stop.
#[derive(Debug, Clone, Copy)]
struct Hit {
    id: JointId,
    /// Its number among the sliding joints.
    joint: usize,
    restitution: f64,
}

/// Those of the joints with stops that move; one that rests at its stop stays or leaves like any joint at rest.
fn hits(stops: &[(JointId, f64)], joints: &[JointId], velocities: &[f64]) -> Vec<Hit> {
    let hit = |&(id, restitution): &(JointId, f64)| {
        let joint = joints.iter().position(|joint| *joint == id)?;
        (velocities[joint] != 0.0).then_some(Hit { id, joint, restitution })
    };
    stops.iter().filter_map(hit).collect()
}

/// The progress of an impact.
#[derive(Debug, Clone)]
struct AfterImpact {
    /// The velocities (m/s), exactly zero where a joint or hinge has stopped.
    velocities: Vec<f64>,
    /// The jumps of all velocities of the bodies.
    jumps: DVector<f64>,
    /// Of the stops (N s).
    impulses: Vec<f64>,
    /// Work of the stops (J): negative while they have taken more than they have returned.
    work: f64,
}

/// By how much everything changes while the velocities of some joints go to their targets.
struct Change {
    /// The velocities (m/s); exactly zero where something sticks.
    velocities: Vec<f64>,
    /// The velocities of the bodies.
    jumps: DVector<f64>,
    /// The impulses of the stops of those joints (N s).
    impulses: Vec<f64>,
}

/// Joints that reach their stops together.
struct Collision<'c> {
    mechanism: &'c Mechanism,
    hits: &'c [Hit],
    /// For each, whether its stop pushes.
    pushes: Vec<bool>,
    /// Whether pushing may make joints faster towards their stops, and friction wedge them.
    wedges: bool,
    /// The guided sliders of which it does not count whether they would tip, by their numbers among the sliding joints.
    upright: Vec<usize>,
    /// The velocities of the sliding joints (m/s), then of hinges with friction, in sizes of the mechanism; exactly zero where
    /// they are only rounding.
    velocities: &'c [f64],
    /// Components of the jumps.
    size: usize,
}

/// The unique outcome of a collision; `attempt` is the outcome if exactly some of the stops push.
///
/// # Errors
/// There is no outcome, or there are several.
fn outcome(
    mut collision: Collision<'_>,
    attempt: impl Fn(&Collision<'_>, &mut usize) -> Result<Option<AfterImpact>, Faults>,
) -> Result<AfterImpact, Faults> {
    let mut unsolved = 0;
    if let Some(found) = collision.found(&attempt, &mut unsolved)? {
        return Ok(found);
    }
    let joints = collision.joints();
    if unsolved > 0 {
        return Err(Fault::general(FaultKind::UnsolvedImpact { joints }).into());
    }
    let tipping = collision.tipping(&attempt)?;
    let kind = if tipping.is_empty() {
        FaultKind::ImpactWedges { joints }
    } else {
        FaultKind::ImpactTips { joints, tipping }
    };
    Err(Fault::general(kind).into())
}

impl<'c> Collision<'c> {
    /// The joints, with the velocities before the impact, and components of the jumps.
    fn new(mechanism: &'c Mechanism, hits: &'c [Hit], velocities: &'c [f64], size: usize) -> Self {
        Self { mechanism, hits, pushes: Vec::new(), wedges: false, upright: Vec::new(), velocities, size }
    }

    /// The unique outcome over all choices of the stops that push; nothing where there is none.
    ///
    /// # Errors
    /// Too many choices, or several outcomes.
    fn found(
        &mut self,
        attempt: &impl Fn(&Self, &mut usize) -> Result<Option<AfterImpact>, Faults>,
        unsolved: &mut usize,
    ) -> Result<Option<AfterImpact>, Faults> {
        let choices = self.hits.iter().fold(1_u64, |choices, _| choices.saturating_mul(2));
        if choices > MOST_STATES {
            let kind = FaultKind::TooManyStates { states: choices, limit: MOST_STATES };
            return Err(Fault::general(kind).into());
        }
        for wedges in [false, true] {
            self.wedges = wedges;
            let mut found: Option<AfterImpact> = None;
            // All stops together are tried first.
            for choice in (1..choices).rev() {
                self.pushes = (0..self.hits.len()).map(|hit| choice >> hit & 1 == 1).collect();
                let Some(other) = attempt(self, unsolved)? else { continue };
                let differs = |found: &AfterImpact| {
                    let velocities = found.velocities.iter().zip(&other.velocities);
                    velocities.into_iter().any(|(one, other)| self.without_rounding(one - other) != 0.0)
                };
                if found.as_ref().is_some_and(differs) {
                    return Err(self.several());
                }
                found.get_or_insert(other);
            }
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// The names of the guided sliders that keep a collision without an outcome from having one, since they would tip: each
    /// that does so by itself, else all that do so together.
    ///
    /// # Errors
    /// As [`Self::found`].
    fn tipping(
        &mut self,
        attempt: &impl Fn(&Self, &mut usize) -> Result<Option<AfterImpact>, Faults>,
    ) -> Result<Vec<String>, Faults> {
        let joints = sliding_joints(self.mechanism);
        let slider = |joint: &usize| self.mechanism.slider(joints[*joint]);
        let is_guided = |joint: &usize| slider(joint).is_some_and(|one| one.kind == SliderKind::Guided);
        let guided: Vec<usize> = (0..joints.len()).filter(is_guided).collect();
        let mut tips = |upright: &[usize]| {
            self.upright = upright.to_vec();
            Ok::<_, Faults>(self.found(attempt, &mut 0)?.is_some())
        };
        let mut alone = Vec::new();
        for joint in &guided {
            if tips(&[*joint])? {
                alone.push(*joint);
            }
        }
        let all = if alone.is_empty() && tips(&guided)? { guided } else { alone };
        Ok(all.iter().map(|joint| self.mechanism.joints[joints[*joint].index()].name.to_string()).collect())
    }

    /// The names of the joints.
    fn joints(&self) -> Vec<String> {
        self.hits.iter().map(|hit| self.mechanism.joints[hit.id.index()].name.to_string()).collect()
    }

    /// The fault of several outcomes.
    fn several(&self) -> Faults {
        Fault::general(FaultKind::SeveralImpacts { joints: self.joints(), outcomes: Vec::new() }).into()
    }

    /// Velocities closer to zero than this are rounding (m/s).
    fn rounding(&self) -> f64 {
        AT_REST * self.velocities.iter().fold(0.0_f64, |greatest, velocity| greatest.max(velocity.abs()))
    }

    fn without_rounding(&self, velocity: f64) -> f64 {
        if velocity.abs() <= self.rounding() { 0.0 } else { velocity }
    }

    /// The outcome of the impact; `None` unless exactly these stops can push.
    fn outcome(&self, pushed: &Pushed<'_>, unsolved: &mut usize) -> Result<Option<AfterImpact>, Faults> {
        let undecided = *unsolved;
        let whole = self.course(pushed, 1.0, unsolved)?;
        let bounded = match whole {
            Some(course) if course.work <= 0.0 => Some((self.part_of(&course), course)),
            Some(_) => self.greatest(pushed, unsolved)?,
            None if !self.wedges || *unsolved > undecided => None,
            // There is no way back.
            None => self.course(pushed, 0.0, unsolved)?.map(|dead| (0.0, dead)),
        };
        let is_left = |hit: &Hit, part: f64, course: &AfterImpact| {
            let leaves = -self.velocities[hit.joint].signum() * course.velocities[hit.joint];
            leaves >= part * hit.restitution * self.velocities[hit.joint].abs() - self.rounding()
        };
        let all_leave =
            |(part, course): &(f64, AfterImpact)| self.hits.iter().all(|hit| is_left(hit, *part, course));
        Ok(bounded.filter(all_leave).map(|(_, course)| course))
    }

    /// The part of their restitutions with which the joints that are pushed leave their stops.
    fn part_of(&self, course: &AfterImpact) -> f64 {
        let part = |(_, hit): (usize, &Hit)| {
            let before = self.velocities[hit.joint];
            let whole = hit.restitution * before.abs();
            if self.without_rounding(whole) > 0.0 {
                -before.signum() * course.velocities[hit.joint] / whole
            } else {
                1.0
            }
        };
        self.pushing().map(part).fold(1.0, f64::min)
    }

    /// The greatest part of all restitutions with which the impact has a course in which the stops return no more work than
    /// they have taken, and that course. Without restitution they return none. Stops with different restitutions take other
    /// courses with each part: no piece of a course is known before the part is, so that it is bisected.
    fn greatest(
        &self,
        pushed: &Pushed<'_>,
        unsolved: &mut usize,
    ) -> Result<Option<(f64, AfterImpact)>, Faults> {
        let Some(dead) = self.course(pushed, 0.0, unsolved)? else { return Ok(None) };
        let (mut best, mut beyond) = ((0.0, dead), 1.0);
        for _ in 0..f64::MANTISSA_DIGITS {
            let middle = f64::midpoint(best.0, beyond);
            match self.course(pushed, middle, unsolved)? {
                Some(course) if course.work <= 0.0 => best = (middle, course),
                _ => beyond = middle,
            }
        }
        Ok(Some(best))
    }

    /// The course of the impact until the velocities of the joints that are pushed have this part of their restitution, in
    /// proportion; `None` if there is none.
    fn course(
        &self,
        pushed: &Pushed<'_>,
        part: f64,
        unsolved: &mut usize,
    ) -> Result<Option<AfterImpact>, Faults> {
        let mut course = AfterImpact {
            velocities: self.velocities.to_vec(),
            jumps: DVector::zeros(self.size),
            impulses: vec![0.0; self.hits.len()],
            work: 0.0,
        };
        let target = |(_, hit): (usize, &Hit)| {
            let target = -part * hit.restitution * self.velocities[hit.joint];
            (hit.joint, self.without_rounding(target))
        };
        let targets: Vec<(usize, f64)> = self.pushing().map(target).collect();
        Ok(self.follow(pushed, &mut course, &targets, unsolved)?.then_some(course))
    }

    /// The stops that push, each with its number.
    fn pushing(&self) -> impl Iterator<Item = (usize, &Hit)> {
        self.hits.iter().enumerate().filter(|(hit, _)| self.pushes[*hit])
    }

    /// Follows an impact until the joints have reached their velocities, in proportion, or the one stop that pushes has
    /// returned the work that it has taken; `false` if no impulse leads there. Every part except the last brings another joint or hinge to rest.
    fn follow(
        &self,
        pushed: &Pushed<'_>,
        course: &mut AfterImpact,
        targets: &[(usize, f64)],
        unsolved: &mut usize,
    ) -> Result<bool, Faults> {
        for _ in 0..4 * course.velocities.len() + 2 {
            course.velocities.iter_mut().for_each(|velocity| *velocity = self.without_rounding(*velocity));
            if targets.iter().all(|(joint, target)| course.velocities[*joint] == *target) {
                return Ok(true);
            }
            let Some((change, reaches)) = self.change(pushed, course, targets, unsolved)? else {
                return Ok(false);
            };
            let ends: (f64, &[(usize, f64)]) = if reaches { (1.0, targets) } else { (f64::INFINITY, &[]) };
            let (part, stops) = until_one_stops(pushed, &course.velocities, &change.velocities, ends);
            if !part.is_finite() {
                return Ok(false);
            }
            if let Some(even) = self.part_until_even(course, &change).filter(|even| *even < part) {
                self.go_on(course, (&change, even));
                course.work = 0.0;
                return Ok(true);
            }
            self.go_on(course, (&change, part));
            match stops {
                Some(other) => course.velocities[other] = 0.0,
                None => targets.iter().for_each(|(joint, target)| course.velocities[*joint] = *target),
            }
        }
        Ok(false)
    }

    /// How everything changes next, and whether that leads to the targets. Where pushing makes joints faster towards their
    /// stops it goes on until something stops; where no stop can push, friction wedges what moves towards them.
    fn change(
        &self,
        pushed: &Pushed<'_>,
        course: &AfterImpact,
        targets: &[(usize, f64)],
        unsolved: &mut usize,
    ) -> Result<Option<(Change, bool)>, Faults> {
        if let Some(change) = pushed.change(&course.velocities, targets, unsolved)? {
            return Ok(Some((change, true)));
        }
        if !self.wedges {
            return Ok(None);
        }
        let away = |&(joint, target): &(usize, f64)| (joint, 2.0 * course.velocities[joint] - target);
        let away: Vec<(usize, f64)> = targets.iter().map(away).collect();
        if let Some(change) = pushed.change(&course.velocities, &away, unsolved)? {
            return Ok(Some((change, false)));
        }
        let nears = |(_, hit): (usize, &Hit)| {
            course.velocities[hit.joint] * self.velocities[hit.joint].signum() > 0.0
        };
        if !self.pushing().any(nears) {
            return Ok(None);
        }
        Ok(pushed.wedged(course)?.map(|change| (change, false)))
    }

    /// The part of a change until the one stop that pushes has returned the work that it has taken; none if it does not, and
    /// where several push. With [`Self::go_on`] that is the root of `W + a p + b p^2` where the work becomes positive.
    fn part_until_even(&self, course: &AfterImpact, change: &Change) -> Option<f64> {
        let ((_, hit), [impulse]) = (self.pushing().next()?, change.impulses.as_slice()) else { return None };
        let power = -self.velocities[hit.joint].signum() * impulse;
        let (a, b) = (power * course.velocities[hit.joint], power * change.velocities[hit.joint] / 2.0);
        let root = (a * a - 4.0 * b * course.work).sqrt();
        let part = if a > 0.0 { -2.0 * course.work / (a + root) } else { (root - a) / (2.0 * b) };
        (part >= 0.0 && (a > 0.0 || b > 0.0)).then_some(part)
    }

    /// A part of a change. The stops do the work `sum_i -d_i P_i (v_i + c_i/2)`, with the sense `d_i` in which their joints
    /// reach them.
    fn go_on(&self, course: &mut AfterImpact, (change, part): (&Change, f64)) {
        for ((number, hit), impulse) in self.pushing().zip(&change.impulses) {
            let mean = course.velocities[hit.joint] + part * change.velocities[hit.joint] / 2.0;
            course.work -= self.velocities[hit.joint].signum() * part * impulse * mean;
            course.impulses[number] += part * impulse;
        }
        let velocities = course.velocities.iter_mut().zip(&change.velocities);
        velocities.for_each(|(velocity, change)| *velocity += part * change);
        course.jumps += &change.jumps * part;
    }
}

/// The fraction of a change until a joint or hinge stops, and which, other than those whose target that is; `most` if none does.
fn until_one_stops(
    pushed: &Pushed<'_>,
    velocities: &[f64],
    changes: &[f64],
    (most, targets): (f64, &[(usize, f64)]),
) -> (f64, Option<usize>) {
    let mut first = (most, None);
    for (joint, (velocity, change)) in velocities.iter().zip(changes).enumerate() {
        let part = -velocity / change;
        let ends_there = targets.contains(&(joint, 0.0));
        if !ends_there && pushed.rubs(joint) && *velocity != 0.0 && part >= 0.0 && part < first.0 {
            first = (part, Some(joint));
        }
    }
    first
}
