//! `slideway limits`

use crate::arguments::LimitsArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::picture;
use crate::watch::Watch;
use slideway::limits::{self, LimitsOptions};
use slideway::progress::Progress;
use slideway_pictures::plot::{limits_figure, to_svg};

/// Says for which values each contact mode exists, and plots it if asked to.
pub(crate) fn limits(arguments: &LimitsArguments, output: &Output) -> Result<Outcome, Failure> {
    let mut files = Files::new(output, &arguments.destination, Some(&arguments.model.file));
    let plot = picture::beside(&arguments.plot, &mut files)?;
    let output = files.answer()?;
    let input = Input::read(&arguments.model, output.color())?.varying(&arguments.vary);
    let model = input.model()?;
    let options = LimitsOptions::new(input.wanted(&model, arguments.vary.as_deref())?)
        .max_reaction(arguments.max_reaction)
        .both_directions(arguments.both_directions)
        .effort(arguments.effort);
    let mut watch = Watch::new(arguments.time.time_limit).whole_or_none(output.color());
    let mut look = |progress: &Progress| watch.look(progress);
    let report = if let Some((picture, file)) = plot {
        let found = limits::curves_with(&model, &options, arguments.quantity, &mut look);
        let (report, curves) = watch.whole(found.map_err(|faults| input.refused(faults))?)?;
        let figure = limits_figure(&report, &curves).changed_by(&input.settings);
        picture.write(to_svg(&figure, arguments.plot.theme.colours()), &file)?;
        report
    } else {
        let found = limits::limits_with(&model, &options, &mut look);
        watch.whole(found.map_err(|faults| input.refused(faults))?)?
    };
    output.tell(&report, arguments.format)?;
    Ok(Outcome::Done)
}
