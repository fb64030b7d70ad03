//! A plot beside the answer, and how pictures look.

use clap::Args;
use slideway_pictures::theme::{DARK, LIGHT, Theme};
use std::path::PathBuf;

/// A plot beside the answer.
#[derive(Debug, Args)]
pub(crate) struct PlotArguments {
    /// Draw a plot, too; its ending says in which format.
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) look: Look,
}

/// How a picture looks.
#[derive(Debug, Args)]
pub(crate) struct Look {
    /// On a dark background.
    #[arg(long)]
    dark: bool,
}

impl Look {
    /// The colours of the picture.
    pub(crate) fn colours(&self) -> &'static Theme {
        if self.dark { &DARK } else { &LIGHT }
    }
}
