//! Factorization of the kinetic equations: equilibrated, fully pivoted, with a step of refinement.

use crate::configuration::{Factors, null_space};
use crate::interval::Real;
use nalgebra::{DMatrix, DVector};

/// Pivots below this multiple of the greatest count as zero; the equations are then singular.
const SINGULAR: f64 = 1e-13;
/// Components of an equilibrated solution that are this many roundoffs below its greatest one are noise.
const NOISE: f64 = 16.0;
/// Bits of the digits of an `f64` behind its exponent, ...
const DIGITS: u32 = 52;
/// ... 2 to that power, ...
const POWER_52: f64 = 4_503_599_627_370_496.0;
/// ... and what is added to its exponent.
const BIAS: i32 = 1023;

/// The factored matrix of the kinetic equations.
#[derive(Debug, Clone)]
pub(super) struct Factorization {
    matrix: DMatrix<f64>,
    /// Powers of two that bring every row and column to order one.
    row_scale: DVector<f64>,
    column_scale: DVector<f64>,
    factors: Factors,
    condition: f64,
}

/// Why a matrix has no factorization.
#[derive(Debug, Clone)]
pub(super) struct Singular {
    /// A vector that the matrix maps to zero, in the units of the unknowns.
    pub(super) null_vector: DVector<f64>,
    /// The null vector in the equilibrated system, where its components can be compared with each other.
    pub(super) weights: DVector<f64>,
    /// Ratio of the greatest to the least pivot.
    pub(super) condition: f64,
}

/// Why there are no factors.
#[derive(Debug, Clone)]
pub(super) enum Unfactored {
    /// The matrix is singular.
    Singular(Singular),
    /// The work was to end.
    Ended,
}

impl Factorization {
    /// Factors a square matrix, as long as `proceed` is `true`.
    pub(super) fn new(matrix: DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Result<Self, Unfactored> {
        let scales = equilibration(&matrix);
        Self::scaled(matrix, scales, proceed)
    }

    /// Factors a matrix that differs little from this one: its rows and columns have the same scales.
    pub(super) fn near(&self, matrix: DMatrix<f64>) -> Result<Self, Unfactored> {
        Self::scaled(matrix, (self.row_scale.clone(), self.column_scale.clone()), &mut || true)
    }

    fn scaled(
        matrix: DMatrix<f64>,
        (row_scale, column_scale): (DVector<f64>, DVector<f64>),
        proceed: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Unfactored> {
        if !matrix.iter().all(|entry| entry.is_finite()) {
            let nothing = DVector::zeros(matrix.ncols());
            return Err(Unfactored::Singular(Singular {
                null_vector: nothing.clone(),
                weights: nothing,
                condition: f64::INFINITY,
            }));
        }
        let scaled = scaled(&matrix, &row_scale, &column_scale);
        let factors = Factors::of_while(&scaled, proceed).ok_or(Unfactored::Ended)?;
        let condition = factors.condition();
        if condition.is_finite() && condition < 1.0 / SINGULAR {
            return Ok(Self { matrix, row_scale, column_scale, factors, condition });
        }
        let null = null_space(&scaled);
        let vector =
            if null.ncols() > 0 { null.column(0).into_owned() } else { DVector::zeros(scaled.ncols()) };
        let null_vector = vector.component_mul(&column_scale);
        Err(Unfactored::Singular(Singular { null_vector, weights: vector, condition }))
    }

    /// The matrix that was factored.
    pub(super) fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Solutions of `matrix` x = `side`, each with one step of iterative refinement.
    pub(super) fn solve(&self, sides: &[&DVector<f64>]) -> Vec<DVector<f64>> {
        let (size, count) = (self.matrix.nrows(), sides.len());
        let mut known = vec![0.0; size * count];
        for (place, side) in sides.iter().enumerate() {
            side.iter()
                .zip(known.iter_mut().skip(place).step_by(count))
                .for_each(|(side, known)| *known = *side);
        }
        let first = self.solve_once(&known, count);
        let mut sums = vec![0.0; size * count];
        let entries = self.matrix.as_slice().chunks_exact(size.max(1));
        for (entries, unknowns) in entries.zip(first.chunks_exact(count.max(1))) {
            for (entry, sums) in entries.iter().zip(sums.chunks_exact_mut(count.max(1))) {
                if *entry != 0.0 {
                    sums.iter_mut().zip(unknowns).for_each(|(sum, unknown)| *sum += entry * unknown);
                }
            }
        }
        known.iter_mut().zip(&sums).for_each(|(known, sum)| *known -= sum);
        let more = self.solve_once(&known, count);
        let solution = |place: usize| {
            DVector::from_fn(size, |row, _| first[row * count + place] + more[row * count + place])
        };
        (0..count).map(solution).collect()
    }

    /// The powers of two by which unknowns are greater than those of the equilibrated equations.
    pub(super) fn column_scale(&self) -> &DVector<f64> {
        &self.column_scale
    }

    pub(super) fn condition(&self) -> f64 {
        self.condition
    }

    /// Solutions for all right-hand sides, which stand side by side in each row.
    fn solve_once(&self, sides: &[f64], count: usize) -> Vec<f64> {
        let mut solution = self.factors.solve(sides, self.row_scale.as_slice(), count);
        for (row, scale) in solution.chunks_exact_mut(count.max(1)).zip(self.column_scale.as_slice()) {
            row.iter_mut().for_each(|value| *value *= scale);
        }
        solution
    }
}

/// A solution with every component set to zero that is below the rounding errors of the solution itself, where unknowns are
/// so many times greater than those of the equilibrated equations.
pub(super) fn without_noise(solution: &DVector<f64>, column_scale: &DVector<f64>) -> DVector<f64> {
    let scaled = solution.component_div(column_scale);
    let noise = NOISE * f64::EPSILON * scaled.amax();
    DVector::from_fn(solution.len(), |i, _| if scaled[i].abs() <= noise { 0.0 } else { solution[i] })
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
    let [height, width] = [matrix.nrows(), matrix.ncols()];
    let mut entries: Vec<(usize, usize, f64)> = Vec::with_capacity(8 * width);
    for (j, column) in matrix.as_slice().chunks_exact(height.max(1)).enumerate() {
        let present = column.iter().enumerate().filter(|(_, entry)| **entry != 0.0);
        entries.extend(present.map(|(i, entry)| (i, height + j, entry.abs())));
    }
    // Rows, then columns.
    let mut scales = vec![1.0; height + width];
    let mut greatest = vec![0.0_f64; height + width];
    for _ in 0..6 {
        greatest.fill(0.0);
        for &(i, j, entry) in &entries {
            let scaled = scales[i] * entry * scales[j];
            greatest[i] = greatest[i].max(scaled);
            greatest[j] = greatest[j].max(scaled);
        }
        let mut changed = false;
        for (scale, greatest) in scales.iter_mut().zip(&greatest) {
            let factor = inverse_root(*greatest);
            *scale *= factor;
            changed |= factor != 1.0;
        }
        if !changed {
            break;
        }
    }
    let (rows, columns) = scales.split_at(height);
    (DVector::from_column_slice(rows), DVector::from_column_slice(columns))
}

/// The power of two nearest to 1/sqrt(x), from the exponent of x; 1 for an empty row. Between two the one
/// farther from 1.
pub(crate) fn inverse_root(x: f64) -> f64 {
    if x <= 0.0 || !x.is_finite() {
        return 1.0;
    }
    // Those without an exponent of their own are given one.
    let (normal, shift) = if x.is_normal() { (x, 0) } else { (x * POWER_52, 52) };
    let exponent = (normal.to_bits() >> DIGITS) as i32 - BIAS - shift;
    let is_power_of_two = normal.to_bits() << (64 - DIGITS) == 0;
    let is_between = exponent % 2 != 0 && is_power_of_two;
    let nearest = if is_between { exponent + exponent.signum() } else { exponent + 1 };
    f64::from_bits(u64::from((BIAS - nearest.div_euclid(2)).unsigned_abs()) << DIGITS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_roots_are_those_of_the_exponent() {
        let by_libm = |x: f64| {
            let exponent = libm::ilogb(x);
            let is_between = exponent % 2 != 0 && x == libm::ldexp(1.0, exponent);
            let nearest = if is_between { exponent + exponent.signum() } else { exponent + 1 };
            libm::ldexp(1.0, -nearest.div_euclid(2))
        };
        for exponent in -1074..=1023 {
            let power = libm::ldexp(1.0, exponent);
            for x in [power, power.next_up(), power.next_down(), 1.7 * power] {
                if x > 0.0 && x.is_finite() {
                    assert_eq!(inverse_root(x), by_libm(x), "{x:e}");
                }
            }
        }
        assert_eq!([0.0, f64::INFINITY, f64::NAN].map(inverse_root), [1.0; 3]);
    }
}
