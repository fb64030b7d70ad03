//! A report as one page of HTML that needs nothing else: no network, no other file, no script.
//!
//! Light or dark as the reader's machine asks for, and with a style for print. The drawing is part of the page; figures are
//! pictures within it, in both themes.

mod context;

use crate::coordinate::finished;
use crate::drawing::Sheet;
use crate::escaped;
use context::Context;
use minijinja::{AutoEscape, Environment, Output, State, Value};
use slideway::limits::LimitsReport;
use slideway::printable::lines;
use slideway::report::SolveReport;
use thiserror::Error;

const TEMPLATE: &str = include_str!("report.html");

/// What a page tells.
#[derive(Debug, Clone, Copy)]
pub struct Page<'a> {
    /// The command that made it.
    pub command: &'a str,
    /// Name of the model.
    pub name: &'a str,
    /// Text of the model file.
    pub text: &'a str,
    /// What was changed in it, one line each.
    pub settings: &'a [String],
    /// The drawing of the mechanism and its solutions.
    pub sheet: &'a Sheet,
    /// All solutions, or why there is no answer.
    pub report: Result<&'a SolveReport, &'a [String]>,
    /// For which values modes exist.
    pub limits: &'a [LimitsReport],
    /// Further figures.
    pub figures: &'a [Figure],
}

/// A figure of a page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// What it shows.
    pub caption: String,
    /// The picture on a light background, as SVG.
    pub light: String,
    /// The picture on a dark background, as SVG.
    pub dark: String,
}

/// The page could not be filled: a number that cannot be drawn, or a fault of its template.
#[derive(Debug, Error)]
#[error("the page could not be made: {reason}")]
pub struct PageFault {
    /// What the template engine says.
    pub reason: String,
}

/// The page as HTML. Every name and text from the model is escaped, and its characters that are not seen stand as their
/// numbers ([`slideway::printable`]).
///
/// # Errors
/// If a place or a size in its drawing is infinite or undefined; a fault of the template, which the tests exclude.
pub fn to_html(page: &Page<'_>) -> Result<String, PageFault> {
    let fault = |error: minijinja::Error| PageFault { reason: format!("{error:#}") };
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.set_formatter(write_escaped);
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    environment.add_filter("number", |value: f64| crate::drawing::number(value));
    environment.add_filter("signs", |pattern: &str| crate::drawing::signs(pattern));
    environment.add_filter("precise", |value: f64| slideway::report::precise(value));
    environment.add_template("report.html", TEMPLATE).map_err(fault)?;
    let template = environment.get_template("report.html").map_err(fault)?;
    let html = template.render(Context::of(page)).map_err(fault)?;
    finished(html).map_err(|fault| PageFault { reason: fault.to_string() })
}

/// Writes a value of the template; text keeps its lines.
fn write_escaped(out: &mut Output<'_>, state: &State<'_, '_>, value: &Value) -> Result<(), minijinja::Error> {
    match value.as_str().filter(|_| !value.is_safe()) {
        Some(text) => {
            let lines: Vec<String> = lines(text).split('\n').map(escaped).collect();
            out.write_str(&lines.join("\n")).map_err(minijinja::Error::from)
        }
        None => minijinja::escape_formatter(out, state, value),
    }
}
