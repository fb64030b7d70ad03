//! Limits known from machine design, each in closed form.

use crate::answers::{
    acceleration, assert_close, contact, model, normal_forces, only, parameters, report, report_on,
};
use rstest::rstest;
use serde::Deserialize;
use slideway::report::{SolveReport, Status};

const REFERENCE: &str = include_str!("../../../../reference/textbook.toml");

#[derive(Deserialize)]
struct Reference {
    drawer: Drawers,
    cam_follower: CamFollowers,
    bracket_on_pole: Brackets,
}

#[derive(Deserialize)]
struct Drawers {
    cases: Vec<Drawer>,
}

#[derive(Deserialize)]
struct Drawer {
    #[serde(rename = "L")]
    length: f64,
    a: f64,
    h: f64,
    mu_lock: f64,
}

#[derive(Deserialize)]
struct CamFollowers {
    cases: Vec<CamFollower>,
}

#[derive(Deserialize)]
struct CamFollower {
    phi_deg: f64,
    #[serde(rename = "B")]
    bushing: f64,
    #[serde(rename = "A")]
    overhang: f64,
    d: f64,
    mu_lock: f64,
}

#[derive(Deserialize)]
struct Brackets {
    cases: Vec<Bracket>,
}

#[derive(Deserialize)]
struct Bracket {
    #[serde(rename = "B")]
    bearing: f64,
    mu_static: f64,
    x_min: f64,
}

fn reference() -> Reference {
    toml::from_str(REFERENCE).unwrap()
}

#[track_caller]
fn assert_one(report: &SolveReport) {
    assert_eq!((report.status, report.solutions.len()), (Status::One, 1));
}

#[track_caller]
fn assert_none(report: &SolveReport) {
    assert_eq!((report.status, report.solutions.len()), (Status::None, 0));
    assert!(report.preload_gap_states.is_empty() && report.continua.is_empty());
}

#[test]
fn drawer() {
    for Drawer { length, a, h, mu_lock } in reference().drawer.cases {
        let solved = |mu: f64| {
            let [length, a, h, mu] = [length, a, h, mu].map(|value| value.to_string());
            report("drawer", &[("L", &length), ("a", &a), ("h", &h), ("mu", &mu)])
        };
        assert_close(mu_lock, length / (2.0 * a), 0.0, 1e-9);
        assert_one(&solved(mu_lock - 1e-8));
        assert_none(&solved(mu_lock + 1e-8));
        // Well below the limit: V = Q / (1 - 2 mu a / L), N = a V / L (reference/README.md).
        for mu in [0.0, 0.2, 0.45, 0.6] {
            let report = solved(mu);
            let solution = only(&report);
            let push = 20.0 / (1.0 - 2.0 * mu * a / length);
            assert_close(solution.drives[0].effort, push, 0.0, 1e-12);
            assert_close(contact(solution, "guide.front").normal_force, a * push / length, 0.0, 1e-12);
            assert_close(contact(solution, "guide.rear").normal_force, -a * push / length, 0.0, 1e-12);
        }
        // Far beyond it there is still none.
        assert_none(&solved(2.0));
    }
}

#[test]
fn drawer_without_resistance_needs_no_push() {
    for mu in ["0.3", "0.9"] {
        let report = report("drawer", &[("Q", "0 N"), ("mu", mu)]);
        assert!(report.solutions.iter().any(|solution| solution.drives[0].effort == 0.0));
        assert!(report.solutions.iter().all(|solution| normal_forces(solution) == [0.0; 2]));
    }
}

/// The smaller root of tan(phi) = B / (mu (2 A + B - mu d)).
fn cam_limit(case: &CamFollower) -> f64 {
    let CamFollower { phi_deg, bushing, overhang, d, .. } = *case;
    let (p, q) = (2.0 * overhang + bushing, bushing / phi_deg.to_radians().tan());
    2.0 * q / (p + (p * p - 4.0 * d * q).sqrt())
}

#[test]
fn cam_follower() {
    for case in reference().cam_follower.cases {
        let solved = |mu: f64| {
            let CamFollower { phi_deg, bushing, overhang, d, .. } = case;
            let phi = format!("{phi_deg} deg");
            let [bushing, overhang, d, mu] = [bushing, overhang, d, mu].map(|value| value.to_string());
            report(
                "cam-follower",
                &[("phi", &phi), ("B", &bushing), ("A", &overhang), ("d", &d), ("mu", &mu)],
            )
        };
        let limit = cam_limit(&case);
        // The table gives five decimals or ten.
        assert!((limit - case.mu_lock).abs() < if case.d > 0.0 { 0.5e-5 } else { 1e-9 });
        assert_one(&solved(limit - 1e-8));
        assert_none(&solved(limit + 1e-8));
        for share in [0.0, 0.5, 0.9] {
            // V = Q / [cos(phi) - (mu/B) sin(phi) (2 A + B - mu d)] (reference/README.md).
            let mu = share * limit;
            let report = solved(mu);
            let solution = only(&report);
            let (sin, cos) = case.phi_deg.to_radians().sin_cos();
            let arm = 2.0 * case.overhang + case.bushing - mu * case.d;
            let force = 200.0 / (cos - mu / case.bushing * sin * arm);
            assert_close(solution.drives[0].effort, force, 0.0, 1e-12);
        }
    }
}

#[test]
fn massive_bracket_slides_evenly_at_its_limit() {
    // As the bracket slides down, both edges bear N B = W x on opposite faces, so that the moments of their
    // frictions mu N cancel: m a = W - 2 mu W x / B downwards. It gains speed for x < B/(2 mu) and loses it
    // beyond, where it would hold once at rest (with mu_static in place of mu).
    for Bracket { bearing, mu_static, x_min } in reference().bracket_on_pole.cases {
        assert_close(x_min, bearing / (2.0 * mu_static), 0.0, 1e-12);
        let text = slideway::gallery::find("bracket-on-pole").unwrap().text;
        let text = text.replace(
            "massless = true",
            "mass = \"4 kg\"\nmoment_of_inertia = 0.1\ncentre_of_mass = \"centre\"",
        );
        let massive = slideway::model::Model::parse(&text).unwrap();
        let falling = |x: f64| {
            let [x, bearing, mu] = [x, bearing, mu_static].map(|value| value.to_string());
            let settings = parameters(&[("x", &x), ("B", &bearing), ("mu", &mu), ("mu_static", &mu)]);
            let report = crate::answers::report_with(&massive, &settings);
            -acceleration(only(&report), "bracket")[1]
        };
        for share in [0.2, 0.7, 1.0, 1.4] {
            let expected = 100.0 * (1.0 - share) / 4.0;
            assert_close(falling(share * x_min), expected, 25.0, 1e-12);
        }
        assert!(falling(x_min * (1.0 - 1e-9)) > 0.0 && falling(x_min * (1.0 + 1e-9)) < 0.0);
    }
}

#[test]
fn bracket_driven_down_needs_a_push_beyond_its_limit() {
    // V = W (2 mu x / B - 1) downwards along the axis, for the same reason.
    let text = slideway::gallery::find("bracket-on-pole").unwrap().text;
    let drive =
        "\n[drives.push]\ncoordinate = \"z\"\nforce = { at = \"bracket.centre\", direction = \"-90 deg\" }\n";
    let driven = slideway::model::Model::parse(&format!("{text}{drive}")).unwrap();
    for (mu, x) in [(0.2, 0.1), (0.2, 0.381), (0.25, 0.3048), (0.5, 0.6)] {
        let settings =
            parameters(&[("mu", &f64::to_string(&mu)), ("x", &f64::to_string(&x)), ("mu_static", "1")]);
        let report = crate::answers::report_with(&driven, &settings);
        assert_close(only(&report).drives[0].effort, 100.0 * (2.0 * mu * x / 0.1524 - 1.0), 100.0, 1e-12);
    }
}

/// The example with friction on its first contact only: a single friction-affected slider.
fn single(mu: f64, preload: f64, direction: f64) -> SolveReport {
    let [mu, preload, direction] = [mu, preload, direction].map(|value| value.to_string());
    let list = [("mu_1", mu.as_str()), ("mu_2", "0"), ("mu_3", "0"), ("F_20", "0"), ("F_10", &preload)];
    let settings = parameters(&list).parameter("direction", &direction);
    crate::answers::report_with(&model("klepp-2002"), &settings)
}

#[rstest]
fn single_slider_of_equation_9(#[values(1.0, -1.0)] direction: f64, #[values(0.0, 2.0)] preload: f64) {
    // |N| = (N(0) + eta F_0 s) / (sign(N) - mu eta s), of which the positive ones are the solutions.
    let (frictionless, eta) = (9.81 / 2.0, -f64::to_radians(80.0).tan() / 2.0);
    let limit = 1.0 / eta.abs();
    for share in [0.0, 0.3, 0.9, 1.0 - 1e-9, 1.0 + 1e-9, 1.5, 3.0] {
        let mu = share * limit;
        let load = frictionless + eta * preload * direction;
        let of_sign = |sign: f64| load / (sign - mu * eta * direction);
        let expected: Vec<f64> = [1.0, -1.0]
            .into_iter()
            .filter(|sign| of_sign(*sign) >= 0.0)
            .map(|sign| sign * of_sign(sign))
            .collect();
        let report = single(mu, preload, direction);
        let found: Vec<f64> = report.solutions.iter().map(|s| contact(s, "upper").normal_force).collect();
        assert_eq!(found.len(), expected.len(), "mu = {mu}");
        for (found, expected) in found.iter().zip(expected) {
            assert_close(*found, expected, 0.0, if (share - 1.0).abs() < 1e-3 { 1e-5 } else { 1e-12 });
        }
    }
}

#[test]
fn single_slider_locks_at_one_over_eta() {
    // mu_l = 1/|eta_jj|, with eta read off the report: forwards the second solution appears, backwards the
    // only one vanishes.
    let limit = 1.0 / single(0.0, 0.0, 1.0).influence.eta_positive[0][0].abs();
    assert_close(limit, 2.0 / f64::to_radians(80.0).tan(), 0.0, 1e-12);
    assert_eq!(single(limit - 1e-9, 0.0, 1.0).solutions.len(), 1);
    assert_eq!(single(limit + 1e-9, 0.0, 1.0).solutions.len(), 2);
    assert_eq!(single(limit - 1e-9, 0.0, -1.0).solutions.len(), 1);
    assert_none(&single(limit + 1e-9, 0.0, -1.0));
    // At the limit itself nothing is left for the mode that locks.
    assert!(single(limit, 0.0, -1.0).solutions.is_empty());
}

/// A sledge of mass m on an incline, its centre of mass at the height c above the middle of its base.
fn sledge(slope: f64, mu: f64, c: f64, rate: f64) -> SolveReport {
    report_on(&format!(
        r#"
        gravity = 9.81
        [parameters]
        beta = "{slope} deg"
        c = "{c} m"
        [points]
        M = [0, 0]
        S = ["-c*sin(beta)", "c*cos(beta)"]
        [bodies.sledge]
        points = ["M", "S"]
        mass = 3
        centre_of_mass = "S"
        moment_of_inertia = 0.2
        [joints.base]
        type = "block_slider"
        block = "sledge"
        at = "M"
        along = "beta"
        length = 0.5
        mu = {mu}
        [coordinates.s]
        slide = "base"
        rate = {rate}
        "#
    ))
}

#[rstest]
#[case(0.0, 0.3, 0.0)]
#[case(20.0, 0.3, 0.1)]
#[case(35.0, 0.15, 0.2)]
#[case(-25.0, 0.5, 0.3)]
fn sledge_on_an_incline(#[case] slope: f64, #[case] mu: f64, #[case] c: f64, #[values(1.0, -1.0)] rate: f64) {
    // u points along beta, h = 0. Along: m a = -m g sin(beta) - mu N s with N = N_f + N_r = m g cos(beta),
    // both positive. About the centre of mass: (N_f - N_r) L/2 = c mu N s, so the sledge lies flat for c mu <
    // L/2.
    let (sin, cos) = f64::to_radians(slope).sin_cos();
    assert!(c * mu < 0.25);
    let report = sledge(slope, mu, c, rate);
    let solution = only(&report);
    let normal = 3.0 * 9.81 * cos;
    let along = acceleration(solution, "sledge");
    assert_close(along[0] * cos + along[1] * sin, -9.81 * (sin + mu * cos * rate), 9.81, 1e-12);
    // F = mu N s acts along -u at the distance c below the centre of mass: it presses the leading edge.
    let shift = mu * normal * rate * c / 0.5;
    assert_close(contact(solution, "base.front").normal_force, normal / 2.0 + shift, normal, 1e-12);
    assert_close(contact(solution, "base.rear").normal_force, normal / 2.0 - shift, normal, 1e-12);
    // It slides down evenly at the angle of friction.
    if rate * slope < 0.0 {
        let even = sledge(slope, f64::to_radians(slope).tan().abs(), 0.0, rate);
        assert_close(acceleration(only(&even), "sledge")[0], 0.0, 9.81, 1e-12);
    }
}

#[test]
fn a_sledge_too_high_for_its_friction_jams() {
    // Beyond c mu = L/2 its trailing edge would lift off. Held down by the upper face of its guide it would
    // bear N_f = m g cos(beta) + b, N_r = -b: then (N_f + b) L/2 = c mu (N_f + b), which only c mu = L/2
    // fulfils. So there is no solution at all, lying or tipped: it jams, whichever way it moves and however
    // steep it is.
    for slope in [-30.0, 0.0, 10.0] {
        for rate in [1.0, -1.0] {
            let lying = sledge(slope, 0.5, 0.5 - 1e-9, rate);
            assert_eq!(only(&lying).signs, [1, 1]);
            assert_none(&sledge(slope, 0.5, 0.5 + 1e-9, rate));
        }
    }
}

/// A follower on a wedge of slope theta, the wedge pushed by a drive at constant velocity.
fn wedge(theta: f64, mu_face: f64, mu_floor: f64, mu_wall: f64) -> SolveReport {
    report_on(&format!(
        r#"
        [points]
        A = [0, 0]
        [bodies.wedge]
        points = ["A"]
        mass = 1
        moment_of_inertia = 1
        centre_of_mass = "A"
        [bodies.follower]
        points = ["A"]
        mass = 1
        moment_of_inertia = 1
        centre_of_mass = "A"
        [joints.floor]
        type = "guided_slider"
        block = "wedge"
        at = "A"
        along = "0 deg"
        length = 0.2
        mu = {mu_floor}
        [joints.wall]
        type = "guided_slider"
        block = "follower"
        at = "A"
        along = "90 deg"
        length = 0.2
        mu = {mu_wall}
        [joints.face]
        type = "pin_in_slot"
        block = "follower"
        guide = "wedge"
        at = "A"
        along = "-({theta} deg)"
        mu = {mu_face}
        [loads.W]
        type = "force"
        at = "follower.A"
        components = [0, -100]
        [coordinates.x]
        slide = "floor"
        rate = 1
        [drives.push]
        coordinate = "x"
        force = {{ at = "wedge.A", direction = "0 deg" }}
        "#
    ))
}

#[rstest]
#[case(15.0, 0.2, 0.0, 0.0)]
#[case(30.0, 0.4, 0.3, 0.0)]
#[case(25.0, 0.3, 0.25, 0.35)]
#[case(40.0, 0.1, 0.6, 0.5)]
fn wedge_lifts_its_follower(#[case] theta: f64, #[case] face: f64, #[case] floor: f64, #[case] wall: f64) {
    // The wedge moves to +x, its face falls to the right with the slope theta, so the follower rises. The
    // face presses the follower with R at the angle theta + phi from the vertical, phi = atan(mu_face):
    //     wall: H = R sin(theta + phi), friction mu_wall H downwards
    //     R cos(theta + phi) - mu_wall H = W
    //     floor: N = R cos(theta + phi), P = H + mu_floor N
    let angle = theta.to_radians() + face.atan();
    let thrust = 100.0 / (angle.cos() - wall * angle.sin());
    let push = thrust * (angle.sin() + floor * angle.cos());
    let report = wedge(theta, face, floor, wall);
    assert_close(only(&report).drives[0].effort, push, 0.0, 1e-12);
}

#[rstest]
#[case(60.0, 0.0)]
#[case(40.0, 0.0)]
#[case(40.0, 0.3)]
#[case(25.0, 0.8)]
fn wedge_locks_when_the_angles_add_to_a_right_angle(#[case] theta: f64, #[case] wall: f64) {
    // R > 0 needs cos(theta + phi) > mu_wall sin(theta + phi): theta + phi + phi_wall < 90 deg.
    let limit = (std::f64::consts::FRAC_PI_2 - theta.to_radians() - wall.atan()).tan();
    for floor in [0.0, 0.3] {
        assert_one(&wedge(theta, limit - 1e-8, floor, wall));
        assert_none(&wedge(theta, limit + 1e-8, floor, wall));
    }
}

#[rstest]
#[case(30.0, 1.0, 1.0)]
#[case(30.0, 2.5, 0.5)]
#[case(65.0, 0.4, 3.0)]
fn painleve_klein_limit(#[case] phi: f64, #[case] upper: f64, #[case] lower: f64) {
    // mu* = (1 + m_1/m_2) cot(phi); K = m_2 P_1 - m_1 P_2 (reference/README.md).
    let limit = (1.0 + upper / lower) / f64::to_radians(phi).tan();
    let solved = |mu: f64, pull: &str, direction: &str| {
        let [phi, upper, lower] = [format!("{phi} deg"), upper.to_string(), lower.to_string()];
        let mut list =
            vec![("phi", phi.as_str()), ("m_1", &upper), ("m_2", &lower), ("direction", direction)];
        let mu = mu.to_string();
        list.extend([("mu", mu.as_str()), ("P_1", "0 N"), ("P_2", "0 N"), (pull, "10 N")]);
        report("painleve-klein", &list).solutions.len()
    };
    for (pull, towards) in [("P_1", ["1", "-1"]), ("P_2", ["-1", "1"])] {
        for direction in towards {
            assert_eq!(solved(limit - 1e-8, pull, direction), 1);
        }
        assert_eq!(solved(limit + 1e-8, pull, towards[0]), 2);
        assert_eq!(solved(limit + 1e-8, pull, towards[1]), 0);
    }
}
