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

/// With w^2 = k/m the block is at u = x - mu g/w^2. It sticks from u = -d to u = d, d = (mu_static - mu) g/w^2, at the speed v
/// of the belt: 2 d/v. Then u'' = -w^2 u from (d, v) until u' = v again, at u = -d: (2/w) (pi - atan(w d/v)).
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

/// With w^2 = k/m and f = mu m g/k: sliding in the direction s it swings about -s f. From x = 0 with v_0 it reaches
/// x_1 = -f + sqrt(f^2 + v_0^2/w^2) after atan2(v_0/w, f)/w; each further half cycle lasts pi/w and ends 2 f nearer. It stays at the first
/// turning point within mu_static m g/k.
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

/// reference/slider_crank_motion.py: one coordinate, equations of its own, SciPy's DOP853 at a relative tolerance of 1e-13.
#[test]
fn the_slider_crank_agrees_with_an_independent_integration() {
    let text = std::fs::read_to_string(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../reference/slider-crank-motion.toml"
    ));
    let reference: toml::Table = text.unwrap().parse().unwrap();
    let options = SimulateOptions { tolerance: 1e-10, ..SimulateOptions::new(3.0) };
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

/// At a dead centre the piston stands while the crank turns on, however loose the tolerance: nothing may be taken from it.
#[test]
fn a_dead_centre_takes_no_energy_at_any_tolerance() {
    for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-9] {
        let options = SimulateOptions { tolerance, longest_step: Some(2e-3), ..SimulateOptions::new(0.2) };
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

const SLIDING: fn(f64) -> SimulateOptions =
    |duration| SimulateOptions { prefers_sliding: true, ..SimulateOptions::new(duration) };

/// Klepp (2002), section 7, without preload: moving to the left the example has a solution up to mu_1* = 2 cot(80 deg) + 0.1 =
/// 0.45265396. Below it moves to and fro if the force is great enough, and as long as sliding is preferred to wedging. (Friction
/// to the left grows with 1/(mu_1* - mu_1), whatever the force: 114 N at 0.44, 15 kN at mu_1* - 0.0001.)
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

/// Above mu_1* it stops regularly, and no force brings it back to the left, not even one that does 0.0002 below.
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

/// The example with springs in place of its guides, written from scratch: A, the angles of bar and block, and their rates.
struct SpringGuides {
    stiffness: f64,
    mu: [f64; 3],
    force: f64,
    frequency: f64,
}

impl SpringGuides {
    /// Of the block; the model has none, but springs turn the block.
    const INERTIA: f64 = 2e-4;
    const STEP: f64 = 4e-6;

    /// Damping relative to the stiffness (s): what moves on the guides comes to rest within about 1/sqrt(stiffness).
    fn delay(&self) -> f64 {
        1.0 / self.stiffness.sqrt()
    }

    /// The displacement of A after this time, from 1 m/s to the right with the springs in equilibrium at these forces.
    fn displacement(&self, duration: f64, start: [f64; 3]) -> f64 {
        let (sin, _) = 80_f64.to_radians().sin_cos();
        let gaps = start.map(|force| -force / self.stiffness);
        let (y, tilt) = (f64::midpoint(gaps[1], gaps[2]), (gaps[1] - gaps[2]) / 0.2);
        let mut state = [0.0, y, (sin + gaps[0] - y).asin(), tilt, 1.0, 0.0, 0.0, 0.0];
        let mut time = 0.0;
        while time < duration - 0.5 * Self::STEP {
            let moved =
                |rate: &[f64; 8], by: f64| -> [f64; 8] { std::array::from_fn(|i| state[i] + by * rate[i]) };
            let half = Self::STEP / 2.0;
            let one = self.rates(time, &state);
            let two = self.rates(time + half, &moved(&one, half));
            let three = self.rates(time + half, &moved(&two, half));
            let four = self.rates(time + Self::STEP, &moved(&three, Self::STEP));
            state = std::array::from_fn(|i| {
                state[i] + Self::STEP / 6.0 * (one[i] + 2.0 * (two[i] + three[i]) + four[i])
            });
            time += Self::STEP;
        }
        state[0]
    }

    fn rates(&self, time: f64, state: &[f64; 8]) -> [f64; 8] {
        let [x, y, angle, tilt, x_rate, y_rate, turning, tilting] = *state;
        let (sin, cos) = angle.sin_cos();
        let spring = |gap: f64, rate: f64| -self.stiffness * (gap + self.delay() * rate);
        let end = |half: f64| spring(y + half * tilt.sin(), y_rate + half * tilt.cos() * tilting);
        let normal =
            [spring(y + sin - 80_f64.to_radians().sin(), y_rate + cos * turning), end(0.1), end(-0.1)];
        let slides = [x_rate - sin * turning, x_rate, x_rate];
        let friction: [f64; 3] = std::array::from_fn(|k| -self.mu[k] * normal[k].abs() * slides[k].signum());
        // Spring and damper between S and the wall 2 m to its left, and the force at S.
        let (s0, c0) = 80_f64.to_radians().sin_cos();
        let to_s = [x + cos / 2.0 - (c0 / 2.0 - 2.0), y + sin / 2.0 - s0 / 2.0];
        let length = to_s[0].hypot(to_s[1]);
        let velocity = [x_rate - sin / 2.0 * turning, y_rate + cos / 2.0 * turning];
        let stretching = (to_s[0] * velocity[0] + to_s[1] * velocity[1]) / length;
        let tension = 100.0 * (length - 2.0) + stretching;
        let push = self.force * (2.0 * PI * self.frequency * time).sin();
        let at_s = [push - tension * to_s[0] / length, -G - tension * to_s[1] / length];
        // m x'' - m l/2 sin a'' = X, m y'' + m l/2 cos a'' = Y, m l/2 (cos y'' - sin x'') + m l^2/3 a'' = moment about A
        let force_x = friction.iter().sum::<f64>() + at_s[0] + cos / 2.0 * turning * turning;
        let force_y = normal.iter().sum::<f64>() + at_s[1] + sin / 2.0 * turning * turning;
        let on_bar = cos * normal[0] - sin * friction[0] + (cos * at_s[1] - sin * at_s[0]) / 2.0;
        let on_block: f64 = [(1, 0.1), (2, -0.1)]
            .iter()
            .map(|&(k, x): &(usize, f64)| x * normal[k] + normal[k].signum() * 0.05 * friction[k])
            .sum();
        let turn = (on_bar - (cos * force_y - sin * force_x) / 2.0) / (1.0 / 3.0 - 0.25);
        let x = force_x + sin / 2.0 * turn;
        let y = force_y - cos / 2.0 * turn;
        [x_rate, y_rate, turning, tilting, x, y, turn, on_block / Self::INERTIA]
    }
}

/// Guides that are springs come nearer to the rigid ones as they get stiffer, over a reversal with a change of side: what is
/// lost there lasts as long as the springs take, in proportion to 1/sqrt(stiffness) at most.
#[test]
fn stiff_guides_converge_to_the_rigid_mechanism() {
    let settings = [("mu_1", "0.2"), ("P", "40 N"), ("f", "5 Hz")];
    let history = history("klepp-2002-spring", &settings, &SLIDING(0.3));
    let mut reader = history.reader();
    let start: Vec<f64> =
        reader.at(0.0).unwrap().contacts.iter().map(|contact| contact.normal_force).collect();
    let rigid = reader.configuration(0.3).unwrap().coordinates[0];
    assert!(rigid < reader.configuration(0.15).unwrap().coordinates[0], "it is on its way back");
    let difference = |stiffness: f64| {
        let guides = SpringGuides { stiffness, mu: [0.2, 0.1, 0.1], force: 40.0, frequency: 5.0 };
        (guides.displacement(0.3, [start[0], start[1], start[2]]) - rigid).abs()
    };
    let differences = [1e4, 1e5, 1e6, 1e7].map(difference);
    for pair in differences.windows(2) {
        assert!(pair[1] < 0.4 * pair[0], "{differences:?}");
    }
    assert!(differences[3] < 1e-4, "{differences:?}");
}
