//! The models of the gallery with friction in hinges show what their opening comments say.

use serde::Deserialize;
use slideway::report::{Proof, Solution, SolveReport};
use slideway::{DriveOptions, HoldOptions, Model, Settings, drive, gallery, hold, solve};
use std::path::Path;

fn model(name: &str) -> Model {
    Model::parse(gallery::find(name).unwrap().text).unwrap()
}

fn only(report: &SolveReport) -> &Solution {
    assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
    let [solution] = report.solutions.as_slice() else { panic!("{} solutions", report.solutions.len()) };
    solution
}

/// Each link carries a force S that is tangent to the friction circles at both ends: it leans by delta against the link,
/// against the motion. Along the ram `S cos(alpha + delta) = Q + mu N`, `N = S sin(alpha + delta)`; at the knee `P = 2
/// S sin(alpha + delta)`. Both contacts of the ram press on one side while `tan(alpha + delta) > 2 r / L` or so.
#[test]
fn the_toggle_press_needs_what_its_comment_says() {
    let friction_radius = 12e-3 * 0.12 / (1.0 + 0.12_f64.powi(2)).sqrt();
    let delta = (2.0 * friction_radius / 0.1).asin();
    for degrees in [3.0_f64, 5.0, 10.0, 30.0] {
        let model =
            model("toggle-press").with(&Settings::default().position("alpha", degrees.to_radians())).unwrap();
        let effort = only(&solve(&model).unwrap()).drives[0].effort;
        let tangent = (degrees.to_radians() + delta).tan();
        let expected = 2.0 * 1e4 * tangent / (1.0 - 0.1 * tangent);
        assert!((effort / expected - 1.0).abs() < 1e-9, "{degrees} deg: {effort} instead of {expected}");
    }
}

/// On the way back the force leans the other way. Above alpha = delta the load opens the press; below it the knee has to
/// be pulled. Without friction in the ram, whose side of contact changes there.
#[test]
fn the_toggle_press_holds_itself_when_it_is_stretched() {
    let friction_radius = 12e-3 * 0.12 / (1.0 + 0.12_f64.powi(2)).sqrt();
    let delta = (2.0 * friction_radius / 0.1).asin();
    for (share, sign) in [(0.99, -1.0), (1.01, 1.0)] {
        let settings =
            Settings::default().parameter("mu", 0.0).position("alpha", share * delta).rate("alpha", 1.0);
        let effort = only(&solve(&model("toggle-press").with(&settings).unwrap()).unwrap()).drives[0].effort;
        let expected = 2.0 * 1e4 * ((share - 1.0) * delta).tan();
        assert!((effort - expected).abs() < 1e-6 && effort * sign > 0.0, "{effort} instead of {expected}");
    }
}

#[test]
fn the_toggle_press_has_an_efficiency() {
    let report = drive(&model("toggle-press"), &DriveOptions::default()).unwrap();
    let closing = &report.directions[0].solutions[0];
    let frictionless = report.directions[0].frictionless.efforts[0];
    assert!((frictionless / (2e4 * 5.0_f64.to_radians().tan()) - 1.0).abs() < 1e-9);
    let efficiency = closing.efficiency.value.unwrap();
    assert!((efficiency / (frictionless / closing.efforts[0]) - 1.0).abs() < 1e-9);
}

/// Every hinge force is tangent to the friction circle, the answer is unique, and without friction in the pins it is that
/// of the other model.
#[test]
fn the_slider_crank_has_one_solution_at_any_angle() {
    for degrees in [10.0_f64, 60.0, 89.0, 150.0, 200.0, 350.0] {
        let at = Settings::default().position("phi", degrees.to_radians());
        let report = solve(&model("slider-crank-with-pins").with(&at).unwrap()).unwrap();
        for hinge in &only(&report).hinges {
            let friction = hinge.friction.unwrap();
            let expected = friction.radius * hinge.force[0].hypot(hinge.force[1]);
            assert!((friction.couple.abs() / expected - 1.0).abs() < 1e-12);
            assert!(friction.couple * friction.angular_velocity < 0.0);
        }
        assert!(report.strategy.contains("one solution for every load"), "{}", report.strategy);
        let smooth = model("slider-crank-with-pins").with(&at.clone().parameter("mu_pin", 0.0)).unwrap();
        let other = solve(&model("slider-crank").with(&at).unwrap()).unwrap();
        assert_eq!(only(&solve(&smooth).unwrap()).contacts, only(&other).contacts);
    }
}

#[derive(Deserialize)]
struct File {
    bell_crank: Vec<BellCrank>,
    four_bar: Vec<FourBar>,
    four_bar_locked: Vec<Locked>,
    quick_return: Vec<Effort>,
    clamp: Vec<Effort>,
    clamp_holds: Vec<Holding>,
}

#[derive(Deserialize)]
struct BellCrank {
    pin: f64,
    sense: f64,
    effort: f64,
}

#[derive(Deserialize)]
struct FourBar {
    phi: f64,
    efforts: Vec<f64>,
}

#[derive(Deserialize)]
struct Locked {
    edges: Vec<f64>,
}

#[derive(Deserialize)]
struct Effort {
    phi: f64,
    sense: f64,
    #[serde(rename = "effort")]
    value: f64,
}

#[derive(Deserialize)]
struct Holding {
    phi: f64,
}

/// Numbers of `reference/gallery_hinges.py`: balances of each body, written out by hand.
fn reference() -> File {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../reference/gallery-hinges.toml");
    toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// The efforts of the only drive in all solutions, proven to be all.
fn efforts(name: &str, settings: &Settings) -> Vec<f64> {
    let report = solve(&model(name).with(settings).unwrap()).unwrap();
    assert_eq!(report.complete, Proof::Proven, "{name}: {:?}", report.open);
    report.solutions.iter().map(|solution| solution.drives[0].effort).collect()
}

fn assert_effort(name: &str, settings: &Settings, expected: &[f64]) {
    let found = efforts(name, settings);
    assert_eq!(found.len(), expected.len(), "{name}: {found:?} instead of {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{name}: {found} instead of {expected}");
    }
}

#[test]
fn the_bell_crank_needs_what_its_quadratic_equation_says() {
    for BellCrank { pin, sense, effort } in reference().bell_crank {
        let settings = Settings::default().parameter("pin", pin).rate("phi", sense);
        assert_effort("bell-crank", &settings, &[effort]);
    }
}

/// Where the friction circle is larger than the arm of the load, the lever has to be pulled back; where it is larger than
/// the arm of the push, nothing raises the load.
#[test]
fn the_bell_crank_holds_and_locks_with_a_pin_that_is_thick_enough() {
    let pin = |radius: f64| Settings::default().parameter("pin", radius * 1.04_f64.sqrt() / 0.2);
    assert!(efforts("bell-crank", &pin(0.0499).rate("phi", -1.0))[0] > 0.0);
    assert!(efforts("bell-crank", &pin(0.0501).rate("phi", -1.0))[0] < 0.0);
    assert!(efforts("bell-crank", &pin(0.0799))[0] > 1e4);
    assert!(efforts("bell-crank", &pin(0.0801)).is_empty());
}

#[test]
fn the_treadle_needs_what_the_balances_say() {
    let reference = reference();
    for FourBar { phi, efforts } in reference.four_bar {
        assert_effort("four-bar", &Settings::default().position("phi", phi.to_radians()), &efforts);
    }
    for edge in &reference.four_bar_locked[0].edges {
        let at =
            |degrees: f64| efforts("four-bar", &Settings::default().position("phi", degrees.to_radians()));
        let beside = [edge - 1e-6, edge + 1e-6].map(|degrees| at(degrees).len());
        assert!(beside.contains(&0) && beside.contains(&1), "{edge}: {beside:?}");
    }
}

#[test]
fn the_table_of_the_treadle_has_its_locked_ranges() {
    let vary: slideway::Vary = "phi=0 deg..360 deg".parse().unwrap();
    let report = drive(&model("four-bar"), &DriveOptions::default().vary(vary).rows(5)).unwrap();
    let locked = &report.course.as_ref().unwrap().directions[0].locked;
    let edges: Vec<f64> =
        locked.iter().flat_map(|range| [range.from, range.to]).map(f64::to_degrees).collect();
    let expected = &reference().four_bar_locked[0].edges;
    assert_eq!(edges.len(), expected.len(), "{edges:?}");
    for (edge, expected) in edges.iter().zip(expected) {
        assert!((edge - expected).abs() < 1e-6, "{edge} instead of {expected}");
    }
}

#[test]
fn the_quick_return_mechanism_needs_what_the_balances_say() {
    for Effort { phi, sense, value: effort } in reference().quick_return {
        let settings = Settings::default().position("phi", phi.to_radians()).rate("phi", 5.0 * sense);
        assert_effort("quick-return", &settings, &[effort]);
    }
}

/// Without load massless links carry nothing, however they move: what is left of their forces is rounding, and they do not jam.
#[test]
fn links_without_load_need_no_effort() {
    for (name, load) in [("quick-return", "Q"), ("toggle-press", "Q"), ("over-centre-clamp", "F")] {
        let unloaded = model(name).with(&Settings::default().parameter(load, 0.0)).unwrap();
        let report = solve(&unloaded).unwrap();
        assert!(only(&report).drives[0].effort.abs() < 1e-9, "{name}");
    }
    let vary: slideway::Vary = "Q=0..600 N".parse().unwrap();
    let report = drive(&model("quick-return"), &DriveOptions::default().vary(vary).rows(3)).unwrap();
    for direction in &report.course.as_ref().unwrap().directions {
        let efforts = direction.rows[0].efforts.as_ref().expect("it does not jam");
        assert!(efforts[0].abs() < 1e-9 && direction.locked.is_empty(), "{direction:?}");
    }
}

#[test]
fn the_clamp_needs_what_the_balances_say_and_holds_before_its_centre() {
    let reference = reference();
    for Effort { phi, sense, value: effort } in reference.clamp {
        let settings = Settings::default().position("phi", phi.to_radians()).rate("phi", sense);
        assert_effort("over-centre-clamp", &settings, &[effort]);
    }
    for (step, holds) in [(-1e-5, true), (1e-5, false)] {
        let degrees = reference.clamp_holds[0].phi + step;
        let at = Settings::default().position("phi", degrees.to_radians());
        let report = hold(&model("over-centre-clamp").with(&at).unwrap(), &HoldOptions::default()).unwrap();
        assert_eq!(report.holds, holds, "{degrees} deg");
    }
}
