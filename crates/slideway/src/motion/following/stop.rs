//! End stops along a motion: impacts, and when bouncing has come to rest.

use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::ids::JointId;
use crate::mechanism::Mechanism;
use crate::motion::decision::rules::{Decisions, EventInstant};
use crate::motion::decision::{Impact, TOUCHES, impact_within, relative_velocities, sliding_accelerations};
use crate::motion::moving::cause::Cause;
use crate::progress::Work;

/// A joint that has reached an end stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::motion) struct Hit {
    pub(in crate::motion) joint: JointId,
    /// Whether it is the stop at the greatest displacement.
    pub(in crate::motion) greatest: bool,
    restitution: f64,
    /// Where the stop is (m).
    pub(in crate::motion) displacement: f64,
}

/// The stop that a joint has at an end of its travel.
pub(in crate::motion) fn of_limit(mechanism: &Mechanism, joint: JointId, greatest: bool) -> Option<Hit> {
    let slider = mechanism.slider(joint)?;
    let end = usize::from(greatest);
    let (restitution, displacement) = (slider.stops[end]?.restitution()?, slider.travel?[end]);
    Some(Hit { joint, greatest, restitution, displacement })
}

/// The stops that are reached with these causes.
pub(in crate::motion) fn hits(mechanism: &Mechanism, causes: &[Cause]) -> Vec<Hit> {
    let hit = |cause: &Cause| match cause {
        Cause::TravelLimit { joint, greatest } => of_limit(mechanism, *joint, *greatest),
        _ => None,
    };
    causes.iter().filter_map(hit).collect()
}

/// The impact on stops: with their restitution, or without where the next flight would be within the rounding
/// of places, so that what bounces has come to rest at its stop. Of each sliding joint and hinge with friction the velocity is
/// given below which it stands still.
///
/// # Errors
/// As [`impact`](crate::motion::decision::impact()), and whatever keeps the next flight from being decided.
pub(in crate::motion) fn impact_of(
    hits: &[Hit],
    (mechanism, configuration): (&Mechanism, &Configuration),
    (little, work): (&[f64], Work<'_>),
    decisions: &mut dyn Decisions,
) -> Result<Impact, Faults> {
    let mut stops: Vec<(JointId, f64)> = hits.iter().map(|hit| (hit.joint, hit.restitution)).collect();
    loop {
        let rebound = impact_within(mechanism, configuration, &stops, work)?;
        let mut rests = false;
        for (hit, (_, restitution)) in hits.iter().zip(&mut stops) {
            if *restitution > 0.0 && !flies(*hit, (mechanism, &rebound.after), (little, work), decisions)? {
                *restitution = 0.0;
                rests = true;
            }
        }
        if !rests {
            return Ok(rebound);
        }
    }
}

/// Whether the way of the flight after an impact can be told from rounding: `u^2/(2 a)` with the velocity `u`
/// away from the stop and the acceleration `a` towards it.
fn flies(
    hit: Hit,
    (mechanism, after): (&Mechanism, &Configuration),
    (little, work): (&[f64], Work<'_>),
    decisions: &mut dyn Decisions,
) -> Result<bool, Faults> {
    let joints = crate::motion::moving::equations::sliding_joints(mechanism);
    let velocities = relative_velocities(mechanism, after);
    let Some(index) = joints.iter().position(|joint| *joint == hit.joint) else { return Ok(true) };
    let sign =
        |(velocity, little): (&f64, &f64)| if velocity.abs() <= *little { 0.0 } else { velocity.signum() };
    let signs: Vec<f64> = velocities.iter().zip(little).map(sign).collect();
    let (signs, spins) = signs.split_at(joints.len());
    let instant = EventInstant {
        mechanism,
        configuration: after,
        signs,
        spins,
        zero: &[],
        rounding: &[],
        previous: None,
        work,
    };
    let Some(next) = decisions.successors(&instant)?.list.into_iter().next() else { return Ok(true) };
    let Some(accelerations) = sliding_accelerations(mechanism, after, &next.phase)? else {
        return Ok(true);
    };
    let towards = accelerations[index] * if hit.greatest { 1.0 } else { -1.0 };
    Ok(towards <= 0.0 || velocities[index].powi(2) > 2.0 * towards * TOUCHES * mechanism.size)
}
