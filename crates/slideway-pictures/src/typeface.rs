//! The typeface of pictures: widths for the layout, and outlines for pictures of pixels.
//!
//! Pictures of vectors name the typefaces of the reader's machine ([`STACK`]). Widths are those of the
//! typeface that is built in, a wide one, so that what is laid out with it has room in the others.

use std::collections::HashMap;
#[cfg(feature = "png")]
use std::fmt::Write;
use std::sync::LazyLock;

/// The typefaces that pictures of vectors ask for.
pub const STACK: &str = "'DejaVu Sans', Verdana, Arial, Helvetica, sans-serif";

/// Units of the typeface in its size.
const UNITS: f64 = 2048.0;

/// The advances of the characters of DejaVu Sans, in its units (`fonts/README.md`).
static ADVANCES: LazyLock<HashMap<char, f64>> = LazyLock::new(|| {
    let of_line = |(character, advance): (char, &str)| Some((character, advance.parse().ok()?));
    lines(include_str!("../fonts/advances.txt")).filter_map(of_line).collect()
});

/// Their outlines, as the data of an SVG path: M, L, Q and Z with absolute places in these units, y upwards.
#[cfg(feature = "png")]
static OUTLINES: LazyLock<HashMap<char, &'static str>> =
    LazyLock::new(|| lines(include_str!("../fonts/outlines.txt")).collect());

/// Returns each character of a file, with the data of its line.
fn lines(file: &'static str) -> impl Iterator<Item = (char, &'static str)> {
    file.lines().filter_map(|line| {
        let (number, rest) = line.split_once(' ')?;
        Some((char::from_u32(u32::from_str_radix(number, 16).ok()?)?, rest))
    })
}

/// Width of a text, in units of its size times `size`.
///
/// ```
/// // Advances of DejaVu Sans: 721 + 842 + 569 + 1126 + 803 + 569 + 1253 + 1298 of 2048 units.
/// let width = slideway_pictures::typeface::width("friction", 10.0);
/// assert!((width - 71810.0 / 2048.0).abs() < 1e-9);
/// ```
pub fn width(text: &str, size: f64) -> f64 {
    text.chars().map(advance).sum::<f64>() * size
}

/// Outlines of a text as the data of an SVG path, beginning at (x, y) on the base line.
#[cfg(feature = "png")]
pub(crate) fn outlines(text: &str, size: f64, x: f64, y: f64) -> String {
    let mut out = String::new();
    let (mut pen, scale) = (x, size / UNITS);
    for character in text.chars() {
        for command in found(&OUTLINES, character).into_iter().flat_map(|outline| commands(outline)) {
            out.push_str(&command[..1]);
            let numbers = command[1..].split(' ').filter_map(|number| number.parse::<f64>().ok());
            for (index, number) in numbers.enumerate() {
                let place = if index % 2 == 0 { pen + scale * number } else { y - scale * number };
                let _ = write!(out, " {place:.2}");
            }
        }
        pen += advance(character) * size;
    }
    out
}

/// The commands of a path, each with its letter before its places.
#[cfg(feature = "png")]
fn commands(outline: &str) -> impl Iterator<Item = &str> {
    let starts = outline.match_indices(|c: char| c.is_ascii_uppercase()).map(|(at, _)| at);
    let ends = starts.clone().skip(1).chain([outline.len()]);
    starts.zip(ends).map(|(start, end)| &outline[start..end])
}

/// Finds the data of a character, or of the sign for what is missing if the typeface does not have it.
fn found<T>(glyphs: &HashMap<char, T>, character: char) -> Option<&T> {
    glyphs.get(&character).or_else(|| glyphs.get(&'\u{fffd}'))
}

/// Advance of a character in units of the size.
fn advance(character: char) -> f64 {
    found(&ADVANCES, character).map_or(0.6, |advance| advance / UNITS)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The outline of the bar of the letter I in DejaVu Sans: 201 to 403 wide, 1493 high.
    #[cfg(feature = "png")]
    #[test]
    fn outlines_are_scaled_and_put_in_their_place() {
        let outline = outlines("I", UNITS, 10.0, 2000.0);
        for place in [" 211.00 507.00", " 413.00 507.00", " 413.00 2000.00", " 211.00 2000.00"] {
            assert!(outline.contains(place), "{outline}");
        }
        assert!(outline.starts_with('M') && outline.ends_with('Z'));
    }

    #[test]
    fn every_character_of_the_file_is_read() {
        assert_eq!(ADVANCES.len(), include_str!("../fonts/advances.txt").lines().count());
        assert!(['\u{fffd}', 'μ', ' '].iter().all(|character| ADVANCES.contains_key(character)));
    }

    #[cfg(feature = "png")]
    #[test]
    fn every_character_has_an_advance_and_an_outline() {
        assert_eq!(OUTLINES.len(), include_str!("../fonts/outlines.txt").lines().count());
        assert!(
            OUTLINES.len() == ADVANCES.len()
                && OUTLINES.keys().all(|character| ADVANCES.contains_key(character))
        );
    }
}
