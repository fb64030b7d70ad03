//! Blocks on inclines, belts and each other: closed forms of elementary mechanics.

use crate::set_up::{MINUS, PLUS, State, assert_close, joints, phase};
use slideway::ids::JointId;
use slideway::motion::JointPhase::{Sliding, Sticking};
use slideway::motion::decision::{PhaseBound, Standing, sticking, sticking_margin};

/// A block of 2 kg on an incline.
fn incline(degrees: f64, mu: f64, mu_static: f64, rate: f64) -> State {
    let text = format!(
        r#"
gravity = 10
[bodies.block]
mass = 2
centre_of_mass = [0, 0]
moment_of_inertia = 0.01
[joints.plane]
type = "block_slider"
block = "block"
at = [0, 0]
along = "{degrees} deg"
length = 0.4
height = 0.1
mu = {mu}
mu_static = {mu_static}
[coordinates.s]
slide = "plane"
rate = {rate}
"#
    );
    State::text(&text, &[])
}

#[test]
fn a_block_stays_on_an_incline_below_the_angle_of_static_friction() {
    for (degrees, mu, mu_static) in [
        (10.0, 0.3, 0.5),
        (20.0, 0.3, 0.5),
        (26.0, 0.3, 0.5),
        (27.0, 0.3, 0.5),
        (40.0, 0.3, 0.5),
        (5.0, 0.1, 0.1),
    ] {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let state = incline(degrees, mu, mu_static, 0.0);
        let found = state.successors(&[true], None);
        let mut expected = Vec::new();
        if sin / cos < mu_static {
            expected.push("o");
        }
        if sin / cos > mu {
            expected.push("-");
        }
        assert_eq!(joints(&found), expected, "{degrees}");
        if let Some(slip) = found.list.iter().find(|one| one.phase.joints[0] != Sticking) {
            // It slides down, against u, with g (sin - mu cos).
            assert_close(slip.state.sliding_accelerations[0], -10.0 * (sin - mu * cos), 0.0, 1e-12);
            assert_eq!(slip.standing, Standing::Inside);
        }
        // Both ends on one side share N = m g cos and F = m g sin so that both have the same slack.
        let stuck = phase(&[Sticking], &[MINUS, PLUS]);
        let margin = sticking_margin(&state.mechanism, &state.configuration, &stuck).unwrap();
        assert_close(margin, (mu_static * cos - sin) / 2.0, 1.0, 1e-11);
        let sticking = sticking(&state.mechanism, &state.configuration, &stuck).unwrap().unwrap();
        assert_eq!(sticking.phase.contacts, [PLUS, PLUS]);
        let friction: f64 = sticking.state.frictions.iter().map(|friction| friction.total()).sum();
        // Friction on the block points up the incline: negative along -u.
        assert_close(friction, -20.0 * sin, 0.0, 1e-12);
        assert_eq!(sticking.state.indeterminate, 1);
    }
}

#[test]
fn at_the_angle_of_friction_rounding_would_decide() {
    // tan(a) = 0.5
    let state = incline(0.5_f64.atan().to_degrees(), 0.5, 0.5, 0.0);
    let stuck = phase(&[Sticking], &[PLUS, PLUS]);
    let found = state.successors(&[true], Some(&stuck));
    assert_eq!(joints(&found), ["o", "-"]);
    assert!(found.list[0].is_present);
    assert_eq!(found.list[0].standing, Standing::Undecided(vec![PhaseBound::Sticking]));
    assert_eq!(found.list[1].standing, Standing::Undecided(vec![PhaseBound::Slip(JointId(0))]));
}

#[test]
fn a_block_that_slides_goes_on_until_it_stops() {
    for (rate, stopped, expected) in [(1.0, false, "+"), (-1.0, false, "-"), (0.0, true, "o")] {
        let state = incline(10.0, 0.3, 0.5, rate);
        let sliding = phase(&[Sliding(1.0)], &[PLUS, PLUS]);
        let found = state.successors(&[stopped], Some(&sliding));
        assert_eq!(joints(&found), [expected]);
        assert_eq!(found.list[0].is_present, rate > 0.0);
        assert_eq!(found.list[0].continues, rate > 0.0);
    }
}

/// A block of 3 kg on a belt, held by a spring of 200 N/m.
fn belt(x: f64, speed: f64, block_speed: f64, mu: f64, mu_static: f64) -> State {
    let text = format!(
        r#"
gravity = 10
[points]
wall = [-5, 0]
c = [0, 0]
d = [0, -0.1]
[bodies.belt]
mass = 1
points = ["d"]
centre_of_mass = [0, -0.1]
moment_of_inertia = 1
[bodies.block]
mass = 3
centre_of_mass = [0, 0]
moment_of_inertia = 0.01
points = ["c"]
[joints.bed]
type = "guided_slider"
block = "belt"
at = [0, -0.1]
along = "0 deg"
length = 100
mu = 0
[joints.friction]
type = "block_slider"
block = "block"
guide = "belt"
at = [0, 0]
along = "0 deg"
length = 0.2
height = 0.02
mu = {mu}
mu_static = {mu_static}
[loads.spring]
type = "spring"
between = ["ground.wall", "block.c"]
stiffness = 200
free_length = 5
[drives.motor]
coordinate = "q"
acceleration = 0
force = {{ at = "belt.d", direction = "0 deg" }}
[coordinates.q]
slide = "bed"
rate = {speed}
[coordinates.x]
x = "block.c"
value = {x}
rate = {block_speed}
"#
    );
    State::text(&text, &[])
}

#[test]
fn a_block_rides_on_a_belt_until_the_spring_pulls_it_off() {
    // It sticks as long as k x <= mu_static m g: x <= 0.5 * 30 / 200 = 0.075 m.
    let stuck = phase(&[Sliding(1.0), Sticking], &[PLUS, PLUS, PLUS]);
    for x in [0.0, 0.03, 0.07, -0.05] {
        let state = belt(x, 0.4, 0.4, 0.3, 0.5);
        let found = sticking(&state.mechanism, &state.configuration, &stuck).unwrap().unwrap();
        // Both contacts share the friction so that both have the same slack, unless the spring turns the
        // block more.
        let force = (200.0 * x).abs();
        let greatest = 30.0;
        assert_close(found.margin * greatest, (0.5 * 30.0 - force) / 2.0, 1.0, 1e-9);
        let total: f64 = found.state.frictions[1..].iter().map(|friction| friction.total()).sum();
        // Friction on the block is against the spring: along u, so negative along -u.
        assert_close(total, -200.0 * x, 1.0, 1e-9);
        assert_close(found.state.coordinate_accelerations[1], 0.0, 1.0, 1e-12);
        let next = state.successors(&[false, true], Some(&stuck));
        assert!(next.list[0].is_present && next.list[0].continues, "{x}");
    }
}

#[test]
fn at_the_end_of_sticking_the_motion_of_the_belt_decides() {
    let stuck = phase(&[Sliding(1.0), Sticking], &[PLUS, PLUS, PLUS]);
    let at = 0.5 * 30.0 / 200.0;
    // The belt pulls on: it slips back, with the kinetic friction, (mu m g - k x)/m.
    let onwards = belt(at, 0.4, 0.4, 0.3, 0.5).successors(&[false, true], Some(&stuck));
    assert_eq!(joints(&onwards), ["+-"]);
    assert_close(onwards.list[0].state.sliding_accelerations[1], (0.3 - 0.5) * 10.0, 0.0, 1e-9);
    assert!(!onwards.list[0].continues);
    // The belt comes back: it can go on to stick, or slip where kinetic friction is less.
    let back = belt(at, -0.4, -0.4, 0.3, 0.5).successors(&[false, true], Some(&stuck));
    assert_eq!(joints(&back), ["-o", "--"]);
    assert_eq!(back.list[0].standing, Standing::Leaves(vec![PhaseBound::Sticking]));
    // With equal coefficients it begins to slip without acceleration: the next derivative decides.
    let onwards = belt(at, 0.4, 0.4, 0.5, 0.5).successors(&[false, true], Some(&stuck));
    assert_eq!(joints(&onwards), ["+-"]);
    assert_eq!(onwards.list[0].standing, Standing::Leaves(vec![PhaseBound::Slip(JointId(1))]));
    assert!(onwards.list[0].continues);
    let back = belt(at, -0.4, -0.4, 0.5, 0.5).successors(&[false, true], Some(&stuck));
    assert_eq!(joints(&back), ["-o"]);
}

/// A block of 2 kg on a slab of 3 kg, pulled by P; coefficients of the ground and between both.
fn stacked(pull: f64, ground: f64, between: f64, rates: [f64; 2]) -> State {
    let [slab, block] = rates;
    State::text(
        &format!(
            r#"
gravity = 10
[points]
c = [0, 0.3]
[bodies.slab]
mass = 3
centre_of_mass = [0, 0.1]
moment_of_inertia = 0.1
[bodies.block]
mass = 2
centre_of_mass = [0, 0.3]
moment_of_inertia = 0.1
points = ["c"]
[joints.below]
type = "block_slider"
block = "slab"
at = [0, 0.1]
along = "0 deg"
length = 4
height = 0.2
mu = {ground}
[joints.above]
type = "block_slider"
block = "block"
guide = "slab"
at = [0, 0.3]
along = "0 deg"
length = 1
height = 0.2
mu = {between}
[loads.P]
type = "force"
at = "block.c"
components = [{pull}, 0]
[coordinates.x]
slide = "below"
rate = {slab}
[coordinates.s]
slide = "above"
rate = {block}
"#
        ),
        &[],
    )
}

#[test]
fn two_blocks_stick_and_slide_apart_and_together() {
    // Limits of friction: 20 between both, 50 on the ground, times mu.
    let cases = [
        // P, mu on the ground, mu between, what follows, accelerations of the slab and of the block against
        // it
        (5.0, 0.2, 0.4, "oo", [0.0, 0.0]),
        (9.0, 0.2, 0.4, "o+", [0.0, (9.0 - 8.0) / 2.0]),
        (-9.0, 0.2, 0.4, "o-", [0.0, -(9.0 - 8.0) / 2.0]),
        // On smooth ground both go together as long as P - 2 a <= 16 with a = (P - 5)/5.
        (15.0, 0.1, 0.8, "+o", [(15.0 - 5.0) / 5.0, 0.0]),
        (40.0, 0.1, 0.8, "++", [(16.0 - 5.0) / 3.0, (40.0 - 16.0) / 2.0 - (16.0 - 5.0) / 3.0]),
    ];
    for (pull, ground, between, expected, accelerations) in cases {
        let found = stacked(pull, ground, between, [0.0, 0.0]).successors(&[true, true], None);
        assert_eq!(joints(&found), [expected], "{pull}");
        let state = &found.list[0].state;
        for (joint, acceleration) in accelerations.into_iter().enumerate() {
            assert_close(state.sliding_accelerations[joint], acceleration, 1.0, 1e-10);
        }
    }
}

#[test]
fn one_of_two_blocks_stops_while_the_other_slides_on() {
    // Both slide with 1 m/s; friction on the ground takes 3 from the slab's velocity, if the block rides on
    // it.
    let both = phase(&[Sliding(1.0), Sliding(1.0)], &[PLUS; 4]);
    let found = stacked(0.0, 0.3, 0.4, [1.0, 0.0]).successors(&[false, true], Some(&both));
    // The block would need 2 kg 3 m/s^2 = 6 N <= 8 N: it sticks to the slab.
    assert_eq!(joints(&found), ["+o"]);
    assert_close(found.list[0].state.sliding_accelerations[0], -3.0, 0.0, 1e-12);
    // With less friction between both it slides on, forwards: (15 - 2)/3 of the slab, 1 of the block.
    let found = stacked(0.0, 0.3, 0.1, [1.0, 0.0]).successors(&[false, true], Some(&both));
    assert_eq!(joints(&found), ["++"]);
    assert_close(found.list[0].state.sliding_accelerations[0], -13.0 / 3.0, 0.0, 1e-12);
    assert_close(found.list[0].state.sliding_accelerations[1], 13.0 / 3.0 - 1.0, 0.0, 1e-12);
}
