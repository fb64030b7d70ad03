//! `slideway report`

use super::{Destination, ModelArguments, TimeArguments};
use clap::Args;

pub(super) const HELP: &str = "\
Examples:
  slideway report klepp-2002.toml --output klepp.html
  slideway report klepp-2002.toml --set F_20=0 --vary mu_1=0..0.8 --vary \"alpha=60 deg..88 deg\" --output klepp.html
  slideway report drawer.toml --output drawer.html --force

Exit codes:
  0    done
  2    invalid input: the model, the settings, the name or the range, the files or the arguments
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway report`.
#[derive(Debug, Args)]
pub(crate) struct ReportArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Quantity for the limits: a parameter, a coordinate, or `friction`. May be repeated.
    /// Default: `friction`, a factor on all coefficients of friction.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: Vec<String>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}
