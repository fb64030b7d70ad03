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

/// 10 s of the paper's example with spring, damper and a sinusoidal force: more than 200 reversals, at each of which both sliders
/// stop and the lower one changes side.
#[divan::bench]
fn example_with_spring_and_damper(bencher: Bencher<'_, '_>) {
    let settings = Settings::default().parameter("P", "200 N").parameter("f", "12 Hz");
    let model = Model::parse(text("klepp-2002-spring")).expect("a sound model");
    let model = model.with(&settings).expect("sound settings");
    let events = simulate(&model, &SimulateOptions::new(10.0)).expect("a motion").events.len();
    assert!(events > 200, "{events} events");
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
