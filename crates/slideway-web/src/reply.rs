//! Asks the library.

use crate::Reply;
use crate::library::entries;
use crate::look::look;
use crate::question::{Asked, Question, ThemeName, vary};
use crate::saved::saved;
use crate::told_fault::{ToldFault, told};
use serde::Serialize;
use slideway::check::check;
use slideway::choice::Choice;
use slideway::configuration::Configuration;
use slideway::drive::drive_with;
use slideway::fault::{Fault, FaultKind, Faults};
use slideway::limits::{LimitsOptions, Quantity, curves_with, limits_with, rest_limits_with};
use slideway::map::{ColourBy, MapOptions, map_with};
use slideway::mechanism::Mechanism;
use slideway::model::{Setting, SettingKind};
use slideway::motion::{self, SimulateOptions};
use slideway::progress::Callback;
use slideway::report::{Report, Style, finite};
use slideway::solve::{SolveOptions, solve_with};
use slideway::standstill::{HoldOptions, hold_with};
use slideway::{DriveOptions, Model};
use slideway_pictures::NotFinite;
use slideway_pictures::drawing::svg::{Colours, write};
use slideway_pictures::drawing::{Forces, Sheet, Shown, asks_for_rest, sheet};
use slideway_pictures::motion::{AnimationOptions, animation};
use slideway_pictures::page::{at_rest, limits_part, stylesheet};
use slideway_pictures::plot::{self, limits_figure};
use slideway_pictures::{map, theme};

/// A report of the library.
#[derive(Debug, Default, Serialize)]
struct Told {
    /// As JSON: what the command line writes with `--format json`.
    json: String,
    /// For people.
    text: String,
    /// As a table, where it is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    csv: Option<String>,
    /// Sections of HTML, in which all text of the model is escaped.
    #[serde(skip_serializing_if = "Option::is_none")]
    section: Option<String>,
    /// A picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    svg: Option<String>,
    /// The frames of a moving picture, as JSON.
    #[serde(skip_serializing_if = "Option::is_none")]
    film: Option<String>,
}

impl Told {
    fn of(report: &impl Report) -> Self {
        Self { json: report.json(), text: report.text(Style::PLAIN), ..Self::default() }
    }
}

/// Why there is no answer.
enum Refusal {
    Faults(Faults),
    NotFinite(NotFinite),
}

impl From<Faults> for Refusal {
    fn from(faults: Faults) -> Self {
        Self::Faults(faults)
    }
}

impl From<NotFinite> for Refusal {
    fn from(fault: NotFinite) -> Self {
        Self::NotFinite(fault)
    }
}

/// An answer; nothing if the callback ended the work.
type Answered<T> = Result<Option<T>, Refusal>;

/// The answer to a question, as JSON.
pub(crate) fn reply(question: &Question, callback: &mut Callback<'_>) -> String {
    match question {
        Question::Library => Reply::Answer(entries()).json(),
        Question::Style => Reply::Answer(stylesheet()).json(),
        Question::Look { of, margins, drawn } => {
            written(of, look(of, *drawn, *margins, callback).map(Some).map_err(Refusal::from))
        }
        Question::Save(of) => written(of, saved(of).map(Some).map_err(Refusal::from)),
        Question::Check(of) => written(of, checked(of)),
        Question::Solve(of) => written(of, solved(of, callback)),
        Question::Hold { of, load } => written(of, held(of, load.as_deref(), callback)),
        Question::Drive(of) => written(of, driven(of, callback)),
        Question::Limits { of, vary, plot, theme } => {
            written(of, limited(of, vary, plot.then_some(*theme), callback))
        }
        Question::Map { of, x, y, colour_by, size, theme } => {
            written(of, mapped(of, [x, y], (colour_by, *size, *theme), callback))
        }
        Question::Simulate { of, until, frames, table } => {
            written(of, simulated(of, until, [*frames, *table], callback))
        }
        Question::Draw { of, theme } => written(of, drawn(of, *theme, callback)),
    }
}

fn written<T: Serialize>(asked: &Asked, answered: Answered<T>) -> String {
    match answered {
        Ok(Some(answer)) => Reply::Answer(answer),
        Ok(None) => Reply::Stopped(()),
        Err(Refusal::Faults(faults)) => Reply::Faults(told(&faults, asked)),
        Err(Refusal::NotFinite(fault)) => Reply::Faults(vec![ToldFault::general(&fault.to_string())]),
    }
    .json()
}

fn checked(of: &Asked) -> Answered<Told> {
    Ok(Some(Told::of(&check(&of.model()?)?)))
}

fn solved(of: &Asked, callback: &mut Callback<'_>) -> Answered<Told> {
    let report = solve_with(&of.model()?, &SolveOptions::default(), callback)?;
    Ok(Some(Told { csv: Some(report.csv()), ..Told::of(&report) }))
}

fn held(of: &Asked, load: Option<&str>, callback: &mut Callback<'_>) -> Answered<Told> {
    let mut options = HoldOptions::default();
    options.load = load.map(str::to_owned);
    Ok(hold_with(&of.model()?, &options, callback)?.map(|report| Told::of(&report)))
}

fn driven(of: &Asked, callback: &mut Callback<'_>) -> Answered<Told> {
    Ok(drive_with(&of.model()?, &DriveOptions::default(), callback)?.map(|report| Told::of(&report)))
}

fn limited(
    of: &Asked,
    varied: &str,
    plotted: Option<ThemeName>,
    callback: &mut Callback<'_>,
) -> Answered<Told> {
    let model = of.model()?;
    let options = LimitsOptions::new(vary(varied)?);
    let (report, svg) = match plotted {
        None => match limits_with(&model, &options, callback) {
            Ok(report) => (report, None),
            // Where motion has no answer, as what moves has no mass, rest is the question.
            Err(faults) => {
                let rest = rest_limits_with(&model, &options.vary, &HoldOptions::default(), callback);
                return Ok(rest.map_err(|_| faults)?.map(|report| Told::of(&report)));
            }
        },
        Some(theme) => match curves_with(&model, &options, Quantity::NormalForce, callback)? {
            None => (None, None),
            Some((report, curves)) => {
                let figure = limits_figure(&report, &curves).changed_by(&of.settings);
                (Some(report), Some(plot::to_svg(&figure, theme.colours())?))
            }
        },
    };
    Ok(report.map(|report| Told { section: Some(limits_part(&report)), svg, ..Told::of(&report) }))
}

fn mapped(
    of: &Asked,
    [x, y]: [&str; 2],
    (colour_by, [width, height], theme): (&str, [usize; 2], ThemeName),
    callback: &mut Callback<'_>,
) -> Answered<Told> {
    let model = of.model()?;
    let colour_by = ColourBy::of_word(colour_by).unwrap_or_default();
    let options = MapOptions::new(vary(x)?, vary(y)?).size(width, height).colour_by(colour_by);
    let Some(report) = map_with(&model, &options, callback)? else { return Ok(None) };
    let svg = map::to_svg(&report, &of.settings, theme.colours())?;
    Ok(Some(Told { svg: Some(svg), ..Told::of(&report) }))
}

fn simulated(
    of: &Asked,
    until: &str,
    [frames, table]: [bool; 2],
    callback: &mut Callback<'_>,
) -> Answered<Told> {
    let model = of.model()?;
    let mechanism = Mechanism::new(&model)?;
    let options = SimulateOptions::new(duration(&model, mechanism.time, until)?).with_events_of(&mechanism);
    let configuration = Configuration::new(&mechanism)?;
    let history =
        motion::simulate_with(&mechanism, &configuration, &options, &mut motion::Thorough, callback)?;
    let report = finite(motion::report(&history, &options))?;
    let film = if frames {
        let animation = animation(&history, &AnimationOptions::default(), &theme::LIGHT);
        Some(serde_json::to_string(&animation.film()?).expect("plain data with text keys"))
    } else {
        None
    };
    let csv = if table {
        let times: Vec<f64> = history.times().collect();
        Some(finite(history.series(&times))?.csv())
    } else {
        None
    };
    Ok(Some(Told { csv, film, ..Told::of(&report) }))
}

/// From the time of the state to that of the end (s).
fn duration(model: &Model, start: f64, until: &str) -> Result<f64, Faults> {
    let end = model.setting_value(&Setting::new(SettingKind::Time, "until", until.trim()));
    // The text is none of the settings of the state.
    let end = end.map_err(|faults| {
        let mut all = Faults::default();
        all.extend(faults.sorted().into_iter().map(|fault| Fault::general(fault.kind.clone())));
        all
    })?;
    if end > start {
        Ok(end - start)
    } else {
        Err(Fault::general(FaultKind::NothingToSimulate { start, end }).into())
    }
}

/// The sheet of `slideway draw`, with the colours of a theme written into it.
fn drawn(of: &Asked, theme: ThemeName, callback: &mut Callback<'_>) -> Answered<Told> {
    let model = of.model()?;
    let mechanism = Mechanism::new(&model)?;
    let configuration = Configuration::new(&mechanism)?;
    let solved = solve_with(&model, &SolveOptions::default(), callback);
    let known = solved.as_ref().ok();
    let rest = asks_for_rest(known).then(|| at_rest(&model, known, callback).ok()).flatten();
    let drawn = sheet(&mechanism, &configuration, Forces::of(known, rest.as_ref()), Shown::All);
    let Some(sheet) = drawn else { return Ok(None) };
    let has_forces = rest.is_some_and(|rest| rest.at_rest.is_some());
    let sheet = solved.err().iter().filter(|_| !has_forces).fold(sheet, Sheet::unsolved);
    let sheet = sheet.changed_by(&of.settings);
    Ok(Some(Told {
        svg: Some(write(&sheet.scene, &sheet.frame(None, Colours::Theme(*theme.colours())))?),
        text: sheet.description.clone(),
        ..Told::default()
    }))
}
