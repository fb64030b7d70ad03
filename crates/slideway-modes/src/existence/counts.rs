//! The number of solutions along a line of parameters.

use nalgebra::DVector;

use super::{Existence, ModeInterval, ModeProblemLine};
use crate::problem::ContactState;

/// Outputs below this multiple of the greatest term that they are the sum of are rounding errors.
const ROUNDING: f64 = 1e-13;

/// Ends closer than this fraction of the larger one count as the same.
const SAME_END: f64 = 1e-10;

/// An interval of the parameter with the same number of solutions throughout.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountInterval {
    /// Where it begins.
    pub from: f64,
    /// Where it ends; possibly infinite.
    pub to: f64,
    /// Number of solutions.
    pub solutions: usize,
    /// Number of preload-gap states, which do not count as solutions.
    pub gap_states: usize,
    /// Whether there are infinitely many solutions, besides these.
    pub continuum: bool,
}

impl CountInterval {
    /// Whether another interval has the same numbers.
    pub fn is_like(&self, other: &Self) -> bool {
        let numbers = |one: &Self| (one.solutions, one.gap_states, one.continuum);
        numbers(self) == numbers(other)
    }

    /// Whether there is neither a solution nor a gap state.
    pub fn is_empty(&self) -> bool {
        self.solutions + self.gap_states == 0 && !self.continuum
    }
}

/// The number of solutions in each interval of a range; neighbours with equal numbers are joined.
///
/// `existence` contains the modes of `line` in that `range`. Two patterns count once if they have the same
/// solution, as they do if a normal force is zero throughout.
pub fn counts(line: &ModeProblemLine, existence: &Existence, range: [f64; 2]) -> Vec<CountInterval> {
    let cells = cells(ends(&existence.modes).chain(range), is_same_end);
    counts_in(existence, &cells, &|modes, at| line.distinct(modes, at))
}

/// Whether an end of a mode coincides with the one before it.
pub fn is_same_end(next: f64, kept: f64) -> bool {
    next.is_finite() && next - kept <= SAME_END * next.abs()
}

/// The number of solutions in each of several cells, inside which no mode begins or ends; neighbours with
/// equal numbers are joined. `distinct` returns the number of different solutions of some modes at a place.
pub fn counts_in(
    existence: &Existence,
    cells: &[[f64; 2]],
    distinct: &dyn Fn(&[&ModeInterval], f64) -> usize,
) -> Vec<CountInterval> {
    let mut intervals: Vec<CountInterval> = Vec::new();
    for &cell in cells {
        let inside = middle(cell);
        let present: Vec<&ModeInterval> =
            existence.modes.iter().filter(|mode| mode.from.at < inside && inside < mode.to.at).collect();
        let (solutions, gaps): (Vec<_>, Vec<_>) =
            present.into_iter().partition(|mode| existence.open.is_solution(&mode.pattern));
        let [solutions, gap_states] = [solutions, gaps].map(|modes| distinct(&modes, inside));
        let next = CountInterval { from: cell[0], to: cell[1], solutions, gap_states, continuum: false };
        match intervals.last_mut() {
            Some(last) if last.to == cell[0] && last.is_like(&next) => last.to = cell[1],
            _ => intervals.push(next),
        }
    }
    intervals
}

/// Where modes begin and end.
pub fn ends(modes: &[ModeInterval]) -> impl Iterator<Item = f64> {
    modes.iter().flat_map(|mode| [mode.from.at, mode.to.at])
}

/// The cells between places given in any order; coinciding places count as one.
pub fn cells(places: impl Iterator<Item = f64>, same: impl Fn(f64, f64) -> bool) -> Vec<[f64; 2]> {
    let mut places: Vec<f64> = places.collect();
    places.sort_by(f64::total_cmp);
    places.dedup_by(|next, kept| *next == *kept || same(*next, *kept));
    places.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// Whether there is neither a solution nor a gap state just beyond an end of a mode: below it where the mode
/// begins there, else above it. `intervals` are those of [`counts_in`]; `false` where they do not tell of the
/// other side. `same` says whether an end of a mode coincides with the one before it.
pub fn nothing_is_left(
    intervals: &[CountInterval],
    end: f64,
    begins: bool,
    same: impl Fn(f64, f64) -> bool,
) -> bool {
    let above = intervals.partition_point(|interval| interval.to <= end);
    let Some(upper) = intervals.get(above).filter(|interval| interval.from <= end) else { return false };
    let beyond = if begins {
        let lower = above.checked_sub(1).map(|below| &intervals[below]);
        lower.filter(|lower| lower.to == upper.from && same(end, upper.from))
    } else {
        Some(upper)
    };
    beyond.is_some_and(CountInterval::is_empty)
}

/// A place inside a cell.
fn middle([from, to]: [f64; 2]) -> f64 {
    if to.is_infinite() { 2.0 * from } else { f64::midpoint(from, to) }
}

impl ModeProblemLine {
    /// Number of different solutions of some modes at a parameter where all of them exist.
    ///
    /// Two patterns have the same solution only if the normal forces of all contacts in which they differ
    /// vanish in both, that is, are within their own rounding errors, however small they are compared with
    /// others, and if nothing else [distinguishes their sides](Self::sides_differ).
    pub fn distinct(&self, modes: &[&ModeInterval], at: f64) -> usize {
        if modes.len() < 2 {
            return modes.len();
        }
        let mut known: Vec<(&[ContactState], Vec<bool>)> = Vec::with_capacity(modes.len());
        for mode in modes {
            let Some(vanishes) = self.line(&mode.pattern).vanishes(at) else { continue };
            let same = |(pattern, other): &(&[ContactState], Vec<bool>)| {
                let is_same = |k: usize| other[k] && vanishes[k] && !self.sides_differ[k];
                (0..pattern.len()).all(|k| pattern[k] == mode.pattern[k] || is_same(k))
            };
            if !known.iter().any(same) {
                known.push((&mode.pattern, vanishes));
            }
        }
        known.len()
    }

    /// The unknowns of a pattern: `y_k`, or the share `lambda_k` for a contact in its gap, then the outputs, 0 where
    /// they are rounding errors of the terms that they are the sum of; `None` if its determinant vanishes.
    pub fn unknowns(&self, pattern: &[ContactState], at: f64) -> Option<DVector<f64>> {
        let line = self.line(pattern);
        let mut unknowns = line.solution(at)?;
        let (matrix, right) = (line.matrix_at(at), line.right_hand_side_at(at));
        for output in pattern.len()..unknowns.len() {
            let term = |contact: usize| (matrix[(output, contact)] * unknowns[contact]).abs();
            let greatest = (0..pattern.len()).map(term).fold(right[output].abs(), f64::max);
            if unknowns[output].abs() <= ROUNDING * greatest {
                unknowns[output] = 0.0;
            }
        }
        Some(unknowns)
    }

    /// Signed normal forces of a pattern, 0 in a gap; `None` if its determinant vanishes.
    pub fn normal_force(&self, pattern: &[ContactState], at: f64) -> Option<DVector<f64>> {
        let unknowns = self.line(pattern).solution(at)?;
        Some(DVector::from_iterator(
            pattern.len(),
            pattern.iter().zip(unknowns.iter()).map(|(state, y)| state.sign() * y),
        ))
    }
}
