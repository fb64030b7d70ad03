//! Pruned search: every solution without trying every pattern.
//!
//! # Method
//! 1. Contacts are split into groups that act on one another in one direction only (theory, section 4 (d)).
//!    Groups are solved in that order; the solutions of independent groups multiply and are kept as a
//!    product, [`SolutionProduct`].
//! 2. In a group with few patterns, each pattern is decided, so that all outcomes are known, including locked
//!    modes ([`GroupReport::outcomes`]).
//! 3. A larger group that is monotone has all its solutions in one pattern, which Lemke's method finds (section 4
//!    (c)).
//! 4. If a large group is coupled only through one to six quantities, all patterns that can occur are the
//!    cells of a hyperplane arrangement in as many dimensions (section 4 (e)): the space of these quantities
//!    is subdivided until each part is excluded or has few patterns.
//! 5. Otherwise, branch and bound over the states of the contacts. A node is excluded by interval propagation
//!    or by an infeasible linear relaxation (section 4 (a), (b)); a node with all contacts decided is a
//!    pattern to decide. If the numbers are exact, the signs of single equations leave some contacts only one side, and
//!    a contact whose columns are opposite, a free unknown, is not branched on where the others determine it: the
//!    relaxation, and the vectors that exclude nodes, are those of the equations without free unknowns, their Schur complement
//!    in integers. A node is then also
//!    settled if all its solutions are those of one pattern, a face of the relaxation (section 4, "Faces"): degenerate
//!    solutions and continua are met once.
//!    The next contact to branch on is the one for which forbidding either side costs
//!    most, as estimated from one dual step.
//!
//! # What is proven
//! The problem is either exact ([`ModeProblem`](super::ModeProblem)) or given within bounds
//! ([`IntervalModeProblem`](super::certificate::IntervalModeProblem)); in the latter case everything is
//! proven for all values within the bounds. Exclusions account for rounding errors and bounds: a node that is
//! excluded by the relaxation has a Farkas vector that was verified in that sense, and a node whose exclusion
//! cannot be verified is split further. The remaining patterns are decided by
//! [`certificate::decide`](super::certificate::decide), and each state carries its
//! [`Certificate`](super::Certificate), which says what is proven about it.
//!
//! - Exact numbers (sums of two matrices are not rounded): every pattern is decided, in rational numbers if
//!   necessary. A group's right-hand side that follows from other groups has a rounding error; if that leaves
//!   a pattern open, the pattern is decided together with their contacts (up to 48 of them).
//! - Numbers within bounds: a pattern whose outcome differs between values, or for which that could not be
//!   ruled out, is labelled. If it is a solution at the midpoint of the bounds, it is listed as a solution on
//!   the boundary within the bounds, otherwise as an [`UndecidedPattern`](super::UndecidedPattern). Such
//!   patterns do not make a list less proven: it contains everything that is a solution for some value. A
//!   contact may rest in its gap if `d_k^+` and `d_k^-` may differ within the bounds; if both are one number
//!   known within bounds, make it part of the right-hand side.
//!
//! [`SearchResult::completeness`] says whether all of this succeeded. Singular sets that take too much work
//! to describe exactly are not proven. Without [`SearchOptions::certify`], patterns are solved with the
//! tolerances of [`modes`](super), and nothing is proven.
//!
//! # Cost
//! The relaxation leaves the sum of both sides of a contact unbounded. It is strong for random dense
//! problems, but weak if columns of many contacts are nearly dependent, as in low-rank coupling beyond the
//! scope of method 4: there the tree can have nearly `2^r` nodes. Within bounds, a solution with `m` contacts
//! on a boundary occurs in up to `2^m` patterns, each of which is decided. Large trees are divided into
//! subtrees, which threads share; nodes and results are the same for any number of threads.
//!
//! # Proof files
//! [`prove`] searches an exact problem and writes every step for a checker that needs nothing of this crate: by trees and
//! the rule for monotone problems, and, if the coupling has low rank, by trees within half-spaces that bound all unknowns.
//!
//! Except in groups for which every pattern is tried, singular patterns that admit nothing (locking of the
//! mode) are excluded like others and not listed, unlike in [`enumerate`](super::enumerate).

mod alternation;
mod branching;
mod cells;
mod composition;
mod count;
mod every;
mod faces;
mod group;
mod groups;
mod inverse;
mod joined;
mod leaf;
mod lemke;
mod load;
mod low_rank;
mod monitor;
mod monotone;
mod product;
mod proof;
mod proof_cells;
mod proof_digest;
mod proof_log;
mod proof_low_rank;
mod propagation;
mod reduced;
mod relaxation;
mod report;
mod result;
mod separation;
mod share_entries;
mod short_vector;
mod sieve;
mod signs;
mod states;
mod subtrees;
#[cfg(test)]
mod test_problems;
mod tree;
mod without_free;

pub use count::BigCount;
pub(crate) use joined::CORNERS;
pub use product::{Alternative, CombinedState, Factor, GroupState, SolutionProduct, StateCounts, StateKind};
pub use proof::{NoProof, ProofFile, prove};
pub use report::{
    Arguments, Completeness, Exclusion, ExclusionArgument, GroupReport, Method, PatternOutcomes,
    PatternShares, SearchOptions, StopReason,
};
pub use result::{SearchResult, StateLists};
pub use states::StateSet;

use crate::problem::ProblemView;
use crate::progress::Callback;
use alternation::Composition;
use monitor::Monitor;
pub use monitor::StateCallback;

/// Bound on the loss by underflow in bounds and sums of products, far above the least number and far below
/// any admitted number; loads have size 1.
const UNDERFLOW: f64 = 1e-290;

/// All solutions of a mode problem of any size, and how they were found.
///
/// Finds every solution of `sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k}, y >= 0` (Klepp (2002), eqs.
/// (6) and (8)), states in preload gaps, and what singular patterns admit, as [`enumerate`](super::enumerate)
/// does, but without trying every pattern, and proves the result. `problem` is a reference to a
/// [`ModeProblem`](super::ModeProblem), or to an
/// [`IntervalModeProblem`](super::certificate::IntervalModeProblem) whose numbers lie within bounds. The work
/// depends on the problem and can grow like `2^r`: `progress` is called at every node and during long steps,
/// and ends the search by breaking (the library has no clock; check the time there). The answer is then
/// labelled as partial.
///
/// ```
/// use std::ops::ControlFlow;
/// use nalgebra::{DMatrix, DVector};
/// use slideway_modes::{ModeProblem, SearchOptions, search};
/// // w = -z + 1 for each of 100 contacts: z = 0 or z = 1.
/// let m = -DMatrix::identity(100, 100);
/// let problem = ModeProblem::from_linear_complementarity(&m, DVector::from_element(100, 1.0))?;
/// let result = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
/// assert_eq!(result.counts().solutions.to_string(), "1267650600228229401496703205376");
/// assert_eq!(result.product.states().take(10).count(), 10);
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn search<'a>(
    problem: impl Into<ProblemView<'a>>,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
) -> SearchResult {
    solve(problem.into(), options, &mut Monitor::new(options.nodes, progress))
}

/// [`search`], with `states` called for states as soon as they are proven.
///
/// This is possible for an exact problem whose contacts are one group: the states of several groups are
/// combinations, which [`SearchResult::product`] has at the end. A state that is reported is one whatever
/// happens afterwards. It may be reported again if other patterns have it, and a set that is reported later
/// may contain it. The order does not depend on the number of threads. The search ends if `states` breaks.
pub fn search_telling<'a>(
    problem: impl Into<ProblemView<'a>>,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
    states: &mut StateCallback<'_>,
) -> SearchResult {
    solve(problem.into(), options, &mut Monitor::new(options.nodes, progress).telling(states))
}

fn solve(problem: ProblemView<'_>, options: &SearchOptions, monitor: &mut Monitor<'_>) -> SearchResult {
    let problem = problem.without_zero_radii();
    let Composition { product, reports: groups, abandoned_nodes, completeness } =
        alternation::solve(problem, options, monitor);
    SearchResult { product, completeness, groups, abandoned_nodes, contacts: problem.contacts() }
}
