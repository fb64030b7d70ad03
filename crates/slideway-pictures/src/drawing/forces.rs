//! Normal reactions and friction where they act, and sliding velocities.

use super::labels::{obstacles, reserve};
use super::outline::{nearest_on_line, upper_side};
use super::scene::{Class, Point, Shape};
use super::sliders::Slide;
use super::{ContactForces, Painter};
use slideway::ids::{ContactId, Frame, JointId};
use slideway::model::{CarriedBy, SliderKind};

/// Velocities below this part of the size of the mechanism for each second have no arrow (1/s).
const AT_REST: f64 = 1e-9;
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
/// Length of the arrow of a velocity.
const VELOCITY: f64 = 40.0;

impl Painter<'_> {
    /// The forces of every contact on its block, at the pressed face `P - sign(N) (h/2) n` (theory, section
    /// 1).
    pub(super) fn contact_forces(&mut self) {
        let Some(scale) = self.options.force_scale else { return };
        for index in 0..self.mechanism.contacts.len() {
            let joint = self.mechanism.contacts[index].joint;
            let state = self.states.contacts.get(index).copied().unwrap_or_default();
            if let (Some(slide), Some(forces)) = (self.slide(joint), state.forces) {
                self.reaction(&slide, ContactId(index), forces, scale);
                self.friction(&slide, ContactId(index), state.side, forces, scale);
            }
        }
    }

    /// The place of the face where the block is pressed, as it is drawn: the corner of whatever carries the
    /// contact; in the middle if it is not pressed at all.
    fn face(&self, slide: &Slide, contact: ContactId, side: f64) -> Point {
        let place = self.view.place(self.configuration.contact(self.mechanism, contact).point);
        let is_of_block = self.mechanism.contacts[contact.index()].carried_by == CarriedBy::Block;
        let carrier = if is_of_block { slide.block } else { slide.guide };
        let half = if is_of_block == slide.around { slide.half_channel() } else { 0.5 * slide.height };
        let across = match side {
            side if side > 0.0 => -half,
            side if side < 0.0 => half,
            _ => 0.0,
        };
        let along = (place - carrier.origin).dot(&carrier.along);
        carrier.at(along, if slide.around { -across } else { across })
    }

    fn reaction(&mut self, slide: &Slide, contact: ContactId, forces: ContactForces, scale: f64) {
        if forces.normal == 0.0 {
            return;
        }
        let face = self.face(slide, contact, forces.normal);
        // The resultant of the pressure: C = x N about the middle of the face.
        let lever = if slide.kind == SliderKind::Guided { forces.couple / forces.normal } else { 0.0 };
        let face = face + slide.guide.along * (lever * self.view.scale);
        let direction = slide.guide.across * forces.normal.signum();
        let length = forces.normal.abs() * scale;
        let from = if slide.around { face } else { face - direction * length.max(super::loads::LEAST_ARROW) };
        self.arrow(Class::Reaction, from, from + direction * length, self.shown(forces.normal.abs(), "N"));
    }

    fn friction(&mut self, slide: &Slide, contact: ContactId, side: f64, forces: ContactForces, scale: f64) {
        if forces.friction == 0.0 {
            return;
        }
        let from = self.face(slide, contact, side);
        let direction = -slide.guide.along * forces.friction.signum();
        let length = forces.friction.abs() * scale;
        self.arrow(Class::Friction, from, from + direction * length, self.shown(forces.friction.abs(), "N"));
    }

    /// The velocity of what moves: the block, or the guide past a block on ground.
    pub(super) fn velocities(&mut self) {
        let mechanism = self.mechanism;
        for index in 0..mechanism.joints.len() {
            let (Some(slide), Some(slider)) = (self.slide(JointId(index)), mechanism.slider(JointId(index)))
            else {
                continue;
            };
            let Some(contact) = slider.contacts.first() else { continue };
            let velocity = self.actual.contact(mechanism, *contact).sliding_velocity;
            let velocity = if slide.block_frame == Frame::Ground { -velocity } else { velocity };
            // The velocity of a joint that sticks is rounding.
            if velocity.abs() <= AT_REST * mechanism.size {
                continue;
            }
            let half = slide.guide.along * (0.5 * VELOCITY * velocity.signum());
            let (middle, side) = self.free_place(&slide, half);
            self.scene.add(Class::Velocity, Shape::Arrow { from: middle - half, to: middle + half });
            let text = self.shown(velocity.abs(), "m/s");
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
        let mut best: Option<(f64, Point, f64)> = None;
        for (side, aversion) in
            [(upper_side(slide.guide.across), 0.0), (-upper_side(slide.guide.across), 4.0)]
        {
            for (shift, further) in PLACES {
                let middle = slide.block.origin
                    + slide.guide.across * ((edge + further) * side)
                    + slide.guide.along * shift;
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
