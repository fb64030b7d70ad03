//! What bodies and joints look like: outlines of the model, and looks that follow from how the joints lie.

use crate::Case;
use nalgebra::Vector2;
use slideway::model::Settings;
use slideway_pictures::drawing::{
    Class, ContactStates, Point, Scene, SceneOptions, Shape, Shown, View, scene, sheet,
};

fn overview(case: &Case) -> (View, Scene) {
    let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
    let states = ContactStates::default();
    let scene = scene(&case.mechanism, &case.configuration, &states, &view, &SceneOptions::overview());
    (view, scene)
}

/// The picture of the only solution.
fn solved(case: &Case) -> Scene {
    let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
    let [solution] = &case.report.as_ref().unwrap().solutions[..] else { panic!("one solution") };
    let options = SceneOptions::contact_mode(1.0);
    scene(&case.mechanism, &case.configuration, &ContactStates::of(solution), &view, &options)
}

fn of_class(scene: &Scene, class: Class) -> Vec<&Shape> {
    scene.elements.iter().filter(|element| element.class == class).map(|element| &element.shape).collect()
}

/// The corners (m) of the areas of a class.
fn areas(view: &View, scene: &Scene, class: Class) -> Vec<Vec<Vector2<f64>>> {
    let metres = |place: &Point| view.middle + Vector2::new(place.x, -place.y) / view.scale;
    let areas = of_class(scene, class).into_iter().filter_map(|shape| match shape {
        Shape::Area(corners) => Some(corners.iter().map(metres).collect()),
        _ => None,
    });
    areas.collect()
}

fn is_drawn(areas: &[Vec<Vector2<f64>>], wanted: &[[f64; 2]]) -> bool {
    let is_near =
        |corner: &Vector2<f64>| wanted.iter().any(|[x, y]| (corner - Vector2::new(*x, *y)).norm() < 1e-9);
    areas.iter().any(|area| area.len() == wanted.len() && area.iter().all(is_near))
}

/// A drawer of 450 mm whose front contact stays at the mouth of its carcass.
fn drawer(shape: &str) -> Case {
    let text = format!(
        r#"
[points]
middle = ["-225 mm", 0]
[bodies.drawer]
points = ["middle"]
mass = "6 kg"
centre_of_mass = "middle"
{shape}
[joints.rails]
type = "block_slider"
block = "drawer"
at = "middle"
along = 0
length = "450 mm"
height = "500 mm"
mu = 0.3
front = {{ carried_by = "guide" }}
[loads.resistance]
type = "force"
at = "drawer.middle"
components = ["-10 N", 0]
[coordinates.out]
slide = "rails"
rate = 1
"#
    );
    Case::new(&text, &Settings::default().position("out", "0.2 m"))
}

/// Pulled out by 200 mm, the drawer reaches from -250 mm to 200 mm, and nothing of it reaches farther. If the
/// model does not say how long it is, its front is torn off.
#[test]
fn a_block_ends_where_its_body_ends() {
    let (view, scene) = overview(&drawer("shape = { rectangle = [\"450 mm\", \"500 mm\"] }"));
    let areas = areas(&view, &scene, Class::Body);
    assert!(is_drawn(&areas, &[[-0.25, -0.25], [0.2, -0.25], [0.2, 0.25], [-0.25, 0.25]]));
    assert!(areas.iter().flatten().all(|corner| (-0.25 - 1e-9..0.2 + 1e-9).contains(&corner.x)));
    let (view, scene) = overview(&drawer("moment_of_inertia = 0.2"));
    let torn = self::areas(&view, &scene, Class::Body);
    assert!(torn.iter().any(|area| area.len() > 10), "a zigzag has many corners");
}

/// A carriage with two pins on one rail has two shoes and one pair of walls as long as both, and one arrow
/// for its velocity.
#[test]
fn two_pins_on_one_rail_are_shoes() {
    let text = r#"
[points]
rear = [-0.1, 0]
front = [0.1, 0]
top = [0, 0.1]
[bodies.carriage]
points = ["rear", "front", "top"]
mass = "1.5 kg"
centre_of_mass = "top"
shape = { rectangle = [0.2, 0.1] }
[joints.rear]
type = "pin_in_slot"
block = "carriage"
at = "rear"
along = 0
mu = 0.2
[joints.front]
type = "pin_in_slot"
block = "carriage"
at = "front"
along = 0
mu = 0.2
[loads.weight]
type = "force"
at = "carriage.top"
components = [1, -10]
[coordinates.x]
slide = "rear"
rate = 1
"#;
    let case = Case::new(text, &Settings::default());
    let (view, scene) = overview(&case);
    assert_eq!(areas(&view, &scene, Class::Pin).len(), 2);
    assert_eq!(of_class(&scene, Class::Velocity).len(), 2, "an arrow and its value");
    let walls = of_class(&scene, Class::Wall);
    assert_eq!(walls.len(), 2);
    for wall in walls {
        let Shape::Line(ends) = wall else { panic!("walls are lines") };
        assert!((ends[0].x - ends[1].x).abs() > 0.2 * view.scale, "{ends:?}");
    }
}

/// The wedge of the gallery rests on the floor with 400 mm, and its flank falls by tan(10 deg) through (0, 50
/// mm). A ram that is pulled away from the flank needs a slot.
#[test]
fn a_wedge_has_a_flank_as_long_as_it_is_pressed() {
    let case = Case::gallery("wedge");
    let (view, scene) = overview(&case);
    let rise = 0.2 * 10.0_f64.to_radians().tan();
    let corners = [[-0.2, 0.0], [0.2, 0.0], [0.2, 0.05 - rise], [-0.2, 0.05 + rise]];
    assert!(is_drawn(&areas(&view, &scene, Class::Body), &corners));
    assert!(of_class(&solved(&case), Class::Slot).is_empty());
    let pulled = Case::new(
        slideway::gallery::find("wedge").unwrap().text,
        &Settings::default().parameter("Q", "-1 kN"),
    );
    assert_eq!(of_class(&solved(&pulled), Class::Slot).len(), 1);
}

/// The belt of the gallery runs on two rollers a metre apart and carries its block on its upper side: no walls
/// between them, and no play that would have to be exaggerated.
#[test]
fn a_belt_runs_on_rollers() {
    let case = Case::gallery("stick-slip");
    let (view, scene) = overview(&case);
    let circles: Vec<Point> = of_class(&scene, Class::Fixed)
        .into_iter()
        .filter_map(|shape| match shape {
            Shape::Circle(centre, _) => Some(*centre),
            _ => None,
        })
        .collect();
    let [first, second] = circles[..] else { panic!("two rollers: {circles:?}") };
    assert!(((first - second).norm() - view.scale).abs() < 1e-9);
    let middle = Vector2::new(0.0, -0.05) - view.middle;
    assert!((0.5 * (first + second) - Point::new(middle.x, -middle.y) * view.scale).norm() < 1e-9);
    assert!(of_class(&scene, Class::Slot).is_empty());
    assert!(!solved(&case).is_exaggerated);
}

/// A sledge with an outline of five corners that do not form a convex polygon.
const OUTLINED: &str = r#"
[parameters]
h = "100 mm"
[points]
C = [0, 0]
tip = ["150 mm", 0]
[bodies.arm]
points = ["C", "tip"]
mass = "1 kg"
centre_of_mass = "tip"
moment_of_inertia = 0.01
outline = [[0, "-h"], ["200 mm", "-h"], "tip", ["200 mm", "h"], [0, "h"]]
[joints.pivot]
type = "hinge"
between = ["ground.C", "arm.C"]
[coordinates.phi]
rotation = "arm"
[drives.motor]
coordinate = "phi"
torque = { body = "arm" }
"#;

/// Turned by a right angle, each corner (x, y) is at (-y, x); nothing else of the body is drawn.
#[test]
fn an_outline_moves_with_its_body() {
    let drawn = [[0.0, -0.1], [0.2, -0.1], [0.15, 0.0], [0.2, 0.1], [0.0, 0.1]];
    for (angle, turned) in [("0 deg", drawn), ("90 deg", drawn.map(|[x, y]| [-y, x]))] {
        let case = Case::new(OUTLINED, &Settings::default().position("phi", angle));
        let (view, scene) = overview(&case);
        let areas = areas(&view, &scene, Class::Body);
        assert_eq!(areas.len(), 1, "{areas:?}");
        assert!(is_drawn(&areas, &turned), "{angle}: {areas:?}");
    }
}

fn captions(case: &Case) -> Vec<String> {
    let sheet = sheet(&case.mechanism, &case.configuration, case.report.as_ref(), Shown::All).unwrap();
    sheet.scene.texts().map(|(_, text)| text.text.clone()).collect()
}

#[test]
fn play_is_said_to_be_exaggerated_where_it_is() {
    let says = |name: &str| {
        captions(&Case::gallery(name)).iter().filter(|text| text.contains("exaggerated")).count()
    };
    // One for each solution and each state in the preload gap; none of a nut that lies on its face.
    assert_eq!((says("klepp-2002"), says("drawer"), says("screw")), (4, 1, 0));
}

/// In the first drawing loads and weights are to one scale, with a bar: of the boom, a load of 300 N and three
/// weights of 20 kg.
#[test]
fn weights_stand_beside_the_loads_to_scale() {
    let case = Case::gallery("telescopic-boom");
    let sheet = sheet(&case.mechanism, &case.configuration, case.report.as_ref(), Shown::Mechanism).unwrap();
    let lengths: Vec<f64> = of_class(&sheet.scene, Class::Load)
        .into_iter()
        .filter_map(|shape| match shape {
            Shape::Arrow { from, to } if (from.x - to.x).abs() < 1e-9 => Some((to - from).norm()),
            _ => None,
        })
        .collect();
    let [load, weights @ ..] = &lengths[..] else { panic!("a load and weights") };
    assert_eq!(weights.len(), 3);
    for weight in weights {
        assert!((weight / load - 20.0 * 9.81 / 300.0).abs() < 1e-9, "{lengths:?}");
    }
    let texts = captions(&case);
    assert_eq!(texts.iter().filter(|text| *text == "weight 196.2 N").count(), 6, "two drawings: {texts:?}");
}

/// At x = -50 mm the drawer is 50 mm deep in its pad (200 N/m, 60 N s/m) and comes with 0.3 m/s: 28 N.
#[test]
fn a_pad_that_pushes_has_an_arrow() {
    let text = slideway::gallery::find("soft-closing-drawer").unwrap().text;
    let case = Case::new(text, &Settings::default().position("x", "-50 mm"));
    assert_eq!(captions(&case).iter().filter(|text| *text == "pad 28 N").count(), 2);
    assert!(!captions(&Case::gallery("soft-closing-drawer")).iter().any(|text| text.starts_with("pad")));
}
