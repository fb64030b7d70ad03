//! What proofs about patterns cost, on dense random problems: `cargo bench --bench certificate`.

use dashu_int::IBig;
use divan::Bencher;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use slideway_modes::certificate::{Cell, decide, propagate, proves_empty, solve_exactly};
use slideway_modes::{ContactState, ModeProblem};

const SIZES: [usize; 5] = [8, 12, 16, 24, 40];

fn main() {
    divan::main();
}

/// Patterns of a problem with all numbers between -1 and 1.
fn random(contacts: usize) -> (ModeProblem, Vec<Vec<ContactState>>) {
    let mut runner = TestRunner::deterministic();
    let mut numbers = |count: usize| {
        let tree = prop::collection::vec(-1.0..1.0_f64, count).new_tree(&mut runner).expect("no filter");
        tree.current()
    };
    let mut matrix = || DMatrix::from_vec(contacts, contacts, numbers(contacts * contacts));
    let (plus, minus, none) = (matrix(), matrix(), DMatrix::zeros(contacts, contacts));
    let right = DVector::from_vec(numbers(contacts));
    let side = |number: f64| if number > 0.0 { ContactState::Positive } else { ContactState::Negative };
    let patterns = (0..64).map(|_| numbers(contacts).into_iter().map(side).collect()).collect();
    let problem = ModeProblem::new(plus, minus, none.clone(), none, right).expect("finite numbers");
    (problem, patterns)
}

/// Runs `work` on one pattern after the other.
fn each_pattern<T>(
    bencher: Bencher<'_, '_>,
    contacts: usize,
    work: impl Fn(&ModeProblem, &[ContactState]) -> T,
) {
    let (problem, patterns) = random(contacts);
    let mut next = patterns.iter().cycle();
    bencher.bench_local(|| next.next().map(|pattern| work(&problem, pattern)));
}

#[divan::bench(args = SIZES)]
fn decision(bencher: Bencher<'_, '_>, contacts: usize) {
    each_pattern(bencher, contacts, |problem, pattern| decide(problem, pattern));
}

#[divan::bench(args = SIZES)]
fn exact_solution(bencher: Bencher<'_, '_>, contacts: usize) {
    each_pattern(bencher, contacts, |problem, pattern| solve_exactly(problem, pattern, 1000));
}

#[divan::bench(args = SIZES)]
fn interval_propagation(bencher: Bencher<'_, '_>, contacts: usize) {
    each_pattern(bencher, contacts, |problem, pattern| {
        propagate(problem, &pattern.iter().copied().map(Some).collect::<Vec<_>>())
    });
}

/// Weights that do not prove anything, as most costly: all sides open.
#[divan::bench(args = SIZES)]
fn rejected_weights(bencher: Bencher<'_, '_>, contacts: usize) {
    each_pattern(bencher, contacts, |problem, pattern| {
        proves_empty(problem, &vec![None; pattern.len()], problem.right_hand_side().as_slice())
    });
}

/// The row of the inverse that gives the most negative unknown: tight in all columns but one.
#[divan::bench(args = SIZES)]
fn tight_weights(bencher: Bencher<'_, '_>, contacts: usize) {
    let (problem, patterns) = random(contacts);
    let tight = patterns.iter().filter_map(|pattern| {
        let columns: Vec<_> = pattern
            .iter()
            .enumerate()
            .filter_map(|(k, state)| Some(problem.columns(state.side()?).column(k)))
            .collect();
        let inverse = DMatrix::from_columns(&columns).try_inverse()?;
        let worst = (&inverse * problem.right_hand_side()).imin();
        let partial: Vec<_> = pattern.iter().copied().map(Some).collect();
        Some((partial, inverse.row(worst).transpose()))
    });
    let tight: Vec<_> = tight.collect();
    let mut next = tight.iter().cycle();
    bencher.bench_local(|| {
        next.next().map(|(partial, weights)| proves_empty(&problem, partial, weights.as_slice()))
    });
}

/// All corners of the doubly stochastic matrices, which no split makes easier: 24 and 120 vertices, dimension 9
/// and 16.
#[divan::bench(args = [4, 5])]
fn corners_of_doubly_stochastic_matrices(bencher: Bencher<'_, '_>, size: usize) {
    let entry = |at: usize| -> Vec<IBig> {
        (0..2 * size).map(|row| i32::from(row == at / size || row == size + at % size).into()).collect()
    };
    let columns: Vec<Vec<IBig>> = (0..size * size).map(entry).collect();
    let right = vec![IBig::ONE; 2 * size];
    bencher.bench_local(|| Cell::of_columns(&columns, &right, 1000, &mut || true));
}

/// A cube of which no equation shows the axes: `y_k + y_{d+k} = 1` and multiples of the equations before.
#[divan::bench(args = [6, 9, 12])]
fn corners_of_cubes(bencher: Bencher<'_, '_>, dimension: usize) {
    let entry = |at: usize| -> Vec<IBig> {
        let factor =
            |row: usize| if row >= at % dimension { (row - at % dimension + 1).into() } else { IBig::ZERO };
        (0..dimension).map(factor).collect()
    };
    let columns: Vec<Vec<IBig>> = (0..2 * dimension).map(entry).collect();
    let right: Vec<IBig> = (0..dimension).map(|row| ((row + 1) * (row + 2) / 2).into()).collect();
    bencher.bench_local(|| {
        Cell::of_columns(&columns, &right, 1000, &mut || true).map(|cell| cell.set(1 << dimension))
    });
}
