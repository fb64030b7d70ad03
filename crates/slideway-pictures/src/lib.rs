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
