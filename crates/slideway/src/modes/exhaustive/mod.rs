//! Every pattern of a problem without jumps, screened at the pace of the hardware.
//!
//! [`screen`] excludes, [`prove`] decides what is left by proof.
//!
//! The elimination tree of theory, section 4, in two parts. Near the root, where nodes are few, elimination runs
//! in double-double arithmetic; the last ten levels run in `f64` with unrolled,
//! vectorised steps. Both carry one rigorous bound on the error of all entries of a node, so that a
//! pattern is dropped only when some `y_k` is proved to be negative: the patterns that are left hold every
//! solution, whatever rounding did.
//!
//! # Error bound
//! If every entry of a node is within `e` of the exact one, a pivot `p` is regular when `|p| > 2 e`. With row
//! pivoting `|l| <= 1`, and the entries `a - l r` of the child are within
//!
//! ```text
//! e' = 2 e + (R + e) (2 e / (|p| - e) + u) + 4 u (A + R)
//! ```
//!
//! of theirs, where `R` bounds the pivot row, `A` the node, and `u` is the unit roundoff.

mod double_double;
mod kernel;
mod upper;

use super::certificate::{Decision, Verdict, decide};
use super::problem::ModeProblem;
use super::solutions::ContactState;
use rayon::prelude::*;

/// Levels of the tree that are expanded before its subtrees are shared among threads.
const SHARED_LEVELS: usize = 7;

/// A pattern of sides as bits: bit `k` is set where contact `k` is on its negative side.
pub type PatternBits = u64;

/// What a screening leaves.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Screening {
    /// The patterns that could not be excluded, in ascending order; every solution is among them.
    pub remaining: Vec<PatternBits>,
    /// How many patterns were proved to have no solution.
    pub excluded: u64,
}

/// Proves for as many patterns as possible that they have no solution.
///
/// For each of the `2^r` patterns of a problem without jumps the tree looks for a `y_k < 0` that is certain in
/// spite of rounding. Costs a constant per pattern, memory `O(r^2)` per thread besides the patterns that remain.
/// The result does not depend on the number of threads.
///
/// # Panics
/// If the problem has more than 63 contacts, or a jump (see [`ModeProblem::has_jump`]).
pub fn screen(problem: &ModeProblem) -> Screening {
    let contacts = problem.contacts();
    assert!(contacts < 64, "patterns are held in the bits of a u64");
    assert!((0..contacts).all(|contact| !problem.has_jump(contact)), "only problems without jumps");
    let total = 1_u64 << contacts;
    if contacts < 3 {
        return Screening { remaining: (0..total).collect(), excluded: 0 };
    }
    let root = upper::Node::root(problem);
    let shared = SHARED_LEVELS.min(contacts - 2);
    let subtrees = root.expand(shared);
    let mut remaining: Vec<PatternBits> =
        subtrees.into_par_iter().flat_map_iter(|node| upper::screen_subtree(&node)).collect();
    remaining.par_sort_unstable();
    let excluded = total - remaining.len() as u64;
    Screening { remaining, excluded }
}

/// Every pattern of a problem without jumps that has a solution or is singular, decided by proof; all others are
/// proved to have none.
///
/// [`screen`] excludes most patterns, [`decide`] settles the rest. The list is in ascending order of the patterns and
/// complete for the numbers given: a solution on a boundary is listed with each of its patterns.
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
pub fn prove(problem: &ModeProblem) -> Vec<(PatternBits, Verdict)> {
    let contacts = problem.contacts();
    let decided = screen(problem).remaining.into_par_iter().map(|bits| {
        let state = |contact| match bits >> contact & 1 {
            0 => ContactState::Positive,
            _ => ContactState::Negative,
        };
        let pattern: Vec<ContactState> = (0..contacts).map(state).collect();
        (bits, decide(problem, &pattern))
    });
    decided.filter(|(_, verdict)| !matches!(verdict.decision, Decision::NoSolution { .. })).collect()
}
