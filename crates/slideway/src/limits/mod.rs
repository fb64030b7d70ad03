//! Limits: for which values of a parameter each contact mode exists, and what ends it.
//!
//! ```
//! use slideway::limits::{LimitsOptions, Vary, limits};
//! use slideway::model::{Model, Settings};
//! use slideway::report::ModeEndCause;
//!
//! let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
//! let settings = Settings::default().parameter("F_20", "0").parameter("direction", "-1");
//! let model = Model::parse(text)?.with(&settings)?;
//! let report = limits(&model, &LimitsOptions::new(Vary::between("mu_1", 0.0, 0.8)))?;
//! // Klepp (2002), section 7: moving to the left it jams from mu_1 = 0.4526 on.
//! let last = report.modes.last().expect("two modes");
//! assert_eq!(last.to_is, ModeEndCause::Locking);
//! assert!((last.to.unwrap_or_default() - 0.452_653_96).abs() < 1e-8);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Files
//! `limits` varies a parameter: `vary.rs` is what is asked for, `varied.rs` is what is varied (with a `Follower` for the positions from value
//! to value), `solve::Parts` the mode problem at one value, with the couples of guided sliders.
//! `model/dependence.rs` decides from the formulas whether that is affine in it; `closed_form.rs` has
//! `modes::existence` find the ends then, `scan.rs` finds them elsewhere. `examine.rs` asks the certified
//! search for the numbers of solutions over whole intervals, and `find.rs` scans anew where these contradict;
//! `between_faces.rs` counts the states of guided sliders between their faces, which
//! `solve::states_between_faces` finds at single values (for `map`, `drive` and `size`, too); `guarantee.rs`
//! and `conclusion.rs` put it into words. `limits/curves.rs` samples quantities along the modes that were
//! found, for plots.

mod between_faces;
mod closed_form;
mod conclusion;
mod curves;
mod examine;
mod find;
mod guarantee;
mod report;
mod scan;
mod text;
mod varied;
mod vary;

pub use curves::{Curve, CurvePoint, Curves, Quantity, Series, curves_with, limits_with_curves};
pub(crate) use find::{Found, find};
pub(crate) use guarantee::guarantee;
pub(crate) use report::Naming;
pub use report::{
    CountLimits, Direction, EndReaction, Known, LimitsMethod, LimitsReport, ModeLimits, RangeWithoutProblem,
    SCHEMA, VariedQuantity,
};
pub(crate) use scan::bisect;
pub(crate) use text::no_answer;
pub use varied::{FRICTION, ShownIn};
pub(crate) use varied::{Varied, mechanism_with};
pub use vary::Vary;

use crate::fault::{Fault, FaultKind, Faults};
use crate::model::Model;
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;

/// Certified searches that are made by default to prove numbers of solutions.
pub const EFFORT: u64 = 800;
/// Without a range the factor of all coefficients of friction is varied from 0 to this.
const USUAL_FACTOR: f64 = 10.0;
/// Without a range a coefficient of friction is varied from 0 to twice its value, but at least to this.
const USUAL_FRICTION: f64 = 1.0;

/// What to find the limits of.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LimitsOptions {
    /// What is varied. Usual ranges: the factor of friction from 0 to 10, a coefficient of friction from 0 to twice its value, but
    /// at least to 1; whatever else is varied needs a range.
    pub vary: Vary,
    /// Modes count only where no normal force exceeds this (N).
    pub max_reaction: Option<f64>,
    /// Whether motion in the opposite direction is looked at, too.
    pub both_directions: bool,
    /// How many certified searches may be made in each direction to prove numbers of solutions over intervals; one that
    /// visits many nodes counts as several. With 0 nothing is proven.
    pub effort: u64,
}

impl LimitsOptions {
    /// The limits of what is named, in the direction of the model, whatever the reactions, with the usual effort.
    pub fn new(vary: Vary) -> Self {
        Self { vary, max_reaction: None, both_directions: false, effort: EFFORT }
    }

    /// Modes count only where no normal force exceeds this (N).
    #[must_use]
    pub fn max_reaction(mut self, force: impl Into<Option<f64>>) -> Self {
        self.max_reaction = force.into();
        self
    }

    /// Whether motion in the opposite direction is looked at, too.
    #[must_use]
    pub fn both_directions(mut self, both: bool) -> Self {
        self.both_directions = both;
        self
    }

    /// With so many certified searches in each direction at most.
    #[must_use]
    pub fn effort(mut self, searches: u64) -> Self {
        self.effort = searches;
        self
    }
}

/// The intervals in which each mode exists, what ends it, and the number of solutions in between.
///
/// Where the numbers of the mode problem are affine in what is varied (coefficients of friction, preloads, loads; decided
/// from the formulas and from where they stand) the ends are zeros of determinants, and nothing is scanned (theory, section
/// 6; [`crate::modes::existence`]). Otherwise many values are tried and what changes between them is bisected to machine
/// precision. In either case the certified search is asked for the numbers of solutions over whole intervals, as far as
/// [`LimitsOptions::effort`] allows: each of them says how it is known, [`Known`].
///
/// # Errors
/// Whatever `solve` refuses; an unknown name, an empty, reversed or infinite range, negative coefficients or factors of friction.
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
        let vary = &options.vary;
        let varied = Varied::new(model, &vary.name)?;
        let shown_in = vary.shown_in(&varied);
        let range = vary.ends(&varied, || usual_range(model, &varied))?;
        let directions = 1 + usize::from(options.both_directions);
        let found = find(&varied, range, options, work.part(0, directions))?;
        let reversed = if options.both_directions {
            let varied = Varied::new(&model.reversed(), &vary.name)?;
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

fn fault(kind: FaultKind) -> Faults {
    Fault::general(kind).into()
}
