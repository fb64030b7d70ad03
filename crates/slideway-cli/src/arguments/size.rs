//! `slideway size`

use super::values::positive;
use super::{CheckFormat, Destination, ModelArguments, PlotArguments, TimeArguments};
use clap::{Args, ValueEnum};
use slideway::fault::{Fault, FaultKind, Faults};
use slideway::size;

pub(super) const HELP: &str = "\
Examples:
  slideway size drawer.toml --vary L --margin 2                how long the guide must be
  slideway size drawer.toml --vary a --margin 1.5 --both-directions
  slideway size drawer.toml --vary L --margin 2 --plot margin.svg
  slideway size cam-follower.toml --vary A=\"0 m..0.2 m\" --margin 2
  slideway size bracket-on-pole.toml --vary x --margin 1.5 --against hold --load W
  slideway size cam-follower.toml --vary phi --margin 2 --against self-locking --load cam

The margin against locking is the factor by which all kinetic friction may grow before there is no
solution. At rest it concerns a load, or the effort of a drive. Against self-locking it is the
factor by which static friction may grow before the load is held however great it is. With
`--against hold` the load must be held, and it is the factor by which static friction may be
divided. Without a range, a coefficient of friction goes from 0 to 1 or twice its value, `friction`
from 0 to 10, any other parameter from a fifth of its value to five times its value.

Exit codes:
  0    the margin is met somewhere in the range
  1    it is met nowhere in the range
  2    invalid input: the model, the settings, the name or the range, the arguments
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway size`.
#[derive(Debug, Args)]
pub(crate) struct SizeArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// What to size: a parameter, a coordinate, or `friction` for a factor on all coefficients of friction.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: String,

    /// The wanted margin: a factor on friction.
    #[arg(long, value_name = "FACTOR", value_parser = positive)]
    pub(crate) margin: f64,

    /// Against what.
    #[arg(long, value_enum, default_value_t)]
    against: Against,

    /// The load, or the drive whose effort is the load, for a margin at rest.
    #[arg(long, value_name = "NAME")]
    load: Option<String>,

    /// Use the smaller margin of both directions of motion.
    #[arg(long)]
    pub(crate) both_directions: bool,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) plot: PlotArguments,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}

/// Against what there is to be a margin.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Against {
    /// Locking in motion.
    #[default]
    Locking,
    /// Self-locking at rest under the load.
    SelfLocking,
    /// Slipping at rest: the load must be held however great it is.
    Hold,
}

impl SizeArguments {
    /// Against what, with the load that it concerns.
    ///
    /// # Errors
    /// A margin at rest without a load, one of motion with a load.
    pub(crate) fn against(&self, loads: Vec<String>) -> Result<size::Against, Faults> {
        match (self.against, self.load.clone()) {
            (Against::Locking, None) => Ok(size::Against::Locking),
            (Against::SelfLocking, Some(load)) => Ok(size::Against::SelfLocking { load }),
            (Against::Hold, Some(load)) => Ok(size::Against::Hold { load }),
            (Against::Locking, Some(load)) => Err(Fault::general(FaultKind::LoadUnused { load }).into()),
            (_, None) => Err(Fault::general(FaultKind::LoadNeeded { known: loads }).into()),
        }
    }
}
