//! Drawings of one mechanism in several states, with the scale of forces and the place of the first.

use crate::Case;
use slideway::model::Settings;
use slideway_pictures::drawing::{Class, Forces, Held, Shape, Sheet, pieces};

/// The drawing of the only solution of the drawer, and its greatest normal force (N).
fn drawer(mu: &str, held: Option<&Held>) -> (Sheet, f64) {
    drawer_within(mu, held, f64::INFINITY)
}

/// The same, not wider than this.
fn drawer_within(mu: &str, held: Option<&Held>, most: f64) -> (Sheet, f64) {
    let settings = Settings::default().parameter("mu", mu);
    let case = Case::new(slideway::gallery::find("drawer").unwrap().text, &settings);
    let report = case.report.as_ref().unwrap();
    let forces = report.solutions[0].contacts.iter().map(|contact| contact.normal_force.abs());
    let sheet =
        pieces(&case.mechanism, &case.configuration, Some(Forces::InMotion(report)), held, most).remove(1);
    (sheet, forces.fold(0.0, f64::max))
}

fn longest_reaction(sheet: &Sheet) -> f64 {
    let reactions = sheet.scene.elements.iter().filter(|element| element.class == Class::Reaction);
    let lengths = reactions.filter_map(|element| match &element.shape {
        Shape::Arrow { from, to } if from.y != to.y => Some((to - from).norm()),
        _ => None,
    });
    lengths.fold(0.0, f64::max)
}

fn broken(sheet: &Sheet) -> bool {
    sheet.scene.elements.iter().any(|element| element.class == Class::Break)
}

/// Arrows are as many times as long as their forces are as large, until there is no room: then they are broken.
#[test]
fn arrows_grow_with_their_forces_at_a_scale_that_is_held() {
    let (first, force) = drawer("0.3", None);
    let held = first.held.unwrap();
    assert!(!broken(&first));
    for mu in ["0.1", "0.3", "0.45"] {
        let (sheet, now) = drawer(mu, Some(&held));
        let times = longest_reaction(&sheet) / longest_reaction(&first);
        assert!((times - now / force).abs() < 1e-6, "{mu}: {times}, {}", now / force);
        assert_eq!(sheet.held.unwrap().longest_force, held.longest_force);
    }
    // By itself every drawing has the same longest arrow.
    let (near, _) = drawer("0.66", None);
    assert!((longest_reaction(&near) - longest_reaction(&first)).abs() < 1e-6);
    let (near, now) = drawer("0.66", Some(&held));
    let times = longest_reaction(&near) / longest_reaction(&first);
    assert!(broken(&near) && 1.0 < times && times < now / force, "{times}");
}

/// What stands on ground is in the same place of each picture from the second on, as the first has made room for no more
/// than it needs itself.
#[test]
fn a_place_that_is_held_grows_and_never_shrinks() {
    let (first, _) = drawer("0.3", None);
    let (second, _) = drawer("0.6", first.held.as_ref());
    let (third, _) = drawer("0.3", second.held.as_ref());
    let [one, two] = [first.clone(), second.clone()].map(|sheet| sheet.held.unwrap().place);
    assert_eq!(one.with(two), two);
    assert_eq!(third.held, second.held);
    // What one drawing has taken is enough for it.
    let (again, _) = drawer("0.55", first.held.as_ref());
    assert_eq!(drawer("0.55", again.held.as_ref()).0, again);
    let walls = |sheet: &Sheet| -> Vec<Shape> {
        let walls = sheet.scene.elements.iter().filter(|element| element.class == Class::Wall);
        walls.map(|element| element.shape.clone()).collect()
    };
    assert!(!walls(&second).is_empty());
    assert_eq!(walls(&third), walls(&second));
}

/// A phone shows 440 drawing units side by side at which the smallest texts have 11 pixels.
#[test]
fn drawings_are_as_narrow_as_is_asked_for() {
    const PHONE: f64 = 440.0;
    for model in slideway::gallery::MODELS {
        let case = Case::gallery(model.name);
        let drawn = |most| {
            pieces(
                &case.mechanism,
                &case.configuration,
                case.report.as_ref().map(Forces::InMotion),
                None,
                most,
            )
        };
        // The labels of this one need more.
        let most = if model.name == "telescopic-boom" { 475.0 } else { PHONE };
        for sheet in drawn(PHONE) {
            assert!(sheet.bounds.size().x <= most, "{}: {:?}", model.name, sheet.bounds);
        }
        // Nothing is smaller than it has to be.
        let widest = |sheets: &[Sheet]| sheets.iter().map(|sheet| sheet.bounds.size().x).fold(0.0, f64::max);
        let free = drawn(f64::INFINITY);
        if widest(&free) < 0.8 * PHONE {
            assert_eq!(drawn(PHONE), free, "{}", model.name);
        }
    }
    // Forces grow, and the drawing with them: it stays on the screen.
    let mut held = drawer_within("0.3", None, PHONE).0.held;
    for mu in ["0.5", "0.62", "0.66", "0.4"] {
        let (sheet, _) = drawer_within(mu, held.as_ref(), PHONE);
        assert!(sheet.bounds.size().x <= PHONE, "{mu}: {:?}", sheet.bounds);
        held = sheet.held;
    }
}
