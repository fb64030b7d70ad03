//! What stands in plots and maps: elements and coordinates, not bytes.

use slideway::gallery;
use slideway::limits::{LimitsOptions, Quantity, limits_with_curves};
use slideway::map::{ColourBy, MapOptions, map};
use slideway::model::{Model, Settings};
use slideway_pictures::plot::{self, Figure, limits_figure};
use slideway_pictures::theme::{DARK, LIGHT, Theme};

fn model(name: &str, settings: &[(&str, &str)]) -> Model {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(gallery::find(name).expect("in the gallery").text)
        .and_then(|model| model.with(&settings))
        .expect("a sound model")
}

fn figure(model: &Model, vary: &str) -> Figure {
    let options = LimitsOptions { both_directions: true, ..LimitsOptions::of(vary) };
    let (report, curves) = limits_with_curves(model, &options, Quantity::NormalForce).expect("limits");
    limits_figure(&report, &curves)
}

/// The elements of a class, as their text from `<` to `>`.
fn of_class<'s>(svg: &'s str, class: &str) -> Vec<&'s str> {
    let wanted = format!("class=\"{class}\"");
    svg.split('<').filter(|element| element.contains(&wanted)).collect()
}

fn attribute<'e>(element: &'e str, name: &str) -> Option<&'e str> {
    let start = element.find(&format!(" {name}=\""))? + name.len() + 3;
    element[start..].split('"').next()
}

fn number(element: &str, name: &str) -> f64 {
    attribute(element, name)
        .and_then(|text| text.parse().ok())
        .unwrap_or_else(|| panic!("{name} of {element}"))
}

/// The points of path data that has only M, L and Z.
fn points(path: &str) -> Vec<Vec<[f64; 2]>> {
    let point = |text: &str| {
        let (x, y) = text.trim_end_matches('Z').split_once(' ').expect("two numbers");
        [x.parse().expect("x"), y.parse().expect("y")]
    };
    path.split('M').skip(1).map(|part| part.split('L').map(point).collect()).collect()
}

/// Klepp (2002), figures 4 and 5: one solution on both sides of the locking value 2 cot(alpha) + 0.1 with positive
/// velocity and a second beyond it; with negative velocity a change of sides at cot(alpha) and none beyond locking.
#[test]
fn the_paper_s_figures() {
    let klepp = model("klepp-2002", &[("F_20", "0")]);
    let svg = plot::to_svg(&figure(&klepp, "mu_1=0..0.8"), &LIGHT);
    let frames = of_class(&svg, "frame");
    assert_eq!(frames.len(), 2);
    let cotangent = 1.0 / 80.0_f64.to_radians().tan();
    let place = |frame: &str, mu: f64| number(frame, "x") + number(frame, "width") * mu / 0.8;
    let asymptotes = of_class(&svg, "asymptote");
    assert_eq!(asymptotes.len(), 2, "one for each direction");
    for (asymptote, frame) in asymptotes.iter().zip(&frames) {
        assert!((number(asymptote, "data-at") - (2.0 * cotangent + 0.1)).abs() < 1e-8);
        assert!((number(asymptote, "x1") - place(frame, 2.0 * cotangent + 0.1)).abs() < 0.01);
    }
    let changes = of_class(&svg, "marked");
    assert_eq!(changes.len(), 1);
    assert!((number(changes[0], "data-at") - cotangent).abs() < 1e-8);
    let [zone] = of_class(&svg, "zone")[..] else { panic!("one excluded interval") };
    assert!((number(zone, "x") - place(frames[1], 2.0 * cotangent + 0.1)).abs() < 0.02);
    assert!((number(zone, "x") + number(zone, "width") - place(frames[1], 0.8)).abs() < 0.02);
    // Three reactions of two modes in each panel; only the threshold beyond the locking value is dashed.
    let curves = of_class(&svg, "curve");
    assert_eq!(curves.len(), 12);
    let dashed: Vec<&&str> = curves.iter().filter(|curve| curve.contains("stroke-dasharray")).collect();
    assert_eq!(dashed.len(), 3);
    for curve in dashed {
        let path = points(attribute(curve, "d").expect("data"));
        let left = path.iter().flatten().map(|point| point[0]).fold(f64::INFINITY, f64::min);
        assert!(left > place(frames[0], 2.0 * cotangent + 0.1));
    }
    for words in [
        "upper on the lower side of the slot",
        "threshold, not attainable",
        "excluded: no solution",
        "normal force in N",
    ] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn curves_stay_within_frames_and_do_not_step() {
    for (name, vary) in
        [("klepp-2002", "mu_1=0..0.8"), ("slider-crank", "phi=-80 deg..80 deg"), ("drawer", "mu=0..1")]
    {
        let svg = plot::to_svg(&figure(&model(name, &[]), vary), &LIGHT);
        let frames = of_class(&svg, "frame");
        for curve in of_class(&svg, "curve") {
            for part in points(attribute(curve, "d").expect("data")) {
                let inside = |frame: &&str| {
                    let [left, top] = [number(frame, "x") - 0.01, number(frame, "y") - 0.01];
                    let [right, bottom] =
                        [left + number(frame, "width") + 0.02, top + number(frame, "height") + 0.02];
                    part.iter().all(|[x, y]| left <= *x && *x <= right && top <= *y && *y <= bottom)
                };
                assert!(frames.iter().any(inside), "{name}: {curve}");
                // No corner sharper than 30 degrees between long lines.
                for three in part.windows(3) {
                    let step = |one: [f64; 2], two: [f64; 2]| [two[0] - one[0], two[1] - one[1]];
                    let (one, two) = (step(three[0], three[1]), step(three[1], three[2]));
                    let (a, b) = (one[0].hypot(one[1]), two[0].hypot(two[1]));
                    let straight = (one[0] * two[0] + one[1] * two[1]) / (a * b);
                    assert!(a < 3.0 || b < 3.0 || straight > 0.86, "{name}: {three:?}");
                }
            }
        }
    }
}

#[test]
fn themes_have_their_colours_and_pictures_are_reproducible() {
    let klepp = model("klepp-2002", &[]);
    let of_theme = |theme: &Theme| plot::to_svg(&figure(&klepp, "mu_1=0..0.8"), theme);
    assert_eq!(of_theme(&DARK), of_theme(&DARK));
    assert!(of_theme(&DARK).contains(DARK.background) && !of_theme(&DARK).contains(LIGHT.ink));
    assert!(of_theme(&LIGHT).contains(LIGHT.series[1]));
}

/// Twice the signed area of a polygon, by the shoelace formula.
fn area(polygon: &[[f64; 2]]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(one, two)| one[0] * two[1] - two[0] * one[1]).sum()
}

#[test]
fn regions_of_a_map_cover_their_pixels() {
    let planes = [
        ("klepp-2002", "mu_1=0..0.8", "F_20=0..15", ColourBy::Solutions),
        ("klepp-2002", "mu_1=0..0.8", "alpha=60 deg..88 deg", ColourBy::Modes),
        ("drawer", "mu=0..1", "L=200 mm..500 mm", ColourBy::Margin),
    ];
    for (name, x, y, colour_by) in planes {
        let options = MapOptions { width: 160, height: 120, colour_by, ..MapOptions::of(x, y) };
        let report = map(&model(name, &[]), &options).expect("a map");
        let svg = slideway_pictures::map::to_svg(&report, &LIGHT);
        let [frame] = of_class(&svg, "frame")[..] else { panic!("one frame") };
        let whole = number(frame, "width") * number(frame, "height");
        let regions = of_class(&svg, "region");
        assert_eq!(regions.len(), report.classes.len());
        let mut sum = 0.0;
        for (region, class) in regions.iter().zip(&report.classes) {
            let share: f64 = points(attribute(region, "d").expect("data"))
                .iter()
                .map(|polygon| -area(polygon) / 2.0 / whole)
                .sum();
            let expected = class.pixels as f64 / (160.0 * 120.0);
            // Straightened boundaries keep areas to a small part of the pixels along them.
            assert!((share - expected).abs() < 0.003, "{name} {}: {share} {expected}", class.words);
            sum += share;
        }
        // Neighbours share their boundaries: nothing is left out or covered twice.
        assert!((sum - 1.0).abs() < 1e-3, "{name}: {sum}");
        assert_eq!(of_class(&svg, "model").len(), 4, "the model lies on the map");
    }
}
