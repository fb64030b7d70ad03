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
        if lines.is_empty() {
            let _ = writeln!(text, "{:indent$}{entry}", "");
        }
        for (index, line) in lines.iter().enumerate() {
            let name = if index == 0 { entry } else { "" };
            let _ = writeln!(text, "{:indent$}{name:width$}  {line}", "");
        }
    }
    text
}

/// Lines of at most `width` characters, broken between words.
pub(crate) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
