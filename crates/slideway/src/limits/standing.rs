//! Numbers of solutions where contacts do not slide: the friction of those that stand still while the rest moves is a range,
//! and those at rest that may lift off have states of their own, so that no mode ends at a zero of a determinant. The answers at
//! evenly spaced values are compared, and what changes between them is bisected.

use super::found::{Elsewhere, Gap, ModesFound, SameEnds};
use super::rest::LEFT_OPEN;
use super::varied::Varied;
use crate::fault::Faults;
use crate::modes::existence::{CountInterval, Existence};
use crate::progress::Work;
use crate::report::{HOLDS, Status};
use crate::scan::{Scan, Stretch, evenly, samples};

/// Steps of the evenly spaced values.
const STEPS: usize = 100;

/// The numbers of solutions in a range; none if nothing stands in it, as far as a few values show.
pub(super) fn found(varied: &Varied, [from, to]: [f64; 2], work: Work<'_>) -> Option<ModesFound> {
    let stands = |value: f64| varied.stands(value).unwrap_or(false);
    if ![from, f64::midpoint(from, to), to].into_iter().any(stands) {
        return None;
    }
    let answer = |at: f64| of_value(varied, at, work);
    let tried = samples(evenly([from, to], STEPS), work, |at, _| answer(at));
    let same_ends = SameEnds::bisected([from, to]);
    let scan = Scan { answer: &answer, is_like, narrowest: same_ends.within };
    let (mut counts, mut starts, mut gaps) = (Vec::<CountInterval>::new(), Vec::new(), Vec::new());
    let mut begins = f64::INFINITY;
    for Stretch { from, to, found, .. } in scan.adjoining(&tried) {
        match found {
            // Between two states neither may hold within the tolerance.
            Ok(_) if to - from <= same_ends.within.max(LEFT_OPEN * from.abs().max(to.abs())) => {
                match counts.last_mut() {
                    Some(last) => last.to = to,
                    None => begins = begins.min(from),
                }
            }
            Ok(found) => {
                let from = if counts.is_empty() { from.min(begins) } else { from };
                counts.push(CountInterval { from, to, ..found.numbers });
                starts.push(found.starts);
            }
            Err(faults) => gaps.push(Gap { from, to, faults }),
        }
    }
    let elsewhere = Elsewhere::Sampled((to - from) / STEPS as f64);
    let tried = tried.iter().map(|sample| sample.at).collect();
    let found = ModesFound::new((Existence::default(), counts), elsewhere, same_ends);
    Some(ModesFound { starts, gaps, tried, ..found })
}

/// The answer at a value.
#[derive(Clone)]
struct Found {
    numbers: CountInterval,
    /// How each state starts, where contacts that may lift off are at rest.
    starts: Option<Vec<String>>,
}

fn of_value(varied: &Varied, at: f64, work: Work<'_>) -> Result<Found, Faults> {
    let report = varied.solved(at, work)?;
    let numbers = CountInterval {
        from: at,
        to: at,
        solutions: report.solutions.len(),
        gap_states: report.preload_gap_states.len(),
        continuum: report.status == Status::Continuum,
    };
    // Of infinitely many states it counts that one of them is of rest.
    let starts = if report.rests() { Some(vec![HOLDS.to_owned()]) } else { report.starts() };
    Ok(Found { numbers, starts })
}

fn is_like(one: &Result<Found, Faults>, other: &Result<Found, Faults>) -> bool {
    match (one, other) {
        (Ok(one), Ok(other)) => one.numbers.is_like(&other.numbers) && one.starts == other.starts,
        (one, other) => one.is_err() && other.is_err(),
    }
}
