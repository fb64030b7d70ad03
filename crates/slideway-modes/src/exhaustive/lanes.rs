//! The same number of several sibling nodes, side by side.
//!
//! Every operation is a branch-free loop of fixed length over plain arrays, which the compiler turns into
//! vector instructions of whatever width the surrounding function may use.

/// Nodes that are processed together.
pub(super) const LANES: usize = 8;

/// One number of each node.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

impl Lanes {
    pub(super) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(super) fn map(self, function: impl Fn(f64) -> f64) -> Self {
        let mut result = [0.0; LANES];
        for lane in 0..LANES {
            result[lane] = function(self.0[lane]);
        }
        Self(result)
    }

    #[inline(always)]
    pub(super) fn zip(self, other: Self, function: impl Fn(f64, f64) -> f64) -> Self {
        let mut result = [0.0; LANES];
        for lane in 0..LANES {
            result[lane] = function(self.0[lane], other.0[lane]);
        }
        Self(result)
    }

    /// `self * factor + term`, with one rounding where the processor has the instruction.
    #[inline(always)]
    pub(super) fn times_plus<const FUSED: bool>(self, factor: Self, term: Self) -> Self {
        let mut result = [0.0; LANES];
        for lane in 0..LANES {
            result[lane] = if FUSED {
                self.0[lane].mul_add(factor.0[lane], term.0[lane])
            } else {
                self.0[lane] * factor.0[lane] + term.0[lane]
            };
        }
        Self(result)
    }

    #[inline(always)]
    pub(super) fn times(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// The larger of both numbers; `self` where `other` is NaN.
    #[inline(always)]
    pub(super) fn larger(self, other: Self) -> Self {
        self.zip(other, |a, b| if b > a { b } else { a })
    }

    /// Where `other` is larger in magnitude.
    #[inline(always)]
    pub(super) fn is_smaller_than(self, other: Self) -> Mask {
        let mut mask = [0; LANES];
        for lane in 0..LANES {
            mask[lane] = u64::from(other.0[lane].abs() > self.0[lane].abs()).wrapping_neg();
        }
        Mask(mask)
    }

    /// Whether all numbers are above zero; NaN is not.
    #[inline(always)]
    pub(super) fn all_positive(self) -> bool {
        let mut all = true;
        for lane in 0..LANES {
            all &= self.0[lane] > 0.0;
        }
        all
    }
}

/// All bits of a lane, or none.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Mask([u64; LANES]);

impl Mask {
    pub(super) const NONE: Self = Self([0; LANES]);

    /// Where this is set and `other` is not.
    #[inline(always)]
    pub(super) fn without(self, other: Self) -> Self {
        let mut result = self;
        for lane in 0..LANES {
            result.0[lane] &= !other.0[lane];
        }
        result
    }

    /// Where either is set.
    #[inline(always)]
    pub(super) fn or(self, other: Self) -> Self {
        let mut result = self;
        for lane in 0..LANES {
            result.0[lane] |= other.0[lane];
        }
        result
    }

    /// `one` where the mask is set, otherwise `other`.
    #[inline(always)]
    pub(super) fn select(self, one: Lanes, other: Lanes) -> Lanes {
        let mut result = [0.0; LANES];
        for lane in 0..LANES {
            let (one, other) = (one.0[lane].to_bits(), other.0[lane].to_bits());
            result[lane] = f64::from_bits(other ^ ((one ^ other) & self.0[lane]));
        }
        Lanes(result)
    }
}
