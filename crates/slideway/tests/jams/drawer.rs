//! Jams in mid-motion, and stops just before a place where friction locks.
//!
//! The drawer of the gallery in closed form. With c = 2 mu e, the spring's push P = k (x_s - x), the friction
//! F = 2 mu |N| and N = N_rear = -N_front, moments about the mass centre give N (L - x) = e (P - F). While it
//! opens
//!
//! ```text
//! P > 0   N > 0    N (L - x + c) = e P     m x'' = W + P (L - x)/(L - x + c)
//! P < 0   N < 0   |N| (L - x - c) = -e P   m x'' = W + P (L - x)/(L - x - c)
//! ```
//!
//! The second mode locks at x = L - c.

use crate::model;
use slideway::configuration::Configuration;
use slideway::gallery;
use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::motion::decision::{self, jam};
use slideway::motion::{Cause, End, Event, History, JointPhase, SimulateOptions, simulate};

const SLIDES: JointPhase = JointPhase::Sliding(1.0);
const STICKS: JointPhase = JointPhase::Sticking;

/// The numbers of the model, x_s aside.
const LENGTH: f64 = 0.4;
const OFFSET: f64 = 0.12;
const LEVER: f64 = 2.0 * 0.6 * OFFSET;
const LOCKS: f64 = LENGTH - LEVER;
const MASS: f64 = 4.0;
const STIFFNESS: f64 = 60.0;
const START: f64 = 0.2;

fn weight() -> f64 {
    MASS * 9.81 * 5_f64.to_radians().sin()
}

/// The kinetic energy when the spring is slack: with u = L - x and u_s = L - x_s
/// int (u - u_s) u/(u + c) du = u^2/2 - (c + u_s) u + c (c + u_s) ln(u + c).
fn energy_at_slack(slack: f64) -> f64 {
    let sum = LEVER + LENGTH - slack;
    let integral = |u: f64| u * u / 2.0 - sum * u + LEVER * sum * (u + LEVER).ln();
    let pushed = STIFFNESS * (integral(LENGTH) - integral(LENGTH - slack));
    MASS * START * START / 2.0 + weight() * slack + pushed
}

/// What the spring and its friction take from there to x: with u and u_s as above
/// int (u_s - u) u/(u - c) du = -u^2/2 + (u_s - c) u + c (u_s - c) ln(u - c).
fn braking(slack: f64, x: f64) -> f64 {
    let difference = LENGTH - slack - LEVER;
    let integral = |u: f64| -u * u / 2.0 + difference * u + LEVER * difference * (u - LEVER).ln();
    STIFFNESS * (integral(LENGTH - slack) - integral(LENGTH - x))
}

fn drawer(slack: &str) -> Model {
    model("thrown-drawer", &[("x_s", slack)])
}

fn opened(slack: &str) -> History {
    let history = simulate(&drawer(slack), &SimulateOptions::new(1.0)).unwrap();
    assert_eq!(history.end, End::Finished);
    history
}

fn joints(history: &History) -> Vec<&[JointPhase]> {
    history.phases.iter().map(|interval| &interval.phase.joints[..]).collect()
}

fn place(history: &History, event: &Event) -> f64 {
    history.reader().configuration(event.time).unwrap().coordinates[0]
}

fn energy_lost(event: &Event) -> Option<f64> {
    event.causes.iter().find_map(|cause| match cause {
        Cause::Jams { energy_lost } => Some(*energy_lost),
        _ => None,
    })
}

/// The spring is slack at 0.3 m, beyond L - c = 0.256 m. There the normal forces are zero; pressed the other
/// way they would be negative. The impulse has m v = Phi and Lambda (L - x) = e Phi; where it has stopped,
/// the weight holds it by wedging, as W e/(L - x) 2 mu > W.
#[test]
fn the_drawer_jams_where_its_spring_is_slack() {
    let history = opened("0.3 m");
    assert_eq!(joints(&history), [[SLIDES], [STICKS]]);
    let [_, event] = &history.events[..] else { panic!("{:#?}", history.events) };
    assert!((place(&history, event) - 0.3).abs() < 1e-9, "{}", place(&history, event));
    let energy = energy_at_slack(0.3);
    let lost = energy_lost(event).unwrap();
    assert!((lost - energy).abs() < 1e-7 * energy, "{lost} {energy}");
    assert_eq!(event.successors.len(), 1, "{:?}", event.successors);
    assert!(event.words.contains("it jams: an impulse stops it and dissipates 2.9"), "{}", event.words);
    assert!(event.words.ends_with("drawer stops and sticks"), "{}", event.words);
    let last = history.reader().at(1.0).unwrap().configuration;
    assert!(last.rates[0].abs() < 1e-15, "{:?}", last.rates);
    assert!((last.coordinates[0] - 0.3).abs() < 1e-9, "{:?}", last.coordinates);
    assert!(history.energy_error < 1e-7 * energy, "{:e}", history.energy_error);
}

#[test]
fn the_impulse_on_the_drawer_is_that_of_its_derivation() {
    let model =
        drawer("0.3 m").with(&Settings::default().position("x", "0.3 m").rate("x", "1.5 m/s")).unwrap();
    let mechanism = Mechanism::new(&model).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let decision::Jam::Stops(impulses) = jam(&mechanism, &configuration).unwrap() else { panic!("it stops") };
    for impulse in &impulses {
        let friction: f64 = impulse.friction_impulses.iter().map(|friction| friction.total()).sum();
        let normal = OFFSET * MASS * 1.5 / (LENGTH - 0.3);
        assert!((friction - MASS * 1.5).abs() < 1e-10, "{impulse:?}");
        assert!((impulse.normal_impulses[0] - normal).abs() < 1e-10, "{impulse:?}");
        assert!((impulse.normal_impulses[1] + normal).abs() < 1e-10, "{impulse:?}");
        assert!((impulse.energy_lost - MASS * 1.5 * 1.5 / 2.0).abs() < 1e-10);
    }
}

/// The drawer and a second one, which has nothing to do with it and a spring that is slack at 0.36 m.
fn two_drawers() -> Model {
    let text = gallery::find("thrown-drawer").unwrap().text;
    let (head, first) = text.split_at(text.find("[bodies.drawer]").unwrap());
    let names = [
        ("bodies.drawer", "bodies.second"),
        ("block = \"drawer\"", "block = \"second\""),
        ("drawer.inner_end", "second.inner_end"),
        ("joints.guide", "joints.second_guide"),
        ("slide = \"guide\"", "slide = \"second_guide\""),
        ("loads.spring", "loads.second_spring"),
        ("coordinates.x", "coordinates.second_x"),
        ("ground.back", "ground.second_back"),
        ("x_s", "later"),
    ];
    let second = names.iter().fold(first.to_owned(), |text, (one, other)| text.replace(one, other));
    let head = head
        .replace("[parameters]\n", "[parameters]\nlater = \"0.36 m\"\n")
        .replace("[points]\n", "[points]\nsecond_back = [\"-L/2 - later\", 0]\n");
    Model::parse(&format!("{head}{first}\n{second}")).unwrap()
}

/// Where the first drawer jams the second is beyond L - c, too: an impulse could stop it, but its spring still pushes, and it
/// slides on.
#[test]
fn a_jam_stops_only_the_drawer_that_cannot_go_on() {
    let history = simulate(&two_drawers(), &SimulateOptions::new(1.0)).unwrap();
    assert_eq!(joints(&history), [[SLIDES, SLIDES], [STICKS, SLIDES], [STICKS, STICKS]]);
    let [_, first, second] = &history.events[..] else { panic!("{:#?}", history.events) };
    for (index, (event, slack)) in [(first, 0.3), (second, 0.36)].into_iter().enumerate() {
        let places = history.reader().configuration(event.time).unwrap().coordinates.clone();
        assert!((places[index] - slack).abs() < 1e-9, "{places:?}");
        assert!(places[1] > LOCKS, "{places:?}");
        let (lost, energy) = (energy_lost(event).unwrap(), energy_at_slack(slack));
        assert!((lost - energy).abs() < 1e-7 * energy, "{lost} {energy}");
    }
}

/// Beside the other, which is 1e10 times as fast, the velocity of a drawer is not rounding: m v = Phi, Lambda (L - x) = e Phi.
#[test]
fn a_slow_drawer_beside_a_fast_one_jams_with_its_own_impulse() {
    let slow = 1e-6;
    let settings = Settings::default()
        .position("x", "0.3 m")
        .position("second_x", "0.3 m")
        .rate("x", "1e-6 m/s")
        .rate("second_x", "1e4 m/s");
    let mechanism = Mechanism::new(&two_drawers().with(&settings).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let decision::Jam::Stops(impulses) = jam(&mechanism, &configuration).unwrap() else {
        panic!("they stop")
    };
    let of_slow: Vec<_> = impulses.iter().filter(|impulse| impulse.sliding_velocities[0] == 0.0).collect();
    assert!(!of_slow.is_empty(), "{impulses:?}");
    for impulse in of_slow {
        let normal = OFFSET * MASS * slow / (LENGTH - 0.3);
        assert!((impulse.normal_impulses[0] - normal).abs() < 1e-9 * normal, "{impulse:?}");
        assert!((impulse.sliding_velocities[1] - 1e4).abs() < 1e-10, "{impulse:?}");
    }
}

/// `limits`, which knows nothing of time: the mode that locks begins at L - c, and both end where the spring
/// is slack.
#[test]
fn limits_tell_where_the_drawer_locks_and_jams() {
    let report =
        limits(&drawer("0.3 m"), &LimitsOptions::new(Vary::between("x", "0 m", "0.39 m")).effort(0)).unwrap();
    let ends = |pattern: &str| -> Vec<[f64; 2]> {
        let modes = report.modes.iter().filter(|mode| mode.pattern == pattern);
        modes.map(|mode| [mode.from.unwrap(), mode.to.unwrap()]).collect()
    };
    let close = |found: &[[f64; 2]], expected: [f64; 2]| {
        let [found] = found else { panic!("{found:?}") };
        assert!(found.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-9), "{found:?}");
    };
    close(&ends("-+"), [0.0, 0.3]);
    close(&ends("+-"), [LOCKS, 0.3]);
    let history = opened("0.3 m");
    let jam = place(&history, &history.events[1]);
    assert!((jam - ends("+-")[0][1]).abs() < 1e-9, "{jam}");
    let report =
        limits(&drawer("0.2 m"), &LimitsOptions::new(Vary::between("x", "0 m", "0.39 m")).effort(0)).unwrap();
    let braked = report.modes.iter().find(|mode| mode.pattern == "+-").unwrap();
    close(&[[braked.from.unwrap(), braked.to.unwrap()]], [0.2, LOCKS]);
}

/// Slack at 0.2 m: from there on reactions grow with 1/(L - c - x), and stop it where they have taken its
/// energy, before L - c.
#[test]
fn the_drawer_stops_regularly_before_it_locks() {
    let history = opened("0.2 m");
    assert_eq!(joints(&history), [[SLIDES], [SLIDES], [STICKS]]);
    let [_, changes, stops] = &history.events[..] else { panic!("{:#?}", history.events) };
    assert!((place(&history, changes) - 0.2).abs() < 1e-9);
    assert!(matches!(stops.causes[..], [Cause::Stops(_)]), "{:?}", stops.causes);
    let left = |x: f64| energy_at_slack(0.2) + weight() * (x - 0.2) - braking(0.2, x);
    let (mut before, mut after) = (0.2, LOCKS - 1e-15);
    while after - before > 1e-15 {
        let middle = f64::midpoint(before, after);
        if left(middle) > 0.0 { before = middle } else { after = middle }
    }
    let found = place(&history, stops);
    assert!((found - before).abs() < 1e-8 && LOCKS - found > 5e-4, "{found} {before}");
    let mut reader = history.reader();
    for time in [0.33, 0.36, 0.39, 0.3959] {
        let sample = reader.at(time).unwrap();
        let x = sample.configuration.coordinates[0];
        let normal = STIFFNESS * OFFSET * (x - 0.2) / (LOCKS - x);
        let [front, rear] = [0, 1].map(|contact| sample.contacts[contact].normal_force);
        assert!((front - normal).abs() < 1e-5 * normal && (rear + normal).abs() < 1e-5 * normal, "{time}");
    }
}

/// Slack 1 mm before L - c: to take its energy the reactions would need to come within e^-265 of that
/// millimetre. It counts as locked at a billionth; until there friction and spring have taken what the
/// integral says, the impulse takes the rest.
#[test]
fn the_drawer_reaches_the_place_where_it_locks() {
    let history = opened("0.255 m");
    assert_eq!(joints(&history), [[SLIDES], [SLIDES], [STICKS]]);
    let [_, changes, jams] = &history.events[..] else { panic!("{:#?}", history.events) };
    assert!((place(&history, changes) - 0.255).abs() < 1e-9);
    assert!((place(&history, jams) - LOCKS).abs() < 1e-9);
    assert!(jams.causes.contains(&Cause::Locks), "{:?}", jams.causes);
    let expected = energy_at_slack(0.255) + weight() * 1e-3 - braking(0.255, LOCKS - 1e-12);
    let lost = energy_lost(jams).unwrap();
    assert!((lost - expected).abs() < 1e-4 * expected, "{lost} {expected}");
    assert!(expected > 0.9 * energy_at_slack(0.255));
    assert!(history.energy_error < 1e-4 * lost, "{:e}", history.energy_error);
}

/// The drawer in a carcass of 10 kg that rolls at 3 m/s on castors with a resistance of 2 N, on a level
/// floor.
const ROLLING: &str = r#"
[parameters]
e = "0.12 m"
x_s = "0.3 m"
[points]
middle = [0, 0]
load = [0, "e"]
inner_end = ["-0.2 m", 0]
back = ["-0.2 m - x_s", 0]
[bodies.carcass]
points = ["middle", "back"]
mass = "10 kg"
centre_of_mass = "middle"
moment_of_inertia = "1 kg m^2"
[bodies.drawer]
points = ["middle", "load", "inner_end"]
mass = "4 kg"
centre_of_mass = "load"
moment_of_inertia = "0.1 kg m^2"
[joints.castors]
type = "block_slider"
block = "carcass"
at = "middle"
along = "0 deg"
length = "2 m"
mu = 0
preload = "1 N"
[joints.guide]
type = "block_slider"
block = "drawer"
guide = "carcass"
at = "middle"
along = "0 deg"
length = "0.4 m"
mu = 0.6
front = { carried_by = "guide" }
rear = { carried_by = "block" }
[loads.spring]
type = "spring"
between = ["carcass.back", "drawer.inner_end"]
stiffness = "60 N/m"
free_length = "2*x_s"
[coordinates.s]
slide = "castors"
rate = "3 m/s"
[coordinates.x]
slide = "guide"
rate = "0.2 m/s"
"#;

/// Two degrees of freedom. With the reduced mass m = m_d m_c/(m_d + m_c) the drawer opens by m x'' = P (L -
/// x)/(L - x + c) + m R/m_c. At the jam the relative velocity v is lost, m v^2/2, and both roll on together,
/// with the momentum that the resistance R has left, until R stops them.
#[test]
fn a_jam_in_a_rolling_carcass_stops_the_drawer_alone() {
    let history = simulate(&Model::parse(ROLLING).unwrap(), &SimulateOptions::new(30.0)).unwrap();
    assert_eq!(history.end, End::Finished, "{:#?}", history.events);
    // With the reactions of the drawer those of the castors change sides, at the very instant.
    let mut joints = joints(&history);
    joints.dedup();
    assert_eq!(joints, [[SLIDES, SLIDES], [SLIDES, STICKS], [STICKS, STICKS]]);
    let jams = history.events.iter().find(|event| energy_lost(event).is_some()).unwrap();
    let stops = history.events.last().unwrap();
    let (carcass, resistance) = (10.0, 2.0);
    let total = MASS + carcass;
    let reduced = MASS * carcass / total;
    let pushed = energy_at_slack(0.3) - MASS * START * START / 2.0 - weight() * 0.3;
    let energy = reduced * START * START / 2.0 + pushed + reduced * resistance / carcass * 0.3;
    let lost = energy_lost(jams).unwrap();
    assert!((lost - energy).abs() < 1e-6 * energy, "{lost} {energy}");
    let momentum = total * 3.0 + MASS * START - resistance * jams.time;
    let mut reader = history.reader();
    let together = reader.configuration(jams.time + 1e-9).unwrap().clone();
    assert!((together.rates[0] - momentum / total).abs() < 1e-6, "{:?}", together.rates);
    assert!((together.coordinates[1] - 0.3).abs() < 1e-8 && together.rates[1].abs() < 1e-14);
    assert!((stops.time - jams.time - momentum / resistance).abs() < 1e-5, "{}", stops.time);
    assert!((reader.configuration(30.0).unwrap().coordinates[1] - 0.3).abs() < 1e-8);
    assert!(jams.words.contains("drawer stops and sticks"), "{}", jams.words);
}
