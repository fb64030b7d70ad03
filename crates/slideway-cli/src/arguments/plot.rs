//! A plot beside the answer.

use clap::{Args, ValueEnum};
use slideway_pictures::theme::{DARK, LIGHT, Theme};
use std::path::PathBuf;

/// A plot beside the answer.
#[derive(Debug, Args)]
pub(crate) struct PlotArguments {
    /// Draw a plot, too; its extension selects the format (.svg or .png).
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,

    /// Colours of the picture.
    #[arg(long, value_enum, default_value_t)]
    pub(crate) theme: PictureTheme,
}

/// Colours of a picture.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum PictureTheme {
    /// On white.
    #[default]
    Light,
    /// On a dark background.
    Dark,
}

impl PictureTheme {
    /// Its colours.
    pub(crate) fn colours(self) -> &'static Theme {
        match self {
            Self::Light => &LIGHT,
            Self::Dark => &DARK,
        }
    }
}
