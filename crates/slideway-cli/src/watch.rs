//! Time limits, interruptions and progress of work that takes long.

use crate::failure::Failure;
use crate::halt::{Halt, rough};
use crate::outcome::Outcome;
use crate::output::{ProgressLine, clear_progress, complain};
use anstream::ColorChoice;
use slideway::progress::Progress;
use std::fmt::Write;
use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

/// Work that takes less time shows no progress.
const QUIET: Duration = Duration::from_secs(1);
/// Time between two lines of progress.
const BETWEEN: Duration = Duration::from_millis(200);
/// Work whose answer is whole or none, and that does not end by itself so long after its limit, is given up with the program.
const GIVEN_UP: Duration = Duration::from_secs(1);
/// Characters of the bar.
const BAR: usize = 24;

/// Whether someone has interrupted the program (Ctrl-C, or a signal to terminate).
static INTERRUPTED: AtomicBool = AtomicBool::new(false);
/// Whether work is being watched that ends by itself when it is interrupted.
static WATCHED: AtomicBool = AtomicBool::new(false);
static HANDLER: Once = Once::new();

/// Ends the program at once if nothing is watched, or the second time.
fn interrupt() {
    if INTERRUPTED.swap(true, Ordering::Relaxed) || !WATCHED.load(Ordering::Relaxed) {
        clear_progress();
        std::process::exit(i32::from(Outcome::Interrupted as u8));
    }
}

/// The exit code of an answer, which is partial where the work was ended.
pub(crate) fn outcome(halt: Option<Halt>, of_answer: Outcome) -> Outcome {
    if halt == Some(Halt::Interrupted) { Outcome::Interrupted } else { of_answer }
}

/// Says when work is to end, to any thread.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Alarm {
    start: Instant,
    limit: Option<Duration>,
}

impl Alarm {
    /// An interruption, or so much time from now on.
    pub(crate) fn within(limit: Option<Duration>) -> Self {
        Self { start: Instant::now(), limit }
    }

    /// Returns the alarm with as much time from now on.
    pub(crate) fn afresh(self) -> Self {
        Self { start: Instant::now(), ..self }
    }

    /// Breaks when it rings.
    pub(crate) fn flow(&self) -> ControlFlow<()> {
        if self.rings() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// Whether time is up or someone has interrupted.
    pub(crate) fn rings(&self) -> bool {
        INTERRUPTED.load(Ordering::Relaxed) || self.limit.is_some_and(|limit| self.start.elapsed() >= limit)
    }
}

/// Watches over work: tells how far it is, and ends it in time or when it is interrupted.
pub(crate) struct Watch {
    start: Instant,
    shown: Duration,
    limit: Option<Duration>,
    /// When it was first asked how much had been done, when that last changed, and both times how much it
    /// was.
    told: Option<[(Duration, f64); 2]>,
    line: ProgressLine,
    halt: Option<Halt>,
    /// Tells whoever gives the work up that it is over, by being dropped.
    over: Option<Sender<()>>,
}

impl Watch {
    /// Starts now; until it is dropped an interruption ends the work, not the program.
    pub(crate) fn new(limit: Option<Duration>) -> Self {
        Self::since(Instant::now(), limit)
    }

    /// Counts the time from `start` on, for work that was begun before in a part that cannot be ended. Until
    /// it is dropped an interruption ends the work, not the program.
    pub(crate) fn since(start: Instant, limit: Option<Duration>) -> Self {
        // Without a handler an interruption ends the program at once.
        HANDLER.call_once(|| {
            let _ = ctrlc::set_handler(interrupt);
        });
        WATCHED.store(true, Ordering::Relaxed);
        Self {
            start,
            shown: Duration::ZERO,
            limit,
            told: None,
            line: ProgressLine::new(),
            halt: None,
            over: None,
        }
    }

    /// Work whose answer is whole or none: past the limit it ends with the program, even within a step that does not look
    /// at the time.
    pub(crate) fn whole_or_none(mut self, color: ColorChoice) -> Self {
        let Some(limit) = self.limit else { return self };
        let left = (limit + GIVEN_UP).saturating_sub(self.start.elapsed());
        let (over, is_over) = channel::<()>();
        thread::spawn(move || {
            if is_over.recv_timeout(left) == Err(RecvTimeoutError::Timeout) {
                let failure = Failure::Halted { halt: Halt::TimeLimit(limit), path: None };
                clear_progress();
                complain(&failure.to_string(), color);
                std::process::exit(i32::from(failure.outcome() as u8));
            }
        });
        self.over = Some(over);
        self
    }

    /// Starts now, as [`Self::new`], but shows no progress where the answer itself appears bit by bit on the
    /// terminal.
    pub(crate) fn beside_rows(limit: Option<Duration>) -> Self {
        let mut watch = Self::new(limit);
        if io::stdout().is_terminal() {
            watch.line.hush();
        }
        watch
    }

    /// Tells of the progress; breaks when time is up or someone interrupts.
    pub(crate) fn look(&mut self, progress: &Progress) -> ControlFlow<()> {
        let elapsed = self.start.elapsed();
        if INTERRUPTED.load(Ordering::Relaxed) {
            self.halt = Some(Halt::Interrupted);
        } else if self.halt.is_none() {
            self.halt = self.limit.filter(|limit| elapsed >= *limit).map(Halt::TimeLimit);
        }
        self.tell(progress);
        if self.halt.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    /// [`Self::look`] while a picture of the answer is made: what there was when the time was up is drawn whole, unless
    /// someone interrupts.
    pub(crate) fn drawing(&mut self) -> impl FnMut(&Progress) -> ControlFlow<()> + Send + '_ {
        let time_was_up = self.halt.is_some();
        move |progress| match self.look(progress) {
            ControlFlow::Break(()) if time_was_up && self.halt != Some(Halt::Interrupted) => {
                ControlFlow::Continue(())
            }
            flow => flow,
        }
    }

    /// Returns the alarm that says to any thread when the work is to end, with the same start and limit.
    pub(crate) fn alarm(&self) -> Alarm {
        Alarm { start: self.start, limit: self.limit }
    }

    /// Tells of the progress, if a line is due.
    fn tell(&mut self, progress: &Progress) {
        let elapsed = self.start.elapsed();
        if let Some(fraction) = progress.fraction {
            let [first, last] = self.told.unwrap_or([(elapsed, fraction); 2]);
            self.told = Some([first, if fraction == last.1 { last } else { (elapsed, fraction) }]);
        }
        if elapsed >= QUIET && elapsed >= self.shown + BETWEEN {
            self.shown = elapsed;
            self.line.show(&self.words(progress, elapsed));
        }
    }

    /// Returns what has ended the work so far, if anything has.
    pub(crate) fn halt(&self) -> Option<Halt> {
        self.halt
    }

    /// No more work; what has ended it.
    pub(crate) fn finish(self) -> Option<Halt> {
        self.halt
    }

    /// No more work: its result, which is whole or none.
    ///
    /// # Errors
    /// If the work has been ended.
    pub(crate) fn whole<T>(self, result: Option<T>) -> Result<T, Failure> {
        let halt = self.finish().unwrap_or(Halt::Interrupted);
        result.ok_or(Failure::Halted { halt, path: None })
    }

    fn words(&self, progress: &Progress, elapsed: Duration) -> String {
        let mut text = String::new();
        if let Some(fraction) = progress.fraction {
            let filled = (1..=BAR).take_while(|part| *part as f64 <= fraction * BAR as f64).count();
            let bar = ["#".repeat(filled), "-".repeat(BAR - filled)].concat();
            let _ = write!(text, "[{bar}] {:.1} %, ", 100.0 * fraction);
        }
        let _ = write!(text, "{} {}, ", progress.done, progress.counted);
        if let Some(found) = progress.found {
            let _ = write!(text, "{found} found, ");
        }
        text.push_str(&rough(elapsed.as_secs_f64()));
        // A search goes on by leaps.
        let left = self.told.filter(|_| progress.found.is_none()).and_then(|told| left(told, elapsed));
        if let Some(left) = left {
            let _ = write!(text, ", {} left", rough(left));
        }
        text
    }
}

/// The seconds left if the rest goes on as it went until the work last changed; none where that time is over.
fn left([first, last]: [(Duration, f64); 2], elapsed: Duration) -> Option<f64> {
    let rate = (last.1 - first.1) / last.0.saturating_sub(first.0).as_secs_f64();
    let left = (1.0 - last.1) / rate - elapsed.saturating_sub(last.0).as_secs_f64();
    (rate > 0.0 && left > 0.0).then_some(left)
}

impl Drop for Watch {
    fn drop(&mut self) {
        drop(self.over.take());
        WATCHED.store(false, Ordering::Relaxed);
    }
}

#[cfg(test)]
mod tests {
    use super::left;
    use std::time::Duration;

    /// A tenth in the first second leaves nine more, and less with every second in which nothing is done.
    #[test]
    fn the_time_left_never_grows_while_nothing_is_done() {
        let told = [(Duration::ZERO, 0.0), (Duration::from_secs(1), 0.1)];
        let at = |seconds| left(told, Duration::from_secs(seconds));
        assert_eq!([1, 4, 9, 10].map(at), [Some(9.0), Some(6.0), Some(1.0), None]);
        assert_eq!(left([told[0]; 2], Duration::from_secs(1)), None);
    }
}
