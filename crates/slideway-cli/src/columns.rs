//! Lists in two columns: names, and what each of them is.

use std::fmt::Write;

/// Columns of the narrowest terminal in use.
pub(crate) const WIDTH: usize = 80;

/// Names, each with what it is beside it, wrapped to [`WIDTH`] columns and indented by so many blanks.
pub(crate) fn list(entries: &[(String, String)], indent: usize) -> String {
    let width = entries.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for (entry, meaning) in entries {
        let lines = wrapped(meaning, WIDTH.saturating_sub(indent + width + 2));
        for (index, line) in lines.iter().enumerate() {
            let name = if index == 0 { entry } else { "" };
            let line = format!("{:indent$}{name:width$}  {line}", "");
            let _ = writeln!(text, "{}", line.trim_end());
        }
    }
    text
}

/// Lines of at most `width` characters, broken between words, but not between a value and its name or unit.
pub(crate) fn wrapped(text: &str, width: usize) -> Vec<String> {
    slideway::report::wrapped(text, "", width)
}
