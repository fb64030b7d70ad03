//! Time of the decisions at events.

use divan::Bencher;
use slideway::configuration::Configuration;
use slideway::gallery;
use slideway::ids::JointId;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::modes::Side;
use slideway::motion::decision::{jam, sticking_margin, successors};
use slideway::motion::{ContactPhase, JointPhase, Phase};

/// Three contacts with one degree of freedom, a loop with two, a chain with six and three degrees of freedom.
const NAMES: [&str; 3] = ["klepp-2002", "slider-crank", "telescopic-boom"];

fn main() {
    divan::main();
}

fn state(name: &str, settings: &[(&str, &str)], moving: bool) -> (Mechanism, Configuration) {
    let model = Model::parse(gallery::find(name).expect("in the gallery").text).expect("a sound model");
    let set = |settings: Settings, (name, value): &(&str, &str)| settings.parameter(name, value);
    let model = model.with(&settings.iter().fold(Settings::default(), set)).expect("sound settings");
    let mut mechanism = Mechanism::new(&model).expect("allowed values");
    if !moving {
        for coordinate in &mut mechanism.coordinates {
            coordinate.rate = 0.0;
        }
    }
    let configuration = Configuration::new(&mechanism).expect("a state within reach");
    (mechanism, configuration)
}

fn sliders(mechanism: &Mechanism) -> usize {
    (0..mechanism.joints.len()).filter(|joint| mechanism.slider(JointId(*joint)).is_some()).count()
}

#[divan::bench(args = NAMES)]
fn margin_of_sticking(bencher: Bencher<'_, '_>, name: &str) {
    let (mechanism, configuration) = state(name, &[], false);
    let phase = Phase {
        joints: vec![JointPhase::Sticking; sliders(&mechanism)],
        contacts: vec![ContactPhase::Pressed(Side::Positive); mechanism.contacts.len()],
        hinges: Vec::new(),
    };
    bencher.bench(|| sticking_margin(&mechanism, &configuration, &phase));
}

#[divan::bench(args = NAMES)]
fn successors_while_sliding(bencher: Bencher<'_, '_>, name: &str) {
    let (mechanism, configuration) = state(name, &[], true);
    let stopped = vec![false; sliders(&mechanism)];
    bencher.bench(|| successors(&mechanism, &configuration, &stopped, None));
}

#[divan::bench(args = NAMES)]
fn successors_at_a_stop(bencher: Bencher<'_, '_>, name: &str) {
    let (mechanism, configuration) = state(name, &[], false);
    let stopped = vec![true; sliders(&mechanism)];
    bencher.bench(|| successors(&mechanism, &configuration, &stopped, None));
}

#[divan::bench]
fn jam_of_the_paper(bencher: Bencher<'_, '_>) {
    let (mechanism, configuration) =
        state("klepp-2002", &[("F_20", "0"), ("mu_1", "0.6"), ("direction", "-1")], true);
    bencher.bench(|| jam(&mechanism, &configuration));
}
