//! Redundant guides: closed forms, what remains where all but one set of contacts gives way, and models in which
//! nothing is redundant.
//!
//! Derivations, for the drawer of the gallery: its contacts lie at x = L/2 and -L/2 on rails at y_L and y_R, it is
//! pulled at y = a with the force P, and resists with Q at y = 0. Without play the deflection is a tilt theta, so that
//! the contacts of a rail have the normal forces -k theta L/2 and k theta L/2, and, with N_L and N_R their magnitudes,
//! friction 2 mu N_L and 2 mu N_R at the rails:
//!
//! ```text
//! P = Q + 2 mu (N_L + N_R),    (N_L + N_R) L = |a P - 2 mu (y_L N_L + y_R N_R)|,    N_L / N_R = k_L / k_R
//! ```
//!
//! With y_c = (k_L y_L + k_R y_R) / (k_L + k_R) and N = N_L + N_R this is `N L = |a Q + 2 mu (a - y_c) N|`. If `a` and
//! `a - y_c` have the same sign, N grows without bound towards `mu = L / (2 |a - y_c|)`, and there is no solution beyond;
//! otherwise a second solution appears there. Where play lets one rail carry alone, y_c is its y.

use crate::answers::{assert_close, contact, model, only, parameters, report, report_with};
use nalgebra::{matrix, vector};
use rstest::rstest;
use slideway::fault::FaultKind;
use slideway::gallery;
use slideway::limits::{CountLimits, LimitsOptions, limits};
use slideway::model::{Model, Settings};
use slideway::report::{Proof, Solution, SolveReport};
use slideway::solve::solve;

const DRAWER: &str = "drawer-on-two-rails";
/// Its distances (m) and resistance (N).
const L: f64 = 0.4;
const HALF_B: f64 = 0.3;
const Q: f64 = 10.0;
const MU: f64 = 0.3;

/// Both rails without play.
const TIGHT: [(&str, &str); 2] = [("play_left", "0 m"), ("play_right", "0 m")];
const RIGHT_TIGHT: [(&str, &str); 2] = [("play_left", "0.6 mm"), ("play_right", "0.2 mm")];

fn set(model: &Model, lists: &[&[(&str, &str)]]) -> Model {
    model.with(&parameters(&lists.concat())).unwrap_or_else(|faults| panic!("{faults}"))
}

/// The drawer with rigid faces.
fn rigid() -> Model {
    let text = gallery::find(DRAWER).unwrap().text;
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with("stiffness = ")).collect();
    Model::parse(&lines.join("\n")).unwrap()
}

/// Numbers of solutions over the friction coefficient, with the ends of their intervals.
fn counts(model: &Model, greatest_friction: f64) -> Vec<CountLimits> {
    let options = LimitsOptions::new(format!("mu=0.01..{greatest_friction}").parse().unwrap()).effort(0);
    limits(model, &options).unwrap_or_else(|faults| panic!("{faults}")).counts
}

/// Fails unless the number of solutions is one below this friction, and `beyond` above it.
#[track_caller]
fn assert_locks_at(model: &Model, friction: f64, beyond: usize) {
    let counts = counts(model, 1.2 * friction);
    let found: Vec<(f64, usize)> = counts.iter().map(|count| (count.to, count.solutions)).collect();
    let [below, above] = found.as_slice() else { panic!("{found:?}") };
    assert_close(below.0, friction, friction, 1e-9);
    assert_eq!((below.1, above.1), (1, beyond));
}

#[rstest]
// The rails are equally stiff: y_c = 0.
#[case("50 kN/m", "50 kN/m", "0.25 m", 0.8, 0)]
// The stiffer rail is next to the handle: y_c = 0.15.
#[case("90 kN/m", "30 kN/m", "0.25 m", 2.0, 0)]
// It is the other one: y_c = -0.15.
#[case("30 kN/m", "90 kN/m", "0.25 m", 0.5, 0)]
// The handle is between the middle and y_c = 0.15.
#[case("90 kN/m", "30 kN/m", "0.1 m", 4.0, 2)]
// At the other side of the middle.
#[case("90 kN/m", "30 kN/m", "-0.25 m", 0.5, 0)]
fn tight_rails_lock_at_the_mean_of_their_stiffnesses(
    #[case] left: &str,
    #[case] right: &str,
    #[case] handle: &str,
    #[case] friction: f64,
    #[case] beyond: usize,
) {
    let stiffnesses = [("k_left", left), ("k_right", right), ("a", handle)];
    assert_locks_at(&set(&model(DRAWER), &[&TIGHT, &stiffnesses]), friction, beyond);
}

#[test]
fn the_pull_of_tight_rails_has_a_closed_form() {
    let report = report(DRAWER, &TIGHT);
    // N L = a Q + 2 mu a N
    let normal = 0.25 * Q / (L - 2.0 * MU * 0.25);
    let solution = only(&report);
    for name in ["left.front", "right.front", "left.rear", "right.rear"] {
        assert_close(contact(solution, name).normal_force.abs(), normal / 2.0, 1.0, 1e-12);
    }
    assert_close(solution.drives[0].effort, Q + 2.0 * MU * normal, Q, 1e-12);
}

#[test]
fn the_rail_that_carries_alone_decides_if_faces_are_rigid() {
    let rigid = rigid();
    // The right rail: L / (2 (a + B/2)) = 4/11.
    assert_locks_at(&set(&rigid, &[&RIGHT_TIGHT]), L / (2.0 * (0.25 + HALF_B)), 0);
    // The left rail: a - y_L < 0, so that it is a second solution that appears at L / (2 (B/2 - a)).
    assert_locks_at(&rigid, L / (2.0 * (HALF_B - 0.25)), 2);
    let solution = solve(&set(&rigid, &[&RIGHT_TIGHT])).unwrap();
    // N L = (a + B/2) P - (B/2) Q, P = Q + 2 mu N
    let normal = 0.25 * Q / (L - 2.0 * MU * (0.25 + HALF_B));
    let solution = only(&solution);
    assert_eq!(solution.pattern, "00+-");
    assert_close(contact(solution, "right.front").normal_force, normal, 1.0, 1e-12);
    assert_eq!(contact(solution, "left.front").normal_force, 0.0);
}

/// With elastic faces the other rail is pressed before the forces of the tight one have grown without bound: the
/// limits are those of both rails.
#[test]
fn elastic_rails_with_play_lock_where_both_are_pressed() {
    assert_locks_at(&set(&model(DRAWER), &[&RIGHT_TIGHT]), 0.8, 0);
    assert_locks_at(&model(DRAWER), 0.8, 2);
}

fn effort(solution: &Solution) -> f64 {
    solution.drives[0].effort
}

/// Every solution has the pull `P = Q + 2 mu k (eps - delta)^+`: nothing tilts the drawer that is pulled in line with
/// its resistance, and both rear contacts are pressed by the bend of their rails.
#[rstest]
#[case("0 mm", 0.0)]
#[case("0.05 mm", 0.0)]
#[case("0.1 mm", 0.0)]
#[case("0.3 mm", 0.2e-3)]
#[case("1 mm", 0.9e-3)]
#[case("-0.3 mm", 0.2e-3)]
fn rails_that_converge_brake(#[case] bend: &str, #[case] excess: f64) {
    let settings = [("a", "0 m"), ("eps", bend), ("play_right", "0.2 mm")];
    let report = report(DRAWER, &settings);
    assert!(!report.solutions.is_empty());
    for solution in &report.solutions {
        assert_close(effort(solution), Q + 2.0 * MU * 50e3 * excess, Q, 1e-12);
    }
}

/// The self-stress of both rear contacts, and of both front ones, is (1, -1): rigid rails can be assembled as long as
/// `2 eps <= delta_L + delta_R`.
#[test]
fn rigid_rails_that_converge_by_more_than_their_play_cannot_be_assembled() {
    let solved = |bend: &str| solve(&set(&rigid(), &[&[("eps", bend)]]));
    assert_eq!(only(&solved("0.1999 mm").unwrap()).pattern, "+-00");
    // Without a load the drawer floats.
    assert!(solve(&set(&rigid(), &[&[("eps", "0.1 mm"), ("Q", "0 N")]])).is_ok());
    for bend in ["0.2000000001 mm", "1 mm", "-1 mm"] {
        let faults = solved(bend).unwrap_err();
        let kinds: Vec<&FaultKind> = faults.sorted().iter().map(|fault| &fault.kind).collect();
        assert!(
            matches!(kinds.as_slice(), [FaultKind::OutOfLine { contacts }] if contacts == &["left.rear", "right.rear"]),
            "{faults}"
        );
    }
    let options = LimitsOptions::new("eps=0 mm..0.4 mm".parse().unwrap());
    let counts = limits(&rigid(), &options).unwrap().counts;
    let [only] = counts.as_slice() else { panic!("{counts:?}") };
    assert_eq!((only.from, only.solutions), (0.0, 1));
    assert_close(only.to, 2e-4, 1e-4, 1e-9);
}

/// One rail, from the model with two: what is left where the other one gives way.
fn one_rail() -> SolveReport {
    let text = gallery::find(DRAWER).unwrap().text;
    let (before, rest) = text.split_once("[joints.right]").unwrap();
    let (_, after) = rest.split_once("\n\n").unwrap();
    solve(&Model::parse(&format!("{before}{after}")).unwrap()).unwrap()
}

#[test]
fn a_rail_with_much_play_is_as_if_it_were_not_there() {
    let (both, one) = (report(DRAWER, &[("play_right", "20 mm")]), one_rail());
    let (both, one) = (only(&both), only(&one));
    assert_close(effort(both), effort(one), Q, 1e-14);
    for name in ["left.front", "left.rear"] {
        let [found, expected] = [both, one].map(|solution| contact(solution, name).normal_force);
        assert_close(found, expected, 1.0, 1e-14);
    }
}

/// The error is of the first order in the ratio of the stiffnesses.
#[test]
fn a_rail_that_yields_is_as_if_it_were_not_there() {
    let one = effort(only(&one_rail()));
    let errors = ["500 N/m", "5 N/m"].map(|stiffness| {
        let both = report(DRAWER, &[&TIGHT[..], &[("k_right", stiffness)]].concat());
        (effort(only(&both)) - one).abs()
    });
    assert!(errors[0] < 0.02 * Q && errors[0] > 0.0, "{errors:?}");
    assert_close(errors[0] / errors[1], 100.0, 1.0, 0.05);
}

/// In a mechanism without redundancy play and misalignment say nothing, and stiffness what it always said.
#[test]
fn determinate_models_do_not_depend_on_play_or_misalignment() {
    for name in ["drawer", "sleeve-on-arm", "telescopic-boom", "klepp-2002"] {
        let text = gallery::find(name).unwrap().text;
        let with = |keys: &str| {
            let changed = text.replace("\nalong = ", &format!("\n{keys}along = "));
            assert_ne!(changed, text);
            let report = solve(&Model::parse(&changed).unwrap()).unwrap();
            assert_eq!(report.complete, Proof::Proven, "{name}");
            serde_json::to_string(&report).unwrap()
        };
        let given = "stiffness = \"30 kN/m\"\n";
        assert_eq!(
            with(&format!("play = \"1 mm\"\nmisalignment = \"3 mm\"\n{given}")),
            with(given),
            "{name}"
        );
        let moving = "play = \"1 mm\"\nmisalignment = \"-0.2 mm\"\n";
        assert_eq!(with(moving), serde_json::to_string(&solve(&model(name)).unwrap()).unwrap(), "{name}");
    }
}

/// All four shoes of the gate are pressed: those of one height with `k (2 lean z - play)` in all, however the gate tilts.
#[rstest]
#[case("1.3 m", 1.3)]
#[case("1.5 m", 1.5)]
#[case("3 m", 3.0)]
fn posts_that_lean_clamp_the_gate_higher_up(#[case] height: &str, #[case] z: f64) {
    let report = report_with(&model("gate-on-two-posts"), &Settings::default().position("z", height));
    let (lean, play, k, mu, length, weight) = (2e-3, 4e-3, 400e3, 0.25, 1.0, 120.0 * 9.81);
    let pressed = 2.0 * k * (lean * (2.0 * z + length) - play);
    assert_eq!(only(&report).pattern, "--++");
    assert_close(effort(only(&report)), weight + mu * pressed, weight, 1e-12);
}

/// Three pads in line: `d_middle + bow = 5/8 d_front + 3/8 d_rear` with `d = -(delta + f N)` or `delta - f N`, and
/// equilibrium, in which friction acts at the faces, h/2 from the middle.
#[rstest]
#[case("0.8 mm", 0.8e-3)]
#[case("1.5 mm", 1.5e-3)]
fn a_bowed_tube_presses_its_middle_pad(#[case] bow: &str, #[case] bow_in_metres: f64) {
    let report = report("three-pad-telescope", &[("bow", bow)]);
    let (k, delta, mu) = (1e7, 1e-3, 0.12);
    let (load, weight) = (1500.0, 60.0 * 9.81);
    // Magnitudes of front (lower face), rear (upper face), middle (lower face).
    let matrix = matrix![1.0, -1.0, 1.0; 0.4, 0.4, 0.1; -5.0 / 8.0, 3.0 / 8.0, 1.0];
    let moment = 1.6 * load + 0.5 * weight + 0.1 * mu * (load + weight);
    let middle = k * (bow_in_metres - delta + (5.0 / 8.0 - 3.0 / 8.0) * delta);
    let expected = matrix.lu().solve(&vector![load + weight, moment, middle]).unwrap();
    let solution = only(&report);
    for (name, force) in [("front", expected[0]), ("rear", -expected[1]), ("middle", expected[2])] {
        let found = contact(solution, &format!("pads.{name}")).normal_force;
        assert_close(found, force, load, 1e-12);
    }
    assert_close(effort(solution), mu * expected.sum(), load, 1e-12);
}

/// The near rod alone guides the carriage. With `S` the sum of the magnitudes there, `F_c` their difference, and
/// friction at the upper and the lower face of a rod of diameter D:
///
/// ```text
/// S L/2 + mu (S B/2 + F_c D/2) = a P,    P = F_x + mu S
/// ```
#[test]
fn the_carriage_runs_on_the_rod_that_fits() {
    let report = report("carriage-on-two-rods", &[]);
    let (length, distance, diameter, a, mu, along, across) = (0.06, 0.12, 0.016, 0.04, 0.15, 80.0, 30.0);
    let sum = (a * along - mu * across * diameter / 2.0) / (length / 2.0 + mu * (distance / 2.0 - a));
    let solution = only(&report);
    assert_eq!(solution.pattern, "+-00");
    assert_close(contact(solution, "near.front").normal_force, f64::midpoint(sum, across), along, 1e-12);
    assert_close(contact(solution, "near.rear").normal_force, (across - sum) / 2.0, along, 1e-12);
    assert_close(effort(solution), along + mu * sum, along, 1e-12);
}

/// Pulled beside the middle towards the left rail, the right rail alone is the first determinate part to lock, at
/// `mu = L / (2 (a + B/2))`. Below it there is one solution whatever the play, stiffness and misalignment; a little
/// above it none if the right rail is tight and rigid.
#[test]
fn up_to_the_first_part_that_locks_nothing_else_matters() {
    let drawer = model(DRAWER);
    let uniqueness = |a: f64| {
        let a = a.to_string();
        let margins = solve(&set(&drawer, &[&[("a", &a)]])).unwrap().margins;
        margins.and_then(|margins| margins.uniqueness).unwrap()
    };
    for a in [0.15, 0.25, 0.4] {
        assert_close(uniqueness(a) * MU, L / (2.0 * (a + HALF_B)), 1.0, 1e-12);
    }
    let first = L / (2.0 * (0.25 + HALF_B));
    let [below, above] = [0.99 * first, 1.01 * first].map(|mu| mu.to_string());
    let mut counts = [0; 2];
    for seed in 0..60_u64 {
        let digit = |place: u32| (seed.wrapping_mul(6_364_136_223_846_793_005) >> (56 - 6 * place)) % 7;
        let of = |place: u32, unit: &str, scale: f64| format!("{} {unit}", scale * digit(place) as f64);
        let settings = [
            ("mu", below.clone()),
            ("play_left", of(0, "mm", 0.13)),
            ("play_right", of(1, "mm", 0.11)),
            ("k_left", format!("{} kN/m", 1 + 9 * digit(2))),
            ("k_right", format!("{} kN/m", 2 + 7 * digit(3))),
            ("eps", of(4, "mm", 0.07)),
            ("Q", format!("{} N", 4 + 5 * digit(5))),
        ];
        let settings: Vec<(&str, &str)> =
            settings.iter().map(|(name, value)| (*name, value.as_str())).collect();
        let report = solve(&set(&drawer, &[&settings])).unwrap();
        counts[usize::from(report.solutions.len() == 1)] += 1;
    }
    assert_eq!(counts, [0, 60]);
    let tight = [("mu", above.as_str()), ("play_left", "0.6 mm"), ("play_right", "0.2 mm")];
    assert_eq!(solve(&set(&rigid(), &[&tight])).unwrap().solutions.len(), 0);
}
