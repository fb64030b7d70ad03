//! Reads an expression: operator precedence by binding powers (Pratt), straight into the order of execution.

use std::f64::consts;
use std::ops::Range;
use std::sync::Arc;

use super::dimension::Inferred;
use super::fault::{ExpressionFault, ExpressionFaultKind};
use super::function::{self, Binary, Function, Unary};
use super::lexer::{Token, TokenKind, tokens};
use super::names::{Names, PI, RATE, Symbol};
use super::program::{Expression, Operation};
use super::table::Table;
use super::unit;
use crate::interval::Interval;

/// The longest text of an expression, in bytes.
pub const MAX_LENGTH: usize = 10_000;

/// The greatest nesting depth: parentheses, signs, and right-hand sides of operators each count one level.
pub const MAX_DEPTH: usize = 200;

/// Reads `text`, in which the names in `names` and the reserved ones may occur.
///
/// # Errors
///
/// Every fault that can be found, in the order of the text: all spelling faults if there are any; otherwise
/// all unknown names, units and functions up to the first place where the structure is broken. The list is
/// never empty.
///
/// ```
/// use slideway::expression::{Names, parse};
///
/// let faults = parse("2 furlong + breadth", &Names::new()).unwrap_err();
/// let texts: Vec<String> = faults.iter().map(ToString::to_string).collect();
/// assert_eq!(texts, ["unknown unit `furlong`", "unknown name `breadth`"]);
/// ```
pub fn parse(text: &str, names: &Names) -> Result<Expression, Vec<ExpressionFault>> {
    let whole = 0..text.len();
    if text.len() > MAX_LENGTH {
        let kind = ExpressionFaultKind::TooLong { length: text.len(), limit: MAX_LENGTH };
        return Err(vec![ExpressionFault::new(kind, whole)]);
    }
    let tokens = tokens(text)?;
    if tokens.is_empty() {
        return Err(vec![ExpressionFault::new(ExpressionFaultKind::Empty, whole)]);
    }
    let mut parser = Parser::new(text, tokens, names);
    if let Err(fault) = parser.whole() {
        parser.faults.push(fault);
    }
    if parser.faults.is_empty() {
        return Ok(parser.program);
    }
    parser.faults.sort_by_key(|fault| fault.span.start);
    Err(parser.faults)
}

/// The place of the part just read, or the fault beyond which reading makes no sense.
pub(super) type Read = Result<Range<usize>, ExpressionFault>;

pub(super) struct Parser<'t> {
    pub(super) text: &'t str,
    tokens: Vec<Token<'t>>,
    next: usize,
    pub(super) names: &'t Names,
    pub(super) program: Expression,
    /// Faults that reading goes on after.
    pub(super) faults: Vec<ExpressionFault>,
    /// The units behind numbers so far.
    pub(super) units: Vec<unit::WrittenUnit>,
    depth: usize,
}

const SUM: u8 = 1;
const PRODUCT: u8 = 2;
const SIGN: u8 = 3;
const POWER: u8 = 4;

/// An operator between operands, its binding power and the least one its right-hand side may contain.
fn infix(kind: TokenKind<'_>) -> Option<(Binary, u8, u8)> {
    Some(match kind {
        TokenKind::Plus => (Binary::Add, SUM, PRODUCT),
        TokenKind::Minus => (Binary::Subtract, SUM, PRODUCT),
        TokenKind::Times => (Binary::Multiply, PRODUCT, SIGN),
        TokenKind::Divide => (Binary::Divide, PRODUCT, SIGN),
        TokenKind::Power => (Binary::Power, POWER, POWER),
        _ => return None,
    })
}

impl<'t> Parser<'t> {
    pub(super) fn new(text: &'t str, tokens: Vec<Token<'t>>, names: &'t Names) -> Self {
        let program = Expression::default();
        Self { text, tokens, next: 0, names, program, faults: Vec::new(), units: Vec::new(), depth: 0 }
    }

    pub(super) fn peek(&self, ahead: usize) -> Option<TokenKind<'t>> {
        self.tokens.get(self.next + ahead).map(|token| token.kind)
    }

    /// The place of the next token, or the end of the text.
    pub(super) fn span(&self) -> Range<usize> {
        self.tokens.get(self.next).map_or(self.text.len()..self.text.len(), |token| token.span.clone())
    }

    /// Steps over the next token and returns its place.
    pub(super) fn advance(&mut self) -> Range<usize> {
        let span = self.span();
        self.next += 1;
        span
    }

    pub(super) fn previous_end(&self) -> usize {
        self.next.checked_sub(1).and_then(|last| self.tokens.get(last)).map_or(0, |token| token.span.end)
    }

    fn found(&self) -> String {
        self.text[self.span()].to_owned()
    }

    fn here(&self, kind: ExpressionFaultKind) -> ExpressionFault {
        ExpressionFault::new(kind, self.span())
    }

    pub(super) fn whole(&mut self) -> Read {
        let span = self.expression(SUM)?;
        match self.peek(0) {
            None => Ok(span),
            Some(TokenKind::Close) => Err(self.here(ExpressionFaultKind::UnmatchedParenthesis)),
            Some(_) => Err(self.here(ExpressionFaultKind::ExpectedOperator { found: self.found() })),
        }
    }

    /// An expression whose operators outside parentheses bind at least as tightly as `least`.
    fn expression(&mut self, least: u8) -> Read {
        if self.depth == MAX_DEPTH {
            return Err(self.here(ExpressionFaultKind::TooDeep { limit: MAX_DEPTH }));
        }
        self.depth += 1;
        let mut left = self.operand()?;
        while let Some(kind) = self.peek(0) {
            if let TokenKind::Superscript(exponent) = kind {
                left = self.superscript(&left, exponent);
                continue;
            }
            let Some((function, binding, least_right)) = infix(kind) else { break };
            if binding < least {
                break;
            }
            self.advance();
            let right = self.expression(least_right)?;
            left = left.start..right.end;
            self.program.push(Operation::Binary(function), left.clone());
        }
        self.depth -= 1;
        Ok(left)
    }

    fn superscript(&mut self, base: &Range<usize>, exponent: i8) -> Range<usize> {
        let span = self.advance();
        let whole = base.start..span.end;
        let exponent = f64::from(exponent);
        self.number(exponent, Interval::point(exponent), Inferred::Number, span);
        self.program.push(Operation::Binary(Binary::Power), whole.clone());
        whole
    }

    pub(super) fn number(&mut self, value: f64, enclosure: Interval, inferred: Inferred, span: Range<usize>) {
        self.program.push(Operation::Number { value, enclosure, inferred }, span);
    }

    /// A number, name, call or parenthesis, with signs before it.
    fn operand(&mut self) -> Read {
        let Some(kind) = self.peek(0) else {
            return Err(self.here(ExpressionFaultKind::UnexpectedEnd));
        };
        match kind {
            TokenKind::Number(value, enclosure) => self.literal(value, enclosure),
            TokenKind::Name(name) if self.peek(1) == Some(TokenKind::Open) => self.call(name),
            TokenKind::Name(name) => Ok(self.name(name)),
            TokenKind::Open => {
                let start = self.span().start;
                self.parenthesis(|parser| parser.expression(SUM).map(|_| ())).map(|end| start..end)
            }
            TokenKind::Minus | TokenKind::Plus => {
                let start = self.advance().start;
                let span = start..self.expression(SIGN)?.end;
                if kind == TokenKind::Minus {
                    self.program.push(Operation::Unary(Unary::Negate), span.clone());
                }
                Ok(span)
            }
            _ => Err(self.here(ExpressionFaultKind::ExpectedOperand { found: self.found() })),
        }
    }

    /// Reads `(`, the inside, and `)`; returns where the `)` ends.
    fn parenthesis(
        &mut self,
        inside: impl FnOnce(&mut Self) -> Result<(), ExpressionFault>,
    ) -> Result<usize, ExpressionFault> {
        let open = self.advance();
        inside(self)?;
        match self.peek(0) {
            Some(TokenKind::Close) => Ok(self.advance().end),
            None => Err(ExpressionFault::new(ExpressionFaultKind::UnclosedParenthesis, open)),
            Some(_) => Err(self.here(ExpressionFaultKind::ExpectedOperator { found: self.found() })),
        }
    }

    fn name(&mut self, name: &str) -> Range<usize> {
        let span = self.advance();
        if name == PI {
            self.number(consts::PI, Interval::PI, Inferred::Number, span.clone());
        } else if let Some(symbol) = self.names.lookup(name) {
            self.program.push(Operation::Symbol(symbol), span.clone());
        } else {
            self.faults.push(ExpressionFault::new(self.no_such_name(name), span.clone()));
        }
        span
    }

    fn no_such_name(&self, name: &str) -> ExpressionFaultKind {
        let name = name.to_owned();
        if name == RATE || function::find(&name).is_some() || self.names.table_named(&name).is_some() {
            return ExpressionFaultKind::FunctionWithoutArguments { name };
        }
        let nearest = self.names.nearest(&name).map(str::to_owned);
        let is_unit = unit::find(&name).is_some();
        ExpressionFaultKind::UnknownName { name, nearest, is_unit }
    }

    fn call(&mut self, name: &str) -> Read {
        let called = self.advance();
        if name == RATE {
            return self.rate(called.start);
        }
        let start = called.start;
        if let Some(table) = self.names.table_named(name).cloned() {
            return self.look_up(table, start);
        }
        let known = function::find(name);
        if known.is_none() {
            let kind = ExpressionFaultKind::UnknownFunction {
                name: name.to_owned(),
                nearest: self.names.nearest_function(name).map(str::to_owned),
                is_name: name == PI || self.names.lookup(name).is_some(),
            };
            self.faults.push(ExpressionFault::new(kind, called));
        }
        let mut count = 0;
        let end = self.parenthesis(|parser| parser.arguments(known, start, &mut count))?;
        if let Some(function) = known.filter(|function| !function.takes(count)) {
            let kind = ExpressionFaultKind::WrongArgumentCount {
                function: name.to_owned(),
                expected: function.expected_count(),
                found: count,
            };
            self.faults.push(ExpressionFault::new(kind, start..end));
        } else if let Some(function @ Function::Unary(_)) = known {
            self.apply(function, start..end);
        }
        Ok(start..end)
    }

    /// The argument of a table, whose name begins at `start`.
    fn look_up(&mut self, table: Arc<Table>, start: usize) -> Read {
        let mut count = 0;
        let end = self.parenthesis(|parser| parser.arguments(None, start, &mut count))?;
        if count == 1 {
            self.program.push(Operation::Table(table), start..end);
        } else {
            let function = table.name.to_string();
            let kind =
                ExpressionFaultKind::WrongArgumentCount { function, expected: "one argument", found: count };
            self.faults.push(ExpressionFault::new(kind, start..end));
        }
        Ok(start..end)
    }

    /// Reads arguments and counts them; applies a function of two after its second and every further one.
    fn arguments(
        &mut self,
        function: Option<Function>,
        start: usize,
        count: &mut usize,
    ) -> Result<(), ExpressionFault> {
        if self.peek(0) == Some(TokenKind::Close) {
            return Ok(());
        }
        loop {
            self.expression(SUM)?;
            *count += 1;
            if let Some(function @ Function::Binary(_)) = function
                && *count > 1
            {
                let end = self.span().end;
                self.apply(function, start..end);
            }
            if self.peek(0) != Some(TokenKind::Comma) {
                return Ok(());
            }
            self.advance();
        }
    }

    fn apply(&mut self, function: Function, span: Range<usize>) {
        let operation = match function {
            Function::Unary(function) => Operation::Unary(function),
            Function::Binary(function) => Operation::Binary(function),
        };
        self.program.push(operation, span);
    }

    /// The rest of `rate(coordinate)`, whose name begins at `start`.
    fn rate(&mut self, start: usize) -> Read {
        let (Some(TokenKind::Name(name)), Some(TokenKind::Close)) = (self.peek(1), self.peek(2)) else {
            let kind = ExpressionFaultKind::RateArgument;
            return Err(ExpressionFault::new(kind, start..self.span().end));
        };
        self.advance();
        let place = self.advance();
        let span = start..self.advance().end;
        let nearest = || self.names.nearest_coordinate(name).map(str::to_owned);
        match self.names.lookup(name) {
            Some(Symbol::Coordinate(index)) => {
                self.program.push(Operation::Symbol(Symbol::Rate(index)), span.clone());
            }
            None if !super::is_reserved(name) => {
                let kind = ExpressionFaultKind::UnknownName {
                    name: name.to_owned(),
                    nearest: nearest(),
                    is_unit: false,
                };
                self.faults.push(ExpressionFault::new(kind, place));
            }
            _ => {
                let kind = ExpressionFaultKind::NotACoordinate { name: name.to_owned(), nearest: nearest() };
                self.faults.push(ExpressionFault::new(kind, place));
            }
        }
        Ok(span)
    }
}
