//! The units in which answers are shown: the choice, and that every report follows it.

#![allow(clippy::unwrap_used, reason = "a test that meets a missing value has failed")]

use slideway::check::check;
use slideway::drive::DriveOptions;
use slideway::limits::{LimitsOptions, Quantity, Vary, limits_with_curves};
use slideway::report::Style;
use slideway::units::UnitSystem;
use slideway::{
    HoldOptions, MapOptions, Model, Report, Settings, SimulateOptions, SizeOptions, drive, gallery, hold,
    limits, map, simulate, size, solve,
};

/// The drawer of the gallery with its lengths in millimetres and its force in kilonewtons; 15 literals of
/// lengths in mm, none in m.
fn drawer() -> String {
    let text = gallery::find("drawer").expect("in the gallery").text;
    text.replace("\"0.4 m\"", "\"400 mm\"")
        .replace("\"0.3 m\"", "\"300 mm\"")
        .replace("\"0 m\"", "\"0 mm\"")
        .replace("\"0.45 m\", \"0.7 m\"", "\"450 mm\", \"700 mm\"")
        .replace("\"20 N\"", "\"2 kN\"")
        .replace("\"0.1 m/s\"", "\"100 mm/s\"")
}

fn model() -> Model {
    Model::parse(&drawer()).expect("a sound model")
}

fn with_key(key: &str) -> Model {
    Model::parse(&format!("units = \"{key}\"\n{}", drawer())).expect("a sound model")
}

fn text<R: Report>(report: &R) -> String {
    report.text(Style::PLAIN.width(200))
}

/// Whether a text has all of these parts and none of those.
fn assert_shows(text: &str, parts: &[&str], others: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "no `{part}` in\n{text}");
    }
    for other in others {
        assert!(!text.contains(other), "`{other}` in\n{text}");
    }
}

#[test]
fn what_is_typed_decides_for_each_kind() {
    let units = model().units;
    let shown = ["m", "N", "m/s", "m/s^2", "rad", "N m"].map(|si| units.of(si).name().to_owned());
    assert_eq!(shown, ["mm", "kN", "mm/s", "m/s^2", "deg", "N m"]);
}

#[test]
fn the_key_of_the_file_and_the_option_choose_a_system() {
    assert_eq!(with_key("SI").units.of("m").name(), "m");
    assert_eq!(with_key("mm").units.of("N").name(), "N");
    assert_eq!(with_key("as-typed").units.of("N").name(), "kN");
    // The option wins.
    assert_eq!(with_key("SI").with_units(UnitSystem::AsTyped).units.of("m").name(), "mm");
}

#[test]
fn bare_numbers_count_as_si_units() {
    // Two lengths in mm, three without a unit, and zeros, which have none.
    let lengths = |lengths: [&str; 3]| {
        let [a, b, c] = lengths;
        let text = format!(
            "[points]\nA = [0, 0]\nB = [{a}, {b}]\nC = [{c}, \"20 mm\"]\n[bodies.block]\npoints = [\"A\", \"B\", \"C\"]\nmass = 1\n\
             centre_of_mass = \"A\"\nmoment_of_inertia = 1\n[joints.guide]\ntype = \"block_slider\"\nblock = \"block\"\n\
             at = \"A\"\nalong = \"0 deg\"\nlength = \"30 mm\"\nmu = 0\n[coordinates.x]\nslide = \"guide\"\nrate = 1\n"
        );
        Model::parse(&text).expect("a sound model").units.of("m").name().to_owned()
    };
    assert_eq!(lengths(["0.1", "0.2", "0.3"]), "m");
    assert_eq!(lengths(["0.1", "0", "0"]), "mm");
    // Of as many the first: 0.1 stands before 20 mm.
    assert_eq!(lengths(["0.1", "0.2", "0"]), "m");
}

#[test]
fn a_parameter_is_shown_as_it_was_typed_last() {
    let typed = model().with(&Settings::default().parameter("L", "50 cm")).expect("a length");
    let report = size(&typed, &SizeOptions::new(Vary::usual("L"), 2.0)).expect("an answer");
    assert_shows(&text(&report), &["The model has L = 50 cm", "L in cm"], &["L in mm", "500 mm"]);
    // A number without a unit is no unit.
    let bare = model().with(&Settings::default().parameter("L", 0.5)).expect("a length");
    assert_eq!(bare.units.parameter("L", "m").show(0.5), "500 mm");
}

#[test]
fn solve_shows_forces_speeds_and_coordinates() {
    let report = solve(&model()).expect("an answer");
    let shown = ["x = 0 mm, rate 100 mm/s", "normal force in kN", "sliding in mm/s", "3.6364"];
    assert_shows(&text(&report), &shown, &["in N ", "in m/s"]);
}

/// The drawer with a single load of 2 kN typed, and with 20 N in its place: the push of 36.364 N is 0.036364 kN.
#[test]
fn small_forces_are_not_shown_in_the_unit_of_a_great_load() {
    let small = model().with(&Settings::default().parameter("Q", 20)).expect("a force");
    let report = solve(&small).expect("an answer");
    assert_shows(&text(&report), &["normal force in N", "36.364", "sliding in mm/s"], &["kN"]);
    let driven = drive(&small, &DriveOptions::default()).expect("an answer");
    assert_shows(&text(&driven), &["push needs 36.36 N (20 N without friction)", "push in N"], &["kN"]);
    let held = hold(&small, &HoldOptions::default().hold_drives(true)).expect("an answer");
    assert_shows(&text(&held), &["force in N"], &["kN"]);
    let vary = Vary::between("L", "200 mm", "500 mm");
    let plot = |model: &Model| {
        let options = LimitsOptions::new(vary.clone()).effort(0);
        limits_with_curves(model, &options, Quantity::Effort)
            .expect("an answer")
            .1
            .units
            .of("N")
            .name()
            .to_owned()
    };
    assert_eq!([plot(&small), plot(&model())], ["N", "kN"]);
    // As typed, the option for SI units, and a program's numbers stay as they are.
    assert_shows(&text(&solve(&model()).expect("an answer")), &["normal force in kN"], &["in N "]);
    let si = small.with_units(UnitSystem::Si);
    assert_shows(&text(&solve(&si).expect("an answer")), &["normal force in N", "36.364"], &["kN"]);
}

#[test]
fn limits_show_ends_and_conclusions() {
    let options = LimitsOptions::new(Vary::between("L", "100 mm", "500 mm"));
    let report = limits(&model(), &options).expect("an answer");
    // The drawer jams below L = 2 a mu = 180 mm.
    assert_shows(&text(&report), &["It jams below L = 180 mm", "from in mm", "in the model 400 mm"], &[]);
    // The range has its own unit.
    let options = LimitsOptions::new(Vary::between("L", "10 cm", "50 cm"));
    let report = limits(&model(), &options).expect("an answer");
    assert_shows(&text(&report), &["It jams below L = 18 cm", "from in cm", "in the model 40 cm"], &[]);
    let options = LimitsOptions::new(Vary::between("L", "10 cm", "50 cm"));
    let report = limits(&with_key("SI"), &options).expect("an answer");
    assert_shows(&text(&report), &["It jams below L = 0.18 m"], &["cm"]);
}

#[test]
fn json_stays_si_whatever_is_shown() {
    let of = |model: &Model| {
        let json = solve(model).expect("an answer").json();
        serde_json::from_str::<serde_json::Value>(&json).expect("JSON")
    };
    let [mut typed, mut si] = [of(&model()), of(&with_key("SI"))];
    // The answer is a sentence.
    let [in_kilonewtons, in_newtons] = [&mut typed, &mut si].map(|json| json["answer"].take());
    assert!(in_kilonewtons.as_str().is_some_and(|answer| answer.contains("push needs 3.636 kN")));
    assert!(in_newtons.as_str().is_some_and(|answer| answer.contains("push needs 3636 N")));
    assert_eq!(typed, si);
    assert_eq!(typed["state"][0]["rate"], 0.1);
    assert_eq!(typed["state"][0]["unit"], "m");
}

#[test]
fn drive_shows_efforts_and_what_is_varied() {
    let options = DriveOptions::default().vary(Some(Vary::between("L", "200 mm", "400 mm")));
    let report = drive(&model(), &options).expect("an answer");
    let shown =
        ["push needs 3.636 kN (2 kN without friction)", "push in kN", "L in mm", "x = 0 mm, rate 100 mm/s"];
    assert_shows(&text(&report), &shown, &[" N without"]);
}

#[test]
fn size_shows_the_dimension() {
    // A margin of 2: L = 2 * 2 a mu = 360 mm.
    let report = size(&model(), &SizeOptions::new(Vary::usual("L"), 2.0)).expect("an answer");
    assert_shows(&text(&report), &["L at least 360 mm", "L in mm"], &["0.36"]);
}

#[test]
fn hold_shows_loads_and_reactions() {
    let options = HoldOptions::default().load("push");
    let report = hold(&model(), &options).expect("an answer");
    assert_shows(&text(&report), &["At rest at x = 0 mm", "normal force in kN", " kN"], &["in N "]);
}

#[test]
fn check_shows_masses_lengths_and_what_has_moved() {
    let moved = model().with(&Settings::default().position("x", "50 mm")).expect("a position");
    let report = check(&moved).expect("an answer");
    let shown =
        ["overlap in mm", "450", "50 mm", "100 mm/s", "moved from the drawing by in mm", "turned by in deg"];
    assert_shows(&text(&report), &shown, &["overlap in m "]);
    assert_shows(
        &text(&check(&model()).expect("an answer")),
        &["drawer slides along (1, 0)"],
        &["moved from"],
    );
}

#[test]
fn simulate_shows_coordinates() {
    let released = drawer().split("[drives.push]").next().expect("the part before").to_owned();
    let model = Model::parse(&released).expect("a sound model");
    let history = simulate(&model, &SimulateOptions::new(0.01)).expect("a motion");
    let report = slideway::motion::report(&history, &SimulateOptions::new(0.01));
    assert_shows(&text(&report), &["From 0 s to 0.01 s: x = 0 mm, rate 100 mm/s"], &[" m, rate"]);
}

/// Times, too, are in the unit in which the model has them.
#[test]
fn simulate_shows_times() {
    let released = drawer().split("[drives.push]").next().expect("the part before").to_owned();
    let model = Model::parse(&released.replace("[parameters]", "[parameters]\nT = \"10 ms\""));
    let (model, options) = (model.expect("a sound model"), SimulateOptions::new(0.01));
    let report = slideway::motion::report(&simulate(&model, &options).expect("a motion"), &options);
    let shown = text(&report);
    assert_shows(&shown, &["From 0 ms to 10 ms", "Energy (J)", "still moving at 10 ms"], &[" s\n"]);
}

#[test]
fn maps_show_their_axes() {
    let options =
        MapOptions::new(Vary::between("mu", "0", "1"), Vary::between("a", "0 cm", "50 cm")).size(20, 20);
    assert_shows(
        &text(&map(&model(), &options).expect("a map")),
        &["a from 0 to 50 cm", "mu from 0 to 1\n"],
        &[],
    );
    let options = MapOptions::new(Vary::between("mu", "0", "1"), Vary::between("a", 0.0, 0.5)).size(20, 20);
    assert_shows(&text(&map(&model(), &options).expect("a map")), &["a from 0 to 500 mm"], &[]);
}

/// A collar on a vertical rod, from an independent review: B moves along x and C along y, so that BC turns about
/// (0, l/2 - l sin(35 deg)), with l = 30 in.
#[test]
fn places_in_words_are_in_the_unit_of_lengths() {
    let model = Model::parse(include_str!("findings/couple_and_collar.toml")).expect("a sound model");
    for (system, place) in [
        (UnitSystem::AsTyped, "(0, -2.2073) in"),
        (UnitSystem::Inches, "(0, -2.2073) in"),
        (UnitSystem::Millimetres, "(0, -56.065) mm"),
        (UnitSystem::Si, "(0, -0.056065) m"),
    ] {
        let report = hold(&model.clone().with_units(system), &HoldOptions::default()).expect("an answer");
        assert_shows(&report.text(Style::PLAIN.verbose(true)), &[&format!("BC rotates about {place}")], &[]);
    }
}

/// The drawer in inches, with a load of 2 kN = 449.618 lbf, at 100 mm/s = 3.937 in/s.
#[test]
fn inches_and_pounds_are_a_system() {
    let report = drive(&model().with_units(UnitSystem::Inches), &DriveOptions::default()).expect("an answer");
    assert_shows(
        &text(&report),
        &["rate 3.937 in/s", "push needs 817.5 lbf (449.6 lbf without friction)"],
        &[" N "],
    );
    assert_shows(&text(&report), &["power in hp"], &["power in W"]);
}

/// Units of a length are proposed for a length: in its place, in a parameter that is one, and in a setting of it.
#[test]
fn an_unknown_unit_is_answered_with_those_of_the_wanted_dimension() {
    let drawer = slideway::gallery::find("drawer").unwrap().text;
    let model = Model::parse(drawer).unwrap();
    let faults = [
        Model::parse(&drawer.replace("length = \"L\"", "length = \"300 mn\"")).unwrap_err(),
        Model::parse(&drawer.replace("L = \"0.4 m\"", "L = \"300 mn\"")).unwrap_err(),
        model.with(&Settings::default().parameter("L", "300 mn")).unwrap_err(),
    ];
    for faults in faults {
        let hint = faults.sorted()[0].kind.hint().unwrap();
        assert!(hint.starts_with("did you mean `mm`"), "{hint}");
    }
    let force = Model::parse(&drawer.replace("Q = \"20 N\"", "Q = \"20 mn\"")).unwrap_err();
    assert_eq!(force.sorted()[0].kind.hint().as_deref(), Some("did you mean `mN` or `MN`?"));
}
