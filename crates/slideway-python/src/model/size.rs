//! The limits that `Model.size` is asked to keep.

use crate::arguments::value;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use slideway::limits::Vary;
use slideway::size::{Against, FrictionMargin};
use slideway::units::Unit;
use slideway::{Faults, Model, SizeOptions, Value};

/// The arguments of which one is given.
const NAMES: [&str; 5] = ["margin", "max_effort", "max_normal_force", "max_pressure", "min_efficiency"];

/// The one limit that is given, with the unit in which it was typed.
pub(super) struct Demand {
    name: &'static str,
    limit: f64,
    typed_in: Option<Unit>,
}

impl Demand {
    /// Reads the one limit of [`NAMES`] that is given.
    pub(super) fn new(given: [Option<&Bound<'_, PyAny>>; 5]) -> PyResult<Self> {
        let given = NAMES.into_iter().zip(given).filter_map(|(name, value)| Some((name, value?)));
        let [(name, wanted)] = *given.collect::<Vec<_>>() else {
            let [others @ .., last] = NAMES;
            let message = format!("exactly one of {} and {last} must be given", others.join(", "));
            return Err(PyTypeError::new_err(message));
        };
        let (limit, typed_in) = limit(name, wanted)?;
        Ok(Self { name, limit, typed_in })
    }

    /// Of what it is the limit.
    pub(super) fn against(
        &self,
        margin: FrictionMargin,
        load: Option<String>,
        model: &Model,
    ) -> Result<Against, Faults> {
        match self.name {
            "max_effort" => Ok(Against::Effort { drive: load }),
            "max_normal_force" => Ok(Against::NormalForce { contact: load }),
            "max_pressure" => Ok(Against::Pressure { contact: load }),
            "min_efficiency" => Against::efficiency(load),
            _ => Against::margin(margin, load, model),
        }
    }

    /// The question over a range.
    pub(super) fn options(self, range: Vary) -> SizeOptions {
        SizeOptions::new(range, self.limit).typed_in(self.typed_in)
    }
}

/// A limit of this name, with the unit in which it was typed.
fn limit(name: &str, given: &Bound<'_, PyAny>) -> PyResult<(f64, Option<Unit>)> {
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
