//! Report on a design: plain data, which are the JSON output.

use super::margin::Margin;
use crate::limits::VariedQuantity;
use crate::report::{CoordinateState, Tipping};
use crate::units::{Unit, Units};
use serde::Serialize;

/// Version of the layout of a [`SizeReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/size/1";

/// Which margin is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MarginKind {
    /// The factor by which kinetic friction may grow before there is no solution, or something tips; none where less friction does
    /// that.
    Locking,
    /// The factor by which static friction may grow before a load is held however great it is.
    SelfLocking,
    /// The factor by which static friction may be smaller while all loads are held as they are, or one however great it is.
    Hold,
    /// Not a factor but the greatest effort of a drive, or of all (N or N m).
    Effort,
    /// Not a factor but the greatest normal force of a contact, or of all (N).
    NormalForce,
    /// Not a factor but the greatest bearing pressure of a contact, or of all that have a pad (Pa).
    Pressure,
    /// Not a factor but the least efficiency.
    Efficiency,
}

impl MarginKind {
    /// Whether it is a limit of a force or of the efficiency rather than a factor of friction.
    pub(super) fn is_limit(self) -> bool {
        self.is_greatest() || self == Self::Efficiency
    }

    /// Whether what is limited must not be greater, rather than less.
    pub(super) fn is_greatest(self) -> bool {
        matches!(self, Self::Effort | Self::NormalForce | Self::Pressure)
    }

    /// Returns the words for [`SampleKind::NoSolution`].
    pub(super) fn nothing(self) -> &'static str {
        match self {
            Self::Efficiency => "no solution, or friction takes all",
            _ => "no solution",
        }
    }

    /// Converts a margin of the search, which is how many times a limit is kept, into the number that is
    /// reported.
    pub(super) fn told(self, margin: Margin, limit: f64) -> (SampleKind, Option<f64>) {
        match (self, margin) {
            (kind, Margin::Infinite) if kind.is_greatest() => (SampleKind::Finite, Some(0.0)),
            (kind, Margin::Finite(0.0)) if kind.is_limit() => (SampleKind::NoSolution, None),
            (kind, Margin::Finite(kept)) if kind.is_greatest() => (SampleKind::Finite, Some(limit / kept)),
            (Self::Efficiency, Margin::Finite(kept)) => (SampleKind::Finite, Some(limit * kept)),
            (_, Margin::Finite(factor)) => (SampleKind::Finite, Some(factor)),
            (_, Margin::Infinite) => (SampleKind::Infinite, None),
            (_, Margin::Needs(_)) => (SampleKind::NeedsFriction, None),
            (_, Margin::Unbounded) => (SampleKind::WithoutBound, None),
        }
    }
}

/// For which values a wanted margin is met.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SizeReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// The title of the model.
    pub title: Option<String>,
    /// Varied quantity, with its range.
    pub vary: VariedQuantity,
    /// The coordinates for which it holds, but for one that is varied; at rest their rates are taken as zero.
    pub state: Vec<CoordinateState>,
    /// The units in which texts show them.
    #[serde(skip)]
    pub units: Units,
    /// Which margin is meant.
    pub against: MarginKind,
    /// The load, drive or contact that it concerns; absent against locking, and where it concerns all of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load: Option<String>,
    /// The wanted margin; against an effort, normal force, bearing pressure or efficiency the limit that it
    /// has to keep.
    pub margin: f64,
    /// SI unit of the limit, empty for a pure number.
    pub unit: &'static str,
    /// The unit in which texts show it.
    #[serde(skip)]
    pub limit_shown_in: Unit,
    /// Whether the smaller margin of both directions of motion counts.
    pub both_directions: bool,
    /// The margin in the model.
    pub present: Sample,
    /// Guided sliders that tip in the model, if there is no solution for that reason; absent otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tipping: Option<Tipping>,
    /// Against locking: what tips in the model at its margin, or as it is, or with less friction; absent if nothing does.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub tips: Vec<String>,
    /// The coefficient of friction of all contacts in the model, if they have one.
    #[serde(skip)]
    pub(super) mu: Option<f64>,
    /// Whether anything may tip.
    #[serde(skip)]
    pub(super) may_tip: bool,
    /// The margin of holding in the model while something has wedged it, if that is greater than the one by itself, which is
    /// wanted; absent otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wedged: Option<f64>,
    /// Whether to be let down gently is all that takes: nothing presses the guides only while it slides.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub gently: bool,
    /// The intervals in which the wanted margin is met, in ascending order.
    pub met: Vec<MetInterval>,
    /// Ranges in which the mechanism cannot be assembled or solved, the model does not allow the values, or a
    /// guided slider is between its faces, which is no locking.
    pub without_position: Vec<RangeWithoutPosition>,
    /// The margin at evenly spaced values, and where the wanted one is just met.
    pub samples: Vec<Sample>,
    /// The margin at all values that were tried, in ascending order; for plots, not in the JSON output.
    #[serde(skip)]
    pub tried: Vec<Sample>,
    /// Account, in words, of what the search can miss.
    pub guarantee: String,
    /// Two steps of what was tried: narrower ranges could be missed (unit of what is varied).
    pub narrowest: f64,
    /// Sentences that sum up the answer.
    pub conclusion: Vec<String>,
}

/// An interval in which the wanted margin is met.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct MetInterval {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Why it begins there.
    pub from_is: MetEnd,
    /// Why it ends there.
    pub to_is: MetEnd,
    /// The margin outside of the beginning where it jumps; null where it is infinite, or does not jump.
    pub from_jumps_to: Option<f64>,
    /// The margin outside of the end where it jumps, likewise.
    pub to_jumps_to: Option<f64>,
}

/// Why an interval ends in which the wanted margin is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum MetEnd {
    /// The range ends.
    Range,
    /// The margin is just met.
    Margin,
    /// The margin jumps.
    Jump,
    /// The mechanism cannot be assembled or solved beyond, or the model does not allow the values there:
    /// [`SizeReport::without_position`] says why.
    NoPosition,
}

/// Kind of sample: whether its margin is a number, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SampleKind {
    /// The margin is a number.
    Finite,
    /// No friction reaches the limit.
    Infinite,
    /// There is no solution with an effort, normal force, bearing pressure or efficiency, or none has any
    /// efficiency: friction takes all that the load would give.
    NoSolution,
    /// There are infinitely many solutions, in which an effort, normal force or bearing pressure is without bound, or an
    /// efficiency as small as can be.
    WithoutBound,
    /// With less friction than this it tips or jams: [`Sample::least_friction`]. No factor makes that safe.
    NeedsFriction,
    /// The mechanism cannot be assembled or solved there, or a guided slider is between its faces.
    NoPosition,
}

/// The margin at a value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Sample {
    /// The value.
    pub at: f64,
    /// Whether the margin is a number there, and if not, why.
    pub is: SampleKind,
    /// The margin; null unless it is a number.
    pub margin: Option<f64>,
    /// Where it needs friction: as a factor of its own, the friction below which it tips or jams; absent elsewhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least_friction: Option<f64>,
}

/// A range without an answer: the mechanism cannot be assembled or solved, or a guided slider is between its
/// faces.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RangeWithoutPosition {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Why, at its first value that was tried.
    pub reason: String,
}
