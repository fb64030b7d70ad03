//! `slideway report`

use super::{Destination, ModelArguments, OpenArguments, TimeArguments};
use clap::Args;

pub(super) const HELP: &str = "\
Examples:
  slideway report drawer.toml                  on a terminal: into drawer.html
  slideway report drawer.toml --open           and shows it in the browser
  slideway report drawer.toml --output drawer.html --force
  slideway report klepp-2002.toml --set F_20=0 --vary mu_1=0..0.8 \\
    --vary \"alpha=60 deg..88 deg\" --output klepp.html

On a terminal, a page without --output goes into a new file that has the name of
the model. In a pipe it goes to standard output.

Exit codes:
  0    done
  2    invalid input: the model, the settings, the name, the range, the files or
       the arguments
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway report`.
#[derive(Debug, Args)]
pub(crate) struct ReportArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// A quantity whose limits are shown: a parameter, a coordinate, or `friction`, a factor on all coefficients of
    /// friction, which is the default. May be repeated.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: Vec<String>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) open: OpenArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}
