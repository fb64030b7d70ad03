//! Motions of random mechanisms against `reference/motion`: a simulator of rigid bodies with equations of its
//! own, and closed forms.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use serde_json::Value;
use slideway::model::{Model, Settings};
use slideway::motion::{End, History, JointPhase, SimulateOptions, simulate};
use std::path::Path;

/// Relative error of each step; the reference has 1e-12.
const TOLERANCE: f64 = 1e-10;

/// Greatest difference of times (s), places (m) and rates (m/s) from the reference, which errs by 1e-11: with
/// steps of a 250th of the time (four times the usual ones, so that the test is short) a rate of one of the
/// chains differs by 1.2e-8.
const AGREEMENT: f64 = 1e-7;

/// A family of the reference: a model, and the numbers and the motion of each of its members.
struct Family {
    name: &'static str,
    model: Model,
    motions: Vec<Value>,
}

/// A file of the reference, and the model that it is about.
fn read(name: &str) -> (Value, Model) {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../reference/motion");
    let text = std::fs::read_to_string(directory.join(format!("{name}.json"))).unwrap();
    let data: Value = serde_json::from_str(&text).unwrap();
    let model = format!("models/{}.toml", data["model"].as_str().unwrap());
    let model = Model::parse(&std::fs::read_to_string(directory.join(model)).unwrap()).unwrap();
    (data, model)
}

/// The model with the numbers of a member.
fn with_parameters(model: &Model, member: &Value) -> Model {
    let parameters = member["parameters"].as_object().unwrap();
    let settings = parameters
        .iter()
        .fold(Settings::default(), |all, (name, value)| all.parameter(name, value.to_string()));
    model.with(&settings).unwrap()
}

impl Family {
    fn read(name: &'static str) -> Self {
        let (data, model) = read(name);
        Self { name, model, motions: data["motions"].as_array().unwrap().clone() }
    }

    /// Compares members with the reference; those that it leaves out are passed over (its README says why).
    fn agrees(&self, members: impl Iterator<Item = usize>) {
        let mut compared = 0;
        for index in members {
            let motion = &self.motions[index];
            if motion.get("left_out").is_none() {
                self.compare(motion);
                compared += 1;
            }
        }
        assert!(compared > 0, "{}", self.name);
    }

    fn compare(&self, motion: &Value) {
        let what = format!("{} {}", self.name, motion["seed"]);
        let model = with_parameters(&self.model, motion);
        let until = motion["until"].as_f64().unwrap();
        let longest_step = Some(until / 250.0);
        let options = SimulateOptions::new(until).tolerance(TOLERANCE).longest_step(longest_step);
        let history = simulate(&model, &options).unwrap();
        assert_eq!(history.end, End::Finished, "{what}");
        let expected: Vec<Vec<(f64, String)>> = serde_json::from_value(motion["joints"].clone()).unwrap();
        let found = changes(&history);
        let states = |joints: &[Vec<(f64, String)>]| -> Vec<Vec<String>> {
            joints.iter().map(|changes| changes.iter().map(|(_, state)| state.clone()).collect()).collect()
        };
        assert_eq!(states(&found), states(&expected), "{what}: {found:?} {expected:?}");
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found.0 - expected.0).abs() < AGREEMENT, "{what}: {found:?} {expected:?}");
        }
        let last: Vec<(f64, f64)> = serde_json::from_value(motion["last"].clone()).unwrap();
        let mut reader = history.reader();
        let end = reader.configuration(until).unwrap();
        assert_eq!(end.coordinates.len(), last.len());
        for ((place, rate), expected) in end.coordinates.iter().zip(&end.rates).zip(&last) {
            assert!((place - expected.0).abs() < AGREEMENT, "{what}: {place} {expected:?}");
            assert!((rate - expected.1).abs() < AGREEMENT, "{what}: {rate} {expected:?}");
        }
    }
}

/// When each joint begins to do something else, and what: it sticks, or slides with its contacts on these
/// sides.
fn changes(history: &History) -> Vec<Vec<(f64, String)>> {
    let joints = history.phases[0].phase.joints.len();
    let mut found = vec![Vec::<(f64, String)>::new(); joints];
    for interval in &history.phases {
        let pattern = interval.phase.pattern(&history.mechanism);
        for (joint, changes) in found.iter_mut().enumerate() {
            let sides = &pattern[2 * joint..2 * joint + 2];
            let state = match interval.phase.joints[joint] {
                JointPhase::Sticking => "=".to_owned(),
                JointPhase::Sliding(direction) => {
                    format!("{}{sides}", if direction > 0.0 { '>' } else { '<' })
                }
            };
            if changes.last().is_none_or(|last| last.1 != state) {
                changes.push((interval.from, state));
            }
        }
    }
    found
}

/// A dozen members of a family.
fn dozen(name: &'static str) {
    Family::read(name).agrees(0..12);
}

/// All members of a family.
fn all(name: &'static str) {
    let family = Family::read(name);
    family.agrees(0..family.motions.len());
}

/// Harmonic loads with mu_static > mu, loads high above the guides, so that blocks tip onto opposite faces.
#[test]
fn uncoupled_blocks() {
    dozen("blocks");
}

/// Springs and dampers between them; loads that swing and loads that jump.
#[test]
fn blocks_in_a_row() {
    dozen("chain");
}

/// Coupled by inertia.
#[test]
fn a_block_on_a_cart() {
    dozen("cart-1");
}

/// Coupled by inertia, and with more joints at rest at a time.
#[test]
fn two_blocks_on_a_cart() {
    dozen("cart-2");
}

/// Centrifugal and Coriolis forces.
#[test]
fn a_sleeve_on_a_swinging_arm() {
    dozen("arm");
}

/// Closed form: `reference/motion/closed_forms.py`, `rest`.
#[test]
fn five_blocks_come_to_rest_one_after_another() {
    dozen("rest");
}

/// Closed form: `square`. Every jump of the load is a time of its own.
#[test]
fn square_waves() {
    dozen("square");
}

/// Closed form: `limit`. Friction holds a load that just reaches it, also where the limit of an inclined
/// guide is rounded.
#[test]
fn loads_exactly_at_the_limit() {
    dozen("limit");
}

/// Closed form: `drawer`. No force at the start.
#[test]
fn drawers_under_loads_that_grow_from_zero() {
    all("drawer");
}

/// `reference/motion/elastic.py`: a cart stops while a block on it rests, and both can stick, or the cart
/// turns back at once. With a damping of sqrt(K m) across the guides the normal forces swing so far after the
/// stop that the cart is let go, within a time of order 1/sqrt(K): elastic guides come to the phase of
/// `prefers_sliding`, with order 1/2 in 1/K. With six times that damping they come to the one of the rule; at
/// these stiffnesses with no order that would be theirs.
#[test]
fn elastic_guides_take_either_phase() {
    let (data, model) = read("elastic");
    let model = with_parameters(&model, &data);
    let until = data["until"].as_f64().unwrap();
    for (damping, prefers_sliding, orders_within) in [(1.0, true, 0.4..0.6), (6.0, false, 0.6..1.4)] {
        let options = SimulateOptions::new(until).tolerance(TOLERANCE).prefers_sliding(prefers_sliding);
        let history = simulate(&model, &options).unwrap();
        assert_eq!(history.end, End::Finished);
        let rail = &changes(&history)[0];
        assert_eq!(rail.iter().any(|change| change.1 == "="), !prefers_sliding, "{rail:?}");
        let mut reader = history.reader();
        let place = reader.configuration(until).unwrap().coordinates[0];
        let runs = data["runs"].as_array().unwrap().iter();
        let runs = runs.filter(|run| run["damping"].as_f64() == Some(damping));
        let differences: Vec<(f64, f64)> = runs
            .map(|run| (run["stiffness"].as_f64().unwrap(), run["last"][0][0].as_f64().unwrap() - place))
            .collect();
        assert_eq!(differences.len(), 3);
        let order = |(softer, stiffer): (&(f64, f64), &(f64, f64))| {
            (softer.1 / stiffer.1).ln() / (stiffer.0 / softer.0).ln()
        };
        let orders: Vec<f64> = differences.iter().zip(&differences[1..]).map(order).collect();
        assert!(orders.iter().all(|order| orders_within.contains(order)), "{orders:?} {differences:?}");
    }
}

#[test]
#[ignore = "a long campaign"]
fn all_members_of_all_families() {
    for name in ["blocks", "chain", "cart-1", "cart-2", "arm", "rest", "square", "limit"] {
        all(name);
    }
}
