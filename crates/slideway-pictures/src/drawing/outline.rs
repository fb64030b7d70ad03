//! Outlines in drawing units: capsules, hulls, rectangles in a turned frame.

use super::scene::Point;
use std::f64::consts::{PI, TAU};

/// Corners of a half circle.
const CORNERS: usize = 10;

/// A frame that is turned against the drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Local {
    pub(super) origin: Point,
    /// Unit vector along the guide.
    pub(super) along: Point,
    /// Unit vector across it, in the direction of positive normal forces.
    pub(super) across: Point,
}

impl Local {
    /// A place given by its local coordinates.
    pub(super) fn at(&self, along: f64, across: f64) -> Point {
        self.origin + self.along * along + self.across * across
    }

    /// The corners of a rectangle.
    pub(super) fn rectangle(&self, [from, to]: [f64; 2], [least, greatest]: [f64; 2]) -> Vec<Point> {
        [(from, least), (to, least), (to, greatest), (from, greatest)]
            .into_iter()
            .map(|(along, across)| self.at(along, across))
            .collect()
    }
}

/// The unit vector of a vector, or another one if it is zero.
pub(super) fn unit(vector: Point, otherwise: Point) -> Point {
    let norm = vector.norm();
    if norm > 1e-9 { vector / norm } else { otherwise }
}

/// A vector turned by a right angle.
pub(super) fn turned(vector: Point) -> Point {
    Point::new(-vector.y, vector.x)
}

/// All places within a distance of a line.
pub(super) fn capsule(from: Point, to: Point, radius: f64) -> Vec<Point> {
    let direction = unit(to - from, Point::x());
    let start = direction.y.atan2(direction.x) - 0.5 * PI;
    let half = |centre: Point, start: f64| {
        (0..=CORNERS).map(move |corner| {
            let angle = start + PI * corner as f64 / CORNERS as f64;
            centre + Point::new(angle.cos(), angle.sin()) * radius
        })
    };
    half(to, start).chain(half(from, start + PI)).collect()
}

/// A disc as a polygon.
pub(super) fn disc(centre: Point, radius: f64) -> Vec<Point> {
    const COUNT: usize = 64;
    (0..COUNT)
        .map(|corner| {
            let angle = TAU * corner as f64 / COUNT as f64;
            centre + Point::new(angle.cos(), angle.sin()) * radius
        })
        .collect()
}

/// The corners of the convex hull (Andrew's monotone chain).
pub(super) fn hull(places: &[Point]) -> Vec<Point> {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
    if sorted.len() < 3 {
        return sorted;
    }
    let chain = |places: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for place in places {
            while let [.., before, last] = chain[..]
                && (last - before).perp(&(place - last)) <= 0.0
            {
                chain.pop();
            }
            chain.push(*place);
        }
        chain.pop();
        chain
    };
    let mut corners = chain(&mut sorted.iter());
    corners.extend(chain(&mut sorted.iter().rev()));
    corners
}

/// Distance of a place from a line between two others, and the nearest place on it.
pub(super) fn nearest_on_line(place: Point, [from, to]: [Point; 2]) -> (f64, Point) {
    let along = to - from;
    let length = along.norm_squared();
    let part = if length > 0.0 { ((place - from).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
    let nearest = from + along * part;
    ((place - nearest).norm(), nearest)
}

/// The side of a guide that is seen as its upper one, or as its right one if it stands upright: 1 in the
/// direction of `across`, else -1.
pub(super) fn upper_side(across: Point) -> f64 {
    let is_upper = if across.y.abs() > 1e-3 { across.y < 0.0 } else { across.x > 0.0 };
    if is_upper { 1.0 } else { -1.0 }
}

/// The part of a convex polygon within another one (Sutherland and Hodgman's clipping).
pub(super) fn clipped(polygon: &[Point], within: &[Point]) -> Vec<Point> {
    let count = within.len();
    let middle = within.iter().sum::<Point>() / (count.max(1) as f64);
    let mut left = polygon.to_vec();
    for corner in 0..count {
        let [from, to] = [within[corner], within[(corner + 1) % count]];
        let inwards = turned(to - from);
        let inwards = inwards * inwards.dot(&(middle - from)).signum();
        let inside = |place: &Point| (place - from).dot(&inwards);
        let mut kept = Vec::new();
        for index in 0..left.len() {
            let [one, next] = [left[index], left[(index + 1) % left.len()]];
            let [of_one, of_next] = [inside(&one), inside(&next)];
            if of_one >= 0.0 {
                kept.push(one);
            }
            if (of_one > 0.0 && of_next < 0.0) || (of_one < 0.0 && of_next > 0.0) {
                kept.push(one + (next - one) * (of_one / (of_one - of_next)));
            }
        }
        left = kept;
    }
    left
}

/// An end of a plate across `local`, from one side to the other; a zigzag where the plate is torn off.
pub(super) fn edge(local: &Local, along: f64, is_torn: bool, half: f64) -> Vec<Point> {
    const TOOTH: f64 = 9.0;
    const DEPTH: f64 = 4.0;
    if !is_torn {
        return vec![local.at(along, -half), local.at(along, half)];
    }
    let count = (2.0 * half / TOOTH).ceil().clamp(3.0, 200.0);
    let mut corners = vec![local.at(along, -half)];
    let (mut tooth, mut side) = (0.5, DEPTH);
    while tooth < count {
        corners.push(local.at(along + side, half * (2.0 * tooth / count - 1.0)));
        (tooth, side) = (tooth + 1.0, -side);
    }
    corners.push(local.at(along, half));
    corners
}

/// From where to where an outline reaches along the axis of a frame; nothing if that does not cross it.
pub(super) fn reach_along(outline: &[Point], local: &Local) -> Option<[f64; 2]> {
    let next = outline.iter().cycle().skip(1);
    let crossings = outline.iter().zip(next).filter_map(|(from, to)| {
        let [before, after] = [from, to].map(|corner| (corner - local.origin).dot(&local.across));
        if (before > 0.0) == (after > 0.0) {
            return None;
        }
        let crossing = from + (to - from) * (before / (before - after));
        Some([(crossing - local.origin).dot(&local.along); 2])
    });
    crossings.reduce(|[least, greatest], [other, _]| [least.min(other), greatest.max(other)])
}
