//! `slideway draw`

use crate::Outcome;
use crate::arguments::{DrawArguments, Which};
use crate::failure::Failure;
use crate::input::Input;
use crate::output::Output;
use slideway::configuration::Configuration;
use slideway::fault::Faults;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::report::Report;
use slideway::solve::solve;
use slideway_pictures::drawing::svg::{self, Colours, Frame};
use slideway_pictures::drawing::{Sheet, Shown, sheet};
use slideway_pictures::raster::png;
use slideway_pictures::theme::{DARK, LIGHT};
use std::path::Path;

/// Pixels of a PNG for each drawing unit, unless a width is wanted.
const SHARPNESS: f64 = 2.0;

/// Draws a mechanism and its solutions.
pub(crate) fn draw(arguments: &DrawArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = output.to(&arguments.destination)?;
    arguments.model.spare(&arguments.destination)?;
    let is_png = is_png(arguments.destination.output.as_deref())?;
    let input = Input::read(&arguments.model)?;
    let model = input.model()?;
    let mechanism = Mechanism::new(&model).map_err(|faults| input.refused(faults))?;
    let configuration = Configuration::new(&mechanism).map_err(|faults| input.refused(faults))?;
    let report = solutions(&model, arguments.solution).map_err(|faults| input.refused(faults))?;
    let shown = match arguments.solution {
        None | Some(Which::All) => Shown::All,
        Some(Which::None) => Shown::Mechanism,
        Some(Which::Number(number)) => Shown::Solution(number),
    };
    let Some(sheet) = sheet(&mechanism, &configuration, report.as_ref(), shown) else {
        let count = report.map_or(0, |report| report.solutions.len());
        return Err(Failure::NoSuchSolution { count });
    };
    if is_png {
        let scale = arguments.width.map_or(SHARPNESS, |width| width / sheet.bounds.size().x);
        let picture = png(&written(&sheet, arguments.dark, None), scale).map_err(Failure::NoPicture)?;
        output.write_bytes(&picture)?;
    } else {
        output.write(&written(&sheet, arguments.dark, arguments.width))?;
    }
    Ok(Outcome::Done)
}

/// All solutions, if they are wanted. Where only the kinetic problem makes no sense (a mechanism at rest, a motion
/// without inertia) the mechanism can be drawn all the same, unless solutions are asked for.
fn solutions(model: &Model, which: Option<Which>) -> Result<Option<Report>, Faults> {
    match which {
        Some(Which::None) => Ok(None),
        None => Ok(solve(model).ok()),
        Some(_) => solve(model).map(Some),
    }
}

fn written(sheet: &Sheet, dark: bool, width: Option<f64>) -> String {
    let frame = Frame {
        bounds: sheet.bounds,
        title: &sheet.title,
        description: &sheet.description,
        width,
        colours: Colours::Theme(if dark { DARK } else { LIGHT }),
    };
    svg::write(&sheet.scene, &frame)
}

/// Whether the picture is one of pixels, by the ending of its file; SVG on standard output.
fn is_png(path: Option<&Path>) -> Result<bool, Failure> {
    let Some(path) = path.filter(|path| path.as_os_str() != "-") else { return Ok(false) };
    match path.extension().and_then(|ending| ending.to_str()).map(str::to_lowercase).as_deref() {
        Some("svg") => Ok(false),
        Some("png") => Ok(true),
        _ => Err(Failure::PictureFormat { path: path.to_owned() }),
    }
}
