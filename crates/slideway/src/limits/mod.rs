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
//! `limits` varies a parameter: `vary.rs` is what is asked for, `varied.rs` is what is varied (with a
//! `Follower` for the positions from value to value), `solve::Parts` the mode problem at one value, with the
//! couples of guided sliders. `model/dependence.rs` decides from the formulas whether that is affine in it;
//! `closed_form.rs` has `modes::existence` find the ends then, `scan.rs` finds them elsewhere. `examine.rs`
//! asks the certified search for the numbers of solutions over whole intervals, and `find.rs` scans anew
//! where these contradict; `branches.rs` does so with friction in hinges; `degenerate.rs` counts solutions
//! where modes are on their boundaries throughout, `standing.rs` where contacts stand still while the rest moves; `between_faces.rs` counts the states of guided sliders between their faces, which
//! `solve::states_between_faces` finds at single values (for `map`, `drive` and `size`, too); `speeds.rs` tells
//! where motion along a mode speeds up and slows down; `guarantee.rs` and `conclusion.rs` put it into words, and `answer.rs` makes the report. `limits/curves.rs` samples
//! quantities along the modes that were found, for plots. `rest.rs` asks `standstill` over a range.

mod analysis;
mod answer;
mod between_faces;
mod branches;
mod closed_form;
mod conclusion;
mod curves;
mod degenerate;
mod examine;
mod find;
mod found;
mod guarantee;
mod options;
mod report;
mod rest;
mod scan;
mod speeds;
mod standing;
mod text;
mod varied;
mod vary;

pub use crate::model::FRICTION;
pub(crate) use answer::{Naming, held_state};
pub(crate) use curves::StateAt;
pub use curves::{Curve, CurvePoint, Curves, Quantity, Series, curves_with, limits_with_curves};
pub(crate) use find::find;
pub(crate) use found::{Method, ModesFound, SameEnds};
pub(crate) use guarantee::guarantee;
pub use options::{EFFORT, LimitsOptions};
pub use report::{
    CountLimits, Direction, EndHingeForce, EndReaction, Known, LimitsMethod, LimitsReport, ModeLimits,
    REST_SCHEMA, RangeWithoutProblem, RestLimitsReport, SCHEMA, SpanOfRest, SpeedLimits, VariedQuantity,
};
pub use rest::{rest_limits, rest_limits_with};
pub(crate) use text::{could_be_missed, no_answers};
pub use varied::{Variable, variables};
pub(crate) use varied::{Varied, mechanism_with};
pub use vary::Vary;
pub(crate) use vary::range_around;

pub use crate::report::Tipping;

use crate::fault::Faults;
use crate::model::Model;
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;
use analysis::Analysis;

/// The intervals in which each mode exists, what ends it, and the number of solutions in between.
///
/// Where the numbers of the mode problem are affine in what is varied (coefficients of friction, preloads,
/// loads; decided from the formulas and from where they stand) the ends are zeros of determinants, and
/// nothing is scanned (theory, section 6; [`crate::modes::existence`]). Otherwise many values are tried and
/// what changes between them is bisected to machine precision. In either case the certified search is asked
/// for the numbers of solutions over whole intervals, as far as [`LimitsOptions::effort`] allows: each of
/// them says how it is known, [`Known`].
///
/// # Errors
/// Whatever `solve` refuses; an unknown name, an empty, reversed or infinite range, negative coefficients or
/// factors of friction.
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
