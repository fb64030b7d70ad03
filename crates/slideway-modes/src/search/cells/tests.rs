//! Every pattern that admits something is a candidate.

use std::ops::ControlFlow;

use nalgebra::{DMatrix, DVector};

use super::*;
use crate::certificate::{Decision, ExactSet, decide};
use crate::interval_matrix::IntervalMatrix;
use crate::problem::{BySide, ContactState, IntervalModeProblem, ModeProblem, ScaledProblem};

fn numbers(seed: u64) -> impl FnMut(i64) -> f64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move |most| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33).cast_signed() % (2 * most + 1) - most) as f64
    }
}

fn problem(columns: [DMatrix<f64>; 2], load: DVector<f64>) -> ModeProblem {
    let none = DMatrix::zeros(load.len(), load.len());
    let [positive, negative] = columns;
    ModeProblem::new(positive, negative, none.clone(), none, load).expect("shapes fit")
}

/// `diag(sigma 8 + ..) + U V` of integers, divided by 8.
fn columns(number: &mut impl FnMut(i64) -> f64, left: &DMatrix<f64>) -> [DMatrix<f64>; 2] {
    let (contacts, rank) = left.shape();
    [8.0, -8.0].map(|sign| {
        let diagonal = DVector::from_fn(contacts, |_, _| sign + number(3));
        let right = DMatrix::from_fn(rank, contacts, |_, _| number(4));
        (DMatrix::from_diagonal(&diagonal) + left * right) / 8.0
    })
}

fn candidates(problem: &ModeProblem, load_radius: f64) -> Option<(Candidates, u64)> {
    let scaled = ScaledProblem::new(problem);
    let load_error = scaled.scaled_load_radius(&DVector::repeat(problem.contacts(), load_radius));
    candidates_of(&scaled, &load_error)
}

fn candidates_of(scaled: &ScaledProblem, load_error: &DVector<f64>) -> Option<(Candidates, u64)> {
    let low_rank = LowRank::of(scaled, load_error)?;
    let mut progress = |_: &_| ControlFlow::Continue(());
    let covered = cover(&low_rank, &mut Monitor::new(u64::MAX, &mut progress))?;
    assert!(covered.fraction == 1.0);
    Some((covered.candidates, covered.boxes))
}

/// Checks that every pattern that admits something is a candidate; returns their number.
fn assert_covers(problem: &ModeProblem, candidates: &Candidates) -> usize {
    let contacts = problem.contacts();
    let mut admitted = 0;
    for number in 0..1_usize << contacts {
        let sides: Vec<u8> = (0..contacts).map(|contact| u8::from(number >> contact & 1 == 1)).collect();
        let pattern: Vec<ContactState> =
            sides.iter().map(|&side| ContactState::PRESSED[usize::from(side)]).collect();
        let decision = decide(problem, &pattern).decision;
        if !matches!(decision, Decision::NoSolution { .. } | Decision::Singular { set: ExactSet::Empty }) {
            admitted += 1;
            assert!(candidates.contains(&sides), "{decision:?} {sides:?} {problem:?}");
        }
    }
    admitted
}

#[test]
fn random_arrangements_are_covered() {
    let mut several = 0;
    for seed in 0..60 {
        let mut number = numbers(seed);
        let (contacts, rank) = (6 + (seed % 3) as usize, 1 + (seed % 5) as usize);
        let left = DMatrix::from_fn(contacts, rank, |_, _| number(1000) / 300.0);
        let columns = columns(&mut number, &left);
        let problem = problem(columns, DVector::from_fn(contacts, |_, _| number(1000) / 100.0));
        let Some((candidates, _)) = candidates(&problem, 0.0) else { continue };
        let admitted = assert_covers(&problem, &candidates);
        assert!(candidates.len() <= admitted);
        several += usize::from(admitted > 1);
    }
    assert!(several > 5, "{several}");
}

#[test]
fn degenerate_arrangements_are_covered() {
    // Small integers: hyperplanes that are parallel, coincide or meet in one point, zero loads, singular
    // patterns.
    let mut covered = 0;
    for seed in 0..120 {
        let mut number = numbers(1000 + seed);
        let (contacts, rank) = (7 + (seed % 2) as usize, 1 + (seed % 3) as usize);
        let left = DMatrix::from_fn(contacts, rank, |_, _| number(1));
        let columns = columns(&mut number, &left);
        let most = i64::from(seed % 4 != 0);
        let problem = problem(columns, DVector::from_fn(contacts, |_, _| number(most)));
        let Some((candidates, boxes)) = candidates(&problem, 0.0) else { continue };
        assert!(boxes < 100_000, "{boxes}");
        assert_covers(&problem, &candidates);
        covered += 1;
    }
    assert!(covered > 60, "{covered}");
}

#[test]
fn what_the_decomposition_leaves_is_bounded() {
    // Forces of some contacts are smaller than the change that the remainder of size 2^-38 may cause.
    let (contacts, tiny) = (8, 2.0_f64.powi(-43));
    for seed in 0..40 {
        let mut number = numbers(2000 + seed);
        let left = DMatrix::from_fn(contacts, 2, |_, _| number(1000) / 300.0);
        let exact = columns(&mut number, &left);
        let columns = exact.map(|matrix| matrix.map(|entry| entry + number(4) * 2.0_f64.powi(-40)));
        let sides: Vec<u8> = (0..contacts).map(|_| u8::from(number(1) > 0.0)).collect();
        let force =
            DVector::from_fn(contacts, |k, _| if k % 2 == 0 { tiny } else { 1.0 + number(100).abs() });
        let matrix = DMatrix::from_fn(contacts, contacts, |i, k| columns[usize::from(sides[k])][(i, k)]);
        let load = matrix * force;
        let problem = problem(columns, load);
        let Some((candidates, _)) = candidates(&problem, 0.0) else { continue };
        assert!(candidates.contains(&sides), "seed {seed}");
        assert_covers(&problem, &candidates);
    }
}

#[test]
fn bounds_of_the_load_are_bounds_of_the_answer() {
    let mut covered = 0;
    for seed in 0..60 {
        let mut number = numbers(3000 + seed);
        let left = DMatrix::from_fn(6, 2, |_, _| number(1000) / 300.0);
        let columns = columns(&mut number, &left);
        let load = DVector::from_fn(6, |_, _| number(4));
        let nearby = load.map(|value| value + if number(1) > 0.0 { 1.0 } else { -1.0 });
        let Some((candidates, _)) = candidates(&problem(columns.clone(), load), 1.0) else { continue };
        assert_covers(&problem(columns, nearby), &candidates);
        covered += 1;
    }
    assert!(covered > 20, "{covered}");
}

#[test]
fn bounds_of_the_columns_are_bounds_of_the_answer() {
    let (mut covered, radius) = (0, 1.0 / 64.0);
    let none = IntervalMatrix::exact(DMatrix::zeros(6, 6));
    for seed in 0..120 {
        let mut number = numbers(6000 + seed);
        let left = DMatrix::from_fn(6, 2, |_, _| number(1000) / 300.0);
        let columns = columns(&mut number, &left);
        let load = DVector::from_fn(6, |_, _| number(4));
        let around = |centre: &DMatrix<f64>| {
            IntervalMatrix::around(centre.clone(), DMatrix::from_element(6, 6, radius)).expect("a radius")
        };
        let sides = BySide { positive: around(&columns[0]), negative: around(&columns[1]) };
        let exact_load = IntervalMatrix::exact(DMatrix::from_columns(std::slice::from_ref(&load)));
        let bounded =
            IntervalModeProblem::new(&sides, &BySide::same(none.clone()), &exact_load).expect("shapes");
        let scaled = ScaledProblem::within((&bounded).into());
        let Some((candidates, _)) = candidates_of(&scaled, &DVector::zeros(6)) else { continue };
        for _ in 0..4 {
            let nearby = columns.clone().map(|matrix| matrix.map(|entry| entry + radius * number(1)));
            assert_covers(&problem(nearby, load.clone()), &candidates);
        }
        covered += 1;
    }
    assert!(covered > 40, "{covered}");
}

#[test]
fn steps_with_inaccurate_inverses_keep_the_solution() {
    // Rows that are parallel up to rounding; the solution is (1/2, -1/2), and every term is exact.
    for seed in 0..200 {
        let mut number = numbers(4000 + seed);
        let mut entry = || 1.5 + number(1_000_000) / 2_000_001.0;
        let (one, other, ratio) = (entry(), entry(), entry());
        let mut gradient = [[0.0; SPACE]; LARGEST_RANK];
        for (row, factor) in [(0, 1.0), (1, ratio)] {
            let (first, second) = (one * factor, other * factor);
            gradient[row][..3].copy_from_slice(&[0.5 * second - 0.5 * first, first, second]);
        }
        let equations = ImageBounds { gradient, constant: [0.0; LARGEST_RANK], noise: [0.0; LARGEST_RANK] };
        let mut part = faces(2, 0).swap_remove(0);
        assert!(equations.narrow(&mut part, 2), "seed {seed}");
        for (axis, value) in [(1, 0.5), (2, -0.5)] {
            assert!((part.centre[axis] - value).abs() <= part.radius[axis], "seed {seed}");
        }
    }
}

#[test]
fn steps_with_wrong_inverses_keep_all_solutions() {
    // Rows that are exactly parallel, whose solutions are all (t b, -t a). Elimination in f64 finds an
    // inverse for many.
    let mut inverted = 0;
    for seed in 0..200 {
        let mut number = numbers(5000 + seed);
        let mut entry = || 1.5 + number(100_000) / 2_f64.powi(18);
        let (one, other) = (entry(), entry());
        let mut gradient = [[0.0; SPACE]; LARGEST_RANK];
        for (row, factor) in [(0, 1.0), (1, 3.0)] {
            gradient[row][..3].copy_from_slice(&[0.0, factor * one, factor * other]);
        }
        let mut matrix = [[0.0; LARGEST_RANK]; LARGEST_RANK];
        (0..2).for_each(|row| matrix[row][..2].copy_from_slice(&gradient[row][1..3]));
        inverted += usize::from(Inverse::new(&matrix, 2).is_some());
        let equations = ImageBounds { gradient, constant: [0.0; LARGEST_RANK], noise: [0.0; LARGEST_RANK] };
        let mut part = faces(2, 0).swap_remove(0);
        assert!(equations.narrow(&mut part, 2), "seed {seed}");
        for (axis, value) in [(1, other / 4.0), (2, -one / 4.0)] {
            assert!((part.centre[axis] - value).abs() <= part.radius[axis], "seed {seed}");
        }
    }
    assert!(inverted > 10, "{inverted}");
}
