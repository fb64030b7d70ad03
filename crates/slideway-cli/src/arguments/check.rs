//! `slideway check`

use super::{CheckFormat, Destination, ModelArguments, TimeArguments};
use clap::Args;

pub(super) const HELP: &str = "\
Examples:
  slideway check drawer.toml
  slideway check slider-crank.toml --set mu=0.3
  slideway check drawer.toml --format json

Exit codes:
  0    at least one question can be answered in this state
  2    invalid input, or no question can be answered
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Form of the findings.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) destination: Destination,

    #[command(flatten)]
    pub(crate) time: TimeArguments,
}
