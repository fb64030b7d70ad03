//! For which values of a parameter, coordinate or factor of friction a mechanism can stay at rest.
//!
//! [`standstill`](crate::standstill) decides at evenly spaced values, and what changes between two of them is
//! bisected.

use super::answer::held_state;
use super::found::SameEnds;
use super::report::{REST_SCHEMA, RestLimitsReport, STEPS, SpanOfRest, VariedQuantity};
use super::scan::kind;
use super::vary::Vary;
use crate::fault::Faults;
use crate::mechanism::Mechanism;
use crate::model::Model;
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;
use crate::scan::{Sample, Scan, Stretch, evenly, samples};
use crate::standstill::{CoordinateValue, HoldOptions, Rests, rests};

/// The answer at a value: whether it can rest, or why there is no answer.
type Found = Result<Rests, Faults>;

/// The stretches of a range in which a mechanism can stay at rest, and those in which it cannot.
///
/// # Errors
/// As [`hold`](crate::standstill::hold); an unknown name, an empty or reversed range, none at all.
///
/// ```
/// use slideway::limits::{Vary, rest_limits};
/// use slideway::model::Model;
/// use slideway::standstill::HoldOptions;
///
/// let bracket = Model::parse(slideway::gallery::find("bracket-on-pole").expect("in the gallery").text)?;
/// let vary = Vary::between("x", "0.1 m", "0.5 m");
/// let report = rest_limits(&bracket, &vary, &HoldOptions::default())?;
/// // The bracket holds from x = B / (2 mu_static) = 304.8 mm on.
/// let [slips, holds] = report.spans.as_slice() else { panic!("two stretches") };
/// assert_eq!((slips.holds, holds.holds), (Some(false), Some(true)));
/// assert!((holds.from - 0.3048).abs() < 1e-8);
/// # Ok::<(), slideway::fault::Faults>(())
/// ```
pub fn rest_limits(model: &Model, vary: &Vary, options: &HoldOptions) -> Result<RestLimitsReport, Faults> {
    undisturbed(|work| rest_limits_of(model, vary, options, work))
}

/// [`rest_limits`] with a callback that is called now and then; nothing if it breaks.
///
/// # Errors
/// As [`rest_limits`].
pub fn rest_limits_with(
    model: &Model,
    vary: &Vary,
    options: &HoldOptions,
    callback: &mut Callback<'_>,
) -> Result<Option<RestLimitsReport>, Faults> {
    watched(callback, |work| rest_limits_of(model, vary, options, work))
}

fn rest_limits_of(
    model: &Model,
    vary: &Vary,
    options: &HoldOptions,
    work: Work<'_>,
) -> Result<RestLimitsReport, Faults> {
    let varied = vary.at_rest(model)?;
    let range = vary.ends(&varied, || Err(varied.range_needed()))?;
    let found = |at: f64| -> Found { rests(&varied.model_at(at)?, options, work) };
    let same_ends = SameEnds::bisected(range);
    let tried = samples(evenly(range, STEPS), work, |at, _| found(at));
    let spans = spans(&tried, &found, &same_ends);
    if spans.iter().all(|span| span.reason.is_some()) {
        // Nowhere an answer: the faults in the middle say why.
        found(f64::midpoint(range[0], range[1]))?;
    }
    finite(RestLimitsReport {
        schema: REST_SCHEMA,
        title: model.title.clone(),
        vary: VariedQuantity::new(&varied, range, varied.present().unwrap_or_default()),
        state: held_state(&Mechanism::new(model)?, &varied, range)
            .into_iter()
            .map(CoordinateValue::from)
            .collect(),
        units: model.units.clone(),
        load: options.load.clone(),
        guarantee: format!(
            "Decided at values {} apart; where the answer changes between two of them it was bisected; ends closer than {} to an end of the range or to zero are placed there. Narrower stretches may be missed.",
            varied.shown_in.precise((range[1] - range[0]) / STEPS as f64),
            varied.shown_in.with(&format!("{:.1e}", varied.shown_in.number_of(same_ends.within)))
        ),
        spans,
    })
}

/// Part of a value within which neither a linear program nor a list of states decides whether something rests: ten times their
/// tolerance.
pub(super) const LEFT_OPEN: f64 = 1e-8;

/// The range cut where the answer changes.
fn spans(tried: &[Sample<Found>], answer: &dyn Fn(f64) -> Found, same_ends: &SameEnds) -> Vec<SpanOfRest> {
    let scan = Scan { answer, is_like: is_same, narrowest: same_ends.within };
    let span = |Stretch { from, to, found, .. }: Stretch<Found>| {
        let (Rests { holds, may_slip }, reason) = match found {
            Ok(rests) => (rests, None),
            Err(faults) => (Rests::default(), faults.sorted().first().map(|fault| fault.kind.to_string())),
        };
        SpanOfRest { from: same_ends.told(from), to: same_ends.told(to), holds, may_slip, reason }
    };
    let mut spans: Vec<SpanOfRest> = Vec::new();
    for span in scan.adjoining(tried).into_iter().map(span) {
        match spans.last_mut() {
            // Where both begin at one value, it holds up to it or from it on.
            Some(last) if is_rounding(last) => *last = SpanOfRest { from: last.from, ..span },
            Some(last) if is_rounding(&span) => last.to = span.to,
            _ => spans.push(span),
        }
    }
    spans
}

/// Whether a stretch that holds only while wedged is no wider than what linear programs leave open.
fn is_rounding(span: &SpanOfRest) -> bool {
    span.may_slip && span.to - span.from <= LEFT_OPEN * span.from.abs().max(span.to.abs())
}

/// True if two values have the same answer, or none for the same kind of reason.
fn is_same(one: &Found, other: &Found) -> bool {
    match (one, other) {
        (Ok(one), Ok(other)) => one == other,
        (Err(one), Err(other)) => kind(one) == kind(other),
        _ => false,
    }
}
