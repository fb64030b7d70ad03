//! Every pattern of a problem, screened at the pace of the hardware.
//!
//! [`screen`] excludes, [`prove`] decides what is left by proof. Both have a form that hands out what they find as
//! they go, tells progress and can be stopped: [`screen_with`], [`prove_with`].
//!
//! A problem is a [`ModeProblem`](super::ModeProblem), whose numbers are taken as exact, or an
//! [`IntervalModeProblem`](super::certificate::IntervalModeProblem); what is excluded then has no solution for any
//! values within the bounds. A contact whose right-hand side jumps has three states, as in
//! [`decide`]: there are `3^j 2^(r - j)` patterns. Levels of such contacts are not vectorised and take much longer.
//!
//! # Method
//! The elimination tree of theory, section 4. Contacts with a jump are decided first. Near the root, where nodes
//! are few, elimination runs in double-double arithmetic. The last twelve levels run in `f64`, eight sibling nodes
//! side by side in the lanes of vector instructions, each with its own pivot rows. The last three contacts are
//! solved together by Cramer's rule; back-substitution goes on while some lane may still be a solution.
//!
//! # Error bound
//! Every node has a bound `e` on the error of all of its entries. At the root that is the largest radius of the
//! data. If every entry of a node is within `e` of the exact one, a pivot `p` is regular when `|p| > 2 e`.
//! Otherwise all patterns below are kept. With row pivoting `|l| <= L <= 1`, and the entries `a - l r` of the child
//! are within
//!
//! ```text
//! e' = (1 + L) e + (R + e) ((1 + L) e / (|p| - e) + 2 u) + 8 u (A + R)
//! ```
//!
//! of theirs, where `R` bounds the pivot row, `A` the node, and `u` is the unit roundoff: `a` contributes `e`, `l r`
//! contributes `L e` by its `r` and `R + e` times the error of `l`, which is `(|a_c| e + |p| e) / (|p| (|p| - e))`
//! at most besides two roundings; the last term is more than the roundings of product and difference. Determinants
//! of the last three contacts are wrong by
//! `6 ((A + e)^3 - A^3) + 32 u A^3` at most. In the back-substitution `p y = b - sum_i c_i y_i` over `k` contacts
//! with errors `d` of the `y_i <= Y` the right-hand side is wrong by
//!
//! ```text
//! e + k (R d + e (Y + d)) + (k + 4) u R (1 + k Y)
//! ```
//!
//! at most, or by the same sum with the size and error of each term where few patterns are left. A pattern is dropped only when some `y_k` is below minus its error, or a share of a gap beyond 0 to 1
//! by more than that. So the patterns that are left hold every solution, whatever rounding did. Bounds are rounded
//! up, and the least normal number is added to each against underflow.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled without the chosen instructions")]
#![expect(clippy::needless_range_loop, reason = "loops over lanes run through several arrays at once")]

mod double_double;
mod kernel;
mod lanes;
mod layout;
mod pattern;
mod run;
mod upper;

pub use pattern::Pattern;

use std::ops::ControlFlow;

use super::certificate::{Decision, ProblemView, Verdict, decide};
use run::Run;

/// What a screening leaves.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Screening {
    /// The patterns that could not be excluded, in ascending order; every solution is among them.
    pub remaining: Vec<Pattern>,
    /// How many patterns were proved to have no solution.
    pub excluded: u64,
}

/// How far a walk over all patterns has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Patterns that have been dealt with.
    pub examined: u64,
    /// All patterns.
    pub total: u64,
}

/// What became of the patterns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tally {
    /// Patterns that the visitor was told of, or would have been in the subtree at which it stopped.
    pub visited: u64,
    /// Patterns that were proved to have no solution.
    pub excluded: u64,
    /// Whether the walk came to its end, so that the two counts add up to all patterns.
    pub complete: bool,
}

/// Proves for as many patterns as possible that they have no solution.
///
/// For each pattern the tree looks for a `y_k < 0` that is certain in spite of rounding. Costs a constant per
/// pattern, memory `O(r^2)` per level and thread besides the patterns that remain. The result does not depend on
/// the number of threads.
///
/// # Panics
/// If the problem has more than 60 contacts, or more patterns than a `u64` can count.
pub fn screen<'a>(problem: impl Into<ProblemView<'a>>) -> Screening {
    let mut remaining = Vec::new();
    let visit = |pattern| {
        remaining.push(pattern);
        ControlFlow::Continue(())
    };
    let tally = screen_with(problem, visit, |_| ControlFlow::Continue(()));
    remaining.sort_unstable();
    Screening { remaining, excluded: tally.excluded }
}

/// As [`screen`], but hands each pattern that is left to a visitor, until it breaks off.
///
/// The visitor runs on the calling thread, subtree after subtree, in an order that does not depend on the number of
/// threads: ascending where no contact jumps. What is left of the subtrees below six levels is held at a time, out of
/// `2^21` patterns at most where no contact jumps. `progress` is called by any thread whenever a subtree is done. If
/// it breaks off,
/// the visitor is told of no subtree from the first on that was not screened.
///
/// # Panics
/// As [`screen`].
pub fn screen_with<'a>(
    problem: impl Into<ProblemView<'a>>,
    mut visit: impl FnMut(Pattern) -> ControlFlow<()>,
    progress: impl Fn(&Progress) -> ControlFlow<()> + Sync,
) -> Tally {
    let problem = problem.into();
    Run::new(problem, &|remaining| remaining, &progress).visit_all(problem, &mut visit)
}

/// Every pattern that has a solution or is singular, decided by proof; all others are proved to have none.
///
/// [`screen`] excludes most patterns, [`decide`] settles the rest. The list is in ascending order of the patterns and
/// complete for the numbers given: a solution on a boundary is listed with each of its patterns. For data within
/// bounds it also has what is [`Decision::Undecided`].
///
/// # Panics
/// As [`screen`].
///
/// ```
/// use nalgebra::{DMatrix, DVector};
/// use slideway::modes::{ModeProblem, exhaustive};
/// // w = -z + 1 for each of three contacts: every pattern has a solution.
/// let m = -DMatrix::identity(3, 3);
/// let problem = ModeProblem::from_linear_complementarity(&m, DVector::from_element(3, 1.0))?;
/// assert_eq!(exhaustive::prove(&problem).len(), 8);
/// # Ok::<(), slideway::modes::ModeProblemError>(())
/// ```
pub fn prove<'a>(problem: impl Into<ProblemView<'a>>) -> Vec<(Pattern, Verdict)> {
    let mut proved = Vec::new();
    let visit = |pattern, verdict| {
        proved.push((pattern, verdict));
        ControlFlow::Continue(())
    };
    prove_with(problem, visit, |_| ControlFlow::Continue(()));
    proved.sort_unstable_by_key(|(pattern, _)| *pattern);
    proved
}

/// As [`prove`], but hands each pattern to a visitor, as [`screen_with`] does.
///
/// # Panics
/// As [`screen`].
pub fn prove_with<'a>(
    problem: impl Into<ProblemView<'a>>,
    mut visit: impl FnMut(Pattern, Verdict) -> ControlFlow<()>,
    progress: impl Fn(&Progress) -> ControlFlow<()> + Sync,
) -> Tally {
    let problem = problem.into();
    let contacts = problem.contacts();
    let examine = |remaining: Vec<Pattern>| {
        let decided =
            remaining.into_iter().map(|pattern| (pattern, decide(problem, &pattern.states(contacts))));
        decided.filter(|(_, verdict)| !matches!(verdict.decision, Decision::NoSolution { .. })).collect()
    };
    Run::new(problem, &examine, &progress)
        .visit_all(problem, &mut |(pattern, verdict)| visit(pattern, verdict))
}
