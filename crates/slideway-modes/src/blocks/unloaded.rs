//! Blocks on which nothing acts: their forces vanish.

use nalgebra::DMatrix;

use super::equations::Piece;
use super::problem::BlockProblem;
use super::sector::Sector;
use super::tree::Found;
use super::zero::Zero;
use crate::certificate::Sign;
use crate::interval::Interval;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::{BySide, Side};

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

/// The problem of some blocks alone.
pub(super) fn part(problem: &BlockProblem, blocks: &[usize]) -> BlockProblem {
    let rows: Vec<usize> = blocks.iter().flat_map(|&block| problem.rows_of(block)).collect();
    let contacts: Vec<usize> = blocks.iter().copied().filter(|&block| block < problem.contacts()).collect();
    let select = |matrix: &IntervalMatrix, columns: &[usize]| {
        let of = |part: &DMatrix<f64>| part.select_rows(&rows).select_columns(columns);
        IntervalMatrix::around(of(matrix.centre()), of(matrix.radius())).expect("a part of a valid matrix")
    };
    let by_side = |part: &dyn Fn(Side) -> IntervalMatrix| BySide {
        positive: part(Side::Positive),
        negative: part(Side::Negative),
    };
    BlockProblem::within_bounds(
        by_side(&|side| select(problem.response(side), blocks)),
        by_side(&|side| select(problem.jumps(side), &contacts)),
        select(problem.load(), &[0]),
    )
    .expect("a part of a valid problem")
}

/// What was found for the part of some blocks, as found for the problem: the other blocks have no forces.
///
/// `rest` is the sign of the determinant of the other blocks, which the whole one has as a factor.
pub(super) fn embed(problem: &BlockProblem, blocks: &[usize], found: Found, rest: Option<Sign>) -> Found {
    let rows: Vec<usize> = blocks.iter().flat_map(|&block| problem.rows_of(block)).collect();
    let contacts = problem.contacts();
    let own: Vec<usize> = blocks.iter().copied().filter(|&block| block < contacts).collect();
    let states = |part: &[_]| {
        let mut states = vec![None; contacts];
        own.iter().zip(part).for_each(|(&contact, &state)| states[contact] = state);
        states
    };
    let spread = |part: &[Interval]| {
        let mut whole = vec![Interval::ZERO; problem.rows()];
        rows.iter().zip(part).for_each(|(&row, &value)| whole[row] = value);
        whole
    };
    let values = |part: &[f64]| {
        let mut whole = vec![0.0; problem.rows()];
        rows.iter().zip(part).for_each(|(&row, &value)| whole[row] = value);
        whole
    };
    let zero = |zero: Zero| Zero {
        states: states(&zero.states),
        point: values(zero.point.as_slice()).into(),
        enclosure: spread(&zero.enclosure),
        isolation: spread(&zero.isolation),
        determinant: zero
            .determinant
            .zip(rest)
            .map(|(one, rest)| if rest == Sign::Negative { -one } else { one }),
    };
    let piece = |piece: Piece| {
        let mut sectors = vec![Sector::All; problem.hinges()];
        let hinges = blocks.iter().filter_map(|block| block.checked_sub(contacts));
        hinges.zip(piece.sectors).for_each(|(hinge, sector)| sectors[hinge] = sector);
        Piece { states: states(&piece.states), sectors }
    };
    Found {
        zeros: found.zeros.into_iter().map(zero).collect(),
        undecided: found
            .undecided
            .into_iter()
            .map(|open| super::open::Undecided {
                label: open.label,
                piece: piece(open.piece),
                point: values(&open.point),
            })
            .collect(),
        ..found
    }
}
