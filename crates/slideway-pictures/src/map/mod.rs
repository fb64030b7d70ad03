//! Maps: the plane of two quantities coloured by what its points have in common, as SVG.
//!
//! Regions are polygons along the boundaries of pixels, straightened to within a pixel; neighbours share
//! their boundaries, so that there are no gaps between them.

mod colours;
mod drawn;
mod regions;

pub use drawn::{DrawnClass, DrawnMap, drawn};

use crate::NotFinite;
use crate::changes::changes;
use crate::plot::figure::headline;
use crate::plot::frame::{FrameAxis, Placed, draw_axes};
use crate::plot::svg::{Svg, coordinate, wrapped};
use crate::plot::{MARGIN, SMALL, TITLE, hatching_fill, hatchings};
use crate::theme::Theme;
use colours::{Paint, paint};
use regions::regions;
use slideway::map::{ClassMeaning, MapAxis, MapClass, MapReport};
use slideway::model::Settings;

/// Height of the map (px), and the least and greatest width that its pixels ask for.
const HEIGHT: f64 = 400.0;
const WIDTHS: [f64; 2] = [200.0, 640.0];
/// Width of the legend's texts (px).
const LEGEND: f64 = 300.0;
/// Size of a sample of the legend, distance of lines (px).
const SAMPLE: f64 = 22.0;
const LINE: f64 = 18.0;

/// The map of a model with these settings as an SVG document.
///
/// Elements have classes: `title`, `subtitle`, `frame`, `region` (with `data-class`), `tick`, `axis`, `model` (a cross at
/// the values of the model), `legend`. Pixels of the report need not be pixels of the picture: a map of 1000
/// x 1000 is as large, but finer.
///
/// # Errors
/// If a number is too large or too small to be drawn.
pub fn to_svg(report: &MapReport, settings: &Settings, theme: &Theme) -> Result<String, NotFinite> {
    let mut svg = Svg::default();
    hatchings(&mut svg, theme);
    let mut top = MARGIN + TITLE;
    let width = (HEIGHT * report.x.pixels as f64 / report.y.pixels.max(1) as f64).clamp(WIDTHS[0], WIDTHS[1]);
    let axes = [axis(&report.x), axis(&report.y)];
    let left = MARGIN + axes[1].space_on_the_left(HEIGHT);
    let whole = left + width + 3.0 * MARGIN + SAMPLE + 8.0 + LEGEND;
    let title = headline(report.title.as_deref(), &shown(report));
    let size = coordinate(TITLE);
    let large = [("class", "title"), ("font-size", &*size), ("fill", theme.ink)];
    for line in wrapped(&title, TITLE, whole - 2.0 * MARGIN) {
        svg.label([MARGIN, top], &large, &line);
        top += 1.3 * TITLE;
    }
    let size = coordinate(SMALL);
    let plain = [("class", "subtitle"), ("font-size", &*size), ("fill", theme.ink)];
    let below = [changes(settings), report.remark.clone().unwrap_or_default()];
    let lines = below.iter().flat_map(|text| wrapped(text, SMALL, whole - 2.0 * MARGIN));
    for line in lines.filter(|line| !line.is_empty()) {
        svg.label([MARGIN, top - 0.15 * TITLE], &plain, &line);
        top += LINE;
    }
    let placed = Placed::new(axes, [left, top, left + width, top + HEIGHT]);
    let paints: Vec<Paint> =
        report.classes.iter().map(|class| paint(&report.classes, class, theme)).collect();
    draw_regions(report, &paints, &placed, &mut svg);
    draw_axes(&placed, theme, &mut svg);
    draw_model(report, &placed, theme, &mut svg);
    let end = draw_legend(report, &paints, [left + width + 2.0 * MARGIN, top], theme, &mut svg);
    let bottom = end.max(placed.bottom());
    svg.document([whole, bottom + MARGIN], &title, theme.background)
}

/// Says what the colours show, and over which two quantities.
fn shown(report: &MapReport) -> String {
    format!("{} over {} and {}", report.colour_by.in_words(), report.x.name, report.y.name)
}

/// The axis of a plot, in the unit in which values are to be shown.
fn axis(axis: &MapAxis) -> FrameAxis {
    FrameAxis {
        name: axis.name.clone(),
        unit: axis.unit.clone(),
        range: [axis.from / axis.scale, axis.to / axis.scale],
        logarithmic: false,
    }
}

fn draw_regions(report: &MapReport, paints: &[Paint], placed: &Placed, svg: &mut Svg) {
    let [left, top, right, bottom] = placed.frame();
    let cell = [(right - left) / report.x.pixels as f64, (bottom - top) / report.y.pixels as f64];
    let place = |[i, j]: [f64; 2]| [left + cell[0] * i, bottom - cell[1] * j];
    let classes = report.pixels();
    svg.open("g", &[("class", "regions"), ("stroke-linejoin", "round")]);
    for (class, path) in regions(&classes, report.x.pixels, &place).into_iter().enumerate() {
        let Some(paint) = paints.get(class) else { continue };
        let number = class.to_string();
        // The stroke covers the seams that smoothing leaves between neighbours.
        svg.element(
            "path",
            &[
                ("class", "region"),
                ("data-class", &number),
                ("fill-rule", "evenodd"),
                ("d", &path),
                ("fill", paint.fill),
                ("stroke", paint.fill),
                ("stroke-width", "0.7"),
            ],
        );
        if let Some(hatching) = paint.hatching {
            svg.element(
                "path",
                &[("fill-rule", "evenodd"), ("d", &path), ("fill", &hatching_fill(hatching))],
            );
        }
    }
    svg.close("g");
}

/// A cross at the values of the model, if they lie on the map.
fn draw_model(report: &MapReport, placed: &Placed, theme: &Theme, svg: &mut Svg) {
    let values = [&report.x, &report.y].map(|axis| axis.value / axis.scale);
    let Some([x, y]) = placed.inside(values) else { return };
    for (colour, thickness) in [(theme.background, "4.5"), (theme.ink, "2")] {
        for corner in [[5.0, 5.0], [5.0, -5.0]] {
            let attributes = [
                ("class", "model"),
                ("stroke", colour),
                ("stroke-width", thickness),
                ("stroke-linecap", "round"),
            ];
            svg.line([x - corner[0], y - corner[1]], [x + corner[0], y + corner[1]], &attributes);
        }
    }
}

/// The legend beside the map; returns its lower edge.
fn draw_legend(
    report: &MapReport,
    paints: &[Paint],
    [x, top]: [f64; 2],
    theme: &Theme,
    svg: &mut Svg,
) -> f64 {
    let size = coordinate(SMALL);
    svg.open("g", &[("class", "legend"), ("font-size", &size), ("fill", theme.ink)]);
    let mut y = top + SMALL;
    let all: usize = report.classes.iter().map(|class| class.pixels).sum();
    for (class, paint) in report.classes.iter().zip(paints) {
        let sample = [x, y - 0.85 * SMALL, SAMPLE, SMALL];
        svg.rectangle(sample, &[("fill", paint.fill), ("stroke", theme.muted)]);
        if let Some(hatching) = paint.hatching {
            svg.rectangle(sample, &[("fill", &hatching_fill(hatching))]);
        }
        let text = told(class, all);
        for line in wrapped(&text, SMALL, LEGEND) {
            svg.label([x + SAMPLE + 8.0, y], &[], &line);
            y += LINE;
        }
        y += 0.4 * LINE;
    }
    if draws_model(report) {
        let centre = [x + SAMPLE / 2.0, y - 0.36 * SMALL];
        for corner in [[5.0, 5.0], [5.0, -5.0]] {
            let attributes = [("stroke", theme.ink), ("stroke-width", "2"), ("stroke-linecap", "round")];
            let ends = [-1.0, 1.0].map(|sign| [centre[0] + sign * corner[0], centre[1] + sign * corner[1]]);
            svg.line(ends[0], ends[1], &attributes);
        }
        svg.label([x + SAMPLE + 8.0, y], &[], "the model");
        y += 1.5 * LINE;
    }
    for line in untold_modes(report).iter().flat_map(|mode| wrapped(mode, SMALL, LEGEND + SAMPLE)) {
        svg.label([x, y], &[], &line);
        y += LINE;
    }
    svg.close("g");
    y
}

/// A class in words, with its share of all pixels.
fn told(class: &MapClass, all: usize) -> String {
    format!("{} ({})", entry(class), share(class.pixels, all))
}

/// A class in words: a single mode with its own, of which numbers stay with their signs; several as their
/// signs alone.
fn entry(class: &MapClass) -> String {
    let ClassMeaning::Modes { .. } = &class.meaning else { return class.words.clone() };
    let patterns = signs(&class.words).replace(' ', "\u{a0}").replace("\u{a0}|\u{a0}", " | ");
    match &class.modes[..] {
        [words] => format!("{patterns}: {words}"),
        _ => patterns,
    }
}

/// Returns in words the meanings of the patterns' signs that no class has stated.
fn untold_modes(report: &MapReport) -> Vec<String> {
    let single = report.classes.iter().filter(|class| class.modes.len() == 1);
    let mut known: Vec<String> = single.map(|class| class.words.clone()).collect();
    let mut told = Vec::new();
    for class in &report.classes {
        for (pattern, words) in class.words.split(" | ").zip(&class.modes) {
            if known.iter().any(|other| other == pattern) {
                continue;
            }
            known.push(pattern.to_owned());
            told.push(format!("{}: {words}", signs(pattern).replace(' ', "\u{a0}")));
        }
    }
    told
}

/// A pattern with the signs of mathematics.
fn signs(pattern: &str) -> String {
    pattern.replace('-', "\u{2212}")
}

fn draws_model(report: &MapReport) -> bool {
    [&report.x, &report.y].iter().all(|axis| axis.from <= axis.value && axis.value <= axis.to)
}

/// A share of the area in words.
fn share(pixels: usize, all: usize) -> String {
    let percent = 100.0 * pixels as f64 / all.max(1) as f64;
    if percent < 0.1 {
        "below 0.1\u{a0}% of the map".to_owned()
    } else if percent < 10.0 {
        format!("{percent:.1}\u{a0}% of the map")
    } else {
        format!("{percent:.0}\u{a0}% of the map")
    }
}
