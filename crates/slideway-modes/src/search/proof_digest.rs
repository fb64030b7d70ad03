//! The digest of a problem, by which a proof file says whose proof it is.
//!
//! All numbers, one after the other, are the digits of a number in a large base, modulo the prime `2^61 - 1`: columns of
//! the positive and of the negative sides, jumps of both, and the right-hand side. A number `m 2^e` is well defined modulo
//! the prime, and so is a sum of such numbers, without rounding.

use crate::certificate::mantissa_and_exponent;
use crate::problem::{ProblemView, Side};

/// `2^61 - 1`.
const PRIME: u64 = (1 << 61) - 1;
/// The base: any number without a pattern.
const BASE: u64 = 0x1234_5678_9abc_def1;

/// The digest of a problem with exact numbers.
pub(super) fn digest(view: ProblemView<'_>) -> u64 {
    let mut sum = view.contacts() as u64;
    let mut add = |number: u64| sum = (times(sum, BASE) + number) % PRIME;
    for side in Side::BOTH {
        for contact in 0..view.contacts() {
            for row in 0..view.contacts() {
                let terms = view.column(contact, side).terms().map(|term| residue(term.centre[row]));
                add(terms.fold(0, |sum, term| (sum + term) % PRIME));
            }
        }
    }
    for side in Side::BOTH {
        for contact in 0..view.contacts() {
            view.jump(contact, side).centre.iter().for_each(|&entry| add(residue(entry)));
        }
    }
    view.load().centre.iter().for_each(|&entry| add(residue(entry)));
    sum
}

/// A floating-point number modulo the prime.
fn residue(value: f64) -> u64 {
    let (mantissa, exponent) = mantissa_and_exponent(value);
    // 2^61 is 1.
    let power = 1_u64 << exponent.rem_euclid(61).unsigned_abs();
    let size = times(mantissa.unsigned_abs() % PRIME, power);
    if mantissa < 0 && size > 0 { PRIME - size } else { size }
}

fn times(one: u64, other: u64) -> u64 {
    let product = u128::from(one) * u128::from(other) % u128::from(PRIME);
    u64::try_from(product).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residues_are_those_of_fractions() {
        // 1/2 is the number whose double is 1 modulo the prime.
        assert_eq!(2 * residue(0.5) % PRIME, 1);
        assert_eq!((residue(-0.75) + residue(0.75)) % PRIME, 0);
        assert_eq!(residue(2.0_f64.powi(61)), 1);
        assert_eq!(
            (residue(0.1) + residue(0.2)) % PRIME,
            (residue(0.1 + 0.2) + PRIME - residue(2.0_f64.powi(-55))) % PRIME
        );
    }
}
