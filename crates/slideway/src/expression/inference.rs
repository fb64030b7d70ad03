//! The dimension of an expression.

use std::ops::Range;

use super::dimension::{Dimension, Inferred};
use super::fault::{ExpressionFault, ExpressionFaultKind};
use super::function::{Binary, Unary};
use super::names::Symbol;
use super::program::{Expression, Operation};
use super::table::Table;

/// Part of the expression, as far as it is known: its dimension, its value if it is constant, its place.
struct Part {
    inferred: Inferred,
    constant: Option<f64>,
    span: Range<usize>,
}

impl Part {
    /// Nothing about nothing: stands in for a value that a step would take from an empty stack.
    fn unknown() -> Self {
        Self { inferred: Inferred::Any, constant: None, span: 0..0 }
    }
}

impl Expression {
    /// Infers the dimension, as far as it is known, given what `of` knows of the dimension of each symbol.
    ///
    /// # Errors
    ///
    /// When the dimensions contradict each other, such as in the sum of a length and a mass.
    ///
    /// ```
    /// use slideway::expression::{Dimension, Inferred, Names, parse};
    ///
    /// let mut names = Names::new();
    /// names.parameter("l");
    /// let of = |_| Inferred::Known(Dimension::LENGTH);
    /// let force = parse("5 N/m*(l - 20 mm)", &names).unwrap();
    /// assert_eq!(force.dimension(&of), Ok(Inferred::Known(Dimension::FORCE)));
    /// let fault = parse("l + 3 kg", &names).unwrap().dimension(&of).unwrap_err();
    /// assert_eq!(fault.to_string(), "`+` cannot combine a length and a mass");
    /// ```
    pub fn dimension(&self, of: &dyn Fn(Symbol) -> Inferred) -> Result<Inferred, ExpressionFault> {
        let mut stack: Vec<Part> = Vec::with_capacity(self.greatest_height());
        for step in self.steps() {
            let span = step.span.clone();
            let part = match &step.operation {
                Operation::Number { value, inferred, .. } => {
                    Part { inferred: *inferred, constant: Some(*value), span }
                }
                Operation::Symbol(symbol) => Part { inferred: of(*symbol), constant: None, span },
                Operation::Unary(function) => {
                    let x = stack.pop().unwrap_or_else(Part::unknown);
                    unary(*function, &x, span)?
                }
                Operation::Binary(function) => {
                    let y = stack.pop().unwrap_or_else(Part::unknown);
                    let x = stack.pop().unwrap_or_else(Part::unknown);
                    binary(*function, &x, &y, span)?
                }
                Operation::Table(table) => {
                    let x = stack.pop().unwrap_or_else(Part::unknown);
                    looked_up(table, &x, span)?
                }
            };
            stack.push(part);
        }
        Ok(stack.pop().unwrap_or_else(Part::unknown).inferred)
    }
}

fn unary(function: Unary, x: &Part, span: Range<usize>) -> Result<Part, ExpressionFault> {
    let inferred = match function {
        Unary::Negate | Unary::Abs => x.inferred,
        Unary::Sign | Unary::Step => Inferred::Known(Dimension::NONE),
        Unary::Sqrt => match x.inferred {
            Inferred::Known(base) => Inferred::Known(base.root().ok_or_else(|| {
                ExpressionFault::new(
                    ExpressionFaultKind::FractionalPower { base, exponent: 0.5 },
                    span.clone(),
                )
            })?),
            free => free,
        },
        _ => match x.inferred {
            Inferred::Known(found) if found != Dimension::NONE => {
                let kind = ExpressionFaultKind::NotDimensionless { function: function.name(), found };
                return Err(ExpressionFault::new(kind, x.span.clone()));
            }
            // An angle is one; the others are plain numbers, so that `0.4*cos(30 deg)` may be a length in SI.
            _ if matches!(function, Unary::Asin | Unary::Acos | Unary::Atan) => {
                Inferred::Known(Dimension::NONE)
            }
            _ => Inferred::Number,
        },
    };
    Ok(Part { inferred, constant: x.constant.map(|value| function.value(value)), span })
}

fn binary(function: Binary, x: &Part, y: &Part, span: Range<usize>) -> Result<Part, ExpressionFault> {
    let inferred = match function {
        Binary::Add | Binary::Subtract | Binary::Hypot | Binary::Min | Binary::Max => common(function, x, y),
        Binary::Atan2 => common(function, x, y).map(|_| Inferred::Known(Dimension::NONE)),
        Binary::Multiply => product(x, y, Dimension::times),
        Binary::Divide => product(x, y, Dimension::per),
        Binary::Power => match y.inferred {
            Inferred::Known(found) if found != Dimension::NONE => {
                let kind = ExpressionFaultKind::ExponentDimension { found };
                return Err(ExpressionFault::new(kind, y.span.clone()));
            }
            _ => power(x, y),
        },
    };
    let inferred = inferred.map_err(|kind| ExpressionFault::new(kind, span.clone()))?;
    let constant = x.constant.zip(y.constant).map(|(x, y)| function.value(x, y));
    Ok(Part { inferred, constant, span })
}

/// The value of a table, whose argument must have the dimension of the table's.
fn looked_up(table: &Table, x: &Part, span: Range<usize>) -> Result<Part, ExpressionFault> {
    if let (Inferred::Known(wanted), Inferred::Known(found)) = (table.argument, x.inferred)
        && wanted != found
    {
        let kind = ExpressionFaultKind::TableArgument { table: table.name.to_string(), wanted, found };
        return Err(ExpressionFault::new(kind, x.span.clone()));
    }
    Ok(Part { inferred: table.value, constant: x.constant.map(|value| table.at(value)), span })
}

/// The dimension of arguments that must agree.
fn common(function: Binary, x: &Part, y: &Part) -> Result<Inferred, ExpressionFaultKind> {
    match (x.inferred, y.inferred) {
        (Inferred::Known(left), Inferred::Known(right)) if left != right => {
            Err(ExpressionFaultKind::DimensionMismatch { operation: function.name(), left, right })
        }
        (known @ Inferred::Known(_), _) | (_, known @ Inferred::Known(_)) => Ok(known),
        (Inferred::Number, Inferred::Number) => Ok(Inferred::Number),
        _ => Ok(Inferred::Any),
    }
}

fn product(
    x: &Part,
    y: &Part,
    combine: fn(Dimension, Dimension) -> Option<Dimension>,
) -> Result<Inferred, ExpressionFaultKind> {
    let known =
        |left, right| combine(left, right).map(Inferred::Known).ok_or(ExpressionFaultKind::DimensionTooLarge);
    match (x.inferred, y.inferred) {
        (Inferred::Any, _) | (_, Inferred::Any) => Ok(Inferred::Any),
        (Inferred::Number, Inferred::Number) => Ok(Inferred::Number),
        (Inferred::Number, Inferred::Known(right)) => known(Dimension::NONE, right),
        (Inferred::Known(left), Inferred::Number) => known(left, Dimension::NONE),
        (Inferred::Known(left), Inferred::Known(right)) => known(left, right),
    }
}

/// The dimension of a power whose exponent `y` is known to be a pure number.
fn power(x: &Part, y: &Part) -> Result<Inferred, ExpressionFaultKind> {
    match (x.inferred, y.constant) {
        (Inferred::Any, _) => Ok(Inferred::Any),
        (Inferred::Number, _) => Ok(y.inferred),
        (Inferred::Known(Dimension::NONE), _) => Ok(Inferred::Known(Dimension::NONE)),
        (Inferred::Known(base), None) => Err(ExpressionFaultKind::VariablePower { base }),
        (Inferred::Known(base), Some(exponent)) => constant_power(base, exponent).map(Inferred::Known),
    }
}

/// `base^exponent` for a whole exponent, or for half of a whole one if the result has whole exponents.
fn constant_power(base: Dimension, exponent: f64) -> Result<Dimension, ExpressionFaultKind> {
    let fractional = ExpressionFaultKind::FractionalPower { base, exponent };
    let doubled = 2.0 * exponent;
    if doubled.fract() != 0.0 || !doubled.is_finite() {
        return Err(fractional);
    }
    if exponent.fract() == 0.0 {
        let whole = whole_exponent(exponent).ok_or(ExpressionFaultKind::DimensionTooLarge)?;
        return base.power(whole).ok_or(ExpressionFaultKind::DimensionTooLarge);
    }
    let whole = whole_exponent(doubled).ok_or(ExpressionFaultKind::DimensionTooLarge)?;
    base.root().ok_or(fractional)?.power(whole).ok_or(ExpressionFaultKind::DimensionTooLarge)
}

/// A whole number as an exponent; `None` outside -127 to 127 and for numbers that are not whole.
pub(super) fn whole_exponent(value: f64) -> Option<i8> {
    (-127_i8..=127).find(|candidate| f64::from(*candidate) == value)
}
