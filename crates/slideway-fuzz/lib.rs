//! Checks of inputs that nobody would write: one function for each fuzz target of `fuzz/`, which panics where something is
//! wrong. The tests of the workspace run them on some inputs, so that they compile and hold with every commit.

mod answer;
mod expression;
mod limits;
mod model;
mod ranges;
mod raw;
mod search;
mod small;
mod terminal;

pub use expression::expression;
pub use limits::limits;
pub use model::model;
pub use ranges::ranges;
pub use raw::{raw_extremes, raw_json, raw_npz};
pub use search::search;
pub use terminal::terminal;

/// Whether a text has a number that is not finite, as Rust writes it.
fn has_no_number(text: &str) -> bool {
    let is_none = |word: &str| matches!(word, "NaN" | "inf");
    text.split(|character: char| !character.is_alphanumeric()).any(is_none)
}
