//! Time of the decision whether there is one solution for every load. One thread.

use divan::Bencher;
use nalgebra::{DMatrix, DVector};
use slideway_modes::{ModeProblem, Uniqueness, UniquenessLimits, uniqueness};

fn main() {
    divan::main();
}

/// Numbers from -1 to 1 by a linear congruential generator (Knuth's MMIX constants).
fn random_numbers(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(7919).wrapping_add(12_345);
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

fn problem(m: &DMatrix<f64>) -> ModeProblem {
    ModeProblem::from_linear_complementarity(m, DVector::zeros(m.nrows())).expect("shapes fit")
}

/// `I - 1 1^T / (r + 1/4)`: an M-matrix of which no cheap condition says so.
fn barely_p_matrix(contacts: usize) -> ModeProblem {
    let all = DMatrix::from_element(contacts, contacts, 1.0 / (contacts as f64 + 0.25));
    problem(&(DMatrix::identity(contacts, contacts) - all))
}

fn decide(bencher: Bencher<'_, '_>, problem: &ModeProblem, unique: bool) {
    let answer = uniqueness(problem, &UniquenessLimits::default());
    assert_eq!(matches!(answer, Uniqueness::Unique { .. }), unique, "{answer:?}");
    bencher.bench_local(|| uniqueness(problem, &UniquenessLimits::default()));
}

/// Positive definite, so a P-matrix: `I + A A^T / r`.
#[divan::bench(args = [8, 12, 16])]
fn positive_definite(bencher: Bencher<'_, '_>, contacts: usize) {
    let mut random = random_numbers(1);
    let a = DMatrix::from_fn(contacts, contacts, |_, _| random());
    let square = &a * a.transpose() / contacts as f64;
    decide(bencher, &problem(&(DMatrix::identity(contacts, contacts) + square)), true);
}

/// A skew-symmetric matrix with a small diagonal, so a P-matrix: the cheap conditions fail on the whole.
#[divan::bench(args = [8, 12, 16], sample_count = 20)]
fn nearly_skew(bencher: Bencher<'_, '_>, contacts: usize) {
    let mut random = random_numbers(2);
    let a = DMatrix::from_fn(contacts, contacts, |_, _| random());
    let skew = &a - a.transpose();
    decide(bencher, &problem(&(DMatrix::identity(contacts, contacts) * 0.1 + skew)), true);
}

#[divan::bench(args = [8, 12, 16], sample_count = 20)]
fn rank_one(bencher: Bencher<'_, '_>, contacts: usize) {
    decide(bencher, &barely_p_matrix(contacts), true);
}

/// Only the determinant of the whole is negative, the last one in the tree.
#[divan::bench(args = [8, 12, 16], sample_count = 20)]
fn one_negative_minor(bencher: Bencher<'_, '_>, contacts: usize) {
    let all = DMatrix::from_element(contacts, contacts, 1.0 / (contacts as f64 - 0.25));
    decide(bencher, &problem(&(DMatrix::identity(contacts, contacts) - all)), false);
}

/// Entries uniform in [-1, 1]: minors of both signs are met at once.
#[divan::bench(args = [8, 12, 16])]
fn random_entries(bencher: Bencher<'_, '_>, contacts: usize) {
    let mut random = random_numbers(3);
    decide(bencher, &problem(&DMatrix::from_fn(contacts, contacts, |_, _| random())), false);
}
