//! Loads against hand formulas: on a body that moves freely along two crossed slides, and on one that turns.

use crate::answers::{acceleration, assert_close, only, report_on, try_report_on};
use rstest::rstest;
use slideway::fault::FaultKind;
use slideway::report::SolveReport;

/// Mass of the plate (kg).
const MASS: f64 = 2.0;

/// A plate that can shift along x and y (on a carriage without mass) but not turn, with a point E beside its
/// centre; in the state it is at (0.3, -0.2) and moves with (1.5, -0.5) m/s.
fn plate(loads: &str) -> SolveReport {
    report_on(&format!(
        r#"
        [parameters]
        k = "50 N/m"
        [points]
        S = [0, 0]
        E = [0.4, 0.1]
        W = [-1, 0.5]
        [bodies.carriage]
        massless = true
        [bodies.plate]
        points = ["S", "E"]
        mass = {MASS}
        moment_of_inertia = 1
        centre_of_mass = "S"
        [joints.along_x]
        type = "block_slider"
        block = "carriage"
        at = [0, 0]
        along = "0 deg"
        length = 1
        mu = 0
        [joints.along_y]
        type = "block_slider"
        block = "plate"
        guide = "carriage"
        at = [0, 0]
        along = "90 deg"
        length = 1
        mu = 0
        [coordinates.x]
        slide = "along_x"
        value = 0.3
        rate = 1.5
        [coordinates.y]
        slide = "along_y"
        value = -0.2
        rate = -0.5
        {loads}
        "#
    ))
}

/// Force on the plate, from its acceleration.
#[track_caller]
fn assert_force(loads: &str, expected: [f64; 2]) {
    let report = plate(loads);
    let [x, y] = acceleration(only(&report), "plate");
    assert_close(MASS * x, expected[0], 1.0, 1e-12);
    assert_close(MASS * y, expected[1], 1.0, 1e-12);
}

/// Where a point of the plate is in the state, seen from the world point W.
fn from_wall(point: [f64; 2]) -> [f64; 2] {
    [point[0] + 0.3 + 1.0, point[1] - 0.2 - 0.5]
}

#[test]
fn spring_with_a_free_length() {
    // F = -k (l - l_0) along the line, from the energy k (l - l_0)^2 / 2.
    for (free, given) in [(0.25, "free_length = 0.25"), (1.4_f64.hypot(0.4), "")] {
        let [x, y] = from_wall([0.4, 0.1]);
        let length = x.hypot(y);
        let tension = 50.0 * (length - free);
        let text = |ends: &str| {
            format!("[loads.s]\ntype = \"spring\"\nbetween = {ends}\nstiffness = \"k\"\n{given}")
        };
        for ends in [r#"["ground.W", "plate.E"]"#, r#"["plate.E", "ground.W"]"#] {
            assert_force(&text(ends), [-tension * x / length, -tension * y / length]);
        }
    }
}

#[test]
fn spring_force_is_the_gradient_of_its_energy() {
    let energy = |x: f64, y: f64| 25.0 * ((x + 1.4).hypot(y - 0.4) - 0.25).powi(2);
    let step = 1e-5;
    let gradient = [
        (energy(0.3 + step, -0.2) - energy(0.3 - step, -0.2)) / (2.0 * step),
        (energy(0.3, -0.2 + step) - energy(0.3, -0.2 - step)) / (2.0 * step),
    ];
    let report = plate(
        "[loads.s]\ntype = \"spring\"\nbetween = [\"ground.W\", \"plate.E\"]\nstiffness = \"k\"\nfree_length = 0.25",
    );
    let found = acceleration(only(&report), "plate").map(|component| MASS * component);
    for axis in 0..2 {
        assert_close(found[axis], -gradient[axis], 1.0, 1e-8);
    }
}

#[test]
fn spring_of_no_free_length_pulls_in_every_position() {
    let text =
        "[loads.s]\ntype = \"spring\"\nbetween = [\"plate.S\", \"ground.W\"]\nstiffness = 7\nfree_length = 0";
    let [x, y] = from_wall([0.0, 0.0]);
    assert_force(text, [-7.0 * x, -7.0 * y]);
}

#[test]
fn damper_resists_the_rate_of_its_length_only() {
    let [x, y] = from_wall([0.4, 0.1]);
    let length = x.hypot(y);
    let rate = (1.5 * x - 0.5 * y) / length;
    let pull = -3.0 * rate / length;
    for ends in [r#"["ground.W", "plate.E"]"#, r#"["plate.E", "ground.W"]"#] {
        let text = format!("[loads.d]\ntype = \"damper\"\nbetween = {ends}\ndamping = 3");
        assert_force(&text, [pull * x, pull * y]);
    }
}

#[rstest]
#[case("components = [3, -4]", [3.0, -4.0])]
#[case("magnitude = 10\ndirection = \"30 deg\"", [8.660_254_037_844_387, 5.0])]
#[case("magnitude = -10\ndirection = [\"W\", \"S\"]", [-8.944_271_909_999_16, 4.472_135_954_999_58])]
#[case("magnitude = \"k*x\"\ndirection = \"0 deg\"", [15.0, 0.0])]
#[case("magnitude = \"2 N s/m*rate(x)\"\ndirection = \"0 deg\"", [3.0, 0.0])]
#[case("components = [\"-k*x - k*y\", \"k*(x + y) + 3 N*cos(t*1 rad/s)\"]", [-5.0, 8.0])]
fn forces(#[case] force: &str, #[case] expected: [f64; 2]) {
    // The moment about S is taken up by the slides: at S and at E it moves the plate alike.
    for at in ["plate.S", "plate.E"] {
        assert_force(&format!("[loads.f]\ntype = \"force\"\nat = \"{at}\"\n{force}"), expected);
    }
}

/// Moment of inertia of the arm about its hinge (kg m^2).
const INERTIA: f64 = 1.25;

/// An arm, hinged at O, drawn along x and turned by 0.6 rad, with 2 rad/s; a wheel hinged to its tip at (1,
/// 0).
fn arm(loads: &str) -> SolveReport {
    report_on(&format!(
        r#"
        [points]
        O = [0, 0]
        M = [0.5, 0.2]
        tip = [1, 0]
        W = [0.3, 1.1]
        [bodies.arm]
        points = ["O", "M", "tip"]
        mass = 1e-9
        moment_of_inertia = {INERTIA}
        centre_of_mass = "O"
        [bodies.wheel]
        points = ["tip"]
        mass = 1e-9
        moment_of_inertia = 0.4
        centre_of_mass = "tip"
        [joints.O]
        type = "hinge"
        between = ["arm.O", "ground.O"]
        [joints.tip]
        type = "hinge"
        between = ["wheel.tip", "arm.tip"]
        [coordinates.phi]
        rotation = "arm"
        value = 0.6
        rate = 2
        [coordinates.theta]
        rotation = "wheel"
        value = -0.3
        rate = 5
        {loads}
        "#
    ))
}

/// Torques on arm and wheel, from their angular accelerations; the masses of 1e-9 kg are within the
/// tolerance.
#[track_caller]
fn assert_torques(loads: &str, expected: [f64; 2]) {
    let report = arm(loads);
    let bodies = &only(&report).bodies;
    assert_close(INERTIA * bodies[0].angular_acceleration, expected[0], 10.0, 1e-8);
    assert_close(0.4 * bodies[1].angular_acceleration, expected[1], 10.0, 1e-8);
}

#[rstest]
#[case("type = \"torque\"\nbody = \"arm\"\nmoment = 3", [3.0, 0.0])]
#[case("type = \"torque\"\nbody = \"wheel\"\nmoment = 3\nreaction = \"arm\"", [-3.0, 3.0])]
#[case("type = \"torque\"\nbody = \"arm\"\nmoment = \"-2 N m*sin(phi)\"", [-1.129_284_946_790_07, 0.0])]
// Relative rotation -0.9 rad, relative rate 3 rad/s.
#[case("type = \"torsional_spring\"\nbetween = [\"wheel\", \"arm\"]\nstiffness = 10", [-9.0, 9.0])]
#[case("type = \"torsional_spring\"\nbetween = [\"wheel\", \"arm\"]\nstiffness = 10\nfree_angle = 0.1", [-10.0, 10.0])]
#[case("type = \"torsional_spring\"\nbetween = [\"ground\", \"arm\"]\nstiffness = 10\nfree_angle = 0.1", [-7.0, 0.0])]
#[case("type = \"torsional_damper\"\nbetween = [\"wheel\", \"arm\"]\ndamping = 2", [6.0, -6.0])]
#[case("type = \"torsional_damper\"\nbetween = [\"arm\", \"ground\"]\ndamping = 2", [-4.0, 0.0])]
fn torques(#[case] load: &str, #[case] expected: [f64; 2]) {
    assert_torques(&format!("[loads.l]\n{load}"), expected);
}

#[test]
fn a_force_fixed_in_the_body_turns_with_it() {
    // In the drawing at (0.5, 0.2) from O: its moment about O does not change as the arm turns.
    let force = "type = \"force\"\nat = \"arm.M\"\ncomponents = [4, 7]";
    let drawn = 0.5 * 7.0 - 0.2 * 4.0;
    assert_torques(&format!("[loads.f]\n{force}\nframe = \"body\""), [drawn, 0.0]);
    // Fixed in the world the arm turns under it.
    let (sin, cos) = 0.6_f64.sin_cos();
    let place = [0.5 * cos - 0.2 * sin, 0.5 * sin + 0.2 * cos];
    assert_torques(&format!("[loads.f]\n{force}"), [place[0] * 7.0 - place[1] * 4.0, 0.0]);
    let along = "type = \"force\"\nat = \"arm.M\"\nmagnitude = 5\ndirection = \"90 deg\"\nframe = \"body\"";
    assert_torques(&format!("[loads.f]\n{along}"), [2.5, 0.0]);
}

#[test]
fn the_reaction_of_a_force_acts_at_the_same_place() {
    // On the wheel at its centre, back on the arm: nothing is left for the arm but what its hinge passes on.
    let force = "[loads.f]\ntype = \"force\"\nat = \"wheel.tip\"\ncomponents = [0, 8]\nreaction = \"arm\"";
    assert_torques(force, [0.0, 0.0]);
    // From the arm at M, back on the wheel: moments about O of the arm with the wheel cancel, about the tip
    // the wheel gets -(M - tip) x F.
    let force = "[loads.f]\ntype = \"force\"\nat = \"arm.M\"\ncomponents = [0, 8]\nreaction = \"wheel\"";
    let (sin, cos) = 0.6_f64.sin_cos();
    let arm = 8.0 * (0.5 * cos - 0.2 * sin);
    let about_tip = -8.0 * (0.5 * cos - 0.2 * sin - cos);
    // The wheel's force -F reaches the arm through the hinge at its tip.
    assert_torques(force, [arm - 8.0 * cos, about_tip]);
}

#[test]
fn a_spring_turns_the_arm_by_its_energy() {
    let energy = |phi: f64| {
        let tip = [phi.cos(), phi.sin()];
        10.0 * ((tip[0] - 0.3).hypot(tip[1] - 1.1) - 0.5).powi(2)
    };
    let step = 1e-5;
    let torque = -(energy(0.6 + step) - energy(0.6 - step)) / (2.0 * step);
    let spring = "[loads.s]\ntype = \"spring\"\nbetween = [\"arm.tip\", \"ground.W\"]\nstiffness = 20\nfree_length = 0.5";
    assert_torques(spring, [torque, 0.0]);
    // A damper takes out power: torque * omega = -c (dl/dt)^2.
    let length = |phi: f64| (phi.cos() - 0.3).hypot(phi.sin() - 1.1);
    let rate = 2.0 * (length(0.6 + step) - length(0.6 - step)) / (2.0 * step);
    let damper = "[loads.d]\ntype = \"damper\"\nbetween = [\"ground.W\", \"arm.tip\"]\ndamping = 6";
    assert_torques(damper, [-6.0 * rate * rate / 2.0, 0.0]);
}

#[test]
fn a_damper_between_coincident_points_has_no_direction() {
    let text = r#"
        [points]
        S = [0, 0]
        [bodies.block]
        points = ["S"]
        mass = 1
        moment_of_inertia = 1
        centre_of_mass = "S"
        [joints.track]
        type = "guided_slider"
        block = "block"
        at = "S"
        along = "0 deg"
        length = 1
        mu = 0
        [loads.d]
        type = "damper"
        between = ["block.S", "ground.S"]
        damping = 1
        [coordinates.s]
        slide = "track"
        rate = 1
    "#;
    let faults = try_report_on(text).unwrap_err();
    assert!(matches!(&faults.sorted()[0].kind, FaultKind::ZeroLength { load } if load == "d"));
}

#[test]
fn prescribed_acceleration_of_a_drive() {
    // F = m (a + mu g) for a block pushed along a level guide, with a = 3 m/s^2 + 2 x / s^2 at x = 0.5 m.
    let report = report_on(
        r#"
        gravity = 9.81
        [points]
        S = [0, 0]
        [bodies.block]
        points = ["S"]
        mass = 4
        moment_of_inertia = 1
        centre_of_mass = "S"
        [joints.track]
        type = "block_slider"
        block = "block"
        at = "S"
        along = "0 deg"
        length = 1
        mu = 0.25
        [coordinates.x]
        slide = "track"
        value = 0.5
        rate = 1
        [drives.push]
        coordinate = "x"
        acceleration = "3 m/s^2 + x*2 s^-2"
        force = { at = "block.S", direction = "0 deg" }
    "#,
    );
    let solution = only(&report);
    assert_close(acceleration(solution, "block")[0], 4.0, 0.0, 1e-12);
    assert_close(solution.drives[0].effort, 4.0 * (4.0 + 0.25 * 9.81), 0.0, 1e-12);
}

#[test]
fn a_drive_between_two_bodies_leaves_their_momentum_alone() {
    // Two bodies on frictionless guides, driven apart by 3 m/s^2: m_1 a_1 + m_2 a_2 = 0, force m_2 a_2.
    let report = report_on(
        r#"
        [points]
        S = [0, 0]
        [bodies.carriage]
        points = ["S"]
        mass = 5
        moment_of_inertia = 1
        centre_of_mass = "S"
        [bodies.slide]
        points = ["S"]
        mass = 2
        moment_of_inertia = 1
        centre_of_mass = "S"
        [joints]
        rail = { type = "block_slider", block = "carriage", at = "S", along = "0 deg", length = 1, mu = 0 }
        way = { type = "block_slider", block = "slide", guide = "carriage", at = "S", along = "0 deg", length = 1, mu = 0 }
        [coordinates]
        x = { slide = "rail", rate = 1 }
        y = { slide = "way", rate = 1 }
        [drives.apart]
        coordinate = "y"
        acceleration = 3
        force = { at = "slide.S", direction = "0 deg", reaction = "carriage" }
        "#,
    );
    let solution = only(&report);
    let (carriage, slide) = (acceleration(solution, "carriage")[0], acceleration(solution, "slide")[0]);
    assert_close(slide - carriage, 3.0, 0.0, 1e-12);
    assert_close(5.0 * carriage, -2.0 * slide, 0.0, 1e-12);
    assert_close(solution.drives[0].effort, 2.0 * slide, 0.0, 1e-12);
}

/// The effort that turns the arm with 4 rad/s^2.
fn arm_effort(effort: &str) -> f64 {
    let drive = format!("[drives.turn]\ncoordinate = \"phi\"\nacceleration = 4\n{effort}");
    only(&arm(&drive)).drives[0].effort
}

#[test]
fn efforts_of_drives_on_an_arm() {
    let torque = INERTIA * 4.0;
    assert_close(arm_effort("torque = { body = \"arm\" }"), torque, 0.0, 1e-8);
    assert_close(arm_effort("torque = { body = \"wheel\", reaction = \"arm\" }"), -torque, 0.0, 1e-8);
    // Across the arm in the drawing, at its tip: turned with the arm its lever is 1 m, fixed in space
    // cos(0.6) m.
    let force = |frame: &str| {
        arm_effort(&format!("force = {{ at = \"arm.tip\", direction = \"90 deg\", frame = \"{frame}\" }}"))
    };
    assert_close(force("body"), torque, 0.0, 1e-8);
    assert_close(force("world"), torque / 0.6_f64.cos(), 0.0, 1e-8);
}

#[test]
fn rotation_counted_against_another_body() {
    // The wheel turns with 5 rad/s, the arm with 2 rad/s: torsional loads and coordinates see the difference.
    let relative = r#"
        [bodies.arm]
        mass = 1
        moment_of_inertia = 1
        centre_of_mass = [0, 0]
        [bodies.wheel]
        mass = 1
        moment_of_inertia = 0.4
        centre_of_mass = [0, 0]
        [points]
        O = [0, 0]
        [joints]
        O = { type = "hinge", between = ["arm.O", "ground.O"] }
        C = { type = "hinge", between = ["wheel.O", "arm.O"] }
        [coordinates]
        phi = { rotation = "arm", value = 0.2, rate = 2 }
        theta = { rotation = "wheel", relative_to = "arm", value = -0.5, rate = 3 }
        [loads.T]
        type = "torque"
        body = "wheel"
        moment = "2 N m + 1 N m*theta - 0.5 N m s*rate(theta)"
        [loads.spring]
        type = "torsional_spring"
        between = ["wheel", "ground"]
        stiffness = 10
    "#
    .replace("[bodies.arm]", "[bodies.arm]\n        points = [\"O\"]")
    .replace("[bodies.wheel]", "[bodies.wheel]\n        points = [\"O\"]");
    let report = report_on(&relative);
    let solution = only(&report);
    // Wheel: 0.4 alpha = 2 - 0.5 - 1.5 - 10 * (0.2 - 0.5); the arm is left alone, so theta'' = alpha.
    assert_close(solution.bodies[1].angular_acceleration, 3.0 / 0.4, 0.0, 1e-12);
    assert_close(solution.bodies[0].angular_acceleration, 0.0, 1.0, 1e-12);
    assert_close(solution.coordinates[1].acceleration, 3.0 / 0.4, 0.0, 1e-12);
    let spring = relative.replace("[\"wheel\", \"ground\"]", "[\"arm\", \"wheel\"]");
    let report = report_on(&spring);
    // Between arm and wheel the rotation is +0.5 rad: -5 N m on the arm, +5 N m on the wheel.
    let solution = only(&report);
    assert_close(solution.bodies[0].angular_acceleration, -5.0, 0.0, 1e-12);
    assert_close(solution.bodies[1].angular_acceleration, 5.0 / 0.4, 0.0, 1e-12);
    assert_close(solution.coordinates[1].acceleration, 5.0 / 0.4 + 5.0, 0.0, 1e-12);
}
