//! Intervals with bounds on a slope: functions of one variable over a range of it.

use super::{Interval, Real, Sign};
use num_traits::{One, Zero};
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// The values of a function over a range of its variable, and the values of its derivative there.
///
/// Formulas evaluated with it contain the values of their derivative by the chain rule (R. E. Moore, R. B.
/// Kearfott, M. J. Cloud, Introduction to Interval Analysis, SIAM 2009, chapter 9). If a function has a kink,
/// the slopes are those on both sides, so the mean value theorem holds across it; if it jumps, nothing is
/// known about the slope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sloped {
    /// All values.
    pub value: Interval,
    /// All slopes.
    pub slope: Interval,
}

impl Sloped {
    /// The variable itself over a range.
    pub fn variable(range: Interval) -> Self {
        Self { value: range, slope: Interval::ONE }
    }

    /// A value that does not depend on the variable.
    pub fn constant(value: Interval) -> Self {
        Self { value, slope: Interval::ZERO }
    }

    /// A function of this one with the given derivative.
    fn chain(self, value: Interval, derivative: impl FnOnce(Interval) -> Interval) -> Self {
        let constant = self.slope.is_zero();
        Self { value, slope: if constant { Interval::ZERO } else { derivative(self.value) * self.slope } }
    }

    fn is_constant(self) -> bool {
        self.slope.is_zero()
    }

    /// One of two functions if it is certain which one applies, otherwise their union.
    fn either(value: Interval, first: Option<bool>, [one, other]: [Self; 2]) -> Self {
        let slope = match first {
            Some(true) => one.slope,
            Some(false) => other.slope,
            None => one.slope.hull(other.slope),
        };
        Self { value, slope }
    }

    /// A function that is constant except for jumps.
    fn with_jumps(self, value: Interval) -> Self {
        let is_smooth = self.is_constant() || value.width() == 0.0;
        Self { value, slope: if is_smooth { Interval::ZERO } else { Interval::REAL_LINE } }
    }
}

impl Add for Sloped {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Neg for Sloped {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl Mul for Sloped {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let slope = self.slope * other.value + self.value * other.slope;
        Self { value: self.value * other.value, slope }
    }
}

impl Div for Sloped {
    type Output = Self;

    fn div(self, divisor: Self) -> Self {
        let value = self.value / divisor.value;
        let slope = if self.is_constant() && divisor.is_constant() {
            Interval::ZERO
        } else {
            (self.slope - value * divisor.slope) / divisor.value
        };
        Self { value, slope }
    }
}

arithmetic_that_follows!(Sloped);

impl Zero for Sloped {
    fn zero() -> Self {
        Self::constant(Interval::ZERO)
    }

    fn is_zero(&self) -> bool {
        self.value.is_zero()
    }
}

impl One for Sloped {
    fn one() -> Self {
        Self::constant(Interval::ONE)
    }
}

impl Real for Sloped {
    fn exactly(value: f64) -> Self {
        Self::constant(Interval::point(value))
    }

    fn written(_: f64, enclosure: Interval) -> Self {
        Self::constant(enclosure)
    }

    fn lower(self) -> f64 {
        self.value.lower()
    }

    fn upper(self) -> f64 {
        self.value.upper()
    }

    fn middle(self) -> f64 {
        self.value.middle()
    }

    fn image(self, _: impl FnOnce(f64) -> f64, interval: impl FnOnce(Interval) -> Interval) -> Self {
        self.with_jumps(interval(self.value))
    }

    fn square(self) -> Self {
        self.chain(self.value.square(), |x| x + x)
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, |_| Interval::point(0.5) / root)
    }

    fn abs(self) -> Self {
        Self::either(self.value.abs(), is_positive(self.value), [self, -self])
    }

    fn sign_value(self) -> Self {
        self.with_jumps(self.value.sign_value())
    }

    fn step(self) -> Self {
        self.with_jumps(self.value.step())
    }

    fn sin(self) -> Self {
        self.chain(self.value.sin(), Real::cos)
    }

    fn cos(self) -> Self {
        self.chain(self.value.cos(), |x| -x.sin())
    }

    fn direction(self) -> [Self; 2] {
        [self.cos(), self.sin()]
    }

    fn tan(self) -> Self {
        let tangent = self.value.tan();
        self.chain(tangent, |_| Interval::ONE + tangent.square())
    }

    fn asin(self) -> Self {
        self.chain(self.value.asin(), |x| Interval::ONE / (Interval::ONE - x.square()).sqrt())
    }

    fn acos(self) -> Self {
        self.chain(self.value.acos(), |x| -(Interval::ONE / (Interval::ONE - x.square()).sqrt()))
    }

    fn atan(self) -> Self {
        self.chain(self.value.atan(), |x| Interval::ONE / (Interval::ONE + x.square()))
    }

    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), Real::cosh)
    }

    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), Real::sinh)
    }

    fn tanh(self) -> Self {
        let value = self.value.tanh();
        self.chain(value, |_| Interval::ONE - value.square())
    }

    fn exp(self) -> Self {
        let value = self.value.exp();
        self.chain(value, |_| value)
    }

    fn ln(self) -> Self {
        self.chain(self.value.ln(), |x| Interval::ONE / x)
    }

    fn log10(self) -> Self {
        self.chain(self.value.log10(), |x| Interval::ONE / (x * Interval::point(10.0).ln()))
    }

    fn power(self, exponent: Self) -> Self {
        let value = self.value.power(exponent.value);
        if exponent.is_constant() {
            let less = exponent.value - Interval::ONE;
            return self.chain(value, |x| exponent.value * x.power(less));
        }
        // x^y (y' ln x + y x'/x)
        let of_base =
            if self.is_constant() { Interval::ZERO } else { exponent.value * self.slope / self.value };
        Self { value, slope: value * (exponent.slope * self.value.ln() + of_base) }
    }

    fn atan2(self, x: Self) -> Self {
        let value = self.value.atan2(x.value);
        if self.is_constant() && x.is_constant() {
            return Self::constant(value);
        }
        let squares = x.value.square() + self.value.square();
        Self { value, slope: (x.value * self.slope - self.value * x.slope) / squares }
    }

    fn hypot(self, other: Self) -> Self {
        let value = self.value.hypot(other.value);
        if self.is_constant() && other.is_constant() {
            return Self::constant(value);
        }
        Self { value, slope: (self.value * self.slope + other.value * other.slope) / value }
    }

    fn min(self, other: Self) -> Self {
        let first = is_positive(other.value - self.value);
        Self::either(self.value.min(other.value), first, [self, other])
    }

    fn max(self, other: Self) -> Self {
        let first = is_positive(self.value - other.value);
        Self::either(self.value.max(other.value), first, [self, other])
    }
}

/// Whether all numbers are positive, or all negative; `None` if neither is certain.
fn is_positive(interval: Interval) -> Option<bool> {
    match interval.sign() {
        Some(Sign::Positive) => Some(true),
        Some(Sign::Negative) => Some(false),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number<T: Real>(value: f64) -> T {
        T::exactly(value)
    }

    fn rational<T: Real>(t: T) -> T {
        number::<T>(3.0) + number::<T>(2.0) * t - t.square() / (T::one() + t)
    }

    fn waves<T: Real>(t: T) -> T {
        (t * number(7.0)).sin() * t.cos().power(number(3.0)) - (t / number(3.0)).tan()
    }

    fn bell<T: Real>(t: T) -> T {
        (-((t - number(0.4)) / number(0.1)).square()).exp() + (T::one() + t).ln() - (t + number(2.0)).log10()
    }

    fn inverse<T: Real>(t: T) -> T {
        (T::one() + t).sqrt() + (t / number(3.0)).asin() + (t / number(4.0)).acos() - (t * number(5.0)).atan()
    }

    fn hyperbolic<T: Real>(t: T) -> T {
        t.sinh() + (t + t).cosh() * (t - number(0.5)).tanh()
    }

    fn powers<T: Real>(t: T) -> T {
        let base = T::one() + t;
        base.power(number::<T>(2.0) - t) + base.power(number(2.5)) + base.power(number(-2.0))
    }

    fn vectors<T: Real>(t: T) -> T {
        (t - number(0.5)).atan2(T::one() + t) + t.hypot(T::one() - t)
    }

    fn kinks<T: Real>(t: T) -> T {
        (t - number(0.5)).abs() + t.min(number(0.3)).min(T::one() - t) - (t + t).max(T::one())
    }

    type Both = (fn(f64) -> f64, fn(Sloped) -> Sloped);

    const FUNCTIONS: [Both; 8] = [
        (rational, rational),
        (waves, waves),
        (bell, bell),
        (inverse, inverse),
        (hyperbolic, hyperbolic),
        (powers, powers),
        (vectors, vectors),
        (kinks, kinks),
    ];

    /// Values at numbers lie within the bounds, and so do difference quotients, by the mean value theorem.
    #[test]
    fn slopes_hold_all_difference_quotients() {
        for (which, (at, over)) in FUNCTIONS.into_iter().enumerate() {
            for (first, width) in [(0.0, 0.5), (0.25, 0.25), (0.45, 0.01), (0.9, 0.1)] {
                let Sloped { value, slope } =
                    over(Sloped::variable(Interval { lower: first, upper: first + width }));
                let places: Vec<f64> =
                    (0..=20_i32).map(|part| first + width * f64::from(part) / 20.0).collect();
                for (index, &one) in places.iter().enumerate() {
                    let rounding = Interval::around(at(one), 1e-14 * (1.0 + at(one).abs()));
                    assert!(value.intersection(rounding).is_some(), "{which} at {one}: {value:?}");
                    for &other in &places[..index] {
                        let quotient = (at(one) - at(other)) / (one - other);
                        let rounding = Interval::around(quotient, 1e-12 * (1.0 + quotient.abs()) / width);
                        let holds = slope.intersection(rounding).is_some();
                        assert!(holds, "{which} from {other} to {one}: {quotient} in {slope:?}");
                    }
                }
                assert!(slope.width() < 1e4, "{which} from {first}: {slope:?}");
            }
        }
    }

    #[test]
    fn slopes_are_narrow_over_narrow_ranges() {
        let Sloped { slope, .. } = bell(Sloped::variable(Interval::around(0.3, 1e-6)));
        // -200 (t - 0.4) exp(-((t - 0.4)/0.1)^2) + 1/(1 + t) - 1/((2 + t) ln 10)
        let expected = 20.0 * (-1.0_f64).exp() + 1.0 / 1.3 - 1.0 / (2.3 * 10.0_f64.ln());
        assert!(slope.contains(expected) && slope.width() < 1e-2, "{slope:?} {expected}");
    }

    #[test]
    fn jumps_have_any_slope() {
        let range = Sloped::variable(Interval::around(0.5, 0.1));
        let jump = (range - Sloped::exactly(0.5)).sign_value();
        assert_eq!((jump.value.lower, jump.value.upper, jump.slope), (-1.0, 1.0, Interval::REAL_LINE));
        assert_eq!((range - Sloped::exactly(0.2)).step(), Sloped::one());
    }
}
