//! Time of batches: the example of Klepp (2002), and random structures. Divan's items are points.

use divan::Bencher;
use divan::counter::ItemsCount;
use nalgebra::{DMatrix, DVector, dvector};
use slideway_modes::batch::{BatchSolutions, FrictionBatch};
use slideway_modes::{BySide, InfluenceCoefficients, Limits, Side, enumerate};

const POINTS: usize = 4096;

fn main() {
    divan::main();
}

/// Numbers from 0 to 1 by a linear congruential generator (Knuth's MMIX constants).
fn random_numbers() -> impl FnMut() -> f64 {
    let mut state: u64 = 2002;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The paper's section 6: closed forms for `alpha = 80` degrees, `b/l = 0.2`, `h/l = 0.1`.
fn paper(preload: f64) -> InfluenceCoefficients {
    let tangent = 80.0_f64.to_radians().tan();
    let eta = |side: Side| {
        let arm = 0.25 * side.sign();
        #[rustfmt::skip]
        let entries = [
            -tangent / 2.0, tangent / 2.0, tangent / 2.0,
            tangent / 4.0, arm - tangent / 4.0, -arm - tangent / 4.0,
            -tangent / 4.0, arm + tangent / 4.0, -arm + tangent / 4.0,
        ];
        DMatrix::from_row_slice(3, 3, &entries)
    };
    let eta = BySide { positive: eta(Side::Positive), negative: eta(Side::Negative) };
    InfluenceCoefficients {
        eta_preload: eta.clone(),
        eta,
        mu: BySide::same(dvector![0.0, 0.1, 0.1]),
        preload: BySide::same(dvector![0.0, preload, 0.0]),
        velocity_signs: dvector![1.0, 1.0, 1.0],
        frictionless: dvector![0.5, 0.25, -0.25],
    }
}

fn random_structure(contacts: usize) -> InfluenceCoefficients {
    let mut random = random_numbers();
    let mut eta = || DMatrix::from_fn(contacts, contacts, |_, _| 4.0 * random() - 2.0);
    let eta = BySide { positive: eta(), negative: eta() };
    InfluenceCoefficients {
        eta_preload: eta.clone(),
        eta,
        mu: BySide::same(DVector::zeros(contacts)),
        preload: BySide::same(DVector::zeros(contacts)),
        velocity_signs: DVector::repeat(contacts, 1.0),
        frictionless: DVector::from_fn(contacts, |_, _| random() - 0.5),
    }
}

fn friction(varied: usize) -> Vec<Vec<f64>> {
    let mut random = random_numbers();
    (0..varied).map(|_| (0..POINTS).map(|_| 0.8 * random()).collect()).collect()
}

fn bench_friction(
    bencher: Bencher<'_, '_>,
    influence: &InfluenceCoefficients,
    varied: usize,
    baseline: bool,
) {
    let varied: Vec<usize> = (0..varied).collect();
    let batch = FrictionBatch::new(influence, &varied).expect("few contacts");
    let friction = friction(varied.len());
    let friction: Vec<&[f64]> = friction.iter().map(Vec::as_slice).collect();
    let mut solutions = BatchSolutions::default();
    bencher.counter(ItemsCount::new(POINTS)).bench_local(|| {
        if baseline {
            batch.solve_baseline(&friction, &mut solutions)
        } else {
            batch.solve(&friction, &mut solutions)
        }
    });
}

/// What `reference/comparison/sweep_numpy.py` computes: the solutions of the paper's sweep, mu_1 from 0 to
/// 0.8, with point, pattern and normal forces.
#[divan::bench]
#[expect(clippy::cast_possible_truncation, reason = "a million points, eight patterns")]
fn paper_normal_forces(bencher: Bencher<'_, '_>) {
    const POINTS: usize = 1_000_000;
    const BLOCK: usize = 4096;
    let mu_1: Vec<f64> = (0..POINTS).map(|point| 0.8 * point as f64 / (POINTS - 1) as f64).collect();
    let batch = FrictionBatch::new(&paper(0.0), &[0]).expect("few contacts");
    let mut solutions = BatchSolutions::default();
    let (mut points, mut patterns, mut forces) = (Vec::new(), Vec::new(), Vec::new());
    bencher.counter(ItemsCount::new(POINTS)).bench_local(|| {
        points.clear();
        patterns.clear();
        forces.clear();
        for (block, mu_1) in mu_1.chunks(BLOCK).enumerate() {
            let tell = |point: usize, pattern: usize, y: &[f64]| {
                points.push((block * BLOCK + point) as u32);
                patterns.push(pattern as u8);
                let sides = (0..3).map(|contact| Side::BOTH[pattern >> contact & 1].sign());
                forces.extend(sides.zip(y).map(|(side, y)| side * y));
            };
            batch.solve_each(&[mu_1], &mut solutions, tell).expect("one list");
        }
        points.len()
    });
}

/// The first coefficients of friction change, as many as the argument says.
#[divan::bench(args = [1, 3])]
fn paper_friction(bencher: Bencher<'_, '_>, varied: usize) {
    bench_friction(bencher, &paper(0.0), varied, false);
}

#[divan::bench(args = [1, 3])]
fn paper_friction_baseline(bencher: Bencher<'_, '_>, varied: usize) {
    bench_friction(bencher, &paper(0.0), varied, true);
}

#[divan::bench(args = [1, 3])]
fn paper_friction_with_preload(bencher: Bencher<'_, '_>, varied: usize) {
    bench_friction(bencher, &paper(1.0), varied, false);
}

/// All coefficients of friction change.
#[divan::bench(args = [2, 4, 6, 8])]
fn random_friction(bencher: Bencher<'_, '_>, contacts: usize) {
    bench_friction(bencher, &random_structure(contacts), contacts, false);
}

/// The points of `paper_friction` one by one, for comparison.
#[divan::bench(sample_count = 10)]
fn paper_enumerated(bencher: Bencher<'_, '_>) {
    let batch = FrictionBatch::new(&paper(0.0), &[0]).expect("few contacts");
    let friction = friction(1);
    let problems: Vec<_> = friction[0].iter().map(|&mu| batch.problem_at(&[mu]).expect("finite")).collect();
    bencher.counter(ItemsCount::new(POINTS)).bench_local(|| {
        problems
            .iter()
            .map(|problem| enumerate(problem, &Limits::default()).map_or(0, |found| found.solutions.len()))
            .sum::<usize>()
    });
}
