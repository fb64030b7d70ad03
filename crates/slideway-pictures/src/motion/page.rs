//! A moving picture as a document by itself.

use super::animation::{Animation, FrameOf};
use crate::coordinate::{NotFinite, coordinate, finished, tenths, thousandths};
use crate::drawing::svg::{Colour, class_name, markup, rules};
use crate::drawing::{Class, Element, Point, Shape, nice, quantity, sample};
use crate::plot::TITLE;
use crate::plot::svg::wrapped;
use crate::printed;
use crate::typeface::{STACK, width};
use std::fmt::Write;

/// Room for the title above the drawing (drawing units).
const HEAD: f64 = 38.0;
/// From the left edge to the words (drawing units).
const INDENT: f64 = 12.0;
/// How far the background of a frame that stands still goes beyond its edges (drawing units).
#[cfg(feature = "png")]
const BLEED: f64 = 2.0;
/// Maximum number of events whose words are in an SVG document.
const MOST_TOLD: usize = 200;
/// Size of the words below the drawing.
const WORDS: f64 = 13.0;
/// From the drawing to the first line below it, and the length of the arrows of the key (drawing units).
const FIRST: f64 = 16.0;
const SAMPLE: f64 = 26.0;
/// Greatest length of the arrow that shows the scale of forces (drawing units).
const LONGEST_SAMPLE: f64 = 60.0;
/// The most lines for the words of a frame, and for those of an event, and their distance (drawing units).
const LINES: usize = 6;
const LINE: f64 = 16.0;

impl Animation {
    /// As an SVG document that moves by itself.
    ///
    /// # Errors
    /// As [`Animation::to_html`].
    pub fn to_svg(&self) -> Result<String, NotFinite> {
        finished(svg(self))
    }
}

/// A document that moves by itself: every frame is a group that is shown in its time.
fn svg(animation: &Animation) -> String {
    let (corner, size) = (animation.bounds.least, animation.bounds.size());
    let theme = &animation.theme;
    let total = animation.frame_time * animation.frames.len() as f64;
    let foot = Foot::of(animation);
    let mut out = String::new();
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"{}\" role=\"img\" font-family=\"{STACK}\">\n\
         <title>{}</title>\n<style>\n{}.frame, .told {{ display: none; }}\n\
         @media (prefers-reduced-motion: reduce) {{ .frame, .told {{ display: none !important; }} \
         .first {{ display: inline !important; }} }}\n</style>",
        coordinate(size.x),
        coordinate(HEAD + size.y + foot.height),
        [corner.x, corner.y - HEAD, size.x, HEAD + size.y + foot.height].map(coordinate).join(" "),
        printed(&animation.title),
        rules(&Colour::of_theme(theme)),
    );
    let _ = writeln!(
        out,
        "<rect class=\"s-paper\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\
         <animate id=\"clock\" attributeName=\"opacity\" from=\"1\" to=\"1\" begin=\"0s;clock.end\" dur=\"{}s\"/></rect>",
        coordinate(corner.x),
        coordinate(corner.y - HEAD),
        coordinate(size.x),
        coordinate(HEAD + size.y + foot.height),
        thousandths(total),
    );
    title_and_key(animation, &foot, &mut out);
    let common = common(animation);
    for index in &common {
        out.push_str(&animation.shapes[*index]);
    }
    let uses = Uses::of(animation, common.len());
    uses.define(animation, &mut out);
    for (number, frame) in animation.frames.iter().enumerate() {
        let begin = animation.frame_time * number as f64;
        let class = if number == 0 { "frame first" } else { "frame" };
        let _ = writeln!(out, "<g class=\"{class}\">{}", shown(begin, animation.frame_time));
        for index in &frame.shapes[common.len()..] {
            uses.draw(animation, *index, &mut out);
        }
        clock(animation, frame, &mut out);
        out.push_str("</g>\n");
    }
    events(animation, &foot, &mut out);
    speed_below(animation, &foot, &mut out);
    out.push_str(&force_scale(animation));
    out.push_str("</svg>\n");
    out
}

/// Draws one frame as a document that stands still, with the words of its time; its sides are whole numbers.
#[cfg(feature = "png")]
pub(super) fn still(animation: &Animation, frame: &FrameOf) -> String {
    let [width, height] = still_size(animation);
    let corner = animation.bounds.least;
    let mut out = String::new();
    // The background goes beyond the edges, so that no pixel shows what is behind it.
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"{x} {y} {width} {height}\">\n<style>\n{rules}</style>\n\
         <rect class=\"s-paper\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
        coordinate(corner.x - BLEED),
        coordinate(corner.y - HEAD - BLEED),
        width + 2.0 * BLEED,
        height + 2.0 * BLEED,
        x = coordinate(corner.x),
        y = coordinate(corner.y - HEAD),
        rules = rules(&Colour::of_theme(&animation.theme)),
    );
    let foot = Foot::of(animation);
    title_and_key(animation, &foot, &mut out);
    for index in &frame.shapes {
        out.push_str(&animation.shapes[*index]);
    }
    clock(animation, frame, &mut out);
    if let Some((time, words)) = animation.events.iter().rev().find(|(time, _)| *time <= frame.time) {
        words_of_event(animation, (*time, words), &foot, &mut out);
    }
    speed_below(animation, &foot, &mut out);
    out.push_str(&force_scale(animation));
    out.push_str("</svg>\n");
    out
}

/// Width and height of a frame that stands still (drawing units).
#[cfg(feature = "png")]
pub(super) fn still_size(animation: &Animation) -> [f64; 2] {
    let (size, foot) = (animation.bounds.size(), Foot::of(animation));
    [size.x.ceil(), (HEAD + size.y + foot.height).ceil()]
}

/// Time and mode of a frame with its words.
fn clock(animation: &Animation, frame: &FrameOf, out: &mut String) {
    words_below(animation, FIRST, &words_of_frame(animation, frame), out);
}

fn words_of_frame(animation: &Animation, frame: &FrameOf) -> String {
    let words = animation.words.get(frame.words).map_or("", |words| words);
    format!("t = {}, mode {}: {words}", seconds(animation, frame.time), frame.mode)
}

/// Where the words below the drawing stand, by their distance from it, and the room that they need (drawing units).
struct Foot {
    event: f64,
    speed: f64,
    /// Of each colour of arrows, with its meaning, from the left edge.
    key: Vec<(Class, &'static str, Point)>,
    height: f64,
}

impl Foot {
    fn of(animation: &Animation) -> Self {
        let lines = |texts: &mut dyn Iterator<Item = String>| {
            let most = texts.map(|words| lines_below(animation, &words).len()).max();
            LINE * most.unwrap_or(0) as f64
        };
        let mut seen = std::collections::HashSet::new();
        let mut modes = animation.frames.iter().filter(|frame| seen.insert((&frame.mode, frame.words)));
        let event = FIRST + lines(&mut modes.by_ref().map(|frame| words_of_frame(animation, frame))) + 6.0;
        let mut told = animation.events.iter().map(|(time, words)| words_at(animation, *time, words));
        let speed = event + lines(&mut told) + 4.0;
        let key = key(animation, speed + 20.0);
        let height = key.last().map_or(speed, |(.., place)| place.y) + 12.0;
        Self { event, speed, key, height }
    }
}

/// The colours of arrows with their meanings in rows, the first of them at this distance below the drawing.
fn key(animation: &Animation, first: f64) -> Vec<(Class, &'static str, Point)> {
    let space = animation.bounds.size().x - 2.0 * INDENT;
    let mut place = Point::new(INDENT, first);
    let mut key = Vec::new();
    for (class, meaning) in colours(animation) {
        let reach = 34.0 + width(meaning, WORDS);
        if place.x > INDENT && place.x + reach > INDENT + space {
            place = Point::new(INDENT, place.y + 1.3 * LINE);
        }
        key.push((class, meaning, place));
        place.x += reach + 22.0;
    }
    key
}

/// A time with the digits that neighbouring frames differ in.
fn seconds(animation: &Animation, time: f64) -> String {
    let step = animation.frame_time / animation.slow_motion;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
    let decimals = (-step.log10()).ceil().clamp(0.0, 9.0) as usize;
    format!("{time:.decimals$} s")
}

/// Returns the classes of arrows that occur, with the meanings of their colours.
pub(super) fn colours(animation: &Animation) -> Vec<(Class, &'static str)> {
    let all = [
        (Class::Reaction, "normal reaction"),
        (Class::Friction, "friction"),
        (Class::PinForce, "force of a pin"),
        (Class::Load, "load, weight or drive"),
        (Class::PointsOut, "force out of the drawing"),
        (Class::PointsIn, "force into the drawing"),
        (Class::Velocity, "sliding velocity"),
        (Class::Break, "not to scale"),
    ];
    let occurs = |class: &Class| {
        let (name, line) =
            (format!("class=\"{}\"", class_name(*class)), format!("class=\"{} ", class_name(*class)));
        animation.shapes.iter().any(|shape| shape.contains(&name) || shape.contains(&line))
    };
    let mut used: Vec<_> = all.into_iter().filter(|(class, _)| occurs(class)).collect();
    // They have one colour, and so one entry.
    if [Class::Reaction, Class::PinForce].iter().all(occurs) {
        used.retain(|(class, _)| *class != Class::PinForce);
        used[0].1 = "force of a pin, normal reaction";
    }
    used
}

/// The title above the drawing, and at the foot of the picture the key to the colours of arrows.
fn title_and_key(animation: &Animation, foot: &Foot, out: &mut String) {
    let corner = animation.bounds.least;
    let below = Point::new(corner.x, animation.bounds.greatest.y);
    let space = animation.bounds.size().x - 2.0 * INDENT;
    let mut words = |class: &str, place: Point, size: f64, words: &str| {
        let [x, y] = [place.x, place.y].map(coordinate);
        let words = printed(words);
        let _ =
            writeln!(out, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" font-size=\"{size}\">{words}</text>");
    };
    let title = wrapped(&animation.title, TITLE, space);
    let title = title.first().map_or("", |line| line);
    words("s-words", corner + Point::new(INDENT, TITLE + 4.0 - HEAD), TITLE, title);
    let mut arrows = String::new();
    for (class, meaning, place) in &foot.key {
        arrows += &samples(*class, below + place);
        words("s-words", below + place + Point::new(SAMPLE + 8.0, 4.5), WORDS, meaning);
    }
    out.push_str(&arrows);
}

/// Returns the sample of a class for a key, as SVG.
pub(super) fn samples(class: Class, place: Point) -> String {
    sample(class, place, SAMPLE).into_iter().map(|shape| markup(&Element { class, shape })).collect()
}

/// An arrow of a round force in the lower left corner of the drawing; nothing without forces.
pub(super) fn force_scale(animation: &Animation) -> String {
    let Some(scale) = animation.force_scale else { return String::new() };
    let force = nice(LONGEST_SAMPLE / scale, &animation.force_unit);
    let from = Point::new(animation.bounds.least.x + INDENT, animation.bounds.greatest.y - INDENT);
    let to = from + Point::new(force * scale, 0.0);
    let arrow = markup(&Element { class: Class::Reaction, shape: Shape::Arrow { from, to } });
    let text = [to.x + 8.0, to.y + 4.5].map(coordinate);
    format!(
        "{arrow}<text class=\"s-words\" x=\"{}\" y=\"{}\" font-size=\"{WORDS}\">{}</text>\n",
        text[0],
        text[1],
        printed(&quantity(force, &animation.force_unit))
    )
}

/// The last line below the drawing.
fn speed_below(animation: &Animation, foot: &Foot, out: &mut String) {
    let _ = writeln!(
        out,
        "<text class=\"s-dimension\" style=\"stroke: none\" x=\"{}\" y=\"{}\" font-size=\"12\">{}</text>",
        coordinate(animation.bounds.least.x + INDENT),
        coordinate(animation.bounds.greatest.y + foot.speed),
        speed(animation)
    );
}

/// The words of an event.
fn words_of_event(animation: &Animation, (time, words): (f64, &str), foot: &Foot, out: &mut String) {
    words_below(animation, foot.event, &words_at(animation, time, words), out);
}

fn words_at(animation: &Animation, time: f64, words: &str) -> String {
    format!("{}: {words}", seconds(animation, time))
}

/// Words in lines; three dots where these do not hold all.
fn lines_below(animation: &Animation, words: &str) -> Vec<String> {
    let space = animation.bounds.size().x - 2.0 * INDENT;
    let mut lines = wrapped(words, WORDS, space - width(" …", WORDS));
    if lines.len() > LINES {
        lines.truncate(LINES);
        lines.iter_mut().skip(LINES - 1).for_each(|line| line.push_str(" …"));
    }
    lines
}

/// Words from a place below the drawing on.
fn words_below(animation: &Animation, first: f64, words: &str, out: &mut String) {
    for (line, text) in lines_below(animation, words).iter().enumerate() {
        let _ = write!(
            out,
            "<text class=\"s-words\" x=\"{}\" y=\"{}\" font-size=\"{WORDS}\">{}</text>",
            coordinate(animation.bounds.least.x + INDENT),
            coordinate(animation.bounds.greatest.y + first + LINE * line as f64),
            printed(text)
        );
    }
}

/// How often each shape occurs behind those that all frames share.
struct Uses(Vec<usize>);

impl Uses {
    fn of(animation: &Animation, shared: usize) -> Self {
        let mut counts = vec![0; animation.shapes.len()];
        let later = animation.frames.iter().flat_map(|frame| &frame.shapes[shared..]);
        later.for_each(|index| counts[*index] += 1);
        Self(counts)
    }

    /// Shapes that occur several times are written once.
    fn define(&self, animation: &Animation, out: &mut String) {
        out.push_str("<defs>\n");
        for (index, shape) in animation.shapes.iter().enumerate().filter(|(index, _)| self.0[*index] > 1) {
            let _ = writeln!(out, "<g id=\"s{index}\">{}</g>", shape.trim_end());
        }
        out.push_str("</defs>\n");
    }

    fn draw(&self, animation: &Animation, index: usize, out: &mut String) {
        if self.0[index] > 1 {
            let _ = write!(out, "<use href=\"#s{index}\"/>");
        } else {
            out.push_str(&animation.shapes[index]);
        }
    }
}

/// The words of each event until the next.
fn events(animation: &Animation, foot: &Foot, out: &mut String) {
    let clock = |time: f64| (time - animation.times[0]) * animation.slow_motion;
    let total = animation.frame_time * animation.frames.len() as f64;
    let told = &animation.events[..animation.events.len().min(MOST_TOLD)];
    for (number, (time, words)) in told.iter().enumerate() {
        let begin = clock(*time);
        let end = told.get(number + 1).map_or(total, |(next, _)| clock(*next));
        if end <= begin {
            continue;
        }
        let _ = write!(out, "<g class=\"told\">{}", shown(begin, end - begin));
        words_of_event(animation, (*time, words), foot, out);
        out.push_str("</g>\n");
    }
}

/// Returns the SVG that makes a group visible from a time of the clock on, for some time (s).
fn shown(begin: f64, duration: f64) -> String {
    let [begin, duration] = [begin, duration].map(thousandths);
    format!(
        "<set attributeName=\"display\" to=\"inline\" begin=\"clock.begin+{begin}s\" dur=\"{duration}s\"/>"
    )
}

/// The shapes with which every frame begins.
fn common(animation: &Animation) -> Vec<usize> {
    let Some(first) = animation.frames.first() else { return Vec::new() };
    let length = |frame: &FrameOf| {
        frame.shapes.iter().zip(&first.shapes).take_while(|(one, other)| one == other).count()
    };
    let shared = animation.frames.iter().map(length).min().unwrap_or(0);
    first.shapes[..shared].to_vec()
}

pub(super) fn speed(animation: &Animation) -> String {
    let factor = animation.slow_motion;
    let times = |factor: f64| tenths(factor).trim_end_matches(".0").to_owned();
    if factor == 1.0 {
        "In real time".to_owned()
    } else if factor > 1.0 {
        format!("{} times slower than real time", times(factor))
    } else {
        format!("{} times faster than real time", times(1.0 / factor))
    }
}

pub(super) fn view_box(animation: &Animation, below: f64) -> String {
    let (corner, size) = (animation.bounds.least, animation.bounds.size());
    [corner.x, corner.y, size.x, size.y + below].map(coordinate).join(" ")
}
