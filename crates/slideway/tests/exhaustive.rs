//! The exhaustive screening against the simple enumerator: it may keep too much, but never drops a solution.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use slideway::modes::exhaustive::{prove, screen};
use slideway::modes::{Limits, ModeProblem, Side, enumerate};

/// The patterns that the simple enumerator finds to have a solution, inside or on the boundary.
fn with_solution(problem: &ModeProblem) -> Vec<u64> {
    let bits = |pattern: &Vec<Side>| {
        pattern.iter().enumerate().map(|(k, side)| u64::from(*side == Side::Negative) << k).sum::<u64>()
    };
    let solutions = enumerate(problem, &Limits::default()).unwrap();
    let mut patterns: Vec<u64> =
        solutions.solutions.iter().flat_map(|solution| &solution.patterns).map(bits).collect();
    patterns.sort_unstable();
    patterns
}

fn matrix(entries: &[f64], n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| entries[i * 16 + j])
}

fn problem(entries: &[f64], right_hand_side: &[f64], n: usize) -> ModeProblem {
    let rhs = DVector::from_column_slice(&right_hand_side[..n]);
    ModeProblem::from_linear_complementarity(&matrix(entries, n), rhs).unwrap()
}

fn check(problem: &ModeProblem) -> usize {
    let screening = screen(problem);
    let found = with_solution(problem);
    for pattern in &found {
        assert!(screening.remaining.binary_search(pattern).is_ok(), "{pattern:b} was dropped");
    }
    assert_eq!(screening.excluded + screening.remaining.len() as u64, 1 << problem.contacts());
    screening.remaining.len() - found.len()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 150, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_solution_is_dropped(
        n in 1_usize..14,
        entries in prop::collection::vec(-1.0..1.0_f64, 256),
        rhs in prop::collection::vec(-1.0..1.0_f64, 16),
    ) {
        check(&problem(&entries, &rhs, n));
    }

    #[test]
    fn no_solution_is_dropped_in_degenerate_problems(
        n in 1_usize..10,
        entries in prop::collection::vec((-2..3_i8).prop_map(f64::from), 256),
        rhs in prop::collection::vec((-2..3_i8).prop_map(f64::from), 16),
    ) {
        check(&problem(&entries, &rhs, n));
    }

    #[test]
    fn scaling_of_rows_changes_nothing(
        n in 3_usize..9,
        entries in prop::collection::vec(-1.0..1.0_f64, 256),
        rhs in prop::collection::vec(-1.0..1.0_f64, 16),
        exponents in prop::collection::vec(-60..60_i32, 16),
    ) {
        let plain = problem(&entries, &rhs, n);
        let scale = DVector::from_fn(n, |i, _| f64::from(exponents[i]).exp2());
        let scaled = |matrix: &DMatrix<f64>| DMatrix::from_diagonal(&scale) * matrix;
        let columns = Side::BOTH.map(|side| scaled(plain.columns(side)));
        let zeros = DMatrix::zeros(n, n);
        let right_hand_side = plain.right_hand_side().component_mul(&scale);
        let [positive, negative] = columns;
        let scaled = ModeProblem::new(positive, negative, zeros.clone(), zeros, right_hand_side).unwrap();
        prop_assert_eq!(screen(&plain), screen(&scaled));
    }
}

#[test]
fn hardly_anything_is_left_in_doubt() {
    let mut state = 7_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let n = 14;
    let entries = DMatrix::from_fn(n, n, |_, _| random());
    let rhs = DVector::from_fn(n, |_, _| random());
    let doubtful = check(&ModeProblem::from_linear_complementarity(&entries, rhs).unwrap());
    assert!(doubtful <= 4, "{doubtful} of 16384 patterns are in doubt");
}

#[test]
fn every_pattern_of_the_negative_identity_is_a_solution() {
    let n = 12;
    let problem =
        ModeProblem::from_linear_complementarity(&-DMatrix::identity(n, n), DVector::from_element(n, 1.0))
            .unwrap();
    assert_eq!(screen(&problem).remaining.len(), 1 << n);
}

#[test]
fn what_is_proved_is_what_the_enumerator_finds() {
    let mut state = 99_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    for n in 1..11 {
        let entries = DMatrix::from_fn(n, n, |_, _| random());
        let rhs = DVector::from_fn(n, |_, _| random());
        let problem = ModeProblem::from_linear_complementarity(&entries, rhs).unwrap();
        let proved: Vec<u64> = prove(&problem).into_iter().map(|(pattern, _)| pattern).collect();
        assert_eq!(proved, with_solution(&problem));
    }
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let n = 13;
    let entries = DMatrix::from_fn(n, n, |i, j| ((i * 7 + j * 13) % 17) as f64 / 8.5 - 1.0);
    let rhs = DVector::from_fn(n, |i, _| ((i * 5) % 11) as f64 / 5.5 - 1.0);
    let problem = ModeProblem::from_linear_complementarity(&entries, rhs).unwrap();
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| screen(&problem))
    };
    assert_eq!(with(1), with(3));
}
