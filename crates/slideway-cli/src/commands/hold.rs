//! `slideway hold`

use crate::arguments::{Drives, HoldArguments};
use crate::failure::Failure;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::Watch;
use slideway::standstill::{self, HoldOptions};

/// Says whether a mechanism stays at rest, under which loads, and how it begins to move.
pub(crate) fn hold(arguments: &HoldArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = output.to(&arguments.destination, Some(&arguments.model.file))?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let mut options = HoldOptions::default().hold_drives(arguments.drives == Drives::Hold);
    (options.load, options.vary) = (arguments.load.clone(), arguments.vary.clone());
    let mut watch = Watch::new(arguments.time.time_limit);
    let report = standstill::hold_with(&model, &options, &mut |progress| watch.look(progress));
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    output.tell(&report, arguments.format)?;
    Ok(match (report.holds, report.undecided) {
        (true, _) => Outcome::Done,
        (false, 0) => Outcome::NoSolution,
        (false, _) => Outcome::Unknown,
    })
}
