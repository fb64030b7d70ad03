//! Second derivatives of the joint equations at given poses, and bounds of the third ones anywhere.
//!
//! Only rotations bend the equations. Two terms occur, in lengths divided by the size of the mechanism; `a`
//! is the axis of the equation, `w` an arm that turns with a body, `m` what lies between the origin of a body
//! and that of the guide or a fixed point, `n = rot90(a)`, and dots are changes along a vector of (x, y,
//! angle) of every body:
//!
//! ```text
//! a . w     turned by psi, an angle of a body against the axis:   D2 = -(a . w) psi'^2
//!                                                                 |D3| <= |w| |psi'|^3
//! a . m     the axis turned by phi, m linear in the positions:    D2 = 2 (n . m') phi' - (a . m) phi'^2
//!                                                                 |D3| <= 3 |m'| phi'^2 + |m| |phi'|^3
//! ```
//!
//! The distance `d` of two places keeps its length `r` as `|d|^2/(2 r)`. With arms `w_i`, that turn with angles `phi_i`,
//! `d'' = -w_1 phi_1'^2 + w_2 phi_2'^2`, and
//!
//! ```text
//! |d|^2/(2 r)                                                     D2 = (d' . d' + d . d'') / r
//!                                                                 |D3| <= (3 |d'| |d''| + |d| |d^(3)|) / r
//! ```

use crate::ids::{BodyId, Frame};
use crate::mechanism::rot90;
use nalgebra::{DMatrix, DVector, Vector2};

/// An angle as a sum of those of two frames: their places in a vector of (x, y, angle) of every body, each with its factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Angle([(usize, f64); 2]);

/// An arm that turns against the axis of its equation.
#[derive(Debug, Clone, Copy)]
struct Turn {
    row: usize,
    /// Its angle against the axis.
    angle: Angle,
    /// a . w, with the sign of the term.
    value: f64,
    /// |w|
    length: f64,
}

/// A distance along an axis that turns.
#[derive(Debug, Clone, Copy)]
struct Swing {
    row: usize,
    /// The angle of the axis.
    angle: Angle,
    /// The bodies at both ends of m, from the second to the first; none where that is fixed.
    bodies: [Option<usize>; 2],
    normal: Vector2<f64>,
    /// a . m
    value: f64,
    /// |m|
    length: f64,
}

/// Two places that keep their distance.
#[derive(Debug, Clone, Copy)]
struct Distance {
    row: usize,
    ends: [End; 2],
    /// d, from the second place to the first.
    between: Vector2<f64>,
    /// r
    kept: f64,
}

/// An end of a distance: what it is on, and its arm from the centre of mass of that body.
#[derive(Debug, Clone, Copy)]
pub(super) struct End {
    pub(super) frame: Frame,
    pub(super) arm: Vector2<f64>,
}

/// How the joint equations bend.
#[derive(Debug, Clone, Default)]
pub(super) struct Curvature {
    turns: Vec<Turn>,
    swings: Vec<Swing>,
    distances: Vec<Distance>,
}

impl Curvature {
    /// Adds the distance of two ends, which is kept, as the equation `row`; `between` leads from the second one to the
    /// first.
    pub(super) fn around(&mut self, row: usize, ends: [End; 2], (between, kept): (Vector2<f64>, f64)) {
        self.distances.push(Distance { row, ends, between, kept });
    }

    /// Adds the distance of two ends along a fixed axis as the equation `row`.
    pub(super) fn along_fixed_axis(&mut self, row: usize, ends: [End; 2], axis: Vector2<f64>) {
        for (end, sign) in ends.iter().zip([1.0, -1.0]) {
            if end.frame.body().is_some() {
                let (value, length) = (sign * axis.dot(&end.arm), end.arm.norm());
                let angle = Angle::sum([(end.frame, 1.0), (Frame::Ground, 0.0)]);
                self.turns.push(Turn { row, angle, value, length });
            }
        }
    }

    /// Adds the distance of two ends along an axis that turns by an angle as the equation `row`; `between` leads from the origin
    /// of the second end's body to that of the first, or to a fixed end itself.
    pub(super) fn along_turning(
        &mut self,
        row: usize,
        ends: [End; 2],
        turning: Angle,
        (axis, between): (Vector2<f64>, Vector2<f64>),
    ) {
        for (end, sign) in ends.iter().zip([1.0, -1.0]).filter(|(end, _)| end.arm != Vector2::zeros()) {
            if let Some(body) = end.frame.body() {
                let (value, length) = (sign * axis.dot(&end.arm), end.arm.norm());
                self.turns.push(Turn { row, angle: turning.of_body(body), value, length });
            }
        }
        let bodies = ends.map(|end| end.frame.body().map(BodyId::index));
        let (value, length) = (axis.dot(&between), between.norm());
        self.swings.push(Swing { row, angle: turning, bodies, normal: rot90(axis), value, length });
    }

    /// The change of the Jacobian along a vector: the matrix of D2 F[along, .].
    pub(super) fn along(&self, along: &DVector<f64>) -> DMatrix<f64> {
        let size = along.len();
        let mut change = DMatrix::zeros(size, size);
        for turn in &self.turns {
            let entry = -turn.value * turn.angle.along(along);
            turn.angle.0.iter().for_each(|&(at, factor)| change[(turn.row, at)] += entry * factor);
        }
        for swing in &self.swings {
            let turned = swing.angle.along(along);
            let mut moved = Vector2::zeros();
            for (body, sign) in swing.ends() {
                moved += Vector2::new(along[3 * body], along[3 * body + 1]) * sign;
                (0..2).for_each(|axis| {
                    change[(swing.row, 3 * body + axis)] += sign * swing.normal[axis] * turned;
                });
            }
            let entry = swing.normal.dot(&moved) - swing.value * turned;
            swing.angle.0.iter().for_each(|&(at, factor)| change[(swing.row, at)] += entry * factor);
        }
        for distance in &self.distances {
            distance.add_change(along, &mut change);
        }
        change
    }

    /// Adds bounds of |D2 F[u, v]| for all |u| <= `one` and |v| <= `other`, row by row.
    pub(super) fn add_second(&self, one: &DVector<f64>, other: &DVector<f64>, bounds: &mut DVector<f64>) {
        for turn in &self.turns {
            bounds[turn.row] += turn.value.abs() * turn.angle.greatest(one) * turn.angle.greatest(other);
        }
        for swing in &self.swings {
            let [u, v] = [one, other].map(|vector| swing.moved(vector));
            let across = |moved: Vector2<f64>| swing.normal.abs().dot(&moved);
            let [phi, psi] = [one, other].map(|vector| swing.angle.greatest(vector));
            bounds[swing.row] += across(u) * psi + across(v) * phi + swing.value.abs() * phi * psi;
        }
        for distance in &self.distances {
            let [u, v] = [one, other].map(|vector| distance.moved(vector));
            let turned = distance.turned(|arm| arm.dot(&distance.between).abs(), [one, other]);
            bounds[distance.row] += (u * v + turned) / distance.kept;
        }
    }

    /// Adds `factor` times bounds of |D3 F[u, u, v]| for all |u| <= `one` and |v| <= `other`, row by row,
    /// wherever the bodies have moved by up to `one` from here.
    pub(super) fn add_third(
        &self,
        factor: f64,
        one: &DVector<f64>,
        other: &DVector<f64>,
        bounds: &mut DVector<f64>,
    ) {
        for turn in &self.turns {
            bounds[turn.row] +=
                factor * turn.length * turn.angle.greatest(one).powi(2) * turn.angle.greatest(other);
        }
        for swing in &self.swings {
            let [u, v] = [one, other].map(|vector| swing.moved(vector).norm());
            let [phi, psi] = [one, other].map(|vector| swing.angle.greatest(vector));
            bounds[swing.row] +=
                factor * (2.0 * u * phi * psi + v * phi * phi + (swing.length + u) * phi * phi * psi);
        }
        for distance in &self.distances {
            let [u, v] = [one, other].map(|vector| distance.moved(vector));
            let second = |a, b| distance.turned(|arm: Vector2<f64>| arm.norm(), [a, b]);
            let longest = distance.between.norm() + u;
            let third: f64 =
                distance.angles().map(|(arm, angle)| arm.norm() * one[angle].powi(2) * other[angle]).sum();
            let bound = 2.0 * u * second(one, other) + v * second(one, one) + longest * third;
            bounds[distance.row] += factor * bound / distance.kept;
        }
    }

    /// The greatest length of a term.
    pub(super) fn greatest_length(&self) -> f64 {
        let turns = self.turns.iter().map(|turn| turn.length);
        let distances = self.distances.iter().map(Distance::length);
        turns.chain(self.swings.iter().map(|swing| swing.length)).chain(distances).fold(0.0, f64::max)
    }
}

impl Distance {
    /// The arms of the ends that turn, with their signs in d, and the places of their angles in a vector of (x, y, angle) of
    /// every body.
    fn angles(&self) -> impl Iterator<Item = (Vector2<f64>, usize)> + '_ {
        let of_end = |(end, sign): (&End, f64)| Some((end.arm * sign, 3 * end.frame.body()?.index() + 2));
        self.ends.iter().zip([1.0, -1.0]).filter_map(of_end)
    }

    /// d' along the entries of a vector, each with its place.
    fn rates(&self) -> impl Iterator<Item = (usize, Vector2<f64>)> + '_ {
        let of_end = |(end, sign): (&End, f64)| {
            let first = 3 * end.frame.body()?.index();
            let by = [Vector2::x(), Vector2::y(), rot90(end.arm)];
            Some(by.into_iter().enumerate().map(move |(at, rate)| (first + at, rate * sign)))
        };
        self.ends.iter().zip([1.0, -1.0]).filter_map(of_end).flatten()
    }

    /// Adds D2 F[along, .].
    fn add_change(&self, along: &DVector<f64>, change: &mut DMatrix<f64>) {
        let moved: Vector2<f64> = self.rates().map(|(at, rate)| rate * along[at]).sum();
        for (at, rate) in self.rates() {
            change[(self.row, at)] += moved.dot(&rate) / self.kept;
        }
        for (arm, angle) in self.angles() {
            change[(self.row, angle)] -= self.between.dot(&arm) * along[angle] / self.kept;
        }
    }

    /// The greatest |d'| along a vector of greatest entries.
    fn moved(&self, greatest: &DVector<f64>) -> f64 {
        let of_end = |end: &End| {
            let first = 3 * end.frame.body()?.index();
            let way = Vector2::new(greatest[first], greatest[first + 1]).norm();
            Some(way + end.arm.norm() * greatest[first + 2])
        };
        self.ends.iter().filter_map(of_end).sum()
    }

    /// The sum of what both arms count times their rotations.
    fn turned(&self, counts: impl Fn(Vector2<f64>) -> f64, vectors: [&DVector<f64>; 2]) -> f64 {
        self.angles().map(|(arm, angle)| counts(arm) * vectors[0][angle] * vectors[1][angle]).sum()
    }

    /// The greatest length of a term, of which the equation has products.
    fn length(&self) -> f64 {
        let arms = self.ends.iter().map(|end| end.arm.norm());
        let greatest = arms.fold(self.between.norm(), f64::max);
        greatest.max(greatest * self.between.norm() / self.kept)
    }
}

impl Angle {
    /// Multiples of the angles of two frames; ground does not turn.
    pub(super) fn sum(parts: [(Frame, f64); 2]) -> Self {
        Self(parts.map(|(frame, factor)| match frame.body() {
            Some(body) => (3 * body.index() + 2, factor),
            None => (2, 0.0),
        }))
    }

    /// The angle of a body against this one.
    fn of_body(self, body: BodyId) -> Self {
        let own = 3 * body.index() + 2;
        let mut parts = self.0.map(|(at, factor)| (at, -factor));
        let place = parts.iter().position(|(at, factor)| *at == own && *factor != 0.0);
        let place = place.or_else(|| parts.iter().position(|(_, factor)| *factor == 0.0));
        // One of both parts is that of the body, or none.
        if let Some(place) = place {
            parts[place] = (own, parts[place].1 + 1.0);
        }
        Self(parts)
    }

    /// Its value along a vector.
    fn along(&self, along: &DVector<f64>) -> f64 {
        self.0.iter().map(|(at, factor)| factor * along[*at]).sum()
    }

    /// The greatest value, where no entry of a vector is greater than these.
    fn greatest(&self, greatest: &DVector<f64>) -> f64 {
        self.0.iter().map(|(at, factor)| factor.abs() * greatest[*at]).sum()
    }
}

impl Swing {
    /// The bodies at its ends, each with the sign of its place in m.
    fn ends(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.bodies.iter().zip([1.0, -1.0]).filter_map(|(body, sign)| Some(((*body)?, sign)))
    }

    /// The greatest change of both components of m.
    fn moved(&self, greatest: &DVector<f64>) -> Vector2<f64> {
        self.ends().map(|(body, _)| Vector2::new(greatest[3 * body], greatest[3 * body + 1])).sum()
    }
}
