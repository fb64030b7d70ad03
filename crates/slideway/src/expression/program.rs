//! A parsed expression as a list of steps for a stack machine.

use std::ops::Range;
use std::sync::Arc;

use super::decimal;
use super::dimension::{Dimension, Inferred};
use super::function::{Binary, Unary};
use super::names::Symbol;
use super::table::Table;
use crate::interval::Interval;

#[derive(Clone, Debug, PartialEq)]
pub(super) enum Operation {
    /// A number that was written: the nearest to it, and where it lies.
    Number {
        value: f64,
        enclosure: Interval,
        inferred: Inferred,
    },
    Symbol(Symbol),
    Unary(Unary),
    Binary(Binary),
    Table(Arc<Table>),
}

impl Operation {
    /// How many values it takes from the stack.
    pub(super) fn arguments(&self) -> usize {
        match self {
            Self::Number { .. } | Self::Symbol(_) => 0,
            Self::Unary(_) | Self::Table(_) => 1,
            Self::Binary(_) => 2,
        }
    }
}

/// One operation; the span is that of the whole part of the text whose value it leaves on the stack.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    pub(super) operation: Operation,
    pub(super) span: Range<usize>,
}

/// A parsed expression.
///
/// Its operations are kept in the order of execution (postfix), so that evaluation neither allocates nor
/// recurses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expression {
    steps: Vec<Step>,
    height: usize,
    greatest_height: usize,
}

impl Expression {
    /// A plain number without a unit.
    ///
    /// Evaluation reports a `value` that is not finite.
    ///
    /// ```
    /// use slideway::expression::{Expression, Values};
    ///
    /// let values = Values::of_parameters(&[]);
    /// assert_eq!(Expression::constant(2.5).evaluate(&values), Ok(2.5));
    /// ```
    pub fn constant(value: f64) -> Self {
        Self::number(value, Interval::point(value))
    }

    /// A plain number that was written as a decimal, of which `value` is the nearest.
    pub(crate) fn decimal(value: f64, written: &str) -> Self {
        Self::number(value, decimal::enclosure(value, written))
    }

    fn number(value: f64, enclosure: Interval) -> Self {
        let mut expression = Self::default();
        expression.push(Operation::Number { value, enclosure, inferred: Inferred::Number }, 0..0);
        expression
    }

    /// Whether it contains no symbol at all, not even time.
    pub fn is_constant(&self) -> bool {
        self.symbols().next().is_none()
    }

    /// Every use of a symbol with its place in the text (byte offsets), from left to right.
    ///
    /// ```
    /// use slideway::expression::{Names, Symbol, parse};
    ///
    /// let mut names = Names::new();
    /// names.parameter("a");
    /// let expression = parse("2*a + t", &names).unwrap();
    /// let symbols: Vec<_> = expression.symbols().collect();
    /// assert_eq!(symbols, [(Symbol::Parameter(0), 2..3), (Symbol::Time, 6..7)]);
    /// ```
    pub fn symbols(&self) -> impl Iterator<Item = (Symbol, Range<usize>)> + '_ {
        self.steps.iter().filter_map(|step| match step.operation {
            Operation::Symbol(symbol) => Some((symbol, step.span.clone())),
            _ => None,
        })
    }

    /// The expression with the opposite sign.
    ///
    /// ```
    /// use slideway::expression::{Names, Values, parse};
    ///
    /// let values = Values::of_parameters(&[]);
    /// assert_eq!(parse("2 - 5", &Names::new()).unwrap().negated().evaluate(&values), Ok(3.0));
    /// ```
    #[must_use]
    pub fn negated(mut self) -> Self {
        let span = self.steps.last().map_or(0..0, |step| step.span.clone());
        self.push(Operation::Unary(Unary::Negate), span);
        self
    }

    /// The symbol, if it is nothing else.
    pub(crate) fn only_symbol(&self) -> Option<Symbol> {
        match self.steps() {
            [Step { operation: Operation::Symbol(symbol), .. }] => Some(*symbol),
            _ => None,
        }
    }

    /// The symbols of which it takes the sine, cosine or tangent.
    pub(crate) fn angles(&self) -> impl Iterator<Item = Symbol> {
        let is_of_angle = |unary: &Unary| matches!(unary, Unary::Sin | Unary::Cos | Unary::Tan);
        self.steps.windows(2).filter_map(move |pair| match (&pair[0].operation, &pair[1].operation) {
            (Operation::Symbol(symbol), Operation::Unary(unary)) if is_of_angle(unary) => Some(*symbol),
            _ => None,
        })
    }

    /// The number, if it is nothing else, or its opposite, and has no unit.
    pub(crate) fn bare_number(&self) -> Option<f64> {
        self.typed_number().filter(|(_, inferred)| *inferred == Inferred::Number).map(|(value, _)| value)
    }

    /// Its numbers without a unit: the step at which each stands, its value, and its place in the text.
    pub(crate) fn bare_numbers(&self) -> impl Iterator<Item = (usize, f64, Range<usize>)> + '_ {
        self.steps.iter().enumerate().filter_map(|(index, step)| match step.operation {
            Operation::Number { value, inferred: Inferred::Number, .. } => {
                Some((index, value, step.span.clone()))
            }
            _ => None,
        })
    }

    /// Returns the expression as it would be if the number at a step had a unit of this dimension.
    pub(crate) fn assuming(&self, step: usize, dimension: Inferred) -> Self {
        let mut assumed = self.clone();
        if let Some(Step { operation: Operation::Number { inferred, .. }, .. }) = assumed.steps.get_mut(step)
        {
            *inferred = dimension;
        }
        assumed
    }

    /// The number, if it is nothing else, or its opposite, and has this dimension: by its unit, or as a bare
    /// number where that is wanted.
    pub(crate) fn only_number(&self, dimension: Dimension, wanted: Option<Dimension>) -> Option<f64> {
        let (value, inferred) = self.typed_number()?;
        let is_one = match inferred {
            Inferred::Known(known) => known == dimension,
            _ => wanted == Some(dimension),
        };
        is_one.then_some(value)
    }

    fn typed_number(&self) -> Option<(f64, Inferred)> {
        match self.steps() {
            [Step { operation: Operation::Number { value, inferred, .. }, .. }] => Some((*value, *inferred)),
            [
                Step { operation: Operation::Number { value, inferred, .. }, .. },
                Step { operation: Operation::Unary(Unary::Negate), .. },
            ] => Some((-value, *inferred)),
            _ => None,
        }
    }

    pub(super) fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// The greatest number of values on the stack during evaluation.
    pub(super) fn greatest_height(&self) -> usize {
        self.greatest_height
    }

    pub(super) fn push(&mut self, operation: Operation, span: Range<usize>) {
        self.height = (self.height + 1).saturating_sub(operation.arguments());
        self.greatest_height = self.greatest_height.max(self.height);
        self.steps.push(Step { operation, span });
    }
}
