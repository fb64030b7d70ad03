//! How a long computation reports its progress to its caller, and how the caller can end it.
//!
//! Every computation that can take more than a moment has a variant with a [`Callback`]: it is called before
//! each piece of the work, and ends the work by breaking. Results found by then are returned, marked as
//! incomplete, if they are meaningful by themselves (the solutions of a search, the motion so far); otherwise
//! nothing is returned. The library keeps no clock: the caller handles time limits and interruptions.
//!
//! ```
//! use slideway_modes::{Completeness, ModeProblem, SearchOptions, StopReason, search};
//! use std::ops::ControlFlow;
//!
//! let identity = nalgebra::DMatrix::identity(3, 3);
//! let problem = ModeProblem::from_linear_complementarity(&identity, nalgebra::dvector![-1.0, 1.0, 2.0])?;
//! let result = search(&problem, &SearchOptions::default(), &mut |_| ControlFlow::Break(()));
//! assert_eq!(result.completeness, Completeness::Partial(StopReason::Cancelled));
//! # Ok::<(), slideway_modes::ModeProblemError>(())
//! ```

use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// The progress of a computation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The name of the counted items, such as "nodes".
    pub counted: &'static str,
    /// The number of completed items.
    pub done: u64,
    /// The completed fraction of the work, from 0 to 1, if the total is known. It may grow in leaps and
    /// unevenly in time.
    pub fraction: Option<f64>,
    /// Solutions and other states found so far, if the computation looks for them.
    pub found: Option<u64>,
}

impl Progress {
    /// Progress of `done` out of `all`.
    pub fn of(counted: &'static str, done: u64, all: u64) -> Self {
        Self { counted, done, fraction: Some(done as f64 / all.max(1) as f64), found: None }
    }
}

/// Receives the progress; breaks to end the work.
pub type Callback<'c> = dyn FnMut(&Progress) -> ControlFlow<()> + Send + 'c;

/// The result of work that cannot be ended.
pub fn undisturbed<T>(compute: impl FnOnce(Work<'_>) -> T) -> T {
    compute(Work::undisturbed())
}

/// The result of work that a callback may end; `None` if it has.
///
/// Once the callback has broken, it is not called again and every piece is refused, so whatever consists of
/// pieces ends soon. The result of such work, perhaps an error, is meaningless.
///
/// # Errors
/// Those of the work.
pub fn watched<T, E>(
    callback: &mut Callback<'_>,
    compute: impl FnOnce(Work<'_>) -> Result<T, E>,
) -> Result<Option<T>, E> {
    let (result, has_ended) = as_far_as_wanted(callback, compute);
    if has_ended { Ok(None) } else { result.map(Some) }
}

/// The result of work that a callback may end, and whether it has: then whatever the work found by then.
pub fn as_far_as_wanted<T>(callback: &mut Callback<'_>, compute: impl FnOnce(Work<'_>) -> T) -> (T, bool) {
    let has_ended = AtomicBool::new(false);
    let caller = Mutex::new((callback, Progress::of("pieces", 0, 1)));
    let tell = |progress: Option<&Progress>| {
        if has_ended.load(Ordering::Relaxed) {
            return ControlFlow::Break(());
        }
        // A callback that panicked in another thread has ended the work.
        let Ok(mut caller) = caller.lock() else { return ControlFlow::Break(()) };
        let (callback, last) = &mut *caller;
        *last = *progress.unwrap_or(last);
        let flow = callback(last);
        if flow.is_break() {
            has_ended.store(true, Ordering::Relaxed);
        }
        flow
    };
    let result = compute(Work::new(&tell));
    (result, has_ended.load(Ordering::Relaxed))
}

/// Takes the progress, or repeats the latest one; breaks if the work is to end.
type Tell<'w> = &'w (dyn Fn(Option<&Progress>) -> ControlFlow<()> + Sync);

/// A computation, or a part of it.
#[derive(Clone, Copy)]
pub struct Work<'w> {
    tell: Tell<'w>,
    /// The outermost pieces are counted: their name, and how many are done.
    piece: Option<(&'static str, usize)>,
    from: f64,
    to: f64,
}

impl<'w> Work<'w> {
    /// Work that cannot be ended.
    pub fn undisturbed() -> Work<'static> {
        Work::new(&|_| ControlFlow::Continue(()))
    }

    /// The whole computation.
    fn new(tell: Tell<'w>) -> Self {
        Self { tell, piece: None, from: 0.0, to: 1.0 }
    }

    /// One of several parts that are not counted.
    #[must_use]
    pub fn part(self, index: usize, all: usize) -> Self {
        let at = |index: usize| self.from + (self.to - self.from) * index as f64 / all as f64;
        Self { from: at(index), to: at(index + 1), ..self }
    }

    /// One of several pieces, about to begin.
    ///
    /// Breaks if the work is to end.
    pub fn piece(self, counted: &'static str, index: usize, all: usize) -> ControlFlow<(), Self> {
        let piece = Self { piece: self.piece.or(Some((counted, index))), ..self.part(index, all) };
        match piece.tell(&Progress { fraction: Some(0.0), ..Progress::of(counted, index as u64, 1) }) {
            ControlFlow::Continue(()) => ControlFlow::Continue(piece),
            ControlFlow::Break(()) => ControlFlow::Break(()),
        }
    }

    /// Reports the progress of this part; breaks if the work is to end.
    pub fn tell(self, inner: &Progress) -> ControlFlow<()> {
        let fraction = inner.fraction.map(|fraction| self.from + (self.to - self.from) * fraction);
        let (counted, done) =
            self.piece.map_or((inner.counted, inner.done), |(counted, done)| (counted, done as u64));
        let found = inner.found.filter(|_| self.piece.is_none());
        (self.tell)(Some(&Progress { counted, done, fraction, found }))
    }

    /// Whether the work is to end.
    pub fn is_over(self) -> bool {
        self.flow().is_break()
    }

    /// Breaks if the work is to end: for callbacks of inner work whose own progress is not reported.
    pub fn flow(self) -> ControlFlow<()> {
        (self.tell)(None)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_pieces_tell_the_part_of_the_whole() {
        let mut told = Vec::new();
        let mut callback = |progress: &Progress| {
            told.push((progress.counted, progress.done, progress.fraction));
            ControlFlow::Continue(())
        };
        let found = watched(&mut callback, |work| {
            let second = work.part(1, 2);
            for value in 0..2 {
                let piece = second.piece("values", value, 2).continue_value().expect("it goes on");
                assert!(piece.piece("patterns", 1, 2).is_continue());
            }
            assert!(!second.is_over());
            Ok::<_, ()>(7)
        });
        assert_eq!(found, Ok(Some(7)));
        let expected = [0.5, 0.625, 0.75, 0.875, 0.875].map(Some);
        assert_eq!(told.iter().map(|(.., fraction)| *fraction).collect::<Vec<_>>(), expected);
        assert!(told.iter().all(|(counted, ..)| *counted == "values"));
        assert_eq!(told.iter().map(|(_, done, _)| *done).collect::<Vec<_>>(), [0, 0, 1, 1, 1]);
    }

    #[test]
    fn what_has_ended_calls_back_no_more_and_comes_to_nothing() {
        let mut calls = 0;
        let mut callback = |_: &Progress| {
            calls += 1;
            if calls < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let result = watched(&mut callback, |work| {
            let done = (0..10).take_while(|&index| work.piece("values", index, 10).is_continue()).count();
            assert_eq!(done, 2);
            assert!(work.is_over());
            assert!(work.tell(&Progress::of("nodes", 1, 2)).is_break());
            Err::<(), &str>("an error because nothing was done")
        });
        assert_eq!(result, Ok(None));
        assert_eq!(calls, 3);
        assert!(undisturbed(|work| work.piece("values", 0, 1).is_continue()));
    }
}
