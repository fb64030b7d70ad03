//! What becomes of the speed with friction in hinges, and what the loads do once the motion has stopped.

use rstest::rstest;
use slideway::report::{FromRest, Proof, SolveReport, SpeedChange, Status};
use slideway::standstill::{HoldOptions, hold};
use slideway::{Model, Settings, solve};

/// A disc of 2 kg and 0.01 kg m^2 on a shaft of 10 mm, mu = 0.2 and mu_static = 0.3, driven by a torque that is a multiple
/// of that of friction, and turning with 5 rad/s.
fn disc(torque: &str) -> Model {
    Model::parse(&format!(
        r#"
        gravity = 9.81
        [parameters]
        turning = "0.01*sin(atan(0.2))*2*9.81"
        sticking = "0.01*sin(atan(0.3))*2*9.81"
        [points]
        O = [0, 0]
        [bodies.disc]
        points = ["O"]
        mass = 2
        centre_of_mass = "O"
        moment_of_inertia = 0.01
        [joints.shaft]
        type = "hinge"
        between = ["disc.O", "ground.O"]
        mu = 0.2
        mu_static = 0.3
        radius = 0.01
        [loads.T]
        type = "torque"
        body = "disc"
        moment = "{torque}"
        [coordinates.phi]
        rotation = "disc"
        rate = 5
        "#
    ))
    .unwrap()
}

/// The shaft carries the weight W alone: it turns with J alpha = T - r W, and begins to turn from |T| = r_static W on.
#[rstest]
#[case("1.01*turning", 0.01, SpeedChange::SpeedsUp, None)]
#[case("0.5*turning", -0.5, SpeedChange::SlowsDown, Some(FromRest::Rests))]
#[case("-turning", -2.0, SpeedChange::SlowsDown, Some(FromRest::Rests))]
#[case("-0.99*sticking", f64::NAN, SpeedChange::SlowsDown, Some(FromRest::Rests))]
#[case("-1.01*sticking", f64::NAN, SpeedChange::SlowsDown, Some(FromRest::MovesBack))]
fn a_disc_on_a_rough_shaft(
    #[case] torque: &str,
    #[case] excess: f64,
    #[case] speed: SpeedChange,
    #[case] from_rest: Option<FromRest>,
) {
    let report = solve(&disc(torque)).unwrap();
    let [solution] = report.solutions.as_slice() else { panic!("{} solutions", report.solutions.len()) };
    let phi = &solution.coordinates[0];
    assert_eq!((phi.speed, report.from_rest), (Some(speed), from_rest));
    assert_eq!(solution.friction_exceeds_loads, torque == "0.5*turning");
    let friction = 0.01 * 0.2_f64.atan().sin() * 2.0 * 9.81;
    let [least, greatest] = phi.acceleration_bounds.unwrap();
    assert!(greatest - least < 1e-9 * friction / 0.01, "{least} to {greatest}");
    if !excess.is_nan() {
        let expected = excess * friction / 0.01;
        assert!((phi.acceleration - expected).abs() < 1e-11 * friction / 0.01);
        assert!(least - 1e-12 <= expected && expected <= greatest + 1e-12);
    }
}

fn slider_crank(text: &str, settings: &Settings) -> SolveReport {
    solve(&Model::parse(text).unwrap().with(settings).unwrap()).unwrap()
}

const SLIDER_CRANK: &str = "slider-crank-with-pins";

/// Against its motion the torque brakes the slider-crank, and turns it back from rest; nothing but friction and weights
/// leave it at rest. Both agree with `hold`.
#[rstest]
#[case("-20", FromRest::MovesBack)]
#[case("0", FromRest::Rests)]
fn a_slider_crank_that_slows_down(#[case] torque: &str, #[case] expected: FromRest) {
    let settings = Settings::default().parameter("gas", "0").parameter("T", torque);
    let text = slideway::gallery::find(SLIDER_CRANK).unwrap().text;
    let report = slider_crank(text, &settings);
    assert_eq!(report.from_rest, Some(expected));
    let model = Model::parse(text).unwrap().with(&settings).unwrap();
    let held = hold(&model, &HoldOptions::default()).unwrap();
    assert_eq!(held.holds, expected == FromRest::Rests);
}

/// That a guided piston does not tip is proven, and that a short one does.
#[test]
fn whether_a_guided_piston_tips_is_proven() {
    let text = slideway::gallery::find(SLIDER_CRANK).unwrap().text.replace("block_slider", "guided_slider");
    let with = |skirt: &str| slider_crank(&text, &Settings::default().parameter("skirt", skirt));
    let long = with("120 mm");
    assert_eq!((long.status, long.complete, long.rejected.len()), (Status::One, Proof::Proven, 0));
    let short = with("1 mm");
    assert_eq!((short.status, short.complete, short.rejected.len()), (Status::None, Proof::Proven, 1));
}
