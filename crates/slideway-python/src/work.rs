//! Work without the interpreter: it ends when its time is up, on Ctrl-C, and when a callback raises.

use pyo3::exceptions::{PyTimeoutError, PyValueError};
use pyo3::prelude::*;
use slideway::progress::{Callback, Progress};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Time between two looks at signals, and between two calls of a callback.
const BETWEEN: Duration = Duration::from_millis(50);

/// What ends work early, and who is told of its progress.
pub(crate) struct Watch {
    limit: Option<Duration>,
    progress: Option<Py<PyAny>>,
}

/// How work ended early.
enum Halt {
    TimeUp,
    Raised(PyErr),
}

/// What came of work.
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
            _ => Err(PyTimeoutError::new_err("the work was not done within time_limit")),
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

    /// Runs work without the interpreter.
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
            if halt.is_some() {
                return ControlFlow::Break(());
            }
            let now = Instant::now();
            if self.limit.is_some_and(|limit| now - begun >= limit) {
                halt = Some(Halt::TimeUp);
            } else if now - looked >= BETWEEN {
                looked = now;
                halt = Python::attach(|py| self.tell(py, progress)).err().map(Halt::Raised);
            }
            if halt.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let value = py.detach(|| work(&mut look));
        match halt {
            None => Ok(Ended::Done(value)),
            Some(Halt::TimeUp) => Ok(Ended::TimeUp(value)),
            Some(Halt::Raised(error)) => Err(error),
        }
    }

    fn tell(&self, py: Python<'_>, progress: &Progress) -> PyResult<()> {
        py.check_signals()?;
        if let Some(callback) = &self.progress {
            callback.call1(py, (progress.fraction, progress.done, progress.counted))?;
        }
        Ok(())
    }
}
