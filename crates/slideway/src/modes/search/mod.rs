//! Pruned search: every solution without trying every pattern.
//!
//! # Method
//! 1. Contacts are split into groups that act on one another in one direction only (theory, section
//!    4 (d)). Groups are solved in that order; independent groups multiply, and their solutions are
//!    kept as a product, [`SolutionProduct`].
//! 2. A group has exactly one solution if one of two cheap proofs says so (section 4 (a), (c)).
//! 3. Where a large group is coupled through one to six quantities only, all patterns that can
//!    occur are the cells of a hyperplane arrangement in so many dimensions (section 4 (e)): the space
//!    of these quantities is subdivided until each part is excluded or has few patterns.
//! 4. Otherwise branch and bound over the states of the contacts. A node is excluded by interval
//!    propagation or by an infeasible linear relaxation (section 4 (a), (b)); a node with all
//!    contacts decided is solved as [`enumerate`](super::enumerate) does. The next contact to decide
//!    is the one for which, as far as one dual step tells, forbidding either side costs most.
//!
//! # Accuracy
//! Exclusions are made with a margin and hold with rounding errors accounted for: a node that is
//! excluded by the relaxation has a Farkas vector that was verified in that sense, and a node whose
//! exclusion cannot be verified is split further. Patterns that are left are decided with the
//! tolerances of [`modes`](super). [`SearchResult::completeness`] tells what is proven.
//!
//! Not proven are patterns whose outcome within tolerances is not what
//! [`certificate::decide`](super::certificate::decide) says of the numbers as given, for example within
//! rounding of a boundary.
//!
//! # Cost
//! The relaxation leaves the sum of both sides of a contact unbounded. It is strong for random dense
//! problems, and weak where columns of many contacts are nearly dependent, as in coupling of low
//! rank beyond that of method 3: there the tree can have nearly `2^r` nodes. A solution with `m` contacts on a boundary is met
//! in up to `2^m` patterns.
//!
//! Singular patterns that admit nothing (locking of the mode) are excluded like others and not
//! listed, unlike in [`enumerate`](super::enumerate).

mod cells;
mod composition;
mod count;
mod group;
mod groups;
mod inverse;
mod leaf;
mod load;
mod low_rank;
mod monitor;
mod product;
mod propagation;
mod relaxation;
mod report;
mod result;
mod simplex;
mod states;
#[cfg(test)]
mod test_problems;
mod tree;
mod uniqueness;

use std::ops::ControlFlow;

pub use count::BigCount;
pub use product::{Alternative, CombinedState, Factor, GroupState, SolutionProduct, StateCounts, StateKind};
pub use report::{
    Arguments, Completeness, Exclusion, ExclusionArgument, GroupReport, Method, PatternShares, Progress,
    SearchOptions, StopReason,
};
pub use result::SearchResult;
pub use states::StateSet;

use super::problem::{ModeProblem, ModeProblemError};
use composition::Composer;
use monitor::Monitor;

/// All solutions of a mode problem of any size, and how they were found.
///
/// Finds every solution of `sum_k c_k^{sigma_k} y_k = N(0) + sum_k d_k^{sigma_k}, y >= 0` (Klepp
/// (2002), eqs. (6) and (8)), states in preload gaps and what singular patterns admit, as
/// [`enumerate`](super::enumerate) does, but without trying every pattern. The work depends on the
/// problem and can grow like `2^r`: `progress` is called at every node and ends the search when it
/// breaks (the library has no clock; compare times there). The answer is then labelled as partial.
///
/// # Errors
/// [`ModeProblemError::NotFinite`] if numbers overflow when the solution of one group of contacts
/// is put into the equations of another.
///
/// ```
/// use std::ops::ControlFlow;
/// use nalgebra::{DMatrix, DVector};
/// use slideway::modes::{ModeProblem, SearchOptions, search};
/// // w = -z + 1 for each of 100 contacts: z = 0 or z = 1.
/// let m = -DMatrix::identity(100, 100);
/// let problem = ModeProblem::from_linear_complementarity(&m, DVector::from_element(100, 1.0))?;
/// let result = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()))?;
/// assert_eq!(result.counts().solutions.to_string(), "1267650600228229401496703205376");
/// assert_eq!(result.product.states().take(10).count(), 10);
/// # Ok::<(), slideway::modes::ModeProblemError>(())
/// ```
pub fn search(
    problem: &ModeProblem,
    options: &SearchOptions,
    progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<SearchResult, ModeProblemError> {
    let mut monitor = Monitor::new(options.nodes, progress);
    let mut composer = Composer::new(problem, options, &mut monitor);
    let product = composer.solve()?;
    let (groups, all_examined) = (composer.reports, composer.all_examined);
    let proven = composer.chain_proven && groups.iter().all(|group| group.proven);
    let completeness = match monitor.stopped() {
        Some(reason) => Completeness::Partial(reason),
        None if !all_examined => Completeness::Unexamined,
        None if proven => Completeness::Proven,
        None => Completeness::NotProven,
    };
    Ok(SearchResult { product, completeness, groups, contacts: problem.contacts() })
}
