//! All solutions of absolute value equations, linear complementarity problems and contacts with dry friction,
//! with a proof that the list is complete.
//!
//! ```
//! use nalgebra::{dmatrix, dvector};
//! use slideway_modes::{Proof, SearchOptions};
//! use slideway_modes::raw_problem::{RawProblem, Unknowns, solve};
//! use std::ops::ControlFlow;
//!
//! // w = M z + q, w >= 0, z >= 0, w_k z_k = 0
//! let problem = RawProblem::LinearComplementarity { m: dmatrix![1.0, 2.0; 2.0, 1.0], q: dvector![-1.0, -1.0] };
//! let answer = solve(&problem, &SearchOptions::default(), 10, &mut |_| ControlFlow::Continue(()))?;
//! assert_eq!((answer.solutions.len(), answer.complete), (3, Proof::Proven));
//! for solution in &answer.solutions {
//!     let Unknowns::Complementary { z, .. } = &solution.unknowns else { unreachable!() };
//!     println!("z = {z:?}");
//! }
//! # Ok::<(), slideway_modes::ModeProblemError>(())
//! ```
//!
//! [`raw_problem`] takes these problems in their original form, [`search`] the mode problem to which all of
//! them reduce.
//!
//! # Features
//! Both are on by default; without them the crate reads no files.
//!
//! - `json`: raw problems from JSON text;
//! - `npz`: raw problems from NumPy archives, and their answers as NumPy archives.
//!
//! # The mode problem
//! With `y_k = |N_k|` and `sigma_k = sign(N_k)` the normal forces of `r` contacts satisfy
//!
//! ```text
//! sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k},   y >= 0
//! ```
//!
//! (Klepp (2002), eqs. (6) and (8); theory, section 3). [`ModeProblem`] holds these numbers, [`search`]
//! finds and proves all solutions, and [`enumerate`], with which the tests compare, solves each of the `2^r` patterns of
//! sides by itself and reports all outcomes ([`Solutions`]). Nothing here
//! depends on mechanisms: absolute value equations and linear complementarity problems have constructors of
//! their own.
//!
//! # Accuracy
//! This concerns what is solved within tolerances: [`enumerate`], [`screen`], and a search without
//! certificates. A pattern is solved by LU factorization and one step of iterative refinement; where very many problems
//! of few contacts are solved, patterns are the leaves of a binary tree that decides the side of one contact per level,
//! with one elimination step per node (theory, section 4): constant work per pattern on average.
//!
//! Rows are scaled by powers of two so that the largest coefficient is between 1/2 and 1, and loads so that
//! the largest load is between 1/2 and 1; the outcome therefore does not depend on their units. Then
//!
//! - a leaf of the tree is dropped if `y_k < -1e-9 m_k`, where `m_k >= |y_k|` is the result of back-substitution with
//!   absolute values, and the whole problem is in doubt if some `y_k` is within that of zero, or a pivot below `1e-7`
//!   times the largest entry of its column;
//! - a `y_k` of a pattern that is solved by itself counts as zero if it is below `1e-12 max |y|` plus the bound
//!   `8 eps (|C^-1| (|C| |y| + |N(0)| + sum |d|))_k` on the effect of rounding in the data (for a share
//!   `lambda`: 1e-12 plus the bound);
//! - a pattern whose matrix has a condition number above `1e7` is examined with complete pivoting; it is singular
//!   (`D = 0`) if a pivot is below `1e-12`, with columns scaled to a largest entry of 1;
//! - the equations of a singular pattern are consistent if they hold to `1e-10`, and its `z >= 0` is tested
//!   to `1e-9`, both in scaled units.
//!
//! # Degenerate cases
//! A solution with `m` contacts on the boundary is found from up to `2^m` patterns and reported once,
//! provided that the right-hand side does not jump at these contacts. Singular patterns are reported with the
//! set of normal forces that they admit. Contacts at which the right-hand side jumps can also rest between
//! their faces; such states are listed separately, in [`Solutions::gaps`].
//!
//! # Files
//! From the lowest floor up; a module imports only those before it.
//!
//! - `combinations.rs` (choices of indices), `error_free.rs` (exact rounding errors), `dense.rs` (factorizations and products that can be
//!   interrupted), `simplex/` (linear programs), `interval/`, `interval_matrix.rs`: numbers.
//! - `progress.rs` (progress, and ending the work), `scan.rs` (values of a range, and bisection of what differs between them).
//! - `problem/`: the problem, exact or within bounds, the states of contacts, and units in which tolerances
//!   are pure numbers.
//! - `certificate/`: proofs that decide one pattern, and proofs that sets of patterns are empty.
//! - `solutions/`: what is reported about a problem; `support.rs` decides which set of solutions is part of
//!   which.
//! - `findings/`: what patterns admit, collected and counted; patterns decided within tolerances.
//! - All patterns: `search/` finds and proves all solutions of exact problems and of problems within bounds
//!   (groups of contacts, every pattern of small groups, cheap proofs of uniqueness, cells of a low-rank
//!   coupling, otherwise branch and bound with interval propagation and a linear relaxation). `enumeration.rs` solves
//!   every pattern by itself, with which tests compare. `uniqueness/` decides whether every load has exactly one solution.
//! - Very many points: `screen.rs` (small problems one after another).
//! - Hinges with friction: `blocks/`, problems with unknowns of two components.
//! - A line of problems: `existence/` finds the intervals of a parameter in which modes exist, without
//!   scanning. `branches/` follows the solutions of problems with hinges.
//! - `raw_problem/`: problems in their original form.

#![forbid(unsafe_code)]

pub mod blocks;
pub mod branches;
pub mod certificate;
mod combinations;
pub mod dense;
mod enumeration;
mod error_free;
pub mod existence;
mod findings;
pub mod interval;
mod interval_matrix;
pub mod names;
pub mod printable;
mod problem;
pub mod progress;
#[cfg(test)]
mod random_numbers;
pub mod raw_problem;
pub mod scan;
pub mod screen;
mod search;
mod simplex;
mod solutions;
mod status;
mod uniqueness;

pub use enumeration::{EnumerationError, enumerate};
/// The linear algebra whose vectors and matrices are in the interface.
pub use nalgebra;
pub use problem::{
    BlockNumbers, BySide, ContactState, InfluenceCoefficients, ModeProblem, ModeProblemError, OpenContacts,
    ProblemPart, SetPart, SharedLoad, Side, SolutionSet,
};
pub use search::{
    Alternative, Arguments, BigCount, CombinedState, Completeness, Exclusion, ExclusionArgument, Factor,
    GroupReport, GroupState, Method, NoProof, PatternOutcomes, PatternShares, ProofFile, SearchOptions,
    SearchResult, SolutionProduct, StateCallback, StateCounts, StateKind, StateLists, StateSet, StopReason,
    prove, search, search_telling,
};
pub use solutions::{
    Certificate, ClosestMode, GapShare, GapState, Limits, ModeSolution, ModeState, PatternCounts,
    SingularMode, Solutions, UndecidedPattern,
};
pub use status::{Proof, Status};
pub use uniqueness::{Unfinished, Uniqueness, UniquenessLimits, uniqueness, uniqueness_with};

/// The example of the README runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
