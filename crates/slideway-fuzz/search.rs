//! Small mode problems: no panic, and what the search calls proven is what exact decisions of every pattern
//! say.

use std::ops::ControlFlow;

use crate::small::{patterns, problem};
use slideway::modes::certificate::{Decision, ExactSet, Interval, decide};
use slideway::modes::{self, Completeness, ContactState, ModeProblem, SearchResult, StateKind};

/// Whether some listed state lies at the enclosed solution of a pattern, or is a set that may hold it.
fn is_listed(result: &SearchResult, pattern: &[ContactState], unknowns: &[Interval]) -> bool {
    let scale = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    result.product.states().any(|state| {
        let Some(forces) = state.normal_force(pattern.len()) else { return true };
        let largest = scale(&mut forces.iter().map(|force| force.abs()));
        let expected = |contact: usize| match pattern[contact] {
            ContactState::Gap => Interval::point(0.0),
            ContactState::Positive => unknowns[contact],
            ContactState::Negative => -unknowns[contact],
        };
        (0..pattern.len()).all(|contact| {
            let bound = expected(contact);
            let slack = 1e-6 * largest.max(bound.magnitude());
            bound.lower() - slack <= forces[contact] && forces[contact] <= bound.upper() + slack
        })
    })
}

/// Compares what is called proven with the exact outcome of every pattern.
fn check_proven(problem: &ModeProblem, result: &SearchResult) {
    let context = || format!("{problem:?}\n{result:?}");
    let mut isolated = 0_u64;
    let mut others = 0_u64;
    for pattern in patterns(problem) {
        let decision = decide(problem, &pattern).decision;
        match &decision {
            Decision::Solution { unknowns, .. } => {
                isolated += 1;
                assert!(is_listed(result, &pattern, unknowns), "missing {pattern:?}\n{}", context());
            }
            Decision::Boundary { unknowns, .. } => {
                others += 1;
                assert!(is_listed(result, &pattern, unknowns), "missing {pattern:?}\n{}", context());
            }
            Decision::Singular { set: ExactSet::Empty } | Decision::NoSolution { .. } => {}
            Decision::Singular { .. } => {
                others += 1;
                let some = result.product.states().next().is_some();
                assert!(some, "missing set of {pattern:?}\n{}", context());
            }
            Decision::Undecided { .. } => unreachable!("exact numbers are decided"),
        }
    }
    for state in result.product.states().filter(|state| state.kind() == StateKind::Solution) {
        let pattern = state.pattern(problem.contacts());
        let outcome = decide(problem, &pattern).decision;
        let is_solution = matches!(outcome, Decision::Solution { .. } | Decision::Boundary { .. });
        assert!(is_solution, "no solution {pattern:?}: {outcome:?}\n{}", context());
    }
    if others == 0 {
        let counts = result.counts();
        let found = counts.solutions.to_u64().zip(counts.gap_states.to_u64()).map(|(one, other)| one + other);
        assert_eq!(found, Some(isolated), "{}", context());
    }
}

/// Checks a small mode problem.
pub fn search(bytes: &[u8]) {
    let Some((problem, options)) = problem(bytes) else { return };
    let result = modes::search(&problem, &options, &mut |_| ControlFlow::Continue(()));
    let _ = (result.counts(), result.strategy());
    if result.completeness == Completeness::Proven {
        check_proven(&problem, &result);
    }
}
