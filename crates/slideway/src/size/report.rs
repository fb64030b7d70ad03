//! What is told of a design: plain data, which are the JSON output.

use super::margin::{Margin, MarginQuestion};
use super::search::{End, MetCause, SizesFound, Tried};
use super::words::{self, Words};
use super::{Against, SizeOptions};
use crate::limits::{SameEnds, VariedQuantity};
use crate::model::{Effort, Model};
use crate::report::{CoordinateState, Tipping};
use crate::units::{Unit, Units};
use serde::Serialize;

/// Version of the layout of a [`SizeReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/size/1";

/// Rows of the table of margins, evenly spaced.
const ROWS: usize = 10;

/// Which margin is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MarginKind {
    /// The factor by which kinetic friction may grow before there is no solution.
    Locking,
    /// The factor by which static friction may grow before a load is held however great it is.
    SelfLocking,
    /// The factor by which static friction may be smaller while a load is held however great it is.
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

    /// What there is where nothing can be told.
    pub(super) fn nothing(self) -> &'static str {
        match self {
            Self::Efficiency => "no solution, or friction takes all",
            _ => "no solution",
        }
    }

    /// What a margin of the search stands for, which is how many times a limit is kept.
    pub(super) fn told(self, margin: Margin, limit: f64) -> (SampleKind, Option<f64>) {
        match (self, margin) {
            (kind, Margin::Infinite) if kind.is_greatest() => (SampleKind::Finite, Some(0.0)),
            (kind, Margin::Finite(0.0)) if kind.is_limit() => (SampleKind::NoSolution, None),
            (kind, Margin::Finite(kept)) if kind.is_greatest() => (SampleKind::Finite, Some(limit / kept)),
            (Self::Efficiency, Margin::Finite(kept)) => (SampleKind::Finite, Some(limit * kept)),
            (_, Margin::Finite(factor)) => (SampleKind::Finite, Some(factor)),
            (_, Margin::Infinite) => (SampleKind::Infinite, None),
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
    /// What is varied.
    pub vary: VariedQuantity,
    /// The coordinates for which it holds, but for one that is varied; at rest their rates are taken as zero.
    pub state: Vec<CoordinateState>,
    /// The units in which texts show them.
    #[serde(skip)]
    pub units: Units,
    /// Which margin is meant.
    pub against: MarginKind,
    /// The load, drive or contact that it concerns; absent against locking, and where it concerns all.
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
    /// What tips in the model, if there is no solution for that reason; absent otherwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tipping: Option<Tipping>,
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
    /// What the search can miss, in words.
    pub guarantee: String,
    /// Two steps of what was tried: narrower ranges could be missed (unit of what is varied).
    pub narrowest: f64,
    /// What it comes to, in words.
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
    /// The same at the end.
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

/// What a sample says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SampleKind {
    /// The margin is a number.
    Finite,
    /// No friction reaches the limit.
    Infinite,
    /// There is no solution, of which an effort, normal force, bearing pressure or efficiency could be told, or none has
    /// any efficiency: friction takes all that the load would give.
    NoSolution,
    /// There are infinitely many solutions, in which an effort, normal force or bearing pressure is without bound, or an
    /// efficiency as small as can be.
    WithoutBound,
    /// The mechanism cannot be assembled or solved there, or a guided slider is between its faces.
    NoPosition,
}

/// The margin at a value.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Sample {
    /// The value.
    pub at: f64,
    /// What is known there.
    pub is: SampleKind,
    /// The margin; null unless it is a number.
    pub margin: Option<f64>,
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

/// What was sought, and what was found.
pub(super) struct Sought<'q> {
    pub(super) question: MarginQuestion<'q>,
    pub(super) range: [f64; 2],
    pub(super) steps: usize,
    pub(super) value: f64,
    /// The margin in the model.
    pub(super) present: Option<Margin>,
    /// What tips in the model, if there is no solution for that reason.
    pub(super) tipping: Option<Tipping>,
    pub(super) found: SizesFound,
}

pub(super) fn report(
    model: &Model,
    state: Vec<CoordinateState>,
    options: &SizeOptions,
    sought: &Sought<'_>,
) -> SizeReport {
    let Sought { question, range, steps, value, present, tipping, found } = sought;
    let (against, load) = match &options.against {
        Against::Locking => (MarginKind::Locking, None),
        Against::SelfLocking { load } => (MarginKind::SelfLocking, Some(load.clone())),
        Against::Hold { load } => (MarginKind::Hold, Some(load.clone())),
        Against::Effort { drive } => (MarginKind::Effort, drive.clone()),
        Against::NormalForce { contact } => (MarginKind::NormalForce, contact.clone()),
        Against::Pressure { contact } => (MarginKind::Pressure, contact.clone()),
        Against::Efficiency => (MarginKind::Efficiency, None),
    };
    let unit = unit(model, &options.against);
    let told: Told<'_> = &|margin| against.told(margin, options.margin);
    let vary = VariedQuantity::new(question.varied, *range, *value);
    let same_ends = SameEnds::bisected(*range);
    let mut report = SizeReport {
        schema: SCHEMA,
        title: model.title.clone(),
        vary,
        state,
        units: model.units.clone(),
        against,
        load,
        margin: options.margin,
        unit,
        limit_shown_in: match &options.typed_in {
            Some(typed) => model.units.typed_as(typed.clone()),
            None if unit.is_empty() => Unit::default(),
            None => model.units.of(unit),
        },
        both_directions: options.both_directions,
        present: sample(&Tried { at: *value, margin: *present }, told),
        tipping: tipping.clone(),
        met: found.met.iter().map(|ends| interval(ends, same_ends, told)).collect(),
        without_position: found.gaps.iter().map(|one| gap(one, same_ends)).collect(),
        samples: samples(found, (*steps, options.margin), told),
        tried: found.places.iter().map(|place| sample(place, told)).collect(),
        guarantee: words::guarantee(*range, *steps, against, &question.varied.shown_in),
        narrowest: 2.0 * (range[1] - range[0]) / *steps as f64,
        conclusion: Vec::new(),
    };
    let driven = !model.drives.is_empty();
    report.conclusion = Words { report: &report, places: &found.places, driven }.conclusion();
    report
}

/// The unit of what has a limit: of efforts that of the drive, or of all drives if they have one.
pub(super) fn unit(model: &Model, against: &Against) -> &'static str {
    let of_drive = |drive: &crate::model::Drive| match drive.effort {
        Effort::Force { .. } => "N",
        Effort::Torque { .. } => "N m",
    };
    match against {
        Against::Effort { drive } => {
            let is_meant =
                |other: &&crate::model::Drive| drive.as_ref().is_none_or(|name| **name == *other.name);
            let mut units = model.drives.iter().filter(is_meant).map(of_drive);
            let first = units.next().unwrap_or_default();
            if units.all(|unit| unit == first) { first } else { "" }
        }
        Against::NormalForce { .. } => "N",
        Against::Pressure { .. } => "Pa",
        _ => "",
    }
}

/// What a margin of the search stands for.
type Told<'t> = &'t dyn Fn(Margin) -> (SampleKind, Option<f64>);

fn interval([from, to]: &[End; 2], same_ends: SameEnds, told: Told<'_>) -> MetInterval {
    let jumps_to = |end: &End| match end.cause {
        MetCause::Jump(margin) => told(margin).1,
        _ => None,
    };
    let place = |end: &End| if end.cause == MetCause::NoPosition { same_ends.told(end.at) } else { end.at };
    MetInterval {
        from: place(from),
        to: place(to),
        from_is: cause(from),
        to_is: cause(to),
        from_jumps_to: jumps_to(from),
        to_jumps_to: jumps_to(to),
    }
}

fn cause(end: &End) -> MetEnd {
    match end.cause {
        MetCause::Range => MetEnd::Range,
        MetCause::Margin => MetEnd::Margin,
        MetCause::Jump(_) => MetEnd::Jump,
        MetCause::NoPosition => MetEnd::NoPosition,
    }
}

fn gap(gap: &super::search::SizeGap, same_ends: SameEnds) -> RangeWithoutPosition {
    let reason = gap.faults.sorted().first().map_or_else(String::new, |fault| fault.kind.to_string());
    RangeWithoutPosition { from: same_ends.told(gap.from), to: same_ends.told(gap.to), reason }
}

fn sample(place: &Tried, told: Told<'_>) -> Sample {
    let (is, margin) = place.margin.map_or((SampleKind::NoPosition, None), told);
    Sample { at: place.at, is, margin }
}

/// Every so many of the values that were tried, and those at which the wanted margin is just met.
fn samples(found: &SizesFound, (steps, wanted): (usize, f64), told: Told<'_>) -> Vec<Sample> {
    let [first, last] = [found.places.first(), found.places.last()].map(|place| place.map_or(0.0, |p| p.at));
    let step = (last - first) / steps as f64;
    let is_row = |place: &&Tried| {
        let index = (place.at - first) / step;
        let row = (index / (steps / ROWS) as f64).round() * (steps / ROWS) as f64;
        (index - row).abs() < 1e-6
    };
    let mut samples: Vec<Sample> =
        found.places.iter().filter(is_row).map(|place| sample(place, told)).collect();
    let exact = found.met.iter().flatten().filter(|end| end.cause == MetCause::Margin);
    samples.extend(exact.map(|end| Sample { at: end.at, is: SampleKind::Finite, margin: Some(wanted) }));
    samples.sort_by(|one, other| one.at.total_cmp(&other.at));
    samples.dedup_by(|next, kept| next.at == kept.at);
    samples
}
