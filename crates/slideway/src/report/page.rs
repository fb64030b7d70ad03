//! A report on its way to text.

use super::Style;

/// A report, and what has been written of it.
pub(crate) struct Page<'r, R> {
    pub(crate) report: &'r R,
    pub(crate) style: Style,
    pub(crate) out: String,
}

impl<'r, R> Page<'r, R> {
    /// Nothing has been written.
    pub(crate) fn new(report: &'r R, style: Style) -> Self {
        Self { report, style, out: String::new() }
    }

    /// Adds a line.
    pub(crate) fn line(&mut self, line: &str) {
        self.out.push_str(line);
        self.out.push('\n');
    }

    /// Adds a line in the style of headings.
    pub(crate) fn headline(&mut self, line: &str) {
        self.line(&self.style.heading(line));
    }
}
