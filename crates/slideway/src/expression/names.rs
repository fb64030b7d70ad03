//! The names an expression may use.

use crate::printable::is_hidden;
use slideway_modes::names::all_nearest;
use std::collections::HashMap;

use super::function;
use super::table::Table;
use std::sync::Arc;

/// Meaning of a name in an expression; an index is the position in the model's list of that kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Symbol {
    /// A parameter of the model.
    Parameter(usize),
    /// A coordinate.
    Coordinate(usize),
    /// The rate of change of a coordinate, written `rate(name)`.
    Rate(usize),
    /// Time, written `t`.
    Time,
    /// The absolute sliding velocity of a joint, written `sliding_speed`.
    SlidingSpeed,
}

/// The names visible in an expression, beside the reserved ones.
///
/// ```
/// use slideway::expression::{Names, Symbol};
///
/// let mut names = Names::new();
/// names.parameter("length");
/// names.coordinate("phi");
/// assert_eq!(names.lookup("phi"), Some(Symbol::Coordinate(0)));
/// assert_eq!(names.nearest("lenght"), Some("length"));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Names {
    symbols: HashMap<String, Symbol>,
    in_order: Vec<String>,
    parameters: usize,
    coordinates: usize,
    tables: Vec<Arc<Table>>,
}

impl Names {
    /// No names but the reserved ones.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds the next parameter and returns its symbol: 0, 1, 2, ... in the order of the calls.
    ///
    /// A name already present keeps its first meaning; the caller reports the duplicate (see
    /// [`Names::lookup`]).
    pub fn parameter(&mut self, name: &str) -> Symbol {
        let symbol = Symbol::Parameter(self.parameters);
        self.parameters += 1;
        self.add(name, symbol)
    }

    /// Adds the next coordinate and returns its symbol, with the same rules as [`Names::parameter`].
    pub fn coordinate(&mut self, name: &str) -> Symbol {
        let symbol = Symbol::Coordinate(self.coordinates);
        self.coordinates += 1;
        self.add(name, symbol)
    }

    /// Adds a table, which expressions may call as a function.
    pub fn table(&mut self, table: Arc<Table>) {
        self.tables.push(table);
    }

    /// The table with this name.
    pub(super) fn table_named(&self, name: &str) -> Option<&Arc<Table>> {
        self.tables.iter().find(|table| *table.name == *name)
    }

    fn add(&mut self, name: &str, symbol: Symbol) -> Symbol {
        if !self.symbols.contains_key(name) {
            self.symbols.insert(name.to_owned(), symbol);
            self.in_order.push(name.to_owned());
        }
        symbol
    }

    /// Returns the symbol for which `name` stands, or `None` if it is unknown. `t` is always time,
    /// `sliding_speed` the absolute sliding velocity, and no other reserved name is a symbol.
    pub fn lookup(&self, name: &str) -> Option<Symbol> {
        match name {
            TIME => Some(Symbol::Time),
            SLIDING_SPEED => Some(Symbol::SlidingSpeed),
            _ if is_reserved(name) => None,
            _ => self.symbols.get(name).copied(),
        }
    }

    /// The name most like `name`, if one is like it at all: one of those added, `t`, `pi` or `sliding_speed`.
    pub fn nearest(&self, name: &str) -> Option<&str> {
        let known = self.in_order.iter().map(String::as_str).chain([TIME, PI, SLIDING_SPEED]);
        all_nearest(name, known).first().copied()
    }

    /// The function or table most like `name`, if one is like it at all.
    pub(super) fn nearest_function(&self, name: &str) -> Option<&str> {
        let tables = self.tables.iter().map(|table| &*table.name);
        let callable = function::named().map(|(known, _)| known).chain([RATE]).chain(tables);
        all_nearest(name, callable).first().copied()
    }

    /// The coordinate most like `name`, if one is like it at all.
    pub(super) fn nearest_coordinate(&self, name: &str) -> Option<&str> {
        let is_coordinate = |other: &&str| matches!(self.lookup(other), Some(Symbol::Coordinate(_)));
        all_nearest(name, self.in_order.iter().map(String::as_str).filter(is_coordinate)).first().copied()
    }
}

pub(super) const TIME: &str = "t";
pub(super) const PI: &str = "pi";
pub(super) const RATE: &str = "rate";
pub(super) const SLIDING_SPEED: &str = "sliding_speed";

/// Whether `name` has a fixed meaning in every expression: `t`, `pi`, `rate`, `sliding_speed` and the
/// functions.
///
/// ```
/// assert!(slideway::expression::is_reserved("sin"));
/// assert!(!slideway::expression::is_reserved("m"));
/// ```
pub fn is_reserved(name: &str) -> bool {
    [TIME, PI, RATE, SLIDING_SPEED].contains(&name) || function::find(name).is_some()
}

/// Whether `name` has the form of a name: a letter or `_`, then letters, digits 0 to 9 and `_`.
///
/// Letters of every script count. A name of this form may still be reserved, see [`is_reserved`].
///
/// ```
/// assert!(slideway::expression::is_valid_name("φ_1"));
/// assert!(!slideway::expression::is_valid_name("2nd"));
/// ```
pub fn is_valid_name(name: &str) -> bool {
    name.starts_with(starts_name) && name.chars().all(continues_name)
}

pub(super) fn starts_name(character: char) -> bool {
    // Some fillers of Hangul count as letters, and nobody sees them.
    (character.is_alphabetic() && !is_hidden(character)) || character == '_'
}

pub(super) fn continues_name(character: char) -> bool {
    starts_name(character) || character.is_ascii_digit()
}
