//! Curves that are no arcs of circles: ellipses and splines, as arcs that stay near them.

use super::ImportFault;
use super::groups::Record;
use super::layers::{Corner, Path};
use crate::model::OutlineCorner;
use crate::model::outline::Piece;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// How far an arc may be from the curve for which it stands, in sizes of the curve.
const NEAR_CURVE: f64 = 1e-4;
/// A stretch of a curve is halved at most so often.
const HALVINGS: u32 = 10;
/// An ellipse is looked at in so many parts.
const PARTS: usize = 8;

/// Arcs that stay near a curve, which is given by its parameter, one after the other between values of that.
pub(super) fn arcs(curve: &impl Fn(f64) -> Vector2<f64>, values: &[f64]) -> Vec<Corner> {
    let quarters =
        values.windows(2).flat_map(|pair| QUARTERS.map(|part| pair[0] + part * (pair[1] - pair[0])));
    let places: Vec<Vector2<f64>> = quarters.map(curve).collect();
    let least = places.iter().copied().reduce(|a, b| a.inf(&b)).unwrap_or_default();
    let greatest = places.iter().copied().reduce(|a, b| a.sup(&b)).unwrap_or_default();
    let near = NEAR_CURVE * (greatest - least).norm();
    let mut corners = Vec::new();
    for pair in values.windows(2) {
        halve((curve, near), [pair[0], pair[1]], HALVINGS, &mut corners);
    }
    corners.extend(values.last().map(|value| OutlineCorner { at: curve(*value), arc_through: None }));
    corners
}

/// Shares of a stretch.
const QUARTERS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

/// One arc for a stretch of a curve, or those of both halves where it is not near enough at the quarters.
fn halve(
    (curve, near): (&impl Fn(f64) -> Vector2<f64>, f64),
    [from, to]: [f64; 2],
    halvings: u32,
    corners: &mut Vec<Corner>,
) {
    let [start, first, middle, last, end] = QUARTERS.map(|part| curve(from + part * (to - from)));
    let corner = OutlineCorner { at: start, arc_through: Some(middle) };
    let piece = Piece::new(&corner, end);
    if halvings == 0 || [first, last].into_iter().all(|place| piece.distance(place) <= near) {
        corners.push(corner);
        return;
    }
    let between = from + 0.5 * (to - from);
    halve((curve, near), [from, between], halvings - 1, corners);
    halve((curve, near), [between, to], halvings - 1, corners);
}

/// An ellipse or a part of it: p(u) = c + a cos u + b sin u, b across a to the left, seen along the extrusion direction.
pub(super) fn ellipse(record: &Record<'_>, sign: f64) -> Result<Path, ImportFault> {
    let centre = Vector2::new(record.number(10)?, record.number(20)?);
    let major = Vector2::new(record.number(11)?, record.number(21)?);
    let minor = Vector2::new(-major.y, major.x) * (sign * record.number(40)?);
    let [from, to] = [record.number_or(41, 0.0)?, record.number_or(42, TAU)?];
    let turn = (to - from).rem_euclid(TAU);
    let turn = if turn == 0.0 { TAU } else { turn };
    let values: Vec<f64> = (0..=PARTS).map(|part| from + turn * part as f64 / PARTS as f64).collect();
    let corners = arcs(&|value: f64| centre + major * value.cos() + minor * value.sin(), &values);
    Ok(Path { corners, is_closed: false })
}

/// A spline: rational B-splines of any degree; none where it is given by other than control points that fit its knots.
pub(super) fn spline(record: &Record<'_>) -> Result<Option<Path>, ImportFault> {
    let numbers = |code: i32| -> Result<Vec<f64>, ImportFault> {
        let groups = record.groups.iter().filter(|group| group.code == code);
        groups.map(|group| record.number_of(*group)).collect()
    };
    let (knots, weights) = (numbers(40)?, numbers(41)?);
    let (across, up) = (numbers(10)?, numbers(20)?);
    let degree = record.flags(71)? as usize;
    let count = across.len();
    let is_sound = (1..=MOST_DEGREE).contains(&degree)
        && count > degree
        && up.len() == count
        && knots.len() == count + degree + 1
        && knots.is_sorted()
        && (weights.is_empty() || weights.len() == count && weights.iter().all(|weight| *weight > 0.0));
    if !is_sound {
        return Ok(None);
    }
    let weight = |index: usize| weights.get(index).copied().unwrap_or(1.0);
    let controls: Vec<Vector3<f64>> =
        (0..count).map(|index| Vector3::new(across[index], up[index], 1.0) * weight(index)).collect();
    let mut values = knots[degree..=count].to_vec();
    values.dedup();
    let spline = Spline { degree, knots, controls };
    Ok((values.len() > 1)
        .then(|| Path { corners: arcs(&|value| spline.at(value), &values), is_closed: false }))
}

/// Greatest degree of the splines that are read.
const MOST_DEGREE: usize = 25;

struct Spline {
    degree: usize,
    knots: Vec<f64>,
    /// Times their weights, with these.
    controls: Vec<Vector3<f64>>,
}

impl Spline {
    /// De Boor's algorithm: d_j becomes (1 - a) d_(j-1) + a d_j, a = (t - t_i) / (t_(i+p+1-r) - t_i), i = j + k - p,
    /// in the rounds r = 1 to p, t between the knots k and k + 1.
    fn at(&self, value: f64) -> Vector2<f64> {
        let Self { degree, knots, controls } = self;
        let inner = &knots[*degree..controls.len()];
        let span = degree + inner.partition_point(|knot| *knot <= value).max(1) - 1;
        let mut places = controls[span - degree..=span].to_vec();
        for round in 1..=*degree {
            for index in (round..=*degree).rev() {
                let first = knots[index + span - degree];
                let width = knots[index + span + 1 - round] - first;
                let share = if width > 0.0 { (value - first) / width } else { 0.0 };
                places[index] = places[index - 1] * (1.0 - share) + places[index] * share;
            }
        }
        places[*degree].xy() / places[*degree].z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::outline::moments;
    use std::f64::consts::PI;

    fn record(groups: &[(i32, &'static str)]) -> Record<'static> {
        let groups =
            groups.iter().map(|(code, value)| super::super::groups::Group { code: *code, value, line: 0 });
        Record { kind: "SPLINE", line: 0, groups: groups.collect() }
    }

    fn area(path: &Path) -> f64 {
        moments(&path.corners).0
    }

    /// A full ellipse with half axes 3 and 1 has the area 3 pi, and lies on (x/3)^2 + y^2 = 1; half of it from u = 0 to
    /// pi is above its major axis, or below where it is seen from behind.
    #[test]
    fn ellipses() {
        let whole = [(10, "0"), (20, "0"), (11, "3"), (21, "0"), (40, "0.333333333333333333")];
        let path = ellipse(&record(&whole), 1.0).expect("sound");
        assert!((area(&path) / (3.0 * PI) - 1.0).abs() < 1e-4, "{}", area(&path));
        for corner in &path.corners {
            assert!(((corner.at.x / 3.0).powi(2) + corner.at.y.powi(2) - 1.0).abs() < 1e-12);
        }
        let half = [&whole[..], &[(41, "0"), (42, "3.14159265358979")]].concat();
        for sign in [1.0, -1.0] {
            let path = ellipse(&record(&half), sign).expect("sound");
            assert!(path.corners.iter().all(|corner| corner.at.y * sign > -1e-12));
            assert!((area(&path) * sign / (1.5 * PI) - 1.0).abs() < 1e-4);
        }
    }

    /// A rational spline of degree 2 with weights 1, 1/sqrt 2, 1 is a quarter of a circle (Piegl and Tiller, The NURBS
    /// Book, example 7.2); one of degree 3 with these control points is a Bezier curve, whose place in the middle is
    /// (P0 + 3 P1 + 3 P2 + P3)/8, and which takes 3/5 h w of the area of a rectangle w by h.
    #[test]
    fn splines() {
        let quarter = [
            (71, "2"),
            (40, "0"),
            (40, "0"),
            (40, "0"),
            (40, "1"),
            (40, "1"),
            (40, "1"),
            (41, "1"),
            (41, "0.7071067811865476"),
            (41, "1"),
            (10, "1"),
            (20, "0"),
            (10, "1"),
            (20, "1"),
            (10, "0"),
            (20, "1"),
        ];
        let path = spline(&record(&quarter)).expect("numbers").expect("sound");
        assert_eq!(path.corners.len(), 2, "it is an arc");
        for corner in &path.corners {
            assert!((corner.at.norm() - 1.0).abs() < 1e-12);
            assert!(corner.arc_through.is_none_or(|place| (place.norm() - 1.0).abs() < 1e-12));
        }
        let bezier = [
            (71, "3"),
            (40, "0"),
            (40, "0"),
            (40, "0"),
            (40, "0"),
            (40, "1"),
            (40, "1"),
            (40, "1"),
            (40, "1"),
            (10, "0"),
            (20, "0"),
            (10, "0"),
            (20, "2"),
            (10, "5"),
            (20, "2"),
            (10, "5"),
            (20, "0"),
        ];
        let path = spline(&record(&bezier)).expect("numbers").expect("sound");
        let is_middle = |corner: &Corner| (corner.at - Vector2::new(2.5, 1.5)).norm() < 1e-12;
        assert!(path.corners.iter().any(is_middle), "{path:?}");
        assert!((area(&path) / -6.0 - 1.0).abs() < 1e-3, "{}", area(&path));
        assert!(spline(&record(&bezier[..16])).expect("numbers").is_none(), "a control point is not whole");
    }
}
