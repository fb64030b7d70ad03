//! The configuration near earlier ones: one Newton step in place of the way from the drawing.

use super::assembly::{CLOSED, STAGE, check_position};
use super::joint_equations::JointEquations;
use super::mobility::advance;
use super::{Configuration, Pose, Velocity};
use crate::mechanism::Mechanism;
use nalgebra::{DMatrix, DVector, Dyn, LU, Vector2};

/// Newton steps; from an extrapolated state one is usual.
const STEPS: usize = 6;
/// The joint equations are certainly regular if no pivot is below this multiple of the greatest.
const REGULAR: f64 = 1e-3;
/// Steps of a coordinate that differ by less than this multiple count as even.
const EVEN: f64 = 1e-6;

/// The configuration at the mechanism's coordinate values and rates, from earlier ones nearby, the last one first.
pub(super) fn near(mechanism: &Mechanism, earlier: &[Configuration]) -> Option<Configuration> {
    let last = earlier.first()?;
    let coordinates: Vec<f64> = mechanism.coordinates.iter().map(|coordinate| coordinate.value).collect();
    if way(mechanism, &coordinates, &last.coordinates)? > STAGE {
        return None;
    }
    let mut poses = start(&coordinates, earlier);
    for _ in 0..STEPS {
        let equations = JointEquations::with_coordinates(mechanism, &poses, &coordinates);
        let residual = equations.residual.amax();
        let (factors, regular) = factored(equations.jacobian)?;
        let step = factors.solve(&-equations.residual)?;
        if !step.iter().all(|part| part.abs() < STAGE) {
            return None;
        }
        advance(mechanism, &mut poses, &step);
        // This last step has brought the residual to rounding, and has changed the matrix by no more than that.
        if residual < CLOSED {
            let velocities = regular.then(|| velocities(mechanism, &factors))??;
            let configuration = Configuration {
                poses,
                velocities,
                coordinates,
                rates: mechanism.coordinates.iter().map(|coordinate| coordinate.rate).collect(),
                time: mechanism.time,
        pieces: None,
            };
            return check_position(mechanism, &configuration).is_ok().then_some(configuration);
        }
    }
    None
}

/// The greatest difference of a coordinate, in sizes of the mechanism or rad.
fn way(mechanism: &Mechanism, to: &[f64], from: &[f64]) -> Option<f64> {
    if to.len() != from.len() {
        return None;
    }
    let scale = |index: usize| {
        if mechanism.coordinates[index].kind.is_angle() { 1.0 } else { mechanism.size }
    };
    Some((0..to.len()).map(|index| (to[index] - from[index]).abs() / scale(index)).fold(0.0, f64::max))
}

/// The parabola through three evenly spaced states, else the last one.
fn start(coordinates: &[f64], earlier: &[Configuration]) -> Vec<Pose> {
    let last = earlier[0].poses.clone();
    let [first, second, third, ..] = earlier else { return last };
    let even = (0..coordinates.len()).all(|index| {
        let steps = [
            coordinates[index] - first.coordinates[index],
            first.coordinates[index] - second.coordinates[index],
            second.coordinates[index] - third.coordinates[index],
        ];
        let tolerance = EVEN * steps[0].abs();
        (steps[0] - steps[1]).abs() <= tolerance && (steps[1] - steps[2]).abs() <= tolerance
    });
    if !even {
        return last;
    }
    let extrapolated = |one: f64, two: f64, three: f64| 3.0 * (one - two) + three;
    let poses = first.poses.iter().zip(&second.poses).zip(&third.poses);
    poses
        .map(|((one, two), three)| Pose {
            position: one.position.zip_zip_map(&two.position, &three.position, extrapolated),
            angle: extrapolated(one.angle, two.angle, three.angle),
        })
        .collect()
}

/// Factors of the joint equations, and whether these are certainly regular.
fn factored(jacobian: DMatrix<f64>) -> Option<(LU<f64, Dyn, Dyn>, bool)> {
    if !jacobian.is_square() || jacobian.is_empty() {
        return None;
    }
    let factors = jacobian.lu();
    let pivots = factors.lu_internal().diagonal();
    let sizes = pivots.iter().map(|pivot| pivot.abs());
    let (least, greatest) =
        sizes.fold((f64::INFINITY, 0.0_f64), |(least, greatest), size| (least.min(size), greatest.max(size)));
    Some((factors, least > REGULAR * greatest))
}

/// Velocities of all bodies: G v = 0 and the rates of the coordinates.
fn velocities(mechanism: &Mechanism, factors: &LU<f64, Dyn, Dyn>) -> Option<Vec<Velocity>> {
    let rows = 3 * mechanism.bodies.len();
    let first = rows - mechanism.coordinates.len();
    let mut rates = DVector::zeros(rows);
    for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
        let scale = if coordinate.kind.is_angle() { 1.0 } else { mechanism.size };
        rates[first + index] = coordinate.rate / scale;
    }
    if !factors.solve_mut(&mut rates) {
        return None;
    }
    let of = |body: usize| Velocity {
        linear: Vector2::new(rates[3 * body], rates[3 * body + 1]) * mechanism.size,
        angular: rates[3 * body + 2],
    };
    Some((0..mechanism.bodies.len()).map(of).collect())
}
