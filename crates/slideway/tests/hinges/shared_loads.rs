//! Friction in hinges beside guides that share a load: closed forms, and brute force over all signs and directions.

use rstest::rstest;
use serde::Deserialize;
use slideway::report::{CertificateKind, Proof, Status};
use slideway::standstill::{HoldOptions, hold};
use slideway::{LimitsOptions, Model, Settings, limits, solve};

/// A drawer on two rails, pulled at the constant speed of a massless rod that turns on a pin at (L/2, a), where the pull acts
/// on the rod. The pin's couple has the size of `r P`, so that the drawer feels the pull in the line `y = a - r sgn(w)`.
const DRAWER: &str = "\
[parameters]
L = 0.4
B = 0.6
a = 0.25
mu = 0.3
r = 0.01
play_left = 2e-4
play_right = 6e-4
k = 5e4
Q = 10
w = 1
[points]
middle = [0, 0]
handle = [\"L/2\", \"a\"]
left_rail = [0, \"B/2\"]
right_rail = [0, \"-B/2\"]
end = [1, \"a\"]
[bodies.drawer]
points = [\"middle\", \"handle\", \"left_rail\", \"right_rail\"]
mass = 8
moment_of_inertia = 1
centre_of_mass = \"middle\"
[bodies.rod]
points = [\"handle\", \"end\"]
massless = true
[joints.pin]
type = \"hinge\"
between = [\"rod.handle\", \"drawer.handle\"]
friction_radius = \"r\"
[joints.left]
type = \"block_slider\"
block = \"drawer\"
at = \"left_rail\"
along = \"0 deg\"
length = \"L\"
mu = \"mu\"
play = \"play_left\"
stiffness = \"k\"
[loads.resistance]
type = \"force\"
at = \"drawer.middle\"
components = [\"-Q\", 0]
[coordinates.x]
slide = \"left\"
rate = 0.3
[coordinates.q]
rotation = \"rod\"
rate = \"w\"
[drives.pull]
coordinate = \"x\"
acceleration = 0
force = { at = \"rod.handle\", direction = \"0 deg\" }
[drives.turn]
coordinate = \"q\"
acceleration = 0
torque = { body = \"rod\" }
";

const RIGHT_RAIL: &str = "\
[joints.right]
type = \"block_slider\"
block = \"drawer\"
at = \"right_rail\"
along = \"0 deg\"
length = \"L\"
mu = \"mu\"
play = \"play_right\"
stiffness = \"k\"
";

fn with(model: &Model, values: &[(&str, &str)]) -> Model {
    let settings = values.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, *value));
    model.with(&settings).unwrap()
}

fn pull(model: &Model) -> (f64, Vec<f64>) {
    let report = solve(model).unwrap();
    assert_eq!((report.status, report.complete), (Status::One, Proof::Proven), "{:?}", report.open);
    let [solution] = &report.solutions[..] else { panic!("{} solutions", report.solutions.len()) };
    assert_eq!(solution.certificate, CertificateKind::Proven);
    assert!(solution.residual < 1e-12, "{}", solution.residual);
    (solution.drives[0].effort, solution.contacts.iter().map(|contact| contact.normal_force).collect())
}

/// The left rail carries alone: `P = Q + 2 mu N`, and about it `N L = Q B/2 - P (B/2 - a_e)` with `a_e = a - r sgn(w)`. Both
/// carry where the right one is tight: `2 mu/L` times the moments `P a_e + mu B D` of all, with the difference
/// `D = k (play_left - play_right)/2` of the forces on both.
#[rstest]
fn a_pull_on_a_turning_rod_acts_beside_its_pin(#[values("1", "-1")] sense: &str) {
    let drawer = with(&Model::parse(&format!("{DRAWER}{RIGHT_RAIL}")).unwrap(), &[("w", sense)]);
    let arm = 0.25 - 0.01 * sense.parse::<f64>().unwrap();
    let (found, normal) = pull(&drawer);
    let expected = 10.0 * (1.0 + 0.6 * 0.3 / 0.4) / (1.0 + 0.6 * (0.3 - arm) / 0.4);
    assert!((found - expected).abs() < 1e-11 * expected, "{found} instead of {expected}");
    assert_eq!(normal[2..], [0.0, 0.0]);
    let tight = [("play_left", "6e-4"), ("play_right", "2e-4"), ("mu", "0.6")];
    let (found, normal) = pull(&with(&drawer, &tight));
    let expected = (10.0 + 2.0 * 0.6 / 0.4 * 0.6 * 0.6 * 10.0) / (1.0 - 1.2 * arm / 0.4);
    assert!((found - expected).abs() < 1e-11 * expected, "{found} instead of {expected}");
    assert!((normal[2] - normal[0] - 10.0).abs() < 1e-9, "{normal:?}");
}

/// Where both rails carry, the pull has no bound towards `mu = L/(2 a_e)`: beyond it the drawer with a tight right rail
/// jams.
#[rstest]
fn the_friction_circle_of_the_handle_moves_the_locking_limit(#[values("1", "-1")] sense: &str) {
    let tight = [("play_left", "6e-4"), ("play_right", "2e-4"), ("w", sense)];
    let drawer = with(&Model::parse(&format!("{DRAWER}{RIGHT_RAIL}")).unwrap(), &tight);
    let report = limits(&drawer, &LimitsOptions::new("mu=0..1.2".parse().unwrap())).unwrap();
    let expected = 0.4 / (2.0 * (0.25 - 0.01 * sense.parse::<f64>().unwrap()));
    let last = report.counts.last().unwrap();
    assert_eq!((last.solutions, last.preload_gap_states), (0, 0));
    assert!((last.from - expected).abs() < 1e-9, "{} instead of {expected}", last.from);
    assert!(report.counts.iter().rev().skip(1).all(|count| count.solutions == 1), "{:?}", report.counts);
}

/// A rail pressed by `N_0 = k |play|` on both faces: while both touch its friction is `2 mu N_0`, whatever the moments; beyond
/// that it is that of one rail.
#[test]
fn a_press_fit_beside_a_rubbing_pin() {
    let drawer = with(&Model::parse(DRAWER).unwrap(), &[("play_left", "-2e-4")]);
    let (found, normal) = pull(&drawer);
    assert!((found - 16.0).abs() < 1e-11, "{found}");
    // (Q B/2 - P (B/2 - a_e)) / L, shared by both faces of the front.
    let force = (3.0 - 16.0 * 0.06) / 0.4;
    assert!((normal[0] + normal[2] - force).abs() < 1e-11, "{normal:?}");
    let (found, normal) = pull(&with(&drawer, &[("Q", "100")]));
    let expected = 100.0 * (1.0 + 0.45) / (1.0 + 1.5 * 0.06);
    assert!((found - expected).abs() < 1e-10, "{found} instead of {expected}");
    assert!(normal.contains(&0.0));
}

#[derive(Deserialize)]
struct File {
    case: Vec<Case>,
}

/// A carriage or a trammel of `reference/redundant_hinges.py`.
#[derive(Deserialize)]
struct Case {
    kind: String,
    model: String,
    solutions: Vec<Expected>,
}

#[derive(Deserialize)]
struct Expected {
    /// Of the carriage; of a trammel the torque of its drive.
    acceleration: f64,
    /// On the pendulums; on the bar and the crank.
    #[serde(rename = "R")]
    hinges: Vec<[f64; 2]>,
}

/// All solutions of random carriages with pendulums, and of trammels whose self-stress passes through both pins of a crank,
/// are those of a brute force over all signs and directions, and proven to be all.
#[test]
fn random_redundant_mechanisms_have_the_solutions_of_a_brute_force() {
    let text = include_str!("../../../../reference/redundant-hinges.toml");
    let cases = toml::from_str::<File>(text).unwrap().case;
    assert!(cases.iter().any(|case| case.solutions.len() > 1));
    for (index, Case { kind, model, solutions }) in cases.iter().enumerate() {
        let report = solve(&Model::parse(model).unwrap()).unwrap();
        assert_eq!(report.complete, Proof::Proven, "{index} ({kind}): {:?}", report.open);
        assert_eq!(report.solutions.len(), solutions.len(), "{index} ({kind})");
        for expected in solutions {
            let size =
                expected.hinges.as_flattened().iter().fold(1.0_f64, |most, value| most.max(value.abs()));
            let is_same = |found: &slideway::report::Solution| {
                let carriage = found.bodies.iter().find(|body| body.name == "carriage").unwrap();
                let value = found.drives.first().map_or(carriage.acceleration[0], |drive| drive.effort);
                let forces = found.hinges.iter().map(|hinge| hinge.force);
                let differs = forces.zip(&expected.hinges).any(|(found, expected)| {
                    found.iter().zip(expected).any(|(one, other)| (one - other).abs() > 1e-6 * size)
                });
                !differs && (value - expected.acceleration).abs() <= 1e-6 * size
            };
            assert!(report.solutions.iter().any(is_same), "{index} ({kind})");
        }
    }
}

/// The accelerations of all coordinates from rest, of all ways to begin in which each accelerates.
fn from_rest(model: &Model) -> Vec<Vec<f64>> {
    let report = hold(model, &HoldOptions::default()).unwrap();
    let accelerations = report.releases.iter().map(|release| {
        release
            .coordinates
            .iter()
            .map(|coordinate| coordinate.acceleration.least.unwrap_or_default())
            .collect()
    });
    accelerations.filter(|all: &Vec<f64>| all.iter().all(|value| value.abs() > 1e-9)).collect()
}

/// The same from all solutions at very small rates in which all accelerations have the sense of their rates.
fn from_small_rates(model: &Model) -> Vec<Vec<f64>> {
    let names: Vec<String> = model.coordinates.iter().map(|coordinate| coordinate.name.to_string()).collect();
    let mut found = Vec::new();
    for signs in 0..1_usize << names.len() {
        let rate = |index: usize| if signs >> index & 1 == 1 { -1e-7 } else { 1e-7 };
        let rates = names.iter().enumerate();
        let settings = rates.fold(Settings::default(), |all, (index, name)| all.rate(name, rate(index)));
        for solution in solve(&model.with(&settings).unwrap()).unwrap().solutions {
            let all: Vec<f64> =
                solution.coordinates.iter().map(|coordinate| coordinate.acceleration).collect();
            if all.iter().enumerate().all(|(index, acceleration)| acceleration * rate(index) > 0.0) {
                found.push(all);
            }
        }
    }
    found
}

/// Carriages on redundant rails begin to move as `solve` finds at very small rates: the forces of the pins of their
/// pendulums are those of rails that share their load.
#[test]
fn redundant_carriages_with_rubbing_pendulums_begin_to_move_as_solved_at_small_rates() {
    let text = include_str!("../../../../reference/redundant-hinges.toml");
    let mut moved = 0;
    for (index, Case { kind, model, .. }) in toml::from_str::<File>(text).unwrap().case.iter().enumerate() {
        // Beside each other on the carriage the pendulums turn as their coordinates do.
        if ["trammel", "rigid"].contains(&kind.as_str()) || model.contains("\"bar0.T0\"]") {
            continue;
        }
        let model = Model::parse(model).unwrap();
        let [found, expected] = [from_rest(&model), from_small_rates(&model)];
        assert_eq!(found.len(), expected.len(), "{index}: {found:?} instead of {expected:?}");
        for expected in &expected {
            let is_same = |found: &Vec<f64>| {
                let mut pairs = found.iter().zip(expected);
                pairs.all(|(found, expected)| (found - expected).abs() <= 1e-6 * expected.abs())
            };
            assert!(found.iter().any(is_same), "{index}: {found:?} instead of {expected:?}");
        }
        moved += found.len();
    }
    assert!(moved > 1, "{moved}");
}
