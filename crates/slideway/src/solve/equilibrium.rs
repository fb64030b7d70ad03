//! An independent check of a solution: force and moment balance of every body, from the forces themselves.
//!
//! Nothing of the kinetic equations' matrix is used: the forces are placed at their points, and their moments
//! are taken about the origin of the world frame.

use crate::configuration::{Configuration, ContactGeometry};
use crate::ids::{BodyId, ContactId, Frame, JointId};
use crate::influence::{ContactFriction, HingeState};
use crate::kinetics::{Layout, Reaction, Wrench, effort_forces, friction_forces};
use crate::mechanism::{Attachment, JointKind, Mechanism, tilting};
use nalgebra::{DVector, Vector2};

/// What is left over in the balance of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Residual {
    /// Left-over force (N).
    pub(super) force: f64,
    /// Left-over moment about the world origin (N m).
    pub(super) moment: f64,
    /// The greater of both, divided by the greatest force in the mechanism (moments: times its size).
    pub(super) relative: f64,
}

/// A solution as the balance sees it.
pub(super) struct Balance<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) configuration: &'a Configuration,
    pub(super) contacts: &'a [ContactGeometry],
    pub(super) applied: &'a [Wrench],
    pub(super) layout: &'a Layout,
    pub(super) unknowns: &'a DVector<f64>,
    /// The normal forces as the mode problem gives them, so that the balance tests them, too.
    pub(super) normal_force: &'a DVector<f64>,
    pub(super) friction: &'a [ContactFriction],
    /// The hinges with friction, with their forces as the mode problem gives them.
    pub(super) hinges: &'a [HingeState],
}

impl Balance<'_> {
    /// The residual of every body.
    pub(super) fn residuals(&self) -> Vec<Residual> {
        let forces = self.forces();
        let size = self.mechanism.size;
        let greatest = forces
            .iter()
            .map(|wrench| {
                length(wrench.force).max(wrench.couple.abs() / size).max(out_of_plane(wrench, size))
            })
            .fold(0.0, f64::max);
        (0..self.mechanism.bodies.len()).map(|body| self.residual(BodyId(body), &forces, greatest)).collect()
    }

    /// Every force and couple on every body.
    fn forces(&self) -> Vec<Wrench> {
        let mut forces = self.applied.to_vec();
        for (index, reaction) in self.layout.reactions().iter().enumerate() {
            let value = self.unknowns[self.layout.accelerations() + index];
            forces.extend(self.reaction(*reaction, value));
        }
        for hinge in self.hinges {
            let circle = &self.mechanism.friction_circles[hinge.circle];
            forces.extend(self.mechanism.friction_couple(circle, self.contacts, hinge.couple));
        }
        for (index, friction) in self.friction.iter().enumerate() {
            let (id, contact) = (ContactId(index), &self.contacts[index]);
            forces.extend(friction_forces(self.mechanism, id, contact, 1.0, friction.positive_face));
            forces.extend(friction_forces(self.mechanism, id, contact, -1.0, friction.negative_face));
        }
        for (index, drive) in self.mechanism.drives.iter().enumerate() {
            let value = self.unknowns[self.layout.effort(crate::ids::DriveId(index))];
            for unit in effort_forces(self.mechanism, self.configuration, &drive.effort) {
                // An effort is a force in the plane or a couple about z.
                forces.push(Wrench { force: value * unit.force, couple: value * unit.couple, ..unit });
            }
        }
        forces
    }

    fn reaction(&self, reaction: Reaction, value: f64) -> Vec<Wrench> {
        match reaction {
            Reaction::Hinge(joint, axis) => {
                let circle = self.mechanism.circle_of(joint);
                let rough = self.hinges.iter().find(|hinge| Some(hinge.circle) == circle);
                let value = rough.map_or(value, |hinge| hinge.force[axis]);
                let axis = if axis == 0 { Vector2::x() } else { Vector2::y() };
                self.hinge(joint, value * axis)
            }
            Reaction::Normal(contact) => {
                let state = &self.contacts[contact.index()];
                let joint = self.mechanism.contacts[contact.index()].joint;
                let normal = self.normal_force[contact.index()];
                let on = |frame: Frame, sign: f64| {
                    let force = Wrench::force(frame, state.point, sign * normal * state.normal);
                    force.in_space(state.z, sign * normal * state.along_z())
                };
                self.on_both(joint, on)
            }
            Reaction::Couple(joint) => {
                let nothing = |frame| Wrench::force(frame, Vector2::zeros(), Vector2::zeros());
                self.on_both(joint, |frame, sign| Wrench { couple: sign * value, ..nothing(frame) })
            }
            Reaction::Carried(joint, component) => self.carried(joint, component, value),
        }
    }

    /// What a joint carries out of the drawing without friction, on both bodies.
    fn carried(&self, joint: JointId, component: usize, value: f64) -> Vec<Wrench> {
        let joined = self.mechanism.joints[joint.index()].joined();
        let (position, z) = joined.place;
        let attachment = Attachment { frame: joined.frames[0], position, z };
        let place = self.configuration.position(self.mechanism, &attachment);
        let on = |frame: Frame, sign: f64| {
            let nothing = Wrench::force(frame, place, Vector2::zeros());
            if component == 0 {
                return nothing.in_space(z, sign * value);
            }
            let axis = self.configuration.direction(joined.axes_of, joined.axes[component - 1]);
            Wrench { tilt: sign * value * axis, ..nothing }
        };
        vec![on(joined.frames[0], 1.0), on(joined.frames[1], -1.0)]
    }

    fn hinge(&self, joint: JointId, force: Vector2<f64>) -> Vec<Wrench> {
        let JointKind::Hinge(ends) = &self.mechanism.joints[joint.index()].kind else { return Vec::new() };
        let on = |end: usize, force: Vector2<f64>| {
            let place = self.configuration.position(self.mechanism, &ends[end]);
            Wrench::force(ends[end].frame, place, force).in_space(ends[end].z, 0.0)
        };
        vec![on(0, force), on(1, -force)]
    }

    fn on_both(&self, joint: JointId, on: impl Fn(Frame, f64) -> Wrench) -> Vec<Wrench> {
        let Some(slider) = self.mechanism.slider(joint) else { return Vec::new() };
        vec![on(slider.block, 1.0), on(slider.guide, -1.0)]
    }

    /// Sum of forces minus m a, and sum of moments about the origin minus (c x m a + J alpha).
    fn residual(&self, body: BodyId, forces: &[Wrench], greatest: f64) -> Residual {
        let first = self.layout.acceleration(body);
        let acceleration = Vector2::new(self.unknowns[first], self.unknowns[first + 1]);
        let properties = &self.mechanism.bodies[body.index()];
        let centre = self.configuration.poses[body.index()].position;
        let inertia = properties.mass * acceleration;
        let mut sum = -inertia;
        let mut moment = -(centre.perp(&inertia) + properties.moment_of_inertia * self.unknowns[first + 2]);
        moment += self.tilting_of(body).dot(&self.products_of(body));
        for wrench in forces.iter().filter(|wrench| wrench.frame == Frame::Body(body)) {
            sum += wrench.force;
            moment += wrench.place.perp(&wrench.force) + wrench.couple;
        }
        let [along_z, tilt] = self.out_of_plane(body, forces, inertia);
        let (force, moment) = (length(sum).max(along_z), moment.abs().max(tilt));
        let left_over = force.max(moment / self.mechanism.size);
        // Below the least normal number forces have no relative accuracy.
        let relative = left_over / greatest.max(length(inertia)).max(f64::MIN_POSITIVE);
        Residual { force, moment, relative }
    }
}

impl Balance<'_> {
    /// Sum of forces along z less m a_z, and of moments about x and y through the origin without those of m a and of the
    /// moments and products of inertia, (S1); nothing in a planar model.
    fn out_of_plane(&self, body: BodyId, forces: &[Wrench], inertia: Vector2<f64>) -> [f64; 2] {
        let Some((first, z)) = self.mechanism.out_of_plane(Frame::Body(body)) else { return [0.0; 2] };
        let (products, tilting_of) = (self.products_of(body), self.tilting_of(body));
        let turning = self.unknowns[self.layout.acceleration(body) + 2];
        let spin = self.configuration.velocities[body.index()].angular.powi(2);
        let pose = &self.configuration.poses[body.index()];
        let along = self.mechanism.bodies[body.index()].mass * self.unknowns[first];
        let mut along_z = -along;
        let mut tilt = products * turning - Vector2::new(products.y, -products.x) * spin;
        tilt -= tilting((pose.position, z), (inertia, along));
        if let Some([about_x, about_y]) =
            self.mechanism.space.as_ref().and_then(|all| all.bodies[body.index()].tilt)
        {
            let [x, y] = [Vector2::x(), Vector2::y()]
                .map(|axis| self.configuration.direction(Frame::Body(body), axis));
            tilt -= x * (about_x * x.dot(&tilting_of)) + y * (about_y * y.dot(&tilting_of));
        }
        for wrench in forces.iter().filter(|wrench| wrench.frame == Frame::Body(body)) {
            along_z += wrench.along_z;
            tilt += tilting((wrench.place, wrench.z), (wrench.force, wrench.along_z)) + wrench.tilt;
        }
        [along_z.abs(), length(tilt)]
    }

    /// The products of inertia of a body in its pose.
    fn products_of(&self, body: BodyId) -> Vector2<f64> {
        let products =
            self.mechanism.space.as_ref().map_or([0.0; 2], |space| space.bodies[body.index()].products);
        self.configuration.direction(Frame::Body(body), products.into())
    }

    /// The accelerations of rotation of a body about x and y, which it has once contacts lift off.
    fn tilting_of(&self, body: BodyId) -> Vector2<f64> {
        let first = self.mechanism.out_of_plane(Frame::Body(body)).map(|(first, _)| first + 1);
        first
            .map_or_else(Vector2::zeros, |first| Vector2::new(self.unknowns[first], self.unknowns[first + 1]))
    }
}

/// The greatest part of a wrench out of the plane, as a force.
fn out_of_plane(wrench: &Wrench, size: f64) -> f64 {
    wrench.along_z.abs().max(length(wrench.tilt) / size)
}

/// The length of a vector whose squares may be too small for a number.
fn length(vector: Vector2<f64>) -> f64 {
    vector.x.hypot(vector.y)
}
