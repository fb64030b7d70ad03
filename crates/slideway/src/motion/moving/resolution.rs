//! Whether a step sees what loads and drives do by themselves while it lasts.
//!
//! A step looks at the loads at a few instants; what happens between these neither its error estimate nor the
//! functions that are watched can know. Between two samples at a distance `w` a function of time with slopes
//! from `a` to `b`, which interval arithmetic bounds, is no farther than `w (b - a)/4` from the straight line
//! through them. A step sees a formula if that is at most half of what the samples differ by, so that an
//! oscillation has more than three samples in each period (`w` times its angular frequency is at most 2), or
//! if whatever may hide there changes no velocity by more than the permitted error of a step. The motion's
//! part in a formula varies with the state, which the error estimate follows: it is held.

use super::equations::{bodies_of_drive, independent};
use super::stepper::SAMPLES;
use crate::configuration::Configuration;
use crate::expression::{Symbol, Values};
use crate::ids::{BodyId, FormulaId};
use crate::interval::{Interval, Real, Sloped};
use crate::mechanism::{LoadKind, Mechanism, Quantity, loaded_bodies};

/// Of what the samples of a step differ by, so much may hide between two of them.
const HIDDEN: f64 = 0.5;

/// A formula of time, with the force of which a unit of it is worth.
#[derive(Debug, Clone, Copy)]
struct Changing {
    formula: FormulaId,
    /// A body on which it acts, ...
    body: usize,
    /// ... and the least mass in its part (kg).
    mass: f64,
    /// N for its unit, ...
    force: f64,
    /// ... and for 1 m/s of its unit, of what resists velocities.
    force_of_velocity: f64,
}

/// The formulas of loads and drives that depend on time.
pub(in crate::motion) struct Resolution<'m> {
    mechanism: &'m Mechanism,
    formulas: Vec<Changing>,
    parameters: Vec<Sloped>,
}

impl<'m> Resolution<'m> {
    /// Those of a mechanism that act on some of its bodies.
    pub(in crate::motion) fn of_bodies(mechanism: &'m Mechanism, counts: impl Fn(usize) -> bool) -> Self {
        let mut some = Self::new(mechanism);
        some.formulas.retain(|changing| counts(changing.body));
        some
    }

    /// Those of a mechanism.
    pub(in crate::motion) fn new(mechanism: &'m Mechanism) -> Self {
        let parameters = mechanism.values(&[], &[], 0.0).parameters.iter();
        Self {
            mechanism,
            formulas: formulas(mechanism),
            parameters: parameters.map(|value| Sloped::exactly(*value)).collect(),
        }
    }

    /// Whether nothing depends on time.
    pub(in crate::motion) fn is_empty(&self) -> bool {
        self.formulas.is_empty()
    }

    /// The greatest of a step (s), its half, its quarter and so on, from a state on, that sees all formulas;
    /// at least `least`. Velocities of each body have a magnitude (m/s), and a permitted error in relation to it.
    pub(in crate::motion) fn step(
        &self,
        configuration: &Configuration,
        (velocity, error): (impl Fn(usize) -> f64, f64),
        [mut step, least]: [f64; 2],
    ) -> f64 {
        for changing in &self.formulas {
            let velocity = velocity(changing.body);
            let impulse = error * velocity * changing.mass;
            let force = changing.force + changing.force_of_velocity * velocity;
            while step > 2.0 * least
                && !self.sees(
                    configuration,
                    changing.formula,
                    (step, if impulse > 0.0 { impulse / force } else { 0.0 }),
                )
            {
                step /= 2.0;
            }
        }
        step
    }

    /// Whether a step sees a formula, or what may hide comes to no more than this (its unit times s).
    fn sees(&self, configuration: &Configuration, formula: FormulaId, (step, little): (f64, f64)) -> bool {
        let Configuration { coordinates, rates, time, pieces, .. } = configuration;
        let pieces = pieces.as_deref().map_or(&[][..], |pieces| pieces.of(formula));
        let expression = self.mechanism.expression(formula);
        let places = SAMPLES.map(|fraction| time + fraction * step);
        let at =
            |time: f64| expression.evaluate_on(&self.mechanism.values(coordinates, rates, time), pieces).ok();
        let values = places.map(at);
        // The step itself tells of a time without a value.
        let [Some(a), Some(b), Some(c), Some(d)] = values else { return true };
        let range = a.max(b).max(c).max(d) - a.min(b).min(c).min(d);
        let [coordinates, rates] =
            [coordinates, rates].map(|list| list.iter().map(|x| Sloped::exactly(*x)).collect::<Vec<_>>());
        places.windows(2).all(|ends| {
            let Some(cell) = Interval::new(ends[0], ends[1]) else { return true };
            let values = Values {
                parameters: &self.parameters,
                coordinates: &coordinates,
                rates: &rates,
                time: Sloped::variable(cell),
                sliding_speed: Sloped::exactly(0.0),
            };
            let Ok(Sloped { value, slope }) = expression.evaluate_on(&values, pieces) else { return true };
            let hidden = (cell.width() * slope.width() / 4.0).min(value.width());
            hidden <= HIDDEN * range || hidden * step <= little
        })
    }
}

/// The formulas of loads and drives that depend on time.
fn formulas(mechanism: &Mechanism) -> Vec<Changing> {
    let size = mechanism.size;
    let parts = independent(mechanism);
    let least_mass = |of: usize| {
        let bodies = mechanism.bodies.iter().zip(&parts).filter(|(_, part)| **part == parts[of]);
        let masses = bodies.map(|(body, _)| body.mass).filter(|mass| *mass > 0.0);
        Some(masses.fold(f64::INFINITY, f64::min)).filter(|mass| mass.is_finite()).unwrap_or(0.0)
    };
    let mut found = Vec::new();
    let mut add = |quantity: &Quantity, body: Option<BodyId>, force: f64, force_of_velocity: f64| {
        let (Quantity::Varying(formula), Some(body)) = (*quantity, body) else { return };
        if mechanism.expression(formula).symbols().any(|(symbol, _)| symbol == Symbol::Time) {
            let (body, mass) = (body.index(), least_mass(body.index()));
            found.push(Changing { formula, body, mass, force, force_of_velocity });
        }
    };
    let configuration = Configuration::drawing(mechanism);
    let value = |quantity: &Quantity| configuration.quantity(mechanism, *quantity).map_or(0.0, f64::abs);
    for load in &mechanism.loads {
        let body = loaded_bodies(mechanism, &load.kind).first().copied();
        match &load.kind {
            LoadKind::Force { components, .. } => {
                components.iter().for_each(|force| add(force, body, 1.0, 0.0));
            }
            LoadKind::Torque { moment, .. } => add(moment, body, 1.0 / size, 0.0),
            LoadKind::Spring { stiffness, free_length, .. } => {
                add(stiffness, body, size, 0.0);
                add(free_length, body, value(stiffness), 0.0);
            }
            LoadKind::TorsionalSpring { stiffness, free_angle, .. } => {
                add(stiffness, body, 1.0 / size, 0.0);
                add(free_angle, body, value(stiffness) / size, 0.0);
            }
            LoadKind::Damper { damping, .. } => add(damping, body, 0.0, 1.0),
            LoadKind::TorsionalDamper { damping, .. } => add(damping, body, 0.0, 1.0 / (size * size)),
            // It depends on the motion alone.
            LoadKind::Pad(_) => {}
        }
    }
    for drive in &mechanism.drives {
        let body = bodies_of_drive(mechanism, drive).next();
        let mass = body.map_or(0.0, |body| least_mass(body.index()));
        let is_angle = mechanism.coordinates[drive.coordinate.index()].kind.is_angle();
        add(&drive.acceleration, body, if is_angle { mass * size } else { mass }, 0.0);
    }
    found
}
