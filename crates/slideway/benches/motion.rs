//! Time of simulations.

use divan::Bencher;
use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::motion::{SimulateOptions, simulate};

fn main() {
    divan::main();
}

fn text(name: &str) -> &'static str {
    gallery::find(name).expect("in the gallery").text
}

/// 10 s of the paper's example with spring, damper and a force of 10 Hz, which makes it stop 185 times.
#[divan::bench]
fn example_with_spring_and_damper(bencher: Bencher<'_, '_>) {
    let forced = text("klepp-2002").replace("[\"P\", 0]", "[\"30 N * sin(62.8 rad/s * t)\", 0]");
    let settings = Settings::default().parameter("F_20", "0").parameter("mu_1", "0.1");
    let settings = settings.parameter("k", "20 N/m").parameter("c", "0.5 N s/m");
    let model = Model::parse(&forced).expect("a sound model").with(&settings).expect("sound settings");
    bencher.bench_local(|| simulate(&model, &SimulateOptions::new(10.0)));
}

/// 1 s of the slider-crank, coasting with a frictional piston.
#[divan::bench]
fn coasting_slider_crank(bencher: Bencher<'_, '_>) {
    let settings = Settings::default().parameter("gas", "0 N").parameter("T", "0 N m");
    let model = Model::parse(text("slider-crank")).expect("a sound model");
    let model = model.with(&settings).expect("sound settings");
    bencher.bench_local(|| simulate(&model, &SimulateOptions::new(1.0)));
}
