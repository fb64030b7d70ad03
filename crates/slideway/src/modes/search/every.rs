//! Every pattern of a group of few contacts.

use super::leaf::Leaves;
use super::load::LoadedProblem;
use super::monitor::Monitor;
use super::report::PatternShares;
use super::sieve::{Sieve, Sieved};
use super::tree::TreeReport;
use crate::modes::scaling::ScaledProblem;
use crate::modes::solutions::ContactState;

/// Decides all patterns in the order of enumeration. Without `certify` each is solved within tolerances.
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
        match sieve.as_mut().map(|sieve| sieve.test(&pattern)) {
            Some(Sieved::NoSolution { determinant }) => leaves.exclude(&pattern, determinant),
            Some(Sieved::Open) | None => {
                if let Err(reason) = leaves.examine(&pattern) {
                    monitor.stop(reason);
                }
            }
        }
        more = advance(&mut pattern, scaled);
    }
    let examined = report.nodes as f64 * share;
    let unexplored = if more { 1.0 - examined } else { 0.0 };
    report.shares = PatternShares { examined: 1.0 - unexplored, unexplored, ..PatternShares::default() };
    report
}

/// The next pattern, the last contact changing fastest; false after the last one.
fn advance(pattern: &mut [ContactState], problem: &ScaledProblem) -> bool {
    for contact in (0..pattern.len()).rev() {
        let states = problem.states(contact);
        match states.get(pattern[contact] as usize + 1) {
            Some(&next) => {
                pattern[contact] = next;
                return true;
            }
            None => pattern[contact] = ContactState::Positive,
        }
    }
    false
}
