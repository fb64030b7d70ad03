//! States without a pattern: a contact between its faces, where only the preload acts (theory, section 3).

use crate::answers::{acceleration, assert_close, model, only, parameters, report, report_on, report_with};
use slideway::model::Model;
use slideway::report::{Proof, SolveReport, Status};

const CASE: [(&str, &str); 4] = [("mu_1", "0.24"), ("F_20", "0"), ("F_30", "0.5*m*g"), ("direction", "1")];

#[test]
fn the_example_has_a_preload_gap() {
    let report = report("klepp-2002", &CASE);
    assert_eq!(report.status, Status::PreloadGap);
    assert!(report.complete == Proof::Proven && report.solutions.is_empty());
    assert_eq!(report.patterns.unwrap().no_solution, 8);
    let [state] = &report.preload_gap_states[..] else { panic!("exactly one state") };
    assert_eq!(state.signs[2], 0);
    assert!(state.residual < 1e-12);
    let [one, two, three] = &state.contacts[..] else { panic!("three contacts") };
    let share = three.preload_share.expect("a share of the preload");
    assert!(0.0 < share && share < 1.0);
    assert_eq!((one.preload_share, two.preload_share), (None, None));

    // Friction: eq. (2), with N_3 = 0 and the whole preload at contact 3.
    let weight = 9.81;
    assert_eq!(three.normal_force, 0.0);
    assert_close(one.friction_force, 0.24 * one.normal_force.abs(), 0.0, 1e-12);
    assert_close(two.friction_force, 0.1 * two.normal_force.abs(), 0.0, 1e-12);
    assert_close(three.friction_force, 0.5 * weight, 0.0, 1e-12);
    // The paper's equilibrium conditions (section 7), all normal forces upwards: forces across, moments about
    // A of the bar, moments about the middle of the lower block, where contact 3 acts at the height (2
    // lambda - 1) h/2 below the middle.
    let total = one.friction_force + two.friction_force + three.friction_force;
    let (sin, cos) = f64::to_radians(80.0).sin_cos();
    assert_close(one.normal_force + two.normal_force, weight, 0.0, 1e-12);
    assert_close(
        (one.friction_force - total / 2.0) * sin,
        -(one.normal_force - weight / 2.0) * cos,
        weight,
        1e-12,
    );
    let sign = two.normal_force.signum();
    let friction = two.friction_force * sign + three.friction_force * (2.0 * share - 1.0);
    assert_close(two.normal_force * 0.2, friction * 0.1, weight, 1e-12);
}

#[test]
fn in_closed_form() {
    // With N_3 = 0, F_3 = F_30 and N_1, N_2 > 0: N_2 = 1 - N_1 (in m g) and, about A,
    //     (mu_1 N_1 - mu_2 (1 - N_1) - F_30) tan(alpha)/2 + N_1 - 1/2 = 0.
    let half = f64::to_radians(80.0).tan() / 2.0;
    let upper = (0.5 + (0.1 + 0.5) * half) / (1.0 + (0.24 + 0.1) * half);
    let lower = 1.0 - upper;
    // About the middle of the lower block: N_2 b = (mu_2 |N_2| sign(N_2) + (2 lambda - 1) F_30) h.
    let share = 0.5 + (lower * 0.2 - 0.1 * lower * 0.1) / (2.0 * 0.5 * 0.1);
    let report = report("klepp-2002", &CASE);
    let state = &report.preload_gap_states[0];
    // The closed form is for N_2 > 0 only; for N_2 < 0 its friction changes sign.
    let (upper, share) = if lower > 0.0 {
        (upper, share)
    } else {
        let upper = (0.5 + (-0.1 + 0.5) * half) / (1.0 + (0.24 - 0.1) * half);
        let lower = 1.0 - upper;
        (upper, 0.5 + (lower * 0.2 - 0.1 * lower * 0.1) / (2.0 * 0.5 * 0.1))
    };
    assert_close(state.contacts[0].normal_force, upper * 9.81, 0.0, 1e-12);
    assert_close(state.contacts[2].preload_share.unwrap(), share, 1.0, 1e-12);
}

#[test]
fn a_preload_on_both_faces_leaves_no_gap() {
    let text = slideway::gallery::find("klepp-2002").unwrap().text;
    let centred = text.replace("height = \"h\"\n", "height = \"h\"\npreload_line = \"centre\"\n");
    assert_ne!(text, centred);
    let centred = Model::parse(&centred).unwrap();
    let report = report_with(&centred, &parameters(&CASE));
    let solution = only(&report);
    assert!(report.preload_gap_states.is_empty());
    assert_eq!(report.patterns.unwrap().gap_patterns, 0);
    // About the middle of the lower block only the friction mu |N| at the faces turns; the preload does not:
    // (N_2 - N_3) b/2 = (mu_2 |N_2| sign(N_2) + mu_3 |N_3| sign(N_3)) h/2.
    let [_, two, three] = &solution.contacts[..] else { panic!("three contacts") };
    let across = (two.normal_force - three.normal_force) * 0.2;
    assert_close(across, 0.1 * (two.normal_force + three.normal_force) * 0.1, 9.81, 1e-12);
    assert_close(three.friction_force, 0.1 * three.normal_force.abs() + 0.5 * 9.81, 0.0, 1e-12);
    // With the friction of the same preload at the pressed face there is none.
    assert!(report_with(&model("klepp-2002"), &parameters(&CASE)).solutions.is_empty());
}

#[test]
fn a_gap_beside_solutions_does_not_change_the_status() {
    let report = report("klepp-2002", &[]);
    assert_eq!(report.status, Status::Several);
    assert_eq!(report.preload_gap_states.len(), 1);
    assert_eq!(report.preload_gap_states[0].signs, [1, 0, -1]);
    assert!(report.preload_gap_states[0].residual < 1e-12);
}

/// A sledge without weight, preloaded at both ends, with a torque.
fn preloaded_sledge(moment: f64, front: f64, rear: f64) -> SolveReport {
    report_on(&format!(
        r#"
        [bodies.sledge]
        mass = 2
        centre_of_mass = [0, 0]
        moment_of_inertia = 0.05
        [joints.base]
        type = "block_slider"
        block = "sledge"
        at = [0, 0]
        along = "0 deg"
        length = 0.5
        height = 0.2
        mu = 0.1
        front = {{ preload = {front} }}
        rear = {{ preload = {rear} }}
        [loads.T]
        type = "torque"
        body = "sledge"
        moment = {moment}
        [coordinates.s]
        slide = "base"
        rate = 1
        "#
    ))
}

#[test]
fn both_ends_between_their_faces() {
    // N = 0 at both ends while the preloads balance the torque across the height: m a = -(F_f0 + F_r0), and
    // (2 lambda_f - 1) F_f0 h/2 + (2 lambda_r - 1) F_r0 h/2 = T. One share remains free; the ends of its
    // range are what is listed.
    for (moment, front, rear) in [(0.3, 10.0, 10.0), (0.3, 10.0, 4.0), (0.0, 10.0, 4.0), (1.5, 10.0, 10.0)] {
        let report = preloaded_sledge(moment, front, rear);
        assert!(!report.preload_gap_states.is_empty());
        for state in &report.preload_gap_states {
            assert_eq!(state.signs, [0, 0]);
            assert_close(acceleration(state, "sledge")[0], -(front + rear) / 2.0, 0.0, 1e-12);
            let face = |end: usize| match state.contacts[end].preload_share {
                Some(share) => 2.0 * share - 1.0,
                None if state.pattern.as_bytes()[end] == b'+' => 1.0,
                None => -1.0,
            };
            assert_close((face(0) * front + face(1) * rear) * 0.1, moment, 1.0, 1e-12);
        }
    }
    // A torque beyond (F_f0 + F_r0) h/2 cannot be balanced in this way.
    assert!(preloaded_sledge(2.5, 10.0, 10.0).preload_gap_states.is_empty());
}

#[test]
fn friction_without_influence_makes_no_gap() {
    // The friction of a pin in a straight slot has no influence on its own normal force, so that preloads
    // that differ from side to side make no jump, whatever rounding says at odd angles.
    for along in [-0.158_145, 0.3, 1.234_567, 2.881_733] {
        let report = report_on(&format!(
            r#"
            [bodies.plate]
            mass = 1.75
            moment_of_inertia = 0.26
            centre_of_mass = [-0.15466, 0]
            points = ["S"]
            [points]
            S = [0.2, 0.1]
            [joints.slot]
            type = "pin_in_slot"
            block = "ground"
            guide = "plate"
            at = [0, 0]
            along = {along}
            mu = 0.3
            preload = {{ plus = 0, minus = 8.8365 }}
            [coordinates]
            s = {{ slide = "slot", rate = 0.3 }}
            phi = {{ rotation = "plate", rate = 0.3, value = -0.27823 }}
            [loads.P]
            type = "force"
            at = "plate.S"
            components = [3, -7]
            [drives.turn]
            coordinate = "phi"
            torque = {{ body = "plate" }}
            "#
        ));
        only(&report);
        assert_eq!(report.patterns.unwrap().gap_patterns, 0, "along {along}");
    }
}

#[test]
fn a_preload_at_the_centre_line_is_a_pair_of_forces_there() {
    // Friction F_0 of both ends on the centre line of a sleeve, whatever its sides: the same as a force 2 F_0
    // against its motion, with its reaction on the arm.
    let text = slideway::gallery::find("sleeve-on-arm").unwrap().text;
    let preloaded =
        text.replace("fit = \"around\"\n", "fit = \"around\"\npreload = 7\npreload_line = \"centre\"\n");
    assert_ne!(text, preloaded);
    let pair = "\n[loads.pair]\ntype = \"force\"\nat = \"sleeve.C\"\nmagnitude = -14\ndirection = [\"O\", \"tip\"]\nframe = \"body\"\nreaction = \"arm\"\n";
    let wide = parameters(&[("d", "90 mm"), ("mu", "0.3")]);
    let [one, other] =
        [preloaded, format!("{text}{pair}")].map(|text| report_with(&Model::parse(&text).unwrap(), &wide));
    let (one, other) = (only(&one), only(&other));
    for (one, other) in one.contacts.iter().zip(&other.contacts) {
        assert_close(one.normal_force, other.normal_force, 1.0, 1e-12);
        assert_close(one.friction_force, other.friction_force + 7.0, 1.0, 1e-12);
    }
    for (one, other) in one.bodies.iter().zip(&other.bodies) {
        assert_close(one.angular_acceleration, other.angular_acceleration, 1.0, 1e-12);
        assert_close(one.acceleration[0], other.acceleration[0], 1.0, 1e-12);
        assert_close(one.acceleration[1], other.acceleration[1], 1.0, 1e-12);
    }
    assert_close(one.hinges[0].force[0], other.hinges[0].force[0], 1.0, 1e-12);
}
