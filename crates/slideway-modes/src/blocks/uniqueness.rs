//! Proofs that there is exactly one solution for every load (theory of hinges, section 3).

use nalgebra::{DMatrix, DVector};

use super::at_most_one::norms_contract;
use super::equations::Piece;
use super::problem::BlockProblem;
use super::result::UniqueForEveryLoad;
use crate::certificate::{IntervalMatrix, has_norm_below_one};
use crate::interval_matrix::rounding;
use crate::problem::Side;

/// Patterns of contacts whose two columns differ are tried up to this many contacts.
const CONTACTS: usize = 8;
/// Steps of the power iteration for Perron vectors.
const STEPS: usize = 60;
/// Every norm is raised by this share of the largest, so that Perron vectors are positive.
const RAISED: f64 = 1e-9;

/// Why there is exactly one solution for every load (theory of hinges, section 3); `None` if that is not proven.
///
/// The equations are one-to-one on all unknowns with a Lipschitz-continuous inverse, so that they are also
/// onto. With jumps nothing is proven.
pub fn unique_for_every_load(problem: &BlockProblem) -> Option<UniqueForEveryLoad> {
    if (0..problem.contacts()).any(|contact| problem.has_jump(contact)) {
        return None;
    }
    if norms_contract(problem, &Piece::all(problem)) {
        return Some(UniqueForEveryLoad::BlockNorms);
    }
    has_scaled_norm_below_one(problem).then_some(UniqueForEveryLoad::ScaledNorm)
}

/// Whether `smax(S H^sigma S^-1) < 1` for every pattern, with `S = diag(sqrt(l / r))` from the left and right
/// Perron vectors of the matrix of block norms.
fn has_scaled_norm_below_one(problem: &BlockProblem) -> bool {
    let norms = block_norms(problem);
    let raised = norms.add_scalar(RAISED * norms.amax());
    let (right, left) = (perron(&raised), perron(&raised.transpose()));
    let scale: Vec<f64> = left.iter().zip(&right).map(|(left, right)| (left / right).sqrt()).collect();
    let differs = |&contact: &usize| {
        let [one, other] = Side::BOTH.map(|side| problem.response(side));
        one.centre().column(contact) != other.centre().column(contact)
            || one.radius().column(contact) != other.radius().column(contact)
    };
    let differing: Vec<usize> = (0..problem.contacts()).filter(differs).collect();
    differing.len() <= CONTACTS
        && (0..1_usize << differing.len()).all(|pattern| {
            let side = |column: usize| match differing.iter().position(|&contact| contact == column) {
                Some(at) if pattern >> at & 1 == 1 => Side::Negative,
                _ => Side::Positive,
            };
            scaled(problem, &scale, side).is_some_and(|matrix| has_norm_below_one(&matrix))
        })
}

/// Upper bounds on the norms of the blocks of `H`, in both versions and for all values within the bounds.
pub(super) fn block_norms(problem: &BlockProblem) -> DMatrix<f64> {
    let blocks = problem.blocks();
    let factor = 1.0 + 2.0 * rounding(4);
    let norm = |side: Side, block: usize, column: usize| {
        let part = problem.response(side);
        let largest = |row: usize| part.centre()[(row, column)].abs() + part.radius()[(row, column)];
        problem.rows_of(block).map(largest).reduce(f64::hypot).unwrap_or(0.0)
    };
    DMatrix::from_fn(blocks, blocks, |block, column| {
        norm(Side::Positive, block, column).max(norm(Side::Negative, block, column)) * factor
    })
}

/// The Perron vector of a positive matrix; rounded.
fn perron(matrix: &DMatrix<f64>) -> DVector<f64> {
    let mut vector = DVector::repeat(matrix.nrows(), 1.0);
    let mut image = vector.clone();
    for _ in 0..STEPS {
        image.gemv(1.0, matrix, &vector, 0.0);
        let largest = image.amax();
        if largest == 0.0 || !largest.is_finite() {
            return DVector::repeat(matrix.nrows(), 1.0);
        }
        vector.axpy(0.5 / largest, &image, 0.5);
    }
    vector
}

/// `S H^sigma S^-1` with its rounding errors.
fn scaled(problem: &BlockProblem, scale: &[f64], side: impl Fn(usize) -> Side) -> Option<IntervalMatrix> {
    let (rows, blocks) = (problem.rows(), problem.blocks());
    let mut factors = DMatrix::zeros(rows, blocks);
    for block in 0..blocks {
        for row in problem.rows_of(block) {
            for column in 0..blocks {
                factors[(row, column)] = scale[block] / scale[column];
            }
        }
    }
    let value = |row: usize, column: usize| {
        let part = problem.response(side(column));
        (part.centre()[(row, column)], part.radius()[(row, column)])
    };
    // The factors are rounded: the exact ones are s_i / s_j of s_i = scale[i], within one unit roundoff.
    let centre = DMatrix::from_fn(rows, blocks, |row, column| value(row, column).0 * factors[(row, column)]);
    let radius = DMatrix::from_fn(rows, blocks, |row, column| {
        let (centre, radius) = value(row, column);
        let factor = factors[(row, column)] * (1.0 + 4.0 * f64::EPSILON);
        (centre.abs() * 2.0 * f64::EPSILON + radius) * factor + f64::MIN_POSITIVE
    });
    IntervalMatrix::around(centre, radius)
}
