//! Where the answer goes, and in which form.

use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Where the answer goes.
#[derive(Debug, Args)]
pub(crate) struct Destination {
    /// Write to this file instead of standard output; it is written completely or not at all.
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// Overwrite existing output files.
    #[arg(long)]
    pub(crate) force: bool,
}

impl Destination {
    /// The file of the answer; none for standard output.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.output.as_deref().filter(|path| path.as_os_str() != "-")
    }
}

/// Form of an answer.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Words and aligned numbers, for people.
    #[default]
    Text,
    /// The whole report, for programs.
    Json,
    /// One row for each number, for tables.
    Csv,
}

/// Form of the findings of a check.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    /// Words, for people.
    #[default]
    Text,
    /// The whole report, for programs.
    Json,
}
