//! What is watched within a phase: functions that end it, or are told, when they fall through zero.

use super::cause::Cause;
use super::equations::Equations;
use super::linear::Determinant;
use super::magnitudes::{Magnitude, Magnitudes};
use super::switching::{Switch, Switching};
use crate::fault::Fault;
use crate::ids::{ContactId, JointId};
use crate::kinetics::Reaction;
use crate::mechanism::BareCorner;
use crate::model::SliderKind;
use crate::modes::Side;
use crate::motion::options::{Crossing, UserEvent};
use crate::pattern::phase::{ContactPhase, JointPhase, Phase};

/// Forces below this multiple of the greatest so far are rounding.
const FORCE_TOLERANCE: f64 = 1e-9;
/// Velocities, likewise.
const VELOCITY_TOLERANCE: f64 = 1e-10;
/// Margins of sticking closer to zero than this are rounding: linear programs miss their optimum by it.
const MARGIN_TOLERANCE: f64 = 1e-10;
/// Lengths below this multiple of the size are rounding.
const LENGTH_TOLERANCE: f64 = 1e-12;
/// A mode whose determinant has fallen to this part of what it was at the start of the phase counts as
/// locked.
const LOCKED: f64 = 1e-9;
/// A block leaves its guide when so little of its length is supported: normal forces grow like the inverse of
/// the overlap, and the equations can still be solved there.
const LEAVES: f64 = 1e-6;

/// A function that is watched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::motion) enum Watched {
    /// The normal force of a contact, towards its side.
    NormalForce(ContactId),
    /// The share of a face in a preload gap: of the positive one, or of the negative one.
    Share(ContactId, Side),
    /// Minus the normal force towards this side of a contact that is without one, in the preload gap of a
    /// guided slider.
    Between(ContactId, Side),
    /// The sliding velocity of a joint, counted in its direction; the joint's number among the sliding ones.
    Velocity(usize, f64),
    /// The angular velocity of a hinge with friction, counted in its direction; the hinge's number among these.
    Spin(usize, f64),
    /// The determinant of the mode, relative to the start of the phase, without what overlaps alone change.
    Determinant,
    /// How much the normal force of a contact may still grow.
    ReactionLimit(ContactId),
    /// How much the greatest of the normal forces that statics determines may still grow while joints stick.
    HeldReactions,
    /// N L/2 - |C| of a guided slider, with the normal force N towards the face that is pressed.
    Couple(JointId),
    /// By how much the sticking joints can still stick.
    Sticking,
    /// By how much what sticks does so, where the equations determine its forces.
    Room,
    /// The supported length of a block slider.
    Overlap(JointId),
    /// The gap of a contact that is open.
    Gap(ContactId),
    /// Distance of a corner without contact from a face, by its number among these.
    BareCorner(usize),
    /// Distance to the least (-1) or greatest (1) displacement of a sliding joint.
    Travel(JointId, f64),
    /// A function of the user, or its negative.
    User(usize, f64),
    /// How far a relation of a load or drive is from an end of its piece.
    Relation(Switch),
}

/// What it takes to compute a watched function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::motion) enum Needs {
    /// Positions and velocities.
    Motion,
    /// The solution of the equations.
    Forces,
    /// The decision on standstill.
    Standstill,
}

impl Watched {
    pub(in crate::motion) fn needs(self) -> Needs {
        match self {
            Self::NormalForce(_)
            | Self::Share(..)
            | Self::Between(..)
            | Self::Determinant
            | Self::ReactionLimit(_)
            | Self::Couple(_)
            | Self::Room => Needs::Forces,
            Self::Sticking | Self::HeldReactions => Needs::Standstill,
            Self::Velocity(..)
            | Self::Spin(..)
            | Self::Overlap(_)
            | Self::Gap(_)
            | Self::BareCorner(_)
            | Self::Travel(..)
            | Self::User(..)
            | Self::Relation(_) => Needs::Motion,
        }
    }
}

/// The functions that are watched in a phase.
pub(in crate::motion) struct Watch<'o> {
    pub(in crate::motion) list: Vec<Watched>,
    user: &'o [UserEvent],
    /// Corners that may reach a face where the model has no contact.
    bare: Vec<BareCorner>,
    reaction_limit: Option<f64>,
    /// The determinant at the start of the phase, and the product of the overlaps.
    reference: (Determinant, f64),
    /// The greatest so far.
    pub(in crate::motion) magnitudes: Magnitudes,
}

impl<'o> Watch<'o> {
    /// Nothing yet.
    pub(in crate::motion) fn new(
        user: &'o [UserEvent],
        bare: Vec<BareCorner>,
        reaction_limit: Option<f64>,
        magnitudes: Magnitudes,
    ) -> Self {
        let reference = (Determinant::default(), 1.0);
        Self { list: Vec::new(), user, bare, reaction_limit, reference, magnitudes }
    }

    /// Chooses what is watched in a phase that the equations have just entered.
    pub(in crate::motion) fn begin(
        &mut self,
        phase: &Phase,
        equations: &Equations<'_>,
        switching: &Switching<'_>,
    ) {
        self.list.clear();
        self.list.extend(switching.watched().map(Watched::Relation));
        self.reference = (equations.determinant(), overlaps(equations));
        let mechanism = equations.mechanism;
        for (index, joint) in equations.sliders.iter().enumerate() {
            let slider = mechanism.slider(*joint).expect("sliding joints slide");
            let open = slider.contacts.iter().filter(|contact| phase.is_open(mechanism, contact.index()));
            self.list.extend(open.clone().map(|contact| Watched::Gap(*contact)));
            if open.count() == slider.contacts.len() {
                continue;
            }
            if let JointPhase::Sliding(sign) = phase.joints[index] {
                if !slider.contacts.iter().all(|k| mechanism.contacts[k.index()].is_frictionless()) {
                    self.list.push(Watched::Velocity(index, sign));
                }
                for contact in slider.contacts.iter().filter(|k| !phase.is_open(mechanism, k.index())) {
                    self.contact(*contact, phase.contacts[contact.index()]);
                }
                if slider.kind == SliderKind::Guided {
                    self.guided(*joint, slider.contacts[0], phase.contacts[slider.contacts[0].index()]);
                }
            }
            if slider.kind == SliderKind::Block && !mechanism.may_lift_off(slider) {
                self.list.push(Watched::Overlap(*joint));
            }
            if phase.joints[index] != JointPhase::Sticking {
                let is_limited = |end: &f64| equations.room_to_slide(*joint, *end).is_finite();
                let limited = [-1.0, 1.0].into_iter().filter(is_limited);
                self.list.extend(limited.map(|end| Watched::Travel(*joint, end)));
            }
        }
        for (index, hinge) in phase.hinges.iter().enumerate() {
            if let JointPhase::Sliding(sign) = hinge.state {
                self.list.push(Watched::Spin(index, sign));
            }
        }
        if phase.sticks() {
            let determined = equations.room_of_sticking(phase).is_some();
            self.list.push(if determined { Watched::Room } else { Watched::Sticking });
            let undetermined = !determined || phase.joints.contains(&JointPhase::Sticking);
            if self.reaction_limit.is_some() && undetermined {
                self.list.retain(|watched| !matches!(watched, Watched::ReactionLimit(_)));
                self.list.push(Watched::HeldReactions);
            }
        }
        let slides =
            phase.contacts.iter().any(|_| phase.joints.iter().any(|joint| *joint != JointPhase::Sticking));
        if slides || phase.hinges.iter().any(|hinge| hinge.state != JointPhase::Sticking) {
            self.list.push(Watched::Determinant);
        }
        let bare = self.bare.iter().enumerate().filter(|(_, corner)| may_reach(corner, equations));
        self.list.extend(bare.map(|(index, _)| Watched::BareCorner(index)));
        for (index, event) in self.user.iter().enumerate() {
            if event.crossing != Crossing::Rising {
                self.list.push(Watched::User(index, 1.0));
            }
            if event.crossing != Crossing::Falling {
                self.list.push(Watched::User(index, -1.0));
            }
        }
    }

    fn contact(&mut self, contact: ContactId, phase: ContactPhase) {
        match phase {
            ContactPhase::Pressed(_) => self.list.push(Watched::NormalForce(contact)),
            ContactPhase::PreloadGap => {
                self.list.extend(Side::BOTH.map(|side| Watched::Share(contact, side)));
            }
        }
        if self.reaction_limit.is_some() {
            self.list.push(Watched::ReactionLimit(contact));
        }
    }

    fn guided(&mut self, joint: JointId, contact: ContactId, phase: ContactPhase) {
        match phase {
            ContactPhase::Pressed(_) => self.list.push(Watched::Couple(joint)),
            ContactPhase::PreloadGap => {
                self.list.extend(Side::BOTH.map(|side| Watched::Between(contact, side)));
            }
        }
    }

    /// Returns that a corner without contact reaches a face, unless it passes beyond the ends.
    pub(in crate::motion) fn bare_corner(&self, index: usize, equations: &Equations<'_>) -> Option<Cause> {
        let corner = &self.bare[index];
        let reaches = !is_beside_face(corner, equations);
        let (joint, wanted) = (corner.joint, corner.wanted());
        reaches.then(|| Cause::BareCorner { corner: corner.name.clone(), joint, wanted })
    }

    /// The greatest normal force that is permitted (N).
    pub(in crate::motion) fn reaction_limit(&self) -> f64 {
        self.reaction_limit.unwrap_or(f64::INFINITY)
    }

    /// The value of a watched function at the last evaluation of the equations; not that of what needs a
    /// decision, nor of relations.
    ///
    /// # Errors
    /// A function of the user has no value.
    pub(in crate::motion) fn value(
        &self,
        watched: Watched,
        phase: &Phase,
        equations: &Equations<'_>,
    ) -> Result<f64, Fault> {
        let (mechanism, configuration) = (equations.mechanism, &equations.configuration);
        let slider = |joint: JointId| mechanism.slider(joint).expect("sliding joints slide");
        Ok(match watched {
            Watched::NormalForce(contact) => pressing_force(contact, phase, equations),
            Watched::Share(contact, side) => {
                let share = equations.share(contact.index()).unwrap_or(0.5);
                if side == Side::Positive { share } else { 1.0 - share }
            }
            Watched::Between(contact, side) => -side.sign() * equations.normal_force(contact.index()),
            Watched::Velocity(index, sign) => sign * equations.sliding_velocity(index),
            Watched::Spin(hinge, sign) => sign * equations.spin(hinge),
            Watched::Determinant => {
                // Normal forces of both ends of a block become parallel as its overlap vanishes: the
                // determinant falls with the square, as a row and a column of each pair do.
                let (determinant, before) = self.reference;
                let overlaps = before / overlaps(equations);
                equations.determinant().relative_to(determinant) * overlaps * overlaps - LOCKED
            }
            Watched::ReactionLimit(contact) => {
                self.reaction_limit() - equations.normal_force(contact.index()).abs()
            }
            Watched::Couple(joint) => {
                // A face does not pull: beyond the zero of its force there is no room either.
                let slider = slider(joint);
                let force = pressing_force(slider.contacts[0], phase, equations);
                force * slider.greatest_couple(1.0) - equations.reaction(Reaction::Couple(joint)).abs()
            }
            Watched::Room => equations.room_of_sticking(phase).unwrap_or(0.0),
            Watched::Sticking | Watched::HeldReactions | Watched::Relation(_) => 0.0,
            Watched::Overlap(joint) => {
                let slider = slider(joint);
                configuration.overlap(mechanism, slider).unwrap_or(0.0) - LEAVES * slider.length
            }
            Watched::Gap(contact) => configuration.gap(mechanism, contact)[0],
            Watched::BareCorner(index) => gap_of(&self.bare[index], equations),
            Watched::Travel(joint, end) => equations.room_to_slide(joint, end),
            Watched::User(index, sign) => sign * self.user[index].value(mechanism, configuration)?,
        })
    }

    /// Forces below this are rounding, on each body (N).
    pub(in crate::motion) fn rounding(&self) -> Vec<f64> {
        let bodies = 0..self.magnitudes.parts().len();
        bodies.map(|body| FORCE_TOLERANCE * self.magnitudes.of_body(body).force).collect()
    }

    /// Values within this of zero count as zero.
    pub(in crate::motion) fn tolerance(&self, watched: Watched, equations: &Equations<'_>) -> f64 {
        let mechanism = equations.mechanism;
        let Magnitude { force, velocity, .. } = self.magnitudes_of(watched, equations);
        let (force, velocity) = (FORCE_TOLERANCE * force, VELOCITY_TOLERANCE * velocity);
        match watched {
            Watched::NormalForce(_)
            | Watched::Between(..)
            | Watched::ReactionLimit(_)
            | Watched::HeldReactions => force,
            Watched::Couple(joint) => force * mechanism.slider(joint).map_or(0.0, |slider| slider.length),
            Watched::Room => force * mechanism.size,
            Watched::Share(..) => FORCE_TOLERANCE,
            Watched::Velocity(..) => velocity,
            Watched::Spin(..) => velocity / mechanism.size,
            Watched::Overlap(_) | Watched::Gap(_) | Watched::Travel(..) => LENGTH_TOLERANCE * mechanism.size,
            Watched::BareCorner(_) => mechanism.same_place(),
            Watched::Sticking => MARGIN_TOLERANCE,
            Watched::Determinant | Watched::User(..) | Watched::Relation(_) => 0.0,
        }
    }

    /// The magnitudes of the part to which a watched function belongs; the greatest of all where it belongs to several.
    fn magnitudes_of(&self, watched: Watched, equations: &Equations<'_>) -> Magnitude {
        let mechanism = equations.mechanism;
        let joint = match watched {
            Watched::NormalForce(contact)
            | Watched::Between(contact, _)
            | Watched::ReactionLimit(contact) => mechanism.contacts[contact.index()].joint,
            Watched::Couple(joint) => joint,
            Watched::Velocity(index, _) => equations.sliders[index],
            Watched::Spin(hinge, _) => mechanism.friction_circles[hinge].joint,
            _ => return self.magnitudes.greatest(),
        };
        self.magnitudes.of_joint(mechanism, joint)
    }
}

fn gap_of(corner: &BareCorner, equations: &Equations<'_>) -> f64 {
    equations.configuration.gap_at(equations.mechanism, &corner.slider, &corner.contact)[0]
}

fn is_beside_face(corner: &BareCorner, equations: &Equations<'_>) -> bool {
    equations.configuration.is_beside_face(equations.mechanism, &corner.slider, &corner.contact)
}

/// Returns whether a corner is on the free side of a face, and not beyond its ends where it passes its line.
fn may_reach(corner: &BareCorner, equations: &Equations<'_>) -> bool {
    let (gap, near) = (gap_of(corner, equations), equations.mechanism.same_place());
    gap > near || gap >= -near && !is_beside_face(corner, equations)
}

/// The normal force of a contact towards the side that is pressed (N).
fn pressing_force(contact: ContactId, phase: &Phase, equations: &Equations<'_>) -> f64 {
    let k = contact.index();
    let sigma = if phase.contacts[k] == ContactPhase::Pressed(Side::Negative) { -1.0 } else { 1.0 };
    sigma * equations.normal_force(k)
}

/// The product of the overlaps of all block sliders, relative to their lengths.
fn overlaps(equations: &Equations<'_>) -> f64 {
    let mechanism = equations.mechanism;
    let sliders = equations.sliders.iter().filter_map(|joint| mechanism.slider(*joint));
    let blocks = sliders.filter(|slider| slider.kind == SliderKind::Block && !mechanism.may_lift_off(slider));
    blocks
        .map(|slider| {
            let overlap = equations.configuration.overlap(mechanism, slider).unwrap_or(0.0) / slider.length;
            overlap.abs().max(LEAVES)
        })
        .product()
}
