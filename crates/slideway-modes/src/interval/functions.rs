//! Elementary functions of intervals.

use super::{Interval, REMAINDER_IS_EXACT, Real, Sign};
use num_traits::{One, Zero};

/// The range of sine and cosine.
const UNIT: Interval = Interval { lower: -1.0, upper: 1.0 };
/// Beyond this many half turns, the parity of their number is unknown.
const MOST_TURNS: f64 = 1e15;
/// Powers with integer exponents up to this one are products.
const GREATEST_EXPONENT: f64 = 1024.0;

/// A bound below the true value that rounds to `value`, by more than three units in its last place.
fn below(value: f64) -> f64 {
    if value.is_nan() || value == f64::NEG_INFINITY {
        f64::NEG_INFINITY
    } else if value == f64::INFINITY {
        f64::MAX
    } else {
        value - (4.0 * f64::EPSILON * value.abs() + f64::MIN_POSITIVE)
    }
}

fn above(value: f64) -> f64 {
    -below(-value)
}

/// The value of a function at a number. Functions are exact at 0 if their value there is 0 or 1, and at 1 if
/// their value there is 0.
fn at(function: fn(f64) -> f64, x: f64) -> Interval {
    let value = function(x);
    let exact = x == 0.0 && (value == 0.0 || value == 1.0) || x == 1.0 && value == 0.0;
    if exact { Interval::point(value) } else { Interval { lower: below(value), upper: above(value) } }
}

/// The values of a monotonic function.
fn monotonic(function: fn(f64) -> f64, x: Interval) -> Interval {
    let lower = at(function, x.lower);
    if x.lower == x.upper { lower } else { lower.hull(at(function, x.upper)) }
}

/// `interval`, where everything below `least` is known to be impossible.
fn from(least: f64, interval: Interval) -> Interval {
    Interval { lower: interval.lower.max(least), upper: interval.upper.max(least) }
}

/// The values of sine or cosine, whose extrema are at integer `half_turns`: 1 at even ones, -1 at odd ones.
fn wave(function: fn(f64) -> f64, x: Interval, half_turns: Interval) -> Interval {
    let (first, last) = (half_turns.lower.ceil(), half_turns.upper.floor());
    if half_turns.magnitude() >= MOST_TURNS || last > first {
        return UNIT;
    }
    let ends = monotonic(function, x);
    let with_extremum = if first > last {
        ends
    } else if first % 2.0 == 0.0 {
        Interval { lower: ends.lower, upper: 1.0 }
    } else {
        Interval { lower: -1.0, upper: ends.upper }
    };
    Interval { lower: with_extremum.lower.max(-1.0), upper: with_extremum.upper.min(1.0) }
}

/// Number of half turns of `x`, counted from a quarter turn.
fn half_turns_from_quarter(x: Interval) -> Interval {
    x / Interval::PI - Interval::point(0.5)
}

/// `base^exponent` for a nonnegative base and a positive integer exponent.
fn product_of(base: Interval, exponent: f64) -> Interval {
    let (mut result, mut square, mut rest) = (Interval::ONE, base, exponent);
    while rest > 1.0 {
        if rest % 2.0 == 1.0 {
            result *= square;
        }
        square = square * square;
        rest = (rest / 2.0).floor();
    }
    from(0.0, result * square)
}

/// `base^exponent` for an integer exponent.
fn whole_power(base: Interval, exponent: f64) -> Interval {
    let count = exponent.abs();
    if count == 0.0 {
        return Interval::ONE;
    }
    let power = if count % 2.0 == 0.0 {
        product_of(base.abs(), count)
    } else {
        // Odd powers increase with their base.
        let end = |x: f64| {
            let size = product_of(Interval::point(x.abs()), count);
            if x < 0.0 { -size } else { size }
        };
        end(base.lower).hull(end(base.upper))
    };
    if exponent < 0.0 { Interval::ONE / power } else { power }
}

/// Bounds on a function of two numbers that is monotonic in each.
fn corners(function: fn(f64, f64) -> f64, x: Interval, y: Interval) -> Interval {
    let values = [(x.lower, y.lower), (x.lower, y.upper), (x.upper, y.lower), (x.upper, y.upper)]
        .map(|(x, y)| function(x, y));
    let hull = |all: Interval, value: f64| all.hull(Interval { lower: below(value), upper: above(value) });
    values.into_iter().fold(Interval { lower: f64::INFINITY, upper: f64::NEG_INFINITY }, hull)
}

/// A lower bound on the square root; `x >= 0`.
fn root_below(x: f64) -> f64 {
    let root = x.sqrt();
    let is_exact = x == 0.0 || x >= REMAINDER_IS_EXACT && root.mul_add(-root, x) >= 0.0;
    if is_exact { root } else { root.next_down() }
}

/// An upper bound on the square root; `x >= 0`.
fn root_above(x: f64) -> f64 {
    let root = x.sqrt();
    let is_exact = x == 0.0 || x >= REMAINDER_IS_EXACT && root.mul_add(-root, x) <= 0.0;
    if is_exact { root } else { root.next_up() }
}

impl Zero for Interval {
    fn zero() -> Self {
        Self::ZERO
    }

    fn is_zero(&self) -> bool {
        self.sign() == Some(Sign::Zero)
    }
}

impl One for Interval {
    fn one() -> Self {
        Self::ONE
    }
}

impl Real for Interval {
    fn exactly(value: f64) -> Self {
        Self::point(value)
    }

    fn written(_: f64, enclosure: Interval) -> Self {
        enclosure
    }

    fn lower(self) -> f64 {
        self.lower
    }

    fn upper(self) -> f64 {
        self.upper
    }

    fn middle(self) -> f64 {
        Self::middle(self)
    }

    fn image(self, _: impl FnOnce(f64) -> f64, interval: impl FnOnce(Interval) -> Interval) -> Self {
        interval(self)
    }

    fn square(self) -> Self {
        let size = Self::abs(self);
        from(0.0, size * size)
    }

    fn sqrt(self) -> Self {
        if self.lower < 0.0 {
            return Self::REAL_LINE;
        }
        Self { lower: root_below(self.lower), upper: root_above(self.upper) }
    }

    fn abs(self) -> Self {
        Self::abs(self)
    }

    fn sign_value(self) -> Self {
        Self { lower: Real::sign_value(self.lower), upper: Real::sign_value(self.upper) }
    }

    fn step(self) -> Self {
        Self { lower: self.lower.step(), upper: self.upper.step() }
    }

    fn sin(self) -> Self {
        wave(f64::sin, self, half_turns_from_quarter(self))
    }

    fn cos(self) -> Self {
        wave(f64::cos, self, self / Self::PI)
    }

    fn direction(self) -> [Self; 2] {
        [self.cos(), self.sin()]
    }

    fn tan(self) -> Self {
        let half_turns = half_turns_from_quarter(self);
        let has_pole = half_turns.lower.ceil() <= half_turns.upper.floor();
        if has_pole || half_turns.magnitude() >= MOST_TURNS {
            return Self::REAL_LINE;
        }
        monotonic(f64::tan, self)
    }

    fn asin(self) -> Self {
        if UNIT.encloses(self) { monotonic(f64::asin, self) } else { Self::REAL_LINE }
    }

    fn acos(self) -> Self {
        if UNIT.encloses(self) { from(0.0, monotonic(f64::acos, self)) } else { Self::REAL_LINE }
    }

    fn atan(self) -> Self {
        monotonic(f64::atan, self)
    }

    fn sinh(self) -> Self {
        monotonic(f64::sinh, self)
    }

    fn cosh(self) -> Self {
        from(1.0, monotonic(f64::cosh, Self::abs(self)))
    }

    fn tanh(self) -> Self {
        let wide = monotonic(f64::tanh, self);
        Self { lower: wide.lower.max(-1.0), upper: wide.upper.min(1.0) }
    }

    fn exp(self) -> Self {
        from(0.0, monotonic(f64::exp, self))
    }

    fn ln(self) -> Self {
        if self.lower > 0.0 { monotonic(f64::ln, self) } else { Self::REAL_LINE }
    }

    fn log10(self) -> Self {
        if self.lower > 0.0 { monotonic(f64::log10, self) } else { Self::REAL_LINE }
    }

    fn power(self, exponent: Self) -> Self {
        let whole = exponent.lower == exponent.upper && exponent.lower.fract() == 0.0;
        if whole && exponent.magnitude() <= GREATEST_EXPONENT {
            return whole_power(self, exponent.lower);
        }
        if self.lower < 0.0 || self.lower == 0.0 && exponent.lower <= 0.0 {
            return Self::REAL_LINE;
        }
        from(0.0, corners(f64::powf, self, exponent))
    }

    fn atan2(self, x: Self) -> Self {
        if self.is_zero() && x.lower > 0.0 {
            return Self::ZERO;
        }
        // The angle jumps at the negative x axis, and is undefined at the origin.
        if self.contains(0.0) && x.lower <= 0.0 {
            return (-Self::PI).hull(Self::PI);
        }
        corners(f64::atan2, self, x)
    }

    fn hypot(self, other: Self) -> Self {
        let (x, y) = (Self::abs(self), Self::abs(other));
        if x.is_zero() {
            return y;
        }
        if y.is_zero() {
            return x;
        }
        from(0.0, corners(f64::hypot, x, y))
    }

    fn min(self, other: Self) -> Self {
        Self { lower: self.lower.min(other.lower), upper: self.upper.min(other.upper) }
    }

    fn max(self, other: Self) -> Self {
        Self { lower: self.lower.max(other.lower), upper: self.upper.max(other.upper) }
    }
}
