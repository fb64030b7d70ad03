//! What happens does not depend on how long a motion is followed, how accurately, and when its clock began.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use slideway::gallery;
use slideway::mechanism::Mechanism;
use slideway::model::{Model, Settings};
use slideway::motion::{End, SimulateOptions, simulate};

/// A model: its text, the duration, and what to set.
struct Case {
    name: &'static str,
    text: &'static str,
    duration: f64,
    settings: &'static [(&'static str, &'static str)],
}

fn cases() -> Vec<Case> {
    let finding = |name, text, duration| Case { name, text, duration, settings: &[] };
    let model = |name, duration| finding(name, gallery::find(name).unwrap().text, duration);
    vec![
        finding("two", include_str!("findings/motion_two.toml"), 1.0),
        finding("off3", include_str!("findings/motion_off3.toml"), 2.0),
        finding("off4", include_str!("findings/motion_off4.toml"), 1.0),
        finding("d2", include_str!("findings/motion_d2.toml"), 3.0),
        finding("dwell", include_str!("findings/motion_dwell.toml"), 2.0),
        finding("tipstick", include_str!("findings/motion_tipstick.toml"), 1.0),
        Case {
            name: "sy0",
            text: include_str!("findings/motion_sy0.toml"),
            duration: 1.2,
            settings: &[("mu_pin", "0.7"), ("mu_yoke", "0.8"), ("Q", "0 N"), ("T", "0 N*m")],
        },
        model("stick-slip", 2.0),
        model("frictional-oscillator", 1.0),
        model("klepp-2002-spring", 0.5),
        model("thrown-drawer", 0.5),
    ]
}

impl Case {
    fn model(&self, text: &str, more: Settings) -> Model {
        let settings =
            self.settings.iter().fold(more, |settings, (name, value)| settings.parameter(name, value));
        let model = Model::parse(text).unwrap_or_else(|faults| panic!("{}: {faults}", self.name));
        model.with(&settings).unwrap()
    }

    fn outcome(&self, options: &SimulateOptions) -> Outcome {
        Outcome::of(&self.model(self.text, Settings::default()), options)
    }
}

/// What happens: when, and the mode that follows; how it ends.
struct Outcome {
    events: Vec<(f64, String)>,
    end: End,
}

impl Outcome {
    fn of(model: &Model, options: &SimulateOptions) -> Self {
        let mechanism = Mechanism::new(model).unwrap();
        let history = simulate(model, options).unwrap();
        let mode = |event: &slideway::motion::Event| match &event.phase {
            Some(phase) => phase.pattern(&mechanism),
            None => "ends".to_owned(),
        };
        let events = history.events.iter().map(|event| (event.time - mechanism.time, mode(event))).collect();
        Self { events, end: history.end.clone() }
    }

    /// Whether the same happens in another motion, up to some time.
    fn agrees(&self, other: &Self, (until, tolerance): (f64, f64), name: &str) {
        let before = |outcome: &Self| -> Vec<(f64, String)> {
            outcome.events.iter().filter(|(time, _)| *time < until).cloned().collect()
        };
        let [one, other] = [before(self), before(other)];
        assert_eq!(one.len(), other.len(), "{name}: {one:?} {other:?}");
        for (one, other) in one.iter().zip(&other) {
            assert_eq!(one.1, other.1, "{name}: {one:?} {other:?}");
            assert!((one.0 - other.0).abs() <= tolerance, "{name}: {one:?} {other:?}");
        }
    }
}

#[test]
fn the_same_happens_however_long_it_is_followed() {
    for case in cases() {
        let whole = case.outcome(&SimulateOptions::new(case.duration));
        for part in [0.21, 0.73, 1.9] {
            let other = case.outcome(&SimulateOptions::new(part * case.duration));
            whole.agrees(&other, (case.duration * f64::min(part, 1.0), 1e-7), case.name);
        }
    }
}

#[test]
fn the_same_happens_at_any_tolerance() {
    for case in cases() {
        let at = |tolerance| case.outcome(&SimulateOptions::new(case.duration).tolerance(tolerance));
        let reference = at(1e-8);
        for tolerance in [1e-6, 1e-7, 1e-10, 1e-11] {
            let other = at(tolerance);
            reference.agrees(&other, (f64::INFINITY, 10.0 * tolerance.max(1e-8)), case.name);
            assert_eq!(reference.end, other.end, "{}", case.name);
        }
    }
}

/// The clock begins at 7.3 s, and so do the loads: t stands for t - 7.3 s.
#[test]
fn the_same_happens_whenever_the_clock_begins() {
    let shifts = [
        ("off3", "6*t", "6*(t - 7.3 s)"),
        ("d2", "3*t", "3*(t - 7.3 s)"),
        ("klepp-2002-spring", "2*pi*f*t", "2*pi*f*(t - 7.3 s)"),
        ("tipstick", "*t", "*(t - 7.3 s)"),
        ("dwell", "step(0.5 s-t) - step(t-1 s)*step(1.5 s-t)", "step(7.8 s-t) - step(t-8.3 s)*step(8.8 s-t)"),
    ];
    let mut shifted = 0;
    for case in cases() {
        let change = shifts.iter().find(|(name, ..)| *name == case.name);
        let text = change.map_or(case.text.to_owned(), |(_, from, to)| case.text.replace(from, to));
        assert!(change.is_none() || text != case.text);
        shifted += usize::from(change.is_some());
        let options = SimulateOptions::new(case.duration);
        let later = Outcome::of(&case.model(&text, Settings::default().time("7.3 s")), &options);
        let whole = case.outcome(&options);
        whole.agrees(&later, (f64::INFINITY, 1e-7), case.name);
        assert_eq!(whole.end, later.end, "{}", case.name);
    }
    assert_eq!(shifted, shifts.len());
}
