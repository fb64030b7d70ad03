//! The rounding errors of sums and products, exact except for underflow (Knuth, Dekker, Veltkamp).

#![expect(clippy::inline_always, reason = "what is not inlined is compiled without the chosen instructions")]

/// `one + other - sum` without rounding, where `sum` is the rounded sum (Knuth).
#[inline(always)]
pub(crate) fn sum_remainder(one: f64, other: f64, sum: f64) -> f64 {
    let rest = sum - one;
    (one - (sum - rest)) + (other - rest)
}

/// As [`sum_remainder`] where `|one| >= |other|` (Dekker).
#[inline(always)]
pub(crate) fn ordered_sum_remainder(one: f64, other: f64, sum: f64) -> f64 {
    other - (sum - one)
}

/// `one other - product` without rounding, where `product` is the rounded product: with or without a fused
/// operation (Dekker).
#[inline(always)]
pub(crate) fn product_remainder<const FUSED: bool>(one: f64, other: f64, product: f64) -> f64 {
    if FUSED {
        return one.mul_add(other, -product);
    }
    let ((a_high, a_low), (b_high, b_low)) = (split(one), split(other));
    ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// The two halves of a number, each short enough for exact products (Veltkamp).
#[inline(always)]
fn split(value: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * value;
    let high = scaled - (scaled - value);
    (high, value - high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of 27 bits, whose sums and products two `f64` hold exactly.
    #[test]
    fn rounded_and_remainder_make_the_whole() {
        let unit = f64::from(-30).exp2();
        for (one, other) in [(1.0 + unit, 1.0 - unit), (3.0, unit), (-1.0 / 3.0, 1.0 / 3.0), (1e16, 1.0)] {
            let sum = one + other;
            assert_eq!(sum_remainder(one, other, sum), sum_remainder(other, one, sum));
            assert_eq!(ordered_sum_remainder(one, other, sum), sum_remainder(one, other, sum));
            let product = one * other;
            assert_eq!(
                product_remainder::<true>(one, other, product),
                product_remainder::<false>(one, other, product)
            );
        }
        // (1 + u)(1 - u) = 1 - u^2 is rounded to 1, and 1e16 + 1 to 1e16.
        assert_eq!(product_remainder::<false>(1.0 + unit, 1.0 - unit, 1.0), -unit * unit);
        assert_eq!(sum_remainder(1e16, 1.0, 1e16), 1.0);
    }
}
