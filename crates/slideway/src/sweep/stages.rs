//! A mechanism in the state of a point, as far as friction does not matter.

use super::columns::{Columns, Output};
use crate::configuration::Configuration;
use crate::fault::Faults;
use crate::influence::Influence;
use crate::kinetics::{Accuracy, Influences, Opening};
use crate::mechanism::Mechanism;
use crate::modes::screen::{MOST_CONTACTS, SmallProblem};
use crate::problem::preload_columns;
use crate::solve::{Trail, mode_problem, sides, sliding_signs};
use nalgebra::{DMatrix, DVector};

type Square = [[f64; MOST_CONTACTS]; MOST_CONTACTS];

/// Everything about a state that does not depend on coefficients of friction and preloads.
#[derive(Debug, Clone)]
pub(super) struct Stages {
    pub(super) configuration: Configuration,
    pub(super) influence: Influence,
    /// Signs of the sliding velocities.
    pub(super) signs: DVector<f64>,
    /// For few contacts: columns, jumps and right-hand side of eq. (6) without any friction, and both versions of
    /// `eta` for the friction of pressure and of preload.
    pub(super) columns: [Square; 2],
    pub(super) jumps: [Square; 2],
    pub(super) right_hand_side: [f64; MOST_CONTACTS],
    pub(super) eta: [Square; 2],
    pub(super) eta_preload: [Square; 2],
    /// Outputs without friction.
    pub(super) frictionless: Vec<f64>,
    /// Contribution of a unit friction to the outputs: contact by contact, for both faces.
    pub(super) influences: Vec<[Vec<f64>; 2]>,
    /// Contribution of a unit friction couple of each friction circle to the outputs.
    pub(super) couples: Vec<Vec<f64>>,
    /// Contribution of a unit normal force of each cut contact of redundant guides to the outputs.
    pub(super) self_stresses: Vec<Vec<f64>>,
    /// The contacts that may lift off, and what their opening adds to the outputs.
    pub(super) openings: Vec<(usize, Vec<f64>)>,
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
        Self::new(mechanism, configuration, influences, columns)
    }

    fn new(
        mechanism: &Mechanism,
        configuration: Configuration,
        influences: Influences,
        columns: &Columns,
    ) -> Result<Self, Faults> {
        let outputs = |unknowns: &DVector<f64>, added: bool| -> Vec<f64> {
            let one = |output: &Output| match *output {
                Output::Coordinate(index) => influences.coordinate(index, unknowns, added),
                Output::Unknown(place, sign) => sign * unknowns[place],
                Output::Gap(_) | Output::Other => 0.0,
            };
            columns.outputs.iter().map(one).collect()
        };
        let frictionless = outputs(&influences.frictionless, false);
        let per_force = |column: &[DVector<f64>; 2]| column.each_ref().map(|face| outputs(face, true));
        let per_force = influences.columns.iter().map(per_force).collect();
        let couples = influences.couples.iter().map(|couple| outputs(couple, true)).collect();
        let self_stresses = influences.self_stresses.iter().map(|stress| outputs(stress, true)).collect();
        let opening = |opening: &Opening| {
            let mut added = outputs(&opening.answer, true);
            let own = |output: &Output| *output == Output::Gap(opening.contact);
            if let Some(own) = columns.outputs.iter().position(own) {
                added[own] = opening.acceleration;
            }
            (opening.contact, added)
        };
        let openings = influences.openings.iter().map(opening).collect();
        let (greatest_load, accuracy) = (influences.greatest_load, influences.accuracy());
        let influence = Influence::of(influences);
        let signs = sliding_signs(mechanism, &configuration);
        let mut stages = Self {
            columns: Default::default(),
            jumps: Default::default(),
            right_hand_side: Default::default(),
            eta: Default::default(),
            eta_preload: Default::default(),
            signs,
            frictionless,
            influences: per_force,
            couples,
            self_stresses,
            openings,
            greatest_load,
            accuracy,
            configuration,
            influence,
        };
        if columns.contacts <= MOST_CONTACTS {
            stages.put_numbers(mechanism)?;
        }
        Ok(stages)
    }

    /// The numbers of eq. (6) for few contacts.
    fn put_numbers(&mut self, mechanism: &Mechanism) -> Result<(), Faults> {
        let eta = sides(mechanism, &self.influence);
        let preload = preload_columns(mechanism, &eta);
        self.eta = [square(&eta.positive), square(&eta.negative)];
        self.eta_preload = [square(&preload.positive), square(&preload.negative)];
        if mechanism.excess.is_empty() && self.openings.is_empty() {
            for (k, force) in self.influence.normal_forces().iter().enumerate() {
                (self.columns[0][k][k], self.columns[1][k][k]) = (1.0, -1.0);
                self.right_hand_side[k] = *force;
            }
            return Ok(());
        }
        let mut frictionless = mechanism.clone();
        self.configuration.put_misalignments(&mut frictionless)?;
        for contact in &mut frictionless.contacts {
            (contact.mu, contact.preload) = ([0.0; 2], [0.0; 2]);
        }
        let problem = mode_problem(&frictionless, &self.influence, &self.signs)?;
        let mut numbers = SmallProblem::new(problem.contacts());
        numbers.copy(&problem);
        (self.columns, self.jumps, self.right_hand_side) =
            (numbers.columns, numbers.jumps, numbers.right_hand_side);
        Ok(())
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
