//! Small mode problems: the proof of all patterns says of each what its exact decision says.
#![no_main]

use libfuzzer_sys::fuzz_target;
use slideway::modes::certificate::{Decision, decide};
use slideway::modes::{ContactState, ModeProblem, exhaustive};
use slideway_fuzz::{patterns, problem};

/// Compares the proof of all patterns with their decisions one by one.
fn check(problem: &ModeProblem) {
    if (0..problem.contacts()).any(|contact| problem.has_jump(contact)) {
        return;
    }
    let proved = exhaustive::prove(problem);
    for pattern in patterns(problem) {
        let bit = |(at, state): (usize, &ContactState)| u64::from(*state == ContactState::Negative) << at;
        let bits: u64 = pattern.iter().enumerate().map(bit).sum();
        let expected = decide(problem, &pattern);
        let found = proved.iter().find(|(other, _)| *other == bits).map(|(_, verdict)| verdict);
        match expected.decision {
            Decision::NoSolution { .. } => assert_eq!(found, None, "{pattern:?}\n{problem:?}"),
            _ => assert_eq!(found, Some(&expected), "{pattern:?}\n{problem:?}"),
        }
    }
}

fuzz_target!(|bytes: &[u8]| {
    if let Some((problem, _)) = problem(bytes) {
        check(&problem);
    }
});
