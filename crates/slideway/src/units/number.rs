//! Numbers for people: five significant digits, six of limits, four in sentences.

/// Values below this multiple of the greatest beside them are rounding errors, and shown as 0.
const NOISE: f64 = 1e-13;

/// A number with five significant digits; scientific where it is very large or small.
pub(crate) fn number(value: f64) -> String {
    significant(value, 5)
}

/// A number of a sentence: at most four significant digits.
pub(crate) fn brief(value: f64) -> String {
    significant(value, 4)
}

fn significant(value: f64, digits: i32) -> String {
    if !value.is_finite() {
        // Reports hold no such number; what is computed from theirs may still be too large.
        let words = if value.is_nan() {
            "undefined"
        } else {
            ["below -1e308", "beyond 1e308"][usize::from(value > 0.0)]
        };
        return words.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", usize::try_from(digits - 1).unwrap_or(0));
    let exponent: i32 =
        scientific.split_once('e').and_then(|(_, exponent)| exponent.parse().ok()).unwrap_or(0);
    if !(-4..6).contains(&exponent) {
        let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        return format!("{}e{exponent}", without_end_zeros(mantissa));
    }
    // The significant digits, and all of an integer part.
    let decimals = usize::try_from(digits - 1 - exponent).unwrap_or(0);
    without_end_zeros(&format!("{value:.decimals$}")).to_owned()
}

/// A number without the zeros at the end of its decimals.
fn without_end_zeros(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// [`number`], with rounding errors against `scale` shown as 0.
pub(crate) fn against(value: f64, scale: f64) -> String {
    number(beside(value, scale))
}

/// A value, but 0 where it is a rounding error beside the greatest of those that it is the sum of.
pub(crate) fn beside(value: f64, scale: f64) -> f64 {
    if value.abs() <= NOISE * scale { 0.0 } else { value }
}

/// Six significant digits, as limits are known to more than other numbers.
pub fn precise(value: f64) -> String {
    significant(value, 6)
}

/// A number of things, in a word if it is small: "two".
pub(crate) fn counted(number: usize) -> String {
    match number {
        2 => "two".to_owned(),
        3 => "three".to_owned(),
        4 => "four".to_owned(),
        5 => "five".to_owned(),
        6 => "six".to_owned(),
        several => several.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::{against, brief, number, precise};

    #[test]
    fn sentences_have_four_significant_digits() {
        let told = [
            (36.363_636, "36.36"),
            (0.666_666_7, "0.6667"),
            (2.222_222_2, "2.222"),
            (0.001_234_56, "0.001235"),
        ];
        for (value, text) in told {
            assert_eq!(brief(value), text);
        }
        assert_eq!(
            [brief(20.0), brief(123_456.7), brief(0.0), brief(1.234_56e7)],
            ["20", "123457", "0", "1.235e7"]
        );
    }

    #[test]
    fn five_significant_digits() {
        let table = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.123_456_789, "0.12346"),
            (-12.000_04, "-12"),
            (99_999.96, "100000"),
            (123_456.7, "123457"),
            (0.000_123_456, "0.00012346"),
            (1.234_56e-5, "1.2346e-5"),
            (-2.5e7, "-2.5e7"),
            (f64::INFINITY, "beyond 1e308"),
            (f64::NEG_INFINITY, "below -1e308"),
            (f64::NAN, "undefined"),
        ];
        for (value, text) in table {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn limits_have_six_significant_digits() {
        let table = [
            (2.0 / 3.0, "0.666667"),
            (0.15, "0.15"),
            (1_283.330_1, "1283.33"),
            (-301.234_567, "-301.235"),
            (0.000_123_456_7, "0.000123457"),
            (999_999.9, "1e6"),
            (1_234_567.0, "1.23457e6"),
            (0.0, "0"),
        ];
        for (value, text) in table {
            assert_eq!(precise(value), text);
        }
    }

    #[test]
    fn rounding_errors_are_shown_as_zero() {
        assert_eq!(against(1e-15, 10.0), "0");
        assert_eq!(against(1e-9, 10.0), "1e-9");
        assert_eq!(against(-1e-15, 0.0), "-1e-15");
    }
}
