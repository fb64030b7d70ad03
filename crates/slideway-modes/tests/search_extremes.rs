//! The search on numbers from all over the range of floating point: what it calls proven, exact decisions of
//! every pattern confirm.

use std::ops::ControlFlow;

use crate::search_support::{Random, patterns, switches};
use nalgebra::{DMatrix, DVector};
use slideway_modes::certificate::{Decision, ExactSet, decide};
use slideway_modes::{Completeness, ContactState, ModeProblem, SearchOptions, search};

/// Zero, or a power of two between 2^-1074 and 2^1023 times a small whole number.
fn extreme(random: &mut Random, most: i32) -> f64 {
    let exponent = (random.number() * f64::from(most)).trunc();
    let half = (exponent / 2.0).trunc();
    let (one, other) = (half, exponent - half);
    if random.below(6) == 0 { 0.0 } else { random.integer(3) * one.exp2() * other.exp2() }
}

fn problem(random: &mut Random, contacts: usize, (columns, loads): (i32, i32), jumps: bool) -> ModeProblem {
    let mut matrix = |most: i32| DMatrix::from_fn(contacts, contacts, |_, _| extreme(random, most));
    let [positive, negative] = [columns, columns].map(&mut matrix);
    let [up, down] =
        if jumps { [loads, loads].map(&mut matrix) } else { [0, 1].map(|_| positive.map(|_| 0.0)) };
    let load = DVector::from_fn(contacts, |_, _| extreme(random, loads));
    ModeProblem::new(positive, negative, up, down, load).expect("finite numbers")
}

/// Every pattern that admits something is among those listed by a search that calls its answer proven.
fn assert_complete(problem: &ModeProblem, options: &SearchOptions) -> bool {
    let result = search(problem, options, &mut |_| ControlFlow::Continue(()));
    if result.completeness != Completeness::Proven {
        return false;
    }
    let lists = result.lists(10_000, 10_000);
    let mut listed: Vec<Vec<ContactState>> = Vec::new();
    for solution in &lists.solutions {
        listed.extend(solution.patterns.iter().map(|p| p.iter().map(|&side| side.into()).collect()));
    }
    listed.extend(lists.gaps.iter().flat_map(|gap| gap.patterns.iter().cloned()));
    for pattern in patterns(problem) {
        if let Decision::Solution { .. } = decide(problem, &pattern).decision {
            assert!(listed.contains(&pattern), "{pattern:?} of {problem:?}\n{:?}", options.arguments);
        }
        let set = matches!(&decide(problem, &pattern).decision, Decision::Singular { set } if *set != ExactSet::Empty);
        let found = result.product.states().next().is_some();
        assert!(!set || found, "the set of {pattern:?} of {problem:?}\n{:?}", options.arguments);
    }
    true
}

fn compare(count: u64, ranges: (i32, i32)) {
    let mut proven = 0;
    for seed in 0..count {
        let mut random = Random::new(seed);
        let contacts = 1 + random.below(4);
        let problem = problem(&mut random, contacts, ranges, seed % 2 == 0);
        for options in switches() {
            proven += u64::from(assert_complete(&problem, &options));
        }
    }
    assert!(proven > count, "{proven}");
}

#[test]
fn columns_of_all_sizes() {
    compare(120, (1022, 20));
}

#[test]
fn loads_of_all_sizes() {
    compare(120, (20, 1022));
}

#[test]
fn numbers_of_all_sizes() {
    compare(120, (1022, 1022));
}
