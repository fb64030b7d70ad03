//! A mechanism in the state of a point, as far as friction does not matter.

use super::columns::{Columns, Output};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::influence::Influence;
use crate::kinetics::{Accuracy, Influences};
use crate::mechanism::Mechanism;
use crate::modes::screen::MOST_CONTACTS;
use crate::solve::{Trail, preload_columns, sides, sliding_signs};
use nalgebra::{DMatrix, DVector};

type Square = [[f64; MOST_CONTACTS]; MOST_CONTACTS];

/// Everything about a state that does not depend on coefficients of friction and preloads.
#[derive(Debug, Clone)]
pub(super) struct Stages {
    pub(super) configuration: Configuration,
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
    /// What a unit normal force of each cut contact of redundant guides adds to the outputs.
    pub(super) self_stresses: Vec<Vec<f64>>,
    /// The greatest applied force (N).
    pub(super) greatest_load: f64,
    /// How well the numbers are known.
    pub(super) accuracy: Accuracy,
}

impl Stages {
    /// The stages of a mechanism, from those of the last points if these are near.
    ///
    /// # Errors
    /// Whatever `solve` refuses, but for contacts at rest.
    pub(super) fn along(trail: &mut Trail, mechanism: &Mechanism, columns: &Columns) -> Result<Self, Faults> {
        let (configuration, influences) = trail.state(mechanism)?;
        Ok(Self::new(mechanism, configuration, influences, columns))
    }

    fn new(
        mechanism: &Mechanism,
        configuration: Configuration,
        influences: Influences,
        columns: &Columns,
    ) -> Self {
        let outputs = |unknowns: &DVector<f64>, without_friction: bool| -> Vec<f64> {
            let one = |output: &Output| match *output {
                Output::Coordinate(index) => influences.coordinate(index, unknowns, without_friction),
                Output::Unknown(place, sign) => sign * unknowns[place],
            };
            columns.outputs.iter().map(one).collect()
        };
        let frictionless = outputs(&influences.frictionless, true);
        let per_force = |column: &[DVector<f64>; 2]| column.each_ref().map(|face| outputs(face, false));
        let per_force = influences.columns.iter().map(per_force).collect();
        let self_stresses = influences.self_stresses.iter().map(|stress| outputs(stress, false)).collect();
        let (greatest_load, accuracy) = (influences.greatest_load, influences.accuracy());
        let influence = Influence::of(influences);
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
        Self {
            signs: sliding_signs(mechanism, &configuration),
            normal_forces: influence.normal_forces(),
            eta,
            eta_preload,
            frictionless,
            influences: per_force,
            self_stresses,
            greatest_load,
            accuracy,
            configuration,
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
