//! The legend below a panel.

use super::figure::{Branch, End, Figure, Hatching, PointKind, Stroke};
use super::panel::{PanelLayout, shared_dashes};
use super::svg::{Svg, coordinate, width, wrapped};
use super::{CURVE, MARGIN, SMALL, WIDTH, dashes, hatching_fill, markers};
use crate::theme::Theme;
use serde::Serialize;

/// Width of a sample, and its distance from the text (px).
const SAMPLE: f64 = 38.0;
const GAP: f64 = 9.0;
/// The ring of an impact in a legend, as a part of the greatest.
const IN_LEGEND: f64 = 0.3;
/// Curves stand side by side if there is room for so many.
const COLUMNS: f64 = 3.0;
/// Height of a line (px).
const LINE: f64 = 19.0;

/// The sample of an entry, beside its text. Colours are indices into the series of the theme, modulo their
/// number.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", content = "value", rename_all = "snake_case")]
pub enum LegendSample {
    /// A line of a colour and stroke.
    Curve(usize, Stroke),
    /// Curves of these colours that cannot be told apart.
    Several(Vec<usize>),
    /// The marker of a quantity.
    Marker(usize),
    /// A hatched area.
    Hatched(Hatching),
    /// An area of a colour.
    Filled(usize),
    /// The end of a branch.
    End,
    /// An arrowhead where a curve leaves the frame.
    Cut,
    /// A marked point.
    Point(PointKind),
}

impl LegendSample {
    fn is_curve(&self) -> bool {
        matches!(self, Self::Curve(..) | Self::Several(_))
    }

    fn width(&self) -> f64 {
        match self {
            Self::Marker(_) | Self::End | Self::Cut | Self::Point(_) => 14.0,
            _ => SAMPLE,
        }
    }
}

/// The entries of a legend.
#[derive(Default)]
pub(super) struct Legend {
    pub(super) entries: Vec<(LegendSample, String)>,
}

impl Legend {
    /// All that a panel uses.
    pub(super) fn of(figure: &Figure, layout: &PanelLayout<'_>) -> Self {
        let panel = layout.panel;
        let mut legend = Self { entries: curves(&figure.branches, layout) };
        if figure.quantities.len() > 1 {
            let names = figure.quantities.iter().enumerate();
            let is_used = |quantity| panel.curves.iter().any(|curve| curve.quantity == quantity);
            for (index, name) in names.filter(|(index, _)| is_used(*index)) {
                legend.add(LegendSample::Marker(index), name);
            }
        }
        if panel.curves.iter().any(|curve| curve.ends.contains(&End::Marked)) {
            legend.add(LegendSample::End, "end of a branch");
        }
        let mut kinds: Vec<PointKind> = panel.points.iter().map(|point| point.kind).collect();
        kinds.sort_unstable();
        kinds.into_iter().for_each(|kind| legend.add(LegendSample::Point(kind), kind.words()));
        if let Some(words) = layout.cut() {
            legend.add(LegendSample::Cut, &words);
        }
        layout.seen_zones().for_each(|zone| legend.add(LegendSample::Hatched(zone.hatching), &zone.meaning));
        panel.bars.iter().for_each(|bar| legend.add(LegendSample::Filled(bar.colour), &bar.meaning));
        panel.bands.iter().for_each(|band| legend.add(LegendSample::Filled(band.colour), &band.meaning));
        legend
    }

    /// With the entries of another one, lines before everything else.
    pub(super) fn with(mut self, other: Self) -> Self {
        other.entries.into_iter().for_each(|(sample, text)| self.add(sample, &text));
        self.entries.sort_by_key(|(sample, _)| !sample.is_curve());
        self
    }

    /// Adds an entry; each text has one.
    fn add(&mut self, sample: LegendSample, text: &str) {
        if !self.entries.iter().any(|(_, known)| known == text) {
            self.entries.push((sample, text.to_owned()));
        }
    }

    /// The width of the entries of curves, if several find room side by side; else they have lines of their
    /// own.
    fn column(&self) -> Option<f64> {
        let curves = self.entries.iter().filter(|(sample, _)| sample.is_curve());
        let widest = curves.map(|(_, text)| width(text, SMALL)).fold(0.0, f64::max) + SAMPLE + GAP;
        let columns = (WIDTH - 2.0 * MARGIN + 2.5 * GAP) / (widest + 2.5 * GAP);
        (columns >= COLUMNS).then_some(widest)
    }

    /// Draws it below `top`, entries that share a line from left to right, and returns its lower edge.
    pub(super) fn draw(&self, theme: &Theme, top: f64, svg: &mut Svg) -> f64 {
        let size = coordinate(SMALL);
        svg.open("g", &[("class", "legend"), ("font-size", &size), ("fill", theme.ink)]);
        let (mut x, mut y) = (MARGIN, top + SMALL);
        let column = self.column();
        let mut last_is_curve = false;
        for (index, (sample, text)) in self.entries.iter().enumerate() {
            let sample_width = sample.width();
            let lines = wrapped(text, SMALL, WIDTH - 2.0 * MARGIN - sample_width - GAP);
            let text_width = lines.iter().map(|line| width(line, SMALL)).fold(0.0, f64::max);
            let space = sample_width + GAP + text_width;
            let is_curve = sample.is_curve();
            let goes_on = is_curve == last_is_curve && (!is_curve || column.is_some());
            if index > 0 && (!goes_on || x + column.filter(|_| is_curve).unwrap_or(space) > WIDTH - MARGIN) {
                (x, y) = (MARGIN, y + LINE);
            }
            draw_sample(sample, [x, y - 0.36 * SMALL], sample_width, theme, svg);
            for (row, line) in lines.iter().enumerate() {
                if row > 0 {
                    y += LINE;
                }
                svg.label([x + sample_width + GAP, y], &[], line);
            }
            x += column.filter(|_| is_curve).unwrap_or(space) + 2.5 * GAP;
            last_is_curve = is_curve;
        }
        svg.close("g");
        if self.entries.is_empty() { top } else { y + 2.0 }
    }
}

/// The entries of the lines of a panel: of single branches in the order of the figure, then of those that
/// cannot be told apart. A single one is named by the axis.
fn curves(branches: &[Branch], layout: &PanelLayout<'_>) -> Vec<(LegendSample, String)> {
    let mut sets: Vec<&[usize]> = layout.lines.iter().map(|line| &*line.branches).collect();
    sets.sort_unstable_by_key(|set| (set.len() > 1, *set));
    sets.dedup();
    let is_alone = |branch: usize| sets.contains(&&[branch][..]);
    let entry = |set: &[usize]| match set {
        [one] => {
            (LegendSample::Curve(branches[*one].colour, branches[*one].stroke), branches[*one].name.clone())
        }
        several => {
            // What has an entry of its own is named by what is before its colon, and in brackets behind it: of those
            // that coincide some may be attainable and some not.
            let name = |branch: &usize| match branches[*branch].name.split_once(":\u{a0}") {
                Some((short, words)) if is_alone(*branch) => {
                    let bracket = words.rfind(" (").filter(|_| words.ends_with(')'));
                    format!("{short}{}", bracket.map_or("", |at| &words[at..]))
                }
                _ => branches[*branch].name.clone(),
            };
            let names: Vec<String> = several.iter().map(name).collect();
            let colours = several.iter().map(|branch| branches[*branch].colour).collect();
            (LegendSample::Several(colours), format!("{} coincide at this scale", names.join(" and ")))
        }
    };
    // Stretches of the same branches that differ in their strokes coincide alike.
    let mut entries: Vec<(LegendSample, String)> = Vec::new();
    for (sample, text) in sets.iter().map(|set| entry(set)) {
        if entries.iter().all(|(_, known)| *known != text) {
            entries.push((sample, text));
        }
    }
    if let [(_, name)] = &entries[..]
        && *name == layout.panel.y.name
    {
        return Vec::new();
    }
    entries
}

fn draw_sample(sample: &LegendSample, [x, y]: [f64; 2], width: f64, theme: &Theme, svg: &mut Svg) {
    let series = |colour: usize| theme.series[colour % theme.series.len()];
    match sample {
        LegendSample::Curve(colour, stroke) => {
            let thickness = coordinate(CURVE);
            let mut attributes = vec![("stroke", series(*colour)), ("stroke-width", &*thickness)];
            if !dashes(*stroke).is_empty() {
                attributes.push(("stroke-dasharray", dashes(*stroke)));
            }
            svg.line([x, y], [x + width, y], &attributes);
        }
        LegendSample::Several(colours) => {
            for (index, colour) in colours.iter().enumerate() {
                let [pattern, offset] = shared_dashes(index, colours.len());
                let thickness = coordinate(CURVE);
                let mut attributes = vec![("stroke", series(*colour)), ("stroke-width", &*thickness)];
                if index > 0 {
                    attributes.extend([("stroke-dasharray", &*pattern), ("stroke-dashoffset", &offset)]);
                }
                svg.line([x, y], [x + width, y], &attributes);
            }
        }
        LegendSample::Point(kind) => markers::point((*kind, IN_LEGEND), [x + width / 2.0, y], theme, svg),
        LegendSample::Cut => {
            let tip = [x + width / 2.0, y - 5.0];
            markers::head("cut", (tip, [0.0, -1.0]), 5.0, theme.ink, svg);
        }
        LegendSample::Marker(quantity) => {
            markers::draw(*quantity, [x + width / 2.0, y], [theme.ink, theme.background], svg);
        }
        LegendSample::End => {
            let [x, y] = [x + width / 2.0, y].map(coordinate);
            svg.element("circle", &[("cx", &x), ("cy", &y), ("r", "3.2"), ("fill", theme.ink)]);
        }
        LegendSample::Hatched(hatching) => {
            let fill = hatching_fill(*hatching);
            svg.rectangle([x, y - 6.0, width, 12.0], &[("fill", theme.muted), ("fill-opacity", "0.10")]);
            svg.rectangle([x, y - 6.0, width, 12.0], &[("fill", &fill), ("stroke", theme.muted)]);
        }
        LegendSample::Filled(colour) => {
            svg.rectangle([x, y - 6.0, width, 12.0], &[("fill", series(*colour))]);
        }
    }
}
