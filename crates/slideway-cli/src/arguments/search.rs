//! What a search may cost.

use super::TimeArguments;
use clap::Args;
use slideway::modes::SearchOptions;

/// What a search for solutions may cost, and how much of it is told.
#[derive(Debug, Args)]
pub(crate) struct SearchArguments {
    /// List at most so many solutions; all are counted.
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub(crate) max_solutions: usize,

    /// End the search after so many nodes; the answer is then partial.
    #[arg(long, value_name = "N")]
    max_nodes: Option<u64>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,
}

impl SearchArguments {
    /// The options of the search.
    pub(crate) fn options(&self) -> SearchOptions {
        let defaults = SearchOptions::default();
        SearchOptions { nodes: self.max_nodes.unwrap_or(defaults.nodes), ..defaults }
    }
}
