//! The report of a check: plain data, which are the JSON output.

use crate::fault::FaultKind;
use crate::model::Stop;
use crate::report::LoadSharing;
use crate::units::Units;
use crate::warning::WarningReport;
use serde::Serialize;
use std::fmt;

/// Version of the layout of a [`CheckReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/check/1";

/// The parts of a model, and the hindrances to solving it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CheckReport {
    /// Version of this layout: [`SCHEMA`].
    pub schema: &'static str,
    /// The model's title.
    pub title: Option<String>,
    /// The units in which texts show its numbers.
    #[serde(skip)]
    pub units: Units,
    /// True if nothing stands in the way of [`crate::solve::solve`] in this state: there are no findings.
    /// (What only the enumeration of the modes can tell, such as too many preload gaps, is not tried.)
    pub sound: bool,
    /// Everything for which that would be refused.
    pub findings: Vec<Finding>,
    /// The questions, and which of them the model can answer in this state.
    pub questions: Vec<Question>,
    /// Warnings of what is perhaps not meant, though it does not stand in the way.
    pub warnings: Vec<WarningReport>,
    /// Degrees of freedom and determinacy.
    pub mobility: MobilitySummary,
    /// How redundant guides share their load; absent if no constraint is redundant, or it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sharing: Option<LoadSharing>,
    /// Inertia of the motions that the joints leave.
    pub inertia: InertiaSummary,
    /// Ratio of the greatest to the least pivot of the kinetic equations, if they can be solved.
    pub condition: Option<f64>,
    /// True if the state could be assembled; if not, what depends on it is that of the drawing.
    pub assembled: bool,
    /// In how many steps the positions were followed from the drawing, each proven to stay on its assembly
    /// branch; absent where they are those of the drawing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steps_from_drawing: Option<usize>,
    /// The bodies.
    pub bodies: Vec<BodySummary>,
    /// The joints.
    pub joints: Vec<JointSummary>,
    /// The contacts of the sliding joints.
    pub contacts: Vec<ContactSummary>,
    /// Names of the loads.
    pub loads: Vec<String>,
    /// The drives.
    pub drives: Vec<DriveSummary>,
    /// The chosen coordinates.
    pub coordinates: Vec<CoordinateSummary>,
}

impl CheckReport {
    /// Returns whether the model can answer a question in this state: "solve", "drive", "hold" or "simulate".
    pub fn is_ready_for(&self, question: &str) -> bool {
        self.questions.iter().any(|asked| asked.name == question && asked.ready)
    }
}

/// Something for which the model would be refused.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Finding {
    /// The fault in words.
    pub message: String,
    /// The remedy.
    pub hint: Option<String>,
}

impl Finding {
    pub(super) fn of(kind: &FaultKind) -> Self {
        Self { message: kind.to_string(), hint: kind.hint() }
    }
}

/// A question, and whether the model can answer it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Question {
    /// The command that asks it: "solve" (and with it "limits", "size", "sweep", "map"), "drive", "hold", "simulate".
    pub name: &'static str,
    /// True if nothing stands in its way.
    pub ready: bool,
    /// Everything for which it would be refused.
    pub findings: Vec<Finding>,
    /// Its needs in a few words, if that is little: "a rate".
    pub needs: Vec<&'static str>,
}

/// Degrees of freedom and determinacy.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct MobilitySummary {
    /// Coordinates of all bodies: 3 b.
    pub body_coordinates: usize,
    /// Scalar constraints of the joints.
    pub constraints: usize,
    /// How many of them are independent.
    pub independent: usize,
    /// Motions that the joints leave.
    pub degrees_of_freedom: usize,
    /// True if all constraints are independent, so that the reactions are determinate.
    pub determinate: bool,
    /// True if dependent constraints are so in this position only.
    pub singular_position: bool,
    /// The joints among which the excess lies.
    pub joints_in_excess: Vec<String>,
    /// Changes that would make the structure determinate.
    pub suggestion: Option<String>,
}

/// Inertia of the motions that the joints leave.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct InertiaSummary {
    /// True if the mass matrix is regular on them: every motion has kinetic energy.
    pub regular: bool,
    /// The motions that have none.
    pub motions_without: Vec<String>,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct BodySummary {
    /// Its name.
    pub name: String,
    /// Mass (kg); 0 for a massless body.
    pub mass: f64,
    /// Moment of inertia about the centre of mass (kg m^2).
    pub moment_of_inertia: f64,
    /// How far its centre of mass is from its place in the drawing (m).
    pub moved_by: f64,
    /// By which angle it is turned against the drawing (rad), counter-clockwise.
    pub turned_by: f64,
}

/// A joint.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct JointSummary {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: JointForm,
    /// The bodies it joins; of a sliding joint first the block, then the guide.
    pub joins: [String; 2],
    /// Scalar constraints.
    pub constraints: usize,
    /// Direction `u` of a sliding joint in this state: that of `along`, turned with the guide.
    pub direction: Option<[f64; 2]>,
    /// Its positive direction of sliding, in words.
    pub positive: Option<String>,
    /// Displacement of a sliding joint (m).
    pub displacement: Option<f64>,
    /// Supported length of a block slider (m).
    pub overlap: Option<f64>,
    /// The stops at the least and at the greatest displacement, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stops: Option<[Option<Stop>; 2]>,
    /// Radii of the friction circle of a hinge with friction (m): while it turns, and at rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction_radii: Option<[f64; 2]>,
    /// The friction couples of the collar of a hinge by its force along z, turning and at rest (m); absent without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub collar_radii: Option<[f64; 2]>,
    /// The gaps of what is apart from its face (m); of a block those of the front and of the rear corner, if both are.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gaps: Vec<f64>,
}

/// The kind of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub enum JointForm {
    /// A hinge.
    #[serde(rename = "hinge")]
    Hinge,
    /// A block of some length in a guide, with contacts at both ends.
    #[serde(rename = "block slider")]
    BlockSlider,
    /// A block that its guide holds straight, with one contact and a couple.
    #[serde(rename = "guided slider")]
    GuidedSlider,
    /// A pin in a slot.
    #[serde(rename = "pin in slot")]
    PinInSlot,
    /// A corner on a face, which it may leave.
    #[serde(rename = "corner on face")]
    CornerOnFace,
    /// A block on a face, which both of its corners may leave.
    #[serde(rename = "block on face")]
    BlockOnFace,
    /// A disc on a face, which it may leave.
    #[serde(rename = "disc on face")]
    DiscOnFace,
    /// A disc on a disc or in a hole, which it may leave.
    #[serde(rename = "disc on disc")]
    DiscOnDisc,
}

impl fmt::Display for JointForm {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

/// The kind of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum CoordinateForm {
    /// The displacement of a sliding joint.
    Slide,
    /// The angle between two bodies.
    Rotation,
    /// The displacement of a point along a line.
    Displacement,
}

impl fmt::Display for CoordinateForm {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(formatter)
    }
}

/// A contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ContactSummary {
    /// "joint", "joint.front" or "joint.rear".
    pub name: String,
    /// Kinetic friction coefficient where the normal force is positive, and where it is negative.
    pub mu: [f64; 2],
    /// True if it depends on the sliding speed; it is given at that of the state.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub mu_depends_on_speed: bool,
    /// Static friction coefficient, likewise.
    pub mu_static: [f64; 2],
    /// Preload (N), likewise.
    pub preload: [f64; 2],
    /// Sliding velocity (m/s), if the state could be assembled.
    pub sliding_velocity: Option<f64>,
    /// Of a contact that shares its load with others: how it fits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fit: Option<ContactFit>,
}

/// How a contact fits that shares its load with others.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ContactFit {
    /// Total play between its faces (m).
    pub play: f64,
    /// How far the guide's line is displaced there, towards +n (m).
    pub misalignment: f64,
    /// Stiffness of a face (N/m), if the model gives it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
}

/// A drive.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DriveSummary {
    /// Its name.
    pub name: String,
    /// The coordinate whose motion it prescribes.
    pub coordinate: String,
}

/// A chosen coordinate.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CoordinateSummary {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: CoordinateForm,
    /// Its positive direction, in words.
    pub positive: String,
    /// "m" or "rad".
    pub unit: &'static str,
    /// Its value in the state.
    pub value: f64,
    /// Its rate.
    pub rate: f64,
}
