//! Where a continuous function falls through zero, and where it might between values above zero.

use crate::interval::Interval;

/// The least place at which a function that is positive at `left` and not at `right` is found not to be
/// positive any more, to within `tolerance`; the function is not positive at the place that is returned.
///
/// ITP (I. F. D. Oliveira, R. H. C. Takahashi, An enhancement of the bisection method average performance
/// preserving minmax optimality, ACM Transactions on Mathematical Software 47, 2021): superlinear on smooth
/// functions, and never more than one evaluation above bisection. Of several roots it finds one.
pub(in crate::motion) fn falling_root<E>(
    [mut left, mut right]: [f64; 2],
    [mut at_left, mut at_right]: [f64; 2],
    tolerance: f64,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let rounding = 2.0 * f64::EPSILON * left.abs().max(right.abs());
    let tolerance = tolerance.max(rounding).max(f64::MIN_POSITIVE);
    let bisections = ((right - left) / (2.0 * tolerance)).log2().ceil().max(0.0);
    let slack = 0.2 / (right - left);
    let mut step = 0.0;
    while right - left > 2.0 * tolerance {
        let middle = f64::midpoint(left, right);
        let radius = tolerance * f64::exp2(bisections + 1.0 - step) - (right - left) / 2.0;
        let secant = (at_right * left - at_left * right) / (at_right - at_left);
        let towards = (middle - secant).signum();
        let shift = slack * (right - left).powi(2);
        let truncated = if shift <= (middle - secant).abs() { secant + towards * shift } else { middle };
        let near = (truncated - middle).abs() <= radius;
        let mut place = if near { truncated } else { middle - towards * radius };
        if !(place > left && place < right) {
            place = middle;
        }
        let value = function(place)?;
        if value > 0.0 {
            (left, at_left) = (place, value);
        } else {
            (right, at_right) = (place, value);
        }
        step += 1.0;
    }
    Ok(right)
}

/// Cells of time that are narrower than this many units in the last place are not divided.
pub(in crate::motion) const NARROWEST: f64 = 4.0;

/// Where a function of time becomes negative first: it is proven to be negative there, and to be positive to
/// the left of it, but for times at which it cannot be told from zero.
pub(in crate::motion) fn first_fall(
    [from, until]: [f64; 2],
    mut function: impl FnMut(Interval) -> Interval,
) -> Option<f64> {
    let narrowest = |time: f64| NARROWEST * f64::EPSILON * time.abs().max(f64::MIN_POSITIVE / f64::EPSILON);
    let (mut time, mut cell) = (from, until - from);
    while time < until {
        let end = (time + cell).min(until);
        let range = Interval::new(time, end).map_or(Interval::REAL_LINE, &mut function);
        if range.lower() > 0.0 {
            (time, cell) = (end, 2.0 * cell);
        } else if cell > narrowest(time) {
            cell /= 2.0;
        } else {
            // Neighbouring times: on to the first at which the sign can be told.
            loop {
                if time + cell > until {
                    return None;
                }
                let value = function(Interval::point(time + cell));
                if value.upper() < 0.0 {
                    return Some(falling_point([time, time + cell], function));
                }
                if value.lower() > 0.0 {
                    time += cell;
                    break;
                }
                cell *= 2.0;
            }
        }
    }
    None
}

/// A value counts as below zero if it is by more than this part of the width of its bounds: bounds of
/// rounding are wide.
const CLEARLY: f64 = 0.005;

/// The first number at which a function whose sign can be told at the right end is below zero, as far as
/// rounding lets it.
fn falling_point([mut left, mut right]: [f64; 2], mut function: impl FnMut(Interval) -> Interval) -> f64 {
    loop {
        let middle = f64::midpoint(left, right);
        if middle <= left || middle >= right {
            return right;
        }
        let value = function(Interval::point(middle));
        if value.middle() < -CLEARLY * value.width() { right = middle } else { left = middle }
    }
}

/// A dip to less than this part of the range of the values is looked at.
const NEAR: f64 = 0.1;

/// Where the cubic through four values at the fractions 0, 1/3, 2/3 and 1 has its least value between them,
/// if it comes near zero or below it there.
///
/// In Bernstein form the cubic lies within the hull of its four coefficients, so that most functions take no
/// more than two of these.
pub(in crate::motion) fn dip([first, second, third, last]: [f64; 4]) -> Option<f64> {
    // p(1/3) and p(2/3) of p(f) = (1-f)^3 first + 3 (1-f)^2 f one + 3 (1-f) f^2 two + f^3 last, solved for
    // `one` and `two`.
    let one = (18.0 * second - 9.0 * third + 2.0 * last - 5.0 * first) / 6.0;
    let two = (18.0 * third - 9.0 * second + 2.0 * first - 5.0 * last) / 6.0;
    let values = [first, second, third, last];
    let least = values.into_iter().fold(f64::INFINITY, f64::min);
    let near = NEAR * (values.into_iter().fold(f64::NEG_INFINITY, f64::max) - least);
    if one > near && two > near {
        return None;
    }
    // p(f) = first + linear f + square f^2 + cube f^3; of the zeros of p' the minimum is the one with
    // p'' > 0.
    let linear = 3.0 * (one - first);
    let square = 3.0 * (first - 2.0 * one + two);
    let cube = last - first + 3.0 * (one - two);
    let root = (square * square - 3.0 * cube * linear).sqrt();
    let place = -linear / (square + root);
    let value = first + place * (linear + place * (square + place * cube));
    (place > 0.0 && place < 1.0 && value <= near).then_some(place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::Real;
    use std::convert::Infallible;

    fn root(ends: [f64; 2], function: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut calls = 0;
        let found = falling_root::<Infallible>(ends, ends.map(&function), 1e-12, |x| {
            calls += 1;
            Ok(function(x))
        });
        match found {
            Ok(root) => (root, calls),
        }
    }

    #[test]
    fn finds_roots_to_the_tolerance_from_the_far_side() {
        for (ends, expected, function) in [
            ([0.0, 2.0], 2.0_f64.sqrt(), (|x| 2.0 - x * x) as fn(f64) -> f64),
            ([0.0, 3.0], std::f64::consts::FRAC_PI_2, f64::cos),
            ([0.0, 1.0], 0.5, |x| (0.5 - x).powi(3)),
        ] {
            let (found, _) = root(ends, function);
            assert!((found - expected).abs() < 3e-12, "{found} {expected}");
            assert!(function(found) <= 0.0);
        }
    }

    #[test]
    fn is_superlinear_and_never_much_worse_than_bisection() {
        let (_, smooth) = root([0.0, 3.0], f64::cos);
        assert!(smooth <= 12, "{smooth}");
        // A jump: log2(1 / 2e-12) = 39 bisections.
        let (found, jump) = root([0.0, 1.0], |x| if x < 0.3 { 1.0 } else { -1e-9 });
        assert!((found - 0.3).abs() < 3e-12 && jump <= 42, "{found} {jump}");
    }

    #[test]
    fn dips_of_cubics_are_found_where_they_are() {
        let samples = |p: fn(f64) -> f64| dip([0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0].map(p));
        // Least values by hand: below zero between two values above it, just above zero, far above, at an
        // end.
        for (place, p) in [
            (0.5, (|f| (f - 0.5).powi(2) - 0.01) as fn(f64) -> f64),
            (0.2, |f| (f - 0.2).powi(2) * (f + 1.0)),
            (0.85, |f| (f - 0.85).powi(2) + 0.001),
        ] {
            let found = samples(p);
            assert!(found.is_some_and(|found| (found - place).abs() < 1e-14), "{found:?} {place}");
        }
        for p in
            [(|f| (f - 0.5).powi(2) + 0.1) as fn(f64) -> f64, |f| f, |f| 1.0 - f, |_| 1.0, |_| 0.0, |f| f * f]
        {
            assert_eq!(samples(p), None);
        }
    }

    #[test]
    fn the_first_fall_is_found_however_long_the_range_is() {
        let fall = |ends: [f64; 2], function: &dyn Fn(Interval) -> Interval| first_fall(ends, function);
        let sine = |time: Interval| (time * Interval::point(2.0)).sin();
        let found = fall([0.0, 1e4], &sine).expect("sin(2 t) falls at pi/2");
        assert!((found - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{found}");
        // From a zero on, at which it rises.
        let from = std::f64::consts::PI;
        let found = fall([from, 1e4], &sine).expect("and at 3 pi/2");
        assert!((found - 1.5 * std::f64::consts::PI).abs() < 3e-15, "{found}");
        // It touches zero at 1 and falls at 2: (t - 1)^2 (2 - t).
        let touches = |time: Interval| (time - Interval::point(1.0)).square() * (Interval::point(2.0) - time);
        let found = fall([0.0, 5.0], &touches).expect("at 2");
        assert!((found - 2.0).abs() < 1e-15, "{found}");
        assert_eq!(fall([0.0, 1.9], &touches), None);
    }
}
