//! What stands in plots and maps: elements and coordinates, not bytes.

use slideway::gallery;
use slideway::limits::{LimitsOptions, Quantity, limits_with_curves};
use slideway::map::{ColourBy, MapOptions, map};
use slideway::model::{Model, Settings};
use slideway::motion::{SimulateOptions, simulate};
use slideway_pictures::NotFinite;
use slideway_pictures::motion::{AnimationOptions, animation, motion_figure, portrait_figure};
use slideway_pictures::plot::{self, Figure, limits_figure};
use slideway_pictures::theme::{DARK, LIGHT, Theme};
use slideway_pictures::typeface;

fn model(name: &str, settings: &[(&str, &str)]) -> Model {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(gallery::find(name).expect("in the gallery").text)
        .and_then(|model| model.with(&settings))
        .expect("a sound model")
}

fn figure(model: &Model, vary: &str) -> Figure {
    let options = LimitsOptions::new(vary.parse().expect("a range")).both_directions(true).effort(0);
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

/// Klepp (2002), figures 4 and 5: one solution on both sides of the locking value 2 cot(alpha) + 0.1 with
/// positive velocity and a second beyond it; with negative velocity a change of sides at cot(alpha) and none
/// beyond locking.
#[test]
fn the_paper_s_figures() {
    let klepp = model("klepp-2002", &[("F_20", "0")]);
    let svg = plot::to_svg(&figure(&klepp, "mu_1=0..0.8"), &LIGHT).expect("finite places");
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
    // In both panels the value of the model is marked, too.
    let is_of_model = |mark: &&str| (number(mark, "data-at") - 0.5).abs() < 1e-12;
    let (present, changes): (Vec<&str>, Vec<&str>) =
        of_class(&svg, "marked").into_iter().partition(is_of_model);
    assert_eq!((present.len(), changes.len()), (2, 1));
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
        "(unstable)",
        "excluded: no solution",
        "normal force in N",
        // To the right another solution stays, to the left none is left.
        "0.452654: grows without bound",
        "0.452654: it jams",
    ] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn curves_stay_within_frames_and_do_not_step() {
    for (name, vary) in
        [("klepp-2002", "mu_1=0..0.8"), ("slider-crank", "phi=-80 deg..80 deg"), ("drawer", "mu=0..1")]
    {
        let svg = plot::to_svg(&figure(&model(name, &[]), vary), &LIGHT).expect("finite places");
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
    let of_theme =
        |theme: &Theme| plot::to_svg(&figure(&klepp, "mu_1=0..0.8"), theme).expect("finite places");
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
        let options = MapOptions::new(x.parse().expect("a range"), y.parse().expect("a range"))
            .colour_by(colour_by)
            .size(160, 120);
        let report = map(&model(name, &[]), &options).expect("a map");
        let svg =
            slideway_pictures::map::to_svg(&report, &Settings::default(), &LIGHT).expect("finite places");
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

/// A text of a picture: left, top, right, bottom of its box, and what it says.
struct TextBox {
    edges: [f64; 4],
    text: String,
}

impl TextBox {
    fn overlaps(&self, other: &Self) -> bool {
        let ([a, b, c, d], [e, f, g, h]) = (self.edges, other.edges);
        a < g && e < c && b < h && f < d
    }
}

/// The boxes of all texts, those turned upright included; capitals are 0.73 of their size high in
/// `DejaVu Sans`, and tails reach 0.21 below the line (its tables hhea and OS/2 round to these).
fn texts(svg: &str) -> Vec<TextBox> {
    let mut inherited = 0.0;
    let mut boxes = Vec::new();
    for element in svg.split('<') {
        if element.starts_with("g ") {
            inherited =
                attribute(element, "font-size").map_or(inherited, |size| size.parse().expect("a size"));
        }
        let Some((head, content)) = element.strip_prefix("text ").and_then(|rest| rest.split_once('>'))
        else {
            continue;
        };
        let head = format!(" {head}");
        let size = attribute(&head, "font-size").map_or(inherited, |size| size.parse().expect("a size"));
        let text =
            content.replace("&#39;", "'").replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
        let (x, y, width) = (number(&head, "x"), number(&head, "y"), typeface::width(&text, size));
        let before = match attribute(&head, "text-anchor") {
            Some("middle") => 0.5 * width,
            Some("end") => width,
            _ => 0.0,
        };
        let (up, down) = (0.73 * size, 0.21 * size);
        let edges = if head.contains("rotate(-90") {
            [x - up, y - width + before, x + down, y + before]
        } else {
            [x - before, y - up, x - before + width, y + down]
        };
        boxes.push(TextBox { edges, text });
    }
    boxes
}

/// Maps, plots of limits, motions and phase portraits.
fn pictures() -> Vec<(String, String)> {
    let maps = [
        ("klepp-2002", "mu_1=0..0.8", "F_20=0 N..15 N", ColourBy::Solutions),
        ("klepp-2002", "mu_1=0..0.8", "alpha=60 deg..88 deg", ColourBy::Modes),
        ("slider-crank", "phi=-175 deg..175 deg", "mu=0..1.5", ColourBy::Modes),
        ("slider-crank", "phi=20 deg..90 deg", "l=45 mm..90 mm", ColourBy::Jam),
        ("drawer", "mu=0..1", "L=200 mm..500 mm", ColourBy::Margin),
    ];
    let mut pictures = Vec::new();
    for (name, x, y, colour_by) in maps {
        let options = MapOptions::new(x.parse().expect("a range"), y.parse().expect("a range"))
            .colour_by(colour_by)
            .size(40, 40);
        let report = map(&model(name, &[]), &options).expect("a map");
        pictures.push((
            format!("map of {name}"),
            slideway_pictures::map::to_svg(&report, &Settings::default(), &DARK).expect("finite places"),
        ));
    }
    let limits = [
        ("klepp-2002", "friction=0..10"),
        ("painleve-klein", "mu=0..5"),
        ("scotch-yoke", "phi=0 deg..360 deg"),
        ("telescopic-boom", "friction=0..6"),
        ("wedge", "friction=0..6"),
    ];
    for (name, vary) in limits {
        let figure = figure(&model(name, &[]), vary);
        pictures.push((format!("limits of {name}"), plot::to_svg(&figure, &LIGHT).expect("finite places")));
    }
    for name in ["frictional-oscillator", "klepp-2002-spring", "stick-slip", "telescopic-boom"] {
        let history = simulate(&model(name, &[]), &SimulateOptions::new(0.5)).expect("a motion");
        pictures.push((
            format!("motion of {name}"),
            plot::to_svg(&motion_figure(&history), &LIGHT).expect("finite places"),
        ));
        pictures.push((
            format!("portrait of {name}"),
            plot::to_svg(&portrait_figure(&history), &LIGHT).expect("finite places"),
        ));
    }
    pictures
}

/// With at least 4 px around it.
#[test]
fn all_text_is_within_the_picture_and_none_over_another() {
    for (name, svg) in pictures() {
        let [width, height] = ["width", "height"].map(|side| number(&svg, side));
        let texts = texts(&svg);
        assert!(texts.len() > 8, "{name}");
        for (index, one) in texts.iter().enumerate() {
            let [left, top, right, bottom] = one.edges;
            let is_within = left >= 4.0 && top >= 4.0 && right <= width - 4.0 && bottom <= height - 4.0;
            assert!(is_within, "{name}: {} at {:?} of {width} x {height}", one.text, one.edges);
            for other in &texts[..index] {
                assert!(!one.overlaps(other), "{name}: {} over {}", one.text, other.text);
            }
        }
    }
}

/// A frame by itself is taller than one of several, and may have closer ticks, with longer numbers: 2.5 where the lower
/// one has 2 and 3. The name of the axis keeps clear of them.
#[test]
fn numbers_of_a_tall_frame_have_room() {
    let curve = plot::Curve {
        branch: 0,
        quantity: 0,
        points: vec![[0.0, 0.0], [1.0, 3.2]],
        ends: Default::default(),
    };
    let axis =
        |name: &str, range| plot::Axis { name: name.to_owned(), range: Some(range), ..plot::Axis::default() };
    let panel = plot::Panel {
        x: axis("x", [0.0, 1.0]),
        y: axis("safety factor", [0.0, 3.2]),
        curves: vec![curve],
        ..plot::Panel::default()
    };
    let branch = plot::Branch { name: "a".to_owned(), colour: 0, stroke: plot::Stroke::Solid };
    let figure = plot::Figure { panels: vec![panel], branches: vec![branch], ..plot::Figure::default() };
    let svg = plot::to_svg(&figure, &LIGHT).expect("finite places");
    let texts = texts(&svg);
    let find = |wanted: &str| texts.iter().find(|text| text.text == wanted).expect(wanted);
    assert!(find("safety factor").edges[2] + 4.0 < find("2.5").edges[0]);
}

/// A phase portrait does not touch its frame, and pieces of curves that merely cross others are as thin as
/// the rest.
#[test]
fn curves_of_motions_keep_clear_of_frames_and_have_one_width() {
    let oscillator =
        simulate(&model("frictional-oscillator", &[]), &SimulateOptions::new(1.0)).expect("a motion");
    let svg = plot::to_svg(&portrait_figure(&oscillator), &LIGHT).expect("finite places");
    let [frame] = of_class(&svg, "frame")[..] else { panic!("one frame") };
    let (left, right) = (number(frame, "x"), number(frame, "x") + number(frame, "width"));
    let curves = of_class(&svg, "curve");
    let parts = curves.iter().flat_map(|curve| points(attribute(curve, "d").expect("data")));
    for [x, _] in parts.flatten() {
        assert!(left + 5.0 < x && x < right - 5.0, "{x} of {left} to {right}");
    }
    let crank = simulate(&model("slider-crank", &[]), &SimulateOptions::new(0.3)).expect("a motion");
    let svg = plot::to_svg(&motion_figure(&crank), &LIGHT).expect("finite places");
    let energy = svg.rsplit("class=\"panel\"").next().expect("a last panel");
    let widths: Vec<f64> =
        of_class(energy, "curve").iter().map(|curve| number(curve, "stroke-width")).collect();
    assert!(widths.len() > 40, "many phases");
    assert!(widths.iter().all(|width| *width == 2.2), "{widths:?}");
}

/// No picture with a place that is no number is given out, whatever kind it is.
#[test]
fn places_that_are_not_finite_are_refused() {
    // A mark is drawn wherever it is; a range as wide as all numbers has no scale.
    let mut limits = figure(&model("klepp-2002", &[]), "mu_1=0..0.8");
    assert!(plot::to_svg(&limits, &LIGHT).is_ok());
    limits.panels[0].x.range = Some([-f64::MAX, f64::MAX]);
    assert_eq!(plot::to_svg(&limits, &LIGHT), Err(NotFinite));

    // Frames of a motion in slow motion: they stand longer than there are numbers for.
    let history = simulate(&model("drawer", &[]), &SimulateOptions::new(20.0)).expect("a motion");
    let shown =
        |slow_motion| animation(&history, &AnimationOptions { slow_motion: Some(slow_motion) }, &LIGHT);
    assert!(shown(1.0).to_svg().is_ok() && shown(1.0).to_html().is_ok());
    assert_eq!(shown(f64::MAX).to_svg(), Err(NotFinite));
    assert_eq!(shown(f64::MAX).to_html(), Err(NotFinite));
    assert!(shown(f64::MAX).to_gif(&mut |_| std::ops::ControlFlow::Continue(())).is_err());
}
