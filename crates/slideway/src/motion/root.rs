//! Where a continuous function falls through zero.

/// The least place at which a function that is positive at `left` and not at `right` is found not to be positive any
/// more, to within `tolerance`; the function is not positive at the place that is returned.
///
/// ITP (I. F. D. Oliveira, R. H. C. Takahashi, An enhancement of the bisection method average performance preserving
/// minmax optimality, ACM Transactions on Mathematical Software 47, 2021): superlinear on smooth functions, and never
/// more than one evaluation above bisection. Of several roots it finds one.
pub(super) fn falling_root<E>(
    [mut left, mut right]: [f64; 2],
    [mut at_left, mut at_right]: [f64; 2],
    tolerance: f64,
    mut function: impl FnMut(f64) -> Result<f64, E>,
) -> Result<f64, E> {
    let tolerance = tolerance.max(2.0 * f64::EPSILON * left.abs().max(right.abs()));
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

#[cfg(test)]
mod tests {
    use super::*;
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
}
