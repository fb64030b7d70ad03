//! Faults of one of many problems.

use super::{RawFaults, SCHEMA};
use crate::report::{Report, Style};
use serde::Serialize;

/// Report in place of the answer to a problem in a line that cannot be understood.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct FaultyLine {
    /// Version of this layout, as that of an answer.
    pub schema: &'static str,
    /// The line, from 1.
    pub line: u64,
    /// Everything that is wrong with it.
    pub faults: Vec<String>,
}

impl FaultyLine {
    /// Builds the report on the faults of a line, each with its hint.
    pub fn new(line: u64, faults: &RawFaults) -> Self {
        let with_hint = |fault: &super::RawFault| match fault.hint() {
            Some(hint) => format!("{fault}; {hint}"),
            None => fault.to_string(),
        };
        Self { schema: SCHEMA, line, faults: faults.iter().map(with_hint).collect() }
    }
}

impl FaultyLine {
    /// A problem that ends in a fault of the program itself.
    pub fn of_program(line: u64) -> Self {
        let fault = "a fault of slideway, which should not happen: please report this problem".to_owned();
        Self { schema: SCHEMA, line, faults: vec![fault] }
    }
}

impl Report for FaultyLine {
    fn text(&self, _: Style) -> String {
        format!("line {}: {}\n", self.line, self.faults.join("; "))
    }
}
