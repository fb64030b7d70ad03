//! The mode problem: exact or within bounds, what its contacts do, and its units.
//!
//! `side.rs` and `pattern.rs` are the words, `mode_problem.rs` holds exact numbers, `bounds.rs` those within
//! bounds (`radii.rs`), of which `bounded_influence.rs` makes one from influence coefficients; `scaling.rs`
//! chooses units in which tolerances are plain numbers.

mod bounded_influence;
mod bounds;
mod mode_problem;
mod pattern;
mod radii;
mod scaling;
mod side;

pub use bounded_influence::IntervalInfluence;
pub(crate) use bounds::Column;
pub use bounds::{IntervalModeProblem, IntervalModeProblemError, ProblemView};
pub use mode_problem::{InfluenceCoefficients, ModeProblem, ModeProblemError};
pub use pattern::{ContactState, SolutionSet};
pub(crate) use radii::Radii;
pub(crate) use scaling::{ScaledProblem, patterns_of, power_of_two_above};
pub use side::{BySide, ProblemPart, Side};
