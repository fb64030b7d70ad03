//! Motions of discs that roll, begin to and cease to, against closed forms.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use crate::motion_lifting::words;
use slideway::model::{Model, Settings};
use slideway::motion::{End, History, SimulateOptions, simulate};

const G: f64 = 9.81;

fn history(text: &str, duration: f64) -> History {
    let model = Model::parse(text).unwrap().with(&Settings::default()).unwrap();
    let history = simulate(&model, &SimulateOptions::new(duration)).unwrap();
    assert_eq!(history.end, End::Finished, "{:#?}", words(&history));
    assert!(history.energy_error < 1e-8 * history.energy_scale, "{}", history.energy_error);
    history
}

fn is_near(found: f64, expected: f64, within: f64) {
    assert!((found - expected).abs() <= within, "{found} {expected}");
}

/// A solid disc on a straight floor or slope; `of_joint` and `coordinates` are the rest of the model.
fn on_floor(slope: &str, of_joint: &str, coordinates: &str) -> String {
    format!(
        r#"
        gravity = "{G} m/s^2"
        [points]
        C = ["-0.1 m*sin({slope})", "0.1 m*cos({slope})"]
        [bodies.wheel]
        points = ["C"]
        mass = "2 kg"
        centre_of_mass = "C"
        shape = {{ disc = "0.1 m" }}
        [joints.floor]
        type = "disc_on_face"
        block = "wheel"
        centre = "C"
        radius = "0.1 m"
        along = "{slope}"
        {of_joint}
        {coordinates}
        "#
    )
}

/// A bowling ball as a solid disc: it slides with `mu g` until its rim has no slip any more, at `v_0/(3 mu g)`, and rolls on with
/// `2 v_0/3` (K. Magnus, H. H. Mueller-Slany, Grundlagen der Technischen Mechanik; of a solid disc `J = m r^2/2`).
#[test]
fn what_slides_comes_to_roll() {
    let (v, mu) = (3.0, 0.2);
    let coordinates =
        "[coordinates.x]\nslide = \"floor\"\nrate = \"3 m/s\"\n[coordinates.turn]\nrotation = \"wheel\"";
    let history = history(&on_floor("0 deg", "mu = 0.2", coordinates), 1.0);
    let rolls = v / (3.0 * mu * G);
    is_near(history.phases.last().unwrap().from, rolls, 1e-9);
    assert!(history.events[1].words.contains("floor stops and sticks"), "{:#?}", words(&history));
    let mut reader = history.reader();
    let end = reader.configuration(1.0).unwrap();
    is_near(end.velocities[0].linear.x, 2.0 * v / 3.0, 1e-9);
    is_near(end.velocities[0].angular, -2.0 * v / 3.0 / 0.1, 1e-8);
    // v^2/(2 a) of the slide, then at its speed.
    let slid = v * rolls - mu * G * rolls * rolls / 2.0;
    is_near(end.poses[0].position.x, slid + 2.0 * v / 3.0 * (1.0 - rolls), 1e-8);
}

/// A solid disc rolls down a slope with `2/3 g sin`, without slip however far.
#[test]
fn a_disc_rolls_down_a_slope() {
    let coordinates = "[coordinates.x]\nslide = \"floor\"";
    let history = history(&on_floor("-20 deg", "mu = 0.5\nsticks = true", coordinates), 2.0);
    let slope = 20_f64.to_radians();
    let way = 2.0 / 3.0 * G * slope.sin() * 4.0 / 2.0;
    let mut reader = history.reader();
    let end = reader.configuration(2.0).unwrap();
    let place = end.poses[0].position;
    is_near(f64::hypot(place.x - 0.1 * slope.sin(), place.y - 0.1 * slope.cos()), way, 1e-8);
    is_near(end.poses[0].angle(), -way / 0.1, 1e-7);
}

/// A disc of 50 mm starts at the top of a cylinder of 200 mm with 0.3 m/s and rolls: it would leave at `cos(phi) = 4/7 + 3 v^2/(7 g R)`
/// with the distance `R` of the centres, if it rolled to the end, which takes any friction. With `mu = 2` it slips from where the
/// force that holds it vanishes, shortly before (case `disc_leaves_a_cylinder_rolls`).
#[test]
fn a_disc_rolls_off_a_cylinder() {
    let text = r#"
        gravity = "9.81 m/s^2"
        [points]
        O = [0, 0]
        C = [0, "0.25 m"]
        [bodies.disc]
        points = ["C"]
        mass = "1 kg"
        centre_of_mass = "C"
        shape = { disc = "0.05 m" }
        [joints.top]
        type = "disc_on_disc"
        centres = ["disc.C", "ground.O"]
        radii = ["50 mm", "0.2 m"]
        mu = 2000
        sticks = true
        [coordinates.x]
        x = "disc.C"
        rate = "0.3 m/s"
    "#;
    let history = history(text, 0.6);
    let leaves = history.events.iter().find(|event| event.words.contains("lifts off")).unwrap().time;
    let mut reader = history.reader();
    let place = reader.configuration(leaves).unwrap().poses[0].position;
    let cosine = 4.0 / 7.0 + 3.0 * 0.3 * 0.3 / (7.0 * G * 0.25);
    is_near(cosine, 0.587_155_963_3, 1e-10);
    is_near(place.y / 0.25, cosine, 1e-3);
}
