//! The least units of force where the forces of the instant vanish: what the loads will reach, and what
//! counts as rounding.

use crate::configuration::{Configuration, Pose};
use crate::ids::{BodyId, Frame};
use crate::kinetics::Applied;
use crate::mechanism::{Effort, LoadKind, Mechanism, Quantity};
use nalgebra::Vector2;

/// Times ahead are powers of this number (s), ...
const FARTHER: f64 = 4.0;
/// ... with exponents up to this one in either direction: 1e-18 s to 1e18 s.
const FARTHEST: i32 = 30;

/// What contributes to a scale.
#[derive(Clone, Copy)]
pub(super) struct Share<'s> {
    /// The bodies that count.
    pub(super) counts: &'s dyn Fn(BodyId) -> bool,
    /// The greatest of their masses (kg), with moments of inertia divided by the square of the mechanism's
    /// size.
    pub(super) mass: f64,
    /// The greatest force of the instant (N).
    pub(super) force: f64,
}

/// The least unit of force (N).
pub(super) type Scale = fn(&Mechanism, &Configuration, Share<'_>) -> f64;

/// The greatest force that the loads and drives reach while they could still take the greatest mass through
/// the size `L` of the mechanism (N):
///
/// ```text
/// max over s of min(F(s), m L/s^2)        F(s): the greatest load a time s ahead, the bodies going on as they move
/// ```
///
/// at powers of 4 s. If the force of the instant is not negligible beside that, the scale is this force
/// itself, or what the rounding of positions makes of springs.
pub(super) fn scale(mechanism: &Mechanism, configuration: &Configuration, share: Share<'_>) -> f64 {
    let greatest_work = share.mass * mechanism.size;
    let now = share.force.max(rounding(mechanism, configuration, share));
    let mut greatest = now;
    let mut ahead = configuration.clone();
    // Relations are then on the pieces of their arguments at that time.
    ahead.pieces = None;
    let mut applied = Applied::new();
    for exponent in (-FARTHEST..=FARTHEST).rev() {
        let step = FARTHER.powi(exponent);
        let bound = greatest_work / (step * step);
        if bound <= greatest {
            continue;
        }
        advance(&mut ahead, configuration, step);
        // Loads without a value at that time do not count.
        let is_known = applied.fill(mechanism, &ahead).is_ok();
        let loads = if is_known { greatest_load(mechanism, &applied, share) } else { 0.0 };
        let force = loads.max(force_of_drives(mechanism, &ahead, share));
        greatest = greatest.max(force.min(bound));
        if force <= bound {
            break;
        }
    }
    if share.force > super::BOUNDARY * greatest { now } else { greatest }
}

/// The greatest of the loads on the bodies that count (N), with couples divided by the size of the mechanism.
fn greatest_load(mechanism: &Mechanism, applied: &Applied, share: Share<'_>) -> f64 {
    let wrenches = applied.wrenches.iter().filter(|wrench| belongs(share, wrench.frame));
    let forces = wrenches.map(|wrench| wrench.force.norm().max(wrench.couple.abs() / mechanism.size));
    forces.fold(0.0, f64::max)
}

fn belongs(share: Share<'_>, frame: Frame) -> bool {
    frame.body().is_some_and(share.counts)
}

/// The force of inertia that the drives require (N).
fn force_of_drives(mechanism: &Mechanism, configuration: &Configuration, share: Share<'_>) -> f64 {
    let one = |drive: &crate::mechanism::Drive| {
        let (Effort::Force { at: crate::mechanism::Attachment { frame, .. }, .. }
        | Effort::Torque { body: frame, .. }) = drive.effort;
        let acceleration = configuration.quantity(mechanism, drive.acceleration).ok()?.abs();
        let is_angle = mechanism.coordinates[drive.coordinate.index()].kind.is_angle();
        let arm = if is_angle { mechanism.size } else { 1.0 };
        belongs(share, frame).then_some(share.mass * acceleration * arm)
    };
    let forces = mechanism.drives.iter().filter_map(one);
    forces.filter(|force| force.is_finite()).fold(0.0, f64::max)
}

/// The scale beside which spring forces that come from rounded positions are negligible (N).
pub(super) fn rounding(mechanism: &Mechanism, configuration: &Configuration, share: Share<'_>) -> f64 {
    let length = mechanism.size;
    let stiffness = |load: &crate::mechanism::Load| {
        let (frames, stiffness, arm): ([Frame; 2], Quantity, f64) = match &load.kind {
            LoadKind::Spring { between, stiffness, .. } => {
                (between.each_ref().map(|end| end.frame), *stiffness, 1.0)
            }
            LoadKind::TorsionalSpring { between, stiffness, .. } => (*between, *stiffness, length * length),
            LoadKind::Pad(pad) if configuration.depth(mechanism, pad)[0] >= 0.0 => {
                let Some(slider) = mechanism.slider(pad.joint) else { return 0.0 };
                ([slider.block, slider.guide], Quantity::Constant(pad.constants[0]), 1.0)
            }
            _ => return 0.0,
        };
        let counts = frames.into_iter().any(|frame| belongs(share, frame));
        let value = configuration.quantity(mechanism, stiffness).map_or(0.0, f64::abs);
        if counts && value.is_finite() { value / arm } else { 0.0 }
    };
    let greatest = mechanism.loads.iter().map(stiffness).fold(0.0, f64::max);
    greatest * length * f64::EPSILON / super::BOUNDARY
}

/// Puts everything where it would be a time ahead at constant velocities.
fn advance(ahead: &mut Configuration, from: &Configuration, step: f64) {
    let moves = from.poses.iter().zip(&from.velocities);
    for (to, (pose, velocity)) in ahead.poses.iter_mut().zip(moves) {
        let moved: Vector2<f64> = pose.position + velocity.linear * step;
        *to = Pose::new(moved, pose.angle() + velocity.angular * step);
    }
    let coordinates = from.coordinates.iter().zip(&from.rates);
    for (to, (value, rate)) in ahead.coordinates.iter_mut().zip(coordinates) {
        *to = value + rate * step;
    }
    ahead.time = from.time + step;
}
