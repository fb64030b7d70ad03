//! Approximate inverses of very small matrices, with bounds on their errors.

use super::low_rank::LARGEST_RANK;

/// Rounding error of sums with a small fixed number of terms, with a wide margin.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A vector of which only the first entries are used.
pub(super) type Vector = [f64; LARGEST_RANK];
/// A matrix of which only the first rows and columns are used.
pub(super) type Square = [Vector; LARGEST_RANK];

/// An approximate inverse `R` of a matrix `A`, and bounds on `|I - R A|`.
pub(super) struct Inverse {
    approximate: Square,
    defect: Square,
    rank: usize,
}

impl Inverse {
    /// `None` if elimination breaks down.
    pub(super) fn new(matrix: &Square, rank: usize) -> Option<Self> {
        let approximate = eliminated(*matrix, rank)?;
        let mut defect = [[0.0; LARGEST_RANK]; LARGEST_RANK];
        for row in 0..rank {
            for column in 0..rank {
                let (mut sum, mut size) = (if row == column { 1.0 } else { 0.0 }, 1.0);
                for at in 0..rank {
                    let product = approximate[row][at] * matrix[at][column];
                    sum -= product;
                    size += product.abs();
                }
                defect[row][column] = sum.abs() + size * ROUNDING;
            }
        }
        Some(Self { approximate, defect, rank })
    }

    pub(super) fn times(&self, vector: &Vector) -> Vector {
        std::array::from_fn(|row| (0..self.rank).map(|at| self.approximate[row][at] * vector[at]).sum())
    }

    /// `|R| vector` for a vector without negative entries.
    pub(super) fn size_times(&self, vector: &Vector) -> Vector {
        std::array::from_fn(|row| (0..self.rank).map(|at| self.approximate[row][at].abs() * vector[at]).sum())
    }

    /// A bound on `|I - R A| vector` for a vector without negative entries.
    pub(super) fn defect_times(&self, vector: &Vector) -> Vector {
        let sum = |row: usize| (0..self.rank).map(|at| self.defect[row][at] * vector[at]).sum::<f64>();
        std::array::from_fn(|row| sum(row) * (1.0 + ROUNDING))
    }
}

/// An approximate inverse by Gauss-Jordan elimination with partial pivoting.
fn eliminated(mut matrix: Square, rank: usize) -> Option<Square> {
    let mut inverse = [[0.0; LARGEST_RANK]; LARGEST_RANK];
    (0..rank).for_each(|at| inverse[at][at] = 1.0);
    for step in 0..rank {
        let size = |row: &usize| matrix[*row][step].abs();
        let at = (step..rank).max_by(|one, other| size(one).total_cmp(&size(other)))?;
        matrix.swap(step, at);
        inverse.swap(step, at);
        let pivot = matrix[step][step];
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        let (pivot_row, inverse_row) =
            (matrix[step].map(|entry| entry / pivot), inverse[step].map(|entry| entry / pivot));
        (matrix[step], inverse[step]) = (pivot_row, inverse_row);
        for row in (0..rank).filter(|&row| row != step) {
            let factor = matrix[row][step];
            for column in 0..rank {
                matrix[row][column] -= factor * pivot_row[column];
                inverse[row][column] -= factor * inverse_row[column];
            }
        }
    }
    Some(inverse)
}
