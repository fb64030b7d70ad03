//! A moving picture as a document by itself.

use super::animation::{Animation, FrameOf};
use crate::coordinate::{NotFinite, coordinate, exact, finished, finished_parts, tenths, thousandths};
use crate::drawing::svg::{Colour, class_name, markup, rules};
use crate::drawing::{Class, EXAGGERATED, Element, Point, Shape, nice, quantity};
use crate::escaped;
use crate::plot::svg::wrapped;
use crate::typeface::{STACK, width};
use std::fmt::Write;

/// Room for the title above the drawing, and for the words and the key to the colours below it (drawing units).
const HEAD: f64 = 38.0;
const CAPTION: f64 = 138.0;
/// Size of the title.
const TITLE: f64 = 17.0;
/// From the left edge to the words (drawing units).
const INDENT: f64 = 12.0;
/// How far the background of a frame that stands still goes beyond its edges (drawing units).
#[cfg(feature = "png")]
const BLEED: f64 = 2.0;
/// At most so many events are told in an SVG document.
const MOST_TOLD: usize = 200;
/// Size of the words below the drawing.
const WORDS: f64 = 13.0;
/// Greatest length of the arrow that shows the scale of forces (drawing units).
const LONGEST_SAMPLE: f64 = 60.0;
/// Lines for the words of a frame, and for those of an event, and their distance (drawing units).
const LINES: usize = 2;
const LINE: f64 = 16.0;

impl Animation {
    /// As a page by itself, with a slider for the time and the log of events.
    ///
    /// # Errors
    /// If a place or a size is infinite or undefined.
    pub fn to_html(&self) -> Result<String, NotFinite> {
        // In the page they are parts of a program, in which characters are written otherwise.
        finished_parts(&self.shapes)?;
        finished(html(self))
    }

    /// As an SVG document that moves by itself.
    ///
    /// # Errors
    /// As [`Animation::to_html`].
    pub fn to_svg(&self) -> Result<String, NotFinite> {
        finished(svg(self))
    }
}

/// A page with a slider for the time and the log of events.
fn html(animation: &Animation) -> String {
    let theme = &animation.theme;
    let mut out = String::new();
    let _ = write!(
        out,
        "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{title}</title>\n<style>\n\
         body {{ font-family: {STACK}; background: {background}; color: {ink}; margin: 1.5em auto; max-width: 60em; \
         padding: 0 1em; }}\n\
         svg {{ width: 100%; height: auto; max-height: 62vh; }}\n\
         .controls {{ display: flex; flex-wrap: wrap; align-items: center; gap: 0.6em; }}\n\
         button {{ font: inherit; min-width: 3.2em; min-height: 44px; padding: 0 1em; color: {ink}; background: {body}; \
         border: 2px solid {muted}; border-radius: 8px; cursor: pointer; }}\n\
         button:focus-visible, #time:focus-visible {{ outline: 3px solid {reaction}; outline-offset: 2px; }}\n\
         #time {{ flex: 1 1 16em; height: 44px; accent-color: {reaction}; cursor: pointer; }}\n\
         #clock {{ min-width: 8em; font-variant-numeric: tabular-nums; }}\n\
         .mode {{ font-family: monospace; white-space: nowrap; }}\n\
         #state {{ min-height: 3em; }}\n\
         #log {{ height: 12em; overflow-y: auto; border-top: 1px solid {muted}; padding-left: 0; list-style: none; }}\n\
         #log li {{ padding: 0.5em; cursor: pointer; opacity: 0.75; }}\n\
         #log li.past {{ opacity: 1; }}\n\
         #log li.now {{ background: {body}; font-weight: bold; }}\n\
         kbd {{ border: 1px solid {muted}; border-radius: 4px; padding: 0 0.3em; }}\n\
         {rules}</style>\n<h1>{title}</h1>\n",
        title = escaped(&animation.title),
        background = theme.background,
        ink = theme.ink,
        muted = theme.muted,
        body = theme.body,
        reaction = theme.reaction,
        rules = rules(&Colour::of_theme(theme)),
    );
    let _ = writeln!(
        out,
        "<svg viewBox=\"{}\" role=\"img\" aria-label=\"{}\"><g id=\"drawing\"></g>{}</svg>",
        view_box(animation, 0.0),
        escaped(&animation.title),
        force_scale(animation)
    );
    let _ = writeln!(
        out,
        "<p class=\"controls\"><button id=\"play\">pause</button><button id=\"back\" aria-label=\"one frame back\">&#9664;</button>\
         <button id=\"on\" aria-label=\"one frame on\">&#9654;</button> <input id=\"time\" type=\"range\" min=\"0\" \
         max=\"{}\" value=\"0\" aria-label=\"time\"> <span id=\"clock\"></span></p>\n\
         <p id=\"state\">Mode <span class=\"mode\" id=\"mode\"></span>: <span id=\"words\"></span></p>\n\
         <p>{}.{}{} Arrows: normal reactions and friction on {}, \
         loads, and sliding velocities. Keys: <kbd>space</kbd> plays and pauses, <kbd>&#8592;</kbd> and <kbd>&#8594;</kbd> go one \
         frame, <kbd>Home</kbd> and <kbd>End</kbd> to the ends.</p>\n\
         <ol id=\"log\"></ol>",
        animation.frames.len().saturating_sub(1),
        speed(animation),
        if animation.is_exaggerated { format!(" {EXAGGERATED}") } else { String::new() },
        animation.friction_circles.as_ref().map_or_else(String::new, |words| format!(" {words}")),
        animation.forces_on,
    );
    out.push_str("<script>\n\"use strict\";\nconst shapes = [");
    list(&mut out, animation.shapes.iter().map(|shape| literal(shape.trim_end())));
    out.push_str("];\nconst frames = [");
    list(
        &mut out,
        animation.frames.iter().map(|frame| {
            let shapes: Vec<String> = frame.shapes.iter().map(ToString::to_string).collect();
            let (time, mode) = (exact(frame.time), literal(&frame.mode));
            format!("[{time},{mode},[{}],{}]", shapes.join(","), frame.words)
        }),
    );
    out.push_str("];\nconst words = [");
    list(&mut out, animation.words.iter().map(|words| literal(words)));
    out.push_str("];\nconst events = [");
    list(
        &mut out,
        animation.events.iter().map(|(time, words)| format!("[{},{}]", exact(*time), literal(words))),
    );
    let _ =
        write!(out, "];\nconst frameTime = {};\n{SCRIPT}</script>\n</html>\n", exact(animation.frame_time));
    out
}

const SCRIPT: &str = r#"const element = id => document.getElementById(id);
const log = element("log");
for (const [time, words] of events) {
  const line = document.createElement("li");
  line.textContent = time.toFixed(5) + " s  " + words;
  line.onclick = () => rest(frames.findIndex(frame => frame[0] >= time));
  log.append(line);
}
let current = 0, started = null;
let playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
function show(index) {
  current = index < 0 ? frames.length - 1 : index;
  const [time, mode, parts, told] = frames[current];
  element("drawing").innerHTML = parts.map(part => shapes[part]).join("");
  element("time").value = current;
  element("clock").textContent = "t = " + time.toFixed(4) + " s";
  element("mode").textContent = mode;
  element("words").textContent = words[told];
  element("play").textContent = playing ? "pause" : "play";
  let last = null;
  [...log.children].forEach((line, number) => {
    const past = events[number][0] <= time;
    line.className = past ? "past" : "";
    if (past) last = line;
  });
  if (last) {
    last.className = "past now";
    log.scrollTop = last.offsetTop - log.offsetTop - log.clientHeight / 2;
  }
}
function rest(index) {
  playing = false;
  show(index);
}
const step = by => rest(Math.max(0, Math.min(frames.length - 1, current + by)));
element("time").oninput = () => rest(Number(element("time").value));
element("back").onclick = () => step(-1);
element("on").onclick = () => step(1);
const keys = {
  " ": () => element("play").click(),
  ArrowLeft: () => step(-1),
  ArrowRight: () => step(1),
  Home: () => rest(0),
  End: () => rest(frames.length - 1),
};
addEventListener("keydown", event => {
  const act = keys[event.key];
  if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  act();
});
element("play").onclick = () => {
  playing = !playing;
  started = null;
  if (playing && current === frames.length - 1) current = 0;
  show(current);
};
function tick(now) {
  if (playing) {
    if (started === null) started = now - 1000 * frameTime * current;
    const index = Math.floor((now - started) / (1000 * frameTime));
    if (index >= frames.length) {
      playing = false;
      show(frames.length - 1);
    } else if (index !== current) show(index);
  }
  requestAnimationFrame(tick);
}
const wanted = new URLSearchParams(location.search).get("frame");
if (wanted !== null) playing = false;
show(wanted === null ? 0 : Math.min(Number(wanted), frames.length - 1));
requestAnimationFrame(tick);
"#;

/// A document that moves by itself: every frame is a group that is shown in its time.
fn svg(animation: &Animation) -> String {
    let (corner, size) = (animation.bounds.least, animation.bounds.size());
    let theme = &animation.theme;
    let total = animation.frame_time * animation.frames.len() as f64;
    let mut out = String::new();
    let _ = writeln!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"{}\" role=\"img\" font-family=\"{STACK}\">\n\
         <title>{}</title>\n<style>\n{}.frame, .told {{ display: none; }}\n\
         @media (prefers-reduced-motion: reduce) {{ .frame, .told {{ display: none !important; }} \
         .first {{ display: inline !important; }} }}\n</style>",
        coordinate(size.x),
        coordinate(HEAD + size.y + CAPTION),
        [corner.x, corner.y - HEAD, size.x, HEAD + size.y + CAPTION].map(coordinate).join(" "),
        escaped(&animation.title),
        rules(&Colour::of_theme(theme)),
    );
    let _ = writeln!(
        out,
        "<rect class=\"s-paper\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\">\
         <animate id=\"clock\" attributeName=\"opacity\" from=\"1\" to=\"1\" begin=\"0s;clock.end\" dur=\"{}s\"/></rect>",
        coordinate(corner.x),
        coordinate(corner.y - HEAD),
        coordinate(size.x),
        coordinate(HEAD + size.y + CAPTION),
        thousandths(total),
    );
    title_and_key(animation, &mut out);
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
    events(animation, &mut out);
    speed_below(animation, &mut out);
    out.push_str(&force_scale(animation));
    out.push_str("</svg>\n");
    out
}

/// One frame as a document that stands still, with what is told at its time; its sides are whole numbers.
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
    title_and_key(animation, &mut out);
    for index in &frame.shapes {
        out.push_str(&animation.shapes[*index]);
    }
    clock(animation, frame, &mut out);
    if let Some((time, words)) = animation.events.iter().rev().find(|(time, _)| *time <= frame.time) {
        words_of_event(animation, *time, words, &mut out);
    }
    speed_below(animation, &mut out);
    out.push_str(&force_scale(animation));
    out.push_str("</svg>\n");
    out
}

/// Width and height of a frame that stands still (drawing units).
#[cfg(feature = "png")]
pub(super) fn still_size(animation: &Animation) -> [f64; 2] {
    let size = animation.bounds.size();
    [size.x.ceil(), (HEAD + size.y + CAPTION).ceil()]
}

/// Time and mode of a frame with its words.
fn clock(animation: &Animation, frame: &FrameOf, out: &mut String) {
    let words = animation.words.get(frame.words).map_or("", |words| words);
    words_below(
        animation,
        16.0,
        &format!("t = {}, mode {}: {words}", seconds(animation, frame.time), frame.mode),
        out,
    );
}

/// A time with the digits that neighbouring frames differ in.
fn seconds(animation: &Animation, time: f64) -> String {
    let step = animation.frame_time / animation.slow_motion;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 9")]
    let decimals = (-step.log10()).ceil().clamp(0.0, 9.0) as usize;
    format!("{time:.decimals$} s")
}

/// What the colours of arrows mean, of those that occur.
fn colours(animation: &Animation) -> Vec<(Class, &'static str)> {
    let all = [
        (Class::Reaction, "normal reaction"),
        (Class::Friction, "friction"),
        (Class::PinForce, "force of a pin"),
        (Class::Load, "load, weight or drive"),
        (Class::Velocity, "sliding velocity"),
    ];
    let occurs = |class: Class| {
        let (name, line) =
            (format!("class=\"{}\"", class_name(class)), format!("class=\"{} ", class_name(class)));
        animation.shapes.iter().any(|shape| shape.contains(&name) || shape.contains(&line))
    };
    all.into_iter().filter(|(class, _)| occurs(*class)).collect()
}

/// The title above the drawing, and at the foot of the picture the key to the colours of arrows.
fn title_and_key(animation: &Animation, out: &mut String) {
    let (corner, foot) = (animation.bounds.least, animation.bounds.greatest.y);
    let space = animation.bounds.size().x - 2.0 * INDENT;
    let mut words = |class: &str, place: Point, size: f64, words: &str| {
        let [x, y] = [place.x, place.y].map(coordinate);
        let words = escaped(words);
        let _ =
            writeln!(out, "<text class=\"{class}\" x=\"{x}\" y=\"{y}\" font-size=\"{size}\">{words}</text>");
    };
    let title = wrapped(&animation.title, TITLE, space);
    let title = title.first().map_or("", |line| line);
    words("s-words", corner + Point::new(INDENT, TITLE + 4.0 - HEAD), TITLE, title);
    let mut place = Point::new(corner.x + INDENT, foot + 110.0);
    let mut arrows = String::new();
    for (class, meaning) in colours(animation) {
        let reach = 34.0 + width(meaning, WORDS);
        if place.x > corner.x + INDENT && place.x + reach > corner.x + INDENT + space {
            place = Point::new(corner.x + INDENT, place.y + 1.3 * LINE);
        }
        let to = place + Point::new(26.0, 0.0);
        arrows += &markup(&Element { class, shape: Shape::Arrow { from: place, to } });
        words("s-words", to + Point::new(8.0, 4.5), WORDS, meaning);
        place.x += reach + 22.0;
    }
    out.push_str(&arrows);
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
        escaped(&quantity(force, &animation.force_unit))
    )
}

/// The last line below the drawing.
fn speed_below(animation: &Animation, out: &mut String) {
    let _ = writeln!(
        out,
        "<text class=\"s-dimension\" style=\"stroke: none\" x=\"{}\" y=\"{}\" font-size=\"12\">{}</text>",
        coordinate(animation.bounds.least.x + INDENT),
        coordinate(animation.bounds.greatest.y + 90.0),
        speed(animation)
    );
}

/// The words of an event.
fn words_of_event(animation: &Animation, time: f64, words: &str, out: &mut String) {
    words_below(animation, 54.0, &format!("{}: {words}", seconds(animation, time)), out);
}

/// Words in lines from a place below the drawing on; three dots where these do not hold all.
fn words_below(animation: &Animation, first: f64, words: &str, out: &mut String) {
    let space = animation.bounds.size().x - 2.0 * INDENT;
    let mut lines = wrapped(words, WORDS, space - width("…", WORDS));
    if lines.len() > LINES {
        lines.truncate(LINES);
        lines.iter_mut().skip(LINES - 1).for_each(|line| line.push('…'));
    }
    for (line, text) in lines.iter().enumerate() {
        let _ = write!(
            out,
            "<text class=\"s-words\" x=\"{}\" y=\"{}\" font-size=\"{WORDS}\">{}</text>",
            coordinate(animation.bounds.least.x + INDENT),
            coordinate(animation.bounds.greatest.y + first + LINE * line as f64),
            escaped(text)
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
fn events(animation: &Animation, out: &mut String) {
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
        words_of_event(animation, *time, words, out);
        out.push_str("</g>\n");
    }
}

/// What makes a group visible from a time of the clock on, for some time (s).
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

fn list(out: &mut String, items: impl Iterator<Item = String>) {
    for (index, item) in items.enumerate() {
        out.push_str(if index == 0 { "\n" } else { ",\n" });
        out.push_str(&item);
    }
}

/// A text as JavaScript writes it, within a page.
fn literal(text: &str) -> String {
    let mut out = String::from("\"");
    for character in slideway::printable::lines(text).chars() {
        match character {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '<' => out.push_str("\\u003c"),
            other => out.push(other),
        }
    }
    out.push('"');
    out
}
