//! Rows of the acceleration constraints: G a = gamma, and the coordinates' C a = prescribed + bias.

use super::{Layout, Reaction};
use crate::configuration::{Configuration, ContactGeometry};
use crate::ids::{Frame, JointId};
use crate::interval::Real;
use crate::mechanism::{Attachment, CoordinateKind, JointKind, Mechanism, Slider, length, rot90, tilting};
use crate::model::Round;
use crate::units::number::beside;
use nalgebra::{DVector, Vector2};

/// One row: entries by the index of the acceleration, and the right-hand side.
///
/// Its entries, times the velocities, are also the rate of what the row is about.
#[derive(Debug, Clone)]
pub(crate) struct ConstraintRow<T = f64> {
    pub(crate) entries: Vec<(usize, T)>,
    pub(crate) right_hand_side: T,
}

impl ConstraintRow {
    /// One of the unknowns itself.
    pub(crate) fn unknown(index: usize) -> Self {
        Self { entries: vec![(index, 1.0)], right_hand_side: 0.0 }
    }

    /// Scalar product with the vector of unknowns.
    pub(crate) fn times(&self, unknowns: &DVector<f64>) -> f64 {
        self.entries.iter().map(|(index, value)| value * unknowns[*index]).sum()
    }

    /// The acceleration of what the row is about, or what is `added` to it by forces: 0 where it is a rounding error beside those of
    /// the bodies that it is made of.
    pub(crate) fn acceleration(&self, unknowns: &DVector<f64>, added: bool) -> f64 {
        // Three of a body: along x and y, and of rotation.
        let of_body = |&(index, value): &(usize, f64)| match index % 3 {
            2 => value * unknowns[index],
            component => value * unknowns[index - component].hypot(unknowns[index - component + 1]),
        };
        let scale = self.entries.iter().map(|entry| of_body(entry).abs()).fold(0.0, f64::max);
        beside(self.times(unknowns) - if added { 0.0 } else { self.right_hand_side }, scale)
    }
}

impl<T: Real> ConstraintRow<T> {
    /// Nothing yet.
    pub(crate) fn empty() -> Self {
        Self { entries: Vec::new(), right_hand_side: T::zero() }
    }

    fn clear(&mut self) {
        self.entries.clear();
        self.right_hand_side = T::zero();
    }

    /// Replaces it by the row of a reaction.
    pub(crate) fn set_constraint(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        contacts: &[ContactGeometry<T>],
        reaction: Reaction,
    ) {
        self.clear();
        match reaction {
            Reaction::Hinge(joint, axis) => self.hinge(mechanism, configuration, joint, axis),
            Reaction::Normal(contact) => {
                let joint = mechanism.contacts[contact.index()].joint;
                self.normal(mechanism, configuration, joint, &contacts[contact.index()]);
            }
            Reaction::Couple(joint) => self.no_relative_rotation(mechanism, joint),
            Reaction::Carried(joint, component) => self.carried(mechanism, configuration, joint, component),
        }
    }

    /// Replaces it by the row that gives the acceleration of a coordinate: C a - right-hand side.
    pub(crate) fn set_coordinate(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        kind: CoordinateKind<T>,
    ) {
        self.clear();
        match kind {
            CoordinateKind::Slide(joint) => {
                if let Some(slider) = mechanism.slider(joint) {
                    self.add_sliding(mechanism, configuration, slider);
                }
            }
            CoordinateKind::Rotation(body, against) => {
                self.add_rotation(Frame::Body(body), T::one());
                self.add_rotation(against, -T::one());
            }
            CoordinateKind::Displacement(point, axis) => {
                let place = configuration.position(mechanism, &point);
                self.add(configuration, point.frame, place, axis);
                self.add_out((mechanism, configuration), point.frame, (place, point.z), (axis, T::zero()));
            }
        }
    }

    /// Replaces it by the row that gives the acceleration of sliding where a joint rubs.
    pub(crate) fn set_sliding(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        slider: &Slider<T>,
    ) {
        self.clear();
        let tangent = configuration.tangent(mechanism, slider);
        let place = middle(mechanism, configuration, slider) - rot90(tangent) * slider.rim();
        self.add_relative((mechanism, configuration), slider, (place, tangent));
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

    /// Both points of a hinge have the same acceleration.
    fn hinge(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        joint: JointId,
        axis: usize,
    ) {
        if let JointKind::Hinge([first, second]) = &mechanism.joints[joint.index()].kind {
            let axis = if axis == 0 { Vector2::x() } else { Vector2::y() };
            for (end, axis) in [(first, axis), (second, -axis)] {
                let place = configuration.position(mechanism, end);
                self.add(configuration, end.frame, place, axis);
                let state = (mechanism, configuration);
                self.add_out(state, end.frame, (place, end.z), (axis, T::zero()));
            }
        }
    }

    /// The block's material point stays on the line of the guide: n . (a_block - a_guide) = 2 omega_guide ds.
    ///
    /// A contact that is carried by the guide stays on a line of the block, whose rate of turning counts. Block and guide turn
    /// together, so that it is the same, unless the contact may lift off.
    pub(super) fn normal(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        joint: JointId,
        contact: &ContactGeometry<T>,
    ) {
        let Some(slider) = mechanism.slider(joint) else { return };
        self.add(configuration, slider.block, contact.point, contact.normal);
        let (place, along_z) = ((contact.point, contact.z), contact.along_z());
        let state = (mechanism, configuration);
        self.add_out(state, slider.block, place, (contact.normal, along_z));
        self.add_out(state, slider.guide, place, (-contact.normal, -along_z));
        if let Some(round) = &slider.round {
            return self.round(mechanism, configuration, (slider, round), contact);
        }
        self.add(configuration, slider.guide, contact.point, -contact.normal);
        let turning =
            T::exactly(2.0) * configuration.angular_velocity(contact.line_of) * contact.velocity_at_point;
        self.right_hand_side += contact.lean.map_or(turning, |[cos, _]| turning * cos);
    }

    /// What a joint carries out of the drawing: both bodies move along z alike there, or turn alike about an axis in the
    /// drawing.
    fn carried(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        joint: JointId,
        component: usize,
    ) {
        let joined = mechanism.joints[joint.index()].joined();
        for (frame, sign) in joined.frames.into_iter().zip([T::one(), -T::one()]) {
            let Some((first, _)) = mechanism.out_of_plane(frame) else { continue };
            if component == 0 {
                let (position, z) = joined.place;
                let place =
                    configuration.position(mechanism, &Attachment { frame: joined.frames[0], position, z });
                self.add_out((mechanism, configuration), frame, (place, z), (Vector2::zeros(), sign));
            } else {
                let axis = configuration.direction(joined.axes_of, joined.axes[component - 1]) * sign;
                self.entries.push((first + 1, axis.x));
                self.entries.push((first + 2, axis.y));
            }
        }
    }

    /// Adds what axis . (acceleration of the material point of `frame` at `place`) has by accelerations out of the plane.
    fn add_out(
        &mut self,
        (mechanism, configuration): (&Mechanism<T>, &Configuration<T>),
        frame: Frame,
        (place, z): (Vector2<T>, T),
        (axis, along_z): (Vector2<T>, T),
    ) {
        let Some((first, z_of_body)) = mechanism.out_of_plane(frame) else { return };
        let about = tilting((configuration.arm(frame, place), z - z_of_body), (axis, along_z));
        self.entries.push((first, along_z));
        self.entries.push((first + 1, about.x));
        self.entries.push((first + 2, about.y));
    }

    /// The centre of a disc stays at its distance from the centre of its round face: with v along u of one centre
    /// against the other, n . (a_block - a_guide) = -v^2/distance, or the opposite in a hole.
    fn round(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        (slider, round): (&Slider<T>, &Round<T>),
        contact: &ContactGeometry<T>,
    ) {
        let centre = configuration.position(mechanism, &slider.centre_of(round));
        self.add(configuration, slider.guide, centre, -contact.normal);
        let velocity = configuration.velocity_at(slider.block, contact.point)
            - configuration.velocity_at(slider.guide, centre);
        let turning = contact.tangent.dot(&velocity).square() / length(contact.point - centre);
        self.right_hand_side += if round.inside { turning } else { -turning };
    }

    fn no_relative_rotation(&mut self, mechanism: &Mechanism<T>, joint: JointId) {
        if let Some(slider) = mechanism.slider(joint) {
            self.add_rotation(slider.block, T::one());
            self.add_rotation(slider.guide, -T::one());
        }
    }

    /// The row that gives the acceleration of sliding, s'' = u . (a_block - a_guide), both at the place of
    /// the block: the Coriolis term is normal to u.
    fn add_sliding(
        &mut self,
        mechanism: &Mechanism<T>,
        configuration: &Configuration<T>,
        slider: &Slider<T>,
    ) {
        let tangent = configuration.direction(slider.guide, slider.tangent);
        let place = middle(mechanism, configuration, slider);
        self.add_relative((mechanism, configuration), slider, (place, tangent));
    }

    /// The acceleration of the block against the guide at a place, along an axis.
    fn add_relative(
        &mut self,
        (mechanism, configuration): (&Mechanism<T>, &Configuration<T>),
        slider: &Slider<T>,
        (place, axis): (Vector2<T>, Vector2<T>),
    ) {
        for (frame, axis) in [(slider.block, axis), (slider.guide, -axis)] {
            self.add(configuration, frame, place, axis);
            self.add_out((mechanism, configuration), frame, (place, slider.z), (axis, T::zero()));
        }
    }
}

/// Where the middle of a block is.
fn middle<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    slider: &Slider<T>,
) -> Vector2<T> {
    configuration.position(mechanism, &Attachment { frame: slider.block, position: slider.at, z: slider.z })
}

/// The row of the acceleration of sliding of a joint where it rubs, which is the rim of a disc: the normal accelerations of both
/// bodies from its centre to its rim are normal to u, and so is Coriolis'.
pub(crate) fn sliding<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    slider: &Slider<T>,
) -> ConstraintRow<T> {
    let mut row = ConstraintRow::empty();
    row.set_sliding(mechanism, configuration, slider);
    row
}

/// The rows of all reactions, in the order of the layout.
pub(super) fn constraints<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
    contacts: &[ContactGeometry<T>],
    layout: &Layout,
) -> Vec<ConstraintRow<T>> {
    let row = |reaction: &Reaction| {
        let mut row = ConstraintRow::empty();
        row.set_constraint(mechanism, configuration, contacts, *reaction);
        row
    };
    layout.reactions().iter().map(row).collect()
}

/// The rows that give the accelerations of the coordinates: C a - right-hand side.
pub(crate) fn coordinates<T: Real>(
    mechanism: &Mechanism<T>,
    configuration: &Configuration<T>,
) -> Vec<ConstraintRow<T>> {
    let row = |kind: CoordinateKind<T>| {
        let mut row = ConstraintRow::empty();
        row.set_coordinate(mechanism, configuration, kind);
        row
    };
    mechanism.coordinates.iter().map(|coordinate| row(coordinate.kind)).collect()
}
