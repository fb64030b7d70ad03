//! Sliding joints: walls, slots, rods, blocks and pins.

use super::outline::{Local, capsule};
use super::scene::{Class, Point};
use super::stops::{EndStop, reach_along};
use super::{Painter, View};
use slideway::configuration::Configuration;
use slideway::ids::{Frame, JointId};
use slideway::mechanism::{Attachment, JointKind, Mechanism, Shape, Slider, rot90};
use slideway::model::{CarriedBy, SliderKind};

/// Least drawn height of a block or rod.
const LEAST_HEIGHT: f64 = 9.0;
/// Radius of a pin.
pub(super) const PIN: f64 = 5.5;
/// Half the space between a block and its walls where no contact mode is shown.
const NO_PLAY: f64 = 1.0;
/// Thickness of the walls of a slot in a body.
pub(super) const WALL: f64 = 6.0;

/// A sliding joint in drawing units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slide {
    pub(super) kind: SliderKind,
    pub(super) around: bool,
    pub(super) block_frame: Frame,
    pub(super) guide_frame: Frame,
    /// Around the middle of the block, along its axis.
    pub(super) block: Local,
    /// Around the middle of the guide, along its tangent.
    pub(super) guide: Local,
    /// From where to where the block reaches along its axis.
    pub(super) block_reach: [f64; 2],
    /// From where to where the guide reaches along its tangent.
    pub(super) guide_reach: [f64; 2],
    /// Which ends of the guide, rear and front, are open: the block leaves it there.
    pub(super) open: [bool; 2],
    /// What stands at the least and at the greatest displacement.
    pub(super) stops: [Option<EndStop>; 2],
    /// Drawn distance of the rubbing faces.
    pub(super) height: f64,
    /// Play on either side.
    pub(super) gap: f64,
}

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

    /// Half the width of what stands across the guide at its ends.
    pub(super) fn half_end(&self) -> f64 {
        if self.around { 0.5 * self.height + 9.0 } else { self.half_channel() }
    }

    /// The outline of the outer part, with its walls.
    pub(super) fn housing(&self) -> Vec<Point> {
        let (_, local, [from, to]) = self.outer();
        let half = self.half_channel() + WALL;
        let end = |is_open: bool| if is_open || self.around { 0.0 } else { WALL };
        if self.kind == SliderKind::Pin {
            return capsule(local.at(from, 0.0), local.at(to, 0.0), half);
        }
        local.rectangle([from - end(self.open[0]), to + end(self.open[1])], [-half, half])
    }

    /// The free space in the outer part.
    pub(super) fn channel(&self) -> Vec<Point> {
        let (_, local, [from, to]) = self.outer();
        let half = self.half_channel();
        if self.kind == SliderKind::Pin {
            return capsule(local.at(from, 0.0), local.at(to, 0.0), half);
        }
        local.rectangle([from, to], [-half, half])
    }

    /// The inner part.
    pub(super) fn core(&self) -> Vec<Point> {
        let (_, local, reach) = self.inner();
        let half = 0.5 * self.height;
        local.rectangle(reach, [-half, half])
    }
}

/// Play of a sliding joint in drawing units: enough to be seen, and not so much that a block seems to fall
/// over.
pub(super) fn gap(mechanism: &Mechanism, joint: JointId, configuration: &Configuration, view: &View) -> f64 {
    let Some(slider) = mechanism.slider(joint) else { return 0.0 };
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
        joints
            .map(|(index, joint)| match &joint.kind {
                JointKind::Hinge(_) => None,
                JointKind::Slider(slider) => Some(self.slide_of(JointId(index), slider)),
            })
            .collect()
    }

    fn slide_of(&self, joint: JointId, slider: &Slider) -> Slide {
        let [block, guide] = [slider.block, slider.guide].map(|frame| self.local(frame, slider));
        let is_pin = slider.kind == SliderKind::Pin;
        let scale = self.view.scale;
        let half = 0.5 * slider.length * scale;
        let beyond = if is_pin { 32.0 } else { (0.9 * half).clamp(22.0, 44.0) };
        let [least, greatest] = self.view.slides[joint.index()].map(|displacement| displacement * scale);
        let open = [1, 0].map(|end| {
            let contact = slider.contacts.get(end).map(|id| &self.mechanism.contacts[id.index()]);
            contact.is_some_and(|contact| contact.carried_by == CarriedBy::Guide)
        });
        let drawn = half.max(if is_pin { 0.0 } else { 7.0 });
        let reach = |is_open: bool, displacement: f64| {
            if is_open {
                [drawn - displacement + beyond, drawn]
            } else {
                [drawn, drawn + displacement + beyond]
            }
        };
        let rear = reach(open[0], -if open[0] { greatest } else { least });
        let front = reach(open[1], if open[1] { least } else { greatest });
        let height = if is_pin { 2.0 * PIN } else { (slider.height.abs() * scale).max(LEAST_HEIGHT) };
        let full = gap(self.mechanism, joint, self.configuration, self.view);
        let gap = self.play.map_or(NO_PLAY, |part| part * full);
        let mut slide = Slide {
            kind: slider.kind,
            around: slider.around,
            block_frame: slider.block,
            guide_frame: slider.guide,
            block,
            guide,
            block_reach: [-rear[0], front[0]],
            guide_reach: [-rear[1], front[1]],
            open,
            stops: [None; 2],
            height,
            gap,
        };
        if is_pin {
            self.fill_plate(&mut slide);
        }
        slide.stops = self.end_stops(joint, slider, &slide);
        for (end, stop) in slide.guide_reach.iter_mut().zip(slide.stops) {
            *end = stop.map_or(*end, |stop| stop.wall);
        }
        slide
    }

    /// The middle of the block as a place of a frame, with the axes of the guide turned with it.
    fn local(&self, frame: Frame, slider: &Slider) -> Local {
        let middle = Attachment { frame, position: slider.at };
        let tangent = self.configuration.direction(frame, slider.tangent);
        Local {
            origin: self.view.place(self.configuration.position(self.mechanism, &middle)),
            along: self.view.direction(tangent),
            across: self.view.direction(rot90(tangent)),
        }
    }

    /// A slot in a plate reaches from edge to edge of it.
    fn fill_plate(&self, slide: &mut Slide) {
        const INSET: f64 = 20.0;
        let Some(body) = slide.guide_frame.body() else { return };
        let Some(Shape::Rectangle(_)) = self.mechanism.bodies[body.index()].shape else { return };
        let Some(plate) = self.plate(body) else { return };
        if let Some([least, greatest]) = reach_along(&plate, &slide.guide)
            && least + INSET < slide.guide_reach[0] + 32.0
            && greatest - INSET > slide.guide_reach[1] - 32.0
        {
            slide.guide_reach = [least + INSET, greatest - INSET];
        }
    }

    /// Whether the walls of ground lie behind a plate that is higher than the space between them, as if on a
    /// rail.
    fn is_behind_plate(&self, slide: &Slide) -> bool {
        if slide.around || slide.kind == SliderKind::Pin || slide.guide_frame != Frame::Ground {
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
        for slide in self.sliders.clone().into_iter().flatten() {
            if self.is_behind_plate(&slide) {
                let [from, to] = slide.guide_reach;
                let half = slide.half_channel();
                for side in [-half, half] {
                    let ends = vec![slide.guide.at(from, side), slide.guide.at(to, side)];
                    self.line(Class::HiddenWall, ends);
                }
            } else if slide.outer().0 == Frame::Ground {
                self.walls(&slide);
            }
            if slide.inner().0 == Frame::Ground && slide.kind != SliderKind::Pin {
                self.fixed_core(&slide);
            }
        }
    }

    fn walls(&mut self, slide: &Slide) {
        let (_, local, [from, to]) = slide.outer();
        let half = slide.half_channel();
        // n points to the left of u in a world with y upwards, and y points down here: the wall at +n has its
        // outer side to the left of the way along u.
        for (start, end, side) in [(from, to, half), (to, from, -half)] {
            let (start, end) = (local.at(start, side), local.at(end, side));
            self.line(Class::Wall, vec![start, end]);
            self.hatching(start, end);
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
            self.end_wall(&local, from, -reach);
            self.end_wall(&local, to, reach);
        } else {
            let inset = half.min(6.0);
            let mut at = from + inset;
            while at < to {
                self.line(Class::Hatch, vec![local.at(at, -half), local.at((at + 2.0 * half).min(to), half)]);
                at += 8.0;
            }
        }
    }

    /// Pins, above everything that slides.
    pub(super) fn pins(&mut self) {
        for slide in self.sliders.clone().into_iter().flatten() {
            if slide.kind == SliderKind::Pin {
                let class = if slide.block_frame == Frame::Ground { Class::Fixed } else { Class::Pin };
                self.circle(class, slide.block.origin, PIN);
            }
        }
    }
}
