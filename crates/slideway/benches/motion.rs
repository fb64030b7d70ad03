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

/// The paper's example with spring and damper, with a force of 30 N that swings.
fn example(mu_1: &str, angular_frequency: &str) -> Model {
    let force = format!("[\"30 N * sin({angular_frequency} * t)\", 0]");
    let forced = text("klepp-2002").replace("[\"P\", 0]", &force);
    let settings = Settings::default().parameter("F_20", "0").parameter("mu_1", mu_1);
    let settings = settings.parameter("k", "20 N/m").parameter("c", "0.5 N s/m");
    Model::parse(&forced).expect("a sound model").with(&settings).expect("sound settings")
}

/// 10 s at 11 Hz, with more than 200 stops and changes of mode.
#[divan::bench]
fn example_with_spring_and_damper(bencher: Bencher<'_, '_>) {
    let model = example("0.1", "69.1 rad/s");
    let options = SimulateOptions::new(10.0);
    assert!(simulate(&model, &options).expect("it begins").events.len() > 200);
    bencher.bench_local(|| simulate(&model, &options));
}

/// 10 s at 5 Hz, with phases in which it sticks.
#[divan::bench]
fn example_that_sticks(bencher: Bencher<'_, '_>) {
    let model = example("0.3", "31.4 rad/s");
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
