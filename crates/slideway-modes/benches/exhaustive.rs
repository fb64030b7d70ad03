//! Every pattern of random linear complementarity problems: time for each pattern, beside the simple
//! enumerator.
//!
//! `cargo bench -p slideway-modes --bench exhaustive`
#![allow(missing_docs, reason = "a benchmark")]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use nalgebra::{DMatrix, DVector};
use slideway_modes::exhaustive::{prove, screen};
use slideway_modes::{Limits, ModeProblem, enumerate};

fn main() {
    divan::main();
}

fn problem(n: usize) -> ModeProblem {
    let mut state = 12_345_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let m = DMatrix::from_fn(n, n, |_, _| random());
    let q = DVector::from_fn(n, |_, _| random());
    ModeProblem::from_linear_complementarity(&m, q).expect("finite numbers")
}

/// Items are patterns: divide the time by 2^n.
fn run<T: Send>(
    bencher: Bencher<'_, '_>,
    n: usize,
    threads: usize,
    solve: impl Fn(&ModeProblem) -> T + Sync + Send,
) {
    let problem = problem(n);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let patterns = ItemsCount::new(1_usize << n);
    bencher.counter(patterns).bench_local(|| pool.install(|| solve(black_box(&problem))));
}

#[divan::bench(args = [16, 20, 24], consts = [1, 2], sample_count = 10)]
fn screening<const THREADS: usize>(bencher: Bencher<'_, '_>, n: usize) {
    run(bencher, n, THREADS, |problem| screen(problem));
}

#[divan::bench(args = [16, 20, 24], consts = [1, 2], sample_count = 10)]
fn proof<const THREADS: usize>(bencher: Bencher<'_, '_>, n: usize) {
    run(bencher, n, THREADS, |problem| prove(problem));
}

#[divan::bench(args = [16, 20], sample_count = 5)]
fn simple_enumeration(bencher: Bencher<'_, '_>, n: usize) {
    let limits = Limits { contacts: n, ..Limits::default() };
    run(bencher, n, 1, |problem| enumerate(problem, &limits));
}
