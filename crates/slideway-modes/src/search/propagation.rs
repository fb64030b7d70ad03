//! Interval propagation: bounds on all normal forces, and the sides that they permit.
//!
//! With `A = (c^+ - c^-) / 2` and `B = (c^+ + c^-) / 2`, both versions of every column are
//! `c_k^{sigma} = sigma A_k + B_k`, exactly, and the mode problem is
//!
//! ```text
//! A N + B |N| = N(0) + sum_k d_k^- + sum_k lambda_k (d_k^+ - d_k^-),
//! N = e + J lambda - G |N|,    e = A^-1 (N(0) + sum d^-),   J = A^-1 (d^+ - d^-),   G = A^-1 B
//! ```
//!
//! (theory, section 4 (a): if `c_k^{sigma} = sigma e_k - mu_k s_k eta_k` is the same on both sides, `G` is
//! the matrix `B` there). `A^-1` is known only up to rounding; its error is bounded by `slip`, which enters
//! every bound.

use nalgebra::{DMatrix, DVector};

use super::UNDERFLOW;
use super::states::StateSet;
use crate::dense::{Lu, Pace, inverse, product};
use crate::problem::{ContactState, ScaledProblem};

/// Bounds are widened by this fraction of the sum of their terms' sizes, far above rounding.
const MARGIN: f64 = 1e-10;
/// Results computed from positive terms only are verified up to this fraction.
const VERIFIED: f64 = 1e-11;
/// Sweeps continue while some bound shrinks by this fraction.
const WORTHWHILE: f64 = 0.05;
/// The most sweeps at one node.
const SWEEPS: usize = 20;

/// The mode problem solved for `N`.
#[derive(Debug)]
pub(super) struct SolvedForm {
    /// `e`.
    pub(super) frictionless: DVector<f64>,
    /// `G`.
    pub(super) coupling: DMatrix<f64>,
    /// `J`.
    jumps: DMatrix<f64>,
    /// Bound on the error of `N - e - J lambda + G |N|` per unit of each `|N_k|`.
    pub(super) slip: DMatrix<f64>,
    /// Bound on the error of `e + J lambda`.
    offset_error: DVector<f64>,
    /// Bounds on all `|N_k|`, infinite where none is known.
    pub(super) largest: Vec<f64>,
    has_jump: Vec<bool>,
}

impl SolvedForm {
    /// The form for all right-hand sides within `load_radius`; `None` if `A` is singular, or once `proceed`
    /// is `false`.
    pub(super) fn new(
        problem: &ScaledProblem,
        load_radius: &DVector<f64>,
        proceed: &mut dyn FnMut() -> bool,
    ) -> Option<Self> {
        let contacts = problem.contacts();
        let columns = |state| {
            let columns: Vec<_> = (0..contacts).map(|contact| problem.column(contact, state)).collect();
            DMatrix::from_columns(&columns)
        };
        let (positive, negative) = (columns(ContactState::Positive), columns(ContactState::Negative));
        let a = (&positive - &negative) / 2.0;
        let b = (positive + negative) / 2.0;
        let inverse = inverse(a.clone(), proceed)?;
        let coupling = product(&inverse, &b, proceed)?;
        let residual = (product(&inverse, &a, proceed)? - DMatrix::<f64>::identity(contacts, contacts)).abs();
        let rounding = (contacts + 4) as f64 * f64::EPSILON;
        let sizes = inverse.abs();
        let mut slip = residual + product(&sizes, &(a.abs() + b.abs()), proceed)? * (2.0 * rounding);
        slip.add_scalar_mut(UNDERFLOW);
        if let Some(spread) = problem.spread_of_columns() {
            slip += product(&sizes, &spread, proceed)? * 1.01;
        }
        let frictionless = &inverse * problem.base();
        let jump_difference = -columns(ContactState::Gap);
        let offset_error = &sizes * (problem.load_size() * (4.0 * rounding) + load_radius * 1.01);
        let offset_error = offset_error.add_scalar(UNDERFLOW);
        if !slip.iter().chain(&frictionless).all(|value| value.is_finite()) {
            return None;
        }
        let mut propagation = Self {
            frictionless,
            coupling,
            jumps: product(&inverse, &jump_difference, proceed)?,
            slip,
            offset_error,
            largest: vec![f64::INFINITY; contacts],
            has_jump: problem.has_jump.clone(),
        };
        if let Some(largest) = propagation.contraction_bound(proceed) {
            propagation.largest = largest;
        }
        Some(propagation)
    }

    /// `|N| <= u` for a positive `u` with `|e| + sum |J| + |G| u <= u`, which exists if the spectral radius
    /// of `|G|` is below 1, and proves that it is.
    fn contraction_bound(&self, proceed: &mut dyn FnMut() -> bool) -> Option<Vec<f64>> {
        let contacts = self.frictionless.len();
        let gain = self.coupling.abs() + &self.slip;
        let load = self.frictionless.abs() + self.jumps.abs().column_sum() + &self.offset_error;
        let load = load.map(|size| size + MARGIN * load.amax().max(UNDERFLOW.sqrt()));
        let widened = &load * (1.0 + MARGIN);
        let matrix = DMatrix::identity(contacts, contacts) - &gain * (1.0 + MARGIN);
        let bound = Lu::new(matrix, proceed)?.solve(&widened)?;
        let needed = &gain * &bound + &load;
        // Far more than the rounding error of `needed`, whose terms are all positive.
        let holds = bound
            .iter()
            .zip(&needed)
            .all(|(&bound, &needed)| bound > 0.0 && needed * (1.0 + VERIFIED) < bound);
        holds.then(|| bound.as_slice().to_vec())
    }

    /// Whether the spectral radius of `|G|` is proven to be below 1.
    pub(super) fn is_contraction(&self) -> bool {
        self.largest.iter().all(|largest| largest.is_finite())
    }

    /// Removes states that no normal force within its bounds can take, until nothing changes. Returns `false`
    /// if a contact is left without a state. Once `proceed` is `false`, some states may remain that could be
    /// removed.
    pub(super) fn fix_sides(&self, states: &mut [StateSet], proceed: &mut dyn FnMut() -> bool) -> bool {
        let mut pace = Pace::new(proceed);
        let mut bounds: Vec<(f64, f64)> = self.largest.iter().map(|&largest| (0.0, largest)).collect();
        for _ in 0..SWEEPS {
            let mut progress = false;
            for contact in 0..states.len() {
                if !pace.allows(states.len()) {
                    return true;
                }
                let (least, most) = self.normal_force(contact, states, &bounds);
                let before = (states[contact], bounds[contact]);
                let after = narrowed(before.0, before.1, (least, most));
                if after.0.is_empty() {
                    return false;
                }
                (states[contact], bounds[contact]) = after;
                let (shrunk, old) = (after.1.1 - after.1.0, before.1.1 - before.1.0);
                progress |= after.0 != before.0 || shrunk < (1.0 - WORTHWHILE) * old;
            }
            if !progress {
                break;
            }
        }
        true
    }

    /// Bounds on `N_i = e_i + sum_k J_ik lambda_k - sum_k G_ik y_k`, from the bounds on the `y_k`.
    fn normal_force(&self, contact: usize, states: &[StateSet], bounds: &[(f64, f64)]) -> (f64, f64) {
        let center = self.frictionless[contact];
        let (mut least, mut most, mut size) = (center, center, center.abs());
        let mut slip = self.offset_error[contact];
        for other in 0..states.len() {
            if self.has_jump[other] {
                let jump = self.jumps[(contact, other)];
                let (from, to) = states[other].share();
                least += (jump * from).min(jump * to);
                most += (jump * from).max(jump * to);
                size += jump.abs();
            }
            let (gain, miss) = (-self.coupling[(contact, other)], self.slip[(contact, other)]);
            let (from, to) = bounds[other];
            if gain != 0.0 {
                least += (gain * from).min(gain * to);
                most += (gain * from).max(gain * to);
                size += gain.abs() * to;
            }
            if miss != 0.0 {
                slip += miss * to;
            }
        }
        let margin = slip + MARGIN * size;
        if margin.is_finite() { (least - margin, most + margin) } else { (f64::NEG_INFINITY, f64::INFINITY) }
    }
}

/// The states of a contact, and the bounds on its `y`, that a range of its normal force permits.
fn narrowed(states: StateSet, y: (f64, f64), force: (f64, f64)) -> (StateSet, (f64, f64)) {
    let (least, most) = force;
    let mut left = states;
    if most < 0.0 {
        left = left.without(ContactState::Positive).without(ContactState::Gap);
    }
    if least > 0.0 {
        left = left.without(ContactState::Negative).without(ContactState::Gap);
    }
    let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
    for state in left.iter() {
        let (from, to) = match state {
            ContactState::Positive => (least.max(0.0), most),
            ContactState::Negative => ((-most).max(0.0), -least),
            ContactState::Gap => (0.0, 0.0),
        };
        low = low.min(from);
        high = high.max(to);
    }
    (left, (low.max(y.0), high.min(y.1)))
}

#[cfg(test)]
mod tests {
    use super::super::states::all_states;
    use super::super::test_problems::{Numbers, admitted, holds};
    use super::*;
    use crate::problem::{IntervalModeProblem, ModeProblem};

    #[test]
    fn all_solutions_are_within_the_bounds() {
        let (mut bounded, mut decided) = (0, 0);
        for seed in 0..400 {
            let mut numbers = Numbers::new(seed);
            let problem = numbers.problem(3, 0.4, seed % 2 == 0);
            let radius = if seed % 3 == 0 { 0.2 } else { 0.0 };
            let scaled = ScaledProblem::new(&problem);
            let load_radius = scaled.scaled_load_radius(&DVector::repeat(3, radius));
            let Some(propagation) = SolvedForm::new(&scaled, &load_radius, &mut || true) else { continue };
            bounded += usize::from(propagation.is_contraction());
            let nearby = numbers.with_load_off_by(&problem, radius);
            let mut states = all_states(&scaled);
            let possible = propagation.fix_sides(&mut states, &mut || true);
            decided += states.iter().filter(|states| states.decided().is_some()).count();
            for (pattern, unknowns) in admitted(&nearby) {
                assert!(possible && holds(&states, &pattern), "seed {seed} {problem:?}");
                for (contact, value) in unknowns.iter().enumerate() {
                    let y = if pattern[contact] == ContactState::Gap { 0.0 } else { *value };
                    let most = propagation.largest[contact] * scaled.load_unit;
                    assert!(y <= most * (1.0 + 1e-9), "seed {seed} {problem:?}");
                }
            }
        }
        assert!(bounded > 100 && decided > 200, "{bounded} {decided}");
    }

    #[test]
    fn bounds_of_the_columns_add_to_the_gain() {
        let coupling = DMatrix::from_element(2, 2, 0.45);
        let (identity, load) = (DMatrix::identity(2, 2), DVector::from_vec(vec![1.0, -2.0]));
        let problem =
            ModeProblem::from_absolute_value_equation(&identity, &coupling, load).expect("shapes fit");
        // The spectral radius is 0.9 at the midpoint, and 1 where all coefficients are as large as a tenth
        // permits.
        for (relative, expected) in [(1e-3, true), (0.1, false)] {
            let bounded = IntervalModeProblem::widened(&problem, relative).expect("a sensible radius");
            let scaled = ScaledProblem::within((&bounded).into());
            let propagation = SolvedForm::new(&scaled, &DVector::zeros(2), &mut || true).expect("regular");
            assert_eq!(propagation.is_contraction(), expected, "{relative}");
        }
    }

    #[test]
    fn coupling_of_gain_one_is_no_contraction() {
        for (other, expected) in [(0.49, true), (0.5, false), (0.6, false)] {
            let coupling = DMatrix::from_row_slice(2, 2, &[0.5, 0.5, other, 0.5]);
            let (identity, load) = (DMatrix::identity(2, 2), DVector::from_vec(vec![1.0, -2.0]));
            let problem = ModeProblem::from_absolute_value_equation(&identity, &coupling, load);
            let scaled = ScaledProblem::new(&problem.expect("shapes fit"));
            let propagation = SolvedForm::new(&scaled, &DVector::zeros(2), &mut || true).expect("regular");
            assert_eq!(propagation.is_contraction(), expected);
        }
    }
}
