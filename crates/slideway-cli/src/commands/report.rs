//! `slideway report`

use crate::arguments::ReportArguments;
use crate::failure::Failure;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::Watch;
use slideway::configuration::Configuration;
use slideway::drive::{DriveOptions, drive_with};
use slideway::fault::Faults;
use slideway::limits::{LimitsOptions, LimitsReport, Quantity, Vary, curves_with};
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::solve::{SolveOptions, solve_with};
use slideway::standstill::{HoldOptions, HoldReport, hold_with};
use slideway_pictures::NotFinite;
use slideway_pictures::drawing::{pieces, title};
use slideway_pictures::page::{Figure, Page, to_html};
use slideway_pictures::plot::{self, limits_figure, to_svg};
use slideway_pictures::theme::{DARK, LIGHT};
use std::ffi::OsStr;
use std::path::Path;

const ENDINGS: [&str; 2] = [".html", ".htm"];

/// Writes a page with the model, its drawing, its solutions and limits.
pub(crate) fn report(arguments: &ReportArguments, output: &Output) -> Result<Outcome, Failure> {
    if let Some(path) = &arguments.destination.output {
        be_a_page(path)?;
    }
    let output = output.to(&arguments.destination, Some(&arguments.model.file))?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let mechanism = Mechanism::new(&model).map_err(|faults| input.refused(faults))?;
    let configuration = Configuration::new(&mechanism).map_err(|faults| input.refused(faults))?;
    let mut watch = Watch::new(arguments.time.time_limit);
    let answer = solve_with(&model, &SolveOptions::default(), &mut |progress| watch.look(progress))
        .map_err(|faults| reasons(&faults));
    let wanted = arguments.vary.iter().map(|vary| input.vary(&model, vary)).collect::<Result<Vec<_>, _>>()?;
    let varied = varied(&model, wanted, &mut watch).map_err(|faults| input.refused(faults))?;
    let efficiency = efficiency(&model, &mut watch);
    let rest = rest(&model, &mut watch);
    let is_whole = watch.halt().is_none();
    let varied = watch.whole(varied.filter(|_| is_whole))?;
    let (limits, plots): (Vec<_>, Vec<_>) = varied.into_iter().unzip();
    let plots = plots.into_iter().map(|plot: plot::Figure| plot.changed_by(&input.settings));
    let figures = limits.iter().zip(plots).map(|(limits, plot)| figure(limits, &plot));
    let figures = figures.collect::<Result<Vec<_>, _>>()?;
    let settings: Vec<String> = input.settings.entries().iter().map(slideway::model::Setting::text).collect();
    let page = Page {
        command: &command(arguments, &input, &settings),
        name: &input.name,
        text: &input.text(),
        settings: &settings,
        title: &title(&mechanism),
        drawings: &pieces(&mechanism, &configuration, answer.as_ref().ok()),
        report: answer.as_ref().map_err(Vec::as_slice),
        efficiency: &efficiency,
        rest: rest.as_ref().map_err(Vec::as_slice),
        limits: &limits,
        figures: &figures,
    };
    let html = to_html(&page)?;
    output.write(&html)?;
    Ok(Outcome::Done)
}

/// Refuses the ending of another format, such as one that a browser can print; a file may have no ending.
fn be_a_page(path: &Path) -> Result<(), Failure> {
    let is_known = |ending: &OsStr| ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(&known[1..]));
    if path.extension().is_none_or(is_known) {
        return Ok(());
    }
    Err(Failure::FileFormat { path: path.to_owned(), known: &ENDINGS })
}

/// What keeps the kinetic problem from being solved, in words.
pub(super) fn reasons(faults: &Faults) -> Vec<String> {
    faults.sorted().iter().map(|fault| fault.kind.to_string()).collect()
}

/// Which efforts the drives need, in sentences, or why that is not known; nothing without drives.
fn efficiency(model: &Model, watch: &mut Watch) -> Vec<String> {
    if model.drives.is_empty() {
        return Vec::new();
    }
    match drive_with(model, &DriveOptions::default(), &mut |progress| watch.look(progress)) {
        Ok(report) => report.map(|report| report.conclusion).unwrap_or_default(),
        Err(faults) => reasons(&faults),
    }
}

/// Whether it stays at rest, or why that is not known; no reason where the work was ended.
fn rest(model: &Model, watch: &mut Watch) -> Result<HoldReport, Vec<String>> {
    let found = hold_with(model, &HoldOptions::default(), &mut |progress| watch.look(progress));
    found.map_err(|faults| reasons(&faults))?.ok_or_else(Vec::new)
}

/// The limits of what is wanted, with their plots. Unless something is wanted these are those of friction, if
/// the model has any; nothing if the work was ended.
fn varied(
    model: &Model,
    wanted: Vec<Vary>,
    watch: &mut Watch,
) -> Result<Option<Vec<(LimitsReport, plot::Figure)>>, Faults> {
    if wanted.is_empty() {
        return Ok(match limits(model, Vary::usual(slideway::limits::FRICTION), watch) {
            Ok(found) => found.map(|found| vec![found]),
            Err(_) => Some(Vec::new()),
        });
    }
    wanted.into_iter().map(|vary| limits(model, vary, watch)).collect()
}

fn limits(
    model: &Model,
    vary: Vary,
    watch: &mut Watch,
) -> Result<Option<(LimitsReport, plot::Figure)>, Faults> {
    let options = LimitsOptions::new(vary);
    let found = curves_with(model, &options, Quantity::NormalForce, &mut |progress| watch.look(progress))?;
    let Some((report, curves)) = found else { return Ok(None) };
    // The page has the title of the model at its beginning.
    let mut untitled = report.clone();
    untitled.title = None;
    let plot = limits_figure(&untitled, &curves);
    Ok(Some((report, plot)))
}

/// A plot with what it shows.
fn figure(limits: &LimitsReport, plot: &plot::Figure) -> Result<Figure, NotFinite> {
    let caption = format!("Normal forces of the contacts over {}.", limits.vary.name);
    Ok(Figure { caption, light: to_svg(plot, &LIGHT)?, dark: to_svg(plot, &DARK)? })
}

/// The command that makes the page, as far as it matters for what is on it.
fn command(arguments: &ReportArguments, input: &Input, settings: &[String]) -> String {
    let mut words = vec!["slideway report".to_owned(), input.name.clone()];
    for (setting, text) in input.settings.entries().iter().zip(settings) {
        let option = match setting.kind {
            slideway::model::SettingKind::Parameter => "--set",
            slideway::model::SettingKind::Position => "--at",
            slideway::model::SettingKind::Rate => "--rate",
            _ => "--time",
        };
        let value = if option == "--time" { &setting.value.to_string() } else { text };
        words.push(format!("{option} \"{value}\""));
    }
    words.extend(arguments.model.units_option());
    words.extend(arguments.vary.iter().map(|vary| format!("--vary \"{vary}\"")));
    words.join(" ")
}
