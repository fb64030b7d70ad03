//! What plots show of what they are given: where curves are cut, what coincides, what is marked. Numbers are those
//! of closed forms.

use slideway::drive::{DriveOptions, drive};
use slideway::gallery;
use slideway::limits::{LimitsOptions, Quantity, Vary, limits_with_curves};
use slideway::map::{ColourBy, MapOptions, map};
use slideway::model::{Model, Settings};
use slideway::motion::{Cause, SimulateOptions, simulate};
use slideway::size::{SizeOptions, size};
use slideway_pictures::motion::{AnimationOptions, animation, motion_figure, portrait_figure};
use slideway_pictures::plot::{
    Branch, Curve, Figure, Panel, PointKind, Stroke, drive_figure, limits_figure, size_figure, to_svg,
};
use slideway_pictures::theme::LIGHT;

fn model(name: &str, settings: &Settings) -> Model {
    Model::parse(gallery::find(name).expect("in the gallery").text)
        .and_then(|model| model.with(settings))
        .expect("a sound model")
}

fn svg(figure: &Figure) -> String {
    to_svg(figure, &LIGHT).expect("finite places")
}

/// The texts of a picture.
fn texts(svg: &str) -> Vec<String> {
    let elements = svg.split("<text ").skip(1);
    let content = elements.filter_map(|element| element.split_once('>')?.1.split('<').next());
    content.map(|text| text.replace('\u{a0}', " ")).collect()
}

/// The drawer locks at mu = L / (2 a) = 2/3, 20/9 times its friction; the push is Q / (1 - 2 mu a / L), 20 N
/// without friction.
#[test]
fn what_is_excluded_leaves_room_for_the_rest_and_cuts_are_named() {
    let drawer = model("drawer", &Settings::default());
    let options = LimitsOptions::new(Vary::between("friction", 0.0, 10.0)).effort(0);
    let (report, curves) = limits_with_curves(&drawer, &options, Quantity::Effort).expect("limits");
    let settings = Settings::default().parameter("Q", "20 N").position("x", 0.0);
    let figure = limits_figure(&report, &curves).changed_by(&settings);
    // A quarter of the width is left for what goes on to 10.
    let [from, to] = figure.panels[0].x.range.expect("a range");
    assert!(from == 0.0 && (to - 20.0 / 9.0 * 4.0 / 3.0).abs() < 1e-4, "{to}");
    let picture = svg(&figure);
    let texts = texts(&picture);
    for wanted in [
        "A drawer pushed off-centre: effort over the factor of all friction",
        "With Q = 20 N, x = 0",
        // At 85 % of the way to locking it is 20 N / 0.15 = 133 N; the axis has ticks every 50 N.
        "cut at 150 N: grows without bound",
        "excluded: no solution, up to 10 (the axis ends before)",
    ] {
        assert!(texts.iter().any(|text| text == wanted), "{wanted}: {texts:?}");
    }
    assert_eq!(picture.matches("class=\"cut\"").count(), 2, "one on the curve, one in the legend");
}

/// The drawer that is braked: reactions grow to 633 N in the last moments before it stops (book, chapter Motion),
/// and are 2.6 N before.
#[test]
fn forces_that_last_are_shown_and_the_greatest_is_named() {
    let drawer = model("thrown-drawer", &Settings::default().parameter("x_s", "0.2 m"));
    let history = simulate(&drawer, &SimulateOptions::new(0.6)).expect("a motion");
    let figure = motion_figure(&history);
    let [least, greatest] = figure.panels[1].y.range.expect("a range that leaves something out");
    assert!(least < -10.0 && greatest > 10.0 && greatest < 100.0, "{least} {greatest}");
    let picture = svg(&figure);
    let texts = texts(&picture);
    assert!(
        texts.iter().any(|text| text.starts_with("cut at") && text.contains("reaches \u{2212}63")),
        "{texts:?}"
    );
    assert!(
        texts.iter().any(|text| text == "\u{2212} +: drawer touching at upper right and lower left"),
        "{texts:?}"
    );
    let points: Vec<PointKind> =
        portrait_figure(&history).panels[0].points.iter().map(|point| point.kind).collect();
    assert_eq!(points, [PointKind::Stop, PointKind::Start]);
}

/// The drawer jams once (`models/thrown-drawer.toml` says where); the bar that has stopped sticks in both of its
/// guides, where statics leaves its forces open; the belt moves 0.2 m while its block swings by 0.05 m, the fourth
/// part, in one second, and 0.4 m in two.
#[test]
fn motions_tell_where_they_jam_and_which_forces_are_open() {
    let of = |name: &str, settings: &Settings, until: f64| {
        let history = simulate(&model(name, settings), &SimulateOptions::new(until)).expect("a motion");
        (motion_figure(&history), history)
    };
    let (jammed, history) = of("thrown-drawer", &Settings::default(), 0.6);
    let at = history.events[1].time;
    for panel in &jammed.panels {
        let [jam] = &panel.marked[..] else { panic!("{:?}", panel.marked) };
        assert!(jam.at == at && jam.label.ends_with(": jams"), "{jam:?}");
        // Jammed, it is pressed at two corners: the normal forces are determined, how they share the friction is not.
        let is_open = panel.y.name == "friction";
        assert_eq!(
            panel.zones.iter().map(|zone| zone.from == at).collect::<Vec<_>>(),
            vec![true; usize::from(is_open)]
        );
    }
    let (stuck, history) = of("klepp-2002-spring", &Settings::default().parameter("mu_1", "0.5"), 0.3);
    let [zone] = &stuck.panels[1].zones[..] else { panic!("{:?}", stuck.panels[1].zones) };
    assert!((zone.from - history.events[1].time).abs() < 1e-12 && (zone.to - 0.3).abs() < 1e-9, "{zone:?}");
    assert!(texts(&svg(&stuck)).contains(&"sticks: statics leaves forces open".to_owned()));
    assert!(stuck.panels.iter().all(|panel| panel.marked.is_empty()));
    let (apart, _) = of("stick-slip", &Settings::default(), 2.0);
    let axes: Vec<&str> = apart.panels.iter().map(|panel| &*panel.y.name).collect();
    assert_eq!(axes[..2], ["belt", "x"]);
}

/// A block that slides without friction at 1 m/s against a stop of restitution 0.5 leaves it at -0.5 m/s, and one that
/// jams loses m v^2/2. Elsewhere rates do not jump.
#[test]
fn portraits_show_jumps_of_rates() {
    let bouncing = Model::parse(
        r#"
        [points]
        S = [0, 0]
        [bodies.block]
        points = ["S"]
        mass = "2 kg"
        moment_of_inertia = "1 kg m^2"
        centre_of_mass = "S"
        [joints.rail]
        type = "block_slider"
        block = "block"
        guide = "ground"
        at = "S"
        along = "0 deg"
        length = "0.1 m"
        mu = 0
        travel = ["-1 m", "1 m"]
        stop = { greatest = { restitution = 0.5 } }
        [coordinates.x]
        slide = "rail"
        rate = "1 m/s"
        "#,
    )
    .expect("a sound model");
    let jumps = |model: &Model, time: f64| {
        let history = simulate(model, &SimulateOptions::new(time)).expect("a motion");
        let figure = portrait_figure(&history);
        let is_jump = |branch: usize| figure.branches[branch].stroke == Stroke::Dashed;
        let dashed = figure.panels[0].curves.iter().filter(|curve| is_jump(curve.branch));
        let jumps: Vec<Vec<[f64; 2]>> = dashed.map(|curve| curve.points.clone()).collect();
        (jumps, history, svg(&figure))
    };
    let are = |jumps: &[Vec<[f64; 2]>], expected: &[[f64; 2]]| {
        let [jump] = jumps else { panic!("one jump: {jumps:?}") };
        for (one, other) in jump.iter().flatten().zip(expected.iter().flatten()) {
            assert!((one - other).abs() < 1e-6, "{jump:?}");
        }
    };
    let (stop, _, picture) = jumps(&bouncing, 1.5);
    are(&stop, &[[1.0, 1.0], [1.0, -0.5]]);
    assert!(texts(&picture).contains(&"rate of x jumps".to_owned()), "{:?}", texts(&picture));

    let (jam, history, _) = jumps(&model("thrown-drawer", &Settings::default()), 0.6);
    let lost = history.events.iter().flat_map(|event| &event.causes).find_map(|cause| match cause {
        Cause::Jams { energy_lost } => Some(*energy_lost),
        _ => None,
    });
    let rate = (2.0 * lost.expect("it jams") / 4.0).sqrt();
    are(&jam, &[[0.3, rate], [0.3, 0.0]]);

    let (none, _, picture) = jumps(&model("frictional-oscillator", &Settings::default()), 0.5);
    assert!(none.is_empty() && !picture.contains("jumps"), "{none:?}");
}

/// Both ends of the block on the line of its spring carry m g / 2 all the time: one line in two colours, with both names.
#[test]
fn what_coincides_is_one_line_with_both_names() {
    let text = slideway::gallery::find("frictional-oscillator").expect("in the gallery").text;
    let text = text.replace("guided_slider", "block_slider").replace("at = \"sole\"", "at = \"S\"");
    let oscillator = Model::parse(&text).expect("a sound model");
    let history = simulate(&oscillator, &SimulateOptions::new(0.5)).expect("a motion");
    let picture = svg(&motion_figure(&history));
    let forces = picture.split("class=\"panel\"").nth(2).expect("the panel of forces");
    let (panel, legend) = forces.split_once("class=\"legend\"").expect("a legend");
    let count = |class: &str| panel.matches(&format!("class=\"{class}\"")).count();
    // It reverses at 0.0954 s, 0.2941 s and 0.4928 s (book, chapter Motion): four phases.
    assert_eq!((count("curve"), count("coincident")), (4, 4), "one line for each phase");
    assert!(legend.contains(">floor.front and floor.rear coincide at this scale<"), "{legend}");
    assert!(!legend.contains(">floor.front<"), "{legend}");
    let kinds: Vec<PointKind> =
        portrait_figure(&history).panels[0].points.iter().map(|point| point.kind).collect();
    assert_eq!(kinds, [PointKind::Start, PointKind::End], "still moving");
    let portrait = svg(&portrait_figure(&history));
    assert!(portrait.matches("class=\"direction\"").count() > 10);
    // So does the line below each frame where there is no page around it.
    let moving = animation(&history, &AnimationOptions::default(), &LIGHT).to_svg().expect("finite places");
    assert!(
        moving.contains("mode + +: block is flat on the lower guide, sliding to the right</text>"),
        "{moving}"
    );
    // The page of the moving picture tells modes in words, once each, and has a scale of forces.
    let page = animation(&history, &AnimationOptions::default(), &LIGHT).to_html().expect("finite places");
    let words = page.split("const words = ").nth(1).and_then(|rest| rest.split(';').next()).expect("words");
    for direction in ["to the right", "to the left"] {
        let told = format!("\"block is flat on the lower guide, sliding {direction}\"");
        assert_eq!(words.matches(&told).count(), 1, "{words}");
    }
    // Its key names the colour of each kind of arrow that occurs.
    let key =
        page.split("<ul class=\"key\"").nth(1).and_then(|rest| rest.split("</ul>").next()).expect("a key");
    let meanings: Vec<&str> =
        key.split("</svg> ").skip(1).filter_map(|rest| rest.split('<').next()).collect();
    assert_eq!(
        meanings,
        [
            "normal reaction on the block",
            "friction on the block",
            "load, weight or drive",
            "sliding velocity",
            "not to scale"
        ],
        "{key}"
    );
    // 4.905 N are 80 px long, so that 3.68 N would be 60 px, the longest that the scale may be.
    assert!(page.contains(">2 N</text></svg>") || page.contains(">2 N</text>\n</svg>"), "a scale of forces");
}

/// What differs by 2 % is not said to coincide, and no curve is drawn anywhere but at its own values: those of two motions
/// that both begin at zero and grow apart, as 1.02 is from 1.
#[test]
fn curves_that_differ_are_told_apart() {
    let curve = |branch: usize, slope: f64| Curve {
        branch,
        quantity: 0,
        points: (0..=100).map(|step| [f64::from(step), slope * f64::from(step)]).collect(),
        ends: Default::default(),
    };
    let branch = |name: &str| Branch { name: name.to_owned(), colour: 0, stroke: Stroke::Solid };
    let figure = |slope: f64| Figure {
        branches: vec![branch("one"), branch("other")],
        panels: vec![Panel { curves: vec![curve(0, 1.0), curve(1, slope)], ..Panel::default() }],
        ..Figure::default()
    };
    let (apart, same) = (svg(&figure(1.02)), svg(&figure(1.0)));
    assert!(!apart.contains("coincide"), "{apart}");
    assert_eq!(apart.matches("class=\"curve\"").count(), 2);
    let ends: Vec<f64> = apart
        .split("class=\"curve\"")
        .skip(1)
        .map(|path| path.split(" d=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a path"))
        .map(|path| {
            path.split(['M', 'L'])
                .nth(1)
                .expect("a place")
                .split(' ')
                .nth(1)
                .expect("y")
                .trim()
                .parse()
                .expect("a number")
        })
        .collect();
    assert!((ends[0] - ends[1]).abs() < 0.1, "both begin at zero: {ends:?}");
    assert!(same.contains(">one and other coincide at this scale<"));
}

/// The numbers of an attribute of an SVG element.
fn numbers(markup: &str, attribute: &str) -> Vec<f64> {
    let value = markup.split(&format!(" {attribute}=\"")).nth(1).and_then(|rest| rest.split('"').next());
    let numbers = value.expect("it has the attribute").split([' ', ',']);
    numbers.map(|number| number.parse().expect("a number")).collect()
}

/// While hinges turn, the lines of their forces touch the friction circles, whose scale is told.
#[test]
fn moving_pictures_show_the_friction_circles_of_hinges() {
    let crank = model("slider-crank-with-pins", &Settings::default());
    let history = simulate(&crank, &SimulateOptions::new(0.02)).expect("a motion");
    let moving = animation(&history, &AnimationOptions::default(), &LIGHT);
    let film = moving.film().expect("finite places");
    let words = film.friction_circles.expect("a scale");
    assert!(words.starts_with("Friction circles are drawn"), "{words}");
    assert!(moving.to_html().expect("finite places").contains(words));
    let hinges = history.mechanism.friction_circles.len();
    for frame in &film.frames {
        let shapes: Vec<&str> = frame.shapes.iter().map(|&shape| &*film.shapes[shape]).collect();
        let circles = shapes.iter().enumerate().filter(|(_, shape)| shape.contains("\"s-friction-circle\""));
        let circles: Vec<usize> = circles.map(|(place, _)| place).collect();
        assert_eq!(circles.len(), hinges);
        for place in circles {
            let circle = ["cx", "cy", "r"].map(|name| numbers(shapes[place], name)[0]);
            assert!(shapes[place + 1].contains("s-action-line"), "{}", shapes[place + 1]);
            assert!(shapes[place + 2].contains("s-pin-force"), "{}", shapes[place + 2]);
            let [x, y, to_x, to_y] = numbers(shapes[place + 1], "points")[..] else { panic!("a line") };
            let (along_x, along_y) = (to_x - x, to_y - y);
            let distance = ((circle[0] - x) * along_y - (circle[1] - y) * along_x) / along_x.hypot(along_y);
            // Places are written with two digits after the point.
            assert!((distance.abs() - circle[2]).abs() < 0.05, "{distance} of {}", circle[2]);
        }
    }
}

/// P = Q / (1 - 2 mu a / L) = 20 N / (1 - 1.5 mu) as in the model, whose efficiency is 1 - 1.5 mu, and
/// 20 N / (1 + 1.5 mu) in the opposite direction.
#[test]
fn efforts_and_efficiency_over_friction() {
    let drawer = model("drawer", &Settings::default());
    let options = DriveOptions::default().vary(Some(Vary::between("mu", 0.0, 1.0))).rows(41);
    let report = drive(&drawer, &options).expect("a report");
    let figure = drive_figure(&report).expect("a course");
    let titles: Vec<&str> = figure.panels.iter().map(|panel| &*panel.title).collect();
    // Beyond 2/3 friction holds what the load would push, so there is no efficiency.
    assert_eq!(titles, ["Effort", "Efficiency; \u{2212} +: held by friction"]);
    let ways = ["moving as in the model", "moving backwards with the same loads"];
    assert_eq!(figure.quantities, ways);
    let of = |panel: usize, quantity: usize, value: &dyn Fn(f64) -> f64| {
        let mut curves = figure.panels[panel].curves.iter();
        let curve = curves.find(|curve| curve.quantity == quantity).expect("a curve");
        assert!(curve.points.len() > 20, "{curve:?}");
        for [mu, shown] in &curve.points {
            assert!((shown - value(*mu)).abs() < 1e-9 * value(*mu).abs(), "{mu}: {shown}");
        }
    };
    of(0, 0, &|mu| 20.0 / (1.0 - 1.5 * mu));
    of(0, 1, &|mu| 20.0 / (1.0 + 1.5 * mu));
    of(1, 0, &|mu| 100.0 * (1.0 - 1.5 * mu));
    let picture = svg(&figure);
    assert_eq!(
        (picture.matches("class=\"panel\"").count(), picture.matches("class=\"legend\"").count()),
        (2, 1)
    );
    let [zone] = &figure.panels[0].zones[..] else { panic!("one excluded interval") };
    assert_eq!(zone.meaning, "no solution moving as in the model");
    assert!((zone.from - 2.0 / 3.0).abs() < 1e-12 && zone.to == 1.0, "{zone:?}");
    assert!(texts(&svg(&figure)).iter().any(|text| text == "0.666667: grows without bound"));
    assert_eq!(drive_figure(&drive(&drawer, &DriveOptions::default()).expect("a report")), None);
    // What comes from infinity beyond 2/3 is a threshold: dashed, cut, and told of.
    let threshold =
        figure.branches.iter().find(|branch| branch.stroke == Stroke::Dashed).expect("a threshold");
    assert!(threshold.name.ends_with("(unstable)"), "{}", threshold.name);
    let settled = figure.branches.iter().filter(|branch| branch.stroke == Stroke::Solid).count();
    assert_eq!(settled, 2);
    // The directions are told apart by colour, not by markers alone.
    let colour = |quantity: usize| {
        let curve = figure.panels[0].curves.iter().find(|curve| curve.quantity == quantity).expect("a curve");
        figure.branches[curve.branch].colour
    };
    assert_ne!(colour(0), colour(1));
}

/// A mode has the same colour whichever question is plotted, and whatever other modes the plot has.
#[test]
fn a_mode_has_one_colour_in_all_plots() {
    let drawer = model("drawer", &Settings::default());
    let colour = |figure: &Figure, signs: &str| {
        let branch = figure.branches.iter().find(|branch| branch.name.starts_with(signs));
        branch.map_or_else(|| panic!("{signs}: {:?}", figure.branches), |branch| branch.colour)
    };
    let options = DriveOptions::default().vary(Some(Vary::between("mu", 0.0, 1.0))).rows(11);
    let drive = drive_figure(&drive(&drawer, &options).expect("a report")).expect("a course");
    let mut options = LimitsOptions::new(Vary::between("mu", 0.0, 1.0));
    options.both_directions = true;
    let (report, curves) = limits_with_curves(&drawer, &options, Quantity::NormalForce).expect("a report");
    let limits = limits_figure(&report, &curves);
    for signs in ["+ \u{2212}", "\u{2212} +"] {
        assert_eq!(colour(&drive, signs), colour(&limits, signs), "{signs}");
    }
    assert_ne!(colour(&drive, "+ \u{2212}"), colour(&drive, "\u{2212} +"));
}

/// The margin of the drawer is L / (2 a mu) = L / 0.18 m: 2 at L = 0.36 m, 20/9 in the model.
#[test]
fn margins_over_a_length() {
    let drawer = model("drawer", &Settings::default());
    let vary = Vary::between("L", "200 mm", "900 mm");
    let report = size(&drawer, &SizeOptions::new(vary, 2.0)).expect("a report");
    let figure = size_figure(&report);
    let [panel] = &figure.panels[..] else { panic!("one panel") };
    for [length, margin] in &panel.curves[0].points {
        assert!((margin - length / 180.0).abs() < 1e-9, "{length}: {margin}");
    }
    assert!((panel.bands[0].from - 360.0).abs() < 1e-9 && panel.bands[0].to == 900.0);
    assert_eq!((panel.points[0].kind, panel.points[0].at[0]), (PointKind::Model, 400.0));
    assert!((panel.points[0].at[1] - 20.0 / 9.0).abs() < 1e-9);
    let texts = texts(&svg(&figure));
    for wanted in ["360: just met", "wanted: 2", "L in mm", "the model"] {
        assert!(texts.iter().any(|text| text == wanted), "{wanted}: {texts:?}");
    }
}

#[test]
fn maps_tell_each_mode_once_and_what_locks_is_red() {
    let plane = |name: &str, x: Vary, y: Vary, colour_by| {
        let report =
            map(&model(name, &Settings::default()), &MapOptions::new(x, y).colour_by(colour_by).size(20, 20));
        let settings = Settings::default().parameter("r", "30 mm");
        slideway_pictures::map::to_svg(&report.expect("a map"), &settings, &LIGHT).expect("finite places")
    };
    let picture = plane(
        "slider-crank",
        Vary::between("phi", "-175 deg", "175 deg"),
        Vary::between("mu", 0.0, 1.5),
        ColourBy::Modes,
    );
    let words = texts(&picture);
    assert!(words[0].starts_with("A slider-crank with a frictional piston: contact modes"), "{words:?}");
    assert!(words.iter().any(|text| text == "With r = 30 mm"), "{words:?}");
    for mode in ["+ +", "+ \u{2212}", "\u{2212} +", "\u{2212} \u{2212}"] {
        let told = words.iter().filter(|text| text.starts_with(&format!("{mode}: ")) || *text == mode);
        assert_eq!(told.count(), 1, "{mode}: {words:?}");
    }
    let jam =
        plane("drawer", Vary::between("mu", 0.0, 1.0), Vary::between("L", 0.2, 0.5), ColourBy::Solutions);
    let locked =
        jam.split("<path ").find(|element| element.contains("data-class=\"0\"")).expect("a first class");
    assert!(locked.contains("fill=\"#d8382c\""), "{locked}");
}
