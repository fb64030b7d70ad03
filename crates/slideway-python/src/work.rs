//! Work without the interpreter: it ends when its time is up, on Ctrl-C, and when a callback raises.

use pyo3::exceptions::{PyRuntimeError, PyTimeoutError, PyValueError};
use pyo3::prelude::*;
use slideway::Faults;
use slideway::fault::FaultKind;
use slideway::progress::{Callback, Progress};
use std::ops::ControlFlow;
use std::panic::{self, AssertUnwindSafe};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Time between two looks at signals, and between two calls of a callback.
const BETWEEN: Duration = Duration::from_millis(50);

/// The limit that ends work early, and the callback that hears of its progress.
pub(crate) struct Watch {
    limit: Option<Duration>,
    progress: Option<Py<PyAny>>,
}

/// How work ended early.
enum Halt {
    TimeUp,
    Raised(PyErr),
}

/// The result of work.
pub(crate) enum Ended<T> {
    /// It was done.
    Done(T),
    /// Its time was up; what there is then.
    TimeUp(T),
}

impl<T> Ended<Option<T>> {
    /// The answer.
    ///
    /// # Errors
    /// `TimeoutError` if its time was up before.
    pub(crate) fn whole(self) -> PyResult<T> {
        match self {
            Self::Done(Some(value)) => Ok(value),
            _ => Err(time_up()),
        }
    }
}

fn time_up() -> PyErr {
    PyTimeoutError::new_err("the work was not done within time_limit")
}

impl<T> Ended<Result<T, Faults>> {
    /// The answer as far as it goes.
    ///
    /// # Errors
    /// What it is refused for; `TimeoutError` if there was no answer yet when its time was up.
    pub(crate) fn answer(self, refused: impl FnOnce(Faults) -> PyErr) -> PyResult<T> {
        let is_ended =
            |faults: &Faults| faults.sorted().iter().any(|fault| fault.kind == FaultKind::WorkEnded);
        match self {
            Self::TimeUp(Err(faults)) if is_ended(&faults) => Err(time_up()),
            Self::Done(answer) | Self::TimeUp(answer) => answer.map_err(refused),
        }
    }
}

impl<T> Ended<T> {
    /// The answer as far as it goes.
    pub(crate) fn so_far(self) -> T {
        match self {
            Self::Done(value) | Self::TimeUp(value) => value,
        }
    }
}

impl Watch {
    /// # Errors
    /// A limit that is no time.
    pub(crate) fn new(time_limit: Option<f64>, progress: Option<Py<PyAny>>) -> PyResult<Self> {
        let seconds = |limit: f64| {
            let wanted = format!("time_limit must be a positive number of seconds, not {limit}");
            if limit > 0.0 { Duration::try_from_secs_f64(limit).map_err(|_| wanted) } else { Err(wanted) }
        };
        let limit = match time_limit {
            Some(f64::INFINITY) | None => None,
            Some(limit) => Some(seconds(limit).map_err(PyValueError::new_err)?),
        };
        Ok(Self { limit, progress })
    }

    /// Runs work without the interpreter, on this thread.
    ///
    /// # Errors
    /// What Ctrl-C or the callback raised.
    pub(crate) fn run<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Callback<'_>) -> T + Send,
    ) -> PyResult<Ended<T>> {
        let begun = Instant::now();
        let mut looked = begun;
        let mut halt = None;
        let mut look = |progress: &Progress| {
            if halt.is_none() && looked.elapsed() >= BETWEEN {
                looked = Instant::now();
                halt = self.look(begun, Some(*progress));
            } else if halt.is_none() && self.is_up(begun) {
                halt = Some(Halt::TimeUp);
            }
            if halt.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let value = py.detach(|| panic::catch_unwind(AssertUnwindSafe(|| work(&mut look))));
        ended(value, halt)
    }

    /// Runs work as [`Self::run`] does, but on a thread of its own: for work that is done and reported by
    /// many threads. Python hears of Ctrl-C only on the thread that called.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub(crate) fn run_beside<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Callback<'_>) -> T + Send,
    ) -> PyResult<Ended<T>> {
        let begun = Instant::now();
        let stop = AtomicBool::new(false);
        let latest = Mutex::new(None);
        let (value, halt) = py.detach(|| {
            thread::scope(|scope| {
                let (done, is_done) = mpsc::channel::<()>();
                let (stop, latest) = (&stop, &latest);
                let worker = scope.spawn(move || {
                    // Dropped at the end, which wakes the thread that waits.
                    let _done = done;
                    work(&mut |progress| {
                        *latest.lock().unwrap_or_else(PoisonError::into_inner) = Some(*progress);
                        if stop.load(Ordering::Relaxed) {
                            ControlFlow::Break(())
                        } else {
                            ControlFlow::Continue(())
                        }
                    })
                });
                let mut halt = None;
                while is_done.recv_timeout(BETWEEN) == Err(RecvTimeoutError::Timeout) {
                    if halt.is_none() {
                        let progress = *latest.lock().unwrap_or_else(PoisonError::into_inner);
                        halt = self.look(begun, progress);
                        stop.store(halt.is_some(), Ordering::Relaxed);
                    }
                }
                (worker.join(), halt)
            })
        });
        ended(value, halt)
    }

    fn is_up(&self, begun: Instant) -> bool {
        self.limit.is_some_and(|limit| begun.elapsed() >= limit)
    }

    /// Returns what ends work now, if anything does.
    fn look(&self, begun: Instant, progress: Option<Progress>) -> Option<Halt> {
        if self.is_up(begun) {
            return Some(Halt::TimeUp);
        }
        Python::attach(|py| self.tell(py, progress)).err().map(Halt::Raised)
    }

    fn tell(&self, py: Python<'_>, progress: Option<Progress>) -> PyResult<()> {
        py.check_signals()?;
        if let (Some(callback), Some(progress)) = (&self.progress, progress) {
            callback.call1(py, (progress.fraction, progress.done, progress.counted))?;
        }
        Ok(())
    }
}

/// Returns the result of work, or the error if it panicked or was ended by an exception.
fn ended<T>(value: thread::Result<T>, halt: Option<Halt>) -> PyResult<Ended<T>> {
    let value = value.map_err(|panic| {
        let words = panic.downcast_ref::<String>().map(String::as_str);
        let words = words.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("unknown");
        PyRuntimeError::new_err(format!("slideway has a fault, please report it: {words}"))
    })?;
    match halt {
        None => Ok(Ended::Done(value)),
        Some(Halt::TimeUp) => Ok(Ended::TimeUp(value)),
        Some(Halt::Raised(error)) => Err(error),
    }
}
