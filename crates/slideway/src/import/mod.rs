//! Models from the drawings of other programs: a DXF file becomes a model to complete.
//!
//! [`dxf`] takes what a drawing says of a mechanism: outlines and points of bodies, one body for each layer.
//! Masses, joints, loads and the state, of which it says nothing, are left to be written into the model.
//! Nothing is left out in silence: comments in the model name it.
//!
//! # Files
//! `groups.rs` reads the group codes of the format, `entities.rs` the entities of the drawing, `curves.rs` ellipses
//! and splines, `blocks.rs` inserts blocks, `paths.rs` joins lines and arcs, `grid.rs` finds what is near,
//! `written.rs` writes the model. Group codes are those of the *DXF Reference* of Autodesk.

mod blocks;
mod curves;
mod entities;
mod grid;
mod groups;
mod layers;
mod paths;
mod written;

use crate::fault::Face;
use crate::model::SIZE_LIMIT;
use crate::printable;
use crate::progress::{Callback, Progress, Work, undisturbed, watched};
use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Largest drawing that is read, in bytes.
pub const DRAWING_LIMIT: u64 = 64 << 20;

/// How a drawing is read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ImportOptions {
    /// The title of the model.
    pub title: Option<String>,
    /// The unit of length of the drawing. Default: the one that it says.
    pub unit: Option<Unit>,
}

/// A unit of length of drawings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// 25.4 mm
    Inch,
    /// 12 inches
    Foot,
    /// 1e-6 m
    Micrometre,
    /// 1e-3 m
    Millimetre,
    /// 1e-2 m
    Centimetre,
    /// 0.1 m
    Decimetre,
    /// 1 m
    Metre,
    /// 1000 m
    Kilometre,
}

/// The units with their values of `$INSUNITS` and their names in model files.
const UNITS: [(Unit, i32, &str); 8] = [
    (Unit::Inch, 1, "in"),
    (Unit::Foot, 2, "ft"),
    (Unit::Millimetre, 4, "mm"),
    (Unit::Centimetre, 5, "cm"),
    (Unit::Metre, 6, "m"),
    (Unit::Kilometre, 7, "km"),
    (Unit::Micrometre, 13, "um"),
    (Unit::Decimetre, 14, "dm"),
];

impl Unit {
    /// Its name in model files.
    pub fn name(self) -> &'static str {
        UNITS.iter().find(|(unit, ..)| *unit == self).map_or("m", |(.., name)| name)
    }

    fn of_code(code: i32) -> Option<Self> {
        UNITS.iter().find(|(_, known, _)| *known == code).map(|(unit, ..)| *unit)
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.name())
    }
}

impl FromStr for Unit {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let names = || UNITS.iter().map(|(.., name)| *name).collect::<Vec<_>>().join(", ");
        let found = UNITS.iter().find(|(.., name)| *name == text).map(|(unit, ..)| *unit);
        found.ok_or_else(|| format!("the units of drawings are {}", names()))
    }
}

/// Why a drawing cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[expect(missing_docs, reason = "the messages say it")]
pub enum ImportFault {
    #[error("this is a binary DXF file; save the drawing as a text (ASCII) DXF file")]
    Binary,
    #[error("this is not UTF-8 text; save the drawing as DXF of version 2007 or later, which is")]
    Encoding,
    #[error("line {line} should be a group code, a whole number, not `{found}`: is this a DXF file?")]
    GroupCode { line: usize, found: String },
    #[error("the drawing ends in the middle, without its EOF: the file is not complete")]
    Truncated,
    #[error("the drawing has no section ENTITIES: there is nothing in it")]
    NoEntities,
    #[error("line {line}: group {code} of {entity} should be a finite number, not `{found}`")]
    Number { line: usize, code: i32, entity: String, found: String },
    #[error("line {line}: {entity} has no group {code}")]
    Missing { line: usize, code: i32, entity: String },
    #[error("the drawing does not say its unit of length ($INSUNITS)")]
    NoUnit,
    #[error("the unit of the drawing, $INSUNITS = {code}, is not one of model files")]
    UnknownUnit { code: i32 },
    #[error("no layer of the drawing has an outline or a point; what is in it: {}", in_words(left_out))]
    Nothing { left_out: Vec<String> },
    #[error("some numbers of the drawing are too large: its lengths cannot be computed")]
    NotFinite,
    #[error("the drawing has more than {limit} bytes; leave layers out")]
    DrawingTooLarge { limit: u64 },
    #[error("the drawing has more than {limit} entities with those that its blocks insert; leave layers out")]
    TooManyEntities { limit: usize },
    #[error("the model would have {size} bytes, and at most {SIZE_LIMIT} are read; leave layers out")]
    TooLarge { size: usize },
}

impl ImportFault {
    /// Returns a hint in the words of an interface, or `None` if there is nothing better to say than the
    /// message itself.
    pub fn hint_for(&self, face: &dyn Face) -> Option<String> {
        match self {
            Self::NoUnit => Some(format!("say it, for instance with `{}`", face.option_with("unit", "mm"))),
            Self::UnknownUnit { .. } => {
                Some(format!("scale the drawing, or say the unit with {}", face.option("unit")))
            }
            _ => None,
        }
    }
}

fn in_words(left_out: &[String]) -> String {
    if left_out.is_empty() { "nothing".to_owned() } else { left_out.join("; ") }
}

/// The text of a model file with the outlines and points of a DXF drawing.
///
/// Every layer with an outline or a point is a body. Its outline is the greatest closed line of the layer:
/// closed polylines, and lines, arcs, parts of ellipses, splines and open polylines that join end to end; without any,
/// its greatest circle. Ellipses and splines become arcs that stay near them. Blocks are inserted. Points are the `POINT`s and the centres of circles; points of several layers in one place are one
/// point of several bodies. A `TEXT` beside a point is its name. The layer `ground` has points only.
///
/// ```
/// use slideway::import::{ImportOptions, dxf};
///
/// let drawing = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n\
///     0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\ncrank\n10\n0\n20\n0\n40\n60\n0\nENDSEC\n0\nEOF\n";
/// let model = dxf(drawing, &ImportOptions::default())?;
/// assert!(model.contains("[bodies.crank]"));
/// # Ok::<(), slideway::import::ImportFault>(())
/// ```
///
/// # Errors
/// What keeps the drawing from being read, with its line.
pub fn dxf(text: &str, options: &ImportOptions) -> Result<String, ImportFault> {
    undisturbed(|work| model_of(text, options, work))
}

/// [`dxf`] with a callback that receives the progress and may end the work; `None` if it does.
///
/// # Errors
/// As [`dxf`].
pub fn dxf_with(
    text: &str,
    options: &ImportOptions,
    callback: &mut Callback<'_>,
) -> Result<Option<String>, ImportFault> {
    watched(callback, |work| model_of(text, options, work))
}

fn model_of(text: &str, options: &ImportOptions, work: Work<'_>) -> Result<String, ImportFault> {
    let sections = groups::sections(text)?;
    let unit = match (options.unit, sections.unit) {
        (Some(unit), _) => unit,
        (None, None | Some(0)) => return Err(ImportFault::NoUnit),
        (None, Some(code)) => Unit::of_code(code).ok_or(ImportFault::UnknownUnit { code })?,
    };
    let drawing = blocks::Reader::new(&sections, work).read(&sections.entities)?;
    let bodies = paths::Bodies::of(&drawing, work);
    if bodies.layers.is_empty() && bodies.spots.is_empty() {
        return Err(ImportFault::Nothing { left_out: bodies.left_out });
    }
    if !bodies.are_finite() {
        return Err(ImportFault::NotFinite);
    }
    let model = written::model(&bodies, unit, options.title.as_deref());
    let size = model.len();
    if size as u64 > SIZE_LIMIT { Err(ImportFault::TooLarge { size }) } else { Ok(model) }
}

/// Tells now and then how many of something are done, and whether to go on.
fn goes_on(work: Work<'_>, counted: &'static str, done: usize) -> bool {
    const BETWEEN: usize = 512;
    let progress = Progress { counted, done: done as u64, fraction: None, found: None };
    !done.is_multiple_of(BETWEEN) || work.tell(&progress).is_continue()
}

/// A text of the drawing, as it may stand in messages.
fn shown(text: &str) -> String {
    printable::line(text).into_owned()
}
