//! Verified solutions of linear systems.
//!
//! From `P A ~ L U` in plain arithmetic and approximate inverses `X_L` and `X_U` of the triangular factors,
//! `R = X_U X_L P` is an approximate inverse of `A` whose determinant has a known sign. If `|I - R A| f < f`
//! for some `f > 0`, then `A` is regular, `det(R A) > 0`, and (Krawczyk)
//!
//! ```text
//! |A^-1 b - x - delta| <= f    if    |R (b - A x) - delta| + |I - R A| (|delta| + f) <= f
//! ```
//!
//! for every matrix and right-hand side within the given bounds (Rump, Verification methods, Acta
//! Numerica 19 (2010)).

use nalgebra::{DMatrix, DVector};

use super::system::{BoundedVector, PatternSystem};
use crate::dense::{self, Pace};
use crate::interval::{Interval, Sign};
use crate::interval_matrix::{IntervalMatrix, product, rounding, upper_product, upper_sum};
use crate::problem::{ContactState, ProblemView};

/// Maximum number of enlargements of a trial bound.
const INFLATIONS: usize = 16;
/// The factor by which it is enlarged beyond what is needed.
const INFLATION: f64 = 1.1;
/// Products with a square matrix that each column of an enclosure takes, about.
const PRODUCTS_OF_COLUMN: usize = 16;

/// An approximate inverse `R = X_U X_L P` of an interval matrix, with bounds on `|I - R A|`.
pub(super) struct ApproximateInverse {
    lower: DMatrix<f64>,
    upper: DMatrix<f64>,
    lower_size: DMatrix<f64>,
    upper_size: DMatrix<f64>,
    /// Upper bounds on `|X_U X_L|`.
    inverse_size: DMatrix<f64>,
    /// Row `i` of `P A` is row `rows[i]` of `A`.
    rows: Vec<usize>,
    sign: Sign,
    /// `|I - fl(R A)|`.
    defect: DMatrix<f64>,
    /// `|P A|`, `|fl(X_L P A)|` and the radius of `P A`, which bound the rounding errors of `fl(R A)`.
    matrix_size: DMatrix<f64>,
    product_size: DMatrix<f64>,
    radius: DMatrix<f64>,
}

impl ApproximateInverse {
    /// `None` if elimination breaks down or numbers overflow, or once `proceed` is `false`.
    pub(super) fn new(matrix: &IntervalMatrix, proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let size = matrix.shape().0;
        let mut factors = matrix.centre().clone();
        let (rows, swaps_are_odd) = eliminate(&mut factors, proceed)?;
        let (lower, upper) = (invert_unit_lower(&factors, proceed)?, invert_upper(&factors, proceed)?);
        let permuted = matrix.centre().select_rows(&rows);
        let partial = dense::product(&lower, &permuted, proceed)?;
        let mut defect = dense::product(&upper, &partial, proceed)?;
        defect.neg_mut();
        for at in 0..size {
            defect[(at, at)] += 1.0;
        }
        if defect.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let negative = (0..size).filter(|&at| upper[(at, at)] < 0.0).count() + usize::from(swaps_are_odd);
        Some(Self {
            sign: if negative % 2 == 0 { Sign::Positive } else { Sign::Negative },
            lower_size: lower.abs(),
            upper_size: upper.abs(),
            inverse_size: size_of_product(&upper, &lower, proceed)?,
            lower,
            upper,
            defect: defect.abs(),
            matrix_size: permuted.abs(),
            product_size: partial.abs(),
            radius: matrix.radius().select_rows(&rows),
            rows,
        })
    }

    /// The sign of `det A`, provided that an enclosure was verified.
    pub(super) fn determinant_sign(&self) -> Sign {
        self.sign
    }

    /// `R v` in plain arithmetic.
    pub(super) fn apply(&self, vector: &DVector<f64>) -> DVector<f64> {
        &self.upper * (&self.lower * vector.select_rows(&self.rows))
    }

    /// `R v` with a bound on its error.
    fn apply_bounded(&self, vector: &BoundedVector) -> BoundedVector {
        let eps = rounding(self.rows.len());
        let permuted = vector.centre.select_rows(&self.rows);
        let partial = &self.lower * &permuted;
        // |R v - fl(R v)| <= |X_U X_L| P bound + |X_U| (gamma |X_L| |P v| + gamma |fl(X_L P v)|) + underflow.
        let inner = upper_product(&self.lower_size, &covered(&permuted, eps));
        let rounded = upper_product(&self.upper_size, &upper_sum(&[&inner, &covered(&partial, eps)]));
        let spread = upper_product(&self.inverse_size, &vector.bound.select_rows(&self.rows));
        let bound = upper_sum(&[&spread, &rounded]);
        BoundedVector { centre: &self.upper * partial, bound }
    }

    /// An upper bound on `|I - R A| v` for `v >= 0`.
    ///
    /// `|I - R A| <= |I - fl(R A)| + gamma |X_U| (|X_L| |P A| + |fl(X_L P A)|) + |X_U X_L| P rad(A)`.
    fn defect_times(&self, vector: &DVector<f64>) -> DVector<f64> {
        let eps = rounding(self.rows.len());
        let matrix_part = upper_product(&self.matrix_size, vector) * eps;
        let spread = upper_product(&self.inverse_size, &upper_product(&self.radius, vector));
        let inner = upper_product(&self.lower_size, &matrix_part);
        let product_part = upper_product(&self.product_size, vector) * eps;
        // The loss by underflow of products in the entries of fl(R A).
        let underflow = self.rows.len() as f64 * f64::MIN_POSITIVE * vector.sum();
        let below = DVector::repeat(self.rows.len(), underflow + f64::MIN_POSITIVE);
        let outer = upper_product(&self.upper_size, &upper_sum(&[&inner, &product_part, &below]));
        let computed = upper_product(&self.defect, vector);
        upper_sum(&[&computed, &outer, &spread, &below])
    }

    /// `delta` and `f` with `|A^-1 b - x - delta| <= f`, given the residual `b - A x`; `None` if that cannot
    /// be verified.
    pub(super) fn correction(&self, residual: &BoundedVector) -> Option<BoundedVector> {
        let step = self.apply_bounded(residual);
        let start = upper_sum(&[&step.bound, &self.defect_times(&step.centre.abs())]);
        let mut trial = start.map(|value| value * INFLATION + f64::MIN_POSITIVE);
        for _ in 0..INFLATIONS {
            let image = self.defect_times(&trial);
            if image.iter().zip(&trial).all(|(image, bound)| image >= bound) {
                // The spectral radius of these bounds is at least 1: none contracts.
                return None;
            }
            let needed = upper_sum(&[&start, &image]);
            // `start` is positive, so |I - R A| f < f also holds strictly.
            if needed.iter().zip(&trial).all(|(need, bound)| need <= bound && bound.is_finite()) {
                return Some(BoundedVector { centre: step.centre, bound: trial });
            }
            trial = needed.map(|value| value * INFLATION + f64::MIN_POSITIVE);
        }
        None
    }
}

/// Upper bounds on `|A B|`.
fn size_of_product(
    left: &DMatrix<f64>,
    right: &DMatrix<f64>,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<DMatrix<f64>> {
    let product = product(left, &IntervalMatrix::exact(right.clone()), proceed)?;
    Some(product.centre().zip_map(product.radius(), |centre, radius| (centre.abs() + radius).next_up()))
}

/// `|vector| eps`, protected from underflow.
fn covered(vector: &DVector<f64>, eps: f64) -> DVector<f64> {
    vector.map(|value| value.abs() * eps + f64::MIN_POSITIVE)
}

/// Solutions of all systems within bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearEnclosure {
    /// Contains the solution for every matrix and right-hand side within the bounds.
    pub solution: IntervalMatrix,
    /// The common sign of all determinants.
    pub determinant: Sign,
}

/// Encloses the solutions `X` of `A X = B` for every `A` (n x n) and `B` (n x m) within bounds, by a Krawczyk
/// test with an approximate inverse; `None` if it is not verified that every `A` is regular, or if the shapes
/// do not match.
///
/// ```
/// use nalgebra::dmatrix;
/// use slideway_modes::certificate::{enclose_solution, IntervalMatrix, Sign};
/// let matrix = IntervalMatrix::exact(dmatrix![3.0, 1.0; 1.0, 2.0]);
/// let enclosure = enclose_solution(&matrix, &IntervalMatrix::exact(dmatrix![1.0; 0.0])).expect("regular");
/// assert_eq!(enclosure.determinant, Sign::Positive);
/// assert!((enclosure.solution.entry(0, 0).middle() - 0.4).abs() < 1e-15);
/// ```
pub fn enclose_solution(
    matrix: &IntervalMatrix,
    right_hand_side: &IntervalMatrix,
) -> Option<LinearEnclosure> {
    enclose_solution_while(matrix, right_hand_side, &mut || true)
}

/// [`enclose_solution`]; `None`, too, once `proceed` is `false`, which is called every few million multiplications.
pub fn enclose_solution_while(
    matrix: &IntervalMatrix,
    right_hand_side: &IntervalMatrix,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<LinearEnclosure> {
    let (size, columns) = right_hand_side.shape();
    if matrix.shape() != (size, size) {
        return None;
    }
    let inverse = ApproximateInverse::new(matrix, proceed)?;
    let mut pace = Pace::new(proceed);
    let mut entries = DMatrix::from_element(size, columns, Interval::ZERO);
    for column in 0..columns {
        if !pace.allows(PRODUCTS_OF_COLUMN * size * size) {
            return None;
        }
        let right = right_hand_side.centre().column(column).into_owned();
        let spread = right_hand_side.radius().column(column).into_owned();
        if right.amax() == 0.0 && spread.amax() == 0.0 {
            // A X = 0 has only the solution 0, which needs no rounding bound; the regularity of A is verified
            // below.
            continue;
        }
        let guess = inverse.apply(&right);
        let image = product_with_column(matrix, &guess)?;
        let rounded = (&right - image.centre()).abs() * f64::EPSILON;
        let bound = upper_sum(&[&image.radius().column(0).into_owned(), &spread, &rounded]);
        let residual = BoundedVector { centre: &right - image.centre().column(0), bound };
        let correction = inverse.correction(&residual)?;
        for row in 0..size {
            entries[(row, column)] =
                Interval::point(guess[row]) + Interval::around(correction.centre[row], correction.bound[row]);
        }
    }
    // An empty system has determinant 1; without columns, nothing was verified above.
    let regular = BoundedVector { centre: DVector::zeros(size), bound: DVector::repeat(size, 1.0) };
    inverse.correction(&regular)?;
    let solution = IntervalMatrix::from_intervals(&entries)?;
    Some(LinearEnclosure { solution, determinant: inverse.determinant_sign() })
}

/// The sign of `D` of one pattern, common to all values within the bounds of a problem; `None` if it is not
/// verified, as near to where `D` vanishes.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway_modes::ContactState::Positive;
/// use slideway_modes::ModeProblem;
/// use slideway_modes::certificate::{Sign, proven_determinant_sign};
/// let locked = dmatrix![1.0, -2.0; -2.0, 1.0];
/// let problem = ModeProblem::from_linear_complementarity(&locked, dvector![1.0, 1.0])?;
/// assert_eq!(proven_determinant_sign(&problem, &[Positive; 2]), Some(Sign::Negative));
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
///
/// # Panics
/// If `pattern` does not have one state per contact.
pub fn proven_determinant_sign<'a>(
    problem: impl Into<ProblemView<'a>>,
    pattern: &[ContactState],
) -> Option<Sign> {
    let problem = problem.into();
    assert_eq!(pattern.len(), problem.contacts(), "one state per contact");
    let system = PatternSystem::new(problem, pattern)?;
    let without_load = IntervalMatrix::exact(DMatrix::zeros(pattern.len(), 0));
    Some(enclose_solution(&system.matrix, &without_load)?.determinant)
}

/// An enclosure of `A x`.
fn product_with_column(matrix: &IntervalMatrix, vector: &DVector<f64>) -> Option<IntervalMatrix> {
    // (A x)^T = x^T A^T, with the interval matrix on the right.
    let column = DMatrix::from_row_slice(1, vector.len(), vector.as_slice());
    Some(product(&column, &matrix.transposed(), &mut || true)?.transposed())
}

/// LU factorization in place with partial pivoting: returns the order of rows, and whether it is an odd
/// permutation. `None` if a pivot is zero or not finite, or once `proceed` is `false`.
fn eliminate(matrix: &mut DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Option<(Vec<usize>, bool)> {
    let mut pace = Pace::new(proceed);
    let size = matrix.nrows();
    let mut rows: Vec<usize> = (0..size).collect();
    let mut odd = false;
    for step in 0..size {
        if !pace.allows((size - step).pow(2)) {
            return None;
        }
        let below = matrix.view((step, step), (size - step, 1));
        let pivot_at = step + below.icamax_full().0;
        if pivot_at != step {
            matrix.swap_rows(step, pivot_at);
            rows.swap(step, pivot_at);
            odd = !odd;
        }
        let pivot = matrix[(step, step)];
        if pivot == 0.0 || !pivot.is_finite() {
            return None;
        }
        for row in step + 1..size {
            matrix[(row, step)] /= pivot;
        }
        for column in step + 1..size {
            let eliminated = matrix[(step, column)];
            if eliminated != 0.0 {
                for row in step + 1..size {
                    let factor = matrix[(row, step)];
                    matrix[(row, column)] -= factor * eliminated;
                }
            }
        }
    }
    Some((rows, odd))
}

/// The approximate inverse of the unit lower triangle, itself exactly unit lower triangular; `None` once
/// `proceed` is `false`.
fn invert_unit_lower(factors: &DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Option<DMatrix<f64>> {
    let mut pace = Pace::new(proceed);
    let size = factors.nrows();
    let mut inverse = DMatrix::identity(size, size);
    for column in 0..size {
        if !pace.allows((size - column).pow(2) / 2) {
            return None;
        }
        for step in column..size {
            let value = inverse[(step, column)];
            for row in step + 1..size {
                inverse[(row, column)] -= factors[(row, step)] * value;
            }
        }
    }
    Some(inverse)
}

/// The approximate inverse of the upper triangle, itself exactly upper triangular; `None` once `proceed` is
/// `false`.
fn invert_upper(factors: &DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Option<DMatrix<f64>> {
    let mut pace = Pace::new(proceed);
    let size = factors.nrows();
    let mut inverse = DMatrix::identity(size, size);
    for column in 0..size {
        if !pace.allows(column.pow(2) / 2) {
            return None;
        }
        for step in (0..=column).rev() {
            inverse[(step, column)] /= factors[(step, step)];
            let value = inverse[(step, column)];
            for row in 0..step {
                inverse[(row, column)] -= factors[(row, step)] * value;
            }
        }
    }
    Some(inverse)
}
