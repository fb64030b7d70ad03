//! All solutions of linear equations of any rank, as an affine set, and functions on it.

use nalgebra::{DMatrix, DVector};

/// Pivots below this are zero; the equations come in units that make their entries of order one.
const ZERO_PIVOT: f64 = 1e-11;
/// An equation without unknowns is satisfied if no more than this is left over.
const CONSISTENT: f64 = 1e-10;

/// Coefficients below this are rounding errors of terms of order one.
const NO_COEFFICIENT: f64 = 1e-12;

/// An affine expression of the unknowns of equations.
#[derive(Debug, Clone, Default)]
pub(crate) struct AffineExpression {
    /// Unknowns and their coefficients; those of one unknown are added.
    pub(crate) terms: Vec<(usize, f64)>,
    /// The constant.
    pub(crate) constant: f64,
}

impl AffineExpression {
    /// So many times an unknown.
    pub(crate) fn unknown(index: usize, factor: f64) -> Self {
        Self { terms: vec![(index, factor)], constant: 0.0 }
    }

    /// A constant.
    pub(crate) fn constant(constant: f64) -> Self {
        Self { terms: Vec::new(), constant }
    }

    /// With so many times another one added.
    pub(crate) fn plus(mut self, factor: f64, other: &Self) -> Self {
        self.terms.extend(other.terms.iter().map(|(index, value)| (*index, factor * value)));
        self.constant += factor * other.constant;
        self
    }

    /// So many times the expression.
    pub(crate) fn times(&self, factor: f64) -> Self {
        Self::default().plus(factor, self)
    }

    /// With a constant added.
    pub(crate) fn shifted(mut self, constant: f64) -> Self {
        self.constant += constant;
        self
    }
}

/// A function `coefficients . z + constant`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Affine {
    /// Coefficients of the unknowns.
    pub(crate) coefficients: Vec<f64>,
    /// The constant.
    pub(crate) constant: f64,
}

impl Affine {
    /// Its value.
    pub(crate) fn at(&self, z: &[f64]) -> f64 {
        self.coefficients.iter().zip(z).map(|(a, z)| a * z).sum::<f64>() + self.constant
    }

    /// The magnitude of its greatest term.
    pub(crate) fn greatest_term(&self, z: &[f64]) -> f64 {
        let terms = self.coefficients.iter().zip(z).map(|(a, z)| (a * z).abs());
        terms.fold(self.constant.abs(), f64::max)
    }

    /// Whether it is no constant.
    pub(crate) fn varies(&self) -> bool {
        self.coefficients.iter().any(|coefficient| *coefficient != 0.0)
    }
}

/// The solutions `x = particular + directions z` for every `z`.
#[derive(Debug, Clone)]
pub(crate) struct AffineSet {
    /// One solution.
    particular: DVector<f64>,
    /// What may be added, one direction in each column.
    directions: DMatrix<f64>,
}

impl AffineSet {
    /// No unknowns.
    pub(crate) fn empty() -> Self {
        Self { particular: DVector::zeros(0), directions: DMatrix::zeros(0, 0) }
    }

    /// The solutions of `matrix` x = `right_hand_side`, by Gauss-Jordan elimination with complete pivoting;
    /// nothing where the equations contradict each other.
    pub(crate) fn of(mut matrix: DMatrix<f64>, mut right_hand_side: DVector<f64>) -> Option<Self> {
        let pivots = reduce(&mut matrix, &mut right_hand_side);
        if right_hand_side.rows(pivots.len(), matrix.nrows() - pivots.len()).amax() > CONSISTENT {
            return None;
        }
        let columns = matrix.ncols();
        let free: Vec<usize> = (0..columns).filter(|column| !pivots.contains(column)).collect();
        let mut particular = DVector::zeros(columns);
        let mut directions = DMatrix::zeros(columns, free.len());
        for (row, &column) in pivots.iter().enumerate() {
            particular[column] = right_hand_side[row];
            for (index, &other) in free.iter().enumerate() {
                directions[(column, index)] = -matrix[(row, other)];
            }
        }
        for (index, &column) in free.iter().enumerate() {
            directions[(column, index)] = 1.0;
        }
        Some(Self { particular, directions })
    }

    /// One of the solutions.
    pub(crate) fn particular(&self) -> &DVector<f64> {
        &self.particular
    }

    /// The solution with these values of what the equations leave open.
    pub(crate) fn at(&self, free: &DVector<f64>) -> DVector<f64> {
        &self.particular + &self.directions * free
    }

    /// Dimension of what the equations leave open.
    pub(crate) fn dimension(&self) -> usize {
        self.directions.ncols()
    }

    /// An expression of the unknowns as a function of what the equations leave open.
    pub(crate) fn function(&self, expression: &AffineExpression) -> Affine {
        let mut coefficients = vec![0.0; self.dimension()];
        let mut constant = expression.constant;
        for &(column, factor) in &expression.terms {
            constant += factor * self.particular[column];
            for (index, coefficient) in coefficients.iter_mut().enumerate() {
                *coefficient += factor * self.directions[(column, index)];
            }
        }
        for coefficient in &mut coefficients {
            if coefficient.abs() <= NO_COEFFICIENT {
                *coefficient = 0.0;
            }
        }
        Affine { coefficients, constant }
    }
}

/// Turns the leading rows into unit rows of the pivot columns, which are returned, and the others into zero.
fn reduce(matrix: &mut DMatrix<f64>, right_hand_side: &mut DVector<f64>) -> Vec<usize> {
    let mut pivots = Vec::new();
    for row in 0..matrix.nrows().min(matrix.ncols()) {
        let rest = matrix.rows(row, matrix.nrows() - row);
        let (below, column) = rest.iamax_full();
        let pivot = rest[(below, column)];
        if pivot.abs() <= ZERO_PIVOT {
            break;
        }
        matrix.swap_rows(row, row + below);
        right_hand_side.swap_rows(row, row + below);
        matrix.row_mut(row).scale_mut(1.0 / pivot);
        right_hand_side[row] /= pivot;
        for other in (0..matrix.nrows()).filter(|&other| other != row) {
            let factor = matrix[(other, column)];
            if factor != 0.0 {
                for k in 0..matrix.ncols() {
                    matrix[(other, k)] -= factor * matrix[(row, k)];
                }
                matrix[(other, column)] = 0.0;
                right_hand_side[other] -= factor * right_hand_side[row];
            }
        }
        pivots.push(column);
    }
    pivots
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    #[test]
    fn every_solution_satisfies_the_equations() {
        let matrix = dmatrix![1.0, 2.0, 3.0, 4.0; 2.0, 4.0, 6.0, 8.0; 0.0, 1.0, -1.0, 2.0];
        let right_hand_side = dvector![1.0, 2.0, 3.0];
        let set = AffineSet::of(matrix.clone(), right_hand_side.clone()).expect("consistent");
        assert_eq!(set.directions.ncols(), 2);
        assert!((&matrix * &set.particular - right_hand_side).amax() < 1e-14);
        assert!((&matrix * &set.directions).amax() < 1e-14);
    }

    #[test]
    fn contradicting_equations_have_no_solution() {
        let matrix = dmatrix![1.0, 2.0; 2.0, 4.0];
        assert!(AffineSet::of(matrix, dvector![1.0, 3.0]).is_none());
    }

    #[test]
    fn without_equations_everything_is_a_solution() {
        let set = AffineSet::of(DMatrix::zeros(0, 2), DVector::zeros(0)).expect("consistent");
        assert_eq!(set.directions, DMatrix::identity(2, 2));
    }
}
