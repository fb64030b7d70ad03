//! Ranges whose greater end stands first are taken as they are meant: every question has the same answer.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::limits::{LimitsOptions, Vary, limits, rest_limits};
use slideway::map::{MapOptions, map};
use slideway::model::Settings;
use slideway::standstill::HoldOptions;
use slideway::{Model, Report, drive, gallery, size, solve};

fn model(name: &str) -> Model {
    Model::parse(gallery::find(name).unwrap().text).unwrap()
}

#[test]
fn both_orders_of_a_range_have_one_answer() {
    let drawer = model("drawer");
    let bracket = model("bracket-on-pole");
    let of_both = |answer: &dyn Fn(Vary) -> String, both: [&str; 2]| {
        let [one, other] = both.map(|text| answer(text.parse().unwrap()));
        assert_eq!(one, other, "{both:?}");
        assert!(!one.is_empty());
    };
    let lengths = ["L=0.5 m..300 mm", "L=300 mm..0.5 m"];
    of_both(&|vary| limits(&drawer, &LimitsOptions::new(vary)).unwrap().json(), lengths);
    of_both(&|vary| size::size(&drawer, &size::SizeOptions::new(vary, 2.0)).unwrap().json(), lengths);
    let drive_over = |vary| drive::drive(&drawer, &drive::DriveOptions::default().vary(vary)).unwrap().json();
    of_both(&drive_over, lengths);
    of_both(
        &|vary| rest_limits(&bracket, &vary, &HoldOptions::default()).unwrap().json(),
        ["mu_static=0.5..0", "mu_static=0..0.5"],
    );
    let over_both = |y: Vary| {
        let x = Vary::between("mu", 1.0, 0.0);
        map(&drawer, &MapOptions::new(x, y).size(4, 4)).unwrap().json()
    };
    of_both(&over_both, lengths);
    let known = |range: &str| {
        let model = drawer.with(&Settings::default().parameter("mu", range)).unwrap();
        solve::solve(&model).unwrap().json()
    };
    assert_eq!(known("0.3..0.2"), known("0.2..0.3"));
}

/// The drawer jams at mu = L/(2 a), wherever that lies; a length has the range that `size` gives it.
#[test]
fn a_range_that_is_not_given_contains_the_jam_that_is_known() {
    let desk = Settings::default().parameter("L", "0.45 m").parameter("a", "0.2 m");
    let over = |name: &str, settings: &Settings| {
        let model = model("drawer").with(settings).unwrap();
        let report = limits(&model, &LimitsOptions::new(Vary::usual(name))).unwrap();
        ([report.vary.from, report.vary.to], report.answer())
    };
    let rough = desk.clone().parameter("mu", "0.01");
    for (name, settings, [from, to], jams) in [
        ("mu", &desk, [0.0, 2.25], "mu = 1.125"),
        ("mu", &Settings::default(), [0.0, 1.0], "mu = 0.6667"),
        // 0.45 m/(2 0.2 m 0.01) times the friction of the model.
        ("friction", &rough, [0.0, 225.0], "112.5 times this friction"),
        // L/(2 mu) = 0.4 m/0.6
        ("a", &Settings::default(), [0.06, 1.5], "a = 0.6667 m"),
    ] {
        let (range, answer) = over(name, settings);
        assert!((range[0] - from).abs() + (range[1] - to).abs() < 1e-9, "{name}: {range:?}");
        assert!(answer.starts_with(&format!("It jams from {jams} on")), "{answer}");
    }
}

/// A kinetic coefficient is not above its static one, whatever the usual range of friction is.
#[test]
fn kinetic_friction_ends_at_its_static_friction() {
    for (name, static_friction) in
        [("stick-slip", 0.4), ("frictional-oscillator", 0.25), ("bracket-on-pole", 0.25)]
    {
        let model = model(name);
        assert_eq!(model.friction_range("mu"), Some([0.0, static_friction]), "{name}");
        let kinetic = if name == "stick-slip" { 0.25 } else { 0.2 };
        assert_eq!(model.friction_range("mu_static"), Some([kinetic, f64::INFINITY]), "{name}");
    }
    let report = limits(&model("stick-slip"), &LimitsOptions::new(Vary::usual("mu"))).unwrap();
    assert_eq!([report.vary.from, report.vary.to], [0.0, 0.4]);
    assert!(report.without_mode_problem.is_empty());
    // Nothing is at rest in another way than it slides here, and a length is no friction.
    let drawer = model("drawer");
    assert_eq!(drawer.friction_range("mu"), Some([0.0, f64::INFINITY]));
    assert_eq!(drawer.friction_range("L"), None);
}
