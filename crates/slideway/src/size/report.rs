//! What is told of a design: plain data, which are the JSON output.

use super::margin::{Margin, MarginQuestion};
use super::search::{End, MetCause, SizesFound, Tried};
use super::words::{self, Words};
use super::{Against, SizeOptions};
use crate::limits::VariedQuantity;
use crate::model::Model;
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
    /// Which margin is meant.
    pub against: MarginKind,
    /// The load that it concerns; absent against locking.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub load: Option<String>,
    /// The wanted margin.
    pub margin: f64,
    /// Whether the smaller margin of both directions of motion counts.
    pub both_directions: bool,
    /// The margin in the model.
    pub present: Sample,
    /// The intervals in which the wanted margin is met, in ascending order.
    pub met: Vec<MetInterval>,
    /// Ranges in which the mechanism cannot be assembled or solved, or a guided slider is between its faces,
    /// which is no locking.
    pub without_position: Vec<RangeWithoutPosition>,
    /// The margin at evenly spaced values, and where the wanted one is just met.
    pub samples: Vec<Sample>,
    /// What the search can miss, in words.
    pub guarantee: String,
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
    /// The mechanism cannot be assembled or solved beyond.
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
    pub(super) found: SizesFound,
}

pub(super) fn report(model: &Model, options: &SizeOptions, sought: &Sought<'_>) -> SizeReport {
    let Sought { question, range, steps, value, present, found } = sought;
    let (against, load) = match &options.against {
        Against::Locking => (MarginKind::Locking, None),
        Against::SelfLocking { load } => (MarginKind::SelfLocking, Some(load.clone())),
        Against::Hold { load } => (MarginKind::Hold, Some(load.clone())),
    };
    let vary = VariedQuantity::new(question.varied, *range, *value);
    let mut report = SizeReport {
        schema: SCHEMA,
        title: model.title.clone(),
        vary,
        against,
        load,
        margin: options.margin,
        both_directions: options.both_directions,
        present: sample(&Tried { at: *value, margin: *present }),
        met: found.met.iter().map(interval).collect(),
        without_position: found.gaps.iter().map(gap).collect(),
        samples: samples(found, *steps, options.margin),
        guarantee: words::guarantee(*range, *steps, &question.varied.shown_in),
        conclusion: Vec::new(),
    };
    report.conclusion = Words { report: &report, places: &found.places }.conclusion();
    report
}

fn interval([from, to]: &[End; 2]) -> MetInterval {
    let jumps_to = |end: &End| match end.cause {
        MetCause::Jump(margin) => margin.factor(),
        _ => None,
    };
    MetInterval {
        from: from.at,
        to: to.at,
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

fn gap(gap: &super::search::SizeGap) -> RangeWithoutPosition {
    let reason = gap.faults.sorted().first().map_or_else(String::new, |fault| fault.kind.to_string());
    RangeWithoutPosition { from: gap.from, to: gap.to, reason }
}

fn sample(place: &Tried) -> Sample {
    let (is, margin) = match place.margin {
        Some(Margin::Finite(factor)) => (SampleKind::Finite, Some(factor)),
        Some(Margin::Infinite) => (SampleKind::Infinite, None),
        None => (SampleKind::NoPosition, None),
    };
    Sample { at: place.at, is, margin }
}

/// Every so many of the values that were tried, and those at which the wanted margin is just met.
fn samples(found: &SizesFound, steps: usize, wanted: f64) -> Vec<Sample> {
    let [first, last] = [found.places.first(), found.places.last()].map(|place| place.map_or(0.0, |p| p.at));
    let step = (last - first) / steps as f64;
    let is_row = |place: &&Tried| {
        let index = (place.at - first) / step;
        let row = (index / (steps / ROWS) as f64).round() * (steps / ROWS) as f64;
        (index - row).abs() < 1e-6
    };
    let mut samples: Vec<Sample> = found.places.iter().filter(is_row).map(sample).collect();
    let exact = found.met.iter().flatten().filter(|end| end.cause == MetCause::Margin);
    samples.extend(exact.map(|end| Sample { at: end.at, is: SampleKind::Finite, margin: Some(wanted) }));
    samples.sort_by(|one, other| one.at.total_cmp(&other.at));
    samples.dedup_by(|next, kept| next.at == kept.at);
    samples
}
