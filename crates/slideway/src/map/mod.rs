//! Maps: which solutions there are over the plane of two parameters or coordinates.
//!
//! ```
//! use slideway::limits::Vary;
//! use slideway::map::{MapOptions, map};
//! use slideway::model::{Model, Settings};
//!
//! let text = slideway::gallery::find("klepp-2002").expect("in the gallery").text;
//! let model = Model::parse(text)?.with(&Settings::default().parameter("F_20", "0"))?;
//! let options = MapOptions::new(Vary::between("mu_1", 0.0, 0.8), Vary::between("mu_2", 0.0, 0.4));
//! let report = map(&model, &options.size(40, 40))?;
//! // One solution on the left of the locking value, two on the right of it.
//! let words: Vec<&str> = report.classes.iter().map(|class| &*class.words).collect();
//! assert_eq!(words, ["one solution", "two solutions"]);
//! assert_eq!(report.class_at(0, 0), 0);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```
//!
//! # Files
//! `map` colours a plane: `evaluate.rs` has the mode problem at a point and its states between faces,
//! `solved.rs` those of a point that is solved by itself, `class.rs` what its solutions come to, `refine.rs`
//! solves pixels only where neighbours differ, `effort.rs` chooses the classes of efforts.

mod class;
mod effort;
mod evaluate;
mod refine;
mod report;
mod solved;

pub use class::ClassMeaning;
pub use report::{MapAxis, MapClass, MapReport, SCHEMA};

use crate::choice::Choice;
use crate::fault::{Fault, FaultKind, Faults};
use crate::limits::{Varied, Vary};
use crate::model::Model;
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;
use class::ClassKey;
use evaluate::Evaluator;
use refine::{Grid, Raster};
use serde::Serialize;

/// Pixels of the usual map along each side.
const USUAL_SIZE: usize = 400;
/// Pixels between probes.
const USUAL_PROBE: usize = 8;
/// The most pixels along a side.
pub const GREATEST_SIZE: usize = 8192;

/// Property that the colours of a map show.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum ColourBy {
    /// The number of solutions, and of states with the preload between the faces.
    #[default]
    Solutions,
    /// The set of contact modes that have a solution.
    Modes,
    /// The factor by which all friction may grow before there are no or several solutions.
    Margin,
    /// Whether it moves as in the model, and the other way.
    Jam,
    /// The change of the speed of each coordinate that no drive moves, in each solution.
    Motion,
    /// The effort of the first drive, the least of several solutions.
    Effort,
    /// Whether it can stay at rest, drives absent.
    Hold,
}

impl Choice for ColourBy {
    const CHOICES: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Solutions, "solutions", "The number of solutions"),
        (Self::Modes, "modes", "The set of contact modes that have a solution"),
        (
            Self::Margin,
            "margin",
            "The factor by which all friction may grow before there is no solution or more than one",
        ),
        (Self::Jam, "jam", "Whether it can move as in the model, and in the opposite direction"),
        (
            Self::Motion,
            "motion",
            "What happens: whether it speeds up or slows down, and at rest whether it holds, slides, tips or lifts off",
        ),
        (Self::Effort, "effort", "The force or torque of the first drive, the least of several solutions"),
        (Self::Hold, "hold", "Whether it can stay at rest, its drives absent"),
    ];
}

impl ColourBy {
    /// Returns the name of the property, in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Solutions => "number of solutions",
            Self::Modes => "contact modes that have a solution",
            Self::Margin => "margin of friction",
            Self::Jam => "directions in which it can move",
            Self::Motion => "what becomes of the motion",
            Self::Effort => "effort of the drive",
            Self::Hold => "whether it can stay at rest",
        }
    }
}

/// Options of a map: its two quantities, its size, and the property that its colours show.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MapOptions {
    /// Quantity that varies from left to right; there is no usual range.
    pub x: Vary,
    /// Quantity that varies from bottom to top, likewise.
    pub y: Vary,
    /// Pixels from left to right.
    pub width: usize,
    /// Pixels from bottom to top.
    pub height: usize,
    /// Property that the colours show.
    pub colour_by: ColourBy,
    /// Pixels between probes: narrower regions may be missed. 1 looks at every pixel.
    pub probe: usize,
}

impl MapOptions {
    /// A map of 400 x 400 pixels by the number of solutions, with probes every 8 pixels.
    pub fn new(x: Vary, y: Vary) -> Self {
        Self {
            x,
            y,
            width: USUAL_SIZE,
            height: USUAL_SIZE,
            colour_by: ColourBy::default(),
            probe: USUAL_PROBE,
        }
    }

    /// A map of so many pixels.
    #[must_use]
    pub fn size(mut self, width: usize, height: usize) -> Self {
        (self.width, self.height) = (width, height);
        self
    }

    /// With colours that tell something else.
    #[must_use]
    pub fn colour_by(mut self, colour_by: ColourBy) -> Self {
        self.colour_by = colour_by;
        self
    }

    /// With so many pixels between probes.
    #[must_use]
    pub fn probe(mut self, pixels: usize) -> Self {
        self.probe = pixels;
        self
    }
}

/// An axis while the map is computed.
struct Axis {
    varied: Varied,
    range: [f64; 2],
}

impl Axis {
    fn new(model: &Model, vary: &Vary) -> Result<Self, Faults> {
        let varied = vary.at_rest(model)?;
        let range = vary.ends(&varied, || Err(varied.range_needed()))?;
        Ok(Self { varied, range })
    }

    /// The value in the middle of a pixel.
    fn value(&self, pixel: usize, pixels: usize) -> f64 {
        let share = (pixel as f64 + 0.5) / pixels as f64;
        self.range[0] + share * (self.range[1] - self.range[0])
    }
}

/// The map of a model over two of its quantities.
///
/// Every pixel has the class of its middle. Probes are spaced evenly; between probes that agree the plane is
/// filled, where they differ it is divided down to single pixels, and boundaries that were met are followed
/// from pixel to pixel. So a region is missed only if it lies between probes and touches no boundary that was
/// found. Solutions are those of elimination, and of a search where that leaves a pattern in doubt, within the tolerances of
/// [`modes`](crate::modes), not certified as those of `solve`.
///
/// Where the mode problem depends bilinearly on both quantities (friction, preloads, loads), which is tried
/// at a few points, its numbers are interpolated, else the mechanism is assembled at every point, from the
/// positions of neighbouring points.
///
/// # Errors
/// An unknown name, an empty or reversed range, the same quantity twice, one on which nothing depends, efforts of
/// a model without drives. That a
/// point cannot be assembled or solved is no error, as it has a class of its own, unless there is no other
/// class.
pub fn map(model: &Model, options: &MapOptions) -> Result<MapReport, Faults> {
    undisturbed(|work| map_of(model, options, work))
}

/// [`map`] with a callback that is called now and then, by any thread; nothing if it breaks.
///
/// # Errors
/// As [`map`].
pub fn map_with(
    model: &Model,
    options: &MapOptions,
    callback: &mut Callback<'_>,
) -> Result<Option<MapReport>, Faults> {
    watched(callback, |work| map_of(model, options, work))
}

fn map_of(model: &Model, options: &MapOptions, work: Work<'_>) -> Result<MapReport, Faults> {
    let axes = axes(model, options)?;
    let [width, height] = [options.width, options.height].map(|size| size.clamp(1, GREATEST_SIZE));
    let evaluator = Evaluator::new(model, &axes, options.colour_by, work)?;
    let values = |&[i, j]: &[usize; 2]| [axes[0].value(i, width), axes[1].value(j, height)];
    let classes = |points: &[[usize; 2]]| evaluator.classes(points.iter().map(values), work);
    let grid = Grid { width, height, probe: options.probe.max(1) };
    let raster = Raster::<ClassKey>::new(grid, &classes, &mut |progress| work.tell(progress));
    let Some(raster) = raster else { return Ok(MapReport::default()) };
    let is_answer = |class: &ClassKey| !matches!(class.0, ClassMeaning::NotSolved { .. });
    if !raster.classes.iter().any(is_answer) {
        return Err(evaluator.no_answer(raster.classes.iter(), work));
    }
    finite(report::report((model, options), &axes, &evaluator, &raster, work))
}

fn axes(model: &Model, options: &MapOptions) -> Result<[Axis; 2], Faults> {
    let mut faults = Faults::default();
    let mut axis = |vary: &Vary| Axis::new(model, vary).map_err(|found| faults.append(found)).ok();
    let both = (axis(&options.x), axis(&options.y));
    let (Some(x), Some(y)) = both else { return Err(faults) };
    if x.varied.name == y.varied.name {
        let kind = FaultKind::SameAxes { what: x.varied.in_words() };
        return Err(Fault::general(kind).into());
    }
    Ok([x, y])
}
