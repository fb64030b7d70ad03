//! Springs and dampers, loads, weights and the efforts of drives.

use super::Painter;
use super::looks::Look;
use super::outline::{turned, unit};
use super::scene::{Class, Element, Point, Shape};
use super::slide::Slide;
use super::view::is_zero;
use nalgebra::Vector2;
use slideway::configuration::Configuration;
use slideway::ids::{BodyId, Frame};
use slideway::kinetics::load_wrenches;
use slideway::mechanism::{Attachment, Drive, Effort, JointKind, Load, LoadKind, Mechanism, Pad, Quantity};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// Length of an arrow that is not to scale.
const ARROW: f64 = 46.0;
/// Greatest length of an arrow to scale, unless options say another.
pub(super) const LONGEST_ARROW: f64 = 110.0;
/// Below this length an arrow to scale is a head alone.
pub(super) const LEAST_ARROW: f64 = 9.0;
/// Radius of the mark of a corner that presses.
pub(super) const CORNER: f64 = 5.0;
/// A force whose part along a belt is smaller than itself by at most this part of it is along the belt, as rounding
/// goes.
const ALONG: f64 = 1e-9;
/// Radius of the ring around the sign of a force along z.
pub(super) const RING: f64 = 6.5;
/// Radius of the arrow of a torque.
const TORQUE: f64 = 21.0;

impl Painter<'_> {
    /// Springs and dampers.
    pub(super) fn connections(&mut self) {
        let mechanism = self.mechanism;
        for (index, load) in mechanism.loads.iter().enumerate() {
            match &load.kind {
                LoadKind::Spring { between, stiffness, .. } if !is_zero(*stiffness) => {
                    let [from, to] = self.ends(between, index);
                    self.anchored(between, [from, to]);
                    self.line(Class::Spring, zigzag(from, to));
                    self.named_connection(&load.name, from, to);
                }
                LoadKind::Damper { between, damping } if !is_zero(*damping) => {
                    let [from, to] = self.ends(between, index);
                    self.anchored(between, [from, to]);
                    self.dashpot(from, to);
                    self.named_connection(&load.name, from, to);
                }
                LoadKind::TorsionalSpring { between, stiffness, .. } if !is_zero(*stiffness) => {
                    let centre = self.pivot(*between);
                    let spiral = (0..=60).map(|step| {
                        let part = f64::from(step) / 60.0;
                        let angle = 2.25 * TAU * part;
                        centre + Point::new(angle.cos(), angle.sin()) * (6.0 + 11.0 * part)
                    });
                    self.line(Class::Spring, spiral.collect());
                    self.name(&load.name, centre + Point::new(14.0, 14.0), Point::new(0.7, 0.7));
                }
                LoadKind::TorsionalDamper { between, damping } if !is_zero(*damping) => {
                    let centre = self.pivot(*between);
                    for (radius, from, to) in [(13.0, -0.1, 0.6), (17.0, 0.05, 0.45)] {
                        self.line(Class::Damper, arc(centre, radius, from * TAU, to * TAU));
                    }
                    self.name(&load.name, centre + Point::new(-14.0, 14.0), Point::new(-0.7, 0.7));
                }
                _ => {}
            }
        }
    }

    /// The ends of a spring or damper, beside each other where several have the same ends.
    fn ends(&self, between: &[Attachment; 2], index: usize) -> [Point; 2] {
        let [from, to] = between.each_ref().map(|end| self.attached(end));
        let same = |other: &Load| match &other.kind {
            LoadKind::Spring { between: ends, stiffness: size, .. }
            | LoadKind::Damper { between: ends, damping: size } => {
                let places = ends.each_ref().map(|end| self.attached(end));
                !is_zero(*size) && (places[0] - from).norm() < 1.0 && (places[1] - to).norm() < 1.0
            }
            _ => false,
        };
        let loads = &self.mechanism.loads;
        let before = loads[..index].iter().filter(|load| same(load)).count();
        let all = loads.iter().filter(|load| same(load)).count();
        let aside = 20.0 * (before as f64 - 0.5 * (all.max(1) - 1) as f64);
        let across = turned(unit(to - from, Point::x())) * aside;
        [from + across, to + across]
    }

    /// Ground at the ends of a spring or damper that stand on it.
    fn anchored(&mut self, between: &[Attachment; 2], ends: [Point; 2]) {
        for (index, end) in between.iter().enumerate() {
            if end.frame == Frame::Ground {
                let inwards = unit(ends[1 - index] - ends[index], Point::x());
                let across = turned(inwards) * 12.0;
                let [start, stop] = [ends[index] + across, ends[index] - across];
                self.line(Class::Wall, vec![start, stop]);
                self.hatching(stop, start);
            }
        }
    }

    fn dashpot(&mut self, from: Point, to: Point) {
        let along = unit(to - from, Point::x());
        let across = turned(along) * 6.0;
        let middle = 0.5 * (from + to);
        let half = along * (0.3 * (to - from).norm()).min(13.0);
        self.line(Class::Damper, vec![from, middle - half]);
        self.line(
            Class::Damper,
            vec![
                middle + half + across,
                middle - half + across,
                middle - half - across,
                middle + half - across,
            ],
        );
        self.line(Class::Damper, vec![middle + 0.75 * across, middle - 0.75 * across]);
        self.line(Class::Damper, vec![middle, to]);
    }

    fn named_connection(&mut self, name: &str, from: Point, to: Point) {
        let across = turned(unit(to - from, Point::x()));
        let across = if across.y > 0.0 { -across } else { across };
        self.name(name, 0.5 * (from + to) + across * 8.0, across);
    }

    /// Where two bodies turn against each other: their hinge, or the middle of the first that moves.
    fn pivot(&self, between: [Frame; 2]) -> Point {
        let hinge = self.mechanism.joints.iter().find_map(|joint| match &joint.kind {
            JointKind::Hinge(ends) if ends.iter().all(|end| between.contains(&end.frame)) => Some(&ends[0]),
            _ => None,
        });
        match (hinge, between.iter().find_map(|frame| frame.body())) {
            (Some(end), _) => self.attached(end),
            (None, Some(body)) => self.centre(body),
            (None, None) => Point::zeros(),
        }
    }

    /// Forces and torques, the efforts of the drives, the forces of pads, and weights.
    pub(super) fn loads(&mut self) {
        if !self.options.locking {
            self.known_loads();
            self.weights();
        }
        for (index, drive) in self.mechanism.drives.iter().enumerate() {
            self.drive(index, drive);
        }
    }

    fn known_loads(&mut self) {
        let mechanism = self.mechanism;
        for (index, load) in mechanism.loads.iter().enumerate() {
            match &load.kind {
                LoadKind::Force { at, .. } => self.force_load(load, *at),
                LoadKind::Spring { between, .. } | LoadKind::Damper { between, .. } => {
                    self.connection_force(index, between);
                }
                LoadKind::Torque { body, moment, .. } => {
                    let moment = self.value_of(*moment);
                    if moment != Some(0.0) {
                        let text = self.named(&load.name, moment, "N m");
                        self.torque(Class::Load, *body, moment.unwrap_or(1.0), text);
                    }
                }
                LoadKind::Pad(pad) => self.pad_force(pad),
                _ => {}
            }
        }
    }

    /// The force of a pad on the block that it meets, where they meet.
    fn pad_force(&mut self, pad: &Pad) {
        let Some(slide) = self.slide(pad.joint) else { return };
        let Some(stop) = slide.stops[usize::from(pad.greatest)] else { return };
        let Some(force) = self.actual.pad_force(self.mechanism, pad) else { return };
        if force > 0.0 {
            let away = slide.guide.along * -pad.sense();
            let length = self.options.force_scale.map_or(ARROW, |scale| scale * force);
            let face = slide.guide.at(stop.face, 0.0);
            let text = format!("pad {}", self.shown(force, "N"));
            self.arrow_of_force(Class::Load, (face, false), away * length, text);
        }
    }

    fn value_of(&self, quantity: Quantity) -> Option<f64> {
        let state = self.configuration;
        self.mechanism.quantity(quantity, &state.coordinates, &state.rates, state.time).ok()
    }

    fn force_load(&mut self, load: &Load, at: Attachment) {
        if let Some(force) = load_force(self.mechanism, self.configuration, load) {
            let text = self.named(&load.name, Some(force.norm()), "N");
            self.force(Class::Load, at, force, text);
        }
        let wrenches = load_wrenches(self.mechanism, self.configuration, load).unwrap_or_default();
        if let Some(along_z) = wrenches.first().map(|wrench| wrench.along_z).filter(|force| *force != 0.0) {
            let text = self.named(&load.name, Some(along_z), "N");
            self.out_of_drawing(Class::Load, self.attached(&at), along_z > 0.0, text);
        }
    }

    /// Draws the forces of a spring or damper on the bodies at its ends, where it is drawn.
    fn connection_force(&mut self, index: usize, between: &[Attachment; 2]) {
        let load = &self.mechanism.loads[index];
        let Some(force) = load_force(self.mechanism, self.actual, load) else { return };
        let places = self.ends(between, index);
        for ((end, place), force) in between.iter().zip(places).zip([force, -force]) {
            if let Some(body) = end.frame.body() {
                let text = self.named(&load.name, Some(force.norm()), "N");
                self.force_at(Class::Load, [place, self.centre(body)], force, text);
            }
        }
    }

    /// An arrow of a force on a body or on ground.
    fn force(&mut self, class: Class, at: Attachment, force: Vector2<f64>, text: String) {
        let place = self.attached(&at);
        let centre = at.frame.body().map_or(place, |body| self.centre(body));
        let places = self.end_of_belt(at, force).map_or([place, centre], |end| [end; 2]);
        self.force_at(class, places, force, text);
    }

    /// Where a force along a belt is drawn, wherever on its line it acts: at the end to which it pulls.
    fn end_of_belt(&self, at: Attachment, force: Vector2<f64>) -> Option<Point> {
        let is_belt = |slide: &&Slide| slide.look == Look::Rollers && slide.block_frame == at.frame;
        let belt = self.sliders.iter().flatten().find(is_belt)?;
        let pull = self.view.direction(force).dot(&belt.guide.along);
        let is_along = (force.norm() - pull.abs()) <= ALONG * force.norm();
        is_along.then(|| belt.guide.at(belt.block_reach[usize::from(pull > 0.0)], 0.0))
    }

    /// An arrow that ends or begins where its force acts, so that it lies outside of the body with this centre; none
    /// of no force.
    fn force_at(&mut self, class: Class, [place, centre]: [Point; 2], force: Vector2<f64>, text: String) {
        if force.norm() == 0.0 {
            return;
        }
        let direction = self.view.direction(force / force.norm());
        let is_known = class != Class::Drive;
        let to_scale = self.options.force_scale.filter(|_| is_known).map(|scale| scale * force.norm());
        let length = to_scale.unwrap_or(ARROW);
        let pushes = (centre - place).dot(&direction) > 1.0;
        // A force may be drawn anywhere on its line. In moving pictures, which have no values, it does not jump.
        let covered = |pushes: bool| self.covered(place, direction * if pushes { -length } else { length });
        let pushes = pushes != (self.options.values && covered(!pushes) < covered(pushes));
        self.arrow_of_force(class, (place, pushes), direction * length, text);
    }

    /// For how long an arrow from a place, or to it, lies on other arrows.
    fn covered(&self, place: Point, arrow: Point) -> f64 {
        const NEAR: f64 = 5.0;
        let along = unit(arrow, Point::x());
        let longest = arrow.norm().min(self.options.longest_arrow);
        let overlap = |element: &Element| {
            let Shape::Arrow { from, to } = element.shape else { return 0.0 };
            let ends = [from, to].map(|end| end - place);
            if ends.iter().any(|end| end.perp(&along).abs() > NEAR) {
                return 0.0;
            }
            let [one, other] = ends.map(|end| end.dot(&along));
            (one.max(other).min(longest) - one.min(other).max(0.0)).max(0.0)
        };
        self.scene.elements.iter().map(overlap).sum()
    }

    /// The arrow of a force that ends or begins at a place, and its value; broken where it would be too long.
    pub(super) fn arrow_of_force(
        &mut self,
        class: Class,
        (place, ends_there): (Point, bool),
        arrow: Point,
        text: String,
    ) {
        let direction = unit(arrow, Point::x());
        let length = arrow.norm().min(self.options.longest_arrow);
        let from = if ends_there { place - direction * length.max(LEAST_ARROW) } else { place };
        self.arrow(class, from, from + direction * length, text);
        if arrow.norm() > length {
            let strokes = broken(from + direction * (0.45 * length), direction);
            self.scene.elements.extend(strokes.map(|shape| Element { class: Class::Break, shape }));
        }
    }

    /// An arrow and its value; the head alone where the arrow would be too short.
    fn arrow(&mut self, class: Class, from: Point, to: Point, text: String) {
        let direction = unit(to - from, Point::x());
        if (to - from).norm() < LEAST_ARROW {
            let tip = from + direction * LEAST_ARROW;
            self.scene.add(class, Shape::Head(tip, direction));
            self.value_along(class, text, [from, tip], turned(direction));
        } else {
            self.scene.add(class, Shape::Arrow { from, to });
            let side = turned(direction);
            let side = if side.y > 0.0 { -side } else { side };
            self.value_along(class, text, [from, to], side);
        }
    }

    /// An arc with a head about the hinge of a body, or its centre of mass.
    fn torque(&mut self, class: Class, body: Frame, moment: f64, text: String) {
        let pivot = self.mechanism.joints.iter().find_map(|joint| match &joint.kind {
            JointKind::Hinge([first, second])
                if (first.frame == body && second.frame == Frame::Ground)
                    || (second.frame == body && first.frame == Frame::Ground) =>
            {
                Some(*first)
            }
            _ => None,
        });
        let Some(centre) = pivot.map(|end| self.attached(&end)).or(body.body().map(|body| self.centre(body)))
        else {
            return;
        };
        // Counter-clockwise in the world, where y points up.
        let (from, to) = if moment > 0.0 { (0.4, -3.5) } else { (-3.5, 0.4) };
        let sweep = arc(centre, TORQUE, from, to);
        let tip = sweep.last().copied().unwrap_or(centre);
        let before = sweep.iter().rev().nth(1).copied().unwrap_or(centre);
        let direction = unit(tip - before, Point::y());
        self.line(class, sweep);
        self.scene.add(class, Shape::Head(tip + direction * 6.0, direction));
        let up = Point::new(0.0, -1.0);
        let top = centre + up * TORQUE;
        let aside = Point::new(TORQUE, 0.0);
        self.value_along(class, text, [top - aside, top + aside], up);
    }

    /// A known effort is a load; an unknown one the direction in which it is counted.
    fn drive(&mut self, index: usize, drive: &Drive) {
        let effort = self.states.efforts.get(index).copied().filter(|_| self.options.force_scale.is_some());
        let class = if effort.is_some() { Class::Load } else { Class::Drive };
        match drive.effort {
            Effort::Force { at, direction, turns, .. } => {
                let direction =
                    if turns { self.configuration.direction(at.frame, direction) } else { direction };
                let force = direction * effort.unwrap_or(1.0);
                self.force(class, at, force, self.named(&drive.name, effort, "N"));
            }
            Effort::Torque { body, .. } => {
                self.torque(class, body, effort.unwrap_or(1.0), self.named(&drive.name, effort, "N m"));
            }
        }
    }

    /// "W = 300 N", or the name alone. Without a sign: the arrow points where it acts.
    fn named(&self, name: &str, value: Option<f64>, si: &str) -> String {
        let value = value.filter(|_| !self.options.locking);
        value.map_or_else(|| name.to_owned(), |value| format!("{name} = {}", self.shown(value.abs(), si)))
    }

    /// Weights; of gravity that does not act downwards, as in a slope or seen from above, only a part may be given.
    fn weights(&mut self) {
        let mechanism = self.mechanism;
        let name = if mechanism.gravity.x == 0.0 { "weight" } else { "gravity" };
        for (index, body) in mechanism.bodies.iter().enumerate() {
            let weight = mechanism.gravity * body.mass;
            if weight.norm() > 0.0 {
                let at = Attachment::new(Frame::Body(BodyId(index)), body.centre_of_mass);
                self.force(Class::Load, at, weight, format!("{name} {}", self.shown(weight.norm(), "N")));
            }
            let along_z = mechanism.space.as_ref().map_or(0.0, |space| space.gravity * body.mass);
            if along_z != 0.0 {
                let text = format!("{name} {}", self.shown(along_z.abs(), "N"));
                self.out_of_drawing(Class::Load, self.centre(BodyId(index)), along_z > 0.0, text);
            }
        }
    }
}

/// The force of a load (N) where it begins, if it is a force, a spring or a damper and has a value in this state. A
/// spring or damper acts with the opposite force on its other end.
pub(super) fn load_force(
    mechanism: &Mechanism,
    configuration: &Configuration,
    load: &Load,
) -> Option<Vector2<f64>> {
    let is_force =
        matches!(load.kind, LoadKind::Force { .. } | LoadKind::Spring { .. } | LoadKind::Damper { .. });
    let wrenches = load_wrenches(mechanism, configuration, load).ok().filter(|_| is_force)?;
    Some(wrenches.first()?.force)
}

/// A dot in a ring, for a force out of the drawing, or a cross in it, for one into the drawing.
pub(super) fn sign_of_z(class: Class, place: Point, is_out: bool) -> Vec<Element> {
    let shape = |class: Class, shape: Shape| Element { class, shape };
    let mut shapes = vec![
        shape(Class::MassRing, Shape::Circle(place, RING)),
        shape(class, Shape::Line(arc(place, RING, 0.0, TAU))),
    ];
    if is_out {
        shapes.push(shape(Class::PointsOut, Shape::Circle(place, 1.4)));
        return shapes;
    }
    for side in [1.0, -1.0] {
        let half = Point::new(1.0, side) * (RING * FRAC_1_SQRT_2);
        shapes.push(shape(Class::PointsIn, Shape::Line(vec![place - half, place + half])));
    }
    shapes
}

/// Returns the sample of a class for a key, so long from a place on: an arrow, or a sign.
pub(crate) fn sample(class: Class, from: Point, length: f64) -> Vec<Shape> {
    let to = from + Point::new(length, 0.0);
    let middle = from.lerp(&to, 0.45);
    match class {
        Class::Break => broken(middle, Point::x()).collect(),
        Class::JammedCorner => vec![Shape::Circle(middle, CORNER)],
        Class::PointsOut | Class::PointsIn => {
            let signs = sign_of_z(class, middle, class == Class::PointsOut);
            signs.into_iter().skip(1).map(|element| element.shape).collect()
        }
        Class::Cone => vec![Shape::Area(vec![from, to - Point::new(0.0, 5.0), to + Point::new(0.0, 5.0)])],
        _ => vec![Shape::Arrow { from, to }],
    }
}

/// Two strokes across an arrow that is too short for its scale.
fn broken(middle: Point, direction: Point) -> impl Iterator<Item = Shape> {
    let stroke = (turned(direction) - direction * 0.5) * 6.0;
    let centres = [-2.5, 2.5].map(|shift| middle + direction * shift);
    centres.into_iter().map(move |centre| Shape::Line(vec![centre - stroke, centre + stroke]))
}

/// The line of a spring.
fn zigzag(from: Point, to: Point) -> Vec<Point> {
    const TURNS: i32 = 12;
    let along = to - from;
    let across = turned(unit(along, Point::x())) * 6.0;
    let mut places = vec![from, from + along * 0.15];
    for turn in 0..TURNS {
        let part = 0.15 + 0.7 * (f64::from(turn) + 0.5) / f64::from(TURNS);
        let side = if turn % 2 == 0 { 1.0 } else { -1.0 };
        places.push(from + along * part + across * side);
    }
    places.extend([from + along * 0.85, to]);
    places
}

/// A part of a circle, angles clockwise from the x axis as one looks at the drawing.
fn arc(centre: Point, radius: f64, from: f64, to: f64) -> Vec<Point> {
    (0..=32)
        .map(|step| {
            let angle = from + (to - from) * f64::from(step) / 32.0;
            centre + Point::new(angle.cos(), angle.sin()) * radius
        })
        .collect()
}
