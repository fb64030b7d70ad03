//! The values of one solution: floating-point numbers, and exact values beyond their range.

use dashu_ratio::RBig;

use super::correspondence::{Correspondence, Quantity};
use super::range::{exact_unknown, in_range, nearest, told};
use super::report::{BeyondRange, GapShare, RawUnknown};
use super::residual::{Equations, exact};
use crate::problem::{ContactState, ModeProblem};
use crate::search::CombinedState;

/// Signed values `N` and shares of a state. A value beyond the range of floating-point numbers is infinite or
/// subnormal, with its sign.
pub(super) struct Values {
    pub(super) signed: Vec<f64>,
    pub(super) gaps: Vec<GapShare>,
    /// The exact sizes, or shares, of unknowns beyond the range; `None` if they are not known.
    beyond: Vec<(usize, Option<RBig>)>,
}

impl Values {
    pub(super) fn new(state: &CombinedState<'_>, size: usize) -> Self {
        let signed =
            state.normal_force(size).map_or_else(|| vec![0.0; size], |force| force.as_slice().to_vec());
        let gaps =
            state.shares().into_iter().map(|share| GapShare { index: share.contact, lambda: share.lambda });
        Self { signed, gaps: gaps.collect(), beyond: Vec::new() }
    }

    /// Replaces values that the search did not find with full precision by the numbers nearest to the exact
    /// values, and reports the unknowns that have no such number.
    pub(super) fn settle(
        &mut self,
        correspondence: &Correspondence,
        problem: &ModeProblem,
        pattern: &[ContactState],
    ) -> Vec<BeyondRange> {
        let mut told_of = Vec::new();
        for at in (0..self.signed.len()).filter(|&at| !in_range(self.signed[at])).collect::<Vec<_>>() {
            let exact = exact_unknown(problem, pattern, at);
            if let Some(value) = exact.as_ref().map(nearest).filter(|value| value.is_normal()) {
                self.signed[at] = value.copysign(self.signed[at]);
                continue;
            }
            told_of.extend(beyond_range(
                &correspondence.quantities(at, self.signed[at]),
                self.signed[at],
                exact.as_ref(),
            ));
            self.beyond.push((at, exact));
        }
        for gap in self.gaps.iter_mut().filter(|gap| !in_range(gap.lambda)) {
            let exact = exact_unknown(problem, pattern, gap.index);
            if let Some(value) = exact.as_ref().map(nearest).filter(|value| value.is_normal()) {
                gap.lambda = value;
                continue;
            }
            let value = told(1.0, gap.lambda, exact.as_ref());
            told_of.push(BeyondRange { name: RawUnknown::Lambda, index: gap.index, value });
            self.beyond.push((gap.index, exact));
            gap.lambda = f64::NAN;
        }
        told_of
    }

    /// The residual of these values in the equations; `None` if one of them is not known.
    pub(super) fn residual(&self, equations: &Equations<'_>, pattern: &[ContactState]) -> Option<f64> {
        let share = |(at, state): (usize, &ContactState)| match state {
            ContactState::Positive => Some(1.0),
            ContactState::Negative => Some(0.0),
            ContactState::Gap => self.gaps.iter().find(|gap| gap.index == at).map(|gap| gap.lambda),
        };
        let shares = pattern.iter().enumerate().map(share).collect::<Option<Vec<f64>>>()?;
        let plain = || equations.residual(&self.signed, &shares);
        if let Some(residual) = Some(()).filter(|()| self.beyond.is_empty()).and_then(|()| plain()) {
            return Some(residual);
        }
        let mut exact_signed: Vec<RBig> = self.signed.iter().map(|&value| exact(value)).collect();
        let mut exact_shares: Vec<RBig> = shares.iter().map(|&value| exact(value)).collect();
        for (at, value) in &self.beyond {
            let value = value.clone()?;
            if pattern[*at] == ContactState::Gap {
                exact_shares[*at] = value;
            } else {
                exact_signed[*at] = if self.signed[*at] < 0.0 { -value } else { value };
            }
        }
        Some(equations.exact_residual(&exact_signed, &exact_shares))
    }
}

/// The unknowns that have no floating-point number because one of the mode problem has none, given its rounded
/// and perhaps its exact size.
fn beyond_range(quantities: &[Quantity], signed: f64, size: Option<&RBig>) -> Vec<BeyondRange> {
    // A bound and a number too small to matter have a floating-point number near.
    let is_beyond = |quantity: &&Quantity| quantity.shift == 0.0 || signed.is_infinite();
    let told_of = |quantity: &Quantity| {
        let &Quantity { name, index, sign, shift } = quantity;
        // |shift + sign size|, which has the sign of the second term.
        let size = size.map(|size| exact(sign * shift) + size);
        BeyondRange { name, index, value: told(sign, signed, size.as_ref()) }
    };
    quantities.iter().filter(is_beyond).map(told_of).collect()
}
