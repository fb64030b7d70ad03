//! `slideway size`

use crate::arguments::SizeArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::picture;
use crate::watch::Watch;
use slideway::size::{self, SizeOptions};
use slideway_pictures::plot::{size_figure, to_svg};

/// Finds the value of a parameter at which a margin is just met.
pub(crate) fn size(arguments: &SizeArguments, output: &Output) -> Result<Outcome, Failure> {
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
    let plot = picture::beside(&arguments.plot, &mut files)?;
    let output = files.answer()?;
    let input = Input::read(&arguments.model, output.color())?.varying(&arguments.vary);
    let model = input.model()?;
    let vary = input.wanted(&model, arguments.vary.as_deref())?;
    let mut watch = Watch::new(arguments.time.time_limit).whole_or_none(output.color());
    let report = arguments.against(&model).and_then(|against| {
        let options = SizeOptions::new(vary, arguments.wanted())
            .against(against)
            .typed_in(arguments.typed_in())
            .both_directions(arguments.both_directions);
        size::size_with(&model, &options, &mut |progress| watch.look(progress))
    });
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    if let Some((picture, file)) = plot {
        let svg = to_svg(&size_figure(&report).changed_by(&input.settings), arguments.plot.theme.colours());
        picture.write(svg, &file)?;
    }
    output.tell(&report, arguments.format)?;
    Ok(if report.met.is_empty() { Outcome::NoSolution } else { Outcome::Done })
}
