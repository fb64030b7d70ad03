//! What bodies and joints look like: outlines of the model, and looks that follow from how the joints lie.

use crate::Case;
use nalgebra::Vector2;
use slideway::fault::{Fault, FaultKind};
use slideway::model::Settings;
use slideway_pictures::drawing::{
    Class, ContactStates, Point, Scene, SceneOptions, Shape, Sheet, Shown, View, scene,
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
    let options = SceneOptions { longest_arrow: f64::INFINITY, ..SceneOptions::contact_mode(1.0) };
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

/// The belt of the gallery runs over two rollers 0.6 m apart, whose upper sides are at its lower side, 20 mm below
/// the block: no walls between them, and no play that would have to be exaggerated. However far the belt has moved,
/// the rollers stay where they are, and nothing but the lines across it shows that.
#[test]
fn a_belt_runs_on_rollers() {
    let moved = |distance: &str| {
        let text = slideway::gallery::find("stick-slip").unwrap().text;
        Case::new(text, &Settings::default().position("belt", distance))
    };
    let [(view, at_start), (_, later)] = ["0 mm", "2010 mm"].map(|distance| overview(&moved(distance)));
    for scene in [&at_start, &later] {
        let circles: Vec<(Point, f64)> = of_class(scene, Class::Fixed)
            .into_iter()
            .filter_map(|shape| match shape {
                Shape::Circle(centre, radius) => Some((*centre, *radius)),
                _ => None,
            })
            .collect();
        let [(second, _), (first, radius)] = circles[..] else { panic!("two rollers: {circles:?}") };
        assert!((second - first - Point::new(0.6 * view.scale, 0.0)).norm() < 1e-9);
        let below = Vector2::new(-0.3, -0.02) - view.middle;
        let top = Point::new(below.x, -below.y) * view.scale;
        assert!((first - Point::new(0.0, radius) - top).norm() < 0.5, "{first} {radius} {top}");
        assert!(of_class(scene, Class::Slot).is_empty());
    }
    assert!(!solved(&moved("0 mm")).is_exaggerated);
    let marks = |scene: &Scene| -> Vec<f64> {
        let upright = |edge: &&Shape| matches!(edge, Shape::Line(ends) if ends[0].x == ends[1].x);
        of_class(scene, Class::Edge).into_iter().filter(upright).map(start).collect()
    };
    // Lines 30 units apart.
    let by = (2.01 * view.scale).rem_euclid(30.0);
    let [before, after] = [&at_start, &later].map(marks);
    assert!(before.len() > 5 && after.len() > 5);
    for mark in &before[..5] {
        let near = after
            .iter()
            .any(|other| (other - mark - by).abs() < 1e-9 || (other - mark - by + 30.0).abs() < 1e-9);
        assert!(near, "{mark} {by} {after:?}");
    }
}

fn start(line: &Shape) -> f64 {
    let Shape::Line(ends) = line else { panic!("a line") };
    ends[0].x
}

/// With a mass, with an end that the model gives, or with a contact that travels with it, what runs on rollers is no
/// belt: it is drawn where it is.
#[test]
fn what_is_more_than_a_belt_has_walls() {
    let belt = slideway::gallery::find("stick-slip").unwrap().text;
    let bodies = "massless = true";
    let front = "front = { carried_by = \"guide\" }";
    for (from, to) in [
        (bodies, "mass = \"2 kg\"\nmoment_of_inertia = 0.1\ncentre_of_mass = \"belt\""),
        (bodies, "massless = true\noutline = [[-1, -0.02], [1, -0.02], [1, 0], [-1, 0]]"),
        (front, "front = { carried_by = \"block\" }"),
        (front, "front = { carried_by = \"guide\", mu = 0.1 }"),
    ] {
        assert!(belt.contains(from));
        let case = Case::new(&belt.replace(from, to), &Settings::default());
        let (_, scene) = overview(&case);
        let is_roller = |shape: &&Shape| matches!(shape, Shape::Circle(..));
        assert!(!of_class(&scene, Class::Fixed).iter().any(is_roller), "{to}");
    }
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
    let sheet = case.sheet(Shown::All).unwrap();
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
    let sheet = case.sheet(Shown::Mechanism).unwrap();
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

/// The bushing of the cam follower is ground, so that the forces on its stem are drawn. The cam pushes the foot to the
/// right: the stem leans on the lower end of the bushing, which pushes it to the left, and on the upper one, which
/// pushes it to the right. It rises, so that friction pulls it down. Together with the cam and the load they are in
/// equilibrium.
#[test]
fn forces_act_on_what_moves() {
    let case = Case::gallery("cam-follower");
    let scene = solved(&case);
    let arrows = |class: Class| -> Vec<(Point, Point)> {
        let arrows = of_class(&scene, class).into_iter().filter_map(|shape| match shape {
            Shape::Arrow { from, to } => Some((*from, to - from)),
            _ => None,
        });
        arrows.collect()
    };
    let [upper, lower] = arrows(Class::Reaction)[..] else { panic!("two reactions") };
    assert!(upper.0.y < lower.0.y && upper.1.x > 0.0 && lower.1.x < 0.0, "{upper:?} {lower:?}");
    let friction = arrows(Class::Friction);
    assert!(friction.len() == 2 && friction.iter().all(|(_, force)| force.y > 0.0), "{friction:?}");
    // A unit for a newton, and sin 30 deg of the force of the cam. The stem is drawn tipped by some degrees.
    let solution = &case.report.as_ref().unwrap().solutions[0];
    let push = 0.5 * solution.drives[0].effort;
    let sideways: f64 = [upper, lower].iter().chain(&friction).map(|(_, force)| force.x).sum();
    assert!((sideways + push).abs() < 0.15 * push, "{sideways} {push}");
    let texts = captions(&case);
    assert!(texts.contains(&"normal reaction on the moving part".to_owned()), "{texts:?}");
    assert!(captions(&Case::gallery("drawer")).contains(&"normal reaction on the block".to_owned()));
}

/// The heading names what was set, and says why there are no forces; all below it makes room.
#[test]
fn the_heading_tells_settings_and_reasons() {
    let case = Case::gallery("klepp-2002");
    let plain = case.sheet(Shown::All).unwrap();
    let settings = Settings::default().parameter("mu_1", "0.3").position("q", "-0.4 m");
    let fault = Fault::general(FaultKind::MotionWithoutInertia { motion: "pin moves".to_owned() });
    let told = plain.clone().unsolved(&fault.into()).changed_by(&settings);
    let place = |sheet: &Sheet, wanted: &str| {
        let mut texts = sheet.scene.texts().map(|(_, text)| text);
        texts.find(|text| text.text.starts_with(wanted)).map(|text| text.at.y)
    };
    let lines = [
        "Forces at contacts are not drawn: the acceleration cannot be computed,",
        "With mu_1 = 0.3.",
        "The mechanism, to scale",
    ];
    let [first, second, third] = lines.map(|line| place(&told, line).unwrap_or_else(|| panic!("{line}")));
    assert!(first < second && second < third);
    let lower = third - place(&plain, lines[2]).unwrap();
    assert!((told.bounds.size().y - plain.bounds.size().y - lower).abs() < 1e-9 && lower > 30.0);
    assert!(lines[..2].iter().all(|line| told.description.contains(line)), "{}", told.description);
    assert_eq!(plain.clone().changed_by(&Settings::default()), plain);
}

/// Of several velocities each has the name of its joint; in the first drawing always, instead of another name.
#[test]
fn velocities_tell_their_joints() {
    let words = |scene: &Scene| -> Vec<String> {
        let texts = scene.texts().filter(|(class, _)| matches!(class, Class::Velocity | Class::Words));
        texts.map(|(_, text)| text.text.clone()).collect()
    };
    let belt = Case::gallery("stick-slip");
    for scene in [overview(&belt).1, solved(&belt)] {
        let told = words(&scene);
        for wanted in ["sole: 0.2 m/s", "support: 0.2 m/s"] {
            assert_eq!(told.iter().filter(|text| *text == wanted).count(), 1, "{told:?}");
        }
        assert!(!told.iter().any(|text| text == "sole"), "{told:?}");
    }
    let drawer = Case::gallery("thrown-drawer");
    assert!(words(&overview(&drawer).1).contains(&"guide: 0.2 m/s".to_owned()));
    assert!(words(&solved(&drawer)).contains(&"0.2 m/s".to_owned()));
}

/// The wall along which the ram of a wedge slides ends at the floor, however near that is.
#[test]
fn guides_end_at_the_floor() {
    let (view, scene) = overview(&Case::gallery("wedge"));
    let floor = view.middle.y * view.scale;
    let lowest = of_class(&scene, Class::Wall).into_iter().filter_map(|shape| match shape {
        Shape::Line(ends) if ends[0].x == ends[1].x => Some(ends[0].y.max(ends[1].y)),
        _ => None,
    });
    let lowest: Vec<f64> = lowest.collect();
    assert_eq!(lowest.len(), 2);
    assert!(lowest.iter().all(|end| (end - floor).abs() < 2.0), "{lowest:?} {floor}");
}

/// The floor of the drawer slopes along its rail: the part of its weight along that is not called its weight.
#[test]
fn a_part_of_the_weight_is_called_gravity() {
    let says =
        |name: &str, word: &str| captions(&Case::gallery(name)).iter().any(|text| text.starts_with(word));
    assert!(says("thrown-drawer", "gravity 3.42 N") && !says("thrown-drawer", "weight"));
    assert!(says("stick-slip", "weight 9.81 N"));
}

/// One force of the slider-crank is typed in kN; all others are below 100 N.
#[test]
fn forces_are_told_in_the_unit_in_which_most_read_well() {
    let texts = captions(&Case::gallery("slider-crank"));
    assert!(texts.contains(&"gas = 1000 N".to_owned()), "{texts:?}");
    assert!(!texts.iter().any(|text| text.contains("kN")), "{texts:?}");
}

/// Only a body that always lies flat, as the nut of a screw does, is drawn as standing on a face: the rod of a cylinder,
/// which may tip, has walls on both sides before a solution is known, too.
#[test]
fn what_may_tip_has_walls() {
    let walls = |case: &Case| of_class(&overview(case).1, Class::Wall).len();
    let text = slideway::template::find("cylinder").unwrap().text;
    assert_eq!(walls(&Case::new(text, &Settings::default())), 2);
    assert_eq!(walls(&Case::gallery("screw")), 1);
}
