//! The joint equations: their residuals at given poses, and their Jacobian.
//!
//! A hinge gives two equations (its two points coincide), a block or guided slider two (the middle of the
//! block stays on the guide's centre line; no relative rotation), a pin in a slot or a disc on a disc one, and what sticks one
//! more, behind all others. Rows of length are divided by the size of the mechanism, and displacements are counted in it, so
//! that all numbers are of order one.

use super::curvature::{Angle, Curvature, End};
use super::{Pose, middle_points, moved, round_ends, turned};
use crate::ids::{Frame, JointId};
use crate::interval::Real;
use crate::mechanism::{Attachment, CoordinateKind, JointKind, Mechanism, Slider, length, rot90};
use crate::model::{Round, SliderKind};
use nalgebra::{DMatrix, DVector, Vector2};

/// One scalar equation: its residual and its derivatives with respect to the poses.
struct Row<T> {
    joint: Option<JointId>,
    is_angle: bool,
    residual: T,
    derivatives: Vec<(usize, T)>,
}

/// The joint equations, and below them those that fix the coordinates.
pub(crate) struct JointEquations<T = f64> {
    /// The joint of each row; nothing for the rows of coordinates.
    pub(crate) joints: Vec<Option<JointId>>,
    /// Whether the residual of a row is an angle.
    pub(crate) are_angles: Vec<bool>,
    /// Residuals (lengths divided by the size of the mechanism, angles in rad).
    pub(crate) residual: DVector<T>,
    /// Derivatives with respect to (x/size, y/size, angle) of every body.
    pub(crate) jacobian: DMatrix<T>,
}

impl<T: Real> JointEquations<T> {
    /// The joint equations alone, with those that redundant guides have in excess.
    pub(crate) fn of_joints(mechanism: &Mechanism<T>, poses: &[Pose<T>]) -> Self {
        let mut rows = Rows { left_out: &[], ..Rows::new(mechanism, poses) };
        rows.joints();
        rows.assemble()
    }

    /// The joint equations that say something new, and one for each coordinate, which wants the given value.
    pub(crate) fn with_coordinates(mechanism: &Mechanism<T>, poses: &[Pose<T>], values: &[T]) -> Self {
        let mut rows = Rows::new(mechanism, poses);
        rows.joints();
        rows.coordinates(values);
        rows.assemble()
    }
}

impl JointEquations {
    /// [`Self::with_coordinates`], and how these equations bend.
    pub(super) fn with_curvature(mechanism: &Mechanism, poses: &[Pose], values: &[f64]) -> (Self, Curvature) {
        let curvature = Some(Curvature::default());
        let mut rows = Rows { curvature, ..Rows::new(mechanism, poses) };
        rows.joints();
        rows.coordinates(values);
        let curvature = rows.curvature.take().unwrap_or_default();
        (rows.assemble(), curvature)
    }
}

struct Rows<'m, T> {
    mechanism: &'m Mechanism<T>,
    poses: &'m [Pose<T>],
    list: Vec<Row<T>>,
    /// The joint equations that are left out, and how many have been met.
    left_out: &'m [usize],
    met: usize,
    /// How the rows bend, if that is asked for.
    curvature: Option<Curvature>,
}

impl<'m, T: Real> Rows<'m, T> {
    fn new(mechanism: &'m Mechanism<T>, poses: &'m [Pose<T>]) -> Self {
        let left_out = &mechanism.excess.rows;
        Self { mechanism, poses, list: Vec::new(), left_out, met: 0, curvature: None }
    }

    /// Whether the next row, of a joint or of a coordinate, is left out.
    fn leaves_out(&mut self, joint: Option<JointId>) -> bool {
        let row = self.met;
        self.met += usize::from(joint.is_some());
        joint.is_some() && self.left_out.contains(&row)
    }

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
        for (joint, slider) in self.mechanism.sticking() {
            match &slider.round {
                None => self.sticks(joint, slider),
                Some(round) => self.rolls(joint, slider, round),
            }
        }
    }

    /// Row of a contact that does not slip on a straight face: `u . (block - guide) + R (angle of the block - angle of the guide)` is as drawn.
    fn sticks(&mut self, joint: JointId, slider: &Slider<T>) {
        let [block, guide] = middle_points(slider);
        let before = self.list.len();
        self.distance(Some(joint), [&block, &guide], self.direction(slider), Some(slider.guide));
        let rim = slider.rim() / self.size();
        let turned = self.angle(slider.block) - self.angle(slider.guide);
        if let Some(row) = self.list.get_mut(before) {
            row.residual += rim * turned;
            add_angle(row, slider.block, rim);
            add_angle(row, slider.guide, -rim);
        }
    }

    /// A disc that rolls on a disc: the line between both centres has turned by `psi = (R_B theta_B + R_A theta_A)/(R_B + R_A)`,
    /// with a negative `R_A` of a hole. With the drawn line turned so, `rot90(line) . (C_B - C_A)` vanishes.
    fn rolls(&mut self, joint: JointId, slider: &Slider<T>, round: &Round<T>) {
        if self.leaves_out(Some(joint)) {
            return;
        }
        let radii = [slider.rim(), if round.inside { -round.radius } else { round.radius }];
        let parts = radii.map(|radius| radius / (radii[0] + radii[1]));
        let ends = round_ends(slider, round);
        let psi =
            ends.iter().zip(parts).fold(T::zero(), |psi, (end, part)| psi + part * self.angle(end.frame));
        let drawn = ends[0].position - ends[1].position;
        let axis = rot90(Pose::new(Vector2::zeros(), psi).turned(drawn / length(drawn)));
        let places = ends.each_ref().map(|end| moved(self.mechanism, self.poses, end));
        let between = places[0] - places[1];
        let residual = axis.dot(&between) / self.size();
        let mut row = Row { joint: Some(joint), is_angle: false, residual, derivatives: Vec::new() };
        for ((end, place), sign) in ends.iter().zip(places).zip([T::one(), -T::one()]) {
            self.follow(&mut row, (end.frame, place), axis * sign);
        }
        for (end, part) in ends.iter().zip(parts) {
            add_angle(&mut row, end.frame, part * rot90(axis).dot(&between) / self.size());
        }
        let (index, origins) = (self.list.len(), [0, 1].map(|end| self.origin(ends[end].frame, places[end])));
        let arms = [0, 1].map(|end| self.end(ends[end].frame, places[end]));
        let scaled = (origins[0] - origins[1]).map(|part| part.middle() / self.mechanism.size);
        let turning = Angle::sum([0, 1].map(|end| (ends[end].frame, parts[end].middle())));
        if let Some(curvature) = &mut self.curvature {
            curvature.along_turning(index, arms, turning, (axis.map(Real::middle), scaled));
        }
        self.list.push(row);
    }

    fn slider(&mut self, joint: Option<JointId>, slider: &Slider<T>) {
        if slider.contacts.is_empty() {
            return;
        }
        if let Some(round) = &slider.round {
            return self.round(joint, round_ends(slider, round));
        }
        let normal = rot90(self.direction(slider));
        let [block, guide] = middle_points(slider);
        self.distance(joint, [&block, &guide], normal, Some(slider.guide));
        if slider.kind != SliderKind::Pin && !self.leaves_out(joint) {
            let residual = self.angle(slider.block) - self.angle(slider.guide);
            let mut row = Row { joint, is_angle: true, residual, derivatives: Vec::new() };
            add_angle(&mut row, slider.block, T::one());
            add_angle(&mut row, slider.guide, -T::one());
            self.list.push(row);
        }
    }

    /// Two centres keep their distance: `(|d|^2 - r^2)/(2 r)` with `d` between them, and `r` in the drawing.
    fn round(&mut self, joint: Option<JointId>, ends: [Attachment<T>; 2]) {
        if self.leaves_out(joint) {
            return;
        }
        let size = self.size();
        let places = ends.each_ref().map(|end| moved(self.mechanism, self.poses, end));
        let between = places[0] - places[1];
        let drawn = length(ends[0].position - ends[1].position);
        let longer = between.x.square() + between.y.square() - drawn.square();
        let residual = longer / (drawn * size * T::exactly(2.0));
        let mut row = Row { joint, is_angle: false, residual, derivatives: Vec::new() };
        let axis = between / drawn;
        for (end, place, sign) in [(&ends[0], places[0], T::one()), (&ends[1], places[1], -T::one())] {
            self.follow(&mut row, (end.frame, place), axis * sign);
        }
        let ends = [(&ends[0], places[0]), (&ends[1], places[1])];
        let (index, between) = (self.list.len(), between.map(|part| part.middle() / self.mechanism.size));
        let arms = ends.map(|(end, place)| self.end(end.frame, place));
        if let Some(curvature) = &mut self.curvature {
            curvature.around(index, arms, (between, drawn.middle() / self.mechanism.size));
        }
        self.list.push(row);
    }

    /// Adds the derivatives of a place of a frame along an axis.
    fn follow(&self, row: &mut Row<T>, (frame, place): (Frame, Vector2<T>), axis: Vector2<T>) {
        let Some(body) = frame.body() else { return };
        let arm = place - self.poses[body.index()].position;
        row.derivatives.push((3 * body.index(), axis.x));
        row.derivatives.push((3 * body.index() + 1, axis.y));
        row.derivatives.push((3 * body.index() + 2, axis.dot(&rot90(arm)) / self.size()));
    }

    /// A place of a frame, with its arm in sizes of the mechanism.
    fn end(&self, frame: Frame, place: Vector2<T>) -> End {
        let arm = place - self.origin(frame, place);
        End { frame, arm: arm.map(|part| part.middle() / self.mechanism.size) }
    }

    /// The centre of mass of a frame; of ground the place itself.
    fn origin(&self, frame: Frame, place: Vector2<T>) -> Vector2<T> {
        frame.body().map_or(place, |body| self.poses[body.index()].position)
    }

    fn coordinates(&mut self, values: &[T]) {
        for (coordinate, value) in self.mechanism.coordinates.iter().zip(values) {
            let wanted = *value - coordinate.drawn_at;
            match coordinate.kind {
                CoordinateKind::Slide(joint) => {
                    if let Some(slider) = self.mechanism.slider(joint) {
                        let [block, guide] = middle_points(slider);
                        self.distance(None, [&block, &guide], self.direction(slider), Some(slider.guide));
                        self.want(wanted / self.size());
                    }
                }
                CoordinateKind::Rotation(body, against) => {
                    let residual = self.angle(Frame::Body(body)) - self.angle(against);
                    let mut row = Row { joint: None, is_angle: true, residual, derivatives: Vec::new() };
                    add_angle(&mut row, Frame::Body(body), T::one());
                    add_angle(&mut row, against, -T::one());
                    self.list.push(row);
                    self.want(wanted);
                }
                CoordinateKind::Displacement(point, axis) => {
                    let drawn = Attachment { frame: Frame::Ground, ..point };
                    self.distance(None, [&point, &drawn], axis, None);
                    self.want(wanted / self.size());
                }
            }
        }
    }

    fn want(&mut self, value: T) {
        if let Some(row) = self.list.last_mut() {
            row.residual -= value;
        }
    }

    /// axis . (first - second), with an axis that may turn with a frame.
    fn distance(
        &mut self,
        joint: Option<JointId>,
        [first, second]: [&Attachment<T>; 2],
        axis: Vector2<T>,
        axis_frame: Option<Frame>,
    ) {
        if self.leaves_out(joint) {
            return;
        }
        let size = self.size();
        let places = [first, second].map(|point| moved(self.mechanism, self.poses, point));
        let between = places[0] - places[1];
        let residual = axis.dot(&between) / size;
        let mut row = Row { joint, is_angle: false, residual, derivatives: Vec::new() };
        for (point, place, sign) in [(first, places[0], T::one()), (second, places[1], -T::one())] {
            self.follow(&mut row, (point.frame, place), axis * sign);
        }
        // d(axis)/d(angle) = rot90(axis)
        if let Some(body) = axis_frame.and_then(Frame::body) {
            row.derivatives.push((3 * body.index() + 2, rot90(axis).dot(&between) / size));
        }
        self.bend([(first, places[0]), (second, places[1])], axis, axis_frame);
        self.list.push(row);
    }

    /// Notes how the next row bends: the distance of two ends along an axis, which may turn with the frame of
    /// the second.
    fn bend(&mut self, ends: [(&Attachment<T>, Vector2<T>); 2], axis: Vector2<T>, axis_frame: Option<Frame>) {
        let (row, size) = (self.list.len(), self.mechanism.size);
        let arms = ends.map(|(point, place)| self.end(point.frame, place));
        let from = self.origin(ends[0].0.frame, ends[0].1);
        let Some(curvature) = &mut self.curvature else { return };
        let axis = axis.map(Real::middle);
        match axis_frame.and_then(Frame::body) {
            None => curvature.along_fixed_axis(row, arms, axis),
            Some(guide) => {
                let between = from - self.poses[guide.index()].position;
                let scaled = between.map(|part| part.middle() / size);
                // The arm of the guide turns with the axis.
                let ends = [arms[0], End { frame: Frame::Body(guide), arm: Vector2::zeros() }];
                curvature.along_turning(
                    row,
                    ends,
                    Angle::sum([(ends[1].frame, 1.0), (Frame::Ground, 0.0)]),
                    (axis, scaled),
                );
            }
        }
    }

    fn size(&self) -> T {
        T::exactly(self.mechanism.size)
    }

    fn angle(&self, frame: Frame) -> T {
        frame.body().map_or(T::zero(), |body| self.poses[body.index()].angle)
    }

    fn direction(&self, slider: &Slider<T>) -> Vector2<T> {
        turned(self.poses, slider.guide, slider.tangent)
    }

    fn assemble(self) -> JointEquations<T> {
        let mut jacobian = DMatrix::zeros(self.list.len(), 3 * self.poses.len());
        let mut residual = DVector::zeros(self.list.len());
        for (index, row) in self.list.iter().enumerate() {
            residual[index] = row.residual;
            for &(column, derivative) in &row.derivatives {
                jacobian[(index, column)] += derivative;
            }
        }
        let joints = self.list.iter().map(|row| row.joint).collect();
        let are_angles = self.list.iter().map(|row| row.is_angle).collect();
        JointEquations { joints, are_angles, residual, jacobian }
    }
}

fn add_angle<T>(row: &mut Row<T>, frame: Frame, derivative: T) {
    if let Some(body) = frame.body() {
        row.derivatives.push((3 * body.index() + 2, derivative));
    }
}
