//! `slideway size`

use crate::arguments::SizeArguments;
use crate::failure::Failure;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::Watch;
use slideway::size::{self, SizeOptions};

/// Finds the value of a parameter at which a margin is just met.
pub(crate) fn size(arguments: &SizeArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = output.to(&arguments.destination, Some(&arguments.model.file))?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model()?;
    let vary = input.vary(&model, &arguments.vary)?;
    let loads = model.loads.iter().map(|load| &load.name);
    let names = loads.chain(model.drives.iter().map(|drive| &drive.name)).map(ToString::to_string).collect();
    let mut watch = Watch::new(arguments.time.time_limit);
    let report = arguments.against(names).and_then(|against| {
        let options = SizeOptions::new(vary, arguments.margin)
            .against(against)
            .both_directions(arguments.both_directions);
        size::size_with(&model, &options, &mut |progress| watch.look(progress))
    });
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    output.tell(&report, arguments.format)?;
    Ok(if report.met.is_empty() { Outcome::NoSolution } else { Outcome::Done })
}
