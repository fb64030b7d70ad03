//! Mode problems whose unknowns are blocks of one or two components: contacts, and hinges with friction.
//!
//! A hinge with friction carries a couple that grows with the length of its reaction `R_j`, a vector. The mode
//! problem becomes `x = b + H^sigma w`, `w_j = |x_j|` ([`BlockProblem`]), which is no longer piecewise linear.
//! [`search`] finds all its solutions and proves that there are no others.
//!
//! # Method
//! (theory of hinges, sections 3 and 8)
//! 1. If the block norms of `H`, or a scaled singular value, are below 1, there is exactly one solution for
//!    every load.
//! 2. Blocks without friction act on no other: their forces follow from those of the rest.
//! 3. Otherwise, branch and bound over the states of the contacts and the directions of the reactions. A piece,
//!    with one sector of directions for each hinge, is excluded by a linear relaxation; its multipliers are
//!    verified for the sectors themselves. If a piece has at most one solution, Newton's method finds the only
//!    candidate, and an interval test proves that it exists. Other pieces are divided; open contacts are
//!    decided once sectors are below a quarter of a radian.
//!
//! # What is proven
//! Everything holds for all problems within the bounds of the data. A solution has an enclosure, which is
//! proven to contain exactly one. A small piece that is not decided is an [`OpenRegion`]: a fold, where two
//! solutions merge, a locking direction, in which solutions run to infinity, a curve of solutions, or a
//! reaction that vanishes.
//!
//! # Files
//! `problem.rs`, `result.rs`: what is given and returned. `sector.rs`: directions; `equations.rs`: a piece and
//! its equations; `frames.rs`: bounds on their slopes. `relaxation.rs`, `rigid.rs`: proofs that it is empty; `at_most_one.rs`: that it has at most one
//! solution; `zero.rs`: that there is one. `uniqueness.rs`: one solution for every load; `only.rs`: that one, for many
//! neighbouring problems. `tree.rs`: the search; `open.rs`: what it leaves open; `solutions.rs`: what it found.
//! `smooth.rs`, `unloaded.rs`: blocks that act on no other, and on which nothing acts; `parts.rs`: a problem without them.

mod at_most_one;
mod equations;
mod frames;
mod only;
mod open;
mod parts;
mod problem;
mod relaxation;
mod result;
mod rigid;
mod sector;
mod smooth;
mod solutions;
mod tree;
mod uniqueness;
mod unloaded;
mod zero;

pub(crate) use equations::{Slopes, load, matrix};
pub use only::{OnlySolution, only_solution};
pub use problem::BlockProblem;
pub(crate) use problem::{rows_of_block, times};
pub use result::{BlockResult, BlockSolution, OpenLabel, OpenRegion, UniqueForEveryLoad};
pub use uniqueness::unique_for_every_load;

use crate::progress::{Callback, Progress};
use crate::search::SearchOptions;
use crate::status::Proof;
use equations::Piece;
use tree::{Found, Manner, Tree};

/// All solutions of a block problem.
///
/// Of the options, the limits of nodes and of solutions apply. `progress` is called at every node and ends the
/// search by breaking; the answer is then labelled as partial.
///
/// ```
/// use std::ops::ControlFlow;
/// use nalgebra::{DMatrix, dmatrix, dvector};
/// use slideway_modes::{BySide, Proof, SearchOptions};
/// use slideway_modes::blocks::{BlockProblem, search};
/// // One hinge, R = b + e |R| with |e| = 2: w = |b|^2 / (-b.e +- sqrt(disc)) = 1 and 1/3.
/// let none = BySide::same(DMatrix::zeros(2, 0));
/// let problem = BlockProblem::new(BySide::same(dmatrix![2.0; 0.0]), none, dvector![-1.0, 0.0])?;
/// let result = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()));
/// assert_eq!((result.solutions.len(), result.complete), (2, Proof::Proven));
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn search(problem: &BlockProblem, options: &SearchOptions, progress: &mut Callback<'_>) -> BlockResult {
    searched(problem, options, progress, Manner::default())
}

/// [`search`] with another first division of directions: the quadrants, turned by an angle. The answer must
/// not depend on it.
#[doc(hidden)]
pub fn search_turned(
    problem: &BlockProblem,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
    first_angle: f64,
) -> BlockResult {
    searched(problem, options, progress, Manner { first_angle, ..Manner::default() })
}

/// [`search`], which ends at the first piece that cannot be decided: its answer is complete, or of no use. For problems
/// with wide bounds, of which nothing may be provable, it takes a fraction of the nodes. `unique` is what
/// [`unique_for_every_load`] says.
pub fn search_all_or_nothing(
    problem: &BlockProblem,
    unique: Option<UniqueForEveryLoad>,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
) -> BlockResult {
    searched_knowing(problem, unique, options, progress, Manner { all_or_nothing: true, ..Manner::default() })
}

fn searched(
    problem: &BlockProblem,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
    manner: Manner,
) -> BlockResult {
    let unique = if goes_on(progress) { unique_for_every_load(problem) } else { None };
    searched_knowing(problem, unique, options, progress, manner)
}

/// Returns true while the search may begin, or its first proof go on.
fn goes_on(progress: &mut Callback<'_>) -> bool {
    progress(&Progress { fraction: None, found: Some(0), ..Progress::of("nodes", 0, 1) }).is_continue()
}

fn searched_knowing(
    problem: &BlockProblem,
    unique: Option<UniqueForEveryLoad>,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
    manner: Manner,
) -> BlockResult {
    answer(problem, found_in_parts(problem, unique.is_some(), options, progress, manner), unique)
}

/// What is found, without the blocks that act on no other and those on which nothing acts. `unique` says whether there is
/// exactly one solution for every load.
fn found_in_parts(
    problem: &BlockProblem,
    unique: bool,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
    manner: Manner,
) -> Found {
    if let Some((rough, part)) = smooth::part_with_friction(problem) {
        let found = found_in_parts(&part, unique, options, progress, manner);
        return smooth::with_smooth_blocks(problem, &rough, found);
    }
    let unloaded = unloaded::unloaded_blocks(problem);
    let mut nodes = 0;
    if (1..problem.blocks()).contains(&unloaded.len()) {
        let at_rest = found_in_parts(&parts::part(problem, &unloaded), unique, options, progress, manner);
        nodes = at_rest.nodes;
        if let Some(rest) = at_rest.only() {
            let loaded: Vec<usize> =
                (0..problem.blocks()).filter(|block| !unloaded.contains(block)).collect();
            let part = found_in_parts(&parts::part(problem, &loaded), unique, options, progress, manner);
            let mut all = parts::embed(problem, &loaded, part, rest.determinant);
            all.nodes += nodes;
            return all;
        }
    }
    let mut all = found(problem, unique, options, progress, manner);
    all.nodes += nodes;
    all
}

/// What is found for all blocks at once.
fn found(
    problem: &BlockProblem,
    unique: bool,
    options: &SearchOptions,
    progress: &mut Callback<'_>,
    manner: Manner,
) -> Found {
    let known = match problem.blocks() {
        0 => Some(zero::Zero::of_nothing()),
        _ if unique => zero::proven_everywhere(problem, &mut || goes_on(progress)),
        _ => None,
    };
    if let Some(zero) = known {
        return Found { zeros: vec![zero], undecided: Vec::new(), stopped: None, nodes: 1 };
    }
    let mut found = Tree::new(problem, options, progress, manner).search(Piece::all(problem));
    if problem.has_no_load() {
        found.zeros.insert(0, zero::Zero::at_rest(problem));
    }
    found
}

fn answer(problem: &BlockProblem, found: Found, unique: Option<UniqueForEveryLoad>) -> BlockResult {
    let Found { zeros, undecided, stopped, nodes } = found;
    let mut solutions: Vec<BlockSolution> =
        zeros.iter().map(|zero| solutions::solution(problem, zero)).collect();
    solutions.sort_by(solutions::order);
    let complete = if undecided.is_empty() && stopped.is_none() { Proof::Proven } else { Proof::NotProven };
    BlockResult {
        solutions,
        open: open::regions(undecided),
        complete,
        stopped,
        nodes,
        unique_for_every_load: unique,
    }
}
