//! Rows of the acceleration constraints: G a = gamma, and the coordinates' C a = prescribed + bias.

use super::{Layout, Reaction};
use crate::configuration::{Configuration, ContactGeometry};
use crate::ids::{Frame, JointId};
use crate::interval::Real;
use crate::mechanism::{Attachment, CoordinateKind, JointKind, Mechanism, Slider, rot90};
use nalgebra::{DVector, Vector2};

/// One row: entries by the index of the acceleration, and the right-hand side.
#[derive(Debug, Clone)]
pub(super) struct ConstraintRow<T = f64> {
    pub(super) entries: Vec<(usize, T)>,
    pub(super) right_hand_side: T,
}

impl ConstraintRow {
    /// Scalar product with the vector of unknowns.
    pub(super) fn times(&self, unknowns: &DVector<f64>) -> f64 {
        self.entries.iter().map(|(index, value)| value * unknowns[*index]).sum()
    }
}

impl<T: Real> ConstraintRow<T> {
    fn empty() -> Self {
        Self { entries: Vec::new(), right_hand_side: T::zero() }
    }

    /// Adds sign * axis . (acceleration of the material point of `frame` at `place`).
    ///
    /// The acceleration is a_c + alpha x r - omega^2 r; its last term goes to the right-hand side.
    fn add(&mut self, configuration: &Configuration<T>, frame: Frame, place: Vector2<T>, axis: Vector2<T>) {
        let Some(body) = frame.body() else { return };
        let arm = configuration.arm(frame, place);
        let first = 3 * body.index();
        self.entries.push((first, axis.x));
        self.entries.push((first + 1, axis.y));
        self.entries.push((first + 2, axis.dot(&rot90(arm))));
        self.right_hand_side += configuration.angular_velocity(frame).square() * axis.dot(&arm);
    }

    /// Adds sign * (angular acceleration of `frame`).
    fn add_rotation(&mut self, frame: Frame, sign: T) {
        if let Some(body) = frame.body() {
            self.entries.push((3 * body.index() + 2, sign));
        }
    }
}

/// The rows of all reactions, in the order of the layout.
pub(super) fn constraints<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    contacts: &[ContactGeometry<T>],
    layout: &Layout,
) -> Vec<ConstraintRow<T>> {
    let row = |reaction: &Reaction| match *reaction {
        Reaction::Hinge(joint, axis) => hinge(mechanism, configuration, joint, axis),
        Reaction::Normal(contact) => {
            let joint = mechanism.contacts[contact.index()].joint;
            normal(mechanism, configuration, joint, &contacts[contact.index()])
        }
        Reaction::Couple(joint) => no_relative_rotation(mechanism, joint),
    };
    layout.reactions().iter().map(row).collect()
}

/// Both points of a hinge have the same acceleration.
fn hinge<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    joint: JointId,
    axis: usize,
) -> ConstraintRow<T> {
    let mut row = ConstraintRow::empty();
    if let JointKind::Hinge([first, second]) = &mechanism.joints[joint.index()].kind {
        let axis = if axis == 0 { Vector2::x() } else { Vector2::y() };
        row.add(configuration, first.frame, configuration.position(mechanism, first), axis);
        row.add(configuration, second.frame, configuration.position(mechanism, second), -axis);
    }
    row
}

/// The block's material point stays on the line of the guide: n . (a_block - a_guide) = 2 omega_guide ds.
///
/// A contact that is carried by the guide stays on a line of the block; block and guide turn together there, so
/// that the row is the same.
fn normal<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    joint: JointId,
    contact: &ContactGeometry<T>,
) -> ConstraintRow<T> {
    let mut row = ConstraintRow::empty();
    if let Some(slider) = mechanism.slider(joint) {
        row.add(configuration, slider.block, contact.point, contact.normal);
        row.add(configuration, slider.guide, contact.point, -contact.normal);
        row.right_hand_side +=
            T::exactly(2.0) * configuration.angular_velocity(slider.guide) * contact.sliding_velocity;
    }
    row
}

fn no_relative_rotation<T: Real>(mechanism: &Mechanism<T>, joint: JointId) -> ConstraintRow<T> {
    let mut row = ConstraintRow::empty();
    if let Some(slider) = mechanism.slider(joint) {
        row.add_rotation(slider.block, T::one());
        row.add_rotation(slider.guide, -T::one());
    }
    row
}

/// The row that gives the acceleration of sliding, s'' = u . (a_block - a_guide), both at the place of the block: the
/// Coriolis term is normal to u.
pub(super) fn sliding<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    slider: &Slider<T>,
) -> ConstraintRow<T> {
    let mut row = ConstraintRow::empty();
    let slide = configuration.slide(mechanism, slider);
    let at = Attachment { frame: slider.block, position: slider.at };
    let place = configuration.position(mechanism, &at);
    row.add(configuration, slider.block, place, slide.tangent);
    row.add(configuration, slider.guide, place, -slide.tangent);
    row
}

/// The rows that give the accelerations of the coordinates: C a - right-hand side.
pub(super) fn coordinates<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
) -> Vec<ConstraintRow<T>> {
    let row = |kind: CoordinateKind<T>| {
        let mut row = ConstraintRow::empty();
        match kind {
            CoordinateKind::Slide(joint) => {
                if let Some(slider) = mechanism.slider(joint) {
                    row = sliding(mechanism, configuration, slider);
                }
            }
            CoordinateKind::Rotation(body, against) => {
                row.add_rotation(Frame::Body(body), T::one());
                row.add_rotation(against, -T::one());
            }
            CoordinateKind::Displacement(point, axis) => {
                row.add(configuration, point.frame, configuration.position(mechanism, &point), axis);
            }
        }
        row
    };
    mechanism.coordinates.iter().map(|coordinate| row(coordinate.kind)).collect()
}
