//! What the template of a page is filled with.

use super::Page;
use crate::drawing::svg::{self, Colour, Colours, Frame};
use crate::theme::{DARK, LIGHT, Theme};
use serde::Serialize;
use slideway::limits::LimitsReport;
use slideway::report::{Solution, SolveReport, followed};
use std::fmt::Write;

/// The values of the template.
#[derive(Serialize)]
pub(super) struct Context<'a> {
    command: &'a str,
    version: &'static str,
    name: &'a str,
    title: &'a str,
    text: &'a str,
    settings: &'a [String],
    /// CSS variables of both themes, and the rules of drawings.
    light: String,
    dark: String,
    rules: String,
    drawing: String,
    report: Option<&'a SolveReport>,
    /// Why there is no report.
    refused: &'a [String],
    /// How the positions were reached.
    followed: Option<String>,
    answer: String,
    states: Vec<StateView<'a>>,
    limits: &'a [LimitsReport],
    figures: Vec<FigureView<'a>>,
}

/// A solution or preload-gap state.
#[derive(Serialize)]
struct StateView<'a> {
    heading: String,
    attainability: String,
    solution: &'a Solution,
}

/// A figure in both themes, as addresses that hold the pictures themselves.
#[derive(Serialize)]
struct FigureView<'a> {
    caption: &'a str,
    light: String,
    dark: String,
}

impl<'a> Context<'a> {
    pub(super) fn of(page: &Page<'a>) -> Self {
        let report = page.report.ok();
        Self {
            command: page.command,
            version: env!("CARGO_PKG_VERSION"),
            name: page.name,
            title: &page.sheet.title,
            text: page.text,
            settings: page.settings,
            light: variables(&LIGHT),
            dark: variables(&DARK),
            rules: svg::rules(&Colour::variables()),
            drawing: drawing(page),
            report,
            refused: page.report.err().unwrap_or_default(),
            followed: report.and_then(|report| report.steps_from_drawing).map(followed),
            answer: report.map(crate::drawing::answer).unwrap_or_default(),
            states: report.map(states).unwrap_or_default(),
            limits: page.limits,
            figures: page
                .figures
                .iter()
                .map(|figure| FigureView {
                    caption: &figure.caption,
                    light: address(&figure.light),
                    dark: address(&figure.dark),
                })
                .collect(),
        }
    }
}

fn drawing(page: &Page<'_>) -> String {
    let frame = Frame {
        bounds: page.sheet.bounds,
        title: &page.sheet.title,
        description: &page.sheet.description,
        width: None,
        colours: Colours::Page,
    };
    svg::document(&page.sheet.scene, &frame)
}

fn states(report: &SolveReport) -> Vec<StateView<'_>> {
    let view = |kind: &str, index: usize, count: &str, solution| StateView::of(kind, index, count, solution);
    let solutions = report.solutions.iter().enumerate();
    let gaps = report.preload_gap_states.iter().enumerate();
    solutions
        .map(|(index, solution)| view("Solution", index, &report.count, solution))
        .chain(gaps.map(|(index, state)| view("Preload gap", index, &report.gap_state_count, state)))
        .collect()
}

impl<'a> StateView<'a> {
    fn of(kind: &str, index: usize, count: &str, solution: &'a Solution) -> Self {
        Self {
            heading: format!("{kind} {} of {count}: {}", index + 1, crate::drawing::signs(&solution.pattern)),
            attainability: solution.attainability.in_words(),
            solution,
        }
    }
}

/// The colours of a theme as CSS variables.
fn variables(theme: &Theme) -> String {
    let Colour { background, ink, muted, body, reaction, friction, load, velocity } = Colour::of_theme(theme);
    format!(
        "--background: {background}; --ink: {ink}; --muted: {muted}; --body: {body}; --reaction: {reaction}; \
         --friction: {friction}; --load: {load}; --velocity: {velocity};"
    )
}

/// A picture as an address that holds all of it (RFC 2397).
fn address(svg: &str) -> String {
    let mut out = String::from("data:image/svg+xml,");
    for byte in svg.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'~' | b'/' | b':' | b'=' => {
                out.push(char::from(byte));
            }
            other => {
                let _ = write!(out, "%{other:02X}");
            }
        }
    }
    out
}
