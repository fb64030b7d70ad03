//! Where it is doubtful that a joint has two faces.
//!
//! Every slider has two faces, so that its contacts may pull. A ladder drawn with a pin on its wall holds however it is drawn
//! away from it. Whether a thing has the second face no model says; but a joint that states nothing of it (no height, play,
//! fit, preload, friction of either face, further support) is perhaps meant to have one only. The block lies then
//!
//! - on the side on which it is drawn: all of a pin's body beyond the line of the guide; of a block or guided slider an edge of
//!   its outline or rectangle on that line, with the rest beyond it;
//! - else on the side that all contacts of the joint press under the weights alone, at rest and without friction.
//!
//! Where weights press it to the other side it hangs, and has two faces indeed. There is a hint where an answer presses the other
//! side, and where a block or guided slider jams, which takes both.

use crate::configuration::Configuration;
use crate::ids::{ContactId, Frame, JointId};
use crate::influence::Influence;
use crate::kinetics::KineticEquations;
use crate::mechanism::{Body, JointKind, Mechanism, Quantity, Shape, Slider};
use crate::model::outline::polygon;
use crate::model::{self, Model, SliderKind};
use crate::report::{OneFaceHint, OneFaceReason, Solution, SolveReport, Status};
use nalgebra::Vector2;
use std::cell::OnceCell;

/// Places closer to the line of a guide than this part of the size of the mechanism are on it.
const ON_LINE: f64 = 1e-6;
/// Normal forces below this part of the greatest are rounding.
const NO_FORCE: f64 = 1e-9;

/// For each contact the least and the greatest normal force of one state (N).
pub(crate) type NormalForces = Vec<[f64; 2]>;

/// The normal forces that an answer knows.
pub(crate) struct Pressed<'a> {
    /// The normal forces of each state that is possible.
    pub(crate) states: &'a [NormalForces],
    /// True if no state is possible.
    pub(crate) jams: bool,
}

/// The hints on the solutions of a report, or on its jam.
pub(super) fn of_solutions(
    model: &Model,
    state: (&Mechanism, &Configuration),
    report: &SolveReport,
) -> Vec<OneFaceHint> {
    if state.0.space.is_some() {
        return Vec::new();
    }
    let states = report.taken().chain(&report.preload_gap_states);
    let forces = |solution: &Solution| solution.contacts.iter().map(|one| [one.normal_force; 2]).collect();
    let states: Vec<NormalForces> = states.map(forces).collect();
    let jams = report.status == Status::None && report.rejected.is_empty();
    one_face_hints(model, state, &Pressed { states: &states, jams })
}

/// The joints of two faces of which an answer needs the one that the thing itself may not have.
pub(crate) fn one_face_hints(
    model: &Model,
    (mechanism, configuration): (&Mechanism, &Configuration),
    answer: &Pressed<'_>,
) -> Vec<OneFaceHint> {
    let weights = OnceCell::new();
    let weights = || weights.get_or_init(|| under_weights(mechanism, configuration)).as_deref();
    let hint = |(index, joint): (usize, &model::Joint)| {
        let model::JointKind::Slider(written) = &joint.kind else { return None };
        let JointKind::Slider(slider) = &mechanism.joints.get(index)?.kind else { return None };
        if states_two_faces(written, slider)
            || mechanism.may_lift_off(slider)
            || is_redundant(mechanism, slider)
        {
            return None;
        }
        let drawn = drawn_side(mechanism, slider);
        let reason = if drawn.is_some() { OneFaceReason::Pulls } else { OneFaceReason::ChangesSide };
        let may_jam = answer.jams && slider.kind != SliderKind::Pin;
        let against = |side: f64| contacts_against(slider, side, answer.states);
        // Weights are asked for only where they matter.
        if drawn.is_some_and(|side| against(side).is_empty() && !may_jam) {
            return None;
        }
        let lies = weights().and_then(|forces| side_of_all(slider, forces));
        let side = match (drawn, lies) {
            (Some(drawn), Some(lies)) if drawn != lies => return None,
            (drawn, lies) => drawn.or(lies)?,
        };
        let pulled = against(side);
        let joint = JointId(index);
        if !pulled.is_empty() {
            return Some(told(mechanism, (joint, slider), &pulled, reason));
        }
        may_jam.then(|| told(mechanism, (joint, slider), &slider.contacts, OneFaceReason::Jams))
    };
    model.joints.iter().enumerate().filter_map(hint).collect()
}

/// Returns whether a model says something that only two faces have.
fn states_two_faces(written: &model::Slider, slider: &Slider) -> bool {
    let of_contact = |contact: &model::Contact| {
        contact.play.is_some()
            || contact.misalignment.is_some()
            || contact.face.is_some()
            || contact.preload.iter().any(Option::is_some)
            || contact.mu[0] != contact.mu[1]
            || contact.mu_static[0] != contact.mu_static[1]
    };
    let ends = if slider.kind == SliderKind::Block { 2 } else { 1 };
    written.height.is_some()
        || written.around
        || written.contacts.len() > ends
        || written.contacts.iter().any(of_contact)
}

fn is_redundant(mechanism: &Mechanism, slider: &Slider) -> bool {
    slider.contacts.iter().any(|contact| mechanism.excess.shares(*contact))
}

/// The contacts that press against a side (1 or -1) in some state.
fn contacts_against(slider: &Slider, side: f64, states: &[NormalForces]) -> Vec<ContactId> {
    let presses = |contact: &&ContactId| {
        states.iter().any(|forces| {
            let [least, greatest] = forces[contact.index()];
            let nearest = if side > 0.0 { greatest } else { -least };
            nearest < -NO_FORCE * greatest_of(forces)
        })
    };
    slider.contacts.iter().filter(presses).copied().collect()
}

/// The greatest finite magnitude.
fn greatest_of(forces: &[[f64; 2]]) -> f64 {
    let ends = forces.iter().flatten().map(|force| force.abs());
    ends.filter(|force| force.is_finite()).fold(0.0, f64::max)
}

/// The normal forces of the weights alone, at rest and without friction; none without weights.
fn under_weights(mechanism: &Mechanism, configuration: &Configuration) -> Option<NormalForces> {
    if mechanism.gravity == Vector2::zeros() {
        return None;
    }
    let mut alone = mechanism.clone();
    alone.loads.clear();
    for coordinate in &mut alone.coordinates {
        coordinate.rate = 0.0;
    }
    for drive in &mut alone.drives {
        drive.acceleration = Quantity::Constant(0.0);
    }
    let mut resting = configuration.clone();
    resting.velocities = Configuration::drawing(&alone).velocities;
    resting.rates.fill(0.0);
    let equations = KineticEquations::new(&alone, &resting).ok()?;
    Some(Influence::new(&equations).normal_forces().iter().map(|force| [*force; 2]).collect())
}

/// The side (1 or -1) that all contacts of a joint press; none if they press different ones or none.
fn side_of_all(slider: &Slider, forces: &[[f64; 2]]) -> Option<f64> {
    let little = NO_FORCE * greatest_of(forces);
    let side = |contact: &ContactId| {
        let [force, _] = forces[contact.index()];
        (force.abs() > little).then(|| force.signum())
    };
    let first = side(slider.contacts.first()?)?;
    slider.contacts.iter().all(|contact| side(contact) == Some(first)).then_some(first)
}

/// The side (1 or -1) of the guide's line on which the block is drawn; none where the drawing does not tell.
fn drawn_side(mechanism: &Mechanism, slider: &Slider) -> Option<f64> {
    let normal = Vector2::new(-slider.tangent.y, slider.tangent.x);
    let height = |place: Vector2<f64>| (place - slider.at).dot(&normal);
    let of = |frame: Frame| {
        let body = frame.body().map(|body| &mechanism.bodies[body.index()])?;
        Some(Extent::of(body, slider.kind, &height))
    };
    // Where the ground is the block, the guide shows on which side of its face the ground is.
    let (block, guide) = (of(slider.block), of(slider.guide).map(Extent::mirrored));
    let near = ON_LINE * mechanism.size;
    let shown = block.as_ref().or(guide.as_ref())?;
    let is_edge = slider.kind == SliderKind::Pin || shown.has_edge_on_line(near);
    let on = |side: f64| {
        let is_beyond = |extent: &Extent| extent.least_on(side) >= -near;
        [&block, &guide].into_iter().flatten().all(is_beyond) && shown.least_on(-side) < -near
    };
    [1.0, -1.0].into_iter().find(|side| is_edge && on(*side))
}

/// How far a body is drawn from the line of a guide (m).
struct Extent {
    /// Heights of its outline's corners, its shape or its points above the line.
    heights: Vec<f64>,
    /// True if lines lead from each to the next, so that two on the line are an edge.
    has_edges: bool,
}

impl Extent {
    /// That of a body; its points count where it has neither outline nor shape.
    fn of(body: &Body, kind: SliderKind, height: &impl Fn(Vector2<f64>) -> f64) -> Self {
        let centre = height(body.centre_of_mass);
        if !body.outline.is_empty() {
            let heights = polygon(&body.outline).into_iter().map(height).collect();
            return Self { heights, has_edges: true };
        }
        match &body.shape {
            Some(Shape::Bar(ends)) => Self { heights: ends.map(height).to_vec(), has_edges: false },
            Some(Shape::Disc(radius)) => {
                Self { heights: vec![centre - radius, centre + radius], has_edges: false }
            }
            // No model says how it is turned: that edge is parallel to the line whose distance is nearest.
            Some(Shape::Rectangle([width, breadth])) => {
                let off = |half: f64| (centre.abs() - half).abs();
                let [one, other] = [width / 2.0, breadth / 2.0];
                let half = if off(one) < off(other) { one } else { other };
                let [low, high] = [centre - half, centre + half];
                Self { heights: vec![low, low, high, high], has_edges: true }
            }
            None => {
                let points = body.points.iter().map(|(_, point)| height(*point));
                let masses = (body.mass > 0.0).then_some(centre);
                let heights: Vec<f64> = points.chain(masses).collect();
                // Points do not tell the edge of a block.
                let has_edges = kind == SliderKind::Pin;
                Self { heights, has_edges }
            }
        }
    }

    /// As seen from the other side of the line.
    fn mirrored(self) -> Self {
        Self { heights: self.heights.into_iter().map(|height| -height).collect(), ..self }
    }

    /// The least height where a side (1 or -1) counts as above.
    fn least_on(&self, side: f64) -> f64 {
        self.heights.iter().map(|height| side * height).fold(f64::INFINITY, f64::min)
    }

    fn has_edge_on_line(&self, near: f64) -> bool {
        let next = self.heights.iter().cycle().skip(1);
        let mut pairs = self.heights.iter().zip(next);
        self.has_edges && pairs.any(|(one, other)| one.abs() <= near && other.abs() <= near)
    }
}

fn told(
    mechanism: &Mechanism,
    (joint, slider): (JointId, &Slider),
    contacts: &[ContactId],
    reason: OneFaceReason,
) -> OneFaceHint {
    let name = mechanism.joints[joint.index()].name.to_string();
    let contacts: Vec<String> =
        contacts.iter().map(|contact| mechanism.contacts[contact.index()].name.to_string()).collect();
    let frame = |frame: Frame| match frame {
        Frame::Ground => "the ground",
        Frame::Body(_) => mechanism.frame_name(frame),
    };
    let [block, guide] = [slider.block, slider.guide].map(frame);
    let instead = if slider.kind == SliderKind::Pin { "corner_on_face" } else { "block_on_face" };
    let at = contacts.join(" and ");
    let what = match reason {
        OneFaceReason::Pulls => format!("At {at}, {guide} would have to pull on {block}."),
        OneFaceReason::ChangesSide => {
            format!(
                "At {at}, {block} presses against the other face, not the one it lies on under the weights alone."
            )
        }
        OneFaceReason::Jams => format!("{name} jams between two faces."),
    };
    let words = format!("{what} If there is only one face, make {name} a `{instead}`: then it may lift off.");
    OneFaceHint { joint: name, contacts, reason, instead, words }
}
