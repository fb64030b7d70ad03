//! Numbers of several points side by side.
//!
//! Loops over lanes are written out where they are needed, each over plain arrays of one length and without a
//! branch, so that the compiler vectorises them. Eight lanes are too few for that: such loops are unrolled
//! before they are vectorised, and stay scalar.

/// Points that are processed together.
pub(super) const LANES: usize = 32;

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
}

/// A type with a number for each lane.
pub(super) trait ByLane: Copy {
    fn lane(self, lane: usize) -> f64;
}

impl ByLane for f64 {
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
}

impl ByLane for &Lanes {
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
}

/// `a b + c`, with one rounding where the processor has the instruction.
#[inline(always)]
pub(super) fn product_plus<const FUSED: bool>(a: f64, b: f64, c: f64) -> f64 {
    if FUSED { a.mul_add(b, c) } else { a * b + c }
}
