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
mod report;
mod text;

pub use report::{
    BodySummary, CheckReport, ContactFit, ContactSummary, CoordinateForm, CoordinateSummary, DriveSummary,
    Finding, InertiaSummary, JointForm, JointSummary, MobilitySummary, Question, SCHEMA,
};

use crate::configuration::{
    Configuration, Mobility, Pose, every_motion_has_inertia, free_motions, motions_without_inertia, unit,
};
use crate::fault::Faults;
use crate::ids::{ContactId, JointId};
use crate::influence::Influence;
use crate::kinetics::{Assembled, KineticEquations};
use crate::mechanism::{CoordinateKind, FrictionCircle, JointKind, Mechanism, Slider};
use crate::model::{Coordinate, Model, SliderKind};
use crate::progress::{Callback, Work, undisturbed, watched};
use crate::report::finite;
use crate::solve::{Sliding, check_hinges, check_standing, load_sharing, mode_problem};
use crate::warning::{WarningReport, warnings};
use nalgebra::DVector;

/// Bodies that have moved from the drawing by less than this part of the mechanism's size, or are turned by
/// less (rad), have not: that is the rounding of its closed joints.
const MOVED: f64 = 1e-9;

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

impl CheckReport {
    /// True if some question can be answered in this state.
    pub fn is_ready(&self) -> bool {
        self.questions.iter().any(|question| question.ready)
    }
}

fn mobility_summary(mechanism: &Mechanism, mobility: &Mobility) -> MobilitySummary {
    // In space what is too much for the plane may carry out of it.
    let in_space = mechanism.space.is_some();
    let redundancy =
        mobility.redundancy.as_ref().filter(|_| !in_space || !mechanism.excess.contacts.is_empty());
    let is_redundant =
        if in_space { !mechanism.excess.contacts.is_empty() } else { mechanism.is_redundant() };
    let determinate = redundancy.is_none() && !is_redundant;
    let name = |joint: &crate::ids::JointId| mechanism.joints[joint.index()].name.to_string();
    MobilitySummary {
        body_coordinates: mobility.body_coordinates,
        constraints: mobility.constraints,
        independent: mobility.independent,
        degrees_of_freedom: mobility.degrees_of_freedom(),
        determinate,
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
        let circle = mechanism.friction_circle(JointId(index)).filter(|circle| circle.end.is_none());
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
            collar_radii: mechanism.collar_of(JointId(index)).map(FrictionCircle::radii_by_force),
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
        mu: mechanism.end_of(id.index()).map_or(faces(contact, contact.mu), |end| [end.radius; 2]),
        mu_depends_on_speed: contact.depends_on_speed(),
        mu_static: mechanism
            .end_of(id.index())
            .map_or(faces(contact, contact.mu_static), |end| [end.static_radius; 2]),
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
