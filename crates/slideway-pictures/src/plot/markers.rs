//! Markers that tell curves of one branch apart, arrowheads, and points that are marked.

use super::figure::PointKind;
use super::svg::{Svg, coordinate};
use crate::theme::Theme;
use std::fmt::Write;

/// Distance of markers along a curve (px).
const SPACING: f64 = 120.0;
/// Half the size of a marker (px).
const SIZE: f64 = 4.2;
/// Radius of the ring of the greatest impact, in sizes.
const GREATEST_RING: f64 = 2.5;
/// Corners of the markers that are polygons, in units of their size; the first marker is a circle.
const SHAPES: [&[[f64; 2]]; 5] = [
    &[],
    &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
    &[[0.0, -1.2], [1.15, 0.9], [-1.15, 0.9]],
    &[[0.0, -1.35], [1.35, 0.0], [0.0, 1.35], [-1.35, 0.0]],
    &[[0.0, 1.2], [1.15, -0.9], [-1.15, -0.9]],
];

/// Places at even distances along a polyline with its direction there, the first one at `phase` of the
/// distance (0 to 1); the middle of a short one.
pub(super) fn places(points: &[[f64; 2]], phase: f64) -> Vec<([f64; 2], [f64; 2])> {
    let lengths: Vec<f64> =
        points.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).collect();
    let whole: f64 = lengths.iter().sum();
    let mut next = if whole < SPACING { whole * (0.3 + 0.4 * phase) } else { SPACING * (0.15 + 0.7 * phase) };
    let mut places = Vec::new();
    let mut passed = 0.0;
    for (pair, length) in points.windows(2).zip(lengths) {
        while next <= passed + length && length > 0.0 {
            let share = (next - passed) / length;
            let step = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
            let place = [pair[0][0] + share * step[0], pair[0][1] + share * step[1]];
            places.push((place, step.map(|component| component / length)));
            next += SPACING;
        }
        passed += length;
    }
    places
}

/// Draws the marker of a quantity: its inside like the background, so that crossing curves can be told apart.
pub(super) fn draw(quantity: usize, [x, y]: [f64; 2], [colour, background]: [&str; 2], svg: &mut Svg) {
    let shape = SHAPES[quantity % SHAPES.len()];
    // After a round of shapes they are filled.
    let fill = if (quantity / SHAPES.len()).is_multiple_of(2) { background } else { colour };
    let style = [("class", "marker"), ("fill", fill), ("stroke", colour), ("stroke-width", "1.6")];
    if shape.is_empty() {
        let [x, y, radius] = [x, y, SIZE].map(coordinate);
        svg.element("circle", &[&[("cx", &*x), ("cy", &*y), ("r", &*radius)], &style[..]].concat());
        return;
    }
    let corners = shape.iter().map(|[dx, dy]| [x + SIZE * dx, y + SIZE * dy]);
    svg.element("polygon", &[&[("points", &*corners_in_words(corners))], &style[..]].concat());
}

fn corners_in_words(corners: impl Iterator<Item = [f64; 2]>) -> String {
    let mut words = String::new();
    for [x, y] in corners {
        let _ = write!(words, "{},{} ", coordinate(x), coordinate(y));
    }
    words.truncate(words.trim_end().len());
    words
}

/// An arrowhead with its tip at a place, pointing along a direction of unit length.
pub(super) fn head(
    class: &str,
    ([x, y], [along, across]): ([f64; 2], [f64; 2]),
    size: f64,
    colour: &str,
    svg: &mut Svg,
) {
    let corners = [[0.0, 0.0], [-2.0, 0.9], [-2.0, -0.9]].map(|[forward, aside]| {
        [x + size * (forward * along - aside * across), y + size * (forward * across + aside * along)]
    });
    let corners = corners_in_words(corners.into_iter());
    svg.element("polygon", &[("class", class), ("points", &corners), ("fill", colour)]);
}

/// A marked point; the ring of an impact has this part of the greatest area.
pub(super) fn point((kind, part): (PointKind, f64), [x, y]: [f64; 2], theme: &Theme, svg: &mut Svg) {
    let style = [
        ("class", "point"),
        ("fill", theme.background),
        ("stroke", theme.ink),
        ("stroke-width", "2"),
        ("paint-order", "stroke"),
    ];
    let polygon = |shape: &[[f64; 2]], fill: &'static str, svg: &mut Svg| {
        let corners = corners_in_words(shape.iter().map(|[dx, dy]| [x + SIZE * dx, y + SIZE * dy]));
        svg.element(
            "polygon",
            &[&[("points", &*corners)], &style[..1], &[("fill", fill)], &style[2..]].concat(),
        );
    };
    let circle = |radius: f64, style: &[(&str, &str)], svg: &mut Svg| {
        let [x, y, radius] = [x, y, radius].map(coordinate);
        svg.element("circle", &[&[("cx", &*x), ("cy", &*y), ("r", &*radius)], style].concat());
    };
    match kind {
        PointKind::Start => circle(1.1 * SIZE, &style, svg),
        PointKind::Impact => {
            let ring = [style[0], ("fill", "none"), ("stroke", theme.warning), style[3]];
            circle(GREATEST_RING * SIZE * part.sqrt(), &ring, svg);
        }
        PointKind::Stop => polygon(SHAPES[1], theme.ink, svg),
        PointKind::End => polygon(SHAPES[2], theme.background, svg),
        PointKind::Jam | PointKind::Model => {
            let colour = if kind == PointKind::Jam { theme.warning } else { theme.ink };
            for corner in [[1.2 * SIZE, 1.2 * SIZE], [1.2 * SIZE, -1.2 * SIZE]] {
                let ends = [[x - corner[0], y - corner[1]], [x + corner[0], y + corner[1]]];
                svg.line(ends[0], ends[1], &[style[0], ("stroke", colour), ("stroke-width", "3.2")]);
            }
        }
    }
}
