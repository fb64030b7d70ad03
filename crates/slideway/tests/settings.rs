//! Settings: what a command may change in a model.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::solve::solve;

const MODEL: &str = r#"
    [parameters]
    b = 4
    a = "sqrt(b)"
    [bodies.sledge]
    mass = "a"
    centre_of_mass = [0, 0]
    moment_of_inertia = 1
    [joints.track]
    type = "block_slider"
    block = "sledge"
    at = [0, 0]
    along = "0 deg"
    length = 1
    mu = 0
    [loads.push]
    type = "force"
    at = "sledge.S"
    components = ["3 N/s*t + 2 N/m*x", 0]
    [coordinates.x]
    slide = "track"
    [points]
    S = [0, 0]
"#;

fn model() -> Model {
    Model::parse(&MODEL.replace("centre_of_mass = [0, 0]", "centre_of_mass = \"S\"\npoints = [\"S\"]"))
        .unwrap()
}

#[test]
fn a_parameter_that_is_replaced_is_not_evaluated_any_more() {
    // sqrt(b) would have no value.
    let settings = Settings::default().parameter("b", "-1").parameter("a", "5 kg");
    let mechanism = Mechanism::new(&model().with(&settings).unwrap()).unwrap();
    assert_eq!(mechanism.bodies[0].mass, 5.0);
}

#[test]
fn the_last_of_several_settings_wins() {
    let settings = Settings::default().parameter("b", "9").parameter("b", "16");
    assert_eq!(Mechanism::new(&model().with(&settings).unwrap()).unwrap().bodies[0].mass, 4.0);
}

#[test]
fn a_replaced_parameter_may_use_another_one_that_stands_behind_it() {
    let settings = Settings::default().parameter("b", "2*a").parameter("a", "3");
    let model = model().with(&settings).unwrap();
    assert_eq!(Mechanism::new(&model).unwrap().bodies[0].mass, 3.0);
}

#[test]
fn time_position_and_rate_reach_the_loads() {
    let settings = Settings::default().time("2 s").position("x", "50 cm").rate("x", "1 m/s");
    let report = solve(&model().with(&settings).unwrap()).unwrap();
    // m a = 3 t + 2 x with m = 2 kg, t = 2 s, x = 0.5 m
    assert_eq!(report.solutions[0].coordinates[0].acceleration, 3.5);
    assert_eq!((report.time, report.state[0].value, report.state[0].rate), (2.0, 0.5, 1.0));
}

#[test]
fn settings_that_make_no_sense_are_refused_all_at_once() {
    let settings = Settings::default().parameter("c", "1").position("y", "1").rate("x", "1 m").time("1 m");
    let faults = model().with(&settings).unwrap_err();
    assert_eq!(faults.sorted().len(), 4, "{faults}");
}
