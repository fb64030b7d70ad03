//! Time of sweeps, without writing. Divan's items are points.

use divan::Bencher;
use divan::counter::ItemsCount;
use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::sweep::{Sweep, SweepOptions};

const POINTS: u64 = 20_000;

fn main() {
    divan::main();
}

/// A model, what is set in it, and the axis without its number of points.
const SWEEPS: [(&str, &str, &str); 10] = [
    ("klepp-2002", "F_20=0", "mu_1=0..0.8"),
    ("klepp-2002", "F_20=m*g", "mu_1=0..0.8"),
    ("klepp-2002", "F_20=0", "q=-0.2..0.2"),
    ("klepp-2002", "F_20=0", "alpha=1.2..1.5"),
    ("drawer", "mu=0.3", "friction=0..2"),
    ("slider-crank", "m=1", "phi=-1.3..1.3"),
    ("telescopic-boom", "mu=0.2", "friction=0..2"),
    ("slider-crank-with-pins", "mu=0.1", "mu_pin=0.01..0.2"),
    ("slider-crank-with-pins", "mu=0.1", "phi=0.4..2.7"),
    ("slider-crank-with-pins", "mu=0.1", "T=10..30"),
];

fn sweep((name, setting, axis): (&str, &str, &str)) -> Sweep {
    let text = gallery::find(name).expect("in the gallery").text;
    let (parameter, value) = setting.split_once('=').expect("name=value");
    let model = Model::parse(text).expect("a sound model");
    let model = model.with(&Settings::default().parameter(parameter, value)).unwrap_or(model);
    let options =
        SweepOptions::grid([format!("{axis}:{POINTS}").parse().expect("an axis")]).breakpoints(false);
    Sweep::new(&model, &options).expect("a sound axis")
}

fn run(bencher: Bencher<'_, '_>, sweep: &Sweep, threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    bencher.counter(ItemsCount::new(sweep.points())).bench_local(|| pool.install(|| sweep.tally()));
}

#[divan::bench(args = SWEEPS, sample_count = 10)]
fn one_thread(bencher: Bencher<'_, '_>, what: (&str, &str, &str)) {
    run(bencher, &sweep(what), 1);
}

#[divan::bench(args = SWEEPS, sample_count = 10)]
fn two_threads(bencher: Bencher<'_, '_>, what: (&str, &str, &str)) {
    run(bencher, &sweep(what), 2);
}
