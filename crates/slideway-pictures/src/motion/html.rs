//! A moving picture as a page with a slider for the time.

use super::animation::Animation;
use super::page::{colours, force_scale, samples, speed, view_box};
use crate::coordinate::{NotFinite, exact, finished, finished_parts};
use crate::drawing::svg::{Colour, rules};
use crate::drawing::{Class, EXAGGERATED, Point};
use crate::printed;
use crate::typeface::STACK;
use std::fmt::Write;

impl Animation {
    /// Returns a page by itself, with a slider for the time and the log of events.
    ///
    /// # Errors
    /// If a place or a size is infinite or undefined.
    pub fn to_html(&self) -> Result<String, NotFinite> {
        // In the page they are parts of a program, in which characters are written otherwise.
        finished_parts(&self.shapes)?;
        finished(html(self))
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
         .key {{ display: flex; flex-wrap: wrap; gap: 0.2em 1.4em; list-style: none; margin: 0.5em 0; padding: 0; }}\n\
         .key svg {{ width: 30px; height: 14px; vertical-align: -2px; }}\n\
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
        title = printed(&animation.title),
        background = theme.background,
        ink = theme.ink,
        muted = theme.muted,
        body = theme.body,
        reaction = theme.reaction,
        rules = rules(&Colour::of_theme(theme)),
    );
    let _ = writeln!(
        out,
        "<svg viewBox=\"{}\" role=\"img\" aria-label=\"{}\"><g id=\"drawing\"></g>{}</svg>\n{}",
        view_box(animation, 0.0),
        printed(&animation.title),
        force_scale(animation),
        key_of_page(animation),
    );
    let _ = writeln!(
        out,
        "<p class=\"controls\"><button id=\"play\">pause</button><button id=\"back\" aria-label=\"one frame back\">&#9664;</button>\
         <button id=\"on\" aria-label=\"one frame on\">&#9654;</button> <input id=\"time\" type=\"range\" min=\"0\" \
         max=\"{}\" value=\"0\" aria-label=\"time\"> <span id=\"clock\"></span></p>\n\
         <p id=\"state\">Mode <span class=\"mode\" id=\"mode\"></span>: <span id=\"words\"></span></p>\n\
         <p>{}.{}{} Keys: <kbd>space</kbd> plays and pauses, <kbd>&#8592;</kbd> and <kbd>&#8594;</kbd> go one \
         frame, <kbd>Home</kbd> and <kbd>End</kbd> to the ends.</p>\n\
         <ol id=\"log\"></ol>",
        animation.frames.len().saturating_sub(1),
        speed(animation),
        if animation.is_exaggerated { format!(" {EXAGGERATED}") } else { String::new() },
        animation.friction_circles.as_ref().map_or_else(String::new, |words| format!(" {words}")),
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

/// The key to the colours of arrows, for a page.
fn key_of_page(animation: &Animation) -> String {
    let one = |(class, meaning): (Class, &str)| {
        let on = if matches!(class, Class::Reaction | Class::Friction) { animation.forces_on } else { "" };
        let on = if on.is_empty() { String::new() } else { format!(" on {on}") };
        let arrow = samples(class, Point::zeros());
        format!("<li><svg viewBox=\"-2 -7 30 14\" aria-hidden=\"true\">{arrow}</svg> {meaning}{on}</li>\n")
    };
    let items: String = colours(animation).into_iter().map(one).collect();
    format!("<ul class=\"key\" aria-label=\"What the colours of arrows mean\">\n{items}</ul>")
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
