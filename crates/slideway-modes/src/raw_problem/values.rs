//! The values of one solution: floating-point numbers, and exact values beyond their range.

use std::collections::BTreeMap;

use dashu_ratio::RBig;

use super::correspondence::{Correspondence, Quantity};
use super::range::{ExactUnknowns, in_range, nearest, told};
use super::report::{BeyondRange, GapShare, RawUnknown};
use super::residual::{Equations, exact};
use crate::interval::Interval;
use crate::problem::ContactState;
use crate::search::CombinedState;

/// Signed values `N` and shares of a state. A value beyond the range of floating-point numbers is infinite or
/// subnormal, with its sign.
pub(super) struct Values {
    pub(super) signed: Vec<f64>,
    /// Unknowns of the problem that are sums of a bound and a value, from exact ones.
    pub(super) sums: Sums,
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
        Self { signed, sums: Sums::default(), gaps: gaps.collect(), beyond: Vec::new() }
    }

    /// Replaces values that the search did not find with full precision, and sums that lose digits, by the numbers nearest
    /// to the exact values, and reports the unknowns that have no such number.
    pub(super) fn settle(
        &mut self,
        correspondence: &Correspondence,
        exact_unknowns: &mut ExactUnknowns<'_>,
    ) -> Vec<BeyondRange> {
        let mut told_of = Vec::new();
        let is_sum: Vec<bool> = self
            .signed
            .iter()
            .enumerate()
            .map(|(at, &value)| correspondence.loses_digits(at, value))
            .collect();
        if is_sum.contains(&true) {
            // What is coupled to such a sum has lost the same digits.
            self.round_exactly(exact_unknowns);
        }
        for (at, is_sum) in is_sum.into_iter().enumerate() {
            let value = self.signed[at];
            if in_range(value) && !is_sum {
                continue;
            }
            let exact = exact_unknowns.of(at);
            match &exact {
                Some(exact) if is_sum => self.sums.insert(correspondence, at, exact),
                None if is_sum => self.sums.enclose(correspondence, at, exact_unknowns),
                _ => {}
            }
            if let Some(value) = exact.as_ref().map(nearest).filter(|value| value.is_normal()) {
                self.signed[at] = value.copysign(self.signed[at]);
            }
            let quantities = correspondence.quantities(at, value);
            told_of.extend(beyond_range(&quantities, self.signed[at], self.sums.value(at), exact.as_ref()));
            if !in_range(self.signed[at]) {
                self.beyond.push((at, exact));
            }
        }
        for gap in self.gaps.iter_mut().filter(|gap| !in_range(gap.lambda)) {
            let exact = exact_unknowns.of(gap.index);
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

    /// Replaces all values by the numbers nearest to the exact ones, as far as these take little work.
    pub(super) fn round_exactly(&mut self, exact_unknowns: &mut ExactUnknowns<'_>) {
        for (at, value) in self.signed.iter_mut().enumerate().filter(|(_, value)| **value != 0.0) {
            let nearest = exact_unknowns.of(at).as_ref().map(nearest);
            if let Some(nearest) = nearest.filter(|nearest| nearest.is_normal()) {
                *value = nearest.copysign(*value);
            }
        }
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
        let mut exact_signed: Vec<Option<RBig>> = self.signed.iter().map(|&value| exact(value)).collect();
        let mut exact_shares: Vec<Option<RBig>> = shares.iter().map(|&value| exact(value)).collect();
        for (at, value) in &self.beyond {
            let value = value.clone()?;
            if pattern[*at] == ContactState::Gap {
                exact_shares[*at] = Some(value);
            } else {
                exact_signed[*at] = Some(if self.signed[*at] < 0.0 { -value } else { value });
            }
        }
        let [signed, shares] =
            [exact_signed, exact_shares].map(|values| values.into_iter().collect::<Option<Vec<RBig>>>());
        equations.exact_residual(&signed?, &shares?)
    }
}

/// The unknowns that have no floating-point number because one of the mode problem has none, or because a sum has none:
/// given the rounded and perhaps the exact size of the former, and the latter, if it was computed.
fn beyond_range(
    quantities: &[Quantity],
    signed: f64,
    sum: Option<f64>,
    size: Option<&RBig>,
) -> Vec<BeyondRange> {
    let is_beyond = |quantity: &&Quantity| match sum {
        Some(sum) => !in_range(sum),
        // A bound and a number too small to matter have a floating-point number near.
        None => !in_range(signed) && (quantity.shift == 0.0 || signed.is_infinite()),
    };
    let told_of = |quantity: &Quantity| {
        let &Quantity { name, index, sign, shift } = quantity;
        let value = size.and_then(|size| Some(exact(shift)? + exact(sign)? * size));
        let sign = value.as_ref().map_or(sign, |value| if *value < RBig::ZERO { -1.0 } else { 1.0 });
        let size = value.map(|value| if sign < 0.0 { -value } else { value });
        BeyondRange { name, index, value: told(sign, signed, size.as_ref()) }
    };
    quantities.iter().filter(is_beyond).map(told_of).collect()
}

/// Unknowns of the problem that are a bound and a value of its mode problem, each rounded once, by contact.
#[derive(Default)]
pub(super) struct Sums(BTreeMap<usize, (f64, f64)>);

impl Sums {
    /// Those of a point that lose digits, and that have few enough unknowns for an exact value.
    pub(super) fn of_point(
        correspondence: &Correspondence,
        signed: &[f64],
        mut exact: ExactUnknowns<'_>,
    ) -> Self {
        let mut sums = Self::default();
        for (contact, &value) in signed.iter().enumerate() {
            if correspondence.loses_digits(contact, value)
                && let Some(size) = exact.of(contact)
            {
                sums.insert(correspondence, contact, &size);
            }
        }
        sums
    }

    /// Adds the one of a contact with this exact value.
    pub(super) fn insert(&mut self, correspondence: &Correspondence, contact: usize, size: &RBig) {
        if let Some((bound, sign)) = correspondence.shift(contact)
            && let (Some(bound), Some(sign)) = (exact(bound), exact(sign))
        {
            let exact_sum = bound + sign * size;
            let value = match nearest(&exact_sum) {
                // A sum that is not zero is told as one too small for a number, and never as zero.
                0.0 if !exact_sum.is_zero() => f64::from_bits(1),
                value => value,
            };
            // A sum beyond the range of numbers is told by its digits.
            let error = exact(value).map_or(RBig::ZERO, |value| exact_sum - value);
            self.0.insert(contact, (value, Interval::around_ratio(&error).magnitude()));
        }
    }

    /// Adds the one of a contact whose exact value takes too much work, within bounds.
    fn enclose(&mut self, correspondence: &Correspondence, contact: usize, exact: &mut ExactUnknowns<'_>) {
        if let Some(bounds) = exact.enclosed_sum(contact, &correspondence.shifts()) {
            let middle = bounds.middle();
            self.0.insert(contact, (middle, (bounds - Interval::point(middle)).magnitude()));
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The sum of a contact.
    pub(super) fn value(&self, contact: usize) -> Option<f64> {
        self.0.get(&contact).map(|(value, _)| *value)
    }

    /// The greatest rounding error of those within the range of floating-point numbers.
    pub(super) fn error(&self) -> f64 {
        self.0.values().filter(|(value, _)| in_range(*value)).fold(0.0, |most, (_, error)| most.max(*error))
    }
}
