//! Cheap proofs that there is exactly one solution.
//!
//! Without jumps the problem is `N = e - G |N|` (see [`SolvedForm`]). The map on the right is a contraction
//! if the spectral radius of `|G|` or the largest singular value of `G` is below 1 (theory, section 4 (a) and
//! (c)): then every load has exactly one solution.

use nalgebra::{DMatrix, DVector};

use super::propagation::SolvedForm;
use super::report::Method;
use crate::dense::{Lu, Pace, has_cholesky_factor, product};
use crate::problem::{ContactState, ScaledProblem};

/// Singular values are compared with 1 minus this.
const MARGIN: f64 = 1e-8;
/// Number of contraction steps before Newton's method starts.
const CONTRACTIONS: usize = 60;
/// Maximum number of steps of Newton's method.
const NEWTON_STEPS: usize = 60;

/// The argument that proves that there is exactly one solution, if a cheap one does and `proceed` remains
/// `true`.
pub(super) fn proof(
    problem: &ScaledProblem,
    propagation: &SolvedForm,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Method> {
    if problem.has_jump.iter().any(|&jump| jump) {
        return None;
    }
    if propagation.is_contraction() {
        return Some(Method::Contraction);
    }
    singular_values_below_one(propagation, proceed)?.then_some(Method::SingularValue)
}

/// Whether `(1 - delta)^2 I - G^T G` is positive definite, where `delta` covers the error of `G`.
fn singular_values_below_one(propagation: &SolvedForm, proceed: &mut dyn FnMut() -> bool) -> Option<bool> {
    let contacts = propagation.frictionless.len();
    let coupling = &propagation.coupling;
    // sigma_max is at least the norm of any column.
    if coupling.column_iter().any(|column| column.norm() >= 1.0) {
        return Some(false);
    }
    let delta = MARGIN + 2.0 * propagation.slip.norm();
    if delta >= 1.0 {
        return Some(false);
    }
    let bound = DMatrix::from_diagonal_element(contacts, contacts, (1.0 - delta).powi(2));
    let squares = product(&coupling.transpose(), coupling, proceed)?;
    Some(has_cholesky_factor(bound - squares, proceed))
}

/// The pattern of the only solution: the contraction `N <- e - G |N|`, then Newton's method on the pattern.
/// `None` if that does not converge, or once `proceed` is `false`.
pub(super) fn only_pattern(
    problem: &ScaledProblem,
    propagation: &SolvedForm,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<ContactState>> {
    let mut normal_force = propagation.frictionless.clone();
    let mut pace = Pace::new(proceed);
    for _ in 0..CONTRACTIONS {
        if !pace.allows(propagation.coupling.len()) {
            return None;
        }
        normal_force = &propagation.frictionless - &propagation.coupling * normal_force.abs();
    }
    let mut pattern = pattern_of(&normal_force);
    for _ in 0..NEWTON_STEPS {
        let (matrix, right_hand_side) = problem.system(&pattern);
        let y = Lu::new(matrix, proceed)?.solve(&right_hand_side)?;
        let size = y.amax();
        // Where y is negative beyond rounding, the contact is on its other side.
        let wrong: Vec<usize> = (0..pattern.len()).filter(|&k| y[k] < -1e-12 * size).collect();
        if wrong.is_empty() {
            return Some(pattern);
        }
        for contact in wrong {
            pattern[contact] = match pattern[contact] {
                ContactState::Positive => ContactState::Negative,
                _ => ContactState::Positive,
            };
        }
    }
    None
}

fn pattern_of(normal_force: &DVector<f64>) -> Vec<ContactState> {
    let state = |&force: &f64| if force >= 0.0 { ContactState::Positive } else { ContactState::Negative };
    normal_force.iter().map(state).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{IntervalModeProblem, ModeProblem};

    fn proof_of(problem: &ModeProblem) -> Option<Method> {
        let scaled = ScaledProblem::new(problem);
        let load_radius = DVector::zeros(problem.contacts());
        let propagation = SolvedForm::new(&scaled, &load_radius, &mut || true).expect("regular");
        proof(&scaled, &propagation, &mut || true)
    }

    /// `N + B |N| = b`.
    fn equation(coupling: &DMatrix<f64>) -> ModeProblem {
        let load = DVector::from_vec(vec![1.0, -2.0]);
        ModeProblem::from_absolute_value_equation(&DMatrix::identity(2, 2), coupling, load)
            .expect("shapes fit")
    }

    #[test]
    fn singular_values_must_be_below_one() {
        // A rotation times the gain, which is its singular value.
        let (sine, cosine) = 0.7_f64.sin_cos();
        let rotation = DMatrix::from_row_slice(2, 2, &[cosine, -sine, sine, cosine]);
        assert_eq!(proof_of(&equation(&(&rotation * 0.999_999))), Some(Method::SingularValue));
        for gain in [1.0 - 1e-9, 1.0, 1.0 + 1e-9, 1.5] {
            assert_eq!(proof_of(&equation(&(&rotation * gain))), None);
        }
        assert_eq!(proof_of(&equation(&(&rotation * 0.5))), Some(Method::Contraction));
    }

    #[test]
    fn columns_shorter_than_one_prove_nothing() {
        // Both columns have length 0.99, but the largest singular value is 1.4.
        assert_eq!(proof_of(&equation(&DMatrix::from_element(2, 2, 0.7))), None);
    }

    #[test]
    fn jumps_are_no_contraction() {
        // N = -1 + 2 lambda has three states.
        let one = DMatrix::from_element(1, 1, 1.0);
        let load = DVector::from_element(1, -1.0);
        let problem = ModeProblem::new(one.clone(), -&one, &one * 2.0, DMatrix::zeros(1, 1), load);
        assert_eq!(proof_of(&problem.expect("shapes fit")), None);
    }

    #[test]
    fn bounds_of_the_columns_add_to_singular_values() {
        // sigma_max = 0.92 at the midpoint, and 1.02 if the diagonal is reduced by a tenth and the other
        // entries are increased.
        let problem = equation(&DMatrix::from_row_slice(2, 2, &[0.65, 0.65, -0.65, 0.65]));
        for (relative, expected) in [(1e-3, Some(Method::SingularValue)), (0.1, None)] {
            let bounded = IntervalModeProblem::widened(&problem, relative).expect("a sensible radius");
            let scaled = ScaledProblem::within((&bounded).into());
            let propagation = SolvedForm::new(&scaled, &DVector::zeros(2), &mut || true).expect("regular");
            assert_eq!(proof(&scaled, &propagation, &mut || true), expected, "{relative}");
        }
    }
}
