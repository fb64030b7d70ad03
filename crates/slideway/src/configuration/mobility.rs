//! Degrees of freedom and determinacy: rank of the joint equations, which joints are in excess, which bodies
//! a set of coordinates leaves free.

use super::joint_equations::JointEquations;
use super::{Configuration, Pose};
use crate::dense::singular_values;
use crate::fault::FaultKind;
use crate::ids::JointId;
use crate::interval::Real;
use crate::mechanism::{JointKind, Mechanism, rot90};
use crate::model::SliderKind;
use nalgebra::{DMatrix, DVector, SymmetricEigen, Vector2};

/// Singular values below this multiple of the greatest count as zero.
pub(super) const RANK_TOLERANCE: f64 = 1e-9;
/// Length of the step, in sizes of the mechanism or rad, that tells what is so in this position alone: a singular
/// position from a redundant structure, a joint that just stops sliding from one that never slides.
pub(crate) const PROBE: f64 = 1e-2;
/// Kinetic energies below this multiple of the greatest count as none.
const NO_INERTIA: f64 = 1e-12;
/// Steps of the iteration for kinetic energies, for each motion: some two are usual.
const STEPS_FOR_EACH: usize = 40;

/// How a mechanism can move, and whether its reactions are determinate.
#[derive(Debug, Clone, PartialEq)]
pub struct Mobility {
    /// Coordinates of all bodies: 3 b.
    pub(crate) body_coordinates: usize,
    /// Scalar joint equations.
    pub(crate) constraints: usize,
    /// How many of them are independent: the rank of their Jacobian.
    pub(crate) independent: usize,
    /// Joint equations in excess; `None` if there are none.
    pub(crate) redundancy: Option<Redundancy>,
}

/// Joint equations in excess.
#[derive(Debug, Clone, PartialEq)]
pub struct Redundancy {
    /// The joints among which the excess lies.
    pub(crate) joints: Vec<JointId>,
    /// Proposed change that would make the structure determinate, in words, if one of the joints offers it.
    pub(crate) suggestion: Option<String>,
    /// Whether the excess vanishes in a neighbouring position: the position is singular, not the structure.
    pub(crate) only_here: bool,
}

impl Mobility {
    /// Mobility of a mechanism in a configuration.
    pub fn of(mechanism: &Mechanism, configuration: &Configuration) -> Self {
        Self::within(mechanism, configuration, RANK_TOLERANCE)
    }

    /// Mobility where singular values below this multiple of the greatest count as zero.
    pub(super) fn within(mechanism: &Mechanism, configuration: &Configuration, tolerance: f64) -> Self {
        let equations = JointEquations::of_joints(mechanism, &configuration.poses);
        let (constraints, body_coordinates) = equations.jacobian.shape();
        let independent = rank(&equations.jacobian, tolerance);
        let redundancy = (independent < constraints).then(|| {
            let joints = joints_in_excess(&equations, tolerance);
            let only_here = is_singular_position(mechanism, &configuration.poses, independent);
            let suggestions = [
                suggestion(mechanism, &equations, &joints, independent),
                block_sliders_instead(mechanism, &joints),
            ];
            let suggestions: Vec<String> = suggestions.into_iter().flatten().collect();
            let suggestion = (!only_here && !suggestions.is_empty()).then(|| suggestions.join("; "));
            Redundancy { joints, suggestion, only_here }
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

    /// The fault that a redundancy is, if there is one that guides do not share.
    pub fn fault(&self, mechanism: &Mechanism) -> Option<FaultKind> {
        let is_shared = self.excess() == mechanism.excess.rows.len()
            && self.redundancy.as_ref().is_some_and(|redundancy| !redundancy.only_here);
        if is_shared { None } else { self.fault_without_sharing(mechanism) }
    }

    /// The fault that a redundancy is where nothing gives way to it.
    pub(super) fn fault_without_sharing(&self, mechanism: &Mechanism) -> Option<FaultKind> {
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

/// Number of singular values above this multiple of the greatest.
pub(super) fn rank(matrix: &DMatrix<f64>, tolerance: f64) -> usize {
    let Some(found) = singular_values(matrix, [false; 2]) else { return 0 };
    let threshold = found.singular_values.max() * tolerance;
    found.singular_values.iter().filter(|value| **value > threshold).count()
}

/// The least singular value as a part of the greatest.
pub(super) fn regularity(matrix: &DMatrix<f64>) -> f64 {
    singular_values(matrix, [false; 2])
        .map_or(0.0, |found| found.singular_values.min() / found.singular_values.max())
}

/// An orthonormal basis of the vectors that `matrix` maps to zero, one in each column.
pub(crate) fn null_space(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    null_space_within(matrix, RANK_TOLERANCE)
}

/// [`null_space`] where singular values below this multiple of the greatest count as zero.
pub(super) fn null_space_within(matrix: &DMatrix<f64>, tolerance: f64) -> DMatrix<f64> {
    let columns = matrix.ncols();
    let mut square = DMatrix::zeros(matrix.nrows().max(columns), columns);
    square.rows_mut(0, matrix.nrows()).copy_from(matrix);
    let Some(mut found) = singular_values(&square, [false, true]) else { return DMatrix::zeros(columns, 0) };
    found.sort_by_singular_values();
    let threshold = found.singular_values.max() * tolerance;
    let Some(v_t) = found.v_t else { return DMatrix::zeros(columns, 0) };
    let null: Vec<DVector<f64>> = (0..columns)
        .filter(|&index| found.singular_values[index] <= threshold)
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

/// A motion of the bodies, (x, y, angle) of each: "rod rotates about (0.1, 0.2) m, block moves along (1, 0)".
pub(crate) fn motion_in_words(
    mechanism: &Mechanism,
    configuration: &Configuration,
    motion: &DVector<f64>,
) -> String {
    let size = mechanism.size;
    let scale = (0..mechanism.bodies.len())
        .map(|b| motion[3 * b].hypot(motion[3 * b + 1]).max(size * motion[3 * b + 2].abs()))
        .fold(0.0, f64::max);
    // "(0.1, 0.2)", with rounding errors against `scale` as 0.
    let shown = |vector: Vector2<f64>, scale: f64, si: &str| {
        let unit = mechanism.units.of(si);
        let [x, y] = [vector.x, vector.y]
            .map(|value| unit.number(if value.abs() < 1e-9 * scale { 0.0 } else { value }));
        unit.with(&format!("({x}, {y})"))
    };
    let mut parts = Vec::new();
    for (index, body) in mechanism.bodies.iter().enumerate() {
        let velocity = Vector2::new(motion[3 * index], motion[3 * index + 1]);
        let angular = motion[3 * index + 2];
        if angular.abs() * size > 1e-6 * scale {
            // The pole: the point that stays at rest, c + rot90(v)/omega.
            let pole = configuration.poses[index].position + rot90(velocity) / angular;
            parts.push(format!("{} rotates about {}", body.name, shown(pole, size, "m")));
        } else if velocity.norm() > 1e-6 * scale {
            parts.push(format!("{} moves along {}", body.name, shown(velocity.normalize(), 1.0, "")));
        }
    }
    parts.join(", ")
}

/// The joints that take part in a state of self-stress: in a combination of rows that vanishes.
fn joints_in_excess(equations: &JointEquations, tolerance: f64) -> Vec<JointId> {
    let stresses = null_space_within(&equations.jacobian.transpose(), tolerance);
    let mut joints: Vec<JointId> = (0..equations.joints.len())
        .filter(|&row| stresses.row(row).amax() > 1e-6)
        .filter_map(|row| equations.joints[row])
        .collect();
    joints.dedup();
    joints
}

/// At most so many changes are tried before none is suggested.
const CHANGES_TRIED: usize = 200;

/// A change of one or two joints.
#[derive(Clone, Copy)]
enum Change {
    /// A block or guided slider becomes a pin in a slot, which leaves the angle free.
    ToPin(JointId),
    /// The joint goes.
    Remove(JointId),
}

/// The first small change that makes the structure determinate and leaves its freedom as it is.
fn suggestion(
    mechanism: &Mechanism,
    equations: &JointEquations,
    joints: &[JointId],
    independent: usize,
) -> Option<String> {
    let turns =
        |joint: &JointId| mechanism.slider(*joint).is_some_and(|slider| slider.kind != SliderKind::Pin);
    let to_pin: Vec<Change> = joints.iter().copied().filter(turns).map(Change::ToPin).collect();
    let remove: Vec<Change> = joints.iter().copied().map(Change::Remove).collect();
    let single =
        |changes: &[Change]| -> Vec<Vec<Change>> { changes.iter().map(|change| vec![*change]).collect() };
    let pairs = |first: &[Change], second: &[Change]| -> Vec<Vec<Change>> {
        first.iter().flat_map(|a| second.iter().map(|b| vec![*a, *b])).collect()
    };
    // Pins rather than removals: they keep every support.
    let all = [
        single(&to_pin),
        pairs(&to_pin, &to_pin),
        single(&remove),
        pairs(&to_pin, &remove),
        pairs(&remove, &remove),
    ];
    let mut distinct =
        all.into_iter().flatten().filter(|changes| !matches!(changes[..], [a, b] if a.joint() == b.joint()));
    let changes = distinct.by_ref().take(CHANGES_TRIED).find(|changes| {
        let left = rows_left(equations, changes);
        left.nrows() == independent && rank(&left, RANK_TOLERANCE) == independent
    })?;
    let words: Vec<String> = changes.iter().map(|change| change.in_words(mechanism)).collect();
    Some(format!("for instance {}", words.join(", and ")))
}

/// Suggests block sliders in place of guided ones, which lock the rotation rigidly, so that the joints share
/// their load. If all joints are sliders, no self-stress is left without a contact: the rows of a block
/// slider's contacts are combinations of those of the guided one.
fn block_sliders_instead(mechanism: &Mechanism, joints: &[JointId]) -> Option<String> {
    let sliders = joints.iter().map(|joint| mechanism.slider(*joint)).collect::<Option<Vec<_>>>()?;
    let guided: Vec<String> = joints
        .iter()
        .zip(sliders)
        .filter(|(_, slider)| slider.kind == SliderKind::Guided)
        .map(|(joint, _)| mechanism.joints[joint.index()].name.to_string())
        .collect();
    let names = guided.join(" and ");
    (!guided.is_empty())
        .then(|| format!("block sliders instead of {names} share the load by play and stiffness"))
}

impl Change {
    fn joint(self) -> JointId {
        match self {
            Self::ToPin(joint) | Self::Remove(joint) => joint,
        }
    }

    fn in_words(self, mechanism: &Mechanism) -> String {
        let joint = &mechanism.joints[self.joint().index()];
        match (self, &joint.kind) {
            (Self::ToPin(_), JointKind::Slider(slider)) if slider.kind == SliderKind::Guided => {
                format!("make {} a pin in a slot instead of a guided slider", joint.name)
            }
            (Self::ToPin(_), _) => format!("make {} a pin in a slot instead of a block slider", joint.name),
            (Self::Remove(_), _) => format!("remove {}", joint.name),
        }
    }
}

/// The rows of the Jacobian that changes of some joints leave.
fn rows_left(equations: &JointEquations, changes: &[Change]) -> DMatrix<f64> {
    let left: Vec<_> = (0..equations.joints.len())
        .filter(|&row| {
            changes.iter().all(|change| {
                let of_joint = equations.joints[row] == Some(change.joint());
                // The angle is the second equation of a slider.
                let second = row > 0 && equations.joints[row - 1] == equations.joints[row];
                !of_joint || (matches!(change, Change::ToPin(_)) && !second)
            })
        })
        .map(|row| equations.jacobian.row(row))
        .collect();
    if left.is_empty() { DMatrix::zeros(0, equations.jacobian.ncols()) } else { DMatrix::from_rows(&left) }
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
            equations.residual.amax() < 1e-10 && rank(&equations.jacobian, RANK_TOLERANCE) > rank_here
        })
    })
}

/// A motion of the bodies, (x, y, angle) of each, or its opposite: that in which loads (N, N, N m of each) move it.
/// Of loads that do no work but for rounding it is the one whose greatest component is positive.
pub(crate) fn moved_by(motion: DVector<f64>, loads: &DVector<f64>) -> DVector<f64> {
    let (work, terms) = (loads.dot(&motion), loads.abs().dot(&motion.abs()));
    let forwards = if work.abs() > RANK_TOLERANCE * terms { work } else { motion[motion.icamax()] };
    if forwards < 0.0 { -motion } else { motion }
}

/// Returns whether every motion meets inertia, whatever the joints leave: that of the motions of [`free_motions`]
/// lies between the least and the greatest of the bodies.
pub(crate) fn every_motion_has_inertia(mechanism: &Mechanism) -> bool {
    let square = mechanism.size * mechanism.size;
    let inertia = || mechanism.bodies.iter().flat_map(|body| [square * body.mass, body.moment_of_inertia]);
    inertia().fold(f64::INFINITY, f64::min) > NO_INERTIA * inertia().fold(0.0, f64::max)
}

/// The motions among these, columns of (x, y, angle) of every body, that meet no inertia, in words: each in the
/// direction in which loads (N, N, N m of every body) move it.
pub(crate) fn motions_without_inertia(
    mechanism: &Mechanism,
    configuration: &Configuration,
    motions: &DMatrix<f64>,
    loads: &DVector<f64>,
) -> Vec<String> {
    let masses = mechanism.bodies.iter().flat_map(|body| [body.mass, body.mass, body.moment_of_inertia]);
    let masses = DVector::from_iterator(motions.nrows(), masses);
    let energy = motions.transpose() * DMatrix::from_diagonal(&masses) * motions;
    if energy.is_empty() {
        return Vec::new();
    }
    let steps = STEPS_FOR_EACH * motions.ncols();
    let Some(eigen) = SymmetricEigen::try_new(energy, f64::EPSILON, steps) else { return Vec::new() };
    let greatest = eigen.eigenvalues.amax();
    let without = (0..motions.ncols()).filter(|&index| eigen.eigenvalues[index] <= NO_INERTIA * greatest);
    let in_words = |index: usize| {
        let motion = moved_by(motions * eigen.eigenvectors.column(index), loads);
        motion_in_words(mechanism, configuration, &motion)
    };
    without.map(in_words).collect()
}

/// Moves the poses by a vector of (x/size, y/size, angle) for every body.
pub(crate) fn advance<T: Real>(mechanism: &Mechanism<T>, poses: &mut [Pose<T>], step: &DVector<T>) {
    let size = T::exactly(mechanism.size);
    for (index, pose) in poses.iter_mut().enumerate() {
        let moved = Vector2::new(step[3 * index], step[3 * index + 1]) * size;
        *pose = Pose::new(pose.position + moved, pose.angle + step[3 * index + 2]);
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
    let solved = singular_values(matrix, [true; 2]).and_then(|found| {
        let threshold = found.singular_values.max() * RANK_TOLERANCE;
        found.solve(right_hand_side, threshold).ok()
    });
    solved.unwrap_or_else(|| DVector::zeros(matrix.ncols()))
}
