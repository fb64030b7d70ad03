//! Triangular factors of sparse square matrices: of the joint equations, and of the kinetic equations.

use nalgebra::{DMatrix, DVector};

/// Steps of an elimination between two looks at the progress: those of few bodies take less than a moment in all.
const ASKED: usize = 64;

/// Triangular factors of a square matrix whose rows and columns have been exchanged, by elimination with
/// complete pivoting. A few dozen rows are mostly zeros: passing these over, with all right-hand sides side
/// by side, takes a fraction of the time of a general library.
#[derive(Debug, Clone)]
pub(crate) struct Factors {
    /// Column by column: the upper triangle, and below the diagonal the multipliers.
    entries: Vec<f64>,
    /// The row, and the column, that stands at each place.
    rows: Vec<usize>,
    columns: Vec<usize>,
}

impl Factors {
    pub(crate) fn of(matrix: &DMatrix<f64>) -> Self {
        let mut factors = Self::unfactored(matrix);
        factors.eliminate(&mut || true);
        factors
    }

    /// [`Self::of`]; none once `proceed`, which is asked every [`ASKED`] steps of the elimination, is `false`.
    pub(crate) fn of_while(matrix: &DMatrix<f64>, proceed: &mut dyn FnMut() -> bool) -> Option<Self> {
        let mut factors = Self::unfactored(matrix);
        factors.eliminate(proceed).then_some(factors)
    }

    fn unfactored(matrix: &DMatrix<f64>) -> Self {
        let places = || (0..matrix.nrows()).collect();
        Self { entries: matrix.as_slice().to_vec(), rows: places(), columns: places() }
    }

    /// Eliminates; returns `false` if it was ended before.
    fn eliminate(&mut self, proceed: &mut dyn FnMut() -> bool) -> bool {
        let Self { entries, rows, columns } = self;
        let size = rows.len();
        let mut greatest: Vec<Greatest> =
            entries.chunks_exact(size.max(1)).map(|e| Greatest::of(e, 0)).collect();
        for step in 0..size {
            let (column, Greatest { row, magnitude }) = greatest_of_all(&greatest, step);
            if step % ASKED == ASKED - 1 && !proceed() {
                return false;
            }
            if magnitude == 0.0 {
                break;
            }
            rows.swap(step, row);
            columns.swap(step, column);
            greatest.swap(step, column);
            if column != step {
                let (left, right) = entries.split_at_mut(column * size);
                left[step * size..][..size].swap_with_slice(&mut right[..size]);
            }
            if row != step {
                entries.chunks_exact_mut(size).for_each(|entries| entries.swap(step, row));
            }
            let (left, right) = entries.split_at_mut((step + 1) * size);
            let (pivot, multipliers) = left[step * size + step..].split_at_mut(1);
            let inverse = 1.0 / pivot[0];
            multipliers.iter_mut().for_each(|entry| *entry *= inverse);
            for (later, greatest) in right.chunks_exact_mut(size).zip(&mut greatest[step + 1..]) {
                let changes = later[step] != 0.0;
                if changes {
                    let (above, below) = later.split_at_mut(step + 1);
                    subtract(above[step], multipliers, below);
                }
                if changes || greatest.row == step || greatest.row == row {
                    *greatest = Greatest::of(later, step + 1);
                }
            }
        }
        true
    }

    /// Ratio of the greatest to the least pivot.
    pub(crate) fn condition(&self) -> f64 {
        let size = self.rows.len();
        let pivots = (0..size).map(|step| self.entries[step * (size + 1)].abs());
        let (greatest, least) =
            pivots.fold((0.0_f64, f64::INFINITY), |(most, least), pivot| (most.max(pivot), least.min(pivot)));
        if size == 0 { 1.0 } else { greatest / least }
    }

    /// True if the matrix is certainly regular: no pivot is below this multiple of the greatest.
    pub(super) fn are_regular(&self, least: f64) -> bool {
        self.condition() * least < 1.0
    }

    /// The solution of one system of equations; none if it is not finite.
    pub(super) fn solution(&self, side: &DVector<f64>) -> Option<DVector<f64>> {
        let solution = self.solve(side.as_slice(), &vec![1.0; side.len()], 1);
        solution.iter().all(|part| part.is_finite()).then(|| DVector::from_vec(solution))
    }

    /// The inverse of the matrix; its entries are not finite if that is singular.
    pub(super) fn inverse(&self) -> DMatrix<f64> {
        let size = self.rows.len();
        let mut sides = vec![0.0; size * size];
        sides.iter_mut().step_by(size + 1).for_each(|side| *side = 1.0);
        DMatrix::from_row_slice(size, size, &self.solve(&sides, &vec![1.0; size], size))
    }

    /// Solutions for several right-hand sides, which stand side by side in each row and are multiplied by its
    /// scale.
    pub(crate) fn solve(&self, sides: &[f64], scales: &[f64], count: usize) -> Vec<f64> {
        let size = self.rows.len();
        let mut work = Vec::with_capacity(size * count);
        for row in &self.rows {
            work.extend(sides[row * count..][..count].iter().map(|side| side * scales[*row]));
        }
        for step in 0..size {
            let (known, rest) = work.split_at_mut((step + 1) * count);
            let factors = &self.entries[step * size + step + 1..(step + 1) * size];
            subtract_rows(factors, &known[step * count..], rest);
        }
        for step in (0..size).rev() {
            let (rest, known) = work.split_at_mut(step * count);
            let factors = &self.entries[step * size..][..=step];
            known[..count].iter_mut().for_each(|value| *value /= factors[step]);
            subtract_rows(&factors[..step], &known[..count], rest);
        }
        let mut solution = vec![0.0; size * count];
        for (place, column) in self.columns.iter().enumerate() {
            solution[column * count..][..count].copy_from_slice(&work[place * count..][..count]);
        }
        solution
    }
}

impl Factors {
    /// [`Self::solve`] without scales, improved once by what the matrix itself leaves of the right-hand sides.
    pub(super) fn solve_closely(&self, matrix: &DMatrix<f64>, sides: &[f64], count: usize) -> Vec<f64> {
        let scales = vec![1.0; self.rows.len()];
        let mut solution = self.solve(sides, &scales, count);
        let mut left = sides.to_vec();
        for (column, known) in matrix.column_iter().zip(solution.chunks_exact(count.max(1))) {
            subtract_rows(column.as_slice(), known, &mut left);
        }
        let correction = self.solve(&left, &scales, count);
        solution.iter_mut().zip(correction).for_each(|(value, correction)| *value += correction);
        solution
    }
}

/// The greatest entry of a column from some row on, the first of several. It is sought anew only where the column or this
/// row has changed: in a chain of bodies a step of the elimination changes few columns.
#[derive(Debug, Clone, Copy)]
struct Greatest {
    row: usize,
    magnitude: f64,
}

impl Greatest {
    fn of(column: &[f64], from: usize) -> Self {
        let mut greatest = Self { row: from, magnitude: 0.0 };
        for (row, entry) in column.iter().enumerate().skip(from) {
            if entry.abs() > greatest.magnitude {
                greatest = Self { row, magnitude: entry.abs() };
            }
        }
        greatest
    }
}

/// The column with the greatest entry from this one on, the first of several, and the entry.
fn greatest_of_all(columns: &[Greatest], from: usize) -> (usize, Greatest) {
    let mut found = (from, columns[from]);
    for (column, greatest) in columns.iter().enumerate().skip(from) {
        if greatest.magnitude > found.1.magnitude {
            found = (column, *greatest);
        }
    }
    found
}

/// Takes so many times a row off each of the others.
fn subtract_rows(factors: &[f64], row: &[f64], targets: &mut [f64]) {
    for (factor, target) in factors.iter().zip(targets.chunks_exact_mut(row.len().max(1))) {
        if *factor != 0.0 {
            subtract(*factor, row, target);
        }
    }
}

fn subtract(factor: f64, from: &[f64], target: &mut [f64]) {
    for (target, value) in target.iter_mut().zip(from) {
        *target -= factor * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the definition of complete pivoting: `L U` is the matrix with its rows and columns exchanged, and each pivot is
    /// the greatest of what was left, so that no multiplier, and no entry beside a pivot, is greater.
    #[test]
    fn every_pivot_is_the_greatest_of_what_is_left() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for size in 1..40 {
            // Mostly zeros, many equal entries, and a diagonal that makes it regular.
            let band = |i: usize, j: usize| i.abs_diff(j) < 3;
            let matrix = DMatrix::from_fn(size, size, |i, j| match random() {
                _ if i == j => 1.0 + random(),
                chance if chance < 0.3 && band(i, j) => 1.0,
                chance if chance < 0.4 => random() - 0.5,
                _ => 0.0,
            });
            let Factors { entries, rows, columns } = Factors::of(&matrix);
            let factors = DMatrix::from_vec(size, size, entries);
            let lower = factors.lower_triangle().map_with_location(|i, j, x| if i == j { 1.0 } else { x });
            let exchanged = matrix.select_rows(&rows).select_columns(&columns);
            assert!((lower * factors.upper_triangle() - exchanged).amax() < 1e-12, "{size}");
            for step in 0..size {
                let pivot = factors[(step, step)].abs();
                for later in step + 1..size {
                    assert!(factors[(later, step)].abs() <= 1.0, "{size}");
                    assert!(factors[(step, later)].abs() <= pivot, "{size}");
                }
            }
            let inverse = Factors::of(&matrix).inverse();
            assert!((inverse * matrix - DMatrix::identity(size, size)).amax() < 1e-10, "{size}");
        }
    }
}
