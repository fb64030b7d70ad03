//! What of the loads changes with time by itself, where nothing moves.

use crate::configuration::Configuration;
use crate::expression::{Symbol, Values};
use crate::fault::Fault;
use crate::interval::{Interval, Real, Sloped};
use crate::mechanism::{Load, LoadKind, Mechanism, Pieces, Quantity, length, loaded_bodies};
use std::sync::Arc;

/// A number to which what a load puts on the bodies is proportional, but for a part that does not change.
#[derive(Debug, Clone, Copy)]
enum Amount {
    /// A component of a force (N), or a moment (N m).
    Value(Quantity),
    /// That of a spring (N or N m): stiffness times (extent less free extent).
    Tension { stiffness: Quantity, extent: f64, free: Quantity },
}

/// The amounts of the loads that change with time while a mechanism stays in a configuration: functions of
/// time alone.
#[derive(Debug, Clone)]
pub(in crate::motion) struct Amounts<'m> {
    mechanism: &'m Mechanism,
    list: Vec<(Amount, Load)>,
    coordinates: Vec<f64>,
    rates: Vec<f64>,
    pieces: Option<Arc<Pieces>>,
    /// Parameters, coordinates and rates.
    fixed: [Vec<Sloped>; 3],
}

impl<'m> Amounts<'m> {
    /// The amounts of the loads on bodies that stand still in a configuration, with relations on the pieces
    /// of that.
    pub(in crate::motion) fn new(
        mechanism: &'m Mechanism,
        configuration: &Configuration,
        rests: &[bool],
    ) -> Self {
        let acts = |load: &&Load| loaded_bodies(mechanism, &load.kind).iter().any(|body| rests[body.index()]);
        let one = |load: &Load| amounts_of(mechanism, configuration, load);
        let Configuration { coordinates, rates, pieces, .. } = configuration;
        let exactly = |values: &[f64]| values.iter().map(|value| Sloped::exactly(*value)).collect();
        let parameters = mechanism.values(&[], &[], 0.0).parameters;
        Self {
            mechanism,
            list: mechanism.loads.iter().filter(acts).flat_map(one).collect(),
            coordinates: coordinates.clone(),
            rates: rates.clone(),
            pieces: pieces.clone(),
            fixed: [exactly(parameters), exactly(coordinates), exactly(rates)],
        }
    }

    /// For each amount the load of which there is one unit, and nothing else.
    pub(in crate::motion) fn units(&self) -> impl Iterator<Item = &Load> {
        self.list.iter().map(|(_, unit)| unit)
    }

    /// The amounts at a time.
    ///
    /// # Errors
    /// One without a value.
    pub(in crate::motion) fn at(&self, time: f64) -> Result<Vec<f64>, Fault> {
        let values = self.mechanism.values(&self.coordinates, &self.rates, time);
        let pieces = self.pieces.as_deref();
        let quantity = |quantity| self.mechanism.quantity_on(quantity, &values, pieces);
        self.list.iter().map(|(amount, _)| amount.of(quantity)).collect()
    }

    /// The amounts over a span of time, with bounds of their rates; nothing where one has no value for some
    /// of it.
    pub(in crate::motion) fn over(&self, span: Interval) -> Option<Vec<Sloped>> {
        let [parameters, coordinates, rates] = &self.fixed;
        let values = Values {
            parameters,
            coordinates,
            rates,
            time: Sloped::variable(span),
            sliding_speed: Sloped::exactly(0.0),
        };
        let pieces = self.pieces.as_deref();
        let quantity = |quantity| match quantity {
            Quantity::Constant(value) => Ok(Sloped::exactly(value)),
            Quantity::Varying(id) => {
                let pieces = pieces.map_or(&[][..], |pieces| pieces.of(id));
                self.mechanism.expression(id).evaluate_on(&values, pieces)
            }
        };
        self.list.iter().map(|(amount, _)| amount.of(quantity).ok()).collect()
    }
}

impl Amount {
    fn of<T: Real, E>(self, quantity: impl Fn(Quantity) -> Result<T, E>) -> Result<T, E> {
        match self {
            Self::Value(value) => quantity(value),
            Self::Tension { stiffness, extent, free } => {
                Ok(quantity(stiffness)? * (T::exactly(extent) - quantity(free)?))
            }
        }
    }
}

/// The amounts of a load that change with time, each with the load of which there is one unit and nothing
/// else; what resists velocities does nothing at rest.
fn amounts_of(mechanism: &Mechanism, configuration: &Configuration, load: &Load) -> Vec<(Amount, Load)> {
    let changes = |quantity: &Quantity| match quantity {
        Quantity::Constant(_) => false,
        Quantity::Varying(id) => {
            mechanism.expression(*id).symbols().any(|(symbol, _)| symbol == Symbol::Time)
        }
    };
    let constant = Quantity::Constant;
    let with = |kind: LoadKind| Load { kind, ..load.clone() };
    match &load.kind {
        LoadKind::Force { components, .. } => {
            let unit = |index: usize| {
                let mut kind = load.kind.clone();
                if let LoadKind::Force { components, .. } = &mut kind {
                    *components = [constant(0.0); 2];
                    components[index] = constant(1.0);
                }
                with(kind)
            };
            let changing = (0..2).filter(|index| changes(&components[*index]));
            changing.map(|index| (Amount::Value(components[index]), unit(index))).collect()
        }
        LoadKind::Torque { body, moment, tilt, reaction } if changes(moment) => {
            let unit =
                LoadKind::Torque { body: *body, moment: constant(1.0), tilt: *tilt, reaction: *reaction };
            vec![(Amount::Value(*moment), with(unit))]
        }
        LoadKind::Spring { between, stiffness, free_length }
            if changes(stiffness) || changes(free_length) =>
        {
            let [first, second] = between.each_ref().map(|end| configuration.position(mechanism, end));
            let extent = length(second - first);
            if extent == 0.0 {
                // Its force has no direction, unless it is zero.
                return Vec::new();
            }
            let unit = LoadKind::Spring {
                between: *between,
                stiffness: constant(1.0),
                free_length: constant(extent - 1.0),
            };
            vec![(Amount::Tension { stiffness: *stiffness, extent, free: *free_length }, with(unit))]
        }
        LoadKind::TorsionalSpring { between, stiffness, free_angle }
            if changes(stiffness) || changes(free_angle) =>
        {
            let extent = configuration.angle(between[0]) - configuration.angle(between[1]);
            let unit = LoadKind::TorsionalSpring {
                between: *between,
                stiffness: constant(1.0),
                free_angle: constant(extent - 1.0),
            };
            vec![(Amount::Tension { stiffness: *stiffness, extent, free: *free_angle }, with(unit))]
        }
        _ => Vec::new(),
    }
}
