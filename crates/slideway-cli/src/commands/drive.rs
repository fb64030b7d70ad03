//! `slideway drive`

use crate::arguments::DriveArguments;
use crate::failure::Failure;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::Watch;
use slideway::drive::{self, DriveOptions};

/// Says which efforts the drives need.
pub(crate) fn drive(arguments: &DriveArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = output.to(&arguments.destination, Some(&arguments.model.file))?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let vary = arguments.vary.as_deref().map(|vary| input.vary(&model, vary)).transpose()?;
    let options = DriveOptions::default().vary(vary).rows(arguments.rows);
    let mut watch = Watch::new(arguments.time.time_limit);
    let report = drive::drive_with(&model, &options, &mut |progress| watch.look(progress));
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    output.tell(&report, arguments.format)?;
    let moves = report.directions.first().is_some_and(|direction| !direction.solutions.is_empty());
    Ok(if moves { Outcome::Done } else { Outcome::NoSolution })
}
