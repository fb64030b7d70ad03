//! Proofs that no pattern of a set has a solution.

use super::data::{Column, ProblemView};
use super::interval::Interval;
use super::matrix::inner_product;
use crate::modes::{ContactState, Side};

/// Whether `weights` prove that no pattern with the given states has a solution.
///
/// `partial` has one entry per contact: its state, or `None` for a contact that may be pressed on
/// either side or rest in its gap. With `w` for the weights (one per equation) this verifies
/// rigorously (Farkas; theory, section 4 (b))
///
/// ```text
/// w . c_k^{sigma} >= 0                                          for every side that contact k may take
/// w . N(0) + sum_k max_{sigma allowed} w . d_k^{sigma} < 0      in a gap: both sides allowed
/// ```
///
/// Since `y >= 0` and the share of `d_k^+` in a gap is between 0 and 1, the equations then cannot
/// hold. The weights may come from anywhere, for example from an inaccurate linear program: wrong
/// ones prove nothing, and the answer is `false`. Weights for which an inequality holds as an
/// equation are not proved unless all products are exact: leave a margin.
///
/// # Panics
/// If `partial` or `weights` does not have one entry per contact.
///
/// ```
/// use nalgebra::{dmatrix, dvector};
/// use slideway::modes::certificate::proves_empty;
/// use slideway::modes::ModeProblem;
/// // w = 0 z - 1 cannot hold with w >= 0, whether z is 0 or not.
/// let problem = ModeProblem::from_linear_complementarity(&dmatrix![0.0], dvector![-1.0])?;
/// assert!(proves_empty(&problem, &[None], &[1.0]));
/// assert!(!proves_empty(&problem, &[None], &[-1.0]));
/// # Ok::<(), slideway::modes::ModeProblemError>(())
/// ```
pub fn proves_empty<'a>(
    problem: impl Into<ProblemView<'a>>,
    partial: &[Option<ContactState>],
    weights: &[f64],
) -> bool {
    let problem = problem.into();
    assert_eq!(partial.len(), problem.contacts(), "one entry per contact");
    assert_eq!(weights.len(), problem.contacts(), "one weight per equation");
    let weigh = |column: Column<'_>| inner_product(weights, column.centre, column.radius);
    let mut right_hand_side = weigh(problem.load());
    for (contact, &state) in partial.iter().enumerate() {
        if column_sides(state).iter().any(|&side| !(weigh(problem.column(contact, side)).lower() >= 0.0)) {
            return false;
        }
        let jumps = jump_sides(state).iter().map(|&side| weigh(problem.jump(contact, side)));
        let largest = jumps.fold(f64::NEG_INFINITY, |most, jump| most.max(jump.upper()));
        right_hand_side = right_hand_side + Interval::new(largest, largest).unwrap_or(Interval::REAL_LINE);
    }
    right_hand_side.upper() < 0.0
}

/// The sides on which a contact may be pressed.
pub(super) fn column_sides(state: Option<ContactState>) -> &'static [Side] {
    match state {
        Some(ContactState::Positive) => &[Side::Positive],
        Some(ContactState::Negative) => &[Side::Negative],
        Some(ContactState::Gap) => &[],
        None => &Side::BOTH,
    }
}

/// The sides whose jump vectors may be part of the right-hand side.
pub(super) fn jump_sides(state: Option<ContactState>) -> &'static [Side] {
    match state {
        Some(ContactState::Gap) | None => &Side::BOTH,
        Some(ContactState::Positive) => &[Side::Positive],
        Some(ContactState::Negative) => &[Side::Negative],
    }
}
