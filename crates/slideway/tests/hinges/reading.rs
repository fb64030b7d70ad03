//! What a model file may say about the friction of a hinge.

use rstest::rstest;
use slideway::fault::{Fault, FaultKind};
use slideway::mechanism::Mechanism;
use slideway::model::PinLaw;
use slideway::{Drawing, Faults, GROUND, Model, Settings};

fn pendulum(friction: &str) -> String {
    format!(
        "gravity = 9.81\n\
         [parameters]\nmu = 0.3\n\
         [points]\nO = [0, 0]\n\
         [bodies.bar]\npoints = [\"O\"]\nmass = 1\nmoment_of_inertia = 0.02\ncentre_of_mass = [0.1, 0]\n\
         [joints.pin]\ntype = \"hinge\"\nbetween = [\"bar.O\", \"ground.O\"]\n{friction}\n\
         [coordinates.phi]\nrotation = \"bar\"\nrate = 1\n"
    )
}

fn radii(friction: &str) -> [f64; 2] {
    let mechanism = Mechanism::new(&Model::parse(&pendulum(friction)).unwrap()).unwrap();
    let [circle] = mechanism.friction_circles[..] else { panic!("one hinge has friction") };
    [circle.radius, circle.static_radius]
}

/// r = rho sin(atan mu), or mu rho: with mu = 3/4 the sine is 3/5.
#[rstest]
#[case("mu = 0.75\nradius = 0.01", [0.006, 0.006])]
#[case("mu = 0.75\nradius = 0.01\nlaw = \"mu_rho\"", [0.0075, 0.0075])]
#[case("mu = 0\nmu_static = 0.75\nradius = \"10 mm\"\nlaw = \"total_reaction\"", [0.0, 0.006])]
#[case("friction_radius = \"2 mm\"", [0.002, 0.002])]
#[case("friction_radius = \"2 mm\"\nstatic_friction_radius = \"mu * 10 mm\"", [0.002, 0.003])]
fn radii_follow_from_the_pin_or_are_given(#[case] friction: &str, #[case] expected: [f64; 2]) {
    for (radius, expected) in radii(friction).into_iter().zip(expected) {
        assert!((radius - expected).abs() <= 1e-17, "{radius} instead of {expected}");
    }
}

#[test]
fn a_hinge_without_friction_has_no_circle() {
    let mechanism = Mechanism::new(&Model::parse(&pendulum("")).unwrap()).unwrap();
    assert!(mechanism.friction_circles.is_empty());
}

fn faults(friction: &str) -> Vec<Fault> {
    Model::parse(&pendulum(friction)).unwrap_err().sorted().into_iter().cloned().collect()
}

#[rstest]
#[case("mu = 0.1", "pin has a `mu` without a `radius`")]
#[case("radius = 0.1", "pin has a `radius` without a `mu`")]
#[case("law = \"mu_rho\"", "pin has a `law` without a `mu`")]
#[case("mu_static = 0.1\nradius = 0.1", "pin has a `radius` without a `mu`")]
#[case("static_friction_radius = 0.1", "pin has a `static_friction_radius` without a `friction_radius`")]
#[case("mu = 0.1\nradius = 0.1\nfriction_radius = 0.1", "pin has both `mu` and `friction_radius`")]
#[case("mu = 0.1\nradius = -0.1", "the radius of the pin of pin must be at least zero, but is -0.1 m")]
#[case("mu = -0.1\nradius = 0.1", "the friction coefficient of pin must be at least zero, but is -0.1")]
#[case("friction_radius = -1", "the friction radius of pin must be at least zero, but is -1 m")]
#[case(
    "mu = 0.2\nmu_static = 0.1\nradius = 0.1",
    "the static friction coefficient 0.1 of pin is below its kinetic one, 0.2"
)]
#[case(
    "friction_radius = 0.2\nstatic_friction_radius = 0.1",
    "the static friction radius 0.1 m of pin is below its kinetic one, 0.2 m"
)]
#[case("mu = 0.1\nradius = 0.1\nlaw = \"mu\"", "`joints.pin.law` cannot be \"mu\"")]
fn what_says_too_little_or_too_much_is_refused(#[case] friction: &str, #[case] message: &str) {
    let faults = faults(friction);
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].kind.to_string(), message);
    assert!(faults[0].place.is_some());
}

/// Help says how friction of a hinge can be given, and that it does not depend on a speed.
#[rstest]
#[case("mu = 0.1", "in place of both, `friction_radius` gives the radius of its friction circle")]
#[case("radius = 0.1", "in place of both, `friction_radius` gives the radius of its friction circle")]
#[case("static_friction_radius = 0.1", "the friction circle while the hinge turns")]
#[case("mu = \"0.1 + sliding_speed/(1 m/s)\"\nradius = 0.1", "only `mu` of sliding joints may depend on it")]
fn help_says_what_a_hinge_may_have(#[case] friction: &str, #[case] help: &str) {
    let hint = faults(friction)[0].kind.hint().unwrap_or_default();
    assert!(hint.contains(help), "{hint}");
}

/// Where static friction is below kinetic because of a setting, the setting is to blame.
#[test]
fn settings_are_checked_too() {
    let model = Model::parse(&pendulum("mu = \"mu\"\nmu_static = 0.4\nradius = 0.1")).unwrap();
    let faults = model.with(&Settings::default().parameter("mu", "0.5")).unwrap_err();
    let fault = faults.sorted()[0].clone();
    assert!(matches!(fault.kind, FaultKind::StaticBelowKinetic { .. }), "{fault:?}");
    assert_eq!(fault.place.unwrap().source, slideway::fault::Source::Setting(0));
}

#[test]
fn a_drawing_says_the_same() -> Result<(), Faults> {
    let drawn = |law: Option<PinLaw>| {
        let mut d = Drawing::new();
        let bar = d.body("bar").mass(1.0).centre([0.1, 0.0]).inertia(0.02).id();
        let hinge = d.hinge("pin", bar, GROUND).at([0.0, 0.0]).mu(0.75).mu_static(0.75).radius(0.01);
        match law {
            Some(law) => hinge.law(law).id(),
            None => hinge.id(),
        };
        d.hinge("other", bar, GROUND).at([1.0, 0.0]).friction_radius(0.001).static_friction_radius(0.002);
        d.build()
    };
    for (law, radius) in [(None, 0.006), (Some(PinLaw::TotalReaction), 0.006), (Some(PinLaw::MuRho), 0.0075)]
    {
        let mechanism = Mechanism::new(&drawn(law)?)?;
        let radii: Vec<[f64; 2]> =
            mechanism.friction_circles.iter().map(|circle| [circle.radius, circle.static_radius]).collect();
        assert_eq!(radii, [[radius; 2], [0.001, 0.002]]);
    }
    Ok(())
}
