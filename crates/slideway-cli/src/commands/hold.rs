//! `slideway hold`

use crate::arguments::{Drives, HoldArguments};
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::Watch;
use slideway::limits::rest_limits_with;
use slideway::standstill::{self, HoldOptions};

/// Says whether a mechanism stays at rest, under which loads, and how it begins to move.
pub(crate) fn hold(arguments: &HoldArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = Files::new(output, &arguments.destination, Some(&arguments.model.file)).answer()?;
    let input = Input::read(&arguments.model, output.color())?.varying(&arguments.vary);
    let model = input.model_at_rest()?;
    let mut options = HoldOptions::default().hold_drives(arguments.drives == Drives::Hold);
    options.load.clone_from(&arguments.load);
    let mut watch = Watch::new(arguments.time.time_limit).whole_or_none(output.color());
    let vary = arguments.vary.as_ref().map(|text| input.vary(&model, text)).transpose()?;
    if let Some(vary) = vary.as_ref().filter(|vary| vary.range.is_some()) {
        let report = rest_limits_with(&model, vary, &options, &mut |progress| watch.look(progress));
        let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
        output.tell(&report, arguments.format)?;
        return Ok(Outcome::Done);
    }
    options.vary = vary.map(|vary| vary.name);
    let report = standstill::hold_with(&model, &options, &mut |progress| watch.look(progress));
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    output.tell(&report, arguments.format)?;
    Ok(match (report.holds, report.is_decided()) {
        (true, _) => Outcome::Done,
        (false, true) => Outcome::NoSolution,
        (false, false) => Outcome::Unknown,
    })
}
