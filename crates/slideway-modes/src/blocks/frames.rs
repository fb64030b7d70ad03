//! Bounds on the matrices of slopes of the equations, with the unknowns of each hinge along two vectors of its own.
//!
//! Rounding errors are bounded for each entry as a whole, from the size of its terms: intervals for each operation
//! would take most of the time of the search.

use nalgebra::DMatrix;

use super::problem::BlockProblem;
use super::sector::Vector;
use crate::interval::Interval;
use crate::interval_matrix::{IntervalMatrix, rounding};
use crate::problem::{ContactState, Side};

/// A number within a radius of another one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ball {
    centre: f64,
    radius: f64,
}

impl Ball {
    /// Any slope of a length.
    pub(super) const ANY_SLOPE: Self = Self { centre: 0.0, radius: 1.0 };
    const ZERO: Self = Self { centre: 0.0, radius: 0.0 };
    const ONE: Self = Self { centre: 1.0, radius: 0.0 };

    /// The number alone.
    pub(super) fn point(centre: f64) -> Self {
        Self { centre, radius: 0.0 }
    }

    /// Half a sum, apart from rounding.
    fn half_sum(self, other: Self) -> Self {
        Self { centre: 0.5 * (self.centre + other.centre), radius: 0.5 * (self.radius + other.radius) }
    }

    fn negated(self) -> Self {
        Self { centre: -self.centre, ..self }
    }
}

impl From<Interval> for Ball {
    /// A ball that contains an interval.
    fn from(interval: Interval) -> Self {
        let centre = interval.middle();
        Self { centre, radius: (interval - Interval::point(centre)).magnitude() }
    }
}

/// Two vectors of equal length at right angles, along which the reaction of a hinge is told, and bounds on the products
/// of slopes with them.
pub(super) struct Frame {
    pub(super) vectors: [Vector; 2],
    pub(super) slopes: [Ball; 2],
}

impl Frame {
    /// The components themselves, with given slopes.
    pub(super) fn of_components(slopes: [Ball; 2]) -> Self {
        Self { vectors: [[1.0, 0.0], [0.0, 1.0]], slopes }
    }
}

/// The matrices of slopes ([`matrix`](super::equations::matrix)) for unknowns of hinges along the vectors of frames, and
/// slopes of open contacts: with `x_j = y_1 m + y_2 n` the columns are `m - H_j (s.m)` and `n - H_j (s.n)`. `None` if
/// numbers overflow.
///
/// Slopes `s` of directions that differ from `m` by at most `d` have `cos d <= s.m <= 1`, which varies by the square of
/// `d` only: near locking directions this decides what slopes component by component leave open.
pub(super) fn matrix_in_frames(
    problem: &BlockProblem,
    states: &[Option<ContactState>],
    contacts: &[Ball],
    frames: &[Frame],
) -> Option<IntervalMatrix> {
    let rows = problem.rows();
    let [mut centre, mut radius] = [0, 1].map(|_| DMatrix::zeros(rows, rows));
    let mut set = |at: (usize, usize), own: f64, terms: [(Ball, Ball); 2]| {
        let value = difference(own, terms);
        (centre[at], radius[at]) = (value.centre, value.radius);
    };
    let nothing = (Ball::ZERO, Ball::ZERO);
    for (contact, (state, slope)) in states.iter().zip(contacts).enumerate() {
        for row in 0..rows {
            let identity = if row == contact { 1.0 } else { 0.0 };
            let of = |part: fn(&BlockProblem, Side) -> &IntervalMatrix| {
                Side::BOTH.map(|side| entry(part(problem, side), row, contact))
            };
            let [positive, negative] = of(BlockProblem::response);
            let (own, terms) = match state {
                Some(ContactState::Positive) => (identity, [(positive, Ball::ONE), nothing]),
                Some(ContactState::Negative) => (identity, [(negative.negated(), Ball::ONE), nothing]),
                Some(ContactState::Gap) => {
                    let [positive, negative] = of(BlockProblem::jumps);
                    (0.0, [(positive, Ball::ONE), (negative.negated(), Ball::ONE)])
                }
                None => {
                    let even = positive.half_sum(negative.negated());
                    (identity, [(even, Ball::ONE), (positive.half_sum(negative), *slope)])
                }
            };
            set((row, contact), own, terms);
        }
    }
    for (hinge, frame) in frames.iter().enumerate() {
        let own = problem.rows_of_hinge(hinge);
        for row in 0..rows {
            let response = entry(problem.response(Side::Positive), row, problem.contacts() + hinge);
            for ((vector, slope), column) in frame.vectors.iter().zip(frame.slopes).zip(own) {
                let component = own.iter().position(|&own| own == row);
                let own = component.map_or(0.0, |component| vector[component]);
                set((row, column), own, [(response, slope), nothing]);
            }
        }
    }
    IntervalMatrix::around(centre, radius)
}

/// An entry of the data.
fn entry(matrix: &IntervalMatrix, row: usize, column: usize) -> Ball {
    Ball { centre: matrix.centre()[(row, column)], radius: matrix.radius()[(row, column)] }
}

/// `own - sum h_i s_i` with its rounding error, and that of half sums in it. Terms of which a factor is zero are exact.
fn difference(own: f64, terms: [(Ball, Ball); 2]) -> Ball {
    let (mut centre, mut spread, mut size) = (own, 0.0, 0.0);
    for (factor, slope) in terms {
        if factor.centre != 0.0 && slope.centre != 0.0 {
            let term = factor.centre * slope.centre;
            centre -= term;
            // Each sum before the last one is at most as large as it and the terms behind it.
            size += 2.0 * term.abs() + f64::MIN_POSITIVE;
        }
        spread += factor.centre.abs() * slope.radius + factor.radius * (slope.centre.abs() + slope.radius);
    }
    if size == 0.0 && spread == 0.0 {
        return Ball::point(own);
    }
    let radius = (spread + (size + centre.abs()) * rounding(0)) * (1.0 + rounding(0)) + f64::MIN_POSITIVE;
    Ball { centre, radius }
}
