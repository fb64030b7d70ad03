//! Lengths and heights of blocks.

use super::Painter;
use super::outline::{Local, turned, upper_side};
use super::scene::{Class, Point, Shape};
use slideway::ids::JointId;
use slideway::model::SliderKind;

/// Distance of a dimension from what it measures.
const ASIDE: f64 = 22.0;

impl Painter<'_> {
    /// The distance of the contacts and of the rubbing faces of every block.
    pub(super) fn dimensions(&mut self) {
        let mechanism = self.mechanism;
        for index in 0..mechanism.joints.len() {
            let (Some(slide), Some(slider)) = (self.slide(JointId(index)), mechanism.slider(JointId(index)))
            else {
                continue;
            };
            if slide.kind == SliderKind::Pin {
                continue;
            }
            let length = self.configuration.overlap(mechanism, slider).unwrap_or(slider.length);
            let places: Vec<f64> = slider
                .contacts
                .iter()
                .map(|contact| {
                    let place = self.view.place(self.configuration.contact(mechanism, *contact).point);
                    (place - slide.guide.origin).dot(&slide.guide.along)
                })
                .collect();
            let (from, to) = if let [front, rear, ..] = places[..] {
                (rear, front)
            } else {
                let half = 0.5 * length * self.view.scale;
                let middle = places.first().copied().unwrap_or(0.0);
                (middle - half, middle + half)
            };
            let downwards = -upper_side(slide.guide.across);
            let edge = downwards * slide.half_foot();
            self.dimension(
                &slide.guide,
                [from, to],
                [edge, edge + downwards * ASIDE],
                self.shown(length, "m"),
            );
            if slider.height != 0.0 {
                let half = 0.5 * slide.height;
                let across = Local {
                    origin: slide.guide.origin,
                    along: slide.guide.across,
                    across: slide.guide.along,
                };
                let end = slide.outer().2[1] + if slide.around { 12.0 } else { 0.0 };
                let height = self.shown(slider.height.abs(), "m");
                self.dimension(&across, [-half, half], [end, end + 14.0], height);
            }
        }
    }

    /// A dimension from one place to another along a frame: lines lead there from its edge.
    fn dimension(&mut self, frame: &Local, [from, to]: [f64; 2], [edge, line]: [f64; 2], text: String) {
        let beyond = line + 4.0 * (line - edge).signum();
        for end in [from, to] {
            self.line(Class::Dimension, vec![frame.at(end, edge), frame.at(end, beyond)]);
        }
        let ends = [frame.at(from, line), frame.at(to, line)];
        self.line(Class::Dimension, ends.to_vec());
        let along = frame.along;
        for (end, direction) in [(ends[0], -along), (ends[1], along)] {
            if (ends[1] - ends[0]).norm() > 24.0 {
                self.scene.add(Class::Dimension, Shape::Head(end, direction));
            } else {
                let slash = (along + turned(along)) * 4.0;
                self.line(Class::Dimension, vec![end - slash, end + slash]);
            }
        }
        let outwards = frame.across * (line - edge).signum();
        self.value_along(Class::Dimension, text, ends, outwards);
    }
}

/// A bar of a length with ticks at its ends: the scale of a drawing.
pub(super) fn scale_bar(from: Point, length: f64) -> [Vec<Point>; 3] {
    let to = from + Point::new(length, 0.0);
    let tick = Point::new(0.0, 5.0);
    [vec![from, to], vec![from - tick, from + tick], vec![to - tick, to + tick]]
}
