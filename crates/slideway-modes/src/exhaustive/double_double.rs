//! Numbers as unevaluated sums of two `f64`, with about 104 bits.
//!
//! The relative error of each operation is below [`UNIT`].

use crate::error_free::{ordered_sum_remainder, product_remainder, sum_remainder};

/// Bound on the relative error of one operation: 2^-98, with a margin.
pub(super) const UNIT: f64 = 3.2e-30;

/// `high + low`, with `|low| <= ulp(high)/2`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct DoubleDouble {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl From<f64> for DoubleDouble {
    fn from(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }
}

#[inline(always)]
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: sum_remainder(a, b, high) }
}

#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: ordered_sum_remainder(a, b, high) }
}

#[inline(always)]
fn two_product<const FUSED: bool>(a: f64, b: f64) -> DoubleDouble {
    let high = a * b;
    DoubleDouble { high, low: product_remainder::<FUSED>(a, b, high) }
}

impl DoubleDouble {
    #[inline(always)]
    pub(super) fn plus(self, other: Self) -> Self {
        let high = two_sum(self.high, other.high);
        let low = two_sum(self.low, other.low);
        let sum = quick_two_sum(high.high, high.low + low.high);
        quick_two_sum(sum.high, sum.low + low.low)
    }

    #[inline(always)]
    pub(super) fn minus(self, other: Self) -> Self {
        self.plus(Self { high: -other.high, low: -other.low })
    }

    #[inline(always)]
    pub(super) fn times<const FUSED: bool>(self, other: Self) -> Self {
        let product = two_product::<FUSED>(self.high, other.high);
        quick_two_sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }

    #[inline(always)]
    pub(super) fn over<const FUSED: bool>(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self.minus(other.times::<FUSED>(Self::from(first)));
        let second = rest.high / other.high;
        let rest = rest.minus(other.times::<FUSED>(Self::from(second)));
        quick_two_sum(first, second).plus(Self::from(rest.high / other.high))
    }
}
