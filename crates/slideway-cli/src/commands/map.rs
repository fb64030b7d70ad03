//! `slideway map`

use crate::arguments::{Destination, MapArguments};
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::picture::Picture;
use crate::watch::Watch;
use slideway::Report;
use slideway::map::{MapOptions, map_with};
use slideway_pictures::map::to_svg;

/// Maps the plane of two quantities.
pub(crate) fn map(arguments: &MapArguments, output: &Output) -> Result<Outcome, Failure> {
    let destination = Destination { output: Some(arguments.output.clone()), force: arguments.force };
    let picture = Picture::unless_json(&arguments.output)?;
    let output = Files::new(output, &destination, Some(&arguments.model.file)).answer()?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let [width, height] = arguments.size;
    let [x, y] = input.vary_both(&model, [&arguments.x, &arguments.y])?;
    let options = MapOptions::new(x, y)
        .size(width, height)
        .colour_by(arguments.colour_by)
        .probe(usize::from(arguments.probe));
    let mut watch = Watch::new(arguments.time.time_limit);
    let report = map_with(&model, &options, &mut |progress| watch.look(progress));
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    match picture {
        None => output.write(&report.json())?,
        Some(picture) => {
            picture.write(to_svg(&report, &input.settings, arguments.theme.colours()), &output)?;
        }
    }
    Ok(Outcome::Done)
}
