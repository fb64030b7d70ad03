//! Proofs that a piece of the unknowns holds at most one solution (theory of hinges, section 8, (iii)).

use nalgebra::{DMatrix, DVector};

use super::equations::Piece;
use super::frames::{Ball, Frame, matrix_in_frames};
use super::problem::BlockProblem;
use super::sector::Sector;
use crate::certificate::enclose_solution;
use crate::interval::Interval;
use crate::interval_matrix::{IntervalMatrix, product, rounding, upper_product};
use crate::problem::Side;

/// Steps of the power iteration for the weights.
const STEPS: usize = 30;

/// Whether the equations of a piece have at most one solution, for any load; proven.
///
/// For two of them `A (x - x') = 0`, where `A = A_0 - sum_j G_j delta_j^T` and `delta_j` is in a disc of
/// radius `r_j`: that of slopes of `|R_j|` about its centre, or `-1..1` for an open contact. With an
/// approximate inverse `C` of `A_0`, and norms of blocks,
///
/// ```text
/// |x - x'| <= B |x - x'|,   B_ij = |(I - C A_0)_ij| + |(C G_j)_i| r_j,
/// ```
///
/// so that `x = x'` if `B u < u` for some `u > 0`. Otherwise the matrices are tried entry by entry.
pub(super) fn has_at_most_one(problem: &BlockProblem, piece: &Piece) -> bool {
    if piece.may_jump(problem) {
        return false;
    }
    norms_contract(problem, piece) || is_regular_in_frames(problem, piece)
}

/// Whether the matrix of slopes is regular, with the unknowns of each hinge along and across its sector.
fn is_regular_in_frames(problem: &BlockProblem, piece: &Piece) -> bool {
    let frame = |sector: &Sector| {
        let vectors = sector.frame();
        let slopes = vectors.map(|vector| {
            let [least, most] = [sector.least(vector), -sector.least(vector.map(|value| -value))];
            Ball::from(Interval::new(least, most).unwrap_or(Interval::REAL_LINE))
        });
        Frame { vectors, slopes }
    };
    let frames: Vec<Frame> = piece.sectors.iter().map(frame).collect();
    let all = matrix_in_frames(problem, &piece.states, &vec![Ball::ANY_SLOPE; problem.contacts()], &frames);
    let nothing = IntervalMatrix::exact(DMatrix::zeros(problem.rows(), 0));
    all.is_some_and(|all| enclose_solution(&all, &nothing).is_some())
}

/// Whether `B u < u` for the norms of blocks; without contacts that may jump.
pub(super) fn norms_contract(problem: &BlockProblem, piece: &Piece) -> bool {
    block_norms(problem, piece).is_some_and(|norms| is_contraction(&norms))
}

/// `B`; `None` if numbers overflow, or `A_0` is singular.
fn block_norms(problem: &BlockProblem, piece: &Piece) -> Option<DMatrix<f64>> {
    let (rows, blocks) = (problem.rows(), problem.blocks());
    let discs: Vec<_> = piece.sectors.iter().map(|sector| sector.disc()).collect();
    let frames: Vec<Frame> =
        discs.iter().map(|(centre, _)| Frame::of_components(centre.map(Ball::point))).collect();
    let even = vec![Ball::point(0.0); problem.contacts()];
    let [matrix, deviations] =
        [matrix_in_frames(problem, &piece.states, &even, &frames)?, deviations(problem, piece)?];
    let inverse = matrix.centre().clone().try_inverse()?;
    // C [A_0, G]
    let product = product(&inverse, &matrix.beside(&deviations), &mut || true)?;
    let size = |row: usize, column: usize| {
        let identity = if row == column { 1.0 } else { 0.0 };
        (identity - product.centre()[(row, column)]).abs() + product.radius()[(row, column)]
    };
    let factor = 1.0 + 4.0 * rounding(4);
    let norms = DMatrix::from_fn(blocks, blocks, |one, other| {
        let defects =
            problem.rows_of(one).flat_map(|row| problem.rows_of(other).map(move |column| (row, column)));
        let defect = defects.map(|(row, column)| size(row, column).powi(2)).sum::<f64>().sqrt();
        let column = rows + other;
        let spread = problem.rows_of(one).map(|row| size(row, column).powi(2)).sum::<f64>().sqrt();
        let radius = other.checked_sub(problem.contacts()).map_or(1.0, |hinge| discs[hinge].1);
        (defect + spread * radius) * factor + f64::MIN_POSITIVE
    });
    norms.iter().all(|value| value.is_finite()).then_some(norms)
}

/// `G`: the columns of hinges, and half the sums of both columns of open contacts; `None` if numbers overflow.
fn deviations(problem: &BlockProblem, piece: &Piece) -> Option<IntervalMatrix> {
    let [positive, negative] = Side::BOTH.map(|side| problem.response(side));
    let mut centre = positive.centre().clone();
    let mut radius = positive.radius().clone();
    for (contact, state) in piece.states.iter().enumerate() {
        for row in 0..problem.rows() {
            let at = (row, contact);
            if state.is_some() {
                (centre[at], radius[at]) = (0.0, 0.0);
            } else if centre[at] != negative.centre()[at] || radius[at] != negative.radius()[at] {
                let half =
                    (positive.entry(row, contact) + negative.entry(row, contact)) * Interval::point(0.5);
                centre[at] = half.middle();
                radius[at] = (half - Interval::point(centre[at])).magnitude();
            }
        }
    }
    IntervalMatrix::around(centre, radius)
}

/// Whether the spectral radius of `B >= 0` is below 1; verified.
pub(super) fn is_contraction(norms: &DMatrix<f64>) -> bool {
    weights_of_contraction(norms).is_some()
}

/// Some `u > 0` with `B u < u`, so that the spectral radius of `B >= 0` is below 1; verified.
pub(super) fn weights_of_contraction(norms: &DMatrix<f64>) -> Option<DVector<f64>> {
    let mut weights = DVector::repeat(norms.nrows(), 1.0);
    for _ in 0..STEPS {
        let image = upper_product(norms, &weights);
        if image.iter().zip(&weights).all(|(image, weight)| image < weight) {
            return Some(weights);
        }
        let largest = image.amax();
        if !largest.is_finite() || image.iter().zip(&weights).all(|(image, weight)| image >= weight) {
            return None;
        }
        // Not the image alone, which would swing if the matrix is periodic.
        weights = (weights + image / largest).map(|weight| 0.5 * weight);
    }
    None
}
