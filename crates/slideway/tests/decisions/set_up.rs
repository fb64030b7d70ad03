//! Mechanisms in a state.

use slideway::configuration::Configuration;
use slideway::gallery;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::modes::Side;
use slideway::motion::decision::{Successors, successors};
use slideway::motion::{ContactPhase, JointPhase, Phase};

pub(crate) const PLUS: ContactPhase = ContactPhase::Pressed(Side::Positive);
pub(crate) const MINUS: ContactPhase = ContactPhase::Pressed(Side::Negative);

/// A mechanism and its configuration.
pub(crate) struct State {
    pub(crate) mechanism: Mechanism,
    pub(crate) configuration: Configuration,
}

impl State {
    /// A model of the gallery with some parameters set.
    pub(crate) fn gallery(name: &str, parameters: &[(&str, &str)]) -> Self {
        let model = Model::parse(gallery::find(name).expect("in the gallery").text).expect("a sound model");
        let set = |settings: Settings, (name, value): &(&str, &str)| settings.parameter(name, value);
        Self::of(&model.with(&parameters.iter().fold(Settings::default(), set)).expect("sound settings"))
    }

    /// A model text with some parameters set.
    pub(crate) fn text(text: &str, parameters: &[(&str, &str)]) -> Self {
        let model = Model::parse(text).unwrap_or_else(|faults| panic!("{faults}"));
        let set = |settings: Settings, (name, value): &(&str, &str)| settings.parameter(name, value);
        Self::of(&model.with(&parameters.iter().fold(Settings::default(), set)).expect("sound settings"))
    }

    /// A model.
    pub(crate) fn of(model: &Model) -> Self {
        let mechanism = Mechanism::new(model).unwrap();
        let configuration = Configuration::new(&mechanism).unwrap_or_else(|faults| panic!("{faults}"));
        Self { mechanism, configuration }
    }

    /// What can follow if these joints have stopped.
    pub(crate) fn successors(&self, stopped: &[bool], previous: Option<&Phase>) -> Successors {
        successors(&self.mechanism, &self.configuration, stopped, previous)
            .unwrap_or_else(|faults| panic!("{faults}"))
    }
}

/// A phase.
pub(crate) fn phase(joints: &[JointPhase], contacts: &[ContactPhase]) -> Phase {
    Phase { joints: joints.to_vec(), contacts: contacts.to_vec(), hinges: Vec::new() }
}

/// The joints of each phase that can follow: 'o' sticks, '+' and '-' slide.
pub(crate) fn joints(found: &Successors) -> Vec<String> {
    let symbol = |joint: &JointPhase| match joint {
        JointPhase::Sticking => 'o',
        JointPhase::Sliding(sign) if *sign > 0.0 => '+',
        JointPhase::Sliding(_) => '-',
    };
    found.list.iter().map(|one| one.phase.joints.iter().map(symbol).collect()).collect()
}

/// The contacts of a phase: '+', '-', or '0' in a preload gap.
pub(crate) fn sides(phase: &Phase) -> String {
    let symbol = |contact: &ContactPhase| match contact {
        ContactPhase::Pressed(Side::Positive) => '+',
        ContactPhase::Pressed(Side::Negative) => '-',
        ContactPhase::PreloadGap => '0',
    };
    phase.contacts.iter().map(symbol).collect()
}

/// Asserts that two numbers agree to this part of the greater, or of a scale.
pub(crate) fn assert_close(found: f64, expected: f64, scale: f64, tolerance: f64) {
    let scale = scale.max(found.abs()).max(expected.abs());
    assert!((found - expected).abs() <= tolerance * scale, "{found} is not {expected}");
}

/// Whether a model has contacts that may lift off.
pub(crate) fn may_lift_off(text: &str) -> bool {
    ["_on_face\"", "disc_on_disc\"", "one_sided = true"].iter().any(|kind| text.contains(kind))
}
