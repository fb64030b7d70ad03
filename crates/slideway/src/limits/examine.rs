//! What is proven of the numbers of solutions between the ends of modes: the certified search for whole intervals of what is
//! varied, which are halved while that helps.

use super::find::{Elsewhere, Found, Knowledge, Method};
use super::varied::Varied;
use crate::modes::SearchOptions;
use crate::modes::existence::{CountInterval, Existence, ExistenceOptions, cells};
use crate::solve::SolveOptions;
use std::collections::VecDeque;

/// Nothing is proven nearer than this to an end between two numbers of solutions, relative to the interval and to the end.
pub(super) const MARGIN: f64 = 1e-6;
/// Parts narrower than this share of the margin are not halved.
const NARROW: f64 = 0.25;
/// A search that visits more nodes than this counts as several.
const NODES: u64 = 64;
/// The most nodes of one search.
const GREATEST_NODES: u64 = 100_000;
/// A part whose ends differ by more than this factor is cut at their geometric mean.
const WIDE: f64 = 8.0;
/// Where in a part that stays open the number of solutions is asked for.
const CHECKED: [f64; 8] = [0.5, 0.05, 0.95, 0.27, 0.73, 0.003, 0.997, 0.61];

/// Proves numbers of solutions.
pub(super) struct Examiner<'v> {
    varied: &'v Varied,
    options: ExistenceOptions,
    solve: SolveOptions,
    /// Searches that may still be made.
    left: u64,
}

impl<'v> Examiner<'v> {
    pub(super) fn new(varied: &'v Varied, options: &ExistenceOptions, effort: u64) -> Self {
        let search = SearchOptions { nodes: GREATEST_NODES, ..SearchOptions::default() };
        let solve = SolveOptions { search, margins: false, ..SolveOptions::default() };
        Self { varied, options: *options, solve, left: effort }
    }

    /// Says of every interval of `found` how its number of solutions is known. Returns values at which another number is proven.
    pub(super) fn examine(&mut self, found: &mut Found) -> Vec<f64> {
        let mut contradicted = Vec::new();
        let intervals = found.counts.len() as u64;
        for (index, interval) in found.counts.iter().enumerate() {
            let share = self.left / (intervals - index as u64);
            let rest = self.left - share;
            self.left = share;
            let outcome = self.interval(interval, &found.existence);
            self.left += rest;
            contradicted.extend(outcome.contradicted);
            let elsewhere = match found.method {
                _ if outcome.contradicted.is_some() => Elsewhere::Contradicted,
                _ if outcome.is_whole => Elsewhere::Nothing,
                Method::Bracketing => Elsewhere::Sampled(spacing(&found.tried, [interval.from, interval.to])),
                Method::ClosedForm | Method::Same { .. } => Elsewhere::ClosedForm,
            };
            found.known[index] = Knowledge { proven: outcome.longest(), elsewhere };
        }
        contradicted
    }

    /// An interval, cell by cell between the ends of modes; what is next to these belongs to the cells on both sides.
    fn interval(&mut self, interval: &CountInterval, existence: &Existence) -> Outcome {
        let wanted = [interval.solutions, interval.gap_states];
        let whole = [interval.from, interval.to];
        let ends = existence.modes.iter().flat_map(|mode| [mode.from.at, mode.to.at]);
        let inside = ends.filter(|end| whole[0] < *end && *end < whole[1]);
        let near = |next: f64, kept: f64| next - kept <= MARGIN * margin(kept, whole);
        let cells = cells(inside.chain(whole), near);
        let mut outcome = Outcome { is_whole: true, ..Outcome::default() };
        for (index, &[from, to]) in cells.iter().enumerate() {
            let room = |end: f64| if self.options.range.contains(&end) { 0.0 } else { margin(end, [from, to]) };
            let part = [from + room(from), to - room(to)];
            let rest = self.left - self.left / (cells.len() - index) as u64;
            self.left -= rest;
            let mut of_cell = self.prove(part, [from, to], wanted);
            self.left += rest;
            if of_cell.contradicted.is_some() {
                return of_cell;
            }
            // Stretches on both sides of an end between modes are one, but for what is next to it.
            if let (Some(last), Some(first)) = (outcome.proven.last_mut(), of_cell.proven.first())
                && last[1] >= from - margin(from, whole)
                && first[0] <= part[0]
            {
                last[1] = first[1];
                of_cell.proven.remove(0);
            }
            outcome.proven.extend(of_cell.proven);
            outcome.is_whole &= of_cell.is_whole;
        }
        outcome
    }

    fn prove(&mut self, whole: [f64; 2], interval: [f64; 2], wanted: [usize; 2]) -> Outcome {
        let (mut proven, mut open) = (Vec::new(), Vec::new());
        let mut waiting = if self.is_within_reach(whole) { VecDeque::from([whole]) } else { VecDeque::new() };
        if waiting.is_empty() {
            open.push(whole);
        }
        while let Some(part) = waiting.pop_front() {
            match self.counts(part) {
                Some(counts) if counts == wanted => proven.push(part),
                Some(_) => return Outcome::contradiction(middle(part)),
                None => match halves(part, interval).filter(|_| self.left > 0) {
                    Some(halves) => waiting.extend(halves),
                    None => open.push(part),
                },
            }
        }
        // What stays open is asked for at some values.
        let checked: Vec<f64> = match &open[..] {
            [only] => CHECKED.map(|share| only[0] + share * (only[1] - only[0])).to_vec(),
            many => many.iter().step_by(many.len().div_ceil(CHECKED.len()).max(1)).map(|&part| middle(part)).collect(),
        };
        for at in checked {
            if self.counts([at, at]).is_some_and(|counts| counts != wanted) {
                return Outcome::contradiction(at);
            }
        }
        let is_whole = open.is_empty() && !proven.is_empty();
        Outcome { proven: joined(proven), is_whole, contradicted: None }
    }

    /// Whether parts as long as can be proven in the middle of a cell cover it with the searches that are left.
    fn is_within_reach(&mut self, [from, to]: [f64; 2]) -> bool {
        let at = middle([from, to]);
        let mut reach = (at - from).min(to - at);
        let mut parts = 1;
        while parts <= 2 * self.left {
            if self.counts([at - reach, at + reach]).is_some() {
                return true;
            }
            (reach, parts) = (0.25 * reach, 4 * parts);
        }
        false
    }

    /// The numbers of solutions and gap states that are proven for all values of a part.
    fn counts(&mut self, part: [f64; 2]) -> Option<[usize; 2]> {
        if self.left == 0 {
            return None;
        }
        let greatest = self.options.greatest_normal_force;
        let (counts, nodes) = self.varied.certain_counts(part, greatest, &self.solve);
        self.left = self.left.saturating_sub(1 + nodes / NODES);
        counts
    }
}

/// What was proven of an interval.
#[derive(Default)]
struct Outcome {
    /// Stretches, in their order.
    proven: Vec<[f64; 2]>,
    is_whole: bool,
    contradicted: Option<f64>,
}

impl Outcome {
    fn contradiction(at: f64) -> Self {
        Self { contradicted: Some(at), ..Self::default() }
    }

    fn longest(&self) -> Option<[f64; 2]> {
        self.proven.iter().copied().max_by(|one, other| (one[1] - one[0]).total_cmp(&(other[1] - other[0])))
    }
}

/// How near to an end of an interval nothing is proven.
fn margin(end: f64, [from, to]: [f64; 2]) -> f64 {
    let width = to - from;
    MARGIN * if end == 0.0 { width } else { width.min(end.abs()) }
}

fn middle([from, to]: [f64; 2]) -> f64 {
    if is_wide([from, to]) { (from * to).sqrt().copysign(from) } else { f64::midpoint(from, to) }
}

fn is_wide([from, to]: [f64; 2]) -> bool {
    let product = from * to;
    let ratio = if from > 0.0 { to / from } else { from / to };
    product > 0.0 && product.is_finite() && ratio > WIDE
}

/// Both halves of a part of an interval; none if it is as narrow as what is left out at its ends.
fn halves(part: [f64; 2], interval: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let least = NARROW * margin(part[0], interval).min(margin(part[1], interval));
    let cut = middle(part);
    let is_worth_it = part[1] - part[0] > least && part[0] < cut && cut < part[1];
    is_worth_it.then_some([[part[0], cut], [cut, part[1]]])
}

/// Parts that touch each other as one.
fn joined(mut parts: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    parts.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let mut joined: Vec<[f64; 2]> = Vec::new();
    for part in parts {
        match joined.last_mut() {
            Some(last) if last[1] == part[0] => last[1] = part[1],
            _ => joined.push(part),
        }
    }
    joined
}

/// The greatest distance between neighbouring values in an interval.
fn spacing(tried: &[f64], [from, to]: [f64; 2]) -> f64 {
    let inside = tried.iter().copied().filter(|value| from < *value && *value < to);
    let values: Vec<f64> = std::iter::once(from).chain(inside).chain([to]).collect();
    values.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}
