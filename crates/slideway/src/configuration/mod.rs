//! Positions and velocities that satisfy the joints.
//!
//! Third stage of the pipeline: [`Mechanism`] in, [`Configuration`] out. The chosen coordinates and their rates
//! are given; everything else follows from the joints, by Newton's method on the joint equations, led from the
//! reference drawing to the wanted state in small steps so that the assembly branch of the drawing is kept.

mod assembly;
mod joint_equations;
mod mobility;

pub use mobility::{Mobility, Redundancy};
pub(crate) use mobility::{free_motions, motion_in_words, null_space};

use crate::fault::Faults;
use crate::ids::{ContactId, Frame};
use crate::mechanism::{Attachment, CoordinateKind, Mechanism, Slider, rot90};
use crate::model::CarriedBy;
use nalgebra::{Rotation2, Vector2};

/// Position of a body against the drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Centre of mass (m).
    pub position: Vector2<f64>,
    /// Rotation (rad), not reduced to one turn.
    pub angle: f64,
}

/// Velocity of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Velocity {
    /// Velocity of the centre of mass (m/s).
    pub linear: Vector2<f64>,
    /// Angular velocity (rad/s), counter-clockwise positive.
    pub angular: f64,
}

/// A mechanism's state: positions and velocities of all bodies.
#[derive(Debug, Clone)]
pub struct Configuration {
    /// Pose of each body.
    pub poses: Vec<Pose>,
    /// Velocity of each body.
    pub velocities: Vec<Velocity>,
    /// Value of each chosen coordinate (m or rad).
    pub coordinates: Vec<f64>,
    /// Rate of each chosen coordinate.
    pub rates: Vec<f64>,
    /// Time (s).
    pub time: f64,
}

/// A sliding joint in a configuration.
#[derive(Debug, Clone, Copy)]
pub struct Slide {
    /// Tangent u of the guide.
    pub tangent: Vector2<f64>,
    /// Normal n = rot90(u).
    pub normal: Vector2<f64>,
    /// Displacement of the block against the guide along u, zero in the drawing (m).
    pub displacement: f64,
}

/// A contact in a configuration.
#[derive(Debug, Clone, Copy)]
pub struct ContactGeometry {
    /// The point P on the centre line of the guide.
    pub point: Vector2<f64>,
    /// Tangent u of the guide.
    pub tangent: Vector2<f64>,
    /// Normal n = rot90(u).
    pub normal: Vector2<f64>,
    /// Velocity of the block's material point against the guide's at P, along u (m/s).
    pub sliding_velocity: f64,
}

impl Configuration {
    /// The state that the model's coordinate values and rates describe.
    ///
    /// # Errors
    /// A redundant structure, a singular position, a wrong number of coordinates, a state that cannot be
    /// assembled, an overlap that has vanished, travel limits that are exceeded.
    pub fn new(mechanism: &Mechanism) -> Result<Self, Faults> {
        assembly::assemble(mechanism)
    }

    /// The reference drawing itself, at rest; its joints need not be closed.
    pub fn drawing(mechanism: &Mechanism) -> Self {
        Self {
            poses: drawing_poses(mechanism),
            velocities: vec![Velocity { linear: Vector2::zeros(), angular: 0.0 }; mechanism.bodies.len()],
            coordinates: mechanism.coordinates.iter().map(|coordinate| coordinate.drawn_at).collect(),
            rates: vec![0.0; mechanism.coordinates.len()],
            time: mechanism.time,
        }
    }

    /// Rotation of a frame (rad).
    pub fn angle(&self, frame: Frame) -> f64 {
        frame.body().map_or(0.0, |body| self.poses[body.index()].angle)
    }

    /// Angular velocity of a frame (rad/s).
    pub fn angular_velocity(&self, frame: Frame) -> f64 {
        frame.body().map_or(0.0, |body| self.velocities[body.index()].angular)
    }

    /// A direction of the drawing, turned with a frame.
    pub fn direction(&self, frame: Frame, drawn: Vector2<f64>) -> Vector2<f64> {
        turned(self.angle(frame), drawn)
    }

    /// Where a point of the drawing is now.
    pub fn position(&self, mechanism: &Mechanism, point: &Attachment) -> Vector2<f64> {
        moved(mechanism, &self.poses, point)
    }

    /// Vector from the centre of mass of a frame to a place; zero for ground.
    pub fn arm(&self, frame: Frame, place: Vector2<f64>) -> Vector2<f64> {
        frame.body().map_or(Vector2::zeros(), |body| place - self.poses[body.index()].position)
    }

    /// Velocity of the material point of a frame that is at a place (m/s).
    pub fn velocity_at(&self, frame: Frame, place: Vector2<f64>) -> Vector2<f64> {
        frame.body().map_or(Vector2::zeros(), |body| {
            let velocity = self.velocities[body.index()];
            velocity.linear + velocity.angular * rot90(self.arm(frame, place))
        })
    }

    /// A sliding joint in this configuration.
    pub fn slide(&self, mechanism: &Mechanism, slider: &Slider) -> Slide {
        let tangent = self.direction(slider.guide, slider.tangent);
        let [block, guide] = middle_points(slider).map(|point| self.position(mechanism, &point));
        Slide { tangent, normal: rot90(tangent), displacement: tangent.dot(&(block - guide)) }
    }

    /// A contact in this configuration.
    pub fn contact(&self, mechanism: &Mechanism, id: ContactId) -> ContactGeometry {
        let contact = &mechanism.contacts[id.index()];
        let slider = mechanism.slider(contact.joint).expect("contacts belong to sliding joints");
        let tangent = self.direction(slider.guide, slider.tangent);
        let frame = match contact.carried_by {
            CarriedBy::Block => slider.block,
            CarriedBy::Guide => slider.guide,
        };
        let drawn = slider.at + contact.offset * slider.tangent;
        let point = self.position(mechanism, &Attachment { frame, position: drawn });
        let relative = self.velocity_at(slider.block, point) - self.velocity_at(slider.guide, point);
        ContactGeometry { point, tangent, normal: rot90(tangent), sliding_velocity: tangent.dot(&relative) }
    }

    /// Supported length of a block slider: distance of front from rear contact along the guide (m).
    pub fn overlap(&self, mechanism: &Mechanism, slider: &Slider) -> Option<f64> {
        let [front, rear] = slider.contacts[..] else { return None };
        let front = self.contact(mechanism, front);
        Some(front.tangent.dot(&(front.point - self.contact(mechanism, rear).point)))
    }
}

/// Where every body is in the drawing.
fn drawing_poses(mechanism: &Mechanism) -> Vec<Pose> {
    mechanism.bodies.iter().map(|body| Pose { position: body.centre_of_mass, angle: 0.0 }).collect()
}

/// A vector turned by an angle.
fn turned(angle: f64, vector: Vector2<f64>) -> Vector2<f64> {
    if angle == 0.0 { vector } else { Rotation2::new(angle) * vector }
}

/// Where a point of the drawing is when the bodies have these poses.
fn moved(mechanism: &Mechanism, poses: &[Pose], point: &Attachment) -> Vector2<f64> {
    match point.frame.body() {
        None => point.position,
        Some(body) => {
            let pose = poses[body.index()];
            let arm = point.position - mechanism.bodies[body.index()].centre_of_mass;
            pose.position + turned(pose.angle, arm)
        }
    }
}

/// The middle of the block as a point of the block, and of the guide.
fn middle_points(slider: &Slider) -> [Attachment; 2] {
    [slider.block, slider.guide].map(|frame| Attachment { frame, position: slider.at })
}

/// The unit of a coordinate.
pub fn unit(kind: &CoordinateKind) -> &'static str {
    if kind.is_angle() { "rad" } else { "m" }
}
