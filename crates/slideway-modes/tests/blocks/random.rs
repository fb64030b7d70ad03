//! Random problems.

use nalgebra::{DMatrix, DVector};
use slideway_modes::blocks::{
    BlockProblem, only_solution, search, search_all_or_nothing, unique_for_every_load,
};
use slideway_modes::certificate::{IntervalMatrix, Sign};
use slideway_modes::{BySide, Proof, SearchOptions};
use std::ops::ControlFlow;

use crate::support::{Numbers, Plain, assert_proven, assert_same, degree, unknowns};

/// Starts of Newton's method for each problem.
const STARTS: usize = 3000;

/// Solutions by Newton's method from random starts.
fn from_many_starts(plain: &Plain, starts: usize, numbers: &mut Numbers) -> Vec<DVector<f64>> {
    let mut found: Vec<DVector<f64>> = Vec::new();
    for scale in [0.1, 1.0, 10.0, 100.0].into_iter().cycle().take(starts) {
        let mut x = numbers.vector(plain.load.len()) * scale;
        for _ in 0..60 {
            let Some(step) = plain.jacobian(&x).lu().solve(&plain.residual(&x)) else { break };
            x -= &step;
            if step.amax() <= f64::EPSILON * x.amax() {
                break;
            }
        }
        let size = x.amax();
        if size.is_finite() && plain.residual(&x).amax() <= 1e-12 * size.max(1.0) {
            let known = found.iter().any(|other| (other - &x).amax() <= 1e-8 * size);
            if !known {
                found.push(x);
            }
        }
    }
    found
}

#[test]
fn newtons_method_from_many_starts_finds_no_other_solution() {
    let mut numbers = Numbers(7);
    let mut most = 0;
    for (hinges, contacts, problems) in
        [(2, 0, 8), (2, 2, 6), (3, 0, 6), (3, 2, 4), (4, 1, 3), (5, 0, 1), (6, 0, 1)]
    {
        for _ in 0..problems {
            let plain = Plain::opposed(&mut numbers, contacts, hinges);
            let result = plain.solve();
            assert_proven(&result);
            most = most.max(result.solutions.len());
            for x in from_many_starts(&plain, STARTS, &mut numbers) {
                let near = |solution| (unknowns(solution) - &x).amax() <= 1e-7 * x.amax();
                assert!(result.solutions.iter().any(near), "{x}");
            }
        }
    }
    assert!(most >= 8, "{most}");
}

/// From a neighbour or from nowhere: the solution that the search proves, within the bound; nothing where the norms are
/// too large.
#[test]
fn the_only_solution_is_that_of_the_search() {
    let mut numbers = Numbers(17);
    let (mut shown, mut left) = (0, 0);
    for step in 0..60 {
        let (contacts, hinges) = [(0, 1), (2, 0), (2, 2), (1, 3)][step % 4];
        let plain = Plain::random(&mut numbers, contacts, hinges, 0.05 + 0.02 * step as f64);
        let near = numbers.vector(plain.load.len());
        for near in [None, Some(near.as_slice())] {
            let Some(only) = only_solution(&plain.problem(), near) else {
                left += 1;
                continue;
            };
            shown += 1;
            let result = plain.solve();
            assert_proven(&result);
            let [solution] = result.solutions.as_slice() else {
                panic!("{} solutions", result.solutions.len())
            };
            assert_eq!(solution.orientation, Some(Sign::Positive));
            let distances = plain.lengths(&(unknowns(solution) - DVector::from_column_slice(&only.point)));
            for (distance, error) in distances.iter().zip(&only.errors) {
                assert!(distance <= &(error + solution.radius), "{distance} {error}");
                assert!(*error <= 1e-12 * unknowns(solution).amax().max(1.0), "{error}");
            }
        }
    }
    assert!(shown > 20 && left > 20, "{shown} {left}");
}

#[test]
fn another_division_of_directions_gives_the_same_answer() {
    let mut numbers = Numbers(11);
    for (hinges, contacts) in [(1, 2), (2, 1), (3, 1), (3, 3), (4, 0)] {
        let plain = Plain::random(&mut numbers, contacts, hinges, 0.9);
        let (one, other) = (plain.solve(), plain.solve_turned(0.4));
        assert_proven(&one);
        assert_same(&one, &other);
    }
}

#[test]
fn the_degree_does_not_depend_on_the_load() {
    let mut numbers = Numbers(13);
    for _ in 0..4 {
        let plain = Plain::random(&mut numbers, 1, 2, 1.0);
        let degrees: Vec<i32> = (0..6)
            .map(|_| {
                let load = numbers.vector(plain.load.len());
                let result = Plain { load, ..plain.clone() }.solve();
                assert_proven(&result);
                degree(&result)
            })
            .collect();
        assert!(degrees.iter().all(|degree| *degree == degrees[0]), "{degrees:?}");
    }
}

/// Each block alone has two solutions; weakly coupled, they have as many as Bezout's bound allows.
#[test]
fn as_many_solutions_as_the_bound_allows() {
    let (contacts, hinges) = (3, 3);
    let mut numbers = Numbers(3);
    let response = DMatrix::from_fn(9, 6, |row, column| {
        let opposed = row == if column < 3 { column } else { 2 * column - 3 };
        if opposed { -1.5 } else { 0.01 * numbers.next() }
    });
    let load = DVector::from_fn(9, |row, _| if row < 3 || row % 2 == 1 { 1.0 } else { 0.1 });
    let result = Plain::same(contacts, response, load).solve();
    assert_proven(&result);
    assert_eq!(result.solutions.len(), 1 << (contacts + hinges));
    assert_eq!(degree(&result), 0);
}

/// What ends at the first piece that cannot be decided finds what the search does, or nothing, in fewer nodes: for exact
/// numbers all that the search proves, for wide ones what it proves for each of them.
#[test]
fn all_or_nothing_is_what_the_search_proves() {
    let mut numbers = Numbers(23);
    let (mut shown, mut left, mut saved) = (0, 0, 0);
    for step in 0..16 {
        let (contacts, hinges) = [(0, 2), (1, 1), (2, 2), (1, 3)][step % 4];
        let plain = Plain::opposed(&mut numbers, contacts, hinges);
        for width in [0.0, 1e-6, 1e-3, 3e-2] {
            let problem = widened(&plain, width);
            let options = SearchOptions { nodes: 1500, ..SearchOptions::default() };
            let mut goes_on = |_: &_| ControlFlow::Continue(());
            let all = search(&problem, &options, &mut goes_on);
            let or_nothing =
                search_all_or_nothing(&problem, unique_for_every_load(&problem), &options, &mut goes_on);
            assert!(or_nothing.nodes <= all.nodes);
            if or_nothing.complete == Proof::Proven {
                assert_eq!(all.complete, Proof::Proven);
                assert_same(&all, &or_nothing);
                shown += 1;
            } else {
                assert!(width > 0.0 || all.complete == Proof::NotProven);
                left += 1;
                saved += all.nodes - or_nothing.nodes;
            }
        }
    }
    assert!(shown > 16 && left > 5 && saved > 1000, "{shown}, {left}, {saved}");
}

/// The problem with this relative width of all numbers.
fn widened(plain: &Plain, width: f64) -> BlockProblem {
    let around =
        |matrix: &DMatrix<f64>| IntervalMatrix::around(matrix.clone(), matrix.abs() * width).unwrap();
    let response = BySide { positive: around(&plain.positive), negative: around(&plain.negative) };
    let rows = plain.load.len();
    let jumps = BySide::same(IntervalMatrix::exact(DMatrix::zeros(rows, plain.contacts)));
    let load = DMatrix::from_column_slice(rows, 1, plain.load.as_slice());
    BlockProblem::within_bounds(response, jumps, around(&load)).unwrap()
}
