//! Motions with the rate of one coordinate alone.

use super::factors::Factors;
use super::joint_equations::JointEquations;
use super::{Configuration, Velocity};
use crate::mechanism::Mechanism;
use nalgebra::Vector2;

impl Configuration {
    /// This position in as many motions as there are coordinates, in each of which one coordinate alone has a rate: 1. These
    /// motions span all that the joints leave. None where the coordinates do not determine the velocities.
    ///
    /// With the joint equations and the coordinates `F(q)`, the velocities are the columns of `F'^-1` of the coordinates.
    pub(crate) fn with_each_rate(&self, mechanism: &Mechanism) -> Vec<Self> {
        let count = mechanism.coordinates.len();
        let equations = JointEquations::with_coordinates(mechanism, &self.poses, &self.coordinates);
        let rows = equations.jacobian.nrows();
        if !equations.jacobian.is_square() {
            return Vec::new();
        }
        let mut wanted = vec![0.0; rows * count];
        for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
            let scale = if coordinate.kind.is_angle() { 1.0 } else { mechanism.size };
            wanted[(rows - count + index) * count + index] = 1.0 / scale;
        }
        let factors = Factors::of(&equations.jacobian);
        let motions = factors.solve_closely(&equations.jacobian, &wanted, count);
        if !motions.iter().all(|part| part.is_finite()) {
            return Vec::new();
        }
        let velocity = |body: usize, motion: usize| {
            let [x, y, angle] = [0, 1, 2].map(|part| motions[(3 * body + part) * count + motion]);
            Velocity { linear: Vector2::new(x, y) * mechanism.size, angular: angle }
        };
        let alone = |motion: usize| Self {
            velocities: (0..mechanism.bodies.len()).map(|body| velocity(body, motion)).collect(),
            rates: (0..count).map(|index| f64::from(u8::from(index == motion))).collect(),
            ..self.clone()
        };
        (0..count).map(alone).collect()
    }
}
