//! The first line of every question for every kind of outcome. The compiler sees to it that no pair is missing.

#![allow(clippy::unwrap_used, reason = "a test stops at the first surprise")]

use slideway::check::{check, check_with};
use slideway::drive::drive_with;
use slideway::limits::{LimitsOptions, Vary, limits, limits_with};
use slideway::map::{ColourBy, MapOptions, map, map_with};
use slideway::mechanism::Mechanism;
use slideway::modes::SearchOptions;
use slideway::motion::{self, SimulateOptions, Thorough};
use slideway::raw_problem::{self, RawProblem};
use slideway::size::{Against, SizeOptions, size, size_with};
use slideway::solve::{SolveOptions, solve_with};
use slideway::standstill::hold_with;
use slideway::sweep::{Rows, Sweep, SweepOptions};
use slideway::{
    DriveOptions, HoldOptions, Model, Report, Settings, configuration::Configuration, drive, gallery, hold,
    solve,
};
use std::ops::ControlFlow;

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Question {
    Solve,
    Limits,
    Size,
    Drive,
    Hold,
    Map,
    Sweep,
    Simulate,
    Check,
    Modes,
}

/// What comes out.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outcome {
    One,
    Nothing,
    Several,
    Undetermined,
    Gap,
    Tip,
    Jam,
    SlowsDown,
    /// It stays at rest on contacts that may lift off.
    Rests,
    LiftsOff,
    Undecided,
    Interrupted,
}

/// What is expected of a pair.
enum First {
    /// This answer.
    Line(String, &'static str),
    /// There is no such outcome, for this reason.
    Never(&'static str),
    /// Of a part of the work there is no answer at all; the program says that it was interrupted.
    NoReport(bool),
}

use First::{Line, Never, NoReport};
use Outcome::{
    Gap, Interrupted, Jam, LiftsOff, Nothing, One, Rests, Several, SlowsDown, Tip, Undecided, Undetermined,
};
use Question::{Check, Drive, Hold, Limits, Map, Modes, Simulate, Size, Solve};

const QUESTIONS: [Question; 10] =
    [Solve, Limits, Size, Drive, Hold, Map, Question::Sweep, Simulate, Check, Modes];
const OUTCOMES: [Outcome; 12] =
    [One, Nothing, Several, Undetermined, Gap, Tip, Jam, SlowsDown, Rests, LiftsOff, Undecided, Interrupted];

const EQUAL_PLAY: &str = include_str!("findings/equal_play.toml");
const TIPPING_PRESS: &str = include_str!("findings/tipping_press.toml");
const GUIDED_GAP: &str = include_str!("findings/guided_gap.toml");
const PEG: &str = include_str!("../../../docs/src/examples/peg-pushed-by-load.toml");
/// A state in a preload gap and no other (Klepp (2002), without the force `F_20`).
const IN_GAP: [(&str, &str); 3] = [("mu_1", "0.24"), ("F_30", "0.5*m*g"), ("F_20", "0")];
/// At mu = L / (2 a) = 2/3 the determinant is zero but for rounding.
const VERGE: [(&str, &str); 1] = [("mu", "2/3")];

/// A model of the gallery, or its text, with some parameters.
fn model(text: &str, settings: &[(&str, &str)]) -> Model {
    let text = gallery::find(text).map_or(text, |model| model.text);
    let settings = settings.iter().fold(Settings::default(), |all, (name, value)| all.parameter(name, value));
    Model::parse(text).unwrap().with(&settings).unwrap()
}

fn solved(text: &str, settings: &[(&str, &str)]) -> String {
    solve(&model(text, settings)).unwrap().answer()
}

fn limited(text: &str, settings: &[(&str, &str)], vary: &str) -> String {
    limits(&model(text, settings), &LimitsOptions::new(vary.parse::<Vary>().unwrap())).unwrap().answer()
}

fn sized(text: &str, settings: &[(&str, &str)], vary: &str) -> String {
    size(&model(text, settings), &SizeOptions::new(vary.parse::<Vary>().unwrap(), 1.5)).unwrap().answer()
}

fn driven(text: &str, settings: &[(&str, &str)]) -> String {
    let all = drive(&model(text, settings), &DriveOptions::default()).unwrap().answer();
    all.split(" Backwards, ").next().unwrap_or_default().to_owned()
}

fn held(text: &str, settings: &[(&str, &str)]) -> String {
    hold(&model(text, settings), &HoldOptions::default()).unwrap().answer()
}

fn mapped(text: &str, settings: &[(&str, &str)], axes: [&str; 2]) -> String {
    let [x, y] = axes.map(|axis| axis.parse::<Vary>().unwrap());
    let options = MapOptions::new(x, y).size(16, 16).colour_by(ColourBy::Solutions);
    map(&model(text, settings), &options).unwrap().answer()
}

fn swept(text: &str, settings: &[(&str, &str)], axis: &str, ends: bool) -> String {
    let sweep = Sweep::new(&model(text, settings), &SweepOptions::grid([axis.parse().unwrap()])).unwrap();
    let mut state = sweep.start();
    sweep.run(&mut state, &|_: &Rows| (), &mut |_, _| {
        if ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    sweep.answer(&state)
}

fn simulated(text: &str, settings: &[(&str, &str)], duration: f64) -> String {
    let options = SimulateOptions::new(duration);
    let history = motion::simulate(&model(text, settings), &options).unwrap();
    motion::report(&history, &options).answer()
}

fn checked(text: &str, settings: &[(&str, &str)]) -> String {
    check(&model(text, settings)).unwrap().answer()
}

fn found(json: &str, options: &SearchOptions, ends: bool) -> String {
    let problem = RawProblem::from_json(json.as_bytes()).unwrap();
    let flow = || if ends { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    raw_problem::solve(&problem, options, 100, &mut |_| flow()).unwrap().answer()
}

fn of_solve(outcome: Outcome) -> First {
    match outcome {
        One => Line(solved("drawer", &[]), "It moves: push needs 36.36 N (20 N without friction). "),
        Nothing => Line(solved("painleve-klein", &[("mu", "4")]), "It jams: friction locks it. "),
        Several => {
            Line(solved("klepp-2002", &[]), "It can go on in 2 ways, and what went before decides which. ")
        }
        Undetermined => Line(
            solved(EQUAL_PLAY, &[]),
            "How left, right share the load is undetermined: belt 25 to 50 N. Give `stiffness` for one value.",
        ),
        Gap => Line(
            solved("klepp-2002", &IN_GAP),
            "It moves in a preload gap, lower.rear pressed by its preload alone: it slows down ",
        ),
        Tip => Line(
            solved(TIPPING_PRESS, &[("mu", "1.3")]),
            "No answer: it tips (bed), which only a block slider can show.",
        ),
        Jam => Line(solved("drawer", &[("mu", "0.7")]), "It jams: no force of push moves it. "),
        SlowsDown => Line(solved(PEG, &[]), "It slows down at "),
        Rests => Line(solved("ladder", &[]), "It holds. The forces at rest are not determined: "),
        LiftsOff => Line(
            solved("box-on-incline", &[]),
            "It tips: base.front lifts off (from mu = 0.5 on). It slows down at 5.444 m/s^2.",
        ),
        Undecided => Line(solved("drawer", &VERGE), "Not decided: it is on the verge of jamming, "),
        Interrupted => {
            let mut stop = |_: &_| ControlFlow::Break(());
            let ended = solve_with(&model("klepp-2002", &[]), &SolveOptions::default(), &mut stop);
            Line(ended.unwrap().answer(), "Not decided: the search is not finished; ")
        }
    }
}

fn of_limits(outcome: Outcome) -> First {
    match outcome {
        One => Line(limited("drawer", &[], "mu=0..0.5"), "It moves for mu from 0 to 0.5."),
        Nothing => {
            Line(limited("painleve-klein", &[], "mu=4..5"), "It jams for mu from 4 to 5 (the model has 0.5).")
        }
        Several => Line(limited("klepp-2002", &[], "mu_1=0.5..1"), "mu_1 from 0.5 to 1: three solutions."),
        Undetermined => Line(
            limited(EQUAL_PLAY, &[], "mu=0..1"),
            "mu from 0 to 0.25: it moves, but how left, right share the load is undetermined.",
        ),
        Gap => Line(
            limited("klepp-2002", &IN_GAP, "m=0.9 kg..1.1 kg"),
            "m from 0.9 to 1.1 kg: it moves in a preload gap.",
        ),
        Tip => Line(
            limited(TIPPING_PRESS, &[], "mu=1.26..1.3"),
            "mu from 1.26 to 1.3: it tips (bed), which only a block slider can show.",
        ),
        Jam => Line(limited("drawer", &[], "mu=0..1.5"), "It jams from mu = 0.6667 on (the model has 0.3)."),
        SlowsDown => {
            Line(limited(PEG, &[], "mu=0.3..0.5"), "mu from 0.3 to 0.5: it slows down (one solution). ")
        }
        Rests => Line(limited("ladder", &[], "climbed=0..0.5"), "climbed from 0 to 0.5: it holds (sampled)."),
        LiftsOff => Line(
            limited("cam-and-spring", &[], "speed=10 rad/s..60 rad/s"),
            "It moves for speed from 10 to 60 rad/s. foot lifts off from speed = 43.88 rad/s on.",
        ),
        Undecided => Line(limited("drawer", &VERGE, "Q=1 N..30 N"), "Q from 1 to 30 N: not decided."),
        Interrupted => {
            let options = LimitsOptions::new(Vary::between("mu", 0.0, 1.0));
            NoReport(
                limits_with(&model("drawer", &[]), &options, &mut |_| ControlFlow::Break(()))
                    .unwrap()
                    .is_none(),
            )
        }
    }
}

fn of_size(outcome: Outcome) -> First {
    const LENGTHS: &str = "L=0.1 m..1 m";
    match outcome {
        One => Line(
            sized("drawer", &[], LENGTHS),
            "For a safety factor of 1.5 against jamming: L at least 0.27 m (examined up to 1 m). ",
        ),
        Nothing => {
            // At rest: the bracket holds from x = B / (2 mu_static) = 304.8 mm on.
            let options = SizeOptions::new("x=1 mm..400 mm".parse::<Vary>().unwrap(), 1.0)
                .against(Against::Hold { load: Some("W".to_owned()) });
            Line(
                size(&model("bracket-on-pole", &[]), &options).unwrap().answer(),
                "To hold every `W` with a safety factor of 1: x at least 304.8 mm",
            )
        }
        Several => Line(
            sized("klepp-2002", &[], "l=0.2 m..5 m"),
            "While it moves nothing jams it, however great the friction, at any l from 0.2 to 5 m. ",
        ),
        Undetermined => Line(
            sized(EQUAL_PLAY, &[], "mu=0.1..0.5"),
            "For a safety factor of 1.5 against jamming: mu can have any value from 0.1 to 0.5. ",
        ),
        Gap => Line(
            sized("klepp-2002", &IN_GAP, "l=0.9 m..1.1 m"),
            "While it moves nothing jams it, however great the friction, at any l from 0.9 to 1.1 m. ",
        ),
        Tip => Line(
            sized(TIPPING_PRESS, &[], "mu=0.1..1"),
            "For a safety factor of 1.5 against jamming and tipping: mu at most 0.833333 (examined down to 0.1). ",
        ),
        Jam => Line(
            sized("drawer", &[("mu", "0.7")], LENGTHS),
            "For a safety factor of 1.5 against jamming: L at least 0.63 m (examined up to 1 m). The model has L = 0.4 m: it jams; ",
        ),
        SlowsDown => Line(
            sized(PEG, &[], "mu=0.3..0.5"),
            "While it moves nothing jams it, however great the friction, at any mu from 0.3 to 0.5. ",
        ),
        Rests => {
            // With 1/3 at the floor and 0.2 at the wall: (middle of the weights) = (1/3)/(1 + 0.2/3) (tan 60 deg + 0.2) = 0.603766,
            // which is 1/2 + 8/9 (climbed - 1/2).
            let options = SizeOptions::new("climbed=0..1".parse::<Vary>().unwrap(), 1.5)
                .against(Against::Hold { load: None });
            Line(
                size(&model("ladder", &[]), &options).unwrap().answer(),
                "To hold with a safety factor of 1.5: climbed at most 0.616737 (examined down to 0). The model has \
                 climbed = 0.5: it holds with a safety factor of 1.815, which is enough.",
            )
        }
        LiftsOff => Line(
            sized("box-on-incline", &[], "mu=0.1..2"),
            "For a safety factor of 1.5 against jamming and tipping: mu at most 0.333333 (examined down to 0.1). ",
        ),
        Undecided => Line(
            sized("drawer", &VERGE, "Q=1 N..30 N"),
            "For a safety factor of 1.5 against jamming: no Q from 1 to 30 N gives it; ",
        ),
        Interrupted => {
            let options = SizeOptions::new(Vary::between("L", 0.1, 1.0), 1.5);
            NoReport(
                size_with(&model("drawer", &[]), &options, &mut |_| ControlFlow::Break(()))
                    .unwrap()
                    .is_none(),
            )
        }
    }
}

fn of_drive(outcome: Outcome) -> First {
    match outcome {
        One => Line(driven("drawer", &[]), "push needs 36.36 N (20 N without friction): efficiency 55 %. "),
        Nothing | Jam => {
            Line(driven("drawer", &[("mu", "0.7")]), "It jams: no force moves it. It moves below ")
        }
        Several => Line(
            driven("drawer", &[("mu", "0.8"), ("v", "-0.1 m/s")]),
            "push needs 9.091 N (20 N without friction) to brake the load: efficiency 45.45 %. Another state, at -100 N, is unstable.",
        ),
        Undetermined => {
            Line(driven(EQUAL_PLAY, &[]), "belt needs 25 to 50 N (20 N without friction), efficiency ")
        }
        Gap => {
            let push = "[drives.push]\ncoordinate = \"x\"\nforce = { at = \"b.S\", direction = \"0 deg\" }\n[coordinates.x]";
            let pushed = GUIDED_GAP.replace("[coordinates.x]", push);
            Line(driven(&pushed, &[("P", "0 N")]), "push needs 6 N, all of it against friction.")
        }
        Tip => Line(
            driven(TIPPING_PRESS, &[("mu", "1.3")]),
            "It tips (bed), which only a block slider can show. It does not tip below mu = 1.25.",
        ),
        SlowsDown => Never("a drive prescribes the motion"),
        Rests => Never("a drive that holds what it carries: of what rests by itself `hold` is asked"),
        LiftsOff => Line(
            driven("cam-and-spring", &[("speed", "50 rad/s")]),
            "motor needs 0 N m: nothing resists it. foot lifts off. ",
        ),
        Undecided => Line(
            driven("drawer", &VERGE),
            "It is not decided whether it moves: it is on the verge of jamming. ",
        ),
        Interrupted => {
            let model = model("drawer", &[]);
            let ended = drive_with(&model, &DriveOptions::default(), &mut |_| ControlFlow::Break(()));
            NoReport(ended.unwrap().is_none())
        }
    }
}

fn of_hold(outcome: Outcome) -> First {
    match outcome {
        One => Line(held("klepp-2002", &[]), "It holds even without friction."),
        Nothing => Line(
            held(include_str!("../../../docs/src/examples/guided-tips.toml"), &[]),
            "It can neither stay at rest nor start to slide with finite accelerations.",
        ),
        Several => Line(
            held(
                include_str!("findings/sash.toml"),
                &[("mu", "0.7"), ("mu_s", "0.7"), ("cord_force", "0 N")],
            ),
            "It may hold, or it may start to slide: do not rely on it.",
        ),
        Undetermined => Never("reactions at rest are ranges below the answer, which they do not change"),
        Gap => Line(held(GUIDED_GAP, &[("P", "0 N"), ("M", "0 N m")]), "It holds"),
        Tip => Never("a guided slider that would tip neither rests nor slides: see above"),
        Jam => Never("what rests does not jam: it holds"),
        SlowsDown => Line(
            held("drawer", &[]),
            "It does not hold: it starts to slide (x: -4 m/s^2). More friction would not hold it.",
        ),
        // 1 over the least factor f of friction: f/2/(1 + 0.15 f^2) (tan 60 deg + 0.3 f) = 1/2, f = 0.55105.
        Rests => Line(held("ladder", &[]), "It holds with a safety factor of 1.815."),
        LiftsOff => Line(
            held("box-on-incline", &[("slope", "30 deg")]),
            "It does not hold: it tips over base.rear. More friction would not hold it.",
        ),
        Undecided => Never("a linear program that is not solved: seen by the tests of the module"),
        Interrupted => {
            let model = model("drawer", &[]);
            let ended = hold_with(&model, &HoldOptions::default(), &mut |_| ControlFlow::Break(()));
            NoReport(ended.unwrap().is_none())
        }
    }
}

fn of_map(outcome: Outcome) -> First {
    let drawer = |friction| mapped("drawer", &[], [friction, "Q=1 N..30 N"]);
    match outcome {
        One => Line(drawer("mu=0..0.5"), "100 % of the map: one solution."),
        Nothing | Jam => Line(drawer("mu=0.7..1"), "100 % of the map: no solution, friction locks it."),
        Several => Line(
            mapped("klepp-2002", &[], ["mu_1=0.5..0.6", "m=0.9 kg..1.1 kg"]),
            "100 % of the map: three solutions, one preload-gap state.",
        ),
        Undetermined => Line(
            mapped(EQUAL_PLAY, &[], ["mu=0.1..0.2", "Q=1 N..2 N"]),
            "100 % of the map: infinitely many solutions.",
        ),
        Gap => Line(
            mapped("klepp-2002", &IN_GAP, ["mu_1=0.23..0.25", "m=0.9 kg..1.1 kg"]),
            "100 % of the map: no solution, one preload-gap state.",
        ),
        Tip => Line(
            mapped(TIPPING_PRESS, &[], ["mu=1.26..1.3", "Q=1 N..2 N"]),
            "100 % of the map: no solution, a guided slider tips (model it as a block slider).",
        ),
        SlowsDown => Never("a map counts solutions; coloured by motion it says what becomes of the motion"),
        Rests => {
            Line(mapped("ladder", &[], ["climbed=0..0.5", "lean=50 deg..70 deg"]), "100 % of the map: holds.")
        }
        LiftsOff => Never("a map counts solutions"),
        Undecided => Line(
            mapped("drawer", &VERGE, ["m=1 kg..2 kg", "Q=1 N..30 N"]),
            "100 % of the map: not decided, it is on the verge of jamming; take it as jammed.",
        ),
        Interrupted => {
            let options =
                MapOptions::new("mu=0..1".parse().unwrap(), "a=0 m..0.4 m".parse().unwrap()).size(16, 16);
            let ended = map_with(&model("drawer", &[]), &options, &mut |_| ControlFlow::Break(()));
            NoReport(ended.unwrap().is_none())
        }
    }
}

fn of_sweep(outcome: Outcome) -> First {
    match outcome {
        One => Line(swept("drawer", &[], "mu=0..0.6:7", false), "It jams at none of 7 points."),
        Nothing => Line(swept("drawer", &[], "mu=0.7..1:4", false), "It jams at all 4 points."),
        Several => Line(
            swept("drawer", &[("v", "-0.1 m/s")], "mu=0..1:11", false),
            "It jams at none of 11 points. Several solutions at 4 of them.",
        ),
        Undetermined => Line(swept(EQUAL_PLAY, &[], "mu=0.1..0.3:3", false), "It jams at none of 3 points."),
        Gap => {
            Line(swept("klepp-2002", &IN_GAP, "m=0.9 kg..1.1 kg:3", false), "It jams at none of 3 points.")
        }
        Tip => Line(
            swept(TIPPING_PRESS, &[], "mu=0.1..2.5:25", false),
            "A guided slider tips at 13 of 25 points. Model it as a block slider ",
        ),
        Jam => Line(swept("drawer", &[], "mu=0..1:101", false), "It jams at 34 of 101 points."),
        SlowsDown | LiftsOff => Never("a sweep counts jams; accelerations are columns of its table"),
        Rests => Line(swept("ladder", &[], "climbed=0..1:5", false), "It holds at 4 of 5 points."),
        Undecided => Line(
            swept("drawer", &VERGE, "Q=1 N..30 N:4", false),
            "It jams at none of 4 points. Not decided at 4 of them.",
        ),
        Interrupted => Line(swept("drawer", &[], "mu=0..1:100001", true), "It jams at none of "),
    }
}

fn of_simulate(outcome: Outcome) -> First {
    match outcome {
        One => Line(simulated("drawer", &[], 0.5), "It is still moving at 0.5 s."),
        Nothing => Line(
            simulated("painleve-klein", &[("mu", "4")], 0.1),
            "It jams at 0 s and stays at rest until 0.1 s.",
        ),
        Several => {
            let model = model("klepp-2002-spring", &[("mu_1", "0.6")]);
            let mechanism = Mechanism::new(&model).unwrap();
            let configuration = Configuration::new(&mechanism).unwrap();
            let options = SimulateOptions::new(0.1);
            let mut go_on = |_: &_| ControlFlow::Continue(());
            let tree =
                motion::simulate_all(&mechanism, &configuration, &options, (&mut Thorough, 9), &mut go_on);
            Line(
                motion::tree_report(&tree.unwrap(), &options).answer(),
                "2 motions are possible: these are all.",
            )
        }
        Undetermined => Never("guides that share a load are refused: their motion is not computed"),
        Gap => Line(simulated(GUIDED_GAP, &[], 0.01), "It is still moving at 0.01 s."),
        Tip => Line(
            simulated(TIPPING_PRESS, &[("mu", "1.3")], 0.1),
            "It ends at 0 s: it tips (bed), which only a block slider can show.",
        ),
        Jam => {
            Line(simulated("thrown-drawer", &[], 0.6), "It jams at 0.3692 s and stays at rest until 0.6 s.")
        }
        SlowsDown => Line(simulated(PEG, &[], 2.0), "It comes to rest at "),
        Rests => Line(simulated("ladder", &[], 0.1), "It stays at rest until 0.1 s."),
        LiftsOff => {
            Line(simulated("rod-on-floor", &[], 1.0), "It comes to rest at 0.1994 s and stays so until 1 s.")
        }
        Undecided => Line(simulated("drawer", &VERGE, 0.1), "It jams at once, at 0 s: "),
        Interrupted => {
            let model = model("klepp-2002-spring", &[]);
            let mechanism = Mechanism::new(&model).unwrap();
            let configuration = Configuration::new(&mechanism).unwrap();
            let options = SimulateOptions::new(0.1);
            let mut stop = |_: &_| ControlFlow::Break(());
            let ended = motion::simulate_with(&mechanism, &configuration, &options, &mut Thorough, &mut stop);
            Line(motion::report(&ended.unwrap(), &options).answer(), "Not finished: it was followed to ")
        }
    }
}

/// `check` looks at a model, not for solutions.
fn of_check(outcome: Outcome) -> First {
    match outcome {
        One => {
            Line(checked("drawer", &[]), "Ready for: solve, limits, size, sweep, map, drive, hold, simulate.")
        }
        Nothing => Line(
            checked(include_str!("../../slideway-cli/tests/bad/short-rod.toml"), &[]),
            "No question can be answered in this state: 1 fault.",
        ),
        Undetermined => Line(
            checked(EQUAL_PLAY, &[]),
            "Ready for: solve, limits, size, sweep, map, drive, hold. Not for simulate: see below.",
        ),
        Several | Gap | Tip | Jam | SlowsDown | Rests | LiftsOff | Undecided => {
            Never("that is for the questions to find")
        }
        Interrupted => {
            NoReport(check_with(&model("drawer", &[]), &mut |_| ControlFlow::Break(())).unwrap().is_none())
        }
    }
}

fn of_modes(outcome: Outcome) -> First {
    let all = SearchOptions::default();
    let lcp = |m: &str, q: &str| format!("{{\"type\": \"lcp\", \"M\": {m}, \"q\": {q}}}");
    match outcome {
        One => Line(found(&lcp("[[1]]", "[-1]"), &all, false), "One solution."),
        Nothing => Line(found(&lcp("[[-1]]", "[-1]"), &all, false), "No solution."),
        Several => Line(found(&lcp("[[-1]]", "[1]"), &all, false), "2 solutions."),
        Undetermined => {
            Line(found(&lcp("[[0]]", "[0]"), &all, false), "Infinitely many solutions: one continuum.")
        }
        Gap => Line(
            found(include_str!("../../slideway-cli/tests/raw/good/gap.json"), &all, false),
            "No solution, but there is a state with an unknown in its preload gap.",
        ),
        Tip | Jam | SlowsDown | Rests | LiftsOff => Never("matrices have no mechanism"),
        Undecided => Line(
            found(&lcp("[[-1, 0.5], [0.5, -1]]", "[1, 1]"), &SearchOptions { nodes: 1, ..all }, false),
            "One solution found so far.",
        ),
        Interrupted => Line(
            found(&lcp("[[-1, 0.5], [0.5, -1]]", "[1, 1]"), &all, true),
            "Not decided: no solution was found before the search ended.",
        ),
    }
}

fn expected(question: Question, outcome: Outcome) -> First {
    match question {
        Solve => of_solve(outcome),
        Limits => of_limits(outcome),
        Size => of_size(outcome),
        Drive => of_drive(outcome),
        Hold => of_hold(outcome),
        Map => of_map(outcome),
        Question::Sweep => of_sweep(outcome),
        Simulate => of_simulate(outcome),
        Check => of_check(outcome),
        Modes => of_modes(outcome),
    }
}

#[test]
fn every_question_has_a_first_line_for_every_outcome() {
    let mut wrong = Vec::new();
    for question in QUESTIONS {
        for outcome in OUTCOMES {
            match expected(question, outcome) {
                Line(told, beginning) if !told.starts_with(beginning) || beginning.is_empty() => {
                    wrong.push(format!("{question:?} {outcome:?}: {told}\n  instead of\n{beginning}"));
                }
                NoReport(false) => {
                    wrong.push(format!("{question:?} {outcome:?}: a part is reported as the whole"));
                }
                Never("") => wrong.push(format!("{question:?} {outcome:?}: never, but why?")),
                Line(..) | NoReport(true) | Never(_) => {}
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
