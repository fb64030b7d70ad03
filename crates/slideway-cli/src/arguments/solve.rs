//! `slideway solve`

use super::{Destination, Format, ModelArguments, SearchArguments};
use clap::Args;
use std::path::PathBuf;

pub(super) const HELP: &str = "\
Examples:
  slideway solve drawer.toml
  slideway solve drawer.toml --set mu=0.7 --set a=\"200 mm\"
  slideway solve klepp-2002.toml --set F_20=\"m*g\" --set direction=-1
  slideway solve slider-crank.toml --at phi=\"-75 deg\" --rate phi=\"20 rad/s\"
  slideway solve drawer.toml --format json --output drawer.json
  slideway models drawer | slideway solve -

Exit codes:
  0    solved: one solution, several, infinitely many, or a state in a preload
       gap
  1    no solution: friction locks the mechanism
  2    invalid input: the model, the settings, the files or the arguments
  3    unknown: nothing was found, but not every contact mode could be decided
  130  interrupted (Ctrl-C): the solutions found so far are printed";

/// Arguments of `slideway solve`.
#[derive(Debug, Args)]
pub(crate) struct SolveArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Form of the answer.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,

    /// Also write a proof that there are no other solutions, for the numbers of the mode problem in floating point.
    /// They are written to FILE.json; reference/check_proof.py checks the proof with them. None is
    /// written of contacts at rest and of hinges with friction.
    #[arg(long, value_name = "FILE")]
    pub(crate) proof: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) search: SearchArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}
