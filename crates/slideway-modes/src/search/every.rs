//! Every pattern of a group of few contacts.

use super::leaf::Leaves;
use super::load::LoadedProblem;
use super::monitor::Monitor;
use super::report::PatternShares;
use super::sieve::Sieve;
use super::tree::TreeReport;
use crate::problem::{ContactState, ScaledProblem, advance};

/// Decides all patterns in the order of enumeration. Without `certify`, each is solved within tolerances.
pub(super) fn try_all(
    loaded: &LoadedProblem<'_>,
    scaled: &ScaledProblem,
    leaves: &mut Leaves<'_>,
    certify: bool,
    monitor: &mut Monitor<'_>,
) -> TreeReport {
    let mut sieve = if certify { Sieve::new(loaded.view()) } else { None };
    let share = 1.0 / scaled.patterns_from(0).1 as f64;
    let mut report = TreeReport::default();
    let mut pattern = vec![ContactState::Positive; scaled.contacts()];
    let mut more = true;
    while more && monitor.visit(report.nodes as f64 * share, leaves.found()) {
        report.nodes += 1;
        if sieve.as_mut().is_some_and(|sieve| sieve.excludes(&pattern)) {
            leaves.exclude(&pattern);
        } else if let Err(reason) = leaves.examine(&pattern, monitor) {
            monitor.stop(reason);
        }
        more = advance(&mut pattern, |contact| scaled.states(contact));
    }
    if !more && !leaves.has_solutions() {
        offer_closest(scaled, leaves);
    }
    let examined = report.nodes as f64 * share;
    let unexplored = if more { 1.0 - examined } else { 0.0 };
    report.shares = PatternShares { examined: 1.0 - unexplored, unexplored, ..PatternShares::default() };
    report
}

/// Offers all patterns without gaps as candidates for those closest to locking.
fn offer_closest(scaled: &ScaledProblem, leaves: &mut Leaves<'_>) {
    let mut pattern = vec![ContactState::Positive; scaled.contacts()];
    leaves.offer_closest(&pattern);
    while advance(&mut pattern, |_| &ContactState::PRESSED) {
        leaves.offer_closest(&pattern);
    }
}
