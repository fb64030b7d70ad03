//! Motions against derivations, an independent integration, and guides that are springs.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::motion::{Cause, End, History, SimulateOptions, simulate};
use std::f64::consts::PI;

const G: f64 = 9.81;

fn history(name: &str, settings: &[(&str, &str)], options: &SimulateOptions) -> History {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model = Model::parse(gallery::find(name).unwrap().text).unwrap().with(&settings).unwrap();
    simulate(&model, options).unwrap()
}

fn times(history: &History, is: impl Fn(&Cause) -> bool) -> Vec<f64> {
    let events = history.events.iter().filter(|event| event.causes.iter().any(&is));
    events.map(|event| event.time).collect()
}

fn words(history: &History) -> Vec<String> {
    history.events.iter().map(|event| format!("{} {}", event.time, event.words)).collect()
}

/// With w^2 = k/m the block is at u = x - mu g/w^2. It sticks from u = -d to u = d, d = (mu_static - mu)
/// g/w^2, at the speed v of the belt: 2 d/v. Then u'' = -w^2 u from (d, v) until u' = v again, at u = -d:
/// (2/w) (pi - atan(w d/v)).
#[test]
fn stick_slip_has_its_period() {
    let history = history("stick-slip", &[], &SimulateOptions::new(10.0));
    assert_eq!(history.end, End::Finished);
    let (w, v) = (10.0, 0.2);
    let d = (0.4 - 0.25) * G / (w * w);
    let (sticks, slides) = (2.0 * d / v, 2.0 / w * (PI - f64::atan(w * d / v)));
    let slips = times(&history, |cause| matches!(cause, Cause::Slips));
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    assert!(slips.len() >= 14, "{:#?}", words(&history));
    for pair in slips.windows(2) {
        assert!((pair[1] - pair[0] - sticks - slides).abs() < 1e-7, "{pair:?}");
        let stop = stops.iter().find(|stop| **stop > pair[0]).unwrap();
        assert!((stop - pair[0] - slides).abs() < 1e-7, "{stop} {pair:?}");
    }
}

/// With w^2 = k/m and f = mu m g/k: sliding in the direction s it swings about -s f. From x = 0 with v_0 it
/// reaches x_1 = -f + sqrt(f^2 + v_0^2/w^2) after atan2(v_0/w, f)/w; each further half cycle lasts pi/w and
/// ends 2 f nearer. It stays at the first turning point within mu_static m g/k.
#[test]
fn a_frictional_oscillator_comes_to_rest() {
    let history = history("frictional-oscillator", &[], &SimulateOptions::new(4.0));
    assert_eq!(history.end, End::Finished);
    let (w, v) = (f64::sqrt(250.0), 2.0);
    let (f, static_limit) = (0.2 * G / 250.0, 0.25 * G / 250.0);
    let mut turning = -f + f64::hypot(f, v / w);
    let mut time = f64::atan2(v / w, f) / w;
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    let mut reader = history.reader();
    let mut count = 0;
    loop {
        let place = reader.configuration(stops[count]).unwrap().coordinates[0];
        let expected = if count % 2 == 0 { turning } else { -turning };
        assert!((stops[count] - time).abs() < 1e-7, "{} {time}", stops[count]);
        assert!((place - expected).abs() < 1e-8, "{place} {expected}");
        count += 1;
        if turning <= static_limit {
            break;
        }
        turning -= 2.0 * f;
        time += PI / w;
    }
    assert_eq!(stops.len(), count);
    assert!(count >= 7, "{count}");
    assert!(reader.configuration(4.0).unwrap().rates[0].abs() < 1e-12);
}

/// reference/slider_crank_motion.py: one coordinate, equations of its own, SciPy's DOP853 at a relative
/// tolerance of 1e-13.
#[test]
fn the_slider_crank_agrees_with_an_independent_integration() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../reference/slider-crank-motion.toml"
    ));
    let reference: toml::Table = text.unwrap().parse().unwrap();
    let options = SimulateOptions::new(3.0).tolerance(1e-10);
    let history = history("slider-crank", &[("gas", "0 N"), ("T", "0 N m")], &options);
    assert_eq!(history.end, End::Finished);
    let count = |name: &str| usize::try_from(reference[name].as_integer().unwrap()).unwrap();
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    assert_eq!(stops.len(), count("reversals"));
    let first = reference["first_events"].as_array().unwrap();
    let events: Vec<f64> = history.events[1..].iter().map(|event| event.time).collect();
    for (expected, found) in first.iter().zip(&events) {
        let expected = expected[0].as_float().unwrap();
        assert!((expected - found).abs() < 1e-8, "{expected} {found}");
    }
    let mut reader = history.reader();
    let mut previous = 0.0;
    for sample in reference["sample"].as_array().unwrap() {
        let number = |name: &str| sample[name].as_float().unwrap();
        let time = number("time");
        assert!(time > previous);
        previous = time;
        let configuration = reader.configuration(time).unwrap();
        let phi = configuration.coordinates[0];
        assert!((phi - number("phi")).abs() < 1e-6, "{time}: {phi} {}", number("phi"));
        let omega = configuration.rates[0];
        assert!((omega - number("omega")).abs() < 1e-5, "{time}: {omega} {}", number("omega"));
        let energy = reader.at(time).unwrap().energy;
        let energy = energy.kinetic + energy.potential;
        // The energy of the reference has another zero of height: the same difference at all times.
        assert!((energy - number("energy")).abs() < 1e-5, "{time}: {energy} {}", number("energy"));
    }
}

/// reference/stribeck_belt.py: the block on the belt with friction that falls with the sliding speed, by
/// SciPy's DOP853 at a relative tolerance of 1e-13.
#[test]
fn stick_slip_on_a_falling_friction_curve_agrees_with_an_independent_integration() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/stribeck-belt.toml");
    let reference: toml::Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
    let gallery_model = Model::parse(gallery::find("stribeck-belt").unwrap().text).unwrap();
    for run in reference["run"].as_array().unwrap() {
        let settings = Settings::default().parameter("v", run["belt"].as_float().unwrap().to_string());
        let model = gallery_model.with(&settings).unwrap();
        let options = SimulateOptions::new(4.0).tolerance(1e-10);
        let history = simulate(&model, &options).unwrap();
        assert_eq!(history.end, End::Finished);
        let expected = run["events"].as_array().unwrap();
        assert_eq!(history.events.len() - 1, expected.len(), "{:#?}", words(&history));
        for (event, expected) in history.events[1..].iter().zip(expected) {
            let late = event.time - expected[0].as_float().unwrap();
            assert!(late.abs() < 1e-7, "{late:e} {expected:?}");
            let slips = event.causes.contains(&Cause::Slips);
            assert_eq!(slips, expected[1].as_str().unwrap() == "slips", "{}", event.words);
        }
        let mut reader = history.reader();
        for sample in run["samples"].as_array().unwrap() {
            let [time, x, v] = [0, 1, 2].map(|index| sample[index].as_float().unwrap());
            let found = reader.configuration(time).unwrap();
            let (dx, dv) = (found.coordinates[1] - x, found.rates[1] - v);
            assert!(dx.abs() < 1e-8 && dv.abs() < 1e-7, "{time} {dx:e} {dv:e}");
        }
        assert!(history.energy_error < 1e-8 * history.energy_scale, "{:e}", history.energy_error);
    }
}

/// At a dead centre the piston stands while the crank turns on, however loose the tolerance: nothing may be
/// taken from it.
#[test]
fn a_dead_centre_takes_no_energy_at_any_tolerance() {
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9] {
        let options = SimulateOptions::new(0.2).tolerance(tolerance).longest_step(2e-3);
        let history = history("slider-crank", &[("gas", "0 N"), ("T", "0 N m")], &options);
        assert_eq!(history.end, End::Finished);
        let error = history.energy_error / history.energy_scale;
        assert!(error < 20.0 * tolerance, "{tolerance:e} {error:e}");
        // reference/slider-crank-motion.toml
        let phi = history.reader().configuration(0.2).unwrap().coordinates[0];
        assert!((phi - 22.446_919_530_611).abs() < 100.0 * tolerance, "{tolerance:e} {phi}");
    }
}

/// Whether the bar of the paper's example slides to the left at some time.
fn slides_to_the_left(history: &History) -> bool {
    let mut reader = history.reader();
    let steps = history.times_in_steps(1e-3);
    steps.iter().any(|time| reader.configuration(*time).unwrap().rates[0] < -1e-6)
}

const SLIDING: fn(f64) -> SimulateOptions = |duration| SimulateOptions::new(duration).prefers_sliding(true);

/// To the right with F_30 at the lower end alone the preload is between both faces (theory, section 3). A
/// vertical force V on the bar, growing or falling with time, ends that. With T = tan(alpha), a = T mu_1/2,
/// N = V (1/2, 1/4, 1/4) + sum eta_k F_k and the lever 1/4 of the block's friction (Klepp, 2002, section 6):
/// - `+ - 0`: the preload is at the negative face alone when N_3 = 0 with N_2 = -(F_2 + F_30)/2, F_2 = -mu_2
///   N_2, so that V = (F_2 + F_30) (T - 1 - a)/(1 + 2 a), F_2 = F_30 mu_2/(2 - mu_2);
/// - contact 2 changes side in the gap of contact 3 when N_2 = N_3 = 0: V = T F_30/(1 + 2 a).
#[test]
fn a_preload_gap_is_followed_until_it_closes() {
    let text = gallery::find("klepp-2002-spring").unwrap().text;
    let swinging = "[\"P*sin(2*pi*f*t)\", 0]";
    assert!(text.contains(swinging));
    let model = Model::parse(&text.replace(swinging, "[0, \"-P*t/(1 s)\"]")).unwrap();
    let (t, mu_1, mu_2) = (80.0_f64.to_radians().tan(), 0.24, 0.1);
    let (a, preload) = (t * mu_1 / 2.0, 0.5 * G);
    let closes = preload * (1.0 + mu_2 / (2.0 - mu_2)) * (t - 1.0 - a) / (1.0 + 2.0 * a);
    let changes = t * preload / (1.0 + 2.0 * a);
    for (growth, load, mode) in [(-20.0, closes, "+--"), (20.0, changes, "++0"), (40.0, changes, "++0")] {
        let settings = [("mu_1", "0.24"), ("F_30", "0.5*m*g"), ("k", "0 N/m"), ("c", "0 N s/m")];
        let settings =
            settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
        let settings = settings.parameter("P", format!("{growth} N"));
        let history = simulate(&model.with(&settings).unwrap(), &SimulateOptions::new(0.12)).unwrap();
        let told = words(&history);
        assert_eq!(history.events.len(), 2, "{told:#?}");
        let pattern =
            |event: usize| history.events[event].phase.as_ref().unwrap().pattern(&history.mechanism);
        assert_eq!((pattern(0), pattern(1)), ("+-0".to_owned(), mode.to_owned()), "{told:#?}");
        let event = &history.events[1];
        assert!((event.time - (load - G) / growth).abs() < 1e-9, "{} {told:#?}", (load - G) / growth);
    }
}

/// Klepp (2002), section 7, without preload: moving to the left the example has a solution up to mu_1* = 2
/// cot(80 deg) + 0.1 = 0.45265396. Below it moves to and fro if the force is great enough, and as long as
/// sliding is preferred to wedging. (Friction to the left grows with 1/(mu_1* - mu_1), whatever the force:
/// 114 N at 0.44, 15 kN at mu_1* - 0.0001.)
#[test]
fn the_example_moves_to_and_fro_below_its_locking_value() {
    let below =
        [("0.2", "40 N"), ("0.3", "40 N"), ("0.4", "80 N"), ("0.44", "400 N"), ("0.45255396", "20 kN")];
    for (mu, force) in below {
        let history = history("klepp-2002-spring", &[("mu_1", mu), ("P", force)], &SLIDING(2.0));
        assert_eq!(history.end, End::Finished, "{mu}");
        assert!(slides_to_the_left(&history), "{mu} {:#?}", words(&history));
        assert!(times(&history, |cause| matches!(cause, Cause::Jams { .. })).is_empty(), "{mu}");
    }
}

/// Above mu_1* it stops regularly, and no force brings it back to the left, not even one that does 0.0002
/// below.
#[test]
fn the_example_cannot_start_its_return_stroke_above_its_locking_value() {
    for (mu, force) in [("0.45275396", "20 kN"), ("0.5", "400 N"), ("0.6", "400 N")] {
        let history = history("klepp-2002-spring", &[("mu_1", mu), ("P", force)], &SLIDING(2.0));
        assert_eq!(history.end, End::Finished, "{mu}");
        assert!(!slides_to_the_left(&history), "{mu} {:#?}", words(&history));
        assert!(!times(&history, |cause| matches!(cause, Cause::Stops(_))).is_empty(), "{mu}");
        assert!(times(&history, |cause| matches!(cause, Cause::Jams { .. })).is_empty(), "{mu}");
    }
}

/// Sent to the left above mu_1* it jams at once: all its kinetic energy m v^2/2 = 0.5 J is lost.
#[test]
fn the_example_jams_dynamically_when_it_is_sent_to_the_left() {
    let settings = [("mu_1", "0.6"), ("direction", "-1")];
    let history = history("klepp-2002-spring", &settings, &SimulateOptions::new(1.0));
    let lost = history.events[0].causes.iter().find_map(|cause| match cause {
        Cause::Jams { energy_lost } => Some(*energy_lost),
        _ => None,
    });
    assert!((lost.unwrap() - 0.5).abs() < 1e-12, "{lost:?}");
    assert!(!slides_to_the_left(&history), "{:#?}", words(&history));
}

/// A motion of reference/elastic_guides.py: the example with springs and dampers in place of its guides.
struct Elastic {
    stiffness: f64,
    /// When the lower block begins to slide to the right (1), to the left (-1) or to stick (0).
    lower: Vec<(f64, i64)>,
    /// When contacts change side.
    zeros: Vec<f64>,
    samples: Vec<ElasticSample>,
}

struct ElasticSample {
    time: f64,
    x: f64,
    normal: Vec<f64>,
}

/// The motions of a scenario, for guides of 1e5, 1e6, 1e7 and 1e8 N/m.
fn elastic(scenario: &str) -> Vec<Elastic> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../reference/elastic-guides.toml");
    let reference: toml::Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
    let float = |value: &toml::Value| value.as_float().unwrap();
    let list = |value: &toml::Value| value.as_array().unwrap().clone();
    let sample = |sample: &toml::Value| ElasticSample {
        time: float(&sample["time"]),
        x: float(&sample["x"]),
        normal: list(&sample["normal"]).iter().map(float).collect(),
    };
    let motion = |run: &toml::Value| Elastic {
        stiffness: float(&run["stiffness"]),
        lower: list(&run["lower"])
            .iter()
            .map(|pair| (float(&pair[0]), pair[1].as_integer().unwrap()))
            .collect(),
        zeros: run
            .get("zeros")
            .map_or(Vec::new(), |zeros| list(zeros).iter().map(|pair| float(&pair[0])).collect()),
        samples: list(&run["sample"]).iter().map(sample).collect(),
    };
    let runs = list(&reference["run"]);
    let of_scenario = runs.iter().filter(|run| run["scenario"].as_str() == Some(scenario));
    let motions: Vec<Elastic> = of_scenario.map(motion).collect();
    let stiffness: Vec<f64> = motions.iter().map(|motion| motion.stiffness).collect();
    assert_eq!(stiffness, [1e5, 1e6, 1e7, 1e8]);
    motions
}

/// By which power of the stiffness a difference falls, from each stiffness to the next.
fn orders(differences: &[f64]) -> Vec<f64> {
    differences.windows(2).map(|pair| (pair[0] / pair[1]).abs().log10()).collect()
}

/// The differences of a number from that of rigid guides, for each stiffness.
fn differences(motions: &[Elastic], rigid: f64, number: impl Fn(&Elastic) -> f64) -> Vec<f64> {
    motions.iter().map(|motion| number(motion) - rigid).collect()
}

/// All orders lie within these bounds.
#[track_caller]
fn assert_orders(what: &str, differences: &[f64], from: f64, to: f64) {
    let orders = orders(differences);
    assert!(orders.iter().all(|order| (from..to).contains(order)), "{what}: {orders:?} {differences:?}");
}

/// The example of the elastic guides, moving with this velocity.
fn rigid(settings: &[(&str, &str)], rate: &str, options: SimulateOptions) -> History {
    let all = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model = Model::parse(gallery::find("klepp-2002-spring").unwrap().text).unwrap();
    simulate(&model.with(&all.rate("q", rate)).unwrap(), &options.tolerance(1e-11)).unwrap()
}

/// At a reversal the normal forces jump and change side. On elastic guides that takes a time in proportion to
/// 1/sqrt(stiffness), in which the normal impulse is the rigid one up to 1/stiffness, as the velocities
/// across the guides are; but friction has the integral of |N|, which is another one while N changes its
/// sign. So motions agree to order 1 in 1/stiffness up to the first reversal and to order 1/2 behind it.
/// Normal forces hang on position and velocity hardly at all: of order 1 once the transient is over.
#[test]
fn elastic_guides_converge_over_reversals() {
    let motions = elastic("to and fro");
    let history = rigid(&[("mu_1", "0.2"), ("P", "40 N")], "1 m/s", SLIDING(0.6));
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    assert_eq!(stops.len(), 3);
    for motion in &motions {
        let directions: Vec<i64> = motion.lower.iter().map(|change| change.1).collect();
        assert_eq!(directions, [1, -1, 1, -1]);
    }
    let stop = |index: usize| differences(&motions, stops[index], |motion| motion.lower[index + 1].0);
    assert_orders("first stop", &stop(0), 0.98, 1.02);
    assert_orders("second stop", &stop(1)[1..], 0.48, 0.55);
    assert_orders("third stop", &stop(2)[2..], 0.45, 0.6);
    let mut reader = history.reader();
    for (index, ElasticSample { time, .. }) in motions[0].samples.iter().enumerate() {
        let sample = reader.at(*time).unwrap();
        let place = sample.configuration.coordinates[0];
        let place = differences(&motions, place, |motion| motion.samples[index].x);
        let before = *time < stops[0];
        if before {
            assert_orders(&format!("place at {time} s"), &place, 0.98, 1.02);
        } else {
            assert_orders(&format!("place at {time} s"), &place[2..], 0.4, 0.65);
        }
        for k in 0..3 {
            let force = sample.contacts[k].normal_force;
            let force = differences(&motions, force, |motion| motion.samples[index].normal[k]);
            let what = format!("force {k} at {time} s");
            assert_orders(&what, if before { &force } else { &force[2..] }, 0.9, 1.1);
            assert!(force[3].abs() < 1e-4, "{what}: {force:?}");
        }
    }
}

/// With the force at the lower end contacts change side while they slide on: all of it smooth, so of order 1.
/// (At 1e5 N/m the motion is not yet near the rigid one. At the first change the guides still swing from the
/// start, at the third, 10 ms behind the second, from that one: their times come nearer, but with no order
/// that would be theirs. Normal forces at 0.05 s and 0.09 s are not near a change.)
#[test]
fn elastic_guides_converge_over_changes_of_side() {
    let motions = elastic("force below");
    let text = gallery::find("klepp-2002-spring").unwrap().text;
    let text = text.replacen("at = \"bar.S\"\ncomponents", "at = \"bar.A\"\ncomponents", 1);
    let model = Model::parse(&text).unwrap().with(&Settings::default().parameter("P", "20 N")).unwrap();
    let options = SimulateOptions::new(0.12).tolerance(1e-11);
    let history = simulate(&model, &options).unwrap();
    let changes = times(&history, |cause| matches!(cause, Cause::NormalForceZero(_)));
    assert_eq!(changes.len(), 3, "{:#?}", words(&history));
    // The ends of the lower block change side together.
    assert!(motions[1..].iter().all(|motion| motion.zeros.len() == 4 && motion.lower.len() == 1));
    let change = |index: usize| differences(&motions, changes[index], |motion| motion.zeros[index]);
    assert_orders("change of side 1", &change(1)[1..], 0.9, 1.1);
    for index in [0, 2] {
        let difference = change(index);
        assert!(difference.windows(2).all(|pair| pair[1].abs() < 0.2 * pair[0].abs()), "{difference:?}");
    }
    let mut reader = history.reader();
    for (index, ElasticSample { time, .. }) in motions[0].samples.iter().enumerate() {
        let sample = reader.at(*time).unwrap();
        let place = sample.configuration.coordinates[0];
        let place = differences(&motions, place, |motion| motion.samples[index].x);
        assert_orders(&format!("place at {time} s"), &place[1..], 0.95, 1.06);
        for k in (0..3).filter(|_| [0.05, 0.09].contains(time)) {
            let force = sample.contacts[k].normal_force;
            let force = differences(&motions, force, |motion| motion.samples[index].normal[k]);
            assert_orders(&format!("force {k} at {time} s"), &force[1..], 0.9, 1.1);
        }
    }
}

/// Stops, sticking and starting again. The force to the left is greater than what the normal forces of the
/// stop let friction hold, but less than what friction can hold: the elastic guides creep until the normal
/// forces have grown, by a way in proportion to 1/stiffness. (That of 1e5 N/m is as long as the way on which
/// the bar slides.)
#[test]
fn elastic_guides_converge_over_sticking() {
    let motions = elastic("stick and slip");
    let history = rigid(&[("mu_1", "0.2"), ("P", "1.8 N")], "0.03 m/s", SimulateOptions::new(0.5));
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    let slips = times(&history, |cause| matches!(cause, Cause::Slips));
    assert_eq!((stops.len(), slips.len()), (3, 2), "{:#?}", words(&history));
    let first = differences(&motions, stops[0], |motion| motion.lower[1].0);
    assert_orders("first stop", &first, 0.9, 1.1);
    let mut reader = history.reader();
    for (index, ElasticSample { time, .. }) in motions[0].samples.iter().enumerate() {
        let place = reader.configuration(*time).unwrap().coordinates[0];
        let place = differences(&motions, place, |motion| motion.samples[index].x);
        assert_orders(&format!("place at {time} s"), &place[1..], 0.9, 1.1);
    }
}

/// mu_1 = 0.5: two solutions to the right, of which the elastic guides keep the attainable one until the bar
/// stops. As long as the force then pushes it to the left, up to 0.2 s, they wedge it.
#[test]
fn elastic_guides_keep_the_attainable_solution() {
    let motions = elastic("several solutions");
    let history = rigid(&[("mu_1", "0.5"), ("P", "40 N")], "1 m/s", SimulateOptions::new(0.4));
    let start = &history.events[0];
    assert_eq!((start.successors.len(), start.taken), (2, Some(0)));
    assert_eq!(start.successors[0].verdict, slideway::report::Verdict::Attainable);
    assert_eq!(start.successors[1].verdict, slideway::report::Verdict::Unattainable);
    let stops = times(&history, |cause| matches!(cause, Cause::Stops(_)));
    assert_eq!(stops.len(), 1);
    assert_orders("stop", &differences(&motions, stops[0], |motion| motion.lower[1].0), 0.98, 1.02);
    let mut reader = history.reader();
    let samples = motions[0].samples.iter().enumerate();
    for (index, ElasticSample { time, .. }) in samples.filter(|(_, sample)| sample.time < 0.2) {
        let sample = reader.at(*time).unwrap();
        let place = sample.configuration.coordinates[0];
        let place = differences(&motions, place, |motion| motion.samples[index].x);
        if *time > stops[0] {
            assert!(sample.configuration.rates[0].abs() < 1e-12);
            assert_orders(&format!("place at {time} s"), &place[1..], 0.9, 1.1);
            continue;
        }
        assert_orders(&format!("place at {time} s"), &place, 0.98, 1.02);
        for k in 0..3 {
            let force = sample.contacts[k].normal_force;
            let force = differences(&motions, force, |motion| motion.samples[index].normal[k]);
            assert_orders(&format!("force {k} at {time} s"), &force, 0.9, 1.1);
        }
    }
}

/// When the force turns back to the right, slideway's bar stays: some distribution of the normal forces can
/// hold it. That of the elastic guides has been relieved by then, and they let it slide to the right, the
/// stiffer ones too. This is what the book says of joints that stick.
#[test]
fn elastic_guides_let_go_where_static_friction_could_hold() {
    let motions = elastic("several solutions");
    let history = rigid(&[("mu_1", "0.5"), ("P", "40 N")], "1 m/s", SimulateOptions::new(0.4));
    let place = history.reader().configuration(0.3).unwrap().coordinates[0];
    let index = motions[0].samples.iter().position(|sample| sample.time == 0.3).unwrap();
    let moved = differences(&motions, place, |motion| motion.samples[index].x);
    assert!(moved[1..].iter().all(|moved| *moved > 0.015), "{moved:?}");
}

/// Started with a fifth of the way from the unattainable solution to the attainable one, stiff guides settle
/// on the latter; started as far on the other side they stop the bar as if it were stuck, the sooner the
/// stiffer they are.
#[test]
fn the_unattainable_solution_is_the_threshold_of_jamming() {
    let history = rigid(&[("mu_1", "0.5"), ("P", "0 N")], "1 m/s", SimulateOptions::new(0.05));
    let sample = history.reader().at(0.05).unwrap();
    let (inside, outside) =
        (elastic("beside the threshold, inside"), elastic("beside the threshold, outside"));
    for motion in &inside[1..] {
        assert_eq!(motion.lower.len(), 1, "it slides on");
        let last = motion.samples.last().unwrap();
        for (found, contact) in last.normal.iter().zip(&sample.contacts) {
            assert!((found - contact.normal_force).abs() < 1e-4, "{found} {}", contact.normal_force);
        }
    }
    let stops: Vec<f64> = outside.iter().map(|motion| motion.lower[1].0).collect();
    // Forces grow exponentially on the scale 1/sqrt(stiffness): order 1/2, less for a logarithm.
    assert_orders("time of the jam", &stops, 0.1, 0.5);
}

/// Sent to the left with mu_1 = 0.5 there is no solution: the elastic guides stop the bar from 1 m/s within a
/// time that falls with the stiffness, where slideway has an impulse.
#[test]
fn elastic_guides_jam_dynamically() {
    let motions = elastic("sent to the left");
    let settings = [("mu_1", "0.5"), ("P", "40 N")];
    let history = rigid(&settings, "-1 m/s", SimulateOptions::new(0.05));
    assert!(matches!(history.events[0].causes.last(), Some(Cause::Jams { .. })), "{:#?}", words(&history));
    assert_eq!(history.reader().configuration(0.05).unwrap().coordinates[0], 0.0);
    let stops: Vec<f64> = motions.iter().map(|motion| motion.lower[1].0).collect();
    // Forces grow exponentially on the scale 1/sqrt(stiffness): order 1/2, less for a logarithm.
    assert_orders("stop", &stops, 0.25, 0.5);
    assert!(stops[3] < 3e-3, "{stops:?}");
}

/// mu_1 = 0.35: when the bar stops it can wedge itself or slide back. Elastic guides, which come from sliding
/// with the forces of sliding, slide back, as `--prefer sliding` does.
#[test]
fn elastic_guides_slide_back_where_the_bar_could_wedge_itself() {
    let motions = elastic("wedge or slide");
    let settings = [("mu_1", "0.35"), ("P", "40 N")];
    let sliding = rigid(&settings, "1 m/s", SLIDING(0.3));
    let sticking = rigid(&settings, "1 m/s", SimulateOptions::new(0.3));
    let stop = sticking.events[1].time;
    assert_eq!(sticking.events[1].successors.len(), 2);
    for motion in &motions {
        assert_eq!(motion.lower[1].1, -1);
    }
    assert_orders("stop", &differences(&motions, stop, |motion| motion.lower[1].0), 0.9, 1.1);
    let mut reader = sliding.reader();
    for index in [1, 2] {
        let time = motions[0].samples[index].time;
        let place = reader.configuration(time).unwrap().coordinates[0];
        let place = differences(&motions, place, |motion| motion.samples[index].x);
        assert_orders(&format!("place at {time} s"), &place[1..], 0.4, 1.0);
    }
}

/// A brake written as a load, against none, and against one that follows the time or the place: only the
/// first is friction.
#[test]
fn a_load_that_jumps_with_a_rate_gets_a_hint() {
    let hints = |force: &str| {
        let text = gallery::find("frictional-oscillator").unwrap().text;
        let load =
            format!("[loads.brake]\ntype = \"force\"\nat = \"block.S\"\ncomponents = [\"{force}\", 0]\n");
        let model = Model::parse(&format!("{text}\n{load}")).unwrap();
        let options = SimulateOptions::new(0.01);
        slideway::motion::report(&simulate(&model, &options).unwrap(), &options).hints
    };
    let [hint] = hints("-2 N * sign(rate(x))").try_into().unwrap();
    assert!(hint.starts_with("brake jumps where a rate passes zero"), "{hint}");
    for other in ["-2 N * abs(rate(x)) / (1 m/s)", "-2 N * sign(x)", "-2 N * sign(t - 0.5 s)"] {
        assert_eq!(hints(other), Vec::<String>::new(), "{other}");
    }
}

/// A block of 1 kg, 0.2 m long, that 1 N does not move. Flat on its guide, with friction at the face h/2
/// below the line of the pull, which turns it forwards: N = W/2 +- F h/(2 L). Held by a weight beyond its end
/// it is tipped; there the friction is shared between a lower and an upper face, and with a height the normal
/// forces hang on how.
#[test]
fn what_statics_leaves_open_is_empty_in_tables() {
    let forces = |height: &str, arm: &str, weight: &str| {
        let text = format!(
            r#"
[points]
A = [0, 0]
H = ["{arm}", 0]
[bodies.block]
points = ["A", "H"]
mass = 1
moment_of_inertia = 0.01
centre_of_mass = "A"
[joints.guide]
type = "block_slider"
block = "block"
at = "A"
along = 0
length = 0.2
height = "{height}"
mu = 0.4
[loads.weight]
type = "force"
at = "block.H"
components = [0, "-{weight}"]
[loads.pull]
type = "force"
at = "block.A"
components = ["1 N", 0]
[coordinates.x]
slide = "guide"
"#
        );
        let history = simulate(&Model::parse(&text).unwrap(), &SimulateOptions::new(0.1)).unwrap();
        let series = history.series(&[0.05]);
        assert_eq!(series.modes, ["=="], "{text}");
        ["front", "rear"].map(|end| series.column(&format!("guide.{end}.normal_force")).unwrap().values[0])
    };
    let [front, rear] = forces("0.1 m", "0 m", "10 N").map(Option::unwrap);
    assert!((front - 5.25).abs() < 1e-12 && (rear - 4.75).abs() < 1e-12, "{front} {rear}");
    // With the weight 0.3 m before the middle: N_front (0.1 m) - N_rear (0.1 m) = 0.3 m W, N_front + N_rear =
    // W.
    let [front, rear] = forces("0 m", "0.3 m", "30 N").map(Option::unwrap);
    assert!((front - 60.0).abs() < 1e-10 && (rear + 30.0).abs() < 1e-10, "{front} {rear}");
    assert_eq!(forces("0.1 m", "0.3 m", "30 N"), [None; 2]);
}

/// Two pads without friction in their guides press on a capsule that sticks to both, from an independent review.
#[test]
fn at_rest_guides_without_friction_slide_nowhere() {
    let model = Model::parse(include_str!("findings/pinched_capsule.toml")).unwrap();
    let history = simulate(&model, &SimulateOptions::new(1.0)).unwrap();
    assert_eq!(history.end, End::Finished);
    // Of guides without friction nothing is told.
    assert_eq!(words(&history), ["0 pl sticks; pr sticks"]);
}

/// A block of 1 kg that a cart pulls through a spring of 100 N/m, at 50 mm/s (a model of an independent review). While it
/// sticks its friction is the pull of the spring, k v t: 1, 2 and 3 N at 0.2, 0.4 and 0.6 s, until mu_static W = 3.924 N.
/// It slides with mu W.
#[test]
fn friction_of_what_sticks_is_known_where_statics_determines_it() {
    let model = Model::parse(include_str!("findings/block_pulled_through_a_spring.toml")).unwrap();
    let history = simulate(&model, &SimulateOptions::new(1.0)).unwrap();
    let series = history.series(&[0.2, 0.4, 0.6, 0.9]);
    assert_eq!(series.modes, ["=+", "=+", "=+", "++"]);
    let friction = &series.column("floor.friction_force").unwrap().values;
    for (found, expected) in friction.iter().zip([1.0, 2.0, 3.0, 0.2 * G]) {
        assert!((found.unwrap() - expected).abs() < 1e-9, "{friction:?}");
    }
    // At rest with one end on each side of its guide, the block leaves open how these share its friction.
    let text = include_str!("findings/block_pulled_through_a_spring.toml");
    let text = text.replacen("guided_slider", "block_slider", 1);
    let history = simulate(&Model::parse(&text).unwrap(), &SimulateOptions::new(0.4)).unwrap();
    let series = history.series(&[0.2]);
    assert_eq!(series.modes, ["==+"]);
    for end in ["front", "rear"] {
        assert_eq!(series.column(&format!("floor.{end}.friction_force")).unwrap().values, [None]);
    }
}
