//! `slideway check`

use crate::arguments::CheckArguments;
use crate::failure::Failure;
use crate::files::Files;
use crate::input::Input;
use crate::outcome::Outcome;
use crate::output::Output;
use slideway::check::{self};

/// Says what a model consists of, and which questions it can answer.
pub(crate) fn check(arguments: &CheckArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = Files::new(output, &arguments.destination, Some(&arguments.model.file)).answer()?;
    let input = Input::read(&arguments.model, output.color())?;
    let model = input.model_without_warnings()?;
    let report = check::check(&model).map_err(|faults| input.refused(faults))?;
    output.tell(&report, arguments.format)?;
    input.be_strict(&model)?;
    Ok(if report.is_ready() { Outcome::Done } else { Outcome::Refused })
}
