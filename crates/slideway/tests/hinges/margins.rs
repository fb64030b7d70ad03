//! Up to which friction every load has one solution, as a bound from below.

use rstest::rstest;
use slideway::report::{MarginsMissing, SolveReport};
use slideway::{Model, Report, solve};

/// A bar of 2 kg and 0.02 kg m^2 that swings about a rough hinge 0.3 m from its mass centre: the distance of the centre
/// of percussion is (J + m c^2) / (m c) = 1/3 m.
fn bar(friction: &str) -> SolveReport {
    let text = format!(
        r#"
        gravity = 9.81
        [points]
        O = [0, 0]
        C = [0.3, 0]
        [bodies.bar]
        points = ["O", "C"]
        mass = 2
        centre_of_mass = "C"
        moment_of_inertia = 0.02
        [joints.O]
        type = "hinge"
        between = ["bar.O", "ground.O"]
        {friction}
        [coordinates.phi]
        rotation = "bar"
        rate = 1
        "#
    );
    solve(&Model::parse(&text).unwrap()).unwrap()
}

/// A second solution comes in where the friction circle reaches the centre of percussion: r = 1/3 m. With the law of the
/// total reaction r = rho sin(atan mu), which never reaches it on a pin that is thinner.
#[rstest]
#[case("friction_radius = 0.1", Some(10.0 / 3.0))]
#[case("mu = 0.2\nradius = 0.5\nlaw = \"mu_rho\"", Some(10.0 / 3.0))]
#[case("mu = 0.2\nradius = 0.5", Some(5.0 * f64::tan(f64::asin(2.0 / 3.0))))]
#[case("mu = 0.2\nradius = 0.333", Some(1e6))]
#[case("friction_radius = 0.34", None)]
fn of_a_bar_it_is_that_at_the_centre_of_percussion(#[case] friction: &str, #[case] expected: Option<f64>) {
    let report = bar(friction);
    assert_eq!(
        (report.margins.as_ref(), report.margins_missing),
        (None, Some(MarginsMissing::FrictionInHinges))
    );
    match (report.unique_at_least, expected) {
        (Some(found), Some(expected)) => {
            assert!(found <= expected && expected < found * 1.001, "{found} instead of {expected}");
            let words = if expected < 1e6 { "Up to at least " } else { "Whatever the friction, " };
            assert!(report.answer().contains(words), "{}", report.answer());
        }
        (found, expected) => assert_eq!(found, expected),
    }
}

/// Over the range that is told there is one solution.
#[rstest]
#[case("toggle-press")]
#[case("slider-crank-with-pins")]
fn no_margin_of_a_solution_is_below_it(#[case] name: &str) {
    let report = solve(&Model::parse(slideway::gallery::find(name).unwrap().text).unwrap()).unwrap();
    let [solution] = report.solutions.as_slice() else { panic!("{} solutions", report.solutions.len()) };
    let bound = report.unique_at_least.unwrap();
    let ends_with = solution.margin.as_ref().unwrap();
    assert!(bound > 1.0);
    // Within it the only solution may go on in another contact mode, but not end.
    let changes_side = !ends_with.contacts.is_empty();
    assert!(changes_side || ends_with.factor.is_none_or(|factor| bound <= factor), "{bound}: {ends_with:?}");
}
