//! A report as one page of HTML that needs nothing else: no network, no other file, no script.
//!
//! Light or dark as the reader's machine asks for, and with a style for print. The drawing is part of the
//! page; figures are pictures within it, in both themes.

//!
//! # Files
//! `head.html` is the head with the style, with names in double braces for what `head` fills in; `summary.rs`
//! writes the section of margins, efforts and rest, `body.rs` everything else; `findings.rs` asks the questions.

mod body;
mod findings;
mod summary;

pub use findings::{Findings, Origin, at_rest, reasons};

use crate::coordinate::{NotFinite, finished};
use crate::drawing::Sheet;
use crate::drawing::svg::{Colour, rules};
use crate::escaped;
use crate::theme::{DARK, LIGHT, Theme};
use slideway::limits::LimitsReport;
use slideway::printable::lines;
use slideway::report::SolveReport;
use slideway::standstill::HoldReport;

const HEAD: &str = include_str!("head.html");

/// The contents of a page.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The command that made it.
    pub(crate) command: &'a str,
    /// Name of the model.
    pub(crate) name: &'a str,
    /// Text of the model file.
    pub(crate) text: &'a str,
    /// The changes of that text, one line each.
    pub(crate) settings: &'a [String],
    /// The title of the mechanism.
    pub(crate) title: &'a str,
    /// The parameters that are known within bounds, each with its middle, for which everything holds but the answer
    /// for the whole ranges.
    pub(crate) at_middle: &'a [String],
    /// The drawings of the mechanism and its solutions.
    pub(crate) drawings: &'a [Sheet],
    /// All solutions, or why there is no answer.
    pub(crate) report: Result<&'a SolveReport, &'a [String]>,
    /// Which efforts the drives need, and the efficiency, in sentences; empty without drives.
    pub(crate) efficiency: &'a [String],
    /// Whether it stays at rest, or why that is not known.
    pub(crate) rest: Result<&'a HoldReport, &'a [String]>,
    /// For which values modes exist.
    pub(crate) limits: &'a [LimitsReport],
    /// Further figures.
    pub(crate) figures: &'a [Figure],
}

/// A figure of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// The words below it, which say what it shows.
    pub(crate) caption: String,
    /// The picture on a light background, as SVG.
    pub(crate) light: String,
    /// The picture on a dark background, as SVG.
    pub(crate) dark: String,
}

/// The page as HTML. Every name and text from the model is escaped, and its characters that are not seen
/// stand as their numbers ([`slideway::printable`]).
///
/// # Errors
/// If a place or a size in its drawing is infinite or undefined.
pub fn to_html(page: &Page<'_>) -> Result<String, NotFinite> {
    finished(format!("{}<body>\n{}</body>\n</html>", head(page.title), body::body(page)))
}

/// Returns the sections of a page about an answer: the state that was solved with the number of solutions and
/// the margins, then a section for each solution and each preload-gap state, with its forces.
pub fn solve_parts(report: &SolveReport) -> Vec<String> {
    let margins = report.margins_in_words();
    let margins = all(margins.lines().map(str::trim).filter(|line| !line.is_empty()), |line| {
        format!("<p>{}</p>\n", text(line))
    });
    let states = body::states(report);
    let states = states.iter().map(|(heading, solution)| body::state(report, heading, solution));
    std::iter::once(body::answer(report) + &margins).chain(states).collect()
}

/// Returns the section of a page about limits: the conclusion, and a table of the modes.
pub fn limits_part(report: &LimitsReport) -> String {
    body::limits_of(report)
}

/// Returns the section of a page about rest: whether it holds, and what is known of its load.
pub fn rest_part(report: &HoldReport) -> String {
    summary::part("At rest", &[report.verdict_in_words()])
}

/// The head of the page, which goes on until the body begins.
fn head(title: &str) -> String {
    let filled = |part: &str| {
        let Some((name, rest)) = part.split_once(" }}") else { return part.to_owned() };
        let value = match name {
            "title" => text(title),
            "light" => variables(&LIGHT),
            "dark" => variables(&DARK),
            "rules" => rules(&Colour::variables()),
            other => unreachable!("head.html has no `{other}`"),
        };
        value + rest
    };
    HEAD.split("{{ ").map(filled).collect()
}

/// A style sheet for the drawings and parts of answers in pages of others and in shadow trees: the colours as CSS
/// variables, dark where the reader's machine asks for it or `data-theme` is "dark", and the rules of all classes.
pub fn stylesheet() -> String {
    let (light, dark) = (variables(&LIGHT), variables(&DARK));
    format!(
        ":root, :host {{ {light} }}\n\
         :root[data-theme=\"dark\"], :host([data-theme=\"dark\"]) {{ {dark} }}\n\
         @media (prefers-color-scheme: dark) {{\n  \
         :root:not([data-theme=\"light\"]), :host(:not([data-theme=\"light\"])) {{ {dark} }}\n}}\n{}",
        rules(&Colour::variables())
    )
}

/// The parts one after the other.
fn all<T>(items: impl IntoIterator<Item = T>, part: impl Fn(T) -> String) -> String {
    items.into_iter().map(part).collect()
}

/// Text, escaped, with its lines.
fn text(text: &str) -> String {
    let lines = lines(text);
    lines.split('\n').map(escaped).collect::<Vec<_>>().join("\n")
}

/// The colours of a theme as CSS variables.
fn variables(theme: &Theme) -> String {
    let Colour { background, ink, muted, body, reaction, friction, load, velocity, warning } =
        Colour::of_theme(theme);
    format!(
        "--background: {background}; --ink: {ink}; --muted: {muted}; --body: {body}; --reaction: {reaction}; \
         --friction: {friction}; --load: {load}; --velocity: {velocity}; --warning: {warning};"
    )
}
