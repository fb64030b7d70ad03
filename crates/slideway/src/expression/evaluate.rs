//! The value of an expression.

use super::fault::{ExpressionFault, ExpressionFaultKind};
use super::function::Binary;
use super::names::Symbol;
use super::parser::MAX_DEPTH;
use super::program::{Expression, Operation, Step};

/// The values of everything a name can stand for, in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    /// Parameters, in the order in which they were added to [`Names`](super::Names).
    pub parameters: &'a [f64],
    /// Coordinates, in the same way.
    pub coordinates: &'a [f64],
    /// Rates of change of the coordinates, in the order of the coordinates.
    pub rates: &'a [f64],
    /// Time, in s.
    pub time: f64,
}

impl Values<'_> {
    fn of(&self, symbol: Symbol) -> Result<f64, ExpressionFaultKind> {
        let value = match symbol {
            Symbol::Parameter(index) => self.parameters.get(index).copied(),
            Symbol::Coordinate(index) => self.coordinates.get(index).copied(),
            Symbol::Rate(index) => self.rates.get(index).copied(),
            Symbol::Time => Some(self.time),
        };
        value.ok_or(ExpressionFaultKind::MissingValue { symbol })
    }
}

/// Height of the stack that holds almost every expression; a deeper one costs clearing more memory.
const USUAL_HEIGHT: usize = 16;

/// Every nesting level holds back at most one value.
const MAX_HEIGHT: usize = MAX_DEPTH + 2;

impl Expression {
    /// The value in SI units.
    ///
    /// # Errors
    ///
    /// When a part has no finite value: a division by zero, a function outside its domain, an overflow, or a missing
    /// or infinite value of a symbol. The fault carries the arguments and points at the innermost such part.
    ///
    /// ```
    /// use slideway::expression::{ExpressionFaultKind, Names, Values, parse};
    ///
    /// let values = Values { parameters: &[], coordinates: &[], rates: &[], time: 0.0 };
    /// let fault = parse("2 + 1/t", &Names::new()).unwrap().evaluate(&values).unwrap_err();
    /// assert_eq!(fault.kind, ExpressionFaultKind::DivisionByZero { numerator: 1.0 });
    /// assert_eq!(fault.span, 4..7);
    /// ```
    pub fn evaluate(&self, values: &Values<'_>) -> Result<f64, ExpressionFault> {
        if self.greatest_height() <= USUAL_HEIGHT {
            run(self.steps(), values, &mut [0.0; USUAL_HEIGHT])
        } else {
            run(self.steps(), values, &mut [0.0; MAX_HEIGHT])
        }
    }
}

/// Runs the steps; `stack[..height]` holds the values not yet used.
fn run(steps: &[Step], values: &Values<'_>, stack: &mut [f64]) -> Result<f64, ExpressionFault> {
    let mut height = 0;
    for step in steps {
        let value = match step.operation {
            Operation::Number { value, .. } => value,
            Operation::Symbol(symbol) => values.of(symbol).map_err(|kind| fault(kind, step))?,
            Operation::Unary(function) => {
                height -= 1;
                function.value(stack[height])
            }
            Operation::Binary(function) => {
                height -= 2;
                function.value(stack[height], stack[height + 1])
            }
        };
        if !value.is_finite() {
            return Err(fault(not_finite(step.operation, &stack[height..], value), step));
        }
        stack[height] = value;
        height += 1;
    }
    Ok(stack[0])
}

fn fault(kind: ExpressionFaultKind, step: &Step) -> ExpressionFault {
    ExpressionFault::new(kind, step.span.clone())
}

fn not_finite(operation: Operation, arguments: &[f64], value: f64) -> ExpressionFaultKind {
    match operation {
        Operation::Number { .. } | Operation::Symbol(_) => ExpressionFaultKind::ValueNotFinite { value },
        Operation::Unary(function) => {
            ExpressionFaultKind::NotFinite { operation: function.name(), arguments: arguments[..1].to_vec() }
        }
        Operation::Binary(Binary::Divide) if arguments[1] == 0.0 => {
            ExpressionFaultKind::DivisionByZero { numerator: arguments[0] }
        }
        Operation::Binary(function) => {
            ExpressionFaultKind::NotFinite { operation: function.name(), arguments: arguments[..2].to_vec() }
        }
    }
}
