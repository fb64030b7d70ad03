//! Every pattern of a problem, screened at the speed of the hardware.
//!
//! [`screen`] excludes patterns, and [`prove`] decides the rest by proof. Both have variants that deliver
//! results as they are found, report progress and can be stopped: [`screen_with`], [`prove_with`].
//!
//! A problem is a [`ModeProblem`](super::ModeProblem), whose numbers are taken as exact, or an
//! [`IntervalModeProblem`](super::certificate::IntervalModeProblem); an excluded pattern then has no solution
//! for any values within the bounds. A contact whose right-hand side jumps has three states, as in
//! [`decide`]: there are `3^j 2^(r - j)` patterns. Levels of such contacts are not vectorised and take much
//! longer.
//!
//! # Method
//! This is the elimination tree of theory, section 4. Contacts with a jump are decided first. Near the root,
//! where nodes are few, elimination runs in double-double arithmetic. The last twelve levels run in `f64`,
//! eight sibling nodes side by side in the lanes of vector instructions, each with its own pivot rows. The
//! last three contacts are solved together by Cramer's rule, for `D` and `x_k = D y_k`; three more `x_k`
//! follow without a division by `D` and without a branch. Back-substitution continues while some lane may
//! still be a solution.
//!
//! # Error bound
//! Every node has a bound `e` on the error of all of its entries. At the root, it is the largest radius of
//! the data. Rows and right-hand sides are scaled by powers of two there, so units do not matter. Below, hats
//! denote computed numbers, `A` and `R` bound the entries of a node and of its pivot row, and `u` is the unit
//! roundoff. A pivot is regular if `|p^| > 2 e`. Otherwise all patterns below are kept.
//!
//! *Elimination*, `a' = a - l r` with `l = c / p`. Row pivoting gives `|l^| <= L <= 1`. Since
//! `l - c^/p^ = (c - c^) / p + (c^/p^) (p^ - p) / p`, followed by two roundings, the error of `l^` is at most
//! `(1 + L) e / (|p^| - e) + 2 u`. `a` contributes `e`; `l r - l^ r^ = (l - l^) r + l^ (r - r^)`, with
//! `|r| <= R + e`, contributes the rest:
//!
//! ```text
//! e' = (1 + L) e + (R + e) ((1 + L) e / (|p^| - e) + 2 u) + 8 u (A + R)
//! ```
//!
//! The last term exceeds the rounding errors of product and difference, `2 u L R + u A`, and products of
//! small terms.
//!
//! *Determinants* of the last three contacts: six products of three entries, `6 ((A + e)^3 - A^3)`; each
//! entry is involved in at most five roundings, which are within `32 u A^3`.
//!
//! *Multiples of the determinant*, `p x = b D - sum_i c_i x_i`: `t` terms, whose second factors are at most
//! `X` with an error of at most `d`. Each term has an error of `R d + e (X + d)` and undergoes `t + 1`
//! roundings. `V^/p^ - V/p` is `((V^ - V) + (V^/p^) (p - p^)) / p`, so with `X' = t R X / (|p^| - e)`, the
//! next `X`, the error of `x` is at most
//!
//! ```text
//! (t (R d + e (X + d)) + t (t + 2) u R X + e X') / (|p^| - e) + 4 u X'
//! ```
//!
//! *Back-substitution*, `p y = b - sum_i c_i y_i` over `k` contacts with errors `d` of the `y_i <= Y`. The
//! error of the right-hand side is
//!
//! ```text
//! e + k (R d + e (Y + d)) + (k + 4) u R (1 + k Y)
//! ```
//!
//! at most, or the same sum with the size and error of each term where few patterns are left. The quotient
//! follows as above.
//!
//! A pattern is dropped only if `|D|` exceeds its error and some `y_k` or `x_k / D` is below minus its error,
//! or a share of a gap is outside 0 to 1 by more than its error. The remaining patterns therefore contain
//! every solution, whatever the rounding. Bounds are rounded up, and the least normal number is added to each
//! to cover underflow. In the tests, the entries take the worst values within `e`, for which the parts with
//! `e` and `d` are attained.
//!
//! # Files
//! `layout.rs` orders contacts and scales the equations, `upper.rs` is the tree near its root, `level.rs` the
//! equations of the nodes in lanes with their bounds, `leaf.rs` the last contacts, `kernel.rs` the last
//! levels. `run.rs` distributes subtrees among threads, and `instructions.rs` determines the processor's
//! vector instructions.

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

/// The result of a screening.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Screening {
    /// The patterns that could not be excluded, in ascending order; they include every solution.
    pub remaining: Vec<Pattern>,
    /// How many patterns were proved to have no solution.
    pub excluded: u64,
}

/// Proves that as many patterns as possible have no solution.
///
/// For each pattern, the tree looks for a `y_k < 0` that is certain in spite of rounding. The cost per
/// pattern is constant, and memory is `O(r^2)` per level and thread besides the remaining patterns. The
/// result does not depend on the number of threads.
///
/// # Panics
/// If the problem has more than 60 contacts, or more patterns than `u64` can count.
pub fn screen<'a>(problem: impl Into<ProblemView<'a>>) -> Screening {
    screen_by(problem, Instructions::best())
}

/// As [`screen`], with the given instructions.
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

/// As [`screen`], but passes each remaining pattern to a visitor, until the visitor breaks.
///
/// The visitor runs on the calling thread, subtree after subtree, in an order that does not depend on the
/// number of threads: ascending if no contact jumps. At any time, only the remaining patterns of the subtrees
/// below six levels are held, out of at most `2^21` patterns if no contact jumps. Any thread calls `progress`
/// when it completes a subtree. If `progress` breaks, the visitor receives the subtrees before the first that
/// was not screened.
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

/// Every pattern that has a solution or is singular, decided by proof; all others are proven to have none.
///
/// [`screen`] excludes most patterns, and [`decide`] settles the rest. The list is in ascending order of the
/// patterns and complete for the given numbers: a solution on a boundary is listed with each of its patterns.
/// For data within bounds, the list also contains [`Decision::Undecided`] patterns.
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

/// As [`prove`], but passes each pattern to a visitor, as [`screen_with`] does.
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
