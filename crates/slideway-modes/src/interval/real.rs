//! Arithmetic that plain numbers and intervals share.

use super::Interval;
use nalgebra::Scalar;
use num_traits::{One, Zero};
use std::iter::Sum;
use std::ops::{AddAssign, Div, DivAssign, MulAssign, Neg, Sub, SubAssign};

/// A real number in the equations of a mechanism: `f64` with its rounding, or an [`Interval`] that encloses
/// it.
///
/// The same code thus evaluates formulas and assembles equations for both. Functions of an interval contain
/// all their values on it; if a function is undefined for some number of the interval, the result is not
/// finite.
///
/// ```
/// use slideway_modes::interval::{Interval, Real};
/// fn height<T: Real>(length: T, angle: T) -> T {
///     length * angle.sin()
/// }
/// let range = height(Interval::point(2.0), Interval::around(0.5, 1e-3));
/// assert!(range.contains(height(2.0, 0.5)) && range.width() < 4e-3);
/// ```
pub trait Real:
    Scalar
    + Copy
    + Zero
    + One
    + Neg<Output = Self>
    + Sub<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
    + Sum
{
    /// The number `value` itself.
    fn exactly(value: f64) -> Self;

    /// A number as written by a user: nearest to `value`, and somewhere in `enclosure`.
    fn written(value: f64, enclosure: Interval) -> Self;

    /// A number at a distance of at most `radius` from `centre`.
    fn around(centre: f64, radius: f64) -> Self {
        Self::written(centre, Interval::around(centre, radius))
    }

    /// Its least possible value.
    fn lower(self) -> f64;

    /// Its greatest possible value.
    fn upper(self) -> f64;

    /// A representative value.
    fn middle(self) -> f64;

    /// Whether it is bounded.
    fn is_finite(self) -> bool {
        self.lower().is_finite() && self.upper().is_finite()
    }

    /// Its greatest possible absolute value.
    fn magnitude(self) -> f64 {
        self.lower().abs().max(self.upper().abs())
    }

    /// Applies a function that is given for numbers and, enclosing all its values, for intervals.
    #[must_use]
    fn image(self, number: impl FnOnce(f64) -> f64, interval: impl FnOnce(Interval) -> Interval) -> Self;

    /// Its square.
    #[must_use]
    fn square(self) -> Self;
    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;
    /// -1, 0 or 1.
    #[must_use]
    fn sign_value(self) -> Self;
    /// 0 below zero, otherwise 1.
    #[must_use]
    fn step(self) -> Self;
    /// Sine.
    #[must_use]
    fn sin(self) -> Self;
    /// Cosine.
    #[must_use]
    fn cos(self) -> Self;
    /// The unit vector at this angle from the x axis; for a plain number it is exact along the axes, so that
    /// a guide at 90 degrees is exactly vertical.
    fn direction(self) -> [Self; 2];
    /// Tangent.
    #[must_use]
    fn tan(self) -> Self;
    /// Inverse sine.
    #[must_use]
    fn asin(self) -> Self;
    /// Inverse cosine.
    #[must_use]
    fn acos(self) -> Self;
    /// Inverse tangent.
    #[must_use]
    fn atan(self) -> Self;
    /// Hyperbolic sine.
    #[must_use]
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    #[must_use]
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    #[must_use]
    fn tanh(self) -> Self;
    /// Exponential function.
    #[must_use]
    fn exp(self) -> Self;
    /// Natural logarithm.
    #[must_use]
    fn ln(self) -> Self;
    /// Decimal logarithm.
    #[must_use]
    fn log10(self) -> Self;
    /// `self^exponent`.
    #[must_use]
    fn power(self, exponent: Self) -> Self;
    /// Angle of the vector (x, self).
    #[must_use]
    fn atan2(self, x: Self) -> Self;
    /// Length of the vector (self, other).
    #[must_use]
    fn hypot(self, other: Self) -> Self;
    /// The smaller of both.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// The greater of both.
    #[must_use]
    fn max(self, other: Self) -> Self;
}

/// Functions as plain numbers have them.
macro_rules! of_f64 {
    ($($name:ident),*) => {
        $(fn $name(self) -> Self {
            f64::$name(self)
        })*
    };
    (with another: $($name:ident),*) => {
        $(fn $name(self, other: Self) -> Self {
            f64::$name(self, other)
        })*
    };
}

impl Real for f64 {
    fn exactly(value: f64) -> Self {
        value
    }

    fn written(value: f64, _: Interval) -> Self {
        value
    }

    fn around(centre: f64, _: f64) -> Self {
        centre
    }

    fn lower(self) -> f64 {
        self
    }

    fn upper(self) -> f64 {
        self
    }

    fn middle(self) -> f64 {
        self
    }

    fn image(self, number: impl FnOnce(f64) -> f64, _: impl FnOnce(Interval) -> Interval) -> Self {
        number(self)
    }

    of_f64!(sqrt, abs, sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, exp, ln, log10);
    of_f64!(with another: atan2, hypot, min, max);

    fn square(self) -> Self {
        self * self
    }

    fn sign_value(self) -> Self {
        if self == 0.0 { 0.0 } else { self.signum() }
    }

    fn step(self) -> Self {
        if self < 0.0 { 0.0 } else { 1.0 }
    }

    fn direction(self) -> [Self; 2] {
        let quarters = self / std::f64::consts::FRAC_PI_2;
        let nearest = quarters.round();
        if (quarters - nearest).abs() > 1e-15 * quarters.abs() {
            return [f64::cos(self), f64::sin(self)];
        }
        match nearest.rem_euclid(4.0) {
            0.0 => [1.0, 0.0],
            1.0 => [0.0, 1.0],
            2.0 => [-1.0, 0.0],
            _ => [0.0, -1.0],
        }
    }

    fn power(self, exponent: Self) -> Self {
        self.powf(exponent)
    }
}
