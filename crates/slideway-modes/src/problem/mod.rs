//! The mode problem: exact or within bounds, the states of its contacts, and its units.
//!
//! `side.rs` and `pattern.rs` define the basic terms. `mode_problem.rs` contains exact numbers, and
//! `bounds.rs` those within bounds (`radii.rs`); `bounded_influence.rs` builds a problem within bounds from
//! influence coefficients, `shared_load.rs` one of redundant contacts. `scaling.rs` chooses units in which tolerances are pure numbers.

mod bounded_influence;
mod bounds;
mod mode_problem;
mod pattern;
mod radii;
mod scaling;
mod shared_load;
mod side;

pub use bounded_influence::IntervalInfluence;
pub(crate) use bounds::Column;
pub use bounds::{IntervalModeProblem, IntervalModeProblemError, ProblemView};
pub use mode_problem::{InfluenceCoefficients, ModeProblem, ModeProblemError};
pub(crate) use pattern::advance;
pub use pattern::{ContactState, SetPart, SolutionSet};
pub(crate) use radii::Radii;
pub(crate) use scaling::{ScaledProblem, exponent_of, patterns_of, power_of_two_above};
pub use shared_load::{OpenContacts, SharedLoad};
pub use side::{BySide, ProblemPart, Side};
