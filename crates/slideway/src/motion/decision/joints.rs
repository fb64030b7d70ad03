//! The sliding joints of a mechanism at an instant, and its hinges with friction.

use super::scale::{Scale, Share};
use super::units::{Units, greatest, units};
use crate::configuration::Configuration;
use crate::ids::{BodyId, ContactId, JointId};
use crate::influence::Influence;
use crate::kinetics::{KineticEquations, Reaction, SlidingRow};
use crate::mechanism::{Attachment, FrictionCircle, JointKind, Mechanism, Slider};
use crate::model::Stop;
use crate::motion::moving::connected::connected;
use crate::pattern::GuidedCouple;
use nalgebra::DVector;

/// A joint nearer to its end stop than this, in sizes of the mechanism, touches it; positions have rounding
/// errors.
pub(super) const TOUCHES: f64 = 1e-11;
/// A sliding joint at an instant.
#[derive(Debug, Clone)]
pub(super) struct SlidingJoint {
    /// Which joint it is.
    pub(super) id: JointId,
    /// Its contacts.
    pub(super) contacts: Vec<usize>,
    /// The couple of a guided slider.
    pub(super) couple: Option<GuidedCouple>,
    /// Its sliding acceleration.
    pub(super) row: SlidingRow,
    /// Of its contacts that are apart from their face those whose gaps are zero, by their numbers among these: the accelerations
    /// of these gaps.
    pub(super) gaps: Vec<(usize, SlidingRow)>,
    /// Its sliding velocity (m/s).
    pub(super) velocity: f64,
    /// Whether friction or an end stop could hold it.
    pub(super) has_friction: bool,
    /// The end stop that it touches: 1 at its greatest displacement, -1 at its least, otherwise 0.
    pub(super) stop: f64,
    /// Units of the bodies that joints connect to it.
    pub(super) units: Units,
}

/// A hinge with friction at an instant.
#[derive(Debug, Clone)]
pub(super) struct RoughHinge {
    /// Which joint it is.
    pub(super) id: JointId,
    /// Where its force on the first body stands among the unknowns.
    pub(super) force: [usize; 2],
    /// The rotations of its bodies among the accelerations, and the sign with which each counts.
    rotations: Vec<(usize, f64)>,
    /// The radius of its friction circle while it turns, and the static one (m).
    pub(super) radii: [f64; 2],
    /// The angular velocity of its first body against the second (rad/s).
    pub(super) velocity: f64,
    /// Units of the bodies that joints connect to it.
    pub(super) units: Units,
}

impl RoughHinge {
    /// The angular acceleration of its first body against the second among all unknowns (rad/s^2).
    pub(super) fn acceleration(&self, unknowns: &DVector<f64>) -> f64 {
        self.rotations.iter().map(|(place, sign)| sign * unknowns[*place]).sum()
    }
}

/// The hinges with friction of a mechanism, in the order of its friction circles.
pub(super) fn rough_hinges(
    mechanism: &Mechanism,
    configuration: &Configuration,
    equations: &KineticEquations,
) -> Vec<RoughHinge> {
    let one = |circle: &FrictionCircle| {
        let place = |force| equations.layout.reaction(force).expect("every hinge has its force");
        let ends = mechanism.hinge(circle.joint).map(|[first, second]| [(first, 1.0), (second, -1.0)]);
        let rotation = |(end, sign): (&Attachment, f64)| Some((3 * end.frame.body()?.index() + 2, sign));
        RoughHinge {
            id: circle.joint,
            force: circle.reactions().map(place),
            rotations: ends.into_iter().flatten().filter_map(rotation).collect(),
            radii: [circle.radius, circle.static_radius],
            velocity: spin(mechanism, configuration, circle.joint),
            units: Units { force: 1.0, length: mechanism.size, acceleration: 1.0 },
        }
    };
    mechanism.friction_circles.iter().map(one).collect()
}

/// The angular velocity of the first body of a hinge against the second (rad/s).
fn spin(mechanism: &Mechanism, configuration: &Configuration, joint: JointId) -> f64 {
    mechanism.hinge(joint).map_or(0.0, |[first, second]| {
        configuration.angular_velocity(first.frame) - configuration.angular_velocity(second.frame)
    })
}

/// The sliding joints of a mechanism, in the order of its joints.
pub(super) fn sliding_joints(
    mechanism: &Mechanism,
    configuration: &Configuration,
    equations: &KineticEquations,
) -> Vec<SlidingJoint> {
    let one = |(id, slider): (JointId, &Slider)| {
        let contacts: Vec<usize> =
            slider.contacts.iter().map(|contact: &ContactId| contact.index()).collect();
        let place = equations.layout.reaction(Reaction::Couple(id));
        let first = contacts.first().map(|&k| equations.contacts[k].sliding_velocity);
        let has_friction = contacts.iter().any(|&k| mechanism.contacts[k].may_hold());
        let stop = touched_stop(mechanism, configuration, slider);
        SlidingJoint {
            id,
            contacts,
            couple: place.map(|unknown| GuidedCouple { unknown, half_length: slider.greatest_couple(1.0) }),
            row: SlidingRow::new(mechanism, configuration, slider),
            gaps: Vec::new(),
            velocity: first.unwrap_or(0.0),
            has_friction: has_friction || stop != 0.0,
            stop,
            units: Units { force: 1.0, length: mechanism.size, acceleration: 1.0 },
        }
    };
    mechanism.sliders().map(one).collect()
}

/// Of each sliding joint the contacts that are apart from their face in the mechanism, but whose gaps are zero, by their numbers
/// among these.
pub(super) fn touching_gaps(mechanism: &Mechanism, configuration: &Configuration) -> Vec<Vec<usize>> {
    let of_joint = |joint: &crate::mechanism::Joint| match &joint.kind {
        JointKind::Slider(slider) => {
            let gaps = configuration.gaps(mechanism, slider).enumerate();
            let touches = |(_, [gap, _]): &(usize, [f64; 2])| *gap <= TOUCHES * mechanism.size;
            Some(gaps.filter(touches).map(|(number, _)| number).collect())
        }
        JointKind::Hinge(_) => None,
    };
    mechanism.joints.iter().filter_map(of_joint).collect()
}

/// Puts the accelerations of these gaps into the sliding joints.
pub(super) fn put_gaps(
    joints: &mut [SlidingJoint],
    touching: &[Vec<usize>],
    (mechanism, configuration): (&Mechanism, &Configuration),
) {
    for (joint, numbers) in joints.iter_mut().zip(touching) {
        let Some(slider) = mechanism.slider(joint.id) else { continue };
        let row = |number: &usize| {
            let contact = &slider.apart[*number];
            (*number, SlidingRow::of_gap(mechanism, configuration, (slider, contact)))
        };
        joint.gaps = numbers.iter().map(row).collect();
    }
}

/// The end stop that a joint touches: 1 at its greatest displacement, -1 at its least, otherwise 0.
fn touched_stop(mechanism: &Mechanism, configuration: &Configuration, slider: &Slider) -> f64 {
    let Some([least, greatest]) = slider.travel.filter(|_| slider.stops != [None; 2]) else {
        return 0.0;
    };
    let displacement = configuration.slide(mechanism, slider).displacement;
    let touches = |end: usize, limit: f64| {
        slider.stops[end].and_then(Stop::restitution).is_some()
            && (displacement - limit).abs() <= TOUCHES * mechanism.size
    };
    if touches(1, greatest) {
        1.0
    } else if touches(0, least) {
        -1.0
    } else {
        0.0
    }
}

/// Gives each joint and hinge the units of the bodies that joints connect to it, so that distant bodies do not
/// affect small quantities, and returns the units of the whole mechanism. Their least forces are determined
/// anew or kept.
pub(super) fn set_units(
    mechanism: &Mechanism,
    (influence, equations): (&Influence, &KineticEquations),
    least: Option<(&Configuration, Scale)>,
    ((joints, hinges), least_forces): ((&mut [SlidingJoint], &mut [RoughHinge]), &mut Vec<f64>),
) -> Units {
    let connected = connected(mechanism);
    let mut one = |counts: &dyn Fn(BodyId) -> bool, place: usize, otherwise: f64| {
        let (force, mass) = greatest(mechanism, (influence, equations), counts);
        if let Some((configuration, least)) = least {
            least_forces.push(least(mechanism, configuration, Share { counts, mass, force }));
        }
        units(mechanism.size, (force.max(least_forces[place]), mass), otherwise)
    };
    let whole = one(&|_| true, 0, 1.0);
    let bodies = |joint: JointId| match &mechanism.joints[joint.index()].kind {
        JointKind::Slider(slider) => slider.block.body().or(slider.guide.body()),
        JointKind::Hinge([first, second]) => first.frame.body().or(second.frame.body()),
    };
    let of_joints = joints.iter_mut().map(|joint| (joint.id, &mut joint.units));
    let of_hinges = hinges.iter_mut().map(|hinge| (hinge.id, &mut hinge.units));
    for (index, (joint, units)) in of_joints.chain(of_hinges).enumerate() {
        let part = bodies(joint).map(|body| connected[body.index()]);
        *units = one(&|other| Some(connected[other.index()]) == part, index + 1, whole.force);
    }
    whole
}
