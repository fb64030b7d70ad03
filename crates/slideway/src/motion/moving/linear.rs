//! Small dense linear systems, solved again and again without new memory.

use crate::kinetics::inverse_root;

/// Ratio of pivots from which on no pivot is given without a search.
const WELL_CONDITIONED: f64 = 1e6;

/// A square matrix, its factors (LU with partial pivoting) and its determinant.
///
/// Of kinetic equations the first unknowns, accelerations, are coupled by nothing but the others: the
/// diagonal of masses is taken for their pivots without a search, and most of the work is left out. Where the
/// pivots that then follow say that it matters which one is taken, all are searched for.
#[derive(Debug, Clone, Default)]
pub(in crate::motion) struct LinearSystem {
    size: usize,
    /// So many of the first rows have in as many of the first columns nothing but the diagonal, and that is
    /// not zero.
    uncoupled: usize,
    /// Of these, the ones that were taken for pivots without a search.
    given: usize,
    /// Row by row: the matrix, and after factorization the factors of `diag(rows) matrix diag(columns)`.
    entries: Vec<f64>,
    /// Powers of two that bring rows and columns to order one.
    row_scale: Vec<f64>,
    column_scale: Vec<f64>,
    /// The row that stands at each place after the exchanges.
    order: Vec<usize>,
    work: Vec<f64>,
    /// The matrix before it was factored.
    unfactored: Vec<f64>,
    determinant: Determinant,
}

/// A number of any magnitude: `mantissa * 2^(512 exponent)`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::motion) struct Determinant {
    mantissa: f64,
    exponent: i32,
}

/// 2^512: products of two numbers below it stay finite.
const BASE: f64 = 1.340_780_792_994_259_7e154;

impl Determinant {
    const ONE: Self = Self { mantissa: 1.0, exponent: 0 };

    fn times(mut self, factor: f64) -> Self {
        self.mantissa *= factor;
        let magnitude = self.mantissa.abs();
        if magnitude >= BASE {
            self.mantissa /= BASE;
            self.exponent += 1;
        } else if magnitude <= 1.0 / BASE && magnitude > 0.0 {
            self.mantissa *= BASE;
            self.exponent -= 1;
        }
        self
    }

    /// 1, -1, or 0.
    pub(in crate::motion) fn sign(self) -> f64 {
        if self.mantissa == 0.0 { 0.0 } else { self.mantissa.signum() }
    }

    /// This number divided by another one; zero or infinite where the quotient is beyond the range.
    pub(in crate::motion) fn relative_to(self, other: Self) -> f64 {
        let quotient = self.mantissa / other.mantissa;
        match self.exponent - other.exponent {
            0 => quotient,
            1 => quotient * BASE,
            -1 => quotient / BASE,
            more if more > 0 => quotient * f64::INFINITY,
            _ => quotient * 0.0,
        }
    }
}

impl LinearSystem {
    /// A system of this many unknowns, unscaled, all zero.
    pub(in crate::motion) fn new(size: usize) -> Self {
        Self {
            size,
            uncoupled: 0,
            given: 0,
            entries: vec![0.0; size * size],
            row_scale: vec![1.0; size],
            column_scale: vec![1.0; size],
            order: vec![0; size],
            work: vec![0.0; size],
            unfactored: Vec::new(),
            determinant: Determinant::default(),
        }
    }

    /// So many of the first rows have in as many of the first columns nothing but the diagonal, from now on.
    pub(in crate::motion) fn uncouple(&mut self, rows: usize) {
        self.uncoupled = rows;
    }

    /// Sets every entry to zero, to begin a new matrix.
    pub(in crate::motion) fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds to an entry of the matrix.
    pub(in crate::motion) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[row * self.size + column] += value;
    }

    /// Sets every entry of a column to zero.
    pub(in crate::motion) fn clear_column(&mut self, column: usize) {
        for row in 0..self.size {
            self.entries[row * self.size + column] = 0.0;
        }
    }

    /// An entry of the matrix, as long as it is not factored.
    pub(in crate::motion) fn entry(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.size + column]
    }

    /// The powers of two by which rows and columns are multiplied before factorization, from now on.
    pub(in crate::motion) fn set_scales(&mut self, rows: &[f64], columns: &[f64]) {
        self.row_scale.copy_from_slice(rows);
        self.column_scale.copy_from_slice(columns);
    }

    /// Scales rows and columns about the diagonal of the uncoupled ones: their entries come near one, and so do what the other
    /// rows and columns have beside them. Then the pivots that follow are those of constraints beside masses.
    pub(in crate::motion) fn set_scales_of_uncoupled(&mut self) {
        let (size, first) = (self.size, self.uncoupled);
        for place in 0..first {
            let scale = inverse_root(self.entry(place, place).abs());
            (self.row_scale[place], self.column_scale[place]) = (scale, scale);
        }
        for place in first..size {
            let beside = |entry: &dyn Fn(usize) -> f64| -> f64 {
                inverse_root((0..first).map(|other| (entry(other) * self.row_scale[other]).powi(2)).sum())
            };
            let row = beside(&|column| self.entry(place, column));
            let column = beside(&|row| self.entry(row, place));
            (self.row_scale[place], self.column_scale[place]) = (row, column);
        }
    }

    /// Replaces the matrix by its factors; returns the ratio of the greatest to the least pivot, infinite if
    /// the matrix is singular or not finite.
    pub(in crate::motion) fn factor(&mut self) -> f64 {
        let size = self.size;
        for (row, scale) in self.entries.chunks_exact_mut(size.max(1)).zip(&self.row_scale) {
            for (entry, column) in row.iter_mut().zip(&self.column_scale) {
                *entry *= scale * column;
            }
        }
        if self.uncoupled > 0 {
            self.unfactored.clone_from(&self.entries);
            let ratio = self.eliminate(self.uncoupled);
            if ratio <= WELL_CONDITIONED {
                return ratio;
            }
            self.entries.copy_from_slice(&self.unfactored);
        }
        self.eliminate(0)
    }

    /// Elimination in which so many of the first pivots are those of the diagonal, whose rows have no entries
    /// in one another's columns.
    fn eliminate(&mut self, given: usize) -> f64 {
        let size = self.size;
        self.given = given;
        for (place, row) in self.order.iter_mut().enumerate() {
            *row = place;
        }
        self.determinant = Determinant::ONE;
        let (mut least, mut greatest) = (f64::INFINITY, 0.0_f64);
        for step in 0..size {
            let is_given = step < given;
            let pivot = if is_given { self.entries[step * size + step] } else { self.bring_pivot(step) };
            self.determinant = self.determinant.times(pivot);
            if pivot == 0.0 || !pivot.is_finite() {
                return f64::INFINITY;
            }
            (least, greatest) = (least.min(pivot.abs()), greatest.max(pivot.abs()));
            let next = if is_given { given } else { step + 1 };
            let (upper, lower) = self.entries.split_at_mut(next * size);
            let pivot_row = &upper[step * size + next..][..size - next];
            for row in lower.chunks_exact_mut(size) {
                if row[step] != 0.0 {
                    let factor = row[step] / pivot;
                    row[step] = factor;
                    row[next..].iter_mut().zip(pivot_row).for_each(|(entry, above)| *entry -= factor * above);
                }
            }
        }
        if size == 0 { 1.0 } else { greatest / least }
    }

    /// Exchanges rows so that the greatest entry of the column stands on the diagonal, which is returned.
    fn bring_pivot(&mut self, step: usize) -> f64 {
        let size = self.size;
        let (mut best, mut greatest) = (step, self.entries[step * size + step].abs());
        for row in step + 1..size {
            let entry = self.entries[row * size + step].abs();
            if entry > greatest {
                (best, greatest) = (row, entry);
            }
        }
        if best != step {
            let (upper, lower) = self.entries.split_at_mut(best * size);
            upper[step * size..(step + 1) * size].swap_with_slice(&mut lower[..size]);
            self.order.swap(step, best);
            self.determinant = self.determinant.times(-1.0);
        }
        self.entries[step * size + step]
    }

    /// The determinant of the factored matrix, of its scaled form.
    pub(in crate::motion) fn determinant(&self) -> Determinant {
        self.determinant
    }

    /// Replaces a right-hand side by the solution.
    pub(in crate::motion) fn solve(&mut self, right_hand_side: &mut [f64]) {
        let size = self.size;
        for (place, row) in self.order.iter().enumerate() {
            self.work[place] = right_hand_side[*row] * self.row_scale[*row];
        }
        for row in self.given.max(1)..size {
            let factors = &self.entries[row * size..row * size + row];
            let sum: f64 = factors.iter().zip(&self.work).map(|(factor, value)| factor * value).sum();
            self.work[row] -= sum;
        }
        for row in (0..size).rev() {
            let factors = &self.entries[row * size..(row + 1) * size];
            let next = self.given.max(row + 1);
            let later = factors[next..].iter().zip(&self.work[next..]);
            let sum: f64 = later.map(|(factor, value)| factor * value).sum();
            self.work[row] = (self.work[row] - sum) / factors[row];
        }
        for (unknown, (value, scale)) in
            right_hand_side.iter_mut().zip(self.work.iter().zip(&self.column_scale))
        {
            *unknown = value * scale;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn system(rows: &[&[f64]]) -> LinearSystem {
        let mut system = LinearSystem::new(rows.len());
        for (i, row) in rows.iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                system.add(i, j, *value);
            }
        }
        system
    }

    #[test]
    fn solves_with_row_exchanges_and_scales() {
        // Solution chosen: (1, -2, 3).
        let rows: [&[f64]; 3] = [&[0.0, 2.0, 1.0], &[1.0, 0.0, -1.0], &[4.0, 1.0, 0.5]];
        let mut system = system(&rows);
        system.set_scales(&[0.5, 1.0, 0.25], &[1.0, 2.0, 1.0]);
        assert!(system.factor().is_finite());
        let mut right_hand_side = [-1.0, -2.0, 3.5];
        system.solve(&mut right_hand_side);
        for (found, expected) in right_hand_side.iter().zip([1.0, -2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-15, "{found} {expected}");
        }
        // Expanded by hand along the first row: det = -2 (0.5 + 4) + 1 (1) = -8; scales multiply it by 0.25.
        let determinant = system.determinant().relative_to(Determinant::ONE);
        assert!((determinant + 2.0).abs() < 1e-15, "{determinant}");
    }

    #[test]
    fn a_diagonal_of_masses_gives_the_pivots_unless_they_matter() {
        // Two masses m and 2 that a rod holds together and a force 1 pulls: a = 1/(m + 2), the rod has 2 a.
        for mass in [3.0, 1e-12] {
            let rows: [&[f64]; 3] = [&[mass, 0.0, 1.0], &[0.0, 2.0, -1.0], &[-1.0, 1.0, 0.0]];
            let mut system = system(&rows);
            system.uncouple(2);
            assert!(system.factor().is_finite());
            assert_eq!(system.given, if mass == 3.0 { 2 } else { 0 });
            let mut right_hand_side = [1.0, 0.0, 0.0];
            system.solve(&mut right_hand_side);
            let acceleration = 1.0 / (mass + 2.0);
            for (found, expected) in
                right_hand_side.iter().zip([acceleration, acceleration, 2.0 * acceleration])
            {
                assert!((found - expected).abs() < 1e-15, "{found} {expected}");
            }
            // Expanded by hand along the last row.
            let determinant = system.determinant().relative_to(Determinant::ONE);
            assert!((determinant - (mass + 2.0)).abs() < 1e-15 * determinant.abs(), "{determinant}");
        }
    }

    #[test]
    fn tells_a_singular_matrix() {
        assert!(system(&[&[1.0, 2.0], &[2.0, 4.0]]).factor().is_infinite());
        assert!(system(&[&[f64::NAN]]).factor().is_infinite());
    }

    #[test]
    fn determinants_of_any_magnitude_can_be_compared() {
        let small = (0..100).fold(Determinant::ONE, |product, _| product.times(1e-20));
        let twice = small.times(-2.0);
        assert_eq!(twice.relative_to(small), -2.0);
        assert_eq!(small.relative_to(Determinant::ONE), 0.0);
    }
}
