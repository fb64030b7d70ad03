//! Four contacts of redundant guides beside four of a determinate mechanism: solve, sweep and map.

use divan::Bencher;
use divan::counter::ItemsCount;
use slideway::gallery;
use slideway::map::{MapOptions, map};
use slideway::model::Model;
use slideway::solve::solve;
use slideway::sweep::{Sweep, SweepOptions};

const POINTS: u64 = 2_000;
/// A drawer on two rails, 2 redundancies; a boom of two stages.
const NAMES: [&str; 2] = ["drawer-on-two-rails", gallery::TELESCOPIC_BOOM];

fn main() {
    divan::main();
}

fn model(name: &str) -> Model {
    let boom = gallery::telescopic_boom(2).expect("a sensible number of stages");
    let text = if name == gallery::TELESCOPIC_BOOM {
        &boom
    } else {
        gallery::find(name).expect("in the gallery").text
    };
    Model::parse(text).expect("a sound model")
}

#[divan::bench(args = NAMES)]
fn whole_solve(bencher: Bencher<'_, '_>, name: &str) {
    let model = model(name);
    bencher.bench_local(|| solve(&model));
}

/// One thread; divan's items are points.
#[divan::bench(args = NAMES, sample_count = 10)]
fn sweep_over_friction(bencher: Bencher<'_, '_>, name: &str) {
    let axis = format!("friction=0..2:{POINTS}").parse().expect("an axis");
    let sweep = Sweep::new(&model(name), &SweepOptions::grid([axis]).breakpoints(false)).expect("sound");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("threads");
    bencher.counter(ItemsCount::new(sweep.points())).bench_local(|| pool.install(|| sweep.tally()));
}

/// 400 x 400 pixels.
#[divan::bench(args = NAMES, sample_count = 5)]
fn map_of_friction_and_mass(bencher: Bencher<'_, '_>, name: &str) {
    let model = model(name);
    let options = MapOptions::new("mu=0..1".parse().expect("a range"), "m=5..30".parse().expect("a range"));
    bencher.bench_local(|| map(&model, &options).expect("a map"));
}
