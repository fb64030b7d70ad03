//! `slideway hold`

use super::{CheckFormat, Destination, ModelArguments, TimeArguments};
use clap::{Args, ValueEnum};

pub(super) const HELP: &str = "\
Examples:
  slideway hold bracket-on-pole.toml
  slideway hold bracket-on-pole.toml --load W
  slideway hold bracket-on-pole.toml --load W --vary mu_static
  slideway hold bracket-on-pole.toml --vary mu_static=0..0.5
  slideway hold cam-follower.toml --load cam
  slideway hold slider-crank.toml --at phi=\"0 deg\" --load gas

The rates of the model are set to zero. With --load NAME the load is multiplied by a factor, 1 being the load of the
model; everything else is reported for the factor 1. The name of a drive stands for its effort in N or N m,
and everything else is reported without it. A load takes precedence over a drive of the same name.
The name gravity stands for all weights together.

With --vary NAME=FROM..TO the answer is for which values it can stay at rest; over a plane of two quantities
that is `slideway map --colour-by hold`.

Exit codes:
  0    it can stay at rest
  1    it cannot stay at rest
  2    invalid input: the model, the settings, the files or the arguments
  3    unknown: no state of rest was found, but not every state could be decided; or
       not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway hold`.
#[derive(Debug, Args)]
pub(crate) struct HoldArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Multiply this load by a factor, and report which factors are held.
    #[arg(long, value_name = "NAME")]
    pub(crate) load: Option<String>,

    /// NAME: the value of this static friction parameter from which on the load is held however great it is
    /// (by default, the factor on all static coefficients); NAME=FROM..TO: for which values of this
    /// parameter, this coordinate or `friction` it can stay at rest.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: Option<String>,

    /// What the drives do.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) drives: Drives,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// What drives do at rest.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Drives {
    /// They are absent.
    #[default]
    Release,
    /// They hold their coordinates with whatever effort that takes.
    Hold,
}
