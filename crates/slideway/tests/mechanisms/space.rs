//! Loads in space: `reference/space.toml`, closed forms, random carriages on turntables against equations of their own, and
//! planar mechanisms in space.

use crate::answers::{contact, report_on, try_report_on};
use nalgebra::{Matrix6, Vector3, Vector6};
use serde::Deserialize;
use slideway::fault::FaultKind;
use slideway::gallery;
use slideway::limits::{LimitsOptions, limits};
use slideway::model::{Model, Settings};
use slideway::motion::{End, History, SimulateOptions, simulate};
use slideway::report::{Proof, Report, SolveReport, Style};
use slideway::solve::{SolveOptions, solve, solve_with};
use slideway::standstill::{HoldOptions, Range, hold};
use std::fmt::Write as _;
use std::ops::ControlFlow;

pub(crate) const REFERENCE: &str = include_str!("../../../../reference/space.toml");

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
    #[serde(rename = "J")]
    moment: f64,
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
    mu: f64,
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
    #[serde(default)]
    one_sided: bool,
    mu: Option<f64>,
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
    /// Whether its guides have faces alone, which is what a block slider has.
    fn has_faces_alone(&self) -> bool {
        self.bodies.len() == 1 && self.joints.iter().all(|joint| joint.kind == "flat")
    }

    /// The contacts with their labels and friction: the two ends of the block first.
    fn contacts(&self) -> Vec<(String, &Flat, f64)> {
        let of_joint = |joint: &'_ Joint| joint.mu;
        let all = self.joints.iter().flat_map(|joint| {
            joint.contacts.iter().map(move |one| {
                (format!("{}.{}", joint.name, one.name), one, one.mu.unwrap_or(of_joint(joint)))
            })
        });
        let mut all: Vec<_> = all.collect();
        let front = all.iter().position(|(_, one, _)| one.along > 0.0).unwrap();
        let front = all.remove(front);
        let rear = all.iter().position(|(_, one, _)| one.along < 0.0).unwrap();
        let rear = all.remove(rear);
        [front, rear].into_iter().chain(all).collect()
    }

    /// The model, and for each label the name of the contact in it.
    fn model(&self) -> (String, Vec<String>) {
        let (body, contacts) = (&self.bodies[0], self.contacts());
        let place = |[x, y, z]: [f64; 3]| format!("[{x}, {y}, {z}]");
        let mut text = format!(
            "gravity = {}\n[points]\nC = {}\n",
            place(self.gravity),
            place([body.pose[0], body.pose[1], body.z])
        );
        let mut points = vec!["\"C\"".to_owned()];
        for (index, load) in self.loads.iter().enumerate() {
            writeln!(text, "L{index} = {}", place(load.at)).unwrap();
            points.push(format!("\"L{index}\""));
        }
        writeln!(
            text,
            "P = {}\n[bodies.c]\npoints = [{}, \"P\"]",
            place(self.drives[0].at.unwrap()),
            points.join(", ")
        )
        .unwrap();
        // A cube of this moment of inertia about each axis.
        let side = (6.0 * body.moment / body.m).sqrt();
        writeln!(
            text,
            "mass = {}\nshape = {{ box = [{side}, {side}, {side}] }}\ncentre_of_mass = \"C\"",
            body.m
        )
        .unwrap();
        let length = contacts[0].1.along - contacts[1].1.along;
        writeln!(text, "[joints.g]\ntype = \"block_slider\"\nblock = \"c\"\nat = [0, 0, 0]\nalong = 0\nlength = {length}\nmu = 0").unwrap();
        let table = |(_, one, mu): &(String, &Flat, f64)| {
            let normal = if one.phi == 0.0 {
                String::new()
            } else {
                format!(", normal = \"{} deg\"", one.phi.to_degrees())
            };
            let one_sided = if one.one_sided { ", one_sided = true" } else { "" };
            format!("aside = {}, mu = {mu}{normal}{one_sided}", one.aside)
        };
        writeln!(text, "front = {{ {} }}\nrear = {{ {} }}", table(&contacts[0]), table(&contacts[1]))
            .unwrap();
        let mut names =
            vec![(contacts[0].0.clone(), "g.front".to_owned()), (contacts[1].0.clone(), "g.rear".to_owned())];
        let mut supports = Vec::new();
        for (index, support) in contacts[2..].iter().enumerate() {
            supports.push(format!("s{index} = {{ at = {}, {} }}", support.1.along, table(support)));
            names.push((support.0.clone(), format!("g.s{index}")));
        }
        writeln!(text, "supports = {{ {} }}", supports.join(", ")).unwrap();
        for (index, load) in self.loads.iter().enumerate() {
            writeln!(
                text,
                "[loads.l{index}]\ntype = \"force\"\nat = \"c.L{index}\"\ncomponents = {}",
                place(load.force)
            )
            .unwrap();
        }
        writeln!(text, "[drives.d]\ncoordinate = \"x\"\nforce = {{ at = \"c.P\", direction = 0 }}").unwrap();
        writeln!(text, "[coordinates.x]\nslide = \"g\"\nrate = {}", body.vel[0]).unwrap();
        let name = |label: &String| names.iter().find(|(other, _)| other == label).unwrap().1.clone();
        (text, self.labels.iter().map(name).collect())
    }
}

/// The names of the cases that are compared here.
pub(crate) fn compared() -> Vec<String> {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    reference.case.into_iter().filter(Case::has_faces_alone).map(|case| case.name).collect()
}

fn text(report: &SolveReport) -> String {
    report.text(Style::PLAIN)
}

fn close(found: f64, expected: f64, scale: f64) -> bool {
    (found - expected).abs() <= 1e-9 * scale
}

/// `reference/space.toml`: by an independent formulation in six degrees of freedom, and closed forms.
#[test]
fn the_reference_cases_have_their_solutions() {
    let reference: Reference = toml::from_str(REFERENCE).unwrap();
    let mut compared = 0;
    for case in reference.case.iter().filter(|case| case.has_faces_alone()) {
        let (model, names) = case.model();
        let report = report_on(&model);
        // The file has the states in which nothing lifts off.
        let lifts = |contact: &slideway::report::Contact| contact.gap_acceleration.is_some();
        let stays = report.solutions.iter().filter(|solution| !solution.contacts.iter().any(lifts));
        assert_eq!(stays.count(), case.count, "{}\n{}", case.name, text(&report));
        assert_eq!(report.complete, Proof::Proven, "{}: {:?}", case.name, report.open);
        for expected in &case.solution {
            let solution = report
                .solutions
                .iter()
                .find(|solution| (solution.oriented_determinant - expected.p).abs() < 1e-9);
            let solution = solution.unwrap_or_else(|| panic!("{}\n{}", case.name, text(&report)));
            let scale = expected.normal.iter().map(|force| force.abs()).fold(1.0, f64::max);
            // The numbers of the file have twelve digits.
            for (name, force) in names.iter().zip(&expected.normal) {
                assert!(close(contact(solution, name).normal_force, *force, scale), "{}: {name}", case.name);
            }
            assert!(close(solution.drives[0].effort, expected.effort[0], scale), "{}", case.name);
            assert!(solution.residual < 1e-12, "{}: {}", case.name, solution.residual);
        }
        compared += 1;
    }
    assert_eq!(compared, 11);
}

const GUIDE: &str = include_str!("four-sided-guide.toml");

/// Theory of loads in space, section 5: faces at right angles lock where `|a| + |c| = L/(2 mu)`, here 0.1 m/(2 0.25) = 0.2 m,
/// which is the rule of catalogues of profile rails. A couple of 0.3 N m keeps the key pressed.
#[test]
fn a_four_sided_guide_locks_where_the_distances_add_up() {
    let model = Model::parse(&GUIDE.replace("twist = 0 ", "twist = 0.3 ")).unwrap();
    let report = limits(&model, &LimitsOptions::new("a=1 mm..300 mm".parse().unwrap())).unwrap();
    let answer = report.text(Style::PLAIN);
    assert!(answer.contains("It jams from a = 140 mm on"), "{answer}");
    assert!(answer.contains("Proven"), "{answer}");
    let model = Model::parse(GUIDE).unwrap();
    for c in [0.0_f64, 0.09, -0.12] {
        let end = 0.2 - c.abs();
        for (a, moves) in [(end * 0.999, true), (end * 1.001, false), (-end * 1.001, false)] {
            let settings = Settings::default().parameter("a", a.to_string()).parameter("c", c.to_string());
            let report = solve(&model.with(&settings).unwrap()).unwrap();
            assert_eq!(report.solutions.len(), usize::from(moves), "c = {c}, a = {a}\n{}", text(&report));
        }
    }
}

/// The same guide at a speed: `P = Q/(1 - 2 mu (|a| + |c|)/L)`.
#[test]
fn the_pull_follows_the_closed_form() {
    let model = Model::parse(GUIDE).unwrap();
    for (a, c) in [(0.05, 0.06), (-0.03, 0.1), (0.1, -0.08)] {
        let settings = Settings::default().parameter("a", a.to_string()).parameter("c", c.to_string());
        let report = solve(&model.with(&settings).unwrap()).unwrap();
        let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
        let expected = 10.0 / (1.0 - 2.0 * 0.25 * (f64::abs(a) + f64::abs(c)) / 0.1);
        assert!(close(solution.drives[0].effort, expected, expected), "{}", text(&report));
    }
}

/// `P = mu_s W (1 - k y_W)/(1 - k a)`, `k = 2 mu/L`, on three or four supports that stay pressed: 19.178571 N.
#[test]
fn a_drawer_on_runners_needs_the_same_pull_on_three_and_four_corners() {
    let drawer = include_str!("drawer-on-runners.toml");
    let rear = "supports.rear_middle = { at = -0.2,";
    let corners = ["left = { at = -0.2, aside = 0.25,", "right = { at = -0.2, aside = -0.25,"];
    let line = drawer.lines().find(|line| line.starts_with(rear)).unwrap();
    let lines = corners.map(|corner| line.replace(rear, &format!("supports.rear_{corner}")));
    let four = drawer.replace(line, &lines.join("\n"));
    for text_of_model in [drawer, &four] {
        let report = report_on(text_of_model);
        let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
        assert!(close(solution.drives[0].effort, 15.0 * 0.895 / 0.7, 20.0), "{}", text(&report));
        assert!(solution.residual < 1e-12);
    }
    // Four equal springs, with the numbers of a prototype by stiffness equations.
    let report = report_on(&four);
    let solution = &report.solutions[0];
    let corners = ["front_left", "front_right", "rear_left", "rear_right"];
    for (corner, expected) in corners.into_iter().zip([18.4192, 10.0192, 19.9808, 11.5808]) {
        let force = contact(solution, &format!("guide.{corner}")).normal_force;
        assert!((force - expected).abs() < 5e-5, "{corner}: {force}\n{}", text(&report));
    }
}

/// What nothing carries is named, and so are joints that are not known in space.
#[test]
fn what_is_not_carried_is_named() {
    let drawer = include_str!("drawer-on-runners.toml");
    let without = |names: &[&str]| {
        let kept = drawer
            .lines()
            .filter(|line| !names.iter().any(|name| line.starts_with(&format!("supports.{name} "))));
        kept.collect::<Vec<_>>().join("\n")
    };
    let message = |text: &str| try_report_on(text).unwrap_err().to_string();
    let left = without(&["rear_middle"]);
    assert!(message(&left).contains("nothing keeps drawer from pitching on guide"), "{}", message(&left));
    let line = without(&["front_right", "front_left"])
        .replace("length = 0.4", "length = 0.4\ncarries = [\"z\", \"pitch\"]");
    let line = line.lines().filter(|line| !line.starts_with("supports.")).collect::<Vec<_>>().join("\n");
    let expected = "nothing keeps drawer from rolling about the direction of guide";
    assert!(message(&line).contains(expected), "{}", message(&line));
    let none = drawer.lines().filter(|line| !line.starts_with("supports.")).collect::<Vec<_>>().join("\n");
    assert!(
        message(&none).contains("nothing keeps drawer from moving out of the drawing"),
        "{}",
        message(&none)
    );
    let faults = try_report_on(&left).unwrap_err();
    assert!(faults.sorted().iter().any(|fault| matches!(fault.kind, FaultKind::NotCarried { .. })));
}

/// A closed loop has three reactions too many (theory of loads in space, section 2); with hinges that carry less it moves as in
/// the plane.
#[test]
fn a_closed_loop_carries_too_much() {
    let body = |name: &str, from: &str, to: &str| {
        format!(
            "[bodies.{name}]\npoints = [\"{from}\", \"{to}\"]\nmass = 1\nshape = {{ bar = [\"{from}\", \"{to}\"] }}\n"
        )
    };
    let hinge = |name: &str, first: &str, second: &str, carries: &str| {
        format!(
            "[joints.{name}]\ntype = \"hinge\"\nbetween = [\"{first}.{name}\", \"{second}.{name}\"]\ncarries = \"{carries}\"\n"
        )
    };
    let four_bar = |carries: [&str; 4]| {
        let hinges = [
            ("A", "crank", "ground"),
            ("B", "crank", "coupler"),
            ("C", "coupler", "rocker"),
            ("D", "rocker", "ground"),
        ];
        let hinges = hinges
            .into_iter()
            .zip(carries)
            .map(|((name, first, second), one)| hinge(name, first, second, one));
        "gravity = [0, -9.81, 2]\n[points]\nA = [0, 0]\nB = [0.1, 0.2]\nC = [0.4, 0.25]\nD = [0.5, 0]\n"
            .to_owned()
            + &body("crank", "A", "B")
            + &body("coupler", "B", "C")
            + &body("rocker", "C", "D")
            + &hinges.collect::<String>()
            + "[coordinates.phi]\nrotation = \"crank\"\nrate = 1\n"
    };
    let message = |carries: [&str; 4]| try_report_on(&four_bar(carries)).unwrap_err().to_string();
    assert!(message(["all"; 4]).contains("3 of their reactions are too many"), "{}", message(["all"; 4]));
    let open = ["all", "all", "nothing", "all"];
    let report = report_on(&four_bar(open));
    let planar = four_bar(open)
        .replace(", 2]", "]")
        .replace("carries = \"all\"\n", "")
        .replace("carries = \"nothing\"\n", "");
    let [planar, report] =
        [report_on(&planar), report].map(|report| report.solutions[0].coordinates[0].acceleration);
    assert!(close(report, planar, planar.abs()), "{report} {planar}");
    // The coupler turns about the line of its hinges.
    let line = message(["all", "z", "z", "all"]);
    assert!(line.contains("nothing keeps coupler from turning about a line in the drawing"), "{line}");
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

/// A contact of a random carriage.
struct Pressed {
    along: f64,
    aside: f64,
    z: f64,
    phi: f64,
    mu: [f64; 2],
}

/// A carriage on a turntable, both driven.
struct Turntable {
    at: [f64; 2],
    angle: f64,
    height: f64,
    contacts: Vec<Pressed>,
    centre: [f64; 3],
    mass: f64,
    moment: f64,
    products: [f64; 2],
    gravity: [f64; 3],
    load: ([f64; 3], [f64; 3], [f64; 3]),
    pull: [f64; 3],
    rates: [f64; 2],
    accelerations: [f64; 2],
}

impl Turntable {
    fn random(random: &mut Random) -> Self {
        let mut three = |size: f64| [0; 3].map(|_| random.between(-size, size));
        let (centre, gravity, load) = (three(0.3), three(10.0), (three(0.4), three(60.0), three(5.0)));
        let (pull, middle) = (three(0.2), three(0.5));
        let mut contact = |along: f64| Pressed {
            along,
            aside: random.between(-0.2, 0.2),
            z: random.between(-0.2, 0.2),
            phi: random.between(-180.0, 180.0),
            mu: [random.between(0.0, 0.8), random.between(0.0, 0.8)],
        };
        let mut contacts = vec![contact(0.15), contact(-0.15)];
        contacts.extend([0.12, -0.03, -0.11].map(contact));
        let sign = if random.next() < 0.5 { -1.0 } else { 1.0 };
        Self {
            at: [middle[0], middle[1]],
            angle: random.between(-180.0, 180.0),
            height: random.between(0.0, 0.05),
            contacts,
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
        let table = |one: &Pressed| {
            format!(
                "aside = {}, z = {}, height = {}, normal = \"{} deg\", mu = {{ plus = {}, minus = {} }}",
                one.aside, one.z, self.height, one.phi, one.mu[0], one.mu[1]
            )
        };
        let supports = self.contacts[2..].iter().zip(["a", "b", "c"]);
        let supports =
            supports.map(|(one, name)| format!("{name} = {{ at = {}, {} }}", one.along, table(one)));
        let ([force, at, moments], pull) =
            ([self.load.1, self.load.0, self.load.2].map(place), place(self.pull));
        format!(
            "gravity = {gravity}\n[points]\nO = [0, 0]\nC = {centre}\nL = {at}\nP = {pull}\n\
             [bodies.table]\npoints = [\"O\"]\nmass = 1\nmoment_of_inertia = 1\ncentre_of_mass = [0, 0]\n\
             [bodies.carriage]\npoints = [\"C\", \"L\", \"P\"]\nmass = {mass}\nmoment_of_inertia = {moment}\n\
             centre_of_mass = \"C\"\nproducts_of_inertia = [{dx}, {dy}]\n\
             [joints.pivot]\ntype = \"hinge\"\nbetween = [\"table.O\", \"ground.O\"]\n\
             [joints.g]\ntype = \"block_slider\"\nblock = \"carriage\"\nguide = \"table\"\nat = [{x}, {y}]\n\
             along = \"{angle} deg\"\nlength = 0.3\nmu = 0\nfront = {{ {front} }}\nrear = {{ {rear} }}\n\
             supports = {{ {supports} }}\n\
             [loads.f]\ntype = \"force\"\nat = \"carriage.L\"\ncomponents = {force}\n\
             [loads.m]\ntype = \"torque\"\nbody = \"carriage\"\nmoments = {moments}\n\
             [drives.turn]\ncoordinate = \"phi\"\nacceleration = {alpha}\ntorque = {{ body = \"table\" }}\n\
             [drives.push]\ncoordinate = \"s\"\nacceleration = {s}\n\
             force = {{ at = \"carriage.P\", direction = \"{angle} deg\", reaction = \"table\" }}\n\
             [coordinates.phi]\nrotation = \"table\"\nrate = {omega}\n[coordinates.s]\nslide = \"g\"\nrate = {v}\n",
            gravity = place(self.gravity),
            centre = place(self.centre),
            mass = self.mass,
            moment = self.moment,
            dx = self.products[0],
            dy = self.products[1],
            x = self.at[0],
            y = self.at[1],
            angle = self.angle,
            front = table(&self.contacts[0]),
            rear = table(&self.contacts[1]),
            supports = supports.collect::<Vec<_>>().join(", "),
            alpha = self.accelerations[0],
            s = self.accelerations[1],
            omega = self.rates[0],
            v = self.rates[1],
        )
    }

    /// All solutions, each with its normal forces and the force of the drive: Newton's and Euler's equations of the carriage
    /// about its mass centre in space, with its whole tensor of inertia, for each of the patterns.
    fn by_brute_force(&self) -> Option<Vec<Vector6<f64>>> {
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
        let [at, force, couple] = [self.load.0, self.load.1, self.load.2].map(Vector3::from);
        let gravity = Vector3::from(self.gravity);
        let known = [
            acceleration * self.mass - gravity * self.mass - force,
            momentum - (at - centre).cross(&force) - couple,
        ];
        let mut found = Vec::new();
        for pattern in 0..32_u32 {
            let mut matrix = Matrix6::zeros();
            let side = |k: usize| if pattern >> k & 1 == 0 { 1.0 } else { -1.0 };
            for (k, one) in self.contacts.iter().enumerate() {
                let phi = one.phi.to_radians();
                let normal = n * phi.cos() + z * phi.sin();
                let place =
                    Vector3::new(self.at[0], self.at[1], 0.0) + u * one.along + n * one.aside + z * one.z;
                let face = place - normal * (side(k) * self.height / 2.0);
                let mu = one.mu[usize::from(side(k) < 0.0)];
                // Per unit of N: |N| = side N.
                let friction = -u * (v.signum() * mu * side(k));
                let moment = (place - centre).cross(&normal) + (face - centre).cross(&friction);
                matrix.fixed_view_mut::<3, 1>(0, k).copy_from(&(normal + friction));
                matrix.fixed_view_mut::<3, 1>(3, k).copy_from(&moment);
            }
            let pull = Vector3::from(self.pull) - centre;
            matrix.fixed_view_mut::<3, 1>(0, 5).copy_from(&u);
            matrix.fixed_view_mut::<3, 1>(3, 5).copy_from(&pull.cross(&u));
            let side_of =
                Vector6::new(known[0].x, known[0].y, known[0].z, known[1].x, known[1].y, known[1].z);
            let answer = matrix.lu().solve(&side_of)?;
            let greatest = answer.amax();
            if (0..5).any(|k| answer[k].abs() < 1e-7 * greatest) {
                return None;
            }
            if (0..5).all(|k| answer[k] * side(k) > 0.0) {
                found.push(answer);
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

/// 300 random carriages on turntables: neither method finds a solution that the other does not.
#[test]
fn random_carriages_on_turntables_have_the_solutions_of_newton_and_euler() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let (mut compared, mut several, mut none) = (0, 0, 0);
    while compared < 300 {
        let turntable = Turntable::random(&mut random);
        let Some(expected) = turntable.by_brute_force() else { continue };
        let model = turntable.text();
        let report = listed(&model);
        assert_eq!(report.complete, Proof::Proven, "{:?}\n{model}", report.open);
        assert_eq!(report.solutions.len(), expected.len(), "{}\n{model}", text(&report));
        let names = ["g.front", "g.rear", "g.a", "g.b", "g.c"];
        for answer in &expected {
            let scale = answer.amax();
            let is_it = |solution: &&slideway::report::Solution| {
                let forces = names.iter().zip(answer.iter());
                let mut forces =
                    forces.map(|(name, force)| (contact(solution, name).normal_force - force).abs());
                forces.all(|difference| difference < 1e-8 * scale)
            };
            let solution = report.solutions.iter().find(is_it);
            let solution = solution.unwrap_or_else(|| panic!("{answer}\n{}\n{model}", text(&report)));
            let push = solution.drives.iter().find(|drive| drive.name == "push").unwrap();
            assert!((push.effort - answer[5]).abs() < 1e-8 * scale);
            assert!(solution.residual < 1e-9, "{}", solution.residual);
        }
        compared += 1;
        several += usize::from(expected.len() > 1);
        none += usize::from(expected.is_empty());
    }
    assert!(several > 10 && none > 10, "{several} with several solutions, {none} with none");
}

/// What each joint of a planar model carries in space, so that no body has more or less than it needs: those that reach a body
/// first carry all, the others nothing. None for joints that are not known in space.
fn carries(model: &toml::Table) -> Option<Vec<(String, &'static str)>> {
    let joints = model["joints"].as_table()?;
    let known = ["hinge", "block_slider", "guided_slider", "pin_in_slot"];
    let is_known = |joint: &toml::Table| {
        known.contains(&joint["type"].as_str().unwrap())
            && ["friction_radius", "radius", "loose", "play"].iter().all(|key| !joint.contains_key(*key))
    };
    if !joints.values().all(|joint| is_known(joint.as_table().unwrap())) {
        return None;
    }
    let body = |end: &str| end.split_once('.').map_or("ground", |(body, _)| body).to_owned();
    let ends = |joint: &toml::Value| -> [String; 2] {
        match joint.get("between") {
            Some(ends) => [0, 1].map(|end| body(ends[end].as_str().unwrap())),
            None => ["block", "guide"]
                .map(|key| joint.get(key).map_or("ground", |body| body.as_str().unwrap()).to_owned()),
        }
    };
    let mut reached = vec!["ground".to_owned()];
    let mut found: Vec<(String, &'static str)> = Vec::new();
    while found.len() < joints.len() {
        for (name, joint) in joints.iter().filter(|(name, _)| !name.is_empty()) {
            let ends = ends(joint);
            let of_reached = ends.iter().filter(|end| reached.contains(*end)).count();
            if of_reached == 0 || found.iter().any(|(other, _)| other == name) {
                continue;
            }
            let is_hinge = joint["type"].as_str() == Some("hinge");
            let carries = match (is_hinge, of_reached == 1) {
                (true, true) => "\"all\"",
                (true, false) => "\"nothing\"",
                (false, true) => "[\"z\", \"roll\", \"pitch\"]",
                (false, false) => "[]",
            };
            reached.extend(ends);
            found.push((name.clone(), carries));
        }
    }
    Some(found)
}

/// A planar gallery model in space: every point at a height of its own (but for the ends of hinges and springs), and weights along z, too.
/// Forces in the plane are what they were.
fn in_space(text: &str) -> Option<String> {
    let model: toml::Table = toml::from_str(text).unwrap();
    let carries = carries(&model)?;
    let tables = ["joints", "loads"].into_iter().filter_map(|section| model.get(section)?.as_table());
    let between = tables.flat_map(|entries| entries.values().filter_map(|entry| entry.get("between")));
    let level: Vec<&str> = between
        .flat_map(|ends| [0, 1].map(|end| ends[end].as_str().unwrap()))
        .map(|end| end.rsplit('.').next().unwrap())
        .collect();
    let (mut section, mut height) = (String::new(), 0.01);
    let mut spatial = String::new();
    for line in text.lines() {
        if line.starts_with('[') {
            line.trim().clone_into(&mut section);
            writeln!(spatial, "{line}").unwrap();
            let of_joint = carries.iter().find(|(name, _)| section == format!("[joints.{name}]"));
            of_joint.iter().for_each(|(_, carries)| writeln!(spatial, "carries = {carries}").unwrap());
            continue;
        }
        let (code, _) = line.split_once('#').unwrap_or((line, ""));
        match code.split_once('=') {
            Some((name, _)) if section == "[points]" => {
                let z = if level.contains(&name.trim()) { 0.0 } else { height };
                height *= -1.2;
                writeln!(spatial, "{}, {z}]", code.trim_end().strip_suffix(']')?).unwrap();
            }
            Some((name, down)) if section.is_empty() && name.trim() == "gravity" && !down.contains('[') => {
                writeln!(spatial, "gravity = [0, \"-({})\", 3]", down.trim().trim_matches('"')).unwrap();
            }
            _ => writeln!(spatial, "{line}").unwrap(),
        }
    }
    Some(spatial)
}

#[test]
fn planar_mechanisms_in_space_have_the_same_forces() {
    let mut compared = Vec::new();
    for entry in gallery::MODELS {
        let Some(spatial) = in_space(entry.text) else { continue };
        // What is refused in the plane is refused in space; what stands still needs questions of rest.
        let Ok(planar) = try_report_on(entry.text) else { continue };
        let Ok(found) = try_report_on(&spatial) else { continue };
        assert_eq!(
            found.solutions.len(),
            planar.solutions.len(),
            "{}\n{}\n{}",
            entry.name,
            text(&found),
            text(&planar)
        );
        for solution in &planar.solutions {
            let other = found.solutions.iter().find(|other| other.pattern == solution.pattern).unwrap();
            let scale =
                solution.contacts.iter().map(|contact| contact.normal_force.abs()).fold(1.0, f64::max);
            for (one, other) in solution.contacts.iter().zip(&other.contacts) {
                assert!(close(one.normal_force, other.normal_force, scale), "{}: {}", entry.name, one.name);
            }
            for (one, other) in solution.drives.iter().zip(&other.drives) {
                assert!(close(one.effort, other.effort, scale), "{}: {}", entry.name, one.name);
            }
            assert!(other.residual < 1e-9, "{}", entry.name);
        }
        compared.push(entry.name);
    }
    assert!(compared.len() >= 8, "{compared:?}");
}

/// The normal forces, the accelerations of the gaps and the force of the drive of a state.
type Lifted = ([f64; 5], [f64; 5], f64);

/// A carriage on a straight guide in ground whose contacts may lie anywhere in the cross-section, some with one face only.
struct Carriage {
    contacts: Vec<Pressed>,
    one_sided: [bool; 5],
    centre: [f64; 3],
    sides: [f64; 3],
    mass: f64,
    products: [f64; 2],
    load: ([f64; 3], [f64; 3]),
    pull: [f64; 3],
    acceleration: f64,
}

impl Carriage {
    fn random(random: &mut Random) -> Self {
        let mut three = |size: f64| [0; 3].map(|_| random.between(-size, size));
        let (centre, force, at, pull) = (three(0.1), three(60.0), three(0.2), three(0.2));
        let sides = three(0.1).map(|side| 0.2 + side);
        let mut contact = |along: f64| Pressed {
            along,
            aside: random.between(-0.2, 0.2),
            z: random.between(-0.2, 0.2),
            phi: random.between(-180.0, 180.0),
            mu: [random.between(0.0, 0.8), 0.0],
        };
        let contacts = [0.15, -0.15, 0.12, -0.03, -0.11].into_iter().map(&mut contact).collect();
        let one_sided = [0; 5].map(|_| random.next() < 0.6);
        Self {
            contacts,
            one_sided,
            centre,
            sides,
            mass: random.between(0.5, 5.0),
            products: [random.between(-0.002, 0.002), random.between(-0.002, 0.002)],
            load: (at, force),
            pull,
            acceleration: random.between(-5.0, 5.0),
        }
    }

    fn text(&self) -> String {
        let place = |[x, y, z]: [f64; 3]| format!("[{x}, {y}, {z}]");
        let table = |(one, one_sided): (&Pressed, &bool)| {
            format!(
                "aside = {}, z = {}, normal = \"{} deg\", mu = {}, one_sided = {one_sided}",
                one.aside, one.z, one.phi, one.mu[0]
            )
        };
        let all: Vec<String> = self.contacts.iter().zip(&self.one_sided).map(table).collect();
        let supports = self.contacts[2..].iter().zip(&all[2..]).zip(["a", "b", "c"]);
        let supports =
            supports.map(|((one, table), name)| format!("{name} = {{ at = {}, {table} }}", one.along));
        format!(
            "[points]\nC = {centre}\nL = {at}\nP = {pull}\n\
             [bodies.carriage]\npoints = [\"C\", \"L\", \"P\"]\nmass = {mass}\nshape = {{ box = {sides} }}\n\
             centre_of_mass = \"C\"\nproducts_of_inertia = [{dx}, {dy}]\n\
             [joints.g]\ntype = \"block_slider\"\nblock = \"carriage\"\nat = [0, 0]\nalong = 0\nlength = 0.3\nmu = 0\n\
             front = {{ {front} }}\nrear = {{ {rear} }}\nsupports = {{ {supports} }}\n\
             [loads.f]\ntype = \"force\"\nat = \"carriage.L\"\ncomponents = {force}\n\
             [drives.push]\ncoordinate = \"s\"\nacceleration = {s}\nforce = {{ at = \"carriage.P\", direction = 0 }}\n\
             [coordinates.s]\nslide = \"g\"\nrate = 0.3\n",
            centre = place(self.centre),
            at = place(self.load.0),
            pull = place(self.pull),
            mass = self.mass,
            sides = place(self.sides),
            dx = self.products[0],
            dy = self.products[1],
            front = all[0],
            rear = all[1],
            supports = supports.collect::<Vec<_>>().join(", "),
            force = place(self.load.1),
            s = self.acceleration,
        )
    }

    /// All states, each with its normal forces (0 where it is open), the accelerations of its gaps (0 where it is closed) and
    /// the force of the drive: Newton's and Euler's equations in six degrees of freedom for each of the patterns.
    fn by_brute_force(&self) -> Option<Vec<Lifted>> {
        let [width, height, depth] = self.sides.map(|side| side * side * self.mass / 12.0);
        let [dx, dy] = self.products;
        let mut inertia = Matrix6::from_diagonal_element(self.mass);
        inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&nalgebra::Matrix3::new(
            height + depth,
            0.0,
            -dx,
            0.0,
            width + depth,
            -dy,
            -dx,
            -dy,
            width + height,
        ));
        let centre = Vector3::from(self.centre);
        let wrench = |force: Vector3<f64>, at: Vector3<f64>| {
            let moment = (at - centre).cross(&force);
            Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
        };
        let load = wrench(self.load.1.into(), self.load.0.into());
        let push = wrench(Vector3::x(), self.pull.into());
        let mut found = Vec::new();
        for pattern in 0..32_u32 {
            let is_positive = |k: usize| pattern >> k & 1 == 0;
            let is_open = |k: usize| self.one_sided[k] && !is_positive(k);
            // Six accelerations, five normal forces, the force of the drive.
            let mut matrix = nalgebra::SMatrix::<f64, 12, 12>::zeros();
            let mut sides = nalgebra::SVector::<f64, 12>::zeros();
            matrix.fixed_view_mut::<6, 6>(0, 0).copy_from(&inertia);
            sides.fixed_rows_mut::<6>(0).copy_from(&load);
            let mut normals = Vec::new();
            for (k, one) in self.contacts.iter().enumerate() {
                let phi = one.phi.to_radians();
                let normal = Vector3::y() * phi.cos() + Vector3::z() * phi.sin();
                let at = Vector3::new(one.along, one.aside, one.z);
                let sign = if is_positive(k) { 1.0 } else { -1.0 };
                let mu = one.mu[0];
                let row = wrench(normal, at);
                let whole = wrench(normal - Vector3::x() * (mu * sign), at);
                matrix.fixed_view_mut::<6, 1>(0, 6 + k).copy_from(&-whole);
                if is_open(k) {
                    matrix[(6 + k, 6 + k)] = 1.0;
                } else {
                    matrix.fixed_view_mut::<1, 6>(6 + k, 0).copy_from(&row.transpose());
                }
                normals.push(row);
            }
            matrix.fixed_view_mut::<6, 1>(0, 11).copy_from(&-push);
            // The acceleration of the block's middle along the guide.
            matrix
                .fixed_view_mut::<1, 6>(11, 0)
                .copy_from(&wrench(Vector3::x(), Vector3::zeros()).transpose());
            sides[11] = self.acceleration;
            let answer = matrix.lu().solve(&sides)?;
            let motion = answer.fixed_rows::<6>(0).into_owned();
            let force = |k: usize| if is_open(k) { 0.0 } else { answer[6 + k] };
            let gap = |k: usize| if is_open(k) { normals[k].dot(&motion) } else { 0.0 };
            let margin = |k: usize| match (is_open(k), is_positive(k)) {
                (true, _) => gap(k),
                (false, true) => force(k) / 60.0,
                (false, false) => -force(k) / 60.0,
            };
            let least = (0..5).map(margin).fold(f64::INFINITY, f64::min);
            if least.abs() < 1e-6 {
                return None;
            }
            if least > 0.0 {
                found.push(([0, 1, 2, 3, 4].map(force), [0, 1, 2, 3, 4].map(gap), answer[11]));
            }
        }
        Some(found)
    }
}

/// 300 random carriages with contacts of one face anywhere in the cross-section: neither method finds a state that the other
/// does not.
#[test]
fn random_carriages_that_may_lift_off_have_the_states_of_newton_and_euler() {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let (mut compared, mut tips, mut several, mut none) = (0, 0, 0, 0);
    while compared < 300 {
        let carriage = Carriage::random(&mut random);
        let Some(expected) = carriage.by_brute_force() else { continue };
        let model = carriage.text();
        let report = listed(&model);
        assert_eq!(report.complete, Proof::Proven, "{:?}\n{model}", report.open);
        assert_eq!(report.solutions.len(), expected.len(), "{}\n{model}", text(&report));
        let names = ["g.front", "g.rear", "g.a", "g.b", "g.c"];
        for (forces, gaps, push) in &expected {
            let scale = forces.iter().fold(60.0_f64, |greatest, force| greatest.max(force.abs()));
            let is_it = |solution: &&slideway::report::Solution| {
                (0..5).all(|k| {
                    let one = contact(solution, names[k]);
                    let gap = one.gap_acceleration.unwrap_or(0.0);
                    (one.normal_force - forces[k]).abs() < 1e-8 * scale
                        && (gap - gaps[k]).abs() < 1e-8 * scale
                })
            };
            let solution = report.solutions.iter().find(is_it);
            let solution =
                solution.unwrap_or_else(|| panic!("{forces:?} {gaps:?}\n{}\n{model}", text(&report)));
            assert!((solution.drives[0].effort - push).abs() < 1e-8 * scale);
            assert!(solution.residual < 1e-9, "{}\n{model}", solution.residual);
            tips += usize::from(gaps.iter().any(|gap| *gap > 0.0));
        }
        compared += 1;
        several += usize::from(expected.len() > 1);
        none += usize::from(expected.is_empty());
    }
    assert!(
        tips > 100 && several > 10 && none > 10,
        "{tips} tip, {several} with several states, {none} with none"
    );
}

/// A drawer whose three corners have one face each, pulled at the height c.
fn drawer_on_three_corners() -> String {
    let drawer =
        include_str!("drawer-on-runners.toml").replace("pull = [0.2, 0.2, 0.03]", "pull = [0.2, 0.2, \"c\"]");
    let drawer = drawer.replace("moment_of_inertia = 0.02", "shape = { box = [0.45, 0.5, 0.1] }");
    let kept = drawer.lines().filter(|line| !line.starts_with("supports."));
    let kept = kept.collect::<Vec<_>>().join("\n");
    // Measured where the pull acts: held elsewhere it could be unstable without friction.
    let kept = kept.replace("slide = \"guide\"", "x = \"drawer.pull\"");
    let rests = "length = 0.4\nrests_on = { width = 0.5, corners = 3, one_sided = true, mu = 0.25 }";
    "parameters.c = 0.03\n".to_owned() + &kept.replace("length = 0.4", rests)
}

/// The rear support carries `W (1/2 - x_W/L) - P c/L` with `P = 19.178571 N`: it lifts off from `c = 33 N 0.4 m/P` on.
#[test]
fn a_drawer_tips_about_the_line_of_its_front_corners() {
    let model = Model::parse(&drawer_on_three_corners()).unwrap();
    let pull = 15.0 * 0.895 / 0.7;
    let at =
        |c: f64| solve(&model.with(&Settings::default().parameter("c", c.to_string())).unwrap()).unwrap();
    let end = 33.0 * 0.4 / pull;
    for c in [0.03, 0.4, end * 0.999] {
        let report = at(c);
        let lies = report.solutions.iter().find(|one| one.pattern == "+-+++").unwrap();
        let rear = contact(lies, "guide.rear_middle");
        assert!(close(rear.normal_force, 33.0 - pull * c / 0.4, 33.0), "{}", text(&report));
        assert!(close(lies.drives[0].effort, pull, pull));
        assert!(lies.bodies[0].out_of_plane.is_none());
    }
    assert_eq!(at(0.03).solutions.len(), 1);
    let report = at(end * 1.001);
    let [tips] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
    let mode = &tips.joints[0].mode;
    assert!(
        mode.ends_with("lifting off at rear_middle: it tips about the line front_left - front_right"),
        "{mode}"
    );
    let [_, about_x, about_y] = tips.bodies[0].out_of_plane.unwrap();
    let gap = contact(tips, "guide.rear_middle").gap_acceleration.unwrap();
    // The rear middle is 0.4 m behind the line about which the drawer turns, which is that of y.
    assert!(about_x.abs() < 1e-12 && close(gap, 0.4 * about_y, gap), "{}", text(&report));
    let lines = text(&report);
    assert!(
        lines.contains("angular acceleration about x and y") && lines.contains("gap acceleration"),
        "{lines}"
    );
}

/// What is said of corners that cannot be computed.
#[test]
fn corners_that_are_not_determined_are_refused() {
    let drawer = drawer_on_three_corners();
    let message = |from: &str, to: &str| {
        assert!(drawer.contains(from), "{from}");
        try_report_on(&drawer.replace(from, to)).unwrap_err().to_string()
    };
    let tilt = message("shape = { box = [0.45, 0.5, 0.1] }", "moment_of_inertia = 0.02");
    let names = "guide.front_left, guide.front_right and guide.rear_middle";
    let expected = format!("when {names} lifted off, drawer would turn out of the drawing, but nothing says");
    assert!(tilt.contains(&expected), "{tilt}");
    let four = message("corners = 3, ", "");
    assert!(four.contains("guide.rear_left and guide.rear_right may lift off"), "{four}");
    let five = message("corners = 3", "corners = 5");
    assert!(five.contains("guide rests on 5 corners, but `rests_on` has 3 or 4"), "{five}");
    let support =
        "supports.s = { at = 0, normal = \"90 deg\", one_sided = true, play = 0.001 }\nlength = 0.4";
    let play = message("length = 0.4", support);
    assert!(play.contains("one_sided = true") && play.contains("play"), "{play}");
}

/// A gate of 400 N whose mass centre is 0.45 m from its hinge: 400 N along z and 180 N m about y.
#[test]
fn a_hinge_says_what_it_carries_out_of_the_drawing() {
    let report = report_on(
        "gravity = [0, 0, -10]\n[points]\npin = [0, 0]\nS = [0.45, 0]\n[bodies.gate]\npoints = [\"pin\", \"S\"]\nmass = 40\n\
         moment_of_inertia = 10\ncentre_of_mass = \"S\"\n[joints.pin]\ntype = \"hinge\"\nbetween = [\"gate.pin\", \"ground.pin\"]\n\
         [drives.hand]\ncoordinate = \"phi\"\ntorque = { body = \"gate\" }\n[coordinates.phi]\nrotation = \"gate\"\nrate = 0.5\n",
    );
    let carried: Vec<(String, f64, &str)> = report.solutions[0]
        .carried
        .iter()
        .map(|one| {
            (serde_json::to_value(one.quantity).unwrap().as_str().unwrap().to_owned(), one.value, one.unit)
        })
        .collect();
    let expected = [("force_z", 400.0, "N"), ("moment_x", 0.0, "N m"), ("moment_y", -180.0, "N m")];
    assert_eq!(carried, expected.map(|(name, value, unit)| (name.to_owned(), value, unit)));
    let csv = report.csv();
    assert!(csv.contains("joint,pin,force_z,400,N") && csv.contains("joint,pin,moment_y,-180,N m"), "{csv}");
    let lines = text(&report);
    assert!(lines.contains("force along z on gate") && lines.contains("moment about y on gate"), "{lines}");
}

impl Carriage {
    /// Whether friction holds it at rest with this force in place of its drive: normal forces and frictions in equilibrium,
    /// each friction along the guide and at most `mu |N|`. The sets of a given pattern of sides have no lines, so that one
    /// is not empty if it has a corner: there each friction is at one of its bounds, but for as many that are within them
    /// as contacts carry nothing, and one more.
    fn is_held(&self, push: f64) -> bool {
        let wrench = |force: Vector3<f64>, at: Vector3<f64>| {
            let moment = at.cross(&force);
            Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
        };
        let given =
            wrench(self.load.1.into(), self.load.0.into()) + wrench(Vector3::x() * push, self.pull.into());
        let contact = |one: &Pressed| {
            let phi = one.phi.to_radians();
            let at = Vector3::new(one.along, one.aside, one.z);
            let normal = Vector3::y() * phi.cos() + Vector3::z() * phi.sin();
            (wrench(normal, at), wrench(-Vector3::x(), at), one.mu[0])
        };
        let contacts: Vec<_> = self.contacts.iter().map(contact).collect();
        (0..4_usize.pow(5)).any(|code| {
            // 0 and 1: at a bound, 2: carries nothing, 3: within its bounds.
            let state = |k: usize| code / 4_usize.pow(u32::try_from(k).unwrap()) % 4;
            let count = |which: usize| (0..5).filter(|&k| state(k) == which).count();
            if count(3) != count(2) + 1 {
                return false;
            }
            let mut columns = Vec::new();
            for (k, (normal, friction, mu)) in contacts.iter().enumerate() {
                match state(k) {
                    0 => columns.push(normal + friction * *mu),
                    1 => columns.push(normal - friction * *mu),
                    3 => columns.extend([*normal, *friction]),
                    _ => {}
                }
            }
            let Some(answer) = Matrix6::from_columns(&columns).lu().solve(&-given) else { return false };
            let mut at = 0;
            (0..5).filter(|&k| state(k) != 2).all(|k| {
                at += if state(k) == 3 { 2 } else { 1 };
                state(k) != 3 || answer[at - 1].abs() <= contacts[k].2 * answer[at - 2].abs()
            })
        })
    }
}

/// 40 random carriages at rest: what friction holds by the corners of its sets of forces is what `hold` says.
#[test]
fn what_is_held_in_space_is_what_has_forces_in_equilibrium() {
    let mut random = Random(0x0dd0_5eed_1234_5678);
    let (mut compared, mut held) = (0, 0);
    for _ in 0..40 {
        let mut carriage = Carriage { one_sided: [false; 5], ..Carriage::random(&mut random) };
        // Less friction holds less.
        carriage.contacts.iter_mut().for_each(|contact| contact.mu[0] *= 0.2);
        let model = carriage.text();
        let report = hold(&Model::parse(&model).unwrap(), &HoldOptions::default().load("push")).unwrap();
        let ranges = &report.load.as_ref().unwrap().held;
        assert!(report.is_decided(), "{}", report.text(Style::PLAIN));
        let of_load = hold(&Model::parse(&model).unwrap(), &HoldOptions::default().load("f")).unwrap();
        let (force, expected) = (of_load.load.unwrap().force.unwrap(), Vector3::from(carriage.load.1).norm());
        assert!((force - expected).abs() < 1e-12 * expected, "{force} {expected}");
        let ends: Vec<f64> =
            ranges.iter().flat_map(|range| [range.least, range.greatest]).flatten().collect();
        for step in 0..8 {
            let push = if step < ends.len().min(4) {
                ends[step] + if step % 2 == 0 { 1e-3 } else { -1e-3 }
            } else {
                random.between(-200.0, 200.0)
            };
            let is_near = |end: &f64| (push - end).abs() < 1e-6 * (1.0 + end.abs());
            if ends.iter().any(is_near) {
                continue;
            }
            let within = |range: &Range| {
                range.least.is_none_or(|least| least < push)
                    && range.greatest.is_none_or(|greatest| push < greatest)
            };
            let says = ranges.iter().any(within);
            assert_eq!(carriage.is_held(push), says, "{push}\n{}\n{model}", report.text(Style::PLAIN));
            compared += 1;
            held += usize::from(says);
        }
    }
    assert!(compared > 250 && held > 50 && compared - held > 50, "{held} of {compared}");
}

/// A key without friction carries nothing: both of its sides are one, and the friction of the others decides. Friction does no work
/// that changes this: the verdict is that of the pressed key.
#[test]
fn what_carries_nothing_without_friction_leaves_stability_as_it_is() {
    let verdict = |text: &str| report_on(text).solutions[0].attainability.clone();
    let (free, pressed) = (verdict(GUIDE), verdict(&GUIDE.replace("twist = 0 ", "twist = 0.3 ")));
    assert_eq!((free.verdict, &free.reason), (pressed.verdict, &pressed.reason));
    let rough = verdict(&GUIDE.replace("\"90 deg\", mu = 0 }", "\"90 deg\" }"));
    // Nor does its friction, of a force that no other friction acts back on.
    assert_eq!((rough.verdict, rough.reason), (free.verdict, free.reason));
}

/// Planar mechanisms with a weight along z that joints without friction carry move as in the plane.
#[test]
fn planar_mechanisms_in_space_move_alike() {
    let mut compared = Vec::new();
    for entry in gallery::MODELS {
        let Some(spatial) = in_space(entry.text) else { continue };
        let mut options = SimulateOptions::new(0.2);
        options.longest_step = Some(0.01);
        let moved = |text: &str| simulate(&Model::parse(text).ok()?, &options).ok();
        let (Some(planar), Some(found)) = (moved(entry.text), moved(&spatial)) else { continue };
        assert_eq!(found.end, planar.end, "{}", entry.name);
        assert!((found.stop() - planar.stop()).abs() < 1e-8, "{}", entry.name);
        let places = |history: &History| -> Vec<[f64; 2]> {
            let mut reader = history.reader();
            let configuration = reader.configuration(history.stop() * 0.999).unwrap();
            let poses = configuration.poses.iter().zip(&configuration.velocities);
            poses.flat_map(|(pose, velocity)| [pose.position.into(), velocity.linear.into()]).collect()
        };
        for (one, other) in places(&planar).into_iter().zip(places(&found)) {
            let difference = (one[0] - other[0]).hypot(one[1] - other[1]);
            assert!(difference < 1e-6 * (1.0 + one[0].hypot(one[1])), "{}: {one:?} {other:?}", entry.name);
        }
        compared.push(entry.name);
    }
    assert!(compared.len() >= 8, "{compared:?}");
}

/// A block of 0.4 kg in a radial slot of a table that turns with 6 rad/s: side faces guide it, and it lies on three pads.
const TURNTABLE: &str = r#"
gravity = [0, 0, -9.81]
[points]
O = [0, 0]
M = [0.3, 0]
C = [0.3, 0, 0.004]
[bodies.table]
points = ["O", "M"]
mass = 5
moment_of_inertia = 0.5
centre_of_mass = "O"
[bodies.block]
points = ["C"]
mass = 0.4
moment_of_inertia = 1e-3
products_of_inertia = [2e-5, -3e-5]
centre_of_mass = "C"
[joints.pivot]
type = "hinge"
between = ["table.O", "ground.O"]
[joints.slot]
type = "block_slider"
block = "block"
guide = "table"
at = "M"
along = 0
length = 0.1
mu = 0.2
supports.left = { at = 0, aside = 0.06, normal = "90 deg", mu = 0.1 }
supports.front_right = { at = 0.05, aside = -0.06, normal = "90 deg", mu = 0.1 }
supports.rear_right = { at = -0.05, aside = -0.06, normal = "90 deg", mu = 0.1 }
[drives.motor]
coordinate = "phi"
torque = { body = "table" }
[coordinates.phi]
rotation = "table"
rate = 6
[coordinates.r]
slide = "slot"
rate = 0.4
"#;

/// As long as all pads carry, `r'' = omega^2 r - 2 mu omega r' - mu_pads g`: the weight rubs on the pads, Coriolis' force on the
/// side of the slot. With `lambda = omega (-mu +- sqrt(1 + mu^2))` and `r_0 = mu_pads g/omega^2` that is
/// `r - r_0 = A exp(lambda_1 t) + B exp(lambda_2 t)`.
#[test]
fn a_block_on_a_turntable_follows_the_closed_form() {
    let model = Model::parse(TURNTABLE).unwrap();
    let history = simulate(&model, &SimulateOptions::new(0.15)).unwrap();
    assert_eq!(history.end, End::Finished);
    assert_eq!(history.phases.len(), 1);
    let (omega, mu) = (6.0_f64, 0.2_f64);
    let root = (1.0 + mu * mu).sqrt();
    let [first, second] = [omega * (root - mu), -omega * (root + mu)];
    let middle = 0.1 * 9.81 / (omega * omega);
    let (start, rate) = (0.3 - middle, 0.4);
    let b = (first * start - rate) / (first - second);
    let a = start - b;
    let mut reader = history.reader();
    for time in [0.05, 0.1, 0.15] {
        let expected = middle + a * (first * time).exp() + b * (second * time).exp();
        let found = reader.configuration(time).unwrap().poses[1].position.norm();
        assert!((found - expected).abs() < 1e-8, "{time}: {found} {expected}");
    }
    assert!(history.energy_error < 1e-10 * history.energy_scale);
}

/// In the course of a motion forces, efforts and accelerations are those that `solve` has in that state.
#[test]
fn forces_of_a_motion_in_space_are_those_of_its_states() {
    let model = Model::parse(&TURNTABLE.replace("0.004", "0.02")).unwrap();
    let history = simulate(&model, &SimulateOptions::new(0.4)).unwrap();
    assert!(history.phases.len() > 1, "a pad changes its face");
    let mut reader = history.reader();
    for time in [0.03, 0.2, 0.39] {
        let sample = reader.at(time).unwrap();
        let [q, rates] = [&sample.configuration.coordinates, &sample.configuration.rates];
        let names = ["phi", "r"].into_iter().enumerate();
        let settings = names.fold(Settings::default(), |settings, (index, name)| {
            settings.position(name, q[index]).rate(name, rates[index])
        });
        let report = solve(&model.with(&settings).unwrap()).unwrap();
        let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
        let scale = solution.contacts.iter().map(|one| one.normal_force.abs()).fold(0.0, f64::max);
        for (one, found) in solution.contacts.iter().zip(&sample.contacts) {
            assert!(close(found.normal_force, one.normal_force, scale), "{time}, {}", one.name);
        }
        assert!(close(sample.efforts[0], solution.drives[0].effort, scale), "{time}");
        let series = history.series(&[time]);
        let acceleration = series.column("r.acceleration").unwrap().values[0].unwrap();
        assert!(close(acceleration, solution.coordinates[1].acceleration, 10.0), "{time}: {acceleration}");
    }
}

/// A carriage of 6 kg on three corners, its weight `h = 0.5 m` above them, pushed at rest with `k t` at `c = 0.6 m`. It slides from
/// `k t = mu W` on, and tips about the line of its front corners, which are `d = 0.2 m` ahead, from
/// `k t c - (k t - mu W) h = W d` on; there its motion leaves the plane.
#[test]
fn a_motion_ends_where_a_carriage_tips() {
    let carriage = r#"
        gravity = [0, 0, -9.81]
        [points]
        middle = [0, 0]
        load = [0, 0, 0.5]
        push = [0.1, 0, 0.6]
        [bodies.carriage]
        points = ["middle", "load", "push"]
        mass = 6
        centre_of_mass = "load"
        shape = { box = [0.45, 0.5, 0.1] }
        [joints.guide]
        type = "block_slider"
        block = "carriage"
        at = "middle"
        along = 0
        length = 0.4
        mu = 0.3
        rests_on = { width = 0.5, corners = 3, one_sided = true, mu = 0.25 }
        [loads.push]
        type = "force"
        at = "carriage.push"
        components = ["40 N/s*t", 0, 0]
        [coordinates.x]
        slide = "guide"
    "#;
    let options = SimulateOptions::new(3.0);
    let history = simulate(&Model::parse(carriage).unwrap(), &options).unwrap();
    let End::OutOfPlane(_) = history.end else { panic!("{:?}", history.end) };
    let (k, weight, mu) = (40.0, 6.0 * 9.81, 0.25);
    let tips = (0.2 - 0.5 * mu) * weight / (k * (0.6 - 0.5));
    let [start, slides, end] = history.events.as_slice() else { panic!("{:?}", history.events) };
    for (event, expected) in [(start, 0.0), (slides, mu * weight / k), (end, tips)] {
        assert!((event.time - expected).abs() < 1e-8, "{} {expected}", event.time);
    }
    assert!(end.words.contains("carriage tips: it is now"), "{}", end.words);
    assert!(
        end.words.contains("resting on front_left, front_right, lifting off at rear_middle"),
        "{}",
        end.words
    );
    let words = slideway::motion::report(&history, &options).end.words;
    let told = "guide.rear_middle lifts off, and carriage leaves the plane of its motion";
    assert!(words.contains(told), "{words}");
}

/// A sled on three corners whose bottom is driven by a pull high above it: already without friction it can stay, or tip with either
/// end up, since a drive holds what lifts (three solutions, by the determinants of the 8 patterns of its corners). So there is no
/// friction up to which every load has one solution.
#[test]
fn what_a_drive_holds_may_have_several_solutions_without_friction() {
    let sled = |mu: f64| {
        report_on(&format!(
            "gravity = [0, 0, -9.81]\n[points]\no = [0, 0]\nrope = [0.05, 0, 0.15]\nS = [0, 0, 0.05]\n\
             [bodies.sled]\npoints = [\"o\", \"rope\", \"S\"]\nmass = 4\ncentre_of_mass = \"S\"\n\
             shape = {{ box = [0.1, 0.08, 0.1] }}\n\
             [joints.bed]\ntype = \"block_slider\"\nblock = \"sled\"\nat = \"o\"\nalong = 0\nlength = 0.1\nmu = {mu}\n\
             rests_on = {{ width = 0.06, one_sided = true, corners = 3 }}\n\
             [coordinates.x]\nslide = \"bed\"\nrate = 0.1\n\
             [drives.pull]\ncoordinate = \"x\"\nforce = {{ at = \"sled.rope\", direction = 0 }}\n"
        ))
    };
    for mu in [0.0, 0.05] {
        let report = sled(mu);
        assert_eq!(report.solutions.len(), 3, "{}", text(&report));
        assert!(!text(&report).contains("in one way only"), "{}", text(&report));
    }
    assert_eq!(sled(0.05).margins.unwrap().uniqueness, Some(0.0));
    let told = text(&sled(0.05)).replace('\n', " ");
    assert!(told.contains("Other loads can leave it several ways to move, even without friction."), "{told}");
}
