//! Time limits and progress of searches.

use crate::Outcome;
use crate::output::ProgressLine;
use slideway::modes::Progress;
use std::fmt::Write;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Searches that take less time show no progress.
const QUIET: Duration = Duration::from_secs(1);
/// Time between two lines of progress.
const BETWEEN: Duration = Duration::from_millis(200);

/// Whether someone has interrupted the program (Ctrl-C). The second time ends it at once.
pub(crate) struct Interruption(Arc<AtomicBool>);

impl Interruption {
    /// From now on an interruption is noticed.
    pub(crate) fn watch() -> Self {
        let flag = Arc::new(AtomicBool::new(false));
        let set = Arc::clone(&flag);
        let handler = move || {
            if set.swap(true, Ordering::Relaxed) {
                std::process::exit(i32::from(Outcome::Interrupted as u8));
            }
        };
        // Without a handler an interruption ends the program at once.
        let _ = ctrlc::set_handler(handler);
        Self(flag)
    }

    /// Whether there was one.
    pub(crate) fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Breaks once there was one.
    pub(crate) fn flow(&self) -> ControlFlow<()> {
        if self.is_requested() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// When a line of progress is due.
struct Pace {
    start: Instant,
    shown: Duration,
}

impl Pace {
    /// Starts now.
    fn new() -> Self {
        Self { start: Instant::now(), shown: Duration::ZERO }
    }

    /// The time since the start, if a line is due: it counts as shown.
    fn due(&mut self) -> Option<Duration> {
        let elapsed = self.start.elapsed();
        let is_due = elapsed >= QUIET && elapsed >= self.shown + BETWEEN;
        if is_due {
            self.shown = elapsed;
        }
        is_due.then_some(elapsed)
    }
}

/// Ends a search in time, and tells of its progress.
pub(crate) struct Watch {
    pace: Pace,
    limit: Option<Duration>,
    line: ProgressLine,
}

impl Watch {
    /// Starts now.
    pub(crate) fn new(limit: Option<Duration>) -> Self {
        Self { pace: Pace::new(), limit, line: ProgressLine::new() }
    }

    /// Tells how far a simulation has come between two times (s), and breaks when time is up.
    pub(crate) fn follow(&mut self, time: f64, [start, until]: [f64; 2]) -> ControlFlow<()> {
        if self.limit.is_some_and(|limit| self.pace.start.elapsed() >= limit) {
            return ControlFlow::Break(());
        }
        if let Some(elapsed) = self.pace.due() {
            let part = (time - start) / (until - start);
            self.line.show(&format!(
                "t = {time:.4} s of {until} s ({:.0} %), {} s",
                100.0 * part,
                elapsed.as_secs()
            ));
        }
        ControlFlow::Continue(())
    }

    /// Tells which part of a moving picture is made.
    pub(crate) fn animate(&mut self, part: f64) {
        if let Some(elapsed) = self.pace.due() {
            self.line.show(&format!("{:.0} % of the moving picture, {} s", 100.0 * part, elapsed.as_secs()));
        }
    }

    /// Tells of the progress, and breaks when time is up.
    pub(crate) fn look(&mut self, progress: &Progress) -> ControlFlow<()> {
        if self.limit.is_some_and(|limit| self.pace.start.elapsed() >= limit) {
            return ControlFlow::Break(());
        }
        if let Some(elapsed) = self.pace.due() {
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

/// Tells how far a sweep has come, how fast it is, and how long it will take.
pub(crate) struct SweepWatch {
    pace: Pace,
    first: u64,
    points: u64,
    line: ProgressLine,
}

/// Characters of the bar.
const BAR: usize = 24;

impl SweepWatch {
    /// Starts now, with so many points done of so many.
    pub(crate) fn new(first: u64, points: u64) -> Self {
        Self { pace: Pace::new(), first, points, line: ProgressLine::new() }
    }

    /// Tells how many points are done.
    pub(crate) fn look(&mut self, done: u64) {
        let Some(elapsed) = self.pace.due() else { return };
        let fraction = done as f64 / self.points.max(1) as f64;
        let rate = (done - self.first) as f64 / elapsed.as_secs_f64();
        let filled = (1..=BAR).take_while(|part| *part as f64 <= fraction * BAR as f64).count();
        let mut text = format!("[{}{}]", "#".repeat(filled), "-".repeat(BAR - filled));
        let _ = write!(text, " {:.1} % of {} points, {rate:.0} points/s", 100.0 * fraction, self.points);
        if rate > 0.0 {
            let _ = write!(text, ", {} left", rough((self.points - done) as f64 / rate));
        }
        self.line.show(&text);
    }

    /// Tells which part of the file is made, once all points are computed.
    pub(crate) fn complete(&mut self, part: f64) {
        if self.pace.due().is_some() {
            self.line.show(&format!("{:.0} % of the file", 100.0 * part));
        }
    }
}

/// A time without needless digits.
fn rough(seconds: f64) -> String {
    if seconds < 90.0 {
        format!("{seconds:.0} s")
    } else if seconds < 5400.0 {
        format!("{:.0} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}
