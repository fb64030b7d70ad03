//! Reads a number and the unit that follows it.

use std::ops::Range;

use super::Names;
use super::dimension::{Dimension, Inferred};
use super::fault::{ExpressionFault, ExpressionFaultKind};
use super::inference::whole_exponent;
use super::lexer::{TokenKind, tokens};
use super::parser::{Parser, Read};
use super::unit::{self, Scale, UNITS, Unit, WrittenUnit};
use super::{names::is_reserved, nearest_names};
use crate::interval::Interval;

/// The units most like this name of those whose dimension will do.
pub(super) fn nearest_units(name: &str, will_do: impl Fn(Dimension) -> bool) -> Vec<&'static str> {
    let units = UNITS.iter().filter(|unit| will_do(unit.dimension));
    let mut nearest = nearest_names(name, units.map(|unit| unit.name));
    nearest.truncate(MAX_PROPOSALS);
    nearest
}

/// How a unit is joined to what stands before it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Joint {
    Blank,
    Times,
    Divide,
}

/// The most units proposed in place of an unknown one.
const MAX_PROPOSALS: usize = 3;

/// A unit that stands by itself, such as `mm` or `N/m`; nothing for a text that is none.
pub(crate) fn written_unit(text: &str) -> Option<WrittenUnit> {
    let tokens = tokens(text).ok()?;
    // Of what is no unit nobody asks which unit is meant.
    let is_strange =
        |kind: TokenKind<'_>| matches!(kind, TokenKind::Name(name) if unit::find(name).is_none());
    if tokens.iter().any(|token| is_strange(token.kind)) {
        return None;
    }
    let names = Names::new();
    let mut parser = Parser::new(text, tokens, &names);
    let unit = parser.unit(&mut (0..0)).ok()??;
    let is_unit = !unit.is_none() && parser.faults.is_empty() && parser.peek(0).is_none();
    is_unit.then_some(unit)
}

/// The units behind the numbers of an expression, in the order of the text; none of a text that cannot be
/// read.
pub(crate) fn written_units(text: &str, names: &Names) -> Vec<WrittenUnit> {
    let Ok(tokens) = tokens(text) else { return Vec::new() };
    let mut parser = Parser::new(text, tokens, names);
    let is_read = parser.whole().is_ok() && parser.faults.is_empty();
    if is_read { parser.units } else { Vec::new() }
}

impl<'t> Parser<'t> {
    /// A number and its unit, if one follows; returns the place of both.
    pub(super) fn literal(&mut self, number: f64, enclosure: Interval) -> Read {
        let mut span = self.advance();
        if !matches!(self.peek(0), Some(TokenKind::Name(_))) {
            self.number(number, enclosure, Inferred::Number, span.clone());
            return Ok(span);
        }
        if let Some(unit) = self.unit(&mut span)? {
            let enclosure = unit.scale.enclosed_in_si(enclosure);
            self.quantity(unit.scale.in_si(number), enclosure, unit.scale, span.clone());
            self.units.push(unit);
        }
        Ok(span)
    }

    /// The unit behind what was read, whose place grows by that of the unit; none if there is something wrong
    /// with it.
    fn unit(&mut self, span: &mut Range<usize>) -> Result<Option<WrittenUnit>, ExpressionFault> {
        let mut written = Some(WrittenUnit::NONE);
        while let Some((joint, name)) = self.joint() {
            let factor = self.factor(joint, name, span)?;
            span.end = self.previous_end();
            written = written.zip(factor).and_then(|(written, (unit, exponent))| {
                let longer = written.times(unit, exponent);
                longer.map_err(|kind| self.faults.push(ExpressionFault::new(kind, span.clone()))).ok()
            });
        }
        Ok(written)
    }

    fn quantity(&mut self, value: f64, enclosure: Interval, scale: Scale, span: Range<usize>) {
        if value.is_finite() {
            self.number(value, enclosure, Inferred::Known(scale.dimension()), span);
        } else {
            self.faults.push(ExpressionFault::new(ExpressionFaultKind::NumberTooLarge, span));
        }
    }

    /// The next unit and its joint, if the unit goes on: after a blank everything is taken for a unit, after
    /// `*` or `/` only what is one and is not called as a function (`min` is both).
    fn joint(&self) -> Option<(Joint, &'t str)> {
        let (joint, name) = match (self.peek(0)?, self.peek(1)) {
            (TokenKind::Name(name), _) => return Some((Joint::Blank, name)),
            (TokenKind::Times, Some(TokenKind::Name(name))) => (Joint::Times, name),
            (TokenKind::Divide, Some(TokenKind::Name(name))) => (Joint::Divide, name),
            _ => return None,
        };
        let is_unit = unit::find(name).is_some() && self.peek(2) != Some(TokenKind::Open);
        is_unit.then_some((joint, name))
    }

    /// Reads a unit and its exponent, negative after `/`; `None` for a unit that is not known.
    fn factor(
        &mut self,
        joint: Joint,
        name: &str,
        quantity: &Range<usize>,
    ) -> Result<Option<(&'static Unit, i8)>, ExpressionFault> {
        let before_joint = self.previous_end();
        if joint != Joint::Blank {
            self.advance();
        }
        let place = self.advance();
        let joined = &self.text[before_joint..place.start] == "/";
        let Some(unit) = unit::find(name) else {
            let fault = ExpressionFault::new(self.no_such_unit(name), place);
            if self.peek(0) == Some(TokenKind::Open) {
                return Err(fault);
            }
            self.faults.push(fault);
            self.unit_exponent()?;
            return Ok(None);
        };
        let written = self.unit_exponent()?;
        let exponent = if joint == Joint::Divide { -written } else { written };
        if joint != Joint::Blank && !joined && self.names.lookup(name).is_some() {
            let before = &self.text[quantity.clone()];
            let operator = if joint == Joint::Divide { '/' } else { '*' };
            let power = if exponent == 1 { String::new() } else { format!("^{exponent}") };
            let kind = ExpressionFaultKind::AmbiguousUnit {
                name: name.to_owned(),
                as_name: format!("({before}){operator}{name}"),
                as_unit: format!("{before} {name}{power}"),
            };
            self.faults.push(ExpressionFault::new(kind, place));
        }
        Ok(Some((unit, exponent)))
    }

    fn no_such_unit(&self, name: &str) -> ExpressionFaultKind {
        let nearest = nearest_units(name, |_| true);
        let is_name = is_reserved(name) || self.names.lookup(name).is_some();
        ExpressionFaultKind::UnknownUnit { unit: name.to_owned(), nearest, is_name }
    }

    /// `²`, `^2`, `^-2` or nothing, which is 1.
    fn unit_exponent(&mut self) -> Result<i8, ExpressionFault> {
        let start = self.span().start;
        let exponent = match self.peek(0) {
            Some(TokenKind::Superscript(exponent)) => Some(exponent),
            Some(TokenKind::Power) => {
                self.advance();
                let negative = self.peek(0) == Some(TokenKind::Minus);
                if negative {
                    self.advance();
                }
                match self.peek(0) {
                    Some(TokenKind::Number(value, _)) => {
                        whole_exponent(if negative { -value } else { value })
                    }
                    _ => None,
                }
            }
            _ => return Ok(1),
        };
        let span = start..self.advance().end;
        let goes_on = matches!(self.peek(0), Some(TokenKind::Power | TokenKind::Superscript(_)));
        exponent
            .filter(|_| !goes_on)
            .ok_or_else(|| ExpressionFault::new(ExpressionFaultKind::UnitExponent, span))
    }
}
