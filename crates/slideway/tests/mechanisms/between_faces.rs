//! A guided slider along a slope, without transverse load but for rounding: its states between the faces in
//! sweeps, maps, tables of drives, sizes and limits.

use crate::answers::{assert_close, parameters};
use slideway::drive::{DriveOptions, drive};
use slideway::fault::FaultKind;
use slideway::limits::{LimitsOptions, LimitsReport, Vary, limits};
use slideway::map::{ClassMeaning, MapOptions, map};
use slideway::model::Model;
use slideway::size::{Against, SizeOptions, size};
use slideway::solve::solve;
use slideway::sweep::{PointStatus, Rows, Sweep, SweepOptions};
use std::ops::ControlFlow;

/// N = Q - T, and C = M + F h/2 (2 lambda - 1) where that is zero; the drive pushes with -P + F = -4 N as in
/// the model.
const SLOPE: &str = r#"
    [parameters]
    P = "10 N"
    T = "0 N"
    Q = "0 N"
    M = "0.3 N m"
    F = "6 N"
    a = "33 deg"
    mu = 0.3
    [points]
    S = [0.1, 0.27]
    [bodies.b]
    points = ["S"]
    mass = 1
    moment_of_inertia = 0.1
    centre_of_mass = "S"
    [joints.s]
    type = "guided_slider"
    block = "b"
    at = "S"
    along = "a"
    length = 0.3
    height = 0.2
    mu = "mu"
    preload = "F"
    [loads.P]
    type = "force"
    at = "b.S"
    components = ["P*cos(a) - (T - Q)*sin(a)", "P*sin(a) + (T - Q)*cos(a)"]
    [loads.M]
    type = "torque"
    body = "b"
    moment = "M"
    [coordinates.x]
    slide = "s"
    rate = 1
    [drives.d]
    coordinate = "x"
    force = { at = "b.S", direction = "a" }
"#;

fn slope() -> Model {
    Model::parse(SLOPE).expect("sound")
}

/// Rounding leaves a normal force of 1e-16 N at most angles.
#[test]
fn sweeps_have_the_states_of_solve() {
    let slope = slope();
    for vary in
        ["a=10 deg..80 deg:9", "P=-20..20:5", "friction=0..2:5", "mu=0.1..0.4:4", "M=-1..1:9", "x=0..1:3"]
    {
        let sweep = Sweep::new(&slope, &SweepOptions::grid([vary.parse().expect("an axis")])).expect("sound");
        let mut points = 0;
        sweep.run(&mut sweep.start(), &Rows::clone, &mut |rows: Vec<Rows>, _| {
            for rows in rows {
                for (row, head) in rows.heads.iter().enumerate() {
                    let moment = if vary.starts_with('M') { rows.numbers(row)[0] } else { 0.3 };
                    let is_between = moment.abs() < 0.6;
                    let status = if is_between { PointStatus::PreloadGap } else { PointStatus::None };
                    assert_eq!((head.status, head.solutions), (status, 0), "{vary}, point {}", head.point);
                    assert_eq!(head.gap_states, u32::from(is_between), "{vary}, point {}", head.point);
                    points += 1;
                }
            }
            ControlFlow::Continue(())
        });
        assert_eq!(points, sweep.points(), "{vary}");
    }
}

/// The mode problem is bilinear in the moment and the load along the slope, but not in its angle.
#[test]
fn maps_have_them() {
    let size = [6, 5];
    for y in ["P=-20..20", "a=10 deg..80 deg"] {
        let options = MapOptions::new(Vary::between("M", -1.0, 1.0), y.parse().expect("a range"))
            .probe(1)
            .size(size[0], size[1]);
        let report = map(&slope(), &options).expect("sound");
        assert_eq!(report.guarantee.contains("interpolated"), y.starts_with('P'));
        for (column, row) in (0..size[0]).flat_map(|column| (0..size[1]).map(move |row| (column, row))) {
            let moment = (2 * column + 1) as f64 / size[0] as f64 - 1.0;
            let tips = report.classes[report.class_at(column, row)].meaning == ClassMeaning::Tips;
            assert_eq!(tips, moment.abs() > 0.6, "M = {moment}, row {row} of {y}");
        }
    }
}

#[test]
fn tables_of_drives_have_them() {
    let options = DriveOptions::default().vary(Vary::between("M", -1.0, 1.0));
    let report = drive(&slope(), &options).expect("sound");
    for (direction, effort) in report.course.expect("asked for").directions.iter().zip([-4.0, -16.0]) {
        assert_eq!(direction.rows.len(), 11);
        for row in direction.rows.iter().filter(|row| (row.at.abs() - 0.6).abs() > 1e-9) {
            let told = (row.pattern.as_deref(), row.efforts.is_some());
            assert_eq!(
                told,
                if row.at.abs() < 0.6 { (Some("0"), true) } else { (None, false) },
                "{}",
                row.at
            );
            for found in row.efforts.iter().flatten() {
                assert_close(*found, effort, 1.0, 1e-12);
            }
        }
    }
}

/// How far friction may grow before a state between faces ends is not followed: no answer is better than "it
/// is locked", and a range without any answer is refused.
#[test]
fn sizes_have_no_answer_there() {
    let sized = |vary: &str| {
        size(&slope(), &SizeOptions::new(vary.parse().expect("a range"), 1.5).against(Against::Locking))
    };
    let report = sized("M=-1..1").expect("sound");
    let [gap] = &report.without_position[..] else { panic!("{:?}", report.without_position) };
    assert!(gap.reason.contains("between its faces"), "{}", gap.reason);
    assert_close(gap.from, -0.6, 0.0, 1e-8);
    assert_close(gap.to, 0.6, 0.0, 1e-8);
    let locks = report.conclusion.iter().find(|sentence| sentence.contains("locked"));
    assert_eq!(locks, None);

    let faults = sized("friction=0.5..2").expect_err("no answer");
    let kinds: Vec<&FaultKind> = faults.sorted().iter().map(|fault| &fault.kind).collect();
    assert_eq!(kinds, [&FaultKind::BetweenFaces]);
}

fn limits_of(model: &Model, vary: &str) -> LimitsReport {
    let options = LimitsOptions::new(vary.parse().expect("a range")).effort(40).both_directions(true);
    limits(model, &options).unwrap_or_else(|faults| panic!("{vary}: {faults}"))
}

/// The transverse load passes through zero at T = Q: a single value with a state, in either direction, if |M|
/// < 0.6 N m.
#[test]
fn limits_tell_single_values() {
    let slope = slope();
    for (moment, load, range, expected) in [
        ("0.3 N m", "0 N", "T=-1..1", &[0.0][..]),
        ("-0.5 N m", "0.123 N", "T=-0.37..2.11", &[0.123]),
        ("0.3 N m", "0.7 N", "T=0.7..1", &[0.7]),
        ("0.7 N m", "0.123 N", "T=-1..1", &[]),
        ("0.3 N m", "0 N", "T=0.1..1", &[]),
    ] {
        let model = slope.with(&parameters(&[("M", moment), ("Q", load)])).expect("sound");
        let report = limits_of(&model, range);
        let reversed = report.reversed.as_ref().expect("asked for");
        for found in [&report.between_faces_at, &reversed.between_faces_at] {
            assert_eq!(found.len(), expected.len(), "{moment}, {load}, {range}: {found:?}");
            for (found, expected) in found.iter().zip(expected) {
                assert_close(*found, *expected, 1.0, 1e-15);
                let there = model.with(&parameters(&[("T", &format!("{found:e}"))])).expect("sound");
                assert_eq!(solve(&there).expect("solvable").preload_gap_states.len(), 1);
            }
        }
        let told =
            report.conclusion.iter().filter(|sentence| sentence.contains("a state in a preload gap")).count();
        assert_eq!(told, 2 * expected.len(), "{:?}", report.conclusion);
    }
    // Where values are bracketed they are left out, and that is said.
    let bracketed =
        limits_of(&slope.with(&parameters(&[("T", "0.1 N")])).expect("sound"), "a=10 deg..50 deg");
    assert!(bracketed.between_faces_at.is_empty());
    assert!(bracketed.guarantee.contains("are omitted"), "{}", bracketed.guarantee);
}

/// N = 0 along the slope, whatever the moment: the state exists for |M| < F h/2 = 0.6 N m, far less than the
/// distance of the values that are tried.
#[test]
fn limits_find_a_narrow_interval_of_these_states() {
    let report = limits_of(&slope(), "M=-50..50");
    let told: Vec<[f64; 2]> = report.counts.iter().map(|count| [count.from, count.to]).collect();
    assert_eq!(told.len(), 3, "{told:?}");
    // `solve` tells shares within 1e-9 of 0 and 1 as on the boundary, and M = 0.6 N m (2 lambda - 1).
    assert_close(told[1][0], -0.6, 1.0, 2e-9);
    assert_close(told[1][1], 0.6, 1.0, 2e-9);
    let states: Vec<usize> = report.counts.iter().map(|count| count.preload_gap_states).collect();
    assert_eq!(states, [0, 1, 0]);
}

/// At |M| = 0.6 N m the preload rubs on one face, and still nothing presses: with more friction the same
/// state goes on, whatever happens to the modes beside it, so that no margin is told.
#[test]
fn nothing_is_said_of_margins_where_nothing_presses() {
    for moment in ["-0.6 N m", "0 N m", "0.6 N m"] {
        let report = solve(&slope().with(&parameters(&[("M", moment)])).expect("sound")).expect("solvable");
        let states = report.solutions.len() + report.preload_gap_states.len();
        assert_eq!((states, &report.margins), (1, &None), "{moment}");
    }
}
