//! `slideway limits`

use super::values::{choice, positive};
use super::{CheckFormat, Destination, ModelArguments, PlotArguments, TimeArguments};
use clap::Args;
use slideway::choice::Choice;
use slideway::limits::{EFFORT, Quantity};

pub(super) const HELP: &str = "\
Examples:
  slideway limits drawer.toml                        lists what can be varied
  slideway limits drawer.toml --vary mu              at which friction it jams
  slideway limits drawer.toml --vary friction        all coefficients together
  slideway limits drawer.toml --vary L=\"0.2 m..0.5 m\"
  slideway limits slider-crank.toml --vary phi=\"-80 deg..80 deg\"
  slideway limits klepp-2002.toml --vary mu_1=0..0.8 --both-directions
  slideway limits drawer.toml --vary mu --plot limits.svg

A quantity without a range has the same range as in `slideway size`.

Exit codes:
  0    done
  2    invalid input: the model, the settings, the name, the range or the
       arguments; or nothing is varied
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway limits`.
#[derive(Debug, Args)]
pub(crate) struct LimitsArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// What to vary: a parameter, a coordinate, or `friction` for a factor on all coefficients of friction. Without it,
    /// the quantities of the model are listed.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: Option<String>,

    /// Examine motion in the opposite direction, too.
    #[arg(long)]
    pub(crate) both_directions: bool,

    /// Modes end where a normal force exceeds this, in N.
    #[arg(long, value_name = "N", value_parser = positive)]
    pub(crate) max_reaction: Option<f64>,

    /// How hard to try to prove the numbers of solutions: certified searches for each direction; 0 proves nothing.
    #[arg(long, value_name = "COUNT", default_value_t = EFFORT)]
    pub(crate) effort: u64,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,

    #[command(flatten)]
    pub(crate) plot: PlotArguments,

    /// What the plot shows.
    #[arg(long, default_value = Quantity::default().word(), value_parser = choice::<Quantity>(), requires = "plot")]
    pub(crate) quantity: Quantity,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}
