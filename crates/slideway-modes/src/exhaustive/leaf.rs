//! The last three contacts by Cramer's rule, and those above them as long as no division is needed.

use super::lanes::{LANES, Lanes};
use super::layout::{CRAMER, SOLVED};
use super::level::{Level, Pivot, ROUNDED_UP, UNIT};

/// Errors of the multiples `x_k = D y_k`, for all patterns of a leaf.
pub(super) struct LeafErrors {
    /// Bound on the error of the determinant `D` and of the first `x_k`.
    pub(super) determinant: Lanes,
    /// Bound on the error of each `x_k` from `CRAMER` on.
    pub(super) later: [Lanes; SOLVED - CRAMER],
}

impl LeafErrors {
    #[inline(always)]
    pub(super) fn new(node: &Level, pivots: &[Pivot]) -> Self {
        let mut entry = Lanes::ZERO;
        for row in &node.rows[..CRAMER] {
            for lanes in &row[..=2 * CRAMER] {
                entry = entry.larger(lanes.abs());
            }
        }
        let determinant = error_of_determinants(entry, node.bound);
        let mut error = determinant;
        let mut size = entry.map(|a| 6.0 * a * a * a);
        let mut later = [Lanes::ZERO; SOLVED - CRAMER];
        for (place, later) in (CRAMER..).zip(&mut later) {
            let pivot = &pivots[place];
            let terms = place as f64 + 1.0;
            for lane in 0..LANES {
                let (bound, row, guard) = (pivot.bound.0[lane], pivot.size.0[lane], pivot.guard.0[lane]);
                let (x, x_error) = (size.0[lane], error.0[lane]);
                let next = terms * row * x * guard * ROUNDED_UP;
                let sum = terms * (row * x_error + bound * (x + x_error) + (terms + 2.0) * UNIT * row * x);
                let here = guard * (sum + bound * next) + 4.0 * UNIT * next;
                later.0[lane] = here * ROUNDED_UP + f64::MIN_POSITIVE;
                size.0[lane] = if next > x { next } else { x };
            }
            error = error.larger(*later);
        }
        Self { determinant, later }
    }

    /// Bound on the error of all `x_k`.
    #[inline(always)]
    pub(super) fn largest(&self) -> Lanes {
        self.later.iter().fold(self.determinant, |largest, &error| largest.larger(error))
    }
}

/// A pattern of the last places.
pub(super) struct Solved {
    pub(super) determinant: Lanes,
    /// `y_k` times the determinant.
    pub(super) multiples: [Lanes; SOLVED],
}

impl Solved {
    /// Above zero where `|D|` exceeds its error and some `x_k / D` is certainly negative.
    #[inline(always)]
    pub(super) fn excess(&self, bounds: &LeafErrors) -> Lanes {
        let mut result = Lanes::ZERO;
        for lane in 0..LANES {
            let sign = self.determinant.0[lane].to_bits() & (1 << 63);
            let oriented = |k: usize| f64::from_bits(self.multiples[k].0[lane].to_bits() ^ sign);
            let lower = |a: f64, b: f64| if b < a { b } else { a };
            let cramer = lower(lower(oriented(0), oriented(1)), oriented(2));
            let mut highest = cramer + bounds.determinant.0[lane];
            for place in CRAMER..SOLVED {
                highest = lower(highest, oriented(place) + bounds.later[place - CRAMER].0[lane]);
            }
            let regular = self.determinant.0[lane].abs() - bounds.determinant.0[lane];
            result.0[lane] = lower(regular, -highest);
        }
        result
    }

    /// Bound on the error of the quotients, the largest of which is given, if the multiples are wrong by
    /// `error`.
    #[inline(always)]
    pub(super) fn error_of_y(&self, bounds: &LeafErrors, error: Lanes, largest: Lanes) -> Lanes {
        let mut result = Lanes::ZERO;
        for lane in 0..LANES {
            let (determinant, y) = (bounds.determinant.0[lane], largest.0[lane]);
            let bound = (error.0[lane] + y * determinant) / (self.determinant.0[lane].abs() - determinant);
            result.0[lane] = (bound + 4.0 * UNIT * y) * ROUNDED_UP + f64::MIN_POSITIVE;
        }
        let regular = bounds.determinant.is_smaller_than(self.determinant);
        regular.select(result, Lanes([f64::INFINITY; LANES]))
    }
}

/// `a x b`
#[inline(always)]
pub(super) fn cross<const FUSED: bool>(a: [Lanes; 3], b: [Lanes; 3]) -> [Lanes; 3] {
    [minor::<FUSED>(a, b, 1, 2), minor::<FUSED>(a, b, 2, 0), minor::<FUSED>(a, b, 0, 1)]
}

/// `a_i b_j - a_j b_i`
#[inline(always)]
fn minor<const FUSED: bool>(a: [Lanes; 3], b: [Lanes; 3], i: usize, j: usize) -> Lanes {
    a[i].times_plus::<FUSED>(b[j], a[j].times(b[i]).map(|product| -product))
}

/// `a . b`
#[inline(always)]
pub(super) fn dot<const FUSED: bool>(a: [Lanes; 3], b: [Lanes; 3]) -> Lanes {
    a[0].times_plus::<FUSED>(b[0], a[1].times_plus::<FUSED>(b[1], a[2].times(b[2])))
}

/// Bound for entries of size at most `a`, each of them wrong by at most `e`.
#[inline(always)]
pub(super) fn error_of_determinants(a: Lanes, e: Lanes) -> Lanes {
    a.zip(e, |a, e| {
        let exact = 6.0 * e * (3.0 * a * (a + e) + e * e) + 32.0 * UNIT * (a * a * a);
        exact * ROUNDED_UP + f64::MIN_POSITIVE
    })
}
