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

The rates of the model are set to zero. --load NAME multiplies the load by a
factor, and the answer says for which factors it is held; 1 is the load of the
model, for which everything else is reported. NAME can also be a drive: then its
effort is the load, in N or N m, and everything else is reported without it. If
a load and a drive have one name, the load is meant. `gravity` stands for all
weights together.

With --vary NAME=FROM..TO the answer is for which values it can stay at rest.
For two quantities, use `slideway map --colour-by hold`.

Exit codes:
  0    it can stay at rest
  1    it cannot stay at rest
  2    invalid input: the model, the settings, the files or the arguments
  3    unknown: no state of rest was found, but not every state could be
       decided; or not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway hold`.
#[derive(Debug, Args)]
pub(crate) struct HoldArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Multiply this load by a factor, and report which factors are held.
    #[arg(long, value_name = "NAME")]
    pub(crate) load: Option<String>,

    /// NAME, with --load: from which value of this static friction on the load is held however great it is (without
    /// it: from which factor on all static coefficients). NAME=FROM..TO: for which values of a parameter, a
    /// coordinate or `friction` it can stay at rest.
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
