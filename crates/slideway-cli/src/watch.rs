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
    /// When it was first asked how much had been done, and when that had changed, with how much it was: at most five
    /// times a second, but always the latest.
    told: Vec<(Duration, f64)>,
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
            told: Vec::new(),
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
            self.note(elapsed, fraction);
        }
        if elapsed >= QUIET && elapsed >= self.shown + BETWEEN {
            self.shown = elapsed;
            self.line.show(&self.words(progress, elapsed));
        }
    }

    fn note(&mut self, elapsed: Duration, fraction: f64) {
        if self.told.last().is_some_and(|last| last.1 == fraction) {
            return;
        }
        if let [.., before, last] = &mut *self.told
            && elapsed < before.0 + BETWEEN
        {
            *last = (elapsed, fraction);
        } else {
            self.told.push((elapsed, fraction));
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
        // A bar says more than that the first is not done.
        if progress.done > 0 || progress.fraction.is_none() {
            let _ = write!(text, "{} {}, ", progress.done, progress.counted);
        }
        if let Some(found) = progress.found {
            let _ = write!(text, "{found} found, ");
        }
        text.push_str(&rough(elapsed.as_secs_f64()));
        // A search goes on by leaps.
        let left = if progress.found.is_none() { left(&self.told, elapsed) } else { None };
        if let Some(left) = left {
            let _ = write!(text, ", {} left", rough(left));
        }
        text
    }
}

/// The seconds left if the rest goes on as it went until the work last changed; none where that time is over, and where
/// one half of the time brought more than three times as much as the other: then nobody knows.
fn left(told: &[(Duration, f64)], elapsed: Duration) -> Option<f64> {
    let (&first, &last) = (told.first()?, told.last()?);
    let done = last.1 - first.1;
    let middle = first.0 + elapsed.saturating_sub(first.0) / 2;
    let at_middle = told.iter().rfind(|one| one.0 <= middle)?.1;
    let is_even = (0.25..=0.75).contains(&((last.1 - at_middle) / done));
    let seconds = last.0.saturating_sub(first.0).as_secs_f64() * (1.0 - last.1) / done;
    let left = seconds - elapsed.saturating_sub(last.0).as_secs_f64();
    (is_even && left > 0.0).then_some(left)
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

    const SECOND: Duration = Duration::from_secs(1);

    /// A tenth in each second: five are left after the fifth, and less while the next tenth takes long.
    #[test]
    fn the_time_left_shrinks_while_work_goes_on_evenly() {
        let told: Vec<(Duration, f64)> =
            (0..=5).map(|tenth| (tenth * SECOND, f64::from(tenth) / 10.0)).collect();
        let close = |left: Option<f64>, wanted: f64| left.is_some_and(|left| (left - wanted).abs() < 1e-9);
        assert!(close(left(&told, 5 * SECOND), 5.0));
        assert!(close(left(&told, 6 * SECOND), 4.0));
    }

    /// A tenth in the first second and nothing since; a thousandth in a second, and then nine tenths in another: nobody knows
    /// how long the rest takes.
    #[test]
    fn no_time_is_left_by_work_that_goes_unevenly() {
        let standing = [(Duration::ZERO, 0.0), (SECOND, 0.1)];
        assert_eq!([2, 4, 9].map(|seconds| left(&standing, seconds * SECOND)), [None; 3]);
        let leaping = [(Duration::ZERO, 0.0), (SECOND, 0.001), (2 * SECOND, 0.9)];
        assert_eq!(left(&leaping, 3 * SECOND), None);
        assert_eq!(left(&leaping[..1], SECOND), None);
        assert_eq!(left(&[], SECOND), None);
    }
}
