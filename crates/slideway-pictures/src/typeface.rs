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

/// The characters of DejaVu Sans (`fonts/README.md`).
static GLYPHS: LazyLock<HashMap<char, Glyph>> =
    LazyLock::new(|| include_str!("../fonts/outlines.txt").lines().filter_map(Glyph::of_line).collect());

/// A character of the typeface, in its units, y upwards.
struct Glyph {
    advance: f64,
    /// The data of an SVG path: M, L, Q and Z with absolute places.
    #[cfg_attr(not(feature = "png"), expect(dead_code, reason = "letters of pixels alone have outlines"))]
    outline: &'static str,
}

impl Glyph {
    fn of_line(line: &'static str) -> Option<(char, Self)> {
        let (number, rest) = line.split_once(' ')?;
        let (advance, outline) = rest.split_once(' ')?;
        let character = char::from_u32(u32::from_str_radix(number, 16).ok()?)?;
        Some((character, Self { advance: advance.parse().ok()?, outline }))
    }
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
        for command in glyph(character).into_iter().flat_map(|glyph| commands(glyph.outline)) {
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

/// The glyph of a character; of the sign for what is missing if the typeface does not have it.
fn glyph(character: char) -> Option<&'static Glyph> {
    GLYPHS.get(&character).or_else(|| GLYPHS.get(&'\u{fffd}'))
}

/// Advance of a character in units of the size.
fn advance(character: char) -> f64 {
    glyph(character).map_or(0.6, |glyph| glyph.advance / UNITS)
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
        assert_eq!(GLYPHS.len(), include_str!("../fonts/outlines.txt").lines().count());
        assert!(GLYPHS.contains_key(&'\u{fffd}') && GLYPHS.contains_key(&'μ') && GLYPHS.contains_key(&' '));
    }
}
