//! Right-hand sides that follow from the solutions of other groups, with bounds of their errors.

use nalgebra::{DMatrix, DVector};

use crate::modes::certificate::{IntervalMatrix, IntervalModeProblem};
use crate::modes::problem::{BySide, ModeProblem, ModeProblemError, Side};
use crate::modes::solutions::ContactState;

/// A right-hand side that is known within `radius`, row by row.
#[derive(Debug, Clone)]
pub(super) struct Load {
    pub(super) middle: DVector<f64>,
    pub(super) radius: DVector<f64>,
}

/// The equations of some contacts with a right-hand side within bounds.
#[derive(Debug, Clone)]
pub(super) struct LoadedProblem {
    pub(super) problem: ModeProblem,
    /// How far each entry of the right-hand side may be off; zero if it is exact.
    pub(super) radius: DVector<f64>,
}

impl Load {
    /// The right-hand side of a problem as given.
    pub(super) fn exact(problem: &ModeProblem) -> Self {
        let middle = problem.right_hand_side().clone();
        Self { radius: DVector::zeros(middle.len()), middle }
    }

    /// Adds `d_k - c_k y_k` of a contact, where `y_k` is known within `radius`.
    pub(super) fn add_contact(
        &mut self,
        problem: &ModeProblem,
        contact: usize,
        state: ContactState,
        y: f64,
        radius: f64,
    ) {
        // What a jump reaches is in the contact's own group: elsewhere both sides are equal.
        let side = if state == ContactState::Positive { Side::Positive } else { Side::Negative };
        self.add(problem.jumps(side).column(contact).as_slice(), 1.0, 0.0);
        if state != ContactState::Gap {
            self.add(problem.columns(side).column(contact).as_slice(), -y, radius);
        }
    }

    /// Adds `factor * column`, and what the factor's error and rounding may amount to.
    fn add(&mut self, column: &[f64], factor: f64, radius: f64) {
        for (row, &entry) in column.iter().enumerate().filter(|(_, entry)| **entry != 0.0) {
            let term = factor * entry;
            let before = self.middle[row].abs();
            self.middle[row] += term;
            // Twice the unit roundoff of each operation, which covers the rounding of this bound.
            let rounding = 4.0 * f64::EPSILON * (before + term.abs() + f64::MIN_POSITIVE);
            self.radius[row] += radius * entry.abs() * (1.0 + 4.0 * f64::EPSILON) + rounding;
            self.radius[row] = self.radius[row].next_up();
        }
    }
}

impl LoadedProblem {
    /// The equations and columns of some contacts alone.
    pub(super) fn restricted(
        problem: &ModeProblem,
        contacts: &[usize],
        load: &Load,
    ) -> Result<Self, ModeProblemError> {
        let size = contacts.len();
        let part = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(size, size, |row, column| matrix[(contacts[row], contacts[column])])
        };
        let rows = |vector: &DVector<f64>| DVector::from_fn(size, |row, _| vector[contacts[row]]);
        let problem = ModeProblem::new(
            part(problem.columns(Side::Positive)),
            part(problem.columns(Side::Negative)),
            part(problem.jumps(Side::Positive)),
            part(problem.jumps(Side::Negative)),
            rows(&load.middle),
        )?;
        Ok(Self { problem, radius: rows(&load.radius) })
    }

    /// Whether the right-hand side is exact.
    pub(super) fn is_exact(&self) -> bool {
        self.radius.iter().all(|&radius| radius == 0.0)
    }

    /// The problems for all right-hand sides within bounds; none if the bounds overflow.
    pub(super) fn within_bounds(&self) -> Option<IntervalModeProblem> {
        let exact = |side: fn(&ModeProblem, Side) -> &DMatrix<f64>| BySide {
            positive: IntervalMatrix::exact(side(&self.problem, Side::Positive).clone()),
            negative: IntervalMatrix::exact(side(&self.problem, Side::Negative).clone()),
        };
        let column = |vector: &DVector<f64>| DMatrix::from_column_slice(vector.len(), 1, vector.as_slice());
        let load = IntervalMatrix::around(column(self.problem.right_hand_side()), column(&self.radius))?;
        IntervalModeProblem::new(&exact(ModeProblem::columns), &exact(ModeProblem::jumps), &load).ok()
    }
}
