//! Contacts that may lift off and do not slip: discs that roll, and what stands. `sticks = true` takes a coordinate less; what they
//! do is that of any contact at rest.

use crate::answers::{assert_close, contact, only, report_on};
use rstest::rstest;
use slideway::configuration::Configuration;
use slideway::fault::FaultKind;
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::map::ColourBy;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::report::{Report, Status};
use slideway::sweep::{Rows, Sweep, SweepOptions};
use slideway::{DriveOptions, HoldOptions, MapOptions, drive, hold, map, solve};
use std::ops::ControlFlow;

const GRAVITY: f64 = 9.81;
const R: f64 = 0.05;

/// A disc that rolls on a cylinder (`inside` = false), or in a hole, of so many metres about the origin; drawn at the top of the
/// cylinder, or at the bottom of the hole, and led away by a rotation of its own.
fn on_disc(face: f64, inside: bool, turn: f64, rate: f64) -> String {
    let height = if inside { R - face } else { R + face };
    format!(
        "gravity = {GRAVITY}\n[points]\nO = [0, 0]\nC = [0, {height}]\n[bodies.disc]\npoints = [\"C\"]\nmass = 1\ncentre_of_mass = \"C\"\n\
         shape = {{ disc = {R} }}\n[joints.top]\ntype = \"disc_on_disc\"\ncentres = [\"disc.C\", \"ground.O\"]\nradii = [{R}, {face}]\n\
         inside = {inside}\nsticks = true\nmu = 0.9\n[coordinates.turn]\nrotation = \"disc\"\nvalue = {turn}\nrate = {rate}\n"
    )
}

/// With `R theta = (R + R_A) phi` the centre is led to the angle phi from the top, at the speed `R omega`: `N = m (g cos - v^2/(R + R_A))`
/// and, as a solid disc, `T = m g sin/3`. The reference has the same at 25 deg on a cylinder of 200 mm.
#[rstest]
#[case(25.0)]
#[case(-40.0)]
fn a_disc_rolls_on_a_cylinder(#[case] degrees: f64) {
    let (face, phi) = (0.2, f64::to_radians(degrees));
    let turn = -phi * (R + face) / R;
    let rate = -0.6 / R;
    let text = on_disc(face, false, turn, rate);
    let report = report_on(&text);
    let solution = only(&report);
    let (sin, cos) = phi.sin_cos();
    let top = contact(solution, "top");
    assert_close(top.normal_force, GRAVITY * cos - 0.36 / (R + face), 1.0, 1e-10);
    assert_close(top.friction_force.abs(), GRAVITY * sin.abs() / 3.0, 1.0, 1e-10);
    assert_close(solution.bodies[0].angular_acceleration, -GRAVITY * sin / 1.5 / R, 100.0, 1e-10);
    assert!(top.sliding_velocity.abs() < 1e-12);
    let mechanism = Mechanism::new(&Model::parse(&text).unwrap()).unwrap();
    let place = Configuration::new(&mechanism).unwrap().poses[0].position;
    assert_close(place.x, (R + face) * sin, 1.0, 1e-12);
    assert_close(place.y, (R + face) * cos, 1.0, 1e-12);
    if degrees == 25.0 {
        assert_close(top.normal_force, 7.450_879_391, 1.0, 1e-8);
        assert_close(top.friction_force.abs(), 1.381_961_716, 1.0, 1e-8);
    }
}

/// In a hole the disc turns the other way, `R theta = -(R_h - R) phi`, and the faster it goes, the harder it presses.
#[test]
fn a_disc_rolls_in_a_hole() {
    let (face, phi) = (0.13, 50_f64.to_radians());
    let text = on_disc(face, true, -phi * (face - R) / R, 4.0);
    let report = report_on(&text);
    let (sin, cos) = phi.sin_cos();
    let force = contact(only(&report), "top").normal_force;
    assert_close(force, GRAVITY * cos + (4.0 * R).powi(2) / (face - R), 1.0, 1e-10);
    let mechanism = Mechanism::new(&Model::parse(&text).unwrap()).unwrap();
    let place = Configuration::new(&mechanism).unwrap().poses[0].position;
    assert_close(place.x, (face - R) * sin, 1.0, 1e-12);
    assert_close(place.y, -(face - R) * cos, 1.0, 1e-12);
}

/// A wheel on an incline, led up by two turns: its angle follows from the way, and it rolls back with `g sin/(1 + k)`.
#[test]
fn a_wheel_rolls_along_a_face() {
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let text = wheel("sticks = true", 0.5).replace("value = 0", "value = 1.2");
    let report = report_on(&text);
    let solution = only(&report);
    assert_close(solution.coordinates[0].acceleration, -GRAVITY * sin / 1.5, 1.0, 1e-10);
    assert_eq!(report.model.degrees_of_freedom, 1);
    assert!(report.answer().contains("foot does not slip"), "{}", report.answer());
    let mechanism = Mechanism::new(&Model::parse(&text).unwrap()).unwrap();
    let pose = Configuration::new(&mechanism).unwrap().poses[0];
    assert_close(pose.angle(), -1.2 / 0.1, 1.0, 1e-12);
    assert_close(pose.position.x, 1.2 * cos - 0.1 * sin, 1.0, 1e-12);
}

/// A wheel of 1 kg and radius 0.1 m with `J = m R^2/2` on an incline of 10 deg, with these keys of its joint.
fn wheel(keys: &str, mu: f64) -> String {
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    format!(
        "gravity = {GRAVITY}\n[parameters]\nmu = {mu}\nslope = \"10 deg\"\npull = 0\n[points]\nC = [\"-0.1*sin(slope)\", \"0.1*cos(slope)\"]\n\
         [bodies.wheel]\npoints = [\"C\"]\nmass = 1\nmoment_of_inertia = 0.005\ncentre_of_mass = \"C\"\n\
         [joints.foot]\ntype = \"disc_on_face\"\nblock = \"wheel\"\ncentre = \"C\"\nradius = 0.1\nalong = \"slope\"\nmu = \"mu\"\n{keys}\n\
         [loads.pull]\ntype = \"force\"\nat = \"wheel.C\"\ncomponents = [\"pull*{cos}\", \"pull*{sin}\"]\n\
         [coordinates.x]\nslide = \"foot\"\nvalue = 0\nrate = 0\n"
    )
}

/// What friction cannot do, it does not do: from `mu < tan/3` on the wheel slips, `x'' = g (sin - mu cos)`; drawn up by more than
/// its weight it lifts off.
#[test]
fn what_sticks_in_the_state_may_begin_to_slip() {
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let report = report_on(&wheel("sticks = true", 0.05));
    assert_close(only(&report).coordinates[0].acceleration, GRAVITY * (0.05 * cos - sin), 1.0, 1e-10);
    let text = wheel("sticks = true", 0.5).replace(&format!("[\"pull*{cos}\", \"pull*{sin}\"]"), "[0, 12]");
    let report = report_on(&text);
    assert_eq!(
        report.answer(),
        "It starts to move: foot lifts off. Whatever the loads, only one thing can happen."
    );
    // `hold` lets it slip, too.
    let held = hold(&Model::parse(&wheel("sticks = true", 0.05)).unwrap(), &HoldOptions::default()).unwrap();
    assert_eq!(held.releases.len(), 1);
    assert_ne!(held.releases[0].joints[0].slip, 0);
}

/// A disc released on a plane rolls up to `tan(slope) = 3 mu`, over friction and over the slope.
#[test]
fn limits_find_where_a_disc_begins_to_slip() {
    let model = Model::parse(&wheel("sticks = true", 0.5)).unwrap();
    let found = limits(&model, &LimitsOptions::new(Vary::between("mu", 0.0, 0.6))).unwrap();
    let [slips, rolls] = found.counts.as_slice() else { panic!("{:?}", found.counts) };
    assert_close(slips.to, 10_f64.to_radians().tan() / 3.0, 1.0, 1e-8);
    assert_eq!((slips.solutions, rolls.solutions), (1, 1));
    assert_eq!(rolls.starts.as_deref(), Some(&["it starts to move: foot does not slip".to_owned()][..]));
    assert!(found.answer().contains("it starts to move: foot does not slip"), "{}", found.answer());
}

/// A box that is let go on a plane steeper than `b/h`: it slides flat up to `mu = b/h`, slides and tips up to
/// `mu_2 = (sin - k h/2)/(cos + k b/2)` with `k = 3 (h sin - b cos)/(2 (b^2 + h^2))`, and tips about its edge beyond; of the reference.
#[rstest]
#[case(0.1, 0.4, 40.0, 0.383_406_168_2)]
#[case(0.05, 0.4, 30.0, 0.233_554_816_5)]
#[case(0.3, 0.4, 60.0, 0.931_385_856_3)]
fn limits_find_where_a_box_begins_to_tip(
    #[case] b: f64,
    #[case] h: f64,
    #[case] degrees: f64,
    #[case] second: f64,
) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let k = 1.5 * (h * sin - b * cos) / (b * b + h * h);
    assert_close((sin - k * h / 2.0) / (cos + k * b / 2.0), second, 1.0, 1e-9);
    let text = include_str!("../../models/box-on-incline.toml");
    let model = Model::parse(&text.replace("rate = \"-1 m/s\"", "")).unwrap();
    let list =
        [("b", b), ("h", h), ("slope", degrees.to_radians())].map(|(name, value)| (name, value.to_string()));
    let settings =
        list.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value.as_str()));
    let found =
        limits(&model.with(&settings).unwrap(), &LimitsOptions::new(Vary::between("mu", 0.0, 1.2))).unwrap();
    let [flat, both, tips] = found.counts.as_slice() else { panic!("{:?}", found.counts) };
    assert_close(flat.to, b / h, 1.0, 1e-8);
    assert_close(both.to, second, 1.0, 1e-8);
    let [start] = tips.starts.as_deref().unwrap() else { panic!("{:?}", tips.starts) };
    assert!(start.starts_with("it tips: ") && start.ends_with(", sticks"), "{start}");
}

/// A box at rest on a slope slides from `tan(slope) = mu` on, flat as `mu < b/h`. The direction in which it does turns with the slope;
/// what it does is the same, for `limits` and for maps.
#[test]
fn how_it_starts_does_not_change_with_the_direction_of_the_face() {
    let text = include_str!("../../models/box-on-incline.toml");
    let model = Model::parse(&text.replace("rate = \"-1 m/s\"", "").replace("mu = 0.6", "mu = 0.3")).unwrap();
    let [from, to] = [5.0, 60.0].map(f64::to_radians);
    let found = limits(&model, &LimitsOptions::new(Vary::between("slope", from, to))).unwrap();
    let [sticks, slides] = found.counts.as_slice() else { panic!("{:?}", found.counts) };
    assert_close(sticks.to, 0.3_f64.atan(), 1.0, 1e-8);
    assert_eq!(sticks.starts.as_deref(), Some(&["it holds".to_owned()][..]));
    assert_eq!(slides.starts.as_deref(), Some(&["it starts to move: base slides backwards".to_owned()][..]));
    let options =
        MapOptions::new(Vary::between("slope", from, to), Vary::between("mu", 0.3, 0.4)).size(20, 4);
    let found = map(&model, &options.probe(1).colour_by(ColourBy::Modes)).unwrap();
    assert_eq!(found.classes.len(), 2, "{:?}", found.classes);
}

/// Sweeps have the states of `solve` at every value, and maps tell where a disc rolls from where it is pushed into a slip.
#[test]
fn sweeps_and_maps_know_what_is_at_rest() {
    let model = Model::parse(&wheel("sticks = true", 0.5)).unwrap();
    let sweep = Sweep::new(&model, &SweepOptions::grid(["mu=0..0.2:21".parse().unwrap()])).unwrap();
    let mut state = sweep.start();
    let mut all: Vec<Rows> = Vec::new();
    sweep.run(&mut state, &Rows::clone, &mut |rows, _| {
        all.extend(rows);
        ControlFlow::Continue(())
    });
    let column = |name: &str| sweep.columns().iter().position(|column| column.name == name).unwrap();
    let (x, friction) = (column("acceleration.x"), column("friction_force.foot"));
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let mut seen = 0;
    for (rows, row) in all.iter().flat_map(|rows| (0..rows.len()).map(move |row| (rows, row))) {
        assert_eq!(rows.heads[row].solutions, 1);
        let (mu, numbers) = (rows.numbers(row)[0], rows.numbers(row));
        let force = (mu * cos).min(sin / 3.0) * GRAVITY;
        assert_close(numbers[friction].abs(), force, 1.0, 1e-9);
        assert_close(numbers[x], force - GRAVITY * sin, 1.0, 1e-9);
        seen += 1;
    }
    assert_eq!(seen, 21);
    let options =
        MapOptions::new(Vary::between("mu", 0.0, 0.2), Vary::between("pull", -2.0, 2.0)).size(20, 20);
    let found = map(&model, &options.probe(1).colour_by(ColourBy::Modes)).unwrap();
    // It rolls, or slips: upwards if it is pulled up by more than friction holds, else downwards.
    assert_eq!(found.classes.len(), 3, "{:?}", found.classes);
    assert!(
        found.classes.iter().any(|class| class.words == "it starts to move: foot does not slip"),
        "{:?}",
        found.classes
    );
}

/// A drive that pushes a box along its incline at half its height: it tips from `|F - m g sin| = m g cos b/h` on, before it slides.
#[test]
fn a_drive_at_rest_tells_which_efforts_hold() {
    let text = include_str!("../../models/box-on-incline.toml");
    let text = text.replace("rate = \"-1 m/s\"", "");
    let push = "[drives.push]\ncoordinate = \"x\"\nforce = { at = \"box.C\", direction = \"slope\" }\n";
    let report = drive(&Model::parse(&(text + push)).unwrap(), &DriveOptions::default()).unwrap();
    let (sin, cos) = 20_f64.to_radians().sin_cos();
    let [held] = report.held.as_slice() else { panic!("{:?}", report.held) };
    let [range] = held.held.as_slice() else { panic!("{:?}", held.held) };
    assert_close(range.least.unwrap(), GRAVITY * (sin - cos * 0.5), 1.0, 1e-9);
    assert_close(range.greatest.unwrap(), GRAVITY * (sin + cos * 0.5), 1.0, 1e-9);
    assert!(
        report
            .answer()
            .starts_with("At rest: Without `push` it holds. It holds with `push` from -1.254 to 7.964 N."),
        "{}",
        report.answer()
    );
    assert_eq!(report.directions.len(), 1);
    // No contact pulls.
    let forces = &report.directions[0].range.as_ref().unwrap().undetermined.normal_forces;
    assert!(forces.iter().all(|force| force.from.unwrap() > -1e-9), "{forces:?}");
}

#[test]
fn what_cannot_stick_is_refused() {
    let fault = |text: &str| {
        let found = Model::parse(text).and_then(|model| slideway::solve::solve(&model).map(|_| ()));
        found.unwrap_err().sorted()[0].kind.clone()
    };
    let apart = wheel("sticks = true\nclosed = false", 0.5);
    assert!(matches!(fault(&apart), FaultKind::Both { first: "sticks = true", .. }), "{:?}", fault(&apart));
    // Both ends of a ladder: four rows, three motions.
    let ladder = include_str!("../../models/ladder.toml");
    let ladder = ladder.replace("mu = 0.5\n\n[joints.head]", "mu = 0.5\nsticks = true\n\n[joints.head]");
    let ladder = ladder.replace("mu = 0.3\n", "mu = 0.3\nsticks = true\n");
    assert!(matches!(fault(&ladder), FaultKind::Redundant { .. }), "{:?}", fault(&ladder));
    assert_eq!(report_on(&wheel("sticks = true", 0.5)).status, Status::One);
}

/// Between slipping and sticking nothing is left out: next to the friction from which on the sleeve of the woodpecker sticks there
/// is one state, on either side and however near.
#[test]
fn between_slipping_and_sticking_there_is_a_state() {
    let model = Model::parse(include_str!("../../models/woodpecker.toml")).unwrap();
    let found = limits(&model, &LimitsOptions::new(Vary::between("mu", 0.0, 1.0))).unwrap();
    let [slips, _] = found.counts.as_slice() else { panic!("{:?}", found.counts) };
    for part in [-1e-6, -1e-7, -3e-8, -1e-8, -1e-9, -1e-10, -1e-12, 0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7] {
        let mu = slips.to * (1.0 + part);
        let report = solve(&model.with(&Settings::default().parameter("mu", mu)).unwrap()).unwrap();
        assert_eq!(report.count, "1", "{part}");
    }
}

/// The ladder holds until its person has climbed 0.931438 of it (reference of contacts that may lift off), in one stretch: the states
/// that begin to slide within rounding are the ends of those of rest.
#[test]
fn a_ladder_holds_in_one_stretch() {
    let model = Model::parse(include_str!("../../models/ladder.toml")).unwrap();
    let found = limits(&model, &LimitsOptions::new(Vary::between("climbed", 0.1, 1.0))).unwrap();
    let [holds, slides] = found.counts.as_slice() else { panic!("{} stretches", found.counts.len()) };
    assert_eq!(holds.starts.as_deref(), Some(&["it holds".to_owned()][..]));
    assert_close(holds.to, 0.931_438, 1.0, 1e-6);
    assert_eq!((holds.solutions, slides.solutions), (0, 1));
}
