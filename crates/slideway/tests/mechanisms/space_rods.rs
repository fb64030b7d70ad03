//! Blocks on round rods: `reference/space.toml`, closed forms, and random carriages on turntables against Newton's and Euler's
//! equations of their own.

use crate::answers::{contact, report_on, try_report_on};
use crate::space::REFERENCE;
use nalgebra::{Matrix6, Vector3, Vector6};
use serde::Deserialize;
use slideway::limits::{LimitsOptions, limits};
use slideway::model::{Model, Settings};
use slideway::report::{Proof, Report, Solution, SolveReport, Style, Verdict};
use slideway::solve::{SolveOptions, solve, solve_with};
use slideway::standstill::{HoldOptions, hold};
use std::fmt::Write as _;
use std::ops::ControlFlow;

#[derive(Deserialize)]
struct Reference {
    case: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    name: String,
    gravity: [f64; 3],
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    #[serde(default)]
    loads: Vec<Force>,
    #[serde(default)]
    drives: Vec<Drive>,
    labels: Vec<String>,
    count: usize,
    #[serde(default)]
    solution: Vec<Expected>,
}

#[derive(Deserialize)]
struct Body {
    m: f64,
    pose: [f64; 3],
    z: f64,
    vel: [f64; 3],
}

#[derive(Deserialize)]
struct Joint {
    #[serde(rename = "type")]
    kind: String,
    name: String,
    #[serde(default)]
    at: Option<[f64; 2]>,
    #[serde(default)]
    z: f64,
    #[serde(default)]
    angle: f64,
    #[serde(default, rename = "L")]
    length: f64,
    #[serde(default, rename = "d")]
    diameter: f64,
    #[serde(default)]
    mu: f64,
    #[serde(default)]
    spin: f64,
    k: Option<f64>,
    #[serde(default)]
    contacts: Vec<Flat>,
}

#[derive(Deserialize)]
struct Flat {
    name: String,
    #[serde(default)]
    along: f64,
    #[serde(default)]
    aside: f64,
    #[serde(default)]
    phi: f64,
}

#[derive(Deserialize)]
struct Force {
    force: [f64; 3],
    at: [f64; 3],
}

#[derive(Deserialize)]
struct Drive {
    at: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct Expected {
    #[serde(rename = "N")]
    normal: Vec<f64>,
    #[serde(default)]
    effort: Vec<f64>,
    p: f64,
}

impl Case {
    /// Whether it is one body on rods that do not turn and in whose axes the friction may be taken: without diameter, or without
    /// forces across them, so that the couples of both ends are opposite.
    fn is_on_rods(&self) -> bool {
        let across = self.loads.iter().any(|load| load.force[1] != 0.0 || load.force[2] != 0.0);
        let known = |joint: &Joint| match joint.kind.as_str() {
            "round" => joint.spin == 0.0 && joint.angle == 0.0 && (joint.diameter == 0.0 || !across),
            kind => kind == "flat" && joint.angle == 0.0,
        };
        self.bodies.len() == 1
            && self.joints[0].kind == "round"
            && self.gravity == [0.0; 3]
            && self.joints.iter().all(known)
    }

    fn model(&self) -> String {
        let body = &self.bodies[0];
        let place = |[x, y, z]: [f64; 3]| format!("[{x}, {y}, {z}]");
        let centre = place([body.pose[0], body.pose[1], body.z]);
        let pull = place(self.drives[0].at.unwrap());
        let mut text = format!("[points]\nC = {centre}\nP = {pull}\n");
        for (index, load) in self.loads.iter().enumerate() {
            writeln!(text, "L{index} = {}", place(load.at)).unwrap();
        }
        let names: Vec<String> = (0..self.loads.len()).map(|index| format!(", \"L{index}\"")).collect();
        let loads = names.concat();
        let (mass, first) = (body.m, &self.joints[0]);
        write!(
            text,
            "[bodies.c]\npoints = [\"C\", \"P\"{loads}]\nmass = {mass}\ncentre_of_mass = \"C\"\n\
             shape = {{ box = [0.1, 0.1, 0.1] }}\n"
        )
        .unwrap();
        for joint in self.joints.iter().filter(|joint| joint.kind == "round") {
            let (name, [x, y]) = (&joint.name, joint.at.unwrap());
            let Joint { z, length, mu, .. } = joint;
            write!(
                text,
                "[joints.{name}]\ntype = \"block_slider\"\nsection = \"round\"\nblock = \"c\"\nat = [{x}, {y}, {z}]\n\
                 along = 0\nlength = {length}\nmu = {mu}\n"
            )
            .unwrap();
            joint.k.iter().for_each(|k| writeln!(text, "stiffness = {k}").unwrap());
            if joint.name != first.name {
                continue;
            }
            // Faces beside the first rod are supports of its joint.
            for flat in self.joints.iter().filter(|joint| joint.kind == "flat") {
                for one in &flat.contacts {
                    let aside = one.aside + flat.at.unwrap()[1] - y;
                    let (along, normal, mu) = (one.along, one.phi.to_degrees(), flat.mu);
                    writeln!(
                        text,
                        "supports.{} = {{ at = {along}, aside = {aside}, normal = \"{normal} deg\", mu = {mu} }}",
                        one.name
                    )
                    .unwrap();
                }
            }
        }
        for (index, load) in self.loads.iter().enumerate() {
            let force = place(load.force);
            write!(text, "[loads.l{index}]\ntype = \"force\"\nat = \"c.L{index}\"\ncomponents = {force}\n")
                .unwrap();
        }
        let (rate, name) = (body.vel[0], &first.name);
        text + &format!(
            "[drives.d]\ncoordinate = \"x\"\nforce = {{ at = \"c.P\", direction = 0 }}\n\
             [coordinates.x]\nslide = \"{name}\"\nrate = {rate}\n"
        )
    }

    /// The names in the model of the forces in the file.
    fn names(&self) -> Vec<String> {
        let rod = |joint: &str| self.joints.iter().any(|other| other.kind == "round" && other.name == joint);
        let of_label = |label: &String| {
            let (joint, end) = label.split_once('.').unwrap();
            if rod(joint) {
                vec![label.clone(), format!("{label}.z")]
            } else {
                vec![format!("{}.{end}", self.joints[0].name)]
            }
        };
        self.labels.iter().flat_map(of_label).collect()
    }
}

/// The names of the cases that are compared here.
pub(crate) fn compared() -> Vec<String> {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    reference.case.into_iter().filter(Case::is_on_rods).map(|case| case.name).collect()
}

fn text(report: &SolveReport) -> String {
    report.text(Style::PLAIN)
}

fn close(found: f64, expected: f64, scale: f64) -> bool {
    (found - expected).abs() <= 1e-9 * scale
}

/// `reference/space.toml`: by an independent formulation in six degrees of freedom, and closed forms; with two rods that share
/// their load by stiffness, too.
#[test]
fn the_reference_cases_on_rods_have_their_solutions() {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    let mut compared = Vec::new();
    for case in reference.case.iter().filter(|case| case.is_on_rods()) {
        let report = report_on(&case.model());
        assert_eq!(report.solutions.len(), case.count, "{}\n{}", case.name, text(&report));
        assert_eq!(report.complete, Proof::Proven, "{}: {:?}", case.name, report.open);
        for expected in &case.solution {
            let is_it = |solution: &&Solution| (solution.oriented_determinant - expected.p).abs() < 1e-9;
            let solution = report.solutions.iter().find(is_it);
            let solution = solution.unwrap_or_else(|| panic!("{}\n{}", case.name, text(&report)));
            let scale = expected.normal.iter().map(|force| force.abs()).fold(1.0, f64::max);
            for (name, force) in case.names().iter().zip(&expected.normal) {
                assert!(close(contact(solution, name).normal_force, *force, scale), "{}: {name}", case.name);
            }
            assert!(close(solution.drives[0].effort, expected.effort[0], scale), "{}", case.name);
            assert!(solution.residual < 1e-12, "{}: {}", case.name, solution.residual);
        }
        compared.push(case.name.as_str());
    }
    assert_eq!(compared.len(), 17, "{compared:?}");
}

/// A carriage on a rod of 0.1 m between its ends, pulled at (a, c) against 10 N at (qa, qc).
const CARRIAGE: &str = r#"
[parameters]
a = 0.05
c = 0.06
qa = 0
qc = 0
mu = 0.25

[points]
middle = [0, 0]
pull = [0, "a", "c"]
load = [0, "qa", "qc"]

[bodies.carriage]
points = ["middle", "pull", "load"]
mass = 2
centre_of_mass = "middle"
shape = { box = [0.1, 0.05, 0.05] }

[joints.rod]
type = "block_slider"
section = "round"
block = "carriage"
at = "middle"
along = 0
length = 0.1
mu = "mu"
carries = ["roll"]

[loads.resistance]
type = "force"
at = "carriage.load"
components = [-10, 0, 0]

[drives.pull]
coordinate = "x"
force = { at = "carriage.pull", direction = 0 }

[coordinates.x]
slide = "rod"
rate = 0.1
"#;

fn carriage(values: &[(&str, f64)]) -> Model {
    let settings =
        values.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value.to_string()));
    Model::parse(CARRIAGE).unwrap().with(&settings).unwrap()
}

/// Theory of loads in space, section 5: a round rod locks where `||(a, c)|| = L/(2 mu)`, here 0.2 m; below,
/// `P = Q/(1 - 2 mu ||(a, c)||/L)`.
#[test]
fn a_round_rod_locks_at_a_radius() {
    for angle in [0.0_f64, 30.0, 90.0, 135.0, 250.0] {
        let at = |radius: f64| {
            let angle = angle.to_radians();
            let model = carriage(&[("a", radius * angle.cos()), ("c", radius * angle.sin())]);
            solve(&model).unwrap()
        };
        for radius in [0.05, 0.15, 0.199] {
            let report = at(radius);
            let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
            let expected = 10.0 / (1.0 - 5.0 * radius);
            assert!(close(solution.drives[0].effort, expected, expected), "{}", text(&report));
            assert_eq!(report.complete, Proof::Proven);
            // Whether or not the force along z vanishes, it is no boundary.
            assert_eq!(solution.attainability.verdict, Verdict::Attainable, "{angle}\n{}", text(&report));
        }
        assert!(at(0.201).solutions.is_empty(), "{angle}");
    }
    let report =
        limits(&carriage(&[("a", 0.16)]), &LimitsOptions::new("c=0 m..0.2 m".parse().unwrap())).unwrap();
    let answer = report.text(Style::PLAIN);
    assert!(answer.contains("It jams from c = 0.12 m on"), "{answer}");
}

/// The same: `P/Q = [1 - k^2 p.q +- k sqrt(|p-q|^2 - k^2 (p x q)^2)]/(1 - k^2 p^2)` with `P >= Q`; beyond the radius two
/// solutions where the load is farther out and the line through both passes the rod within it, else none.
#[test]
fn all_solutions_of_a_round_rod_are_those_of_the_closed_form() {
    let (k, mut counts) = (5.0_f64, [0; 3]);
    let mut random = Random(0x1234_5678_9abc_def1);
    for _ in 0..150 {
        let [a, c] = [0; 2].map(|_| random.between(-0.25, 0.25));
        let [qa, qc] = [0; 2].map(|_| random.between(-0.5, 0.5));
        let report = solve(&carriage(&[("a", a), ("c", c), ("qa", qa), ("qc", qc)])).unwrap();
        let (p2, cross) = (a * a + c * c, a * qc - c * qa);
        let root = ((a - qa).powi(2) + (c - qc).powi(2) - (k * cross).powi(2)).sqrt();
        let both = [1.0, -1.0]
            .map(|sign| 10.0 * (1.0 - k * k * (a * qa + c * qc) + sign * k * root) / (1.0 - k * k * p2));
        let expected: Vec<f64> = both.into_iter().filter(|pull| *pull >= 10.0).collect();
        assert_eq!(report.solutions.len(), expected.len(), "{a} {c} {qa} {qc}\n{}", text(&report));
        for pull in &expected {
            let is_it = |solution: &Solution| close(solution.drives[0].effort, *pull, 10.0 * pull);
            assert!(report.solutions.iter().any(is_it), "{pull}\n{}", text(&report));
        }
        assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
        counts[expected.len()] += 1;
    }
    assert!(counts.iter().all(|count| *count > 3), "{counts:?}");
}

/// A rod alone keeps nothing from turning about it; keys for faces say what they are in the way of.
#[test]
fn what_a_rod_does_not_carry_or_know_is_named() {
    let message = |text: &str| try_report_on(text).unwrap_err().to_string();
    let free = message(&CARRIAGE.replace("carries = [\"roll\"]\n", ""));
    assert!(free.contains("nothing keeps carriage from turning about the rod of rod"), "{free}");
    for key in ["height = 0.01", "play = 0.001", "preload = 2", "loose = true"] {
        let both =
            message(&CARRIAGE.replace("carries = [\"roll\"]", &format!("carries = [\"roll\"]\n{key}")));
        let name = key.split_once(' ').unwrap().0;
        assert!(both.contains("section = \"round\"") && both.contains(name), "{key}: {both}");
    }
}

/// Three bushings on a rod are three springs: the middle one at half of the distance of the others carries a third of a load at
/// the middle.
#[test]
fn three_bushings_on_a_rod_share_a_load() {
    let three = CARRIAGE
        .replace("mu = \"mu\"\n", "mu = 0.1\nstiffness = 1e6\n")
        .replace("carries = [\"roll\"]", "carries = [\"roll\"]\nsupports.middle = { at = 0 }")
        .replace("components = [-10, 0, 0]", "components = [0, 12, -9]")
        .replace("a = 0.05", "a = 0")
        .replace("c = 0.06", "c = 0");
    let report = report_on(&three);
    let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
    // Of 15 N 5 N each, which rub with 0.5 N.
    for end in ["front", "rear", "middle"] {
        let name = format!("rod.{end}");
        let end = solution.round_ends.iter().find(|end| end.name == name).unwrap();
        assert!(
            close(end.normal_force, 5.0, 5.0) && close(end.friction_force, 0.5, 5.0),
            "{}",
            text(&report)
        );
        assert!(close(end.direction, 9.0_f64.atan2(-12.0), 1.0), "{}", text(&report));
    }
    assert!(close(solution.drives[0].effort, 1.5, 5.0), "{}", text(&report));
    assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
}

/// Numbers that look random, from 0 to 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, greatest: f64) -> f64 {
        // Written and read as it is.
        let value = least + (greatest - least) * self.next();
        (value * 1e6).round() / 1e6
    }
}

/// A carriage on a rod of a turntable, with a rough key beside it; both are driven.
struct Turntable {
    at: [f64; 3],
    angle: f64,
    mu: [f64; 3],
    key: [f64; 3],
    centre: [f64; 3],
    mass: f64,
    moment: f64,
    products: [f64; 2],
    gravity: [f64; 3],
    load: [[f64; 3]; 3],
    pull: [f64; 3],
    rates: [f64; 2],
    accelerations: [f64; 2],
}

/// Half of the distance of both ends.
const HALF: f64 = 0.15;

impl Turntable {
    fn random(random: &mut Random) -> Self {
        let mut three = |size: f64| [0; 3].map(|_| random.between(-size, size));
        let (at, centre, pull) = (three(0.3), three(0.3), three(0.4));
        let (gravity, load) = (three(10.0), [three(0.4), three(60.0), three(5.0)]);
        let sign = if random.next() < 0.5 { -1.0 } else { 1.0 };
        Self {
            at,
            angle: random.between(-180.0, 180.0),
            mu: [0; 3].map(|_| random.between(0.05, 1.0)),
            key: [random.between(-0.1, 0.1), random.between(0.1, 0.3), random.between(60.0, 120.0)],
            centre,
            mass: random.between(0.5, 5.0),
            moment: random.between(0.05, 0.2),
            products: [random.between(-0.02, 0.02), random.between(-0.02, 0.02)],
            gravity,
            load,
            pull,
            rates: [random.between(-4.0, 4.0), sign * random.between(0.1, 1.0)],
            accelerations: [random.between(-5.0, 5.0), random.between(-5.0, 5.0)],
        }
    }

    fn text(&self) -> String {
        let place = |[x, y, z]: [f64; 3]| format!("[{x}, {y}, {z}]");
        let [along, aside, phi] = self.key;
        format!(
            "gravity = {gravity}\n[points]\nO = [0, 0]\nC = {centre}\nL = {at}\nP = {pull}\n\
             [bodies.table]\npoints = [\"O\"]\nmass = 1\nmoment_of_inertia = 1\ncentre_of_mass = [0, 0]\n\
             [bodies.carriage]\npoints = [\"C\", \"L\", \"P\"]\nmass = {mass}\nmoment_of_inertia = {moment}\n\
             centre_of_mass = \"C\"\nproducts_of_inertia = [{dx}, {dy}]\n\
             [joints.pivot]\ntype = \"hinge\"\nbetween = [\"table.O\", \"ground.O\"]\n\
             [joints.g]\ntype = \"block_slider\"\nsection = \"round\"\nblock = \"carriage\"\nguide = \"table\"\n\
             at = {middle}\nalong = \"{angle} deg\"\nlength = {length}\nmu = {front}\nrear = {{ mu = {rear} }}\n\
             supports.key = {{ at = {along}, aside = {aside}, normal = \"{phi} deg\", mu = {key} }}\n\
             [loads.f]\ntype = \"force\"\nat = \"carriage.L\"\ncomponents = {force}\n\
             [loads.m]\ntype = \"torque\"\nbody = \"carriage\"\nmoments = {moments}\n\
             [drives.turn]\ncoordinate = \"phi\"\nacceleration = {alpha}\ntorque = {{ body = \"table\" }}\n\
             [drives.push]\ncoordinate = \"s\"\nacceleration = {s}\n\
             force = {{ at = \"carriage.P\", direction = \"{angle} deg\", reaction = \"table\" }}\n\
             [coordinates.phi]\nrotation = \"table\"\nrate = {omega}\n[coordinates.s]\nslide = \"g\"\nrate = {v}\n",
            gravity = place(self.gravity),
            centre = place(self.centre),
            at = place(self.load[0]),
            force = place(self.load[1]),
            moments = place(self.load[2]),
            pull = place(self.pull),
            middle = place(self.at),
            mass = self.mass,
            moment = self.moment,
            dx = self.products[0],
            dy = self.products[1],
            angle = self.angle,
            length = 2.0 * HALF,
            front = self.mu[0],
            rear = self.mu[1],
            key = self.mu[2],
            alpha = self.accelerations[0],
            s = self.accelerations[1],
            omega = self.rates[0],
            v = self.rates[1],
        )
    }

    /// Newton's and Euler's equations of the carriage about its mass centre in space, with its whole tensor of inertia: a
    /// column of wrenches for each of N_n, N_z in front, at the rear, N of the key with this side, and the push; one for each
    /// |N| of both ends; and what they balance.
    fn equations(&self, side: f64) -> (Matrix6<f64>, [Vector6<f64>; 2], Vector6<f64>) {
        let angle = self.angle.to_radians();
        let u = Vector3::new(angle.cos(), angle.sin(), 0.0);
        let (z, n) = (Vector3::z(), Vector3::z().cross(&u));
        let [omega, v] = self.rates;
        let [alpha, s] = self.accelerations;
        let centre = Vector3::from(self.centre);
        let in_plane = Vector3::new(centre.x, centre.y, 0.0);
        let (spin, turning) = (z * omega, z * alpha);
        let acceleration = turning.cross(&in_plane)
            + spin.cross(&spin.cross(&in_plane))
            + 2.0 * spin.cross(&(u * v))
            + u * s;
        // I_xz = -int x z dm; what does not multiply a rotation about z is left out.
        let of_spin = Vector3::new(-self.products[0], -self.products[1], self.moment);
        let momentum = of_spin * alpha + spin.cross(&(of_spin * omega));
        let [at, force, couple] = self.load.map(Vector3::from);
        let wrench = |force: Vector3<f64>, moment: Vector3<f64>| {
            Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
        };
        let balanced = wrench(
            (acceleration - Vector3::from(self.gravity)) * self.mass - force,
            momentum - (at - centre).cross(&force) - couple,
        );
        let at = |force: Vector3<f64>, place: Vector3<f64>| wrench(force, (place - centre).cross(&force));
        let middle = Vector3::from(self.at);
        let ends = [middle + u * HALF, middle - u * HALF];
        let friction = |mu: f64| -u * (v.signum() * mu);
        let [along, aside, phi] = self.key;
        let normal = n * phi.to_radians().cos() + z * phi.to_radians().sin();
        let key = at(normal + friction(self.mu[2]) * side, middle + u * along + n * aside);
        let [front, rear] = ends;
        let columns =
            [at(n, front), at(z, front), at(n, rear), at(z, rear), key, at(u, Vector3::from(self.pull))];
        let rubbing = [at(friction(self.mu[0]), front), at(friction(self.mu[1]), rear)];
        (Matrix6::from_columns(&columns), rubbing, balanced)
    }

    /// All solutions (N_n, N_z in front, the same at the rear, N of the key, push): for each side of the key the forces are affine
    /// in the magnitudes at both ends, and Newton's method finds the magnitudes that are their own from many starts. None if
    /// something is about to change.
    fn by_brute_force(&self) -> Option<Vec<Vector6<f64>>> {
        let mut found: Vec<Vector6<f64>> = Vec::new();
        for side in [1.0, -1.0] {
            let (matrix, rubbing, balanced) = self.equations(side);
            let lu = matrix.lu();
            let (given, slopes) = (lu.solve(&balanced)?, rubbing.map(|one| -lu.solve(&one).unwrap()));
            let forces = |w: [f64; 2]| given + slopes[0] * w[0] + slopes[1] * w[1];
            let scale = given.amax();
            let start = |index: u32| scale * 10.0_f64.powf(f64::from(index) * 0.25 - 2.5);
            for starts in 0..24 * 24_u32 {
                let mut w = [start(starts / 24), start(starts % 24)];
                for _ in 0..60 {
                    let x = forces(w);
                    let error = [0, 1].map(|end| x[2 * end].hypot(x[2 * end + 1]) - w[end]);
                    let slope = |end: usize, by: usize| {
                        let [n, z] = [x[2 * end], x[2 * end + 1]];
                        let of_length = (n * slopes[by][2 * end] + z * slopes[by][2 * end + 1]) / n.hypot(z);
                        of_length - f64::from(u8::from(end == by))
                    };
                    let [[a, b], [c, d]] = [0, 1].map(|end| [0, 1].map(|by| slope(end, by)));
                    let determinant = a * d - b * c;
                    w[0] -= (d * error[0] - b * error[1]) / determinant;
                    w[1] -= (a * error[1] - c * error[0]) / determinant;
                }
                let x = forces(w);
                let error = |end: usize| (x[2 * end].hypot(x[2 * end + 1]) - w[end]).abs();
                let is_met = error(0).max(error(1)) < 1e-10 * x.amax();
                if !is_met {
                    continue;
                }
                if x[4].abs() < 1e-6 * x.amax() {
                    return None;
                }
                let is_known = |known: &Vector6<f64>| (known - x).amax() < 1e-6 * x.amax();
                if x[4] * side > 0.0 && !found.iter().any(is_known) {
                    found.push(x);
                }
            }
        }
        Some(found)
    }
}

/// All solutions of a model, without margins.
fn listed(text: &str) -> SolveReport {
    let options = SolveOptions::default().margins(false);
    solve_with(&Model::parse(text).unwrap(), &options, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// 60 random carriages on rods: neither method finds a solution that the other does not.
#[test]
fn random_carriages_on_rods_have_the_solutions_of_newton_and_euler() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let (mut compared, mut several, mut none) = (0, 0, 0);
    while compared < 60 {
        let turntable = Turntable::random(&mut random);
        let Some(expected) = turntable.by_brute_force() else { continue };
        let model = turntable.text();
        let report = listed(&model);
        assert_eq!(report.complete, Proof::Proven, "{:?}\n{model}", report.open);
        assert_eq!(report.solutions.len(), expected.len(), "{}\n{model}", text(&report));
        let names = ["g.front", "g.front.z", "g.rear", "g.rear.z", "g.key"];
        for answer in &expected {
            let scale = answer.amax();
            let is_it = |solution: &&Solution| {
                let mut forces = names.iter().zip(answer.iter());
                forces
                    .all(|(name, force)| (contact(solution, name).normal_force - force).abs() < 1e-7 * scale)
            };
            let solution = report.solutions.iter().find(is_it);
            let solution = solution.unwrap_or_else(|| panic!("{answer}\n{}\n{model}", text(&report)));
            let push = solution.drives.iter().find(|drive| drive.name == "push").unwrap();
            assert!((push.effort - answer[5]).abs() < 1e-7 * scale);
            assert!(solution.residual < 1e-9, "{}", solution.residual);
        }
        compared += 1;
        several += usize::from(expected.len() > 1);
        none += usize::from(expected.is_empty());
    }
    assert!(several > 0 && none > 3, "{several} with several solutions, {none} with none");
}

/// [`CARRIAGE`] without its drive, with a pull of 1 N along a line of its own, at rest.
fn resting(values: &[(&str, f64)], load: [f64; 3], pull: [f64; 3]) -> Model {
    let list = |[x, y, z]: [f64; 3]| format!("[{x}, {y}, {z}]");
    let drive = CARRIAGE.find("[drives.pull]").unwrap()..CARRIAGE.find("[coordinates.x]").unwrap();
    let text = CARRIAGE
        .replace(&CARRIAGE[drive], "")
        .replace("components = [-10, 0, 0]", &format!("components = {}", list(load)));
    let text = format!(
        "{text}\n[loads.pull]\ntype = \"force\"\nat = \"carriage.pull\"\ncomponents = {}\n",
        list(pull)
    );
    let settings =
        values.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value.to_string()));
    Model::parse(&text).unwrap().with(&settings).unwrap()
}

/// Theory of loads in space, section 5: a load along a round rod alone, `e` beside it, is held from `mu = L/(2 e)` on,
/// whatever its direction; reference `z-axis.toml` has 0.7022 for 120 mm and (80, 30) mm.
#[test]
fn a_load_beside_a_round_rod_holds_itself_from_its_closed_form_on() {
    let tool = |mu: f64| {
        let mut text = CARRIAGE.replace("length = 0.1", "length = 0.12");
        text.replace_range(text.find("[drives.pull]").unwrap()..text.find("[coordinates.x]").unwrap(), "");
        let settings = [("mu", mu), ("qa", 0.08), ("qc", 0.03)]
            .iter()
            .fold(Settings::default(), |all, (name, value)| all.parameter(name, value.to_string()));
        Model::parse(&text).unwrap().with(&settings).unwrap()
    };
    let at = 0.12 / 2.0 / 0.08_f64.hypot(0.03);
    assert!((at - 0.7022).abs() < 5e-5);
    for (mu, holds) in [(0.15, false), (0.7, false), (0.703, true), (0.9, true)] {
        let report = hold(&tool(mu), &HoldOptions::default()).unwrap();
        assert_eq!(report.holds, holds, "{mu}\n{}", report.text(Style::PLAIN));
        assert_eq!(report.undecided, 0, "{mu}");
        let threshold = &report.friction.as_ref().unwrap().threshold;
        assert!(close(threshold.value.unwrap() * mu, at, 1e3), "{mu}: {threshold:?}");
        let front = threshold.coefficients.iter().find(|one| one.contact == "rod.front").unwrap();
        assert!(close(front.mu_static[0], at, 1e3), "{threshold:?}");
        // The mass centre is on the rod: its acceleration presses no end.
        for release in &report.releases {
            let expected = -5.0 * (1.0 - mu / at);
            let found = release.coordinates[0].acceleration.least.unwrap();
            assert!(close(found, expected, 10.0), "{mu}: {found}");
        }
        assert_eq!(report.releases.len(), usize::from(!holds), "{}", report.text(Style::PLAIN));
    }
}

/// The same for any loads: both ends press as statics says, so that it holds exactly where the force along the rod is at most
/// `mu (|x_1| + |x_2|)`, which factors of one load may do in several ranges.
#[test]
fn rest_on_a_round_rod_is_that_of_the_forces_across_it() {
    let mut random = Random(0x9d2c_5680_1234_5679);
    let (mut several, mut bounded) = (0, 0);
    for case in 0..40 {
        let mu = random.between(0.05, 1.2);
        let [a, c, qa, qc] = [0; 4].map(|_| random.between(-0.2, 0.2));
        let [load, pull] = [0; 2].map(|_| [0; 3].map(|_| random.between(-10.0, 10.0)));
        let values = [("mu", mu), ("a", a), ("c", c), ("qa", qa), ("qc", qc)];
        let model = resting(&values, load, pull);
        let report = hold(&model, &HoldOptions::default().load("pull")).unwrap();
        // Moments about z and y of the forces on the carriage, and with them both ends at x = L/2 and -L/2.
        let slack = |factor: f64| {
            let sum = |of: &dyn Fn([f64; 3], [f64; 2]) -> f64| of(load, [qa, qc]) + factor * of(pull, [a, c]);
            let across = [sum(&|f, _| f[1]), sum(&|f, _| f[2])];
            let couple = [sum(&|f, at| -at[0] * f[0]), sum(&|f, at| -at[1] * f[0])];
            let end = |sign: f64| {
                let [n, z] = [0, 1].map(|axis| -across[axis] / 2.0 - sign * couple[axis] / 0.1);
                n.hypot(z)
            };
            mu * (end(1.0) + end(-1.0)) - sum(&|f, _| f[0]).abs()
        };
        let of_load = report.load.as_ref().unwrap();
        assert_eq!((of_load.undecided, report.undecided), (0, 0), "{case}");
        let is_held = |factor: f64| {
            of_load.held.iter().any(|range| {
                range.least.is_none_or(|least| least <= factor)
                    && range.greatest.is_none_or(|greatest| factor <= greatest)
            })
        };
        for factor in (-400..=400).map(|step| f64::from(step) / 40.0) {
            let slack = slack(factor);
            assert!(slack.abs() < 1e-7 || is_held(factor) == (slack > 0.0), "{case}: {factor} {slack}");
        }
        for range in &of_load.held {
            for end in [range.least, range.greatest].into_iter().flatten() {
                assert!(slack(end).abs() < 1e-7 * (1.0 + end.abs()) * 100.0, "{case}: {end} {}", slack(end));
            }
        }
        assert_eq!(report.holds, slack(1.0) > 0.0, "{case}");
        several += usize::from(of_load.held.len() > 1);
        bounded += usize::from(of_load.held.len() == 1);
    }
    assert!(several > 2 && bounded > 2, "{several} {bounded}");
}
