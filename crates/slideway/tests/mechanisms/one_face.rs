//! Hints where it is doubtful that a joint has two faces.

use crate::answers::report_on;
use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::report::{OneFaceHint, OneFaceReason};
use slideway::solve::solve;
use slideway::standstill::{HoldOptions, hold};

const CUBE: &str = include_str!("../findings/cube_on_a_plane.toml");
const CAM: &str = include_str!("../findings/cam_in_a_crack.toml");

fn model(text: &str, list: &[(&str, &str)]) -> Model {
    let settings = list.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(text).unwrap().with(&settings).unwrap()
}

fn of_hold(text: &str, list: &[(&str, &str)]) -> Vec<OneFaceHint> {
    hold(&model(text, list), &HoldOptions::default()).unwrap().one_face_hints
}

fn of_solve(text: &str, list: &[(&str, &str)]) -> Vec<OneFaceHint> {
    solve(&model(text, list)).unwrap().one_face_hints
}

/// The joint, its contacts, the reason and the type of joint of the only hint.
fn only(hints: &[OneFaceHint]) -> (&str, Vec<&str>, OneFaceReason, &'static str) {
    let [hint] = hints else { panic!("{hints:?}") };
    assert!(hint.words.contains(&format!("`{}`", hint.instead)) && hint.words.contains(&hint.joint));
    let contacts = hint.contacts.iter().map(String::as_str).collect();
    (&hint.joint, contacts, hint.reason, hint.instead)
}

/// A ladder of pins: it is pulled from the wall with more than its foot can hold, mu times all weights.
#[test]
fn a_ladder_that_is_pulled_off_its_wall() {
    let text = gallery::find("ladder").unwrap().text.replace("corner_on_face", "pin_in_slot");
    let (before, landing) = text.split_once("[joints.landing]").unwrap();
    let pinned = format!("{before}{}", &landing[landing.find("[coordinates").unwrap()..]);
    let pulled = |force: f64| {
        pinned.clone()
            + &format!("[loads.rope]\ntype = \"force\"\nat = \"ladder.head\"\ncomponents = [{force}, 0]\n")
    };
    assert_eq!(of_hold(&pulled(0.0), &[]), []);
    assert_eq!(of_hold(&pulled(1000.0), &[]), []);
    let hints = of_hold(&pulled(-1000.0), &[]);
    assert_eq!(only(&hints), ("head", vec!["head"], OneFaceReason::Pulls, "corner_on_face"));
    // Said to have two faces, it has them.
    let held = pulled(-1000.0).replace("mu = 0.3", "mu = 0.3\nplay = \"1 mm\"");
    assert_eq!(of_hold(&held, &[]), []);
}

#[test]
fn a_cam_whose_wall_would_have_to_pull() {
    assert_eq!(of_hold(CAM, &[]), []);
    let hints = of_hold(CAM, &[("T", "-1 kN")]);
    assert_eq!(only(&hints), ("wall", vec!["wall"], OneFaceReason::Pulls, "corner_on_face"));
}

/// The cube, with its force at the middle of its upper edge.
fn pushed_at_the_top(cube: &str) -> String {
    let changes = [
        ("foot = [0, 0]", "foot = [0, 0]\ntop = [0, \"a\"]"),
        ("points = [\"S\", \"foot\"]", "points = [\"S\", \"foot\", \"top\"]"),
        ("at = \"box.S\"", "at = \"box.top\""),
    ];
    changes.iter().fold(cube.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    })
}

/// A cube that is as wide as high tips from mu = 1 on, where a block between two faces jams.
#[test]
fn a_cube_that_tips() {
    assert_eq!(of_solve(CUBE, &[("mu", "0.9")]), []);
    let hints = of_solve(CUBE, &[("mu", "1.1")]);
    let both = vec!["plane.front", "plane.rear"];
    assert_eq!(only(&hints), ("plane", both, OneFaceReason::Jams, "block_on_face"));
    // A force at its top of more than the weight tips it, too: moments about its middle.
    let hints = of_solve(&pushed_at_the_top(CUBE), &[("mu", "0.1"), ("P", "20 N")]);
    assert_eq!(only(&hints), ("plane", vec!["plane.rear"], OneFaceReason::Pulls, "block_on_face"));
    let on_face = CUBE.replace("block_slider", "block_on_face");
    assert_eq!(of_solve(&on_face, &[("mu", "1.1")]), []);
}

/// Without an outline or a shape the weights alone tell on which face the block lies.
#[test]
fn a_block_that_changes_its_side() {
    let text = CUBE.replace("shape = { rectangle = [\"a\", \"a\"] }", "moment_of_inertia = \"1 kg*a^2/6\"");
    let text = pushed_at_the_top(&text);
    assert_eq!(of_solve(&text, &[("mu", "0.1")]), []);
    let hints = of_solve(&text, &[("mu", "0.1"), ("P", "20 N")]);
    assert_eq!(only(&hints), ("plane", vec!["plane.rear"], OneFaceReason::ChangesSide, "block_on_face"));
    // What hangs under its guide has two faces.
    let hanging = CUBE.replace("S = [0, \"a/2\"]", "S = [0, \"-a/2\"]");
    assert_eq!(of_solve(&hanging, &[("mu", "0.1")]), []);
}

/// No model of the gallery gets a hint as it is: blocks have a height or nothing that lies on one side, and pins press the side on
/// which they are drawn. The trammel is a ladder whose pins pull once it falls fast enough.
#[test]
fn the_gallery_gets_none_as_it_is() {
    for entry in gallery::MODELS {
        let model = Model::parse(entry.text).unwrap();
        if let Ok(report) = solve(&model) {
            assert_eq!(report.one_face_hints, [], "{}", entry.name);
        }
        if let Ok(report) = hold(&model, &HoldOptions::default()) {
            assert_eq!(report.one_face_hints, [], "{}", entry.name);
        }
    }
    let trammel = gallery::find("elliptic-trammel").unwrap().text;
    assert_eq!(of_solve(trammel, &[("omega", "-4 rad/s")]), []);
    let joints: Vec<String> =
        of_solve(trammel, &[("omega", "-8 rad/s")]).into_iter().map(|hint| hint.joint).collect();
    assert_eq!(joints, ["horizontal", "vertical"]);
    assert!(report_on(trammel).one_face_hints.is_empty());
}
