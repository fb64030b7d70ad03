//! The equations of one pattern, with bounds on their rounding errors.

use nalgebra::{DMatrix, DVector};

use crate::error_free::{product_remainder, sum_remainder};
use crate::interval::add_up;
use crate::interval_matrix::{IntervalMatrix, rounding};
use crate::problem::{Column, ContactState, ProblemView, Side};

/// The equations `A z = b` of one pattern; `z_k` is `y_k`, or `lambda_k` for a contact in its gap.
pub(super) struct PatternSystem<'a> {
    problem: ProblemView<'a>,
    pattern: &'a [ContactState],
    /// Entries that are sums are rounded; the radius covers this.
    pub(super) matrix: IntervalMatrix,
    right_hand_side: DVector<f64>,
    /// Covers the rounding of sums in addition to the bounds of the data.
    right_hand_side_radius: DVector<f64>,
}

/// A vector and a bound on its error.
pub(super) struct BoundedVector {
    pub(super) centre: DVector<f64>,
    pub(super) bound: DVector<f64>,
}

impl<'a> PatternSystem<'a> {
    /// `None` if numbers overflow.
    pub(super) fn new(problem: ProblemView<'a>, pattern: &'a [ContactState]) -> Option<Self> {
        let contacts = problem.contacts();
        let mut centre = DMatrix::zeros(contacts, contacts);
        let mut radius = DMatrix::zeros(contacts, contacts);
        let load = problem.load();
        let mut right = DVector::from_column_slice(load.centre);
        let mut right_size = right.abs();
        let mut right_radius = DVector::zeros(contacts);
        load.add_radius_to(&mut right_radius);
        for (contact, &state) in pattern.iter().enumerate() {
            let jump = problem.jump(contact, ProblemView::constant_jump_side(state));
            for row in 0..contacts {
                right[row] += jump.centre[row];
                right_size[row] += jump.centre[row].abs();
            }
            jump.add_radius_to(&mut right_radius);
            for (term, sign) in problem.matrix_terms(contact, state) {
                for row in 0..contacts {
                    let at = (row, contact);
                    let (before, added) = (centre[at], sign * term.centre[row]);
                    centre[at] = before + added;
                    let lost = sum_remainder(before, added, centre[at]).abs();
                    let spread = term.radius.map_or(0.0, |radius| radius[row]);
                    radius[at] = add_up(add_up(radius[at], spread), lost);
                }
            }
        }
        let covered = right_radius + right_size * rounding(contacts + 1);
        let right_hand_side_radius = covered.map(|value| value * (1.0 + 2.0 * rounding(contacts)));
        let matrix = IntervalMatrix::around(centre, radius)?;
        Some(Self { problem, pattern, matrix, right_hand_side: right, right_hand_side_radius })
    }

    pub(super) fn right_hand_side(&self) -> &DVector<f64> {
        &self.right_hand_side
    }

    /// `b - A z` in plain arithmetic.
    pub(super) fn residual(&self, z: &DVector<f64>) -> BoundedVector {
        let (sizes, terms) = (z.abs(), z.len() + 1);
        let matrix = self.matrix.centre();
        let centre = &self.right_hand_side - matrix * z;
        let rounded = (matrix.abs() * &sizes + self.right_hand_side.abs()) * rounding(terms);
        let spread = self.matrix.radius() * &sizes + &self.right_hand_side_radius;
        let bound = (rounded + spread).map(|value| value * (1.0 + 4.0 * rounding(terms)) + f64::MIN_POSITIVE);
        BoundedVector { centre, bound: bound * (1.0 + rounding(terms)) }
    }

    /// `b - A z` as if computed with twice the digits and then rounded.
    ///
    /// All terms of the data enter unrounded, by a compensated inner product (Ogita, Rump & Oishi, Accurate
    /// sum and dot product, 2005, algorithm 5.3): its error is at most `u |result| + gamma_n^2 sum |terms|`,
    /// apart from underflow.
    pub(super) fn accurate_residual(&self, z: &DVector<f64>) -> BoundedVector {
        let contacts = self.pattern.len();
        let mut sums = vec![CompensatedSum::default(); contacts];
        let mut spread = DVector::zeros(contacts);
        let load = self.problem.load();
        load.add_radius_to(&mut spread);
        accumulate(&mut sums, load.centre, 1.0);
        for (contact, &state) in self.pattern.iter().enumerate() {
            let jump = self.problem.jump(contact, ProblemView::constant_jump_side(state));
            accumulate(&mut sums, jump.centre, 1.0);
            jump.add_radius_to(&mut spread);
            for (term, sign) in self.problem.matrix_terms(contact, state) {
                accumulate(&mut sums, term.centre, -sign * z[contact]);
                if let Some(radius) = term.radius {
                    for row in 0..contacts {
                        spread[row] += radius[row] * z[contact].abs();
                    }
                }
            }
        }
        let terms = 3 * contacts + 1;
        let centre = DVector::from_iterator(contacts, sums.iter().map(CompensatedSum::value));
        let bound = DVector::from_fn(contacts, |row, _| {
            let rounded = centre[row].abs() * 2.0 * f64::EPSILON + sums[row].size * rounding(terms).powi(2);
            (rounded + spread[row]) * (1.0 + 4.0 * rounding(terms)) + terms as f64 * f64::MIN_POSITIVE
        });
        BoundedVector { centre, bound }
    }
}

impl<'a> ProblemView<'a> {
    /// The terms of the matrix column of a contact in a state, with their signs.
    pub(super) fn matrix_terms(
        self,
        contact: usize,
        state: ContactState,
    ) -> impl Iterator<Item = (Column<'a>, f64)> {
        let (first, second) = match state.side() {
            Some(side) => ((self.column(contact, side), 1.0), None),
            None => {
                ((self.jump(contact, Side::Positive), -1.0), Some((self.jump(contact, Side::Negative), 1.0)))
            }
        };
        std::iter::once(first)
            .chain(second)
            .flat_map(|(column, sign)| column.terms().map(move |term| (term, sign)))
    }
}

fn accumulate(sums: &mut [CompensatedSum], column: &[f64], factor: f64) {
    for (sum, &entry) in sums.iter_mut().zip(column) {
        sum.add_product(entry, factor);
    }
}

/// A sum of products that accumulates its rounding errors separately.
#[derive(Debug, Clone, Copy, Default)]
struct CompensatedSum {
    sum: f64,
    correction: f64,
    /// Sum of the absolute values of the terms.
    size: f64,
}

impl CompensatedSum {
    fn add_product(&mut self, one: f64, other: f64) {
        let product = one * other;
        let sum = self.sum + product;
        self.correction += sum_remainder(self.sum, product, sum) + product_remainder(one, other, product);
        self.sum = sum;
        self.size += product.abs();
    }

    fn value(&self) -> f64 {
        self.sum + self.correction
    }
}

impl Column<'_> {
    pub(super) fn add_radius_to(&self, radii: &mut DVector<f64>) {
        if let Some(radius) = self.radius {
            for (sum, &value) in radii.iter_mut().zip(radius) {
                *sum += value;
            }
        }
    }
}
