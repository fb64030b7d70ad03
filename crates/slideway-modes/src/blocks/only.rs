//! The only solution of a problem whose block norms are below one, within bounds: for many neighbouring problems.

use nalgebra::DVector;

use super::at_most_one::weights_of_contraction;
use super::equations::Piece;
use super::problem::BlockProblem;
use super::uniqueness::block_norms;
use super::zero::{newton, start};
use crate::interval::Interval;
use crate::interval_matrix::{rounding, upper_product};
use crate::problem::Side;

/// The only solution of a block problem.
#[derive(Debug, Clone, PartialEq)]
pub struct OnlySolution {
    /// `x`, row by row, as computed.
    pub point: Vec<f64>,
    /// For each block a proven bound on the distance of its force from the computed one.
    pub errors: Vec<f64>,
}

/// The only solution of a problem that has exactly one for every load because its block norms are below one; `None` if
/// they are not, if the load jumps, or if Newton's method does not converge. `near` is a point from which to start,
/// such as the solution of a neighbouring problem.
///
/// With `|H_ij| <= B_ij` and `B u <= q u`, `u > 0`, `q < 1`, there is exactly one solution `x` (theory of hinges,
/// section 3). From `x' - x = r + H (|x'| - |x|)` with the residual `r` of a point `x'`
///
/// ```text
/// |x'_i - x_i| <= u_i max_j (|r_j| / u_j) / (1 - q)
/// ```
///
/// `det(I - H D)` is positive there, as it is for `t H`, `0 <= t <= 1`.
///
/// ```
/// use nalgebra::{DMatrix, dmatrix, dvector};
/// use slideway_modes::BySide;
/// use slideway_modes::blocks::{BlockProblem, only_solution};
/// // One hinge, R = b + e |R| with e.b = 0: |R|^2 = |b|^2 / (1 - e.e).
/// let none = BySide::same(DMatrix::zeros(2, 0));
/// let problem = BlockProblem::new(BySide::same(dmatrix![0.6; 0.0]), none, dvector![0.0, 4.0])?;
/// let only = only_solution(&problem, None).expect("a small friction circle");
/// assert!((only.point[0] - 3.0).abs() <= only.errors[0]);
/// # Ok::<(), slideway_modes::ModeProblemError>(())
/// ```
pub fn only_solution(problem: &BlockProblem, near: Option<&[f64]>) -> Option<OnlySolution> {
    if (0..problem.contacts()).any(|contact| problem.has_jump(contact)) {
        return None;
    }
    let norms = block_norms(problem);
    let weights = weights_of_contraction(&norms)?;
    let image = upper_product(&norms, &weights);
    let most = image.iter().zip(&weights).map(|(image, weight)| image / weight).fold(0.0, f64::max);
    let gain = Interval::ONE / (Interval::ONE - Interval::point(most.next_up()));
    if !(gain.lower() > 0.0 && gain.upper().is_finite()) {
        return None;
    }
    let everything = Piece::all(problem);
    let from = near.filter(|near| near.len() == problem.rows());
    let begin = from.map(DVector::from_column_slice).or_else(|| start(problem, &everything))?;
    let point = newton(problem, &everything.states, begin)?;
    let residual = residual_bounds(problem, &point);
    let part = |block: usize| {
        let length = problem.rows_of(block).map(|row| residual[row]).reduce(f64::hypot).unwrap_or(0.0);
        length / weights[block] * (1.0 + rounding(0))
    };
    let largest = (0..problem.blocks()).map(part).fold(0.0, f64::max);
    let bound = Interval::point(largest) * gain;
    let errors = weights.iter().map(|weight| (bound * Interval::point(*weight)).upper()).collect();
    Some(OnlySolution { point: point.as_slice().to_vec(), errors })
}

/// Upper bounds on what a point leaves of each equation, `|x - b - H w|`, for all values within the bounds of a problem
/// without jumps: the rounded sum, its rounding error, and what the radii of the data add.
fn residual_bounds(problem: &BlockProblem, point: &DVector<f64>) -> DVector<f64> {
    let contacts = problem.contacts();
    let length = |block: usize| problem.rows_of(block).map(|row| point[row].abs()).reduce(f64::hypot);
    let lengths: Vec<f64> = (0..problem.blocks()).map(|block| length(block).unwrap_or(0.0)).collect();
    let side =
        |block: usize| if block < contacts && point[block] < 0.0 { Side::Negative } else { Side::Positive };
    // Each length is rounded twice as often as a number at most, and two terms stand beside the products.
    let rounded = rounding(problem.blocks() + 4);
    DVector::from_fn(problem.rows(), |row, _| {
        let load = problem.load().centre()[(row, 0)];
        let (mut sum, mut size) = (point[row] - load, point[row].abs() + load.abs());
        let mut spread = problem.load().radius()[(row, 0)];
        for (block, length) in lengths.iter().enumerate() {
            let response = problem.response(side(block));
            let term = response.centre()[(row, block)] * length;
            sum -= term;
            size += term.abs();
            spread += response.radius()[(row, block)] * length;
        }
        (sum.abs() + rounded * size + spread) * (1.0 + 2.0 * rounded) + f64::MIN_POSITIVE
    })
}
