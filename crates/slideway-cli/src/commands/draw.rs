//! `slideway draw`

use crate::arguments::{DrawArguments, PictureTheme, Which};
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::own_file::Document;
use crate::picture::{Picture, SHARPNESS};
use crate::watch::{Watch, outcome};
use slideway::configuration::Configuration;
use slideway::fault::Faults;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::report::{SolveReport, Status};
use slideway::solve::{SolveOptions, solve_with};
use slideway_pictures::NotFinite;
use slideway_pictures::drawing::svg::{self, Colours};
use slideway_pictures::drawing::{Forces, Sheet, Shown, asks_for_rest, sheet};
use slideway_pictures::page::at_rest;

/// Draws a mechanism and its solutions.
pub(crate) fn draw(arguments: &DrawArguments, output: &Output) -> Result<Outcome, Failure> {
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
    let named_after = (arguments.model.file.as_path(), ".svg");
    let document = Document::new(&mut files, &arguments.destination, named_after, arguments.open.open)?;
    let file = arguments.destination.output.as_deref().filter(|path| path.as_os_str() != "-");
    let picture = file.map_or(Ok(Picture::Svg), Picture::of)?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let mechanism = Mechanism::new(&model).map_err(|faults| input.refused(faults))?;
    let configuration = Configuration::new(&mechanism).map_err(|faults| input.refused(faults))?;
    let mut watch = Watch::new(arguments.time.time_limit);
    let solved = solutions(&model, arguments.solution, &mut watch).map_err(|faults| input.refused(faults))?;
    let (report, refused) = match solved.transpose() {
        Ok(report) => (report, None),
        Err(faults) => (None, Some(faults)),
    };
    let shown = match arguments.solution {
        None | Some(Which::All) => Shown::All,
        Some(Which::None) => Shown::Mechanism,
        Some(Which::Number(number)) => Shown::Solution(number),
    };
    let known = report.as_ref();
    let is_asked = shown == Shown::All && (known.is_some() || refused.is_some()) && asks_for_rest(known);
    let mut rest = || at_rest(&model, known, &mut |progress| watch.look(progress)).ok();
    let rest = if is_asked { rest() } else { None };
    let halt = watch.finish();
    let forces = Forces::of(known, rest.as_ref());
    let Some(sheet) = sheet(&mechanism, &configuration, forces, shown) else {
        if let Some(halt) = halt {
            return Err(Failure::Halted { halt, path: None });
        }
        let count = report.map_or(0, |report| report.solutions.len());
        return Err(Failure::NoSuchSolution { count });
    };
    let has_forces = rest.is_some_and(|rest| rest.at_rest.is_some());
    let sheet = refused.iter().filter(|_| !has_forces).fold(sheet, Sheet::unsolved);
    let sheet = sheet.changed_by(&input.settings);
    let sharpness = arguments.width.map_or(SHARPNESS, |width| width / sheet.bounds.size().x);
    let width = arguments.width.filter(|_| picture == Picture::Svg);
    picture.write_scaled(written(&sheet, arguments.theme, width), sharpness, &document.output)?;
    document.finish(output)?;
    let has_found = report.is_none_or(|report| report.status != Status::Unknown);
    Ok(outcome(halt, if has_found || halt.is_none() { Outcome::Done } else { Outcome::Unknown }))
}

/// All solutions, or why there is no answer; nothing if they are not wanted. Where only the kinetic problem makes no
/// sense (a mechanism at rest, a motion without inertia) the mechanism can be drawn all the same, unless solutions are
/// asked for.
fn solutions(
    model: &Model,
    which: Option<Which>,
    watch: &mut Watch,
) -> Result<Option<Result<SolveReport, Faults>>, Faults> {
    let mut solve = || solve_with(model, &SolveOptions::default(), &mut |progress| watch.look(progress));
    match which {
        Some(Which::None) => Ok(None),
        None => Ok(Some(solve())),
        Some(_) => solve().map(|report| Some(Ok(report))),
    }
}

fn written(sheet: &Sheet, theme: PictureTheme, width: Option<f64>) -> Result<String, NotFinite> {
    svg::write(&sheet.scene, &sheet.frame(width, Colours::Theme(*theme.colours())))
}
