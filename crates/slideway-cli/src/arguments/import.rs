//! `slideway import`

use super::{Destination, TimeArguments};
use clap::Args;
use slideway::import::Unit;
use std::path::PathBuf;

pub(super) const HELP: &str = "\
Examples:
  slideway import clamp.dxf --output clamp.toml        write a model to complete
  slideway import clamp.dxf --unit mm                  of a drawing that does not say its unit

Each layer becomes a body: its greatest closed line is the outline, circles and points are its points, texts
beside them their names. The layer `ground` gives points of ground. What is left out stands in comments.

Exit codes:
  0    done
  2    invalid input: the drawing, the files or the arguments
  3    not done within --time-limit: nothing is written
  130  interrupted (Ctrl-C): nothing is written";

/// Arguments of `slideway import`.
#[derive(Debug, Args)]
pub(crate) struct ImportArguments {
    /// The drawing, a text (ASCII) DXF file; `-` for standard input.
    pub(crate) file: PathBuf,

    /// Unit of length of the drawing: in, ft, mm, cm, m, km, um, dm. By default the one that it says.
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<Unit>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}
