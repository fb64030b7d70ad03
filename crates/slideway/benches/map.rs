//! Time of maps of 400 x 400 pixels.

use slideway::gallery;
use slideway::map::{ColourBy, MapOptions, map};
use slideway::model::Model;

fn main() {
    divan::main();
}

fn bench(bencher: divan::Bencher<'_, '_>, name: &str, x: &str, y: &str, colour_by: ColourBy) {
    let model = Model::parse(gallery::find(name).expect("in the gallery").text).expect("a sound model");
    let options =
        MapOptions::new(x.parse().expect("a range"), y.parse().expect("a range")).colour_by(colour_by);
    bencher.bench_local(|| map(&model, &options).expect("a map"));
}

/// The paper's example over two coefficients of friction: numbers are interpolated.
#[divan::bench]
fn klepp_friction(bencher: divan::Bencher<'_, '_>) {
    bench(bencher, "klepp-2002", "mu_1=0..0.8", "mu_2=0..0.4", ColourBy::Solutions);
}

/// Over friction and the inclination of the bar: assembled anew at every point.
#[divan::bench]
fn klepp_geometry(bencher: divan::Bencher<'_, '_>) {
    bench(bencher, "klepp-2002", "mu_1=0..0.8", "alpha=60 deg..88 deg", ColourBy::Modes);
}

#[divan::bench]
fn klepp_margin(bencher: divan::Bencher<'_, '_>) {
    bench(bencher, "klepp-2002", "mu_1=0..0.8", "mu_2=0..0.4", ColourBy::Margin);
}

/// Over a position: every point is assembled, from its neighbours.
#[divan::bench]
fn slider_crank_jam(bencher: divan::Bencher<'_, '_>) {
    bench(bencher, "slider-crank", "phi=-175 deg..175 deg", "mu=0..1.5", ColourBy::Jam);
}
