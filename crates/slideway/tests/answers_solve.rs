//! The first line of `solve`, `limits` and `size`, for every kind of outcome: what one would say to a colleague.

use slideway::limits::{LimitsOptions, Vary, limits, rest_limits};
use slideway::model::Settings;
use slideway::report::{Report, Status, Style};
use slideway::size::{SizeOptions, size};
use slideway::solve::{SolveOptions, solve_with};
use slideway::{HoldOptions, Model, gallery, solve};
use std::ops::ControlFlow;

fn model(name: &str) -> Model {
    Model::parse(gallery::find(name).expect("in the gallery").text).expect("sound")
}

fn with(name: &str, parameters: &[(&str, &str)]) -> Model {
    let settings = parameters
        .iter()
        .fold(Settings::default(), |settings, (name, value)| settings.parameter(name, *value));
    model(name).with(&settings).expect("sound")
}

fn finding(text: &str) -> Model {
    Model::parse(text).expect("sound")
}

fn answer(model: &Model) -> String {
    solve(model).expect("an answer").answer()
}

/// mu a / L = 2 mu 0.3 / 0.4: the push is 20 N / (1 - 1.5 mu), and it jams from mu = 2/3.
#[test]
fn a_drawer_moves_or_jams() {
    assert_eq!(
        answer(&model("drawer")),
        "It moves: push needs 36.36 N (20 N without friction). It would jam from mu = 0.6667 (2.222 times this friction). With \
         less friction no load jams it while it moves."
    );
    assert_eq!(
        answer(&with("drawer", &[("mu", "0.7")])),
        "It jams: no force of push moves it. It moves below mu = 0.6667."
    );
    assert_eq!(answer(&with("drawer", &[("mu", "0")])), "It moves: push needs 20 N, as without friction.");
}

#[test]
fn several_solutions_are_so_many_ways() {
    assert!(answer(&model("klepp-2002")).starts_with(
        "It can go on in 2 ways, and what went before decides which. \
             Another solution is unstable: a real mechanism leaves it. "
    ));
    let text = solve(&model("klepp-2002")).expect("an answer").text(Style::PLAIN);
    assert!(
        text.contains("Proven: there are no other solutions. One more state is in a preload gap.\n"),
        "{text}"
    );
    let gap = with("klepp-2002", &[("mu_1", "0.24"), ("F_30", "0.5*m*g"), ("F_20", "0")]);
    assert_eq!(solve(&gap).expect("an answer").status, Status::PreloadGap);
    assert!(answer(&gap).starts_with("It moves in a preload gap, "), "{}", answer(&gap));
}

/// Closed form of the tests of continua: 25 to 50 N.
#[test]
fn an_undetermined_share_is_a_range() {
    assert_eq!(
        answer(&finding(include_str!("findings/equal_play.toml"))),
        "How left, right share the load is undetermined: belt 25 to 50 N. Give `stiffness` for one value."
    );
}

#[test]
fn a_guided_slider_tips_and_does_not_jam() {
    let press = include_str!("findings/tipping_press.toml");
    let tipping = answer(&finding(&press.replace("mu = 0.12", "mu = 1.3")));
    assert!(!tipping.contains("jam"), "{tipping}");
    assert!(
        answer(&model("stick-slip")).contains(" It would tip (sole) from mu = "),
        "{}",
        answer(&model("stick-slip"))
    );
}

#[test]
fn without_a_drive_it_speeds_up_or_slows_down() {
    assert!(
        answer(&model("painleve-klein")).starts_with("It speeds up at 4.157 m/s^2. It would jam from mu = ")
    );
    let peg = finding(include_str!("../../../docs/src/examples/peg-pushed-by-load.toml"));
    assert!(answer(&peg).starts_with("It slows down at "), "{}", answer(&peg));
}

#[test]
fn a_search_that_ends_early_says_so() {
    let ended = solve_with(&model("klepp-2002"), &SolveOptions::default(), &mut |_| ControlFlow::Break(()));
    let ended = ended.expect("an answer");
    assert!(ended.partial);
    assert_eq!(
        ended.answer(),
        "Not decided: the search is not finished; so far it found no solution. Allow it more time."
    );
}

/// At mu = L / (2 a) the determinant is zero but for rounding. What is not decided comes with no factor of safety.
#[test]
fn a_boundary_within_rounding_is_not_decided() {
    assert_eq!(
        answer(&with("drawer", &[("mu", "2/3")])),
        "Not decided: it is on the verge of jamming, and rounding hides on which side. Take it as jammed, or ask again with \
         slightly more or less friction or load."
    );
}

/// With mu = 1 L / (2 a) exactly: the carriage is in equilibrium under any greater pull.
#[test]
fn forces_without_bound_are_on_the_verge_of_jamming() {
    let settings = Settings::default().parameter("L", "60 mm").parameter("a", "200 mm");
    let carriage = slideway::template::find("carriage").expect("a template");
    let text = carriage.model(&settings, "carriage.toml").expect("sound");
    assert_eq!(
        answer(&finding(&text)),
        "On the verge of jamming the forces are undetermined: pull 2.207 N or more."
    );
}

/// On the way back no friction jams it under its load, but above L / (2 a) a second way exists: 2/3 of 0.8 is 0.8333.
#[test]
fn this_load_and_others_are_two_things() {
    let back = with("drawer", &[("mu", "0.8"), ("v", "-0.1 m/s")]);
    assert_eq!(
        answer(&back),
        "It moves: push needs 9.091 N (20 N without friction). Another solution is unstable: a real mechanism leaves it. However much all \
         friction grows, it has a solution. Other loads can jam it or leave it several ways to move, already from 0.8333 times this friction on."
    );
}

#[test]
fn a_limit_is_one_sentence() {
    let over =
        |name: &str, vary: Vary| limits(&model(name), &LimitsOptions::new(vary)).expect("an answer").answer();
    assert_eq!(
        over("drawer", Vary::between("mu", 0.0, 1.5)),
        "It jams from mu = 0.6667 on (the model has 0.3)."
    );
    assert_eq!(over("drawer", Vary::between("mu", 0.0, 0.5)), "It moves for mu from 0 to 0.5.");
    assert_eq!(
        over("drawer", Vary::between("mu", 0.7, 1.5)),
        "It jams for mu from 0.7 to 1.5 (the model has 0.3)."
    );
    assert_eq!(
        over("klepp-2002", Vary::between("mu_1", 0.0, 1.5)),
        "mu_1 from 0 to 0.452654: it slows down (one solution). mu_1 from 0.452654 to 0.476471: two solutions. mu_1 from 0.476471 \
         to 1.5: three solutions."
    );
    let found = |text: &str, vary: Vary| {
        limits(&finding(text), &LimitsOptions::new(vary)).expect("an answer").answer()
    };
    assert_eq!(
        found(include_str!("findings/equal_play.toml"), Vary::between("mu", 0.0, 1.0)),
        "mu from 0 to 0.25: it moves, but how left, right share the load is undetermined. mu from 0.25 to 1: it may jam: that depends on how left, right share the load, which is undetermined. Give `stiffness` for one answer."
    );
    assert!(
        found(include_str!("findings/tipping_press.toml"), Vary::between("mu", 0.0, 1.3))
            .starts_with("mu from 0 to 1.25: it moves. mu from 1.25 to 1.3: ")
    );
    assert_eq!(
        over("drawer", Vary::between("L", 0.1, 0.5)),
        "It jams below L = 0.18 m (the model has 0.4 m)."
    );
    // Below 45 mm the rod cannot reach.
    assert_eq!(
        found(include_str!("../../../docs/src/examples/press.toml"), Vary::usual("l")),
        "It jams for l from 45 to 52.48 mm (the model has 100 mm)."
    );
}

/// A sentence that repeats the first one is left to the details; modes come in the order in which they are met.
#[test]
fn limits_say_nothing_twice() {
    let jam =
        limits(&model("drawer"), &LimitsOptions::new(Vary::between("mu", 0.0, 1.5))).expect("an answer");
    let [brief, verbose] = [false, true].map(|verbose| jam.text(Style::PLAIN.verbose(verbose)));
    assert!(
        !brief.contains("0.666667 to 1.5: it jams") && verbose.contains("0.666667 to 1.5: it jams"),
        "{brief}"
    );
    let gate =
        limits(&model("gate-on-two-posts"), &LimitsOptions::new(Vary::usual("mu"))).expect("an answer");
    let text = gate.text(Style::PLAIN.width(1000));
    let first = |line: &str| line.split_whitespace().next().and_then(|word| word.parse::<f64>().ok());
    let begins: Vec<f64> =
        text.lines().skip_while(|line| *line != "Contact modes").filter_map(first).collect();
    assert!(begins.len() > 2 && begins.is_sorted(), "{text}");
}

/// A drawer without resistance rests; a value that stands alone is not in the range beside it.
#[test]
fn a_single_value_is_not_in_the_range_beside_it() {
    let over = rest_limits(&model("drawer"), &Vary::between("Q", 0.0, 20.0), &HoldOptions::default());
    assert!(over.expect("an answer").answer().contains("Q above 0, up to 20 N: it does not hold."));
}

/// The block is at rest on the belt, and starts forwards with it; the peg slows down from mu = 5/24 on.
#[test]
fn limits_say_what_becomes_of_the_speed() {
    let over =
        |model: &Model, vary: Vary| limits(model, &LimitsOptions::new(vary)).expect("an answer").answer();
    assert_eq!(
        over(&model("stick-slip"), Vary::between("mu", 0.0, 0.4)),
        "mu from 0 to 0.4: it moves, and x starts forwards."
    );
    let peg = finding(include_str!("../../../docs/src/examples/peg-pushed-by-load.toml"));
    let peg = over(&peg, Vary::between("mu", 0.0, 0.5));
    let speeds = "mu from 0 to 0.208333: it speeds up (one solution). mu from 0.208333 to 0.5: it slows down (one solution).";
    assert!(peg.starts_with(speeds), "{peg}");
}

/// Of the speeds of an only solution the answer says all; the details have more digits.
#[test]
fn speeds_are_said_once() {
    let boom = solve(&model("telescopic-boom")).expect("an answer");
    let times = |verbose: bool, words: &str| {
        boom.text(Style::PLAIN.verbose(verbose).width(1000)).matches(words).count()
    };
    assert_eq!(times(false, "s_2 speeds up"), 1);
    assert_eq!(times(true, "s_2 speeds up"), 2);
}

#[test]
fn a_dimension_and_the_present_safety_factor_are_two() {
    let report =
        size(&model("drawer"), &SizeOptions::new(Vary::between("L", 0.1, 1.0), 2.0)).expect("an answer");
    assert_eq!(
        report.answer(),
        "For a safety factor of 2 against jamming: L at least 0.36 m (examined up to 1 m). The model has L = 0.4 m: its safety \
         factor is 2.222, which is enough."
    );
    let short = size(&model("drawer"), &SizeOptions::new(Vary::between("L", 0.05, 0.1), 2.0));
    assert_eq!(
        short.expect("an answer").answer(),
        "For a safety factor of 2 against jamming: no L from 0.05 to 0.1 m gives it; the greatest safety factor that was found \
         is 0.555556, at 0.1 m. The model has L = 0.4 m: its safety factor is 2.222, which is enough."
    );
    // At constant velocity the mass is of no account: L / (2 mu a) = 2.222.
    let mass = size(&model("drawer"), &SizeOptions::new(Vary::between("m", 1.0, 9.0), 3.0));
    assert_eq!(
        mass.expect("an answer").answer(),
        "For a safety factor of 3 against jamming: no m from 1 to 9 kg gives it; the safety factor is 2.222 at any m. The model \
         has m = 5 kg: its safety factor is 2.222, which is too little."
    );
    let any = size(&model("klepp-2002"), &SizeOptions::new(Vary::between("l", 0.2, 5.0), 1.0));
    let any = any.expect("an answer").answer();
    assert!(
        any.starts_with(
            "While it moves nothing jams it, however great the friction, at any l from 0.2 to 5 m."
        ),
        "{any}"
    );
    let jams = size(&with("drawer", &[("mu", "0.7")]), &SizeOptions::new(Vary::between("L", 0.1, 1.0), 2.0));
    let jams = jams.expect("an answer").answer();
    assert!(
        jams.ends_with(
            "The model has L = 0.4 m: it jams; friction would have to fall to 0.9524 of its value."
        ),
        "{jams}"
    );
}

/// What is said shortly is true in full: all details hold the short answer, and no line of prose is too long.
#[test]
fn the_details_begin_with_the_answer_and_lines_fit() {
    for entry in gallery::MODELS {
        let model = Model::parse(entry.text).expect("sound");
        let Ok(report) = solve(&model) else { continue };
        let narrow = report.text(Style::PLAIN.width(80));
        for line in narrow.lines() {
            assert!(line.chars().count() <= 100, "{}: {line}", entry.name);
        }
        let [brief, verbose] =
            [false, true].map(|verbose| report.text(Style::PLAIN.verbose(verbose).width(10_000)));
        for text in [&brief, &verbose] {
            assert!(text.contains(&report.answer()), "{}: {text}", entry.name);
        }
        // Of redundant guides the details name the groups, where the short text has one sentence.
        let is_short = |line: &&str| line.starts_with("It is wedged") || line.starts_with("The guides share");
        for line in brief.lines().filter(|line| line.ends_with(['.', ':']) && !is_short(line)) {
            assert!(verbose.contains(line), "{}: {line}\n{verbose}", entry.name);
        }
    }
}
