//! `slideway map`

use crate::arguments::MapArguments;
use crate::columns::wrapped;
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::own_file::Document;
use crate::picture::{Picture, SHARPNESS};
use crate::watch::Watch;
use slideway::Report;
use slideway::map::{MapOptions, map_with};
use slideway_pictures::map::to_svg;

/// Maps the plane of two quantities.
pub(crate) fn map(arguments: &MapArguments, output: &Output) -> Result<Outcome, Failure> {
    let named = arguments.destination.file();
    let picture = named.map_or(Ok(Some(Picture::Svg)), Picture::unless_json)?;
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
    let named_after = (arguments.model.file.as_path(), "-map.svg");
    let document = Document::new(&mut files, &arguments.destination, named_after, arguments.open.open)?;
    let input =
        Input::read(&arguments.model, output.color())?.varying(arguments.x.iter().chain(&arguments.y));
    let model = input.model()?;
    let [width, height] = arguments.size;
    let (Some(x), Some(y)) = (&arguments.x, &arguments.y) else {
        return Err(input.nothing_varied(&model, "--x NAME=FROM..TO --y NAME=FROM..TO"));
    };
    let [x, y] = input.vary_both(&model, [x, y])?;
    let options = MapOptions::new(x, y)
        .size(width, height)
        .colour_by(arguments.colour_by)
        .probe(usize::from(arguments.probe));
    let mut watch = Watch::new(arguments.time.time_limit).whole_or_none(output.color());
    let report = map_with(&model, &options, &mut |progress| watch.look(progress));
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    match picture {
        None => document.output.write(&report.json())?,
        Some(picture) => {
            let svg = to_svg(&report, &input.settings, arguments.theme.colours());
            picture.write_scaled(svg, SHARPNESS, &document.output)?;
            if document.output.path().is_some() {
                let lines = wrapped(&report.answer(), output.style().width);
                output.write(&format!("{}\n", lines.join("\n")))?;
            }
        }
    }
    document.finish(output)?;
    Ok(Outcome::Done)
}
