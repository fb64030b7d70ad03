//! What the loads do with a mechanism that has slowed down and stopped.

use super::margins::PATTERNS;
use crate::fault::{Fault, FaultKind};
use crate::model::Model;
use crate::progress::{Callback, watched};
use crate::report::{FromRest, SolveReport, SpeedChange};
use crate::standstill::{Beginning, HoldVerdict, Range, beginning_within};

/// Adds what the same loads do from rest, if some coordinate slows down and no drive prescribes a motion; that it
/// was not examined, if there are more states of joints and contacts than modes for which margins are computed.
/// Not if the callback breaks.
pub(super) fn add(report: &mut SolveReport, model: &Model, progress: &mut Callback<'_>) {
    let mut coordinates = report.solutions.iter().flat_map(|solution| &solution.coordinates);
    if coordinates.all(|coordinate| coordinate.speed != Some(SpeedChange::SlowsDown)) {
        return;
    }
    if !model.drives.is_empty() {
        return;
    }
    report.from_rest = match watched(progress, |work| beginning_within(model, PATTERNS, work)) {
        Ok(None) => None,
        Ok(Some(None)) => Some(FromRest::Undecided),
        Ok(Some(Some(beginning))) => Some(from_rest(report, &beginning)),
        Err(faults) => {
            let is_too_many = |fault: &Fault| matches!(fault.kind, FaultKind::TooManyStates { .. });
            faults.sorted().into_iter().any(is_too_many).then_some(FromRest::NotExamined)
        }
    };
}

fn from_rest(report: &SolveReport, beginning: &Beginning) -> FromRest {
    match beginning.verdict {
        HoldVerdict::Holds | HoldVerdict::HoldsUntilPushed | HoldVerdict::MayHold => FromRest::Rests,
        HoldVerdict::HoldsOrSlips => FromRest::RestsOrMoves,
        HoldVerdict::Neither => FromRest::Neither,
        HoldVerdict::Moves | HoldVerdict::DoesNotHold => match direction(report, beginning) {
            Some(1) => FromRest::MovesOn,
            Some(-1) => FromRest::MovesBack,
            _ => FromRest::Moves,
        },
    }
}

/// The one direction in which a mechanism of one degree of freedom begins to move, against that of its rate.
fn direction(report: &SolveReport, beginning: &Beginning) -> Option<i8> {
    let [state] = report.state.as_slice() else { return None };
    let sign = |range: &Range| match (range.least, range.greatest) {
        (Some(least), _) if least > 0.0 => Some(1),
        (_, Some(greatest)) if greatest < 0.0 => Some(-1),
        _ => None,
    };
    let mut signs = beginning.accelerations().map(|coordinates| sign(&coordinates.first()?.acceleration));
    let first = signs.next()??;
    let is_one = signs.all(|sign| sign == Some(first));
    is_one.then_some(if state.rate < 0.0 { -first } else { first })
}
