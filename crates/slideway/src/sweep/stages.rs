//! A mechanism in the state of a point, as far as friction does not matter.

use super::columns::{Columns, Output};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::Mechanism;
use crate::modes::screen::MOST_CONTACTS;
use crate::solve::{preload_columns, sides, sliding_signs};
use nalgebra::{DMatrix, DVector};

type Square = [[f64; MOST_CONTACTS]; MOST_CONTACTS];

/// States that are extrapolated.
const REMEMBERED: usize = 3;
/// Rounding of a state's numbers, as a part of the condition of its equations.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Everything about a state that does not depend on coefficients of friction and preloads.
#[derive(Debug, Clone)]
pub(super) struct Stages {
    pub(super) configuration: Configuration,
    pub(super) equations: KineticEquations,
    pub(super) influence: Influence,
    /// Signs of the sliding velocities.
    pub(super) signs: DVector<f64>,
    /// `N(0)`, and both versions of `eta` for the friction of pressure and of preload, for few contacts.
    pub(super) normal_forces: DVector<f64>,
    pub(super) eta: [Square; 2],
    pub(super) eta_preload: [Square; 2],
    /// Outputs without friction.
    pub(super) frictionless: Vec<f64>,
    /// What a unit friction adds to the outputs: contact by contact, for both faces.
    pub(super) influences: Vec<[Vec<f64>; 2]>,
    /// The greatest applied force (N).
    pub(super) greatest_load: f64,
    /// How well the numbers are known, as a part of them.
    pub(super) accuracy: f64,
}

/// The states of the last points, from which the next one is reached.
#[derive(Debug, Default)]
pub(super) struct Trail {
    reached: Vec<Configuration>,
    equations: Option<KineticEquations>,
}

impl Trail {
    /// The stages of a mechanism, from those of the last points if these are near.
    ///
    /// # Errors
    /// Whatever `solve` refuses, but for contacts at rest.
    pub(super) fn stages(&mut self, mechanism: &Mechanism, columns: &Columns) -> Result<Stages, Faults> {
        let configuration = match Configuration::near(mechanism, &self.reached) {
            Some(configuration) => configuration,
            None => Configuration::new(mechanism).inspect_err(|_| self.reached.clear())?,
        };
        self.reached.insert(0, configuration.clone());
        self.reached.truncate(REMEMBERED);
        let equations = match &self.equations {
            Some(neighbour) => KineticEquations::near(mechanism, &configuration, neighbour)?,
            None => KineticEquations::new(mechanism, &configuration)?,
        };
        let stages = Stages::new(mechanism, configuration, equations, columns);
        if self.equations.is_none() {
            self.equations = Some(stages.equations.clone());
        }
        Ok(stages)
    }
}

impl Stages {
    fn new(
        mechanism: &Mechanism,
        configuration: Configuration,
        equations: KineticEquations,
        columns: &Columns,
    ) -> Self {
        let influence = Influence::new(&equations);
        let (eta, eta_preload) = if columns.contacts <= MOST_CONTACTS {
            let eta = sides(mechanism, &influence);
            let preload = preload_columns(mechanism, &eta);
            (
                [square(&eta.positive), square(&eta.negative)],
                [square(&preload.positive), square(&preload.negative)],
            )
        } else {
            Default::default()
        };
        let outputs = |unknowns: &DVector<f64>| -> Vec<f64> {
            let one = |output: &Output| match *output {
                Output::Coordinate(index) => equations.coordinate_part(index, unknowns),
                Output::Unknown(place, sign) => sign * unknowns[place],
            };
            columns.outputs.iter().map(one).collect()
        };
        let mut frictionless = outputs(&influence.frictionless);
        for (value, output) in frictionless.iter_mut().zip(&columns.outputs) {
            if let Output::Coordinate(index) = output {
                *value -= equations.coordinate_bias(*index);
            }
        }
        let influences = influence.columns.iter().map(|column| column.each_ref().map(&outputs)).collect();
        Self {
            signs: sliding_signs(mechanism, &configuration),
            normal_forces: influence.normal_forces(),
            eta,
            eta_preload,
            frictionless,
            influences,
            greatest_load: equations.applied.iter().map(|load| load.force.norm()).fold(0.0, f64::max),
            accuracy: ROUNDING * equations.condition(),
            configuration,
            equations,
            influence,
        }
    }
}

fn square(matrix: &DMatrix<f64>) -> Square {
    let mut square = Square::default();
    for (target, column) in square.iter_mut().zip(matrix.column_iter()) {
        for (target, value) in target.iter_mut().zip(&column) {
            *target = *value;
        }
    }
    square
}
