//! The problem of some of the blocks, and what is found for it in terms of all.

use nalgebra::DMatrix;

use super::equations::Piece;
use super::open::Undecided;
use super::problem::BlockProblem;
use super::sector::Sector;
use super::tree::Found;
use super::zero::Zero;
use crate::certificate::Sign;
use crate::interval::Interval;
use crate::interval_matrix::IntervalMatrix;
use crate::problem::BySide;

/// The problem of some blocks alone.
pub(super) fn part(problem: &BlockProblem, blocks: &[usize]) -> BlockProblem {
    let rows: Vec<usize> = blocks.iter().flat_map(|&block| problem.rows_of(block)).collect();
    let contacts: Vec<usize> = blocks.iter().copied().filter(|&block| block < problem.contacts()).collect();
    let select = |matrix: &IntervalMatrix, columns: &[usize]| {
        let of = |part: &DMatrix<f64>| part.select_rows(&rows).select_columns(columns);
        IntervalMatrix::around(of(matrix.centre()), of(matrix.radius())).expect("a part of a valid matrix")
    };
    BlockProblem::within_bounds(
        BySide::of(|side| select(problem.response(side), blocks)),
        BySide::of(|side| select(problem.jumps(side), &contacts)),
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
            .map(|open| Undecided { label: open.label, piece: piece(open.piece), point: values(&open.point) })
            .collect(),
        ..found
    }
}
