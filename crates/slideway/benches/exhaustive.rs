//! The exhaustive screening of random linear complementarity problems: time for each pattern.
//!
//! `cargo bench -p slideway --bench exhaustive`; `RAYON_NUM_THREADS=1` for one thread.
#![allow(missing_docs, reason = "a benchmark")]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use nalgebra::{DMatrix, DVector};
use slideway::modes::ModeProblem;
use slideway::modes::exhaustive::{prove, screen};

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
#[divan::bench(args = [12, 16, 20], sample_count = 10)]
fn screening(bencher: Bencher<'_, '_>, n: usize) {
    let problem = problem(n);
    bencher.counter(ItemsCount::new(1_usize << n)).bench(|| screen(black_box(&problem)));
}

#[divan::bench(args = [12, 16, 20], sample_count = 10)]
fn proof(bencher: Bencher<'_, '_>, n: usize) {
    let problem = problem(n);
    bencher.counter(ItemsCount::new(1_usize << n)).bench(|| prove(black_box(&problem)));
}
