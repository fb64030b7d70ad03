//! The columns of a table.

use crate::npz::element_type;
use crate::record::fields;
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
    /// Whether branches are numbered. If not, there is instead a column for the sign of the determinant,
    /// which is all that else is needed to number them.
    pub numbered: bool,
}

impl Layout {
    /// The columns of a sweep over so many quantities, or of a shard of one.
    pub fn of(sweep: &Sweep, varied: usize, attainability: bool) -> Self {
        let columns = sweep.columns().iter().map(|column| (column.name.clone(), column.unit));
        let mut varied_columns: Vec<_> = columns.collect();
        let numbers = varied_columns.split_off(varied);
        let numbered = sweep.of_shard().is_none();
        Self { varied: varied_columns, numbers, contacts: sweep.contacts().count(), attainability, numbered }
    }

    /// The columns in their order, each with its type in the language of NumPy: "<u8", "<u4", "<f8", "|S12".
    pub fn fields(&self) -> Vec<(String, String)> {
        fields(self).into_iter().map(|field| (field.name, element_type(field.kind))).collect()
    }

    /// Bytes of a record.
    pub fn record(&self) -> usize {
        crate::record::size(self)
    }
}
