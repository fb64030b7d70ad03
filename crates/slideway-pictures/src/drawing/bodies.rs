//! Bodies, hinges and centres of mass.

use super::Painter;
use super::hidden::Bar;
use super::looks::{self, Look};
use super::outline::{Local, capsule, clipped, disc, edge, hull, nearest_on_line, turned, unit, upper_side};
use super::scene::{Class, Point};
use super::slide::{BAR, SUPPORT, Slide};
use nalgebra::Vector2;
use slideway::ids::{BodyId, Frame, JointId};
use slideway::mechanism::{Attachment, Effort, JointKind, LoadKind, Shape};
use slideway::model::SliderKind;
use std::f64::consts::{FRAC_PI_2, PI};

/// Radius of a hinge.
const HINGE: f64 = 5.0;

impl Painter<'_> {
    /// Plates first, then ground, then blocks and bars, each guide before what slides in it; wedges in front
    /// of all.
    pub(super) fn bodies(&mut self) {
        let count = self.mechanism.bodies.len();
        let mut order: Vec<BodyId> = (0..count).map(BodyId).collect();
        let is_disc =
            |body: &BodyId| matches!(self.mechanism.bodies[body.index()].shape, Some(Shape::Disc(_)));
        order.sort_by_key(|body| !is_disc(body));
        self.walls_behind_plates();
        let (wedges, plates): (Vec<BodyId>, Vec<BodyId>) =
            order.iter().partition(|body| self.is_wedge(**body));
        plates.into_iter().for_each(|body| self.plates(body));
        self.ground_of_slides();
        let depths = self.depths();
        order.sort_by_key(|body| (depths[body.index()], !self.has_block(*body), body.index()));
        let bars: Vec<Bar> = order.into_iter().flat_map(|body| self.links(body)).collect();
        wedges.into_iter().for_each(|body| self.plates(body));
        self.hidden_edges(&bars);
        self.pads();
        self.supports();
        self.centres_of_mass();
    }

    /// The plate of a body with its slots, if it has one.
    fn plates(&mut self, body: BodyId) {
        if let Some(plate) = self.drawn_plate(body) {
            let mut parts = vec![plate];
            parts.extend(self.housings(body));
            self.union(&parts);
            self.channels(body);
        }
    }

    /// Whether a body is drawn as a wedge that only its joints tell.
    fn is_wedge(&self, body: BodyId) -> bool {
        let properties = &self.mechanism.bodies[body.index()];
        properties.shape.is_none() && properties.outline.is_empty() && self.plate(body).is_some()
    }

    /// Whether the outline of a body, or a plate that rests on its face, shows what the block looks like.
    fn shows_block(&self, slide: &Slide, body: BodyId) -> bool {
        if !self.mechanism.bodies[body.index()].outline.is_empty() {
            return true;
        }
        let Look::Face(side) = slide.look else { return false };
        let face = slide.guide.origin - slide.guide.across * (side * slide.half_channel());
        let plate = self.plate(body).unwrap_or_default();
        plate.iter().any(|corner| (corner - face).dot(&slide.guide.across).abs() < 1.0)
    }

    /// Blocks, rods, sleeves and bars of a body; the bars, which something else may hide.
    fn links(&mut self, body: BodyId) -> Vec<Bar> {
        let frame = Frame::Body(body);
        let has_plate = self.plate(body).is_some();
        let mut parts = Vec::new();
        for slide in self.sliders.clone().into_iter().flatten() {
            if slide.inner().0 == frame && slide.kind != SliderKind::Pin && !self.shows_block(&slide, body) {
                parts.push(slide.core());
                parts.extend(slide.collars());
            }
            if slide.outer().0 == frame && slide.around && !self.shows_block(&slide, body) {
                parts.push(slide.housing());
            }
        }
        if !has_plate {
            parts.extend(self.housings(body));
        }
        let other_parts = parts.len();
        parts.extend(self.bars(body).into_iter().map(|bar| self.on_free_side(body, bar)));
        self.union(&parts);
        if !has_plate {
            self.channels(body);
        }
        self.sleeves(body);
        let mechanism = self.mechanism;
        for (joint, slider) in mechanism.sliders().filter(|(_, slider)| slider.block == frame) {
            if let Some(belt) = self.slide(joint).filter(|slide| slide.look == Look::Rollers) {
                self.marks(&belt, slider);
            }
        }
        let before = self.scene.elements.len();
        let bar = |index: usize| {
            let mut others = parts.clone();
            let outline = others.remove(index);
            Bar { outline, others, before }
        };
        (other_parts..parts.len()).map(bar).collect()
    }

    /// One area made of several.
    pub(super) fn union(&mut self, parts: &[Vec<Point>]) {
        for class in [Class::BodyEdge, Class::Body] {
            for part in parts {
                self.area(class, part.clone());
            }
        }
    }

    /// Walls around the slots of a body, and what carries the faces of one that has no plate.
    fn housings(&self, body: BodyId) -> Vec<Vec<Point>> {
        let properties = &self.mechanism.bodies[body.index()];
        if !properties.outline.is_empty() || looks::is_belt(self.mechanism, body) {
            return Vec::new();
        }
        let is_bare = properties.shape.is_none();
        let slides = self.sliders.iter().flatten();
        slides
            .filter(|slide| !slide.around && slide.guide_frame == Frame::Body(body))
            .filter(|slide| slide.has_walls() || (is_bare && matches!(slide.look, Look::Face(_))))
            .map(Slide::housing)
            .collect()
    }

    /// The free space of the slots of a body.
    fn channels(&mut self, body: BodyId) {
        for slide in self.sliders.clone().into_iter().flatten() {
            if slide.around || slide.guide_frame != Frame::Body(body) || !slide.has_walls() {
                continue;
            }
            self.area(Class::Slot, slide.channel());
            let [from, to] = slide.guide_reach;
            for (is_open, end) in [(slide.open[0], from), (slide.open[1], to)] {
                if is_open {
                    let [lower, upper] = [-1.0, 1.0].map(|side| slide.outer_face(end, side));
                    let mouth = slide.guide.rectangle([end - 1.5, end + 1.5], [lower + 0.7, upper - 0.7]);
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
            let rod = slide.guide;
            let shift = (slide.block.origin - rod.origin).dot(&rod.along);
            let reach = slide.block_reach.map(|end| end + shift);
            // It hides the ends of the free space, also where the sleeve is tipped.
            let over = 2.5 + slide.half_channel() * slide.block.along.perp(&rod.along).abs();
            let reach =
                [reach[0].max(slide.guide_reach[0]) - over, reach[1].min(slide.guide_reach[1]) + over];
            let class = if slide.guide_frame == Frame::Ground { Class::Paper } else { Class::Body };
            self.area(class, slide.rod(reach));
            for side in [-1.0, 1.0] {
                self.line(Class::Edge, slide.rod_line(reach, side));
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

    /// The outline of a body, if the model gives one or it is a rectangle, a disc or a wedge.
    pub(super) fn plate(&self, body: BodyId) -> Option<Vec<Point>> {
        let frame = Frame::Body(body);
        if let Some(corners) = looks::corners(self.mechanism, body) {
            let corners = corners.into_iter();
            return Some(corners.map(|position| self.attached(&Attachment::new(frame, position))).collect());
        }
        match self.mechanism.bodies[body.index()].shape? {
            Shape::Disc(radius) => Some(disc(self.centre(body), radius * self.view.scale)),
            Shape::Bar(_) | Shape::Rectangle(_) => None,
        }
    }

    /// The centre of a rectangle and its axes, along its first and its second side.
    fn plate_axes(&self, body: BodyId) -> Local {
        let angle = self.configuration.angle(Frame::Body(body)) + self.mechanism.lean(body);
        let along = self.view.direction(Vector2::new(angle.cos(), angle.sin()));
        Local { origin: self.centre(body), along, across: turned(along) }
    }

    /// The outline of a body as it is drawn: a far end of a rectangle is torn off.
    pub(super) fn drawn_plate(&self, body: BodyId) -> Option<Vec<Point>> {
        let Some(torn) = self.torn_plate(body) else { return self.plate(body) };
        Some(torn.outline())
    }

    /// A rectangle with a torn end.
    fn torn_plate(&self, body: BodyId) -> Option<TornPlate> {
        let (Some(Shape::Rectangle(sides)), Some(cut)) =
            (self.mechanism.bodies[body.index()].shape, self.view.cuts[body.index()])
        else {
            return None;
        };
        let axes = self.plate_axes(body);
        let [width, height] = sides.map(|side| side * self.view.scale);
        let (local, length, half) = if width >= height {
            (axes, width, 0.5 * height)
        } else {
            (Local { along: -axes.across, across: axes.along, ..axes }, height, 0.5 * width)
        };
        let ends = cut.map(|end| end * self.view.scale);
        Some(TornPlate { local, ends, torn: [ends[0] > -0.5 * length, ends[1] < 0.5 * length], half })
    }

    /// The centre of mass of a body in the drawing.
    pub(super) fn centre(&self, body: BodyId) -> Point {
        self.view.place(self.configuration.poses[body.index()].position)
    }

    /// Bars of a body: its shape, or what joins its places.
    fn bars(&self, body: BodyId) -> Vec<Vec<Point>> {
        if !self.mechanism.bodies[body.index()].outline.is_empty() || looks::is_belt(self.mechanism, body) {
            return Vec::new();
        }
        let frame = Frame::Body(body);
        let places = self.places(body);
        match self.mechanism.bodies[body.index()].shape {
            Some(Shape::Bar(ends)) => {
                let ends = ends.map(|position| self.attached(&Attachment::new(frame, position)));
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
            shape => match self.plate(body) {
                Some(plate) => {
                    let outside = places.into_iter().filter(|place| !is_inside(&plate, *place));
                    outside.map(|place| capsule(nearest(&plate, place), place, BAR)).collect()
                }
                None if shape.is_none() => joined(&places, self.has_block(body)),
                None => Vec::new(),
            },
        }
    }

    /// The part of a bar that is not in a face on which its own end stands.
    fn on_free_side(&self, body: BodyId, bar: Vec<Point>) -> Vec<Point> {
        const FAR: f64 = 1e5;
        let stands = |slide: &&Slide| {
            let is_corner = slide.kind == SliderKind::Pin && !slide.is_disc && slide.round.is_none();
            let corner = slide.block.origin;
            let above = (corner - slide.guide.origin).dot(&slide.guide.across) + slide.half_channel();
            let is_near = above < BAR && is_inside(&bar, corner);
            is_corner && slide.look == Look::Face(1.0) && slide.block_frame == Frame::Body(body) && is_near
        };
        let standing: Vec<&Slide> = self.sliders.iter().flatten().filter(stands).collect();
        standing.into_iter().fold(bar, |bar, slide| {
            clipped(&bar, &slide.guide.rectangle([-FAR, FAR], [-slide.half_channel(), FAR]))
        })
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

    /// Places of a body that its bars join: points, hinges, pins, blocks, loads, drives.
    fn places(&self, body: BodyId) -> Vec<Point> {
        let frame = Frame::Body(body);
        let mut places: Vec<Attachment> = Vec::new();
        for joint in &self.mechanism.joints {
            match &joint.kind {
                JointKind::Hinge(ends) => places.extend(ends.iter().filter(|end| end.frame == frame)),
                JointKind::Slider(slider) => {
                    if slider.block == frame || (slider.guide == frame && slider.kind != SliderKind::Pin) {
                        places.push(Attachment::new(frame, slider.at));
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
        let efforts = self.mechanism.drives.iter().filter_map(|drive| match &drive.effort {
            Effort::Force { at, .. } => Some(at),
            Effort::Torque { .. } => None,
        });
        places.extend(efforts.filter(|at| at.frame == frame));
        let properties = &self.mechanism.bodies[body.index()];
        if properties.shape.is_none() {
            places.extend(properties.points.iter().map(|(_, position)| Attachment::new(frame, *position)));
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
                    self.support(place, Point::y());
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
                    let Some(slide) = self.slide(JointId(index)) else { continue };
                    // The arrow of its velocity names it.
                    if self.options.values && self.velocity(JointId(index)).is_some() {
                        continue;
                    }
                    let across = slide.guide.across * upper_side(slide.guide.across);
                    let edge = slide.half_channel() + 8.0;
                    self.name(&joint.name, slide.block.origin + across * edge, across);
                }
            }
        }
    }

    /// The pedestal of a hinge or a roller on ground, which is in a direction from it.
    pub(super) fn support(&mut self, place: Point, away: Point) {
        let foot = away * SUPPORT;
        let along = Point::new(away.y, -away.x);
        let side = along * 10.0;
        self.area(Class::Fixed, vec![place, place + foot + side, place + foot - side]);
        let wide = along * 15.0;
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

/// A rectangle that may be torn off at its ends.
struct TornPlate {
    local: Local,
    ends: [f64; 2],
    torn: [bool; 2],
    half: f64,
}

impl TornPlate {
    fn outline(&self) -> Vec<Point> {
        let mut outline = edge(&self.local, self.ends[0], self.torn[0], self.half);
        outline.reverse();
        outline.extend(edge(&self.local, self.ends[1], self.torn[1], self.half));
        outline
    }
}

/// The place of the edge of a polygon that is nearest to another place.
fn nearest(polygon: &[Point], place: Point) -> Point {
    let next = polygon.iter().cycle().skip(1);
    let sides = polygon.iter().zip(next).map(|(from, to)| nearest_on_line(place, [*from, *to]));
    sides.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(place, |(_, nearest)| nearest)
}

/// Bars along the hull of places, and its inside; a disc for a single place without a block.
fn joined(places: &[Point], has_block: bool) -> Vec<Vec<Point>> {
    let corners = hull(places);
    match corners[..] {
        [] => Vec::new(),
        [_] if has_block => Vec::new(),
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
