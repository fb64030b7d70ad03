//! Splits the text of an expression into tokens.

use std::iter::Peekable;
use std::ops::Range;
use std::str::CharIndices;

use super::decimal;
use super::fault::{ExpressionFault, ExpressionFaultKind};
use super::names::{continues_name, starts_name};
use crate::interval::Interval;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TokenKind<'t> {
    /// The number nearest to the one that is written, and where that lies.
    Number(f64, Interval),
    /// A name, a unit, or one of the unit signs `°` and `%`.
    Name(&'t str),
    /// An exponent such as `²`.
    Superscript(i8),
    Plus,
    Minus,
    Times,
    Divide,
    Power,
    Open,
    Close,
    Comma,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token<'t> {
    pub(super) kind: TokenKind<'t>,
    pub(super) span: Range<usize>,
}

/// The tokens of `text`, or every fault of spelling in it.
pub(super) fn tokens(text: &str) -> Result<Vec<Token<'_>>, Vec<ExpressionFault>> {
    let mut lexer = Lexer { text, rest: text.char_indices().peekable() };
    let mut tokens = Vec::new();
    let mut faults = Vec::new();
    while let Some(token) = lexer.token() {
        match token {
            Ok(token) => tokens.push(token),
            Err(fault) => faults.push(fault),
        }
    }
    if faults.is_empty() { Ok(tokens) } else { Err(faults) }
}

struct Lexer<'t> {
    text: &'t str,
    rest: Peekable<CharIndices<'t>>,
}

impl<'t> Lexer<'t> {
    fn token(&mut self) -> Option<Result<Token<'t>, ExpressionFault>> {
        while self.rest.next_if(|(_, character)| character.is_whitespace()).is_some() {}
        let start = self.position();
        let first = self.text[start..].chars().next()?;
        let kind = self.kind(start, first);
        let span = start..self.position();
        Some(match kind {
            Ok(kind) => Ok(Token { kind, span }),
            Err(kind) => Err(ExpressionFault { kind, span }),
        })
    }

    fn kind(&mut self, start: usize, first: char) -> Result<TokenKind<'t>, ExpressionFaultKind> {
        if self.at_number(start) {
            return self.number(start);
        }
        self.rest.next();
        Ok(match first {
            '+' => TokenKind::Plus,
            '-' | '\u{2212}' => TokenKind::Minus,
            '*' | '\u{b7}' | '\u{22c5}' | '\u{d7}' => TokenKind::Times,
            '/' => TokenKind::Divide,
            '^' => TokenKind::Power,
            '(' => TokenKind::Open,
            ')' => TokenKind::Close,
            ',' => TokenKind::Comma,
            '%' | '\u{b0}' => TokenKind::Name(&self.text[start..self.position()]),
            letter if starts_name(letter) => {
                self.skip_while(continues_name);
                TokenKind::Name(&self.text[start..self.position()])
            }
            SUPERSCRIPT_MINUS if self.superscript_digit().is_some() => {
                TokenKind::Superscript(-self.superscript(0)?)
            }
            sign => match superscript_digit(sign) {
                Some(digit) => TokenKind::Superscript(self.superscript(digit)?),
                None => return Err(ExpressionFaultKind::UnexpectedCharacter { character: sign }),
            },
        })
    }

    fn position(&mut self) -> usize {
        self.rest.peek().map_or(self.text.len(), |(position, _)| *position)
    }

    fn skip_while(&mut self, accepted: impl Fn(char) -> bool) {
        while self.rest.next_if(|(_, character)| accepted(*character)).is_some() {}
    }

    fn at_number(&self, start: usize) -> bool {
        let rest = &self.text[start..];
        rest.strip_prefix('.').unwrap_or(rest).starts_with(|first: char| first.is_ascii_digit())
    }

    /// Digits, a point, digits, and an exponent if digits follow its `e`; single `_` between digits.
    fn number(&mut self, start: usize) -> Result<TokenKind<'t>, ExpressionFaultKind> {
        self.digits();
        if self.rest.next_if(|(_, character)| *character == '.').is_some() {
            self.digits();
        }
        if self.at_exponent() {
            self.rest.next();
            self.rest.next_if(|(_, character)| is_sign(*character));
            self.digits();
        }
        let written = &self.text[start..self.position()];
        let plain: String = written.replace('_', "").replace('\u{2212}', "-");
        match plain.parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(TokenKind::Number(value, decimal::enclosure(value, &plain))),
            _ => Err(ExpressionFaultKind::NumberTooLarge),
        }
    }

    fn digits(&mut self) {
        loop {
            self.skip_while(|character| character.is_ascii_digit());
            let end = self.position();
            let mut ahead = self.text[end..].chars();
            let after_digit = self.text[..end].ends_with(|last: char| last.is_ascii_digit());
            let joins = ahead.next() == Some('_') && ahead.next().is_some_and(|next| next.is_ascii_digit());
            if !(after_digit && joins) {
                return;
            }
            self.rest.next();
        }
    }

    fn at_exponent(&mut self) -> bool {
        let rest = &self.text[self.position()..];
        rest.strip_prefix(['e', 'E']).is_some_and(|power| {
            power.strip_prefix(is_sign).unwrap_or(power).starts_with(|digit: char| digit.is_ascii_digit())
        })
    }

    /// The value of a superscript that begins with the digit `first`.
    fn superscript(&mut self, first: i8) -> Result<i8, ExpressionFaultKind> {
        let mut value = Some(first);
        while let Some(digit) = self.superscript_digit() {
            self.rest.next();
            value = value.and_then(|value| value.checked_mul(10)?.checked_add(digit));
        }
        value.ok_or(ExpressionFaultKind::NumberTooLarge)
    }

    fn superscript_digit(&mut self) -> Option<i8> {
        self.rest.peek().and_then(|(_, character)| superscript_digit(*character))
    }
}

const SUPERSCRIPT_MINUS: char = '\u{207b}';

fn is_sign(character: char) -> bool {
    matches!(character, '+' | '-' | '\u{2212}')
}

fn superscript_digit(character: char) -> Option<i8> {
    Some(match character {
        '\u{2070}' => 0,
        '\u{b9}' => 1,
        '\u{b2}' => 2,
        '\u{b3}' => 3,
        '\u{2074}' => 4,
        '\u{2075}' => 5,
        '\u{2076}' => 6,
        '\u{2077}' => 7,
        '\u{2078}' => 8,
        '\u{2079}' => 9,
        _ => return None,
    })
}
