//! Exact ends of modes between the points of a sweep over one quantity.

use super::axis::Axis;
use super::rows::Breakpoint;
use crate::limits::{LimitsOptions, ModeLimits, Vary, limits_with};
use crate::model::Model;
use crate::progress::Callback;
use crate::report::ModeEndCause;
use serde::{Deserialize, Serialize};

/// Ends that are nearer to each other than this part of the range are one.
const SAME: f64 = 1e-12;
/// Part of the range by which a fold is entered: both solutions, which differ by its square root, exist there
/// and are distinguished.
const INSIDE: f64 = 1e-10;

/// A point at which a mode begins or ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Inserted {
    /// Its number among all points.
    pub(super) number: u64,
    pub(super) at: f64,
    pub(super) breakpoint: Breakpoint,
    /// Whether it is no point of the sweep itself.
    pub(super) own: bool,
}

/// The exact ends of modes that a sweep inserts between the points of its axis, or why there are none: what a
/// sweep has to find before its first point. Whoever has it need not look for it again
/// ([`super::Sweep::with_breakpoints`]).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Breakpoints {
    /// In ascending order.
    inserted: Vec<Inserted>,
    without: Option<String>,
}

impl Breakpoints {
    /// Why no ends were inserted though they were asked for.
    pub(super) fn without(&self) -> Option<&str> {
        self.without.as_deref()
    }

    /// How many are no points of the sweep itself.
    pub(super) fn own(&self) -> u64 {
        self.inserted.iter().filter(|breakpoint| breakpoint.own).count() as u64
    }

    /// The one that is the point of this number, and how many points before it are inserted ones.
    pub(super) fn at(&self, number: u64) -> (Option<&Inserted>, u64) {
        let before = self.inserted.partition_point(|breakpoint| breakpoint.number < number);
        let exact = self.inserted.get(before).filter(|breakpoint| breakpoint.number == number);
        let own = self.inserted[..before].iter().filter(|breakpoint| breakpoint.own).count() as u64;
        (exact, own)
    }
}

/// The ends of modes on an axis; nothing if the callback breaks.
pub(super) fn between(model: &Model, axis: &Axis, callback: &mut Callback<'_>) -> Option<Breakpoints> {
    // Listed values are those that are wanted.
    let Some([from, to]) = axis.values.range() else { return Some(Breakpoints::default()) };
    let options = LimitsOptions::new(Vary::between(&axis.quantity.name, from, to)).effort(0);
    let report = match limits_with(model, &options, callback) {
        Ok(report) => report?,
        Err(faults) => {
            return Some(Breakpoints { inserted: Vec::new(), without: Some(faults.to_string()) });
        }
    };
    let mut ends: Vec<(f64, Breakpoint)> =
        report.modes.iter().flat_map(|mode| ends(mode, INSIDE * (to - from))).collect();
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
    Some(Breakpoints { inserted, without: None })
}

/// Both ends of a mode, unless they are those of the range; of a fold the place so far inside.
fn ends(mode: &ModeLimits, inside: f64) -> impl Iterator<Item = (f64, Breakpoint)> {
    let cause = |cause: ModeEndCause| match cause {
        ModeEndCause::Locking => Some(Breakpoint::Locking),
        ModeEndCause::WithoutBound => Some(Breakpoint::WithoutBound),
        ModeEndCause::SideChange | ModeEndCause::LiftsOff | ModeEndCause::Touches => {
            Some(Breakpoint::SideChange)
        }
        ModeEndCause::GapCloses => Some(Breakpoint::GapCloses),
        ModeEndCause::Tipping => Some(Breakpoint::Tipping),
        ModeEndCause::Fold => Some(Breakpoint::Fold),
        ModeEndCause::HingeUnloaded => Some(Breakpoint::HingeUnloaded),
        ModeEndCause::Reversal | ModeEndCause::NoModeProblem => Some(Breakpoint::NotSolved),
        _ => None,
    };
    let ends = [(mode.from, cause(mode.from_is), inside), (mode.to, cause(mode.to_is), -inside)];
    ends.into_iter().filter_map(|(at, breakpoint, inwards)| {
        let breakpoint = breakpoint?;
        Some((at? + if breakpoint == Breakpoint::Fold { inwards } else { 0.0 }, breakpoint))
    })
}
