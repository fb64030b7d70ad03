//! Pins with two bearings: two hinges of the same bodies on one line, at different heights. Closed form of the gate, and random
//! rotors against Newton's and Euler's equations of their own.

use crate::answers::{report_on, try_report_on};
use slideway::model::Model;
use slideway::motion::{End, SimulateOptions, simulate};
use slideway::report::{Proof, Report, SolveReport, Style};
use slideway::standstill::{HoldOptions, hold};
use std::fmt::Write as _;

/// `reference/space-models/gate.toml` with a hinge for each bearing, without the collar.
const GATE: &str = r#"
[points]
up = [0, 0, 0.6]
low = [0, 0, -0.6]
S = [0.45, 0]

[bodies.gate]
points = ["up", "low", "S"]
mass = 40
moment_of_inertia = 10
centre_of_mass = "S"

[joints.upper]
type = "hinge"
between = ["gate.up", "ground.up"]
friction_radius = 0.0012
carries = "nothing"

[joints.lower]
type = "hinge"
between = ["gate.low", "ground.low"]
friction_radius = 0.0012
carries = "z"

[loads.weight]
type = "force"
at = "gate.S"
components = [0, 0, -400]

[drives.hand]
coordinate = "phi"
torque = { body = "gate" }

[coordinates.phi]
rotation = "gate"
rate = 0.5
"#;

fn text(report: &SolveReport) -> String {
    report.text(Style::PLAIN)
}

/// Theory of loads in space, section 5, and `reference/space.toml`, `gate_on_a_pin`: the bearings carry 152.25 N and 147.75 N, so
/// that `M = r (|W d/B + m d om^2/2| + |W d/B - m d om^2/2|)` is 0.36 N m; the collar would add `r_c W`.
#[test]
fn a_gate_on_two_bearings_needs_the_torque_of_the_closed_form() {
    let report = report_on(GATE);
    let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
    assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
    let expected = [("upper", -152.25), ("lower", 147.75)];
    for (hinge, (name, force)) in solution.hinges.iter().zip(expected) {
        assert_eq!(hinge.name, name);
        assert!((hinge.force[0] - force).abs() < 1e-9 && hinge.force[1].abs() < 1e-9, "{hinge:?}");
    }
    assert!((solution.drives[0].effort - 0.36).abs() < 1e-12, "{}", text(&report));
    let carried: Vec<(&str, f64)> =
        solution.carried.iter().map(|one| (one.name.as_str(), one.value)).collect();
    assert_eq!(carried, [("lower", 400.0)]);
}

/// At rest both bearings carry 150 N: a torque of up to 0.36 N m does not turn the gate.
#[test]
fn a_gate_on_two_bearings_holds_up_to_their_friction() {
    let drive = GATE.find("[drives.hand]").unwrap()..GATE.find("[coordinates.phi]").unwrap();
    let at = |moment: f64| {
        let torque = format!("[loads.wind]\ntype = \"torque\"\nbody = \"gate\"\nmoment = {moment}\n\n");
        let text = GATE.replace(&GATE[drive.clone()], &torque);
        hold(&Model::parse(&text).unwrap(), &HoldOptions::default().load("wind")).unwrap()
    };
    for (moment, holds) in [(0.3, true), (0.4, false), (-0.35, true), (-0.5, false)] {
        let report = at(moment);
        assert_eq!((report.holds, report.undecided), (holds, 0), "{}", report.text(Style::PLAIN));
        let [range] = report.load.as_ref().unwrap().held.as_slice() else { panic!("several") };
        let ends = [range.least, range.greatest].map(|end| end.unwrap() * moment.abs());
        assert!((ends[0] + 0.36).abs() < 1e-8 && (ends[1] - 0.36).abs() < 1e-8, "{ends:?}");
    }
}

/// Turned loose, the gate slows down by `M/(J + m d^2)` with `J + m d^2 = 18.1 kg m^2`, and stops for good. The forces of its
/// own deceleration and of its turning change `M` by less than 1e-6 of it.
#[test]
fn a_gate_on_two_bearings_slows_down_and_stops() {
    let drive = GATE.find("[drives.hand]").unwrap()..GATE.find("[coordinates.phi]").unwrap();
    let model = Model::parse(&GATE.replace(&GATE[drive], "")).unwrap();
    let history = simulate(&model, &SimulateOptions::new(30.0)).unwrap();
    assert_eq!(history.end, End::Finished);
    let slows = 0.36 / 18.1;
    let mut reader = history.reader();
    for (time, expected) in [(10.0, 0.5 - 10.0 * slows), (20.0, 0.5 - 20.0 * slows), (30.0, 0.0)] {
        let rate = reader.configuration(time).unwrap().rates[0];
        assert!((rate - expected).abs() < 1e-6, "{time}: {rate} {expected}");
    }
    let stops = history.events.iter().any(|event| (event.time - 0.5 / slows).abs() < 1e-4);
    assert!(stops, "{:?}", history.events);
}

/// One hinge with friction that carries couples would hide what its bearings press; two at one height are one twice.
#[test]
fn a_pin_without_heights_says_what_to_write() {
    let tilted = try_report_on(&GATE.replace("carries = \"z\"", "")).unwrap_err().to_string();
    assert!(tilted.contains("lower has friction and carries couples"), "{tilted}");
    let twice = try_report_on(&GATE.replace("low = [0, 0, -0.6]", "low = [0, 0, 0.6]")).unwrap_err();
    assert!(twice.to_string().contains("lower duplicates upper"), "{twice}");
    let free = try_report_on(&GATE.replace("carries = \"z\"", "carries = \"nothing\"")).unwrap_err();
    assert!(free.to_string().contains("nothing keeps gate from moving along z"), "{free}");
}

/// A xorshift generator.
struct Random(u64);

impl Random {
    fn between(&mut self, from: f64, to: f64) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        from + (to - from) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A rotor on a pin with two bearings: mass 3 kg with its centre at (d, 0, c), moment of inertia 0.2 kg m^2 about it, a force at a
/// point.
struct Rotor {
    d: f64,
    c: f64,
    products: [f64; 2],
    bearings: [f64; 2],
    radii: [f64; 2],
    rate: f64,
    force: [f64; 3],
    at: [f64; 3],
}

impl Rotor {
    fn random(random: &mut Random) -> Self {
        Self {
            d: random.between(-0.3, 0.3),
            c: random.between(-0.2, 0.2),
            products: [0; 2].map(|_| random.between(-0.02, 0.02)),
            bearings: [random.between(0.1, 0.3), random.between(-0.3, -0.1)],
            radii: [0; 2].map(|_| random.between(0.0, 1.0)),
            rate: random.between(0.5, 6.0) * if random.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 },
            force: [0; 3].map(|_| random.between(-50.0, 50.0)),
            at: [0; 3].map(|_| random.between(-0.3, 0.3)),
        }
    }

    fn model(&self) -> String {
        let Self { d, c, products: [dx, dy], bearings: [up, low], radii, rate, force, at } = self;
        let mut text = format!(
            "[points]\nup = [0, 0, {up}]\nlow = [0, 0, {low}]\nS = [{d}, 0, {c}]\nP = {at:?}\n[bodies.rotor]\n\
             points = [\"up\", \"low\", \"S\", \"P\"]\nmass = 3\nmoment_of_inertia = 0.2\ncentre_of_mass = \"S\"\n\
             products_of_inertia = [{dx}, {dy}]\n[loads.F]\ntype = \"force\"\nat = \"rotor.P\"\ncomponents = {force:?}\n\
             [coordinates.phi]\nrotation = \"rotor\"\nrate = {rate}\n"
        );
        for ((name, carries), radius) in [("up", "nothing"), ("low", "z")].into_iter().zip(radii) {
            write!(
                text,
                "[joints.{name}]\ntype = \"hinge\"\nbetween = [\"rotor.{name}\", \"ground.{name}\"]\n\
                 friction_radius = {radius}\ncarries = \"{carries}\"\n"
            )
            .unwrap();
        }
        text
    }

    /// What is left of Euler's equation about the pin at an angular acceleration: without the couples of friction both bearings
    /// carry what Newton's and Euler's other equations say.
    fn left(&self, alpha: f64) -> f64 {
        let Self { d, c, products: [dx, dy], bearings: [up, low], radii, rate, force, at } = self;
        let spin = rate * rate;
        let arm = [at[0] - d, at[1], at[2] - c];
        let moment = [
            arm[1] * force[2] - arm[2] * force[1],
            arm[2] * force[0] - arm[0] * force[2],
            arm[0] * force[1] - arm[1] * force[0],
        ];
        // Sums of both forces, and of their moments by their heights.
        let sum = [-3.0 * d * spin - force[0], 3.0 * d * alpha - force[1]];
        let tilt_x = -dx * alpha + dy * spin - moment[0];
        let tilt_y = -dy * alpha - dx * spin - moment[1] + d * force[2];
        let by_height = [tilt_y, -tilt_x];
        let upper = [0, 1].map(|axis| (by_height[axis] - (low - c) * sum[axis]) / (up - low));
        let lower = [0, 1].map(|axis| sum[axis] - upper[axis]);
        let friction = radii[0] * upper[0].hypot(upper[1]) + radii[1] * lower[0].hypot(lower[1]);
        0.2 * alpha + d * sum[1] - moment[2] + rate.signum() * friction
    }

    /// All its angular accelerations, from signs over a fine grid.
    fn accelerations(&self) -> Vec<f64> {
        let grid: Vec<f64> = (-60_000..=60_000).map(|step| (f64::from(step) / 6000.0).sinh()).collect();
        let crossing = |pair: &[f64]| {
            let [mut from, mut to] = [pair[0], pair[1]];
            let begins = self.left(from);
            (begins * self.left(to) < 0.0).then(|| {
                for _ in 0..200 {
                    let middle = f64::midpoint(from, to);
                    if self.left(middle) * begins > 0.0 { from = middle } else { to = middle }
                }
                from
            })
        };
        grid.windows(2).filter_map(crossing).collect()
    }
}

#[test]
fn random_rotors_on_two_bearings_have_the_accelerations_of_newton_and_euler() {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let mut counts = [0; 5];
    for case in 0..60 {
        let rotor = Rotor::random(&mut random);
        let expected = rotor.accelerations();
        let report = report_on(&rotor.model());
        let mut found: Vec<f64> =
            report.solutions.iter().map(|solution| solution.bodies[0].angular_acceleration).collect();
        found.sort_by(f64::total_cmp);
        assert_eq!(found.len(), expected.len(), "{case}: {found:?} {expected:?}\n{}", rotor.model());
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-8 * (1.0 + expected.abs()), "{case}: {found} {expected}");
        }
        assert_eq!(report.complete, Proof::Proven, "{case}: {:?}", report.open);
        counts[expected.len()] += 1;
    }
    assert!(counts[..3].iter().all(|count| *count > 0), "{counts:?}");
}
