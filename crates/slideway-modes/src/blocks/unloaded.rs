//! Blocks on which nothing acts: their forces vanish.

use super::problem::BlockProblem;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::Side;

/// Blocks without load on which only one another act, so that `x = 0` solves their equations; without contacts
/// that jump.
pub(super) fn unloaded_blocks(problem: &BlockProblem) -> Vec<usize> {
    let is_zero = |part: &IntervalMatrix, block: usize, column: usize| {
        problem
            .rows_of(block)
            .all(|row| part.centre()[(row, column)] == 0.0 && part.radius()[(row, column)] == 0.0)
    };
    let has_no_load = |&block: &usize| {
        let no_jump =
            |side: Side| (0..problem.contacts()).all(|contact| is_zero(problem.jumps(side), block, contact));
        is_zero(problem.load(), block, 0) && Side::BOTH.into_iter().all(no_jump)
    };
    let jumps = |block: usize| block < problem.contacts() && problem.has_jump(block);
    let mut blocks: Vec<usize> =
        (0..problem.blocks()).filter(has_no_load).filter(|&block| !jumps(block)).collect();
    loop {
        let before = blocks.clone();
        let acts = |block: usize, on: usize| {
            Side::BOTH.into_iter().any(|side| !is_zero(problem.response(side), on, block))
        };
        let outside: Vec<usize> = (0..problem.blocks()).filter(|block| !before.contains(block)).collect();
        blocks.retain(|&block| !outside.iter().any(|&other| acts(other, block)));
        if blocks == before {
            return blocks;
        }
    }
}
