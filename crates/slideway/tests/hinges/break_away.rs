//! Joints that break away while hinges with friction turn (models of an independent review), against closed forms and an
//! independent integration.

use serde::Deserialize;
use slideway::motion::{Cause, End, History, SimulateOptions, simulate};
use slideway::{Model, Settings};

const FALLS: &str = include_str!("../findings/pin_jam.toml");
const FALLS_ROUGHER_AT_REST: &str = include_str!("../findings/pin_jams.toml");
const PUSHED: &str = include_str!("../findings/pin_c.toml");
const TIPPED: &str = include_str!("../findings/motion_tipstick.toml");

/// A run of `reference/break-away.toml`.
#[derive(Deserialize)]
struct Reference {
    name: String,
    /// Time (s), "rail" or "pin", and whether it "sticks" or goes to the "right" or "left".
    events: Vec<(f64, String, String)>,
    /// Time, displacement of the cart, angle of the body, and their rates.
    end: [f64; 5],
}

#[derive(Deserialize)]
struct References {
    run: Vec<Reference>,
}

fn moved(text: &str, settings: &[(&str, &str)], duration: f64) -> History {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model = Model::parse(text).unwrap().with(&settings).unwrap();
    let history = simulate(&model, &SimulateOptions::new(duration).tolerance(1e-10)).unwrap();
    assert_eq!(history.end, End::Finished, "{:#?}", history.events);
    assert!(history.energy_error <= 1e-9 * history.energy_scale, "{:e}", history.energy_error);
    history
}

/// Compares a motion with the run of this name.
fn compare(run: &str, text: &str, settings: &[(&str, &str)]) {
    let references = include_str!("../../../../reference/break-away.toml");
    let references: References = toml::from_str(references).unwrap();
    let reference = references.run.iter().find(|reference| reference.name == run).unwrap();
    let Reference { name, events, end } = reference;
    let history = moved(text, settings, end[0]);
    let found: Vec<f64> = history.events[1..].iter().map(|event| event.time).collect();
    assert_eq!(found.len(), events.len(), "{name}: {:#?}", history.events);
    for (event, (time, what, does)) in history.events[1..].iter().zip(events) {
        assert!((event.time - time).abs() < 1e-7, "{name}: {} {time}", event.time);
        let phase = event.phase.as_ref().unwrap();
        let state = if what == "rail" { phase.joints[0] } else { phase.hinges[0].state };
        let expected = match does.as_str() {
            "sticks" => slideway::motion::JointPhase::Sticking,
            "right" => slideway::motion::JointPhase::Sliding(1.0),
            _ => slideway::motion::JointPhase::Sliding(-1.0),
        };
        assert_eq!(state, expected, "{name} at {time}");
    }
    let last = history.reader().at(end[0]).unwrap().configuration.clone();
    let found = [last.coordinates[0], last.coordinates[1], last.rates[0], last.rates[1]];
    for (found, expected) in found.iter().zip(&end[1..]) {
        assert!((found - expected).abs() < 1e-6, "{name}: {found} {expected}");
    }
}

/// A body on a rough pin falls while its cart sticks, which then breaks away.
#[test]
fn a_cart_breaks_away_beside_a_rough_pin() {
    compare("falls", FALLS, &[]);
    compare("falls, static friction 1.1 times the kinetic", FALLS_ROUGHER_AT_REST, &[]);
}

/// The cart is pushed until it slides, and the body then turns.
#[test]
fn a_cart_that_is_pushed_breaks_away_beside_a_rough_pin_at_rest() {
    compare("pushed", PUSHED, &[("F", "6 N/s")]);
}

/// While the cart of 1 kg sticks and a bob of 1 kg rests on its rough pin, 30 mm beside it, statics determines everything:
/// the rail carries both weights and holds against the push of 6 N/s t, the pin carries the bob and its moment.
#[test]
fn statics_determines_the_forces_beside_a_rough_pin_at_rest() {
    let series = moved(PUSHED, &[("F", "6 N/s")], 0.5).series(&[0.25, 0.5]);
    let weight = 9.81;
    for (row, time) in [0.25, 0.5].into_iter().enumerate() {
        let expected = [
            ("rail.normal_force", 2.0 * weight),
            ("rail.friction_force", 6.0 * time),
            ("pin.force", weight),
            ("pin.couple", 0.03 * weight),
        ];
        for (name, expected) in expected {
            let found = series.column(name).unwrap().values[row];
            assert!(
                found.is_some_and(|found| (found - expected).abs() < 1e-9),
                "{name}: {found:?} {expected}"
            );
        }
    }
}

/// While a bob turns on its rough pin and the cart sticks, the rail carries what accelerates both: `N = (m + m) g + m a_y`
/// and `F = -m a_x` with the acceleration of the bob, of a cart that stands still.
#[test]
fn statics_determines_the_forces_beside_a_rough_pin_that_turns() {
    let history = moved(FALLS, &[], 0.05);
    let mechanism = &history.mechanism;
    let (cart, bob) = (mechanism.bodies[0].mass, mechanism.bodies[1].mass);
    let mut reader = history.reader();
    for time in [0.0, 0.02, 0.04] {
        let sample = reader.at(time).unwrap();
        let [normal, friction] = history.forces(&sample)[0];
        let [x, y, _] = sample.accelerations[1];
        assert!(sample.hinges[0].spin != 0.0 || time == 0.0);
        let expected = [(cart + bob) * 9.81 + bob * y, -bob * x];
        for (found, expected) in [normal, friction].into_iter().zip(expected) {
            assert!(
                found.is_some_and(|found| (found - expected).abs() < 1e-8),
                "{time}: {found:?} {expected}"
            );
        }
    }
}

/// A block of 1 kg sticks on a guide of 100 mm and is pushed with 4 N/s t, 200 mm above it; from its rough pin hangs another
/// 1 kg at rest. It tips when `4 N/s t 200 mm = 2 kg g 50 mm`.
#[test]
fn a_guided_slider_with_a_rough_pin_at_rest_tips() {
    let text = format!(
        "{}\n[bodies.bob]\npoints = [\"P\", \"G\"]\nmass = 1\ncentre_of_mass = \"G\"\nmoment_of_inertia = 0.02\n\
         [joints.pin]\ntype = \"hinge\"\nbetween = [\"bob.P\", \"b.P\"]\nfriction_radius = \"5 mm\"\n",
        TIPPED.replace("P=[0,0]", "P=[0,0]\nG=[0,-0.3]") + "[coordinates.th]\nrotation = \"bob\"\n"
    );
    let history = simulate(&Model::parse(&text).unwrap(), &SimulateOptions::new(2.0)).unwrap();
    assert!(matches!(history.end, End::Tips(_)), "{:?}", history.end);
    assert!((history.stop() - 1.25).abs() < 1e-9, "{}", history.stop());
}

/// The body is turned until its pin slips; the cart stays.
#[test]
fn a_body_that_is_turned_breaks_away() {
    compare("turned", PUSHED, &[("T", "2 N*m/s")]);
}

/// A block of 2 kg on a level rail, mu = 0.3, beside a pendulum on a rough pin: pulled with 6 N/s t + 0.2 N sin(30 t) it
/// breaks away when that is 0.3 m g.
#[test]
fn a_block_breaks_away_beside_an_unrelated_pendulum() {
    let history = moved(include_str!("../findings/indep0.toml"), &[], 2.0);
    let pull = |t: f64| 6.0 * t + 0.2 * (30.0 * t).sin() - 0.3 * 2.0 * 9.81;
    // It rises from 1.008 s on, where it has its last minimum, and is positive at 1.1 s.
    let mut ends = [1.008, 1.1];
    while ends[1] - ends[0] > 1e-13 {
        let middle = f64::midpoint(ends[0], ends[1]);
        ends[usize::from(pull(middle) > 0.0)] = middle;
    }
    let slips: Vec<f64> = history
        .events
        .iter()
        .filter(|event| event.causes.contains(&Cause::Slips))
        .map(|event| event.time)
        .collect();
    assert!((slips[0] - ends[0]).abs() < 1e-9, "{slips:?} {ends:?}");
    assert_eq!(history.statistics.sampled, 0.0, "the block's rest is proven as without the pendulum");
}

/// A block of 2 kg comes to rest after a stop, on an incline of 30 degrees with mu = 0.1, and is pushed up with 8 N/s t until
/// that is `m g (sin 30 + mu cos 30)`.
#[test]
fn a_block_that_came_to_rest_after_a_stop_breaks_away() {
    let history = moved(include_str!("../findings/stop_pin.toml"), &[], 2.0);
    let expected = 2.0 * 9.81 * (0.5 + 0.1 * 0.75_f64.sqrt()) / 8.0;
    let slips = history.events.iter().find(|event| event.causes.contains(&Cause::Slips)).unwrap();
    assert!((slips.time - expected).abs() < 1e-9, "{} {expected}", slips.time);
}
