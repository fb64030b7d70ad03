//! One panel of a figure.

use super::clip::{Frame, simplified};
use super::figure::{Axis, Curve, End, Figure, Hatching, Panel, Stroke};
use super::flags::{Flag, flags};
use super::frame::{FrameAxis, Placed, draw_axes, draw_grid};
use super::overlap::runs_along;
use super::scale::{Scale, fitting_range};
use super::svg::{Svg, coordinate};
use super::{BORDER, CURVE, SMALL, TEXT, dashes, hatching_fill, markers};
use crate::theme::Theme;
use std::fmt::Write;

/// Height of rows of labels and bands (px).
const ROW: f64 = 18.0;
const BAND: f64 = 12.0;
/// Space beside fitted curves, as a share of their extent.
const SPACE_BESIDE: f64 = 0.03;
/// A piece of a curve that is shorter may lie within a crossing with another (px).
const SHORT: f64 = 48.0;
/// Curves keep to this distance of their points (px).
const TOLERANCE: f64 = 0.05;

/// A panel with its place in the picture.
pub(super) struct PanelLayout<'f> {
    panel: &'f Panel,
    placed: Placed,
    frame: Frame,
    x: Scale,
    y: Scale,
    flags: Vec<Flag<'f>>,
    top: f64,
}

fn y_range(panel: &Panel) -> [f64; 2] {
    panel.y.range.unwrap_or_else(|| fitting_range(panel))
}

/// The horizontal extent of the curves with some space beside them, where the axis has no range.
fn x_range(panel: &Panel) -> [f64; 2] {
    let all = panel.curves.iter().flat_map(|curve| &curve.points).map(|point| point[0]);
    let fitted = all.filter(|x| x.is_finite()).fold(None, |range: Option<[f64; 2]>, x| {
        Some(range.map_or([x, x], |[least, greatest]| [least.min(x), greatest.max(x)]))
    });
    match (panel.x.range, fitted) {
        (Some(range), _) if range[0] < range[1] => range,
        (None, Some([from, to])) if from < to => {
            let space = SPACE_BESIDE * (to - from);
            [from - space, to + space]
        }
        (Some([at, _]), _) | (None, Some([at, _])) => [at - 0.5, at + 0.5],
        (None, None) => [0.0, 1.0],
    }
}

/// The length of visible parts.
fn length(parts: &[Vec<[f64; 2]>]) -> f64 {
    let pairs = parts.iter().flat_map(|part| part.windows(2));
    pairs.map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum()
}

fn axes(panel: &Panel) -> [FrameAxis; 2] {
    let with = |axis: &Axis, range: [f64; 2]| FrameAxis {
        name: axis.name.clone(),
        unit: axis.unit.clone(),
        range,
        logarithmic: axis.logarithmic && range[0] > 0.0,
    };
    [with(&panel.x, x_range(panel)), with(&panel.y, y_range(panel))]
}

/// What the vertical axis needs beside the frame (px).
pub(super) fn space_on_the_left(panel: &Panel) -> f64 {
    axes(panel)[1].space_on_the_left(super::STACKED_HEIGHT)
}

impl<'f> PanelLayout<'f> {
    /// Between `left` and `right`, below `top`, with a frame of this height.
    pub(super) fn new(panel: &'f Panel, [left, right]: [f64; 2], top: f64, height: f64) -> Self {
        // The last number of the axis is centred at the edge.
        let right = right - 12.0;
        let axes = axes(panel);
        let values = axes[0].range;
        let x = axes[0].scale([left, right]);
        let inside = |at: f64| values[0] <= at && at <= values[1];
        let marked = panel.marked.iter().filter(|value| inside(value.at));
        let flags = flags(marked.map(|value| (x.place(value.at), value)).collect(), right + 10.0, SMALL);
        let rows = flags.iter().map(|flag| flag.row + 1).max().unwrap_or(0);
        let title = if panel.title.is_empty() { 0.0 } else { 1.6 * TEXT };
        let frame_top = top + 10.0 + title + ROW * rows as f64 + if rows > 0 { 4.0 } else { 0.0 };
        let below = if panel.bands.is_empty() { 0.0 } else { BAND + 4.0 };
        let placed = Placed::new(axes, [left, frame_top, right, frame_top + height]).with_space_below(below);
        Self { panel, frame: placed.rectangle(), x, y: placed.y(), placed, flags, top }
    }

    /// Below its numbers and the name of the axis.
    pub(super) fn bottom(&self) -> f64 {
        self.placed.bottom()
    }

    pub(super) fn draw(&self, figure: &Figure, theme: &Theme, svg: &mut Svg) {
        svg.open("g", &[("class", "panel")]);
        self.title(theme, svg);
        self.zones(theme, svg);
        draw_grid(&self.placed, theme, svg);
        self.marked(theme, svg);
        let parts: Vec<Vec<Vec<[f64; 2]>>> =
            self.panel.curves.iter().map(|curve| self.parts(curve)).collect();
        let hiding: Vec<Vec<usize>> =
            (0..parts.len()).map(|index| self.hiding(figure, index, &parts)).collect();
        for (index, curve) in self.panel.curves.iter().enumerate() {
            let border = BORDER * self.number_above(index, &hiding, &parts) as f64;
            Self::curve(figure, curve, (&parts[index], CURVE + border), theme, svg);
        }
        // Markers and ends lie above all curves.
        let several = figure.quantities.len() > 1;
        for (index, curve) in self.panel.curves.iter().enumerate() {
            if several {
                self.markers(figure, index, &parts[index], theme, svg);
            }
            self.ends(figure, curve, theme, svg);
        }
        draw_axes(&self.placed, theme, svg);
        self.bands(theme, svg);
        svg.close("g");
    }

    fn title(&self, theme: &Theme, svg: &mut Svg) {
        if !self.panel.title.is_empty() {
            let attributes = [
                ("class", "panel-title"),
                ("font-size", &*coordinate(TEXT)),
                ("font-weight", "bold"),
                ("fill", theme.ink),
            ];
            svg.label([self.frame.left, self.top + 10.0 + TEXT], &attributes, &self.panel.title);
        }
    }

    /// The part of an interval that the axis shows.
    fn shown(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        let (from, to) = (from.max(self.x.values[0]), to.min(self.x.values[1]));
        (from < to).then(|| [from, to].map(|value| self.x.place(value)))
    }

    fn zones(&self, theme: &Theme, svg: &mut Svg) {
        let (top, height) = (self.frame.top, self.frame.bottom - self.frame.top);
        for zone in &self.panel.zones {
            let Some([left, right]) = self.shown(zone.from, zone.to) else { continue };
            let shape = [left, top, right - left, height];
            let fill = hatching_fill(zone.hatching);
            if zone.hatching != Hatching::Dotted {
                svg.rectangle(shape, &[("fill", theme.muted), ("fill-opacity", "0.10")]);
            }
            svg.rectangle(shape, &[("class", "zone"), ("fill", &fill)]);
        }
    }

    fn marked(&self, theme: &Theme, svg: &mut Svg) {
        for flag in &self.flags {
            let Flag { value, x, row, .. } = flag;
            let baseline = self.baseline(*row);
            let (class, stroke_width, dash) =
                if value.asymptote { ("asymptote", "1.5", "10 3 2 3") } else { ("marked", "1", "2 3") };
            let at = format!("{}", value.at);
            // Beside its label, or below it where the picture is too narrow.
            let upper = if flag.is_beside(SMALL) { baseline - 0.8 * SMALL } else { baseline + 3.0 };
            let attributes = [
                ("class", class),
                ("data-at", &*at),
                ("stroke", theme.ink),
                ("stroke-width", stroke_width),
                ("stroke-dasharray", dash),
            ];
            svg.line([*x, self.frame.bottom], [*x, upper], &attributes);
        }
        self.labels(theme, svg);
    }

    /// Labels of marked values, above all lines: one that keeps from the edge of the picture may stand across
    /// lines of others, which its border interrupts.
    fn labels(&self, theme: &Theme, svg: &mut Svg) {
        let size = coordinate(SMALL);
        for Flag { value, text, row, .. } in &self.flags {
            let attributes = [
                ("class", "flag"),
                ("font-size", &*size),
                ("fill", theme.ink),
                ("paint-order", "stroke"),
                ("stroke", theme.background),
                ("stroke-width", "4"),
            ];
            svg.label([*text, self.baseline(*row)], &attributes, &value.label);
        }
    }

    fn baseline(&self, row: usize) -> f64 {
        self.frame.top - 6.0 - ROW * row as f64
    }

    /// The visible parts of a curve, in places.
    fn parts(&self, curve: &Curve) -> Vec<Vec<[f64; 2]>> {
        let place = |[x, y]: &[f64; 2]| [self.x.place(*x), self.y.place(*y)];
        let points: Vec<[f64; 2]> =
            curve.points.iter().map(place).filter(|[x, y]| x.is_finite() && y.is_finite()).collect();
        self.frame.parts(&points).iter().map(|part| simplified(part, TOLERANCE)).collect()
    }

    fn colour(figure: &Figure, curve: &Curve, theme: &Theme) -> &'static str {
        let colour = figure.branches.get(curve.branch).map_or(0, |branch| branch.colour);
        theme.series[colour % theme.series.len()]
    }

    /// The later solid curves of other branches that hide the curve with this index.
    fn hiding(&self, figure: &Figure, index: usize, parts: &[Vec<Vec<[f64; 2]>>]) -> Vec<usize> {
        let branch = self.panel.curves[index].branch;
        let hides = |&above: &usize| {
            let other = self.panel.curves[above].branch;
            let stroke = figure.branches.get(other).map(|branch| branch.stroke);
            let is_solid = stroke.is_none_or(|stroke| stroke == Stroke::Solid);
            other != branch && is_solid && runs_along(&parts[index], &parts[above], CURVE)
        };
        (index + 1..parts.len()).filter(hides).collect()
    }

    /// How many curves hide the curve with this index: it is drawn wider, so that it shows on both sides of
    /// them. A short piece counts only if most of its branch is hidden by theirs: it may lie within a mere
    /// crossing.
    fn number_above(&self, index: usize, hiding: &[Vec<usize>], parts: &[Vec<Vec<[f64; 2]>>]) -> usize {
        let curves = &self.panel.curves;
        let is_same = |one: usize, other: usize| {
            (curves[one].branch, curves[one].quantity) == (curves[other].branch, curves[other].quantity)
        };
        let mostly_hidden = |above: usize| {
            let pieces = (0..curves.len()).filter(|&piece| is_same(piece, index));
            let (hidden, all) = pieces.fold((0.0, 0.0), |(hidden, all), piece| {
                let length = length(&parts[piece]);
                let is_hidden = hiding[piece].iter().any(|&other| is_same(other, above));
                (hidden + if is_hidden { length } else { 0.0 }, all + length)
            });
            2.0 * hidden >= all
        };
        let is_long = length(&parts[index]) >= SHORT;
        hiding[index].iter().filter(|&&above| is_long || mostly_hidden(above)).count().min(3)
    }

    /// One curve, by its visible parts and its width.
    fn curve(
        figure: &Figure,
        curve: &Curve,
        (parts, width): (&[Vec<[f64; 2]>], f64),
        theme: &Theme,
        svg: &mut Svg,
    ) {
        let stroke =
            figure.branches.get(curve.branch).map(|branch| dashes(branch.stroke)).unwrap_or_default();
        let (branch, quantity) = (curve.branch.to_string(), curve.quantity.to_string());
        for part in parts {
            let mut path = String::new();
            for (index, [x, y]) in part.iter().enumerate() {
                let letter = if index == 0 { 'M' } else { 'L' };
                let _ = write!(path, "{letter}{} {}", coordinate(*x), coordinate(*y));
            }
            let thickness = coordinate(width);
            let mut attributes = vec![
                ("class", "curve"),
                ("data-branch", &*branch),
                ("data-quantity", &*quantity),
                ("d", &path),
                ("fill", "none"),
                ("stroke", Self::colour(figure, curve, theme)),
                ("stroke-width", &thickness),
                ("stroke-linejoin", "round"),
            ];
            if !stroke.is_empty() {
                attributes.push(("stroke-dasharray", stroke));
            }
            svg.element("path", &attributes);
        }
    }

    /// Markers of the curve with this index; those of neighbouring curves are shifted against each other.
    fn markers(&self, figure: &Figure, index: usize, parts: &[Vec<[f64; 2]>], theme: &Theme, svg: &mut Svg) {
        let curve = &self.panel.curves[index];
        let colour = Self::colour(figure, curve, theme);
        let shares = figure.quantities.len() as f64;
        let phase = ((curve.quantity as f64 + 0.37 * curve.branch as f64) / shares).fract();
        for part in parts {
            for place in markers::places(part, phase) {
                markers::draw(curve.quantity, place, [colour, theme.background], svg);
            }
        }
    }

    fn ends(&self, figure: &Figure, curve: &Curve, theme: &Theme, svg: &mut Svg) {
        let colour = Self::colour(figure, curve, theme);
        for (end, point) in curve.ends.iter().zip([curve.points.first(), curve.points.last()]) {
            let (End::Marked, Some([x, y])) = (end, point) else { continue };
            let place = [self.x.place(*x), self.y.place(*y)];
            if self.frame.holds(place) {
                let [x, y] = place.map(coordinate);
                svg.element(
                    "circle",
                    &[("class", "end"), ("cx", &x), ("cy", &y), ("r", "3.2"), ("fill", colour)],
                );
            }
        }
    }

    fn bands(&self, theme: &Theme, svg: &mut Svg) {
        for band in &self.panel.bands {
            let Some([left, right]) = self.shown(band.from, band.to) else { continue };
            let colour = theme.series[band.colour % theme.series.len()];
            let shape = [left, self.frame.bottom + 3.0, right - left, BAND];
            svg.rectangle(shape, &[("class", "band"), ("fill", colour)]);
        }
    }
}
