//! Whether a joint that does not slide now stays at rest, because the drives keep it so.

use super::factors::Factors;
use super::joint_equations::JointEquations;
use super::{Configuration, Velocity};
use crate::fault::Faults;
use crate::ids::{CoordinateId, JointId};
use crate::mechanism::{CoordinateKind, Mechanism};
use nalgebra::DVector;

/// An acceleration, or a part of a motion, below this part of the greatest is zero within rounding.
pub(crate) const NO_ACCELERATION: f64 = 1e-9;

/// Velocities and accelerations of all bodies, (x, y, angle) of each with lengths in sizes of the mechanism, as far as
/// the drives prescribe them.
struct Prescribed {
    velocities: DVector<f64>,
    accelerations: DVector<f64>,
    /// The motions of one coordinate each that no drive moves.
    free: Vec<DVector<f64>>,
}

/// Of these joints, which do not slide now, those that stay at rest: the drives alone give their accelerations, and these
/// vanish.
///
/// With the joint equations and the coordinates `F(q)`, and `s(q)` how far a joint has slid,
///
/// ```text
/// F' a = (0, prescribed accelerations) - F''[v, v]        s'' = s' a + s''[v, v]
/// ```
///
/// # Errors
/// Prescribed accelerations without a value.
pub(crate) fn staying(
    mechanism: &Mechanism,
    configuration: &Configuration,
    joints: &[JointId],
) -> Result<Vec<JointId>, Faults> {
    let Some(prescribed) = Prescribed::new(mechanism, configuration)? else { return Ok(Vec::new()) };
    let mut measured = mechanism.clone();
    let stays = |joint: &JointId| {
        let Some(coordinate) = measured.coordinates.first_mut() else { return false };
        coordinate.kind = CoordinateKind::Slide(*joint);
        let (equations, curvature) =
            JointEquations::with_curvature(&measured, &configuration.poses, &configuration.coordinates);
        let row = equations.jacobian.nrows() - mechanism.coordinates.len();
        let slope = equations.jacobian.row(row).transpose();
        let bent = curvature.along(&prescribed.velocities) * &prescribed.velocities;
        let acceleration = slope.dot(&prescribed.accelerations) + bent[row];
        let scale = prescribed.accelerations.amax().max(prescribed.velocities.amax().powi(2));
        let moves = |motion: &DVector<f64>| slope.dot(motion).abs() > NO_ACCELERATION * motion.amax();
        acceleration.abs() <= NO_ACCELERATION * scale && !prescribed.free.iter().any(moves)
    };
    Ok(joints.iter().copied().filter(stays).collect())
}

impl Prescribed {
    /// None if the joints and coordinates do not give them.
    ///
    /// # Errors
    /// Prescribed accelerations without a value.
    fn new(mechanism: &Mechanism, configuration: &Configuration) -> Result<Option<Self>, Faults> {
        let (equations, curvature) =
            JointEquations::with_curvature(mechanism, &configuration.poses, &configuration.coordinates);
        let size = mechanism.size;
        let of_body =
            |velocity: &Velocity| [velocity.linear.x / size, velocity.linear.y / size, velocity.angular];
        let motion = |state: &Configuration| {
            DVector::from_iterator(3 * mechanism.bodies.len(), state.velocities.iter().flat_map(of_body))
        };
        let velocities = motion(configuration);
        let joints = equations.jacobian.nrows() - mechanism.coordinates.len();
        let unit = |coordinate: usize| {
            let kind = mechanism.coordinates[coordinate].kind;
            if kind.is_angle() { 1.0 } else { 1.0 / size }
        };
        let mut wanted = -(curvature.along(&velocities) * &velocities);
        for drive in &mechanism.drives {
            let CoordinateId(coordinate) = drive.coordinate;
            let acceleration = configuration.quantity(mechanism, drive.acceleration)?;
            wanted[joints + coordinate] += acceleration * unit(coordinate);
        }
        let alone = configuration.with_each_rate(mechanism);
        let free = alone.iter().enumerate().filter(|(coordinate, _)| mechanism.is_free(*coordinate));
        let free = free.map(|(_, state)| motion(state)).collect();
        let accelerations = Factors::of(&equations.jacobian).solution(&wanted);
        Ok(accelerations.map(|accelerations| Self { velocities, accelerations, free }))
    }
}
