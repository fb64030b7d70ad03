//! Elementary functions of intervals against the same functions with 400 binary digits.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use dashu_int::IBig;
use dashu_ratio::RBig;
use proptest::prelude::*;
use slideway_modes::interval::{Interval, Real};

/// Binary digits after the point of the reference values.
const BITS: usize = 400;
/// Their errors, far below those of any `f64` in these tests.
const SLACK: usize = 250;

/// A number with a fixed point.
type Fixed = IBig;

fn fixed(value: f64) -> Fixed {
    let scaled = RBig::try_from(value).unwrap() * RBig::from(IBig::ONE << BITS);
    scaled.trunc()
}

fn one() -> Fixed {
    IBig::ONE << BITS
}

fn times(a: &Fixed, b: &Fixed) -> Fixed {
    (a * b) >> BITS
}

fn per(a: &Fixed, b: &Fixed) -> Fixed {
    (a << BITS) / b
}

/// Sum of x^k/k! for k = first, first + step, ..., with the given factor from term to term.
fn series(first: u32, step: u32, sign: i32, x: &Fixed) -> Fixed {
    let mut term = if first == 0 { one() } else { x.clone() };
    let (mut sum, mut k) = (term.clone(), first);
    while term != IBig::ZERO && term != IBig::NEG_ONE {
        for _ in 0..step {
            k += 1;
            term = times(&term, x) / IBig::from(k);
        }
        term *= IBig::from(sign);
        sum += &term;
    }
    sum
}

fn sin(x: &Fixed) -> Fixed {
    series(1, 2, -1, x)
}

fn cos(x: &Fixed) -> Fixed {
    series(0, 2, -1, x)
}

fn exp(x: &Fixed) -> Fixed {
    series(0, 1, 1, x)
}

/// A root of a function near its rounded value, by Newton's method.
fn root(near: f64, correction: impl Fn(&Fixed) -> Fixed) -> Fixed {
    (0..5).fold(fixed(near), |y, _| &y + correction(&y))
}

fn ln(x: f64) -> Fixed {
    root(x.ln(), |y| per(&fixed(x), &exp(y)) - one())
}

/// Angle of the vector (x, y) with x > 0.
fn angle(y: f64, x: f64) -> Fixed {
    let ratio = per(&fixed(y), &fixed(x));
    root(y.atan2(x), |a| times(&cos(a), &(times(&ratio, &cos(a)) - sin(a))))
}

fn atan(x: f64) -> Fixed {
    angle(x, 1.0)
}

fn asin(x: f64) -> Fixed {
    root(x.asin(), |y| per(&(fixed(x) - sin(y)), &cos(y)))
}

fn half_turn() -> Fixed {
    atan(1.0) * IBig::from(4)
}

fn hyperbolic(x: f64) -> [Fixed; 2] {
    let (grows, falls) = (exp(&fixed(x)), exp(&fixed(-x)));
    [(&grows - &falls) >> 1, (grows + falls) >> 1]
}

fn holds(interval: Interval, value: &Fixed) -> bool {
    let slack = IBig::ONE << (BITS - SLACK);
    let below = interval.lower() == f64::NEG_INFINITY || fixed(interval.lower()) <= value + &slack;
    let above = interval.upper() == f64::INFINITY || fixed(interval.upper()) >= value - &slack;
    below && above
}

/// An interval from `least` to `greatest`, and a number in it; often a single number.
fn within(least: f64, greatest: f64) -> impl Strategy<Value = (Interval, f64)> {
    let width = prop_oneof![Just(0.0), 0.0..1e-6, 0.0..1.0, Just(2.0)];
    (least..greatest, width, 0.0..=1.0_f64).prop_map(move |(lower, width, share)| {
        let upper = (lower + width * (greatest - least)).min(greatest);
        let inner = (lower + share * (upper - lower)).clamp(lower, upper);
        (Interval::new(lower, upper).unwrap(), inner)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn trigonometric_functions_are_enclosed((range, x) in within(-20.0, 20.0)) {
        let exact = fixed(x);
        prop_assert!(holds(range.sin(), &sin(&exact)));
        prop_assert!(holds(range.cos(), &cos(&exact)));
        prop_assert!(holds(range.tan(), &per(&sin(&exact), &cos(&exact))));
        prop_assert!(Interval::around(0.0, 1.0).encloses(range.sin().hull(range.cos())));
    }

    #[test]
    fn inverse_functions_are_enclosed((range, x) in within(-0.99, 0.99)) {
        prop_assert!(holds(range.asin(), &asin(x)));
        prop_assert!(holds(range.acos(), &((half_turn() >> 1) - asin(x))));
        prop_assert!(holds(range.atan(), &atan(x)));
    }

    #[test]
    fn exponential_functions_are_enclosed((range, x) in within(-12.0, 12.0)) {
        let [sinh, cosh] = hyperbolic(x);
        prop_assert!(holds(range.exp(), &exp(&fixed(x))));
        prop_assert!(holds(range.sinh(), &sinh));
        prop_assert!(holds(range.cosh(), &cosh));
        prop_assert!(holds(range.tanh(), &per(&sinh, &cosh)));
    }

    #[test]
    fn logarithms_and_powers_are_enclosed((range, x) in within(1e-3, 30.0), (other, y) in within(-2.5, 2.5)) {
        prop_assert!(holds(range.ln(), &ln(x)));
        prop_assert!(holds(range.log10(), &per(&ln(x), &ln(10.0))));
        prop_assert!(holds(range.power(other), &exp(&times(&fixed(y), &ln(x)))));
        prop_assert!(holds(other.atan2(range), &angle(y, x)));
    }

    #[test]
    fn roots_and_lengths_are_enclosed((range, x) in within(0.0, 40.0), (other, y) in within(-3.0, 3.0)) {
        let exact = RBig::try_from(x).unwrap();
        let square = |bound: f64| RBig::try_from(bound).unwrap().sqr();
        let root = range.sqrt();
        prop_assert!(square(root.lower()) <= exact && exact <= square(root.upper()));
        let length = range.hypot(other);
        let sum = square(x) + square(y);
        prop_assert!(square(length.lower()) <= sum && sum <= square(length.upper()));
        prop_assert!(range.min(other).contains(x.min(y)) && range.max(other).contains(x.max(y)));
        prop_assert!(other.step().contains(y.step()) && other.sign_value().contains(y.sign_value()));
    }

    #[test]
    fn whole_powers_are_enclosed((range, x) in within(-3.0, 3.0), exponent in -7..=7_i32) {
        let exact = RBig::try_from(x).unwrap();
        let power = exact.pow(isize::try_from(exponent.unsigned_abs()).unwrap());
        let found = range.power(Interval::point(f64::from(exponent)));
        let value = if exponent >= 0 { power } else if x == 0.0 { return Ok(()) } else { RBig::ONE / power };
        let above = found.upper() == f64::INFINITY || RBig::try_from(found.upper()).unwrap() >= value;
        let below = found.lower() == f64::NEG_INFINITY || RBig::try_from(found.lower()).unwrap() <= value;
        prop_assert!(above && below);
    }

    #[test]
    fn functions_of_one_number_are_narrow(x in 0.01..0.99_f64) {
        let point = Interval::point(x);
        let functions = [Real::sin, Real::cos, Real::tan, Real::asin, Real::acos, Real::atan, Real::exp, Real::ln,
            Real::sinh, Real::cosh, Real::tanh, Real::log10, Real::sqrt];
        for function in functions {
            let value: Interval = function(point);
            prop_assert!(value.width() <= 10.0 * f64::EPSILON * value.magnitude());
        }
    }
}

#[test]
fn pi_is_enclosed() {
    assert!(holds(Interval::PI, &half_turn()));
    assert!(!holds(Interval::point(std::f64::consts::PI), &half_turn()));
}

#[test]
fn extrema_within_an_interval_are_found() {
    let range = |lower: f64, upper: f64| Interval::new(lower, upper).unwrap();
    assert_eq!(range(1.0, 2.0).sin().upper(), 1.0);
    assert_eq!(range(-2.0, -1.0).sin().lower(), -1.0);
    assert_eq!(range(-0.1, 0.1).cos().upper(), 1.0);
    assert_eq!(range(3.0, 3.3).cos().lower(), -1.0);
    assert_eq!(range(0.0, 10.0).cos(), range(-1.0, 1.0));
    assert_eq!(range(1e17, 1e17 + 16.0).sin(), range(-1.0, 1.0));
    assert_eq!(range(-2.0, 1.0).power(Interval::point(2.0)), range(0.0, 4.0));
    assert_eq!(range(-2.0, 1.0).cosh().lower(), 1.0);
}

#[test]
fn exact_values_stay_exact() {
    let (zero, one) = (Interval::ZERO, Interval::ONE);
    for value in [zero.sin(), zero.tan(), zero.atan(), zero.sinh(), one.ln(), one.acos(), zero.sqrt()] {
        assert_eq!(value, zero);
    }
    assert_eq!([zero.cos(), zero.exp(), zero.cosh()], [one; 3]);
    assert_eq!(Interval::point(9.0).sqrt(), Interval::point(3.0));
    assert_eq!(Interval::point(3.0).power(Interval::point(4.0)), Interval::point(81.0));
    assert_eq!(zero.hypot(Interval::point(-2.0)), Interval::point(2.0));
    assert_eq!(zero.atan2(one), zero);
}

#[test]
fn nothing_is_claimed_outside_of_a_domain() {
    let range = |lower: f64, upper: f64| Interval::new(lower, upper).unwrap();
    let sign_change = range(-1e-9, 1.0);
    for value in [sign_change.sqrt(), sign_change.ln(), sign_change.power(Interval::point(0.5))] {
        assert!(!value.is_finite());
    }
    assert!(!range(0.5, 1.5).asin().is_finite() && !range(-1.5, 0.5).acos().is_finite());
    assert!(!range(1.5, 1.6).tan().is_finite());
    assert!(!sign_change.power(Interval::point(-1.0)).is_finite());
    let around_cut = range(-0.1, 0.1).atan2(range(-2.0, -1.0));
    assert!(around_cut.lower() < -3.0 && around_cut.upper() > 3.0);
}
