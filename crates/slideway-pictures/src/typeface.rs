//! The typeface of pictures: widths for the layout, and outlines for pictures of pixels.
//!
//! Pictures of vectors name the typefaces of the reader's machine ([`STACK`]). Widths are those of the typeface that is
//! built in, a wide one, so that what is laid out with it has room in the others.

use std::fmt::Write;
use std::sync::LazyLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// The typefaces that pictures of vectors ask for.
pub const STACK: &str = "'DejaVu Sans', Verdana, Arial, Helvetica, sans-serif";

static FACE: LazyLock<Option<Face<'static>>> =
    LazyLock::new(|| Face::parse(include_bytes!("../fonts/DejaVuSans-subset.ttf"), 0).ok());

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
pub(crate) fn outlines(text: &str, size: f64, x: f64, y: f64) -> String {
    let mut pen = Pen { data: String::new(), scale: size / units_per_em(), x, y };
    for character in text.chars() {
        if let (Some(face), Some(glyph)) = (FACE.as_ref(), glyph(character)) {
            face.outline_glyph(glyph, &mut pen);
        }
        pen.x += advance(character) * size;
    }
    pen.data
}

fn units_per_em() -> f64 {
    FACE.as_ref().map_or(1000.0, |face| f64::from(face.units_per_em()))
}

/// The glyph of a character; of the sign for what is missing if the typeface does not have it.
fn glyph(character: char) -> Option<GlyphId> {
    let face = FACE.as_ref()?;
    face.glyph_index(character).or_else(|| face.glyph_index('\u{fffd}'))
}

/// Advance of a character in units of the size.
fn advance(character: char) -> f64 {
    let units = glyph(character).and_then(|glyph| FACE.as_ref()?.glyph_hor_advance(glyph));
    units.map_or(0.6, |units| f64::from(units) / units_per_em())
}

/// Writes outlines as the data of a path.
struct Pen {
    data: String,
    scale: f64,
    x: f64,
    y: f64,
}

impl Pen {
    fn command(&mut self, letter: char, points: &[(f32, f32)]) {
        self.data.push(letter);
        for (x, y) in points {
            let (x, y) = (self.x + self.scale * f64::from(*x), self.y - self.scale * f64::from(*y));
            let _ = write!(self.data, " {x:.2} {y:.2}");
        }
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.command('M', &[(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.command('L', &[(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.command('Q', &[(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.command('C', &[(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.data.push('Z');
    }
}
