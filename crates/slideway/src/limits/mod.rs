//! Limits: for which values of a parameter each contact mode exists, and what ends it.
//!
//! ```
//! use slideway::limits::{LimitsOptions, limits};
//! use slideway::model::{Model, Settings};
//!
//! let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
//! let settings = Settings::default().parameter("F_20", "0").parameter("direction", "-1");
//! let model = Model::parse(text)?.with(&settings)?;
//! let report = limits(&model, &LimitsOptions::of("mu_1=0..0.8"))?;
//! // Klepp (2002), section 7: moving to the left it jams from mu_1 = 0.4526 on.
//! let last = report.modes.last().expect("two modes");
//! assert_eq!(last.to_is, "locking");
//! assert!((last.to.unwrap_or_default() - 0.452_653_96).abs() < 1e-8);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```

mod conclusion;
mod curves;
mod report;
mod scan;
mod text;
mod varied;

pub use curves::{Curve, CurvePoint, Curves, Quantity, Series, curves_with, limits_with_curves};
pub(crate) use report::Naming;
pub(crate) use report::guarantee;
pub use report::{
    CountLimits, Direction, EndReaction, LimitsReport, ModeLimits, SCHEMA, VariedQuantity, to_json,
};
pub(crate) use scan::bisect;
pub use text::to_text;
pub use varied::{FRICTION, ShownIn};
pub(crate) use varied::{Varied, mechanism_with};

use crate::fault::{Fault, FaultKind, Faults};
use crate::model::{Model, Settings};
use crate::modes::existence::{CountInterval, Existence, ExistenceOptions, TooManyModes, counts};
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;
use crate::solve::{Parts, Stages};
use scan::{STEPS, Scanner};

/// The most patterns whose limits are computed.
const PATTERNS: u64 = 1 << 14;
/// Without a range the factor of all coefficients of friction is varied from 0 to this.
const USUAL_FACTOR: f64 = 10.0;
/// Without a range a coefficient of friction is varied from 0 to twice its value, but at least to this.
const USUAL_FRICTION: f64 = 1.0;
/// Places at which it is seen whether the mode problem depends linearly on what is varied.
const PROBES: [f64; 3] = [0.271_828, 0.577_216, 0.834_627];

/// What to find the limits of.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitsOptions {
    /// "NAME" or "NAME=FROM..TO": a parameter, a coordinate, or [`FRICTION`].
    pub vary: String,
    /// Modes count only where no normal force exceeds this (N).
    pub max_reaction: Option<f64>,
    /// Whether motion in the opposite direction is looked at, too.
    pub both_directions: bool,
}

impl LimitsOptions {
    /// The limits of what is named, in the direction of the model, whatever the reactions.
    pub fn of(vary: &str) -> Self {
        Self { vary: vary.to_owned(), max_reaction: None, both_directions: false }
    }
}

/// The modes of one direction of motion.
pub(crate) struct Found {
    pub(crate) existence: Existence,
    counts: Vec<CountInterval>,
    pub(crate) gaps: Vec<[f64; 2]>,
    is_linear: bool,
}

/// The exact intervals in which each mode exists, what ends it, and the number of solutions in between.
///
/// Where the mode problem depends linearly on what is varied (coefficients of friction, preloads, loads) the ends are
/// zeros of determinants, and nothing is scanned (theory, section 6; [`crate::modes::existence`]). Otherwise evenly
/// spaced points are tried and what changes between them is bisected to machine precision; the report says what such
/// a search can miss.
///
/// # Errors
/// Whatever `solve` refuses; an unknown name, an empty or reversed range, or one on which nothing depends.
pub fn limits(model: &Model, options: &LimitsOptions) -> Result<LimitsReport, Faults> {
    undisturbed(|work| limits_of(model, options, work))
}

/// [`limits`] with a callback that is called now and then; nothing if it breaks.
///
/// # Errors
/// As [`limits`].
pub fn limits_with(
    model: &Model,
    options: &LimitsOptions,
    callback: &mut Callback<'_>,
) -> Result<Option<LimitsReport>, Faults> {
    watched(callback, |work| limits_of(model, options, work))
}

fn limits_of(model: &Model, options: &LimitsOptions, work: Work<'_>) -> Result<LimitsReport, Faults> {
    let analysis = Analysis::new(model, options, work)?;
    finite(analysis.report(&Naming::new(model)?))
}

/// What is varied, over which range, and the modes of both directions.
struct Analysis {
    varied: Varied,
    range: [f64; 2],
    shown_in: ShownIn,
    found: Found,
    reversed: Option<(Varied, Found)>,
}

impl Analysis {
    fn new(model: &Model, options: &LimitsOptions, work: Work<'_>) -> Result<Self, Faults> {
        let (name, range) = match options.vary.split_once('=') {
            Some((name, range)) => (name.trim(), Some(range)),
            None => (options.vary.trim(), None),
        };
        let varied = Varied::new(model, name)?;
        let shown_in = varied.shown_in(range.unwrap_or_default());
        let range = match range {
            Some(text) => given_range(&varied, text)?,
            None => usual_range(model, &varied)?,
        };
        let directions = 1 + usize::from(options.both_directions);
        let found = find(&varied, range, options, work.part(0, directions))?;
        let reversed = if options.both_directions {
            let varied = Varied::new(&backwards(model)?, name)?;
            let found = find(&varied, range, options, work.part(1, directions))?;
            Some((varied, found))
        } else {
            None
        };
        Ok(Self { varied, range, shown_in, found, reversed })
    }

    fn report(&self, naming: &Naming) -> LimitsReport {
        let reversed = self.reversed.as_ref().map(|(_, found)| found);
        report::report(naming, &self.varied, self.range, (&self.found, reversed))
    }
}

/// The range that is written as FROM..TO.
///
/// # Errors
/// A text that is no range, or a range that is reversed or empty.
pub(crate) fn given_range(varied: &Varied, text: &str) -> Result<[f64; 2], Faults> {
    let what = varied.in_words();
    let Some((from, to)) = text.split_once("..") else {
        return Err(fault(FaultKind::MalformedRange { text: text.to_owned(), name: varied.name.clone() }));
    };
    let (from, to) = (varied.value_of(from)?, varied.value_of(to)?);
    if from > to {
        return Err(fault(FaultKind::ReversedRange { what, from, to }));
    }
    if from == to {
        return Err(fault(FaultKind::EmptyRange { what, from }));
    }
    Ok([from, to])
}

/// The range of a coefficient of friction, or of their factor; whatever else is varied needs one.
fn usual_range(model: &Model, varied: &Varied) -> Result<[f64; 2], Faults> {
    if varied.is_friction_factor() {
        Ok([0.0, USUAL_FACTOR])
    } else if model.is_friction_coefficient(&varied.name) {
        Ok([0.0, (2.0 * varied.present()?).max(USUAL_FRICTION)])
    } else {
        Err(fault(FaultKind::RangeNeeded { what: varied.in_words(), name: varied.name.clone() }))
    }
}

/// The model with all rates reversed.
///
/// # Errors
/// A model that cannot be assembled in its state.
pub(crate) fn backwards(model: &Model) -> Result<Model, Faults> {
    let stages = Stages::new(model)?;
    let rates = stages.mechanism.coordinates.iter().zip(&stages.configuration.rates);
    let settings = rates.fold(Settings::default(), |settings, (coordinate, rate)| {
        settings.rate(&coordinate.name, &format!("{:e}", -rate))
    });
    model.with(&settings)
}

/// Where modes exist in a range.
///
/// # Errors
/// Too many modes; a fault if nothing varies.
pub(crate) fn find(
    varied: &Varied,
    range: [f64; 2],
    options: &LimitsOptions,
    work: Work<'_>,
) -> Result<Found, Faults> {
    let existence_options = ExistenceOptions {
        range: [0.0, 1.0],
        greatest_normal_force: options.max_reaction,
        patterns: PATTERNS,
    };
    let found = if let Some([start, end]) = linear(varied, range)? {
        let line = start.line_to(&end);
        line.existence_with(&existence_options, &mut |progress| work.tell(progress)).map(|existence| {
            let mut existence = existence.unwrap_or_default();
            let mut counts = counts(&line, &existence, [0.0, 1.0]);
            stretch(&mut existence, &mut counts, range);
            Found { existence, counts, gaps: Vec::new(), is_linear: true }
        })
    } else {
        let scanner = Scanner { varied, options: ExistenceOptions { range, ..existence_options }, work };
        scanner.scan().map(|scan| Found {
            existence: scan.existence,
            counts: scan.counts,
            gaps: scan.gaps,
            is_linear: false,
        })
    };
    found.map_err(|TooManyModes { contacts, limit, .. }| fault(FaultKind::TooManyModes { contacts, limit }))
}

/// The mode problems at both ends of the range, if all in between lie on their line.
///
/// # Errors
/// A fault if nothing varies between them.
pub(crate) fn linear(varied: &Varied, range: [f64; 2]) -> Result<Option<[Parts; 2]>, Faults> {
    let at = |t: f64| varied.parts(range[0] + t * (range[1] - range[0]));
    let (Ok(start), Ok(end)) = (at(0.0), at(1.0)) else { return Ok(None) };
    let mut is_linear = true;
    let mut varies = !start.is_same(&end);
    for t in PROBES {
        let Ok(probe) = at(t) else { return Ok(None) };
        is_linear &= probe.is_between(&start, &end, t);
        varies |= !probe.is_same(&start);
    }
    if !varies {
        let kind = FaultKind::NothingVaries { what: varied.in_words(), from: range[0], to: range[1] };
        return Err(fault(kind));
    }
    Ok(is_linear.then_some([start, end]))
}

/// From the fraction of the range to the value of what is varied.
fn stretch(existence: &mut Existence, counts: &mut [CountInterval], [from, to]: [f64; 2]) {
    // Both ends of the range stay exact.
    let value = |t: f64| if t == 1.0 { to } else { from + t * (to - from) };
    for mode in &mut existence.modes {
        mode.from.at = value(mode.from.at);
        mode.to.at = value(mode.to.at);
    }
    for interval in counts {
        interval.from = value(interval.from);
        interval.to = value(interval.to);
    }
}

fn fault(kind: FaultKind) -> Faults {
    Fault::general(kind).into()
}
