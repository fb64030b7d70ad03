//! A model file, read and checked: names resolved, formulas parsed, dimensions verified.
//!
//! First stage of the pipeline: TOML text in, [`Model`] or all its [`Faults`] out. Numbers are still formulas
//! of the parameters; [`crate::mechanism::Mechanism::new`] evaluates them.
//!
//! ```
//! use slideway::model::{Model, Settings};
//!
//! let model = Model::parse(r#"
//!     [parameters]
//!     m = "2 kg"
//!     [bodies.sledge]
//!     mass = "m"
//!     centre_of_mass = [0, 0]
//!     moment_of_inertia = 0.1
//!     [joints.track]
//!     type = "block_slider"
//!     block = "sledge"
//!     at = [0, 0]
//!     along = "0 deg"
//!     length = "20 cm"
//!     mu = 0.2
//!     [coordinates.x]
//!     slide = "track"
//!     rate = 1
//! "#).expect("a sound model");
//! assert_eq!(model.bodies[0].name.as_ref(), "sledge");
//!
//! let heavier = model.with(&Settings::default().parameter("m", "3 kg")).expect("m is a mass");
//! assert!(model.with(&Settings::default().parameter("m", "3 m")).is_err());
//! ```
//!
//! # Files
//! `file.rs` has one type for each table of the file, `quantity.rs` the kinds of value, `schema.json` is what
//! both give (`test_schema.rs` tests it), `structure.rs` checks a parsed file against it, `sections.rs`
//! deserializes entry by entry, `read/` resolves names, `check.rs` judges the whole, `bare.rs` tells which dimension numbers without a unit have, `value.rs` is what is
//! given, `settings.rs` applies changes, `hinge.rs` has hinges and their friction, `press_fit.rs` splits contacts with negative play, `typed.rs` tells in which units a file was typed, `outline.rs`
//! has the arcs of outlines.

mod bare;
mod check;
mod dependence;
mod file;
mod formula;
mod hinge;
pub mod outline;
mod press_fit;
mod quantity;
mod range;
mod read;
mod sections;
mod settings;
mod stop;
mod structure;
#[cfg(test)]
mod test_schema;
mod typed;
mod value;

pub(crate) use bare::BareNumber;
pub(crate) use dependence::Dependence;
pub use file::{CarriedBy, CrossingDirection, ForceFrame, PinLaw, PreloadLine};
pub(crate) use formula::POSITIVE;
pub use formula::{Allowed, Formula, Origin, Varies};
pub use hinge::{Hinge, HingeFriction};
pub use outline::OutlineCorner;
pub use press_fit::Face;
pub(crate) use press_fit::place_of;
pub use range::ParameterRange;
pub use settings::{Setting, SettingKind, Settings};
pub use stop::Stop;
pub use value::Value;

use crate::fault::{Fault, FaultKind, Faults, Place};
use crate::ids::{BodyId, CoordinateId, FormulaId, Frame, JointId};
use crate::units::{UnitSystem, Units};
use std::sync::Arc;

/// The name under which all coefficients of friction are scaled together.
pub const FRICTION: &str = "friction";

/// Largest model file that is read, in bytes.
pub const SIZE_LIMIT: u64 = 4 << 20;

/// Greatest number of bodies: the matrices are dense, and their cost grows with its third power.
pub const BODY_LIMIT: usize = 1000;

/// A checked model: what a model file says, with every reference resolved.
#[derive(Debug, Clone)]
pub struct Model {
    /// One line that says what the mechanism is.
    pub title: Option<String>,
    /// The named parameters, in the order of the file.
    pub parameters: Vec<Parameter>,
    /// Acceleration of free fall.
    pub gravity: Gravity,
    /// Time of the state; nothing means zero.
    pub time: Option<FormulaId>,
    /// The bodies, in the order of the file.
    pub bodies: Vec<Body>,
    /// The joints, in the order of the file.
    pub joints: Vec<Joint>,
    /// The loads, in the order of the file.
    pub loads: Vec<Load>,
    /// The drives, in the order of the file.
    pub drives: Vec<Drive>,
    /// The chosen coordinates, in the order of the file.
    pub coordinates: Vec<Coordinate>,
    /// Events for which a motion is watched, in the order of the file.
    pub events: Vec<EventDefinition>,
    /// Every formula of the model.
    pub formulas: Arc<Vec<Formula>>,
    /// The units in which its numbers are shown.
    pub units: Units,
    /// Doubts about settings that were applied, but perhaps not meant so.
    pub(crate) doubts: Vec<Fault>,
    /// The parameters in an order in which each uses only those before it.
    evaluation_order: Vec<usize>,
    /// The factor of all coefficients of friction ([`Model::with_friction`]).
    pub(crate) friction: f64,
    /// The formulas of outlines alone, which no answer depends on; those of named points are none of them.
    pub(crate) looks: Vec<FormulaId>,
}

/// Acceleration of free fall.
#[derive(Debug, Clone, Copy)]
pub enum Gravity {
    /// No gravity.
    None,
    /// Its magnitude, along -y.
    Down(FormulaId),
    /// Its components [x, y], and that along z if it is given.
    Components([FormulaId; 2], Option<FormulaId>),
}

/// A named number.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: Arc<str>,
    /// Its value.
    pub value: FormulaId,
}

/// A rigid body.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the file.
    pub place: Place,
    /// Its inertia, or that it is massless.
    pub inertia: Inertia,
    /// Its named points.
    pub points: Vec<NamedPoint>,
    /// The corners of its outline in the drawing, for looks only; empty if the file gives none.
    pub outline: Vec<OutlineCorner<[FormulaId; 2]>>,
}

/// A named point of the drawing.
#[derive(Debug, Clone)]
pub struct NamedPoint {
    /// Its name.
    pub name: Arc<str>,
    /// Its world coordinates in the drawing.
    pub position: [FormulaId; 2],
    /// How far it is out of the drawing, if that is given.
    pub z: Option<FormulaId>,
}

/// Inertia of a body.
#[derive(Debug, Clone)]
pub enum Inertia {
    /// A body without mass.
    Massless,
    /// A body with mass.
    Massive {
        /// Mass (kg).
        mass: FormulaId,
        /// Centre of mass in the drawing; nothing means the middle of the bar.
        centre_of_mass: Option<[FormulaId; 2]>,
        /// How far the centre of mass is out of the drawing, if that is given.
        z: Option<FormulaId>,
        /// Products of inertia `int x z dm` and `int y z dm` about the centre of mass, if they are given.
        products: Option<[FormulaId; 2]>,
        /// Source of its moment of inertia.
        moment: Moment,
    },
}

/// Source of a moment of inertia about the centre of mass.
#[derive(Debug, Clone)]
pub enum Moment {
    /// The number itself (kg m^2).
    Given(FormulaId),
    /// A thin bar between two places of the drawing.
    Bar([[FormulaId; 2]; 2]),
    /// A rectangle of this width and height.
    Rectangle([FormulaId; 2]),
    /// A box of this width, height and depth.
    Box([FormulaId; 3]),
    /// A disc of this radius.
    Disc(FormulaId),
}

/// A point of a body, by its place in the drawing.
#[derive(Debug, Clone)]
pub struct Attachment {
    /// Frame with which it moves.
    pub frame: Frame,
    /// The point's name.
    pub name: Arc<str>,
    /// World coordinates in the drawing.
    pub position: [FormulaId; 2],
    /// How far it is out of the drawing, if that is given.
    pub z: Option<FormulaId>,
}

/// A joint.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the file.
    pub place: Place,
    /// What it carries out of the drawing without friction, if the file says so: a force along z, and couples about
    /// the direction of sliding and the normal, for hinges about x and y.
    pub carries: Option<[bool; 3]>,
    /// Kind of joint, with its data.
    pub kind: JointKind,
}

/// The kinds of joint.
#[derive(Debug, Clone)]
pub enum JointKind {
    /// A hinge between two points.
    Hinge(Box<Hinge>),
    /// One of the sliding joints.
    Slider(Box<Slider>),
}

/// The three sliding joints of theory section 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SliderKind {
    /// Two contacts, one at each end.
    Block,
    /// One contact and a couple.
    Guided,
    /// One contact, free to rotate.
    Pin,
}

/// A sliding joint.
#[derive(Debug, Clone)]
#[expect(clippy::struct_excessive_bools, reason = "independent properties")]
pub struct Slider {
    /// Which of the three kinds.
    pub kind: SliderKind,
    /// The block.
    pub block: Frame,
    /// The guide.
    pub guide: Frame,
    /// Middle of the block in the drawing.
    pub at: [FormulaId; 2],
    /// How far it is out of the drawing, if that is given.
    pub z: Option<FormulaId>,
    /// Direction of positive sliding in the drawing.
    pub along: Along,
    /// Distance of the contacts, or length of the pressed face; zero for a pin.
    pub length: Option<FormulaId>,
    /// Distance of the rubbing faces.
    pub height: Option<FormulaId>,
    /// Radius of a disc, whose centre is `at`.
    pub radius: Option<FormulaId>,
    /// The round face of the guide, if it is not straight.
    pub round: Option<Round<FormulaId>>,
    /// Which of the contacts that may lift off touch in the state to be solved.
    pub touches: Touches,
    /// True if it does not slip in the state to be solved.
    pub sticks: bool,
    /// Whether the block surrounds the guide.
    pub around: bool,
    /// Whether the block reaches its faces one by one in a motion.
    pub loose: bool,
    /// Limits of the displacement.
    pub travel: Option<[FormulaId; 2]>,
    /// Whether the two points of `along` are the ends of its face.
    pub has_ends: bool,
    /// The stops at the least and at the greatest displacement; without, the motion ends there.
    pub stops: [Option<Stop<FormulaId>>; 2],
    /// Its contacts: front, rear and further supports of a block slider, else the only one; then the negative faces
    /// of press fits.
    pub contacts: Vec<Contact>,
    /// Those that do not touch in the state to be solved.
    pub apart: Vec<Contact>,
    /// The places at which it presses a round rod in any direction across it.
    pub ends: Vec<RoundEnd>,
}

/// A place at which a block presses a round rod in any direction across it: two contacts without friction of their own, along n
/// and along z, of which the magnitude of both forces together rubs.
#[derive(Debug, Clone)]
pub struct RoundEnd {
    /// Its two contacts among those of the joint: along n, and along z.
    pub contacts: [usize; 2],
    /// Its friction.
    pub friction: HingeFriction,
}

/// A direction in the drawing.
#[derive(Debug, Clone)]
pub enum Along {
    /// Angle from the x axis.
    Angle(FormulaId),
    /// From one point to another.
    Points(Box<[NamedPoint; 2]>),
    /// At right angles to the line from one place to another, which is on its left.
    Across([[FormulaId; 2]; 2]),
}

/// A round face.
#[derive(Debug, Clone, Copy)]
pub struct Round<N> {
    /// Its centre in the drawing.
    pub centre: [N; 2],
    /// Its radius.
    pub radius: N,
    /// Whether it is a hole around the block.
    pub inside: bool,
}

/// Which contacts of a joint touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touches {
    /// All of them.
    All,
    /// That at the front end of a block alone.
    Front,
    /// That at the rear end of a block alone.
    Rear,
    /// None.
    Nothing,
}

/// A contact with friction.
#[derive(Debug, Clone)]
pub struct Contact {
    /// Name: "joint"; for a block "joint.front", "joint.rear", or "joint." and the name of a support.
    pub name: Arc<str>,
    /// Its place from the middle of the block; nothing means an end of a block, or its middle for other sliders.
    pub offset: Option<FormulaId>,
    /// Its distance from the guide's line along n, and from the drawing along z.
    pub aside: [Option<FormulaId>; 2],
    /// Of a corner on which a block rests: by what the distances of both ends and of both sides are multiplied to give its
    /// place and its distance along n.
    pub corner: Option<[f64; 2]>,
    /// The angle of its normal from n towards z, which is 90 degrees at a corner.
    pub normal: Option<FormulaId>,
    /// Whether it is the part along z of a round end, which has another one along n.
    pub along_z: bool,
    /// The distance of its faces along its normal; nothing means that of the joint, or zero where its normal leans.
    pub height: Option<FormulaId>,
    /// Part with which it travels: block or guide.
    pub carried_by: CarriedBy,
    /// Kinetic friction coefficient where the normal force is positive, and where it is negative.
    pub mu: [FormulaId; 2],
    /// Static friction coefficient, likewise.
    pub mu_static: [FormulaId; 2],
    /// Preload, likewise.
    pub preload: [Option<FormulaId>; 2],
    /// Where the preload's friction acts.
    pub preload_line: PreloadLine,
    /// Stiffness of the guide.
    pub stiffness: Option<FormulaId>,
    /// Total play between its faces.
    pub play: Option<FormulaId>,
    /// How far the guide's line is displaced there.
    pub misalignment: Option<FormulaId>,
    /// The part of its closing velocity with which it leaves its face after an impact, if it can leave it.
    pub restitution: Option<FormulaId>,
    /// Its area, for the bearing pressure.
    pub pad: Option<Pad>,
    /// Which face of a press fit it is.
    pub face: Option<Face<usize>>,
    /// Whether it lifts off its face in place of pressing another one.
    pub opens: bool,
    /// Whether it does so beside contacts of the same joint that press both faces.
    pub one_sided: bool,
}

/// The area in contact at a contact.
#[derive(Debug, Clone, Copy)]
pub struct Pad {
    /// Its length; nothing means that of the joint.
    pub length: Option<FormulaId>,
    /// Its width.
    pub width: FormulaId,
}

impl Slider {
    /// The coefficients of restitution of its stops and of its contacts that may lift off.
    pub(crate) fn restitutions(&self) -> impl Iterator<Item = FormulaId> + '_ {
        let contacts = self.contacts.iter().chain(&self.apart).filter_map(|contact| contact.restitution);
        self.stops.into_iter().flatten().filter_map(Stop::restitution).chain(contacts)
    }
}

impl Contact {
    /// The formulas of its coefficients of friction and preloads.
    pub(crate) fn friction(&self) -> impl Iterator<Item = FormulaId> + use<> {
        let preload = self.preload.into_iter().flatten();
        self.mu.into_iter().chain(self.mu_static).chain(preload)
    }
}

/// A load.
#[derive(Debug, Clone)]
pub struct Load {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the file.
    pub place: Place,
    /// Kind of load, with its data.
    pub kind: LoadKind,
}

/// The kinds of load.
#[derive(Debug, Clone)]
pub enum LoadKind {
    /// A force at a point.
    Force {
        /// Where it acts.
        at: Attachment,
        /// Its value.
        force: ForceValue,
        /// Its component along z, if that is given.
        along_z: Option<FormulaId>,
        /// In which frame its direction is fixed.
        frame: ForceFrame,
        /// Frame on which the opposite force acts, if it acts on one.
        reaction: Option<Frame>,
    },
    /// A torque on a body.
    Torque {
        /// The body.
        body: Frame,
        /// Its moment.
        moment: FormulaId,
        /// Its moments about x and y, if they are given.
        tilt: Option<[FormulaId; 2]>,
        /// Frame on which the opposite torque acts, if it acts on one.
        reaction: Option<Frame>,
    },
    /// A spring between two points.
    Spring {
        /// Its ends.
        between: [Attachment; 2],
        /// Stiffness.
        stiffness: FormulaId,
        /// Length without force; nothing means its length in the drawing.
        free_length: Option<FormulaId>,
    },
    /// A damper between two points.
    Damper {
        /// Its ends.
        between: [Attachment; 2],
        /// Damping coefficient.
        damping: FormulaId,
    },
    /// A torsional spring between two bodies.
    TorsionalSpring {
        /// The bodies.
        between: [Frame; 2],
        /// Torsional stiffness.
        stiffness: FormulaId,
        /// Rotation without torque, counted from the drawing.
        free_angle: Option<FormulaId>,
    },
    /// A torsional damper between two bodies.
    TorsionalDamper {
        /// The bodies.
        between: [Frame; 2],
        /// Torsional damping coefficient.
        damping: FormulaId,
    },
}

/// Value of a force.
#[derive(Debug, Clone)]
pub enum ForceValue {
    /// Components [x, y].
    Components([FormulaId; 2]),
    /// Magnitude along a direction.
    Along(FormulaId, Along),
}

/// A prescribed motion and what produces it.
#[derive(Debug, Clone)]
pub struct Drive {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the file.
    pub place: Place,
    /// The coordinate whose motion is prescribed.
    pub coordinate: CoordinateId,
    /// The prescribed acceleration; nothing means zero.
    pub acceleration: Option<FormulaId>,
    /// The unknown effort.
    pub effort: Effort,
}

/// The unknown force or torque of a drive.
#[derive(Debug, Clone)]
pub enum Effort {
    /// A force along a line of action.
    Force {
        /// Where it acts.
        at: Attachment,
        /// Its direction.
        direction: Along,
        /// In which frame the direction is fixed.
        frame: ForceFrame,
        /// Frame on which the opposite force acts, if it acts on one.
        reaction: Option<Frame>,
    },
    /// A torque.
    Torque {
        /// The body on which it acts.
        body: Frame,
        /// Frame on which the opposite torque acts, if it acts on one.
        reaction: Option<Frame>,
    },
}

/// A chosen coordinate.
#[derive(Debug, Clone)]
pub struct Coordinate {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the file.
    pub place: Place,
    /// Motion that it measures.
    pub kind: CoordinateKind,
    /// Its value in the drawing; nothing means zero.
    pub drawn_at: Option<FormulaId>,
    /// Its value in the state; nothing means that of the drawing.
    pub value: Option<FormulaId>,
    /// Its rate in the state; nothing means zero.
    pub rate: Option<FormulaId>,
}

/// Motion that a coordinate measures.
#[derive(Debug, Clone)]
pub enum CoordinateKind {
    /// Displacement of a sliding joint.
    Slide(JointId),
    /// Rotation of a body against another.
    Rotation {
        /// The body.
        body: BodyId,
        /// Frame against which the rotation is counted.
        relative_to: Frame,
    },
    /// Displacement of a point in the direction of x.
    X(Attachment),
    /// Displacement of a point in the direction of y.
    Y(Attachment),
}

/// Something that happens in a motion when a quantity passes through zero.
#[derive(Debug, Clone)]
pub struct EventDefinition {
    /// Its name.
    pub name: Arc<str>,
    /// Its entry in the file.
    pub place: Place,
    /// The quantity, of any dimension.
    pub zero_of: FormulaId,
    /// In which direction it passes.
    pub direction: CrossingDirection,
    /// Whether the motion ends there.
    pub stops: bool,
}

impl CoordinateKind {
    /// Whether the coordinate is an angle.
    pub fn is_angle(&self) -> bool {
        matches!(self, Self::Rotation { .. })
    }
}

impl Model {
    /// Whether there are guided sliders, which tip rather than press one corner against each face.
    pub(crate) fn has_guided_sliders(&self) -> bool {
        let is_guided = |joint: &Joint| matches!(&joint.kind, JointKind::Slider(slider) if slider.kind == SliderKind::Guided);
        self.joints.iter().any(is_guided)
    }

    /// The model that a TOML text describes.
    ///
    /// # Errors
    /// Every fault of the text, each with its place: syntax, keys, names, expressions, dimensions.
    pub fn parse(text: &str) -> Result<Self, Faults> {
        if text.len() as u64 > SIZE_LIMIT {
            let kind = FaultKind::TooLarge { limit: SIZE_LIMIT };
            return Err(Fault::general(kind).into());
        }
        if text.trim().is_empty() {
            return Err(Fault::general(FaultKind::Empty).into());
        }
        read::read(text)
    }

    /// The model that the bytes of a file describe.
    ///
    /// # Errors
    /// As [`Model::parse`], and where the bytes are not UTF-8.
    pub fn parse_bytes(bytes: &[u8]) -> Result<Self, Faults> {
        match std::str::from_utf8(bytes) {
            Ok(text) => Self::parse(text),
            Err(error) => {
                let offset = error.valid_up_to();
                let kind = FaultKind::NotUtf8 { byte: bytes[offset] };
                Err(Fault::new(kind, Place::model(offset..offset + 1)).into())
            }
        }
    }

    /// The model with its numbers shown in these units.
    #[must_use]
    pub fn with_units(self, system: UnitSystem) -> Self {
        Self { units: self.units.in_system(system), ..self }
    }

    /// The model with all its friction multiplied by a factor: the coefficients of contacts and pins, kinetic and static,
    /// and the radii of friction circles that are given.
    #[must_use]
    pub(crate) fn with_friction(self, factor: f64) -> Self {
        Self { friction: self.friction * factor, ..self }
    }

    /// The formula with this number.
    pub fn formula(&self, id: FormulaId) -> &Formula {
        &self.formulas[id.index()]
    }
}

const SCHEMA: &str = include_str!("schema.json");

/// JSON Schema of the model-file format, made from the types that read it.
///
/// ```
/// let schema = slideway::model::json_schema();
/// assert_eq!(schema["title"], "Slideway model");
/// ```
pub fn json_schema() -> serde_json::Value {
    serde_json::from_str(SCHEMA).expect("the schema is JSON")
}
