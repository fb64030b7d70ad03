//! Stops and pads at the ends of travels.
//!
//! A stop stands where the block's outer end, or that of its plate, is when it reaches the end of its travel:
//! there the guide ends. A pad, cross-hatched as rubber is in sections, begins there and leans on the end of
//! the guide. What no picture can know is left out: the model does not say which faces meet where the block
//! leaves its guide, or where the end of a plate is torn off; and an end of travel far outside the picture is
//! none of it.

use super::Painter;
use super::outline::{Local, reach_along};
use super::scene::{Class, Point};
use super::slide::{EndStop, PIN, Slide, WALL};
use slideway::ids::{Frame, JointId};
use slideway::mechanism::Slider;
use slideway::model::SliderKind;

/// Least drawn thickness of a pad, and of one that is compressed.
const PAD: f64 = 20.0;
const LEAST_PAD: f64 = 12.0;
/// Half the least width of what meets a plate.
const BEFORE_PLATE: f64 = 14.0;

/// The end of a block.
#[derive(Debug, Clone, Copy)]
struct BlockEnd {
    /// How far it is from the middle of the block.
    distance: f64,
    is_plate: bool,
}

impl Slide {
    /// Collars at the ends of a rod that have a stop.
    pub(super) fn collars(&self) -> Vec<Vec<Point>> {
        let stops = [-WALL, WALL].into_iter().zip(self.stops).filter(|_| self.around);
        stops
            .filter_map(|(thickness, stop)| {
                let EndStop { wall, half, .. } = stop?;
                Some(self.guide.rectangle([wall, wall + thickness], [-half, half]))
            })
            .collect()
    }
}

impl Painter<'_> {
    /// The stops at the least and at the greatest displacement of a sliding joint, as far as their places are
    /// known.
    pub(super) fn end_stops(&self, joint: JointId, slider: &Slider, slide: &Slide) -> [Option<EndStop>; 2] {
        let shown = self.view.slides[joint.index()];
        [0, 1].map(|end| {
            let (stop, travel) = (slider.stops[end]?, slider.travel?[end]);
            if !(shown[0]..=shown[1]).contains(&travel) {
                return None;
            }
            let sense = [-1.0, 1.0][end];
            let block = self.block_end(slide, end)?;
            let met_at = |displacement: f64| sense * displacement * self.view.scale + block.distance;
            let met = met_at(travel);
            let at =
                sense * (slide.block.origin - slide.guide.origin).dot(&slide.guide.along) + block.distance;
            let [face, wall] = match stop.pad() {
                None => [met, met],
                Some(_) => [met.max(at), (met + PAD).max(met_at(shown[end]) + LEAST_PAD)],
            };
            let half = slide.half_end();
            let is_wide = block.is_plate && slide.guide_frame == Frame::Ground;
            let half = if is_wide { half.max(BEFORE_PLATE) } else { half };
            Some(EndStop { face: sense * face, wall: sense * wall, half })
        })
    }

    /// The end of a block, or of the plate that covers it.
    fn block_end(&self, slide: &Slide, end: usize) -> Option<BlockEnd> {
        if slide.kind == SliderKind::Pin {
            // The round end of a slot goes around the pin.
            let distance = if slide.guide_frame == Frame::Ground { PIN } else { 0.0 };
            return Some(BlockEnd { distance, is_plate: false });
        }
        if slide.open[end] {
            return None;
        }
        let block = slide.block_reach[end].abs();
        let is_outlined = slide
            .block_frame
            .body()
            .is_some_and(|body| !self.mechanism.bodies[body.index()].outline.is_empty());
        let plate = slide.block_frame.body().and_then(|body| {
            let reach = reach_along(&self.plate(body)?, &slide.block)?;
            Some((reach[end].abs(), self.view.cuts[body.index()].is_none()))
        });
        match plate {
            Some((_, false)) => None,
            Some((plate, true)) if plate > block || is_outlined => {
                Some(BlockEnd { distance: plate, is_plate: true })
            }
            _ => Some(BlockEnd { distance: block, is_plate: false }),
        }
    }

    /// The end of a guide of ground, at a place along it; `side` is positive at its front end.
    pub(super) fn end_wall(&mut self, local: &Local, end: f64, side: f64) {
        let (start, stop) = (local.at(end, side), local.at(end, -side));
        self.line(Class::Wall, vec![start, stop]);
        self.hatching(start, stop);
    }

    /// Pads.
    pub(super) fn pads(&mut self) {
        const SPACING: f64 = 5.0;
        for slide in self.sliders.clone().into_iter().flatten() {
            let stops = slide.stops.into_iter().flatten();
            for EndStop { face, wall, half } in stops.filter(|stop| stop.face != stop.wall) {
                self.area(Class::Pad, slide.guide.rectangle([face, wall], [-half, half]));
                let cells = ((wall - face).abs() / SPACING).ceil().clamp(1.0, 100.0);
                let rows = (2.0 * half / SPACING).ceil().clamp(1.0, 100.0);
                self.cross_hatching(&slide.guide, [face, wall], half, [cells, rows]);
            }
        }
    }

    /// Both diagonals of the cells of a rectangle.
    fn cross_hatching(&mut self, local: &Local, [from, to]: [f64; 2], half: f64, [cells, rows]: [f64; 2]) {
        let corner =
            |cell: f64, row: f64| local.at(from + (to - from) * cell / cells, 2.0 * half * row / rows - half);
        let mut diagonal = -rows + 1.0;
        while diagonal < cells {
            // The diagonal through (diagonal + row, row), where it is within the rectangle.
            let [start, stop] = [(-diagonal).max(0.0), (cells - diagonal).min(rows)];
            let mirrored = [corner(diagonal + start, rows - start), corner(diagonal + stop, rows - stop)];
            self.line(Class::Hatch, vec![corner(diagonal + start, start), corner(diagonal + stop, stop)]);
            self.line(Class::Hatch, mirrored.to_vec());
            diagonal += 1.0;
        }
    }
}
