//! Pictures of slideway's results.
//!
//! The library [`slideway`] computes and knows no pictures; this crate turns its values into SVG, HTML, PNG
//! and GIF, without computing anything of mechanics. Like the library it reads no file and no clock, and
//! prints nothing.
//!
//! # Features
//! - `png` (on by default): pictures of pixels, `raster` and [`motion::Animation::to_gif`].

#![forbid(unsafe_code)]

mod changes;
mod coordinate;
pub mod drawing;
pub mod map;
pub mod motion;
pub mod page;
pub mod plot;
#[cfg(feature = "png")]
pub mod raster;
pub mod theme;
pub mod typeface;

pub use coordinate::NotFinite;

/// Words as a picture shows them, as they stand in XML: without the marks around commands, with true exponents.
pub(crate) fn printed(words: &str) -> String {
    let mut printed = words.replace('`', "");
    for (typed, exponent) in [("^2", "²"), ("^3", "³")] {
        let parts: Vec<&str> = printed.split(typed).collect();
        let is_digit = |next: char| next.is_ascii_digit();
        let goes_on = |part: &str| part.strip_prefix('.').unwrap_or(part).starts_with(is_digit);
        let joined =
            parts[1..].iter().map(|part| [if goes_on(part) { typed } else { exponent }, part].concat());
        printed = parts[0].to_owned() + &joined.collect::<String>();
    }
    escaped(&printed)
}

/// Text as it stands in XML and HTML, in elements and attributes: characters that are not seen, some of which
/// XML does not allow, stand as their numbers ([`slideway::printable`]). Ends of lines are blanks.
pub(crate) fn escaped(text: &str) -> String {
    let blank = text.replace(['\n', '\r'], " ");
    let mut out = String::with_capacity(text.len());
    for character in slideway::printable::line(&blank).chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    #[test]
    fn what_is_printed_has_true_exponents_and_no_marks_of_commands() {
        assert_eq!(super::printed("ask `hold`: 2 m/s^2 & kg m^2"), "ask hold: 2 m/s² &amp; kg m²");
        assert_eq!(super::printed("x^25, x^2.5, x^2. And x^3"), "x^25, x^2.5, x². And x³");
    }
}
