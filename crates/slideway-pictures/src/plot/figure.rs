//! The contents of a figure, as plain data.

use crate::changes::changes;
use serde::Serialize;
use slideway::model::Settings;

/// A figure: panels one below the other, each with its legend.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Figure {
    /// Headline.
    pub title: String,
    /// A line below it; may be empty.
    pub subtitle: String,
    /// The panels, from top to bottom.
    pub panels: Vec<Panel>,
    /// The meanings of the colours and strokes of curves, in the order of the legend.
    pub branches: Vec<Branch>,
    /// Names of what several curves of one branch show; told apart by markers if there are several.
    pub quantities: Vec<String>,
    /// Whether one legend below all panels stands for those of each.
    pub one_legend: bool,
}

impl Figure {
    /// Adds to the figure what was changed in the model: in the line below the headline.
    #[must_use]
    pub fn changed_by(mut self, settings: &Settings) -> Self {
        let changes = changes(settings);
        if !changes.is_empty() {
            let between = if self.subtitle.is_empty() { "" } else { ". " };
            self.subtitle = format!("{changes}{between}{}", self.subtitle);
        }
        self
    }
}

/// The headline of a picture: the title of the model, and what is shown.
pub(crate) fn headline(title: Option<&str>, shown: &str) -> String {
    if let Some(title) = title.filter(|title| !title.is_empty()) {
        return format!("{title}: {shown}");
    }
    let mut letters = shown.chars();
    let first = letters.next().map(|first| first.to_uppercase().to_string()).unwrap_or_default();
    first + letters.as_str()
}

/// A pair of axes and all that is drawn in them.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Panel {
    /// Above the panel; may be empty.
    pub title: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Hatched intervals of x, behind everything.
    pub zones: Vec<Zone>,
    /// Vertical lines with labels above the frame.
    pub marked: Vec<MarkedValue>,
    /// Coloured stretches along the x axis, such as contact modes over time.
    pub bands: Vec<Band>,
    /// Bars that stand side by side or on one another.
    pub bars: Vec<Bar>,
    /// Curves.
    pub curves: Vec<Curve>,
    /// Whether arrowheads on the curves show the order of their points.
    pub directed: bool,
    /// Points that are marked, above the curves.
    pub points: Vec<MarkedPoint>,
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Axis {
    /// The quantity that it measures.
    pub name: String,
    /// The unit; empty for pure numbers.
    pub unit: String,
    /// From where to where; where absent, what the curves ask for but near values at which they grow without bound.
    pub range: Option<[f64; 2]>,
    /// Whether equal distances are equal ratios; the range is positive then.
    pub logarithmic: bool,
}

/// A branch of solutions, a mode, a motion: what has one colour and stroke.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Branch {
    /// In the legend.
    pub name: String,
    /// Index into the series of the theme, modulo their number.
    pub colour: usize,
    /// How it is drawn.
    pub stroke: Stroke,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stroke {
    /// A branch on which a mechanism can settle: a solid line.
    Solid,
    /// A threshold, which is not attainable: dashes.
    Dashed,
    /// Between the faces of a contact with preload: dots.
    Dotted,
    /// A branch of which attainability says nothing definite: dashes and dots.
    DashDotted,
}

/// A quantity along a branch.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curve {
    /// Index into [`Figure::branches`].
    pub branch: usize,
    /// Index into [`Figure::quantities`].
    pub quantity: usize,
    /// Points in the units of the axes, joined by lines; points that are not finite are left out.
    pub points: Vec<[f64; 2]>,
    /// The kinds of its beginning and its end.
    pub ends: [End; 2],
}

/// The end of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Nothing to mark: the range ends, or another curve goes on.
    #[default]
    Plain,
    /// Here the branch ends or goes over into another: a dot.
    Marked,
    /// It grows without bound.
    Diverges,
}

/// A point that is marked.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MarkedPoint {
    /// Where, in the units of the axes.
    pub at: [f64; 2],
    /// The meaning of the point.
    pub kind: PointKind,
    /// Of an impact the energy that it takes, as a part of the greatest of the motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<f64>,
}

/// The meaning of a marked point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PointKind {
    /// A motion begins: a circle.
    Start,
    /// It comes to rest: a square.
    Stop,
    /// It jams: a cross.
    Jam,
    /// It ends in motion: a triangle.
    End,
    /// The values of the model itself: a diagonal cross.
    Model,
    /// An impact: a ring whose area is the energy that it takes.
    Impact,
}

impl PointKind {
    /// For the legend.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Stop => "stops",
            Self::Jam => "jams",
            Self::End => "end, still moving",
            Self::Model => "the model",
            Self::Impact => "impact; area: energy lost",
        }
    }
}

/// A vertical line at a value of x.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MarkedValue {
    /// Where.
    pub at: f64,
    /// Above the frame.
    pub label: String,
    /// Whether curves grow without bound there; a heavier line then.
    pub(crate) asymptote: bool,
}

/// A hatched interval of x.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Zone {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// How it is hatched.
    pub(crate) hatching: Hatching,
    /// Its meaning, for the legend.
    pub meaning: String,
}

/// How an interval is hatched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Hatching {
    /// Lines that rise to the right: no solution.
    Rising,
    /// Lines that fall to the right: no mechanism, no value.
    Falling,
    /// Dots: what is shown was found at single values and is not proven between them.
    Dotted,
}

/// A bar of a histogram.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bar {
    /// Its left and its right side.
    pub(crate) sides: [f64; 2],
    /// Where it stands, and its upper end.
    pub(crate) ends: [f64; 2],
    /// Index into the series of the theme, modulo their number.
    pub(crate) colour: usize,
    /// Its meaning, for the legend.
    pub(crate) meaning: String,
}

/// A coloured stretch along the x axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Band {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Index into the series of the theme, modulo their number.
    pub(crate) colour: usize,
    /// Its meaning, for the legend.
    pub(crate) meaning: String,
}
