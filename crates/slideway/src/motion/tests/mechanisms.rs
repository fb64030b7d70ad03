//! Whole mechanisms in motion: conservation of energy, reversal of time, balances with friction.

use super::model_of;
use crate::configuration::Configuration;
use crate::mechanism::Mechanism;
use crate::model::{Model, Settings};
use crate::motion::{Cause, End, History, SimulateOptions, Thorough, simulate, simulate_with};
use std::ops::ControlFlow;

fn coasting_crank(mu: &str) -> Model {
    let settings = Settings::default().parameter("gas", "0 N").parameter("T", "0 N m").parameter("mu", mu);
    model_of("slider-crank").with(&settings).unwrap()
}

/// The motion that follows when all velocities at the end of a history are reversed.
fn reversed(history: &History, duration: f64) -> History {
    let mut configuration = history.reader().configuration(history.stop()).unwrap().clone();
    for velocity in &mut configuration.velocities {
        velocity.linear = -velocity.linear;
        velocity.angular = -velocity.angular;
    }
    let options = SimulateOptions::new(duration);
    let mechanism = &history.mechanism;
    simulate_with(mechanism, &configuration, &options, &mut Thorough, &mut |_| ControlFlow::Continue(()))
        .unwrap()
}

/// Without friction energy is conserved, and the motion runs back when all velocities are reversed.
#[test]
fn frictionless_motion_conserves_energy_and_can_be_reversed() {
    let trammel = model_of("elliptic-trammel").with(&Settings::default().parameter("mu", "0")).unwrap();
    for (model, duration) in [(trammel, 3.0), (coasting_crank("0"), 0.25)] {
        let history = simulate(&model, &SimulateOptions::new(duration)).unwrap();
        assert_eq!(history.end, End::Finished);
        assert!(history.energy_error < 1e-6 * history.energy_scale, "{:e}", history.energy_error);
        assert!(history.drift.position < 1e-8 && history.drift.velocity < 1e-5, "{:?}", history.drift);
        let back = reversed(&history, duration);
        let start = Configuration::new(&history.mechanism).unwrap();
        let end = back.reader().configuration(back.stop()).unwrap().clone();
        for (start, end) in start.poses.iter().zip(&end.poses) {
            assert!((start.position - end.position).norm() < 1e-6 * history.mechanism.size);
            assert!((start.angle - end.angle).abs() < 1e-6, "{} {}", start.angle, end.angle);
        }
    }
}

/// The piston stops at each dead centre and slides on at once: two stops in each turn. What it loses is what friction
/// takes.
#[test]
fn a_slider_crank_coasts_through_many_turns() {
    let history = simulate(&coasting_crank("0.1"), &SimulateOptions::new(1.0)).unwrap();
    assert_eq!(history.end, End::Finished, "{:?}", history.events.last());
    let mut reader = history.reader();
    let (first, last) = (reader.at(0.0).unwrap(), reader.at(1.0).unwrap());
    let turned = last.configuration.coordinates[0] - first.configuration.coordinates[0];
    let turns = turned / std::f64::consts::TAU;
    assert!(turns > 12.0 && turns < 16.0, "{turns}");
    let stops = history.events.iter().filter(|e| e.causes.iter().any(|c| matches!(c, Cause::Stops(_))));
    let stops: Vec<f64> = stops.map(|event| event.time).collect();
    // From 60 degrees on dead centres follow at 180, 360, ... degrees.
    let expected = ((turned + 60.0_f64.to_radians()) / std::f64::consts::PI).floor();
    assert_eq!(stops.len() as f64, expected);
    for time in &stops {
        let phi = reader.configuration(*time).unwrap().coordinates[0];
        assert!((phi / std::f64::consts::PI).sin().abs() <= 1.0 && phi.sin().abs() < 1e-7, "{phi}");
    }
    assert!(history.energy_error < 1e-6 * history.energy_scale, "{:e}", history.energy_error);
    assert!(last.energy.friction.iter().sum::<f64>() > 0.1);
    assert!(history.drift.position < 1e-8, "{:?}", history.drift);
}

/// A drive keeps the drawer at 0.1 m/s: its work is the resistance's and friction's.
#[test]
fn a_driven_drawer_needs_the_push_that_solve_tells() {
    let model = model_of("drawer");
    let push = crate::solve::solve(&model).unwrap().solutions[0].drives[0].effort;
    let history = simulate(&model, &SimulateOptions::new(0.1)).unwrap();
    let mut reader = history.reader();
    let (first, last) = (reader.at(0.0).unwrap(), reader.at(0.1).unwrap());
    assert!((first.efforts[0] - push).abs() < 1e-9 * push);
    assert!((last.configuration.coordinates[0] - 0.01).abs() < 1e-12);
    // The supported length grows, so the push falls.
    assert!(last.efforts[0] < first.efforts[0]);
    assert!(history.energy_error < 1e-8 * history.energy_scale);
}

/// The same input gives the same history, to the last bit.
#[test]
fn histories_are_deterministic() {
    let run = || simulate(&coasting_crank("0.1"), &SimulateOptions::new(0.1)).unwrap();
    let (one, other) = (run(), run());
    assert_eq!(one.events, other.events);
    assert_eq!(one.dense, other.dense);
}

/// Every gallery model with inertia closes its energy balance as far as it goes.
#[test]
fn energy_is_balanced_in_every_gallery_model() {
    for gallery_model in crate::gallery::MODELS {
        let model = model_of(gallery_model.name);
        if gallery_model.name == "bracket-on-pole" {
            continue;
        }
        let history = simulate(&model, &SimulateOptions::new(0.3)).unwrap();
        let size = history.energy_scale.max(1e-9);
        assert!(
            history.energy_error < 1e-5 * size,
            "{}: {:e} of {size:e}, {:?}",
            gallery_model.name,
            history.energy_error,
            history.end
        );
        assert!(history.drift.position < 1e-7, "{}: {:?}", gallery_model.name, history.drift);
        let words: Vec<&str> = history.events.iter().map(|event| event.words.as_str()).collect();
        assert!(words.iter().all(|words| !words.is_empty()), "{words:?}");
        assert!(Mechanism::new(&model).is_ok());
    }
}
