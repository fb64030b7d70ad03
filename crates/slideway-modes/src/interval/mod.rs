//! Closed intervals with outward rounding, and the arithmetic that they share with plain numbers.
//!
//! Sums, products, quotients and square roots are rounded using the exact remainder. The other functions
//! widen the results of the platform's mathematical library, see below.
//!
//! # Elementary functions
//! The library's results are assumed to be within two units in the last place, and are widened by at least
//! three. The libraries of glibc, musl, macOS and Windows stay within one for the functions used here, and
//! within two for `sinh`, `cosh` and `tanh` (Gladman et al., Accuracy of Mathematical Functions in Single,
//! Double, Extended Double and Quadruple Precision, 2024).
//!
//! # Files
//! `interval` contains closed intervals, their elementary functions, and the trait `Real` for the arithmetic
//! that they share with `f64`; `Sloped` adds bounds on a slope. Formulas, mechanisms, configurations and the
//! rows of the kinetic equations are generic over it (`f64` by default), so that `enclosure` evaluates and
//! assembles with the code of the other stages. Only the interval Newton operator for the positions and the
//! verified linear systems (`modes::certificate::enclose_solution`) are separate.

/// Differences, sums and assignments, from the other operations.
macro_rules! arithmetic_that_follows {
    ($number:ty) => {
        impl Sub for $number {
            type Output = Self;

            fn sub(self, other: Self) -> Self {
                self + -other
            }
        }

        impl AddAssign for $number {
            fn add_assign(&mut self, other: Self) {
                *self = *self + other;
            }
        }

        impl SubAssign for $number {
            fn sub_assign(&mut self, other: Self) {
                *self = *self - other;
            }
        }

        impl MulAssign for $number {
            fn mul_assign(&mut self, other: Self) {
                *self = *self * other;
            }
        }

        impl DivAssign for $number {
            fn div_assign(&mut self, divisor: Self) {
                *self = *self / divisor;
            }
        }

        impl Sum for $number {
            fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
                terms.fold(Zero::zero(), Add::add)
            }
        }
    };
}

mod functions;
mod real;
mod sloped;

pub use real::Real;
pub use sloped::Sloped;

use crate::error_free::{product_remainder, sum_remainder};
use num_traits::Zero;
use std::f64::consts::PI;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// Below this size, the remainder of a product or quotient may itself be rounded.
const REMAINDER_IS_EXACT: f64 = f64::MIN_POSITIVE * (1_u64 << 60) as f64 * (1_u64 << 60) as f64;

/// The sign of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Sign {
    /// Below zero.
    Negative,
    /// Exactly zero.
    Zero,
    /// Above zero.
    Positive,
}

impl Neg for Sign {
    type Output = Self;

    fn neg(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Zero => Self::Zero,
            Self::Positive => Self::Negative,
        }
    }
}

/// All real numbers from `lower` to `upper`.
///
/// Every operation returns an interval that contains all exact results for operands in the given intervals,
/// even in case of overflow or underflow. Bounds that are exact stay exact. An infinite bound means that
/// nothing is known on that side.
///
/// ```
/// use slideway_modes::interval::Interval;
/// let third = Interval::point(1.0) / Interval::point(3.0);
/// assert!(third.lower() < third.upper());
/// assert!((third * Interval::point(3.0)).contains(1.0));
/// assert_eq!(Interval::point(0.5) + Interval::point(0.25), Interval::point(0.75));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    lower: f64,
    upper: f64,
}

impl Interval {
    /// Zero.
    pub const ZERO: Self = Self { lower: 0.0, upper: 0.0 };
    /// One.
    pub const ONE: Self = Self { lower: 1.0, upper: 1.0 };
    /// The half turn pi, between two adjacent numbers.
    pub const PI: Self = Self { lower: PI, upper: PI.next_up() };
    /// All real numbers.
    pub const REAL_LINE: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// The interval with the given bounds; `None` if `lower > upper` or one of them is NaN.
    ///
    /// ```
    /// use slideway_modes::interval::Interval;
    /// assert_eq!(Interval::new(1.0, 2.0).map(Interval::width), Some(1.0));
    /// assert_eq!(Interval::new(2.0, 1.0), None);
    /// ```
    pub fn new(lower: f64, upper: f64) -> Option<Self> {
        (lower <= upper).then_some(Self { lower, upper })
    }

    /// The single number `value`; the whole real line if it is infinite or NaN.
    pub fn point(value: f64) -> Self {
        if value.is_finite() { Self { lower: value, upper: value } } else { Self::REAL_LINE }
    }

    /// All numbers at a distance of at most `radius >= 0` from `centre`; the whole real line if one of the
    /// two is NaN.
    pub fn around(centre: f64, radius: f64) -> Self {
        if !centre.is_finite() {
            return Self::REAL_LINE;
        }
        let (lower, upper) = (add_down(centre, -radius), add_up(centre, radius));
        Self::new(lower, upper).unwrap_or(Self::REAL_LINE)
    }

    /// The lower bound.
    pub fn lower(self) -> f64 {
        self.lower
    }

    /// The upper bound.
    pub fn upper(self) -> f64 {
        self.upper
    }

    /// The width `upper - lower`, rounded up.
    pub fn width(self) -> f64 {
        add_up(self.upper, -self.lower)
    }

    /// A number near the midpoint, up to rounding; always within the interval.
    pub fn middle(self) -> f64 {
        if self.lower == -self.upper {
            return 0.0;
        }
        (0.5 * self.lower + 0.5 * self.upper).clamp(self.lower, self.upper)
    }

    /// Whether `value` lies in the interval.
    pub fn contains(self, value: f64) -> bool {
        self.lower <= value && value <= self.upper
    }

    /// Whether every number of `other` lies in this interval.
    pub fn encloses(self, other: Self) -> bool {
        self.lower <= other.lower && other.upper <= self.upper
    }

    /// The common sign of all numbers in the interval; `None` if their signs differ.
    ///
    /// ```
    /// use slideway_modes::interval::{Interval, Sign};
    /// assert_eq!(Interval::point(-2.0).sign(), Some(Sign::Negative));
    /// assert_eq!(Interval::ZERO.sign(), Some(Sign::Zero));
    /// assert_eq!(Interval::around(0.0, 1.0).sign(), None);
    /// ```
    pub fn sign(self) -> Option<Sign> {
        if self.lower > 0.0 {
            Some(Sign::Positive)
        } else if self.upper < 0.0 {
            Some(Sign::Negative)
        } else {
            (self.lower == 0.0 && self.upper == 0.0).then_some(Sign::Zero)
        }
    }

    /// The absolute values of the numbers in the interval.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.lower >= 0.0 {
            self
        } else if self.upper <= 0.0 {
            -self
        } else {
            Self { lower: 0.0, upper: self.magnitude() }
        }
    }

    /// The largest absolute value.
    pub fn magnitude(self) -> f64 {
        self.lower.abs().max(self.upper.abs())
    }

    /// The numbers in both intervals; `None` if there are none.
    pub fn intersection(self, other: Self) -> Option<Self> {
        Self::new(self.lower.max(other.lower), self.upper.min(other.upper))
    }

    /// The smallest interval that contains both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.max(other.upper) }
    }

    fn from_bounds_of(pairs: [(f64, f64); 4], down: fn(f64, f64) -> f64, up: fn(f64, f64) -> f64) -> Self {
        let lower = pairs.iter().fold(f64::INFINITY, |least, &(a, b)| least.min(down(a, b)));
        let upper = pairs.iter().fold(f64::NEG_INFINITY, |most, &(a, b)| most.max(up(a, b)));
        Self { lower, upper }
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { lower: add_down(self.lower, other.lower), upper: add_up(self.upper, other.upper) }
    }
}

impl Neg for Interval {
    type Output = Self;

    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let pairs = corners(self, other);
        Self::from_bounds_of(pairs, mul_down, mul_up)
    }
}

impl Div for Interval {
    type Output = Self;

    /// The quotients; the whole real line if the divisor contains zero.
    fn div(self, divisor: Self) -> Self {
        if divisor.contains(0.0) {
            return Self::REAL_LINE;
        }
        Self::from_bounds_of(corners(self, divisor), div_down, div_up)
    }
}

arithmetic_that_follows!(Interval);

fn corners(one: Interval, other: Interval) -> [(f64, f64); 4] {
    [(one.lower, other.lower), (one.lower, other.upper), (one.upper, other.lower), (one.upper, other.upper)]
}

/// The largest `f64` not above `rounded + remainder`, where `rounded` is nearest to that sum.
fn round_down(rounded: f64, remainder: f64) -> f64 {
    let known = (0.0..f64::INFINITY).contains(&remainder);
    if known && rounded.is_finite() { rounded } else { rounded.next_down() }
}

pub(crate) fn add_up(one: f64, other: f64) -> f64 {
    -add_down(-one, -other)
}

pub(crate) fn add_down(one: f64, other: f64) -> f64 {
    let sum = one + other;
    if one.is_infinite() || other.is_infinite() {
        // Opposite infinities: nothing is known.
        return if sum.is_nan() { f64::NEG_INFINITY } else { sum };
    }
    round_down(sum, sum_remainder(one, other, sum))
}

fn mul_up(one: f64, other: f64) -> f64 {
    -mul_down(-one, other)
}

fn mul_down(one: f64, other: f64) -> f64 {
    if one == 0.0 || other == 0.0 {
        // An infinite bound is the limit of finite ones: 0 times any of them is 0.
        return 0.0;
    }
    let product = one * other;
    if one.is_infinite() || other.is_infinite() {
        return product;
    }
    let remainder = if product.abs() >= REMAINDER_IS_EXACT {
        product_remainder(one, other, product)
    } else {
        f64::NEG_INFINITY
    };
    round_down(product, remainder)
}

fn div_up(one: f64, divisor: f64) -> f64 {
    -div_down(-one, divisor)
}

/// The divisor is not zero.
fn div_down(one: f64, divisor: f64) -> f64 {
    if one == 0.0 {
        return 0.0;
    }
    let quotient = one / divisor;
    if divisor.is_infinite() {
        // Limit 0 of finite quotients; with an infinite dividend, nothing is known.
        return if one.is_infinite() { f64::NEG_INFINITY } else { 0.0_f64.next_down() };
    }
    if one.is_infinite() {
        return quotient;
    }
    // one - quotient divisor is exact where neither underflows; it has the sign of the remainder.
    let safe = one.abs() >= REMAINDER_IS_EXACT && quotient.abs() >= REMAINDER_IS_EXACT;
    let remainder = (-quotient).mul_add(divisor, one) * divisor.signum();
    round_down(quotient, if safe { remainder } else { f64::NEG_INFINITY })
}
