//! In which sense the hinges with friction turn.

use super::super::mode_problem::AT_REST;
use super::super::no_sliding::why;
use crate::configuration::{Configuration, NO_ACCELERATION, free_motions};
use crate::fault::{Fault, FaultKind, Faults, NoSliding};
use crate::ids::{BodyId, Frame, JointId};
use crate::influence::Influence;
use crate::mechanism::{Joint, JointKind, Mechanism};
use crate::problem::TurningHinge;

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
    for (circle, joint) in mechanism.rough_hinges() {
        match sense(mechanism, configuration, influence, joint) {
            Ok(sense) => spins.turning.push(TurningHinge { circle, joint, sense }),
            Err(NoSliding::Never) => spins.standing.push(TurningHinge { circle, joint, sense: 0.0 }),
            Err(why) => faults.push(does_not_turn(mechanism, joint, why)),
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
    faults.extend(standing.iter().map(|hinge| does_not_turn(mechanism, hinge.joint, NoSliding::Never)));
    faults.or(())
}

/// Refuses hinges with friction that never turn, whose friction couples are only known within bounds.
///
/// # Errors
/// A fault for each of them.
pub(crate) fn never_turning(mechanism: &Mechanism, configuration: &Configuration) -> Result<(), Faults> {
    let mut faults = Faults::default();
    let mut moving = configuration.clone();
    moving.rates.fill(1.0);
    for circle in &mechanism.friction_circles {
        let joint = circle.joint;
        let turning = |mechanism: &Mechanism, state: &Configuration| turns(mechanism, state, joint) != 0.0;
        let stands = !turning(mechanism, configuration) && !is_free(mechanism, configuration, joint);
        if stands && why(mechanism, &moving, &turning) == NoSliding::Never {
            faults.push(does_not_turn(mechanism, joint, NoSliding::Never));
        }
    }
    faults.or(())
}

pub(super) fn does_not_turn(mechanism: &Mechanism, joint: JointId, why: NoSliding) -> Fault {
    let Joint { name, place, .. } = &mechanism.joints[joint.index()];
    Fault::new(FaultKind::HingeDoesNotTurn { hinge: name.to_string(), why }, place.clone())
}

pub(super) fn sense(
    mechanism: &Mechanism,
    configuration: &Configuration,
    influence: &Influence,
    joint: JointId,
) -> Result<f64, NoSliding> {
    let now = turns(mechanism, configuration, joint);
    if now != 0.0 {
        return Ok(now);
    }
    let why = why(mechanism, configuration, &|mechanism, state| turns(mechanism, state, joint) != 0.0);
    if why != NoSliding::Here || is_free(mechanism, configuration, joint) {
        return Err(why);
    }
    let accelerations = |frame: Frame| {
        frame.body().map_or(0.0, |body| influence.frictionless[influence.layout().acceleration(body) + 2])
    };
    let JointKind::Hinge([first, second]) = &mechanism.joints[joint.index()].kind else { return Err(why) };
    let acceleration = accelerations(first.frame) - accelerations(second.frame);
    let greatest = (0..mechanism.bodies.len())
        .map(|body| accelerations(Frame::Body(BodyId(body))).abs())
        .fold(0.0, f64::max);
    if acceleration.abs() > NO_ACCELERATION * greatest { Ok(acceleration.signum()) } else { Err(why) }
}

/// The sense in which a hinge turns: 1, -1, or 0 where it does not within rounding.
fn turns(mechanism: &Mechanism, configuration: &Configuration, joint: JointId) -> f64 {
    let spin = configuration.spin(mechanism, joint);
    let speeds =
        configuration.velocities.iter().map(|v| v.angular.abs().max(v.linear.norm() / mechanism.size));
    let greatest = speeds.fold(0.0, f64::max);
    if spin.abs() <= AT_REST * greatest { 0.0 } else { spin.signum() }
}

/// Whether some free motion turns a hinge in this position.
fn is_free(mechanism: &Mechanism, configuration: &Configuration, joint: JointId) -> bool {
    let JointKind::Hinge(ends) = &mechanism.joints[joint.index()].kind else { return false };
    let motions = free_motions(mechanism, configuration);
    let rotation = |frame: Frame, motion: usize| {
        frame.body().map_or(0.0, |body| motions[(3 * body.index() + 2, motion)])
    };
    (0..motions.ncols()).any(|motion| {
        let [first, second] = ends.each_ref().map(|end| rotation(end.frame, motion));
        (first - second).abs() > NO_ACCELERATION * motions.column(motion).amax()
    })
}
