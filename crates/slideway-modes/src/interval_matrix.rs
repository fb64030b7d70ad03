//! Matrices of intervals, and bounds on rounding errors in products of plain matrices.

use nalgebra::{DMatrix, DVector};

use crate::dense;
use crate::interval::{Interval, add_up};

/// All real matrices that differ from `centre` by at most `radius`, entry by entry.
///
/// ```
/// use nalgebra::dmatrix;
/// use slideway_modes::certificate::{Interval, IntervalMatrix};
/// let mu = IntervalMatrix::from_bounds(&dmatrix![0.1], &dmatrix![0.15]).expect("bounds in order");
/// assert!(mu.entry(0, 0).encloses(Interval::new(0.1, 0.15).expect("bounds in order")));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct IntervalMatrix {
    centre: DMatrix<f64>,
    radius: DMatrix<f64>,
}

impl IntervalMatrix {
    /// The single matrix `centre`.
    pub fn exact(centre: DMatrix<f64>) -> Self {
        let radius = DMatrix::zeros(centre.nrows(), centre.ncols());
        Self { centre, radius }
    }

    /// The matrices within `radius` of `centre`; `None` if the shapes differ, a radius is negative, or an
    /// entry is infinite or NaN.
    pub fn around(centre: DMatrix<f64>, radius: DMatrix<f64>) -> Option<Self> {
        let sensible = centre.shape() == radius.shape()
            && centre.iter().all(|value| value.is_finite())
            && radius.iter().all(|value| value.is_finite() && *value >= 0.0);
        sensible.then_some(Self { centre, radius })
    }

    /// The matrices between two bounds; `None` if the shapes differ, bounds are out of order, or an entry is
    /// infinite or NaN. Centre and radius are rounded so that no matrix is lost.
    pub fn from_bounds(lower: &DMatrix<f64>, upper: &DMatrix<f64>) -> Option<Self> {
        let in_order = || lower.iter().zip(upper).all(|(low, high)| low <= high);
        if lower.shape() != upper.shape() || !in_order() {
            return None;
        }
        let centre = lower.zip_map(upper, |low, high| (0.5 * low + 0.5 * high).clamp(low, high));
        let radius = DMatrix::from_fn(lower.nrows(), lower.ncols(), |row, column| {
            let at = (row, column);
            add_up(upper[at], -centre[at]).max(add_up(centre[at], -lower[at]))
        });
        Self::around(centre, radius)
    }

    /// The matrix at the midpoint.
    pub fn centre(&self) -> &DMatrix<f64> {
        &self.centre
    }

    /// The largest difference from [`centre`](Self::centre), entry by entry.
    pub fn radius(&self) -> &DMatrix<f64> {
        &self.radius
    }

    /// Rows and columns.
    pub fn shape(&self) -> (usize, usize) {
        self.centre.shape()
    }

    /// One entry.
    ///
    /// # Panics
    /// If there is no such entry.
    pub fn entry(&self, row: usize, column: usize) -> Interval {
        Interval::around(self.centre[(row, column)], self.radius[(row, column)])
    }

    /// The transposed matrices.
    #[must_use]
    pub fn transposed(&self) -> Self {
        Self { centre: self.centre.transpose(), radius: self.radius.transpose() }
    }

    /// These columns, then those of another matrix with as many rows.
    pub(crate) fn beside(&self, other: &Self) -> Self {
        let (rows, columns) = self.shape();
        let joined = |one: &DMatrix<f64>, other: &DMatrix<f64>| {
            let entries = one.iter().chain(other.iter()).copied();
            DMatrix::from_iterator(rows, columns + other.ncols(), entries)
        };
        Self { centre: joined(&self.centre, &other.centre), radius: joined(&self.radius, &other.radius) }
    }

    /// The matrices whose entries lie in the given intervals; `None` if one of these is unbounded.
    pub fn from_intervals(entries: &DMatrix<Interval>) -> Option<Self> {
        Self::from_bounds(&entries.map(Interval::lower), &entries.map(Interval::upper))
    }
}

/// `terms eps`: above `2 gamma_n = 2 n u / (1 - n u)`, with `u = eps / 2` the unit roundoff, for
/// `n = terms - 4`. The rounding error of a sum of `n` products, in any order and with or without fused
/// operations, is therefore at most this times the sum of absolute values, itself rounded (apart from
/// underflow).
pub(crate) fn rounding(terms: usize) -> f64 {
    (terms + 4) as f64 * f64::EPSILON
}

/// An upper bound on `matrix vector` if neither has a negative entry. Every entry is positive.
pub(crate) fn upper_product(matrix: &DMatrix<f64>, vector: &DVector<f64>) -> DVector<f64> {
    let factor = 1.0 + 2.0 * rounding(matrix.ncols());
    (matrix * vector).map(|value| value * factor + f64::MIN_POSITIVE)
}

/// An upper bound on a sum of nonnegative vectors.
pub(crate) fn upper_sum(parts: &[&DVector<f64>]) -> DVector<f64> {
    let factor = 1.0 + 2.0 * rounding(parts.len());
    DVector::from_fn(parts[0].len(), |row, _| parts.iter().map(|part| part[row]).sum::<f64>() * factor)
}

/// The product of a plain matrix and an interval matrix; entries that overflow are not finite. `None` once
/// `proceed` is `false`.
///
/// `|fl(A B) - A B| <= gamma_n |A| |B|`, and a radius of `B` adds `|A| rad(B)`.
pub(crate) fn product(
    left: &DMatrix<f64>,
    right: &IntervalMatrix,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<IntervalMatrix> {
    let terms = left.ncols();
    let sizes = left.abs();
    let factor = 1.0 + 2.0 * rounding(terms);
    let rounded = dense::product(&sizes, &right.centre.abs(), proceed)? * rounding(terms);
    let spread = dense::product(&sizes, &right.radius, proceed)?;
    let radius = (rounded + spread).map(|value| value * factor + f64::MIN_POSITIVE);
    Some(IntervalMatrix { centre: dense::product(left, &right.centre, proceed)?, radius })
}

/// An enclosure of the inner product of plain vectors, where entry `k` of the second one is known only within
/// `radius[k]`; none of the operands may be longer than the others.
pub(crate) fn inner_product(one: &[f64], other: &[f64], radius: Option<&[f64]>) -> Interval {
    let (mut sum, mut size) = (0.0, 0.0);
    for (a, b) in one.iter().zip(other) {
        sum += a * b;
        size += (a * b).abs();
    }
    let terms = one.len();
    let mut bound = size * rounding(terms) + terms as f64 * f64::MIN_POSITIVE;
    if let Some(radius) = radius {
        let spread: f64 = one.iter().zip(radius).map(|(a, wide)| a.abs() * wide).sum();
        bound += spread * (1.0 + 2.0 * rounding(terms)) + terms as f64 * f64::MIN_POSITIVE;
    }
    Interval::around(sum, bound * (1.0 + 4.0 * f64::EPSILON))
}
