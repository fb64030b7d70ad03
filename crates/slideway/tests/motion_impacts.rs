//! Impacts on faces with restitution, against closed forms and the reference cases of other programs.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use crate::motion_lifting::{block, lost, numbers, words};
use slideway::model::{Model, Settings};
use slideway::motion::{Cause, End, History, ImpactLaw, SimulateOptions, simulate};

pub(crate) fn history(text: &str, duration: f64) -> History {
    let model = Model::parse(text).unwrap().with(&Settings::default()).unwrap();
    let history = simulate(&model, &SimulateOptions::new(duration)).unwrap();
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    history
}

fn is_near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} {expected}");
}

/// The times of impacts, each with the energy that it has taken.
pub(crate) fn impacts(history: &History) -> Vec<[f64; 2]> {
    let one = |event: &slideway::motion::Event| {
        event.causes.iter().find_map(lost).map(|energy| [event.time, energy])
    };
    history.events.iter().filter_map(one).collect()
}

/// A disc falls by 0.5 m and bounces with 0.6 of its velocity: its flights shrink geometrically, so that it rests at
/// `sqrt(2 h/g) (1 + e)/(1 - e)`.
#[test]
fn a_disc_bounces_to_rest() {
    let text = r#"
        gravity = "9.81 m/s^2"
        [points]
        A = [-9, -0.5]
        B = [9, -0.5]
        C = [0, "0.1 m"]
        [bodies.ball]
        points = ["C"]
        mass = "1 kg"
        centre_of_mass = "C"
        shape = { disc = "0.1 m" }
        [joints.floor]
        type = "disc_on_face"
        block = "ball"
        centre = "C"
        radius = "0.1 m"
        face = ["A", "B"]
        mu = 0
        closed = false
        restitution = 0.6
        [coordinates.x]
        x = "ball.C"
        rate = "0.1 m/s"
        [coordinates.y]
        y = "ball.C"
        [coordinates.spin]
        rotation = "ball"
    "#;
    let history = history(text, 1.5);
    let (fall, e) = ((2.0 * 0.5 / 9.81_f64).sqrt(), 0.6_f64);
    let all = impacts(&history);
    let (mut time, mut energy, mut flight) = (fall, 9.81 * 0.5, 2.0 * fall * e);
    for [found, lost] in all.iter().take(12) {
        is_near(*found, time, 1e-9);
        is_near(*lost, energy * (1.0 - e * e), 1e-9);
        (time, energy, flight) = (time + flight, energy * e * e, flight * e);
    }
    assert!(all.len() > 20, "{:#?}", words(&history));
    is_near(history.phases.last().unwrap().from, fall * (1.0 + e) / (1.0 - e), 1e-5);
    assert_eq!(history.phases.last().unwrap().phase.pattern(&history.mechanism), "+");
    assert!(history.energy_error < 1e-9, "{}", history.energy_error);
}

/// A rod of 1 m without gravity, its tip ahead; `velocity` is that of all of it, and the floor is 10 mm below the tip.
fn rod(lean: f64, [mu, restitution]: [f64; 2], [vx, vy]: [f64; 2]) -> String {
    let [x, y] = [-0.5 * lean.cos(), 0.5 * lean.sin()];
    format!(
        r#"
        [points]
        P = [0, 0]
        C = ["{x} m", "{y} m"]
        A = ["-9 m", "-0.01 m"]
        B = ["9 m", "-0.01 m"]
        [bodies.rod]
        points = ["P", "C"]
        mass = "1 kg"
        moment_of_inertia = "1 kg m^2 / 12"
        centre_of_mass = "C"
        [joints.tip]
        type = "corner_on_face"
        block = "rod"
        at = "P"
        face = ["A", "B"]
        mu = {mu}
        closed = false
        restitution = {restitution}
        [coordinates.x]
        x = "rod.C"
        rate = "{vx} m/s"
        [coordinates.y]
        y = "rod.C"
        rate = "{vy} m/s"
        [coordinates.turn]
        rotation = "rod"
        "#
    )
}

/// The velocity of the tip of the rod just after its impact, away from the floor and along it.
fn of_tip(history: &History, lean: f64, after: f64) -> [f64; 2] {
    let mut reader = history.reader();
    let configuration = reader.configuration(after).unwrap();
    let velocity = &configuration.velocities[0];
    [
        velocity.linear.y + velocity.angular * 0.5 * lean.cos(),
        velocity.linear.x + velocity.angular * 0.5 * lean.sin(),
    ]
}

/// The tip of a falling rod at 41 degrees hits the floor with (-1, -0.37) m/s, and its slip is reversed within the impact. The
/// numbers are those of a closed path (Routh), of which a stiff normal spring with rigid friction gives the same (theory of
/// one-sided contacts, case `impact_that_reverses_slip`); the restitution there is energetic at `e = 1`, where this ends when
/// the contact has returned the work of its compression.
#[test]
fn the_slip_of_a_tip_is_reversed() {
    let lean = 41_f64.to_radians();
    for (restitution, expected) in [(0.0, [0.0, 0.155_143_009_5]), (1.0, [0.872_810_65, 0.442_054_180_3])] {
        let history = history(&rod(lean, [0.33, restitution], [-0.37, -1.0]), 0.02);
        let [time, _] = impacts(&history)[0];
        is_near(time, 0.01, 1e-12);
        let found = of_tip(&history, lean, time + 1e-10);
        found.iter().zip(expected).for_each(|(found, expected)| is_near(*found, expected, 1e-8));
    }
    // Before the work is returned, with the velocity that restitution asks for.
    let history = history(&rod(lean, [0.33, 0.5], [-0.37, -1.0]), 0.02);
    let found = of_tip(&history, lean, 0.011);
    [0.5, 0.319_503_498_7].iter().zip(found).for_each(|(expected, found)| is_near(found, *expected, 1e-9));
}

/// A steep rod whose tip slips ahead of it is pressed the more the more it is pressed (`1 + 3 c (c - mu s) < 0`): compression
/// goes on until the slip stops. Then the tip sticks and comes to rest: with the mobility `A` of the tip the impulse is
/// `-A^-1 v`, and the energy lost `v A^-1 v/2`.
#[test]
fn a_tip_that_wedges_stops_dead() {
    let lean = 2_f64.atan();
    let (c, s) = (lean.cos(), lean.sin());
    assert!(1.0 + 3.0 * c * (c - 2.0 * s) < 0.0);
    let history = history(&rod(lean, [2.0, 0.0], [1.0, -1.0]), 0.0101);
    let [time, lost] = impacts(&history)[0];
    of_tip(&history, lean, time + 1e-11).into_iter().for_each(|rate| is_near(rate, 0.0, 1e-9));
    let [along, across, away] = [1.0 + 3.0 * s * s, 3.0 * c * s, 1.0 + 3.0 * c * c];
    let determinant = along * away - across * across;
    // With v = (1, -1) along and away.
    is_near(lost, (away + along + 2.0 * across) / determinant / 2.0, 1e-10);
}

/// P. Flores, R. Leine, C. Glocker, Modeling and analysis of planar rigid multibody systems with translational clearance joints,
/// Multibody System Dynamics 23 (2010), with the numbers of the Siconos example SliderCrank: both upper corners of the slider
/// hit their face at once. The rates are those of an event-driven program of its own.
#[test]
fn a_slider_with_play_hits_its_face() {
    let face = |name: &str, [from, to]: [&str; 2], y: f64| {
        format!(
            r#"
        [joints.{name}]
        type = "block_on_face"
        block = "slider"
        at = ["0.459 m", "{y} m"]
        face = ["{from}", "{to}"]
        length = "0.1 m"
        mu = 0.01
        restitution = 0.4
        closed = false
        "#,
        )
    };
    let text = format!(
        r#"
        gravity = "9.81 m/s^2"
        [points]
        O = [0, 0]
        P = ["0.153 m", 0]
        Q = ["0.459 m", 0]
        S1 = ["0.0765 m", 0]
        S2 = ["0.306 m", 0]
        UL = [-1, "0.026 m"]
        UR = [1, "0.026 m"]
        LL = [-1, "-0.026 m"]
        LR = [1, "-0.026 m"]
        [bodies.crank]
        points = ["O", "P", "S1"]
        mass = "0.038 kg"
        moment_of_inertia = "7.4e-5 kg m^2"
        centre_of_mass = "S1"
        [bodies.rod]
        points = ["P", "Q", "S2"]
        mass = "0.038 kg"
        moment_of_inertia = "5.9e-4 kg m^2"
        centre_of_mass = "S2"
        [bodies.slider]
        points = ["Q"]
        mass = "0.076 kg"
        moment_of_inertia = "2.7e-6 kg m^2"
        centre_of_mass = "Q"
        [joints.O]
        type = "hinge"
        between = ["crank.O", "ground.O"]
        [joints.P]
        type = "hinge"
        between = ["crank.P", "rod.P"]
        [joints.Q]
        type = "hinge"
        between = ["rod.Q", "slider.Q"]
        {}
        {}
        [coordinates.crank]
        rotation = "crank"
        rate = "150 rad/s"
        [coordinates.rod]
        rotation = "rod"
        rate = "-75 rad/s"
        [coordinates.slider]
        rotation = "slider"
        "#,
        face("upper", ["UR", "UL"], 0.025),
        face("lower", ["LL", "LR"], -0.025),
    );
    let history = history(&text, 0.0028);
    let [time, lost] = impacts(&history)[0];
    is_near(time, 0.002_692_502_752, 1e-11);
    is_near(lost, 0.037_410_243_72, 1e-9);
    let mut reader = history.reader();
    let after = reader.configuration(time + 1e-11).unwrap();
    let expected = [108.724_58, -52.842_290_42, 0.0];
    for (velocity, expected) in after.velocities.iter().zip(expected) {
        is_near(velocity.angular, expected, 1e-4);
    }
}

/// No impact adds energy with any restitution, and the balance closes: blocks thrown with random tilt and rates.
#[test]
fn no_restitution_adds_energy() {
    let mut next = numbers(7);
    let mut count = 0;
    for _ in 0..100 {
        let [tilt, u, v, w] = [next(-40.0, 40.0), next(-2.0, 2.0), next(-3.0, 0.0), next(-5.0, 5.0)];
        let ([b, h, mu], restitution) = ([next(0.1, 0.5), next(0.1, 0.5), next(0.0, 1.5)], next(0.0, 1.0));
        let joint = format!(
            "at = \"M\"\nface = [\"A\", \"B\"]\nmu = {mu}\nrestitution = {restitution}\nclosed = false"
        );
        let coordinates = format!(
            "[coordinates.x]\nx = \"box.C\"\nrate = \"{u} m/s\"\n[coordinates.y]\ny = \"box.C\"\nrate = \"{v} m/s\"\n\
             [coordinates.turn]\nrotation = \"box\"\nvalue = \"{tilt} deg\"\nrate = \"{w} rad/s\""
        );
        let text = block([b, h], &joint, &coordinates);
        let model = Model::parse(&text).unwrap().with(&Settings::default()).unwrap();
        let history = simulate(&model, &SimulateOptions::new(0.4)).unwrap();
        for [_, lost] in impacts(&history) {
            assert!(lost >= -1e-12, "{lost} {:#?}", words(&history));
            count += 1;
        }
        let error = history.energy_error / history.energy_scale;
        assert!(error < 1e-7, "{error} {:?} {:#?}", history.end, words(&history));
    }
    assert!(count > 100, "{count}");
}

/// Two hinged bodies with a corner each, which hit their faces together: by Moreau's law there are three outcomes, with the
/// energies that an enumeration in descriptor form finds (case `impact_with_three_outcomes`).
#[test]
fn all_outcomes_of_moreaus_law_are_told() {
    let corners = [
        (
            "k1",
            "b1",
            [-0.21, -0.09],
            3.2_f64,
            2.57,
            [0.99, 0.75],
            [1.288_091_838_222_007, 0.449_035_367_290_372_8, 0.010_654_836_876_291_367],
        ),
        (
            "k2",
            "b2",
            [-1.84, 0.37],
            1.33_f64,
            2.67,
            [-0.1, 0.73],
            [1.211_908_161_777_993, 0.490_964_632_709_627_2, -0.054_641_550_457_583_67],
        ),
    ];
    let joint = |(name, body, [x, y], angle, mu, [cx, cy], [vx, vy, w]): (
        &str,
        &str,
        [f64; 2],
        f64,
        f64,
        [f64; 2],
        [f64; 3],
    )| {
        let (sin, cos) = angle.sin_cos();
        // Its face is where the corner is 0.1 us later.
        let rate = -sin * (vx - w * (y - cy)) + cos * (vy + w * (x - cx));
        let [fx, fy] = [x - sin * rate * 1e-7, y + cos * rate * 1e-7];
        let end = |side: f64| format!("[{:?}, {:?}]", fx + side * cos, fy + side * sin);
        [
            format!("{name} = [{x}, {y}]\n{name}_a = {}\n{name}_b = {}\n", end(-1.0), end(1.0)),
            format!(
                "[joints.{name}]\ntype = \"corner_on_face\"\nblock = \"{body}\"\nat = \"{name}\"\n\
                 face = [\"{name}_a\", \"{name}_b\"]\nmu = {mu}\nclosed = false\n"
            ),
        ]
    };
    let [[first_points, first], [second_points, second]] = corners.map(joint);
    let [[vx, vy, w1], [.., w2]] = corners.map(|corner| corner.6);
    let text = format!(
        r#"
        [points]
        {first_points}
        {second_points}
        S1 = [0.99, 0.75]
        S2 = [-0.1, 0.73]
        H = [0.72, 1.9]
        [bodies.b1]
        points = ["S1", "H", "k1"]
        mass = 2.52
        moment_of_inertia = 0.251
        centre_of_mass = "S1"
        [bodies.b2]
        points = ["S2", "H", "k2"]
        mass = 2.82
        moment_of_inertia = 0.277
        centre_of_mass = "S2"
        [joints.hinge]
        type = "hinge"
        between = ["b2.H", "b1.H"]
        {first}
        {second}
        [coordinates.x]
        x = "b1.S1"
        rate = {vx:?}
        [coordinates.y]
        y = "b1.S1"
        rate = {vy:?}
        [coordinates.turn]
        rotation = "b1"
        rate = {w1:?}
        [coordinates.other]
        rotation = "b2"
        rate = {w2:?}
        "#
    );
    let model = Model::parse(&text).unwrap().with(&Settings::default()).unwrap();
    let history = simulate(&model, &SimulateOptions::new(0.01).impacts(ImpactLaw::Moreau)).unwrap();
    let End::Undecided(faults) = &history.end else { panic!("{:?} {:#?}", history.end, words(&history)) };
    let faults = faults.to_string();
    for outcome in [
        "k1 sticks, k2 sticks (4.756 J lost)",
        "k1 slides, k2 sticks (4.756 J lost)",
        "k1 lifts off, k2 sticks (2.522 J lost)",
    ] {
        assert!(faults.contains(outcome), "{faults}");
    }
    assert!(faults.contains("3 outcomes"), "{faults}");
}

/// The woodpecker toy with finite rotations: period, drop and the state in which the sleeve begins to stick, by an event-driven
/// program of its own for both laws (case `woodpecker_exact_geometry`; time stepping agrees).
#[test]
fn the_woodpecker_pecks() {
    let text = include_str!("../models/woodpecker.toml");
    let model = Model::parse(text).unwrap().with(&Settings::default()).unwrap();
    for (law, period, drop) in [
        (ImpactLaw::Course, 0.148_858_285_9, 0.021_389_215_72),
        (ImpactLaw::Moreau, 0.130_747_525, 0.014_496_911_1),
    ] {
        let history = simulate(&model, &SimulateOptions::new(2.5).impacts(law)).unwrap();
        assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
        let stops = history.events.iter().filter(|event| event.words.contains("lower stops and sticks"));
        let times: Vec<f64> = stops.map(|event| event.time).collect();
        let [.., before, last] = times[..] else { panic!("{:#?}", words(&history)) };
        is_near(last - before, period, 1e-7);
        let mut reader = history.reader();
        let mut height = |time: f64| reader.configuration(time).unwrap().poses[0].position.y;
        is_near(height(before) - height(last), drop, 1e-7);
    }
}

/// A box slides into a wall and meets it with its whole front: both corners and both ends of the base touch then, four rows for
/// three motions. What the front returns does not depend on how its corners share it: by `e v` it slides back.
#[test]
fn a_box_meets_a_wall_with_its_whole_front() {
    let (mu, e, way, v) = (0.25, 0.4, 0.85, 3.0_f64);
    let corner = |name: &str, height: f64| {
        format!(
            "[joints.{name}]\ntype = \"corner_on_face\"\nblock = \"box\"\nat = [0.15, {height}]\nface = [\"foot\", \"top\"]\n\
             closed = false\nmu = 0\nrestitution = {e}\n"
        )
    };
    let text = format!(
        r#"
        gravity = 9.81
        [points]
        C = [0, 0.1]
        foot = [1, 0]
        top = [1, 0.5]
        [bodies.box]
        points = ["C"]
        mass = 5
        centre_of_mass = "C"
        shape = {{ rectangle = [0.3, 0.2] }}
        [joints.floor]
        type = "block_on_face"
        block = "box"
        at = [0, 0]
        along = "0 deg"
        length = 0.3
        mu = {mu}
        {}
        {}
        [coordinates.x]
        slide = "floor"
        rate = {v}
        "#,
        corner("low", 0.0),
        corner("high", 0.2),
    );
    let history = history(&text, 1.5);
    let [time, lost] = impacts(&history)[0];
    let arrives = (v * v - 2.0 * mu * 9.81 * way).sqrt();
    is_near(time, (v - arrives) / (mu * 9.81), 1e-9);
    is_near(lost, 5.0 * arrives * arrives * (1.0 - e * e) / 2.0, 1e-8);
    // It slides back until friction has stopped it.
    let rest = history.phases.last().unwrap();
    is_near(rest.from, time + e * arrives / (mu * 9.81), 1e-8);
    let place = history.reader().configuration(1.5).unwrap().poses[0].position.x;
    is_near(place, way - (e * arrives).powi(2) / (2.0 * mu * 9.81), 1e-8);
}

/// Where no slip is reversed both laws of impacts agree: a rod that falls on its tip with random lean, slip and restitution.
/// Where the course reverses it, they differ.
#[test]
fn both_laws_agree_where_no_slip_is_reversed() {
    let mut next = numbers(11);
    let (mut agree, mut differ) = (0, 0);
    for _ in 0..100 {
        let [lean, mu, restitution, slip] = [next(0.3, 1.5), next(0.0, 0.6), next(0.0, 0.9), next(-2.0, 2.0)];
        let model = Model::parse(&rod(lean, [mu, restitution], [slip, -1.0])).unwrap();
        let model = model.with(&Settings::default()).unwrap();
        let [course, moreau] = [ImpactLaw::Course, ImpactLaw::Moreau].map(|law| {
            let history = simulate(&model, &SimulateOptions::new(0.0101).impacts(law)).unwrap();
            of_tip(&history, lean, impacts(&history)[0][0] + 1e-10)
        });
        let off = (course[0] - moreau[0]).abs().max((course[1] - moreau[1]).abs());
        if course[1] * slip > 1e-6 {
            assert!(off < 1e-9, "{lean} {mu} {restitution} {slip}: {course:?} {moreau:?}");
            agree += 1;
        } else if course[1] * slip < -1e-6 {
            assert!(off > 1e-9, "{lean} {mu} {restitution} {slip}: {course:?} {moreau:?}");
            differ += 1;
        }
    }
    assert!(agree > 50 && differ > 0, "{agree} {differ}");
}

/// A balanced wheel on a rough pin, whose peg strikes a face through the pin: its weight alone presses the pin, `|R| = m g`, so that it
/// slows down by `r m g/J`. In the impact the pin answers the peg, `|R| = P`: compression takes `P = J w/(a + r)`, and what it
/// returns, `P = J w'/(a - r)`, returns no more work than it has taken, `w' <= w sqrt((a - r)/(a + r))`.
#[test]
fn a_wheel_on_a_rough_pin_strikes_with_its_peg() {
    let (lever, radius, moment, angle, rate) = (0.3_f64, 0.02_f64, 0.05_f64, 0.5_f64, 3.0_f64);
    let slowing = radius * 9.81 / moment;
    let reaches = (rate - (rate * rate - 2.0 * slowing * angle).sqrt()) / slowing;
    let hits = rate - slowing * reaches;
    for restitution in [0.0_f64, 0.5, 1.0] {
        let text = format!(
            r#"
            gravity = 9.81
            [points]
            O = [0, 0]
            P = [{:?}, {:?}]
            A = [0.1, 0]
            B = [1, 0]
            [bodies.wheel]
            points = ["O", "P"]
            mass = 1
            centre_of_mass = "O"
            moment_of_inertia = {moment}
            [joints.pin]
            type = "hinge"
            between = ["wheel.O", "ground.O"]
            friction_radius = {radius}
            [joints.peg]
            type = "corner_on_face"
            block = "wheel"
            at = "P"
            face = ["A", "B"]
            mu = 0
            restitution = {restitution}
            closed = false
            [coordinates.turn]
            rotation = "wheel"
            rate = -{rate}
            "#,
            lever * angle.cos(),
            lever * angle.sin()
        );
        let history = history(&text, 1.5);
        let [time, lost] = impacts(&history)[0];
        let leaves = hits * restitution.min(((lever - radius) / (lever + radius)).sqrt());
        is_near(time, reaches, 1e-8);
        is_near(lost, moment * (hits * hits - leaves * leaves) / 2.0, 1e-9);
        let end = history.reader().at(1.5).unwrap().configuration.clone();
        is_near(end.rates[0], 0.0, 1e-12);
        is_near(end.coordinates[0] + angle, leaves * leaves / (2.0 * slowing), 1e-7);
        assert!(history.energy_error < 1e-9, "{}", history.energy_error);
    }
}

/// A crank without weight strikes a face and stops; a wheel that does not spin sits on a rough pin at its end. Whatever friction does,
/// the pin takes `R = m L w` from the wheel's centre. By Moreau's law friction opposes the spin that is left, and the wheel has none.
/// Along the course it is taken along by `c = r m L/J` of what the crank loses until both turn alike, at `w/(1 + c)`; then the crank is
/// the slower one, and of `c w/(1 + c)` the part `1 - c` is left.
#[test]
fn a_crank_that_strikes_takes_a_wheel_along_by_its_pin() {
    let (length, rate, mass, moment, radius) = (0.5_f64, 2.0_f64, 2.0_f64, 0.1_f64, 0.05_f64);
    let angle = 1e-6_f64;
    let text = format!(
        r#"
        [points]
        O = [0, 0]
        E = [{:?}, {:?}]
        Q = [{:?}, {:?}]
        A = [0.1, 0]
        B = [1, 0]
        [bodies.crank]
        points = ["O", "E", "Q"]
        mass = 1
        centre_of_mass = "O"
        moment_of_inertia = 0.2
        [bodies.wheel]
        points = ["E"]
        mass = {mass}
        centre_of_mass = "E"
        moment_of_inertia = {moment}
        [joints.crank]
        type = "hinge"
        between = ["crank.O", "ground.O"]
        [joints.pin]
        type = "hinge"
        between = ["wheel.E", "crank.E"]
        friction_radius = {radius}
        [joints.stop]
        type = "corner_on_face"
        block = "crank"
        at = "Q"
        face = ["A", "B"]
        mu = 0
        closed = false
        [coordinates.crank]
        rotation = "crank"
        rate = -{rate}
        [coordinates.wheel]
        rotation = "wheel"
        rate = 0
        "#,
        length * angle.cos(),
        length * angle.sin(),
        0.3 * angle.cos(),
        0.3 * angle.sin()
    );
    let model = Model::parse(&text).unwrap().with(&Settings::default()).unwrap();
    let c = radius * mass * length / moment;
    for (law, expected) in [(ImpactLaw::Course, -c * rate / (1.0 + c) * (1.0 - c)), (ImpactLaw::Moreau, 0.0)]
    {
        let history = simulate(&model, &SimulateOptions::new(1e-3).impacts(law)).unwrap();
        let rates = history.reader().at(1e-3).unwrap().configuration.rates.clone();
        is_near(rates[0], 0.0, 1e-9);
        is_near(rates[1], expected, 1e-5);
    }
}

/// The published frequency of the woodpecker toy (Leine, Glocker and van Campen 2001, 72.91 Hz; case `woodpecker_toy`): bird and
/// sleeve swing on the spring beside the pole. Small swings are those of the linear geometry of the literature, with the masses
/// `[[m_S + m_M, m_S l_M, m_S l_G], [., J_M + m_S l_M^2, m_S l_M l_G], [., ., J_S + m_S l_G^2]]` of fall, sleeve and bird: `M w = k
/// (0, -1, 1)` gives the motion that swings alone, at `w_rel c/(2 pi)^2` for `k = 1`. The published periods of the pecking belong to that geometry,
/// which no rigid body has at the angles of half a radian to which it swings.
#[test]
fn the_woodpecker_swings_at_its_published_frequency() {
    let text = include_str!("../models/woodpecker.toml");
    let line = |line: &str| -> String {
        match line.split(" = ").next().unwrap() {
            "gravity" => "gravity = 0".to_owned(),
            "sleeve" => "sleeve = 0".to_owned(),
            "lower" => "lower = [\"hole\", \"-h\"]".to_owned(),
            "upper" => "upper = [\"hole\", \"h\"]".to_owned(),
            "sticks" => "closed = false".to_owned(),
            "value" => "value = 0".to_owned(),
            "rate" => "rate = \"1e-3 rad/s\"".to_owned(),
            _ => line.to_owned(),
        }
    };
    let [fall, lean] = [0.086_203_32e-3, -10.695_020_75e-3];
    let text = text.lines().map(line).collect::<Vec<_>>().join("\n")
        + &format!(
            "\n[coordinates.lean]\nrotation = \"sleeve\"\nrate = \"{lean:e} rad/s\"\n\
             [coordinates.fall]\ny = \"sleeve.S\"\nrate = \"{fall:e} m/s\"\n[events.middle]\nzero_of = \"swing - lean\"\n"
        );
    let history = history(&text, 0.1);
    let passes = history.events.iter().filter(|event| matches!(event.causes[..], [Cause::User(..)]));
    let times: Vec<f64> = passes.map(|event| event.time).collect();
    let halves = (times.len() - 1) as f64;
    assert!(halves > 10.0, "{:#?}", words(&history));
    is_near(halves / 2.0 / (times[times.len() - 1] - times[0]), 72.908_498_2, 1e-5);
}

/// A cart of 3 kg that carries a box of 1 kg hits its end stop with 2 m/s, `e = 0.5`. The blow is level, so that nothing presses the
/// box, and no friction passes on: the cart comes back at 1 m/s, the box keeps its 2 m/s, and slides by `mu g = 4 m/s^2`, the cart by a
/// third of that, until both go together at `(2 - 3)/4 m/s`.
#[test]
fn a_cart_hits_its_end_stop_under_a_box() {
    let text = r#"
        gravity = 10
        [points]
        C = [0, 0]
        M = [0, 0.1]
        S = [0, 0.15]
        [bodies.cart]
        points = ["C"]
        mass = 3
        centre_of_mass = "C"
        moment_of_inertia = 1
        [bodies.box]
        points = ["M", "S"]
        mass = 1
        centre_of_mass = "S"
        shape = { rectangle = [0.4, 0.1] }
        [joints.rail]
        type = "block_slider"
        block = "cart"
        at = "C"
        along = 0
        length = 3
        mu = 0
        travel = [-5, 0.5]
        stop = { restitution = 0.5 }
        [joints.base]
        type = "block_on_face"
        block = "box"
        guide = "cart"
        at = "M"
        along = "0 deg"
        length = 0.4
        mu = 0.4
        sticks = true
        [coordinates.x]
        slide = "rail"
        rate = 2
        "#;
    let model = Model::parse(text).unwrap().with(&Settings::default()).unwrap();
    for law in [ImpactLaw::Course, ImpactLaw::Moreau] {
        let history = simulate(&model, &SimulateOptions::new(1.5).impacts(law)).unwrap();
        assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
        let [Cause::Hits { speeds, energy_lost: Some(lost), .. }] = history.events[1].causes[..] else {
            panic!("{:#?}", words(&history))
        };
        is_near(history.events[1].time, 0.25, 1e-12);
        is_near(speeds[0], 2.0, 1e-12);
        is_near(speeds[1], 1.0, 1e-12);
        is_near(lost, 1.5 * (4.0 - 1.0), 1e-12);
        is_near(history.events[2].time, 0.25 + 3.0 / (4.0 + 4.0 / 3.0), 1e-9);
        let end = history.reader().configuration(1.5).unwrap().velocities.clone();
        end.iter().for_each(|velocity| is_near(velocity.linear.x, -0.25, 1e-9));
        assert!(history.energy_error < 1e-12 * history.energy_scale.max(1.0), "{}", history.energy_error);
    }
}
