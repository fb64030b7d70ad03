//! Parameters that are only known within bounds: `mu = "0.1..0.15"`.

use super::{Model, Parameter};
use crate::expression::{
    Expression, ExpressionFault, ExpressionFaultKind, Names, TO, Values, ends_of_range, parse,
};
use crate::fault::{Fault, Faults};
use crate::interval::Interval;
use crate::units::Unit;

/// A parameter that is known within bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterRange {
    /// Its name.
    pub name: String,
    /// Its lower bound (SI units).
    pub from: f64,
    /// Its upper bound.
    pub to: f64,
    /// The value that counts where one is needed: the middle.
    pub middle: f64,
    /// The unit in which texts show it.
    pub shown_in: Unit,
}

impl ParameterRange {
    /// The bounds as an interval.
    pub fn interval(&self) -> Interval {
        Interval::point(self.from).hull(Interval::point(self.to))
    }
}

/// The value of a parameter: an expression, or the middle of a range with its ends.
pub(super) type Parsed = (Expression, Option<Box<[Expression; 2]>>);

/// Reads an expression, or a range of two, `from..to`.
///
/// # Errors
/// The faults of the expressions, with places in the whole text.
pub(super) fn parse_value(text: &str, names: &Names) -> Result<Parsed, Vec<ExpressionFault>> {
    let three_dots = |span| vec![ExpressionFault { kind: ExpressionFaultKind::ThreeDots, span }];
    let Some((from, to)) = ends_of_range(text).map_err(three_dots)? else {
        return Ok((parse(text, names)?, None));
    };
    let start = from.len() + TO.len();
    let ends = [(from, 0), (to, start)].map(|(end, offset)| {
        parse(end, names).map_err(|mut faults| {
            for fault in &mut faults {
                fault.span = fault.span.start + offset..fault.span.end + offset;
            }
            faults
        })
    });
    match ends {
        [Ok(lower), Ok(upper)] => {
            let middle = parse(&format!("(({from}) + ({to})) / 2"), names)?;
            Ok((middle, Some(Box::new([lower, upper]))))
        }
        ends => Err(ends.into_iter().filter_map(Result::err).flatten().collect()),
    }
}

impl Model {
    /// The parameters that are known within bounds, in the order of the file.
    ///
    /// # Errors
    /// The faults of the model's values.
    pub fn ranges(&self) -> Result<Vec<ParameterRange>, Faults> {
        if self.parameters.iter().all(|parameter| self.formula(parameter.value).range.is_none()) {
            return Ok(Vec::new());
        }
        let values = self.parameter_values(&self.constants()?);
        let ranges = self.parameters.iter().zip(&values).filter_map(|(parameter, &middle)| {
            let [from, to] = self.range_ends(parameter, &values)?.ok()?;
            let name = parameter.name.to_string();
            let shown_in = self.units.parameter(&name, &self.parameter_unit(&name));
            Some(ParameterRange { name, from, to, middle, shown_in })
        });
        Ok(ranges.collect())
    }

    /// A fault for each range that has an end without a value.
    pub(super) fn check_ranges(&self, values: &[Option<f64>], faults: &mut Faults) {
        let values: Vec<f64> =
            self.parameters.iter().map(|parameter| values[parameter.value.index()].unwrap_or(0.0)).collect();
        for parameter in &self.parameters {
            if let Some(Err(fault)) = self.range_ends(parameter, &values) {
                faults.push(fault);
            }
        }
    }

    /// The ends of a parameter's range, if it has one, the smaller one first in whichever order they are written.
    fn range_ends(&self, parameter: &Parameter, parameters: &[f64]) -> Option<Result<[f64; 2], Fault>> {
        let formula = self.formula(parameter.value);
        let values = Values::of_parameters(parameters);
        let end = |end: &Expression| end.evaluate(&values).map_err(|fault| formula.origin.fault(fault));
        let [from, to] = formula.range.as_deref()?;
        Some(end(from).and_then(|from| end(to).map(|to| [from.min(to), from.max(to)])))
    }
}
