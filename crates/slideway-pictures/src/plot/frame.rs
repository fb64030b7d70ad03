//! A frame with its axes: ticks, numbers, names with units.

use super::clip::Frame;
use super::scale::{Scale, angle_step, logarithmic_ticks, tick_step, tick_text, ticks};
use super::svg::{Svg, coordinate, width};
use super::{MARGIN, SMALL, TEXT};
use crate::theme::Theme;

/// Distances of ticks that are aimed at (px).
const BETWEEN_X: f64 = 80.0;
const BETWEEN_Y: f64 = 48.0;
/// An axis with fewer ticks cannot be read.
const LEAST_TICKS: usize = 3;
/// Length of ticks (px).
const TICK: f64 = 5.0;

/// An axis with its range.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FrameAxis {
    pub(crate) name: String,
    pub(crate) unit: String,
    pub(crate) range: [f64; 2],
    pub(crate) logarithmic: bool,
}

impl FrameAxis {
    /// Ticks of an axis of this length (px), and their texts.
    fn ticks(&self, length: f64, between: f64) -> (Vec<f64>, Vec<String>) {
        // What has no name is no axis.
        if self.name.is_empty() {
            return (Vec::new(), Vec::new());
        }
        // At least three, however short the axis is.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "lengths are not negative"
        )]
        let wanted = ((length / between) as usize).max(3);
        if let Some(ticks) = self.logarithmic.then(|| logarithmic_ticks(self.range, wanted)).flatten() {
            let texts = ticks.iter().map(|&tick| tick_text(tick, tick, tick)).collect();
            return (ticks, texts);
        }
        // Multiples of a step may miss both ends of the axis: then a finer one.
        let of = |wanted: usize| {
            let is_angle = self.unit == "deg";
            let step = if is_angle { angle_step(self.range, wanted) } else { tick_step(self.range, wanted) };
            (step, ticks(self.range, step))
        };
        let tried = [wanted, 2 * wanted].map(of);
        let [coarse, fine] = tried;
        let (step, ticks) = if coarse.1.len() < LEAST_TICKS { fine } else { coarse };
        let greatest = self.range[0].abs().max(self.range[1].abs());
        let texts = ticks.iter().map(|&tick| tick_text(tick, step, greatest)).collect();
        (ticks, texts)
    }

    /// Returns the width that the numbers and the name of a vertical axis of this length need beside the
    /// frame (px).
    pub(crate) fn space_on_the_left(&self, length: f64) -> f64 {
        let (_, texts) = self.ticks(length, BETWEEN_Y);
        texts.iter().map(|text| width(text, SMALL)).fold(0.0, f64::max) + TICK + 8.0 + 1.5 * TEXT
    }

    /// With its beginning and its end at these places (px).
    pub(super) fn scale(&self, places: [f64; 2]) -> Scale {
        Scale { values: self.range, places, logarithmic: self.logarithmic }
    }

    /// The name with the unit.
    fn named(&self) -> String {
        let unit = self.unit.replace("^2", "\u{b2}").replace("^3", "\u{b3}").replace("^4", "\u{2074}");
        match unit.as_str() {
            "" => self.name.clone(),
            // "L in in" reads like a slip.
            _ if unit.starts_with("in") => format!("{} ({unit})", self.name),
            _ => format!("{} in {unit}", self.name),
        }
    }
}

/// Two axes in their place.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Placed {
    axes: [FrameAxis; 2],
    frame: Frame,
    /// Distance of the ticks of the horizontal axis from the frame (px).
    below: f64,
    /// True if the horizontal axis has its name.
    is_named: bool,
}

impl Placed {
    /// In the frame left, top, right, bottom.
    pub(crate) fn new(axes: [FrameAxis; 2], [left, top, right, bottom]: [f64; 4]) -> Self {
        Self { axes, frame: Frame { left, top, right, bottom }, below: 0.0, is_named: true }
    }

    /// With space between the frame and the numbers of the horizontal axis.
    pub(super) fn with_space_below(self, below: f64) -> Self {
        Self { below, ..self }
    }

    /// Without the name of the horizontal axis, which another one has.
    pub(super) fn without_name(self) -> Self {
        Self { is_named: false, ..self }
    }

    pub(super) fn rectangle(&self) -> Frame {
        self.frame
    }

    /// Left, top, right, bottom.
    pub(crate) fn frame(&self) -> [f64; 4] {
        [self.frame.left, self.frame.top, self.frame.right, self.frame.bottom]
    }

    /// Below the name of the horizontal axis.
    pub(crate) fn bottom(&self) -> f64 {
        let lines = if self.is_named { 2.9 } else { 1.3 };
        self.frame.bottom + self.below + TICK + lines * TEXT
    }

    pub(super) fn x(&self) -> Scale {
        self.axes[0].scale([self.frame.left, self.frame.right])
    }

    pub(super) fn y(&self) -> Scale {
        self.axes[1].scale([self.frame.bottom, self.frame.top])
    }

    /// The place of a point, if it is within the frame.
    pub(crate) fn inside(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let place = [self.x().place(x), self.y().place(y)];
        self.frame.holds(place).then_some(place)
    }
}

/// Lines across the frame at ticks; zero is heavier.
pub(super) fn draw_grid(placed: &Placed, theme: &Theme, svg: &mut Svg) {
    let Frame { left, top, right, bottom } = placed.frame;
    let grid = [("class", "grid"), ("stroke", theme.muted), ("stroke-opacity", "0.3"), ("stroke-width", "1")];
    let zero = [("class", "zero"), ("stroke", theme.ink), ("stroke-opacity", "0.6"), ("stroke-width", "1")];
    for value in placed.axes[0].ticks(right - left, BETWEEN_X).0 {
        let x = placed.x().place(value);
        svg.line([x, top], [x, bottom], &grid);
    }
    for value in placed.axes[1].ticks(bottom - top, BETWEEN_Y).0 {
        let y = placed.y().place(value);
        svg.line([left, y], [right, y], if value == 0.0 { &zero } else { &grid });
    }
}

/// Ticks, numbers and names beside the frame.
pub(crate) fn draw_axes(placed: &Placed, theme: &Theme, svg: &mut Svg) {
    let Frame { left, top, right, bottom } = placed.frame;
    let size = coordinate(SMALL);
    let tick = [("class", "tick"), ("stroke", theme.ink), ("stroke-width", "1.2")];
    let number = |anchor: &'static str| {
        [("class", "tick"), ("font-size", &*size), ("text-anchor", anchor), ("fill", theme.ink)]
    };
    let below = bottom + placed.below;
    let (values, texts) = placed.axes[0].ticks(right - left, BETWEEN_X);
    for (value, text) in values.into_iter().zip(texts) {
        let x = placed.x().place(value);
        svg.line([x, below], [x, below + TICK], &tick);
        svg.label([x, below + TICK + 1.1 * SMALL], &number("middle"), &text);
    }
    let (values, texts) = placed.axes[1].ticks(bottom - top, BETWEEN_Y);
    for (value, text) in values.into_iter().zip(texts) {
        let y = placed.y().place(value);
        svg.line([left - TICK, y], [left, y], &tick);
        svg.label([left - TICK - 4.0, y + 0.36 * SMALL], &number("end"), &text);
    }
    let size = coordinate(TEXT);
    let name = [("class", "axis"), ("font-size", &*size), ("text-anchor", "middle"), ("fill", theme.ink)];
    let middle = [f64::midpoint(left, right), f64::midpoint(top, bottom)];
    if placed.is_named {
        svg.label([middle[0], below + TICK + 2.45 * TEXT], &name, &placed.axes[0].named());
    }
    let x = MARGIN + 0.8 * TEXT;
    let turned = format!("rotate(-90 {} {})", coordinate(x), coordinate(middle[1]));
    svg.label([x, middle[1]], &[&name[..], &[("transform", &turned)]].concat(), &placed.axes[1].named());
    svg.rectangle(
        [left, top, right - left, bottom - top],
        &[("class", "frame"), ("fill", "none"), ("stroke", theme.ink), ("stroke-width", "1.2")],
    );
}
