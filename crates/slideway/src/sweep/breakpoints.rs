//! Exact ends of modes between the points of a sweep over one quantity.

use super::axis::Axis;
use super::rows::Breakpoint;
use crate::limits::{LimitsOptions, ModeLimits, Vary, limits_with};
use crate::model::Model;
use crate::progress::Callback;
use crate::report::ModeEndCause;

/// Ends that are nearer to each other than this part of the range are one.
const SAME: f64 = 1e-12;

/// A point at which a mode begins or ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inserted {
    /// Its number among all points.
    pub(super) number: u64,
    pub(super) at: f64,
    pub(super) breakpoint: Breakpoint,
    /// Whether it is no point of the sweep itself.
    pub(super) own: bool,
}

/// The ends of modes on an axis in their order, or why there are none; nothing if the callback breaks.
pub(super) fn between(
    model: &Model,
    axis: &Axis,
    callback: &mut Callback<'_>,
) -> Option<(Vec<Inserted>, Option<String>)> {
    // Listed values are those that are wanted.
    let Some([from, to]) = axis.values.range() else { return Some((Vec::new(), None)) };
    let options = LimitsOptions::new(Vary::between(&axis.quantity.name, from, to)).effort(0);
    let report = match limits_with(model, &options, callback) {
        Ok(report) => report?,
        Err(faults) => return Some((Vec::new(), Some(faults.to_string()))),
    };
    let mut ends: Vec<(f64, Breakpoint)> = report.modes.iter().flat_map(ends).collect();
    ends.sort_by(|one, other| one.0.total_cmp(&other.0));
    ends.dedup_by(|next, kept| next.0 - kept.0 <= SAME * (to - from));
    let mut inserted: Vec<Inserted> = Vec::with_capacity(ends.len());
    for (at, breakpoint) in ends.into_iter().filter(|(at, _)| from < *at && *at < to) {
        // The first point that is not below.
        let (mut low, mut high) = (0, axis.values.len());
        while low < high {
            let middle = low + (high - low) / 2;
            if axis.values.at(middle) < at { low = middle + 1 } else { high = middle }
        }
        let before = inserted.iter().filter(|other| other.own).count() as u64;
        let own = axis.values.at(low) != at;
        inserted.push(Inserted { number: low + before, at, breakpoint, own });
    }
    Some((inserted, None))
}

/// Both ends of a mode, unless they are those of the range.
fn ends(mode: &ModeLimits) -> impl Iterator<Item = (f64, Breakpoint)> {
    let cause = |cause: ModeEndCause| match cause {
        ModeEndCause::Locking => Some(Breakpoint::Locking),
        ModeEndCause::SideChange => Some(Breakpoint::SideChange),
        ModeEndCause::GapCloses => Some(Breakpoint::GapCloses),
        ModeEndCause::Tipping => Some(Breakpoint::Tipping),
        ModeEndCause::Reversal | ModeEndCause::NoModeProblem => Some(Breakpoint::NotSolved),
        _ => None,
    };
    let ends = [(mode.from, cause(mode.from_is)), (mode.to, cause(mode.to_is))];
    ends.into_iter().filter_map(|(at, breakpoint)| Some((at?, breakpoint?)))
}
