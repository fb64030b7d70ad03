//! The exhaustive screening against the simple enumerator and against the decision of every single pattern:
//! it may keep too much, but never drops a solution.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use slideway_modes::certificate::{Decision, IntervalModeProblem, ProblemView, decide};
use slideway_modes::exhaustive::{
    Instructions, Pattern, Screening, prove, prove_with, screen, screen_by, screen_with,
};
use slideway_modes::progress::Progress;
use slideway_modes::{ContactState, Limits, ModeProblem, Side, enumerate};

/// The patterns that the simple enumerator finds to have a solution, inside or on the boundary.
fn with_solution(problem: &ModeProblem) -> Vec<Pattern> {
    let bits = |pattern: &Vec<Side>| pattern.iter().map(|&side| ContactState::from(side)).collect();
    let solutions = enumerate(problem, &Limits::default()).unwrap();
    let mut patterns: Vec<Pattern> =
        solutions.solutions.iter().flat_map(|solution| &solution.patterns).map(bits).collect();
    patterns.sort_unstable();
    patterns
}

/// Every pattern, contacts with a jump in their gap as well.
fn all_patterns(jumps: &[bool]) -> Vec<Pattern> {
    let mut patterns = vec![Vec::new()];
    for jump in jumps {
        let mut states = vec![ContactState::Positive, ContactState::Negative];
        states.extend(jump.then_some(ContactState::Gap));
        let longer = |pattern: &Vec<ContactState>| {
            let with = |&state| pattern.iter().copied().chain([state]).collect::<Vec<_>>();
            states.iter().map(with).collect::<Vec<_>>()
        };
        patterns = patterns.iter().flat_map(longer).collect();
    }
    let mut patterns: Vec<Pattern> = patterns.into_iter().map(Pattern::from_iter).collect();
    patterns.sort_unstable();
    patterns
}

/// Proves that the tree leaves every pattern that is not decided to have no solution; returns how many it
/// leaves besides.
fn check_against_decisions<'a>(
    problem: impl Into<ProblemView<'a>> + Copy,
    contacts: usize,
    jumps: &[bool],
) -> usize {
    let patterns = all_patterns(jumps);
    let kept = |pattern: &Pattern| {
        let verdict = decide(problem, &pattern.states(contacts));
        !matches!(verdict.decision, Decision::NoSolution { .. })
    };
    let expected: Vec<Pattern> = patterns.iter().copied().filter(kept).collect();
    let screening = screen(problem);
    for pattern in &expected {
        assert!(screening.remaining.binary_search(pattern).is_ok(), "{pattern:?} was dropped");
    }
    assert_eq!(screening.excluded + screening.remaining.len() as u64, patterns.len() as u64);
    for instructions in Instructions::available() {
        let remaining = screen_by(problem, instructions).remaining;
        let dropped = expected.iter().find(|pattern| remaining.binary_search(pattern).is_err());
        assert_eq!(dropped, None, "{instructions:?}");
    }
    let proved: Vec<Pattern> = prove(problem).into_iter().map(|(pattern, _)| pattern).collect();
    assert_eq!(proved, expected);
    screening.remaining.len() - expected.len()
}

fn check(problem: &ModeProblem) -> usize {
    let screening = screen(problem);
    let found = with_solution(problem);
    for pattern in &found {
        assert!(screening.remaining.binary_search(pattern).is_ok(), "{pattern:?} was dropped");
    }
    assert_eq!(screening.excluded + screening.remaining.len() as u64, 1 << problem.contacts());
    screening.remaining.len() - found.len()
}

fn random_numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn random_problem(n: usize, seed: u64) -> ModeProblem {
    let mut random = random_numbers(seed);
    let entries = DMatrix::from_fn(n, n, |_, _| random());
    let rhs = DVector::from_fn(n, |_, _| random());
    ModeProblem::from_linear_complementarity(&entries, rhs).unwrap()
}

/// Both columns of every contact are their own; contacts with a set bit jump, the others have a constant
/// `d_k`.
fn random_jumps(n: usize, jumping: u64, seed: u64) -> (ModeProblem, Vec<bool>) {
    let mut random = random_numbers(seed);
    let mut matrix = || DMatrix::from_fn(n, n, |_, _| random());
    let (positive, negative, d_positive) = (matrix(), -matrix(), matrix());
    let (other, rhs) = (matrix(), matrix().column(0).into_owned());
    let jumps: Vec<bool> = (0..n).map(|contact| jumping >> contact & 1 == 1).collect();
    let d_negative = DMatrix::from_fn(n, n, |i, k| if jumps[k] { other[(i, k)] } else { d_positive[(i, k)] });
    (ModeProblem::new(positive, negative, d_positive, d_negative, rhs).unwrap(), jumps)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 50, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_solution_is_dropped(n in 1_usize..13, seed in any::<u64>()) {
        check(&random_problem(n, seed));
    }

    #[test]
    fn no_solution_is_dropped_in_degenerate_problems(
        n in 1_usize..7,
        entries in prop::collection::vec((-2..3_i8).prop_map(f64::from), 49),
        rhs in prop::collection::vec((-2..3_i8).prop_map(f64::from), 7),
    ) {
        let m = DMatrix::from_fn(n, n, |i, j| entries[i * 7 + j]);
        let rhs = DVector::from_column_slice(&rhs[..n]);
        let problem = ModeProblem::from_linear_complementarity(&m, rhs).unwrap();
        check_against_decisions(&problem, n, &vec![false; n]);
    }

    #[test]
    fn no_state_is_dropped_in_problems_with_jumps(n in 1_usize..6, jumping in 0..32_u64, seed in any::<u64>()) {
        let (problem, jumps) = random_jumps(n, jumping, seed);
        check_against_decisions(&problem, n, &jumps);
    }

    /// Columns that differ by little more than rounding, so that most signs are in doubt in `f64`.
    #[test]
    fn no_solution_is_dropped_in_ill_conditioned_problems(
        n in 3_usize..8,
        exponent in 20..52_i32,
        seed in any::<u64>(),
    ) {
        let mut random = random_numbers(seed);
        let (left, right) = (DVector::from_fn(n, |_, _| random()), DVector::from_fn(n, |_, _| random()));
        let small = f64::from(-exponent).exp2();
        let m = &left * right.transpose() + DMatrix::from_fn(n, n, |_, _| random()) * small;
        let rhs = &left * random() + DVector::from_fn(n, |_, _| random()) * small;
        let zeros = DMatrix::zeros(n, n);
        let other = &m + DMatrix::from_fn(n, n, |_, _| random()) * small;
        let problem = ModeProblem::new(m, other, zeros.clone(), zeros, rhs).unwrap();
        check_against_decisions(&problem, n, &vec![false; n]);
    }

    #[test]
    fn nothing_is_dropped_that_some_values_within_bounds_solve(
        n in 1_usize..6,
        jumping in 0..32_u64,
        seed in any::<u64>(),
        exponent in 4..40_i32,
    ) {
        let (problem, jumps) = random_jumps(n, jumping, seed);
        let radius = f64::from(-exponent).exp2();
        let within = IntervalModeProblem::widened(&problem, radius).unwrap();
        // Widened numbers differ between the sides even where the numbers do not.
        check_against_decisions(&within, n, &vec![true; n]);
        let mut random = random_numbers(seed ^ 1);
        let mut moved = |matrix: &DMatrix<f64>| matrix.map(|value| value * (1.0 + 0.999 * radius * random()));
        let [positive, negative] = Side::BOTH.map(|side| moved(problem.columns(side)));
        let [d_positive, d_negative] = Side::BOTH.map(|side| moved(problem.jumps(side)));
        let rhs = problem.right_hand_side().clone();
        let one = ModeProblem::new(positive, negative, d_positive, d_negative, rhs).unwrap();
        let remaining = screen(&within).remaining;
        for (pattern, _) in prove(&one) {
            prop_assert!(remaining.binary_search(&pattern).is_ok());
        }
        prop_assert_eq!(jumps.len(), n);
    }

    #[test]
    fn units_change_nothing(
        n in 3_usize..9,
        seed in any::<u64>(),
        exponents in prop::collection::vec(-60..60_i32, 16),
        load in -200..200_i32,
    ) {
        let plain = random_problem(n, seed);
        let scale = DVector::from_fn(n, |i, _| f64::from(exponents[i]).exp2());
        let scaled = |matrix: &DMatrix<f64>| DMatrix::from_diagonal(&scale) * matrix;
        let [positive, negative] = Side::BOTH.map(|side| scaled(plain.columns(side)));
        let zeros = DMatrix::zeros(n, n);
        let rhs = plain.right_hand_side().component_mul(&scale) * f64::from(load).exp2();
        let scaled = ModeProblem::new(positive, negative, zeros.clone(), zeros, rhs).unwrap();
        prop_assert_eq!(screen(&plain), screen(&scaled));
    }
}

/// Integers, so that the planted solution is exact. The columns that the kernel decides are large and nearly
/// parallel.
fn planted(n: usize, exponent: i32, seed: u64) -> (ModeProblem, Pattern) {
    let mut random = random_numbers(seed);
    let mut integer = |size: f64| (random() * (size + 0.5)).round();
    let large = f64::from(exponent).exp2();
    let direction = DVector::from_fn(n, |_, _| integer(3.0));
    let mut columns = || {
        let common = DVector::from_fn(n, |k, _| if k < n - 3 { integer(3.0) * large } else { 0.0 });
        &direction * common.transpose() + DMatrix::from_fn(n, n, |_, _| integer(3.0))
    };
    let (positive, negative) = (columns(), columns());
    let y = DVector::from_fn(n, |_, _| integer(2.0).abs());
    let states = [ContactState::Positive, ContactState::Negative];
    let pattern: Pattern = (0..n).map(|_| states[usize::from(integer(1.0) > 0.0)]).collect();
    let side = |k| if pattern.state(k) == ContactState::Negative { &negative } else { &positive };
    let rhs = (0..n).fold(DVector::zeros(n), |sum, k| sum + side(k).column(k) * y[k]);
    let zeros = DMatrix::zeros(n, n);
    (ModeProblem::new(positive, negative, zeros.clone(), zeros, rhs).unwrap(), pattern)
}

#[test]
fn planted_solutions_of_nearly_singular_problems_are_kept() {
    let cases = (7..12).cycle().zip((10..46).cycle());
    for (seed, (n, exponent)) in (0..360).zip(cases) {
        let (problem, pattern) = planted(n, exponent, seed);
        let kept = screen(&problem).remaining.binary_search(&pattern).is_ok();
        assert!(kept, "{pattern:?} was dropped: n = {n}, exponent {exponent}, seed {seed}");
    }
}

#[test]
fn hardly_anything_is_left_in_doubt() {
    for seed in 0..4 {
        let doubtful = check(&random_problem(14, seed));
        assert!(doubtful <= 1, "{doubtful} of 16384 patterns are in doubt");
    }
}

/// With fused operations the widths of vectors make no difference at all; without, doubts may differ.
#[test]
fn all_instructions_leave_the_same() {
    for seed in 0..6 {
        let problem = random_problem(15, seed);
        let screenings: Vec<Screening> =
            Instructions::available().into_iter().map(|set| screen_by(&problem, set)).collect();
        assert_eq!(screenings[0], screen(&problem));
        let (generic, fused) = screenings.split_last().unwrap();
        assert!(fused.iter().all(|screening| screening == &fused[0]));
        for pattern in with_solution(&problem) {
            assert!(generic.remaining.binary_search(&pattern).is_ok());
        }
        assert!(generic.remaining.len() <= with_solution(&problem).len() + 1);
    }
}

#[test]
fn doubts_do_not_depend_on_the_units_of_loads() {
    for load in [1e-7, 1.0, 1e5, 1e12] {
        let plain = random_problem(14, 3);
        let [positive, negative] = Side::BOTH.map(|side| plain.columns(side).clone());
        let zeros = DMatrix::zeros(14, 14);
        let rhs = plain.right_hand_side() * load;
        let loaded = ModeProblem::new(positive, negative, zeros.clone(), zeros, rhs).unwrap();
        assert!(check(&loaded) <= 1);
    }
}

/// Rounding an equation whose pivot is far smaller than its other entries may change the sign of that pivot.
#[test]
fn columns_of_very_different_sizes_drop_nothing() {
    for seed in 0..40 {
        let n = if seed % 2 == 0 { 3 } else { 9 };
        let (problem, jumps) = random_jumps(n, if n == 3 { seed / 2 } else { 0 }, seed);
        let sizes = [60.0, 120.0, 0.0].map(f64::exp2);
        let scaled = |matrix: &DMatrix<f64>| DMatrix::from_fn(n, n, |i, k| matrix[(i, k)] * sizes[k % 3]);
        let [positive, negative] = Side::BOTH.map(|side| scaled(problem.columns(side)));
        let [d_positive, d_negative] = Side::BOTH.map(|side| problem.jumps(side).clone());
        let load = problem.right_hand_side().clone();
        let scaled = ModeProblem::new(positive, negative, d_positive, d_negative, load).unwrap();
        check_against_decisions(&scaled, n, &jumps);
    }
}

/// Two contacts jump, by numbers near 1.
fn doubts_with_jumps(load: f64) -> usize {
    let (jumping, jumps) = random_jumps(8, 0b1000_0010, 7);
    let [positive, negative] = Side::BOTH.map(|side| jumping.columns(side).clone());
    let [d_positive, d_negative] = Side::BOTH.map(|side| jumping.jumps(side).clone());
    let rhs = jumping.right_hand_side() * load;
    let loaded = ModeProblem::new(positive, negative, d_positive, d_negative, rhs).unwrap();
    check_against_decisions(&loaded, 8, &jumps)
}

#[test]
fn doubts_do_not_depend_on_loads_beside_small_jumps() {
    assert!([1.0, 1e5, 1e8].map(doubts_with_jumps).iter().all(|&doubtful| doubtful <= 1));
}

#[test]
#[ignore = "not put right yet: one error bound serves for loads and for jumps, so 37 of 576 patterns are in doubt"]
fn doubts_do_not_depend_on_loads_beside_tiny_jumps() {
    assert!(doubts_with_jumps(1e12) <= 1);
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
fn zero_loads_and_zero_matrices_are_left_to_the_decision() {
    for n in 1..7 {
        let zeros = DMatrix::zeros(n, n);
        for m in [DMatrix::identity(n, n), zeros] {
            let problem = ModeProblem::from_linear_complementarity(&m, DVector::zeros(n)).unwrap();
            assert_eq!(check_against_decisions(&problem, n, &vec![false; n]), 0);
        }
    }
}

#[test]
fn numbers_near_the_ends_of_their_range_are_no_excuse() {
    for exponent in [-1070, -1000, 900, 1020] {
        let mut random = random_numbers(5);
        let unit = f64::from(exponent / 2).exp2() * f64::from(exponent - exponent / 2).exp2();
        let n = 5;
        let m = DMatrix::from_fn(n, n, |_, _| random() * unit);
        let rhs = DVector::from_fn(n, |_, _| random() / unit.sqrt());
        let problem = ModeProblem::from_linear_complementarity(&m, rhs).unwrap();
        check_against_decisions(&problem, n, &vec![false; n]);
    }
}

#[test]
fn what_is_proved_is_what_the_enumerator_finds() {
    for n in 1..12 {
        let problem = random_problem(n, 99 + n as u64);
        let proved: Vec<Pattern> = prove(&problem).into_iter().map(|(pattern, _)| pattern).collect();
        assert_eq!(proved, with_solution(&problem));
    }
}

fn in_pool<T: Send>(threads: usize, run: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(run)
}

#[test]
fn the_result_does_not_depend_on_the_number_of_threads() {
    let entries = DMatrix::from_fn(16, 16, |i, j| ((i * 7 + j * 13) % 17) as f64 / 8.5 - 1.0);
    let rhs = DVector::from_fn(16, |i, _| ((i * 5) % 11) as f64 / 5.5 - 1.0);
    let degenerate = ModeProblem::from_linear_complementarity(&entries, rhs).unwrap();
    for problem in [degenerate, random_problem(16, 4), random_jumps(7, 0b101_1101, 2).0] {
        let run = |threads| {
            let mut order = Vec::new();
            let visit = |pattern| {
                order.push(pattern);
                ControlFlow::Continue(())
            };
            let tally = in_pool(threads, || screen_with(&problem, visit, |_| ControlFlow::Continue(())));
            (order, tally, in_pool(threads, || screen(&problem)))
        };
        let one = run(1);
        assert_eq!(one, run(2));
        assert_eq!(one, run(3));
    }
}

#[test]
fn patterns_stream_in_ascending_order_and_progress_adds_up() {
    let problem = random_problem(17, 11);
    let (mut told, largest) = (Vec::new(), AtomicU64::new(0));
    let progress = |progress: &Progress| {
        largest.fetch_max(progress.done, Ordering::Relaxed);
        assert_eq!(progress.fraction, Some(progress.done as f64 / f64::from(1 << 17)));
        ControlFlow::Continue(())
    };
    let visit = |pattern, verdict| {
        told.push((pattern, verdict));
        ControlFlow::Continue(())
    };
    let tally = prove_with(&problem, visit, progress);
    assert_eq!(told, prove(&problem));
    assert!(tally.complete);
    assert_eq!(tally.visited + tally.excluded, 1 << 17);
    assert_eq!(largest.into_inner(), 1 << 17);
}

#[test]
fn a_walk_that_is_broken_off_tells_the_beginning() {
    let n = 17;
    let problem =
        ModeProblem::from_linear_complementarity(&-DMatrix::identity(n, n), DVector::from_element(n, 1.0))
            .unwrap();
    let mut told = Vec::new();
    let visit = |pattern| {
        told.push(pattern);
        if told.len() == 1000 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let tally = screen_with(&problem, visit, |_| ControlFlow::Continue(()));
    assert!(!tally.complete);
    assert_eq!(told, screen(&problem).remaining[..1000]);

    let tally = screen_with(&problem, |_| ControlFlow::Continue(()), |_| ControlFlow::Break(()));
    assert!(!tally.complete);
    assert!(tally.visited + tally.excluded < 1 << n);
}

/// Sums that were rounded are taken with their rounding errors, so that as few patterns remain as for a problem whose columns
/// are exactly these numbers. As radii of all entries, these errors grow on the way down the tree: here three times as many
/// remain, and with 24 unknowns a hundred thousand.
#[test]
fn rounding_errors_of_sums_leave_no_more_patterns() {
    let n = 18;
    for seed in 0..4 {
        let mut state = 77 + seed;
        let mut number = || {
            state =
                (6_364_136_223_846_793_005_u64).wrapping_mul(state).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        let b = DMatrix::from_fn(n, n, |_, _| 1.5 * (3.0 / n as f64).sqrt() * number());
        let planted = DVector::from_fn(n, |_, _| number());
        let right = &planted - &b * planted.abs();
        let sums =
            ModeProblem::from_absolute_value_equation(&DMatrix::identity(n, n), &-b, right.clone()).unwrap();
        let [positive, negative] = Side::BOTH.map(|side| sums.columns(side).clone());
        let none = DMatrix::zeros(n, n);
        let rounded = ModeProblem::new(positive, negative, none.clone(), none, right).unwrap();
        let [of_sums, of_rounded] = [&sums, &rounded].map(|problem| screen(problem).remaining.len());
        assert!(of_sums <= of_rounded + 2, "{of_sums} instead of {of_rounded}");
    }
}
