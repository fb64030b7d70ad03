//! Looks of a body and a sliding joint: an outline where the model gives one, else those that follow from how
//! the joints lie.
//!
//! A model says which faces rub, not what its parts look like. These looks follow from it alone:
//!
//! - a guide without height whose block lies on one side of it is a face on which the block rests;
//! - a body that slides along one face and has a slot at less than half a right angle to it is a wedge, and
//!   the slot its flank;
//! - a massless body that runs over contacts of ground without friction, and only carries what slides on it, is a
//!   belt on rollers;
//! - two pins of a body in one slot are the shoes of a carriage;
//! - what may lift off has one face.
//!
//! A face is drawn as one only where the contact does not pull at it, and has no play that counts.

use super::ContactStates;
use nalgebra::Vector2;
use slideway::ids::{BodyId, Frame, JointId};
use slideway::mechanism::{Contact, JointKind, Mechanism, Slider, rot90};
use slideway::model::{CarriedBy, SliderKind};

/// Places nearer to a line than this part of the size of the mechanism lie on it, as rounding goes.
const ON_LINE: f64 = 1e-9;
/// Sine of the greatest angle at which a slot is a flank.
const STEEPEST_FLANK: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The appearance of a sliding joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Look {
    /// Two walls, or a rod in a sleeve.
    Walls,
    /// A face on which the block rests: 1 if the block is in the direction of positive normal forces, else
    /// -1.
    Face(f64),
    /// The flank of a wedge, likewise.
    Flank(f64),
    /// Rollers of ground over which a belt runs.
    Rollers,
    /// A shoe on a rail; the rail is drawn with the first of its shoes.
    Shoe {
        /// Whether it is the first.
        is_first: bool,
    },
}

impl Look {
    /// Whether block and guide have play between them.
    pub(super) fn has_play(self) -> bool {
        matches!(self, Self::Walls | Self::Shoe { .. })
    }
}

/// The corners of a body as it is drawn (m, in the drawing of the model): of its outline, its rectangle, or
/// the wedge that it is. None for discs, bars and bodies without shape.
pub(super) fn corners(mechanism: &Mechanism, id: BodyId) -> Option<Vec<Vector2<f64>>> {
    let is_shaped = mechanism.bodies[id.index()].shape.is_some();
    mechanism.corners(id).or_else(|| if is_shaped { None } else { wedge(mechanism, id) })
}

/// The look of every joint; a contact that pulls at what would be a face has walls on both sides.
pub(super) fn looks(mechanism: &Mechanism, states: &ContactStates) -> Vec<Look> {
    let mut looks = vec![Look::Walls; mechanism.joints.len()];
    for (id, slider) in mechanism.sliders() {
        let look = of_geometry(mechanism, slider);
        let pulls =
            |side: f64| slider.contacts.iter().any(|contact| side * states.side(contact.index()) < 0.0);
        let may_lift_off = mechanism.may_lift_off(slider);
        looks[id.index()] = match look {
            look if may_lift_off => look,
            Look::Face(side) | Look::Flank(side) if pulls(side) || states.has_deflections(slider) => {
                Look::Walls
            }
            look => look,
        };
    }
    for (id, slider) in mechanism.sliders() {
        let before = mechanism.sliders().take_while(|(other, _)| *other != id);
        let is_first = !before.into_iter().any(|(_, other)| on_one_rail(mechanism, slider, other));
        let mut others = mechanism.sliders().filter(|(other, _)| *other != id);
        if others.any(|(_, other)| on_one_rail(mechanism, slider, other)) {
            looks[id.index()] = Look::Shoe { is_first };
        }
    }
    looks
}

fn of_geometry(mechanism: &Mechanism, slider: &Slider) -> Look {
    if mechanism.may_lift_off(slider) {
        return Look::Face(1.0);
    }
    if slider.kind == SliderKind::Pin {
        let flank = slider.guide.body().and_then(|guide| flank_of(mechanism, guide));
        return match flank {
            Some((flank, side)) if std::ptr::eq(flank, slider) => Look::Flank(side),
            _ => Look::Walls,
        };
    }
    if slider.block.body().is_some_and(|body| is_belt(mechanism, body)) && slider.guide == Frame::Ground {
        return Look::Rollers;
    }
    face_side(mechanism, slider).map_or(Look::Walls, Look::Face)
}

/// Whether a body is a belt: nothing but what runs over two contacts that stay where they are, without friction, and
/// carries what slides on it. Then no place on it differs from another, and only the part between its rollers is
/// drawn.
pub(super) fn is_belt(mechanism: &Mechanism, body: BodyId) -> bool {
    let frame = Frame::Body(body);
    let properties = &mechanism.bodies[body.index()];
    let is_roller = |contact: &Contact| contact.carried_by == CarriedBy::Guide && contact.is_frictionless();
    let runs = |slider: &Slider| {
        let mut contacts = slider.contacts.iter().map(|id| &mechanism.contacts[id.index()]);
        slider.kind == SliderKind::Block
            && slider.guide == Frame::Ground
            && !slider.around
            && contacts.all(is_roller)
    };
    let fits = |kind: &JointKind| match kind {
        JointKind::Hinge(ends) => ends.iter().all(|end| end.frame != frame),
        JointKind::Slider(slider) => slider.block != frame || runs(slider),
    };
    properties.mass == 0.0
        && properties.shape.is_none()
        && properties.outline.is_empty()
        && mechanism.sliders().any(|(_, slider)| slider.block == frame)
        && mechanism.joints.iter().all(|joint| fits(&joint.kind))
}

/// On which side of its guide a block lies, if the guide has no height and the block lies on one side.
fn face_side(mechanism: &Mechanism, slider: &Slider) -> Option<f64> {
    let body = slider.block.body().filter(|_| slider.height == 0.0)?;
    let normal = rot90(slider.tangent);
    let Some(corners) = corners(mechanism, body) else {
        return (slider.kind == SliderKind::Guided).then(|| nut_side(mechanism, body, normal)).flatten();
    };
    let across = corners.iter().map(|corner| (corner - slider.at).dot(&normal));
    let least = across.clone().fold(f64::INFINITY, f64::min);
    let greatest = across.fold(f64::NEG_INFINITY, f64::max);
    let none = ON_LINE * mechanism.size;
    match (least >= -none, greatest <= none) {
        (true, false) => Some(1.0),
        (false, true) => Some(-1.0),
        _ => None,
    }
}

/// The upper side of a guide for a body that is nothing but its block and lies flat, such as the nut of a screw.
fn nut_side(mechanism: &Mechanism, body: BodyId, normal: Vector2<f64>) -> Option<f64> {
    let frame = Frame::Body(body);
    let is_bare = mechanism.bodies[body.index()].shape.is_none() && normal.y.abs() > ON_LINE;
    let is_joined = |kind: &JointKind| match kind {
        JointKind::Hinge(ends) => ends.iter().any(|end| end.frame == frame),
        JointKind::Slider(slider) => slider.block == frame || slider.guide == frame,
    };
    let joints = mechanism.joints.iter().filter(|joint| is_joined(&joint.kind)).count();
    (is_bare && joints == 1).then_some(normal.y.signum())
}

/// The face along which a body slides and the slot that is its flank, if it is a wedge, with the side of the
/// flank on which the other body lies: 1 in the direction of positive normal forces on it.
fn flank_of(mechanism: &Mechanism, body: BodyId) -> Option<(&Slider, f64)> {
    let (base, flank) = base_and_flank(mechanism, body)?;
    let inwards = base.at - flank.at;
    let side = -inwards.dot(&rot90(flank.tangent)).signum();
    Some((flank, side))
}

fn base_and_flank(mechanism: &Mechanism, body: BodyId) -> Option<(&Slider, &Slider)> {
    let frame = Frame::Body(body);
    if !mechanism.bodies[body.index()].outline.is_empty() || mechanism.bodies[body.index()].shape.is_some() {
        return None;
    }
    let all = || mechanism.sliders().map(|(_, slider)| slider);
    let mut bases = all().filter(|slider| slider.block == frame);
    let mut flanks = all().filter(|slider| slider.guide == frame);
    let (Some(base), None, Some(flank), None) = (bases.next(), bases.next(), flanks.next(), flanks.next())
    else {
        return None;
    };
    let sine = base.tangent.perp(&flank.tangent).abs();
    let distance = (flank.at - base.at).dot(&rot90(base.tangent)).abs();
    let is_wedge = flank.kind == SliderKind::Pin
        && base.kind != SliderKind::Pin
        && base.height == 0.0
        && (ON_LINE..=STEEPEST_FLANK).contains(&sine)
        && distance > ON_LINE * mechanism.size;
    is_wedge.then_some((base, flank))
}

/// The corners of a wedge: its face is as long as the block that slides on it.
fn wedge(mechanism: &Mechanism, body: BodyId) -> Option<Vec<Vector2<f64>>> {
    let (base, flank) = base_and_flank(mechanism, body)?;
    let (along, across) = (base.tangent, rot90(base.tangent));
    let to_flank = flank.at - base.at;
    let across = across * to_flank.dot(&across).signum();
    let slope = flank.tangent.dot(&across) / flank.tangent.dot(&along);
    let height = |place: f64| to_flank.dot(&across) + slope * (place - to_flank.dot(&along));
    let half = 0.5 * base.length;
    // Where the flank meets the face within its length, the wedge ends in an edge.
    let tip = -height(0.0) / slope;
    let ends = [-half, half].map(|end: f64| if height(end) < 0.0 { tip } else { end });
    let corner = |place: f64, height: f64| base.at + along * place + across * height;
    let mut corners = ends.map(|end| corner(end, 0.0)).to_vec();
    corners.extend([ends[1], ends[0]].map(|end| corner(end, height(end).max(0.0))));
    Some(corners)
}

/// Whether two pins of a body slide in one straight slot.
fn on_one_rail(mechanism: &Mechanism, one: &Slider, other: &Slider) -> bool {
    one.kind == SliderKind::Pin
        && other.kind == SliderKind::Pin
        && (one.block, one.guide) == (other.block, other.guide)
        && one.tangent.perp(&other.tangent).abs() <= ON_LINE
        && (one.at - other.at).perp(&one.tangent).abs() <= ON_LINE * mechanism.size
}

/// All shoes on the rail of a joint, itself included.
pub(super) fn on_rail_of(mechanism: &Mechanism, joint: JointId) -> Vec<JointId> {
    let Some(slider) = mechanism.slider(joint) else { return Vec::new() };
    let all = mechanism.sliders().filter(|(_, other)| on_one_rail(mechanism, slider, other));
    all.map(|(id, _)| id).collect()
}
