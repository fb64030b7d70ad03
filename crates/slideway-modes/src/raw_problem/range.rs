//! Values to which no floating-point number is close: too large, or so small that digits are lost.

use std::collections::BTreeMap;

use dashu_int::ops::BitTest;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

use crate::certificate::{enclose_sums, solve_part_exactly};
use crate::interval::Interval;
use crate::problem::{ContactState, ModeProblem};

/// The maximum number of unknowns that are solved together for exact values.
pub(super) const TOGETHER: usize = 48;
/// Number of digits of a value reported as text: enough to distinguish floating-point numbers.
const DIGITS: u8 = 17;

/// Whether a rounded value has the full precision of floating-point numbers: it is zero, or neither infinite
/// nor subnormal.
pub(super) fn in_range(value: f64) -> bool {
    value == 0.0 || value.is_normal()
}

/// Exact unknowns of one state: `y_k`, or `lambda_k` in a gap.
pub(super) struct ExactUnknowns<'a> {
    problem: &'a ModeProblem,
    pattern: Vec<ContactState>,
    is_zero: Vec<bool>,
    known: BTreeMap<usize, RBig>,
    sums: BTreeMap<usize, Interval>,
}

impl<'a> ExactUnknowns<'a> {
    /// Of the state with these rounded values, which are zero only where the exact ones are. Elsewhere their signs decide
    /// on the sides, as a set may contain points with free unknowns of either sign.
    pub(super) fn new(problem: &'a ModeProblem, pattern: &[ContactState], signed: &[f64]) -> Self {
        let is_zero = |(value, state): (&f64, &ContactState)| *value == 0.0 && *state != ContactState::Gap;
        let state = |(value, state): (&f64, &ContactState)| match *value {
            value if value > 0.0 => ContactState::Positive,
            value if value < 0.0 => ContactState::Negative,
            _ => *state,
        };
        Self {
            problem,
            pattern: signed.iter().zip(pattern).map(state).collect(),
            is_zero: signed.iter().zip(pattern).map(is_zero).collect(),
            known: BTreeMap::new(),
            sums: BTreeMap::new(),
        }
    }

    /// Returns the exact unknown of a contact. Returns `None` if it takes too much work, or if it is not
    /// unique.
    pub(super) fn of(&mut self, contact: usize) -> Option<RBig> {
        if self.is_zero[contact] {
            return Some(RBig::ZERO);
        }
        if !self.known.contains_key(&contact) {
            let part = solve_part_exactly(self.problem, &self.pattern, &self.is_zero, contact, TOGETHER)?;
            self.known.extend(part);
        }
        self.known.get(&contact).cloned()
    }

    /// Bounds on the sum of a bound and the unknown of a contact, where an exact one takes too much work, given the bounds
    /// and the signs of the unknowns in the sums of all contacts; `None` if its pattern is not regular.
    pub(super) fn enclosed_sum(&mut self, contact: usize, shifts: &[(f64, f64)]) -> Option<Interval> {
        if !self.sums.contains_key(&contact) {
            // Only positive unknowns have a bound added.
            let own = |(shift, state): (&(f64, f64), &ContactState)| match state {
                ContactState::Positive => *shift,
                _ => (0.0, 1.0),
            };
            let shifts: Vec<(f64, f64)> = shifts.iter().zip(&self.pattern).map(own).collect();
            let part = enclose_sums(self.problem, (&self.pattern, &self.is_zero), contact, &shifts)?;
            self.sums.extend(part);
        }
        self.sums.get(&contact).copied()
    }
}

/// The floating-point number nearest to an exact value.
pub(super) fn nearest(value: &RBig) -> f64 {
    value.to_f64().value()
}

/// A value as text, given its sign (zero if that is not known), its rounded size (infinity, or below the least normal
/// number) and, if known, its exact value.
pub(super) fn told(sign: f64, rounded: f64, exact: Option<&RBig>) -> String {
    let minus = if sign < 0.0 { "-" } else { "" };
    match exact {
        Some(size) => format!("{minus}{}", decimal(size)),
        None if rounded.is_finite() && sign == 0.0 => format!("between -{0:e} and {0:e}", f64::MIN_POSITIVE),
        None if rounded.is_finite() => format!("between 0 and {minus}{:e}", f64::MIN_POSITIVE),
        None if sign < 0.0 => format!("less than {:e}", f64::MIN),
        None => format!("more than {:e}", f64::MAX),
    }
}

/// A number as decimal text, rounded to 17 significant digits: "-1.25e310".
fn decimal(value: &RBig) -> String {
    let (numerator, denominator) = (value.numerator(), value.denominator());
    if value.is_zero() {
        return "0".to_owned();
    }
    let size = UBig::try_from(if *numerator < IBig::ZERO { -numerator } else { numerator.clone() });
    let size = size.unwrap_or_default();
    // log10 of the value, or one less.
    let bits = size.bit_len() as f64 - denominator.bit_len() as f64;
    #[expect(clippy::cast_possible_truncation, reason = "numbers of a problem have some thousand bits each")]
    let mut exponent = (bits * std::f64::consts::LOG10_2).floor() as i32 - 1;
    let digits = loop {
        let digits = rounded_quotient(&size, denominator, i32::from(DIGITS) - 1 - exponent).to_string();
        if digits.len() <= usize::from(DIGITS) {
            break digits;
        }
        exponent += 1;
    };
    let (first, rest) = digits.split_at(1);
    let rest = rest.trim_end_matches('0');
    let point = if rest.is_empty() { "" } else { "." };
    let sign = if *numerator < IBig::ZERO { "-" } else { "" };
    format!("{sign}{first}{point}{rest}e{exponent}")
}

/// `one / other 10^power`, rounded to the nearest integer.
fn rounded_quotient(one: &UBig, other: &UBig, power: i32) -> UBig {
    let factor = UBig::from(10_u8).pow(power.unsigned_abs() as usize);
    let (one, other) = if power < 0 { (one.clone(), other * factor) } else { (one * factor, other.clone()) };
    (one * 2_u8 + &other) / (other * 2_u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimal_texts_are_rounded_to_the_nearest() {
        let ratio = |one: i64, other: u64, power: usize| {
            RBig::from_parts(IBig::from(one), UBig::from(other)) * RBig::from(IBig::from(10_u8).pow(power))
        };
        assert_eq!(decimal(&ratio(-5, 4, 310)), "-1.25e310");
        assert_eq!(decimal(&ratio(1, 3, 400)), "3.3333333333333333e399");
        assert_eq!(decimal(&ratio(2, 3, 0)), "6.6666666666666667e-1");
        // It rounds up to the next power of ten.
        assert_eq!(decimal(&ratio(999_999_999_999_999_999, 1, 0)), "1e18");
        assert_eq!(decimal(&(RBig::ONE / ratio(8, 1, 327))), "1.25e-328");
        for exact in [0.1, 123_456_789.0, 5e-324, f64::MAX, 1.0 / 3.0] {
            let text = decimal(&RBig::try_from(exact).expect("finite"));
            assert_eq!(text.parse::<f64>().expect("a number"), exact, "{text}");
        }
    }
}
