//! The answers about a model on a page: to every question that can be asked without further arguments.

use super::{Figure, Page, to_html};
use crate::coordinate::NotFinite;
use crate::drawing::{Forces, Sheet, pieces, title};
use crate::plot::{self, limits_figure, to_svg};
use crate::theme::{DARK, LIGHT};
use slideway::configuration::Configuration;
use slideway::drive::{DriveOptions, drive_with};
use slideway::fault::Faults;
use slideway::limits::{FRICTION, LimitsOptions, LimitsReport, Quantity, Vary, curves_with};
use slideway::mechanism::Mechanism;
use slideway::model::{Model, ParameterRange, Setting, Settings};
use slideway::progress::{Callback, Progress};
use slideway::report::SolveReport;
use slideway::solve::{SolveOptions, solve_with};
use slideway::standstill::{HoldOptions, HoldReport, hold_with, only_load};

/// The answers about a model that a page shows.
#[derive(Debug, Clone)]
pub struct Findings {
    title: String,
    at_middle: Vec<String>,
    drawings: Vec<Sheet>,
    answer: Result<SolveReport, Vec<String>>,
    efficiency: Vec<String>,
    rest: Result<HoldReport, Vec<String>>,
    limits: Vec<(LimitsReport, plot::Figure)>,
}

/// Where findings come from.
#[derive(Debug, Clone, Copy)]
pub struct Origin<'a> {
    /// The command that makes the page.
    pub command: &'a str,
    /// Name of the model.
    pub name: &'a str,
    /// Text of the model file.
    pub text: &'a str,
    /// The changes of that text.
    pub settings: &'a Settings,
}

impl Findings {
    /// The solutions of a model, the efforts of its drives, whether it stays at rest, and the limits of what is
    /// wanted; unless something is wanted those of friction, if the model has any. What cannot be answered has
    /// its reasons on the page. Nothing if the callback ended the work.
    ///
    /// # Errors
    /// Faults of the mechanism, and of what is wanted.
    pub fn of(model: &Model, wanted: Vec<Vary>, callback: &mut Callback<'_>) -> Result<Option<Self>, Faults> {
        let mechanism = Mechanism::new(model)?;
        let configuration = Configuration::new(&mechanism)?;
        let mut is_whole = true;
        let mut look = |progress: &Progress| {
            let flow = callback(progress);
            is_whole &= flow.is_continue();
            flow
        };
        let answer =
            solve_with(model, &SolveOptions::default(), &mut look).map_err(|faults| reasons(&faults));
        let rest = at_rest(model, answer.as_ref().ok(), &mut look);
        let forces = Forces::of(answer.as_ref().ok(), rest.as_ref().ok());
        let drawings = pieces(&mechanism, &configuration, forces, None, f64::INFINITY);
        let title = title(&mechanism);
        let limits = varied(model, wanted, &mut look)?;
        let efficiency = efficiency(model, &mut look);
        let limits = limits.filter(|_| is_whole);
        let at_middle = at_middle(model)?;
        Ok(limits.map(|limits| Self { title, at_middle, drawings, answer, efficiency, rest, limits }))
    }

    /// The page as HTML.
    ///
    /// # Errors
    /// If a place, a size or a value in its pictures is infinite or undefined.
    pub fn to_html(&self, origin: &Origin<'_>) -> Result<String, NotFinite> {
        let settings: Vec<String> = origin.settings.entries().iter().map(Setting::text).collect();
        let figure = |(limits, plot): &(LimitsReport, plot::Figure)| {
            let plot = plot.clone().changed_by(origin.settings);
            let caption = format!("Normal forces of the contacts over {}.", limits.vary.name);
            Ok(Figure { caption, light: to_svg(&plot, &LIGHT)?, dark: to_svg(&plot, &DARK)? })
        };
        let figures = self.limits.iter().map(figure).collect::<Result<Vec<_>, NotFinite>>()?;
        let limits: Vec<LimitsReport> = self.limits.iter().map(|(limits, _)| limits.clone()).collect();
        to_html(&Page {
            command: origin.command,
            name: origin.name,
            text: origin.text,
            settings: &settings,
            title: &self.title,
            at_middle: &self.at_middle,
            drawings: &self.drawings,
            report: self.answer.as_ref().map_err(Vec::as_slice),
            efficiency: &self.efficiency,
            rest: self.rest.as_ref().map_err(Vec::as_slice),
            limits: &limits,
            figures: &figures,
        })
    }
}

/// Returns in words why a question is not answered, and what to do about it: a line for each fault.
pub fn reasons(faults: &Faults) -> Vec<String> {
    faults.sorted().iter().map(|fault| fault.kind.with_hint()).collect()
}

/// The parameters that are known within bounds, with the middle for which the page holds: "mu = 0.25 (0.2 to 0.3)".
///
/// # Errors
/// Values that the model must not have.
fn at_middle(model: &Model) -> Result<Vec<String>, Faults> {
    let one = |range: ParameterRange| {
        let [from, to, middle] = [range.from, range.to, range.middle].map(|value| range.shown_in.show(value));
        format!("{} = {middle} ({from} to {to})", range.name)
    };
    Ok(model.ranges()?.into_iter().map(one).collect())
}

/// Which efforts the drives need, in sentences, or why that is not known; nothing without drives.
fn efficiency(model: &Model, callback: &mut Callback<'_>) -> Vec<String> {
    if model.drives.is_empty() {
        return Vec::new();
    }
    match drive_with(model, &DriveOptions::default(), callback) {
        Ok(report) => report.map(|report| report.conclusion).unwrap_or_default(),
        Err(faults) => reasons(&faults),
    }
}

/// Whether it stays at rest, or why that is not known; no reason where the work was ended. Where rest is the question, as there
/// is no answer in motion, also up to which size it holds the load, if there is only one.
///
/// # Errors
/// The reasons, in words.
pub fn at_rest(
    model: &Model,
    solved: Option<&SolveReport>,
    callback: &mut Callback<'_>,
) -> Result<HoldReport, Vec<String>> {
    let mut options = HoldOptions::default();
    options.load = only_load(model).ok().filter(|_| solved.is_none());
    let found = hold_with(model, &options, callback);
    found.map_err(|faults| reasons(&faults))?.ok_or_else(Vec::new)
}

/// The limits of what is wanted, with their plots. Unless something is wanted these are those of friction, if
/// the model has any; nothing if the work was ended.
fn varied(
    model: &Model,
    wanted: Vec<Vary>,
    callback: &mut Callback<'_>,
) -> Result<Option<Vec<(LimitsReport, plot::Figure)>>, Faults> {
    if wanted.is_empty() {
        return Ok(match limits(model, Vary::usual(FRICTION), callback) {
            Ok(found) => found.map(|found| vec![found]),
            Err(_) => Some(Vec::new()),
        });
    }
    wanted.into_iter().map(|vary| limits(model, vary, callback)).collect()
}

fn limits(
    model: &Model,
    vary: Vary,
    callback: &mut Callback<'_>,
) -> Result<Option<(LimitsReport, plot::Figure)>, Faults> {
    let found = curves_with(model, &LimitsOptions::new(vary), Quantity::NormalForce, callback)?;
    Ok(found.map(|(report, curves)| {
        // The page has the title of the model at its beginning.
        let mut untitled = report.clone();
        untitled.title = None;
        let plot = limits_figure(&untitled, &curves);
        (report, plot)
    }))
}
