//! Ranges of loads and reactions, in words.

use super::report::Range;
use crate::report::ends_in_words;
use crate::units::Unit;

/// Greatest finite magnitude among the ends.
pub(super) fn greatest(ranges: &[Range]) -> f64 {
    let ends = ranges.iter().flat_map(|range| [range.least, range.greatest]).flatten();
    ends.map(f64::abs).fold(0.0, f64::max)
}

/// True if both ends are the same but for what the linear programs leave over.
pub(super) fn is_one_value(range: Range, scale: f64) -> bool {
    range.least.zip(range.greatest).is_some_and(|(least, greatest)| greatest - least <= 1e-10 * scale)
}

/// "3", "1 to 3", "1 or more", "3 or less" or "any".
pub(super) fn words(range: Range, scale: f64, unit: &Unit) -> String {
    // What is left over by the linear programs is no range.
    let noise = 1e3 * scale;
    let number = |value: f64| unit.against(value, noise);
    match (range.least, range.greatest) {
        (Some(least), Some(greatest)) if number(least) == number(greatest) || is_one_value(range, scale) => {
            number(f64::midpoint(least, greatest))
        }
        ends => ends_in_words([ends.0, ends.1].map(|end| end.map(number))),
    }
}
