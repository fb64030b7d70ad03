//! A report on its way to text.

use super::table::table;
use super::{Status, Style};
use crate::printable;
use anstyle::{AnsiColor, Style as Ansi};
use std::fmt::Write;
use textwrap::{Options, WordSplitter, wrap};

/// A report, and what has been written of it.
///
/// Colours come in here and nowhere else, and all other text becomes [`printable`] before: so whatever a
/// model holds, the text has no escape sequences but those of its own style. Lines are wrapped here and nowhere else.
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

    /// Whether the details are asked for.
    pub(crate) fn is_verbose(&self) -> bool {
        self.style.verbose
    }

    /// Adds a line of prose, wrapped; further lines are indented like the first.
    pub(crate) fn line(&mut self, line: &str) {
        self.hung(line, "");
    }

    /// Adds a line of prose under a first column: further lines are indented by its width, too.
    pub(crate) fn hung(&mut self, line: &str, first: &str) {
        let line = printable::line(line);
        let blanks = line.len() - line.trim_start().len();
        let indent = " ".repeat(blanks + first.chars().count());
        for line in wrapped(&line, &indent, self.style.width) {
            self.out.push_str(line.trim_end());
            self.out.push('\n');
        }
    }

    /// Adds rows under a header, no wider than the page if they can be.
    pub(crate) fn table(&mut self, header: &[impl AsRef<str>], rows: &[Vec<String>]) {
        let header: Vec<&str> = header.iter().map(AsRef::as_ref).collect();
        let table = table(&header, rows, self.style.width);
        self.out.push_str(&printable::lines(&table));
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

    /// Adds a line that begins in a style, wrapped.
    pub(crate) fn painted(&mut self, ansi: Ansi, painted: &str, rest: &str) {
        let (painted, rest) = (printable::line(painted), printable::line(rest));
        let mut left = painted.chars().filter(|letter| !letter.is_whitespace()).count();
        for line in wrapped(&format!("{painted}{rest}"), "", self.style.width) {
            // As much of the line as is left of what is painted.
            let end = line.char_indices().filter(|(_, letter)| !letter.is_whitespace()).nth(left);
            let (bright, plain) = line.split_at(end.map_or(line.len(), |(at, _)| at));
            let (bright, gap) = bright.split_at(bright.trim_end().len());
            let _ = if self.style.colour && !bright.is_empty() {
                writeln!(self.out, "{ansi}{bright}{ansi:#}{gap}{plain}")
            } else {
                writeln!(self.out, "{}", line.trim_end())
            };
            left -= bright.chars().filter(|letter| !letter.is_whitespace()).count();
        }
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

/// A line in pieces of a width at most, but for words that are longer; all but the first are indented.
fn wrapped(line: &str, indent: &str, width: usize) -> Vec<String> {
    if line.is_empty() {
        return vec![String::new()];
    }
    let blanks = line.len() - line.trim_start().len();
    let options = Options::new(width)
        .initial_indent(&line[..blanks])
        .subsequent_indent(indent)
        .break_words(false)
        .word_splitter(WordSplitter::NoHyphenation)
        .wrap_algorithm(textwrap::WrapAlgorithm::FirstFit);
    wrap(line.trim_start(), options).into_iter().map(std::borrow::Cow::into_owned).collect()
}
