//! Whether a picture or page is opened.

use clap::Args;

/// Whether a picture or page is opened.
#[derive(Debug, Args)]
pub(crate) struct OpenArguments {
    /// Open the file when it is written. Without --output it has the name of the model.
    #[arg(long)]
    pub(crate) open: bool,
}
