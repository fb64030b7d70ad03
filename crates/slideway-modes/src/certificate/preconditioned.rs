//! The equations of a set of patterns in signed unknowns.

use nalgebra::{DMatrix, DVector};

use crate::interval::Interval;
use crate::interval_matrix::{IntervalMatrix, product};
use crate::problem::{ContactState, ProblemView, Side};

/// The equations
///
/// ```text
/// sum_k A_k x_k + sum_{k undecided} B_k |x_k| = b + sum_{k undecided} tau_k j_k,   -1 <= tau_k <= 1
/// ```
///
/// of all patterns with given states. For an undecided contact `x_k = N_k`,
/// `A_k = (c_k^+ - c_k^-) / 2`, `B_k = (c_k^+ + c_k^-) / 2`, `j_k = (d_k^+ - d_k^-) / 2`, and
/// `tau_k = sign(N_k)` unless `N_k = 0`. For a decided one `x_k` is `y_k` or `lambda_k`, `A_k` its
/// column, and `B_k = j_k = 0`. All jumps that do not depend on `tau` are in `b`.
pub(super) struct BaseSystem {
    matrix: IntervalMatrix,
    absolute: IntervalMatrix,
    jumps: IntervalMatrix,
    right_hand_side: IntervalMatrix,
}

impl BaseSystem {
    /// `None` if numbers overflow.
    pub(super) fn new(problem: ProblemView<'_>, partial: &[Option<ContactState>]) -> Option<Self> {
        let contacts = partial.len();
        let zeros = DMatrix::from_element(contacts, contacts, Interval::ZERO);
        let (mut matrix, mut absolute, mut jumps) = (zeros.clone(), zeros.clone(), zeros);
        let load = problem.load();
        let mut right = DMatrix::from_fn(contacts, 1, |row, _| load.entry(row));
        let half = Interval::point(0.5);
        for (contact, &state) in partial.iter().enumerate() {
            let [c_plus, c_minus] = Side::BOTH.map(|side| problem.column(contact, side));
            let [d_plus, d_minus] = Side::BOTH.map(|side| problem.jump(contact, side));
            for row in 0..contacts {
                let (d_plus, d_minus) = (d_plus.entry(row), d_minus.entry(row));
                let at = (row, contact);
                let constant = match state {
                    Some(ContactState::Positive) => {
                        matrix[at] = c_plus.entry(row);
                        d_plus
                    }
                    Some(ContactState::Negative) => {
                        matrix[at] = c_minus.entry(row);
                        d_minus
                    }
                    Some(ContactState::Gap) => {
                        matrix[at] = d_minus - d_plus;
                        d_minus
                    }
                    None => {
                        let (c_plus, c_minus) = (c_plus.entry(row), c_minus.entry(row));
                        matrix[at] = (c_plus - c_minus) * half;
                        absolute[at] = (c_plus + c_minus) * half;
                        jumps[at] = (d_plus - d_minus) * half;
                        (d_plus + d_minus) * half
                    }
                };
                right[(row, 0)] += constant;
            }
        }
        Some(Self {
            matrix: IntervalMatrix::from_intervals(&matrix)?,
            absolute: IntervalMatrix::from_intervals(&absolute)?,
            jumps: IntervalMatrix::from_intervals(&jumps)?,
            right_hand_side: IntervalMatrix::from_intervals(&right)?,
        })
    }

    /// The equations multiplied by an approximate inverse `R` of `A`; `None` if there is none.
    pub(super) fn preconditioned(&self) -> Option<Preconditioned> {
        let inverse = self.matrix.centre().clone().try_inverse()?;
        let near_identity = product(&inverse, &self.matrix, &mut || true)?;
        let identity = DMatrix::identity(inverse.nrows(), inverse.nrows());
        // 1 - c is exact for c between 1/2 and 2, where c must lie; the radius covers the rest.
        let rounded = (near_identity.centre() - &identity).abs() * f64::EPSILON;
        let defect =
            IntervalMatrix::around(identity - near_identity.centre(), near_identity.radius() + rounded)?;
        let sizes = |matrix: &IntervalMatrix| {
            (matrix.centre().abs() + matrix.radius()).map(|value| value * (1.0 + 4.0 * f64::EPSILON))
        };
        let right = product(&inverse, &self.right_hand_side, &mut || true)?;
        let absolute = product(&inverse, &self.absolute, &mut || true)?;
        let jumps = product(&inverse, &self.jumps, &mut || true)?;
        Some(Preconditioned {
            defect: sizes(&defect),
            absolute_size: sizes(&absolute),
            jump_size: sizes(&jumps),
            absolute,
            jumps,
            right_hand_side: DVector::from_fn(inverse.nrows(), |row, _| right.entry(row, 0)),
        })
    }
}

/// `x = R b + (I - R A) x - R B |x| + R j tau`.
pub(super) struct Preconditioned {
    /// Upper bounds on `|I - R A|`.
    pub(super) defect: DMatrix<f64>,
    /// `R B`, with upper bounds on its size.
    pub(super) absolute: IntervalMatrix,
    pub(super) absolute_size: DMatrix<f64>,
    /// `R j`, with upper bounds on its size.
    pub(super) jumps: IntervalMatrix,
    pub(super) jump_size: DMatrix<f64>,
    /// `R b`.
    pub(super) right_hand_side: DVector<Interval>,
}
