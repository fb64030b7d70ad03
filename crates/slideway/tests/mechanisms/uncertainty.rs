//! Parameters that are known within bounds: which solutions exist for all their values.

use crate::answers::{model, report, report_with};
use slideway::gallery;
use slideway::model::{Model, Settings};
use slideway::report::{Persistence, Report, SolveReport, Uncertainty};
use slideway::solve::solve;

fn uncertainty(name: &str, list: &[(&str, &str)]) -> Uncertainty {
    report(name, list).uncertainty.expect("a parameter within bounds")
}

fn persistence(uncertainty: &Uncertainty, pattern: &str) -> Persistence {
    let mode = uncertainty.modes.iter().find(|mode| mode.pattern == pattern);
    mode.unwrap_or_else(|| panic!("{pattern} in {uncertainty:#?}")).persistence
}

/// `reference/klepp-2002.toml`: locking at 0.45265396 bounds the second solution.
#[test]
fn the_paper_s_number_of_solutions_for_ranges_of_friction() {
    let of = |range: &str| uncertainty("klepp-2002", &[("F_20", "0"), ("mu_1", range)]);
    let below = of("0.1..0.15");
    assert_eq!((below.least_solutions, below.most_solutions), (1, Some(1)));
    assert_eq!(persistence(&below, "+++"), Persistence::AllValues);
    let above = of("0.4527..0.8");
    assert_eq!((above.least_solutions, above.most_solutions), (2, Some(2)));
    assert_eq!(persistence(&above, "-++"), Persistence::AllValues);
    let across = of("0.4..0.6");
    assert_eq!((across.least_solutions, across.most_solutions), (1, Some(2)));
    assert_eq!(persistence(&across, "+++"), Persistence::AllValues);
    assert_eq!(persistence(&across, "-++"), Persistence::SomeValues);
}

/// The drawer has one solution while `2 mu |a| < L` = 0.4 m (README; `limits` proves it), also where the force of its
/// guides passes zero, at a = 0.
#[test]
fn a_force_that_passes_zero_within_the_range_leaves_the_number_of_solutions() {
    let across = uncertainty("drawer", &[("a", "-0.1..0.15")]);
    assert_eq!((across.least_solutions, across.most_solutions), (1, Some(1)));
    assert_eq!(persistence(&across, "+-"), Persistence::SomeValues);
    assert_eq!(persistence(&across, "-+"), Persistence::SomeValues);
}

/// It jams from mu = L/(2 a) = 2/3 on.
#[test]
fn a_jam_within_the_range_is_found_where_it_begins() {
    let across = uncertainty("drawer", &[("mu", "0.6..0.7")]);
    assert_eq!((across.least_solutions, across.most_solutions), (0, Some(1)));
    assert_eq!(across.proven_counts, [0, 1]);
    let counted = |number| {
        let mut found = across.stretches.iter().filter(|stretch| stretch.most_solutions == Some(number));
        let stretch = found.find(|stretch| stretch.least_solutions == number).expect("proven");
        assert!(found.all(|other| other.least_solutions < number));
        [stretch.from, stretch.to]
    };
    let ([from, end], [begin, to]) = (counted(1), counted(0));
    assert_eq!((from, to), (0.6, 0.7));
    assert!(end <= 2.0 / 3.0 && 2.0 / 3.0 <= begin && begin - end < 1e-9, "{end} {begin}");
}

#[test]
fn the_first_line_is_about_the_whole_range() {
    let answer = |range: &str| report("drawer", &[("mu", range)]).answer();
    let moves = answer("0.2..0.4");
    let all = "One solution for every mu from 0.2 to 0.4. In the middle, mu = 0.3: it moves: push needs";
    assert!(moves.starts_with(all), "{moves}");
    let jams = answer("0.6..0.7");
    let part = "From mu = 0.6 to 0.6667 one solution, from 0.6667 to 0.7 no solution. In the middle";
    assert!(jams.starts_with(part), "{jams}");
}

/// A parameter, its bounds, and their unit.
type Range = (&'static str, f64, f64, &'static str);

/// Every solution at values within the ranges is in the list, with its forces in the bounds.
#[test]
fn no_solution_at_any_value_is_missing() {
    let ranges: [(&str, &[Range]); 4] = [
        ("klepp-2002", &[("mu_1", 0.44, 0.5, ""), ("mu_2", 0.05, 0.15, "")]),
        ("klepp-2002", &[("F_20", 8.0, 11.0, "N"), ("P", -1.0, 1.0, "N")]),
        ("cam-follower", &[("mu", 0.2, 0.6, "")]),
        ("painleve-klein", &[("mu", 0.1, 0.5, ""), ("P_2", 5.0, 15.0, "N")]),
    ];
    for (name, ranges) in ranges {
        let as_ranges = ranges.iter().fold(Settings::default(), |settings, (parameter, from, to, unit)| {
            settings.parameter(parameter, format!("{from} {unit}..{to} {unit}"))
        });
        let whole = report_with(&model(name), &as_ranges).uncertainty.expect("ranges");
        for step in 0..40 {
            let at = |index: usize| (f64::from(step) * [0.754_877_666, 0.569_840_291][index]).fract();
            let values = ranges.iter().enumerate().fold(Settings::default(), |settings, (index, range)| {
                let value = range.1 + (range.2 - range.1) * at(index);
                settings.parameter(range.0, format!("{value} {}", range.3))
            });
            check_sample(&whole, &report_with(&model(name), &values));
        }
    }
}

fn check_sample(whole: &Uncertainty, sample: &SolveReport) {
    let solutions = sample.solutions.len();
    assert!(whole.least_solutions <= solutions && whole.most_solutions.is_none_or(|most| solutions <= most));
    for state in sample.solutions.iter().chain(&sample.preload_gap_states) {
        let mode = whole.modes.iter().find(|mode| mode.pattern == state.pattern).expect("listed");
        let Some(bounds) = &mode.normal_force_bounds else { continue };
        for (contact, [from, to]) in state.contacts.iter().zip(bounds) {
            let room = 1e-9 * contact.normal_force.abs().max(1.0);
            assert!((from - room..=to + room).contains(&contact.normal_force), "{}", state.pattern);
        }
    }
    for mode in whole.modes.iter().filter(|mode| mode.persistence == Persistence::AllValues) {
        let mut states = sample.solutions.iter().chain(&sample.preload_gap_states);
        assert!(states.any(|state| state.pattern == mode.pattern), "{} does not persist", mode.pattern);
    }
}

#[test]
fn the_rest_of_the_report_holds_for_the_middle() {
    let ranged = report("klepp-2002", &[("mu_1", "0.4..0.6")]);
    let middle = report("klepp-2002", &[("mu_1", "0.5")]);
    assert_eq!(ranged.solutions, middle.solutions);
    assert!(middle.uncertainty.is_none());
}

/// A sledge with its centre of mass at the height c over the pressed face slows down with mu g: it needs the
/// couple m mu g c, and its pressure gives m g L/2 at most. It tips from mu = L / (2 c) = 0.1 on.
#[test]
fn a_guided_slider_tips_for_some_values() {
    let of = |range: &str| {
        let text = format!(
            r#"
            gravity = "9.81 m/s^2"
            [parameters]
            mu = "{range}"
            [points]
            face = [0, 0]
            top = [0, 0.5]
            [bodies.sledge]
            mass = 2
            moment_of_inertia = 0.1
            centre_of_mass = "top"
            points = ["face", "top"]
            [joints.runner]
            type = "guided_slider"
            block = "sledge"
            guide = "ground"
            at = "face"
            along = 0
            length = 0.1
            mu = "mu"
            [coordinates.x]
            slide = "runner"
            rate = 1
            "#
        );
        let model = Model::parse(&text).unwrap_or_else(|faults| panic!("{faults}"));
        solve(&model).expect("sound").uncertainty.expect("a range")
    };
    let (slides, tips, either) = (of("0.05..0.099"), of("0.101..0.2"), of("0.05..0.2"));
    assert_eq!(persistence(&slides, "+"), Persistence::AllValues);
    assert_eq!((tips.least_solutions, tips.most_solutions), (0, Some(0)));
    assert_eq!(persistence(&either, "+"), Persistence::SomeValues);
}

#[test]
fn ranges_stand_in_model_files_and_only_for_parameters() {
    let text = gallery::find("klepp-2002").expect("in the gallery").text;
    let ranged = text.replace("mu_1 = 0.5 ", "mu_1 = \"0.4..0.42\" ");
    assert_ne!(text, ranged);
    let model = Model::parse(&ranged).expect("sound");
    assert_eq!(model.ranges().expect("in order").len(), 1);
    assert!(solve(&model).expect("sound").uncertainty.is_some());
    // Settings replace ranges, and the other way about.
    let plain = model.with(&Settings::default().parameter("mu_1", "0.41")).expect("sound");
    assert!(plain.ranges().expect("none").is_empty());
    let elsewhere = text.replace("mu = \"mu_1\"", "mu = \"0.1..0.2\"");
    assert!(Model::parse(&elsewhere).is_err());
}

#[test]
fn faults_of_ranges_are_told_at_their_place() {
    let fault = |value: &str| {
        let settings = Settings::default().parameter("mu_1", value);
        model("klepp-2002").with(&settings).expect_err("a fault").sorted()[0].clone()
    };
    let unknown = fault("0.2..frction");
    assert_eq!(unknown.place.expect("a place").span, 10..17);
    for value in ["0.1..0.2 m", "0.1..", "..0.2", "0.1..0.2..0.3"] {
        fault(value);
    }
}
