//! Dense linear algebra that can be interrupted: with some thousand unknowns it takes seconds.
//!
//! Results equal nalgebra's to the last bit, because the operations are the same, in the same order. Each
//! function with a `proceed` calls it now and then, and returns nothing once that is false.

use nalgebra::{DMatrix, DVector, Dyn, PermutationSequence, SVD};

/// `proceed` is called once per this many multiplications, which take some milliseconds.
const BETWEEN: usize = 1 << 23;
/// Products are computed this many columns at a time: with fewer, nalgebra would spend much time on copies of
/// the other factor.
const PANEL: usize = 128;
/// Steps of the iteration for singular values, for each row and column: some two are usual.
const STEPS_FOR_EACH: usize = 40;

/// Asks whether to continue, but not too often.
pub(crate) struct Pace<'p> {
    proceed: &'p mut dyn FnMut() -> bool,
    /// Multiplications since the last call.
    since: usize,
}

impl<'p> Pace<'p> {
    pub(crate) fn new(proceed: &'p mut dyn FnMut() -> bool) -> Self {
        Self { proceed, since: 0 }
    }

    /// Whether this many multiplications may follow.
    pub(crate) fn allows(&mut self, multiplications: usize) -> bool {
        self.since = self.since.saturating_add(multiplications);
        if self.since < BETWEEN {
            return true;
        }
        self.since = 0;
        (self.proceed)()
    }

    /// The function that is called, for work that has a pace of its own.
    pub(crate) fn proceed(&mut self) -> &mut dyn FnMut() -> bool {
        self.proceed
    }
}

/// Singular values, in no order, with their left and right vectors as far as these are wanted; `None` if there is no number, or
/// one that is not finite, or if the iteration does not come to an end.
///
/// ```
/// use nalgebra::dmatrix;
/// use slideway_modes::dense::singular_values;
///
/// let found = singular_values(&dmatrix![0.0, 2.0; 1.0, 0.0], [false; 2]).expect("it is regular");
/// let [greatest, least] = [found.singular_values.max(), found.singular_values.min()];
/// assert!((greatest - 2.0).abs() < 1e-14 && (least - 1.0).abs() < 1e-14);
/// assert!(singular_values(&dmatrix![f64::NAN], [false; 2]).is_none());
/// ```
///
/// nalgebra's own has no end where an entry is not a number, and where squares of a part of the matrix underflow. So entries that
/// are smaller than the rounding of the greatest one are left out, if the iteration does not end with them.
pub fn singular_values(matrix: &DMatrix<f64>, [left, right]: [bool; 2]) -> Option<SVD<f64, Dyn, Dyn>> {
    let steps = STEPS_FOR_EACH * (matrix.nrows() + matrix.ncols());
    let is_finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
    if matrix.is_empty() || !is_finite(matrix.as_slice()) {
        return None;
    }
    let least = f64::EPSILON * matrix.amax();
    let rounded = || matrix.map(|entry| if entry.abs() < least { 0.0 } else { entry });
    let found = |matrix| SVD::try_new_unordered(matrix, left, right, 5.0 * f64::EPSILON, steps);
    found(matrix.clone())
        .or_else(|| found(rounded()))
        .filter(|found| is_finite(found.singular_values.as_slice()))
}

/// `left right`.
pub(crate) fn product(
    left: &DMatrix<f64>,
    right: &DMatrix<f64>,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<DMatrix<f64>> {
    let mut pace = Pace::new(proceed);
    let mut result = DMatrix::zeros(left.nrows(), right.ncols());
    let mut from = 0;
    while from < right.ncols() {
        let rest = right.ncols() - from;
        let width = if rest < 2 * PANEL { rest } else { PANEL };
        if !pace.allows(left.len() * width) {
            return None;
        }
        result.columns_mut(from, width).gemm(1.0, left, &right.columns(from, width), 0.0);
        from += width;
    }
    Some(result)
}

/// An approximate inverse; `None` if there is none.
pub(crate) fn inverse(matrix: DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Option<DMatrix<f64>> {
    if matrix.nrows().saturating_pow(3) <= BETWEEN {
        // There are explicit formulas for inverses of up to four rows.
        return matrix.try_inverse();
    }
    Lu::new(matrix, proceed)?.inverse(proceed)
}

/// The solution of linear equations; `None` if they are singular. Without unknowns it is empty, where nalgebra would
/// read beyond its arrays.
pub(crate) fn solution(matrix: DMatrix<f64>, right_hand_side: &DVector<f64>) -> Option<DVector<f64>> {
    if matrix.is_empty() { Some(DVector::zeros(0)) } else { matrix.lu().solve(right_hand_side) }
}

/// Whether the Cholesky factorization of a symmetric matrix completes. Only the lower triangle is used.
pub(crate) fn has_cholesky_factor(mut matrix: DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> bool {
    let mut pace = Pace::new(proceed);
    let size = matrix.nrows();
    for column in 0..size {
        if !pace.allows(column * (size - column)) {
            return false;
        }
        for before in 0..column {
            let factor = matrix[(column, before)];
            let (mut target, source) = matrix.columns_range_pair_mut(column, before);
            target.rows_range_mut(column..).axpy(-factor, &source.rows_range(column..), 1.0);
        }
        let pivot = matrix[(column, column)];
        if pivot <= 0.0 || pivot.is_nan() {
            return false;
        }
        let root = pivot.sqrt();
        matrix.view_range_mut(column.., column).apply(|entry| *entry /= root);
    }
    true
}

/// The shortest `v` with `C^T v = products`, from an orthonormal basis `Q` of the columns of `C`
/// (Gram-Schmidt, each column twice).
pub(crate) fn shortest_with_products(
    mut columns: DMatrix<f64>,
    products: &DVector<f64>,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<DVector<f64>> {
    let mut pace = Pace::new(proceed);
    let mut shortest = DVector::zeros(columns.nrows());
    for (at, &product) in products.iter().enumerate() {
        if !pace.allows(4 * at * columns.nrows()) {
            return None;
        }
        let own = columns.column(at).into_owned();
        let mut rest = own.clone();
        for _ in 0..2 {
            let basis = columns.columns(0, at);
            rest -= basis * basis.tr_mul(&rest);
        }
        rest /= rest.norm();
        shortest.axpy((product - own.dot(&shortest)) / own.dot(&rest), &rest, 1.0);
        columns.set_column(at, &rest);
    }
    Some(shortest)
}

/// `P A = L U` with partial pivoting.
pub(crate) struct Lu {
    factors: DMatrix<f64>,
    rows: PermutationSequence<Dyn>,
}

impl Lu {
    pub(crate) fn new(mut matrix: DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let mut pace = Pace::new(proceed);
        let size = matrix.nrows();
        let mut rows = PermutationSequence::identity_generic(Dyn(size));
        for step in 0..size {
            if !pace.allows((size - step).pow(2)) {
                return None;
            }
            let at = step + matrix.view_range(step.., step).icamax();
            let pivot = matrix[(at, step)];
            if pivot == 0.0 {
                continue;
            }
            if at != step {
                rows.append_permutation(step, at);
                matrix.swap_rows(step, at);
            }
            let (mut done, mut rest) = matrix.columns_range_pair_mut(step, step + 1..);
            let mut multipliers = done.rows_range_mut(step + 1..);
            multipliers *= pivot.recip();
            for mut column in rest.column_iter_mut() {
                let eliminated = column[step];
                column.rows_range_mut(step + 1..).axpy(-eliminated, &multipliers, 1.0);
            }
        }
        Some(Self { factors: matrix, rows })
    }

    /// `A^-1 b`; `None` if a pivot is zero.
    pub(crate) fn solve(&self, right_hand_side: &DVector<f64>) -> Option<DVector<f64>> {
        let mut solution = right_hand_side.clone();
        self.rows.permute_rows(&mut solution);
        self.substitute(&mut solution.column_mut(0)).then_some(solution)
    }

    /// `A^-1`; `None` if a pivot is zero.
    pub(crate) fn inverse(&self, proceed: &mut dyn FnMut() -> bool) -> Option<DMatrix<f64>> {
        let mut pace = Pace::new(proceed);
        let size = self.factors.nrows();
        let mut inverse = DMatrix::identity(size, size);
        self.rows.permute_rows(&mut inverse);
        for mut column in inverse.column_iter_mut() {
            if !pace.allows(size * size) || !self.substitute(&mut column) {
                return None;
            }
        }
        Some(inverse)
    }

    /// The pivots, whose product is the determinant of `P A`.
    pub(crate) fn pivots(&self) -> DVector<f64> {
        self.factors.diagonal()
    }

    /// The determinant of `P`.
    pub(crate) fn sign_of_order(&self) -> f64 {
        self.rows.determinant()
    }

    /// Replaces `P b` by `A^-1 b`; `false` if a pivot is zero.
    fn substitute(&self, column: &mut nalgebra::DVectorViewMut<'_, f64>) -> bool {
        // nalgebra's triangular solvers do not accept empty systems.
        column.is_empty()
            || self.factors.solve_lower_triangular_with_diag_mut(column, 1.0)
                && self.factors.solve_upper_triangular_mut(column)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random_numbers::random_numbers;

    fn random_matrix(rows: usize, columns: usize) -> DMatrix<f64> {
        let mut random = random_numbers(1);
        DMatrix::from_fn(rows, columns, |_, _| random())
    }

    #[test]
    fn results_are_those_of_nalgebra_to_the_last_bit() {
        for size in [1, 3, 5, 40, 220] {
            let matrix = random_matrix(size, size);
            let factors = matrix.clone().lu();
            let own = Lu::new(matrix.clone(), &mut || true).expect("nothing stops it");
            assert_eq!(
                own.pivots() * own.sign_of_order(),
                factors.u().diagonal() * factors.p().determinant::<f64>()
            );
            let load = random_matrix(size, 1).column(0).into_owned();
            assert_eq!(own.solve(&load), factors.solve(&load));
            assert_eq!(own.inverse(&mut || true), factors.try_inverse());
            assert_eq!(inverse(matrix.clone(), &mut || true), matrix.try_inverse());
        }
    }

    #[test]
    fn products_in_panels_are_those_of_nalgebra_to_the_last_bit() {
        for (rows, inner, columns) in
            [(0, 0, 0), (3, 2, 1), (1, 30, 300), (70, 60, 255), (70, 300, 256), (33, 50, 401)]
        {
            let (left, right) = (random_matrix(rows, inner), random_matrix(inner, columns));
            assert_eq!(product(&left, &right, &mut || true), Some(&left * &right));
        }
    }

    /// Of parts whose squares underflow beside the rest, as of a lever of no length: nalgebra's iteration goes on for ever.
    #[test]
    fn singular_values_of_any_numbers_come_to_an_end() {
        for tiny in [1e-100, 1e-160, 1e-200, 1e-310] {
            let matrix = random_matrix(6, 6)
                .map_with_location(|row, column, entry| if row.min(column) > 2 { entry * tiny } else { 0.0 });
            let matrix =
                matrix + DMatrix::from_fn(6, 6, |row, column| f64::from(u8::from(row == column && row < 3)));
            let found = singular_values(&matrix, [true; 2]).expect("it comes to an end");
            let values = &found.singular_values;
            assert_eq!(values.iter().filter(|value| (**value - 1.0).abs() < 1e-14).count(), 3, "{values}");
            assert!(
                values.iter().all(|value| *value >= 0.0 && (*value > 0.5 || *value < 10.0 * tiny)),
                "{values}"
            );
        }
        assert!(singular_values(&DMatrix::from_element(3, 3, f64::INFINITY), [true; 2]).is_none());
        assert!(singular_values(&DMatrix::zeros(0, 3), [true; 2]).is_none());
    }

    #[test]
    fn singular_matrices_have_no_inverse() {
        let mut matrix = random_matrix(230, 230);
        let first = matrix.column(0).into_owned();
        assert!(inverse(matrix.clone(), &mut || true).is_some());
        matrix.fill_column(100, 0.0);
        assert_eq!(inverse(matrix.clone(), &mut || true), None);
        assert_eq!(Lu::new(matrix, &mut || true).expect("nothing stops it").solve(&first), None);
    }

    #[test]
    fn factors_exist_for_positive_definite_matrices_only() {
        let matrix = random_matrix(40, 30);
        let (rank_30, identity) = (&matrix * matrix.transpose(), DMatrix::identity(40, 40));
        for (shift, expected) in [(1e-6, true), (-1e-6, false)] {
            let shifted = &rank_30 + &identity * shift;
            assert_eq!(has_cholesky_factor(shifted.clone(), &mut || true), expected);
            assert_eq!(shifted.cholesky().is_some(), expected);
        }
    }

    /// Returns whether it completed.
    type Computation<'c> = dyn Fn(&mut dyn FnMut() -> bool) -> bool + 'c;

    #[test]
    fn long_work_ends_when_it_is_told_to() {
        let matrix = random_matrix(300, 300);
        let positive = DMatrix::identity(420, 420);
        let computations: [&Computation<'_>; 4] = [
            &|proceed| product(&matrix, &matrix, proceed).is_some(),
            &|proceed| inverse(matrix.clone(), proceed).is_some(),
            &|proceed| Lu::new(matrix.clone(), proceed).is_some(),
            &|proceed| has_cholesky_factor(positive.clone(), proceed),
        ];
        for compute in computations {
            let mut asked = 0;
            let is_done = compute(&mut || {
                asked += 1;
                true
            });
            assert!(is_done && (1..=5).contains(&asked), "{asked}");
            let mut asked_again = 0;
            let is_done = compute(&mut || {
                asked_again += 1;
                asked_again < asked
            });
            assert!(!is_done && asked_again == asked);
        }
    }
}
