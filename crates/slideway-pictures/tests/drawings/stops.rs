//! Stops and pads at the ends of travels.

use crate::Case;
use slideway::model::Settings;
use slideway_pictures::drawing::{Class, ContactStates, Point, Scene, SceneOptions, Shape, View, scene};

/// A block 0.2 m long on a level guide of ground, drawn at 0, with these keys of its joint.
fn block(joint: &str, place: &str) -> Case {
    let text = format!(
        r#"
[points]
C = [0, 0]
far = [-1, 0]
[bodies.block]
points = ["C"]
mass = "2 kg"
centre_of_mass = "C"
moment_of_inertia = "1 kg m^2"
[joints.guide]
type = "block_slider"
block = "block"
at = "C"
along = 0
length = "0.2 m"
height = "0.1 m"
mu = 0.1
{joint}
[loads.spring]
type = "spring"
between = ["ground.far", "block.C"]
stiffness = "1 N/m"
free_length = "1 m"
[coordinates.x]
slide = "guide"
"#
    );
    Case::new(&text, &Settings::default().position("x", place))
}

/// Both in one view.
fn drawn(cases: &[Case]) -> (View, Vec<Scene>) {
    let configurations: Vec<_> = cases.iter().map(|case| &case.configuration).collect();
    let view = View::fitting(&cases[0].mechanism, &configurations, [440.0, 320.0]);
    let states = ContactStates::default();
    let one =
        |case: &Case| scene(&case.mechanism, &case.configuration, &states, &view, &SceneOptions::overview());
    let scenes = cases.iter().map(one).collect();
    (view, scenes)
}

fn places(scene: &Scene, class: Class) -> Vec<Vec<Point>> {
    let of_class = scene.elements.iter().filter(|element| element.class == class);
    of_class
        .filter_map(|element| match &element.shape {
            Shape::Line(places) | Shape::Area(places) => Some(places.clone()),
            _ => None,
        })
        .collect()
}

/// From where to where a shape reaches in the horizontal direction (m).
fn reach(view: &View, shape: &[Point]) -> [f64; 2] {
    let across = shape.iter().map(|place| place.x / view.scale + view.middle.x);
    [across.clone().fold(f64::INFINITY, f64::min), across.fold(f64::NEG_INFINITY, f64::max)]
}

/// Places of the upright walls (m).
fn end_walls(view: &View, scene: &Scene) -> Vec<f64> {
    let walls = places(scene, Class::Wall).into_iter().map(|wall| reach(view, &wall));
    // Those beside a point of ground at which a spring is fixed are left of -0.9 m.
    let upright = walls.filter(|[from, to]| to - from < 1e-9 && *from > -0.9);
    let mut found: Vec<f64> = upright.map(|[from, _]| from).collect();
    found.sort_by(f64::total_cmp);
    found
}

fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    assert!(
        found.iter().zip(expected).all(|(one, other)| (one - other).abs() < 1e-9),
        "{found:?} {expected:?}"
    );
}

/// A block 0.2 m long with 0.2 m and 0.15 m to go meets stops at -0.3 m and 0.25 m; without, or where the
/// motion ends, or with an end of travel that is far away, nothing stands there.
#[test]
fn a_stop_stands_where_the_block_is_at_the_end_of_its_travel() {
    let stopped = |stop: &str| {
        let case = block(&format!("travel = [\"-0.2 m\", \"0.15 m\"]\n{stop}"), "0 m");
        let (view, scenes) = drawn(&[case]);
        end_walls(&view, &scenes[0])
    };
    close(&stopped("stop = { restitution = 0.3 }"), &[-0.3, 0.25]);
    close(&stopped("stop = { greatest = { restitution = 0.3 } }"), &[0.25]);
    close(&stopped(""), &[]);
    let (view, scenes) = drawn(&[block("travel = [-100, 0.15]\nstop = { restitution = 0 }", "0 m")]);
    close(&end_walls(&view, &scenes[0]), &[0.25]);
    // At the stop the block touches it.
    let at_stop = block("travel = [-0.2, 0.15]\nstop = { restitution = 0 }", "0.15 m");
    let (view, scenes) = drawn(&[at_stop]);
    let outline =
        places(&scenes[0], Class::Body).iter().map(|area| reach(&view, area)[1]).fold(0.0, f64::max);
    close(&[outline], &end_walls(&view, &scenes[0])[1..]);
}

/// Where the guide carries the front contact the block leaves it there: which faces would meet is not known.
#[test]
fn an_open_end_has_no_stop() {
    let front = "travel = [-0.1, 0.1]\nstop = { restitution = 0 }\nfront = { carried_by = \"guide\" }";
    let (view, scenes) = drawn(&[block(front, "0 m")]);
    close(&end_walls(&view, &scenes[0]), &[-0.2]);
}

/// A pad begins where the block is at the end of its travel, gives way with it, and leans on one place.
#[test]
fn a_pad_is_compressed_by_the_block() {
    let pads = "travel = [-0.1, 0.1]\nstop = { greatest = { stiffness = \"1 kN/m\" } }";
    let cases = ["0 m", "0.1 m", "0.15 m"].map(|place| block(pads, place));
    let (view, scenes) = drawn(&cases);
    let reaches: Vec<[f64; 2]> = scenes
        .iter()
        .map(|scene| {
            let pads = places(scene, Class::Pad);
            assert_eq!(pads.len(), 1);
            reach(&view, &pads[0])
        })
        .collect();
    close(&reaches.iter().map(|[face, _]| *face).collect::<Vec<_>>(), &[0.2, 0.2, 0.25]);
    for (scene, [face, wall]) in scenes.iter().zip(&reaches) {
        close(&end_walls(&view, scene), &[reaches[0][1]]);
        assert!(wall > face);
        let hatching = places(scene, Class::Hatch).into_iter().map(|line| reach(&view, &line));
        // Cross-hatching is within the pad; hatching of walls is outside of the guide.
        let within = hatching.filter(|[from, to]| from + 1e-9 >= *face && *to <= wall + 1e-9).count();
        assert!(within >= 2, "{within}");
    }
}

/// The pad of the drawer is pressed by its plate, which covers the slider: its end is 0.225 m from its
/// middle.
#[test]
fn a_plate_meets_the_pad() {
    let text = slideway::gallery::find("soft-closing-drawer").unwrap().text;
    let cases = ["200 mm", "-50 mm"].map(|x| Case::new(text, &Settings::default().position("x", x)));
    let (view, scenes) = drawn(&cases);
    // Drawn 0.2 m open with its middle at 0.
    for (scene, face) in scenes.iter().zip([-0.2 - 0.225, -0.25 - 0.225]) {
        let pads = places(scene, Class::Pad);
        close(&[reach(&view, &pads[0])[1]], &[face]);
    }
}

/// A pin of the block in a slot of another body: at its stop it lies in the round end of the slot.
#[test]
fn a_slot_ends_where_the_pin_stops() {
    let text = r#"
[points]
C = [0, 0]
[bodies.plate]
points = ["C"]
mass = "2 kg"
centre_of_mass = "C"
moment_of_inertia = "1 kg m^2"
[bodies.pin]
points = ["C"]
mass = "1 kg"
centre_of_mass = "C"
moment_of_inertia = "1 kg m^2"
[joints.rail]
type = "block_slider"
block = "plate"
at = "C"
along = "90 deg"
length = "0.2 m"
mu = 0
[joints.guide]
type = "block_slider"
block = "pin"
at = "C"
along = "0 deg"
length = "0.1 m"
mu = 0
[joints.slot]
type = "pin_in_slot"
block = "pin"
guide = "plate"
at = "C"
along = "45 deg"
mu = 0
travel = [-0.15, 0.1]
stop = { restitution = 0 }
[coordinates.s]
slide = "slot"
"#;
    let (view, scenes) = drawn(&[Case::new(text, &Settings::default())]);
    let slots = places(&scenes[0], Class::Slot);
    let half = |slot: &[Point]| {
        // The round ends of a capsule at 45 degrees reach by their radius beyond its middle line.
        let height = slot.iter().map(|place| (place.x + place.y).abs()).fold(0.0, f64::max) / 2_f64.sqrt();
        height / view.scale
    };
    let found = slots.iter().map(|slot| (reach(&view, slot), half(slot)));
    let expected = |radius: f64| [-0.15, 0.1].map(|end: f64| end * 0.5_f64.sqrt() + end.signum() * radius);
    let found: Vec<_> = found
        .filter(|(found, radius)| {
            found.iter().zip(expected(*radius)).all(|(one, other)| (one - other).abs() < 2e-3)
        })
        .collect();
    assert_eq!(found.len(), 1, "{slots:?}");
}

/// A bar from -0.15 m over a pin at 0 to a corner at 0.3 m, 52 mm above its stop: no face cuts off what lies lower.
#[test]
fn a_bar_above_its_stop_is_whole() {
    let text = r#"
[points]
O = [0, 0]
A = ["0.3 m", 0]
B = ["-0.15 m", 0]
[bodies.lever]
points = ["O", "A", "B"]
mass = "2 kg"
centre_of_mass = "O"
moment_of_inertia = "0.03 kg m^2"
[joints.pin]
type = "hinge"
between = ["lever.O", "ground.O"]
[joints.stop]
type = "corner_on_face"
block = "lever"
at = "A"
along = 0
mu = 0.2
closed = false
[loads.W]
type = "force"
at = "lever.B"
components = [0, "-200 N"]
[coordinates.phi]
rotation = "lever"
value = "10 deg"
"#;
    let (view, scenes) = drawn(&[Case::new(text, &Settings::default())]);
    let bars = places(&scenes[0], Class::Body).into_iter().map(|bar| reach(&view, &bar));
    let least = bars.map(|[from, _]| from).fold(f64::INFINITY, f64::min);
    assert!(least < -0.15 * 10_f64.to_radians().cos(), "{least}");
}
