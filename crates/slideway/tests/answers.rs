//! The answer in plain words, for every question but `solve`, `limits` and `size`, and for every kind of outcome.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::check::check;
use slideway::map::{ColourBy, MapOptions, map};
use slideway::mechanism::Mechanism;
use slideway::modes::SearchOptions;
use slideway::motion::{self, SimulateOptions, Thorough};
use slideway::raw_problem::{self, RawProblem};
use slideway::report::Style;
use slideway::sweep::{Rows, Sampling, Spread, Sweep, SweepOptions, SweepState};
use slideway::{
    DriveOptions, HoldOptions, Model, Report, Settings, configuration::Configuration, drive, gallery, hold,
    solve,
};
use std::ops::ControlFlow;

/// A model of the gallery, or its text, with some parameters.
fn model(text: &str, settings: &[(&str, &str)]) -> Model {
    let text = gallery::find(text).map_or(text, |model| model.text);
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(text).unwrap().with(&settings).unwrap()
}

fn driven(text: &str, settings: &[(&str, &str)]) -> String {
    drive(&model(text, settings), &DriveOptions::default()).unwrap().answer()
}

const EQUAL_PLAY: &str = include_str!("findings/equal_play.toml");
const TIPPING_PRESS: &str = include_str!("findings/tipping_press.toml");
const GUIDED_GAP: &str = include_str!("findings/guided_gap.toml");

#[test]
fn drive_answers() {
    // Its friction of 6 N is that of the preload, as nothing presses it: it stays between its faces.
    let push =
        "[drives.push]\ncoordinate = \"x\"\nforce = { at = \"b.S\", direction = \"0 deg\" }\n[coordinates.x]";
    let pushed = GUIDED_GAP.replace("[coordinates.x]", push);
    let told = [
        // P = Q / (1 - 2 mu a / L), which has no limit at mu = L / (2 a) = 2/3.
        (
            driven("drawer", &[]),
            "push needs 36.36 N (20 N without friction): efficiency 55 %. It would jam from mu = 0.6667 (2.222 times this friction). Backwards, push needs 13.79 N (20 N without friction) to brake the load: efficiency 68.97 %. Backwards, it does not jam at any friction while it moves, but from mu = 0.6667 (2.222 times this friction) it can also move in another way (`limits --vary friction=1..5 --both-directions` shows it).",
        ),
        (
            driven("drawer", &[("mu", "0.8")]),
            "It jams: no force moves it. It moves below mu = 0.6667. Backwards, push needs 9.091 N (20 N without friction) to brake the load: efficiency 45.45 %. Another state, at -100 N, is unstable.",
        ),
        (
            driven("drawer", &[("mu", "2/3")]),
            "It is not decided whether it moves: it is on the verge of jamming. Take it as jammed. Backwards, push needs 10 N (20 N without friction) to brake the load: efficiency 50 %. Backwards, it does not jam at any friction while it moves.",
        ),
        (
            driven("wedge", &[]),
            "P needs 0.5109 kN (0.1763 kN without friction): efficiency 34.51 %. It would jam from mu = 0.8391 (5.594 times this friction). Backwards, friction holds the load: to move it, P needs -0.1239 kN (0.1763 kN without friction). Backwards, from mu = 0.8391 (5.594 times this friction) it can also move in another way (`limits --vary friction=1..12 --both-directions` shows it). Backwards, it would tip (floor) from mu = 4 (26.67 times this friction), which only a block slider can show.",
        ),
        (
            driven("stick-slip", &[]),
            "motor needs 2.453 N, all of it against friction. It would tip (sole) from mu = 1.2 (4.8 times this friction), which only a block slider can show. Backwards, motor needs -2.453 N, all of it against friction. Backwards, it would tip (sole) from mu = 1.2 (4.8 times this friction).",
        ),
        (
            driven("bell-crank", &[]),
            "push needs 0.6998 kN (0.625 kN without friction): efficiency 89.31 %. It does not jam, whatever the friction. Backwards, push needs 0.5549 kN (0.625 kN without friction) to brake the load: efficiency 88.79 %. Backwards, it does not jam, whatever the friction.",
        ),
        (
            driven(EQUAL_PLAY, &[]),
            "belt needs 25 to 50 N (20 N without friction), efficiency 40 to 80 %; how left, right share the load is undetermined. Backwards, belt needs 12.5 to 16.67 N (20 N without friction), efficiency 62.5 to 83.33 %; how left, right share the load is undetermined. Give `stiffness` for one value.",
        ),
        (
            driven(TIPPING_PRESS, &[("mu", "1.3")]),
            "It tips (bed), which only a block slider can show. It does not tip below mu = 1.25. Backwards, it tips (bed), too. Backwards, it does not tip below mu = 1.25.",
        ),
        (
            driven(&pushed, &[("P", "0 N")]),
            "push needs 6 N, all of it against friction. Backwards, push needs -6 N, all of it against friction.",
        ),
    ];
    assert_answers(&told);
}

/// Of the boom the cylinders push the weight `W`, which friction holds by itself: that is not "self-locking".
#[test]
fn a_load_that_is_held_by_itself_alone_is_not_called_self_locking() {
    let boom = held("telescopic-boom", &[], Some("W"));
    assert!(boom.starts_with("It does not hold") && !boom.contains("elf-locking"), "{boom}");
    assert!(
        boom.contains(" times `W` or more (330.1 N), or reversed, ")
            && boom.contains(" times it or more (1952 N). By itself `W` is held, "),
        "{boom}"
    );
}

/// Sees to it that all answers are the expected ones.
#[track_caller]
fn assert_answers(told: &[(String, &str)]) {
    let wrong: Vec<String> = told
        .iter()
        .filter(|(told, expected)| told != expected)
        .map(|(told, expected)| format!("{told}\n  instead of\n{expected}"))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

fn held(text: &str, settings: &[(&str, &str)], load: Option<&str>) -> String {
    let mut options = HoldOptions::default();
    options.load = load.map(str::to_owned);
    hold(&model(text, settings), &options).unwrap().answer()
}

const SASH: &str = include_str!("findings/sash.toml");
const PIPE_CLAMP: &str = include_str!("findings/pipe_clamp.toml");
const GUIDED_TIPS: &str = include_str!("../../../docs/src/examples/guided-tips.toml");

/// 20 N on a slope; it slides from tan(angle) = mu_static on, and goes on from tan(angle) = mu.
const SLOPE: &str = r#"
    [parameters]
    angle = "13 deg"
    [points]
    c = [0, 0]
    [bodies.block]
    points = ["c"]
    mass = 2
    centre_of_mass = "c"
    moment_of_inertia = 1
    [joints.plane]
    type = "guided_slider"
    block = "block"
    at = "c"
    along = "angle"
    length = 1
    mu = 0.2
    mu_static = 0.3
    [loads.weight]
    type = "force"
    at = "block.c"
    components = [0, -20]
    [coordinates.s]
    slide = "plane"
"#;

#[test]
fn hold_answers() {
    let wedged = [("mu", "0.7"), ("mu_s", "0.7"), ("cord_force", "0 N")];
    let told = [
        (held("klepp-2002", &[], None), "It holds even without friction."),
        (
            held("drawer", &[], None),
            "It does not hold: it starts to slide (x: -4 m/s^2). More friction would not hold it.",
        ),
        (held("bell-crank", &[], None), "It does not hold. More friction would not hold it."),
        (
            held(SLOPE, &[], None),
            // 0.3 / tan(13 deg)
            "It holds with a safety factor of 1.299. Once pushed it keeps sliding: kinetic friction is lower than static.",
        ),
        (
            held(SLOPE, &[], Some("weight")),
            "Self-locking: it holds any `weight` from mu_static = 0.2309 (now 0.3).",
        ),
        (
            held(SLOPE, &[("angle", "20 deg")], Some("weight")),
            "It does not hold: it starts to slide (s: -1.541 m/s^2). It holds no `weight`, however small. It would be self-locking from mu_static = 0.364 (now 0.3).",
        ),
        (
            held("bracket-on-pole", &[], None),
            "It holds only just, from mu_static = 0.25, its present value: with any less it slips.",
        ),
        (
            held("bracket-on-pole", &[], Some("W")),
            "Just self-locking: it holds any `W` from mu_static = 0.25, its present value; with any less it slips.",
        ),
        (
            held("bracket-on-pole", &[("x", "0.2 m")], Some("W")),
            "It does not hold. It holds no `W`, however small. It would be self-locking from mu_static = 0.381 (now 0.25).",
        ),
        (
            held(PIPE_CLAMP, &[], Some("screw")),
            "Self-locking: it holds any `screw` from mu_static = 0.1667 (now 0.2).",
        ),
        (
            held("cam-follower", &[], Some("cam")),
            "Without `cam` it does not hold: it starts to slide (lift: -400 m/s^2). It holds with `cam` from 193 to 286.1 N. Not self-locking: `cam` moves it if great enough. It would be self-locking from mu = 0.814 (now 0.15).",
        ),
        (
            held("drawer", &[], Some("resistance")),
            "It does not hold: it starts to slide (x: -4 m/s^2). It holds no `resistance`, however small. Not self-locking at any static friction.",
        ),
        (
            held(SASH, &[], Some("gravity")),
            "It does not hold: it starts to slide (y: -3.433 m/s^2). It would hold with 0.275 to 0.725 times `gravity` (21.58 to 56.9 N). Only wedged by a knock it would hold any `gravity` from mu_s = 0.6667 (now 0.3).",
        ),
        (
            held(SASH, &wedged, Some("gravity")),
            "It may hold, or it may start to slide: do not rely on it. Only wedged by a knock it holds any `gravity` from mu_s = 0.6667 (now 0.7).",
        ),
        (
            held(GUIDED_TIPS, &[], None),
            "It can neither stay at rest nor start to slide with finite accelerations.",
        ),
        (
            held("slider-crank-with-pins", &[("mu_pin", "0.3")], Some("gas")),
            "It does not hold: it starts to slide (phi: 7164 rad/s^2). It would hold with -0.4922 to -0.3355 times `gas` (-0.4922 to -0.3355 kN). Whether any static friction makes it self-locking was not decided.",
        ),
        (
            held("telescopic-boom", &[], Some("cylinder_1")),
            "It does not hold: it starts to slide (s_3: 1.318 m/s^2). It does not hold with any multiple of `cylinder_1`. Only wedged by a knock it would hold any `cylinder_1` from mu = 4 (now 0.1).",
        ),
        (
            held("telescopic-boom", &[], None),
            "It does not hold: it starts to slide (s_3: 1.318 m/s^2). It would hold from mu = 0.1128 (now 0.1).",
        ),
    ];
    assert_answers(&told);
}

/// All friction together can be what is varied; a parameter of this name is a parameter.
#[test]
fn self_locking_over_all_friction_is_that_without_a_parameter() {
    let over = |text: &str, vary: &str| {
        hold(&model(text, &[]), &HoldOptions::default().load("Q").vary(vary)).map(|report| report.answer())
    };
    // Floor and flank hold it from rho = alpha / 2 on: mu = tan(5 deg).
    let all = "Self-locking: it holds any `Q` from mu = 0.08749 (now 0.15).";
    assert_eq!(over("wedge", "friction").unwrap(), all);
    assert_eq!(held("wedge", &[], Some("Q")), all);
    let named = gallery::find("wedge").unwrap().text.replace("[parameters]", "[parameters]\nfriction = 2");
    assert!(over(&named, "friction").is_err(), "no friction depends on this parameter");
}

/// A block of 2 kg on a horizontal guide, g = 10 m/s^2, friction decelerates it by 2.5 m/s^2.
const BLOCK: &str = r#"
gravity = "10 m/s^2"
[parameters]
v = "2 m/s"
[points]
C = [0, 0]
[bodies.block]
points = ["C"]
mass = "2 kg"
centre_of_mass = "C"
shape = { rectangle = ["0.2 m", "0.1 m"] }
[joints.guide]
type = "block_slider"
block = "block"
at = "C"
along = "0 deg"
length = "0.2 m"
mu = 0.25
[coordinates.x]
slide = "guide"
rate = "v"
"#;

fn options(duration: f64) -> SimulateOptions {
    SimulateOptions::new(duration)
}

fn simulated(model: &Model, options: &SimulateOptions) -> String {
    let mechanism = Mechanism::new(model).unwrap();
    let options = options.clone().with_events_of(&mechanism);
    let history = motion::simulate(model, &options).unwrap();
    motion::report(&history, &options).answer()
}

/// The paper's example begins with four ways to go on, in the words of the solutions of `solve`.
#[test]
fn other_ways_to_go_on_are_those_of_solve() {
    let options = options(0.01);
    let history = motion::simulate(&model("klepp-2002", &[]), &options).unwrap();
    let report = motion::report(&history, &options);
    let text = |verbose: bool| report.text(Style::PLAIN.width(200).verbose(verbose));
    let told = "or branch 2: upper on the lower side of the slot; lower_block touching at upper right and lower left (stable)";
    assert!(text(false).contains(&format!("{told}; its forces jump")), "{}", text(false));
    assert!(text(true).contains(&format!("{told}, signs + - +; its forces jump")), "{}", text(true));
    let solved = solve(&model("klepp-2002", &[])).unwrap().text(Style::PLAIN.width(200));
    assert!(solved.contains("  lower   touching at upper right and lower left"), "{solved}");
}

/// From 2 m/s the block stops after 2 / 2.5 = 0.8 s.
#[test]
fn simulate_answers() {
    let block = |settings: &[(&str, &str)]| model(BLOCK, settings);
    let with = |from: &str, to: &str| Model::parse(&BLOCK.replace(from, to)).unwrap();
    let rate = "rate = \"v\"";
    let force = "components = [\"1 N * sqrt(1.3 - t/(1 s))\", 0]";
    let told = [
        (simulated(&block(&[]), &options(2.0)), "It comes to rest at 0.8 s and stays so until 2 s."),
        (simulated(&block(&[]), &options(0.5)), "It is still moving at 0.5 s."),
        (simulated(&block(&[("v", "0 m/s")]), &options(0.5)), "It stays at rest until 0.5 s."),
        (simulated(&model("stick-slip", &[]), &options(0.5)), "It is still moving at 0.5 s."),
        // 2 s/v + 2/w (pi - atan(s w/v)) with s = (mu_static - mu) g/w^2, w^2 = k/m
        (
            simulated(&model("stick-slip", &[]), &options(3.0)),
            "Stick-slip: block slips 5 times, every 0.6486 s. It is still moving at 3 s.",
        ),
        (
            simulated(&model("thrown-drawer", &[]), &options(0.6)),
            "It jams at 0.3692 s and stays at rest until 0.6 s.",
        ),
        (
            simulated(&with("mu = 0.25", "mu = 0.25\ntravel = [-1, 0.5]"), &options(2.0)),
            "It ends at 0.3101 s: block reaches the end of its travel with 1.225 m/s, and guide has no stop there.",
        ),
        (
            simulated(&model("drawer", &[("v", "-0.1 m/s")]), &options(6.0)),
            "It ends at 4 s: drawer leaves its guide.",
        ),
        (
            simulated(&block(&[]), &options(2.0).reaction_limit(9.0)),
            "It ends at 0 s: the normal force of guide.front reaches its limit, which counts as a jam.",
        ),
        (
            simulated(&block(&[]), &options(2.0).most_events(0)),
            "Not finished: it was followed to 0.8 s, over 0 events, the most allowed.",
        ),
        (
            simulated(
                &with(rate, &format!("{rate}\n[loads.force]\ntype = \"force\"\nat = \"block.C\"\n{force}")),
                &options(2.0),
            ),
            "It ends at 1.3 s: the formula of the x component of force has no value: `sqrt` has no finite value for -2.2204e-16.",
        ),
        (
            simulated(&model(TIPPING_PRESS, &[("mu", "1.3")]), &options(0.1)),
            "It ends at 0 s: it tips (bed), which only a block slider can show.",
        ),
    ];
    assert_answers(&told);
}

#[test]
fn an_interrupted_motion_and_several_motions() {
    let model = model("klepp-2002-spring", &[("mu_1", "0.6")]);
    let mechanism = Mechanism::new(&model).unwrap();
    let configuration = Configuration::new(&mechanism).unwrap();
    let options = options(0.1);
    let mut stop = |_: &_| ControlFlow::Break(());
    let history =
        motion::simulate_with(&mechanism, &configuration, &options, &mut Thorough, &mut stop).unwrap();
    let interrupted = motion::report(&history, &options).answer();
    assert!(interrupted.starts_with("Not finished: it was followed to "), "{interrupted}");
    assert!(interrupted.ends_with(" s, then interrupted. Allow it more time."), "{interrupted}");
    let tree = |most: usize| {
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let tree =
            motion::simulate_all(&mechanism, &configuration, &options, (&mut Thorough, most), &mut go_on)
                .unwrap();
        motion::tree_report(&tree, &options).answer()
    };
    assert_answers(&[
        (tree(9), "2 motions are possible: these are all."),
        (tree(1), "1 motion found; there may be more."),
    ]);
}

fn checked(text: &str, settings: &[(&str, &str)]) -> String {
    check(&model(text, settings)).unwrap().answer()
}

const PULLED_BLOCK: &str = include_str!("findings/pulled_block.toml");
const SHORT_ROD: &str = include_str!("../../slideway-cli/tests/bad/short-rod.toml");

#[test]
fn check_answers() {
    let told = [
        (checked("drawer", &[]), "Ready for: solve, limits, size, sweep, map, drive, hold, simulate."),
        (checked("slider-crank", &[]), "Ready for: solve, limits, size, sweep, map, hold, simulate."),
        (checked(PULLED_BLOCK, &[]), "Ready for: hold, simulate. For solve, drive, give a rate."),
        (
            checked(PIPE_CLAMP, &[]),
            "Ready for: hold. For solve, give a mass (or a drive) and a rate. For simulate, give a mass (or a drive).",
        ),
        (
            checked(EQUAL_PLAY, &[]),
            "Ready for: solve, limits, size, sweep, map, drive, hold. Not for simulate: see below.",
        ),
        (
            checked("drawer", &[("mu", "30")]),
            "Ready for: solve, limits, size, sweep, map, drive, hold, simulate. 1 warning.",
        ),
        (checked(SHORT_ROD, &[]), "No question can be answered in this state: 1 fault."),
    ];
    assert_answers(&told);
}

fn swept(model: &Model, options: &SweepOptions) -> String {
    let sweep = Sweep::new(model, options).unwrap();
    let state = all_points(&sweep);
    sweep.answer(&state)
}

fn all_points(sweep: &Sweep) -> SweepState {
    let mut state = sweep.start();
    sweep.run(&mut state, &|_: &Rows| (), &mut |_, _| ControlFlow::Continue(()));
    state
}

fn grid(axis: &str) -> SweepOptions {
    SweepOptions::grid([axis.parse().unwrap()])
}

/// The drawer jams beyond mu = 2/3.
#[test]
fn sweep_answers() {
    let drawer = model("drawer", &[]);
    let samples = SweepOptions::samples(
        Sampling { count: 100, spread: Spread::Random, seed: 1 },
        ["mu=0..0.5".parse().unwrap()],
    );
    let told = [
        (swept(&drawer, &grid("mu=0..1:101")), "It jams at 34 of 101 points."),
        (swept(&drawer, &grid("mu=0..0.6:7")), "It jams at none of 7 points."),
        (swept(&drawer, &grid("mu=0.7..1:4")), "It jams at all 4 points."),
        (
            swept(&model("slider-crank", &[]), &grid("l=5 mm..200 mm:4")),
            "It jams at none of 4 points. Could not be solved at 1 of them.",
        ),
        (swept(&drawer, &samples), "It jams with a probability of 0 % (0 to 3.699 % with 95 % confidence)."),
        (
            swept(&model("drawer", &[("v", "-0.1 m/s")]), &grid("mu=0..1:11")),
            "It jams at none of 11 points. Several solutions at 4 of them.",
        ),
        // The bed tips from mu = 1.25 on, and jams beyond cot(20 deg) = 2.747.
        (
            swept(&model(TIPPING_PRESS, &[]), &grid("mu=0.1..2.5:25")),
            "A guided slider tips at 13 of 25 points. Model it as a block slider to see whether it still moves.",
        ),
        (
            swept(&model(TIPPING_PRESS, &[]), &grid("mu=0.1..3:30")),
            "It jams, or a guided slider tips, at 18 of 30 points. Model it as a block slider to see whether it still moves.",
        ),
    ];
    assert_answers(&told);
}

#[test]
fn map_answers() {
    let options = |colour_by: ColourBy| {
        MapOptions::new("mu=0..1".parse().unwrap(), "a=0 m..0.4 m".parse().unwrap())
            .size(32, 32)
            .colour_by(colour_by)
    };
    let told = [ColourBy::Solutions, ColourBy::Jam, ColourBy::Hold]
        .map(|colour_by| map(&model("drawer", &[]), &options(colour_by)).unwrap().answer());
    let [solutions, jam, hold] = told;
    // It jams where mu a > L / 2, which is (1 - ln 2) / 2 = 15.3 % of the plane.
    assert_answers(&[
        (solutions, "84.67 % of the map: one solution. 15.33 %: no solution, friction locks it."),
        (
            jam,
            "84.67 % of the map: can move in both directions. 15.33 %: can only move in the opposite direction; as in the model friction locks it.",
        ),
        (hold, "100 % of the map: does not hold."),
    ]);
}

fn found(json: &str, options: &SearchOptions) -> String {
    let problem = RawProblem::from_json(json.as_bytes()).unwrap();
    raw_problem::solve(&problem, options, 100, &mut |_| ControlFlow::Continue(())).unwrap().answer()
}

#[test]
fn modes_answers() {
    let all = SearchOptions::default();
    let lcp = |m: &str, q: &str| format!("{{\"type\": \"lcp\", \"M\": {m}, \"q\": {q}}}");
    let told = [
        // z = 1, w = 0; z = 0, w = -1 is none.
        (found(&lcp("[[1]]", "[-1]"), &all), "One solution."),
        (found(&lcp("[[-1]]", "[-1]"), &all), "No solution."),
        // z = 1 or w = 1.
        (found(&lcp("[[-1]]", "[1]"), &all), "2 solutions."),
        // w = 0 whatever z is.
        (found(&lcp("[[0]]", "[0]"), &all), "Infinitely many solutions: one continuum."),
        (
            found(include_str!("../../slideway-cli/tests/raw/good/gap.json"), &all),
            "No solution, but there is a state with an unknown in its preload gap.",
        ),
        (
            found(&lcp("[[-1, 0.5], [0.5, -1]]", "[1, 1]"), &SearchOptions { nodes: 1, ..all }),
            "One solution found so far.",
        ),
        (
            found(r#"{"type": "game", "A": [[1, -1], [-1, 1]], "B": [[-1, 1], [1, -1]]}"#, &all),
            "One equilibrium.",
        ),
    ];
    assert_answers(&told);
}

/// Every text of default form over the gallery, with its name.
fn texts(style: Style) -> Vec<(String, String)> {
    let mut all = Vec::new();
    for each in gallery::MODELS {
        let model = Model::parse(each.text).unwrap();
        let mut tell = |question: &str, text: Option<String>| {
            all.extend(text.map(|text| (format!("{question} {}", each.name), text)));
        };
        tell("check", check(&model).ok().map(|report| report.text(style)));
        tell("drive", drive(&model, &DriveOptions::default()).ok().map(|report| report.text(style)));
        tell("hold", hold(&model, &HoldOptions::default()).ok().map(|report| report.text(style)));
        let options = options(0.02);
        let history = motion::simulate(&model, &options).ok();
        tell("simulate", history.map(|history| motion::report(&history, &options).text(style)));
    }
    let drawer = model("drawer", &[]);
    let sweep = Sweep::new(&drawer, &grid("mu=0..1:101")).unwrap();
    all.push(("sweep".to_owned(), sweep.text(&all_points(&sweep), style)));
    let axes = MapOptions::new("mu=0..1".parse().unwrap(), "a=0 m..0.4 m".parse().unwrap()).size(16, 16);
    all.push(("map".to_owned(), map(&drawer, &axes).unwrap().text(style)));
    for (name, problem) in RAW {
        let problem = RawProblem::from_json(problem.as_bytes()).unwrap();
        let options = SearchOptions::default();
        let report = raw_problem::solve(&problem, &options, 100, &mut |_| ControlFlow::Continue(())).unwrap();
        all.push((format!("modes {name}"), report.text(style)));
    }
    all
}

const RAW: [(&str, &str); 4] = [
    ("eight", include_str!("../../slideway-cli/tests/raw/good/eight.json")),
    ("game", include_str!("../../slideway-cli/tests/raw/good/game.json")),
    ("gap", include_str!("../../slideway-cli/tests/raw/good/gap.json")),
    ("segment", include_str!("../../slideway-cli/tests/raw/good/segment.json")),
];

#[test]
fn no_line_is_longer_than_the_page() {
    for (name, text) in texts(Style::PLAIN.width(80)) {
        for line in text.lines() {
            assert!(line.chars().count() <= 80, "{name}: {line}");
        }
    }
}

/// No statement is lost: the details hold every number of the default form, and more.
#[test]
fn details_hold_every_number_of_the_default_form() {
    let numbers = |text: &str| -> Vec<String> {
        let parts = text.split(|letter: char| !(letter.is_ascii_digit() || letter == '.'));
        parts.map(|part| part.trim_matches('.').to_owned()).filter(|part| !part.is_empty()).collect()
    };
    let style = Style::PLAIN.width(1000);
    for ((name, plain), (_, whole)) in texts(style).iter().zip(&texts(style.verbose(true))) {
        let mut known = numbers(whole);
        for number in numbers(plain) {
            let place = known.iter().position(|known| *known == number);
            known.swap_remove(place.unwrap_or_else(|| panic!("{name}: {number} is not in\n{whole}")));
        }
    }
}

/// An offset slider-crank of 300 rpm, with a long piston: its only solution flutters unless damped, zeta = 0.22.
#[test]
fn flutter_is_in_the_first_line_of_every_question_on_motion() {
    let crank = model("slider-crank", &[("mu", "0.8")])
        .with(&Settings::default().position("phi", "150 deg"))
        .unwrap();
    let flutters = "may vibrate by itself (flutter) unless its contacts are damped.";
    let solved = solve(&crank).unwrap().answer();
    assert!(solved.starts_with("It speeds up at "), "{solved}");
    assert!(solved.contains(&format!(". It {flutters}")), "{solved}");
    let moved = simulated(&crank, &options(1e-4));
    assert!(moved.ends_with(&format!(" On the way it {flutters}")), "{moved}");
}
