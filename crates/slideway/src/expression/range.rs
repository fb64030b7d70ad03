//! The two dots between the ends of a range.

use std::ops::Range;

/// Separator between the ends of a range.
pub(crate) const TO: &str = "..";
/// Mistyped separators: of `0...1` the end would be 0.1, which nobody means.
const NOT_TO: [&str; 2] = ["...", "\u{2026}"];

/// Both ends of a range, if it is one.
///
/// # Errors
/// The place of three dots instead of two, or of the character that looks like three.
pub(crate) fn ends_of_range(text: &str) -> Result<Option<(&str, &str)>, Range<usize>> {
    let wrong = NOT_TO.into_iter().find_map(|dots| Some((text.find(dots)?, dots.len())));
    match wrong {
        Some((start, length)) => Err(start..start + length),
        None => Ok(text.split_once(TO)),
    }
}
