//! Whether solutions speed up or slow down, against accelerations derived by hand.

use crate::answers::{assert_close, only, report_on};
use rstest::rstest;
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::map::{ColourBy, MapOptions, map};
use slideway::model::Model;
use slideway::report::SpeedChange::{KeepsItsSpeed, SlowsDown, SpeedsUp, StartsForwards};
use slideway::report::{FromRest, Report, SpeedChange, Style};
use slideway::size::{SizeOptions, size};
use slideway::solve::solve;

/// A peg of 10 g that sticks 5 mm deep in a hole and is pushed 12 mm off its axis, by a load or by a drive.
///
/// About a contact: N l0 = P e, so that N = 50 * 12 / 5 = 120 N at both contacts, at opposite faces. The
/// couples of both friction forces cancel. Along the hole: m a = P - 2 mu N, so that a vanishes for
/// mu = l0 / (2 e) = 5/24.
fn peg(mu: &str, push: &str) -> String {
    format!(
        r#"
        [parameters]
        D = "20 mm"
        l0 = "5 mm"
        e = "12 mm"
        mu = "{mu}"
        P = "50 N"
        h = "60 mm"
        [points]
        mid = [0, "-l0/2"]
        top = ["e", "h-l0"]
        [bodies.peg]
        points = ["mid", "top"]
        mass = "10 g"
        centre_of_mass = [0, "h/2-l0"]
        moment_of_inertia = 1e-5
        [joints.hole]
        type = "block_slider"
        block = "peg"
        at = "mid"
        along = "-90 deg"
        length = "l0"
        height = "D"
        mu = "mu"
        front = {{ carried_by = "block" }}
        rear = {{ carried_by = "guide" }}
        [coordinates.z]
        slide = "hole"
        rate = "1 mm/s"
        {push}
        "#
    )
}

const LOAD: &str = r#"
    [loads.push]
    type = "force"
    at = "peg.top"
    components = [0, "-P"]
"#;
const DRIVE: &str = r#"
    [drives.push]
    coordinate = "z"
    force = { at = "peg.top", direction = "-90 deg" }
"#;

#[rstest]
#[case("0.2", SpeedsUp, (50.0 - 48.0) / 0.01)]
#[case("5/24", KeepsItsSpeed, 0.0)]
#[case("0.3", SlowsDown, (50.0 - 72.0) / 0.01)]
fn a_peg_pushed_by_a_load(#[case] mu: &str, #[case] speed: SpeedChange, #[case] acceleration: f64) {
    let report = report_on(&peg(mu, LOAD));
    let solution = only(&report);
    let z = &solution.coordinates[0];
    assert_close(z.acceleration, acceleration, 5e3, 1e-12);
    assert_eq!(z.speed, Some(speed));
    assert_eq!(solution.friction_exceeds_loads, speed == SlowsDown);
    assert_eq!(z.stop.is_some(), speed == SlowsDown);
    let [least, greatest] = z.acceleration_bounds.unwrap();
    assert!(least <= acceleration && acceleration <= greatest && greatest - least < 1e-7);
}

#[test]
fn a_peg_that_slows_down_stops_and_stays() {
    let report = report_on(&peg("0.3", LOAD));
    let stop = only(&report).coordinates[0].stop.unwrap();
    // v / |a| and v^2 / (2 |a|) with v = 1 mm/s and a = -2200 m/s^2
    assert_close(stop.time, 1e-3 / 2200.0, 0.0, 1e-12);
    assert_close(stop.distance, 1e-6 / 4400.0, 0.0, 1e-12);
    assert_eq!(report.from_rest, Some(FromRest::Rests));
    let text = report.text(Style::PLAIN.verbose(true).width(200));
    for sentence in [
        "It slows down at 2200 m/s^2.",
        "With this acceleration z would stop after 4.5455e-7 s and 2.2727e-7 mm.",
        "It slows down because friction exceeds the loads. Whether a push keeps it moving: give the push as a drive, or ask `slideway hold`.",
        "At rest in this position, these loads would not move it.",
        "This contact mode remains however much friction grows, but the motion slows down in it.",
    ] {
        assert!(text.contains(sentence), "{sentence}\n{text}");
    }
}

#[test]
fn of_a_prescribed_motion_no_speed_is_told() {
    let report = report_on(&peg("0.2", DRIVE));
    let solution = only(&report);
    assert_eq!((solution.coordinates[0].speed, report.from_rest), (None, None));
    assert!(!solution.friction_exceeds_loads);
}

/// The friction above which pushing does not keep it moving is a zero in closed form.
#[test]
fn limits_tell_where_the_acceleration_vanishes() {
    let model = Model::parse(&peg("0.3", LOAD)).unwrap();
    let report = limits(&model, &LimitsOptions::new(Vary::between("mu", 0.0, 1.0))).unwrap();
    let [mode] = report.modes.as_slice() else { panic!("one mode") };
    let [up, down] = mode.speeds.as_slice() else { panic!("two stretches: {:?}", mode.speeds) };
    assert_eq!((up.speed, down.speed), (SpeedsUp, SlowsDown));
    assert_eq!((up.from, up.to, down.to), (0.0, down.from, 1.0));
    assert_close(up.to, 5.0 / 24.0, 0.0, 1e-15);
    let stretches = [
        "mu from 0 to 0.208333: it speeds up (one solution).",
        "mu from 0.208333 to 1: it slows down (one solution).",
    ];
    assert_eq!(report.conclusion[..2], stretches);
}

/// The depth enters where a force acts, and is scanned: 2 mu N = P at l0 = 2 mu e = 7.2 mm.
#[test]
fn limits_bisect_where_the_acceleration_vanishes() {
    let model = Model::parse(&peg("0.3", LOAD)).unwrap();
    let mut options = LimitsOptions::new(Vary::between("l0", 0.004, 0.02));
    options.effort = 0;
    let report = limits(&model, &options).unwrap();
    let speeds: Vec<_> = report.modes.iter().flat_map(|mode| &mode.speeds).collect();
    let [down, up] = speeds.as_slice() else { panic!("two stretches: {speeds:?}") };
    assert_eq!((down.speed, up.speed), (SlowsDown, SpeedsUp));
    assert_close(down.to, 2.0 * 0.3 * 0.012, 0.0, 1e-12);
}

/// A block of 3 kg on an incline of 30 degrees, moving up.
fn block(mu: f64, rate: &str) -> String {
    format!(
        r#"
        gravity = 9.81
        [points]
        M = [0, 0]
        [bodies.block]
        points = ["M"]
        mass = 3
        centre_of_mass = "M"
        moment_of_inertia = 0.2
        [joints.incline]
        type = "block_slider"
        block = "block"
        at = "M"
        along = "30 deg"
        length = 0.5
        mu = {mu}
        [coordinates.s]
        slide = "incline"
        {rate}
        "#
    )
}

/// Moving up, a = -g (sin + mu cos); from rest it stays if mu >= tan(30 deg) = 0.577, else it slides back.
#[rstest]
#[case(0.1, FromRest::MovesBack)]
#[case(0.57, FromRest::MovesBack)]
#[case(0.58, FromRest::Rests)]
fn a_block_that_moves_up_an_incline_stops_and_slides_back_or_stays(
    #[case] mu: f64,
    #[case] expected: FromRest,
) {
    let (sin, cos) = f64::to_radians(30.0).sin_cos();
    let report = report_on(&block(mu, "rate = 2"));
    let s = &only(&report).coordinates[0];
    assert_close(s.stop.unwrap().distance, 2.0 / (9.81 * (sin + mu * cos)), 0.0, 1e-12);
    assert_eq!(report.from_rest, Some(expected));
    // The weight brakes it, too.
    assert!(!only(&report).friction_exceeds_loads);
}

/// Three tubes stick or slide in two directions, with two sides at each of six contacts: 27 * 64 states.
#[test]
fn of_many_states_of_rest_it_is_told_that_they_are_not_examined() {
    let boom = crate::answers::report("telescopic-boom", &[("F", "0 N")]);
    assert_eq!(boom.from_rest, Some(FromRest::NotExamined));
    let text = boom.text(Style::PLAIN);
    assert!(text.contains("these loads may move it or not; ask `slideway hold`."), "{text}");
}

/// Moving down at mu = 0.6 > tan(30 deg) its weight pushes it, and friction takes more.
#[test]
fn a_block_that_moves_down_a_rough_incline_is_braked_by_friction() {
    let report = report_on(&block(0.6, "rate = -2"));
    assert_eq!(only(&report).coordinates[0].speed, Some(SlowsDown));
    assert!(only(&report).friction_exceeds_loads);
    assert_eq!(report.from_rest, Some(FromRest::Rests));
}

#[test]
fn a_rate_that_is_not_given_is_not_told_as_one() {
    let report = report_on(&block(0.0, "").replace("30 deg", "-30 deg"));
    assert_eq!(report.rates_not_given, ["s"]);
    assert_eq!(only(&report).coordinates[0].speed, Some(StartsForwards));
    let text = report.text(Style::PLAIN);
    assert!(text.contains("It starts forwards (the model gives no rate: it is taken as zero)."), "{text}");
}

/// The same sentence wherever a load that friction stops could be taken for one that does not jam.
#[test]
fn every_answer_on_a_load_says_how_to_ask_whether_it_jams() {
    const HOW: &str = "Whether a push keeps it moving: give the push as a drive, or ask `slideway hold`.";
    let told = |push: &str| -> Vec<String> {
        let model = Model::parse(&peg("0.3", push)).unwrap();
        let limits = limits(&model, &LimitsOptions::new(Vary::between("mu", 0.0, 0.5))).unwrap();
        let size = size(&model, &SizeOptions::new(Vary::usual("e"), 2.0)).unwrap();
        let map = |colour_by: ColourBy| {
            let axes = MapOptions::new(Vary::between("mu", 0.0, 0.5), Vary::between("e", 0.002, 0.02));
            map(&model, &axes.size(16, 16).colour_by(colour_by)).unwrap().text(Style::PLAIN.width(200))
        };
        vec![
            report_on(&peg("0.3", push)).text(Style::PLAIN.width(200)),
            limits.text(Style::PLAIN.width(200)),
            size.text(Style::PLAIN.width(200)),
            map(ColourBy::Jam),
            map(ColourBy::Margin),
        ]
    };
    assert!(told(LOAD).iter().all(|text| text.matches(HOW).count() == 1), "{:?}", told(LOAD));
    assert!(told(DRIVE).iter().all(|text| !text.contains(HOW)), "{:?}", told(DRIVE));
}

/// Below mu = 5/24 friction never takes more than the load gives: nothing to be said.
#[test]
fn a_load_that_friction_does_not_stop_needs_no_such_sentence() {
    let model = Model::parse(&peg("0.1", LOAD)).unwrap();
    let report = limits(&model, &LimitsOptions::new(Vary::between("mu", 0.0, 0.2))).unwrap();
    assert!(!report.text(Style::PLAIN).contains("To ask whether it jams"), "{:?}", report.conclusion);
}

/// A massless mechanism under loads has no accelerations: every analysis that asks for them says so, and what to ask
/// instead.
#[test]
fn what_is_massless_is_refused_with_what_to_ask_instead() {
    let text = peg("0.3", LOAD).replace("mass = \"10 g\"", "massless = true");
    let text = text.replace("moment_of_inertia = 1e-5", "").replace("centre_of_mass = [0, \"h/2-l0\"]", "");
    let model = Model::parse(&text).unwrap();
    let vary = || Vary::between("mu", 0.0, 0.5);
    for faults in [
        solve(&model).unwrap_err(),
        limits(&model, &LimitsOptions::new(vary())).unwrap_err(),
        size(&model, &SizeOptions::new(vary(), 2.0)).unwrap_err(),
        map(&model, &MapOptions::new(vary(), Vary::between("e", 0.002, 0.02)).size(8, 8)).unwrap_err(),
    ] {
        let told = faults.sorted()[0].kind.with_hint();
        assert!(
            told.contains("the moving parts have no mass") && told.contains("`slideway hold` says"),
            "{told}"
        );
    }
}
