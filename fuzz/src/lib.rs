//! What the fuzz targets share.

mod answer;
mod small;

pub use answer::answer;
pub use small::{arrays, patterns, problem};

/// Whether a text has a number that is not finite, as Rust writes it.
pub fn has_no_number(text: &str) -> bool {
    let is_none = |word: &str| matches!(word, "NaN" | "inf");
    text.split(|character: char| !character.is_alphanumeric()).any(is_none)
}
