//! A report on its way to text.

use super::table::table;
use super::wrap::wrapped;
use super::{Status, Style};
use crate::printable;
use anstyle::{AnsiColor, Style as Ansi};

/// A report, and what has been written of it.
///
/// Colours come in here and nowhere else, and all other text becomes [`printable`] before: so whatever a
/// model holds, the text has no escape sequences but those of its own style. Lines are wrapped here and
/// nowhere else.
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

    /// True if the details are asked for.
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
            self.push(&line);
        }
    }

    /// Adds an empty line, unless there is one already.
    pub(crate) fn gap(&mut self) {
        if !self.out.ends_with("\n\n") {
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
        self.painted(Ansi::new().bold(), line);
    }

    /// Adds a line that begins with a heading, which is shorter than the page is wide.
    pub(crate) fn headed(&mut self, heading: &str, rest: &str) {
        let bold = Ansi::new().bold();
        let heading = printable::line(heading);
        let lines = wrapped(&format!("{heading}{}", printable::line(rest)), "", self.style.width);
        for line in lines {
            match line.strip_prefix(&*heading).filter(|_| self.style.colour) {
                Some(rest) => self.push(&format!("{bold}{heading}{bold:#}{rest}")),
                None => self.push(&line),
            }
        }
    }

    /// Adds a line in the colour of what was found.
    pub(crate) fn status(&mut self, status: Status, verdict: &str) {
        let colour = match status {
            Status::One => AnsiColor::Green,
            Status::None => AnsiColor::Red,
            _ => AnsiColor::Yellow,
        };
        self.painted(colour.on_default().bold(), verdict);
    }

    /// Adds a line in a style, wrapped.
    pub(crate) fn painted(&mut self, ansi: Ansi, line: &str) {
        for line in wrapped(&printable::line(line), "", self.style.width) {
            if self.style.colour && !line.is_empty() {
                self.push(&format!("{ansi}{}{ansi:#}", line.trim_end()));
            } else {
                self.push(&line);
            }
        }
    }

    /// Adds a line as it is.
    fn push(&mut self, line: &str) {
        self.out.push_str(line.trim_end());
        self.out.push('\n');
    }

    /// Adds all of a page that was written by itself.
    pub(crate) fn append<S>(&mut self, page: &Page<'_, S>) {
        self.out.push_str(&page.out);
    }

    /// The text so far.
    pub(crate) fn text(self) -> String {
        self.out
    }
}

#[cfg(test)]
mod tests {
    use super::Page;
    use crate::report::Style;

    #[test]
    fn a_value_stays_with_its_name() {
        let mut page = Page::new(&(), Style { width: 12, ..Style::PLAIN });
        page.line("jams from mu = 0.5 on");
        page.line("  a x = y");
        page.line("efficiency 55 %.");
        page.line("share of 55 %");
        assert_eq!(page.text(), "jams from\nmu = 0.5 on\n  a x = y\nefficiency\n55 %.\nshare of\n55 %\n");
    }

    #[test]
    fn a_number_stays_with_its_unit() {
        let mut page = Page::new(&(), Style { width: 14, ..Style::PLAIN });
        page.line("from 10 to 250 mm.");
        page.line("it needs a 2 N m torque");
        page.line("(up to the 5 m/s^2) it is");
        page.line("at 12 of them a b m");
        page.line("slides along (-1, 0)");
        page.line("with up to 12 lbf");
        let expected = "from 10 to\n250 mm.\nit needs a\n2 N m torque\n(up to the\n5 m/s^2) it is\nat 12 of them\na b m\nslides along\n(-1, 0)\nwith up to\n12 lbf\n";
        assert_eq!(page.text(), expected);
    }

    #[test]
    fn a_heading_is_bold_and_its_rest_is_not() {
        let mut page = Page::new(&(), Style { colour: true, width: 12, ..Style::PLAIN });
        page.headed("Solution 1", "   signs + -");
        page.gap();
        page.gap();
        page.headline("two words, wrapped");
        let expected = "\u{1b}[1mSolution 1\u{1b}[0m\nsigns + -\n\n\u{1b}[1mtwo words,\u{1b}[0m\n\u{1b}[1mwrapped\u{1b}[0m\n";
        assert_eq!(page.text(), expected);
    }
}
