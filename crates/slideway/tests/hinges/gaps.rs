//! Motions that begin in a preload gap beside hinges with friction.

use slideway::motion::{End, History, SimulateOptions, simulate};
use slideway::report::Proof;
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

/// A sleeve that slides along an arm on a rough pin, its faces pressed against the guide by PLUS and MINUS.
const SLEEVE: &str = r#"
gravity = 9.81
[points]
p0 = [0, 0]
p1 = [0.047048, -0.083335]
[bodies.a]
points = ["p0", "p1"]
mass = 0.74344
moment_of_inertia = 0.04906
centre_of_mass = [0.1, 0.05]
[bodies.s]
points = []
mass = 2.7076
moment_of_inertia = 0.07753
centre_of_mass = [0.28545, -0.17416]
[joints.O]
type = "hinge"
between = ["a.p0", "ground.p0"]
radius = 0.013849
mu = 0.08
[joints.j]
type = "guided_slider"
block = "s"
guide = "a"
at = [0.30276, -0.26142]
along = -0.71225
mu = 0.05
length = 2
height = 0
preload = { plus = PLUS, minus = MINUS }
preload_line = "centre"
[loads.force]
type = "force"
at = "a.p1"
components = [26.503, -6.0781]
[coordinates.q]
rotation = "a"
rate = -3.7125
[coordinates.s]
slide = "j"
rate = 1.4571
[drives.d]
coordinate = "q"
acceleration = 0
torque = { body = "a" }
"#;

/// The friction of unequal preloads is that of the face that is pressed, although it has no influence on that contact's own force.
#[test]
fn a_sleeve_beside_a_rough_pin_rubs_at_the_face_that_is_pressed() {
    let effort = |plus: f64, minus: f64| {
        let text = SLEEVE.replace("PLUS", &plus.to_string()).replace("MINUS", &minus.to_string());
        let report = solve(&Model::parse(&text).unwrap()).unwrap();
        assert_eq!((report.complete, report.solutions.len()), (Proof::Proven, 1), "{plus} {minus}");
        let solution = &report.solutions[0];
        assert_eq!(solution.signs, [-1]);
        solution.drives[0].effort
    };
    let [unequal, as_pressed, as_other] = [effort(6.0, 4.0), effort(4.0, 4.0), effort(6.0, 6.0)];
    assert!((unequal - as_pressed).abs() < 1e-12 * as_pressed.abs(), "{unequal} {as_pressed}");
    assert!((unequal - as_other).abs() > 0.01 * as_other.abs(), "{unequal} {as_other}");
}
