//! A fast rigorous test of one pattern after another, for groups of few contacts.
//!
//! With an approximate inverse `R` of a pattern's matrix `A` and `x = R b`,
//!
//! ```text
//! A^-1 b - x = R (b - A x) + (I - R A) (A^-1 b - x)
//! ```
//!
//! so that `|A^-1 b - x| <= z + G max z / (1 - max G)` row by row, with `z = |R (b - A x)|` and `G` the row
//! sums of `|I - R A|`. `A` is regular if `max G < 1`. `z` and `G` include radii of the data and rounding
//! errors.

use super::UNDERFLOW;
use crate::problem::{Column, ContactState, ProblemView, Side};

/// Nonzero numbers of the data must be between this and its reciprocal in size.
const SMALLEST: f64 = 1e-100;
/// The largest permitted row sum of `|I - R A|`.
const LARGEST_DEFECT: f64 = 0.5;

/// Numbers and bounds on their errors.
#[derive(Debug, Clone, Default)]
struct Bounded {
    centre: Vec<f64>,
    radius: Vec<f64>,
}

/// The data of a problem, with rows divided by powers of two, and memory for one pattern.
pub(super) struct Sieve {
    contacts: usize,
    /// The columns of each contact in its three states.
    columns: Vec<[Bounded; 3]>,
    load: Bounded,
    /// `d_k` of each contact on its two sides; `None` if there are no jump vectors at all.
    jumps: Option<Vec<[Bounded; 2]>>,
    /// `A` with its radii, row after row.
    matrix: Bounded,
    right: Bounded,
    /// `[A | I]`, which becomes `[I | R]`.
    table: Vec<f64>,
    solution: Vec<f64>,
    /// For each row: the sum of bounds on `|A| gamma + radii`, the residual, and its error.
    row_error: Vec<f64>,
    residual: Bounded,
    defect: Vec<f64>,
    correction: Vec<f64>,
}

impl Sieve {
    /// `None` if numbers are so large or so small that products may overflow.
    pub(super) fn new(problem: ProblemView<'_>) -> Option<Self> {
        let contacts = problem.contacts();
        let scale: Vec<f64> = (0..contacts).map(|row| row_scale(problem, row)).collect();
        let bounded = |column: Column<'_>| Bounded::scaled(column, &scale);
        let mut columns = Vec::with_capacity(contacts);
        let mut jumps = Vec::with_capacity(contacts);
        for contact in 0..contacts {
            let [positive, negative] = Side::BOTH.map(|side| bounded(problem.column(contact, side)));
            let [up, down] = Side::BOTH.map(|side| bounded(problem.jump(contact, side)));
            columns.push([positive, negative, down.minus(&up)]);
            jumps.push([up, down]);
        }
        let load = bounded(problem.load());
        let sensible = columns.iter().flatten().chain(jumps.iter().flatten()).chain([&load]);
        if !sensible.flat_map(|part| part.centre.iter().chain(&part.radius)).all(|&value| is_sensible(value))
        {
            return None;
        }
        let unused = jumps.iter().flatten().all(Bounded::is_zero);
        let zeros = || vec![0.0; contacts];
        Some(Self {
            contacts,
            columns,
            load,
            jumps: (!unused).then_some(jumps),
            matrix: Bounded {
                centre: vec![0.0; contacts * contacts],
                radius: vec![0.0; contacts * contacts],
            },
            right: Bounded { centre: zeros(), radius: zeros() },
            table: vec![0.0; 2 * contacts * contacts],
            solution: zeros(),
            row_error: zeros(),
            residual: Bounded { centre: zeros(), radius: zeros() },
            defect: zeros(),
            correction: zeros(),
        })
    }

    /// Whether it is proven that a pattern has `D != 0` and no solution.
    pub(super) fn excludes(&mut self, pattern: &[ContactState]) -> bool {
        self.assemble(pattern);
        if !self.invert() {
            return false;
        }
        let Some(largest) = self.bound() else { return false };
        let gamma = self.gamma();
        pattern.iter().enumerate().any(|(contact, &state)| {
            let value = self.solution[contact];
            let error = (self.correction[contact] + self.defect[contact] * largest) * (1.0 + gamma);
            value + error < 0.0 || state == ContactState::Gap && value - error > 1.0
        })
    }

    /// More than twice the error of a sum of `contacts + 2` products, relative to the sum of their sizes.
    fn gamma(&self) -> f64 {
        (2 * self.contacts + 12) as f64 * f64::EPSILON
    }

    fn assemble(&mut self, pattern: &[ContactState]) {
        let (contacts, gamma) = (self.contacts, self.gamma());
        for (contact, &state) in pattern.iter().enumerate() {
            let column = &self.columns[contact][state as usize];
            for row in 0..contacts {
                self.matrix.centre[row * contacts + contact] = column.centre[row];
                self.matrix.radius[row * contacts + contact] = column.radius[row];
            }
        }
        self.right.centre.copy_from_slice(&self.load.centre);
        self.right.radius.copy_from_slice(&self.load.radius);
        let Some(jumps) = &self.jumps else { return };
        for row in 0..contacts {
            let (mut sum, mut size, mut radius) = (self.load.centre[row], 0.0, self.load.radius[row]);
            size += f64::abs(sum);
            for (jump, &state) in jumps.iter().zip(pattern) {
                let jump = &jump[usize::from(state != ContactState::Positive)];
                sum += jump.centre[row];
                size += jump.centre[row].abs();
                radius += jump.radius[row];
            }
            self.right.centre[row] = sum;
            self.right.radius[row] = (radius + gamma * size) * (1.0 + gamma);
        }
    }

    /// The approximate inverse by Gauss-Jordan elimination with row pivoting; `false` if a pivot is zero.
    fn invert(&mut self) -> bool {
        let contacts = self.contacts;
        let width = 2 * contacts;
        for row in 0..contacts {
            let (left, right) = self.table[row * width..][..width].split_at_mut(contacts);
            left.copy_from_slice(&self.matrix.centre[row * contacts..][..contacts]);
            right.fill(0.0);
            right[row] = 1.0;
        }
        for step in 0..contacts {
            let size = |row: &usize| self.table[row * width + step].abs();
            let largest = (step..contacts).max_by(|one, other| size(one).total_cmp(&size(other)));
            let pivot_row = largest.unwrap_or(step);
            if pivot_row != step {
                let (above, below) = self.table.split_at_mut(pivot_row * width);
                above[step * width..][..width].swap_with_slice(&mut below[..width]);
            }
            let pivot = self.table[step * width + step];
            if pivot == 0.0 || !pivot.is_finite() {
                return false;
            }
            self.eliminate(step, pivot);
        }
        true
    }

    fn eliminate(&mut self, step: usize, pivot: f64) {
        let width = 2 * self.contacts;
        for value in &mut self.table[step * width..][step..width] {
            *value /= pivot;
        }
        let (above, rest) = self.table.split_at_mut(step * width);
        let (pivot_row, below) = rest.split_at_mut(width);
        for row in above.chunks_exact_mut(width).chain(below.chunks_exact_mut(width)) {
            let factor = row[step];
            if factor != 0.0 {
                for (value, eliminated) in row[step..].iter_mut().zip(&pivot_row[step..]) {
                    *value -= factor * eliminated;
                }
            }
        }
    }

    /// Fills in `x`, `z` and `G`. Returns the bound on `max |A^-1 b - x|`, or `None` if `A` is not proven to
    /// be regular.
    fn bound(&mut self) -> Option<f64> {
        let contacts = self.contacts;
        let gamma = self.gamma();
        for at in 0..contacts {
            let inverse = &self.table[2 * contacts * at + contacts..][..contacts];
            self.solution[at] = dot(inverse, &self.right.centre);
        }
        for row in 0..contacts {
            self.add_row(row);
        }
        let (mut most_defect, mut most_correction) = (0.0_f64, 0.0_f64);
        for at in 0..contacts {
            let inverse = &self.table[2 * contacts * at + contacts..][..contacts];
            let (mut defect, mut step, mut slack) = (UNDERFLOW, 0.0, UNDERFLOW);
            for (row, &weight) in inverse.iter().enumerate() {
                let residual = self.residual.centre[row];
                defect += weight.abs() * self.row_error[row];
                step += weight * residual;
                slack += weight.abs() * (gamma * residual.abs() + self.residual.radius[row]);
            }
            for column in 0..contacts {
                let product: f64 =
                    (0..contacts).map(|row| inverse[row] * self.matrix.centre[row * contacts + column]).sum();
                defect += (if at == column { 1.0 - product } else { product }).abs();
            }
            self.defect[at] = defect * (1.0 + gamma);
            self.correction[at] = (step.abs() + slack) * (1.0 + gamma);
            most_defect = most_defect.max(self.defect[at]);
            most_correction = most_correction.max(self.correction[at]);
            if self.defect[at].is_nan() || self.correction[at].is_nan() {
                return None;
            }
        }
        (most_defect <= LARGEST_DEFECT).then(|| most_correction / (1.0 - most_defect) * (1.0 + gamma))
    }

    /// The residual of one equation with its error, and the effect of rounding and of the radii of its
    /// coefficients.
    fn add_row(&mut self, row: usize) {
        let (contacts, gamma) = (self.contacts, self.gamma());
        let coefficients = &self.matrix.centre[row * contacts..][..contacts];
        let radii = &self.matrix.radius[row * contacts..][..contacts];
        let right = self.right.centre[row];
        let (mut residual, mut size, mut spread, mut error) = (right, right.abs(), 0.0, UNDERFLOW);
        for ((&coefficient, &radius), &value) in coefficients.iter().zip(radii).zip(&self.solution) {
            residual -= coefficient * value;
            size += (coefficient * value).abs();
            spread += radius * value.abs();
            error += gamma * coefficient.abs() + radius;
        }
        self.residual.centre[row] = residual;
        self.residual.radius[row] =
            (gamma * size + spread + self.right.radius[row]) * (1.0 + gamma) + UNDERFLOW;
        self.row_error[row] = error * (1.0 + gamma);
    }
}

impl Bounded {
    fn scaled(column: Column<'_>, scale: &[f64]) -> Self {
        let exact = |(&value, scale): (&f64, &f64)| match value * scale {
            // Lost to underflow: not an admitted number.
            0.0 if value != 0.0 => f64::NAN,
            product => product,
        };
        let product = |values: &[f64]| values.iter().zip(scale).map(exact).collect();
        let radius = column.radius.map_or_else(|| vec![0.0; scale.len()], product);
        Self { centre: product(column.centre), radius }
    }

    fn minus(&self, other: &Self) -> Self {
        let centre: Vec<f64> =
            self.centre.iter().zip(&other.centre).map(|(one, other)| one - other).collect();
        let radii = self.radius.iter().zip(&other.radius).zip(&centre);
        let radius = radii.map(|((one, other), value)| {
            (one + other + value.abs() * f64::EPSILON) * (1.0 + 4.0 * f64::EPSILON)
        });
        Self { radius: radius.collect(), centre }
    }

    fn is_zero(&self) -> bool {
        self.centre.iter().chain(&self.radius).all(|&value| value == 0.0)
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// A power of two that brings the largest coefficient of a row to a size of about 1.
fn row_scale(problem: ProblemView<'_>, row: usize) -> f64 {
    let size = |contact| {
        let sizes = Side::BOTH.map(|side| problem.column(contact, side).centre[row].abs());
        sizes[0].max(sizes[1])
    };
    let largest = (0..problem.contacts()).map(size).fold(0.0, f64::max);
    if largest == 0.0 { 1.0 } else { (-largest.log2().floor()).clamp(-900.0, 900.0).exp2() }
}

fn is_sensible(value: f64) -> bool {
    value == 0.0 || (SMALLEST..SMALLEST.recip()).contains(&value.abs())
}
