//! Where a number lies that is written with decimal digits.

use crate::interval::Interval;

/// The numbers that a decimal may be whose nearest number is `value`: that one alone where the decimal is
/// exactly it, else all from the number below to the number above. Digits may be separated by `_`.
pub(super) fn enclosure(value: f64, written: &str) -> Interval {
    if is_exact(value, written) == Some(true) {
        return Interval::point(value);
    }
    Interval::new(value.next_down(), value.next_up()).unwrap_or(Interval::REAL_LINE)
}

/// Whether a decimal is a number with 53 binary digits; nothing if it is too long to tell.
///
/// `m 10^-k` is `(m / 5^k) 2^-k`, which has as many binary digits as `m / 5^k` if that is whole.
fn is_exact(value: f64, written: &str) -> Option<bool> {
    let unsigned = written.strip_prefix(['+', '-']).unwrap_or(written);
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.replace('_', "").parse::<i32>().ok()?),
        None => (unsigned, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let fraction = fraction.trim_end_matches(['0', '_']);
    let (mut number, mut power) = (0_u64, exponent);
    for (digits, step) in [(whole, 0), (fraction, 1)] {
        for character in digits.chars().filter(|character| *character != '_') {
            number = number.checked_mul(10)?.checked_add(u64::from(character.to_digit(10)?))?;
            power = power.checked_sub(step)?;
        }
    }
    if number == 0 {
        return Some(true);
    }
    let fives = 5_u64.checked_pow(power.unsigned_abs())?;
    if power >= 0 {
        number = number.checked_mul(fives)?;
    } else if number.is_multiple_of(fives) {
        number /= fives;
    } else {
        return Some(false);
    }
    let has_full_precision = value.abs() >= f64::MIN_POSITIVE;
    Some(has_full_precision && (number >> number.trailing_zeros()) < 1 << f64::MANTISSA_DIGITS)
}
