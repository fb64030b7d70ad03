//! Every model of the gallery, at several positions.

use crate::Case;
use slideway::mechanism::Joint;
use slideway::model::Settings;
use slideway_pictures::NotFinite;
use slideway_pictures::drawing::svg::{self, Colours, Frame};
use slideway_pictures::drawing::{
    Bounds, Class, ContactStates, Element, Forces, Point, Scene, SceneOptions, Shape, Sheet, Shown, Text,
    View, pieces, scene,
};
use slideway_pictures::theme::{DARK, LIGHT};
use std::iter::once;
use std::sync::LazyLock;

/// The models at several positions, and the templates, each with the sheet of all its drawings.
static CASES: LazyLock<Vec<(String, Case, Sheet)>> = LazyLock::new(|| {
    let with_sheet = |(name, case): (String, Case)| {
        let sheet = case.sheet(Shown::All).unwrap();
        (name, case, sheet)
    };
    cases().into_iter().map(with_sheet).collect()
});

/// Settings of coordinates by name.
fn cases() -> Vec<(String, Case)> {
    let elsewhere: [(&str, &[(&str, &str)]); 10] = [
        ("cam-follower", &[("lift", "20 mm")]),
        ("drawer", &[("x", "0.15 m")]),
        ("elliptic-trammel", &[("theta", "100 deg")]),
        ("klepp-2002", &[("q", "-0.4 m")]),
        ("scotch-yoke", &[("phi", "200 deg")]),
        ("sleeve-on-arm", &[("phi", "130 deg"), ("s", "0.6 m")]),
        ("slider-crank", &[("phi", "-75 deg")]),
        ("slider-crank", &[("phi", "179.99 deg")]),
        ("soft-closing-drawer", &[("x", "-50 mm")]),
        ("telescopic-boom", &[("s_1", "0.3 m"), ("s_3", "-0.4 m")]),
    ];
    let drawn = slideway::gallery::MODELS
        .iter()
        .map(|model| (model.name.to_owned(), Case::new(model.text, &Settings::default())));
    let moved = elsewhere.iter().map(|(name, positions)| {
        let text = slideway::gallery::find(name).unwrap().text;
        let settings = positions
            .iter()
            .fold(Settings::default(), |settings, (coordinate, value)| settings.position(coordinate, value));
        (format!("{name} at {positions:?}"), Case::new(text, &settings))
    });
    let templates = slideway::template::TEMPLATES.iter().map(|template| {
        (format!("template {}", template.name), Case::new(template.text, &Settings::default()))
    });
    drawn.chain(moved).chain(templates).collect()
}

#[test]
fn everything_is_within_the_view_box() {
    for (name, case, sheet) in &*CASES {
        for sheet in once(sheet).chain(&pieces(
            &case.mechanism,
            &case.configuration,
            case.report.as_ref().map(Forces::InMotion),
            None,
            f64::INFINITY,
        )) {
            within(name, sheet);
        }
    }
}

fn within(name: &str, sheet: &Sheet) {
    let bounds = sheet.bounds;
    for element in &sheet.scene.elements {
        let Some(inner) = element.shape.bounds() else { continue };
        assert!(
            bounds.contains(&inner.least) && bounds.contains(&inner.greatest),
            "{name}: {element:?} is not within {bounds:?}"
        );
    }
}

#[test]
fn no_two_texts_overlap() {
    for (name, _, sheet) in &*CASES {
        let texts: Vec<_> = sheet.scene.texts().map(|(_, text)| text).collect();
        for (index, text) in texts.iter().enumerate() {
            for other in &texts[..index] {
                // Lines of a paragraph stand close: their letters do not touch, their boxes nearly.
                assert!(!text.bounds().overlaps(&other.bounds()), "{name}: {text:?} over {other:?}");
            }
        }
    }
}

/// Letters over a dimension or over hatching are hard to read: each label has a place without.
#[test]
fn no_text_covers_a_dimension_or_hatching() {
    for (name, _, sheet) in &*CASES {
        let texts: Vec<_> = sheet.scene.texts().map(|(_, text)| (text, text.bounds())).collect();
        for class in [Class::Dimension, Class::Hatch] {
            for shape in of_class(&sheet.scene, class) {
                let Shape::Line(places) = shape else { continue };
                for place in places.windows(2).flat_map(|pair| between(pair[0], pair[1])) {
                    let covering = texts.iter().find(|(_, bounds)| bounds.contains(&place));
                    assert!(covering.is_none(), "{name}: {covering:?} covers a {class:?} at {place}");
                }
            }
        }
    }
}

/// Each value is the nearest of its colour to what it names, or a line leads there: no two stand beside one arrow.
#[test]
fn no_two_values_stand_beside_one_arrow() {
    for (name, _, sheet) in &*CASES {
        let leaders: Vec<_> = of_class(&sheet.scene, Class::Leader).collect();
        for class in [Class::Reaction, Class::Friction, Class::Load, Class::Drive, Class::Velocity] {
            let arrows: Vec<&Shape> =
                of_class(&sheet.scene, class).filter(|shape| !matches!(shape, Shape::Text(_))).collect();
            let of_class = sheet.scene.texts().filter(|(of, _)| *of == class).map(|(_, text)| text);
            let is_led = |text: &&Text| {
                let bounds = text.bounds().widened(1.0);
                let leads =
                    |leader: &&Shape| matches!(leader, Shape::Line(places) if bounds.contains(&places[0]));
                leaders.iter().any(leads)
            };
            // Arrows that begin at one place are equally near.
            let near = |text: &Text| -> Vec<usize> {
                let far: Vec<f64> = arrows.iter().map(|arrow| distance(&text.bounds(), arrow)).collect();
                let least = far.iter().copied().fold(f64::INFINITY, f64::min);
                (0..arrows.len()).filter(|index| far[*index] < least + 1.0).collect()
            };
            let mut texts: Vec<(&Text, Vec<usize>)> =
                of_class.filter(|text| !is_led(text)).map(|text| (text, near(text))).collect();
            texts.sort_by_key(|(_, near)| near.len());
            let mut named = Vec::new();
            for (text, near) in texts {
                let own = near.iter().find(|arrow| !named.contains(*arrow));
                named.push(*own.unwrap_or_else(|| panic!("{name}: {text:?} and another beside one arrow")));
            }
        }
    }
}

/// The distance of a text from the nearest place of a shape.
fn distance(text: &Bounds, shape: &Shape) -> f64 {
    let places: Vec<Point> = match shape {
        Shape::Arrow { from, to } => between(*from, *to).collect(),
        Shape::Head(tip, direction) => between(*tip - direction * 9.0, *tip).collect(),
        Shape::Line(places) => places.windows(2).flat_map(|pair| between(pair[0], pair[1])).collect(),
        _ => Vec::new(),
    };
    let far = places.iter().map(|place| (place - place.sup(&text.least).inf(&text.greatest)).norm());
    far.fold(f64::INFINITY, f64::min)
}

/// Places a unit apart on the way from one place to another.
fn between(from: Point, to: Point) -> impl Iterator<Item = Point> {
    let way = to - from;
    let steps = way.norm().ceil().max(1.0);
    std::iter::successors(Some(0.0), |step| Some(step + 1.0))
        .take_while(move |step| *step <= steps)
        .map(move |step| from + way * (step / steps))
}

/// A plank of 3 m on which a block of 0.12 m slides is torn off, so that the block fills more than a tenth of the
/// panel of 440 units; the plates of drawers are drawn whole.
#[test]
fn long_plates_are_torn_off_and_others_are_whole() {
    let plank = "mass = \"2 kg\"\ncentre_of_mass = \"belt\"\nshape = { rectangle = [\"3 m\", \"20 mm\"] }";
    let belt = slideway::gallery::find("stick-slip").unwrap().text;
    let case = Case::new(&belt.replace("massless = true", plank), &Settings::default());
    let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
    assert!(0.12 * view.scale > 44.0, "{}", view.scale);
    let [from, to] = view.cuts[0].unwrap();
    // All other places lie from the wall, half a metre to the left of the middle of the plank, to 0.3 m to the right.
    assert!(-1.0 < from && from < -0.5 && 0.3 < to && to < 1.0, "{from} {to}");
    assert_eq!(view.cuts[1], None);
    for name in ["drawer", "thrown-drawer", "scotch-yoke"] {
        let case = Case::gallery(name);
        let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
        assert!(view.cuts.iter().all(Option::is_none), "{name}");
    }
}

#[test]
fn every_solution_has_its_picture_and_caption() {
    for (name, case, sheet) in &*CASES {
        let has = |wanted: &str| sheet.scene.texts().any(|(_, text)| text.text.starts_with(wanted));
        assert!(has("The mechanism, to scale"), "{name}");
        let count = case.report.as_ref().map_or(0, |report| report.solutions.len());
        for number in 1..=count {
            assert!(has(&format!("Solution {number} of {count}")), "{name}");
        }
        assert!(!has(&format!("Solution {} of", count + 1)), "{name}");
        // Of a face that two joints have, the joint that touches is named.
        let is_elsewhere = |joint: &Joint| {
            let mut sliders = case.mechanism.sliders();
            let slider = sliders.find(|(id, _)| case.mechanism.joints[id.index()].name == joint.name);
            slider.is_some_and(|(id, _)| case.mechanism.is_apart_from_shared_face(id))
        };
        let mut joints = case.mechanism.joints.iter().filter(|joint| !is_elsewhere(joint));
        assert!(joints.all(|joint| has(&joint.name)), "{name}: joints are named");
    }
}

#[test]
fn a_solution_that_is_not_there_has_no_sheet() {
    let case = Case::gallery("drawer");
    let sheet = |number| case.sheet(Shown::Solution(number));
    assert!(sheet(1).is_some());
    assert!(sheet(2).is_none());
    assert!(sheet(0).is_none());
}

fn of_class(scene: &Scene, class: Class) -> impl Iterator<Item = &Shape> {
    scene
        .elements
        .iter()
        .filter(move |element| element.class == class)
        .map(|element: &Element| &element.shape)
}

fn arrows(scene: &Scene, class: Class) -> Vec<(Point, Point)> {
    of_class(scene, class)
        .filter_map(|shape| match shape {
            Shape::Arrow { from, to } => Some((*from, *to)),
            _ => None,
        })
        .collect()
}

/// The view and the picture of a solution, counted from 1.
fn contact_mode(case: &Case, number: usize, force_scale: f64) -> (View, Scene) {
    let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
    let solution = &case.report.as_ref().unwrap().solutions[number - 1];
    let options = SceneOptions { longest_arrow: f64::INFINITY, ..SceneOptions::contact_mode(force_scale) };
    let states = ContactStates::of(solution);
    let scene = scene(&case.mechanism, &case.configuration, &states, &view, &options);
    (view, scene)
}

/// Arrows of the paper's example: lengths are forces times the scale, reactions point along sign(N) n (up is
/// -y), friction against the motion to the right; arrows below 9 units are heads alone.
#[test]
fn arrows_are_proportional_to_forces() {
    let case = Case::gallery("klepp-2002");
    for number in 1..=3 {
        let force_scale = 5.0;
        let (_, scene) = contact_mode(&case, number, force_scale);
        let solution = &case.report.as_ref().unwrap().solutions[number - 1];
        let shown = |force: f64| force.abs() * force_scale >= 9.0;
        let normal: Vec<f64> = solution
            .contacts
            .iter()
            .map(|contact| contact.normal_force)
            .filter(|force| shown(*force))
            .collect();
        let reactions = arrows(&scene, Class::Reaction);
        assert_eq!(reactions.len(), normal.len());
        for ((from, to), force) in reactions.iter().zip(&normal) {
            let wanted = Point::new(0.0, -force * force_scale);
            assert!((to - from - wanted).norm() < 1e-9, "{from} {to} {force}");
        }
        let friction: Vec<f64> = solution
            .contacts
            .iter()
            .map(|contact| contact.friction_force)
            .filter(|force| shown(*force))
            .collect();
        for ((from, to), force) in arrows(&scene, Class::Friction).iter().zip(&friction) {
            let wanted = Point::new(-force * force_scale, 0.0);
            assert!((to - from - wanted).norm() < 1e-9, "{from} {to} {force}");
        }
    }
}

/// Where walls are: the y of horizontal ones in the drawing.
fn wall_heights(scene: &Scene) -> Vec<f64> {
    of_class(scene, Class::Wall)
        .filter_map(|shape| match shape {
            Shape::Line(places) if places.len() == 2 && (places[0].y - places[1].y).abs() < 1e-9 => {
                Some(places[0].y)
            }
            _ => None,
        })
        .collect()
}

/// The corners of the lower block of the paper's example.
fn lower_block(scene: &Scene) -> Vec<Point> {
    let four = |shape: &&Shape| matches!(shape, Shape::Area(corners) if corners.len() == 4);
    match of_class(scene, Class::Body).find(four) {
        Some(Shape::Area(corners)) => corners.clone(),
        other => panic!("the block has four corners: {other:?}"),
    }
}

/// Drawn flush, the corners of the lower block are where the model says: the points A +- b/2 along x, +- h/2
/// along y, with b = 0.2 m, h = 0.1 m and A at the origin.
#[test]
fn block_corners_are_where_the_model_says() {
    let case = Case::gallery("klepp-2002");
    let view = View::fitting(&case.mechanism, &[&case.configuration], [440.0, 320.0]);
    let states = ContactStates::default();
    let scene = scene(&case.mechanism, &case.configuration, &states, &view, &SceneOptions::overview());
    for corner in lower_block(&scene) {
        let near = [(-0.1, -0.05), (0.1, -0.05), (-0.1, 0.05), (0.1, 0.05)].iter().any(|(x, y)| {
            let place = Point::new(view.scale * (x - view.middle.x), -view.scale * (y - view.middle.y));
            (place - corner).norm() < 1e-9
        });
        assert!(near, "{corner}");
    }
}

/// In solution 1 (+ + -) the lower block touches below at its right end and above at its left end, in
/// solution 3 (- + +) it lies flat below, with the gap above.
#[test]
fn blocks_touch_the_walls_that_press_them() {
    let case = Case::gallery("klepp-2002");
    let extremes = |number: usize| {
        let (_, scene) = contact_mode(&case, number, 1.0);
        let corners = lower_block(&scene);
        let mut walls: Vec<f64> = wall_heights(&scene);
        walls.sort_by(f64::total_cmp);
        let [.., upper, lower] = walls[..] else { panic!("walls above and below the block") };
        (corners, upper, lower)
    };
    let (corners, upper, lower) = extremes(1);
    let highest = corners.iter().min_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
    let lowest = corners.iter().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
    // Half the height of a block that leans by 8 degrees grows by 1 - cos, 0.3 units here.
    assert!(
        (highest.y - upper).abs() < 0.5 && (lowest.y - lower).abs() < 0.5,
        "{highest} {upper} {lowest} {lower}"
    );
    assert!(highest.x < lowest.x, "tipped with its right end down");
    let (corners, upper, lower) = extremes(3);
    let highest = corners.iter().map(|corner| corner.y).fold(f64::INFINITY, f64::min);
    let lowest = corners.iter().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
    assert!((lowest - lower).abs() < 1e-6, "{lowest} {lower}");
    assert!(highest - upper > 4.0, "the gap can be seen");
}

#[test]
fn pictures_say_what_they_show_in_words_and_escape_names() {
    let text = slideway::gallery::find("klepp-2002").unwrap().text;
    let text = text.replace("A bar sliding in two horizontal slots", "A <b> & \\\"quoted\\\" title");
    let case = Case::new(&text, &Settings::default());
    let sheet = case.sheet(Shown::All).unwrap();
    for theme in [LIGHT, DARK] {
        let svg = svg::write(&sheet.scene, &sheet.frame(Some(800.0), Colours::Theme(theme))).unwrap();
        assert!(svg.contains("<title>A &lt;b&gt; &amp; &quot;quoted&quot; title</title>"));
        assert!(svg.contains("<desc>q = 0 m, rate 1 m/s It can go on in 2 ways"));
        assert!(svg.contains("width=\"800\"") && svg.contains(theme.background));
        assert!(slideway_pictures::raster::png(&svg, 0.5).is_ok());
    }
}

/// The picture of a second state of a motion has the same walls: the view says how far guides reach.
#[test]
fn one_view_serves_many_configurations() {
    let here = Case::gallery("klepp-2002");
    let there = Case::new(
        slideway::gallery::find("klepp-2002").unwrap().text,
        &Settings::default().position("q", "0.3 m"),
    );
    let view = View::fitting(&here.mechanism, &[&here.configuration, &there.configuration], [440.0, 320.0]);
    let walls = |case: &Case| {
        let options = SceneOptions { play: true, ..SceneOptions::overview() };
        let scene = scene(&case.mechanism, &case.configuration, &ContactStates::default(), &view, &options);
        let walls: Vec<Shape> = of_class(&scene, Class::Wall).cloned().collect();
        walls
    };
    let (first, second) = (walls(&here), walls(&there));
    assert!(!first.is_empty());
    assert_eq!(first, second);
}

#[test]
fn a_drawing_with_a_place_that_is_no_number_is_refused() {
    let case = Case::gallery("drawer");
    let sheet = case.sheet(Shown::All).unwrap();
    let write = |bounds: Bounds, scene: &Scene| {
        let frame = Frame { bounds, title: "", description: "", width: None, colours: Colours::Theme(LIGHT) };
        svg::write(scene, &frame)
    };
    assert!(write(sheet.bounds, &sheet.scene).is_ok());
    let wide = Bounds { greatest: Point::new(f64::INFINITY, 1.0), ..sheet.bounds };
    assert_eq!(write(wide, &sheet.scene), Err(NotFinite));
    for value in [f64::NAN, f64::INFINITY] {
        let mut scene = sheet.scene.clone();
        scene.add(Class::Pin, Shape::Circle(Point::new(0.0, value), 1.0));
        assert_eq!(write(sheet.bounds, &scene), Err(NotFinite));
    }
}
