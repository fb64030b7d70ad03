//! Places and sizes of pictures as text: the one way in which numbers get into a picture.

use crate::escaped;
use thiserror::Error;

/// Placeholder for a number that has no text. Neither XML nor [`crate::escaped`] lets such a character
/// through, so that nothing else in a picture looks like it.
const NONE: &str = "\u{ffff}";

/// A picture with a place or a size that is infinite or undefined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "a position or a size in it is infinite or undefined: some number is too large or too small to be drawn"
)]
pub struct NotFinite;

/// Formats a number. One that is not finite becomes a placeholder, and [`finished`] refuses the picture.
fn text(value: f64, format: impl FnOnce(f64) -> String) -> String {
    if value.is_finite() { format(value) } else { NONE.to_owned() }
}

/// With all its digits.
pub(crate) fn exact(value: f64) -> String {
    text(value, |value| format!("{value:?}"))
}

/// With three decimals, as times have them.
pub(crate) fn thousandths(value: f64) -> String {
    text(value, |value| format!("{value:.3}"))
}

/// With one decimal, as factors have them.
pub(crate) fn tenths(value: f64) -> String {
    text(value, |value| format!("{value:.1}"))
}

/// Two decimals, without zeros at the end.
pub(crate) fn coordinate(value: f64) -> String {
    let text = text(value, |value| format!("{value:.2}"));
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// An attribute with places and sizes, as it stands in XML; it is no text from elsewhere.
pub(crate) fn attribute(value: &str) -> String {
    value.split(NONE).map(escaped).collect::<Vec<_>>().join(NONE)
}

/// Parts of a picture all of whose places and sizes are finite.
///
/// # Errors
/// If one is not.
pub(crate) fn finished_parts(parts: &[String]) -> Result<(), NotFinite> {
    if parts.iter().any(|part| part.contains(NONE)) { Err(NotFinite) } else { Ok(()) }
}

/// A picture all of whose places and sizes are finite.
///
/// # Errors
/// If one is not.
pub(crate) fn finished(picture: String) -> Result<String, NotFinite> {
    finished_parts(std::slice::from_ref(&picture)).map(|()| picture)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_decimals_and_nothing_else() {
        assert_eq!([1.0, -0.001, 12.345, -2.5].map(coordinate), ["1", "0", "12.35", "-2.5"]);
        assert_eq!([exact(0.15), thousandths(0.15), tenths(0.25)], ["0.15", "0.150", "0.2"]);
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for text in [coordinate(value), exact(value), thousandths(value), tenths(value)] {
                let element = format!("<path d=\"{}\"/>", attribute(&format!("M1 {text}")));
                assert_eq!(finished(element), Err(NotFinite));
            }
        }
        // Text that looks like it is none.
        let title = format!("<title>{}</title>", escaped("NaN, inf, \u{ffff}"));
        assert_eq!(finished(title.clone()), Ok(title));
    }
}
