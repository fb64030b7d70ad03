//! Equations of several nodes side by side, with bounds on their errors.

use super::lanes::{LANES, Lanes};
use super::layout::LEVELS;

/// Entries of a row: the right-hand side and two columns for each place.
pub(super) const WIDTH: usize = 2 * LEVELS + 1;
/// Unit roundoff of `f64`.
pub(super) const UNIT: f64 = f64::EPSILON / 2.0;

pub(super) type Row = [Lanes; WIDTH];

/// The equations of a node, for each lane.
pub(super) struct Level {
    pub(super) rows: Vec<Row>,
    /// Bound on the error of every entry; infinite where a pivot was too small.
    pub(super) bound: Lanes,
    /// Bound on the size of every entry.
    pub(super) size: Lanes,
}

/// The equation that gives the unknown of a place once those below are known.
#[derive(Clone)]
pub(super) struct Pivot {
    pub(super) entries: Row,
    pub(super) inverse: Lanes,
    /// Bound on the error of every entry and of the pivot `p`; infinite where the pivot is too small.
    pub(super) bound: Lanes,
    /// At least `1 / (|p| - bound)`; infinite where the pivot is too small.
    pub(super) guard: Lanes,
    /// The largest entry.
    pub(super) size: Lanes,
}

impl Pivot {
    /// Bound on the error of the unknown `y` computed from `count` others, given the largest of these and of
    /// their errors.
    #[inline(always)]
    pub(super) fn error_of_y(&self, count: f64, y: Lanes, largest: Lanes, error: Lanes) -> Lanes {
        let (bound, size, guard) = (self.bound, self.size, self.guard);
        let mut result = Lanes::ZERO;
        for lane in 0..LANES {
            let (bound, size, y) = (bound.0[lane], size.0[lane], y.0[lane].abs());
            let (largest, error) = (largest.0[lane], error.0[lane]);
            let error_of_value = bound
                + count * (size * error + bound * (largest + error))
                + (count + 4.0) * UNIT * size * (1.0 + count * largest);
            let error_of_y = (error_of_value + y * bound) * guard.0[lane] + 4.0 * UNIT * y;
            result.0[lane] = error_of_y * ROUNDED_UP + f64::MIN_POSITIVE;
        }
        result
    }
}

/// The bound of the module documentation; `factor` is the largest `|l|`, and `guard` at least
/// `1 / (|p| - bound)`.
#[inline(always)]
pub(super) fn bound_below(bound: f64, factor: f64, guard: f64, row: f64, node: f64, unit: f64) -> f64 {
    let spread = (1.0 + factor) * bound;
    let exact = spread + (row + bound) * (spread * guard + unit) + 4.0 * unit * (node + row);
    exact * ROUNDED_UP + f64::MIN_POSITIVE
}

/// Covers the rounding errors in evaluating a bound.
pub(super) const ROUNDED_UP: f64 = 1.0 + 1e-9;
