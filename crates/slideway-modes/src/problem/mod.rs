//! The mode problem: exact or within bounds, the states of its contacts, and its units.
//!
//! `side.rs` and `pattern.rs` define the basic terms. `mode_problem.rs` contains exact numbers, and
//! `bounds.rs` those within bounds (`radii.rs`); `influence.rs` builds either from influence coefficients,
//! `shared_load.rs` has the rows of redundant contacts. `scaling.rs` chooses units in which tolerances are
//! pure numbers.

mod bounds;
mod influence;
mod mode_problem;
mod pattern;
mod radii;
mod scaling;
mod shared_load;
mod side;

pub(crate) use bounds::{Column, column_slice};
pub use bounds::{IntervalModeProblem, IntervalModeProblemError, ProblemView};
pub use influence::{BlockNumbers, InfluenceCoefficients};
pub(crate) use mode_problem::check;
pub use mode_problem::{ModeProblem, ModeProblemError};
pub use pattern::{ContactState, SetPart, SolutionSet};
pub(crate) use pattern::{advance, patterns, pressed_sides};
pub(crate) use radii::Radii;
pub(crate) use scaling::{ScaledProblem, exponent_of, patterns_of, power_of_two_above};
pub use shared_load::{OpenContacts, SharedLoad};
pub use side::{BySide, ProblemPart, Side};
