//! Contacts that may lift off, while they slide: `reference/one-sided.toml`, closed forms, random systems against every pattern of
//! states in descriptor form, other questions, and what is refused.

use crate::answers::{assert_close, contact, mode, only, parameters, report_on, report_with, try_report_on};
use crate::one_sided_systems::{Contact, State, System, many, random};
use proptest::collection::vec;
use proptest::prelude::*;
use rstest::rstest;
use serde::Deserialize;
use slideway::check::check;
use slideway::drawing::Drawing;
use slideway::drive::{DriveOptions, drive};
use slideway::fault::{FaultKind, Faults};
use slideway::ids::{ContactId, Frame};
use slideway::limits::{LimitsOptions, Quantity, limits, limits_with_curves};
use slideway::map::{MapOptions, map};
use slideway::model::{Model, Settings};
use slideway::report::{Proof, Solution, SolveReport, Status, Verdict};
use slideway::standstill::{HoldOptions, hold};
use slideway::sweep::{Rows, Sweep, SweepOptions};
use std::ops::ControlFlow;

pub(crate) const REFERENCE: &str = include_str!("../../../../reference/one-sided.toml");
const ROD: &str = include_str!("../../models/rod-on-floor.toml");
pub(crate) const GRAVITY: f64 = 9.81;

#[derive(Deserialize)]
pub(crate) struct Reference {
    pub(crate) case: Vec<Case>,
}

#[derive(Deserialize)]
pub(crate) struct Case {
    pub(crate) name: String,
    #[serde(flatten)]
    pub(crate) system: System,
    states: Vec<Expected>,
}

#[derive(Deserialize)]
struct Expected {
    #[serde(rename = "N")]
    normal: Vec<f64>,
    gap: Vec<f64>,
    #[serde(rename = "N_bi", default)]
    bilateral: Vec<f64>,
    a: Vec<f64>,
    #[serde(rename = "P", default)]
    efforts: Vec<f64>,
    p: f64,
}

impl Expected {
    /// With its forces in the order of the contacts of a system.
    fn state(&self, system: &System) -> State {
        let (mut loose, mut bilateral, mut gaps) =
            (self.normal.iter(), self.bilateral.iter(), self.gap.iter());
        let (mut normal, mut gap) = (Vec::new(), Vec::new());
        for contact in &system.contacts {
            normal.push(*if contact.opens() { loose.next() } else { bilateral.next() }.unwrap());
            gap.push(if contact.opens() { *gaps.next().unwrap() } else { 0.0 });
        }
        State {
            normal,
            gap,
            accelerations: self.a.clone(),
            efforts: self.efforts.clone(),
            oriented: self.p,
            condition: f64::NAN,
        }
    }
}

fn rod(list: &[(&str, &str)]) -> Model {
    Model::parse(ROD).unwrap().with(&parameters(list)).unwrap()
}

pub(crate) fn painleve(list: &[(&str, &str)]) -> SolveReport {
    report_with(&rod(list), &Settings::default())
}

pub(crate) fn gap(solution: &Solution, contact_name: &str) -> f64 {
    contact(solution, contact_name).gap_acceleration.unwrap_or(0.0)
}

/// Whether a solution is this state, to a part of the greatest force and acceleration.
fn is(solution: &Solution, system: &System, state: &State, tolerance: f64) -> bool {
    let near = |found: Vec<f64>, expected: &[f64]| {
        let size = expected.iter().map(|value| value.abs()).fold(1.0, f64::max);
        found.len() == expected.len()
            && found.iter().zip(expected).all(|(found, value)| (found - value).abs() <= tolerance * size)
    };
    let contacts = || system.contacts.iter().map(|one| contact(solution, &one.name));
    let bodies = solution.bodies.iter();
    near(contacts().map(|contact| contact.normal_force).collect(), &state.normal)
        && near(contacts().map(|contact| contact.gap_acceleration.unwrap_or(0.0)).collect(), &state.gap)
        && near(
            bodies
                .flat_map(|body| [body.acceleration[0], body.acceleration[1], body.angular_acceleration])
                .collect(),
            &state.accelerations,
        )
        && near(solution.drives.iter().map(|drive| drive.effort).collect(), &state.efforts)
        && near(vec![solution.oriented_determinant], &[state.oriented])
}

/// Holds a report to be the complete list of these states.
pub(crate) fn assert_states(
    report: &SolveReport,
    system: &System,
    states: &[State],
    tolerance: f64,
    name: &str,
) {
    assert_eq!(report.complete, Proof::Proven, "{name}: {:?}", report.open);
    assert_eq!(report.solutions.len(), states.len(), "{name}\n{}", system.text());
    for state in states {
        let found: Vec<&Solution> =
            report.solutions.iter().filter(|solution| is(solution, system, state, tolerance)).collect();
        assert_eq!(found.len(), 1, "{name}: {state:?} in {:#?}\n{}", report.solutions, system.text());
        let solution = found[0];
        let most = system.rounding(state.condition);
        assert!(solution.residual < most, "{name}: {} {most}\n{}", solution.residual, system.text());
        for (k, one) in system.contacts.iter().enumerate() {
            let found = contact(solution, &one.name);
            assert_eq!(found.gap_acceleration.is_some(), state.gap[k] != 0.0, "{name}: {}", one.name);
            if state.gap[k] != 0.0 {
                assert_eq!((found.normal_force, found.friction_force, found.side), (0.0, 0.0, -1), "{name}");
            }
        }
        // An odd number of negative eigenvalues (theory of one-sided contacts, section 7).
        if state.oriented < 0.0 {
            let verdict = solution.attainability.verdict;
            assert!(matches!(verdict, Verdict::Unattainable | Verdict::Undecided), "{name}: {verdict:?}");
        }
        let may_open = system.contacts.iter().any(Contact::opens);
        assert!(!may_open || solution.attainability.separates.is_none(), "{name}");
    }
}

#[test]
fn the_reference_has_these_states() {
    let Reference { case } = toml::from_str(REFERENCE).unwrap();
    assert_eq!(case.len(), 12);
    for Case { name, system, states } in case {
        let system = system.with_frames();
        let report = report_on(&system.text());
        let brute = system.states().unwrap();
        assert_eq!(brute.len(), states.len(), "{name}: of the descriptor form");
        let beside = |state: &State, other: &State| {
            let distance = |(a, b): (&f64, &f64)| (a - b).abs();
            state.normal.iter().zip(&other.normal).map(distance).fold(0.0, f64::max)
        };
        let states: Vec<State> = states
            .iter()
            .map(|state| {
                let mut state = state.state(&system);
                let other = brute
                    .iter()
                    .min_by(|one, other| beside(&state, one).total_cmp(&beside(&state, other)))
                    .unwrap();
                assert!(beside(&state, other) < 1e-6, "{name}");
                state.condition = other.condition;
                // What belongs to the moving frames is not in the reference.
                state.accelerations.extend(&other.accelerations[state.accelerations.len()..]);
                state.efforts.extend(&other.efforts[state.efforts.len()..]);
                state
            })
            .collect();
        assert_states(&report, &system, &states, 1e-8, &name);
    }
}

proptest! {
    #![proptest_config(many(400))]
    /// One or two bodies with two to four contacts, of which most may lift off: none, one and several states.
    #[test]
    fn random_systems_have_the_states_of_the_descriptor_form(
        numbers in vec(-1.0..1.0_f64, 97),
        two in any::<bool>(),
        hinged in any::<bool>(),
        driven in any::<bool>(),
        more in 0..3_usize,
    ) {
        let (bodies, contacts) = if two { (2, 2 + more) } else { (1, 1 + more.min(1)) };
        let Some(system) = random(&numbers, bodies, contacts, [hinged, driven]) else { return Ok(()) };
        let rows = system.rows_with_drives();
        let values = nalgebra::DMatrix::from_columns(&rows).singular_values();
        prop_assume!(system.joint_rows().len() < 3 * bodies && rows.len() <= 3 * bodies);
        prop_assume!(values.min() > 0.05 * values.max());
        prop_assume!(system.contacts.iter().all(|contact| system.sliding_velocity(contact).abs() > 1e-3));
        let states = system.states();
        prop_assume!(states.is_some());
        let states = states.unwrap_or_default();
        let report = report_on(&system.text());
        prop_assert_eq!(&report.complete, &Proof::Proven, "{}", system.text());
        assert_states(&report, &system, &states, 1e-8, "random");
    }
}

/// `p = 1 + 3 cos^2 - 3 mu sin cos` over its value without friction, and `mu_c = (4 + t^2)/(3 t)`.
#[rstest]
#[case(0.5)]
#[case(2.0)]
#[case(3.0)]
fn the_rod_has_the_determinant_and_the_critical_friction_of_the_closed_form(#[case] tan: f64) {
    let lean = format!("atan({tan})");
    let critical = (4.0 + tan * tan) / (3.0 * tan);
    let (sin, cos) = (tan.atan().sin(), tan.atan().cos());
    let report = painleve(&[("mu", "0.3"), ("turning", "0"), ("lean", &lean)]);
    let solution = only(&report);
    let smooth = 1.0 + 3.0 * cos * cos;
    assert_close(solution.oriented_determinant, 1.0 - 0.3 * 3.0 * sin * cos / smooth, 1.0, 1e-12);
    assert_eq!(solution.attainability.verdict, Verdict::Attainable);
    // One state up to it, none above it; with much rotation one, then two.
    for (turning, above) in [("0", 0), ("20 rad/s", 2)] {
        let model = rod(&[("turning", turning), ("lean", &lean)]);
        let report = limits(&model, &LimitsOptions::new("mu=0..4".parse().unwrap())).unwrap();
        let counts: Vec<usize> = report.counts.iter().map(|count| count.solutions).collect();
        assert_eq!(counts, [1, above], "{turning}");
        assert_close(report.counts[0].to, critical, 1.0, 1e-9);
    }
}

#[test]
fn a_rod_that_turns_fast_opens_or_stays_as_a_threshold() {
    let report = painleve(&[]);
    assert_eq!((report.status, report.complete), (Status::Several, Proof::Proven));
    let opens = report.solutions.iter().find(|solution| solution.pattern == "-").unwrap();
    let closed = report.solutions.iter().find(|solution| solution.pattern == "+").unwrap();
    // omega^2 l sin - g
    let sin = 2.0 / 5.0_f64.sqrt();
    assert_close(gap(opens, "tip"), 36.0 * 0.5 * sin - GRAVITY, 1.0, 1e-12);
    assert_eq!(mode(opens, "tip"), "lifts off");
    assert_eq!(mode(closed, "tip"), "closed");
    assert_eq!(opens.attainability.verdict, Verdict::Attainable);
    assert_eq!(closed.attainability.verdict, Verdict::Unattainable);
    assert_close(opens.oriented_determinant, 1.0, 1.0, 1e-12);
    assert!(closed.oriented_determinant < 0.0);
    let json = serde_json::to_value(&report).unwrap();
    assert!(
        json["solutions"][0]["contacts"][0].get("gap_acceleration").is_some()
            ^ (report.solutions[0].pattern == "+")
    );
    assert!(report.csv().contains("gap_acceleration"));
}

pub(crate) const BOX: &str = r#"
gravity = "9.81 m/s^2"
[parameters]
b = "200 mm"
h = "400 mm"
slope = "20 deg"
mu = 0.3
[points]
M = [0, 0]
C = ["-h/2*sin(slope)", "h/2*cos(slope)"]
from = ["-1 m*cos(slope)", "-1 m*sin(slope)"]
to = ["1 m*cos(slope)", "1 m*sin(slope)"]
[bodies.box]
points = ["M", "C"]
mass = "1 kg"
centre_of_mass = "C"
shape = { rectangle = ["b", "h"] }
[joints.base]
type = "block_on_face"
block = "box"
at = "M"
along = "slope"
length = "b"
mu = "mu"
[coordinates.x]
slide = "base"
rate = "-1 m/s"
"#;

fn on_incline(list: &[(&str, &str)]) -> SolveReport {
    report_with(&Model::parse(BOX).unwrap(), &parameters(list))
}

/// `N = m g cos(beta)/2 (1 -+ mu h/b)` up to `mu = b/h`; beyond it the upper corner lifts off, and with it
/// `h/2 (N mu) - b/2 N = J alpha`, `N = m g cos(beta) + m b alpha/2`.
#[test]
fn a_box_slides_flat_or_tips() {
    let (cos, weight) = (20_f64.to_radians().cos(), GRAVITY);
    let report = on_incline(&[]);
    let solution = only(&report);
    for (name, sign) in [("base.front", -1.0), ("base.rear", 1.0)] {
        let expected = weight * cos / 2.0 * (1.0 + sign * 0.3 * 0.4 / 0.2);
        assert_close(contact(solution, name).normal_force, expected, 1.0, 1e-12);
    }
    assert_eq!(mode(solution, "base"), "closed");
    // The margin of friction: mu = b/h, where the upper corner opens.
    let margin = solution.margin.as_ref().unwrap();
    assert_close(margin.factor.unwrap() * 0.3, 0.5, 1.0, 1e-9);
    assert_eq!(margin.contacts, ["base.front"]);

    let report = on_incline(&[("mu", "0.6")]);
    let solution = only(&report);
    let rear = contact(solution, "base.rear").normal_force;
    let inertia = (0.04 + 0.16) / 12.0;
    let turning = solution.bodies[0].angular_acceleration;
    assert_close(rear * (0.2 * 0.6 - 0.1), inertia * turning, 1.0, 1e-12);
    assert_close(rear, weight * cos + 0.1 * turning, 1.0, 1e-12);
    assert_close(gap(solution, "base.front"), 0.2 * turning, 1.0, 1e-12);
    assert_eq!(mode(solution, "base"), "on its left corner: it tips");
    assert_eq!(report.complete, Proof::Proven);
}

/// Two corners on one line are the corners of a block.
#[test]
fn two_corners_are_a_block() {
    let corner = |name: &str, sign: &str| {
        format!(
            "[joints.{name}]\ntype = \"corner_on_face\"\nblock = \"box\"\nat = [\"{sign}b/2*cos(slope)\", \"{sign}b/2*sin(slope)\"]\n\
             face = [\"from\", \"to\"]\nmu = \"mu\"\n"
        )
    };
    let block = BOX.find("[joints.base]").unwrap()..BOX.find("[coordinates.x]").unwrap();
    let corners = [
        BOX[..block.start].to_owned(),
        corner("front", ""),
        corner("rear", "-"),
        BOX[block.end..].replace("\"base\"", "\"front\""),
    ];
    let corners = Model::parse(&corners.concat()).unwrap();
    for mu in ["0.3", "0.6"] {
        let (one, other) = (on_incline(&[("mu", mu)]), report_with(&corners, &parameters(&[("mu", mu)])));
        let (one, other) = (only(&one), only(&other));
        assert_eq!(one.pattern, other.pattern);
        for (corner, of_block) in [("front", "base.front"), ("rear", "base.rear")] {
            let [a, b] = [contact(other, corner), contact(one, of_block)];
            assert_close(a.normal_force, b.normal_force, 1.0, 1e-12);
            assert_close(a.gap_acceleration.unwrap_or(0.0), b.gap_acceleration.unwrap_or(0.0), 1.0, 1e-12);
        }
    }
}

/// Sweeps have the states of `solve`, with the accelerations of gaps; with attainability by another way.
#[rstest]
#[case(false)]
#[case(true)]
fn sweeps_have_the_states_of_solve(#[case] attainability: bool) {
    let model = rod(&[]);
    let axes = ["mu=0..2.1:7", "turning=0..10:5"].map(|axis| axis.parse().unwrap());
    let sweep = Sweep::new(&model, &SweepOptions::grid(axes).attainability(attainability)).unwrap();
    let mut state = sweep.start();
    let mut all: Vec<Rows> = Vec::new();
    sweep.run(&mut state, &Rows::clone, &mut |rows, _| {
        all.extend(rows);
        ControlFlow::Continue(())
    });
    let column = |name: &str| sweep.columns().iter().position(|column| column.name == name).unwrap();
    let (normal, acceleration) = (column("normal_force.tip"), column("gap_acceleration.tip"));
    let (x, friction) = (column("acceleration.x"), column("friction_force.tip"));
    let mut patterns = Vec::new();
    for (rows, row) in all.iter().flat_map(|rows| (0..rows.len()).map(move |row| (rows, row))) {
        let numbers = rows.numbers(row);
        let settings = Settings::default().parameter("mu", numbers[0]).parameter("turning", numbers[1]);
        let report = report_with(&model, &settings);
        assert_eq!(rows.heads[row].solutions as usize, report.solutions.len());
        let pattern = String::from_utf8(rows.pattern(row).to_vec()).unwrap();
        let Some(solution) = report.solutions.iter().find(|solution| solution.pattern == pattern) else {
            assert!(report.solutions.is_empty(), "{pattern}");
            continue;
        };
        let tip = contact(solution, "tip");
        assert_close(numbers[normal], tip.normal_force, 1.0, 1e-9);
        assert_close(numbers[friction], tip.friction_force, 1.0, 1e-9);
        assert_close(numbers[acceleration], tip.gap_acceleration.unwrap_or(0.0), 1.0, 1e-9);
        assert_close(numbers[x], solution.coordinates[0].acceleration, 1.0, 1e-9);
        if attainability {
            assert_eq!(rows.heads[row].verdict, solution.attainability.verdict);
        }
        patterns.push(pattern);
    }
    assert!(patterns.contains(&"+".to_owned()) && patterns.contains(&"-".to_owned()));
}

#[test]
fn maps_and_curves_know_them() {
    let model = rod(&[]);
    let axes = ["mu=0..2", "turning=0..10"].map(|axis| axis.parse().unwrap());
    let [mu, turning] = axes;
    let map = map(&model, &MapOptions::new(mu, turning).size(20, 20)).unwrap();
    assert_eq!(map.classes.len(), 3, "none, one, two: {:?}", map.classes);
    let options = LimitsOptions::new("mu=0..2".parse().unwrap());
    let (_, curves) = limits_with_curves(&model, &options, Quantity::NormalForce).unwrap();
    let verdict = |pattern: usize| curves.forwards[pattern].points.iter().map(|point| point.verdict);
    let all: Vec<Verdict> = (0..curves.forwards.len()).flat_map(verdict).collect();
    assert!(all.contains(&Verdict::Attainable) && all.contains(&Verdict::Unattainable));
}

/// What pushes the peg locks at `mu = 0.2189019785`, where three lines meet.
#[test]
fn the_peg_locks_at_the_friction_of_the_reference() {
    let Reference { case } = toml::from_str(REFERENCE).unwrap();
    let peg = case.iter().find(|case| case.name == "peg_two_points").unwrap();
    let model = Model::parse(&peg.system.text()).unwrap();
    let report = limits(&model, &LimitsOptions::new("friction=0..3".parse().unwrap())).unwrap();
    assert_eq!(report.counts[0].solutions, 1);
    assert_close(report.counts[0].to * 0.15, 0.218_901_978_5, 1.0, 1e-8);
    let driven = drive(&model, &DriveOptions::default()).unwrap();
    let effort = only(&report_on(&peg.system.text())).drives[0].effort;
    let json = serde_json::to_string(&driven).unwrap();
    assert!(json.contains(&format!("{effort:?}")[..8]), "{json}");
}

/// The latch of the reference locks where the force on its nose points to its pivot: `mu = (P x n)/(P x u) = 0.5472587141`.
#[test]
fn the_latch_locks_at_the_friction_of_the_closed_form() {
    let model = Model::parse(include_str!("../../models/latch-with-pawl.toml")).unwrap();
    let report = limits(&model, &LimitsOptions::new("mu=0..1".parse().unwrap())).unwrap();
    let (sin, cos) = 50_f64.to_radians().sin_cos();
    let critical = (0.1 * cos - 0.02 * sin) / (0.1 * sin + 0.02 * cos);
    assert_close(report.counts[0].to, critical, 1.0, 1e-8);
    assert_close(critical, 0.547_258_714_1, 1.0, 1e-9);
    let effort = only(&report_with(&model, &Settings::default())).drives[0].effort;
    assert_close(effort, 90.409_901_39, 1.0, 1e-7);
}

#[test]
fn what_is_not_known_yet_is_refused() {
    let model = rod(&[]);
    let is_refused = |faults: Faults| {
        let kinds: Vec<FaultKind> = faults.sorted().iter().map(|fault| fault.kind.clone()).collect();
        assert!(matches!(kinds.as_slice(), [FaultKind::OneSided { .. }]), "{faults}");
        assert!(kinds[0].hint().is_some());
    };
    let options = LimitsOptions::new("mu=0..1".parse().unwrap()).max_reaction(100.0);
    is_refused(limits(&model, &options).unwrap_err());
    let questions = check(&model).unwrap().questions;
    let ready = questions.iter().filter(|question| question.ready);
    assert_eq!(ready.map(|question| question.name).collect::<Vec<_>>(), ["solve", "hold", "simulate"]);
}

/// The only fault of a text.
pub(crate) fn fault(text: &str) -> FaultKind {
    let faults = try_report_on(text).unwrap_err();
    let all = faults.sorted();
    assert_eq!(all.len(), 1, "{faults}");
    let kind = all[0].kind.clone();
    assert!(kind.hint().is_some() || matches!(kind, FaultKind::NoneOf { .. }), "{faults}");
    kind
}

#[test]
fn three_corners_on_a_line_are_refused() {
    let third = "[joints.third]\ntype = \"corner_on_face\"\nblock = \"box\"\nat = \"M\"\nalong = \"slope\"\nmu = 0.1\n[coordinates.x]";
    let kind = fault(&BOX.replace("[coordinates.x]", third));
    let FaultKind::OneSidedInExcess { contacts, .. } = kind else { panic!("{kind}") };
    assert_eq!(contacts, ["base.front", "base.rear", "third"]);
}

/// Both pairs of opposite corners of a peg in its play cannot touch together: given together they could carry each other, so that
/// no list of states is proven, and at rest they are wedged and hold anything.
#[test]
fn corners_that_cannot_touch_together_are_refused_and_wedged() {
    let corner = |name: &str, at: &str, along: &str| {
        format!(
            "[joints.{name}]\ntype = \"corner_on_face\"\nblock = \"peg\"\nat = \"{at}\"\nalong = \"{along}\"\nmu = 0.3\n"
        )
    };
    let text = format!(
        "[points]\nC = [0, 0]\nA = [-1, -2]\nB = [1, -2]\nD = [-1, 2]\nE = [1, 2]\n[bodies.peg]\npoints = [\"C\", \"A\", \"B\", \"D\", \"E\"]\n\
         mass = 1\nmoment_of_inertia = 1\ncentre_of_mass = \"C\"\n[loads.push]\ntype = \"force\"\nat = \"peg.C\"\ncomponents = [0, -1e6]\n\
         [coordinates.depth]\ny = \"peg.C\"\nrate = -1\n{}{}{}{}",
        corner("left_tip", "A", "-90 deg"),
        corner("right_tip", "B", "90 deg"),
        corner("left_mouth", "D", "-90 deg"),
        corner("right_mouth", "E", "90 deg"),
    );
    let kind = fault(&text);
    let FaultKind::OneSidedInExcess { contacts, .. } = kind else { panic!("{kind}") };
    assert_eq!(contacts, ["left_tip", "right_tip", "left_mouth", "right_mouth"]);
    let held = hold(&Model::parse(&text).unwrap(), &HoldOptions::default()).unwrap();
    assert!(held.holds, "{:?}", held.verdict);
    assert_eq!(held.at_rest.unwrap().wedging, ["left_tip", "right_tip", "left_mouth", "right_mouth"]);
}

#[test]
fn what_would_lift_off_without_mass_is_refused() {
    let text = BOX.replace(
        "mass = \"1 kg\"\ncentre_of_mass = \"C\"\nshape = { rectangle = [\"b\", \"h\"] }",
        "massless = true",
    );
    let drive = "[drives.pull]\ncoordinate = \"x\"\nforce = { at = \"box.C\", direction = \"slope\" }\n";
    let kind = fault(&(text + drive));
    assert!(
        matches!(&kind, FaultKind::LiftsWithoutInertia { contacts, .. } if contacts.len() == 2),
        "{kind}"
    );
}

#[test]
fn faces_are_where_their_blocks_are() {
    let face = |ends: &str| BOX.replace("along = \"slope\"", &format!("face = {ends}"));
    let free = on_incline(&[]);
    let on_face = report_on(&face("[\"from\", \"to\"]"));
    assert_close(
        contact(only(&on_face), "base.rear").normal_force,
        contact(only(&free), "base.rear").normal_force,
        1.0,
        1e-12,
    );
    assert!(matches!(fault(&face("[\"from\", \"C\"]")), FaultKind::OffFace { .. }));
    // Its front corner is beyond the end.
    let short = face("[\"from\", \"to\"]").replace(
        "to = [\"1 m*cos(slope)\", \"1 m*sin(slope)\"]",
        "to = [\"50 mm*cos(slope)\", \"50 mm*sin(slope)\"]",
    );
    let faults = try_report_on(&short).unwrap_err();
    assert!(
        faults.sorted().iter().any(|fault| matches!(fault.kind, FaultKind::TravelExceeded { .. })),
        "{faults}"
    );
    let both = BOX.replace("along = \"slope\"", "along = \"slope\"\nface = [\"from\", \"to\"]");
    assert!(matches!(fault(&both), FaultKind::Both { .. }));
    assert!(matches!(fault(&BOX.replace("along = \"slope\"\n", "")), FaultKind::NoneOf { .. }));
    assert!(matches!(
        fault(&BOX.replace("mu = \"mu\"", "mu = \"mu\"\npreload = \"1 N\"")),
        FaultKind::UnknownKey { .. }
    ));
}

/// The builder writes the same model.
#[test]
fn a_drawing_in_code_has_them() {
    let mut drawing = Drawing::new();
    drawing.gravity(GRAVITY);
    let body = drawing.body("box").mass(1.0).inertia((0.04 + 0.16) / 12.0).centre([0.0, 0.2]).id();
    let base = drawing.block_on_face("base", body, Frame::Ground).at([0.0, 0.0]).length(0.2).mu(0.6).id();
    let corner = drawing.corner_on_face("corner", body, Frame::Ground).at([0.0, 0.4]).mu(0.0).id();
    assert_eq!([base.front(), base.rear(), corner.contact()].map(ContactId::index), [0, 1, 2]);
    assert!(drawing.to_toml().contains("type = \"corner_on_face\""));
    let mut drawing = Drawing::new();
    drawing.gravity(GRAVITY);
    let body = drawing.body("box").mass(1.0).inertia((0.04 + 0.16) / 12.0).centre([0.0, 0.2]).id();
    let base = drawing.block_on_face("base", body, Frame::Ground).at([0.0, 0.0]).length(0.2).mu(0.6).id();
    drawing.slide("x", base).rate(-1.0);
    let report = report_on(&drawing.to_toml());
    assert_eq!(contact(only(&report), "base.front").side, -1);
    let mut drawing = Drawing::new();
    drawing.gravity(GRAVITY);
    let body = drawing.body("disc").mass(1.0).inertia(0.02).centre([0.0, 0.2]).id();
    let foot = drawing.disc_on_face("foot", body, Frame::Ground).at([0.0, 0.2]).radius(0.2).mu(0.3).id();
    drawing.slide("x", foot).rate(1.0);
    drawing.rotation("turn", body);
    let report = report_on(&drawing.to_toml());
    assert_eq!(foot.contact().index(), 0);
    assert_close(contact(only(&report), "foot").friction_force, 0.3 * GRAVITY, 1.0, 1e-12);
    // On the top of a cylinder as on a plane, at the first instant: a hole, and beside it.
    for (centre, radius, inside) in [(-0.1, 0.1, false), (0.5, 0.5, true)] {
        let mut drawing = Drawing::new();
        drawing.gravity(GRAVITY);
        let body = drawing.body("disc").mass(1.0).inertia(0.02).centre([0.0, 0.2]).id();
        let foot = drawing.disc_on_disc("foot", body, Frame::Ground).centres([[0.0, 0.2], [0.0, centre]]);
        let foot = foot.radii([0.2, radius]).mu(0.3);
        let foot = if inside { foot.inside().id() } else { foot.id() };
        drawing.rotation("turn", body).rate(1.0);
        let turned = drawing.to_toml() + "[coordinates.x]\nx = \"disc.foot\"\n";
        let report = report_on(&turned);
        assert_eq!(foot.contact().index(), 0);
        assert_close(contact(only(&report), "foot").friction_force.abs(), 0.3 * GRAVITY, 1.0, 1e-12);
    }
    // What is apart leaves its freedom.
    let mut drawing = Drawing::new();
    let body = drawing.body("disc").mass(1.0).inertia(0.02).centre([0.0, 0.3]).id();
    drawing.disc_on_face("foot", body, Frame::Ground).at([0.0, 0.2]).radius(0.1).mu(0.3).apart();
    assert!(drawing.to_toml().contains("closed = false"));
}

/// Without friction, too, what would have to pull lifts off: a corner beneath a body that is drawn upwards needs no more than to lift it.
#[test]
fn without_friction_contacts_lift_off_too() {
    let text = r#"
        gravity = "9.81 m/s^2"
        [points]
        M = [0, 0]
        S = [0, 0.1]
        [bodies.box]
        points = ["M", "S"]
        mass = "2 kg"
        moment_of_inertia = "0.01 kg m^2"
        centre_of_mass = "S"
        [joints.base]
        type = "block_on_face"
        block = "box"
        at = "M"
        along = "0 deg"
        length = "0.2 m"
        mu = 0.3
        [coordinates.x]
        slide = "base"
        rate = "1 m/s"
        [drives.pull]
        coordinate = "x"
        acceleration = "5 m/s^2"
        force = { at = "box.S", direction = "80 deg" }
    "#;
    // m a / cos(80 deg): its upward part, 56.7 N, is more than the weight.
    let report = report_on(text);
    let expected = 2.0 * 5.0 / 80_f64.to_radians().cos();
    assert_close(report.influence.drives[0].effort, expected, 1.0, 1e-9);
    let solution = only(&report);
    assert_eq!(solution.pattern, "--");
    assert_close(solution.drives[0].effort, expected, 1.0, 1e-9);
    assert_close(
        gap(solution, "base.front"),
        expected * 80_f64.to_radians().sin() / 2.0 - GRAVITY,
        1.0,
        1e-9,
    );
}
