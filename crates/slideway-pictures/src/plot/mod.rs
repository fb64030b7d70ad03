//! Plots: curves over an axis, with asymptotes, hatched intervals and coloured bands, as SVG.
//!
//! A [`Figure`] is plain data; [`to_svg`] draws it. Curves are cut at the frame, so that no coordinate lies
//! outside of the picture; points closer to a line between their neighbours than a twentieth of a pixel are
//! left out. Text stays text. [`drawn`] tells what such a picture shows, for those who draw it by other means.
//!
//! ```
//! use slideway_pictures::plot::{Axis, Branch, Curve, Figure, Panel, Stroke, to_svg};
//! use slideway_pictures::theme::LIGHT;
//!
//! let points = (0..=100).map(|step| f64::from(step) / 100.0).map(|x| [x, x * x]).collect();
//! let figure = Figure {
//!     title: "A parabola".to_owned(),
//!     branches: vec![Branch { name: "y = x^2".to_owned(), colour: 0, stroke: Stroke::Solid }],
//!     panels: vec![Panel {
//!         x: Axis { name: "x".to_owned(), unit: "m".to_owned(), range: Some([0.0, 1.0]), ..Axis::default() },
//!         y: Axis { name: "y".to_owned(), unit: "m^2".to_owned(), ..Axis::default() },
//!         curves: vec![Curve { branch: 0, quantity: 0, points, ends: Default::default() }],
//!         ..Panel::default()
//!     }],
//!     ..Figure::default()
//! };
//! assert!(to_svg(&figure, &LIGHT)?.contains("x in m"));
//! # Ok::<(), slideway_pictures::NotFinite>(())
//! ```

pub(crate) mod clip;
mod colours;
mod drawn;
mod drive;
pub(crate) mod figure;
mod flags;
pub(crate) mod frame;
mod legend;
mod limits;
mod markers;
mod overlap;
mod panel;
mod samples;
pub(crate) mod scale;
mod size;
pub(crate) mod svg;
mod sweep;

pub use drawn::{DrawnArrow, DrawnExit, DrawnFlag, DrawnLine, DrawnPanel, LegendEntry, drawn};
pub use drive::drive_figure;
pub use figure::{
    Axis, Band, Bar, Branch, Curve, End, Figure, Hatching, MarkedPoint, MarkedValue, Panel, PointKind,
    Stroke, Zone,
};
pub use legend::LegendSample;
pub use limits::limits_figure;
pub use samples::{SamplesPart, SamplesPlot};
pub use size::size_figure;
pub use sweep::{Extract, Extractor, SweepPlot};

use crate::NotFinite;
use crate::theme::{DASHES, Theme};
use legend::Legend;
use panel::PanelLayout;
use svg::{Svg, coordinate, wrapped};

/// Width of a figure (px).
const WIDTH: f64 = 800.0;
/// Height of the frame of a single panel, of each of a few, and of each of more than those (px).
const SINGLE_HEIGHT: f64 = 380.0;
const STACKED_HEIGHT: f64 = 300.0;
const FEW: usize = 3;
const LOW_HEIGHT: f64 = 200.0;
const ONLY_BANDS: f64 = 24.0;
/// Space around everything (px).
pub(crate) const MARGIN: f64 = 14.0;
/// Font sizes (px).
pub(crate) const TITLE: f64 = 17.0;
const TEXT: f64 = 14.0;
pub(crate) const SMALL: f64 = 13.0;
/// Width of curves (px).
const CURVE: f64 = 2.2;
/// Between the legend of a panel and the next panel (px).
const BETWEEN: f64 = 14.0;

/// The dash pattern of a stroke; empty for a solid line.
fn dashes(stroke: Stroke) -> &'static str {
    match stroke {
        Stroke::Solid => DASHES[0],
        Stroke::Dashed => DASHES[1],
        Stroke::Dotted => DASHES[2],
        Stroke::DashDotted => DASHES[3],
    }
}

/// The figure as an SVG document.
///
/// The same figure gives the same bytes. Elements have classes: `title`, `panel`, `frame`, `grid`, `tick`,
/// `axis`, `curve` and `coincident` (with `data-branch` and `data-quantity`), `end`, `cut` (an arrowhead where a
/// curve leaves the frame), `direction`, `marker`, `point`, `marked` and `asymptote` (with `data-at`), `flag`,
/// `zone`, `band`, `bar`, `legend`.
///
/// # Errors
/// If a number is too large or too small to be drawn.
pub fn to_svg(figure: &Figure, theme: &Theme) -> Result<String, NotFinite> {
    let mut svg = Svg::default();
    hatchings(&mut svg, theme);
    let mut zones = figure.panels.iter().flat_map(|panel| &panel.zones);
    if zones.any(|zone| zone.hatching == Hatching::Dotted) {
        dots(&mut svg, theme);
    }
    let mut y = MARGIN + TITLE;
    for line in wrapped(&figure.title, TITLE, WIDTH - 2.0 * MARGIN) {
        let attributes = [("class", "title"), ("font-size", &*coordinate(TITLE)), ("fill", theme.ink)];
        svg.label([MARGIN, y], &attributes, &line);
        y += 1.3 * TITLE;
    }
    if !figure.subtitle.is_empty() {
        for line in wrapped(&figure.subtitle, SMALL, WIDTH - 2.0 * MARGIN) {
            let attributes = [("class", "subtitle"), ("font-size", &*coordinate(SMALL)), ("fill", theme.ink)];
            svg.label([MARGIN, y], &attributes, &line);
            y += 1.35 * SMALL;
        }
    }
    y -= SMALL;
    let height = match figure.panels.len() {
        1 => SINGLE_HEIGHT,
        2..=FEW => STACKED_HEIGHT,
        _ => LOW_HEIGHT,
    };
    let space = figure.panels.iter().map(|panel| panel::space_on_the_left(figure, panel, height));
    let left = space.fold(0.0, f64::max);
    let mut legend = Legend::default();
    for (index, panel) in figure.panels.iter().enumerate() {
        let top = if index == 0 { y } else { y + BETWEEN };
        // Of panels with the same axis below, the last one names it.
        let is_named = figure.panels.get(index + 1).is_none_or(|next| next.x != panel.x);
        let sides = [MARGIN + left, WIDTH - MARGIN];
        // Of bands alone the frame needs no height.
        let is_empty = panel.curves.is_empty() && panel.bars.is_empty() && panel.points.is_empty();
        let height = if is_empty && !panel.bands.is_empty() { ONLY_BANDS } else { height };
        let layout = PanelLayout::new((figure, panel), sides, (top, height), is_named);
        layout.draw(theme, &mut svg);
        legend = if figure.one_legend {
            legend.with(Legend::of(figure, &layout))
        } else {
            Legend::of(figure, &layout)
        };
        let is_due = !figure.one_legend || index + 1 == figure.panels.len();
        y = layout.bottom() + if is_due { 6.0 } else { 0.0 };
        if is_due {
            y = legend.draw(theme, y, &mut svg);
        }
    }
    svg.document([WIDTH, y + MARGIN], &figure.title, theme.background)
}

/// The patterns of hatched intervals.
pub(crate) fn hatchings(svg: &mut Svg, theme: &Theme) {
    svg.open("defs", &[]);
    for (hatching, angle) in [(Hatching::Rising, "rotate(45)"), (Hatching::Falling, "rotate(-45)")] {
        let attributes = [
            ("id", hatching_name(hatching)),
            ("width", "8"),
            ("height", "8"),
            ("patternUnits", "userSpaceOnUse"),
            ("patternTransform", angle),
        ];
        svg.open("pattern", &attributes);
        svg.line(
            [0.0, 0.0],
            [0.0, 8.0],
            &[("stroke", theme.ink), ("stroke-width", "1.8"), ("stroke-opacity", "0.35")],
        );
        svg.close("pattern");
    }
    svg.close("defs");
}

/// The pattern of dotted intervals.
fn dots(svg: &mut Svg, theme: &Theme) {
    svg.open("defs", &[]);
    let attributes = [
        ("id", hatching_name(Hatching::Dotted)),
        ("width", "9"),
        ("height", "9"),
        ("patternUnits", "userSpaceOnUse"),
    ];
    svg.open("pattern", &attributes);
    svg.rectangle([3.0, 3.0, 1.8, 1.8], &[("fill", theme.ink), ("fill-opacity", "0.4")]);
    svg.close("pattern");
    svg.close("defs");
}

fn hatching_name(hatching: Hatching) -> &'static str {
    match hatching {
        Hatching::Rising => "hatching-rising",
        Hatching::Falling => "hatching-falling",
        Hatching::Dotted => "dotted",
    }
}

/// How a pattern is referred to.
pub(crate) fn hatching_fill(hatching: Hatching) -> String {
    format!("url(#{})", hatching_name(hatching))
}
