//! Redundant guides: `reference/redundant.toml`, and random ones against equations of their own.

use crate::answers::report_on;
use crate::random_mechanisms::cases;
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use serde::Deserialize;
use slideway::report::{Fate, Proof, Report, SolveReport, Style, Verdict};
use std::fmt::Write as _;

const REFERENCE: &str = include_str!("../../../../reference/redundant.toml");
const SIMULATED: &str = include_str!("../../../../reference/redundant-simulated.toml");

#[derive(Deserialize)]
struct Reference {
    case: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    gravity: [f64; 2],
    bodies: Vec<Body>,
    hinges: Vec<Hinge>,
    contacts: Vec<Contact>,
    forces: Vec<Force>,
    drives: Vec<Drive>,
    solutions: Vec<Expected>,
}

#[derive(Deserialize)]
struct Body {
    name: String,
    m: f64,
    #[serde(rename = "J")]
    moment: f64,
    pose: [f64; 3],
    velocity: [f64; 3],
}

#[derive(Deserialize)]
struct Hinge {
    a: String,
    at_a: [f64; 2],
    b: String,
}

#[derive(Deserialize, Clone)]
struct Contact {
    #[serde(rename = "O")]
    on_guide: [f64; 2],
    slider: String,
    #[serde(rename = "P")]
    point: [f64; 2],
    h: f64,
    mu: f64,
    #[serde(rename = "F0")]
    preload: f64,
    delta: f64,
    f: f64,
    e: f64,
}

#[derive(Deserialize)]
struct Force {
    body: String,
    at: [f64; 2],
    #[serde(rename = "force")]
    components: [f64; 2],
}

#[derive(Deserialize)]
struct Drive {
    body: String,
    at: [f64; 2],
    direction: [f64; 2],
}

#[derive(Deserialize)]
struct Expected {
    states: String,
    #[serde(rename = "N_plus")]
    plus: Vec<f64>,
    #[serde(rename = "N_minus")]
    minus: Vec<f64>,
    d: Vec<f64>,
    a: Vec<f64>,
    #[serde(rename = "P")]
    efforts: Vec<f64>,
    verdict: String,
    p: Option<f64>,
}

/// What `reference/redundant_drawer.py` found.
#[derive(Deserialize)]
struct Simulated {
    settled: Vec<Settled>,
    threshold: Vec<FromTilt>,
}

/// What a body on springs settled on.
#[derive(Deserialize)]
struct Settled {
    case: String,
    normal: Vec<f64>,
    effort: Option<f64>,
    acceleration: Option<f64>,
}

/// What became of a body that started from this part of the tilt of the unattainable solution.
#[derive(Deserialize)]
struct FromTilt {
    case: String,
    of_tilt: f64,
    outcome: String,
}

impl Case {
    fn is_press_fit(&self) -> bool {
        self.contacts.iter().any(|contact| contact.delta < 0.0)
    }

    fn place(&self, body: &str, local: [f64; 2]) -> [f64; 2] {
        let [x, y, angle] = self.bodies.iter().find(|other| other.name == body).unwrap().pose;
        let (sin, cos) = angle.sin_cos();
        [x + cos * local[0] - sin * local[1], y + sin * local[0] + cos * local[1]]
    }

    /// The contacts of each line of a body, by their numbers: one joint each, the foremost contact first and the
    /// rearmost second.
    fn joints(&self) -> Vec<Vec<usize>> {
        let mut joints: Vec<Vec<usize>> = Vec::new();
        for (k, contact) in self.contacts.iter().enumerate() {
            let same = |joint: &&mut Vec<usize>| {
                let first = &self.contacts[joint[0]];
                first.slider == contact.slider && first.on_guide[1] == contact.on_guide[1]
            };
            match joints.iter_mut().find(same) {
                Some(joint) => joint.push(k),
                None => joints.push(vec![k]),
            }
        }
        for joint in &mut joints {
            let x = |k: &usize| self.contacts[*k].point[0];
            joint.sort_by(|a, b| x(b).total_cmp(&x(a)));
            if joint.len() > 2 {
                let last = joint.pop().unwrap();
                joint.insert(1, last);
            }
        }
        joints
    }

    /// The contacts in the order of the report: each with 0, of a press fit the positive face with 1; then, joint by
    /// joint, the negative faces of press fits with -1.
    fn faces(&self, order: &[usize]) -> Vec<(usize, i8)> {
        let is_fit = |k: &usize| self.contacts[*k].delta < 0.0;
        let of_joint = |joint: &Vec<usize>| {
            let first = joint.iter().map(|k| (*k, i8::from(is_fit(k)))).collect::<Vec<_>>();
            first.into_iter().chain(joint.iter().filter(|k| is_fit(k)).map(|k| (*k, -1))).collect::<Vec<_>>()
        };
        let faces: Vec<(usize, i8)> = self.joints().iter().flat_map(of_joint).collect();
        assert_eq!(faces.iter().filter(|(_, face)| *face >= 0).map(|(k, _)| *k).collect::<Vec<_>>(), order);
        faces
    }

    /// The signs of a state: of the faces of a press fit those of the mode problem, + - where both are pressed, else
    /// twice the one that is.
    fn signs(&self, order: &[usize], states: &str) -> String {
        let sign = |(k, face): (usize, i8)| match (states.as_bytes()[k], face) {
            (b'=', 1) => '+',
            (b'=', _) => '-',
            (state, _) => state as char,
        };
        self.faces(order).into_iter().map(sign).collect()
    }

    /// The model file.
    fn text(&self) -> String {
        let mut text = format!("gravity = [{}, {}]\n", self.gravity[0], self.gravity[1]);
        let mut points = String::new();
        let mut owned = vec![Vec::new(); self.bodies.len()];
        let mut point = |name: String, body: &str, place: [f64; 2]| {
            writeln!(points, "{name} = [{}, {}]", place[0], place[1]).unwrap();
            owned[self.bodies.iter().position(|other| other.name == body).unwrap()].push(name);
        };
        for (index, force) in self.forces.iter().enumerate() {
            point(format!("load{index}"), &force.body, self.place(&force.body, force.at));
        }
        for (index, drive) in self.drives.iter().enumerate() {
            point(format!("drive{index}"), &drive.body, self.place(&drive.body, drive.at));
        }
        for (index, hinge) in self.hinges.iter().enumerate() {
            let place = self.place(&hinge.a, hinge.at_a);
            point(format!("hinge{index}a"), &hinge.a, place);
            point(format!("hinge{index}b"), &hinge.b, place);
        }
        writeln!(text, "[points]\n{points}").unwrap();
        for (body, owned) in self.bodies.iter().zip(&owned) {
            let [x, y, _] = body.pose;
            writeln!(
                text,
                "[bodies.{}]\nmass = {}\nmoment_of_inertia = {}\ncentre_of_mass = [{x}, {y}]\npoints = {owned:?}",
                body.name, body.m, body.moment
            )
            .unwrap();
        }
        for (index, _) in self.hinges.iter().enumerate() {
            let Hinge { a, b, .. } = &self.hinges[index];
            writeln!(
                text,
                "[joints.hinge{index}]\ntype = \"hinge\"\nbetween = [\"{a}.hinge{index}a\", \"{b}.hinge{index}b\"]"
            )
            .unwrap();
        }
        for (index, joint) in self.joints().iter().enumerate() {
            self.joint(&mut text, index, joint);
        }
        for (index, force) in self.forces.iter().enumerate() {
            writeln!(
                text,
                "[loads.load{index}]\ntype = \"force\"\nat = \"{}.load{index}\"\ncomponents = [{}, {}]",
                force.body, force.components[0], force.components[1]
            )
            .unwrap();
        }
        for (index, drive) in self.drives.iter().enumerate() {
            let angle = drive.direction[1].atan2(drive.direction[0]);
            writeln!(
                text,
                "[drives.drive{index}]\ncoordinate = \"s\"\nforce = {{ at = \"{}.drive{index}\", direction = {angle} }}",
                drive.body
            )
            .unwrap();
        }
        let rate = self.bodies[0].velocity[0];
        writeln!(text, "[coordinates.s]\nslide = \"joint0\"\nrate = {rate}").unwrap();
        text
    }

    fn joint(&self, text: &mut String, index: usize, joint: &[usize]) {
        let contact = |number: usize| &self.contacts[joint[number]];
        let keys = |k: usize| {
            let Contact { mu, preload, delta, f, e, .. } = &self.contacts[k];
            let stiffness = if *f > 0.0 { format!("\nstiffness = {}", 1.0 / f) } else { String::new() };
            format!("mu = {mu}\npreload = {preload}\nplay = {}\nmisalignment = {e}{stiffness}\n", 2.0 * delta)
        };
        let place = self.place(&contact(0).slider, contact(0).point);
        writeln!(text, "[joints.joint{index}]\nblock = \"{}\"\nalong = 0", contact(0).slider).unwrap();
        if joint.len() == 1 {
            write!(text, "type = \"pin_in_slot\"\nat = [{}, {}]\n{}", place[0], place[1], keys(joint[0]))
                .unwrap();
            return;
        }
        let length = contact(0).point[0] - contact(1).point[0];
        let fit = if contact(0).h < 0.0 { "around" } else { "inside" };
        let middle = place[0] - length / 2.0;
        writeln!(
            text,
            "type = \"block_slider\"\nat = [{middle}, {}]\nlength = {length}\nheight = {}\nfit = \"{fit}\"\npreload_line = \"centre\"",
            place[1],
            contact(0).h.abs(),
        )
        .unwrap();
        for (end, k) in ["front", "rear"].iter().zip(joint) {
            write!(text, "[joints.joint{index}.{end}]\n{}", keys(*k)).unwrap();
        }
        for (number, k) in joint.iter().enumerate().skip(2) {
            let at = self.contacts[*k].point[0] - (contact(0).point[0] - length / 2.0);
            write!(text, "[joints.joint{index}.supports.pad{number}]\nat = {at}\n{}", keys(*k)).unwrap();
        }
    }
}

fn text(report: &SolveReport) -> String {
    report.text(Style::PLAIN)
}

fn close(found: f64, expected: f64, scale: f64) -> bool {
    (found - expected).abs() <= 1e-9 * scale
}

fn check(case: &Case) {
    let report = report_on(&case.text());
    let name = &case.name;
    assert_eq!(report.complete, Proof::Proven, "{name}: {:?}", report.open);
    assert_eq!(report.solutions.len(), case.solutions.len(), "{name}: {}", text(&report));
    assert!(report.preload_gap_states.is_empty(), "{name}");
    let order: Vec<usize> = case.joints().into_iter().flatten().collect();
    for expected in &case.solutions {
        let states = case.signs(&order, &expected.states);
        let solution = report.solutions.iter().find(|solution| solution.pattern == states);
        let solution = solution.unwrap_or_else(|| panic!("{name}: {states} in\n{}", text(&report)));
        let force = |(k, face): &(usize, i8)| match face {
            1 => expected.plus[*k],
            -1 => -expected.minus[*k],
            _ => expected.plus[*k] - expected.minus[*k],
        };
        let faces = case.faces(&order);
        let scale = faces.iter().map(|face| force(face).abs()).fold(0.0, f64::max);
        assert_eq!(solution.contacts.len(), faces.len());
        for (contact, face @ (k, _)) in solution.contacts.iter().zip(&faces) {
            let k = *k;
            assert!(close(contact.normal_force, force(face), scale), "{name} {states}: {contact:?}");
            if let Some(deflection) = contact.deflection {
                assert!(close(deflection, expected.d[k], 1e-3), "{name} {states}: {contact:?}");
            }
        }
        for (drive, effort) in solution.drives.iter().zip(&expected.efforts) {
            assert!(close(drive.effort, *effort, effort.abs()), "{name} {states}: {drive:?}");
        }
        for (body, expected) in solution.bodies.iter().zip(expected.a.chunks(3)) {
            let found = [body.acceleration[0], body.acceleration[1], body.angular_acceleration];
            for (found, expected) in found.iter().zip(expected) {
                assert!(close(*found, *expected, 10.0), "{name} {states}: {body:?}");
            }
        }
        let verdict = match solution.attainability.verdict {
            Verdict::Attainable => "attainable",
            Verdict::Unattainable => "unattainable",
            _ => "other",
        };
        assert_eq!(verdict, expected.verdict, "{name} {states}: {:?}", solution.attainability);
        if let Some(p) = expected.p {
            let found = solution.oriented_determinant;
            assert!(close(found, p, 10.0), "{name} {states}: {found} {p}");
        }
    }
}

/// `reference/redundant.toml`, by two formulations and a stiff simulation.
#[test]
fn the_reference_cases_have_their_solutions() {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    reference.case.iter().for_each(check);
}

/// Rotations are finite there: the tilts of the cases change normal forces and efforts by up to 0.2 %.
#[test]
fn stiff_simulations_settle_on_attainable_solutions() {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    let simulated: Simulated = toml::from_str(SIMULATED).unwrap();
    let mut compared = 0;
    for settled in &simulated.settled {
        let name = &settled.case;
        let case = reference.case.iter().find(|case| case.name == *name).unwrap();
        if case.is_press_fit() {
            continue;
        }
        let order: Vec<usize> = case.joints().into_iter().flatten().collect();
        let report = report_on(&case.text());
        let is_there = |solution: &&slideway::report::Solution| {
            let greatest = settled.normal.iter().map(|force| force.abs()).fold(0.0, f64::max);
            let near = |found: f64, expected: f64, scale: f64| (found - expected).abs() <= 2e-3 * scale;
            let forces = solution.contacts.iter().zip(&order);
            let mut forces =
                forces.map(|(contact, &k)| near(contact.normal_force, settled.normal[k], greatest));
            let effort = settled.effort.is_none_or(|effort| near(solution.drives[0].effort, effort, effort));
            let moves = settled.acceleration.is_none_or(|a| near(solution.bodies[0].acceleration[0], a, a));
            forces.all(|near| near) && effort && moves
        };
        let solution = report.solutions.iter().find(is_there);
        let solution = solution.unwrap_or_else(|| panic!("{name}: {:?}\n{}", settled.normal, text(&report)));
        assert_eq!(solution.attainability.verdict, Verdict::Attainable, "{name}");
        compared += 1;
    }
    assert_eq!(compared, 5);
}

/// Theory of redundant guides, section 4: left rail tight, mu = 1. The stiff simulation returns from 0.95 of the tilt
/// of the wedged state, and jams from 1.05.
#[test]
fn the_wedged_state_is_the_threshold_to_jamming() {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    let case = reference.case.iter().find(|case| case.name == "drawer_left_rail_tight").unwrap();
    let report = report_on(&case.text());
    let wedged = report.solutions.iter().find(|solution| !solution.pattern.contains('0')).unwrap();
    let sliding = report.solutions.iter().position(|solution| solution.pattern.contains('0')).unwrap();
    let mut fates = wedged.attainability.separates.unwrap();
    fates.sort_by_key(|fate| *fate == Fate::Jamming);
    assert_eq!(fates, [Fate::Solution(sliding + 1), Fate::Jamming]);
    let simulated: Simulated = toml::from_str(SIMULATED).unwrap();
    let outcomes: Vec<(&str, f64, &str)> =
        simulated.threshold.iter().map(|from| (&*from.case, from.of_tilt, &*from.outcome)).collect();
    assert_eq!(outcomes, [(&*case.name, 0.95, "returns"), (&*case.name, 1.05, "jams")]);
}

/// Nothing presses: the block floats, in one state. At mu = 1 another one is wedged: of the moments about the
/// middle, `0.4 m (N_L + N_R) = 0.3 m 2 mu (N_L - N_R)`, and both rails tilt alike, `N_L - N_R = k (delta_R -
/// delta_L) = 10 N`, so that `N_L = 12.5 N, N_R = 2.5 N`.
#[test]
fn an_unloaded_block_floats_in_one_state() {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    let mut case = reference.case.into_iter().find(|case| case.name == "drawer_left_rail_tight").unwrap();
    case.drives[0].at[1] = 0.0;
    let report = report_on(&case.text());
    let (floating, others): (Vec<_>, Vec<_>) =
        report.solutions.iter().partition(|solution| !solution.floating.is_empty());
    let [floating] = floating[..] else { panic!("{}", text(&report)) };
    assert_eq!(floating.floating.len(), 4);
    assert!(floating.contacts.iter().all(|contact| contact.deflection.is_none()));
    assert!(text(&report).contains("It floats within its play"));
    let [wedged] = others[..] else { panic!("{}", text(&report)) };
    let forces: Vec<f64> = wedged.contacts.iter().map(|contact| contact.normal_force.abs()).collect();
    for (force, expected) in forces.iter().zip([12.5, 12.5, 2.5, 2.5]) {
        assert!(close(*force, expected, 12.5), "{forces:?}");
    }
}

/// A rigid body that slides along x on rails along x: contacts at (x, y) with their law.
#[derive(Debug, Clone)]
pub(crate) struct Carriage {
    pub(crate) load: [f64; 2],
    pub(crate) at: [f64; 2],
    pub(crate) mass: f64,
    pub(crate) moment: f64,
    /// For each rail its height and the half distance of the faces; three contacts each.
    pub(crate) rails: Vec<(f64, f64)>,
    pub(crate) contacts: Vec<Pad>,
}

#[derive(Debug, Clone)]
pub(crate) struct Pad {
    pub(crate) x: f64,
    pub(crate) mu: f64,
    pub(crate) preload: f64,
    pub(crate) clearance: f64,
    pub(crate) compliance: f64,
    pub(crate) misalignment: f64,
}

impl Carriage {
    pub(crate) fn per_rail(&self) -> usize {
        self.contacts.len() / self.rails.len()
    }

    pub(crate) fn text(&self) -> String {
        let mut text = format!(
            "[points]\nload = [{}, {}]\n[bodies.body]\nmass = {}\nmoment_of_inertia = {}\ncentre_of_mass = [0, 0]\npoints = [\"load\"]\n\
             [loads.load]\ntype = \"force\"\nat = \"body.load\"\ncomponents = [{}, {}]\n[coordinates.s]\nslide = \"rail0\"\nrate = 1\n",
            self.at[0], self.at[1], self.mass, self.moment, self.load[0], self.load[1]
        );
        for (rail, pads) in self.contacts.chunks(self.per_rail()).enumerate() {
            let (y, half) = self.rails[rail];
            let (middle, length) = (f64::midpoint(pads[0].x, pads[1].x), pads[0].x - pads[1].x);
            writeln!(
                text,
                "[joints.rail{rail}]\ntype = \"block_slider\"\nblock = \"body\"\nat = [{middle}, {y}]\nalong = 0\nlength = {length}\nheight = {}\npreload_line = \"centre\"",
                2.0 * half
            )
            .unwrap();
            for (number, pad) in pads.iter().enumerate() {
                let table = ["front".to_owned(), "rear".to_owned()].into_iter().nth(number);
                let is_support = table.is_none();
                let table = table.unwrap_or_else(|| format!("supports.pad{number}"));
                writeln!(text, "[joints.rail{rail}.{table}]").unwrap();
                if is_support {
                    writeln!(text, "at = {}", pad.x - middle).unwrap();
                }
                writeln!(
                    text,
                    "mu = {}\npreload = {}\nplay = {}\nstiffness = {}\nmisalignment = {}",
                    pad.mu,
                    pad.preload,
                    2.0 * pad.clearance,
                    1.0 / pad.compliance,
                    pad.misalignment
                )
                .unwrap();
            }
        }
        text
    }

    /// All solutions (R1) in descriptor form: for each state of every contact one linear system in the
    /// acceleration, the normal forces, and the small displacement and rotation of the body.
    fn solutions(&self) -> Vec<(String, Vec<f64>)> {
        let count = self.contacts.len();
        let mut found = Vec::new();
        for number in 0..3_usize.pow(u32::try_from(count).unwrap()) {
            let states: Vec<i8> =
                (0..count).map(|k| [1, -1, 0][number / 3_usize.pow(u32::try_from(k).unwrap()) % 3]).collect();
            // Unknown: acceleration, N_k, displacement along y, rotation.
            let size = count + 3;
            let mut matrix = DMatrix::zeros(size, size);
            let mut right = DVector::zeros(size);
            matrix[(0, 0)] = self.mass;
            right[0] = self.load[0];
            right[1] = self.load[1];
            right[2] = self.at[0] * self.load[1] - self.at[1] * self.load[0];
            for (k, pad) in self.contacts.iter().enumerate() {
                let (y, half) = self.rails[k / self.per_rail()];
                let sign = f64::from(states[k]);
                // Friction (mu |N| + F0) along -x, the pressure's at y - sign h/2, the preload's at y.
                matrix[(0, 1 + k)] = pad.mu * sign;
                right[0] -= pad.preload;
                matrix[(1, 1 + k)] = -1.0;
                matrix[(2, 1 + k)] = -pad.x - (y - sign * half) * pad.mu * sign;
                right[2] += y * pad.preload;
                let row = 3 + k;
                if states[k] == 0 {
                    matrix[(row, 1 + k)] = 1.0;
                } else {
                    // d = displacement + x rotation - e = -sign delta - f N
                    matrix[(row, count + 1)] = 1.0;
                    matrix[(row, count + 2)] = pad.x;
                    matrix[(row, 1 + k)] = pad.compliance;
                    right[row] = pad.misalignment - sign * pad.clearance;
                }
            }
            let Some(solution) = matrix.lu().solve(&right) else { continue };
            let fits = (0..count).all(|k| {
                let pad = &self.contacts[k];
                let deflection = solution[count + 1] + pad.x * solution[count + 2] - pad.misalignment;
                match states[k] {
                    0 => deflection.abs() <= pad.clearance,
                    sign => f64::from(sign) * solution[1 + k] >= 0.0,
                }
            });
            if fits {
                let sign = |state: &i8| match state {
                    0 => '0',
                    1.. => '+',
                    _ => '-',
                };
                found.push((
                    states.iter().map(sign).collect::<String>(),
                    (0..count).map(|k| solution[1 + k]).collect::<Vec<f64>>(),
                ));
            }
        }
        found.sort_by(|a, b| a.0.cmp(&b.0));
        found
    }
}

pub(crate) fn carriages() -> impl Strategy<Value = Carriage> {
    let pad = (0.0..1.5_f64, 0.0..3.0_f64, 0.0..3e-4_f64, 5e-6..5e-5_f64, -3e-4..3e-4_f64);
    let rails = proptest::collection::vec((-0.4..0.4_f64, 0.0..0.05_f64), 1..3);
    (
        rails,
        proptest::collection::vec(pad, 6),
        [-20.0..20.0_f64, -20.0..20.0],
        [-0.4..0.4_f64, -0.4..0.4],
        2..4_usize,
    )
        .prop_map(|(rails, pads, load, at, of_first)| {
            let per_rail = if rails.len() == 1 { 3 } else { of_first };
            let places = [0.2, -0.2, 0.05];
            let contacts = (0..rails.len() * per_rail)
                .map(|k| {
                    let (mu, preload, clearance, compliance, misalignment) = pads[k];
                    let x = places[k % per_rail] + 0.02 * (k / per_rail) as f64;
                    Pad { x, mu, preload, clearance, compliance, misalignment }
                })
                .collect();
            Carriage { load, at, mass: 3.0, moment: 0.2, rails, contacts }
        })
}

fn found(report: &SolveReport) -> Vec<(String, Vec<f64>)> {
    let forces = |solution: &slideway::report::Solution| {
        solution.contacts.iter().map(|contact| contact.normal_force).collect::<Vec<f64>>()
    };
    let mut found: Vec<_> =
        report.solutions.iter().map(|solution| (solution.pattern.clone(), forces(solution))).collect();
    found.sort_by(|a, b| a.0.cmp(&b.0));
    found
}

proptest! {
    #![proptest_config(cases(60))]

    /// Two rails or one with three pads: the same lists as three states for every contact.
    #[test]
    fn random_carriages_have_the_solutions_of_the_descriptor_form(carriage in carriages()) {
        let report = report_on(&carriage.text());
        prop_assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
        let (found, expected) = (found(&report), carriage.solutions());
        prop_assert_eq!(found.len(), expected.len(), "{:?}\n{:?}", &found, &expected);
        for ((states, forces), (expected_states, expected)) in found.iter().zip(&expected) {
            prop_assert_eq!(states, expected_states);
            let scale = expected.iter().map(|force| force.abs()).fold(0.0, f64::max);
            for (force, expected) in forces.iter().zip(expected) {
                prop_assert!((force - expected).abs() <= 1e-8 * scale, "{} {:?} {:?}", states, forces, expected);
            }
        }
    }
}
