//! Motions that begin in a preload gap beside hinges with friction.

use slideway::motion::{End, History, SimulateOptions, simulate};
use slideway::{Model, Settings, solve};

const ONE_PIN: &str = include_str!("../findings/gap_motion_one_pin.toml");
const THREE_PINS: &str = include_str!("../findings/gap_motion_three_pins.toml");
const DURATION: f64 = 0.001;

fn model(text: &str) -> Model {
    Model::parse(text).unwrap().with(&Settings::default().parameter("P", "-0.125")).unwrap()
}

fn moved(model: &Model) -> History {
    let history = simulate(model, &SimulateOptions::new(DURATION)).unwrap();
    assert_eq!(history.end, End::Finished, "{:#?}", history.events);
    history
}

/// The mode in which a motion begins, and coordinates and rates at its end.
fn begins(model: &Model) -> (String, Vec<f64>) {
    let mechanism = slideway::mechanism::Mechanism::new(model).unwrap();
    let history = moved(model);
    let mode = history.events[0].phase.as_ref().unwrap().pattern(&mechanism);
    let last = history.reader().at(DURATION).unwrap().configuration.clone();
    (mode, last.coordinates.into_iter().chain(last.rates).collect())
}

/// A pin of 1 um changes the motion as little as it should: the model without its friction begins in the gap, too, and what a
/// slider-crank does is continuous in the pin's radius.
#[test]
fn a_motion_begins_in_a_gap_beside_a_fine_pin_as_without_its_friction() {
    let smooth = ONE_PIN.replace("radius = 1e-6\nmu = 0.1\n", "");
    let (expected, without) = begins(&model(&smooth));
    let (found, with) = begins(&model(ONE_PIN));
    assert!(expected.starts_with("0+") && found.starts_with("0+"), "{expected} {found}");
    for (found, expected) in with.iter().zip(&without) {
        assert!((found - expected).abs() < 1e-6 * expected.abs().max(1.0), "{with:?} {without:?}");
    }
}

/// The motion begins in the state in the gap that `solve` finds, which is the only one.
#[test]
fn a_motion_begins_in_a_gap_beside_three_pins() {
    let model = model(THREE_PINS);
    let report = solve(&model).unwrap();
    assert!(report.solutions.is_empty(), "{}", report.solutions.len());
    let [gap] = report.preload_gap_states.as_slice() else { panic!("{}", report.preload_gap_states.len()) };
    let (mode, _) = begins(&model);
    assert!(mode.starts_with(&gap.patterns[0].replace(' ', "")), "{mode} {:?}", gap.patterns);
}
