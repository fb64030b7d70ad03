//! Preload gaps of all kinds of joint: known answers, all patterns by brute force, and what `hold` and
//! motions say.

use crate::answers::{acceleration, assert_close, report_on, try_report_on};
use crate::brute_force::{unreachable, velocity_signs};
use crate::drawing::{Drawing, Kind, SliderKind};
use crate::random_mechanisms::{cases, mechanisms};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use slideway::configuration::Configuration;
use slideway::mechanism::Mechanism;
use slideway::model::Model;
use slideway::modes::Side;
use slideway::motion::decision::{Standing, Successor, successors};
use slideway::motion::{ContactPhase, End, JointPhase, Phase, SimulateOptions, simulate};
use slideway::report::{CertificateKind, Proof, SolveReport, Status};
use slideway::solve::solve;
use slideway::standstill::{HoldOptions, HoldVerdict, hold};
use std::cell::Cell;
use std::collections::BTreeSet;

/// Values closer to what bounds them than this, relative to the greatest, are left to other tests.
const NEAR: f64 = 1e-6;

/// A plate on two fixed pins; the preload of one of them differs by side, and the faces of a pin coincide.
const PLATE: &str = r#"
    gravity = "9.81 m/s^2"
    [bodies.b]
    mass = "3 kg"
    moment_of_inertia = "0.0115 kg m^2"
    centre_of_mass = ["-0.2 m", "-0.3 m"]
    [joints.s0]
    type = "pin_in_slot"
    block = "ground"
    guide = "b"
    at = ["-0.17 m", "0.29 m"]
    along = "-102 deg"
    mu = 0.87
    preload = { plus = "8.5 N", minus = "14.7 N" }
    [joints.s1]
    type = "pin_in_slot"
    block = "ground"
    guide = "b"
    at = ["-0.01 m", "-0.41 m"]
    along = "119 deg"
    mu = 0.48
    [coordinates.q]
    slide = "s1"
    rate = "0.001 m/s"
"#;

/// Share, normal force of s1 and the plate's accelerations with `N_0 = 0`, by Newton's and Euler's equations.
///
/// The plate is the guide, so that at either pin it is pushed by `-N n` and dragged by `+F u`, at the pin.
/// The velocity is so small that its points at the pins accelerate along `u` alone:
///
/// ```text
/// m a = m g + F_0 u_0 + F_1 u_1 - N_1 n_1,      J alpha = moments about the centre of mass,      n_k . (a + alpha x r_k) = 0
/// ```
fn plate_by_hand() -> (f64, f64, [f64; 3]) {
    let centre = [-0.2, -0.3];
    let pins = [([-0.17, 0.29], -102_f64, -1.0), ([-0.01, -0.41], 119_f64, 1.0)];
    let geometry = pins.map(|(at, along, sliding): ([f64; 2], f64, f64)| {
        let (sin, cos) = along.to_radians().sin_cos();
        let arm = [at[0] - centre[0], at[1] - centre[1]];
        (arm, [cos, sin], [-sin, cos], sliding)
    });
    // Unknowns: a_x, a_y, alpha, F_0, N_1; F_1 = 0.48 |N_1| s_1, N_1 > 0.
    let mut matrix = DMatrix::zeros(5, 5);
    let mut right = DVector::zeros(5);
    let (mass, inertia) = (3.0, 0.0115);
    (matrix[(0, 0)], matrix[(1, 1)], matrix[(2, 2)]) = (mass, mass, inertia);
    right[1] = -mass * 9.81;
    let mut force = |column: usize, arm: [f64; 2], [x, y]: [f64; 2]| {
        matrix[(0, column)] -= x;
        matrix[(1, column)] -= y;
        matrix[(2, column)] -= arm[0] * y - arm[1] * x;
    };
    let [(arm_0, u_0, _, _), (arm_1, u_1, n_1, s_1)] = geometry;
    force(3, arm_0, u_0);
    force(4, arm_1, [-n_1[0] + 0.48 * s_1 * u_1[0], -n_1[1] + 0.48 * s_1 * u_1[1]]);
    for (row, (arm, _, n, _)) in geometry.into_iter().enumerate() {
        matrix[(3 + row, 0)] = n[0];
        matrix[(3 + row, 1)] = n[1];
        matrix[(3 + row, 2)] = n[1] * arm[0] - n[0] * arm[1];
    }
    let solution = matrix.lu().solve(&right).unwrap();
    // |F_0| = share 8.5 N + (1 - share) 14.7 N, against the velocity.
    let share = (14.7 - solution[3].abs()) / (14.7 - 8.5);
    (share, solution[4], [solution[0], solution[1], solution[2]])
}

#[test]
fn a_preload_that_differs_by_side_leaves_a_gap_where_faces_coincide() {
    let (share, normal_force, accelerations) = plate_by_hand();
    assert_close(share, 0.598, 0.0, 1e-3);
    let model = Model::parse(PLATE).unwrap();
    let report = solve(&model).unwrap();
    assert_eq!((report.status, report.complete), (Status::PreloadGap, Proof::Proven));
    let state = &report.preload_gap_states[0];
    assert_close(state.contacts[0].preload_share.unwrap(), share, 1.0, 1e-5);
    assert_close(state.contacts[1].normal_force, normal_force, 0.0, 1e-5);
    assert_close(acceleration(state, "b")[0], accelerations[0], 0.0, 1e-5);
    let sliding = state.coordinates[0].acceleration;
    assert_close(sliding, 4.58, 0.0, 1e-3);

    // At rest it begins to move in the same way.
    let held = hold(&model, &HoldOptions::default()).unwrap();
    assert_eq!(held.verdict, HoldVerdict::Moves);
    let [release] = &held.releases[..] else { panic!("{:?}", held.releases) };
    assert_eq!((release.joints[0].slip, release.joints[1].slip), (-1, 1));
    assert_eq!(release.patterns, ["0+"]);
    assert_close(release.coordinates[0].acceleration.least.unwrap(), sliding, 0.0, 1e-5);

    // And it goes on so: the friction in the gap turns over continuously.
    let history = simulate(&model, &SimulateOptions::new(0.05)).unwrap();
    assert_eq!(history.end, End::Finished);
    let phase = &history.phases[0].phase;
    assert_eq!(phase.contacts, [ContactPhase::PreloadGap, ContactPhase::Pressed(Side::Positive)]);
    assert!(history.energy_error <= 1e-9 * history.energy_scale);
}

/// A drawer with a packing at either end, pressed down by 8 N through a point above its middle.
fn drawer(rate: f64, load: [f64; 2]) -> SolveReport {
    report_on(&format!(
        r#"
        [points]
        S = [0, "0.1 m"]
        [bodies.b]
        points = ["S"]
        mass = "1 kg"
        moment_of_inertia = "0.1 kg m^2"
        centre_of_mass = [0, 0]
        [joints.s]
        type = "block_slider"
        block = "b"
        at = [0, 0]
        along = 0
        length = "0.3 m"
        height = "0.2 m"
        mu = 1
        preload = "6 N"
        [loads.P]
        type = "force"
        at = "b.S"
        components = [{}, {}]
        [coordinates.x]
        slide = "s"
        rate = {rate}
        "#,
        load[0], load[1]
    ))
}

#[test]
fn both_ends_are_not_in_their_gaps_under_a_transverse_load() {
    // Nothing but N_f + N_r = 8 N can carry the load, so one end at least is pressed. With the other one, 6 N
    // between its faces: moments about the centre of mass, friction of the pressed end (mu N + F_0) s = 14 N
    // s at the lower face,
    //     rate 1:  N_f l/2 - 14 h/2 + (1 - 2 share) 6 h/2 - 0.1 = 0:   1.2 - 1.4 + 0.6 (1 - 2 share) - 0.1 = 0, share 1/4
    //     rate -1: -N_r l/2 + 14 h/2 - (1 - 2 share) 6 h/2 - 0.1 = 0:  -1.2 + 1.4 - 0.6 (1 - 2 share) - 0.1 = 0, share 5/12
    for (rate, pattern, share, acceleration_x) in [(1.0, "+0", 0.25, -19.0), (-1.0, "0+", 5.0 / 12.0, 21.0)] {
        let report = drawer(rate, [1.0, -8.0]);
        assert_eq!((report.status, report.complete), (Status::PreloadGap, Proof::Proven));
        assert!(report.undecided_modes.is_empty(), "{:?}", report.undecided_modes);
        let [state] = &report.preload_gap_states[..] else { panic!("one state") };
        assert_eq!(state.pattern, pattern);
        let shares = state.contacts.iter().find_map(|contact| contact.preload_share);
        assert_close(shares.unwrap(), share, 0.0, 1e-12);
        assert_close(acceleration(state, "b")[0], acceleration_x, 0.0, 1e-12);
    }
    // Without it both may be, with a continuum of shares; or the drawer tips, (N_f - N_r) l/2 = 0.1 N m.
    let report = drawer(1.0, [1.0, 0.0]);
    assert_eq!(report.status, Status::One);
    assert_close(report.solutions[0].contacts[0].normal_force, 1.0 / 3.0, 0.0, 1e-12);
    assert!(!report.preload_gap_states.is_empty());
    assert!(report.preload_gap_states.iter().all(|state| state.signs == [0, 0]));
}

#[test]
fn a_found_state_is_the_answer_whatever_is_open_beside_it() {
    // 1e-15 N across: within the rounding of 8 - 8 both ends may be in their gaps.
    let report = drawer(1.0, [1.0, 1e-15]);
    assert_ne!(report.status, Status::Unknown, "{:?}", report.undecided_modes);
}

/// A guided slider with a packing, no transverse load, a force along it, and a couple.
fn guided(preload: &str, height: f64, couple: f64, across: &str) -> SolveReport {
    report_on(&format!(
        r#"
        [parameters]
        across = "{across}"
        [points]
        S = [0, 0]
        [bodies.b]
        points = ["S"]
        mass = "1 kg"
        moment_of_inertia = "0.1 kg m^2"
        centre_of_mass = [0, 0]
        [joints.s]
        type = "guided_slider"
        block = "b"
        at = [0, 0]
        along = 0
        length = "0.3 m"
        height = {height}
        mu = 0.3
        preload = {preload}
        [loads.P]
        type = "force"
        at = "b.S"
        components = ["10 N", "across"]
        [loads.T]
        type = "torque"
        body = "b"
        moment = {couple}
        [coordinates.x]
        slide = "s"
        rate = "1 m/s"
        "#
    ))
}

#[test]
fn a_guided_slider_without_normal_force_transmits_no_couple() {
    // Friction F = share F^+ + (1 - share) F^- against x; its moment about the centre line is that of F^- at
    // the upper less that of F^+ at the lower face, and has to balance the torque T alone:
    //     [(1 - share) F^- - share F^+] h/2 + T = 0
    for (preload, faces, couple) in [
        ("6", [6.0, 6.0], 0.0),
        ("6", [6.0, 6.0], 0.3),
        ("6", [6.0, 6.0], -0.45),
        ("{ plus = 6, minus = 2 }", [6.0, 2.0], 0.0),
        ("{ plus = 6, minus = 2 }", [6.0, 2.0], 0.25),
    ] {
        let share = (faces[1] * 0.1 + couple) / ((faces[0] + faces[1]) * 0.1);
        let friction = share * faces[0] + (1.0 - share) * faces[1];
        let report = guided(preload, 0.2, couple, "0 N");
        assert_eq!((report.status, report.gap_state_count.as_str()), (Status::PreloadGap, "1"));
        let [state] = &report.preload_gap_states[..] else { panic!("one state") };
        // It exists for this load alone.
        assert_eq!((state.certificate, state.on_boundary), (CertificateKind::OnBoundary, true));
        assert_eq!((state.pattern.as_str(), state.signs.as_slice()), ("0", &[0_i8][..]));
        let contact = &state.contacts[0];
        assert_eq!(contact.normal_force, 0.0);
        assert_close(contact.couple.unwrap(), 0.0, 1.0, 1e-14);
        assert_close(contact.preload_share.unwrap(), share, 1.0, 1e-12);
        assert_close(acceleration(state, "b")[0], 10.0 - friction, 0.0, 1e-12);
        assert!(state.residual < 1e-12);
        assert!(report.margins.is_none());
    }
    // A torque beyond F_0 h/2 tips it, and so does friction on one face as soon as there is any normal force.
    for (couple, across) in [(0.7, "0 N"), (0.0, "0.001 N"), (0.0, "-0.001 N")] {
        let report = guided("6", 0.2, couple, across);
        assert_eq!((report.status, report.rejected.len()), (Status::None, 1), "{couple} {across}");
        assert!(report.preload_gap_states.is_empty());
    }
    // At the end of the range the friction is at one face: an ordinary solution about to change side.
    let report = guided("6", 0.2, 0.6, "0 N");
    assert_eq!((report.status, report.solutions[0].pattern.as_str()), (Status::One, "+"));
}

#[test]
fn a_gap_that_exists_for_some_load_within_a_range_is_not_ruled_out() {
    let report = guided("6", 0.2, 0.0, "-1..1 N");
    let uncertainty = report.uncertainty.unwrap();
    let patterns: Vec<&str> = uncertainty.modes.iter().map(|mode| mode.pattern.as_str()).collect();
    assert_eq!(patterns, ["0"]);
    assert_eq!(uncertainty.modes[0].persistence, slideway::report::Persistence::Undecided);
    // With 1 N or more across there is none.
    let report = guided("6", 0.2, 0.0, "0.5..1 N");
    assert!(report.uncertainty.unwrap().modes.is_empty());
}

#[test]
fn friction_at_coinciding_faces_may_be_that_of_either_side() {
    // N = 0, and nothing says how much of the preload is felt: the ends of the range are two states.
    let report = guided("{ plus = 6, minus = 2 }", 0.0, 0.0, "0 N");
    let mut found: Vec<f64> = report.solutions.iter().map(|state| acceleration(state, "b")[0]).collect();
    found.sort_by(f64::total_cmp);
    assert_eq!(found.len(), 2);
    assert_close(found[0], 4.0, 0.0, 1e-12);
    assert_close(found[1], 8.0, 0.0, 1e-12);
}

#[test]
fn whether_a_slider_pressed_against_its_other_face_tips_is_proven() {
    // N = -10 N, friction mu N = 3 N at the upper face, h/2 = 0.1 m above the centre of mass: C = -0.3 N m,
    // and 10 N times half the length is 1.5 N m.
    let report = guided("0", 0.2, 0.0, "10 N");
    let state = &report.solutions[0];
    assert_eq!((state.pattern.as_str(), state.certificate), ("-", CertificateKind::Proven));
    assert_close(state.contacts[0].couple.unwrap(), -0.3, 0.0, 1e-12);
    // With a torque of 1.3 N m more C = -1.6 N m; were the friction at the lower face it would be -1 N m.
    let report = guided("0", 0.2, 1.3, "10 N");
    assert_eq!((report.status, report.complete), (Status::None, Proof::Proven));
    let report = guided("0", 0.2, -1.3, "10 N");
    assert_eq!((report.status, report.solutions[0].certificate), (Status::One, CertificateKind::Proven));
}

#[test]
fn a_cart_whose_box_tips_has_no_solution() {
    let report = report_on(CART);
    // The only state that solves the equations tips the box: 2.76 N m of 2.35 N m.
    assert_eq!((report.status, report.complete), (Status::None, Proof::Proven));
    assert!(report.undecided_modes.is_empty());
    assert_eq!(report.rejected.len(), 1);
}

/// A guided slider on an incline that is itself a cart with packings at both ends, at mu = 1.5.
const CART: &str = r#"
    gravity = "9.81 m/s^2"
    [parameters]
    th = "28 deg"
    [points]
    A = [0.3, 0.25]
    C = [0.25, 0.1]
    G = [0.2, 0]
    [bodies.cart]
    points = ["C", "G"]
    mass = "7 kg"
    centre_of_mass = "C"
    moment_of_inertia = 0.3
    [bodies.box]
    points = ["A"]
    mass = "3 kg"
    centre_of_mass = ["0.3 - 0.04*sin(th)", "0.25 + 0.04*cos(th)"]
    shape = { rectangle = ["0.15 m", "80 mm"] }
    [joints.floor]
    type = "block_slider"
    block = "cart"
    at = "G"
    along = 0
    length = "0.5 m"
    height = "0.04 m"
    mu = 0.15
    preload = "4 N"
    [joints.ramp]
    type = "guided_slider"
    block = "box"
    guide = "cart"
    at = "A"
    along = "th"
    length = "0.15 m"
    height = "40 mm"
    mu = 1.5
    [loads.P]
    type = "force"
    at = "cart.C"
    components = ["30 N", 0]
    [loads.wind]
    type = "force"
    at = "box.A"
    components = ["-(2 N s^2/m^2)*rate(X)*abs(rate(X))", "(3 N s/m)*rate(s)"]
    reaction = "cart"
    [coordinates.X]
    slide = "floor"
    rate = "0.6 m/s"
    [coordinates.s]
    slide = "ramp"
    rate = "-0.5 m/s"
"#;

/// The same mechanism with a preload at every contact, of all kinds: one for both sides, or one for each.
fn preloaded(mut drawing: Drawing) -> Drawing {
    let sliders = drawing.joints.iter_mut().filter_map(|joint| match &mut joint.kind {
        Kind::Slider(slider) => Some(slider),
        Kind::Hinge { .. } => None,
    });
    for (index, contact) in sliders.flat_map(|slider| &mut slider.contacts).enumerate() {
        if contact.preload == [0.0; 2] {
            contact.preload = [[80.0, 80.0], [60.0, 100.0], [40.0, 0.0]][index % 3];
        }
    }
    drawing
}

/// Preloaded mechanisms of at most so many contacts.
fn small(contacts: usize) -> impl Strategy<Value = Drawing> {
    mechanisms().prop_map(preloaded).prop_filter("large", move |drawing| drawing.contacts().len() <= contacts)
}

/// The numbers of eq. (6), friction and preload in the columns, and where `d_k` differs by side.
struct Numbers {
    eta: [DMatrix<f64>; 2],
    preload: [DMatrix<f64>; 2],
    load: DVector<f64>,
    jumps: Vec<bool>,
}

/// The numbers of eq. (6) from the influence coefficients of the report.
fn numbers(drawing: &Drawing, report: &SolveReport) -> Numbers {
    let contacts = drawing.contacts();
    let speeds = velocity_signs(drawing);
    let r = contacts.len();
    let matrix = |rows: &[Vec<f64>]| DMatrix::from_fn(r, r, |j, k| rows[j][k]);
    let mut eta = [matrix(&report.influence.eta_positive), matrix(&report.influence.eta_negative)];
    let mut preload = [DMatrix::zeros(r, r), DMatrix::zeros(r, r)];
    for (k, (_, slider, contact)) in contacts.iter().enumerate() {
        if slider.kind == SliderKind::Guided {
            let positive = eta[0].column(k).into_owned();
            eta[1].set_column(k, &positive);
        }
        let centre = (eta[0].column(k) + eta[1].column(k)) / 2.0;
        for side in [0, 1] {
            let at = if contact.centred_preload { centre.clone() } else { eta[side].column(k).into_owned() };
            preload[side].set_column(k, &(at * (contact.preload[side] * speeds[k])));
            eta[side].column_mut(k).scale_mut(contact.mu[side] * speeds[k]);
        }
    }
    let jumps = (0..r).map(|k| (preload[0].column(k) - preload[1].column(k)).amax() > 1e-9);
    let jumps = jumps.collect();
    Numbers { eta, preload, load: DVector::from_row_slice(&report.influence.normal_forces), jumps }
}

/// All patterns of sides and gaps with a state, each by the singular values of its own matrix; nothing where
/// something is so close to a boundary that rounding decides.
fn by_brute_force(numbers: &Numbers) -> Option<BTreeSet<String>> {
    let r = numbers.jumps.len();
    let mut found = BTreeSet::new();
    for number in 0..(0..r).fold(1, |count, _| 3 * count) {
        let digits: Vec<usize> =
            (0..r).scan(number, |rest, _| Some(std::mem::replace(rest, *rest / 3) % 3)).collect();
        if (0..r).any(|k| digits[k] == 2 && !numbers.jumps[k]) {
            continue;
        }
        let mut matrix = DMatrix::zeros(r, r);
        let mut right = numbers.load.clone();
        for (k, &state) in digits.iter().enumerate() {
            let [positive, negative] = [0, 1].map(|side| numbers.preload[side].column(k));
            if state == 2 {
                matrix.set_column(k, &(negative - positive));
                right += negative;
            } else {
                matrix.set_column(k, &-numbers.eta[state].column(k));
                matrix[(k, k)] += if state == 0 { 1.0 } else { -1.0 };
                right += if state == 0 { positive } else { negative };
            }
        }
        let pattern: String = digits.iter().map(|&state| ['+', '-', '0'][state]).collect();
        match admits(matrix, &right, &digits) {
            Some(true) => {
                found.insert(pattern);
            }
            Some(false) => {}
            None => return None,
        }
    }
    Some(found)
}

/// Whether the equations of a pattern have a solution within its bounds; nothing where rounding decides.
fn admits(mut matrix: DMatrix<f64>, right: &DVector<f64>, digits: &[usize]) -> Option<bool> {
    let sizes: Vec<f64> = matrix.column_iter().map(|column| column.amax().max(1e-300)).collect();
    for (mut column, size) in matrix.column_iter_mut().zip(&sizes) {
        column /= *size;
    }
    let svd = matrix.clone().svd(true, true);
    let greatest = svd.singular_values.max();
    let small = svd.singular_values.iter().filter(|value| **value < 1e-5 * greatest).count();
    if small > 0 && svd.singular_values.min() > 1e-11 * greatest {
        return None;
    }
    let unknowns = svd.solve(right, 1e-8 * greatest).ok()?;
    if small > 0 {
        // Columns that depend on each other exactly: either nothing solves the equations, or a continuum
        // does.
        let left = (&matrix * &unknowns - right).amax();
        return (left > NEAR * right.amax()).then_some(false);
    }
    let values: Vec<f64> = unknowns.iter().zip(&sizes).map(|(value, size)| value / size).collect();
    let pressures = values.iter().zip(digits).filter(|(_, state)| **state != 2).map(|(value, _)| value.abs());
    let scale = pressures.fold(right.amax(), f64::max);
    // How far each is within its bounds, in terms of its scale.
    let slack = values
        .iter()
        .zip(digits)
        .map(|(value, state)| if *state == 2 { value.min(1.0 - value) } else { value / scale });
    let least = slack.fold(f64::INFINITY, f64::min);
    (least.abs() > NEAR).then_some(least > 0.0)
}

/// All patterns with a state in the report, tipping or not.
fn reported(report: &SolveReport) -> BTreeSet<String> {
    let states = report.solutions.iter().chain(&report.preload_gap_states);
    let rejected = report.rejected.iter().map(|rejection| rejection.pattern.clone());
    states.flat_map(|state| state.patterns.clone()).chain(rejected).collect()
}

#[test]
fn random_mechanisms_with_preload_have_the_states_of_brute_force_and_no_false_unknown() {
    let seen = [const { Cell::new(0) }; 4];
    let run = TestRunner::new(cases(120)).run(&small(4), |drawing| {
        let report = match try_report_on(&drawing.text()) {
            Ok(report) => report,
            Err(faults) => {
                prop_assert!(faults.sorted().iter().all(|fault| unreachable(&fault.kind)), "{}", faults);
                return Err(TestCaseError::reject("state"));
            }
        };
        let found = report.solutions.len() + report.preload_gap_states.len() + report.continua.len();
        prop_assert!(report.status != Status::Unknown || found == 0);
        let numbers = numbers(&drawing, &report);
        let Some(expected) = by_brute_force(&numbers) else { return Err(TestCaseError::reject("delicate")) };
        prop_assert_ne!(report.status, Status::Unknown, "{}", drawing.text());
        prop_assert!(report.undecided_modes.is_empty(), "{:?}\n{}", report.undecided_modes, drawing.text());
        prop_assert_eq!(reported(&report), expected, "{}", drawing.text());
        let counts = [
            1,
            usize::from(!report.preload_gap_states.is_empty()),
            usize::from(report.status == Status::PreloadGap),
            usize::from(numbers.jumps.windows(2).any(|pair| pair == [true; 2])),
        ];
        seen.iter().zip(counts).for_each(|(seen, count)| seen.set(seen.get() + count));
        Ok(())
    });
    run.unwrap_or_else(|error| panic!("{error}"));
    let [all, gaps, gaps_alone, several_jumps] = seen.each_ref().map(Cell::get);
    assert!(gaps > 0 && gaps_alone > 0 && several_jumps > 30, "{all} {gaps} {gaps_alone} {several_jumps}");
}

fn in_words(phase: &Phase) -> String {
    let one = |contact: &ContactPhase| match contact {
        ContactPhase::Pressed(Side::Positive) => '+',
        ContactPhase::Pressed(Side::Negative) => '-',
        ContactPhase::PreloadGap => '0',
    };
    phase.contacts.iter().map(one).collect()
}

/// What follows at the state of a model while everything slides, unless rounding decides about something.
fn sliding(model: &Model) -> Option<Vec<Successor>> {
    let mechanism = Mechanism::new(model).ok()?;
    let configuration = Configuration::new(&mechanism).ok()?;
    let joints = (0..mechanism.joints.len()).map(slideway::ids::JointId);
    let sliders = joints.filter(|joint| mechanism.slider(*joint).is_some()).count();
    let found = successors(&mechanism, &configuration, &vec![false; sliders], None).ok()?;
    assert!(found.unsolved.is_empty());
    let clear = |one: &Successor| one.standing == Standing::Inside;
    found.list.iter().all(clear).then_some(found.list)
}

#[test]
fn motions_start_in_the_states_of_solve() {
    let seen = [const { Cell::new(0) }; 2];
    let run = TestRunner::new(cases(60)).run(&small(3), |drawing| {
        let Ok(model) = Model::parse(&drawing.text()) else { return Err(TestCaseError::reject("model")) };
        let Ok(report) = solve(&model) else { return Err(TestCaseError::reject("state")) };
        let delicate = by_brute_force(&numbers(&drawing, &report)).is_none();
        let (false, Some(found)) = (delicate, sliding(&model)) else {
            return Err(TestCaseError::reject("delicate"));
        };
        let found: BTreeSet<String> = found.iter().map(|one| in_words(&one.phase)).collect();
        let states = report.solutions.iter().chain(&report.preload_gap_states);
        let expected: BTreeSet<String> = states.flat_map(|state| state.patterns.clone()).collect();
        prop_assert_eq!(found, expected, "{}", drawing.text());
        seen[0].set(seen[0].get() + 1);
        seen[1].set(seen[1].get() + usize::from(!report.preload_gap_states.is_empty()));
        Ok(())
    });
    run.unwrap_or_else(|error| panic!("{error}"));
    let [all, gaps] = seen.each_ref().map(Cell::get);
    assert!(gaps > 0, "{all} {gaps}");
}

#[test]
fn what_begins_to_slide_at_rest_is_what_slides_very_slowly() {
    let seen = [const { Cell::new(0) }; 3];
    let run = TestRunner::new(cases(40)).run(&small(3), |mut drawing| {
        drawing.drives.clear();
        let Ok(report) = try_report_on(&drawing.text()) else { return Err(TestCaseError::reject("state")) };
        // Each way in which the loads pull without friction.
        let pulls = &report.influence.coordinate_accelerations;
        for (coordinate, pull) in drawing.coordinates.iter_mut().zip(pulls) {
            coordinate.rate = 1e-7 * coordinate.rate.abs().copysign(*pull);
        }
        let Ok(model) = Model::parse(&drawing.text()) else { return Err(TestCaseError::reject("model")) };
        let Ok(report) = solve(&model) else { return Err(TestCaseError::reject("state")) };
        let delicate = by_brute_force(&numbers(&drawing, &report)).is_none();
        let (false, Some(found)) = (delicate, sliding(&model)) else {
            return Err(TestCaseError::reject("delicate"));
        };
        let held = hold(&model, &HoldOptions::default())
            .map_err(|faults| TestCaseError::reject(faults.to_string()))?;
        prop_assume!(held.motions_without_inertia.is_empty() && held.undecided == 0);
        // Those that accelerate in the sense in which they slide.
        let mut expected = BTreeSet::new();
        for one in &found {
            let senses =
                one.phase.joints.iter().zip(&one.state.sliding_accelerations).map(|(joint, acceleration)| {
                    let JointPhase::Sliding(sign) = joint else { panic!("everything slides") };
                    sign * acceleration
                });
            let least = senses.fold(f64::INFINITY, f64::min);
            prop_assume!(least.abs() > 1e-4);
            if least > 0.0 {
                expected.insert(in_words(&one.phase));
            }
        }
        let signs: Vec<i8> = match found.first() {
            Some(one) => one
                .phase
                .joints
                .iter()
                .map(|joint| if *joint == JointPhase::Sliding(1.0) { 1 } else { -1 })
                .collect(),
            None => return Err(TestCaseError::reject("nothing slides")),
        };
        let released = held
            .releases
            .iter()
            .filter(|release| release.joints.iter().map(|joint| joint.slip).eq(signs.iter().copied()));
        let released: BTreeSet<String> = released.flat_map(|release| release.patterns.clone()).collect();
        prop_assert_eq!(&released, &expected, "{}", drawing.text());
        let counts = [
            1,
            usize::from(!expected.is_empty()),
            usize::from(expected.iter().any(|pattern| pattern.contains('0'))),
        ];
        seen.iter().zip(counts).for_each(|(seen, count)| seen.set(seen.get() + count));
        Ok(())
    });
    run.unwrap_or_else(|error| panic!("{error}"));
    let [all, moving, gaps] = seen.each_ref().map(Cell::get);
    assert!(moving > 3 && gaps > 0, "{all} {moving} {gaps}");
}
