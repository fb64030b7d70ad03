//! The lines of a log of events: of bounces that die away only the first and the last, of a long log only the beginning and
//! the end.

use super::report::EventReport;
use crate::motion::moving::cause::CauseKind;

/// From a longer log, this many lines are shown at the beginning, ...
const FIRST: usize = 40;
/// ... and this many at the end.
const LAST: usize = 10;
/// This many bounces at least are told as one line: fewer take no more room than it.
const BOUNCES: usize = 3;

/// A line of the log.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LogLine<'a> {
    /// An event.
    Event(&'a EventReport),
    /// So many events that are not shown.
    LeftOut(usize),
    /// So many bounces, and so many events in all: each bounce at the stop of the line before, and weaker.
    Bounces {
        /// Times that the stop is hit.
        hits: usize,
        /// Hits, and where it turns round between them.
        events: usize,
    },
}

impl LogLine<'_> {
    fn events(&self) -> usize {
        match self {
            Self::Event(_) => 1,
            Self::LeftOut(events) | Self::Bounces { events, .. } => *events,
        }
    }
}

/// The lines of a log, with all events if these are wanted.
pub(super) fn lines(events: &[EventReport], all: bool) -> Vec<LogLine<'_>> {
    if all {
        return events.iter().map(LogLine::Event).collect();
    }
    let mut lines = Vec::new();
    let mut next = 0;
    while let Some(event) = events.get(next) {
        lines.push(LogLine::Event(event));
        // The last bounce is an event again: it tells whether what bounces has come to rest.
        let hits = dying_bounces(&events[next..]).saturating_sub(1);
        if hits >= BOUNCES {
            lines.push(LogLine::Bounces { hits, events: 2 * hits + 1 });
            next += 2 * hits + 1;
        }
        next += 1;
    }
    if let Some(hidden) = lines.len().checked_sub(FIRST + LAST).filter(|hidden| *hidden > 0) {
        let middle = FIRST..FIRST + hidden;
        let left_out = lines[middle.clone()].iter().map(LogLine::events).sum();
        lines.splice(middle, [LogLine::LeftOut(left_out)]);
    }
    lines
}

/// How many bounces follow the hit that is the first event, each at the same stop, as the joint turns round before it, and
/// with a smaller loss of energy.
fn dying_bounces(events: &[EventReport]) -> usize {
    let only = |event: &EventReport, kind: CauseKind| match event.causes.as_slice() {
        [cause] if cause.kind == kind && event.branches.is_empty() && !event.branches_left_out => {
            cause.of.clone()
        }
        _ => None,
    };
    let Some(joint) = events.first().and_then(|event| only(event, CauseKind::Hits)) else { return 0 };
    let mut lost = events[0].energy_lost;
    let bounces = events[1..].chunks_exact(2).take_while(|pair| {
        let is_weaker = pair[1].energy_lost < lost;
        lost = pair[1].energy_lost;
        let turns = only(&pair[0], CauseKind::Stops).as_ref() == Some(&joint);
        turns && only(&pair[1], CauseKind::Hits).as_ref() == Some(&joint) && is_weaker
    });
    bounces.count()
}
