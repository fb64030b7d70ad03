//! Bars behind other bodies: their edges are dashed there.

use super::Painter;
use super::scene::{Class, Point, Shape};
use std::f64::consts::TAU;

/// Distance of the places of an edge that are looked at.
const STEP: f64 = 2.0;

/// The outline of a bar, with what else belongs to its body, and how many shapes are drawn before what may hide it.
pub(super) struct Bar {
    pub(super) outline: Vec<Point>,
    pub(super) others: Vec<Vec<Point>>,
    pub(super) before: usize,
}

impl Painter<'_> {
    /// Dashes the edges of bars where bodies are drawn in front of them; not where hardly more than a rounded end is hidden,
    /// as at every hinge.
    pub(super) fn hidden_edges(&mut self, bars: &[Bar]) {
        let least = TAU * super::slide::BAR;
        let lines: Vec<Vec<Point>> = bars.iter().flat_map(|bar| self.hidden_parts(bar)).collect();
        lines
            .into_iter()
            .filter(|line| length(line) > least)
            .for_each(|line| self.line(Class::HiddenWall, line));
    }

    fn hidden_parts(&self, bar: &Bar) -> Vec<Vec<Point>> {
        let covers = self.scene.elements[bar.before..].iter().filter_map(|element| match &element.shape {
            Shape::Area(corners) if matches!(element.class, Class::Body | Class::Slot) => Some(corners),
            _ => None,
        });
        let covers: Vec<&Vec<Point>> = covers.collect();
        let is_hidden = |place: &Point| {
            covers.iter().any(|cover| holds(cover, *place))
                && !bar.others.iter().any(|other| holds(other, *place))
        };
        let places = places(&bar.outline);
        let hidden: Vec<bool> = places.iter().map(is_hidden).collect();
        // The way round begins where the bar is seen.
        let start = hidden.iter().position(|hidden| !hidden).unwrap_or(0);
        let order = (0..=places.len()).map(|index| (start + index) % places.len().max(1));
        let mut parts: Vec<Vec<Point>> = vec![Vec::new()];
        for index in order.filter(|index| *index < places.len()) {
            match parts.last_mut() {
                Some(part) if hidden[index] => part.push(places[index]),
                Some(part) if part.is_empty() => {}
                _ => parts.push(Vec::new()),
            }
        }
        parts
    }
}

/// Places along a closed line.
fn places(outline: &[Point]) -> Vec<Point> {
    let next = outline.iter().cycle().skip(1);
    let between = |(from, to): (&Point, &Point)| {
        let count = ((to - from).norm() / STEP).ceil().clamp(1.0, 1000.0);
        let (from, to) = (*from, *to);
        std::iter::successors(Some(0.0), move |step| Some(step + 1.0).filter(|step| *step < count))
            .map(move |step| from.lerp(&to, step / count))
    };
    outline.iter().zip(next).flat_map(between).collect()
}

fn length(line: &[Point]) -> f64 {
    line.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum()
}

/// Whether a place lies in a polygon: a ray from it crosses the edges an odd number of times.
fn holds(polygon: &[Point], place: Point) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crosses = |(from, to): &(&Point, &Point)| {
        (from.y > place.y) != (to.y > place.y)
            && place.x < from.x + (to.x - from.x) * (place.y - from.y) / (to.y - from.y)
    };
    polygon.iter().zip(next).filter(crosses).count() % 2 == 1
}
