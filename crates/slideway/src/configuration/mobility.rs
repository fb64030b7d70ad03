//! Degrees of freedom and determinacy: rank of the joint equations, which joints are in excess, which bodies a
//! set of coordinates leaves free.

use super::joint_equations::JointEquations;
use super::{Configuration, Pose};
use crate::fault::FaultKind;
use crate::ids::JointId;
use crate::mechanism::{JointKind, Mechanism, rot90};
use crate::model::SliderKind;
use nalgebra::{DMatrix, DVector, SVD, Vector2};

/// Singular values below this multiple of the greatest count as zero.
const RANK_TOLERANCE: f64 = 1e-9;
/// Length of the step, in sizes of the mechanism, that tells a singular position from a redundant structure.
const PROBE: f64 = 1e-2;

/// How a mechanism can move, and whether its reactions are determinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Mobility {
    /// Coordinates of all bodies: 3 b.
    pub body_coordinates: usize,
    /// Scalar joint equations.
    pub constraints: usize,
    /// How many of them are independent: the rank of their Jacobian.
    pub independent: usize,
    /// What is in excess, if anything.
    pub redundancy: Option<Redundancy>,
}

/// Joint equations in excess.
#[derive(Debug, Clone, PartialEq)]
pub struct Redundancy {
    /// The joints among which the excess lies.
    pub joints: Vec<JointId>,
    /// What would make the structure determinate, if one of the joints offers it.
    pub suggestion: Option<String>,
    /// Whether the excess vanishes in a neighbouring position: the position is singular, not the structure.
    pub only_here: bool,
}

impl Mobility {
    /// Mobility of a mechanism in a configuration.
    pub fn of(mechanism: &Mechanism, configuration: &Configuration) -> Self {
        let equations = JointEquations::of_joints(mechanism, &configuration.poses);
        let (constraints, body_coordinates) = equations.jacobian.shape();
        let independent = rank(&equations.jacobian);
        let redundancy = (independent < constraints).then(|| Redundancy {
            joints: joints_in_excess(&equations),
            suggestion: None,
            only_here: is_singular_position(mechanism, &configuration.poses, independent),
        });
        let redundancy = redundancy.map(|redundancy| Redundancy {
            suggestion: suggestion(mechanism, &redundancy.joints),
            ..redundancy
        });
        Self { body_coordinates, constraints, independent, redundancy }
    }

    /// Independent motions that the joints leave: n = 3 b - rank.
    pub fn degrees_of_freedom(&self) -> usize {
        self.body_coordinates - self.independent
    }

    /// Joint equations in excess.
    pub fn excess(&self) -> usize {
        self.constraints - self.independent
    }

    /// The fault that a redundancy is, if there is one.
    pub fn fault(&self, mechanism: &Mechanism) -> Option<FaultKind> {
        let redundancy = self.redundancy.as_ref()?;
        let joints =
            redundancy.joints.iter().map(|joint| mechanism.joints[joint.index()].name.to_string()).collect();
        Some(if redundancy.only_here {
            FaultKind::SingularPosition { lost: self.excess(), joints }
        } else {
            FaultKind::Redundant { excess: self.excess(), joints, suggestion: redundancy.suggestion.clone() }
        })
    }
}

/// Number of singular values above the tolerance.
pub(super) fn rank(matrix: &DMatrix<f64>) -> usize {
    if matrix.is_empty() {
        return 0;
    }
    let values = matrix.clone().singular_values();
    let threshold = values.max() * RANK_TOLERANCE;
    values.iter().filter(|value| **value > threshold).count()
}

/// An orthonormal basis of the vectors that `matrix` maps to zero, one in each column.
pub(crate) fn null_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let columns = matrix.ncols();
    let mut square = DMatrix::zeros(matrix.nrows().max(columns), columns);
    square.rows_mut(0, matrix.nrows()).copy_from(matrix);
    let svd = SVD::new(square, false, true);
    let threshold = svd.singular_values.max() * RANK_TOLERANCE;
    let Some(v_t) = svd.v_t else { return DMatrix::zeros(columns, 0) };
    let null: Vec<DVector<f64>> = (0..columns)
        .filter(|&index| svd.singular_values[index] <= threshold)
        .map(|index| v_t.row(index).transpose())
        .collect();
    if null.is_empty() { DMatrix::zeros(columns, 0) } else { DMatrix::from_columns(&null) }
}

/// The motions that the joints leave, one in each column: (x, y, angle) of every body in m and rad.
pub(crate) fn free_motions(mechanism: &Mechanism, configuration: &Configuration) -> DMatrix<f64> {
    let mut motions = null_space(&JointEquations::of_joints(mechanism, &configuration.poses).jacobian);
    for (row, mut motion) in motions.row_iter_mut().enumerate() {
        if row % 3 != 2 {
            motion *= mechanism.size;
        }
    }
    motions
}

/// A motion of the bodies, (x, y, angle) of each: "rod rotates about (0.1, 0.2), block moves along (1, 0)".
pub(crate) fn motion_in_words(
    mechanism: &Mechanism,
    configuration: &Configuration,
    motion: &DVector<f64>,
) -> String {
    let size = mechanism.size;
    let scale = (0..mechanism.bodies.len())
        .map(|b| motion[3 * b].hypot(motion[3 * b + 1]).max(size * motion[3 * b + 2].abs()))
        .fold(0.0, f64::max);
    let mut parts = Vec::new();
    for (index, body) in mechanism.bodies.iter().enumerate() {
        let velocity = Vector2::new(motion[3 * index], motion[3 * index + 1]);
        let angular = motion[3 * index + 2];
        if angular.abs() * size > 1e-6 * scale {
            // The pole: the point that stays at rest, c + rot90(v)/omega.
            let pole = configuration.poses[index].position + rot90(velocity) / angular;
            parts.push(format!("{} rotates about {}", body.name, components(pole, size)));
        } else if velocity.norm() > 1e-6 * scale {
            parts.push(format!("{} moves along {}", body.name, components(velocity.normalize(), 1.0)));
        }
    }
    parts.join(", ")
}

/// "(0.1, 0.2)", with rounding errors against `scale` as 0.
fn components(vector: Vector2<f64>, scale: f64) -> String {
    let rounded = |value: f64| {
        let text = format!("{:.4}", if value.abs() < 1e-9 * scale { 0.0 } else { value });
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    format!("({}, {})", rounded(vector.x), rounded(vector.y))
}

/// The joints that take part in a state of self-stress: in a combination of rows that vanishes.
fn joints_in_excess(equations: &JointEquations) -> Vec<JointId> {
    let stresses = null_space(&equations.jacobian.transpose());
    let mut joints: Vec<JointId> = (0..equations.joints.len())
        .filter(|&row| stresses.row(row).amax() > 1e-6)
        .filter_map(|row| equations.joints[row])
        .collect();
    joints.dedup();
    joints
}

/// A guided or block slider holds the angle of its block; a pin in a slot does not.
fn suggestion(mechanism: &Mechanism, joints: &[JointId]) -> Option<String> {
    let slider = joints
        .iter()
        .find(|joint| mechanism.slider(**joint).is_some_and(|slider| slider.kind != SliderKind::Pin))?;
    let kind = match &mechanism.joints[slider.index()].kind {
        JointKind::Slider(slider) if slider.kind == SliderKind::Guided => "guided slider",
        _ => "block slider",
    };
    let name = &mechanism.joints[slider.index()].name;
    Some(format!("for instance make {name} a pin in a slot in place of a {kind}"))
}

/// Whether the rank rises when the mechanism moves a little along its freedom.
fn is_singular_position(mechanism: &Mechanism, poses: &[Pose], rank_here: usize) -> bool {
    let jacobian = JointEquations::of_joints(mechanism, poses).jacobian;
    let motions = null_space(&jacobian);
    motions.column_iter().any(|motion| {
        let step = motion * PROBE;
        [1.0, -1.0].iter().any(|sign| {
            let mut poses = poses.to_vec();
            advance(mechanism, &mut poses, &(&step * *sign));
            close(mechanism, &mut poses);
            let equations = JointEquations::of_joints(mechanism, &poses);
            equations.residual.amax() < 1e-10 && rank(&equations.jacobian) > rank_here
        })
    })
}

/// Moves the poses by a vector of (x/size, y/size, angle) for every body.
pub(super) fn advance(mechanism: &Mechanism, poses: &mut [Pose], step: &DVector<f64>) {
    for (index, pose) in poses.iter_mut().enumerate() {
        pose.position.x += mechanism.size * step[3 * index];
        pose.position.y += mechanism.size * step[3 * index + 1];
        pose.angle += step[3 * index + 2];
    }
}

/// Closes the joints by Gauss-Newton steps of least norm.
fn close(mechanism: &Mechanism, poses: &mut [Pose]) {
    for _ in 0..20 {
        let equations = JointEquations::of_joints(mechanism, poses);
        if equations.residual.amax() < 1e-14 {
            return;
        }
        let step = least_squares(&equations.jacobian, &-equations.residual);
        advance(mechanism, poses, &step);
    }
}

/// The vector of least norm that comes closest to solving `matrix` x = `right_hand_side`.
pub(super) fn least_squares(matrix: &DMatrix<f64>, right_hand_side: &DVector<f64>) -> DVector<f64> {
    let svd = matrix.clone().svd(true, true);
    let threshold = svd.singular_values.max() * RANK_TOLERANCE;
    svd.solve(right_hand_side, threshold).unwrap_or_else(|_| DVector::zeros(matrix.ncols()))
}
