//! A mechanism with numbers: every formula of a model that does not depend on the motion is evaluated.
//!
//! Second stage of the pipeline: [`Model`] in, [`Mechanism`] out. Positions are those of the reference
//! drawing, in metres; loads may still hold formulas of coordinates, rates and time.

mod corner;
mod end_stop;
mod evaluation;
mod excess;
mod loose;
mod one_sided;
mod pad;
mod part;
mod press_fit;
mod relations;
mod space;

use crate::expression::{Expression, Values};
use crate::fault::{Fault, FaultKind, Faults, Place};
use crate::ids::{BodyId, ContactId, CoordinateId, FormulaId, Frame, JointId};
use crate::interval::{Interval, Real};
use crate::model::{
    CarriedBy, CrossingDirection, Face, Formula, HingeFriction, Model, OutlineCorner, PinLaw, PreloadLine,
    Round, SliderKind, Stop,
};
use crate::units::Units;
pub(crate) use corner::BareCorner;
pub(crate) use end_stop::EndStop;
use evaluation::Evaluation;
pub use excess::Excess;
pub(crate) use loose::LOOSE_FACES;
use nalgebra::Vector2;
pub use pad::Pad;
pub(crate) use part::{body_of, frames_of};
pub(crate) use relations::{Pieces, Relation, loaded_bodies, quantities};
pub use space::{BodyInSpace, Space};
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

/// Magnitudes in SI units with which every product of the equations stays within the range of floating point.
pub(crate) const MAGNITUDES: std::ops::RangeInclusive<f64> = 1e-60..=1e60;
/// More contacts are refused before any matrix is built: those would be large, too.
const MOST_CONTACTS: usize = 500;

/// A mechanism in its reference drawing: its numbers are rounded (`T` is `f64`), or lie within intervals.
#[derive(Debug, Clone)]
pub struct Mechanism<T = f64> {
    /// One line that says what it is.
    pub title: Option<String>,
    /// Acceleration of free fall (m/s^2).
    pub gravity: Vector2<T>,
    /// What it has out of the plane of its motion, if the model says something of that.
    pub space: Option<Space<T>>,
    /// Time of the state (s).
    pub time: T,
    /// The moving bodies.
    pub bodies: Vec<Body<T>>,
    /// The joints.
    pub joints: Vec<Joint<T>>,
    /// The contacts with friction, in the order of their joints.
    pub contacts: Vec<Contact<T>>,
    /// The friction of the hinges for which the model gives it, in the order of the joints.
    pub friction_circles: Vec<FrictionCircle<T>>,
    /// The loads.
    pub loads: Vec<Load<T>>,
    /// The drives.
    pub drives: Vec<Drive<T>>,
    /// The chosen coordinates.
    pub coordinates: Vec<Coordinate<T>>,
    /// Events for which a motion is watched.
    pub events: Vec<EventDefinition<T>>,
    /// The units in which its numbers are shown.
    pub units: Units,
    /// The diagonal of the rectangle around its points (m), as a unit of length; 1 if they all coincide.
    pub size: f64,
    /// Joint equations that redundant guides have in excess, and the contacts that are cut for them.
    pub excess: Excess,
    /// By what the coefficients of friction are multiplied, those that follow from sliding speeds, too.
    friction: T,
    parameters: Vec<T>,
    formulas: Arc<Vec<Formula>>,
}

/// A rigid body.
#[derive(Debug, Clone)]
pub struct Body<T = f64> {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// Mass (kg), zero for a massless body.
    pub mass: T,
    /// Moment of inertia about the centre of mass (kg m^2).
    pub moment_of_inertia: T,
    /// Centre of mass in the drawing; for a massless body the mean of the places of its joints.
    pub centre_of_mass: Vector2<T>,
    /// Its named points in the drawing.
    pub points: Vec<(Arc<str>, Vector2<T>)>,
    /// Its shape in the drawing, if the model gives one.
    pub shape: Option<Shape<T>>,
    /// The corners of its outline in the drawing, for looks only; empty if the model gives none.
    pub outline: Vec<OutlineCorner<Vector2<T>>>,
}

/// Shape of a homogeneous body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape<T = f64> {
    /// A thin bar between two places of the drawing.
    Bar([Vector2<T>; 2]),
    /// A rectangle about the centre of mass: width and height (m).
    Rectangle([T; 2]),
    /// A disc of this radius (m) about the centre of mass.
    Disc(T),
}

/// A point that moves with a frame.
#[derive(Debug, Clone, Copy)]
pub struct Attachment<T = f64> {
    /// Frame with which it moves.
    pub frame: Frame,
    /// Its place in the drawing.
    pub position: Vector2<T>,
    /// How far it is out of the drawing (m).
    pub z: T,
}

impl<T: Real> Attachment<T> {
    /// A point that moves with a frame, at this place of the drawing.
    pub fn new(frame: Frame, position: Vector2<T>) -> Self {
        Self { frame, position, z: T::zero() }
    }
}

/// A joint.
#[derive(Debug, Clone)]
pub struct Joint<T = f64> {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// What it carries out of the drawing without friction: a force along z, and couples about the direction of sliding
    /// and about the normal in the drawing, of a hinge about x and y.
    pub carries: [bool; 3],
    /// Kind of joint, with its data.
    pub kind: JointKind<T>,
}

/// What a joint joins, as it is in the drawing.
pub(crate) struct Joined<T> {
    /// The block and the guide, or the bodies of a hinge.
    pub(crate) frames: [Frame; 2],
    /// Where, and how far that is out of the drawing (m).
    pub(crate) place: (Vector2<T>, T),
    /// The frame with which its axes turn, and the direction of sliding and the normal, or x and y.
    pub(crate) axes_of: Frame,
    pub(crate) axes: [Vector2<T>; 2],
}

impl<T: Real> Joint<T> {
    /// What it joins.
    pub(crate) fn joined(&self) -> Joined<T> {
        match &self.kind {
            JointKind::Hinge([first, second]) => Joined {
                frames: [first.frame, second.frame],
                place: (first.position, first.z),
                axes_of: Frame::Ground,
                axes: [Vector2::x(), Vector2::y()],
            },
            JointKind::Slider(slider) => Joined {
                frames: [slider.block, slider.guide],
                place: (slider.at, slider.z),
                axes_of: slider.guide,
                axes: [slider.tangent, rot90(slider.tangent)],
            },
        }
    }
}

/// The kinds of joint.
#[derive(Debug, Clone)]
pub enum JointKind<T = f64> {
    /// A hinge; its friction is in [`Mechanism::friction_circles`].
    Hinge([Attachment<T>; 2]),
    /// A sliding joint.
    Slider(Slider<T>),
}

/// A sliding joint (theory, section 1).
#[derive(Debug, Clone)]
pub struct Slider<T = f64> {
    /// Which of the three kinds.
    pub kind: SliderKind,
    /// The block.
    pub block: Frame,
    /// The guide.
    pub guide: Frame,
    /// Middle of the block in the drawing, on the centre line of the guide.
    pub at: Vector2<T>,
    /// How far that is out of the drawing (m).
    pub z: T,
    /// Tangent u of the guide in the drawing; the normal is n = rot90(u).
    pub tangent: Vector2<T>,
    /// Distance of the contacts or length of the pressed face in the drawing (m).
    pub length: T,
    /// Distance of the rubbing faces (m), negative where the block surrounds the guide.
    pub height: T,
    /// The round face of the guide in the drawing, if it is not straight.
    pub round: Option<Round<T>>,
    /// The contacts at corners, or at a disc, that are apart from their face in the state.
    pub apart: Vec<Contact<T>>,
    /// True if it does not slip in the state, which leaves a motion less to the coordinates; what it does then is decided by the
    /// forces, as for any contact at rest.
    pub sticks: bool,
    /// Whether the block surrounds the guide, so that the opposite faces press.
    pub around: bool,
    /// Whether the block reaches its faces one by one in a motion, and whether it is one of these faces there.
    pub loose: bool,
    /// Limits of the displacement (m).
    pub travel: Option<[T; 2]>,
    /// The stops at the least and at the greatest displacement; without, the motion ends there.
    pub stops: [Option<Stop<T>>; 2],
    /// Its contacts: front, rear and further supports of a block slider, else the only one; then the negative faces
    /// of press fits.
    pub contacts: Vec<ContactId>,
}

/// A contact with friction.
#[derive(Debug, Clone)]
pub struct Contact<T = f64> {
    /// Name: "joint"; for a block "joint.front", "joint.rear", or "joint." and the name of a support.
    pub name: Arc<str>,
    /// The sliding joint it belongs to.
    pub joint: JointId,
    /// Distance from the middle of the block along the tangent in the drawing (m).
    pub offset: T,
    /// Its distances from the guide's line along n, and from the middle of the block along z (m).
    pub aside: [T; 2],
    /// Cosine and sine of the angle of its normal from n towards z, if that is not in the drawing.
    pub lean: Option<[T; 2]>,
    /// The distance of its rubbing faces along its normal (m), negative where the block surrounds the guide, if it is not
    /// that of the joint.
    pub height: Option<T>,
    /// Part with which it travels: block or guide.
    pub carried_by: CarriedBy,
    /// Kinetic friction coefficient where the normal force is positive, and where it is negative: at the
    /// sliding speed zero, or at that of the last call of
    /// [`Configuration::put_friction`](crate::configuration::Configuration::put_friction).
    pub mu: [T; 2],
    /// The formulas of those that depend on the sliding speed.
    pub law: [Option<FormulaId>; 2],
    /// Static friction coefficient, likewise; what is not given is the kinetic one at the sliding speed zero.
    pub mu_static: [T; 2],
    /// Preload (N), likewise.
    pub preload: [T; 2],
    /// Where the preload's friction acts.
    pub preload_line: PreloadLine,
    /// Stiffness of the guide (N/m), if the model gives it.
    pub stiffness: Option<T>,
    /// Total play between its faces (m).
    pub play: T,
    /// How far the guide's line is displaced there, towards +n (m): with a law, in the state of the last call of
    /// [`Configuration::put_friction`](crate::configuration::Configuration::put_friction).
    pub misalignment: T,
    /// The formula of a misalignment that depends on coordinates.
    pub misalignment_law: Option<FormulaId>,
    /// Length and width of the area in contact (m), if the model gives it.
    pub pad: Option<[T; 2]>,
    /// Which face of a press fit it is, with half of its preload.
    pub face: Option<Face<ContactId>>,
    /// Whether it lifts off its face in place of pressing another one; with it open the mode problem has what is
    /// a negative normal force of others.
    pub opens: bool,
    /// Coefficient of restitution of its impacts, if it lifts off.
    pub restitution: T,
    /// Its gap in the drawing (m): zero, unless it is apart from its face from the start.
    pub gap: T,
}

impl Contact {
    /// The mean bearing pressure under a normal force, `|N| / (length width)` (Pa); nothing without a pad.
    pub fn pressure(&self, normal_force: f64) -> Option<f64> {
        self.pad.map(|[length, width]| normal_force.abs() / length / width)
    }
}

impl<T: Real> Contact<T> {
    /// Whether the contact has neither friction nor preload, at whatever speed it slides.
    pub fn is_frictionless(&self) -> bool {
        !self.depends_on_speed() && self.mu == [T::zero(); 2] && self.preload == [T::zero(); 2]
    }

    /// Whether friction or preload may hold it at rest.
    pub(crate) fn may_hold(&self) -> bool {
        !self.is_frictionless() || self.mu_static != [T::zero(); 2]
    }

    /// Cosine and sine of the angle of its normal from n towards z.
    pub fn normal_across(&self) -> [T; 2] {
        self.lean.unwrap_or([T::one(), T::zero()])
    }

    /// The part with which it travels, and the one on whose line it stays: the guide, with which the block turns; of a corner of the
    /// guide that may lift off the face of the block.
    pub(crate) fn frames(&self, slider: &Slider<T>) -> [Frame; 2] {
        match self.carried_by {
            CarriedBy::Block => [slider.block, slider.guide],
            CarriedBy::Guide if self.opens => [slider.guide, slider.block],
            CarriedBy::Guide => [slider.guide; 2],
        }
    }

    /// Where it is in the drawing.
    pub fn position(&self, slider: &Slider<T>) -> Vector2<T> {
        let on_line = slider.at + slider.tangent * self.offset;
        if self.aside[0].is_zero() { on_line } else { on_line + rot90(slider.tangent) * self.aside[0] }
    }

    fn multiply_friction(&mut self, factor: T) {
        (self.mu, self.mu_static) = (self.mu.map(|mu| mu * factor), self.mu_static.map(|mu| mu * factor));
    }

    /// Whether its kinetic friction depends on its sliding speed.
    pub fn depends_on_speed(&self) -> bool {
        self.law != [None; 2]
    }
}

/// Friction of a hinge: while it turns, the reaction `R` is tangent to a circle about the hinged point, so that
/// its friction couple is `|M| = r |R|`; at rest it passes through the static circle, `|M| <= r_static |R|`.
///
/// That of a collar follows from one force alone, `|M| = r |F_z|`: it stands for both components, `|(F_z, F_z)| = sqrt(2) |F_z|`,
/// with radii `r/sqrt(2)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionCircle<T = f64> {
    /// The hinge, or the sliding joint of a round end.
    pub joint: JointId,
    /// The contacts of a round end along n and along z, of whose forces together the magnitude rubs along the rod: then in
    /// place of radii there are coefficients of friction.
    pub end: Option<[ContactId; 2]>,
    /// Radius r of the friction circle while the hinge turns (m).
    pub radius: T,
    /// Radius of the friction circle at rest (m).
    pub static_radius: T,
    /// Law from which the radii follow.
    pub law: CircleLaw<T>,
}

/// Law from which the radii of a friction circle follow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CircleLaw<T = f64> {
    /// They are given.
    Radius,
    /// A pin.
    Pin {
        /// Its friction coefficients, kinetic and static.
        mu: [T; 2],
        /// Its radius (m).
        radius: T,
        /// How the radius of the friction circle follows from them.
        law: PinLaw,
    },
    /// They are given, of a collar.
    Collar,
}

impl FrictionCircle {
    /// Whether there is friction, in motion or at rest.
    pub(crate) fn is_rough(&self) -> bool {
        self.radius.max(self.static_radius) > 0.0
    }

    /// Returns the number that is varied where static friction is: the coefficient of a pin, else the radius.
    pub(crate) fn static_friction(&self) -> f64 {
        match self.law {
            CircleLaw::Radius => self.static_radius,
            CircleLaw::Pin { mu: [_, mu], .. } => mu,
            CircleLaw::Collar => self.static_radius / FRAC_1_SQRT_2,
        }
    }

    /// The radius of the friction circle at rest with another value of [`Self::static_friction`].
    pub(crate) fn static_radius_with(&self, friction: f64) -> f64 {
        match self.law {
            CircleLaw::Radius => friction,
            CircleLaw::Pin { radius, law, .. } => law.friction_radius(friction, radius),
            CircleLaw::Collar => friction * FRAC_1_SQRT_2,
        }
    }

    /// Its radii by the force of which its friction is a part: of a collar its one force.
    pub(crate) fn radii_by_force(&self) -> [f64; 2] {
        let part = self.magnitude([FRAC_1_SQRT_2; 2]);
        [self.radius, self.static_radius].map(|radius| radius / part)
    }

    /// The magnitude of which its friction is a part: of a collar that of its one force.
    pub(crate) fn magnitude(&self, [x, y]: [f64; 2]) -> f64 {
        if self.is_collar() { x.abs() } else { x.hypot(y) }
    }
}

impl<T: Real> FrictionCircle<T> {
    /// Builds the friction circle of a hinge with this friction; `value` returns the value of each formula.
    pub(crate) fn new(joint: JointId, friction: &HingeFriction, value: impl Fn(FormulaId) -> T) -> Self {
        let [kinetic, at_rest] = match friction {
            HingeFriction::Collar(_) => friction.radii(&value).map(|radius| radius * T::exactly(0.5).sqrt()),
            _ => friction.radii(&value),
        };
        let law = match *friction {
            HingeFriction::Collar(_) => CircleLaw::Collar,
            HingeFriction::Circle(_) | HingeFriction::End(_) => CircleLaw::Radius,
            HingeFriction::Pin { mu, radius, law } => {
                CircleLaw::Pin { mu: mu.map(&value), radius: value(radius), law }
            }
        };
        Self { joint, end: None, radius: kinetic, static_radius: at_rest, law }
    }

    /// Whether it is that of a collar.
    pub(crate) fn is_collar(&self) -> bool {
        matches!(self.law, CircleLaw::Collar)
    }

    /// With its coefficients, or the radii that are given, multiplied by a factor.
    pub(crate) fn times(self, factor: T) -> Self {
        let (radii, law) = match self.law {
            CircleLaw::Radius | CircleLaw::Collar => {
                ([self.radius, self.static_radius].map(|radius| radius * factor), self.law)
            }
            CircleLaw::Pin { mu, radius, law } => {
                let mu = mu.map(|mu| mu * factor);
                (mu.map(|mu| law.friction_radius(mu, radius)), CircleLaw::Pin { mu, radius, law })
            }
        };
        let [radius, static_radius] = radii;
        Self { radius, static_radius, law, ..self }
    }
}

/// A number that may depend on the motion.
#[derive(Debug, Clone, Copy)]
pub enum Quantity<T = f64> {
    /// A constant.
    Constant(T),
    /// A formula of coordinates, rates and time.
    Varying(FormulaId),
}

/// A load.
#[derive(Debug, Clone)]
pub struct Load<T = f64> {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// Kind of load, with its data.
    pub kind: LoadKind<T>,
}

/// The kinds of load.
#[derive(Debug, Clone)]
pub enum LoadKind<T = f64> {
    /// A force at a point.
    Force {
        /// Where it acts.
        at: Attachment<T>,
        /// Components: along x and y, or along the drawn direction and zero.
        components: [Quantity<T>; 2],
        /// The directions of the components in the drawing.
        axes: [Vector2<T>; 2],
        /// Component along z.
        along_z: Quantity<T>,
        /// Whether the directions turn with the body.
        turns: bool,
        /// Frame on which the opposite force acts, if it acts on one.
        reaction: Option<Frame>,
    },
    /// A torque.
    Torque {
        /// The body.
        body: Frame,
        /// Its moment (N m).
        moment: Quantity<T>,
        /// Its moments about x and y (N m).
        tilt: [Quantity<T>; 2],
        /// Frame on which the opposite torque acts, if it acts on one.
        reaction: Option<Frame>,
    },
    /// A spring.
    Spring {
        /// Its ends.
        between: [Attachment<T>; 2],
        /// Stiffness (N/m).
        stiffness: Quantity<T>,
        /// Length without force (m).
        free_length: Quantity<T>,
    },
    /// A damper.
    Damper {
        /// Its ends.
        between: [Attachment<T>; 2],
        /// Damping coefficient (N s/m).
        damping: Quantity<T>,
    },
    /// A torsional spring.
    TorsionalSpring {
        /// The bodies.
        between: [Frame; 2],
        /// Torsional stiffness (N m).
        stiffness: Quantity<T>,
        /// Rotation without torque, from the drawing (rad).
        free_angle: Quantity<T>,
    },
    /// A torsional damper.
    TorsionalDamper {
        /// The bodies.
        between: [Frame; 2],
        /// Torsional damping coefficient (N m s).
        damping: Quantity<T>,
    },
    /// A pad at an end of the travel of a sliding joint.
    Pad(Pad<T>),
}

/// A prescribed motion.
#[derive(Debug, Clone)]
pub struct Drive<T = f64> {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// The coordinate whose motion is prescribed.
    pub coordinate: CoordinateId,
    /// The prescribed acceleration.
    pub acceleration: Quantity<T>,
    /// The unknown effort.
    pub effort: Effort<T>,
}

/// The unknown force or torque of a drive.
#[derive(Debug, Clone, Copy)]
pub enum Effort<T = f64> {
    /// A force (N) along a line of action.
    Force {
        /// Where it acts.
        at: Attachment<T>,
        /// Its direction in the drawing.
        direction: Vector2<T>,
        /// Whether the direction turns with the body.
        turns: bool,
        /// Frame on which the opposite force acts, if it acts on one.
        reaction: Option<Frame>,
    },
    /// A torque (N m).
    Torque {
        /// The body on which it acts.
        body: Frame,
        /// Frame on which the opposite torque acts, if it acts on one.
        reaction: Option<Frame>,
    },
}

impl<T> Effort<T> {
    /// The unit of its magnitude.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Force { .. } => "N",
            Self::Torque { .. } => "N m",
        }
    }
}

/// Something that happens in a motion when a quantity passes through zero.
#[derive(Debug, Clone)]
pub struct EventDefinition<T = f64> {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// The quantity.
    pub zero_of: Quantity<T>,
    /// In which direction it passes.
    pub direction: CrossingDirection,
    /// Whether the motion ends there.
    pub stops: bool,
}

/// A chosen coordinate.
#[derive(Debug, Clone)]
pub struct Coordinate<T = f64> {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the model file.
    pub place: Place,
    /// Motion that it measures.
    pub kind: CoordinateKind<T>,
    /// Its value in the drawing (m or rad).
    pub drawn_at: T,
    /// Its value in the state.
    pub value: T,
    /// Its rate in the state.
    pub rate: T,
}

/// Motion that a coordinate measures.
#[derive(Debug, Clone, Copy)]
pub enum CoordinateKind<T = f64> {
    /// Displacement of a sliding joint.
    Slide(JointId),
    /// Rotation of a body against a frame.
    Rotation(BodyId, Frame),
    /// Displacement of a point in a direction.
    Displacement(Attachment<T>, Vector2<T>),
}

impl<T> CoordinateKind<T> {
    /// Whether the coordinate is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Rotation(..))
    }
}

impl Slider {
    /// The least and the greatest displacement that are permitted (m), infinite where nothing limits it: a
    /// pad yields.
    pub fn limits(&self) -> [f64; 2] {
        let limit = |end: usize| {
            let yields = self.stops[end].is_some_and(|stop| stop.pad().is_some());
            self.travel.filter(|_| !yields).map(|travel| travel[end])
        };
        [limit(0).unwrap_or(f64::NEG_INFINITY), limit(1).unwrap_or(f64::INFINITY)]
    }

    /// The ends of the face of contacts that may lift off, from the place of the joint along it (m): the middle of a block stays half
    /// its length within them.
    pub(crate) fn face_ends(&self) -> [f64; 2] {
        let half = if self.kind == SliderKind::Block { self.length / 2.0 } else { 0.0 };
        let [least, greatest] = self.limits();
        [least - half, greatest + half]
    }
}

impl Mechanism {
    /// The ends of the face that a contact which may lift off touches, from the place of the joint along it (m): a part that has
    /// corners of its own carries the other one no farther than to them.
    pub(crate) fn ends_of_face(&self, slider: &Slider, contact: &Contact) -> [f64; 2] {
        let [corner, _] = contact.frames(slider);
        let own =
            if corner == slider.block { slider.face_ends() } else { [f64::NEG_INFINITY, f64::INFINITY] };
        let all = slider.contacts.iter().map(|id| &self.contacts[id.index()]).chain(&slider.apart);
        let others = all.filter(|other| other.frames(slider)[0] != corner);
        others.fold(own, |[least, greatest], other| {
            if other.offset > contact.offset {
                [least, greatest.min(other.offset)]
            } else {
                [least.max(other.offset), greatest]
            }
        })
    }

    /// The mechanism that a model describes, with the present values of its parameters.
    ///
    /// # Errors
    /// Every value that is not finite or not allowed, or too large or small to compute with.
    pub fn new(model: &Model) -> Result<Self, Faults> {
        Self::with_parameters(model, &[])
    }

    /// [`Self::new`] with other values of some parameters, which are given by their numbers.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub(crate) fn with_parameters(model: &Model, given: &[(usize, f64)]) -> Result<Self, Faults> {
        let evaluation = Evaluation { model, values: model.constants_with(given)? };
        let mut mechanism = evaluation.mechanism();
        mechanism.size = evaluation::size(&mechanism);
        mechanism.check_on_faces(evaluation.off_faces())?;
        mechanism.check_magnitudes()?;
        mechanism.check_play()?;
        mechanism.check_signs_of_play()?;
        mechanism.check_in_space()?;
        mechanism.excess = mechanism.found_excess();
        Ok(mechanism)
    }

    /// Within its play a block tilts by small angles only, so the play is less than the distance of its outermost
    /// contacts.
    fn check_play(&self) -> Result<(), Faults> {
        let mut faults = Faults::default();
        for joint in &self.joints {
            let JointKind::Slider(slider) = &joint.kind else { continue };
            let contacts = || self.places_of(slider).map(|contact| &self.contacts[contact.index()]);
            let ends = contacts()
                .map(|contact| contact.offset)
                .fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], offset| {
                    [least.min(offset), most.max(offset)]
                });
            let distance = ends[1] - ends[0];
            for contact in contacts().filter(|contact| distance > 0.0 && contact.play.abs() >= distance) {
                let [play, distance] = [contact.play, distance].map(|length| self.units.of("m").show(length));
                let kind = FaultKind::PlayBeyondBlock { contact: contact.place().to_owned(), play, distance };
                faults.push(Fault::new(kind, joint.place.clone()));
            }
        }
        faults.or(())
    }

    /// Products of a few quantities must stay within the range of floating point.
    fn check_magnitudes(&self) -> Result<(), Faults> {
        let mut faults = Faults::default();
        let mut check = |what: &dyn Fn() -> String, place: Option<&Place>, values: &[f64]| {
            let is_usual = |value: &f64| *value == 0.0 || MAGNITUDES.contains(&value.abs());
            if !values.iter().all(is_usual) {
                let kind = FaultKind::Overflow { quantity: what() };
                faults.push(
                    place.map_or(Fault::general(kind.clone()), |place| Fault::new(kind, place.clone())),
                );
            }
        };
        check(&|| "the size of the mechanism".into(), None, &[self.size]);
        check(&|| "gravity".into(), None, self.gravity.as_slice());
        check(&|| "gravity".into(), None, &[self.space.as_ref().map_or(0.0, |space| space.gravity)]);
        for body in &self.bodies {
            let values = [body.mass, body.moment_of_inertia, body.centre_of_mass.x, body.centre_of_mass.y];
            check(
                &|| format!("the mass, the moment of inertia or the place of {}", body.name),
                Some(&body.place),
                &values,
            );
        }
        for (body, in_space) in self.bodies.iter().zip(self.space.iter().flat_map(|space| &space.bodies)) {
            let values = [in_space.z, in_space.products[0], in_space.products[1]];
            check(
                &|| format!("the place or the products of inertia of {}", body.name),
                Some(&body.place),
                &values,
            );
        }
        for joint in &self.joints {
            let JointKind::Slider(slider) = &joint.kind else { continue };
            check(
                &|| format!("the size of {}", joint.name),
                Some(&joint.place),
                &[slider.length, slider.height],
            );
        }
        for contact in &self.contacts {
            let place = &self.joints[contact.joint.index()].place;
            let values = [contact.mu, contact.mu_static, contact.preload].concat();
            check(&|| format!("the friction of {}", contact.name), Some(place), &values);
            let in_section = [contact.aside[0], contact.aside[1], contact.height.unwrap_or_default()];
            check(&|| format!("the place of {}", contact.name), Some(place), &in_section);
            let elastic = [contact.play, contact.stiffness.unwrap_or_default()];
            check(&|| format!("the play or the stiffness of {}", contact.name), Some(place), &elastic);
        }
        for circle in &self.friction_circles {
            let Joint { name, place, .. } = &self.joints[circle.joint.index()];
            check(&|| format!("the friction of {name}"), Some(place), &[circle.radius, circle.static_radius]);
        }
        for coordinate in &self.coordinates {
            let values = [coordinate.value, coordinate.drawn_at, coordinate.rate];
            check(
                &|| format!("the value or the rate of {}", coordinate.name),
                Some(&coordinate.place),
                &values,
            );
        }
        faults.or(())
    }
}

impl Mechanism {
    /// Whether no drive moves a coordinate, counted from 0.
    pub(crate) fn is_free(&self, coordinate: usize) -> bool {
        self.drives.iter().all(|drive| drive.coordinate.index() != coordinate)
    }

    /// Refuses more contacts than can be dealt with, before any matrix is built.
    ///
    /// # Errors
    /// A fault that says how many contacts there are.
    pub(crate) fn check_size(&self) -> Result<(), Faults> {
        let contacts = self.contacts.len();
        if contacts > MOST_CONTACTS {
            return Err(Fault::general(FaultKind::TooManyContacts { contacts, limit: MOST_CONTACTS }).into());
        }
        Ok(())
    }
}

impl Mechanism {
    /// Refuses redundant guides, for what is not known of them.
    ///
    /// # Errors
    /// A fault that names the joints, if some share a load.
    pub(crate) fn check_determinate(&self, question: &'static str) -> Result<(), Faults> {
        let shares = |joint: &&Joint| match &joint.kind {
            JointKind::Slider(slider) => slider.contacts.iter().any(|contact| self.excess.shares(*contact)),
            JointKind::Hinge(_) => false,
        };
        let sharing: Vec<&Joint> = self.joints.iter().filter(shares).collect();
        let Some(first) = sharing.first() else { return Ok(()) };
        let joints = sharing.iter().map(|joint| joint.name.to_string()).collect();
        Err(Fault::new(FaultKind::SharedLoad { question, joints }, first.place.clone()).into())
    }
}

impl Mechanism {
    /// The friction of the round end of which a contact, counted from 0, is a part.
    pub(crate) fn end_of(&self, contact: usize) -> Option<&FrictionCircle> {
        let is_part =
            |circle: &&FrictionCircle| circle.end.is_some_and(|end| end.contains(&ContactId(contact)));
        self.friction_circles.iter().find(is_part)
    }

    /// Whether a contact, counted from 0, is a part of a round end.
    pub(crate) fn is_part_of_end(&self, contact: usize) -> bool {
        self.end_of(contact).is_some()
    }

    /// Whether some joint slides on a round rod.
    pub(crate) fn has_ends(&self) -> bool {
        self.ends().next().is_some()
    }

    /// The contacts that are parts of ends of blocks on round rods.
    pub(crate) fn ends(&self) -> impl Iterator<Item = ContactId> + '_ {
        self.friction_circles.iter().filter_map(|circle| circle.end).flatten()
    }

    /// Whether a joint slides on a round rod.
    pub(crate) fn is_on_rod(&self, slider: &Slider) -> bool {
        slider.contacts.iter().any(|contact| self.is_part_of_end(contact.index()))
    }

    /// The hinges whose kinetic friction is not zero, and the round ends, each with the number of its friction circle.
    pub(crate) fn rough_hinges(&self) -> impl Iterator<Item = (usize, JointId)> {
        let circles = self.friction_circles.iter().enumerate();
        circles.filter(|(_, circle)| circle.radius > 0.0).map(|(index, circle)| (index, circle.joint))
    }

    /// Refuses friction in hinges, for questions that do not take it into account.
    ///
    /// # Errors
    /// A fault that names the hinges, if some have friction.
    pub(crate) fn check_frictionless_hinges(&self) -> Result<(), Faults> {
        let has_friction = |circle: &&FrictionCircle| circle.radius.max(circle.static_radius) > 0.0;
        let circles = 0..self.friction_circles.len();
        let rough: Vec<usize> = circles.filter(|one| has_friction(&&self.friction_circles[*one])).collect();
        let Some(first) = rough.first() else { return Ok(()) };
        let place = self.joints[self.friction_circles[*first].joint.index()].place.clone();
        let hinges = rough.iter().map(|circle| self.circle_name(*circle)).collect();
        Err(Fault::new(FaultKind::FrictionInHinges { hinges }, place).into())
    }
}

impl Mechanism<Interval> {
    /// Intervals that hold the numbers of the mechanism that a model describes, which `nominal` has rounded.
    /// The parameters in `given` have their values from there.
    ///
    /// # Errors
    /// Every formula that has no finite or allowed value for some of the numbers within bounds.
    pub(crate) fn enclosing(
        nominal: &Mechanism,
        model: &Model,
        given: &[(usize, Interval)],
    ) -> Result<Self, Faults> {
        let values = model.enclosed_constants(given)?;
        let (size, excess) = (nominal.size, nominal.excess.clone());
        let mechanism = Self { size, excess, ..Evaluation { model, values }.mechanism() };
        mechanism.check_signs_of_play()?;
        Ok(mechanism)
    }
}

impl<T: Real> Mechanism<T> {
    /// Multiplies all coefficients of friction, kinetic and static, and the radii of friction circles that are given.
    pub(crate) fn multiply_friction(&mut self, factor: T) {
        self.multiply_friction_of_contacts(|_| factor);
        for joint in &mut self.joints {
            if let JointKind::Slider(slider) = &mut joint.kind {
                slider.apart.iter_mut().for_each(|contact| contact.multiply_friction(factor));
            }
        }
        for circle in &mut self.friction_circles {
            *circle = circle.times(factor);
        }
        self.friction *= factor;
    }

    /// Multiplies the coefficients of friction of each contact as they are at its sliding speed, by a factor of its own.
    pub(crate) fn multiply_friction_of_contacts(&mut self, factor: impl Fn(usize) -> T) {
        for (k, contact) in self.contacts.iter_mut().enumerate() {
            contact.multiply_friction(factor(k));
        }
    }

    /// The sliding joint with this number, if it is one.
    pub fn slider(&self, joint: JointId) -> Option<&Slider<T>> {
        match &self.joints[joint.index()].kind {
            JointKind::Slider(slider) => Some(slider),
            JointKind::Hinge(_) => None,
        }
    }

    /// Returns the sliding joints with their numbers, in their order.
    pub fn sliders(&self) -> impl Iterator<Item = (JointId, &Slider<T>)> {
        (0..self.joints.len()).map(JointId).filter_map(|joint| Some((joint, self.slider(joint)?)))
    }

    /// The hinged points of a joint, if it is a hinge.
    pub(crate) fn hinge(&self, joint: JointId) -> Option<&[Attachment<T>; 2]> {
        match &self.joints[joint.index()].kind {
            JointKind::Hinge(ends) => Some(ends),
            JointKind::Slider(_) => None,
        }
    }

    /// The friction of a hinge, if the model gives it; not that of its collar.
    pub fn friction_circle(&self, joint: JointId) -> Option<&FrictionCircle<T>> {
        self.circle_of(joint).map(|circle| &self.friction_circles[circle])
    }

    /// The friction of the collar of a hinge, if it has one.
    pub(crate) fn collar_of(&self, joint: JointId) -> Option<&FrictionCircle<T>> {
        self.friction_circles.iter().find(|circle| circle.joint == joint && circle.is_collar())
    }

    /// The number of the friction circle of a hinge.
    pub(crate) fn circle_of(&self, joint: JointId) -> Option<usize> {
        self.friction_circles.iter().position(|circle| circle.joint == joint && !circle.is_collar())
    }

    /// What has the friction of a circle: "pin" of a hinge, "pin.collar" of its collar.
    pub(crate) fn circle_name(&self, circle: usize) -> String {
        let circle = &self.friction_circles[circle];
        let name = &self.joints[circle.joint.index()].name;
        if circle.is_collar() { format!("{name}.collar") } else { name.to_string() }
    }

    /// Whether the friction of a contact's preload acts at another face when the contact changes its side.
    pub fn preload_changes_face(&self, contact: ContactId) -> bool {
        let Contact { joint, preload, preload_line, height, .. } = &self.contacts[contact.index()];
        let has_two_faces =
            self.slider(*joint).is_some_and(|slider| height.unwrap_or(slider.height) != T::zero());
        *preload_line == PreloadLine::Pressed && has_two_faces && *preload != [T::zero(); 2]
    }

    /// Whether the friction of a contact's preload is another one when the contact changes its side: another
    /// force, or one at another face. Only then may the contact rest between its faces (theory, section 3:
    /// preload gap).
    pub fn preload_jumps(&self, contact: ContactId) -> bool {
        let [positive, negative] = &self.contacts[contact.index()].preload;
        positive != negative || self.preload_changes_face(contact)
    }

    /// Kinetic friction coefficients of a contact, for both sides, with a number in place of the sliding speed (m/s), and with
    /// every relation on its piece, if pieces are given.
    ///
    /// # Errors
    /// A fault that names the speed if a coefficient is not finite or is negative there.
    pub(crate) fn friction_of(
        &self,
        contact: ContactId,
        speed: T,
        pieces: Option<&Pieces>,
    ) -> Result<[T; 2], Fault> {
        let Contact { mu, law, .. } = &self.contacts[contact.index()];
        let at = |side: usize| match law[side] {
            Some(id) => {
                let pieces = pieces.map_or(&[][..], |pieces| pieces.of(id));
                Ok(self.formulas[id.index()].at_speed(&self.parameters, speed, pieces)? * self.friction)
            }
            None => Ok(mu[side]),
        };
        let positive = at(0)?;
        Ok([positive, if law[1].is_some() && law[1] == law[0] { positive } else { at(1)? }])
    }

    /// Name of a frame.
    pub fn frame_name(&self, frame: Frame) -> &str {
        frame.body().map_or("ground", |body| &self.bodies[body.index()].name)
    }

    /// Value of a quantity in a state.
    ///
    /// # Errors
    /// A fault if a formula has no finite or allowed value there.
    pub fn quantity(
        &self,
        quantity: Quantity<T>,
        coordinates: &[T],
        rates: &[T],
        time: T,
    ) -> Result<T, Fault> {
        self.quantity_on(quantity, &self.values(coordinates, rates, time), None)
    }

    /// Evaluates a quantity with every relation on its piece, if pieces are given.
    ///
    /// # Errors
    /// As [`Self::quantity`].
    pub(crate) fn quantity_on(
        &self,
        quantity: Quantity<T>,
        values: &Values<'_, T>,
        pieces: Option<&Pieces>,
    ) -> Result<T, Fault> {
        match quantity {
            Quantity::Constant(value) => Ok(value),
            Quantity::Varying(id) => {
                let pieces = pieces.map_or(&[][..], |pieces| pieces.of(id));
                self.formulas[id.index()].value_on(values, pieces)
            }
        }
    }

    /// The expression of a formula.
    pub(crate) fn expression(&self, id: FormulaId) -> &Expression {
        &self.formulas[id.index()].expression
    }

    /// Returns the values for which the names in an expression stand in a state.
    pub(crate) fn values<'a>(&'a self, coordinates: &'a [T], rates: &'a [T], time: T) -> Values<'a, T> {
        Values { parameters: &self.parameters, coordinates, rates, time, sliding_speed: T::zero() }
    }
}

/// A vector turned by a right angle counter-clockwise: n = rot90(u).
pub fn rot90<T: Real>(vector: Vector2<T>) -> Vector2<T> {
    Vector2::new(-vector.y, vector.x)
}

/// The moments about x and y of a force with a component along z, by its arm (theory of loads in space).
pub(crate) fn tilting<T: Real>((arm, z): (Vector2<T>, T), (force, along_z): (Vector2<T>, T)) -> Vector2<T> {
    Vector2::new(arm.y * along_z - z * force.y, z * force.x - arm.x * along_z)
}

/// Length of a vector with a part out of the drawing.
pub(crate) fn length_in_space<T: Real>(vector: Vector2<T>, rise: T) -> T {
    if rise.is_zero() {
        length(vector)
    } else {
        (vector.x.square() + vector.y.square() + rise.square()).sqrt()
    }
}

/// Length of a vector.
pub(crate) fn length<T: Real>(vector: Vector2<T>) -> T {
    (vector.x.square() + vector.y.square()).sqrt()
}
