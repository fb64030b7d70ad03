//! Where modes exist if the mode problem does not depend linearly on what is varied: evenly spaced points, and
//! bisection of what changes between them.

use super::varied::Varied;
use crate::modes::ContactState;
use crate::modes::existence::{
    CountInterval, EndCause, Existence, ExistenceOptions, Limit, ModeEnd, ModeInterval, ModeProblemLine,
    TooManyModes,
};
use crate::progress::Work;
use crate::solve::Parts;
use std::ops::ControlFlow;

/// Steps of the evenly spaced points.
pub(super) const STEPS: usize = 500;
/// Halvings between two points: down to neighbouring numbers.
const HALVINGS: usize = 100;

/// The mode problem at a place, alone.
struct Place {
    at: f64,
    /// None where the mechanism cannot be assembled, or cannot be solved for another reason.
    line: Option<ModeProblemLine>,
    present: Vec<Vec<ContactState>>,
}

/// Everything that a scan finds.
#[derive(Default)]
pub(super) struct Scan {
    pub(super) existence: Existence,
    pub(super) counts: Vec<CountInterval>,
    /// Ranges in which there is no mode problem.
    pub(super) gaps: Vec<[f64; 2]>,
}

/// A scan over a range.
pub(super) struct Scanner<'v> {
    pub(super) varied: &'v Varied,
    pub(super) options: ExistenceOptions,
    pub(super) work: Work<'v>,
}

impl Scanner<'_> {
    /// # Errors
    /// More patterns than the options allow.
    pub(super) fn scan(&self) -> Result<Scan, TooManyModes> {
        let [from, to] = self.options.range;
        let mut places = Vec::with_capacity(STEPS + 1);
        for step in 0..=STEPS {
            let piece = self.work.part(0, 2).piece("values", step, STEPS + 1);
            places.push(match piece {
                ControlFlow::Continue(_) => self.place(from + (to - from) * step as f64 / STEPS as f64)?,
                ControlFlow::Break(()) => return Ok(Scan::default()),
            });
        }
        let mut patterns: Vec<&Vec<ContactState>> = places.iter().flat_map(|place| &place.present).collect();
        patterns.sort_unstable();
        patterns.dedup();
        let mut existence = Existence::default();
        for pattern in patterns {
            existence.modes.extend(self.intervals(pattern, &places));
        }
        let gaps = self.gaps(&places);
        let counts = counts(&existence, &gaps, self.options.range);
        Ok(Scan { existence, counts, gaps })
    }

    fn place(&self, at: f64) -> Result<Place, TooManyModes> {
        let line = self.line(at);
        let present = line.as_ref().map_or(Ok(Vec::new()), |line| line.present(0.0, &self.options))?;
        Ok(Place { at, line, present })
    }

    fn line(&self, at: f64) -> Option<ModeProblemLine> {
        if self.work.part(1, 2).is_over() {
            return None;
        }
        self.varied.parts(at).ok().map(|parts: Parts| parts.line_to(&parts))
    }

    /// The intervals of one pattern, from the points at which it is present.
    fn intervals(&self, pattern: &[ContactState], places: &[Place]) -> Vec<ModeInterval> {
        let present = |place: &Place| place.present.iter().any(|other| other == pattern);
        let mut intervals = Vec::new();
        let mut start: Option<ModeEnd> = None;
        for (index, place) in places.iter().enumerate() {
            match (present(place), &start) {
                (true, None) => {
                    start = Some(match index.checked_sub(1).map(|before| &places[before]) {
                        None => self.range_end(pattern, place.at),
                        Some(before) => self.end(pattern, place.at, before.at),
                    });
                }
                (false, Some(from)) => {
                    let to = self.end(pattern, places[index - 1].at, place.at);
                    intervals.push(ModeInterval { pattern: pattern.to_vec(), from: from.clone(), to });
                    start = None;
                }
                _ => {}
            }
        }
        if let (Some(from), Some(last)) = (start, places.last()) {
            let to = self.range_end(pattern, last.at);
            intervals.push(ModeInterval { pattern: pattern.to_vec(), from, to });
        }
        intervals
    }

    fn range_end(&self, pattern: &[ContactState], at: f64) -> ModeEnd {
        let force = self.line(at).and_then(|line| line.normal_force(pattern, 0.0));
        let normal_force = force.map(|force| force.iter().map(|&n| Limit::Finite(n)).collect());
        ModeEnd { at, cause: EndCause::Range, normal_force }
    }

    /// Where a mode ends between a place where it exists and one where it does not.
    fn end(&self, pattern: &[ContactState], inside: f64, outside: f64) -> ModeEnd {
        let exists = |at: f64| self.line(at).is_some_and(|line| line.exists(pattern, 0.0, &self.options));
        let (near, beyond) = bisect(inside, outside, exists);
        let (Some(line), Some(next)) = (self.line(near), self.line(beyond)) else {
            return ModeEnd { at: near, cause: EndCause::NoProblem, normal_force: None };
        };
        let cause = line.cause(&next, pattern, &self.options).unwrap_or(EndCause::Locking);
        // Rounding counts for the mode: what vanishes is followed without tolerance.
        let slack = |at: f64| self.line(at).and_then(|line| line.slack(pattern, &cause, &self.options));
        let at = match (slack(inside), slack(outside)) {
            (Some(one), Some(other)) if one * other < 0.0 => {
                bisect(inside, outside, |at| slack(at).is_some_and(|value| value * one > 0.0)).0
            }
            _ => near,
        };
        let force = self.line(at).and_then(|line| line.normal_force(pattern, 0.0));
        let limit = |&n: &f64| {
            if cause == EndCause::Locking { Limit::Infinite(n.signum()) } else { Limit::Finite(n) }
        };
        let normal_force = force.map(|force| force.iter().map(limit).collect());
        ModeEnd { at, cause, normal_force }
    }

    /// The ranges without a mode problem, to the accuracy of the points.
    fn gaps(&self, places: &[Place]) -> Vec<[f64; 2]> {
        let mut gaps: Vec<[f64; 2]> = Vec::new();
        for (index, place) in places.iter().enumerate().filter(|(_, place)| place.line.is_none()) {
            let edge = |neighbour: Option<usize>| {
                let Some(neighbour) = neighbour.and_then(|index| places.get(index)) else { return place.at };
                if neighbour.line.is_none() {
                    place.at
                } else {
                    bisect(neighbour.at, place.at, |at| self.varied.parts(at).is_ok()).0
                }
            };
            let (from, to) = (edge(index.checked_sub(1)), edge(Some(index + 1)));
            let continues = index > 0 && places[index - 1].line.is_none();
            match gaps.last_mut() {
                Some(last) if continues => last[1] = to,
                _ => gaps.push([from, to]),
            }
        }
        gaps
    }
}

/// Neighbouring places, of which only the first is inside.
pub(crate) fn bisect(mut inside: f64, mut outside: f64, is_inside: impl Fn(f64) -> bool) -> (f64, f64) {
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(inside, outside);
        if middle == inside || middle == outside {
            break;
        }
        if is_inside(middle) { inside = middle } else { outside = middle }
    }
    (inside, outside)
}

/// The number of solutions between the ends of modes, ranges without a mode problem left out.
fn counts(existence: &Existence, gaps: &[[f64; 2]], range: [f64; 2]) -> Vec<CountInterval> {
    let ends = existence.modes.iter().flat_map(|mode| [mode.from.at, mode.to.at]);
    let mut ends: Vec<f64> = ends.chain(gaps.iter().flatten().copied()).chain(range).collect();
    ends.sort_by(f64::total_cmp);
    let scale = (range[1] - range[0]).abs();
    ends.dedup_by(|next, kept| *next - *kept <= 1e-9 * scale);
    let mut intervals: Vec<CountInterval> = Vec::new();
    for pair in ends.windows(2) {
        let middle = f64::midpoint(pair[0], pair[1]);
        if gaps.iter().any(|gap| gap[0] < middle && middle < gap[1]) {
            continue;
        }
        let inside = |mode: &&ModeInterval| mode.from.at < middle && middle < mode.to.at;
        let (gap_states, solutions): (Vec<_>, Vec<_>) =
            existence.modes.iter().filter(inside).partition(|mode| mode.pattern.contains(&ContactState::Gap));
        let (solutions, gap_states) = (solutions.len(), gap_states.len());
        match intervals.last_mut() {
            Some(last)
                if last.to == pair[0] && (last.solutions, last.gap_states) == (solutions, gap_states) =>
            {
                last.to = pair[1];
            }
            _ => intervals.push(CountInterval { from: pair[0], to: pair[1], solutions, gap_states }),
        }
    }
    intervals
}
