//! What limits come to, in words.

use super::report::{CountLimits, Direction};
use crate::report::precise;

/// Sentences on where the mechanism moves, and in which direction (Klepp (2002), section 7).
pub(super) fn conclusion(name: &str, forwards: &Direction, reversed: Option<&Direction>) -> Vec<String> {
    let Some(reversed) = reversed else { return one_direction(name, &forwards.counts) };
    let mut ends: Vec<f64> =
        forwards.counts.iter().chain(&reversed.counts).flat_map(|count| [count.from, count.to]).collect();
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let verdict = |pair: &[f64]| {
        let middle = f64::midpoint(pair[0], pair[1]);
        let [one, other] = [&forwards.counts, &reversed.counts].map(|counts| moves(counts, middle));
        Some(match (one?, other?) {
            (true, true) => "it can move in both directions, so that it can oscillate",
            (true, false) => "it can only move as in the model; the other way friction locks it",
            (false, true) => {
                "it can only move against the direction of the model; the other way friction locks it"
            }
            (false, false) => "friction locks it in both directions",
        })
    };
    let pieces = ends.windows(2).filter_map(|pair| Some(([pair[0], pair[1]], verdict(pair)?)));
    sentences(name, pieces)
}

fn one_direction(name: &str, counts: &[CountLimits]) -> Vec<String> {
    let pieces = counts.iter().map(|count| {
        let verdict = match (count.solutions, count.preload_gap_states) {
            (0, 0) => "no solution: friction locks it",
            (0, _) => "no solution, but a state with the preload between the faces",
            (1, _) => "one solution",
            (2, _) => "two solutions",
            (3, _) => "three solutions",
            _ => "more than three solutions",
        };
        ([count.from, count.to], verdict)
    });
    sentences(name, pieces)
}

/// Whether there is a solution or a preload-gap state; none where nothing is known.
fn moves(counts: &[CountLimits], at: f64) -> Option<bool> {
    let count = counts.iter().find(|count| count.from < at && at < count.to)?;
    Some(count.solutions + count.preload_gap_states > 0)
}

/// One sentence for each stretch with the same verdict.
fn sentences<'v>(name: &str, pieces: impl Iterator<Item = ([f64; 2], &'v str)>) -> Vec<String> {
    let mut joined: Vec<([f64; 2], &str)> = Vec::new();
    for ([from, to], verdict) in pieces {
        match joined.last_mut() {
            Some(last) if last.1 == verdict && last.0[1] == from => last.0[1] = to,
            _ => joined.push(([from, to], verdict)),
        }
    }
    let sentence = |([from, to], verdict): ([f64; 2], &str)| {
        format!("{name} from {} to {}: {verdict}.", precise(from), precise(to))
    };
    joined.into_iter().map(sentence).collect()
}
