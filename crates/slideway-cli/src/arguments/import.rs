//! `slideway import`

use super::{Destination, TimeArguments};
use clap::Args;
use slideway::import::Unit;
use std::path::PathBuf;

pub(super) const HELP: &str = "\
Examples:
  slideway import clamp.dxf --output clamp.toml    write a model to complete
  slideway import clamp.dxf --unit mm              if the drawing has no unit

Each layer becomes a body: its largest closed line is the outline; circles and
points are its points, and texts beside them their names. The layer `ground` has
the points of ground. Comments in the model list what was left out.

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

    /// Unit of length of the drawing: in, ft, mm, cm, m, km, um, dm. By default the one that the drawing names.
    #[arg(long, value_name = "UNIT")]
    pub(crate) unit: Option<Unit>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,

    #[command(flatten)]
    pub(crate) destination: Destination,
}
