//! Numbers of several points side by side, and the instructions that work on them.

/// Points that are treated together.
pub(super) const LANES: usize = 8;

/// One number of each of [`LANES`] points.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

impl Lanes {
    pub(super) const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    pub(super) fn splat(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    pub(super) fn abs(mut self) -> Self {
        for value in &mut self.0 {
            *value = value.abs();
        }
        self
    }

    /// The larger one; what is not a number stays so.
    #[inline(always)]
    pub(super) fn max(mut self, other: &Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(&other.0) {
            *value = if *value > *other || value.is_nan() { *value } else { *other };
        }
        self
    }

    #[inline(always)]
    pub(super) fn plus(mut self, other: &Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(&other.0) {
            *value += other;
        }
        self
    }

    #[inline(always)]
    pub(super) fn times(mut self, other: &Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(&other.0) {
            *value *= other;
        }
        self
    }

    #[inline(always)]
    pub(super) fn negated(mut self) -> Self {
        for value in &mut self.0 {
            *value = -*value;
        }
        self
    }

    /// `self + factor * other`, with one rounding where the processor has the instruction.
    #[inline(always)]
    pub(super) fn plus_product<const FUSED: bool>(mut self, factor: &Self, other: &Self) -> Self {
        for ((value, factor), other) in self.0.iter_mut().zip(&factor.0).zip(&other.0) {
            *value = if FUSED { factor.mul_add(*other, *value) } else { *value + factor * other };
        }
        self
    }

    /// `self - factor * other`, likewise.
    #[inline(always)]
    pub(super) fn minus_product<const FUSED: bool>(mut self, factor: &Self, other: &Self) -> Self {
        for ((value, factor), other) in self.0.iter_mut().zip(&factor.0).zip(&other.0) {
            *value = if FUSED { (-factor).mul_add(*other, *value) } else { *value - factor * other };
        }
        self
    }
}
