//! What answers say of contacts that may lift off: nothing that another answer on the same state denies.

use crate::answers::{parameters, report};
use slideway::check;
use slideway::configuration::Configuration;
use slideway::gallery;
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::map::{ColourBy, MapOptions, map};
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::report::{Report, SpeedChange};
use slideway::solve::{locking, solve};
use slideway::{HoldOptions, hold};

/// The box on an incline, at rest.
fn box_at_rest(list: &[(&str, &str)]) -> Model {
    let text = gallery::find("box-on-incline").unwrap().text.replace("rate = \"-1 m/s\"", "");
    Model::parse(&text).unwrap().with(&parameters(list)).unwrap()
}

/// It stays, slides or tips as `hold` says: sliding from `tan(slope) = mu` on, tipping from `tan(slope) = b/h` on.
#[test]
fn what_starts_at_rest_starts_in_all_answers() {
    let speed = |list: &[(&str, &str)]| {
        let report = solve(&box_at_rest(list)).unwrap();
        report.solutions[0].coordinates[0].speed
    };
    assert_eq!(speed(&[]), Some(SpeedChange::StaysAtRest));
    assert_eq!(speed(&[("mu", "0.2")]), Some(SpeedChange::StartsBackwards));
    // Over the corner that sticks: its coordinate stands still.
    assert_eq!(speed(&[("b", "100 mm")]), None);
    let range = [("b", "50 mm", "300 mm"), ("slope", "1 deg", "40 deg")];
    let [x, y] = range.map(|(name, from, to)| Vary::between(name, from, to));
    let options = MapOptions::new(x, y).size(16, 16).colour_by(ColourBy::Motion);
    let found = map(&box_at_rest(&[]), &options).unwrap();
    let words = found.answer();
    assert!(words.contains("it tips") && !words.contains("stays at rest"), "{words}");
}

/// At `tan(slope) = b/h` the box begins to tip: nothing lies between both states but what rounding leaves open.
#[test]
fn ranges_at_rest_have_a_width() {
    let options = LimitsOptions::new(Vary::between("slope", "0 deg", "40 deg"));
    let found = limits(&box_at_rest(&[]), &options).unwrap();
    let ends: Vec<[f64; 2]> = found.counts.iter().map(|range| [range.from, range.to]).collect();
    let tips = 0.5_f64.atan();
    let [[_, one], [other, _]] = ends[..] else { panic!("{ends:?}") };
    assert!((one - tips).abs() < 1e-7 && (other - tips).abs() < 1e-7, "{ends:?}");
}

/// One of both states of Painlevé's rod is the threshold to a jam.
#[test]
fn the_headline_counts_what_is_taken() {
    let answer = report("rod-on-floor", &[]).answer();
    assert!(answer.contains("Another solution is unstable: a real mechanism leaves it."), "{answer}");
}

/// The tip of the rod locks by itself at `mu = 4/3`, where its column vanishes: a normal force, and `mu` times it.
#[test]
fn a_single_contact_that_locks_has_its_forces() {
    let model = Model::parse(gallery::find("rod-on-floor").unwrap().text).unwrap();
    let model = model.with(&parameters(&[("turning", "0")])).unwrap();
    let mechanism = Mechanism::new(&model).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let found = locking(&solve(&model).unwrap(), &mechanism, &configuration).unwrap();
    assert_eq!(found.normal_forces, [1.0]);
    assert!((found.friction_forces[0] - 4.0 / 3.0).abs() < 1e-12, "{:?}", found.friction_forces);
}

/// What is apart has no state, and does not stick.
#[test]
fn what_is_apart_is_told_of_no_state() {
    let model = Model::parse(gallery::find("ladder").unwrap().text).unwrap();
    let slips =
        hold(&model.with(&parameters(&[("climbed", "1")])).unwrap(), &HoldOptions::default()).unwrap();
    let names: Vec<&str> = slips.releases[0].joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(names, ["foot", "head"]);
    let answer = check(&model).unwrap().answer();
    assert_eq!(answer, "Ready for: solve, limits, size, sweep, map, hold, simulate.");
}
