//! Proofs that a set of patterns has at most one solution.

use nalgebra::DMatrix;

use super::preconditioned::BaseSystem;
use crate::dense::has_cholesky_factor;
use crate::interval_matrix::{IntervalMatrix, product, rounding};
use crate::problem::{ContactState, ProblemView};

/// Whether the patterns with the given states have at most one solution, because a spectral norm is below 1.
///
/// `partial` has one entry per contact: its state, or `None` for a contact that may take any state. The
/// equations are written as `A x + B |x| = b`, where `x_k = N_k`, `A_k = (c_k^+ - c_k^-) / 2` and
/// `B_k = (c_k^+ + c_k^-) / 2` for undecided contacts, and `x_k = y_k`, `A_k = c_k^sigma`, `B_k = 0` for
/// those pressed on a known side (and likewise for a share `lambda_k`). If
///
/// ```text
/// sigma_max(A^-1 B) < 1,   that is,   A A^T - B B^T is positive definite
/// ```
///
/// there is exactly one `x` for every `b` (theory, section 4 (c)). Thus, if no contact is decided, there is
/// exactly one solution; otherwise there is one if the `x_k` of the decided contacts are admissible, and none
/// if not. This is verified rigorously; `false` means that it was not proved, which is always the case if the
/// right-hand side jumps at an undecided contact.
///
/// # Panics
/// If `partial` does not have one entry per contact.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::certificate::proves_at_most_one;
/// use slideway_modes::ModeProblem;
/// let b = dmatrix![0.5, 0.6; -0.6, 0.5];
/// let identity = dmatrix![1.0, 0.0; 0.0, 1.0];
/// let problem = ModeProblem::from_absolute_value_equation(&identity, &b, dvector![1.0, 1.0])?;
/// assert!(proves_at_most_one(&problem, &[None, None]));
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn proves_at_most_one<'a>(problem: impl Into<ProblemView<'a>>, partial: &[Option<ContactState>]) -> bool {
    let problem = problem.into();
    assert_eq!(partial.len(), problem.contacts(), "one entry per contact");
    let jumps =
        |(contact, state): (usize, &Option<ContactState>)| state.is_none() && problem.has_jump(contact);
    if partial.iter().enumerate().any(jumps) {
        return false;
    }
    let Some(base) = BaseSystem::new(problem, partial) else { return false };
    let Some(inverse) = base.matrix().centre().clone().try_inverse() else { return false };
    // R A and R B instead of A and B: (R A)^-1 R B = A^-1 B.
    let preconditioned = |matrix| product(&inverse, matrix, &mut || true);
    let parts = preconditioned(base.matrix()).zip(preconditioned(base.absolute()));
    parts.is_some_and(|(one, other)| is_larger(&one, &other))
}

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
