//! Values of arguments.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use slideway::choice::Choice;
use slideway::units::Unit;
use std::time::Duration;

/// One of a few by its word, with what each means for the help.
pub(super) fn choice<C: Choice + Send + Sync>() -> impl TypedValueParser<Value = C> {
    let words = C::CHOICES.iter().map(|(_, word, meaning)| PossibleValue::new(*word).help(*meaning));
    PossibleValuesParser::new(words).map(|word| C::of_word(&word).expect("one of the words"))
}

/// A positive number, such as 1.5 or 150 %.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    limit(text, &[""], "a positive number, such as `1.5`").map(|limit| limit.value)
}

/// A limit in SI units, and the unit in which it was typed, if it has one.
#[derive(Debug, Clone)]
pub(super) struct Limit {
    pub(super) value: f64,
    pub(super) unit: Option<Unit>,
}

/// A positive quantity with one of these SI units, or multiples of them; a bare number is in SI units.
fn limit(text: &str, si: &[&str], wanted: &str) -> Result<Limit, String> {
    let bare = || text.parse::<f64>().ok().map(|value| Limit { value, unit: None });
    let with_unit = || Unit::of_quantity(text).map(|(value, unit)| Limit { value, unit: Some(unit) });
    let is_right = |limit: &Limit| {
        let has_unit = limit.unit.as_ref().is_none_or(|unit| si.contains(&unit.si()));
        has_unit && limit.value > 0.0 && limit.value.is_finite()
    };
    bare().or_else(with_unit).filter(is_right).ok_or_else(|| format!("it must be {wanted}"))
}

/// An effort, such as 30 N or 2 N m.
pub(super) fn effort(text: &str) -> Result<Limit, String> {
    limit(text, &["N", "N m"], "positive, such as `30 N` or `2 N m`")
}

/// A force, such as 2 kN.
pub(super) fn force(text: &str) -> Result<Limit, String> {
    limit(text, &["N"], "a positive force, such as `2 kN`")
}

/// A pressure, such as 2 MPa or 2 N/mm^2: without a unit nobody means Pa.
pub(super) fn pressure(text: &str) -> Result<Limit, String> {
    let wanted = "a positive pressure with its unit, such as `2 MPa` or `2 N/mm^2`";
    limit(text, &["Pa"], wanted)
        .and_then(|limit| if limit.unit.is_some() { Ok(limit) } else { Err(format!("it must be {wanted}")) })
}

/// An efficiency, such as 0.7 or 70 %.
pub(super) fn efficiency(text: &str) -> Result<Limit, String> {
    let wanted = "above 0 and at most 1, such as `0.7` or `70 %`";
    match limit(text, &[""], wanted)? {
        Limit { value, .. } if value <= 1.0 => Ok(Limit { value, unit: None }),
        _ => Err(format!("it must be {wanted}")),
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
    fn efforts_and_forces_may_have_units() {
        for (text, newtons) in [("30", 30.0), ("30 N", 30.0), ("8.3kN", 8300.0)] {
            assert_eq!(force(text).map(|limit| limit.value), Ok(newtons), "{text}");
            assert_eq!(effort(text).map(|limit| limit.value), Ok(newtons), "{text}");
        }
        assert_eq!(effort("2 N m").map(|limit| limit.value), Ok(2.0));
        for text in ["2 N m", "2 mm", "-1 N", "0", "nan", "inf", ""] {
            assert!(force(text).is_err(), "{text}");
        }
    }

    #[test]
    fn efficiencies_are_at_most_one() {
        for (text, ratio) in [("0.7", 0.7), ("70 %", 0.7), ("70%", 0.7), ("1", 1.0)] {
            assert_eq!(efficiency(text).map(|limit| limit.value), Ok(ratio), "{text}");
        }
        for text in ["95", "101 %", "0", "-0.5", "nan", "%", ""] {
            assert!(efficiency(text).is_err(), "{text}");
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
