//! Positions and velocities within proven bounds.

use super::{NotEnclosed, solution};
use crate::configuration::{Configuration, JointEquations, Pose, Velocity, advance};
use crate::interval::Interval;
use crate::mechanism::Mechanism;
use crate::progress::Work;
use nalgebra::{DMatrix, DVector, Vector2};

/// How often a trial box is enlarged.
const TRIALS: usize = 12;
/// By how much of its width, to each side.
const INFLATION: f64 = 0.1;
/// Least half width of a trial box (sizes of the mechanism, or rad).
const LEAST: f64 = 1e-15;
/// A box wider than this is worth being narrowed.
const WIDE: f64 = 1e-9;
/// How often it is narrowed.
const REFINEMENTS: usize = 3;

/// The configuration near a computed one.
pub(super) fn enclosed(
    mechanism: &Mechanism<Interval>,
    computed: &Configuration,
    work: Work<'_>,
) -> Result<Configuration<Interval>, NotEnclosed> {
    let coordinates: Vec<Interval> =
        mechanism.coordinates.iter().map(|coordinate| coordinate.value).collect();
    let poses = positions(mechanism, computed, &coordinates, work).ok_or(NotEnclosed::Positions)?;
    let velocities = velocities(mechanism, &poses, &coordinates, work).ok_or(NotEnclosed::Velocities)?;
    let rates = mechanism.coordinates.iter().map(|coordinate| coordinate.rate).collect();
    let (time, steps) = (mechanism.time, computed.steps);
    Ok(Configuration { poses, velocities, coordinates, rates, time, steps, pieces: None })
}

/// A box of poses that holds exactly one solution of the joint equations with the wanted coordinates, for
/// every value of the parameters, and this solution in particular.
///
/// Interval Newton operator around the computed poses `z`, for a box `z + D`:
///
/// ```text
/// N(D) = - J(z + [0, D])^-1 f(z),      N(D) within D: one solution in z + D, and it is in z + N(D)
/// ```
///
/// (Neumaier, Interval Methods for Systems of Equations, 1990, section 5.1).
fn positions(
    mechanism: &Mechanism<Interval>,
    computed: &Configuration,
    coordinates: &[Interval],
    work: Work<'_>,
) -> Option<Vec<Pose<Interval>>> {
    let centre = computed.poses.iter().map(exact).collect();
    let newton = Newton { mechanism, centre, coordinates, work };
    let residual = newton.equations(&newton.centre).residual;
    let mut steps = newton.image(&DVector::zeros(residual.len()), &residual)?;
    for _ in 0..TRIALS {
        steps = steps.map(inflated);
        let image = newton.image(&steps, &residual)?;
        if steps.iter().zip(&image).all(|(step, image)| step.encloses(*image)) {
            return Some(newton.moved(&newton.narrowed(image, &residual)));
        }
        steps = image;
    }
    None
}

fn exact(pose: &Pose) -> Pose<Interval> {
    Pose::new(pose.position.map(Interval::point), Interval::point(pose.angle()))
}

fn inflated(step: Interval) -> Interval {
    let margin = INFLATION * step.width() + LEAST;
    step + Interval::around(0.0, margin)
}

struct Newton<'a> {
    mechanism: &'a Mechanism<Interval>,
    centre: Vec<Pose<Interval>>,
    coordinates: &'a [Interval],
    work: Work<'a>,
}

impl Newton<'_> {
    fn equations(&self, poses: &[Pose<Interval>]) -> JointEquations<Interval> {
        JointEquations::with_coordinates(self.mechanism, poses, self.coordinates)
    }

    fn moved(&self, steps: &DVector<Interval>) -> Vec<Pose<Interval>> {
        let mut poses = self.centre.clone();
        advance(self.mechanism, &mut poses, steps);
        poses
    }

    /// N(D); none if the Jacobian is not proven to be regular everywhere in the box.
    ///
    /// The mean value theorem needs the Jacobian on the way from the centre, which need not be in the box:
    /// parameters may be stated to differ from those of the computed positions.
    fn image(&self, steps: &DVector<Interval>, residual: &DVector<Interval>) -> Option<DVector<Interval>> {
        let way = steps.map(|step| step.hull(Interval::ZERO));
        let jacobian = self.equations(&self.moved(&way)).jacobian;
        let right = DMatrix::from_fn(residual.len(), 1, |row, _| -residual[row]);
        let solution = solution(&jacobian, &right, self.work)?;
        Some(DVector::from_fn(residual.len(), |row, _| solution.entry(row, 0)))
    }

    /// The same solution within narrower bounds.
    fn narrowed(&self, mut steps: DVector<Interval>, residual: &DVector<Interval>) -> DVector<Interval> {
        for _ in 0..REFINEMENTS {
            if steps.iter().all(|step| step.width() < WIDE) {
                break;
            }
            let Some(image) = self.image(&steps, residual) else { break };
            steps = steps.zip_map(&image, |step, image| step.intersection(image).unwrap_or(step));
        }
        steps
    }
}

/// Velocities of all bodies: J v = 0 in the rows of the joints, and the rates in those of the coordinates.
fn velocities(
    mechanism: &Mechanism<Interval>,
    poses: &[Pose<Interval>],
    coordinates: &[Interval],
    work: Work<'_>,
) -> Option<Vec<Velocity<Interval>>> {
    let equations = JointEquations::with_coordinates(mechanism, poses, coordinates);
    let size = Interval::point(mechanism.size);
    let rows = equations.joints.len();
    let mut rates = DMatrix::from_element(rows, 1, Interval::ZERO);
    let first = rows - mechanism.coordinates.len();
    for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
        rates[(first + index, 0)] =
            if coordinate.kind.is_angle() { coordinate.rate } else { coordinate.rate / size };
    }
    let solution = solution(&equations.jacobian, &rates, work)?;
    let component = |row: usize| solution.entry(row, 0);
    let velocity = |body: usize| Velocity {
        linear: Vector2::new(component(3 * body), component(3 * body + 1)) * size,
        angular: component(3 * body + 2),
    };
    Some((0..poses.len()).map(velocity).collect())
}
