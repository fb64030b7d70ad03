//! Pins with two bearings: two hinges of the same bodies on one line, at different heights. Closed form of the gate, and random
//! rotors against Newton's and Euler's equations of their own.

use crate::answers::{report_on, try_report_on};
use slideway::limits::{LimitsOptions, limits};
use slideway::model::{Model, Settings};
use slideway::motion::{End, SimulateOptions, simulate};
use slideway::report::{Proof, Report, SolveReport, Style};
use slideway::solve::solve;
use slideway::standstill::{HoldOptions, hold};
use std::fmt::Write as _;

/// `reference/space-models/gate.toml` with a hinge for each bearing, without the collar.
pub(crate) const GATE: &str = r#"
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

/// [`GATE`] on its collar.
fn with_collar(radii: &str) -> String {
    GATE.replace("carries = \"z\"", &format!("carries = \"z\"\ncollar = {{ {radii} }}"))
}

/// Theory of loads in space, section 5: the collar adds `r_c W`, 1.5 mm 400 N: 0.96 N m in all, where the planar model has 0.0054.
#[test]
fn a_gate_on_its_collar_needs_the_torque_of_the_closed_form() {
    let report = report_on(&with_collar("friction_radius = 0.0015"));
    let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
    assert_eq!(report.complete, Proof::Proven, "{:?}", report.open);
    assert!((solution.drives[0].effort - 0.96).abs() < 1e-12, "{}", text(&report));
    let carried: Vec<(&str, f64)> =
        solution.carried.iter().map(|one| (one.name.as_str(), one.value)).collect();
    let [("lower", force), ("lower", couple)] = carried[..] else { panic!("{carried:?}") };
    assert!((force - 400.0).abs() < 1e-9 && (couple + 0.6).abs() < 1e-12, "{carried:?}");
    assert!(solution.residual < 1e-12, "{}", solution.residual);
    // The collar has a friction of its own: without weight it has none.
    let light = with_collar("friction_radius = 0.0015").replace("-400]", "0]");
    let bearings = 0.0012 * 2.0 * 40.0 * 0.45 * 0.25 / 2.0;
    assert!((report_on(&light).solutions[0].drives[0].effort - bearings).abs() < 1e-12);
}

/// At rest its own static friction holds, too: 0.36 N m of the bearings and 0.8 N m of the collar; with both turning 0.96 N m.
#[test]
fn a_gate_on_its_collar_holds_and_slows_down() {
    let gate = with_collar("friction_radius = 0.0015, static_friction_radius = 0.002");
    let drive = gate.find("[drives.hand]").unwrap()..gate.find("[coordinates.phi]").unwrap();
    let torque = "[loads.wind]\ntype = \"torque\"\nbody = \"gate\"\nmoment = 1\n\n";
    let model = Model::parse(&gate.replace(&gate[drive.clone()], torque)).unwrap();
    let report = hold(&model, &HoldOptions::default().load("wind")).unwrap();
    assert_eq!((report.holds, report.undecided), (true, 0), "{}", report.text(Style::PLAIN));
    let [range] = report.load.as_ref().unwrap().held.as_slice() else { panic!("several") };
    let ends = [range.least, range.greatest].map(Option::unwrap);
    assert!((ends[0] + 1.16).abs() < 1e-8 && (ends[1] - 1.16).abs() < 1e-8, "{ends:?}");
    let couples = report.at_rest.as_ref().unwrap().reactions.hinges.iter().filter_map(|hinge| hinge.couple);
    let whole: f64 = couples.map(|couple| couple.greatest.unwrap()).sum();
    assert!(whole.abs() < 1.16 + 1e-8, "{whole}");
    // Turned loose it slows down by 0.96/18.1 rad/s^2 and stops.
    let model = Model::parse(&gate.replace(&gate[drive], "")).unwrap();
    let history = simulate(&model, &SimulateOptions::new(12.0)).unwrap();
    assert_eq!(history.end, End::Finished);
    let slows = 0.96 / 18.1;
    let mut reader = history.reader();
    for (time, expected) in [(4.0, 0.5 - 4.0 * slows), (8.0, 0.5 - 8.0 * slows), (12.0, 0.0)] {
        let rate = reader.configuration(time).unwrap().rates[0];
        assert!((rate - expected).abs() < 1e-6, "{time}: {rate} {expected}");
    }
    let series = history.series(&[4.0]);
    let column = |name: &str| series.column(name).unwrap().values[0].unwrap();
    assert!((column("lower.collar.force") - 400.0).abs() < 1e-9);
    assert!((column("lower.collar.couple") + 0.6).abs() < 1e-9);
}

/// The force on the collar turns round, and with it which of its faces rubs: `J alpha = -r_c |F_z|`, so that in 2 s the rate falls by
/// the integral of `|cos(3 t)|`, (1 + 2 + 1 + sin(6))/3 = 1.240195 rad/s.
#[test]
fn a_collar_rubs_on_either_face() {
    let model = Model::parse(
        "[points]\nO = [0, 0]\n[bodies.rotor]\npoints = [\"O\"]\nmass = 3\nmoment_of_inertia = 0.2\ncentre_of_mass = \"O\"\n\
         [joints.pin]\ntype = \"hinge\"\nbetween = [\"rotor.O\", \"ground.O\"]\ncollar = { friction_radius = 0.002 }\n\
         [loads.F]\ntype = \"force\"\nat = \"rotor.O\"\ncomponents = [0, 0, \"100 N*cos(3*t/(1 s))\"]\n\
         [coordinates.phi]\nrotation = \"rotor\"\nrate = 5\n",
    )
    .unwrap();
    let history = simulate(&model, &SimulateOptions::new(2.0)).unwrap();
    assert_eq!(history.end, End::Finished, "{:?}", history.events);
    let rate = history.reader().configuration(2.0).unwrap().rates[0];
    let expected = 5.0 - (4.0 + 6.0_f64.sin()) / 3.0;
    assert!((rate - expected).abs() < 1e-5, "{rate} {expected}");
}

/// Against a wind of 1 N m the gate speeds up with less friction than its own: 0.36 N m of the bearings leave 0.64 N m/400 N.
#[test]
fn a_collar_is_varied_like_any_friction() {
    let gate =
        with_collar("friction_radius = \"r\"").replace("[points]", "[parameters]\nr = \"1 mm\"\n[points]");
    let drive = gate.find("[drives.hand]").unwrap()..gate.find("[coordinates.phi]").unwrap();
    let torque = "[loads.wind]\ntype = \"torque\"\nbody = \"gate\"\nmoment = 1\n\n";
    let model = Model::parse(&gate.replace(&gate[drive], torque)).unwrap();
    let at = |radius: f64| {
        let model = model.with(&Settings::default().parameter("r", radius.to_string())).unwrap();
        solve(&model).unwrap().solutions[0].coordinates[0].acceleration
    };
    // The couples by which the bearings answer the acceleration change the friction in its second order.
    for radius in [0.0, 0.001, 0.0016, 0.002] {
        assert!((at(radius) - (0.64 - 400.0 * radius) / 18.1).abs() < 1e-5, "{radius}: {}", at(radius));
    }
    let report = limits(&model, &LimitsOptions::new("r=0 mm..3 mm".parse().unwrap())).unwrap();
    let answer = report.text(Style::PLAIN);
    assert!(answer.contains("r from 0 to 1.6 mm: it speeds up"), "{answer}");
}

/// `reference/space-models/gate.toml` as it stands: both bearings and the collar in one hinge.
#[test]
fn both_bearings_and_the_collar_stand_in_one_hinge() {
    let begins = GATE.find("[joints.upper]").unwrap();
    let ends = GATE.find("[loads.weight]").unwrap();
    let pin = "[joints.pin]\ntype = \"hinge\"\nbetween = [\"gate.pin\", \"ground.pin\"]\nfriction_radius = \"1.2 mm\"\n\
               bearings = \"1.2 m\"\ncollar = { friction_radius = \"1.5 mm\" }\n";
    let points = "[points]\npin = [0, 0]\nS = [0.45, 0]\n";
    let text_of_model = format!("{}{pin}{}", &GATE[..begins], &GATE[ends..])
        .replace("up = [0, 0, 0.6]\nlow = [0, 0, -0.6]\nS = [0.45, 0]\n", &points["[points]\n".len()..])
        .replace("\"up\", \"low\"", "\"pin\"");
    let report = report_on(&text_of_model);
    let [solution] = report.solutions.as_slice() else { panic!("{}", text(&report)) };
    assert!((solution.drives[0].effort - 0.96).abs() < 1e-12, "{}", text(&report));
    let names: Vec<&str> = solution.hinges.iter().map(|hinge| hinge.name.as_str()).collect();
    assert_eq!(names, ["pin.upper", "pin.lower"]);
    let hold_up = text_of_model.replace("bearings", "carries = \"nothing\"\nbearings");
    let idle = try_report_on(&hold_up).unwrap_err().to_string();
    assert!(idle.contains("the collar of pin carries along z"), "{idle}");
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
    let idle = with_collar("friction_radius = 1").replace("carries = \"z\"", "carries = \"tilt\"");
    let idle = try_report_on(&idle).unwrap_err().to_string();
    assert!(idle.contains("the collar of lower carries along z, which lower does not"), "{idle}");
    let rough = try_report_on(&with_collar("friction_radius = 2, static_friction_radius = 1")).unwrap_err();
    assert!(rough.to_string().contains("static"), "{rough}");
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
    collar: f64,
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
            collar: random.between(0.0, 0.2),
            rate: random.between(0.5, 6.0) * if random.between(-1.0, 1.0) < 0.0 { -1.0 } else { 1.0 },
            force: [0; 3].map(|_| random.between(-50.0, 50.0)),
            at: [0; 3].map(|_| random.between(-0.3, 0.3)),
        }
    }

    fn model(&self) -> String {
        let Self { d, c, products: [dx, dy], bearings: [up, low], radii, collar, rate, force, at } = self;
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
        text.replace(
            "carries = \"z\"",
            &format!("carries = \"z\"\ncollar = {{ friction_radius = {collar} }}"),
        )
    }

    /// What is left of Euler's equation about the pin at an angular acceleration: without the couples of friction both bearings
    /// carry what Newton's and Euler's other equations say.
    fn left(&self, alpha: f64) -> f64 {
        let Self { d, c, products: [dx, dy], bearings: [up, low], radii, collar, rate, force, at } = self;
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
        let friction = radii[0] * upper[0].hypot(upper[1])
            + radii[1] * lower[0].hypot(lower[1])
            + collar * force[2].abs();
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
