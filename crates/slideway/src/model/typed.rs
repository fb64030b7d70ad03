//! The units in which the quantities of a model file were typed.

use super::{Formula, Model, Value};
use crate::expression::{Dimension, Names, TO, written_units};
use crate::fault::Doubt;
use crate::units::{TypedUnits, Unit};

impl Model {
    /// Returns the units behind the numbers of the file and, as SI units, its bare numbers where the
    /// dimension is that of the place. Zero has no unit, and only their unit distinguishes angles from other
    /// pure numbers.
    pub(super) fn typed_units(&self, text: &str) -> TypedUnits {
        let names = self.names();
        let mut formulas: Vec<&Formula> =
            self.formulas.iter().filter(|formula| !formula.origin.span.is_empty()).collect();
        formulas.sort_by_key(|formula| formula.origin.span.start);
        // The two sides of a contact may have one formula in the file.
        formulas.dedup_by_key(|formula| formula.origin.span.start);
        let mut typed = TypedUnits::default();
        for formula in formulas {
            units_of(formula, text, &names).into_iter().for_each(|unit| typed.add(unit));
        }
        for parameter in &self.parameters {
            let written = written(self.formula(parameter.value), text);
            if let Some(unit) = Value::Text(written.to_owned()).unit() {
                typed.parameter(&parameter.name, unit);
            }
        }
        typed
    }
}

impl Value {
    /// The unit behind its number, or behind both numbers of a range.
    pub(crate) fn unit(&self) -> Option<Unit> {
        let Self::Text(text) = self else { return None };
        match text.split_once(TO) {
            None => behind(text),
            Some((from, to)) => behind(from).filter(|unit| behind(to).as_ref() == Some(unit)),
        }
    }

    /// A doubt if it is typed without a unit where the model has another one than that of the SI. Numbers that
    /// come from programs are in SI units on purpose.
    pub(crate) fn without_unit(&self, what: &str, unit: Option<Unit>) -> Option<Doubt> {
        let Self::Text(text) = self else { return None };
        let value = text.trim().parse::<f64>().ok().filter(|value| *value != 0.0)?;
        let unit = unit.filter(|unit| unit.scale() != 1.0)?;
        let (si, unit) = (unit.si().to_owned(), unit.name().to_owned());
        Some(Doubt::BareNumber { what: what.to_owned(), value, si, unit })
    }
}

/// The unit behind the only number of a text; nothing if there is none, or more than a number.
fn behind(text: &str) -> Option<Unit> {
    Unit::of_quantity(text).map(|(_, unit)| unit)
}

/// The text of a formula in the file, without its quotation marks.
fn written<'t>(formula: &Formula, text: &'t str) -> &'t str {
    let span = &formula.origin.span;
    match formula.origin.expression_start {
        Some(start) => text.get(start..span.end - 1).unwrap_or_default(),
        None => text.get(span.clone()).unwrap_or_default(),
    }
}

fn units_of(formula: &Formula, text: &str, names: &Names) -> Vec<Unit> {
    let written = written(formula, text);
    if let Ok(number) = written.parse::<f64>() {
        let si = formula.wanted.filter(|_| number != 0.0).map(Dimension::unit);
        return si.into_iter().map(|si| Unit::si_unit(&si)).collect();
    }
    let parts = written.split(TO);
    parts.flat_map(|part| written_units(part, names)).map(|unit| Unit::from(&unit)).collect()
}
