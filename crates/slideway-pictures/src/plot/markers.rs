//! Markers that tell curves of one branch apart.

use super::svg::{Svg, coordinate};
use std::fmt::Write;

/// Distance of markers along a curve (px).
const SPACING: f64 = 120.0;
/// Half the size of a marker (px).
const SIZE: f64 = 4.2;
/// Corners of the markers that are polygons, in units of their size; the first marker is a circle.
const SHAPES: [&[[f64; 2]]; 5] = [
    &[],
    &[[-0.9, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
    &[[0.0, -1.2], [1.15, 0.9], [-1.15, 0.9]],
    &[[0.0, -1.35], [1.35, 0.0], [0.0, 1.35], [-1.35, 0.0]],
    &[[0.0, 1.2], [1.15, -0.9], [-1.15, -0.9]],
];

/// Places at even distances along a polyline, the first one at `phase` of the distance (0 to 1); the middle
/// of a short one.
pub(super) fn places(points: &[[f64; 2]], phase: f64) -> Vec<[f64; 2]> {
    let lengths: Vec<f64> =
        points.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).collect();
    let whole: f64 = lengths.iter().sum();
    let mut next = if whole < SPACING { whole * (0.3 + 0.4 * phase) } else { SPACING * (0.15 + 0.7 * phase) };
    let mut places = Vec::new();
    let mut passed = 0.0;
    for (pair, length) in points.windows(2).zip(lengths) {
        while next <= passed + length && length > 0.0 {
            let share = (next - passed) / length;
            places.push([
                pair[0][0] + share * (pair[1][0] - pair[0][0]),
                pair[0][1] + share * (pair[1][1] - pair[0][1]),
            ]);
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
    let mut points = String::new();
    for [dx, dy] in shape {
        let _ = write!(points, "{},{} ", coordinate(x + SIZE * dx), coordinate(y + SIZE * dy));
    }
    svg.element("polygon", &[&[("points", points.trim_end())], &style[..]].concat());
}
