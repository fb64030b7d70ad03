//! The models of the gallery with friction in hinges show what their opening comments say.

use slideway::report::{Proof, Solution, SolveReport};
use slideway::{DriveOptions, Model, Settings, drive, gallery, solve};

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
        assert!(report.strategy.contains("every load has one solution"), "{}", report.strategy);
        let smooth = model("slider-crank-with-pins").with(&at.clone().parameter("mu_pin", 0.0)).unwrap();
        let other = solve(&model("slider-crank").with(&at).unwrap()).unwrap();
        assert_eq!(only(&solve(&smooth).unwrap()).contacts, only(&other).contacts);
    }
}
