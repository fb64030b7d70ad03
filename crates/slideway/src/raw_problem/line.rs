//! The lines of an answer that is told state by state.

use super::RawLine;
use crate::report::{Report, Style};

impl Report for RawLine {
    /// The same as JSON: lines are for programs.
    fn text(&self, _: Style) -> String {
        self.json_line()
    }
}
