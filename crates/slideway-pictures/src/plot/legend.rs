//! The legend below the panels.

use super::figure::{End, Figure, Hatching, Stroke};
use super::svg::{Svg, coordinate, width, wrapped};
use super::{CURVE, MARGIN, SMALL, WIDTH, dashes, hatching_fill, markers};
use crate::theme::Theme;

/// Width of a sample, and its distance from the text (px).
const SAMPLE: f64 = 38.0;
const GAP: f64 = 9.0;
/// Curves stand side by side if there is room for so many.
const COLUMNS: f64 = 3.0;
/// Height of a line (px).
const LINE: f64 = 19.0;

/// What an entry shows beside its text.
enum Sample {
    Curve(usize, Stroke),
    Marker(usize),
    Hatched(Hatching),
    Filled(usize),
    End,
}

/// The entries of a legend.
pub(super) struct Legend {
    entries: Vec<(Sample, String)>,
}

impl Legend {
    /// All that the figure uses.
    pub(super) fn of(figure: &Figure) -> Self {
        let mut entries: Vec<(Sample, String)> = Vec::new();
        for branch in &figure.branches {
            entries.push((Sample::Curve(branch.colour, branch.stroke), branch.name.clone()));
        }
        if figure.quantities.len() > 1 {
            let names = figure.quantities.iter().enumerate();
            entries.extend(names.map(|(index, name)| (Sample::Marker(index), name.clone())));
        }
        let curves = || figure.panels.iter().flat_map(|panel| &panel.curves);
        if curves().any(|curve| curve.ends.contains(&End::Marked)) {
            entries.push((Sample::End, "end of a branch".to_owned()));
        }
        let zones = figure.panels.iter().flat_map(|panel| &panel.zones);
        for zone in zones {
            if !entries.iter().any(|(_, text)| *text == zone.meaning) {
                entries.push((Sample::Hatched(zone.hatching), zone.meaning.clone()));
            }
        }
        for band in figure.panels.iter().flat_map(|panel| &panel.bands) {
            if !entries.iter().any(|(_, text)| *text == band.meaning) {
                entries.push((Sample::Filled(band.colour), band.meaning.clone()));
            }
        }
        Self { entries }
    }

    /// The width of the entries of curves, if several find room side by side; else they have lines of their
    /// own.
    fn column(&self) -> Option<f64> {
        let curves = self.entries.iter().filter(|(sample, _)| matches!(sample, Sample::Curve(..)));
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
            let sample_width = if matches!(sample, Sample::Marker(_) | Sample::End) { 14.0 } else { SAMPLE };
            let lines = wrapped(text, SMALL, WIDTH - 2.0 * MARGIN - sample_width - GAP);
            let text_width = lines.iter().map(|line| width(line, SMALL)).fold(0.0, f64::max);
            let space = sample_width + GAP + text_width;
            let is_curve = matches!(sample, Sample::Curve(..));
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

fn draw_sample(sample: &Sample, [x, y]: [f64; 2], width: f64, theme: &Theme, svg: &mut Svg) {
    let series = |colour: usize| theme.series[colour % theme.series.len()];
    match sample {
        Sample::Curve(colour, stroke) => {
            let thickness = coordinate(CURVE);
            let mut attributes = vec![("stroke", series(*colour)), ("stroke-width", &*thickness)];
            if !dashes(*stroke).is_empty() {
                attributes.push(("stroke-dasharray", dashes(*stroke)));
            }
            svg.line([x, y], [x + width, y], &attributes);
        }
        Sample::Marker(quantity) => {
            markers::draw(*quantity, [x + width / 2.0, y], [theme.ink, theme.background], svg);
        }
        Sample::End => {
            let [x, y] = [x + width / 2.0, y].map(coordinate);
            svg.element("circle", &[("cx", &x), ("cy", &y), ("r", "3.2"), ("fill", theme.ink)]);
        }
        Sample::Hatched(hatching) => {
            let fill = hatching_fill(*hatching);
            svg.rectangle([x, y - 6.0, width, 12.0], &[("fill", theme.muted), ("fill-opacity", "0.10")]);
            svg.rectangle([x, y - 6.0, width, 12.0], &[("fill", &fill), ("stroke", theme.muted)]);
        }
        Sample::Filled(colour) => {
            svg.rectangle([x, y - 6.0, width, 12.0], &[("fill", series(*colour))]);
        }
    }
}
