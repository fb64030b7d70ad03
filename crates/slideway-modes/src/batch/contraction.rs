//! Contraction of multi-affine forms, axis by axis.

use super::lanes::{ByLane, LANES, Lanes, product_plus};

/// The contraction of one axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    pub(super) parameter: usize,
    pub(super) outer: usize,
    pub(super) inner: usize,
    /// Whether `b^-` is stored beside `b^+`.
    pub(super) split: bool,
}

impl Step {
    pub(super) fn output(self) -> usize {
        2 * self.outer * self.inner
    }
}

/// `b^sigma + mu g^sigma` along one axis, from numbers that are common to all points.
#[inline(always)]
pub(super) fn contract_first<const FUSED: bool>(
    step: Step,
    from: &[f64],
    friction: &Lanes,
    into: &mut [Lanes],
) {
    contract::<FUSED, f64>(step, |at| from[at], friction, into);
}

/// The same, from the result of the previous axis.
#[inline(always)]
pub(super) fn contract_next<const FUSED: bool>(
    step: Step,
    from: &[Lanes],
    friction: &Lanes,
    into: &mut [Lanes],
) {
    contract::<FUSED, &Lanes>(step, |at| &from[at], friction, into);
}

#[inline(always)]
fn contract<const FUSED: bool, T: ByLane>(
    step: Step,
    from: impl Fn(usize) -> T,
    friction: &Lanes,
    into: &mut [Lanes],
) {
    let inner = step.inner;
    let states = if step.split { 4 } else { 3 };
    for outer in 0..step.outer {
        let first = outer * states * inner;
        let slopes = first + (states - 2) * inner;
        let (positive, negative) = into[2 * outer * inner..][..2 * inner].split_at_mut(inner);
        for (at, target) in positive.iter_mut().enumerate() {
            *target = combine::<FUSED>(from(first + at), friction, from(slopes + at));
        }
        for (at, target) in negative.iter_mut().enumerate() {
            let slope = from(slopes + inner + at);
            *target = if step.split {
                combine::<FUSED>(from(first + inner + at), friction, slope)
            } else {
                combine_mirrored::<FUSED>(from(first + at), friction, slope)
            };
        }
    }
}

/// `base + friction slope`
#[inline(always)]
fn combine<const FUSED: bool>(base: impl ByLane, friction: &Lanes, slope: impl ByLane) -> Lanes {
    let mut sum = Lanes::ZERO;
    for lane in 0..LANES {
        sum.0[lane] = product_plus::<FUSED>(friction.0[lane], slope.lane(lane), base.lane(lane));
    }
    sum
}

/// `-base + friction slope`
#[inline(always)]
fn combine_mirrored<const FUSED: bool>(base: impl ByLane, friction: &Lanes, slope: impl ByLane) -> Lanes {
    let mut sum = Lanes::ZERO;
    for lane in 0..LANES {
        sum.0[lane] = product_plus::<FUSED>(friction.0[lane], slope.lane(lane), -base.lane(lane));
    }
    sum
}
