//! Monotone problems: all solutions are those of one pattern, found without a tree.
//!
//! Without jumps the problem is `N = e - G |N|` (see [`SolvedForm`]). If
//!
//! ```text
//! sum_k d_k u_k^+ u_k^- >= 0  for all u with sum_k (c_k^+ u_k^+ + c_k^- u_k^-) = 0
//! ```
//!
//! for some `d > 0`, all solutions are those of one pattern, and if the sum is positive for `u != 0`, there is exactly
//! one for every load (theory, section 4 (c)). With `u_k^+ - u_k^- = N_k`, `u_k^+ + u_k^- = s_k`, so that `N = -G s`,
//! four times the sum is `sum d_k (s_k^2 - (G s)_k^2)`: it is positive exactly if `D^(1/2) G D^(-1/2)` has
//! singular values below 1.
//!
//! - If the spectral radius of `|G|` is below 1, there are `u, v > 0` with `|G| u <= alpha u`,
//!   `|G|^T v <= alpha v` and `alpha < 1` (`u = (I - |G|)^-1 1`, and `v` likewise). With `d_k = v_k / u_k`,
//!   `K = D^(1/2) |G| D^(-1/2)` and `x_k = (u_k v_k)^(1/2)`, `K x <= alpha x` and `K^T x <= alpha x`. So
//!   `K^T K x <= alpha^2 x` for a positive `x`, and no singular value of `K`, hence none of `D^(1/2) G D^(-1/2)`, is
//!   above `alpha`.
//! - `d = 1`: the singular values of `G` itself, in floating point with bounds if they are below 1, otherwise
//!   exactly ([`Monotone`]).

use nalgebra::{DMatrix, DVector};

use super::leaf::Leaves;
use super::lemke::lemke;
use super::load::LoadedProblem;
use super::monitor::Monitor;
use super::propagation::SolvedForm;
use crate::certificate::{Decision, Monotone};
use crate::dense::{Lu, Pace, has_cholesky_factor, product};
use crate::problem::{ContactState, ScaledProblem};

/// Singular values are compared with 1 minus this.
const MARGIN: f64 = 1e-8;
/// Number of contraction steps before Newton's method starts.
const CONTRACTIONS: usize = 60;
/// Maximum number of steps of Newton's method.
const NEWTON_STEPS: usize = 60;
/// A form with an eigenvalue below minus this, compared with `|C^+| |C^-|`, is not tested exactly.
const HOPELESS: f64 = 1e-9;

/// Whether there is exactly one solution for every load, as proven in floating point; `false` once `proceed`
/// is `false`.
pub(super) fn is_strict(
    problem: &ScaledProblem,
    solved: &SolvedForm,
    proceed: &mut dyn FnMut() -> bool,
) -> bool {
    !problem.has_jump.contains(&true)
        && (solved.is_contraction() || singular_values_below_one(solved, proceed) == Some(true))
}

/// A pattern that has all solutions of a problem with exact columns, proven; `None` if the problem is not monotone, if it
/// has no solution, if floating point found no pattern that has one, or once the monitor stops the search.
pub(super) fn pattern_of_all_solutions(
    (loaded, scaled): (&LoadedProblem<'_>, &ScaledProblem),
    leaves: &mut Leaves<'_>,
    monitor: &mut Monitor<'_>,
) -> Option<Vec<ContactState>> {
    let is_candidate = loaded.is_part_of_exact_problem()
        && !scaled.has_jump.contains(&true)
        && may_be_semidefinite(scaled, &mut || monitor.goes_on())?;
    let columns = loaded.view().centre;
    let monotone = is_candidate.then(|| Monotone::prove(columns, &mut || monitor.goes_on()))??;
    let pattern = lemke(scaled, &mut || monitor.goes_on())?;
    match leaves.decide(&pattern, monitor).ok()? {
        // All unknowns are positive: their partners vanish in all solutions.
        Decision::Solution { .. } => Some(pattern),
        Decision::Boundary { zero, .. } => {
            monotone.pattern_of_all_solutions(&pattern, &zero, &mut || monitor.goes_on())
        }
        _ => None,
    }
}

/// Whether `-(C^+ C^-^T + C^- C^+^T)` may be without negative eigenvalues. This only saves work.
fn may_be_semidefinite(problem: &ScaledProblem, proceed: &mut dyn FnMut() -> bool) -> Option<bool> {
    let [positive, negative] = ContactState::PRESSED.map(|state| {
        let columns: Vec<_> = (0..problem.contacts()).map(|contact| problem.column(contact, state)).collect();
        DMatrix::from_columns(&columns)
    });
    let slack = (HOPELESS * positive.norm() * negative.norm()).max(f64::MIN_POSITIVE);
    if positive.component_mul(&negative).column_sum().iter().any(|half| 2.0 * half > slack) {
        return Some(false);
    }
    let half = product(&positive, &negative.transpose(), proceed)?;
    let form = DMatrix::from_diagonal_element(problem.contacts(), problem.contacts(), slack)
        - &half
        - half.transpose();
    Some(has_cholesky_factor(form, proceed))
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

/// The pattern of the only solution: the contraction `N <- e - G |N|`, then Newton's method on the pattern, or
/// Lemke's method if that does not converge. `None` once `proceed` is `false`.
pub(super) fn only_pattern(
    problem: &ScaledProblem,
    solved: &SolvedForm,
    proceed: &mut dyn FnMut() -> bool,
) -> Option<Vec<ContactState>> {
    newton(problem, solved, proceed).or_else(|| lemke(problem, proceed))
}

fn newton(
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

    fn is_proven(problem: &ModeProblem) -> bool {
        let scaled = ScaledProblem::new(problem);
        let load_radius = DVector::zeros(problem.contacts());
        let solved = SolvedForm::new(&scaled, &load_radius, &mut || true).expect("regular");
        is_strict(&scaled, &solved, &mut || true)
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
        for (gain, expected) in
            [(0.5, true), (0.999_999, true), (1.0 - 1e-9, false), (1.0, false), (1.5, false)]
        {
            assert_eq!(is_proven(&equation(&(&rotation * gain))), expected);
        }
    }

    #[test]
    fn columns_shorter_than_one_prove_nothing() {
        // Both columns have length 0.99, but the largest singular value is 1.4.
        assert!(!is_proven(&equation(&DMatrix::from_element(2, 2, 0.7))));
    }

    #[test]
    fn jumps_are_no_contraction() {
        // N = -1 + 2 lambda has three states.
        let one = DMatrix::from_element(1, 1, 1.0);
        let load = DVector::from_element(1, -1.0);
        let problem = ModeProblem::new(one.clone(), -&one, &one * 2.0, DMatrix::zeros(1, 1), load);
        assert!(!is_proven(&problem.expect("shapes fit")));
    }

    #[test]
    fn bounds_of_the_columns_add_to_singular_values() {
        // sigma_max = 0.92 at the midpoint, and 1.02 if the diagonal is reduced by a tenth and the other
        // entries are increased.
        let problem = equation(&DMatrix::from_row_slice(2, 2, &[0.65, 0.65, -0.65, 0.65]));
        for (relative, expected) in [(1e-3, true), (0.1, false)] {
            let bounded = IntervalModeProblem::widened(&problem, relative).expect("a sensible radius");
            let scaled = ScaledProblem::within((&bounded).into());
            let solved = SolvedForm::new(&scaled, &DVector::zeros(2), &mut || true).expect("regular");
            assert_eq!(is_strict(&scaled, &solved, &mut || true), expected, "{relative}");
        }
    }
}
