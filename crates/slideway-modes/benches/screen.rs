//! Time of all states of few contacts by elimination, beside the search and an LU factorization for every pattern. Divan's
//! items are patterns.

use std::ops::ControlFlow;

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use nalgebra::{DMatrix, DVector};
use slideway_modes::screen::{Screen, SmallProblem};
use slideway_modes::{ModeProblem, SearchOptions, Side, search};

fn main() {
    divan::main();
}

/// Numbers from -1 to 1 by a linear congruential generator (Knuth's MMIX constants).
fn random_numbers() -> impl FnMut() -> f64 {
    let mut state: u64 = 2002;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Friction strong enough for several solutions; columns differ from side to side.
fn random_problem(contacts: usize) -> ModeProblem {
    let mut random = random_numbers();
    let mut columns = |sign: f64| {
        let identity = DMatrix::from_diagonal_element(contacts, contacts, sign);
        identity + DMatrix::from_fn(contacts, contacts, |_, _| random()) / (contacts as f64).sqrt()
    };
    let (positive, negative) = (columns(1.0), columns(-1.0));
    let load = DVector::from_fn(contacts, |_, _| random());
    let none = DMatrix::zeros(contacts, contacts);
    ModeProblem::new(positive, negative, none.clone(), none, load).expect("finite numbers")
}

#[divan::bench(args = [3, 6, 8])]
fn elimination(bencher: Bencher<'_, '_>, contacts: usize) {
    let mut problem = SmallProblem::new(contacts);
    problem.copy(&random_problem(contacts));
    let mut screen = Screen::new(contacts);
    bencher
        .counter(ItemsCount::new(1_usize << contacts))
        .bench_local(|| screen.states(black_box(&problem), 0.0).map(<[_]>::len));
}

/// As the search without certificates solves the same problem.
#[divan::bench(args = [3, 6, 8])]
fn search_within_tolerances(bencher: Bencher<'_, '_>, contacts: usize) {
    let problem = random_problem(contacts);
    let options = SearchOptions { certify: false, ..SearchOptions::default() };
    bencher
        .counter(ItemsCount::new(1_usize << contacts))
        .bench_local(|| search(black_box(&problem), &options, &mut |_| ControlFlow::Continue(())));
}

#[divan::bench(args = [3, 6, 8])]
fn factorization_per_pattern(bencher: Bencher<'_, '_>, contacts: usize) {
    let problem = random_problem(contacts);
    bencher.counter(ItemsCount::new(1_usize << contacts)).bench_local(|| {
        (0..1_usize << contacts)
            .filter(|pattern| {
                let columns: Vec<_> = (0..contacts)
                    .map(|k| Side::BOTH[pattern >> k & 1])
                    .enumerate()
                    .map(|(k, side)| problem.columns(side).column(k))
                    .collect();
                let solution = DMatrix::from_columns(&columns).lu().solve(problem.right_hand_side());
                solution.is_some_and(|y| y.iter().all(|&y| y >= 0.0))
            })
            .count()
    });
}
