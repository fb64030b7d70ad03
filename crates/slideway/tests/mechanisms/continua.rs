//! Infinitely many solutions, and solutions that several patterns have, in every question.
//!
//! A carriage on two rigid rails of equal play: rails at y = 0.1 m and -0.1 m, contacts L = 0.08 m apart, the belt pulls
//! with P at y = a = 0.06 m, the load Q = 20 N resists at y = 0. Where two contacts carry N and -N, P = Q + 2 mu N and
//!
//! ```text
//! the left rail alone:     N L = Q y - P (y - a)  with y = 0.1 m      P = (Q + 50 N mu) / (1 + mu)
//! the right rail alone:    N L = P (a - y) + Q y  with y = -0.1 m     P = (Q - 50 N mu) / (1 - 4 mu)
//! one contact of each:     N L = P a, friction couples cancel         P = Q / (1 - 1.5 mu)
//! ```
//!
//! Loads are shared in any mixture of these. The second grows without bound at mu = 1/4; beyond, forces of both rails that
//! hold each other may be added in any amount.
//!
//! Both models were found by an independent review.

use crate::answers;
use slideway::drive::{DriveOptions, DriveReport, drive};
use slideway::limits::{LimitsOptions, limits};
use slideway::map::{ClassMeaning, MapOptions, map};
use slideway::model::{Model, Settings};
use slideway::report::{OpenRange, Report, Status, Style};
use slideway::size::{Against, SizeOptions, size};
use slideway::solve::solve;

const EQUAL_PLAY: &str = include_str!("../findings/equal_play.toml");
const FLOATING: &str = include_str!("../findings/floating_carriage.toml");

fn model(text: &str) -> Model {
    Model::parse(text).unwrap_or_else(|faults| panic!("{faults}"))
}

#[track_caller]
fn assert_close(found: f64, expected: f64) {
    answers::assert_close(found, expected, 1.0, 1e-9);
}

fn with_friction(mu: f64) -> Model {
    model(EQUAL_PLAY).with(&Settings::default().parameter("mu", mu.to_string())).unwrap()
}

/// The efforts of the corners.
fn corners(mu: f64) -> [f64; 3] {
    [(20.0 + 50.0 * mu) / (1.0 + mu), (20.0 - 50.0 * mu) / (1.0 - 4.0 * mu), 20.0 / (1.0 - 1.5 * mu)]
}

fn driven(model: &Model, options: &DriveOptions) -> DriveReport {
    drive(model, options).unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn solve_tells_between_which_values_an_undetermined_share_lies() {
    for mu in [0.0, 0.01, 0.1, 0.2, 0.24] {
        let report = solve(&with_friction(mu)).unwrap();
        assert_eq!(report.status, Status::Continuum, "mu = {mu}");
        let undetermined = report.undetermined.as_ref().unwrap();
        assert_eq!(undetermined.sharing, ["left", "right"]);
        let [belt] = undetermined.efforts.as_slice() else { panic!("one drive") };
        let [from, to] = [belt.from.unwrap(), belt.to.unwrap()];
        assert_close(from, corners(mu)[0]);
        assert_close(to, corners(mu)[1]);
        let left = &undetermined.normal_forces[0];
        assert_eq!((&*left.name, left.from), ("left.front", Some(0.0)));
        assert_close(left.to.unwrap(), 0.75 * corners(mu)[2]);
        // Every load has exactly one solution: not this one.
        assert!(report.margins.is_none());
    }
    let text = solve(&with_friction(0.2)).unwrap().text(Style::PLAIN);
    let answer =
        "How left, right share the load is undetermined: belt 25 to 50 N. Give `stiffness` for one value.";
    assert!(text.contains(answer) && text.contains("Efforts: belt 25 to 50 N."), "{text}");
}

#[test]
fn a_share_beyond_the_friction_at_which_the_rails_hold_each_other_is_without_bound() {
    let report = solve(&with_friction(0.4)).unwrap();
    let [OpenRange { from, to, .. }] = report.undetermined.as_ref().unwrap().efforts.as_slice() else {
        panic!("one drive")
    };
    assert_close(from.unwrap(), corners(0.4)[0]);
    assert_eq!(*to, None);
}

#[test]
fn drive_tells_a_range_of_efforts() {
    let vary = DriveOptions::default().vary(Some("mu=0..0.2".parse().unwrap())).rows(5);
    let report = driven(&with_friction(0.2), &vary);
    let [forwards, _] = report.directions.as_slice() else { panic!("two directions") };
    let range = forwards.range.as_ref().unwrap();
    // P v, and Q / P.
    let [from, to] = range.power.map(Option::unwrap);
    assert_close(from, 2.5);
    assert_close(to, 5.0);
    let [worst, best] = range.efficiency.unwrap();
    assert_close(worst, 0.4);
    assert_close(best, 0.8);
    assert_eq!(
        report.conclusion[0],
        "belt needs 25 to 50 N (20 N without friction), efficiency 40 to 80 %; how left, right share the load is \
         undetermined."
    );
    assert!(!report.text(Style::PLAIN).contains("lock"), "{}", report.text(Style::PLAIN));
    let rows = &report.course.as_ref().unwrap().directions[0].rows;
    assert_eq!(rows.len(), 5);
    for row in rows {
        let [belt] = row.range.as_ref().unwrap().undetermined.efforts.as_slice() else { panic!("one drive") };
        assert_close(belt.from.unwrap(), corners(row.at)[0]);
        assert_close(belt.to.unwrap(), corners(row.at)[1]);
    }
}

#[test]
fn limits_of_a_continuum_have_infinitely_many_solutions_and_its_corners() {
    let options = LimitsOptions::new("mu=0..1".parse().unwrap()).both_directions(true);
    let report = limits(&with_friction(0.2), &options).unwrap();
    assert!(report.counts.iter().all(|count| count.continuum), "{:?}", report.counts);
    let end = |pattern: &str| {
        let mut modes = report.modes.iter().filter(|mode| mode.pattern == pattern && mode.from == Some(0.0));
        modes.next().unwrap_or_else(|| panic!("no {pattern}")).to.unwrap()
    };
    assert_close(end("+-00"), 1.0);
    assert_close(end("00+-"), 0.25);
    assert_close(end("+00-"), 2.0 / 3.0);
    let text = report.text(Style::PLAIN);
    assert!(!text.contains("locks") && text.contains("it can move in both directions"), "{text}");
}

/// P = 40 N at mu = 2/11 in the second mode; 40 N = 20 N + 2 mu N.
#[test]
fn size_keeps_a_limit_in_every_solution_of_a_continuum() {
    let sized = |margin: f64, against: Against, vary: &str| {
        let options = SizeOptions::new(vary.parse().unwrap(), margin).against(against);
        size(&with_friction(0.2), &options).unwrap_or_else(|faults| panic!("{faults}"))
    };
    let effort = sized(40.0, Against::Effort { drive: None }, "mu=0..1");
    let [met] = effort.met.as_slice() else { panic!("{:?}", effort.met) };
    assert_close(met.to, 2.0 / 11.0);
    let force = sized(55.0, Against::NormalForce { contact: None }, "mu=0..1");
    assert_close(force.met[0].to, 2.0 / 11.0);
    let efficiency = sized(0.5, Against::Efficiency, "mu=0..1");
    assert_close(efficiency.met[0].to, 2.0 / 11.0);
    // No friction locks it: the left rail alone always moves.
    let locking = sized(2.0, Against::Locking, "mu=0.1..0.9");
    assert_eq!((locking.met.len(), locking.met[0].from, locking.met[0].to), (1, 0.1, 0.9));
}

/// A carriage without load within its play: nothing acts, and where it is within its play is no state of its own.
#[test]
fn a_floating_carriage_has_one_state_in_every_question() {
    let carriage = model(FLOATING);
    let report = solve(&carriage).unwrap();
    assert_eq!((report.status, report.solutions.len()), (Status::One, 1));
    let found = limits(&carriage, &LimitsOptions::new("mu=0..1".parse().unwrap())).unwrap();
    let numbers: Vec<_> = found.counts.iter().map(|count| (count.solutions, count.continuum)).collect();
    assert_eq!(numbers, [(1, false)]);
    let [mode] = found.modes.as_slice() else { panic!("{:?}", found.modes) };
    // In the words of `solve`: no contact has a side.
    assert_eq!((&mode.joints, &mode.signs), (&report.solutions[0].joints, &report.solutions[0].signs));
    let options = MapOptions::new("mu=0.1..0.5".parse().unwrap(), "play=0.1 mm..0.4 mm".parse().unwrap());
    let drawn = map(&carriage, &options).unwrap();
    let classes: Vec<_> = drawn.classes.iter().map(|class| class.meaning.clone()).collect();
    assert_eq!(classes, [ClassMeaning::Solutions { solutions: 1, preload_gap_states: 0, tipping: 0 }]);
    let driven_carriage = format!(
        "{FLOATING}[drives.push]\ncoordinate = \"x\"\nforce = {{ at = \"carriage.m\", direction = 0 }}\n"
    )
    .replace("centre_of_mass = \"m\"", "centre_of_mass = \"m\"\npoints = [\"m\"]");
    let vary = DriveOptions::default().vary(Some("mu=0..1".parse().unwrap())).rows(3);
    let report = driven(&model(&driven_carriage), &vary);
    let course = &report.course.unwrap().directions[0];
    let words: Vec<&str> = course.modes.iter().map(|mode| mode.words.as_str()).collect();
    assert_eq!((course.rows.len(), words), (3, vec!["upper open; lower open"]));
}
