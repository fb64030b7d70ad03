//! `slideway drive`

use super::{CheckFormat, Destination, ModelArguments, PlotArguments, TimeArguments};
use clap::Args;
use slideway::drive::GREATEST_ROWS;

pub(super) const HELP: &str = "\
Examples:
  slideway drive drawer.toml              the push it needs, and the efficiency
  slideway drive drawer.toml --vary mu    the push over friction
  slideway drive drawer.toml --vary L=\"0.2 m..0.5 m\" --rows 21
  slideway drive screw.toml --vary friction=0..3
  slideway drive drawer.toml --vary mu --plot push.svg

The efficiency is the power without friction over the power with friction, at
the same motion. If the load pushes and the drives brake, it is the inverse.
A quantity without a range has the same range as in `slideway size`.

Exit codes:
  0    done
  1    no effort moves it as in the model: friction locks it
  2    invalid input: the settings, the name, the range or the arguments, or a
       model without drives
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway drive`.
#[derive(Debug, Args)]
pub(crate) struct DriveArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Tabulate the efforts over a parameter, a coordinate, or `friction`, a factor on all coefficients of
    /// friction.
    #[arg(long, value_name = "NAME[=FROM..TO]")]
    pub(crate) vary: Option<String>,

    /// Evenly spaced rows of the table.
    #[arg(long, value_name = "N", default_value_t = 11, value_parser = rows, requires = "vary")]
    pub(crate) rows: usize,

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

fn rows(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(rows) if (2..=GREATEST_ROWS).contains(&rows) => Ok(rows),
        _ => Err(format!("it must be a whole number from 2 to {GREATEST_ROWS}")),
    }
}
