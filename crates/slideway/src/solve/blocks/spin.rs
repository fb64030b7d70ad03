//! In which sense the hinges with friction turn.

use super::super::mode_problem::AT_REST;
use super::super::no_sliding::{Why, why};
use crate::configuration::{Configuration, NO_ACCELERATION, Velocity, free_motions};
use crate::fault::{Fault, FaultKind, Faults, NoSliding};
use crate::ids::{BodyId, ContactId, Frame, JointId};
use crate::influence::Influence;
use crate::mechanism::{FrictionCircle, Joint, JointKind, Mechanism};
use crate::problem::TurningHinge;
use nalgebra::{DVector, Vector2};

/// The hinges with friction.
pub(super) struct Spins {
    /// Those that turn, with the sense in which they do.
    pub(super) turning: Vec<TurningHinge>,
    /// Those that no motion ever turns.
    pub(super) standing: Vec<TurningHinge>,
}

/// The hinges with friction and the sense in which each turns.
///
/// Where a hinge does not turn in this position but in those nearby, its spin passes through zero: the spin row depends
/// on the joint equations, so that they alone give its angular acceleration, and friction has the sense of that (theory
/// of hinges, section 1).
///
/// # Errors
/// A fault for each hinge with friction that could turn and does not.
pub(super) fn spins(
    mechanism: &Mechanism,
    configuration: &Configuration,
    influence: &Influence,
) -> Result<Spins, Faults> {
    let mut faults = Faults::default();
    let mut spins = Spins { turning: Vec::new(), standing: Vec::new() };
    let circles: Vec<usize> = mechanism.rough_hinges().map(|(circle, _)| circle).collect();
    let all = senses((mechanism, configuration), influence, &circles);
    for (circle, sense) in circles.into_iter().zip(all) {
        let FrictionCircle { joint, end, .. } = mechanism.friction_circles[circle];
        match sense {
            Ok(sense) => spins.turning.push(TurningHinge { circle, joint, sense }),
            Err(NoSliding::Never) if end.is_none() => {
                spins.standing.push(TurningHinge { circle, joint, sense: 0.0 });
            }
            Err(why) => faults.push(does_not_turn(mechanism, circle, why)),
        }
    }
    faults.or(spins)
}

/// Refuses hinges that never turn.
///
/// # Errors
/// A fault for each of them.
pub(super) fn never_turn(mechanism: &Mechanism, standing: &[TurningHinge]) -> Result<(), Faults> {
    let mut faults = Faults::default();
    faults.extend(standing.iter().map(|hinge| does_not_turn(mechanism, hinge.circle, NoSliding::Never)));
    faults.or(())
}

/// Refuses hinges with friction that never turn, whatever contacts lift off, so that their friction couples are only known within
/// bounds.
///
/// # Errors
/// A fault for each of them.
pub(crate) fn never_turning(mechanism: &Mechanism, configuration: &Configuration) -> Result<(), Faults> {
    let opening: Vec<usize> = mechanism.one_sided().map(ContactId::index).collect();
    let motions = free_motions(&mechanism.without_contacts(&opening), configuration);
    let moving = motions.column_iter().map(|motion| {
        let of_body = |part: &[f64]| Velocity { linear: Vector2::new(part[0], part[1]), angular: part[2] };
        let velocities = motion.as_slice().chunks_exact(3).map(of_body).collect();
        Configuration { velocities, ..configuration.clone() }
    });
    let moving: Vec<Configuration> = moving.collect();
    let turns = |circle: usize| moving.iter().any(|state| turning(mechanism, state)(circle) != 0.0);
    let still: Vec<usize> = (0..mechanism.friction_circles.len()).filter(|circle| !turns(*circle)).collect();
    let somehow = Configuration { rates: vec![1.0; configuration.rates.len()], ..configuration.clone() };
    let why = why_still(mechanism, &somehow, &still);
    let never = still.iter().zip(why).filter(|(_, why)| why.reason == NoSliding::Never);
    let mut faults = Faults::default();
    never.for_each(|(&circle, why)| faults.push(does_not_turn(mechanism, circle, why.reason)));
    faults.or(())
}

/// The fault of a hinge with friction that does not turn, or of a round end that does not slide.
pub(super) fn does_not_turn(mechanism: &Mechanism, circle: usize, why: NoSliding) -> Fault {
    let FrictionCircle { joint, end, .. } = mechanism.friction_circles[circle];
    let Joint { place, .. } = &mechanism.joints[joint.index()];
    if let Some([along_n, _]) = end {
        let contacts = vec![mechanism.contacts[along_n.index()].name.to_string()];
        return Fault::new(FaultKind::ZeroSlidingVelocity { contacts, why }, place.clone());
    }
    Fault::new(FaultKind::HingeDoesNotTurn { hinge: mechanism.circle_name(circle), why }, place.clone())
}

/// The sense in which each of these hinges turns, or why it does not; of round ends, in which the block slides.
pub(super) fn senses(
    (mechanism, configuration): (&Mechanism, &Configuration),
    influence: &Influence,
    circles: &[usize],
) -> Vec<Result<f64, NoSliding>> {
    let now: Vec<f64> = circles.iter().copied().map(turning(mechanism, configuration)).collect();
    let still: Vec<usize> =
        circles.iter().zip(&now).filter(|(_, now)| **now == 0.0).map(|(circle, _)| *circle).collect();
    let mut reasons = why_still(mechanism, configuration, &still).into_iter();
    let sense = |(circle, now): (&usize, f64)| {
        let joint = mechanism.friction_circles[*circle].joint;
        let begins = |Why { reason, moves_with }: Why| match reason {
            NoSliding::Here if moves_with.is_empty() => begins(mechanism, influence, joint).ok_or(reason),
            reason => Err(reason),
        };
        if now == 0.0 { reasons.next().map_or(Ok(now), begins) } else { Ok(now) }
    };
    circles.iter().zip(now).map(sense).collect()
}

/// Why each of these hinges does not turn.
fn why_still(mechanism: &Mechanism, configuration: &Configuration, still: &[usize]) -> Vec<Why> {
    let turn = |state: &Configuration| {
        still.iter().copied().map(turning(mechanism, state)).map(|sense| sense != 0.0).collect()
    };
    if still.is_empty() { Vec::new() } else { why(mechanism, configuration, (still.len(), &turn)) }
}

/// The sense in which a hinge that does not turn begins to, by the joint equations alone; none if that depends on contacts that
/// may lift off.
fn begins(mechanism: &Mechanism, influence: &Influence, joint: JointId) -> Option<f64> {
    let JointKind::Hinge([first, second]) = &mechanism.joints[joint.index()].kind else { return None };
    let turns = |unknowns: &DVector<f64>| {
        let of = |frame: Frame| {
            frame.body().map_or(0.0, |body| unknowns[influence.layout().acceleration(body) + 2])
        };
        let acceleration = of(first.frame) - of(second.frame);
        let greatest =
            (0..mechanism.bodies.len()).map(|body| of(Frame::Body(BodyId(body))).abs()).fold(0.0, f64::max);
        (acceleration.abs() > NO_ACCELERATION * greatest).then(|| acceleration.signum())
    };
    let depends = influence.openings.iter().any(|opening| turns(&opening.answer).is_some());
    turns(&influence.frictionless).filter(|_| !depends)
}

/// Says of friction circles in which sense each hinge turns, or the block of a round end slides: 1, -1, or 0 where it does not
/// within rounding.
fn turning(mechanism: &Mechanism, configuration: &Configuration) -> impl Fn(usize) -> f64 {
    let speeds =
        configuration.velocities.iter().map(|v| v.angular.abs().max(v.linear.norm() / mechanism.size));
    let greatest = speeds.fold(0.0, f64::max);
    move |circle| {
        let circle = &mechanism.friction_circles[circle];
        let least =
            if circle.end.is_some() { AT_REST * greatest * mechanism.size } else { AT_REST * greatest };
        let speed = configuration.rubbing(mechanism, circle);
        if speed.abs() <= least { 0.0 } else { speed.signum() }
    }
}
