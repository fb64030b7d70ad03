//! Small mode problems: the proof of all patterns says of each what its exact decision says.
#![no_main]

use libfuzzer_sys::fuzz_target;
use slideway::modes::ModeProblem;
use slideway::modes::certificate::{Decision, decide};
use slideway::modes::exhaustive::{self, Pattern};
use slideway_fuzz::{patterns, problem};

/// Compares the proof of all patterns with their decisions one by one.
fn check(problem: &ModeProblem) {
    let proved = exhaustive::prove(problem);
    for pattern in patterns(problem) {
        let number: Pattern = pattern.iter().copied().collect();
        let expected = decide(problem, &pattern);
        let found = proved.iter().find(|(other, _)| *other == number).map(|(_, verdict)| verdict);
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
