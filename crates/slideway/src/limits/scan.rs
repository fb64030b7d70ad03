//! Where modes exist if the mode problem does not depend linearly on what is varied: many values, and
//! bisection of what changes between them.
//!
//! Evenly spaced values come first, then values ever closer to where there is no mode problem, then values
//! inside every interval between two ends that has none yet, until no further mode turns up.

use super::found::{Elsewhere, Gap, ModesFound, SameEnds, cells_between};
use super::varied::Varied;
use crate::fault::{Fault, FaultKind, Faults};
use crate::modes::ContactState;
use crate::modes::existence::{
    EndCause, Existence, ExistenceOptions, Limit, ModeEnd, ModeInterval, ModeProblemLine, TooManyModes,
    counts_in,
};
use crate::progress::Work;
use crate::scan::{bisect, evenly, runs, samples};
use std::collections::BTreeMap;

/// Steps of the evenly spaced values.
const STEPS: usize = 500;
/// How often the distance to where there is no mode problem is halved.
const APPROACH: i32 = 40;
/// Where in an interval between two ends values are tried, as fractions of it.
const INSIDE: [f64; 3] = [0.5, 0.19, 0.83];
/// How often intervals without values are sought.
const ROUNDS: usize = 12;
/// The mode problem at a place, alone.
struct Tried {
    at: f64,
    /// The faults where the mechanism cannot be assembled, or cannot be solved for another reason.
    line: Result<ModeProblemLine, Faults>,
    present: Vec<Vec<ContactState>>,
}

/// Ends that are known: a pattern, the place where it exists and the one where it does not.
type Ends = BTreeMap<(Vec<ContactState>, u64, u64), ModeEnd>;

/// A scan over a range.
pub(super) struct Scanner<'v> {
    pub(super) varied: &'v Varied,
    pub(super) options: ExistenceOptions,
    pub(super) work: Work<'v>,
}

impl Scanner<'_> {
    /// The modes, from evenly spaced values, these, and those that follow from what is found.
    ///
    /// # Errors
    /// More patterns than the options allow.
    pub(super) fn scan(&self, further: &[f64]) -> Result<ModesFound, TooManyModes> {
        let mut places = Vec::new();
        self.add(&mut places, evenly(self.options.range, STEPS).chain(further.iter().copied()))?;
        let edges = self.edges(&places);
        self.add(&mut places, edges.into_iter())?;
        let mut ends = Ends::new();
        let mut modes = self.modes(&places, &mut ends);
        for _ in 0..ROUNDS {
            let missing = self.unexamined(&places, &modes);
            if missing.is_empty() {
                break;
            }
            self.add(&mut places, missing.into_iter())?;
            modes = self.modes(&places, &mut ends);
        }
        modes.retain(|mode| self.same_ends().are_two(mode.from.at, mode.to.at));
        let lines = places.iter().filter_map(|place| place.line.as_ref().ok());
        let open = lines.map(|line| line.open.clone()).next().unwrap_or_default();
        let existence = Existence { modes, open, ..Existence::default() };
        let gaps = gaps(&places);
        let mut cells = self.cells(&existence.modes, &gaps);
        cells.retain(|cell| Gap::none_covers(&gaps, *cell));
        let counts = counts_in(&existence, &cells, &|modes, at| {
            self.line(at).map_or(modes.len(), |line| line.distinct(modes, 0.0))
        });
        Ok(ModesFound {
            gaps,
            tried: places.iter().map(|place| place.at).collect(),
            ..ModesFound::new((existence, counts), Elsewhere::Sampled(0.0), self.same_ends())
        })
    }

    /// Adds places, in their order.
    fn add(
        &self,
        places: &mut Vec<Tried>,
        values: impl Iterator<Item = f64> + Clone,
    ) -> Result<(), TooManyModes> {
        for sample in samples(values, self.work.part(0, 2), |at, _| self.place(at)) {
            places.push(sample.found?);
        }
        places.sort_by(|one, other| one.at.total_cmp(&other.at));
        places.dedup_by(|next, kept| next.at == kept.at);
        Ok(())
    }

    fn place(&self, at: f64) -> Result<Tried, TooManyModes> {
        let line = self.varied.parts(at).map(|parts| parts.line_to(&parts));
        let goes_on = || !self.work.is_over();
        let present =
            line.as_ref().map_or(Ok(Vec::new()), |line| line.present(0.0, &self.options, &goes_on))?;
        Ok(Tried { at, line, present })
    }

    fn line(&self, at: f64) -> Option<ModeProblemLine> {
        if self.work.part(1, 2).is_over() {
            return None;
        }
        self.varied.parts(at).ok().map(|parts| parts.line_to(&parts))
    }

    /// Values on both sides of where the mode problem ceases to exist or has another fault, and ever closer
    /// to it.
    fn edges(&self, places: &[Tried]) -> Vec<f64> {
        let mut values = Vec::new();
        for pair in places.windows(2) {
            let (Err(faults), inside, outside) = (match (&pair[0].line, &pair[1].line) {
                (Ok(_), Err(_)) => (&pair[1].line, &pair[0], &pair[1]),
                (Err(_), _) => (&pair[0].line, &pair[1], &pair[0]),
                (Ok(_), Ok(_)) => continue,
            }) else {
                continue;
            };
            if is_same_fault(&inside.line, &outside.line) {
                continue;
            }
            let is_inside = |at: f64| match self.varied.parts(at) {
                _ if self.work.is_over() => false,
                Ok(_) => inside.line.is_ok(),
                Err(found) => inside.line.is_err() && kind(&found) != kind(faults),
            };
            let [near, beyond] = bisect(inside.at, outside.at, is_inside);
            values.extend([near, beyond]);
            if inside.line.is_ok() {
                values.extend((1..APPROACH).map(|power| near + (inside.at - near) * 0.5_f64.powi(power)));
            }
        }
        values
    }

    /// Places inside intervals between neighbouring ends in which there are none.
    fn unexamined(&self, places: &[Tried], modes: &[ModeInterval]) -> Vec<f64> {
        let is_empty = |[from, to]: &[f64; 2]| {
            let inside = places.iter().filter(|place| *from < place.at && place.at < *to);
            inside.count() < INSIDE.len()
        };
        let cells = self.cells(modes, &gaps(places)).into_iter().filter(is_empty);
        cells.flat_map(|[from, to]| INSIDE.map(|share| from + share * (to - from))).collect()
    }

    fn cells(&self, modes: &[ModeInterval], gaps: &[Gap]) -> Vec<[f64; 2]> {
        let same = self.same_ends();
        cells_between(modes, gaps, self.options.range, |next, kept| !same.are_two(kept, next))
    }

    fn same_ends(&self) -> SameEnds {
        SameEnds::bisected(self.options.range)
    }

    /// The intervals of all patterns that are present somewhere.
    fn modes(&self, places: &[Tried], ends: &mut Ends) -> Vec<ModeInterval> {
        let mut patterns: Vec<&Vec<ContactState>> = places.iter().flat_map(|place| &place.present).collect();
        patterns.sort_unstable();
        patterns.dedup();
        patterns.into_iter().flat_map(|pattern| self.intervals(pattern, places, ends)).collect()
    }

    /// The intervals of one pattern, from the places at which it is present.
    fn intervals(&self, pattern: &[ContactState], places: &[Tried], ends: &mut Ends) -> Vec<ModeInterval> {
        let present = |place: &Tried| place.present.iter().any(|other| other == pattern);
        let mut end = |inside: &Tried, outside: Option<&Tried>| {
            let Some(outside) = outside else { return self.range_end(pattern, inside.at) };
            let key = (pattern.to_vec(), inside.at.to_bits(), outside.at.to_bits());
            ends.entry(key).or_insert_with(|| self.end(pattern, inside.at, outside.at)).clone()
        };
        runs(places, |one, next| present(one) == present(next))
            .filter(|run| present(run.first()))
            .map(|run| ModeInterval {
                pattern: pattern.to_vec(),
                from: end(run.first(), run.before),
                to: end(run.last(), run.after),
            })
            .collect()
    }

    fn range_end(&self, pattern: &[ContactState], at: f64) -> ModeEnd {
        let force = self.line(at).and_then(|line| line.normal_force(pattern, 0.0));
        let normal_force = force.map(|force| force.iter().map(|&n| Limit::Finite(n)).collect());
        ModeEnd { at, cause: EndCause::Range, normal_force }
    }

    /// A mode that ends because there is no mode problem beyond: where a sliding velocity vanishes it has no
    /// direction of friction.
    fn lost(&self, at: f64, beyond: f64) -> ModeEnd {
        let reverses = |fault: &Fault| matches!(fault.kind, FaultKind::ZeroSlidingVelocity { .. });
        let cause = match self.varied.parts(beyond) {
            Err(faults) if faults.sorted().into_iter().all(reverses) => EndCause::Reversal,
            _ => EndCause::NoProblem,
        };
        ModeEnd { at, cause, normal_force: None }
    }

    /// Where a mode ends between a place where it exists and one where it does not.
    fn end(&self, pattern: &[ContactState], inside: f64, outside: f64) -> ModeEnd {
        let exists = |at: f64| self.line(at).is_some_and(|line| line.exists(pattern, 0.0, &self.options));
        let [near, beyond] = bisect(inside, outside, exists);
        let (Some(line), Some(next)) = (self.line(near), self.line(beyond)) else {
            return self.lost(near, beyond);
        };
        // Ends so close are one, and where the position is lost nothing else ends a mode.
        let [from, to] = self.options.range;
        let further = (near + self.same_ends().within.copysign(outside - inside)).clamp(from, to);
        if self.line(further).is_none() {
            return self.lost(near, further);
        }
        let cause = line.cause(&next, pattern, &self.options).unwrap_or(EndCause::Singular);
        // Rounding counts for the mode: what vanishes is followed without tolerance.
        let slack = |at: f64| self.line(at).and_then(|line| line.slack(pattern, &cause, &self.options));
        let at = match (slack(inside), slack(outside)) {
            (Some(one), Some(other)) if one * other < 0.0 => {
                bisect(inside, outside, |at| slack(at).is_some_and(|value| value * one > 0.0))[0]
            }
            _ => near,
        };
        let force = self.line(at).and_then(|line| line.normal_force(pattern, 0.0));
        let limit = |&n: &f64| {
            if cause == EndCause::Singular { Limit::Infinite(n.signum()) } else { Limit::Finite(n) }
        };
        let normal_force = force.map(|force| force.iter().map(limit).collect());
        ModeEnd { at, cause, normal_force }
    }
}

/// The kind of the first fault.
pub(super) fn kind(faults: &Faults) -> Option<std::mem::Discriminant<crate::fault::FaultKind>> {
    faults.sorted().first().map(|fault| std::mem::discriminant(&fault.kind))
}

fn is_same_fault<T>(one: &Result<T, Faults>, other: &Result<T, Faults>) -> bool {
    matches!((one, other), (Err(one), Err(other)) if kind(one) == kind(other))
}

/// The ranges without a mode problem, one for each reason, up to the last places where there is one. The
/// reason is that of a place in the middle.
fn gaps(places: &[Tried]) -> Vec<Gap> {
    let edge = |neighbour: Option<&Tried>, own: f64| match neighbour {
        Some(Tried { at, line: Ok(_), .. }) => *at,
        _ => own,
    };
    runs(places, |one, next| is_same_fault(&one.line, &next.line))
        .filter_map(|run| {
            let faults = run.middle().line.as_ref().err()?.clone();
            let (from, to) = (edge(run.before, run.first().at), edge(run.after, run.last().at));
            Some(Gap { from, to, faults })
        })
        .collect()
}
