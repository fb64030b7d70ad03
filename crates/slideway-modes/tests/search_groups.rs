//! Groups and joined groups in turns, and the end of a search whose groups are all known.

use crate::instances::structured::{subset_sum, subsets_with_sum, weights_with_subset};
use crate::search_support::{Random, assert_same_as_enumeration, run};
use nalgebra::{DMatrix, DVector};
use slideway_modes::{Arguments, Completeness, ModeProblem, SearchOptions, StopReason, search};
use std::ops::ControlFlow;

/// 2^14 combinations of which few have the sum: the number of these by adding one weight after the other.
#[test]
fn subset_sums_are_found_in_joined_groups() {
    for (most, seed) in [(20, 1), (300, 2), (5000, 3)] {
        let (weights, target) = weights_with_subset(14, most, seed);
        let result = run(&subset_sum(&weights, target), &SearchOptions::default());
        assert_eq!(result.completeness, Completeness::Proven);
        assert_eq!(result.counts().solutions.to_u64(), Some(subsets_with_sum(&weights, target)));
        for state in result.product.states() {
            let x = state.normal_force(16).expect("points");
            assert_eq!(weights.iter().zip(&x).map(|(weight, x)| weight * x.max(0.0)).sum::<f64>(), target);
        }
    }
    // One node for each combination at least, if the groups were solved one after the other.
    let (weights, target) = weights_with_subset(14, 50_000, 1);
    let result = run(&subset_sum(&weights, target), &SearchOptions::default());
    assert!(result.abandoned_nodes > 0 && result.nodes() < 1 << 14, "{}", result.nodes());
}

/// Sums that are added up one after the other, so that only the end of a long chain excludes anything.
#[test]
fn ancestors_far_away_join_too() {
    let (weights, target) = weights_with_subset(10, 1000, 4);
    let t = 2.0 * target - weights.iter().sum::<f64>();
    // Unknowns x_1, s_1, x_2, s_2, ...: |x_k| = a_k, s_k = s_{k-1} + x_k; then |u| = s - t, |v| = t - s.
    let size = 2 * weights.len() + 2;
    let (mut a, mut b) = (DMatrix::zeros(size, size), DMatrix::zeros(size, size));
    let mut load = DVector::zeros(size);
    for (item, &weight) in weights.iter().enumerate() {
        let (x, sum) = (2 * item, 2 * item + 1);
        (b[(x, x)], load[x]) = (1.0, weight);
        (a[(sum, sum)], a[(sum, x)]) = (1.0, -1.0);
        if item > 0 {
            a[(sum, sum - 2)] = -1.0;
        }
    }
    for (row, sign) in [(size - 2, -1.0), (size - 1, 1.0)] {
        (b[(row, row)], a[(row, size - 3)], load[row]) = (1.0, sign, sign * t);
    }
    let problem = ModeProblem::from_absolute_value_equation(&a, &b, load).expect("shapes fit");
    let result = run(&problem, &SearchOptions::default());
    assert_eq!(result.completeness, Completeness::Proven);
    assert_eq!(result.counts().solutions.to_u64(), Some(subsets_with_sum(&weights, target)));
}

/// Chains of small groups, many of which admit nothing.
#[test]
fn chains_have_the_solutions_of_all_patterns() {
    for seed in 0..12 {
        let mut random = Random::new(seed);
        let size = 11;
        let coupling = random.matrix(size, size);
        let m = DMatrix::from_fn(size, size, |row, column| match row.cmp(&column) {
            std::cmp::Ordering::Less => 0.0,
            std::cmp::Ordering::Equal => -1.0,
            std::cmp::Ordering::Greater => coupling[(row, column)] / 2.0,
        });
        let q = DVector::from_fn(size, |row, _| if row < 8 { 1.0 } else { random.number() });
        let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
        assert_same_as_enumeration(&problem, &SearchOptions::default(), 0);
    }
}

/// `w = -z + 1` for each item, and rows that need a sum of 9 1/2: after the first combinations every group has
/// been solved for every sum, and the search goes through 2^18 combinations without another node.
#[test]
fn a_search_can_be_ended_between_known_groups() {
    let items = 18;
    let m = DMatrix::from_fn(items + 2, items + 2, |row, column| {
        let of_items = if column < items { [1.0, -1.0] } else { [0.0, 0.0] };
        if row == column {
            -1.0
        } else if row < items {
            0.0
        } else {
            of_items[row - items]
        }
    });
    let q = DVector::from_fn(items + 2, |row, _| if row < items { 1.0 } else { [-9.5, 9.5][row - items] });
    let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
    let mut asked = 0;
    let result = search(&problem, &SearchOptions::default(), &mut |_| {
        asked += 1;
        if asked < 2000 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    assert_eq!((result.completeness, asked), (Completeness::Partial(StopReason::Cancelled), 2000));
    assert!(result.nodes() < 2000);
}

/// Where one group has no solution, a limit of solutions of the others leaves nothing open: a search for any solution
/// finds one, or none exists. Groups beside each other, and behind others; the whole search tells which is the case.
#[test]
fn a_search_for_any_solution_finds_one_or_proves_that_there_is_none() {
    let q = DVector::from_fn(7, |row, _| if row == 0 { -1.0 } else { 1.0 });
    let zero = ModeProblem::from_linear_complementarity(&DMatrix::zeros(7, 7), q).expect("shapes fit");
    let mut without = 0;
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let size = 7 + random.below(4);
        let entry = |random: &mut Random| (random.below(5) as f64) - 2.0;
        let m = DMatrix::from_fn(size, size, |row, column| {
            let acts = row == column || (row > column && random.below(6) == 0);
            if acts { entry(&mut random) } else { 0.0 }
        });
        let q = DVector::from_fn(size, |_, _| random.below(5) as f64 - 1.0);
        let problem = ModeProblem::from_linear_complementarity(&m, q).expect("shapes fit");
        let problem = if seed == 0 { &zero } else { &problem };
        let every_pattern = seed % 2 == 0;
        let arguments = Arguments { every_pattern, ..Arguments::default() };
        let all = run(problem, &SearchOptions { arguments, ..SearchOptions::default() });
        assert_eq!(all.completeness, Completeness::Proven);
        for most in [1, 2] {
            let options = SearchOptions { arguments, ..SearchOptions::within(None, Some(most)) };
            let some = run(problem, &options);
            assert_eq!(
                some.product.states().next().is_none(),
                all.product.states().next().is_none(),
                "{seed}, {most}"
            );
            if some.product.states().next().is_none() {
                assert_eq!(some.completeness, Completeness::Proven, "{seed}, {most}");
            }
        }
        without += u64::from(all.product.states().next().is_none());
    }
    assert!((50..350).contains(&without), "{without}");
}
