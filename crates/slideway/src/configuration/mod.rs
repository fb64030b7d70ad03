//! Positions and velocities that satisfy the joints.
//!
//! Third stage of the pipeline: [`Mechanism`] in, [`Configuration`] out. The chosen coordinates and their
//! rates are given; everything else follows from the joints. The mechanism is led from the reference drawing
//! to the wanted state in steps that are shown to stay on the assembly branch of the drawing.
//!
//! # Files
//! `joint_equations.rs` has the equations and `curvature.rs` how they bend, `anchor.rs` proves how far the
//! branch of a state can be followed in one step, `following.rs` goes from place to place, `follower.rs`
//! finds one state after another and remembers what the last step has shown, `face.rs` tells what is beside its face, `assembly.rs` closes the drawing
//! and says why a state cannot be had, `mobility.rs` counts freedoms,
//! `motions.rs` has what moves with each coordinate, `standing.rs` finds what the drives keep at rest.

mod anchor;
mod assembly;
mod clearance;
mod curvature;
mod face;
mod factors;
mod follower;
mod following;
mod joint_equations;
mod leg;
mod mobility;
mod motions;
mod standing;

pub(crate) use assembly::widest_gap_of_drawing;
pub(crate) use factors::Factors;
pub use follower::Follower;
pub(crate) use joint_equations::JointEquations;
pub use mobility::{Mobility, Redundancy};
pub(crate) use mobility::{
    PROBE, advance, every_motion_has_inertia, free_motions, motion_in_words, motions_without_inertia,
    moved_by, null_space,
};
pub(crate) use standing::{NO_ACCELERATION, staying};

use crate::fault::{Fault, Faults};
use crate::ids::{ContactId, Frame, JointId};
use crate::interval::Real;
use crate::mechanism::{
    Attachment, Contact, CoordinateKind, FrictionCircle, Mechanism, Pad, Pieces, Quantity, Slider, length,
    rot90,
};
use crate::model::{Round, SliderKind};
use crate::progress::{Callback, Progress};
use nalgebra::Vector2;
use std::sync::Arc;

/// Position of a body against the drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose<T = f64> {
    /// Centre of mass (m).
    pub position: Vector2<T>,
    angle: T,
    /// Cosine and sine of the angle: every point and direction of the body asks for them.
    turn: [T; 2],
}

impl<T: Real> Pose<T> {
    /// A body whose centre of mass is at a position (m), turned by an angle (rad).
    pub fn new(position: Vector2<T>, angle: T) -> Self {
        let turn = if angle.is_zero() { [T::one(), T::zero()] } else { [angle.cos(), angle.sin()] };
        Self { position, angle, turn }
    }

    /// Rotation (rad), not reduced to one turn.
    pub fn angle(&self) -> T {
        self.angle
    }

    /// A direction of the drawing, turned with the body.
    pub(crate) fn turned(&self, drawn: Vector2<T>) -> Vector2<T> {
        if self.angle.is_zero() {
            return drawn;
        }
        let [cos, sin] = self.turn;
        Vector2::new(cos * drawn.x - sin * drawn.y, sin * drawn.x + cos * drawn.y)
    }
}

/// Velocity of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Velocity<T = f64> {
    /// Velocity of the centre of mass (m/s).
    pub linear: Vector2<T>,
    /// Angular velocity (rad/s), counter-clockwise positive.
    pub angular: T,
}

/// A mechanism's state: positions and velocities of all bodies.
#[derive(Debug, Clone)]
pub struct Configuration<T = f64> {
    /// Pose of each body.
    pub poses: Vec<Pose<T>>,
    /// Velocity of each body.
    pub velocities: Vec<Velocity<T>>,
    /// Value of each chosen coordinate (m or rad).
    pub coordinates: Vec<T>,
    /// Rate of each chosen coordinate.
    pub rates: Vec<T>,
    /// Time (s).
    pub time: T,
    /// Steps in which the positions were followed from the drawing; 0 if they are those of the drawing, or of
    /// a motion.
    pub steps: usize,
    /// On which piece each relation of the loads and drives is; without, their arguments decide.
    pub(crate) pieces: Option<Arc<Pieces>>,
}

/// A sliding joint in a configuration.
#[derive(Debug, Clone, Copy)]
pub struct Slide<T = f64> {
    /// Tangent u of the guide.
    pub tangent: Vector2<T>,
    /// Normal n = rot90(u).
    pub normal: Vector2<T>,
    /// Displacement of the block against the guide along u, zero in the drawing and on a round face (m).
    pub displacement: T,
}

/// A contact in a configuration.
#[derive(Debug, Clone, Copy)]
pub struct ContactGeometry<T = f64> {
    /// The point P on the centre line of the guide.
    pub point: Vector2<T>,
    /// Tangent u of the guide; where a corner of the guide touches a face of the block, of that face.
    pub tangent: Vector2<T>,
    /// The part with which u turns.
    pub(crate) line_of: Frame,
    /// How far P is out of the drawing (m).
    pub z: T,
    /// Normal n = rot90(u); of a contact whose normal leans out of the drawing that normal's part in it.
    pub normal: Vector2<T>,
    /// Cosine and sine of the angle of the normal from n towards z, if it leans.
    pub lean: Option<[T; 2]>,
    /// Velocity of the block's material point against the guide's where they touch, along u (m/s).
    pub sliding_velocity: T,
    /// That of both at P, which is the centre of a disc.
    pub(crate) velocity_at_point: T,
}

impl<T: Real> ContactGeometry<T> {
    /// The part of its normal out of the drawing.
    pub(crate) fn along_z(&self) -> T {
        self.lean.map_or(T::zero(), |[_, sin]| sin)
    }
}

impl Configuration {
    /// The state that the model's coordinate values and rates describe: the one to which the straight way of
    /// the coordinates leads from the drawing, without leaving its assembly branch.
    ///
    /// # Errors
    /// A redundant structure, a singular position, a wrong number of coordinates, a state that cannot be
    /// assembled or to which the branch could not be followed, an overlap that has vanished, travel limits
    /// that are exceeded.
    pub fn new(mechanism: &Mechanism) -> Result<Self, Faults> {
        Follower::default().configuration(mechanism)
    }

    /// [`Configuration::new`] with a callback that is called before every further step on the way from the drawing.
    ///
    /// # Errors
    /// As [`Configuration::new`]; [`FaultKind::WorkEnded`](crate::fault::FaultKind::WorkEnded) once the callback has broken.
    pub fn with_progress(mechanism: &Mechanism, progress: &mut Callback<'_>) -> Result<Self, Faults> {
        let mut steps = 0;
        let mut proceed = || {
            steps += 1;
            let told =
                Progress { counted: "steps of the assembly", done: steps, fraction: None, found: None };
            progress(&told).is_continue()
        };
        Follower::default().configuration_while(mechanism, &mut proceed)
    }

    /// In how many steps the positions were followed from the drawing; none if they are those of the drawing.
    pub(crate) fn steps_from_drawing(&self) -> Option<usize> {
        Some(self.steps).filter(|steps| *steps > 0)
    }

    /// The reference drawing itself, at rest; its joints need not be closed.
    pub fn drawing(mechanism: &Mechanism) -> Self {
        Self {
            poses: drawing_poses(mechanism),
            velocities: vec![Velocity { linear: Vector2::zeros(), angular: 0.0 }; mechanism.bodies.len()],
            coordinates: mechanism.coordinates.iter().map(|coordinate| coordinate.drawn_at).collect(),
            rates: vec![0.0; mechanism.coordinates.len()],
            time: mechanism.time,
            steps: 0,
            pieces: None,
        }
    }
}

impl<T: Real> Configuration<T> {
    /// Value of a quantity of the mechanism in this state.
    ///
    /// # Errors
    /// A fault if a formula has no finite or allowed value there.
    pub(crate) fn quantity(&self, mechanism: &Mechanism<T>, quantity: Quantity<T>) -> Result<T, Fault> {
        let values = mechanism.values(&self.coordinates, &self.rates, self.time);
        mechanism.quantity_on(quantity, &values, self.pieces.as_deref())
    }

    /// Rotation of a frame (rad).
    pub fn angle(&self, frame: Frame) -> T {
        frame.body().map_or(T::zero(), |body| self.poses[body.index()].angle)
    }

    /// Angular velocity of a frame (rad/s).
    pub fn angular_velocity(&self, frame: Frame) -> T {
        frame.body().map_or(T::zero(), |body| self.velocities[body.index()].angular)
    }

    /// Angular velocity of the first body of a hinge against the second (rad/s).
    pub(crate) fn spin(&self, mechanism: &Mechanism<T>, joint: JointId) -> T {
        let turning = |[first, second]: &[Attachment<T>; 2]| {
            self.angular_velocity(first.frame) - self.angular_velocity(second.frame)
        };
        mechanism.hinge(joint).map_or(T::zero(), turning)
    }

    /// How fast a hinge turns (rad/s), or the block of a round end slides (m/s).
    pub(crate) fn rubbing(&self, mechanism: &Mechanism<T>, circle: &FrictionCircle<T>) -> T {
        match circle.end {
            None => self.spin(mechanism, circle.joint),
            Some([along_n, _]) => self.contact(mechanism, along_n).sliding_velocity,
        }
    }

    /// Sets the values of the chosen coordinates and their rates to those of the poses and velocities.
    pub(crate) fn measure(&mut self, mechanism: &Mechanism<T>) {
        for (index, coordinate) in mechanism.coordinates.iter().enumerate() {
            let (moved_by, rate) = match coordinate.kind {
                CoordinateKind::Slide(joint) => match mechanism.slider(joint) {
                    Some(slider) => self.sliding(mechanism, slider),
                    None => continue,
                },
                CoordinateKind::Rotation(body, against) => {
                    let frame = Frame::Body(body);
                    let rate = self.angular_velocity(frame) - self.angular_velocity(against);
                    (self.angle(frame) - self.angle(against), rate)
                }
                CoordinateKind::Displacement(point, axis) => {
                    let place = self.position(mechanism, &point);
                    (axis.dot(&(place - point.position)), axis.dot(&self.velocity_at(point.frame, place)))
                }
            };
            self.coordinates[index] = coordinate.drawn_at + moved_by;
            self.rates[index] = rate;
        }
    }

    /// Displacement of a block against its guide (m), and its rate (m/s): u . (v_block - v_guide).
    pub(crate) fn sliding(&self, mechanism: &Mechanism<T>, slider: &Slider<T>) -> (T, T) {
        let tangent = self.direction(slider.guide, slider.tangent);
        let [block, guide] = middle_points(slider).map(|point| self.position(mechanism, &point));
        let relative = self.velocity_at(slider.block, block) - self.velocity_at(slider.guide, block);
        (tangent.dot(&(block - guide)), tangent.dot(&relative))
    }

    /// The way that the rim of a disc has slipped on its face since the drawing (m): `u . (block - guide) + R (theta_B -
    /// theta_A)`, and on a round face `(R_B + R_A) (psi_B - psi)`, where `psi_B = (R_B theta_B + R_A theta_A)/(R_B + R_A)` is the
    /// turn of the line between both centres if it rolls, `psi` that line's turn, with a negative `R_A` of a hole. This is known
    /// up to whole turns: the second number.
    pub(crate) fn slipped(&self, mechanism: &Mechanism<T>, slider: &Slider<T>) -> (T, Option<T>) {
        let Some(round) = &slider.round else {
            let turned = self.angle(slider.block) - self.angle(slider.guide);
            return (self.sliding(mechanism, slider).0 + slider.rim() * turned, None);
        };
        let radii = [slider.rim(), if round.inside { -round.radius } else { round.radius }];
        let (ends, sum) = (round_ends(slider, round), radii[0] + radii[1]);
        let rolled = |(end, radius): (&Attachment<T>, T)| radius / sum * self.angle(end.frame);
        let psi = ends.iter().zip(radii).map(rolled).fold(T::zero(), |one, other| one + other);
        let rolling = Pose::new(Vector2::zeros(), psi).turned(ends[0].position - ends[1].position);
        let line = self.position(mechanism, &ends[0]) - self.position(mechanism, &ends[1]);
        let angle = rot90(line).dot(&rolling).atan2(line.dot(&rolling));
        (sum * angle, Some(sum * T::exactly(std::f64::consts::TAU)))
    }

    /// How far a block is beyond the beginning of a pad (m), and the rate of that (m/s).
    pub(crate) fn depth(&self, mechanism: &Mechanism<T>, pad: &Pad<T>) -> [T; 2] {
        let Some(slider) = mechanism.slider(pad.joint) else { return [T::zero(); 2] };
        let (displacement, velocity) = self.sliding(mechanism, slider);
        [pad.sense() * (displacement - pad.place), pad.sense() * velocity]
    }

    /// The force with which a pad pushes its block back (N), max(0, k d + c d') at the depth d; none if it is
    /// not finite.
    pub fn pad_force(&self, mechanism: &Mechanism<T>, pad: &Pad<T>) -> Option<T> {
        let pieces = self.pieces.as_deref().map_or(&[][..], |pieces| pieces.of(pad.formula));
        pad.force(&self.depth(mechanism, pad), pieces).ok()
    }

    /// A direction of the drawing, turned with a frame.
    pub fn direction(&self, frame: Frame, drawn: Vector2<T>) -> Vector2<T> {
        turned(&self.poses, frame, drawn)
    }

    /// Where a point of the drawing is now.
    pub fn position(&self, mechanism: &Mechanism<T>, point: &Attachment<T>) -> Vector2<T> {
        moved(mechanism, &self.poses, point)
    }

    /// Vector from the centre of mass of a frame to a place; zero for ground.
    pub fn arm(&self, frame: Frame, place: Vector2<T>) -> Vector2<T> {
        frame.body().map_or(Vector2::zeros(), |body| place - self.poses[body.index()].position)
    }

    /// Velocity of the material point of a frame that is at a place (m/s).
    pub fn velocity_at(&self, frame: Frame, place: Vector2<T>) -> Vector2<T> {
        frame.body().map_or(Vector2::zeros(), |body| {
            let velocity = self.velocities[body.index()];
            velocity.linear + rot90(self.arm(frame, place)) * velocity.angular
        })
    }

    /// A sliding joint in this configuration.
    pub fn slide(&self, mechanism: &Mechanism<T>, slider: &Slider<T>) -> Slide<T> {
        let tangent = self.tangent(mechanism, slider);
        let [block, guide] = middle_points(slider).map(|point| self.position(mechanism, &point));
        let displacement = if slider.round.is_some() { T::zero() } else { tangent.dot(&(block - guide)) };
        Slide { tangent, normal: rot90(tangent), displacement }
    }

    /// A contact in this configuration.
    pub fn contact(&self, mechanism: &Mechanism<T>, id: ContactId) -> ContactGeometry<T> {
        let contact = &mechanism.contacts[id.index()];
        let slider = mechanism.slider(contact.joint).expect("contacts belong to sliding joints");
        self.geometry(mechanism, slider, contact)
    }

    /// A contact of a sliding joint, which may be apart from its face.
    pub(crate) fn geometry(
        &self,
        mechanism: &Mechanism<T>,
        slider: &Slider<T>,
        contact: &Contact<T>,
    ) -> ContactGeometry<T> {
        let z = slider.z + contact.aside[1];
        let geometry = self.touching(mechanism, slider, contact);
        match contact.lean {
            None => ContactGeometry { z, ..geometry },
            Some([cos, _]) => {
                ContactGeometry { z, normal: geometry.normal * cos, lean: contact.lean, ..geometry }
            }
        }
    }

    /// A contact of a sliding joint in the drawing's plane.
    fn touching(
        &self,
        mechanism: &Mechanism<T>,
        slider: &Slider<T>,
        contact: &Contact<T>,
    ) -> ContactGeometry<T> {
        let [frame, line_of] = contact.frames(slider);
        let tangent = self.tangent_on(mechanism, slider, line_of);
        let position = contact.position(slider);
        let point = self.position(mechanism, &Attachment { frame, position, z: slider.z });
        let relative = self.velocity_at(slider.block, point) - self.velocity_at(slider.guide, point);
        let velocity_at_point = tangent.dot(&relative);
        let mut sliding_velocity = velocity_at_point;
        if slider.is_disc() {
            let spin = self.angular_velocity(slider.block) - self.angular_velocity(slider.guide);
            sliding_velocity += spin * (slider.height / T::exactly(2.0));
        }
        let normal = rot90(tangent);
        ContactGeometry {
            point,
            tangent,
            line_of,
            z: slider.z,
            normal,
            lean: None,
            sliding_velocity,
            velocity_at_point,
        }
    }

    /// The tangent u of a guide where its block is.
    pub(crate) fn tangent(&self, mechanism: &Mechanism<T>, slider: &Slider<T>) -> Vector2<T> {
        self.tangent_on(mechanism, slider, slider.guide)
    }

    /// The tangent u of a sliding joint as it turns with one of its parts.
    fn tangent_on(&self, mechanism: &Mechanism<T>, slider: &Slider<T>, part: Frame) -> Vector2<T> {
        let Some(round) = &slider.round else { return self.direction(part, slider.tangent) };
        let [block, centre] = round_ends(slider, round).map(|end| self.position(mechanism, &end));
        let outwards = (block - centre) / length(block - centre);
        if round.inside { rot90(outwards) } else { -rot90(outwards) }
    }

    /// The gap of each corner or disc of a sliding joint that is apart from its face (m), and its rate (m/s).
    pub fn gaps<'a>(
        &'a self,
        mechanism: &'a Mechanism<T>,
        slider: &'a Slider<T>,
    ) -> impl Iterator<Item = [T; 2]> + 'a {
        slider.apart.iter().map(|contact| self.gap_at(mechanism, slider, contact))
    }

    /// The gap of a contact that may lift off (m), and its rate (m/s).
    pub(crate) fn gap(&self, mechanism: &Mechanism<T>, id: ContactId) -> [T; 2] {
        let contact = &mechanism.contacts[id.index()];
        let slider = mechanism.slider(contact.joint).expect("contacts belong to sliding joints");
        self.gap_at(mechanism, slider, contact)
    }

    /// The gap of a contact of a sliding joint that may lift off (m), and its rate (m/s).
    pub(crate) fn gap_at(
        &self,
        mechanism: &Mechanism<T>,
        slider: &Slider<T>,
        contact: &Contact<T>,
    ) -> [T; 2] {
        let position = contact.position(slider);
        let [corner, line_of] = contact.frames(slider);
        let normal = rot90(self.tangent_on(mechanism, slider, line_of));
        let [place, opposite] = [slider.block, slider.guide]
            .map(|frame| self.position(mechanism, &Attachment { frame, position, z: slider.z }));
        let moved = match &slider.round {
            None => normal.dot(&(place - opposite)),
            Some(round) => {
                let [block, centre] = round_ends(slider, round);
                let distance = |from: Vector2<T>, to: Vector2<T>| length(to - from);
                let now = distance(self.position(mechanism, &centre), place);
                let change = now - distance(centre.position, block.position);
                if round.inside { -change } else { change }
            }
        };
        let point = if corner == slider.block { place } else { opposite };
        let relative = self.velocity_at(slider.block, point) - self.velocity_at(slider.guide, point);
        // In space along the normal of the contact; nothing moves along z.
        let along = |distance: T| contact.lean.map_or(distance, |[cos, _]| distance * cos);
        [contact.gap + along(moved), along(normal.dot(&relative))]
    }

    /// Puts the friction at the sliding speeds of this configuration into a mechanism (theory, section 1: mu
    /// over velocity), and the misalignments at its coordinates.
    ///
    /// # Errors
    /// A fault for each coefficient that is not finite or is negative there, and for each misalignment that is
    /// not finite.
    pub fn put_friction(&self, mechanism: &mut Mechanism<T>) -> Result<(), Faults> {
        let mut faults = self.put_misalignments(mechanism).err().unwrap_or_default();
        for k in 0..mechanism.contacts.len() {
            if !mechanism.contacts[k].depends_on_speed() {
                continue;
            }
            let id = ContactId(k);
            let speed = self.contact(mechanism, id).sliding_velocity.abs();
            match mechanism.friction_of(id, speed, self.pieces.as_deref()) {
                Ok(mu) => mechanism.contacts[k].mu = mu,
                Err(fault) => faults.push(fault),
            }
        }
        faults.or(())
    }

    /// Puts the misalignments at the coordinates of this configuration into a mechanism.
    ///
    /// # Errors
    /// A fault for each that is not finite.
    pub fn put_misalignments(&self, mechanism: &mut Mechanism<T>) -> Result<(), Faults> {
        let mut faults = Faults::default();
        for k in 0..mechanism.contacts.len() {
            let Some(law) = mechanism.contacts[k].misalignment_law else { continue };
            match self.quantity(mechanism, Quantity::Varying(law)) {
                Ok(misalignment) => mechanism.contacts[k].misalignment = misalignment,
                Err(fault) => faults.push(fault),
            }
        }
        faults.or(())
    }

    /// Supported length of a block slider: distance of front from rear contact along the guide (m).
    pub fn overlap(&self, mechanism: &Mechanism<T>, slider: &Slider<T>) -> Option<T> {
        let [front, rear, ..] = slider.contacts[..] else { return None };
        if slider.kind != SliderKind::Block {
            return None;
        }
        let front = self.contact(mechanism, front);
        Some(front.tangent.dot(&(front.point - self.contact(mechanism, rear).point)))
    }
}

/// Where every body is in the drawing.
fn drawing_poses(mechanism: &Mechanism) -> Vec<Pose> {
    mechanism.bodies.iter().map(|body| Pose::new(body.centre_of_mass, 0.0)).collect()
}

/// A direction of the drawing, turned with a frame, when the bodies have these poses.
fn turned<T: Real>(poses: &[Pose<T>], frame: Frame, drawn: Vector2<T>) -> Vector2<T> {
    frame.body().map_or(drawn, |body| poses[body.index()].turned(drawn))
}

/// Where a point of the drawing is when the bodies have these poses.
fn moved<T: Real>(mechanism: &Mechanism<T>, poses: &[Pose<T>], point: &Attachment<T>) -> Vector2<T> {
    match point.frame.body() {
        None => point.position,
        Some(body) => {
            let pose = poses[body.index()];
            let arm = point.position - mechanism.bodies[body.index()].centre_of_mass;
            pose.position + pose.turned(arm)
        }
    }
}

/// The middle of the block as a point of the block, and of the guide.
fn middle_points<T: Real>(slider: &Slider<T>) -> [Attachment<T>; 2] {
    [slider.block, slider.guide].map(|frame| Attachment { frame, position: slider.at, z: slider.z })
}

/// The centre of a disc as a point of the block, and that of its round face as one of the guide.
fn round_ends<T: Real>(slider: &Slider<T>, round: &Round<T>) -> [Attachment<T>; 2] {
    [Attachment { frame: slider.block, position: slider.at, z: slider.z }, slider.centre_of(round)]
}

/// The unit of a coordinate.
pub fn unit<T>(kind: &CoordinateKind<T>) -> &'static str {
    if kind.is_angle() { "rad" } else { "m" }
}
