//! A number of the model that may be an expression, with the dimension it must have and its place.

use super::Value;
use super::quantity::{Quantity, Span};
use crate::expression::{Dimension, Expression, ExpressionFault, Inferred, Piece, Symbol, Values};
use crate::fault::{Fault, FaultKind, Place, Source};
use crate::interval::Real;
use crate::units::Unit;

/// Where a formula stands.
#[derive(Debug, Clone)]
pub struct Origin {
    /// The text it stands in.
    pub source: Source,
    /// Its bytes in that text, quotation marks included.
    pub span: Span,
    /// First byte of the expression itself, if its bytes correspond to those of the source.
    pub expression_start: Option<usize>,
}

impl Origin {
    /// Place of the whole formula.
    pub fn place(&self) -> Place {
        Place { source: self.source.clone(), span: self.span.clone() }
    }

    /// Place of a part of the expression.
    pub(super) fn part(&self, span: &Span) -> Place {
        match self.expression_start {
            Some(start) => Place { source: self.source.clone(), span: start + span.start..start + span.end },
            None => self.place(),
        }
    }

    /// The fault of an expression as a fault of the input.
    pub(super) fn fault(&self, fault: ExpressionFault) -> Fault {
        Fault::new(FaultKind::Expression(fault.kind), self.part(&fault.span))
    }
}

/// Condition of a quantity that is [`Allowed::Positive`], in words.
pub(crate) const POSITIVE: &str = "greater than zero";

/// Which values a quantity may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Allowed {
    /// Any finite number.
    Any,
    /// Numbers greater than zero.
    Positive,
    /// Numbers not below zero.
    NotNegative,
}

/// With what a quantity may vary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Varies {
    /// It stays as it is during the motion.
    Never,
    /// With coordinates, rates and time.
    WithMotion,
    /// With the sliding speed of its joint.
    WithSpeed,
}

/// A number or an expression of the model.
#[derive(Debug, Clone)]
pub struct Formula {
    /// Expression that gives its value.
    pub expression: Expression,
    /// The ends of the range of which the expression is the middle; only parameters have one.
    pub range: Option<Box<[Expression; 2]>>,
    /// The dimension its value must have; nothing for parameters, which may have any.
    pub wanted: Option<Dimension>,
    /// With what it may vary.
    pub varies: Varies,
    /// Which values it may have.
    pub allowed: Allowed,
    /// Whether it could not be read, or uses a parameter that could not; only while a model is read.
    pub(super) broken: bool,
    /// Name of the quantity in messages: "the mass of bar".
    pub what: std::sync::Arc<str>,
    /// Where it stands.
    pub origin: Origin,
}

impl Formula {
    /// Its value from the parameters alone; that of a coefficient of friction at the sliding speed zero.
    ///
    /// # Errors
    /// A fault if the value is not finite or not allowed.
    pub fn constant<T: Real>(&self, parameters: &[T]) -> Result<T, Fault> {
        if self.depends_on_speed() {
            return self.at_speed(parameters, T::zero(), &[]);
        }
        self.value(&Values::of_parameters(parameters))
    }

    /// Its value in a state.
    ///
    /// # Errors
    /// A fault if the value is not finite or not allowed.
    pub fn value<T: Real>(&self, values: &Values<'_, T>) -> Result<T, Fault> {
        self.value_on(values, &[])
    }

    /// Its value in a state with every relation on its piece; relations without a piece follow their
    /// arguments.
    ///
    /// # Errors
    /// As [`Self::value`].
    pub(crate) fn value_on<T: Real>(&self, values: &Values<'_, T>, pieces: &[Piece]) -> Result<T, Fault> {
        let value = if pieces.is_empty() {
            self.expression.evaluate(values)
        } else {
            self.expression.evaluate_on(values, pieces)
        };
        let value = value.map_err(|fault| self.origin.fault(fault).in_formula(&self.what))?;
        let (allowed, wanted) = match self.allowed {
            Allowed::Any => (true, ""),
            Allowed::Positive => (value.lower() > 0.0, POSITIVE),
            Allowed::NotNegative => (value.lower() >= 0.0, "at least zero"),
        };
        if allowed {
            return Ok(value);
        }
        let unit = Unit::si_unit(&self.wanted.map_or_else(String::new, Dimension::unit));
        let kind =
            FaultKind::OutOfRange { what: self.what.to_string(), wanted, value: unit.precise(value.lower()) };
        Err(Fault::new(kind, self.origin.place()))
    }

    /// Whether its value depends on coordinates, rates or time.
    pub fn moves(&self) -> bool {
        self.expression
            .symbols()
            .any(|(symbol, _)| !matches!(symbol, Symbol::Parameter(_) | Symbol::SlidingSpeed))
    }

    /// Whether its value depends on the sliding speed of its joint.
    pub fn depends_on_speed(&self) -> bool {
        self.expression.symbols().any(|(symbol, _)| symbol == Symbol::SlidingSpeed)
    }

    /// Its value at a sliding speed (m/s), with every relation on its piece; relations without a piece follow
    /// their arguments.
    ///
    /// # Errors
    /// A fault that names the speed if the value is not finite or not allowed.
    pub(crate) fn at_speed<T: Real>(&self, parameters: &[T], speed: T, pieces: &[Piece]) -> Result<T, Fault> {
        let values = Values { sliding_speed: speed, ..Values::of_parameters(parameters) };
        let found = self.value_on(&values, pieces);
        found.map_err(|fault| {
            let kind = FaultKind::AtSlidingSpeed { speed: speed.lower(), fault: Box::new(fault.kind) };
            Fault::new(kind, fault.place.unwrap_or_else(|| self.origin.place()))
        })
    }

    /// Every way in which it is not what is wanted: its dimension, and a dependence on the motion.
    pub(super) fn check(
        &self,
        of: &dyn Fn(Symbol) -> Inferred,
        names: &dyn Fn(Symbol) -> String,
    ) -> Vec<Fault> {
        let mut faults = Vec::new();
        let permitted = |symbol: Symbol| match symbol {
            Symbol::Parameter(_) => true,
            Symbol::SlidingSpeed => self.varies == Varies::WithSpeed,
            Symbol::Coordinate(_) | Symbol::Rate(_) | Symbol::Time => self.varies == Varies::WithMotion,
        };
        if let Some((symbol, span)) = self.expression.symbols().find(|(symbol, _)| !permitted(*symbol)) {
            let (what, name) = (self.what.to_string(), names(symbol));
            let kind = if symbol == Symbol::SlidingSpeed {
                FaultKind::DependsOnSlidingSpeed { what }
            } else {
                FaultKind::DependsOnMotion { what, symbol: name }
            };
            faults.push(Fault::new(kind, self.origin.part(&span)));
        }
        match (self.expression.dimension(of), self.wanted) {
            (Err(fault), _) => faults.push(self.origin.fault(fault)),
            (Ok(Inferred::Known(found)), Some(wanted)) if found != wanted => {
                faults.push(Fault::new(FaultKind::WrongDimension { wanted, found }, self.origin.place()));
            }
            _ => {}
        }
        faults
    }
}

/// Returns where the text of a quantity begins in the file: behind one quotation mark. Returns `None` if it
/// is no text, or an escape sequence or line end shifts it.
pub(super) fn expression_start(quantity: &Quantity, source: &str) -> Option<usize> {
    let Value::Text(text) = &quantity.written else { return None };
    let start = quantity.span.start + 1;
    (source.get(start..start + text.len()) == Some(text.as_str())).then_some(start)
}
