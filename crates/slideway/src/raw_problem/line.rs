//! The lines of an answer that is given state by state.

use super::RawLine;
use crate::report::{Report, Style};

impl Report for RawLine {
    /// Returns the line as JSON: lines are for programs.
    fn text(&self, _: Style) -> String {
        self.json_line()
    }
}
