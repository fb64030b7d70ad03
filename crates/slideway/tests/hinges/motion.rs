//! Motions with friction in hinges: closed forms, an independent integration, stops that hold and folds.

use crate::dead_centre::dead_centres;
use rstest::rstest;
use serde::Deserialize;
use slideway::fault::{FaultKind, NoSliding};
use slideway::motion::{Cause, End, History, JointPhase, SimulateOptions, report, simulate};
use slideway::{Model, Settings, gallery};
use std::path::Path;

const MASS: f64 = 1.0;
/// About the centre of mass.
const INERTIA: f64 = 0.02;

/// A body of 1 kg on a pin, its centre of mass so far from the pin, with what is to be added.
fn body_on_pin(distance: f64, friction: &str, rate: f64, further: &str) -> Model {
    let text = format!(
        "{further}\n[points]\nO = [0, 0]\n[bodies.body]\npoints = [\"O\"]\nmass = {MASS}\nmoment_of_inertia = {INERTIA}\n\
         centre_of_mass = [{distance}, 0]\n[joints.pin]\ntype = \"hinge\"\nbetween = [\"body.O\", \"ground.O\"]\n{friction}\n\
         [coordinates.phi]\nrotation = \"body\"\nrate = {rate}\n"
    );
    Model::parse(&text).unwrap()
}

fn moved(model: &Model, duration: f64) -> History {
    moved_with(model, duration, 1e-8)
}

/// A motion whose energy balance closes to this part of its greatest term.
fn moved_with(model: &Model, duration: f64, balance: f64) -> History {
    let history = simulate(model, &SimulateOptions::new(duration).tolerance(1e-10)).unwrap();
    assert!(
        history.energy_error <= balance * history.energy_scale,
        "{} of {}",
        history.energy_error,
        history.energy_scale
    );
    history
}

fn phi(history: &History, time: f64) -> [f64; 2] {
    let mut reader = history.reader();
    let configuration = reader.configuration(time).unwrap();
    [configuration.coordinates[0], configuration.rates[0]]
}

fn times(history: &History, is: impl Fn(&Cause) -> bool) -> Vec<f64> {
    let events = history.events.iter().filter(|event| event.causes.iter().any(&is));
    events.map(|event| event.time).collect()
}

fn is_near(found: f64, expected: f64, part: f64) {
    assert!((found - expected).abs() <= part * expected.abs().max(1e-3), "{found} instead of {expected}");
}

/// A balanced wheel: `|R| = m g`, so `J omega' = -r m g`, and it stays where it stops.
#[test]
fn a_wheel_slows_down_uniformly_and_stops() {
    let history = moved(&body_on_pin(0.0, "friction_radius = 0.01", 30.0, "gravity = 10"), 10.0);
    let deceleration = 0.01 * MASS * 10.0 / INERTIA;
    let stops = times(&history, |cause| matches!(cause, Cause::StopsTurning(_)));
    assert_eq!(stops.len(), 1);
    is_near(stops[0], 30.0 / deceleration, 1e-9);
    is_near(phi(&history, 3.0)[1], 30.0 - 3.0 * deceleration, 1e-9);
    let [angle, rate] = phi(&history, 10.0);
    is_near(angle, 30.0 * 30.0 / (2.0 * deceleration), 1e-9);
    assert!(rate.abs() < 1e-12);
    assert_eq!(history.end, End::Finished);
    let last = &history.phases.last().unwrap().phase;
    assert_eq!(last.hinges[0].state, JointPhase::Sticking);
    let energy = history.reader().at(10.0).unwrap().energy;
    is_near(energy.hinges[0], INERTIA * 30.0 * 30.0 / 2.0, 1e-9);
}

/// Without gravity `|R| = m c sqrt(omega^4 + alpha^2)`, with I = J + m c^2 `alpha = -k omega^2`,
/// `k = r m c / sqrt(I^2 - (r m c)^2)`: `omega = omega_0 / (1 + k omega_0 t)`, `phi = ln(1 + k omega_0 t) / k`.
#[test]
fn an_eccentric_body_slows_down_as_its_own_pull_rubs() {
    let (distance, radius, rate) = (0.1, 0.05, 20.0);
    let (inertia, lever) = (INERTIA + MASS * distance * distance, radius * MASS * distance);
    let k = lever / (inertia * inertia - lever * lever).sqrt();
    for sign in [1.0, -1.0] {
        let history = moved(&body_on_pin(distance, "friction_radius = 0.05", sign * rate, ""), 2.0);
        let grown = 1.0 + k * rate * 2.0;
        let [angle, omega] = phi(&history, 2.0);
        is_near(angle, sign * grown.ln() / k, 1e-9);
        is_near(omega, sign * rate / grown, 1e-9);
        assert_eq!(history.phases.len(), 1);
    }
}

/// `alpha` of a pendulum, from `I alpha = -m g c cos(phi) - s r |R|`, `R = m (a - g)`: a quadratic equation in `|R|`.
fn pendulum(distance: f64, radius: f64, [phi, squared]: [f64; 2], sign: f64) -> f64 {
    let (g, inertia) = (9.81, INERTIA + MASS * distance * distance);
    let weight = -MASS * g * distance * phi.cos();
    // Along the arm and across it: m (-c omega^2 + g sin), m (c alpha + g cos).
    let along = MASS * (g * phi.sin() - distance * squared);
    // across = p - q |R|
    let p = MASS * (g * phi.cos() + distance * weight / inertia);
    let q = MASS * distance * sign * radius / inertia;
    // |R|^2 = along^2 + (p - q |R|)^2
    let (a, b, c) = (1.0 - q * q, p * q, -(along * along + p * p));
    let force = (-b + (b * b - a * c).sqrt()) / a;
    (weight - sign * radius * force) / inertia
}

/// From one turning point to the next: `d(omega^2)/d(phi) = 2 alpha`, by Runge-Kutta steps in the angle, the last of them
/// cut where the velocity vanishes.
fn next_turn(distance: f64, radius: f64, start: f64, sign: f64) -> f64 {
    let slope = |phi: f64, squared: f64| 2.0 * sign * pendulum(distance, radius, [phi, squared], sign);
    let (mut swept, mut squared) = (0.0, 0.0);
    let step = |swept: f64, squared: f64, length: f64| {
        let at = |part: f64| start + sign * (swept + part * length);
        let one = slope(at(0.0), squared);
        let two = slope(at(0.5), squared + 0.5 * length * one);
        let three = slope(at(0.5), squared + 0.5 * length * two);
        let four = slope(at(1.0), squared + length * three);
        squared + length / 6.0 * (one + 2.0 * two + 2.0 * three + four)
    };
    let mut length = 1e-4;
    while length > 1e-15 {
        let next = step(swept, squared, length);
        if next >= 0.0 {
            (swept, squared) = (swept + length, next);
        } else {
            length /= 2.0;
        }
    }
    start + sign * swept
}

/// The turning points of a pendulum from the balance of energy, swing by swing; it stays at the first within
/// `|sin| <= r_static/c` of its lowest place, where `m g c |sin| <= r_static m g`.
#[test]
fn a_pendulum_swings_less_and_less_and_sticks() {
    let (distance, radius) = (0.1, 0.012);
    let model = body_on_pin(distance, "friction_radius = 0.012", 0.0, "gravity = 9.81");
    let history = moved(&model, 6.0);
    let mut expected = vec![0.0];
    loop {
        let start: f64 = expected[expected.len() - 1];
        // The angle is that of the arm from the x axis: its lowest place is at -pi/2.
        let from_lowest = start + std::f64::consts::FRAC_PI_2;
        if from_lowest.sin().abs() <= radius / distance {
            break;
        }
        expected.push(next_turn(distance, radius, start, -from_lowest.signum()));
    }
    assert!(expected.len() > 4);
    let stops = times(&history, |cause| matches!(cause, Cause::StopsTurning(_)));
    assert_eq!(stops.len(), expected.len() - 1, "{:?}", history.events);
    for (time, expected) in stops.iter().zip(&expected[1..]) {
        is_near(phi(&history, *time)[0], *expected, 1e-8);
    }
    assert_eq!(history.phases.last().unwrap().phase.hinges[0].state, JointPhase::Sticking);
    is_near(phi(&history, 6.0)[0], expected[expected.len() - 1], 1e-8);
}

/// A torque `T' t` starts a wheel where it exceeds `r_static m g`; then `J omega' = T' t - r m g`. With both radii equal it
/// starts without a jump.
#[rstest]
#[case(0.02)]
#[case(0.01)]
fn a_wheel_starts_where_static_friction_is_exceeded(#[case] static_radius: f64) {
    let friction = format!("friction_radius = 0.01\nstatic_friction_radius = {static_radius}");
    let torque =
        "gravity = 10\n[loads.torque]\ntype = \"torque\"\nbody = \"body\"\nmoment = \"0.1 N m/s * t\"";
    let history = moved(&body_on_pin(0.0, &friction, 0.0, torque), 4.0);
    let start: f64 = static_radius * MASS * 10.0 / 0.1;
    let slips = times(&history, |cause| matches!(cause, Cause::Slips));
    assert_eq!(slips.len(), 1, "{:?}", history.events);
    is_near(slips[0], start, 1e-8);
    let expected = (0.1 * (16.0 - start * start) / 2.0 - 0.01 * MASS * 10.0 * (4.0 - start)) / INERTIA;
    is_near(phi(&history, 4.0)[1], expected, 1e-8);
}

#[derive(Deserialize)]
struct Reference {
    piston_reverses: Vec<f64>,
    pin_turns_back: Vec<f64>,
    sample: Vec<Sample>,
}

#[derive(Deserialize)]
struct Sample {
    time: f64,
    phi: f64,
    omega: f64,
    pins: f64,
    skirt: f64,
}

/// reference/pinned_slider_crank_motion.py, which errs by 1e-12.
#[test]
fn a_slider_crank_with_rough_pins_moves_as_integrated_apart() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../reference/pinned-slider-crank-motion.toml");
    let reference: Reference = toml::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let model = Model::parse(gallery::find("slider-crank-with-pins").unwrap().text).unwrap();
    let history = moved(&model, 0.1);
    assert_eq!(history.end, End::Finished, "{:?}", history.events.last());
    let joint = |name: &str| history.mechanism.joints.iter().position(|joint| *joint.name == *name).unwrap();
    let of = |found: &slideway::ids::JointId, name: &str| found.index() == joint(name);
    let reverses = times(&history, |cause| matches!(cause, Cause::Stops(id) if of(id, "cylinder")));
    let turns_back = times(&history, |cause| matches!(cause, Cause::StopsTurning(id) if of(id, "B")));
    for (found, expected) in [(reverses, reference.piston_reverses), (turns_back, reference.pin_turns_back)] {
        assert_eq!(found.len(), expected.len());
        found.iter().zip(expected).for_each(|(found, expected)| is_near(*found, expected, 1e-7));
    }
    for Sample { time, phi, omega, pins, skirt } in reference.sample {
        let sample = history.reader().at(time).unwrap();
        is_near(sample.configuration.coordinates[0], phi, 1e-8);
        is_near(sample.configuration.rates[0], omega, 1e-8);
        is_near(sample.energy.hinges.iter().sum(), pins, 1e-7);
        is_near(sample.energy.friction.iter().sum(), skirt, 1e-7);
    }
}

/// The gallery's toggle press with heavy links, its work and no drive.
fn press(alpha: &str, rate: &str) -> Model {
    let text = gallery::find("toggle-press").unwrap().text;
    let mass = |text: &str, body: &str, centre: &str| {
        let (before, after) = text.split_once(body).unwrap();
        let further = format!("mass = 1\ncentre_of_mass = \"{centre}\"\nmoment_of_inertia = 0.001");
        format!("{before}{body}{}", after.replacen("massless = true", &further, 1))
    };
    let text = mass(&mass(&mass(text, "rear_link]", "O"), "front_link]", "K"), "bodies.ram]", "B");
    let (before, drive) = text.split_once("[drives.knee]").unwrap();
    let text = format!("{before}{}", &drive[drive.find("[coordinates").unwrap()..]);
    Model::parse(&text)
        .unwrap()
        .with(&Settings::default().position("alpha", alpha).rate("alpha", rate))
        .unwrap()
}

/// The press holds its load below `delta`, sin(delta) = 2 r/l, and more with the friction of the ram: there it stops for good.
/// Farther open it comes back.
#[test]
fn a_toggle_press_stops_and_holds_or_comes_back() {
    let stays = moved(&press("1.4 deg", "0.05 rad/s"), 0.05);
    let last = stays.phases.last().unwrap();
    assert!(last.phase.hinges.iter().all(|hinge| hinge.state == JointPhase::Sticking), "{:?}", stays.events);
    let returns = moved(&press("8 deg", "-1 rad/s"), 0.01);
    let [angle, rate] = phi(&returns, returns.stop());
    assert!(rate > 1.0 && angle > 8_f64.to_radians(), "{angle} {rate}: {:?}", returns.events);
}

/// A torque T on the eccentric body, without gravity: with `e = r m c / I > 1` there are two solutions as long as
/// `omega^2 sqrt(e^2 - 1) < T / I`. The torque falls faster than the body can slow down: at the fold both end, and the body
/// jams. There `I omega < e I omega` is less than what the pin can hold, so that all motion is lost. Then it starts again.
#[test]
fn at_a_fold_a_body_jams() {
    let (distance, radius) = (0.1, 0.45);
    let inertia = INERTIA + MASS * distance * distance;
    let e: f64 = radius * MASS * distance / inertia;
    assert!((e - 1.5).abs() < 1e-12);
    let torque = "[loads.torque]\ntype = \"torque\"\nbody = \"body\"\nmoment = \"0.3 N m * (1 - t/(0.1 s))\"";
    // Towards the fold the acceleration goes like the square root of the time that is left, of which no step knows.
    let history = moved_with(&body_on_pin(distance, "friction_radius = 0.45", 2.7, torque), 0.09, 1e-6);
    let folds = times(&history, |cause| matches!(cause, Cause::Folds));
    assert_eq!(folds.len(), 1, "{:?}", history.events);
    let at = folds[0];
    let omega = phi(&history, at - 1e-12)[1];
    is_near(omega * omega * (e * e - 1.0).sqrt(), 0.3 * (1.0 - at / 0.1) / inertia, 1e-5);
    let event = history.events.iter().find(|event| event.time == at).unwrap();
    let lost = event.causes.iter().find_map(|cause| match cause {
        Cause::Jams { energy_lost } => Some(*energy_lost),
        _ => None,
    });
    is_near(lost.unwrap(), inertia * omega * omega / 2.0, 1e-5);
    // alpha (1 + e) = T / I
    let alpha = history.reader().at(at).unwrap().accelerations[0][2];
    is_near(alpha, 0.3 * (1.0 - at / 0.1) / inertia / (1.0 + e), 1e-5);
}

/// The energies that a report gives for the end, and the energy of its rates.
fn energies_at_the_end(model: &Model, duration: f64) -> [f64; 4] {
    let options = SimulateOptions::new(duration).tolerance(1e-10);
    let history = simulate(model, &options).unwrap();
    let told = report(&history, &options);
    let sum = |list: &[slideway::motion::Named]| list.iter().map(|named| named.value).sum::<f64>();
    let dissipated = sum(&told.energy.friction) + sum(&told.energy.hinges);
    [told.energy.kinetic[1], dissipated, sum(&told.energy.loads), told.last[0].rate]
}

/// A torque T drives the body on a pin that is so wide, e = r m c / I = 4/3, that there are two solutions. It comes to
/// omega^2 = T / (r m c) = 50/3, where friction takes all of the torque. The motion has turned the force of the pin far
/// from its direction at the start; whatever the time at which it ends, the energies are those of the end.
#[rstest]
fn energies_are_those_of_the_end(#[values(0.5, 0.8, 0.85, 0.9, 1.0, 1.1, 1.2, 1.3, 6.0)] duration: f64) {
    let (mass, distance, inertia, torque) = (2.0, 0.2, 0.09, 2.0);
    let text = format!(
        "[points]\nO = [0, 0]\n[bodies.bar]\npoints = [\"O\"]\nmass = {mass}\nmoment_of_inertia = 0.01\n\
         centre_of_mass = [{distance}, 0]\n[joints.O]\ntype = \"hinge\"\nbetween = [\"bar.O\", \"ground.O\"]\n\
         friction_radius = 0.3\n[loads.T]\ntype = \"torque\"\nbody = \"bar\"\nmoment = {torque}\n\
         [coordinates.q]\nrotation = \"bar\"\nrate = 3\n"
    );
    let model = Model::parse(&text).unwrap();
    let [kinetic, dissipated, work, rate] = energies_at_the_end(&model, duration);
    is_near(kinetic, inertia * rate * rate / 2.0, 1e-12);
    let history = simulate(&model, &SimulateOptions::new(duration).tolerance(1e-10)).unwrap();
    is_near(work, torque * phi(&history, duration)[0], 1e-8);
    is_near(dissipated, inertia * 9.0 / 2.0 + work - kinetic, 1e-7);
    assert!(dissipated > 0.5 * work, "{dissipated}");
    if duration > 5.0 {
        is_near(rate * rate, torque / (0.3 * mass * distance), 1e-6);
    }
    // A reader that begins anywhere follows the same solution.
    for part in [0.3, 0.7, 0.97, 1.0] {
        let mut ordered = history.reader();
        (0..100).for_each(|index| drop(ordered.at(part * duration * f64::from(index) / 100.0)));
        let [alone, after] =
            [history.reader().at(part * duration), ordered.at(part * duration)].map(|sample| sample.unwrap());
        is_near(alone.hinges[0].couple.unwrap(), after.hinges[0].couple.unwrap(), 1e-9);
    }
}

/// Where no effort of the drive moves the mechanism any further, it locks.
fn locks(model: &Model, duration: f64) -> f64 {
    let history = simulate(model, &SimulateOptions::new(duration)).unwrap();
    assert_eq!(history.end, End::Jammed, "{:?}", history.events);
    assert!(history.events.last().unwrap().causes.contains(&Cause::Locks), "{:?}", history.events);
    phi(&history, history.stop())[0]
}

/// The push on the gallery's bell crank passes its friction circle where `a cos(phi) = r`.
#[test]
fn a_driven_lever_locks_where_the_push_passes_the_friction_circle() {
    let model = Model::parse(gallery::find("bell-crank").unwrap().text).unwrap();
    let radius = 0.025 * 0.2_f64.atan().sin();
    is_near(locks(&model, 3.0), (radius / 0.08).acos(), 1e-8);
}

/// A piston turns the crank up to the locked ranges about both dead centres.
#[test]
fn a_crank_locks_where_the_locked_ranges_of_its_dead_centres_begin() {
    for case in dead_centres() {
        let ends = [(1.0, 180.0 - case.inner_deg), (-1.0, case.outer_deg)];
        for (sense, end) in ends.into_iter().filter(|(_, end)| end.is_finite()) {
            is_near(locks(&case.driven_by_piston(sense), 2.0).to_degrees(), end, 1e-7);
        }
    }
}

/// Seen in a mirror everything turns the other way.
#[test]
fn the_mirror_image_moves_as_the_mirror_image() {
    let swing = |distance: f64, rate: f64| {
        let model = body_on_pin(distance, "friction_radius = 0.012", rate, "gravity = 9.81");
        let history = moved(&model, 3.0);
        let [angle, omega] = phi(&history, 3.0);
        (angle, omega, history.events.len())
    };
    let (one, mirrored) = (swing(0.1, 2.0), swing(-0.1, -2.0));
    assert_eq!(one.2, mirrored.2);
    is_near(one.0, -mirrored.0, 1e-9);
    is_near(one.1, -mirrored.1, 1e-9);
}

/// What is refused is named: Klepp's bar only shifts, so that its lower hinge never turns.
#[test]
fn hinges_that_never_turn_are_refused() {
    let bar = gallery::find("klepp-2002").unwrap().text;
    let standing = bar.replacen("type = \"hinge\"", "type = \"hinge\"\nfriction_radius = 0.01", 1);
    let faults = simulate(&Model::parse(&standing).unwrap(), &SimulateOptions::new(1.0)).unwrap_err();
    let expected = FaultKind::HingeDoesNotTurn { hinge: "A".to_owned(), why: NoSliding::Never };
    assert_eq!(faults.sorted()[0].kind, expected);
}

/// Followed past the end of its way: where the links lie on one another, alpha = -90 degrees at (pi/2 + 5 deg)/(1 rad/s),
/// its drive goes on, and no impulse stops what is driven. This is found at once, not by a search without an end.
#[test]
fn no_impulse_stops_what_is_driven() {
    let press = Model::parse(gallery::find("toggle-press").unwrap().text).unwrap();
    let history = simulate(&press, &SimulateOptions::new(2.0)).unwrap();
    assert_eq!(history.end, End::Jammed, "{:?}", history.events.last());
    is_near(history.stop(), (90.0_f64 + 5.0).to_radians(), 1e-5);
}
