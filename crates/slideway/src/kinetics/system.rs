//! Factorization of the kinetic equations: equilibrated, fully pivoted, with a step of refinement.

use crate::configuration::null_space;
use crate::interval::Real;
use nalgebra::{DMatrix, DVector, Dyn, FullPivLU};

/// Pivots below this multiple of the greatest count as zero; the equations are then singular.
const SINGULAR: f64 = 1e-13;
/// Components of an equilibrated solution that are this many roundoffs below its greatest one are noise.
const NOISE: f64 = 16.0;

/// The factored matrix of the kinetic equations.
#[derive(Debug, Clone)]
pub(super) struct Factorization {
    matrix: DMatrix<f64>,
    /// Powers of two that bring every row and column to order one.
    row_scale: DVector<f64>,
    column_scale: DVector<f64>,
    factors: FullPivLU<f64, Dyn, Dyn>,
    condition: f64,
}

/// Why a matrix has no factorization.
#[derive(Debug, Clone)]
pub(super) struct Singular {
    /// A vector that the matrix maps to zero, in the units of the unknowns.
    pub(super) null_vector: DVector<f64>,
    /// The same in the equilibrated system, where its components can be compared with each other.
    pub(super) weights: DVector<f64>,
    /// Ratio of the greatest to the least pivot.
    pub(super) condition: f64,
}

impl Factorization {
    /// Factors a square matrix.
    pub(super) fn new(matrix: DMatrix<f64>) -> Result<Self, Singular> {
        if !matrix.iter().all(|entry| entry.is_finite()) {
            let nothing = DVector::zeros(matrix.ncols());
            return Err(Singular {
                null_vector: nothing.clone(),
                weights: nothing,
                condition: f64::INFINITY,
            });
        }
        let (row_scale, column_scale) = equilibration(&matrix);
        let scaled = scaled(&matrix, &row_scale, &column_scale);
        let factors = scaled.clone().full_piv_lu();
        let pivots = factors.u().diagonal().abs();
        let condition = if pivots.is_empty() { 1.0 } else { pivots.max() / pivots.min() };
        if condition.is_finite() && condition < 1.0 / SINGULAR {
            return Ok(Self { matrix, row_scale, column_scale, factors, condition });
        }
        let null = null_space(&scaled);
        let vector =
            if null.ncols() > 0 { null.column(0).into_owned() } else { DVector::zeros(scaled.ncols()) };
        Err(Singular { null_vector: vector.component_mul(&column_scale), weights: vector, condition })
    }

    /// The matrix that was factored.
    pub(super) fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Solution of `matrix` x = `right_hand_side`, with one step of iterative refinement.
    pub(super) fn solve(&self, right_hand_side: &DVector<f64>) -> DVector<f64> {
        let first = self.solve_once(right_hand_side);
        let residual = right_hand_side - &self.matrix * &first;
        first + self.solve_once(&residual)
    }

    /// A solution with every component set to zero that is below the rounding errors of the solution itself.
    pub(super) fn without_noise(&self, solution: &DVector<f64>) -> DVector<f64> {
        let scaled = solution.component_div(&self.column_scale);
        let noise = NOISE * f64::EPSILON * scaled.amax();
        DVector::from_fn(solution.len(), |i, _| if scaled[i].abs() <= noise { 0.0 } else { solution[i] })
    }

    /// The powers of two by which unknowns are greater than those of the equilibrated equations.
    pub(super) fn column_scale(&self) -> &DVector<f64> {
        &self.column_scale
    }

    pub(super) fn condition(&self) -> f64 {
        self.condition
    }

    fn solve_once(&self, right_hand_side: &DVector<f64>) -> DVector<f64> {
        let scaled = right_hand_side.component_mul(&self.row_scale);
        let solution = self.factors.solve(&scaled).expect("the pivots were found to be regular");
        solution.component_mul(&self.column_scale)
    }
}

/// A matrix with rows and columns multiplied by powers of two.
pub(crate) fn scaled<T: Real>(
    matrix: &DMatrix<T>,
    rows: &DVector<f64>,
    columns: &DVector<f64>,
) -> DMatrix<T> {
    let factor = T::exactly;
    DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
        factor(rows[i]) * matrix[(i, j)] * factor(columns[j])
    })
}

/// Powers of two by which rows and columns are multiplied so that their greatest entries are near one
/// (Ruiz, A scaling algorithm to equilibrate both rows and columns norms in matrices, 2001).
pub(crate) fn equilibration(matrix: &DMatrix<f64>) -> (DVector<f64>, DVector<f64>) {
    let mut rows = DVector::from_element(matrix.nrows(), 1.0);
    let mut columns = DVector::from_element(matrix.ncols(), 1.0);
    for _ in 0..6 {
        let mut greatest = [vec![0.0_f64; matrix.nrows()], vec![0.0_f64; matrix.ncols()]];
        for (j, column) in matrix.column_iter().enumerate() {
            for (i, entry) in column.iter().enumerate().filter(|(_, entry)| **entry != 0.0) {
                let scaled = (rows[i] * entry * columns[j]).abs();
                greatest[0][i] = greatest[0][i].max(scaled);
                greatest[1][j] = greatest[1][j].max(scaled);
            }
        }
        let [of_rows, of_columns] = greatest.map(|list| list.into_iter().map(inverse_root));
        let mut changed = false;
        for (scale, factor) in rows.iter_mut().zip(of_rows).chain(columns.iter_mut().zip(of_columns)) {
            *scale *= factor;
            changed |= factor != 1.0;
        }
        if !changed {
            break;
        }
    }
    (rows, columns)
}

/// The power of two nearest to 1/sqrt(x), from the exponent of x; 1 for an empty row. Between two the one farther from 1.
fn inverse_root(x: f64) -> f64 {
    if x <= 0.0 || !x.is_finite() {
        return 1.0;
    }
    let exponent = libm::ilogb(x);
    let is_between = exponent % 2 != 0 && x == libm::ldexp(1.0, exponent);
    let nearest = if is_between { exponent + exponent.signum() } else { exponent + 1 };
    libm::ldexp(1.0, -nearest.div_euclid(2))
}
