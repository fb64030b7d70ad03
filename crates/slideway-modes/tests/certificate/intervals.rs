//! Interval arithmetic against rational numbers.

use dashu_ratio::RBig;
use proptest::prelude::*;
use slideway_modes::certificate::{Interval, Sign};

use crate::oracle::rational;

/// All finite numbers, with many zeros, subnormals, huge and simple ones.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("finite", |value| value.is_finite()),
        -10.0..10.0_f64,
        (-4..=4_i32).prop_map(f64::from),
        (-3..=3_i32).prop_map(|value| f64::from(value) * f64::MIN_POSITIVE),
        (-9..=9_i32).prop_map(|value| f64::from(value) * 5e-324),
        Just(f64::MAX),
        Just(f64::MIN),
    ]
}

/// An interval, and a number in it.
fn interval() -> impl Strategy<Value = (Interval, f64)> {
    (number(), number(), number()).prop_map(|(one, other, within)| {
        let (lower, upper) = (one.min(other), one.max(other));
        (Interval::new(lower, upper).expect("in order"), within.clamp(lower, upper))
    })
}

fn holds(interval: Interval, value: &RBig) -> bool {
    let below = interval.lower() == f64::NEG_INFINITY || rational(interval.lower()) <= *value;
    let above = interval.upper() == f64::INFINITY || rational(interval.upper()) >= *value;
    below && above
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn results_are_enclosed((one, a) in interval(), (other, b) in interval()) {
        let (exact_a, exact_b) = (rational(a), rational(b));
        prop_assert!(holds(one + other, &(&exact_a + &exact_b)));
        prop_assert!(holds(one - other, &(&exact_a - &exact_b)));
        prop_assert!(holds(one * other, &(&exact_a * &exact_b)));
        if b != 0.0 {
            prop_assert!(holds(one / other, &(&exact_a / &exact_b)));
        }
        prop_assert!(one.abs().contains(a.abs()));
        prop_assert!(one.contains(one.middle()));
        prop_assert!(holds(Interval::ZERO.hull(Interval::point(one.width())),
            &(rational(one.upper()) - rational(one.lower()))) || one.width().is_infinite());
        prop_assert!(one.hull(other).encloses(one) && one.hull(other).encloses(other));
        match one.intersection(other) {
            Some(both) => prop_assert!(one.encloses(both) && other.encloses(both)),
            None => prop_assert!(!one.contains(b) || !other.contains(a)),
        }
    }

    #[test]
    fn results_of_points_are_as_narrow_as_can_be(a in -1e100..1e100_f64, b in -1e100..1e100_f64) {
        let (one, other) = (Interval::point(a), Interval::point(b));
        let exact = (rational(a), rational(b));
        prop_assert_eq!(one + other, Interval::around_ratio(&(&exact.0 + &exact.1)));
        prop_assert_eq!(one * other, Interval::around_ratio(&(&exact.0 * &exact.1)));
        if b != 0.0 {
            prop_assert_eq!(one / other, Interval::around_ratio(&(&exact.0 / &exact.1)));
        }
    }

    #[test]
    fn radius_is_covered(centre in number(), radius in number()) {
        let around = Interval::around(centre, radius.abs());
        prop_assert!(holds(around, &(rational(centre) + rational(radius.abs()))));
        prop_assert!(holds(around, &(rational(centre) - rational(radius.abs()))));
    }

    #[test]
    fn signs_are_those_of_all_members((interval, member) in interval()) {
        match interval.sign() {
            Some(Sign::Positive) => prop_assert!(member > 0.0),
            Some(Sign::Negative) => prop_assert!(member < 0.0),
            Some(Sign::Zero) => prop_assert!(member == 0.0),
            None => prop_assert!(interval.contains(0.0)),
        }
    }
}

#[test]
fn infinite_bounds_are_never_exceeded() {
    let huge = Interval::point(f64::MAX);
    assert_eq!((huge + huge).upper(), f64::INFINITY);
    assert_eq!((huge + huge).lower(), f64::MAX);
    assert_eq!(huge * Interval::point(-2.0) + huge * Interval::point(2.0), Interval::REAL_LINE);
    assert_eq!(Interval::REAL_LINE * Interval::ZERO, Interval::ZERO);
    assert_eq!(Interval::point(1.0) / Interval::around(0.0, 1.0), Interval::REAL_LINE);
    assert_eq!(Interval::REAL_LINE - Interval::REAL_LINE, Interval::REAL_LINE);
    assert_eq!(Interval::point(f64::NAN), Interval::REAL_LINE);
    assert_eq!(Interval::around(f64::INFINITY, 1.0), Interval::REAL_LINE);
    assert_eq!(Interval::around(1.0, f64::NAN), Interval::REAL_LINE);
    assert_eq!(Interval::new(f64::NAN, 1.0), None);
    assert!((Interval::point(5e-324) * Interval::point(0.5)).contains(0.0));
    assert!((Interval::point(5e-324) * Interval::point(0.5)).upper() > 0.0);
}

#[test]
fn ratios_beyond_all_numbers_are_enclosed() {
    let huge = rational(f64::MAX) * rational(4.0);
    assert_eq!(Interval::around_ratio(&huge), Interval::new(f64::MAX, f64::INFINITY).expect("in order"));
    let tiny = rational(5e-324) / rational(-4.0);
    let enclosure = Interval::around_ratio(&tiny);
    assert!(holds(enclosure, &tiny) && enclosure.lower() < 0.0);
}
