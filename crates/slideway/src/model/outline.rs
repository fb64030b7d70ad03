//! Outlines of bodies: straight lines and parts of circles, for looks.

use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Greatest angle (rad) of a straight piece by which an arc is drawn: it keeps within 0.4 % of the radius.
const PIECE: f64 = TAU / 36.0;
/// An angle that is greater than some pieces by no more than this part of a piece is rounding.
const ROUNDING: f64 = 1e-9;
/// Nodes and weights of Gaussian quadrature from 0 to 1 with four values (Abramowitz and Stegun, table 25.4).
const GAUSS: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_71, 0.173_927_422_568_726_9],
    [0.330_009_478_207_571_9, 0.326_072_577_431_273_1],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_1],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_9],
];

/// A corner of an outline, and what leads to the next one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutlineCorner<P> {
    /// Where it is.
    pub at: P,
    /// A place on the arc to the next corner, or the first after the last one; without it a straight line leads
    /// there.
    pub arc_through: Option<P>,
}

impl<P> OutlineCorner<P> {
    /// Returns the corner with its places in another form.
    pub(crate) fn map<Q>(&self, place: impl Fn(&P) -> Q) -> OutlineCorner<Q> {
        OutlineCorner { at: place(&self.at), arc_through: self.arc_through.as_ref().map(place) }
    }
}

/// The corners of a polygon that follows an outline, its arcs in straight pieces of at most 10 degrees.
pub fn polygon(outline: &[OutlineCorner<Vector2<f64>>]) -> Vec<Vector2<f64>> {
    let steps = |piece: Piece| {
        let count = piece.steps();
        shares(count).map(move |share| piece.at(share)[0])
    };
    pieces(outline).flat_map(steps).collect()
}

/// The area within an outline, positive counter-clockwise; the first moments and the polar second moment of that
/// area about the origin: A = 1/2 loop (p x dp), S = 1/3 loop p (p x dp), J = 1/4 loop |p|^2 (p x dp), by Green's
/// theorem.
pub(crate) fn moments(outline: &[OutlineCorner<Vector2<f64>>]) -> (f64, Vector2<f64>, f64) {
    let (mut area, mut first, mut polar) = (0.0, Vector2::zeros(), 0.0);
    for piece in pieces(outline) {
        let count = piece.steps();
        for (start, [node, weight]) in shares(count).flat_map(|start| GAUSS.map(|gauss| (start, gauss))) {
            let [place, step] = piece.at(start + node / count);
            let swept = place.perp(&step) * (weight / count);
            area += swept / 2.0;
            first += place * (swept / 3.0);
            polar += place.norm_squared() * (swept / 4.0);
        }
    }
    (area, first, polar)
}

/// Line or arc from one corner to the next.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    from: Vector2<f64>,
    to: Vector2<f64>,
    /// The vector from the centre of an arc to its beginning, and its angle, positive counter-clockwise.
    arc: Option<(Vector2<f64>, f64)>,
}

fn pieces(outline: &[OutlineCorner<Vector2<f64>>]) -> impl Iterator<Item = Piece> {
    let next = outline.iter().cycle().skip(1).map(|corner| corner.at);
    outline.iter().zip(next).map(|(corner, to)| Piece::new(corner, to))
}

/// The arc through three places; none where they lie on a line. With a = through - from, b = to - from its centre is
/// from + (|b|^2 a - |a|^2 b) turned by 90 degrees / (2 a x b).
fn arc([from, through, to]: [Vector2<f64>; 3]) -> Option<(Vector2<f64>, f64)> {
    let (a, b) = (through - from, to - from);
    let along = a * b.norm_squared() - b * a.norm_squared();
    let arm = Vector2::new(along.y, -along.x) / (2.0 * a.perp(&b));
    let [start, end] = [arm, to - from + arm];
    let turn = start.perp(&end).atan2(start.dot(&end));
    let angle = if a.perp(&b) > 0.0 { turn.rem_euclid(TAU) } else { -(-turn).rem_euclid(TAU) };
    (arm.iter().all(|part| part.is_finite()) && angle.is_finite()).then_some((arm, angle))
}

impl Piece {
    /// From a corner to the next one.
    pub(crate) fn new(corner: &OutlineCorner<Vector2<f64>>, to: Vector2<f64>) -> Self {
        let arc = corner.arc_through.and_then(|through| arc([corner.at, through, to]));
        Self { from: corner.at, to, arc }
    }

    /// The distance of a place from the circle of an arc, or from the line through both ends.
    pub(crate) fn distance(&self, place: Vector2<f64>) -> f64 {
        let way = place - self.from;
        if let Some((arm, _)) = self.arc {
            // |way + arm| - |arm| without cancellation where the arc is nearly straight.
            return (way.dot(&(way + 2.0 * arm)) / ((way + arm).norm() + arm.norm())).abs();
        }
        let line = self.to - self.from;
        if line.norm() > 0.0 { (line.perp(&way) / line.norm()).abs() } else { way.norm() }
    }

    /// The number of straight pieces by which it is drawn.
    fn steps(&self) -> f64 {
        self.arc.map_or(1.0, |(_, angle)| (angle.abs() / PIECE - ROUNDING).ceil().max(1.0))
    }

    /// Its place at a share of the way, and the derivative of that by the share.
    pub(crate) fn at(&self, share: f64) -> [Vector2<f64>; 2] {
        let Some((arm, angle)) = self.arc else {
            let step = self.to - self.from;
            return [self.from + step * share, step];
        };
        let across = Vector2::new(-arm.y, arm.x);
        let (sin, cos) = (angle * share).sin_cos();
        let half = (0.5 * angle * share).sin();
        [self.from - arm * (2.0 * half * half) + across * sin, (across * cos - arm * sin) * angle]
    }
}

/// 0, 1/n and so on, without 1.
fn shares(count: f64) -> impl Iterator<Item = f64> {
    let steps = std::iter::successors(Some(0.0), |step| Some(step + 1.0));
    steps.take_while(move |step| *step < count).map(move |step| step / count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn corner(at: [f64; 2], arc_through: Option<[f64; 2]>) -> OutlineCorner<Vector2<f64>> {
        OutlineCorner { at: Vector2::from(at), arc_through: arc_through.map(Vector2::from) }
    }

    /// A half disc of radius 2 about (5, 1): area pi r^2/2, centroid at 4 r/(3 pi) beyond the diameter, second
    /// moment pi r^4/4 about the middle of the diameter.
    #[test]
    fn a_half_disc() {
        let half = [corner([7.0, 1.0], Some([5.0, 3.0])), corner([3.0, 1.0], None)];
        let (area, first, polar) = moments(&half);
        assert!((area - 2.0 * PI).abs() < 1e-12, "{area}");
        let centre = first / area;
        let wanted = Vector2::new(5.0, 1.0 + 8.0 / (3.0 * PI));
        assert!((centre - wanted).norm() < 1e-11, "{centre}");
        let about_middle = 4.0 * PI;
        let about_origin = about_middle + 2.0 * first.dot(&Vector2::new(5.0, 1.0)) - 26.0 * area;
        assert!((polar - about_origin).abs() < 1e-9, "{polar} {about_origin}");
        let corners = polygon(&half);
        assert_eq!(corners.len(), 19);
        assert!(corners.iter().all(|corner| ((corner - Vector2::new(5.0, 1.0)).norm() - 2.0).abs() < 1e-12));
        assert!(
            corners.iter().all(|corner| corner.y >= 1.0 - 1e-12),
            "on the side of the place it goes through"
        );
        let back = [corner([3.0, 1.0], Some([5.0, 3.0])), corner([7.0, 1.0], None)];
        assert!((moments(&back).0 + area).abs() < 1e-12, "clockwise");
    }

    /// Three quarters of a circle, and a place on the straight line.
    #[test]
    fn more_than_half_a_circle_and_no_circle() {
        let pacman =
            [corner([1.0, 0.0], Some([-0.6, 0.8])), corner([0.0, -1.0], None), corner([0.0, 0.0], None)];
        assert!((moments(&pacman).0 - 0.75 * PI).abs() < 1e-12);
        let straight =
            [corner([0.0, 0.0], Some([1.0, 0.0])), corner([2.0, 0.0], None), corner([2.0, 1.0], None)];
        assert_eq!(polygon(&straight), [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]].map(Vector2::from));
        assert_eq!(moments(&straight).0, 1.0);
    }
}
