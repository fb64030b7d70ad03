//! Loads in space: signs of forces along z, and cross-sections.

use super::Case;
use slideway::model::Settings;
use slideway_pictures::drawing::{Class, Element, Shape, Sheet, Shown};

/// A drawer on three corners with one face each: 60 N at 0.07 m to the left, pulled at the height c.
const DRAWER: &str = "gravity = [0, 0, -10]\n[parameters]\nc = 0.03\n[points]\nmiddle = [0, 0]\nload = [-0.02, 0.07, 0.05]\n\
    pull = [0.2, 0.2, \"c\"]\n[bodies.drawer]\npoints = [\"middle\", \"pull\"]\nmass = 6\ncentre_of_mass = \"load\"\n\
    shape = { box = [0.45, 0.5, 0.1] }\n[joints.guide]\ntype = \"block_slider\"\nblock = \"drawer\"\nat = \"middle\"\nalong = 0\n\
    length = 0.4\nmu = 0.3\nrests_on = { width = 0.5, corners = 3, one_sided = true, mu = 0.25 }\n[drives.pull]\n\
    coordinate = \"x\"\nforce = { at = \"drawer.pull\", direction = 0 }\n[coordinates.x]\nx = \"drawer.pull\"\nrate = 0.1\n";

fn drawn(c: &str) -> Sheet {
    Case::new(DRAWER, &Settings::default().parameter("c", c)).sheet(Shown::All).unwrap()
}

fn texts(sheet: &Sheet) -> Vec<String> {
    sheet.scene.texts().map(|(_, text)| text.text.clone()).collect()
}

fn count(sheet: &Sheet, is_one: impl Fn(&Element) -> bool) -> usize {
    sheet.scene.elements.iter().filter(|element| is_one(element)).count()
}

/// Three reactions out of the drawing in the plan, the pull in the section; the weight into it, beside the mechanism alone, too.
#[test]
fn forces_along_z_have_a_sign_with_a_key() {
    let sheet = drawn("0.03");
    // And one of each in the key, where the ring has the class of its sign.
    assert_eq!(
        count(&sheet, |one| one.class == Class::PointsOut && matches!(one.shape, Shape::Circle(..))),
        3 + 1 + 1
    );
    assert_eq!(count(&sheet, |one| one.class == Class::PointsIn), 2 * (2 + 1) + 1);
    let texts = texts(&sheet);
    for words in ["force out of the drawing", "force into the drawing", "weight 60 N"] {
        assert!(texts.iter().any(|text| text == words), "{words}: {texts:?}");
    }
}

/// The section has the force of every contact, the weight and the pull, by their names; what lifts off has the acceleration
/// of its gap.
#[test]
fn a_section_shows_all_forces_across_the_guide() {
    let texts = |c: &str| texts(&drawn(c));
    let lies = texts("0.03");
    for words in [
        "Section of guide",
        "front 6.964 N",
        "rear 6.964 N",
        "front_left 22.62 N",
        "front_right 5.819 N",
        "rear_middle 31.56 N",
    ] {
        assert!(lies.iter().any(|text| text == words), "{words}: {lies:?}");
    }
    assert!(lies.iter().any(|text| text == "pull 19.18 N"), "{lies:?}");
    let tips = texts("0.7");
    assert!(tips.iter().any(|text| text.starts_with("rear_middle lifts off, ")), "{tips:?}");
    assert!(tips.iter().any(|text| text.contains("front_left - front_right")), "{tips:?}");
}

/// The body is 0.1 m high: a pull above it has an arm.
#[test]
fn a_section_has_an_arm_to_a_load_outside_of_the_body() {
    let bodies = |c: &str| count(&drawn(c), |one| one.class == Class::Body);
    assert_eq!(bodies("0.12"), bodies("0.08") + 1);
}

/// Without a third coordinate there is no section.
#[test]
fn planar_models_have_no_section() {
    let text = slideway::gallery::find("drawer").unwrap().text;
    let sheet = Case::new(text, &Settings::default()).sheet(Shown::All).unwrap();
    assert!(!texts(&sheet).iter().any(|text| text.contains("ection of")));
}
