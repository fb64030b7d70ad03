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
    /// So many bounces, and so many events in all: each bounce where the line before hits, and weaker.
    Bounces {
        /// Times that the same is hit.
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
        let (hits, between) = dying_bounces(&events[next..]);
        let hits = hits.saturating_sub(1);
        if hits >= BOUNCES {
            let events = (hits + 1) * between + hits;
            lines.push(LogLine::Bounces { hits, events });
            next += events;
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

/// How many bounces follow the hit that is the first event, each where that hits and with a smaller loss of energy, and how many
/// events are between two: at a stop the joint turns round before each; at a face that is left it does not.
fn dying_bounces(events: &[EventReport]) -> (usize, usize) {
    let is_plain = |event: &EventReport| event.branches.is_empty() && !event.branches_left_out;
    let only = |event: &EventReport, kind: CauseKind| match event.causes.as_slice() {
        [cause] if cause.kind == kind && is_plain(event) => cause.of.clone(),
        _ => None,
    };
    let Some(first) = events.first().filter(|event| is_plain(event)) else { return (0, 0) };
    let mut lost = first.energy_lost;
    let mut is_weaker =
        |event: &EventReport| event.energy_lost < std::mem::replace(&mut lost, event.energy_lost);
    if !first.causes.is_empty() && first.causes.iter().all(|cause| cause.kind == CauseKind::Lands) {
        let same = |event: &&EventReport| event.causes == first.causes && is_plain(event) && is_weaker(event);
        return (events[1..].iter().take_while(same).count(), 0);
    }
    let Some(joint) = only(first, CauseKind::Hits) else { return (0, 0) };
    let bounces = events[1..].chunks_exact(2).take_while(|pair| {
        let turns = only(&pair[0], CauseKind::Stops).as_ref() == Some(&joint);
        turns && only(&pair[1], CauseKind::Hits).as_ref() == Some(&joint) && is_weaker(&pair[1])
    });
    (bounces.count(), 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::told::report::CauseReport;

    /// An event of the joint "guide", at the number of its place.
    fn event((place, (kind, energy_lost)): (usize, &(CauseKind, f64))) -> EventReport {
        EventReport {
            time: place as f64,
            causes: vec![CauseReport { kind: *kind, of: Some("guide".to_owned()) }],
            words: String::new(),
            mode: None,
            attainable: None,
            branches: Vec::new(),
            branches_left_out: false,
            energy_lost: *energy_lost,
        }
    }

    fn told(kinds: &[(CauseKind, f64)], all: bool) -> Vec<String> {
        let events: Vec<EventReport> = kinds.iter().enumerate().map(event).collect();
        let line = |line: &LogLine<'_>| match line {
            LogLine::Event(event) => event.time.to_string(),
            LogLine::LeftOut(events) => format!("{events} left out"),
            LogLine::Bounces { hits, events } => format!("{hits} hits in {events}"),
        };
        lines(&events, all).iter().map(line).collect()
    }

    #[test]
    fn bounces_that_die_away_are_one_line_between_the_first_and_the_last() {
        let [hit, turn] = [CauseKind::Hits, CauseKind::Stops];
        let dying = [(hit, 8.0), (turn, 0.0), (hit, 4.0), (turn, 0.0), (hit, 2.0), (turn, 0.0), (hit, 1.0)];
        let dying = [&[(CauseKind::Start, 0.0)], &dying[..], &[(turn, 0.0), (hit, 0.5)]].concat();
        assert_eq!(told(&dying, false), ["0", "1", "3 hits in 7", "9"]);
        assert_eq!(told(&dying, true).len(), dying.len());
        // Of three bounces the middle one is no line longer than they are.
        assert_eq!(told(&dying[..8], false).len(), 8);
        // A stop that loses as much each time is no bouncing that dies away, nor one at two stops in turn.
        let steady: Vec<(CauseKind, f64)> =
            (0..9).map(|place| if place % 2 == 0 { (hit, 1.0) } else { (turn, 0.0) }).collect();
        let between: Vec<(CauseKind, f64)> = (0..9).map(|place| (hit, 9.0 - f64::from(place))).collect();
        assert_eq!([told(&steady, false).len(), told(&between, false).len()], [9, 9]);
    }

    /// Between two hits of a face that is left nothing else happens.
    #[test]
    fn chatter_on_a_face_is_one_line() {
        let lands: Vec<(CauseKind, f64)> =
            (0..8).map(|place| (CauseKind::Lands, 9.0 - f64::from(place))).collect();
        assert_eq!(told(&lands, false), ["0", "6 hits in 6", "7"]);
    }

    #[test]
    fn of_a_long_log_the_middle_is_left_out() {
        let long = vec![(CauseKind::Slips, 0.0); FIRST + LAST + 1];
        let lines = told(&long, false);
        assert_eq!((lines.len(), &*lines[FIRST]), (FIRST + LAST + 1, "1 left out"));
        assert_eq!(told(&long[1..], false).len(), FIRST + LAST);
    }
}
