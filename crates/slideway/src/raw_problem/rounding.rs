//! What rounding does between the numbers given and the mode problem: only `A + B` and `B - A` of an
//! absolute value equation can be rounded.

use nalgebra::DMatrix;

use super::RawProblem;
use crate::modes::certificate::{
    Decision, Interval, IntervalMatrix, IntervalModeProblem, decide, proves_at_most_one,
};
use crate::modes::{BySide, ContactState, ModeProblem, Side};

/// The most unknowns with which every pattern is decided.
const EVERY_PATTERN: usize = 10;

/// The problem that proofs are about.
pub(super) enum Proved {
    /// The mode problem as it stands: nothing was rounded.
    Exact,
    /// Columns that enclose the true ones, and how many of their entries were rounded.
    Within { problem: Box<IntervalModeProblem>, rounded: usize },
    /// The columns are rounded, and no enclosure of them can be had.
    Nothing,
}

impl Proved {
    pub(super) fn of(raw: &RawProblem, problem: &ModeProblem) -> Self {
        let RawProblem::AbsoluteValue { a, b, .. } = raw else { return Self::Exact };
        let plus = a.zip_map(b, rounding_error);
        let minus = b.zip_map(&-a, rounding_error);
        let rounded = plus.iter().chain(&minus).filter(|&&error| error > 0.0).count();
        if rounded == 0 {
            return Self::Exact;
        }
        let around = |centre: &DMatrix<f64>, radius| IntervalMatrix::around(centre.clone(), radius);
        let columns =
            around(problem.columns(Side::Positive), plus).zip(around(problem.columns(Side::Negative), minus));
        let none = IntervalMatrix::exact(DMatrix::zeros(a.nrows(), a.ncols()));
        let load = problem.right_hand_side();
        let load = IntervalMatrix::exact(DMatrix::from_column_slice(load.len(), 1, load.as_slice()));
        columns
            .and_then(|(positive, negative)| {
                let columns = BySide { positive, negative };
                IntervalModeProblem::new(&columns, &BySide::same(none), &load).ok()
            })
            .map_or(Self::Nothing, |problem| Self::Within { problem: Box::new(problem), rounded })
    }

    /// Whether the problem as given has exactly one solution, and it is the one of this pattern.
    pub(super) fn only_solution(&self, pattern: &[ContactState]) -> bool {
        let Self::Within { problem, .. } = self else { return false };
        let verdict = || decide(problem.as_ref(), pattern).decision;
        proves_at_most_one(problem.as_ref(), &vec![None; pattern.len()])
            && matches!(verdict(), Decision::Solution { .. })
    }

    /// The number of solutions of the problem as given, if it is small enough to decide every pattern
    /// and all of them can be decided.
    pub(super) fn number_of_solutions(&self) -> Option<u64> {
        let Self::Within { problem, .. } = self else { return None };
        let size = problem.centre().contacts();
        let mut solutions = 0;
        for number in 0..1_u32.checked_shl(u32::try_from(size).ok()?).filter(|_| size <= EVERY_PATTERN)? {
            let side = |at: usize| {
                if number >> at & 1 == 0 { ContactState::Positive } else { ContactState::Negative }
            };
            match decide(problem.as_ref(), &(0..size).map(side).collect::<Vec<_>>()).decision {
                Decision::Solution { .. } => solutions += 1,
                Decision::NoSolution { .. } => {}
                _ => return None,
            }
        }
        Some(solutions)
    }

    /// How far the values of a pattern may be from those of its exact solution; none if that is not
    /// known.
    pub(super) fn radius(
        &self,
        problem: &ModeProblem,
        pattern: &[ContactState],
        values: &[f64],
    ) -> Option<f64> {
        let decision = match self {
            Self::Exact => decide(problem, pattern).decision,
            Self::Within { problem, .. } => decide(problem.as_ref(), pattern).decision,
            Self::Nothing => return None,
        };
        let (Decision::Solution { unknowns, .. }
        | Decision::Boundary { unknowns, .. }
        | Decision::Undecided { unknowns: Some(unknowns), .. }) = decision
        else {
            return None;
        };
        let distance = |(bounds, value): (&Interval, &f64)| {
            let largest = (bounds.upper() - value.abs()).max(value.abs() - bounds.lower());
            if largest > 0.0 { largest.next_up() } else { 0.0 }
        };
        let radius = unknowns.iter().zip(values).map(distance).fold(0.0, f64::max);
        radius.is_finite().then_some(radius)
    }
}

/// The size of what is lost when `a + b` is rounded (Knuth, The Art of Computer Programming 2,
/// section 4.2.2, theorem B: the loss is a floating-point number itself).
fn rounding_error(a: f64, b: f64) -> f64 {
    let sum = a + b;
    let b_in_sum = sum - a;
    ((a - (sum - b_in_sum)) + (b - b_in_sum)).abs()
}

#[cfg(test)]
mod tests {
    use super::rounding_error;

    #[test]
    fn only_what_is_lost_counts() {
        assert_eq!(rounding_error(1.0, 0.5), 0.0);
        assert_eq!(rounding_error(1.0, 1e-17), 1e-17);
        // 0.1 + 0.2 is not the number nearest to 0.3, but one above the exact sum by 2^-55.
        assert_eq!(rounding_error(0.1, 0.2), 2.0_f64.powi(-55));
    }
}
