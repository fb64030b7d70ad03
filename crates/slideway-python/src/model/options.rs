//! Options of questions beside the model.

use crate::arguments::{optional_count, varied};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use slideway::map::{ColourBy, GREATEST_SIZE};
use slideway::{HoldOptions, MapOptions};
use std::ops::RangeInclusive;

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
