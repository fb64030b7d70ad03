//! Proofs of the numbers of solutions between the ends of modes: the certified search for whole intervals of
//! what is varied, which are halved while that helps.

use super::found::{Elsewhere, Knowledge, Method, ModesFound, cells_within};
use super::varied::Varied;
use crate::modes::SearchOptions;
use crate::modes::existence::{CountInterval, Existence, ExistenceOptions};
use crate::progress::{Progress, Work};
use crate::solve::SolveOptions;
use std::collections::VecDeque;

/// Nothing is proven nearer than this to an end of a mode, relative to the interval up to the next end and to
/// the end itself.
pub(super) const MARGIN: f64 = 1e-4;
/// Parts narrower than this share of the margin are not halved.
const NARROW: f64 = 0.25;
/// A search that visits more nodes than this counts as several.
const NODES: u64 = 64;
/// The most nodes of one search.
const GREATEST_NODES: u64 = 100_000;
/// A part whose ends differ by more than this factor is cut at their geometric mean.
const WIDE: f64 = 8.0;
/// Where in a cell it is tried how long a part can be proven: its middle may be singular, such as a dead centre.
const PLACES: [f64; 3] = [0.5, 0.21, 0.83];
/// Where in a part that stays open the number of solutions is asked for.
const CHECKED: [f64; 8] = [0.5, 0.05, 0.95, 0.27, 0.73, 0.003, 0.997, 0.61];

/// Proves numbers of solutions.
pub(super) struct Examiner<'v> {
    varied: &'v Varied,
    /// The friction circles of hinges with friction.
    circles: &'v [usize],
    options: ExistenceOptions,
    solve: SolveOptions,
    /// Searches that may be made, and those that still may.
    effort: u64,
    left: u64,
    work: Work<'v>,
}

/// Interval between neighbouring ends of modes, and what is proven of it.
struct Cell {
    /// The interval of equal numbers to which it belongs.
    interval: usize,
    wanted: [usize; 2],
    bounds: [f64; 2],
    /// Part that is to be proven: all but what is next to the ends of modes.
    part: [f64; 2],
    proven: Vec<[f64; 2]>,
    open: Vec<[f64; 2]>,
    contradicted: Option<f64>,
}

impl<'v> Examiner<'v> {
    pub(super) fn new(
        (varied, circles): (&'v Varied, &'v [usize]),
        options: &ExistenceOptions,
        effort: u64,
        work: Work<'v>,
    ) -> Self {
        let search = SearchOptions { nodes: GREATEST_NODES, ..SearchOptions::default() };
        let solve = SolveOptions { search, margins: false, ..SolveOptions::default() };
        Self { varied, circles, options: *options, solve, effort, left: effort, work }
    }

    /// Says of every interval of `found` how its number of solutions is known. Returns values at which
    /// another number is proven.
    pub(super) fn examine(&mut self, found: &mut ModesFound) -> Vec<f64> {
        let intervals = found.counts.iter().enumerate();
        let mut cells: Vec<Cell> =
            intervals.flat_map(|(index, interval)| self.cells(index, interval, &found.existence)).collect();
        // What is asked for where nothing could be proven.
        let reserved = self.left.min((cells.len() * CHECKED.len()) as u64);
        self.left -= reserved;
        self.prove(&mut cells);
        self.left += reserved;
        cells.iter_mut().for_each(|cell| self.check(cell));
        for (index, interval) in found.counts.iter().enumerate() {
            let own = || cells.iter().filter(|cell| cell.interval == index);
            let same_ends = found.same_ends;
            let told = |at: f64| same_ends.told(at);
            let proven = stretches(own(), told);
            let is_whole = proven == [[told(interval.from), told(interval.to)]];
            let was_open = found.known[index].elsewhere == Elsewhere::Contradicted;
            let elsewhere = if was_open || own().any(|cell| cell.contradicted.is_some()) {
                Elsewhere::Contradicted
            } else if is_whole || own().all(|cell| cell.open.is_empty()) {
                Elsewhere::Nothing
            } else if found.method == Method::Bracketing {
                Elsewhere::Sampled(spacing(&found.tried, [interval.from, interval.to]))
            } else {
                Elsewhere::ClosedForm
            };
            found.known[index] = Knowledge { proven, elsewhere };
        }
        cells.iter().filter_map(|cell| cell.contradicted).collect()
    }

    /// The cells of an interval between the ends of modes.
    fn cells(&self, index: usize, interval: &CountInterval, existence: &Existence) -> Vec<Cell> {
        let whole = [interval.from, interval.to];
        let near = |next: f64, kept: f64| next - kept <= MARGIN * margin(kept, whole);
        let cell = |bounds: [f64; 2]| {
            let room = |end: f64| if self.options.range.contains(&end) { 0.0 } else { margin(end, bounds) };
            Cell {
                interval: index,
                wanted: [interval.solutions, interval.gap_states],
                bounds,
                part: [bounds[0] + room(bounds[0]), bounds[1] - room(bounds[1])],
                proven: Vec::new(),
                open: Vec::new(),
                contradicted: None,
            }
        };
        cells_within(&existence.modes, whole, near).into_iter().map(cell).collect()
    }

    /// Searches the cells, then halves of what is left open, and so on.
    fn prove(&mut self, cells: &mut [Cell]) {
        let mut waiting = VecDeque::new();
        for (index, cell) in cells.iter_mut().enumerate() {
            if self.is_within_reach(cell.part) {
                waiting.push_back((index, cell.part));
            } else {
                cell.open.push(cell.part);
            }
        }
        while let Some((index, part)) = waiting.pop_front() {
            let cell = &mut cells[index];
            if cell.contradicted.is_some() {
                continue;
            }
            match self.counts(part) {
                Some(counts) if counts == cell.wanted => cell.proven.push(part),
                Some(_) => cell.contradicted = Some(middle(part)),
                None => match halves(part, cell.bounds).filter(|_| self.left > 0) {
                    Some(halves) => waiting.extend(halves.map(|half| (index, half))),
                    None => cell.open.push(part),
                },
            }
        }
    }

    /// Whether parts as long as can be proven somewhere in a cell cover it with the searches that are left.
    fn is_within_reach(&mut self, [from, to]: [f64; 2]) -> bool {
        let (mut reach, mut parts) = (0.5 * (to - from), 1);
        while parts <= 2 * self.left {
            let tried = if parts == 1 { &PLACES[..1] } else { &PLACES[..] };
            let part = |place: &f64| {
                let at = if parts == 1 { middle([from, to]) } else { from + place * (to - from) };
                [(at - reach).max(from), (at + reach).min(to)]
            };
            if tried.iter().any(|place| self.counts(part(place)).is_some()) {
                return true;
            }
            (reach, parts) = (0.25 * reach, 4 * parts);
        }
        false
    }

    /// Asks at some values of what stays open.
    fn check(&mut self, cell: &mut Cell) {
        let values: Vec<f64> = match &cell.open[..] {
            [only] => CHECKED.map(|share| only[0] + share * (only[1] - only[0])).to_vec(),
            many => {
                let step = many.len().div_ceil(CHECKED.len()).max(1);
                many.iter().step_by(step).map(|&part| middle(part)).collect()
            }
        };
        let differs = |at: &f64| self.counts([*at, *at]).is_some_and(|counts| counts != cell.wanted);
        cell.contradicted = cell.contradicted.or(values.into_iter().find(differs));
    }

    /// The numbers of solutions and gap states that are proven for all values of a part.
    fn counts(&mut self, part: [f64; 2]) -> Option<[usize; 2]> {
        let done = self.effort - self.left;
        if self.left == 0 || self.work.tell(&Progress::of("searches", done, self.effort)).is_break() {
            self.left = 0;
            return None;
        }
        let greatest = self.options.greatest_normal_force;
        let part = (part, self.circles);
        let (counts, nodes) = self.varied.certain_counts(part, greatest, &self.solve, self.work);
        self.left = self.left.saturating_sub(1 + nodes / NODES);
        counts
    }
}

/// Joins the proven parts of some cells to stretches, in ascending order and with ends as `told` reports
/// them. Parts that touch are one; between ends that are reported as one there is no gap.
fn stretches<'c>(cells: impl Iterator<Item = &'c Cell>, told: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let mut parts: Vec<[f64; 2]> =
        cells.flat_map(|cell| cell.proven.iter().map(|part| part.map(&told))).collect();
    parts.sort_by(|one, other| one[0].total_cmp(&other[0]));
    let mut stretches: Vec<[f64; 2]> = Vec::new();
    for part in parts {
        match stretches.last_mut() {
            Some(last) if last[1] >= part[0] => last[1] = last[1].max(part[1]),
            _ => stretches.push(part),
        }
    }
    stretches
}

/// Returns the greatest width that is left out at an end of an interval.
pub(super) fn margin_of([from, to]: [f64; 2]) -> f64 {
    margin(from, [from, to]).max(margin(to, [from, to]))
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

/// The greatest distance between neighbouring values in an interval.
fn spacing(tried: &[f64], [from, to]: [f64; 2]) -> f64 {
    let inside = tried.iter().copied().filter(|value| from < *value && *value < to);
    let values: Vec<f64> = std::iter::once(from).chain(inside).chain([to]).collect();
    values.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
}
