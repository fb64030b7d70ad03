//! The rounding errors of sums and products, exact except for underflow (Knuth, Dekker).

/// `one + other - sum` without rounding, where `sum` is the rounded sum (Knuth).
#[inline]
pub(crate) fn sum_remainder(one: f64, other: f64, sum: f64) -> f64 {
    let rest = sum - one;
    (one - (sum - rest)) + (other - rest)
}

/// `one other - product` without rounding, where `product` is the rounded product.
#[inline]
pub(crate) fn product_remainder(one: f64, other: f64, product: f64) -> f64 {
    one.mul_add(other, -product)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The oracle are whole numbers of 128 bits.
    #[test]
    #[expect(clippy::cast_possible_truncation, reason = "whole numbers below 2^127")]
    fn rounded_and_remainder_make_the_whole() {
        for (one, other) in
            [(9_007_199_254_740_991_i128, 3_i128), (-(1 << 53) + 1, (1 << 52) + 7), (1, 1 << 60)]
        {
            let [a, b] = [one, other].map(|whole| whole as f64);
            assert_eq!((a as i128, b as i128), (one, other), "numbers that are not rounded");
            let (sum, product) = (a + b, a * b);
            assert_eq!(sum as i128 + sum_remainder(a, b, sum) as i128, one + other);
            assert_eq!(product as i128 + product_remainder(a, b, product) as i128, one * other);
        }
        // (1 + u)(1 - u) = 1 - u^2 is rounded to 1, and 1e16 + 1 to 1e16.
        let unit = f64::from(-30).exp2();
        assert_eq!(product_remainder(1.0 + unit, 1.0 - unit, 1.0), -unit * unit);
        assert_eq!(sum_remainder(1e16, 1.0, 1e16), 1.0);
    }
}
