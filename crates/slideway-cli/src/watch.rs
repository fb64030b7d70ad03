//! Time limits and progress of searches.

use crate::output::ProgressLine;
use slideway::modes::Progress;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Searches that take less time show no progress.
const QUIET: Duration = Duration::from_secs(1);
/// Time between two lines of progress.
const BETWEEN: Duration = Duration::from_millis(200);

/// Ends a search in time, and tells of its progress.
pub(crate) struct Watch {
    start: Instant,
    limit: Option<Duration>,
    shown: Duration,
    line: ProgressLine,
}

impl Watch {
    /// Starts now.
    pub(crate) fn new(limit: Option<Duration>) -> Self {
        Self { start: Instant::now(), limit, shown: Duration::ZERO, line: ProgressLine::new() }
    }

    /// Tells how far a simulation has come between two times (s), and breaks when time is up.
    pub(crate) fn follow(&mut self, time: f64, [start, until]: [f64; 2]) -> ControlFlow<()> {
        let elapsed = self.start.elapsed();
        if self.limit.is_some_and(|limit| elapsed >= limit) {
            return ControlFlow::Break(());
        }
        if elapsed >= QUIET && elapsed >= self.shown + BETWEEN {
            self.shown = elapsed;
            let part = (time - start) / (until - start);
            self.line.show(&format!("t = {time:.4} s of {until} s ({:.0} %), {} s", 100.0 * part, elapsed.as_secs()));
        }
        ControlFlow::Continue(())
    }

    /// Tells of the progress, and breaks when time is up.
    pub(crate) fn look(&mut self, progress: &Progress) -> ControlFlow<()> {
        let elapsed = self.start.elapsed();
        if self.limit.is_some_and(|limit| elapsed >= limit) {
            return ControlFlow::Break(());
        }
        if elapsed >= QUIET && elapsed >= self.shown + BETWEEN {
            self.shown = elapsed;
            self.line.show(&format!(
                "{:.1} % of the patterns, {} nodes, {} found, {} s",
                100.0 * progress.fraction,
                progress.nodes,
                progress.states_found,
                elapsed.as_secs()
            ));
        }
        ControlFlow::Continue(())
    }
}
