//! Where modes exist if the numbers of the mode problem are affine in what is varied.
//!
//! Values that the model allows form one interval then, because all that it demands is affine, too. Ranges
//! that are wide against the scale on which the mode problem changes are cut into pieces, each with its own
//! line between mode problems that were made at its ends: on one line over all of it small values would drown
//! in the rounding of great ones.

use super::found::{Elsewhere, Gap, Method, ModesFound, SameEnds};
use super::varied::Varied;
use crate::expression::Degree;
use crate::modes::ContactState;
use crate::modes::existence::{
    CountInterval, EndCause, Existence, ExistenceOptions, ModeInterval, TooManyModes, counts,
};
use crate::progress::Work;
use crate::scan::{bisect, evenly};

/// Values at which it is tried whether the model allows them.
const TRIED: usize = 64;
/// How many times the scale of change, and how many times the piece before it, a piece is long.
const REACH: f64 = 1e3;
/// The most pieces on each side of zero: those of all floating-point numbers that can be computed with.
const PIECES: usize = 40;

/// The modes by zeros of determinants; none if the mode problem is not affine in what is varied, or the model
/// allows no value.
pub(super) fn closed_form(
    varied: &Varied,
    options: &ExistenceOptions,
    work: Work<'_>,
) -> Result<Option<ModesFound>, TooManyModes> {
    let dependence = varied.dependence();
    if dependence.problem.max(dependence.conditions) == Degree::Other {
        return Ok(None);
    }
    let Some([from, to]) = allowed(varied, options.range) else { return Ok(None) };
    let pieces = pieces(varied, [from, to]);
    let mut all = Existence::default();
    let mut numbers: Vec<CountInterval> = Vec::new();
    let mut changes = false;
    for (index, &piece) in pieces.iter().enumerate() {
        let ends = piece.map(|at| varied.parts(at));
        let [Ok(start), Ok(end)] = ends else { return Ok(None) };
        changes |= start != end;
        let line = start.line_to(&end);
        let work = work.part(index, pieces.len());
        let options = ExistenceOptions { range: [0.0, 1.0], ..*options };
        let found = line.existence_with(&options, &mut |progress| work.tell(progress))?;
        let mut found = found.unwrap_or_default();
        let mut intervals = counts(&line, &found, [0.0, 1.0]);
        stretch(&mut found, &mut intervals, piece);
        all.modes.extend(found.modes);
        all.singular_throughout.extend(found.singular_throughout);
        all.open = found.open;
        all.not_computed.extend(found.not_computed);
        append(&mut numbers, intervals);
    }
    let cause = |pattern: &[ContactState], at: f64| {
        let there = varied.parts(at).ok().map(|parts| parts.line_to(&parts));
        there.map_or(EndCause::Range, |line| line.cause_at(pattern, 0.0, options))
    };
    join(&mut all, [from, to], &cause);
    let method = if changes { Method::ClosedForm } else { Method::Same { at_rest: dependence.at_rest } };
    let same_ends = SameEnds::zeros(options.range, [from, to]);
    Ok(Some(ModesFound {
        gaps: outside(varied, options.range, [from, to]),
        method,
        tried: pieces.into_iter().flatten().collect(),
        ..ModesFound::new((all, numbers), Elsewhere::ClosedForm, same_ends)
    }))
}

/// The interval of values that the model allows within a range; none if it has no extent or was not found.
fn allowed(varied: &Varied, [from, to]: [f64; 2]) -> Option<[f64; 2]> {
    let is_allowed = |at: f64| varied.parts(at).is_ok();
    let present = varied.present().ok().filter(|value| (from..=to).contains(value));
    let inside = evenly([from, to], TRIED).chain(present).find(|&at| is_allowed(at))?;
    let end = |end: f64| if is_allowed(end) { end } else { bisect(inside, end, is_allowed)[0] };
    let ends = [end(from), end(to)];
    (ends[0] < ends[1]).then_some(ends)
}

/// The rest of the range, with the reason at its ends: next to what is allowed bisection may have stopped
/// early.
fn outside(varied: &Varied, [from, to]: [f64; 2], [first, last]: [f64; 2]) -> Vec<Gap> {
    let gap = |([from, to], end): ([f64; 2], f64)| {
        (from < to).then(|| Gap { from, to, faults: varied.parts(end).err().unwrap_or_default() })
    };
    [([from, first], from), ([last, to], to)].into_iter().filter_map(gap).collect()
}

/// The pieces of a range: from the value nearest to zero outwards, the first as long as the scale on which
/// the mode problem changes there allows.
fn pieces(varied: &Varied, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    if from < 0.0 && to > 0.0 {
        return [pieces(varied, [from, 0.0]), pieces(varied, [0.0, to])].concat();
    }
    let (anchor, far) = if from >= 0.0 { (from, to) } else { (to, from) };
    let scale = match [anchor, far].map(|at| varied.parts(at)) {
        [Ok(near), Ok(far)] => near.scale_of_change(&far),
        _ => None,
    };
    let Some(scale) = scale.filter(|scale| *scale > 0.0) else { return vec![[from, to]] };
    let shares = std::iter::successors(Some(REACH * scale), |share| Some(share * REACH));
    let inner = shares.take_while(|share| *share < 0.5).take(PIECES);
    let mut cuts: Vec<f64> =
        [anchor, far].into_iter().chain(inner.map(|share| anchor + share * (far - anchor))).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.dedup();
    cuts.windows(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// From the fraction of a piece to the value of what is varied.
fn stretch(existence: &mut Existence, counts: &mut [CountInterval], piece: [f64; 2]) {
    let value = |t: f64| value_at(piece, t);
    for mode in &mut existence.modes {
        mode.from.at = value(mode.from.at);
        mode.to.at = value(mode.to.at);
    }
    for interval in counts {
        interval.from = value(interval.from);
        interval.to = value(interval.to);
    }
}

/// The value at a fraction of a piece; both ends are exact.
pub(super) fn value_at([from, to]: [f64; 2], t: f64) -> f64 {
    if t == 1.0 { to } else { from + t * (to - from) }
}

fn append(all: &mut Vec<CountInterval>, more: Vec<CountInterval>) {
    for next in more {
        match all.last_mut() {
            Some(last) if last.is_like(&next) => last.to = next.to,
            _ => all.push(next),
        }
    }
}

/// Joins modes that go on in the next piece, and sorts them. One that ends exactly where a piece does, as
/// where all loads vanish, ends by what vanishes there; if nothing does it has not been understood.
fn join(existence: &mut Existence, [from, to]: [f64; 2], cause: &dyn Fn(&[ContactState], f64) -> EndCause) {
    existence
        .modes
        .sort_by(|one, other| one.pattern.cmp(&other.pattern).then(one.from.at.total_cmp(&other.from.at)));
    let mut joined: Vec<ModeInterval> = Vec::with_capacity(existence.modes.len());
    for mode in existence.modes.drain(..) {
        match joined.last_mut() {
            Some(last)
                if last.pattern == mode.pattern
                    && last.to.at == mode.from.at
                    && last.to.cause == EndCause::Range
                    && mode.from.cause == EndCause::Range =>
            {
                last.to = mode.to;
            }
            _ => joined.push(mode),
        }
    }
    for ModeInterval { pattern, from: first, to: last } in &mut joined {
        for end in [first, last] {
            if end.cause == EndCause::Range && end.at != from && end.at != to {
                end.cause = cause(pattern, end.at);
            }
        }
    }
    let is_cut = |end: &crate::modes::existence::ModeEnd| {
        end.cause == EndCause::Range && end.at != from && end.at != to
    };
    let (cut, whole): (Vec<_>, Vec<_>) =
        joined.into_iter().partition(|mode| is_cut(&mode.from) || is_cut(&mode.to));
    existence.modes = whole;
    existence.not_computed.extend(cut.into_iter().map(|mode| mode.pattern));
    for list in [&mut existence.singular_throughout, &mut existence.not_computed] {
        list.sort_unstable();
        list.dedup();
    }
}
