//! Every pattern of a problem, screened at the pace of the hardware.
//!
//! [`screen`] excludes, [`prove`] decides what is left by proof. Both have a form that hands out what they
//! find as they go, tells progress and can be stopped: [`screen_with`], [`prove_with`].
//!
//! A problem is a [`ModeProblem`](super::ModeProblem), whose numbers are taken as exact, or an
//! [`IntervalModeProblem`](super::certificate::IntervalModeProblem); what is excluded then has no solution
//! for any values within the bounds. A contact whose right-hand side jumps has three states, as in
//! [`decide`]: there are `3^j 2^(r - j)` patterns. Levels of such contacts are not vectorised and take much longer.
//!
//! # Method
//! The elimination tree of theory, section 4. Contacts with a jump are decided first. Near the root, where
//! nodes are few, elimination runs in double-double arithmetic. The last twelve levels run in `f64`, eight
//! sibling nodes side by side in the lanes of vector instructions, each with its own pivot rows. The last
//! three contacts are solved together by Cramer's rule, for `D` and `x_k = D y_k`; three more `x_k` follow
//! without a division by `D` and without a branch. Back-substitution goes on while some lane may still be a
//! solution.
//!
//! # Error bound
//! Every node has a bound `e` on the error of all of its entries. At the root that is the largest radius of
//! the data. Rows and right-hand sides are scaled by powers of two there, so units do not matter. Below,
//! numbers with a hat are the computed ones, `A` and `R` bound the entries of a node and of its pivot row,
//! `u` is the unit roundoff. A pivot is regular when `|p^| > 2 e`. Otherwise all patterns below are kept.
//!
//! *Elimination*, `a' = a - l r` with `l = c / p`. Row pivoting gives `|l^| <= L <= 1`. As
//! `l - c^/p^ = (c - c^) / p + (c^/p^) (p^ - p) / p`, and two roundings follow, `l^` is wrong by
//! `(1 + L) e / (|p^| - e) + 2 u` at most. `a` contributes `e`; `l r - l^ r^ = (l - l^) r + l^ (r - r^)`,
//! with `|r| <= R + e`, the rest:
//!
//! ```text
//! e' = (1 + L) e + (R + e) ((1 + L) e / (|p^| - e) + 2 u) + 8 u (A + R)
//! ```
//!
//! The last term is more than the roundings of product and difference, `2 u L R + u A`, and products of small
//! terms.
//!
//! *Determinants* of the last three contacts: six products of three entries, `6 ((A + e)^3 - A^3)`; each
//! entry takes part in at most five roundings, which are within `32 u A^3`.
//!
//! *Multiples of the determinant*, `p x = b D - sum_i c_i x_i`: `t` terms, whose second factors are at most
//! `X` and wrong by `d` at most. Each term is wrong by `R d + e (X + d)` and passes `t + 1` roundings.
//! `V^/p^ - V/p` is `((V^ - V) + (V^/p^) (p - p^)) / p`, so that with `X' = t R X / (|p^| - e)`, the next
//! `X`, `x` is wrong by
//!
//! ```text
//! (t (R d + e (X + d)) + t (t + 2) u R X + e X') / (|p^| - e) + 4 u X'
//! ```
//!
//! *Back-substitution*, `p y = b - sum_i c_i y_i` over `k` contacts with errors `d` of the `y_i <= Y`. The
//! right-hand side is wrong by
//!
//! ```text
//! e + k (R d + e (Y + d)) + (k + 4) u R (1 + k Y)
//! ```
//!
//! at most, or by the same sum with the size and error of each term where few patterns are left. The quotient
//! follows as above.
//!
//! A pattern is dropped only when `|D|` is above its error and some `y_k` or `x_k / D` is below minus its
//! error, or a share of a gap beyond 0 to 1 by more than that. So the patterns that are left hold every
//! solution, whatever rounding did. Bounds are rounded up, and the least normal number is added to each
//! against underflow. Tests let the entries take the worst values within `e`, where the parts with `e` and
//! `d` are attained.
//!
//! # Files
//! `layout.rs` orders contacts and scales the equations, `upper.rs` is the tree near its root, `level.rs` the
//! equations of the nodes in lanes and their bounds, `leaf.rs` the last contacts, `kernel.rs` the last
//! levels, `run.rs` shares subtrees among threads, `instructions.rs` is what the processor can do.

#![expect(clippy::inline_always, reason = "what is not inlined is compiled without the chosen instructions")]
#![expect(clippy::needless_range_loop, reason = "loops over lanes run through several arrays at once")]

mod double_double;
mod instructions;
mod kernel;
mod lanes;
mod layout;
mod leaf;
mod level;
mod pattern;
mod run;
#[cfg(test)]
mod tests;
mod upper;

#[doc(hidden)]
pub use instructions::Instructions;
pub use pattern::Pattern;
pub use run::Tally;

use std::ops::ControlFlow;

use crate::certificate::{Decision, ProvenDecision, decide};
use crate::problem::ProblemView;
use crate::progress::Progress;
use run::Run;

/// What a screening leaves.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Screening {
    /// The patterns that could not be excluded, in ascending order; every solution is among them.
    pub remaining: Vec<Pattern>,
    /// How many patterns were proved to have no solution.
    pub excluded: u64,
}

/// Proves for as many patterns as possible that they have no solution.
///
/// For each pattern the tree looks for a `y_k < 0` that is certain in spite of rounding. Costs a constant per
/// pattern, memory `O(r^2)` per level and thread besides the patterns that remain. The result does not depend
/// on the number of threads.
///
/// # Panics
/// If the problem has more than 60 contacts, or more patterns than a `u64` can count.
pub fn screen<'a>(problem: impl Into<ProblemView<'a>>) -> Screening {
    screen_by(problem, Instructions::best())
}

/// As [`screen`], with instructions of choice.
#[doc(hidden)]
pub fn screen_by<'a>(problem: impl Into<ProblemView<'a>>, instructions: Instructions) -> Screening {
    let problem = problem.into();
    let mut remaining = Vec::new();
    let mut visit = |pattern| {
        remaining.push(pattern);
        ControlFlow::Continue(())
    };
    let run = Run::new(problem, instructions, &|remaining| remaining, &|_| ControlFlow::Continue(()));
    let tally = run.visit_all(problem, &mut visit);
    remaining.sort_unstable();
    Screening { remaining, excluded: tally.excluded }
}

/// As [`screen`], but hands each pattern that is left to a visitor, until it breaks off.
///
/// The visitor runs on the calling thread, subtree after subtree, in an order that does not depend on the
/// number of threads: ascending where no contact jumps. What is left of the subtrees below six levels is held
/// at a time, out of `2^21` patterns at most where no contact jumps. `progress` is called by any thread
/// whenever a subtree is done. If it breaks off, the visitor is told of no subtree from the first on that was
/// not screened.
///
/// # Panics
/// As [`screen`].
pub fn screen_with<'a>(
    problem: impl Into<ProblemView<'a>>,
    mut visit: impl FnMut(Pattern) -> ControlFlow<()>,
    progress: impl Fn(&Progress) -> ControlFlow<()> + Sync,
) -> Tally {
    let problem = problem.into();
    Run::new(problem, Instructions::best(), &|remaining| remaining, &progress).visit_all(problem, &mut visit)
}

/// Every pattern that has a solution or is singular, decided by proof; all others are proved to have none.
///
/// [`screen`] excludes most patterns, [`decide`] settles the rest. The list is in ascending order of the
/// patterns and complete for the numbers given: a solution on a boundary is listed with each of its patterns.
/// For data within bounds it also has what is [`Decision::Undecided`].
///
/// # Panics
/// As [`screen`].
///
/// ```
/// use nalgebra::{DMatrix, DVector};
/// use slideway_modes::{ModeProblem, exhaustive};
/// // w = -z + 1 for each of three contacts: every pattern has a solution.
/// let m = -DMatrix::identity(3, 3);
/// let problem = ModeProblem::from_linear_complementarity(&m, DVector::from_element(3, 1.0))?;
/// assert_eq!(exhaustive::prove(&problem).len(), 8);
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn prove<'a>(problem: impl Into<ProblemView<'a>>) -> Vec<(Pattern, ProvenDecision)> {
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
    mut visit: impl FnMut(Pattern, ProvenDecision) -> ControlFlow<()>,
    progress: impl Fn(&Progress) -> ControlFlow<()> + Sync,
) -> Tally {
    let problem = problem.into();
    let contacts = problem.contacts();
    let examine = |remaining: Vec<Pattern>| {
        let decided =
            remaining.into_iter().map(|pattern| (pattern, decide(problem, &pattern.states(contacts))));
        decided.filter(|(_, verdict)| !matches!(verdict.decision, Decision::NoSolution { .. })).collect()
    };
    Run::new(problem, Instructions::best(), &examine, &progress).visit_all(problem, &mut |(
        pattern,
        verdict,
    )| {
        visit(pattern, verdict)
    })
}
