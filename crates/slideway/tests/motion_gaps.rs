//! Guided sliders with packings, between the faces of their guides.
#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use slideway::model::Model;
use slideway::motion::{Cause, ContactPhase, End, History, SimulateOptions, simulate};

/// A block of 1 kg, 0.2 m high, pulled by 10 N against packings of 6 N, without anything across the guide but
/// what is added.
fn guided(more: &str) -> History {
    let text = format!(
        r#"
[parameters]
second = "1 s"
[points]
S = [0, 0]
[bodies.b]
points = ["S"]
mass = "1 kg"
moment_of_inertia = "0.1 kg m^2"
centre_of_mass = "S"
[joints.s]
type = "guided_slider"
block = "b"
at = "S"
along = 0
length = "0.3 m"
height = "0.2 m"
mu = 0.3
preload = "6 N"
[loads.P]
type = "force"
at = "b.S"
components = ["10 N", 0]
[coordinates.x]
slide = "s"
rate = "1 m/s"
{more}
"#
    );
    simulate(&Model::parse(&text).unwrap(), &SimulateOptions::new(3.0)).unwrap()
}

/// x'' = (10 N - 6 N)/(1 kg), whatever the share is: x = t + 2 t^2.
fn follows_the_closed_form(history: &History) {
    assert_eq!(history.phases[0].phase.contacts, [ContactPhase::PreloadGap]);
    let mut reader = history.reader();
    for part in [0.2, 0.7, 1.0] {
        let t = part * history.stop();
        let sample = reader.at(t).unwrap();
        let [x, rate] = [sample.configuration.coordinates[0], sample.configuration.rates[0]];
        assert!((x - t - 2.0 * t * t).abs() < 1e-12 * (1.0 + x), "{t} {x}");
        assert!((rate - 1.0 - 4.0 * t).abs() < 1e-12 * (1.0 + rate), "{t} {rate}");
        assert!(sample.contacts[0].normal_force.abs() < 1e-12);
    }
}

/// N = 0 and C = 0: the friction of the packings is shared among both faces.
#[test]
fn a_guided_slider_between_its_faces_goes_on() {
    let history = guided("");
    assert_eq!(history.end, End::Finished);
    assert_eq!(history.events.len(), 1);
    follows_the_closed_form(&history);
    let friction = history.reader().at(3.0).unwrap().energy.friction[0];
    assert!((friction - 6.0 * 21.0).abs() < 1e-10, "{friction}");
}

/// A torque M = (0.3 N m/s) t takes the friction to one of the faces: M = (6 N)(0.1 m) after 2 s. Beyond
/// that, C = 0 would take more than the packings give, and without a normal force no face holds the block.
#[test]
fn its_gap_ends_where_one_face_has_the_whole_preload() {
    for sign in ["", "-"] {
        let torque =
            format!("[loads.M]\ntype = \"torque\"\nbody = \"b\"\nmoment = \"{sign}(0.3 N*m)*t/second\"\n");
        let history = guided(&torque);
        assert!(matches!(history.end, End::Tips(_)), "{:?}", history.end);
        assert!((history.stop() - 2.0).abs() < 1e-12, "{}", history.stop());
        let event = history.events.last().unwrap();
        assert!(event.causes.iter().any(|cause| matches!(cause, Cause::PreloadGapEnds(..))));
        follows_the_closed_form(&history);
    }
}

/// A transverse load from 1.5 s on presses it against a face. The friction of the packing there, (6 N)(0.1
/// m), is more than a small normal force can hold: |C| <= N (0.15 m).
#[test]
fn its_gap_ends_where_a_transverse_load_begins() {
    for sign in ["", "-"] {
        let load = format!(
            "[loads.Q]\ntype = \"force\"\nat = \"b.S\"\ncomponents = [0, \"{sign}(1 N)*max(t/second - 1.5, 0)\"]\n"
        );
        let history = guided(&load);
        assert!(matches!(history.end, End::Tips(_)), "{:?}", history.end);
        assert!((history.stop() - 1.5).abs() < 1e-12, "{}", history.stop());
        follows_the_closed_form(&history);
    }
}
