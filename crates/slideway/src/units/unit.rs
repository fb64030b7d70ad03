//! One unit, and numbers in it.

use super::number::{against, brief, number, precise};
use crate::expression::written_unit;

/// A unit in which numbers are shown.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    name: String,
    si: String,
    /// Its value in SI units; both numbers are exact for decimal units.
    numerator: f64,
    denominator: f64,
}

/// The unit of a pure number.
impl Default for Unit {
    fn default() -> Self {
        Self::si_unit("")
    }
}

impl Unit {
    pub(super) fn new(name: &str, si: &str, [numerator, denominator]: [f64; 2]) -> Self {
        Self { name: name.to_owned(), si: si.to_owned(), numerator, denominator }
    }

    /// A unit of the SI, by its name; that of a pure number is empty.
    pub fn si_unit(name: &str) -> Self {
        Self::new(name, name, [1.0, 1.0])
    }

    /// The only number of a text in SI units, and the unit behind it: 0.4 and "mm" of "400 mm"; nothing if
    /// there is none, or more than a number.
    ///
    /// ```
    /// let (pressure, unit) = slideway::units::Unit::of_quantity("2 N/mm^2").expect("a quantity");
    /// assert_eq!((pressure, unit.si()), (2e6, "Pa"));
    /// ```
    pub fn of_quantity(text: &str) -> Option<(f64, Self)> {
        let text = text.trim();
        let mut ends = (1..=text.len()).rev().filter(|&end| text.is_char_boundary(end));
        let (end, number) = ends.find_map(|end| Some((end, text[..end].parse::<f64>().ok()?)))?;
        let unit = Self::of_text(&text[end..])?;
        Some((number * unit.numerator / unit.denominator, unit))
    }

    /// The unit of a text such as "mm" or "N m"; nothing if it is none.
    pub fn of_text(text: &str) -> Option<Self> {
        written_unit(text).as_ref().map(Self::from)
    }

    /// Its name, empty for pure numbers.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The name of the SI unit of which it is a multiple.
    pub fn si(&self) -> &str {
        &self.si
    }

    /// This unit in SI units, as a quotient.
    pub(super) fn in_si(&self) -> [f64; 2] {
        [self.numerator, self.denominator]
    }

    /// This unit in SI units.
    pub fn scale(&self) -> f64 {
        self.numerator / self.denominator
    }

    /// How many of it an SI value is.
    pub fn number_of(&self, value: f64) -> f64 {
        value * self.denominator / self.numerator
    }

    /// An SI value in this unit, with five significant digits: "400 mm".
    pub fn show(&self, value: f64) -> String {
        self.worded(value, number)
    }

    /// An SI value in this unit, with eight significant digits.
    pub fn precise(&self, value: f64) -> String {
        self.worded(value, precise)
    }

    /// An SI value in this unit, with at most four significant digits: for sentences.
    pub(crate) fn brief(&self, value: f64) -> String {
        self.worded(value, brief)
    }

    /// [`Unit::brief`] without the name.
    pub(crate) fn brief_number(&self, value: f64) -> String {
        brief(self.number_of(value))
    }

    /// A heading of a column or an axis: "L in mm", and "L (in)", as "L in in" reads like a slip.
    pub fn title(&self, what: &str) -> String {
        match self.name() {
            "" => what.to_owned(),
            name if name.starts_with("in") => format!("{what} ({name})"),
            name => format!("{what} in {name}"),
        }
    }

    /// [`Unit::show`] without the name.
    pub(crate) fn number(&self, value: f64) -> String {
        number(self.number_of(value))
    }

    /// [`Unit::precise`] without the name.
    pub(crate) fn precise_number(&self, value: f64) -> String {
        precise(self.number_of(value))
    }

    /// [`Unit::number`], with rounding errors against `scale` shown as 0.
    pub(crate) fn against(&self, value: f64, scale: f64) -> String {
        against(self.number_of(value), self.number_of(scale))
    }

    /// Returns the range between two SI values of a quantity, in words: "L from 200 to 500 mm".
    pub(crate) fn range(&self, what: &str, [from, to]: [f64; 2]) -> String {
        format!("{what} from {} to {}", self.precise_number(from), self.precise(to))
    }

    /// An SI value with its unit, in that of the SI if this one makes it too great for a number.
    fn worded(&self, value: f64, digits: fn(f64) -> String) -> String {
        let number = self.number_of(value);
        if number.is_infinite() && value.is_finite() {
            return Self::si_unit(&self.si).worded(value, digits);
        }
        self.with(&digits(number))
    }

    /// A number with the name of the unit behind it.
    pub(crate) fn with(&self, number: &str) -> String {
        if self.name.is_empty() { number.to_owned() } else { format!("{number} {}", self.name) }
    }
}
