//! The values at which a margin is just met: evenly spaced values, and bisection of what changes between
//! them.

use super::margin::{Margin, MarginQuestion};
use crate::fault::Faults;
use crate::progress::Work;
use crate::scan::{bisect, evenly, golden_section, runs, samples};

/// Steps towards the extremum of a dip or hump.
const GOLDEN_STEPS: usize = 40;
/// Margins on both sides of a crossing that differ by more than this share of the wanted one jump there.
const JUMP: f64 = 1e-6;

/// The margin at a value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tried {
    pub(super) at: f64,
    /// None where the mechanism cannot be assembled or solved.
    pub(super) margin: Option<Margin>,
}

/// Why an interval ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum MetCause {
    /// The range ends.
    Range,
    /// The margin is just met.
    Margin,
    /// The margin jumps to this one outside.
    Jump(Margin),
    /// The mechanism cannot be assembled or solved beyond.
    NoPosition,
}

/// An end of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct End {
    pub(super) at: f64,
    pub(super) cause: MetCause,
}

/// A range without a position, and why.
pub(super) struct SizeGap {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) faults: Faults,
}

/// Values at which a search finds the margin met, and the margin at those it tried.
pub(super) struct SizesFound {
    /// The margin at evenly spaced values, and where dips and humps made more necessary.
    pub(super) places: Vec<Tried>,
    /// Where the margin is met.
    pub(super) met: Vec<[End; 2]>,
    pub(super) gaps: Vec<SizeGap>,
}

/// Whether no further step towards an extremum reaches 1, the wanted margin: each changes the demand by no more than it
/// varies now, from the ends of the bracket to the best value inside. Where a margin varies by its rounding only, every
/// third of its values is such an extremum.
fn is_out_of_reach(ends: [f64; 2], inside: f64, steps: usize) -> bool {
    let varies = ends.iter().map(|end| (end - inside).abs()).fold(0.0, f64::max);
    steps as f64 * varies < (inside - 1.0).abs()
}

/// A search over a range.
pub(super) struct MarginSearch<'q> {
    pub(super) question: &'q MarginQuestion<'q>,
    pub(super) wanted: f64,
    pub(super) range: [f64; 2],
    pub(super) steps: usize,
    pub(super) work: Work<'q>,
}

impl MarginSearch<'_> {
    pub(super) fn run(&self) -> SizesFound {
        let values = evenly(self.range, self.steps);
        let tried = samples(values, self.work.part(0, 2), |at, work| self.question.margin(at, work).ok());
        let mut places: Vec<Tried> =
            tried.into_iter().map(|sample| Tried { at: sample.at, margin: sample.found }).collect();
        self.follow_extrema(&mut places);
        SizesFound { met: self.met(&places), gaps: self.gaps(&places), places }
    }

    fn place(&self, at: f64) -> Tried {
        Tried { at, margin: self.refined(at).ok() }
    }

    /// The margin between the evenly spaced values.
    fn refined(&self, at: f64) -> Result<Margin, Faults> {
        // How many of these will follow nobody knows: none of them is a part of the whole that can be told.
        let work = self.work.part(1, 2).part(0, usize::MAX);
        if work.is_over() { Err(Faults::default()) } else { self.question.margin(at, work) }
    }

    fn is_met(&self, place: &Tried) -> bool {
        place.margin.is_some_and(|margin| margin.meets(self.wanted))
    }

    /// Adds the extremum of a dip or hump that crosses the wanted margin between values that do not.
    fn follow_extrema(&self, places: &mut Vec<Tried>) {
        let found: Vec<Tried> = places.windows(3).filter_map(|three| self.extremum(three)).collect();
        places.extend(found);
        places.sort_by(|one, other| one.at.total_cmp(&other.at));
    }

    /// A value between three neighbours on the other side of the wanted margin, sought where the middle one
    /// comes nearest.
    fn extremum(&self, three: &[Tried]) -> Option<Tried> {
        let is_met = self.is_met(&three[1]);
        let [before, middle, after] =
            [three[0].margin?, three[1].margin?, three[2].margin?].map(|margin| margin.demand(self.wanted));
        let nearer = |one: f64, other: f64| if is_met { one > other } else { one < other };
        let is_extreme = (nearer(middle, before) && !nearer(after, middle))
            || (nearer(middle, after) && !nearer(before, middle));
        if !is_extreme || three.iter().any(|place| self.is_met(place) != is_met) {
            return None;
        }
        let ([mut low, mut high], mut ends) = ([three[0].at, three[2].at], [before, after]);
        if is_out_of_reach(ends, middle, GOLDEN_STEPS) {
            return None;
        }
        let mut pair = golden_section([low, high]).map(|at| self.place(at));
        for left in (0..GOLDEN_STEPS).rev() {
            if let Some(crossed) = pair.iter().find(|place| self.is_met(place) != is_met) {
                return crossed.margin.map(|_| *crossed);
            }
            let [one, other] = pair.map(|place| place.margin.map(|margin| margin.demand(self.wanted)));
            let is_first = nearer(one?, other?);
            if is_first {
                (high, ends[1]) = (pair[1].at, other?);
            } else {
                (low, ends[0]) = (pair[0].at, one?);
            }
            if is_out_of_reach(ends, if is_first { one? } else { other? }, left) {
                return None;
            }
            let next = golden_section([low, high]);
            pair = if is_first { [self.place(next[0]), pair[0]] } else { [pair[1], self.place(next[1])] };
        }
        None
    }

    /// The intervals in which the margin is met.
    fn met(&self, places: &[Tried]) -> Vec<[End; 2]> {
        let end = |inside: &Tried, outside: Option<&Tried>| match outside {
            None => End { at: inside.at, cause: MetCause::Range },
            Some(outside) => self.end(inside.at, outside.at),
        };
        runs(places, |one, next| self.is_met(one) == self.is_met(next))
            .filter(|run| self.is_met(run.first()))
            .map(|run| [end(run.first(), run.before), end(run.last(), run.after)])
            .collect()
    }

    /// Where the margin ceases to be met between a value where it is and one where it is not.
    fn end(&self, inside: f64, outside: f64) -> End {
        let [near, beyond] = bisect(inside, outside, |at| self.is_met(&self.place(at)));
        let cause = match (self.place(near).margin, self.place(beyond).margin) {
            (Some(one), Some(other)) => {
                let change = (one.demand(self.wanted) - other.demand(self.wanted)).abs();
                if change > JUMP { MetCause::Jump(other) } else { MetCause::Margin }
            }
            _ => MetCause::NoPosition,
        };
        End { at: near, cause }
    }

    /// The ranges in which the mechanism cannot be assembled or solved.
    fn gaps(&self, places: &[Tried]) -> Vec<SizeGap> {
        let has_position = |at: f64| self.refined(at).is_ok();
        let edge = |own: &Tried, neighbour: Option<&Tried>| {
            neighbour.map_or(own.at, |neighbour| bisect(neighbour.at, own.at, has_position)[1])
        };
        runs(places, |one, next| one.margin.is_some() == next.margin.is_some())
            .filter(|run| run.first().margin.is_none())
            .map(|run| SizeGap {
                from: edge(run.first(), run.before),
                to: edge(run.last(), run.after),
                faults: self.refined(run.first().at).err().unwrap_or_default(),
            })
            .collect()
    }
}
