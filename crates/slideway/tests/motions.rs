//! Motions against derivations, an independent integration, and guides that are springs.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::motion::{Cause, End, History, SimulateOptions, simulate};
use std::f64::consts::PI;

const G: f64 = 9.81;

fn history(name: &str, settings: &[(&str, &str)], options: &SimulateOptions) -> History {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model = Model::parse(gallery::find(name).unwrap().text).unwrap().with(&settings).unwrap();
    simulate(&model, options).unwrap()
}

fn times(history: &History, is: impl Fn(&Cause) -> bool) -> Vec<f64> {
    let events = history.events.iter().filter(|event| event.causes.iter().any(&is));
    events.map(|event| event.time).collect()
}

fn words(history: &History) -> Vec<String> {
    history.events.iter().map(|event| format!("{} {}", event.time, event.words)).collect()
}

/// With w^2 = k/m the block is at u = x - mu g/w^2. It sticks from u = -d to u = d, d = (mu_static - mu) g/w^2, at the speed v
/// of the belt: 2 d/v. Then u'' = -w^2 u from (d, v) until u' = v again, at u = -d: (2/w) (pi - atan(w d/v)).
#[test]
fn stick_slip_has_its_period() {
    let history = history("stick-slip", &[], &SimulateOptions::new(10.0));
    assert_eq!(history.end, End::Finished);
    let (w, v) = (10.0, 0.2);
    let d = (0.4 - 0.25) * G / (w * w);
    let (sticks, slides) = (2.0 * d / v, 2.0 / w * (PI - f64::atan(w * d / v)));
    let slips = times(&history, |cause| matches!(cause, Cause::Slips));
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    assert!(slips.len() >= 14, "{:#?}", words(&history));
    for pair in slips.windows(2) {
        assert!((pair[1] - pair[0] - sticks - slides).abs() < 1e-7, "{pair:?}");
        let stop = stops.iter().find(|stop| **stop > pair[0]).unwrap();
        assert!((stop - pair[0] - slides).abs() < 1e-7, "{stop} {pair:?}");
    }
}

/// With w^2 = k/m and f = mu m g/k: sliding in the direction s it swings about -s f. From x = 0 with v_0 it reaches
/// x_1 = -f + sqrt(f^2 + v_0^2/w^2) after atan2(v_0/w, f)/w; each further half cycle lasts pi/w and ends 2 f nearer. It stays at the first
/// turning point within mu_static m g/k.
#[test]
fn a_frictional_oscillator_comes_to_rest() {
    let history = history("frictional-oscillator", &[], &SimulateOptions::new(4.0));
    assert_eq!(history.end, End::Finished);
    let (w, v) = (f64::sqrt(250.0), 2.0);
    let (f, static_limit) = (0.2 * G / 250.0, 0.25 * G / 250.0);
    let mut turning = -f + f64::hypot(f, v / w);
    let mut time = f64::atan2(v / w, f) / w;
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    let mut reader = history.reader();
    let mut count = 0;
    loop {
        let place = reader.configuration(stops[count]).unwrap().coordinates[0];
        let expected = if count % 2 == 0 { turning } else { -turning };
        assert!((stops[count] - time).abs() < 1e-7, "{} {time}", stops[count]);
        assert!((place - expected).abs() < 1e-8, "{place} {expected}");
        count += 1;
        if turning <= static_limit {
            break;
        }
        turning -= 2.0 * f;
        time += PI / w;
    }
    assert_eq!(stops.len(), count);
    assert!(count >= 7, "{count}");
    assert!(reader.configuration(4.0).unwrap().rates[0].abs() < 1e-12);
}

/// reference/slider_crank_motion.py: one coordinate, equations of its own, SciPy's DOP853 at a relative tolerance of 1e-13.
#[test]
fn the_slider_crank_agrees_with_an_independent_integration() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../reference/slider-crank-motion.toml"
    ));
    let reference: toml::Table = text.unwrap().parse().unwrap();
    let options = SimulateOptions { tolerance: 1e-10, ..SimulateOptions::new(3.0) };
    let history = history("slider-crank", &[("gas", "0 N"), ("T", "0 N m")], &options);
    assert_eq!(history.end, End::Finished);
    let count = |name: &str| usize::try_from(reference[name].as_integer().unwrap()).unwrap();
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    assert_eq!(stops.len(), count("reversals"));
    let first = reference["first_events"].as_array().unwrap();
    let events: Vec<f64> = history.events[1..].iter().map(|event| event.time).collect();
    for (expected, found) in first.iter().zip(&events) {
        let expected = expected[0].as_float().unwrap();
        assert!((expected - found).abs() < 1e-8, "{expected} {found}");
    }
    let mut reader = history.reader();
    let mut previous = 0.0;
    for sample in reference["sample"].as_array().unwrap() {
        let number = |name: &str| sample[name].as_float().unwrap();
        let time = number("time");
        assert!(time > previous);
        previous = time;
        let configuration = reader.configuration(time).unwrap();
        let phi = configuration.coordinates[0];
        assert!((phi - number("phi")).abs() < 1e-6, "{time}: {phi} {}", number("phi"));
        let omega = configuration.rates[0];
        assert!((omega - number("omega")).abs() < 1e-5, "{time}: {omega} {}", number("omega"));
        let energy = reader.at(time).unwrap().energy;
        let energy = energy.kinetic + energy.potential;
        // The energy of the reference has another zero of height: the same difference at all times.
        assert!((energy - number("energy")).abs() < 1e-5, "{time}: {energy} {}", number("energy"));
    }
}
