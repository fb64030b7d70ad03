//! Loads that are much faster than the steps: nothing passes unseen.
#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use slideway::model::Model;
use slideway::motion::{Cause, End, History, SimulateOptions, simulate};
use std::f64::consts::TAU;

const G: f64 = 9.81;

/// A block of a mass (kg) on a level guide with the same friction at rest, loads at its centre of mass.
fn block(mass: f64, mu: f64, loads: [&str; 2]) -> String {
    let [along, across] = loads;
    format!(
        "gravity = \"9.81 m/s^2\"
points.C = [0, 0]
bodies.block = {{ points = [\"C\"], mass = {mass}, centre_of_mass = \"C\", moment_of_inertia = 0.01 }}
joints.guide = {{ type = \"block_slider\", block = \"block\", at = \"C\", along = 0, length = 0.2, mu = {mu} }}
loads.push = {{ type = \"force\", at = \"block.C\", components = [\"{along}\", \"{across}\"] }}
coordinates.x = {{ slide = \"guide\" }}
"
    )
}

fn history(text: &str, options: &SimulateOptions) -> History {
    let history = simulate(&Model::parse(text).unwrap(), options).unwrap();
    assert_eq!(history.end, End::Finished);
    history
}

fn times(history: &History, is: impl Fn(&Cause) -> bool) -> Vec<f64> {
    let events = history.events.iter().filter(|event| event.causes.iter().any(&is));
    events.map(|event| event.time).collect()
}

fn slips(history: &History) -> Vec<f64> {
    times(history, |cause| matches!(cause, Cause::Slips))
}

fn stops(history: &History) -> Vec<f64> {
    times(history, |cause| matches!(cause, Cause::Stops(_)))
}

/// The zero of a function that is positive on the left and negative on the right.
fn zero([mut left, mut right]: [f64; 2], function: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..100 {
        let middle = f64::midpoint(left, right);
        if function(middle) > 0.0 { left = middle } else { right = middle }
    }
    right
}

/// Where a function falls through zero, found by looking at it so often.
fn falls([from, until]: [f64; 2], every: f64, function: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut found = Vec::new();
    let mut left = from;
    while left < until {
        let right = left + every;
        if function(left) > 0.0 && function(right) <= 0.0 {
            found.push(zero([left, right], &function));
        }
        left = right;
    }
    found
}

fn all_near(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < tolerance, "{found} {expected}");
    }
}

/// A force A + B sin(w (t + t_0)) with A + B > L = mu m g > |A - B|: the block slips where it rises through
/// L, at w (t + t_0) = asin((L - A)/B) + 2 pi k, and m v = (B/w) (cos(w (t_1 + t_0)) - cos(w (t + t_0))) -
/// (L - A) (t - t_1) until that is zero again: two events in each period. Steps are 10 ms long, as in a
/// simulation of 10 s at default options.
#[test]
fn every_slip_under_a_fast_load_is_found() {
    let options = |duration: f64| SimulateOptions::new(duration).longest_step(0.01);
    for (mass, mu, frequency, shift, duration) in
        [(2.0, 0.1, 300.0, 0.0, 1.0), (0.7, 0.25, 300.0, 0.002, 0.1), (3.1, 0.05, 1000.0, 1.0, 0.05)]
    {
        let limit = mu * mass * G;
        let (constant, swing, w) = (0.5 * limit, 1.1 * limit, TAU * frequency);
        let load = format!("{constant} N + ({swing} N)*sin({w}*(t/(1 s) + {shift}))");
        let text = block(mass, mu, [&load, "0"]);
        let found = history(&text, &options(duration));
        let first = ((limit - constant) / swing).asin() / w - shift;
        let periods = (0..).map(|k| first + f64::from(k) / frequency);
        let expected: Vec<f64> =
            periods.skip_while(|time| *time < 0.0).take_while(|time| *time < duration).collect();
        all_near(&slips(&found), &expected, 1e-12);
        let momentum = |from: f64, time: f64| {
            let cosine = |time: f64| (w * (time + shift)).cos();
            swing / w * (cosine(from) - cosine(time)) - (limit - constant) * (time - from)
        };
        let ends = expected.iter().map(|from| {
            let greatest = from + (0.5 - ((limit - constant) / swing).asin() / TAU * 2.0) / frequency;
            zero([greatest, from + 1.0 / frequency], |time| momentum(*from, time))
        });
        let expected: Vec<f64> = ends.take_while(|time| *time < duration).collect();
        all_near(&stops(&found), &expected, 1e-8);
        // However long the simulation is.
        let shorter = history(&text, &SimulateOptions::new(duration / 3.0));
        all_near(&slips(&shorter), &slips(&found)[..slips(&shorter).len()], 1e-13);
        all_near(&stops(&shorter), &stops(&found)[..stops(&shorter).len()], 1e-8);
    }
}

/// 0.6 L sin(2 pi 165.3 t) + 0.402 L sin(2 pi 165 t + 1 rad): the static limit L is exceeded by 2 parts in
/// 1000 around every 3.33 s alone.
#[test]
fn a_beat_that_hardly_exceeds_the_limit_is_found() {
    let limit = 0.1 * 2.0 * G;
    let load = "0.6*(1.962 N)*sin(2*pi*165.3*t/(1 s)) + 0.402*(1.962 N)*sin(2*pi*165*t/(1 s) + 1)";
    let found = history(&block(2.0, 0.1, [load, "0"]), &SimulateOptions::new(5.0));
    let force = |t: f64| limit * (0.6 * (TAU * 165.3 * t).sin() + 0.402 * (TAU * 165.0 * t + 1.0).sin());
    let expected = falls([0.0, 5.0], 1e-5, |time| limit - force(time).abs());
    assert!(expected.len() > 10 && expected.len() < 200, "{}", expected.len());
    all_near(&slips(&found), &expected, 1e-11);
    assert_eq!(stops(&found).len(), expected.len());
}

/// 1 N + 3 N exp(-((t - t_0)/w)^2) reaches L = 1.962 N at t_0 - w sqrt(ln(3/0.962)); a table from 0 N to 3 N
/// at (1.962/3) of the way.
#[test]
fn a_narrow_spike_is_found() {
    for width in [1e-3, 1e-5, 1e-7] {
        let load = format!("1 N + (3 N)*exp(-((t - 0.73456 s)/({width} s))^2)");
        let found = history(&block(2.0, 0.1, [&load, "0"]), &SimulateOptions::new(10.0));
        let expected = 0.734_56 - width * (3.0_f64 / 0.962).ln().sqrt();
        all_near(&slips(&found), &[expected], 1e-15);
        assert_eq!(stops(&found).len(), 1);
    }
    let table = "tables.spike = { argument = [\"0.5 s\", \"0.50001 s\", \"0.50002 s\"], value = [\"0 N\", \"3 N\", \"0 N\"] }\n";
    let found =
        history(&(table.to_owned() + &block(2.0, 0.1, ["spike(t)", "0"])), &SimulateOptions::new(10.0));
    all_near(&slips(&found), &[0.5 + 1e-5 * 1.962 / 3.0], 1e-15);
    assert_eq!(stops(&found).len(), 1);
}

/// Loads that touch the static limit, stay at it or come ever closer to it move nothing, and are decided in
/// no time.
#[test]
fn what_just_reaches_the_limit_sticks() {
    for load in [
        "(0.1*2*9.81 N)*sin(40*t/(1 s))",
        "(0.1*2*9.81 N)*sin(40*t/(1 s) + 1)*cos(t/(7 s))",
        "(0.1*2*9.81 N)*min(t/(1 s), 1)",
        "(0.1*2*9.81 N)*(1 - exp(-t/(0.1 s)))",
        "0.1*2*9.81 N + 0*t*(1 N/s)",
        "(0.1*2*9.81 N)*(0.6*sin(100*t/(1 s)) + 0.4*sin(101*t/(1 s)))",
    ] {
        let found = history(&block(2.0, 0.1, [load, "0"]), &SimulateOptions::new(5.0));
        assert_eq!(found.events.len(), 1, "{load}: {:?}", slips(&found));
        assert!(found.statistics.steps < 2000, "{load}: {}", found.statistics.steps);
        assert_eq!(found.statistics.sampled, 0.0, "{load}");
    }
}

/// A force along the guide and one across it, which relieves the guide: it slips where |F_x| = mu (m g -
/// F_y).
#[test]
fn two_loads_together_decide_when_it_slips() {
    let loads = ["(1.9 N)*sin(500*t/(1 s))", "(2.6 N)*sin(770*t/(1 s) + 0.3)"];
    let found = history(&block(2.0, 0.1, loads), &SimulateOptions::new(0.5));
    let margin = |t: f64| 0.1 * (2.0 * G - 2.6 * (770.0 * t + 0.3).sin()) - 1.9 * (500.0 * t).sin().abs();
    let expected = falls([0.0, 0.5], 1e-6, margin);
    assert!(expected.len() > 10, "{}", expected.len());
    all_near(&slips(&found), &expected, 1e-12);
}

/// A cross table: a carriage of 3 kg on a level guide carries a slider of 1 kg on a guide at 90 degrees
/// without gravity, where preloads of 2 N and 1 N at each end alone rub. A force on the slider with
/// components X and Y slips the carriage where |X| = 4 N and the slider where |Y| = 2 N.
#[test]
fn both_axes_of_a_cross_table_are_watched() {
    let text = "
points = { C = [0, 0], D = [0, 0] }
bodies.carriage = { points = [\"C\"], mass = 3, centre_of_mass = \"C\", moment_of_inertia = 0.01 }
bodies.slider = { points = [\"D\"], mass = 1, centre_of_mass = \"D\", moment_of_inertia = 0.01 }
joints.x = { type = \"block_slider\", block = \"carriage\", at = \"C\", along = \"0 deg\", length = 0.2, mu = 0, preload = 2 }
joints.y = { type = \"block_slider\", block = \"slider\", guide = \"carriage\", at = \"D\", along = \"90 deg\", length = 0.2, mu = 0, preload = 1 }
loads.push = { type = \"force\", at = \"slider.D\", components = [\"(4.1 N)*sin(700*t/(1 s))\", \"(2.1 N)*sin(911*t/(1 s))\"] }
coordinates = { p = { slide = \"x\" }, q = { slide = \"y\" } }
";
    let found = history(text, &SimulateOptions::new(0.004));
    // sin(911 t) = 2/2.1, then sin(700 t) = 4/4.1.
    let expected = [(2.0_f64 / 2.1).asin() / 911.0, (4.0_f64 / 4.1).asin() / 700.0];
    all_near(&slips(&found)[..2], &expected, 1e-10);
}

/// What rests is proven to rest while another block slides.
#[test]
fn a_spike_is_found_while_something_else_moves() {
    let text = block(2.0, 0.1, ["1 N + (3 N)*exp(-((t - 0.73456 s)/(1e-5 s))^2)", "0"])
        + "
bodies.other = { points = [\"C\"], mass = 1, centre_of_mass = \"C\", moment_of_inertia = 0.01 }
joints.rail = { type = \"block_slider\", block = \"other\", at = \"C\", along = 0, length = 0.2, mu = 0.1 }
coordinates.y = { slide = \"rail\", rate = 20 }
";
    let found = history(&text, &SimulateOptions::new(10.0));
    all_near(&slips(&found), &[0.734_56 - 1e-5 * (3.0_f64 / 0.962).ln().sqrt()], 1e-15);
    assert_eq!(found.statistics.sampled, 0.0);
}

/// A block slides at 1 m/s and more, and a force of 30 N exp(-((t - t_0)/w)^2) lifts it against its weight of
/// 19.62 N: it changes over to the upper guide for t_0 -+ w sqrt(ln(30/19.62)).
#[test]
fn a_spike_during_sliding_is_found() {
    for width in [1e-3, 1e-6] {
        let load = format!("(30 N)*exp(-((t - 0.73456 s)/({width} s))^2)");
        let text =
            block(2.0, 0.1, ["3 N", &load]).replace("slide = \"guide\"", "slide = \"guide\", rate = 1");
        let found = history(&text, &SimulateOptions::new(10.0));
        let half = width * (30.0_f64 / 19.62).ln().sqrt();
        let changes = times(&found, |cause| matches!(cause, Cause::NormalForceZero(_)));
        all_near(&changes, &[0.734_56 - half, 0.734_56 + half], 1e-9 * width.max(1e-5));
    }
}
