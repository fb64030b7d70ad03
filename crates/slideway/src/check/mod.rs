//! The parts of a model, and the questions that it can answer: degrees of freedom, determinacy, inertia, sliding.
//!
//! Stands beside [`mod@crate::solve`]: where that stops at the first thing that makes no sense, a check goes
//! on as far as it can and gathers what it finds.
//!
//! ```
//! use slideway::{check, gallery, model::Model};
//!
//! let bracket = Model::parse(gallery::find("bracket-on-pole").expect("in the gallery").text)?;
//! let report = check::check(&bracket)?;
//! assert!(!report.sound && report.is_ready());
//! assert_eq!(report.inertia.motions_without, ["bracket moves along (0, -1)"]);
//! # Ok::<(), slideway::fault::Faults>(())
//! ```

mod directions;
mod questions;
mod text;

pub use questions::Question;

use crate::configuration::{
    Configuration, Mobility, Pose, every_motion_has_inertia, free_motions, motions_without_inertia, unit,
};
use crate::fault::{FaultKind, Faults};
use crate::ids::{ContactId, JointId};
use crate::influence::Influence;
use crate::kinetics::{Assembled, KineticEquations};
use crate::mechanism::{CoordinateKind, JointKind, Mechanism, Slider};
use crate::model::{Coordinate, Model, SliderKind, Stop};
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::{LoadSharing, finite};
use crate::solve::{Sliding, check_hinges, check_standing, load_sharing, mode_problem};
use crate::units::Units;
use crate::warning::{WarningReport, warnings};
use nalgebra::DVector;
use serde::Serialize;
use std::fmt;

/// Version of the layout of a [`CheckReport`]; changes whenever a field is renamed or removed.
pub const SCHEMA: &str = "slideway/check/1";

/// Bodies that have moved from the drawing by less than this part of the mechanism's size, or are turned by
/// less (rad), have not: that is the rounding of its closed joints.
const MOVED: f64 = 1e-9;

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
        formatter.write_str(match self {
            Self::Hinge => "hinge",
            Self::BlockSlider => "block slider",
            Self::GuidedSlider => "guided slider",
            Self::PinInSlot => "pin in slot",
            Self::CornerOnFace => "corner on face",
            Self::BlockOnFace => "block on face",
            Self::DiscOnFace => "disc on face",
            Self::DiscOnDisc => "disc on disc",
        })
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
        formatter.write_str(match self {
            Self::Slide => "slide",
            Self::Rotation => "rotation",
            Self::Displacement => "displacement",
        })
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

/// Lists the parts of a model and everything that hinders solving it.
///
/// # Errors
/// Values that are not finite or not allowed: then there is nothing to check.
pub fn check(model: &Model) -> Result<CheckReport, Faults> {
    undisturbed(|work| checked(model, work))
}

/// [`check`] with a callback; `None` once that has broken.
///
/// # Errors
/// As [`check`].
pub fn check_with(model: &Model, progress: &mut Callback<'_>) -> Result<Option<CheckReport>, Faults> {
    watched(progress, |work| checked(model, work))
}

fn checked(model: &Model, work: Work<'_>) -> Result<CheckReport, Faults> {
    let mut mechanism = Mechanism::new(model)?;
    let mut faults = Faults::default();
    let mut keep = |result: Result<(), Faults>| faults.append(result.err().unwrap_or_default());
    // What is too large to be solved is too large to be analysed further.
    mechanism.check_size()?;
    let drawing = Configuration::drawing(&mechanism);
    let state = Configuration::with_progress(&mechanism, &mut |progress| work.tell(progress));
    keep(state.as_ref().map(|_| ()).map_err(Clone::clone));
    let assembled = state.is_ok();
    let original = mechanism.clone();
    let configuration = state.unwrap_or(drawing);
    let mobility = Mobility::of(&mechanism, &configuration);
    let (mut condition, mut sharing) = (None, None);
    if assembled {
        keep(configuration.put_friction(&mut mechanism));
        let sliding = Sliding::of(&mechanism, &configuration);
        match KineticEquations::new_while(&mechanism, &configuration, &mut || !work.is_over()) {
            Ok(equations) => {
                condition = Some(equations.condition());
                let influence = Influence::new(&equations);
                keep(check_hinges(&mechanism, &configuration, &influence));
                match (load_sharing(&mechanism, &influence), &sliding) {
                    (Err(found), _) => keep(Err(found)),
                    (Ok(found), Ok(Sliding { signs, standing })) => {
                        sharing = found;
                        keep(check_standing(&mechanism, standing));
                        keep(mode_problem(&mechanism, &influence, signs).map(|_| ()));
                    }
                    (Ok(found), Err(_)) => sharing = found,
                }
            }
            Err(found) => keep(Err(found)),
        }
        keep(sliding.map(|_| ()));
    }
    let inertia = inertia(&mechanism, &configuration);
    finite(CheckReport {
        schema: SCHEMA,
        title: mechanism.title.clone(),
        units: model.units.clone(),
        sound: faults.is_empty(),
        findings: faults.sorted().iter().map(|fault| Finding::of(&fault.kind)).collect(),
        questions: questions::questions(
            (model, &original),
            assembled.then_some(&configuration),
            &faults,
            work,
        ),
        warnings: WarningReport::list(&warnings(model)),
        mobility: mobility_summary(&mechanism, &mobility),
        sharing,
        inertia,
        condition,
        assembled,
        steps_from_drawing: configuration.steps_from_drawing(),
        bodies: bodies(&mechanism, &configuration),
        joints: joints(&mechanism, &configuration),
        contacts: contacts(&mechanism, &configuration, assembled),
        loads: mechanism.loads.iter().map(|load| load.name.to_string()).collect(),
        drives: drives(&mechanism),
        coordinates: coordinates((model, &mechanism), &configuration),
    })
}

impl Finding {
    fn of(kind: &FaultKind) -> Self {
        Self { message: kind.to_string(), hint: kind.hint() }
    }
}

impl CheckReport {
    /// True if some question can be answered in this state.
    pub fn is_ready(&self) -> bool {
        self.questions.iter().any(|question| question.ready)
    }
}

fn mobility_summary(mechanism: &Mechanism, mobility: &Mobility) -> MobilitySummary {
    let redundancy = mobility.redundancy.as_ref();
    let name = |joint: &crate::ids::JointId| mechanism.joints[joint.index()].name.to_string();
    MobilitySummary {
        body_coordinates: mobility.body_coordinates,
        constraints: mobility.constraints,
        independent: mobility.independent,
        degrees_of_freedom: mobility.degrees_of_freedom(),
        determinate: redundancy.is_none() && !mechanism.is_redundant(),
        singular_position: redundancy.is_some_and(|redundancy| redundancy.only_here),
        joints_in_excess: redundancy.map_or(vec![], |r| r.joints.iter().map(name).collect()),
        suggestion: redundancy.and_then(|redundancy| redundancy.suggestion.clone()),
    }
}

/// The motions z = Z x with x^T Z^T M Z x = 0.
fn inertia(mechanism: &Mechanism, configuration: &Configuration) -> InertiaSummary {
    // The motions of hundreds of bodies take seconds.
    if every_motion_has_inertia(mechanism) {
        return InertiaSummary { regular: true, motions_without: Vec::new() };
    }
    let motions = free_motions(mechanism, configuration);
    // Where a load has no value it is told elsewhere, and leaves the sense of a motion open.
    let without_loads = || DVector::zeros(motions.nrows());
    let loads = Assembled::new(mechanism, configuration)
        .map_or_else(|_| without_loads(), |assembled| assembled.load.rows(0, motions.nrows()).into_owned());
    let motions_without = motions_without_inertia(mechanism, configuration, &motions, &loads);
    InertiaSummary { regular: motions_without.is_empty(), motions_without }
}

/// A value, or zero if it is smaller than what counts.
fn at_least(value: f64, least: f64) -> f64 {
    if value.abs() < least { 0.0 } else { value }
}

fn bodies(mechanism: &Mechanism, configuration: &Configuration) -> Vec<BodySummary> {
    let one = |(body, pose): (&crate::mechanism::Body, &Pose)| BodySummary {
        name: body.name.to_string(),
        mass: body.mass,
        moment_of_inertia: body.moment_of_inertia,
        moved_by: at_least((pose.position - body.centre_of_mass).norm(), MOVED * mechanism.size),
        turned_by: at_least(pose.angle(), MOVED),
    };
    mechanism.bodies.iter().zip(&configuration.poses).map(one).collect()
}

/// The kind of a joint that may lift off.
fn face_form(slider: &Slider) -> JointForm {
    match slider.kind {
        _ if slider.round.is_some() => JointForm::DiscOnDisc,
        _ if slider.is_disc() => JointForm::DiscOnFace,
        SliderKind::Pin if slider.length > 0.0 => JointForm::BlockOnFace,
        SliderKind::Pin => JointForm::CornerOnFace,
        SliderKind::Block | SliderKind::Guided => JointForm::BlockOnFace,
    }
}

fn joints(mechanism: &Mechanism, configuration: &Configuration) -> Vec<JointSummary> {
    let one = |(index, joint): (usize, &crate::mechanism::Joint)| {
        let circle = mechanism.friction_circle(JointId(index));
        let (kind, frames, constraints, slider) = match &joint.kind {
            JointKind::Hinge([first, second]) => (JointForm::Hinge, [first.frame, second.frame], 2, None),
            JointKind::Slider(slider) => {
                let (kind, constraints) = match slider.kind {
                    _ if mechanism.may_lift_off(slider) => (face_form(slider), slider.contacts.len()),
                    SliderKind::Block => (JointForm::BlockSlider, mechanism.places_of(slider).count()),
                    SliderKind::Guided => (JointForm::GuidedSlider, 2),
                    SliderKind::Pin => (JointForm::PinInSlot, 1),
                };
                let constraints = constraints + usize::from(slider.sticks);
                (kind, [slider.block, slider.guide], constraints, Some(slider))
            }
        };
        JointSummary {
            name: joint.name.to_string(),
            kind,
            joins: frames.map(|frame| mechanism.frame_name(frame).to_owned()),
            constraints,
            direction: slider.map(|slider| configuration.slide(mechanism, slider).tangent.into()),
            positive: slider.map(|slider| directions::of_joint(mechanism, configuration, slider)),
            displacement: slider.map(|slider| configuration.slide(mechanism, slider).displacement),
            gaps: slider.map_or_else(Vec::new, |slider| {
                configuration.gaps(mechanism, slider).map(|[gap, _]| gap).collect()
            }),
            overlap: slider.and_then(|slider| configuration.overlap(mechanism, slider)),
            stops: slider.map(|slider| slider.stops).filter(|stops| *stops != [None; 2]),
            friction_radii: circle.map(|circle| [circle.radius, circle.static_radius]),
        }
    };
    mechanism.joints.iter().enumerate().map(one).collect()
}

fn contacts(mechanism: &Mechanism, configuration: &Configuration, assembled: bool) -> Vec<ContactSummary> {
    // A contact that may lift off has one face.
    let faces = |contact: &crate::mechanism::Contact, both: [f64; 2]| {
        if contact.opens { [both[0]; 2] } else { both }
    };
    let summary = |id: ContactId, contact: &crate::mechanism::Contact| ContactSummary {
        name: contact.place().to_owned(),
        mu: faces(contact, contact.mu),
        mu_depends_on_speed: contact.depends_on_speed(),
        mu_static: faces(contact, contact.mu_static),
        // Each face of a press fit has half of it.
        preload: contact.preload.map(|preload| if contact.face.is_some() { 2.0 * preload } else { preload }),
        sliding_velocity: assembled.then(|| configuration.contact(mechanism, id).sliding_velocity),
        fit: mechanism.excess.shares(id).then_some(ContactFit {
            play: contact.play,
            misalignment: contact.misalignment,
            stiffness: contact.stiffness,
        }),
    };
    mechanism.places().map(|id| summary(id, &mechanism.contacts[id.index()])).collect()
}

fn drives(mechanism: &Mechanism) -> Vec<DriveSummary> {
    let one = |drive: &crate::mechanism::Drive| DriveSummary {
        name: drive.name.to_string(),
        coordinate: mechanism.coordinates[drive.coordinate.index()].name.to_string(),
    };
    mechanism.drives.iter().map(one).collect()
}

/// The coordinates alone, as [`check`] has them.
///
/// # Errors
/// If the mechanism is too large to be solved.
pub fn coordinates_of(
    model: &Model,
    mechanism: &Mechanism,
    configuration: &Configuration,
) -> Result<Vec<CoordinateSummary>, Faults> {
    mechanism.check_size()?;
    Ok(coordinates((model, mechanism), configuration))
}

fn coordinates(
    (model, mechanism): (&Model, &Mechanism),
    configuration: &Configuration,
) -> Vec<CoordinateSummary> {
    let one = |(coordinate, typed): (&crate::mechanism::Coordinate, &Coordinate)| CoordinateSummary {
        name: coordinate.name.to_string(),
        positive: directions::of_coordinate((model, mechanism), configuration, typed),
        kind: match coordinate.kind {
            CoordinateKind::Slide(_) => CoordinateForm::Slide,
            CoordinateKind::Rotation(..) => CoordinateForm::Rotation,
            CoordinateKind::Displacement(..) => CoordinateForm::Displacement,
        },
        unit: unit(&coordinate.kind),
        value: coordinate.value,
        rate: coordinate.rate,
    };
    mechanism.coordinates.iter().zip(&model.coordinates).map(one).collect()
}
