//! Contacts that the drives keep at rest while the rest moves: their friction is a range.

use crate::answers::assert_close as close;
use slideway::drive::{DriveOptions, drive};
use slideway::fault::{FaultKind, NoSliding};
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::model::{Model, Settings};
use slideway::report::{OpenRange, SolveReport, Status};
use slideway::size::{Against, SizeOptions, size};
use slideway::solve::solve;

/// From an independent review: two bars whose ends A run straight up, and a platform on both. The upper slot keeps its
/// place as both drives run alike.
const SCOTT_RUSSELL: &str = include_str!("../findings/double_scott_russell.toml");

/// A sled (100 N) runs on the floor, mu = 0.3. A load of 50 N hangs in its upright slot, held by a drive at rest, and is
/// pressed against the slot by H = 10 N.
const SLED: &str = r#"
[parameters]
mu_static = 0.5
F_0 = "0 N"
[points]
floor = [0, 0]
lift = [0, "0.2 m"]
[bodies.sled]
points = ["floor"]
massless = true
[bodies.load]
points = ["lift"]
massless = true
[joints.rail]
type = "guided_slider"
block = "sled"
at = "floor"
along = "0 deg"
length = "1 m"
mu = 0.3
[joints.lift]
type = "guided_slider"
block = "load"
guide = "sled"
at = "lift"
along = "90 deg"
length = "1 m"
mu = 0.2
mu_static = "mu_static"
preload = "F_0"
[loads.sled]
type = "force"
at = "sled.floor"
components = [0, "-100 N"]
[loads.load]
type = "force"
at = "load.lift"
components = ["10 N", "-50 N"]
[drives.push]
coordinate = "x"
force = { at = "sled.floor", direction = "0 deg" }
[drives.hold]
coordinate = "y"
force = { at = "load.lift", direction = "90 deg" }
[coordinates.x]
slide = "rail"
rate = "0.1 m/s"
[coordinates.y]
slide = "lift"
rate = "0 m/s"
"#;

fn model(text: &str) -> Model {
    Model::parse(text).unwrap_or_else(|faults| panic!("{faults}"))
}

#[track_caller]
fn assert_range(range: &OpenRange, expected: [f64; 2]) {
    for (found, expected) in [range.from, range.to].into_iter().zip(expected) {
        close(found.unwrap(), expected, 1.0, 1e-9);
    }
}

fn ranges(report: &SolveReport) -> &slideway::report::Undetermined {
    assert_eq!(report.status, Status::Continuum);
    report.undetermined.as_ref().unwrap()
}

/// The drive that holds carries `50 N - T` with `|T| <= mu_static H + F_0`, the floor the rest: `N = 150 N - hold`. The sled
/// needs `push = 0.3 N - H`.
#[test]
fn a_load_that_a_drive_holds_in_a_slot_may_hang_on_its_friction() {
    for (mu_static, preload) in [(0.5, 0.0), (0.2, 0.0), (0.5, 3.0)] {
        let settings = Settings::default().parameter("mu_static", mu_static).parameter("F_0", preload);
        let report = solve(&model(SLED).with(&settings).unwrap()).unwrap();
        let most = mu_static * 10.0 + preload;
        let open = ranges(&report);
        let [friction] = open.friction.as_slice() else { panic!("one slot") };
        assert_eq!((&*friction.name, friction.unit), ("lift", "N"));
        assert_range(friction, [-most, most]);
        let [push, hold] = open.efforts.as_slice() else { panic!("two drives") };
        assert_range(hold, [50.0 - most, 50.0 + most]);
        assert_range(push, [0.3 * (100.0 - most) - 10.0, 0.3 * (100.0 + most) - 10.0]);
        assert!(report.continua.iter().all(|continuum| continuum.tipping.is_empty()));
    }
}

/// Beside two such loads the corners are those of a square.
#[test]
fn several_slots_that_stand_have_a_polygon_of_forces() {
    let part = |from: &str, to: &str| {
        let start = SLED.find(from).unwrap();
        &SLED[start..start + SLED[start..].find(to).unwrap()]
    };
    let rename = |text: &str| {
        let names =
            [(".load]", ".other]"), ("\"load\"", "\"other\""), ("\"load.", "\"other."), ("lift", "lift_2")];
        let names = names.into_iter().chain([("hold", "hold_2"), ("\"y\"", "\"z\"")]);
        names.fold(text.to_owned(), |text, (from, to)| text.replace(from, to))
    };
    let parts = [
        ("[bodies.load]", "[joints.rail]"),
        ("[joints.lift]", "[loads.sled]"),
        ("[loads.load]", "[drives.push]"),
        ("[drives.hold]", "[coordinates.x]"),
    ];
    let mut text = SLED.replace("[bodies.sled]", "lift_2 = [0, \"-0.2 m\"]\n[bodies.sled]");
    for (from, to) in parts {
        text.push_str(&rename(part(from, to)));
    }
    text.push_str("[coordinates.z]\nslide = \"lift_2\"\nrate = \"0 m/s\"\n");
    let report = solve(&model(&text)).unwrap();
    let open = ranges(&report);
    assert_eq!(open.friction.len(), 2);
    open.friction.iter().for_each(|range| assert_range(range, [-5.0, 5.0]));
    // N = 100 N + T_1 + T_2, both loads push.
    assert_range(&open.efforts[0], [0.3 * 90.0 - 20.0, 0.3 * 110.0 - 20.0]);
    assert_eq!(report.continua.iter().map(|continuum| continuum.vertices.len()).max(), Some(4));
}

/// `T` in the upper slot turns a bar about its straight line: the lower slot carries `T tan(theta)`, and each drive
/// `500 N cot(theta)` for the load and `mu |T| tan(theta)` for that slot.
#[test]
fn a_platform_on_two_straight_lines_has_a_range_of_efforts() {
    let theta = 35.0_f64.to_radians();
    let (load, most) = (500.0 / theta.tan(), 0.2 * 50.0 * theta.tan());
    let report = solve(&model(SCOTT_RUSSELL)).unwrap();
    let open = ranges(&report);
    assert_range(&open.friction[0], [-50.0, 50.0]);
    open.efforts.iter().for_each(|effort| assert_range(effort, [load, load + most]));
    let driven = drive(&model(SCOTT_RUSSELL), &DriveOptions::default()).unwrap();
    let [there, back] = driven.directions.as_slice() else { panic!("two directions") };
    for (direction, [from, to]) in [(there, [load, load + most]), (back, [load - most, load])] {
        let range = direction.range.as_ref().unwrap();
        range.undetermined.efforts.iter().for_each(|effort| assert_range(effort, [from, to]));
    }
    let vary = DriveOptions::default().vary(Vary::between("mu", 0.0, 0.4)).rows(3);
    let course = drive(&model(SCOTT_RUSSELL), &vary).unwrap().course.unwrap();
    for row in &course.directions[0].rows {
        let range = row.range.as_ref().unwrap();
        assert_range(&range.undetermined.efforts[1], [load, load + row.at / 0.2 * most]);
    }
    let words = driven.conclusion.join(" ");
    assert!(
        words.contains("friction at top, which does not slide, can have any value within its limits"),
        "{words}"
    );
}

/// Whatever the friction of the slot, if it has any.
#[test]
fn limits_have_infinitely_many_solutions_there() {
    for vary in [Vary::between("mt", 0.0, 1.0), Vary::between("friction", 0.0, 2.0)] {
        let report = limits(&model(SCOTT_RUSSELL), &LimitsOptions::new(vary)).unwrap();
        let [count] = report.counts.as_slice() else { panic!("{:?}", report.counts) };
        assert!(count.continuum && count.solutions == 0 && count.from.abs() < 1e-9, "{count:?}");
        assert!(report.conclusion[0].contains("infinitely many solutions"), "{:?}", report.conclusion);
    }
}

/// `push <= 20 N + 3 mu_static N < hold <= 50 N + 10 mu_static N`, and the floor carries at most `100 N + 10 mu_static N`.
#[test]
fn sizes_keep_the_greatest_force_of_a_range() {
    let most = |against: Against, limit: f64| {
        let vary = Vary::between("mu_static", 0.2, 1.0);
        let report = size(&model(SLED), &SizeOptions::new(vary, limit).against(against)).unwrap();
        let [met] = report.met.as_slice() else { panic!("{:?}", report.met) };
        assert_eq!(met.from, 0.2);
        assert!(report.without_position.is_empty());
        met.to
    };
    close(most(Against::Effort { drive: None }, 56.0), 0.6, 1.0, 1e-9);
    close(most(Against::Effort { drive: Some("push".into()) }, 21.5), 0.5, 1.0, 1e-9);
    close(most(Against::NormalForce { contact: None }, 104.0), 0.4, 1.0, 1e-9);
    close(most(Against::NormalForce { contact: Some("lift".into()) }, 12.0), 1.0, 1.0, 1e-9);
}

/// The ends of a range are the solutions in which the slot slides a little, either way.
#[test]
fn the_ends_of_a_range_are_those_of_a_slot_that_begins_to_slide() {
    let at = |rate: f64| {
        let settings = Settings::default().rate("y", rate).parameter("mu_static", 0.2);
        solve(&model(SLED).with(&settings).unwrap()).unwrap()
    };
    let open = at(0.0).undetermined.unwrap();
    let ends = [-1e-9, 1e-9].map(|rate| {
        let sliding = at(rate);
        let [solution] = sliding.solutions.as_slice() else { panic!("{}", sliding.count) };
        [0, 1].map(|drive| solution.drives[drive].effort)
    });
    for (drive, range) in open.efforts.iter().enumerate() {
        let [one, other] = ends.map(|efforts| efforts[drive]);
        assert_range(range, [one.min(other), one.max(other)]);
    }
}

/// Without friction in the slot there is one solution.
#[test]
fn a_slot_without_friction_leaves_nothing_open() {
    let smooth = model(SCOTT_RUSSELL).with(&Settings::default().parameter("mt", 0)).unwrap();
    assert_eq!(solve(&smooth).unwrap().status, Status::One);
}

/// What is not computed beside what stands is refused with the way to an answer.
#[test]
fn a_greatest_reaction_and_a_margin_name_what_stands() {
    let lift = model(SCOTT_RUSSELL);
    let vary = || "mu=0.1..0.3".parse::<Vary>().unwrap();
    let mut options = LimitsOptions::new(vary());
    options.max_reaction = Some(500.0);
    let faults =
        [limits(&lift, &options).unwrap_err(), size(&lift, &SizeOptions::new(vary(), 1.5)).unwrap_err()];
    for faults in faults {
        let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
        let FaultKind::BesideStanding { contacts, .. } = &fault.kind else { panic!("{faults}") };
        assert_eq!(contacts, &["top"]);
        let hint = fault.kind.hint().unwrap();
        assert!(hint.contains("limits --vary friction") && hint.contains("--max-normal-force"), "{hint}");
    }
}

/// Without its drive the load may begin to fall, and a drive that accelerates it moves it.
#[test]
fn what_may_begin_to_slide_does_not_stand() {
    let start = SLED.find("[drives.hold]").unwrap();
    let end = SLED.find("[coordinates.x]").unwrap();
    let free = format!("{}{}", &SLED[..start], &SLED[end..]).replace(
        "[bodies.load]",
        "[bodies.load]\nmass = \"5 kg\"\nmoment_of_inertia = \"1 kg m^2\"\ncentre_of_mass = \"lift\"",
    );
    let free = free.replacen("massless = true\n[joints.rail]", "[joints.rail]", 1);
    let accelerated = SLED.replace("coordinate = \"y\"", "coordinate = \"y\"\nacceleration = \"1 m/s^2\"");
    for text in [free, accelerated] {
        let faults = solve(&model(&text)).unwrap_err();
        let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
        let FaultKind::ZeroSlidingVelocity { why, .. } = &fault.kind else { panic!("{faults}") };
        assert_eq!(*why, NoSliding::WithoutRate(vec!["y".to_owned()]));
    }
}
