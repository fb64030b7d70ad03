//! What rests stays; what passes does not stop; loads at the very limit.

use super::model_of;
use crate::configuration::Configuration;
use crate::mechanism::Mechanism;
use crate::model::{Model, Settings};
use crate::motion::decision::successors;
use crate::motion::{Cause, End, History, JointPhase, SimulateOptions, simulate};

/// A block of the given mass on a level guide, g = 10 m/s^2, pulled by a force.
fn block(name: &str, [mass, mu, mu_static, rate]: [f64; 4], pull: &str) -> String {
    format!(
        "
[bodies.{name}]
points = [\"P\"]
mass = {mass:?}
centre_of_mass = \"P\"
shape = {{ rectangle = [0.2, 0.1] }}
[joints.g{name}]
type = \"block_slider\"
block = \"{name}\"
at = \"P\"
along = \"0 deg\"
length = 0.2
mu = {mu:?}
mu_static = {mu_static:?}
[loads.f{name}]
type = \"force\"
at = \"{name}.P\"
components = [\"{pull}\", 0]
[coordinates.{name}]
slide = \"g{name}\"
rate = {rate:?}
"
    )
}

const HEAD: &str = "gravity = 10\n[parameters]\nsecond = \"1 s\"\n[points]\nP = [0, 0]\n";

fn run(text: &str, duration: f64) -> History {
    let model = Model::parse(text).unwrap_or_else(|faults| panic!("{faults}"));
    let mut options = SimulateOptions::new(duration);
    options.longest_step = Some(duration / 50.0);
    simulate(&model, &options).unwrap()
}

fn sticks_to_the_end(history: &History) {
    assert_eq!(history.end, End::Finished);
    assert_eq!(history.phases.len(), 1, "{:?}", history.events);
    assert!(history.phases[0].phase.joints.iter().all(|joint| *joint == JointPhase::Sticking));
}

/// One block is held by 4 N against a pull of 3 N, which could move it against 2 N. It stays when another
/// one, which has nothing to do with it, comes to rest after (1 m/s)/(2 m/s^2).
#[test]
fn what_rests_stays_when_something_else_stops() {
    let text =
        HEAD.to_owned() + &block("a", [1.0, 0.2, 0.4, 0.0], "3 N") + &block("b", [1.0, 0.2, 0.2, 1.0], "0 N");
    let history = run(&text, 2.0);
    assert_eq!(history.end, End::Finished);
    assert_eq!(history.events.len(), 2);
    assert!((history.events[1].time - 0.5).abs() < 1e-9);
    assert_eq!(history.phases[1].phase.joints, [JointPhase::Sticking; 2]);
    // The other one alone decides there: it has one way to go on.
    assert_eq!(history.events[1].successors.len(), 1);
    assert_eq!(history.reader().configuration(2.0).unwrap().coordinates[0], 0.0);
}

/// Five blocks come to rest after 0.1 s, 0.2 s, ... under pulls that hold them: 12^5 states, were they
/// decided together.
#[test]
fn five_independent_blocks_come_to_rest_one_after_another() {
    let mut text = HEAD.to_owned();
    for index in 1..=5 {
        text += &block(&format!("b{index}"), [1.0, 0.2, 0.3, 0.2 * f64::from(index)], "0 N");
    }
    let history = run(&text, 2.0);
    assert_eq!(history.end, End::Finished);
    let times: Vec<f64> = history.events.iter().map(|event| event.time).collect();
    assert_eq!(times.len(), 6, "{times:?}");
    for (index, time) in times.iter().enumerate() {
        assert!((time - 0.1 * index as f64).abs() < 1e-9, "{times:?}");
    }
}

/// The load just reaches mu m g = mu_static m g again and again: the block sticks, whatever mass, coefficient
/// and frequency are.
#[test]
fn loads_that_just_reach_the_static_limit_do_not_move_a_block() {
    let mut state = 17_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for _ in 0..100 {
        let (mass, mu, frequency) = (0.1 + 10.0 * next(), 0.05 + next(), 0.3 + 20.0 * next());
        let pull = format!("{mu:?} * {mass:?} * (10 N) * sin({frequency:?}*t/second)");
        let model = Model::parse(&(HEAD.to_owned() + &block("a", [mass, mu, mu, 0.0], &pull))).unwrap();
        let mut options = SimulateOptions::new(3.0);
        options.longest_step = Some(0.03);
        sticks_to_the_end(&simulate(&model, &options).unwrap());
    }
}

/// At the limit all the time, and around it by less than any rounding.
#[test]
fn loads_that_hover_at_the_static_limit_do_not_accumulate_events() {
    for pull in ["3 N", "3 N * (1 + 1e-13*sin(400*t/second))", "min(5 N * t/second, 3 N)"] {
        sticks_to_the_end(&run(&(HEAD.to_owned() + &block("a", [1.0, 0.3, 0.3, 0.0], pull)), 2.0));
    }
    // A little beyond the limit of 3 N for a part of each period of 0.314 s: it slides from sin(20 t) = 0.2
    // on until it has lost what it gained, seven times.
    let pull = "3 N * (1 - 2e-5 + 1e-4*sin(20*t/second))";
    let history = run(&(HEAD.to_owned() + &block("a", [1.0, 0.3, 0.3, 0.0], pull)), 2.0);
    assert_eq!(history.end, End::Finished);
    let slips = history.events.iter().filter(|event| event.causes.contains(&Cause::Slips));
    let times: Vec<f64> = slips.map(|event| event.time).collect();
    assert_eq!(times.len(), 7, "{times:?}");
    for (index, time) in times.iter().enumerate() {
        let expected = (0.2_f64.asin() + std::f64::consts::TAU * index as f64) / 20.0;
        assert!((time - expected).abs() < 1e-7, "{time} {expected}");
    }
}

/// The yoke of a scotch yoke stands for an instant whenever the crank is at a dead centre, phi = 0 and 180
/// deg (here without gravity and loads); no friction can make it stick there while the crank turns, though it
/// would be great enough to jam the yoke a little later.
#[test]
fn a_yoke_passes_its_dead_centres() {
    let settings = [("mu_pin", "0.7"), ("mu_yoke", "0.8"), ("Q", "0 N"), ("T", "0 N*m")];
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let text = crate::gallery::find("scotch-yoke").unwrap().text.replace("gravity = \"g\"", "");
    let model = Model::parse(&text).unwrap().with(&settings).unwrap();
    let history = simulate(&model, &SimulateOptions::new(0.3)).unwrap();
    assert_eq!(history.end, End::Finished);
    let stop = history.events.iter().find(|event| event.words.contains("yoke reverses")).unwrap();
    let at = history.reader().configuration(stop.time).unwrap().clone();
    assert!((at.coordinates[0] - std::f64::consts::PI).abs() < 1e-6 && at.rates[0] > 10.0, "{at:?}");
    // The same at the very dead centre: no phase in which the yoke sticks.
    let mut mechanism = Mechanism::new(&model).unwrap();
    (mechanism.coordinates[0].value, mechanism.coordinates[0].rate) = (std::f64::consts::PI, 14.0);
    let configuration = Configuration::new(&mechanism).unwrap();
    let found = successors(&mechanism, &configuration, &[false, true], None).unwrap();
    assert!(!found.list.is_empty());
    // The slot goes back, towards the axis of the crank.
    assert!(found.list.iter().all(|one| one.phase.joints[1] == JointPhase::Sliding(1.0)), "{found:?}");
}

/// Changes of side follow one another every few milliseconds and none of them ends the motion.
#[test]
fn a_yoke_changes_side_without_jamming() {
    let settings = Settings::default().parameter("mu_pin", "0.5").parameter("mu_yoke", "0.3");
    let model = model_of("scotch-yoke").with(&settings).unwrap();
    let history = simulate(&model, &SimulateOptions::new(0.3)).unwrap();
    assert_eq!(history.end, End::Finished);
    let changes =
        history.events.iter().filter(|event| matches!(event.causes[..], [Cause::NormalForceZero(_)]));
    assert!(changes.count() > 30);
}

/// A block of 10 N on one side of its guide, with a limit of 5 N.
#[test]
fn a_reaction_beyond_its_limit_is_seen_at_the_start() {
    let text = HEAD.to_owned() + &block("a", [1.0, 0.1, 0.1, 1.0], "0 N");
    let text = text.replace("block_slider", "guided_slider");
    let mut options = SimulateOptions::new(1.0);
    options.reaction_limit = Some(5.0);
    let history = simulate(&Model::parse(&text).unwrap(), &options).unwrap();
    assert!(matches!(history.end, End::ReactionLimit(_)), "{:?}", history.end);
    assert_eq!(history.stop(), 0.0);
}

/// A block 0.2 m high above its guide, of half length 0.05 m: pulled at its mass centre by (4 N/s) t it tips
/// where 0.2 m F = 0.05 m 10 N.
#[test]
fn a_guided_slider_at_rest_tips() {
    let text = HEAD.replace("P = [0, 0]", "P = [0, 0.2]\nQ = [0, 0]")
        + &block("a", [1.0, 0.9, 0.9, 0.0], "4 N * t/second");
    let text = text.replace("block_slider", "guided_slider").replace("length = 0.2", "length = 0.1");
    let text =
        text.replace("points = [\"P\"]", "points = [\"P\", \"Q\"]").replace("at = \"P\"", "at = \"Q\"");
    let history = run(&text, 2.0);
    assert!(matches!(history.end, End::Tips(_)), "{:?}", history.end);
    assert!((history.stop() - 0.625).abs() < 1e-9, "{}", history.stop());
    assert!(history.events.last().unwrap().words.contains("begins to tip"));
}

#[test]
fn loads_without_bounds_have_no_value() {
    let text = HEAD.to_owned() + &block("a", [1.0, 0.3, 0.3, 0.0], "(1 N)/(1 - t/second)");
    let history = run(&text, 2.0);
    assert!(matches!(history.end, End::NoValue(_)), "{:?}", history.end);
    assert!((history.stop() - 1.0).abs() < 1e-9, "{}", history.stop());
}

/// Without any force at the contacts both sides are the same: there is one motion.
#[test]
fn sides_without_forces_are_one_branch() {
    let text = HEAD.replace("gravity = 10\n", "") + &block("a", [1.0, 0.3, 0.3, 1.0], "0 N");
    let mechanism = Mechanism::new(&Model::parse(&text).unwrap()).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let found = successors(&mechanism, &configuration, &[false], None).unwrap();
    assert_eq!(found.list.len(), 1, "{found:?}");
    assert_eq!(found.list[0].state.sliding_accelerations, [0.0]);
}
