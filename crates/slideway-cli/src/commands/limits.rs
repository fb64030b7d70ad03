//! `slideway limits`

use crate::Outcome;
use crate::arguments::{CheckFormat, LimitsArguments};
use crate::failure::Failure;
use crate::input::Input;
use crate::output::Output;
use slideway::limits::{self, LimitsOptions};

/// Says for which values each contact mode exists.
pub(crate) fn limits(arguments: &LimitsArguments, output: &Output) -> Result<Outcome, Failure> {
    let output = output.to(&arguments.destination)?;
    arguments.model.spare(&arguments.destination)?;
    let input = Input::read(&arguments.model)?;
    let model = input.model()?;
    let options = LimitsOptions {
        vary: arguments.vary.clone(),
        max_reaction: arguments.max_reaction,
        both_directions: arguments.both_directions,
    };
    let report = limits::limits(&model, &options).map_err(|faults| input.refused(faults))?;
    output.write(&match arguments.format {
        CheckFormat::Text => limits::to_text(&report, output.style()),
        CheckFormat::Json => limits::to_json(&report),
    })?;
    Ok(Outcome::Done)
}
