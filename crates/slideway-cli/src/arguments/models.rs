//! `slideway models`

use super::Destination;
use clap::Args;

pub(super) const HELP: &str = "\
Examples:
  slideway models                               list them
  slideway models -v                            and what each of them shows
  slideway models drawer                        print one
  slideway models drawer --output mine.toml     write it to a new file
  slideway models telescopic-boom --stages 5    a boom with 5 stages";

/// Arguments of `slideway models`.
#[derive(Debug, Args)]
pub(crate) struct ModelsArguments {
    /// The model to write; without it they are listed.
    pub(crate) name: Option<String>,

    /// Number of stages of the telescopic boom, 1 to 1000.
    #[arg(long, value_name = "N", requires = "name")]
    pub(crate) stages: Option<usize>,

    #[command(flatten)]
    pub(crate) destination: Destination,
}
