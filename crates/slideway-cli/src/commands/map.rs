//! `slideway map`

use crate::Outcome;
use crate::arguments::{Destination, MapArguments};
use crate::failure::Failure;
use crate::input::Input;
use crate::output::{Output, ProgressLine};
use crate::picture::Picture;
use slideway::map::{MapOptions, MapProgress, map_with, to_json};
use slideway_pictures::map::to_svg;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Maps that take less time show no progress.
const QUIET: Duration = Duration::from_secs(1);

/// Maps the plane of two quantities.
pub(crate) fn map(arguments: &MapArguments, output: &Output) -> Result<Outcome, Failure> {
    let destination = Destination { output: Some(arguments.output.clone()), force: arguments.force };
    arguments.model.spare(&destination)?;
    let picture = Picture::unless_json(&arguments.output)?;
    let output = output.to(&destination)?;
    let input = Input::read(&arguments.model)?;
    let model = input.model()?;
    let [width, height] = arguments.size;
    let options = MapOptions {
        x: arguments.x.clone(),
        y: arguments.y.clone(),
        width,
        height,
        colour_by: arguments.colour_by.into(),
        probe: usize::from(arguments.probe),
    };
    let (start, mut line) = (Instant::now(), ProgressLine::new());
    let mut progress = |progress: MapProgress| {
        if start.elapsed() >= QUIET {
            line.show(&format!("{} points, {} s", progress.points, start.elapsed().as_secs()));
        }
        ControlFlow::Continue(())
    };
    let report = map_with(&model, &options, &mut progress).map_err(|faults| input.refused(faults))?;
    drop(line);
    let report = report.unwrap_or_default();
    match picture {
        None => output.write(&to_json(&report))?,
        Some(picture) => picture.write(&to_svg(&report, arguments.theme.colours()), &output)?,
    }
    Ok(Outcome::Done)
}
