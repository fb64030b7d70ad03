//! Exit codes.

use slideway::report::Status;
use std::process::ExitCode;

/// The outcome of a command, as its exit code.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// There are solutions, or the command did what it was asked to do.
    Done = 0,
    /// There is no solution: friction locks the mechanism.
    NoSolution = 1,
    /// The input makes no sense.
    Refused = 2,
    /// The search was incomplete and found nothing, or time was up.
    Unknown = 3,
    /// It was interrupted.
    Interrupted = 130,
}

impl From<Status> for Outcome {
    fn from(status: Status) -> Self {
        match status {
            Status::One | Status::Several | Status::Continuum | Status::PreloadGap => Self::Done,
            Status::None => Self::NoSolution,
            Status::Unknown => Self::Unknown,
        }
    }
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        Self::from(outcome as u8)
    }
}
