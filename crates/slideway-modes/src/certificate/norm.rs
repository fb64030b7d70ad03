//! Proofs that symmetric matrices are positive definite, and that the norm of a matrix is below 1.

use nalgebra::DMatrix;

use crate::dense::has_cholesky_factor;
use crate::interval_matrix::{IntervalMatrix, rounding};

/// Whether the largest singular value of all matrices within bounds is below 1: `I - M M^T` is positive definite.
pub(crate) fn has_norm_below_one(matrix: &IntervalMatrix) -> bool {
    let rows = matrix.shape().0;
    is_larger(&IntervalMatrix::exact(DMatrix::identity(rows, rows)), matrix)
}

/// Whether `A A^T - B B^T` is positive definite for all matrices within bounds.
fn is_larger(one: &IntervalMatrix, other: &IntervalMatrix) -> bool {
    let (square, square_spread) = gram(one);
    let (subtracted, subtracted_spread) = gram(other);
    let difference = &square - &subtracted;
    let rounded = (square.abs() + subtracted.abs()) * f64::EPSILON;
    // |error|_2 <= the largest row sum of a symmetric bound.
    let spread = (square_spread + subtracted_spread + rounded) * (1.0 + 8.0 * f64::EPSILON);
    let largest = spread.column_sum().amax() * (1.0 + rounding(spread.nrows())) + f64::MIN_POSITIVE;
    exceeds(difference, largest)
}

/// `M M^T`, and an upper bound on the difference for all `M` within bounds.
fn gram(matrix: &IntervalMatrix) -> (DMatrix<f64>, DMatrix<f64>) {
    let (centre, radius) = (matrix.centre(), matrix.radius());
    let (size, terms) = (centre.abs(), centre.ncols());
    // |M M^T - C C^T| <= R (|C| + R)^T + |C| R^T
    let rounded = &size * size.transpose() * rounding(terms);
    let spread = radius * (&size + radius).transpose() + &size * radius.transpose();
    let factor = 1.0 + 4.0 * rounding(terms);
    let bound = (rounded + spread).map(|value| value * factor + f64::MIN_POSITIVE);
    (centre * centre.transpose(), bound)
}

/// Whether every symmetric matrix is positive definite whose entries differ from these by at most 2^-52 of their size,
/// unless they underflowed.
pub(super) fn is_positive_definite(matrix: DMatrix<f64>) -> bool {
    let size = matrix.nrows();
    // |error|_2 <= the largest row sum of a symmetric bound.
    let largest = matrix.abs().column_sum().amax() * f64::EPSILON * (1.0 + 2.0 * rounding(size));
    exceeds(matrix, largest + size as f64 * f64::MIN_POSITIVE)
}

/// Whether all eigenvalues of every symmetric matrix within `spread` (in the spectral norm) of
/// `matrix` are positive. Only the lower triangle of `matrix` is used.
///
/// If the Cholesky factorization of `G - c I` in plain arithmetic completes, `G` is positive definite,
/// provided that `c >= gamma / (1 - gamma) trace(G)`, `gamma = gamma_{n+2}`, apart from underflow (Rump,
/// Verification of positive definiteness, BIT 46 (2006)); here `spread` is subtracted as well.
fn exceeds(mut matrix: DMatrix<f64>, spread: f64) -> bool {
    let size = matrix.nrows();
    let trace: f64 = matrix.diagonal().iter().map(|value| value.abs()).sum();
    // The last term covers the rounding error of the subtraction itself, and underflow.
    let shift = spread + 4.0 * rounding(size) * (trace + spread) + size as f64 * f64::MIN_POSITIVE;
    for at in 0..size {
        matrix[(at, at)] -= shift;
    }
    matrix.iter().all(|value| value.is_finite()) && has_cholesky_factor(matrix, &mut || true)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An orthogonal matrix with many entries: the spectral radius of their sizes is 4.
    #[test]
    fn the_norm_of_a_rotation_is_below_one_exactly_if_its_factor_is() {
        let is_even = |row: usize, column: usize| (row & column).count_ones().is_multiple_of(2);
        let entry = |row, column| if is_even(row, column) { 0.25 } else { -0.25 };
        let times = |factor: f64| DMatrix::from_fn(16, 16, |row, column| factor * entry(row, column));
        let is_below = |factor: f64, width: f64| {
            let radius = DMatrix::repeat(16, 16, width);
            IntervalMatrix::around(times(factor), radius).is_some_and(|matrix| has_norm_below_one(&matrix))
        };
        assert!(is_below(0.6, 0.0) && is_below(1.0 - 1e-9, 0.0) && is_below(0.6, 1e-3));
        assert!(!is_below(1.0, 0.0) && !is_below(1.0 + 1e-9, 0.0) && !is_below(0.6, 0.1));
    }
}
