//! Limits of a search.

use super::TimeArguments;
use clap::Args;
use slideway::modes::{Limits, SearchOptions};
use std::num::NonZero;

/// What a search for solutions may cost, and how much of it is told.
#[derive(Debug, Args)]
pub(crate) struct SearchArguments {
    /// List at most N solutions; all are counted.
    #[arg(long, value_name = "N", default_value_t = 100)]
    pub(crate) max_solutions: usize,

    /// End the search after N nodes; the answer is then partial.
    #[arg(long, value_name = "N")]
    max_nodes: Option<u64>,

    /// End the search of each independent group of contacts or unknowns once it has more than N solutions; the answer
    /// is then partial. The numbers of the groups multiply.
    #[arg(long, value_name = "N", default_value_t = Limits::default().solutions)]
    max_found: usize,

    /// Number of threads for a large search; the answer does not depend on it.
    #[arg(long, value_name = "N", default_value_t = available_threads(), hide_default_value = true)]
    threads: NonZero<usize>,

    #[command(flatten)]
    pub(crate) time: TimeArguments,
}

/// One for each processor.
fn available_threads() -> NonZero<usize> {
    std::thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN)
}

impl SearchArguments {
    /// The options of the search.
    pub(crate) fn options(&self) -> SearchOptions {
        self.threaded(SearchOptions::within(self.max_nodes, Some(self.max_found)))
    }

    /// Returns the options of a search for which one solution is enough: it ends at the first.
    pub(crate) fn options_for_one(&self) -> SearchOptions {
        self.threaded(SearchOptions::within(self.max_nodes, Some(1)))
    }

    fn threaded(&self, options: SearchOptions) -> SearchOptions {
        SearchOptions { threads: self.threads.get(), ..options }
    }
}
