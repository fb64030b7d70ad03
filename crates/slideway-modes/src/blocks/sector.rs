//! Sectors of directions in the plane, given by vectors rather than angles, so that they cover exactly.

use std::f64::consts::PI;

use crate::interval::{Interval, Real};

/// A vector of two components.
pub(super) type Vector = [f64; 2];

/// By how much an edge is turned beyond the direction that it must contain.
const TURN: f64 = 1e-13;
/// Above the relative rounding error of a few operations, and of a length.
const ROUNDING: f64 = 8.0 * f64::EPSILON;
/// The number of rays that stand for all directions in a relaxation.
const RAYS: usize = 8;

/// The directions that a reaction may have. Zero is a vector in every sector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sector {
    /// Every direction.
    All,
    /// The convex cone between two vectors, counterclockwise, of less than half a turn.
    Between(Vector, Vector),
}

impl Sector {
    /// Parts that cover it: the quadrants, turned by `angle`, or two halves.
    pub(super) fn parts(self, angle: f64) -> Vec<Self> {
        match self {
            Self::All => {
                let (sin, cos) = angle.sin_cos();
                let edges = [[cos, sin], [-sin, cos], [-cos, -sin], [sin, -cos]];
                (0..4).map(|at| Self::Between(edges[at], edges[(at + 1) % 4])).collect()
            }
            Self::Between(first, last) => {
                let middle = middle(first, last);
                vec![Self::Between(first, middle), Self::Between(middle, last)]
            }
        }
    }

    /// Half its angle, in rad; rounded.
    pub(super) fn half_angle(self) -> f64 {
        match self {
            Self::All => PI,
            Self::Between(first, last) => 0.5 * cross(first, last).atan2(dot(first, last)),
        }
    }

    /// The direction in its middle; zero if it has every direction.
    pub(super) fn middle(self) -> Vector {
        match self {
            Self::All => [0.0; 2],
            Self::Between(first, last) => middle(first, last),
        }
    }

    /// Unit vectors along its middle and across; any two if it has every direction.
    pub(super) fn frame(self) -> [Vector; 2] {
        let [x, y] = match self {
            Self::All => [1.0, 0.0],
            Self::Between(first, last) => middle(first, last),
        };
        [[x, y], [-y, x]]
    }

    /// A disc that contains all its unit vectors, and therefore also their mixtures: centre, and a bound on
    /// the radius.
    ///
    /// With the half angle `d` the smallest one has the centre `cos(d)` times the middle and the radius
    /// `sin(d)`.
    pub(super) fn disc(self) -> (Vector, f64) {
        let Self::Between(first, _) = self else { return ([0.0; 2], 1.0) };
        let middle = self.middle();
        let cos = dot(middle, unit(first));
        let centre = middle.map(|value| value * cos);
        let exact = centre.map(Interval::point);
        // |u - c|^2 = 1 + |c|^2 - 2 u.c
        let nearest = Interval::point(self.least(centre));
        let square = Interval::ONE + exact[0].square() + exact[1].square() - nearest - nearest;
        (centre, Interval::point(square.upper().max(0.0)).sqrt().upper())
    }

    /// A lower bound on `p.u` over all unit vectors `u` of the sector.
    ///
    /// The least value is `-|p|` if the direction of `-p` is in the sector, otherwise it is taken at an edge. Products
    /// with a zero factor are exact.
    pub(super) fn least(self, p: Vector) -> f64 {
        let size = length(p) * (1.0 + ROUNDING);
        let opposite = if size == 0.0 { 0.0 } else { -size - f64::MIN_POSITIVE };
        let Self::Between(first, last) = self else { return opposite };
        let at_edge = |edge: Vector| {
            let (value, error) = bounded(p[0], edge[0], p[1], edge[1]);
            let length = length(edge);
            let error = error / length + (value / length).abs() * ROUNDING;
            if error == 0.0 { 0.0 } else { value / length - error - f64::MIN_POSITIVE }
        };
        let edges = at_edge(first).min(at_edge(last));
        let is_left = |one: Vector, other: Vector| {
            let (value, error) = bounded(one[0], other[1], -one[1], other[0]);
            value > error
        };
        if is_left(first, p) || is_left(p, last) { edges } else { edges.min(opposite) }
    }

    /// Rays `(x, w)` whose mixtures contain `(x, |x|)` for every `x` of the sector, up to rounding.
    pub(super) fn rays(self) -> Vec<(Vector, f64)> {
        match self {
            Self::All => {
                let step = PI / RAYS as f64;
                let ray = |at: usize| {
                    let (sin, cos) = (2.0 * step * at as f64).sin_cos();
                    ([cos, sin], step.cos())
                };
                (0..RAYS).map(ray).collect()
            }
            // Between the tangents at both edges and in the middle, and the chord.
            Self::Between(first, last) => {
                let (first, middle, last) = (unit(first), middle(first, last), unit(last));
                let quarter = (0.5 * self.half_angle()).cos();
                let inner = [super::sector::middle(first, middle), super::sector::middle(middle, last)];
                vec![(first, 1.0), (inner[0], quarter), (inner[1], quarter), (last, 1.0)]
            }
        }
    }

    /// A sector that contains this one and every vector of a box; all directions if there is none of less than
    /// half a turn.
    pub(super) fn with(self, vector: [Interval; 2]) -> Self {
        let Self::Between(mut first, mut last) = self else { return Self::All };
        let corners = [0, 1, 2, 3].map(|at| {
            let bound = |value: Interval, upper: bool| if upper { value.upper() } else { value.lower() };
            [bound(vector[0], at & 1 == 1), bound(vector[1], at & 2 == 2)]
        });
        for corner in corners {
            if !is_left_of(first, corner) && cross(first, corner) < TURN * length(first) * length(corner) {
                first = turned(corner, -TURN);
            }
            if !is_left_of(corner, last) && cross(corner, last) < TURN * length(last) * length(corner) {
                last = turned(corner, TURN);
            }
        }
        let wider = Self::Between(first, last);
        let Self::Between(old_first, old_last) = self else { return Self::All };
        let holds = |vector: Vector| {
            (vector == first || is_left_of(first, vector)) && (vector == last || is_left_of(vector, last))
        };
        let all = corners.into_iter().chain([old_first, old_last]);
        let is_proper = interval_cross(first.map(Interval::point), last.map(Interval::point)).lower() > 0.0;
        if is_proper && all.into_iter().all(holds) { wider } else { Self::All }
    }

    /// The hull of two sectors that nearly touch; `None` if they do not, or if it has half a turn.
    pub(super) fn joined(self, other: Self, slack: f64) -> Option<Self> {
        let (Self::Between(first, last), Self::Between(other_first, other_last)) = (self, other) else {
            return Some(Self::All);
        };
        let distance = cross(self.middle(), other.middle()).atan2(dot(self.middle(), other.middle())).abs();
        if distance > self.half_angle() + other.half_angle() + slack {
            return None;
        }
        let first = if cross(first, other_first) < 0.0 { other_first } else { first };
        let last = if cross(other_last, last) < 0.0 { other_last } else { last };
        (cross(first, last) > 0.0).then_some(Self::Between(first, last))
    }

    /// Its edges; `None` if it has every direction.
    pub(super) fn edges(self) -> Option<[Vector; 2]> {
        match self {
            Self::All => None,
            Self::Between(first, last) => Some([first, last]),
        }
    }
}

/// `a b + c d`, and a bound on its rounding error.
fn bounded(a: f64, b: f64, c: f64, d: f64) -> (f64, f64) {
    let size = |one: f64, other: f64| {
        if one == 0.0 || other == 0.0 { 0.0 } else { (one * other).abs() * ROUNDING + f64::MIN_POSITIVE }
    };
    (a * b + c * d, size(a, b) + size(c, d))
}

/// Whether it is proven that the way from one vector to the other is counterclockwise and at most half a turn.
fn is_left_of(one: Vector, other: Vector) -> bool {
    interval_cross(one.map(Interval::point), other.map(Interval::point)).lower() >= 0.0
}

fn interval_cross(one: [Interval; 2], other: [Interval; 2]) -> Interval {
    one[0] * other[1] - one[1] * other[0]
}

fn cross(one: Vector, other: Vector) -> f64 {
    one[0] * other[1] - one[1] * other[0]
}

fn dot(one: Vector, other: Vector) -> f64 {
    one[0] * other[0] + one[1] * other[1]
}

pub(super) fn length(vector: Vector) -> f64 {
    vector[0].hypot(vector[1])
}

/// A vector divided by its length; zero stays zero.
pub(super) fn unit(vector: Vector) -> Vector {
    let length = length(vector);
    if length == 0.0 { vector } else { vector.map(|value| value / length) }
}

fn turned(vector: Vector, angle: f64) -> Vector {
    [vector[0] - angle * vector[1], vector[1] + angle * vector[0]]
}

fn middle(first: Vector, last: Vector) -> Vector {
    let (first, last) = (unit(first), unit(last));
    unit([first[0] + last[0], first[1] + last[1]])
}
