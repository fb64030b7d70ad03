//! The contents of the panels of a figure in frames of a given size, in the units of their axes: for those
//! who draw a figure by other means than SVG.

use super::figure::Figure;
use super::flags::Flag;
use super::legend::{Legend, LegendSample};
use super::overlap::Line;
use super::panel::{PanelLayout, space_on_the_left};
use super::{MARGIN, SMALL, markers};
use serde::Serialize;

/// The contents of a panel as they are drawn; all else is in the panel itself.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnPanel {
    /// From where to where the horizontal axis goes.
    pub x: [f64; 2],
    /// From where to where the vertical axis goes.
    pub y: [f64; 2],
    /// The curves; those that cannot be told apart are one line.
    pub lines: Vec<DrawnLine>,
    /// The labels of marked values.
    pub flags: Vec<DrawnFlag>,
    /// Where curves go on above or below the frame.
    pub exits: Vec<DrawnExit>,
    /// The legend.
    pub legend: Vec<LegendEntry>,
}

/// A line for one curve or for several.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnLine {
    /// Points in the units of the axes, within the frame.
    pub points: Vec<[f64; 2]>,
    /// The branches that it stands for.
    pub branches: Vec<usize>,
    /// Index into the quantities of the figure.
    pub quantity: usize,
    /// Places of the markers of its quantity, if there are several quantities.
    pub markers: Vec<[f64; 2]>,
    /// Arrowheads that show the order of its points, if the panel has them.
    pub arrows: Vec<DrawnArrow>,
}

/// An arrowhead.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DrawnArrow {
    /// Its tip, in the units of the axes.
    pub at: [f64; 2],
    /// Its direction in the picture, from the right counterclockwise (deg).
    pub angle: f64,
}

/// The label of a marked value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnFlag {
    /// The value.
    pub at: f64,
    /// Its label.
    pub label: String,
    /// Whether curves grow without bound there.
    pub asymptote: bool,
    /// Where the label begins, from the left edge of the frame (px).
    pub left: f64,
    /// The row above the frame in which it stands, from 0.
    pub row: usize,
    /// Whether it stands beside its line, not above it.
    pub beside: bool,
}

/// Where a curve leaves the frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DrawnExit {
    /// Where, in the units of the axes.
    pub at: [f64; 2],
    /// The branch of the curve.
    pub branch: usize,
    /// Whether it goes on above the frame, not below it.
    pub upwards: bool,
}

/// An entry of a legend.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LegendEntry {
    /// The sample beside the text.
    pub sample: LegendSample,
    /// The text.
    pub text: String,
}

/// Returns the contents of the panels of a figure in frames of this width and height, in units of which the
/// small text of the picture has 13.
///
/// ```
/// use slideway_pictures::plot::{Branch, Curve, Figure, Panel, Stroke, drawn};
///
/// let points = vec![[0.0, 0.0], [1.0, 2.0], [2.0, 1.0]];
/// let figure = Figure {
///     branches: vec![Branch { name: "a".to_owned(), colour: 0, stroke: Stroke::Solid }],
///     panels: vec![Panel {
///         curves: vec![Curve { branch: 0, quantity: 0, points: points.clone(), ends: Default::default() }],
///         ..Panel::default()
///     }],
///     ..Figure::default()
/// };
/// let panels = drawn(&figure, [600.0, 400.0]);
/// // The axis begins at zero, with some space below it.
/// assert!(panels[0].y[0] < 0.0 && panels[0].y[1] > 2.0);
/// for (shown, given) in panels[0].lines[0].points.iter().zip(&points) {
///     assert!((shown[0] - given[0]).hypot(shown[1] - given[1]) < 1e-9);
/// }
/// ```
pub fn drawn(figure: &Figure, [width, height]: [f64; 2]) -> Vec<DrawnPanel> {
    let space = figure.panels.iter().map(|panel| space_on_the_left(figure, panel, height));
    let left = MARGIN + space.fold(0.0, f64::max);
    let layout = |panel| {
        PanelLayout::new((figure, panel), [left, left + width + super::panel::LAST], (0.0, height), true)
    };
    figure.panels.iter().map(|panel| drawn_panel(figure, &layout(panel))).collect()
}

fn drawn_panel(figure: &Figure, layout: &PanelLayout<'_>) -> DrawnPanel {
    let exits = layout.exits().into_iter().map(|exit| DrawnExit {
        at: layout.values(exit.at),
        branch: layout.panel.curves[exit.curve].branch,
        upwards: exit.edge == 1,
    });
    let entries = Legend::of(figure, layout).entries.into_iter();
    DrawnPanel {
        x: layout.x.values,
        y: layout.y.values,
        lines: layout.lines.iter().map(|line| drawn_line(figure, layout, line)).collect(),
        flags: layout.flags.iter().map(|flag| drawn_flag(flag, layout.x.places[0])).collect(),
        exits: exits.collect(),
        legend: entries.map(|(sample, text)| LegendEntry { sample, text }).collect(),
    }
}

fn drawn_line(figure: &Figure, layout: &PanelLayout<'_>, line: &Line) -> DrawnLine {
    let arrow = |(at, [right, down]): ([f64; 2], [f64; 2])| DrawnArrow {
        at: layout.values(at),
        angle: (-down).atan2(right).to_degrees(),
    };
    let several = figure.quantities.len() > 1;
    let markers = layout.markers_of(line).into_iter().filter(|_| several);
    let arrows = markers::places(&line.path, 0.5).into_iter().filter(|_| layout.panel.directed);
    DrawnLine {
        points: line.path.iter().map(|place| layout.values(*place)).collect(),
        branches: line.branches.clone(),
        quantity: layout.panel.curves[line.curve].quantity,
        markers: markers.map(|place| layout.values(place)).collect(),
        arrows: arrows.map(arrow).collect(),
    }
}

fn drawn_flag(flag: &Flag<'_>, edge: f64) -> DrawnFlag {
    DrawnFlag {
        at: flag.value.at,
        label: flag.value.label.clone(),
        asymptote: flag.value.asymptote,
        left: flag.text - edge,
        row: flag.row,
        beside: flag.is_beside(SMALL),
    }
}
