//! `slideway check`

use crate::arguments::CheckArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use crate::watch::Watch;
use slideway::check::check_with;

/// Says what a model consists of, and which questions it can answer.
pub(crate) fn check(arguments: &CheckArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = Files::new(output, &arguments.destination, Some(&arguments.model.file)).answer()?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model_without_warnings()?;
    let mut watch = Watch::new(arguments.time.time_limit).whole_or_none(output.color());
    let report = check_with(&model, &mut |progress| watch.look(progress));
    let report = watch.whole(report.map_err(|faults| input.refused(faults))?)?;
    output.tell(&report, arguments.format)?;
    input.be_strict(&model)?;
    Ok(if report.is_ready() { Outcome::Done } else { Outcome::Refused })
}
