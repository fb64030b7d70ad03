//! What is asked of a question beside the model.

use crate::arguments::{optional_count, value, varied};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use slideway::map::{ColourBy, GREATEST_SIZE};
use slideway::units::Unit;
use slideway::{HoldOptions, MapOptions, Value};
use std::ops::RangeInclusive;

/// A limit of this name, with the unit in which it was typed.
pub(super) fn limit(name: &str, given: &Bound<'_, PyAny>) -> PyResult<(f64, Option<Unit>)> {
    let (units, wanted): (&[&str], _) = match name {
        "max_effort" => (&["N", "N m"], "positive, such as '30 N' or '2 N m'"),
        "max_normal_force" => (&["N"], "a positive force, such as '2 kN'"),
        "max_pressure" => (&["Pa"], "a positive pressure, such as '2 MPa' or '2 N/mm^2'"),
        "min_efficiency" => (&[""], "above 0 and at most 1, such as 0.7 or '70 %'"),
        _ => (&[""], "greater than zero"),
    };
    let refused = || PyValueError::new_err(format!("{name} must be {wanted}"));
    let (number, unit) = match value(name, given)? {
        Value::Number(number) => (number, None),
        text => {
            let (number, unit) = Unit::of_quantity(&text.to_string()).ok_or_else(refused)?;
            (number, Some(unit))
        }
    };
    let has_unit = unit.as_ref().is_none_or(|unit| units.contains(&unit.si()));
    let is_allowed = has_unit && number > 0.0 && (name != "min_efficiency" || number <= 1.0);
    is_allowed.then_some((number, unit)).ok_or_else(refused)
}

/// Refuses a count outside of its range.
pub(super) fn within(name: &str, given: i64, range: RangeInclusive<usize>) -> PyResult<usize> {
    if let Some(count) = usize::try_from(given).ok().filter(|count| range.contains(count)) {
        return Ok(count);
    }
    let (least, most) = range.into_inner();
    Err(PyValueError::new_err(format!("{name} must be from {least} to {most}, not {given}")))
}

/// How a mechanism is asked to rest.
pub(super) fn hold(load: Option<String>, vary: Option<String>, drives: &str) -> PyResult<HoldOptions> {
    let holds = match drives {
        "release" => false,
        "hold" => true,
        _ => {
            return Err(PyValueError::new_err(format!("drives must be 'release' or 'hold', not {drives:?}")));
        }
    };
    let mut options = HoldOptions::default().hold_drives(holds);
    (options.load, options.vary) = (load, vary);
    Ok(options)
}

/// A map of two quantities, of this size in pixels, with a probe every so many of them.
pub(super) fn map(
    axes: Option<&Bound<'_, PyDict>>,
    colour_by: ColourBy,
    (size, probe): (Option<(i64, i64)>, Option<i64>),
) -> PyResult<MapOptions> {
    let Ok([x, y]) = <[_; 2]>::try_from(varied(axes)?) else {
        return Err(PyTypeError::new_err("two quantities must be given, such as map(mu=(0, 1), x=(0, 0.3))"));
    };
    let mut options = MapOptions::new(x, y).colour_by(colour_by);
    if let Some((width, height)) = size {
        let width = within("width and height in size", width, 1..=GREATEST_SIZE)?;
        let height = within("width and height in size", height, 1..=GREATEST_SIZE)?;
        options = options.size(width, height);
    }
    Ok(match optional_count("probe", probe)? {
        Some(pixels) => options.probe(pixels),
        None => options,
    })
}

/// Branches as the library counts them, from 0.
pub(super) fn branches(counted_from_one: Vec<i64>) -> PyResult<Vec<usize>> {
    let refused = |branch| PyValueError::new_err(format!("branches are counted from 1, not {branch}"));
    let index = |branch: i64| branch.checked_sub(1).and_then(|index| usize::try_from(index).ok());
    counted_from_one.into_iter().map(|branch| index(branch).ok_or_else(|| refused(branch))).collect()
}

/// Whether sliding is preferred where a motion branches.
pub(super) fn prefers_sliding(prefer: &str) -> PyResult<bool> {
    match prefer {
        "rule" => Ok(false),
        "sliding" => Ok(true),
        _ => Err(PyValueError::new_err(format!("prefer must be 'rule' or 'sliding', not {prefer:?}"))),
    }
}
