//! How long a command may take.

use super::values::duration;
use clap::Args;
use std::time::Duration;

/// How long a command may take.
#[derive(Debug, Args)]
pub(crate) struct TimeArguments {
    /// End the work after this time (30s, 500ms, 2min, 1.5h), as Ctrl-C does, and report what is known by then.
    #[arg(long, value_name = "TIME", value_parser = duration)]
    pub(crate) time_limit: Option<Duration>,
}
