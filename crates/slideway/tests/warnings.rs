//! Warnings: each at its place, from its threshold on, and none for the gallery.

use slideway::fault::{Doubt, FaultKind, Place, Source};
use slideway::limits::Vary;
use slideway::warning::warnings;
use slideway::{Model, Settings, check, gallery, template};

fn drawer() -> &'static str {
    gallery::find("drawer").expect("in the gallery").text
}

fn of_text(text: &str) -> Vec<(Doubt, Option<Place>)> {
    of(&Model::parse(text).expect("a sound model"))
}

fn of(model: &Model) -> Vec<(Doubt, Option<Place>)> {
    let found = warnings(model);
    let one = |fault: &&slideway::fault::Fault| match &fault.kind {
        FaultKind::Doubt(doubt) => (doubt.clone(), fault.place.clone()),
        other => panic!("{other} is no warning"),
    };
    found.sorted().iter().map(one).collect()
}

fn names(found: &[(Doubt, Option<Place>)]) -> Vec<&'static str> {
    found.iter().map(|(doubt, _)| doubt.name()).collect()
}

#[test]
fn the_gallery_and_the_templates_have_none() {
    for entry in gallery::MODELS {
        assert_eq!(of_text(entry.text), [], "{}", entry.name);
    }
    for template in template::TEMPLATES {
        assert_eq!(of_text(template.text), [], "{}", template.name);
    }
}

/// A drawer in millimetres whose width is 500 m, from an independent review.
const KITCHEN: &str = include_str!("../../slideway-cli/tests/doubtful/kitchen-drawer.toml");

/// The same with a width in millimetres, and other words in places of some.
fn kitchen(changes: &[(&str, &str)]) -> String {
    let mut text = KITCHEN.replace("width = 500", "width = \"500 mm\"");
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    text
}

/// What a warning says, and the text at its place.
fn told(text: &str) -> Vec<(String, &str)> {
    let one = |(doubt, place): (Doubt, Option<Place>)| {
        let span = place.expect("a place").span;
        (doubt.to_string(), &text[span])
    };
    of_text(text).into_iter().map(one).collect()
}

#[test]
fn a_number_without_a_unit_among_lengths_in_millimetres_is_told_wherever_it_stands() {
    assert_eq!(of_text(&kitchen(&[])), []);
    for (from, to, what, at) in [
        ("width = \"500 mm\"", "width = 500", "width is 500 m,", "500"),
        ("width = \"500 mm\"", "width = \"500\"", "width is 500 m,", "\"500\""),
        ("width = \"500 mm\"", "half = 250\nwidth = \"2*half\"", "half is 250 m,", "250"),
        ("[\"-depth/2\", 0]", "[-225, 0]", "is -225 m,", "-225"),
        ("[\"-depth/2\", 0]", "[\"20 - depth/2\", 0]", "the number in ", "20"),
        ("[\"-depth/2\", 0]", "[\"-450*cos(60 deg)\", 0]", "the number in ", "450"),
        ("\"width\"] }", "500] }", "is 500 m,", "500"),
        ("length = \"L\"", "length = 300", "is 300 m,", "300"),
        ("slide = \"rail\"", "slide = \"rail\"\nvalue = 0.05", "is 0.05 m,", "0.05"),
    ] {
        let text = kitchen(&[(from, to)]);
        let found = told(&text);
        assert_eq!(found.len(), 1, "{to}: {found:?}");
        assert!(found[0].0.contains(what), "{to}: {found:?}");
        assert_eq!((found[0].1, names(&of_text(&text))), (at, vec!["bare_number"]), "{to}");
    }
    // Numbers that multiply, zero, and what has another dimension are as they should be.
    for (from, to) in [
        ("\"-depth/2\"", "\"-0.5*depth\""),
        ("[\"-depth/2\", 0]", "[\"0 - depth/2\", 0]"),
        ("mass = \"8 kg\"", "mass = 8"),
        ("rate = \"0.2 m/s\"", "rate = 0.2"),
        ("mu = 0.2", "mu = 0.2\nidle = 7"),
    ] {
        assert_eq!(of_text(&kitchen(&[(from, to)])), [], "{to}");
    }
    // In a model in metres a number without a unit is right.
    assert_eq!(
        of_text(
            &kitchen(&[]).replace("500 mm", "0.5 m").replace("450 mm", "0.45 m").replace("\"300 mm\"", "0.3")
        ),
        []
    );
    // What a setting replaces counts no more, what it brings does; its place is there.
    let model = Model::parse(KITCHEN).expect("a sound model");
    let set =
        |value: &str| of(&model.with(&Settings::default().parameter("width", value)).expect("a length"));
    assert_eq!(set("480 mm"), []);
    let found = set("480");
    assert_eq!(names(&found), ["bare_number"]);
    assert_eq!(found[0].1, Some(Place { source: Source::Setting(0), span: 6..9 }));
    // A program's number is in metres on purpose.
    assert_eq!(of(&model.with(&Settings::default().parameter("width", 0.48)).expect("a length")), []);
}

/// A thousandth of each is near its neighbours, 450 mm and 500 mm.
#[test]
fn a_length_that_is_a_thousand_times_its_neighbours_is_told() {
    for (from, to, at) in [
        ("\"500 mm\"", "\"500 m\"", vec!["\"500 m\""]),
        ("\"300 mm\"", "\"300 m\"", vec!["\"300 m\""]),
        ("\"300 mm\"", "\"300000 mm\"", vec!["\"300000 mm\""]),
        // Two without a unit, which are most of the lengths.
        ("\"500 mm\"\ndepth = \"450 mm\"", "500\ndepth = 450", vec!["500", "450"]),
    ] {
        let text = kitchen(&[(from, to)]);
        let found: Vec<&str> = told(&text).into_iter().map(|(_, at)| at).collect();
        assert_eq!(found, at, "{to}");
    }
    // All in metres, and one of them in millimetres without saying so.
    let metres = kitchen(&[("\"500 mm\"", "0.5"), ("\"450 mm\"", "450"), ("\"300 mm\"", "0.3")]);
    assert_eq!(
        told(&metres),
        [("depth is 450 m, 900 times the next smaller length of the model, 0.5 m".to_owned(), "450")]
    );
    // Long rails, ways that are travelled, small clearances and pins are no mistakes.
    assert_eq!(of_text(&kitchen(&[("\"300 mm\"", "\"30 m\"")])), []);
    let far = ("slide = \"rail\"", "slide = \"rail\"\nvalue = \"900 mm\"");
    assert_eq!(of_text(&kitchen(&[far, ("mu = \"mu\"", "mu = \"mu\"\ntravel = [\"-90 m\", \"90 m\"]")])), []);
    let pin = gallery::find("toggle-press").expect("in the gallery").text.replace("\"12 mm\"", "\"0.1 mm\"");
    assert_eq!(of_text(&pin), []);
}

#[test]
fn an_angle_without_a_unit_may_not_exceed_a_full_turn() {
    let with = |along: &str| drawer().replacen("along = \"0 deg\"", &format!("along = {along}"), 1);
    assert_eq!(names(&of_text(&with("90"))), ["bare_angle"]);
    assert_eq!(names(&of_text(&with("\"-90\""))), ["bare_angle"]);
    // Less than that is in doubt only beside angles in degrees.
    assert_eq!(names(&of_text(&with("6.28"))), ["bare_number"]);
    for allowed in ["\"6.28 rad\"", "\"90 deg\"", "\"90 rad\"", "\"720 deg\""] {
        assert_eq!(of_text(&with(allowed)), [], "{allowed}");
    }
    // The place is that of the number, also where it is a parameter.
    let text = with("\"alpha\"").replace("[parameters]", "[parameters]\nalpha = 45");
    let found = of_text(&text);
    let place = found[0].1.clone().expect("a place");
    assert_eq!((names(&found), &text[place.span]), (vec!["bare_angle"], "45"));
}

#[test]
fn numbers_without_a_unit_are_suspicious_where_the_model_has_another_than_si() {
    let millimetres = Model::parse(&drawer().replace("0.4 m", "400 mm")).expect("a sound model");
    let set = |model: &Model, value: &str| {
        of(&model.with(&Settings::default().parameter("L", value)).expect("a length"))
    };
    let found = set(&millimetres, "0.45");
    let place = Place { source: Source::Setting(0), span: 2..6 };
    assert_eq!((names(&found), &found[0].1), (vec!["bare_number"], &Some(place)));
    assert_eq!(set(&millimetres, "450 mm"), []);
    // In metres as in the model nothing surprises, nor does a program's number.
    assert_eq!(set(&Model::parse(drawer()).expect("a sound model"), "0.45"), []);
    assert_eq!(of(&millimetres.with(&Settings::default().parameter("L", 0.45)).expect("a length")), []);
    // Of a range each end.
    let ends = |vary: &str| vary.parse::<Vary>().expect("a range").warnings(&millimetres).sorted().len();
    assert_eq!(["L=0.2..0.5", "L=200 mm..0.5", "L=200 mm..500 mm", "mu=0..1"].map(ends), [2, 1, 0, 0]);
}

#[test]
fn lengths_may_not_differ_by_more_than_ten_thousand() {
    // Beside 0.45 m and 0.7 m of the shape.
    let with = |length: &str| drawer().replace("\"0.4 m\"", &format!("\"{length}\""));
    let text = with("0.05 mm");
    let found = of_text(&text);
    let place = found[0].1.clone().expect("a place");
    assert_eq!((names(&found), &text[place.span]), (vec!["lengths_far_apart"], "\"0.05 mm\""));
    // 0.7 m / 10^4 = 0.07 mm
    assert_eq!(of_text(&with("0.0701 mm")), []);
    assert_eq!(names(&of_text(&with("0.0699 mm"))), ["lengths_far_apart"]);
    // What is computed may be as short as it likes.
    assert_eq!(of_text(&drawer().replace("h = \"0 m\"", "h = \"L*1e-9\"")), []);
}

#[test]
fn friction_above_two_is_rare() {
    let with = |mu: &str| of_text(&drawer().replace("mu = 0.3 ", &format!("mu = {mu} ")));
    assert_eq!(names(&with("30")), ["great_friction"]);
    assert_eq!(with("2"), []);
    assert_eq!(names(&with("2.001")), ["great_friction"]);
}

#[test]
fn a_small_angle_without_unit_is_in_doubt_beside_degrees() {
    let text = gallery::find("box-on-incline").expect("in the gallery").text;
    assert!(text.contains("\"20 deg\""));
    // The only angle of the model is taken as it is; beside another one in degrees it is not.
    assert_eq!(of_text(&text.replace("\"20 deg\"", "0.35")), []);
    let beside = text.replace("\"20 deg\"", "5").replace("[points]", "tilt = \"3 deg\"\n[points]");
    assert_eq!(names(&of_text(&beside)), ["bare_number"]);
}

#[test]
fn gravity_of_no_planet_is_in_doubt() {
    let text = gallery::find("ladder").expect("in the gallery").text;
    assert!(text.contains("gravity = \"9.81 m/s^2\""));
    let with = |gravity: &str| of_text(&text.replace("gravity = \"9.81 m/s^2\"", gravity));
    assert_eq!(names(&with("gravity = 9810")), ["great_gravity"]);
    assert_eq!(with("gravity = \"9810 mm/s^2\""), []);
    // Without it nothing presses, and "it holds" would mean nothing.
    assert_eq!(names(&with("")), ["no_loads"]);
}

#[test]
fn what_touches_a_face_is_not_behind_it() {
    let text = gallery::find("ladder").expect("in the gallery").text;
    let turned = text.replace("along = \"90 deg\"", "along = \"-90 deg\"");
    assert_ne!(turned, text);
    let found = of_text(&turned);
    assert_eq!(names(&found), ["behind_face"]);
    assert_eq!(found[0].0.to_string(), "ladder lies behind the face of head");
}

/// With mu = 0.12 a pin of 12 mm has a friction circle of 1.4297 mm; the links are 100 mm long, which r = rho sin(atan mu)
/// reaches for rho = 100 mm sqrt(1 + 0.12^2) / 0.12 = 839.3 mm.
#[test]
fn a_friction_circle_may_not_hold_the_next_hinge() {
    let text = gallery::find("toggle-press").expect("in the gallery").text;
    let with = |radius: &str| of_text(&text.replace("radius = \"12 mm\"", &format!("radius = {radius}")));
    assert_eq!(with("\"839 mm\""), []);
    // Each of the three pins; the one of the ram is on a link, too.
    assert_eq!(names(&with("\"839.5 mm\"")), ["wide_friction_circle"; 3]);
    let found = with("\"12 m\"");
    let told = found[0].0.to_string();
    assert!(
        told.starts_with("the friction circle of O has a radius of 1429.7 mm") && told.contains("100 mm"),
        "{told}"
    );
    // Where a setting makes it so, the setting is to blame.
    let set =
        Model::parse(text).expect("a sound model").with(&Settings::default().parameter("radius", "12 m"));
    let found = of(&set.expect("a length"));
    assert!(
        found.iter().all(|(_, place)| place.as_ref().is_some_and(|place| place.source == Source::Setting(0)))
    );
    assert!(!found.is_empty());
}

/// Pushed at constant speed against nothing, every contact force is zero: it would seem never to jam.
#[test]
fn a_drive_against_nothing_says_nothing_about_jamming() {
    assert_eq!(names(&of_text(&drawer().replace("Q = \"20 N\"", "Q = \"0 N\""))), ["nothing_presses"]);
    let idle =
        gallery::find("drawer-on-two-rails").expect("in the gallery").text.replace("\"10 N\"", "\"0 N\"");
    // Rails without a load press nothing, unless they are bent.
    assert_eq!(names(&of_text(&idle)), ["nothing_presses"]);
    assert_eq!(of_text(&idle.replace("eps = \"0 mm\"", "eps = \"0.3 mm\"")), []);
    assert_eq!(of_text(drawer()), []);
    // A preload rubs, too.
    let preloaded = drawer().replace("mu = \"mu\"", "mu = \"mu\"\npreload = \"1 N\"");
    assert_eq!(of_text(&preloaded.replace("Q = \"20 N\"", "Q = \"0 N\"")), []);
}

#[test]
fn a_drawing_with_a_gap_is_told_with_its_joint() {
    // The crank pin of the rod is drawn `gap` beside that of the crank.
    let text = gallery::find("slider-crank").expect("in the gallery").text;
    let with = |gap: &str| {
        let text = text.replace(
            "[points]",
            &format!("[points]\nA_2 = [\"r*cos(phi_drawn) + {gap}\", \"r*sin(phi_drawn)\"]"),
        );
        let text = text.replace("points = [\"A\", \"B\"]", "points = [\"A_2\", \"B\"]");
        of_text(&text.replace("rod.A\"", "rod.A_2\""))
    };
    let found = with("12 mm");
    let [(Doubt::GapClosed { joint, gap }, Some(_))] = found.as_slice() else { panic!("{found:?}") };
    assert_eq!((joint.as_str(), gap.as_str()), ("A", "12 mm"));
    // (5, 12) mm beside it in both components: 13 mm.
    let text = text
        .replace("[points]", "[points]\nA_2 = [\"r*cos(phi_drawn) + 5 mm\", \"r*sin(phi_drawn) + 12 mm\"]");
    let text = text.replace("points = [\"A\", \"B\"]", "points = [\"A_2\", \"B\"]");
    let both = of_text(&text.replace("rod.A\"", "rod.A_2\""));
    assert!(
        both.iter().any(|(doubt, _)| matches!(doubt, Doubt::GapClosed { gap, .. } if gap == "13 mm")),
        "{both:?}"
    );
    assert_eq!(with("0.01 mm"), []);
}

#[test]
fn a_state_far_from_the_drawing_is_told_with_its_body() {
    // Without a carcass that ends: both contacts travel with the drawer.
    let text = drawer().replace("rear = { carried_by = \"guide\" }", "rear = { carried_by = \"block\" }");
    let model = Model::parse(&text).expect("a sound model");
    let at = |x: f64| of(&model.with(&Settings::default().position("x", x)).expect("a position"));
    assert_eq!(at(0.1), []);
    let found = at(100.0);
    let [(Doubt::FarFromDrawing { body, distance, .. }, Some(place))] = found.as_slice() else {
        panic!("{found:?}")
    };
    assert_eq!((body.as_str(), distance.as_str()), ("drawer", "100 m"));
    assert_eq!(place.source, Source::Setting(0));
    // Whoever declares that it travels so far means it.
    let long = text.replace("mu = \"mu\"", "mu = \"mu\"\ntravel = [0, \"200 m\"]");
    let model = Model::parse(&long).expect("a sound model");
    assert_eq!(of(&model.with(&Settings::default().position("x", 100.0)).expect("a position")), []);
}

/// The wedge's coefficients are parameters that are nothing but `mu`; a file's number is told in the file.
#[test]
fn what_a_setting_causes_is_told_at_the_setting() {
    let wedge = Model::parse(gallery::find("wedge").expect("in the gallery").text).expect("a sound model");
    let set = |name: &str, value: &str| {
        of(&wedge.with(&Settings::default().parameter("Q", "800 N").parameter(name, value)).expect("sound"))
    };
    for (name, what) in [("mu", "the value of mu"), ("mu_wall", "the value of mu_wall")] {
        let found = set(name, "30");
        let [(Doubt::GreatFriction { what: told, .. }, Some(place))] = found.as_slice() else {
            panic!("{found:?}")
        };
        let span = name.len() + 1..name.len() + 3;
        assert_eq!((told.as_str(), place), (what, &Place { source: Source::Setting(1), span }));
    }
    // Where the friction is computed from what was set, too.
    let text = gallery::find("wedge").expect("in the gallery").text;
    let text = text.replace("mu_wall = \"mu\"", "rho = \"10 deg\"\nmu_wall = \"tan(rho)\"");
    let model = Model::parse(&text).expect("a sound model");
    let found = of(&model.with(&Settings::default().parameter("rho", "80 deg")).expect("sound"));
    assert_eq!(names(&found), ["great_friction"]);
    assert_eq!(found[0].1.as_ref().map(|place| place.source.clone()), Some(Source::Setting(0)));
    assert_eq!(of(&model), []);
}

#[test]
fn check_lists_them_for_programs() {
    let model = Model::parse(&drawer().replace("mu = 0.3 ", "mu = 30 ")).expect("a sound model");
    let report = check(&model).expect("a report");
    assert!(report.sound);
    let json = serde_json::to_value(&report.warnings).expect("JSON");
    assert_eq!(json[0]["kind"], "great_friction");
    assert_eq!(json[0]["place"]["source"], "model");
    assert!(json[0]["message"].is_string() && json[0]["hint"].is_string());
}

/// A box that stands flat, with a contact at one of its lower corners: the other has none. With a base it has both.
#[test]
fn a_corner_on_a_face_without_contact() {
    let of_joint = |joint: &str| {
        format!(
            "gravity = \"9.81 m/s^2\"\n[points]\nA = [\"-0.1 m\", 0]\nM = [0, 0]\nC = [0, \"0.2 m\"]\n[bodies.box]\npoints = [\"A\", \"M\", \"C\"]\nmass = \"1 kg\"\n\
             centre_of_mass = \"C\"\nshape = {{ rectangle = [\"0.2 m\", \"0.4 m\"] }}\n[joints.foot]\nblock = \"box\"\nalong = \"0 deg\"\nmu = 0.3\n\
             {joint}\n[coordinates.x]\nslide = \"foot\"\n"
        )
    };
    let turn = "[coordinates.turn]\nrotation = \"box\"\n";
    let one = of_joint("type = \"corner_on_face\"\nat = \"A\"") + turn;
    let found = of_text(&one);
    assert_eq!(names(&found), ["bare_corner"]);
    let expected =
        "the corner of box at (0.1 m, 0 m) in the drawing lies on the face of foot and has no contact there";
    assert_eq!(found[0].0.to_string(), expected);
    assert_eq!(
        names(&of_text(&of_joint("type = \"block_on_face\"\nat = \"M\"\nlength = \"0.2 m\""))),
        [""; 0]
    );
}
