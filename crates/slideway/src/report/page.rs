//! A report on its way to text.

use super::{Status, Style};
use crate::printable;
use anstyle::{AnsiColor, Style as Ansi};
use std::fmt::Write;

/// A report, and what has been written of it.
///
/// Colours come in here and nowhere else, and all other text becomes [`printable`] before: so whatever a
/// model holds, the text has no escape sequences but those of its own style.
pub(crate) struct Page<'r, R> {
    pub(crate) report: &'r R,
    style: Style,
    out: String,
}

impl<'r, R> Page<'r, R> {
    /// Nothing has been written.
    pub(crate) fn new(report: &'r R, style: Style) -> Self {
        Self { report, style, out: String::new() }
    }

    /// Adds a line.
    pub(crate) fn line(&mut self, line: &str) {
        self.out.push_str(&printable::line(line));
        self.out.push('\n');
    }

    /// Adds lines, each with its end.
    pub(crate) fn lines(&mut self, lines: &str) {
        self.out.push_str(&printable::lines(lines));
    }

    /// Adds a line in the style of headings.
    pub(crate) fn headline(&mut self, line: &str) {
        self.painted(Ansi::new().bold(), line, "");
    }

    /// Adds a line that begins with a heading.
    pub(crate) fn headed(&mut self, heading: &str, rest: &str) {
        self.painted(Ansi::new().bold(), heading, rest);
    }

    /// Adds a line in the colour of what was found.
    pub(crate) fn status(&mut self, status: Status, verdict: &str) {
        let colour = match status {
            Status::One => AnsiColor::Green,
            Status::None => AnsiColor::Red,
            _ => AnsiColor::Yellow,
        };
        self.painted(colour.on_default().bold(), verdict, "");
    }

    /// Adds a line that begins in a style.
    pub(crate) fn painted(&mut self, ansi: Ansi, painted: &str, rest: &str) {
        let painted = printable::line(painted);
        let _ = match self.style {
            Style::Plain => write!(self.out, "{painted}"),
            Style::Colour => write!(self.out, "{ansi}{painted}{ansi:#}"),
        };
        self.line(rest);
    }

    /// Adds all of a page that was written by itself.
    pub(crate) fn append<S>(&mut self, page: &Page<'_, S>) {
        self.out.push_str(&page.out);
    }

    /// What has been written.
    pub(crate) fn text(self) -> String {
        self.out
    }
}
