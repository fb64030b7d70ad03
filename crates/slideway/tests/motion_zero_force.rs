//! Where all forces vanish: drawers seen from above, springs at their free length, loads that grow from zero.
//!
//! A block of mass 1 kg, 0.2 m long, without weight, is pushed by P at e = 0.1 m beside the middle of its
//! guide: both ends of the block share N = P e/(0.2 m) = P/2, so that friction is mu |P|.
#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use slideway::model::Model;
use slideway::motion::{Cause, End, History, JointPhase, SimulateOptions, simulate};
use std::f64::consts::{FRAC_PI_2, PI};

const MU: f64 = 0.3;

fn from_above(offset: f64, rate: f64, more: &str) -> String {
    format!(
        r#"
[parameters]
second = "1 s"
[points]
C = [0, 0]
H = [0, {offset:?}]
W = [-1, {offset:?}]
[bodies.b]
points = ["C", "H"]
mass = "1 kg"
centre_of_mass = "C"
shape = {{ rectangle = [0.2, 0.1] }}
[joints.g]
type = "block_slider"
block = "b"
at = "C"
along = 0
length = "0.2 m"
mu = {MU}
[coordinates.x]
slide = "g"
rate = {rate:?}
{more}
"#
    )
}

fn pushed(offset: f64, force: &str) -> String {
    let load = format!("[loads.f]\ntype = \"force\"\nat = \"b.H\"\ncomponents = [\"{force}\", 0]\n");
    from_above(offset, 0.0, &load)
}

fn sprung(offset: f64, rate: f64) -> String {
    let spring = "[loads.k]\ntype = \"spring\"\nbetween = [\"b.H\", \"ground.W\"]\nstiffness = \"100 N/m\"\n";
    from_above(offset, rate, spring)
}

fn run(text: &str, duration: f64) -> History {
    let model = Model::parse(text).unwrap_or_else(|faults| panic!("{faults}"));
    let history = simulate(&model, &SimulateOptions::new(duration)).unwrap();
    assert_eq!(history.end, End::Finished, "{duration}: {:#?}", history.events);
    history
}

fn times(history: &History) -> Vec<f64> {
    history.events.iter().map(|event| event.time).collect()
}

fn are_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    let close = |(one, other): (&f64, &f64)| (one - other).abs() < tolerance;
    assert!(found.iter().zip(expected).all(close), "{found:?} {expected:?}");
}

const DURATIONS: [f64; 6] = [0.1, 0.3, 0.5, 1.0, 2.0, 3.0];

/// P = (5 N) sin 6 t. In each half period of P the block is at first carried on against P, with (1 + mu) |P|,
/// until its velocity is spent, then it goes along with (1 - mu) |P|. With c = 1 - cos of the angle since the
/// last zero of P, a gain of velocity u (in units of (5 N)/(6 rad/s kg)) before it is spent at (1 + mu) c =
/// u; the next is (1 - mu) (2 - c).
#[test]
fn a_sine_from_zero_carries_a_block_to_and_fro() {
    let mut expected = vec![0.0];
    let mut gained = (1.0 - MU) * 2.0;
    for half in 1..6 {
        let zero = PI * f64::from(half) / 6.0;
        let spent = gained / (1.0 + MU);
        expected.extend([zero, zero + (1.0 - spent).acos() / 6.0]);
        gained = (1.0 - MU) * (2.0 - spent);
    }
    for duration in DURATIONS {
        let history = run(&pushed(0.1, "(5 N)*sin(6*t/second)"), duration);
        let expected: Vec<f64> = expected.iter().copied().filter(|time| *time < duration).collect();
        are_close(&times(&history), &expected, 1e-7);
        assert!(history.phases.iter().all(|one| one.phase.joints[0] != JointPhase::Sticking));
    }
}

/// From its free length on a spring of 100 N/m: out with w_1^2 = (1 + mu) k/m, a quarter of a period, back
/// with w_2^2 = (1 - mu) k/m.
#[test]
fn a_block_swings_about_the_free_length_of_its_spring() {
    let [out, back] = [1.0 + MU, 1.0 - MU].map(|part| FRAC_PI_2 / (100.0 * part).sqrt());
    for duration in DURATIONS {
        let (mut time, mut expected) = (0.0, vec![0.0]);
        while time < duration {
            expected.extend([time + out, time + out + back]);
            time += out + back;
        }
        expected.retain(|time| *time < duration);
        are_close(&times(&run(&sprung(0.1, 0.3), duration)), &expected, 1e-7);
    }
}

/// A spring at its free length, nothing moves, whatever rounding makes of the length.
#[test]
fn a_block_rests_at_the_free_length_of_its_spring() {
    for offset in [0.0, 0.1, 1.0 / 3.0] {
        for at in ["0 m", "0.3 m"] {
            let text = sprung(offset, 0.0).replace("W = [-1", "W = [\"-1 m - x0\"");
            let text = text.replace("[points]", &format!("x0 = \"{at}\"\n[points]"));
            let text = text.replace("stiffness", "free_length = \"1 m + x0\"\nstiffness");
            let history = run(&text, 3.0);
            assert_eq!(history.phases.len(), 1, "{:?}", history.events);
            assert_eq!(history.phases[0].phase.joints, [JointPhase::Sticking]);
        }
    }
}

/// P = a t and P = A (1 - cos w t) move the block from the start, with (1 - mu) P:
/// x = (1 - mu) a t^3/6 and x = (1 - mu) A (t^2/2 - (1 - cos w t)/w^2).
#[test]
fn loads_that_grow_from_zero_move_a_block_from_the_start() {
    let ramp = |t: f64| (1.0 - MU) * 2.0 * t.powi(3) / 6.0;
    let cosine = |t: f64| (1.0 - MU) * 2.0 * (t * t / 2.0 - (1.0 - (3.0 * t).cos()) / 9.0);
    let cases: [(&str, &dyn Fn(f64) -> f64); 2] =
        [("(2 N)*t/second", &ramp), ("(2 N)*(1 - cos(3*t/second))", &cosine)];
    for (force, place) in cases {
        for duration in [1e-3, 0.1, 1.0, 2.0] {
            let history = run(&pushed(0.1, force), duration);
            assert_eq!(history.events.len(), 1, "{force} {:?}", history.events);
            let x = history.reader().configuration(duration).unwrap().coordinates[0];
            let expected = place(duration);
            assert!((x - expected).abs() < 1e-6 * expected + 1e-12, "{force} {duration}: {x} {expected}");
        }
    }
}

/// e = 0.5 m: friction could be mu 2 e/(0.2 m) = 1.5 times the load, so that it wedges from the start and
/// never moves.
#[test]
fn a_load_from_zero_beyond_self_locking_moves_nothing() {
    for force in ["(5 N)*sin(6*t/second)", "(2 N)*t/second", "(-2 N)*(1 - cos(3*t/second))"] {
        for duration in [0.3, 3.0] {
            let history = run(&pushed(0.5, force), duration);
            assert_eq!(history.phases.len(), 1, "{force} {:?}", history.events);
            assert_eq!(history.phases[0].phase.joints, [JointPhase::Sticking]);
        }
    }
}

/// Packings of 1 N at each end hold until (1 - mu) P = 2 N: with P = (2 N/s) t, and with P = (5 N)(1 - cos 3
/// t).
#[test]
fn packings_hold_until_the_load_exceeds_them() {
    let limit = 2.0 / (1.0 - MU);
    let cosine = (1.0 - limit / 5.0_f64).acos() / 3.0;
    for (force, expected) in [("(2 N)*t/second", limit / 2.0), ("(5 N)*(1 - cos(3*t/second))", cosine)] {
        for duration in [1.0, 2.0, 20.0] {
            let text = pushed(0.1, force).replace("mu = ", "preload = \"1 N\"\nmu = ");
            let history = run(&text, duration);
            let slips = history.events.iter().filter(|event| event.causes.contains(&Cause::Slips));
            let first = slips.map(|event| event.time).next();
            if duration < expected {
                assert_eq!(first, None);
            } else {
                assert!((first.unwrap() - expected).abs() < 1e-9, "{first:?} {expected}");
            }
        }
    }
}

/// Nothing acts at all: it goes on for ever, or rests.
#[test]
fn a_block_without_any_force_goes_on_or_rests() {
    for rate in [0.0, 0.3] {
        let history = run(&from_above(0.1, rate, ""), 2.0);
        assert_eq!(history.events.len(), 1);
        let x = history.reader().configuration(2.0).unwrap().coordinates[0];
        assert!((x - 2.0 * rate).abs() < 1e-15, "{x}");
    }
}
