//! Why a mechanism jams: what its drawing shows, and says.

use crate::Case;
use slideway::model::Settings;
use slideway::solve::locking;
use slideway_pictures::drawing::{Bounds, Class, Forces, Point, Shape, Sheet, Shown, pieces, sheet};

fn drawn(name: &str, parameters: &[(&str, &str)]) -> Sheet {
    let settings =
        parameters.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let case = Case::new(slideway::gallery::find(name).unwrap().text, &settings);
    case.sheet(Shown::All).unwrap()
}

fn shapes(sheet: &Sheet, class: Class) -> Vec<&Shape> {
    let elements = sheet.scene.elements.iter().filter(|element| element.class == class);
    elements.map(|element| &element.shape).collect()
}

fn areas(sheet: &Sheet, class: Class) -> Vec<&[Point]> {
    let areas = shapes(sheet, class).into_iter().filter_map(|shape| match shape {
        Shape::Area(corners) => Some(corners.as_slice()),
        _ => None,
    });
    areas.collect()
}

/// Whether a place lies within a convex polygon: on one side of all its edges.
fn lies_in(place: Point, corners: &[Point]) -> bool {
    let side = |index: usize| {
        let [from, to] = [corners[index], corners[(index + 1) % corners.len()]];
        (to - from).perp(&(place - from))
    };
    let sides: Vec<f64> = (0..corners.len()).map(side).collect();
    sides.iter().all(|side| *side >= -1e-6) || sides.iter().all(|side| *side <= 1e-6)
}

/// The angle of a cone at its apex is that of friction, and the three forces meet in one place within both cones: then,
/// and only then, are they a balance, whatever their size.
#[test]
fn the_push_meets_both_reactions_within_both_cones() {
    for (name, mu, parameters) in [
        ("drawer", 0.7, vec![("mu", "0.7")]),
        ("drawer", 2.0, vec![("mu", "2")]),
        ("drawer", 0.7, vec![("mu", "0.7"), ("h", "0.1 m")]),
        ("cam-follower", 0.9, vec![("mu", "0.9"), ("d", "0")]),
    ] {
        let sheet = drawn(name, &parameters);
        let cones = areas(&sheet, Class::Cone);
        let [overlap] = areas(&sheet, Class::Overlap)[..] else { panic!("{name}: an overlap") };
        assert_eq!(cones.len(), 2, "{name}");
        let lines: Vec<[Point; 2]> = shapes(&sheet, Class::ActionLine)
            .into_iter()
            .map(|shape| match shape {
                Shape::Line(places) => [places[0], places[1]],
                other => panic!("{other:?}"),
            })
            .collect();
        let meeting = lines[0][1];
        for (cone, line) in cones.iter().zip(&lines) {
            let [one, other] = [cone[1] - cone[0], cone[cone.len() - 1] - cone[0]];
            assert!((0.5 * one.angle(&other) - f64::atan(mu)).abs() < 1e-6, "{name}");
            assert_eq!(*line, [cone[0], meeting]);
            assert!(lies_in(meeting, cone) && overlap.iter().all(|corner| lies_in(*corner, cone)), "{name}");
        }
        let [Shape::Line(push)] = shapes(&sheet, Class::PushLine)[..] else { panic!("{name}: the push") };
        assert!((push[1] - push[0]).normalize().perp(&(meeting - push[0])).abs() < 1e-6, "{name}");
        assert!(lies_in(meeting, overlap), "{name}");
        let said = "overlap of both friction cones: however hard it pushes, friction holds it.";
        assert!(sheet.description.contains(said), "{}", sheet.description);
    }
}

/// A cone has no end, but the picture has: where everything else is, and 45 units about the place where the forces meet.
#[test]
fn wide_cones_do_not_make_the_picture_wider() {
    for mu in ["0.7", "2", "20"] {
        let settings = Settings::default().parameter("mu", mu);
        let case = Case::new(slideway::gallery::find("drawer").unwrap().text, &settings);
        let jam = &pieces(
            &case.mechanism,
            &case.configuration,
            case.report.as_ref().map(Forces::InMotion),
            None,
            f64::INFINITY,
        )[1];
        let is_cone = |class| matches!(class, Class::Cone | Class::Overlap);
        let [cones, others] = [true, false].map(|wanted| {
            let elements = jam.scene.elements.iter().filter(|element| is_cone(element.class) == wanted);
            elements.filter_map(|element| element.shape.bounds()).reduce(Bounds::with).unwrap()
        });
        assert_eq!(areas(jam, Class::Cone).len(), 2);
        let within = others.widened(45.0);
        assert!(within.least.x <= cones.least.x && cones.greatest.x <= within.greatest.x, "{mu}: {cones:?}");
    }
}

/// Bodies that are joined are pushed through their joints: each force stands in its own cone.
#[test]
fn other_mechanisms_have_each_force_in_its_cone() {
    let sheet = drawn("klepp-2002", &[("F_20", "0"), ("direction", "-1")]);
    assert!(areas(&sheet, Class::Overlap).is_empty());
    let arrows = shapes(&sheet, Class::ContactForce);
    let cones = areas(&sheet, Class::Cone);
    assert_eq!((cones.len(), arrows.len()), (3, 4), "the fourth arrow is that of the key");
    for (cone, arrow) in cones.iter().zip(arrows) {
        let Shape::Arrow { from, to } = arrow else { panic!("{arrow:?}") };
        assert_eq!(*to, cone[0]);
        let [one, other] = [1, 2].map(|corner| (cone[corner] - cone[0]).perp(&(from - cone[0])));
        assert!(one * other <= 0.0, "{from} lies between the edges of {cone:?}");
    }
    assert!(sheet.description.contains("Friction itself presses these contacts together: at 0.8816 times"));
}

/// What moves has no such picture, nor what only tips; and the verdict stands on the sheet once.
#[test]
fn only_what_friction_locks_has_the_picture() {
    assert!(!drawn("drawer", &[]).description.contains("Why it jams"));
    let tips =
        Case::new(include_str!("../../../../docs/src/examples/guided-tips.toml"), &Settings::default());
    let sheet = tips.sheet(Shown::All).unwrap();
    assert!(!sheet.description.contains("Why it jams"));
    assert_eq!(drawn("drawer", &[("mu", "0.7")]).description.matches("It jams: no force").count(), 1);
}

/// Every contact that presses has its cone, its force in it and a mark; those that are open have none.
#[test]
fn redundant_guides_have_the_picture_with_their_open_contacts() {
    let plays = [("mu", "0.9"), ("play_left", "0.6 mm"), ("play_right", "0.2 mm")];
    let settings = plays.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, *value));
    let case = Case::new(slideway::gallery::find("drawer-on-two-rails").unwrap().text, &settings);
    let sheet = case.sheet(Shown::All).unwrap();
    let locking = locking(case.report.as_ref().unwrap(), &case.mechanism, &case.configuration).unwrap();
    let pressed = locking.pattern.chars().filter(|sign| "+-".contains(*sign)).count();
    assert!(pressed >= 2, "{}", locking.pattern);
    assert_eq!(shapes(&sheet, Class::JammedCorner).len(), pressed + 1, "and one in the key");
    assert_eq!(areas(&sheet, Class::Cone).len(), pressed);
}

/// With friction in hinges the mode that locks is not known: the drawing says so, and shows none.
#[test]
fn why_there_is_no_picture_is_said() {
    let with_pendulum = slideway::gallery::find("drawer").unwrap().text.replace(
        "[points]",
        "[bodies.bob]\npoints = [\"O\"]\nmass = 1\ncentre_of_mass = [0.5, 1]\nmoment_of_inertia = 0.1\n\
         [joints.O]\ntype = \"hinge\"\nbetween = [\"bob.O\", \"ground.O\"]\nfriction_radius = 0.001\n\
         [coordinates.phi]\nrotation = \"bob\"\nrate = 1\n[points]\nO = [0, 1]",
    );
    let case = Case::new(&with_pendulum, &Settings::default().parameter("mu", "0.7"));
    let sheet = case.sheet(Shown::All).unwrap();
    assert!(sheet.description.contains("It jams"), "{}", sheet.description);
    let said = "The forces that lock it are not drawn: with friction in hinges they are not computed";
    assert!(sheet.description.contains(said), "{}", sheet.description);
    assert!(!sheet.description.contains("Why it jams."));
}

/// The push of 30 N acts 80 mm above the centre of mass, and friction, 0.2 times 20 N, 20 mm below it: both turn the block
/// clockwise as it goes to the right. So the reaction of 20 N would act (30 * 80 + 4 * 20) / 20 = 124 mm before the middle;
/// the block ends at 50 mm.
#[test]
fn a_block_that_tips_has_its_reaction_beyond_its_end() {
    let text = include_str!("../../../../docs/src/examples/guided-tips.toml");
    let case = Case::new(text, &Settings::default());
    let report = case.report.as_ref().unwrap();
    let [rejection] = &report.rejected[..] else { panic!("one: {report:?}") };
    assert!((rejection.couple.abs() - 2.48).abs() < 1e-9, "{rejection:?}");
    assert!((rejection.friction_forces[0].abs() - 4.0).abs() < 1e-9, "{rejection:?}");
    let sheet =
        sheet(&case.mechanism, &case.configuration, Some(Forces::InMotion(report)), Shown::All).unwrap();
    assert!(sheet.description.contains("Why it tips. The reaction"), "{}", sheet.description);
    let said = "would have to act 124 mm from its middle; it ends at 50 mm";
    assert!(sheet.description.contains(said), "{}", sheet.description);
}
