//! A solution at a value of the parameter, in homogeneous unknowns.

use nalgebra::{DMatrix, DVector};

use super::family::Instance;
use crate::blocks::{BlockProblem, BlockSolution, Slopes, load, matrix};
use crate::interval::Sign;
use crate::problem::ContactState;

/// Hinge forces below this share of the largest unknown have no direction.
const NO_DIRECTION: f64 = 1e-13;

/// A point of a curve: `z = (y, lambda)` with `x = unit y / lambda`, and the parameter.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    pub(super) at: f64,
    pub(super) z: DVector<f64>,
}

impl Place {
    /// A solution, with forces in this unit.
    pub(super) fn of(solution: &BlockSolution, at: f64, unit: f64) -> Self {
        let contacts = solution.states.len();
        let rows = contacts + 2 * solution.reactions.len();
        let mut z = DVector::zeros(rows + 1);
        for contact in 0..contacts {
            z[contact] = solution.forces[contact] / unit;
        }
        for share in &solution.gaps {
            z[share.contact] = share.lambda;
        }
        for (row, component) in solution.reactions.as_flattened().iter().enumerate() {
            z[contacts + row] = component / unit;
        }
        z[rows] = 1.0;
        Self { at, z: z.normalize() }
    }

    /// `lambda`.
    pub(super) fn load(&self) -> f64 {
        self.z[self.z.len() - 1]
    }

    /// The length of a hinge force, homogeneous.
    pub(super) fn length(&self, contacts: usize, hinge: usize) -> f64 {
        self.z[contacts + 2 * hinge].hypot(self.z[contacts + 2 * hinge + 1])
    }
}

/// Which equations of a block problem hold along a curve: those of these states of contacts, continued linearly;
/// `None` for contacts without normal force throughout.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Equations {
    pub(super) states: Vec<Option<ContactState>>,
    /// The unit of forces.
    pub(super) unit: f64,
}

impl Equations {
    /// The same in another unit of forces.
    pub(super) fn with_unit(&self, unit: f64) -> Self {
        Self { states: self.states.clone(), unit }
    }

    /// A place of these equations with other ones in another unit.
    pub(super) fn converted(&self, place: &Place, other: &Self) -> Place {
        let mut z = place.z.clone();
        let last = z.len() - 1;
        for (row, value) in z.iter_mut().enumerate().take(last) {
            // Shares of contacts in their gap are numbers, not forces.
            if self.states.get(row) != Some(&Some(ContactState::Gap)) {
                *value *= self.unit / other.unit;
            }
        }
        Place { at: place.at, z: z.normalize() }
    }

    /// `[I - H D, -b]`, whose product with `z` vanishes in solutions.
    pub(super) fn matrix(&self, instance: &Instance, z: &DVector<f64>) -> DMatrix<f64> {
        let problem = &instance.problem;
        let square: DMatrix<f64> = matrix(problem, &self.states, &slopes(problem, z));
        let rows = square.nrows();
        let mut whole = square.insert_column(rows, 0.0);
        // Shares of contacts in their gap are numbers, not forces.
        for (contact, state) in self.states.iter().enumerate() {
            if *state == Some(ContactState::Gap) {
                whole.column_mut(contact).scale_mut(self.unit.recip());
            }
        }
        whole.set_column(rows, &(load::<f64>(problem, &self.states) * -self.unit.recip()));
        whole
    }

    /// The sign of `det(I - H D)`.
    pub(super) fn orientation(&self, instance: &Instance, z: &DVector<f64>) -> Sign {
        if self.determinant(instance, z) < 0.0 { Sign::Negative } else { Sign::Positive }
    }

    /// `det(I - H D)`.
    pub(super) fn determinant(&self, instance: &Instance, z: &DVector<f64>) -> f64 {
        let whole = self.matrix(instance, z);
        whole.columns(0, whole.nrows()).into_owned().determinant()
    }
}

/// The slopes of hinge forces; those of contacts follow from their states.
fn slopes(problem: &BlockProblem, z: &DVector<f64>) -> Slopes {
    let contacts = problem.contacts();
    let least = NO_DIRECTION * z.amax();
    let hinge = |hinge: usize| {
        let [x, y] = [0, 1].map(|axis| z[contacts + 2 * hinge + axis]);
        let length = x.hypot(y);
        if length <= least { [0.0; 2] } else { [x / length, y / length] }
    };
    Slopes { contacts: vec![0.0; contacts], hinges: (0..problem.hinges()).map(hinge).collect() }
}
