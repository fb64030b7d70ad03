//! All solutions of linear equations of any rank, as an affine set.

use nalgebra::{DMatrix, DVector};

/// Pivots below this are zero; the equations come in units that make their entries of order one.
const ZERO_PIVOT: f64 = 1e-11;
/// An equation without unknowns is satisfied if no more than this is left over.
const CONSISTENT: f64 = 1e-10;

/// The solutions `x = particular + directions z` for every `z`.
#[derive(Debug, Clone)]
pub(crate) struct AffineSet {
    /// One solution.
    pub(crate) particular: DVector<f64>,
    /// What may be added, one direction in each column.
    pub(crate) directions: DMatrix<f64>,
}

impl AffineSet {
    /// The solutions of `matrix` x = `right_hand_side`, by Gauss-Jordan elimination with complete pivoting; nothing
    /// where the equations contradict each other.
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
