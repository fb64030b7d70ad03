//! Pictures of pixels: SVG in, PNG out.
//!
//! Text is set with the typeface that is built in ([`crate::typeface`]), so that a picture looks the same on
//! every machine, also on one without typefaces. `text` and `tspan` elements are read as this crate writes
//! them: `x`, `y`, `dx`, `dy`, `font-size`, `text-anchor` and `dominant-baseline` as attributes, the first
//! two also those of their ancestors.

use crate::typeface;
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::roxmltree::{Document, Node};
use resvg::usvg::{Options, Tree};
use std::fmt::Write;
use thiserror::Error;

/// The greatest width and height of a picture of pixels.
pub const GREATEST_SIDE: u32 = 16_384;

/// Why a picture has no pixels.
#[derive(Debug, Error)]
pub enum RasterFault {
    /// The text is not SVG.
    #[error("the picture cannot be read: {0}")]
    NotSvg(String),
    /// The picture would be empty or too large.
    #[error(
        "a picture of {width:.0} x {height:.0} pixels is not possible: each side has 1 to {GREATEST_SIDE}"
    )]
    Size {
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// The pixels cannot be packed.
    #[error("the picture cannot be packed as PNG: {0}")]
    Packing(String),
}

/// A picture as PNG, `scale` pixels for each unit of the SVG.
///
/// # Errors
/// If the text is not SVG, or the picture too large.
///
/// ```
/// let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><text x="1" y="15">N</text></svg>"#;
/// let png = slideway_pictures::raster::png(svg, 2.0)?;
/// assert_eq!(&png[1..4], b"PNG");
/// # Ok::<(), slideway_pictures::raster::RasterFault>(())
/// ```
pub fn png(svg: &str, scale: f64) -> Result<Vec<u8>, RasterFault> {
    pixels(svg, scale)?.encode_png().map_err(|error| RasterFault::Packing(error.to_string()))
}

/// A picture as pixels, `scale` of them for each unit of the SVG.
pub(crate) fn pixels(svg: &str, scale: f64) -> Result<Pixmap, RasterFault> {
    let not_svg = |error: &dyn std::fmt::Display| RasterFault::NotSvg(error.to_string());
    let document = Document::parse(svg).map_err(|error| not_svg(&error))?;
    let outlined = with_outlines(svg, &document);
    let tree = Tree::from_str(&outlined, &Options::default()).map_err(|error| not_svg(&error))?;
    let [width, height] =
        [tree.size().width(), tree.size().height()].map(|side| (f64::from(side) * scale).round());
    let is_possible = |side: f64| (1.0..=f64::from(GREATEST_SIDE)).contains(&side);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "within 1 and the greatest side"
    )]
    let pixmap = if is_possible(width) && is_possible(height) {
        Pixmap::new(width as u32, height as u32)
    } else {
        None
    };
    let mut pixmap = pixmap.ok_or(RasterFault::Size { width, height })?;
    #[expect(clippy::cast_possible_truncation, reason = "pixels need no more precision")]
    let transform = Transform::from_scale(scale as f32, scale as f32);
    resvg::render(&tree, transform, &mut pixmap.as_mut());
    Ok(pixmap)
}

/// The SVG with the outlines of its texts in their place.
fn with_outlines(svg: &str, document: &Document<'_>) -> String {
    let mut out = String::with_capacity(2 * svg.len());
    let mut done = 0;
    for text in document.descendants().filter(|node| node.has_tag_name("text") || is_svg(node, "text")) {
        let range = text.range();
        if range.start < done {
            continue;
        }
        out.push_str(&svg[done..range.start]);
        let mut pen = Pen { x: number(&text, "x"), y: number(&text, "y") };
        group(&text, &mut pen, &mut out);
        done = range.end;
    }
    out.push_str(&svg[done..]);
    out
}

fn is_svg(node: &Node<'_, '_>, name: &str) -> bool {
    node.has_tag_name(("http://www.w3.org/2000/svg", name))
}

/// Where the next letter stands.
struct Pen {
    x: f64,
    y: f64,
}

/// Attributes that say where and how large letters are; outlines hold all that.
const OF_LETTERS: [&str; 10] = [
    "x",
    "y",
    "dx",
    "dy",
    "font-size",
    "font-family",
    "font-weight",
    "font-style",
    "text-anchor",
    "dominant-baseline",
];

/// A `text` or `tspan` as a group of outlines with the same other attributes.
fn group(element: &Node<'_, '_>, pen: &mut Pen, out: &mut String) {
    out.push_str("<g");
    for attribute in element.attributes().filter(|attribute| !OF_LETTERS.contains(&attribute.name())) {
        let _ = write!(out, " {}=\"{}\"", attribute.name(), crate::escaped(attribute.value()));
    }
    out.push('>');
    for child in element.children() {
        if let Some(text) = child.text().filter(|_| child.is_text()) {
            letters(element, text, pen, out);
        } else if is_svg(&child, "tspan") {
            pen.x = child.attribute("x").map_or(pen.x, |_| number(&child, "x")) + number(&child, "dx");
            pen.y = child.attribute("y").map_or(pen.y, |_| number(&child, "y")) + number(&child, "dy");
            group(&child, pen, out);
        }
    }
    out.push_str("</g>");
}

fn letters(element: &Node<'_, '_>, text: &str, pen: &mut Pen, out: &mut String) {
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let size = inherited(element, "font-size")
        .and_then(|size| size.trim_end_matches("px").parse().ok())
        .unwrap_or(16.0);
    let width = typeface::width(&text, size);
    let start = match inherited(element, "text-anchor") {
        Some("middle") => pen.x - 0.5 * width,
        Some("end") => pen.x - width,
        _ => pen.x,
    };
    let lowered = match inherited(element, "dominant-baseline") {
        Some("middle" | "central") => 0.35 * size,
        Some("hanging") => 0.75 * size,
        _ => 0.0,
    };
    let _ = write!(out, "<path d=\"{}\"/>", typeface::outlines(&text, size, start, pen.y + lowered));
    pen.x = start + width;
}

/// An attribute of an element or its nearest ancestor that has it.
fn inherited<'a>(element: &Node<'a, '_>, name: &str) -> Option<&'a str> {
    element.ancestors().find_map(|node| node.attribute(name))
}

fn number(element: &Node<'_, '_>, name: &str) -> f64 {
    element.attribute(name).and_then(|value| value.trim_end_matches("px").parse().ok()).unwrap_or(0.0)
}
