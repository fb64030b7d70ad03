//! The columns of a table.

use slideway::sweep::Sweep;

/// The columns of a table besides its numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Names and units of the varied quantities.
    pub varied: Vec<(String, &'static str)>,
    /// Names and units of the numbers of a state.
    pub numbers: Vec<(String, &'static str)>,
    /// Contacts of the mechanism: the characters of a pattern.
    pub contacts: usize,
    /// Whether there is a column for the attainability.
    pub attainability: bool,
}

impl Layout {
    /// The columns of a sweep over so many quantities.
    pub fn of(sweep: &Sweep, varied: usize, attainability: bool) -> Self {
        let columns = sweep.columns().iter().map(|column| (column.name.clone(), column.unit));
        let mut varied_columns: Vec<_> = columns.collect();
        let numbers = varied_columns.split_off(varied);
        Self { varied: varied_columns, numbers, contacts: sweep.contacts().count(), attainability }
    }
}
