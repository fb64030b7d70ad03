//! The joint equations: their residuals at given poses, and their Jacobian.
//!
//! A hinge gives two equations (its two points coincide), a block or guided slider two (the middle of the block
//! stays on the guide's centre line; no relative rotation), a pin in a slot one. Rows of length are divided by
//! the size of the mechanism, and displacements are counted in it, so that all numbers are of order one.

use super::{Pose, middle_points, moved, turned};
use crate::ids::{Frame, JointId};
use crate::mechanism::{Attachment, CoordinateKind, JointKind, Mechanism, Slider, rot90};
use crate::model::SliderKind;
use nalgebra::{DMatrix, DVector, Vector2};

/// One scalar equation: its residual and its derivatives with respect to the poses.
struct Row {
    joint: Option<JointId>,
    residual: f64,
    derivatives: Vec<(usize, f64)>,
}

/// The joint equations, and below them those that fix the coordinates.
pub(super) struct JointEquations {
    /// The joint of each row; nothing for the rows of coordinates.
    pub(super) joints: Vec<Option<JointId>>,
    /// Residuals (lengths divided by the size of the mechanism, angles in rad).
    pub(super) residual: DVector<f64>,
    /// Derivatives with respect to (x/size, y/size, angle) of every body.
    pub(super) jacobian: DMatrix<f64>,
}

impl JointEquations {
    /// The joint equations alone.
    pub(super) fn of_joints(mechanism: &Mechanism, poses: &[Pose]) -> Self {
        let mut rows = Rows { mechanism, poses, list: Vec::new() };
        rows.joints();
        rows.assemble()
    }

    /// The joint equations and one for each coordinate, which wants the given value.
    pub(super) fn with_coordinates(mechanism: &Mechanism, poses: &[Pose], values: &[f64]) -> Self {
        let mut rows = Rows { mechanism, poses, list: Vec::new() };
        rows.joints();
        rows.coordinates(values);
        rows.assemble()
    }
}

struct Rows<'m> {
    mechanism: &'m Mechanism,
    poses: &'m [Pose],
    list: Vec<Row>,
}

impl Rows<'_> {
    fn joints(&mut self) {
        for (index, joint) in self.mechanism.joints.iter().enumerate() {
            let id = Some(JointId(index));
            match &joint.kind {
                JointKind::Hinge([first, second]) => {
                    for axis in [Vector2::x(), Vector2::y()] {
                        self.distance(id, [first, second], axis, None);
                    }
                }
                JointKind::Slider(slider) => self.slider(id, slider),
            }
        }
    }

    fn slider(&mut self, joint: Option<JointId>, slider: &Slider) {
        let normal = rot90(self.direction(slider));
        let [block, guide] = middle_points(slider);
        self.distance(joint, [&block, &guide], normal, Some(slider.guide));
        if slider.kind != SliderKind::Pin {
            let residual = self.angle(slider.block) - self.angle(slider.guide);
            let mut row = Row { joint, residual, derivatives: Vec::new() };
            add_angle(&mut row, slider.block, 1.0);
            add_angle(&mut row, slider.guide, -1.0);
            self.list.push(row);
        }
    }

    fn coordinates(&mut self, values: &[f64]) {
        for (coordinate, value) in self.mechanism.coordinates.iter().zip(values) {
            let wanted = value - coordinate.drawn_at;
            match coordinate.kind {
                CoordinateKind::Slide(joint) => {
                    if let Some(slider) = self.mechanism.slider(joint) {
                        let [block, guide] = middle_points(slider);
                        self.distance(None, [&block, &guide], self.direction(slider), Some(slider.guide));
                        self.want(wanted / self.mechanism.size);
                    }
                }
                CoordinateKind::Rotation(body, against) => {
                    let residual = self.angle(Frame::Body(body)) - self.angle(against);
                    let mut row = Row { joint: None, residual, derivatives: Vec::new() };
                    add_angle(&mut row, Frame::Body(body), 1.0);
                    add_angle(&mut row, against, -1.0);
                    self.list.push(row);
                    self.want(wanted);
                }
                CoordinateKind::Displacement(point, axis) => {
                    let drawn = Attachment { frame: Frame::Ground, position: point.position };
                    self.distance(None, [&point, &drawn], axis, None);
                    self.want(wanted / self.mechanism.size);
                }
            }
        }
    }

    fn want(&mut self, value: f64) {
        if let Some(row) = self.list.last_mut() {
            row.residual -= value;
        }
    }

    /// axis . (first - second), with an axis that may turn with a frame.
    fn distance(
        &mut self,
        joint: Option<JointId>,
        [first, second]: [&Attachment; 2],
        axis: Vector2<f64>,
        axis_frame: Option<Frame>,
    ) {
        let size = self.mechanism.size;
        let places = [first, second].map(|point| moved(self.mechanism, self.poses, point));
        let between = places[0] - places[1];
        let mut row = Row { joint, residual: axis.dot(&between) / size, derivatives: Vec::new() };
        for (point, place, sign) in [(first, places[0], 1.0), (second, places[1], -1.0)] {
            if let Some(body) = point.frame.body() {
                let arm = place - self.poses[body.index()].position;
                row.derivatives.push((3 * body.index(), sign * axis.x));
                row.derivatives.push((3 * body.index() + 1, sign * axis.y));
                row.derivatives.push((3 * body.index() + 2, sign * axis.dot(&rot90(arm)) / size));
            }
        }
        // d(axis)/d(angle) = rot90(axis)
        if let Some(body) = axis_frame.and_then(Frame::body) {
            row.derivatives.push((3 * body.index() + 2, rot90(axis).dot(&between) / size));
        }
        self.list.push(row);
    }

    fn angle(&self, frame: Frame) -> f64 {
        frame.body().map_or(0.0, |body| self.poses[body.index()].angle)
    }

    fn direction(&self, slider: &Slider) -> Vector2<f64> {
        turned(self.angle(slider.guide), slider.tangent)
    }

    fn assemble(self) -> JointEquations {
        let mut jacobian = DMatrix::zeros(self.list.len(), 3 * self.poses.len());
        let mut residual = DVector::zeros(self.list.len());
        for (index, row) in self.list.iter().enumerate() {
            residual[index] = row.residual;
            for &(column, derivative) in &row.derivatives {
                jacobian[(index, column)] += derivative;
            }
        }
        JointEquations { joints: self.list.iter().map(|row| row.joint).collect(), residual, jacobian }
    }
}

fn add_angle(row: &mut Row, frame: Frame, derivative: f64) {
    if let Some(body) = frame.body() {
        row.derivatives.push((3 * body.index() + 2, derivative));
    }
}
