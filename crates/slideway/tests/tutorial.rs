//! The numbers of the book's tutorial: each problem by hand, and the printed answers of textbooks, beside the program's.
#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::limits::rest_limits;
use slideway::report::{Proof, Status};
use slideway::size::SizeReport;
use slideway::template;
use slideway::{
    DriveOptions, HoldOptions, LimitsOptions, Model, Settings, SimulateOptions, SizeOptions, drive, hold,
    limits, simulate, size, solve,
};
use std::path::Path;

/// A model of the tutorial.
fn example(name: &str, values: &[(&str, &str)]) -> Model {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/src/examples").join(name);
    let text = std::fs::read_to_string(path).unwrap();
    Model::parse(&text).unwrap().with(&settings(values)).unwrap_or_else(|faults| panic!("{name}: {faults}"))
}

/// A template with the values of the tutorial.
fn new(name: &str, values: &[(&str, &str)]) -> Model {
    let text = template::find(name).unwrap().model(&settings(values), "mine.toml").unwrap();
    Model::parse(&text).unwrap()
}

fn settings(values: &[(&str, &str)]) -> Settings {
    values.iter().fold(Settings::default(), |settings, (name, value)| settings.parameter(name, *value))
}

/// The effort of the only drive, in the direction of the model (0) or the opposite one (1).
fn effort(model: &Model, direction: usize) -> f64 {
    let report = drive(model, &DriveOptions::default()).unwrap();
    let [solution] = &report.directions[direction].solutions[..] else { panic!("{:?}", report.directions) };
    solution.efforts[0]
}

/// The static friction from which on the load is held however great it is.
fn self_locking_from(model: &Model, load: &str, parameter: &str) -> f64 {
    let report = hold(model, &HoldOptions::default().load(load).vary(parameter)).unwrap();
    report.load.unwrap().threshold.value.unwrap()
}

/// Where the margin against locking is at least 1.
fn moves(model: &Model, range: &str) -> SizeReport {
    size(model, &SizeOptions::new(range.parse().unwrap(), 1.0)).unwrap()
}

/// Compares with a number that follows from a formula.
fn assert_close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found} is not {expected}");
}

/// Compares with a number as it is printed, which was rounded.
fn assert_prints(found: f64, printed: &str) {
    let digits = printed.split_once('.').map_or(0, |(_, digits)| digits.len());
    assert_eq!(format!("{found:.digits$}"), printed);
}

#[test]
fn kitchen_drawer() {
    let drawer = new("drawer", &[("L", "450 mm"), ("a", "200 mm")]);
    assert_close(effort(&drawer, 0), 20.0 / (1.0 - 2.0 * 0.3 * 0.2 / 0.45));
    // Supported over at least 2 mu a.
    assert_close(moves(&drawer, "L=50 mm..450 mm").met[0].from, 0.12);
}

#[test]
fn sliding_door() {
    // The moment of the pull, mu W h, is W b/2.
    assert_close(moves(&example("sliding-door.toml", &[]), "h=0.2 m..5 m").met[0].to, 0.9 / (2.0 * 0.3));
}

#[test]
fn sash_window() {
    // Half of the weight at the right edge: N H = (W/2)(b/2), held by 2 mu_s N.
    assert_close(self_locking_from(&example("sash.toml", &[]), "rest", "mu_s"), 600.0 / 900.0);
    for (mu, holds) in [("0.66", false), ("0.67", true)] {
        let report = hold(&example("sash.toml", &[("mu_s", mu)]), &HoldOptions::default()).unwrap();
        assert_eq!(report.holds, holds, "{mu}");
    }
}

#[test]
fn bar_clamp() {
    let clamp = |x: &str| new("bracket", &[("x", x), ("B", "30 mm"), ("d", "25 mm"), ("mu_static", "0.15")]);
    // x = B/(2 mu_static) = 100 mm
    for (x, held) in [("99 mm", false), ("101 mm", true)] {
        let report = hold(&clamp(x), &HoldOptions::default().load("W")).unwrap();
        assert_eq!(report.load.unwrap().self_locking, held, "{x}");
    }
    assert_close(self_locking_from(&clamp("80 mm"), "W", "mu_static"), 0.03 / (2.0 * 0.08));
}

#[test]
fn camera_slider_and_the_rule_of_two_to_one() {
    let carriage = new("carriage", &[("L", "60 mm"), ("a", "100 mm"), ("mu", "0.25"), ("m", "1.5 kg")]);
    assert_close(effort(&carriage, 0), 0.25 * 1.5 * 9.81);
    // a = L/(2 mu) = 2 L
    assert_close(moves(&carriage, "a=50 mm..300 mm").met[0].to, 0.12);
}

#[test]
fn engine() {
    let engine = new("slider-crank", &[("F", "12 kN"), ("mu", "0.1")]);
    let (phi, mu) = (f64::to_radians(60.0), 0.1);
    let psi = f64::asin(40.0 / 140.0 * phi.sin());
    assert_close(effort(&engine, 0), 12e3 * 0.04 * (phi + psi).sin() / (psi.cos() - mu * psi.sin()));
}

#[test]
fn cylinder() {
    let values = [("e", "150 mm"), ("x", "300 mm"), ("S", "500 N")];
    // 5000 N + 80 N + 500 N (0.1 (150 + 300) + 0.15 * 300)/150
    assert_close(effort(&new("cylinder", &values), 0), 5380.0);
}

#[test]
fn peg_in_a_hole() {
    let peg = |depth: &str| new("peg", &[("l", depth), ("e", "12 mm"), ("mu", "0.3")]);
    // 2 mu e = 7.2 mm
    for (depth, status) in [("7.1 mm", Status::None), ("7.3 mm", Status::One)] {
        let report = solve(&peg(depth)).unwrap();
        assert_eq!((report.status, report.complete), (status, Proof::Proven), "{depth}");
    }
}

/// R. C. Hibbeler, Engineering Mechanics: Statics, chapter 8: a drawer 1.25 m wide and 0.3 m deep, mu = 0.4; it can be pulled
/// by one of two handles that are at most 0.75 m apart.
#[test]
fn drawer_of_hibbeler() {
    let drawer = new("drawer", &[("L", "0.3 m"), ("a", "0.3 m"), ("width", "1.25 m"), ("mu", "0.4")]);
    assert_prints(2.0 * moves(&drawer, "a=0.05 m..0.6 m").met[0].to, "0.75");
}

/// F. P. Beer, E. R. Johnston, Vector Mechanics for Engineers: Statics, chapter 8: spring 0.6 lb, mu_s = 0.40, P = 1.400 lb.
#[test]
fn latch_of_beer_and_johnston() {
    let latch = example("latch.toml", &[]);
    assert_prints(effort(&latch, 0) / 4.448_221_615_260_5, "1.400");
    let steep = example("latch.toml", &[("beta", "60 deg"), ("mu", "0.25")]);
    let expected = 0.6 * 4.448_221_615_260_5 * (f64::to_radians(30.0) + 0.25_f64.atan()).tan();
    assert_close(effort(&steep, 0), expected);
}

/// J. L. Meriam, L. G. Kraige, Engineering Mechanics: Statics, problem 6/7: F = 126.6 N at both ends for x = 75 mm, and
/// x = 86.2 mm at most.
#[test]
fn light_bar_of_meriam() {
    let bar = example("light-bar.toml", &[]);
    let report = hold(&bar, &HoldOptions::default()).unwrap();
    assert!(report.holds);
    let reactions = report.at_rest.expect("it can rest").reactions;
    let friction = |name: &str| {
        let contact = reactions.contacts.iter().find(|contact| contact.name == name).expect("a contact");
        let [least, greatest] =
            [contact.friction_force.least.unwrap(), contact.friction_force.greatest.unwrap()];
        assert_close(greatest, least);
        least
    };
    assert_prints(friction("upper"), "126.6");
    assert_prints(-friction("lower"), "126.6");
    let limits = rest_limits(&bar, &"x=10 mm..150 mm".parse().unwrap(), &HoldOptions::default()).unwrap();
    let [held, slips] = &limits.spans[..] else { panic!("{:?}", limits.spans) };
    assert_eq!((held.holds, slips.holds), (Some(true), Some(false)));
    assert_prints(held.to * 1000.0, "86.2");
    // Rest is told within the tolerance of its linear program, here some 1e-9 of the normal force.
    let end = 0.3 * 0.3 / 1.09_f64.sqrt();
    assert!((held.to / end - 1.0).abs() <= 1e-8, "{} is not {end}", held.to);
}

/// J. E. Shigley, Mechanical Engineering Design, example 8-1: 26.18 N m to raise the load, 9.77 N m to lower it,
/// efficiency 0.311.
#[test]
fn power_screw_of_shigley() {
    let screw = example("power-screw.toml", &[]);
    let radius = 0.015;
    assert_prints(effort(&screw, 0) * radius, "26.18");
    assert_prints(-effort(&screw, 1) * radius, "9.77");
    let without_friction = 6400.0 * 0.008 / (2.0 * std::f64::consts::PI);
    assert_prints(without_friction / (effort(&screw, 0) * radius), "0.311");
}

/// The paradox of a slender rod (P. Painleve, Comptes Rendus 121, 1895): with t = tan(theta), t^2 - 3 mu t + 4 = 0 bounds the
/// inclinations at which it cannot slide. From mu = 4/3 on there are any; for mu = 1.4 they are 55.586 to 69.952 degrees.
#[test]
fn rod_of_painleve() {
    let rod = example("painleve-rod.toml", &[]);
    let report = limits(&rod, &LimitsOptions::new("theta=10 deg..85 deg".parse().unwrap())).unwrap();
    let found: Vec<_> = report.counts.iter().map(|count| (count.solutions, count.from, count.to)).collect();
    let [(1, _, from), (0, locked_from, to), (1, end, _)] = found[..] else { panic!("{found:?}") };
    assert_eq!((from, to), (locked_from, end));
    assert_prints(from.to_degrees(), "55.586");
    assert_prints(to.to_degrees(), "69.952");
    let worst = example("painleve-rod.toml", &[("theta", "atan(2)")]);
    let report = limits(&worst, &LimitsOptions::new("mu=0..2".parse().unwrap())).unwrap();
    assert_close(report.counts[0].to, 4.0 / 3.0);
    assert_eq!(report.counts.iter().map(|count| count.solutions).collect::<Vec<_>>(), [1, 0]);
}

/// The slider-crank of P. Flores, R. Leine, C. Glocker, Modeling and analysis of planar rigid multibody systems with
/// translational clearance joints based on the non-smooth dynamics approach, Multibody System Dynamics 23 (2010), without
/// clearance. The paper prints the rate of the rod at the start, -75 rad/s. Without friction the angular velocity of the
/// crank then follows from the energy.
#[test]
fn slider_crank_of_flores_leine_and_glocker_without_friction() {
    let (r, l, g) = (0.153, 0.306, 9.81);
    let (crank, rod, slider) = (0.038, 0.038, 0.076);
    let (j_crank, j_rod) = (7.4e-5, 5.9e-4);
    // Twice the kinetic energy over the square of the crank's angular velocity.
    let inertia = |phi: f64| {
        let (sin, cos) = phi.sin_cos();
        let psi = f64::asin(r / l * sin);
        let turn = r * cos / (l * psi.cos());
        let [middle, end] = [0.5, 1.0].map(|part| -r * sin - part * l * psi.sin() * turn);
        j_crank
            + crank * r * r / 4.0
            + rod * (middle * middle + (r * cos / 2.0).powi(2))
            + j_rod * turn * turn
            + slider * end * end
    };
    let energy =
        |phi: f64, omega: f64| inertia(phi) * omega * omega / 2.0 + (crank + rod) * g * r / 2.0 * phi.sin();
    let model = example("clearance-crank.toml", &[("mu", "0")]);
    let history = simulate(&model, &SimulateOptions::new(0.1)).unwrap();
    let mut reader = history.reader();
    assert_close(reader.configuration(0.0).unwrap().velocities[1].angular, -75.0);
    for time in [0.01, 0.025, 0.05, 0.08, 0.1] {
        let found = reader.configuration(time).unwrap();
        let (found, expected) = (energy(found.coordinates[0], found.rates[0]), energy(0.0, 150.0));
        assert!((found - expected).abs() <= 1e-7 * expected, "{time}: {found}");
    }
}

/// With its friction, against reference/slider_crank_motion.py.
#[test]
fn slider_crank_of_flores_leine_and_glocker_with_friction() {
    let reference: toml::Table =
        include_str!("../../../reference/clearance-crank-motion.toml").parse().unwrap();
    let model = example("clearance-crank.toml", &[]);
    let history = simulate(&model, &SimulateOptions::new(0.5).tolerance(1e-10)).unwrap();
    let mut reader = history.reader();
    let samples = reference["sample"].as_array().unwrap();
    assert_eq!(samples.len(), 6);
    for sample in samples {
        let [time, phi, omega] = ["time", "phi", "omega"].map(|key| sample[key].as_float().unwrap());
        let found = reader.configuration(time).unwrap();
        let (phi_error, omega_error) = (found.coordinates[0] - phi, found.rates[0] - omega);
        assert!(phi_error.abs() < 1e-6 && omega_error.abs() < 1e-5, "{time}: {phi_error}, {omega_error}");
    }
}
