//! Bodies, hinges and centres of mass.

use super::Painter;
use super::outline::{Local, capsule, disc, hull, nearest_on_line, turned, unit, upper_side};
use super::scene::{Class, Point};
use nalgebra::Vector2;
use slideway::ids::{BodyId, Frame};
use slideway::mechanism::{Attachment, JointKind, LoadKind, Mechanism, Shape, Slider};
use slideway::model::SliderKind;
use std::f64::consts::{FRAC_PI_2, PI};

/// Half the width of a bar of no particular width.
const BAR: f64 = 5.0;
/// Radius of a hinge.
const HINGE: f64 = 5.0;

impl Painter<'_> {
    /// Plates first, then ground, then blocks and bars, each guide before what slides in it.
    pub(super) fn bodies(&mut self) {
        let count = self.mechanism.bodies.len();
        let mut order: Vec<BodyId> = (0..count).map(BodyId).collect();
        let is_disc =
            |body: &BodyId| matches!(self.mechanism.bodies[body.index()].shape, Some(Shape::Disc(_)));
        order.sort_by_key(|body| !is_disc(body));
        self.walls_behind_plates();
        for body in &order {
            let mut parts: Vec<Vec<Point>> = self.drawn_plate(*body).into_iter().collect();
            if !parts.is_empty() {
                parts.extend(self.housings(*body));
                self.union(&parts);
                self.channels(*body);
            }
        }
        self.ground_of_slides();
        let depths = self.depths();
        order.sort_by_key(|body| (depths[body.index()], !self.has_block(*body), body.index()));
        for body in order {
            self.links(body);
        }
        self.pads();
        self.centres_of_mass();
    }

    /// Blocks, rods, sleeves and bars of a body.
    fn links(&mut self, body: BodyId) {
        let frame = Frame::Body(body);
        let has_plate = self.plate(body).is_some();
        let mut parts = Vec::new();
        for slide in self.sliders.clone().into_iter().flatten() {
            if slide.inner().0 == frame && slide.kind != SliderKind::Pin {
                parts.push(slide.core());
                parts.extend(slide.collars());
            }
            if slide.outer().0 == frame && slide.around {
                parts.push(slide.housing());
            }
        }
        if !has_plate {
            parts.extend(self.housings(body));
        }
        parts.extend(self.bars(body));
        self.union(&parts);
        if !has_plate {
            self.channels(body);
        }
        self.sleeves(body);
    }

    /// One area made of several.
    fn union(&mut self, parts: &[Vec<Point>]) {
        for class in [Class::BodyEdge, Class::Body] {
            for part in parts {
                self.area(class, part.clone());
            }
        }
    }

    /// Walls around the slots of a body.
    fn housings(&self, body: BodyId) -> Vec<Vec<Point>> {
        let slides = self.sliders.iter().flatten();
        slides
            .filter(|slide| !slide.around && slide.guide_frame == Frame::Body(body))
            .map(super::sliders::Slide::housing)
            .collect()
    }

    /// The free space of the slots of a body.
    fn channels(&mut self, body: BodyId) {
        for slide in self.sliders.clone().into_iter().flatten() {
            if slide.around || slide.guide_frame != Frame::Body(body) {
                continue;
            }
            self.area(Class::Slot, slide.channel());
            let half = slide.half_channel();
            let [from, to] = slide.guide_reach;
            for (is_open, end) in [(slide.open[0], from), (slide.open[1], to)] {
                if is_open {
                    let mouth = slide.guide.rectangle([end - 1.5, end + 1.5], [-half + 0.7, half - 0.7]);
                    self.area(Class::Body, mouth.clone());
                    self.area(Class::Slot, mouth);
                }
            }
        }
    }

    /// The free space in sleeves of a body, and the rod in it.
    fn sleeves(&mut self, body: BodyId) {
        for slide in self.sliders.clone().into_iter().flatten() {
            if !slide.around || slide.block_frame != Frame::Body(body) {
                continue;
            }
            self.area(Class::Slot, slide.channel());
            let (rod, half) = (slide.guide, 0.5 * slide.height);
            let shift = (slide.block.origin - rod.origin).dot(&rod.along);
            let reach = slide.block_reach.map(|end| end + shift);
            let reach = [reach[0].max(slide.guide_reach[0]) - 2.5, reach[1].min(slide.guide_reach[1]) + 2.5];
            let class = if slide.guide_frame == Frame::Ground { Class::Paper } else { Class::Body };
            self.area(class, rod.rectangle(reach, [-half, half]));
            for side in [-half, half] {
                self.line(Class::Edge, vec![rod.at(reach[0], side), rod.at(reach[1], side)]);
            }
        }
    }

    /// Number of guides beneath each body.
    fn depths(&self) -> Vec<usize> {
        let mut depths = vec![0; self.mechanism.bodies.len()];
        for _ in 0..depths.len() {
            for slide in self.sliders.iter().flatten().filter(|slide| slide.kind != SliderKind::Pin) {
                if let (Some(block), Some(guide)) = (slide.block_frame.body(), slide.guide_frame.body()) {
                    let least = (depths[guide.index()] + 1).min(self.mechanism.bodies.len());
                    depths[block.index()] = depths[block.index()].max(least);
                }
            }
        }
        depths
    }

    fn has_block(&self, body: BodyId) -> bool {
        let slides = self.sliders.iter().flatten();
        slides
            .into_iter()
            .any(|slide| slide.kind != SliderKind::Pin && slide.block_frame == Frame::Body(body))
    }

    /// The outline of a rectangle or disc.
    pub(super) fn plate(&self, body: BodyId) -> Option<Vec<Point>> {
        let centre = self.centre(body);
        let scale = self.view.scale;
        match self.mechanism.bodies[body.index()].shape? {
            Shape::Bar(_) => None,
            Shape::Disc(radius) => Some(disc(centre, radius * scale)),
            Shape::Rectangle(sides) => {
                let half = sides.map(|side| 0.5 * side * scale);
                Some(self.plate_axes(body).rectangle([-half[0], half[0]], [-half[1], half[1]]))
            }
        }
    }

    /// The centre of a rectangle and its axes, along its first and its second side.
    fn plate_axes(&self, body: BodyId) -> Local {
        let angle = self.configuration.angle(Frame::Body(body)) + lean(self.mechanism, body);
        let along = self.view.direction(Vector2::new(angle.cos(), angle.sin()));
        Local { origin: self.centre(body), along, across: turned(along) }
    }

    /// The outline of a rectangle or disc as it is drawn: a far end of a rectangle is torn off.
    fn drawn_plate(&self, body: BodyId) -> Option<Vec<Point>> {
        let (Some(Shape::Rectangle(sides)), Some(cut)) =
            (self.mechanism.bodies[body.index()].shape, self.view.cuts[body.index()])
        else {
            return self.plate(body);
        };
        let axes = self.plate_axes(body);
        let [width, height] = sides.map(|side| side * self.view.scale);
        let (local, length, half) = if width >= height {
            (axes, width, 0.5 * height)
        } else {
            (Local { along: -axes.across, across: axes.along, ..axes }, height, 0.5 * width)
        };
        let [from, to] = cut.map(|end| end * self.view.scale);
        let mut outline = edge(&local, from, from > -0.5 * length, half);
        outline.reverse();
        outline.extend(edge(&local, to, to < 0.5 * length, half));
        Some(outline)
    }

    /// The centre of mass of a body in the drawing.
    pub(super) fn centre(&self, body: BodyId) -> Point {
        self.view.place(self.configuration.poses[body.index()].position)
    }

    /// Bars of a body: its shape, or what joins its places.
    fn bars(&self, body: BodyId) -> Vec<Vec<Point>> {
        let frame = Frame::Body(body);
        let places = self.places(body);
        match self.mechanism.bodies[body.index()].shape {
            Some(Shape::Bar(ends)) => {
                let ends = ends.map(|position| self.attached(&Attachment { frame, position }));
                let half = self.half_width(body, ends);
                let mut bars = vec![capsule(ends[0], ends[1], half)];
                for place in places {
                    let (distance, nearest) = nearest_on_line(place, ends);
                    if distance > half {
                        bars.push(capsule(nearest, place, BAR));
                    }
                }
                bars
            }
            Some(_) => {
                let (plate, centre) = (self.plate(body).unwrap_or_default(), self.centre(body));
                let outside = places.into_iter().filter(|place| !is_inside(&plate, *place));
                outside.map(|place| capsule(centre, place, BAR)).collect()
            }
            None => joined(&places, self.has_block(body)),
        }
    }

    /// Half the width of a bar: that of its guide if it slides along itself.
    fn half_width(&self, body: BodyId, ends: [Point; 2]) -> f64 {
        let axis = unit(ends[1] - ends[0], Point::x());
        let slides = self.sliders.iter().flatten();
        let widths = slides.filter(|slide| {
            let (frame, local, _) = slide.inner();
            slide.kind != SliderKind::Pin
                && frame == Frame::Body(body)
                && local.along.perp(&axis).abs() < 1e-3
                && (ends[0] - local.origin).perp(&axis).abs() < 1.0
        });
        widths.map(|slide| 0.5 * slide.height).reduce(f64::min).unwrap_or(BAR)
    }

    /// Places of a body that its bars join: points, hinges, pins, blocks, loads.
    fn places(&self, body: BodyId) -> Vec<Point> {
        let frame = Frame::Body(body);
        let mut places: Vec<Attachment> = Vec::new();
        for joint in &self.mechanism.joints {
            match &joint.kind {
                JointKind::Hinge(ends) => places.extend(ends.iter().filter(|end| end.frame == frame)),
                JointKind::Slider(slider) => {
                    if slider.block == frame || (slider.guide == frame && slider.kind != SliderKind::Pin) {
                        places.push(Attachment { frame, position: slider.at });
                    }
                }
            }
        }
        for load in &self.mechanism.loads {
            match &load.kind {
                LoadKind::Force { at, .. } if at.frame == frame => places.push(*at),
                LoadKind::Spring { between, .. } | LoadKind::Damper { between, .. } => {
                    places.extend(between.iter().filter(|end| end.frame == frame));
                }
                _ => {}
            }
        }
        let properties = &self.mechanism.bodies[body.index()];
        if properties.shape.is_none() {
            places.extend(
                properties.points.iter().map(|(_, position)| Attachment { frame, position: *position }),
            );
        }
        places.iter().map(|place| self.attached(place)).collect()
    }

    /// Where an attached point is in the drawing.
    pub(super) fn attached(&self, point: &Attachment) -> Point {
        self.view.place(self.configuration.position(self.mechanism, point))
    }

    /// Hinges, pins and the names of all joints.
    pub(super) fn joints(&mut self) {
        self.pins();
        let mechanism = self.mechanism;
        for joint in &mechanism.joints {
            if let JointKind::Hinge(ends) = &joint.kind {
                let place = self.attached(&ends[0]);
                if ends.iter().any(|end| end.frame == Frame::Ground) {
                    self.support(place);
                }
                self.circle(Class::Hinge, place, HINGE);
            }
        }
        for (index, joint) in mechanism.joints.iter().enumerate() {
            match &joint.kind {
                JointKind::Hinge(ends) => {
                    let place = self.attached(&ends[0]);
                    self.name(&joint.name, place, unit(Point::new(-1.0, -1.0), Point::x()));
                }
                JointKind::Slider(_) => {
                    let Some(slide) = self.sliders[index] else { continue };
                    let across = slide.guide.across * upper_side(slide.guide.across);
                    let edge = slide.half_channel() + 8.0;
                    self.name(&joint.name, slide.block.origin + across * edge, across);
                }
            }
        }
    }

    /// A hinge's pedestal on ground.
    fn support(&mut self, place: Point) {
        let foot = Point::new(0.0, 17.0);
        let side = Point::new(10.0, 0.0);
        self.area(Class::Fixed, vec![place, place + foot + side, place + foot - side]);
        let wide = Point::new(15.0, 0.0);
        self.line(Class::Wall, vec![place + foot - wide, place + foot + wide]);
        self.hatching(place + foot + wide, place + foot - wide);
    }

    /// Circles with two dark quarters.
    fn centres_of_mass(&mut self) {
        const RADIUS: f64 = 5.5;
        let bodies = self.mechanism.bodies.iter().enumerate();
        let centres: Vec<Point> =
            bodies.filter(|(_, body)| body.mass > 0.0).map(|(index, _)| self.centre(BodyId(index))).collect();
        for centre in centres {
            self.circle(Class::MassRing, centre, RADIUS);
            for start in [0.0, PI] {
                let arc = (0..=6).map(|step| {
                    let angle = start + FRAC_PI_2 * f64::from(step) / 6.0;
                    centre + Point::new(angle.cos(), angle.sin()) * RADIUS
                });
                let quarter = std::iter::once(centre).chain(arc).collect();
                self.area(Class::Mass, quarter);
            }
        }
    }
}

/// By how much (rad) a rectangle is turned in the drawing: it lies along the guide of its body, as the moment
/// of inertia leaves that open.
pub(super) fn lean(mechanism: &Mechanism, body: BodyId) -> f64 {
    let of_body = |slider: &&Slider| slider.block == Frame::Body(body) && slider.kind != SliderKind::Pin;
    let sliders = mechanism.joints.iter().filter_map(|joint| match &joint.kind {
        JointKind::Slider(slider) => Some(slider),
        JointKind::Hinge(_) => None,
    });
    let tangent = sliders.into_iter().find(of_body).map_or(Vector2::x(), |slider| slider.tangent);
    let angle = tangent.y.atan2(tangent.x);
    angle - FRAC_PI_2 * (angle / FRAC_PI_2).round()
}

/// An end of a plate across `local`, from one side to the other; a zigzag where the plate is torn off.
fn edge(local: &Local, along: f64, is_torn: bool, half: f64) -> Vec<Point> {
    const TOOTH: f64 = 9.0;
    const DEPTH: f64 = 4.0;
    if !is_torn {
        return vec![local.at(along, -half), local.at(along, half)];
    }
    let count = (2.0 * half / TOOTH).ceil().clamp(3.0, 200.0);
    let mut corners = vec![local.at(along, -half)];
    let (mut tooth, mut side) = (0.5, DEPTH);
    while tooth < count {
        corners.push(local.at(along + side, half * (2.0 * tooth / count - 1.0)));
        (tooth, side) = (tooth + 1.0, -side);
    }
    corners.push(local.at(along, half));
    corners
}

/// Bars along the hull of places, and its inside; a disc for a single place without a block.
fn joined(places: &[Point], has_block: bool) -> Vec<Vec<Point>> {
    let corners = hull(places);
    match corners[..] {
        [] => Vec::new(),
        [only] if has_block => vec![disc(only, BAR)],
        [only] => vec![disc(only, 2.0 * BAR)],
        [from, to] => vec![capsule(from, to, BAR)],
        _ => {
            let next = corners.iter().cycle().skip(1);
            let mut parts: Vec<Vec<Point>> =
                corners.iter().zip(next).map(|(from, to)| capsule(*from, *to, BAR)).collect();
            parts.push(corners);
            parts
        }
    }
}

/// Whether a place lies in a convex polygon, or close to it.
fn is_inside(polygon: &[Point], place: Point) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let sides = polygon.iter().zip(next).map(|(from, to)| unit(to - from, Point::x()).perp(&(place - from)));
    let (mut least, mut greatest) = (0.0_f64, 0.0_f64);
    for side in sides {
        least = least.min(side);
        greatest = greatest.max(side);
    }
    least > -1.0 || greatest < 1.0
}
