//! What a figure shows, as plain data.

/// A figure: panels one below the other, with one legend.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    /// Headline.
    pub title: String,
    /// A line below it; may be empty.
    pub subtitle: String,
    /// The panels, from top to bottom.
    pub panels: Vec<Panel>,
    /// What colours and strokes of curves mean, in the order of the legend.
    pub branches: Vec<Branch>,
    /// Names of what several curves of one branch show; told apart by markers if there are several.
    pub quantities: Vec<String>,
}

/// A pair of axes and all that is drawn in them.
#[derive(Debug, Clone, PartialEq, Default)]
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
    /// Curves.
    pub curves: Vec<Curve>,
}

/// An axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Axis {
    /// What it measures.
    pub name: String,
    /// The unit; empty for pure numbers.
    pub unit: String,
    /// From where to where; chosen by [`fitting_range`](super::fitting_range) where absent.
    pub range: Option<[f64; 2]>,
    /// Whether equal distances are equal ratios; the range is positive then.
    pub logarithmic: bool,
}

/// A branch of solutions, a mode, a motion: what has one colour and stroke.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// In the legend.
    pub name: String,
    /// Index into the series of the theme, modulo their number.
    pub colour: usize,
    /// How it is drawn.
    pub stroke: Stroke,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stroke {
    /// What a mechanism can settle on: a solid line.
    Solid,
    /// A threshold, which is not attainable: dashes.
    Dashed,
    /// Between the faces of a contact with preload: dots.
    Dotted,
    /// What attainability says nothing definite about: dashes and dots.
    DashDotted,
}

/// A quantity along a branch.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Index into [`Figure::branches`].
    pub branch: usize,
    /// Index into [`Figure::quantities`].
    pub quantity: usize,
    /// Points in the units of the axes, joined by lines; points that are not finite are left out.
    pub points: Vec<[f64; 2]>,
    /// What its beginning and its end are.
    pub ends: [End; 2],
}

/// The end of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum End {
    /// Nothing to mark: the range ends, or another curve goes on.
    #[default]
    Plain,
    /// Here the branch ends or goes over into another: a dot.
    Marked,
    /// It grows without bound.
    Diverges,
}

/// A vertical line at a value of x.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkedValue {
    /// Where.
    pub at: f64,
    /// Above the frame.
    pub label: String,
    /// Whether curves grow without bound there; a heavier line then.
    pub asymptote: bool,
}

/// A hatched interval of x.
#[derive(Debug, Clone, PartialEq)]
pub struct Zone {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// How it is hatched.
    pub hatching: Hatching,
    /// What it means, for the legend.
    pub meaning: String,
}

/// How an interval is hatched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Hatching {
    /// Lines that rise to the right: no solution.
    Rising,
    /// Lines that fall to the right: no mechanism, no value.
    Falling,
    /// Dots: what is shown was found at single values and is not proven between them.
    Dotted,
}

/// A coloured stretch along the x axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Index into the series of the theme, modulo their number.
    pub colour: usize,
    /// What it means, for the legend.
    pub meaning: String,
}
