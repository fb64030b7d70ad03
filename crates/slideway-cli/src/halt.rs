//! Reasons for which work ends before it is done.

use crate::outcome::Outcome;
use std::time::Duration;

/// The reason why work ended before it was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Halt {
    /// Someone interrupted it.
    Interrupted,
    /// It took longer than permitted.
    TimeLimit(Duration),
}

impl Halt {
    /// Returns the reason in words, for messages.
    pub(crate) fn in_words(self) -> String {
        match self {
            Self::Interrupted => "interrupted".to_owned(),
            Self::TimeLimit(limit) => format!("ended by the time limit of {}", rough(limit.as_secs_f64())),
        }
    }

    /// The exit code where there is no answer.
    pub(crate) fn outcome(self) -> Outcome {
        match self {
            Self::Interrupted => Outcome::Interrupted,
            Self::TimeLimit(_) => Outcome::Unknown,
        }
    }
}

/// A time without needless digits.
pub(crate) fn rough(seconds: f64) -> String {
    if seconds < 1.0 {
        format!("{:.0} ms", 1000.0 * seconds)
    } else if seconds < 90.0 {
        format!("{seconds:.0} s")
    } else if seconds < 5400.0 {
        format!("{:.0} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}
