//! Friction circles of hinges, and the reactions tangent to them.

use super::Painter;
use super::outline::unit;
use super::scene::{Class, Point, Shape};
use nalgebra::Vector2;
use slideway::mechanism::{JointKind, Mechanism};
use slideway::motion::Sample;
use slideway::report::Solution;

/// The radius that the greatest friction circle has at most where circles are magnified, and below which they are.
const GREATEST: f64 = 22.0;
const TOO_SMALL: f64 = 9.0;
/// How far the line of a force is drawn beyond its arrow and its pin.
const BEYOND: f64 = 26.0;

/// The force of a hinge with friction.
#[derive(Debug, Clone, PartialEq)]
pub struct PinForce {
    /// The name of the hinge.
    pub(crate) hinge: String,
    /// Its force on the body on which the report counts it (N).
    pub(crate) force: [f64; 2],
    /// Its friction couple on that body (N m).
    pub(crate) couple: f64,
    /// The radius of its friction circle (m).
    pub(crate) radius: f64,
}

impl PinForce {
    /// Returns the forces in a solution of the hinges with friction.
    pub(super) fn of(solution: &Solution) -> Vec<Self> {
        let one = |hinge: &slideway::report::Hinge| {
            let friction = hinge.friction?;
            let (hinge, force) = (hinge.name.clone(), hinge.force);
            Some(Self { hinge, force, couple: friction.couple, radius: friction.radius })
        };
        solution.hinges.iter().filter_map(one).collect()
    }

    /// The hinges with friction at one time of a motion; no force where what sticks leaves it open.
    pub(crate) fn in_motion(mechanism: &Mechanism, sample: &Sample) -> Vec<Self> {
        let circles = mechanism.friction_circles.iter().zip(&sample.hinges);
        let one =
            |(circle, hinge): (&slideway::mechanism::FrictionCircle, &slideway::motion::HingeSample)| {
                let joint = &mechanism.joints[circle.joint.index()];
                let JointKind::Hinge([first, _]) = &joint.kind else { return None };
                let on_first = if first.frame.body().is_some() { 1.0 } else { -1.0 };
                let sign = if hinge.is_determined { on_first } else { 0.0 };
                Some(Self {
                    hinge: joint.name.to_string(),
                    force: hinge.force.map(|component| sign * component),
                    couple: sign * hinge.couple.unwrap_or(0.0),
                    radius: circle.radius,
                })
            };
        circles.filter_map(one).collect()
    }

    /// How great the force is (N).
    pub(crate) fn size(&self) -> f64 {
        self.force[0].hypot(self.force[1])
    }
}

impl Painter<'_> {
    /// The friction circles of all hinges with friction, magnified alike if they are too small to be seen, each with the
    /// force that is tangent to it.
    pub(super) fn pin_forces(&mut self) {
        let Some(force_scale) = self.options.force_scale else { return };
        let states = self.states;
        let greatest = states.pins.iter().map(|pin| pin.radius).fold(0.0, f64::max) * self.view.scale;
        if greatest == 0.0 {
            return;
        }
        let magnification = if greatest < TOO_SMALL { round(GREATEST / greatest) } else { 1.0 };
        self.scene.friction_circles = Some(magnification);
        for pin in &states.pins {
            self.pin_force(pin, magnification * self.view.scale, force_scale);
        }
    }

    /// A force `R` whose line passes the centre at `d` with `d x R = M`, `d` perpendicular to `R`.
    fn pin_force(&mut self, pin: &PinForce, scale: f64, force_scale: f64) {
        let joint = self.mechanism.joints.iter().find(|joint| *joint.name == *pin.hinge);
        let Some(JointKind::Hinge(ends)) = joint.map(|joint| &joint.kind) else { return };
        let centre = self.attached(&ends[0]);
        self.circle(Class::FrictionCircle, centre, pin.radius * scale);
        let (force, size) = (Vector2::from(pin.force), pin.size());
        if size == 0.0 {
            return;
        }
        let across = Vector2::new(force.y, -force.x) / size;
        let from = centre + self.view.direction(across * (pin.couple / size * scale));
        let along = unit(self.view.direction(force), Point::x());
        let length = size * force_scale;
        let to = from + along * length.min(self.options.longest_arrow);
        self.scene.add(Class::ActionLine, Shape::Line(vec![from - along * BEYOND, to + along * BEYOND]));
        self.arrow_of_force(Class::PinForce, (from, false), along * length, self.shown(size, "N"));
    }
}

/// The greatest of 1, 2, 5 times a power of ten that is not above a positive number.
fn round(value: f64) -> f64 {
    super::nice(value, &slideway::units::Unit::default())
}
