//! Energies, and the powers whose integrals the balance needs.

use super::equations::Equations;
use crate::configuration::Configuration;
use crate::ids::DriveId;
use crate::kinetics::velocity_of_effort;
use crate::mechanism::{Load, LoadKind, Mechanism, Quantity, length};

/// Kinetic energy (J): sum of m v^2 / 2 + J omega^2 / 2.
pub(in crate::motion) fn kinetic(mechanism: &Mechanism, configuration: &Configuration) -> f64 {
    let bodies = mechanism.bodies.iter().zip(&configuration.velocities);
    let one = |(body, velocity): (&crate::mechanism::Body, &crate::configuration::Velocity)| {
        let turning = body.moment_of_inertia * velocity.angular.powi(2);
        f64::midpoint(body.mass * velocity.linear.norm_squared(), turning)
    };
    bodies.map(one).sum()
}

/// Potential energy of weights, pads, springs and torsional springs with constant properties (J); weights
/// count from the origin.
pub(in crate::motion) fn potential(mechanism: &Mechanism, configuration: &Configuration) -> f64 {
    let bodies = mechanism.bodies.iter().zip(&configuration.poses);
    let weights: f64 = bodies.map(|(body, pose)| -body.mass * mechanism.gravity.dot(&pose.position)).sum();
    let springs: f64 = mechanism.loads.iter().map(|load| elastic(mechanism, configuration, load)).sum();
    weights + springs
}

/// k (length - free length)^2 / 2
fn elastic(mechanism: &Mechanism, configuration: &Configuration, load: &Load) -> f64 {
    let (stiffness, stretch) = match &load.kind {
        LoadKind::Spring {
            between,
            stiffness: Quantity::Constant(stiffness),
            free_length: Quantity::Constant(free_length),
        } => {
            let [first, second] = between.each_ref().map(|end| configuration.position(mechanism, end));
            (*stiffness, length(second - first) - free_length)
        }
        LoadKind::TorsionalSpring {
            between: [first, second],
            stiffness: Quantity::Constant(stiffness),
            free_angle: Quantity::Constant(free_angle),
        } => (*stiffness, configuration.angle(*first) - configuration.angle(*second) - free_angle),
        LoadKind::Pad(pad) => return pad.elastic(configuration.depth(mechanism, pad))[0],
        _ => return 0.0,
    };
    stiffness * stretch.powi(2) / 2.0
}

/// Whether the work of a load is counted as potential energy: a spring that does not change, a pad without
/// damping.
pub(in crate::motion) fn is_conservative(load: &Load) -> bool {
    let constant = |quantity: &Quantity| matches!(quantity, Quantity::Constant(_));
    match &load.kind {
        LoadKind::Spring { stiffness, free_length, .. } => constant(stiffness) && constant(free_length),
        LoadKind::TorsionalSpring { stiffness, free_angle, .. } => {
            constant(stiffness) && constant(free_angle)
        }
        LoadKind::Pad(pad) => pad.constants[1] == 0.0,
        _ => false,
    }
}

/// Power of the friction of every contact (W, what it dissipates is positive), then of every load and drive, then of the
/// friction of every hinge.
pub(in crate::motion) fn powers(equations: &Equations<'_>, powers: &mut [f64]) {
    let (contacts, others) = powers.split_at_mut(equations.contacts.len());
    let (loads, others) = others.split_at_mut(equations.mechanism.loads.len());
    let (drives, hinges) = others.split_at_mut(equations.mechanism.drives.len());
    for (hinge, power) in hinges.iter_mut().enumerate() {
        *power = equations.power_of_hinge(hinge);
    }
    for (k, power) in contacts.iter_mut().enumerate() {
        let friction = equations.friction_force(k).unwrap_or(0.0);
        *power = friction * equations.contacts[k].sliding_velocity;
    }
    for (index, power) in loads.iter_mut().enumerate() {
        *power = if equations.conservative[index] {
            0.0
        } else {
            let wrenches = equations.applied.of_load(index).iter();
            let power: f64 = wrenches.map(|wrench| wrench.power(&equations.configuration)).sum();
            power + stored(equations, &equations.mechanism.loads[index])
        };
    }
    for (index, power) in drives.iter_mut().enumerate() {
        let effort = &equations.mechanism.drives[index].effort;
        let unit = velocity_of_effort(equations.mechanism, &equations.configuration, effort);
        *power = equations.effort(DriveId(index)) * unit;
    }
}

/// The power that a load stores as potential energy while the rest of it is work (W): the spring of a pad.
/// The block leaves the pad before that is back at its place; what is stored then is lost in the damper.
fn stored(equations: &Equations<'_>, load: &Load) -> f64 {
    match &load.kind {
        LoadKind::Pad(pad) => pad.elastic(equations.configuration.depth(equations.mechanism, pad))[1],
        _ => 0.0,
    }
}
