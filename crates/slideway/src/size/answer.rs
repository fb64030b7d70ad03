//! The report of a design, from what was found.

use super::margin::{Margin, MarginQuestion};
use super::report::{
    MarginKind, MetEnd, MetInterval, RangeWithoutPosition, SCHEMA, Sample, SampleKind, SizeReport,
};
use super::search::{End, MetCause, SizeGap, SizesFound, Tried};
use super::words::{self, Words};
use super::{Against, SizeOptions};
use crate::limits::{SameEnds, VariedQuantity};
use crate::model::{Drive, Effort, Model};
use crate::report::{CoordinateState, Tipping};
use crate::units::Unit;

/// Rows of the table of margins, evenly spaced.
const ROWS: usize = 10;

/// The search and what it found.
pub(super) struct Sought<'q> {
    pub(super) question: MarginQuestion<'q>,
    pub(super) range: [f64; 2],
    pub(super) steps: usize,
    pub(super) value: f64,
    /// The margin in the model.
    pub(super) present: Option<Margin>,
    /// The joints that tip in the model, if there is no solution for that reason.
    pub(super) tipping: Option<Tipping>,
    /// The joints that tip as the friction of the model grows to the margin, or as it is.
    pub(super) tips: Vec<String>,
    /// The coefficient of friction of all contacts, if they have one.
    pub(super) mu: Option<f64>,
    /// Whether anything may tip.
    pub(super) may_tip: bool,
    /// The margin in the model while something has wedged it.
    pub(super) wedged: Option<f64>,
    /// Whether to be let down gently is all that takes.
    pub(super) gently: bool,
    pub(super) found: SizesFound,
}

pub(super) fn report(
    model: &Model,
    state: Vec<CoordinateState>,
    options: &SizeOptions,
    sought: &Sought<'_>,
) -> SizeReport {
    let Sought { question, range, steps, value, present, tipping, tips, mu, may_tip, wedged, gently, found } =
        sought;
    let (against, load) = match &options.against {
        Against::Locking => (MarginKind::Locking, None),
        Against::SelfLocking { load } => (MarginKind::SelfLocking, Some(load.clone())),
        Against::Hold { load } => (MarginKind::Hold, load.clone()),
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
        tips: tips.clone(),
        mu: *mu,
        may_tip: *may_tip,
        wedged: *wedged,
        gently: *gently,
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
    let of_drive = |drive: &Drive| match drive.effort {
        Effort::Force { .. } => "N",
        Effort::Torque { .. } => "N m",
    };
    match against {
        Against::Effort { drive } => {
            let is_meant = |other: &&Drive| drive.as_ref().is_none_or(|name| **name == *other.name);
            let mut units = model.drives.iter().filter(is_meant).map(of_drive);
            let first = units.next().unwrap_or_default();
            if units.all(|unit| unit == first) { first } else { "" }
        }
        Against::NormalForce { .. } => "N",
        Against::Pressure { .. } => "Pa",
        _ => "",
    }
}

/// The meaning of a margin of the search.
type Told<'t> = &'t dyn Fn(Margin) -> (SampleKind, Option<f64>);

fn interval([from, to]: &[End; 2], same_ends: SameEnds, told: Told<'_>) -> MetInterval {
    let jumps_to = |end: &End| match end.cause {
        MetCause::Jump(margin) => told(margin).1,
        _ => None,
    };
    MetInterval {
        from: same_ends.told(from.at),
        to: same_ends.told(to.at),
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

fn gap(gap: &SizeGap, same_ends: SameEnds) -> RangeWithoutPosition {
    let reason = gap.faults.sorted().first().map_or_else(String::new, |fault| fault.kind.of_range());
    RangeWithoutPosition { from: same_ends.told(gap.from), to: same_ends.told(gap.to), reason }
}

fn sample(place: &Tried, told: Told<'_>) -> Sample {
    let (is, margin) = place.margin.map_or((SampleKind::NoPosition, None), told);
    let least_friction = match place.margin {
        Some(Margin::Needs(factor)) => Some(factor),
        _ => None,
    };
    Sample { at: place.at, is, margin, least_friction }
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
    samples.extend(exact.map(|end| Sample {
        at: end.at,
        is: SampleKind::Finite,
        margin: Some(wanted),
        least_friction: None,
    }));
    samples.sort_by(|one, other| one.at.total_cmp(&other.at));
    samples.dedup_by(|next, kept| next.at == kept.at);
    samples
}
