//! Values of arguments.

use slideway::units::Unit;
use std::time::Duration;

/// A positive number.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("it must be a positive number".to_owned()),
    }
}

/// A pressure and the unit in which it was typed.
#[derive(Debug, Clone)]
pub(super) struct Pressure {
    /// In Pa.
    pub(super) value: f64,
    pub(super) unit: Unit,
}

/// A positive pressure with its unit, such as 2 MPa or 2 N/mm^2.
pub(super) fn pressure(text: &str) -> Result<Pressure, String> {
    match Unit::of_quantity(text) {
        Some((value, unit)) if unit.si() == "Pa" && value > 0.0 && value.is_finite() => {
            Ok(Pressure { value, unit })
        }
        _ => Err("it must be a positive pressure with its unit, such as `2 MPa` or `2 N/mm^2`".to_owned()),
    }
}

/// A time such as 30s, 500ms, 2min, 1.5h; seconds without a unit.
pub(super) fn duration(text: &str) -> Result<Duration, String> {
    let number = text.trim_end_matches(char::is_alphabetic);
    let factor = match &text[number.len()..] {
        "ms" => 1e-3,
        "s" | "" => 1.0,
        "min" => 60.0,
        "h" => 3600.0,
        unit => return Err(format!("the unit `{unit}` is none of ms, s, min, h")),
    };
    let seconds = number.trim_end().parse::<f64>().map_err(|_| format!("`{number}` is not a number"))?;
    Duration::try_from_secs_f64(seconds * factor).map_err(|_| "it must be a positive time".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressures_have_units() {
        for (text, pascals) in [("2 MPa", 2e6), ("2 N/mm^2", 2e6), ("350kPa", 3.5e5), ("1e5 Pa", 1e5)] {
            assert_eq!(pressure(text).map(|pressure| pressure.value), Ok(pascals), "{text}");
        }
        for text in ["2", "2 N", "-1 MPa", "0 Pa", "MPa", "1e400 Pa", "nan Pa", ""] {
            assert!(pressure(text).is_err(), "{text}");
        }
    }

    #[test]
    fn times_have_units() {
        let table =
            [("30s", 30.0), ("500ms", 0.5), ("2min", 120.0), ("1.5h", 5400.0), ("7", 7.0), ("0", 0.0)];
        for (text, seconds) in table {
            assert_eq!(duration(text), Ok(Duration::from_secs_f64(seconds)), "{text}");
        }
        for text in ["", "s", "-1s", "1 day", "1e400", "nan", "inf", "s30"] {
            assert!(duration(text).is_err(), "{text}");
        }
    }
}
