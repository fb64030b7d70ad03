//! Warnings: what in a model makes sense, but is perhaps not what was meant.
//!
//! Stands beside [`mod@crate::check`]. A model with warnings is solved like any other; `--strict` of the
//! command line takes them for errors. What counts as too far apart is a matter of experience: the constants
//! below are heuristics (tolerances in the book).
//!
//! ```
//! use slideway::{Model, gallery, warning::warnings};
//!
//! let text = gallery::find("drawer").expect("in the gallery").text.replace("\"0 deg\"", "90");
//! let found = warnings(&Model::parse(&text)?);
//! let messages: Vec<String> = found.sorted().iter().map(|warning| warning.kind.to_string()).collect();
//! assert_eq!(messages[0], "the direction of guide is 90 rad, more than a full turn: a number without a unit is in radians");
//! # Ok::<(), slideway::Faults>(())
//! ```

mod lengths;

use crate::configuration::{Configuration, widest_gap_of_drawing};
use crate::expression::Symbol;
use crate::fault::{Doubt, Fault, FaultKind, Faults, Place, Source};
use crate::ids::{BodyId, FormulaId, Frame, JointId};
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::{BareCorner, Contact, Coordinate, CoordinateKind, FrictionCircle, Mechanism};
use crate::model::{Along, Effort, ForceValue, Gravity, JointKind, LoadKind, Model};
use crate::report::number::number;
use serde::Serialize;
use std::cell::LazyCell;
use std::f64::consts::TAU;

/// Bare angles beyond this (rad) are taken for degrees.
const FULL_TURN: f64 = TAU;
/// Gaps of the drawing beyond this part of the mechanism's size are no rounding of what was typed.
const OPEN: f64 = 1e-3;
/// A body this many sizes of the mechanism from its place in the drawing is far from it.
const FAR: f64 = 3.0;
/// Hinges this part of the mechanism's size from each other are drawn at one place.
const SAME_PLACE: f64 = 1e-9;
/// Coefficients of friction above this are rare.
const GREAT_FRICTION: f64 = 2.0;
/// A gravity above this is found on no planet (m/s^2).
const GREAT_GRAVITY: f64 = 100.0;

/// A warning as a report tells it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct WarningReport {
    /// Its kind: "bare_angle", "bare_number", "lengths_far_apart", "length_towers", "gap_closed", "far_from_drawing",
    /// "great_friction", "great_gravity", "wide_friction_circle", "bare_corner", "behind_face", "no_loads" or "nothing_presses".
    pub kind: &'static str,
    /// Where it lies; null where it concerns the input as a whole.
    pub place: Option<WarningPlace>,
    /// Message: what is perhaps not meant.
    pub message: String,
    /// Hint on what to do about it.
    pub hint: String,
}

/// Where a warning lies.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct WarningPlace {
    /// "model" for the model file, "setting" for a setting such as `--set`.
    pub source: &'static str,
    /// Its first byte in that text.
    pub from: usize,
    /// The byte behind it.
    pub to: usize,
}

impl WarningReport {
    /// The warnings among these faults, as reports tell them.
    pub(crate) fn list(faults: &Faults) -> Vec<Self> {
        let one = |fault: &&Fault| {
            let FaultKind::Doubt(doubt) = &fault.kind else { return None };
            let place = fault.place.as_ref().map(|place| WarningPlace {
                source: if place.source == Source::Model { "model" } else { "setting" },
                from: place.span.start,
                to: place.span.end,
            });
            let (message, hint) = (doubt.to_string(), doubt.hint());
            Some(Self { kind: doubt.name(), place, message, hint })
        };
        faults.sorted().iter().filter_map(one).collect()
    }
}

/// The mechanism in its state, where it can be assembled.
type State<'a> = LazyCell<Option<Configuration>, Box<dyn FnOnce() -> Option<Configuration> + 'a>>;

/// Everything in a model that is perhaps not meant, each with its place: none of it keeps it from being
/// solved. Settings that have been applied to the model count.
pub fn warnings(model: &Model) -> Faults {
    let mut found = Faults::default();
    found.extend(model.doubts.iter().cloned());
    // A setting that is in doubt already is not told twice.
    let is_told = |angle: &FormulaId| {
        model.doubts.iter().any(|doubt| doubt.place == Some(model.formula(*angle).origin.place()))
    };
    let angles = angles(model).into_iter().filter(|angle| !is_told(angle));
    found.extend(angles.filter_map(|angle| bare_angle(model, angle)));
    found.extend(lengths::doubtful_lengths(model));
    if let Ok(mechanism) = Mechanism::new(model) {
        found.extend(great_friction(model));
        found.extend(wide_friction_circles(model, &mechanism));
        found.extend(great_gravity(model, &mechanism));
        found.extend(no_loads(&mechanism));
        found.extend(behind_faces(&mechanism));
        found.extend(gap_closed(model, &mechanism));
        found.extend(bare_corners(&mechanism));
        // Assembled once, and only if one of them asks.
        let state: State<'_> = LazyCell::new(Box::new(|| Configuration::new(&mechanism).ok()));
        found.extend(far_from_drawing(model, &mechanism, &state));
        found.extend(nothing_presses(&mechanism, &state));
    }
    found
}

/// A warning for each parameter that is known within bounds: only [`mod@crate::solve`] tells what holds for all of
/// them, other questions take their middle.
pub fn ranges_at_middle(model: &Model) -> Faults {
    let mut found = Faults::default();
    for range in model.ranges().unwrap_or_default() {
        let Some(parameter) = model.parameters.iter().find(|parameter| *parameter.name == *range.name) else {
            continue;
        };
        let [from, to, middle] = [range.from, range.to, range.middle].map(|value| range.shown_in.show(value));
        let place = model.formula(parameter.value).origin.place();
        found.push(warning(Doubt::RangeAtMiddle { name: range.name, from, to, middle }, place));
    }
    found
}

fn great_gravity(model: &Model, mechanism: &Mechanism) -> Option<Fault> {
    let gravity = mechanism.free_fall();
    if gravity <= GREAT_GRAVITY {
        return None;
    }
    let formula = match model.gravity {
        Gravity::None => return None,
        Gravity::Down(id) | Gravity::Components(_, Some(id)) | Gravity::Components([_, id], None) => id,
    };
    let doubt = Doubt::GreatGravity { value: mechanism.units.of("m/s^2").show(gravity) };
    let place = model.setting_of(&[formula]).unwrap_or_else(|| model.formula(formula).origin.place());
    Some(warning(doubt, place))
}

/// Friction of what nothing presses but its own motion.
fn no_loads(mechanism: &Mechanism) -> Option<Fault> {
    let loads = mechanism.loads.len() + mechanism.drives.len();
    let presses = |contact: &Contact| rubs(contact) || is_displaced(contact);
    let is_idle = loads == 0
        && mechanism.free_fall() == 0.0
        && mechanism.contacts.iter().any(is_rough)
        && !mechanism.contacts.iter().any(presses);
    is_idle.then(|| Fault::general(FaultKind::Doubt(Doubt::NoLoads)))
}

/// Bodies behind a face that they touch.
fn behind_faces(mechanism: &Mechanism) -> Vec<Fault> {
    let one = |(joint, body, partly): (JointId, BodyId, bool)| {
        let joint = &mechanism.joints[joint.index()];
        let body = mechanism.bodies[body.index()].name.to_string();
        warning(Doubt::BehindFace { body, joint: joint.name.to_string(), partly }, joint.place.clone())
    };
    mechanism.behind_faces().into_iter().map(one).collect()
}

fn is_rough(contact: &Contact) -> bool {
    contact.mu != [0.0; 2]
}

fn rubs(contact: &Contact) -> bool {
    contact.preload != [0.0; 2]
}

fn is_displaced(contact: &Contact) -> bool {
    contact.misalignment != 0.0 || contact.misalignment_law.is_some() || contact.face.is_some()
}

/// A driven mechanism without any contact force: whatever the friction, it seems to move. The forces are exactly
/// zero, as nothing on the right-hand side of the equations is not. Redundant guides that are out of line press by
/// themselves.
fn nothing_presses(mechanism: &Mechanism, state: &State<'_>) -> Option<Fault> {
    let contacts = &mechanism.contacts;
    if mechanism.drives.is_empty() || !contacts.iter().any(is_rough) || contacts.iter().any(rubs) {
        return None;
    }
    if !mechanism.excess.is_empty() && contacts.iter().any(is_displaced) {
        return None;
    }
    mechanism.check_size().ok()?;
    let equations = KineticEquations::new(mechanism, state.as_ref()?).ok()?;
    let presses = Influence::new(&equations).normal_forces().iter().any(|force| *force != 0.0);
    (!presses).then(|| Fault::general(FaultKind::Doubt(Doubt::NothingPresses)))
}

fn warning(doubt: Doubt, place: Place) -> Fault {
    Fault::new(FaultKind::Doubt(doubt), place)
}

/// The formulas that are angles, parameters under a sine, cosine or tangent among them.
fn angles(model: &Model) -> Vec<FormulaId> {
    let of_along = |along: &Along| if let Along::Angle(angle) = along { Some(*angle) } else { None };
    let joints = model.joints.iter().filter_map(|joint| match &joint.kind {
        JointKind::Slider(slider) => of_along(&slider.along),
        JointKind::Hinge(_) => None,
    });
    let loads = model.loads.iter().filter_map(|load| match &load.kind {
        LoadKind::Force { force: ForceValue::Along(_, along), .. } => of_along(along),
        LoadKind::TorsionalSpring { free_angle, .. } => *free_angle,
        _ => None,
    });
    let drives = model.drives.iter().filter_map(|drive| match &drive.effort {
        Effort::Force { direction, .. } => of_along(direction),
        Effort::Torque { .. } => None,
    });
    let coordinates = model.coordinates.iter().filter(|coordinate| coordinate.kind.is_angle());
    let values = coordinates.flat_map(|coordinate| [coordinate.drawn_at, coordinate.value]);
    let under = model.formulas.iter().flat_map(|formula| formula.expression.angles());
    let parameters = under.filter_map(|symbol| match symbol {
        Symbol::Parameter(parameter) => Some(model.parameters[parameter].value),
        _ => None,
    });
    let mut all: Vec<FormulaId> = joints
        .chain(loads)
        .chain(drives)
        .chain(values.flatten())
        .chain(parameters)
        .map(|id| model.source_of(id))
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// A bare number as an angle, or as the parameter that it is, beyond a full turn or in a model whose angles are in degrees.
fn bare_angle(model: &Model, angle: FormulaId) -> Option<Fault> {
    let formula = model.formula(angle);
    let value = formula.expression.bare_number().filter(|value| *value != 0.0)?;
    let what = formula.what.to_string();
    let doubt = if value.abs() > FULL_TURN {
        Doubt::BareAngle { what, value }
    } else {
        let unit = model.units.typed("rad").filter(|unit| unit.scale() != 1.0)?;
        Doubt::BareNumber { what, value, si: unit.si().to_owned(), unit: unit.name().to_owned() }
    };
    Some(warning(doubt, formula.origin.place()))
}

fn great_friction(model: &Model) -> Vec<Fault> {
    let Ok(values) = model.constants() else { return Vec::new() };
    let great = model.friction_coefficients().filter(|id| values[id.index()] > GREAT_FRICTION);
    let one = |id: FormulaId| {
        let formula = model.formula(model.source_of(id));
        let what = formula.what.to_string();
        let place = model.setting_of(&[id]).unwrap_or_else(|| formula.origin.place());
        warning(Doubt::GreatFriction { what, value: number(values[id.index()]) }, place)
    };
    great.map(one).collect()
}

/// Friction circles that hold the centre of another hinge of one of their bodies. Hinges of several bodies at one place
/// are meant.
fn wide_friction_circles(model: &Model, mechanism: &Mechanism) -> Vec<Fault> {
    let unit = mechanism.units.of("m");
    let one = |circle: &FrictionCircle| {
        let radius = circle.radius.max(circle.static_radius);
        let (body, other, distance) = nearest_hinge(mechanism, circle.joint)?;
        let joint = &mechanism.joints[circle.joint.index()];
        let doubt = Doubt::WideFrictionCircle {
            hinge: joint.name.to_string(),
            radius: unit.show(radius),
            body: mechanism.frame_name(body).to_owned(),
            other: mechanism.joints[other.index()].name.to_string(),
            distance: unit.show(distance),
        };
        let formulas: Vec<FormulaId> = match &model.joints[circle.joint.index()].kind {
            JointKind::Hinge(hinge) => {
                hinge.friction.iter().flat_map(|friction| friction.formulas()).collect()
            }
            JointKind::Slider(_) => Vec::new(),
        };
        let place = model.setting_of(&formulas).unwrap_or_else(|| joint.place.clone());
        (radius > distance).then(|| warning(doubt, place))
    };
    mechanism.friction_circles.iter().filter(|circle| !circle.is_collar()).filter_map(one).collect()
}

/// Of the other hinges of the bodies that a hinge joins, ground left out, the nearest at another place: its body, itself
/// and the distance (m).
fn nearest_hinge(mechanism: &Mechanism, joint: JointId) -> Option<(Frame, JointId, f64)> {
    let others = (0..mechanism.joints.len()).map(JointId).filter(|other| *other != joint);
    let ends = mechanism.hinge(joint)?.iter().filter(|end| end.frame.body().is_some());
    let distances = ends.flat_map(|end| {
        others.clone().filter_map(|other| {
            let there = mechanism.hinge(other)?.iter().find(|there| there.frame == end.frame)?;
            Some((end.frame, other, (there.position - end.position).norm()))
        })
    });
    let apart = distances.filter(|(.., distance)| *distance > SAME_PLACE * mechanism.size);
    apart.min_by(|one, other| one.2.total_cmp(&other.2))
}

/// Corners that are drawn on a face on which their body stands, without a contact there.
fn bare_corners(mechanism: &Mechanism) -> Vec<Fault> {
    let on_face = mechanism.bare_corners().into_iter().filter(|corner| corner.is_on_face(mechanism));
    let one = |corner: BareCorner| {
        let wanted = corner.wanted();
        let joint = &mechanism.joints[corner.joint.index()];
        let doubt = Doubt::BareCorner { corner: corner.name, joint: joint.name.to_string(), wanted };
        warning(doubt, joint.place.clone())
    };
    on_face.map(one).collect()
}

/// The joint that the drawing leaves most open, if that is no rounding.
fn gap_closed(model: &Model, mechanism: &Mechanism) -> Option<Fault> {
    let gap = widest_gap_of_drawing(mechanism)?;
    if gap.relative <= OPEN {
        return None;
    }
    let joint = &mechanism.joints[gap.joint.index()];
    let doubt = Doubt::GapClosed { joint: joint.name.to_string(), gap: gap.in_words(mechanism) };
    let points: Vec<FormulaId> = match &model.joints[gap.joint.index()].kind {
        JointKind::Hinge(hinge) => hinge.between.iter().flat_map(|point| point.position).collect(),
        JointKind::Slider(_) => Vec::new(),
    };
    Some(warning(doubt, model.setting_of(&points).unwrap_or_else(|| joint.place.clone())))
}

/// The body that is farthest from its place in the drawing, if that is far; the place is that of the coordinate
/// which has moved it. Within a travel that the model declares no place is too far.
fn far_from_drawing(model: &Model, mechanism: &Mechanism, state: &State<'_>) -> Option<Fault> {
    let moved = mechanism.coordinates.iter().enumerate().filter(|(_, coordinate)| {
        let declared = match coordinate.kind {
            CoordinateKind::Slide(joint) => {
                mechanism.slider(joint).is_some_and(|slider| slider.travel.is_some())
            }
            _ => false,
        };
        coordinate.value != coordinate.drawn_at && !declared
    });
    let way = |coordinate: &Coordinate| (coordinate.value - coordinate.drawn_at).abs();
    let (farthest, _) = moved.max_by(|(_, one), (_, other)| way(one).total_cmp(&way(other)))?;
    let state = state.as_ref()?;
    let distance =
        |index: usize| (state.poses[index].position - mechanism.bodies[index].centre_of_mass).norm();
    let index = (0..mechanism.bodies.len()).max_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
    let sizes = distance(index) / mechanism.size;
    let body = mechanism.bodies[index].name.to_string();
    let distance = mechanism.units.of("m").show(distance(index));
    let doubt = Doubt::FarFromDrawing { body, distance, sizes: number(sizes) };
    let value = model.coordinates[farthest].value;
    let place = value.map(|id| model.setting_of(&[id]).unwrap_or_else(|| model.formula(id).origin.place()));
    let fault = |place: Option<Place>| match place {
        Some(place) => warning(doubt, place),
        None => Fault::general(FaultKind::Doubt(doubt)),
    };
    (sizes > FAR).then(|| fault(place))
}
