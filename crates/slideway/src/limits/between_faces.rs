//! States with a guided slider between its faces over a range: no normal force, no couple.
//!
//! They are on the boundary of sign patterns throughout, so that neither zeros of determinants nor proofs
//! over intervals tell them. They are those of `solve` at evenly spaced values of what is not proven
//! otherwise, and what changes between these is bisected. Those at single values, where a normal force passes
//! through zero, are those of `solve` at its zeros, which are known where modes end at zeros of determinants:
//! a mode that tips ends there, too, if tipping is not judged.

use super::closed_form::value_at;
use super::examine::margin_of;
use super::found::{Elsewhere, Knowledge, Method, ModesFound, PATTERNS, SingleValues};
use super::varied::Varied;
use crate::modes::existence::{CountInterval, EndCause, ExistenceOptions, ModeEnd, is_same_end};
use crate::progress::Work;
use crate::scan::{Sample, Scan};

/// Values that are tried in each part of an interval that is not proven: a heuristic.
const VALUES: usize = 32;

/// A stretch with so many of these states throughout.
struct Stretch {
    bounds: [f64; 2],
    states: usize,
}

/// Adds these states to the numbers of preload-gap states, and cuts intervals where they begin and end.
pub(super) fn add(varied: &Varied, greatest: Option<f64>, found: &mut ModesFound, work: Work<'_>) {
    if !varied.model().has_guided_sliders() {
        return;
    }
    let is_open = found.known.iter().any(|known| known.elsewhere != Elsewhere::Nothing);
    let has_free = |count: &CountInterval| {
        let parts = varied.parts(f64::midpoint(count.from, count.to));
        parts.is_ok_and(|parts| !parts.with_free_faces().is_empty())
    };
    if !found.counts.iter().any(has_free) {
        return;
    }
    let zeros = if is_open { zeros(varied, found, work) } else { None };
    let candidates = zeros.as_deref().unwrap_or_default();
    let mut counts = Vec::new();
    let mut all_known = Vec::new();
    for (interval, known) in found.counts.iter().zip(&found.known) {
        let whole = [interval.from, interval.to];
        let parts = open(whole, known);
        let states = |at: f64| varied.states_between_faces(at, 1.0, greatest, work).len();
        let stretches: Vec<Stretch> =
            parts.iter().flat_map(|&part| stretches(part, candidates, &states)).collect();
        if parts.is_empty() {
            counts.push(*interval);
            all_known.push(known.clone());
            continue;
        }
        // Zeros of determinants do not tell these states: what they are not found at may be between the
        // values.
        let spacing = parts.iter().map(|[from, to]| (to - from) / VALUES as f64).fold(0.0, f64::max);
        let elsewhere = match known.elsewhere {
            Elsewhere::Contradicted => Elsewhere::Contradicted,
            Elsewhere::Sampled(by) => Elsewhere::Sampled(by.max(spacing)),
            _ => Elsewhere::Sampled(spacing),
        };
        for (piece, states) in pieces(whole, &stretches) {
            counts.push(CountInterval {
                from: piece[0],
                to: piece[1],
                gap_states: interval.gap_states + states,
                ..*interval
            });
            let proven =
                known.proven.iter().copied().filter(|[from, to]| piece[0] <= *from && *to <= piece[1]);
            all_known.push(Knowledge { proven: proven.collect(), elsewhere });
        }
    }
    found.counts = counts;
    found.known = all_known;
    if is_open {
        found.between_faces = single_values(varied, greatest, zeros, found, work);
    }
}

/// The states at single values, outside of intervals that have others; they are among the zeros of normal
/// forces, if these are known.
fn single_values(
    varied: &Varied,
    greatest: Option<f64>,
    zeros: Option<Vec<f64>>,
    found: &ModesFound,
    work: Work<'_>,
) -> SingleValues {
    let Some(mut values) = zeros else { return SingleValues::LeftOut };
    let has_states = |at: f64| {
        let mut around = found.counts.iter().filter(|count| (count.from..=count.to).contains(&at));
        around.all(|count| count.gap_states == 0)
            && !varied.states_between_faces(at, 1.0, greatest, work).is_empty()
    };
    values.retain(|&at| has_states(at));
    SingleValues::At(values)
}

/// Where the normal forces of contacts with free faces vanish or may vanish in a mode, whether or not a
/// guided slider tips in it; none if the modes of the range are not known from zeros of determinants.
fn zeros(varied: &Varied, found: &ModesFound, work: Work<'_>) -> Option<Vec<f64>> {
    if found.method == Method::Bracketing {
        return None;
    }
    let mut zeros = Vec::new();
    for piece in found.tried.chunks_exact(2) {
        let [start, end] = [varied.parts(piece[0]).ok()?, varied.parts(piece[1]).ok()?];
        let free = [start.with_free_faces(), end.with_free_faces()].concat();
        let mut line = start.line_to(&end);
        line.bounds.clear();
        let options = ExistenceOptions { range: [0.0, 1.0], greatest_normal_force: None, patterns: PATTERNS };
        let existence = line.existence_with(&options, &mut |progress| work.tell(progress)).ok().flatten()?;
        if !existence.not_computed.is_empty() {
            return None;
        }
        let vanishes = |end: &&ModeEnd| match &end.cause {
            EndCause::SideChange(contacts) => contacts.iter().any(|contact| free.contains(contact)),
            _ => false,
        };
        let ends = existence.modes.iter().flat_map(|mode| [&mode.from, &mode.to]);
        // At its own ends a piece does not tell what vanishes.
        let mut shares: Vec<f64> = ends.filter(vanishes).map(|end| end.at).chain([0.0, 1.0]).collect();
        shares.sort_by(f64::total_cmp);
        shares.dedup_by(|next, kept| is_same_end(*next, *kept));
        zeros.extend(shares.into_iter().map(|share| value_at([piece[0], piece[1]], share)));
    }
    zeros.dedup();
    Some(zeros)
}

/// The parts of an interval that are not proven, without those that are as narrow as what is left out next to
/// ends.
fn open([from, to]: [f64; 2], known: &Knowledge) -> Vec<[f64; 2]> {
    let ends: Vec<f64> =
        std::iter::once(from).chain(known.proven.iter().flatten().copied()).chain([to]).collect();
    let parts = ends.chunks_exact(2).map(|pair| [pair[0], pair[1]]);
    parts.filter(|part| part[1] - part[0] > margin_of([from, to])).collect()
}

/// Where there are such states in a part: at evenly spaced values, at candidates, and between them.
fn stretches(part: [f64; 2], candidates: &[f64], states: &dyn Fn(f64) -> usize) -> Vec<Stretch> {
    let [from, to] = part;
    let value = |index: usize| from + (to - from) * (index as f64 + 0.5) / VALUES as f64;
    let candidates = candidates.iter().copied().filter(|at| from < *at && *at < to);
    let mut values: Vec<f64> = (0..VALUES).map(value).chain(candidates).collect();
    values.sort_by(f64::total_cmp);
    let tried: Vec<Sample<usize>> = values.into_iter().map(|at| Sample { at, found: states(at) }).collect();
    let scan = Scan { answer: states, is_like: usize::eq, narrowest: margin_of(part) };
    let mut all = scan.adjoining(&tried);
    // They reach the ends of the part.
    all.first_mut().into_iter().for_each(|first| first.from = from);
    all.last_mut().into_iter().for_each(|last| last.to = to);
    all.retain(|stretch| stretch.found > 0 && stretch.to - stretch.from > scan.narrowest);
    all.into_iter().map(|one| Stretch { bounds: [one.from, one.to], states: one.found }).collect()
}

/// An interval cut at the ends of stretches, with the number of states in each piece.
fn pieces([from, to]: [f64; 2], stretches: &[Stretch]) -> Vec<([f64; 2], usize)> {
    let mut pieces = Vec::new();
    let mut begin = from;
    for stretch in stretches {
        pieces.push(([begin, stretch.bounds[0]], 0));
        pieces.push((stretch.bounds, stretch.states));
        begin = stretch.bounds[1];
    }
    pieces.push(([begin, to], 0));
    pieces.retain(|([from, to], _)| from < to);
    pieces
}
