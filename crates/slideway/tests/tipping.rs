//! Blocks that may lift off a corner: tipping ends the safety factor, as a jam does, and every answer says so.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::limits::{LimitsOptions, Vary, limits};
use slideway::map::{ClassMeaning, ColourBy, MapOptions, map};
use slideway::motion::{self, SimulateOptions, simulate};
use slideway::report::{Style, Verdict};
use slideway::size::{SampleKind, SizeOptions, size};
use slideway::sweep::{GridAxis, Rows, Sweep, SweepOptions};
use slideway::{
    DriveOptions, HoldOptions, Model, Report, Settings, drive, gallery, hold, solve, warning::warnings,
};
use std::ops::ControlFlow;

/// A door that is pulled at the height h over its two shoes, which are b apart. At constant speed the pull is mu W, and its
/// moment about the front shoe, mu W h, lifts the rear one as soon as it exceeds W b/2: from mu = b/(2 h) on.
const DOOR: &str = include_str!("../../../docs/src/examples/sliding-door.toml");

fn door(settings: &[(&str, &str)]) -> Model {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(DOOR).unwrap().with(&settings).unwrap()
}

#[test]
fn tipping_ends_the_safety_factor() {
    let limit = solve(&door(&[])).unwrap().margins.unwrap().tipping.unwrap();
    assert_eq!(limit.joints, ["shoes"]);
    assert!((limit.factor - 0.45 / 0.3).abs() < 1e-12, "{limit:?}");
    // A factor x needs h = b/(2 mu x). A mode is there up to 1e-11 beyond its end.
    for (margin, at) in [(1.0, 1.5), (1.5, 1.0), (2.0, 0.75)] {
        let report = size(&door(&[]), &SizeOptions::new("h".parse::<Vary>().unwrap(), margin)).unwrap();
        assert!((report.met[0].to - at).abs() < 1e-9 && report.met.len() == 1, "{:?}", report.met);
        assert_eq!(report.tips, ["shoes"]);
    }
    // Where it tips already, friction has to fall to b/(2 h mu).
    let options = SizeOptions::new("mu".parse::<Vary>().unwrap(), 1.0);
    let report = size(&door(&[("h", "2500 mm")]), &options).unwrap();
    assert!((report.present.margin.unwrap() - 0.18 / 0.3).abs() < 1e-12, "{:?}", report.present);
    assert!(report.answer().contains("it tips (shoes); friction would have to fall to 0.6 of its value"));
}

#[test]
fn every_answer_says_that_it_tips() {
    let would = "It would tip (shoes) from mu = 0.45 (1.5 times this friction).";
    let sized = size(&door(&[]), &SizeOptions::new("mu".parse::<Vary>().unwrap(), 1.2)).unwrap().answer();
    assert!(solve(&door(&[])).unwrap().safety_in_words().concat().starts_with(would));
    assert!(drive(&door(&[]), &DriveOptions::default()).unwrap().answer().contains(would));
    assert!(
        sized.starts_with("For a safety factor of 1.2 against jamming and tipping: mu at most 0.375"),
        "{sized}"
    );
    assert!(sized.contains("its safety factor is 1.5 against tipping (shoes), which is enough."), "{sized}");
    let limited = limits(&door(&[]), &LimitsOptions::new("mu=0..1.2".parse::<Vary>().unwrap())).unwrap();
    assert_eq!(limited.answer(), "It tips from mu = 0.45 on (the model has 0.3).");
    let options = DriveOptions::default().vary("h=200 mm..5000 mm".parse::<Vary>().unwrap());
    // Held at the face, the door that has lifted its rear shoe has no state: with the moment of inertia I = m (b^2 + H^2)/12 and
    // the centre of mass c above the face it jams up to h = (I/m + b^2/4 + c^2)/(c - mu b/2) = 1.8536 m. Then it lifts the front one.
    let over = drive(&door(&[]), &options).unwrap().answer();
    let told = "Over h from 200 to 5000 mm, it jams from 1500 to 1854 mm and tips (shoes) from 1854 mm on.";
    assert!(over.contains(told), "{over}");
    let options = LimitsOptions::new("h=200 mm..5000 mm".parse::<Vary>().unwrap());
    let limited = limits(&door(&[]), &options).unwrap().answer();
    assert!(limited.contains("it jams"), "{limited}");
    assert!(limited.ends_with("h from 1853.56 to 5000 mm: it tips, which is no better."), "{limited}");
    // It tips from mu = 0.45 on.
    let sweep = Sweep::new(&door(&[]), &SweepOptions::grid([GridAxis::linear("mu", 0.1, 0.8, 8)])).unwrap();
    let mut state = sweep.start();
    sweep.run(&mut state, &|_: &Rows| (), &mut |_, _| ControlFlow::Continue(()));
    assert_eq!(sweep.answer(&state), "It tips at 4 of 8 points.");
    let high = door(&[("h", "2500 mm")]);
    let turns = simulate(&high, &SimulateOptions::new(0.1)).unwrap();
    let told = motion::report(&turns, &SimulateOptions::new(0.1)).answer();
    assert!(told.ends_with(" It tips (shoes) from 0 s on."), "{told}");
    let axes = ["h=2 m..5 m", "b=800 mm..900 mm"].map(|axis| axis.parse::<Vary>().unwrap());
    let [x, y] = axes;
    let mapped = map(&high, &MapOptions::new(x, y).size(16, 16).colour_by(ColourBy::Solutions)).unwrap();
    assert_eq!(mapped.answer(), "100 % of the map: one solution, it tips.");
    let drawn = drive(&door(&[("h", "2500 mm")]), &DriveOptions::default()).unwrap().answer();
    assert!(
        drawn.starts_with("It tips (shoes); it moves as prescribed only if pull holds it back"),
        "{drawn}"
    );
}

/// At rest a pull tips it as soon as its moment about a shoe exceeds W b/2, if friction holds it: here 9.81 * 30 * 0.45 / 1.9.
#[test]
fn what_is_held_ends_by_sliding_or_by_tipping() {
    let held = |h: &str| {
        let model = door(&[("h", h)]);
        hold(&model, &HoldOptions::default().load("pull")).unwrap().answer()
    };
    assert!(
        held("1000 mm").contains("from -88.29 to 88.29 N. Beyond, it starts to slide."),
        "{}",
        held("1000 mm")
    );
    let tips = "Below -69.7 N it tips over shoes.rear, above 69.7 N it tips over shoes.front.";
    assert!(held("1900 mm").contains(tips), "{}", held("1900 mm"));
}

#[test]
fn a_map_of_motions_tells_what_tips() {
    let [x, y] = ["mu=0.05..0.4", "h=500mm..2500mm"].map(|axis| axis.parse::<Vary>().unwrap());
    let report = map(&door(&[]), &MapOptions::new(x, y).size(24, 24).colour_by(ColourBy::Motion)).unwrap();
    let tips = report.classes.iter().position(|class| {
        matches!(&class.meaning, ClassMeaning::Motion { solutions, tipping: 1, .. } if solutions.len() == 1)
    });
    let tips = tips.unwrap();
    assert_eq!(report.classes[tips].words, "one solution: it tips");
    // Pixels at mu = 0.305, h = 2.375 m, which tips, and at mu = 0.057, h = 0.625 m.
    assert_eq!(report.class_at(17, 22), tips);
    assert_ne!(report.class_at(0, 1), tips);
}

/// Both loads hang as far from the middle of the guide, so that nothing presses it, wherever they hang: what is left of the
/// forces is rounding of some 10 N.
#[test]
fn forces_that_are_rounding_are_zero_in_tables() {
    let text =
        DOOR.replace("block_on_face", "block_slider").replace("along = \"0 deg\"", "along = \"90 deg\"");
    let text = text
        .replace("direction = \"0 deg\"", "direction = \"90 deg\"")
        .replace("handle = [\"b/2\", \"h\"]", "handle = [0, \"h\"]");
    let load = |at: &str| {
        format!("[loads.{at}]\ntype = \"force\"\nat = \"door.{at}\"\ncomponents = [0, \"-17.3 N\"]\n")
    };
    let loads = load("A") + &load("B");
    let text = text.replace("[points]", "[points]\nA = [\"-h\", 0.3]\nB = [\"h\", 0.3]");
    let model = Model::parse(
        &(text.replace("\"middle\", \"handle\"", "\"middle\", \"handle\", \"A\", \"B\"") + &loads),
    )
    .unwrap();
    let options = SweepOptions::grid([GridAxis::linear("h", 0.01, 0.2, 40)]).breakpoints(false);
    let sweep = Sweep::new(&model, &options).unwrap();
    let mut state = sweep.start();
    let mut forces = Vec::new();
    sweep.run(&mut state, &Rows::clone, &mut |all, _| {
        for rows in all {
            forces.extend((0..rows.len()).flat_map(|row| rows.numbers(row)[1..5].to_vec()));
        }
        ControlFlow::Continue(())
    });
    assert_eq!(forces.len(), 160);
    assert!(forces.iter().all(|force| *force == 0.0), "{forces:?}");
}

/// By hand: on the cam that falls away the foot floats, and its motor needs nothing.
#[test]
fn efforts_that_cancel_are_zero() {
    let model = Model::parse(gallery::find("cam-and-spring").unwrap().text).unwrap();
    let options = DriveOptions::default().vary("speed=50rad/s..100rad/s".parse::<Vary>().unwrap());
    let course = drive(&model, &options).unwrap().course.unwrap();
    for row in &course.directions[0].rows {
        assert_eq!(row.efforts.as_deref(), Some(&[0.0][..]), "{row:?}");
        assert_eq!(row.frictionless.as_deref(), Some(&[0.0][..]), "{row:?}");
    }
}

/// What touches has no gap and what sticks no velocity in the table of a motion: a block that rocks about one corner.
#[test]
fn rounding_is_no_motion_in_tables() {
    let text = include_str!("../../../docs/src/examples/rocking-block.toml");
    let history = simulate(&Model::parse(text).unwrap(), &SimulateOptions::new(0.1)).unwrap();
    let series = history.series(&history.times_in_steps(0.01));
    for name in ["base.rear.gap", "base.rear.sliding_velocity", "x.rate", "x.acceleration"] {
        let values = &series.column(name).unwrap().values;
        assert!(values.iter().all(|value| *value == Some(0.0)), "{name}: {values:?}");
    }
    assert!(series.column("turn.rate").unwrap().values[5].unwrap() < -0.1);
}

#[test]
fn a_base_under_the_floor_is_warned_of() {
    let behind = |text: &str| -> Vec<String> {
        let found = warnings(&Model::parse(text).unwrap());
        found.sorted().iter().map(|fault| fault.kind.to_string()).collect()
    };
    assert_eq!(behind(DOOR), Vec::<String>::new());
    let sunk = DOOR.replace("centre_of_mass = [0, \"1000 mm\"]", "centre_of_mass = [0, \"900 mm\"]");
    assert_eq!(behind(&sunk), ["door lies partly behind the face of shoes"]);
    let under = DOOR.replace("along = \"0 deg\"", "along = \"180 deg\"");
    assert_eq!(behind(&under)[0], "door lies behind the face of shoes");
}

/// Backwards the moment of the pull lifts the other shoe at the same friction, b/(2 h).
#[test]
fn it_tips_in_both_directions() {
    let options = LimitsOptions::new("mu=0..1.2".parse::<Vary>().unwrap()).both_directions(true);
    let report = limits(&door(&[]), &options).unwrap();
    assert_eq!(
        report.conclusion,
        [
            "mu from 0 to 0.45: it can move in both directions.",
            "mu from 0.45 to 1.2: in both directions it tips."
        ]
    );
}

/// The door hangs below its rail and is pulled |h| = 1 m below it. Its centre of mass is d = 50 mm beyond the front shoe: its
/// weight lifts the rear shoe until the pull, mu W |h|, balances W d, at mu = d/|h| = 0.05; from mu = (b + d)/|h| = 0.35 on the
/// pull lifts the front shoe.
fn hung(settings: &[(&str, &str)]) -> Model {
    let text = DOOR
        .replace("b = \"900 mm\"", "b = \"300 mm\"\nd = \"50 mm\"")
        .replace("h = \"1000 mm\"", "h = \"-1000 mm\"")
        .replace("mu = 0.3", "mu = 0.1")
        .replace("centre_of_mass = [0, \"1000 mm\"]", "centre_of_mass = [\"b/2 + d\", \"-1000 mm\"]");
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(&text).unwrap().with(&settings).unwrap()
}

#[test]
fn what_tips_with_less_friction_has_no_safety_factor() {
    let model = hung(&[]);
    let report = solve(&model).unwrap();
    let margins = report.margins.as_ref().unwrap();
    let (below, above) = (margins.below.as_ref().unwrap(), margins.tipping.as_ref().unwrap());
    assert!((below.factor - 0.5).abs() < 1e-12 && (above.factor - 3.5).abs() < 1e-12, "{margins:?}");
    let told = "With less friction it tips (shoes): below mu = 0.05.";
    assert!(report.safety_in_words().concat().ends_with(told), "{:?}", report.safety_in_words());
    let driven = drive(&model, &DriveOptions::default()).unwrap();
    assert_eq!(driven.directions[0].below.as_ref(), Some(below));
    assert!(driven.answer().contains(told), "{}", driven.answer());
    // Friction may be anything below what it is taken for: the centre of mass may not be beyond the front shoe, and a factor 2
    // up needs b + d >= 2 mu |h|.
    let options = SizeOptions::new("d=-200mm..200mm".parse::<Vary>().unwrap(), 2.0);
    let sized = size(&model, &options).unwrap();
    assert!((sized.met[0].from + 0.1).abs() < 1e-9 && sized.met[0].to.abs() < 1e-9, "{:?}", sized.met);
    assert_eq!((sized.met.len(), sized.present.is), (1, SampleKind::NeedsFriction));
    assert!((sized.present.least_friction.unwrap() - 0.5).abs() < 1e-12, "{:?}", sized.present);
    let answer = sized.answer();
    let none = "with less friction it tips (shoes): below mu = 0.05, so no safety factor makes it safe.";
    assert!(answer.ends_with(none), "{answer}");
    // Where it tips as it is, it takes more friction not to.
    let tips = size(&hung(&[("mu", "0.04")]), &options).unwrap();
    assert!((tips.present.least_friction.unwrap() - 1.25).abs() < 1e-12, "{:?}", tips.present);
    let tips = solve(&hung(&[("mu", "0.04")])).unwrap().verdict_in_words();
    assert!(tips.starts_with("It tips: shoes.rear lifts off (below mu = 0.05). pull needs "), "{tips}");
    let tips = solve(&hung(&[("mu", "0.4")])).unwrap().verdict_in_words();
    assert!(tips.starts_with("It tips: shoes.front lifts off (from mu = 0.35 on). pull needs "), "{tips}");
}

/// What happens first on both sides of the friction at which it moves sums up the limits.
#[test]
fn limits_have_a_sentence_for_both_ends() {
    let report = limits(&hung(&[]), &LimitsOptions::new("mu=0..1".parse::<Vary>().unwrap())).unwrap();
    assert_eq!(report.answer(), "It tips below mu = 0.05 and from mu = 0.35 on (the model has 0.1).");
    assert_eq!(report.sentences().len(), 4);
}

/// A pull that is a load stays as it is: more friction stops it, and that is no jam.
#[test]
fn without_a_drive_size_says_that_nothing_jams() {
    let model = Model::parse(gallery::find("rattling-drawer").unwrap().text).unwrap();
    let answer =
        size(&model, &SizeOptions::new("a=0.1m..0.2m".parse::<Vary>().unwrap(), 2.0)).unwrap().answer();
    assert!(
        answer.starts_with(
            "While it moves nothing jams it, however great the friction, at any a from 0.1 to 0.2 m."
        ),
        "{answer}"
    );
    assert!(answer.contains("give the push as a drive"), "{answer}");
}

/// The drawer is pulled at its edge: from mu = L/(2 a) = 0.8 on nothing keeps it moving, and it sticks on two corners.
#[test]
fn a_drawer_that_sticks_in_its_play_is_wedged() {
    let settings = [("c", "0"), ("a", "0.25"), ("mu", "0.9")];
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    let model =
        Model::parse(gallery::find("rattling-drawer").unwrap().text).unwrap().with(&settings).unwrap();
    let options = SimulateOptions::new(1.0);
    let report = motion::report(&simulate(&model, &options).unwrap(), &options);
    assert!(
        report.answer().contains(", wedged between both faces of its guide, and stays so"),
        "{}",
        report.answer()
    );
    let last = &report.events.last().unwrap().words;
    let wedged =
        "sticks, wedged between both faces (rails.front on the lower one, rails.rear on the upper one)";
    assert!(last.contains(wedged), "{last}");
    let text = report.text(Style::PLAIN);
    assert!(text.contains("it hits there") && text.lines().count() < 40, "{text}");
}

#[test]
fn what_hangs_on_its_rail_is_not_behind_it() {
    let found = warnings(&hung(&[]));
    assert_eq!(found.sorted().len(), 0, "{found:?}");
}

/// A sled of mass m on two corners in front and one behind, all at b = 50 mm from its middle, pulled at the height h. Held at
/// constant speed it tips forwards from mu = b/h on.
const SLED: &str = r#"
gravity = [0, 0, "-9.81 m/s^2"]
[parameters]
h = "150 mm"
mu = 0.2
[points]
o = [0, 0]
rope = ["50 mm", 0, "h"]
S = [0, 0, "50 mm"]
[bodies.sled]
points = ["o", "rope", "S"]
mass = "4 kg"
centre_of_mass = "S"
shape = { box = ["100 mm", "80 mm", "100 mm"] }
[joints.bed]
type = "block_slider"
block = "sled"
at = "o"
along = 0
length = "100 mm"
mu = "mu"
rests_on = { width = "60 mm", one_sided = true, corners = 3 }
[coordinates.x]
slide = "bed"
rate = "100 mm/s"
[drives.pull]
coordinate = "x"
force = { at = "sled.rope", direction = 0 }
"#;

fn sled(text: &str, settings: &[(&str, &str)]) -> Model {
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(text).unwrap().with(&settings).unwrap()
}

/// With the height c = 50 mm of its centre, the rear corner alone down, and o at constant speed:
/// `P - mu N = m a c`, `N - m g = -m a b`, `P (h - c) + mu N c + N b = I a`, so that
/// `N (1 - m b (mu h + b)/(m c (h - c) - I)) = m g`: for h = 0.4 m it is held back by 14.014 N, and jams from mu = 2/3 on.
#[test]
fn a_sled_pulled_high_tips_and_then_jams_in_every_answer() {
    let high = sled(SLED, &[("h", "400 mm")]);
    let (m, c, b, h, mu) = (4.0, 0.05, 0.05, 0.4, 0.2);
    let beyond: f64 = m * c * (h - c) - 4.0 * (0.01 + 0.01) / 12.0;
    let force = m * 9.81 / (1.0 - m * b * (mu * h + b) / beyond);
    let pull = mu * force - m * c * force * (mu * h + b) / beyond;
    assert!((solve(&high).unwrap().solutions[0].drives[0].effort - pull).abs() < 1e-9, "{pull}");
    let held = "moves as prescribed only if pull holds it back, with 14.01 N against the motion. ";
    let jams = "It would jam from mu = 0.6667 (3.333 times this friction).";
    let tips = "It tips: bed.front_left and bed.front_right lift off (from mu = 0.125 on). It ";
    let answer = solve(&high).unwrap().answer();
    assert!(answer.starts_with(&format!("{tips}{held}{jams}")), "{answer}");
    let answer = drive(&high, &DriveOptions::default()).unwrap().answer();
    assert!(answer.starts_with(&format!("It tips (bed); it {held}{jams}")), "{answer}");
    let limited =
        |model| limits(model, &LimitsOptions::new("mu=0.05..1.5".parse::<Vary>().unwrap())).unwrap();
    let answer = limited(&high).answer();
    assert!(answer.contains("0.125 to 0.666667: it tips. mu from 0.666667 to 1.5: it jams."), "{answer}");
}

/// Where the state that stands and the one that tips end together, at mu = b/h, nothing is left: it jams, whoever is asked.
#[test]
fn what_ends_with_the_state_that_tips_jams() {
    let low = sled(SLED, &[]);
    let jams = "It would jam from mu = 0.3333 (1.667 times this friction)";
    // The place of x leaves the stability of the state that stands undecided.
    let ways =
        "It can go on in 2 ways, and which of them a real mechanism takes is not decided: pull needs 7.848";
    for answer in [solve(&low).unwrap().answer(), drive(&low, &DriveOptions::default()).unwrap().answer()] {
        assert!(answer.starts_with(ways) && answer.contains(jams), "{answer}");
        assert!(!answer.contains("it tips (bed) from"), "{answer}");
    }
    let sized = size(&low, &SizeOptions::new("h".parse::<Vary>().unwrap(), 1.0)).unwrap();
    assert!((sized.met[0].to - 0.25).abs() < 1e-9 && sized.tips.is_empty(), "{:?}", sized.tips);
    let limited = limits(&low, &LimitsOptions::new("mu=0.05..1.5".parse::<Vary>().unwrap())).unwrap();
    assert!(limited.answer().ends_with("mu from 0.333333 to 1.5: it jams."), "{}", limited.answer());
}

/// Sides of the guide that carry nothing, whichever side the block is on, are neither a boundary nor leave stability open.
#[test]
fn sides_that_carry_nothing_are_no_boundary() {
    let slide = sled(&SLED.replace(", one_sided = true, corners = 3", ""), &[("h", "30 mm")]);
    let report = solve(&slide).unwrap();
    let [only] = report.solutions.as_slice() else { panic!("{}", report.answer()) };
    assert!(only.on_boundary && only.contacts[0].normal_force == 0.0);
    assert_eq!(only.attainability.verdict, Verdict::Attainable);
    let text = report.text(Style::PLAIN);
    assert!(!text.contains("boundary") && !text.contains("Stability"), "{text}");
    // A push off its middle presses them, ever so little, and changes nothing else.
    let aside = sled(
        &SLED.replace(", one_sided = true, corners = 3", "").replace("0, \"h\"", "\"0.001 mm\", \"h\""),
        &[("h", "30 mm")],
    );
    let other = solve(&aside).unwrap();
    assert_eq!(other.solutions[0].attainability.verdict, Verdict::Attainable);
}
