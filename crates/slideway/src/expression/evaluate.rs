//! The value of an expression.

use super::fault::{ExpressionFault, ExpressionFaultKind};
use super::function::Binary;
use super::names::Symbol;
use super::parser::MAX_DEPTH;
use super::program::{Expression, Operation, Step};
use crate::interval::Real;

/// The values of everything a name can stand for, in SI units.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a, T = f64> {
    /// Parameters, in the order in which they were added to [`Names`](super::Names).
    pub parameters: &'a [T],
    /// Coordinates, in the same way.
    pub coordinates: &'a [T],
    /// Rates of change of the coordinates, in the order of the coordinates.
    pub rates: &'a [T],
    /// Time, in s.
    pub time: T,
    /// The absolute sliding velocity of a joint, in m/s.
    pub sliding_speed: T,
}

impl<'a, T: Real> Values<'a, T> {
    /// Those of parameters alone, at rest at time zero.
    pub fn of_parameters(parameters: &'a [T]) -> Self {
        Self { parameters, coordinates: &[], rates: &[], time: T::zero(), sliding_speed: T::zero() }
    }

    fn of(&self, symbol: Symbol) -> Result<T, ExpressionFaultKind> {
        let value = match symbol {
            Symbol::Parameter(index) => self.parameters.get(index).copied(),
            Symbol::Coordinate(index) => self.coordinates.get(index).copied(),
            Symbol::Rate(index) => self.rates.get(index).copied(),
            Symbol::Time => Some(self.time),
            Symbol::SlidingSpeed => Some(self.sliding_speed),
        };
        value.ok_or(ExpressionFaultKind::MissingValue { symbol })
    }
}

/// Height of the stack that holds almost every expression; a deeper one costs clearing more memory.
const USUAL_HEIGHT: usize = 16;

/// Every nesting level holds back at most one value.
const MAX_HEIGHT: usize = MAX_DEPTH + 2;

impl Expression {
    /// The value in SI units; of intervals, one that holds all values that the expression has there.
    ///
    /// # Errors
    ///
    /// When a part has no finite value: a division by zero, a function outside its domain, an overflow, or a
    /// missing or infinite value of a symbol. The fault carries the arguments and points at the innermost
    /// such part.
    ///
    /// ```
    /// use slideway::expression::{ExpressionFaultKind, Names, Values, parse};
    ///
    /// let values = Values::<f64>::of_parameters(&[]);
    /// let fault = parse("2 + 1/t", &Names::new()).unwrap().evaluate(&values).unwrap_err();
    /// assert_eq!(fault.kind, ExpressionFaultKind::DivisionByZero { numerator: 1.0 });
    /// assert_eq!(fault.span, 4..7);
    /// ```
    pub fn evaluate<T: Real>(&self, values: &Values<'_, T>) -> Result<T, ExpressionFault> {
        run(self, values, Operation::apply)
    }
}

impl Operation {
    /// The value of an operator, function or table at its arguments.
    pub(super) fn apply<T: Real>(&self, arguments: &[T]) -> T {
        match self {
            Self::Unary(function) => function.value(arguments[0]),
            Self::Binary(function) => function.value(arguments[0], arguments[1]),
            Self::Table(table) => table.at(arguments[0]),
            Self::Number { .. } | Self::Symbol(_) => T::zero(),
        }
    }
}

/// Runs the steps of an expression; `apply` has the values of operators, functions and tables.
pub(super) fn run<T: Real>(
    expression: &Expression,
    values: &Values<'_, T>,
    apply: impl FnMut(&Operation, &[T]) -> T,
) -> Result<T, ExpressionFault> {
    if expression.greatest_height() <= USUAL_HEIGHT {
        run_on(expression.steps(), values, &mut [T::zero(); USUAL_HEIGHT], apply)
    } else {
        run_on(expression.steps(), values, &mut [T::zero(); MAX_HEIGHT], apply)
    }
}

/// `stack[..height]` holds the values not yet used.
fn run_on<T: Real>(
    steps: &[Step],
    values: &Values<'_, T>,
    stack: &mut [T],
    mut apply: impl FnMut(&Operation, &[T]) -> T,
) -> Result<T, ExpressionFault> {
    let mut height = 0;
    for step in steps {
        let value = match &step.operation {
            Operation::Number { value, enclosure, .. } => T::written(*value, *enclosure),
            Operation::Symbol(symbol) => values.of(*symbol).map_err(|kind| fault(kind, step))?,
            operation => {
                let before = height;
                height -= operation.arguments();
                apply(operation, &stack[height..before])
            }
        };
        if !value.is_finite() {
            return Err(fault(not_finite(&step.operation, &stack[height..], value), step));
        }
        stack[height] = value;
        height += 1;
    }
    Ok(stack[0])
}

fn fault(kind: ExpressionFaultKind, step: &Step) -> ExpressionFault {
    ExpressionFault::new(kind, step.span.clone())
}

fn not_finite<T: Real>(operation: &Operation, arguments: &[T], value: T) -> ExpressionFaultKind {
    let numbers = |count: usize| arguments[..count].iter().map(|argument| argument.middle()).collect();
    match operation {
        Operation::Number { .. } | Operation::Symbol(_) => {
            ExpressionFaultKind::ValueNotFinite { value: value.middle() }
        }
        Operation::Unary(function) => {
            ExpressionFaultKind::NotFinite { operation: function.name().to_owned(), arguments: numbers(1) }
        }
        Operation::Binary(Binary::Divide) if arguments[1].is_zero() => {
            ExpressionFaultKind::DivisionByZero { numerator: arguments[0].middle() }
        }
        Operation::Table(table) => {
            ExpressionFaultKind::NotFinite { operation: table.name.to_string(), arguments: numbers(1) }
        }
        Operation::Binary(function) => {
            ExpressionFaultKind::NotFinite { operation: function.name().to_owned(), arguments: numbers(2) }
        }
    }
}
