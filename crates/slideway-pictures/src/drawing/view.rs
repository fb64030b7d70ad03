//! From metres to drawing units, and how far guides reach.

use super::looks::{corners, is_belt};
use super::scene::{Bounds, Point};
use nalgebra::Vector2;
use slideway::configuration::Configuration;
use slideway::ids::{BodyId, ContactId, Frame};
use slideway::mechanism::{Attachment, Effort, JointKind, LoadKind, Mechanism, Quantity, Shape, Slider};

/// How a mechanism is laid out in a drawing: the same view serves many configurations of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Drawing units for a metre.
    pub scale: f64,
    /// The place (m) at the origin of the drawing.
    pub middle: Vector2<f64>,
    /// Least and greatest displacement (m) of each joint, zero for hinges: guides reach that far.
    pub(crate) slides: Vec<[f64; 2]>,
    /// Where the drawing of each body with a long rectangle begins and ends along its longer side (m, from
    /// its centre of mass): beyond, nothing else is to be seen. None for bodies that are drawn whole.
    pub cuts: Vec<Option<[f64; 2]>>,
}

/// A rectangle may be cut if it is so many times as long as wide.
const LONG: f64 = 4.0;
/// How far a long rectangle is drawn beyond all other places, and how much has to be left for it to be torn
/// off.
const BEYOND: f64 = 70.0;
const LEAST_CUT: f64 = 40.0;

impl View {
    /// A view in which every one of some configurations has its place within a width and height (drawing
    /// units); what is drawn around it (hatching, arrows, labels) comes on top of that.
    pub fn fitting(mechanism: &Mechanism, configurations: &[&Configuration], size: [f64; 2]) -> Self {
        let extent = |configuration: &&Configuration| places(mechanism, configuration);
        let bounds = Bounds::around(configurations.iter().flat_map(extent))
            .unwrap_or(Bounds { least: Point::zeros(), greatest: Point::zeros() });
        let wanted = bounds.size();
        let scale = (size[0] / wanted.x).min(size[1] / wanted.y);
        let scale = if scale.is_finite() { scale } else { 0.3 * size[0] / mechanism.size };
        let slides = mechanism
            .joints
            .iter()
            .map(|joint| match &joint.kind {
                JointKind::Hinge(_) => [0.0; 2],
                JointKind::Slider(slider) => slides(mechanism, configurations, slider),
            })
            .collect();
        let bodies = (0..mechanism.bodies.len()).map(BodyId);
        let cuts = bodies.map(|body| cut(mechanism, configurations, body, scale)).collect();
        Self { scale, middle: bounds.middle(), slides, cuts }
    }

    /// Where a place (m) is in the drawing.
    pub fn place(&self, place: Vector2<f64>) -> Point {
        self.direction((place - self.middle) * self.scale)
    }

    /// A direction in the drawing, where y points down.
    pub fn direction(&self, direction: Vector2<f64>) -> Point {
        Point::new(direction.x, -direction.y)
    }
}

/// Least and greatest displacement of a sliding joint, with its limits of travel where they are near.
fn slides(mechanism: &Mechanism, configurations: &[&Configuration], slider: &Slider) -> [f64; 2] {
    let displacement = |configuration: &&Configuration| configuration.slide(mechanism, slider).displacement;
    let all = configurations.iter().map(displacement);
    let limits = slider.travel.into_iter().flatten().filter(|limit| limit.abs() <= mechanism.size);
    all.chain(limits)
        .map(|value| [value; 2])
        .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
        .unwrap_or([0.0; 2])
}

/// Whether a rectangle, such as a belt, is narrow and longer than all that it carries: then its ends do not
/// have to be seen.
fn is_long(mechanism: &Mechanism, [width, height]: [f64; 2]) -> bool {
    width.max(height) >= mechanism.size.max(LONG * width.min(height))
}

/// The part of a rectangle along its longer side that has places beside it, and what is drawn beyond them.
fn cut(
    mechanism: &Mechanism,
    configurations: &[&Configuration],
    body: BodyId,
    scale: f64,
) -> Option<[f64; 2]> {
    let Some(Shape::Rectangle([width, height])) = mechanism.bodies[body.index()].shape else { return None };
    if !is_long(mechanism, [width, height]) || !mechanism.bodies[body.index()].outline.is_empty() {
        return None;
    }
    let upright = if width >= height { 0.0 } else { std::f64::consts::FRAC_PI_2 };
    let half = 0.5 * width.max(height);
    let along = |configuration: &&Configuration| {
        let pose = configuration.poses[body.index()];
        let (sin, cos) = (pose.angle() + mechanism.lean(body) + upright).sin_cos();
        let axis = Vector2::new(cos, sin);
        places(mechanism, configuration).into_iter().map(move |place| (place - pose.position).dot(&axis))
    };
    let beyond = BEYOND / scale;
    let wanted = configurations
        .iter()
        .flat_map(along)
        .map(|place| [place - beyond, place + beyond])
        .reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    let least = half - LEAST_CUT / scale;
    let ends = [
        if wanted[0] > -least { wanted[0] } else { -half },
        if wanted[1] < least { wanted[1] } else { half },
    ];
    (ends != [-half, half]).then_some(ends)
}

/// Places (m) that have to be seen.
fn places(mechanism: &Mechanism, configuration: &Configuration) -> Vec<Vector2<f64>> {
    let mut places = Vec::new();
    for (index, body) in mechanism.bodies.iter().enumerate() {
        let frame = Frame::Body(BodyId(index));
        if is_belt(mechanism, BodyId(index)) {
            continue;
        }
        let centre = configuration.poses[index].position;
        let place = |position| configuration.position(mechanism, &Attachment::new(frame, position));
        if body.shape.is_none() || !body.outline.is_empty() {
            let corners = corners(mechanism, BodyId(index)).unwrap_or_default();
            places.extend(corners.into_iter().map(place));
            places.push(centre);
            continue;
        }
        match body.shape {
            Some(Shape::Bar(ends)) => {
                places.extend(ends.map(place));
            }
            Some(Shape::Rectangle([width, height])) => {
                let across = 0.5 * Vector2::new(width, height);
                if is_long(mechanism, [width, height]) {
                    places.push(centre);
                } else {
                    places.extend([centre - across, centre + across]);
                }
            }
            Some(Shape::Disc(radius)) => {
                let across = Vector2::new(radius, radius);
                places.extend([centre - across, centre + across]);
            }
            None => {}
        }
    }
    for joint in &mechanism.joints {
        match &joint.kind {
            JointKind::Hinge(ends) => places.push(configuration.position(mechanism, &ends[0])),
            JointKind::Slider(slider) => places.extend(slider_places(mechanism, configuration, slider)),
        }
    }
    for load in &mechanism.loads {
        match &load.kind {
            LoadKind::Force { at, .. } => places.push(configuration.position(mechanism, at)),
            LoadKind::Spring { between, stiffness: size, .. }
            | LoadKind::Damper { between, damping: size }
                if !is_zero(*size) =>
            {
                places.extend(between.iter().map(|end| configuration.position(mechanism, end)));
            }
            _ => {}
        }
    }
    for drive in &mechanism.drives {
        let Effort::Force { at, .. } = &drive.effort else { continue };
        if !at.frame.body().is_some_and(|body| is_belt(mechanism, body)) {
            places.push(configuration.position(mechanism, at));
        }
    }
    places
}

/// Corners of the block, its contacts, and where faces are of which it is apart.
fn slider_places(mechanism: &Mechanism, configuration: &Configuration, slider: &Slider) -> Vec<Vector2<f64>> {
    let tangent = configuration.direction(slider.block, slider.tangent);
    let middle = configuration.position(mechanism, &Attachment::new(slider.block, slider.at));
    let across = Vector2::new(-tangent.y, tangent.x) * (0.5 * slider.height);
    let half = tangent * (0.5 * slider.length);
    let contacts = slider.contacts.iter().map(|id: &ContactId| configuration.contact(mechanism, *id).point);
    if slider.block.body().is_some_and(|body| is_belt(mechanism, body)) {
        return contacts.collect();
    }
    let normal = configuration.slide(mechanism, slider).normal;
    let faces = configuration.gaps(mechanism, slider).zip(&slider.apart).map(|([gap, _], contact)| {
        let position = contact.position(slider);
        configuration.position(mechanism, &Attachment::new(slider.block, position)) - normal * gap
    });
    [middle + half + across, middle - half + across, middle + half - across, middle - half - across]
        .into_iter()
        .chain(contacts)
        .chain(faces)
        .collect()
}

/// Whether a quantity is the constant zero: then there is nothing to be drawn.
pub(super) fn is_zero(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Constant(0.0))
}
