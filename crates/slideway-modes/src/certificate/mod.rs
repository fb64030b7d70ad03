//! Proofs about the patterns of a mode problem.
//!
//! Everything here is rigorous for the given numbers: no tolerance decides anything. Rounding is enclosed by
//! intervals, and what intervals leave in doubt is decided in exact rational arithmetic (every `f64` is a
//! rational number).
//!
//! - [`decide`] determines what one pattern of `sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k}, y >= 0`
//!   admits: a solution with its enclosure, none, a solution on the boundary with the `y_k` that are exactly
//!   zero, or a singular system with the exact set of its solutions (theory, section 3).
//! - [`proves_empty`] verifies the argument by which a search excludes whole sets of patterns (theory,
//!   section 4).
//!
//! Each of them takes a [`ModeProblem`](super::ModeProblem), whose numbers are taken as exact (sums of two
//! matrices unrounded), or an [`IntervalModeProblem`], whose numbers lie anywhere within bounds. In the
//! latter case, a result holds for all values within the bounds, and a pattern whose outcome differs between
//! them is [`Decision::Undecided`].
//!
//! Contacts in their gap have the column `-(d_k^+ - d_k^-)`, and their unknown is the share `lambda_k`,
//! `0 <= lambda_k <= 1`. Any difference between `d_k^+` and `d_k^-`, however small, is a jump.

mod admissible;
mod cell;
mod condensed;
mod cramer;
mod decision;
mod elimination;
mod enclosure;
mod exact;
mod exchange;
mod exclusion;
mod lifted;
mod monotone;
mod norm;
mod polyhedron;
mod preconditioned;
mod propagation;
mod residues;
mod system;

pub use crate::interval::{Interval, Sign};
pub use crate::interval_matrix::IntervalMatrix;
pub use crate::problem::{IntervalModeProblem, IntervalModeProblemError, ProblemView};
pub use cell::{Cell, CellPart};
pub(super) use condensed::Condensed;
pub(super) use decision::decide_while;
pub use decision::{Decision, Precision, ProvenDecision, decide};
pub(super) use elimination::mantissa_and_exponent;
pub use enclosure::{LinearEnclosure, enclose_solution, enclose_solution_while, proven_determinant_sign};
pub use exact::{ExactOutcome, solve_exactly, solve_part_exactly};
pub(super) use exact::{ExactSolution, determinant_sign, enclose_sums, solve_matrix_exactly};
pub use exchange::{has_one_solution, is_exchange};
pub use exclusion::proves_empty;
pub(super) use exclusion::proves_empty_while;
pub(super) use lifted::{LiftedSystem, make_primitive};
pub(super) use monotone::Monotone;
pub(super) use norm::has_norm_below_one;
pub use polyhedron::ExactSet;
pub use propagation::{Propagation, propagate};
