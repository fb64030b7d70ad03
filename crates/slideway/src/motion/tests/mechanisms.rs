//! Whole mechanisms in motion: conservation of energy, reversal of time, balances with friction.

use super::model_of;
use crate::check::check;
use crate::configuration::Configuration;
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

/// Names and values of parameters.
type Parameters = &'static [(&'static str, &'static str)];

/// Every gallery model that can move on its own, without friction and dampers, and for how long: (name,
/// settings, duration).
const FRICTIONLESS: [(&str, Parameters, f64); 10] = [
    ("elliptic-trammel", &[("mu", "0")], 3.0),
    ("slider-crank", &[("mu", "0"), ("gas", "0 N"), ("T", "0 N m")], 0.25),
    ("klepp-2002", &[("mu_1", "0"), ("mu_2", "0"), ("mu_3", "0"), ("F_20", "0 N")], 1.0),
    (
        "klepp-2002-spring",
        &[("mu_1", "0"), ("mu_2", "0"), ("mu_3", "0"), ("c", "0 N s/m"), ("P", "0 N")],
        2.0,
    ),
    ("painleve-klein", &[("mu", "0")], 1.0),
    ("frictional-oscillator", &[("mu", "0"), ("mu_static", "0")], 2.0),
    ("stick-slip", &[("mu", "0"), ("mu_static", "0")], 2.0),
    ("scotch-yoke", &[("mu_pin", "0"), ("mu_yoke", "0")], 0.1),
    ("sleeve-on-arm", &[("mu", "0")], 1.0),
    ("telescopic-boom", &[("mu", "0")], 0.27),
];

/// Without friction energy is conserved, and the motion runs back when all velocities are reversed.
#[test]
fn frictionless_motion_conserves_energy_and_can_be_reversed() {
    for (name, settings, duration) in FRICTIONLESS {
        let settings =
            settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
        let model = model_of(name).with(&settings).unwrap();
        let history = simulate(&model, &SimulateOptions::new(duration)).unwrap();
        assert_eq!(history.end, End::Finished, "{name}");
        let scale = history.energy_scale;
        assert!(history.energy_error <= 1e-6 * scale, "{name}: {:e}", history.energy_error);
        let energy = history.reader().at(duration).unwrap().energy;
        assert!(energy.friction.iter().all(|part| part.abs() <= 1e-12 * scale), "{name}: {energy:?}");
        assert!(
            history.drift.position < 1e-8 && history.drift.velocity < 1e-5,
            "{name}: {:?}",
            history.drift
        );
        let back = reversed(&history, duration);
        let start = Configuration::new(&history.mechanism).unwrap();
        let moved = history.reader().configuration(duration).unwrap().clone();
        let end = back.reader().configuration(back.stop()).unwrap().clone();
        let size = history.mechanism.size;
        let distance = |one: &Configuration, other: &Configuration| {
            let poses = one.poses.iter().zip(&other.poses);
            poses.fold(0.0_f64, |greatest, (one, other)| {
                let turned = (one.angle() - other.angle()).abs();
                greatest.max((one.position - other.position).norm() / size).max(turned)
            })
        };
        assert!(distance(&start, &moved) > 0.01, "{name}: it does not move");
        assert!(distance(&start, &end) < 1e-6, "{name}: {:e}", distance(&start, &end));
        let velocities = start.velocities.iter().zip(&end.velocities);
        let fastest = start.velocities.iter().map(|velocity| velocity.linear.norm());
        let fastest = fastest.fold(size, f64::max);
        for (start, end) in velocities {
            assert!((start.linear + end.linear).norm() < 1e-5 * fastest, "{name}");
        }
    }
}

/// The piston stops at each dead centre and slides on at once: two stops in each turn. What it loses is what
/// friction takes.
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

/// A gallery model whose motion is followed for its balance of energy.
struct Balanced {
    name: &'static str,
    /// What is replaced in its text.
    replaced: Option<(&'static str, &'static str)>,
    settings: &'static [(&'static str, &'static str)],
    duration: f64,
    /// Stops, slips and changes of side after the start.
    events: usize,
}

const fn balanced(name: &'static str, duration: f64, events: usize) -> Balanced {
    Balanced { name, replaced: None, settings: &[], duration, events }
}

/// Every gallery model with inertia or a drive, so that something happens in each: driven ones are slowed down until
/// they return, or go on through places where hinges turn back.
const BALANCED: [Balanced; 35] = [
    balanced("bell-crank", 1.0, 0),
    balanced("boom-in-wind", 1.0, 1),
    balanced("box-on-incline", 0.3, 1),
    balanced("cam-and-spring", 0.3, 5),
    balanced("cam-follower", 1.0, 2),
    Balanced {
        replaced: Some(("acceleration = 0", "acceleration = \"-0.4 m/s^2\"")),
        ..balanced("drawer", 1.0, 1)
    },
    balanced("drawer-on-runners", 1.0, 0),
    balanced("elliptic-trammel", 1.0, 5),
    balanced("four-bar", 0.16, 1),
    balanced("frictional-oscillator", 1.0, 5),
    balanced("klepp-2002", 1.0, 1),
    balanced("klepp-2002-spring", 1.0, 7),
    Balanced { settings: &[("climbed", "1")], ..balanced("ladder", 0.3, 0) },
    balanced("latch-with-pawl", 0.1, 1),
    balanced("nip-of-rolls", 0.3, 0),
    balanced("over-centre-clamp", 0.5, 2),
    Balanced { settings: &[("direction", "-1")], ..balanced("painleve-klein", 1.0, 1) },
    balanced("peg-in-hole", 0.5, 0),
    balanced("quick-return", 0.6, 2),
    balanced("rattling-drawer", 0.1, 20),
    balanced("rod-on-floor", 0.3, 2),
    balanced("scotch-yoke", 0.2, 20),
    Balanced {
        replaced: Some(("acceleration = 0", "acceleration = \"-0.08 m/s^2\"")),
        ..balanced("screw", 1.0, 1)
    },
    balanced("shaft-in-v-block", 0.3, 0),
    balanced("sleeve-on-arm", 1.0, 6),
    balanced("slider-crank", 0.1, 20),
    balanced("slider-crank-with-pins", 0.1, 20),
    balanced("soft-closing-drawer", 1.0, 2),
    balanced("stick-slip", 2.0, 6),
    balanced("stribeck-belt", 2.0, 6),
    balanced("telescopic-boom", 1.0, 3),
    balanced("thrown-drawer", 0.6, 1),
    balanced("toggle-press", 0.2, 3),
    Balanced {
        replaced: Some(("acceleration = 0", "acceleration = \"-0.04 m/s^2\"")),
        ..balanced("wedge", 1.0, 1)
    },
    balanced("woodpecker", 0.3, 20),
];

/// Every gallery model that moves closes its energy balance, through its events, the better the smaller the
/// tolerance is: steps are as long as the tolerance permits.
#[test]
fn energy_is_balanced_in_every_gallery_model() {
    let named: Vec<&str> = BALANCED.iter().map(|one| one.name).collect();
    for gallery_model in crate::gallery::MODELS {
        let check = check(&Model::parse(gallery_model.text).unwrap()).unwrap();
        let name = gallery_model.name;
        assert_eq!(named.contains(&name), check.is_ready_for("simulate"), "{name}");
    }
    for Balanced { name, replaced, settings, duration, events } in BALANCED {
        let text = crate::gallery::find(name).unwrap().text;
        let (from, to) = replaced.unwrap_or(("", ""));
        assert!(text.contains(from));
        let text = if from.is_empty() { text.to_owned() } else { text.replace(from, to) };
        let settings =
            settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
        let model = Model::parse(&text).unwrap().with(&settings).unwrap();
        let errors = [1e-6, 1e-8, 1e-10].map(|tolerance| {
            let longest_step = Some(duration / 20.0);
            let options = SimulateOptions { tolerance, longest_step, ..SimulateOptions::new(duration) };
            let history = simulate(&model, &options).unwrap();
            assert_eq!(history.end, End::Finished, "{name}");
            assert!(history.events.len() > events, "{name}: {}", history.events.len() - 1);
            assert!(history.events.iter().all(|event| !event.words.is_empty()), "{name}");
            let error = history.energy_error / history.energy_scale;
            // What tens of steps with an error of a tolerance each come to, or rounding.
            assert!(error < 50.0 * tolerance || error < 1e-14, "{name}: {error:e} at {tolerance:e}");
            assert!(history.drift.position < 100.0 * tolerance, "{name}: {:?}", history.drift);
            error
        });
        // Where a drive prescribes the motion, the longest step alone is as accurate as the least tolerance asks.
        assert!(errors[2] < 0.01 * errors[0] || errors[0] < 50.0 * 1e-10, "{name}: {errors:?}");
    }
}
