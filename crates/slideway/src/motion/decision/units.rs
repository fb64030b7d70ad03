//! Units in which the numbers of a decision are of order one: for the whole mechanism, and for what joints
//! connect.

use super::scale::{Share, scale};
use crate::configuration::Configuration;
use crate::ids::{BodyId, Frame};
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;

/// Units in which the numbers of a decision are of order one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    /// N, or N s for impulses.
    pub(super) force: f64,
    /// m
    pub(super) length: f64,
    /// m/s^2, or m/s for impulses.
    pub(super) acceleration: f64,
}

/// The scale of the forces on some bodies of a mechanism where those of the instant may vanish (N), see [`scale`];
/// 1 N if there are never any.
pub(in crate::motion) fn scale_of_forces(
    mechanism: &Mechanism,
    configuration: &Configuration,
    counts: &dyn Fn(BodyId) -> bool,
) -> f64 {
    let mass = greatest_mass(mechanism, counts);
    let force = scale(mechanism, configuration, Share { counts, mass, force: 0.0 });
    units(mechanism.size, (force, mass), 1.0).force
}

/// The greatest mass of some bodies (kg), with moments of inertia divided by the square of the mechanism's size.
fn greatest_mass(mechanism: &Mechanism, counts: &dyn Fn(BodyId) -> bool) -> f64 {
    let bodies = mechanism.bodies.iter().enumerate().filter(|(index, _)| counts(BodyId(*index)));
    let masses = bodies.map(|(_, body)| body.mass.max(body.moment_of_inertia / mechanism.size.powi(2)));
    masses.fold(0.0, f64::max)
}

/// The greatest of the loads, preloads and forces of inertia of some bodies (N), and their greatest mass
/// (kg).
pub(super) fn greatest(
    mechanism: &Mechanism,
    (influence, equations): (&Influence, &KineticEquations),
    counts: &dyn Fn(BodyId) -> bool,
) -> (f64, f64) {
    let length = mechanism.size;
    let bodies = || mechanism.bodies.iter().enumerate().filter(|(index, _)| counts(BodyId(*index)));
    let belongs = |frame: Frame| frame.body().is_some_and(counts);
    let loads = equations.applied.iter().filter(|wrench| belongs(wrench.frame));
    let loads = loads.map(|wrench| wrench.force.norm().max(wrench.couple.abs() / length));
    let preloads = mechanism.contacts.iter().filter(|contact| {
        mechanism.slider(contact.joint).is_some_and(|slider| belongs(slider.block) || belongs(slider.guide))
    });
    let preloads = preloads.flat_map(|contact| contact.preload);
    let inertia = bodies().flat_map(|(index, body)| {
        let [x, y, turn] = [0, 1, 2].map(|part| influence.frictionless[3 * index + part]);
        [body.mass * x, body.mass * y, body.moment_of_inertia * turn / length]
    });
    (loads.chain(preloads).chain(inertia).map(f64::abs).fold(0.0, f64::max), greatest_mass(mechanism, counts))
}

/// Units in which the given force is one; if there is no force, the fallback is one.
pub(super) fn units(length: f64, (force, mass): (f64, f64), otherwise: f64) -> Units {
    let force = if force > 0.0 && force.is_finite() { force } else { otherwise };
    Units { force, length, acceleration: if mass > 0.0 { force / mass } else { 1.0 } }
}
