//! Normal reactions and friction where they act, and sliding velocities.

use super::labels::{obstacles, reserve};
use super::loads::sign_of_z;
use super::looks::Look;
use super::outline::{nearest_on_line, upper_side};
use super::scene::{Class, Point, Shape};
use super::slide::Slide;
use super::{ContactForces, Painter, between};
use slideway::ids::{ContactId, Frame, JointId};
use slideway::mechanism::{Attachment, Mechanism};
use slideway::model::SliderKind;

/// Velocities below this part of the size of the mechanism for each second have no arrow (1/s).
pub(super) const AT_REST: f64 = 1e-9;
/// Distance of a velocity from what is drawn of its guide.
const ASIDE: f64 = 19.0;
/// Places of the arrow of a velocity: along the guide, and further off.
const PLACES: [(f64, f64); 8] = [
    (0.0, 0.0),
    (25.0, 0.0),
    (-25.0, 0.0),
    (0.0, 17.0),
    (50.0, 0.0),
    (-50.0, 0.0),
    (25.0, 17.0),
    (-25.0, 17.0),
];
/// Length of the arrow of an opening contact, and the radius of its dot.
const OPENING: f64 = 34.0;
const DOT: f64 = 4.0;
/// Length of the arrow of a velocity.
const VELOCITY: f64 = 40.0;

/// On what the forces of contacts are drawn to act.
pub(crate) fn forces_on(mechanism: &Mechanism) -> &'static str {
    let grounded = |is: bool| mechanism.sliders().any(|(_, slider)| (slider.block == Frame::Ground) == is);
    match (grounded(true), grounded(false)) {
        (true, _) => "the moving part",
        _ => "the block",
    }
}

impl Slide {
    /// The sign of forces and velocities that are drawn, where those of the block against the guide are positive: they
    /// are those of the guide where the block is ground.
    pub(super) fn action(&self) -> f64 {
        if self.block_frame == Frame::Ground { -1.0 } else { 1.0 }
    }
}

impl Painter<'_> {
    /// The forces of every contact on its block, at the pressed face `P - sign(N) (h/2) n` (theory, section
    /// 1); on its guide where the block is ground, as it is the guide that moves.
    pub(super) fn contact_forces(&mut self) {
        let Some(scale) = self.options.force_scale else { return };
        for index in 0..self.mechanism.contacts.len() {
            self.cone_at_rest(ContactId(index), scale);
        }
        for index in 0..self.mechanism.contacts.len() {
            let joint = self.mechanism.contacts[index].joint;
            let state = self.states.contacts.get(index).copied().unwrap_or_default();
            if let (Some(slide), Some(forces)) = (self.slide(joint), state.forces) {
                self.reaction(&slide, ContactId(index), forces, scale);
                self.friction(&slide, ContactId(index), state.side, forces, scale);
            }
        }
    }

    fn reaction(&mut self, slide: &Slide, contact: ContactId, forces: ContactForces, scale: f64) {
        if forces.normal == 0.0 {
            return;
        }
        let face = self.pressed(slide, contact, forces);
        let middle = self.face(slide, contact, forces.normal);
        let [from, to] = slide.block_reach;
        if slide.kind == SliderKind::Guided && (face - middle).norm() > 0.5 * (to - from) {
            // Beyond the ends of the block.
            self.line(Class::Leader, vec![middle, face]);
        }
        let direction = slide.guide.across * (forces.normal.signum() * slide.action());
        let [in_plane, along_z] = self.mechanism.contacts[contact.index()].normal_across();
        let length = forces.normal.abs() * scale * in_plane;
        // It presses from outside what it acts on if that is the inner part, else from inside.
        let is_on_inner = slide.around == (slide.block_frame == Frame::Ground);
        let text = self.size_of_force(forces.normal, forces.spread[0]);
        let out = along_z * forces.normal;
        if in_plane == 0.0 {
            return self.out_of_drawing(Class::Reaction, face, out * slide.action() > 0.0, text);
        }
        if out != 0.0 {
            self.scene.elements.extend(sign_of_z(Class::Reaction, face, out * slide.action() > 0.0));
        }
        self.arrow_of_force(Class::Reaction, (face, is_on_inner), direction * length, text);
    }

    /// The size of a force that may differ by so much to either side: "716.2 to 791.5 N".
    fn size_of_force(&self, middle: f64, spread: f64) -> String {
        let ends = [middle.abs() - spread, middle.abs() + spread];
        between(ends, &self.mechanism.units.clone().suited_to_most("N", &ends).of("N"))
    }

    /// Where the resultant of the pressure of a contact acts, whose normal force is not zero: `C = x N` about the middle of
    /// the face.
    pub(super) fn pressed(&self, slide: &Slide, contact: ContactId, forces: ContactForces) -> Point {
        let face = self.face(slide, contact, forces.normal);
        let lever = if slide.kind == SliderKind::Guided { forces.couple / forces.normal } else { 0.0 };
        face + slide.guide.along * (lever * self.view.scale)
    }

    fn friction(&mut self, slide: &Slide, contact: ContactId, side: f64, forces: ContactForces, scale: f64) {
        if forces.friction == 0.0 {
            return;
        }
        // One face of a contact has one force.
        let acts_there = forces.normal != 0.0 && forces.normal.signum() == side.signum();
        let from =
            if acts_there { self.pressed(slide, contact, forces) } else { self.face(slide, contact, side) };
        let direction = -slide.guide.along * (forces.friction.signum() * slide.action());
        let length = forces.friction.abs() * scale;
        let text = self.size_of_force(forces.friction, forces.spread[1]);
        self.arrow_of_force(Class::Friction, (from, false), direction * length, text);
    }

    /// The gap of each corner or disc that is apart from its face, from the one to the other.
    pub(super) fn gaps(&mut self) {
        let mechanism = self.mechanism;
        for (joint, slider) in mechanism.sliders() {
            let Some(slide) = self.slide(joint) else { continue };
            let rim = if slide.is_disc { 0.5 * slide.height } else { 0.0 };
            for ([gap, _], contact) in self.actual.gaps(mechanism, slider).zip(&slider.apart) {
                let corner = self.attached(&Attachment::new(slider.block, contact.position(slider)));
                let from = corner - slide.guide.across * rim;
                let to = from - slide.guide.across * (gap * self.view.scale);
                self.line(Class::Leader, vec![from, to]);
                let value = self.shown(gap, "m");
                self.value_along(Class::Dimension, value, [from, to], slide.guide.along);
            }
        }
    }

    /// A hollow dot at each contact that lifts off, and an arrow with the acceleration of its gap, which has no scale.
    pub(super) fn openings(&mut self) {
        for index in 0..self.states.contacts.len().min(self.mechanism.contacts.len()) {
            let Some(acceleration) = self.states.contacts[index].gap_acceleration else { continue };
            let Some(slide) = self.slide(self.mechanism.contacts[index].joint) else { continue };
            let from = self.face(&slide, ContactId(index), 1.0);
            let [in_plane, _] = self.mechanism.contacts[index].normal_across();
            let to = from + slide.guide.across * (OPENING * slide.action() * in_plane);
            if in_plane != 0.0 {
                self.scene.add(Class::Opening, Shape::Arrow { from, to });
            }
            self.circle(Class::Opening, from, DOT);
            let value = self.shown(acceleration, "m/s^2");
            self.value_along(Class::Opening, value, [from, to], slide.guide.along);
        }
    }

    /// The velocity of what moves in a joint (m/s), if it has an arrow: of the block, or of the guide past a block on
    /// ground.
    pub(super) fn velocity(&self, joint: JointId) -> Option<f64> {
        let (slide, slider) = (self.slide(joint)?, self.mechanism.slider(joint)?);
        let contact = self.actual.contact(self.mechanism, *slider.contacts.first()?);
        let velocity = slide.action() * contact.sliding_velocity;
        let is_other_shoe = slide.look == Look::Shoe { is_first: false };
        // The velocity of a joint that sticks is rounding.
        let is_shown =
            self.options.velocities && !is_other_shoe && velocity.abs() > AT_REST * self.mechanism.size;
        is_shown.then_some(velocity)
    }

    /// The velocities of all joints; each with the name of its joint, unless there is only one and no names are
    /// wanted.
    pub(super) fn velocities(&mut self) {
        let joints = (0..self.mechanism.joints.len()).map(JointId);
        let moving: Vec<(JointId, f64)> =
            joints.filter_map(|joint| Some((joint, self.velocity(joint)?))).collect();
        let has_names = self.options.names || moving.len() > 1;
        for (joint, velocity) in moving {
            let Some(slide) = self.slide(joint) else { continue };
            let half = slide.guide.along * (0.5 * VELOCITY * velocity.signum());
            let (middle, side) = self.free_place(&slide, half);
            self.scene.add(Class::Velocity, Shape::Arrow { from: middle - half, to: middle + half });
            let value = self.shown(velocity.abs(), "m/s");
            let name = &self.mechanism.joints[joint.index()].name;
            let text = if has_names { format!("{name}: {value}") } else { value };
            let ends = [middle - half, middle + half];
            self.value_along(Class::Velocity, text, ends, slide.guide.across * side);
        }
    }

    /// Where beside a guide the arrow of a velocity covers least, and on which side that is.
    fn free_place(&self, slide: &Slide, half: Point) -> (Point, f64) {
        let mut obstacles = obstacles(&self.scene);
        self.labels
            .iter()
            .filter(|label| label.class == Class::Dimension)
            .for_each(|label| reserve(label, &mut obstacles));
        let edge = slide.half_channel() + ASIDE;
        // A belt moves all along: its arrow keeps clear of what it carries.
        let along = if slide.look == Look::Rollers { 0.7 * slide.block_reach[1] } else { 0.0 };
        let mut best: Option<(f64, Point, f64)> = None;
        let upper = upper_side(slide.guide.across);
        let sides = [(upper, 0.0), (-upper, 4.0)];
        // A disc slides where it touches.
        let touches = |side: &f64| !slide.is_disc || *side < 0.0;
        for (side, aversion) in sides.into_iter().filter(|(side, _)| touches(side)) {
            for (shift, further) in PLACES {
                let middle = slide.block.origin
                    + slide.guide.across * ((edge + further) * side)
                    + slide.guide.along * (along + shift);
                let covered = obstacles
                    .iter()
                    .filter(|(place, _)| nearest_on_line(*place, [middle - half, middle + half]).0 < 6.0);
                let cost = aversion
                    + 0.1 * f64::abs(shift)
                    + 0.3 * further
                    + covered.map(|(_, weight)| weight).sum::<f64>();
                if best.is_none_or(|(least, ..)| cost < least) {
                    best = Some((cost, middle, side));
                }
            }
        }
        best.map_or((slide.block.origin, 1.0), |(_, middle, side)| (middle, side))
    }
}
