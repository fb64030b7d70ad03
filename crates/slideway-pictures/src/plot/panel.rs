//! One panel of a figure.

use super::clip::{Frame, simplified};
use super::figure::{Axis, Curve, End, Figure, Hatching, Panel, Zone};
use super::flags::{Flag, flags};
use super::frame::{FrameAxis, Placed, draw_axes, draw_grid};
use super::overlap::{Line, lines};
use super::scale::{Scale, extent, fitting_range};
use super::svg::{Svg, coordinate};
use super::{CURVE, SMALL, TEXT, dashes, hatching_fill, markers};
use crate::drawing::number;
use crate::theme::Theme;
use std::fmt::Write;

/// Height of rows of labels and bands (px).
const ROW: f64 = 18.0;
const BAND: f64 = 12.0;
/// Space beside fitted curves, as a share of their extent.
const SPACE_BESIDE: f64 = 0.03;
/// Length of a dash of each colour of a line that stands for several (px).
const DASH: f64 = 9.0;
/// Size of the arrowheads where curves leave the frame (px); heads closer to each other are one.
const HEAD: f64 = 5.0;
/// Curves keep to this distance of their points (px).
const TOLERANCE: f64 = 0.05;
/// Curves coincide where they are not farther apart than both may be from their points (px).
const SAME: f64 = 2.0 * TOLERANCE;
/// Room for the half of the last number of the axis, which is centred at the edge (px).
pub(super) const LAST: f64 = 12.0;

/// A panel with its place in the picture.
pub(super) struct PanelLayout<'f> {
    figure: &'f Figure,
    pub(super) panel: &'f Panel,
    placed: Placed,
    frame: Frame,
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) flags: Vec<Flag<'f>>,
    /// The lines that stand for the curves.
    pub(super) lines: Vec<Line>,
    top: f64,
}

fn y_range(figure: &Figure, panel: &Panel) -> [f64; 2] {
    panel.y.range.unwrap_or_else(|| fitting_range(panel, &figure.branches))
}

/// The horizontal extent of the curves with some space beside them, where the axis has no range.
fn x_range(panel: &Panel) -> [f64; 2] {
    let along = panel.curves.iter().flat_map(|curve| &curve.points).map(|point| point[0]);
    let fitted = extent(along.chain(panel.bars.iter().flat_map(|bar| bar.sides)));
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

fn axes(figure: &Figure, panel: &Panel) -> [FrameAxis; 2] {
    let with = |axis: &Axis, range: [f64; 2]| FrameAxis {
        name: axis.name.clone(),
        unit: axis.unit.clone(),
        range,
        logarithmic: axis.logarithmic && range[0] > 0.0,
    };
    [with(&panel.x, x_range(panel)), with(&panel.y, y_range(figure, panel))]
}

/// Returns the width that the vertical axis needs beside a frame of this height (px).
pub(super) fn space_on_the_left(figure: &Figure, panel: &Panel, height: f64) -> f64 {
    axes(figure, panel)[1].space_on_the_left(height)
}

/// A curve, by its index, that leaves the frame through its lower (0) or upper edge (1) at a place.
pub(super) struct Exit {
    pub(super) curve: usize,
    pub(super) edge: usize,
    pub(super) at: [f64; 2],
}

impl<'f> PanelLayout<'f> {
    /// Between `left` and `right`, below `top`, with a frame of this height, and the name of the horizontal axis or not.
    pub(super) fn new(
        (figure, panel): (&'f Figure, &'f Panel),
        [left, right]: [f64; 2],
        (top, height): (f64, f64),
        is_named: bool,
    ) -> Self {
        let right = right - LAST;
        let axes = axes(figure, panel);
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
        let placed = if is_named { placed } else { placed.without_name() };
        let (frame, y) = (placed.rectangle(), placed.y());
        let mut layout = Self { figure, panel, placed, frame, x, y, flags, lines: Vec::new(), top };
        let parts: Vec<Vec<Vec<[f64; 2]>>> = panel.curves.iter().map(|curve| layout.parts(curve)).collect();
        layout.lines = lines(&panel.curves, &parts, SAME);
        layout
    }

    /// Below its numbers and the name of the axis.
    pub(super) fn bottom(&self) -> f64 {
        self.placed.bottom()
    }

    pub(super) fn draw(&self, theme: &Theme, svg: &mut Svg) {
        svg.open("g", &[("class", "panel")]);
        self.title(theme, svg);
        self.zones(theme, svg);
        draw_grid(&self.placed, theme, svg);
        self.bars(theme, svg);
        self.marked(theme, svg);
        self.lines.iter().for_each(|line| self.line(line, theme, svg));
        // What marks places of curves lies above all of them.
        let several = self.figure.quantities.len() > 1;
        self.lines.iter().filter(|_| several).for_each(|line| self.markers(line, theme, svg));
        self.lines.iter().filter(|_| self.panel.directed).for_each(|line| self.arrows(line, theme, svg));
        self.panel.curves.iter().for_each(|curve| self.ends(curve, theme, svg));
        self.exits().iter().for_each(|exit| self.exit(exit, theme, svg));
        self.points(theme, svg);
        draw_axes(&self.placed, theme, svg);
        self.bands(theme, svg);
        svg.close("g");
    }

    fn title(&self, theme: &Theme, svg: &mut Svg) {
        if !self.panel.title.is_empty() {
            let attributes =
                [("class", "panel-title"), ("font-size", &*coordinate(TEXT)), ("fill", theme.ink)];
            svg.label([self.frame.left, self.top + 10.0 + TEXT], &attributes, &self.panel.title);
        }
    }

    /// The part of an interval that the axis shows.
    fn shown(&self, from: f64, to: f64) -> Option<[f64; 2]> {
        let (from, to) = (from.max(self.x.values[0]), to.min(self.x.values[1]));
        (from < to).then(|| [from, to].map(|value| self.x.place(value)))
    }

    /// The hatched intervals that can be seen.
    pub(super) fn seen_zones(&self) -> impl Iterator<Item = &Zone> {
        let is_seen =
            |zone: &&Zone| self.shown(zone.from, zone.to).is_some_and(|[from, to]| to - from >= 1.0);
        self.panel.zones.iter().filter(is_seen)
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

    fn bars(&self, theme: &Theme, svg: &mut Svg) {
        for bar in &self.panel.bars {
            let ([left, right], [bottom, top]) =
                (bar.sides.map(|side| self.x.place(side)), bar.ends.map(|end| self.y.place(end)));
            let shape = [left, top, right - left, bottom - top];
            let colour = theme.series[bar.colour % theme.series.len()];
            let style = [("class", "bar"), ("fill", colour), ("stroke", theme.background)];
            svg.rectangle(shape, &style);
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

    /// The colour of a branch.
    fn colour(&self, branch: usize, theme: &Theme) -> &'static str {
        let colour = self.figure.branches.get(branch).map_or(0, |branch| branch.colour);
        theme.series[colour % theme.series.len()]
    }

    /// A line; one that stands for several branches has dashes of all their colours.
    fn line(&self, line: &Line, theme: &Theme, svg: &mut Svg) {
        let stroke = self.figure.branches.get(line.branches[0]).map(|branch| dashes(branch.stroke));
        let mut path = String::new();
        for (index, [x, y]) in line.path.iter().enumerate() {
            let letter = if index == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{letter}{} {}", coordinate(*x), coordinate(*y));
        }
        let quantity = self.panel.curves[line.curve].quantity.to_string();
        let several = line.branches.len() > 1;
        for (index, branch) in line.branches.iter().enumerate() {
            let (number, thickness) = (branch.to_string(), coordinate(CURVE));
            let mut attributes = vec![
                ("class", if index == 0 { "curve" } else { "coincident" }),
                ("data-branch", &*number),
                ("data-quantity", &*quantity),
                ("d", &path),
                ("fill", "none"),
                ("stroke", self.colour(*branch, theme)),
                ("stroke-width", &thickness),
                ("stroke-linejoin", "round"),
            ];
            let [pattern, offset] = shared_dashes(index, line.branches.len());
            match stroke {
                // The first colour lies beneath those of the others.
                _ if several && index == 0 => {}
                _ if several => {
                    attributes.extend([("stroke-dasharray", &*pattern), ("stroke-dashoffset", &offset)]);
                }
                Some(stroke) if !stroke.is_empty() => attributes.push(("stroke-dasharray", stroke)),
                _ => {}
            }
            svg.element("path", &attributes);
        }
    }

    /// Places of the markers of a line; those of neighbouring ones are shifted against each other.
    pub(super) fn markers_of(&self, line: &Line) -> Vec<[f64; 2]> {
        let quantity = self.panel.curves[line.curve].quantity;
        let shares = self.figure.quantities.len() as f64;
        let phase = ((quantity as f64 + 0.37 * line.branches[0] as f64) / shares).fract();
        markers::places(&line.path, phase).into_iter().map(|(place, _)| place).collect()
    }

    fn markers(&self, line: &Line, theme: &Theme, svg: &mut Svg) {
        let quantity = self.panel.curves[line.curve].quantity;
        let colour = self.colour(line.branches[0], theme);
        for place in self.markers_of(line) {
            markers::draw(quantity, place, [colour, theme.background], svg);
        }
    }

    /// The values at a place.
    pub(super) fn values(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.value(x), self.y.value(y)]
    }

    /// Arrowheads along a line.
    fn arrows(&self, line: &Line, theme: &Theme, svg: &mut Svg) {
        let colour = self.colour(line.branches[0], theme);
        for (place, along) in markers::places(&line.path, 0.5) {
            markers::head("direction", (place, along), HEAD, colour, svg);
        }
    }

    fn ends(&self, curve: &Curve, theme: &Theme, svg: &mut Svg) {
        let colour = self.colour(curve.branch, theme);
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

    /// Where curves go on above or below the frame; neighbouring exits of one quantity of a branch are one.
    pub(super) fn exits(&self) -> Vec<Exit> {
        let mut exits: Vec<Exit> = Vec::new();
        for (curve, of) in self.panel.curves.iter().enumerate() {
            let places = of.points.iter().map(|[x, y]| [self.x.place(*x), self.y.place(*y)]);
            let places: Vec<[f64; 2]> = places.filter(|[x, y]| x.is_finite() && y.is_finite()).collect();
            for pair in places.windows(2) {
                for [inside, outside] in [[pair[0], pair[1]], [pair[1], pair[0]]] {
                    let Some((edge, at)) = self.frame.exit(inside, outside) else { continue };
                    let is_known = |known: &Exit| {
                        let other = &self.panel.curves[known.curve];
                        (other.branch, other.quantity, known.edge) == (of.branch, of.quantity, edge)
                            && (known.at[0] - at[0]).abs() < 2.0 * HEAD
                    };
                    if !exits.iter().any(is_known) {
                        exits.push(Exit { curve, edge, at });
                    }
                }
            }
        }
        exits
    }

    /// An arrowhead where a curve leaves the frame.
    fn exit(&self, exit: &Exit, theme: &Theme, svg: &mut Svg) {
        let along = if exit.edge == 1 { [0.0, -1.0] } else { [0.0, 1.0] };
        let colour = self.colour(self.panel.curves[exit.curve].branch, theme);
        markers::head("cut", (exit.at, along), HEAD, colour, svg);
    }

    /// Where curves are cut and what they reach beyond, for the legend; none if all of them are shown.
    pub(super) fn cut(&self) -> Option<String> {
        let exits = self.exits();
        let unit = if self.panel.y.unit.is_empty() { "" } else { &format!(" {}", self.panel.y.unit) };
        let mut places = Vec::new();
        let mut reached = Vec::new();
        let mut grows = false;
        for edge in [0, 1] {
            let curves = exits.iter().filter(|exit| exit.edge == edge);
            let curves: Vec<&Curve> = curves.map(|exit| &self.panel.curves[exit.curve]).collect();
            if curves.is_empty() {
                continue;
            }
            places.push(format!("{}{unit}", number(self.y.values[edge])));
            let (unbounded, bounded): (Vec<&Curve>, Vec<&Curve>) =
                curves.into_iter().partition(|curve| curve.ends.contains(&End::Diverges));
            grows |= !unbounded.is_empty();
            let values = bounded.iter().flat_map(|curve| curve.points.iter().map(|point| point[1]));
            reached.extend(extent(values).map(|range| format!("{}{unit}", number(range[edge]))));
        }
        let beyond = [
            grows.then(|| "grows without bound".to_owned()),
            (!reached.is_empty()).then(|| format!("reaches {}", reached.join(" and "))),
        ];
        let beyond: Vec<String> = beyond.into_iter().flatten().collect();
        (!places.is_empty()).then(|| format!("cut at {}: {}", places.join(" and "), beyond.join("; ")))
    }

    fn points(&self, theme: &Theme, svg: &mut Svg) {
        for point in &self.panel.points {
            let place = [self.x.place(point.at[0]), self.y.place(point.at[1])];
            if self.frame.holds(place) {
                markers::point((point.kind, point.part.unwrap_or(1.0)), place, theme, svg);
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

/// The dashes of a colour among several that take turns along a line, and where they begin.
pub(super) fn shared_dashes(index: usize, count: usize) -> [String; 2] {
    let between = DASH * count.saturating_sub(1) as f64;
    [format!("{} {}", coordinate(DASH), coordinate(between)), coordinate(-DASH * index as f64)]
}
