//! What holds by itself, and what holds only while something has wedged it: closed forms of statics.
//!
//! A bracket of length `B` on a pole of diameter `d` with the load at `x` holds by itself from `mu_static = B/(2 x)` on
//! (`N B = W x`, `W = 2 mu N`), and can be wedged from `B/d` on. A drawer of length `L` and width `b`, pulled `a` beside its
//! middle: from `L/(2 a)` and from `L/b` on.

use crate::answers::{assert_close, model, parameters};
use slideway::gallery;
use slideway::limits::{Vary, rest_limits};
use slideway::map::{ColourBy, MapOptions, map};
use slideway::model::Model;
use slideway::report::Report;
use slideway::size::{Against, SizeOptions, size};
use slideway::standstill::{HoldOptions, HoldReport, HoldVerdict, hold};

fn bracket(settings: &[(&str, &str)]) -> Model {
    model("bracket-on-pole").with(&parameters(settings)).unwrap()
}

fn held(model: &Model, load: &str) -> HoldReport {
    hold(model, &HoldOptions::default().load(load)).unwrap()
}

/// The coefficients from which on it can be wedged, and from which on the load holds by itself, with the present one.
fn thresholds(report: &HoldReport) -> [Option<f64>; 2] {
    let load = report.load.as_ref().unwrap();
    let now = load.threshold.coefficients.first().map_or(0.0, |first| first.mu_static[0]);
    let unit = load.threshold.value.map_or(1.0, |value| now / value);
    [load.threshold.value, load.certain_from].map(|value| value.map(|value| value * unit))
}

#[track_caller]
fn assert_thresholds(report: &HoldReport, expected: [f64; 2]) {
    let found = thresholds(report);
    for (found, expected) in found.iter().zip(expected) {
        assert_close(found.unwrap(), expected, 0.0, 1e-8);
    }
}

#[test]
fn a_bracket_holds_by_itself_from_its_rule_on() {
    // Wider than long: the load holds by itself before anything could wedge it.
    assert_thresholds(&held(&bracket(&[("x", "200 mm")]), "W"), [0.381, 0.381]);
    // B/d = 0.5, B/(2 x) = 5.
    let close = [("B", "20 mm"), ("d", "40 mm"), ("x", "2 mm")];
    for (mu, verdict) in
        [("0.3", HoldVerdict::DoesNotHold), ("0.6", HoldVerdict::HoldsOrSlips), ("6", HoldVerdict::MayHold)]
    {
        let report = held(&bracket(&[&close[..], &[("mu_static", mu)]].concat()), "W");
        assert_thresholds(&report, [0.5, 5.0]);
        assert_eq!(report.verdict, verdict, "{mu}");
        assert_eq!(report.answer().starts_with("Self-locking"), mu == "6", "{}", report.answer());
    }
}

#[test]
fn a_drawer_that_is_pulled_holds_by_itself_from_its_rule_on() {
    let text = r#"
[points]
S = [0, 0]
eye = [0, 0.12]
[bodies.drawer]
points = ["S", "eye"]
mass = 4
centre_of_mass = "S"
shape = { rectangle = [0.3, 0.35] }
[joints.g]
type = "block_slider"
block = "drawer"
at = "S"
along = 0
length = 0.3
height = 0.35
mu = 0.35
[loads.s]
type = "force"
at = "drawer.eye"
components = [160, 0]
[coordinates.x]
slide = "g"
"#;
    let with = |mu: &str| Model::parse(&text.replace("mu = 0.35", &format!("mu = {mu}"))).unwrap();
    for mu in ["0.35", "1", "1.26"] {
        assert_thresholds(&held(&with(mu), "s"), [0.3 / 0.35, 0.3 / 0.24]);
    }
    // With N = N_front = -N_rear and |f| <= 2 |N|, f_1 + f_2 = 160 and 0.3 N = 19.2 + 0.175 (f_1 - f_2) = -8.8 + 0.35 f_1:
    // f_2 <= 2 N asks for N >= 47.2, f_2 <= -2 N for N <= -118.
    let report = hold(&with("2"), &HoldOptions::default()).unwrap();
    let front = &report.at_rest.as_ref().unwrap().reactions.contacts[0];
    let [low, high] = front.normal_force_parts.as_slice() else { panic!("{front:?}") };
    assert_eq!((low.least, high.greatest), (None, None));
    assert_close(low.greatest.unwrap(), -118.0, 0.0, 1e-6);
    assert_close(high.least.unwrap(), 47.2, 0.0, 1e-6);
}

/// Over ranges and in maps there are three classes, and sizes count only what holds by itself.
#[test]
fn ranges_maps_and_sizes_tell_what_holds_only_while_wedged() {
    let bracket = bracket(&[("B", "20 mm"), ("d", "42 mm"), ("mu_static", "0.6"), ("mu", "0.6")]);
    let x = || Vary::between("x", "1 mm", "50 mm");
    // B/(2 mu) = 16.667 mm.
    let report = rest_limits(&bracket, &x(), &HoldOptions::default()).unwrap();
    let [wedged, sure] = report.spans.as_slice() else { panic!("{:?}", report.spans) };
    assert_eq!(
        [wedged, sure].map(|span| (span.holds, span.may_slip)),
        [(Some(true), true), (Some(true), false)]
    );
    assert_close(sure.from, 0.02 / 1.2, 0.0, 1e-9);
    let options = SizeOptions::new(x(), 1.0).against(Against::Hold { load: Some("W".to_owned()) });
    let sized = size(&bracket, &options).unwrap();
    let [met] = sized.met.as_slice() else { panic!("{:?}", sized.met) };
    assert_close(met.from, 0.02 / 1.2, 0.0, 1e-8);
    let mu = Vary::between("mu_static", "0.6", "3");
    let plane = map(&bracket, &MapOptions::new(x(), mu).colour_by(ColourBy::Hold).size(8, 8)).unwrap();
    assert_eq!(plane.classes.len(), 2, "{:?}", plane.classes);
}

/// A bracket with its weight at the hook falls freely once it slides. Let down gently it holds from mu_static = B/(2 x) = 0.25
/// on: 0.4 is 1.6 times that.
#[test]
fn sizes_tell_what_holds_if_it_is_let_down_gently() {
    let weight = "mass = 2\ncentre_of_mass = \"hook\"\nmoment_of_inertia = 0.01";
    let load = "[loads.W]\ntype = \"force\"\nat = \"bracket.hook\"\ncomponents = [0, \"-W\"]\n";
    let text = gallery::find("bracket-on-pole").unwrap().text.replace("massless = true", weight);
    let text = format!("gravity = \"9.81 m/s^2\"\n{}", text.replace(load, ""));
    let model = Model::parse(&text).unwrap().with(&parameters(&[("mu_static", "0.4")])).unwrap();
    let options = SizeOptions::new("x".parse::<Vary>().unwrap(), 1.0).against(Against::Hold { load: None });
    let answer = size(&model, &options).unwrap().answer();
    assert!(answer.contains("; let down gently it holds with a safety factor of 1.6"), "{answer}");
}
