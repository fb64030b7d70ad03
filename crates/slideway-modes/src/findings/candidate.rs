//! The careful solution of a single regular pattern.

use nalgebra::{DMatrix, DVector};

use crate::dense::Lu;
use crate::problem::{ContactState, ScaledProblem};
use crate::solutions::ContactSet;

/// Values within this fraction of the largest `y` (or of 1 for a share) count as zero.
const ZERO: f64 = 1e-12;
/// Factor on the unit roundoff in the bound on rounding errors.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The solution of one pattern's equations, in the problem's own units.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    /// `y_k`, or `lambda_k` in a gap; those that count as zero (or a share as one) are set to exactly that.
    pub(crate) unknowns: DVector<f64>,
    /// Contacts with `y_k = 0`.
    pub(crate) zero: ContactSet,
    /// Contacts in the gap with a share of 0 or 1.
    pub(crate) at_end: ContactSet,
    /// Whether no `y_k` is negative and no share is outside 0 to 1.
    pub(crate) admissible: bool,
    pub(crate) determinant: f64,
    /// Largest error bound among the `y_k`.
    pub(crate) tolerance: f64,
    /// Condition number of the scaled matrix, in the row-sum norm.
    pub(crate) condition: f64,
}

/// Solves the equations of a pattern by LU with partial pivoting and one step of iterative refinement; `None`
/// if the matrix is exactly singular or numbers overflow, or once `proceed` is `false`.
pub(crate) fn solve_pattern(
    problem: &ScaledProblem,
    pattern: &[ContactState],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Candidate> {
    let (matrix, right_hand_side) = problem.system(pattern);
    let factors = Lu::new(matrix.clone(), proceed)?;
    let mut unknowns = factors.solve(&right_hand_side)?;
    unknowns += factors.solve(&(&right_hand_side - &matrix * &unknowns))?;
    let inverse = factors.inverse(proceed)?;
    if unknowns.iter().chain(&inverse).any(|value| !value.is_finite()) {
        return None;
    }
    // |delta y| <= |C^-1| (|C| |y| + |b|) eps, componentwise.
    let terms: DVector<f64> = matrix.abs() * unknowns.abs() + problem.load_size();
    let bounds: DVector<f64> = inverse.abs() * terms * ROUNDING;
    let candidate = judge(pattern, unknowns, &bounds, problem.load_unit);
    let condition = largest_row_sum(&matrix) * largest_row_sum(&inverse);
    Some(Candidate { determinant: unscaled_determinant(problem, pattern, &factors), condition, ..candidate })
}

/// `D` of a pattern; `None` once `proceed` is `false`.
pub(crate) fn determinant(
    problem: &ScaledProblem,
    pattern: &[ContactState],
    proceed: &mut dyn FnMut() -> bool,
) -> Option<f64> {
    let factors = Lu::new(problem.system(pattern).0, proceed)?;
    Some(unscaled_determinant(problem, pattern, &factors))
}

fn judge(
    pattern: &[ContactState],
    mut unknowns: DVector<f64>,
    bounds: &DVector<f64>,
    load_unit: f64,
) -> Candidate {
    let pressed = |contact: usize| pattern[contact] != ContactState::Gap;
    let largest =
        (0..pattern.len()).filter(|&k| pressed(k)).fold(0.0, |most: f64, k| most.max(unknowns[k].abs()));
    let mut zero = ContactSet::none_of(pattern.len());
    let mut at_end = zero.clone();
    let (mut admissible, mut tolerance) = (true, 0.0_f64);
    for contact in 0..pattern.len() {
        let value = unknowns[contact];
        if pressed(contact) {
            let bound = ZERO * largest + bounds[contact];
            tolerance = tolerance.max(bound * load_unit);
            admissible &= value >= -bound;
            if value.abs() <= bound {
                zero.insert(contact);
                unknowns[contact] = 0.0;
            } else {
                unknowns[contact] = value * load_unit;
            }
        } else {
            let bound = ZERO + bounds[contact];
            admissible &= -bound <= value && value <= 1.0 + bound;
            if let Some(end) = [0.0, 1.0].into_iter().find(|end| (value - end).abs() <= bound) {
                at_end.insert(contact);
                unknowns[contact] = end;
            }
        }
    }
    Candidate { unknowns, zero, at_end, admissible, determinant: 1.0, tolerance, condition: 1.0 }
}

/// The norm `max_i sum_k |a_ik|`.
fn largest_row_sum(matrix: &DMatrix<f64>) -> f64 {
    matrix.row_iter().fold(0.0, |most: f64, row| most.max(row.abs().sum()))
}

/// `det C` of the unscaled matrix, as the product of scaled pivots, to avoid unnecessary overflow.
fn unscaled_determinant(problem: &ScaledProblem, pattern: &[ContactState], factors: &Lu) -> f64 {
    let pivots = factors.pivots();
    let scaled = pattern
        .iter()
        .enumerate()
        .map(|(contact, &state)| pivots[contact] * problem.determinant_factor(contact, state));
    scaled.product::<f64>() * factors.sign_of_order()
}
