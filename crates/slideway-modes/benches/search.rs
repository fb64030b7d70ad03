//! Time of the pruned search on families of planted and random problems. One thread.

use std::ops::ControlFlow;

use divan::Bencher;
use instances::{chained_blocks, low_rank, planted_blocks, planted_complementarity, redundant};
use slideway_modes::certificate::IntervalModeProblem;
use slideway_modes::{Completeness, ModeProblem, SearchOptions, SearchResult, search};

mod instances;

fn main() {
    divan::main();
}

fn solve(problem: &ModeProblem) -> SearchResult {
    search(problem, &SearchOptions::default(), &mut |_| ControlFlow::Continue(()))
}

/// Every pattern is tried.
#[divan::bench(args = [2, 3, 5, 8])]
fn complementarity_small(bencher: Bencher<'_, '_>, contacts: usize) {
    let problem = planted_complementarity(contacts, 1);
    bencher.bench_local(|| solve(&problem));
}

/// The same within rounding of the data.
#[divan::bench(args = [2, 3, 5, 8])]
fn complementarity_small_within_bounds(bencher: Bencher<'_, '_>, contacts: usize) {
    let problem = planted_complementarity(contacts, 1);
    let problem = IntervalModeProblem::widened(&problem, 1e-15).expect("a sensible radius");
    let options = SearchOptions::default();
    bencher.bench_local(|| search(&problem, &options, &mut |_| ControlFlow::Continue(())));
}

/// What proofs add: compare with and without them.
#[divan::bench(args = [true, false], sample_count = 20, sample_size = 1)]
fn complementarity_20_certified(bencher: Bencher<'_, '_>, certify: bool) {
    let problem = planted_complementarity(20, 1);
    let options = SearchOptions { certify, ..SearchOptions::default() };
    bencher.bench_local(|| search(&problem, &options, &mut |_| ControlFlow::Continue(())));
}

#[divan::bench(args = [1, 2, 3, 4], sample_count = 5, sample_size = 1)]
fn planted_24_strength_1_5(bencher: Bencher<'_, '_>, seed: u64) {
    let problem = planted_blocks(24, 24, 1.5, seed);
    bencher.bench_local(|| solve(&problem));
}

#[divan::bench(args = [1, 2, 3], sample_count = 1, sample_size = 1)]
fn planted_40_strength_1(bencher: Bencher<'_, '_>, seed: u64) {
    let problem = planted_blocks(40, 40, 1.0, seed);
    bencher.bench_local(|| solve(&problem));
}

#[divan::bench(args = [1, 2, 3], sample_count = 1, sample_size = 1)]
fn complementarity_40(bencher: Bencher<'_, '_>, seed: u64) {
    let problem = planted_complementarity(40, seed);
    bencher.bench_local(|| solve(&problem));
}

/// 16 contacts with 10 self-stresses, three states each.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn redundant_16_with_10_self_stresses(bencher: Bencher<'_, '_>) {
    let problem = redundant(16, 10);
    assert_eq!(solve(&problem).completeness, Completeness::Proven);
    bencher.bench_local(|| solve(&problem));
}

#[divan::bench(args = [100, 200, 400], sample_count = 3, sample_size = 1)]
fn planted_strength_0_3(bencher: Bencher<'_, '_>, contacts: usize) {
    let problem = planted_blocks(contacts, contacts, 0.3, 1);
    bencher.bench_local(|| solve(&problem));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn independent_groups_1000(bencher: Bencher<'_, '_>) {
    let problem = planted_blocks(1000, 10, 1.0, 1);
    bencher.bench_local(|| solve(&problem));
}

#[divan::bench(sample_count = 5, sample_size = 1)]
fn chained_groups_1000(bencher: Bencher<'_, '_>) {
    let problem = chained_blocks(1000, 0.5);
    bencher.bench_local(|| solve(&problem));
}

#[divan::bench(args = [1, 2, 3], sample_count = 3, sample_size = 1)]
fn low_rank_300(bencher: Bencher<'_, '_>, rank: usize) {
    let problem = low_rank(300, rank);
    bencher.bench_local(|| solve(&problem));
}
