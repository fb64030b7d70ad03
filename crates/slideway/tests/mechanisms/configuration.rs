//! Positions and velocities: closed loops over a full turn, branches of the drawing, travel limits, overlaps.

use crate::answers::{assert_close, model};
use nalgebra::Vector2;
use rstest::rstest;
use slideway::configuration::Configuration;
use slideway::fault::{FaultKind, Faults};
use slideway::ids::ContactId;
use slideway::mechanism::{JointKind, Mechanism};
use slideway::model::{Model, Settings};

fn configured(model: &Model, settings: &Settings) -> Result<(Mechanism, Configuration), Faults> {
    let mechanism = Mechanism::new(&model.with(settings).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism)?;
    Ok((mechanism, configuration))
}

fn of_text(text: &str, settings: &Settings) -> Result<(Mechanism, Configuration), Faults> {
    configured(&Model::parse(text).unwrap_or_else(|faults| panic!("{faults}")), settings)
}

fn body(mechanism: &Mechanism, name: &str) -> usize {
    mechanism.bodies.iter().position(|body| body.name.as_ref() == name).unwrap()
}

#[track_caller]
fn assert_vector(found: Vector2<f64>, expected: [f64; 2], scale: f64) {
    assert_close(found.x, expected[0], scale, 1e-12);
    assert_close(found.y, expected[1], scale, 1e-12);
}

#[test]
fn slider_crank_over_two_full_turns() {
    let (r, l, omega) = (0.05, 0.18, 7.0);
    let slider_crank = model("slider-crank");
    for step in -24..=48 {
        let phi = f64::from(step) * 15.0_f64.to_radians() + 0.01;
        let settings = Settings::default().position("phi", format!("{phi}")).rate("phi", format!("{omega}"));
        let (mechanism, configuration) = configured(&slider_crank, &settings).unwrap();
        let (sin, cos) = phi.sin_cos();
        let height = r * sin;
        let reach = (l * l - height * height).sqrt();
        let piston = body(&mechanism, "piston");
        assert_vector(configuration.poses[piston].position, [r * cos + reach, 0.0], 1.0);
        // x = r cos(phi) + sqrt(l^2 - r^2 sin^2(phi))
        let velocity = -omega * r * sin * (1.0 + r * cos / reach);
        assert_vector(configuration.velocities[piston].linear, [velocity, 0.0], omega);
        // The rod leans by -asin(r sin(phi) / l), counted from its inclination in the drawing.
        let rod = body(&mechanism, "rod");
        let drawn = (r * 60_f64.to_radians().sin() / l).asin();
        assert_close(configuration.poses[rod].angle(), drawn - (height / l).asin(), 1.0, 1e-12);
        assert_close(configuration.velocities[rod].angular, -omega * r * cos / reach, omega, 1e-12);
        // Angles are counted on, not reduced to one turn.
        let crank = body(&mechanism, "crank");
        assert_close(configuration.poses[crank].angle(), phi - 60_f64.to_radians(), 1.0, 1e-12);
        for k in 0..2 {
            let sliding = configuration.contact(&mechanism, ContactId(k)).sliding_velocity;
            assert_close(sliding, velocity, omega, 1e-12);
        }
    }
}

#[test]
fn velocities_are_the_derivatives_of_positions() {
    for (name, coordinate, at, rate) in [
        ("slider-crank", "phi", 2.1, 3.0),
        ("scotch-yoke", "phi", -1.3, 2.0),
        ("elliptic-trammel", "theta", 1.9, -1.0),
        ("drawer", "x", 0.07, 0.3),
        ("cam-follower", "lift", 0.02, -0.4),
    ] {
        let step = 1e-5;
        let at_time = |time: f64| {
            let value = at + rate * time;
            let settings = Settings::default()
                .position(coordinate, format!("{value}"))
                .rate(coordinate, format!("{rate}"));
            configured(&model(name), &settings).unwrap().1
        };
        let (before, now, after) = (at_time(-step), at_time(0.0), at_time(step));
        for (index, velocity) in now.velocities.iter().enumerate() {
            let change = (after.poses[index].position - before.poses[index].position) / (2.0 * step);
            assert!((change - velocity.linear).norm() < 1e-8, "{name}");
            let turning = (after.poses[index].angle() - before.poses[index].angle()) / (2.0 * step);
            assert_close(turning, velocity.angular, 1.0, 1e-8);
        }
    }
}

#[test]
fn slide_displacement_and_sliding_velocity_on_a_moving_guide() {
    let settings =
        Settings::default().position("phi", "1.1").position("s", "0.42").rate("phi", "3").rate("s", "-0.7");
    let (mechanism, configuration) = configured(&model("sleeve-on-arm"), &settings).unwrap();
    let (sin, cos) = 1.1_f64.sin_cos();
    // The middle of the sleeve is at s along the arm, and moves with s' u + s phi' n.
    let JointKind::Slider(sleeve) = &mechanism.joints[1].kind else { panic!("the sleeve") };
    let slide = configuration.slide(&mechanism, sleeve);
    assert_vector(slide.tangent, [cos, sin], 1.0);
    assert_vector(slide.normal, [-sin, cos], 1.0);
    assert_close(slide.displacement, 0.42 - 0.3, 1.0, 1e-12);
    for (k, end) in [(0, 0.04), (1, -0.04)] {
        let contact = configuration.contact(&mechanism, ContactId(k));
        assert_vector(contact.point, [(0.42 + end) * cos, (0.42 + end) * sin], 1.0);
        assert_close(contact.sliding_velocity, -0.7, 1.0, 1e-12);
    }
    let middle = configuration.velocity_at(sleeve.block, Vector2::new(0.42 * cos, 0.42 * sin));
    assert_vector(middle, [-0.7 * cos - 0.42 * 3.0 * sin, -0.7 * sin + 0.42 * 3.0 * cos], 1.0);
}

#[rstest]
#[case("drawer", "x", "0.1", &[("guide.front", 0.3), ("guide.rear", -0.2)], 0.5)]
#[case("drawer", "x", "-0.25", &[("guide.front", -0.05), ("guide.rear", -0.2)], 0.15)]
#[case("cam-follower", "lift", "0.02", &[("bushing.front", 0.13), ("bushing.rear", 0.05)], 0.08)]
fn contacts_travel_with_what_carries_them(
    #[case] name: &str,
    #[case] coordinate: &str,
    #[case] value: &str,
    #[case] places: &[(&str, f64)],
    #[case] overlap: f64,
) {
    let settings = Settings::default().position(coordinate, value);
    let (mechanism, configuration) = configured(&model(name), &settings).unwrap();
    for (k, (contact, place)) in places.iter().enumerate() {
        assert_eq!(mechanism.contacts[k].name.as_ref(), *contact);
        let contact = configuration.contact(&mechanism, ContactId(k));
        assert_close(contact.point.dot(&contact.tangent), *place, 1.0, 1e-12);
    }
    let JointKind::Slider(slider) = &mechanism.joints[0].kind else { panic!("a slider") };
    assert_close(configuration.overlap(&mechanism, slider).unwrap(), overlap, 1.0, 1e-12);
}

#[test]
fn the_overlaps_of_a_boom_shrink_as_it_extends() {
    let boom = model("telescopic-boom");
    let at = |values: [f64; 3]| {
        let settings = (1..=3).zip(values).fold(Settings::default(), |settings, (stage, value)| {
            settings.position(&format!("s_{stage}"), value.to_string())
        });
        configured(&boom, &settings)
    };
    let (mechanism, configuration) = at([0.2, -0.1, 0.55]).unwrap();
    for (joint, expected) in mechanism.joints.iter().zip([0.4, 0.7, 0.05]) {
        let JointKind::Slider(slider) = &joint.kind else { panic!("a slider") };
        assert_close(configuration.overlap(&mechanism, slider).unwrap(), expected, 1.0, 1e-12);
    }
    let faults = at([0.0, 0.61, 0.0]).unwrap_err();
    let [fault] = &faults.sorted()[..] else { panic!("{faults}") };
    let FaultKind::OverlapVanished { joint, overlap, displacement, .. } = &fault.kind else {
        panic!("{faults}")
    };
    assert_eq!(joint, "slide_2");
    assert_close(*overlap, -0.01, 1.0, 1e-12);
    assert_close(*displacement, 0.61, 1.0, 1e-12);
    // Exactly no overlap is none.
    assert!(at([0.0, 0.6, 0.0]).is_err());
    assert!(at([0.0, 0.5999, 0.0]).is_ok());
}

/// A block between the ends of a rail, from -0.1 m to 0.3 m.
const RAIL: &str = r#"
    [bodies.block]
    mass = 1
    moment_of_inertia = 1
    centre_of_mass = [0, 0]
    [joints.rail]
    type = "block_slider"
    block = "block"
    at = [0, 0]
    along = "30 deg"
    length = 0.2
    mu = 0
    travel = [-0.1, 0.3]
    [coordinates.s]
    slide = "rail"
"#;

/// Whatever the direction of the guide, rounding takes a block at an end of its travel out of it nowhere, but a
/// millionth of its way does.
#[test]
fn an_end_of_the_travel_belongs_to_it() {
    for degrees in 1..80 {
        let text = RAIL.replace("30 deg", &format!("{degrees} deg"));
        let at = |place: &str| of_text(&text, &Settings::default().position("s", place)).map(|_| ());
        for end in ["-0.1", "0.3"] {
            assert_eq!(at(end).map_err(|faults| faults.to_string()), Ok(()), "{end} m, {degrees} deg");
        }
        assert!(at("-0.1000003").is_err() && at("0.3000003").is_err(), "{degrees} deg");
    }
}

#[test]
fn travel_limits() {
    let at = |value: &str| of_text(RAIL, &Settings::default().position("s", value));
    for inside in ["-0.09999", "0", "0.29999"] {
        assert!(at(inside).is_ok());
    }
    for (outside, place) in [("-0.10001", -0.10001), ("0.30001", 0.30001)] {
        let faults = at(outside).unwrap_err();
        let FaultKind::TravelExceeded { joint, displacement, least, greatest, .. } = &faults.sorted()[0].kind
        else {
            panic!("{faults}")
        };
        assert_eq!((joint.as_str(), *least, *greatest), ("rail", -0.1, 0.3));
        assert_close(*displacement, place, 1.0, 1e-12);
    }
}

/// A four-bar linkage: crank OA, coupler AB, rocker CB. `side` is 1 for the drawing with B above AC.
fn four_bar(side: f64) -> String {
    // |OA| = 0.1, |OC| = 0.3; B at the distances 0.28 from A and 0.2 from C, drawn with the crank at 50 degrees.
    let drawn = 50.0_f64.to_radians();
    let b = rocker_pin(drawn, side);
    format!(
        r#"
        [points]
        O = [0, 0]
        C = [0.3, 0]
        A = ["0.1 m*cos(50 deg)", "0.1 m*sin(50 deg)"]
        B = [{}, {}]
        [bodies.crank]
        points = ["O", "A"]
        mass = 1
        shape = {{ bar = ["O", "A"] }}
        [bodies.coupler]
        points = ["A", "B"]
        mass = 1
        shape = {{ bar = ["A", "B"] }}
        [bodies.rocker]
        points = ["B", "C"]
        mass = 1
        shape = {{ bar = ["B", "C"] }}
        [joints]
        O = {{ type = "hinge", between = ["crank.O", "ground.O"] }}
        A = {{ type = "hinge", between = ["coupler.A", "crank.A"] }}
        B = {{ type = "hinge", between = ["rocker.B", "coupler.B"] }}
        C = {{ type = "hinge", between = ["rocker.C", "ground.C"] }}
        [coordinates.phi]
        rotation = "crank"
        drawn_at = "50 deg"
        rate = 1
        "#,
        b[0], b[1]
    )
}

/// Where B is at a crank angle: the intersection of two circles on one side of the line AC.
fn rocker_pin(phi: f64, side: f64) -> [f64; 2] {
    let a = [0.1 * phi.cos(), 0.1 * phi.sin()];
    let between = [0.3 - a[0], -a[1]];
    let distance = between[0].hypot(between[1]);
    let along = (0.28_f64.powi(2) - 0.2_f64.powi(2) + distance * distance) / (2.0 * distance);
    let across = side * (0.28_f64.powi(2) - along * along).sqrt();
    let [ux, uy] = between.map(|component| component / distance);
    [a[0] + along * ux - across * uy, a[1] + along * uy + across * ux]
}

#[rstest]
fn four_bar_keeps_the_branch_of_its_drawing(#[values(1.0, -1.0)] side: f64) {
    let linkage = Model::parse(&four_bar(side)).unwrap();
    for step in -30..=30 {
        let phi = f64::from(step) * 0.25;
        let settings = Settings::default().position("phi", phi.to_string());
        let (mechanism, configuration) = configured(&linkage, &settings).unwrap();
        let rocker = configuration.poses[body(&mechanism, "rocker")].position;
        let pin = rocker_pin(phi, side);
        // The rocker's centre of mass is half-way between B and C.
        assert_vector(rocker, [f64::midpoint(pin[0], 0.3), pin[1] / 2.0], 1.0);
    }
}

#[test]
fn a_drawing_that_closes_only_roughly_is_closed_by_newton() {
    // B is drawn a few millimetres off: rod and rocker keep their drawn lengths and hinge at drawn points of
    // each.
    let text = four_bar(1.0);
    let exact = rocker_pin(50.0_f64.to_radians(), 1.0);
    let apart = format!("B2 = [{}, {}]\n        [bodies.crank]", exact[0] + 0.004, exact[1] - 0.003);
    let text = text
        .replacen("[bodies.crank]", &apart, 1)
        .replace("points = [\"B\", \"C\"]", "points = [\"B2\", \"C\"]")
        .replace("bar = [\"B\", \"C\"]", "bar = [\"B2\", \"C\"]")
        .replace("\"rocker.B\"", "\"rocker.B2\"");
    let (mechanism, configuration) = of_text(&text, &Settings::default()).unwrap();
    let place = |name: &str, drawn: [f64; 2]| {
        let frame = slideway::ids::Frame::Body(slideway::ids::BodyId(body(&mechanism, name)));
        let point = slideway::mechanism::Attachment::new(frame, Vector2::new(drawn[0], drawn[1]));
        configuration.position(&mechanism, &point)
    };
    let coupler = place("coupler", exact);
    let rocker = place("rocker", [exact[0] + 0.004, exact[1] - 0.003]);
    assert!((coupler - rocker).norm() < 1e-15);
    // The crank stays at its angle, the lengths stay those of the drawing.
    assert_eq!(configuration.coordinates, [50.0_f64.to_radians()]);
    let length = (exact[0] + 0.004 - 0.3).hypot(exact[1] - 0.003);
    assert_close((rocker - Vector2::new(0.3, 0.0)).norm(), length, 1.0, 1e-12);
    assert_close(
        (coupler - place("coupler", [0.1 * 50_f64.to_radians().cos(), 0.1 * 50_f64.to_radians().sin()]))
            .norm(),
        0.28,
        1.0,
        1e-12,
    );
}

#[test]
fn a_state_out_of_reach_names_the_joint_that_stays_open() {
    // The crank is longer than the rod is now: from phi = 60 deg it cannot come to 90 deg.
    let settings = Settings::default().parameter("l", "45 mm").position("phi", "90 deg");
    let faults = configured(&model("slider-crank"), &settings).unwrap_err();
    let FaultKind::NotAssembled { gap, reached, .. } = &faults.sorted()[0].kind else { panic!("{faults}") };
    // At best rod and crank stand in line: 50 mm - 45 mm are missing, wherever the gap is left.
    let reached = reached.as_deref().unwrap_or_default();
    assert!(gap.ends_with('m') && reached.starts_with("phi = "), "{gap} {reached}");
    // It can come as far as sin(phi) = 45/50; the state is told in degrees, with six digits.
    let reached: f64 = reached.split_whitespace().nth(2).unwrap().parse().unwrap();
    assert!((reached - (0.9_f64).asin().to_degrees()).abs() <= 0.5e-4, "{reached}");
}

#[test]
fn trammel_points_run_on_ellipses() {
    // The point of the rod at the distances p from A and q from B (p + q = l) has the half-axes q and p.
    for theta in [1.7, 2.0, 2.5, 3.0, 3.6, 5.0, 7.0] {
        let settings = Settings::default().position("theta", f64::to_string(&theta));
        let (mechanism, configuration) = configured(&model("elliptic-trammel"), &settings).unwrap();
        let frame = slideway::ids::Frame::Body(slideway::ids::BodyId(0));
        let [a, b] = [[0.5 * 55_f64.to_radians().cos(), 0.0], [0.0, 0.5 * 55_f64.to_radians().sin()]];
        for share in [0.0, 0.25, 0.5, 1.0] {
            let drawn = Vector2::new(a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]));
            let point = slideway::mechanism::Attachment::new(frame, drawn);
            let place = configuration.position(&mechanism, &point);
            let (p, q) = (0.5 * share, 0.5 * (1.0 - share));
            assert_vector(place, [-q * theta.cos(), p * theta.sin()], 1.0);
        }
    }
}

#[test]
fn relative_rotations_add_up() {
    let text = r#"
        [points]
        O = [0, 0]
        A = [1, 0]
        [bodies.arm]
        points = ["O", "A"]
        mass = 1
        shape = { bar = ["O", "A"] }
        [bodies.wheel]
        points = ["A"]
        mass = 1
        centre_of_mass = "A"
        shape = { disc = 0.1 }
        [joints]
        O = { type = "hinge", between = ["arm.O", "ground.O"] }
        A = { type = "hinge", between = ["wheel.A", "arm.A"] }
        [coordinates]
        phi = { rotation = "arm", value = 0.5, rate = 2 }
        theta = { rotation = "wheel", relative_to = "arm", drawn_at = 0.1, value = 1.4, rate = 3 }
    "#;
    let (_, configuration) = of_text(text, &Settings::default()).unwrap();
    assert_close(configuration.poses[1].angle(), 0.5 + 1.4 - 0.1, 1.0, 1e-12);
    assert_close(configuration.velocities[1].angular, 2.0 + 3.0, 1.0, 1e-12);
    assert_vector(configuration.poses[1].position, [0.5_f64.cos(), 0.5_f64.sin()], 1.0);
    assert_vector(configuration.velocities[1].linear, [-2.0 * 0.5_f64.sin(), 2.0 * 0.5_f64.cos()], 1.0);
}
