//! Sliding joints: walls, slots, rods, blocks and pins.

use super::looks::{Look, corners, on_rail_of};
use super::outline::{Local, capsule, edge, reach_along, turned, upper_side};
use super::scene::{Class, Point};
use super::slide::{PIN, RoundFace, SUPPORT, Slide, Station, WALL};
use super::{Painter, View};
use slideway::configuration::Configuration;
use slideway::ids::{ContactId, Frame, JointId};
use slideway::mechanism::{Attachment, JointKind, Mechanism, Shape, Slider, rot90};
use slideway::model::{CarriedBy, SliderKind};

/// Least drawn height of a block or rod.
const LEAST_HEIGHT: f64 = 9.0;
/// Half the space between a block and its walls where no contact mode is shown.
const NO_PLAY: f64 = 1.0;
/// Height of a block that is a body of its own on a face, in lengths, and the greatest.
const NUT: f64 = 0.3;
const HIGHEST_NUT: f64 = 60.0;
/// Half the length of a shoe, and the radius of the foot on a flank.
const SHOE: f64 = 12.0;
const FOOT: f64 = 8.0;
/// Radius of the rollers of a belt, and the distance of the lines across it that show how it moves.
const ROLLER: f64 = 9.0;
const MARK: f64 = 30.0;

impl Slide {
    /// The part that surrounds the other: its frame, where it lies and how far it reaches.
    pub(super) fn outer(&self) -> (Frame, Local, [f64; 2]) {
        if self.around {
            (self.block_frame, self.block, self.block_reach)
        } else {
            (self.guide_frame, self.guide, self.guide_reach)
        }
    }

    /// The part that lies in the other.
    pub(super) fn inner(&self) -> (Frame, Local, [f64; 2]) {
        if self.around {
            (self.guide_frame, self.guide, self.guide_reach)
        } else {
            (self.block_frame, self.block, self.block_reach)
        }
    }

    /// Half the width of the free space in the outer part.
    pub(super) fn half_channel(&self) -> f64 {
        0.5 * self.height + self.gap
    }

    /// How far what stands below the outer part reaches from it: the rollers of a belt with their supports.
    pub(super) fn half_foot(&self) -> f64 {
        let rollers = if self.look == Look::Rollers { ROLLER + SUPPORT } else { 0.0 };
        self.half_channel() + rollers
    }

    /// Half the width of what stands across the guide at its ends.
    pub(super) fn half_end(&self) -> f64 {
        if self.around { 0.5 * self.height + 9.0 } else { self.half_channel() }
    }

    /// The outline of the outer part, with its walls.
    pub(super) fn housing(&self) -> Vec<Point> {
        let (_, local, [from, to]) = self.outer();
        if let Some(round) = &self.round {
            return round.line();
        }
        let end = |is_open: bool| if is_open || self.around { 0.0 } else { WALL };
        match self.look {
            Look::Face(side) => {
                let face = -side * self.half_channel();
                local.rectangle([from, to], [face, face - side * WALL])
            }
            _ if self.kind == SliderKind::Pin => self.slot([from, to], WALL),
            _ => self.between_faces([from - end(self.open[0]), to + end(self.open[1])], WALL),
        }
    }

    /// The free space in the outer part.
    pub(super) fn channel(&self) -> Vec<Point> {
        let (_, _, reach) = self.outer();
        if self.kind == SliderKind::Pin { self.slot(reach, 0.0) } else { self.between_faces(reach, 0.0) }
    }

    /// The slot of a pin, or `beyond` further out: with round ends, unless its faces bend.
    fn slot(&self, reach: [f64; 2], beyond: f64) -> Vec<Point> {
        if self.stations.len() > 1 {
            return self.between_faces(reach, beyond);
        }
        let [lower, upper] = [-1.0, 1.0].map(|side| self.outer_face(0.0, side));
        let [from, to] = reach.map(|end| self.guide.at(end, 0.5 * (lower + upper)));
        capsule(from, to, 0.5 * (upper - lower) + beyond)
    }

    /// The inner part.
    pub(super) fn core(&self) -> Vec<Point> {
        let (_, local, [from, to]) = self.inner();
        if self.around && !self.stations.is_empty() {
            return self.rod([from, to]);
        }
        let half = 0.5 * self.height;
        let torn = self.torn.map(|is_torn| is_torn && !self.around);
        let mut outline = edge(&local, from, torn[0], half);
        outline.reverse();
        outline.extend(edge(&local, to, torn[1], half));
        outline
    }

    /// The face of ground on which the block rests, if there is one.
    fn floor(&self) -> Option<[Point; 2]> {
        let Look::Face(side) = self.look else { return None };
        if self.round.is_some() {
            return None;
        }
        let across = -side * self.half_channel();
        (self.guide_frame == Frame::Ground).then(|| self.guide_reach.map(|end| self.guide.at(end, across)))
    }

    /// Guides of ground do not run on through its faces: what is spare of them beyond the block ends there.
    fn end_at(&mut self, floors: &[[Point; 2]]) {
        if self.guide_frame != Frame::Ground || !self.has_walls() {
            return;
        }
        let shift = (self.block.origin - self.guide.origin).dot(&self.guide.along);
        for [from, to] in floors {
            let (normal, way) = (turned(to - from), to - from);
            let slope = self.guide.along.dot(&normal);
            let at = (from - self.guide.origin).dot(&normal) / slope;
            let on_floor = (self.guide.at(at, 0.0) - from).dot(&way) / way.norm_squared();
            if !at.is_finite() || !(0.0..=1.0).contains(&on_floor) {
                continue;
            }
            let [rear, front] = self.block_reach.map(|end| end + shift);
            if at <= rear {
                self.guide_reach[0] = self.guide_reach[0].max(at);
            } else if at >= front {
                self.guide_reach[1] = self.guide_reach[1].min(at);
            }
        }
    }

    /// Whether the guide has walls that are drawn with this joint.
    pub(super) fn has_walls(&self) -> bool {
        matches!(self.look, Look::Walls | Look::Shoe { is_first: true })
    }
}

/// Play of a sliding joint in drawing units: enough to be seen, and not so much that a block seems to fall
/// over.
pub(super) fn gap(
    mechanism: &Mechanism,
    (joint, look): (JointId, Look),
    configuration: &Configuration,
    view: &View,
) -> f64 {
    let Some(slider) = mechanism.slider(joint).filter(|_| look.has_play()) else { return 0.0 };
    match slider.kind {
        SliderKind::Pin => 4.5,
        SliderKind::Guided => 5.0,
        SliderKind::Block => {
            let overlap = configuration.overlap(mechanism, slider).unwrap_or(slider.length) * view.scale;
            (0.075 * overlap).clamp(2.5, 8.0)
        }
    }
}

impl Painter<'_> {
    /// All sliding joints, by the index of their joint.
    pub(super) fn slides(&self) -> Vec<Option<Slide>> {
        let joints = self.mechanism.joints.iter().enumerate();
        let mut slides: Vec<Option<Slide>> = joints
            .map(|(index, joint)| match &joint.kind {
                JointKind::Hinge(_) => None,
                // It is seen at the joint that has its face, too.
                JointKind::Slider(_) if self.mechanism.is_apart_from_shared_face(JointId(index)) => None,
                JointKind::Slider(slider) => Some(self.slide_of(JointId(index), slider)),
            })
            .collect();
        for index in 0..slides.len() {
            if let Some(reach) = self.rail(JointId(index), &slides)
                && let Some(slide) = &mut slides[index]
            {
                slide.guide_reach = reach;
            }
        }
        self.join_rails(&mut slides);
        let floors: Vec<[Point; 2]> = slides.iter().flatten().filter_map(Slide::floor).collect();
        slides.iter_mut().flatten().for_each(|slide| slide.end_at(&floors));
        slides
    }

    /// From where to where the rail of a first shoe reaches: as far as the guides of all its shoes.
    fn rail(&self, joint: JointId, slides: &[Option<Slide>]) -> Option<[f64; 2]> {
        let first =
            slides[joint.index()].as_ref().filter(|slide| slide.look == Look::Shoe { is_first: true })?;
        let on_rail = on_rail_of(self.mechanism, joint);
        let all = on_rail.iter().filter_map(|id| slides[id.index()].as_ref());
        let ends = all.flat_map(|slide| slide.guide_reach.map(|end| slide.guide.at(end, 0.0)));
        ends.map(|end| [(end - first.guide.origin).dot(&first.guide.along); 2])
            .reduce(|[least, greatest], [other, _]| [least.min(other), greatest.max(other)])
    }

    /// The rail that is drawn with its first shoe bends at all of them.
    fn join_rails(&self, slides: &mut [Option<Slide>]) {
        for index in 0..slides.len() {
            let Some(first) = slides[index].as_ref() else { continue };
            if first.look != (Look::Shoe { is_first: true }) {
                continue;
            }
            let on_rail = on_rail_of(self.mechanism, JointId(index));
            let all = on_rail.iter().filter_map(|id| slides[id.index()].as_ref());
            let mut stations: Vec<Station> = all
                .flat_map(|slide| {
                    let shift = (slide.guide.origin - first.guide.origin).dot(&first.guide.along);
                    slide.stations.iter().map(move |at| Station { along: at.along + shift, ..*at })
                })
                .collect();
            stations.sort_by(|one, other| one.along.total_cmp(&other.along));
            if let Some(first) = &mut slides[index] {
                first.stations = stations;
            }
        }
    }

    fn slide_of(&self, joint: JointId, slider: &Slider) -> Slide {
        let look = self.looks[joint.index()];
        let height = self.drawn_height(slider, look);
        let is_disc = slider.is_disc();
        // The middle of a block is on its face, that of a disc above it.
        let lift = if let (Look::Face(side), false) = (look, is_disc) { 0.5 * side * height } else { 0.0 };
        let of_all = slider.contacts.first().map(|contact| &self.mechanism.contacts[contact.index()]);
        let drawn_gap = slider.apart.first().or(of_all).map_or(0.0, |contact| contact.gap * self.view.scale);
        let [block, guide] = [(slider.block, lift), (slider.guide, lift - drawn_gap)]
            .map(|(frame, lift)| self.local(frame, slider, lift));
        let is_belt = look == Look::Rollers;
        // What is seen of a belt stays where its rollers are.
        let block = if is_belt { guide } else { block };
        let is_pin = slider.kind == SliderKind::Pin;
        let scale = self.view.scale;
        let half = self.half_length(slider);
        let beyond = if is_pin { 32.0 } else { (0.9 * half).clamp(22.0, 44.0) };
        let [least, greatest] = if is_belt {
            [0.0; 2]
        } else {
            self.view.slides[joint.index()].map(|displacement| displacement * scale)
        };
        let open = [1, 0].map(|end| {
            let contact = slider.contacts.get(end).map(|id| &self.mechanism.contacts[id.index()]);
            contact.is_some_and(|contact| contact.carried_by == CarriedBy::Guide)
        });
        let drawn = half.max(if is_pin { 0.0 } else { 7.0 });
        let own = self.own_ends(slider.block, &block);
        // At an open end, where the block leaves the guide, and where it ends itself if that is known.
        let reach = |end: usize, displacement: f64| {
            let mouth = drawn - displacement;
            match own.map(|own| own[end]) {
                _ if !open[end] => [drawn, drawn + displacement + beyond],
                Some(own) if own > 0.0 => [own.max(mouth), drawn],
                _ => [mouth + beyond, drawn],
            }
        };
        let rear = reach(0, -if open[0] { greatest } else { least });
        let front = reach(1, if open[1] { least } else { greatest });
        let full = gap(self.mechanism, (joint, look), self.configuration, self.view);
        let stations = if look.has_play() { self.stations(slider, &guide) } else { Vec::new() };
        let own_gap = stations.iter().map(|at| at.clearance + at.yielding.abs() + at.offset.abs());
        let gap = own_gap.reduce(f64::max).unwrap_or_else(|| self.play.map_or(NO_PLAY, |part| part * full));
        let mut slide = Slide {
            kind: slider.kind,
            look,
            around: slider.around,
            block_frame: slider.block,
            guide_frame: slider.guide,
            block,
            guide,
            block_reach: [-rear[0], front[0]],
            guide_reach: [-rear[1], front[1]],
            open,
            torn: [0, 1].map(|end| open[end] && own.is_none_or(|own| own[end] <= 0.0)),
            stops: [None; 2],
            height,
            is_disc,
            round: slider.round.map(|round| RoundFace {
                centre: self.attached(&slider.centre_of(&round)),
                radius: round.radius * scale,
                inside: round.inside,
            }),
            gap: if look.has_play() { gap } else { 0.0 },
            stations,
        };
        self.within_plate(&mut slide);
        slide.stops = self.end_stops(joint, slider, &slide);
        for (end, stop) in slide.guide_reach.iter_mut().zip(slide.stops) {
            *end = stop.map_or(*end, |stop| stop.wall);
        }
        slide
    }

    /// Half the length of a block, which reaches over all its supports.
    fn half_length(&self, slider: &Slider) -> f64 {
        let of_block = |id: &&ContactId| self.mechanism.contacts[id.index()].carried_by == CarriedBy::Block;
        let supports = slider.contacts.iter().skip(2).filter(of_block);
        let beyond = supports.map(|id| self.mechanism.contacts[id.index()].offset.abs());
        self.view.scale * beyond.fold(0.5 * slider.length, f64::max)
    }

    fn drawn_height(&self, slider: &Slider, look: Look) -> f64 {
        let scale = self.view.scale;
        let is_nut = |body| corners(self.mechanism, body).is_none();
        match look {
            Look::Flank(_) => 0.0,
            _ if slider.is_disc() => slider.height * scale,
            Look::Face(_) if slider.block.body().is_some_and(is_nut) => {
                (NUT * slider.length * scale).clamp(LEAST_HEIGHT, HIGHEST_NUT)
            }
            _ if slider.kind == SliderKind::Pin => 2.0 * PIN,
            _ => (slider.height.abs() * scale).max(LEAST_HEIGHT),
        }
    }

    /// How far a body reaches to the rear and to the front of the middle of its block, if the model says it.
    fn own_ends(&self, frame: Frame, block: &Local) -> Option<[f64; 2]> {
        let body = frame.body()?;
        if let Some([least, greatest]) = self.drawn_plate(body).and_then(|plate| reach_along(&plate, block)) {
            return Some([-least, greatest]);
        }
        let Some(Shape::Bar(ends)) = self.mechanism.bodies[body.index()].shape else { return None };
        let along = ends.map(|position| {
            (self.attached(&Attachment::new(frame, position)) - block.origin).dot(&block.along)
        });
        Some([-along[0].min(along[1]), along[0].max(along[1])])
    }

    /// The middle of the block as a place of a frame, moved by `lift` across the guide, with the axes of the
    /// guide turned with it.
    fn local(&self, frame: Frame, slider: &Slider, lift: f64) -> Local {
        // A round guide is where its block is.
        let of_block = if slider.round.is_some() { slider.block } else { frame };
        let middle = Attachment::new(of_block, slider.at);
        let tangent = match slider.round {
            Some(_) => self.configuration.slide(self.mechanism, slider).tangent,
            None => self.configuration.direction(frame, slider.tangent),
        };
        let across = self.view.direction(rot90(tangent));
        let middle = self.view.place(self.configuration.position(self.mechanism, &middle));
        Local { origin: middle + across * lift, along: self.view.direction(tangent), across }
    }

    /// A slot in a plate reaches from edge to edge of it, and none reaches beyond an outline.
    fn within_plate(&self, slide: &mut Slide) {
        const INSET: f64 = 20.0;
        let Some(body) = slide.guide_frame.body().filter(|_| !slide.around) else { return };
        let Some([least, greatest]) = self.plate(body).and_then(|plate| reach_along(&plate, &slide.guide))
        else {
            return;
        };
        let [from, to] = slide.guide_reach;
        if slide.kind == SliderKind::Pin && least + INSET < from + 32.0 && greatest - INSET > to - 32.0 {
            slide.guide_reach = [least + INSET, greatest - INSET];
        } else if !self.mechanism.bodies[body.index()].outline.is_empty() {
            slide.guide_reach = [from.max(least), to.min(greatest)];
        }
    }

    /// Whether the walls of ground lie behind a plate that is higher than the space between them, as if on a
    /// rail.
    fn is_behind_plate(&self, slide: &Slide) -> bool {
        let is_pin = slide.kind == SliderKind::Pin;
        if slide.around || is_pin || slide.guide_frame != Frame::Ground || !slide.has_walls() {
            return false;
        }
        let plate = slide.block_frame.body().and_then(|body| self.plate(body));
        plate.is_some_and(|plate| {
            let across = |corner: &Point| (corner - slide.guide.origin).dot(&slide.guide.across);
            let beyond =
                |side: f64| plate.iter().any(|corner| side * across(corner) > slide.half_channel() + 1.0);
            beyond(1.0) && beyond(-1.0)
        })
    }

    /// Walls that plates cover in part.
    pub(super) fn walls_behind_plates(&mut self) {
        for slide in self.sliders.clone().into_iter().flatten() {
            if self.is_behind_plate(&slide) {
                self.walls(&slide);
            }
        }
    }

    /// Walls and rods that belong to ground; walls behind a plate are dashed where it hides them.
    pub(super) fn ground_of_slides(&mut self) {
        let mechanism = self.mechanism;
        for (joint, slider) in mechanism.sliders() {
            let Some(slide) = self.slide(joint) else { continue };
            if self.is_behind_plate(&slide) {
                for side in [-1.0, 1.0] {
                    self.line(Class::HiddenWall, slide.face_line(slide.guide_reach, side, 0.0));
                }
            } else if slide.look == Look::Rollers {
                self.rollers(&slide, &slider.contacts);
            } else if slide.outer().0 == Frame::Ground
                && (slide.has_walls() || matches!(slide.look, Look::Face(_)))
            {
                self.walls(&slide);
            }
            if slide.inner().0 == Frame::Ground && slide.kind != SliderKind::Pin {
                self.fixed_core(&slide);
            }
        }
    }

    fn walls(&mut self, slide: &Slide) {
        let (_, _, reach) = slide.outer();
        if let Some(round) = &slide.round {
            let line = round.line();
            self.line(Class::Wall, line.clone());
            line.windows(2).for_each(|piece| self.hatching(piece[0], piece[1]));
            return;
        }
        // n points to the left of u in a world with y upwards, and y points down here: the wall at +n has its
        // outer side to the left of the way along u.
        let block_side = if let Look::Face(side) = slide.look { side } else { 0.0 };
        for side in [1.0, -1.0].into_iter().filter(|side| side * block_side <= 0.0) {
            let mut wall = slide.face_line(reach, side, 0.0);
            if side < 0.0 {
                wall.reverse();
            }
            self.line(Class::Wall, wall.clone());
            for piece in wall.windows(2) {
                self.hatching(piece[0], piece[1]);
            }
        }
        for (side, stop) in [-1.0, 1.0].into_iter().zip(slide.stops) {
            if let Some(stop) = stop {
                self.end_wall(&slide.guide, stop.wall, side * stop.half);
            }
        }
    }

    fn fixed_core(&mut self, slide: &Slide) {
        let (_, local, [from, to]) = slide.inner();
        let half = 0.5 * slide.height;
        self.area(Class::Fixed, slide.core());
        if slide.around {
            let reach = slide.half_end();
            self.end_wall(&slide.guide_end(from), from, -reach);
            self.end_wall(&slide.guide_end(to), to, reach);
        } else {
            let inset = half.min(6.0);
            let mut at = from + inset;
            while at < to {
                self.line(Class::Hatch, vec![local.at(at, -half), local.at((at + 2.0 * half).min(to), half)]);
                at += 8.0;
            }
        }
    }

    /// The rollers of a belt at its contacts with ground: on the side on which they press, below where none is known.
    fn rollers(&mut self, slide: &Slide, contacts: &[ContactId]) {
        for contact in contacts {
            let place = self.view.place(self.configuration.contact(self.mechanism, *contact).point);
            let away = slide.guide.across
                * match self.states.side(contact.index()) {
                    0.0 => -upper_side(slide.guide.across),
                    side => -side.signum(),
                };
            let centre = place + away * (0.5 * slide.height + ROLLER);
            self.support(centre, away);
            self.circle(Class::Fixed, centre, ROLLER);
            self.circle(Class::Hinge, centre, 0.4 * ROLLER);
        }
    }

    /// Lines across a belt, which move with it.
    pub(super) fn marks(&mut self, slide: &Slide, slider: &Slider) {
        let half = 0.5 * slide.height;
        let moved = self.local(slider.block, slider, 0.0).origin - slide.guide.origin;
        let [from, to] = slide.block_reach;
        let mut at = from + (moved.dot(&slide.guide.along) - from).rem_euclid(MARK);
        while at < to {
            self.line(Class::Edge, vec![slide.guide.at(at, -half), slide.guide.at(at, half)]);
            at += MARK;
        }
    }

    /// Pins, shoes and feet, above everything that slides.
    pub(super) fn pins(&mut self) {
        for slide in self.sliders.clone().into_iter().flatten() {
            let place = slide.block.origin;
            match slide.look {
                Look::Flank(side) => self.area(Class::Pin, foot(place, slide.guide.across * side)),
                Look::Shoe { .. } => {
                    let shoe = Local { origin: place, ..slide.guide };
                    self.area(Class::Pin, shoe.rectangle([-SHOE, SHOE], [-PIN, PIN]));
                    self.circle(Class::Hinge, place, 0.5 * PIN);
                }
                _ if slide.is_disc => self.circle(Class::Edge, place, 0.5 * slide.height),
                _ if slide.kind == SliderKind::Pin => {
                    let class = if slide.block_frame == Frame::Ground { Class::Fixed } else { Class::Pin };
                    self.circle(class, place, PIN);
                }
                _ => {}
            }
        }
    }
}

/// Half a disc that stands on a flank, in the direction away from that.
fn foot(place: Point, away: Point) -> Vec<Point> {
    const CORNERS: i32 = 12;
    let along = turned(away);
    let corner = |index: i32| {
        let (sin, cos) = (std::f64::consts::PI * f64::from(index) / f64::from(CORNERS)).sin_cos();
        place + (along * cos + away * sin) * FOOT
    };
    (0..=CORNERS).map(corner).collect()
}
